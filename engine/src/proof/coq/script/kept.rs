//! Signs that rest on what is supposed of a quantity without a pivot, by a multiple of it.

use super::super::expr::Expr;
use super::super::lemma::{Lemma, Result, spaced};
use super::{Place, Script, is_said_of};
use crate::formula::{Proposition, Relation};
use crate::number::Tree;
use crate::number::tree::Step;
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio};
use crate::proof::kernel::sign::Sign;
use crate::proof::kernel::{Derivation, Direct, Signed, Supposed, Used};
use std::collections::BTreeSet;

/// The brackets that such a quantity decides, each with the name of the case in which it has.
#[derive(Clone, Default)]
pub(super) struct Kept(Vec<(Tree, Option<String>)>);

impl Kept {
    pub(super) fn of(derivation: &Derivation) -> Self {
        fn collect(derivation: &Derivation, all: &mut Vec<(Tree, Option<String>)>) {
            match derivation {
                Derivation::Direct(direct) => {
                    let kept = direct.brackets.iter().filter(|(.., signed)| signed.less.is_some());
                    for (bracket, ..) in kept {
                        if all.iter().all(|(known, _)| known != bracket) {
                            all.push((bracket.clone(), None));
                        }
                    }
                }
                Derivation::Cases(_, positive, not) => {
                    [positive, not].iter().for_each(|own| collect(own, all))
                }
            }
        }
        let mut all = Vec::new();
        collect(derivation, &mut all);
        Kept(all)
    }

    /// K1, K2, …: each of the brackets is one of two.
    pub(super) fn name(&self, script: &mut Script, lemma: &Lemma) {
        for ((bracket, _), i) in self.0.iter().zip(1..) {
            let rule = if matches!(bracket.step(), Step::Min(..)) { "minimum" } else { "bracket" };
            let of = spaced(bracket.step().operands().map(|of| lemma.printer.expr(of).argument()));
            script.line(&format!("pose proof ({rule}{of}) as K{i}. functions."));
        }
    }

    /// Splits by what decides one of the brackets; returns `false` if the split is by something else.
    pub(super) fn decide(
        &mut self,
        script: &mut Script,
        case: &str,
        split: Option<&Supposed>,
        direct: &Direct,
    ) -> bool {
        let Some(split) = split.filter(|split| matches!(split.used, Used::Kept)) else { return false };
        let decides = |(own, _): &(Tree, _)| {
            let signed = sign_of(own, direct).filter(|signed| signed.num.of().is_zero());
            let less = signed.and_then(|signed| signed.less.as_ref());
            less.is_some_and(|less| less.of == reduced(&split.value, direct))
        };
        let Some(i) = self.0.iter().position(decides) else { return false };
        let (cases, name) = (format!("({case} & K{0}) | ({case} & K{0})", i + 1), format!("K{}", i + 1));
        script.line(&format!("destruct {name} as [{cases}]; rewrite {name} in *; clear {name}."));
        self.0[i].1 = Some(case.to_string());
        true
    }

    /// The signs that decide, if some of them rest on multiples; returns `false` if none does.
    pub(super) fn signs(
        &self,
        script: &mut Script,
        place: &Place,
        direct: &Direct,
        decisive: &[Signed],
    ) -> Result<bool> {
        let is_decided = |bracket| self.0.iter().any(|(own, case)| own == bracket && case.is_some());
        if direct.brackets.iter().any(|(own, _, signed)| signed.less.is_some() && !is_decided(own)) {
            return Err("a bracket by a hypothesis without a pivot".into());
        }
        if decisive.iter().all(|signed| signed.less.is_none()) {
            return Ok(false);
        }
        let (mut labels, mut rules) = (BTreeSet::new(), Vec::new());
        for signed in decisive {
            let Some(less) = &signed.less else {
                rules.push("bounded".to_string());
                continue;
            };
            let (label, unit) =
                self.supposed(&less.of, place, direct).ok_or("a hypothesis without a pivot")?;
            let factor = less.factor.value.over(&unit).ok_or("a multiple of nothing")?;
            let is_strict =
                matches!(place.proposition, Proposition::Sign(Relation::Positive | Relation::Zero, _));
            if is_strict || !less.factor.sign().implies(Sign::NonNegative) {
                return Err("a strict sign by a hypothesis without a pivot".into());
            }
            rules.push(format!("by_multiple {label} {}", divided(&factor).argument()));
            labels.insert(label);
        }
        let labels = spaced(labels);
        script.line(&format!("revert{labels}. pivots. minima. intros{labels}."));
        match &rules[..] {
            [above, below] => script.line(&format!("apply within; [{above} | {below}].")),
            rules => script.line(&format!("{}.", rules.concat())),
        }
        Ok(true)
    }

    /// What says of a reduced quantity that it has a sign, and of which multiple of it.
    fn supposed(&self, of: &Ratio, place: &Place, direct: &Direct) -> Option<(String, Ratio)> {
        let by_case = self.0.iter().find_map(|(bracket, case)| {
            let less = sign_of(bracket, direct)?.less.as_ref().filter(|less| less.of == *of)?;
            let (size, is_negative) = (less.factor.value.clone(), less.factor.sign() == Sign::Negative);
            Some((case.clone()?, if is_negative { -size } else { size }))
        });
        by_case.or_else(|| {
            let is_of_it = |own: &&Supposed| {
                let stands = matches!(own.used, Used::Kept)
                    || matches!(&own.used, Used::Symbol(x) if is_said_of(own, x));
                stands && reduced(&own.value, direct) == *of
            };
            let given = direct.supposed.iter().find(is_of_it)?.given.as_ref()?;
            Some((place.lemma.label(given)?, Poly::constant(1).into()))
        })
    }
}

/// What decides a bracket.
fn sign_of<'d>(bracket: &Tree, direct: &'d Direct) -> Option<&'d Signed> {
    direct.brackets.iter().find(|(own, ..)| own == bracket).map(|(.., signed)| signed)
}

/// With every pivot replaced.
fn reduced(value: &Ratio, direct: &Direct) -> Ratio {
    let replace = |value: Ratio, supposed: &Supposed| match &supposed.used {
        Used::Pivot(pivot, by, _) => value.replace(pivot, by),
        Used::Between(x, by, _) => value.replace(&Monomial::of(*x), by),
        _ => value,
    };
    let once = |value: Ratio, _: &Supposed| direct.supposed.iter().fold(value, replace);
    direct.supposed.iter().fold(value.clone(), once)
}

/// A quotient that may be a polynomial, or 1 over one.
fn divided(ratio: &Ratio) -> Expr {
    let (num, den) = (ratio.num(), ratio.den());
    let inverse = || Some(Expr::int(1).over(Expr::poly(&den.over(num)?)));
    num.over(den).map(|whole| Expr::poly(&whole)).or_else(inverse).unwrap_or_else(|| Expr::ratio(ratio))
}

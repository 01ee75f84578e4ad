//! Signs that rest on a multiple of an assumption without a pivot.

use super::super::expr::Expr;
use super::super::lemma::{Lemma, Result, spaced};
use super::{Place, Script, is_sign_of};
use crate::formula::{Proposition, Relation};
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio};
use crate::proof::kernel::sign::Sign;
use crate::proof::kernel::{Assumption, AssumptionUse, Derivation, Direct, SignedRatio};
use std::collections::BTreeSet;

/// Brackets decided by such an assumption, with the label of the case in which it holds.
#[derive(Clone, Default)]
pub(super) struct Retained(Vec<(Tree, Option<String>)>);

impl Retained {
    pub(super) fn of(derivation: &Derivation) -> Self {
        fn collect(derivation: &Derivation, all: &mut Vec<(Tree, Option<String>)>) {
            match derivation {
                Derivation::Direct(direct) => {
                    let kept = direct.branches.iter().filter(|(.., signed)| signed.subtracted.is_some());
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
        Retained(all)
    }

    /// Introduces K1, K2, …: each bracket has one of two values.
    pub(super) fn name(&self, script: &mut Script, lemma: &Lemma) {
        for ((bracket, _), i) in self.0.iter().zip(1..) {
            let rule = if matches!(bracket.op(), Op::Min(..)) { "minimum" } else { "bracket" };
            let of = spaced(bracket.op().operands().map(|of| lemma.printer.expr(of).argument()));
            script.line(&format!("pose proof ({rule}{of}) as K{i}. functions."));
        }
    }

    /// Splits into the cases of a bracket; returns `false` if the split is by another quantity.
    pub(super) fn decide(
        &mut self,
        script: &mut Script,
        case: &str,
        split: Option<&Assumption>,
        direct: &Direct,
    ) -> bool {
        let Some(split) = split.filter(|split| matches!(split.usage, AssumptionUse::Retained)) else {
            return false;
        };
        let decides = |(own, _): &(Tree, _)| {
            let signed = sign_of(own, direct).filter(|signed| signed.num.of().is_zero());
            let less = signed.and_then(|signed| signed.subtracted.as_ref());
            less.is_some_and(|less| less.of == reduced(&split.value, direct))
        };
        let Some(i) = self.0.iter().position(decides) else { return false };
        let (cases, name) = (format!("({case} & K{0}) | ({case} & K{0})", i + 1), format!("K{}", i + 1));
        script.line(&format!("destruct {name} as [{cases}]; rewrite {name} in *; clear {name}."));
        self.0[i].1 = Some(case.to_string());
        true
    }

    /// Proves the deciding signs if some of them rest on multiples; returns `false` otherwise.
    pub(super) fn signs(
        &self,
        script: &mut Script,
        place: &Place,
        direct: &Direct,
        decisive: &[SignedRatio],
    ) -> Result<bool> {
        let is_decided = |bracket| self.0.iter().any(|(own, case)| own == bracket && case.is_some());
        if direct.branches.iter().any(|(own, _, signed)| signed.subtracted.is_some() && !is_decided(own)) {
            return Err("a bracket by a hypothesis without a pivot".into());
        }
        if decisive.iter().all(|signed| signed.subtracted.is_none()) {
            return Ok(false);
        }
        let (mut labels, mut rules) = (BTreeSet::new(), Vec::new());
        for signed in decisive {
            let Some(less) = &signed.subtracted else {
                rules.push("bounded".to_string());
                continue;
            };
            let (label, unit) =
                self.find_assumption(&less.of, place, direct).ok_or("a hypothesis without a pivot")?;
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

    /// Returns the assumption on a reduced quantity and the multiple of it.
    fn find_assumption(&self, of: &Ratio, place: &Place, direct: &Direct) -> Option<(String, Ratio)> {
        let by_case = self.0.iter().find_map(|(bracket, case)| {
            let less = sign_of(bracket, direct)?.subtracted.as_ref().filter(|less| less.of == *of)?;
            let (size, is_negative) = (less.factor.value.clone(), less.factor.sign() == Sign::Negative);
            Some((case.clone()?, if is_negative { -size } else { size }))
        });
        by_case.or_else(|| {
            let is_of_it = |own: &&Assumption| {
                let stands = matches!(own.usage, AssumptionUse::Retained)
                    || matches!(&own.usage, AssumptionUse::Symbol(x) if is_sign_of(own, x));
                stands && reduced(&own.value, direct) == *of
            };
            let given = direct.assumptions.iter().find(is_of_it)?.hypothesis.as_ref()?;
            Some((place.lemma.label(given)?, Poly::constant(1).into()))
        })
    }
}

/// Returns the sign that decides a bracket.
fn sign_of<'d>(bracket: &Tree, direct: &'d Direct) -> Option<&'d SignedRatio> {
    direct.branches.iter().find(|(own, ..)| own == bracket).map(|(.., signed)| signed)
}

/// Replaces all pivots.
fn reduced(value: &Ratio, direct: &Direct) -> Ratio {
    let replace = |value: Ratio, supposed: &Assumption| match &supposed.usage {
        AssumptionUse::Pivot(pivot, by, _) => value.replace(pivot, by),
        AssumptionUse::Interval(x, by, _) => value.replace(&Monomial::of(*x), by),
        _ => value,
    };
    let once = |value: Ratio, _: &Assumption| direct.assumptions.iter().fold(value, replace);
    direct.assumptions.iter().fold(value.clone(), once)
}

/// Writes a quotient, which may be a polynomial or 1 over one.
fn divided(ratio: &Ratio) -> Expr {
    let (num, den) = (ratio.num(), ratio.den());
    let inverse = || Some(Expr::int(1).over(Expr::poly(&den.over(num)?)));
    num.over(den).map(|whole| Expr::poly(&whole)).or_else(inverse).unwrap_or_else(|| Expr::ratio(ratio))
}

//! Proofs of goals by Coq's tactics.
//!
//! The search results of the kernel guide Coq where it would have to guess: the quantities to name, the
//! cases, and the expressions whose sign is that of a slope. None of them is trusted: each is a goal that Coq
//! proves by itself or rejects.

mod limit;
mod retained;
mod rounding;

use super::expr::Expr;
use super::lemma::{Lemma, Result};
use super::print::ascii;
use crate::formula::{Hypothesis, Proposition, Registry, Statement};
use crate::number::tree::Op;
use crate::proof::kernel;
use crate::proof::kernel::algebra::{Poly, Ratio, Symbol};
use crate::proof::kernel::sign::{Certificate, Rule, Sign};
use crate::proof::kernel::{Assumption, AssumptionUse, Derivation, Direct, Justification, SignedRatio};
use crate::proof::render::ProofPrinter;
use retained::Retained;
use std::fmt::Write;

/// Lines of a proof.
#[derive(Default)]
pub(super) struct Script {
    lines: String,
    indent: usize,
}

/// Position in a proof: the lemma, the number of assumptions used, and the number of cases among them.
#[derive(Clone)]
struct Place<'l> {
    lemma: &'l Lemma<'l>,
    proposition: &'l Proposition,
    supposed: usize,
    cases: usize,
    kept: Retained,
}

impl<'l> Place<'l> {
    fn new(lemma: &'l Lemma<'l>, proposition: &'l Proposition, kept: Retained) -> Self {
        Place { lemma, proposition, supposed: 0, cases: 0, kept }
    }
}

/// Returns `true` if an assumption is the sign of a symbol.
fn is_sign_of(supposed: &Assumption, x: &Symbol) -> bool {
    supposed.hypothesis.as_ref().is_some_and(|given| *given.value.op() == Op::Symbol(x.name()))
}

/// # Errors
/// Returns the reason if the kernel finds no derivation.
pub(super) fn derivation(hypotheses: &[&Hypothesis], proposition: &Proposition) -> Result<Derivation> {
    kernel::derivation(hypotheses, proposition).map_err(|reason| {
        let statement = Statement::new("", proposition.clone()).assuming(hypotheses.iter().copied());
        let reason = ProofPrinter::new(&Registry::default()).describe(&statement, &reason);
        format!("no proof to follow: {reason}")
    })
}

/// Returns the first derivation without cases; all of them begin with the same assumptions.
fn first(derivation: &Derivation) -> &Direct {
    match derivation {
        Derivation::Direct(direct) => direct,
        Derivation::Cases(_, positive, _) => first(positive),
    }
}

impl Script {
    pub(super) fn new() -> Self {
        Script { indent: 1, ..Script::default() }
    }

    /// Begins a proof by introducing the variables and hypotheses of a lemma.
    pub(super) fn of(lemma: &Lemma) -> Self {
        let mut script = Script::new();
        let intros = lemma.intros();
        script.line(format!("{intros} functions.").trim_start());
        lemma.signs_of_scales().iter().for_each(|line| script.line(line));
        script
    }

    pub(super) fn into_text(self) -> String {
        self.lines
    }

    pub(super) fn line(&mut self, text: &str) {
        let _ = writeln!(self.lines, "{:1$}{text}", "", 2 * self.indent);
    }

    /// Writes a subproof.
    pub(super) fn block(&mut self, bullet: &str, inside: impl FnOnce(&mut Self) -> Result<()>) -> Result<()> {
        let mut own = Script { lines: String::new(), indent: self.indent + 1 };
        inside(&mut own)?;
        let pad = " ".repeat(2 * self.indent);
        let text = own.lines.trim_start();
        let end = if bullet == "{" { " }\n" } else { "\n" };
        let _ = write!(self.lines, "{pad}{bullet} {}{end}", text.trim_end());
        Ok(())
    }

    /// Proves a proposition, or one with the same assumptions, from the hypotheses of a lemma.
    pub(super) fn goal(&mut self, lemma: &Lemma, proposition: &Proposition) -> Result<()> {
        let derivation = derivation(lemma.premises(), proposition)?;
        let direct = first(&derivation);
        match (&direct.justification, proposition) {
            (Justification::Equal(_), _) if !direct.roundings.is_empty() => {
                return self.in_units(&direct.roundings, lemma);
            }
            (Justification::Order(_), Proposition::Sign(_, of)) => return self.order(of, lemma),
            _ => {}
        }
        let kept = Retained::of(&derivation);
        kept.name(self, lemma);
        if lemma.rounds {
            self.models(&direct.roundings, lemma);
        }
        self.derivation(Place::new(lemma, proposition, kept), &derivation)
    }

    /// Uses the hypotheses up to the next case.
    fn hypotheses(&mut self, place: &mut Place, direct: &Direct) -> Result<()> {
        while let Some(next) = direct.assumptions.get(place.supposed)
            && let Some(given) = next.hypothesis.as_ref()
        {
            place.supposed += 1;
            self.use_assumption(place.supposed, next, place.lemma.label(given))?;
        }
        Ok(())
    }

    fn derivation(&mut self, mut place: Place, derivation: &Derivation) -> Result<()> {
        self.hypotheses(&mut place, first(derivation))?;
        match derivation {
            Derivation::Direct(direct) => self.direct(&place, direct),
            Derivation::Cases(deciding, positive, not) => {
                place.supposed += 1;
                place.cases += 1;
                let (case, branches) = (format!("C{}", place.cases), [positive, not]);
                let split = |branch| first(branch).assumptions.get(place.supposed - 1);
                if !place.kept.decide(self, &case, split(positive), first(positive)) {
                    let deciding = Expr::poly(deciding).argument();
                    self.line(&format!("destruct (either {deciding}) as [{case} | {case}]."));
                }
                for branch in branches {
                    self.block("{", |own| {
                        let split = &first(branch).assumptions[place.supposed - 1];
                        own.use_assumption(place.supposed, split, Some(case.clone()))?;
                        own.derivation(place.clone(), branch)
                    })?;
                }
                Ok(())
            }
        }
    }

    /// Uses the i-th assumption.
    fn use_assumption(&mut self, i: usize, supposed: &Assumption, hypothesis: Option<String>) -> Result<()> {
        let strict = supposed.sign.is_strict();
        match (&supposed.usage, hypothesis) {
            (AssumptionUse::Implied | AssumptionUse::Retained | AssumptionUse::Unused, _) => {}
            (AssumptionUse::Symbol(x), _) if is_sign_of(supposed, x) => {}
            (AssumptionUse::Size { .. }, _) => return Err("an absolute value without cases".into()),
            (_, None) => {
                return Err("a hypothesis about the variable of a limit requires more than its sign".into());
            }
            (AssumptionUse::Symbol(x), Some(hypothesis)) => self.line(&format!(
                "assert (P{i} : 0 {} {}) by (apply (same_sign _ _ _ {hypothesis}); decide_goal).",
                if strict { "<" } else { "<=" },
                ascii(x.name())
            )),
            (AssumptionUse::Interval(_, _, place), Some(hypothesis)) => {
                let near = supposed.hypothesis.as_ref().is_some_and(|given| given.distance().is_some());
                let (rule, place) = (if near { "near" } else { "between" }, ascii(place.name()));
                self.line(&format!("destruct ({rule} _ _ _ {hypothesis}) as ({place} & T{i} & ->)."));
            }
            (AssumptionUse::Pivot(pivot, by, named), Some(hypothesis)) => {
                let (mut value, mut hypothesis) = (Some(supposed.value.clone()), hypothesis);
                if let Some(divisor) = supposed.divisor.as_ref() {
                    value = supposed.value.over(divisor);
                    let (divisor, rule) = (Expr::ratio(divisor), if strict { "lt" } else { "le" });
                    hypothesis =
                        format!("(Rdiv_{rule}_0_compat _ _ {hypothesis} (ltac:(bounded) : 0 < {divisor}))");
                }
                let mut equation = hypothesis.clone();
                if let Some(x) = named {
                    let name = ascii(x.name());
                    self.line(&format!("destruct (named _ _ {hypothesis}) as ({name} & S{i} & P{i})."));
                    equation = format!("(eq_sym S{i})");
                }
                // pivot − by = factor · (the quantity − its name)
                let difference = Ratio::from(Poly::from(pivot.clone())) - by;
                let name = named.map_or(Ratio::zero(), |name| Poly::symbol(name).into());
                let factor = value.and_then(|value| difference.over(&(value - name)));
                let factor = factor.ok_or("a hypothesis has no solution")?;
                let [by, factor] = [by, &factor].map(|ratio| Expr::ratio(ratio).argument());
                let pivot = Expr::poly(&pivot.clone().into()).argument();
                self.line(&format!(
                    "assert (E{i} : pivot {pivot} {by}) by (apply (solved _ _ {factor} _ _ {equation}); \
                     decide_goal)."
                ));
                if named.is_some() {
                    // A later assumption may replace the name, but must not replace it here.
                    self.line(&format!("clear S{i}."));
                }
            }
        }
        Ok(())
    }

    fn direct(&mut self, place: &Place, direct: &Direct) -> Result<()> {
        let divisors = direct.divisors.iter().map(|(_, signed)| signed);
        let mut passing = divisors.chain(direct.branches.iter().map(|(.., signed)| signed));
        let decisive: &[SignedRatio] = match &direct.justification {
            Justification::Sign(signed) => std::slice::from_ref(signed),
            Justification::Within(both) => &both[..],
            _ => &[],
        };
        if place.kept.signs(self, place, direct, decisive)? {
            return Ok(());
        }
        let (decided, slopes) = match &direct.justification {
            Justification::Sign(signed) => (slope_of(signed), slopes(&signed.num)),
            _ => (None, 0),
        };
        if slopes != usize::from(decided.is_some()) || passing.any(|signed| self::slopes(&signed.num) > 0) {
            return Err("the sign of a divisor, a bracket or a slope rests on a slope".into());
        }
        self.line(decided.as_deref().unwrap_or("decide_goal."));
        Ok(())
    }
}

/// Returns the number of slopes that a sign rests on.
fn slopes(certificate: &Certificate) -> usize {
    match certificate.rule() {
        Rule::Termwise | Rule::TriangleInequality(_) | Rule::Endpoints { .. } => 0,
        Rule::Product(a, b) | Rule::Square { leading: a, rest: b, .. } => slopes(a) + slopes(b),
        Rule::MeanValue { start, slope, .. } => 1 + slopes(start) + slopes(slope),
    }
}

/// Returns a factor of a polynomial whose sign is that of its slope in a symbol, and the remaining factor.
fn slope(certificate: &Certificate) -> Option<(&Certificate, Symbol, Poly)> {
    let times = |factor: &Certificate, of| {
        let (part, x, rest) = slope(of)?;
        Some((part, x, rest * factor.of()))
    };
    match certificate.rule() {
        Rule::MeanValue { x, .. } => Some((certificate, *x, Poly::constant(1))),
        Rule::Product(a, b) => times(a, b).or_else(|| times(b, a)),
        _ => None,
    }
}

/// Returns the tactic for a sign that is that of a slope.
fn slope_of(signed: &SignedRatio) -> Option<String> {
    let (part, x, rest) = slope(&signed.num)?;
    let rest = Ratio::from(rest).over(&signed.value.den().clone().into())?;
    let positive = part.sign().implies(Sign::NonNegative);
    let (part, rest) = if positive { (part.of().clone(), rest) } else { (-part.of(), -rest) };
    Some(format!(
        "slope {} {} {}.",
        ascii(x.name()),
        Expr::poly(&part).argument(),
        Expr::ratio(&rest).argument()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Relation, claim::positive};
    use crate::number::{Exponential, Tree};
    use crate::proof::prove;

    /// A sign by slope, one whose value at 0 is another, and one whose slope is another.
    #[test]
    fn slopes_are_as_many_as_the_proof_has() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let above = [&a, &b].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
        let tangent = |x: &Tree| x.exp() - x - Tree::from(1);
        let secant = (&a + &a).exp() - Tree::from(2) * &a * a.exp() - Tree::from(1);
        for (of, nested) in [(tangent(&a), false), (tangent(&a) + tangent(&b), true), (secant, true)] {
            let proof = prove(&positive("", of).assuming(&above)).unwrap();
            let Derivation::Direct(direct) = &proof.goals()[0] else { panic!("no proof in one case") };
            let Justification::Sign(signed) = &direct.justification else { panic!("no sign") };
            let text = ProofPrinter::new(&Registry::default()).proof(&proof).join("\n");
            let said = text.matches("by its value at").count();
            assert_eq!((slopes(&signed.num), said > 1), (said, nested), "{text}");
        }
    }

    #[test]
    fn blocks_are_indented_behind_their_bullets() {
        let mut script = Script::new();
        script.line("one.");
        script
            .block("{", |own| {
                own.line("two.");
                own.block("-", |own| {
                    own.line("three.");
                    own.line("four.");
                    Ok(())
                })
            })
            .unwrap();
        script.line("five.");
        assert_eq!(script.into_text(), "  one.\n  { two.\n    - three.\n      four. }\n  five.\n");
    }
}

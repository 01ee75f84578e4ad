//! The proof of a goal as Coq's tactics: the kernel's derivation, retold.
//!
//! What the kernel *found* is used: which quantities to name, into which cases to split, which value a
//! bracket has, and a form of each quantity from which its sign can be read off. None of it is believed:
//! each step is a goal that Coq closes by itself, or does not.

mod limit;

use super::expr::Expr;
use super::print::ascii;
use crate::formula::statement::minimum_precision;
use crate::number::Tree;
use crate::number::tree::Step;
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio, Symbol};
use crate::proof::kernel::sign::{self, Certificate, Known, Rule, Sign};
use crate::proof::kernel::{Because, Derivation, Direct, Signed, Supposed, Used};
use std::fmt::Write;

/// Lines of a proof, and what is known at their end.
#[derive(Clone, Default)]
pub(super) struct Script {
    lines: String,
    indent: usize,
    known: Known,
    /// How many suppositions have been made, and how many of them by splitting.
    supposed: usize,
    cases: usize,
    /// How many hypotheses have been put to use.
    given: usize,
    /// Is it about what is rounded?
    rounds: bool,
}

/// Why a derivation has no script.
pub(super) type Reason = &'static str;

/// Any of the derivations without cases that a derivation ends in: all begin with the same suppositions.
pub(super) fn first(derivation: &Derivation) -> &Direct {
    match derivation {
        Derivation::Direct(direct) => direct,
        Derivation::Cases(_, positive, _) => first(positive),
    }
}

impl Script {
    pub(super) fn new() -> Self {
        Script { indent: 1, ..Script::default() }
    }

    /// For what is rounded: there are other tactics for that.
    pub(super) fn of_roundings() -> Self {
        Script { rounds: true, ..Script::new() }
    }

    pub(super) fn into_text(self) -> String {
        self.lines
    }

    pub(super) fn line(&mut self, text: &str) {
        let _ = writeln!(self.lines, "{:1$}{text}", "", 2 * self.indent);
    }

    /// A part of its own; its names end with it.
    pub(super) fn block(
        &mut self,
        bullet: &str,
        inside: impl FnOnce(&mut Self) -> Result<(), Reason>,
    ) -> Result<(), Reason> {
        let mut own = Script { lines: String::new(), indent: self.indent + 1, ..self.clone() };
        inside(&mut own)?;
        let pad = " ".repeat(2 * self.indent);
        let text = own.lines.trim_start();
        let end = if bullet == "{" { " }\n" } else { "\n" };
        let _ = write!(self.lines, "{pad}{bullet} {}{end}", text.trim_end());
        Ok(())
    }

    /// The whole derivation, from hypotheses H1, H2, …
    pub(super) fn derivation(&mut self, derivation: &Derivation) -> Result<(), Reason> {
        self.hypotheses(first(derivation))?;
        self.cases(derivation)
    }

    /// The hypotheses that come before the next case, put to use.
    fn hypotheses(&mut self, direct: &Direct) -> Result<(), Reason> {
        let next = direct.supposed().iter().skip(self.supposed);
        for supposed in next.take_while(|supposed| supposed.given().is_some()) {
            let says_bits = supposed.given().is_some_and(|given| *given == minimum_precision());
            self.given += usize::from(!says_bits);
            let label = if says_bits { "M".to_string() } else { format!("H{}", self.given) };
            self.suppose(supposed, &label)?;
        }
        Ok(())
    }

    /// One rounded formula is no less than another, from hypotheses H1, H2, …
    pub(super) fn order(&mut self, direct: &Direct, precision: &str) -> Result<(), Reason> {
        let rounds = |supposed: &Supposed| supposed.given().is_some_and(|given| given.value.rounds());
        let says_bits =
            |supposed: &Supposed| supposed.given().is_some_and(|given| *given == minimum_precision());
        let is_solved = |supposed: &Supposed| {
            matches!(supposed.used(), Used::Pivot(..)) && !rounds(supposed) && !says_bits(supposed)
        };
        // Signs of symbols are put to use as they are.
        if direct.supposed().iter().any(is_solved) {
            if direct.supposed().iter().any(rounds) {
                return Err(
                    "an order that rests on one hypothesis to be solved and another about what is rounded",
                );
            }
            self.line(&format!("pose proof (four_at_least prec {precision} P E) as N."));
            self.line(&format!("assert (M : 0 <= {precision} - 4) by lra. clear E."));
            self.hypotheses(direct)?;
            self.line("pivots.");
        }
        self.line("by_order.");
        Ok(())
    }

    fn suppose(&mut self, supposed: &Supposed, hypothesis: &str) -> Result<(), Reason> {
        self.supposed += 1;
        let i = self.supposed;
        let (kind, relation, sign) = match supposed.sign() {
            Sign::Positive => ("positive", "<", Sign::Positive),
            _ => ("nonnegative", "<=", Sign::NonNegative),
        };
        if supposed.divided_by().is_some() {
            return Err("a hypothesis is divided by a quantity");
        }
        match supposed.used() {
            Used::Follows | Used::Kept | Used::Unused => {}
            Used::Between(_, _, place) => {
                let near = supposed.given().is_some_and(|given| given.distance().is_some());
                let (rule, place) = (if near { "near" } else { "between" }, ascii(place.0));
                self.line(&format!("destruct ({rule} _ _ _ {hypothesis}) as ({place} & T{i} & ->)."));
            }
            Used::Symbol(x) => {
                self.known.insert(*x, sign);
                if supposed.given().is_some_and(|given| *given.value.step() == Step::Symbol(x.0)) {
                    return Ok(());
                }
                let name = ascii(x.0);
                self.line(&format!(
                    "assert (P{i} : 0 {relation} {name}) by (apply (same_{kind} _ _ {hypothesis}); {}).",
                    self.same()
                ));
            }
            Used::Pivot(pivot, by, named) => {
                // pivot − by = factor · (the quantity − its name)
                let difference = Ratio::from(Poly::from(pivot.clone())) - by;
                let name = named.map_or(Ratio::zero(), |name| Poly::symbol(name).into());
                let factor =
                    difference.over(&(supposed.value() - name)).ok_or("a hypothesis has no solution")?;
                let (pivot, by, factor) =
                    (Expr::poly(&pivot.clone().into()), Expr::ratio(by), Expr::ratio(&factor).argument());
                if let Some(x) = named {
                    let name = ascii(x.0);
                    self.line(&format!("destruct (named_{kind} _ {hypothesis}) as ({name} & S{i} & P{i})."));
                    self.line(&format!(
                        "assert (E{i} : pivot {} {}) by \
                         (apply (solved_for _ _ {factor} _ _ S{i}); {}).",
                        pivot.argument(),
                        by.argument(),
                        self.same()
                    ));
                    if self.rounds {
                        // The name itself may be replaced later, and not by what it was given to.
                        self.line(&format!("clear S{i}."));
                    }
                    self.known.insert(*x, sign);
                } else if self.rounds {
                    self.line(&format!(
                        "assert (E{i} : pivot {} {}) by (apply (solved _ {factor} _ _ {hypothesis}); {}).",
                        pivot.argument(),
                        by.argument(),
                        self.same()
                    ));
                } else {
                    self.line(&format!(
                        "assert (E{i} : {pivot} = {by}) by \
                         (apply (solved _ {factor} _ _ {hypothesis}); identity)."
                    ));
                }
            }
        }
        Ok(())
    }

    fn cases(&mut self, derivation: &Derivation) -> Result<(), Reason> {
        match derivation {
            Derivation::Direct(direct) => self.direct(direct),
            Derivation::Cases(deciding, positive, not) => {
                self.cases += 1;
                let case = format!("C{}", self.cases);
                self.line(&format!(
                    "destruct (either {}) as [{case} | {case}].",
                    Expr::poly(deciding).argument()
                ));
                for branch in [positive, not] {
                    self.block("{", |own| {
                        let supposed =
                            first(branch).supposed().get(own.supposed).ok_or("a case supposes nothing")?;
                        own.suppose(supposed, &case)?;
                        own.derivation(branch)
                    })?;
                }
                Ok(())
            }
        }
    }

    /// How two formulas are seen to be the same.
    fn same(&self) -> &'static str {
        if self.rounds { "pivots; equal" } else { "identity" }
    }

    fn direct(&mut self, direct: &Direct) -> Result<(), Reason> {
        if self.rounds {
            let of_goal: &[Signed] = match direct.because() {
                Because::Sign(signed) => std::slice::from_ref(signed),
                Because::Within(both) => &both[..],
                Because::Order(_) => return Err("rounding keeps order, case by case"),
                _ => &[],
            };
            let of_divisors = direct.divisors().iter().map(|(_, signed)| signed);
            let of_brackets = direct.brackets().iter().map(|(.., signed)| signed);
            let mut signs = of_goal.iter().chain(of_divisors).chain(of_brackets);
            if signs.clone().any(|signed| signed.less().is_some()) {
                return Err("a hypothesis without a pivot");
            }
            if !signs.all(|signed| has_program(signed.num()) && has_program(signed.den())) {
                return Err("the sign of what is rounded rests on a square or a slope");
            }
            self.line(match direct.because() {
                Because::Within(..) => "pivots. minima. apply within; bounded.",
                _ => "pivots. minima. bounded.",
            });
            return Ok(());
        }
        // A divisor that is itself a quotient, or that hypotheses rewrite, is asked for by its numerator.
        let quotient = |tree: &Tree| tree.any(&|step| matches!(step.step(), Step::Div(..)));
        let rewritten = direct.supposed().iter().any(|s| matches!(s.used(), Used::Pivot(..)));
        let numerators = direct.divisors().iter().filter(|(tree, _)| rewritten || quotient(tree));
        for (i, (_, signed)) in numerators.enumerate() {
            let value = self.positive(signed.num())?;
            self.line(&format!(
                "assert (M{} : {value} <> 0) by (apply positive_not_zero; positivity).",
                i + 1
            ));
        }
        for (i, (bracket, result, signed)) in direct.brackets().iter().enumerate() {
            // All its occurrences are rewritten at once.
            if direct.brackets()[..i].iter().all(|(known, ..)| known != bracket) {
                self.bracket(bracket, result, signed)?;
            }
        }
        match direct.because() {
            Because::Same(_) => self.line("identity."),
            Because::Sign(signed) => {
                let value = self.size(signed)?;
                self.line(&format!("sign_by {}.", value.argument()));
            }
            Because::Derivative(..) => self.line("derivative."),
            Because::Within(..) | Because::Order(_) => return Err("a bound"),
            Because::Limit { .. } => return Err("a limit among other goals"),
        }
        Ok(())
    }

    fn bracket(&mut self, bracket: &Tree, result: &Tree, signed: &Signed) -> Result<(), Reason> {
        let first = signed.sign().implies(Sign::NonNegative);
        let tactic = match (bracket.step(), first) {
            (Step::Min(..), true) => "minimum_first",
            (Step::Min(..), false) => "minimum_second",
            (_, true) => "bracket_open",
            (_, false) => "bracket_shut",
        };
        debug_assert!(!matches!(bracket.step(), Step::Min(a, _) if first != (a == result)), "{bracket}");
        let size = self.size(signed)?;
        self.line(&format!("{tactic} {}.", size.argument()));
        Ok(())
    }

    /// The absolute value of a quotient, in a form that shows that it is not negative.
    pub(super) fn size(&mut self, signed: &Signed) -> Result<Expr, Reason> {
        if signed.less().is_some() {
            return Err("a hypothesis without a pivot");
        }
        Ok(self.positive(signed.num())?.over(self.positive(signed.den())?))
    }

    /// The absolute value of a polynomial, in a form that shows that it is not negative.
    fn positive(&mut self, certificate: &Certificate) -> Result<Expr, Reason> {
        Ok(match certificate.rule() {
            Rule::Terms => Expr::poly(&unsigned(certificate)),
            Rule::Sizes(_) | Rule::Ends { .. } => return Err("a bound by sizes"),
            Rule::Factor(factor, rest) => {
                let factor = self.positive(factor)?;
                factor.times(self.positive(rest)?)
            }
            Rule::Square { leading, root, rest } => {
                let root = Expr::Power(Expr::poly(root).into(), 2);
                let top = if rest.of().is_zero() { root } else { root.plus(self.positive(rest)?) };
                top.over(Expr::Number("4".into()).times(self.positive(leading)?))
            }
            Rule::Slope { x, start, slope } => self.slope(certificate, *x, start, slope)?,
        })
    }

    /// By its value at 0 and its slope: no form shows its sign, so it is proved on the way.
    fn slope(
        &mut self,
        certificate: &Certificate,
        x: Symbol,
        start: &Certificate,
        slope: &Certificate,
    ) -> Result<Expr, Reason> {
        let poly = unsigned(certificate);
        let (f, name) = (Expr::poly(&poly), ascii(x.0));
        let strict = certificate.sign().is_strict();
        let rule = match (strict, start.sign().is_strict()) {
            (true, true) => "rises_from_positive",
            (true, false) => "rises_strictly",
            (false, _) => "rises",
        };
        let relation = if strict { "<" } else { "<=" };
        let mut beyond = self.known.clone();
        beyond.insert(x, Sign::Positive);
        let derivative = poly.derivative(x);
        let (at_zero, above_zero) =
            (poly.replace(&Monomial::of(x), &Ratio::zero()), below(&derivative, &beyond)?);
        self.line(&format!("assert (0 {relation} {f})."));
        self.block("{", |own| {
            own.line(&format!(
                "apply ({rule} (fun {name} => {f}) (fun {name} => {}) {name}); cbv beta.",
                Expr::ratio(&derivative)
            ));
            own.block("-", |own| {
                own.line("positivity.");
                Ok(())
            })?;
            own.block("-", |own| {
                let below = below(&at_zero, &own.known)?;
                let value = own.positive(start)?.over(own.positive(&below)?);
                own.line(&format!("sign_by {}.", value.argument()));
                Ok(())
            })?;
            // The same letter for another value.
            let again = format!("let other := fresh in rename {name} into other; intros {name} ?.");
            own.block("-", |own| {
                own.line(&again);
                own.line("derivative.");
                Ok(())
            })?;
            own.block("-", |own| {
                own.line(&again);
                own.known = beyond.clone();
                let value = own.positive(slope)?.over(own.positive(&above_zero)?);
                own.line(&format!("sign_by {}.", value.argument()));
                Ok(())
            })
        })?;
        Ok(f)
    }
}

/// Returns `true` if the program of `B_Polynomials` has all rules of a certificate.
fn has_program(certificate: &Certificate) -> bool {
    match certificate.rule() {
        Rule::Terms => true,
        Rule::Square { .. } | Rule::Slope { .. } => false,
        Rule::Factor(factor, rest) => has_program(factor) && has_program(rest),
        Rule::Sizes(rest) => has_program(rest),
        Rule::Ends { at, .. } => at.iter().all(has_program),
    }
}

fn below(value: &Ratio, known: &Known) -> Result<Certificate, Reason> {
    sign::sign(value.den(), known).ok_or("the sign of a divisor is open")
}

/// A polynomial or its opposite, whichever is not negative.
fn unsigned(certificate: &Certificate) -> Poly {
    match certificate.sign() {
        Sign::Negative | Sign::NonPositive => -certificate.of(),
        Sign::Zero | Sign::NonNegative | Sign::Positive => certificate.of().clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_stands_to_the_right_of_its_bullet() {
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

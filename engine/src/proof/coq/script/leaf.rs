//! Leaves of proofs: the steps of the checker, one by one.

use super::super::expr::Expr;
use super::super::lemma::Result;
use super::super::print::ascii;
use super::{Script, Target};
use crate::formula::claim::SCALES;
use crate::number::tree::Op;
use crate::proof::check::{Atom, Certificate, Law, Polynomial, Sign, State, Step};

/// A fact in the place of one that is not in scope.
const NO_FACT: &str = r#"Squared """#;

/// The steps of a leaf as they are written in Coq: data, and proofs of what is assumed.
pub(super) struct Writer<'w> {
    target: &'w Target<'w>,
    /// The knowledge of the checker after the steps so far.
    pub(super) state: State<'w>,
    /// Whether the atoms are in scope.
    is_known: Vec<bool>,
    items: Vec<String>,
    /// The rounded formulas whose equations are listed.
    rounded: Vec<usize>,
}

/// Returns a list in Coq.
pub(super) fn list<W: AsRef<str>>(items: impl IntoIterator<Item = W>) -> String {
    let items = items.into_iter().map(|item| item.as_ref().to_string());
    format!("[{}]", items.collect::<Vec<_>>().join("; "))
}

fn numbers(all: &[usize]) -> String {
    format!("{}%nat", list(all.iter().map(usize::to_string)))
}

/// Returns a polynomial as text: terms with signs, and a character for each variable.
pub(super) fn text(of: &Polynomial) -> String {
    let mut terms = Vec::new();
    for (powers, coefficient) in of.terms() {
        let factors = powers.iter().zip(b'?'..).filter(|(n, _)| **n > 0);
        let factors = factors.map(|(n, x)| format!("{}{}", char::from(x), unless_one((*n).into())));
        let sign = if coefficient.is_negative() { '-' } else { '+' };
        let number = unless_one(coefficient.unsigned_abs());
        terms.push(format!("{sign}{number}{}", factors.collect::<String>()));
    }
    format!("\"{}\"", terms.join(" "))
}

fn unless_one(n: u128) -> String {
    if n == 1 { String::new() } else { n.to_string() }
}

impl<'w> Writer<'w> {
    pub(super) fn new(
        target: &'w Target<'w>,
        cases: &[(Polynomial, Sign)],
        is_known: impl Fn(usize) -> bool,
    ) -> Result<Self> {
        let state = State::new(target.problem, cases)?;
        let is_known: Vec<_> = (0..target.problem.table.atoms().len()).map(is_known).collect();
        let atoms = target.problem.table.atoms().iter().enumerate();
        let named =
            atoms.filter(|(x, atom)| is_known[*x] && matches!(atom, Atom::Exponential(_) | Atom::Size(_)));
        let items =
            named.map(|(x, _)| format!("F{x}")).chain((1..=cases.len()).map(|i| format!("C{i}"))).collect();
        Ok(Writer { target, state, is_known, items, rounded: Vec::new() })
    }

    /// Returns the call of a tactic with what is known.
    pub(super) fn call(&self, tactic: &str) -> String {
        let table = &self.target.problem.table;
        let kinds = self.is_known.iter().enumerate().map(|(x, is_known)| match table.sign(x) {
            _ if !is_known => "Any".into(),
            _ if table.is_unit(x) => "Unit".into(),
            _ if self.target.positive == Some(x) => "Positive".into(),
            sign => format!("{sign:?}"),
        });
        let kinds = list(kinds.map(|kind| format!("A_Polynomials.{kind}")));
        let kinds = if self.is_known.is_empty() { "(@nil A_Polynomials.kind)" } else { &kinds };
        let env = self.target.environment(|x| self.is_known[x]);
        let items: String = self.items.iter().map(|item| format!(", {item}")).collect();
        let items = if items.is_empty() { "tt".into() } else { format!("(tt{items})") };
        format!("{tactic} {env} {kinds} {items}")
    }

    /// Adds a proof of what is assumed.
    pub(super) fn add(&mut self, proof: String) {
        self.items.push(proof);
    }

    /// Writes steps of the checker.
    pub(super) fn steps(&mut self, steps: &[Step]) -> Result<()> {
        steps.iter().try_for_each(|step| self.step(step))
    }

    fn step(&mut self, step: &Step) -> Result<()> {
        let fact = self.state.facts.iter().len();
        self.state.apply(step)?;
        self.list_roundings()?;
        let added = self.state.facts.get(fact).ok().cloned();
        let is_in_scope = added.as_ref().is_none_or(|(of, _)| of.has_only(|x| self.is_known[x]));
        match step {
            Step::Assume(i) if added.is_none() => {
                let x = self.target.variable(Atom::IntervalParameter(*i))?;
                self.items.push(format!("F{x}"));
                // Formulas are translated again.
                self.rounded.clear();
            }
            Step::Divisor(factors) => self.divide(factors),
            _ if !is_in_scope => self.items.push(NO_FACT.into()),
            Step::Assume(i) => {
                let label = self.target.label(*i);
                self.items.push(
                    label.ok_or("the variable of a limit has other hypotheses than lower bounds")?.into(),
                );
            }
            Step::Show(of, Certificate { known, left, right }) => {
                let identity = format!("(identity {} {} {})", numbers(known), text(left), text(right));
                self.items.push(format!("Shown {} {identity}", text(of)));
            }
            Step::Square(of) => self.items.push(format!("Squared {}", text(of))),
            Step::Law(law) => {
                let item = self.law(law)?;
                self.items.push(item);
            }
        }
        if self.is_smooth() && is_in_scope && added.is_some_and(|(_, sign)| sign.is_strict()) {
            self.divide(&[fact]);
        }
        Ok(())
    }

    fn is_smooth(&self) -> bool {
        self.target.tactic != "shown"
    }

    /// Lists a divisor by its factors, and its square, which occurs in derivatives.
    pub(super) fn divide(&mut self, factors: &[usize]) {
        self.items.push(format!("Divisor {}", numbers(factors)));
        if self.is_smooth() {
            self.items.push(format!("Divisor {}", numbers(&[factors, factors].concat())));
        }
    }

    /// Lists the equations of the rounded formulas that were translated since.
    fn list_roundings(&mut self) -> Result<()> {
        let table = &self.target.problem.table;
        for (rounded, op) in (0..).map_while(|i| Some((i, table.op(i).ok()?))) {
            let Op::Rounded(of) = op else { continue };
            if !self.state.has_value(rounded) || self.rounded.contains(&rounded) {
                continue;
            }
            self.rounded.push(rounded);
            let (powers, unscaled) = table.rounding(of);
            let x = self.target.variable(Atom::Error(unscaled))?;
            self.items.push(format!("F{x}"));
            if unscaled != of {
                let [down, up] = [-1, 1].map(|sign| product_of_scales(powers.map(|n| sign * n)));
                let (of, unscaled) = (self.target.formula(of)?, self.target.formula(unscaled)?);
                let powers = "ltac:(power_of_two) ltac:(power_of_two)";
                self.items
                    .push(format!("same_error prec choice {down} {up} {of} {unscaled} _ _ {powers} F{x}"));
            }
        }
        Ok(())
    }

    /// Returns the proof of an instance of a law.
    fn law(&mut self, law: &Law) -> Result<String> {
        let target = self.target;
        let size = |of: usize| target.variable(Atom::Size(of));
        Ok(match law {
            Law::Exponents { left, right } => {
                let [left, right] = [left, right].map(|all| product_of_exponentials(all));
                format!("same_exponents _ _ _ _ {left} {right}")
            }
            Law::AboveTangent(x) => {
                let exponent = self.state.exponent(*x)?;
                let signs = [(Sign::Positive, "_right"), (Sign::Negative, "_left")];
                let side = signs.into_iter().find(|(sign, _)| self.state.facts.have(&exponent, *sign));
                format!("above_tangent{} _ _ F{x}", side.map_or("", |(_, side)| side))
            }
            Law::BelowPole(x) => {
                let exponent = self.state.exponent(*x)?;
                let is_strict = self.state.facts.have(&exponent, Sign::Positive);
                format!("below_pole{} _ _ F{x}", if is_strict { "" } else { "_or_at_0" })
            }
            Law::AbsoluteValue(of) => format!("F{}", target.variable(Atom::Factor(*of))?),
            Law::Signed(of) => {
                let value = self.state.value(*of)?;
                let is_positive = self.state.facts.have(&value, Sign::NonNegative);
                format!("{}_size _ _ F{}", if is_positive { "own" } else { "negated" }, size(*of)?)
            }
            Law::Order(rounded) => {
                let [a, b] = rounded.map(|rounded| match target.problem.table.op(rounded)? {
                    Op::Rounded(of) => target.formula(of),
                    _ => Err("an order of other formulas than rounded ones".into()),
                });
                format!("ordered prec choice {} {} P", a?, b?)
            }
        })
    }
}

/// Returns the proof of e to the power of a sum as a product of exponentials.
fn product_of_exponentials(all: &[usize]) -> String {
    let factors = all.iter().map(|x| format!("F{x}"));
    factors.reduce(|product, factor| format!("(both _ _ _ _ {product} {factor})")).unwrap_or("exp_0".into())
}

/// Returns a product of scales to those powers that are positive, as an argument.
fn product_of_scales(powers: [i32; 3]) -> String {
    let factors =
        SCALES.iter().zip(powers).flat_map(|(scale, n)| (0..n).map(move |_| Expr::name(ascii(scale))));
    factors.fold(Expr::int(1), Expr::times).argument()
}

impl Script {
    /// Proves the goal at a leaf.
    pub(super) fn leaf(
        &mut self,
        target: &Target,
        steps: &[Step],
        cases: &[(Polynomial, Sign)],
    ) -> Result<()> {
        let mut writer = Writer::new(target, cases, |_| true)?;
        writer.steps(steps)?;
        writer.state.proves_goal()?;
        writer.list_roundings()?;
        self.line(&format!("{}.", writer.call(target.tactic)));
        Ok(())
    }
}

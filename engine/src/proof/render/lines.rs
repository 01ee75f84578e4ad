//! The proof of a goal as lines of text: one for each certificate l f = r, in which s₁, s₂, … are facts.

use super::ProofPrinter;
use super::text::{number, sign_text, sum};
use crate::formula::claim::PRECISION;
use crate::formula::name_of_rounding;
use crate::formula::statement::Proposition;
use crate::formula::symbols::subscripted;
use crate::number::tree::Op;
use crate::number::{Exponential, PositivePart, Tree};
use crate::proof::check::{
    Atom, Certificate, Law, Node, Polynomial, Problem, Quotient, Refusal, Sign, State, Step,
};
use std::collections::BTreeMap;

/// Maximum numbers of characters and of terms of a formula in place of which its shape is written.
const LONG: usize = 100;
const MOST: usize = 16;

/// Lines, or the reason for which the checker refuses the proof.
type Result<T> = std::result::Result<T, Refusal>;

/// A writer of the proof of a goal.
pub(super) struct Lines<'a> {
    printer: &'a ProofPrinter<'a>,
    problem: &'a Problem<'a>,
    /// The atoms as formulas; e₁, e₂, … are errors, and t₁, t₂, … interval parameters and factors.
    atoms: Vec<Tree>,
}

/// The facts that are named at a leaf.
type Names = BTreeMap<usize, Tree>;

/// A step, the number of the fact that it adds, and the values that are decided with it.
type Added<'s> = (&'s Step, usize, Vec<String>);

impl<'a> Lines<'a> {
    /// Returns a writer for a goal.
    pub(super) fn new(printer: &'a ProofPrinter<'a>, problem: &'a Problem<'a>) -> Self {
        let (mut errors, mut parameters) = (0.., 0..);
        let formula = |of: usize| problem.table.formula(of).map_or_else(|_| Tree::from(0), Tree::clone);
        let atoms = problem.table.atoms().iter().map(|atom| match atom {
            Atom::Own(name) => Tree::symbol(name),
            Atom::Error(_) => Tree::symbol(subscripted('e', errors.next().unwrap_or_default())),
            Atom::IntervalParameter(_) | Atom::Factor(_) => {
                Tree::symbol(subscripted('t', parameters.next().unwrap_or_default()))
            }
            Atom::Size(of) => formula(*of).abs(),
            Atom::Exponential(of) => formula(*of).exp(),
        });
        Lines { printer, problem, atoms: atoms.collect() }
    }

    /// Describes the atoms.
    #[cfg(feature = "serde")]
    pub(super) fn descriptions(&self) -> Vec<String> {
        let atoms = self.atoms.iter().zip(self.problem.table.atoms());
        let described = atoms.map(|(tree, atom)| match atom {
            Atom::Own(_) | Atom::Size(_) | Atom::Exponential(_) => self.text(tree),
            Atom::Error(of) => format!("{tree}: {}", self.rounding(*of)),
            Atom::Factor(of) => format!("{tree}: {0} = {tree} |{0}|", self.formula(*of)),
            Atom::IntervalParameter(i) => {
                let interval = self.printer.registry.format_hypothesis(self.problem.hypotheses[*i]);
                format!("{tree}: from −1 to 1 in {interval}")
            }
        });
        described.collect()
    }

    /// Returns the lines of a proof under the assumptions of cases.
    pub(super) fn node(&self, node: &Node, cases: &mut Vec<(Polynomial, Sign)>) -> Result<Vec<String>> {
        let (on, both) = match node {
            Node::Leaf(steps) => return self.leaf(steps, cases),
            Node::Cases(on, both) => (on, both),
        };
        let mut lines = Vec::new();
        for (node, sign) in both.iter().zip([Sign::Positive, Sign::NonPositive]) {
            let name = subscripted('s', u8::try_from(cases.len()).unwrap_or(u8::MAX));
            lines.push(format!("case {name} = {} {}:", self.polynomial(on, &[]), sign_text(sign)));
            cases.push((on.clone(), sign));
            lines.extend(self.node(node, cases)?.into_iter().map(|line| format!("  {line}")));
            cases.pop();
        }
        Ok(lines)
    }

    fn leaf(&self, steps: &[Step], cases: &[(Polynomial, Sign)]) -> Result<Vec<String>> {
        let (mut state, mut decided) = (State::new(self.problem, cases)?, Vec::new());
        let mut added = Vec::with_capacity(steps.len());
        for step in steps {
            let fact = state.facts.iter().len();
            state.apply(step)?;
            added.push((step, fact, self.branches(&mut decided, &mut state)?));
        }
        state.proves_goal()?;
        let last = self.branches(&mut decided, &mut state)?;
        let goals: Vec<_> = self.goals(&mut state)?.into_iter().map(|(_, goal)| goal.num).collect();
        let names = self.names(&state, &added, cases.len(), &goals);
        let (mut lines, mut long) = (Vec::from_iter(self.errors()), 0);
        for (step, fact, branches) in added {
            lines.extend(branches);
            match step {
                Step::Show(of, _) if self.form(of, &[]).is_none() && !goals.contains(of) => long += 1,
                _ => lines.extend(self.step(step, &state, fact, &names)),
            }
        }
        if long > 0 {
            lines.push(format!("other signs of long sums: {long}, by identities in --format json"));
        }
        lines.extend(last);
        lines.extend(self.goal(&mut state, &names)?);
        Ok(lines)
    }

    /// Returns the names of facts: those that certificates refer to, assumptions, and the goal.
    fn names(&self, state: &State, added: &[Added], cases: usize, goals: &[Polynomial]) -> Names {
        let mut named: Vec<_> = (1..=cases).collect();
        for (step, fact, _) in added {
            match step {
                Step::Show(_, certificate) => named.extend(&certificate.known),
                Step::Assume(i) if self.problem.hypotheses[*i].interval().is_none() => {
                    named.extend(
                        state.facts.get(*fact).is_ok_and(|(of, _)| of.terms().len() > 1).then_some(*fact),
                    );
                }
                _ => {}
            }
        }
        let facts = state.facts.iter().enumerate().filter(|(i, (of, _))| {
            let is_goal = of.terms().len() > 1 && goals.contains(of);
            (is_goal || named.contains(i)) && !of.has_only(|_| false)
        });
        facts.zip(0..).map(|((i, _), number)| (i, Tree::symbol(subscripted('s', number)))).collect()
    }

    /// Returns the quantities whose signs prove the goal, each after what they are.
    fn goals(&self, state: &mut State) -> Result<Vec<(&'static str, Quotient)>> {
        Ok(match (self.problem.proposition, &self.problem.goal[..]) {
            // The line about a numerator of several terms is one about the goal.
            (Proposition::Sign(..), [of, ..]) => {
                let of = state.value(*of)?;
                if of.den.is_empty() && of.num.terms().len() > 1 { Vec::new() } else { vec![("it", of)] }
            }
            (Proposition::Within(..), [of, bound]) => {
                let (of, bound) = (state.value(*of)?, state.value(*bound)?);
                let (less, more) = (state.facts.sum(&bound, -1, &of)?, state.facts.sum(&bound, 1, &of)?);
                vec![("the bound − it", less), ("the bound + it", more)]
            }
            (Proposition::Equal(..), [a, b]) => {
                let (a, b) = (state.value(*a)?, state.value(*b)?);
                let difference = state.facts.sum(&a, -1, &b)?;
                if difference.num.is_zero() { Vec::new() } else { vec![("the difference", difference)] }
            }
            _ => Vec::new(),
        })
    }

    /// Returns the line about rounded formulas.
    fn errors(&self) -> Option<String> {
        let atoms = self.atoms.iter().zip(self.problem.table.atoms());
        let errors = atoms.filter_map(|(tree, atom)| match atom {
            Atom::Error(of) => Some(format!("{tree} of {}", self.rounding(*of))),
            _ => None,
        });
        let errors = errors.collect::<Vec<_>>().join(", ");
        (!errors.is_empty())
            .then(|| format!("fl(…) = … (1 + eᵢ / ({PRECISION} + 1)) with |eᵢ| ≤ 1: {errors}"))
    }

    /// Returns the values of short minima and positive parts that were decided since, and adds these to those before.
    fn branches(&self, decided: &mut Vec<usize>, state: &mut State) -> Result<Vec<String>> {
        decided.retain(|i| state.has_value(*i));
        let mut lines = Vec::new();
        for (i, op) in (0..).map_while(|i| Some((i, self.problem.table.op(i).ok()?))) {
            let (first, second) = match op {
                Op::Min(a, b) if self.problem.table.op(a) == Ok(Op::Neg(b)) => continue,
                Op::PositivePart(of) => (of, None),
                Op::Min(a, b) => (a, Some(b)),
                _ => continue,
            };
            if decided.contains(&i) || !state.has_value(i) {
                continue;
            }
            decided.push(i);
            let is_first = state.value(i)? == state.value(first)?;
            let branch = if is_first { Some(first) } else { second };
            let value = branch.map_or("0".into(), |of| self.formula(of));
            let line = format!("{} = {value}", self.formula(i));
            if line.chars().count() <= LONG {
                lines.push(line);
            }
        }
        Ok(lines)
    }

    /// Returns the line about a step that adds the fact with this number.
    fn step(&self, step: &Step, state: &State, fact: usize, names: &Names) -> Option<String> {
        let line = match step {
            // Neither of these adds a fact.
            Step::Divisor(_) => return None,
            Step::Assume(i) if self.problem.hypotheses[*i].interval().is_some() => return self.interval(*i),
            Step::Show(of, certificate) if of.terms().len() > 1 => self.shown(of, certificate, names),
            Step::Law(Law::Order([a, b])) => {
                return Some(format!("{} ≥ {}, as rounding is monotone", self.formula(*a), self.formula(*b)));
            }
            Step::Law(Law::Exponents { .. }) => ", as the exponents have the same sum".to_string(),
            Step::Law(Law::AboveTangent(_)) => ", as exp(x) > 1 + x for x ≠ 0".to_string(),
            Step::Law(Law::BelowPole(_)) => ", as (2 − x) exp(x) < 2 + x for x > 0".to_string(),
            Step::Law(Law::AbsoluteValue(of)) => {
                let t = &self.atoms[self.problem.table.variable(Atom::Factor(*of)).ok()?];
                format!(", as {0} = {t} |{0}| with |{t}| ≤ 1", self.formula(*of))
            }
            Step::Law(Law::Signed(_)) => ", as |x| is x or −x".to_string(),
            Step::Assume(i) => {
                format!(" by {}", self.printer.registry.format_hypothesis(self.problem.hypotheses[*i]))
            }
            _ => String::new(),
        };
        let name = names.get(&fact);
        let is_plain = match step {
            Step::Law(_) => false,
            Step::Show(of, _) => of.terms().len() <= 1,
            _ => true,
        };
        if name.is_none() && is_plain {
            return None;
        }
        let (of, sign) = state.facts.get(fact).ok()?;
        let name = name.map_or(String::new(), |name| format!("{} = ", self.text(name)));
        Some(format!("{name}{} {}{line}", self.polynomial(of, &[]), sign_text(*sign)))
    }

    /// Returns the identity of a certificate: `, as c s₁ = s₂ + e₁`.
    fn shown(&self, of: &Polynomial, certificate: &Certificate, names: &Names) -> String {
        let Certificate { known, left, right } = certificate;
        let facts: Vec<_> =
            known.iter().map(|i| names.get(i).cloned().unwrap_or_else(|| Tree::from(2))).collect();
        let [left_text, right_text] = [left, right].map(|form| self.polynomial(form, &facts));
        let table = &self.problem.table;
        let has_units = [left, right].iter().any(|form| !form.has_only(|x| !table.is_unit(x)));
        let bounds = if has_units { " with |eᵢ|, |tᵢ| ≤ 1" } else { "" };
        match () {
            () if *right == *of => bounds.replace(" with", " for"),
            () if *left == Polynomial::constant(1) => format!(", as it is {right_text}{bounds}"),
            () => format!(", as {left_text} times it is {right_text}{bounds}"),
        }
    }

    /// Returns the use of an interval.
    fn interval(&self, i: usize) -> Option<String> {
        let hypothesis = self.problem.hypotheses[i];
        let (x, lower, upper) = hypothesis.interval()?;
        let t = &self.atoms[self.problem.table.variable(Atom::IntervalParameter(i)).ok()?];
        let (lower, upper) = (self.text(lower), self.text(upper));
        let by = self.printer.registry.format_hypothesis(hypothesis);
        Some(format!("by {by}: {t} goes from −1 to 1 as {x} goes from {lower} to {upper}"))
    }

    /// Returns the lines about the goal.
    fn goal(&self, state: &mut State, names: &Names) -> Result<Vec<String>> {
        let goals = self.goals(state)?;
        let [a, b, ..] = &self.problem.goal[..] else {
            return Ok(goals.iter().map(|(name, of)| self.signed(name, of, state, names)).collect());
        };
        let (a, b) = (state.value(*a)?, state.value(*b)?);
        Ok(match self.problem.proposition {
            Proposition::Limit(_, by, _) => {
                let (of, to) = (self.quotient(&a, state, names), self.quotient(&b, state, names));
                let atoms = self.problem.table.atoms().iter().enumerate();
                let mut exponentials = atoms.filter(|(_, atom)| matches!(atom, Atom::Exponential(_)));
                let decays = exponentials.any(|(x, _)| a.num.degree(x) > 0 && self.problem.varies(x));
                let decay = if decays { ", as its exponentials decay" } else { "" };
                vec![format!("it is {of}, which tends to {to} by its degrees in {by}{decay}")]
            }
            Proposition::Equal(..) if goals.is_empty() => {
                let shorter = if a.num.terms().len() <= b.num.terms().len() { &a } else { &b };
                vec![format!("both sides are {}", self.quotient(shorter, state, names))]
            }
            Proposition::Derivative(..) => {
                vec![format!("the derivative is {}", self.quotient(&b, state, names))]
            }
            _ => goals.iter().map(|(name, of)| self.signed(name, of, state, names)).collect(),
        })
    }

    fn signed(&self, name: &str, of: &Quotient, state: &State, names: &Names) -> String {
        let signs = [Sign::Zero, Sign::Positive, Sign::NonNegative];
        let sign = signs.into_iter().find(|sign| state.facts.have(of, *sign)).map_or("", sign_text);
        format!("{name} is {} {sign}", self.quotient(of, state, names))
    }

    /// Formats a quotient, or its shape if it is long.
    fn quotient(&self, of: &Quotient, state: &State, names: &Names) -> String {
        let formula = |of: &Polynomial| {
            let i = state.facts.iter().position(|(known, _)| known == of);
            i.and_then(|i| names.get(&i).cloned()).or_else(|| self.form(of, &[]))
        };
        let factors = of.den.iter().map(|i| formula(&state.facts.get(*i).ok()?.0));
        let (num, den) = (formula(&of.num), factors.collect::<Option<Vec<_>>>());
        match (num, den.map(|den| den.into_iter().reduce(|a, b| a * b))) {
            (Some(num), Some(Some(den))) if !of.num.is_zero() => self.text(&(num / den)),
            (Some(num), Some(_)) => self.text(&num),
            _ => format!("{} over a product of {} factors", self.polynomial(&of.num, &[]), of.den.len()),
        }
    }

    fn text(&self, tree: &Tree) -> String {
        self.printer.text(tree)
    }

    fn rounding(&self, of: usize) -> String {
        let name = self.problem.table.formula(of).map_or("", name_of_rounding);
        format!("{name}({})", self.formula(of))
    }

    fn formula(&self, i: usize) -> String {
        self.problem.table.formula(i).map(|tree| self.text(tree)).unwrap_or_default()
    }

    /// Formats a polynomial of atoms and, after these, known quantities, or its shape if it is long.
    fn polynomial(&self, of: &Polynomial, known: &[Tree]) -> String {
        self.form(of, known)
            .map_or_else(|| format!("a sum of {} terms", of.terms().len()), |tree| self.text(&tree))
    }

    /// Returns a polynomial of atoms and, after these, known quantities, as a formula, if it is short.
    fn form(&self, of: &Polynomial, known: &[Tree]) -> Option<Tree> {
        if of.terms().len() > MOST {
            return None;
        }
        let order = self.printer.registry.factors();
        let terms: Vec<_> = of.terms().collect();
        let tree = sum(terms.into_iter().rev().map(|(powers, n)| {
            let factors = self.atoms.iter().chain(known).zip(powers);
            let mut factors: Vec<_> =
                factors.flat_map(|(factor, n)| std::iter::repeat_n(factor, usize::from(*n))).collect();
            factors.sort_by_key(|factor| match factor.op() {
                Op::Symbol(name) => (order.iter().position(|symbol| symbol == name), *name),
                _ => (Some(order.len()), ""),
            });
            let size = number(&n.unsigned_abs().into());
            let product = factors.into_iter().cloned().reduce(|a, b| a * b);
            (n.is_negative(), product.map_or(size.clone(), |product| size * product))
        }));
        (self.text(&tree).chars().count() <= LONG).then_some(tree)
    }
}

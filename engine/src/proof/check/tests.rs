//! Certificates by hand, and forged ones.

use super::*;
use crate::formula::Hypothesis;
use crate::formula::Relation;
use crate::formula::claim::{derivative, equal, non_negative, positive, within};
use crate::formula::statement::Goal;
use crate::number::Tree;
use crate::number::tree::Op;
use crate::number::{Exponential, PositivePart};
use crate::proof::effort::Effort;

mod forms;
mod limits;
mod premises;
mod rules;

/// A forged proof: its flaw, the statement, the proof of its goals, and the reason for which it is refused.
type Forged = (&'static str, Statement, Vec<Node>, Refusal);

/// Returns a forged proof of one goal without cases.
fn forged(flaw: &'static str, claim: &Statement, steps: Vec<Step>, refusal: Refusal) -> Forged {
    (flaw, claim.clone(), vec![Node::Leaf(steps)], refusal)
}

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn n(n: i32) -> Tree {
    Tree::from(n)
}

fn above_zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::Positive, value.into())
}

fn not_below_zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, value.into())
}

fn zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::Zero, value.into())
}

/// Writes polynomials of the atoms of a goal as formulas.
struct Page<'a>(Sequent<'a>);

impl<'a> Page<'a> {
    /// Returns the page for the first goal.
    fn of(statement: &'a Statement) -> Self {
        Page::of_goal(statement, &statement.goals()[0])
    }

    fn of_goal(statement: &'a Statement, goal: &'a Goal) -> Self {
        Page(Sequent::new(&goal.proposition, statement.hypotheses_for(goal.role)).unwrap())
    }

    /// Returns the number of an atom or of a fact of a certificate: z₁ is the first fact, e₁ the
    /// first error, t₁ the first interval parameter, S₁ and F₁ the first absolute value and its factor, and
    /// E₁ the first exponential, which its reciprocal follows.
    fn variable(&self, name: &'static str) -> usize {
        let atoms = &self.0.table.atoms;
        let mut letters = name.chars();
        let (letter, digit) = (letters.next().unwrap(), letters.next());
        let number = digit.and_then(|digit| u32::from(digit).checked_sub(u32::from('₁')));
        let Some(number) = number.filter(|n| *n < 9).map(|n| n as usize) else {
            return self.0.table.variable(Atom::Own(name)).unwrap();
        };
        let is_of_kind = |atom: &Atom| match letter {
            'e' => matches!(atom, Atom::Error(_)),
            't' => matches!(atom, Atom::IntervalParameter(_)),
            'E' => matches!(atom, Atom::Exponential(_)),
            'S' => matches!(atom, Atom::Size(_)),
            'F' => matches!(atom, Atom::Factor(_)),
            _ => false,
        };
        let mut of_kind = atoms.iter().enumerate().filter(|(_, atom)| is_of_kind(atom));
        if letter == 'z' { atoms.len() + number } else { of_kind.nth(number).unwrap().0 }
    }

    fn poly(&self, of: impl Into<Tree>) -> Polynomial {
        match of.into().op() {
            Op::Symbol(name) => Polynomial::variable(self.variable(name)).unwrap(),
            Op::Int(n) => Polynomial::constant((*n).into()),
            Op::Neg(a) => self.poly(Tree::from(0) - a),
            Op::Add(a, b) => self.poly(a).plus_multiple(1, &self.poly(b), &self.0.effort).unwrap(),
            Op::Sub(a, b) => self.poly(a).plus_multiple(-1, &self.poly(b), &self.0.effort).unwrap(),
            Op::Mul(a, b) => self.poly(a).times(&self.poly(b), &self.0.effort).unwrap(),
            _ => panic!("not a polynomial"),
        }
    }

    /// Returns the step that shows a polynomial f, with l f = r and these facts.
    fn show(
        &self,
        of: impl Into<Tree>,
        known: &[usize],
        left: impl Into<Tree>,
        right: impl Into<Tree>,
    ) -> Step {
        let certificate = Certificate { known: known.into(), left: self.poly(left), right: self.poly(right) };
        Step::Show(self.poly(of), certificate)
    }

    /// Returns the step that shows a polynomial which is a form itself.
    fn form(&self, of: impl Into<Tree>) -> Step {
        let of = of.into();
        self.show(of.clone(), &[], 1, of)
    }

    /// Returns the number of a formula of the goal.
    fn formula(&self, of: &Tree) -> usize {
        (0..).find(|i| self.0.table.formula(*i).unwrap() == of).unwrap()
    }
}

/// Returns the steps that assume the first hypotheses.
fn assume(count: usize) -> Vec<Step> {
    (0..count).map(Step::Assume).collect()
}

/// Returns a proof of one goal without cases, from the first hypotheses.
fn leaf(count: usize, steps: Vec<Step>) -> Node {
    Node::Leaf([assume(count), steps].concat())
}

fn cases(on: Polynomial, positive: Node, other: Node) -> Node {
    Node::Cases(on, [positive, other].into())
}

/// Checks that a proof by hand is accepted.
#[track_caller]
fn accept(statement: &Statement, goals: &[Node]) {
    let checked = check(statement, goals);
    assert!(checked.is_ok(), "{}", checked.unwrap_err());
}

/// Checks that all forged proofs are refused, each for its reason.
#[track_caller]
fn refuse(all: Vec<Forged>) {
    let wrong =
        all.into_iter().filter_map(|(flaw, statement, goals, expected)| match check(&statement, &goals) {
            Err(CheckError::Goal(_, reason)) if reason == expected => None,
            Err(other) => Some(format!("{flaw}: {other}, and not {expected:?}")),
            Ok(_) => Some(format!("{flaw}: accepted")),
        });
    let wrong: Vec<_> = wrong.collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

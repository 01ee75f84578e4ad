//! The formulas of a goal, and the atoms of its polynomials.

use super::polynomial::MAX_VARIABLES;
use super::sign::Sign;
use super::{Checked, Refusal};
use crate::formula::Hypothesis;
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::statement::Proposition;
use crate::number::tree::{Op, smooth_ops};
use crate::number::{Dual, Tree};
use crate::proof::effort::Effort;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// A variable of polynomials, and the real number that it stands for.
///
/// Where a formula is undefined, an error or exponential of it may be any number of the stated kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Atom {
    /// A symbol of the statement.
    Own(&'static str),
    /// The relative error of the formula with this number when it is rounded, divided by its maximum: e with
    /// −1 ≤ e ≤ 1 and fl(x) = x (1 + e/(2ᵖ + 1)).
    Error(usize),
    /// e to the power of the formula with this number.
    Exponential(usize),
    /// The absolute value of the formula with this number.
    Size(usize),
    /// The parameter of a symbol in the interval of the hypothesis with this number: t with −1 ≤ t ≤ 1 such that
    /// the symbol is the midpoint plus t times half the length.
    IntervalParameter(usize),
    /// The factor of the formula with this number: t with −1 ≤ t ≤ 1 such that the formula is t times its
    /// absolute value.
    Factor(usize),
}

/// The powers of scales in a formula, and the number of the formula without them.
type Scaled = ([i32; 3], usize);

/// The distinct formulas of a goal, each after its operands, and its atoms.
///
/// Formulas are compared by their operations, not by their place in memory, so equal formulas have the same
/// number however a statement is built.
#[derive(Debug, Default)]
pub struct Table {
    formulas: Vec<(Op<usize>, Tree)>,
    numbers: FxHashMap<Op<usize>, usize>,
    /// All atoms in order.
    pub atoms: Vec<Atom>,
    /// The formulas as multiples of those without scales.
    scaled: Vec<Option<Scaled>>,
}

/// A sequent: a proposition to be proved from hypotheses.
///
/// Its atoms are the same at all leaves of its proof. They follow from the proposition and the hypotheses
/// alone, so a quantity that distinguishes two cases is the same in both.
#[derive(Debug)]
pub struct Sequent<'a> {
    /// The proposition.
    pub proposition: &'a Proposition,
    /// The hypotheses.
    pub hypotheses: Vec<&'a Hypothesis>,
    /// The numbers of the values of the hypotheses.
    pub values: Vec<usize>,
    /// The symbols of the hypotheses that are intervals, and the numbers of the bounds.
    pub intervals: Vec<Option<(&'static str, [usize; 2])>>,
    /// The numbers of the formulas of the proposition, and of the derivative that it is about.
    pub goal: Vec<usize>,
    /// The formulas and atoms.
    pub table: Table,
    /// The effort that is left for its proof.
    pub effort: Effort,
}

impl Table {
    /// Adds a formula, operands first, and returns its number.
    fn add(&mut self, tree: &Tree) -> usize {
        let (mut numbers, mut last) = (FxHashMap::default(), 0);
        for part in tree.distinct() {
            last = self.insert(part.op().map(|operand| numbers[&operand.address()]), part.clone());
            numbers.insert(part.address(), last);
        }
        last
    }

    /// Adds a formula with this last operation and returns its number.
    fn insert(&mut self, op: Op<usize>, tree: Tree) -> usize {
        let next = self.formulas.len();
        let number = *self.numbers.entry(op).or_insert(next);
        if number == next {
            self.formulas.push((op, tree));
        }
        number
    }

    /// Returns the powers of scales by which a formula is a multiple of one without scales, and the number of that one;
    /// `None` if it is not such a multiple. `tree` is any formula.
    ///
    /// Scales are positive, so they are factors of minima and positive parts; and powers of two, so they are factors of
    /// rounded formulas. The order of two summands or factors does not matter.
    fn without_scales(&mut self, op: Op<usize>, tree: &Tree) -> Option<Scaled> {
        use Op::*;
        let parts = op.try_map(|operand| self.scaled[*operand])?;
        let powers = match parts.map(|(powers, _)| *powers) {
            Symbol(name) => SCALES.map(|scale| i32::from(name == scale)),
            Int(_) => [0; 3],
            Neg(n) | PositivePart(n) | Rounded(n) => n,
            Add(n, m) | Sub(n, m) | Min(n, m) if n == m => n,
            Mul(n, m) => std::array::from_fn(|i| n[i] + m[i]),
            Div(n, m) => std::array::from_fn(|i| n[i] - m[i]),
            Exp([0, 0, 0]) => [0; 3],
            Add(..) | Sub(..) | Min(..) | Exp(_) => return None,
        };
        let unscaled = match parts.map(|(_, unscaled)| *unscaled) {
            Symbol(name) if SCALES.contains(&name) => Int(1),
            Mul(one, a) | Mul(a, one) | Div(a, one) if self.formulas[one].0 == Int(1) => {
                return Some((powers, a));
            }
            Add(a, b) if a > b => Add(b, a),
            Mul(a, b) if a > b => Mul(b, a),
            op => op,
        };
        let tree = tree.with_op(unscaled.map(|operand| self.formulas[*operand].1.clone()));
        Some((powers, self.insert(unscaled, tree)))
    }

    /// Returns the last operation of a formula.
    pub fn op(&self, formula: usize) -> Checked<Op<usize>> {
        self.formulas.get(formula).map(|(op, _)| *op).ok_or(Refusal::Unknown)
    }

    /// Returns a formula.
    pub fn formula(&self, number: usize) -> Checked<&Tree> {
        self.formulas.get(number).map(|(_, tree)| tree).ok_or(Refusal::Unknown)
    }

    /// Returns the variable of an atom.
    pub fn variable(&self, atom: Atom) -> Checked<usize> {
        self.atoms.iter().position(|known| *known == atom).ok_or(Refusal::Unknown)
    }

    /// Returns the sign that an atom has by its definition.
    pub fn sign(&self, x: usize) -> Sign {
        match self.atoms.get(x) {
            Some(Atom::Own(name)) if SCALES.contains(name) => Sign::POSITIVE,
            Some(Atom::Exponential(_)) => Sign::POSITIVE,
            Some(Atom::Size(_)) => Sign::NON_NEGATIVE,
            _ => Sign::ANY,
        }
    }

    /// Returns `true` if a variable is between −1 and 1.
    pub fn is_unit(&self, x: usize) -> bool {
        matches!(self.atoms.get(x), Some(Atom::Error(_) | Atom::IntervalParameter(_) | Atom::Factor(_)))
    }

    /// Returns the powers of scales by which a formula is a multiple of one that is rounded with the same error, and
    /// that one.
    pub fn rounding(&self, of: usize) -> Scaled {
        self.scaled.get(of).copied().flatten().unwrap_or(([0; 3], of))
    }

    /// Adds the atoms of the formulas so far, and the parameters of the hypotheses that are intervals.
    fn add_atoms(&mut self, parameters: impl Iterator<Item = usize>) -> Checked<()> {
        let mut atoms: BTreeSet<_> = parameters.map(Atom::IntervalParameter).collect();
        let rounds = self.formulas.iter().any(|(op, _)| matches!(op, Op::Rounded(_)));
        for (op, tree) in self.formulas.clone() {
            let scaled = if rounds { self.without_scales(op, &tree) } else { None };
            self.scaled.push(scaled);
            match op {
                Op::Symbol(name) => atoms.extend([Atom::Own(name)]),
                Op::Exp(exponent) => {
                    let reciprocal = self.insert(Op::Neg(exponent), -&self.formulas[exponent].1);
                    atoms.extend([exponent, reciprocal].map(Atom::Exponential));
                }
                Op::Min(negated, of) if self.op(negated)? == Op::Neg(of) => {
                    atoms.extend([Atom::Size(of), Atom::Factor(of)]);
                }
                Op::Rounded(of) => atoms.extend([Atom::Own(PRECISION), Atom::Error(self.rounding(of).1)]),
                _ => {}
            }
        }
        self.atoms = atoms.into_iter().collect();
        if self.atoms.len() > MAX_VARIABLES { Err(Refusal::TooLarge) } else { Ok(()) }
    }
}

impl<'a> Sequent<'a> {
    /// Returns the sequent with its table of atoms.
    pub fn new(proposition: &'a Proposition, hypotheses: Vec<&'a Hypothesis>) -> Checked<Self> {
        let derivative = match proposition {
            Proposition::Derivative(of, by, _) => Some(derivative(of, by)?),
            _ => None,
        };
        let mut table = Table::default();
        let values = hypotheses.iter().map(|h| table.add(&h.value)).collect();
        let intervals = hypotheses.iter().map(|h| h.interval());
        let intervals: Vec<_> = intervals
            .map(|of| of.map(|(x, lower, upper)| (x, [lower, upper].map(|end| table.add(end)))))
            .collect();
        let goal = proposition.trees().into_iter().chain(&derivative).map(|tree| table.add(tree)).collect();
        table.add_atoms((0..intervals.len()).filter(|i| intervals[*i].is_some()))?;
        Ok(Sequent { proposition, hypotheses, values, intervals, goal, table, effort: Effort::default() })
    }

    /// Returns the symbol that tends to infinity in a limit.
    pub fn variable(&self) -> Option<&'static str> {
        match self.proposition {
            Proposition::Limit(_, by, _) => Some(by),
            _ => None,
        }
    }

    /// Returns `true` if the hypothesis with a number mentions the variable of the limit.
    pub fn mentions_variable(&self, i: usize) -> bool {
        self.variable().is_some_and(|by| self.hypotheses[i].value.symbols().contains(by))
    }

    /// Returns `true` if an atom may vary with the variable of the limit.
    pub fn varies(&self, x: usize) -> bool {
        let Some(by) = self.variable() else { return false };
        match self.table.atoms.get(x) {
            Some(Atom::Own(name)) => *name == by,
            Some(Atom::Error(of) | Atom::Size(of) | Atom::Factor(of) | Atom::Exponential(of)) => {
                self.table.formula(*of).is_ok_and(|tree| tree.symbols().contains(by))
            }
            Some(Atom::IntervalParameter(i)) => self.mentions_variable(*i),
            None => true,
        }
    }
}

/// Returns the derivative of a smooth formula.
pub fn derivative(of: &Tree, by: &str) -> Checked<Tree> {
    let Dual { derivative, .. } =
        of.derivative(by, &|name| Tree::symbol(name), &smooth_ops).ok_or(Refusal::NotDifferentiable)?;
    Ok(derivative)
}

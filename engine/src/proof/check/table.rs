//! The formulas of a goal, and the atoms of its polynomials.

use super::polynomial::{MAX_VARIABLES, Polynomial};
use super::{Checked, MAX_NESTING, Refusal};
use crate::formula::Hypothesis;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::number::tree::{Op, smooth_ops};
use crate::number::{Dual, Exponential, Tree};
use crate::proof::effort::Effort;
use rustc_hash::FxHashMap;

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

/// The distinct formulas of a goal, each after its operands, and its atoms.
///
/// Formulas are compared by their operations, not by their place in memory, so equal formulas have the same
/// number however a statement is built.
#[derive(Debug, Default)]
pub struct Table {
    formulas: Vec<(Op<usize>, Tree)>,
    numbers: FxHashMap<Op<usize>, usize>,
    atoms: Vec<Atom>,
}

/// A proposition to be proved from hypotheses.
///
/// Its atoms are the same at all leaves of its proof. They follow from the proposition and the hypotheses
/// alone, so a quantity that distinguishes two cases is the same in both.
#[derive(Debug)]
pub struct Problem<'a> {
    /// The proposition.
    pub proposition: &'a Proposition,
    /// The hypotheses.
    pub hypotheses: Vec<&'a Hypothesis>,
    /// The numbers of the values of the hypotheses.
    pub values: Vec<usize>,
    /// The numbers of the formulas of the proposition, and of the derivative that it is about.
    pub goal: Vec<usize>,
    /// The formulas and atoms.
    pub table: Table,
    /// The number of problems of which this one is a part.
    pub nesting: u32,
    /// The effort that is left for its proof, also for that of its parts.
    pub effort: Effort,
}

impl Table {
    /// Numbers the operations of a formula, operands first, and returns the number of the last one.
    fn numbered(tree: &Tree, mut number: impl FnMut(Op<usize>, &Tree) -> Checked<usize>) -> Checked<usize> {
        let (mut known, mut last) = (FxHashMap::default(), Err(Refusal::Unknown));
        for part in tree.distinct() {
            last = Ok(number(part.op().map(|operand| known[&operand.address()]), part)?);
            known.insert(part.address(), last?);
        }
        last
    }

    /// Adds a formula and returns its number.
    fn add(&mut self, tree: &Tree) -> Checked<usize> {
        Table::numbered(tree, |op, part| {
            let next = self.formulas.len();
            let number = *self.numbers.entry(op).or_insert(next);
            if number == next {
                self.formulas.push((op, part.clone()));
            }
            Ok(number)
        })
    }

    /// Returns the number of a formula.
    pub fn find(&self, tree: &Tree) -> Checked<usize> {
        Table::numbered(tree, |op, _| self.number(&op))
    }

    /// Returns the number of the formula with this last operation.
    pub fn number(&self, op: &Op<usize>) -> Checked<usize> {
        self.numbers.get(op).copied().ok_or(Refusal::Unknown)
    }

    /// Returns the last operation of a formula.
    pub fn op(&self, formula: usize) -> Checked<Op<usize>> {
        self.formulas.get(formula).map(|(op, _)| *op).ok_or(Refusal::Unknown)
    }

    /// Returns a formula.
    pub fn formula(&self, number: usize) -> Checked<&Tree> {
        self.formulas.get(number).map(|(_, tree)| tree).ok_or(Refusal::Unknown)
    }

    /// Returns all atoms in order.
    pub fn atoms(&self) -> &[Atom] {
        &self.atoms
    }

    /// Returns the variable of an atom.
    pub fn variable(&self, atom: Atom) -> Checked<usize> {
        self.atoms.iter().position(|known| *known == atom).ok_or(Refusal::Unknown)
    }

    /// Returns `true` if a variable is between −1 and 1.
    pub fn is_unit(&self, x: usize) -> bool {
        matches!(self.atoms.get(x), Some(Atom::Error(_) | Atom::IntervalParameter(_) | Atom::Factor(_)))
    }

    /// Returns a polynomial of symbols and exponentials as a formula.
    pub fn to_tree(&self, of: &Polynomial) -> Checked<Tree> {
        let mut sum = Tree::from(0);
        for (powers, number) in of.terms() {
            let mut term = Tree::from(i32::try_from(*number).map_err(|_| Refusal::TooLarge)?);
            for (x, n) in powers.iter().enumerate().filter(|(_, n)| **n > 0) {
                let atom = match self.atoms.get(x) {
                    Some(Atom::Own(name)) => Tree::symbol(name),
                    Some(Atom::Exponential(exponent)) => self.formula(*exponent)?.exp(),
                    _ => return Err(Refusal::Rise),
                };
                term = (0..*n).fold(term, |term, _| term * &atom);
            }
            sum = sum + term;
        }
        Ok(sum)
    }

    fn add_atom(&mut self, atom: Atom) {
        if !self.atoms.contains(&atom) {
            self.atoms.push(atom);
        }
    }

    /// Adds e to the power of a formula, and its reciprocal.
    fn add_exponentials(&mut self, exponent: usize) -> Checked<()> {
        let reciprocal = -self.formula(exponent)?;
        let reciprocal = self.add(&reciprocal)?;
        self.add_atom(Atom::Exponential(exponent));
        self.add_atom(Atom::Exponential(reciprocal));
        Ok(())
    }

    fn add_atoms(&mut self, hypotheses: &[&Hypothesis]) -> Checked<()> {
        for op in self.formulas.iter().map(|(op, _)| *op).collect::<Vec<_>>() {
            match op {
                Op::Symbol(name) => self.add_atom(Atom::Own(name)),
                Op::Exp(exponent) => self.add_exponentials(exponent)?,
                Op::Min(negated, of) if self.op(negated)? == Op::Neg(of) => {
                    self.add_atom(Atom::Size(of));
                    self.add_atom(Atom::Factor(of));
                }
                Op::Rounded(of) => {
                    self.add_atom(Atom::Own(PRECISION));
                    self.add_atom(Atom::Error(of));
                }
                _ => {}
            }
        }
        for (i, hypothesis) in hypotheses.iter().enumerate() {
            if hypothesis.interval().is_some() {
                self.add_atom(Atom::IntervalParameter(i));
            }
        }
        self.atoms.sort_unstable();
        if self.atoms.len() > MAX_VARIABLES { Err(Refusal::TooLarge) } else { Ok(()) }
    }
}

impl<'a> Problem<'a> {
    /// Returns the problem with its table of atoms.
    pub fn new(proposition: &'a Proposition, hypotheses: Vec<&'a Hypothesis>) -> Checked<Self> {
        let derivative = match proposition {
            Proposition::Derivative(of, by, _) => Some(derivative(of, by)?),
            _ => None,
        };
        let mut table = Table::default();
        let values = hypotheses.iter().map(|h| table.add(&h.value)).collect::<Checked<_>>()?;
        let goal = proposition.trees().into_iter().chain(&derivative);
        let goal = goal.map(|tree| table.add(tree)).collect::<Checked<_>>()?;
        table.add_atoms(&hypotheses)?;
        Ok(Problem { proposition, hypotheses, values, goal, table, nesting: 0, effort: Effort::default() })
    }

    /// Returns the problem as a part of another.
    pub fn within(self, other: &Problem) -> Checked<Self> {
        let nesting = other.nesting + 1;
        if nesting > MAX_NESTING {
            Err(Refusal::TooLarge)
        } else {
            Ok(Problem { nesting, effort: other.effort.clone(), ..self })
        }
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

    /// Returns `true` if a variable may vary with a symbol.
    pub fn depends(&self, x: usize, symbol: &str) -> bool {
        match self.table.atoms.get(x) {
            Some(Atom::Own(name)) => *name == symbol,
            Some(Atom::Error(of) | Atom::Size(of) | Atom::Factor(of) | Atom::Exponential(of)) => {
                self.table.formula(*of).is_ok_and(|tree| tree.symbols().contains(symbol))
            }
            Some(Atom::IntervalParameter(i)) => self.hypotheses[*i].value.symbols().contains(symbol),
            None => true,
        }
    }

    /// Returns `true` if a variable may vary with that of a symbol.
    pub fn depends_on(&self, x: usize, symbol: usize) -> bool {
        !matches!(self.table.atoms.get(symbol), Some(Atom::Own(name)) if !self.depends(x, name))
    }
}

/// Returns the derivative of a smooth formula.
pub fn derivative(of: &Tree, by: &str) -> Checked<Tree> {
    let Dual { derivative, .. } =
        of.derivative(by, &|name| Tree::symbol(name), &smooth_ops).ok_or(Refusal::NotDifferentiable)?;
    Ok(derivative)
}

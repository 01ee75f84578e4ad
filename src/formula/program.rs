//! Many formulas at once.

use crate::number::tree::Step;
use crate::number::{Field, Tree};
use std::collections::HashMap;

/// Formulas compiled to a list of steps, in which what they have in common stands once: R or ρ is computed
/// once, however many formulas speak of it.
///
/// ```
/// use num_traits::One;
/// use spring_mass_contact::{formula::Program, number::Tree};
/// let x = Tree::symbol("x");
/// let square = &x * &x;
/// let mut program = Program::default();
/// let [a, b] = [&square + &square, Tree::one() / &square].map(|formula| program.add(&formula));
/// let values = program.run(&|_| 2.0, &|_| None);
/// assert_eq!((values[a], values[b]), (Some(8.0), None)); // nobody said how to divide
/// assert_eq!(program.len(), 5); // x, x², x² + x², 1 and 1/x²
/// ```
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Each after its operands, which are named by their places.
    steps: Vec<Step<usize>>,
    places: HashMap<Step<usize>, usize>,
}

impl Program {
    /// Takes in a formula, and says at which place its value will be.
    pub fn add(&mut self, formula: &Tree) -> usize {
        let step = formula.step().map(|operand| self.add(operand));
        let next = self.steps.len();
        *self.places.entry(step).or_insert_with(|| {
            self.steps.push(step);
            next
        })
    }

    /// How many steps it has.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Has it none?
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The value at each place: what [`Tree::replay`] would compute, bit for bit. How to divide, and eˣ,
    /// ⟨·⟩ and min, is for `beyond` to say; where that has no answer, there is no value.
    pub fn run<T: Field>(
        &self,
        symbol: &impl Fn(&'static str) -> T,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> Vec<Option<T>> {
        use Step::*;
        let mut values: Vec<Option<T>> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let value = |place: &usize| values[*place].as_ref();
            let both = |a, b| value(a).zip(value(b));
            let result = match step {
                Symbol(name) => Some(symbol(name)),
                Int(n) => Some(T::int(*n)),
                Neg(a) => value(a).map(|a| -a),
                Add(a, b) => both(a, b).map(|(a, b)| a + b),
                Sub(a, b) => both(a, b).map(|(a, b)| a - b),
                Mul(a, b) => both(a, b).map(|(a, b)| a * b),
                Div(a, b) => both(a, b).and_then(|(a, b)| beyond(Div(a, b))),
                Exp(a) => value(a).and_then(|a| beyond(Exp(a))),
                PositivePart(a) => value(a).and_then(|a| beyond(PositivePart(a))),
                Min(a, b) => both(a, b).and_then(|(a, b)| beyond(Min(a, b))),
                Rounded(a) => value(a).and_then(|a| beyond(Rounded(a))),
            };
            values.push(result);
        }
        values
    }
}

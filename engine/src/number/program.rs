//! Many formulas at once.

use super::tree::Step;
use super::{Field, Tree};
use std::collections::HashMap;

/// Formulas compiled to a list of steps, in which what they have in common stands once: R or ρ is computed
/// once, however many formulas speak of it.
///
/// ```
/// use num_traits::One;
/// use provable::number::{Program, Tree};
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

    /// Its steps, each after its operands, which are named by their places.
    pub fn steps(&self) -> &[Step<usize>] {
        &self.steps
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
        let mut values: Vec<Option<T>> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let operands = step.try_map(|place| values[*place].as_ref());
            values.push(operands.and_then(|step| match step {
                Step::Symbol(name) => Some(symbol(name)),
                Step::Div(..) => beyond(step),
                step => step.arithmetic().or_else(|| beyond(step)),
            }));
        }
        values
    }

    /// The program for many rounds, in which some quantities change and the others, those that `fixed`
    /// knows, do not: what depends on these alone is computed here, once. `beyond` knows eˣ, ⟨·⟩ and min;
    /// `None` if it has no answer. Division is the number system's own.
    pub fn rounds<T: Field>(
        &self,
        fixed: &impl Fn(&'static str) -> Option<T>,
        beyond: &impl Fn(Step<&T>) -> Option<T>,
    ) -> Option<Rounds<T>> {
        let (mut values, mut steps, mut vary) = (Vec::<T>::new(), Vec::new(), Vec::<bool>::new());
        for (place, step) in self.steps.iter().enumerate() {
            let mut value = T::zero();
            let varies = if let Step::Symbol(name) = step {
                fixed(name).map(|number| value = number).is_none()
            } else if step.operands().any(|operand| vary[*operand]) {
                steps.push((place, *step));
                true
            } else {
                compute(&mut value, step.map(|operand| &values[*operand]), beyond)?;
                false
            };
            values.push(value);
            vary.push(varies);
        }
        Some(Rounds { values, steps })
    }
}

/// A [`Program`] that is run again and again with other numbers for some of its quantities: a round computes
/// what depends on these and nothing else, in place where the number system can
/// ([`Field::assign`]), and bit for bit what the functions compute.
///
/// ```
/// use provable::number::{Program, Tree};
/// let [a, x] = ["a", "x"].map(|name| Tree::symbol(name));
/// let mut program = Program::default();
/// let [place, result] = [&x, &((&a + &a) * &x)].map(|formula| program.add(formula));
/// let beyond = |_: provable::number::tree::Step<&f64>| None;
/// let mut rounds = program.rounds(&|name| (name == "a").then_some(2.0), &beyond).unwrap();
/// assert_eq!(rounds.len(), 1); // a + a is known
/// for x in [1.0, 10.0] {
///     rounds.replace(place, x);
///     rounds.run(&beyond);
///     assert_eq!(rounds[result], 4.0 * x);
/// }
/// ```
#[derive(Clone, Debug)]
pub struct Rounds<T> {
    values: Vec<T>,
    /// What a round computes, and at which place.
    steps: Vec<(usize, Step<usize>)>,
}

impl<T: Field> Rounds<T> {
    /// Puts another number at a place, and returns the one that was there. At that of a quantity it stays
    /// until it is replaced; elsewhere it only lends its memory to what is computed there next.
    pub fn replace(&mut self, place: usize, value: T) -> T {
        std::mem::replace(&mut self.values[place], value)
    }

    /// Takes the number at a place out. The place is empty until it is filled or computed again.
    pub fn take(&mut self, place: usize) -> T {
        let value = &mut self.values[place];
        std::mem::replace(value, T::zero())
    }

    /// Computes what depends on the quantities that change; `None` if `beyond` has no answer.
    pub fn run(&mut self, beyond: &impl Fn(Step<&T>) -> Option<T>) -> Option<()> {
        for (place, step) in &self.steps {
            // Every step stands after its operands.
            let (before, rest) = self.values.split_at_mut(*place);
            compute(&mut rest[0], step.map(|operand| &before[*operand]), beyond)?;
        }
        Some(())
    }

    /// How many steps a round has.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Has it none?
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }
}

impl<T> std::ops::Index<usize> for Rounds<T> {
    type Output = T;
    fn index(&self, place: usize) -> &T {
        &self.values[place]
    }
}

fn compute<T: Field>(result: &mut T, step: Step<&T>, beyond: &impl Fn(Step<&T>) -> Option<T>) -> Option<()> {
    if !result.assign(step) {
        *result = beyond(step)?;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_has_the_steps_that_vary() {
        let [a, x] = ["a", "x"].map(|name| Tree::symbol(name));
        let mut program = Program::default();
        assert!(program.is_empty());
        program.add(&((&a + &a) * &x * &x));
        assert!(!program.is_empty() && program.len() == 5);
        let rounds = |fixed: &[&str]| {
            let number = |name| fixed.contains(&name).then_some(2.0);
            program.rounds(&number, &|_| None).unwrap()
        };
        assert!(rounds(&["a", "x"]).is_empty());
        let two = rounds(&["a"]);
        assert!(!two.is_empty() && two.len() == 2);
    }
}

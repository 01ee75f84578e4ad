//! Compiled programs of several formulas.

use super::tree::{Op, SMALL};
use super::{Field, Tree};
use std::collections::HashMap;

/// Formulas compiled to a list of operations that contains common subformulas once: R or ρ is computed once
/// for all formulas.
///
/// # Examples
///
/// ```
/// use num_traits::One;
/// use provable::number::{Program, Tree};
/// let x = Tree::symbol("x");
/// let square = &x * &x;
/// let mut program = Program::default();
/// let [a, b] = [&square + &square, Tree::one() / &square].map(|formula| program.add(&formula));
/// assert_eq!(program.formula(a), &square + &square);
/// assert_eq!(program.formula(b), Tree::one() / &square);
/// assert_eq!(program.len(), 5); // x, x², x² + x², 1 and 1/x²
/// ```
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Operations after their operands, which are indices.
    ops: Vec<Op<usize>>,
    places: HashMap<Op<usize>, usize>,
}

impl Program {
    /// Adds a formula and returns the index of its value.
    pub fn add(&mut self, formula: &Tree) -> usize {
        if formula.size() <= SMALL {
            let op = formula.op().map(|operand| self.add(operand));
            return self.place(op);
        }
        let mut places = HashMap::new();
        for tree in formula.distinct() {
            let op = tree.op().map(|operand| places[&operand.address()]);
            places.insert(tree.address(), self.place(op));
        }
        places[&formula.address()]
    }

    /// Returns the index of an operation on values of the program.
    fn place(&mut self, op: Op<usize>) -> usize {
        let next = self.ops.len();
        *self.places.entry(op).or_insert_with(|| {
            self.ops.push(op);
            next
        })
    }

    /// Returns the formula at an index.
    pub fn formula(&self, place: usize) -> Tree {
        let (first, mut formulas) = (Tree::from(0), Vec::with_capacity(place + 1));
        for op in &self.ops[..=place] {
            formulas.push(first.with_op(op.map(|operand: &usize| Tree::clone(&formulas[*operand]))));
        }
        formulas.swap_remove(place)
    }

    /// Returns the operations, each after its operands, which are indices.
    pub fn ops(&self) -> &[Op<usize>] {
        &self.ops
    }

    /// Returns the number of operations.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Returns `true` if the program is empty.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }

    /// Specialises the program for repeated runs in which the quantities that `fixed` returns stay the same:
    /// subformulas of these alone are computed here, once. Returns `None` if `extra_ops` does, which
    /// evaluates eˣ, ⟨·⟩ and min. Division is that of the number system.
    pub fn specialize<T: Field>(
        &self,
        fixed: &impl Fn(&'static str) -> Option<T>,
        extra_ops: &impl Fn(Op<&T>) -> Option<T>,
    ) -> Option<SpecializedProgram<T>> {
        let (mut values, mut ops, mut vary) = (Vec::<T>::new(), Vec::new(), Vec::<bool>::new());
        for (place, op) in self.ops.iter().enumerate() {
            let mut value = T::zero();
            let varies = if let Op::Symbol(name) = op {
                fixed(name).map(|number| value = number).is_none()
            } else if op.operands().any(|operand| vary[*operand]) {
                ops.push((place, *op));
                true
            } else {
                compute(&mut value, op.map(|operand| &values[*operand]), extra_ops)?;
                false
            };
            values.push(value);
            vary.push(varies);
        }
        Some(SpecializedProgram { values, ops })
    }
}

/// A [`Program`] that is run repeatedly with different values of some quantities. A run computes only what
/// depends on these, in place if the number system can ([`Field::assign_op`]), with the same bits as the
/// functions.
///
/// # Examples
///
/// ```
/// use provable::number::{Program, Tree};
/// let [a, x] = ["a", "x"].map(|name| Tree::symbol(name));
/// let mut program = Program::default();
/// let [place, result] = [&x, &((&a + &a) * &x)].map(|formula| program.add(formula));
/// let extra_ops = |_: provable::number::tree::Op<&f64>| None;
/// let mut specialized = program.specialize(&|name| (name == "a").then_some(2.0), &extra_ops).unwrap();
/// assert_eq!(specialized.len(), 1); // a + a is known
/// for x in [1.0, 10.0] {
///     specialized.replace(place, x);
///     specialized.run(&extra_ops);
///     assert_eq!(specialized[result], 4.0 * x);
/// }
/// ```
#[derive(Clone, Debug)]
pub struct SpecializedProgram<T> {
    values: Vec<T>,
    /// Operations of a run with the indices of their results.
    ops: Vec<(usize, Op<usize>)>,
}

impl<T: Field> SpecializedProgram<T> {
    /// Stores a number at an index and returns the previous one. At the index of a quantity it stays until it
    /// is replaced; elsewhere only its memory is reused for the next result.
    pub fn replace(&mut self, place: usize, value: T) -> T {
        std::mem::replace(&mut self.values[place], value)
    }

    /// Removes and returns the number at an index, which stays empty until it is replaced or computed again.
    pub fn take(&mut self, place: usize) -> T {
        let value = &mut self.values[place];
        std::mem::replace(value, T::zero())
    }

    /// Computes what depends on the varying quantities; returns `None` if `extra_ops` does.
    pub fn run(&mut self, extra_ops: &impl Fn(Op<&T>) -> Option<T>) -> Option<()> {
        for (place, op) in &self.ops {
            // Every operation stands after its operands.
            let (before, rest) = self.values.split_at_mut(*place);
            compute(&mut rest[0], op.map(|operand| &before[*operand]), extra_ops)?;
        }
        Some(())
    }

    /// Returns the number of operations of a run.
    pub fn len(&self) -> usize {
        self.ops.len()
    }

    /// Returns `true` if a run has no operations.
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }
}

impl<T> std::ops::Index<usize> for SpecializedProgram<T> {
    type Output = T;
    fn index(&self, place: usize) -> &T {
        &self.values[place]
    }
}

fn compute<T: Field>(result: &mut T, op: Op<&T>, extra_ops: &impl Fn(Op<&T>) -> Option<T>) -> Option<()> {
    if !result.assign_op(op) {
        *result = extra_ops(op)?;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_has_the_operations_that_vary() {
        let [a, x] = ["a", "x"].map(|name| Tree::symbol(name));
        let mut program = Program::default();
        assert!(program.is_empty());
        program.add(&((&a + &a) * &x * &x));
        assert!(!program.is_empty() && program.len() == 5);
        let specialize = |fixed: &[&str]| {
            let number = |name| fixed.contains(&name).then_some(2.0);
            program.specialize(&number, &|_| None).unwrap()
        };
        assert!(specialize(&["a", "x"]).is_empty());
        let two = specialize(&["a"]);
        assert!(!two.is_empty() && two.len() == 2);
    }
}

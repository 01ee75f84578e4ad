//! A value and its derivative.

use super::{Exponential, Field};
use crate::operators;
use num_traits::{One, Zero};

/// A value and its derivative with respect to one variable: a formula read in dual numbers differentiates
/// itself.
///
/// Over rationals the derivative is exact, over balls it carries its bound, over duals it is the second.
///
/// ```
/// use spring_mass_contact::{chapter::{SpringMass, structure}, number::Dual};
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// // (1.1) is the derivative of (1.4).
/// let energy = structure::potential_energy(&system.map(|&x| Dual::constant(x)), &Dual::variable(0.5));
/// assert_eq!(energy.derivative, structure::residual(&system, &0.5));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Dual<T> {
    /// The value.
    pub value: T,
    /// Its derivative.
    pub derivative: T,
}

impl<T: Field> Dual<T> {
    /// A number that does not depend on the variable.
    pub fn constant(value: T) -> Self {
        Dual { value, derivative: T::zero() }
    }

    /// The variable itself.
    pub fn variable(value: T) -> Self {
        Dual { value, derivative: T::one() }
    }

    /// A coordinate: the variable if it varies, and else a constant.
    pub fn coordinate(value: T, varies: bool) -> Self {
        if varies { Dual::variable(value) } else { Dual::constant(value) }
    }
}

operators! { [T: Field] Dual<T>;
    Add add |a, b| Dual { value: &a.value + &b.value, derivative: &a.derivative + &b.derivative };
    Sub sub |a, b| Dual { value: &a.value - &b.value, derivative: &a.derivative - &b.derivative };
    Mul mul |a, b| Dual {
        value: &a.value * &b.value,
        derivative: &a.derivative * &b.value + &a.value * &b.derivative,
    };
    Div div |a, b| {
        let value = &a.value / &b.value;
        let derivative = (&a.derivative - &value * &b.derivative) / &b.value;
        Dual { value, derivative }
    };
    - |a| Dual { value: -&a.value, derivative: -&a.derivative }
}

impl<T: Field> Zero for Dual<T> {
    fn zero() -> Self {
        Dual::constant(T::zero())
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.derivative.is_zero()
    }
}
impl<T: Field> One for Dual<T> {
    fn one() -> Self {
        Dual::constant(T::one())
    }
}
impl<T: Field> Field for Dual<T> {
    fn int(n: i32) -> Self {
        Dual::constant(T::int(n))
    }
    fn is_unit(&self) -> bool {
        self.value.is_unit()
    }
}
impl<T: Exponential> Exponential for Dual<T> {
    fn exp(&self) -> Self {
        let value = self.value.exp();
        Dual { derivative: &value * &self.derivative, value }
    }
}

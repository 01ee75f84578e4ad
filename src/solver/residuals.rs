//! Exact residuals of a solution.

use super::{exact, validate};
use crate::chapter::{SpringMass, contact};
use crate::number::{Exact, ToExact};
use crate::solver::{Scalar, Solution, SolveError};

impl<T: Scalar + ToExact> Solution<T> {
    /// Returns the residuals of (1.6) and of equilibrium for the returned numbers, in exact rationals.
    ///
    /// All are zero if and only if the numbers are the exact solution, which the penalty method never
    /// attains.
    ///
    /// # Errors
    /// Returns [`SolveError::Invalid`] if a parameter, the deflection or the contact force is not finite or
    /// out of its range.
    ///
    /// # Examples
    ///
    /// ```
    /// # use spring_mass_contact::{chapter::SpringMass, solver::{Method, solve}};
    /// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
    /// assert!(solve(&system, &Method::Lagrange)?.residuals(&system)?.is_zero());
    /// # Ok::<(), spring_mass_contact::solver::SolveError>(())
    /// ```
    pub fn residuals(&self, system: &SpringMass<T>) -> Result<contact::Kkt<Exact>, SolveError> {
        validate::system(system)?;
        validate::finite_number("deflection", &self.deflection)?;
        validate::finite_number("contact force", &self.contact_force)?;
        Ok(contact::kkt(&system.as_ref().map(exact), &exact(&self.deflection), &exact(&self.contact_force)))
    }
}

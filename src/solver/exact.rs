//! The part of the solver for MPFR numbers and exact rationals: advice, step counts, guarantees, sweeps,
//! parsing and display.

mod advise;
mod count;
mod display;
mod format;
mod gmp_scalars;
mod guarantees;
pub mod laws;
mod read;
mod residuals;
mod rounding_laws;
mod series;
mod sweep;

pub use advise::{Advice, Recommendation, advise};
pub use count::exact_augmentation_count;
pub use format::{format_equation, format_short, format_short_bound};
pub use guarantees::{
    guaranteed_max_augmentations, is_convergence_guaranteed, required_precision, rounding_floor,
};
pub use read::ReadError;
pub use series::series_penetration;
pub use sweep::{SweepRow, best_penalty, penalties, penalty_force_bound, sweep};

use super::{
    Interval, MAX_AUGMENTATIONS, Method, Outcome, Plane, Scalar, Solution, SolveError, State, root, solve,
    validate,
};
use crate::number::{Exact, ToExact};

/// Returns the value of a number that has been checked, or is the result of a solve.
fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("a finite number")
}

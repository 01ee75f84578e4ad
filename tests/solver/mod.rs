//! Properties of the solver on sampled systems.

mod advice;
mod augmentation_monotone;
mod closed_form;
mod every_f32;
mod functionals;
mod invariances;
mod kkt;
mod laws;
mod penalty_limit;
mod planted;
mod results;
#[cfg(feature = "serde")]
mod serialised;
mod shown;
mod sweep;

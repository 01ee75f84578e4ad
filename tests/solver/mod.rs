//! Properties of the solver on sampled systems.

mod advice;
mod augmentation;
mod closed_form;
mod every_f32;
mod functionals;
mod invariances;
mod laws;
mod lossy;
mod native;
mod penalty;
mod planted;
mod results;
#[cfg(feature = "serde")]
mod serialised;
mod shown;
mod state;
mod sweep;

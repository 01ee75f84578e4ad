//! Records as data: what functions compute, and what is claimed of it.
//!
//! A function that is generic over its number system leaves a record when it is called with [`Tree`]s. This
//! is what can be done with records, whatever they are about: [typeset](crate::number::Tree::typeset) them,
//! keep a [`Registry`] of them, by which one formula is known in another, and say something of them, as a
//! [`Statement`] under [`Hypothesis`]es, for `proof` to prove. A [`Program`](crate::number::Program) runs
//! many of them at once.
//!
//! [`Tree`]: crate::number::Tree

pub mod claim;
mod hypothesis;
mod registry;
mod sequence;
pub mod statement;
mod typeset;

pub use claim::Rate;
pub use hypothesis::{Hypothesis, Relation};
pub use registry::{Call, Formula, Registry};
pub use statement::{Proposition, Statement};
pub(crate) use typeset::name_of_rounding;
pub use typeset::{Name, Notation, latex};

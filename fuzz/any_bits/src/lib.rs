//! Properties with arbitrary bits: numbers of every kind as arguments, arbitrary texts as numbers and replies, and
//! proofs with arbitrary changes. Nothing panics or takes long, errors name their argument, and results satisfy their
//! guarantees. The binary draws the bits; in the directory above, a coverage-guided fuzzer does.

mod bytes;

mod library;
mod proofs;
mod replies;

pub use library::SHOWN;
use spring_mass_contact::number::{Exact, Mpfr};

/// Name, maximal number of bytes, and property.
pub type Target = (&'static str, usize, fn(&[u8]));

/// All targets.
pub const TARGETS: [Target; 8] = [
    ("parse", 40, library::parse),
    ("solve_f32", 96, library::solve_any::<f32>),
    ("solve_f64", 96, library::solve_any::<f64>),
    ("solve_mpfr", 128, library::solve_any::<Mpfr>),
    ("solve_exact", 128, library::solve_any::<Exact>),
    ("functions", 192, library::functions),
    ("reply", 128, replies::read),
    ("forged", 112, proofs::prove_nothing),
];

/// Tests the property of a target. Panics if it does not hold.
pub fn test(target: &str, bytes: &[u8]) {
    let (.., property) = TARGETS.iter().find(|(name, ..)| *name == target).expect("a target");
    property(bytes);
}

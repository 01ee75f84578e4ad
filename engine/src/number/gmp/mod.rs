//! Numbers of GMP and MPFR, and numbers as text.

mod exact;
mod functions;
mod mpfr;
mod parse;
mod scientific;
mod system;
mod text;

pub use exact::{Exact, Inexact, ToExact};
pub use mpfr::{Mpfr, PRECISIONS};
pub use parse::{MAX_EXPONENT, ParseError, RangeError};
pub use system::{NumberSystem, UnknownNumberSystem};
pub use text::Text;
#[cfg(feature = "serde")]
pub use text::{lossless, quantity};

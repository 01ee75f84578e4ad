//! Numbers of GMP and MPFR, and conversion to and from text.

mod exact;
mod functions;
mod mpfr;
mod native;
mod parse;
mod system;
mod text;

pub use exact::{Exact, NonFiniteError, ToExact};
pub use mpfr::{Mpfr, PRECISIONS};
pub use parse::{MAX_EXPONENT, ParseError, RangeError};
pub use system::{FloatFormat, NumberSystem, UnknownNumberSystem};
pub use text::ExactText;

//! exp and ln of the machine's floats, correctly rounded: MPFR's at 24 and 53 bits. The standard library
//! promises no bound for its own.

use crate::number::{Exponential, Logarithm};
use rug::Float;
use rug::float::Round;
use std::cmp::Ordering;

/// f(x), rounded once. Among the subnormal numbers, which have fewer bits, MPFR rounds a second time; it then
/// has to know which way it went the first time.
fn nearest(bits: u32, x: f64, f: fn(&mut Float, Round) -> Ordering) -> Float {
    let mut y = Float::with_val(bits, x);
    let went = f(&mut y, Round::Nearest);
    y.subnormalize_ieee_round(went, Round::Nearest);
    y
}

macro_rules! functions {
    ($($float:ident $convert:ident;)*) => {$(
        impl Exponential for $float {
            fn exp(&self) -> Self {
                nearest($float::MANTISSA_DIGITS, f64::from(*self), Float::exp_round).$convert()
            }
        }
        impl Logarithm for $float {
            fn ln(&self) -> Self {
                nearest($float::MANTISSA_DIGITS, f64::from(*self), Float::ln_round).$convert()
            }
            fn ln_1p(&self) -> Self {
                nearest($float::MANTISSA_DIGITS, f64::from(*self), Float::ln_1p_round).$convert()
            }
        }
    )*};
}
functions! {
    f32 to_f32;
    f64 to_f64;
}

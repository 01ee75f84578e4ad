//! Correctly rounded exp and ln of machine floats, computed by MPFR with 24 and 53 bits. The standard library
//! guarantees no bound for its own functions.

use crate::number::{Exponential, Logarithm};
use rug::Float;
use rug::float::Round;
use std::cmp::Ordering;

/// Returns f(x), rounded once. Subnormal results, which have fewer bits, are rounded a second time by MPFR
/// with the direction of the first rounding.
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

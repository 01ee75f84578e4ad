//! Numbers and texts derived from bytes: every number occurs, and special values occur often.

use spring_mass_contact::chapter::{SpringMass, structure};
use spring_mass_contact::number::{Exact, ExactText, Mpfr, ToExact};
use spring_mass_contact::rug::{Float, float::Special};
use spring_mass_contact::solver::{Method, Plane, Scalar};

/// Bytes to be consumed from the front; zeros follow their end.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn byte(&mut self) -> u8 {
        self.0.split_off_first().copied().unwrap_or(0)
    }

    pub fn bits(&mut self) -> u64 {
        (0..8).fold(0, |bits, _| bits << 8 | u64::from(self.byte()))
    }

    /// Returns a number below `n`, which is at most 256.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// Returns `true` for one of `n` bytes.
    pub fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    pub fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }

    /// Returns the remaining bytes.
    pub fn rest(&mut self) -> &[u8] {
        std::mem::take(&mut self.0)
    }
}

/// Scalar that can be derived from bytes.
pub trait Number: Scalar + ExactText + PartialEq {
    /// Returns an arbitrary number, possibly not finite.
    fn any(bytes: &mut Bytes) -> Self;

    /// Whether the numbers are rationals.
    const EXACT: bool = false;

    /// Returns `true` unless the value is infinite or not a number.
    fn is_number(&self) -> bool {
        Scalar::is_finite(self)
    }
}

macro_rules! machine {
    ($($Float:ident $Bits:ty;)*) => {$(
        impl Number for $Float {
            fn any(bytes: &mut Bytes) -> Self {
                const SPECIAL: [$Float; 14] = [
                    0.0,
                    -0.0,
                    $Float::from_bits(1),
                    -$Float::from_bits(1),
                    $Float::MIN_POSITIVE,
                    $Float::MIN_POSITIVE.next_down(),
                    1.0 + $Float::EPSILON,
                    $Float::EPSILON,
                    $Float::MAX,
                    $Float::MIN,
                    $Float::MAX / 2.0,
                    $Float::INFINITY,
                    $Float::NEG_INFINITY,
                    $Float::NAN,
                ];
                match bytes.byte() % 16 {
                    0 | 1 => $Float::from_bits(bytes.bits() as $Bits),
                    2 => *bytes.pick(&SPECIAL),
                    3..6 => $Float::from(bytes.byte() as i8),
                    6..9 => $Float::from(bytes.byte()) / *bytes.pick(&[10.0, 100.0, 1e3, 3.0, 1e6]),
                    _ => {
                        // All digits, and a size between 2⁻¹⁶ and 2¹⁶.
                        let one = (1.0 as $Float).to_bits();
                        let digits = bytes.bits() as $Bits % (1 << ($Float::MANTISSA_DIGITS - 1));
                        let exponent = <$Float>::from(bytes.byte() as i8 / 8).exp2();
                        $Float::from_bits(one | digits) * exponent
                    }
                }
            }
        }
    )*};
}
machine! { f32 u32; f64 u64; }

/// Numbers of 2 to 64 bits, and constants, which have no precision.
impl Number for Mpfr {
    fn any(bytes: &mut Bytes) -> Self {
        let precision = 2 + bytes.below(63) as u32;
        let float = |x: Float| Mpfr::from(x);
        match bytes.byte() % 16 {
            0 => float(Float::with_val(
                precision,
                *bytes.pick(&[Special::Infinity, Special::NegInfinity, Special::Nan]),
            )),
            1 => float(Float::with_val(precision, *bytes.pick(&[Special::Zero, Special::NegZero]))),
            2 => Mpfr::constant(Exact::any(bytes).into()),
            3..8 => float(Float::with_val(precision, bytes.byte() as i8)),
            8 => float(Float::with_val(precision, bytes.bits()) << (bytes.bits() as i32 % 100_000)),
            _ => float(
                Float::with_val(precision, bytes.bits() as i64) >> (47 + i32::from(bytes.byte() as i8) / 8),
            ),
        }
    }
}

impl Number for Exact {
    const EXACT: bool = true;

    fn any(bytes: &mut Bytes) -> Self {
        match bytes.byte() % 16 {
            0 => f64::from_bits(bytes.bits()).to_exact().unwrap_or(Exact::from(0)),
            1 => f32::from_bits(bytes.bits() as u32).to_exact().unwrap_or(Exact::from(0)),
            2 => Exact::power_of_two(bytes.bits() as i32 % 5000),
            3..8 => Exact::from(i32::from(bytes.byte() as i8)),
            8..12 => {
                Exact::from(i32::from(bytes.byte() as i8))
                    / Exact::from(*bytes.pick(&[10, 100, 3, 7, 1_000_000]))
            }
            _ => Exact::from(bytes.bits() as i32) / Exact::from((bytes.bits() as i32).max(1)),
        }
    }
}

/// Returns a number that is usually a valid stiffness.
pub fn positive<T: Number>(bytes: &mut Bytes) -> T {
    let x = T::any(bytes);
    if bytes.one_in(32) || !x.is_number() { x } else { x.abs() }
}

/// Returns a system, often with valid parameters; sometimes near grazing, or with the plane at the free end.
pub fn system<T: Number>(bytes: &mut Bytes) -> SpringMass<T> {
    let (c, m) = (positive(bytes), positive(bytes));
    let [g, l, h] = [(); 3].map(|()| T::any(bytes));
    let mut system = SpringMass { c, m, g, l, h };
    match bytes.below(16) {
        0 | 1 if !system.c.is_zero() => system.h = &system.l + structure::deflection(&system),
        2 => system.h = system.l.clone(),
        _ => {}
    }
    system
}

pub fn plane(bytes: &mut Bytes) -> Plane {
    *bytes.pick(&[Plane::Unilateral, Plane::Bilateral])
}

pub fn method<T: Number>(bytes: &mut Bytes, most_augmentations: u8) -> Method<T> {
    match bytes.below(4) {
        0 => Method::Lagrange,
        1 => Method::Penalty { penalty: positive(bytes) },
        _ => Method::Augmented {
            penalty: positive(bytes),
            tolerance: positive(bytes),
            max_augmentations: u64::from(bytes.byte().min(most_augmentations)),
            start: if bytes.one_in(2) { T::any(bytes) } else { T::zero() },
        },
    }
}

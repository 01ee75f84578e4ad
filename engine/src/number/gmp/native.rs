//! Exact values and correctly rounded functions of floats of num-traits.

use super::{Exact, ExactText, FloatFormat, NonFiniteError, NumberSystem, RangeError, ToExact};
use crate::number::{Exponential, Logarithm, Native, Real};
use num_traits::{Float, Zero};
use rug::float::Round;
use rug::integer::Order;
use rug::{Integer, Rational};
use std::cmp::Ordering;
use std::fmt::Debug;
use std::iter;

/// Largest absolute value of an exponent, beyond which no format has one: an infinity of a wrong one ends there.
const MAX_FORMAT_EXPONENT: usize = 1 << 15;

/// Returns e for 2ᵉ ≤ x < 2ᵉ⁺¹, without `integer_decode`, which can panic for more than 64 bits.
fn exponent<T: Float>(x: T) -> i32 {
    let (one, two) = (T::one(), T::one() + T::one());
    let halves = iter::successors(Some(x), |x| Some(*x / two)).take(MAX_FORMAT_EXPONENT);
    let doubles = iter::successors(Some(x), |x| Some(*x * two)).take(MAX_FORMAT_EXPONENT);
    halves.take_while(|x| *x >= two).count() as i32 - doubles.take_while(|x| *x < one).count() as i32
}

impl<T: Float + Debug> Native<T> {
    /// Returns the number of binary digits of a normal number.
    fn bits() -> u32 {
        (1 - exponent(T::epsilon())).max(1).unsigned_abs()
    }

    fn format() -> FloatFormat {
        let name = std::any::type_name::<T>();
        FloatFormat {
            name: name.rsplit_once("::").filter(|_| !name.contains('<')).map_or(name, |(_, last)| last),
            bits: Self::bits(),
            exponents: [T::min_positive_value(), T::max_value()].map(exponent),
        }
    }

    /// Returns n 2ᵉ for n ≥ 0, exactly if it is a number of this type.
    fn scaled(n: Integer, e: i32) -> Self {
        // The exponent of zero is arbitrary.
        let Some(zeros) = n.find_one(0) else { return Self::zero() };
        let digits = Integer::from(&n >> zeros).to_digits::<u8>(Order::Msf);
        let byte = |digit: u8| T::from(digit).unwrap_or_else(T::nan);
        let (two, radix) = (byte(2), byte(16) * byte(16));
        let mut x = digits.into_iter().fold(T::zero(), |x, digit| x * radix + byte(digit));
        let e = e + zeros.cast_signed();
        for (factor, steps) in [(radix, e.abs() / 8), (two, e.abs() % 8)] {
            for _ in 0..steps {
                x = if e.is_negative() { x / factor } else { x * factor };
            }
        }
        Native(x)
    }

    /// Returns a number that this format represents.
    fn from_float(x: &rug::Float) -> Self {
        let (n, e) = x.to_integer_exp().expect("a finite number");
        let size = Self::scaled(n.abs(), e);
        if x.is_sign_negative() { -size } else { size }
    }

    /// Returns f(x), rounded once. The type itself returns what is not finite.
    fn correctly_rounded(self, f: fn(&mut rug::Float, Round) -> Ordering, own: fn(T) -> T) -> Self {
        let format = Self::format();
        let Ok(x) = self.to_exact() else { return Native(own(self.0)) };
        let mut y = rug::Float::with_val(format.bits, x.as_rational());
        let ordering = f(&mut y, Round::Nearest);
        if !y.is_finite() {
            return Native(own(self.0));
        }
        match format.fit(y, ordering) {
            Ok((y, _)) => Self::from_float(&y),
            Err(RangeError::Overflow { .. }) => Self::infinity(),
            Err(RangeError::Underflow { .. }) => Self::zero(),
        }
    }
}

impl<T: Float + Debug> ToExact for Native<T> {
    fn to_exact(&self) -> Result<Exact, NonFiniteError> {
        if !self.0.is_finite() {
            let infinity = if self.0.is_sign_negative() { f64::NEG_INFINITY } else { f64::INFINITY };
            return Err(NonFiniteError::of(if self.0.is_nan() { f64::NAN } else { infinity }));
        }
        if Self::bits() > u64::BITS {
            return Err(NonFiniteError::Incomplete);
        }
        let (mantissa, exponent, sign) = self.0.integer_decode();
        let (n, e) = (Integer::from(mantissa), i32::from(exponent));
        // A second decoding alone would lose the same part again.
        if Self::scaled(n.clone(), e) != Native(self.0.abs()) {
            return Err(NonFiniteError::Incomplete);
        }
        Ok(Exact((Rational::from(n) << e) * i32::from(sign)))
    }
    fn number_system(&self) -> NumberSystem {
        NumberSystem::Float(Self::format())
    }
    fn round_from_exact_with_ordering(&self, x: &Exact) -> Result<(Self, Ordering), RangeError> {
        let (nearest, ordering) = Self::format().round(&x.0)?;
        Ok((Self::from_float(&nearest), ordering))
    }
}

impl<T: Float + Debug> ExactText for Native<T> {
    fn text(&self) -> String {
        let Ok(x) = self.to_exact() else { return format!("{:?}", self.0) };
        // As many digits as distinguish any two numbers; the shorter decimal is then written without a power of ten.
        let most = 2 + Self::bits() as usize / 3;
        // Below a power of two numbers are closer, so one side of a tie can be the same float, the other not.
        let sides = [Round::Nearest, Round::Down, Round::Up];
        let shorter = (1..most).flat_map(|digits| sides.map(|side| x.decimal(digits, side).parse::<Exact>()));
        let found = shorter.flatten().find(|decimal| self.round_from_exact(decimal).as_ref() == Ok(self));
        found.unwrap_or(x).decimal(most, Round::Nearest)
    }
    fn neighbours(&self) -> [Self; 2] {
        [self.next_down(), self.next_up()]
    }
}

impl<T: Float + Debug> Exponential for Native<T> {
    fn exp(&self) -> Self {
        self.correctly_rounded(rug::Float::exp_round, T::exp)
    }
}
impl<T: Float + Debug> Logarithm for Native<T> {
    fn ln(&self) -> Self {
        self.correctly_rounded(rug::Float::ln_round, T::ln)
    }
    fn ln_1p(&self) -> Self {
        self.correctly_rounded(rug::Float::ln_1p_round, T::ln_1p)
    }
}

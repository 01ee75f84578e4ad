//! Floats whose `integer_decode` returns only a part of a number.

use num_traits::{Float, Num, NumCast, One, ToPrimitive, Zero};
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::number::{Exponential, Native, NonFiniteError, ToExact};
use spring_mass_contact::operators;
use spring_mass_contact::solver::{Method, laws, solve};
use std::num::FpCategory;

/// An f64 of which 24 bits are decoded, and whose precision is that of `EPSILON`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Lossy<const BITS: i32>(f64);

operators! { [const BITS: i32] Lossy<BITS>;
    Add add |a, b| Lossy(a.0 + b.0);
    Sub sub |a, b| Lossy(a.0 - b.0);
    Mul mul |a, b| Lossy(a.0 * b.0);
    Div div |a, b| Lossy(a.0 / b.0);
    Rem rem |a, b| Lossy(a.0 % b.0);
    - |a| Lossy(-a.0)
}
impl<const BITS: i32> Zero for Lossy<BITS> {
    fn zero() -> Self {
        Lossy(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}
impl<const BITS: i32> One for Lossy<BITS> {
    fn one() -> Self {
        Lossy(1.0)
    }
}
impl<const BITS: i32> Num for Lossy<BITS> {
    type FromStrRadixErr = <f64 as Num>::FromStrRadixErr;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        f64::from_str_radix(text, radix).map(Lossy)
    }
}
impl<const BITS: i32> ToPrimitive for Lossy<BITS> {
    fn to_i64(&self) -> Option<i64> {
        self.0.to_i64()
    }
    fn to_u64(&self) -> Option<u64> {
        self.0.to_u64()
    }
    fn to_f64(&self) -> Option<f64> {
        Some(self.0)
    }
}
impl<const BITS: i32> NumCast for Lossy<BITS> {
    fn from<T: ToPrimitive>(x: T) -> Option<Self> {
        x.to_f64().map(Lossy)
    }
}

macro_rules! float {
    (constants: $($constant:ident)+; tests: $($test:ident)+; functions: $($function:ident)+; of two: $($of_two:ident)+;) => {
        impl<const BITS: i32> Float for Lossy<BITS> {
            $(fn $constant() -> Self {
                Lossy(<f64 as Float>::$constant())
            })+
            $(fn $test(self) -> bool {
                self.0.$test()
            })+
            $(fn $function(self) -> Self {
                Lossy(Float::$function(self.0))
            })+
            $(fn $of_two(self, other: Self) -> Self {
                Lossy(Float::$of_two(self.0, other.0))
            })+
            fn epsilon() -> Self {
                Lossy(2f64.powi(1 - BITS))
            }
            fn classify(self) -> FpCategory {
                self.0.classify()
            }
            fn mul_add(self, a: Self, b: Self) -> Self {
                Lossy(self.0.mul_add(a.0, b.0))
            }
            fn powi(self, n: i32) -> Self {
                Lossy(self.0.powi(n))
            }
            fn sin_cos(self) -> (Self, Self) {
                (self.sin(), self.cos())
            }
            fn integer_decode(self) -> (u64, i16, i8) {
                assert!(BITS <= 64, "{BITS} bits");
                Float::integer_decode(self.0 as f32)
            }
        }
    };
}
float! {
    constants: nan infinity neg_infinity neg_zero min_value min_positive_value max_value;
    tests: is_nan is_infinite is_finite is_normal is_sign_positive is_sign_negative;
    functions: floor ceil round trunc fract abs signum recip sqrt exp exp2 ln log2 log10 cbrt sin cos tan asin acos atan
        exp_m1 ln_1p sinh cosh tanh asinh acosh atanh;
    of two: powf log max min abs_sub hypot atan2;
}

/// A part is not the value, and a number of more than 64 bits is not decoded.
#[test]
fn a_number_that_is_decoded_in_part_has_no_exact_value() {
    let third = 1.0 / 3.0;
    assert_eq!(Native(Lossy::<53>(0.75)).to_exact(), 0.75.to_exact());
    assert_eq!(Native(Lossy::<53>(third)).to_exact(), Err(NonFiniteError::Incomplete));
    assert_eq!(Native(Lossy::<64>(0.75)).to_exact(), 0.75.to_exact());
    assert_eq!(Native(Lossy::<65>(0.75)).to_exact(), Err(NonFiniteError::Incomplete));
}

/// The type itself returns 53 bits.
#[test]
fn an_exponential_is_rounded_to_the_bits_of_its_type() {
    assert_eq!(Native(Lossy::<24>(1.0)).exp().0.0, std::f32::consts::E as f64);
}

/// `solve` names the first parameter without an exact value, and the laws of scalars name what requires it.
#[test]
fn a_number_without_exact_value_is_refused() {
    let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 }.map(Lossy::<53>).map(Native);
    let refused = solve(&system, &Method::Lagrange).unwrap_err().to_string();
    assert_eq!(
        refused,
        "gravity Lossy(9.81): must be of a type whose integer_decode returns the whole number"
    );
    let samples = [0.0, 1.0, 1.0 / 3.0].map(Lossy::<53>).map(Native);
    let violation = laws::check_scalar_laws(&samples, |x| x.0.0.to_exact().unwrap()).unwrap_err();
    assert_eq!(violation.law, laws::ScalarLaw::SignOfSum);
}

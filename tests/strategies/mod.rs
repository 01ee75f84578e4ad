//! Strategies for test cases, systems with a given reaction R, in every number system.
//!
//! Numbers are small fractions times powers of two, log-uniform over many decades, so a case is the same on
//! every machine and in every scalar. c, m, l, Δ and R are sampled; H = l + Δ and g = (R + c Δ)/m follow. The
//! sign of R, and with it the state, is therefore known. A case is printed as options of `contact solve`.

pub mod runner;

pub use num_traits::Zero;
pub use proptest::prelude::*;
pub use runner::holds;
pub use spring_mass_contact::chapter::{SpringMass, system};
use spring_mass_contact::number::Real;
pub use spring_mass_contact::number::{Exact, Mpfr, OrderedField, PositivePart, ToExact};
pub use spring_mass_contact::solver::{
    Augmentation, Interval, Iterate, Method, Outcome, Plane, Scalar, Solution, SolveError, State, solve,
    solve_bilateral,
};
use std::fmt;

/// Floats of several precisions.
pub trait Float: Scalar + Real + ToExact {}
impl<T: Scalar + Real + ToExact> Float for T {}

/// Tests a law, `fn law<T: Float>(case: &Case<T>)`, in f32, f64 and MPFR with few and many bits.
macro_rules! in_every_float {
    ($($(#[$attribute:meta])* $law:ident from $cases:path;)*) => {$(
        $(#[$attribute])*
        mod $law {
            use super::*;
            #[test]
            fn f32() {
                holds($cases(NARROW), |case| super::$law(&case.rounded(&1f32)));
            }
            #[test]
            fn f64() {
                holds($cases(WIDE), |case| super::$law(&case.rounded(&1f64)));
            }
            #[test]
            fn mpfr() {
                let bits = prop_oneof![Just(8), Just(113), 8u32..300];
                holds(($cases(WIDE), bits), |(case, bits)| super::$law(&case.rounded(&float(*bits))));
            }
        }
    )*};
}
pub(crate) use in_every_float;

/// Parameters range over 2^±NARROW, for which no intermediate result leaves the range of f32 (2^±126). The
/// smallest one is û of a near-grazing system with Δ = 0: R/(c + ε) ≥ 2^(−6 − 4·8 − 3·3 − 60) > 2^−126.
pub const NARROW: i32 = 8;
/// Range of parameters for f64 (2^±1022), and for MPFR and rationals, which have no limit here.
pub const WIDE: i32 = 40;
/// ε/c ranges over 2^±PENALTIES.
pub const PENALTIES: i32 = 60;

/// A system with the arguments of the methods.
#[derive(Clone, PartialEq)]
pub struct Case<T> {
    pub system: SpringMass<T>,
    pub eps: T,
    /// Initial multiplier λ₀.
    pub start: T,
    pub tolerance: T,
}

impl<T> Case<T> {
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> Case<U> {
        Case {
            system: self.system.as_ref().map(&mut f),
            eps: f(&self.eps),
            start: f(&self.start),
            tolerance: f(&self.tolerance),
        }
    }
}

impl<T: Clone> Case<T> {
    pub fn penalty(&self) -> Method<T> {
        Method::Penalty { penalty: self.eps.clone() }
    }
    pub fn augmented(&self, max_augmentations: u64) -> Method<T> {
        augmentation(self.eps.clone(), self.tolerance.clone(), max_augmentations, self.start.clone())
    }
    /// Returns the three methods.
    pub fn methods(&self, max_augmentations: u64) -> [Method<T>; 3] {
        [Method::Lagrange, self.penalty(), self.augmented(max_augmentations)]
    }
}

impl<T: OrderedField> Case<T> {
    /// Returns the iteration from λ₀.
    pub fn steps(&self, plane: Plane) -> Augmentation<'_, T> {
        Augmentation::new(&self.system, &self.eps).with_multiplier(self.start.clone()).over(plane)
    }
}

impl<T: Scalar> Case<T> {
    /// Returns the results of the three methods for both planes.
    pub fn solutions(&self, max_augmentations: u64) -> Vec<(Plane, Method<T>, Solution<T>)> {
        let solved = |(plane, solve): (Plane, Solve<T>)| {
            let of = move |method| (plane, solve(&self.system, &method).expect("in range"), method);
            self.methods(max_augmentations).map(of).map(|(plane, answer, method)| (plane, method, answer))
        };
        planes().into_iter().flat_map(solved).collect()
    }
}

impl Case<Exact> {
    /// Returns the case with every number rounded once to the scalar and precision of `like`.
    pub fn rounded<T: ToExact>(&self, like: &T) -> Case<T> {
        self.map(|x| like.round_from_exact(x).expect("the parameters fit every float they are rounded into"))
    }
    /// Returns the case with another ε, given relative to c.
    pub fn with_penalty(&self, relative: &Exact) -> Self {
        Case { eps: &self.system.c * relative, ..self.clone() }
    }
    /// Returns R.
    pub fn reaction(&self) -> Exact {
        system::reaction(&self.system)
    }
    /// Returns the case that is printed like this.
    pub fn printed(text: &str) -> Self {
        let option =
            |name: &str| text.split_whitespace().skip_while(|word| *word != name).nth(1).expect(name);
        let number = |name| option(name).parse().expect(name);
        let [c, m, g, l, h] = ["--stiffness", "--mass", "--gravity", "--free-length", "--height"].map(number);
        let [eps, start, tolerance] = ["--penalty", "--initial-multiplier", "--tolerance"].map(number);
        Case { system: SpringMass { c, m, g, l, h }, eps, start, tolerance }
    }
}

impl<T: ToExact> Case<T> {
    /// Returns the case in rationals, for comparison with results in floats.
    pub fn exact(&self) -> Case<Exact> {
        self.map(exact)
    }
}

impl<T: Real + ToExact> Case<T> {
    /// Returns η.
    pub fn eta(&self) -> Exact {
        unit_roundoff(&self.eps)
    }
    /// Returns 1/η, the precision in the laws of rounding.
    pub fn precision(&self) -> Exact {
        int(1) / self.eta()
    }
    /// Returns a number rounded to the scalar and precision of the case.
    pub fn round(&self, x: &Exact) -> T {
        self.eps.round_from_exact(x).expect("in range")
    }
}

impl<T: ToExact> fmt::Debug for Case<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Case { system: SpringMass { c, m, g, l, h }, eps, start, tolerance } = self.exact();
        write!(
            f,
            "contact solve --stiffness {c} --mass {m} --gravity {g} --free-length {l} --height {h} \
             --method augmented --penalty {eps} --initial-multiplier {start} --tolerance {tolerance}"
        )
    }
}

/// Returns an augmentation.
pub fn augmentation<T>(penalty: T, tolerance: T, max_augmentations: u64, start: T) -> Method<T> {
    Method::Augmented { penalty, tolerance, max_augmentations, start }
}

/// The solver for a plane.
pub type Solve<T> = fn(&SpringMass<T>, &Method<T>) -> Result<Solution<T>, SolveError>;

/// Returns both planes, each with its solver.
pub fn planes<T: Scalar>() -> [(Plane, Solve<T>); 2] {
    [(Plane::Unilateral, solve), (Plane::Bilateral, solve_bilateral)]
}

/// Returns the exact value of a finite number.
pub fn exact<T: ToExact>(x: &T) -> Exact {
    x.to_exact().expect("finite")
}

/// Returns the exact bounds of an interval.
pub fn ends<T: ToExact>(interval: &Interval<T>) -> [Exact; 2] {
    [&interval.lower, &interval.upper].map(exact)
}

/// Returns `true` if an interval contains a rational number.
pub fn encloses<T: ToExact>(interval: &Interval<T>, x: &Exact) -> bool {
    let [lower, upper] = ends(interval);
    lower <= *x && *x <= upper
}

/// Returns η for the scalar and precision of `like`, which must not be zero.
pub fn unit_roundoff<T: Real + ToExact>(like: &T) -> Exact {
    exact(&like.unit_roundoff())
}

/// Returns `true` if the environment asks for all that is otherwise sampled, by `DEEP=1`.
pub fn is_deep() -> bool {
    std::env::var_os("DEEP").is_some_and(|value| value == "1")
}

/// Returns an exact integer.
pub fn int(n: i32) -> Exact {
    Exact::from(n)
}

/// Returns the number that is written like this.
pub fn q(text: &str) -> Exact {
    text.parse().expect(text)
}

/// Returns 1 in MPFR.
pub fn float(bits: u32) -> Mpfr {
    int(1).to_mpfr(bits)
}

/// Returns xⁿ.
pub fn power(x: &Exact, n: u32) -> Exact {
    (0..n).fold(int(1), |product, _| product * x)
}

/// Returns the exact deflection, independently of the library: Δ in contact, m g/c otherwise.
pub fn resting(s: &SpringMass<Exact>) -> Exact {
    let weight = &s.m * &s.g;
    let gap = &s.h - &s.l;
    if weight < &s.c * &gap { weight / &s.c } else { gap }
}

/// Returns the exact contact force.
pub fn pushing(s: &SpringMass<Exact>) -> Exact {
    &s.m * &s.g - &s.c * resting(s)
}

/// Returns the default system of the command: Δ = 0.05, R = 4.81.
pub fn default_system() -> SpringMass<Exact> {
    SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.map(q)
}

/// Returns the system of the doc examples: Δ = 2, R = 2.
pub fn example() -> SpringMass<f64> {
    SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 }
}

/// Exponents, with an increased frequency of zero and the limits.
fn exponent(span: i32) -> BoxedStrategy<i32> {
    prop_oneof![10 => -span..=span, 1 => Just(-span), 1 => Just(span), 2 => Just(0)].boxed()
}

/// Positive numbers, log-uniform over 2^±span: a fraction of small integers times a power of two.
pub fn positive(span: i32) -> BoxedStrategy<Exact> {
    let mantissa = prop_oneof![1 => Just((1, 1)), 3 => (1..=7, 1..=7), 3 => (1..=40, Just(5))];
    (mantissa, exponent(span)).prop_map(|((n, d), e)| int(n) / int(d) * Exact::power_of_two(e)).boxed()
}

/// Numbers of both signs.
pub fn nonzero(span: i32) -> BoxedStrategy<Exact> {
    (positive(span), any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x }).boxed()
}

/// Numbers of both signs and zero.
pub fn number(span: i32) -> BoxedStrategy<Exact> {
    prop_oneof![1 => Just(Exact::zero()), 8 => nonzero(span)].boxed()
}

/// R relative to c: of any magnitude, or close to grazing relative to the lengths.
#[derive(Clone, Debug)]
enum Size {
    Any(Exact),
    Near(i32),
}

/// Systems with one of these signs of R.
fn with_sign(span: i32, signs: &[i32]) -> BoxedStrategy<Case<Exact>> {
    let sign = prop::sample::select(signs.to_vec());
    let size = prop_oneof![3 => positive(span).prop_map(Size::Any), 1 => (1..4 * span).prop_map(Size::Near)];
    // λ₀ = 0, R itself, or some multiple of |R| and W, of either sign.
    let start = prop_oneof![3 => Just(None), 1 => Just(Some(int(1))), 3 => number(6).prop_map(Some)];
    let system = (positive(span), positive(span), number(span), number(span));
    let rest = (prop_oneof![1 => Just(0), 4 => exponent(PENALTIES)], positive(0), 0i32..60, start);
    (system, sign, size, rest)
        .prop_map(|((c, m, l, gap), sign, size, (e, factor, digits, start))| {
            let length = l.abs() + gap.abs();
            let size = match size {
                Size::Any(x) => x,
                Size::Near(n) if length.is_zero() => Exact::power_of_two(-n),
                Size::Near(n) => Exact::power_of_two(-n) * &length,
            };
            let r = int(sign) * &c * &size;
            let g = (&r + &c * &gap) / &m;
            let h = &l + &gap;
            let eps = &c * Exact::power_of_two(e);
            let start =
                start.map_or_else(Exact::zero, |f| f * if r.is_zero() { c.clone() } else { r.clone() });
            // Between about the largest length and far below the floors of f64.
            let tolerance = factor * (length + size) * Exact::power_of_two(-digits);
            Case { system: SpringMass { c, m, g, l, h }, eps, start, tolerance }
        })
        .boxed()
}

/// Systems in contact, grazing and separated.
pub fn any_state(span: i32) -> BoxedStrategy<Case<Exact>> {
    with_sign(span, &[1, 1, 1, 0, -1, -1])
}
/// Systems with R > 0.
pub fn in_contact(span: i32) -> BoxedStrategy<Case<Exact>> {
    with_sign(span, &[1])
}

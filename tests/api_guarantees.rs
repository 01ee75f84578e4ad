//! Properties of public types that users rely on, for all features.

use spring_mass_contact::chapter::{SpringMass, contact::Kkt};
use spring_mass_contact::number::{Ball, Dual};
use spring_mass_contact::solver::{
    Augmentation, Bounds, Interval, Iterate, Method, Outcome, Plane, Solution, SolveError, State,
};
use std::fmt::Debug;

/// Values can be copied, compared, printed by `{:?}`, and sent to other threads.
fn value<T: Clone + PartialEq + Debug + Send + Sync + 'static>() {}
fn copied<T: Copy>() {}
fn error<T: std::error::Error + Clone + PartialEq + Send + Sync + 'static>() {}

#[test]
fn public_types_have_the_common_traits() {
    value::<SpringMass<f64>>();
    value::<Solution<f64>>();
    value::<Bounds<f64>>();
    value::<Iterate<f64>>();
    value::<Ball<f64>>();
    value::<Dual<f64>>();
    copied::<Kkt<f64>>();
    value::<Kkt<f64>>();
    copied::<Interval<f64>>();
    value::<Interval<f64>>();
    copied::<Method<f64>>();
    value::<Method<f64>>();
    copied::<State>();
    copied::<Outcome>();
    copied::<Plane>();
    value::<State>();
    value::<Outcome>();
    value::<Plane>();
    fn shared<T: Clone + Debug + Send + Sync>() {}
    shared::<Augmentation<f64>>();
    error::<SolveError>();
}

#[cfg(feature = "mpfr")]
#[test]
fn public_types_with_mpfr_have_the_common_traits() {
    use spring_mass_contact::number::{
        Exact, Mpfr, NonFiniteError, NumberSystem, ParseError, RangeError, UnknownNumberSystem,
    };
    use spring_mass_contact::solver::{Advice, ReadError, Recommendation, SweepRow};
    use std::fmt::Display;

    value::<Exact>();
    value::<Mpfr>();
    value::<Advice<Mpfr>>();
    value::<Recommendation<f64>>();
    value::<SweepRow<Exact>>();
    copied::<NumberSystem>();
    value::<NumberSystem>();
    error::<NonFiniteError>();
    error::<ParseError>();
    error::<RangeError>();
    error::<UnknownNumberSystem>();
    error::<ReadError>();
    fn shown<T: Display>() {}
    shown::<Solution<f64>>();
    shown::<Interval<Mpfr>>();
    shown::<Kkt<Exact>>();
}

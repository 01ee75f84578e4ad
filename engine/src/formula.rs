//! Recorded formulas and statements about them.
//!
//! A generic function that is called with [`Tree`]s returns a record of what it computes. Records of any
//! subject can be [typeset](crate::number::Tree::typeset), collected in a [`Registry`], which recognises one
//! formula within another, and made part of a [`Statement`] under [`Hypothesis`]es, which `proof` proves. A
//! [`Program`](crate::number::Program) evaluates many of them at once.
//!
//! [`Tree`]: crate::number::Tree

pub mod claim;
mod hypothesis;
mod proposition;
mod registry;
mod sequence;
pub mod statement;
pub(crate) mod symbols;
mod typeset;

pub use claim::Rate;
pub use hypothesis::{Hypothesis, Relation};
pub use registry::{Call, Formula, Registry};
pub use statement::{Proposition, Statement};
pub(crate) use typeset::name_of_rounding;
pub use typeset::{Name, Notation, latex};

/// Records a generic function of named quantities, with the symbol of its value, as a
/// [`Formula`](crate::formula::Formula).
///
/// # Examples
///
/// ```
/// use provable::number::Field;
/// use provable::record;
///
/// /// Returns the distance of the image of an object at the distance g from a lens of focal length f.
/// fn image<T: Field>(f: &T, g: &T) -> T {
///     f * g / (g - f)
/// }
///
/// let formula = record!("b" = image(f, g));
/// assert_eq!(formula.tree.to_string(), "f g / (g − f)");
/// assert_eq!((formula.path, formula.arguments), ("image", vec!["f", "g"]));
/// ```
/// The number of arguments must be that of the function, and their names must differ:
///
/// ```compile_fail,E0061
/// # use provable::{number::Field, record};
/// # fn image<T: Field>(f: &T, g: &T) -> T { f * g / (g - f) }
/// record!("b" = image(f));
/// ```
/// ```compile_fail,E0416
/// # use provable::{number::Field, record};
/// # fn image<T: Field>(f: &T, g: &T) -> T { f * g / (g - f) }
/// record!("b" = image(f, f));
/// ```
#[macro_export]
macro_rules! record {
    ($symbol:literal = $first:ident $(:: $rest:ident)*($($argument:ident),+ $(,)?)) => {{
        let [$($argument),+] = $crate::number::symbols([$(stringify!($argument)),+]);
        let path = concat!(stringify!($first) $(, "::", stringify!($rest))*);
        let value = $first$(::$rest)*($(&$argument),+);
        $crate::formula::Formula::new(path, $symbol, &[$(stringify!($argument)),+], value).abbreviated()
    }};
}

//! Records as data: what functions compute, and what is claimed of it.
//!
//! A function that is generic over its number system leaves a record when it is called with [`Tree`]s. This
//! is what can be done with records, whatever they are about: [typeset](crate::number::Tree::typeset) them,
//! keep a [`Registry`] of them, by which one formula is known in another, and say something of them, as a
//! [`Statement`] under [`Hypothesis`]es, for `proof` to prove. A [`Program`](crate::number::Program) runs
//! many of them at once.
//!
//! [`Tree`]: crate::number::Tree

pub mod claim;
mod hypothesis;
mod registry;
mod sequence;
pub mod statement;
mod typeset;

pub use claim::Rate;
pub use hypothesis::{Hypothesis, Relation};
pub use registry::{Call, Formula, Registry};
pub use statement::{Proposition, Statement};
pub(crate) use typeset::name_of_rounding;
pub use typeset::{Name, Notation, latex};

/// Records a generic function of some quantities, with the symbol of its value, as a
/// [`Formula`](crate::formula::Formula).
///
/// ```
/// use provable::number::Field;
/// use provable::record;
///
/// /// Where a lens of the focal length f shows what is g away.
/// fn image<T: Field>(f: &T, g: &T) -> T {
///     f * g / (g - f)
/// }
///
/// let formula = record!("b" = image(f, g));
/// assert_eq!(formula.tree.to_string(), "f g / (g − f)");
/// assert_eq!((formula.path, formula.arguments), ("image", vec!["f", "g"]));
/// ```
///
/// The arguments have to be as many as those of the function, and different:
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
        $crate::formula::Formula::new(path, $symbol, &[$(stringify!($argument)),+], value).folded()
    }};
}

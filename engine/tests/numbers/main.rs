//! The same laws for every number system, against rationals.
//!
//! A [`System`](system::System) draws numbers together with the exact number each one stands for: a float stands
//! for its own value, a ball for any number inside it. A law is one generic function; the lists of `law!` say which
//! systems it is run for. What is said of all systems is in `laws.rs`, what only some of them have in files of
//! their own: floats, MPFR's among them with 3 bits, of which all pairs are tried; rationals; balls; duals; spellings.
//!
//! Rounding is judged by [`Format::round`](format::Format::round), which is written here from the definition, in
//! integers; of what it judges it uses only the rationals, and those are judged by [`Fraction`](exact::Fraction),
//! integers again.
#![cfg(feature = "mpfr")]

/// One test a law and system: `law::System`.
macro_rules! law {
    ($law:ident: $($System:ident)+) => {
        #[allow(non_snake_case)]
        mod $law {
            $(#[test]
            fn $System() {
                super::$law::<super::$System, _>();
            })+
        }
    };
}

mod ball;
mod draw;
mod dual;
mod exact;
mod floats;
mod format;
mod laws;
mod mpfr;
mod spellings;
mod system;

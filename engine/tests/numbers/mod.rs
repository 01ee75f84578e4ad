//! Laws of number systems, checked against rationals.
//!
//! A [`System`](system::System) draws numbers together with exact numbers that they represent: a float
//! represents its own value, a ball any number inside it. A law is one generic function; the lists of `law!`
//! name the systems for which it is tested. Laws of all systems are in `laws.rs`, those of some systems in
//! files of their own: floats, including those of MPFR with 3 bits, of which all pairs are tested; rationals;
//! balls; dual numbers; spellings.
//!
//! The reference for rounding is [`Format::round`](format::Format::round), written here from the definition,
//! in integers. It only uses rationals, whose reference is [`Fraction`](exact::Fraction), in integers again.

/// Defines one test for each law and system: `law::System`.
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

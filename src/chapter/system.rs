//! Fig. 1.1: a mass on a spring over a rigid plane, and quantities derived from its five parameters.

use crate::number::Field;
use std::fmt;

/// Fig. 1.1: the system. A mass hangs on a spring from a support; a rigid plane lies below it.
///
/// The fields are public and unchecked, since symbols and intermediate values cannot be checked;
/// [`solve`](crate::solver::solve) checks.
///
/// ```
/// use spring_mass_contact::chapter::SpringMass;
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// assert_eq!(system.map(|x| 2.0 * x).c, 200.0);
/// assert_eq!(system.map(|x| x as f32).h, 1.05);
/// ```
///
/// With the feature `serde` it is serialised under the keys of `contact solve --batch`, `stiffness`, `mass`,
/// `gravity`, `free_length` and `height`: f32 and f64 as numbers, rationals and MPFR numbers as texts. A
/// `SpringMass<Exact>` is read from the texts of all of them without rounding.
/// [In the book](../../../../book/system.html#fn-system-SpringMass)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpringMass<T> {
    /// Stiffness of the spring, c > 0, in N/m.
    #[cfg_attr(feature = "serde", serde(rename = "stiffness"))]
    pub c: T,
    /// Mass, m > 0, in kg.
    #[cfg_attr(feature = "serde", serde(rename = "mass"))]
    pub m: T,
    /// Gravitational acceleration g, in m/s². Any finite value; a negative one lifts the mass.
    #[cfg_attr(feature = "serde", serde(rename = "gravity"))]
    pub g: T,
    /// Undeformed (free) length l of the spring, in m.
    #[cfg_attr(feature = "serde", serde(rename = "free_length"))]
    pub l: T,
    /// Height H between the support and the plane, in m.
    #[cfg_attr(feature = "serde", serde(rename = "height"))]
    pub h: T,
}

impl SpringMass<&'static str> {
    /// The symbols of the parameters.
    pub const SYMBOLS: Self = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" };

    /// The names of the parameters.
    pub const NAMES: Self =
        SpringMass { c: "stiffness", m: "mass", g: "gravity", l: "free length", h: "height" };

    /// The keys of the parameters in JSON: their names in one word.
    pub const KEYS: Self = SpringMass { l: "free_length", ..Self::NAMES };

    /// The units of the parameters.
    pub const UNITS: Self = SpringMass { c: "N/m", m: "kg", g: "m/s²", l: "m", h: "m" };
}

impl<T> SpringMass<T> {
    /// Returns the parameters in the order c, m, g, l, H.
    pub fn into_array(self) -> [T; 5] {
        let SpringMass { c, m, g, l, h } = self;
        [c, m, g, l, h]
    }

    /// Returns the parameter with this symbol, if it is one.
    ///
    /// ```
    /// # use spring_mass_contact::chapter::SpringMass;
    /// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    /// assert_eq!(["H", "ε"].map(|symbol| system.by_symbol(symbol)), [Some(&1.05), None]);
    /// ```
    pub fn by_symbol(&self, symbol: &str) -> Option<&T> {
        let mut named = SpringMass::SYMBOLS.zip(self.as_ref()).into_array().into_iter();
        named.find(|(own, _)| *own == symbol).map(|(_, x)| x)
    }

    /// Returns the system of references to the parameters.
    pub fn as_ref(&self) -> SpringMass<&T> {
        let SpringMass { c, m, g, l, h } = self;
        SpringMass { c, m, g, l, h }
    }

    /// Returns each parameter with that of another system.
    ///
    /// ```
    /// # use spring_mass_contact::chapter::SpringMass;
    /// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    /// let named = SpringMass::NAMES.zip(system).into_array();
    /// assert_eq!(named[3..], [("free length", 1.0), ("height", 1.05)]);
    /// ```
    pub fn zip<U>(self, other: SpringMass<U>) -> SpringMass<(T, U)> {
        let SpringMass { c, m, g, l, h } = self;
        SpringMass { c: (c, other.c), m: (m, other.m), g: (g, other.g), l: (l, other.l), h: (h, other.h) }
    }

    /// Returns the system with each parameter mapped.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> SpringMass<U> {
        let SpringMass { c, m, g, l, h } = self;
        SpringMass { c: f(c), m: f(m), g: f(g), l: f(l), h: f(h) }
    }

    /// Returns the system with each parameter converted, or the first error.
    ///
    /// # Errors
    /// The first error that `f` returns.
    pub fn try_map<U, E>(self, mut f: impl FnMut(T) -> Result<U, E>) -> Result<SpringMass<U>, E> {
        let SpringMass { c, m, g, l, h } = self;
        Ok(SpringMass { c: f(c)?, m: f(m)?, g: f(g)?, l: f(l)?, h: f(h)? })
    }
}

/// With symbols and units.
///
/// ```
/// # use spring_mass_contact::chapter::SpringMass;
/// let system = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
/// assert_eq!(system.to_string(), "c = 100 N/m, m = 1 kg, g = 9.81 m/s², l = 1 m, H = 1.05 m");
/// ```
impl<T: fmt::Display> fmt::Display for SpringMass<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let named = SpringMass::SYMBOLS.zip(self.as_ref()).zip(SpringMass::UNITS);
        let named = named.map(|((symbol, x), unit)| format!("{symbol} = {x} {unit}"));
        f.write_str(&named.into_array().join(", "))
    }
}

/// The initial gap, in m: how far the mass may go before it touches; negative if it overlaps.
///
/// `Δ = H − l`
///
/// Domain: all. One rounding. Source: §1.2, from (1.5).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, system};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(system::gap(&system), 2.0);
/// ```
pub fn gap<T: Field>(system: &SpringMass<T>) -> T {
    let SpringMass { l, h, .. } = system;
    h - l
}

/// The weight, in N.
///
/// `m g`
///
/// Domain: all. One rounding. Source: §1.1, before (1.1).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, system};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(system::weight(&system), 10.0);
/// ```
pub fn weight<T: Field>(system: &SpringMass<T>) -> T {
    let SpringMass { m, g, .. } = system;
    m * g
}

/// The signed reaction, in N: the force that holds the mass exactly at the plane.
///
/// `R = m g − c (H − l)`
///
/// Contact if R > 0, grazing if R = 0, separated if R < 0: the one number that decides the state.
/// Domain: all. Four roundings; close to grazing the difference cancels and floats may have its sign
/// wrong ([`State::of`](crate::solver::State::of) decides it exactly). Source: the chapter does not
/// name it; it is λ of (1.8).
///
/// ```
/// # use spring_mass_contact::chapter::{SpringMass, system};
/// let system = SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 };
/// assert_eq!(system::reaction(&system), 2.0);
/// ```
/// [In the book](../../../../book/system.html#fn-system-reaction)
pub fn reaction<T: Field>(system: &SpringMass<T>) -> T {
    let SpringMass { c, m, g, l, h } = system;
    m * g - c * (h - l)
}

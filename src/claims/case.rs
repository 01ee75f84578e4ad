//! Quantities of claims.

use crate::chapter::SpringMass;
use crate::formula::claim::{POWER, PRECISION};
use crate::number::{Dual, Tree};
use std::sync::LazyLock;

macro_rules! coordinates {
    (system { $($Parameter:ident $parameter:ident $of_parameter:literal;)* }
     $($Var:ident $field:ident $symbol:tt $text:literal;)*) => {
        /// A coordinate of a [`Case`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Var {
            $(#[doc = $of_parameter] $Parameter,)*
            $(#[doc = $text] $Var,)*
        }

        impl Var {
            /// All coordinates.
            pub const ALL: &[Var] = &[$(Var::$Parameter,)* $(Var::$Var),*];

            /// Returns the symbol in the chapter's notation.
            pub const fn symbol(self) -> &'static str {
                match self {
                    $(Var::$Parameter => SpringMass::SYMBOLS.$parameter,)*
                    $(Var::$Var => $symbol,)*
                }
            }
        }

        /// Numbers of one trial: a system and all other quantities of claims.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Case<T> {
            /// The five parameters.
            pub system: SpringMass<T>,
            $(#[doc = $text] pub $field: T,)*
        }

        impl<T> Case<T> {
            /// Returns the case with the coordinates that the function returns.
            ///
            /// # Errors
            /// Returns the first error of the function.
            pub fn try_of<E>(mut f: impl FnMut(Var) -> Result<T, E>) -> Result<Self, E> {
                let system = SpringMass { $($parameter: f(Var::$Parameter)?),* };
                Ok(Case { system, $($field: f(Var::$Var)?),* })
            }

            /// Returns a coordinate.
            pub fn get(&self, var: Var) -> &T {
                match var {
                    $(Var::$Parameter => &self.system.$parameter,)*
                    $(Var::$Var => &self.$field,)*
                }
            }

            /// Returns a mutable reference to a coordinate.
            pub fn get_mut(&mut self, var: Var) -> &mut T {
                match var {
                    $(Var::$Parameter => &mut self.system.$parameter,)*
                    $(Var::$Var => &mut self.$field,)*
                }
            }
        }
    };
}
coordinates! {
    system {
        C c "Stiffness, in N/m.";
        M m "Mass, in kg.";
        G g "Gravity, in m/s².";
        L l "Free length, in m.";
        H h "Height of the support above the plane, in m.";
    }
    U u "u" "A deflection, in m.";
    V v "v" "Another deflection, or the next one, in m; in `later_multiplier` a multiplier, in N.";
    Du du "δu" "A virtual displacement, in m.";
    Alpha alpha "α" "A dimensionless number, or a separate step size in N/m.";
    Eps eps "ε" "The penalty, in N/m.";
    Eps4 eps4 "ε₄" "The second coefficient of (1.10), in N/m³.";
    Lambda lambda "λ" "A multiplier, in N.";
    Q q POWER "The decay ρᵏ of some step k.";
    K k "k" "A number of steps.";
    T t "t" "A time.";
    Tol tol "tol" "A tolerance, in m.";
    Bits bits PRECISION "2ᵖ for numbers of p bits.";
}

impl Var {
    /// Returns the coordinate with this symbol, if there is one.
    pub fn named(symbol: &str) -> Option<Var> {
        Var::ALL.iter().copied().find(|var| var.symbol() == symbol)
    }
}

impl<T> Case<T> {
    /// Returns the case with the coordinates that the function returns.
    pub fn of(mut f: impl FnMut(Var) -> T) -> Self {
        let case = Case::try_of(|var| Ok::<T, std::convert::Infallible>(f(var)));
        case.unwrap_or_else(|never| match never {})
    }

    /// Returns the case with each coordinate mapped.
    pub fn map<U>(&self, mut f: impl FnMut(Var, &T) -> U) -> Case<U> {
        Case::of(|var| f(var, self.get(var)))
    }
}

impl<T: Clone> Case<T> {
    /// Returns the coordinate with this symbol.
    ///
    /// # Panics
    /// Panics if there is none.
    pub fn get_by_symbol(&self, symbol: &str) -> T {
        let var = Var::named(symbol);
        self.get(var.unwrap_or_else(|| panic!("{symbol} is not a coordinate"))).clone()
    }
}

impl Case<Tree> {
    /// Returns the case in dual numbers with this coordinate as the variable.
    pub fn with_dual_variable(&self, by: &Tree) -> Case<Dual<Tree>> {
        self.map(|_, x| Dual::coordinate(x.clone(), x == by))
    }
}

/// Returns the case whose coordinates are symbols, from which claims are constructed.
pub fn symbols() -> &'static Case<Tree> {
    static SYMBOLS: LazyLock<Case<Tree>> = LazyLock::new(|| Case::of(|var| Tree::symbol(var.symbol())));
    &SYMBOLS
}

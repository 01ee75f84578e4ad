//! Quantities of claims.

use crate::chapter::SpringMass;
use crate::number::{Dual, Tree};
use std::sync::LazyLock;

macro_rules! coordinates {
    ($($Var:ident $field:ident $symbol:literal $text:literal;)*) => {
        /// A coordinate of a [`Case`].
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Var {
            /// Stiffness, in N/m.
            C,
            /// Mass, in kg.
            M,
            /// Gravity, in m/s².
            G,
            /// Free length, in m.
            L,
            /// Height of the support above the plane, in m.
            H,
            $(#[doc = $text] $Var,)*
        }

        impl Var {
            /// All coordinates.
            pub const ALL: &[Var] = &[Var::C, Var::M, Var::G, Var::L, Var::H, $(Var::$Var),*];

            /// Returns the coordinate with this symbol.
            pub fn named(symbol: &str) -> Option<Var> {
                match symbol {
                    $($symbol => Some(Var::$Var),)*
                    "c" => Some(Var::C), "m" => Some(Var::M), "g" => Some(Var::G),
                    "l" => Some(Var::L), "H" => Some(Var::H),
                    _ => None,
                }
            }

            /// Returns the symbol in the chapter's notation.
            pub fn symbol(self) -> &'static str {
                match self {
                    $(Var::$Var => $symbol,)*
                    Var::C => "c", Var::M => "m", Var::G => "g", Var::L => "l", Var::H => "H",
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
                let (c, m, g) = (f(Var::C)?, f(Var::M)?, f(Var::G)?);
                let system = SpringMass { c, m, g, l: f(Var::L)?, h: f(Var::H)? };
                Ok(Case { system, $($field: f(Var::$Var)?),* })
            }

            /// Returns a coordinate.
            pub fn get(&self, var: Var) -> &T {
                match var {
                    $(Var::$Var => &self.$field,)*
                    Var::C => &self.system.c, Var::M => &self.system.m, Var::G => &self.system.g,
                    Var::L => &self.system.l, Var::H => &self.system.h,
                }
            }

            /// Returns a mutable reference to a coordinate.
            pub fn get_mut(&mut self, var: Var) -> &mut T {
                match var {
                    $(Var::$Var => &mut self.$field,)*
                    Var::C => &mut self.system.c, Var::M => &mut self.system.m, Var::G => &mut self.system.g,
                    Var::L => &mut self.system.l, Var::H => &mut self.system.h,
                }
            }
        }
    };
}
coordinates! {
    U u "u" "A deflection, in m.";
    V v "v" "Another deflection, or the next one, in m; in `later_multiplier` a multiplier, in N.";
    Du du "δu" "A virtual displacement, in m.";
    Alpha alpha "α" "A dimensionless number, or a separate step size in N/m.";
    Eps eps "ε" "The penalty, in N/m.";
    Eps4 eps4 "ε₄" "The second coefficient of (1.10), in N/m³.";
    Lambda lambda "λ" "A multiplier, in N.";
    Q q "q" "The decay ρᵏ of some step k.";
    K k "k" "A number of steps.";
    T t "t" "A time.";
    Tol tol "tol" "A tolerance, in m.";
    Bits bits "2ᵖ" "2ᵖ for numbers of p bits.";
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

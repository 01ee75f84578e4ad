//! The chapter as data: [`entries`] say what it states, [`claims`](claims()) what is checked of it.
//!
//! A claim is made of recorded formulas, and written once. In rationals it is checked with `==`; in balls, within
//! the bounds they compute; for all values it is proved. Its [`Given`]s are hypotheses; a [`Case`] holds the numbers
//! for one trial.

mod entries;
#[cfg(feature = "mpfr")]
mod experiments;
mod formulas;
#[cfg(feature = "serde")]
mod json;
mod list;
mod numbers;

pub use entries::{Entry, entries, entry, place};
#[cfg(feature = "mpfr")]
pub use experiments::{Experiment, Trial, exact_experiments, first_order_experiments, float_experiments};
pub use formulas::{Call, Formula, call, calls, computed, fill, formula, formula_in, formulas, line, named};
pub use numbers::{all_numbered, numbered};

use crate::chapter::{SpringMass, augmented, contact, penalty, system};
use crate::number::tree::Step;
use crate::number::{Dual, Field, Tree};
use std::fmt;
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
            /// Height, in m.
            H,
            $(#[doc = $text] $Var,)*
        }

        impl Var {
            /// All of them.
            pub const ALL: &[Var] = &[Var::C, Var::M, Var::G, Var::L, Var::H, $(Var::$Var),*];

            /// Its symbol in the chapter's notation.
            pub fn symbol(self) -> &'static str {
                match self {
                    $(Var::$Var => $symbol,)*
                    Var::C => "c", Var::M => "m", Var::G => "g", Var::L => "l", Var::H => "H",
                }
            }
        }

        /// The numbers of one trial: a system and everything else a claim may speak of.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Case<T> {
            /// The five parameters.
            pub system: SpringMass<T>,
            $(#[doc = $text] pub $field: T,)*
        }

        impl<T> Case<T> {
            /// The case whose coordinates the function gives.
            ///
            /// # Errors
            /// The first that it returns.
            pub fn try_of<E>(mut f: impl FnMut(Var) -> Result<T, E>) -> Result<Self, E> {
                let system = SpringMass { c: f(Var::C)?, m: f(Var::M)?, g: f(Var::G)?, l: f(Var::L)?, h: f(Var::H)? };
                Ok(Case { system, $($field: f(Var::$Var)?),* })
            }

            /// One coordinate.
            pub fn get(&self, var: Var) -> &T {
                match var {
                    $(Var::$Var => &self.$field,)*
                    Var::C => &self.system.c, Var::M => &self.system.m, Var::G => &self.system.g,
                    Var::L => &self.system.l, Var::H => &self.system.h,
                }
            }

            /// One coordinate, to be changed.
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
    V v "v" "Another deflection, or the next one, in m.";
    Du du "δu" "A virtual displacement, in m.";
    Alpha alpha "α" "A pure number, or a step of its own in N/m.";
    Eps eps "ε" "The penalty, in N/m.";
    Eps4 eps4 "ε₄" "The second coefficient of (1.10), in N/m³.";
    Lambda lambda "λ" "A multiplier, in N.";
    Q q "q" "The decay ρᵏ of some step k.";
    K k "k" "A number of steps.";
    T t "t" "A time.";
    Tol tol "tol" "A tolerance, in m.";
}

impl<T> Case<T> {
    /// The case whose coordinates the function gives.
    pub fn of(mut f: impl FnMut(Var) -> T) -> Self {
        let case = Case::try_of(|var| Ok::<T, std::convert::Infallible>(f(var)));
        case.unwrap_or_else(|never| match never {})
    }

    /// The same case in other numbers.
    pub fn map<U>(&self, mut f: impl FnMut(Var, &T) -> U) -> Case<U> {
        Case::of(|var| f(var, self.get(var)))
    }
}

impl<T: Clone> Case<T> {
    /// The coordinate of this name.
    ///
    /// # Panics
    /// There is none.
    pub fn named(&self, symbol: &str) -> T {
        let var = Var::ALL.iter().find(|var| var.symbol() == symbol);
        self.get(*var.unwrap_or_else(|| panic!("{symbol} is no coordinate"))).clone()
    }
}

/// `c = 1, m = 1/2` and so on, every coordinate.
impl<T: fmt::Display> fmt::Display for Case<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, var) in Var::ALL.iter().enumerate() {
            write!(f, "{}{} = {}", if i == 0 { "" } else { ", " }, var.symbol(), self.get(*var))?;
        }
        Ok(())
    }
}

impl<T: Field> Case<T> {
    /// The same case in dual numbers, with this coordinate as the variable.
    pub fn along(&self, by: Var) -> Case<Dual<T>> {
        self.map(|var, x| Dual::coordinate(x.clone(), var == by))
    }
}

impl Case<Tree> {
    /// The case whose coordinates are themselves.
    pub fn of_symbols() -> Self {
        Case::of(|var| Tree::symbol(var.symbol()))
    }
}

/// What is said of the sign of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Relation {
    /// > 0
    Positive,
    /// ≥ 0
    NonNegative,
    /// = 0
    Zero,
}

impl Relation {
    /// Does a number of this sign satisfy it?
    pub fn admits(self, sign: std::cmp::Ordering) -> bool {
        match self {
            Relation::Positive => sign.is_gt(),
            Relation::NonNegative => sign.is_ge(),
            Relation::Zero => sign.is_eq(),
        }
    }
}

macro_rules! hypotheses {
    ($($Given:ident $text:literal $relation:ident $solved_for:ident |$x:ident| $value:expr;)*) => {
        /// A hypothesis: what a claim supposes of its case.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Given { $(#[doc = $text] $Given),* }

        impl Given {
            /// All of them.
            pub const ALL: &[Given] = &[$(Given::$Given),*];

            /// As a reader writes it.
            pub fn text(self) -> &'static str {
                match self { $(Given::$Given => $text),* }
            }

            /// The quantity it speaks of.
            pub fn value<T: Field>(self, case: &Case<T>) -> T {
                match self { $(Given::$Given => { let $x = case; $value })* }
            }

            /// What it says of that quantity's sign.
            pub fn relation(self) -> Relation {
                match self { $(Given::$Given => Relation::$relation),* }
            }

            /// The coordinate to choose so that it holds: the quantity is linear in it.
            pub fn solved_for(self) -> Var {
                match self { $(Given::$Given => Var::$solved_for),* }
            }
        }
    };
}
hypotheses! {
    Stiffness "c > 0" Positive C |x| x.system.c.clone();
    Penalty "ε > 0" Positive Eps |x| x.eps.clone();
    Quartic "ε₄ ≥ 0" NonNegative Eps4 |x| x.eps4.clone();
    Softening "ε < 0" Positive Eps |x| -&x.eps;
    BeyondTwice "ε < −2c" Positive Eps |x| -&x.eps - T::int(2) * &x.system.c;
    WithinTwice "ε > −2c" Positive C |x| &x.eps + T::int(2) * &x.system.c;
    Twice "ε = −2c" Zero Eps |x| &x.eps + T::int(2) * &x.system.c;
    Contact "R > 0" Positive G |x| system::reaction(&x.system);
    Touching "R ≥ 0" NonNegative G |x| system::reaction(&x.system);
    Grazing "R = 0" Zero G |x| system::reaction(&x.system);
    Separated "R < 0" Positive G |x| -system::reaction(&x.system);
    Opposite "ε = −c" Zero Eps |x| penalty::total_stiffness(&x.system, &x.eps);
    BeyondOnce "ε < −c" Positive Eps |x| -penalty::total_stiffness(&x.system, &x.eps);
    Penetrating "p > 0" Positive U |x| contact::penetration(&x.system, &x.u);
    Clear "p < 0" Positive U |x| -contact::penetration(&x.system, &x.u);
    Tolerance "tol > 0" Positive Tol |x| x.tol.clone();
    Enough "ε ≥ R/tol − c" NonNegative Eps |x| &x.eps - penalty::penalty_for(&x.system, &x.tol);
    WithinTolerance "p_ε ≤ tol" NonNegative Tol |x| &x.tol - penalty::penetration(&x.system, &x.eps);
    StrongEnough "ε ≥ R" NonNegative Eps |x| &x.eps - system::reaction(&x.system);
    Multiplier "λ ≥ 0" NonNegative Lambda |x| x.lambda.clone();
    BelowReaction "λ < R" Positive Lambda |x| system::reaction(&x.system) - &x.lambda;
    AboveReaction "λ > R" Positive Lambda |x| &x.lambda - system::reaction(&x.system);
    AtReaction "λ = R" Zero Lambda |x| &x.lambda - system::reaction(&x.system);
    Carried "λ_k ≥ 0" NonNegative Q |x| augmented::multiplier_after(&x.system, &x.lambda, &x.q);
    Active "cλ + εR ≥ 0" NonNegative Lambda |x| &x.system.c * &x.lambda + &x.eps * system::reaction(&x.system);
    Idle "cλ + εR ≤ 0" NonNegative Lambda |x| -(&x.system.c * &x.lambda + &x.eps * system::reaction(&x.system));
    Inactive "λ + εp ≤ 0" NonNegative Lambda |x| -augmented::update(&x.system, &x.eps, &x.lambda, &x.u);
    Equilibrium "(1.19)" Zero Lambda |x| augmented::equilibrium(&x.system, &x.eps, &x.lambda, &x.u);
    NextEquilibrium "(1.20)" Zero V |x| {
        let next = augmented::update(&x.system, &x.eps, &x.lambda, &x.u);
        augmented::equilibrium(&x.system, &x.eps, &next, &x.v)
    };
    Step "α > 0" Positive Alpha |x| x.alpha.clone();
    ShortStep "α < 2(c + ε)" Positive Alpha |x| T::int(2) * penalty::total_stiffness(&x.system, &x.eps) - &x.alpha;
    LongStep "α > 2(c + ε)" Positive Alpha |x| &x.alpha - T::int(2) * penalty::total_stiffness(&x.system, &x.eps);
    UzawaStep "α < 2c" Positive Alpha |x| T::int(2) * &x.system.c - &x.alpha;
    Power "q > 0" Positive Q |x| x.q.clone();
    Count "k ≥ 0" NonNegative K |x| x.k.clone();
    Time "t > 0" Positive T |x| x.t.clone();
}

/// How a limit is checked in numbers: by the distance to it, in a form from which the limit can be read.
#[derive(Clone, Debug)]
pub enum Rate {
    /// The distance is this.
    Exactly(Tree),
    /// The distance is no more than this, either way.
    Within(Tree),
}

/// What is claimed, in the coordinates of a [`Case`].
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Kind {
    /// Two formulas are equal.
    Equal(Tree, Tree),
    /// A formula has a sign.
    Sign(Relation, Tree),
    /// One formula is the derivative of another.
    Derivative {
        /// The other.
        of: Tree,
        /// By this coordinate.
        by: Var,
        /// The one.
        is: Tree,
    },
    /// A formula tends to another as a coordinate tends to infinity.
    Limit {
        /// The formula.
        of: Tree,
        /// The coordinate.
        by: Var,
        /// Its limit.
        to: Tree,
        /// How fast.
        rate: Rate,
    },
    /// A recursion x₀ = start, x_{k+1} = step(x_k) has the closed form x_k = closed at q = ratioᵏ.
    Induction {
        /// What is raised to the power k.
        ratio: Tree,
        /// x₀.
        start: Vec<Tree>,
        /// The next x, by the [`MEMBERS`].
        step: Vec<Tree>,
        /// x_k, by q.
        closed: Vec<Tree>,
    },
    /// A formula in q = ratioᵏ tends to a limit as k grows: |ratio| < 1, and at q = 0 it is the limit.
    Vanishing {
        /// What is raised to the power k.
        ratio: Tree,
        /// The formula.
        of: Tree,
        /// Its limit.
        to: Tree,
    },
}

/// What the components of x_k are called in the step of an induction.
pub const MEMBERS: [&str; 4] = ["x₁", "x₂", "x₃", "x₄"];

impl Kind {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Equal(..) => "equal",
            Kind::Sign(..) => "sign",
            Kind::Derivative { .. } => "derivative",
            Kind::Limit { .. } => "limit",
            Kind::Induction { .. } => "induction",
            Kind::Vanishing { .. } => "vanishing",
        }
    }
}

/// Something said of an equation under hypotheses: recorded once, and read by provers, number systems and printers.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The [`Entry`] it belongs to.
    pub equation: &'static str,
    /// Its name, unique within the equation.
    pub name: &'static str,
    /// What it supposes.
    pub given: &'static [Given],
    /// What it says.
    pub kind: Kind,
}

impl Claim {
    /// Its formulas, but for those of its hypotheses.
    pub fn trees(&self) -> Vec<&Tree> {
        match &self.kind {
            Kind::Equal(a, b) | Kind::Derivative { of: a, is: b, .. } => vec![a, b],
            Kind::Sign(_, a) => vec![a],
            Kind::Limit { of, to, rate: Rate::Exactly(rate) | Rate::Within(rate), .. } => vec![of, to, rate],
            Kind::Vanishing { ratio, of, to } => vec![ratio, of, to],
            Kind::Induction { ratio, start, step, closed } => {
                [ratio].into_iter().chain(start).chain(step).chain(closed).collect()
            }
        }
    }

    /// Does it speak of eˣ, which rationals have not?
    pub fn has_exponentials(&self) -> bool {
        self.trees().into_iter().any(|tree| tree.any(&|tree| matches!(tree.step(), Step::Exp(_))))
    }

    /// With each of its formulas changed.
    pub fn map(&self, f: &impl Fn(&Tree) -> Tree) -> Self {
        let all = |trees: &[Tree]| trees.iter().map(f).collect();
        let kind = match &self.kind {
            Kind::Equal(a, b) => Kind::Equal(f(a), f(b)),
            Kind::Sign(relation, a) => Kind::Sign(*relation, f(a)),
            Kind::Derivative { of, by, is } => Kind::Derivative { of: f(of), by: *by, is: f(is) },
            Kind::Limit { of, by, to, rate } => {
                let rate = match rate {
                    Rate::Exactly(rate) => Rate::Exactly(f(rate)),
                    Rate::Within(rate) => Rate::Within(f(rate)),
                };
                Kind::Limit { of: f(of), by: *by, to: f(to), rate }
            }
            Kind::Vanishing { ratio, of, to } => Kind::Vanishing { ratio: f(ratio), of: f(of), to: f(to) },
            Kind::Induction { ratio, start, step, closed } => {
                Kind::Induction { ratio: f(ratio), start: all(start), step: all(step), closed: all(closed) }
            }
        };
        Claim { kind, ..self.clone() }
    }
}

/// Every claim.
pub fn claims() -> &'static [Claim] {
    static CLAIMS: LazyLock<Vec<Claim>> = LazyLock::new(list::record);
    &CLAIMS
}

/// The names of an entry's claims, in whatever number system they are checked.
#[cfg(feature = "mpfr")]
pub fn claim_names(equation: &str) -> Vec<&'static str> {
    let recorded = claims().iter().map(|c| (c.equation, c.name));
    let floats = float_experiments::<f64>().into_iter().chain(first_order_experiments());
    let floats = floats.map(|e| (e.equation, e.name));
    let rationals = exact_experiments().into_iter().map(|e| (e.equation, e.name));
    let all = recorded.chain(floats).chain(rationals);
    all.filter(|(e, _)| *e == equation).map(|(_, name)| name).collect()
}

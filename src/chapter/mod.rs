//! The equations of the chapter, each a function in the module of its section.
//!
//! | section | module | equations |
//! |---|---|---|
//! | the system | [`system`] | Fig. 1.1, the gap Δ, the weight W, the reaction R |
//! | 1.1 Structural part | [`structure`] | (1.1)-(1.4) |
//! | 1.2 Contact part | [`contact`] | (1.5)-(1.6) |
//! | 1.3.1 Lagrange multiplier method | [`lagrange`] | (1.7)-(1.8) |
//! | 1.3.2 Penalty method | [`penalty`] | (1.9)-(1.13), Fig. 1.2 |
//! | 1.3.3 Augmented Lagrangian method | [`augmented`] | (1.14)-(1.21), (1.33) |
//! | convergence as an ODE | [`ode`] | (1.22)-(1.32) |
//! | in floating point | [`rounding`] | note 8: rounding errors |
//! | beyond the chapter | [`beyond`] | further results |
//!
//! Notation: stiffness c > 0 in N/m, mass m in kg, gravity g in m/s² (any sign), free length l and
//! height H in m, deflection u in m (positive towards the plane), penetration p in m, multiplier λ and
//! contact force N in newtons (positive when the plane pushes), penalty ε > 0 in N/m. Derived: the gap Δ
//! ([`system::gap`]), the weight W ([`system::weight`]), the reaction R ([`system::reaction`]), the
//! contraction factor ρ ([`augmented::contraction`]). The formula in a function's comment is what the
//! function computes: a test compares the two.
//!
//! Every function is generic in its numbers and knows nothing of them. Statements about rounding hold
//! for floats without over- or underflow; read the same function in [`Ball`](crate::number::Ball) to
//! have its bound computed. Functions do not check their arguments: outside the stated domain they
//! divide by zero as their number system does; [`solve`](crate::solver::solve) checks.
//!
//! The examples share one system whose numbers come out exactly in binary: c = 4, m = 1, g = 10,
//! l = 1, H = 3, so that Δ = 2 m, W = 10 N and R = 2 N.

pub mod augmented;
pub mod beyond;
pub mod contact;
pub mod lagrange;
pub mod ode;
pub mod penalty;
pub mod rounding;
pub mod structure;
pub mod system;

pub use system::SpringMass;

//! The chapter as data: [`entries`] say what it states, and what is [claimed](claims()) of it.
//!
//! There is a file for each section of the chapter, with the symbols of its formulas at its head, and then
//! its entries with their claims. A claim is made of the chapter's functions, called with [`symbols`], and
//! so recorded once. In rationals it is checked with `==`; in balls, within the bounds they compute; for
//! all values it is proved. What it supposes is [`given`]; a [`Case`] holds the numbers for one trial.

mod augmented;
mod beyond;
mod case;
mod contact;
mod entry;
mod formulas;
mod given;
mod lagrange;
mod notes;
mod numbers;
mod ode;
mod penalty;
mod rounding;
mod structure;
mod system;

pub use case::{Case, Var, symbols};
pub use entry::Entry;
pub use formulas::computed;
pub use given::{Given, given};
pub use numbers::{all_numbered, numbered};

use crate::formula::{Registry, Statement};
use std::sync::LazyLock;

/// What the files of the sections are written with.
mod prelude {
    pub(super) use super::formulas::formulas;
    pub(super) use super::rounding::eta;
    pub(super) use super::{Case, Entry, Given, given, symbols};
    pub(super) use crate::formula::Rate::{Exactly, Within};
    use crate::formula::claim;
    pub(super) use crate::formula::claim::{
        derivative, drift, equal, induction, limit, non_negative, positive, vanishing, within,
    };
    pub(super) use crate::number::{Dual, Exponential, Field, PositivePart, Tree};
    use std::sync::LazyLock;

    /// 2ᵖ for numbers of p bits.
    pub(super) fn precision() -> &'static Tree {
        static PRECISION: LazyLock<Tree> = LazyLock::new(|| Tree::symbol(claim::PRECISION));
        &PRECISION
    }

    /// What a sequence has come to, in the step of an induction.
    pub(super) fn member() -> &'static Tree {
        static MEMBER: LazyLock<Tree> = LazyLock::new(|| Tree::symbol(claim::MEMBERS[0]));
        &MEMBER
    }

    pub(super) fn int(n: i32) -> Tree {
        Tree::from(n)
    }

    pub(super) fn half(x: Tree) -> Tree {
        x / int(2)
    }

    pub(super) fn square(x: impl Into<Tree>) -> Tree {
        let x = x.into();
        &x * &x
    }
}

/// The functions of the chapter as formulas.
pub fn registry() -> &'static Registry {
    static REGISTRY: LazyLock<Registry> = LazyLock::new(|| {
        let symbols: Vec<_> = Var::ALL.iter().map(|var| var.symbol()).collect();
        Registry::new(&symbols, formulas::recorded())
            .alike(&[["c", "ε"], ["l", "H"]])
            .quiet(&["ε"])
            .with_factors(&["k", "q", "t", "tol", "c", "ε", "ε₄", "m", "g", "l", "H", "u", "v", "λ"])
    });
    &REGISTRY
}

/// All entries, in the chapter's order.
pub fn entries() -> &'static [Entry] {
    static ENTRIES: LazyLock<Vec<Entry>> = LazyLock::new(|| {
        let sections = [
            ("1", system::entries()),
            ("1.1", structure::entries()),
            ("1.2", contact::entries()),
            ("1.3.1", lagrange::entries()),
            ("1.3.2", penalty::entries()),
            ("1.3.3", augmented::entries()),
            ("1.3.3", ode::entries()),
            ("1.3.3", augmented::stopping()),
            ("notes", notes::entries()),
            ("beyond", beyond::entries()),
        ];
        let of =
            |(section, entries): (_, Vec<Entry>)| entries.into_iter().map(move |entry| entry.within(section));
        sections.into_iter().flat_map(of).collect()
    });
    &ENTRIES
}

/// The entry of a number.
pub fn entry(equation: &str) -> Option<&'static Entry> {
    place(equation).map(|place| &entries()[place])
}

/// The entry whose own function this is, or else one that names it.
///
/// ```
/// use spring_mass_contact::claims::entry_of;
/// assert_eq!(entry_of("penalty::deflection").unwrap().equation, "1.13");
/// ```
pub fn entry_of(function: &str) -> Option<&'static Entry> {
    let own = entries().iter().find(|entry| entry.functions.first() == Some(&function));
    own.or_else(|| entries().iter().find(|entry| entry.functions.contains(&function)))
}

/// Where a number stands among the entries: what is sorted by it is in the chapter's order.
pub fn place(equation: &str) -> Option<usize> {
    entries().iter().position(|entry| entry.equation == equation)
}

/// Every claim, in the order of the entries.
pub fn claims() -> impl Iterator<Item = &'static Statement> {
    entries().iter().flat_map(|entry| &entry.claims)
}

/// Returns a copy of every claim.
pub fn statements() -> Vec<Statement> {
    claims().cloned().collect()
}

//! The chapter as data: [`entries`] contain its equations with their [claims](claims()).
//!
//! Each section of the chapter has a file with the symbols of its formulas, followed by its entries and their
//! claims. A claim is constructed from the chapter's functions, called with [`symbols`], and so recorded
//! once. It is proved for all values, checked in rationals with `==`, and checked in balls within their
//! computed bounds. Its [`hypotheses`] have names; a [`Case`] holds the numbers of one trial.

mod augmented;
mod beyond;
mod case;
mod contact;
mod entry;
mod formulas;
mod hypotheses;
mod lagrange;
mod notes;
mod numbers;
mod ode;
mod penalty;
mod rounding;
mod source;
mod structure;
mod system;

pub use case::{Case, Var, symbols};
pub use entry::Entry;
pub use formulas::computed;
pub use hypotheses::{Hypotheses, hypotheses};
pub use numbers::{find_entries, find_entry};
pub use source::{SourceLine, find_definition, function_line};

use crate::formula::{Registry, Statement};
use crate::number::tree::Site;
use std::sync::LazyLock;

/// Imports of the files of the sections.
mod prelude {
    pub(super) use super::formulas::formulas;
    pub(super) use super::rounding::eta;
    pub(super) use super::{Case, Entry, Hypotheses, hypotheses, symbols};
    pub(super) use crate::formula::Rate::{Equal, Within};
    pub(super) use crate::formula::Statement;
    use crate::formula::claim;
    pub(super) use crate::formula::claim::{
        derivative, equal, geometric_limit, induction, limit, non_negative, perturbed_recursion, positive,
        within,
    };
    pub(super) use crate::number::{Dual, Exponential, Field, PositivePart, Tree};
    use std::sync::LazyLock;

    /// Returns 2ᵖ for numbers of p bits.
    pub(super) fn precision() -> &'static Tree {
        static PRECISION: LazyLock<Tree> = LazyLock::new(|| Tree::symbol(claim::PRECISION));
        &PRECISION
    }

    /// Returns the member of a sequence, for the step of an induction.
    pub(super) fn member() -> &'static Tree {
        static MEMBER: LazyLock<Tree> = LazyLock::new(|| Tree::symbol(claim::MEMBERS[0]));
        &MEMBER
    }

    pub(super) fn int(n: i32) -> Tree {
        Tree::from(n)
    }

    pub(super) fn half(x: impl Into<Tree>) -> Tree {
        x.into() / int(2)
    }

    pub(super) fn square(x: impl Into<Tree>) -> Tree {
        let x = x.into();
        &x * &x
    }
}

/// Returns the recorded functions of the chapter.
pub fn registry() -> &'static Registry {
    static REGISTRY: LazyLock<Registry> = LazyLock::new(|| {
        let symbols: Vec<_> = Var::ALL.iter().map(|var| var.symbol()).collect();
        Registry::new(&symbols, formulas::recorded())
            .with_confusable(&[["c", "ε"], ["l", "H"]])
            .with_factors(&["k", "q", "t", "tol", "c", "ε", "ε₄", "m", "g", "l", "H", "u", "v", "λ"])
    });
    &REGISTRY
}

/// Returns all entries in the chapter's order.
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
        let sections = sections.into_iter();
        sections
            .flat_map(|(name, entries)| entries.into_iter().map(move |entry| entry.within(name)))
            .collect()
    });
    &ENTRIES
}

/// Returns the entry with this equation number.
pub fn entry(equation: &str) -> Option<&'static Entry> {
    index_of(equation).map(|index| &entries()[index])
}

/// Returns the entry to which this function belongs, or otherwise one that names it.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::claims::entry_for_function;
/// assert_eq!(entry_for_function("penalty::deflection").unwrap().equation, "1.13");
/// ```
pub fn entry_for_function(function: &str) -> Option<&'static Entry> {
    let own = entries().iter().find(|entry| entry.functions.first() == Some(&function));
    own.or_else(|| entries().iter().find(|entry| entry.functions.contains(&function)))
}

/// Returns the function with the operation at this site of the source.
pub fn function_at(site: Site) -> Option<&'static str> {
    registry().has_site(&site).then_some(())?;
    // The formula of a function contains those of the functions that it calls, which are listed before it.
    let mut formulas = registry().formulas().iter();
    formulas.find(|formula| formula.tree.any(&|tree| tree.site() == site)).map(|formula| formula.path)
}

/// Returns the index of an equation number in the chapter's order.
pub fn index_of(equation: &str) -> Option<usize> {
    entries().iter().position(|entry| entry.equation == equation)
}

/// Returns all claims in the order of the entries.
pub fn claims() -> impl Iterator<Item = &'static Statement> {
    entries().iter().flat_map(|entry| &entry.claims)
}

/// Returns a copy of every claim.
pub fn statements() -> Vec<Statement> {
    claims().cloned().collect()
}

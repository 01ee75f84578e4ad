//! Localisation of mistakes by the functions that unproved claims have in common.

use crate::claims::{entry_for_function, registry};
use crate::formula::{Formula, Statement};
use crate::number::Tree;
use crate::number::tree::{Op, Site};
use std::collections::{BTreeMap, BTreeSet};

/// A function of the chapter that may be wrong.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Suspect {
    /// Entry to which the function belongs, or which names it.
    pub equation: Option<&'static str>,
    /// Path of the function: `penalty::deflection`.
    pub function: &'static str,
    /// Number of unproved claims that depend on it; 0 if it only returns an argument, so that claims cannot
    /// be seen to depend on it.
    pub unproved: usize,
    /// Number of proved claims that depend on it.
    pub proved: usize,
}

/// Returns the functions that best separate unproved claims from the others: most unproved claims depend on
/// them, and few other claims do. Only the best ones are returned.
pub(super) fn suspects(
    statements: &[Statement],
    formulas: &[Formula],
    unproved: &dyn Fn(&Statement) -> bool,
) -> Vec<Suspect> {
    if !statements.iter().any(unproved) {
        return Vec::new();
    }
    let idle = idle(formulas);
    if !idle.is_empty() {
        return idle;
    }
    let all = users(statements, unproved);
    // If a of n dependent claims and of f failing claims agree, a/√(n f) is the cosine between the two sets.
    let weight = |s: &Suspect| (s.unproved * s.unproved, s.unproved + s.proved);
    let compare = |a: &Suspect, b: &Suspect| {
        let ((x, n), (y, m)) = (weight(a), weight(b));
        (x * m).cmp(&(y * n))
    };
    let Some(best) = all.iter().max_by(|a, b| compare(a, b)) else { return Vec::new() };
    all.iter().filter(|suspect| compare(suspect, best).is_eq()).cloned().collect()
}

/// Returns the functions that only return an argument.
fn idle(formulas: &[Formula]) -> Vec<Suspect> {
    let idle = formulas.iter().filter(|formula| matches!(formula.tree.op(), Op::Symbol(_)));
    let suspect =
        |f: &Formula| Suspect { function: f.path, equation: equation(f.path), unproved: 0, proved: 0 };
    idle.map(suspect).collect()
}

/// Returns the functions on which every unproved claim depends, in the order of the registry.
pub(super) fn shared(statements: &[Statement], unproved: &dyn Fn(&Statement) -> bool) -> Vec<&'static str> {
    let failures = statements.iter().filter(|statement| unproved(statement)).count();
    let users = users(statements, unproved);
    let mut shared: Vec<_> = registry().formulas().iter().map(|formula| formula.path).collect();
    shared.dedup();
    shared.retain(|path| users.iter().any(|user| user.function == *path && user.unproved == failures));
    shared
}

/// Returns the functions on which unproved claims depend, with the numbers of unproved and proved claims that
/// do.
fn users(statements: &[Statement], unproved: &dyn Fn(&Statement) -> bool) -> Vec<Suspect> {
    let sites: Vec<(bool, BTreeSet<Site>)> = statements
        .iter()
        .map(|statement| {
            let mut sites = BTreeSet::new();
            for tree in statement.trees() {
                tree.visit(&mut |tree| {
                    sites.insert(tree.site());
                });
            }
            (unproved(statement), sites)
        })
        .collect();
    let mut own: BTreeMap<&'static str, BTreeSet<Site>> = BTreeMap::new();
    for formula in registry().formulas() {
        own_sites(formula.path, &formula.tree, own.entry(formula.path).or_default());
    }
    let user = |(function, own): (&&'static str, &BTreeSet<Site>)| {
        let containing = sites.iter().filter(|(_, sites)| !sites.is_disjoint(own));
        let (unproved, proved): (Vec<_>, Vec<_>) = containing.partition(|(unproved, _)| *unproved);
        Suspect { function, equation: equation(function), unproved: unproved.len(), proved: proved.len() }
    };
    own.iter().map(user).filter(|user| user.unproved > 0).collect()
}

fn equation(function: &str) -> Option<&'static str> {
    entry_for_function(function).map(|entry| entry.equation)
}

/// Collects the sites at which a function has operations of its own and does not call another function.
fn own_sites(path: &str, tree: &Tree, sites: &mut BTreeSet<Site>) {
    match registry().call(tree).filter(|call| call.formula.path != path) {
        Some(call) => call.arguments.iter().for_each(|argument| own_sites(path, argument, sites)),
        None => {
            if registry().has_site(&tree.site()) {
                sites.insert(tree.site());
            }
            tree.op().operands().for_each(|operand| own_sites(path, operand, sites));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::statements;
    use crate::proof::mutation::{Mutant, MutationOutcome, test_mutations};
    use crate::proof::prove;
    use rayon::prelude::*;

    /// Returns the suspects after a mutation.
    fn after(change: &Mutant, statements: &[Statement]) -> Vec<&'static str> {
        let breaks = |s: &&Statement| change.apply(s).is_some_and(|changed| prove(&changed).is_err());
        let broken: BTreeSet<_> =
            statements.iter().filter(breaks).map(|s| (s.equation(), s.name())).collect();
        let broken = |s: &Statement| broken.contains(&(s.equation(), s.name()));
        let suspects = suspects(statements, registry().formulas(), &broken);
        suspects.into_iter().map(|suspect| suspect.function).collect()
    }

    /// Except for a few per cent: a mutation can also break only claims about a caller.
    #[test]
    fn a_mutated_function_is_among_at_most_three_suspects() {
        // Claims about rounding take longer, and add no function.
        let statements: Vec<_> = statements().into_iter().filter(|s| !s.contains_rounding()).collect();
        let noticed = test_mutations(&statements, registry()).mutants;
        let noticed: Vec<_> =
            noticed.iter().filter(|(_, o)| matches!(o, MutationOutcome::Detected { .. })).collect();
        let is_in = |function: &str, change: &Mutant| {
            let mut sites = BTreeSet::new();
            let own = registry().formulas().iter().filter(|formula| formula.path == function);
            own.for_each(|formula| own_sites(formula.path, &formula.tree, &mut sites));
            sites.contains(&change.site)
        };
        let found = |(change, _): &&(Mutant, MutationOutcome)| {
            let suspects = after(change, &statements);
            assert!((1..=3).contains(&suspects.len()), "{change}: {suspects:?}");
            suspects.iter().any(|function| is_in(function, change))
        };
        let right = noticed.par_iter().filter(|of| found(of)).count();
        assert!(100 * right > 98 * noticed.len(), "{right} of {}", noticed.len());
    }

    #[test]
    fn every_function_of_the_chapter_computes_something() {
        assert_eq!(idle(registry().formulas()), []);
        let [c, l] = ["c", "l"].map(|name| Tree::symbol(name));
        let formulas = [("penalty::deflection", &c * &l), ("system::gap", l)];
        let formulas = formulas.map(|(path, tree)| Formula::new(path, "", &["c", "l"], tree));
        let gap = [Suspect { function: "system::gap", equation: Some("Fig. 1.1"), unproved: 0, proved: 0 }];
        assert_eq!(idle(&formulas), gap);
        assert_eq!(suspects(&statements(), &formulas, &|_| true), gap);
        assert_eq!(suspects(&statements(), &formulas, &|_| false), []);
    }

    /// Two claims of (1.13), about the deflection and its second form, and about the deflection and its rate.
    #[test]
    fn shared_functions_are_those_that_every_unproved_claim_depends_on() {
        let of =
            |names: &[&str]| shared(&statements(), &|s| s.equation() == "1.13" && names.contains(&s.name()));
        assert_eq!(of(&["two-forms"]), ["penalty::deflection", "penalty::deflection_divided"]);
        assert_eq!(of(&["two-forms", "rate"]), ["penalty::deflection"]);
    }

    /// A claim about the derivative of (1.10) does not depend on (1.3), which is another derivative.
    #[test]
    fn rules_of_differentiation_belong_to_no_function() {
        let is_force = |s: &Statement| (s.equation(), s.name()) == ("1.10", "force");
        assert!(statements().iter().any(is_force));
        assert!(!shared(&statements(), &is_force).contains(&"structure::first_variation"));
    }

    #[test]
    fn there_are_no_suspects_if_every_claim_is_proved() {
        assert_eq!(suspects(&statements(), registry().formulas(), &|_| false), []);
        assert_eq!(shared(&statements(), &|_| false), Vec::<&str>::new());
    }
}

//! The functions that all unproved claims use.

use crate::claims::function_at;
use crate::formula::Statement;
use crate::number::tree::Site;
use std::collections::BTreeSet;

/// Returns the functions that every one of these claims uses; none without claims.
pub(super) fn shared<'a>(claims: impl IntoIterator<Item = &'a Statement>) -> Vec<&'static str> {
    let shared = claims.into_iter().map(functions).reduce(|some, others| &some & &others);
    shared.into_iter().flatten().collect()
}

/// Returns the functions that have an operation in a claim.
fn functions(claim: &Statement) -> BTreeSet<&'static str> {
    let mut sites: BTreeSet<Site> = BTreeSet::new();
    claim.trees().for_each(|tree| {
        tree.visit(&mut |tree| {
            sites.insert(tree.site());
        });
    });
    sites.into_iter().filter_map(function_at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::claims;

    /// Returns the functions that these claims of an equation use.
    fn of(equation: &str, names: &[&str]) -> Vec<&'static str> {
        let chosen: Vec<_> =
            claims().filter(|claim| claim.equation() == equation && names.contains(&claim.name())).collect();
        assert_eq!(chosen.len(), names.len());
        shared(chosen)
    }

    /// Two claims of (1.13), about the deflection and its second form, and about the deflection and its rate.
    #[test]
    fn shared_functions_are_those_that_every_claim_uses() {
        assert_eq!(of("1.13", &["two-forms"]), ["penalty::deflection", "penalty::deflection_divided"]);
        assert_eq!(of("1.13", &["two-forms", "rate"]), ["penalty::deflection"]);
        // The rules of differentiation belong to no function.
        assert_eq!(of("1.10", &["force"]), ["contact::penetration"]);
    }
}

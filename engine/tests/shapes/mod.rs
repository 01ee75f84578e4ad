//! Claims of many shapes in Coq, and their acceptance if Coq is installed.

mod claims;
#[allow(dead_code, reason = "the other package uses the rest")]
#[path = "../../../tests/coqc/mod.rs"]
mod coqc;
#[allow(dead_code)]
#[path = "../../examples/springs.rs"]
mod springs;

use coqc::{accepts, named, of_claims};
use provable::formula::{Formula, Registry};
use provable::number::{Field, Tree};
use provable::proof::coq::{Development, LocatedClaim};
use provable::proof::prove;

#[test]
#[ignore = "requires Coq"]
fn coq_accepts_the_springs_in_series() {
    let (registry, claims) = (springs::registry(), springs::claims());
    let development = springs::coq(&registry, &claims);
    let theorems: Vec<_> =
        of_claims(&development.files()).flat_map(|f| named(&f.text, "Theorem")).map(String::from).collect();
    assert_eq!((theorems.len(), development.omitted().len()), (claims.len(), 0));
    accepts("springs", "Springs", &development);
}

#[test]
#[ignore = "requires Coq"]
fn coq_accepts_divisors_of_any_shape() {
    let claims = claims::claims();
    let registry = Registry::new(&["a", "b", "c", "d", "f", "g", "x", "y"], Vec::new());
    let placed = claims.iter().map(|claim| LocatedClaim { claim, section: "shapes", functions: &[] });
    let development = Development::new("Shapes", &registry, placed);
    assert!(development.omitted().is_empty(), "{:?}", development.omitted());
    accepts("shapes", "Shapes", &development);
}

/// Each rule of scripts, about symbols that are named like what scripts and the library's files call something.
#[test]
#[ignore = "requires Coq"]
fn coq_accepts_symbols_of_any_name() {
    let names = [
        "a", "b", "d", "e", "f", "g", "i", "k", "n", "o", "p", "r", "s", "t", "u", "v", "w", "x", "y", "z",
        "C", "D", "E", "F", "H1", "I", "K", "M", "N", "O", "P", "Q", "R", "S", "X", "Shown", "Rmin", "bpow",
        "choice", "exp", "fl", "identity", "is_lim", "prec", "s1", "tt",
    ];
    let claims: Vec<_> = names.chunks(6).flat_map(claims::about).collect();
    let formulas =
        ["two", "Shown", "same::size", "exp"].map(|name| Formula::new(name, "", &[], Tree::int(2)));
    let registry = Registry::new(&[], formulas.into());
    let placed = claims.iter().map(|claim| LocatedClaim { claim, section: claim.equation(), functions: &[] });
    let development = Development::new("Names", &registry, placed);
    assert!(development.omitted().is_empty(), "{:?}", development.omitted());
    accepts("names", "Names", &development);
}

#[test]
fn claims_of_many_shapes_are_proved() {
    let outcomes = claims::claims().into_iter().map(|claim| (claim.name(), prove(&claim)));
    let open = outcomes.filter_map(|(name, outcome)| Some(format!("{name}: {}", outcome.err()?)));
    let open: Vec<_> = open.collect();
    assert!(open.is_empty(), "{open:#?}");
}

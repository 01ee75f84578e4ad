//! Two springs in series: a formula is recorded, typeset, proved about, refuted after a mutation, and
//! exported to Coq.

use provable::formula::claim::{equal, positive};
use provable::formula::{Formula, Hypothesis, Registry, Relation, Statement};
use provable::number::{Field, Tree};
use provable::proof::coq::{Development, LocatedClaim};
use provable::proof::mutation::{MutationOutcome, MutationReport, test_mutations};
use provable::proof::{prove, render::ProofPrinter};

/// Returns the stiffness of two springs in series.
fn series<T: Field>(a: &T, b: &T) -> T {
    a * b / (a + b)
}

fn symbols() -> [Tree; 3] {
    ["a", "b", "F"].map(|name| Tree::symbol(name))
}

/// Returns a registry of the function, which later formulas may abbreviate by c.
pub fn registry() -> Registry {
    let [a, b, _] = symbols();
    let series = Formula::new("series", "c", &["a", "b"], series(&a, &b)).abbreviated();
    Registry::new(&["a", "b", "F"], vec![series])
}

/// Returns claims about the function.
pub fn claims() -> [Statement; 2] {
    let [a, b, force] = symbols();
    let [stiff_a, stiff_b] = [&a, &b].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
    let c = series(&a, &b);
    [
        equal("elongations-add", &force / &c, &force / &a + &force / &b).assuming([&stiff_a, &stiff_b]),
        positive("softer-than-each", &a - &c).assuming([&stiff_a, &stiff_b]),
    ]
}

/// Returns a definition and a theorem for each claim in Coq.
pub fn coq<'a>(registry: &'a Registry, claims: &[Statement]) -> Development<'a> {
    let placed = claims.iter().map(|claim| LocatedClaim { claim, section: "springs", functions: &[] });
    Development::new("Springs", registry, placed)
}

fn main() {
    let (registry, claims) = (registry(), claims());
    println!(
        "{}, and in numbers c(3, 6) = {}",
        registry.format_equation("series").unwrap(),
        series(&3.0, &6.0)
    );
    for statement in &claims {
        let (paper, proof) = (ProofPrinter::new(&registry), prove(statement).expect("true"));
        println!("\n{}\n  {}", paper.claim(statement), paper.proof(&proof).join("\n  "));
    }
    let MutationReport { mutants: changes, .. } = test_mutations(&claims, &registry);
    println!("\nchanged, it is refuted:");
    for (change, effect) in &changes {
        let MutationOutcome::Detected { refutation, .. } = effect else { panic!("{change} goes unnoticed") };
        println!("  {}: {}", change.mutation, refutation.counterexample());
    }
    println!("\nfor Coq:\n{}", coq(&registry, &claims).files()[1].text);
}

#[test]
fn it_runs() {
    main();
}

//! Two springs in series: the engine serves any formula. It is recorded, typeset, proved things of, refuted when it is
//! changed, and written for Coq.

use provable::formula::claim::{equal, positive};
use provable::formula::{Formula, Hypothesis, Registry, Relation, Statement};
use provable::number::{Field, Tree};
use provable::proof::controls::{Controls, Effect, controls};
use provable::proof::coq::{Development, Placed};
use provable::proof::{paper::Paper, prove};

/// The stiffness of two springs in series.
fn series<T: Field>(a: &T, b: &T) -> T {
    a * b / (a + b)
}

fn symbols() -> [Tree; 3] {
    ["a", "b", "F"].map(|name| Tree::symbol(name))
}

/// The function by its record, which later formulas may call c.
pub fn registry() -> Registry {
    let [a, b, _] = symbols();
    let series = Formula::new("series", "c", &["a", "b"], series(&a, &b)).folded();
    Registry::new(&["a", "b", "F"], vec![series])
}

/// What is claimed of it.
pub fn claims() -> [Statement; 2] {
    let [a, b, force] = symbols();
    let [stiff_a, stiff_b] = [&a, &b].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
    let c = series(&a, &b);
    [
        equal("elongations-add", &force / &c, &force / &a + &force / &b).assuming([&stiff_a, &stiff_b]),
        positive("softer-than-each", &a - &c).assuming([&stiff_a, &stiff_b]),
    ]
}

/// All of it for Coq: a definition, and a theorem for each claim.
pub fn coq<'a>(registry: &'a Registry, claims: &[Statement]) -> Development<'a> {
    let placed = claims.iter().map(|claim| Placed { claim, section: "springs", functions: &[] });
    Development::new("Springs", registry, placed)
}

fn main() {
    let (registry, claims) = (registry(), claims());
    println!("{}, and in numbers c(3, 6) = {}", registry.line("series").unwrap(), series(&3.0, &6.0));
    for statement in &claims {
        let (paper, proof) = (Paper::new(&registry), prove(statement).expect("true"));
        println!("\n{}\n  {}", paper.claim(statement), paper.proof(&proof).join("\n  "));
    }
    let Controls { changes, .. } = controls(&claims, &registry);
    println!("\nchanged, it is refuted:");
    for (change, effect) in &changes {
        let Effect::Noticed { refutation, .. } = effect else { panic!("{change} goes unnoticed") };
        println!("  {}: {}", change.what, refutation.counterexample());
    }
    println!("\nfor Coq:\n{}", coq(&registry, &claims).files()[1].text);
}

#[test]
fn it_runs() {
    main();
}

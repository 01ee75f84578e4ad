//! A loaded voltage divider: the resistance that a voltmeter must have, and the rounding error of its reading
//! in floats.

use provable::formula::claim::{PRECISION, Rate, equal, limit, non_negative, positive};
use provable::formula::{Hypothesis, Registry, Relation};
use provable::number::{Exact, Field, Tree, symbols};
use provable::proof::{prove, refute, render::ProofPrinter, rounding_bound};
use provable::record;

/// Returns the fraction of the source voltage at the second of two resistors, in Ω, with a load in parallel
/// to it.
fn loaded<T: Field>(r1: &T, r2: &T, load: &T) -> T {
    let parallel = r2 * load / (r2 + load);
    &parallel / (r1 + &parallel)
}

/// Returns the fraction without a load.
fn open<T: Field>(r1: &T, r2: &T) -> T {
    r2 / (r1 + r2)
}

fn main() {
    let registry = Registry::from_iter([record!("k" = loaded(r1, r2, load)), record!("k₀" = open(r1, r2))]);
    println!(
        "{}\n{}",
        registry.format_equation("loaded").unwrap(),
        registry.format_equation("open").unwrap()
    );
    let exact = loaded::<Exact>(&Exact::int(1000), &Exact::int(1000), &Exact::int(9500));
    println!("two resistors of 1 kΩ and a meter of 9.5 kΩ: {exact} of the voltage");

    let [r1, r2, load] = symbols(["r1", "r2", "load"]);
    let resistors = [&r1, &r2, &load].map(|r| Hypothesis::new(Relation::Positive, r.clone()));
    let (k, k0) = (loaded(&r1, &r2, &load), open(&r1, &r2));
    let source = &r1 * &r2 / (&r1 + &r2);
    let claims = [
        // Thévenin: the source feeds the load with k₀ U through both resistors in parallel.
        equal("source-resistance", k.clone(), &k0 * &load / (&load + &source)),
        positive("load-lowers-it", &k0 - &k),
        limit("ideal-meter", k.clone(), &load, &k0, Rate::Within(&k0 * &source / &load)),
    ];
    let paper = ProofPrinter::new(&registry);
    for claim in claims.map(|claim| claim.assuming(&resistors)) {
        prove(&claim).unwrap_or_else(|reason| panic!("{}", paper.describe(&claim, &reason)));
        println!("proved: {}", paper.claim(&claim));
    }

    // A load of ten times the second resistor does not always suffice for 1 %.
    let ten_times = Hypothesis::new(Relation::NonNegative, &load - Tree::int(10) * &r2);
    let error = (&k0 - &k) / &k0;
    let share = Tree::int(1) / Tree::int(100);
    let wrong = non_negative("one-percent", &share - &error).assuming(&resistors).assuming([&ten_times]);
    println!("refuted: {}, at {}", paper.claim(&wrong), refute(&wrong).expect("a counterexample"));

    // No digits cancel for any resistors.
    let precision = Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << 24));
    let bound =
        rounding_bound(&k, &k, &[&resistors[..], &[precision]].concat()).expect("all terms are positive");
    println!("relative error in f64: at most {:.2e}", bound.constant() / 2.0_f64.powi(53));
}

#[test]
fn it_runs() {
    main();
}

//! The Beverton-Holt model of a population: a recursion, its closed form for every generation, and its limit.

use provable::formula::claim::{equal, geometric_limit, induction, positive};
use provable::formula::{Hypothesis, Registry, Relation};
use provable::number::{Exact, Field, Tree, symbols};
use provable::proof::{prove, refute, render::ProofPrinter};
use provable::record;

/// Returns the next generation after n, which grows by the factor r > 1 while it is small; m is the capacity
/// divided by r − 1.
fn next<T: Field>(r: &T, m: &T, n: &T) -> T {
    r * n / (T::int(1) + n / m)
}

/// Returns the equilibrium of the population.
fn capacity<T: Field>(r: &T, m: &T) -> T {
    m * (r - T::int(1))
}

/// Returns the population after k generations from n, with q = (1/r)ᵏ.
fn generation<T: Field>(r: &T, m: &T, n: &T, q: &T) -> T {
    let whole = capacity(r, m);
    &whole * n / (n + (&whole - n) * q)
}

fn main() {
    let registry = Registry::from_iter([record!("N" = next(r, m, n)), record!("K" = capacity(r, m))]);
    println!(
        "{} and {}",
        registry.format_equation("next").unwrap(),
        registry.format_equation("capacity").unwrap()
    );
    let (mut size, half) = (Exact::int(10), Exact::int(1) / Exact::int(2));
    for k in 0..10 {
        let q = (0..k).fold(Exact::int(1), |q, _| q * &half);
        assert_eq!(size, generation(&Exact::int(2), &Exact::int(100), &Exact::int(10), &q));
        size = next(&Exact::int(2), &Exact::int(100), &size);
    }
    println!("ten generations from 10 to 100 at most, growing twofold at first: {size}");

    let [r, m, n, start, q] = symbols(["r", "m", "n", "N₀", "q"]);
    let one = Tree::int(1);
    let positives = [&m, &n, &start].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
    let growing = Hypothesis::new(Relation::Positive, &r - &one);
    let powers = [(Relation::Positive, q.clone()), (Relation::NonNegative, &one - &q)];
    let powers = powers.map(|(relation, value)| Hypothesis::new(relation, value));
    let (step, whole) = (next(&r, &m, &n), capacity(&r, &m));
    let closed = generation(&r, &m, &start, &q);
    let claims = [
        equal("stays", next(&r, &m, &whole), &whole).assuming([&positives[0], &growing]),
        positive("grows-below", &step - &n)
            .assuming(&positives[..2])
            .assuming([&Hypothesis::new(Relation::Positive, &whole - &n)]),
        induction("closed-form", &one / &r, [start.clone()], |[n]| [next(&r, &m, &n)], [closed.clone()])
            .assuming(&positives)
            .assuming([&growing])
            .assuming(&powers),
        geometric_limit("tends-to-capacity", &one / &r, closed, &whole)
            .assuming(&positives)
            .assuming([&growing]),
    ];
    let paper = ProofPrinter::new(&registry);
    for claim in &claims {
        prove(claim).unwrap_or_else(|reason| panic!("{}", paper.describe(claim, &reason)));
        println!("proved: {}", paper.claim(claim));
    }
    let wrong = positive("always-grows", &step - &n).assuming(&positives[..2]).assuming([&growing]);
    println!("refuted: {}, at {}", paper.claim(&wrong), refute(&wrong).expect("a counterexample"));
}

#[test]
fn it_runs() {
    main();
}

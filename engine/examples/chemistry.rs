//! A weak acid in water: its degree of dissociation, and why dilution increases it.

use provable::formula::claim::{PRECISION, derivative, equal, positive};
use provable::formula::{Hypothesis, Notation, Registry, Relation};
use provable::number::{Dual, Field, Tree, symbols};
use provable::proof::{prove, refute, render::ProofPrinter, rounding_bound};
use provable::record;

/// Returns the equilibrium constant of HA ⇌ H⁺ + A⁻, in mol/l, for the total concentration c of the acid and
/// its degree of dissociation α: Ostwald's law of dilution.
fn constant<T: Field>(c: &T, alpha: &T) -> T {
    c * alpha * alpha / (T::int(1) - alpha)
}

/// Returns the concentration at which the degree of dissociation is α.
fn concentration<T: Field>(k: &T, alpha: &T) -> T {
    k * (T::int(1) - alpha) / (alpha * alpha)
}

fn main() {
    let registry =
        Registry::from_iter([record!("K" = constant(c, alpha)), record!("C" = concentration(k, alpha))]);
    println!("{}", registry.format_equation("constant").unwrap());
    println!("{}", registry.formulas()[0].tree.typeset(Notation::Latex, &|_| None));
    println!(
        "acetic acid, K = 1.8e-5 mol/l, dissociates by a tenth at {:.2e} mol/l",
        concentration(&1.8e-5, &0.1)
    );
    let rate = concentration(&Dual::constant(1.8e-5), &Dual::variable(0.1)).derivative;
    println!("and by a hundredth more at {:.2e} mol/l less", -rate / 100.0);

    let [k, c, alpha] = symbols(["k", "c", "alpha"]);
    let positives = [&k, &c, &alpha].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
    let partly = Hypothesis::new(Relation::Positive, Tree::int(1) - &alpha);
    let diluted = concentration(&k, &alpha);
    let two = Tree::int(2);
    let slope = -&k * (&two - &alpha) / (&alpha * &alpha * &alpha);
    let claims = [
        equal("inverse", constant(&diluted, &alpha), &k),
        derivative("slope", diluted.clone(), &alpha, slope.clone()),
        // The degree of dissociation increases with dilution.
        positive("dilution-helps", -slope),
        // The usual approximation 1 − α ≈ 1 gives too small a constant.
        positive("approximation-is-below", constant(&c, &alpha) - &c * &alpha * &alpha),
    ];
    let paper = ProofPrinter::new(&registry);
    for claim in claims.map(|claim| claim.assuming(&positives).assuming([&partly])) {
        prove(&claim).unwrap_or_else(|reason| panic!("{}", paper.describe(&claim, &reason)));
        println!("proved: {} ({})", paper.claim(&claim), claim.name());
    }
    // Without this hypothesis the law is undefined.
    let open = positive("constant", constant(&c, &alpha)).assuming(&positives);
    println!("not proved: {}", paper.describe(&open, &prove(&open).expect_err("α may be 1")));
    let twice = constant(&c, &(&two * &alpha)) - &two * &two * constant(&c, &alpha);
    let half = Hypothesis::new(Relation::Positive, Tree::int(1) - &two * &alpha);
    let wrong = equal("a-square-law", twice, 0).assuming(&positives).assuming([&half]);
    println!("refuted: {}, at {}", paper.claim(&wrong), refute(&wrong).expect("a counterexample"));

    let range = Hypothesis::between(&alpha, Tree::int(1) / Tree::int(100), Tree::int(9) / Tree::int(10));
    let precision = Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << 24));
    let bound = rounding_bound(&diluted, &diluted, &[positives[0].clone(), range, precision]).expect("α < 1");
    println!(
        "relative error of the concentration in f64: at most {:.2e}",
        bound.constant() / 2.0_f64.powi(53)
    );
}

#[test]
fn it_runs() {
    main();
}

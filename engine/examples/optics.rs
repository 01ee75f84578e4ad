//! Two thin lenses: their combined power, the telescope, and the effect of a small error in their distance.

use provable::formula::claim::{PRECISION, Rate, derivative, equal, limit, positive};
use provable::formula::{Hypothesis, Registry, Relation};
use provable::number::{Field, Tree, symbols};
use provable::proof::{prove, refute, render::ProofPrinter, rounding_bound};
use provable::record;

/// Returns the image distance of a lens of focal length f for the object distance g.
fn image<T: Field>(f: &T, g: &T) -> T {
    f * g / (g - f)
}

/// Returns the power of two lenses at a distance d, in dioptres for lengths in metres: Gullstrand's equation.
fn power<T: Field>(f1: &T, f2: &T, d: &T) -> T {
    T::int(1) / f1 + T::int(1) / f2 - d / (f1 * f2)
}

/// Returns the distance of the focus from the second lens.
fn back_focus<T: Field>(f1: &T, f2: &T, d: &T) -> T {
    f2 * (f1 - d) / (f1 + f2 - d)
}

fn main() {
    let registry = Registry::from_iter([
        record!("b" = image(f, g)),
        record!("P" = power(f1, f2, d)),
        record!("B" = back_focus(f1, f2, d)),
    ]);
    println!(
        "{}",
        ["image", "power", "back_focus"].map(|path| registry.format_equation(path).unwrap()).join(", ")
    );
    println!("0.2 m and 0.1 m, 0.05 m apart: {} dioptres", power(&0.2, &0.1, &0.05));

    let [f, g, f1, f2, d] = symbols(["f", "g", "f1", "f2", "d"]);
    let above = |value: Tree| Hypothesis::new(Relation::Positive, value);
    let lenses = [above(f1.clone()), above(f2.clone())];
    let closer = above(&f1 - &d);
    let both = power(&f1, &f2, &d);
    let claims = [
        // The first image of a distant object is at f₁, which is d − f₁ in front of the second lens.
        equal("through-both", image(&f2, &(&d - &f1)), back_focus(&f1, &f2, &d))
            .assuming(&lenses)
            .assuming([&closer]),
        equal("telescope", power(&f1, &f2, &(&f1 + &f2)), 0).assuming(&lenses),
        positive("stronger-than-the-first", &both - Tree::int(1) / &f1).assuming(&lenses).assuming([&closer]),
        derivative("adjustment", both.clone(), &d, -(Tree::int(1) / (&f1 * &f2))).assuming(&lenses),
        limit("from-far", image(&f, &g), &g, &f, Rate::Equal(&f * &f / (&g - &f)))
            .assuming([&above(f.clone()), &above(&g - &f)]),
    ];
    let paper = ProofPrinter::new(&registry);
    for claim in &claims {
        prove(claim).unwrap_or_else(|reason| panic!("{}: {}", claim.name(), paper.describe(claim, &reason)));
        println!("proved: {} ({})", paper.claim(claim), claim.name());
    }
    let wrong = positive("always-converging", both.clone()).assuming(&lenses);
    println!("refuted: {}, at {}", paper.claim(&wrong), refute(&wrong).expect("a counterexample"));

    let mut assumed = [&f1, &f2].map(|x| Hypothesis::between(x, Tree::int(1) / Tree::int(10), 1)).to_vec();
    assumed.push(Hypothesis::between(&d, 0, Tree::int(1) / Tree::int(20)));
    assumed.push(Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << 24)));
    let bound = rounding_bound(&both, &Tree::int(1), &assumed).expect("lengths are bounded");
    println!("error of the power in f32: at most {:.1e} dioptres", bound.constant() / 2.0_f64.powi(24));
}

#[test]
fn it_runs() {
    main();
}

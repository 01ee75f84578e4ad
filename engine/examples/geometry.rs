//! The side of a line on which a point lies: a determinant, its invariance, and the reliability of its sign
//! in floats.

use provable::formula::claim::{PRECISION, equal, non_negative};
use provable::formula::{Hypothesis, Registry, Relation};
use provable::number::{Ball, Field, Tree, symbols};
use provable::proof::{prove, refute, render::ProofPrinter, rounding_bound};
use provable::record;

/// Returns twice the area of the triangle from the origin over (ax, ay) to (bx, by); positive for a left
/// turn.
fn turn<T: Field>(ax: &T, ay: &T, bx: &T, by: &T) -> T {
    ax * by - ay * bx
}

/// Returns the squared distance of two points.
fn distance<T: Field>(ax: &T, ay: &T, bx: &T, by: &T) -> T {
    let (dx, dy) = (bx - ax, by - ay);
    &dx * &dx + &dy * &dy
}

fn main() {
    let registry =
        Registry::from_iter([record!("A" = turn(ax, ay, bx, by)), record!("d²" = distance(ax, ay, bx, by))]);
    println!(
        "{}, {}",
        registry.format_equation("turn").unwrap(),
        registry.format_equation("distance").unwrap()
    );

    let [ax, ay, bx, by, cx, cy] = symbols(["ax", "ay", "bx", "by", "cx", "cy"]);
    let area = turn(&ax, &ay, &bx, &by);
    let square = |x: &Tree, y: &Tree| x * x + y * y;
    let dot = &ax * &bx + &ay * &by;
    let (a, b) = (square(&ax, &ay), square(&bx, &by));
    let moved = turn(&(&ax - &cx), &(&ay - &cy), &(&bx - &cx), &(&by - &cy));
    let claims = [
        equal("other-way-round", turn(&bx, &by, &ax, &ay), -&area),
        // Lagrange's identity: the squared area is |a|² |b|² − (a · b)².
        equal("lagrange", &area * &area + &dot * &dot, &a * &b),
        equal("from-another-origin", moved, &area + turn(&bx, &by, &cx, &cy) + turn(&cx, &cy, &ax, &ay)),
        // The law of cosines.
        equal("cosines", distance(&ax, &ay, &bx, &by), &a + &b - Tree::int(2) * &dot),
    ];
    let paper = ProofPrinter::new(&registry);
    for claim in &claims {
        prove(claim).unwrap_or_else(|reason| panic!("{}: {reason}", claim.name()));
        println!("proved: {} ({})", paper.claim(claim), claim.name());
    }
    let wrong = non_negative("no-larger-than-a-rectangle", &a * &b / Tree::int(2) - &area * &area);
    println!("refuted: {}, at {}", paper.claim(&wrong), refute(&wrong).expect("a counterexample"));

    // For coordinates up to 1 in absolute value the sign is right if the float exceeds the bound of its
    // error.
    let mut assumed = [&ax, &ay, &bx, &by].map(|x| Hypothesis::between(x, -1, 1)).to_vec();
    assumed.push(Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << 24)));
    let bound = rounding_bound(&area, &Tree::int(1), &assumed).expect("its terms are bounded");
    let least = bound.constant() / 2.0_f64.powi(53);
    println!("error in f64: at most {least:.2e}");

    // A ball decides the sign for given points; here it is undecided.
    let [third, half] = [3.0, 2.0].map(|n| Ball::point(1.0) / Ball::point(n));
    let on_a_line = turn(&third, &half, &(&third + &third), &(&half + &half));
    println!("of points on a line: {on_a_line:?}");
}

#[test]
fn it_runs() {
    main();
}

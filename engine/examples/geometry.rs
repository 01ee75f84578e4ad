//! The side of a line on which a point lies: a determinant, its invariance, and when its sign in floats can be trusted.

use provable::formula::claim::{PRECISION, equal, non_negative};
use provable::formula::{Hypothesis, Registry, Relation};
use provable::number::{Ball, Field, Tree, symbols};
use provable::proof::{paper::Paper, prove, refute, rounding_bound};
use provable::record;

/// Twice the area of the triangle from the origin over (ax, ay) to (bx, by); positive if it turns to the left.
fn turn<T: Field>(ax: &T, ay: &T, bx: &T, by: &T) -> T {
    ax * by - ay * bx
}

/// The square of the distance of two points.
fn distance<T: Field>(ax: &T, ay: &T, bx: &T, by: &T) -> T {
    let (dx, dy) = (bx - ax, by - ay);
    &dx * &dx + &dy * &dy
}

fn main() {
    let registry =
        Registry::from_iter([record!("A" = turn(ax, ay, bx, by)), record!("d²" = distance(ax, ay, bx, by))]);
    println!("{}, {}", registry.line("turn").unwrap(), registry.line("distance").unwrap());

    let [ax, ay, bx, by, cx, cy] = symbols(["ax", "ay", "bx", "by", "cx", "cy"]);
    let area = turn(&ax, &ay, &bx, &by);
    let square = |x: &Tree, y: &Tree| x * x + y * y;
    let dot = &ax * &bx + &ay * &by;
    let (a, b) = (square(&ax, &ay), square(&bx, &by));
    let moved = turn(&(&ax - &cx), &(&ay - &cy), &(&bx - &cx), &(&by - &cy));
    let claims = [
        equal("other-way-round", turn(&bx, &by, &ax, &ay), -&area),
        // Lagrange's identity: the areas are what |a · b|² lacks of |a|² |b|².
        equal("lagrange", &area * &area + &dot * &dot, &a * &b),
        equal("from-another-origin", moved, &area + turn(&bx, &by, &cx, &cy) + turn(&cx, &cy, &ax, &ay)),
        // The law of cosines.
        equal("cosines", distance(&ax, &ay, &bx, &by), &a + &b - Tree::int(2) * &dot),
    ];
    let paper = Paper::new(&registry);
    for claim in &claims {
        prove(claim).unwrap_or_else(|why| panic!("{}: {why}", claim.name()));
        println!("proved: {} ({})", paper.claim(claim), claim.name());
    }
    let wrong = non_negative("no-larger-than-a-rectangle", &a * &b / Tree::int(2) - &area * &area);
    println!("refuted: {}, at {}", paper.claim(&wrong), refute(&wrong).expect("a counterexample"));

    // Of coordinates up to 1 in size the sign is right if the float is larger than the bound of its error.
    let mut assumed = [&ax, &ay, &bx, &by].map(|x| Hypothesis::between(x, -1, 1)).to_vec();
    assumed.push(Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << 24)));
    let bound = rounding_bound(&area, &Tree::int(1), &assumed).expect("its terms are bounded");
    let least = bound.constant() / 2.0_f64.powi(53);
    println!("error in f64: at most {least:.2e}");

    // A ball says so for the points at hand: here nothing.
    let [third, half] = [3.0, 2.0].map(|n| Ball::exactly(1.0) / Ball::exactly(n));
    let on_a_line = turn(&third, &half, &(&third + &third), &(&half + &half));
    println!("of points on a line: {on_a_line:?}");
}

#[test]
fn it_runs() {
    main();
}

//! Laws of rounding compared with floats: they are nearly attained, and records with rounding are what floats compute.

use proptest::prelude::any;
use spring_mass_contact::chapter::{augmented, contact};
use spring_mass_contact::claims::{claims, computed, registry, symbols};
use spring_mass_contact::eval::{Point, Verdict, verdict_at};
use spring_mass_contact::formula::claim::{PRECISION, within};
use spring_mass_contact::formula::statement::Role;
use spring_mass_contact::formula::{Hypothesis, Proposition, Relation, Statement};
use spring_mass_contact::number::tree::{Op, piecewise_ops};
use spring_mass_contact::number::{Ball, Exact, Mpfr, PositivePart, ToExact, Tree};
use spring_mass_contact::proof::prove;

fn law(equation: &str, name: &str) -> &'static Statement {
    let found = claims().find(|claim| (claim.equation(), claim.name()) == (equation, name));
    found.unwrap_or_else(|| panic!("{equation} {name}"))
}

/// Parses numbers of `bits` bits: `c = 3/16, ε = 33`.
fn run(bits: i32, numbers: &'static str) -> Point {
    let number = |pair: &'static str| {
        let (name, x) = pair.split_once(" = ").unwrap();
        let x: Exact = x.parse().unwrap();
        assert_eq!(x.round_to_bits(bits as u32), Some(x.clone()), "{pair} has not {bits} bits");
        (name, x)
    };
    let precision = (PRECISION, Exact::power_of_two(bits));
    Point::new(numbers.split(", ").map(number).chain([precision]))
}

fn holds(claim: &Statement, point: &Point) -> bool {
    match verdict_at(claim, point) {
        Verdict::Holds => true,
        Verdict::Fails(..) => false,
        other => panic!("{} {}: {other:?} at {point}", claim.equation(), claim.name()),
    }
}

/// Returns the claim with a part of its bounds, or each of its numbers of this value, multiplied by a
/// fraction.
fn with(claim: &Statement, part: &Tree, times: (i32, i32)) -> Statement {
    let factor = Tree::from(times.0) / Tree::from(times.1);
    let lowered = |bound: &Tree| bound.rewrite(&|tree| (tree == part).then(|| tree * &factor));
    let bounds: Vec<Tree> = match claim.conclusion() {
        Some(sequence) => sequence.within.iter().map(|(_, bound)| bound.clone()).collect(),
        None => vec![bound(claim).clone()],
    };
    assert!(bounds.iter().any(|bound| lowered(bound) != *bound), "{part} does not occur in {bounds:?}");
    claim.map(&|tree| if bounds.contains(tree) { lowered(tree) } else { tree.clone() })
}

/// Each constant of each law, a fraction of it that is too small, and a run of floats that shows this.
#[test]
fn the_constants_of_the_laws_are_nearly_attained() {
    let s = &symbols().system;
    let (u, lambda) = (&symbols().u, &symbols().lambda);
    let int = |n: i32| Tree::from(n);
    let penetration = contact::penetration(s, u);
    let force = augmented::contact_force(s, u);
    let (sum, weight, spring) = (&s.l + u, &s.m * &s.g, &s.c * u);
    let runs = [
        ("1.1", "rounding", int(2), (3, 4), run(5, "m = 11, g = 3, c = 25")),
        ("1.5", "rounding", sum.with_rounding().abs(), (99, 100), run(2, "l = 1/4, u = 1, H = 1")),
        ("1.5", "rounding", penetration.with_rounding().abs(), (99, 100), run(2, "l = 3, u = -8, H = 1")),
        (
            "Remark 1.3.6",
            "rounding",
            weight.with_rounding().abs(),
            (99, 100),
            run(3, "m = 3, g = -3, c = 3/4, u = 3/2"),
        ),
        (
            "Remark 1.3.6",
            "rounding",
            spring.with_rounding().abs(),
            (99, 100),
            run(3, "m = 3/4, g = -3/2, c = 3, u = 3"),
        ),
        (
            "Remark 1.3.6",
            "rounding",
            force.with_rounding().abs(),
            (99, 100),
            run(3, "m = 3, g = -3, c = 3/4, u = 3/2"),
        ),
        (
            "1.13",
            "float-error",
            int(5),
            (9, 10),
            run(9, "c = 3/16, ε = 33, m = 1, g = -1, l = 21, H = 127/32"),
        ),
        ("1.13", "float-error", int(4), (7, 8), run(8, "c = 13/256, ε = 1, m = 7, g = 41, l = 0, H = -1")),
        ("1.12", "precision-law", s.h.abs(), (1, 2), run(5, "c = 1, ε = 32, m = 1, g = 1, l = 1, H = 1")),
        (
            "1.12",
            "precision-law",
            int(5),
            (9, 10),
            run(9, "c = 17/256, ε = 33, m = 1, g = -1, l = 17, H = -1/32"),
        ),
        (
            "1.12",
            "precision-law",
            int(7),
            (13, 14),
            run(12, "c = 7/2, ε = 4013/32, m = 2379, g = 227, l = -47, H = -33/32"),
        ),
        ("note 8", "floor", s.h.abs(), (99, 100), run(2, "l = 1, u = 1/4, H = 1, ε = 1, λ = 0")),
        ("note 8", "floor", lambda.abs(), (1, 2), run(2, "l = -1, u = 2, H = -1/4, ε = 1, λ = 4")),
        // Here the constants are larger than any run is known to need.
        (
            "1.16",
            "float-drift",
            int(11),
            (13, 22),
            run(24, "c = 771/8192, ε = 2049, m = 65, g = 537995264, l = 1, H = 5589/4"),
        ),
        (
            "1.16",
            "float-drift",
            int(20),
            (11, 40),
            run(10, "c = 1/4, ε = 268, m = 519, g = 549, l = -21, H = 1"),
        ),
        (
            "note 4",
            "float-unilateral-drift",
            int(11),
            (13, 22),
            run(24, "c = 771/8192, ε = 2049, m = 65, g = 537995264, l = 1, H = 5589/4"),
        ),
        (
            "note 4",
            "float-unilateral-drift",
            int(20),
            (11, 40),
            run(10, "c = 1/4, ε = 268, m = 519, g = 549, l = -21, H = 1"),
        ),
        (
            "note 4",
            "float-nearly-free",
            int(2),
            (3, 4),
            run(5, "c = 25, ε = 1048576, m = 11, g = -3, l = 1, H = 1"),
        ),
        (
            "note 4",
            "float-nearly-free",
            int(8),
            (1, 7),
            run(8, "c = 74, ε = 1/4, m = 42, g = -120, l = 6, H = -62"),
        ),
    ];
    for (equation, name, part, times, point) in &runs {
        let law = law(equation, name);
        assert!(holds(law, point), "{equation} {name} at {point}");
        let less = with(law, part, *times);
        assert!(!holds(&less, point), "{equation} {name} with {times:?} of {part} at {point}");
        assert!(prove(&less).is_err(), "{equation} {name} with {times:?} of {part}");
    }
    let shown =
        |claim: &&Statement| runs.iter().any(|(e, n, ..)| (*e, *n) == (claim.equation(), claim.name()));
    let bounds =
        claims().filter(|claim| claim.contains_rounding() && matches!(claim.kind(), "bound" | "drift"));
    let unshown: Vec<_> = bounds.filter(|claim| !shown(claim)).map(|claim| claim.name()).collect();
    // It says no more than the one before.
    assert_eq!(unshown, ["float-distance"]);
}

/// Returns the bound of a claim with a single bound.
fn bound(claim: &Statement) -> &Tree {
    let goals = claim.goals().iter().filter(|goal| goal.role == Role::Claim);
    let [Proposition::Within(_, bound)] = goals.map(|goal| &goal.proposition).collect::<Vec<_>>()[..] else {
        panic!("{} has no bound", claim.name())
    };
    bound
}

/// Returns the value of a record with rounding, by exact arithmetic.
fn rounded_to(bits: u32, tree: &Tree, at: &dyn Fn(&'static str) -> Exact) -> Option<Exact> {
    tree.eval(&|name| at(name), &|step| match step {
        Op::Rounded(x) => x.round_to_bits(bits),
        step => piecewise_ops(step),
    })
}

/// Every function of the chapter without eˣ, recorded with rounding, equals the result of floats bit for bit,
/// far from overflow and underflow.
fn records_round_as_floats_do<T: ToExact + Clone>(
    bits: u32,
    at: &dyn Fn(&'static str) -> T,
    computed: Vec<T>,
) {
    let exact = |name: &'static str| at(name).to_exact().unwrap();
    let mut compared = 0;
    for (formula, value) in registry().formulas().iter().zip(computed) {
        if formula.tree.any(&|tree| matches!(tree.op(), Op::Exp(_))) {
            continue;
        }
        if let (Some(expected), Ok(value)) =
            (rounded_to(bits, &formula.tree.with_rounding(), &exact), value.to_exact())
        {
            assert_eq!(value, expected, "{}", formula.name());
            compared += 1;
        }
    }
    assert!(compared > 50, "{compared} formulas compared");
}

/// No radius of a ball is smaller than the proved bound.
#[test]
fn the_radius_of_a_ball_is_at_least_the_proved_radius() {
    crate::strategies::holds(any::<u64>(), |seed| {
        let x = |name| Ball::point(f64::from(drawn(*seed, name)));
        let [a, b] = [x("u") / x("v") * x("w"), x("c") / x("m") + x("g")];
        let at = |name: &str| match name {
            "a" => a.value().to_exact().unwrap(),
            "b" => b.value().to_exact().unwrap(),
            "r" => a.radius().to_exact().unwrap(),
            "s" => b.radius().to_exact().unwrap(),
            name => panic!("{name} in a radius"),
        };
        if PositivePart::abs(&at("b")) <= at("s") {
            return;
        }
        let results = [&a + &b, &a - &b, &a * &b, &a / &b];
        for ((meant, _, radius, _), result) in radii().into_iter().zip(results) {
            let precision =
                |name: &'static str| if name == PRECISION { Exact::power_of_two(53) } else { at(name) };
            let proved = rounded_to(53, &radius, &precision).unwrap();
            assert!(result.radius().to_exact().unwrap() >= proved, "{meant}");
        }
    });
}

#[test]
fn rounded_records_agree_with_floats() {
    crate::strategies::holds(any::<u64>(), |seed| {
        let double = |name: &'static str| f64::from(drawn(*seed, name)) / 1024.0;
        records_round_as_floats_do(53, &double, computed(&double));
        let single = |name: &'static str| double(name) as f32;
        records_round_as_floats_do(24, &single, computed(&single));
        let short = |name: &'static str| Mpfr::rounded(3, double(name));
        records_round_as_floats_do(3, &short, computed(&short));
    });
}

/// Returns the terms of the radius of each operation of a ball around `a` ∘ `b`, for numbers x and y within r
/// and s of a and b.
fn radii() -> [(Tree, Tree, Tree, Vec<Hypothesis>); 4] {
    let [a, b, x, y, r, s] = ["a", "b", "x", "y", "r", "s"].map(|name| Tree::symbol(name));
    let eta = || Tree::from(1) / Tree::symbol(PRECISION);
    let own = |value: &Tree| eta() * value.with_rounding().abs();
    let positive = |value: Tree| Hypothesis::new(Relation::Positive, value);
    let given = vec![
        Hypothesis::new(Relation::NonNegative, r.clone()),
        Hypothesis::new(Relation::NonNegative, s.clone()),
    ];
    let (sum, difference, product, quotient) = (&a + &b, &a - &b, &a * &b, &a / &b);
    let away = positive(b.abs() - &s);
    let of_quotient =
        ((quotient.with_rounding().abs() + own(&quotient)) * &s + &r) / (b.abs() - &s) + own(&quotient);
    [
        (&x + &y, sum.clone(), &r + &s + own(&sum), given.clone()),
        (&x - &y, difference.clone(), &r + &s + own(&difference), given.clone()),
        (&x * &y, product.clone(), &r * (b.abs() + &s) + &s * a.abs() + own(&product), given.clone()),
        (&x / &y, quotient, of_quotient, [given, vec![away]].concat()),
    ]
}

#[test]
fn the_radius_of_a_ball_is_proved_for_every_precision() {
    let [a, b, x, y, r, s] = ["a", "b", "x", "y", "r", "s"].map(|name| Tree::symbol(name));
    for (meant, value, radius, given) in radii() {
        let near = [Hypothesis::near(&x, &a, &r), Hypothesis::near(&y, &b, &s)];
        let claim = |radius: &Tree| {
            within("encloses", &meant - value.with_rounding(), radius).assuming(&given).assuming(&near)
        };
        if let Err(reason) = prove(&claim(&radius)) {
            panic!("{meant}: {reason}");
        }
        // Nothing of it can be left out.
        let mut parts = Vec::new();
        radius.visit(&mut |tree| parts.push(tree.clone()));
        for part in parts.iter().filter(|part| [&r, &s].contains(part)) {
            let less = radius.rewrite(&|tree| (tree == part).then(|| tree / Tree::from(2)));
            assert!(prove(&claim(&less)).is_err(), "{meant} within {less}");
        }
    }
}

/// Draws a nonzero number of up to 20 bits for a symbol.
fn drawn(seed: u64, name: &str) -> i32 {
    let mixed = name
        .bytes()
        .fold(seed, |x, byte| (x ^ u64::from(byte)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(23));
    let size = (mixed >> 40) as i32 % (1 << 20) + 1;
    if mixed & 1 == 0 { size } else { -size }
}

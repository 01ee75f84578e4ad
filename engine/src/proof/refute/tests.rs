//! Tests of the search for counterexamples.

use super::*;
use crate::eval::{Failure, Value, verdict_at};
use crate::formula::claim::{
    derivative, equal, geometric_limit, induction, limit, non_negative, perturbed_recursion, positive, within,
};
use crate::formula::{Proposition, Rate, Relation, Statement};
use crate::number::{Exponential, PositivePart};
use num_traits::One;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn above_zero(name: &'static str) -> Hypothesis {
    Hypothesis::new(Relation::Positive, x(name))
}

fn point(numbers: &[(&'static str, i32)]) -> Point {
    Point::new(numbers.iter().map(|(name, n)| (*name, Exact::from(*n))))
}

/// Claims that c u + ε u − R = 0 at u = R/(c + ε).
fn root() -> Statement {
    let u = x("R") / (x("c") + x("ε"));
    let residual = x("c") * &u + x("ε") * &u - x("R");
    equal("root", residual, 0).assuming([&above_zero("c"), &above_zero("ε")])
}

/// Claims that R/(c + ε) → 0 as ε → ∞.
fn vanishes() -> Statement {
    let [stiff, penalty] = ["c", "ε"].map(above_zero);
    let p = x("R") / (x("c") + x("ε"));
    limit("vanishes", &p, &x("ε"), 0, Rate::Equal(p.clone())).assuming([&stiff, &penalty])
}

#[test]
fn a_divisor_that_is_zero_is_reported() {
    let root = root();
    let zero_sum = point(&[("c", -1), ("ε", 1)]);
    assert_eq!(verdict_at(&root, &zero_sum), Verdict::Excluded);
    assert_eq!(verdict_at(&root, &point(&[("c", 3)])), Verdict::Holds);
    let Verdict::Fails(_, how) = verdict_at(&root.without(&above_zero("c")), &zero_sum) else { panic!() };
    assert_eq!(how.to_string(), "undefined: c + ε = 0 is a divisor");
}

/// The limit itself is tested, without its rate.
#[test]
fn limits_are_decided_by_degrees() {
    let limit = vanishes();
    let Proposition::Limit(of, by, _) = &limit.goals()[0].proposition else { panic!() };
    let tends = |of: Tree, to: i32| {
        let claim = limit.with_proposition(Proposition::Limit(of, by, Tree::from(to)));
        match verdict_at(&claim, &point(&[("R", 2)])) {
            Verdict::Holds => None,
            Verdict::Fails("", failure) => Some(failure.to_string()),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!((tends(of.clone(), 0), tends(of + Tree::from(3), 3)), (None, None));
    let wrong = |text: &str| Some(format!("its distance from the limit {text}"));
    assert_eq!(tends(of.clone(), 1), wrong("tends to -1"));
    // ε R/(1 + ε) → 2 and ε² R/(1 + ε) → ∞.
    assert_eq!((tends(of * x("ε"), 2), tends(of * x("ε"), 0)), (None, wrong("tends to 2")));
    assert_eq!(tends(of * x("ε") * x("ε"), 0), wrong("is unbounded"));
    assert_eq!(tends(x("ε") / (x("ε") * Tree::from(4) + Tree::one()), 0), wrong("tends to 1/4"));
    // min(ε, R) and ⟨ε − R⟩ are R and ε − R for large ε, and min(R, ε) and ⟨R − ε⟩ are R and 0.
    assert_eq!(tends(PositivePart::min(&x("ε"), &x("R")), 2), None);
    assert_eq!(tends((x("ε") - x("R")).positive_part() - x("ε"), -2), None);
    assert_eq!(tends(PositivePart::min(&x("R"), &x("ε")) + (x("R") - x("ε")).positive_part(), 2), None);
    // The distance is still about 1 at 2²⁰⁰.
    let slow = (0..240).fold(x("ε"), |x, _| x / Tree::from(2));
    assert_eq!(tends(Tree::one() / (Tree::one() + &slow), 0), None);
    assert_eq!(tends(Tree::one() / (x("ε") - x("ε")), 0), Some("undefined: ε − ε = 0 is a divisor".into()));
    // The point itself may be a pole.
    assert_eq!(tends(Tree::one() / (x("ε") - Tree::one()), 0), None);
}

/// Exponentials tend to 0, to a number or to infinity; their sums, products and quotients as far as that is certain.
#[test]
fn limits_of_exponentials_are_decided_if_they_are_certain() {
    let (e, by, one) = (x("ε"), "ε", Tree::one());
    let tends = |of: &Tree| {
        let statement = equal("", 0, 0).with_proposition(Proposition::Limit(of.clone(), by, Tree::from(0)));
        match verdict_at(&statement, &point(&[("R", 2)])) {
            Verdict::Holds => Some(0),
            Verdict::Fails(_, Failure::NotConverging(Some(_))) => Some(1),
            Verdict::Fails(_, Failure::NotConverging(None)) => Some(2),
            Verdict::Undecided => None,
            other => panic!("{other:?}"),
        }
    };
    let (grows, decays) = (e.exp(), (-&e).exp());
    let number = (&e / (&e + &one)).exp();
    assert_eq!([&decays, &number, &grows].map(tends), [Some(0), Some(1), Some(2)]);
    let sums = [&grows + &e, &grows + &number, &decays + &number, &grows - &decays, -&grows, &grows - &e];
    assert_eq!(sums.each_ref().map(tends), [Some(2), Some(2), Some(1), Some(2), Some(2), None]);
    let products = [&grows * &e, &grows * -&number, &number * &number, &decays * &number, &decays * &e];
    assert_eq!(products.each_ref().map(tends), [Some(2), Some(2), Some(1), Some(0), None]);
    let signs =
        [-(&grows * &grows), &grows * -&grows, &grows * -&number, -(&grows * &number), -&grows * -&grows];
    assert_eq!(signs.map(|x| tends(&x.exp())), [Some(0), Some(0), Some(0), Some(0), Some(2)]);
    let quotients = [&number / &grows, &one / &decays, &decays / &number, &grows / &e];
    assert_eq!(quotients.each_ref().map(tends), [Some(0), None, Some(0), None]);
    assert_eq!([decays.positive_part(), (&grows - &e).exp()].each_ref().map(tends), [Some(0), None]);
}

/// The recursion x ← x² gives the powers of 1 from 1, but not the powers of 2 from 2.
#[test]
fn inductions_are_evaluated_at_the_powers_of_their_ratio() {
    let squares = |ratio: i32| {
        let claim = induction("squares", ratio, [Tree::from(1)], |[x]| [&x * &x], [x("q")]);
        verdict_at(&claim, &Point::default())
    };
    assert_eq!(squares(1), Verdict::Holds);
    assert!(matches!(squares(2), Verdict::Fails("step", Failure::Unequal(..))));
}

/// The claim includes that the ratio is less than 1 in absolute value and that the formula has its limit at q = 0.
#[test]
fn geometric_limits_include_their_conditions() {
    let q = || x("q");
    let tends =
        |ratio: i32, of: Tree| verdict_at(&geometric_limit("tends", ratio, of, 1), &point(&[("q", 3)]));
    assert_eq!(tends(0, q() + Tree::one()), Verdict::Holds);
    for ratio in [1, -1, 2] {
        assert!(matches!(tends(ratio, Tree::one()), Verdict::Fails("|ρ| < 1", Failure::Sign(..))));
    }
    assert_eq!(tends(0, q() / q()), Verdict::Fails("at q = 0", Failure::Undefined(Tree::from(0))));
}

/// The derivative of ⟨u⟩ is not examined; that of ⟨u⟩/0 is undefined.
#[test]
fn derivatives_of_positive_parts_are_undecided() {
    let slope = |of: Tree| {
        let claim = derivative("slope", of, &x("u"), 7);
        verdict_at(&claim, &point(&[("u", 1)]))
    };
    assert_eq!(slope(x("u").positive_part()), Verdict::Undecided);
    let undefined = slope(x("u").positive_part() / Tree::from(0));
    assert_eq!(undefined, Verdict::Fails("", Failure::Undefined(Tree::from(0))));
    assert!(matches!(slope(x("u") * x("u")), Verdict::Fails("", Failure::Unequal(..))));
}

/// The bound |u| ≤ c is attained at u = c and u = −c, half of 2 c there.
#[test]
fn the_tightest_point_attains_the_largest_fraction_of_a_bound() {
    let hypotheses = [above_zero("c"), Hypothesis::near(&x("u"), 0, x("c"))];
    let share = |bound: Tree| {
        let claim = within("size", x("u"), bound).assuming(&hypotheses);
        let (point, share) = tightest_point(&claim).unwrap();
        assert_eq!(point.at("u").abs(), point.at("c"));
        share
    };
    assert_eq!(share(x("c")), Exact::one());
    assert_eq!(share(x("c") * Tree::from(2)), "1/2".parse().unwrap());
    // An error that is never positive takes as much of its bound.
    let negative = within("negative", -x("c"), x("c") * Tree::from(2)).assuming(&hypotheses);
    assert_eq!(tightest_point(&negative).unwrap().1, "1/2".parse().unwrap());
    // Half of c is not a bound there.
    let half = within("half", x("u") * Tree::from(2), x("c")).assuming(&hypotheses);
    let at_end = verdict_at(&half, &point(&[("c", 3), ("u", -3)]));
    assert!(matches!(at_end, Verdict::Fails("", Failure::BoundExceeded(..))));
}

/// The last of the members c, 2 c, 4 c and 8 c is half of 16 c. The interval of a computed quantity is not a
/// bound that the claim states.
#[test]
fn the_tightest_member_attains_the_largest_fraction_of_a_bound() {
    let positive = above_zero("c");
    let double = |member: &Tree| member * Tree::from(2);
    let (near, bound) = (Tree::from(0), x("c") * Tree::from(16));
    let doubled =
        perturbed_recursion("doubled", 1).start(x("c")).step(double).near(near, bound).assuming([&positive]);
    let (_, share) = tightest_point(&doubled).unwrap();
    assert_eq!(share, "1/2".parse().unwrap());
    let near = Hypothesis::near(&x("u"), x("c"), x("d"));
    let computed =
        equal("computed", x("u") - x("u"), 0).assuming([&positive, &near]).computing(&x("u"), x("c"));
    assert_eq!(tightest_point(&computed), None);
}

#[test]
fn true_claims_are_not_refuted() {
    let bracket = x("u").positive_part();
    let true_claims: [Statement; 3] = [
        non_negative("square", x("u") * x("u")),
        equal("parts", &bracket - (-x("u")).positive_part(), x("u")),
        positive("tangent", x("u").exp() - x("u") - Tree::from(1)).assuming([&above_zero("u")]),
    ];
    for claim in &true_claims {
        assert_eq!(refute(claim), None, "{}", claim.name());
    }
    assert_eq!((refute(&root()), refute(&vanishes())), (None, None));
}

/// Examples are a zero divisor, and a sign that is wrong at numbers of any size.
#[test]
fn counterexamples_are_simplified() {
    let long: Exact = "123456789012345678901234567890/987654321098765432109876543210987".parse().unwrap();
    let names = ["c", "ε", "R"];
    let start = Point::new(names.map(|name| (name, if name == "c" { -&long } else { long.clone() })));
    let small = |statement: &Statement, point: &Point| {
        Search::of(statement).refute_at(point).expect("a counterexample").counterexample()
    };
    let found_at = |statement: &Statement| small(statement, &start);
    let undefined = found_at(&root().without(&above_zero("c")));
    assert_eq!(undefined.to_string(), "c = -1, ε = 1, R = 1: undefined: c + ε = 0 is a divisor");
    let wrong = found_at(&positive("wrong", x("c") * x("R") * x("R")));
    let is_simple = |x: &Exact| (-3..=3).any(|n| Exact::from(n) == *x);
    assert!(wrong.point.coordinates().all(|(_, x)| is_simple(x)), "{wrong}");
    // At c = 1 the claim is undefined, which explains less than a wrong sign.
    let wrong = positive("wrong", Tree::one() / (x("c") - Tree::one()));
    assert_eq!(small(&wrong, &point(&[("c", -5)])).to_string(), "c = 0: -1 is not > 0");
    // If c becomes 1, d must change as well, because d > c.
    let ordered = Hypothesis::new(Relation::Positive, x("d") - x("c"));
    let zero = equal("zero", x("c") * x("d"), 0).assuming([&ordered]);
    let moved = small(&zero, &point(&[("c", -50), ("d", -49)]));
    assert_eq!((moved.point.at("c"), moved.point.at("d")), (Exact::from(1), Exact::from(2)));
    // No simple number suffices, so the number is halved repeatedly.
    let far = Point::new([("R", "-1234567890123456789012345678901/3".parse().unwrap())]);
    let small = small(&positive("small", Tree::from(1000) - x("R") * x("R")), &far);
    assert!((32..64).any(|n| Exact::from(n) == small.point.at("R").abs()), "{small}");
}

/// Long values have four digits, unless they agree in these.
#[test]
fn long_values_are_shortened_if_they_still_differ() {
    let exact = |text: &str| Value::Exact(text.parse().unwrap());
    let far = Failure::NotConverging(Some(Value::Exact(Exact::power_of_two(200) + Exact::one())));
    assert_eq!(far.to_string(), "its distance from the limit tends to ≈ 1.607e60");
    let (a, b) = ("1234567890123456789012345678901", "1234567890123456789012345678902");
    assert_eq!(Failure::Unequal(exact(a), exact(b)).to_string(), format!("{a} ≠ {b}"));
    assert_eq!(Failure::Unequal(exact(a), exact("1/3")).to_string(), "≈ 1.235e30 ≠ 1/3");
    // Values of up to 24 characters are not shortened.
    let (fits, longer) = ("2".repeat(24), "2".repeat(25));
    assert_eq!(Failure::Unequal(exact(&fits), exact(&longer)).to_string(), format!("{fits} ≠ ≈ 2.222e24"));
    assert_eq!(Failure::Undefined(Tree::from(0)).to_string(), "undefined: 0 is a divisor");
}

#[test]
fn points_are_adjusted_to_a_zero_of_a_divisor() {
    // No integer is a zero: 7 c + 2 is 0 only at −2/7.
    let divisor = Tree::from(7) * x("c") + Tree::from(2);
    let counterexample = refute(&equal("one", &divisor / &divisor, 1)).unwrap();
    assert!(matches!(counterexample.failure, Failure::Undefined(_)), "{counterexample}");
    assert_eq!(counterexample.point.at("c"), "-2/7".parse().unwrap());
}

/// Values of dependent symbols would appear to be free choices.
#[test]
fn counterexamples_contain_independent_symbols_only() {
    let names = |claim: &Statement| -> Vec<_> {
        let found = refute(claim).expect("it is wrong");
        found.point.coordinates().map(|(name, _)| name).collect()
    };
    let [c, q, u] = ["c", "q", "u"].map(x);
    let wrong = induction("wrong", &c, [x("a")], |[x]| [&x * &c + Tree::from(1)], [x("a") * &q]);
    assert_eq!(names(&wrong), ["a", "c"]);
    let near = Hypothesis::near(&u, x("x₁"), 7);
    let step = |_: &Tree| x("u") + Tree::from(9);
    let drifts = perturbed_recursion("wrong", &c)
        .start(x("a"))
        .step(step)
        .bounding(Tree::clone, x("a"))
        .near(x("a"), 1)
        .assuming([&near])
        .computing(&u, x("x₁"));
    assert_eq!(names(&drifts), ["a"]);
    let far = limit("wrong", &u / &c, &u, 0, Rate::Equal(&u / &c)).assuming([&above_zero("u")]);
    assert_eq!(names(&far), ["c"]);
    // Where it must be large, it is displayed: without it the hypotheses would seem to be violated.
    let beyond = |least: i32| Hypothesis::new(Relation::Positive, &u - Tree::from(least));
    let far = limit("wrong", &u / &c, &u, 0, Rate::Equal(&u / &c)).assuming([&beyond(9)]);
    assert_eq!(names(&far), ["u", "c"]);
}

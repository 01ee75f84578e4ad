//! What is refuted and what is not.

use super::smaller::SIMPLE;
use super::*;
use crate::formula::claim::{
    derivative, drift, equal, induction, limit, non_negative, positive, vanishing, within,
};
use crate::formula::{Rate, Statement};
use crate::number::{Exponential, PositivePart};

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn above_zero(name: &'static str) -> Hypothesis {
    Hypothesis::new(Relation::Positive, x(name))
}

fn point(numbers: &[(&'static str, i32)]) -> Point {
    Point::new(numbers.iter().map(|(name, n)| (*name, Exact::from(*n))))
}

/// c u + ε u − R = 0 at u = R/(c + ε)
fn root() -> Statement {
    let u = x("R") / (x("c") + x("ε"));
    let residual = x("c") * &u + x("ε") * &u - x("R");
    equal("root", residual, 0).assuming([&above_zero("c"), &above_zero("ε")])
}

/// R/(c + ε) → 0
fn vanishes() -> Statement {
    let [stiff, penalty] = ["c", "ε"].map(above_zero);
    let p = x("R") / (x("c") + x("ε"));
    limit("vanishes", &p, &x("ε"), 0, Rate::Exactly(p.clone())).assuming([&stiff, &penalty])
}

#[test]
fn a_divisor_that_is_zero_is_named() {
    let root = root();
    let opposite = point(&[("c", -1), ("ε", 1)]);
    assert_eq!(check(&root, &opposite), Verdict::Excluded);
    assert_eq!(check(&root, &point(&[("c", 3)])), Verdict::Holds);
    let Verdict::Fails(_, how) = check(&root.without(&above_zero("c")), &opposite) else { panic!() };
    assert_eq!(how.to_string(), "undefined: c + ε = 0 is a divisor");
}

#[test]
fn a_limit_is_looked_at_far_out() {
    let limit = vanishes();
    let point = point(&[("R", 2)]);
    assert_eq!(check(&limit, &point), Verdict::Holds);
    let Proposition::Limit(of, by, to) = &limit.goals()[0].proposition else { panic!() };
    let wrong = limit.with_proposition(Proposition::Limit(of.clone(), by, to + Tree::from(1)));
    assert!(matches!(check(&wrong, &point), Verdict::Fails("", How::Far(_))));
    let three = || Tree::from(3);
    let shifted = limit.with_proposition(Proposition::Limit(of + three(), by, to + three()));
    assert_eq!(check(&shifted, &point), Verdict::Holds);
}

/// x ← x² stays 1 from 1, and is no other sequence of powers.
#[test]
fn an_induction_is_about_the_powers_of_its_ratio() {
    let squares = |ratio: i32| {
        let claim = induction("squares", ratio, [Tree::from(1)], |[x]| [&x * &x], [x("q")]);
        check(&claim, &Point::default())
    };
    assert_eq!(squares(1), Verdict::Holds);
    assert!(matches!(squares(2), Verdict::Fails("step", How::Different(..))));
}

/// Powers of 2 do not vanish, but what does not depend on them is its limit all along.
#[test]
fn what_is_constant_has_a_limit() {
    let tends = |of: Tree, to: Tree| check(&vanishing("tends", 2, of, to), &point(&[("c", 3)]));
    assert_eq!(tends(x("c"), x("c")), Verdict::Holds);
    assert!(matches!(tends(x("c") * x("q"), Tree::from(0)), Verdict::Fails("|ρ| < 1", How::Sign(..))));
}

/// ⟨u⟩ has a slope or has none, which is not looked at; that of ⟨u⟩/0 is undefined.
#[test]
fn kinks_are_left_open() {
    let slope = |of: Tree| {
        let claim = derivative("slope", of, &x("u"), 7);
        check(&claim, &point(&[("u", 1)]))
    };
    assert_eq!(slope(x("u").positive_part()), Verdict::Open);
    let undefined = slope(x("u").positive_part() / Tree::from(0));
    assert_eq!(undefined, Verdict::Fails("", How::Undefined(Tree::from(0))));
    assert!(matches!(slope(x("u") * x("u")), Verdict::Fails("", How::Different(..))));
}

/// |u| ≤ c is used up where u is c or −c, and half of 2 c there.
#[test]
fn the_sharpest_point_uses_up_most() {
    let given = [above_zero("c"), Hypothesis::near(&x("u"), 0, x("c"))];
    let share = |bound: Tree| {
        let claim = within("size", x("u"), bound).assuming([&given[0], &given[1]]);
        let (point, share) = sharpest(&claim).unwrap();
        assert_eq!(point.at("u").abs(), point.at("c"));
        share
    };
    assert_eq!(share(x("c")), Exact::one());
    assert_eq!(share(x("c") * Tree::from(2)), "1/2".parse().unwrap());
    // Half of c is not enough there.
    let half = within("half", x("u") * Tree::from(2), x("c")).assuming([&given[0], &given[1]]);
    let at_end = check(&half, &point(&[("c", 3), ("u", -3)]));
    assert!(matches!(at_end, Verdict::Fails("", How::Beyond(..))));
}

/// Of the members c, 2 c, 4 c and 8 c the last is half of 16 c. That a number is computed nearly is no bound
/// of a claim's own.
#[test]
fn the_sharpest_member_uses_up_most() {
    let given = above_zero("c");
    let double = |member: &Tree| member * Tree::from(2);
    let (near, bound) = (Tree::from(0), x("c") * Tree::from(16));
    let doubled = drift("doubled", 1, x("c"), double, (near, bound), |_| []).assuming([&given]);
    let (_, share) = sharpest(&doubled).unwrap();
    assert_eq!(share, "1/2".parse().unwrap());
    let near = Hypothesis::near(&x("u"), x("c"), x("d"));
    let computed = equal("computed", x("u") - x("u"), 0).assuming([&given, &near]).computing(&x("u"), x("c"));
    assert_eq!(sharpest(&computed), None);
}

#[test]
fn what_is_true_is_not_refuted() {
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

/// Where c + ε = 0, and where a sign is wrong however large the numbers are.
#[test]
fn a_counterexample_is_made_small() {
    let long: Exact = "123456789012345678901234567890/987654321098765432109876543210987".parse().unwrap();
    let names = ["c", "ε", "R"];
    let start = Point::new(names.map(|name| (name, if name == "c" { -&long } else { long.clone() })));
    let small = |statement: &Statement, point: &Point| {
        found(statement, point).expect("a counterexample").counterexample()
    };
    let found_at = |statement: &Statement| small(statement, &start);
    let undefined = found_at(&root().without(&above_zero("c")));
    assert_eq!(undefined.to_string(), "c = -1, ε = 1, R = 1: undefined: c + ε = 0 is a divisor");
    let wrong = found_at(&positive("wrong", x("c") * x("R") * x("R")));
    let simple = |x: &Exact| SIMPLE.iter().any(|n| Exact::from(*n) == *x);
    assert!(wrong.point.numbers().all(|(_, x)| simple(x)), "{wrong}");
    // For c = 1 another number has to follow, for d > c.
    let given = Hypothesis::new(Relation::Positive, x("d") - x("c"));
    let zero = equal("zero", x("c") * x("d"), 0).assuming([&given]);
    let apart = small(&zero, &point(&[("c", -50), ("d", -49)]));
    assert_eq!((apart.point.at("c"), apart.point.at("d")), (Exact::from(1), Exact::from(2)));
    // Nothing simple is as large, but half is.
    let far = Point::new([("R", "-1234567890123456789012345678901/3".parse().unwrap())]);
    let small = small(&positive("small", Tree::from(1000) - x("R") * x("R")), &far);
    assert!((32..64).any(|n| Exact::from(n) == small.point.at("R").abs()), "{small}");
}

/// As text: what happens far out is said in a few digits, and what differs late in all.
#[test]
fn long_values_are_shortened_as_far_as_they_differ() {
    let exact = |text: &str| Value::Exact(text.parse().unwrap());
    let far = How::Far(Value::Exact(Exact::power_of_two(200) + Exact::one()));
    assert_eq!(far.to_string(), "far out it is still ≈ 1.607e60 off its limit");
    let (a, b) = ("1234567890123456789012345678901", "1234567890123456789012345678902");
    assert_eq!(How::Different(exact(a), exact(b)).to_string(), format!("{a} ≠ {b}"));
    assert_eq!(How::Different(exact(a), exact("1/3")).to_string(), "≈ 1.235e30 ≠ 1/3");
    // What has room is not shortened.
    let (fits, longer) = ("2".repeat(24), "2".repeat(25));
    assert_eq!(How::Different(exact(&fits), exact(&longer)).to_string(), format!("{fits} ≠ ≈ 2.222e24"));
    assert_eq!(How::Undefined(Tree::from(0)).to_string(), "undefined: 0 is a divisor");
}

#[test]
fn a_divisor_is_bent_to_zero() {
    // No integers do that here: 7 c + 2 is 0 at −2/7 alone.
    let divisor = Tree::from(7) * x("c") + Tree::from(2);
    let counterexample = refute(&equal("one", &divisor / &divisor, 1)).unwrap();
    assert!(matches!(counterexample.how, How::Undefined(_)), "{counterexample}");
    assert_eq!(counterexample.point.at("c"), "-2/7".parse().unwrap());
}

/// Numbers for what follows from others would be read as if it were a choice.
#[test]
fn a_counterexample_has_no_number_for_what_follows() {
    let names = |claim: &Statement| -> Vec<_> {
        let found = refute(claim).expect("it is wrong");
        found.point.numbers().map(|(name, _)| name).collect()
    };
    let [c, q, u] = ["c", "q", "u"].map(x);
    let wrong = induction("wrong", &c, [x("a")], |[x]| [&x * &c + Tree::from(1)], [x("a") * &q]);
    assert_eq!(names(&wrong), ["a", "c"]);
    let near = Hypothesis::near(&u, x("x₁"), 7);
    let step = |_: &Tree| x("u") + Tree::from(9);
    let drifts = drift("wrong", &c, x("a"), step, (x("a"), Tree::from(1)), |_| [(x("x₁"), x("a"))])
        .assuming([&near])
        .computing(&u, x("x₁"));
    assert_eq!(names(&drifts), ["a"]);
    let far = limit("wrong", &u / &c, &u, 0, Rate::Exactly(&u / &c)).assuming([&above_zero("u")]);
    assert_eq!(names(&far), ["c"]);
}

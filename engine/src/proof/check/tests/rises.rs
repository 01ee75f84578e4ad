//! Functions that rise from 0 on.

use super::*;
use crate::formula::claim::PRECISION;

/// In all problems here the symbol is the first atom, and its exponential the second one.
const SYMBOL: usize = 0;

fn power() -> Polynomial {
    Polynomial::variable(1).unwrap()
}

fn minus(of: Polynomial, other: &Polynomial) -> Polynomial {
    of.plus_multiple(-1, other, &Effort::default()).unwrap()
}

fn one() -> Polynomial {
    Polynomial::constant(1)
}

fn form(right: Polynomial) -> Reason {
    Reason::Certificate(Certificate { known: vec![], left: one(), right })
}

fn trivial() -> Node {
    node(leaf(&[], vec![form(Polynomial::zero())]))
}

/// Returns a function that is 0 at 0, with a proof that its slope is positive.
fn rise(of: Polynomial, slope: Node) -> Rise {
    let (start, parts) = (Relation::Zero, [trivial(), trivial(), slope]);
    Rise { of, x: SYMBOL, start, slope: Relation::Positive, parts }
}

/// Returns eᵃ − 1 > 0, by the slope eᵃ.
fn above_one() -> Rise {
    rise(minus(power(), &one()), node(leaf(&[], vec![form(power())])))
}

/// Returns eᵃ − 1 − a > 0, by the slope eᵃ − 1.
fn above_tangent() -> Rise {
    let tangent = minus(minus(power(), &one()), &Polynomial::variable(SYMBOL).unwrap());
    rise(tangent, by(above_one()))
}

/// Returns a proof by the sign of a function, the next fact after that of the first hypothesis.
fn by(rise: Rise) -> Node {
    node(Leaf { rises: vec![rise], ..leaf(&[0], vec![Reason::Fact(2)]) })
}

fn tangent() -> Statement {
    let a = x("a");
    positive("f", a.exp() - n(1) - &a).assuming(&[above_zero(&a)])
}

#[test]
fn an_exponential_is_above_its_tangent() {
    accept(&tangent(), &[by(above_tangent())]);
    let a = x("a");
    let weak = non_negative("f", a.exp() - n(1) - &a).assuming(&[not_below_zero(&a)]);
    accept(&weak, &[by(above_tangent())]);
}

fn parts() -> Vec<Forged> {
    let [right, a] = [above_tangent(), Rise { x: 1, ..above_tangent() }];
    let of = |rise: Rise, refusal, flaw| (flaw, tangent(), vec![by(rise)], refusal);
    let start = |relation| Rise { start: relation, ..right.clone() };
    let shifted = Rise { of: minus(right.of.clone(), &one()), ..right.clone() };
    let falling =
        rise(minus(one(), &power()), node(leaf(&[], vec![form(minus(Polynomial::zero(), &power()))])));
    let large = Polynomial::constant(1 << 40).times(&right.of, &Effort::default()).unwrap();
    let place = |i: usize, part: Node| {
        let mut other = right.clone();
        other.parts[i] = part;
        other
    };
    let nothing = || node(Leaf::default());
    // eᵃ > 0 by its slope eᵃ, and so on.
    let growing = |inner: Node| Rise {
        start: Relation::Positive,
        parts: [trivial(), node(leaf(&[], vec![form(one())])), inner],
        ..rise(power(), nothing())
    };
    let deep = (0..=MAX_NESTING).fold(by(above_one()), |inner, _| by(growing(inner)));
    vec![
        of(a, Refusal::Rise, "a slope in an exponential"),
        of(Rise { x: 99, ..right.clone() }, Refusal::Rise, "a slope in nothing"),
        of(shifted, Refusal::Identity, "a negative start"),
        of(start(Relation::Positive), Refusal::Goal, "a start that is 0"),
        of(falling, Refusal::Goal, "a negative slope"),
        of(Rise { slope: Relation::Zero, ..right.clone() }, Refusal::Goal, "a slope that is not 0"),
        of(Rise { of: large, ..right.clone() }, Refusal::TooLarge, "numbers beyond those of formulas"),
        of(place(0, nothing()), Refusal::Missing, "no proof that it is differentiable"),
        of(place(1, nothing()), Refusal::Missing, "no proof of its start"),
        of(place(2, nothing()), Refusal::Missing, "no proof of its slope"),
        ("parts inside each other", tangent(), vec![deep], Refusal::TooLarge),
    ]
}

fn symbols() -> Vec<Forged> {
    let [a, u, scale, precision] = ["a", "u", "2ᵃ", PRECISION].map(x);
    let of = |of: &Tree, given: &[Hypothesis]| positive("f", of.exp() - n(1) - of).assuming(given);
    let without = |rise: Rise| node(Leaf { rises: vec![rise], ..leaf(&[], vec![Reason::Fact(1)]) });
    let free = of(&u, &[]);
    let negative = of(&u, &[above_zero(-&u)]);
    // Of a > 1 nothing is known between 0 and a.
    let above = positive("f", a.exp() - n(1) - &a).assuming(&[above_zero(&a), above_zero(&a - n(1))]);
    let mut by_hypothesis = above_tangent();
    by_hypothesis.parts[2] = node(leaf(&[1], vec![Reason::Fact(1)]));
    let inverse = positive("f", (n(-1) / &a).exp()).assuming(&[above_zero(&a)]);
    let page = Page::of(&inverse);
    let singular = Rise { of: page.poly(n(2) * x("E₁") - n(1)), x: page.variable("a"), ..above_one() };
    let divisor = Leaf { divisors: vec![vec![page.poly(&a)]], ..leaf(&[0], vec![Reason::Fact(1)]) };
    let singular = Rise { parts: [node(divisor), trivial(), trivial()], ..singular };
    let unit = non_negative("f", &u + n(1) + &a).assuming(&[above_zero(&a), Hypothesis::between(&u, -1, 1)]);
    let of_unit = Page::of(&unit);
    let of_place = Rise { of: of_unit.poly(x("t₁")), x: of_unit.variable("a"), ..above_one() };
    vec![
        ("a symbol that may be negative", free, vec![without(above_tangent())], Refusal::Rise),
        ("a negative symbol", negative, vec![by(above_tangent())], Refusal::Rise),
        ("a power of two", of(&scale, &[]), vec![without(above_tangent())], Refusal::Rise),
        (
            "the precision",
            of(&precision, &[above_zero(&precision)]),
            vec![by(above_tangent())],
            Refusal::Rise,
        ),
        ("a hypothesis on the symbol", above, vec![by(by_hypothesis)], Refusal::Unknown),
        ("a function that is undefined at 0", inverse, vec![by(singular)], Refusal::NotStrict),
        ("a function of a place", unit, vec![by(of_place)], Refusal::Rise),
    ]
}

/// eᵘ − 1 − u is positive for u < 0, too, although its slope is positive for u > 0.
fn negative_symbols() -> Vec<Forged> {
    let u = x("u");
    let claim = non_negative("f", n(1) + &u - u.exp()).assuming(&[not_below_zero(-&u)]);
    let page = Page::of(&claim);
    // u > 0 and −u ≥ 0 exclude each other.
    let none = page.with(vec![Known::Fact(1), Known::Fact(2)], x("z₁") + x("z₂"), 0);
    let below = page.with(vec![Known::Fact(2)], 1, -x("z₁"));
    let below = Leaf { rises: vec![above_tangent()], ..leaf(&[], vec![below]) };
    let nodes = vec![cases(page.poly(&u), node(leaf(&[0], vec![none])), node(below))];
    vec![("a rise to the left", claim.clone(), nodes, Refusal::Rise)]
}

#[test]
fn forged_rises_are_refused() {
    refuse(parts());
    refuse(negative_symbols());
    refuse(symbols());
}

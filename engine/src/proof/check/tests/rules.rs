//! Roundings, laws of functions, absolute values and goals.

use super::*;
use crate::formula::claim::PRECISION;

/// Returns the step for 2ᵖ + 1 > 0. The facts are 2 > 0 and, for the minimum precision, 2ᵖ − 4 ≥ 0.
fn largest(page: &Page) -> Step {
    page.show(x(PRECISION) + n(1), &[1], 1, x("z₁") + n(5))
}

/// Returns the number of errors of the rounded formulas in two formulas.
fn count_errors(a: &Tree, b: &Tree) -> usize {
    let claim = equal("f", a, b);
    let page = Page::of(&claim);
    page.0.table.atoms.iter().filter(|atom| matches!(atom, Atom::Error(_))).count()
}

/// Formulas that differ by a power of two have the same error, and no others.
#[test]
fn errors_are_shared_by_powers_of_two_alone() {
    let [a, b, u, scale, other] = ["a", "b", "u", "2ᵃ", "2ᵇ"].map(x);
    for scale in [scale.clone(), &scale * &other, &scale / &other, n(1) / &scale * &other] {
        let inner = |s: &Tree| ((s * &a * &u).round() - s * (&a / &b).positive_part()).min(&(s * &b));
        for (scaled, unscaled, count) in [
            (&scale * &u, u.clone(), 1),
            (&u * &scale, u.clone(), 1),
            (&u / &scale, u.clone(), 1),
            (-(&scale * &u) - &a * &scale, -&u - &a, 1),
            (&scale * inner(&n(1)).round(), inner(&n(1)).round(), 3),
            (inner(&scale), inner(&n(1)), 2),
        ] {
            assert_eq!(count_errors(&scaled.round(), &unscaled.round()), count, "{scaled} and {unscaled}");
        }
    }
    for (one, other) in [
        (n(3) * &u, u.clone()),
        (&b * &u, u.clone()),
        ((&scale + &other) * &u, u.clone()),
        (&scale * &u + &a, &u + &a),
        ((&scale * &u).exp(), u.exp()),
        (a.clone(), b.clone()),
    ] {
        assert_eq!(count_errors(&one.round(), &other.round()), 2, "{one} and {other}");
    }
    let proof = |claim: &Statement| vec![leaf(1, vec![largest(&Page::of(claim))])];
    let scaled = equal("f", (&scale * &u).round(), &scale * u.round());
    accept(&scaled, &proof(&scaled));
    let upside_down = equal("f", &scale * (&scale * &u).round(), u.round());
    let squared = equal("f", (&scale * &scale * &u).round(), &scale * u.round());
    refuse(vec![
        ("a power of two upside down", upside_down.clone(), proof(&upside_down), Refusal::Goal),
        ("another power of two", squared.clone(), proof(&squared), Refusal::Goal),
    ]);
}

/// A rounded symbol is not the symbol, and 2ᵖ + 1 is not 0 by hypothesis.
fn errors() -> Vec<Forged> {
    let u = x("u");
    let exact = equal("f", u.round(), &u);
    let page = Page::of(&exact);
    let of = |steps: Vec<Step>| [vec![Step::Assume(0), largest(&page)], steps].concat();
    vec![
        forged("an error left out", &exact, of(vec![]), Refusal::Goal),
        forged("an error that is not 0", &exact, of(vec![page.form(&u * x("e₁"))]), Refusal::Form),
        forged("the precision is not known", &exact, vec![], Refusal::Divisor),
        forged("a precision without a sign", &exact, vec![page.form(x(PRECISION) + n(1))], Refusal::Form),
    ]
}

fn orders() -> Vec<Forged> {
    let [a, b, c] = ["a", "b", "c"].map(x);
    let rounded = non_negative("f", a.round() - b.round()).assuming(&[not_below_zero(&a - &b)]);
    let strict = positive("f", a.round() - b.round()).assuming(&[above_zero(&a - &b)]);
    let negative = non_negative("f", (&a * &c).round() - (&b * &c).round());
    let negative = negative.assuming(&[not_below_zero(&a - &b), above_zero(-&c)]);
    let by = |claim: &Statement, of: [&Tree; 2], given: usize, more: Vec<Step>| {
        let page = Page::of(claim);
        let law = Step::Law(Law::Order(of.map(|of| page.formula(of))));
        [assume(given), vec![largest(&page)], more, vec![law]].concat()
    };
    let [f, g] = [a.round(), b.round()];
    accept(&rounded, &[leaf(0, by(&rounded, [&f, &g], 2, vec![]))]);
    let product = Page::of(&negative).show(&a * &c - &b * &c, &[2, 3], 1, -(x("z₁") * x("z₂")));
    let products = [(&a * &c).round(), (&b * &c).round()];
    let row = |flaw, steps, refusal| forged(flaw, &rounded, steps, refusal);
    vec![
        row("an order without a reason", by(&rounded, [&f, &g], 1, vec![]), Refusal::Law),
        row("an order the other way", by(&rounded, [&g, &f], 2, vec![]), Refusal::Law),
        row("an order of symbols", by(&rounded, [&a, &b], 2, vec![]), Refusal::Unknown),
        row("another order", by(&rounded, [&f, &f], 2, vec![]), Refusal::Goal),
        forged("a strict order", &strict, by(&strict, [&f, &g], 2, vec![]), Refusal::Goal),
        forged(
            "an order by a negative factor",
            &negative,
            by(&negative, [&products[0], &products[1]], 3, vec![product]),
            Refusal::Law,
        ),
    ]
}

fn exponentials() -> Vec<Forged> {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let of = |claim: &Statement, left: &[&'static str], right: &[&'static str]| {
        let page = Page::of(claim);
        let [left, right] = [left, right].map(|names| names.iter().map(|name| page.variable(name)).collect());
        vec![Step::Law(Law::Exponents { left, right })]
    };
    let product = equal("f", a.exp() * b.exp(), (&a + &b).exp());
    accept(&product, &[leaf(0, of(&product, &["E₁", "E₂"], &["E₃"]))]);
    let reciprocal = equal("f", a.exp() * (-&a).exp(), 1);
    accept(&reciprocal, &[leaf(0, of(&reciprocal, &["E₁", "E₂"], &[]))]);
    let other = equal("f", a.exp() * b.exp(), (&a + n(2) * &b).exp());
    let undefined = equal("f", (n(1) / &a).exp(), 1);
    let above_one = positive("f", u.exp() - n(1));
    let of_one = vec![Page::of(&above_one).form(x("E₁") - n(1))];
    let law = Refusal::Law;
    vec![
        forged("exponents of another sum", &other, of(&other, &["E₁", "E₂"], &["E₃"]), law),
        forged("exponents whose sum is not 0", &reciprocal, of(&reciprocal, &["E₁"], &[]), law),
        forged("the exponent of a symbol", &product, of(&product, &["a", "E₂"], &["E₃"]), Refusal::Unknown),
        forged("an undefined exponent", &undefined, of(&undefined, &["E₁"], &[]), Refusal::Divisor),
        forged("an undefined exponential", &undefined, vec![], Refusal::Divisor),
        forged("an exponential above 1", &above_one, of_one, Refusal::Form),
    ]
}

/// eᵘ > 1 + u for u ≠ 0, and (2 − u) eᵘ < 2 + u for u > 0.
fn laws_of_exponentials() -> Vec<Forged> {
    let u = x("u");
    let tangent = || u.exp() - (n(1) + &u);
    let pole = || n(2) + &u - (n(2) - &u) * u.exp();
    let of = |claim: &Statement, law: fn(usize) -> Law| {
        let page = Page::of(claim);
        let steps = vec![Step::Law(law(page.variable("E₁")))];
        [assume(claim.hypotheses().len()), steps].concat()
    };
    let given = |claim: Statement, hypothesis: Hypothesis| claim.assuming(&[hypothesis]);
    let right = given(positive("f", tangent()), above_zero(&u));
    accept(&right, &[leaf(0, of(&right, Law::AboveTangent))]);
    let left = given(positive("f", tangent()), above_zero(-&u));
    let negative = Page::of(&left).show(&u, &[1], 1, -x("z₁"));
    accept(&left, &[leaf(1, [vec![negative], of(&left, Law::AboveTangent).split_off(1)].concat())]);
    let weak = non_negative("f", tangent());
    accept(&weak, &[leaf(0, of(&weak, Law::AboveTangent))]);
    let claim = given(positive("f", pole()), above_zero(&u));
    accept(&claim, &[leaf(0, of(&claim, Law::BelowPole))]);
    let claim = given(non_negative("f", pole()), not_below_zero(&u));
    accept(&claim, &[leaf(0, of(&claim, Law::BelowPole))]);
    let row = |flaw, claim: Statement, law: fn(usize) -> Law, refusal| {
        forged(flaw, &claim, of(&claim, law), refusal)
    };
    let (strict, strict_pole) = (|| positive("f", tangent()), || positive("f", pole()));
    vec![
        row("a tangent that touches", given(strict(), not_below_zero(&u)), Law::AboveTangent, Refusal::Goal),
        row("a fraction without a sign", strict_pole(), Law::BelowPole, Refusal::Law),
        row("a fraction to the left", given(strict_pole(), above_zero(-&u)), Law::BelowPole, Refusal::Law),
        row(
            "a fraction that touches",
            given(strict_pole(), not_below_zero(&u)),
            Law::BelowPole,
            Refusal::Goal,
        ),
        forged("a tangent of nothing", &strict(), vec![Step::Law(Law::AboveTangent(0))], Refusal::Unknown),
        forged("a fraction of nothing", &strict(), vec![Step::Law(Law::BelowPole(99))], Refusal::Unknown),
    ]
}

fn absolute_values() -> Vec<Forged> {
    let [u, v] = ["u", "v"].map(x);
    let product = || x("S₁") * x("F₁");
    let of = |claim: &Statement, law: fn(usize) -> Law, of: &Tree, more: Vec<Step>| {
        let named = Step::Law(law(Page::of(claim).formula(of)));
        [assume(claim.hypotheses().len()), vec![named], more].concat()
    };
    let at_most = non_negative("f", u.abs() - &u);
    let page = Page::of(&at_most);
    let margin = |page: &Page| page.show(x("S₁") - &u, &[1], 1, x("S₁") - product() - x("z₁"));
    accept(&at_most, &[leaf(0, of(&at_most, Law::AbsoluteValue, &u, vec![margin(&page)]))]);
    let others = equal("f", u.abs(), v.abs());
    let (strict, is_own) = (positive("f", u.abs()), equal("f", u.abs(), &u));
    let own = is_own.clone().assuming(&[not_below_zero(&u)]);
    accept(&own, &[leaf(0, of(&own, Law::Signed, &u, vec![]))]);
    let negated = equal("f", u.abs(), -&u).assuming(&[not_below_zero(-&u)]);
    let sign = Page::of(&negated).show(&u, &[1], 1, -x("z₁"));
    let law = Step::Law(Law::Signed(Page::of(&negated).formula(&u)));
    accept(&negated, &[leaf(1, vec![sign, law])]);
    let signed = non_negative("f", u.abs() * &u);
    let by_factor = Page::of(&signed).show(x("S₁") * &u, &[1], 1, x("S₁") * product() + x("S₁") * x("z₁"));
    let row =
        |flaw, claim: &Statement, law, more, refusal| forged(flaw, claim, of(claim, law, &u, more), refusal);
    let of_own = margin(&Page::of(&is_own));
    vec![
        forged("an absolute value left out", &at_most, vec![margin(&page)], Refusal::Unknown),
        row("a side without a sign", &is_own, Law::Signed, vec![], Refusal::Law),
        forged("two absolute values", &others, vec![], Refusal::Goal),
        forged("an absolute value of 0", &strict, vec![Page::of(&strict).form(x("S₁"))], Refusal::Goal),
        row("an absolute value without its factor", &is_own, Law::AbsoluteValue, vec![of_own], Refusal::Goal),
        row("the sign of a factor", &signed, Law::AbsoluteValue, vec![by_factor], Refusal::Form),
        forged("the size of nothing", &at_most, vec![Step::Law(Law::AbsoluteValue(99))], Refusal::Unknown),
    ]
}

fn goals() -> Vec<Forged> {
    let [a, b, c, l, u] = ["a", "b", "c", "λ", "u"].map(x);
    let negative = within("f", 0, -&c).assuming(&[not_below_zero(&c)]);
    let wide = within("f", &c, n(2) * &c).assuming(&[not_below_zero(&c)]);
    let weak = equal("f", &l, 0).assuming(&[not_below_zero(&l)]);
    let slope = derivative("f", &u * &u, &u, &u);
    let kink = derivative("f", u.min(&a), &u, 1);
    let smaller = equal("f", a.min(&b), &b).assuming(&[above_zero(&b - &a)]);
    let of = |claim: &Statement, all: &[Tree]| {
        let page = Page::of(claim);
        [assume(claim.hypotheses().len()), all.iter().map(|of| page.form(of)).collect()].concat()
    };
    accept(&wide, &[leaf(0, of(&wide, &[c.clone(), n(3) * &c]))]);
    let row = |flaw, claim: &Statement, all: &[Tree]| forged(flaw, claim, of(claim, all), Refusal::Goal);
    vec![
        row("a negative bound", &negative, &[-&c]),
        row("one side of a bound", &wide, std::slice::from_ref(&c)),
        row("a number that is not negative for 0", &weak, &[]),
        row("another slope", &slope, &[]),
        forged("a slope at a kink", &kink, vec![], Refusal::NotDifferentiable),
        row("the larger one", &smaller, &[]),
    ]
}

#[test]
fn forged_roundings_are_refused() {
    refuse(errors());
    refuse(orders());
}

#[test]
fn forged_absolute_values_are_refused() {
    refuse(absolute_values());
}

#[test]
fn forged_exponentials_and_goals_are_refused() {
    refuse(exponentials());
    refuse(laws_of_exponentials());
    refuse(goals());
}

//! Roundings, orders, exponentials and goals.

use super::*;

/// The facts are 2 > 0 and, for the minimum precision, 2ᵖ − 4 ≥ 0.
fn largest(page: &Page) -> Reason {
    page.with(vec![Known::Fact(1)], 1, x("z₁") + n(5))
}

/// Returns a proof that an equation of two rounded formulas is an identity if the second has this error.
fn equation(claim: &Statement, same: Option<[Polynomial; 2]>) -> Vec<Node> {
    let page = Page::of(claim);
    let same = same.map(|[up, down]| Same { rounding: 0, up, down });
    let used: Vec<_> = (0..claim.hypotheses().len()).collect();
    let roundings = vec![None, same];
    let fact = Reason::Fact(1 + used.len());
    vec![node(Leaf { roundings, ..leaf(&used, vec![largest(&page), fact, page.form(0)]) })]
}

fn shared_errors() -> Vec<Forged> {
    let [a, b, u, scale, other] = ["a", "b", "u", "2ᵃ", "2ᵇ"].map(x);
    let one = || Polynomial::constant(1);
    let of = |factor: &Tree| equal("f", (factor * &u).round(), factor * u.round());
    let scaled = of(&scale);
    let power = Page::of(&scaled).poly(&scale);
    accept(&scaled, &equation(&scaled, Some([one(), power.clone()])));
    let row = |flaw, claim: &Statement, up: Polynomial, down: Polynomial, refusal| {
        (flaw, claim.clone(), equation(claim, Some([up, down])), refusal)
    };
    let (three, symbol, sum) = (of(&n(3)), of(&b), of(&(&scale + &other)));
    let two = equal("f", a.round(), b.round());
    let without = equation(&scaled, None);
    let (mut late, mut fewer) = (equation(&scaled, Some([one(), power.clone()])), without.clone());
    for (nodes, is_late) in [(&mut late, true), (&mut fewer, false)] {
        let Node::Leaf(leaf) = &mut nodes[0] else { continue };
        match &mut leaf.roundings[1] {
            Some(same) if is_late => same.rounding = 1,
            _ => leaf.roundings.truncate(1),
        }
    }
    let rounding = Refusal::Rounding;
    vec![
        row("a factor that is no power of two", &three, one(), Polynomial::constant(3), rounding),
        row("a symbol that is no power of two", &symbol, one(), Page::of(&symbol).poly(&b), rounding),
        row("a sum of powers of two", &sum, one(), Page::of(&sum).poly(&scale + &other), rounding),
        row("two formulas that are not the same", &two, one(), one(), rounding),
        row("a power of two upside down", &scaled, power.clone(), one(), rounding),
        row("a power of two left out", &scaled, one(), one(), rounding),
        row("no power", &scaled, Polynomial::zero(), Polynomial::zero(), rounding),
        ("errors that are not shared", scaled.clone(), without, Refusal::Identity),
        ("a rounding that is not earlier", scaled.clone(), late, Refusal::Unknown),
        ("a rounding left out", scaled, fewer, Refusal::Missing),
    ]
}

/// A rounded symbol is not the symbol.
fn errors() -> Vec<Forged> {
    let u = x("u");
    let exact = equal("f", u.round(), &u);
    let page = Page::of(&exact);
    let of = |sign| vec![node(Leaf { roundings: vec![None], ..leaf(&[0], vec![largest(&page), sign]) })];
    vec![
        ("an error left out", exact.clone(), of(page.form(0)), Refusal::Identity),
        ("an error that is not 0", exact.clone(), of(page.form(&u * x("e₁"))), Refusal::Form),
    ]
}

/// Returns a proof by an order of rounded formulas, whose exact order has this reason.
fn order(claim: &Statement, errors: [usize; 2], used: &[usize], reason: Reason) -> Vec<Node> {
    let page = Page::of(claim);
    let (orders, roundings) = (vec![errors], vec![None, None]);
    // The reason is no fact of its own if it is one of the hypotheses.
    let first = 1 + used.len() + usize::from(!matches!(reason, Reason::Fact(_)));
    let signs = vec![reason, largest(&page), Reason::Fact(first), Reason::Fact(first + 1)];
    vec![node(Leaf { orders, roundings, ..leaf(used, signs) })]
}

fn orders() -> Vec<Forged> {
    let [a, b, c] = ["a", "b", "c"].map(x);
    let rounded = non_negative("f", a.round() - b.round()).assuming(&[not_below_zero(&a - &b)]);
    let page = Page::of(&rounded);
    let [e, f] = ["e₁", "e₂"].map(|name| page.variable(name));
    accept(&rounded, &order(&rounded, [e, f], &[0, 1], Reason::Fact(2)));
    let strict = positive("f", a.round() - b.round()).assuming(&[above_zero(&a - &b)]);
    let negative = non_negative("f", (&a * &c).round() - (&b * &c).round());
    let negative = negative.assuming(&[not_below_zero(&a - &b), above_zero(-&c)]);
    let of_negative = Page::of(&negative);
    let [g, h] = ["e₁", "e₂"].map(|name| of_negative.variable(name));
    let product = of_negative.with(vec![Known::Fact(2), Known::Fact(3)], 1, -(x("z₁") * x("z₂")));
    let opposite = page.with(vec![Known::Fact(2)], 1, -x("z₁"));
    let symbols = ["a", "b"].map(|name| page.variable(name));
    let row = |flaw, nodes, refusal| (flaw, rounded.clone(), nodes, refusal);
    vec![
        row("an order without a reason", order(&rounded, [e, f], &[0], page.form(&a - &b)), Refusal::Form),
        row("an order the other way", order(&rounded, [f, e], &[0, 1], opposite), Refusal::Order),
        row("an order of symbols", order(&rounded, symbols, &[0, 1], Reason::Fact(2)), Refusal::Unknown),
        row("another order", order(&rounded, [e, e], &[0, 1], Reason::Fact(2)), Refusal::Identity),
        ("a strict order", strict.clone(), order(&strict, [e, f], &[0, 1], Reason::Fact(2)), Refusal::Goal),
        (
            "an order by a negative factor",
            negative.clone(),
            order(&negative, [g, h], &[0, 1, 2], product),
            Refusal::Order,
        ),
    ]
}

fn exponentials() -> Vec<Forged> {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let product = equal("f", a.exp() * b.exp(), (&a + &b).exp());
    let of = |claim: &Statement, left: &[&'static str], right: &[&'static str]| {
        let page = Page::of(claim);
        let [left, right] = [left, right].map(|names| names.iter().map(|name| page.variable(name)).collect());
        proof(&[], vec![page.with(vec![Known::Exponents { left, right }], 1, x("z₁"))])
    };
    accept(&product, &of(&product, &["E₁", "E₂"], &["E₃"]));
    let reciprocal = equal("f", a.exp() * (-&a).exp(), 1);
    accept(&reciprocal, &of(&reciprocal, &["E₁", "E₂"], &[]));
    let other = equal("f", a.exp() * b.exp(), (&a + n(2) * &b).exp());
    let unmet = equal("f", a.exp(), 1).assuming(&[zero(u.exp() - n(1))]);
    let above_one = positive("f", u.exp() - n(1));
    let row = |flaw, claim: &Statement, nodes, refusal| (flaw, claim.clone(), nodes, refusal);
    vec![
        row("exponents of another sum", &other, of(&other, &["E₁", "E₂"], &["E₃"]), Refusal::Exponents),
        row("exponents that are no 0", &reciprocal, of(&reciprocal, &["E₁"], &[]), Refusal::Exponents),
        row("the exponent of a symbol", &product, of(&product, &["a", "E₂"], &["E₃"]), Refusal::Unknown),
        row("an exponent that is not met", &unmet, of(&unmet, &["E₁"], &["E₂"]), Refusal::Unknown),
        row(
            "an exponential above 1",
            &above_one,
            proof(&[], vec![Page::of(&above_one).form(x("E₁") - n(1))]),
            Refusal::Form,
        ),
    ]
}

/// Returns a proof with these translations of absolute values.
fn with_sizes(sizes: &[AbsoluteValue], signs: Vec<Reason>) -> Vec<Node> {
    vec![node(Leaf { sizes: sizes.into(), ..leaf(&[], signs) })]
}

fn absolute_values() -> Vec<Forged> {
    use AbsoluteValue::{Atom, BySign, Same};
    let [u, v] = ["u", "v"].map(x);
    let at_most = non_negative("f", u.abs() - &u);
    let page = Page::of(&at_most);
    let product = || x("S₁") * x("F₁");
    let margin = || page.with(vec![Known::Fact(1)], 1, x("S₁") - product() - x("z₁"));
    accept(&at_most, &with_sizes(&[Atom], vec![margin()]));
    let opposite = equal("f", u.abs(), (-&u).abs());
    accept(&opposite, &with_sizes(&[Atom, Same(0)], vec![Page::of(&opposite).form(0)]));
    let others = equal("f", u.abs(), v.abs());
    let (strict, same) = (positive("f", u.abs()), equal("f", u.abs(), &u));
    let signed = non_negative("f", u.abs() * &u);
    let of_signed = Page::of(&signed);
    let by_factor = x("S₁") * product() + x("S₁") * x("z₁");
    let row = |flaw, claim: &Statement, sizes: &[AbsoluteValue], signs, refusal| {
        (flaw, claim.clone(), with_sizes(sizes, signs), refusal)
    };
    let of_others = || Page::of(&others).form(0);
    vec![
        row("an absolute value left out", &at_most, &[], vec![margin()], Refusal::Missing),
        row("one absolute value more", &at_most, &[Atom, Atom], vec![margin()], Refusal::Unused),
        row("a side without a sign", &at_most, &[BySign], vec![page.form(n(2) * &u)], Refusal::Form),
        row("an absolute value before the first", &at_most, &[Same(0)], vec![margin()], Refusal::Unknown),
        row("the absolute value of another", &others, &[Atom, Same(0)], vec![of_others()], Refusal::Size),
        row("two absolute values", &others, &[Atom, Atom], vec![of_others()], Refusal::Identity),
        row("an absolute value of 0", &strict, &[Atom], vec![Page::of(&strict).form(x("S₁"))], Refusal::Goal),
        row("an absolute value without its factor", &same, &[Atom], vec![margin()], Refusal::Goal),
        row(
            "the sign of a factor",
            &signed,
            &[Atom],
            vec![of_signed.with(vec![Known::Fact(1)], 1, by_factor)],
            Refusal::Form,
        ),
        row(
            "a factor that is 1",
            &same,
            &[Atom],
            vec![Page::of(&same).with(vec![Known::Fact(1)], 1, -x("z₁"))],
            Refusal::Identity,
        ),
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
    let of = |claim: &Statement, right: &Tree| Page::of(claim).form(right);
    accept(&wide, &proof(&[0], vec![of(&wide, &c), of(&wide, &(n(3) * &c))]));
    let difference = Page::of(&smaller).with(vec![Known::Fact(1)], 1, -x("z₁"));
    let row = |flaw, claim: &Statement, used: &[usize], signs, refusal| {
        (flaw, claim.clone(), proof(used, signs), refusal)
    };
    vec![
        row("a negative bound", &negative, &[0], vec![of(&negative, &-&c)], Refusal::Goal),
        row("one side of a bound", &wide, &[0], vec![of(&wide, &c)], Refusal::Missing),
        row("a number that is not negative for 0", &weak, &[0], vec![of(&weak, &l)], Refusal::Goal),
        row("another slope", &slope, &[], vec![of(&slope, &n(0))], Refusal::Identity),
        row("a slope at a kink", &kink, &[], vec![], Refusal::NotDifferentiable),
        row("the larger one", &smaller, &[0], vec![Reason::Fact(1), difference], Refusal::Goal),
    ]
}

#[test]
fn forged_roundings_are_refused() {
    refuse(shared_errors());
    refuse(errors());
    refuse(orders());
}

#[test]
fn forged_absolute_values_are_refused() {
    refuse(absolute_values());
}

#[test]
fn forged_exponents_and_goals_are_refused() {
    refuse(exponentials());
    refuse(goals());
}

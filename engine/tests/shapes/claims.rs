//! Claims about formulas of other shapes than those of the chapter: divisors that are differences, quotients,
//! brackets or rounded, in exact arithmetic and with rounding.

use provable::formula::claim::{
    PRECISION, SCALES, derivative, equal, geometric_limit, induction, limit, non_negative,
    perturbed_recursion, positive, within,
};
use provable::formula::{Hypothesis, Rate, Relation, Statement};
use provable::number::{Exponential, Field, PositivePart, Tree};

/// Returns claims that are proved.
pub fn claims() -> Vec<Statement> {
    let [a, b, c, d, f, g, x, y] = ["a", "b", "c", "d", "f", "g", "x", "y"].map(|name| Tree::symbol(name));
    let n = Tree::symbol(PRECISION);
    let one = || Tree::int(1);
    let above = |value: &Tree| Hypothesis::new(Relation::Positive, value.clone());
    let at_least = |value: &Tree| Hypothesis::new(Relation::NonNegative, value.clone());
    let [stiff_a, stiff_b, stiff_c, stiff_d] = [&a, &b, &c, &d].map(above);
    let (lens_f, lens_g, shorter) = (above(&f), above(&g), above(&(&g - &f)));
    let lens = || one() / (one() / &f - one() / &g);
    let once = |of: &Tree| of.round() - of;
    let product = above(&(&f * &g - one()));
    let below_one = above(&(one() - &x));
    let sum = Hypothesis::new(Relation::Zero, &a + &b - &c);
    let above_c = above(&(&c - &b));
    let scale = Tree::symbol(SCALES[0]);
    let power = above(&scale);
    let steeper = above(&(&a / &b - &c));
    let larger = at_least(&(&x - &y));
    let wide = Hypothesis::between(&y, -100, 100);
    let unit = Hypothesis::between(&x, -1, 1);
    let near_x = |own: &Tree, ulps: i32| Hypothesis::near(own, &x, x.abs() * Tree::int(ulps) / &n);
    let squared = (Tree::int(332) + &y) * (Tree::int(332) + &y);
    let inverse = one() / &squared;
    vec![
        induction("halves", one() / Tree::int(2), [one()], |[x]| [x / Tree::int(2)], [Tree::symbol("q")]),
        positive("between", &x - &x * &x).assuming([&above(&x), &below_one]),
        within("squared-interval", once(&(one() / &squared)), one() / &squared / &n).assuming([&wide]),
        within("squared-interval-each", inverse.with_rounding() - &inverse, Tree::int(8) * &inverse / &n)
            .assuming([&wide]),
        equal("lens", lens(), &f * &g / (&g - &f)).assuming([&lens_f, &shorter]),
        positive("lens-sign", lens()).assuming([&lens_f, &lens_g, &shorter]),
        within("lens-rounded", once(&lens()), lens() / &n).assuming([&lens_f, &shorter]),
        within("lens-rounded-g", once(&lens()), lens() / &n).assuming([&lens_f, &lens_g, &shorter]),
        positive("lens-rounded-sign", lens().round()).assuming([&lens_f, &lens_g, &shorter]),
        within("lens-twice", once(&(lens().round() * Tree::int(3))), lens() * Tree::int(6) / &n)
            .assuming([&lens_f, &shorter]),
        derivative("lens-slope", lens(), &f, lens() * lens() / (&f * &f))
            .assuming([&lens_f, &lens_g, &shorter]),
        limit("far-side", one() / (one() / &f + one() / &g), &g, &f, Rate::Equal(-(&f * &f / (&g + &f))))
            .assuming([&lens_f, &lens_g]),
        limit("beyond", &f * &g / (&g - &f), &g, &f, Rate::Equal(&f * &f / (&g - &f)))
            .assuming([&lens_f, &shorter]),
        limit(
            "with-constant",
            (-&a).exp() * &g / (&g + &f),
            &g,
            (-&a).exp(),
            Rate::Equal((-&a).exp() * &f / (&g + &f) * Tree::int(-1)),
        )
        .assuming([&lens_f, &lens_g]),
        vanishing("decay-of-product", &x * (-&a * &x).exp(), &[&stiff_a]),
        vanishing("decay-of-square", (-&a * &x * &x).exp(), &[&stiff_a]),
        vanishing("decay-twice", (-&a * &x).exp() * (-&b * &x).exp() / &x, &[&stiff_a, &stiff_b, &above(&x)]),
        vanishing("decay-by-quotient", (-&x * &x / (&a + &x)).exp(), &[&stiff_a, &above(&x)]),
        vanishing("later", &a / (&b * &x - one()), &[&stiff_a, &stiff_b, &above(&(&b * &x - one()))]),
        within("negative-divisor", once(&(&a / (&b - &c))), &a / (&c - &b) / &n)
            .assuming([&stiff_a, &above_c]),
        within("opposite-divisor", once(&(&a / -&b)), &a / &b / &n).assuming([&stiff_a, &stiff_b]),
        positive("negative-exact", -(&a / (&b - &c))).assuming([&stiff_a, &above_c]),
        within("quotient-of-quotients", once(&((&a / &b) / (&c / &d))), &a * &d / (&b * &c) / &n)
            .assuming([&stiff_a, &stiff_b, &stiff_c, &stiff_d]),
        equal("quotients-exact", &a / (&b / (&c / &d)), &a * &c / (&b * &d))
            .assuming([&stiff_a, &stiff_b, &stiff_c, &stiff_d]),
        within(
            "rounded-divisor",
            (&a / (&b / &c)).with_rounding() - &a * &c / &b,
            &a * &c / &b * Tree::int(3) / &n,
        )
        .assuming([&stiff_a, &stiff_b, &stiff_c]),
        within("rounded-operands", (a.round() / b.round()).round() - &a / &b, &a / &b * Tree::int(4) / &n)
            .assuming([&stiff_a, &stiff_b]),
        within(
            "rounded-difference",
            (&a / (&g - &f)).with_rounding() - &a / (&g - &f),
            &a / (&g - &f) * Tree::int(3) / &n,
        )
        .assuming([&stiff_a, &shorter]),
        positive("rounded-negative", -(&a / (&f - &g)).with_rounding()).assuming([&stiff_a, &shorter]),
        within("bracket", once(&(&a / (&b + x.positive_part()))), &a / &b / &n)
            .assuming([&stiff_a, &stiff_b]),
        positive("bracket-exact", &a / (&b + x.positive_part())).assuming([&stiff_a, &stiff_b]),
        equal("bracket-shut", &a / (&b + (-&x).positive_part()), &a / &b).assuming([&stiff_b, &at_least(&x)]),
        within("brackets", once(&(&a / (&b + (&x - y.positive_part()).positive_part()))), &a / &b / &n)
            .assuming([&stiff_a, &stiff_b]),
        positive("brackets-exact", one() / (&b + (&x - y.positive_part()).positive_part()))
            .assuming([&stiff_b]),
        within(
            "rounded-bracket",
            (&a / (&b + x.positive_part())).with_rounding() - &a / (&b + x.positive_part()),
            &a / &b * Tree::int(3) / &n,
        )
        .assuming([&stiff_a, &stiff_b]),
        within("bracket-over", once(&(x.round().positive_part() / &a)), x.abs() / &a * Tree::int(2) / &n)
            .assuming([&stiff_a]),
        within("steeper", once(&(one() / (&a / &b - &c))), one() / (&a / &b - &c) / &n)
            .assuming([&stiff_b, &steeper]),
        positive("steeper-exact", &b / (&a - &b * &c)).assuming([&stiff_b, &steeper]),
        within("negative-lens", once(&(one() / (one() / &g - one() / &f))), lens() / &n)
            .assuming([&lens_f, &shorter]),
        within("minimum", once(&(&a / b.min(&c))), (&a / &b + &a / &c) / &n)
            .assuming([&stiff_a, &stiff_b, &stiff_c]),
        positive("minimum-exact", &a / b.min(&c)).assuming([&stiff_a, &stiff_b, &stiff_c]),
        within("size", once(&(&a / (&b + x.abs()))), &a / &b / &n).assuming([&stiff_a, &stiff_b]),
        positive("size-exact", one() / (&b + (&x - &y).abs())).assuming([&stiff_b]),
        non_negative("order", (&x / (&g - &f)).round() - (&y / (&g - &f)).round())
            .assuming([&shorter, &larger]),
        non_negative("order-by-lens", (&x * lens()).round() - (&y * lens()).round())
            .assuming([&lens_f, &lens_g, &shorter, &larger]),
        non_negative(
            "order-over-lens",
            (&x / (one() / &f - one() / &g)).round() - (&y / (one() / &f - one() / &g)).round(),
        )
        .assuming([&lens_f, &lens_g, &shorter, &larger]),
        non_negative("order-in-cases", x.round() - x.min(&y).round()),
        non_negative("order-of-opposites", (-y.round()).round() - (-x.round()).round()).assuming([&larger]),
        non_negative("order-by-factor", (x.round() * &c).round() - (y.round() * &c).round())
            .assuming([&stiff_c, &larger]),
        non_negative("order-of-products", (&x * Tree::int(3)).round() - (&y * Tree::int(2)).round())
            .assuming([&at_least(&y), &larger]),
        non_negative("order-of-quotients", (&x / Tree::int(2)).round() - (&y / Tree::int(3)).round())
            .assuming([&at_least(&y), &larger]),
        non_negative("order-by-negative", ((&f - &g) * &y).round() - ((&f - &g) * &x).round())
            .assuming([&shorter, &larger]),
        // Computed one from the other.
        within("chain", d.round() - &x, x.abs() * Tree::int(6) / &n)
            .assuming([&near_x(&c, 1), &near_x(&d, 3)])
            .computing(&c, x.round())
            .computing(&d, c.round()),
        // That x is between −1 and 1 does not show that it is not negative.
        non_negative("kept", x.clone()).assuming([&at_least(&x), &unit]),
        non_negative("kept-reduced", x.clone()).assuming([
            &at_least(&x),
            &Hypothesis::near(&x, &a, &b),
            &at_least(&(&a - &c)),
        ]),
        positive("same-sign", x.clone()).assuming([&stiff_c, &above(&(&x * &c / &c))]),
        equal("kept-twice", x.positive_part() + y.positive_part() - x.positive_part(), y.positive_part())
            .assuming([&stiff_a, &stiff_b, &stiff_c, &stiff_d])
            .assuming([&Hypothesis::near(&x, &a, &b), &Hypothesis::near(&y, &c, &d)]),
        positive("kept-strictly", x.clone()).assuming([&above(&x), &unit]),
        equal("kept-bracket", x.positive_part(), x.clone()).assuming([&at_least(&x), &unit]),
        within("scale-divisor", once(&(&a / (&scale * (&g - &f)))), &a / (&scale * (&g - &f)) / &n)
            .assuming([&shorter, &stiff_a]),
        equal(
            "scale-lens",
            (&scale * &x / (one() / &f - one() / &g)).round(),
            &scale * (&x / (one() / &f - one() / &g)).round(),
        )
        .assuming([&lens_f, &lens_g, &shorter, &power]),
        equal("scale", (&scale * &x / (&g - &f)).round(), &scale * (&x / (&g - &f)).round())
            .assuming([&shorter, &power]),
        within("product", once(&(one() / (&f * &g - one()))), one() / (&f * &g - one()) / &n)
            .assuming([&product]),
        equal("product-exact", one() / (&f * &g - one()) * (one() - &f * &g), -one()).assuming([&product]),
        within("squares", once(&(one() / (&a * &a + &x * &x))), one() / (&a * &a) / &n).assuming([&stiff_a]),
        positive("square", (one() / ((&x - &y) * (&x - &y) + one())).round()),
        positive("square-exact", one() / (&x * &x - Tree::int(2) * &x * &y + &y * &y + one())),
        within("equation", once(&(one() / (&c - &a))), one() / &b / &n).assuming([&stiff_b, &sum]),
        equal("equation-exact", one() / (&c - &a), one() / &b).assuming([&stiff_b, &sum]),
        within("geometric", once(&(one() / (one() - &x))), one() / (one() - &x) / &n).assuming([&below_one]),
        within("exponential", once(&(one() / a.exp())), (-&a).exp() / &n).assuming([&stiff_a]),
        equal("exponential-exact", one() / (one() / x.exp()), x.exp()),
        positive("slope-divisor", one() / (a.exp() - &a - one())).assuming([&stiff_a]),
        positive("slope-exact", a.exp() - &a - one()).assuming([&stiff_a]),
        positive("bits", &n - Tree::int(3)).assuming([&at_least(&(&n - Tree::int(4)))]),
        within("both-signs", once(&(&a / (&f - &g) + &a / (&g - &f) + &a)), &a / &n)
            .assuming([&stiff_a, &shorter]),
    ]
}

/// States that a formula of x vanishes.
fn vanishing(name: &'static str, of: Tree, hypotheses: &[&Hypothesis]) -> Statement {
    limit(name, &of, &Tree::symbol("x"), 0, Rate::Equal(of.clone())).assuming(hypotheses.iter().copied())
}

/// Returns a claim about the first of these symbols for each rule, with a hypothesis on the others, in a section named
/// after the first one.
pub fn about(names: &[&'static str]) -> Vec<Statement> {
    let all: Vec<_> = names.iter().map(|name| Tree::symbol(name)).collect();
    let (x, c, one) = (&all[0], Tree::symbol("c"), Tree::int(1));
    let others =
        Hypothesis::new(Relation::Positive, all[1..].iter().fold(c.clone(), |sum, other| sum + other));
    let [above, rate] = [x, &c].map(|of| Hypothesis::new(Relation::Positive, of.clone()));
    let unit = Hypothesis::between(x, -1, 1);
    let half = || Tree::symbol("q") / Tree::int(2);
    let claims = [
        positive("rise", x.exp() - &one - x).assuming([&above]),
        non_negative("size", x.abs() - x),
        non_negative("interval", &one - x).assuming([&unit]),
        equal("exponential", x.exp() * (-x).exp(), 1),
        derivative("slope", x * x.exp(), x, x.exp() + x * x.exp()),
        limit("limit", (-&c * x).exp(), x, 0, Rate::Equal((-&c * x).exp())).assuming([&rate, &above]),
        geometric_limit("powers", &c / (&c + &one), x * Tree::symbol("q"), 0).assuming([&rate]),
        induction(
            "induction",
            one.clone() / Tree::int(2),
            [x.clone()],
            |[x]| [x / Tree::int(2)],
            [x * Tree::symbol("q")],
        ),
        within("rounded", x.round() - x, x.abs() / Tree::symbol(PRECISION)),
        non_negative("order", x.round() - (x - &c).round()).assuming([&rate]),
        perturbed_recursion("drift", one / Tree::int(2))
            .start(x)
            .step(|m| m / Tree::int(2))
            .near(x * half() * Tree::int(2), 0),
    ];
    claims.map(|claim| claim.assuming([&others]).inheriting(names[0], &[])).into()
}

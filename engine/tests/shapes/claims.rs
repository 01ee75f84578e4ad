//! Claims about formulas of many shapes: divisors that are differences, quotients, brackets or rounded, in exact
//! arithmetic and rounded.

use provable::formula::claim::{
    PRECISION, SCALES, derivative, equal, induction, limit, non_negative, positive, within,
};
use provable::formula::{Claim, Hypothesis, Rate, Relation};
use provable::number::{Exponential, Field, PositivePart, Tree};

/// Thirty-odd claims, each of which the kernel proves.
pub fn claims() -> Vec<Claim> {
    let [a, b, c, d, f, g, x, y] = ["a", "b", "c", "d", "f", "g", "x", "y"].map(|name| Tree::symbol(name));
    let n = Tree::symbol(PRECISION);
    let one = || Tree::int(1);
    let above = |value: &Tree| Hypothesis::new(Relation::Positive, value.clone());
    let at_least = |value: &Tree| Hypothesis::new(Relation::NonNegative, value.clone());
    let [stiff_a, stiff_b, stiff_c, stiff_d] = [&a, &b, &c, &d].map(above);
    let (lens_f, lens_g, shorter) = (above(&f), above(&g), above(&(&g - &f)));
    let lens = || one() / (one() / &f - one() / &g);
    let once = |of: &Tree| of.nearest() - of;
    let product = above(&(&f * &g - one()));
    let below_one = above(&(one() - &x));
    let sum = Hypothesis::new(Relation::Zero, &a + &b - &c);
    let above_c = above(&(&c - &b));
    let scale = Tree::symbol(SCALES[0]);
    let power = above(&scale);
    let steeper = above(&(&a / &b - &c));
    let larger = at_least(&(&x - &y));
    let wide = Hypothesis::between(&y, -100, 100);
    let squared = (Tree::int(332) + &y) * (Tree::int(332) + &y);
    let inverse = one() / &squared;
    vec![
        induction("halves", [], one() / Tree::int(2), [one()], |[x]| [x / Tree::int(2)], [Tree::symbol("q")]),
        positive("between", [&above(&x), &below_one], &x - &x * &x),
        within("squared-interval", [&wide], once(&(one() / &squared)), one() / &squared / &n),
        within("squared-interval-each", [&wide], inverse.rounded() - &inverse, Tree::int(8) * &inverse / &n),
        equal("lens", [&lens_f, &shorter], lens(), &f * &g / (&g - &f)),
        positive("lens-sign", [&lens_f, &lens_g, &shorter], lens()),
        within("lens-rounded", [&lens_f, &shorter], once(&lens()), lens() / &n),
        within("lens-rounded-g", [&lens_f, &lens_g, &shorter], once(&lens()), lens() / &n),
        positive("lens-rounded-sign", [&lens_f, &lens_g, &shorter], lens().nearest()),
        within(
            "lens-twice",
            [&lens_f, &shorter],
            once(&(lens().nearest() * Tree::int(3))),
            lens() * Tree::int(6) / &n,
        ),
        derivative("lens-slope", [&lens_f, &lens_g, &shorter], lens(), &f, lens() * lens() / (&f * &f)),
        limit(
            "far-side",
            [&lens_f, &lens_g],
            one() / (one() / &f + one() / &g),
            &g,
            &f,
            Rate::Exactly(-(&f * &f / (&g + &f))),
        ),
        within("negative-divisor", [&stiff_a, &above_c], once(&(&a / (&b - &c))), &a / (&c - &b) / &n),
        within("opposite-divisor", [&stiff_a, &stiff_b], once(&(&a / -&b)), &a / &b / &n),
        positive("negative-exact", [&stiff_a, &above_c], -(&a / (&b - &c))),
        within(
            "quotient-of-quotients",
            [&stiff_a, &stiff_b, &stiff_c, &stiff_d],
            once(&((&a / &b) / (&c / &d))),
            &a * &d / (&b * &c) / &n,
        ),
        equal(
            "quotients-exact",
            [&stiff_a, &stiff_b, &stiff_c, &stiff_d],
            &a / (&b / (&c / &d)),
            &a * &c / (&b * &d),
        ),
        within(
            "rounded-divisor",
            [&stiff_a, &stiff_b, &stiff_c],
            (&a / (&b / &c)).rounded() - &a * &c / &b,
            &a * &c / &b * Tree::int(3) / &n,
        ),
        within(
            "rounded-operands",
            [&stiff_a, &stiff_b],
            (a.nearest() / b.nearest()).nearest() - &a / &b,
            &a / &b * Tree::int(4) / &n,
        ),
        within(
            "rounded-difference",
            [&stiff_a, &shorter],
            (&a / (&g - &f)).rounded() - &a / (&g - &f),
            &a / (&g - &f) * Tree::int(3) / &n,
        ),
        positive("rounded-negative", [&stiff_a, &shorter], -(&a / (&f - &g)).rounded()),
        within("bracket", [&stiff_a, &stiff_b], once(&(&a / (&b + x.positive_part()))), &a / &b / &n),
        positive("bracket-exact", [&stiff_a, &stiff_b], &a / (&b + x.positive_part())),
        equal("bracket-shut", [&stiff_b, &at_least(&x)], &a / (&b + (-&x).positive_part()), &a / &b),
        within(
            "brackets",
            [&stiff_a, &stiff_b],
            once(&(&a / (&b + (&x - y.positive_part()).positive_part()))),
            &a / &b / &n,
        ),
        positive("brackets-exact", [&stiff_b], one() / (&b + (&x - y.positive_part()).positive_part())),
        within(
            "rounded-bracket",
            [&stiff_a, &stiff_b],
            (&a / (&b + x.positive_part())).rounded() - &a / (&b + x.positive_part()),
            &a / &b * Tree::int(3) / &n,
        ),
        within(
            "bracket-over",
            [&stiff_a],
            once(&(x.nearest().positive_part() / &a)),
            x.abs() / &a * Tree::int(2) / &n,
        ),
        within("steeper", [&stiff_b, &steeper], once(&(one() / (&a / &b - &c))), one() / (&a / &b - &c) / &n),
        positive("steeper-exact", [&stiff_b, &steeper], &b / (&a - &b * &c)),
        within("negative-lens", [&lens_f, &shorter], once(&(one() / (one() / &g - one() / &f))), lens() / &n),
        within("minimum", [&stiff_a, &stiff_b, &stiff_c], once(&(&a / b.min(&c))), (&a / &b + &a / &c) / &n),
        positive("minimum-exact", [&stiff_a, &stiff_b, &stiff_c], &a / b.min(&c)),
        within("size", [&stiff_a, &stiff_b], once(&(&a / (&b + x.abs()))), &a / &b / &n),
        positive("size-exact", [&stiff_b], one() / (&b + (&x - &y).abs())),
        non_negative("order", [&shorter, &larger], (&x / (&g - &f)).nearest() - (&y / (&g - &f)).nearest()),
        non_negative(
            "order-by-lens",
            [&lens_f, &lens_g, &shorter, &larger],
            (&x * lens()).nearest() - (&y * lens()).nearest(),
        ),
        non_negative(
            "order-over-lens",
            [&lens_f, &lens_g, &shorter, &larger],
            (&x / (one() / &f - one() / &g)).nearest() - (&y / (one() / &f - one() / &g)).nearest(),
        ),
        within(
            "scale-divisor",
            [&shorter, &stiff_a],
            once(&(&a / (&scale * (&g - &f)))),
            &a / (&scale * (&g - &f)) / &n,
        ),
        equal(
            "scale-lens",
            [&lens_f, &lens_g, &shorter, &power],
            (&scale * &x / (one() / &f - one() / &g)).nearest(),
            &scale * (&x / (one() / &f - one() / &g)).nearest(),
        ),
        equal(
            "scale",
            [&shorter, &power],
            (&scale * &x / (&g - &f)).nearest(),
            &scale * (&x / (&g - &f)).nearest(),
        ),
        within("product", [&product], once(&(one() / (&f * &g - one()))), one() / (&f * &g - one()) / &n),
        equal("product-exact", [&product], one() / (&f * &g - one()) * (one() - &f * &g), -one()),
        within("squares", [&stiff_a], once(&(one() / (&a * &a + &x * &x))), one() / (&a * &a) / &n),
        positive("square", [], (one() / ((&x - &y) * (&x - &y) + one())).nearest()),
        positive("square-exact", [], one() / (&x * &x - Tree::int(2) * &x * &y + &y * &y + one())),
        within("equation", [&stiff_b, &sum], once(&(one() / (&c - &a))), one() / &b / &n),
        equal("equation-exact", [&stiff_b, &sum], one() / (&c - &a), one() / &b),
        within("geometric", [&below_one], once(&(one() / (one() - &x))), one() / (one() - &x) / &n),
        within("exponential", [&stiff_a], once(&(one() / a.exp())), (-&a).exp() / &n),
        equal("exponential-exact", [], one() / (one() / x.exp()), x.exp()),
        within("both-signs", [&stiff_a, &shorter], once(&(&a / (&f - &g) + &a / (&g - &f) + &a)), &a / &n),
    ]
}

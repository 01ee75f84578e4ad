//! False claims, one for each rule, case and premise of the kernel: none is proved, all are refuted by numbers,
//! and each has a true one beside it that differs in the premise and is proved.
#![cfg(feature = "prover")]
#![allow(clippy::eq_op, reason = "a quotient of equals is not always 1")]

use provable::formula::claim::{
    Claim, Kind, PRECISION, Rate, derivative, drift, equal, induction, non_negative, positive, vanishing,
    within,
};
use provable::formula::{Hypothesis, Relation, Statement};
use provable::number::{Exponential, PositivePart, Tree};
use provable::proof::{prove, refute};
use std::collections::BTreeSet;

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

fn n(n: i32) -> Tree {
    Tree::from(n)
}

fn above_zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::Positive, value.into())
}

fn not_below_zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, value.into())
}

fn zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::Zero, value.into())
}

/// A claim of which more is assumed than it was made with.
fn also(claim: Claim, more: Hypothesis) -> Claim {
    Claim { given: [claim.given, vec![more]].concat(), ..claim }
}

/// A rule or premise, a false claim, a true one that differs in it.
type Row = (&'static str, Claim, Claim);

fn signs() -> Vec<Row> {
    let [a, b, u, v, k] = ["a", "b", "u", "v", "k"].map(x);
    let [pos_a, pos_b, weak_a] = [above_zero(&a), above_zero(&b), not_below_zero(&a)];
    let negative_a = above_zero(-&a);
    let e1 = Hypothesis::between(&u, -1, 1);
    let e2 = Hypothesis::between(&v, -1, 1);
    vec![
        ("a weak sign is not strict", positive("f", [&weak_a], &a), non_negative("t", [&weak_a], &a)),
        (
            "terms of two signs have none",
            positive("f", [&pos_a, &pos_b], &a - &b),
            positive("t", [&pos_a, &pos_b], &a + &b),
        ),
        ("a square may be 0", positive("f", [], &u * &u), non_negative("t", [], &u * &u)),
        (
            "an odd power of a negative number is negative",
            positive("f", [&negative_a], &a * &a * &a),
            positive("t", [&negative_a], &a * &a),
        ),
        (
            "a factor counts with its sign",
            positive("f", [&negative_a], &a * (&u * &u - n(2) * &u + n(2))),
            positive("t", [&pos_a], &a * (&u * &u - n(2) * &u + n(2))),
        ),
        (
            "a square completed over a coefficient that may be 0",
            positive("f", [&weak_a], &a * &u * &u + &u + n(1)),
            positive("t", [&pos_a], &a * &a * &u * &u + &a * &u + n(1)),
        ),
        (
            "a square that crosses 0",
            positive("f", [], &u * &u + n(3) * &u + n(2)),
            positive("t", [], &u * &u + n(2) * &u + n(2)),
        ),
        (
            "a quadratic of negative leading coefficient",
            positive("f", [], n(1) - &u - &u * &u),
            positive("t", [], n(1) - &u + &u * &u),
        ),
        (
            "a slope proves nothing without a start",
            positive("f", [&pos_a], a.exp() - n(2) - &a),
            positive("t", [&pos_a], a.exp() - n(1) - &a),
        ),
        (
            "a slope proves nothing where the symbol may be negative",
            positive("f", [], u.exp() - n(1) - &u / n(2)),
            positive("t", [&pos_a], a.exp() - n(1) - &a / n(2)),
        ),
        (
            "a slope of the other sign",
            positive("f", [&pos_a], n(1) + &a - (n(2) * &a).exp()),
            positive("t", [&pos_a], (n(2) * &a).exp() - n(1) - &a),
        ),
        (
            "absolute values of terms add up",
            non_negative("f", [&e1, &e2], n(3) + n(2) * &u + n(2) * &v),
            non_negative("t", [&e1, &e2], n(4) + n(2) * &u + n(2) * &v),
        ),
        (
            "a coefficient without a sign bounds nothing",
            non_negative("f", [&e1], &b * (n(2) + &u)),
            non_negative("t", [&e1, &pos_b], &b * (n(2) + &u)),
        ),
        (
            "both ends count",
            non_negative("f", [&e1, &e2], (n(1) + &u) * (n(2) + n(3) * &v)),
            non_negative("t", [&e1, &e2], (n(1) + &u) * (n(2) + &v)),
        ),
        (
            "between the ends a square may be less than at both",
            non_negative("f", [&e1], n(4) * &u * &u - n(1)),
            non_negative("t", [&e1], (n(2) + &u) * (n(2) + &u)),
        ),
        (
            "a divisor counts with its sign",
            positive("f", [&negative_a], n(1) / &a),
            positive("t", [&pos_a], n(1) / &a),
        ),
        (
            "of two strict bounds both are needed",
            positive("f", [&above_zero(&k)], &k - &k * &k),
            positive("t", [&above_zero(&k), &above_zero(n(1) - &k)], &k - &k * &k),
        ),
        (
            "of two bounds the lower one is strict",
            positive("f", [&not_below_zero(&k), &above_zero(n(1) - &k)], &k - &k * &k),
            positive("t", [&above_zero(&k), &above_zero(n(1) - &k)], &k - &k * &k),
        ),
        (
            "a bound that may be met",
            positive("f", [&above_zero(&k), &not_below_zero(n(1) - &k)], &k - &k * &k),
            non_negative("t", [&above_zero(&k), &not_below_zero(n(1) - &k)], &k - &k * &k),
        ),
    ]
}

fn hypotheses() -> Vec<Row> {
    let [a, b, c, d, u, v, lambda] = ["a", "b", "c", "d", "u", "v", "λ"].map(x);
    let difference = above_zero(&b - &a);
    let product = |factor: Tree| zero(&factor * &u - &factor);
    let [pos_b, unit] = [above_zero(&b), Hypothesis::between(&u, 0, 1)];
    let power = zero(&u * &v * a.exp() - &b);
    let (wide, narrow) = (Hypothesis::near(&u, &v, &c), Hypothesis::near(&u, &v, 0));
    vec![
        (
            "a hypothesis is weak",
            positive("f", [&not_below_zero(&b - &a)], &b - &a),
            positive("t", [&difference], &b - &a),
        ),
        (
            "a hypothesis is one way round",
            positive("f", [&difference], &a - &b),
            positive("t", [&difference], &b - &a),
        ),
        (
            "no factor that may be 0 is cancelled in a hypothesis",
            equal("f", [&product(lambda.clone())], &u, 1),
            equal("t", [&above_zero(&lambda), &product(lambda.clone())], &u, 1),
        ),
        (
            "an exponential in a hypothesis is a factor",
            equal("f", [&pos_b, &power], &u * &v, &b),
            equal("t", [&power], &u * &v * a.exp(), &b),
        ),
        (
            "the sign of a symbol that is replaced",
            positive("f", [&above_zero(&b - &a)], &b),
            positive("t", [&above_zero(&a), &above_zero(&b - &a)], &b),
        ),
        (
            "an interval has two ends",
            non_negative("f", [&unit], n(1) / n(2) - &u),
            non_negative("t", [&unit], n(1) - &u),
        ),
        (
            "the ends of an interval may be in any order",
            non_negative("f", [&Hypothesis::between(&u, &c, &d)], &u - &c),
            non_negative("t", [&above_zero(&d - &c), &Hypothesis::between(&u, &c, &d)], &u - &c),
        ),
        (
            "the reach of an interval may be negative",
            within("f", [&wide], &u - &v, &c),
            within("t", [&wide, &above_zero(&c)], &u - &v, &c),
        ),
        (
            "a bound holds on both sides",
            within("f", [&narrow, &not_below_zero(&c)], &u - &v - n(1), &c),
            within("t", [&narrow, &not_below_zero(&c)], &u - &v - &c, &c),
        ),
        (
            "a bound may not be negative",
            within("f", [&not_below_zero(&c)], 0, -&c),
            within("t", [&not_below_zero(&c)], 0, &c),
        ),
    ]
}

fn cases_and_divisors() -> Vec<Row> {
    let [a, b, c, u, v, w, z] = ["a", "b", "c", "u", "v", "w", "z"].map(x);
    let part = |tree: &Tree| tree.positive_part();
    let [pos_c, weak_c] = [above_zero(&c), not_below_zero(&c)];
    let two = |a: Tree, b: Tree| part(&a) * part(&b) * (a - b);
    let abs = |tree: &Tree| tree.abs();
    vec![
        ("a bracket may be closed", equal("f", [], part(&u), &u), equal("t", [&pos_c], part(&c), &c)),
        ("a bracket may be open", equal("f", [], part(&u), 0), equal("t", [&pos_c], part(&-&c), 0)),
        (
            "0 belongs to one of two cases",
            positive("f", [], part(&u) + part(&-&u)),
            non_negative("t", [], part(&u) + part(&-&u)),
        ),
        (
            "each case has a slack of its own",
            equal("f", [], two(&u - &v, &w - &z), 0),
            equal("t", [], two(&u - &v, &u - &v), 0),
        ),
        (
            "a minimum is the smaller one",
            equal("f", [&above_zero(&b - &a)], a.min(&b), &b),
            equal("t", [&above_zero(&b - &a)], a.min(&b), &a),
        ),
        (
            "a minimum of what is open is either",
            equal("f", [], u.min(&v), &u),
            equal("t", [], u.min(&v), (&u + &v - abs(&(&u - &v))) / n(2)),
        ),
        ("a divisor may be 0", equal("f", [], &u / &u, 1), equal("t", [&pos_c], &c / &c, 1)),
        (
            "a divisor of weak sign may be 0",
            equal("f", [&weak_c], &c / &c, 1),
            equal("t", [&weak_c], (&c + n(1)) / (&c + n(1)), 1),
        ),
        (
            "what is multiplied by 0 has to be defined",
            equal("f", [], n(0) * (n(1) / &u), 0),
            equal("t", [&pos_c], n(0) * (n(1) / &c), 0),
        ),
        (
            "a divisor that is a difference of equals",
            equal("f", [&zero(&u - &v)], n(1) / (&u - &v + &c * &c), n(1) / (&c * &c)),
            equal("t", [&zero(&u - &v), &pos_c], n(1) / (&u - &v + &c * &c), n(1) / (&c * &c)),
        ),
        (
            "one factor of a divisor may be 0",
            positive("f", [&pos_c], n(1) / (&c * (&u * &u))),
            positive("t", [&pos_c], n(1) / (&c * (&u * &u + n(1)))),
        ),
    ]
}

fn slopes_and_limits() -> Vec<Row> {
    let [a, c, t, u, w] = ["a", "c", "t", "u", "w"].map(x);
    let [pos_a, pos_c, time, weak_c] = [above_zero(&a), above_zero(&c), above_zero(&t), not_below_zero(&c)];
    let tends = |name, given: &[&Hypothesis], of: Tree, to: Tree| {
        let rate = Rate::Exactly(&of - &to);
        Claim::new(name, given, Kind::Limit { of, by: "t", to, rate })
    };
    let later = above_zero(&t - &a);
    vec![
        (
            "a product rule has two terms",
            derivative("f", [], &u * &u, &u, &u),
            derivative("t", [], &u * &u, &u, n(2) * &u),
        ),
        (
            "a slope is by one symbol",
            derivative("f", [], &u * &w, &u, &u),
            derivative("t", [], &u * &w, &u, &w),
        ),
        (
            "degrees are compared",
            tends("f", &[&time], (&t * &t + n(1)) / (&t + n(1)), n(1)),
            tends("t", &[&time], (&t + n(2)) / (&t + n(1)), n(1)),
        ),
        (
            "of equal degrees the coefficients count",
            tends("f", &[&time], (n(2) * &t + n(1)) / (&t + n(1)), n(1)),
            tends("t", &[&time], (n(2) * &t + n(1)) / (&t + n(1)), n(2)),
        ),
        (
            "a leading coefficient may be 0",
            tends("f", &[&weak_c, &time], n(1) / (n(1) + &c * &t), n(0)),
            tends("t", &[&pos_c, &time], n(1) / (n(1) + &c * &t), n(0)),
        ),
        (
            "an exponential in a denominator grows",
            tends("f", &[&time], &t / (&t + t.exp()), n(1)),
            tends("t", &[&time], &t / (&t + n(1)), n(1)),
        ),
        (
            "an exponential may grow",
            tends("f", &[&pos_c, &time], &t * (&c * &t).exp(), n(0)),
            tends("t", &[&pos_c, &time], &t * (-&c * &t).exp(), n(0)),
        ),
        (
            "an exponent of unknown sign may grow",
            tends("f", &[&time], (&u * &t).exp(), n(0)),
            tends("t", &[&pos_c, &time], (-&c * &t).exp(), n(0)),
        ),
        (
            "an exponent that tends to a number",
            tends("f", &[&time], (-&t / (&t + n(1))).exp(), n(0)),
            tends("t", &[&time], (-&t * &t / (&t + n(1))).exp(), n(0)),
        ),
        (
            "an exponent with an exponential has no degree",
            tends("f", &[&time], (t.exp() - &t).exp(), n(0)),
            tends("t", &[&time], (n(1) - &t).exp(), n(0)),
        ),
        (
            "a case may end on the way",
            tends("f", &[&pos_a, &time], &a / &t + n(0) * (&a - &t).positive_part(), n(1)),
            tends("t", &[&pos_a, &time], &a / &t, n(0)),
        ),
        (
            "in a case no quantity depends on the variable",
            tends("f", &[&time], &a / &t + n(0) * (&a - &u * &t).positive_part(), u.clone()),
            tends("t", &[&time], &a / &t + n(0) * &a.positive_part(), n(0)),
        ),
        (
            "a limit does not vary",
            tends("f", &[&time], &t / (&t + n(1)), &t * n(0) + &t / (&t + n(2)) * &t),
            tends("t", &[&time], &t / (&t + n(1)), n(1)),
        ),
        (
            "a pole on the way",
            tends("f", &[&pos_a, &time], &t / (&t - &a), n(1)),
            tends("t", &[&pos_a, &later], &t / (&t - &a), n(1)),
        ),
        (
            "what is larger than a quantity is not that quantity",
            tends("f", &[&pos_a, &later], &a * &t / (&t - &a), n(1)),
            tends("t", &[&pos_a, &later], &a * &t / (&t - &a), a.clone()),
        ),
    ]
}

fn sequences() -> Vec<Row> {
    let [a, c, q, u, w, z] = ["a", "c", "q", "u", "w", "z"].map(x);
    let half = || n(1) / n(2);
    let double = |[x]: [Tree; 1]| [n(2) * x];
    let [pos_c, unit] = [above_zero(&c), Hypothesis::between(&q, 0, 1)];
    let halves = |name, step: Tree, bound: Tree| {
        let near = Hypothesis::near(&u, x("x₁") / n(2), 0);
        drift(name, [&unit, &near], half(), 1, |_| u.clone(), (n(0), bound), |_| []).computing(&u, step)
    };
    let [from_one, near_q] = [not_below_zero(&q - n(1)), Hypothesis::near(&u, &q, 0)];
    let square = &z * &z * &w * &w;
    let grows = |name, step: Tree| {
        drift(name, [&from_one, &near_q], 2, 0, |x| x + &step, (n(0), n(0)), |_| []).computing(&u, &q)
    };
    let raised = (&u * (&u - n(1)) - &square).positive_part();
    vec![
        (
            "a sequence begins where it begins",
            induction("f", [], 2, [n(3)], double, [q.clone()]),
            induction("t", [], 2, [n(3)], double, [n(3) * &q]),
        ),
        (
            "a sequence goes on as it goes on",
            induction("f", [], 2, [n(1)], |[x]| [n(3) * x], [q.clone()]),
            induction("t", [], 3, [n(1)], |[x]| [n(3) * x], [q.clone()]),
        ),
        (
            "a sequence does not start from a power",
            induction("f", [], 2, [&q * n(1)], |[x]| [x * n(2) + n(1)], [n(2) * &q - n(1)]),
            induction("t", [], 2, [n(1)], |[x]| [x * n(2) + n(1)], [n(2) * &q - n(1)]),
        ),
        (
            "an invariant holds at the start",
            induction(
                "f",
                [&not_below_zero(&q - n(2))],
                2,
                [n(1)],
                |[x]| [x.clone() + (x - n(1)) * n(0) + n(0)],
                [q.clone()],
            ),
            induction(
                "t",
                [&not_below_zero(&q - n(1))],
                2,
                [n(1)],
                |[x]| [x.clone() + n(1) + (x - n(1)).positive_part()],
                [q.clone()],
            ),
        ),
        (
            "an invariant is passed on",
            induction(
                "f",
                [&not_below_zero(n(2) - &q)],
                2,
                [n(1)],
                |[x]| [x.clone() + n(2).min(&x)],
                [q.clone()],
            ),
            induction(
                "t",
                [&above_zero(&q), &not_below_zero(n(1) - &q)],
                half(),
                [n(1)],
                |[x]| [x.clone() - half() * x.min(&n(1))],
                [q.clone()],
            ),
        ),
        (
            "a power vanishes if the ratio is between −1 and 1",
            vanishing("f", [&pos_c], (&c + n(1)) / (&c + n(2)) + n(1), &q, 0),
            vanishing("t", [&pos_c], (&c + n(1)) / (&c + n(2)), &q, 0),
        ),
        (
            "a limit is the value at 0",
            vanishing("f", [], half(), (&q + n(1)) / (&q * &q + n(1)), 2),
            vanishing("t", [], half(), (&q + n(1)) / (&q * &q + n(1)), 1),
        ),
        (
            "what is not continuous at 0 has another limit",
            vanishing("f", [], half(), &q / (&q * &q + &q), 0),
            vanishing("t", [], half(), &q / (&q * &q + n(1)), 0),
        ),
        (
            "a computed quantity is where it is assumed",
            halves("f", x("x₁"), q.clone()),
            halves("t", x("x₁") / n(2), q.clone()),
        ),
        (
            "a bound is kept by each step",
            halves("f", x("x₁") / n(2), &q * &q),
            halves("t", x("x₁") / n(2), n(2) * &q),
        ),
        (
            "a bound is kept at the start",
            halves("f", x("x₁") / n(2), &q / n(2)),
            halves("t", x("x₁") / n(2), n(1) * &q),
        ),
        (
            "nothing but its interval is assumed of a computed quantity",
            also(grows("f", raised.clone()), not_below_zero(&square - &u * (&u - n(1)))),
            grows("t", n(0) * &u),
        ),
        (
            "nor together with the power",
            also(grows("f", raised), not_below_zero(&square - &u * (&u - n(1)) + (&q - &u))),
            grows("t", n(0) * &a),
        ),
    ]
}

fn names() -> Vec<Row> {
    let [u, v] = ["u", "v"].map(x);
    let above = above_zero(&u - n(1));
    vec![
        ("a slack", positive("f", [&above], x("s₁")), positive("t", [&above], &u)),
        ("an error", non_negative("f", [], n(1) - x("e₁")), non_negative("t", [], n(1) - n(1))),
        ("an interval parameter", non_negative("f", [], n(1) + x("t₁")), non_negative("t", [], n(1) + n(1))),
        ("a member", equal("f", [&zero(&u - n(1))], x("x₁"), 1), equal("t", [&zero(&u - n(1))], &u, 1)),
        (
            "a power of two that is computed",
            positive("f", [&Hypothesis::near(&x("2ᵃ"), &v, 0)], x("2ᵃ")).computing(&x("2ᵃ"), &v),
            positive("t", [&above_zero(&v), &Hypothesis::near(&u, &v, 0)], &u).computing(&u, &v),
        ),
    ]
}

fn roundings() -> Vec<Row> {
    let [a, b, c, d, u] = ["a", "b", "c", "d", "u"].map(x);
    let fl = |tree: Tree| tree.nearest();
    let [pos_c, pos_d] = [above_zero(&c), above_zero(&d)];
    let n_of = |more: i32| x(PRECISION) + n(more);
    let error = || fl(u.clone()) - &u;
    let ordered = not_below_zero(&a - &b);
    vec![
        (
            "rounding is not exact",
            equal("f", [], fl(u.clone()), &u),
            equal("t", [], fl(u.clone()), fl(n(1) * &u)),
        ),
        (
            "an error has two signs",
            non_negative("f", [&above_zero(&u)], error()),
            non_negative("t", [&above_zero(&u)], fl(u.clone())),
        ),
        (
            "an error is as large as it can be",
            within("f", [], error(), u.abs() / n_of(2)),
            within("t", [], error(), u.abs() / n_of(1)),
        ),
        (
            "equal numerators over two divisors round apart",
            equal("f", [&pos_c, &pos_d], fl(&a / &c) * &c, fl(&a / &d) * &d),
            equal("t", [&pos_c, &pos_d], fl(&a / &c) * &d, fl(&a / &c) * &d),
        ),
        (
            "equal divisors under two numerators round apart",
            equal("f", [&pos_c], fl(&a / &c) * &b, fl(&b / &c) * &a),
            equal("t", [&pos_c], fl(&a / &c) * &b, &b * fl(&a / &c)),
        ),
        (
            "a factor that is no power of two rounds apart",
            equal("f", [], fl(n(3) * &u), n(3) * fl(u.clone())),
            equal("t", [], fl(x("2ᵃ") * &u), x("2ᵃ") * fl(u.clone())),
        ),
        (
            "a sum rounds apart from its parts",
            equal("f", [], fl(&a + &b), fl(a.clone()) + fl(b.clone())),
            equal("t", [], fl(&a + &b), fl(&b + &a)),
        ),
        (
            "a rounded number is rounded",
            equal("f", [], fl(fl(u.clone()) * &a), fl(&u * &a)),
            equal("t", [], fl(&a * fl(u.clone())), fl(fl(u.clone()) * &a)),
        ),
        (
            "rounding keeps order and does not make it",
            non_negative("f", [], fl(a.clone()) - fl(b.clone())),
            non_negative("t", [&ordered], fl(a.clone()) - fl(b.clone())),
        ),
        (
            "rounding keeps a weak order only",
            positive("f", [&above_zero(&a - &b)], fl(a.clone()) - fl(b.clone())),
            non_negative("t", [&above_zero(&a - &b)], fl(a.clone()) - fl(b.clone())),
        ),
        (
            "a minus turns order round",
            non_negative("f", [&ordered], fl(&c - &a) - fl(&c - &b)),
            non_negative("t", [&ordered], fl(&c - &b) - fl(&c - &a)),
        ),
        (
            "a negative factor turns order round",
            non_negative("f", [&ordered, &above_zero(-&c)], fl(&a * &c) - fl(&b * &c)),
            non_negative("t", [&ordered, &pos_c], fl(&a * &c) - fl(&b * &c)),
        ),
        (
            "a negative divisor turns order round",
            non_negative("f", [&ordered, &above_zero(-&c)], fl(fl(a.clone()) / &c) - fl(fl(b.clone()) / &c)),
            non_negative("t", [&ordered, &pos_c], fl(fl(a.clone()) / &c) - fl(fl(b.clone()) / &c)),
        ),
        (
            "factors that differ keep no order",
            non_negative("f", [&ordered, &pos_c], fl(&a * &c) - fl(&b * (&c + n(1)))),
            non_negative("t", [&ordered, &pos_c], fl(&a * (&c + n(1))) - fl(&b * (&c + n(1)))),
        ),
        (
            "what is compared is defined",
            non_negative("f", [], fl(&a / &u) - fl(&a / &u)),
            non_negative("t", [&above_zero(&u)], fl(&a / &u) - fl(&a / &u)),
        ),
    ]
}

fn all() -> impl Iterator<Item = Row> {
    [signs, hypotheses, cases_and_divisors, slopes_and_limits, sequences, names, roundings]
        .into_iter()
        .flat_map(|rows| rows())
}

/// The counterexamples that exact arithmetic does not find, since e^… is no rational number.
const BY_HAND: [(&str, &str); 4] = [
    ("an exponential in a hypothesis is a factor", "a = u = v = 1, b = e"),
    ("an exponential in a denominator grows", "the limit is 0"),
    ("an exponential may grow", "c = 1"),
    ("an exponent with an exponential has no degree", "eᵗ − t tends to infinity"),
];

#[test]
fn false_claims_are_refuted_and_not_proved() {
    let wrong = all().filter_map(|(premise, claim, _)| {
        let statement = Statement::of(&claim);
        let by_hand = BY_HAND.iter().any(|(own, _)| *own == premise);
        match (prove(&statement), refute(&statement)) {
            (Ok(_), _) => Some(format!("{premise}: proved")),
            (Err(why), None) if !by_hand => Some(format!("{premise}: not refuted; {why}")),
            (Err(_), Some(point)) if by_hand => Some(format!("{premise}: take it out of BY_HAND; {point}")),
            (Err(_), _) => None,
        }
    });
    let wrong: Vec<_> = wrong.collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let premises: BTreeSet<_> = all().map(|(premise, ..)| premise).collect();
    assert_eq!((premises.len(), all().count()), (88, 88), "each premise has one row, and none is lost");
}

#[test]
fn true_claims_beside_them_are_proved_and_not_refuted() {
    let wrong = all().filter_map(|(premise, _, claim)| {
        let statement = Statement::of(&claim);
        match (prove(&statement), refute(&statement)) {
            (Ok(_), None) => None,
            (_, Some(point)) => Some(format!("{premise}: refuted, {point}")),
            (Err(why), None) => Some(format!("{premise}: {why}")),
        }
    });
    let wrong: Vec<_> = wrong.collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

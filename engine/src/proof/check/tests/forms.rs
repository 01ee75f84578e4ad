//! Certificates for signs.

use super::*;

/// 4 (u² + 2 u + 2) = (2 u + 2)² + 4.
#[test]
fn a_square_is_not_negative() {
    let u = x("u");
    let of = &u * &u + n(2) * &u + n(2);
    let claim = positive("square", &of);
    let page = Page::of(&claim);
    let square = Step::Square(page.poly(n(2) * &u + n(2)));
    accept(&claim, &[leaf(0, vec![square, page.show(of, &[1], 4, x("z₁") + n(4))])]);
}

/// a² − b² = (a + b)(a − b), of which the second factor is a hypothesis.
#[test]
fn facts_are_factors() {
    let [a, b] = ["a", "b"].map(x);
    let of = &a * &a - &b * &b;
    let claim = positive("product", &of).assuming(&[above_zero(&b), above_zero(&a - &b)]);
    let page = Page::of(&claim);
    let sum = page.show(&a + &b, &[2], 1, x("z₁") + n(2) * &b);
    accept(&claim, &[leaf(2, vec![sum, page.show(of, &[3, 2], 1, x("z₁") * x("z₂"))])]);
}

/// 4 − 2 u − v² u ≥ 4 − 2 − 1 for −1 ≤ u, v ≤ 1.
#[test]
fn factors_between_minus_1_and_1_do_not_increase_terms() {
    let [u, v] = ["u", "v"].map(x);
    let given = [Hypothesis::between(&u, -1, 1), Hypothesis::between(&v, -1, 1)];
    let small = |u: &Tree, v: &Tree| n(4) - n(2) * u - v * v * u + n(3) * v * v;
    let claim = positive("small", small(&u, &v)).assuming(&given);
    let page = Page::of(&claim);
    let [s, t] = ["t₁", "t₂"].map(x);
    // The denominator is 2³: half the length of each interval is 2/2.
    accept(&claim, &[leaf(2, vec![page.form(n(8) * small(&s, &t))])]);
}

fn identities() -> Vec<Forged> {
    let [a, b, u, l] = ["a", "b", "u", "λ"].map(x);
    let sum = positive("f", &a + &b).assuming(&[above_zero(&a), above_zero(&b)]);
    let product = non_negative("f", &u).assuming(&[not_below_zero(&l), not_below_zero(&l * &u)]);
    let [of_sum, of_product] = [&sum, &product].map(Page::of);
    let row = |flaw, claim: &Statement, step, refusal| {
        forged(flaw, claim, [assume(2), vec![step]].concat(), refusal)
    };
    let whole = || &a + &b;
    let (identity, strict) = (Refusal::Identity, Refusal::NotStrict);
    vec![
        row("another coefficient on the right", &sum, of_sum.show(whole(), &[], 1, &a + n(2) * &b), identity),
        row("a term too little on the right", &sum, of_sum.show(whole(), &[], 1, &a), identity),
        row("another left side", &sum, of_sum.show(whole(), &[], 2, whole()), identity),
        row("a left side that is 0", &sum, of_sum.show(whole(), &[], 0, 0), strict),
        row("a left side that may be 0", &product, of_product.show(&u, &[2], &l, x("z₁")), strict),
        row("a fact about another quantity", &sum, of_sum.form(&a), Refusal::Goal),
        row("a fact that does not exist", &sum, of_sum.show(whole(), &[3], 1, x("z₁")), Refusal::Unknown),
        row("a fact that is not listed", &sum, of_sum.show(whole(), &[], 1, x("z₁")), Refusal::Unknown),
        row("a polynomial of facts", &sum, of_sum.show(x("z₁"), &[1], 1, x("z₁")), Refusal::Identity),
        row("a square of facts", &sum, Step::Square(of_sum.poly(x("z₁"))), Refusal::Unknown),
    ]
}

fn signs_of_terms() -> Vec<Forged> {
    let [a, b, u, t] = ["a", "b", "u", "t₁"].map(x);
    let row = |flaw, of: &Tree, right: &Tree, given: &[Hypothesis], refusal| {
        let claim = positive("f", of).assuming(given);
        let step = Page::of(&claim).form(right);
        forged(flaw, &claim, [assume(given.len()), vec![step]].concat(), refusal)
    };
    let signs = [above_zero(&a), above_zero(&b)];
    let unit = Hypothesis::between(&u, -1, 1);
    let of_units = |flaw, of: &dyn Fn(&Tree) -> Tree| {
        row(flaw, &of(&u), &of(&t), std::slice::from_ref(&unit), Refusal::Form)
    };
    let odd = positive("f", &a * &a * &a).assuming(&[above_zero(-&a)]);
    let z = x("z₁");
    let of_negative = Page::of(&odd).show(&a * &a * &a, &[1], 1, -(&z * &z * &z));
    vec![
        row("terms of two signs", &(&a - &b), &(&a - &b), &signs, Refusal::Form),
        row("a free symbol", &u, &u, &[], Refusal::Form),
        row("a square that may be 0", &(&u * &u), &(&u * &u), &[], Refusal::Goal),
        row("a weak sign", &a, &a, &[not_below_zero(&a)], Refusal::Goal),
        forged("an odd power of a negative number", &odd, vec![Step::Assume(0), of_negative], Refusal::Goal),
        row("a symbol that is no unit", &(n(2) + &u), &(n(2) + &u), &[], Refusal::Form),
        of_units("a factor larger than the other term", &|u| n(1) + n(2) * u),
        of_units("a square of the other sign", &|u| n(1) - n(2) * u * u),
        of_units("several factors that add up", &|u| n(2) + u + u * u * u + n(2) * u),
        of_units("a coefficient without a sign", &|u| x("b") * (n(2) + u)),
    ]
}

fn large_numbers() -> Vec<Forged> {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let claim = positive("f", n(2) * &a).assuming(&[above_zero(&a), above_zero(&b)]);
    let page = Page::of(&claim);
    let row = |flaw, step: Step| forged(flaw, &claim, vec![Step::Assume(0), step], Refusal::TooLarge);
    let by = |known: Vec<usize>, left: Polynomial, right: Polynomial| {
        Step::Show(page.poly(n(2) * &a), Certificate { known, left, right })
    };
    let power = |k: u32| {
        (0..k).fold(Polynomial::constant(1), |power, _| {
            power.times(&page.poly(&a), &Effort::default()).unwrap()
        })
    };
    let [half, most] = [i128::MAX / 2 + 1, i128::MAX].map(Polynomial::constant);
    // The square of a sum of 18 · 2⁷ products of powers.
    let long = (0..=u8::MAX / 2).flat_map(|k| (0..18).map(move |m| (k, m)));
    let of_powers = |(k, m): (u8, u8)| {
        let mut powers = [0; MAX_VARIABLES];
        (powers[0], powers[1]) = (k, m);
        (powers, 1)
    };
    let long = Polynomial::new(long.map(of_powers).collect()).unwrap();
    let unit = positive("f", &u).assuming(&[Hypothesis::between(&u, -1, 1)]);
    let of_unit = Page::of(&unit);
    let least = Polynomial::constant(i128::MIN).times(&of_unit.poly(x("t₁")), &Effort::default()).unwrap();
    let least = Certificate { known: vec![], left: Polynomial::constant(1), right: least };
    let least = vec![Step::Assume(0), Step::Show(of_unit.poly(x("t₁")), least)];
    vec![
        row("a product of numbers", by(vec![], most.clone(), page.poly(&a))),
        row("a product of large numbers", by(vec![], half, page.poly(&a))),
        row("a power", by(vec![], power(255), power(255))),
        row("a power of a quantity", Step::Square(power(200))),
        row("too many terms", Step::Square(long)),
        row("too many facts", by(vec![1; MAX_VARIABLES], page.poly(1), page.poly(1))),
        forged("an absolute value", &unit, least, Refusal::TooLarge),
    ]
}

#[test]
fn forged_certificates_are_refused() {
    refuse(identities());
    refuse(signs_of_terms());
    refuse(large_numbers());
}

/// Sums of coefficients are checked like products.
#[test]
fn sums_do_not_wrap() {
    let most = Polynomial::constant(i128::MAX);
    assert_eq!(most.plus_multiple(1, &Polynomial::constant(1), &Effort::default()), Err(Refusal::TooLarge));
    assert_eq!(most.plus_multiple(2, &most, &Effort::default()), Err(Refusal::TooLarge));
    assert_eq!(Polynomial::new(vec![([0; MAX_VARIABLES], i128::MIN); 2]), Err(Refusal::TooLarge));
    assert_eq!(most.plus_multiple(-1, &most, &Effort::default()), Ok(Polynomial::constant(0)));
    assert_eq!(Polynomial::variable(MAX_VARIABLES), Err(Refusal::TooLarge));
}

/// Each of 1600 steps expands the fourth power of a sum of 16 symbols twice, to show that 1 > 0.
#[test]
fn a_proof_of_excessive_effort_is_refused() {
    let names = ["a", "b", "c", "d", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "r"];
    let (sum, z) = (names.iter().fold(n(0), |sum, name| sum + x(name)), x("z₁"));
    let claim = non_negative("square", &sum * &sum);
    let page = Page::of(&claim);
    let square = Step::Square(page.poly(&sum));
    let power = n(1) + &z * &z;
    let often = |count| {
        let again = vec![page.show(1, &[1], &power, &power); count];
        vec![square.clone(), page.show(&sum * &sum, &[1], 1, &z)].into_iter().chain(again).collect::<Vec<_>>()
    };
    accept(&claim, &[leaf(0, often(40))]);
    refuse(vec![forged("a proof that takes too long", &claim, often(1600), Refusal::TooLarge)]);
}

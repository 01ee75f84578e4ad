//! Certificates for signs.

use super::*;

/// 4 (u² + 2 u + 2) = (2 u + 2)² + 4.
#[test]
fn a_square_is_not_negative() {
    let u = x("u");
    let claim = positive("square", &u * &u + n(2) * &u + n(2));
    let page = Page::of(&claim);
    let root = Known::Value(page.poly(n(2) * &u + n(2)));
    accept(&claim, &proof(&[], vec![page.with(vec![root], 4, x("z₁") * x("z₁") + n(4))]));
}

/// a² − b² = (a + b)(a − b), of which the second factor is a hypothesis.
#[test]
fn hypotheses_and_lemmas_are_factors() {
    let [a, b] = ["a", "b"].map(x);
    let given = [above_zero(&b), above_zero(&a - &b)];
    let claim = positive("product", &a * &a - &b * &b).assuming(&given);
    let page = Page::of(&claim);
    let sum = page.certificate(vec![Known::Fact(2)], 1, x("z₁") + n(2) * &b);
    let known = vec![page.lemma(&a + &b, sum), Known::Fact(2)];
    accept(&claim, &proof(&[0, 1], vec![page.with(known, 1, x("z₁") * x("z₂"))]));
}

/// 4 − 2 u − v² u ≥ 4 − 2 − 1 for −1 ≤ u, v ≤ 1.
#[test]
fn factors_between_minus_1_and_1_do_not_increase_terms() {
    let [u, v] = ["u", "v"].map(x);
    let given = [Hypothesis::between(&u, -1, 1), Hypothesis::between(&v, -1, 1)];
    let claim = positive("small", n(4) - n(2) * &u - &v * &v * &u).assuming(&given);
    let page = Page::of(&claim);
    let [s, t] = ["t₁", "t₂"].map(x);
    // The denominator is 2⁴: half the length of each interval is 2/2.
    let two = || n(2);
    let scaled = two() * two() * two() * two() * (n(4) - two() * &s - &t * &t * &s);
    let found = check(&claim, &proof(&[0, 1], vec![page.form(&scaled)]));
    let half = two() * two() * two() * (n(4) - two() * &s - &t * &t * &s);
    let other = check(&claim, &proof(&[0, 1], vec![page.form(&half)]));
    assert!(found.is_ok() || other.is_ok(), "{found:?} {other:?}");
}

fn identities() -> Vec<Forged> {
    let [a, b, u, l] = ["a", "b", "u", "λ"].map(x);
    let sum = positive("f", &a + &b).assuming(&[above_zero(&a), above_zero(&b)]);
    let of_sum = Page::of(&sum);
    let product = non_negative("f", &u).assuming(&[not_below_zero(&l), not_below_zero(&l * &u)]);
    let of_product = Page::of(&product);
    let anything = non_negative("f", &u);
    let of_anything = Page::of(&anything);
    let row = |flaw, statement: &Statement, hypotheses: &[usize], reason, refusal| {
        (flaw, statement.clone(), proof(hypotheses, vec![reason]), refusal)
    };
    let (identity, strict) = (Refusal::Identity, Refusal::NotStrict);
    vec![
        row("another coefficient on the right", &sum, &[0, 1], of_sum.form(&a + n(2) * &b), identity),
        row("a term too little on the right", &sum, &[0, 1], of_sum.form(a.clone()), identity),
        row("another left side", &sum, &[0, 1], of_sum.with(vec![], 2, &a + &b), identity),
        row("another symbol", &anything, &[], of_anything.form(1), identity),
        row("a left side that is 0", &anything, &[], of_anything.with(vec![], 0, 0), strict),
        row(
            "a left side that may be 0",
            &product,
            &[0, 1],
            of_product.with(vec![Known::Fact(2)], l, x("z₁")),
            strict,
        ),
        row("a fact about another quantity", &sum, &[0, 1], Reason::Fact(1), identity),
        row("a fact that does not exist", &sum, &[0, 1], Reason::Fact(3), Refusal::Unknown),
    ]
}

fn signs_of_terms() -> Vec<Forged> {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let unit = Hypothesis::between(&u, -1, 1);
    let row = |flaw, of: &Tree, right: &Tree, given: &[Hypothesis], refusal| {
        let claim = positive("f", of).assuming(given);
        let reason = Page::of(&claim).form(right);
        let used: Vec<_> = (0..given.len()).collect();
        (flaw, claim, proof(&used, vec![reason]), refusal)
    };
    let signs = [above_zero(&a), above_zero(&b)];
    let weak = [not_below_zero(&a)];
    let t = x("t₁");
    // u is 2 t/2.
    let of_units = |flaw, of: &dyn Fn(&Tree) -> Tree, scale: i32| {
        row(flaw, &of(&u), &(n(scale) * of(&t)), std::slice::from_ref(&unit), Refusal::Form)
    };
    let odd = positive("f", &a * &a * &a).assuming(&[above_zero(-&a)]);
    let z = x("z₁");
    let of_negative = Page::of(&odd).with(vec![Known::Fact(1)], 1, -(&z * &z * &z));
    vec![
        row("terms of two signs", &(&a - &b), &(&a - &b), &signs, Refusal::Form),
        row("a free symbol", &u, &u, &[], Refusal::Form),
        row("a square that may be 0", &(&u * &u), &(&u * &u), &[], Refusal::Goal),
        row("a weak sign", &a, &a, &weak, Refusal::Goal),
        ("an odd power of a negative number", odd, proof(&[0], vec![of_negative]), Refusal::Goal),
        row("a symbol that is no unit", &(n(2) + &u), &(n(2) + &u), &[], Refusal::Form),
        of_units("a factor larger than the other term", &|u| n(1) + n(2) * u, 2),
        of_units("a square of the other sign", &|u| n(1) - n(2) * u * u, 4),
        of_units("several factors that add up", &|u| n(2) + u + u * u * u + n(2) * u, 8),
        of_units("a coefficient without a sign", &|u| x("b") * (n(2) + u), 2),
    ]
}

fn quantities() -> Vec<Forged> {
    let [a, b] = ["a", "b"].map(x);
    let claim = positive("f", &a - &b).assuming(&[above_zero(&a), above_zero(&b)]);
    let page = Page::of(&claim);
    let one = || page.certificate(vec![], 1, 1);
    let value = |of: Tree| Known::Value(page.poly(of));
    let row = |flaw, known: Vec<Known>, right: &'static str, refusal| {
        (flaw, claim.clone(), proof(&[0, 1], vec![page.with(known, 1, x(right))]), refusal)
    };
    let of_unknown = page.certificate(vec![value(n(1))], 1, x("z₁"));
    let deep = (0..=MAX_NESTING).fold(page.certificate(vec![], 1, &a), |of, _| {
        page.certificate(vec![page.lemma(&a, of)], 1, x("z₁"))
    });
    let (form, unknown, large) = (Refusal::Form, Refusal::Unknown, Refusal::TooLarge);
    vec![
        row("a quantity without a sign", vec![value(&a - &b)], "z₁", form),
        row("a fact that does not exist", vec![Known::Fact(3)], "z₁", unknown),
        row("a lemma with a wrong identity", vec![page.lemma(&a - &b, one())], "z₁", Refusal::Identity),
        row(
            "a lemma without a sign",
            vec![page.lemma(&a - &b, page.certificate(vec![], 1, &a - &b))],
            "z₁",
            form,
        ),
        row(
            "a lemma whose left side may be 0",
            vec![page.lemma(&a - &b, page.certificate(vec![], 0, 0))],
            "z₁",
            Refusal::NotStrict,
        ),
        row("a lemma about a quantity", vec![page.lemma(x("z₁"), of_unknown)], "z₁", unknown),
        row("a quantity of quantities", vec![value(x("z₂")), value(x("z₁"))], "z₁", form),
        row("a square of quantities", vec![value(x("z₂") - x("z₁"))], "z₁", form),
        row("a quantity that is not listed", vec![], "z₁", unknown),
        row("lemmas inside each other", vec![page.lemma(&a, deep)], "z₁", large),
        row("too many quantities", vec![Known::Fact(1); MAX_VARIABLES], "a", large),
    ]
}

/// Its value would be z₁, a variable of the form.
fn self_reference() -> Vec<Forged> {
    let u = x("u");
    let claim = non_negative("f", &u);
    let page = Page::of(&claim);
    let square = |of: Tree| vec![page.with(vec![Known::Value(page.poly(of))], 1, x("z₁") * x("z₁"))];
    vec![("a quantity that is itself", claim.clone(), proof(&[], square(x("z₁"))), Refusal::Unknown)]
}

fn large_numbers() -> Vec<Forged> {
    let [a, b, u] = ["a", "b", "u"].map(x);
    let claim = positive("f", n(2) * &a).assuming(&[above_zero(&a), above_zero(&b)]);
    let page = Page::of(&claim);
    let row = |flaw, known: Vec<Known>, left: Polynomial, right: Polynomial| {
        let reason = Reason::Certificate(Certificate { known, left, right });
        (flaw, claim.clone(), proof(&[0], vec![reason]), Refusal::TooLarge)
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
    let least =
        Polynomial::constant(i128::MIN).times(&Page::of(&unit).poly(x("t₁")), &Effort::default()).unwrap();
    let least = Certificate { known: vec![], left: Polynomial::constant(1), right: least };
    vec![
        row("a product of numbers", vec![], most.clone(), page.poly(&a)),
        row("a product of large numbers", vec![], half, page.poly(&a)),
        row("a power", vec![], power(255), power(255)),
        row(
            "a power of a quantity",
            vec![Known::Value(power(200))],
            page.poly(1),
            page.poly(x("z₁") * x("z₁")),
        ),
        row("too many terms", vec![Known::Value(long)], page.poly(1), page.poly(x("z₁") * x("z₁") * &a)),
        ("an absolute value", unit, proof(&[0], vec![Reason::Certificate(least)]), Refusal::TooLarge),
    ]
}

#[test]
fn forged_certificates_are_refused() {
    refuse(identities());
    refuse(signs_of_terms());
    refuse(self_reference());
    refuse(large_numbers());
}

#[test]
fn forged_quantities_are_refused() {
    let (of_quantities, others): (Vec<_>, Vec<_>) =
        quantities().into_iter().partition(|(flaw, ..)| flaw.contains("of quantities"));
    refuse(others);
    // Either a quantity without a sign or one of other quantities is a reason.
    refuse(of_quantities.into_iter().map(|(flaw, s, p, _)| (flaw, s, p, Refusal::Unknown)).collect());
}

/// Sums of coefficients are checked like products.
#[test]
fn sums_do_not_wrap() {
    let most = Polynomial::constant(i128::MAX);
    assert_eq!(most.plus_multiple(1, &Polynomial::constant(1), &Effort::default()), Err(Refusal::TooLarge));
    assert_eq!(most.plus_multiple(2, &most, &Effort::default()), Err(Refusal::TooLarge));
    assert_eq!(Polynomial::new(vec![([0; MAX_VARIABLES], i128::MIN); 2]), Err(Refusal::TooLarge));
    assert_eq!(most.plus_multiple(-1, &most, &Effort::default()), Ok(Polynomial::zero()));
    assert_eq!(Polynomial::variable(MAX_VARIABLES), Err(Refusal::TooLarge));
}

/// Each of 1600 lemmas expands the fourth power of a sum of 16 symbols twice, to show that 1 > 0.
#[test]
fn a_proof_of_excessive_effort_is_refused() {
    let names = ["a", "b", "c", "d", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "r"];
    let (sum, z) = (names.iter().fold(n(0), |sum, name| sum + x(name)), x("z₁"));
    let claim = non_negative("square", &sum * &sum);
    let page = Page::of(&claim);
    let value = || Known::Value(page.poly(&sum));
    let power = n(1) + &z * &z * &z * &z;
    let once = || page.lemma(1, page.certificate(vec![value()], &power, &power));
    let often = || page.lemma(1, page.certificate((0..40).map(|_| once()).collect(), 1, 1));
    let by = |lemmas: Vec<Known>| proof(&[], vec![page.with([vec![value()], lemmas].concat(), 1, &z * &z)]);
    accept(&claim, &by(vec![often()]));
    let all = by((0..40).map(|_| often()).collect());
    refuse(vec![("a proof that takes too long", claim.clone(), all, Refusal::TooLarge)]);
}

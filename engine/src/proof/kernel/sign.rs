//! The sign of a polynomial for all values of its symbols, with a certificate.
//!
//! Six rules, each sound by itself, short certificates before long ones; together they are not complete:
//!
//! 1. **Terms.** Every term has the same sign: a symbol known to be positive (or not negative) keeps it, a
//!    free symbol does in an even power, and e^… is positive. Strict if one term is nowhere zero.
//! 2. **Factor.** A product of powers common to all terms has a sign, and so has what is left; e^… can be
//!    taken out of anything; and factors of divisors, whose signs are found by themselves.
//! 3. **Square.** For a x² + b x + d with a ≠ 0: 4a(a x² + b x + d) = (2a x + b)² + (4a d − b²), so the
//!    sign is a's if 4a d − b² is not negative.
//! 4. **Slope.** By the mean value theorem, a function f that is continuous for x ≥ 0 and has a slope for
//!    x > 0 is f(0) + x f'(ξ) for some ξ > 0: its sign is that of such a sum. Only tried where there is
//!    an e^….
//! 5. **Sizes.** Factors between −1 and 1 make a term no larger than it is without them. So the polynomial is
//!    no less than what is left when each term with such factors is replaced by minus its size, and no more
//!    than with plus its size.
//! 6. **Ends.** A polynomial of degree n in a symbol x between −1 and 1 is a sum of products aⁱ (1 − a)ⁿ⁻ⁱ
//!    with a = (1 + x)/2, none of them negative and not all 0, so it has a sign that all their coefficients
//!    have (Bernstein's form); those of degree one are its values at the ends. Where there are such symbols,
//!    this rule, the fifth, the first and factors of divisors are all that is tried.

mod small;

pub use small::{ERRORS, PLACES, is_small};

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use small::{ENDS, ends, sizes};
use std::collections::BTreeMap;

/// The sign of a value that may depend on symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// < 0
    Negative,
    /// ≤ 0
    NonPositive,
    /// = 0
    Zero,
    /// ≥ 0
    NonNegative,
    /// > 0
    Positive,
}

use Sign::{Negative, NonNegative, NonPositive, Positive, Zero};

/// What is known of the symbols. One that is not listed is free: any real number.
pub type Known = BTreeMap<Symbol, Sign>;

impl Sign {
    /// Never zero.
    pub fn is_strict(self) -> bool {
        matches!(self, Positive | Negative)
    }

    /// The sign of −x.
    pub fn negated(self) -> Self {
        match self {
            Negative => Positive,
            NonPositive => NonNegative,
            Zero => Zero,
            NonNegative => NonPositive,
            Positive => Negative,
        }
    }

    /// The sign of x y.
    pub fn times(self, other: Self) -> Self {
        match (self, other) {
            (Zero, _) | (_, Zero) => Zero,
            (Positive, sign) | (sign, Positive) => sign,
            (Negative, sign) | (sign, Negative) => sign.negated(),
            (NonNegative, NonNegative) | (NonPositive, NonPositive) => NonNegative,
            (NonNegative, NonPositive) | (NonPositive, NonNegative) => NonPositive,
        }
    }

    /// The sign of x + y, if theirs decide it.
    pub fn plus(self, other: Self) -> Option<Self> {
        match (self, other) {
            (Zero, sign) | (sign, Zero) => Some(sign),
            (Positive, Positive | NonNegative) | (NonNegative, Positive) => Some(Positive),
            (Negative, Negative | NonPositive) | (NonPositive, Negative) => Some(Negative),
            (NonNegative, NonNegative) => Some(NonNegative),
            (NonPositive, NonPositive) => Some(NonPositive),
            (Positive | NonNegative, Negative | NonPositive)
            | (Negative | NonPositive, Positive | NonNegative) => None,
        }
    }

    /// Is whatever has this sign also of the other?
    pub fn implies(self, other: Self) -> bool {
        self == other
            || matches!((self, other), (Positive | Zero, NonNegative) | (Negative | Zero, NonPositive))
    }
}

/// Why a polynomial has its sign. Only [`sign`] makes one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    of: Poly,
    sign: Sign,
    rule: Rule,
}

/// The rules, with what they rest on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Rule 1.
    Terms,
    /// Rule 2: a factor, and what is left.
    Factor(Box<Certificate>, Box<Certificate>),
    /// Rule 3.
    Square {
        /// The sign of a.
        leading: Box<Certificate>,
        /// 2a x + b
        root: Poly,
        /// The sign of 4a d − b².
        rest: Box<Certificate>,
    },
    /// Rule 5, with the sign of what is left: it is no less than that, or no more.
    Sizes(Box<Certificate>),
    /// Rule 6.
    Ends {
        /// The symbol.
        x: Symbol,
        /// The signs of the sums, from that at −1 to that at 1.
        at: Box<[Certificate]>,
    },
    /// Rule 4.
    Slope {
        /// The symbol.
        x: Symbol,
        /// The sign at 0.
        start: Box<Certificate>,
        /// The sign of the derivative's numerator.
        slope: Box<Certificate>,
    },
}

impl Certificate {
    /// The polynomial.
    pub fn of(&self) -> &Poly {
        &self.of
    }

    /// Its sign.
    pub fn sign(&self) -> Sign {
        self.sign
    }

    /// By which rule.
    pub fn rule(&self) -> &Rule {
        &self.rule
    }
}

/// How deep certificates may rest on others.
const DEPTH: u32 = 3;

/// Nor is rule 4 tried on more terms than this: derivatives only grow.
const TERMS: usize = 12;

/// The sign of a polynomial, by rule 2 also with factors whose signs have been found before.
pub fn sign_of_product(of: &Poly, factors: &[Certificate], known: &Known) -> Option<Certificate> {
    sign(of, known).or_else(|| {
        let factor = |factor: &Certificate| {
            let rest = of.over(&factor.of).filter(|_| factor.of.terms().len() > 1)?;
            Some(product(of, factor.clone(), sign_of_product(&rest, factors, known)?))
        };
        factors.iter().find_map(factor)
    })
}

/// The sign of a polynomial, if the rules find one.
pub fn sign(of: &Poly, known: &Known) -> Option<Certificate> {
    let small: Vec<_> = of.symbols().into_iter().filter(|x| is_small(*x)).collect();
    if !small.is_empty() {
        return terms(of, known)
            .or_else(|| sizes(of, &small, known))
            .or_else(|| ends(of, &small, known, ENDS));
    }
    // A short certificate before a long one.
    (0..=DEPTH).find_map(|depth| within(of, known, depth))
}

fn within(of: &Poly, known: &Known, depth: u32) -> Option<Certificate> {
    if let Some(certificate) = terms(of, known) {
        return Some(certificate);
    }
    let depth = depth.checked_sub(1)?;
    factor(of, known, depth)
        .or_else(|| square(of, known, depth))
        .or_else(|| slope(of, known, depth))
        .or_else(|| exponential_factor(of, known, depth))
}

/// Rule 1.
fn terms(of: &Poly, known: &Known) -> Option<Certificate> {
    let sign = of.terms().try_fold(Zero, |sum, (monomial, coefficient)| {
        let number = if coefficient.sign().is_lt() { Negative } else { Positive };
        sum.plus(number.times(of_monomial(monomial, known)?))
    });
    Some(Certificate { of: of.clone(), sign: sign?, rule: Rule::Terms })
}

fn of_monomial(monomial: &Monomial, known: &Known) -> Option<Sign> {
    let power = |(x, n): (Symbol, u32)| match known.get(&x) {
        Some(sign) if n % 2 == 1 => Some(*sign),
        Some(sign) => Some(sign.times(*sign)),
        None if n % 2 == 0 => Some(NonNegative),
        None => None,
    };
    monomial.powers().try_fold(Positive, |product, x| Some(product.times(power(x)?)))
}

/// Rule 2, with a product of powers.
fn factor(of: &Poly, known: &Known, depth: u32) -> Option<Certificate> {
    let common = of.common_monomial();
    if common == Monomial::one() {
        return None;
    }
    let factor = Poly::from(common);
    let rest = within(&of.over(&factor)?, known, depth)?;
    Some(product(of, terms(&factor, known)?, rest))
}

/// Rule 2, with an e^…, where rule 4 decides what is left.
fn exponential_factor(of: &Poly, known: &Known, depth: u32) -> Option<Certificate> {
    of.exponents().find_map(|exponent| {
        let rest = of * Poly::exponential(-exponent);
        let factor = terms(&Poly::exponential(exponent.clone()), known)?;
        Some(product(of, factor, slope(&rest, known, depth)?))
    })
}

fn product(of: &Poly, factor: Certificate, rest: Certificate) -> Certificate {
    let sign = factor.sign.times(rest.sign);
    Certificate { of: of.clone(), sign, rule: Rule::Factor(factor.into(), rest.into()) }
}

/// Rule 3.
fn square(of: &Poly, known: &Known, depth: u32) -> Option<Certificate> {
    of.symbols().into_iter().find_map(|x| {
        let [d, b, a] = of.coefficients(x)?;
        if of.exponents().any(|e| e.symbols().contains(&x)) {
            return None;
        }
        let leading = within(&a, known, depth).filter(|a| a.sign.is_strict())?;
        let rest = within(&(Poly::constant(4) * &a * d - &b * &b), known, depth)?;
        let sign = leading.sign.times(NonNegative.plus(rest.sign)?);
        let root = Poly::constant(2) * a * Poly::symbol(x) + b;
        let rule = Rule::Square { leading: leading.into(), root, rest: rest.into() };
        Some(Certificate { of: of.clone(), sign, rule })
    })
}

/// Rule 4.
fn slope(of: &Poly, known: &Known, depth: u32) -> Option<Certificate> {
    if !of.has_exponentials() || of.terms().len() > TERMS {
        return None;
    }
    let symbols = of.symbols();
    known.iter().filter(|(x, _)| symbols.contains(x)).find_map(|(&x, &at_x)| {
        let with = |sign| known.iter().map(|(y, s)| (*y, if *y == x { sign } else { *s })).collect();
        if !at_x.implies(NonNegative) || !is_continuous(of, &with(NonNegative)) {
            return None;
        }
        let start = of.replace(&Monomial::of(x), &Ratio::zero());
        let start = within(&numerator(&start, known)?, known, depth)?;
        let inside = with(Positive);
        let slope = within(&numerator(&of.derivative(x), &inside)?, &inside, depth)?;
        let sign = start.sign.plus(at_x.times(slope.sign))?;
        let rule = Rule::Slope { x, start: start.into(), slope: slope.into() };
        Some(Certificate { of: of.clone(), sign, rule })
    })
}

/// Do exponents have a value wherever this is known? They do if they are quotients of polynomials and no
/// denominator vanishes.
fn is_continuous(of: &Poly, known: &Known) -> bool {
    of.exponents().all(|exponent| exponent.is_of_polynomials() && numerator(exponent, known).is_some())
}

/// A polynomial with the sign of the quotient, if that of its denominator is known.
fn numerator(of: &Ratio, known: &Known) -> Option<Poly> {
    match terms(of.den(), known)?.sign {
        Positive => Some(of.num().clone()),
        Negative => Some(-of.num()),
        NonNegative | NonPositive | Zero => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn x(name: &'static str) -> Poly {
        Poly::symbol(Symbol(name))
    }

    fn n(n: i32) -> Poly {
        Poly::constant(n)
    }

    fn e(exponent: impl Into<Ratio>) -> Poly {
        Poly::exponential(exponent.into())
    }

    fn over(a: Poly, b: Poly) -> Ratio {
        Ratio::from(a).over(&b.into()).unwrap()
    }

    fn found(of: Poly) -> Option<Sign> {
        let known = [("a", Positive), ("b", Positive), ("z", NonNegative), ("n", Negative)];
        sign(&of, &known.map(|(name, sign)| (Symbol(name), sign)).into()).map(|c| c.sign)
    }

    #[test]
    fn signs_of_sums_and_products_are_those_of_numbers() {
        const SIGNS: [Sign; 5] = [Negative, NonPositive, Zero, NonNegative, Positive];
        // −1, 0 and 1 stand for all numbers: a sum of two is of any size if their signs differ.
        let has = |sign: Sign, x: i32| match sign {
            Negative => x < 0,
            NonPositive => x <= 0,
            Zero => x == 0,
            NonNegative => x >= 0,
            Positive => x > 0,
        };
        let all = |values: &[i32], sign: Sign| values.iter().all(|x| has(sign, *x));
        let strongest = |values: Vec<i32>| {
            let [strict, weak] = [[Negative, Zero, Positive].as_slice(), &[NonPositive, NonNegative]];
            strict.iter().chain(weak).copied().find(|sign| all(&values, *sign))
        };
        for (s, t) in SIGNS.iter().flat_map(|s| SIGNS.map(|t| (*s, t))) {
            let of = |sign| (-1..=1).filter(move |x| has(sign, *x));
            let pairs: Vec<_> = of(s).flat_map(|x| of(t).map(move |y| (x, y))).collect();
            assert_eq!(
                Some(s.times(t)),
                strongest(pairs.iter().map(|(x, y)| x * y).collect()),
                "{s:?} {t:?}"
            );
            let sums = pairs.iter().flat_map(|(x, y)| [x + y, 2 * x + y, x + 2 * y]);
            assert_eq!(s.plus(t), strongest(sums.collect()), "{s:?} {t:?}");
            assert_eq!(s.implies(t), of(s).all(|x| has(t, x)), "{s:?} {t:?}");
        }
        assert!(SIGNS.iter().all(|s| s.is_strict() != has(*s, 0) && s.negated() == s.times(Negative)));
    }

    #[test]
    fn terms_of_one_sign() {
        assert_eq!(found(x("a") + x("z")), Some(Positive));
        assert_eq!(found(x("z") + x("u") * x("u")), Some(NonNegative));
        assert_eq!(found(-(x("a") * x("b"))), Some(Negative));
        assert_eq!(found(Poly::zero()), Some(Zero));
        assert_eq!(found(n(-2)), Some(Negative));
        assert_eq!(found(x("n") * x("n")), Some(Positive));
        assert_eq!(found(x("n") * x("n") * x("n")), Some(Negative));
        // An odd power of a free symbol, a difference: nothing is known.
        assert_eq!(found(x("u")), None);
        assert_eq!(found(x("a") - x("b")), None);
    }

    #[test]
    fn a_common_factor() {
        // a(u² + 1) is rule 1; a u² − 2 a u + 2 a needs the factor, then the square.
        let square = x("u") * x("u") - n(2) * x("u") + n(2);
        assert_eq!(found(x("a") * &square), Some(Positive));
        assert_eq!(found(x("z") * &square), Some(NonNegative));
        assert_eq!(found(x("u") * &square), None);
    }

    #[test]
    fn squares_that_miss_zero_touch_it_or_cross_it() {
        let quadratic = |d: i32| x("u") * x("u") + n(2) * x("u") + n(d);
        assert_eq!(found(quadratic(2)), Some(Positive));
        assert_eq!(found(quadratic(1)), Some(NonNegative));
        assert_eq!(found(quadratic(0)), None);
        assert_eq!(found(-quadratic(1)), Some(NonPositive));
        // A leading coefficient that may vanish proves nothing.
        assert_eq!(found(x("z") * x("u") * x("u") + x("u") + n(1)), None);
    }

    #[test]
    fn small_factors_make_no_term_larger() {
        assert_eq!(found(n(3) + x("e₁") + x("t₁")), Some(Positive));
        assert_eq!(found(n(1) + x("e₁") * x("e₂")), Some(NonNegative));
        assert_eq!(found(x("e₁") - n(1)), Some(NonPositive));
        assert_eq!(found(x("u") * x("u") * (n(2) + x("e₁"))), Some(NonNegative));
        assert_eq!(found(x("a") * x("e₁") - n(2) * x("a") - x("b")), Some(Negative));
        // It takes as much of the same, and a sign.
        assert_eq!(found(x("a") + x("b") * x("e₁")), None);
        assert_eq!(found(n(3) + n(2) * x("e₁") + n(2) * x("e₂")), None);
        assert_eq!(found(x("u") * (n(2) + x("e₁"))), None);
        assert_eq!(found(x("e₁")), None);
        // No other name is between −1 and 1.
        assert_eq!(found(n(3) + x("e")), None);
    }

    #[test]
    fn what_is_linear_lies_between_its_ends() {
        // Its terms alone do not show it: with the sizes of all it is 1 − 2.
        let product = || (n(1) + x("e₁")) * (n(2) + x("e₂"));
        assert_eq!(found(product()), Some(NonNegative));
        assert_eq!(found(-product()), Some(NonPositive));
        assert_eq!(found(x("a") * product() + x("b")), Some(Positive));
        assert_eq!(found(product() - x("a")), None);
        // Not of a square, and not where it is in an exponent as well.
        assert_eq!(found(x("e₁") * x("e₁") * n(4) - n(4) * x("e₁") + n(1)), None);
        assert_eq!(found(e(x("e₁")) - n(1) - x("e₁")), None);
    }

    #[test]
    fn an_exponential_against_its_tangent() {
        let tangent = || n(1) + x("a");
        assert_eq!(found(e(x("a")) - tangent()), Some(Positive));
        assert_eq!(found(tangent() - e(x("a"))), Some(Negative));
        // The other way round and from a wrong start it is not so.
        assert_eq!(found(e(x("a")) - n(1) - tangent()), None);
        assert_eq!(found(e(x("u")) - n(1) - x("u")), None);
        // Where x may be 0 it is only as strict as its start.
        assert_eq!(found(e(x("z")) - n(1) - x("z")), Some(NonNegative));
        // e^{e^{1/a}} has no value at a = 0 to begin with.
        let nested = over(x("a") * e(over(n(1), x("a"))), tangent());
        assert_eq!(found(e(-nested) - n(1)), None);
        // 1 + a − e^{a/(a+1)}: its slope takes two rounds.
        assert_eq!(found(tangent() - e(over(x("a"), tangent()))), Some(Positive));
    }

    #[test]
    fn long_sums_are_left_alone() {
        let known = Known::from([(Symbol("a"), Positive)]);
        let powers = |many: usize| {
            std::iter::successors(Some(x("a")), |power| Some(power * x("a")))
                .take(many)
                .fold(n(0), |a, b| a + b)
        };
        // e^a − 1 + a + a² + …: its slope is one of terms that are positive.
        let of = |terms: usize| e(x("a")) - n(1) + powers(terms - 2);
        let tried = [TERMS - 1, TERMS, TERMS + 1].map(|many| slope(&of(many), &known, 1).is_some());
        assert_eq!(tried, [true, true, false]);
        assert!(slope(&powers(3), &known, 1).is_none(), "where there is no e^…, other rules are as good");
        // (1 + e₁)(a + a² + …).
        let of = |terms: usize| (n(1) + x("e₁")) * powers(terms / 2);
        let many = [small::TERMS_AT_ENDS, small::TERMS_AT_ENDS + 2];
        let tried = many.map(|many| ends(&of(many), &[Symbol("e₁")], &known, 1).is_some());
        assert_eq!(tried, [true, false]);
    }
}

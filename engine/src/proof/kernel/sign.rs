//! Rules for the sign of a polynomial for all values of its symbols.
//!
//! A [`Certificate`] is made by one of six rules, each sound by itself. Which of them to try on what is
//! decided in `search.rs`, and not trusted.
//!
//! 1. **Terms.** Every term has the same sign: a symbol known to be positive (or not negative) keeps it, a
//!    free symbol does in an even power, and e^… is positive. Strict if one term is nowhere zero.
//! 2. **Factor.** The sign of a product is that of its factors.
//! 3. **Square.** If 4 a f = r² + d with a ≠ 0 and d is not negative, the sign of f is a's.
//! 4. **Slope.** By the mean value theorem, a function f that is continuous for x ≥ 0 and has a slope for
//!    x > 0 is f(0) + x f'(ξ) for some ξ > 0: its sign is that of such a sum.
//! 5. **Sizes.** Factors between −1 and 1 make a term no larger than it is without them, and their squares do
//!    not change its sign. So the polynomial is no less than what is left when each term with such factors is
//!    replaced by minus its size, or by 0 if they are squares and the term is not negative; and likewise no
//!    more.
//! 6. **Ends.** A polynomial of degree n in a symbol x between −1 and 1 is a sum of products aⁱ (1 − a)ⁿ⁻ⁱ
//!    with a = (1 + x)/2, none of them negative and not all 0, so it has a sign that all their coefficients
//!    have (Bernstein's form); those of degree one are its values at the ends.

use super::algebra::{Monomial, Number, Poly, Ratio, Symbol};
use std::collections::BTreeMap;
use std::sync::Arc;

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

/// The signs of symbols. A symbol that is not listed is free: any real number.
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

/// A proof that a polynomial has a sign, if symbols have the signs that are known.
#[derive(Clone, Debug)]
pub struct Certificate {
    known: Arc<Known>,
    of: Poly,
    sign: Sign,
    rule: Rule,
}

/// The rule of a certificate, with the certificates that it rests on.
#[derive(Clone, Debug)]
pub enum Rule {
    /// Rule 1.
    Terms,
    /// Rule 2: two factors.
    Factor(Box<Certificate>, Box<Certificate>),
    /// Rule 3.
    Square {
        /// The sign of a.
        leading: Box<Certificate>,
        /// r
        root: Poly,
        /// The sign of d.
        rest: Box<Certificate>,
    },
    /// Rule 4.
    Slope {
        /// x
        x: Symbol,
        /// The sign of f(0).
        start: Box<Certificate>,
        /// The sign of the numerator of f'.
        slope: Box<Certificate>,
    },
    /// Rule 5, with the sign of what is left.
    Sizes(Box<Certificate>),
    /// Rule 6.
    Ends {
        /// x
        x: Symbol,
        /// The signs of the coefficients, from that at −1 to that at 1.
        at: Box<[Certificate]>,
    },
}

/// A search for the sign of a polynomial; what it finds is used if it is about that polynomial and those
/// signs.
pub type Find<'f> = &'f dyn Fn(&Poly, &Arc<Known>) -> Option<Certificate>;

impl Certificate {
    /// Returns the polynomial.
    pub fn of(&self) -> &Poly {
        &self.of
    }

    /// Returns its sign.
    pub fn sign(&self) -> Sign {
        self.sign
    }

    /// Returns the rule that proves it.
    pub fn rule(&self) -> &Rule {
        &self.rule
    }

    /// Returns what is found, if it is a certificate for this polynomial under these signs.
    pub fn found(of: &Poly, known: &Arc<Known>, find: Find) -> Option<Self> {
        let certificate = find(of, known)?;
        (certificate.of == *of && certificate.is_under(known)).then_some(certificate)
    }

    fn is_under(&self, known: &Arc<Known>) -> bool {
        Arc::ptr_eq(&self.known, known) || self.known == *known
    }

    /// Rule 1.
    pub fn terms(of: &Poly, known: &Arc<Known>) -> Option<Self> {
        let sign = of.terms().try_fold(Zero, |sum, (monomial, coefficient)| {
            let number = if coefficient.sign().is_lt() { Negative } else { Positive };
            sum.plus(number.times(of_monomial(monomial, known)?))
        });
        Some(Certificate { known: known.clone(), of: of.clone(), sign: sign?, rule: Rule::Terms })
    }

    /// Rule 2.
    pub fn product(factor: Self, rest: Self) -> Option<Self> {
        let (known, sign) = (factor.known.clone(), factor.sign.times(rest.sign));
        let of = &factor.of * &rest.of;
        let agree = rest.is_under(&known);
        agree.then(|| Certificate { known, of, sign, rule: Rule::Factor(factor.into(), rest.into()) })
    }

    /// Rule 3, for f = a x² + b x + d: 4 a f = (2 a x + b)² + (4 a d − b²).
    pub fn square(of: &Poly, x: Symbol, known: &Arc<Known>, find: Find) -> Option<Self> {
        let [d, b, a] = of.coefficients(x)?;
        if of.exponents().any(|e| e.symbols().contains(&x)) {
            return None;
        }
        let leading = Certificate::found(&a, known, find).filter(|a| a.sign.is_strict())?;
        let rest = Certificate::found(&(Poly::constant(4) * &a * d - &b * &b), known, find)?;
        let sign = leading.sign.times(NonNegative.plus(rest.sign)?);
        let root = Poly::constant(2) * a * Poly::symbol(x) + b;
        let rule = Rule::Square { leading: leading.into(), root, rest: rest.into() };
        Some(Certificate { known: known.clone(), of: of.clone(), sign, rule })
    }

    /// Rule 4.
    pub fn slope(of: &Poly, x: Symbol, known: &Arc<Known>, find: Find) -> Option<Self> {
        let at_x = *known.get(&x)?;
        let with = |sign| {
            Arc::new(Known::from_iter(known.iter().map(|(y, s)| (*y, if *y == x { sign } else { *s }))))
        };
        if !at_x.implies(NonNegative) || !is_continuous(of, &with(NonNegative)) {
            return None;
        }
        let start = of.replace(&Monomial::of(x), &Ratio::zero());
        let start = Certificate::found(&numerator(&start, known)?, known, find)?;
        let inside = with(Positive);
        let slope = Certificate::found(&numerator(&of.derivative(x), &inside)?, &inside, find)?;
        let sign = start.sign.plus(at_x.times(slope.sign))?;
        let rule = Rule::Slope { x, start: start.into(), slope: slope.into() };
        Some(Certificate { known: known.clone(), of: of.clone(), sign, rule })
    }

    /// Rule 5.
    pub fn sizes(of: &Poly, known: &Arc<Known>) -> Option<Self> {
        let has_small = |m: &Monomial| m.powers().any(|(x, _)| x.is_small());
        let (with, whole): (Vec<_>, Vec<_>) = of.terms().partition(|(m, _)| has_small(m));
        let whole: Poly = whole.into_iter().map(|(m, q)| (m.clone(), q.clone())).collect();
        // The size of a term without its small factors, and the sign of the term if they are squares: what is
        // left of it has to be of a known sign.
        let size = |(m, q): (&Monomial, &Number)| {
            let rest = m.without_those(Symbol::is_small);
            let sign = of_monomial(&rest, known)?;
            let size = if sign.implies(NonPositive) { -q.abs() } else { q.abs() };
            let is_even = m.powers().all(|(x, n)| !x.is_small() || n % 2 == 0);
            let number = if q.sign().is_lt() { Negative } else { Positive };
            Some(((rest, size), is_even.then(|| number.times(sign))))
        };
        let with: Vec<_> = with.into_iter().map(size).collect::<Option<_>>()?;
        // The whole is `beyond` 0 with respect to what is left, so it is of its sign if both agree.
        let by = |beyond: Sign| {
            let is_beyond = |sign: &Option<Sign>| sign.is_some_and(|sign| sign.implies(beyond));
            let against = with.iter().filter(|(_, sign)| !is_beyond(sign));
            let sizes: Poly = against.map(|(size, _)| size.clone()).collect();
            let rest = if beyond == NonNegative { &whole - &sizes } else { &whole + &sizes };
            let rest = Certificate::terms(&rest, known)?;
            let sign = rest.sign.plus(beyond)?;
            Some(Certificate { known: known.clone(), of: of.clone(), sign, rule: Rule::Sizes(rest.into()) })
        };
        by(NonNegative).or_else(|| by(NonPositive))
    }

    /// Rule 6.
    pub fn ends(of: &Poly, x: Symbol, known: &Arc<Known>, find: Find) -> Option<Self> {
        if !x.is_small() || of.exponents().any(|e| e.symbols().contains(&x)) {
            return None;
        }
        let sign = |coefficient: Poly| Certificate::found(&coefficient, known, find);
        let at: Vec<_> = bernstein(of, x).into_iter().map(sign).collect::<Option<_>>()?;
        // Between numbers of one sign there is no other, and no zero if none is.
        let one = [Positive, Negative, NonNegative, NonPositive];
        let all = one.into_iter().find(|sign| at.iter().all(|own| own.sign.implies(*sign)))?;
        Some(Certificate {
            known: known.clone(),
            of: of.clone(),
            sign: all,
            rule: Rule::Ends { x, at: at.into() },
        })
    }
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

/// Returns `true` if exponents have a value wherever this is known: if they are quotients of polynomials and
/// no denominator vanishes.
fn is_continuous(of: &Poly, known: &Arc<Known>) -> bool {
    of.exponents().all(|exponent| exponent.is_of_polynomials() && numerator(exponent, known).is_some())
}

/// A polynomial with the sign of the quotient, if that of its denominator is known.
fn numerator(of: &Ratio, known: &Arc<Known>) -> Option<Poly> {
    match Certificate::terms(of.den(), known)?.sign {
        Positive => Some(of.num().clone()),
        Negative => Some(-of.num()),
        NonNegative | NonPositive | Zero => None,
    }
}

/// The sums bᵢ for which a polynomial of degree n in x is Σ bᵢ aⁱ (1 − a)ⁿ⁻ⁱ, where a = (1 + x)/2.
///
/// In it xᵏ = (a − (1 − a))ᵏ (a + (1 − a))ⁿ⁻ᵏ.
fn bernstein(of: &Poly, x: Symbol) -> Vec<Poly> {
    let degree = of.degree(x) as usize;
    let times = |factors: &[i32], by: i32| -> Vec<i32> {
        let shifted = [0].iter().chain(factors);
        factors.iter().chain(&[0]).zip(shifted).map(|(low, high)| by * low + high).collect()
    };
    // The factors of aⁱ (1 − a)ⁿ⁻ⁱ in xᵏ.
    let factors = |k: usize| {
        let minus = (0..k).fold(vec![1], |all, _| times(&all, -1));
        (k..degree).fold(minus, |all, _| times(&all, 1))
    };
    (0..=degree).fold(vec![Poly::zero(); degree + 1], |sums, k| {
        let coefficient = of.coefficient(x, k as u32);
        sums.iter().zip(factors(k)).map(|(sum, n)| sum + &coefficient * Poly::constant(n)).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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

    /// A certificate is one for its polynomial and for the signs that it was made under.
    #[test]
    fn a_certificate_for_something_else_is_not_taken() {
        let [a, u] = ["a", "u"].map(Symbol::Own);
        let poly = |x: Symbol| Poly::symbol(x) + Poly::constant(1);
        let positive = Arc::new(Known::from([(a, Positive), (u, Positive)]));
        let free = Arc::new(Known::new());
        let of_a = Certificate::terms(&poly(a), &positive).unwrap();
        let same = |_: &Poly, _: &Arc<Known>| Some(of_a.clone());
        assert!(Certificate::found(&poly(a), &positive, &same).is_some());
        // Equal signs are the same signs.
        assert!(Certificate::found(&poly(a), &Arc::new((*positive).clone()), &same).is_some());
        assert!(Certificate::found(&poly(u), &positive, &same).is_none());
        assert!(Certificate::found(&poly(a), &free, &same).is_none());
        let square = Certificate::terms(&Poly::constant(1), &free).unwrap();
        assert!(Certificate::product(of_a.clone(), square).is_none());
        // Nor does a rule take it: u² + 1 is no sum of a square and a.
        let quadratic = Poly::symbol(u) * Poly::symbol(u) + Poly::constant(1);
        assert!(Certificate::square(&quadratic, u, &positive, &same).is_none());
        assert!(Certificate::ends(&poly(Symbol::Error(0)), Symbol::Error(0), &positive, &same).is_none());
        assert!(
            Certificate::slope(&Poly::exponential(Poly::symbol(a).into()), a, &positive, &same).is_none()
        );
    }

    /// Only symbols between −1 and 1 have ends.
    #[test]
    fn other_symbols_have_no_ends() {
        let known = Arc::new(Known::new());
        let terms = |of: &Poly, known: &Arc<Known>| Certificate::terms(of, known);
        let of = |x: Symbol| Certificate::ends(&(Poly::constant(2) + Poly::symbol(x)), x, &known, &terms);
        assert!(of(Symbol::Place(0)).is_some() && of(Symbol::Error(3)).is_some());
        assert!(of(Symbol::Own("e₁")).is_none() && of(Symbol::Slack(0)).is_none());
    }
}

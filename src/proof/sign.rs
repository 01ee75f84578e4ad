//! The sign of a polynomial for all values of its symbols, with a certificate.
//!
//! Four rules, short certificates before long ones; each is sound by itself, and together they are not complete:
//!
//! 1. **Terms.** Every term has the same sign: a symbol known to be positive (or not negative) keeps it, a free
//!    symbol does in an even power, and e^… is positive. Strict if one term is nowhere zero.
//! 2. **Factor.** A product of powers common to all terms has a sign, and so has what is left; e^… can be taken
//!    out of anything.
//! 3. **Square.** For a x² + b x + d with a ≠ 0: 4a(a x² + b x + d) = (2a x + b)² + (4a d − b²), so the sign is a's
//!    if 4a d − b² is not negative.
//! 4. **Slope.** A function of x that is continuous for x ≥ 0, not negative at x = 0 and rising for x > 0 is
//!    not negative for x ≥ 0, and positive for x > 0. Only tried where there is an e^….

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use std::collections::BTreeMap;

/// What is known of a symbol. A symbol that is not listed is free: any real number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assumed {
    /// ≥ 0
    NonNegative,
    /// > 0
    Positive,
}

/// What is known of the symbols.
pub type Assumptions = BTreeMap<Symbol, Assumed>;

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

impl Sign {
    /// Neither zero nor possibly zero.
    pub fn is_strict(self) -> bool {
        matches!(self, Sign::Positive | Sign::Negative)
    }

    /// The sign of −x.
    pub fn negated(self) -> Self {
        match self {
            Sign::Negative => Sign::Positive,
            Sign::NonPositive => Sign::NonNegative,
            Sign::Zero => Sign::Zero,
            Sign::NonNegative => Sign::NonPositive,
            Sign::Positive => Sign::Negative,
        }
    }

    /// The sign of x y.
    pub fn times(self, other: Self) -> Self {
        use Sign::*;
        match (self, other) {
            (Zero, _) | (_, Zero) => Zero,
            (Positive, sign) | (sign, Positive) => sign,
            (Negative, sign) | (sign, Negative) => sign.negated(),
            (NonNegative, NonNegative) | (NonPositive, NonPositive) => NonNegative,
            (NonNegative, NonPositive) | (NonPositive, NonNegative) => NonPositive,
        }
    }

    /// Is whatever has this sign also of the other?
    pub fn implies(self, other: Self) -> bool {
        use Sign::*;
        self == other
            || matches!((self, other), (Positive | Zero, NonNegative) | (Negative | Zero, NonPositive))
    }

    /// As a reader writes it.
    pub fn text(self) -> &'static str {
        match self {
            Sign::Negative => "< 0",
            Sign::NonPositive => "≤ 0",
            Sign::Zero => "= 0",
            Sign::NonNegative => "≥ 0",
            Sign::Positive => "> 0",
        }
    }
}

/// Why a polynomial has its sign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// The polynomial.
    pub of: Poly,
    /// Its sign.
    pub sign: Sign,
    /// By which rule.
    pub rule: Rule,
}

/// The rules, with what they rest on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// It is 0.
    Zero,
    /// Rule 1.
    Terms,
    /// Rule 2: a monomial, and what is left.
    Factor(Box<Certificate>, Box<Certificate>),
    /// Rule 3.
    Square {
        /// The symbol.
        x: Symbol,
        /// The sign of a.
        leading: Box<Certificate>,
        /// 2a x + b
        root: Poly,
        /// The sign of 4a d − b².
        rest: Box<Certificate>,
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

/// How deep certificates may rest on others.
const DEPTH: u32 = 3;

/// Nor is rule 4 tried on more terms than this: derivatives only grow.
const TERMS: usize = 12;

/// The sign of a polynomial, if the rules find one.
pub fn sign(of: &Poly, known: &Assumptions) -> Option<Certificate> {
    // A short certificate before a long one.
    (0..=DEPTH).find_map(|depth| within(of, known, depth))
}

fn within(of: &Poly, known: &Assumptions, depth: u32) -> Option<Certificate> {
    if of.is_zero() {
        return Some(Certificate { of: of.clone(), sign: Sign::Zero, rule: Rule::Zero });
    }
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
fn terms(of: &Poly, known: &Assumptions) -> Option<Certificate> {
    let (mut strict, mut positive, mut negative) = (false, false, false);
    for (monomial, coefficient) in of.terms() {
        let mut nowhere_zero = true;
        for (symbol, n) in monomial.powers() {
            match known.get(symbol) {
                Some(Assumed::Positive) => {}
                Some(Assumed::NonNegative) => nowhere_zero = false,
                None if n % 2 == 0 => nowhere_zero = false,
                None => return None,
            }
        }
        strict |= nowhere_zero;
        positive |= coefficient.is_positive();
        negative |= coefficient.is_negative();
    }
    let sign = match (positive, negative, strict) {
        (true, false, true) => Sign::Positive,
        (true, false, false) => Sign::NonNegative,
        (false, true, true) => Sign::Negative,
        (false, true, false) => Sign::NonPositive,
        (true, true, _) | (false, false, _) => return None,
    };
    Some(Certificate { of: of.clone(), sign, rule: Rule::Terms })
}

/// Rule 2, with a product of powers.
fn factor(of: &Poly, known: &Assumptions, depth: u32) -> Option<Certificate> {
    let common = of.common_monomial();
    if common == Monomial::one() {
        return None;
    }
    let factor = Poly::term(common, 1.into());
    product(of, &factor, within(&of.over(&factor)?, known, depth)?, known)
}

/// Rule 2, with an e^…, where rule 4 decides what is left.
fn exponential_factor(of: &Poly, known: &Assumptions, depth: u32) -> Option<Certificate> {
    of.exponents().find_map(|exponent| {
        let rest = of.times(&Poly::exponential(exponent.negated()));
        product(of, &Poly::exponential(exponent.clone()), slope(&rest, known, depth)?, known)
    })
}

fn product(of: &Poly, factor: &Poly, rest: Certificate, known: &Assumptions) -> Option<Certificate> {
    let factor = terms(factor, known)?;
    let sign = factor.sign.times(rest.sign);
    Some(Certificate { of: of.clone(), sign, rule: Rule::Factor(factor.into(), rest.into()) })
}

/// Rule 3.
fn square(of: &Poly, known: &Assumptions, depth: u32) -> Option<Certificate> {
    of.symbols().into_iter().find_map(|x| {
        let in_exponent = of.exponents().any(|e| e.symbols().contains(&x));
        let [d, b, a] = <[Poly; 3]>::try_from(of.coefficients(x)).ok()?;
        if in_exponent {
            return None;
        }
        let leading = within(&a, known, depth)?;
        if !leading.sign.is_strict() {
            return None;
        }
        let rest = within(&a.times(&d).scaled(&4.into()).plus(&b.times(&b).negated()), known, depth)?;
        let sign = match rest.sign {
            Sign::Positive => leading.sign,
            Sign::Zero | Sign::NonNegative => leading.sign.times(Sign::NonNegative),
            Sign::Negative | Sign::NonPositive => return None,
        };
        let root = a.times(&Poly::symbol(x)).scaled(&2.into()).plus(&b);
        let rule = Rule::Square { x, leading: leading.into(), root, rest: rest.into() };
        Some(Certificate { of: of.clone(), sign, rule })
    })
}

/// Rule 4.
fn slope(of: &Poly, known: &Assumptions, depth: u32) -> Option<Certificate> {
    if !of.has_exponentials() || of.terms().count() > TERMS {
        return None;
    }
    let symbols = of.all_symbols();
    known.iter().filter(|(x, _)| symbols.contains(x)).find_map(|(&x, &assumed)| {
        let at_least = |assumed| known.iter().map(|(&y, &a)| (y, if y == x { assumed } else { a })).collect();
        if !is_continuous(of, &at_least(Assumed::NonNegative)) {
            return None;
        }
        let start = of.replace(&Monomial::of(x), &Ratio::zero());
        let start = within(&numerator(&start, known)?, known, depth)?;
        let inside = at_least(Assumed::Positive);
        let slope = within(&numerator(&of.derivative(x), &inside)?, &inside, depth)?;
        let sign = rising(start.sign, slope.sign, assumed)
            .or_else(|| rising(start.sign.negated(), slope.sign.negated(), assumed).map(Sign::negated))?;
        let rule = Rule::Slope { x, start: start.into(), slope: slope.into() };
        Some(Certificate { of: of.clone(), sign, rule })
    })
}

/// Do exponents have a value wherever this is known? They do if they are quotients of polynomials and no
/// denominator vanishes.
fn is_continuous(of: &Poly, known: &Assumptions) -> bool {
    of.exponents().all(|exponent| exponent.is_of_polynomials() && numerator(exponent, known).is_some())
}

/// A polynomial with the sign of the quotient: its numerator, or minus that if the denominator is negative. None
/// if that is not known.
fn numerator(of: &Ratio, known: &Assumptions) -> Option<Poly> {
    match terms(of.den(), known)?.sign {
        Sign::Positive => Some(of.num().clone()),
        Sign::Negative => Some(of.num().negated()),
        Sign::NonNegative | Sign::NonPositive | Sign::Zero => None,
    }
}

/// The sign of what has one sign at x = 0 and a slope of another for x > 0, if it does not fall below 0.
fn rising(start: Sign, slope: Sign, x: Assumed) -> Option<Sign> {
    if !start.implies(Sign::NonNegative) || !slope.implies(Sign::NonNegative) {
        return None;
    }
    let strict = start == Sign::Positive || (slope == Sign::Positive && x == Assumed::Positive);
    Some(if strict { Sign::Positive } else { Sign::NonNegative })
}

impl Certificate {
    /// One line a rule, the last one first.
    pub fn lines(&self) -> Vec<String> {
        let Certificate { of, sign, rule } = self;
        let sign = sign.text();
        match rule {
            Rule::Zero => vec!["0 = 0".to_string()],
            Rule::Terms => vec![format!("{of} {sign}, term by term")],
            Rule::Factor(monomial, rest) => {
                let mut lines = vec![format!("{of} = ({}) ({}) {sign}, since", monomial.of, rest.of)];
                lines.extend(rest.lines());
                lines
            }
            Rule::Square { leading, root, rest, .. } => {
                let (a, d) = (&leading.of, &rest.of);
                let mut lines = vec![format!("4 ({a}) ({of}) = ({root})² + ({d}), hence {of} {sign}, since")];
                lines.extend(leading.lines());
                lines.extend(rest.lines());
                lines
            }
            Rule::Slope { x, start, slope } => {
                let x = x.0;
                let mut lines = vec![format!("{of} {sign}, by its value at {x} = 0 and its slope in {x}:")];
                lines.push(format!("at {x} = 0:"));
                lines.extend(start.lines());
                lines.push(format!("its derivative by {x} has the sign of:"));
                lines.extend(slope.lines());
                lines
            }
        }
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

    fn found(of: &Poly) -> Option<Sign> {
        let known = [("a", Assumed::Positive), ("b", Assumed::Positive), ("z", Assumed::NonNegative)];
        sign(of, &known.map(|(name, assumed)| (Symbol(name), assumed)).into()).map(|c| c.sign)
    }

    #[test]
    fn terms_of_one_sign() {
        assert_eq!(found(&x("a").plus(&x("z"))), Some(Sign::Positive));
        assert_eq!(found(&x("z").plus(&x("u").times(&x("u")))), Some(Sign::NonNegative));
        assert_eq!(found(&x("a").times(&x("b")).negated()), Some(Sign::Negative));
        assert_eq!(found(&Poly::zero()), Some(Sign::Zero));
        assert_eq!(found(&n(-2)), Some(Sign::Negative));
        // An odd power of a free symbol, a difference: nothing is known.
        assert_eq!(found(&x("u")), None);
        assert_eq!(found(&x("a").plus(&x("b").negated())), None);
    }

    #[test]
    fn a_common_factor() {
        // a(u² + 1) is rule 1; a u² − 2 a u + 2 a needs the factor, then the square.
        let square = x("u").times(&x("u")).plus(&x("u").scaled(&(-2).into())).plus(&n(2));
        assert_eq!(found(&x("a").times(&square)), Some(Sign::Positive));
        assert_eq!(found(&x("z").times(&square)), Some(Sign::NonNegative));
        assert_eq!(found(&x("u").times(&square)), None);
    }

    #[test]
    fn squares_that_miss_zero_touch_it_or_cross_it() {
        let quadratic = |d: i32| x("u").times(&x("u")).plus(&x("u").scaled(&2.into())).plus(&n(d));
        assert_eq!(found(&quadratic(2)), Some(Sign::Positive));
        assert_eq!(found(&quadratic(1)), Some(Sign::NonNegative));
        assert_eq!(found(&quadratic(0)), None);
        assert_eq!(found(&quadratic(1).negated()), Some(Sign::NonPositive));
        // A leading coefficient that may vanish proves nothing.
        assert_eq!(found(&x("z").times(&x("u")).times(&x("u")).plus(&x("u")).plus(&n(1))), None);
    }

    #[test]
    fn an_exponential_against_its_tangent() {
        let exp = |p: Poly| Poly::exponential(p.into());
        let tangent = n(1).plus(&x("a"));
        assert_eq!(found(&exp(x("a")).plus(&tangent.negated())), Some(Sign::Positive));
        assert_eq!(found(&tangent.plus(&exp(x("a")).negated())), Some(Sign::Negative));
        // The other way round and from a wrong start it is not so.
        assert_eq!(found(&exp(x("a")).plus(&n(2).plus(&x("a")).negated())), None);
        assert_eq!(found(&exp(x("u")).plus(&n(1).plus(&x("u")).negated())), None);
        // e^{e^{1/a}} has no value at a = 0 to begin with.
        let within = Poly::exponential(Ratio::from(n(1)).over(&x("a").into()).unwrap());
        let nested = Ratio::from(x("a").times(&within)).over(&tangent.clone().into()).unwrap();
        assert_eq!(found(&Poly::exponential(nested.negated()).plus(&n(-1))), None);
        // 1 + a − e^{a/(a+1)}: its slope takes two rounds.
        let weaker = Poly::symbol(Symbol("a"));
        let quotient = Ratio::from(weaker.clone()).over(&weaker.plus(&n(1)).into()).unwrap();
        assert_eq!(found(&tangent.plus(&Poly::exponential(quotient).negated())), Some(Sign::Positive));
    }
}

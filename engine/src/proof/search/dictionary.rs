//! Translation between the polynomials of the search and those of the checker.
//!
//! The search replaces pivots by slack variables and symbols in intervals by places. The checker uses the
//! original symbols. A quantity in *own* symbols is a polynomial of the search without slack variables, in
//! which places have the numbers of their hypotheses.

use super::algebra::{Monomial, Number, Poly, Ratio, Symbol};
use super::assumption::{Assumption, AssumptionUse};
use crate::number::Tree;
use crate::proof::check::{Atom, MAX_VARIABLES, Polynomial, Problem, Quotient, State};
use rug::{Integer, Rational};

/// The first number of symbols that do not occur in derivations.
const FIRST: u8 = 128;

/// Maximum power of an exponential that is recognised.
const MAX_POWER: u8 = 4;

/// Returns the symbol of the quantity with this number in a certificate.
pub fn quantity(i: usize) -> Symbol {
    Symbol::Slack(numbered(i))
}

/// Returns the own symbol of the place in the interval of a hypothesis.
fn place(hypothesis: usize) -> Symbol {
    Symbol::Place(numbered(hypothesis))
}

/// Returns the symbol of an exponential whose exponent is disregarded.
pub fn opaque_exponential(x: usize) -> Symbol {
    Symbol::Error(numbered(x))
}

/// Returns the symbol of a variable that a derivation does not use.
fn unused(x: usize) -> Symbol {
    place(MAX_VARIABLES + x)
}

/// Returns a number above those of a derivation. Larger numbers than a derivation has may coincide, and the
/// checker then refuses the certificate.
fn numbered(i: usize) -> u8 {
    u8::try_from(i).ok().and_then(|i| FIRST.checked_add(i)).unwrap_or(u8::MAX)
}

/// The symbols of the search for the variables of the checker, and the meaning of the symbols of a derivation.
#[derive(Clone)]
pub struct Dictionary {
    /// The symbols of variables, except for exponentials.
    symbols: Vec<Symbol>,
    /// The slack variables of a derivation, with their values in own symbols.
    slacks: Vec<(Symbol, Ratio)>,
    /// The places of a derivation, with their own symbols.
    places: Vec<(Symbol, Symbol)>,
}

impl Dictionary {
    /// Returns the dictionary before any assumption; `None` if there are too many errors. The errors in a
    /// derivation are numbered as the `roundings`.
    pub fn new(problem: &Problem, roundings: &[Tree]) -> Option<Self> {
        let mut symbols = Vec::new();
        for (x, atom) in problem.table.atoms().iter().enumerate() {
            symbols.push(match atom {
                Atom::Own(name) => Symbol::Own(name),
                Atom::Place(i) => place(*i),
                Atom::Exponential(_) => opaque_exponential(x),
                Atom::Size(_) | Atom::Factor(_) => unused(x),
                Atom::Error(of) => {
                    let of = problem.table.formula(*of).ok()?;
                    Symbol::Error(roundings.iter().position(|known| known == of)?.try_into().ok()?)
                }
            });
        }
        Some(Dictionary { symbols, slacks: Vec::new(), places: Vec::new() })
    }

    /// Reads the last assumption of a context, which is that of the hypothesis with this number.
    pub fn read(&mut self, assumption: &Assumption, hypothesis: Option<usize>, problem: &Problem) {
        match &assumption.usage {
            AssumptionUse::Pivot(_, _, Some(slack)) => {
                self.slacks.push((*slack, self.own(&assumption.slack_value())));
            }
            AssumptionUse::Interval(x, by, symbol) => {
                let Some(hypothesis) = hypothesis else { return };
                self.places.push((*symbol, place(hypothesis)));
                let (x, by) = (Monomial::of(*x), self.own(by));
                for (_, value) in &mut self.slacks {
                    *value = value.replace(&x, &by);
                }
            }
            AssumptionUse::Size { of, size, place, .. } => {
                let variables = problem.table.find(of).ok().and_then(|of| {
                    let variable = |atom| problem.table.variable(atom).ok();
                    Some((variable(Atom::Size(of))?, variable(Atom::Factor(of))?))
                });
                if let Some((x, y)) = variables {
                    (self.symbols[x], self.symbols[y]) = (*size, *place);
                }
            }
            _ => {}
        }
    }

    /// Returns a quantity of a derivation in own symbols.
    pub fn own(&self, value: &Ratio) -> Ratio {
        let replace = |value: Ratio, (slack, by): &(Symbol, Ratio)| value.replace(&Monomial::of(*slack), by);
        self.with_own_places(&self.slacks.iter().rev().fold(value.clone(), replace))
    }

    /// Replaces the places of a derivation by their own symbols.
    pub fn with_own_places(&self, value: &Ratio) -> Ratio {
        self.places.iter().fold(value.clone(), |value, (place, own)| {
            value.replace(&Monomial::of(*place), &Poly::symbol(*own).into())
        })
    }

    /// Replaces own places by those of the derivation.
    pub fn with_places(&self, value: &Ratio) -> Ratio {
        self.places.iter().fold(value.clone(), |value, (place, own)| {
            value.replace(&Monomial::of(*own), &Poly::symbol(*place).into())
        })
    }

    /// Returns the own symbol of an error or place of a derivation.
    pub fn own_unit(&self, x: Symbol) -> Symbol {
        self.places.iter().find(|(place, _)| *place == x).map_or(x, |(_, own)| *own)
    }

    /// Returns the symbol of a variable other than an exponential.
    pub fn symbol(&self, x: usize) -> Symbol {
        self.symbols[x]
    }

    /// Returns the variable of an own symbol.
    pub fn variable(&self, x: Symbol) -> Option<usize> {
        self.symbols.iter().position(|own| *own == x)
    }

    /// Returns a polynomial in own symbols, with exponentials as such.
    pub fn poly(&self, of: &Polynomial, state: &State) -> Poly {
        self.poly_with(of, |x| match state.exponent(x) {
            Some(exponent) => Poly::exponential(self.ratio(exponent, state)),
            None => Poly::symbol(self.symbols[x]),
        })
    }

    /// Returns a polynomial in own symbols, with a symbol for each exponential.
    pub fn opaque_poly(&self, of: &Polynomial) -> Poly {
        self.poly_with(of, |x| Poly::symbol(self.symbols[x]))
    }

    fn poly_with(&self, of: &Polynomial, atom: impl Fn(usize) -> Poly) -> Poly {
        let mut terms: Vec<(Monomial, Number)> = Vec::with_capacity(of.terms().len());
        for (powers, number) in of.terms() {
            let mut term = Poly::constant(Number::from(Rational::from(*number)));
            for (x, n) in powers.iter().enumerate().filter(|(_, n)| **n > 0) {
                let atom = atom(x);
                term = (0..*n).fold(term, |term, _| term * &atom);
            }
            terms.extend(term.terms().map(|(monomial, number)| (monomial.clone(), number.clone())));
        }
        terms.into_iter().collect()
    }

    /// Returns a quotient in own symbols.
    pub fn ratio(&self, of: &Quotient, state: &State) -> Ratio {
        let facts = of.den.iter().filter_map(|i| state.facts.get(*i).ok());
        let den = facts.fold(Poly::constant(1), |product, (of, _)| product * self.poly(of, state));
        Ratio::from(self.poly(&of.num, state)).over(&den.into()).unwrap_or_else(Ratio::zero)
    }

    /// Returns a polynomial in own symbols and in `quantities` further symbols as one of the checker.
    pub fn polynomial(&self, of: &Poly, quantities: usize, state: &State) -> Option<Polynomial> {
        let mut terms = Vec::new();
        for (monomial, number) in of.terms() {
            let mut powers = [0_u8; MAX_VARIABLES];
            if let Some(exponent) = monomial.exponent() {
                let (x, n) = self.exponential(exponent, state)?;
                powers[x] = n;
            }
            for (symbol, n) in monomial.powers() {
                let further = || (0..quantities).find(|i| quantity(*i) == symbol);
                let x = self.variable(symbol).or_else(|| Some(self.symbols.len() + further()?))?;
                let power = powers.get_mut(x)?;
                *power = power.checked_add(n.try_into().ok()?)?;
            }
            let number = number.to_rational();
            terms.push((powers, number.numer().to_i128().filter(|_| number.is_integer())?));
        }
        Polynomial::new(terms).ok()
    }

    /// Returns the variable of an exponential, and the power of it that has this exponent, in own symbols.
    pub fn exponential(&self, exponent: &Ratio, state: &State) -> Option<(usize, u8)> {
        let known = |(x, known): &(usize, Quotient)| (*x, self.ratio(known, state));
        let known: Vec<_> = state.exponents.iter().map(known).collect();
        power_of(exponent, &known)
    }
}

/// Returns a variable and the power of its exponential that has this exponent.
pub fn power_of(exponent: &Ratio, known: &[(usize, Ratio)]) -> Option<(usize, u8)> {
    (1..=MAX_POWER).find_map(|n| {
        let power = Ratio::from(Poly::constant(i32::from(n)));
        let is_it = |known: &Ratio| (known * &power - exponent).is_zero();
        known.iter().find(|(_, known)| is_it(known)).map(|(x, _)| (*x, n))
    })
}

/// Multiplies two polynomials by the same positive number, so that their coefficients are integers without a
/// common divisor.
pub fn integral(a: &Poly, b: &Poly) -> (Poly, Poly) {
    let (mut multiple, mut divisor) = (Integer::from(1), Integer::new());
    for (_, number) in a.terms().chain(b.terms()) {
        multiple.lcm_mut(number.to_rational().denom());
    }
    for (_, number) in a.terms().chain(b.terms()) {
        divisor.gcd_mut((number.to_rational() * &multiple).numer());
    }
    if divisor.is_zero() {
        divisor = 1.into();
    }
    let by = Poly::constant(Number::from(Rational::from((multiple, divisor))));
    (a * &by, b * by)
}

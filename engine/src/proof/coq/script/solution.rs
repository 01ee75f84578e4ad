//! Shorter certificates: the sides of an identity as the result of eliminating symbols by facts.

use crate::proof::check::{Certificate, Known, Polynomial, Sign, State};
use std::iter;

/// A certificate whose right side follows from its left side and from these steps.
pub(super) struct Solution {
    /// The certificate, with the sides that the steps produce.
    pub(super) certificate: Certificate,
    /// The steps in Coq: a variable is eliminated by a quantity, up to a power of it; or a variable is divided
    /// out.
    pub(super) steps: Vec<String>,
}

/// Maximum number of terms of a side that is written out.
const SHORT: usize = 24;

/// Returns the power of a polynomial.
fn power(of: &Polynomial, n: u8) -> Option<Polynomial> {
    (0..n).try_fold(Polynomial::constant(1), |product, _| product.times(of).ok())
}

/// Divides a variable out of a polynomial if it is a factor of every term.
fn divided(of: &Polynomial, x: usize) -> Option<Polynomial> {
    let mut terms: Vec<_> = of.terms().copied().collect();
    for (powers, _) in &mut terms {
        powers[x] = powers[x].checked_sub(1)?;
    }
    Polynomial::new(terms).ok()
}

/// Returns the right side of a certificate without multiples of facts that are 0.
fn essential(certificate: &Certificate, state: &State) -> Option<Polynomial> {
    let first = state.problem.table.atoms().len();
    let zeros = (first..).zip(&certificate.known).filter(|(_, known)| match known {
        Known::Fact(i) => state.facts.get(*i).is_ok_and(|(_, sign)| *sign == Sign::Zero),
        _ => false,
    });
    let zeros: Vec<_> = zeros.map(|(x, _)| x).collect();
    let terms = certificate.right.terms().filter(|(powers, _)| zeros.iter().all(|x| powers[*x] == 0));
    Polynomial::new(terms.copied().collect()).ok()
}

/// An elimination of symbols from a polynomial f by facts, with l f = r.
struct Elimination {
    facts: Vec<Polynomial>,
    /// The facts that are not yet used.
    open: Vec<usize>,
    /// The symbols to be eliminated.
    symbols: Vec<usize>,
    /// The variable of the first fact.
    first: usize,
    left: Polynomial,
    right: Polynomial,
    steps: Vec<String>,
}

impl Elimination {
    /// Returns a fact that is linear in a symbol of r, and the symbol; preferably one in no other fact.
    fn pivot(&self) -> Option<(usize, usize)> {
        let pairs = self.open.iter().flat_map(|i| iter::repeat(*i).zip(self.symbols.iter().copied()));
        let pivots = pairs.filter(|(i, x)| self.facts[*i].degree(*x) == 1 && self.right.degree(*x) > 0);
        pivots.min_by_key(|(i, x)| self.open.iter().any(|j| j != i && self.facts[*j].degree(*x) > 0))
    }

    /// Replaces a symbol by the value that a fact gives it.
    fn eliminate(&mut self, i: usize, x: usize) -> Option<()> {
        let (cofactor, degree) = (self.facts[i].coefficient(x, 1), self.right.degree(x));
        let fact = Polynomial::variable(self.first + i).ok()?;
        let rest = fact.plus_multiple(-1, &self.facts[i].coefficient(x, 0)).ok()?;
        let mut sum = Polynomial::zero();
        for n in 0..=degree {
            let part = self.right.coefficient(x, n).times(&power(&rest, n)?).ok()?;
            sum = sum.plus_multiple(1, &part.times(&power(&cofactor, degree - n)?).ok()?).ok()?;
        }
        (self.left, self.right) = (self.left.times(&power(&cofactor, degree)?).ok()?, sum);
        self.steps.push(format!("Solve {x} {} {degree}", self.first + i));
        self.open.retain(|j| *j != i);
        Some(())
    }

    /// Divides common factors out of both sides.
    fn divide(&mut self) {
        for y in &self.symbols {
            while let (Some(left), Some(right)) = (divided(&self.left, *y), divided(&self.right, *y)) {
                (self.left, self.right) = (left, right);
                self.steps.push(format!("Divide {y}"));
            }
        }
    }
}

impl Solution {
    /// Finds the steps that lead from a polynomial to a certificate like this one.
    pub(super) fn find(of: &Polynomial, certificate: &Certificate, state: &State) -> Option<Self> {
        let Certificate { known, left, right } = certificate;
        if right.terms().len() <= SHORT {
            return None;
        }
        let facts = known.iter().map(|known| match known {
            Known::Fact(i) => state.facts.get(*i).ok().map(|(of, _)| of.clone()),
            _ => None,
        });
        let facts: Vec<_> = facts.collect::<Option<_>>()?;
        let essential = essential(certificate, state)?;
        let first = state.problem.table.atoms().len();
        let symbols = (0..first).filter(|x| left.degree(*x) == 0 && essential.degree(*x) == 0).collect();
        let (open, left, right) = ((0..facts.len()).collect(), Polynomial::constant(1), of.clone());
        let mut elimination = Elimination { facts, open, symbols, first, left, right, steps: Vec::new() };
        // The polynomial does not need the facts that remain.
        while let Some((i, x)) = elimination.pivot() {
            elimination.eliminate(i, x)?;
            elimination.divide();
        }
        let Elimination { left, right, steps, .. } = elimination;
        let found = Certificate { known: known.clone(), left, right };
        let sign = state.certify(of, certificate).ok()?;
        state.certify(of, &found).is_ok_and(|implied| implied.implies(sign)).then_some(())?;
        Some(Solution { certificate: found, steps })
    }
}

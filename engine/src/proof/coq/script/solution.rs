//! Shorter certificates: the sides of an identity as the result of eliminating symbols by facts.

use crate::proof::check::{Certificate, Known, Polynomial, Powers, Sign, State};
use std::iter;

/// A certificate whose right side follows from its left side and from these steps.
pub(super) struct Solution {
    /// The certificate, with the sides that the steps produce.
    pub(super) certificate: Certificate,
    /// The steps in Coq: a variable is eliminated by a quantity, up to a power of it; or a variable is divided
    /// out.
    pub(super) steps: Vec<String>,
}

/// Number of terms that a side has at most if it is written out.
const SHORT: usize = 24;

/// Returns the power of a polynomial.
fn power(of: &Polynomial, n: u8) -> Option<Polynomial> {
    (0..n).try_fold(Polynomial::constant(1), |product, _| product.times(of).ok())
}

/// Divides a variable out of a polynomial, if it is a factor of it.
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
    let is_zero = |known: &Known| match known {
        Known::Fact(i) => state.facts.get(*i).is_ok_and(|(_, sign)| *sign == Sign::Zero),
        _ => false,
    };
    let zeros: Vec<_> = (first..).zip(&certificate.known).filter(|(_, known)| is_zero(known)).collect();
    let is_essential = |powers: &Powers| zeros.iter().all(|(x, _)| powers[*x] == 0);
    let terms = certificate.right.terms().filter(|(powers, _)| is_essential(powers));
    Polynomial::new(terms.copied().collect()).ok()
}

impl Solution {
    /// Finds the steps that lead from a polynomial to a certificate like this one.
    pub(super) fn find(of: &Polynomial, certificate: &Certificate, state: &State) -> Option<Self> {
        let Certificate { known, left, right } = certificate;
        if right.terms().len() <= SHORT {
            return None;
        }
        let first = state.problem.table.atoms().len();
        let fact = |known: &Known| match known {
            Known::Fact(i) => state.facts.get(*i).ok().map(|(of, _)| of.clone()),
            _ => None,
        };
        let facts: Vec<_> = known.iter().map(fact).collect::<Option<_>>()?;
        let (mut open, mut l, mut r) =
            ((0..facts.len()).collect::<Vec<_>>(), Polynomial::constant(1), of.clone());
        let mut steps = Vec::new();
        let essential = essential(certificate, state)?;
        let is_gone = |x: usize| left.degree(x) == 0 && essential.degree(x) == 0;
        while !open.is_empty() {
            let is_pivot = |i: usize, x: usize| is_gone(x) && facts[i].degree(x) == 1 && r.degree(x) > 0;
            let occurs_once = |i: usize, x: usize| {
                open.iter().filter(|other| **other != i).all(|other| facts[*other].degree(x) == 0)
            };
            let pairs = open.iter().flat_map(|i| iter::repeat(*i).zip(0..first));
            let mut pairs = pairs.filter(|(i, x)| is_pivot(*i, *x)).collect::<Vec<_>>();
            pairs.sort_by_key(|(i, x)| !occurs_once(*i, *x));
            // What remains are facts that the polynomial does not need.
            let Some((i, x)) = pairs.first().copied() else { break };
            let (cofactor, degree) = (facts[i].coefficient(x, 1), r.degree(x));
            let rest =
                Polynomial::variable(first + i).ok()?.plus_multiple(-1, &facts[i].coefficient(x, 0)).ok()?;
            let mut sum = Polynomial::zero();
            for n in 0..=degree {
                let part = r.coefficient(x, n).times(&power(&rest, n)?).ok()?;
                sum = sum.plus_multiple(1, &part.times(&power(&cofactor, degree - n)?).ok()?).ok()?;
            }
            (l, r) = (l.times(&power(&cofactor, degree)?).ok()?, sum);
            steps.push(format!("Solve {x} {} {degree}", first + i));
            open.retain(|own| *own != i);
            for y in (0..first).filter(|y| is_gone(*y)) {
                while let (Some(less), Some(rest)) = (divided(&l, y), divided(&r, y)) {
                    (l, r) = (less, rest);
                    steps.push(format!("Divide {y}"));
                }
            }
        }
        let found = Certificate { known: known.clone(), left: l, right: r };
        let sign = state.certify(of, certificate).ok()?;
        state.certify(of, &found).is_ok_and(|own| own.implies(sign)).then_some(())?;
        Some(Solution { certificate: found, steps })
    }
}

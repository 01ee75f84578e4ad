//! The leaves of a proof: the checker runs with a search in the place of the proof.

use super::finder::{Failure, Finder, Found, Guide};
use super::{Attempt, Certified, CertifyError, certify_part};
use crate::formula::Relation;
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::number::Tree;
use crate::number::tree::Op;
use crate::proof::check::{
    AbsoluteValue, Atom, Leaf, Node, Polynomial, Problem, Quotient, Reader, Reason, Rise, Same, Source,
    State, parts_of_rise,
};
use crate::proof::kernel::algebra::{Poly, Ratio, Symbol};
use crate::proof::kernel::context::Context;
use crate::proof::kernel::derivation::{AssumptionUse, Direct, Justification, SignedRatio};
use crate::proof::kernel::rounded_difference;
use crate::proof::kernel::sign::Sign;
use crate::proof::kernel::translator::without_scales;
use std::mem;

/// Maximum number of functions at a leaf whose sign follows from their slope.
const MAX_RISES: usize = 4;

/// A search for what a leaf lists.
struct Search<'a> {
    guide: &'a Guide<'a>,
    leaf: Leaf,
    failure: Option<Failure>,
}

impl Attempt<'_> {
    /// Returns a leaf with the certificates of a derivation.
    pub fn leaf(&self, context: &Context, direct: Direct) -> Certified<Leaf> {
        let dictionary = self.dictionary(context)?;
        let cases: Certified<Vec<_>> =
            self.cases.iter().map(|(on, sign)| Ok((self.case(on, &dictionary)?, *sign))).collect();
        let (problem, hypotheses, orders) = (self.problem, self.hypotheses(context), self.orders());
        let guide =
            Guide { context, problem, dictionary, signed: signed(direct), is_ordered: !orders.is_empty() };
        let (cases, mut rises) = (cases?, Vec::new());
        loop {
            let leaf = Leaf {
                hypotheses: hypotheses.clone(),
                orders: orders.clone(),
                rises: mem::take(&mut rises),
                ..Leaf::default()
            };
            let mut search = Search { guide: &guide, leaf: leaf.clone(), failure: None };
            let checked = Reader { state: State::new(problem), source: &mut search }.leaf(&leaf, &cases);
            match (checked, search.failure) {
                (Ok(()), _) => return Ok(search.leaf),
                (Err(_), Some(Failure::Rise(rise))) if leaf.rises.len() < MAX_RISES => {
                    rises = leaf.rises;
                    rises.push(self.with_parts(*rise)?);
                }
                (Err(_), Some(Failure::Reason(reason))) => return Err(CertifyError::NotExpressed(reason)),
                (Err(_), Some(Failure::Rise(_))) => return Err(CertifyError::NotExpressed("many rises")),
                (Err(reason), None) => return Err(CertifyError::Leaf(reason)),
            }
        }
    }

    /// Returns the numbers of the hypotheses to use. Those on symbols in intervals are used again after
    /// these; those on the variable of a limit come last.
    fn hypotheses(&self, context: &Context) -> Vec<usize> {
        let (mut used, mut in_intervals) = (Vec::new(), Vec::new());
        for assumption in context.assumptions() {
            let Some(hypothesis) = &assumption.hypothesis else { continue };
            let place = self.problem.hypotheses.iter().position(|given| *given == hypothesis);
            match &assumption.usage {
                AssumptionUse::Unused if hypothesis.interval().is_some() => continue,
                AssumptionUse::Interval(x, ..) => in_intervals.push(x.name()),
                _ => {}
            }
            used.extend(place);
        }
        for (i, hypothesis) in self.problem.hypotheses.iter().enumerate() {
            let depends = hypothesis.value.symbols().iter().any(|x| in_intervals.contains(x));
            if hypothesis.interval().is_none() && depends {
                used.push(i);
            }
        }
        if let Proposition::Limit(_, by, _) = self.problem.proposition {
            used.sort_by_key(|i| self.problem.hypotheses[*i].value.symbols().contains(by));
        }
        used
    }

    /// Returns the pairs of rounded formulas whose order the goal rests on.
    fn orders(&self) -> Vec<[usize; 2]> {
        let mut pairs = Vec::new();
        if let Proposition::Sign(Relation::NonNegative, of) = self.problem.proposition
            && let Some((a, b)) = rounded_difference(of)
        {
            collect_orders(a, b, &mut pairs);
        }
        let table = &self.problem.table;
        let error = |of: &Tree| table.variable(Atom::Error(table.find(of).ok()?)).ok();
        pairs.into_iter().filter_map(|(a, b)| Some([error(a)?, error(b)?])).collect()
    }

    /// Adds the proofs of its parts to a function that rises.
    fn with_parts(&self, mut rise: Rise) -> Certified<Rise> {
        let failed = || CertifyError::NotExpressed("the parts of a rise");
        let problem = self.problem;
        let Some(Atom::Own(x)) = problem.table.atoms().get(rise.x) else { return Err(failed()) };
        let mut parts = Vec::new();
        for (proposition, assumed) in parts_of_rise(problem, &rise, x).map_err(|_| failed())?.iter() {
            let others = problem.hypotheses.iter().copied();
            let others: Vec<_> =
                others.filter(|given| !given.value.symbols().contains(x)).chain(assumed).collect();
            let part = Problem::new(proposition, others.clone()).map_err(|_| failed())?;
            parts.push(certify_part(&part.within(problem).map_err(|_| failed())?, &others)?);
        }
        rise.parts = <[Node; 3]>::try_from(parts).map_err(|_| failed())?;
        Ok(rise)
    }
}

/// Returns the signs that a derivation rests on.
fn signed(direct: Direct) -> Vec<SignedRatio> {
    let mut all = match direct.justification {
        Justification::Sign(signed) => vec![signed],
        Justification::Within(both) => (*both).into(),
        _ => Vec::new(),
    };
    all.extend(direct.branches.into_iter().map(|(.., signed)| signed));
    all
}

/// Collects pairs of formulas inside two others, operation by operation, whose roundings have an order.
fn collect_orders<'t>(a: &'t Tree, b: &'t Tree, all: &mut Vec<(&'t Tree, &'t Tree)>) {
    use Op::*;
    if a == b {
        return;
    }
    match (a.op(), b.op()) {
        (Rounded(a), Rounded(b)) => {
            collect_orders(a, b, all);
            all.push((a, b));
        }
        (PositivePart(a), PositivePart(b)) => collect_orders(a, b, all),
        (Neg(a), Neg(b)) => collect_orders(b, a, all),
        (Add(a, c), Add(b, d)) | (Min(a, c), Min(b, d)) => {
            collect_orders(a, b, all);
            collect_orders(c, d, all);
        }
        (Sub(a, c), Sub(b, d)) => {
            collect_orders(a, b, all);
            collect_orders(d, c, all);
        }
        (Mul(f, a), Mul(g, b)) | (Mul(a, f), Mul(b, g)) | (Div(a, f), Div(b, g)) if f == g => {
            collect_orders(a, b, all);
        }
        _ => {}
    }
}

impl Source for Search<'_> {
    fn sign(&mut self, of: &Polynomial, den: &[usize], state: &State) -> Option<Reason> {
        match self.guide.reason(of, den, state) {
            Ok(reason) => {
                self.leaf.signs.push(reason.clone());
                Some(reason)
            }
            Err(failure) => {
                self.failure.get_or_insert(failure);
                None
            }
        }
    }

    fn divisor(&mut self, of: &Polynomial, state: &State) -> Option<Vec<Polynomial>> {
        let factors = self.guide.divisor(of, state);
        if factors.is_none() {
            self.failure.get_or_insert(Failure::Reason("a divisor"));
        }
        self.leaf.divisors.extend(factors.clone());
        factors
    }

    fn size(&mut self, of: usize, value: &Quotient, state: &State) -> Option<AbsoluteValue> {
        let size = self.guide.size(of, value, state);
        self.leaf.sizes.extend(size);
        size
    }

    fn rounding(&mut self, value: &Quotient, state: &State) -> Option<Option<Same>> {
        let same = self.guide.same_rounding(value, state);
        self.leaf.roundings.push(same.clone());
        Some(same)
    }
}

impl Guide<'_> {
    /// Returns a reason for the sign of a polynomial: a fact about it, unless a certificate proves more.
    fn reason(&self, of: &Polynomial, den: &[usize], state: &State) -> Found<Reason> {
        let is_weak = |i: usize| state.facts.get(i).is_ok_and(|(_, sign)| !is_definite(*sign));
        let certificate = || Finder::find(self, of, den, state);
        match self.known_fact(of, state) {
            None => certificate().map(Reason::Certificate),
            Some(i) if is_weak(i) => match certificate() {
                Ok(found) if state.certify(of, &found).is_ok_and(is_definite) => {
                    Ok(Reason::Certificate(found))
                }
                _ => Ok(Reason::Fact(i)),
            },
            Some(i) => Ok(Reason::Fact(i)),
        }
    }

    /// Returns the fact about this polynomial, a strict one if there is one.
    fn known_fact(&self, of: &Polynomial, state: &State) -> Option<usize> {
        let all = || state.facts.iter().enumerate().filter(|(_, (known, _))| known == of);
        let definite = all().find(|(_, (_, sign))| is_definite(*sign));
        definite.or_else(|| all().next()).map(|(i, _)| i)
    }

    /// Returns the factors of a divisor: symbols, known facts, errors 2ᵖ + 1 + e, and the rest.
    fn divisor(&self, of: &Polynomial, state: &State) -> Option<Vec<Polynomial>> {
        let mut rest = self.dictionary.opaque_poly(of);
        let common = Poly::from(rest.common_monomial());
        let mut candidates: Vec<Poly> = common.symbols().into_iter().map(Poly::symbol).collect();
        let strict = state.facts.iter().filter(|(of, sign)| sign.is_strict() && of.terms().len() > 1);
        candidates.extend(strict.map(|(of, _)| self.dictionary.opaque_poly(of)));
        candidates.extend(self.largest_errors(&rest));
        let mut factors = Vec::new();
        for factor in candidates {
            while let Some(quotient) = rest.over(&factor).filter(is_integral) {
                rest = quotient;
                factors.push(factor.clone());
            }
        }
        if !rest.is_one() {
            factors.push(rest);
        }
        factors.iter().map(|factor| self.dictionary.polynomial(factor, 0, state)).collect()
    }

    /// Returns 2ᵖ + 1 + e for each error in a polynomial.
    pub fn largest_errors(&self, of: &Poly) -> Vec<Poly> {
        let largest = Poly::symbol(Symbol::Own(PRECISION)) + Poly::constant(1);
        let is_error = |x: &Symbol| {
            let variable = self.dictionary.variable(*x);
            variable.is_some_and(|x| matches!(self.problem.table.atoms()[x], Atom::Error(_)))
        };
        of.symbols().into_iter().filter(is_error).map(|x| &largest + Poly::symbol(x)).collect()
    }

    /// Returns an earlier formula that a rounded formula is a power of two times.
    fn same_rounding(&self, value: &Quotient, state: &State) -> Option<Same> {
        let (own, scale) = without_scales(&self.reduced_quotient(value, state)?);
        for (i, known) in state.rounded.iter().enumerate() {
            if self.errors(&known.value.num) != self.errors(&value.num) {
                continue;
            }
            let (other, before) = without_scales(&self.reduced_quotient(&known.value, state)?);
            if (&other - &own).is_zero() {
                let factor = scale.over(&before)?;
                let [up, down] =
                    [factor.num(), factor.den()].map(|of| self.dictionary.polynomial(of, 0, state));
                return Some(Same { rounding: i, up: up?, down: down? });
            }
        }
        None
    }

    /// Returns the translation of the absolute value of a formula.
    fn size(&self, of: usize, value: &Quotient, state: &State) -> Option<AbsoluteValue> {
        let Some(size) = self.context.size(&self.reduced_quotient(value, state)?) else {
            return Some(AbsoluteValue::BySign);
        };
        let variable = self.dictionary.variable(size)?;
        match state.sizes.iter().position(|known| known.size == variable) {
            Some(i) => Some(AbsoluteValue::Same(i)),
            None => {
                let own = self.problem.table.variable(Atom::Size(of)).ok()?;
                (own == variable).then_some(AbsoluteValue::Atom)
            }
        }
    }

    fn reduced_quotient(&self, of: &Quotient, state: &State) -> Option<Ratio> {
        let value = self.dictionary.ratio(of, state);
        let [num, den] = [value.num(), value.den()].map(|part| self.reduced(part));
        num.over(&den)
    }

    /// Returns the errors in a polynomial.
    fn errors(&self, of: &Polynomial) -> Vec<usize> {
        let atoms = self.problem.table.atoms().iter().enumerate();
        let errors = atoms.filter(|(x, atom)| matches!(atom, Atom::Error(_)) && of.degree(*x) > 0);
        errors.map(|(x, _)| x).collect()
    }
}

/// Returns `true` if no other sign implies this one.
fn is_definite(sign: Sign) -> bool {
    sign.is_strict() || sign == Sign::Zero
}

fn is_integral(of: &Poly) -> bool {
    of.terms().all(|(_, number)| number.to_rational().is_integer())
}

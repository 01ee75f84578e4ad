//! Proved bounds of rounding errors, found by bisection.
//!
//! Each rounded result of a formula has a symbol and a bound of its distance from the exact value: K/2ᵖ, or
//! K |x|/2ᵖ for a value x of known sign if that is not weaker. The smallest K that is proved from the
//! previous bounds is found by bisection, which need not be trusted: the result contains a proof of the whole
//! chain.

use super::check::{self, Proof};
use super::prove;
use super::search::{ProofError, prove_proposition};
use crate::formula::claim::{PRECISION, within};
use crate::formula::statement::{Proposition, minimum_precision};
use crate::formula::symbols::subscripted;
use crate::formula::{Hypothesis, Relation, Statement};
use crate::number::tree::Op;
use crate::number::{Field, Tree};
use rayon::iter::Either;
use rayon::prelude::*;
use std::collections::BTreeSet;

/// A proved bound of the rounding error of a formula.
#[derive(Clone, Debug)]
pub struct RoundingBound {
    constant: f64,
    proof: Proof,
}

impl RoundingBound {
    /// Returns K, exactly.
    pub fn constant(&self) -> f64 {
        self.constant
    }

    /// Returns the proof, whose statement names each rounded result.
    pub fn proof(&self) -> &Proof {
        &self.proof
    }
}

/// Error of a search for a bound.
#[derive(Clone, Debug, thiserror::Error)]
#[error("no bound of the rounding error of {formula} was found: {reason}")]
pub struct RoundingBoundError {
    /// First formula without a bound of its rounding error.
    pub formula: Tree,
    /// The reason.
    pub reason: ProofError,
}

/// Returns the smallest constant K, up to 2 %, for which |fl(f) − f| ≤ K m/2ᵖ is proved from hypotheses for
/// every precision p, with its proof. Here fl(f) is `of` with [each operation rounded](Tree::with_rounding),
/// and m is `scale`: 1 for an absolute bound, f > 0 itself for a relative one.
///
/// The model is that of [`prove`]: rounding to nearest without underflow and overflow. K is smaller if the
/// hypotheses require a higher precision.
///
/// # Examples
///
/// ```
/// use provable::formula::{Hypothesis, Relation, claim::PRECISION};
/// use provable::number::{Field, Tree};
/// use provable::proof::rounding_bound;
///
/// let x = Tree::symbol("x");
/// let in_interval = Hypothesis::between(&x, 1, 2);
/// let half_or_more = Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << 11));
/// let inverse = Tree::int(1) / (Tree::int(1) + &x);
/// let bound = rounding_bound(&inverse, &Tree::int(1), &[in_interval, half_or_more])?;
/// // Half of a unit in the last place of 1/2 for the quotient, and as much for the sum.
/// assert!(1.0 <= bound.constant() && bound.constant() <= 1.03);
/// # Ok::<(), provable::proof::RoundingBoundError>(())
/// ```
/// # Errors
/// Returns the first formula for which no bound is found, with the reason.
pub fn rounding_bound(
    of: &Tree,
    scale: &Tree,
    hypotheses: &[Hypothesis],
) -> Result<RoundingBound, RoundingBoundError> {
    let forms = [Form::Absolute, Form::Relative, Form::Opaque].into_par_iter();
    let bounds = forms.map(|form| Chain::new(of, hypotheses, form).bound(of, scale));
    let (mut errors, mut claims): (Vec<_>, Vec<_>) = bounds.partition_map(|bound| match bound {
        Ok(claim) => Either::Right(claim),
        Err(error) => Either::Left(error),
    });
    claims.sort_by(|(a, _), (b, _)| f64::total_cmp(a, b));
    for (constant, claim) in claims {
        match prove(&claim) {
            Ok(proof) => return Ok(RoundingBound { constant, proof }),
            Err(reason) => errors.push(RoundingBoundError { formula: exact(of), reason }),
        }
    }
    Err(errors.swap_remove(0))
}

/// Form of the bounds in a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// K/2ᵖ
    Absolute,
    /// K |x|/2ᵖ if the sign of the value x is known, otherwise K/2ᵖ.
    Relative,
    /// K/2ᵖ with symbols and intervals for exact values as well, which makes formulas shorter but loses the
    /// dependence between values.
    Opaque,
}

/// Returns a formula without its roundings.
fn exact(of: &Tree) -> Tree {
    of.rewrite(&|tree| if let Op::Rounded(of) = tree.op() { Some(of.clone()) } else { None })
}

/// m 2ⁿ, with 64 ≤ m ≤ 128 or m = 0.
type Number = (i32, i32);

/// Returns a number as a formula in lowest terms.
fn number((mut m, mut n): Number) -> Tree {
    while n < 0 && m % 2 == 0 && m != 0 {
        (m, n) = (m / 2, n + 1);
    }
    match n {
        ..0 => Tree::int(m) / power_of_two(-n),
        0..24 => Tree::int(m << n),
        _ => Tree::int(m) * power_of_two(n),
    }
}

/// Returns 2ⁿ for n ≥ 0, as a product of integers up to 2²⁴.
fn power_of_two(n: i32) -> Tree {
    (0..n / 24).fold(Tree::int(1 << (n % 24)), |product, _| product * Tree::int(1 << 24))
}

/// Absolute exponent from which on no larger power of two is tried.
const POWERS: i32 = 60;

/// Returns the smallest number for which a monotone predicate holds.
fn least<E>(holds: impl Fn(&Tree) -> Result<(), E>) -> Result<Number, E> {
    // Steps are doubled until they pass the power, then halved.
    let (mut above, mut below, mut step, mut first) = (0, 0, 1, None);
    if holds(&number((64, 0))).is_ok() {
        while holds(&number((64, below))).is_ok() {
            if below < -POWERS {
                return holds(&number((0, 0))).map(|()| (0, 0)).or(Ok((64, below)));
            }
            (above, below, step) = (below, below - step, 2 * step);
        }
    } else {
        while let Err(reason) = holds(&number((64, above))) {
            if above > POWERS {
                return Err(first.unwrap_or(reason));
            }
            first.get_or_insert(reason);
            (below, above, step) = (above, above + step, 2 * step);
        }
    }
    while above - below > 1 {
        let middle = (above + below).div_euclid(2);
        if holds(&number((64, middle))).is_ok() { above = middle } else { below = middle }
    }
    let (mut more, mut less) = (128, 64);
    while more - less > 1 {
        let middle = (more + less) / 2;
        if holds(&number((middle, below))).is_ok() { more = middle } else { less = middle }
    }
    Ok((more, below))
}

/// A part of a formula that is expressed by a symbol.
struct NamedPart {
    part: Tree,
    /// The part as an expression of the symbol.
    by_symbol: Tree,
    symbol: Tree,
    /// The definition of the symbol.
    definition: Tree,
    interval: Hypothesis,
}

/// The bounds found so far, each of which rests on the previous ones.
struct Chain {
    hypotheses: Vec<Hypothesis>,
    form: Form,
    named: Vec<NamedPart>,
    used_names: BTreeSet<&'static str>,
}

impl Chain {
    fn new(of: &Tree, hypotheses: &[Hypothesis], form: Form) -> Self {
        // Hypotheses on the precision come first.
        let mut hypotheses: Vec<_> = hypotheses.iter().cloned().chain([minimum_precision()]).collect();
        hypotheses.sort_by_key(|h| !h.value.symbols().contains(PRECISION));
        let used_names = hypotheses.iter().map(|h| &h.value).chain([of]).flat_map(Tree::symbols).collect();
        Chain { hypotheses, form, named: Vec::new(), used_names }
    }

    /// Returns the constant and the claim about the whole formula.
    fn bound(mut self, of: &Tree, scale: &Tree) -> Result<(f64, Statement), RoundingBoundError> {
        let formula = exact(of);
        let rounded = if of.contains_rounding() { of.clone() } else { of.with_rounding() };
        for rounding in check::roundings([&rounded].into_iter()) {
            let result = rounding.round();
            if result != rounded {
                let named = self.name_result(&result);
                named.map_err(|reason| RoundingBoundError { formula: exact(&result), reason })?;
            }
        }
        let (value, scale) = (self.value(&formula), self.value(scale));
        let error = self.computed(&rounded) - value;
        let constant =
            self.constant(&error, &scale).map_err(|reason| RoundingBoundError { formula, reason })?;
        let claim = within("rounding-error", error, bound(constant, &scale)).assuming(&self.hypotheses);
        let claim = self.named.iter().fold(claim, |claim, NamedPart { symbol, definition, interval, .. }| {
            claim.assuming([interval]).computing(symbol, definition)
        });
        Ok((f64::from(constant.0) * 2.0_f64.powi(constant.1), claim))
    }

    /// Names a rounded result, and bounds its error.
    fn name_result(&mut self, result: &Tree) -> Result<(), ProofError> {
        let (computed, value) = (self.computed(result), self.value(&exact(result)));
        let error = &computed - &value;
        let bound = match self.relative_bound(&error, &value) {
            Some(bound) => bound,
            None => bound(self.constant(&error, &Tree::int(1))?, &Tree::int(1)),
        };
        if self.form == Form::Opaque {
            let (middle, half) = self.interval(&value)?;
            let exact = self.new_symbol('w');
            let interval = Hypothesis::near(&exact, middle, half);
            self.name_as(value.clone(), exact.clone(), exact.clone(), value, interval);
            let symbol = self.new_symbol('d');
            let interval = Hypothesis::near(&symbol, 0, bound);
            self.name_as(computed, exact + &symbol, symbol, error, interval);
        } else {
            let symbol = self.new_symbol('v');
            let interval = Hypothesis::near(&symbol, value, bound);
            self.name_as(computed.clone(), symbol.clone(), symbol, computed, interval);
        }
        Ok(())
    }

    /// Returns a bound of an error relative to the value, if bounds may be relative and its sign is proved.
    fn relative_bound(&self, error: &Tree, value: &Tree) -> Option<Tree> {
        let mut sizes = [value.clone(), -value].into_iter().filter(|_| self.form == Form::Relative);
        let size =
            sizes.find(|of| self.proves(Proposition::Sign(Relation::NonNegative, of.clone())).is_ok())?;
        Some(bound(self.constant(error, &size).ok()?, &size))
    }

    fn name_as(&mut self, part: Tree, by_symbol: Tree, symbol: Tree, definition: Tree, interval: Hypothesis) {
        self.named.push(NamedPart { part, by_symbol, symbol, definition, interval });
    }

    fn new_symbol(&mut self, letter: char) -> Tree {
        let mut names = (0..=u8::MAX).map(|index| subscripted(letter, index));
        let name = names
            .find(|name| self.used_names.insert(name))
            .expect("no formula within the limits has as many");
        Tree::symbol(name)
    }

    /// Returns the midpoint of an interval of a value, and half its width.
    fn interval(&self, of: &Tree) -> Result<(Tree, Tree), ProofError> {
        let size = number(least(|k| self.proves(Proposition::Within(of.clone(), k.clone())))?);
        let (lower, upper) = (-self.upper_bound(&-of, &size)?, self.upper_bound(of, &size)?);
        Ok([&upper + &lower, upper - lower].map(|sum| sum / Tree::int(2)).into())
    }

    /// Returns an upper bound of a value whose absolute value is at most `size`.
    fn upper_bound(&self, of: &Tree, size: &Tree) -> Result<Tree, ProofError> {
        let sum = least(|k| self.proves(Proposition::Sign(Relation::NonNegative, k - size - of)))?;
        Ok(number(sum) - size)
    }

    /// Returns a rounded formula with symbols for its rounded parts.
    fn computed(&self, of: &Tree) -> Tree {
        self.by_symbols(of, true)
    }

    /// Returns an exact formula with symbols for its opaque parts.
    fn value(&self, of: &Tree) -> Tree {
        self.by_symbols(of, false)
    }

    fn by_symbols(&self, of: &Tree, rounded: bool) -> Tree {
        of.rewrite(&|tree| {
            let part = self
                .named
                .iter()
                .find(|named| matches!(named.part.op(), Op::Rounded(_)) == rounded && named.part == *tree)?;
            Some(part.by_symbol.clone())
        })
    }

    /// Returns the smallest K for which |error| ≤ K m/2ᵖ is proved.
    fn constant(&self, error: &Tree, scale: &Tree) -> Result<Number, ProofError> {
        least(|k| self.proves(Proposition::Within(error.clone(), k * scale / Tree::symbol(PRECISION))))
    }

    /// Tries to prove a proposition from the hypotheses and the intervals of the symbols on which it depends.
    fn proves(&self, proposition: Proposition) -> Result<(), ProofError> {
        let mut symbols: BTreeSet<_> = proposition.trees().into_iter().flat_map(Tree::symbols).collect();
        let mut intervals = Vec::new();
        for NamedPart { symbol, interval, .. } in self.named.iter().rev() {
            if symbol.first_symbol().is_some_and(|name| symbols.contains(name)) {
                symbols.extend(interval.value.symbols());
                intervals.push(interval);
            }
        }
        let hypotheses: Vec<_> = self.hypotheses.iter().chain(intervals.into_iter().rev()).collect();
        prove_proposition(&proposition, hypotheses).map(drop)
    }
}

/// Returns K m/2ᵖ.
fn bound(constant: Number, scale: &Tree) -> Tree {
    number(constant) * scale / Tree::symbol(PRECISION)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::tree::piecewise_ops;
    use crate::number::{Exact, symbols};

    fn at_least(bits: u32) -> Hypothesis {
        Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::int(1 << bits))
    }

    /// Returns both sides of a statement with its definitions substituted.
    fn spelled_out(statement: &Statement) -> (Tree, Tree) {
        let Proposition::Within(of, bound) = &statement.goals().last().unwrap().proposition else { panic!() };
        statement.computed().iter().rev().fold((of.clone(), bound.clone()), |(of, bound), computed| {
            let definition = [(computed.symbol, computed.formula.clone())];
            (of.substitute(&definition), bound.substitute(&definition))
        })
    }

    #[test]
    fn numbers_are_in_lowest_terms() {
        let texts = [(98, -3), (64, -6), (0, -3), (65, 0), (64, 30)].map(|n| number(n).to_string());
        assert_eq!(texts, ["49 / 4", "1", "0", "65", "68719476736"]);
        // The text is reduced in any case; the tree is written for Coq as it is.
        assert_eq!(number((98, -3)), Tree::int(49) / Tree::int(4));
        assert_eq!(number((64, -6)), Tree::int(1));
    }

    #[test]
    fn every_form_bounds_the_error_of_the_rounded_formula() {
        let [x, y] = symbols(["x", "y"]);
        let one = Tree::int(1);
        let in_intervals = [Hypothesis::between(&x, -2, 3), Hypothesis::between(&y, 1, 4)];
        let squares = &x * &x + &y;
        for of in
            [&x / &y - &one, &squares / (&squares + &one), -(&x * &y), x.clone(), (&x + &y).round() * &x]
        {
            let assumed = [&in_intervals[..], &[at_least(11)]].concat();
            for form in [Form::Absolute, Form::Relative, Form::Opaque] {
                let found = Chain::new(&of, &assumed, form).bound(&of, &one);
                // For the quotient of squares only one form is short enough to be proved.
                let Ok((constant, claim)) = found else {
                    assert!(form != Form::Opaque && of.size() > 10, "{form:?} of {of}");
                    continue;
                };
                assert!(prove(&claim).is_ok(), "{form:?} of {of}: {}", prove(&claim).unwrap_err());
                let (error, bound) = spelled_out(&claim);
                let rounded = if of.contains_rounding() { of.clone() } else { of.with_rounding() };
                // Both are the same when rounded to f32, except for the error of f64 below 100.
                let rounding = |step: Op<&f64>| match step {
                    Op::Rounded(x) => Some(f64::from(*x as f32)),
                    step => piecewise_ops(step),
                };
                let exact_error = rounded - exact(&of);
                for at in [(-1.7, 3.3), (0.1, 1.1), (2.9, 1.9)] {
                    let at = |name| if name == "x" { at.0 } else { at.1 };
                    let [a, b] = [&error, &exact_error].map(|tree| tree.eval(&at, &rounding).unwrap());
                    assert!(
                        (a - b).abs() < 1e-12 && (a != 0.0 || !of.with_rounding().contains_rounding()),
                        "{of} by {form:?}: {a} {b}"
                    );
                }
                let at_one = bound.eval(&|_| Exact::int(1), &piecewise_ops).unwrap();
                assert_eq!(at_one, Exact::from(rug::Rational::from_f64(constant).unwrap()));
            }
        }
    }

    #[test]
    fn bounds_match_known_constants() {
        let [x, y] = symbols(["x", "y"]);
        let positive = [&x, &y].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
        let bound = |of: &Tree, scale: &Tree, assumed: &[Hypothesis]| {
            rounding_bound(of, scale, &[assumed, &[at_least(24)]].concat()).map(|bound| bound.constant())
        };
        // One, two and three roundings of terms with one sign, of any magnitude: the smallest K is 1, 2 and
        // 3.
        let (one, product, sum) = (Tree::int(1), &x * &y, &x * &y + &x);
        for (of, least) in [(&product, 1.0), (&sum, 2.0), (&(&sum / &y), 3.0)] {
            let found = bound(of, of, &positive).unwrap();
            assert!(least * 0.999 < found && found <= least * 1.02, "{of}: {found}");
        }
        // Without an interval, with cancellation, or if a divisor may vanish, no bound exists.
        assert!(bound(&product, &one, &positive).is_err());
        let difference = &x * &y - &x;
        assert!(bound(&difference, &difference, &positive).is_err());
        let around_zero = Hypothesis::between(&x, -1, 1);
        let refused = bound(&(&one / &x), &one, &[around_zero]).unwrap_err();
        assert!(
            matches!(refused.reason, ProofError::PossibleZeroDivisor(..)) && refused.formula == &one / &x,
            "{refused}"
        );
        let text = format!("no bound of the rounding error of 1 / x was found: {}", refused.reason);
        assert_eq!(refused.to_string(), text);
        // Nothing is rounded.
        assert_eq!(bound(&x, &one, &[]).unwrap(), 0.0);
    }

    #[test]
    fn the_smallest_number_is_found_up_to_one_part_in_64() {
        let value = |tree: &Tree| tree.eval(&|_| f64::NAN, &piecewise_ops).unwrap();
        for limit in [0.0, 1e-16, 0.9, 1.0, 1.01, 63.5, 64.0, 127.9, 1e6, 3e11, 1e19] {
            let found = value(&number(least(|k| if value(k) >= limit { Ok(()) } else { Err(()) }).unwrap()));
            assert!(limit <= found && found <= limit * 65.0 / 64.0, "{found} for {limit}");
        }
        assert_eq!(least(|_| Err::<(), _>("never")), Err("never"));
    }
}

//! Proved bounds of rounding errors, found by bisection.
//!
//! Each rounded result of a formula has a symbol and a bound of its distance from the exact value: K/2ᵖ, or K
//! |x|/2ᵖ for a value x of known sign if that is not weaker. The smallest K that is proved from the
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
use std::fmt;

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
#[derive(Clone, Debug)]
pub struct RoundingBoundError {
    /// First formula without a bound of its rounding error.
    pub formula: Tree,
    /// The reason.
    pub reason: ProofError,
}

impl fmt::Display for RoundingBoundError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "no bound of the rounding error of {} was found: {}", self.formula, self.reason)
    }
}

impl std::error::Error for RoundingBoundError {}

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
    let all = forms.map(|form| Chain::new(of, hypotheses, form).bound(of, scale));
    let (mut failed, mut found): (Vec<_>, Vec<_>) = all.partition_map(|chain| match chain {
        Ok(found) => Either::Right(found),
        Err(failed) => Either::Left(failed),
    });
    found.sort_by(|(a, _), (b, _)| f64::total_cmp(a, b));
    for (constant, claim) in found {
        match prove(&claim) {
            Ok(proof) => return Ok(RoundingBound { constant, proof }),
            Err(reason) => failed.push(RoundingBoundError { formula: exact(of), reason }),
        }
    }
    Err(failed.swap_remove(0))
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
    of.rewrite(&|tree| match tree.op() {
        Op::Rounded(of) => Some(of.clone()),
        _ => None,
    })
}

/// m 2ⁿ, with 64 ≤ m ≤ 128 or m = 0.
type Number = (i32, i32);

fn number((mut m, mut n): Number) -> Tree {
    while n < 0 && m % 2 == 0 && m != 0 {
        (m, n) = (m / 2, n + 1);
    }
    let power = |n: i32| (0..n / 24).fold(Tree::int(1 << (n % 24)), |all, _| all * Tree::int(1 << 24));
    match n {
        ..0 => Tree::int(m) / power(-n),
        0..24 => Tree::int(m << n),
        _ => Tree::int(m) * power(n),
    }
}

/// Absolute exponent from which on no larger power of two is tried.
const POWERS: i32 = 60;

/// Returns the smallest number for which a monotone predicate holds.
fn least<E>(holds: impl Fn(&Tree) -> Result<(), E>) -> Result<Number, E> {
    let is = |m: i32, n: i32| holds(&number((m, n)));
    // Steps are doubled until they pass the power, then halved.
    let (mut above, mut below, mut step, mut first) = (0, 0, 1, None);
    if is(64, 0).is_ok() {
        while is(64, below).is_ok() {
            if below < -POWERS {
                return is(0, 0).map(|()| (0, 0)).or(Ok((64, below)));
            }
            (above, below, step) = (below, below - step, 2 * step);
        }
    } else {
        while let Err(reason) = is(64, above) {
            if above > POWERS {
                return Err(first.unwrap_or(reason));
            }
            first.get_or_insert(reason);
            (below, above, step) = (above, above + step, 2 * step);
        }
    }
    while above - below > 1 {
        let middle = (above + below).div_euclid(2);
        if is(64, middle).is_ok() { above = middle } else { below = middle }
    }
    let (mut more, mut less) = (128, 64);
    while more - less > 1 {
        let middle = (more + less) / 2;
        if is(middle, below).is_ok() { more = middle } else { less = middle }
    }
    Ok((more, below))
}

/// A computed quantity that is part of a formula.
struct NamedTree {
    part: Tree,
    by_symbol: Tree,
    symbol: Tree,
    by: Tree,
    interval: Hypothesis,
}

/// Bounds found so far.
struct Chain {
    hypotheses: Vec<Hypothesis>,
    form: Form,
    named: Vec<NamedTree>,
    taken: BTreeSet<&'static str>,
}

impl Chain {
    fn new(of: &Tree, hypotheses: &[Hypothesis], form: Form) -> Self {
        // Hypotheses on the precision come first.
        let is_other = |h: &Hypothesis| !h.value.symbols().contains(PRECISION);
        let mut hypotheses: Vec<_> = hypotheses.iter().cloned().chain([minimum_precision()]).collect();
        hypotheses.sort_by_key(is_other);
        let taken = hypotheses.iter().map(|h| &h.value).chain([of]).flat_map(Tree::symbols).collect();
        Chain { hypotheses, form, named: Vec::new(), taken }
    }

    fn bound(mut self, of: &Tree, scale: &Tree) -> Result<(f64, Statement), RoundingBoundError> {
        let formula = exact(of);
        let no_bound = |reason| RoundingBoundError { formula: formula.clone(), reason };
        let rounded = if of.contains_rounding() { of.clone() } else { of.with_rounding() };
        for rounding in check::roundings([&rounded].into_iter()) {
            let node = rounding.round();
            if node != rounded {
                self.name(&node)?;
            }
        }
        let (value, scale) = (self.value(&formula), self.value(scale));
        let error = self.computed(&rounded) - value;
        let constant = self.constant(&error, &scale).map_err(no_bound)?;
        let claim = within("rounding-error", error, bounding(constant, &scale)).assuming(&self.hypotheses);
        let claim = self.named.iter().fold(claim, |claim, NamedTree { symbol, by, interval, .. }| {
            claim.assuming([interval]).computing(symbol, by)
        });
        Ok((f64::from(constant.0) * 2.0_f64.powi(constant.1), claim))
    }

    /// Adds a rounded result with a bound of its error.
    fn name(&mut self, node: &Tree) -> Result<(), RoundingBoundError> {
        let (formula, computed) = (exact(node), self.computed(node));
        let no_bound = |reason| RoundingBoundError { formula: formula.clone(), reason };
        let value = self.value(&formula);
        let has_sign = |of: &Tree| self.proves(Proposition::Sign(Relation::NonNegative, of.clone())).is_ok();
        let error = &computed - &value;
        let by = |size: Tree| Ok((self.constant(&error, &size)?, size));
        let sizes = [value.clone(), -&value].into_iter().filter(|_| self.form == Form::Relative);
        let relative = sizes.into_iter().find(has_sign).and_then(|size| by(size).ok());
        let (constant, size) = relative.map_or_else(|| by(Tree::int(1)), Ok).map_err(no_bound)?;
        let most = bounding(constant, &size);
        if self.form == Form::Opaque {
            let (middle, half) = self.interval(&value).map_err(no_bound)?;
            let exact = self.fresh('w');
            let within = Hypothesis::near(&exact, middle, half);
            self.name_as(value.clone(), exact.clone(), exact.clone(), value, within);
            let symbol = self.fresh('d');
            let near = Hypothesis::near(&symbol, 0, most);
            self.name_as(computed, exact + &symbol, symbol, error, near);
        } else {
            let symbol = self.fresh('v');
            let near = Hypothesis::near(&symbol, value, most);
            self.name_as(computed.clone(), symbol.clone(), symbol, computed, near);
        }
        Ok(())
    }

    fn name_as(&mut self, part: Tree, by_symbol: Tree, symbol: Tree, by: Tree, interval: Hypothesis) {
        self.named.push(NamedTree { part, by_symbol, symbol, by, interval });
    }

    fn fresh(&mut self, letter: char) -> Tree {
        let mut names = (0..=u8::MAX).map(|index| subscripted(letter, index));
        let name =
            names.find(|name| self.taken.insert(name)).expect("no formula within the limits has as many");
        Tree::symbol(name)
    }

    /// Returns the midpoint of an interval of a value, and half its width.
    fn interval(&self, of: &Tree) -> Result<(Tree, Tree), ProofError> {
        let most = number(least(|k| self.proves(Proposition::Within(of.clone(), k.clone())))?);
        let beyond = |of: &Tree| {
            let margin = |k: &Tree| self.proves(Proposition::Sign(Relation::NonNegative, k - &most - of));
            Ok::<_, ProofError>(number(least(margin)?) - &most)
        };
        let (lower, upper) = (-beyond(&-of)?, beyond(of)?);
        Ok([&upper + &lower, upper - lower].map(|sum| sum / Tree::int(2)).into())
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
        let named = || self.named.iter().filter(|named| matches!(named.part.op(), Op::Rounded(_)) == rounded);
        of.rewrite(&|tree| named().find(|named| named.part == *tree).map(|named| named.by_symbol.clone()))
    }

    /// Returns the smallest K for which |error| ≤ K m/2ᵖ is proved.
    fn constant(&self, error: &Tree, scale: &Tree) -> Result<Number, ProofError> {
        least(|k| self.proves(Proposition::Within(error.clone(), k * scale / Tree::symbol(PRECISION))))
    }

    fn proves(&self, proposition: Proposition) -> Result<(), ProofError> {
        // Symbols in the proposition, and in their intervals.
        let mut symbols: BTreeSet<_> = proposition.trees().into_iter().flat_map(Tree::symbols).collect();
        let mut intervals = Vec::new();
        for NamedTree { symbol, interval, .. } in self.named.iter().rev() {
            if symbol.first_symbol().is_some_and(|name| symbols.contains(name)) {
                symbols.extend(interval.value.symbols());
                intervals.push(interval);
            }
        }
        let hypotheses: Vec<_> = self.hypotheses.iter().chain(intervals.into_iter().rev()).collect();
        prove_proposition(&proposition, hypotheses).map(drop)
    }
}

/// K m/2ᵖ
fn bounding(constant: Number, scale: &Tree) -> Tree {
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

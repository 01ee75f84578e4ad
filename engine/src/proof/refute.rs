//! The search for a counterexample: values of the symbols for which a statement does not hold.
//!
//! The formulas of a statement are evaluated at points with small rational coordinates, of two kinds:
//!
//! - *constructed* points are drawn at random, then adjusted to one hypothesis after the other;
//! - *integer* points have small integer coordinates and are used if the hypotheses happen to hold. They
//!   often meet coincidences such as c + ε = 0, and they are independent of the method of proofs, which also
//!   solves each hypothesis for a quantity.
//!
//! All arithmetic is exact, except for eˣ, which is enclosed by a ball: a refuted statement is certainly
//! false.

use crate::formula::claim::{MEMBERS, POWER, PRECISION};
use crate::formula::statement::{Proposition, Role, Sequence, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{Op, all_ops, smooth_ops};
use crate::number::{Exact, PositivePart, Tree};
use num_traits::{One, Zero};
use rug::Float;
use std::cmp::Ordering;
use std::fmt;
use std::sync::OnceLock;

mod point;
mod sequence;
mod shrink;
mod value;

pub use point::{Point, constructed_points, integer_points};
use sequence::{STEPS, bound_fraction, check_recursion, is_constant, with_computed};
use shrink::shrink;
pub use value::Value;

/// The evaluation of a statement at one point.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// A hypothesis does not hold at the point, or is undefined.
    Excluded,
    /// All goals hold.
    Holds,
    /// A goal cannot be decided because rounding errors hide a sign.
    Undecided,
    /// A goal does not hold: the part of the claim, and the failure.
    Fails(&'static str, Failure),
}

/// The failure of a goal at a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// This divisor is 0.
    Undefined(Tree),
    /// The two sides of an equation have these different values.
    Unequal(Value, Value),
    /// A quantity of this value does not have the required sign.
    Sign(Relation, Value),
    /// The absolute value of the first number exceeds the second, its bound.
    BoundExceeded(Value, Value),
    /// The distance from the limit does not decrease: its value far out.
    NotConverging(Value),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Failure::Undefined(divisor) if divisor.to_string() == "0" => {
                f.write_str("undefined: 0 is a divisor")
            }
            Failure::Undefined(divisor) => write!(f, "undefined: {divisor} = 0 is a divisor"),
            Failure::Unequal(left, right) => match [format_short(left), format_short(right)] {
                // Values that agree in the printed digits are printed in full.
                [short, same] if short == same => write!(f, "{left} ≠ {right}"),
                [left, right] => write!(f, "{left} ≠ {right}"),
            },
            Failure::Sign(relation, value) => write!(f, "{} is not {relation} 0", format_short(value)),
            Failure::BoundExceeded(of, bound) => {
                write!(f, "|{}| is larger than {}", format_short(of), format_short(bound))
            }
            Failure::NotConverging(distance) => {
                write!(f, "its distance from the limit is still {}", format_short(distance))
            }
        }
    }
}

/// Formats a value, a long one with four digits.
fn format_short(value: &Value) -> String {
    const MAX_LENGTH: usize = 24;
    let text = value.to_string();
    match value {
        Value::Exact(x) if text.len() > MAX_LENGTH => {
            format!("≈ {}", Float::with_val(64, x.as_rational()).to_string_radix(10, Some(4)))
        }
        Value::Exact(_) | Value::Ball(_) => text,
    }
}

/// A point at which a statement does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// Values of the symbols in the statement.
    pub point: Point,
    /// The part of the claim that fails; empty if the claim has one part.
    pub part: &'static str,
    /// The failure.
    pub failure: Failure,
}

/// A statement with a counterexample as the search found it.
#[derive(Clone, Debug)]
pub struct Refutation {
    statement: Box<Statement>,
    found: Box<Counterexample>,
}

impl Refutation {
    /// Returns a counterexample with simpler numbers, as far as such are found.
    pub fn counterexample(&self) -> Counterexample {
        shrink(&self.statement, (*self.found).clone())
    }
}

/// Formats the numbers and the failure.
impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let colon = if self.point == Point::default() { "" } else { ": " };
        write!(f, "{}{colon}{}", self.point, self.failure)
    }
}

/// Evaluates a formula at a point; `None` if a divisor is 0.
fn value(tree: &Tree, point: &Point) -> Option<Value> {
    let n = point.at(PRECISION);
    tree.eval(&|name| Value::Exact(point.at(name)), &|step| match step {
        // An enclosed value may round to either of two numbers.
        Op::Rounded(Value::Exact(x)) => point::nearest(x, &n).map(Value::Exact),
        step => all_ops(step),
    })
}

/// Evaluates a statement at a point.
pub fn check(statement: &Statement, point: &Point) -> Verdict {
    if point.satisfies(statement.hypotheses()) { check_goals(statement, point) } else { Verdict::Excluded }
}

/// Evaluates the goals of a statement at a point at which the hypotheses hold.
///
/// An induction concerns q = ρᵏ only, and its invariants are not part of the claim. If |ρ| ≥ 1, a sequence
/// still has the claimed limit if it is constant with that value.
fn check_goals(statement: &Statement, point: &Point) -> Verdict {
    if let Some(sequence) = statement.conclusion().filter(|sequence| sequence.is_perturbed()) {
        return check_recursion(statement, sequence, point).unwrap_or_else(|verdict| verdict);
    }
    let powers = match statement.conclusion() {
        Some(Sequence { ratio, limit: None, .. }) => {
            let ratio = exact_value(ratio, point);
            let next = |q: &Exact| Some(q * ratio.as_ref()?);
            std::iter::successors(Some(Exact::one()), next).take(STEPS).collect()
        }
        Some(Sequence { limit: Some(_), .. }) | None => vec![point.at(POWER)],
    };
    let point = &match with_computed(statement, point) {
        Ok(point) => point,
        Err(verdict) => return verdict,
    };
    let mut open = false;
    for q in powers {
        let point = point.with(POWER, q);
        let goals = statement.goals().iter().filter(|goal| matches!(goal.role, Role::Claim | Role::Step));
        for goal in goals {
            match check_proposition(&goal.proposition, &point) {
                Some(Some(Failure::Sign(..))) if is_constant(statement, &point) => {}
                Some(Some(how)) => return Verdict::Fails(goal.part, how),
                Some(None) => {}
                None => open = true,
            }
        }
    }
    if open { Verdict::Undecided } else { Verdict::Holds }
}

fn exact_value(tree: &Tree, point: &Point) -> Option<Exact> {
    match value(tree, point)? {
        Value::Exact(x) => Some(x),
        Value::Ball(_) => None,
    }
}

/// Returns the failure of a goal, if it fails; `None` if this cannot be decided.
fn check_proposition(says: &Proposition, point: &Point) -> Option<Option<Failure>> {
    let undefined =
        || says.trees().into_iter().find_map(|tree| zero_divisor(tree, point)).map(Failure::Undefined);
    let differ = |left: Option<Value>, right: Option<Value>| match (left, right) {
        (Some(left), Some(right)) => match (&left - &right).sign()? {
            Ordering::Equal => Some(None),
            Ordering::Less | Ordering::Greater => Some(Some(Failure::Unequal(left, right))),
        },
        _ => undefined().map(Some),
    };
    match says {
        Proposition::Equal(left, right) => differ(value(left, point), value(right, point)),
        Proposition::Sign(relation, of) => match value(of, point) {
            Some(value) => {
                let admitted = relation.admits(value.sign()?);
                Some((!admitted).then_some(Failure::Sign(*relation, value)))
            }
            None => undefined().map(Some),
        },
        Proposition::Within(of, bound) => match (value(of, point), value(bound, point)) {
            (Some(of), Some(bound)) => {
                let beyond = (&bound - of.abs()).sign()?.is_lt();
                Some(beyond.then_some(Failure::BoundExceeded(of, bound)))
            }
            _ => undefined().map(Some),
        },
        Proposition::Derivative(of, by, is) => {
            // Dual numbers have no derivative of ⟨·⟩ and min, which are not differentiable.
            let dual = of.derivative(by, &|name| Value::Exact(point.at(name)), &smooth_ops);
            differ(dual.map(|dual| dual.derivative), value(is, point))
        }
        // A quotient of polynomials behaves like a power of x beyond all its zeros and poles, and with
        // coefficients as small as here these lie below 2¹⁰⁰. A distance that tends to 0 decreases like 1/x
        // or faster, so by a factor 2⁻¹⁰⁰ or less from 2¹⁰⁰ to 2²⁰⁰; any other does not decrease.
        Proposition::Limit(of, by, to) => {
            let distance = |n| {
                let point = point.with(by, Exact::power_of_two(n));
                let distance = value(of, &point).zip(value(to, &point)).map(|(of, to)| of - to);
                distance.ok_or_else(|| says.trees().into_iter().find_map(|tree| zero_divisor(tree, &point)))
            };
            match (distance(100), distance(200)) {
                (Ok(near), Ok(far)) => {
                    let grown = &far * Value::Exact(Exact::power_of_two(50));
                    let decreases = (&near * &near - &grown * &grown).sign()?.is_ge();
                    Some((!decreases).then_some(Failure::NotConverging(far)))
                }
                (Err(divisor), _) | (_, Err(divisor)) => Some(Some(Failure::Undefined(divisor?))),
            }
        }
    }
}

/// Returns a divisor in the formula that is 0, innermost divisors first.
fn zero_divisor(tree: &Tree, point: &Point) -> Option<Tree> {
    tree.op().operands().find_map(|operand| zero_divisor(operand, point)).or_else(|| match tree.op() {
        Op::Div(_, divisor) => value(divisor, point)?.is_zero().then(|| divisor.clone()),
        _ => None,
    })
}

/// Number of drawn integer points of which the admissible ones are tried first.
const FIRST_INTEGER_POINTS: u64 = 200;

/// Number of constructed points that are tried first.
const FIRST_CONSTRUCTED_POINTS: usize = 4;

/// Searches for a counterexample with a divisor that is 0, by changing one coordinate of a point: most
/// divisors are linear in some coordinate.
fn divided_by_zero(statement: &Statement, point: &Point) -> Option<Refutation> {
    let mut divisors: Vec<&Tree> = Vec::new();
    for tree in statement.goals().iter().flat_map(|goal| goal.proposition.trees()) {
        tree.visit(&mut |tree| {
            if let Op::Div(_, divisor) = tree.op()
                && !divisors.contains(&divisor)
            {
                divisors.push(divisor);
            }
        });
    }
    let pairs =
        divisors.into_iter().flat_map(|divisor| divisor.symbols().into_iter().map(move |by| (divisor, by)));
    pairs.into_iter().find_map(|(divisor, by)| {
        let point = with_divisor_zero(divisor, by, point)?;
        point.satisfies(statement.hypotheses()).then(|| refute_at(statement, &point))?
    })
}

/// Changes one coordinate of a point so that a divisor is 0.
fn with_divisor_zero(divisor: &Tree, by: &'static str, point: &Point) -> Option<Point> {
    let x = divisor.solve_linear(by, &|symbol| point.at(symbol), &Exact::from(0))?;
    Some(point.with(by, x))
}

/// The points at which certain hypotheses hold.
pub(super) struct PointSet {
    hypotheses: Vec<Hypothesis>,
    symbols: Vec<&'static str>,
    /// The integer points and constructed points that are tried first.
    first: [Vec<Point>; 2],
    all: OnceLock<[Vec<Point>; 2]>,
}

impl PointSet {
    pub(super) fn of(hypotheses: Vec<Hypothesis>, symbols: Vec<&'static str>) -> Self {
        let integer = point::first_integer_points(FIRST_INTEGER_POINTS, &hypotheses, &symbols).collect();
        let constructed = constructed_points(&hypotheses, &symbols).take(FIRST_CONSTRUCTED_POINTS).collect();
        PointSet { hypotheses, symbols, first: [integer, constructed], all: OnceLock::new() }
    }

    /// Returns a refutation at one of the points that are tried first.
    pub(super) fn refute_at_first_points(&self, statement: &Statement) -> Option<Refutation> {
        let [integer, constructed] = &self.first;
        integer.iter().take(8).chain(constructed).find_map(|point| refute_at(statement, point))
    }

    /// Returns a refutation at one of the other points.
    pub(super) fn refute_at_other_points(&self, statement: &Statement) -> Option<Refutation> {
        let [integer, constructed] = &self.first;
        let at_integer = integer.iter().skip(8).find_map(|point| refute_at(statement, point));
        let at_pole = || constructed.iter().find_map(|point| divided_by_zero(statement, point));
        at_integer.or_else(at_pole).or_else(|| {
            let all = || {
                let integer = integer_points(&self.hypotheses, &self.symbols).collect();
                [integer, constructed_points(&self.hypotheses, &self.symbols).collect()]
            };
            self.all.get_or_init(all).iter().flatten().find_map(|point| refute_at(statement, point))
        })
    }
}

/// Returns a refutation if a goal fails at a point at which the hypotheses hold.
fn refute_at(statement: &Statement, point: &Point) -> Option<Refutation> {
    match check_goals(statement, point) {
        Verdict::Fails(part, how) => {
            let found = Counterexample { point: point.clone(), part, failure: how };
            Some(Refutation { statement: statement.clone().into(), found: found.into() })
        }
        Verdict::Excluded | Verdict::Holds | Verdict::Undecided => None,
    }
}

/// Returns the point, among a number of trials, at which a quantity attains the largest fraction of its
/// bound, and that fraction; `None` if the statement has no bounds.
pub fn tightest_point(statement: &Statement) -> Option<(Point, Exact)> {
    let symbols = symbols(statement);
    let integer = integer_points(statement.hypotheses(), &symbols).take(TIGHTEST_POINT_TRIALS);
    let points = integer.chain(constructed_points(statement.hypotheses(), &symbols));
    let shares = points.filter_map(|point| bound_fraction(statement, &point).map(|share| (point, share)));
    // Returns the first of several maxima, unlike `max_by`.
    let tightest = shares.min_by(|(_, a), (_, b)| b.cmp(a));
    tightest.map(|(point, share)| (point.restricted_to(&symbols.into_iter().collect()), share))
}

/// Number of integer points that [`sharpest`] tries.
const TIGHTEST_POINT_TRIALS: usize = 500;

/// Returns the independent symbols of a statement in order of occurrence, that is, without the members and
/// powers of a sequence and without computed quantities.
pub(super) fn symbols(statement: &Statement) -> Vec<&'static str> {
    let sequence = statement.conclusion().filter(|sequence| sequence.limit.is_none());
    let members = sequence.map_or(&[][..], |sequence| &MEMBERS[..sequence.step.len()]);
    let is_dependent = |name: &'static str| {
        let is_computed = statement.computed().iter().any(|computed| computed.symbol == name);
        is_computed || sequence.is_some() && name == POWER || members.contains(&name)
    };
    let mut symbols = Vec::new();
    for tree in statement.trees() {
        tree.visit(&mut |tree| {
            if let Op::Symbol(name) = tree.op()
                && !is_dependent(name)
                && !symbols.contains(name)
            {
                symbols.push(*name);
            }
        });
    }
    symbols
}

/// Searches for a counterexample.
///
/// `None` does not prove the statement. Statements that are too large for [`prove`](super::prove) are not
/// examined.
pub fn refute(statement: &Statement) -> Option<Counterexample> {
    super::kernel::check_size(statement.trees()).ok()?;
    let symbols = symbols(statement);
    let points = PointSet::of(statement.hypotheses().to_vec(), symbols);
    let refutation =
        points.refute_at_first_points(statement).or_else(|| points.refute_at_other_points(statement))?;
    Some(refutation.counterexample())
}

#[cfg(test)]
mod tests;

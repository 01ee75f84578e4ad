//! The search for a counterexample: numbers at which a statement does not hold.
//!
//! A statement's formulas are replayed at points with small rational coordinates. There are two kinds:
//!
//! - *planted* points are drawn, then bent until the hypotheses hold, one after the other;
//! - *raw* points are small integers, kept if the hypotheses happen to hold. They meet coincidences such as
//!   c + ε = 0 often, and share no mistake with a proof, which also bends a quantity to each hypothesis.
//!
//! All arithmetic is exact but for eˣ, which is a ball: what is refuted is false for certain.

use crate::formula::claim::{MEMBERS, POWER, PRECISION};
use crate::formula::statement::{Proposition, Role, Sequence, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{Step, everything, smooth};
use crate::number::{Exact, PositivePart, Tree};
use num_traits::{One, Zero};
use rug::Float;
use std::cmp::Ordering;
use std::fmt;
use std::sync::OnceLock;

mod point;
mod sequence;
mod smaller;
mod value;

pub use point::{Point, planted_points, raw_points};
use sequence::{STEPS, computed, follow, is_constant, share};
use smaller::smaller;
pub use value::Value;

/// What a statement comes to at one point.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// A hypothesis does not hold there, or is not defined.
    Excluded,
    /// All goals hold.
    Holds,
    /// Some goal cannot be decided: a sign is lost in rounding.
    Open,
    /// A goal does not hold: which part of the claim, and how it fails.
    Fails(&'static str, How),
}

/// How a goal fails.
#[derive(Clone, Debug, PartialEq)]
pub enum How {
    /// It divides by this, which is 0.
    Undefined(Tree),
    /// Its two sides are these.
    Different(Value, Value),
    /// This has not the sign.
    Sign(Relation, Value),
    /// The first is larger in size than the second.
    Beyond(Value, Value),
    /// It stays as far from its limit, or farther.
    Far(Value),
}

impl fmt::Display for How {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            How::Undefined(divisor) if divisor.to_string() == "0" => f.write_str("undefined: 0 is a divisor"),
            How::Undefined(divisor) => write!(f, "undefined: {divisor} = 0 is a divisor"),
            How::Different(left, right) => match [brief(left), brief(right)] {
                // What differs after so many digits only is written out.
                [short, same] if short == same => write!(f, "{left} ≠ {right}"),
                [left, right] => write!(f, "{left} ≠ {right}"),
            },
            How::Sign(relation, value) => write!(f, "{} is not {relation} 0", brief(value)),
            How::Beyond(of, bound) => write!(f, "|{}| is more than {}", brief(of), brief(bound)),
            How::Far(distance) => write!(f, "far out it is still {} off its limit", brief(distance)),
        }
    }
}

/// A value as text, of a long one four digits.
fn brief(value: &Value) -> String {
    const ROOM: usize = 24;
    let text = value.to_string();
    match value {
        Value::Exact(x) if text.len() > ROOM => {
            format!("≈ {}", Float::with_val(64, x.as_rational()).to_string_radix(10, Some(4)))
        }
        Value::Exact(_) | Value::Ball(_) => text,
    }
}

/// A point at which a statement does not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// Numbers for the symbols that occur in the statement.
    pub point: Point,
    /// Which part of the claim fails, if it has several.
    pub part: &'static str,
    /// And how.
    pub how: How,
}

/// A counterexample as it was found, with the statement that it refutes.
#[derive(Clone, Debug)]
pub struct Refutation {
    statement: Box<Statement>,
    found: Box<Counterexample>,
}

impl Refutation {
    /// Returns the counterexample with simpler numbers, as far as some are found.
    pub fn counterexample(&self) -> Counterexample {
        smaller(&self.statement, (*self.found).clone())
    }
}

/// The numbers, then how it fails.
impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let colon = if self.point == Point::default() { "" } else { ": " };
        write!(f, "{}{colon}{}", self.point, self.how)
    }
}

/// A formula at one point; `None` if it divides by 0 there.
fn value(tree: &Tree, point: &Point) -> Option<Value> {
    let n = point.at(PRECISION);
    tree.replay(&|name| Value::Exact(point.at(name)), &|step| match step {
        // What is enclosed only might round to either of two numbers.
        Step::Rounded(Value::Exact(x)) => point::nearest(x, &n).map(Value::Exact),
        step => everything(step),
    })
}

/// The statement at one point.
pub fn check(statement: &Statement, point: &Point) -> Verdict {
    if point.satisfies(statement.hypotheses()) { check_goals(statement, point) } else { Verdict::Excluded }
}

/// The same where the hypotheses are known to hold.
///
/// An induction is about q = ρᵏ, and no step says anything of another q; its invariants are a means and not
/// an end. And where |ρ| ≥ 1 a sequence has the limit all the same, if it has that value all along.
fn check_goals(statement: &Statement, point: &Point) -> Verdict {
    if let Some(sequence) = statement.conclusion().filter(|sequence| sequence.is_perturbed()) {
        return follow(statement, sequence, point).unwrap_or_else(|verdict| verdict);
    }
    let powers = match statement.conclusion() {
        Some(Sequence { ratio, limit: None, .. }) => {
            let ratio = exact(ratio, point);
            let next = |q: &Exact| Some(q * ratio.as_ref()?);
            std::iter::successors(Some(Exact::one()), next).take(STEPS).collect()
        }
        Some(Sequence { limit: Some(_), .. }) | None => vec![point.at(POWER)],
    };
    let point = &match computed(statement, point) {
        Ok(point) => point,
        Err(verdict) => return verdict,
    };
    let mut open = false;
    for q in powers {
        let point = point.with(POWER, q);
        let goals = statement.goals().iter().filter(|goal| matches!(goal.role, Role::Claim | Role::Step));
        for goal in goals {
            match fails(&goal.proposition, &point) {
                Some(Some(How::Sign(..))) if is_constant(statement, &point) => {}
                Some(Some(how)) => return Verdict::Fails(goal.part, how),
                Some(None) => {}
                None => open = true,
            }
        }
    }
    if open { Verdict::Open } else { Verdict::Holds }
}

fn exact(tree: &Tree, point: &Point) -> Option<Exact> {
    match value(tree, point)? {
        Value::Exact(x) => Some(x),
        Value::Ball(_) => None,
    }
}

/// How a goal fails, if it does; `None` if that cannot be decided.
fn fails(says: &Proposition, point: &Point) -> Option<Option<How>> {
    let undefined = || says.trees().into_iter().find_map(|tree| vanishing(tree, point)).map(How::Undefined);
    let differ = |left: Option<Value>, right: Option<Value>| match (left, right) {
        (Some(left), Some(right)) => match (&left - &right).sign()? {
            Ordering::Equal => Some(None),
            Ordering::Less | Ordering::Greater => Some(Some(How::Different(left, right))),
        },
        _ => undefined().map(Some),
    };
    match says {
        Proposition::Equal(left, right) => differ(value(left, point), value(right, point)),
        Proposition::Sign(relation, of) => match value(of, point) {
            Some(value) => {
                let admitted = relation.admits(value.sign()?);
                Some((!admitted).then_some(How::Sign(*relation, value)))
            }
            None => undefined().map(Some),
        },
        Proposition::Within(of, bound) => match (value(of, point), value(bound, point)) {
            (Some(of), Some(bound)) => {
                let beyond = (&bound - of.abs()).sign()?.is_lt();
                Some(beyond.then_some(How::Beyond(of, bound)))
            }
            _ => undefined().map(Some),
        },
        Proposition::Derivative(of, by, is) => {
            // Of ⟨·⟩ and min, which have kinks, dual numbers know of no derivative.
            let dual = of.derivative(by, &|name| Value::Exact(point.at(name)), &smooth);
            differ(dual.map(|dual| dual.derivative), value(is, point))
        }
        // A quotient of polynomials behaves like a power of x beyond all its zeros and poles, and the
        // coefficients here are far too small for one at 2¹⁰⁰. A distance that tends to 0 falls like 1/x or
        // faster, so by 2⁻¹⁰⁰ or more between 2¹⁰⁰ and 2²⁰⁰; any other does not fall at all.
        Proposition::Limit(of, by, to) => {
            let distance = |n| {
                let point = point.with(by, Exact::power_of_two(n));
                let distance = value(of, &point).zip(value(to, &point)).map(|(of, to)| of - to);
                distance.ok_or_else(|| says.trees().into_iter().find_map(|tree| vanishing(tree, &point)))
            };
            match (distance(100), distance(200)) {
                (Ok(near), Ok(far)) => {
                    let grown = &far * Value::Exact(Exact::power_of_two(50));
                    let falls = (&near * &near - &grown * &grown).sign()?.is_ge();
                    Some((!falls).then_some(How::Far(far)))
                }
                (Err(divisor), _) | (_, Err(divisor)) => Some(Some(How::Undefined(divisor?))),
            }
        }
    }
}

/// A divisor of the formula that is 0, its own divisors first.
fn vanishing(tree: &Tree, point: &Point) -> Option<Tree> {
    tree.step().operands().find_map(|operand| vanishing(operand, point)).or_else(|| match tree.step() {
        Step::Div(_, divisor) => value(divisor, point)?.is_zero().then(|| divisor.clone()),
        _ => None,
    })
}

/// So many raw points are tried first.
const FIRST_RAW: u64 = 200;

/// And of the planted ones.
const FIRST_PLANTED: usize = 4;

/// A counterexample where a divisor is 0, by bending a point to that: divisors mostly are linear in some
/// coordinate.
fn divided_by_zero(statement: &Statement, point: &Point) -> Option<Refutation> {
    let mut divisors: Vec<&Tree> = Vec::new();
    for tree in statement.goals().iter().flat_map(|goal| goal.proposition.trees()) {
        tree.visit(&mut |tree| {
            if let Step::Div(_, divisor) = tree.step()
                && !divisors.contains(&divisor)
            {
                divisors.push(divisor);
            }
        });
    }
    let pairs =
        divisors.into_iter().flat_map(|divisor| divisor.symbols().into_iter().map(move |by| (divisor, by)));
    pairs.into_iter().find_map(|(divisor, by)| {
        let point = bent_to_zero(divisor, by, point)?;
        point.satisfies(statement.hypotheses()).then(|| found(statement, &point))?
    })
}

/// The point with another number for one symbol, so that a divisor is 0.
fn bent_to_zero(divisor: &Tree, by: &'static str, point: &Point) -> Option<Point> {
    let x = divisor.solution(by, &|symbol| point.at(symbol), &Exact::from(0))?;
    Some(point.with(by, x))
}

/// The points at which some hypotheses hold, found once.
pub(super) struct Points {
    hypotheses: Vec<Hypothesis>,
    symbols: Vec<&'static str>,
    /// Raw points, then planted ones: the first that are tried.
    first: [Vec<Point>; 2],
    all: OnceLock<[Vec<Point>; 2]>,
}

impl Points {
    pub(super) fn of(hypotheses: Vec<Hypothesis>, symbols: Vec<&'static str>) -> Self {
        let raw = point::first_raw_points(FIRST_RAW, &hypotheses, &symbols).collect();
        let planted = planted_points(&hypotheses, &symbols).take(FIRST_PLANTED).collect();
        Points { hypotheses, symbols, first: [raw, planted], all: OnceLock::new() }
    }

    /// Returns a refutation at one of the first points.
    pub(super) fn quickly(&self, statement: &Statement) -> Option<Refutation> {
        let [raw, planted] = &self.first;
        raw.iter().take(8).chain(planted).find_map(|point| found(statement, point))
    }

    /// Returns a refutation at one of the others.
    pub(super) fn thoroughly(&self, statement: &Statement) -> Option<Refutation> {
        let [raw, planted] = &self.first;
        let some = raw.iter().skip(8).find_map(|point| found(statement, point));
        let divided = || planted.iter().find_map(|point| divided_by_zero(statement, point));
        some.or_else(divided).or_else(|| {
            let all = || {
                let raw = raw_points(&self.hypotheses, &self.symbols).collect();
                [raw, planted_points(&self.hypotheses, &self.symbols).collect()]
            };
            self.all.get_or_init(all).iter().flatten().find_map(|point| found(statement, point))
        })
    }
}

/// Returns a refutation at a point at which the hypotheses hold.
fn found(statement: &Statement, point: &Point) -> Option<Refutation> {
    match check_goals(statement, point) {
        Verdict::Fails(part, how) => {
            let found = Counterexample { point: point.clone(), part, how };
            Some(Refutation { statement: statement.clone().into(), found: found.into() })
        }
        Verdict::Excluded | Verdict::Holds | Verdict::Open => None,
    }
}

/// Where a bound is used up most, among some points, and which share of it that is; `None` if nothing is
/// said of bounds.
pub fn sharpest(statement: &Statement) -> Option<(Point, Exact)> {
    let symbols = symbols(statement);
    let raw = raw_points(statement.hypotheses(), &symbols).take(SHARP);
    let points = raw.chain(planted_points(statement.hypotheses(), &symbols));
    let shares = points.filter_map(|point| share(statement, &point).map(|share| (point, share)));
    // The first of those that use up most.
    let sharpest = shares.min_by(|(_, a), (_, b)| b.cmp(a));
    sharpest.map(|(point, share)| (point.among(&symbols.into_iter().collect()), share))
}

/// Among so many raw points the sharpest is looked for.
const SHARP: usize = 500;

/// What a statement speaks of, in the order in which it does, but for what follows from the rest: the
/// members and powers of a sequence, and what is computed.
pub(super) fn symbols(statement: &Statement) -> Vec<&'static str> {
    let sequence = statement.conclusion().filter(|sequence| sequence.limit.is_none());
    let members = sequence.map_or(&[][..], |sequence| &MEMBERS[..sequence.step.len()]);
    let follows = |name: &'static str| {
        let is_computed = statement.computed().iter().any(|computed| computed.symbol == name);
        is_computed || sequence.is_some() && name == POWER || members.contains(&name)
    };
    let mut symbols = Vec::new();
    for tree in statement.trees() {
        tree.visit(&mut |tree| {
            if let Step::Symbol(name) = tree.step()
                && !follows(name)
                && !symbols.contains(name)
            {
                symbols.push(*name);
            }
        });
    }
    symbols
}

/// Searches for a counterexample. That there is none among the points that are tried is no proof; of a
/// statement that is too large for [`prove`](super::prove) none is looked for.
pub fn refute(statement: &Statement) -> Option<Counterexample> {
    super::kernel::check_size(statement.trees()).ok()?;
    let symbols = symbols(statement);
    let points = Points::of(statement.hypotheses().to_vec(), symbols);
    let refutation = points.quickly(statement).or_else(|| points.thoroughly(statement))?;
    Some(refutation.counterexample())
}

#[cfg(test)]
mod tests;

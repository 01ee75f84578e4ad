//! The search for a counterexample: numbers at which a statement does not hold.
//!
//! A statement's formulas are replayed at points with small rational coordinates. There are two kinds:
//!
//! - *planted* points are drawn, then bent until the hypotheses hold, one after the other;
//! - *raw* points are small integers, kept if the hypotheses happen to hold. They meet coincidences such as
//!   c + ε = 0 often, and share no mistake with a proof, which also bends a quantity to each hypothesis.
//!
//! All arithmetic is exact but for eˣ, which is a ball: what is refuted is false for certain.

use super::statement::{Hypothesis, Role, Says, Sequence, Statement};
use crate::claims::{Case, Relation, Var};
use crate::number::tree::{Step, everything, piecewise, smooth};
use crate::number::{Ball, Dual, Exact, Exponential, Field, PositivePart, Tree};
use crate::operators;
use num_traits::{One, Zero};
use oorandom::Rand64;
use rug::{Float, Integer, Rational};
use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::{LazyLock, OnceLock};

/// A number: exact, or enclosed if an eˣ went into it.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// This rational number.
    Exact(Exact),
    /// A number in this ball.
    Ball(Ball<f64>),
}

impl Value {
    fn ball(&self) -> Ball<f64> {
        match self {
            // A number that f64 cannot hold is anywhere.
            Value::Exact(x) => x.to_f64().map_or_else(|_| Ball::one() / Ball::zero(), |f| Ball::around(f, x)),
            Value::Ball(ball) => ball.clone(),
        }
    }

    /// Its sign, if that is certain.
    pub fn sign(&self) -> Option<Ordering> {
        match self {
            Value::Exact(x) => Some(x.cmp(&Exact::zero())),
            Value::Ball(ball) => Some(ball).filter(|ball| ball.is_finite()).and_then(Ball::sign),
        }
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Value::Exact(x) => x.fmt(f),
            Value::Ball(ball) => write!(f, "{} ± {:.0e}", ball.value(), ball.radius()),
        }
    }
}

macro_rules! either {
    ($a:expr, $b:expr, |$x:ident, $y:ident| $result:expr) => {
        match ($a, $b) {
            (Value::Exact($x), Value::Exact($y)) => Value::Exact($result),
            (a, b) => {
                let ($x, $y) = (&a.ball(), &b.ball());
                Value::Ball($result)
            }
        }
    };
}

operators! { [] Value;
    Add add |a, b| either!(a, b, |x, y| x + y);
    Sub sub |a, b| either!(a, b, |x, y| x - y);
    Mul mul |a, b| either!(a, b, |x, y| x * y);
    Div div |a, b| either!(a, b, |x, y| x / y);
    - |a| match a {
        Value::Exact(x) => Value::Exact(-x),
        Value::Ball(ball) => Value::Ball(-ball),
    }
}
impl Zero for Value {
    fn zero() -> Self {
        Value::Exact(Exact::zero())
    }
    fn is_zero(&self) -> bool {
        self.sign() == Some(Ordering::Equal)
    }
}
impl One for Value {
    fn one() -> Self {
        Value::Exact(Exact::one())
    }
}
impl Field for Value {
    fn int(n: i32) -> Self {
        Value::Exact(Exact::int(n))
    }
    // By default, whatever is not certainly 0 is a unit: by a ball around 0 the quotient is a ball of infinite
    // radius, which decides nothing. So what is undefined is undefined for certain.
}
impl Exponential for Value {
    fn exp(&self) -> Self {
        if self.is_zero() { Value::one() } else { Value::Ball(self.ball().exp()) }
    }
}
impl PositivePart for Value {
    fn positive_part(&self) -> Self {
        match self {
            Value::Exact(x) => Value::Exact(x.positive_part()),
            Value::Ball(ball) => Value::Ball(ball.positive_part()),
        }
    }
    fn min(&self, other: &Self) -> Self {
        either!(self, other, |x, y| PositivePart::min(x, y))
    }
}

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
            How::Sign(Relation::Positive, value) => write!(f, "{} is not > 0", brief(value)),
            How::Sign(Relation::NonNegative, value) => write!(f, "{} is not ≥ 0", brief(value)),
            How::Sign(Relation::Zero, value) => write!(f, "{} is not = 0", brief(value)),
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
    /// The coordinates that occur in the statement.
    pub values: Vec<(&'static str, Exact)>,
    /// Which part of the claim fails, if it has several.
    pub part: &'static str,
    /// And how.
    pub how: How,
}

impl Counterexample {
    /// The point, with 1 for each coordinate that does not occur.
    pub fn case(&self) -> Case<Exact> {
        let mut case = Case::of(|_| Exact::one());
        for (name, x) in &self.values {
            if let Some(var) = coordinate(name) {
                *case.get_mut(var) = x.clone();
            }
        }
        case
    }
}

/// The coordinates, then how it fails.
impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, (name, x)) in self.values.iter().enumerate() {
            write!(f, "{}{name} = {x}", if i == 0 { "" } else { ", " })?;
        }
        write!(f, "{}{}", if self.values.is_empty() { "" } else { ": " }, self.how)
    }
}

/// The coordinate of this name.
fn coordinate(name: &str) -> Option<Var> {
    Var::ALL.iter().copied().find(|var| var.symbol() == name)
}

fn at(case: &Case<Exact>, name: &str) -> Exact {
    coordinate(name).map_or_else(Exact::one, |var| case.get(var).clone())
}

/// A formula at one point; `None` if it divides by 0 there.
fn value(tree: &Tree, case: &Case<Exact>) -> Option<Value> {
    tree.replay(&|name| Value::Exact(at(case, name)), &everything)
}

/// The statement at one point.
pub fn check(statement: &Statement, case: &Case<Exact>) -> Verdict {
    if statement.hypotheses.iter().all(|hypothesis| holds(hypothesis, case)) {
        check_goals(statement, case)
    } else {
        Verdict::Excluded
    }
}

fn holds(hypothesis: &Hypothesis, case: &Case<Exact>) -> bool {
    let sign = value(&hypothesis.value, case).and_then(|value| value.sign());
    sign.is_some_and(|sign| hypothesis.relation().admits(sign))
}

/// The same where the hypotheses are known to hold.
///
/// An induction is about q = ρᵏ, and no step says anything of another q; its invariants are a means and not an end.
/// And where |ρ| ≥ 1 a sequence has the limit all the same, if it has that value all along.
fn check_goals(statement: &Statement, case: &Case<Exact>) -> Verdict {
    let powers = match &statement.amounts_to {
        Some(Sequence { ratio, limit: None, .. }) => {
            let ratio = exact(ratio, case);
            let next = |q: &Exact| Some(q * ratio.as_ref()?);
            std::iter::successors(Some(Exact::one()), next).take(STEPS).collect()
        }
        Some(Sequence { limit: Some(_), .. }) | None => vec![case.q.clone()],
    };
    let mut open = false;
    for q in powers {
        let case = Case { q, ..case.clone() };
        let goals = statement.goals.iter().filter(|goal| matches!(goal.role, Role::Claim | Role::Step));
        for goal in goals {
            match fails(&goal.says, &case) {
                Some(Some(How::Sign(..))) if is_constant(statement, &case) => {}
                Some(Some(how)) => return Verdict::Fails(goal.part, how),
                Some(None) => {}
                None => open = true,
            }
        }
    }
    if open { Verdict::Open } else { Verdict::Holds }
}

/// As many steps of an induction are tried.
const STEPS: usize = 4;

fn exact(tree: &Tree, case: &Case<Exact>) -> Option<Exact> {
    tree.replay(&|name| at(case, name), &piecewise)
}

/// Is each member of the sequence its limit?
fn is_constant(statement: &Statement, case: &Case<Exact>) -> bool {
    let Some(Sequence { member, limit: Some(limit), .. }) = &statement.amounts_to else { return false };
    let first = Case { q: Exact::one(), ..case.clone() };
    member.iter().all(|member| exact(member, &first).is_some_and(|x| exact(limit, case) == Some(x)))
}

/// How a goal fails, if it does; `None` if that cannot be decided.
fn fails(says: &Says, case: &Case<Exact>) -> Option<Option<How>> {
    let undefined = || says.trees().into_iter().find_map(|tree| vanishing(tree, case)).map(How::Undefined);
    let differ = |left: Option<Value>, right: Option<Value>| match (left, right) {
        (Some(left), Some(right)) => match (&left - &right).sign()? {
            Ordering::Equal => Some(None),
            Ordering::Less | Ordering::Greater => Some(Some(How::Different(left, right))),
        },
        _ => undefined().map(Some),
    };
    match says {
        Says::Equal(left, right) => differ(value(left, case), value(right, case)),
        Says::Sign(relation, of) => match value(of, case) {
            Some(value) => {
                let admitted = relation.admits(value.sign()?);
                Some((!admitted).then_some(How::Sign(*relation, value)))
            }
            None => undefined().map(Some),
        },
        // ⟨·⟩ and min have kinks; there dual numbers know of no derivative.
        Says::Derivative(of, ..) if of.any(&|tree| tree.step().is_bracket()) => None,
        Says::Derivative(of, by, is) => {
            let dual = of.derivative(by.symbol(), &|name| Value::Exact(at(case, name)), &smooth);
            differ(dual.map(|dual| dual.derivative), value(is, case))
        }
        // A quotient of polynomials behaves like a power of x beyond all its zeros and poles, and the coefficients
        // here are far too small for one at 2¹⁰⁰. A distance that tends to 0 falls like 1/x or faster, so by 2⁻¹⁰⁰ or
        // more between 2¹⁰⁰ and 2²⁰⁰; any other does not fall at all.
        Says::Limit(of, by, to) => {
            let mut case = case.clone();
            let mut distance = |n| {
                *case.get_mut(*by) = Exact::power_of_two(n);
                let distance = value(of, &case).zip(value(to, &case)).map(|(of, to)| of - to);
                distance.ok_or_else(|| says.trees().into_iter().find_map(|tree| vanishing(tree, &case)))
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
fn vanishing(tree: &Tree, case: &Case<Exact>) -> Option<Tree> {
    tree.step().operands().find_map(|operand| vanishing(operand, case)).or_else(|| match tree.step() {
        Step::Div(_, divisor) => value(divisor, case)?.is_zero().then(|| divisor.clone()),
        _ => None,
    })
}

/// So many raw points are drawn; of these are so many tried first.
const RAW: usize = 4000;
const FIRST_RAW: usize = 200;

/// Whole numbers this small and smaller: in one of seven draws two of them cancel. And in every fourth point up to
/// the other, for hypotheses such as α > 2(c + ε).
const SMALL: u64 = 3;
const LARGER: u64 = 9;

/// So many planted points; and of these first.
const PLANTED: u64 = 60;
const FIRST_PLANTED: u64 = 4;

/// Small integers, the same for all statements.
static RAW_POINTS: LazyLock<Vec<Case<Exact>>> = LazyLock::new(|| {
    let mut random = Rand64::new(1);
    let mut draw = |size| Exact::from(random.rand_range(0..2 * size + 1) as i32 - size as i32);
    (0..RAW).map(|i| Case::of(|_| draw(if i % 4 == 3 { LARGER } else { SMALL }))).collect()
});

/// The raw points at which hypotheses hold.
pub fn raw_points(hypotheses: &[Hypothesis]) -> impl Iterator<Item = &'static Case<Exact>> {
    RAW_POINTS.iter().filter(|case| hypotheses.iter().all(|hypothesis| holds(hypothesis, case)))
}

/// Planted points at which hypotheses hold; not for ever.
pub fn planted_points(hypotheses: &[Hypothesis]) -> impl Iterator<Item = Case<Exact>> {
    (0..PLANTED).filter_map(move |i| {
        let mut random = Rand64::new(u128::from(i) + 2);
        // One to nine, over one to three, of either sign.
        let mut size = || Rational::from((random.rand_range(1..10), random.rand_range(1..4)));
        let (mut case, target) = (Case::of(|_| Exact::from(size())), Exact::from(size()));
        for var in Var::ALL {
            if random.rand_range(0..3) == 0 {
                let x = -case.get(*var);
                *case.get_mut(*var) = x;
            }
        }
        // A quantity that may be 0 should be so sometimes.
        let target = |relation| match relation {
            Relation::Positive => target.clone(),
            Relation::NonNegative if i % 3 > 0 => target.clone(),
            Relation::NonNegative | Relation::Zero => Exact::zero(),
        };
        plant(hypotheses, &mut case, &target).then_some(case)
    })
}

/// The value of a formula without ⟨·⟩, min and e^…, and how it changes with a coordinate.
fn slope(of: &Tree, case: &Case<Exact>, by: Var) -> Option<Dual<Exact>> {
    of.derivative(by.symbol(), &|name| at(case, name), &|_| None)
}

/// Bends a point until the hypotheses hold. A quantity that lacks its sign gets the value `target`: the hypothesis
/// is linear in the coordinate that it is solved for.
fn plant(hypotheses: &[Hypothesis], case: &mut Case<Exact>, target: &impl Fn(Relation) -> Exact) -> bool {
    for hypothesis in hypotheses {
        let by = hypothesis.given.solved_for();
        let Some(Dual { value, derivative }) = slope(&hypothesis.value, case, by) else { return false };
        if hypothesis.relation().admits(value.cmp(&Exact::zero())) {
            continue;
        }
        if derivative.is_zero() {
            return false;
        }
        let x = case.get(by) + (target(hypothesis.relation()) - value) / derivative;
        *case.get_mut(by) = x;
    }
    hypotheses.iter().all(|hypothesis| holds(hypothesis, case))
}

/// A counterexample where a divisor is 0, by bending a point to that: divisors mostly are linear in some
/// coordinate.
fn divided_by_zero(statement: &Statement, case: &Case<Exact>) -> Option<Counterexample> {
    let mut divisors: Vec<&Tree> = Vec::new();
    for tree in statement.goals.iter().flat_map(|goal| goal.says.trees()) {
        tree.visit(&mut |tree| {
            if let Step::Div(_, divisor) = tree.step()
                && !divisors.contains(&divisor)
            {
                divisors.push(divisor);
            }
        });
    }
    let vars = |divisor: &Tree| divisor.symbols().into_iter().filter_map(coordinate);
    let pairs = divisors.into_iter().flat_map(|divisor| vars(divisor).map(move |var| (divisor, var)));
    pairs.into_iter().find_map(|(divisor, by)| {
        let Dual { value, derivative } =
            slope(divisor, case, by).filter(|dual| !dual.derivative.is_zero())?;
        let mut case = case.clone();
        *case.get_mut(by) = case.get(by) - value / derivative;
        statement.hypotheses.iter().all(|h| holds(h, &case)).then(|| found(statement, &case))?
    })
}

/// The points at which some hypotheses hold, found once.
pub(super) struct Points {
    planted: Vec<Case<Exact>>,
    raw: Vec<&'static Case<Exact>>,
    more: OnceLock<More>,
}

/// Many points: planted ones, and raw ones.
type More = (Vec<Case<Exact>>, Vec<&'static Case<Exact>>);

impl Points {
    pub(super) fn of(hypotheses: &[Hypothesis]) -> Self {
        let raw = RAW_POINTS[..FIRST_RAW].iter();
        Points {
            planted: planted_points(hypotheses).take(FIRST_PLANTED as usize).collect(),
            raw: raw.filter(|case| hypotheses.iter().all(|hypothesis| holds(hypothesis, case))).collect(),
            more: OnceLock::new(),
        }
    }

    /// A counterexample at one of the first points.
    pub(super) fn quickly(&self, statement: &Statement) -> Option<Counterexample> {
        let raw = self.raw.iter().copied().take(8);
        raw.chain(&self.planted).find_map(|case| found(statement, case))
    }

    /// A counterexample at one of the others.
    pub(super) fn thoroughly(&self, statement: &Statement) -> Option<Counterexample> {
        let some = self.raw.iter().skip(8).find_map(|case| found(statement, case));
        some.or_else(|| self.planted.iter().find_map(|case| divided_by_zero(statement, case))).or_else(|| {
            let hypotheses = &statement.hypotheses;
            let (planted, raw) = self
                .more
                .get_or_init(|| (planted_points(hypotheses).collect(), raw_points(hypotheses).collect()));
            raw.iter().copied().chain(planted).find_map(|case| found(statement, case))
        })
    }
}

/// The counterexample at a point at which the hypotheses hold, made small.
fn found(statement: &Statement, case: &Case<Exact>) -> Option<Counterexample> {
    match check_goals(statement, case) {
        Verdict::Fails(part, how) => Some(smaller(statement, case, part, how)),
        Verdict::Excluded | Verdict::Holds | Verdict::Open => None,
    }
}

/// Searches for a counterexample. That there is none among the points that are tried is no proof.
pub fn refute(statement: &Statement) -> Option<Counterexample> {
    let points = Points::of(&statement.hypotheses);
    points.quickly(statement).or_else(|| points.thoroughly(statement))
}

/// What a coordinate is best, and next best.
const SIMPLE: [i32; 7] = [1, 0, 2, -1, 3, -2, -3];

/// How far from simple a number is.
fn complexity(x: &Exact) -> u64 {
    let q = x.as_rational();
    let simple = SIMPLE.iter().position(|n| *q == *n).map(|place| place as u64);
    // Of what is large, the length.
    let size = |n: &Integer| match n.to_i32() {
        Some(n) => n.unsigned_abs().into(),
        None => u64::from(u32::MAX) + u64::from(n.significant_bits()),
    };
    simple.unwrap_or_else(|| SIMPLE.len() as u64 + size(q.numer()) + size(q.denom()))
}

/// What a coordinate could be instead, the simplest first: of a long number, fewer digits.
fn simpler(x: &Exact) -> Vec<Exact> {
    let whole = Exact::from(x.as_rational().clone().trunc());
    let half = Exact::from((whole.as_rational() / Rational::from(2)).trunc());
    let simple = SIMPLE.iter().map(|n| Exact::from(*n)).take_while(|n| n != x);
    simple.chain([half, whole]).collect()
}

/// Points beside one whose coordinate was changed, at which a divisor is 0 again, by another coordinate.
fn divisor_again_zero(divisor: &Tree, changed: Var, case: &Case<Exact>) -> Vec<Case<Exact>> {
    let others = divisor.symbols().into_iter().filter_map(coordinate).filter(|var| *var != changed);
    let bend = |by: Var| {
        let Dual { value, derivative } =
            slope(divisor, case, by).filter(|dual| !dual.derivative.is_zero())?;
        let mut case = case.clone();
        *case.get_mut(by) = case.get(by) - value / derivative;
        Some(case)
    };
    others.filter_map(bend).collect()
}

/// Tries simpler values for one coordinate after the other, as long as it stays a counterexample.
fn smaller(statement: &Statement, case: &Case<Exact>, part: &'static str, how: How) -> Counterexample {
    let names: BTreeSet<_> = statement.trees().flat_map(Tree::symbols).collect();
    let vars: Vec<_> = Var::ALL.iter().copied().filter(|var| names.contains(var.symbol())).collect();
    let size = |case: &Case<Exact>| vars.iter().map(|var| complexity(case.get(*var))).sum::<u64>();
    let mut best = (case.clone(), size(case), part, how);
    // The same with this coordinate, where another one may have to follow.
    let with = |best: &(Case<Exact>, u64, &'static str, How), var: Var, x: Exact| {
        let mut case = best.0.clone();
        *case.get_mut(var) = x;
        let followed = match &best.3 {
            How::Undefined(divisor) => divisor_again_zero(divisor, var, &case),
            _ => Vec::new(),
        };
        let one = |relation| if relation == Relation::Positive { Exact::one() } else { Exact::zero() };
        let planted = plant(&statement.hypotheses, &mut case, &one).then_some(case);
        let followed =
            followed.into_iter().filter(|case| statement.hypotheses.iter().all(|h| holds(h, case)));
        planted.into_iter().chain(followed).find_map(|case| {
            let size = size(&case);
            let Verdict::Fails(part, how) = (size < best.1).then(|| check_goals(statement, &case))? else {
                return None;
            };
            // What is defined stays so: that two numbers differ shows more than that there are none.
            let shows = !matches!(how, How::Undefined(_)) || matches!(best.3, How::Undefined(_));
            shows.then_some((case, size, part, how))
        })
    };
    let mut improves = true;
    while improves {
        improves = false;
        for var in &vars {
            let better = simpler(best.0.get(*var)).into_iter().find_map(|x| with(&best, *var, x));
            if let Some(better) = better {
                best = better;
                improves = true;
            }
        }
    }
    let (case, _, part, how) = best;
    Counterexample {
        values: vars.iter().map(|var| (var.symbol(), case.get(*var).clone())).collect(),
        part,
        how,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::statement::{Goal, statements};

    fn statement(equation: &str, name: &str) -> Statement {
        statements().into_iter().find(|s| (s.equation, s.name) == (equation, name)).unwrap()
    }

    fn case(values: &[(&'static str, i32)]) -> Case<Exact> {
        let values = values.iter().map(|(name, n)| (*name, Exact::from(*n))).collect();
        Counterexample { values, part: "", how: How::Far(Value::zero()) }.case()
    }

    #[test]
    fn numbers_stay_exact_until_there_is_an_exponential() {
        assert_eq!(Value::zero().exp(), Value::one());
        let e = Value::one().exp();
        assert_eq!((&e - Value::int(2)).sign(), Some(Ordering::Greater));
        // Rounding leaves this open, and so is everything after a division by it.
        let nothing = &e * (-Value::one()).exp() - Value::one();
        assert_eq!(nothing.sign(), None);
        assert_eq!((Value::one() / nothing).sign(), None);
        assert!((&e * Value::zero()).is_zero());
        assert_eq!(Value::int(10_000).exp().sign(), None);
    }

    #[test]
    fn a_divisor_that_is_zero_is_named() {
        let root = statement("1.11", "root");
        let point = case(&[("c", -1), ("ε", 1)]);
        assert_eq!(check(&root, &point), Verdict::Excluded);
        assert_eq!(check(&root, &case(&[("c", 3)])), Verdict::Holds);
        let Verdict::Fails(_, how) = check(&root.without(0), &point) else { panic!() };
        assert_eq!(how.to_string(), "undefined: c + ε = 0 is a divisor");
    }

    #[test]
    fn a_limit_is_looked_at_far_out() {
        let limit = statement("1.13", "limit");
        let point = case(&[("H", 2)]);
        assert_eq!(check(&limit, &point), Verdict::Holds);
        let [Goal { says: Says::Limit(of, by, to), .. }, ..] = &limit.goals[..] else { panic!() };
        let wrong = Goal::of_claim("limit", Says::Limit(of.clone(), *by, to + Tree::int(1)));
        let wrong = Statement { goals: vec![wrong], ..limit.clone() };
        assert!(matches!(check(&wrong, &point), Verdict::Fails("limit", How::Far(_))));
    }

    #[test]
    fn what_is_true_is_not_refuted() {
        for (equation, name) in
            [("1.13", "limit"), ("1.21", "eliminated"), ("1.31", "limit"), ("note 4", "contracts")]
        {
            assert_eq!(refute(&statement(equation, name)), None);
        }
    }

    /// Where c + ε = 0, and where a sign is wrong however large the numbers are.
    #[test]
    fn a_counterexample_is_made_small() {
        let long: Exact = "123456789012345678901234567890/987654321098765432109876543210987".parse().unwrap();
        let mut point = Case::of(|_| long.clone());
        point.system.c = -&long;
        let found_at = |statement: &Statement| found(statement, &point).expect("a counterexample");
        let undefined = found_at(&statement("1.11", "root").without(0));
        assert_eq!(
            undefined.to_string(),
            "c = -1, m = 1, g = 1, l = 1, H = 1, ε = 1: undefined: c + ε = 0 is a divisor"
        );
        let minimum = found_at(&statement("1.4", "minimum").without(0));
        assert!(
            minimum.values.iter().all(|(_, x)| SIMPLE.iter().any(|n| Exact::from(*n) == *x)),
            "{minimum}"
        );
    }

    /// As text: what happens far out is said in a few digits, and what differs late in all.
    #[test]
    fn long_values_are_shortened_as_far_as_they_differ() {
        let exact = |text: &str| Value::Exact(text.parse().unwrap());
        let far = How::Far(Value::Exact(Exact::power_of_two(200) + Exact::one()));
        assert_eq!(far.to_string(), "far out it is still ≈ 1.607e60 off its limit");
        let (a, b) = ("1234567890123456789012345678901", "1234567890123456789012345678902");
        assert_eq!(How::Different(exact(a), exact(b)).to_string(), format!("{a} ≠ {b}"));
        assert_eq!(How::Different(exact(a), exact("1/3")).to_string(), "≈ 1.235e30 ≠ 1/3");
    }

    #[test]
    fn a_divisor_is_bent_to_zero() {
        // No integers do that here.
        let divided = statement("note 3", "not-sufficient").without(0);
        let counterexample = refute(&divided).unwrap();
        assert!(matches!(counterexample.how, How::Undefined(_)), "{counterexample}");
    }
}

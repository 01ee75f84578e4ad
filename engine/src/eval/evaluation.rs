//! The meaning of a statement for numbers.

use super::domain::{Decidable, Domain, Rationals, Value};
use super::germ::{Germ, Germs, Tendency, vanishes};
use super::sample::Point;
use crate::formula::claim::{MEMBERS, POWER, PRECISION};
use crate::formula::statement::{Role, Sequence};
use crate::formula::{Hypothesis, Proposition, Relation, Statement};
use crate::number::tree::{Op, smooth_ops};
use crate::number::{Exact, PositivePart, Program, Tree};
use num_traits::One;
use rug::Float;
use std::cell::OnceCell;
use std::fmt;

/// A proposition about numbers that a statement makes.
#[derive(Clone, Debug)]
pub struct Instance {
    /// The part of the statement.
    pub part: &'static str,
    /// The proposition.
    pub proposition: Proposition,
}

impl Instance {
    /// Returns a proposition about a part of a statement.
    pub fn new(part: &'static str, proposition: Proposition) -> Self {
        Instance { part, proposition }
    }
}

/// Returns the propositions that a statement makes about its [independent symbols](independent_symbols).
///
/// Computed quantities are replaced by their formulas. Of a recursion, the first `members` are unfolded: they
/// have their closed form, or satisfy their bounds.
pub fn instances(statement: &Statement, members: usize) -> Vec<Instance> {
    if let Some(sequence @ Sequence { limit: None, .. }) = statement.conclusion() {
        return unfolded(statement, sequence, members);
    }
    let computed = with_computed(statement, Vec::new());
    let claims = statement.goals().iter().filter(|goal| goal.role == Role::Claim);
    claims
        .map(|goal| Instance::new(goal.part, goal.proposition.map(&|tree| tree.substitute(&computed))))
        .collect()
}

/// Returns the hypotheses of a statement as propositions about its independent symbols.
pub fn premises(statement: &Statement) -> Vec<Instance> {
    let computed = with_computed(statement, Vec::new());
    let hypotheses = statement.hypotheses().iter().map(|Hypothesis { relation, value, .. }| {
        Instance::new("", Proposition::Sign(*relation, value.substitute(&computed)))
    });
    hypotheses.collect()
}

/// Adds the formulas of computed quantities to the values of other symbols.
fn with_computed(statement: &Statement, mut known: Vec<(&'static str, Tree)>) -> Vec<(&'static str, Tree)> {
    for computed in statement.computed() {
        let formula = computed.formula.substitute(&known);
        known.push((computed.symbol, formula));
    }
    known
}

/// Returns the instances of the first members of a recursion.
fn unfolded(statement: &Statement, sequence: &Sequence, members: usize) -> Vec<Instance> {
    let mut all = Vec::new();
    let (mut member, mut power) = (sequence.start.clone(), Tree::one());
    for k in 0..members {
        let mut known: Vec<_> = MEMBERS.into_iter().zip(member.iter().cloned()).collect();
        known.push((POWER, power.clone()));
        let known = with_computed(statement, known);
        let part = if k == 0 { "start" } else { "step" };
        if !sequence.is_perturbed() {
            for (x, closed) in member.iter().zip(&sequence.member) {
                let proposition = Proposition::Equal(x.clone(), closed.substitute(&known));
                all.push(Instance::new(part, proposition));
            }
        }
        for (of, bound) in &sequence.within {
            let proposition = Proposition::Within(of.substitute(&known), bound.substitute(&known));
            all.push(Instance::new("", proposition));
        }
        member = sequence.step.iter().map(|step| step.substitute(&known)).collect();
        power = power * &sequence.ratio;
    }
    all
}

/// Returns the independent symbols of a statement in order of occurrence, that is, without the members and
/// powers of a sequence and without computed quantities.
pub fn independent_symbols(statement: &Statement) -> Vec<&'static str> {
    let mut dependent: Vec<_> = statement.computed().iter().map(|computed| computed.symbol).collect();
    if let Some(Sequence { start, step, limit: None, .. }) = statement.conclusion() {
        dependent.extend(&MEMBERS[..step.len()]);
        // In the first member q would be any number.
        if !start.iter().any(|x| x.symbols().contains(POWER)) {
            dependent.push(POWER);
        }
    }
    let mut symbols = Vec::new();
    for tree in statement.trees() {
        tree.visit(&mut |tree| {
            if let Op::Symbol(name) = tree.op()
                && !dependent.contains(name)
                && !symbols.contains(name)
            {
                symbols.push(*name);
            }
        });
    }
    symbols
}

/// A proposition whose formulas are places of a program.
#[derive(Clone, Debug)]
pub enum Test {
    /// Two quantities are equal.
    Equal([usize; 2]),
    /// A quantity has a sign.
    Sign(Relation, usize),
    /// A quantity does not exceed a bound in absolute value.
    Within {
        /// The quantity.
        of: usize,
        /// The bound.
        bound: usize,
    },
    /// Two quantities are defined; whether the second is the derivative of the first is not known.
    Defined([usize; 2]),
    /// A distance tends to 0 as a symbol tends to infinity.
    Limit(&'static str, Program),
}

impl Test {
    /// Adds an instance to a program.
    pub fn of(instance: &Instance, program: &mut Program) -> Self {
        match &instance.proposition {
            Proposition::Equal(left, right) => Test::Equal([program.add(left), program.add(right)]),
            Proposition::Derivative(of, by, is) => {
                match of.derivative(by, &|name| Tree::symbol(name), &smooth_ops) {
                    Some(dual) => Test::Equal([program.add(&dual.derivative), program.add(is)]),
                    // ⟨·⟩ and min are not differentiable.
                    None => Test::Defined([program.add(of), program.add(is)]),
                }
            }
            Proposition::Sign(relation, of) => Test::Sign(*relation, program.add(of)),
            Proposition::Within(of, bound) => Test::Within { of: program.add(of), bound: program.add(bound) },
            Proposition::Limit(of, by, to) => {
                let mut distance = Program::default();
                distance.add(&(of - to));
                Test::Limit(by, distance)
            }
        }
    }
}

/// The evaluation of a statement at one point.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict<V = Value> {
    /// A hypothesis does not hold at the point, or is undefined.
    Excluded,
    /// Everything that is claimed holds.
    Holds,
    /// Something that is claimed cannot be decided because rounding errors hide a sign.
    Undecided,
    /// Something that is claimed does not hold: its part of the claim, and the failure.
    Fails(&'static str, Failure<V>),
}

/// The failure of a proposition at a point.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure<V = Value> {
    /// This divisor is 0.
    Undefined(Tree),
    /// The two sides of an equation have these different values.
    Unequal(V, V),
    /// A quantity of this value does not have the required sign.
    Sign(Relation, V),
    /// The absolute value of the first number exceeds the second, its bound.
    BoundExceeded(V, V),
    /// The distance from the limit tends to this number, or does not tend to any.
    NotConverging(Option<Value>),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        use Failure::*;
        match self {
            Undefined(divisor) if divisor.to_string() == "0" => f.write_str("undefined: 0 is a divisor"),
            Undefined(divisor) => write!(f, "undefined: {divisor} = 0 is a divisor"),
            Unequal(left, right) => match [format_short(left), format_short(right)] {
                // Values that agree in the printed digits are printed in full.
                [short, same] if short == same => write!(f, "{left} ≠ {right}"),
                [left, right] => write!(f, "{left} ≠ {right}"),
            },
            Sign(relation, value) => write!(f, "{} is not {relation} 0", format_short(value)),
            BoundExceeded(of, bound) => {
                write!(f, "|{}| is larger than {}", format_short(of), format_short(bound))
            }
            NotConverging(Some(distance)) => {
                write!(f, "its distance from the limit tends to {}", format_short(distance))
            }
            NotConverging(None) => f.write_str("its distance from the limit is unbounded"),
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

/// The values of a program, each of which is computed when it is required.
#[derive(Debug)]
pub struct Evaluation<'a, D: Domain, S> {
    domain: D,
    program: &'a Program,
    symbol: S,
    values: Vec<OnceCell<Option<D::Value>>>,
}

/// Whether a test holds, or its failure; `None` if this cannot be decided.
type Outcome<V> = Option<Result<(), Failure<V>>>;

impl<'a, D: Domain, S: Fn(&'static str) -> D::Value> Evaluation<'a, D, S> {
    /// Evaluates a program for these values of symbols.
    pub fn of(program: &'a Program, domain: D, symbol: S) -> Self {
        Evaluation { domain, program, symbol, values: vec![OnceCell::new(); program.len()] }
    }

    /// Returns the value of a formula; `None` if it is undefined.
    pub fn at(&self, place: usize) -> Option<&D::Value> {
        self.values[place].get_or_init(|| self.compute(place)).as_ref()
    }

    fn compute(&self, place: usize) -> Option<D::Value> {
        let op = &self.program.ops()[place];
        if let Op::Rounded(_) = op
            && let Some(value) = self.domain.rounded(place)
        {
            return Some(value);
        }
        match op.try_map(|operand| self.at(*operand))? {
            Op::Symbol(name) => Some((self.symbol)(name)),
            op => self.domain.apply(op),
        }
    }

    /// Returns the divisor because of which a formula is undefined, an innermost one.
    fn zero_divisor(&self, place: usize) -> Option<Tree> {
        if self.at(place).is_some() {
            return None;
        }
        let op = &self.program.ops()[place];
        op.operands().find_map(|operand| self.zero_divisor(*operand)).or_else(|| match op {
            Op::Div(_, divisor) => Some(self.program.formula(*divisor)),
            _ => None,
        })
    }
}

impl<D: Domain<Value: Decidable>, S: Fn(&'static str) -> D::Value> Evaluation<'_, D, S> {
    /// Returns the verdict of all tests, each with its part of the claim: the first failure, if there is one.
    /// Without tests it is undecided.
    pub fn verdict<'t>(
        &self,
        tests: impl IntoIterator<Item = &'t (&'static str, Test)>,
    ) -> Verdict<D::Value> {
        let mut verdict = None;
        for (part, test) in tests {
            match self.outcome(test) {
                Some(Ok(())) => verdict = verdict.or(Some(Verdict::Holds)),
                Some(Err(failure)) => return Verdict::Fails(part, failure),
                None => verdict = Some(Verdict::Undecided),
            }
        }
        verdict.unwrap_or(Verdict::Undecided)
    }

    /// Returns whether a test holds, or its failure; `None` if this cannot be decided.
    pub fn outcome(&self, test: &Test) -> Outcome<D::Value> {
        match test {
            Test::Equal(sides) => self.compared(sides, Decidable::is_equal, Failure::Unequal),
            Test::Within { of, bound } => {
                self.compared(&[*of, *bound], Decidable::is_within, Failure::BoundExceeded)
            }
            Test::Sign(relation, of) => match self.at(*of) {
                Some(value) if value.admits(*relation)? => Some(Ok(())),
                Some(value) => Some(Err(Failure::Sign(*relation, value.clone()))),
                None => self.undefined(&[*of]),
            },
            Test::Defined(places) => self.undefined(places),
            Test::Limit(by, distance) => self.limit(by, distance),
        }
    }

    /// Returns the outcome of a comparison of two quantities.
    fn compared(
        &self,
        places: &[usize; 2],
        holds: fn(&D::Value, &D::Value) -> Option<bool>,
        failure: fn(D::Value, D::Value) -> Failure<D::Value>,
    ) -> Outcome<D::Value> {
        let [Some(x), Some(y)] = places.map(|place| self.at(place)) else { return self.undefined(places) };
        Some(if holds(x, y)? { Ok(()) } else { Err(failure(x.clone(), y.clone())) })
    }

    fn limit(&self, by: &str, distance: &Program) -> Outcome<D::Value> {
        let symbol = |name: &'static str| {
            if name == by {
                return Tendency::Rational(Germ::variable());
            }
            let value = (self.symbol)(name);
            value.exact().map_or(Tendency::Unknown, |x| Tendency::Rational(Germ::constant(x.clone())))
        };
        let (germs, last) = (Evaluation::of(distance, Germs, symbol), distance.len() - 1);
        match germs.at(last) {
            Some(distance) => Some(vanishes(distance)?.map_err(Failure::NotConverging)),
            None => Some(Err(Failure::Undefined(germs.zero_divisor(last)?))),
        }
    }

    /// Returns the failure that a divisor of one of the formulas is 0; `None` if no such divisor is found.
    fn undefined(&self, places: &[usize]) -> Outcome<D::Value> {
        let divisor = places.iter().find_map(|place| self.zero_divisor(*place))?;
        Some(Err(Failure::Undefined(divisor)))
    }
}

/// Propositions compiled for many points.
#[derive(Clone, Debug)]
pub struct Compiled {
    program: Program,
    tests: Vec<(&'static str, Test)>,
}

/// Number of members of a sequence that are evaluated. Its closed form is also evaluated for arbitrary q.
pub const UNFOLDED_MEMBERS: usize = 4;

impl Compiled {
    /// Compiles propositions.
    pub fn of(instances: impl IntoIterator<Item = Instance>) -> Self {
        let (mut program, mut tests) = (Program::default(), Vec::new());
        for instance in instances {
            tests.push((instance.part, Test::of(&instance, &mut program)));
        }
        Compiled { program, tests }
    }

    /// Compiles a statement without its hypotheses.
    pub fn new(statement: &Statement) -> Self {
        Compiled::of(instances(statement, UNFOLDED_MEMBERS))
    }

    /// Returns the tests, each with its part of the claim.
    pub fn tests(&self) -> &[(&'static str, Test)] {
        &self.tests
    }

    /// Evaluates the formulas for these values of symbols.
    pub fn evaluate<D: Domain, S: Fn(&'static str) -> D::Value>(
        &self,
        domain: D,
        symbol: S,
    ) -> Evaluation<'_, D, S> {
        Evaluation::of(&self.program, domain, symbol)
    }

    fn at<'a>(&'a self, point: &'a Point) -> Evaluation<'a, Rationals, impl Fn(&'static str) -> Value> {
        let domain = Rationals { precision: point.at(PRECISION) };
        self.evaluate(domain, |name| Value::Exact(point.at(name)))
    }

    /// Returns the verdict at a point at which the hypotheses hold.
    pub fn verdict(&self, point: &Point) -> Verdict {
        self.at(point).verdict(&self.tests)
    }

    /// Returns the largest ratio of a quantity to its bound; `None` if there are no bounds.
    pub fn bound_fraction(&self, point: &Point) -> Option<Exact> {
        let (values, mut largest) = (self.at(point), None);
        for (_, test) in &self.tests {
            if let Test::Within { of, bound } = test
                && let Some(Value::Exact(x)) = values.at(*of)
                && let Some(Value::Exact(bound)) = values.at(*bound)
                && *bound != Exact::from(0)
            {
                largest = largest.max(Some(x.abs() / bound));
            }
        }
        largest
    }
}

/// Returns the verdict of a statement at a point.
pub fn verdict_at(statement: &Statement, point: &Point) -> Verdict {
    if point.satisfies(statement.hypotheses()) {
        Compiled::new(statement).verdict(point)
    } else {
        Verdict::Excluded
    }
}

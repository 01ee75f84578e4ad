//! Experiments on the laws of rounding in floats, for the claims about rounding.

use super::{Experiment, MOST_STEPS, STEPS, Trial, UNITS, check, exact, power_of_two};
use crate::chapter::{augmented, structure, system};
use crate::claims::{Case, claims, symbols};
use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Role, Sequence};
use crate::formula::{Hypothesis, Proposition, Relation, Statement};
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Program, Real, ToExact};
use crate::solver::{Augmentation, Plane, Scalar};
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::sync::LazyLock;

/// Returns an experiment for each claim about rounding, evaluated with computed numbers.
pub(super) fn laws<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    claims().filter(|claim| claim.contains_rounding()).map(experiment).collect()
}

fn experiment<T: Scalar + Real + ToExact>(claim: &Statement) -> Experiment<T> {
    let (of_rounding, law) = (has_limit(claim), Law::of(claim));
    Experiment {
        equation: claim.equation(),
        name: claim.name(),
        statement: None,
        given: claim.hypotheses().iter().filter(|given| is_of_parameters(given)).cloned().collect(),
        check: check(move |case: &Case<T>| match law.trial(case) {
            Some(Trial::Within { error, bound }) if !of_rounding => Trial::Decided(error <= bound),
            trial => trial.unwrap_or(Trial::Undecided),
        }),
    }
}

/// Returns `true` if cases can be sampled to satisfy the hypothesis. Hypotheses on computed quantities and on
/// the precision are tested in each trial.
fn is_of_parameters(given: &Hypothesis) -> bool {
    !given.value.contains_rounding()
        && given.interval().is_none()
        && !given.value.symbols().contains(PRECISION)
}

/// Returns `true` if a bound vanishes with η; for other bounds the ratio of error and bound has no meaning.
fn has_limit(claim: &Statement) -> bool {
    let Some(Proposition::Within(_, bound)) = proposition(claim) else { return true };
    let at = |bits: i32| {
        let number = |name| if name == PRECISION { Exact::power_of_two(bits) } else { Exact::from(2) };
        bound.eval(&number, &|step| match step {
            Op::Rounded(x) => Some(x.clone()),
            step => piecewise_ops(step),
        })
    };
    at(60).zip(at(20)).is_none_or(|(fine, coarse)| fine * Exact::from(2) <= coarse)
}

/// Returns `true` if the computed results have neither underflow nor overflow, so that the model of rounding
/// to p bits applies.
pub(super) fn in_range<T: Scalar + Real + ToExact>(case: &Case<T>) -> bool {
    static FORMULAS: LazyLock<(Program, [usize; 3])> = LazyLock::new(|| {
        let Case { system: s, eps, lambda, .. } = symbols();
        let u = augmented::deflection(s, eps, lambda);
        let formulas = [augmented::update(s, eps, lambda, &u), structure::deflection(s), system::reaction(s)];
        let mut program = Program::default();
        let places = formulas.map(|formula| program.add(&formula.with_rounding()));
        (program, places)
    });
    let (program, places) = &*FORMULAS;
    Evaluation::of(case, program, &[])
        .is_some_and(|mut floats| places.iter().all(|place| floats.compute(*place).is_some()))
}

/// Returns the proposition of a claim that is not about a sequence.
fn proposition(claim: &Statement) -> Option<&Proposition> {
    let mut goals = claim.goals().iter().filter(|goal| goal.role == Role::Claim);
    goals.next().map(|goal| &goal.proposition)
}

/// A claim with compiled formulas, each named by its index in the program.
struct Law {
    program: Program,
    /// Whether each value changes with computed quantities.
    varies: Vec<bool>,
    hypotheses: Vec<(Relation, usize)>,
    computed: Vec<(&'static str, usize)>,
    asks: Test,
    /// Whether λ must repeat within the steps.
    repeats: bool,
}

/// Test of the values.
enum Test {
    Within(usize, usize),
    Equal(usize, usize),
    Sign(Relation, usize),
    /// For a sequence, the bounded formulas with their bounds.
    Sequence {
        start: usize,
        step: usize,
        ratio: usize,
        within: Vec<(usize, usize)>,
    },
    Nothing,
}

impl Law {
    fn of(claim: &Statement) -> Self {
        let mut program = Program::default();
        let hypotheses =
            claim.hypotheses().iter().map(|given| (given.relation, program.add(&given.value))).collect();
        let computed: Vec<_> = claim
            .computed()
            .iter()
            .map(|computed| (computed.symbol, program.add(&computed.formula)))
            .collect();
        let asks = match (claim.conclusion(), proposition(claim)) {
            (Some(Sequence { start, step, ratio, within, .. }), _) => match (&start[..], &step[..]) {
                ([start], [step]) => Test::Sequence {
                    start: program.add(start),
                    step: program.add(step),
                    ratio: program.add(ratio),
                    within: within.iter().map(|(of, bound)| (program.add(of), program.add(bound))).collect(),
                },
                _ => Test::Nothing,
            },
            (_, Some(Proposition::Within(of, bound))) => Test::Within(program.add(of), program.add(bound)),
            (_, Some(Proposition::Equal(left, right))) => Test::Equal(program.add(left), program.add(right)),
            (_, Some(Proposition::Sign(relation, of))) => Test::Sign(*relation, program.add(of)),
            _ => Test::Nothing,
        };
        let is_computed =
            |name| [MEMBERS[0], POWER].contains(&name) || computed.iter().any(|(symbol, _)| *symbol == name);
        let mut varies = Vec::with_capacity(program.len());
        for step in program.ops() {
            let own = matches!(step, Op::Symbol(name) if is_computed(name));
            varies.push(own || step.operands().any(|operand| varies[*operand]));
        }
        let repeats = claim.hypotheses().contains(&crate::claims::hypotheses().computed_repeats);
        Law { program, varies, hypotheses, computed, asks, repeats }
    }

    fn trial<T: Scalar + Real + ToExact>(&self, case: &Case<T>) -> Option<Trial> {
        let mut floats = Evaluation::of(case, &self.program, &self.varies)?;
        if let Test::Sequence { start, step, ratio, within } = &self.asks {
            return floats.follow(self, [*start, *step, *ratio], within);
        }
        if self.repeats {
            floats.find_repeat()?;
        }
        floats.check(self)
    }
}

/// Computed and exact values of a case.
struct Evaluation<'a, T> {
    case: &'a Case<T>,
    program: &'a Program,
    /// Whether each value changes with computed quantities.
    varies: &'a [bool],
    /// Values so far, as floats compute them and exact.
    known: Vec<(Option<T>, Option<Exact>)>,
    /// 2ᵖ
    precision: Exact,
    /// Smallest number with full precision.
    least: T,
    /// Computed quantities.
    computed: Vec<(&'static str, T)>,
    /// ρᵏ
    power: Exact,
}

impl<'a, T: Scalar + Real + ToExact> Evaluation<'a, T> {
    fn of(case: &'a Case<T>, program: &'a Program, varies: &'a [bool]) -> Option<Self> {
        let system = &case.system;
        let eta = [&system.c, &system.g, &system.l, &system.h, &case.eps, &case.u];
        let order = |a: &T, b: &T| a.partial_cmp(b).unwrap_or(Ordering::Equal);
        let eta = eta.into_iter().map(Real::unit_roundoff).max_by(order)?;
        let precision = Exact::one() / exact(&eta)?;
        let least = T::min_subnormal() / eta;
        let (known, computed) = (vec![(None, None); program.len()], Vec::new());
        Some(Evaluation { case, program, varies, known, precision, least, computed, power: Exact::one() })
    }

    /// Sets a computed quantity and discards the values that depend on it.
    fn set(&mut self, symbol: &'static str, number: T) {
        self.computed.push((symbol, number));
        for (known, _) in self.known.iter_mut().zip(self.varies).filter(|(_, varies)| **varies) {
            *known = (None, None);
        }
    }

    /// Returns the value of a symbol as a float.
    fn number(&self, name: &'static str) -> T {
        match SCALES.iter().position(|scale| *scale == name) {
            Some(i) => power_of_two(UNITS[i]),
            None => {
                let own = self.computed.iter().rev().find(|(own, _)| *own == name);
                own.map_or_else(|| self.case.get_by_symbol(name), |(_, x)| x.clone())
            }
        }
    }

    /// Returns the value that floats compute; `None` if a number is too large or too small for the model of
    /// rounding to p bits.
    fn compute(&mut self, place: usize) -> Option<&T> {
        let steps = self.program.ops();
        if self.known[place].0.is_none() {
            let step = match &steps[place] {
                Op::Rounded(inner) => &steps[*inner],
                step => step,
            };
            step.operands().try_for_each(|operand| self.compute(*operand).map(drop))?;
            let operands = step.try_map(|operand| self.known[*operand].0.as_ref())?;
            // Sums never underflow; a nonzero product or quotient has full precision from `least` on.
            let is_zero = match operands {
                Op::Mul(a, b) => Some(a.is_zero() || b.is_zero()),
                Op::Div(a, _) => Some(a.is_zero()),
                _ => None,
            };
            let value = operands.value(&|name| self.number(name), &piecewise_ops)?;
            let is_small = || value.is_zero() || value.abs() < self.least;
            let in_range = Real::is_finite(&value) && !is_zero.is_some_and(|is_zero| !is_zero && is_small());
            self.known[place].0 = in_range.then_some(value);
        }
        self.known[place].0.as_ref()
    }

    /// Returns the exact value of a formula, in which roundings are computed.
    fn value(&mut self, place: usize) -> Option<&Exact> {
        if self.known[place].1.is_none() {
            let value = match &self.program.ops()[place] {
                Op::Rounded(_) => exact(self.compute(place)?),
                Op::Symbol(PRECISION) => Some(self.precision.clone()),
                Op::Symbol(POWER) if !self.computed.is_empty() => Some(self.power.clone()),
                Op::Symbol(name) => exact(&self.number(name)),
                step => {
                    step.operands().try_for_each(|operand| self.value(*operand).map(drop))?;
                    let operands = step.try_map(|operand| self.known[*operand].1.as_ref())?;
                    operands.value(&|_| Exact::zero(), &piecewise_ops)
                }
            };
            self.known[place].1 = value;
        }
        self.known[place].1.as_ref()
    }

    fn has_sign(&mut self, relation: Relation, of: usize) -> Option<bool> {
        Some(relation.admits(self.value(of)?.cmp(&Exact::zero())))
    }

    /// Returns `None` unless all hypotheses hold.
    fn check_hypotheses(&mut self, law: &Law) -> Option<()> {
        law.hypotheses.iter().all(|(relation, of)| self.has_sign(*relation, *of) == Some(true)).then_some(())
    }

    /// Computes the quantities of the law.
    fn compute_all(&mut self, law: &Law) -> Option<()> {
        law.computed.iter().try_for_each(|(symbol, by)| {
            let number = self.compute(*by)?.clone();
            self.set(symbol, number);
            Some(())
        })
    }

    fn check(&mut self, law: &Law) -> Option<Trial> {
        self.compute_all(law)?;
        self.check_hypotheses(law)?;
        Some(match law.asks {
            Test::Within(of, bound) => within(self.value(of)?.clone(), self.value(bound)?.clone()),
            Test::Equal(left, right) => Trial::Decided(self.value(left)?.clone() == *self.value(right)?),
            Test::Sign(relation, of) => Trial::Decided(self.has_sign(relation, of)?),
            Test::Sequence { .. } | Test::Nothing => return None,
        })
    }

    /// Follows a sequence for some steps, and returns the trial with the largest ratio to its bound.
    fn follow(&mut self, law: &Law, places: [usize; 3], bounds: &[(usize, usize)]) -> Option<Trial> {
        let [start, step, ratio] = places;
        self.check_hypotheses(law)?;
        let (mut member, ratio) = (self.compute(start)?.clone(), self.value(ratio)?.clone());
        // The bounds are the same for all k.
        let bound = |(of, bound): &(usize, usize)| Some((*of, self.value(*bound)?.clone(), Exact::zero()));
        let mut bounds: Vec<_> = bounds.iter().map(bound).collect::<Option<_>>()?;
        for _ in 0..STEPS {
            self.computed.clear();
            self.set(MEMBERS[0], member);
            self.compute_all(law)?;
            for (of, _, largest) in &mut bounds {
                let error = self.value(*of)?.abs();
                *largest = error.max(largest.clone());
            }
            member = self.compute(step)?.clone();
            self.power = &self.power * &ratio;
        }
        let trials = bounds.into_iter().map(|(_, bound, error)| Trial::Within { error, bound });
        Some(trials.fold(Trial::Undecided, worse))
    }

    /// Iterates the augmentation until λ repeats.
    fn find_repeat(&mut self) -> Option<()> {
        let Case { system, eps, .. } = self.case;
        let bits = self.precision.as_rational().numer().significant_bits() as usize;
        // For ε ≥ c each step gains at least one bit.
        let enough = if *eps >= system.c { (bits + STEPS).min(MOST_STEPS) } else { STEPS };
        let mut steps = Augmentation::new(system, eps).over(Plane::Bilateral);
        for _ in 0..enough {
            let step = steps.step();
            if *steps.multiplier() == step.multiplier {
                self.set("λ", step.multiplier);
                self.set("u", step.deflection);
                return Some(());
            }
        }
        None
    }
}

fn within(error: Exact, bound: Exact) -> Trial {
    Trial::Within { error: error.abs(), bound }
}

/// Returns a trial whose error exceeds its bound, otherwise that with the larger ratio of error and bound.
fn worse(a: Trial, b: Trial) -> Trial {
    match (&a, &b) {
        (Trial::Within { error, bound }, Trial::Within { error: other, bound: most }) => {
            if other > most || error <= bound && error * most < other * bound { b } else { a }
        }
        _ => b,
    }
}

#[cfg(test)]
mod tests;

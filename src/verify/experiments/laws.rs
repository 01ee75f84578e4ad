//! The laws of rounding in floats: what is claimed of what is rounded, with the numbers that are computed.

use super::{Experiment, MOST_STEPS, STEPS, Trial, UNITS, check, exact, power_of_two};
use crate::chapter::{augmented, structure, system};
use crate::claims::{Case, claims, given, symbols};
use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Role, Sequence};
use crate::formula::{Hypothesis, Proposition, Relation, Statement};
use crate::number::tree::{Step, piecewise};
use crate::number::{Exact, PositivePart, Real, ToExact, Tree};
use crate::solver::{Augmentation, Plane, Scalar};
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// An experiment for each claim that speaks of what is rounded: it holds of what is computed.
pub(super) fn laws<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    claims().filter(|claim| claim.contains_rounding()).map(experiment).collect()
}

fn experiment<T: Scalar + Real + ToExact>(claim: &Statement) -> Experiment<T> {
    let hypotheses = claim.hypotheses();
    // Where λ repeats has to be found.
    let repeats = hypotheses.contains(&given().computed_repeats);
    let (of_rounding, own) = (vanishes(claim), claim.clone());
    Experiment {
        equation: claim.equation(),
        name: claim.name(),
        given: hypotheses.iter().filter(|given| is_of_parameters(given)).cloned().collect(),
        check: check(move |case: &Case<T>| match law(&own, repeats, case) {
            Some(Trial::Within { error, bound }) if !of_rounding => Trial::Decided(error <= bound),
            trial => trial.unwrap_or(Trial::Undecided),
        }),
    }
}

/// Can numbers be drawn so that it holds? Where something is computed, or how finely, is seen in each trial.
fn is_of_parameters(given: &Hypothesis) -> bool {
    !given.value.rounds() && given.interval().is_none() && !given.value.symbols().contains(PRECISION)
}

/// Does a bound vanish with η? Of one that does not, rounding uses up no share.
fn vanishes(claim: &Statement) -> bool {
    let Some(Proposition::Within(_, bound)) = proposition(claim) else { return true };
    let at = |bits: i32| {
        let number = |name| if name == PRECISION { Exact::power_of_two(bits) } else { Exact::from(2) };
        bound.replay(&number, &|step| match step {
            Step::Rounded(x) => Some(x.clone()),
            step => piecewise(step),
        })
    };
    at(60).zip(at(20)).is_none_or(|(fine, coarse)| fine * Exact::from(2) <= coarse)
}

/// Is what is computed what rounding to p bits makes of it, without over- and underflow?
pub(super) fn in_range<T: Scalar + Real + ToExact>(case: &Case<T>) -> bool {
    let Case { system: s, eps, lambda, .. } = symbols();
    let u = augmented::deflection(s, eps, lambda);
    let formulas = [augmented::update(s, eps, lambda, &u), structure::deflection(s), system::reaction(s)];
    Floats::of(case).is_some_and(|floats| formulas.iter().all(|f| floats.compute(&f.rounded()).is_some()))
}

/// The proposition of a claim that is not about a sequence.
fn proposition(claim: &Statement) -> Option<&Proposition> {
    let mut goals = claim.goals().iter().filter(|goal| goal.role == Role::Claim);
    goals.next().map(|goal| &goal.proposition)
}

fn law<T>(statement: &Statement, repeats: bool, case: &Case<T>) -> Option<Trial>
where
    T: Scalar + Real + ToExact,
{
    let mut floats = Floats::of(case)?;
    if statement.conclusion().is_some() {
        return floats.follow(statement);
    }
    if repeats {
        floats.find_repeat()?;
    }
    floats.check(statement)
}

/// Numbers as they are computed, and as they are.
struct Floats<'a, T> {
    case: &'a Case<T>,
    /// 2ᵖ
    precision: Exact,
    /// From here on a number has all its bits.
    least: T,
    /// What has been computed on the way.
    computed: Vec<(&'static str, T)>,
    /// ρᵏ
    power: Exact,
}

impl<'a, T: Scalar + Real + ToExact> Floats<'a, T> {
    fn of(case: &'a Case<T>) -> Option<Self> {
        let system = &case.system;
        let eta = [&system.c, &system.g, &system.l, &system.h, &case.eps, &case.u];
        let order = |a: &T, b: &T| a.partial_cmp(b).unwrap_or(Ordering::Equal);
        let eta = eta.into_iter().map(Real::unit_roundoff).max_by(order)?;
        let precision = Exact::one() / exact(&eta)?;
        let least = T::underflow_unit() / eta;
        Some(Floats { case, precision, least, computed: Vec::new(), power: Exact::one() })
    }

    /// The number for a symbol, as a float.
    fn number(&self, name: &'static str) -> T {
        match SCALES.iter().position(|scale| *scale == name) {
            Some(i) => power_of_two(UNITS[i]),
            None => {
                let own = self.computed.iter().rev().find(|(own, _)| *own == name);
                own.map_or_else(|| self.case.named(name), |(_, x)| x.clone())
            }
        }
    }

    /// A formula as floats compute it; `None` where a number is too large or too small for that: then it
    /// is not what rounding to p bits makes of it.
    fn compute(&self, tree: &Tree) -> Option<T> {
        let step = match tree.step() {
            Step::Rounded(inner) => inner.step(),
            step => step,
        };
        let operands = step.try_map(|operand| self.compute(operand))?;
        // Sums never underflow; a product or quotient that is not 0 has all its bits from here on.
        let is_zero = match &operands {
            Step::Mul(a, b) => Some(a.is_zero() || b.is_zero()),
            Step::Div(a, _) => Some(a.is_zero()),
            _ => None,
        };
        let value = operands.value(&|name| self.number(name), &piecewise)?;
        let is_small = || value.is_zero() || value.abs() < self.least;
        let in_range = Real::is_finite(&value) && !is_zero.is_some_and(|is_zero| !is_zero && is_small());
        in_range.then_some(value)
    }

    /// A formula as it is; what is rounded in it is computed.
    fn value(&self, tree: &Tree) -> Option<Exact> {
        let symbol = |name: &'static str| match name {
            PRECISION => Some(self.precision.clone()),
            POWER if !self.computed.is_empty() => Some(self.power.clone()),
            name => exact(&self.number(name)),
        };
        match tree.step() {
            Step::Rounded(_) => exact(&self.compute(tree)?),
            Step::Symbol(name) => symbol(name),
            step => {
                let operands = step.try_map(|operand| self.value(operand))?;
                operands.value(&|_| Exact::zero(), &piecewise)
            }
        }
    }

    fn has_sign(&self, relation: Relation, of: &Tree) -> Option<bool> {
        Some(relation.admits(self.value(of)?.cmp(&Exact::zero())))
    }

    /// `None` unless all hypotheses hold.
    fn suppose(&self, statement: &Statement) -> Option<()> {
        let holds = |given: &Hypothesis| self.has_sign(given.relation, &given.value) == Some(true);
        statement.hypotheses().iter().all(holds).then_some(())
    }

    /// Computes what the statement has computed.
    fn compute_all(&mut self, statement: &Statement) -> Option<()> {
        for computed in statement.computed() {
            let number = self.compute(&computed.by)?;
            self.computed.push((computed.symbol, number));
        }
        Some(())
    }

    fn check(&mut self, statement: &Statement) -> Option<Trial> {
        self.compute_all(statement)?;
        self.suppose(statement)?;
        Some(match proposition(statement)? {
            Proposition::Within(of, bound) => within(self.value(of)?, self.value(bound)?),
            Proposition::Equal(left, right) => Trial::Decided(self.value(left)? == self.value(right)?),
            Proposition::Sign(relation, of) => Trial::Decided(self.has_sign(*relation, of)?),
            _ => return None,
        })
    }

    /// A sequence for some steps, and where it comes nearest to its bounds.
    fn follow(&mut self, statement: &Statement) -> Option<Trial> {
        let Sequence { start, step, ratio, within: bounds, .. } = statement.conclusion()?;
        let ([start], [step]) = (&start[..], &step[..]) else { return None };
        self.suppose(statement)?;
        let (mut member, ratio) = (self.compute(start)?, self.value(ratio)?);
        // The bounds are the same for all k.
        let most: Vec<_> = bounds.iter().map(|(_, bound)| self.value(bound)).collect::<Option<_>>()?;
        let mut worst = Trial::Undecided;
        for _ in 0..STEPS {
            self.computed = vec![(MEMBERS[0], member)];
            self.compute_all(statement)?;
            for ((of, _), bound) in bounds.iter().zip(&most) {
                worst = worse(worst, within(self.value(of)?, bound.clone()));
            }
            member = self.compute(step)?;
            self.power = &self.power * &ratio;
        }
        Some(worst)
    }

    /// Repeats the augmentation until λ does.
    fn find_repeat(&mut self) -> Option<()> {
        let Case { system, eps, .. } = self.case;
        let bits = self.precision.as_rational().numer().significant_bits() as usize;
        // Where ε ≥ c each step gains a bit or more.
        let enough = if *eps >= system.c { (bits + STEPS).min(MOST_STEPS) } else { STEPS };
        let mut steps = Augmentation::new(system, eps).over(Plane::Bilateral);
        for _ in 0..enough {
            let step = steps.step();
            if *steps.multiplier() == step.multiplier {
                self.computed = vec![("λ", step.multiplier), ("u", step.deflection)];
                return Some(());
            }
        }
        None
    }
}

fn within(error: Exact, bound: Exact) -> Trial {
    Trial::Within { error: error.abs(), bound }
}

/// The one in which the error is the larger part of its bound.
fn worse(a: Trial, b: Trial) -> Trial {
    match (&a, &b) {
        (Trial::Within { error, bound }, Trial::Within { error: other, bound: most }) => {
            if error * most < other * bound { b } else { a }
        }
        _ => b,
    }
}

#[cfg(test)]
mod tests;

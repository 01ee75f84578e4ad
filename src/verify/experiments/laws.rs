//! Experiments on the laws of rounding in floats, for the claims about rounding.

use super::{Experiment, MOST_STEPS, STEPS, Trial, UNITS, check, power_of_two};
use crate::chapter::{SpringMass, augmented, structure, system};
use crate::claims::{Case, Var, claims, symbols};
use crate::eval::{Compiled, Computed, Evaluation, Floats, Instance, Test, instances, premises};
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Hypothesis, Proposition, Statement};
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Program, Real, ToExact, Tree};
use crate::solver::{Augmentation, Iterate, Plane, Scalar};
use num_traits::Zero;
use std::collections::BTreeMap;
use std::sync::{Arc, LazyLock};

/// Returns an experiment for each claim about rounding, evaluated with computed numbers.
pub(super) fn laws<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    // Compiled once for all number systems.
    static LAWS: LazyLock<Vec<Arc<Law>>> = LazyLock::new(|| {
        let of_rounding = claims().filter(|claim| claim.contains_rounding());
        of_rounding.map(|claim| Arc::new(Law::of(claim))).collect()
    });
    LAWS.iter().cloned().map(experiment).collect()
}

fn experiment<T: Scalar + Real + ToExact>(law: Arc<Law>) -> Experiment<T> {
    Experiment {
        equation: law.statement.equation(),
        name: law.statement.name(),
        statement: None,
        given: law.statement.hypotheses().iter().filter(|given| is_of_parameters(given)).cloned().collect(),
        check: check(move |case: &Case<T>| law.trial(case).unwrap_or(Trial::Undecided)),
    }
}

/// Returns `true` if cases can be sampled to satisfy the hypothesis. Hypotheses on computed quantities and on
/// the precision are tested in each trial.
fn is_of_parameters(given: &Hypothesis) -> bool {
    !given.value.contains_rounding()
        && given.interval().is_none()
        && !given.value.symbols().contains(PRECISION)
}

/// Returns `true` if all bounds vanish with η; for other bounds the ratio of error and bound has no meaning.
fn bounds_vanish(claim: &[Instance]) -> bool {
    let is_finer = |bound: &Tree| {
        let at = |bits: i32| {
            let number = |name| if name == PRECISION { Exact::power_of_two(bits) } else { Exact::from(2) };
            bound.eval(&number, &|step| match step {
                Op::Rounded(x) => Some(x.clone()),
                step => piecewise_ops(step),
            })
        };
        at(60).zip(at(20)).is_none_or(|(fine, coarse)| fine * Exact::from(2) <= coarse)
    };
    claim.iter().all(|instance| match &instance.proposition {
        Proposition::Within(_, bound) => is_finer(bound),
        _ => true,
    })
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
    floats(case).is_some_and(|floats| {
        let values = Evaluation::of(program, &floats, |name| Some(case.get_by_symbol(name)));
        places.iter().all(|place| values.at(*place).is_some_and(Option::is_some))
    })
}

/// Returns the floats of a case, with the coarsest precision of its parameters.
fn floats<T: Scalar + Real + ToExact>(case: &Case<T>) -> Option<Floats<T>> {
    let SpringMass { c, g, l, h, .. } = &case.system;
    Floats::coarsest([c, g, l, h, &case.eps, &case.u])
}

/// A claim about rounding, compiled.
struct Law {
    statement: Statement,
    hypotheses: Compiled,
    claim: Compiled,
    bounds_vanish: bool,
    /// Whether λ must repeat within the steps.
    repeats: bool,
}

impl Law {
    fn of(statement: &Statement) -> Self {
        let instances = instances(statement, STEPS);
        Law {
            statement: statement.clone(),
            bounds_vanish: bounds_vanish(&instances),
            repeats: statement.hypotheses().contains(&crate::claims::hypotheses().computed_repeats),
            hypotheses: Compiled::of(premises(statement)),
            claim: Compiled::of(instances),
        }
    }

    /// Evaluates the law with computed numbers; `None` if a hypothesis does not hold, or if a number is out of
    /// range.
    fn trial<T: Scalar + Real + ToExact>(&self, case: &Case<T>) -> Option<Trial> {
        let floats = floats(case)?;
        let repeated = if self.repeats { Some(find_repeat(case, floats.precision())?) } else { None };
        let parameter = |name: &str| match (Var::named(name), &repeated) {
            (Some(Var::Lambda), Some(step)) => step.multiplier.clone(),
            (Some(Var::U), Some(step)) => step.deflection.clone(),
            _ => match SCALES.iter().position(|scale| *scale == name) {
                Some(i) => power_of_two(UNITS[i]),
                None => case.get_by_symbol(name),
            },
        };
        let symbol = |name: &'static str| match name {
            PRECISION => Some(floats.precision().clone()),
            name => parameter(name).to_exact().ok(),
        };
        let float = |name: &'static str| Some(parameter(name));
        let computed = Computed(self.hypotheses.evaluate(&floats, float));
        let hypotheses = self.hypotheses.evaluate(&computed, symbol);
        for (_, test) in self.hypotheses.tests() {
            hypotheses.outcome(test)?.ok()?;
        }
        let computed = Computed(self.claim.evaluate(&floats, float));
        let values = self.claim.evaluate(&computed, symbol);
        let mut holds = true;
        for (_, test) in self.claim.tests() {
            holds &= values.outcome(test)?.is_ok();
        }
        if !self.bounds_vanish {
            return Some(Trial::Decided(holds));
        }
        // The largest error for each bound.
        let mut measured: BTreeMap<usize, Exact> = BTreeMap::new();
        for (_, test) in self.claim.tests() {
            if let Test::Within { of, bound } = test {
                let error = values.at(*of)?.as_ref()?.abs();
                let largest = measured.entry(*bound).or_insert_with(Exact::zero);
                if error > *largest {
                    *largest = error;
                }
            }
        }
        let trial =
            |(bound, error): (usize, Exact)| Some(Trial::Within { error, bound: values.at(bound)?.clone()? });
        let worst = measured.into_iter().filter_map(trial).reduce(worse);
        Some(worst.unwrap_or(Trial::Decided(holds)))
    }
}

/// Iterates the augmentation until λ repeats.
fn find_repeat<T: Scalar + Real + ToExact>(case: &Case<T>, precision: &Exact) -> Option<Iterate<T>> {
    let Case { system, eps, .. } = case;
    let bits = precision.as_rational().numer().significant_bits() as usize;
    // For ε ≥ c each step gains at least one bit.
    let enough = if *eps >= system.c { (bits + STEPS).min(MOST_STEPS) } else { STEPS };
    let mut steps = Augmentation::new(system, eps).over(Plane::Bilateral);
    for _ in 0..enough {
        let step = steps.step();
        if *steps.multiplier() == step.multiplier {
            return Some(step);
        }
    }
    None
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

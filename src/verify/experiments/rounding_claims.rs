//! Experiments on the claims about rounding, evaluated with computed numbers.

use super::{Experiment, MAX_STEPS, STEPS, Trial, UNITS, check, power_of_two};
use crate::chapter::{SpringMass, augmented, structure, system};
use crate::claims::{Case, claims, symbols};
use crate::eval::{
    Compiled, Decidable, Domain, Evaluation, Floats, Instance, RoundedRationals, Test, UNFOLDED_MEMBERS,
    Value, instances, premises,
};
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Hypothesis, Proposition, Statement};
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Program, Real, ToExact, Tree};
use crate::solver::{Augmentation, Iterate, Plane, Scalar};
use std::borrow::Cow;
use std::sync::{Arc, LazyLock};

/// Returns an experiment for each claim about rounding.
pub(super) fn experiments<T: Scalar + Real + ToExact>() -> Vec<Experiment<T>> {
    // Compiled once for all number systems.
    static CLAIMS: LazyLock<Vec<Arc<RoundingClaim>>> = LazyLock::new(|| {
        let about_rounding = claims().filter(|claim| claim.contains_rounding());
        about_rounding.map(|claim| Arc::new(RoundingClaim::of(claim))).collect()
    });
    CLAIMS.iter().cloned().map(experiment).collect()
}

fn experiment<T: Scalar + Real + ToExact>(claim: Arc<RoundingClaim>) -> Experiment<T> {
    let hypotheses = claim.statement.hypotheses().iter();
    Experiment {
        equation: claim.statement.equation(),
        name: claim.statement.name(),
        statement: None,
        hypotheses: hypotheses.filter(|hypothesis| is_of_parameters(hypothesis)).cloned().collect(),
        check: check(move |case: &Case<T>| claim.trial(case).unwrap_or(Trial::Undecided)),
    }
}

/// Returns `true` if cases can be sampled to satisfy the hypothesis. Hypotheses on computed quantities and on
/// the precision are tested in each trial.
fn is_of_parameters(hypothesis: &Hypothesis) -> bool {
    !hypothesis.value.contains_rounding()
        && hypothesis.interval().is_none()
        && !hypothesis.value.symbols().contains(PRECISION)
}

/// Returns `true` if all bounds vanish with η; for other bounds the ratio of error and bound has no meaning.
fn bounds_vanish(claim: &[Instance]) -> bool {
    claim.iter().all(|instance| match &instance.proposition {
        Proposition::Within(_, bound) => {
            let [fine, coarse] = [60, 20].map(|bits| bound_at(bound, bits));
            fine.zip(coarse).is_none_or(|(fine, coarse)| fine * Exact::from(2) <= coarse)
        }
        _ => true,
    })
}

/// Returns a bound in this precision, with 2 for all other symbols.
fn bound_at(bound: &Tree, bits: i32) -> Option<Exact> {
    bound.eval(
        &|symbol| if symbol == PRECISION { Exact::power_of_two(bits) } else { Exact::from(2) },
        &|step| match step {
            Op::Rounded(x) => Some(x.clone()),
            step => piecewise_ops(step),
        },
    )
}

/// Returns `true` if the computed results have neither underflow nor overflow, so that the model of rounding
/// to p bits applies.
pub(super) fn in_range<T: Scalar + Real + ToExact>(case: &Case<T>) -> bool {
    static FORMULAS: LazyLock<(Program, [usize; 4])> = LazyLock::new(|| {
        let Case { system: s, eps, lambda, .. } = symbols();
        let u = augmented::deflection(s, eps, lambda);
        let formulas = [
            augmented::update(s, eps, lambda, &u),
            augmented::contact_force(s, &u),
            structure::deflection(s),
            system::reaction(s),
        ];
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
struct RoundingClaim {
    statement: Statement,
    hypotheses: Compiled,
    claim: Compiled,
    bounds_vanish: bool,
    /// Whether λ must repeat within the steps.
    repeats: bool,
}

impl RoundingClaim {
    fn of(statement: &Statement) -> Self {
        let instances = instances(statement, UNFOLDED_MEMBERS);
        RoundingClaim {
            statement: statement.clone(),
            bounds_vanish: bounds_vanish(&instances),
            repeats: statement.hypotheses().contains(&crate::claims::hypotheses().computed_repeats),
            hypotheses: Compiled::of(premises(statement)),
            claim: Compiled::of(instances),
        }
    }

    /// Evaluates the claim with computed numbers; `None` if a hypothesis does not hold, or if a number is out
    /// of range.
    fn trial<T: Scalar + Real + ToExact>(&self, case: &Case<T>) -> Option<Trial> {
        let mut numbers = Numbers { case: Cow::Borrowed(case), floats: floats(case)? };
        if self.repeats {
            let repeated = find_repeat(case, numbers.floats.precision())?;
            let Iterate { multiplier: lambda, deflection: u, .. } = repeated;
            numbers.case = Cow::Owned(Case { lambda, u, ..case.clone() });
        }
        let hypotheses = numbers.evaluate(&self.hypotheses);
        for (_, test) in self.hypotheses.tests() {
            hypotheses.outcome(test)?.ok()?;
        }
        let claim = numbers.evaluate(&self.claim);
        let (mut holds, mut worst) = (true, None);
        for (_, test) in self.claim.tests() {
            holds &= claim.outcome(test)?.is_ok();
            if let Test::Within { of, bound } = test {
                let (error, bound) = (claim.at(*of)?.exact()?.abs(), claim.at(*bound)?.exact()?);
                if worst.as_ref().is_none_or(|worst| is_worse(&error, bound, worst)) {
                    worst = Some((error, bound));
                }
            }
        }
        Some(match worst {
            Some((error, bound)) if self.bounds_vanish => Trial::Within { error, bound: bound.clone() },
            _ => Trial::Decided(holds),
        })
    }
}

/// Numbers of a trial, and the floats that compute with them.
struct Numbers<'a, T: Clone> {
    case: Cow<'a, Case<T>>,
    floats: Floats<T>,
}

impl<T: Scalar + Real + ToExact> Numbers<'_, T> {
    fn float(&self, symbol: &str) -> T {
        let unit = UNITS.iter().zip(SCALES).find(|(_, scale)| *scale == symbol);
        unit.map_or_else(|| self.case.get_by_symbol(symbol), |(exponent, _)| power_of_two(*exponent))
    }

    fn exact(&self, symbol: &str) -> Value {
        let number = match symbol {
            PRECISION => Ok(self.floats.precision().clone()),
            symbol => self.float(symbol).to_exact(),
        };
        number.map_or_else(|_| Value::unknown(), Value::Exact)
    }

    /// Evaluates formulas, with floats for what is below a rounding.
    fn evaluate<'a>(
        &'a self,
        formulas: &'a Compiled,
    ) -> Evaluation<'a, impl Domain<Value = Value>, impl Fn(&'static str) -> Value> {
        let floats = formulas.evaluate(&self.floats, |symbol| Some(self.float(symbol)));
        formulas.evaluate(RoundedRationals(floats), |symbol| self.exact(symbol))
    }
}

/// Iterates the augmentation until λ repeats.
fn find_repeat<T: Scalar + Real + ToExact>(case: &Case<T>, precision: &Exact) -> Option<Iterate<T>> {
    let Case { system, eps, .. } = case;
    let bits = precision.as_rational().numer().significant_bits() as usize;
    // For ε ≥ c each step gains at least one bit.
    let max_steps = if *eps >= system.c { (bits + STEPS).min(MAX_STEPS) } else { STEPS };
    let mut steps = Augmentation::new(system, eps).over(Plane::Bilateral);
    for _ in 0..max_steps {
        let step = steps.step();
        if *steps.multiplier() == step.multiplier {
            return Some(step);
        }
    }
    None
}

/// Returns `true` if an error exceeds its bound, or has a larger ratio to it than another one that does not.
fn is_worse(error: &Exact, bound: &Exact, (other, other_bound): &(Exact, &Exact)) -> bool {
    error > bound || other * bound < error * *other_bound
}

#[cfg(test)]
mod tests;

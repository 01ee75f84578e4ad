//! Answers to problems, and mistakes that explain them.

use super::assessment::{balls, is_within, rounded, rounds_alike, scales, sizes};
use super::mistakes::{
    Constants, Estimate, Formulas, Mistake, PenaltyEvidence, right, value, value_in_single,
};
use super::problems::short;
use super::{Answer, CaseResult, Problem, Reply, Value, Verdict};
use crate::chapter::{SpringMass, augmented, contact, system};
use crate::number::{Ball, Exact, PositivePart, ToExact, Tree};
use num_traits::Zero;

/// An answer with its problem.
pub(super) struct Observation<'a> {
    pub problem: &'a Problem,
    pub answer: &'a Answer,
    /// Scales of the errors of u and N.
    pub scales: [Exact; 2],
    /// Sum of the lengths of the system, and that of its forces.
    sizes: [Exact; 2],
    /// The system in balls around floats of 53 bits, if it is in range.
    balls: Option<SpringMass<Ball<f64>>>,
    pub exact: [&'a Exact; 2],
    pub lags: Option<bool>,
    pub wrong: bool,
}

/// N/p, in N/m.
pub(super) struct Ratio<'a> {
    pub system: &'a SpringMass<Exact>,
    pub value: Exact,
    /// Penetration relative to its rounding error in f64.
    pub clarity: Exact,
}

impl<'a> Observation<'a> {
    pub fn of(checked: &'a CaseResult) -> Option<Self> {
        let Reply::Answered(answer) = &checked.reply else { return None };
        let judgement = &checked.assessment;
        let problem = judgement.solved.as_ref()?;
        let system = &problem.system;
        Some(Observation {
            problem,
            answer,
            scales: scales(system),
            sizes: sizes(system),
            balls: balls(&0f64, system),
            exact: [&judgement.exact.deflection, &judgement.exact.contact_force],
            lags: judgement.lags,
            wrong: judgement.verdict == Verdict::Wrong,
        })
    }

    /// Returns force divided by penetration, if it is positive, and the penetration exceeds the rounding
    /// error of lengths and deflection in f64 by a factor of a thousand.
    pub fn ratio(&self, by: PenaltyEvidence, tolerance: &Exact) -> Option<Ratio<'_>> {
        let (force, u) = (self.force(by, tolerance)?, self.answer.deflection.as_ref()?);
        let system = &self.problem.system;
        let p = contact::penetration(system, u);
        let rounding = (system.l.abs() + system.h.abs() + u.abs()) * Exact::power_of_two(-53);
        if p.abs() <= Exact::from(1000) * &rounding {
            return None;
        }
        let (value, clarity) = (force / &p, p.abs() / rounding);
        (value > Exact::zero()).then_some(Ratio { system, value, clarity })
    }

    /// Returns the force from which a penalty could be determined, if there is one.
    pub fn force(&self, by: PenaltyEvidence, tolerance: &Exact) -> Option<Exact> {
        let system = &self.problem.system;
        let force = match by {
            PenaltyEvidence::ByForce => self.answer.contact_force.clone()?,
            PenaltyEvidence::ByEquilibrium if self.exact[1].is_zero() => {
                augmented::contact_force(system, self.answer.deflection.as_ref()?)
            }
            PenaltyEvidence::ByEquilibrium => return None,
        };
        (force.abs() > tolerance * &self.scales[1]).then_some(force)
    }

    /// Returns the penalty that the solver reported, or that of the problem.
    pub fn reported_penalty(&self) -> Option<Exact> {
        self.answer.used.penalty.clone().flatten().or_else(|| self.problem.penalty.clone())
    }

    /// Returns u and N.
    pub fn numbers(&self) -> [&Value; 2] {
        [&self.answer.deflection, &self.answer.contact_force]
    }

    /// Returns `true` if a program with this mistake and these constants gives this answer. Returns `false`
    /// if it contains an unknown penalty.
    pub fn is_explained_by(
        &self,
        mistake: &Mistake,
        constants: &Constants<Exact>,
        tolerance: &Exact,
    ) -> bool {
        let system = &self.problem.system;
        let Observation { scales, sizes, .. } = self;
        let numbers = self.numbers();
        let Constants { penalty, factor } = *constants;
        if penalty.is_none() && mistake.has_penalty() {
            return false;
        }
        // The rounding errors of the formulas in f64 are allowed; but with a penalty that is only reported,
        // and cannot be determined, they could explain any number.
        let ball = |x: Option<&Exact>| x.and_then(|x| Ball::enclosing(&0f64, x).ok());
        let (eps, k) = (ball(penalty), ball(factor));
        let in_balls = Constants { penalty: eps.as_ref(), factor: k.as_ref() };
        let has_penalty = self.reported_penalty().is_some();
        let within = |x: &Exact, formula: &Tree, size: &Exact| {
            let ball = self.balls.as_ref().and_then(|system| value(formula, system, &in_balls));
            ball.is_some_and(|ball| {
                if has_penalty { is_within(&ball, x, size) } else { ball.is_finite() && ball.contains(x) }
            })
        };
        let fits = |formulas: &Formulas| {
            (0..2).all(|i| match (numbers[i], value(&formulas[i], system, constants)) {
                (Some(own), Some(x)) => {
                    (own - &x).abs() <= tolerance * (&scales[i] + x.abs())
                        || within(own, &formulas[i], &sizes[i])
                }
                (None, None) => true,
                _ => false,
            })
        };
        // This close to grazing, rounding may change the state.
        let (reaction, near) = (mistake.reaction(system, constants), tolerance * &scales[1]);
        reaction >= -&near && fits(&mistake.in_contact) || reaction <= near && fits(&mistake.separated)
    }

    /// Returns `true` if both numbers have the form of single precision, with the accuracy of a program that
    /// computes in it.
    pub fn is_single(&self) -> bool {
        self.is_right_in_single()
            && self.numbers().into_iter().all(|x| x.as_ref().is_some_and(is_single_number))
    }

    /// Each number has at most eight rounding errors relative to the sum of lengths or forces: those of its
    /// parameters (c, m and g, or l and H), and of up to four operations in any order.
    fn is_right_in_single(&self) -> bool {
        let penalty = self.problem.penalty.as_ref();
        let force = penalty.map(|eps| eps * &self.sizes[0]).unwrap_or_else(Exact::zero) + &self.sizes[1];
        let most = [&self.sizes[0] * Exact::power_of_two(-21), force * Exact::power_of_two(-21)];
        (0..2).all(|i| {
            let off = self.numbers()[i].as_ref().map(|x| (x - self.exact[i]).abs());
            off.is_some_and(|off| off <= most[i] && most[i] <= self.sizes[i])
        })
    }

    /// Returns `true` if a program with one rounding to single precision gives this answer.
    pub fn is_explained_in_single(&self, mistake: &Mistake, tolerance: &Exact) -> bool {
        let system = &self.problem.system;
        // The formulas are the same in both states.
        let value = |tree| value_in_single(tree, system, self.problem.penalty.as_ref());
        self.is_near(mistake.in_contact.each_ref().map(value), tolerance)
    }

    /// Returns `true` if a right program with these parameters gives this answer.
    pub fn is_explained_by_parameters(&self, system: &SpringMass<Exact>, tolerance: &Exact) -> bool {
        self.is_near(right(system, self.problem.penalty.as_ref()).map(Some), tolerance)
    }

    /// Returns `true` if the numbers are within the rounding error of f64 of the right answer, or within the
    /// tolerance.
    fn is_near(&self, numbers: [Value; 2], tolerance: &Exact) -> bool {
        let balls = rounded(&0f64, self.problem);
        (0..2).all(|i| {
            let (Some(x), Some(own)) = (&numbers[i], self.numbers()[i]) else { return false };
            let off = (own - x).abs();
            let radius = balls.as_ref().and_then(|balls| balls[i].radius().to_exact().ok());
            let rounding = radius.is_some_and(|radius| radius <= self.sizes[i] && off <= radius);
            rounding || off <= tolerance * &self.scales[i] || rounds_alike(own, x)
        })
    }

    /// Returns the constant of a mistake that this answer determines.
    pub fn factor_of(&self, estimate: &Estimate) -> Option<Exact> {
        match estimate {
            Estimate::Number(which) => self.numbers()[*which].clone(),
            Estimate::Augmentations(steps) => {
                let system = &self.problem.system;
                let p = contact::penetration(system, self.answer.deflection.as_ref()?);
                let reaction = system::reaction(system);
                // ρᵏ from the penetration R/c without a plane, with ρ = c/(c + ε).
                let left = (reaction > Exact::zero()).then(|| &system.c * p / reaction)?;
                let contraction = left.to_f64().ok()?.powf(1.0 / f64::from(*steps)).to_exact().ok()?;
                (contraction > Exact::zero()).then(|| &system.c / contraction - &system.c)
            }
            Estimate::Ratio(which) => {
                let (own, exact) = (self.numbers()[*which].as_ref()?, self.exact[*which]);
                (!exact.is_zero()).then(|| own / exact)
            }
            Estimate::Equation(tree) => {
                let (u, n) = (self.answer.deflection.as_ref()?, self.answer.contact_force.as_ref()?);
                let symbol = |name: &str| match (name, self.problem.system.by_symbol(name)) {
                    (_, Some(parameter)) => parameter.clone(),
                    ("u", None) => u.clone(),
                    ("N", None) => n.clone(),
                    // k is arbitrary in a formula that is linear in it.
                    _ => self.problem.penalty.clone().unwrap_or_else(Exact::zero),
                };
                tree.solve_linear("k", &symbol, &Exact::zero())
            }
        }
    }

    /// Returns u or N relative to its exact value. Returns `None` if both are nearly zero.
    pub fn factor(&self, which: usize, tolerance: &Exact) -> Option<Option<Exact>> {
        let small = |x: &Exact| x.abs() <= tolerance * &self.scales[which];
        let Some(number) = self.numbers()[which] else { return Some(None) };
        match (small(self.exact[which]), small(number)) {
            (true, true) => None,
            (true, false) => Some(None),
            (false, _) => Some(Some(number / self.exact[which])),
        }
    }
}

/// Returns `true` if the number could be printed from single precision: its exact value, the digits that
/// identify it in double precision, or at most the nine that identify it in single precision.
fn is_single_number(x: &Exact) -> bool {
    let itself = x.to_f32().ok().and_then(|x| x.to_exact().ok());
    itself.is_some_and(|single| rounds_alike(&single, x)) || has_digits(x, 9)
}

/// Returns `true` if the number is a decimal with at most `digits` digits.
pub(super) fn has_digits(x: &Exact, digits: usize) -> bool {
    short(x, digits) == *x
}

//! An answer to a problem, and what it fits.

use super::judge::{balls, is_within, rounded, scales, sizes};
use super::mistakes::{Formulas, Measured, Mistake, value};
use super::problems::short;
use super::{Answer, Checked, Problem, Reply, Value, Verdict};
use crate::chapter::{SpringMass, augmented, contact, system};
use crate::number::{Ball, Exact, PositivePart, ToExact, Tree};
use num_traits::Zero;

/// An answer, and the problem that it is one of.
pub(super) struct Given<'a> {
    pub problem: &'a Problem,
    pub answer: &'a Answer,
    /// What errors of u and N are measured by.
    pub scales: [Exact; 2],
    /// The lengths of the system together, and its forces.
    sizes: [Exact; 2],
    /// The system in balls around floats of 53 bits, if it fits.
    balls: Option<SpringMass<Ball<f64>>>,
    pub exact: [&'a Exact; 2],
    pub lags: Option<bool>,
    pub wrong: bool,
}

/// N/p, in N/m.
pub(super) struct Ratio<'a> {
    pub system: &'a SpringMass<Exact>,
    pub value: Exact,
    /// How many times what it may be rounded by in f64 the penetration is.
    pub clarity: Exact,
}

impl<'a> Given<'a> {
    pub fn of(checked: &'a Checked) -> Option<Self> {
        let Reply::Answered(answer) = &checked.reply else { return None };
        let judgement = &checked.judgement;
        let problem = judgement.solved.as_ref()?;
        let system = &problem.system;
        Some(Given {
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

    /// Force by penetration, if it is positive, and the penetration is more than a thousand times what the
    /// lengths and the deflection may be rounded by in f64.
    pub fn ratio(&self, by: Measured, tolerance: &Exact) -> Option<Ratio<'_>> {
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

    /// The force that a penalty would be told by, if there is any.
    pub fn force(&self, by: Measured, tolerance: &Exact) -> Option<Exact> {
        let system = &self.problem.system;
        let force = match by {
            Measured::ByForce => self.answer.contact_force.clone()?,
            Measured::ByEquilibrium if self.exact[1].is_zero() => {
                augmented::contact_force(system, self.answer.deflection.as_ref()?)
            }
            Measured::ByEquilibrium => return None,
        };
        (force.abs() > tolerance * &self.scales[1]).then_some(force)
    }

    /// The penalty that it says it took, or that it was asked for.
    pub fn told(&self) -> Option<Exact> {
        self.answer.used.penalty.clone().flatten().or_else(|| self.problem.penalty.clone())
    }

    /// u and N.
    pub fn numbers(&self) -> [&Value; 2] {
        [&self.answer.deflection, &self.answer.contact_force]
    }

    /// Does a program with this mistake, and this penalty, answer so? Not if it has a penalty that nobody
    /// knows.
    pub fn fits(&self, mistake: &Mistake, penalty: Option<&Exact>, tolerance: &Exact) -> bool {
        let system = &self.problem.system;
        let Given { scales, sizes, .. } = self;
        let numbers = self.numbers();
        if penalty.is_none() && mistake.has_penalty() {
            return false;
        }
        // What f64 makes of the formulas is theirs, too; but under a penalty that only has to be told, and
        // not to be seen, it could be anything.
        let eps = penalty.and_then(|eps| Ball::around(&0f64, eps).ok());
        let told = self.told().is_some();
        let within = |x: &Exact, formula: &Tree, size: &Exact| {
            let ball = self.balls.as_ref().and_then(|system| value(formula, system, eps.as_ref()));
            ball.is_some_and(|ball| {
                if told { is_within(&ball, x, size) } else { ball.is_finite() && ball.contains(x) }
            })
        };
        let fits = |formulas: &Formulas| {
            (0..2).all(|i| match (numbers[i], value(&formulas[i], system, penalty)) {
                (Some(own), Some(x)) => {
                    (own - &x).abs() <= tolerance * (&scales[i] + x.abs())
                        || within(own, &formulas[i], &sizes[i])
                }
                (None, None) => true,
                _ => false,
            })
        };
        // So near to grazing rounding may take one for the other.
        let (reaction, near) = (system::reaction(system), tolerance * &scales[1]);
        reaction >= -&near && fits(&mistake.touching) || reaction <= near && fits(&mistake.apart)
    }

    /// Is it as far off as single precision may take what is right, and are its numbers of single precision?
    pub fn is_single(&self) -> bool {
        rounded(&0f32, self.problem).is_some_and(|balls| {
            (0..2).all(|i| {
                let x = self.numbers()[i].as_ref();
                x.is_some_and(|x| is_within(&balls[i], x, &self.sizes[i]) && is_single_number(x))
            })
        })
    }

    /// What is right by this factor off: u in parts of the exact one, or N. `None` where that is nearly zero,
    /// and the number as well.
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

/// Is this what is printed of a number of single precision: itself, or no more than the nine digits that tell
/// it?
fn is_single_number(x: &Exact) -> bool {
    let itself = x.to_f32().ok().and_then(|x| x.to_exact().ok());
    itself.as_ref() == Some(x) || has_digits(x, 9)
}

/// Is it a decimal of so many digits?
pub(super) fn has_digits(x: &Exact, digits: usize) -> bool {
    short(x, digits) == *x
}

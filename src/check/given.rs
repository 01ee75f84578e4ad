//! An answer to a problem, and what it fits.

use super::judge::{balls, is_within, rounded, rounds_alike, scales, sizes};
use super::mistakes::{Constants, Estimate, Formulas, Measured, Mistake, right, value, value_in_single};
use super::problems::short;
use super::{Answer, Checked, Problem, Reply, Value, Verdict};
use crate::chapter::{SpringMass, augmented, contact, system};
use crate::number::{Ball, Exact, PositivePart, ToExact, Tree};
use num_traits::{One, Zero};

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

    /// Does a program with this mistake, and these constants, answer so? Not if it has a constant that nobody
    /// knows.
    pub fn fits(&self, mistake: &Mistake, constants: &Constants<Exact>, tolerance: &Exact) -> bool {
        let system = &self.problem.system;
        let Given { scales, sizes, .. } = self;
        let numbers = self.numbers();
        let Constants { penalty, factor } = *constants;
        if penalty.is_none() && mistake.has_penalty() || factor.is_none() && mistake.has_factor() {
            return false;
        }
        // What f64 makes of the formulas is theirs, too; but under a penalty that only has to be told, and
        // not to be seen, it could be anything.
        let ball = |x: Option<&Exact>| x.and_then(|x| Ball::around(&0f64, x).ok());
        let (eps, k) = (ball(penalty), ball(factor));
        let in_balls = Constants { penalty: eps.as_ref(), factor: k.as_ref() };
        let told = self.told().is_some();
        let within = |x: &Exact, formula: &Tree, size: &Exact| {
            let ball = self.balls.as_ref().and_then(|system| value(formula, system, &in_balls));
            ball.is_some_and(|ball| {
                if told { is_within(&ball, x, size) } else { ball.is_finite() && ball.contains(x) }
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
        // So near to grazing rounding may take one for the other.
        let (reaction, near) = (mistake.reaction(system, constants), tolerance * &scales[1]);
        reaction >= -&near && fits(&mistake.touching) || reaction <= near && fits(&mistake.apart)
    }

    /// Returns `true` if both numbers are what is printed of numbers of single precision, and no further off
    /// than a program that computes in it may be.
    pub fn is_single(&self) -> bool {
        self.is_right_in_single()
            && self.numbers().into_iter().all(|x| x.as_ref().is_some_and(is_single_number))
    }

    /// Each number relative to the lengths or the forces of the system together is off by eight roundings at
    /// most: of its parameters (c, m and g, or l and H), and of up to four operations, whatever their order
    /// is.
    fn is_right_in_single(&self) -> bool {
        let penalty = self.problem.penalty.as_ref();
        let force = penalty.map(|eps| eps * &self.sizes[0]).unwrap_or_else(Exact::zero) + &self.sizes[1];
        let most = [&self.sizes[0] * Exact::power_of_two(-21), force * Exact::power_of_two(-21)];
        (0..2).all(|i| {
            let off = self.numbers()[i].as_ref().map(|x| (x - self.exact[i]).abs());
            off.is_some_and(|off| off <= most[i] && most[i] <= self.sizes[i])
        })
    }

    /// Does a program with one rounding to single precision answer so?
    pub fn fits_in_single(&self, mistake: &Mistake, tolerance: &Exact) -> bool {
        let system = &self.problem.system;
        let formulas = mistake.formulas(system::reaction(system) > Exact::zero());
        let value = |tree| value_in_single(tree, system, self.problem.penalty.as_ref());
        self.is_near(formulas.each_ref().map(value), tolerance)
    }

    /// Does a program answer so that is right but for taking these parameters?
    pub fn fits_parameters(&self, system: &SpringMass<Exact>, tolerance: &Exact) -> bool {
        self.is_near(right(system, self.problem.penalty.as_ref()).map(Some), tolerance)
    }

    /// Are its numbers these: to what rounding in f64 may do to the right answer, or within the tolerance?
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

    /// The constant of a mistake, by what this answer shows of it.
    pub fn factor_of(&self, estimate: &Estimate) -> Option<Exact> {
        match estimate {
            Estimate::Number(which) => self.numbers()[*which].clone(),
            Estimate::Augmentations(steps) => {
                let system = &self.problem.system;
                let p = contact::penetration(system, self.answer.deflection.as_ref()?);
                let reaction = system::reaction(system);
                // ρᵏ of the penetration R/c without a plane, and ρ = c/(c + ε).
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
                let SpringMass { c, m, g, l, h } = &self.problem.system;
                let symbol = |name: &str| match name {
                    "c" => c.clone(),
                    "m" => m.clone(),
                    "g" => g.clone(),
                    "l" => l.clone(),
                    "H" => h.clone(),
                    "u" => u.clone(),
                    "N" => n.clone(),
                    // Of a formula that is linear in k it does not matter where one starts.
                    "k" => Exact::one(),
                    _ => self.problem.penalty.clone().unwrap_or_else(Exact::zero),
                };
                tree.solution("k", &symbol, &Exact::zero())
            }
        }
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

/// Is this what is printed of a number of single precision: itself, with all its digits or with those that
/// tell it in double, or no more than the nine that tell it in single?
fn is_single_number(x: &Exact) -> bool {
    let itself = x.to_f32().ok().and_then(|x| x.to_exact().ok());
    itself.is_some_and(|single| rounds_alike(&single, x)) || has_digits(x, 9)
}

/// Is it a decimal of so many digits?
pub(super) fn has_digits(x: &Exact, digits: usize) -> bool {
    short(x, digits) == *x
}

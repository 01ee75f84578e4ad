//! Assessment of an answer without rounding.
//!
//! Errors are relative to the scales of the system: the error of u to |H − l| + |m g/c|, that of N to |m g| +
//! |c (H − l)|. Residuals alone would not suffice: a solver can be in equilibrium to twelve digits with forty
//! times the force.

use super::problems::decimal;
use super::program::right;
use super::{Answer, Problem, Reply, Value};
use crate::chapter::contact::{self, Kkt};
use crate::chapter::{SpringMass, augmented, structure, system};
use crate::number::{Ball, Exact, PositivePart, Real, ToExact};
use crate::solver::{Method, Solution, State, solve};
use num_traits::{One, Zero};
use std::fmt;

/// Verdict on an answer, in increasing severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Verdict {
    /// Within the rounding error of the formula in f64.
    Right,
    /// Within the tolerance.
    WithinTolerance,
    /// Refused, with a reason.
    Refused,
    /// Beyond the tolerance, or otherwise wrong.
    Wrong,
    /// Not answered in time.
    TimedOut,
    /// The solver terminated.
    Crashed,
}

/// Writes the name used in JSON.
impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Verdict::Right => "right",
            Verdict::WithinTolerance => "within_tolerance",
            Verdict::Refused => "refused",
            Verdict::Wrong => "wrong",
            Verdict::TimedOut => "timed_out",
            Verdict::Crashed => "crashed",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Verdict);

/// Comparison of an answer with the exact solution.
#[derive(Clone, Debug)]
pub struct Assessment {
    /// The verdict.
    pub verdict: Verdict,
    /// Exact solution for the parameters that the solver used.
    pub exact: Solution<Exact>,
    /// Whether u and N are right or within the tolerance.
    pub(super) has_right_numbers: bool,
    /// The problem with these parameters, if there is an answer.
    pub(super) solved: Option<Problem>,
    /// Error of u relative to |H − l| + |m g/c|.
    pub deflection_error: Option<Exact>,
    /// Error of N relative to |m g| + |c (H − l)|.
    pub force_error: Option<Exact>,
    /// Residuals of (1.6) and of equilibrium.
    pub kkt: Option<Kkt<Exact>>,
    /// Description of the error.
    pub finding: Option<String>,
    /// Whether the force of each step is that of the previous step; `None` if the steps do not decide it.
    pub lags: Option<bool>,
}

impl Problem {
    /// Returns the exact solution of (1.6), or of (1.13) and (1.12) with unilateral contact.
    ///
    /// # Panics
    /// Panics if c, m or ε is not positive.
    pub fn solution(&self) -> Solution<Exact> {
        let method = match &self.penalty {
            None => Method::Lagrange,
            Some(penalty) => Method::Penalty { penalty: penalty.clone() },
        };
        solve(&self.system, &method).expect("a system with c, m and ε > 0")
    }

    /// Returns the problem with the parameters that the solver used, or the parameter that differs.
    fn as_used(&self, answer: &Answer, tolerance: &Exact) -> Result<Problem, String> {
        // The signs are kept, since c, m and ε are positive.
        let taken = |name: &str, asked: &Exact, used: &Option<Value>| match used {
            None => Ok(asked.clone()),
            Some(Some(used))
                if (used - asked).abs() <= tolerance * asked.abs()
                    && used.cmp(&Exact::zero()) == asked.cmp(&Exact::zero()) =>
            {
                Ok(used.clone())
            }
            Some(Some(used)) => {
                Err(format!("it used {name} = {} instead of {}", format_short(used), format_short(asked)))
            }
            Some(None) => {
                Err(format!("it used a value for {name} = {} that is not a number", format_short(asked)))
            }
        };
        let asked = SpringMass::KEYS.zip(self.system.as_ref());
        let system = asked.zip(answer.used.system.as_ref());
        let system = system.try_map(|((key, asked), used)| taken(key, asked, used))?;
        let penalty = match &self.penalty {
            None => None,
            Some(asked) => Some(taken("penalty", asked, &answer.used.penalty)?),
        };
        Ok(Problem { system, penalty, ..self.clone() })
    }
}

/// Formats six digits.
fn format_short(x: &Exact) -> String {
    x.decimal(6, rug::float::Round::Nearest)
}

/// Returns the scales of the errors of u, in m, and N, in N; one SI unit if the scale is zero.
pub(super) fn scales(system: &SpringMass<Exact>) -> [Exact; 2] {
    let gap = system::gap(system);
    let free = structure::deflection(system);
    let weight = system::weight(system);
    let scales = [gap.abs() + free.abs(), weight.abs() + (&system.c * gap).abs()];
    scales.map(|scale| if scale.is_zero() { Exact::one() } else { scale })
}

/// Returns a system in balls around floats, if it is in range; `like` determines the precision.
pub(super) fn balls<T: Real + ToExact>(like: &T, system: &SpringMass<Exact>) -> Option<SpringMass<Ball<T>>> {
    system.try_map(|x| Ball::enclosing(like, x)).ok()
}

/// Returns enclosures of the float results of the formulas for u and N, if the parameters are in range;
/// `like` determines the precision.
pub(super) fn rounded<T: Real + ToExact>(like: &T, problem: &Problem) -> Option<[Ball<T>; 2]> {
    let penalty = problem.penalty.as_ref().map(|eps| Ball::enclosing(like, eps)).transpose().ok()?;
    Some(right(&balls(like, &problem.system)?, penalty.as_ref()))
}

/// Returns the sum of the lengths of a system, in m, and that of its forces, in N.
pub(super) fn sizes(system: &SpringMass<Exact>) -> [Exact; 2] {
    let [_, weight] = scales(system);
    let lengths = system.l.abs() + system.h.abs();
    [&lengths + structure::deflection(system).abs(), weight + &system.c * lengths]
}

/// Returns `true` if a number is within the rounding error of a formula. A ball larger than the system itself
/// explains nothing.
pub(super) fn is_within<T: Real + ToExact>(ball: &Ball<T>, x: &Exact, size: &Exact) -> bool {
    let radius = ball.radius().to_exact();
    radius.is_ok_and(|radius| radius <= *size) && ball.contains(x)
}

/// Returns `true` if both numbers are equal or round to the same f64. This accepts the exact solution rounded
/// once, which a ball with a radius of less than half an ulp may not contain.
pub(super) fn rounds_alike(x: &Exact, y: &Exact) -> bool {
    x == y || matches!((x.to_f64(), y.to_f64()), (Ok(x), Ok(y)) if x == y)
}

/// Returns the largest distance of an answer from a value that explains it, relative to the scale of the
/// system and of the value: the tolerance, but at least 10⁻⁶, so that the tolerance does not change which
/// mistakes are distinguished.
pub(super) fn fit(tolerance: &Exact) -> Exact {
    decimal(1, -6).max(tolerance.clone())
}

impl Assessment {
    pub(super) fn of(problem: &Problem, reply: &Reply, tolerance: &Exact) -> Self {
        let without_numbers = |verdict, finding: &str| Assessment {
            verdict,
            exact: problem.solution(),
            has_right_numbers: false,
            solved: None,
            deflection_error: None,
            force_error: None,
            kkt: None,
            finding: Some(finding.to_string()),
            lags: None,
        };
        match reply {
            Reply::Answered(answer) => match problem.as_used(answer, tolerance) {
                Ok(solved) => Assessment::of_answer(solved, answer, tolerance),
                Err(finding) => without_numbers(Verdict::Wrong, &finding),
            },
            Reply::Refused(reason) => without_numbers(Verdict::Refused, reason),
            Reply::InvalidResponse(reason) => without_numbers(Verdict::Wrong, reason),
            Reply::Crashed(how) => without_numbers(Verdict::Crashed, how),
            Reply::TimedOut(seen) => {
                without_numbers(Verdict::TimedOut, &format!("no answer in time; {seen}"))
            }
        }
    }

    fn of_answer(problem: Problem, answer: &Answer, tolerance: &Exact) -> Self {
        let exact = problem.solution();
        let numbers = [&answer.deflection, &answer.contact_force];
        let expected = [&exact.deflection, &exact.contact_force];
        let scales = scales(&problem.system);
        let error = |i: usize| numbers[i].as_ref().map(|x| (x - expected[i]).abs() / &scales[i]);
        let errors = [error(0), error(1)];
        let near = |error: &Option<Exact>| error.as_ref().is_some_and(|error| error <= tolerance);
        let (balls, sizes) = (rounded(&0f64, &problem), sizes(&problem.system));
        let to_rounding = |i: usize| match (&balls, numbers[i]) {
            (Some(balls), Some(x)) => is_within(&balls[i], x, &sizes[i]),
            _ => false,
        };
        // An answer with a larger error is not accepted, whatever explains it.
        let useful = |i: usize| errors[i].as_ref().is_some_and(|error| *error <= fit(tolerance));
        let right = |i: usize| {
            to_rounding(i) && useful(i) || numbers[i].as_ref().is_some_and(|x| rounds_alike(x, expected[i]))
        };
        let well = errors.iter().enumerate().all(|(i, error)| near(error) || right(i));
        let finding = if well {
            penetrates_otherwise(&problem, &exact, answer, tolerance)
        } else {
            let state = || wrong_state(numbers, exact.state, &errors, tolerance, &scales);
            let rounding = (0..2).all(|i| near(&errors[i]) || to_rounding(i));
            let rounding = rounding.then(|| "within the rounding error of f64".to_string());
            rounding.or_else(state)
        };
        let verdict = match (well, &finding) {
            (true, None) if right(0) && right(1) => Verdict::Right,
            (true, None) => Verdict::WithinTolerance,
            _ => Verdict::Wrong,
        };
        let kkt = match numbers {
            [Some(u), Some(n)] => Some(contact::kkt(&problem.system, u, n)),
            _ => None,
        };
        let [deflection_error, force_error] = errors;
        let lags = lags(&problem.system, &answer.steps, &fit(tolerance));
        let solved = Some(problem);
        let has_right_numbers = well;
        Assessment {
            verdict,
            exact,
            has_right_numbers,
            solved,
            deflection_error,
            force_error,
            kkt,
            finding,
            lags,
        }
    }

    /// Returns the larger of the two errors; `None`, which compares less than any error, without numbers.
    pub fn error(&self) -> Option<&Exact> {
        self.deflection_error.as_ref().max(self.force_error.as_ref())
    }
}

/// Describes a penetration that differs from that of the deflection.
fn penetrates_otherwise(
    problem: &Problem,
    exact: &Solution<Exact>,
    answer: &Answer,
    tolerance: &Exact,
) -> Option<String> {
    let said = answer.penetration.as_ref()?;
    let Some(p) = said else { return Some("its penetration is not a number".to_string()) };
    let u = answer.deflection.as_ref()?;
    let own = contact::penetration(&problem.system, u);
    let rounded = balls(&0f64, &problem.system).zip(Ball::enclosing(&0f64, u).ok());
    let rounded = rounded.map(|(system, u)| contact::penetration(&system, &u));
    let [length, _] = scales(&problem.system);
    let rounded_once = rounds_alike(u, &exact.deflection) && rounds_alike(p, &exact.penetration);
    let near = (p - &own).abs() <= tolerance * length;
    let explained = near || rounded_once || rounded.is_some_and(|ball| ball.contains(p));
    (!explained).then(|| {
        format!(
            "its penetration is {}, but that of its deflection is {}",
            format_short(p),
            format_short(&own)
        )
    })
}

/// Describes missing numbers or a wrong state.
fn wrong_state(
    numbers: [&Value; 2],
    state: State,
    errors: &[Option<Exact>; 2],
    tolerance: &Exact,
    scales: &[Exact; 2],
) -> Option<String> {
    let [Some(_), Some(n)] = numbers else {
        let missing = if numbers[0].is_none() { "its deflection" } else { "its contact force" };
        return Some(format!("{missing} is not a number"));
    };
    let small = tolerance * &scales[1];
    let far = errors[1].as_ref().is_some_and(|error| error > tolerance);
    let said = if *n > small {
        "the plane pushes"
    } else if *n < -small {
        "the plane pulls"
    } else {
        "the mass is separated"
    };
    let is = match state {
        State::Contact => "the plane pushes",
        State::Grazing => "they touch without force",
        State::Separated => "the mass is separated",
    };
    (far && said != is).then(|| format!("according to its answer {said}; exactly, {is}"))
}

/// Returns whether the force of each step is that of the previous step. The initial state is not a step, so
/// one step does not decide it.
fn lags(system: &SpringMass<Exact>, steps: &[[Value; 2]], tolerance: &Exact) -> Option<bool> {
    let [_, scale] = scales(system);
    let near =
        |force: &Exact, u: &Exact| (force - augmented::contact_force(system, u)).abs() <= tolerance * &scale;
    let pairs = steps.windows(2).filter_map(|pair| match pair {
        [[Some(u), Some(own)], [_, Some(next)]] => Some((near(own, u), near(next, u))),
        _ => None,
    });
    // If both forces are close, the steps cannot be distinguished.
    let telling = Vec::from_iter(pairs.filter(|(own, next)| !(*own && *next)));
    (telling.len() >= 2).then(|| telling.iter().all(|(_, next)| *next))
}

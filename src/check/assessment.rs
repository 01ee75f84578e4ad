//! Assessment of an answer without rounding.
//!
//! Errors are relative to the scales of the system: the error of u to |H − l| + |m g/c|, that of N to |m g| +
//! |c (H − l)|. Residuals alone would not suffice: a solver can be in equilibrium to twelve digits with forty
//! times the force.

use super::answer::{Answer, Reply, ReportedNumber};
use super::problems::{Problem, right};
use super::scales::{ball, balls, fit, format_short, is_within, rounds_alike, scales, sizes};
use crate::chapter::contact::{self, Kkt};
use crate::chapter::{SpringMass, augmented};
use crate::number::{Ball, Exact, PositivePart};
use crate::solver::{Solution, State};
use num_traits::Zero;
use strum::Display;

/// Verdict on an answer, in increasing severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Display)]
#[strum(serialize_all = "snake_case")]
pub enum AnswerVerdict {
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

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(AnswerVerdict);

/// Comparison of an answer with the exact solution.
#[derive(Clone, Debug)]
pub struct Assessment {
    /// The verdict.
    pub verdict: AnswerVerdict,
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
    /// Returns the problem with the parameters that the solver used, or the parameter that differs.
    fn as_used(&self, answer: &Answer, tolerance: &Exact) -> Result<Problem, String> {
        let asked = SpringMass::KEYS.zip(self.system.as_ref());
        let system = asked.zip(answer.used.system.as_ref());
        let system = system.try_map(|((key, asked), used)| value_used(key, asked, used, tolerance))?;
        let penalty = self.penalty.as_ref();
        let penalty = penalty.map(|asked| value_used("penalty", asked, &answer.used.penalty, tolerance));
        Ok(Problem { system, penalty: penalty.transpose()?, ..self.clone() })
    }
}

/// Returns the value of a parameter that the solver used, if it is near the requested one.
fn value_used(
    name: &str,
    asked: &Exact,
    used: &Option<ReportedNumber>,
    tolerance: &Exact,
) -> Result<Exact, String> {
    let Some(used) = used else { return Ok(asked.clone()) };
    let Some(used) = used else {
        return Err(format!("it used a value for {name} = {} that is not a number", format_short(asked)));
    };
    // The signs are kept, since c, m and ε are positive.
    let has_same_sign = used.cmp(&Exact::zero()) == asked.cmp(&Exact::zero());
    if has_same_sign && (used - asked).abs() <= tolerance * asked.abs() {
        return Ok(used.clone());
    }
    Err(format!("it used {name} = {} instead of {}", format_short(used), format_short(asked)))
}

/// Returns enclosures of the float results of the formulas for u and N. A ball larger than the system itself
/// explains nothing.
pub(super) fn rounded(problem: &Problem) -> [Option<Ball<f64>>; 2] {
    let eps = problem.penalty.as_ref().and_then(ball);
    let is_in_range = eps.is_some() == problem.penalty.is_some();
    let Some(system) = balls(&problem.system).filter(|_| is_in_range) else { return [None, None] };
    let ([u, n], [length, force]) = (right(&system, eps.as_ref()), sizes(&problem.system));
    [(u, length), (n, force)].map(|(ball, size)| Some(ball).filter(|ball| is_within(ball, &size)))
}

impl Assessment {
    pub(super) fn of(problem: &Problem, reply: &Reply, tolerance: &Exact) -> Self {
        let (verdict, finding) = match reply {
            Reply::Answered(answer) => match problem.as_used(answer, tolerance) {
                Ok(solved) => return Assessment::of_answer(solved, answer, tolerance),
                Err(finding) => (AnswerVerdict::Wrong, finding),
            },
            Reply::Refused(reason) => (AnswerVerdict::Refused, reason.clone()),
            Reply::InvalidResponse(reason) => (AnswerVerdict::Wrong, reason.clone()),
            Reply::Crashed(output) => (AnswerVerdict::Crashed, output.clone()),
            Reply::TimedOut(output) => (AnswerVerdict::TimedOut, format!("no answer in time; {output}")),
        };
        Assessment {
            verdict,
            exact: problem.solution(),
            has_right_numbers: false,
            solved: None,
            deflection_error: None,
            force_error: None,
            kkt: None,
            finding: Some(finding),
            lags: None,
        }
    }

    fn of_answer(problem: Problem, answer: &Answer, tolerance: &Exact) -> Self {
        let exact = problem.solution();
        let numbers = [&answer.deflection, &answer.contact_force];
        let expected = [&exact.deflection, &exact.contact_force];
        let (scales, balls) = (scales(&problem.system), rounded(&problem));
        let both = [0, 1].map(|i| match numbers[i] {
            None => Comparison::default(),
            Some(number) => Comparison::of(number, expected[i], balls[i].as_ref(), &scales[i], tolerance),
        });
        let has_right_numbers = both.iter().all(|number| number.is_near || number.is_right);
        let finding = if has_right_numbers {
            penetrates_otherwise(&problem, &exact, answer, tolerance)
        } else if both.iter().all(|number| number.is_near || number.is_rounded) {
            Some("within the rounding error of f64".to_string())
        } else {
            wrong_state(numbers, exact.state, both[1].is_near, &(tolerance * &scales[1]))
        };
        let verdict = match finding {
            None if both.iter().all(|number| number.is_right) => AnswerVerdict::Right,
            None if has_right_numbers => AnswerVerdict::WithinTolerance,
            _ => AnswerVerdict::Wrong,
        };
        let kkt = match numbers {
            [Some(u), Some(n)] => Some(contact::kkt(&problem.system, u, n)),
            _ => None,
        };
        let [deflection_error, force_error] = both.map(|number| number.error);
        let lags = lags(&problem.system, &answer.steps, &fit(tolerance));
        let solved = Some(problem);
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

/// Comparison of a number with the exact one.
#[derive(Default)]
struct Comparison {
    error: Option<Exact>,
    is_near: bool,
    is_rounded: bool,
    is_right: bool,
}

impl Comparison {
    fn of(number: &Exact, exact: &Exact, ball: Option<&Ball<f64>>, scale: &Exact, tolerance: &Exact) -> Self {
        let error = (number - exact).abs() / scale;
        let is_rounded = ball.is_some_and(|ball| ball.contains(number));
        // An answer with a larger error is not accepted, whatever explains it.
        let is_right = is_rounded && error <= fit(tolerance) || rounds_alike(number, exact);
        Comparison { is_near: error <= *tolerance, is_rounded, is_right, error: Some(error) }
    }
}

/// Describes a penetration that differs from that of the deflection.
fn penetrates_otherwise(
    problem: &Problem,
    exact: &Solution<Exact>,
    answer: &Answer,
    tolerance: &Exact,
) -> Option<String> {
    let Some(p) = answer.penetration.as_ref()? else {
        return Some("its penetration is not a number".to_string());
    };
    let u = answer.deflection.as_ref()?;
    let expected = contact::penetration(&problem.system, u);
    let rounded = balls(&problem.system).zip(ball(u)).map(|(system, u)| contact::penetration(&system, &u));
    let [length, _] = scales(&problem.system);
    let rounded_once = rounds_alike(u, &exact.deflection) && rounds_alike(p, &exact.penetration);
    let is_near = (p - &expected).abs() <= tolerance * length;
    let is_right = is_near || rounded_once || rounded.is_some_and(|ball| ball.contains(p));
    let [p, expected] = [p, &expected].map(format_short);
    (!is_right).then(|| format!("its penetration is {p}, but that of its deflection is {expected}"))
}

/// Describes missing numbers or a wrong state.
fn wrong_state(
    numbers: [&ReportedNumber; 2],
    exact: State,
    has_right_force: bool,
    tolerance: &Exact,
) -> Option<String> {
    let n = match numbers {
        [Some(_), Some(n)] => n,
        [None, _] => return Some("its deflection is not a number".to_string()),
        _ => return Some("its contact force is not a number".to_string()),
    };
    let answered = if *n > *tolerance {
        "the plane pushes"
    } else if *n < -tolerance {
        "the plane pulls"
    } else {
        "the mass is separated"
    };
    let expected = match exact {
        State::Contact => "the plane pushes",
        State::Grazing => "they touch without force",
        State::Separated => "the mass is separated",
    };
    let is_wrong = !has_right_force && answered != expected;
    is_wrong.then(|| format!("according to its answer {answered}; exactly, {expected}"))
}

/// Returns whether the force of each step is that of the previous step. The initial state is not a step, so
/// one step does not decide it.
fn lags(system: &SpringMass<Exact>, steps: &[[ReportedNumber; 2]], tolerance: &Exact) -> Option<bool> {
    let [_, scale] = scales(system);
    let tolerance = tolerance * scale;
    let mut is_behind = Vec::new();
    for pair in steps.windows(2) {
        let [[Some(u), Some(force)], [_, Some(next)]] = pair else { continue };
        let expected = augmented::contact_force(system, u);
        let [is_near, is_next_near] = [force, next].map(|force| (force - &expected).abs() <= tolerance);
        // If both forces are close, the steps cannot be distinguished.
        if !(is_near && is_next_near) {
            is_behind.push(is_next_near);
        }
    }
    (is_behind.len() >= 2).then(|| is_behind.into_iter().all(|next| next))
}

/// A problem with its reply and assessment.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// The number of requests before it; 0 in a table.
    pub number: usize,
    /// The problem.
    pub problem: Problem,
    /// The reply, without its steps.
    pub reply: Reply,
    /// The assessment of the reply.
    pub assessment: Assessment,
}

impl CaseResult {
    pub(super) fn of(number: usize, problem: &Problem, mut reply: Reply, tolerance: &Exact) -> Self {
        let assessment = Assessment::of(problem, &reply, tolerance);
        // The steps have been assessed, and may be numerous.
        if let Reply::Answered(answer) = &mut reply {
            answer.steps = Vec::new();
        }
        CaseResult { number, problem: problem.clone(), reply, assessment }
    }

    /// Returns `true` if the solver did not answer.
    pub(super) fn is_silent(&self) -> bool {
        matches!(self.reply, Reply::InvalidResponse(_) | Reply::Crashed(_) | Reply::TimedOut(_))
    }

    /// Returns `true` if another reply to the same problem is no answer, or one that differs by more than the
    /// tolerance.
    pub(super) fn differs(&self, other: &Reply, tolerance: &Exact) -> bool {
        let (Reply::Answered(first), Reply::Answered(again)) = (&self.reply, other) else { return true };
        let scales = scales(&self.problem.system);
        let numbers = [[&first.deflection, &again.deflection], [&first.contact_force, &again.contact_force]];
        numbers.iter().zip(&scales).any(|(both, scale)| match both {
            [Some(a), Some(b)] => (a - b).abs() > tolerance * scale,
            [a, b] => a != b,
        })
    }
}

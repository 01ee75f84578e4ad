//! How far off an answer is, without rounding.
//!
//! Errors are taken on the system's own scales: of u in parts of |H − l| + |m g/c|, of N in parts of
//! |m g| + |c (H − l)|. Residuals alone would not do: a solver can be in equilibrium to twelve digits with
//! forty times the force.

use super::mistakes::right;
use super::problems::decimal;
use super::{Answer, Problem, Reply, Value};
use crate::chapter::contact::{self, Kkt};
use crate::chapter::{SpringMass, augmented, structure, system};
use crate::number::{Ball, Exact, PositivePart, Real, ToExact};
use crate::solver::{Method, Solution, State, solve};
use num_traits::{One, Zero};
use std::fmt;

/// What to think of an answer; the worse, the greater.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Verdict {
    /// No further off than the arithmetic of f64 may take the formula itself.
    Right,
    /// Within the tolerance.
    WithinTolerance,
    /// Not answered, with a reason.
    Refused,
    /// Anything else that it says.
    Wrong,
    /// Not answered in time.
    TimedOut,
    /// The solver ended.
    Crashed,
}

/// As JSON has it.
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

/// An answer beside the exact one.
#[derive(Clone, Debug)]
pub struct Judgement {
    /// What to think of it.
    pub verdict: Verdict,
    /// The exact answer, for the parameters as they were used.
    pub exact: Solution<Exact>,
    /// The problem with these parameters, if there is an answer to it.
    pub(super) solved: Option<Problem>,
    /// The error of u, in parts of |H − l| + |m g/c|.
    pub deflection_error: Option<Exact>,
    /// The error of N, in parts of |m g| + |c (H − l)|.
    pub force_error: Option<Exact>,
    /// The residuals of (1.6) and of equilibrium, of the answer.
    pub kkt: Option<Kkt<Exact>>,
    /// What is wrong, in words.
    pub finding: Option<String>,
    /// Is the force of each step that of the step before? `None` if there are no steps that tell.
    pub lags: Option<bool>,
}

impl Problem {
    /// The exact answer: that of (1.6), or of (1.13) and (1.12) for a plane that only pushes.
    ///
    /// # Panics
    /// c, m or ε is not greater than 0.
    pub fn solution(&self) -> Solution<Exact> {
        let method = match &self.penalty {
            None => Method::Lagrange,
            Some(penalty) => Method::Penalty { penalty: penalty.clone() },
        };
        solve(&self.system, &method).expect("a system with c, m and ε > 0")
    }

    /// The problem that was really solved; or which parameter is another than was asked for, and how.
    fn as_used(&self, answer: &Answer, tolerance: &Exact) -> Result<Problem, String> {
        // The signs stay: c, m and ε are positive.
        let taken = |name: &str, asked: &Exact, used: &Option<Value>| match used {
            None => Ok(asked.clone()),
            Some(Some(used))
                if (used - asked).abs() <= tolerance * asked.abs()
                    && used.cmp(&Exact::zero()) == asked.cmp(&Exact::zero()) =>
            {
                Ok(used.clone())
            }
            Some(Some(used)) => Err(format!("it took {name} = {} for {}", brief(used), brief(asked))),
            Some(None) => Err(format!("it took no number for {name} = {}", brief(asked))),
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

/// Six digits, for the eye.
fn brief(x: &Exact) -> String {
    x.decimal(6, rug::float::Round::Nearest)
}

/// What errors of u, in m, and of N, in N, are measured by: an SI unit where all that they could be measured
/// by is zero.
pub(super) fn scales(system: &SpringMass<Exact>) -> [Exact; 2] {
    let gap = system::gap(system);
    let free = structure::deflection(system);
    let weight = system::weight(system);
    let scales = [gap.abs() + free.abs(), weight.abs() + (&system.c * gap).abs()];
    scales.map(|scale| if scale.is_zero() { Exact::one() } else { scale })
}

/// A system in balls around floats, if it fits; `like` is one of them.
pub(super) fn balls<T: Real + ToExact>(like: &T, system: &SpringMass<Exact>) -> Option<SpringMass<Ball<T>>> {
    system.try_map(|x| Ball::around(like, x)).ok()
}

/// Where floats may take the formulas of u and N, if the parameters fit; `like` is one of them.
pub(super) fn rounded<T: Real + ToExact>(like: &T, problem: &Problem) -> Option<[Ball<T>; 2]> {
    let penalty = problem.penalty.as_ref().map(|eps| Ball::around(like, eps)).transpose().ok()?;
    Some(right(&balls(like, &problem.system)?, penalty.as_ref()))
}

/// The lengths of a system together, in m, and its forces, in N.
pub(super) fn sizes(system: &SpringMass<Exact>) -> [Exact; 2] {
    let [_, weight] = scales(system);
    let lengths = system.l.abs() + system.h.abs();
    [&lengths + structure::deflection(system).abs(), weight + &system.c * lengths]
}

/// Is a number where floats may take a formula? A ball that is larger than the system itself explains
/// nothing.
pub(super) fn is_within<T: Real + ToExact>(ball: &Ball<T>, x: &Exact, size: &Exact) -> bool {
    let radius = ball.radius().to_exact();
    radius.is_ok_and(|radius| radius <= *size) && ball.contains(x)
}

/// Returns `true` if both numbers are equal or the same in f64. The exact answer rounded once passes by this:
/// a ball contains the exact answer, but where its radius is less than half an ulp, not always the float
/// nearest to that.
pub(super) fn rounds_alike(x: &Exact, y: &Exact) -> bool {
    x == y || matches!((x.to_f64(), y.to_f64()), (Ok(x), Ok(y)) if x == y)
}

/// How near an answer has to be to what it is taken for, in parts of the system's scale and of what is
/// computed: as near as the tolerance asks for, and no nearer than 10⁻⁶, so that the same mistakes can be
/// told apart whatever the tolerance.
pub(super) fn fit(tolerance: &Exact) -> Exact {
    decimal(1, -6).max(tolerance.clone())
}

impl Judgement {
    pub(super) fn of(problem: &Problem, reply: &Reply, tolerance: &Exact) -> Self {
        let without_numbers = |verdict, finding: &str| Judgement {
            verdict,
            exact: problem.solution(),
            solved: None,
            deflection_error: None,
            force_error: None,
            kkt: None,
            finding: Some(finding.to_string()),
            lags: None,
        };
        match reply {
            Reply::Answered(answer) => match problem.as_used(answer, tolerance) {
                Ok(solved) => Judgement::of_answer(solved, answer, tolerance),
                Err(finding) => without_numbers(Verdict::Wrong, &finding),
            },
            Reply::Refused(why) => without_numbers(Verdict::Refused, why),
            Reply::Garbled(why) => without_numbers(Verdict::Wrong, why),
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
        // Beyond that an answer is of no use, whatever explains it.
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
            let rounding = rounding.then(|| "no further off than rounding in f64 may take it".to_string());
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
        Judgement { verdict, exact, solved, deflection_error, force_error, kkt, finding, lags }
    }

    /// The larger of the two errors; `None`, which is less than any, without numbers.
    pub fn error(&self) -> Option<&Exact> {
        self.deflection_error.as_ref().max(self.force_error.as_ref())
    }
}

/// A penetration that is not that of the deflection.
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
    let rounded = balls(&0f64, &problem.system).zip(Ball::around(&0f64, u).ok());
    let rounded = rounded.map(|(system, u)| contact::penetration(&system, &u));
    let [length, _] = scales(&problem.system);
    let rounded_once = rounds_alike(u, &exact.deflection) && rounds_alike(p, &exact.penetration);
    let near = (p - &own).abs() <= tolerance * length;
    let explained = near || rounded_once || rounded.is_some_and(|ball| ball.contains(p));
    (!explained)
        .then(|| format!("its penetration is {}, that of its deflection is {}", brief(p), brief(&own)))
}

/// What is wrong with the answer as a whole: no numbers, or another state.
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
        "the mass hangs free"
    };
    let is = match state {
        State::Contact => "the plane pushes",
        State::Grazing => "they touch without force",
        State::Separated => "the mass hangs free",
    };
    (far && said != is).then(|| format!("it says that {said}; exactly, {is}"))
}

/// Is the force of each step that of the step before? A start is no step, so one alone does not tell.
fn lags(system: &SpringMass<Exact>, steps: &[[Value; 2]], tolerance: &Exact) -> Option<bool> {
    let [_, scale] = scales(system);
    let near =
        |force: &Exact, u: &Exact| (force - augmented::contact_force(system, u)).abs() <= tolerance * &scale;
    let pairs = steps.windows(2).filter_map(|pair| match pair {
        [[Some(u), Some(own)], [_, Some(next)]] => Some((near(own, u), near(next, u))),
        _ => None,
    });
    // Where both are near, they have come so close that they cannot be told apart.
    let telling = Vec::from_iter(pairs.filter(|(own, next)| !(*own && *next)));
    (telling.len() >= 2).then(|| telling.iter().all(|(_, next)| *next))
}

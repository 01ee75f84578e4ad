//! What is wrong with a solver: which known mistake its answers fit.

use super::judge::{is_within, rounded, scales};
use super::mistakes::{Formulas, Measured, Mistake, mistakes, none, value};
use super::{Answer, Checked, Problem, Reply, Verdict};
use crate::chapter::{SpringMass, augmented, contact, system};
use crate::claims::registry;
use crate::formula::Notation;
use crate::number::{Ball, Exact, PositivePart, Tree};
use num_traits::{One, Zero};
use std::fmt;

/// How near an answer has to be to what a mistake computes, in parts of the system's scale and of what is
/// computed: as near as the tolerance asks for, and no nearer than this, so that the same mistakes can be
/// told apart whatever the tolerance.
const FIT: &str = "1e-6";

/// How a penalty depends on the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// No penalty shows.
    None,
    /// The same ε everywhere.
    Constant,
    /// A multiple of c.
    OfStiffness,
    /// A multiple of m.
    OfMass,
}

/// As JSON has it.
impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Kind::None => "none",
            Kind::Constant => "constant",
            Kind::OfStiffness => "of_stiffness",
            Kind::OfMass => "of_mass",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Kind, Answers);

impl Kind {
    const ALL: [Kind; 3] = [Kind::Constant, Kind::OfStiffness, Kind::OfMass];

    /// What the penalty is a multiple of.
    fn unit(self, system: &SpringMass<Exact>) -> Exact {
        match self {
            Kind::None | Kind::Constant => Exact::one(),
            Kind::OfStiffness => system.c.clone(),
            Kind::OfMass => system.m.clone(),
        }
    }
}

/// The penalty that forces by their penetrations show.
#[derive(Clone, Debug, PartialEq)]
pub struct Penalty {
    /// How it depends on the system.
    pub kind: Kind,
    /// ε in N/m; or ε/c; or ε/m in 1/s². Of the answer that tells it most clearly.
    pub value: Option<Exact>,
    /// The largest by the smallest, less 1.
    pub spread: Option<Exact>,
}

impl Penalty {
    const NONE: Penalty = Penalty { kind: Kind::None, value: None, spread: None };

    pub(super) fn of(checked: &[Checked], tolerance: &Exact) -> Self {
        let answers = Vec::from_iter(checked.iter().filter_map(|of| Given::of(of, tolerance)));
        Penalty::measured(&answers, Measured::ByForce, tolerance)
    }

    /// A penalty shows if one of the three multiples, and only one, is the same to within a factor of two in
    /// all answers that tell it; and if these are at least half of those whose force it would be.
    fn measured(answers: &[Given], by: Measured, tolerance: &Exact) -> Self {
        let acting = answers.iter().filter_map(|given| given.force(by, tolerance)).count();
        let told = Vec::from_iter(answers.iter().filter_map(|given| given.ratio(by, tolerance)));
        let clearest = told.iter().max_by(|a, b| a.clarity.cmp(&b.clarity));
        let (Some(clearest), true) = (clearest, told.len() >= 2 && 2 * told.len() >= acting) else {
            return Penalty::NONE;
        };
        let shown = Kind::ALL.into_iter().filter_map(|kind| {
            let multiples = || told.iter().map(|ratio| &ratio.value / kind.unit(ratio.system));
            let spread = multiples().max()? / multiples().min()? - Exact::one();
            let value = &clearest.value / kind.unit(clearest.system);
            (spread <= Exact::one()).then_some(Penalty { kind, value: Some(value), spread: Some(spread) })
        });
        match shown.collect::<Vec<_>>().as_slice() {
            [only] => only.clone(),
            _ => Penalty::NONE,
        }
    }

    fn at(&self, system: &SpringMass<Exact>) -> Option<Exact> {
        self.value.as_ref().map(|value| value * self.kind.unit(system))
    }
}

/// Which answers a mistake explains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answers {
    /// All of them.
    All,
    /// All that are wrong, and not all that are right.
    Wrong,
    /// All whose steps are told.
    Steps,
}

/// As JSON has it.
impl fmt::Display for Answers {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Answers::All => "all",
            Answers::Wrong => "wrong",
            Answers::Steps => "steps",
        })
    }
}

/// A mistake that explains the answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnosis {
    /// What is wrong.
    pub name: String,
    /// u and N as such a program computes them.
    pub formula: String,
    /// Where in the chapter's source that is one edit, and which one.
    pub at: Vec<String>,
    /// Which answers it explains.
    pub answers: Answers,
    /// How many answers fit.
    pub fits: usize,
    /// Of how many.
    pub of: usize,
}

/// An answer, and the problem that it is one of.
struct Given<'a> {
    problem: Problem,
    answer: &'a Answer,
    wrong: bool,
}

/// N/p, in N/m.
struct Ratio<'a> {
    system: &'a SpringMass<Exact>,
    value: Exact,
    /// How many times what it may be rounded by in f64 the penetration is.
    clarity: Exact,
}

impl<'a> Given<'a> {
    fn of(checked: &'a Checked, tolerance: &Exact) -> Option<Self> {
        let Reply::Answered(answer) = &checked.reply else { return None };
        let problem = checked.problem.as_used(answer, tolerance).ok()?;
        Some(Given { problem, answer, wrong: checked.judgement.verdict == Verdict::Wrong })
    }

    /// Force by penetration, if it is positive, and the penetration is a thousand times what the lengths and
    /// the deflection may be rounded by in f64.
    fn ratio(&self, by: Measured, tolerance: &Exact) -> Option<Ratio<'_>> {
        let (force, u) = (self.force(by, tolerance)?, self.answer.deflection.as_ref()?);
        let system = &self.problem.system;
        let p = contact::penetration(system, u);
        let rounding = (system.l.abs() + system.h.abs() + u.abs()) * Exact::power_of_two(-53);
        if p.is_zero() || p.abs() < Exact::from(1000) * &rounding {
            return None;
        }
        let (value, clarity) = (force / &p, Exact::one() / (rounding / p.abs()));
        (value > Exact::zero()).then_some(Ratio { system, value, clarity })
    }

    /// The force that a penalty would be told by, if there is any.
    fn force(&self, by: Measured, tolerance: &Exact) -> Option<Exact> {
        let system = &self.problem.system;
        let force = match by {
            Measured::ByForce => self.answer.contact_force.clone()?,
            Measured::ByEquilibrium if system::reaction(system) < Exact::zero() => {
                augmented::contact_force(system, self.answer.deflection.as_ref()?)
            }
            Measured::ByEquilibrium => return None,
        };
        let [_, scale] = scales(system);
        (force.abs() > tolerance * scale).then_some(force)
    }

    /// Does a program with this mistake, and this penalty, answer so?
    fn fits(&self, mistake: &Mistake, penalty: Option<&Exact>, tolerance: &Exact) -> bool {
        let system = &self.problem.system;
        let scales = scales(system);
        let numbers = [&self.answer.deflection, &self.answer.contact_force];
        // What f64 makes of the formulas is theirs, too.
        let ball = |x: &Exact| Ball::around(&0f64, x).ok();
        let rounded =
            system.try_map(|x| ball(x).ok_or(())).ok().map(|system| (system, penalty.and_then(ball)));
        let within = |x: &Exact, formula: &Tree| {
            let rounded = rounded.as_ref().and_then(|(system, eps)| value(formula, system, eps.as_ref()));
            rounded.is_some_and(|ball| is_within(&ball, x))
        };
        let fits = |formulas: &Formulas| {
            (0..2).all(|i| match (numbers[i], value(&formulas[i], system, penalty)) {
                (Some(own), Some(x)) => {
                    (own - &x).abs() <= tolerance * (&scales[i] + x.abs()) || within(own, &formulas[i])
                }
                (None, None) => true,
                _ => false,
            })
        };
        let reaction = system::reaction(system);
        // So near to grazing rounding may take one for the other.
        let open = reaction.abs() <= tolerance * &scales[1];
        (open || reaction > Exact::zero()) && fits(&mistake.touching)
            || (open || reaction <= Exact::zero()) && fits(&mistake.apart)
    }

    /// Is it as far off as single precision may take what is right?
    fn is_single(&self) -> bool {
        let numbers = [&self.answer.deflection, &self.answer.contact_force];
        rounded(&0f32, &self.problem).is_some_and(|balls| {
            balls.iter().zip(numbers).all(|(ball, x)| x.as_ref().is_some_and(|x| is_within(ball, x)))
        })
    }

    /// Is the force of each step that of the step before? `None` if the steps do not tell.
    fn lags(&self, tolerance: &Exact) -> Option<bool> {
        let system = &self.problem.system;
        let [_, scale] = scales(system);
        let near = |force: &Exact, u: &Exact| {
            (force - augmented::contact_force(system, u)).abs() <= tolerance * &scale
        };
        let steps = self.answer.steps.windows(2).filter_map(|pair| match pair {
            [[Some(u), Some(own)], [_, Some(next)]] => Some((near(own, u), near(next, u))),
            _ => None,
        });
        // Where both are near, they have come so close that they cannot be told apart.
        let telling: Vec<_> = steps.filter(|(own, next)| own != next || !own).collect();
        (!telling.is_empty()).then(|| telling.iter().all(|(own, next)| !own && *next))
    }
}

/// Every mistake that explains the answers, if some of them are wrong.
pub(super) fn diagnose(checked: &[Checked], shown: &Penalty, tolerance: &Exact) -> Vec<Diagnosis> {
    let answers = Vec::from_iter(checked.iter().filter_map(|of| Given::of(of, tolerance)));
    let tolerance = &fit(tolerance);
    let mut found = Vec::from_iter(lag(&answers, tolerance));
    let wrong = Vec::from_iter(answers.iter().filter(|given| given.wrong));
    if wrong.is_empty() {
        return found;
    }
    let pulled = Penalty::measured(&answers, Measured::ByEquilibrium, tolerance);
    let penalty_of = |mistake: &Mistake, given: &Given| {
        let told = given.answer.used.penalty.clone().flatten().or_else(|| given.problem.penalty.clone());
        told.or_else(|| match mistake.measured? {
            Measured::ByForce => shown.at(&given.problem.system),
            Measured::ByEquilibrium => pulled.at(&given.problem.system),
        })
    };
    let by_penalty = checked.iter().any(|of| of.problem.penalty.is_some());
    let all = mistakes(by_penalty);
    let explaining = |which: Answers, answers: &[&Given]| {
        let fits = |mistake: &Mistake, given: &Given| {
            given.fits(mistake, penalty_of(mistake, given).as_ref(), tolerance)
        };
        let diagnosis = |name: &str, formula: String, at: &[String]| Diagnosis {
            name: name.to_string(),
            formula,
            at: at.to_vec(),
            answers: which,
            fits: answers.len(),
            of: answers.len(),
        };
        let single = answers.iter().all(|given| given.is_single());
        let single =
            single.then(|| diagnosis("it computes in single precision", none(by_penalty).formula(), &[]));
        let whole = all.iter().filter(|mistake| answers.iter().all(|given| fits(mistake, given)));
        let known = whole.map(|mistake| diagnosis(&mistake.name, mistake.formula(), &mistake.at));
        single.into_iter().chain(known).collect::<Vec<_>>()
    };
    let of_all = explaining(Answers::All, &answers.iter().collect::<Vec<_>>());
    found.extend(if of_all.is_empty() { explaining(Answers::Wrong, &wrong) } else { of_all });
    found
}

/// How near an answer has to be.
fn fit(tolerance: &Exact) -> Exact {
    let least: Exact = FIT.parse().expect("a number");
    if *tolerance > least { tolerance.clone() } else { least }
}

/// The force reported is that of the step before.
fn lag(answers: &[Given], tolerance: &Exact) -> Option<Diagnosis> {
    let told = Vec::from_iter(answers.iter().filter_map(|given| given.lags(tolerance)));
    let fits = told.iter().filter(|lags| **lags).count();
    (fits > 0 && fits == told.len()).then(|| Diagnosis {
        name: "N is one step behind".to_string(),
        formula: registry().fill("N_k = «augmented::contact_force: u=u_{k−1}»", Notation::Text),
        at: Vec::new(),
        answers: Answers::Steps,
        fits,
        of: told.len(),
    })
}

//! Proofs and checks of the claims in number systems, with reports.
//!
//! ```
//! use spring_mass_contact::verify::{Options, Status, verify};
//!
//! let options = Options { cases: 20, equations: vec!["1.13".into()], ..Options::default() };
//! let report = verify(&options, &|_, _| ());
//! let proofs = report.rows.iter().filter(|row| row.scalar.is_none());
//! assert!(report.holds() && proofs.count() > 0);
//! assert!(report.rows.iter().all(|row| matches!(row.status, Status::Proved | Status::Held)));
//! ```

mod cases;
mod checker;
mod coq;
mod experiments;
pub mod proofs;
mod shared;
#[cfg(test)]
mod tests;

use crate::claims::{Case, Var, claims, index_of, registry, statements};
use crate::eval::{Balls, Point, Rationals};
use crate::formula::Statement;
#[cfg(feature = "half")]
use crate::number::Native;
use crate::number::{Exact, Mpfr, NumberSystem};
use checker::{CheckedFloat, Group, add_checks};
pub use coq::coq;
pub use experiments::{Experiment, Trial, experiments};
use num_traits::One;
use proofs::{ProofAttempt, ProofOutcome};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Options of a verification.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Number systems.
    pub scalars: Vec<NumberSystem>,
    /// Number of cases for each claim, at least 1.
    pub cases: u64,
    /// Seed of the cases.
    pub seed: u64,
    /// Entries to verify; all if empty.
    pub equations: Vec<String>,
}

impl Options {
    /// Returns `true` if the entry with this equation number is to be verified.
    fn includes(&self, equation: &str) -> bool {
        self.equations.is_empty() || self.equations.iter().any(|included| included == equation)
    }
}

/// f32, f64, 256 bits and rationals; 1000 cases from seed 1; all entries.
impl Default for Options {
    fn default() -> Self {
        let scalars =
            vec![NumberSystem::F32, NumberSystem::F64, NumberSystem::Mpfr(256), NumberSystem::Exact];
        Options { scalars, cases: 1000, seed: 1, equations: Vec::new() }
    }
}

/// Results of a verification.
#[derive(Clone, Debug, PartialEq)]
pub struct VerificationReport {
    /// One row for each claim and number system, in the chapter's order; the proof of a claim comes first.
    pub rows: Vec<ClaimResult>,
    /// Functions of the chapter that every unproved claim uses.
    pub shared: Vec<&'static str>,
}

impl VerificationReport {
    /// Returns `true` if no claim failed, and there is at least one row.
    pub fn holds(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(|row| row.status != Status::Failed)
    }

    /// Returns the rows of each equation.
    pub fn by_equation(&self) -> impl Iterator<Item = &[ClaimResult]> {
        self.rows.chunk_by(|a, b| a.equation == b.equation)
    }

    /// Returns the summary.
    pub fn summary(&self) -> VerificationSummary {
        let [proved, held, undecided, failed] =
            [Status::Proved, Status::Held, Status::Undecided, Status::Failed]
                .map(|status| self.rows.iter().filter(|row| row.status == status).count());
        VerificationSummary { claims: self.rows.len(), proved, held, undecided, failed }
    }
}

/// Numbers of rows by status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VerificationSummary {
    /// All rows.
    pub claims: usize,
    /// Proved claims.
    pub proved: usize,
    /// Claims that hold in a number system.
    pub held: usize,
    /// Claims without a decided case.
    pub undecided: usize,
    /// Claims that are not proved, or wrong in a case.
    pub failed: usize,
}

/// Serialises the summary, the functions that unproved claims share, and the rows of each equation.
#[cfg(feature = "serde")]
impl serde::Serialize for VerificationReport {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        #[derive(serde::Serialize)]
        struct EquationResults<'a> {
            equation: &'static str,
            claims: &'a [ClaimResult],
        }
        let equations =
            self.by_equation().map(|claims| EquationResults { equation: claims[0].equation, claims });
        let mut report = to.serialize_struct("VerificationReport", 3)?;
        report.serialize_field("summary", &self.summary())?;
        report.serialize_field("shared", &self.shared)?;
        report.serialize_field("equations", &equations.collect::<Vec<_>>())?;
        report.end()
    }
}

/// Status of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Proved for all values of its quantities.
    Proved,
    /// True in every decided case, of which there is at least one.
    Held,
    /// No case could be decided. More cases or a higher precision may help.
    Undecided,
    /// Wrong in a case, or not proved.
    Failed,
}

/// Writes the name used in JSON.
impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.pad(match self {
            Status::Proved => "proved",
            Status::Held => "held",
            Status::Undecided => "undecided",
            Status::Failed => "failed",
        })
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Status);

/// Result for one claim: its proof, or its cases in one number system.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ClaimResult {
    /// The entry.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub equation: &'static str,
    /// Name of the claim.
    pub claim: &'static str,
    /// Its kind.
    pub kind: &'static str,
    /// Status.
    pub status: Status,
    /// Number system; `None` for a proof.
    pub scalar: Option<NumberSystem>,
    /// Reason why the proof failed, or why evaluating the counterexample failed, for example by division by
    /// zero.
    pub reason: Option<String>,
    /// Number of decided cases.
    pub decided: u64,
    /// Number of undecided cases: a sign is lost in rounding, or a number is out of range.
    pub undecided: u64,
    /// Largest ratio |left − right|/bound, with its bound; `None` if nothing is measured.
    #[cfg_attr(feature = "serde", serde(flatten, serialize_with = "serialize::worst"))]
    pub worst: Option<(f64, String)>,
    /// Case in which the claim does not hold.
    #[cfg_attr(feature = "serde", serde(serialize_with = "serialize::coordinates"))]
    pub counterexample: Option<Case<Exact>>,
}

impl ClaimResult {
    /// Returns the counterexample with the quantities of the claim only; with all of them for an experiment.
    /// 2ᵖ of a law of rounding is that of the number system.
    pub fn point(&self) -> Option<Point> {
        let case = self.counterexample.as_ref()?;
        let claim = claims().find(|claim| (claim.equation(), claim.name()) == (self.equation, self.claim));
        let precision = claim.filter(|claim| claim.contains_rounding()).and(self.scalar);
        let symbols = claim.map(|claim| registry().symbols_of(claim.trees()));
        let mut vars = Var::ALL.to_vec();
        vars.retain(|var| symbols.as_ref().is_none_or(|symbols| symbols.contains(&var.symbol())));
        Some(Point::new(vars.into_iter().map(|var| match precision {
            Some(scalar) if var == Var::Bits => (var.symbol(), Exact::one() / scalar.unit_roundoff()),
            _ => (var.symbol(), case.get(var).clone()),
        })))
    }
}

/// Serialisation of fields without a direct representation.
#[cfg(feature = "serde")]
mod serialize {
    use crate::claims::{Case, Var};
    use crate::number::{Exact, ExactText};
    use serde::ser::{Serialize, SerializeStruct, Serializer};
    use std::collections::BTreeMap;

    pub(super) fn worst<S: Serializer>(worst: &Option<(f64, String)>, to: S) -> Result<S::Ok, S::Error> {
        let mut fields = to.serialize_struct("Worst", 2)?;
        fields.serialize_field("worst", &worst.as_ref().map(|(ratio, _)| ratio.text()))?;
        fields.serialize_field("bound", &worst.as_ref().map(|(_, bound)| bound))?;
        fields.end()
    }

    pub(super) fn coordinates<S: Serializer>(case: &Option<Case<Exact>>, to: S) -> Result<S::Ok, S::Error> {
        let by_symbol: Option<BTreeMap<&str, String>> = case
            .as_ref()
            .map(|case| Var::ALL.iter().map(|var| (var.symbol(), case.get(*var).text())).collect());
        by_symbol.serialize(to)
    }
}

/// Number of cases sampled and checked at a time.
const BLOCK: u64 = 50;

/// Proves and checks every claim, in parallel. `progress` receives the numbers of finished and of all pieces
/// of work.
///
/// # Panics
/// Panics if a number system is a float of which this build has no type: f16 and bf16 require the feature
/// `half`.
///
/// Always terminates, even for wrong formulas: a claim that is undefined, or whose evaluation panics, fails.
pub fn verify(options: &Options, progress: &(dyn Fn(usize, usize) + Sync)) -> VerificationReport {
    run(&groups(options), statements(), options, progress)
}

/// Checks the groups, and proves the statements.
fn run(
    groups: &[Group],
    mut statements: Vec<Statement>,
    options: &Options,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> VerificationReport {
    statements.retain(|statement| options.includes(statement.equation()));
    // Cases are checked while long proofs run.
    let (mut rows, checked): (Vec<ClaimResult>, Vec<ClaimResult>) =
        rayon::join(|| statements.par_iter().map(proof).collect(), || check(groups, options, progress));
    let unproved = rows.iter().zip(&statements).filter(|(row, _)| row.status == Status::Failed);
    let shared = shared::shared(unproved.map(|(_, statement)| statement));
    rows.extend(checked);
    let mut places = BTreeMap::new();
    for (place, row) in rows.iter().enumerate() {
        places.entry((row.equation, row.claim)).or_insert(place);
    }
    // All rows of a claim are adjacent.
    rows.sort_by_key(|row| (index_of(row.equation), places[&(row.equation, row.claim)]));
    VerificationReport { rows, shared }
}

/// Returns the results of all claims and experiments.
fn check(groups: &[Group], options: &Options, progress: &(dyn Fn(usize, usize) + Sync)) -> Vec<ClaimResult> {
    let blocks = options.cases.div_ceil(BLOCK);
    let (done, all) = (AtomicUsize::new(0), (blocks as usize).saturating_mul(groups.len()));
    let of_group = |group: &Group| {
        let none = || group.results.clone();
        let of_block = |block: u64| {
            // Their status follows when they are added.
            let (mut results, first) = (none(), block * BLOCK);
            for index in first..first.saturating_add(BLOCK).min(options.cases) {
                match cases::case(options.seed, index, &group.hypotheses) {
                    Some(case) => {
                        group.checks.iter().for_each(|(own, check)| check(&case, &mut results[own.clone()]));
                    }
                    None => results.iter_mut().for_each(ClaimResult::skip),
                }
            }
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
            results
        };
        let add = |mut all: Vec<ClaimResult>, later: Vec<ClaimResult>| {
            all.iter_mut().zip(later).for_each(|(all, later)| all.add(later));
            all
        };
        // Only adjacent blocks are added, so the first counterexample is that of the first case.
        (0..blocks).into_par_iter().map(of_block).reduce(none, add)
    };
    groups.par_iter().map(of_group).collect::<Vec<_>>().concat()
}

/// Returns the row of a proof.
fn proof(statement: &Statement) -> ClaimResult {
    let (reason, counterexample) = match ProofAttempt::of(statement.clone()).outcome {
        ProofOutcome::Proof(_) => (None, None),
        ProofOutcome::None(reason, counterexample) => (Some(reason), counterexample),
    };
    ClaimResult {
        status: if reason.is_none() { Status::Proved } else { Status::Failed },
        reason,
        counterexample: counterexample.as_ref().map(|found| cases::case_at(&found.point)),
        ..ClaimResult::new(statement.equation(), statement.name(), statement.kind(), None)
    }
}

/// Adds the claims and experiments in balls of a float.
fn add_balls<T: CheckedFloat>(groups: &mut Vec<Group>, options: &Options, scalar: NumberSystem, like: T) {
    add_checks(groups, options, (scalar, Balls(like)), claims(), experiments());
}

/// Returns the claims and experiments of the equations and the number systems, by their hypotheses.
fn groups(options: &Options) -> Vec<Group> {
    let mut groups = Vec::new();
    for scalar in options.scalars.iter().copied() {
        let all = &mut groups;
        match scalar {
            NumberSystem::F32 => add_balls(all, options, scalar, 0f32),
            NumberSystem::F64 => add_balls(all, options, scalar, 0f64),
            #[cfg(feature = "half")]
            NumberSystem::F16 => add_balls(all, options, scalar, Native(half::f16::ZERO)),
            #[cfg(feature = "half")]
            NumberSystem::BF16 => add_balls(all, options, scalar, Native(half::bf16::ZERO)),
            NumberSystem::Float(format) => {
                panic!("no type has the name {}, or its feature is off", format.name)
            }
            NumberSystem::Mpfr(bits) => add_balls(all, options, scalar, Mpfr::rounded(bits, 0)),
            NumberSystem::Exact => {
                add_checks(all, options, (scalar, Rationals::unrounded()), claims(), Vec::new());
            }
        }
    }
    groups
}

/// Returns the names of an entry's claims in all number systems.
pub fn claim_names(equation: &str) -> Vec<&'static str> {
    let recorded = claims().filter(|c| !c.contains_rounding()).map(|c| (c.equation(), c.name()));
    let computed = experiments::<f64>().into_iter().map(|e| (e.equation, e.name));
    recorded.chain(computed).filter(|(e, _)| *e == equation).map(|(_, name)| name).collect()
}

//! Proves the claims, runs them in the number systems, and reports.
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
mod goals;
mod guard;
pub mod proofs;
mod reproduction;
mod suspects;
#[cfg(test)]
mod tests;

use crate::claims::{Case, Var, claims, place, registry, statements};
use crate::formula::{Hypothesis, Statement};
use crate::number::{Exact, Mpfr, NumberSystem};
use crate::proof::Counterexample;
use crate::proof::controls::{Change, repairs};
use crate::proof::refute::Point;
use checker::{Checker, Checks, Exactly, Floats, Tally};
pub use coq::coq;
pub use experiments::{Experiment, Trial, exact_experiments, float_experiments};
use guard::guarded;
use proofs::{Answer, Proved};
use rayon::prelude::*;
pub use reproduction::reproduction;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};
pub use suspects::Suspect;

/// What to verify.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// In which number systems.
    pub scalars: Vec<NumberSystem>,
    /// How many cases a claim is tried on; at least 1.
    pub cases: u64,
    /// Where the cases are drawn from.
    pub seed: u64,
    /// Only these entries; all if empty.
    pub equations: Vec<String>,
}

/// f32, f64, 256 bits and rationals; 1000 cases from seed 1; everything.
impl Default for Options {
    fn default() -> Self {
        let scalars =
            vec![NumberSystem::F32, NumberSystem::F64, NumberSystem::Mpfr(256), NumberSystem::Exact];
        Options { scalars, cases: 1000, seed: 1, equations: Vec::new() }
    }
}

/// What was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// A row a claim and what it was tried by, in the chapter's order: its proof first, then number systems.
    pub rows: Vec<Row>,
    /// Where to look first if some claim is not proved: the functions that these claims have in common.
    pub suspects: Vec<Suspect>,
    /// Each of these changes of the chapter would make every claim provable that is not.
    pub repairs: Vec<Change>,
    /// The functions of the chapter that all claims that are not proved depend on.
    pub shared: Vec<&'static str>,
}

impl Report {
    /// Does every claim hold, as far as it is decided? Not if there is none: then nothing was tried.
    pub fn holds(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(|row| row.status != Status::Failed)
    }

    /// Is every claim decided in every number system that it was tried in? Not if there is none.
    pub fn is_decided(&self) -> bool {
        !self.rows.is_empty() && self.rows.iter().all(|row| row.status != Status::Undecided)
    }

    /// The rows of each equation.
    pub fn by_equation(&self) -> impl Iterator<Item = &[Row]> {
        self.rows.chunk_by(|a, b| a.equation == b.equation)
    }

    /// The summary.
    pub fn summary(&self) -> Summary {
        let count = |status| self.rows.iter().filter(|row| row.status == status).count();
        Summary {
            claims: self.rows.len(),
            proved: count(Status::Proved),
            held: count(Status::Held),
            undecided: count(Status::Undecided),
            failed: count(Status::Failed),
        }
    }
}

/// How many rows came out how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Summary {
    /// All of them.
    pub claims: usize,
    /// Proved.
    pub proved: usize,
    /// Held in a number system.
    pub held: usize,
    /// Decided by no case.
    pub undecided: usize,
    /// Not proved, or wrong in some case.
    pub failed: usize,
}

/// As JSON has it: the summary, where to look, and the rows of each equation.
#[cfg(feature = "serde")]
impl serde::Serialize for Report {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        #[derive(serde::Serialize)]
        struct Equation<'a> {
            equation: &'static str,
            claims: &'a [Row],
        }
        let equations = self.by_equation().map(|claims| Equation { equation: claims[0].equation, claims });
        let mut report = to.serialize_struct("Report", 5)?;
        report.serialize_field("summary", &self.summary())?;
        report.serialize_field("suspects", &self.suspects)?;
        report.serialize_field("repairs", &self.repairs)?;
        report.serialize_field("shared", &self.shared)?;
        report.serialize_field("equations", &equations.collect::<Vec<_>>())?;
        report.end()
    }
}

/// Whether a claim holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// For all values of its quantities.
    Proved,
    /// In every case that could be decided, and there was one.
    Held,
    /// Nothing is known: no case could be decided. More cases may help, or more digits.
    Undecided,
    /// Not in some case; or there is no proof.
    Failed,
}

/// As JSON and Markdown have it.
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

/// One claim, proved or in one number system.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Row {
    /// The entry.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub equation: &'static str,
    /// The claim's name.
    pub claim: &'static str,
    /// Its kind.
    pub kind: &'static str,
    /// What came of it.
    pub status: Status,
    /// The number system; none for the proof.
    pub scalar: Option<NumberSystem>,
    /// Why there is no proof; or why the claim broke off in its counterexample, as where that divides by
    /// zero.
    pub why: Option<String>,
    /// Cases that were decided.
    pub decided: u64,
    /// Cases that could not be: a sign lost in rounding, or numbers out of the scalar's range.
    pub undecided: u64,
    /// The largest |left − right|/bound, and that case's bound; none where nothing is measured.
    #[cfg_attr(feature = "serde", serde(flatten, serialize_with = "serialize::worst"))]
    pub worst: Option<(f64, String)>,
    /// A case in which the claim does not hold.
    #[cfg_attr(feature = "serde", serde(serialize_with = "serialize::coordinates"))]
    pub counterexample: Option<Case<Exact>>,
}

impl Row {
    /// Its counterexample, as far as the claim speaks of it; all of it of what only computed numbers have.
    pub fn point(&self) -> Option<Point> {
        let case = self.counterexample.as_ref()?;
        let claim = claims().find(|claim| (claim.equation(), claim.name()) == (self.equation, self.claim));
        let symbols = claim.map(|claim| registry().symbols_of(claim.trees()));
        let all = Var::ALL.iter().map(|var| (var.symbol(), case.get(*var).clone()));
        Some(Point::new(all.filter(|(symbol, _)| symbols.as_ref().is_none_or(|own| own.contains(symbol)))))
    }
}

/// What of a row is no plain value.
#[cfg(feature = "serde")]
mod serialize {
    use crate::claims::{Case, Var};
    use crate::number::{Exact, Text};
    use serde::ser::{Serialize, SerializeStruct, Serializer};
    use std::collections::BTreeMap;

    pub(super) fn worst<S: Serializer>(worst: &Option<(f64, String)>, to: S) -> Result<S::Ok, S::Error> {
        let mut fields = to.serialize_struct("Worst", 2)?;
        fields.serialize_field("worst", &worst.as_ref().map(|(ratio, _)| ratio.text()))?;
        fields.serialize_field("bound", &worst.as_ref().map(|(_, bound)| bound))?;
        fields.end()
    }

    pub(super) fn coordinates<S: Serializer>(case: &Option<Case<Exact>>, to: S) -> Result<S::Ok, S::Error> {
        let by_symbol = |case: &Case<Exact>| -> BTreeMap<&str, String> {
            Var::ALL.iter().map(|var| (var.symbol(), case.get(*var).text())).collect()
        };
        case.as_ref().map(by_symbol).serialize(to)
    }
}

/// As many cases are drawn and checked at a time.
const BLOCK: u64 = 50;

/// And as many blocks are under way at a time.
const WINDOW: usize = 100;

/// Tries every claim, in parallel; `progress` is told how many of how many pieces of work are done.
///
/// It ends and returns whatever the formulas are: a claim that is not defined somewhere, or breaks off,
/// does not hold there.
pub fn verify(options: &Options, progress: &(dyn Fn(usize, usize) + Sync)) -> Report {
    let checkers: Vec<_> = options.scalars.iter().map(|scalar| (*scalar, checks(*scalar))).collect();
    run(&checkers, statements(), options, progress)
}

/// The claims in some number systems, and the statements to be proved.
fn run(
    checkers: &[(NumberSystem, Box<dyn Checks>)],
    statements: Vec<Statement>,
    options: &Options,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Report {
    let wanted =
        |equation: &str| options.equations.is_empty() || options.equations.iter().any(|e| e == equation);
    let statements: Vec<_> =
        statements.into_iter().filter(|statement| wanted(statement.equation())).collect();
    // Some proofs take long: meanwhile cases are tried.
    let proofs = || statements.par_iter().map(proof).collect();
    let (mut rows, tallies): (Vec<Row>, _) =
        rayon::join(proofs, || tallies(checkers, options, &wanted, progress));
    let unproved: Vec<_> =
        rows.iter().filter(|row| row.status == Status::Failed).map(|row| (row.equation, row.claim)).collect();
    let is_unproved = |s: &Statement| unproved.contains(&(s.equation(), s.name()));
    let suspects = suspects::suspects(&statements, &is_unproved);
    let shared = suspects::shared(&statements, &is_unproved);
    // To look for repairs all is proved once more.
    let repairs =
        if unproved.is_empty() { Ok(Vec::new()) } else { guarded(|| repairs(&statements, registry())) };
    let repairs = repairs.unwrap_or_default();
    for ((scalar, checker), tallies) in checkers.iter().zip(tallies) {
        for (head, tally) in checker.heads().into_iter().zip(tallies) {
            if wanted(head.equation) {
                rows.push(tally.into_row(head, Some(*scalar)));
            }
        }
    }
    rows.sort_by_key(|row| place(row.equation));
    // Within an equation all rows of a claim stand together.
    let mut sorted: Vec<Row> = Vec::with_capacity(rows.len());
    for row in rows {
        let same = |r: &Row| r.equation == row.equation && r.claim == row.claim;
        let at = sorted.iter().rposition(same).map_or(sorted.len(), |i| i + 1);
        sorted.insert(at, row);
    }
    Report { rows: sorted, suspects, repairs, shared }
}

/// What comes of the wanted claims in numbers: for each number system, a tally for each of its heads.
fn tallies(
    checkers: &[(NumberSystem, Box<dyn Checks>)],
    options: &Options,
    wanted: &(dyn Fn(&str) -> bool + Sync),
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Vec<Vec<Tally>> {
    let mut groups: Vec<Vec<Hypothesis>> = Vec::new();
    for (_, checker) in checkers {
        for head in checker.heads().into_iter().filter(|head| wanted(head.equation)) {
            if !groups.contains(&head.given) {
                groups.push(head.given);
            }
        }
    }
    let blocks = options.cases.div_ceil(BLOCK);
    let (done, all) = (AtomicUsize::new(0), blocks as usize * groups.len());
    let mut totals: Vec<Vec<Tally>> =
        checkers.iter().map(|(_, c)| c.heads().iter().map(|_| Tally::default()).collect()).collect();
    // Some blocks at a time, so that any number of cases takes the same memory.
    for window in (0..blocks).step_by(WINDOW) {
        let window = window..blocks.min(window + WINDOW as u64);
        let jobs: Vec<(u64, &Vec<Hypothesis>)> =
            window.flat_map(|b| groups.iter().map(move |g| (b, g))).collect();
        // For each job and each checker, the tallies of the claims with the job's hypotheses.
        let results: Vec<Vec<Vec<(usize, Tally)>>> = jobs
            .par_iter()
            .map(|(block, given)| {
                let indices = block * BLOCK..(block * BLOCK).saturating_add(BLOCK).min(options.cases);
                let cases: Vec<_> = indices.map(|i| drawn(options.seed, i, given)).collect();
                let tallies =
                    checkers.iter().map(|(_, checker)| checker.check(given, wanted, &cases)).collect();
                progress(done.fetch_add(1, Ordering::Relaxed) + 1, all);
                tallies
            })
            .collect();
        for job in results {
            for (total, tallies) in totals.iter_mut().zip(job) {
                for (index, tally) in tallies {
                    total[index].add(tally);
                }
            }
        }
    }
    totals
}

/// A case, if there is one: hypotheses are made of formulas, too.
fn drawn(seed: u64, index: u64, given: &[Hypothesis]) -> Option<Case<Exact>> {
    guarded(|| cases::case(seed, index, given)).ok().flatten()
}

/// The row of a proof.
fn proof(statement: &Statement) -> Row {
    let (why, counterexample) = match Proved::of(statement.clone()).answer {
        Answer::Proof(_) => (None, None),
        Answer::None(why, counterexample) => (Some(why), counterexample),
    };
    Row {
        equation: statement.equation(),
        claim: statement.name(),
        kind: statement.kind(),
        scalar: None,
        status: if why.is_none() { Status::Proved } else { Status::Failed },
        why,
        decided: 0,
        undecided: 0,
        worst: None,
        counterexample: counterexample.as_ref().map(case_of),
    }
}

/// The case of a counterexample, with 1 for what it says nothing of.
fn case_of(counterexample: &Counterexample) -> Case<Exact> {
    Case::of(|var| counterexample.point.at(var.symbol()))
}

fn checks(scalar: NumberSystem) -> Box<dyn Checks> {
    match scalar {
        NumberSystem::F32 => Box::new(Checker::new(Floats(0.0f32), claims())),
        NumberSystem::F64 => Box::new(Checker::new(Floats(0.0f64), claims())),
        NumberSystem::Mpfr(bits) => Box::new(Checker::new(Floats(Mpfr::rounded(bits, 0)), claims())),
        NumberSystem::Exact => Box::new(Checker::new(Exactly, claims())),
    }
}

/// Returns the names of an entry's claims, in whatever number system they are checked.
pub fn claim_names(equation: &str) -> Vec<&'static str> {
    let recorded = claims().filter(|c| !c.contains_rounding()).map(|c| (c.equation(), c.name()));
    let floats = float_experiments::<f64>().into_iter().map(|e| (e.equation, e.name));
    let rationals = exact_experiments().into_iter().map(|e| (e.equation, e.name));
    let all = recorded.chain(floats).chain(rationals);
    all.filter(|(e, _)| *e == equation).map(|(_, name)| name).collect()
}

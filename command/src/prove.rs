//! `contact prove`: proofs of every claim, and tests that they could fail.

use crate::args;
use crate::lines::join_operands;
use crate::output::{self, Exit, Failure, formats};
use spring_mass_contact::claims::{Entry, entry, registry, statements};
use spring_mass_contact::proof::coq::Omitted;
use spring_mass_contact::proof::mutation::{DropOutcome, DroppedHypothesis, MutationOutcome};
use spring_mass_contact::proof::render::{self, ProofPrinter};
use spring_mass_contact::proof::tightest_point;
use spring_mass_contact::verify::coq;
use spring_mass_contact::verify::proofs::{ProofAttempt, ProofOutcome, Proofs, Summary, prove_equations};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{fs, process};

const EXAMPLES: &str = "\
Examples:
  contact prove
  contact prove 1.17 'Theorem 1.3.3'
  contact prove --format json
  contact prove --coq target/coq

A proof holds for all values that satisfy the hypotheses, and starts from the
functions that compute. Two kinds of tests show that it could have failed: a
claim without one of its hypotheses must be wrong, and every small mutation of a
formula in src/chapter must be detected by a claim or proved equivalent.

Exit status: 0 all claims proved, all tests passed; 1 otherwise; 2 bad input.";

/// Prove the claims for all values of their quantities
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these, with their proofs in full: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Write everything for the proof assistant Coq (Rocq) to this directory instead
    #[arg(long, value_name = "DIR", conflicts_with_all = ["numbers", "format"])]
    coq: Option<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

formats!(
    Table: "For reading: one line for each claim",
    Json: "For programs: everything",
    Markdown: "For documents: one line for each claim"
);

/// Returns a printer with the names of the chapter.
fn printer() -> ProofPrinter<'static> {
    ProofPrinter::new(registry())
}

/// Proves the claims and prints the result.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    if let Some(directory) = &options.coq {
        return for_coq(directory);
    }
    let numbers = args::equations(&options.numbers)?;
    let statements = statements();
    let empty = |number: &&String| statements.iter().all(|s| s.equation() != number.as_str());
    if let Some(empty) = numbers.iter().find(empty) {
        let reason = format!("it has no claim to be proved; see `contact equations '{empty}'`");
        return Err(args::invalid(empty, "[NUMBER]...", reason));
    }
    let proofs = prove_equations(&numbers);
    output::print(|out| match options.format {
        Format::Json => output::json(out, &proofs),
        Format::Markdown => markdown(out, &proofs),
        Format::Table if numbers.is_empty() => table(out, &proofs),
        Format::Table => details(out, &proofs),
    })?;
    Ok(Exit::from_result(proofs.hold()))
}

/// Writes the files for Coq, and prints how to compile them and which claims are omitted.
fn for_coq(directory: &Path) -> Result<Exit, Failure> {
    // A directory that cannot be written to is refused before anything is proved.
    let files = make_writable(directory).and_then(|()| coq().write(directory)).map_err(|error| {
        let reason = format!("must be a writable directory: {error}");
        args::invalid(&directory.display().to_string(), "--coq <DIR>", reason)
    })?;
    output::print(|out| {
        writeln!(out, "The claims as theorems; compile them in this order:")?;
        // Compiled in the directory, since coqc writes caches such as .nra.cache to the current one.
        output::command(out, ["cd", "--", &directory.display().to_string()])?;
        for file in files.iter().filter_map(|file| file.file_name()) {
            output::command(out, ["coqc", "-R", ".", "Contact", &file.to_string_lossy()])?;
        }
        coq().omitted().iter().try_for_each(|Omitted { equation, name, reason }| {
            writeln!(out, "  # left out: {equation} {name}: {reason}")
        })
    })
}

/// Creates the directory if it does not exist, and for a moment a file in it.
fn make_writable(directory: &Path) -> io::Result<()> {
    fs::create_dir_all(directory)?;
    let file = directory.join(format!(".contact-{}", process::id()));
    fs::write(&file, "").and_then(|()| fs::remove_file(&file))
}

fn how(proved: &ProofAttempt) -> String {
    match &proved.answer {
        ProofOutcome::Proof(proof) => render::proof_summary(proof),
        ProofOutcome::None(..) => proved.status().to_uppercase(),
    }
}

fn table(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let rows = proofs.claims.iter().map(|proved| {
        let ProofAttempt { statement, answer, time } = proved;
        let hypotheses = match answer {
            ProofOutcome::Proof(proof) => printer().used(proof),
            ProofOutcome::None(..) => proved.hypotheses(),
        };
        let label = entry(statement.equation()).map(Entry::label).unwrap_or_default();
        let time = format!("{:.2}", time.as_secs_f64() * 1e3);
        [label, statement.name().to_string(), how(proved), hypotheses.join(", "), time]
    });
    output::table(out, ["number", "claim", "how", "by hypotheses", "ms"], rows, 2..4)?;
    print_problems(out, proofs)?;
    writeln!(out)?;
    totals(out, proofs)
}

/// Prints each problem after a blank line.
fn print_problems(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    for ProofAttempt { statement, answer, .. } in &proofs.claims {
        let (equation, name) = (statement.equation(), statement.name());
        match answer {
            ProofOutcome::Proof(_) => {}
            ProofOutcome::None(reason, None) => {
                writeln!(out)?;
                output::wrapped(out, "", 2, &format!("{equation} {name} UNKNOWN: {reason}"))?;
                output::wrapped(out, "  ", 4, &join_operands(&printer().claim(statement)))?;
            }
            ProofOutcome::None(_, Some(counterexample)) => {
                writeln!(out, "\n{equation} {name} REFUTED")?;
                output::wrapped(out, "  ", 4, &join_operands(&printer().claim(statement)))?;
                output::wrapped(out, "  at ", 4, &output::join_coordinates(counterexample))?;
            }
        }
    }
    let redundant = proofs.mutation.redundant_hypotheses().map(
        |DroppedHypothesis { equation, name, hypothesis: given, outcome: without }| {
            let what = match without {
                DropOutcome::StillProved => "is not needed: the claim is proved without it",
                DropOutcome::Undecided | DropOutcome::Refuted(_) => {
                    "may not be needed: no counterexample to the claim without it was found"
                }
            };
            format!("{equation} {name}: the hypothesis {} {what}", registry().format_hypothesis(given))
        },
    );
    let unnoticed = proofs.mutation.mutants.iter().filter_map(|(change, effect)| match effect {
        MutationOutcome::Undetected => Some(format!("UNNOTICED {}: {}", change.site, change.mutation)),
        MutationOutcome::Detected { .. } | MutationOutcome::Equivalent => None,
    });
    redundant.chain(unnoticed).try_for_each(|line| {
        writeln!(out)?;
        output::wrapped(out, "", 2, &line)
    })
}

fn totals(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let Summary { claims, proved, hypotheses, controls, .. } = proofs.summary();
    let seconds = |time: Duration| time.as_secs_f64();
    writeln!(out, "{proved} of {claims} claims proved in {:.3} s.", seconds(proofs.proof_time))?;
    if proved < claims {
        return writeln!(out, "Mutations are tested when all claims are proved.");
    }
    let dropped = &proofs.mutation.dropped;
    let needed = dropped.iter().filter(|dropped| matches!(dropped.outcome, DropOutcome::Refuted(_))).count();
    let fine = dropped.iter().filter(|dropped| dropped.is_precision_only()).count();
    writeln!(out, "{needed} of {hypotheses} hypotheses needed, {fine} only for a higher precision.")?;
    let (mutations, refuted, equivalent) = (controls.mutations, controls.detected, controls.equivalent);
    let detected = refuted + equivalent;
    let total = format!(
        "{detected} of {mutations} mutations of formulas detected: {refuted} refuted, \
         {equivalent} proved equivalent."
    );
    output::wrapped(out, "", 2, &total)?;
    writeln!(out, "{:.3} s in all.", seconds(proofs.total_time))
}

/// Prints the proofs.
fn details(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    for (i, claims) in proofs.by_equation().enumerate() {
        if i > 0 {
            writeln!(out)?;
        }
        if let Some(entry) = entry(claims[0].statement.equation()) {
            writeln!(out, "{} {}", entry.label(), entry.title)?;
        }
        for proved in claims {
            writeln!(out)?;
            print_claim(out, proofs, proved)?;
        }
    }
    let detected = proofs.mutation.summary().detected;
    if detected > 0 {
        let noticed =
            format!("These claims detect {detected} mutations of formulas; --format json lists them.");
        writeln!(out)?;
        output::wrapped(out, "", 2, &noticed)?;
    }
    print_problems(out, proofs)
}

fn print_claim(out: &mut dyn Write, proofs: &Proofs, proved: &ProofAttempt) -> io::Result<()> {
    let ProofAttempt { statement, answer, .. } = proved;
    writeln!(out, "{} ({})", statement.name(), how(proved))?;
    let mut say = |what: &str, lines: &[String]| {
        lines.iter().enumerate().try_for_each(|(i, line)| {
            let what = if i == 0 { what } else { "" };
            let text = line.trim_start();
            let first = format!("  {what:<8} {}", " ".repeat(line.len() - text.len()));
            // Indented more than the next line of a proof.
            output::wrapped(out, &first, first.len() + 4, &join_operands(text))
        })
    };
    say("claim", &[printer().claim(statement)])?;
    if !statement.hypotheses().is_empty() {
        say("if", &[proved.hypotheses().join(", ")])?;
    }
    let always = printer().invariants(statement);
    if !always.is_empty() {
        let every = statement.conclusion().map(|_| format!(" for every {}", printer().index(statement)));
        let every = every.unwrap_or_default();
        say("always", &[format!("{}{every}, which is part of the proof", always.join(", "))])?;
    }
    say("where", &printer().names(statement))?;
    match answer {
        ProofOutcome::Proof(proof) => say("proof", &printer().proof(proof))?,
        ProofOutcome::None(reason, _) => say("no proof", std::slice::from_ref(reason))?,
    }
    let needed = proofs.dropped(statement).filter_map(
        |DroppedHypothesis { hypothesis: given, outcome: without, .. }| match without {
            DropOutcome::Refuted(refutation) => {
                let at = output::join_coordinates(&refutation.counterexample());
                Some(format!("{}: without it, at {at}", registry().format_hypothesis(given)))
            }
            DropOutcome::StillProved | DropOutcome::Undecided => None,
        },
    );
    say("needs", &needed.collect::<Vec<_>>())?;
    let sharp =
        statement.contains_rounding().then(|| tightest_point(statement)).flatten().map(|(point, share)| {
            let percent = (100.0 * share.as_rational().to_f64()).floor();
            format!("{percent} % of the bound attained at {}", output::join_coordinates(&point))
        });
    say("sharp", &sharp.into_iter().collect::<Vec<_>>())
}

fn markdown(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let rows = proofs.claims.iter().map(|proved| {
        let (equation, name) = (proved.statement.equation(), proved.statement.name());
        let [number, name, status] = [equation, name, proved.status()].map(String::from);
        let hypotheses = proved.hypotheses().join(", ");
        [number, name, printer().claim(&proved.statement), hypotheses, how(proved), status]
    });
    output::markdown(out, ["number", "claim", "says", "if", "how", "status"], rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spring_mass_contact::formula::Hypothesis;
    use spring_mass_contact::formula::statement::{Goal, Proposition, Statement};
    use spring_mass_contact::number::{Field, Tree};

    /// Returns a result in which every equality is wrong by 1.
    fn refuted() -> Proofs {
        let wrong = |statement: Statement| {
            ProofAttempt::of(match statement.goals() {
                [Goal { proposition: Proposition::Equal(left, right), .. }] => {
                    statement.with_proposition(Proposition::Equal(left.clone(), right + Tree::int(1)))
                }
                _ => statement,
            })
        };
        Proofs { claims: statements().into_iter().map(wrong).collect(), ..Proofs::default() }
    }

    fn claim(name: &str) -> Statement {
        statements().into_iter().find(|statement| statement.name() == name).unwrap()
    }

    /// An absolute value in a hypothesis does not end a cell.
    #[test]
    fn a_row_of_markdown_has_as_many_cells_as_its_header() {
        let near = Hypothesis::near(&Tree::symbol("v"), 0, Tree::symbol("tol"));
        let statement = claim("float-drift").assuming([&near]);
        let proofs = Proofs { claims: vec![ProofAttempt::of(statement)], ..Proofs::default() };
        let text = output::capture(|out| markdown(out, &proofs));
        let cells = |line: &str| line.replace("\\|", "").matches('|').count();
        assert!(text.contains("\\|v\\| ≤ tol"), "{text}");
        assert!(text.lines().all(|line| cells(line) == 7), "{text}");
    }

    /// The claim defines x₁ and q.
    #[test]
    fn an_unknown_result_is_printed_with_its_claim() {
        let mut unknown = ProofAttempt::of(claim("float-drift"));
        unknown.answer = ProofOutcome::None("no rule finds the sign of x₁ − q".into(), None);
        let proofs = Proofs { claims: vec![unknown], ..Proofs::default() };
        let text = output::capture(|out| print_problems(out, &proofs)).replace("\n   ", "");
        assert!(
            text.contains("UNKNOWN: no rule finds the sign of x₁ − q\n  k steps from 0, each of x₁ to"),
            "{text}"
        );
    }

    #[test]
    fn a_refutation_fits_the_line_width() {
        let proofs = refuted();
        let text = output::capture(|out| {
            table(out, &proofs)?;
            details(out, &proofs)
        });
        assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
        assert!(
            text.contains(" REFUTED\n")
                && text.contains("\nMutations are tested when all claims are proved.\n"),
            "{text}"
        );
    }
}

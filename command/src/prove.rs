//! `contact prove`: proofs of every claim, and tests that they could fail.

use crate::args;
use crate::lines::join_operands;
use crate::output::{self, Exit, Failure, formats};
use spring_mass_contact::claims::{Entry, entry, registry, statements};
use spring_mass_contact::proof::coq::Omitted;
use spring_mass_contact::proof::mutation::{self, DropOutcome, DroppedHypothesis, MutationOutcome};
use spring_mass_contact::proof::render::{self, ProofPrinter};
use spring_mass_contact::proof::tightest_point;
use spring_mass_contact::verify::coq;
use spring_mass_contact::verify::proofs::{
    ProofAttempt, ProofOutcome, ProofSummary, Proofs, prove_equations,
};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
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
    Json: "For programs: everything"
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
    if let Some(empty) = numbers.iter().find(|number| statements.iter().all(|s| s.equation() != **number)) {
        let reason = format!("it has no claim to be proved; see `contact equations '{empty}'`");
        return Err(args::invalid(empty, "[NUMBER]...", reason));
    }
    let proofs = prove_equations(&numbers);
    output::print(|out| match options.format {
        // One line, since its polynomials nest deeply.
        Format::Json => {
            serde_json::to_writer(&mut *out, &proofs)?;
            writeln!(out)
        }
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

fn outcome_in_words(attempt: &ProofAttempt) -> String {
    match &attempt.outcome {
        ProofOutcome::Proof(proof) => render::proof_summary(proof),
        ProofOutcome::None(..) => attempt.status().to_uppercase(),
    }
}

fn table(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let rows = proofs.claims.iter().map(|attempt| {
        let ProofAttempt { statement, outcome, time } = attempt;
        let hypotheses = match outcome {
            ProofOutcome::Proof(proof) => printer().used(proof),
            ProofOutcome::None(..) => attempt.hypotheses(),
        };
        let label = entry(statement.equation()).map(Entry::label).unwrap_or_default();
        let time = format!("{:.2}", time.as_secs_f64() * 1e3);
        [label, statement.name().to_string(), outcome_in_words(attempt), hypotheses.join(", "), time]
    });
    output::table(out, ["number", "claim", "how", "by hypotheses", "ms"], rows, 2..4)?;
    print_problems(out, proofs)?;
    writeln!(out)?;
    totals(out, proofs)
}

/// Prints each problem after a blank line.
fn print_problems(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    for ProofAttempt { statement, outcome, .. } in &proofs.claims {
        let ProofOutcome::None(reason, counterexample) = outcome else { continue };
        let status = counterexample.as_ref().map_or(format!("UNKNOWN: {reason}"), |_| "REFUTED".to_string());
        writeln!(out)?;
        output::wrapped(out, "", 2, &format!("{} {} {status}", statement.equation(), statement.name()))?;
        output::wrapped(out, "  ", 4, &join_operands(&printer().claim(statement)))?;
        if let Some(point) = counterexample {
            output::wrapped(out, "  at ", 4, &output::join_coordinates(point))?;
        }
    }
    let redundant = proofs.mutation.redundant_hypotheses().map(|dropped| {
        let DroppedHypothesis { equation, name, hypothesis, outcome } = dropped;
        let finding = match outcome {
            DropOutcome::StillProved => "is not needed: the claim is proved without it",
            DropOutcome::Undecided | DropOutcome::Refuted(_) => {
                "may not be needed: no counterexample to the claim without it was found"
            }
        };
        format!("{equation} {name}: the hypothesis {} {finding}", registry().format_hypothesis(hypothesis))
    });
    let undetected = proofs.mutation.mutants.iter().filter_map(|(mutant, outcome)| match outcome {
        MutationOutcome::Undetected => Some(format!("UNNOTICED {}: {}", mutant.site, mutant.mutation)),
        MutationOutcome::Detected { .. } | MutationOutcome::Equivalent => None,
    });
    redundant.chain(undetected).try_for_each(|line| {
        writeln!(out)?;
        output::wrapped(out, "", 2, &line)
    })
}

fn totals(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let ProofSummary { claims, proved, hypotheses, controls, .. } = proofs.summary();
    writeln!(out, "{proved} of {claims} claims proved in {:.3} s.", proofs.proof_time.as_secs_f64())?;
    if proved < claims {
        return writeln!(out, "Mutations are tested when all claims are proved.");
    }
    let dropped = &proofs.mutation.dropped;
    let needed = dropped.iter().filter(|dropped| matches!(dropped.outcome, DropOutcome::Refuted(_))).count();
    let fine = dropped.iter().filter(|dropped| dropped.is_precision_only()).count();
    writeln!(out, "{needed} of {hypotheses} hypotheses needed, {fine} only for a higher precision.")?;
    let mutation::MutationSummary { mutations, detected, equivalent, .. } = controls;
    let total = format!(
        "{} of {mutations} mutations of formulas detected: {detected} refuted, {equivalent} proved equivalent.",
        detected + equivalent
    );
    output::wrapped(out, "", 2, &total)?;
    writeln!(out, "{:.3} s in all.", proofs.total_time.as_secs_f64())
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
        for attempt in claims {
            writeln!(out)?;
            print_claim(out, proofs, attempt)?;
        }
    }
    let detected = proofs.mutation.summary().detected;
    if detected > 0 {
        let detected =
            format!("These claims detect {detected} mutations of formulas; --format json lists them.");
        writeln!(out)?;
        output::wrapped(out, "", 2, &detected)?;
    }
    print_problems(out, proofs)
}

fn print_claim(out: &mut dyn Write, proofs: &Proofs, attempt: &ProofAttempt) -> io::Result<()> {
    let ProofAttempt { statement, outcome, .. } = attempt;
    writeln!(out, "{} ({})", statement.name(), outcome_in_words(attempt))?;
    print_lines(out, "claim", &[printer().claim(statement)])?;
    if !statement.hypotheses().is_empty() {
        print_lines(out, "if", &[attempt.hypotheses().join(", ")])?;
    }
    let invariants = printer().invariants(statement);
    if !invariants.is_empty() {
        let index = statement.conclusion().map(|_| format!(" for every {}", printer().index(statement)));
        let (invariants, index) = (invariants.join(", "), index.unwrap_or_default());
        print_lines(out, "always", &[format!("{invariants}{index}, which is part of the proof")])?;
    }
    print_lines(out, "where", &printer().names(statement))?;
    match outcome {
        ProofOutcome::Proof(proof) => print_lines(out, "proof", &printer().proof(proof))?,
        ProofOutcome::None(reason, _) => print_lines(out, "no proof", std::slice::from_ref(reason))?,
    }
    let needed = proofs.dropped(statement).filter_map(|dropped| match &dropped.outcome {
        DropOutcome::Refuted(refutation) => {
            let hypothesis = registry().format_hypothesis(&dropped.hypothesis);
            let point = output::join_coordinates(&refutation.counterexample());
            Some(format!("{hypothesis}: without it, at {point}"))
        }
        DropOutcome::StillProved | DropOutcome::Undecided => None,
    });
    print_lines(out, "needs", &needed.collect::<Vec<_>>())?;
    if let Some((point, share)) = statement.contains_rounding().then(|| tightest_point(statement)).flatten() {
        let percent = (100.0 * share.as_rational().to_f64()).floor();
        let point = output::join_coordinates(&point);
        print_lines(out, "sharp", &[format!("{percent} % of the bound attained at {point}")])?;
    }
    Ok(())
}

/// Prints lines after a name, each continued with a deeper indent than that of the next line of a proof.
fn print_lines(out: &mut dyn Write, name: &str, lines: &[String]) -> io::Result<()> {
    for (i, line) in lines.iter().enumerate() {
        let text = line.trim_start();
        let first =
            format!("  {:<8} {}", if i == 0 { name } else { "" }, " ".repeat(line.len() - text.len()));
        output::wrapped(out, &first, first.len() + 4, &join_operands(text))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use spring_mass_contact::formula::statement::{Goal, Proposition, Statement};
    use spring_mass_contact::number::{Field, Tree};

    /// Returns the equalities of the chapter, each wrong by 1.
    fn refuted() -> Proofs {
        let wrong = |statement: Statement| match statement.goals() {
            [Goal { proposition: Proposition::Equal(left, right), .. }] => Some(ProofAttempt::of(
                statement.with_proposition(Proposition::Equal(left.clone(), right + Tree::int(1))),
            )),
            _ => None,
        };
        Proofs { claims: statements().into_iter().filter_map(wrong).collect(), ..Proofs::default() }
    }

    fn claim(name: &str) -> Statement {
        statements().into_iter().find(|statement| statement.name() == name).unwrap()
    }

    /// The claim defines x₁ and q.
    #[test]
    fn an_unknown_result_is_printed_with_its_claim() {
        let mut unknown = ProofAttempt::of(claim("float-drift"));
        unknown.outcome = ProofOutcome::None("no rule finds the sign of x₁ − q".into(), None);
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

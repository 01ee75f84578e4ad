//! `contact prove`: every claim for all values, and that wrong ones would be noticed.

use crate::lines::join_operands;
use crate::output::{self, Exit, Failure, formats};
use crate::{args, solve};
use spring_mass_contact::claims::{Entry, entry, registry, statements};
use spring_mass_contact::proof::controls::{Change, Dropped, Effect, Without};
use spring_mass_contact::proof::coq::LeftOut;
use spring_mass_contact::proof::paper::{self, Paper};
use spring_mass_contact::proof::sharpest;
use spring_mass_contact::verify::coq;
use spring_mass_contact::verify::proofs::{Answer, Proofs, Proved, Summary, prove_all};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  contact prove
  contact prove 1.17 'Theorem 1.3.3'
  contact prove --format json
  contact prove --coq target/coq

A proof holds for all values that satisfy the hypotheses, and it is made from
the functions that compute. Two kinds of controls show that it could have
failed: a claim without one of its hypotheses has to be wrong, and every small
change of a formula in src/chapter has to be noticed by some claim, or proved to
change nothing.

Exit status: 0 all proved, no control amiss; 1 otherwise; 2 bad input.";

/// Prove the claims for all values of their quantities
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    /// Only these, with their proofs in full: 1.13, 'Theorem 1.3.3', 'note 4', …
    #[arg(value_name = "NUMBER")]
    numbers: Vec<String>,
    /// Write everything for the proof assistant Coq to this directory instead
    #[arg(long, value_name = "DIR", conflicts_with_all = ["numbers", "format"])]
    coq: Option<PathBuf>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Table)]
    format: Format,
}

formats!(
    Table: "For reading: a line a claim",
    Json: "For programs: everything",
    Markdown: "For documents: a line a claim"
);

/// Writes in the chapter's names.
fn paper() -> Paper<'static> {
    Paper::new(registry())
}

/// Proves and prints.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    if let Some(directory) = &options.coq {
        return for_coq(directory);
    }
    let numbers = args::equations(&options.numbers)?;
    let statements = statements();
    let empty = |number: &&String| statements.iter().all(|s| s.equation() != number.as_str());
    if let Some(empty) = numbers.iter().find(empty) {
        let why =
            format!("nothing is proved of it; `contact equations '{empty}'` says what is claimed of it");
        return Err(args::invalid(empty, "[NUMBER]...", why));
    }
    let proofs = prove_all(&numbers);
    output::print(|out| match options.format {
        Format::Json => output::json(out, &proofs),
        Format::Markdown => markdown(out, &proofs),
        Format::Table if numbers.is_empty() => table(out, &proofs),
        Format::Table => details(out, &proofs),
    })?;
    Ok(Exit::from_result(proofs.hold()))
}

/// Writes the files for Coq, and says how they are compiled and what is not among them.
fn for_coq(directory: &Path) -> Result<Exit, Failure> {
    let files = coq().write(directory).map_err(|error| {
        let why = format!("must be a directory that can be written: {error}");
        args::invalid(&directory.display().to_string(), "--coq <DIR>", why)
    })?;
    output::print(|out| {
        writeln!(out, "The claims as theorems, to be compiled in this order:")?;
        // From the directory, since coqc writes caches such as .nra.cache to the one that it is started in.
        output::command(out, ["cd", "--", &directory.display().to_string()])?;
        for file in files.iter().filter_map(|file| file.file_name()) {
            output::command(out, ["coqc", "-R", ".", "Contact", &file.to_string_lossy()])?;
        }
        coq().left_out().iter().try_for_each(|LeftOut { equation, name, reason }| {
            writeln!(out, "  # left out: {equation} {name}: {reason}")
        })
    })
}

fn how(proved: &Proved) -> String {
    match &proved.answer {
        Answer::Proof(proof) => paper::how(proof),
        Answer::None(..) => proved.status().to_uppercase(),
    }
}

fn table(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let rows = proofs.claims.iter().map(|proved| {
        let Proved { statement, answer, time } = proved;
        let hypotheses = match answer {
            Answer::Proof(proof) => paper().used(proof),
            Answer::None(..) => proved.hypotheses(),
        };
        let label = entry(statement.equation()).map(Entry::label).unwrap_or_default();
        let time = format!("{:.2}", time.as_secs_f64() * 1e3);
        [label, statement.name().to_string(), how(proved), hypotheses.join(", "), time]
    });
    output::table(out, ["number", "claim", "how", "by hypotheses", "ms"], rows, &[0, 1, 4])?;
    print_problems(out, proofs)?;
    writeln!(out)?;
    totals(out, proofs)
}

/// Prints what is not as it should be, each after a blank line.
fn print_problems(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    for Proved { statement, answer, .. } in &proofs.claims {
        let (equation, name) = (statement.equation(), statement.name());
        match answer {
            Answer::Proof(_) => {}
            Answer::None(why, None) => {
                writeln!(out)?;
                output::wrapped(out, "", 2, &format!("{equation} {name} UNKNOWN: {why}"))?;
                output::wrapped(out, "  ", 4, &join_operands(&paper().claim(statement)))?;
            }
            Answer::None(_, Some(counterexample)) => {
                writeln!(out, "\n{equation} {name} REFUTED")?;
                output::wrapped(out, "  ", 4, &join_operands(&paper().claim(statement)))?;
                output::wrapped(out, "  at ", 4, &output::glued(counterexample))?;
                solve::command(out, &counterexample.point)?;
            }
        }
    }
    let repairs = proofs.repairs.iter().map(|change| format!("with {change} every claim would be proved"));
    let needless = proofs.controls.needless().map(|Dropped { equation, name, given, without }| {
        let what = match without {
            Without::StillTrue => "is not needed: the claim is proved without it",
            Without::Unknown | Without::Refuted(_) => {
                "may not be needed: nothing was found against the claim without it"
            }
        };
        format!("{equation} {name}: the hypothesis {} {what}", registry().supposed(given))
    });
    let unnoticed = proofs.controls.changes.iter().filter_map(|(change, effect)| match effect {
        Effect::Unnoticed => Some(format!("UNNOTICED {}: {}", change.site, change.what)),
        Effect::Noticed { .. } | Effect::Unchanged => None,
    });
    repairs.chain(needless).chain(unnoticed).try_for_each(|line| {
        writeln!(out)?;
        output::wrapped(out, "", 2, &line)
    })
}

fn totals(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let Summary { claims, proved, hypotheses, controls, .. } = proofs.summary();
    let seconds = |time: Duration| time.as_secs_f64();
    writeln!(out, "{proved} of {claims} claims proved in {:.3} s.", seconds(proofs.of_proofs))?;
    if proved < claims {
        return writeln!(out, "The controls wait until all are.");
    }
    let dropped = &proofs.controls.dropped;
    let needed = dropped.iter().filter(|dropped| matches!(dropped.without, Without::Refuted(_))).count();
    let fine = dropped.iter().filter(|dropped| dropped.is_of_precision()).count();
    writeln!(out, "{needed} of {hypotheses} hypotheses needed, {fine} only for finer numbers.")?;
    let (changes, noticed, unchanged) = (controls.changes, controls.noticed, controls.unchanged);
    let seen = noticed + unchanged;
    let seen = format!(
        "{seen} of {changes} changes of formulas noticed: {noticed} refuted, \
         {unchanged} proved to change nothing."
    );
    output::wrapped(out, "", 2, &seen)?;
    writeln!(out, "{:.3} s in all.", seconds(proofs.in_all))
}

/// The proofs themselves.
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
    let noticed = proofs.controls.changes.iter().filter_map(|(Change { site, what }, effect)| match effect {
        Effect::Noticed { equation, name, refutation } => {
            let at = output::glued(&refutation.counterexample());
            Some(format!("{site}: {what}, by {equation} {name} at {at}"))
        }
        Effect::Unchanged | Effect::Unnoticed => None,
    });
    let noticed: Vec<_> = noticed.collect();
    if !noticed.is_empty() {
        writeln!(out, "\nchanges of formulas that these claims notice")?;
        noticed.iter().try_for_each(|line| output::wrapped(out, "  ", 4, line))?;
    }
    print_problems(out, proofs)
}

fn print_claim(out: &mut dyn Write, proofs: &Proofs, proved: &Proved) -> io::Result<()> {
    let Proved { statement, answer, .. } = proved;
    writeln!(out, "{} ({})", statement.name(), how(proved))?;
    let mut say = |what: &str, lines: &[String]| {
        lines.iter().enumerate().try_for_each(|(i, line)| {
            let what = if i == 0 { what } else { "" };
            let text = line.trim_start();
            let first = format!("  {what:<8} {}", " ".repeat(line.len() - text.len()));
            // Further in than what is a step of its own.
            output::wrapped(out, &first, first.len() + 4, &join_operands(text))
        })
    };
    say("claim", &[paper().claim(statement)])?;
    if !statement.hypotheses().is_empty() {
        say("if", &[proved.hypotheses().join(", ")])?;
    }
    let always = paper().always(statement);
    if !always.is_empty() {
        let every = statement.conclusion().map(|_| format!(" for every {}", paper().index(statement)));
        let every = every.unwrap_or_default();
        say("always", &[format!("{}{every}, which is part of the proof", always.join(", "))])?;
    }
    say("where", &paper().names(statement))?;
    match answer {
        Answer::Proof(proof) => say("proof", &paper().proof(proof))?,
        Answer::None(why, _) => say("no proof", std::slice::from_ref(why))?,
    }
    let needed = proofs.dropped(statement).filter_map(|Dropped { given, without, .. }| match without {
        Without::Refuted(refutation) => {
            let at = output::glued(&refutation.counterexample());
            Some(format!("{}: without it, at {at}", registry().supposed(given)))
        }
        Without::StillTrue | Without::Unknown => None,
    });
    say("needs", &needed.collect::<Vec<_>>())?;
    let sharp = statement.contains_rounding().then(|| sharpest(statement)).flatten().map(|(point, share)| {
        let percent = (100.0 * share.as_rational().to_f64()).floor();
        format!("{percent} % of the bound are used up at {}", output::glued(&point))
    });
    say("sharp", &sharp.into_iter().collect::<Vec<_>>())
}

fn markdown(out: &mut dyn Write, proofs: &Proofs) -> io::Result<()> {
    let rows = proofs.claims.iter().map(|proved| {
        let (equation, name) = (proved.statement.equation(), proved.statement.name());
        let [number, name, status] = [equation, name, proved.status()].map(String::from);
        let hypotheses = proved.hypotheses().join(", ");
        [number, name, paper().claim(&proved.statement), hypotheses, how(proved), status]
    });
    output::markdown(out, ["number", "claim", "says", "if", "how", "status"], rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use spring_mass_contact::formula::Hypothesis;
    use spring_mass_contact::formula::statement::{Goal, Proposition, Statement};
    use spring_mass_contact::number::{Field, Tree};

    /// A run in which every equality is wrong by 1.
    fn refuted() -> Proofs {
        let wrong = |statement: Statement| {
            Proved::of(match statement.goals() {
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

    /// A size in a hypothesis ends no cell.
    #[test]
    fn a_row_of_markdown_has_as_many_cells_as_its_head() {
        let near = Hypothesis::near(&Tree::symbol("v"), 0, Tree::symbol("tol"));
        let statement = claim("float-drift").assuming([&near]);
        let proofs = Proofs { claims: vec![Proved::of(statement)], ..Proofs::default() };
        let text = output::printed(|out| markdown(out, &proofs));
        let cells = |line: &str| line.replace("\\|", "").matches('|').count();
        assert!(text.contains("\\|v\\| ≤ tol"), "{text}");
        assert!(text.lines().all(|line| cells(line) == 7), "{text}");
    }

    /// Without its claim nobody knows what x₁ and q are.
    #[test]
    fn what_is_unknown_comes_with_its_claim() {
        let mut unknown = Proved::of(claim("float-drift"));
        unknown.answer = Answer::None("no rule finds the sign of x₁ − q".into(), None);
        let proofs = Proofs { claims: vec![unknown], ..Proofs::default() };
        let text = output::printed(|out| print_problems(out, &proofs)).replace("\n   ", "");
        assert!(
            text.contains("UNKNOWN: no rule finds the sign of x₁ − q\n  k steps from 0, each of x₁ to"),
            "{text}"
        );
    }

    #[test]
    fn what_is_refuted_fits_on_a_page() {
        let proofs = refuted();
        let text = output::printed(|out| {
            table(out, &proofs)?;
            details(out, &proofs)
        });
        assert_eq!(text.lines().find(|line| line.chars().count() > 80), None);
        assert!(
            text.contains(" REFUTED\n") && text.contains("\nThe controls wait until all are.\n"),
            "{text}"
        );
        // The claims are wrong and the chapter is right, so a solve reproduces none of them.
        assert!(!text.contains("contact solve"), "{text}");
    }
}

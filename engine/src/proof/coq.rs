//! The second route: functions and what is claimed of them for the proof assistant Coq, whose kernel checks
//! them anew.
//!
//! A [`Development`] has every function of a registry as a definition, printed from its recorded formula,
//! and every claim as a theorem about these definitions, with its hypotheses as premises. Signs and
//! equalities are decided by a program in Coq that is proved correct there (`polynomials.v`, `quotients.v`).
//! What it needs is taken from the kernel's derivation: the names of the hypotheses' quantities, the
//! monomials that they replace, the cases, and the part of a quantity that has the sign of its slope. Nothing
//! of that is taken on trust: if Coq accepts the files, what is left to trust is Coq's own kernel, its axioms
//! of the real numbers, and that definitions and theorems read as their sources do.
//!
//! A function that only hands on what another computes leaves no step of its own in a record, so a theorem
//! speaks in the names of the functions that its entry lists. A definition that no theorem names would
//! protect nothing.
//!
//! What goes further than our own kernel: an induction is one over the natural numbers, a limit is one in
//! the sense of ε and N, a derivative is one in the sense of a limit. Coq lets everything be divided by 0,
//! so for every claim a lemma of its own, `…_defined`, says that no divisor is 0.
//!
//! What is rounded is so by the library Flocq: its rounding to nearest, for every precision of two bits or
//! more and whatever becomes of a number half-way between two. That it is x (1 + γ e), as our kernel reads
//! it, is a lemma there.

mod expr;
mod induction;
mod lemma;
mod print;
mod script;
mod theorem;

use crate::formula::{Registry, Statement};
use print::{Printer, ascii};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};
use theorem::Claim;

/// A file for Coq.
#[derive(Clone, Debug)]
pub struct File {
    /// Its name, which ends in `.v`. A file needs only files whose names come before its own.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// A claim that is not among the files.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// The entry it belongs to.
    pub equation: &'static str,
    /// Its name.
    pub name: &'static str,
    /// Why.
    pub reason: String,
}

/// A claim and where it belongs.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The claim.
    pub claim: &'a Statement,
    /// Its section: claims of one section stand together.
    pub section: &'a str,
    /// The functions that it is about: of those that compute the same, the first of these is named.
    pub functions: &'a [&'static str],
}

/// Definitions of a registry's functions, and theorems about them.
#[derive(Clone, Debug)]
pub struct Development<'a> {
    library: &'a str,
    registry: &'a Registry,
    written: Vec<Written>,
    left_out: Vec<LeftOut>,
    more: Option<(&'static str, &'static str)>,
}

const TACTICS: &str = "A_Tactics";
const DEFINITIONS: &str = "B_Definitions";
const ROUNDING: &str = "B_Rounding";
const ASSUMPTIONS: &str = "E_Assumptions";

/// What all theorems stand on; none comes before what it needs.
const PROGRAM: [(&str, &str); 3] = [
    ("A_Polynomials", include_str!("coq/polynomials.v")),
    ("A_Quotients", include_str!("coq/quotients.v")),
    (TACTICS, include_str!("coq/tactics.v")),
];

impl<'a> Development<'a> {
    /// The claims, printed, and those that cannot be. The files require each other from the `library`.
    pub fn new<'c>(
        library: &'a str,
        registry: &'a Registry,
        claims: impl IntoIterator<Item = Placed<'c>>,
    ) -> Self {
        let (mut written, mut left_out) = (Vec::new(), Vec::new());
        for Placed { claim, section, functions } in claims {
            let printer = Printer { registry, preferred: functions };
            match Claim::new(claim, printer).text() {
                Ok(text) => {
                    written.push(Written {
                        section: section.to_string(),
                        rounds: claim.contains_rounding(),
                        text,
                    });
                }
                Err(reason) => {
                    left_out.push(LeftOut { equation: claim.equation(), name: claim.name(), reason })
                }
            }
        }
        Development { library, registry, written, left_out, more: None }
    }

    /// With a file of its own, written by hand, which may use all others.
    pub fn with(self, name: &'static str, text: &'static str) -> Self {
        Development { more: Some((name, text)), ..self }
    }

    /// Everything: tactics, definitions, theorems by section, and what joins them.
    ///
    /// They compile in this order, and in that of their names: `coqc -R DIR LIBRARY FILE`.
    pub fn files(&self) -> Vec<File> {
        let mut files: Vec<_> = PROGRAM.iter().map(|(name, text)| file(name, text.to_string())).collect();
        files.push(file(DEFINITIONS, self.definitions()));
        if self.written.iter().any(|written| written.rounds) {
            files.push(file(ROUNDING, include_str!("coq/rounding.v").to_string()));
        }
        let mut theorems = by_section(&self.written);
        let name = |file: &File| format!(" {}", file.name.trim_end_matches(".v"));
        let mut all: String = theorems.iter().map(name).collect();
        if let Some((name, text)) = self.more {
            let head = format!("From LIBRARY Require Import {TACTICS} {DEFINITIONS}{all}.\n\n");
            theorems.push(file(name, head + text));
            all = format!("{all} {name}");
        }
        // Asking of each theorem what it rests on would take longer than all proofs.
        let parts: Vec<_> = theorems.iter_mut().map(together).collect();
        files.extend(theorems);
        if !parts.is_empty() {
            let assumptions = format!(
                "(** * What everything rests on. *)\n\
                 From LIBRARY Require Import {TACTICS} {DEFINITIONS}{all}.\n\n\
                 Definition everything :=\n  ({}).\nPrint Assumptions everything.\n",
                parts.join(",\n   ")
            );
            files.push(file(ASSUMPTIONS, assumptions));
        }
        files.into_iter().map(|file| self.named(file)).collect()
    }

    /// The file, with the library that it requires others from.
    fn named(&self, File { name, text }: File) -> File {
        let from = format!("From {} Require", self.library);
        File { name, text: text.replace("From LIBRARY Require", &from) }
    }

    /// Writes the files to a directory, which is made if it is not there.
    ///
    /// # Errors
    /// The first that the file system reports. No part of a file is left then, and what was there before is
    /// there still, unless a whole file has taken its place.
    pub fn write(&self, directory: &Path) -> io::Result<Vec<PathBuf>> {
        fs::create_dir_all(directory)?;
        let files = self.files();
        let part = |file: &File| directory.join(format!("{}.part", file.name));
        let path = |file: &File| directory.join(&file.name);
        // All of them beside their places first: a disk that is full then leaves those as they are.
        let written = files
            .iter()
            .try_for_each(|file| fs::write(part(file), &file.text))
            .and_then(|()| files.iter().try_for_each(|file| fs::rename(part(file), path(file))));
        if written.is_err() {
            for file in &files {
                let _ = fs::remove_file(part(file));
            }
        }
        written.map(|()| files.iter().map(path).collect())
    }

    /// The claims for which there is no theorem, each with its reason.
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// The file of definitions.
    fn definitions(&self) -> String {
        let printer = Printer { registry: self.registry, preferred: &[] };
        let mut text = format!("(** * The functions, as their source computes them. *)\n{}", head(false, ""));
        for formula in self.registry.formulas() {
            let (name, body) = (print::function(formula), printer.body(formula));
            let binders = self.registry.common(formula).chain(formula.depends_on()).map(ascii);
            let binders = binders.collect::<Vec<_>>().join(" ");
            let _ = write!(
                text,
                "\nDefinition {name} ({binders} : R) : R :=\n  {body}.\n\
                 #[export] Hint Unfold {name} : functions.\n"
            );
        }
        text
    }
}

/// Ends a file with all that it proves as one, and says what that is called.
fn together(file: &mut File) -> String {
    let name = format!("proved_in_{}", file.name.trim_end_matches(".v").to_lowercase());
    let proved: Vec<_> = proved(&file.text).collect();
    let text = format!("\nDefinition {name} :=\n  ({}).\n", proved.join(",\n   "));
    file.text += &text;
    name
}

/// The names of the theorems and lemmas in a text.
fn proved(text: &str) -> impl Iterator<Item = &str> {
    let statement =
        |line: &'_ str| line.strip_prefix("Theorem ").or(line.strip_prefix("Lemma ")).map(str::len);
    text.lines().filter_map(move |line| {
        let rest = &line[line.len() - statement(line)?..];
        rest.split(|c| !is_part_of_name(c)).next()
    })
}

/// What Coq calls a claim: `eq_1_13_rate`, `theorem_1_3_3_contracts`.
pub fn theorem_name(equation: &str, name: &str) -> String {
    let number = if equation.starts_with(|c: char| c.is_ascii_digit()) { "eq " } else { "" };
    print::free(identifier(&format!("{number}{equation} {name}")))
}

fn file(name: &str, text: String) -> File {
    File { name: format!("{name}.v"), text: wrapped(&text) }
}

/// No line is longer than a reader likes; where it is broken means nothing to Coq.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 100;
    let mut all = String::new();
    for line in text.lines() {
        let mut rest = line.trim_start();
        let mut indent = line.len() - rest.len();
        let further = indent + 4;
        while indent + rest.len() > WIDTH {
            let Some(end) = rest[..=WIDTH - indent].rfind(' ') else { break };
            let _ = writeln!(all, "{:indent$}{}", "", &rest[..end]);
            (rest, indent) = (&rest[end + 1..], further);
        }
        let _ = writeln!(all, "{:indent$}{rest}", "");
    }
    all
}

fn is_part_of_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Words joined by single underscores, in lower case.
fn identifier(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("_")
}

/// A claim, printed: its lemmas, its theorem, all with their proofs.
#[derive(Clone, Debug)]
struct Written {
    section: String,
    /// Does it speak of what is rounded?
    rounds: bool,
    text: String,
}

/// The files of theorems, one or more a section.
fn by_section(written: &[Written]) -> Vec<File> {
    let mut sections: Vec<((&str, bool), Vec<&str>)> = Vec::new();
    for Written { section, rounds, text } in written {
        let own = (section.as_str(), *rounds);
        match sections.iter_mut().find(|(known, _)| *known == own) {
            Some((_, texts)) => texts.push(text),
            None => sections.push((own, vec![text])),
        }
    }
    let mut files = Vec::new();
    for ((section, rounds), texts) in sections {
        for (texts, part) in texts.chunks(PER_FILE).zip('a'..='z') {
            let section = section.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
            let laws = if rounds { "_rounding" } else { "" };
            files.push(file(
                &format!("C_{section}{laws}_{part}"),
                head(rounds, DEFINITIONS) + &texts.concat(),
            ));
        }
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files
}

/// What a file begins with that needs tactics, perhaps those for what is rounded, and this.
fn head(rounds: bool, more: &str) -> String {
    let import = |names: &str| format!("From LIBRARY Require Import {}.\n", names.trim_end());
    match rounds {
        true => format!(
            "From Flocq Require Import Core.\n{}Open Scope R_scope.\n",
            import(&format!("{TACTICS} {ROUNDING} {more}"))
        ),
        false => import(&format!("{TACTICS} {more}")),
    }
}

/// Few enough that files can be compiled side by side.
const PER_FILE: usize = 12;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{equal, limit};
    use crate::formula::{Hypothesis, Rate, Relation};
    use crate::number::{Exponential, Tree};

    /// Why a claim is left out, if it is; then there is no theorem.
    fn left_out(claim: &Statement) -> Option<String> {
        let registry = Registry::default();
        let development =
            Development::new("Lens", &registry, [Placed { claim, section: "0", functions: &[] }]);
        let theorems = development.files().iter().filter(|file| file.text.contains("\nTheorem ")).count();
        let [left_out] = development.left_out() else {
            assert_eq!((theorems, development.left_out().len()), (1, 0));
            return None;
        };
        assert_eq!((left_out.name, theorems), (claim.name(), 0));
        Some(left_out.reason.clone())
    }

    /// H is written h, so that (H − h)² = 0 would be a theorem about (h − h)².
    #[test]
    fn two_symbols_never_share_a_name() {
        let square = |names: [&'static str; 2]| {
            let [a, b] = names.map(|name| Tree::symbol(name));
            left_out(&equal("square", (&a - &b) * (&a - &b), (&b - &a) * (&b - &a)))
        };
        assert_eq!(square(["H", "h"]).unwrap(), "H and h have the same name in Coq");
        assert_eq!(square(["H", "c"]), None);
    }

    #[test]
    fn what_has_no_proof_to_follow_is_left_out() {
        let [a, t] = ["a", "t"].map(|name| Tree::symbol(name));
        let above = [&a, &t].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
        let vanishes = |of: Tree| {
            left_out(
                &limit("vanishes", &of, &t, 0, Rate::Exactly(of.clone())).assuming([&above[0], &above[1]]),
            )
        };
        let wrong = left_out(&equal("one", &a, 1)).unwrap();
        assert!(wrong.starts_with("there is no proof to follow: the sides differ by a"), "{wrong}");
        assert_eq!(vanishes((-&a * &t).exp()), None);
        // The kernel knows more of these than the lemmas that are at hand in Coq.
        let unlike = "an exponential is not that of a constant rate, or has a factor that grows";
        assert_eq!(vanishes(&t * (-&a * &t).exp()).unwrap(), unlike);
        assert_eq!(vanishes((-&a * &t * &t).exp()).unwrap(), unlike);
    }

    #[test]
    fn a_long_line_is_broken_where_there_is_a_blank() {
        let [short, full, long] = [94, 98, 101].map(|n| "a".repeat(n));
        let kept = format!("  {full}\n  {long}\n");
        assert_eq!(wrapped(&kept), kept);
        // What is broken off stands four to the right of its line.
        let broken = format!("  head\n      {short}\n      c\n      {long} d\n");
        assert_eq!(wrapped(&format!("  head {short} c {long} d")), broken);
    }
}

//! Export of functions and claims to the proof assistant Coq (now named Rocq), whose kernel checks them
//! independently.
//!
//! A [`Development`] contains each function of a registry as a definition, printed from its recorded formula,
//! and each claim as a theorem about these definitions with its hypotheses as premises. A program in Coq that
//! is proved correct there (`polynomials.v`, `quotients.v`) translates formulas into quotients of polynomials
//! and checks the certificates of their signs, like the [checker](super::check). Its input is the same proof.
//! None of this has to be trusted: if Coq accepts the files, it remains to trust Coq's kernel, its axioms of
//! the real numbers, and that definitions and theorems agree with their sources.
//!
//! A function that returns the result of another unchanged leaves no operation in a record, so theorems use
//! the names of the functions that their entry lists. A definition that no theorem uses would protect
//! nothing.
//!
//! Some statements are stronger than in our kernel: an induction is over the natural numbers, a limit is in
//! the sense of ε and N, and a derivative is a limit. Since division by 0 is defined in Coq, each claim has a
//! further lemma, `…_defined`, which states that no divisor is 0.
//!
//! Rounding is that of the library Flocq: to nearest, for every precision of at least two bits, with any rule
//! for ties. A lemma there proves the model x (1 + γ e) of our checker.

mod expr;
mod induction;
mod lemma;
mod print;
mod script;
mod theorem;

use crate::formula::{Registry, Statement};
use lemma::spaced;
use print::{Printer, ascii};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{fs, io};
use theorem::Claim;

/// A file of a development.
#[derive(Clone, Debug)]
pub struct File {
    /// File name, which ends in `.v`. A file requires only files whose names precede its own.
    pub name: String,
    /// Contents.
    pub text: String,
}

/// A claim that could not be exported.
#[derive(Clone, Debug)]
pub struct Omitted {
    /// Its entry.
    pub equation: &'static str,
    /// Its name.
    pub name: &'static str,
    /// The reason.
    pub reason: String,
}

/// A claim with its section and functions.
#[derive(Clone, Copy, Debug)]
pub struct LocatedClaim<'a> {
    /// The claim.
    pub claim: &'a Statement,
    /// Its section; claims of one section share files.
    pub section: &'a str,
    /// The functions that it concerns; the first of those that compute the same is named.
    pub functions: &'a [&'static str],
}

/// Definitions of the functions of a registry, and theorems about them.
#[derive(Clone, Debug)]
pub struct Development<'a> {
    library: &'a str,
    registry: &'a Registry,
    written: Vec<Written>,
    omitted: Vec<Omitted>,
    more: Option<(&'static str, &'static str)>,
}

const TACTICS: &str = "A_Tactics";
const DEFINITIONS: &str = "B_Definitions";
const ROUNDING: &str = "B_Rounding";
const ASSUMPTIONS: &str = "E_Assumptions";

/// Files that all theorems require, in order of dependency.
const PROGRAM: [(&str, &str); 3] = [
    ("A_Polynomials", include_str!("coq/polynomials.v")),
    ("A_Quotients", include_str!("coq/quotients.v")),
    (TACTICS, include_str!("coq/tactics.v")),
];

impl<'a> Development<'a> {
    /// Exports the claims. The files require each other from the `library`.
    pub fn new<'c>(
        library: &'a str,
        registry: &'a Registry,
        claims: impl IntoIterator<Item = LocatedClaim<'c>>,
    ) -> Self {
        let (mut written, mut omitted, mut names) = (Vec::new(), Vec::new(), BTreeSet::new());
        for LocatedClaim { claim, section, functions } in claims {
            let printer = Printer { registry, preferred: functions };
            let name = theorem_name(claim.equation(), claim.name());
            let text = match name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                false => Err(format!("its name in Coq, '{name}', does not begin with a letter")),
                true if !names.insert((section, name.clone())) => {
                    Err(format!("another claim is named {name} in Coq"))
                }
                true => Claim::new(claim, printer).text().map_err(|reason| reason.to_string()),
            };
            match text {
                Ok(text) => {
                    let (section, contains_rounding) = (section.to_string(), claim.contains_rounding());
                    written.push(Written { section, contains_rounding, text });
                }
                Err(reason) => {
                    omitted.push(Omitted { equation: claim.equation(), name: claim.name(), reason })
                }
            }
        }
        Development { library, registry, written, omitted, more: None }
    }

    /// Adds a handwritten file, which may require all others.
    pub fn with_file(self, name: &'static str, text: &'static str) -> Self {
        Development { more: Some((name, text)), ..self }
    }

    /// Returns all files: tactics, definitions, theorems by section, and their conjunctions.
    ///
    /// They compile in this order, which is also that of their names: `coqc -R DIR LIBRARY FILE`.
    pub fn files(&self) -> Vec<File> {
        let mut files: Vec<_> = PROGRAM.iter().map(|(name, text)| file(name, text.to_string())).collect();
        files.push(file(DEFINITIONS, self.definitions()));
        if self.written.iter().any(|written| written.contains_rounding) {
            files.push(file(ROUNDING, include_str!("coq/rounding.v").to_string()));
        }
        let mut theorems = by_section(&self.written);
        let names = theorems.iter().map(|file| file.name.trim_end_matches(".v"));
        let mut all = spaced(names);
        if let Some((name, text)) = self.more {
            let head = format!("From LIBRARY Require Import {TACTICS} {DEFINITIONS}{all}.\n\n");
            theorems.push(file(name, head + text));
            all = format!("{all} {name}");
        }
        // Printing the axioms of each theorem would take longer than all proofs.
        let parts: Vec<_> = theorems.iter_mut().map(conjunction).collect();
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
        files.into_iter().map(|file| self.with_library(file)).collect()
    }

    /// Returns the file with the name of the library.
    fn with_library(&self, File { name, text }: File) -> File {
        let from = format!("From {} Require", self.library);
        File { name, text: text.replace("From LIBRARY Require", &from) }
    }

    /// Writes the files to a directory, which is created if it does not exist.
    ///
    /// # Errors
    /// Returns the first error of the file system. No incomplete file remains, and an existing file is
    /// replaced only by a complete one.
    pub fn write(&self, directory: &Path) -> io::Result<Vec<PathBuf>> {
        fs::create_dir_all(directory)?;
        let files = self.files();
        let names = files.iter().map(|file| (directory.join(format!("{}.part", file.name)), &file.name));
        let (parts, paths): (Vec<_>, Vec<_>) = names.map(|(part, name)| (part, directory.join(name))).unzip();
        // All files are written under temporary names first, so that a full disk does not affect existing
        // files.
        let mut written = files.iter().zip(&parts).try_for_each(|(file, part)| fs::write(part, &file.text));
        written = written
            .and_then(|()| parts.iter().zip(&paths).try_for_each(|(part, path)| fs::rename(part, path)));
        if written.is_err() {
            for part in &parts {
                let _ = fs::remove_file(part);
            }
        }
        written.map(|()| paths)
    }

    /// Returns the claims without a theorem, with reasons.
    pub fn omitted(&self) -> &[Omitted] {
        &self.omitted
    }

    /// Returns the file of definitions.
    fn definitions(&self) -> String {
        let printer = Printer { registry: self.registry, preferred: &[] };
        let mut text =
            format!("(** * The functions, as their source computes them. *)\n{}", header(false, ""));
        for formula in self.registry.formulas() {
            let (name, body) = (print::function(formula), printer.body(formula));
            let binders = self.registry.common_symbols(formula).chain(formula.depends_on()).map(ascii);
            let binders = binders.collect::<Vec<_>>().join(" ");
            let binders = if binders.is_empty() { binders } else { format!("({binders} : R) ") };
            let _ = write!(
                text,
                "\nDefinition {name} {binders}: R :=\n  {body}.\n\
                 #[export] Hint Unfold {name} : functions.\n"
            );
        }
        text
    }
}

/// Appends the conjunction of all theorems to a file and returns its name.
fn conjunction(file: &mut File) -> String {
    let name = format!("proved_in_{}", file.name.trim_end_matches(".v").to_lowercase());
    let proved: Vec<_> = theorem_names(&file.text).collect();
    let text = format!("\nDefinition {name} :=\n  ({}).\n", proved.join(",\n   "));
    file.text += &text;
    name
}

/// Returns the names of the theorems and lemmas in a text.
fn theorem_names(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let statement = line.strip_prefix("Theorem ").or(line.strip_prefix("Lemma "))?;
        statement.split(|c| !is_part_of_name(c)).next()
    })
}

/// Returns the name of a claim in Coq: `eq_1_13_rate`, `theorem_1_3_3_contracts`.
pub fn theorem_name(equation: &str, name: &str) -> String {
    let number = if equation.starts_with(|c: char| c.is_ascii_digit()) { "eq " } else { "" };
    print::free(identifier(&format!("{number}{equation} {name}")))
}

fn file(name: &str, text: String) -> File {
    File { name: format!("{name}.v"), text: wrapped(&text) }
}

/// Breaks long lines; Coq ignores line breaks.
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

/// Joins words by single underscores, in lower case.
fn identifier(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("_")
}

/// An exported claim: its lemmas and its theorem with their proofs.
#[derive(Clone, Debug)]
struct Written {
    section: String,
    /// Whether it contains roundings.
    contains_rounding: bool,
    text: String,
}

/// Returns the files of theorems, one or more for each section.
fn by_section(written: &[Written]) -> Vec<File> {
    let mut sections: Vec<((&str, bool), Vec<&str>)> = Vec::new();
    for Written { section, contains_rounding, text } in written {
        let key = (section.as_str(), *contains_rounding);
        match sections.iter_mut().find(|(known, _)| *known == key) {
            Some((_, texts)) => texts.push(text),
            None => sections.push((key, vec![text])),
        }
    }
    let mut files = Vec::new();
    for ((section, contains_rounding), texts) in sections {
        for (texts, part) in texts.chunks(PER_FILE).zip('a'..='z') {
            let section = section.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
            let laws = if contains_rounding { "_rounding" } else { "" };
            files.push(file(
                &format!("C_{section}{laws}_{part}"),
                header(contains_rounding, DEFINITIONS) + &texts.concat(),
            ));
        }
    }
    files.sort_by(|a, b| a.name.cmp(&b.name));
    files
}

/// Returns the header of a file, which requires tactics, those for rounding if needed, and `more`.
fn header(contains_rounding: bool, more: &str) -> String {
    let names =
        if contains_rounding { [TACTICS, ROUNDING, more].join(" ") } else { [TACTICS, more].join(" ") };
    let import = format!("From LIBRARY Require Import {}.\n", names.trim_end());
    match contains_rounding {
        true => format!("From Flocq Require Import Core.\n{import}Open Scope R_scope.\n"),
        false => import,
    }
}

/// Number of claims per file, small enough for compiling in parallel.
const PER_FILE: usize = 12;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{equal, limit};
    use crate::formula::{Hypothesis, Rate, Relation};
    use crate::number::{Exponential, Tree};

    /// Returns the reason why a claim is omitted and has no theorem.
    fn left_out(claim: &Statement) -> Option<String> {
        let registry = Registry::default();
        let development =
            Development::new("Lens", &registry, [LocatedClaim { claim, section: "0", functions: &[] }]);
        let theorems = development.files().iter().filter(|file| file.text.contains("\nTheorem ")).count();
        let [left_out] = development.omitted() else {
            assert_eq!((theorems, development.omitted().len()), (1, 0));
            return None;
        };
        assert_eq!((left_out.name, theorems), (claim.name(), 0));
        Some(left_out.reason.clone())
    }

    /// If H were written h, (H − h)² = 0 would become a theorem about (h − h)².
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
    fn every_theorem_has_a_name_of_its_own() {
        let claims = ["a-b", "a_b", "2nd", ""].map(|name| equal(name, Tree::from(1), Tree::from(1)));
        let located = claims.iter().map(|claim| LocatedClaim { claim, section: "0", functions: &[] });
        let registry = Registry::default();
        let development = Development::new("Names", &registry, located);
        let reasons: Vec<_> = development.omitted().iter().map(|claim| &*claim.reason).collect();
        assert_eq!(reasons[0], "another claim is named a_b in Coq");
        assert_eq!(reasons[1], "its name in Coq, '2nd', does not begin with a letter");
        assert_eq!(reasons[2], "its name in Coq, '', does not begin with a letter");
    }

    #[test]
    fn claims_without_a_usable_derivation_are_omitted() {
        let [a, t] = ["a", "t"].map(|name| Tree::symbol(name));
        let above = [&a, &t].map(|x| Hypothesis::new(Relation::Positive, x.clone()));
        let vanishes = |of: Tree| {
            left_out(&limit("vanishes", &of, &t, 0, Rate::Equal(of.clone())).assuming([&above[0], &above[1]]))
        };
        let computed = limit("computed", &a / &t, &t, 0, Rate::Equal(&a / &t))
            .assuming([&above[1], &Hypothesis::between(&a, 0, 1)])
            .computing(&a, Tree::from(1));
        assert_eq!(left_out(&computed).unwrap(), "a computed quantity among several goals");
        let wrong = left_out(&equal("one", &a, 1)).unwrap();
        assert!(wrong.starts_with("no proof to follow: the sides differ by a"), "{wrong}");
        assert_eq!(vanishes((-&a * &t).exp()), None);
        // The kernel proves some claims about exponentials for which no lemma is available in Coq.
        let unlike = "an exponential is not that of a constant rate, or has a factor that grows";
        assert_eq!(vanishes(&t * (-&a * &t).exp()).unwrap(), unlike);
        assert_eq!(vanishes((-&a * &t * &t).exp()).unwrap(), unlike);
        let once = (-&a * &t).exp();
        assert_eq!(vanishes(&once * &once).unwrap(), unlike);
        let later = |bound: Tree| {
            let bound = Hypothesis::new(Relation::Positive, bound);
            left_out(&limit("later", &a / &t, &t, 0, Rate::Equal(&a / &t)).assuming([&above[0], &bound]))
        };
        assert_eq!(later(&t - &a), None);
        let other = "the variable of a limit has other hypotheses than lower bounds";
        assert_eq!(later(&a * &t - Tree::from(1)).unwrap(), other);
    }

    #[test]
    fn long_lines_are_broken_at_blanks() {
        let [short, full, long] = [94, 98, 101].map(|n| "a".repeat(n));
        let kept = format!("  {full}\n  {long}\n");
        assert_eq!(wrapped(&kept), kept);
        // A continuation line is indented by four more characters.
        let broken = format!("  head\n      {short}\n      c\n      {long} d\n");
        assert_eq!(wrapped(&format!("  head {short} c {long} d")), broken);
    }
}

//! Export of functions and claims to the proof assistant Coq (now named Rocq), whose kernel checks them
//! independently.
//!
//! A [`Development`] contains each function of a registry as a definition, printed from its recorded formula,
//! and each claim as a theorem about these definitions with its hypotheses as premises. A program in Coq that
//! is proved correct there (`polynomials.v`, `powers.v`, `quotients.v`) translates formulas into quotients of polynomials
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

use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Registry, Statement};
use lemma::{binders, spaced};
use print::{Printer, ascii};
use std::collections::{BTreeMap, BTreeSet};
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
    /// The claims by section, and by whether they contain roundings.
    written: BTreeMap<(String, bool), Vec<String>>,
    omitted: Vec<Omitted>,
    more: Option<(&'static str, &'static str)>,
}

const TACTICS: &str = "A_Tactics";
const DEFINITIONS: &str = "B_Definitions";
const ROUNDING: &str = "B_Rounding";
const ASSUMPTIONS: &str = "E_Assumptions";
/// Number of claims per file, small enough for compiling in parallel.
const PER_FILE: usize = 12;

/// Files that all theorems require, in order of dependency.
const PROGRAM: [(&str, &str); 4] = [
    ("A_Polynomials", include_str!("coq/polynomials.v")),
    ("A_Powers", include_str!("coq/powers.v")),
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
        let (mut written, mut omitted, mut names) = (BTreeMap::new(), Vec::new(), BTreeSet::new());
        for LocatedClaim { claim, section, functions } in claims {
            let name = theorem_name(claim.equation(), claim.name());
            let text = if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
                Err(format!("its name in Coq, '{name}', does not begin with a letter").into())
            } else if !names.insert((section, name.clone())) {
                Err(format!("another claim is named {name} in Coq").into())
            } else {
                Claim { printer: Printer { registry, preferred: functions }, statement: claim, name }.text()
            };
            let key = (section.replace(|c: char| !c.is_ascii_alphanumeric(), "_"), claim.contains_rounding());
            match text {
                Ok(text) => written.entry(key).or_insert(Vec::new()).push(text),
                Err(reason) => {
                    let (equation, name, reason) = (claim.equation(), claim.name(), reason.to_string());
                    omitted.push(Omitted { equation, name, reason });
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
        if self.written.keys().any(|(_, contains_rounding)| *contains_rounding) {
            files.push(file(ROUNDING, include_str!("coq/rounding.v").to_string()));
        }
        let mut theorems = self.theorems();
        let mut required = format!("From LIBRARY Require Import {TACTICS} {DEFINITIONS}");
        required += &spaced(theorems.iter().map(|file| file.name.trim_end_matches(".v").to_string()));
        if let Some((name, text)) = self.more {
            theorems.push(file(name, format!("{required}.\n\n{text}")));
            required += &format!(" {name}");
        }
        // Printing the axioms of each theorem would take longer than all proofs.
        let parts: Vec<_> = theorems.iter_mut().map(conjunction).collect();
        files.extend(theorems);
        if !parts.is_empty() {
            let assumptions = format!(
                "(** * What everything rests on. *)\n{required}.\n\n\
                 Definition everything :=\n  ({}).\nPrint Assumptions everything.\n",
                parts.join(",\n   ")
            );
            files.push(file(ASSUMPTIONS, assumptions));
        }
        let from = format!("From {} Require", self.library);
        files.iter_mut().for_each(|file| file.text = file.text.replace("From LIBRARY Require", &from));
        files
    }

    /// Returns the files of theorems, one or more for each section. Those about rounding are for any precision and any
    /// rule for ties.
    fn theorems(&self) -> Vec<File> {
        let (two_p, scales) = (ascii(PRECISION), SCALES.map(ascii));
        let powers = scales.iter().zip(1..).map(|(scale, i)| format!("(A{i} : is_power {scale})"));
        let (powers, scales) = (spaced(powers), scales.join(" "));
        let section = format!(
            "From Flocq Require Import Core.\nFrom LIBRARY Require Import {TACTICS} {ROUNDING} {DEFINITIONS}.\n\
             Open Scope R_scope.\n\nSection Rounding.\n\
             Variables (prec : Z) (choice : Z -> bool) ({two_p} {scales} : R).\n\
             Variables (P : (2 <= prec)%Z) (E : {two_p} = bpow radix2 prec){powers}.\n"
        );
        let exact = format!("From LIBRARY Require Import {TACTICS} {DEFINITIONS}.\n");
        let mut files = Vec::new();
        for ((section_name, contains_rounding), texts) in &self.written {
            let (kind, head, end) = match contains_rounding {
                true => ("_rounding", &section, "\nEnd Rounding.\n"),
                false => ("", &exact, ""),
            };
            for (texts, part) in texts.chunks(PER_FILE).zip('a'..='z') {
                let name = format!("C_{section_name}{kind}_{part}");
                files.push(file(&name, format!("{head}{}{end}", texts.concat())));
            }
        }
        files.sort_by(|a, b| a.name.cmp(&b.name));
        files
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
        let paths: Vec<_> = names.map(|(part, name)| (part, directory.join(name))).collect();
        // All files are written under temporary names first, so that a full disk does not affect existing
        // files.
        let mut written =
            files.iter().zip(&paths).try_for_each(|(file, (part, _))| fs::write(part, &file.text));
        written = written.and_then(|()| paths.iter().try_for_each(|(part, path)| fs::rename(part, path)));
        if written.is_err() {
            for (part, _) in &paths {
                let _ = fs::remove_file(part);
            }
        }
        written.map(|()| paths.into_iter().map(|(_, path)| path).collect())
    }

    /// Returns the claims without a theorem, with reasons.
    pub fn omitted(&self) -> &[Omitted] {
        &self.omitted
    }

    /// Returns the file of definitions.
    fn definitions(&self) -> String {
        let printer = Printer { registry: self.registry, preferred: &[] };
        let definitions = self.registry.formulas().iter().map(|formula| {
            let (name, body) = (print::function(formula), printer.body(formula));
            let binders = binders(self.registry.common_symbols(formula).chain(formula.depends_on()));
            format!(
                "\nDefinition {name}{binders} : R :=\n  {body}.\n\
                 #[export] Hint Unfold {name} : functions.\n"
            )
        });
        let head = "(** * The functions, as their source computes them. *)\nFrom LIBRARY Require Import";
        format!("{head} {TACTICS}.\n{}", definitions.collect::<String>())
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
    File { name: format!("{name}.v"), text }
}

fn is_part_of_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

/// Joins words by single underscores, in lower case.
fn identifier(text: &str) -> String {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("_")
}

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
        let later = |bound: Tree| {
            let bound = Hypothesis::new(Relation::Positive, bound);
            left_out(&limit("later", &a / &t, &t, 0, Rate::Equal(&a / &t)).assuming([&above[0], &bound]))
        };
        let open = later(&a - &t).unwrap();
        assert!(open.starts_with("no proof to follow"), "{open}");
    }
}

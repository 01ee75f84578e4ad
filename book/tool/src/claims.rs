//! Status of the claims: a line in the box of each equation, and a page of all claims.
//!
//! Claims are proved and tested when the book is built; no status is written by hand, and an open claim stops the build.

use crate::places::Places;
use crate::proofs::{SECTIONS, format_hypotheses, heading, heading_of};
use anyhow::{Result, ensure};
use regex::{Captures, Regex};
use spring_mass_contact::{
    claims::{Entry, entries, registry},
    number::NumberSystem,
    proof::render::ProofPrinter,
    verify::{ClaimResult, Options, Status, experiments, verify},
};
use std::{fmt::Write, sync::LazyLock};

/// Number of cases on which each claim is tested; `contact verify` uses more.
const CASES: u64 = 50;

/// Results of all claims.
pub struct Claims {
    rows: Vec<ClaimResult>,
}

impl Claims {
    /// Proves and tests all claims on the first call, and returns the stored results afterwards.
    ///
    /// # Errors
    /// Returns an error if a claim is not proved, fails or is undecided.
    pub fn run() -> Result<&'static Self> {
        static CLAIMS: LazyLock<Claims> = LazyLock::new(|| Claims {
            rows: verify(&Options { cases: CASES, ..Options::default() }, &|_, _| ()).rows,
        });
        let open = CLAIMS.rows.iter().filter(|row| !matches!(row.status, Status::Proved | Status::Held));
        let open: Vec<_> = open.map(|row| format!("{} of {}", row.claim, row.equation)).collect();
        ensure!(open.is_empty(), "these claims are open, see `contact verify`: {}", open.join(", "));
        Ok(&CLAIMS)
    }

    /// Returns the status line of an equation in Markdown; `up` is the relative path to the root of the book.
    pub fn status(&self, entry: &Entry, up: &str) -> String {
        let rows = self.rows(entry);
        let (count, all) = (claim_count(entry), rows.chunk_by(|a, b| a.claim == b.claim).count());
        let tested = match all - entry.claims.len() {
            0 => String::new(),
            tested => format!(", and {tested} only tested"),
        };
        // Tested claims are not counted here; the page of claims lists the number systems in which they hold.
        let held = held_in(&rows, |scalar| {
            let names = rows.iter().filter(|row| row.scalar == Some(scalar)).map(|row| row.claim);
            let held = names.filter(|name| entry.claims.iter().any(|claim| claim.name() == *name)).count();
            (held < entry.claims.len()).then(|| format!("{held} of {count}"))
        });
        let (proofs, claims) = (proofs(entry, &heading(entry)), anchor(entry));
        format!(
            "<div class=\"status\">\n\nproved: [{count}]({up}{proofs}){tested} · {held} · \
             [claims]({up}claims.md#{claims})\n\n</div>"
        )
    }

    /// Returns the results of the claims about an entry.
    fn rows(&self, entry: &Entry) -> Vec<&ClaimResult> {
        self.rows.iter().filter(|row| row.equation == entry.equation).collect()
    }

    /// Returns the page of all claims in Markdown, with links to the entries in the book.
    pub fn page(&self, places: &Places) -> String {
        let mut text = String::new();
        for (section, title) in SECTIONS {
            let _ = write!(text, "\n\n## {title}\n");
            let of_section = entries().iter().filter(|entry| entry.section == section);
            let rows = of_section.map(|entry| (entry, self.rows(entry)));
            for (entry, rows) in rows.filter(|(_, rows)| !rows.is_empty()) {
                let (heading, anchor) = (heading(entry), anchor(entry));
                let statement = with_indices(&entry.statement());
                let _ = write!(text, "\n### {heading} {{#{anchor}}}\n\n{statement}.");
                if let Ok(place) = places.get(entry.equation) {
                    let _ = write!(text, " [In the book]({place}).");
                }
                text += "\n\n";
                rows.chunk_by(|a, b| a.claim == b.claim).for_each(|rows| text += &item(entry, rows));
            }
        }
        text
    }
}

/// Renders a claim with its results.
fn item(entry: &Entry, rows: &[&ClaimResult]) -> String {
    let ClaimResult { claim: name, kind, .. } = rows[0];
    let recorded = entry.claims.iter().find(|claim| claim.name() == *name);
    let (statement, hypotheses, proved) = match recorded {
        Some(claim) => {
            let proved = format!("[proved]({})", proofs(entry, &heading_of(entry, name)));
            (format!("`{}`", ProofPrinter::new(registry()).claim(claim)), format_hypotheses(claim), proved)
        }
        None => {
            let all = experiments::<f64>();
            let tested = all.iter().find(|it| (it.equation, it.name) == (entry.equation, *name));
            let tested = tested.expect("a claim without a proof is tested");
            let statement = with_indices(tested.statement.expect("a statement in words"));
            (statement, registry().format_hypotheses(&tested.hypotheses), "tested, not proved".into())
        }
    };
    let conditions =
        if hypotheses.is_empty() { String::new() } else { format!("\\\n  if `{}`", hypotheses.join("`, `")) };
    let held = held_in(rows, |scalar| {
        let row = rows.iter().find(|row| row.scalar == Some(scalar))?;
        (row.decided < CASES).then(|| row.decided.to_string())
    });
    format!(
        "- **{name}** ({kind})\\\n  {statement}{conditions}\\\n  <span class=\"status\">{proved} · {held}</span>\n"
    )
}

/// Returns `1 claim`, `2 claims`, and so on: the number of proved claims about an entry.
pub fn claim_count(entry: &Entry) -> String {
    match entry.claims.len() {
        1 => "1 claim".into(),
        count => format!("{count} claims"),
    }
}

/// Returns the number systems in which claims hold; `part` returns the text in parentheses after a number system in
/// which only some claims or cases were decided.
fn held_in(rows: &[&ClaimResult], part: impl Fn(NumberSystem) -> Option<String>) -> String {
    let scalars = Options::default().scalars.into_iter();
    let held = scalars.filter(|scalar| rows.iter().any(|row| row.scalar == Some(*scalar))).map(|scalar| {
        let name = match scalar {
            NumberSystem::Mpfr(bits) => format!("{bits} bits"),
            NumberSystem::Exact => "rationals".into(),
            float => float.to_string(),
        };
        part(scalar).map_or(name.clone(), |part| format!("{name} ({part})"))
    });
    format!("held in {}", held.collect::<Vec<_>>().join(", "))
}

/// Returns the name of an entry in addresses: `1-13`, `note-3`, `theorem-1-3-3`.
pub fn slug(entry: &Entry) -> String {
    entry.equation.to_lowercase().replace(". ", "-").replace(['.', ' '], "-")
}

/// Typesets the indices and exponents of a statement as HTML: `u_{k+1}` becomes `u<sub>k+1</sub>`.
pub fn with_indices(statement: &str) -> String {
    static INDEX: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"([_^])(?:\{([^}]*)\}|(\w+))").unwrap());
    let small = |index: &Captures| {
        let element = if &index[1] == "_" { "sub" } else { "sup" };
        let content = index.get(2).or(index.get(3)).map_or("", |content| content.as_str());
        format!("<{element}>{content}</{element}>")
    };
    INDEX.replace_all(statement, small).into_owned()
}

/// Returns the anchor of an entry on the page of claims.
pub fn anchor(entry: &Entry) -> String {
    format!("claims-{}", slug(entry))
}

/// Returns the link to a heading on the page with the proofs of an entry.
fn proofs(entry: &Entry, heading: &str) -> String {
    format!("proofs/{}.md#{}", entry.section, id(heading))
}

/// Returns the anchor that mdBook generates for a heading.
fn id(heading: &str) -> String {
    let letter = |c: char| match c {
        c if c.is_alphanumeric() || c == '_' || c == '-' => Some(c),
        c => c.is_whitespace().then_some('-'),
    };
    heading.to_lowercase().chars().filter_map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_small() {
        let statement = "λ_{k+1} = ρ^{k+1} λ₀ and u_nh, u_k − H";
        let set = "λ<sub>k+1</sub> = ρ<sup>k+1</sup> λ₀ and u<sub>nh</sub>, u<sub>k</sub> − H";
        assert_eq!(with_indices(statement), set);
    }

    #[test]
    fn page_states_number_of_cases() {
        assert!(include_str!("../../src/claims.md").contains(" for fifty random systems") && CASES == 50);
    }
}

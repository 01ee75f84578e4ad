//! Status of the claims: a line in the box of each equation, and a page of all claims.
//!
//! Claims are proved and tested when the book is built; no status is written by hand.

use crate::places::Places;
use crate::proofs::{SECTIONS, heading, heading_of};
use regex::{Captures, Regex};
use spring_mass_contact::{
    claims::{Entry, claims, entry, registry},
    formula::Hypothesis,
    number::NumberSystem,
    proof::render::ProofPrinter,
    verify::{ClaimResult, Options, Status, experiments, verify},
};
use std::{collections::HashMap, fmt::Write, sync::LazyLock};

/// Number of cases on which each claim is tested; `contact verify` uses more.
const CASES: u64 = 50;

/// Results of all claims.
pub struct Claims {
    rows: Vec<ClaimResult>,
}

impl Claims {
    /// Proves and tests all claims on the first call, and returns the stored results afterwards.
    pub fn run() -> &'static Self {
        static CLAIMS: LazyLock<Claims> = LazyLock::new(|| Claims {
            rows: verify(&Options { cases: CASES, ..Options::default() }, &|_, _| ()).rows,
        });
        &CLAIMS
    }

    /// Returns the status line of an equation in Markdown; `up` is the relative path to the root of the book.
    pub fn status(&self, entry: &Entry, up: &str) -> String {
        let rows = self.rows(entry);
        let claims = rows.chunk_by(|a, b| a.claim == b.claim);
        let (proved, tested): (Vec<_>, Vec<_>) = claims.partition(|rows| rows[0].scalar.is_none());
        let count = claim_count(proved.len());
        let mut summary = format!("proved: [{count}]({up}{})", proofs(entry));
        if !tested.is_empty() {
            let _ = write!(summary, ", and {} only tested", tested.len());
        }
        // Tested claims are not counted here; the page of claims lists the number systems in which they hold.
        let fraction = |scalar| {
            let held = |row: &&ClaimResult| row.scalar == scalar && row.status == Status::Held;
            let held = proved.iter().filter(|rows| rows.iter().any(held)).count();
            (held < proved.len()).then(|| format!("{held} of {count}"))
        };
        let link = format!("[claims]({up}claims.md#{})", anchor(entry));
        format!("<div class=\"status\">\n\n{} · {link}\n\n</div>", outcome(&rows, &summary, fraction))
    }

    /// Returns the number of proved claims, and the open ones, in HTML.
    pub fn summary(&self, entry: &Entry) -> String {
        let rows = self.rows(entry);
        let proved = rows.iter().filter(|row| row.scalar.is_none() && row.status == Status::Proved).count();
        let parts = [format!("{} proved", claim_count(proved)), "source".into()];
        parts.into_iter().chain(open_claims(&rows)).collect::<Vec<_>>().join(" · ")
    }

    /// Returns the results of the claims about an entry.
    fn rows(&self, entry: &Entry) -> Vec<&ClaimResult> {
        self.rows.iter().filter(|row| row.equation == entry.equation).collect()
    }

    /// Returns the page of all claims in Markdown, with links to the entries in the book.
    pub fn page(&self, places: &Places) -> String {
        let texts = claim_texts();
        let mut text = String::new();
        let by_entry: Vec<_> = self.rows.chunk_by(|a, b| a.equation == b.equation).collect();
        for (section, title) in SECTIONS {
            let _ = write!(text, "\n\n## {title}\n");
            let of_section = by_entry.iter().filter_map(|rows| Some((entry(rows[0].equation)?, rows)));
            for (entry, rows) in of_section.filter(|(entry, _)| entry.section == section) {
                let _ = write!(
                    text,
                    "\n### {} {{#{}}}\n\n{}.",
                    heading(entry),
                    anchor(entry),
                    with_indices(&entry.statement())
                );
                if let Some(place) = places.entry(entry) {
                    let _ = write!(text, " [In the book]({place}).");
                }
                text += "\n\n";
                for rows in rows.chunk_by(|a, b| a.claim == b.claim) {
                    let rows: Vec<_> = rows.iter().collect();
                    let (kind, name) = (rows[0].kind, rows[0].claim);
                    let (statement, hypotheses) = &texts[&(entry.equation, name)];
                    let _ = write!(text, "- **{name}** ({kind})\\\n  {statement}");
                    if !hypotheses.is_empty() {
                        let _ = write!(text, "\\\n  if `{}`", hypotheses.join("`, `"));
                    }
                    let decided = |scalar| {
                        let row = rows.iter().find(|row| row.scalar == scalar)?;
                        (row.decided < CASES).then(|| row.decided.to_string())
                    };
                    let status = outcome(&rows, &format!("[proved]({})", proof(entry, name)), decided);
                    let _ = writeln!(text, "\\\n  <span class=\"status\">{status}</span>");
                }
            }
        }
        text
    }
}

/// Statement of a claim in Markdown and its hypotheses.
type ClaimText = (String, Vec<String>);

/// Returns the texts of all claims by equation number and claim name.
fn claim_texts() -> HashMap<(&'static str, &'static str), ClaimText> {
    let format = |hypotheses: &[Hypothesis]| registry().format_hypotheses(hypotheses);
    let tested = experiments::<f64>()
        .into_iter()
        .filter_map(|e| Some(((e.equation, e.name), (with_indices(e.statement?), format(&e.hypotheses)))));
    let recorded = claims().map(|claim| {
        // Invariants are part of the proof and not hypotheses of the claim.
        let hypotheses = claim.stated_hypotheses().iter().filter(|h| claim.hypotheses().contains(h));
        let hypotheses: Vec<_> = hypotheses.cloned().collect();
        let text = ProofPrinter::new(registry()).claim(claim);
        ((claim.equation(), claim.name()), (format!("`{text}`"), format(&hypotheses)))
    });
    tested.chain(recorded).collect()
}

/// Returns `1 claim`, `2 claims`, and so on.
fn claim_count(count: usize) -> String {
    if count == 1 { "1 claim".into() } else { format!("{count} claims") }
}

/// Returns the claims with a status in a number system, or in the proofs.
fn with_status<'r>(rows: &[&'r ClaimResult], scalar: Option<NumberSystem>, status: Status) -> Vec<&'r str> {
    let found = rows.iter().filter(|row| row.scalar == scalar && row.status == status);
    found.map(|row| row.claim).collect()
}

/// Returns the claims that fail or are undecided, by name and marked as open: those that are not proved, then those
/// in each number system.
fn open_claims(rows: &[&ClaimResult]) -> Vec<String> {
    let mut found = vec![("not proved".to_string(), with_status(rows, None, Status::Failed))];
    for scalar in Options::default().scalars {
        for (problem, status) in [("wrong", Status::Failed), ("undecided", Status::Undecided)] {
            let problem = format!("{problem} in {}", display_name(scalar));
            found.push((problem, with_status(rows, Some(scalar), status)));
        }
    }
    let open = found.into_iter().filter(|(_, claims)| !claims.is_empty());
    let mark = |(problem, claims): (String, Vec<&str>)| {
        format!("<strong class=\"open\">{problem}: {}</strong>", claims.join(", "))
    };
    open.map(mark).collect()
}

/// Returns the status of claims: `proved` if they are proved, the [open claims](open_claims), and the number systems
/// in which they hold.
///
/// `part` returns the text in parentheses after a number system in which only some claims or cases were decided.
fn outcome(
    rows: &[&ClaimResult],
    proved: &str,
    part: impl Fn(Option<NumberSystem>) -> Option<String>,
) -> String {
    let has = |scalar, status| !with_status(rows, scalar, status).is_empty();
    let mut parts = Vec::new();
    if !has(None, Status::Failed) {
        let is_proved = rows.iter().any(|row| row.scalar.is_none());
        parts.push(if is_proved { proved.into() } else { "tested, not proved".into() });
    }
    parts.extend(open_claims(rows));
    let mut held = Vec::new();
    for scalar in Options::default().scalars {
        let has = |status| has(Some(scalar), status);
        if has(Status::Held) && !has(Status::Failed) && !has(Status::Undecided) {
            let name = display_name(scalar);
            held.push(match part(Some(scalar)) {
                Some(part) => format!("{name} ({part})"),
                None => name,
            });
        }
    }
    if !held.is_empty() {
        parts.push(format!("held in {}", held.join(", ")));
    }
    parts.join(" · ")
}

/// Returns the name of a number system in the book.
fn display_name(scalar: NumberSystem) -> String {
    match scalar {
        NumberSystem::Mpfr(bits) => format!("{bits} bits"),
        NumberSystem::Exact => "rationals".into(),
        float => float.to_string(),
    }
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

/// Returns the link to the proofs of an entry.
pub fn proofs(entry: &Entry) -> String {
    format!("proofs/{}.md#{}", entry.section, id(&heading(entry)))
}

/// Returns the link to the proof of a claim.
fn proof(entry: &Entry, claim: &str) -> String {
    format!("proofs/{}.md#{}", entry.section, id(&heading_of(entry, claim)))
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

    /// All cases are decided.
    fn all(_: Option<NumberSystem>) -> Option<String> {
        None
    }

    #[test]
    fn indices_are_small() {
        let statement = "λ_{k+1} = ρ^{k+1} λ₀ and u_nh, u_k − H";
        let set = "λ<sub>k+1</sub> = ρ<sup>k+1</sup> λ₀ and u<sub>nh</sub>, u<sub>k</sub> − H";
        assert_eq!(with_indices(statement), set);
    }

    /// Returns a row of the first claim about (1.13).
    fn row(scalar: Option<NumberSystem>, status: Status) -> ClaimResult {
        ClaimResult {
            equation: "1.13",
            claim: "rate",
            kind: "equal",
            status,
            scalar,
            reason: None,
            decided: 1,
            undecided: 0,
            worst: None,
            counterexample: None,
        }
    }

    #[test]
    fn outcome_lists_proof_and_number_systems() {
        let rows = [row(None, Status::Proved), row(Some(NumberSystem::F32), Status::Held)];
        assert_eq!(outcome(&rows.each_ref(), "proved", all), "proved · held in f32");
    }

    #[test]
    fn tested_claim_is_not_called_proved() {
        let rows = [row(Some(NumberSystem::Exact), Status::Held)];
        assert_eq!(outcome(&rows.each_ref(), "proved", all), "tested, not proved · held in rationals");
    }

    #[test]
    fn status_counts_claims_held_per_number_system() {
        let [f64, exact] = [NumberSystem::F64, NumberSystem::Exact].map(Some);
        let limit = |scalar, status| ClaimResult { claim: "limit", ..row(scalar, status) };
        let sign = |scalar| ClaimResult { claim: "sign", ..row(scalar, Status::Held) };
        let rows = vec![
            row(None, Status::Proved),
            row(f64, Status::Held),
            row(exact, Status::Held),
            limit(None, Status::Proved),
            limit(f64, Status::Held),
            sign(exact),
        ];
        let status = Claims { rows }.status(entry("1.13").unwrap(), "");
        assert!(status.contains("proved: [2 claims]("), "{status}");
        assert!(
            status.contains("), and 1 only tested · held in f64, rationals (1 of 2 claims) · "),
            "{status}"
        );
    }

    #[test]
    fn page_states_number_of_cases() {
        let page = include_str!("../../src/claims.md");
        assert!(page.contains(" for fifty random systems") && CASES == 50);
        let few = |_| Some("45".to_string());
        let rows = [row(None, Status::Proved), row(Some(NumberSystem::F32), Status::Held)];
        assert_eq!(outcome(&rows.each_ref(), "proved", few), "proved · held in f32 (45)");
    }

    #[test]
    fn open_claims_are_listed() {
        let rows = [row(None, Status::Failed), row(Some(NumberSystem::Mpfr(256)), Status::Held)];
        let status = outcome(&rows.each_ref(), "proved", all);
        assert_eq!(status, "<strong class=\"open\">not proved: rate</strong> · held in 256 bits");
        let rows = [row(None, Status::Proved), ClaimResult { claim: "limit", ..row(None, Status::Failed) }];
        assert_eq!(
            outcome(&rows.each_ref(), "proved", all),
            "<strong class=\"open\">not proved: limit</strong>"
        );
        let f64 = Some(NumberSystem::F64);
        let rows = [row(None, Status::Proved), row(f64, Status::Failed), row(f64, Status::Held)];
        let status = outcome(&rows.each_ref(), "proved", all);
        assert_eq!(status, "proved · <strong class=\"open\">wrong in f64: rate</strong>");
        let rows = [row(None, Status::Proved), row(f64, Status::Undecided), row(f64, Status::Held)];
        let status = outcome(&rows.each_ref(), "proved", all);
        assert_eq!(status, "proved · <strong class=\"open\">undecided in f64: rate</strong>");
    }
}

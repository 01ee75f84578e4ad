//! What is claimed of an equation and what came of it: a line in its box, and a page of all.
//!
//! Nothing of that is written by hand: the claims are proved and tried when the book is built.

use crate::places::Places;
use crate::proofs::{SECTIONS, heading, heading_of};
use regex::{Captures, Regex};
use spring_mass_contact::{
    claims::{Entry, claims, entry, registry},
    formula::Hypothesis,
    number::NumberSystem,
    proof::paper::Paper,
    verify::{Options, Row, Status, exact_experiments, float_experiments, verify},
};
use std::{collections::HashMap, fmt::Write, sync::LazyLock};

/// A claim is tried on so many cases. `contact verify` tries more.
const CASES: u64 = 50;

/// What came of all claims.
pub struct Claims {
    rows: Vec<Row>,
}

impl Claims {
    /// Proves and tries all of them, the first time it is called.
    pub fn run() -> &'static Self {
        static CLAIMS: LazyLock<Claims> = LazyLock::new(|| Claims {
            rows: verify(&Options { cases: CASES, ..Options::default() }, &|_, _| ()).rows,
        });
        &CLAIMS
    }

    /// The line that says what came of an equation's claims, in Markdown; `up` leads to the root of the book.
    pub fn status(&self, entry: &Entry, up: &str) -> String {
        let rows: Vec<_> = self.rows.iter().filter(|row| row.equation == entry.equation).collect();
        let claims = rows.chunk_by(|a, b| a.claim == b.claim);
        let (proved, tried): (Vec<_>, Vec<_>) = claims.partition(|rows| rows[0].scalar.is_none());
        let count = match proved.len() {
            1 => "1 claim".into(),
            count => format!("{count} claims"),
        };
        let mut known = format!("proved: [{count}]({up}{})", proofs(entry));
        if !tried.is_empty() {
            let _ = write!(known, ", and {} only tried", tried.len());
        }
        // Of what is only tried the page of claims says where it held; here it is no part of what did.
        let of_all = |scalar| {
            let held = |row: &&Row| row.scalar == scalar && row.status == Status::Held;
            let held = proved.iter().filter(|rows| rows.iter().any(held)).count();
            (held < proved.len()).then(|| format!("{held} of {count}"))
        };
        let claimed = format!("[what is claimed]({up}claims.md#{})", anchor(entry));
        format!("<div class=\"status\">\n\n{} · {claimed}\n\n</div>", outcome(&rows, &known, of_all))
    }

    /// All claims, in Markdown, with links to where the book has each entry.
    pub fn page(&self, places: &Places) -> String {
        let given = supposed();
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
                    let _ = write!(text, "- **{name}** ({kind})");
                    let (statement, given) = &given[&(entry.equation, name)];
                    if let Some(statement) = statement {
                        let _ = write!(text, "\\\n  `{statement}`");
                    }
                    if !given.is_empty() {
                        let _ = write!(text, "\\\n  if `{}`", given.join("`, `"));
                    }
                    let decided = |scalar| {
                        let row = rows.iter().find(|row| row.scalar == scalar)?;
                        (row.decided < CASES).then(|| row.decided.to_string())
                    };
                    let came = outcome(&rows, &format!("[proved]({})", proof(entry, name)), decided);
                    let _ = writeln!(text, "\\\n  <span class=\"status\">{came}</span>");
                }
            }
        }
        text
    }
}

/// What a claim states, if that is a formula, and what it supposes.
type Supposed = (Option<String>, Vec<String>);

/// That of each claim, by its equation and its name.
fn supposed() -> HashMap<(&'static str, &'static str), Supposed> {
    let given = |given: &[Hypothesis]| registry().all_supposed(given);
    let floats = float_experiments::<f64>().into_iter().map(|e| (e.equation, e.name, e.given));
    let rationals = exact_experiments().into_iter().map(|e| (e.equation, e.name, e.given));
    let tried = floats.chain(rationals).map(|(equation, name, g)| ((equation, name), (None, given(&g))));
    let recorded = claims().map(|claim| {
        let statement = claim;
        // What is part of the proof is not supposed.
        let supposed =
            claim.stated_hypotheses().iter().filter(|given| statement.hypotheses().contains(given));
        let supposed: Vec<_> = supposed.cloned().collect();
        let text = Paper::new(registry()).claim(statement);
        ((claim.equation(), claim.name()), (Some(text), given(&supposed)))
    });
    tried.chain(recorded).collect()
}

/// What came of claims: whether they are proved, as `proved` says it, and in which number systems they hold.
/// What does not hold is named, and marked as open. Of a system in which they hold, `part` says what is to stand in
/// brackets if that is only a part.
fn outcome(rows: &[&Row], proved: &str, part: impl Fn(Option<NumberSystem>) -> Option<String>) -> String {
    let with = |scalar, status| {
        let found = rows.iter().filter(move |row| row.scalar == scalar && row.status == status);
        found.map(|row| row.claim).collect::<Vec<_>>()
    };
    let open = |what: &str, claims: &[&str]| {
        format!("<strong class=\"open\">{what}: {}</strong>", claims.join(", "))
    };
    let failed = with(None, Status::Failed);
    let mut said = Vec::new();
    if !failed.is_empty() {
        said.push(open("not proved", &failed));
    } else if rows.iter().any(|row| row.scalar.is_none()) {
        said.push(proved.into());
    } else {
        said.push("tried, not proved".into());
    }
    let mut held = Vec::new();
    for scalar in Options::default().scalars {
        let called = called(scalar);
        let [wrong, undecided] = [Status::Failed, Status::Undecided].map(|status| with(Some(scalar), status));
        if !wrong.is_empty() {
            said.push(open(&format!("wrong in {called}"), &wrong));
        }
        if !undecided.is_empty() {
            said.push(open(&format!("undecided in {called}"), &undecided));
        }
        if wrong.is_empty() && undecided.is_empty() && !with(Some(scalar), Status::Held).is_empty() {
            held.push(match part(Some(scalar)) {
                Some(part) => format!("{called} ({part})"),
                None => called,
            });
        }
    }
    if !held.is_empty() {
        said.push(format!("held in {}", held.join(", ")));
    }
    said.join(" · ")
}

/// A number system as a reader calls it.
fn called(scalar: NumberSystem) -> String {
    match scalar {
        NumberSystem::Mpfr(bits) => format!("{bits} bits"),
        NumberSystem::Exact => "rationals".into(),
        float => float.to_string(),
    }
}

/// What an entry is called in addresses: `1-13`, `note-3`, `theorem-1-3-3`.
pub fn slug(entry: &Entry) -> String {
    entry.equation.to_lowercase().replace(". ", "-").replace(['.', ' '], "-")
}

/// A statement with its indices and exponents set as such: `u_{k+1}` as u with a small k+1.
pub fn with_indices(statement: &str) -> String {
    static INDEX: LazyLock<Regex> = LazyLock::new(|| Regex::new(r"([_^])(?:\{([^}]*)\}|(\w+))").unwrap());
    let small = |index: &Captures| {
        let element = if &index[1] == "_" { "sub" } else { "sup" };
        let what = index.get(2).or(index.get(3)).map_or("", |what| what.as_str());
        format!("<{element}>{what}</{element}>")
    };
    INDEX.replace_all(statement, small).into_owned()
}

/// Where the page of all claims has it.
pub fn anchor(entry: &Entry) -> String {
    format!("claims-{}", slug(entry))
}

/// Where an entry's proofs are.
pub fn proofs(entry: &Entry) -> String {
    format!("proofs/{}.md#{}", entry.section, id(&heading(entry)))
}

/// Where the proof of a claim is.
fn proof(entry: &Entry, claim: &str) -> String {
    format!("proofs/{}.md#{}", entry.section, id(&heading_of(entry, claim)))
}

/// The address that mdBook gives a heading.
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

    /// Nothing to put in brackets.
    fn all(_: Option<NumberSystem>) -> Option<String> {
        None
    }

    #[test]
    fn indices_are_small() {
        let statement = "λ_{k+1} = ρ^{k+1} λ₀ and u_nh, u_k − H";
        let set = "λ<sub>k+1</sub> = ρ<sup>k+1</sup> λ₀ and u<sub>nh</sub>, u<sub>k</sub> − H";
        assert_eq!(with_indices(statement), set);
    }

    /// A row of 1.13's first claim.
    fn row(scalar: Option<NumberSystem>, status: Status) -> Row {
        Row {
            equation: "1.13",
            claim: "rate",
            kind: "equal",
            status,
            scalar,
            why: None,
            decided: 1,
            undecided: 0,
            worst: None,
            counterexample: None,
        }
    }

    #[test]
    fn what_holds_is_said() {
        let rows = [row(None, Status::Proved), row(Some(NumberSystem::F32), Status::Held)];
        assert_eq!(outcome(&rows.each_ref(), "proved", all), "proved · held in f32");
    }

    #[test]
    fn what_is_only_tried_is_not_called_proved() {
        let rows = [row(Some(NumberSystem::Exact), Status::Held)];
        assert_eq!(outcome(&rows.each_ref(), "proved", all), "tried, not proved · held in rationals");
    }

    #[test]
    fn what_is_not_tried_everywhere_is_not_said_to_hold_there() {
        let [f64, exact] = [NumberSystem::F64, NumberSystem::Exact].map(Some);
        let limit = |scalar, status| Row { claim: "limit", ..row(scalar, status) };
        let sign = |scalar| Row { claim: "sign", ..row(scalar, Status::Held) };
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
            status.contains("), and 1 only tried · held in f64, rationals (1 of 2 claims) · "),
            "{status}"
        );
    }

    #[test]
    fn the_page_says_how_many_cases_are_drawn() {
        let page = include_str!("../../src/claims.md");
        assert!(page.contains(" on fifty drawn systems") && CASES == 50);
        let few = |_| Some("45".to_string());
        let rows = [row(None, Status::Proved), row(Some(NumberSystem::F32), Status::Held)];
        assert_eq!(outcome(&rows.each_ref(), "proved", few), "proved · held in f32 (45)");
    }

    #[test]
    fn what_does_not_hold_is_said() {
        let rows = [row(None, Status::Failed), row(Some(NumberSystem::Mpfr(256)), Status::Held)];
        let said = outcome(&rows.each_ref(), "proved", all);
        assert_eq!(said, "<strong class=\"open\">not proved: rate</strong> · held in 256 bits");
        let rows = [row(None, Status::Proved), Row { claim: "limit", ..row(None, Status::Failed) }];
        assert_eq!(
            outcome(&rows.each_ref(), "proved", all),
            "<strong class=\"open\">not proved: limit</strong>"
        );
        let f64 = Some(NumberSystem::F64);
        let rows = [row(None, Status::Proved), row(f64, Status::Failed), row(f64, Status::Held)];
        let said = outcome(&rows.each_ref(), "proved", all);
        assert_eq!(said, "proved · <strong class=\"open\">wrong in f64: rate</strong>");
        let rows = [row(None, Status::Proved), row(f64, Status::Undecided), row(f64, Status::Held)];
        let said = outcome(&rows.each_ref(), "proved", all);
        assert_eq!(said, "proved · <strong class=\"open\">undecided in f64: rate</strong>");
    }
}

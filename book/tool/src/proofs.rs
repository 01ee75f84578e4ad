//! The pages of claims and their short proofs, in Markdown.

use spring_mass_contact::{
    claims::{Entry, entries, registry},
    formula::{Hypothesis, Statement},
    proof::{prove, render::ProofPrinter},
    verify::experiments,
};

/// Sections of the entries, each with the title of its page.
pub const SECTIONS: [(&str, &str); 7] = [
    ("1.1", "Claims of section 1.1"),
    ("1.2", "Claims of section 1.2"),
    ("1.3.1", "Claims of section 1.3.1"),
    ("1.3.2", "Claims of section 1.3.2"),
    ("1.3.3", "Claims of section 1.3.3"),
    ("notes", "Claims of the notes"),
    ("beyond", "Claims beyond the chapter"),
];

/// Returns the file name and the Markdown text of a page for each section, with its entries and their claims.
pub fn pages() -> impl Iterator<Item = (String, String)> {
    SECTIONS.iter().map(|(section, title)| (format!("{section}.md"), page(section, title)))
}

/// Returns the heading of an entry.
pub fn heading(entry: &Entry) -> String {
    format!("{} {}", entry.label(), entry.title)
}

/// Returns the names and statements of the claims that are only tested.
pub fn tested(entry: &Entry) -> impl Iterator<Item = (&'static str, &'static str)> {
    let all = experiments::<f64>().into_iter().filter(|it| it.equation == entry.equation);
    all.filter_map(|it| Some((it.name, it.statement?)))
}

fn page(section: &str, title: &str) -> String {
    let mut text = format!("# {title}\n\n[How to read them](../proofs.md#claims)\n");
    entries().iter().filter(|entry| entry.section == section).for_each(|entry| text += &render_entry(entry));
    text
}

/// Renders an entry with its claims, and the command that prints the proofs.
fn render_entry(entry: &Entry) -> String {
    let tested = tested(entry).map(|(name, statement)| format!("- *{name}*, tested: {statement}\n"));
    let items: String = entry.claims.iter().map(|claim| render_claim(entry, claim)).chain(tested).collect();
    if items.is_empty() {
        return items;
    }
    let number =
        if entry.label().starts_with('(') { entry.equation } else { &format!("'{}'", entry.equation) };
    let hypotheses = code(&entry.hypotheses).map_or(String::new(), |list| format!(", if {list}"));
    format!("\n## {}\n\n`contact prove {number}`{hypotheses}:\n\n{items}", heading(entry))
}

/// Renders a claim with its proof, if that is one line. The hypotheses of the entry are not repeated.
fn render_claim(entry: &Entry, claim: &Statement) -> String {
    let printer = ProofPrinter::new(registry());
    let stated = claim.stated_hypotheses().iter().filter(|h| claim.hypotheses().contains(h)).cloned();
    let stated: Vec<_> = stated.collect();
    let conditions = if entry.hypotheses.iter().all(|h| stated.contains(h)) {
        let added: Vec<_> = stated.into_iter().filter(|h| !entry.hypotheses.contains(h)).collect();
        code(&added).map_or(String::new(), |list| format!(", if {list}"))
    } else {
        code(&stated).map_or(", for all values".into(), |list| format!(", if only {list}"))
    };
    let text = printer.claim(claim);
    let (statement, is_in_words) = match text.strip_prefix("both functions are ") {
        Some(formula) => (format!("two functions compute `{formula}`"), true),
        None if text == "it is 0 for all values" => ("the function is zero".into(), true),
        None => (format!("`{}`", abbreviated(&text)), false),
    };
    let proof = match prove(claim).map(|proof| printer.proof(&proof)) {
        Ok(lines) => match &lines[..] {
            [line] if !is_in_words && !line.contains("a sum of") => format!("; {line}"),
            _ => String::new(),
        },
        Err(error) => format!(" **not proved**: {}", printer.describe(claim, &error)),
    };
    format!("- *{}*: {statement}{conditions}{proof}\n", claim.name())
}

/// Abbreviates the deflections of (1.16) and (1.13) in a claim without rounding.
fn abbreviated(claim: &str) -> String {
    if claim.contains("fl(") {
        return claim.into();
    }
    let claim = claim.replace("(ε (H − l) + m g) / (c + ε)", "u_ε");
    ["λ", "x₁"].iter().fold(claim, |claim, multiplier| {
        claim.replace(&format!("(m g − {multiplier} + ε (H − l)) / (c + ε)"), &format!("u({multiplier})"))
    })
}

/// Formats hypotheses, if there are any.
fn code(hypotheses: &[Hypothesis]) -> Option<String> {
    let list = registry().format_hypotheses(hypotheses).join("`, `");
    (!list.is_empty()).then(|| format!("`{list}`"))
}

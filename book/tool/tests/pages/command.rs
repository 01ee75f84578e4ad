//! The page about the command lists the options declared in the sources, and its console samples agree with the outputs
//! that `command/tests/cmd` expects. The same holds for the samples of the page on stalls.

use super::page;
use crate::files::{files, root, text};
use book_tool::PAGES;
use regex::Regex;
use std::collections::{BTreeMap, BTreeSet};

/// Returns the options that the command's sources declare.
fn declared() -> BTreeSet<String> {
    // Some options have a second attribute.
    let option = r#"#\[arg\(long(?: = "([\w-]+)")?[^\n]*\)\]\s+(?:#\[arg[^\n]*\]\s+)?(?:pub )?(\w+):"#;
    let option = Regex::new(option).unwrap();
    let sources = files(&root().join("command/src"), ".rs");
    let sources: String = sources.iter().map(text).collect();
    option
        .captures_iter(&sources)
        .map(|found| found.get(1).map_or_else(|| found[2].replace('_', "-"), |name| name.as_str().into()))
        .collect()
}

#[test]
fn page_lists_exactly_the_declared_options() {
    let flag = Regex::new(r"(?:^|[\s`])--([a-z][a-z-]+)").unwrap();
    let mut listed: BTreeSet<String> =
        flag.captures_iter(&page("command")).map(|found| found[1].into()).collect();
    // Options of cargo, and the one that every command has.
    assert!(listed.remove("release") && listed.remove("path") && listed.remove("help"));
    assert_eq!(listed, declared());
}

/// Returns the commands of a text with their output, which is empty if it is not shown.
fn transcript(text: &str) -> Vec<(String, Vec<String>)> {
    let mut runs: Vec<(String, Vec<String>)> = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        if line.starts_with("```") {
            inside = line == "```console";
        } else if let Some(command) = line.strip_prefix("$ ").filter(|_| inside) {
            runs.push((command.into(), Vec::new()));
        } else if inside && !line.starts_with("? ") {
            runs.last_mut().expect("a command").1.push(line.into());
        }
    }
    for (_, output) in &mut runs {
        while output.last().is_some_and(|line| line.is_empty()) {
            output.pop();
        }
    }
    runs
}

/// Returns the runs in the files of expected outputs, of the page on stalls or of the others.
fn snapshots(on_stalls: bool) -> BTreeMap<String, Vec<String>> {
    let mut snapshots = files(&root().join("command/tests/cmd"), ".trycmd");
    snapshots.retain(|path| path.ends_with("stalls.trycmd") == on_stalls);
    snapshots.iter().flat_map(|path| transcript(&text(path))).collect()
}

/// Lines that the page on stalls omits as ` …` are `...` in the file with its outputs.
#[test]
fn samples_agree_with_the_expected_output() {
    let (others, on_stalls) = (snapshots(false), snapshots(true));
    let mut compared = 0;
    for name in PAGES {
        let (page, snapshots) = (page(name), if *name == "stalls" { &on_stalls } else { &others });
        let shown = transcript(&page);
        assert_eq!(
            page.matches("\n$ contact").count(),
            shown.iter().filter(|run| run.0.starts_with("contact")).count(),
            "{name}: a command outside of a console block"
        );
        // Bare `contact` runs too many cases for a test.
        for (command, sample) in shown.iter().filter(|(run, sample)| run != "contact" && !sample.is_empty()) {
            let snapshot =
                snapshots.get(command).unwrap_or_else(|| panic!("no test checks the output of {command}"));
            assert_eq!(sample.len(), snapshot.len(), "{command}");
            assert!(sample.iter().any(|line| line != " …"), "{command}: no line is shown");
            for (line, expected) in sample.iter().zip(snapshot) {
                let pattern = regex::escape(expected).replace(r"\[\.\.\]", ".*");
                let pattern = Regex::new(&format!("^{pattern}$")).unwrap();
                let line = if line == " …" { "..." } else { line };
                assert!(pattern.is_match(line), "{command}: {line:?} is not {expected:?}");
            }
            compared += 1;
        }
    }
    assert!(compared > on_stalls.len() && on_stalls.len() > 5, "only {compared} samples were compared");
}

/// A row of the table has a test; the section it links to, unless it is on another page, has an example and a remedy.
#[test]
fn every_symptom_has_test_example_and_remedy() {
    let page = page("stalls");
    let (table, sections) = page.split_once("## The ratio").expect("a section after the table");
    let row = Regex::new(r"(?m)^\| \[.*?\]\((?:\w+\.md)?#([\w-]+)\) \| [^|]+ \| [^|]+ \|$").unwrap();
    let rows: Vec<_> = row.captures_iter(table).collect();
    assert_eq!(rows.len(), table.matches("\n| [").count(), "a row has no link, no cause or no test");
    let linked: BTreeSet<_> =
        rows.iter().filter(|row| row[0].contains("](#")).map(|row| row[1].to_string()).collect();
    let (anchor, mut shown) = (Regex::new(r"\{#([\w-]+)\}\n").unwrap(), BTreeSet::new());
    for section in sections.split("\n## ").skip(1) {
        let id = anchor.captures(section).expect("an anchor")[1].to_string();
        assert!(section.contains("\n*Remedy.*"), "{id}: no remedy");
        assert!(
            ["console", "rust"].iter().any(|kind| section.contains(&format!("\n```{kind}\n"))),
            "{id}: no example"
        );
        shown.insert(id);
    }
    assert_eq!(linked, shown);
}

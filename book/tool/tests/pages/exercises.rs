//! Tests of the exercises: they are numbered, of a known kind, and their solutions are checked.

use super::page;
use book_tool::PAGES;
use regex::Regex;
use std::{collections::BTreeSet, sync::LazyLock};

/// Exercise of a page.
struct Exercise {
    /// Page and number.
    name: String,
    kind: String,
    statement: String,
    solution: String,
}

static EXERCISES: LazyLock<Vec<Exercise>> = LazyLock::new(|| {
    let pages: Vec<_> = PAGES.iter().filter(|name| page(name).contains("id=\"exercise-")).collect();
    assert_eq!(pages.len(), 10, "pages with exercises: {pages:?}");
    pages.into_iter().flat_map(|name| exercises(name)).collect()
});

/// Returns the exercises of a page, one to five with the numbers from 1, which are its last section.
fn exercises(name: &str) -> Vec<Exercise> {
    let exercise = r#"(?ms)^<strong id="exercise-(\d+)">(\d+)\. (Predict|Compute|Prove|Break)\.</strong> (.*?)
<details class="solution">
<summary>Solution</summary>

(.*?)

</details>$"#;
    let (exercise, page) = (Regex::new(exercise).unwrap(), page(name));
    let (_, section) = page.split_once("\n## Exercises\n").unwrap_or_else(|| panic!("{name}: no exercises"));
    let other = exercise.replace_all(section, "");
    assert!(other.trim().is_empty(), "{name}: not an exercise with a folded solution: {other}");
    let found: Vec<_> = exercise.captures_iter(section).collect();
    assert!((1..=5).contains(&found.len()), "{name} has {} exercises", found.len());
    let found = found.iter().zip(1..).map(|(found, number)| {
        assert_eq!([&found[1], &found[2]], [&*number.to_string(); 2], "{name}: numbers");
        let [kind, statement, solution] = [3, 4, 5].map(|i| found[i].to_string());
        Exercise { name: format!("{name} {number}"), kind, statement, solution }
    });
    found.collect()
}

/// Each solution has code with assertions, the output of a command, or the formula of a function.
#[test]
fn each_solution_is_proved_or_checked() {
    let fence = Regex::new(r"(?ms)^```(\S*)\n(.*?)^```$").unwrap();
    for Exercise { name, kind, statement, solution } in EXERCISES.iter() {
        assert!(!statement.contains("```"), "the statement of {name} contains code");
        for block in fence.captures_iter(solution) {
            let is_checked = match &block[1] {
                "rust" => block[2].contains("assert"),
                // Checked by command.rs.
                "console" => block[2].starts_with("$ contact ") && block[2].lines().count() > 1,
                _ => false,
            };
            assert!(is_checked, "{name}: a block of {} without a check", &block[1]);
        }
        let is_checked = match kind.as_str() {
            "Prove" => solution.contains(r"\square"),
            _ => fence.is_match(solution) || solution.contains("{{#formula "),
        };
        assert!(is_checked, "{name}: the proof has no end mark, or the solution no check");
    }
}

/// Numbers of three digits in a solution also occur in the statement, in the code or in the output of the command, where
/// they are checked. Proofs, which have no code, are excluded.
#[test]
fn numbers_of_a_solution_are_checked() {
    let fence = Regex::new(r"(?ms)^```.*?^```$").unwrap();
    let aside = Regex::new(r"\]\([^)]*\)|\{\{#.*?\}\}|\\,").unwrap();
    let number = Regex::new(r"\d+\.?\d*").unwrap();
    // 999 and 999.0 are the same number.
    let values = |text: &str| -> BTreeSet<String> {
        number.find_iter(text).map(|n| n.as_str().parse::<f64>().unwrap().to_string()).collect()
    };
    let mut seen = 0;
    for Exercise { name, statement, solution, .. } in EXERCISES.iter().filter(|it| it.kind != "Prove") {
        let code: String = fence.find_iter(solution).map(|block| block.as_str().replace('_', "")).collect();
        let text = aside.replace_all(&fence.replace_all(solution, ""), "").into_owned();
        let mut stated = values(&text);
        stated.retain(|value| value.replace('.', "").trim_matches('0').len() >= 3);
        seen += stated.len();
        let unchecked: Vec<_> = stated.difference(&values(&(code + statement))).cloned().collect();
        assert!(unchecked.is_empty(), "{name}: not checked: {unchecked:?}");
    }
    assert!(seen > 5, "{seen}");
}

/// The minutes and points on the page for lecturers add up, and the texts of its links agree with their targets.
#[test]
fn lectures_and_problems_add_up() {
    let sheet = page("teaching");
    let sum = |rows: &str, pattern: &str| -> u32 {
        let row = Regex::new(pattern).unwrap();
        row.captures_iter(rows).map(|row| row[1].parse::<u32>().unwrap()).sum()
    };
    let sections: Vec<_> = sheet.split("\n## ").collect();
    let section = |title: &str| *sections.iter().find(|text| text.starts_with(title)).unwrap();
    for lecture in ["First lecture", "Second lecture"] {
        assert_eq!(sum(section(lecture), r"(?m)^\| (\d+) \|"), 90, "{lecture}");
    }
    assert_eq!(sum(section("A problem set"), r"(?m)^\| \[\w+ \d\]\([^)]*\) \| (\d+) \|"), 100);
    let link = Regex::new(r"\[(\w+) (\d)\]\((\w+)\.md#exercise-(\d)\)").unwrap();
    let links: Vec<_> = link.captures_iter(&sheet).collect();
    assert_eq!(links.len(), sheet.matches("#exercise-").count(), "a link has a different text");
    for link in links {
        assert_eq!((&link[1], &link[2]), (&link[3], &link[4]));
    }
}

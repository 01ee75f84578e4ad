//! Tests of the exercises: they are numbered, of a known kind, and their solutions are checked.

use super::page;
use book_tool::PAGES;
use regex::Regex;
use std::collections::BTreeSet;

/// Pages that end with exercises.
const WITH_EXERCISES: [&str; 11] = [
    "system",
    "structure",
    "contact",
    "lagrange",
    "penalty",
    "augmented",
    "convergence",
    "loose",
    "beyond",
    "floats",
    "proofs",
];

const KINDS: [&str; 4] = ["Predict", "Compute", "Prove", "Break"];

/// Exercise of a page.
struct Exercise {
    number: usize,
    kind: String,
    statement: String,
    solution: String,
}

/// Parses the exercises of a page, or returns an error message.
fn exercises(page: &str) -> Result<Vec<Exercise>, String> {
    let headings = Regex::new(r"(?m)^## (.*)$").unwrap();
    let last = headings.captures_iter(page).last().ok_or("no section")?;
    if &last[1] != "Exercises" {
        return Err(format!("the last section is {}", &last[1]));
    }
    let section = &page[last.get_match().end()..];
    let start = Regex::new(r#"(?m)^<strong id="exercise-(\d+)">(\d+)\. (\w+)\.</strong> "#).unwrap();
    let starts: Vec<_> = start.captures_iter(section).collect();
    if section.matches("<strong id=").count() != starts.len() {
        return Err("an exercise has an invalid beginning".into());
    }
    let ends = starts.iter().skip(1).map(|next| next.get_match().start()).chain([section.len()]);
    let mut exercises = Vec::new();
    for (start, end) in starts.iter().zip(ends) {
        let name = format!("exercise {}", &start[2]);
        let body = &section[start.get_match().end()..end];
        let (statement, fold) = body
            .split_once("\n<details class=\"solution\">\n<summary>Solution</summary>\n\n")
            .ok_or(format!("{name} has no folded solution"))?;
        let solution =
            fold.trim_end().strip_suffix("\n\n</details>").ok_or(format!("{name} does not end folded"))?;
        if solution.contains("details>") {
            return Err(format!("{name} has two folds"));
        }
        if start[1] != start[2] {
            return Err(format!("the id of {name} has a different number"));
        }
        exercises.push(Exercise {
            number: start[2].parse().unwrap(),
            kind: start[3].into(),
            statement: statement.into(),
            solution: solution.into(),
        });
    }
    Ok(exercises)
}

#[test]
fn pages_of_the_chapter_end_with_exercises() {
    for name in WITH_EXERCISES {
        let exercises = exercises(&page(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let numbers: Vec<_> = exercises.iter().map(|exercise| exercise.number).collect();
        assert!((3..=5).contains(&numbers.len()), "{name} has {} exercises", numbers.len());
        assert_eq!(numbers, (1..=numbers.len()).collect::<Vec<_>>(), "{name}");
        for exercise in exercises {
            let (name, kind) = (format!("{name} {}", exercise.number), &exercise.kind);
            assert!(KINDS.contains(&kind.as_str()), "{name} is of an unknown kind: {kind}");
            assert!(!exercise.statement.contains("```"), "the statement of {name} contains code");
        }
    }
    let others = PAGES.iter().filter(|name| !WITH_EXERCISES.contains(name));
    for name in others {
        assert!(!page(name).contains("## Exercises"), "the exercises of {name} are not checked");
    }
}

/// Each solution has code with assertions, the output of a command, or the formula of a function.
#[test]
fn each_solution_is_proved_or_checked() {
    let fence = Regex::new(r"(?ms)^```(\S*)\n(.*?)^```$").unwrap();
    for name in WITH_EXERCISES {
        for Exercise { number, kind, solution, .. } in exercises(&page(name)).unwrap() {
            let blocks: Vec<_> = fence.captures_iter(&solution).collect();
            for block in &blocks {
                let checks = match &block[1] {
                    "rust" => block[2].contains("assert"),
                    // Checked by command.rs.
                    "console" => block[2].starts_with("$ contact ") && block[2].lines().count() > 1,
                    _ => false,
                };
                assert!(checks, "{name} {number}: a block of {} without a check", &block[1]);
            }
            match kind.as_str() {
                "Prove" => {
                    assert!(solution.contains(r"\square"), "{name} {number}: the proof has no end mark")
                }
                _ => assert!(
                    !blocks.is_empty() || solution.contains("{{#formula "),
                    "{name} {number}: the solution is not checked"
                ),
            }
        }
    }
}

/// Numbers of three digits in a solution also occur in the statement, in the code or in the output of the command, where
/// they are checked. Proofs, which have no code, are excluded.
#[test]
fn numbers_of_a_solution_are_checked() {
    let fence = Regex::new(r"(?ms)^```.*?^```$").unwrap();
    let aside = Regex::new(r"\]\([^)]*\)|\{\{#.*?\}\}").unwrap();
    let number = Regex::new(r"\d+\.?\d*").unwrap();
    // 999 and 999.0 are the same number.
    let value = |number: &str| number.parse::<f64>().unwrap().to_string();
    let (mut seen, mut unchecked) = (0, Vec::new());
    for name in WITH_EXERCISES {
        for Exercise { number: exercise, kind, statement, solution } in exercises(&page(name)).unwrap() {
            if kind == "Prove" {
                continue;
            }
            let code: String =
                fence.find_iter(&solution).map(|block| block.as_str().replace('_', "")).collect();
            let checked: BTreeSet<_> = number
                .find_iter(&code)
                .chain(number.find_iter(&statement))
                .map(|n| value(n.as_str()))
                .collect();
            let text = fence.replace_all(&solution, "").replace("\\,", "");
            for found in
                number.find_iter(&aside.replace_all(&text, "")).map(|n| n.as_str().trim_end_matches('.'))
            {
                let digits = found.replace('.', "");
                if digits.trim_matches('0').len() >= 3 {
                    if !checked.contains(&value(found)) {
                        unchecked.push(format!("{name} {exercise}: {found}"));
                    }
                    seen += 1;
                }
            }
        }
    }
    assert!(unchecked.is_empty(), "not checked: {unchecked:?}");
    assert!(seen > 20, "{seen}");
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

#[test]
fn malformed_exercises_are_reported() {
    let one = |number: usize| {
        format!(
            "<strong id=\"exercise-{number}\">{number}. Predict.</strong> What?\n\n\
             <details class=\"solution\">\n<summary>Solution</summary>\n\nThis.\n\n</details>\n\n"
        )
    };
    let valid = format!("# Page\n\n## Text\n\n## Exercises\n\n{}{}", one(1), one(2));
    let read = |page: &str| exercises(page).map(|found| found.len());
    assert_eq!(read(&valid), Ok(2));
    let error = |from: &str, to: &str| read(&valid.replacen(from, to, 1)).unwrap_err();
    assert_eq!(error("## Exercises", "## More"), "the last section is More");
    assert_eq!(error("exercise-2", "exercise-1"), "the id of exercise 2 has a different number");
    assert_eq!(error("2. Predict.", "2 Predict."), "an exercise has an invalid beginning");
    assert_eq!(error("<summary>Solution", "<summary>Answer"), "exercise 1 has no folded solution");
    assert_eq!(error("This.\n\n</details>", "This.\n\n"), "exercise 1 does not end folded");
    assert_eq!(error("This.", "This.\n\n</details>\n\nThat."), "exercise 1 has two folds");
}

//! Consistency of the chapter's data, functions, claims and documentation, with instructions on failure. No
//! check passes because it found nothing.

use crate::files::{files, root, source};
use spring_mass_contact::claims::{Entry, claims, entries, entry, hypotheses, registry};
use spring_mass_contact::number::tree::Op;
use spring_mass_contact::number::{NumberSystem, Program, Tree};
use spring_mass_contact::solver::{Outcome, State};
use spring_mass_contact::verify::{
    ClaimResult, Options, Status, VerificationReport, claim_names, experiments, verify,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

/// A public function or struct of the chapter, with its documentation.
struct Item {
    path: String,
    docs: Vec<String>,
}

/// Returns `true` in the packed crate, which has cargo's copy of its manifest, and of the book only the pages.
fn is_packed() -> bool {
    root().join("Cargo.toml.orig").exists()
}

fn modules() -> Vec<String> {
    let declared = source("src/chapter/mod.rs");
    let modules: Vec<_> = declared
        .lines()
        .filter_map(|l| l.strip_prefix("pub mod ")?.strip_suffix(';'))
        .map(String::from)
        .collect();
    let files = files("src/chapter").into_iter().filter(|path| !path.ends_with("/mod.rs"));
    let files: BTreeSet<_> = files.map(|path| path["src/chapter/".len()..].replace(".rs", "")).collect();
    let found: BTreeSet<_> = modules.iter().cloned().collect();
    assert_eq!(files, found, "the files of src/chapter, and what its mod.rs declares by `pub mod`");
    modules
}

/// Returns the functions of the chapter, found in its source, where rustfmt puts each at the start of a line.
fn items() -> Vec<Item> {
    let mut items = Vec::new();
    for module in modules() {
        let mut docs = Vec::new();
        for line in source(&format!("src/chapter/{module}.rs")).lines() {
            let name = line.strip_prefix("pub fn ").or(line.strip_prefix("pub struct "));
            if let Some(doc) = line.strip_prefix("///") {
                docs.push(doc.trim().to_string());
            } else if let Some(name) = name {
                let name = name.split(['<', '(', ' ']).next().unwrap();
                items.push(Item { path: format!("{module}::{name}"), docs: std::mem::take(&mut docs) });
            } else if !line.starts_with("#[") {
                docs.clear();
            }
        }
    }
    assert!(items.len() > 50, "the scan of src/chapter finds {} items", items.len());
    items
}

fn functions() -> Vec<Item> {
    items().into_iter().filter(|item| !item.path.contains(char::is_uppercase)).collect()
}

/// Fails with a list of all problems.
fn assert_none(problems: impl IntoIterator<Item = String>) {
    let problems: Vec<_> = problems.into_iter().collect();
    assert!(problems.is_empty(), "\n{}", problems.join("\n"));
}

/// Returns the number of operations that round; those by powers of two are exact.
fn roundings(formula: &Tree) -> usize {
    let mut program = Program::default();
    program.add(formula);
    let is_power =
        |place: &usize| matches!(program.ops()[*place], Op::Int(n) if n.unsigned_abs().is_power_of_two());
    let rounds = |op: &&Op<usize>| match op {
        Op::Add(..) | Op::Sub(..) => true,
        Op::Mul(a, b) => !is_power(a) && !is_power(b),
        Op::Div(_, by) => !is_power(by),
        _ => false,
    };
    program.ops().iter().filter(rounds).count()
}

#[test]
fn documented_roundings_are_those_of_the_formula() {
    const COUNTS: [&str; 9] = ["One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine"];
    let mut stated = 0;
    for Item { path, docs } in functions() {
        let docs = docs.join(" ");
        let count = COUNTS.iter().position(|count| docs.contains(&format!("{count} rounding")));
        let formula = registry().formulas().iter().find(|formula| formula.path == path);
        if let (Some(count), Some(formula)) = (count, formula) {
            let rounded = roundings(&formula.tree);
            assert_eq!(rounded, count + 1, "src/chapter: the formula of {path} has {rounded} roundings");
            stated += 1;
        }
    }
    assert!(stated >= 8, "the scan finds {stated} counts of roundings");
}

#[test]
fn entries_are_unique() {
    let mut numbers = BTreeSet::new();
    for e in entries() {
        assert!(numbers.insert(e.equation), "{} has two entries in src/claims: make them one", e.equation);
    }
}

#[test]
fn derivations_have_no_cycle() {
    for e in entries() {
        for premise in &e.follows_from {
            assert!(
                entry(premise).is_some(),
                "{}: its `.follows_from([…])` in src/claims names {premise}, which has no entry",
                e.equation
            );
        }
    }
    // Entries whose premises are all known can be added; in the end all must be.
    let mut known = BTreeSet::new();
    loop {
        let before = known.len();
        for e in entries() {
            if e.follows_from.iter().all(|premise| known.contains(premise)) {
                known.insert(e.equation);
            }
        }
        if known.len() == before {
            break;
        }
    }
    let left: Vec<_> = entries().iter().map(|e| e.equation).filter(|e| !known.contains(e)).collect();
    assert!(
        left.is_empty(),
        "the `.follows_from([…])` of these in src/claims lead round in a circle, or to one: {left:?}"
    );
}

#[test]
fn every_function_of_an_entry_exists() {
    let items: BTreeSet<_> = items().into_iter().map(|item| item.path).collect();
    let named = entries().iter().flat_map(|e| e.functions.iter().map(move |function| (e.equation, function)));
    assert_none(named.filter(|(_, function)| !items.contains(**function)).map(|(equation, function)| {
        format!(
            "{equation}: its `.functions([…])` in src/claims name {function}, which is not in src/chapter"
        )
    }));
}

#[test]
fn every_function_belongs_to_an_entry() {
    let named: BTreeSet<_> = entries().iter().flat_map(|e| e.functions.iter().copied()).collect();
    let unnamed = items().into_iter().filter(|item| !named.contains(item.path.as_str()));
    assert_none(unnamed.map(|Item { path, .. }| {
        format!(
            "no entry names {path}: add it to the `.functions([…])` of one that `entries()` lists, in src/claims"
        )
    }));
}

/// In the box of an equation, or by a tag. The tests of the book check that each box exists.
#[test]
fn the_book_shows_every_function() {
    let boxed = entries().iter().filter(|e| e.latex().is_some()).flat_map(|e| &e.functions);
    let mut shown: BTreeSet<String> = boxed.map(|function| function.to_string()).collect();
    for page in pages() {
        let text = fs::read_to_string(page).unwrap();
        for tag in ["{{#formula ", "{{#source "] {
            for (_, what) in text.match_indices(tag).map(|(at, tag)| text.split_at(at + tag.len())) {
                let path = what.split(|c: char| !c.is_alphanumeric() && !"_:".contains(c)).next().unwrap();
                shown.insert(path.trim_end_matches(':').to_string());
            }
        }
    }
    assert_none(items().into_iter().filter(|item| !shown.contains(&item.path)).map(|Item { path, .. }| {
        format!(
            "the book shows {path} nowhere: name it in an entry with a box (`.functions([…])` in src/claims), or \
             write {{{{#formula {path}}}}} or {{{{#source {path}}}}} on the page in book/src where it belongs"
        )
    }));
}

#[test]
fn every_claim_has_an_entry_and_a_unique_name() {
    let mut rows = BTreeSet::new();
    for row in &REPORT.rows {
        let what = format!("{} {}", row.equation, row.claim);
        assert!(entry(row.equation).is_some(), "{what}: src/claims has no entry of this number");
        assert!(
            rows.insert((row.equation, row.claim, row.scalar.map(|scalar| scalar.to_string()))),
            "{what}: two claims of this name, in src/verify/experiments.rs perhaps; call one of them otherwise"
        );
    }
    let named = |e: &'static Entry| claim_names(e.equation).into_iter().map(|claim| (e.equation, claim));
    let named: BTreeSet<_> = entries().iter().flat_map(named).collect();
    let tried: BTreeSet<_> = rows.iter().map(|(equation, claim, _)| (*equation, *claim)).collect();
    let lost: Vec<_> = named.symmetric_difference(&tried).collect();
    assert!(lost.is_empty(), "{lost:?}: listed and not tried by `verify`, or tried and listed nowhere");
}

/// Every hypothesis of an entry is one of some claim, since it would otherwise be unnecessary; and a
/// hypothesis common to all claims is one of the entry, or in its statement.
#[test]
fn the_hypotheses_of_entries_match_those_of_their_claims() {
    let recorded = claims().map(|c| (c.equation(), c.stated_hypotheses().to_vec()));
    let computed = experiments::<f64>().into_iter().map(|e| (e.equation, e.hypotheses));
    let all: Vec<_> = recorded.chain(computed).collect();
    for e in entries() {
        let of_entry = || all.iter().filter(|(equation, _)| *equation == e.equation).map(|(_, given)| given);
        for hypothesis in &e.hypotheses {
            let is_assumed = of_entry().any(|given| given.contains(hypothesis));
            let text = registry().format_hypothesis(hypothesis);
            assert!(is_assumed, "{}: none of its claims assumes {text}", e.equation);
        }
        let first = of_entry().next().cloned().unwrap_or_default();
        for common in first.iter().filter(|common| of_entry().all(|given| given.contains(common))) {
            // The index of a sequence or the time of a solution is not a condition.
            let runs = [&hypotheses().power, &hypotheses().count, &hypotheses().time].contains(&common);
            let text = registry().format_hypothesis(common);
            let is_stated = e.hypotheses.contains(common) || e.statement().contains(&text);
            assert!(
                runs || is_stated,
                "{}: all its claims assume {text}, and the entry does not: add it to `.assuming([…])` of the entry, or \
                 remove it from a claim that does not need it",
                e.equation
            );
        }
    }
}

#[test]
fn every_function_is_documented_in_the_same_order() {
    assert_none(
        functions().iter().filter_map(|item| Some(format!("{}: {}", item.path, undocumented(item)?))),
    );
}

fn is_formula(line: &str) -> bool {
    line.starts_with('`') && !line.starts_with("```") && line.ends_with('`')
}

/// Returns what is missing in the documentation of a function.
fn undocumented(Item { docs, .. }: &Item) -> Option<String> {
    let find = |found: &dyn Fn(&str) -> bool| docs.iter().position(|line| found(line));
    let parts = [
        ("the formula, a line in backticks", find(&is_formula)),
        ("`Source: …` or `Beyond …`", find(&|l| l.contains("Source:") || l.contains("Beyond "))),
        ("an example: a block of code that asserts a value calculated by hand", find(&|l| l == "```")),
    ];
    if let Some((part, _)) = parts.iter().find(|(_, at)| at.is_none()) {
        return Some(format!("its documentation lacks {part}"));
    }
    let [formula, source, example] = parts.map(|(_, at)| at);
    if formula == Some(0) || formula.max(source) > example {
        return Some("its documentation must begin with the name and end with the example".to_string());
    }
    let numbers = docs[0].split("Eq. (").skip(1).filter_map(|rest| rest.split(')').next());
    let unknown = numbers.into_iter().find(|number| entry(number).is_none());
    unknown.map(|number| format!("its documentation names ({number}), which has no entry"))
}

#[test]
fn every_documented_formula_is_the_computed_one() {
    // A predicate has no record.
    const UNRECORDED: [&str; 1] = ["augmented::within_tolerance"];
    let formula = |l: &&String| is_formula(l);
    assert_none(functions().into_iter().filter_map(|Item { path, docs }| {
        let (module, name) = path.split_once("::").unwrap();
        let listed = UNRECORDED.contains(&path.as_str());
        match (registry().format_equation(&path), listed) {
            (None, true) => None,
            (Some(_), true) => Some(format!("{path} is registered: remove it from the list in this test")),
            (None, false) => Some(format!(
                "{path} is not registered: add a line `\"symbol\" = {path}(&system, …);` with `&x(\"…\")` for each \
                 argument to `formulas!` at the beginning of src/claims/{module}.rs"
            )),
            (Some(computed), false) => {
                let written: Vec<_> = docs.iter().filter(formula).collect();
                let right = written == [&format!("`{computed}`")];
                (!right).then(|| {
                    format!(
                        "src/chapter/{module}.rs: the documentation of {name} has {written:?} but it computes \
                         `{computed}`: correct the documentation, the function, or the symbols of its arguments \
                         in src/claims/{module}.rs"
                    )
                })
            }
        }
    }));
}

#[test]
fn every_placeholder_of_an_entry_is_replaced() {
    for e in entries() {
        let latex = e.latex();
        let left = |text: &str| text.contains(['«', '»']);
        let unknown = "a placeholder names a formula that src/claims does not register";
        assert!(!left(&e.statement()), "{}: {unknown}: {}", e.equation, e.statement());
        assert!(!latex.as_deref().is_some_and(left), "{}: {unknown}: {latex:?}", e.equation);
        assert!(
            latex.is_some() == e.equation.starts_with("1."),
            "{}: an entry has `.in_latex(…)` if and only if it is a numbered equation",
            e.equation
        );
    }
}

#[test]
fn no_formula_is_written_twice() {
    let mut bodies: BTreeMap<String, String> = BTreeMap::new();
    let mut seen = 0;
    for module in modules() {
        let text = source(&format!("src/chapter/{module}.rs"));
        for function in text.split("\npub fn ").skip(1) {
            let name = function.split(['<', '(']).next().unwrap().to_string();
            let body = function.split_once("{\n").and_then(|(_, rest)| rest.split_once("\n}")).unwrap().0;
            let formula =
                body.lines().filter(|l| !l.trim_start().starts_with("let SpringMass")).collect::<String>();
            // (1.28) and the gap are equal, and the chapter prints both.
            if let Some(other) = bodies.insert(formula.clone(), name.clone()) {
                let pair = [other.as_str(), name.as_str()];
                let allowed = [["deflection", "particular"], ["gap", "particular"], ["particular", "gap"]];
                let calls = formula.contains("::") || formula.contains("(system");
                assert!(
                    allowed.contains(&pair) || calls,
                    "in src/chapter {other} and {name} are the same formula, {}: one must call the other",
                    formula.trim()
                );
            }
            seen += 1;
        }
    }
    assert_eq!(seen, functions().len(), "functions scanned, all functions");
}

/// Cases of every claim in five number systems.
static REPORT: LazyLock<VerificationReport> = LazyLock::new(|| {
    use NumberSystem::{Exact, Mpfr};
    let scalars = vec![NumberSystem::F32, NumberSystem::F64, Mpfr(24), Mpfr(777), Exact];
    verify(&Options { scalars, cases: 100, seed: 7, equations: vec![] }, &|_, _| ())
});

#[test]
fn every_claim_holds_in_every_number_system() {
    let failed = REPORT.rows.iter().filter(|row| !matches!(row.status, Status::Proved | Status::Held));
    assert_none(failed.map(|ClaimResult { equation, claim, status, scalar, .. }| {
        let method = scalar.map_or("the proof".to_string(), |scalar| scalar.to_string());
        format!("{equation} {claim}: {status} in {method}: cargo run --release -- verify '{equation}'")
    }));
    assert!(REPORT.rows.len() > 4 * entries().len(), "only {} rows", REPORT.rows.len());
}

/// A claim with roundings is checked in floats only.
#[test]
fn every_equation_of_the_chapter_has_a_proof_and_holds_in_all_floats() {
    let known: BTreeSet<_> =
        REPORT.rows.iter().map(|row| (row.equation, row.scalar.map(|scalar| scalar.to_string()))).collect();
    let systems = ["f32", "f64", "mpfr:24", "mpfr:777"].map(String::from).map(Some);
    let wanted = (1..=33).map(|n| format!("1.{n}"));
    assert_none(wanted.flat_map(|number| {
        let is_missing = |system: &&Option<String>| !known.contains(&(number.as_str(), (*system).clone()));
        let missing: Vec<_> = [None].iter().chain(&systems).filter(is_missing).collect();
        let problem =
            format!("({number}) has no claim in {missing:?}: add one by `.claims([…])` to its entry");
        (!missing.is_empty()).then_some(problem)
    }));
}

/// If bounds were far too wide, the claims would be vacuous.
#[test]
fn rounding_errors_attain_a_good_part_of_their_bounds() {
    let is_measured = |row: &&ClaimResult| row.kind == "equal" && row.scalar == Some(NumberSystem::F64);
    let measured: Vec<_> = REPORT.rows.iter().filter(is_measured).collect();
    let is_tight = |row: &&&ClaimResult| row.worst.as_ref().is_some_and(|(ratio, _)| *ratio > 0.05);
    let tight = measured.iter().filter(is_tight).count();
    assert!(2 * tight > measured.len(), "{tight} of {} claims use 5 % of their bound", measured.len());
}

/// Returns the pages of the book.
fn pages() -> Vec<PathBuf> {
    let pages = files("book/src").into_iter().filter(|path| path.ends_with(".md"));
    let pages: Vec<_> = pages.map(|path| root().join(path)).collect();
    assert!(pages.len() > 20, "the scan of book/src finds {} pages", pages.len());
    pages
}

/// The page of the command lists the states and outcomes by the names in the JSON.
#[test]
fn the_book_lists_states_and_outcomes_by_their_names() {
    if is_packed() {
        return eprintln!("the page of the command is only in the repository");
    }
    let page = source("book/src/command.md");
    let listed = |field: &str| {
        let row = page.lines().find_map(|line| line.strip_prefix(&format!("| `{field}` | "))).unwrap();
        row.split('`')
            .skip(1)
            .step_by(2)
            .filter(|word| *word != "augmented")
            .map(String::from)
            .collect::<Vec<_>>()
    };
    let states = [State::Contact, State::Grazing, State::Separated].map(|state| match state {
        State::Contact | State::Grazing | State::Separated => state.to_string(),
    });
    assert_eq!(listed("state"), states);
    use Outcome::*;
    let outcomes = [Direct, Converged, Stagnated, IterationLimit].map(|outcome| match outcome {
        Direct | Converged | Stagnated | IterationLimit => outcome.to_string(),
    });
    assert_eq!(listed("outcome"), outcomes);
}

/// Files are named in backticks or as links.
#[test]
fn every_file_that_a_page_names_exists() {
    if is_packed() {
        return eprintln!("the files that pages name are only in the repository");
    }
    let mut seen = 0;
    for page in pages().into_iter().chain(["README.md", "CONTRIBUTING.md"].map(|name| root().join(name))) {
        let text = fs::read_to_string(&page).unwrap();
        for word in text.split(|c: char| c.is_whitespace() || "`()[]<>\"',".contains(c)) {
            let named = ["src/", "engine/", "command/", "tests/", "book/", "examples/", ".ci/"]
                .iter()
                .any(|room| word.starts_with(room));
            let path = word.split(['#', ':', '*']).next().unwrap().trim_end_matches(['.', ';']);
            if named && !word.contains(['*', '{']) {
                assert!(
                    root().join(path).exists(),
                    "{} refers to {path}, which does not exist",
                    page.display()
                );
                seen += 1;
            }
        }
    }
    assert!(seen > 20, "{seen} references");
}

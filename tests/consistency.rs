//! Consistency of the chapter's data, functions, claims and documentation, with instructions on failure. No
//! check passes because it found nothing.
#![cfg(feature = "prover")]

use spring_mass_contact::claims::{Entry, claims, entries, entry, hypotheses, registry};
use spring_mass_contact::number::NumberSystem;
use spring_mass_contact::solver::{Outcome, State};
use spring_mass_contact::verify::{
    Options, Report, Row, Status, claim_names, exact_experiments, float_experiments, verify,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A public function or struct of the chapter, with its documentation.
struct Item {
    path: String,
    docs: Vec<String>,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The packed crate contains neither the seeded faults nor the book's tool, and has cargo's copy of its
/// manifest.
fn is_packed() -> bool {
    root().join("Cargo.toml.orig").exists()
}

fn source(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
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

#[test]
fn every_equation_of_the_chapter_has_an_entry_and_claims() {
    assert_none((1..=33).map(|n| format!("1.{n}")).filter_map(|number| {
        if entry(&number).is_none() {
            Some(format!("({number}) has no entry: add it to its section's file in src/claims"))
        } else if claim_names(&number).is_empty() {
            Some(format!("({number}) has no claim: add one by `.claims([…])` to its entry"))
        } else {
            None
        }
    }));
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
            "no entry names {path}: add it to the `.functions([…])` of the one it belongs to, in src/claims"
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
    let report = verify(&Options { cases: 1, ..Options::default() }, &|_, _| ());
    let mut rows = BTreeSet::new();
    for row in &report.rows {
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
    let floats = float_experiments::<f64>().into_iter();
    let floats = floats.map(|e| (e.equation, e.given));
    let rationals = exact_experiments().into_iter().map(|e| (e.equation, e.given));
    let all: Vec<_> = recorded.chain(floats).chain(rationals).collect();
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
                "{path} is not registered: add a line `\"symbol\" = {path}(system, …);` with the symbols of its \
                 arguments to `formulas!` at the beginning of src/claims/{module}.rs"
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

/// Returns the claims of a section's source, without the list of its formulas.
fn claimed(section: &str) -> String {
    let text = source(&format!("src/claims/{section}.rs"));
    let list = text.split_once("formulas! {").and_then(|(_, rest)| rest.split_once("\n}"));
    // The list of formulas contains no claims.
    assert!(
        list.is_some() == modules().iter().any(|m| m == section),
        "the list of {section}.rs is not found"
    );
    list.map_or(text.clone(), |(list, _)| text.replace(list, ""))
}

#[test]
fn every_function_occurs_in_a_claim() {
    let sections = modules().into_iter().chain(["notes", "hypotheses"].map(String::from));
    let mut texts: BTreeMap<String, String> = sections.map(|name| (name.clone(), claimed(&name))).collect();
    texts.insert("experiments".to_string(), source("src/verify/experiments.rs"));
    let is_part_of_name = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let is_unclaimed = |Item { path, .. }: &Item| {
        let (module, name) = path.split_once("::").unwrap();
        // In its own section a function is called by its name alone.
        let own = format!("{name}(");
        let mut by_name = texts[module].match_indices(&own);
        let by_name = by_name.any(|(i, _)| !texts[module][..i].ends_with(is_part_of_name));
        !by_name && !texts.values().any(|text| text.contains(&format!("{path}(")))
    };
    assert_none(functions().into_iter().filter(is_unclaimed).map(|Item { path, .. }| {
        format!(
            "no claim contains {path}: call it in `.claims([…])` of the entry that names it, in src/claims, or in \
             src/verify/experiments.rs"
        )
    }));
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

/// Asserts the status of every claim; the others are named with the command that shows them.
fn assert_all(report: &Report, otherwise: &str, has_status: impl Fn(Status) -> bool) {
    let problems = report.rows.iter().filter(|row| !has_status(row.status)).map(|row| {
        let Row { equation, claim, status, scalar, .. } = row;
        let method = scalar.map_or("the proof".to_string(), |scalar| scalar.to_string());
        format!("{equation} {claim}: {status} in {method}: cargo run --release -- verify '{equation}'")
    });
    let problems: Vec<_> = problems.collect();
    assert!(problems.is_empty(), "claims {otherwise}: {problems:#?}");
    assert!(report.rows.len() > 4 * entries().len(), "only {} rows", report.rows.len());
}

#[test]
fn every_claim_holds_in_every_number_system() {
    let scalars = vec![
        NumberSystem::F32,
        NumberSystem::F64,
        NumberSystem::Mpfr(24),
        NumberSystem::Mpfr(777),
        NumberSystem::Exact,
    ];
    for seed in [7, 99] {
        let report =
            verify(&Options { scalars: scalars.clone(), cases: 50, seed, equations: vec![] }, &|_, _| ());
        assert_all(&report, "that are not proved or do not hold", |status| {
            matches!(status, Status::Proved | Status::Held)
        });
        for n in 1..=33 {
            let number = format!("1.{n}");
            for scalar in &scalars[..4] {
                let found =
                    report.rows.iter().any(|row| row.equation == number && row.scalar == Some(*scalar));
                assert!(
                    found,
                    "({number}) has no claim in {scalar}: add a claim without rounding to its entry"
                );
            }
        }
    }
}

#[test]
fn by_default_every_claim_is_decided_in_every_number_system() {
    let report = verify(&Options::default(), &|_, _| ());
    assert_all(&report, "that fail or are undecided", |status| {
        !matches!(status, Status::Undecided | Status::Failed)
    });
    assert!(report.is_decided() && report.holds());
}

#[test]
fn rounding_errors_attain_a_good_part_of_their_bounds() {
    // If bounds were far too wide, the claims would be vacuous.
    let options = Options { scalars: vec![NumberSystem::F64], cases: 200, ..Options::default() };
    let report = verify(&options, &|_, _| ());
    let measured: Vec<_> =
        report.rows.iter().filter(|row| row.kind == "equal" && row.scalar.is_some()).collect();
    let tight =
        measured.iter().filter(|row| row.worst.as_ref().is_some_and(|(ratio, _)| *ratio > 0.05)).count();
    assert!(2 * tight > measured.len(), "{tight} of {} claims use 5 % of their bound", measured.len());
}

/// Returns the files below a folder as paths in the project.
fn files(folder: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap());
    let of = |entry: fs::DirEntry| {
        let path = format!("{folder}/{}", entry.file_name().to_str().unwrap());
        if entry.path().is_dir() { files(&path) } else { vec![path] }
    };
    entries.flat_map(of).collect()
}

/// Returns the files of the library, the engine and the command in one of their folders. The packed crate has
/// only its own.
fn of_all(folder: &str) -> Vec<String> {
    let others = if is_packed() { [].as_slice() } else { &["engine", "command"] };
    let others = others.iter().flat_map(|package| files(&format!("{package}/{folder}")));
    files(folder).into_iter().chain(others).collect()
}

/// A file without a `mod` is never compiled, and its tests never fail.
#[test]
fn every_file_belongs_to_a_module() {
    let (mut paths, tests) = (of_all("src"), of_all("tests"));
    // What stands beside a `main.rs` belongs to its target.
    let targets: Vec<_> = tests.iter().filter_map(|path| path.strip_suffix("main.rs")).collect();
    paths.extend(tests.iter().filter(|path| targets.iter().any(|target| path.starts_with(target))).cloned());
    let modules = paths.iter().filter_map(|path| path.strip_suffix("/mod.rs").or(path.strip_suffix(".rs")));
    let modules: Vec<_> =
        modules.filter(|path| !["/lib", "/main"].iter().any(|end| path.ends_with(end))).collect();
    // The packed crate has neither the engine's nor the command's.
    assert!(modules.len() > if is_packed() { 60 } else { 150 }, "the scan finds {} modules", modules.len());
    assert_none(modules.into_iter().filter_map(|path| {
        let (folder, name) = path.rsplit_once('/')?;
        let parents = [".rs", "/mod.rs", "/lib.rs", "/main.rs"].map(|end| format!("{folder}{end}"));
        let declares = |path: &String| {
            let text = fs::read_to_string(root().join(path)).unwrap_or_default();
            text.lines().any(|line| !line.starts_with("//") && line.ends_with(&format!("mod {name};")))
        };
        (!parents.iter().any(declares)).then(|| format!("{path}: say `mod {name};` in one of {parents:?}"))
    }));
}

/// An untested number system could compute anything.
#[test]
fn every_number_system_is_tested_for_the_laws() {
    if is_packed() {
        return eprintln!("the number systems are in another crate");
    }
    let text = |folder: &str| files(folder).iter().map(|path| source(path)).collect::<String>();
    let (numbers, laws) = (text("engine/tests/numbers"), source("tests/solver/laws.rs"));
    let ours = text("engine/src/number") + &source("src/solver/exact/scalar.rs");
    let name = |rest: &str| rest.split(['<', ' ', ';']).next().unwrap_or_default().to_string();
    let implementing = |what: &str| -> BTreeSet<String> {
        let implemented = ours.lines().filter(|line| line.starts_with("impl"));
        implemented.filter_map(|line| Some(name(line.split_once(what)?.1))).collect()
    };
    let (fields, scalars) = (implementing(" Field for "), implementing(" Scalar for "));
    assert!(fields.len() > 4 && !scalars.is_empty(), "{fields:?} {scalars:?}");
    let mut tried: BTreeSet<_> =
        numbers.lines().filter_map(|line| line.trim().strip_prefix("type Number = ").map(name)).collect();
    tried.insert("Tree".to_string()); // a formula, not a number
    let held: BTreeSet<_> = laws.split(|c: char| !c.is_alphanumeric()).map(String::from).collect();
    let untried = fields.difference(&tried);
    let untried = untried.map(|field| format!("{field}: no `type Number = {field}` in engine/tests/numbers"));
    let lawless = scalars.difference(&held).map(|scalar| format!("{scalar}: not in tests/solver/laws.rs"));
    assert_none(untried.chain(lawless));
}

#[test]
fn no_line_of_the_source_has_more_than_110_characters() {
    let files = of_all("src");
    assert!(files.len() > 70, "the scan of src finds {} files", files.len());
    assert_none(files.iter().flat_map(|path| {
        // rustfmt breaks code, but neither strings nor comments.
        let text = source(path);
        let long = text.lines().zip(1..).filter(|(line, _)| line.chars().count() > 110);
        let problem =
            |(line, number)| format!("{path}:{number} has more than 110 characters; break it: {line}");
        long.map(problem).collect::<Vec<_>>()
    }));
}

#[test]
fn no_file_of_the_source_has_more_than_450_lines() {
    for path in of_all("src") {
        let lines = source(&path).lines().count();
        assert!(lines <= 450, "{path} has {lines} lines, more than 450: split it");
    }
}

/// First words of documentation that does not name its subject.
const WEAK_OPENINGS: [&str; 13] =
    ["What", "How", "Where", "Which", "Why", "Who", "So", "Those", "Does", "Is", "Are", "May", "Can"];

/// Names that were replaced by standard terms.
const RETIRED_NAMES: [&str; 24] = [
    "Why",
    "How",
    "Says",
    "Given",
    "Paper",
    "Supposed",
    "Because",
    "Inexact",
    "LeftOut",
    "Flip",
    "Needless",
    "within_reach",
    "augmentations_promised",
    "augmentations_needed",
    "bits_needed",
    "underflow_unit",
    "enlarged",
    "mistaken_for",
    "supposed",
    "told",
    "amiss",
    "take_in",
    "needless",
    "is_unit",
];

/// The documentation begins with a statement, and retired names are not declared again.
#[test]
fn documentation_and_names_are_plain() {
    let mut blocks = 0;
    let mut problems = Vec::new();
    for path in of_all("src").iter().filter(|path| path.ends_with(".rs")) {
        let text = source(path);
        let doc = |line: &str| {
            let line = line.trim_start();
            let rest = line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))?;
            Some(rest.trim().to_string())
        };
        let lines: Vec<_> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            let at = format!("{path}:{}", i + 1);
            if let Some(first) = doc(line).filter(|_| i == 0 || doc(lines[i - 1]).is_none()) {
                blocks += 1;
                let paragraph = lines[i..].iter().map_while(|line| doc(line).filter(|line| !line.is_empty()));
                let word = first.split_whitespace().next().unwrap_or_default();
                if WEAK_OPENINGS.contains(&word) {
                    problems.push(format!("{at}: the documentation begins with {word:?}; name its subject"));
                }
                if paragraph.last().is_some_and(|last| last.ends_with('?')) {
                    problems.push(format!("{at}: the documentation is a question; state the answer"));
                }
            }
            let words: Vec<_> = line.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
            let declared = words.windows(2).filter(|pair| {
                ["fn", "struct", "enum", "trait", "type", "const", "mod", "let"].contains(&pair[0])
            });
            for name in declared.map(|pair| pair[1]).filter(|name| RETIRED_NAMES.contains(name)) {
                problems.push(format!("{at}: {name} is a retired name"));
            }
        }
    }
    assert!(blocks > 1000, "the scan of src finds {blocks} blocks of documentation");
    assert_none(problems);
}

#[test]
fn every_seeded_fault_applies() {
    if is_packed() {
        return eprintln!("the seeded faults are only in the repository");
    }
    // A patch whose context is not found would change nothing.
    for name in patches() {
        let patch = format!("tests/seeded_faults/{name}.patch");
        let text = source(&patch);
        let files: Vec<_> = text.lines().filter_map(|line| line.strip_prefix("--- a/")).collect();
        let [file] = files[..] else { panic!("{patch} edits {} files, and must edit one", files.len()) };
        let file = file.split('\t').next().unwrap();
        let target = source(file);
        let hunks: Vec<_> =
            text.split("\n@@ ").skip(1).map(|hunk| hunk.split_once('\n').unwrap().1).collect();
        assert!(!hunks.is_empty(), "{patch} edits nothing");
        for hunk in hunks {
            let before = hunk.lines().filter(|line| !line.starts_with('+') && !line.starts_with('\\'));
            let before: Vec<_> = before.map(|line| line.get(1..).unwrap_or("")).collect();
            assert!(
                target.contains(&before.join("\n")),
                "{patch} no longer applies to {file}: make the same mistake by hand, and write the patch with \
                 `git diff {file} > {patch}`"
            );
        }
    }
}

/// Returns the names of the seeded faults.
fn patches() -> BTreeSet<String> {
    let names = files("tests/seeded_faults").into_iter();
    let names = names
        .filter_map(|path| Some(path.strip_suffix(".patch")?["tests/seeded_faults/".len()..].to_string()));
    let names: BTreeSet<_> = names.collect();
    assert!(names.len() > 100, "the scan of tests/seeded_faults finds {} patches", names.len());
    names
}

/// `tests/seeded_faults/run` records which test detects which fault.
#[test]
fn every_seeded_fault_is_detected_by_an_existing_test() {
    if is_packed() {
        return eprintln!("the seeded faults are only in the repository");
    }
    let (patches, mut detected) = (patches(), BTreeSet::new());
    let text = of_all("src").into_iter().chain(of_all("tests")).chain(files("book/tool")).collect::<Vec<_>>();
    let text: Vec<_> =
        text.iter().filter(|path| path.ends_with(".rs")).map(|path| (path, source(path))).collect();
    let listed = source("tests/seeded_faults/detected_by");
    for line in listed.lines() {
        let [name, target, test] = line.splitn(3, ' ').collect::<Vec<_>>()[..] else { panic!("{line}") };
        let again = format!("tests/seeded_faults/run tests/seeded_faults/{name}.patch");
        assert!(
            patches.contains(name),
            "tests/seeded_faults/detected_by has {name}, which is not a patch: remove its lines"
        );
        if target == "-" {
            continue;
        }
        detected.insert(name.to_string());
        // An example in the docs is named by its file, and an aborted run has no name; a test that is generated
        // for several number systems is a module.
        let (module, function) = test.rsplit_once("::").unwrap_or(("", test));
        let (function, module) = (format!("fn {function}("), module.rsplit("::").next().unwrap());
        let is_of_target = |path: &str| match target {
            "lib" => path.starts_with("src/"),
            "provable" => path.starts_with("engine/src/"),
            "bin" => path.starts_with("command/src/"),
            _ => [format!("tests/{target}.rs"), format!("tests/{target}/")]
                .iter()
                .any(|own| path.contains(own)),
        };
        let written = |name: &str| text.iter().any(|(path, text)| is_of_target(path) && text.contains(name));
        let exists = ["doc", "book-tool"].contains(&target)
            || test == "(no result)"
            || written(&function)
            || written(&format!("fn {module}<"))
            || written(&format!("fn {module}("));
        assert!(
            exists,
            "tests/seeded_faults/detected_by: {name} is detected by {test}, which is not a test of {target}: {again}"
        );
    }
    let missing: Vec<_> = patches.difference(&detected).collect();
    assert!(
        missing.is_empty(),
        "`tests/seeded_faults/run --first` adds {missing:?} to tests/seeded_faults/detected_by, or finds that no test \
         detects them"
    );
}

/// Every target that could detect a mistake belongs to a layer.
#[test]
fn every_test_target_has_a_layer() {
    if is_packed() {
        return eprintln!("the seeded faults are only in the repository");
    }
    let run = source("tests/seeded_faults/run");
    let map = run.split_once("\nlayers='").and_then(|(_, rest)| rest.split_once('\'')).unwrap().0;
    let listed: BTreeSet<_> = map.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let mut seen = 0;
    for path in of_all("tests").into_iter().chain(files("book/tool/tests")) {
        let path = ["book/tool/", "engine/", "command/"]
            .iter()
            .fold(path.as_str(), |path, of| path.trim_start_matches(of));
        let path = path.trim_start_matches("tests/");
        let target = path.strip_suffix("/main.rs").or(path.strip_suffix(".rs"));
        if let Some(target) = target.filter(|target| !target.contains('/')) {
            assert!(
                listed.contains(target),
                "tests/seeded_faults/run: the list `layers` lacks the target {target}"
            );
            seen += 1;
        }
    }
    assert!(seen > 20, "the scan finds {seen} targets");
    // The targets that `--first` prefers for a file are listed as well.
    let preferred = run.split_once("\nclosest() {").and_then(|(_, rest)| rest.split_once("\n}")).unwrap().0;
    let preferred: Vec<_> =
        preferred.split(") echo ").skip(1).filter_map(|line| line.split(' ').next()).collect();
    assert!(preferred.len() > 2, "{preferred:?}");
    for target in preferred {
        assert!(
            listed.contains(target),
            "tests/seeded_faults/run: `closest` prefers {target}, which the list `layers` lacks"
        );
    }
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

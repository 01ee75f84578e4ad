//! Calls of Coq and checks of its output, for the tests of both packages.

use provable::proof::coq::{Development, File};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::{fs, thread};

/// Returns a text without comments.
pub fn code(text: &str) -> String {
    let (mut depth, mut code) = (0, String::new());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match (c, rest.peek()) {
            ('(', Some('*')) => {
                rest.next();
                depth += 1;
            }
            ('*', Some(')')) if depth > 0 => {
                rest.next();
                depth -= 1;
            }
            _ if depth == 0 => code.push(c),
            _ => {}
        }
    }
    code
}

/// The axioms of Coq's real numbers, the only ones allowed.
const AXIOMS: [&str; 4] = [
    // For a decidable property of natural numbers, either all have it or one is found that does not have it:
    // this makes Dedekind cuts comparable.
    "ClassicalDedekindReals.sig_forall_dec",
    // ¬P is decidable: a cut is an arbitrary set.
    "ClassicalDedekindReals.sig_not_dec",
    // Functions with the same values are equal; cuts are functions.
    "FunctionalExtensionality.functional_extensionality_dep",
    // Excluded middle: Coquelicot's limits and derivatives are those of classical analysis.
    "Classical_Prop.classic",
];

pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// Returns the names that a keyword introduces.
pub fn named<'t>(text: &'t str, keyword: &str) -> Vec<&'t str> {
    let all: Vec<_> = words(text).collect();
    all.windows(2).filter(|pair| pair[0] == keyword).map(|pair| pair[1]).collect()
}

/// File of the definitions.
pub const DEFINITIONS: &str = "B_Definitions.v";

pub fn of_claims(files: &[File]) -> impl Iterator<Item = &File> {
    files.iter().filter(|file| file.name.starts_with("C_"))
}

/// Returns a directory for one test.
pub fn scratch(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("coq-{name}"));
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// Returns the version of Coq, which has to be installed.
fn version() -> String {
    let output = Command::new("coqc").arg("--version").output();
    let output = output.expect("coqc, which ./setup --provers installs");
    assert!(output.status.success(), "{output:?}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Compiles a file of a library and returns its output, or its error.
pub fn compile(directory: &Path, library: &str, file: &str) -> Result<String, String> {
    // Coquelicot prints a warning about a coercion of its own.
    let output =
        Command::new("coqc").args(["-w", "none", "-R", ".", library, file]).current_dir(directory).output();
    let output = output.unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
    if output.status.success() { Ok(text(output.stdout)) } else { Err(text(output.stderr)) }
}

/// Runs all jobs, two at a time, in their order.
pub fn two_at_a_time<J: Sync, R: Send>(jobs: &[J], work: impl Fn(&J) -> R + Sync) -> Vec<R> {
    let (next, done) = (Mutex::new(0..jobs.len()), Mutex::new(Vec::new()));
    thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let Some(i) = next.lock().unwrap().next() else { break };
                    let result = work(&jobs[i]);
                    done.lock().unwrap().push((i, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap();
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Returns the names of axioms in the output of `Print Assumptions`.
fn axioms(printed: &str) -> BTreeSet<&str> {
    let (_, list) = printed.split_once("Axioms:").unwrap_or_default();
    let names = list.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_alphabetic()));
    names.filter_map(|line| line.split_whitespace().next()).collect()
}

/// Returns the files that a file requires.
fn needs(library: &str, file: &File) -> Vec<String> {
    let (text, from) = (code(&file.text), format!("From {library} Require"));
    let required = text.split(&from).skip(1).filter_map(|rest| rest.split(".\n").next());
    let names = required.flat_map(words).filter(|word| *word != "Import");
    names.map(|name| format!("{name}.v")).collect()
}

/// Asserts that Coq accepts all files. Files that were accepted and have not changed, nor what they require,
/// are not compiled again.
pub fn accepts(name: &str, library: &str, development: &Development) {
    let version = version();
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("coq-{name}"));
    let mark = |file: &File| directory.join(&file.name).with_extension("accepted");
    let marked = |file: &File| format!("{version}{library}\n{}", file.text);
    let mut done: BTreeSet<String> = BTreeSet::new();
    let mut files = development.files();
    files.retain(|file| {
        let accepted = fs::read_to_string(mark(file)).is_ok_and(|before| before == marked(file));
        let stays = accepted && needs(library, file).iter().all(|name| done.contains(name));
        if stays {
            done.insert(file.name.clone());
        } else {
            let _ = fs::remove_file(mark(file));
        }
        !stays
    });
    development.write(&directory).unwrap();
    while !files.is_empty() {
        let ready = |file: &File| needs(library, file).iter().all(|name| done.contains(name));
        let (mut now, later): (Vec<_>, Vec<_>) = files.into_iter().partition(ready);
        // The longest files first, so that none is left alone at the end.
        now.sort_by_key(|file| std::cmp::Reverse(file.text.len()));
        assert!(!now.is_empty(), "{:?} import each other", later.iter().map(|f| &f.name).collect::<Vec<_>>());
        let results = two_at_a_time(&now, |file| compile(&directory, library, &file.name));
        for (file, result) in now.iter().zip(results) {
            let printed = result.unwrap_or_else(|error| panic!("{error}"));
            let axioms = axioms(&printed);
            assert_eq!(
                !axioms.is_empty(),
                file.text.contains("Print Assumptions"),
                "{}: {printed}",
                file.name
            );
            let unknown: Vec<_> = axioms.iter().filter(|axiom| !AXIOMS.contains(axiom)).collect();
            assert!(unknown.is_empty(), "new axioms: {unknown:?}");
            fs::write(mark(file), marked(file)).unwrap();
            done.insert(file.name.clone());
        }
        files = later;
    }
}

//! Wrong formulas tested with the command: the reaction of `contact` to a mistake in the source of
//! `src/chapter`.
//!
//! Every generated mutation is made as an edit of the source, all of them in one copy of the project: an
//! edited operation is a `match` on the number of the active edit. So a single build serves for all, and each
//! run is the command with one mistake.
#![cfg(feature = "prover")]

use proc_macro2::LineColumn;
use spring_mass_contact::claims::{registry, statements};
use spring_mass_contact::proof::mutation::{Mutant, Mutation, MutationOutcome, mutants, test_mutations};
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;
use std::io::{Read, Write as _};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{env, fs, thread};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, UnOp};
use wait_timeout::ChildExt;

/// A place in a source file as the compiler counts: line and column from 1, and the rank within a chain.
type Place = (u32, u32, u32);

/// An operation in the source.
struct Written {
    range: Range<usize>,
    what: Kind,
}

enum Kind {
    Binary {
        a: Range<usize>,
        operator: Range<usize>,
        b: Range<usize>,
    },
    Negated {
        a: Range<usize>,
    },
    /// A call `a.name(b)`, or `a.name()`.
    Method {
        a: Range<usize>,
        b: Option<Range<usize>>,
    },
    /// `T::zero()`, `T::one()`, `T::int(n)`.
    Integer,
}

/// The operations of a file.
struct Steps<'a> {
    lines: Vec<usize>,
    text: &'a str,
    found: BTreeMap<Place, Written>,
}

impl<'a> Steps<'a> {
    fn of(text: &'a str) -> Self {
        let lines = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let mut steps = Steps { lines, text, found: BTreeMap::new() };
        steps.visit_file(&syn::parse_file(text).expect("a source file"));
        steps
    }

    fn offset(&self, at: LineColumn) -> usize {
        let line = self.lines[at.line - 1];
        line + self.text[line..].chars().take(at.column).map(char::len_utf8).sum::<usize>()
    }

    fn range(&self, of: &impl Spanned) -> Range<usize> {
        self.offset(of.span().start())..self.offset(of.span().end())
    }

    /// Returns the number of inner operations that begin at the same place; `None` if it is not an operation.
    fn rank(expr: &Expr) -> Option<u32> {
        let start = expr.span().start();
        match without_parentheses(expr) {
            Expr::Binary(e) => {
                let inner = if e.left.span().start() == start { Self::rank(&e.left) } else { None };
                Some(inner.map_or(0, |rank| rank + 1))
            }
            Expr::Unary(_) => Some(0),
            Expr::Call(call) if is_integer(call) => Some(0),
            _ => None,
        }
    }

    fn add(&mut self, at: LineColumn, rank: u32, range: Range<usize>, what: Kind) {
        let place = (at.line as u32, at.column as u32 + 1, rank);
        self.found.insert(place, Written { range, what });
    }
}

fn without_parentheses(mut expr: &Expr) -> &Expr {
    while let Expr::Paren(paren) = expr {
        expr = &paren.expr;
    }
    expr
}

fn is_integer(call: &syn::ExprCall) -> bool {
    let Expr::Path(path) = &*call.func else { return false };
    let names: Vec<_> = path.path.segments.iter().map(|s| s.ident.to_string()).collect();
    matches!(names.iter().map(String::as_str).collect::<Vec<_>>()[..], ["T", "zero" | "one" | "int"])
}

impl Visit<'_> for Steps<'_> {
    fn visit_expr(&mut self, expr: &Expr) {
        // For the compiler an expression in parentheses begins with them.
        let within = without_parentheses(expr);
        let (start, range) = (expr.span().start(), self.range(within));
        match within {
            Expr::Binary(e)
                if matches!(e.op, BinOp::Add(_) | BinOp::Sub(_) | BinOp::Mul(_) | BinOp::Div(_)) =>
            {
                let [a, b] = [&e.left, &e.right].map(|operand| self.range(operand));
                let what = Kind::Binary { a, operator: self.range(&e.op), b };
                self.add(start, Self::rank(expr).unwrap_or(0), range, what);
            }
            Expr::Unary(e) if matches!(e.op, UnOp::Neg(_)) => {
                let what = Kind::Negated { a: self.range(&e.expr) };
                self.add(start, 0, range, what);
            }
            Expr::MethodCall(e) => {
                let b = e.args.first().map(|b| self.range(b));
                let what = Kind::Method { a: self.range(&e.receiver), b };
                self.add(e.method.span().start(), 0, range, what);
            }
            Expr::Call(e) if is_integer(e) => self.add(start, 0, range, Kind::Integer),
            _ => {}
        }
        visit::visit_expr(self, within);
    }
}

/// Returns the source of a mutated operation; `None` if a name is not available there.
fn edited(text: &str, step: &Written, what: Mutation) -> Option<String> {
    let source = |range: &Range<usize>| &text[range.clone()];
    let own = |range: &Range<usize>| format!("({}).clone()", source(range));
    Some(match (&step.what, what) {
        (Kind::Binary { a, operator, b }, Mutation::Opposite(_)) => {
            let opposite = match source(operator) {
                "+" => "-",
                "-" => "+",
                "*" => "/",
                _ => "*",
            };
            format!("({}) {opposite} ({})", source(a), source(b))
        }
        (Kind::Binary { a, operator, b }, Mutation::Swap(_)) => {
            format!("({}) {} ({})", source(b), source(operator), source(a))
        }
        (Kind::Binary { a, .. } | Kind::Method { a, .. }, Mutation::FirstOperand(_)) => own(a),
        (Kind::Binary { b, .. } | Kind::Method { b: Some(b), .. }, Mutation::SecondOperand(_)) => own(b),
        (Kind::Method { a, b: Some(b) }, Mutation::Maximum) => format!("-((-{}).min(&-{}))", own(a), own(b)),
        (Kind::Negated { a }, Mutation::DropSign) => own(a),
        (Kind::Method { a, b: None }, Mutation::DropPositivePart) => own(a),
        (Kind::Method { a, b: None }, Mutation::NegateExponent) => format!("(-{}).exp()", own(a)),
        (Kind::Integer, Mutation::Integer(_, to)) => format!("T::int({to})"),
        (Kind::Binary { a, operator, b }, Mutation::Symbol(place, _, to)) => {
            let name = known(text, step, to)?;
            let [a, b] = [(0, a), (1, b)].map(|(i, own)| if i == place { name } else { source(own) });
            format!("({a}) {} ({b})", source(operator))
        }
        (Kind::Negated { .. }, Mutation::Symbol(_, _, to)) => format!("-({})", known(text, step, to)?),
        _ => return None,
    })
}

/// Returns the name of a quantity in the function around an operation, if it has one.
fn known(text: &str, step: &Written, symbol: &str) -> Option<&'static str> {
    let head = &text[..step.range.start];
    let function = &head[head.rfind("\npub fn ")?..];
    let name = ["c", "l", "h", "eps"].into_iter().find(|name| *name == symbol.to_lowercase());
    let (name, place) = match symbol {
        "ε" => ("eps", function.split(')').next()),
        _ => (name?, function.rsplit("let SpringMass {").next().filter(|rest| rest.contains("} = system"))),
    };
    let names = place?.split('}').next()?;
    names.split(|c: char| !c.is_alphanumeric()).any(|word| word == name).then_some(name)
}

/// Returns the file with a switch at each edited operation.
fn switched(
    text: &str,
    steps: &BTreeMap<Place, Written>,
    edits: &BTreeMap<Place, Vec<(usize, String)>>,
) -> String {
    // From the inside out: what is rewritten moves only what comes after it.
    let mut order: Vec<_> = edits.keys().filter_map(|place| Some((place, steps.get(place)?))).collect();
    order.sort_by_key(|(place, step)| {
        (step.range.start, std::cmp::Reverse(step.range.end), std::cmp::Reverse(place.2))
    });
    render(text, &order, edits, 0..text.len())
}

fn render(
    text: &str,
    steps: &[(&Place, &Written)],
    edits: &BTreeMap<Place, Vec<(usize, String)>>,
    range: Range<usize>,
) -> String {
    let (mut out, mut at, mut rest) = (String::new(), range.start, steps);
    while let [(place, step), inner @ ..] = rest {
        let within = inner.iter().take_while(|(_, other)| other.range.end <= step.range.end).count();
        let (inner, after) = inner.split_at(within);
        out += &text[at..step.range.start];
        out += "(match crate::active_edit() { ";
        for (number, edited) in &edits[*place] {
            let _ = write!(out, "{number} => {{ {} }} ", edited);
        }
        let _ = write!(out, "_ => {{ {} }} }})", render(text, inner, edits, step.range.clone()));
        (at, rest) = (step.range.end, after);
    }
    out + &text[at..range.end]
}

/// Source of the switches.
const SWITCH: &str = r#"

#[doc(hidden)]
pub fn active_edit() -> usize {
    static ACTIVE: std::sync::LazyLock<usize> =
        std::sync::LazyLock::new(|| std::env::var("ACTIVE_EDIT").map_or(0, |n| n.parse().unwrap()));
    *ACTIVE
}
"#;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns a copy of the project in which every edit is a switch, numbered from 1, with the edits in it and
/// the remaining ones.
fn copy() -> (PathBuf, Vec<Mutant>, Vec<Mutant>) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("edits");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let listing = ["ls-files", "-z", "--cached", "--others", "--exclude-standard"];
    let tracked = Command::new("git").args(listing).current_dir(root()).output().unwrap().stdout;
    for name in String::from_utf8(tracked).unwrap().split_terminator('\0') {
        let (from, to) = (root().join(name), folder.join(name));
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(from, to).unwrap();
    }
    let (mut made, mut left) = (Vec::new(), Vec::new());
    let mut files: BTreeMap<&str, Vec<Mutant>> = BTreeMap::new();
    for change in mutants(&statements(), registry()) {
        files.entry(change.site.file).or_default().push(change);
    }
    for (file, all) in files {
        let text = fs::read_to_string(root().join(file)).unwrap();
        let steps = Steps::of(&text);
        let mut edits: BTreeMap<Place, Vec<(usize, String)>> = BTreeMap::new();
        for change in all {
            let place = (change.site.line, change.site.column, change.site.rank);
            match steps.found.get(&place).and_then(|step| edited(&text, step, change.mutation)) {
                Some(edited) => {
                    made.push(change);
                    edits.entry(place).or_default().push((made.len(), edited));
                }
                // The steps of |x| are written elsewhere.
                None if is_size(&text, &change) => {}
                None => left.push(change),
            }
        }
        let switched = "#![allow(unused_parens)]\n".to_string() + &switched(&text, &steps.found, &edits);
        fs::write(folder.join(file), switched).unwrap();
    }
    let lib = folder.join("src/lib.rs");
    fs::write(&lib, fs::read_to_string(&lib).unwrap() + SWITCH).unwrap();
    (folder, made, left)
}

/// Result of a run.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
    time: Duration,
}

/// Runs the command with one edit, and ends it without a code after a time limit.
fn run(binary: &Path, arguments: &[String], edit: usize, limit: Duration) -> Run {
    let start = Instant::now();
    let mut command = Command::new(binary);
    command.args(arguments);
    command.env("ACTIVE_EDIT", edit.to_string()).env("COLUMNS", "80").stdin(Stdio::null());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let read = |mut pipe: Box<dyn Read + Send>| {
        thread::spawn(move || {
            let mut text = String::new();
            let _ = pipe.read_to_string(&mut text);
            text
        })
    };
    let stdout = read(Box::new(child.stdout.take().unwrap()));
    let stderr = read(Box::new(child.stderr.take().unwrap()));
    let status = child.wait_timeout(limit).unwrap();
    if status.is_none() {
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let [stdout, stderr] = [stdout, stderr].map(|thread| thread.join().unwrap());
    Run { code: status.and_then(|status| status.code()), stdout, stderr, time: start.elapsed() }
}

/// Returns the function of a mutant as `module::name`.
fn function(change: &Mutant) -> String {
    let text = fs::read_to_string(root().join(change.site.file)).unwrap();
    let before: Vec<_> = text.lines().take(change.site.line as usize).collect();
    let head = before.iter().rev().find_map(|line| line.strip_prefix("pub fn ")).unwrap();
    let module = Path::new(change.site.file).file_stem().unwrap().to_str().unwrap();
    format!("{module}::{}", head.split(['<', '(']).next().unwrap())
}

/// Returns `true` if the operation belongs to `x.abs()`.
fn is_size(text: &str, change: &Mutant) -> bool {
    let line = text.lines().nth(change.site.line as usize - 1).unwrap();
    line.chars().skip(change.site.column as usize - 1).collect::<String>().starts_with("abs()")
}

/// Returns the first finding of a report.
fn first_finding(stdout: &str) -> Option<&str> {
    let findings = [": most likely wrong", " NOT PROVED", " FAILED in "];
    stdout.lines().find(|line| findings.iter().any(|finding| line.contains(finding)))
}

/// Returns the arguments of the commands printed below failures.
fn commands(stdout: &str) -> Vec<Vec<String>> {
    let text = stdout.replace(" \\\n      ", " ");
    let lines = text.lines().filter_map(|line| line.strip_prefix("  contact "));
    let arguments = |line: &str| line.split(' ').map(String::from).collect::<Vec<_>>();
    let commands: std::collections::BTreeSet<_> = lines.map(arguments).collect();
    commands.into_iter().collect()
}

/// Returns `true` if a solve in rationals fails, or its solution violates its bounds, equilibrium or the
/// contact conditions of its method.
fn is_wrong(solve: &Run) -> bool {
    let Ok(answer) = serde_json::from_str::<serde_json::Value>(&solve.stdout) else { return true };
    let quantities = ["deflection", "penetration", "contact_force"];
    let exact = |quantity: &str| [0, 1].iter().all(|end| answer["bounds"][quantity][end] == answer[quantity]);
    let conditions: &[&str] = match answer["method"].as_str() {
        Some("penalty") => &["stationarity", "dual"],
        _ => &["stationarity", "primal", "dual", "complementarity"],
    };
    !quantities.into_iter().all(exact) || conditions.iter().any(|name| answer["kkt"][name] != "0")
}

/// Time limit of a report, unless the machine is too slow for it.
const LIMIT: Duration = Duration::from_secs(10);

/// A sample of a hundred mutations, or of `EDITS`.
#[test]
#[ignore = "builds a copy of the project and runs it many times: some minutes"]
fn mistakes_in_formulas_are_reported_in_time() {
    let (folder, made, left) = copy();
    let left: Vec<_> = left.iter().map(Mutant::to_string).collect();
    say(&format!("{} edits; the source has no place for {left:#?}", made.len()));
    assert!(20 * left.len() < made.len(), "an edit is made of nearly every change");
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("edits-target");
    let build = Command::new(env!("CARGO"))
        .args(["build", "--release", "--bin", "contact", "-p", "spring-mass-contact-cli", "--quiet"])
        .current_dir(&folder)
        .env("CARGO_TARGET_DIR", &target)
        .status();
    assert!(build.unwrap().success(), "the copy with its switches does not build");
    let binary = target.join("release/contact");
    let well = run(&binary, &[], 0, 10 * LIMIT);
    assert_eq!(well.code, Some(0), "without an edit: {}{}", well.stdout, well.stderr);
    // A report of failures takes about as long as one without.
    let limit = LIMIT.max(3 * well.time);

    let effects: HashMap<Mutant, MutationOutcome> =
        test_mutations(&statements(), registry()).mutants.into_iter().collect();
    let sample = env::var("EDITS").map_or(100, |count| count.parse().expect("a number of edits"));
    let stride = made.len().div_ceil(sample).max(1);
    let (mut times, mut amiss, mut elsewhere, mut solves) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for (i, change) in made.iter().enumerate().step_by(stride) {
        let result = run(&binary, &[], i + 1, limit);
        let finding = first_finding(&result.stdout);
        // Some edits are proved to change nothing.
        let wrong = !matches!(effects[change], MutationOutcome::Equivalent);
        let said = format!("{:.1?} {:?} {change}: {}", result.time, result.code, finding.unwrap_or("-"));
        say(&said);
        if result.code != Some(i32::from(wrong)) || !result.stderr.is_empty() || finding.is_some() != wrong {
            amiss.push(said.clone() + &result.stderr);
        }
        let last = result.stdout.trim_end().rsplit("\n\n").next().unwrap_or_default();
        if result.stdout.contains(": most likely wrong") && !last.contains(": most likely wrong") {
            amiss.push(said.clone() + ": the suspected function is not named last");
        }
        for mut arguments in commands(&result.stdout) {
            solves += 1;
            arguments.extend(["--format", "json"].map(String::from));
            if !is_wrong(&run(&binary, &arguments, i + 1, limit)) {
                amiss.push(format!("{said}: not reproduced by {arguments:?}"));
            }
        }
        let suspected = |line: &str| line.ends_with(&format!("{}: most likely wrong", function(change)));
        // What an edit leaves nothing but the call of another function is laid to that one.
        let leaves_an_operand =
            matches!(change.mutation, Mutation::FirstOperand(_) | Mutation::SecondOperand(_));
        if wrong && !leaves_an_operand && !result.stdout.lines().any(suspected) {
            elsewhere.push(said);
        }
        times.push(result.time);
    }
    times.sort_unstable();
    let (median, slowest) = (times[times.len() / 2], times[times.len() - 1]);
    say(&format!(
        "{} edits: {median:.1?} each, {slowest:.1?} at most; {solves} commands to solve; {} not found where they are",
        times.len(),
        elsewhere.len()
    ));
    assert!(amiss.is_empty(), "{amiss:#?}");
    // c − ε for c + ε makes a system that is solved wrongly.
    let of_sum = |change: &Mutant| {
        function(change) == "penalty::total_stiffness" && matches!(change.mutation, Mutation::Opposite(_))
    };
    let wrong_sum = made.iter().position(of_sum).expect("a sum");
    let report = run(&binary, &[], wrong_sum + 1, limit);
    assert!(!commands(&report.stdout).is_empty(), "no solve reproduces a failure: {}", report.stdout);
    assert!(20 * elsewhere.len() < times.len(), "named at another place: {elsewhere:#?}");
}

/// Prints past the test harness, which captures the output of passing tests.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

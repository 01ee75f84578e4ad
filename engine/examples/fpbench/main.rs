//! Bounds of rounding errors for every precision, compared with those of Gappa for one: formulas of FPBench.
//!
//! Prints a table in Markdown. Its columns are the number of operations; K, for which the error is proved to
//! be at most K/2ᵖ for every precision p ≥ 24; this bound in f64; the bound that Gappa computes for f64, if
//! it is installed, and the ratio of the two; the largest error of f64 at random points, compared with MPFR
//! with 200 bits; and the time for bound and proof.

mod formulas;

use formulas::{Benchmark, benchmarks};
use provable::formula::claim::PRECISION;
use provable::formula::{Hypothesis, Relation};
use provable::number::tree::{Op, piecewise_ops};
use provable::number::{Field, Mpfr, Tree};
use provable::proof::{RoundingBound, rounding_bound};
use std::collections::BTreeSet;
use std::error::Error;
use std::io::Write;
use std::process::{Command, Stdio};
use std::time::Instant;

/// Smallest precision, that of f32.
const LEAST_BITS: u32 = 24;

/// Number of random points at which errors are computed.
const POINTS: usize = 20_000;

fn main() -> Result<(), Box<dyn Error>> {
    if Command::new("gappa").arg("--version").output().is_err() {
        eprintln!("gappa is not installed: its column stays empty");
    }
    println!("| formula | operations | K | our bound in f64 | Gappa's | ratio | largest error seen | ms |");
    println!("|---|---|---|---|---|---|---|---|");
    for benchmark in benchmarks() {
        let start = Instant::now();
        let bound = bound(&benchmark)?;
        let time = start.elapsed().as_millis();
        let (constant, ours) = (bound.constant(), bound.constant() / 2.0_f64.powi(53));
        let (gappa, ratio) = gappa(&benchmark)?
            .map_or_else(Default::default, |gappa| (format!("{gappa:.2e}"), format_ratio(ours / gappa)));
        let Benchmark { name, .. } = benchmark;
        let (operations, seen) = (operations(&benchmark.formula.tree), largest_error(&benchmark));
        println!(
            "| {name} | {operations} | {constant} | {ours:.2e} | {gappa} | {ratio} | {seen:.2e} | {time} |"
        );
    }
    Ok(())
}

fn format_ratio(ratio: f64) -> String {
    if ratio < 0.005 { "< 0.01".to_string() } else { format!("{ratio:.2}") }
}

fn bound(benchmark: &Benchmark) -> Result<RoundingBound, Box<dyn Error>> {
    let least = Tree::symbol(PRECISION) - Tree::int(1 << LEAST_BITS);
    let mut hypotheses = benchmark.hypotheses();
    hypotheses.push(Hypothesis::new(Relation::NonNegative, least));
    Ok(rounding_bound(&benchmark.formula.tree, &Tree::int(1), &hypotheses)?)
}

/// Returns the number of different operations that round.
fn operations(tree: &Tree) -> usize {
    let mut all = BTreeSet::new();
    infix(tree, &mut |operation| {
        all.insert(operation.clone());
        format!("({operation})")
    });
    all.len()
}

/// Returns the largest distance of the value in f64 from that with 200 bits.
fn largest_error(benchmark: &Benchmark) -> f64 {
    let (tree, mut random) = (&benchmark.formula.tree, oorandom::Rand64::new(1));
    let errors = (0..POINTS).map(|_| {
        let mut at = |(lower, upper, over): &(i32, i32, i32)| {
            let [lower, upper] = [lower, upper].map(|n| f64::from(*n) / f64::from(*over));
            (lower + random.rand_float() * (upper - lower)).clamp(lower, upper)
        };
        let point: Vec<f64> = benchmark.ranges.iter().map(&mut at).collect();
        let place =
            |name| benchmark.formula.arguments.iter().position(|own| *own == name).expect("an argument");
        let computed = tree.eval(&|name| point[place(name)], &piecewise_ops).expect("no divisor is 0");
        let exact = tree
            .eval(&|name| Mpfr::rounded(200, point[place(name)]), &piecewise_ops)
            .expect("no divisor is 0");
        (exact - Mpfr::rounded(200, computed)).as_float().map_or(f64::NAN, |error| error.to_f64().abs())
    });
    errors.fold(0.0, f64::max)
}

/// Returns the bound of Gappa for f64; `None` if Gappa is not installed.
fn gappa(benchmark: &Benchmark) -> Result<Option<f64>, Box<dyn Error>> {
    let piped =
        Command::new("gappa").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
    let Ok(mut child) = piped else { return Ok(None) };
    child.stdin.take().ok_or("no input")?.write_all(script(benchmark).as_bytes())?;
    let output = String::from_utf8(child.wait_with_output()?.stderr)?;
    // Example of the output: `|m - e| in [0, 15b-46 {2.13163e-13, 2^(-42.0931)}]`.
    let upper = output.split_once(" in [").and_then(|(_, interval)| interval.split_once(", "));
    let upper = upper.map(|(_, upper)| upper.split_once('{').map_or(upper, |(_, value)| value));
    let number = upper.and_then(|upper| upper.split([',', ']', ' ']).next());
    Ok(Some(number.and_then(|number| number.parse().ok()).ok_or_else(|| format!("Gappa says {output}"))?))
}

/// Returns a script for Gappa with the exact and the rounded formula.
fn script(benchmark: &Benchmark) -> String {
    let Benchmark { formula, ranges, .. } = benchmark;
    let mut rounded = Vec::new();
    let result = infix(&formula.tree, &mut |operation| {
        let place = rounded.iter().position(|known| *known == operation).unwrap_or_else(|| {
            rounded.push(operation);
            rounded.len() - 1
        });
        format!("m{place}")
    });
    let exact = infix(&formula.tree, &mut |operation| format!("({operation})"));
    let inputs = formula.arguments.iter().map(|name| format!("{name} = rnd({name}0);\n"));
    let steps =
        rounded.iter().enumerate().map(|(place, operation)| format!("m{place} = rnd({operation});\n"));
    let intervals = formula.arguments.iter().zip(ranges).map(|(name, (lower, upper, over))| {
        format!(
            "{name} in [{}, {}]",
            f64::from(*lower) / f64::from(*over),
            f64::from(*upper) / f64::from(*over)
        )
    });
    let (definitions, intervals) =
        (inputs.chain(steps).collect::<String>(), intervals.collect::<Vec<_>>().join(" /\\ "));
    format!("@rnd = float<ieee_64, ne>;\n{definitions}{{ {intervals} -> |{result} - {exact}| in ? }}\n")
}

/// Writes a formula with infix operations; `operation` names each of them.
fn infix(tree: &Tree, operation: &mut impl FnMut(String) -> String) -> String {
    let parts: Vec<_> = tree.op().operands().map(|part| infix(part, operation)).collect();
    match tree.op() {
        Op::Symbol(name) => name.to_string(),
        Op::Int(n) => n.to_string(),
        Op::Neg(_) => format!("(-{})", parts[0]),
        Op::Add(..) => operation(parts.join(" + ")),
        Op::Sub(..) => operation(parts.join(" - ")),
        Op::Mul(..) => operation(parts.join(" * ")),
        Op::Div(..) => operation(parts.join(" / ")),
        step => unreachable!("no formula has {step:?}"),
    }
}

/// The columns of the table in the README that are independent of the machine are recomputed.
#[test]
fn the_table_in_the_readme_is_current() {
    let readme = include_str!("../../README.md");
    for benchmark in benchmarks() {
        let constant = bound(&benchmark).expect("a bound").constant();
        let row = format!("| {} | {} | {constant} |", benchmark.name, operations(&benchmark.formula.tree));
        assert!(readme.contains(&row), "{row}");
    }
}

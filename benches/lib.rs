//! Relative timing of two computations.

use criterion::{Criterion, Throughput};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// A comparison: the time of our computation relative to a reference timed in the same run.
pub struct Ratio {
    name: String,
    reference: &'static str,
    wanted: f64,
    /// Least times of the reference and of our computation, in nanoseconds.
    least: [f64; 2],
}

/// Number and duration of the alternating turns; the speed of a machine drifts over seconds.
const TURNS: usize = 100;
const TURN: Duration = Duration::from_millis(5);

impl Ratio {
    /// Times both computations, each call of which performs `things` operations. Criterion also reports the
    /// distribution of each time and its change since the last run.
    pub fn of<A, B>(
        criterion: &mut Criterion,
        name: impl Into<String>,
        (reference, many, mut raw): (&'static str, u64, impl FnMut() -> A),
        (own_many, mut own): (u64, impl FnMut() -> B),
        wanted: f64,
    ) -> Self {
        let name = name.into();
        let mut group = criterion.benchmark_group(&name);
        group.throughput(Throughput::Elements(many));
        let mut asked = false;
        group.bench_function("reference", |b| {
            asked = true;
            b.iter(&mut raw);
        });
        group.throughput(Throughput::Elements(own_many));
        group.bench_function("own", |b| b.iter(&mut own));
        group.finish();
        let mut least = [f64::INFINITY; 2];
        for _ in 0..if asked { TURNS } else { 0 } {
            least[0] = least[0].min(turn(&mut raw) / many as f64);
            least[1] = least[1].min(turn(&mut own) / own_many as f64);
        }
        Ratio { name, reference, wanted, least }
    }
}

/// Returns the nanoseconds of a call, averaged over one turn.
fn turn<A>(call: &mut impl FnMut() -> A) -> f64 {
    let (start, mut calls) = (Instant::now(), 0);
    while start.elapsed() < TURN || calls == 0 {
        black_box(call());
        calls += 1;
    }
    start.elapsed().as_nanos() as f64 / f64::from(calls)
}

/// Returns the timed ratios as a table in Markdown; those that miss their target are bold.
pub fn table(ratios: &[Ratio]) -> String {
    let mut lines = vec![
        "| work | against | reference | own | ratio | wanted |".to_string(),
        "|---|---|--:|--:|--:|--:|".to_string(),
    ];
    let timed = ratios.iter().filter(|ratio| ratio.least[0].is_finite());
    lines.extend(timed.map(|Ratio { name, reference: against, wanted, least: [reference, own] }| {
        let mark = if own / reference > *wanted { "**" } else { "" };
        let ratio = format!("{mark}{}{mark}", digits(own / reference));
        format!("| {name} | {against} | {} | {} | {ratio} | {wanted} |", duration(*reference), duration(*own))
    }));
    lines.join("\n") + "\n"
}

/// Formats nanoseconds in a suitable unit.
fn duration(ns: f64) -> String {
    let units = [(1.0, "ns"), (1e3, "µs"), (1e6, "ms"), (1e9, "s")];
    let (unit, name) = units.into_iter().rev().find(|(unit, _)| ns >= *unit).unwrap_or(units[0]);
    format!("{} {name}", digits(ns / unit))
}

/// Formats two or three digits.
fn digits(x: f64) -> String {
    if x >= 100.0 {
        format!("{x:.0}")
    } else if x >= 0.1 {
        format!("{x:.2}")
    } else {
        format!("{x:.1e}")
    }
}

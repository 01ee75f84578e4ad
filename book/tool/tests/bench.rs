//! The bench computes what the crate computes: its generated script is run by node and compared bit for bit,
//! and what is written by hand for it, of reading numbers and of judging a run, is tried there too.
//!
//! Without node these tests say so and pass; with `NODE=path` that one is run, and it is an error if it cannot be.

use book_tool::bench::{MODEL, formulas, functions};
use serde_json::{Value, json};
use spring_mass_contact::chapter::{SpringMass, augmented};
use spring_mass_contact::number::{Exact, Field, PositivePart};
use std::{
    env,
    fmt::Write as _,
    io::{ErrorKind, Write as _},
    process::{Command, Stdio},
};

/// What the script prints that is run after the bench's own, with `input` at hand.
fn printed(script: &str, input: &Value) -> Option<String> {
    let program = env::var("NODE");
    let mut command = Command::new(program.as_deref().unwrap_or("node"));
    let mut node = match command.arg("-").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn() {
        Err(error) if program.is_err() && error.kind() == ErrorKind::NotFound => {
            eprintln!("skipped: there is no node");
            return None;
        }
        node => node.unwrap_or_else(|error| panic!("{}: {error}", program.as_deref().unwrap_or("node"))),
    };
    let text = format!("\"use strict\";\n{}{MODEL}\nconst input = {input};\n{script}", formulas().unwrap());
    node.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = node.wait_with_output().unwrap();
    assert!(output.status.success(), "the script fails");
    Some(String::from_utf8(output.stdout).unwrap())
}

fn assert_same_lines(expected: &str, found: &str) {
    for (i, (expected, found)) in expected.lines().zip(found.lines()).enumerate() {
        assert_eq!(found, expected, "line {i}: found, expected");
    }
    assert_eq!(found.lines().count(), expected.lines().count());
}

/// A number by its bits: what is not a number has many.
fn bits(x: f64) -> String {
    if x.is_nan() { "NaN".into() } else { format!("{:016x}", x.to_bits()) }
}

/// Parameters, among them the least and the largest, and the zero with a sign.
struct Case {
    system: SpringMass<f64>,
    eps: f64,
    lambda: f64,
    steps: usize,
}

/// A generator of numbers that nobody chose.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }

    /// A number of any digits, of a size between two powers of two.
    fn between(&mut self, low: i64, high: i64) -> f64 {
        let power = low + (self.next() % (high - low + 1) as u64) as i64;
        (1.0 + self.next() as f64 / 2.0_f64.powi(31)) * 2.0_f64.powi(power as i32)
    }

    fn signed(&mut self, low: i64, high: i64) -> f64 {
        let sign = if self.next() % 2 == 0 { 1.0 } else { -1.0 };
        sign * self.between(low, high)
    }
}

fn cases() -> Vec<Case> {
    let default = SpringMass { c: 100.0, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    let systems = [
        default,
        SpringMass { c: 4.0, m: 1.0, g: 10.0, l: 1.0, h: 3.0 },
        SpringMass { h: 0.95, ..default },         // overlaps
        SpringMass { h: 2.0, ..default },          // does not reach the plane
        SpringMass { g: -0.0, h: 1.0, ..default }, // zeros, one with a sign
        SpringMass { g: 0.0, l: -0.0, h: 0.0, ..default },
        SpringMass { m: 1e-45, l: 0.0, h: -1e-44, ..default }, // subnormal, in f32
        SpringMass { m: 1e-37, g: 1e-4, c: 1e-3, l: 1e-42, h: 3e-42 },
        SpringMass { m: 1e30, g: 1e9, ..default },  // overflows f32
        SpringMass { m: 1e300, g: 1e9, ..default }, // and f64
        SpringMass { m: 1e-300, g: 1e-10, l: 1e-320, h: 1e-310, ..default },
    ];
    let mut cases = Vec::new();
    for system in systems {
        for (i, ratio) in [1e-3, 0.7, 1.0, 1e3, 1e8, 1e18].into_iter().enumerate() {
            let lambda = [0.0, -0.0, 7.5, -30.0, 1e-40, 1e9][i];
            cases.push(Case { system, eps: ratio * system.c, lambda, steps: 20 });
        }
    }
    for eps in [1.0, 100.0, 1e3, 1e5, 1.8e9] {
        cases.push(Case { system: default, eps, lambda: 0.0, steps: 300 });
    }
    let mut draw = Draw(1);
    for spread in [0, 3, 10, 40].into_iter().flat_map(|spread| [spread; 25]) {
        let [c, m] = [0; 2].map(|_| draw.between(-spread, spread));
        let [g, l, h] = [0; 3].map(|_| draw.signed(-spread, spread));
        let (eps, lambda) = (c * draw.between(-10, 60), draw.signed(-spread, spread));
        cases.push(Case { system: SpringMass { c, m, g, l, h }, eps, lambda, steps: 20 });
    }
    cases
}

/// One line a step, with the value of every function.
fn lines<T: PositivePart>(
    text: &mut String,
    (system, eps, lambda, n): (&SpringMass<T>, &T, &T, &T),
    steps: usize,
    show: impl Fn(&T) -> String,
) {
    for one in [false, true] {
        let mut lambda = lambda.clone();
        for _ in 0..steps {
            let (deflection, update): (fn(&_, &_, &_) -> _, fn(&_, &_, &_, &_) -> _) = if one {
                (augmented::unilateral_deflection, augmented::unilateral_update)
            } else {
                (augmented::deflection, augmented::update)
            };
            let u = deflection(system, eps, &lambda);
            for (name, value) in functions(system, eps, &lambda, &u, n) {
                write!(text, "{name}={} ", show(&value)).unwrap();
            }
            text.push('\n');
            lambda = update(system, eps, &lambda, &u);
        }
    }
}

/// The same lines by the bench; `read` makes numbers of the input's texts, `show` texts of numbers.
const LINES: &str = r#"
const number = new Float64Array(1), word = new BigUint64Array(number.buffer);
const float = text => { word[0] = BigInt("0x" + text); return number[0]; };
const hex = x => { number[0] = x; return Number.isNaN(x) ? "NaN" : word[0].toString(16).padStart(16, "0"); };
const ratio = ({ n, d }) => (d === 1n ? `${n}` : `${n}/${d}`);
const text = [];
for (const [numbers, steps, ...given] of input) {
  const { f } = systems[numbers], [read, show] = numbers === "exact" ? [parse, ratio] : [float, hex];
  const [c, m, g, l, H, eps, start, n] = given.map(read);
  for (const plane of ["both", "one"]) {
    const step = recursion({ numbers, plane }, { c, m, g, l, H, eps });
    for (let k = 0, lambda = start; k < steps; k += 1) {
      const { u, next } = step(lambda);
      const all = { c, m, g, l, H, eps, lambda, u, n };
      text.push(Object.entries(f).map(([name, f]) => `${name}=${show(f(all))} `).join(""));
      lambda = next;
    }
  }
}
console.log(text.join("\n"));
"#;

fn given<T>(
    name: &str,
    steps: usize,
    all: (&SpringMass<T>, &T, &T, &T),
    show: impl Fn(&T) -> String,
) -> Value {
    let (SpringMass { c, m, g, l, h }, eps, lambda, n) = all;
    let texts = [c, m, g, l, h, eps, lambda, n].map(show);
    let head = [json!(name), json!(steps)];
    Value::Array(head.into_iter().chain(texts.map(Value::from)).collect())
}

#[test]
fn floats_are_those_of_the_crate_bit_for_bit() {
    let (mut text, mut input) = (String::new(), Vec::new());
    for Case { system, eps, lambda, steps } in cases() {
        let (n, show) = (2.0_f64.powi(53), |x: &f64| bits(*x));
        input.push(given("f64", steps, (&system, &eps, &lambda, &n), show));
        lines(&mut text, (&system, &eps, &lambda, &n), steps, show);

        let (n, show) = (2.0_f32.powi(24), |x: &f32| bits(f64::from(*x)));
        let (system, eps, lambda) = (system.map(|&x| x as f32), eps as f32, lambda as f32);
        input.push(given("f32", steps, (&system, &eps, &lambda, &n), show));
        lines(&mut text, (&system, &eps, &lambda, &n), steps, show);
    }
    assert!(text.contains("NaN") && text.contains("7ff0000000000000") && text.contains("8000000000000000"));
    let Some(found) = printed(LINES, &input.into()) else { return };
    assert_same_lines(&text, &found);
}

#[test]
fn fractions_are_those_of_the_crate() {
    let (mut text, mut input) = (String::new(), Vec::new());
    let mut draw = Draw(2);
    for i in 0..30 {
        let mut decimal = |signed: bool| {
            let digits = draw.next() as i64 % 100_000;
            let sign = if signed && draw.next() % 2 == 0 { -1 } else { 1 };
            Exact::int((sign * if signed { digits } else { digits + 1 }) as i32)
                / Exact::int(10_i32.pow(i % 5))
        };
        let system = SpringMass {
            c: decimal(false),
            m: decimal(false),
            g: decimal(true),
            l: decimal(true),
            h: decimal(true),
        };
        let (eps, lambda, n) = (decimal(false), decimal(true), Exact::power_of_two(24));
        let steps = if i == 0 { 150 } else { 10 };
        input.push(given("exact", steps, (&system, &eps, &lambda, &n), Exact::to_string));
        lines(&mut text, (&system, &eps, &lambda, &n), steps, Exact::to_string);
    }
    // The bench refuses texts that are as long; its own numbers are.
    let Some(found) = printed(LINES, &input.into()) else { return };
    assert_same_lines(&text, &found);
}

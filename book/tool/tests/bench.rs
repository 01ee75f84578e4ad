//! Tests of the bench: its generated script is run by node and compared with the crate bit for bit, and the scripts
//! written by hand, for parsing numbers and analysing a run, are tested as well.
//!
//! They require node, which `NODE=path` selects.

use crate::files::text;
use book_tool::PAGES;
use book_tool::bench::{MODEL, PAGE, formulas, functions, script};
use regex::Regex;
use serde_json::{Value, from_str, json};
use spring_mass_contact::chapter::{SpringMass, augmented, contact, system};
use spring_mass_contact::number::{Exact, PositivePart, ToExact};
use std::{
    env,
    fmt::Write as _,
    io::Write as _,
    process::{Command, Stdio},
};

/// Runs a script after the bench's own and returns its output; the script can use `input`.
fn printed(script: &str, input: &Value) -> String {
    node(&format!("{}{MODEL}\n{script}", formulas().unwrap()), input)
}

/// Runs a script in node and returns its output; the script can use `input`.
fn node(script: &str, input: &Value) -> String {
    let program = env::var("NODE").unwrap_or("node".into());
    let mut command = Command::new(&program);
    let node = command.arg("-").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut node = node.unwrap_or_else(|error| panic!("{program}: {error}"));
    let text = format!("\"use strict\";\nconst input = {input};\n{script}");
    node.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = node.wait_with_output().unwrap();
    assert!(output.status.success(), "the script fails");
    String::from_utf8(output.stdout).unwrap()
}

/// Returns the bits of a number; all NaNs are equal.
fn bits(x: f64) -> String {
    if x.is_nan() { "NaN".into() } else { format!("{:016x}", x.to_bits()) }
}

/// Parameters of a run.
struct Case<T> {
    system: SpringMass<T>,
    eps: T,
    lambda: T,
    steps: usize,
}

impl<T> Case<T> {
    fn map<U>(&self, f: impl Fn(&T) -> U) -> Case<U> {
        Case {
            system: self.system.as_ref().map(&f),
            eps: f(&self.eps),
            lambda: f(&self.lambda),
            steps: self.steps,
        }
    }
}

/// Generator of pseudorandom numbers.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }

    /// Returns a positive number with an exponent between `low` and `high`.
    fn between(&mut self, low: i64, high: i64) -> f64 {
        let power = low + (self.next() % (high - low + 1) as u64) as i64;
        (1.0 + self.next() as f64 / 2.0_f64.powi(31)) * 2.0_f64.powi(power as i32)
    }

    fn signed(&mut self, low: i64, high: i64) -> f64 {
        let sign = if self.next().is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * self.between(low, high)
    }
}

fn cases() -> Vec<Case<f64>> {
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
            cases.push(Case { system, eps: ratio * system.c, lambda, steps: 12 });
        }
    }
    for eps in [1.0, 100.0, 1e3, 1e5, 1.8e9] {
        cases.push(Case { system: default, eps, lambda: 0.0, steps: 200 });
    }
    cases.push(Case { system: SpringMass { h: 1.0981, ..default }, eps: 100.0, lambda: 3.0, steps: 60 }); // grazes
    let mut draw = Random(1);
    for spread in [0, 3, 10, 40].into_iter().flat_map(|spread| [spread; 25]) {
        let [c, m] = [0; 2].map(|_| draw.between(-spread, spread));
        let [g, l, h] = [0; 3].map(|_| draw.signed(-spread, spread));
        let (eps, lambda) = (c * draw.between(-10, 60), draw.signed(-spread, spread));
        cases.push(Case { system: SpringMass { c, m, g, l, h }, eps, lambda, steps: 12 });
    }
    cases
}

/// Runs for the bench, and the lines that it has to print: for each plane the values of every function at each step, and
/// the verdict after them.
#[derive(Default)]
struct Runs {
    input: Vec<Value>,
    expected: String,
}

impl Runs {
    /// Adds a run; `n` is two to the power of the number of digits.
    fn add<T: PositivePart + ToExact>(
        &mut self,
        numbers: &str,
        case: &Case<T>,
        n: &T,
        show: impl Fn(&T) -> String,
    ) {
        let Case { system, eps, lambda: start, steps } = case;
        let SpringMass { c, m, g, l, h } = system;
        let given = [c, m, g, l, h, eps, start, n];
        // Signed zeros are different floats and equal numbers.
        let is_valid = |x: &T| x.to_exact().is_ok() && show(x) != bits(-0.0);
        let judged =
            numbers != "exact" && given.into_iter().all(is_valid) && *c != T::zero() && *eps != T::zero();
        let head = [json!(numbers), json!(steps), json!(judged)];
        self.input.push(head.into_iter().chain(given.map(|x| json!(show(x)))).collect());
        for one in [false, true] {
            let (deflection, update): (fn(&_, &_, &_) -> _, fn(&_, &_, &_, &_) -> _) = if one {
                (augmented::unilateral_deflection, augmented::unilateral_update)
            } else {
                (augmented::deflection, augmented::update)
            };
            let mut lambda = start.clone();
            for _ in 0..*steps {
                let u = deflection(system, eps, &lambda);
                for (name, value) in functions(system, eps, &lambda, &u, n) {
                    write!(self.expected, "{name}={} ", show(&value)).unwrap();
                }
                self.expected.push('\n');
                lambda = update(system, eps, &lambda, &u);
            }
            let u = deflection(system, eps, &lambda);
            let next = update(system, eps, &lambda, &u);
            let later = update(system, eps, &next, &deflection(system, eps, &next));
            let verdict = || verdict(system, [&lambda, &next, &later, &u], one, &n.to_exact().unwrap());
            writeln!(self.expected, "{}", if judged { verdict() } else { String::new() }).unwrap();
        }
    }
}

/// Returns the verdict by its definition, with the exact penetration of the computed deflection and the error of the
/// force, from three successive multipliers and the deflection at the first. The verdict is empty if it is not defined
/// here.
fn verdict<T: PositivePart + ToExact>(
    system: &SpringMass<T>,
    values: [&T; 4],
    one: bool,
    n: &Exact,
) -> String {
    let [Ok(before), Ok(after), Ok(later), Ok(u)] = values.map(ToExact::to_exact) else {
        return String::new();
    };
    let exact_system = system.as_ref().try_map(ToExact::to_exact).unwrap();
    let reaction = system::reaction(&exact_system);
    let force = if one { contact::contact_force(&exact_system) } else { reaction.clone() };
    let (zero, p) = (Exact::from(0), contact::penetration(&exact_system, &u));
    let error = (after.clone() - &force).abs();
    // Fewer than half of the digits of the force are right.
    let lost = error.clone() * &error * n > force.clone() * &force;
    let kind = if contact::penetration(system, values[3]) == T::zero() && lost {
        "false zero"
    } else if one && reaction < zero && after == zero {
        "separated"
    } else if after == before {
        "fixed point"
    } else if later == before {
        "2-cycle"
    } else {
        ""
    };
    format!("{kind} {p} {error}")
}

/// Conversion of floats by their bits, and of fractions in the crate's format.
const FLOAT: &str = r#"
const ratio = ({ n, d }) => (d === 1n ? `${n}` : `${n}/${d}`);
const number = new Float64Array(1), word = new BigUint64Array(number.buffer);
const float = text => { word[0] = BigInt("0x" + text); return number[0]; };
const hex = x => { number[0] = x; return Number.isNaN(x) ? "NaN" : word[0].toString(16).padStart(16, "0"); };
"#;

#[test]
#[ignore = "requires node"]
fn runs_agree_bit_for_bit() {
    const LINES: &str = r#"
const text = [], known = ["false zero", "separated", "fixed point", "2-cycle"];
for (const [numbers, steps, judged, ...given] of input) {
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
    const { kind, p, error } = judged ? verdict(run({ numbers, plane, k: steps }, { c, m, g, l, H, eps, lambda: start })) : {};
    text.push(p ? `${known.includes(kind) ? kind : ""} ${ratio(p)} ${ratio(error)}` : "");
  }
}
console.log(text.join("\n"));
"#;
    let mut runs = Runs::default();
    for case in cases() {
        runs.add("f64", &case, &2.0_f64.powi(53), |x| bits(*x));
        let single = case.map(|x| *x as f32);
        runs.add("f32", &single, &2.0_f32.powi(24), |x| bits(f64::from(*x)));
        // The bench reads numbers of at most 40 characters; its own may be longer.
        let SpringMass { c, m, g, l, h } = &single.system;
        let all = [c, m, g, l, h, &single.eps, &single.lambda].map(|x| x.to_exact().ok());
        if all.iter().all(|x| x.as_ref().is_some_and(|x| x.to_string().len() <= 40)) && case.steps < 60 {
            let exact = single.map(|x| x.to_exact().unwrap());
            runs.add("exact", &exact, &Exact::power_of_two(24), Exact::to_string);
        }
    }
    for needed in [
        "=NaN ",
        "=7ff0000000000000 ",
        "=8000000000000000 ",
        "/",
        "false zero ",
        "separated ",
        "fixed point ",
        "2-cycle ",
    ] {
        assert!(runs.expected.contains(needed), "no case with {needed}");
    }
    assert!(runs.input.iter().filter(|run| run[0] == "exact").count() > 50);
    let found = printed(&format!("{FLOAT}{LINES}"), &runs.input.into());
    for (i, (expected, found)) in runs.expected.lines().zip(found.lines()).enumerate() {
        assert_eq!(found, expected, "line {i}: found, expected");
    }
    assert_eq!(found.lines().count(), runs.expected.lines().count());
}

/// Returns what the bench says about the settings of each query, the query of its address with sorted settings, and
/// whether the run has all steps.
fn say(queries: &[String]) -> Vec<(String, String, bool)> {
    const SAY: &str = r#"
console.log(JSON.stringify(input.map(query => {
  const question = asked(query), { values, wrong } = numbers(question), names = Object.entries(wrong);
  if (names.length) return [names.map(([name, why]) => `${name}: ${why}`).join(" "), "", false];
  const result = run(question, values), { kind, text } = verdict(result);
  return [`${kind} ${text}`, address(question).slice(1).split("&").sort().join("&"), result.rows.length - 1 === question.k];
})));
"#;
    from_str(&printed(SAY, &json!(queries))).unwrap()
}

/// The title of a link to the bench is the verdict that the bench will show.
#[test]
#[ignore = "requires node"]
fn links_to_the_bench_have_the_right_verdict() {
    let link = Regex::new(r#"augmented\.html(\?[^)#]*)#bench "([^"]*)"\)"#).unwrap();
    let pages: String = PAGES.iter().map(|name| text(format!("book/src/{name}.md"))).collect();
    let links: Vec<_> =
        link.captures_iter(&pages).map(|found| [1, 2].map(|i| found[i].to_string())).collect();
    assert_eq!(links.len(), pages.matches("augmented.html?").count(), "a link has no verdict");
    for verdict in ["2-cycle", "converging", "false zero", "fixed point", "separated"] {
        assert!(links.iter().any(|[_, title]| title == verdict), "no link has the verdict {verdict}");
    }
    let queries: Vec<_> = links.iter().map(|[query, _]| query.clone()).collect();
    for ([query, title], (said, address, is_whole)) in links.iter().zip(say(&queries)) {
        assert!(said.starts_with(&format!("{title} ")) && is_whole, "{query}: {said}");
        // The address has to contain exactly the settings, without misspelt names.
        let mut pairs: Vec<_> = query[1..].split('&').collect();
        pairs.sort_unstable();
        assert_eq!(pairs.join("&"), address);
    }
}

/// Numbers are read like in the crate, and shown within half a unit of the last digit.
#[test]
#[ignore = "requires node"]
fn numbers_are_read_and_shown_like_in_the_crate() {
    const READ: &str = r#"
const attempt = f => { try { return f(); } catch (error) { if (error instanceof RangeError) return "refused"; throw error; } };
for (const text of input) {
  console.log(attempt(() => {
    const a = parse(text);
    const floats = ["f64", "f32"].map(name => attempt(() => {
      const x = systems[name].read(a);
      if (!Object.is(systems[name].read(parse(systems[name].show(x))), x)) return `shown as ${systems[name].show(x)}`;
      if (name === "f64" && !Object.is(nearest(exactly(x), 53, -1074), x)) return "another when exact";
      return hex(x);
    }));
    return [ratio(a), ...floats, brief(a, 3), brief(a, 12)].join(" ");
  }));
}
"#;
    let texts = "0 -0 +1 0.05 5e-2 1/20 -7/3 +7/21 .5 5. 1.e3 1E+3 9.81 1e-45 7e-46 1.4e-45 1e39 1e308 1.8e308 1e309
        4.9e-324 2e-324 3e-324 2.2250738585072011e-308 1e-400 1e400 16777217 16777219 9007199254740993 9007199254740995
        9007199254740993.0000000000001 3.4028235677973366e38 3.4028235677973365e38 -1e-320 0e5 1/3 000.100
        x 1e 1e+ e5 . - + 1/0 1/ /2 1/-2 1,5 0x 1_0 NaN Infinity 1e5.0 1e5e5 --1 1//2 ½ ٣
        1 -1 999 999.4 999.5 999.6 0.9995 0.99951 123456 999499 999500 1e6 0.0001 0.00009999 0.000099995 1e-5 12345e300
        1e-399 -2/3 100 1000 10 1e5 4.81 2.405 1/7";
    let mut texts: Vec<_> = texts.split_whitespace().chain([""]).map(String::from).collect();
    let mut draw = Random(3);
    for _ in 0..300 {
        let power = draw.next() % 90;
        texts.push(format!("{}.{}e{}", draw.next(), draw.next(), power as i64 - 60));
        texts.push(format!("-{}e-{}", draw.next(), 300 + power % 30));
        texts.push(format!("{}e{}", draw.next() + 1, draw.next() as i64 % 600 - 300));
    }
    let found = printed(&format!("{FLOAT}{READ}"), &json!(texts));
    assert_eq!(found.lines().count(), texts.len());
    for (text, line) in texts.iter().zip(found.lines()) {
        let Ok(exact) = text.parse::<Exact>() else {
            assert_eq!(line, "refused", "{text}");
            continue;
        };
        let double = exact.to_f64().map_or("refused".into(), bits);
        let single = exact.to_f32().map_or("refused".into(), |x| bits(x.into()));
        let words: Vec<_> = line.split(' ').collect();
        assert_eq!(words[..3], [exact.to_string(), double, single], "{text}");
        for (shown, digits) in words[3..].iter().zip([3, 12]) {
            let digit =
                |c| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c).map_or(c, |d| char::from(b'0' + d as u8));
            let plain: String =
                shown.replace("·10", "e").replace(['⁻', '−'], "-").chars().map(digit).collect();
            // One unit of the last digit is at most 10^(1 - digits) times the number.
            let allowed =
                exact.abs() / Exact::from(2) / format!("1e{}", digits - 1).parse::<Exact>().unwrap();
            let error = (plain.parse::<Exact>().unwrap() - &exact).abs();
            let written =
                plain.split('e').next().unwrap().trim_start_matches(['-', '0', '.']).replace('.', "");
            let is_short = written.trim_end_matches('0').len() <= digits;
            assert!(error <= allowed && is_short, "{text} to {digits} digits: {shown}");
        }
    }
}

#[test]
#[ignore = "requires node"]
fn other_settings_have_verdicts() {
    // The sum c + ε overflows, and the quotient by it is 0: every displayed number looks normal.
    let overflow = "?c=1e38&eps=3e38&numbers=f32";
    let long = "?c=1.23456789012345678901234567890123456&eps=2.3456789012345678901234567890123456789&k=200&numbers=exact";
    // Error of the multiplier in the cycle, now and in the next step; to three digits R is 4.81.
    let default = SpringMass { c: 100.0_f64, m: 1.0, g: 9.81, l: 1.0, h: 1.05 };
    let (eps, mut lambda) = (1e5, 0.0);
    let errors = [0; 8].map(|_| {
        let error = format!("{:.2e}", (lambda - 4.81_f64).abs()).replace("e-11", "·10⁻¹¹");
        let u = augmented::deflection(&default, &eps, &lambda);
        lambda = augmented::update(&default, &eps, &lambda, &u);
        error
    });
    assert_ne!(errors[6], errors[7]);
    let cycle = format!("2-cycle by {} now and by {} next", errors[6], errors[7]);
    let expected = [
        ("?eps=1e5&k=6", &*cycle),
        (overflow, "overflow too large for f32"),
        ("?eps=2.99e6&k=1&numbers=f32", "moving by rounding"),
        (long, "converging binary digits"),
        ("?lambda=4.81&numbers=exact", "fixed point this is the solution"),
        ("?k=3000&numbers=exact", "converging at most 200 steps"),
        ("?k=99999&eps=1e-3", "converging at most 10000 steps"),
        ("?highlight=x&k=-1&numbers=f16&plane=none", "converging p = 0.0015 m"),
        ("?eps=0", "eps: not greater than 0"),
        ("?H=1,05&numbers=f32&m=1e-50&g=1e99", "m: not zero g: too large H: not a number"),
    ];
    let said = say(&expected.map(|(query, _)| query.to_string()));
    for ((query, words), (said, ..)) in expected.into_iter().zip(&said) {
        let mut rest = said.as_str();
        for word in words.split(' ') {
            rest = rest.split_once(word).unwrap_or_else(|| panic!("{query}: no {word:?} in {said}")).1;
        }
    }
}

/// Minimal document for running the whole script of the bench.
const DOCUMENT: &str = r#"
class Element {
  constructor(name) {
    Object.assign(this, { name, attributes: {}, children: [], found: {}, on: {}, dataset: {}, textContent: "" });
    Object.assign(this, { classList: { add() {} }, clientWidth: 400, clientHeight: 240 });
  }
  setAttribute(key, value) { this.attributes[key] = String(value); }
  append(...children) { this.children.push(...children); }
  replaceChildren(...children) { this.children = children; }
  insertAdjacentHTML() {}
  focus() {}
  setPointerCapture() {}
  getBoundingClientRect() { return { top: 0 }; }
  addEventListener(kind, listener) { this.on[kind] = listener; }
  querySelector(selector) { return (this.found[selector] ??= new Element(selector)); }
  querySelectorAll() { return []; }
  get all() { return this.children.flatMap(child => (child instanceof Element ? [child, ...child.all] : [])); }
  get text() { return this.children.map(child => child.textContent ?? child).join(""); }
}
globalThis.ResizeObserver = class { observe() {} };
globalThis.on = {};
globalThis.addEventListener = (kind, listener) => { on[kind] = listener; };
const opened = (search, dataset = {}, solved = false) => {
  const root = new Element("root"), create = name => new Element(name);
  Object.assign(root, { dataset, classList: { add() {}, contains: () => solved } });
  root.querySelector(".bench-system").append(create("g"), create("g"));
  globalThis.location = { search, pathname: "/" };
  globalThis.history = { replaceState: (state, title, url) => { location.search = url.replace(/^\/|#.*/g, ""); } };
  globalThis.document = { querySelectorAll: () => [root], createElement: create, addEventListener() {},
    createElementNS: (space, name) => create(name) };
  new Function(input.script)();
  return root;
};
const numbersIn = text => (text.match(/-?[\d.]+(e[+-]?\d+)?/g) ?? []).map(Number);
"#;

/// Runs the whole script and checks the drawings. For the example the steps are (1/4, 1), (1/8, 3/2), … on the line of
/// equilibrium, and the corner of the plane is at p = N = 0.
#[test]
#[ignore = "requires node"]
fn drawings_agree_with_the_table() {
    const DRAWN: &str = r#"
console.log(JSON.stringify(input.asked.map(search => {
  const root = opened(search), find = selector => root.querySelector(selector);
  root.on.click({ target: { dataset: { step: "1" } } });
  const forces = find(".bench-forces"), decay = find(".bench-decay"), all = [find(".bench-system"), forces, decay];
  const wrong = all.flatMap(svg => svg.all).filter(part => /NaN|Infinity|undefined/.test(JSON.stringify(part.attributes)));
  const rows = find(".bench-table tbody").children, shown = find(".bench-verdict").text;
  const line = (svg, kind, dashes) => numbersIn(svg.all.find(part =>
    part.attributes.class === kind && part.attributes["stroke-dasharray"] === dashes)?.attributes.d ?? "");
  const discs = (svg, kind) => svg.all.filter(part => part.name === "circle" && part.attributes.class.startsWith(kind))
    .map(({ attributes: { cx, cy } }) => [Number(cx), Number(cy)]);
  // Each step is a point on the line of equilibrium.
  const [x0, y0, x1, y1] = line(forces, "bench-spring"), steps = discs(forces, "");
  const off = steps.filter(([x, y]) => Math.abs((x - x0) * (y1 - y0) - (y - y0) * (x1 - x0)) > 0.02 * Math.hypot(x1 - x0, y1 - y0));
  const text = [shown.split(",")[0], steps.length, rows.length, rows.at(-1).children[0].textContent,
    new URLSearchParams(location.search).get("k"), wrong.length, off.length].join("|");
  const corner = line(forces, "bench-plane bench-corner"), law = line(decay, "bench-faint", "4 3");
  return [text, steps, corner, discs(decay, "bench-dot"), discs(decay, "bench-ring"), law];
})));
"#;
    // Settings, and the result after one more step: the verdict, the numbers of points and rows, k in the last row and in
    // the address, the number of invalid attributes, and the number of points off the line, where forces do not balance.
    let expected = [
        ("", "converging|5|5|4||0|0"), // the example, k = 3, and one step
        ("?k=4", "converging|6|6|5|5|0|0"),
        ("?c=4&g=10&H=3&eps=4&k=3&numbers=exact", "converging|5|5|4||0|0"),
        ("?eps=1e5&k=6", "2-cycle|8|8|7|7|0|0"),
        ("?eps=1e8&k=0&numbers=f32", "false zero|2|2|1|1|0|2"),
        ("?H=1.2&lambda=40&plane=one&k=9", "separated|11|11|10|10|0|0"),
        ("?k=30", "converging|32|12|31|31|0|0"),
    ];
    let asked: Vec<_> = expected.iter().map(|(asked, _)| asked).collect();
    let input = json!({ "script": script().unwrap(), "asked": asked });
    type Points = Vec<[f64; 2]>;
    type Drawing = (String, Points, Vec<f64>, Points, Points, Vec<f64>);
    let drawings: Vec<Drawing> = from_str(&node(&format!("{DOCUMENT}{DRAWN}"), &input)).unwrap();
    let texts: Vec<_> = drawings.iter().map(|drawing| drawing.0.as_str()).collect();
    assert_eq!(texts, expected.map(|(_, drawn)| drawn));

    // Paths are written in hundredths of a pixel.
    let assert_close = |a: f64, b: f64| assert!((a - b).abs() <= 0.011, "{a} and {b}");
    let (_, steps, corner, dots, rings, law) = &drawings[2];
    let (metre, newton) = ((steps[0][0] - steps[1][0]) / 0.125, (steps[0][1] - steps[1][1]) / 0.5);
    assert!(metre > 100.0 && newton > 10.0, "to the right and upwards");
    let at = |p: f64, n: f64| [steps[0][0] + (p - 0.25) * metre, steps[0][1] - (n - 1.0) * newton];
    for (step, p) in steps.iter().zip([0.25, 0.125, 0.0625, 0.03125, 0.015625]) {
        let [x, y] = at(p, 2.0 - 4.0 * p);
        assert_close(step[0], x);
        assert_close(step[1], y);
    }
    let [x, y] = at(0.0, 0.0);
    for (found, expected) in corner[1..5].iter().zip([y, x, y, x]) {
        assert_close(*found, expected);
    }
    assert!(corner[0] < x && corner[5] < y, "p ≤ 0 and N ≥ 0");
    // Each step halves the penetration, computed and exact: on a logarithmic axis the points lie on the line of ρᵏ. Its ends
    // are rounded, but it is much longer than the distance of the steps.
    assert_eq!(dots, rings);
    let slope = (law[3] - law[1]) / (law[2] - law[0]);
    assert!(dots.len() == 5 && slope > 0.0);
    dots.iter().for_each(|dot| assert_close(law[1] + slope * (dot[0] - law[0]), dot[1]));
}

/// A small figure names the state of the solution, or the result of the penalty method, and the field with a mistake.
#[test]
#[ignore = "requires node"]
fn small_figures_name_the_state_and_the_mistake() {
    const SAID: &str = r#"
const said = (fields, solved) => {
  const root = opened("", { fields, k: solved ? "40" : "0" }, solved), out = [];
  const enter = (text, value) => {
    root.on.input({ target: { dataset: { text }, value } });
    out.push(root.querySelector(".bench-verdict").text.replace(/\u00a0/g, " "));
  };
  return [enter, out];
};
const [enter, out] = said("g H", true);
for (const g of ["10", "8", "4", "4,5"]) enter("g", g);
const [soft, penalty] = said("eps", false);
for (const eps of ["4", "1e20", "0"]) soft("eps", eps);
const [raised, without] = said("H", false);
raised("H", "4");
console.log(JSON.stringify([...out, ...penalty, ...without]));
"#;
    let found = node(&format!("{DOCUMENT}{SAID}"), &json!({ "script": script().unwrap() }));
    let said: Vec<String> = from_str(&found).unwrap();
    let expected = [
        "contact. R = 2 N, so p = 0 m and N = 2 N.",
        "grazing. R = 0 N, so p = 0 m and N = 0 N.",
        "separated. R = −4 N, so p = −1 m and N = 0 N.",
        "g: not a number such as 0.05, 5e-2 or 1/20.",
        "penalty. p = 0.25 m and N = ⟨ε p⟩ = 1 N, short of R by 1 N.",
        "penalty. p = 2·10⁻²⁰ m and N = ⟨ε p⟩ = 2 N, short of R by 8·10⁻²⁰ N.",
        "ε: not greater than 0.",
        "penalty. p = −0.5 m and N = ⟨ε p⟩ = 0 N.",
    ];
    assert_eq!(said, expected);
}

/// Document for the functions that draw, on a page without a bench.
const STUB: &str =
    "const document = { createElementNS: (space, name) => new Element(name), querySelectorAll: () => [] };";

/// The axes of the force diagram stay, also after the plane was dragged; they change if the solution would leave them, or
/// by their button. The line before the last change stays as a faint one. A finger on the plane does not scroll, and one
/// that scrolls does not move a slider.
#[test]
#[ignore = "requires node"]
fn axes_stay_while_the_plane_moves() {
    const MOVED: &str = r#"
const root = opened(""), find = selector => root.querySelector(selector);
const forces = find(".bench-forces"), system = find(".bench-system"), slider = find("[role=slider]");
const ticks = () => forces.all.filter(part => /bench-tick/.test(part.attributes.class)).map(part => [part.text, part.attributes.x, part.attributes.y].join());
const line = () => forces.all.find(part => part.attributes.class === "bench-spring").attributes.d;
const former = () => forces.all.filter(part => part.attributes.class === "bench-spring bench-former").length;
const seen = () => [ticks().join(";"), line(), find("[data-text=H]").value, String(former())];
let prevented = 0;
const event = { target: { closest: () => slider, dataset: {} }, preventDefault() { prevented += 1; }, pointerId: 1 };
system.on.touchstart(event);
system.on.touchstart({ ...event, target: { closest: () => null } });
if (prevented !== 1) throw Error("a finger beside the plane");
const press = key => root.on.keydown({ key, target: { getAttribute: () => "slider" }, stopPropagation() {}, preventDefault() {} });
const drag = clientY => { system.on.pointerdown(event); system.on.pointermove({ clientY }); };
const fit = { target: { dataset: { step: "fit" } } }, move = system.on.pointermove;
const acts = [() => {}, () => drag(178), () => move({ clientY: 100 }), () => on.pointerup(),
  () => { drag(160); on.pointerup(); }, () => root.on.click(fit), () => { press("Home"); press("End"); }];
const states = acts.map(act => { act(); return seen(); });
const eps = { dataset: { slide: "eps" }, value: 3 }, field = find("[data-text=eps]"), before = field.value;
root.on.pointerdown({ target: eps });
root.on.input({ target: eps });
if (field.value !== "1000") throw Error("a slider");
on.pointercancel();
if (field.value !== before) throw Error("a finger that scrolls");
console.log(JSON.stringify(states));
"#;
    let found = node(&format!("{DOCUMENT}{MOVED}"), &json!({ "script": script().unwrap() }));
    let [start, dragged, far, released, back, fitted, end]: [[String; 4]; 7] = from_str(&found).unwrap();
    assert!(start[0].split(';').count() >= 6, "{start:?}");
    assert_eq!(start[0], dragged[0], "ticks");
    assert!(start[1] != dragged[1] && start[2] != dragged[2], "{found}");
    assert_ne!(far[0], dragged[0], "ticks");
    assert_eq!([&far[0], &far[0]], [&released[0], &back[0]], "ticks");
    assert_ne!(back[0], fitted[0], "ticks");
    // The drawing shows lengths up to 4 m between 24 and 216 pixels, and keeps them.
    assert_eq!(
        [&dragged, &far, &back, &end].map(|state| state[2].as_str()),
        ["3.21", "1.58", "2.83", "4"],
        "H"
    );
    let former = [start, dragged, far, released, back, fitted].map(|[.., former]| former);
    assert_eq!(former, ["0", "1", "1", "1", "1", "0"], "faint lines");
}

/// With Euler steps of size 1 the points are the rings of the augmentations, and the curve is above them; at h = 4 the
/// example alternates between p₀ and −p₀.
#[test]
#[ignore = "requires node"]
fn euler_steps_of_size_one_are_the_augmentations() {
    const DRAWN: &str = r#"
const svg = Object.assign(document.createElementNS("", "svg"), { clientWidth: 440, clientHeight: 250 });
const drawn = h => {
  const text = drawFlow(svg, 4, h), circles = svg.children.filter(child => child.name === "circle");
  const of = kind => circles.filter(({ attributes }) => attributes.class === kind).map(({ attributes: { cx, cy } }) => [cx, cy].map(x => Number(Number(x).toFixed(6))));
  const curve = numbersIn(svg.children.find(({ attributes }) => attributes.class === "bench-spring").attributes.d);
  return [text, of("bench-dot"), of("bench-ring"), curve];
};
console.log(JSON.stringify([1, 4, 6].map(drawn)));
"#;
    type Drawing = (String, Vec<(f64, f64)>, Vec<(f64, f64)>, Vec<f64>);
    let drawn: [Drawing; 3] =
        from_str(&printed(&format!("{DOCUMENT}{STUB}{PAGE}{DRAWN}"), &json!(null))).unwrap();
    // Between p₀ and −p₀ are 200 pixels, and p₀ is at a height of 25; the time 1 is 50 pixels. Millionths of a pixel are rounded.
    let rings: Vec<_> =
        (0..9).map(|k| (30.0 + 50.0 * f64::from(k), 125.0 - 100.0 * 0.5_f64.powi(k))).collect();
    assert_eq!([&drawn[0].1, &drawn[0].2], [&rings; 2]);
    for point in drawn[0].3.chunks(2) {
        // The path is written in hundredths.
        let t = (point[0] - 30.0) / 50.0;
        assert!((point[1] - (125.0 - 100.0 * (-t / 2.0).exp())).abs() <= 0.011, "{point:?}");
    }
    assert_eq!(drawn[1].1, [(30.0, 25.0), (230.0, 225.0), (430.0, 25.0)]);
    let texts = [
        "Each step multiplies p by 0.5: they converge.",
        "Each step multiplies p by −1: they neither converge nor diverge, with alternating sign.",
        "Each step multiplies p by −2: they diverge, with alternating sign.",
    ];
    assert_eq!(drawn.map(|(text, ..)| text), texts);
}

/// The fields of the bench have the units of the page of notation.
#[test]
fn fields_have_the_units_of_the_notation() {
    let field = Regex::new(r#"(?m)^  \w+: \{ sign: "([^"]*)", name: "[^"]*", unit: "([^"]*)""#).unwrap();
    let fields: Vec<_> = field.captures_iter(PAGE).collect();
    assert_eq!(fields.len(), 7);
    for found in fields {
        let sign = found[1].replace('ε', r"\varepsilon").replace("λ₀", r"\lambda");
        let row = format!(
            r"(?m)^\| \${}(?: > 0)?\$ \|[^|]*\| {} \|",
            regex::escape(&sign),
            regex::escape(&found[2])
        );
        assert!(Regex::new(&row).unwrap().is_match(&text("book/src/notation.md")), "{sign}: {}", &found[2]);
    }
}

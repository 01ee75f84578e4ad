//! Formulas of FPBench without roots and transcendental functions, each with the intervals of its arguments.

#![expect(clippy::too_many_arguments, reason = "a matrix has nine")]

use provable::formula::{Formula, Hypothesis};
use provable::number::{Field, Tree};
use provable::record;

/// A formula with the interval of each argument: two numerators and their denominator.
pub struct Benchmark {
    pub name: &'static str,
    pub formula: Formula,
    pub ranges: Vec<(i32, i32, i32)>,
}

impl Benchmark {
    /// Returns the intervals as hypotheses.
    pub fn hypotheses(&self) -> Vec<Hypothesis> {
        let named = self.formula.arguments.iter().zip(&self.ranges);
        let interval = |(name, (lower, upper, over)): (&&'static str, &(i32, i32, i32))| {
            let [lower, upper] = [lower, upper].map(|n| decimal::<Tree>(*n, *over));
            Hypothesis::between(&Tree::symbol(name), lower, upper)
        };
        named.map(interval).collect()
    }
}

macro_rules! benchmarks {
    ($($name:literal $function:ident($($x:ident in [$lower:literal, $upper:literal] / $over:literal),+);)+) => {
        /// Returns all benchmarks.
        pub fn benchmarks() -> Vec<Benchmark> {
            vec![$(Benchmark {
                name: $name,
                formula: record!($name = $function($($x),+)),
                ranges: vec![$(($lower, $upper, $over)),+],
            }),+]
        }
    };
}

benchmarks! {
    "intro-example" part(t in [0, 999] / 1);
    "sec4-example" sec4(x in [1001, 2000] / 1000, y in [1001, 2000] / 1000);
    "test02_sum8" sum8(a in [1, 2] / 1, b in [1, 2] / 1, c in [1, 2] / 1, d in [1, 2] / 1,
        e in [1, 2] / 1, f in [1, 2] / 1, g in [1, 2] / 1, h in [1, 2] / 1);
    "test03_nonlin2" nonlin2(x in [0, 10] / 10, y in [-10, -1] / 10);
    "test05_nonlin1, r4" r4(x in [100001, 200000] / 100000);
    "test05_nonlin1, test2" inverse(x in [100001, 200000] / 100000);
    "doppler1" doppler(u in [-100, 100] / 1, v in [20, 20000] / 1, t in [-30, 50] / 1);
    "doppler2" doppler(u in [-125, 125] / 1, v in [15, 25000] / 1, t in [-40, 60] / 1);
    "doppler3" doppler(u in [-30, 120] / 1, v in [320, 20300] / 1, t in [-50, 30] / 1);
    "rigidbody1" rigid_body_1(x in [-15, 15] / 1, y in [-15, 15] / 1, z in [-15, 15] / 1);
    "rigidbody2" rigid_body_2(x in [-15, 15] / 1, y in [-15, 15] / 1, z in [-15, 15] / 1);
    "verhulst" verhulst(x in [1, 3] / 10);
    "predPrey" predator_prey(x in [1, 3] / 10);
    "carbonGas" carbon_gas(v in [1, 5] / 10);
    "turbine1" turbine_1(v in [-45, -3] / 10, w in [4, 9] / 10, r in [38, 78] / 10);
    "turbine2" turbine_2(v in [-45, -3] / 10, w in [4, 9] / 10, r in [38, 78] / 10);
    "turbine3" turbine_3(v in [-45, -3] / 10, w in [4, 9] / 10, r in [38, 78] / 10);
    "jetEngine" jet_engine(x in [-5, 5] / 1, y in [-20, 5] / 1);
    "sine" sine(x in [-157079633, 157079633] / 100000000);
    "sineOrder3" sine_of_order_3(z in [-2, 2] / 1);
    "sqrt" square_root(y in [0, 1] / 1);
    "kepler0" kepler_0(a in [400, 636] / 100, b in [400, 636] / 100, c in [400, 636] / 100,
        d in [400, 636] / 100, e in [400, 636] / 100, f in [400, 636] / 100);
    "kepler1" kepler_1(a in [400, 636] / 100, b in [400, 636] / 100, c in [400, 636] / 100,
        d in [400, 636] / 100);
    "kepler2" kepler_2(a in [400, 636] / 100, b in [400, 636] / 100, c in [400, 636] / 100,
        d in [400, 636] / 100, e in [400, 636] / 100, f in [400, 636] / 100);
    "matrixDeterminant" determinant(a in [-10, 10] / 1, b in [-10, 10] / 1, c in [-10, 10] / 1,
        d in [-10, 10] / 1, e in [-10, 10] / 1, f in [-10, 10] / 1,
        g in [-10, 10] / 1, h in [-10, 10] / 1, i in [-10, 10] / 1);
}

/// Returns a decimal number, rounded once.
fn decimal<T: Field>(n: i32, over: i32) -> T {
    if over == 1 { T::int(n) } else { T::int(n) / T::int(over) }
}

fn part<T: Field>(t: &T) -> T {
    t / (t + T::int(1))
}

fn sec4<T: Field>(x: &T, y: &T) -> T {
    let t = x * y;
    (&t - T::int(1)) / (&t * &t - T::int(1))
}

fn sum8<T: Field>(a: &T, b: &T, c: &T, d: &T, e: &T, f: &T, g: &T, h: &T) -> T {
    a + b + c + d + e + f + g + h
}

fn nonlin2<T: Field>(x: &T, y: &T) -> T {
    (x + y) / (x - y)
}

fn r4<T: Field>(x: &T) -> T {
    (x - T::int(1)) / (x * x - T::int(1))
}

fn inverse<T: Field>(x: &T) -> T {
    T::int(1) / (x + T::int(1))
}

fn doppler<T: Field>(u: &T, v: &T, t: &T) -> T {
    let t1 = decimal::<T>(3314, 10) + decimal::<T>(6, 10) * t;
    -&t1 * v / ((&t1 + u) * (&t1 + u))
}

fn rigid_body_1<T: Field>(x: &T, y: &T, z: &T) -> T {
    -(x * y) - T::int(2) * y * z - x - z
}

fn rigid_body_2<T: Field>(x: &T, y: &T, z: &T) -> T {
    let squares = T::int(3) * z * z;
    T::int(2) * x * y * z + &squares - y * x * y * z + &squares - y
}

fn verhulst<T: Field>(x: &T) -> T {
    T::int(4) * x / (T::int(1) + x / decimal::<T>(111, 100))
}

fn predator_prey<T: Field>(x: &T) -> T {
    let ratio = x / decimal::<T>(111, 100);
    T::int(4) * x * x / (T::int(1) + &ratio * &ratio)
}

/// The Boltzmann constant is divided by powers of ten that are 32-bit numbers.
fn carbon_gas<T: Field>(v: &T) -> T {
    let (t, n, billion) = (T::int(300), T::int(1000), T::int(1_000_000_000));
    let k = decimal::<T>(13_806_503, 1_000_000_000) / &billion / &billion / T::int(1000);
    let density = &n / v;
    let pressure = T::int(35_000_000) + decimal::<T>(401, 1000) * (&density * &density);
    pressure * (v - &n * decimal::<T>(427, 10_000_000)) - k * n * t
}

fn turbine_1<T: Field>(v: &T, w: &T, r: &T) -> T {
    let drag = decimal::<T>(1, 8) * (T::int(3) - T::int(2) * v) * (w * w * r * r) / (T::int(1) - v);
    T::int(3) + T::int(2) / (r * r) - drag - decimal::<T>(9, 2)
}

fn turbine_2<T: Field>(v: &T, w: &T, r: &T) -> T {
    let drag = decimal::<T>(1, 2) * v * (w * w * r * r) / (T::int(1) - v);
    T::int(6) * v - drag - decimal::<T>(5, 2)
}

fn turbine_3<T: Field>(v: &T, w: &T, r: &T) -> T {
    let drag = decimal::<T>(1, 8) * (T::int(1) + T::int(2) * v) * (w * w * r * r) / (T::int(1) - v);
    T::int(3) - T::int(2) / (r * r) - drag - decimal::<T>(1, 2)
}

fn jet_engine<T: Field>(x: &T, y: &T) -> T {
    let (square, double) = (T::int(3) * x * x, T::int(2) * y);
    let d = x * x + T::int(1);
    let (s, other) = ((&square + &double - x) / &d, (&square - &double - x) / &d);
    let first = T::int(2) * x * &s * (&s - T::int(3)) + x * x * (T::int(4) * &s - T::int(6));
    x + (first * d + square * s + x * x * x + x + T::int(3) * other)
}

fn sine<T: Field>(x: &T) -> T {
    x - x * x * x / T::int(6) + x * x * x * x * x / T::int(120) - x * x * x * x * x * x * x / T::int(5040)
}

/// The constants have nine digits.
fn sine_of_order_3<T: Field>(z: &T) -> T {
    decimal::<T>(954_929_659, 1_000_000_000) * z - decimal::<T>(129_006_138, 1_000_000_000) * (z * z * z)
}

fn square_root<T: Field>(y: &T) -> T {
    let [second, third, fourth] = [(1, 8), (1, 16), (5, 128)].map(|(n, over)| decimal::<T>(n, over));
    T::int(1) + decimal::<T>(1, 2) * y - second * y * y + third * y * y * y - fourth * y * y * y * y
}

fn kepler_0<T: Field>(a: &T, b: &T, c: &T, d: &T, e: &T, f: &T) -> T {
    b * e + c * f - b * c - e * f + a * (-a + b + c - d + e + f)
}

fn kepler_1<T: Field>(a: &T, b: &T, c: &T, d: &T) -> T {
    a * d * (-a + b + c - d) + b * (a - b + c + d) + c * (a + b - c + d) - b * c * d - a * c - a * b - d
}

fn kepler_2<T: Field>(a: &T, b: &T, c: &T, d: &T, e: &T, f: &T) -> T {
    a * d * (-a + b + c - d + e + f) + b * e * (a - b + c + d - e + f) + c * f * (a + b - c + d + e - f)
        - b * c * d
        - a * c * e
        - a * b * f
        - d * e * f
}

fn determinant<T: Field>(a: &T, b: &T, c: &T, d: &T, e: &T, f: &T, g: &T, h: &T, i: &T) -> T {
    (a * e * i + b * f * g + c * d * h) - (c * e * g + b * d * i + a * f * h)
}

//! Runs the properties with arbitrary bits.
//!
//! ```sh
//! cargo run --release -p any_bits -- --executions 10000000 --target solve_f32
//! ```
//! tests one target with ten million arguments; without `--target`, each with as many. The arguments are
//! determined by `--seed N` and their index, so a failure can be reproduced with `--from INDEX --executions
//! 1`, which prints them.

use any_bits::{SHOWN, TARGETS, Target};
use oorandom::Rand64;
use rayon::prelude::*;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::process::{ExitCode, exit};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Time limit of an execution, whose arguments are short; it is larger without optimisation. Hundreds of augmentations
/// in rationals take a second.
const LONGEST: Duration = Duration::from_secs(if cfg!(debug_assertions) { 10 } else { 3 });

/// Time after which an execution is abandoned.
const HANG: Duration = Duration::from_secs(60);

/// Fills the bytes of an index.
fn fill(seed: u64, number: u64, bytes: &mut [u8]) {
    let mut random = Rand64::new(u128::from(seed) << 64 | u128::from(number));
    for chunk in bytes.chunks_mut(8) {
        chunk.copy_from_slice(&random.rand_u64().to_le_bytes()[..chunk.len()]);
    }
}

thread_local! {
    /// Message of the last panic of a thread.
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Returns the failure of an execution.
fn failure((_, most, property): &Target, seed: u64, number: u64) -> Option<String> {
    let mut bytes = [0; 256];
    let bytes = &mut bytes[..*most];
    fill(seed, number, bytes);
    catch_unwind(AssertUnwindSafe(|| property(bytes))).err().map(|_| LAST_PANIC.take())
}

/// Results of executions.
#[derive(Default)]
struct Tally {
    violations: u64,
    slowest: (Duration, u64),
    /// The first failure.
    example: Option<(u64, String)>,
}

impl Tally {
    fn and(mut self, other: Tally) -> Tally {
        self.violations += other.violations;
        self.slowest = self.slowest.max(other.slowest);
        self.example = self.example.into_iter().chain(other.example).min();
        self
    }
}

/// Running executions by thread.
struct Executions(Vec<[AtomicU64; 2]>, Instant);

impl Executions {
    fn new() -> Self {
        Executions((0..rayon::current_num_threads()).map(|_| Default::default()).collect(), Instant::now())
    }

    fn set(&self, number: u64) {
        let [own, since] = &self.0[rayon::current_thread_index().unwrap_or(0)];
        own.store(number, Ordering::Relaxed);
        since.store(self.1.elapsed().as_millis() as u64, Ordering::Relaxed);
    }

    /// Returns an execution that exceeds the time limit.
    fn hanging(&self) -> Option<u64> {
        let now = self.1.elapsed();
        let hangs = |since: &AtomicU64| now > Duration::from_millis(since.load(Ordering::Relaxed)) + HANG;
        self.0.iter().find(|[_, since]| hangs(since)).map(|[own, _]| own.load(Ordering::Relaxed))
    }
}

const AT_ONCE: u64 = 64;

fn run(target: &Target, seed: u64, from: u64, executions: u64) -> Tally {
    let running = Executions::new();
    thread::scope(|scope| {
        let (ended, waits) = std::sync::mpsc::channel::<()>();
        scope.spawn(|| {
            let waits = waits;
            while waits.recv_timeout(LONGEST) == Err(std::sync::mpsc::RecvTimeoutError::Timeout) {
                if let Some(number) = running.hanging() {
                    println!("{} {number} (or up to {AT_ONCE} later) does not end", target.0);
                    exit(1);
                }
            }
        });
        let blocks = (0..executions.div_ceil(AT_ONCE)).into_par_iter();
        let tally = blocks.map(|block| {
            let mut tally = Tally::default();
            running.set(from + block * AT_ONCE);
            for number in from + block * AT_ONCE..from + ((block + 1) * AT_ONCE).min(executions) {
                let timed = || {
                    let start = Instant::now();
                    let failure = failure(target, seed, number);
                    (failure, start.elapsed())
                };
                let (mut failure, mut took) = timed();
                // The machine may have been busy with something else.
                if took > LONGEST {
                    took = took.min(timed().1);
                }
                if took > LONGEST {
                    failure = failure.or(Some(format!("it takes {took:?}")));
                }
                let example = failure.map(|failure| (number, failure));
                let violations = u64::from(example.is_some());
                tally = tally.and(Tally { violations, slowest: (took, number), example });
            }
            tally
        });
        let tally = tally.reduce(Tally::default, Tally::and);
        drop(ended);
        tally
    })
}

/// Returns the peak memory if the system reports it.
fn peak() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    peak.map_or("not known here".to_string(), |peak| peak.trim().to_string())
}

struct Options {
    targets: Vec<&'static Target>,
    seed: u64,
    from: u64,
    executions: u64,
}

fn options(arguments: &[String]) -> Result<Options, String> {
    let mut options = Options { targets: TARGETS.iter().collect(), seed: 1, from: 0, executions: 1_000_000 };
    for pair in arguments.chunks(2) {
        let [option, value] = pair else { return Err(format!("'{}' needs a value", pair[0])) };
        if option == "--target" {
            options.targets.retain(|(name, ..)| name == value);
            if options.targets.is_empty() {
                let names = TARGETS.map(|(name, ..)| name).join(", ");
                return Err(format!("invalid value {value:?} for '--target': must be one of {names}"));
            }
            continue;
        }
        let place = match option.as_str() {
            "--seed" => &mut options.seed,
            "--from" => &mut options.from,
            "--executions" => &mut options.executions,
            _ => {
                return Err(format!(
                    "unexpected {option:?}; there are --target, --executions, --seed and --from"
                ));
            }
        };
        *place = value.parse().map_err(|_| {
            format!("invalid value {value:?} for '{option}': must be an integer from 0 to {}", u64::MAX)
        })?;
    }
    Ok(options)
}

fn main() -> ExitCode {
    let arguments: Vec<_> =
        std::env::args_os().skip(1).map(|text| text.to_string_lossy().into_owned()).collect();
    let Options { targets, seed, from, executions } = match options(&arguments) {
        Ok(options) => options,
        Err(line) => {
            eprintln!("error: {line}");
            return ExitCode::from(2);
        }
    };
    SHOWN.store(executions == 1, Ordering::Relaxed);
    set_hook(Box::new(|panic| LAST_PANIC.set(panic.to_string().replace('\n', " "))));
    println!("target        executions  violations  seconds  slowest in ms");
    let mut violations = 0;
    for target in targets {
        let start = Instant::now();
        let tally = run(target, seed, from, executions);
        let (slowest, number) = tally.slowest;
        println!(
            "{:11} {executions:12} {:11} {:8.1} {:10.1}, number {number}",
            target.0,
            tally.violations,
            start.elapsed().as_secs_f64(),
            slowest.as_secs_f64() * 1e3
        );
        if let Some((number, wrong)) = tally.example {
            println!("  number {number}: {wrong}");
        }
        violations += tally.violations;
    }
    println!("peak memory: {}", peak());
    ExitCode::from(u8::from(violations > 0))
}

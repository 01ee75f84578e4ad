//! The command as a child process with a time limit.

use oorandom::Rand64;
use std::fs;
use std::io::Read;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::Duration;
use wait_timeout::ChildExt;

/// Empty directory, unique among tests and runs in the same target directory; it is removed when dropped.
pub struct Scratch(PathBuf);

impl Scratch {
    /// Creates a directory whose name contains `name`.
    pub fn new(name: &str) -> Self {
        let folder = format!("{name}-{}", std::process::id());
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder");
        Scratch(folder)
    }
}

impl Deref for Scratch {
    type Target = Path;
    fn deref(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Time limit: ten times the duration of the longest command on a busy machine. A command that exceeds it is
/// ended, and its test fails.
pub const DEADLINE: Duration = Duration::from_secs(60);

/// Returns the root of the project.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Returns the command without input.
pub fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_contact"))
}

/// Runs a command and returns its output, if it is piped.
pub fn run(command: &mut Command) -> Output {
    finish(command.stdin(Stdio::null()).spawn().expect("the command runs"))
}

/// Runs a command and captures both outputs.
pub fn captured(command: &mut Command) -> Output {
    run(command.stdout(Stdio::piped()).stderr(Stdio::piped()))
}

/// Waits for a command to end, with a time limit.
pub fn finish(mut child: Child) -> Output {
    let (stdout, stderr) = (collect(child.stdout.take()), collect(child.stderr.take()));
    let Some(status) = child.wait_timeout(DEADLINE).expect("a child") else {
        child.kill().and_then(|()| child.wait()).expect("the command can be ended");
        panic!("the command is still running after {DEADLINE:?}");
    };
    let [stdout, stderr] = [stdout, stderr].map(|bytes| bytes.join().expect("a pipe"));
    Output { status, stdout, stderr }
}

/// Reads while the command runs, since a full pipe would block it.
fn collect(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        pipe.map(|mut pipe| pipe.read_to_end(&mut bytes)).transpose().expect("a pipe");
        bytes
    })
}

/// Returns an integer from the environment.
pub fn asked(name: &str, default: u64) -> u64 {
    let value = std::env::var(name).ok();
    value.map_or(default, |text| {
        text.parse().unwrap_or_else(|_| panic!("{name}={text}: must be a whole number"))
    })
}

/// Returns the random generator of the n-th trial.
pub fn random(seed: u64, n: u64) -> Rand64 {
    Rand64::new(u128::from(seed) << 64 | u128::from(n))
}

pub fn pick<'a, T>(random: &mut Rand64, from: &'a [T]) -> &'a T {
    &from[random.rand_range(0..from.len() as u64) as usize]
}

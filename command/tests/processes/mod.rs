//! The command as a process, which ends in time or is ended.

#![allow(dead_code)] // every test file is a crate of its own and uses its share of this one

use oorandom::Rand64;
use std::fs;
use std::io::Read;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::Duration;
use wait_timeout::ChildExt;

/// An empty folder that no other test has, nor another run in the same target directory; it is removed in the end.
pub struct Scratch(PathBuf);

impl Scratch {
    /// With this name in its own.
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

/// Ten times what the longest command takes on a busy machine. What takes longer is ended, and its test fails.
pub const DEADLINE: Duration = Duration::from_secs(60);

/// It, with nothing said to it.
pub fn command() -> Command {
    Command::new(env!("CARGO_BIN_EXE_contact"))
}

/// What a command writes into pipes, if it has any, when it has ended.
pub fn run(command: &mut Command) -> Output {
    finish(command.stdin(Stdio::null()).spawn().expect("the command runs"))
}

/// Runs with both outputs captured.
pub fn captured(command: &mut Command) -> Output {
    run(command.stdout(Stdio::piped()).stderr(Stdio::piped()))
}

/// Waits for a command to end, but not for ever.
pub fn finish(mut child: Child) -> Output {
    let (stdout, stderr) = (collect(child.stdout.take()), collect(child.stderr.take()));
    let Some(status) = child.wait_timeout(DEADLINE).expect("a child") else {
        child.kill().and_then(|()| child.wait()).expect("the command can be ended");
        panic!("the command is still running after {DEADLINE:?}");
    };
    let [stdout, stderr] = [stdout, stderr].map(|bytes| bytes.join().expect("a pipe"));
    Output { status, stdout, stderr }
}

/// Reads while the command runs: it would wait for ever if a pipe were full.
fn collect(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<Vec<u8>> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        pipe.map(|mut pipe| pipe.read_to_end(&mut bytes)).transpose().expect("a pipe");
        bytes
    })
}

/// A whole number that the environment asks for.
pub fn asked(name: &str, default: u64) -> u64 {
    let value = std::env::var(name).ok();
    value.map_or(default, |text| {
        text.parse().unwrap_or_else(|_| panic!("{name}={text}: must be a whole number"))
    })
}

/// What the n-th of some trials draws from.
pub fn random(seed: u64, n: u64) -> Rand64 {
    Rand64::new(u128::from(seed) << 64 | u128::from(n))
}

pub fn pick<'a, T>(random: &mut Rand64, from: &'a [T]) -> &'a T {
    &from[random.rand_range(0..from.len() as u64) as usize]
}

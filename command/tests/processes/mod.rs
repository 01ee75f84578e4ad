//! The command as a child process with a time limit.

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

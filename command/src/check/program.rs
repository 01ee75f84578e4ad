//! Communication with a program over its stdin and stdout, robust against any behaviour.
//!
//! Separate threads write its stdin and read its stdout and stderr. They end with their pipes and are never
//! waited for, so a pipe that another process keeps open only costs a thread.

mod group;

use super::reply::{self, words};
use crate::args::{format_exact, invalid};
use crate::output::{Failure, shortened};
use group::Group;
pub use group::end_with_signals;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Problem, Reply};
use spring_mass_contact::number::Exact;
use std::collections::VecDeque;
use std::io::{self, Read, Write};
use std::process::{Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// Time for a program to end after its stdin or stdout is closed: an interpreter with its libraries needs
/// some tenths of a second.
const GRACE: Duration = Duration::from_secs(1);

/// Interval of polls for the end of a program that has left its stdout to another process.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Interval of polls for the end of a program that is about to end.
const EXIT_POLL_INTERVAL: Duration = Duration::from_millis(5);

/// Error of the operating system for a file whose format it cannot execute, for example a script without its
/// first line: ERROR_BAD_EXE_FORMAT or ENOEXEC.
const NO_FORMAT: i32 = if cfg!(windows) { 193 } else { 8 };

/// Number of bytes that are read at once.
const BLOCK_BYTES: usize = 1 << 16;

/// Number of bytes kept of stderr, the last ones.
const TAIL_BYTES: usize = 1 << 12;

/// An external program, which is started for the first problem and restarted after each failure.
pub struct Program {
    words: Vec<String>,
    timeout: Duration,
    /// Time for it to end by itself.
    grace: Duration,
    started: bool,
    running: Option<Running>,
}

impl Program {
    /// Returns the program with its name or path, its arguments, and a time limit for each answer.
    pub fn new(words: &[String], timeout: Duration) -> Self {
        Program { words: words.to_vec(), timeout, grace: GRACE, started: false, running: None }
    }

    /// Passes a problem to the program. Returns an error only if the program cannot be started.
    pub fn ask(&mut self, problem: &Problem) -> Result<Reply, Failure> {
        let deadline = Instant::now() + self.timeout;
        let mut running = match self.running.take() {
            Some(running) => running,
            None => match Running::start(&self.words) {
                Ok(running) => running,
                // A later failure to start is a failure of the program.
                Err(error) if self.started => {
                    return Ok(Reply::Crashed(format!("cannot be started again: {error}")));
                }
                Err(error) => return Err(self.refused(&error)),
            },
        };
        self.started = true;
        Ok(match running.ask(problem, deadline) {
            Ok(reply) => {
                self.running = Some(running);
                reply
            }
            Err(Unusable::Replied(reply)) => reply,
            Err(Unusable::Ended) => Reply::Crashed(running.end(self.grace)),
        })
    }

    fn refused(&self, error: &io::Error) -> Failure {
        let program = words(&self.words[0]);
        let must = match error.kind() {
            io::ErrorKind::NotFound => "must be the name of a program on the PATH, or its path",
            kind if kind == io::ErrorKind::PermissionDenied || error.raw_os_error() == Some(NO_FORMAT) => {
                "must be an executable program; a script begins with #!"
            }
            // A limit of the operating system, not a property of the program.
            _ => return format!("'{}' cannot be started: {error}", shortened(&program)).into(),
        };
        invalid(&program, "<PROGRAM>...", format!("cannot be started: {error}; {must}"))
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        if let Some(running) = &mut self.running {
            running.requests = None;
            running.ends(self.grace);
        }
    }
}

/// Returns the request for a problem, one line of JSON.
pub fn request(problem: &Problem) -> String {
    let system = SpringMass::KEYS.zip(problem.system.as_ref()).into_array();
    let numbers = system.into_iter().chain(problem.penalty.iter().map(|penalty| ("penalty", penalty)));
    let numbers = numbers.map(|(key, value)| format!(", \"{key}\": {}", number(value)));
    format!("{{\"id\": {}{}}}\n", serde_json::Value::from(problem.id.as_str()), numbers.collect::<String>())
}

/// Returns a JSON number, or a string for a fraction that is not a decimal.
fn number(x: &Exact) -> String {
    let text = format_exact(x);
    if text.contains('/') { format!("\"{text}\"") } else { text }
}

/// Reason why a running program cannot be used further: a reply, or its end.
enum Unusable {
    Replied(Reply),
    Ended,
}

/// A running program, which is killed with all its children when dropped.
struct Running {
    group: Group,
    /// Its stdin; `None` to close it.
    requests: Option<Sender<String>>,
    lines: Lines,
    /// The last bytes of stderr, after its end.
    stderr: Receiver<Vec<u8>>,
}

impl Running {
    fn start(words: &[String]) -> io::Result<Self> {
        let mut command = Command::new(&words[0]);
        command.args(&words[1..]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut group = Group::start(&mut command)?;
        let child = group.child();
        let (requests, queue) = mpsc::channel::<String>();
        let (blocks, unread) = mpsc::sync_channel(1);
        let (tail, stderr) = mpsc::channel();
        if let Some(mut stdin) = child.stdin.take() {
            thread(move || while queue.recv().is_ok_and(|line| stdin.write_all(line.as_bytes()).is_ok()) {})?;
        }
        if let Some(stdout) = child.stdout.take() {
            // No more is read ahead than two blocks.
            thread(move || read(stdout, |block| blocks.send(block.to_vec()).is_ok()))?;
        }
        if let Some(pipe) = child.stderr.take() {
            // It is read continuously, so that it never fills up.
            thread(move || {
                let mut last = Vec::new();
                read(pipe, |block| {
                    last.extend_from_slice(block);
                    last.drain(..last.len().saturating_sub(TAIL_BYTES));
                    true
                });
                let _ = tail.send(last);
            })?;
        }
        Ok(Running { group, requests: Some(requests), lines: Lines::of(unread), stderr })
    }

    fn ask(&mut self, problem: &Problem, deadline: Instant) -> Result<Reply, Unusable> {
        let left = || deadline.saturating_duration_since(Instant::now());
        let mut request = Some(request(problem));
        let mut last = Vec::new();
        loop {
            let ended = self.group.has_ended();
            let wait = if request.is_some() { Duration::ZERO } else { left().min(POLL_INTERVAL) };
            match self.lines.next(wait) {
                Ok(None) => {}
                // Output that precedes the request cannot be the answer.
                Ok(Some(line)) if request.is_some() => {
                    if let Some(reason) = reply::early(&line, &problem.id) {
                        return Err(Unusable::Replied(Reply::InvalidResponse(reason)));
                    }
                }
                Ok(Some(line)) => match reply::read(&line, &problem.id) {
                    Some(Ok(reply)) => return Ok(reply),
                    Some(Err(reason)) => return Err(Unusable::Replied(Reply::InvalidResponse(reason))),
                    None if line.trim_ascii().is_empty() => {}
                    None => last = line,
                },
                Err(RecvTimeoutError::Disconnected) => return Err(Unusable::Ended),
                Err(RecvTimeoutError::Timeout) => match (request.take(), &self.requests) {
                    // A program that does not read is detected by its stdout.
                    (Some(line), Some(requests)) => requests.send(line).unwrap_or_default(),
                    // Its previous output has had time to arrive.
                    _ if ended => return Err(Unusable::Ended),
                    _ => {}
                },
            }
            if left().is_zero() {
                let seen = match request {
                    Some(_) => "too much output on stdout before the first request".to_string(),
                    None => last_output(&self.lines.unfinished, &last),
                };
                return Err(Unusable::Replied(Reply::TimedOut(seen)));
            }
        }
    }

    /// Returns its exit status and its last line on stderr.
    fn end(mut self, grace: Duration) -> String {
        let ended = self.ends(grace);
        let status = match self.group.end() {
            Ok(status) if ended => {
                status.code().map_or(status.to_string(), |code| format!("exit status {code}"))
            }
            Ok(_) | Err(_) => "closed its stdout".to_string(),
        };
        // Another process may keep stderr open.
        let stderr = self.stderr.recv_timeout(GRACE).unwrap_or_default();
        let stderr = String::from_utf8_lossy(&stderr);
        match stderr.split(['\n', '\r']).map(words).rfind(|line| !line.is_empty()) {
            Some(line) => format!("{status}; on stderr: {line}"),
            None => status,
        }
    }

    /// Returns `true` if it ends by itself within `grace`.
    fn ends(&mut self, grace: Duration) -> bool {
        let start = Instant::now();
        while !self.group.has_ended() {
            if start.elapsed() >= grace {
                return false;
            }
            // Further output must not keep it from ending.
            if self.lines.blocks.recv_timeout(EXIT_POLL_INTERVAL).is_err() {
                thread::sleep(EXIT_POLL_INTERVAL);
            }
        }
        true
    }
}

/// Describes the output of a program that does not answer.
fn last_output(unfinished: &[u8], line: &[u8]) -> String {
    let (kind, line) = match (unfinished.trim_ascii(), line) {
        ([], []) => return "nothing on stdout; it may not flush its output".to_string(),
        ([], line) => ("not a JSON object", line),
        (part, _) => ("without a line break", part),
    };
    format!("last output, {kind}: {}", words(&String::from_utf8_lossy(line)))
}

/// Runs a function on a thread until its pipe is closed.
fn thread(run: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().spawn(run).map(drop)
}

/// Passes the blocks of a pipe on until it ends, or they are no longer taken.
fn read(mut pipe: impl Read, mut takes: impl FnMut(&[u8]) -> bool) {
    let mut block = vec![0; BLOCK_BYTES];
    while let Ok(count @ 1..) = pipe.read(&mut block)
        && takes(&block[..count])
    {}
}

/// The lines of stdout. Those that arrive together are available together, so that output after an answer is
/// seen before the next request.
struct Lines {
    blocks: Receiver<Vec<u8>>,
    complete: VecDeque<Vec<u8>>,
    /// The last line, as far as it has arrived.
    unfinished: Vec<u8>,
}

impl Lines {
    fn of(blocks: Receiver<Vec<u8>>) -> Self {
        Lines { blocks, complete: VecDeque::new(), unfinished: Vec::new() }
    }

    /// Returns the next line, or `None` if only a part of it arrives within `soon`. The last one may end without
    /// a line break.
    fn next(&mut self, soon: Duration) -> Result<Option<Vec<u8>>, RecvTimeoutError> {
        if self.complete.is_empty() {
            match self.blocks.recv_timeout(soon) {
                Ok(block) => self.add(&block),
                Err(RecvTimeoutError::Disconnected) if !self.unfinished.is_empty() => {
                    return Ok(Some(std::mem::take(&mut self.unfinished)));
                }
                Err(error) => return Err(error),
            }
        }
        Ok(self.complete.pop_front())
    }

    /// Adds a block. Of a line that is too long only one byte more than allowed is kept.
    fn add(&mut self, block: &[u8]) {
        for (i, part) in block.split(|byte| *byte == b'\n').enumerate() {
            if i > 0 {
                self.complete.push_back(std::mem::take(&mut self.unfinished));
            }
            let room = reply::MAX_LINE_BYTES + 1 - self.unfinished.len();
            self.unfinished.extend_from_slice(&part[..part.len().min(room)]);
        }
    }
}

#[cfg(all(test, unix))]
mod tests;

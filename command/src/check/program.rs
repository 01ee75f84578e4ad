//! Communication with a program over its stdin and stdout, robust against any behaviour.
//!
//! Separate threads write its stdin and read its stdout and stderr. They end with their pipes and are never
//! waited for, so a pipe that another process keeps open only costs a thread.

mod group;

use super::reply::{self, words};
use crate::args::{format_exact, invalid};
use crate::json::{BUFFER, read_lines};
use crate::output::{Failure, shortened};
use group::Group;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Problem, Reply};
use spring_mass_contact::number::Exact;
use std::io::{self, BufReader, Read, Write};
use std::process::{ChildStderr, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::thread;
use std::time::{Duration, Instant};

/// Time for a program to end after its stdin or stdout is closed: an interpreter with its libraries needs
/// some tenths of a second.
const GRACE: Duration = Duration::from_secs(1);

/// Interval of polls for the end of a program that has left its stdout to another process.
const POLL_INTERVAL: Duration = Duration::from_millis(50);

/// Interval of polls for the end of a program that is about to end.
const EXIT_POLL_INTERVAL: Duration = Duration::from_millis(5);

/// Requirement on the file of a program.
const EXECUTABLE: &str = "must be an executable program; a script begins with #!";

/// Number of bytes kept of stderr, the last ones.
const TAIL_BYTES: usize = 1 << 12;

/// Number of bytes kept of an unanswered line, for a message.
const MAX_ECHO_BYTES: usize = 400;

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
        let start = Instant::now();
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
        Ok(match running.ask(problem, || self.timeout.saturating_sub(start.elapsed())) {
            Ok(reply) => {
                self.running = Some(running);
                reply
            }
            Err(SessionError::UnexpectedReply(reason)) => Reply::InvalidResponse(reason),
            Err(SessionError::Ended) => Reply::Crashed(running.end(self.grace)),
            Err(SessionError::TimedOut(seen)) => Reply::TimedOut(seen),
        })
    }

    fn refused(&self, error: &io::Error) -> Failure {
        let must = match error.kind() {
            io::ErrorKind::NotFound => "must be the name of a program on the PATH, or its path",
            io::ErrorKind::PermissionDenied => EXECUTABLE,
            _ if group::has_no_format(error) => EXECUTABLE,
            // A limit of the operating system, not a property of the program.
            _ => return format!("'{}' cannot be started: {error}", shortened(&words(&self.words[0]))).into(),
        };
        let reason = format!("cannot be started: {error}; {must}");
        invalid(&words(&self.words[0]), "<PROGRAM>...", reason)
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        if let Some(running) = self.running.take() {
            running.close(self.grace);
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

/// Reason why a running program cannot be used further.
enum SessionError {
    /// It returned something other than the answer.
    UnexpectedReply(String),
    Ended,
    /// It did not answer in time; describes its output.
    TimedOut(String),
}

/// A running program, which is killed with all its children when dropped.
struct Running {
    group: Group,
    requests: Sender<String>,
    lines: Lines,
    stderr: Tail,
}

impl Running {
    fn start(words: &[String]) -> io::Result<Self> {
        let mut command = Command::new(&words[0]);
        command.args(&words[1..]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut group = Group::start(&mut command)?;
        let child = group.child();
        let pipe = "a piped stream";
        Ok(Running {
            requests: writer(child.stdin.take().expect(pipe))?,
            lines: Lines::of(child.stdout.take().expect(pipe))?,
            stderr: Tail::of(child.stderr.take().expect(pipe))?,
            group,
        })
    }

    fn ask(&mut self, problem: &Problem, left: impl Fn() -> Duration) -> Result<Reply, SessionError> {
        // Output that precedes the request cannot be the answer.
        loop {
            match self.lines.next(Duration::ZERO) {
                Ok(line) => reply::early(line, &problem.id)
                    .map_or(Ok(()), |reason| Err(SessionError::UnexpectedReply(reason)))?,
                Err(RecvTimeoutError::Timeout) => break,
                Err(RecvTimeoutError::Disconnected) => return Err(SessionError::Ended),
            }
            if left().is_zero() {
                return Err(SessionError::TimedOut(
                    "too much output on stdout before the first request".to_string(),
                ));
            }
        }
        // A program that does not read is detected by its stdout.
        let _ = self.requests.send(request(problem));
        let mut last = Vec::new();
        loop {
            let ended = self.group.has_ended();
            match self.lines.next(left().min(POLL_INTERVAL)) {
                Ok(line) => {
                    if let Some(reply) = reply::read(line, &problem.id) {
                        return reply.map_err(SessionError::UnexpectedReply);
                    }
                    if !line.trim_ascii().is_empty() {
                        last = line[..line.len().min(MAX_ECHO_BYTES)].to_vec();
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return Err(SessionError::Ended),
                // Its previous output has had time to arrive.
                Err(RecvTimeoutError::Timeout) if ended => return Err(SessionError::Ended),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if left().is_zero() {
                return Err(SessionError::TimedOut(last_output(&self.lines.unfinished(), &last)));
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
        match self.stderr.last_line() {
            Some(line) => format!("{status}; on stderr: {line}"),
            None => status,
        }
    }

    /// Closes its stdin, and lets it end by itself within `grace`.
    fn close(mut self, grace: Duration) {
        let (nobody, _) = mpsc::channel();
        drop(std::mem::replace(&mut self.requests, nobody));
        self.ends(grace);
    }

    /// Returns `true` if it ends by itself within `grace`.
    fn ends(&mut self, grace: Duration) -> bool {
        let start = Instant::now();
        loop {
            if self.group.has_ended() {
                return true;
            }
            if start.elapsed() >= grace {
                return false;
            }
            // Further output must not keep it from ending.
            if self.lines.blocks.recv_timeout(EXIT_POLL_INTERVAL).is_err() {
                thread::sleep(EXIT_POLL_INTERVAL);
            }
        }
    }
}

/// Describes the output of a program that does not answer.
fn last_output(unfinished: &[u8], line: &[u8]) -> String {
    let (kind, line) = match (unfinished, line) {
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

/// Starts a thread that writes what is sent, as fast as the program reads.
fn writer(mut stdin: ChildStdin) -> io::Result<Sender<String>> {
    let (requests, queue) = mpsc::channel::<String>();
    thread(move || while queue.recv().is_ok_and(|line| stdin.write_all(line.as_bytes()).is_ok()) {})?;
    Ok(requests)
}

/// The lines of stdout. Lines that arrive together are passed on together, so that output after an answer is
/// available before the next request; no more is read ahead.
struct Lines {
    blocks: Receiver<Vec<u8>>,
    block: Vec<u8>,
    start: usize,
    unfinished: Arc<Mutex<Vec<u8>>>,
}

/// stdout, whose incomplete last line is visible to other threads.
struct Watched {
    stdout: ChildStdout,
    unfinished: Arc<Mutex<Vec<u8>>>,
}

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.stdout.read(buffer)?;
        let read = &buffer[..count];
        let mut unfinished = self.unfinished.lock().unwrap_or_else(PoisonError::into_inner);
        let line = read.rsplit(|byte| *byte == b'\n').next().unwrap_or(read);
        if line.len() < read.len() {
            unfinished.clear();
        }
        let room = MAX_ECHO_BYTES.saturating_sub(unfinished.len());
        unfinished.extend_from_slice(&line[..line.len().min(room)]);
        Ok(count)
    }
}

impl Lines {
    fn of(stdout: ChildStdout) -> io::Result<Self> {
        let (to, blocks) = mpsc::sync_channel(1);
        let unfinished = Arc::new(Mutex::new(Vec::new()));
        let stdout = Watched { stdout, unfinished: unfinished.clone() };
        thread(move || {
            let mut stdout = BufReader::with_capacity(BUFFER, stdout);
            loop {
                let mut block = Vec::new();
                let read = read_lines(&mut stdout, usize::MAX, reply::MAX_LINE_BYTES, &mut block);
                let ended = read.is_err() || block.is_empty();
                if to.send(block).is_err() || ended {
                    return;
                }
            }
        })?;
        Ok(Lines { blocks, block: Vec::new(), start: 0, unfinished })
    }

    /// Returns the incomplete last line.
    fn unfinished(&self) -> Vec<u8> {
        self.unfinished.lock().unwrap_or_else(PoisonError::into_inner).trim_ascii().to_vec()
    }

    /// Returns the next line, if it arrives within `soon`.
    fn next(&mut self, soon: Duration) -> Result<&[u8], RecvTimeoutError> {
        if self.start == self.block.len() {
            (self.block, self.start) = (Vec::new(), 0);
            self.block = self.blocks.recv_timeout(soon)?;
        }
        let rest = &self.block[self.start..];
        let line = rest.split(|byte| *byte == b'\n').next().unwrap_or(rest);
        self.start = (self.start + line.len() + 1).min(self.block.len());
        Ok(line)
    }
}

/// The end of stderr, which is read continuously so that it never fills up.
struct Tail {
    bytes: Arc<Mutex<Vec<u8>>>,
    ended: Receiver<()>,
}

impl Tail {
    fn of(mut stderr: ChildStderr) -> io::Result<Self> {
        let bytes = Arc::new(Mutex::new(Vec::new()));
        let tail: Weak<_> = Arc::downgrade(&bytes);
        let (reading, ended) = mpsc::channel();
        thread(move || {
            let _reading = reading;
            let mut some = [0; TAIL_BYTES];
            while let Ok(count @ 1..) = stderr.read(&mut some)
                && let Some(tail) = tail.upgrade()
            {
                let mut tail = tail.lock().unwrap_or_else(PoisonError::into_inner);
                tail.extend_from_slice(&some[..count]);
                let surplus = tail.len().saturating_sub(TAIL_BYTES);
                tail.drain(..surplus);
            }
        })?;
        Ok(Tail { bytes, ended })
    }

    /// Returns the last line that is not blank, after the end of stderr.
    fn last_line(&self) -> Option<String> {
        // The channel is closed at the end. Another process may keep the pipe open.
        let _ = self.ended.recv_timeout(GRACE);
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&bytes);
        text.split(['\n', '\r']).map(words).rfind(|line| !line.is_empty())
    }
}

#[cfg(all(test, unix))]
mod tests;

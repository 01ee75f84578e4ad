//! A program that is asked over its stdin and answers on its stdout, whatever it does.
//!
//! Threads of their own write its stdin and read its stdout and stderr, and nobody waits for them: each ends
//! with its pipe, and a pipe that a stranger keeps open costs nothing but that thread.

mod group;

use super::reply::{self, words};
use crate::args::{invalid, spelled};
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

/// How long a program may take to end once its stdin is closed, or its stdout: an interpreter with its
/// libraries loaded takes some tenths of a second, and who waits for the command hardly notices one.
const GRACE: Duration = Duration::from_secs(1);

/// How often to look whether a program has ended that left its stdout to another.
const LOOK: Duration = Duration::from_millis(50);

/// How often to look whether a program has ended that is about to.
const SOON: Duration = Duration::from_millis(5);

/// Allowed of a file that is to be a program.
const EXECUTABLE: &str = "must be a program that can be executed; a script begins with #!";

/// Bytes of stderr that are kept, the last.
const TAIL: usize = 1 << 12;

/// Bytes of a line that are kept to be shown, should no answer come.
const LAST: usize = 400;

/// A program, started when it is first asked and again after each time that it had to be given up.
pub struct Program {
    words: Vec<String>,
    timeout: Duration,
    /// How long it may take to end by itself.
    grace: Duration,
    started: bool,
    running: Option<Running>,
}

impl Program {
    /// The program that these words start: its name or path, the first of them, and its arguments; it has so
    /// long for each answer.
    pub fn new(words: &[String], timeout: Duration) -> Self {
        Program { words: words.to_vec(), timeout, grace: GRACE, started: false, running: None }
    }

    /// Puts a problem. Fails only if the program cannot be started.
    pub fn ask(&mut self, problem: &Problem) -> Result<Reply, Failure> {
        let start = Instant::now();
        let left = || self.timeout.saturating_sub(start.elapsed());
        let mut running = match self.running.take() {
            Some(running) => running,
            None => match Running::start(&self.words) {
                Ok(running) => running,
                // What it has done to itself, or to us, is its own.
                Err(error) if self.started => {
                    return Ok(Reply::Crashed(format!("cannot be started again: {error}")));
                }
                Err(error) => return Err(self.refused(&error)),
            },
        };
        self.started = true;
        Ok(match running.ask(problem, left) {
            Ok(reply) => {
                self.running = Some(running);
                reply
            }
            Err(Lost::Astray(why)) => Reply::Garbled(why),
            Err(Lost::Ended) => Reply::Crashed(running.end(self.grace)),
            Err(Lost::TimedOut(seen)) => Reply::TimedOut(seen),
        })
    }

    fn refused(&self, error: &io::Error) -> Failure {
        let must = match error.kind() {
            io::ErrorKind::NotFound => "must be the name of a program on the path, or its own path",
            io::ErrorKind::PermissionDenied => EXECUTABLE,
            _ if group::has_no_format(error) => EXECUTABLE,
            // The system lacks something, or allows no more; no other program would do.
            _ => return format!("'{}' cannot be started: {error}", shortened(&words(&self.words[0]))).into(),
        };
        let why = format!("cannot be started: {error}; {must}");
        invalid(&words(&self.words[0]), "<PROGRAM>...", why)
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        if let Some(running) = self.running.take() {
            running.close(self.grace);
        }
    }
}

/// The line that puts a problem.
pub fn request(problem: &Problem) -> String {
    let system = SpringMass::KEYS.zip(problem.system.as_ref()).into_array();
    let numbers = system.into_iter().chain(problem.penalty.iter().map(|penalty| ("penalty", penalty)));
    let numbers = numbers.map(|(key, value)| format!(", \"{key}\": {}", number(value)));
    format!("{{\"id\": {}{}}}\n", serde_json::Value::from(problem.id.as_str()), numbers.collect::<String>())
}

/// A JSON number, or a string where there is none: a fraction that is no decimal.
fn number(x: &Exact) -> String {
    let text = spelled(x);
    if text.contains('/') { format!("\"{text}\"") } else { text }
}

/// Why a program cannot be asked any further.
enum Lost {
    /// It answers, but not what it was asked.
    Astray(String),
    Ended,
    /// And what it did say.
    TimedOut(String),
}

/// A program that has been started. Dropped, it ends at once, with all that it has started itself.
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
        let pipe = "a pipe was asked for";
        Ok(Running {
            requests: writer(child.stdin.take().expect(pipe))?,
            lines: Lines::of(child.stdout.take().expect(pipe))?,
            stderr: Tail::of(child.stderr.take().expect(pipe))?,
            group,
        })
    }

    fn ask(&mut self, problem: &Problem, left: impl Fn() -> Duration) -> Result<Reply, Lost> {
        // What has come by now cannot be the answer, whatever its id is.
        loop {
            match self.lines.next(Duration::ZERO) {
                Ok(line) => reply::early(line, &problem.id).map_or(Ok(()), |why| Err(Lost::Astray(why)))?,
                Err(RecvTimeoutError::Timeout) => break,
                Err(RecvTimeoutError::Disconnected) => return Err(Lost::Ended),
            }
            if left().is_zero() {
                return Err(Lost::TimedOut("too much on stdout before it was asked".to_string()));
            }
        }
        // Nobody takes it from a program that does not read; what becomes of that shows on its stdout.
        let _ = self.requests.send(request(problem));
        let mut last = Vec::new();
        loop {
            let ended = self.group.has_ended();
            match self.lines.next(left().min(LOOK)) {
                Ok(line) => {
                    if let Some(reply) = reply::read(line, &problem.id) {
                        return reply.map_err(Lost::Astray);
                    }
                    if !line.trim_ascii().is_empty() {
                        last = line[..line.len().min(LAST)].to_vec();
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return Err(Lost::Ended),
                // What it said before has had time to come.
                Err(RecvTimeoutError::Timeout) if ended => return Err(Lost::Ended),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if left().is_zero() {
                let shown = |line: &[u8]| words(&String::from_utf8_lossy(line));
                return Err(Lost::TimedOut(match (&*self.lines.unfinished(), &*last) {
                    ([], []) => "nothing on stdout: does it flush?".to_string(),
                    ([], line) => format!("last on stdout, and no JSON object: {}", shown(line)),
                    (part, _) => format!("last on stdout, without a line break: {}", shown(part)),
                }));
            }
        }
    }

    /// How it has ended, and the last that it said on stderr.
    fn end(mut self, grace: Duration) -> String {
        let ended = self.ends(grace);
        let status = self.group.end();
        let how = match status {
            Ok(status) if ended => {
                status.code().map_or(status.to_string(), |code| format!("exit status {code}"))
            }
            Ok(_) | Err(_) => "closed its stdout".to_string(),
        };
        match self.stderr.last_line() {
            Some(line) => format!("{how}; on stderr: {line}"),
            None => how,
        }
    }

    /// Has it end by itself if it can.
    fn close(mut self, grace: Duration) {
        let (nobody, _) = mpsc::channel();
        drop(std::mem::replace(&mut self.requests, nobody));
        self.ends(grace);
    }

    /// Whether it ends by itself within `grace`.
    fn ends(&mut self, grace: Duration) -> bool {
        let start = Instant::now();
        loop {
            if self.group.has_ended() {
                return true;
            }
            if start.elapsed() >= grace {
                return false;
            }
            // What it still prints must not keep it from ending.
            if self.lines.blocks.recv_timeout(SOON).is_err() {
                thread::sleep(SOON);
            }
        }
    }
}

/// Runs beside the rest until its pipe is closed.
fn thread(run: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().spawn(run).map(drop)
}

/// What is sent is written, as fast as the program reads.
fn writer(mut stdin: ChildStdin) -> io::Result<Sender<String>> {
    let (requests, queue) = mpsc::channel::<String>();
    thread(move || while queue.recv().is_ok_and(|line| stdin.write_all(line.as_bytes()).is_ok()) {})?;
    Ok(requests)
}

/// The lines of stdout. What came at once is passed on at once, so that what follows an answer on its heels
/// is there before the next question; and no more than that is read ahead.
struct Lines {
    blocks: Receiver<Vec<u8>>,
    block: Vec<u8>,
    start: usize,
    unfinished: Arc<Mutex<Vec<u8>>>,
}

/// stdout, whose beginning of a line that has not ended is kept for others to see.
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
        let room = LAST.saturating_sub(unfinished.len());
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
                let read = read_lines(&mut stdout, usize::MAX, reply::LONGEST, &mut block);
                let ended = read.is_err() || block.is_empty();
                if to.send(block).is_err() || ended {
                    return;
                }
            }
        })?;
        Ok(Lines { blocks, block: Vec::new(), start: 0, unfinished })
    }

    /// The beginning of a line that has not ended.
    fn unfinished(&self) -> Vec<u8> {
        self.unfinished.lock().unwrap_or_else(PoisonError::into_inner).trim_ascii().to_vec()
    }

    /// The next line, if it comes so soon.
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

/// The end of stderr, which is read so that it never fills up.
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
            let mut some = [0; TAIL];
            while let Ok(count @ 1..) = stderr.read(&mut some)
                && let Some(tail) = tail.upgrade()
            {
                let mut tail = tail.lock().unwrap_or_else(PoisonError::into_inner);
                tail.extend_from_slice(&some[..count]);
                let surplus = tail.len().saturating_sub(TAIL);
                tail.drain(..surplus);
            }
        })?;
        Ok(Tail { bytes, ended })
    }

    /// The last line that says anything, once all has come.
    fn last_line(&self) -> Option<String> {
        // Nothing is sent: at its end the channel is closed. Whoever else has that pipe may keep it open.
        let _ = self.ended.recv_timeout(GRACE);
        let bytes = self.bytes.lock().unwrap_or_else(PoisonError::into_inner);
        let text = String::from_utf8_lossy(&bytes);
        text.split(['\n', '\r']).map(words).rfind(|line| !line.is_empty())
    }
}

#[cfg(all(test, unix))]
mod tests;

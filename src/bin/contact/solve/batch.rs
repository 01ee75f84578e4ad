//! `contact solve --batch`: JSON lines in, JSON lines out, in the same order.
//!
//! A worker that is free takes the next lines that are there, at most a few, and never waits for more of
//! them. It answers through a channel of its own, and these channels stand in a queue, in the order of the
//! lines. Queue and channels have little room: where a line takes long, the others wait and are not kept.

use super::{Format, MethodName, Options};
use crate::args::{finite, invalid, positive, whole};
use crate::json::{self, BUFFER, Object};
use crate::output::{self, Exit, Failure, shortened};
use clap::ValueEnum;
use serde_json::value::{RawValue, Value};
use std::fmt::Display;
use std::io::{self, BufReader, Stdin};
use std::num::NonZero;
use std::panic::resume_unwind;
use std::sync::mpsc::{self, Receiver, SyncSender};
use std::sync::{Arc, Mutex};
use std::thread;

/// Bytes that a line may have: longer ones are not kept, whatever they are.
const LONGEST: usize = 1 << 20;

/// Lines that a worker takes at once: enough that waking one costs little beside them, few enough that all
/// have something to do where each line takes long.
const AT_ONCE: usize = 16;

/// Solves what stdin says, a system a line.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let defaults = Arc::new(Options { format: Format::Line, ..options.clone() });
    let workers = thread::available_parallelism().map_or(1, NonZero::get);
    let (queue, blocks) = mpsc::sync_channel(2 * workers);
    let input = Input { stdin: BufReader::with_capacity(BUFFER, io::stdin()), queue };
    let input = Arc::new(Mutex::new(Some(input)));
    // They are left behind where stdout is closed: one of them may be waiting for a line that never comes.
    let worker = |_| {
        let (input, defaults) = (Arc::clone(&input), Arc::clone(&defaults));
        thread::Builder::new().spawn(move || work(&input, &defaults))
    };
    let workers: io::Result<Vec<_>> = (0..workers).map(worker).collect();
    let workers = workers.map_err(|error| format!("no thread to be had: {error}"))?;
    drop(input);
    output::print_answer(|out| {
        let mut exit = Exit::Fine;
        for block in blocks {
            for answers in block.map_err(|error| format!("stdin cannot be read: {error}"))? {
                out.write_all(&answers.text)?;
                exit = exit.max(answers.exit);
            }
            out.flush()?;
        }
        for worker in workers {
            worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        }
        Ok(exit)
    })
}

/// Some answers, a line each.
struct Answers {
    text: Vec<u8>,
    exit: Exit,
}

/// Where lines come from, and the queue that keeps their order.
struct Input {
    stdin: BufReader<Stdin>,
    queue: SyncSender<io::Result<Receiver<Answers>>>,
}

impl Input {
    /// Lines, and where their answers go; `None` at the end, and when nobody listens any more.
    fn next(&mut self) -> Option<(Vec<u8>, SyncSender<Answers>)> {
        let mut lines = Vec::new();
        let read = json::read_lines(&mut self.stdin, AT_ONCE, LONGEST, &mut lines);
        let (answers, block) = mpsc::sync_channel(1);
        match read {
            Ok(()) if lines.is_empty() => None,
            Ok(()) => self.queue.send(Ok(block)).is_ok().then_some((lines, answers)),
            Err(error) => {
                let _ = self.queue.send(Err(error));
                None
            }
        }
    }
}

fn work(input: &Mutex<Option<Input>>, defaults: &Options) {
    loop {
        let mut input = input.lock().expect("reading does not panic");
        let Some((lines, to)) = input.as_mut().and_then(Input::next) else {
            // Nobody reads on: at the end of what is typed there would have to be a second one.
            *input = None;
            return;
        };
        drop(input);
        let mut answers = Answers { text: Vec::new(), exit: Exit::Fine };
        for line in lines.split(|byte| *byte == b'\n').filter(|line| !line.trim_ascii().is_empty()) {
            answers.exit = answers.exit.max(answer(line, defaults, &mut answers.text));
            if answers.text.len() > BUFFER {
                let full = Answers { text: std::mem::take(&mut answers.text), ..answers };
                if to.send(full).is_err() {
                    return;
                }
            }
        }
        if to.send(answers).is_err() {
            return;
        }
    }
}

/// Solves what a line says, and writes a line.
fn answer(line: &[u8], defaults: &Options, out: &mut Vec<u8>) -> Exit {
    let object = read(line);
    let id = object.as_ref().ok().and_then(|object| object.get("id")).map_or("null", RawValue::get);
    // Between the parts of a JSON text it is a blank, and some would take it for the end of the line.
    out.extend_from_slice(format!("{{\"id\":{},", id.replace('\r', " ")).as_bytes());
    let start = out.len();
    let answered = object.and_then(|object| defaults.with(&object)?.answer(out));
    let exit = answered.unwrap_or_else(|failure| {
        out.truncate(start);
        let error = Value::from(failure.to_string());
        out.extend_from_slice(format!("{{\"error\":{error}}}").as_bytes());
        Exit::Unmet
    });
    out.remove(start); // The object has begun with its id.
    out.push(b'\n');
    exit
}

/// The object that a line is.
fn read(line: &[u8]) -> Result<Object<'_>, Failure> {
    if line.len() > LONGEST {
        return Err(format!("a line must have no more than {LONGEST} bytes").into());
    }
    let refused = |why: &dyn Display| {
        let text = String::from_utf8_lossy(line);
        format!("invalid line '{}': {why}; a line is a JSON object", shortened(text.trim()))
    };
    let text = str::from_utf8(line).map_err(|_| refused(&"must be UTF-8 text"))?;
    Ok(serde_json::from_str(text).map_err(|error| {
        // Which line of the line is no news.
        let why = error.to_string();
        let place = format!(" at line {} column {}", error.line(), error.column());
        refused(&match why.strip_suffix(&place) {
            Some(why) => format!("{why} at column {}", error.column()),
            None => why,
        })
    })?)
}

/// Sets an option; or what is allowed.
type Set = fn(&mut Options, &str) -> Result<(), String>;

/// The keys besides `id`: those of the long options.
const KEYS: [(&str, Set); 12] = [
    ("stiffness", |to, text| put(&mut to.system.stiffness, positive(text))),
    ("mass", |to, text| put(&mut to.system.mass, positive(text))),
    ("gravity", |to, text| put(&mut to.system.gravity, finite(text))),
    ("free_length", |to, text| put(&mut to.system.free_length, finite(text))),
    ("height", |to, text| put(&mut to.system.height, finite(text))),
    ("method", |to, text| put(&mut to.method, MethodName::read(text))),
    ("penalty", |to, text| put(&mut to.penalty, positive(text).map(Some))),
    ("tolerance", |to, text| put(&mut to.tolerance, positive(text).map(Some))),
    ("max_augmentations", |to, text| put(&mut to.max_augmentations, whole(text).map(Some))),
    ("initial_multiplier", |to, text| put(&mut to.initial_multiplier, finite(text).map(Some))),
    ("bilateral", |to, text| {
        put(&mut to.bilateral, text.parse().map_err(|_| "must be true or false".into()))
    }),
    ("scalar", |to, text| put(&mut to.scalar, text.parse().map_err(|error| format!("{error}")))),
];

fn put<T>(place: &mut T, read: Result<T, String>) -> Result<(), String> {
    *place = read?;
    Ok(())
}

impl Options {
    /// These, but for what a line says.
    fn with(&self, line: &Object) -> Result<Options, Failure> {
        let mut options = self.clone();
        if let Some(method) = line.get("method") {
            options.set("method", method)?;
        }
        options.forget_unused();
        let mut seen = [false; KEYS.len() + 1];
        for (key, value) in &line.0 {
            let place = if key == "id" { KEYS.len() } else { options.set(key, value)? };
            if std::mem::replace(&mut seen[place], true) {
                return Err(format!("the key '{key}' cannot be used multiple times").into());
            }
        }
        Ok(options)
    }

    /// Sets an option by its key, and says which of them it was.
    fn set(&mut self, key: &str, value: &RawValue) -> Result<usize, Failure> {
        let Some(place) = KEYS.iter().position(|(own, _)| *own == key) else {
            let keys = KEYS.map(|(key, _)| key).join(", ");
            return Err(format!("unexpected key '{}' found; [keys: id, {keys}]", shortened(key)).into());
        };
        let text = json::text(value);
        KEYS[place].1(self, &text).map_err(|why| invalid(&text, key, why))?;
        Ok(place)
    }

    /// What stands on the command line is for the lines that have a use for it.
    fn forget_unused(&mut self) {
        if self.method != MethodName::Augmented {
            (self.tolerance, self.max_augmentations, self.initial_multiplier) = (None, None, None);
        }
        if self.method == MethodName::Lagrange {
            self.penalty = None;
        }
    }
}

impl MethodName {
    fn read(text: &str) -> Result<Self, String> {
        let names = || Self::value_variants().iter().map(|method| method.name()).collect::<Vec<_>>();
        Self::from_str(text, false).map_err(|_| format!("[possible values: {}]", names().join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::key;
    use clap::Args;

    #[test]
    fn a_line_has_the_keys_of_the_long_options() {
        let command = Options::augment_args(clap::Command::new("solve"));
        let options = command.get_arguments().filter_map(|option| option.get_long());
        let own = ["format", "trace", "batch"];
        let options: Vec<_> = options.filter(|option| !own.contains(option)).map(key).collect();
        assert_eq!(options, KEYS.map(|(key, _)| key));
    }
}

//! `contact solve --batch`: JSON lines in, JSON lines out, in the same order.
//!
//! Lines that arrive together are solved together on all cores, before more is read.

use super::{MethodName, Options};
use crate::args::{invalid, parse_number, parse_positive, parse_u64};
use crate::json::{self, BUFFER, Object};
use crate::output::{self, Exit, Failure, shortened};
use clap::ValueEnum;
use rayon::prelude::*;
use serde_json::value::{RawValue, Value};
use std::io::{self, BufReader};

/// Largest number of bytes of a line; longer ones are discarded.
const MAX_LINE_BYTES: usize = 1 << 20;

/// Number of lines per core that are solved at once: large enough to make distributing them cheap, small
/// enough to limit memory.
const AT_ONCE: usize = 64;

/// Solves the systems on stdin, one per line.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().build_global();
    pool.map_err(|error| format!("cannot start a thread: {error}"))?;
    let mut stdin = BufReader::with_capacity(BUFFER, io::stdin());
    let most = AT_ONCE * rayon::current_num_threads();
    output::print_answer(|out| {
        let (mut exit, mut lines) = (Exit::Success, Vec::new());
        loop {
            lines.clear();
            json::read_lines(&mut stdin, most, MAX_LINE_BYTES, &mut lines)
                .map_err(|error| format!("cannot read stdin: {error}"))?;
            if lines.is_empty() {
                return Ok(exit);
            }
            let lines = lines.split(|byte| *byte == b'\n').filter(|line| !line.trim_ascii().is_empty());
            let lines: Vec<_> = lines.collect();
            let answers: Vec<_> = lines.par_iter().map(|line| answer(line, options)).collect();
            for (text, status) in answers {
                out.write_all(&text)?;
                exit = exit.max(status);
            }
            out.flush()?;
        }
    })
}

/// Returns the answer to a line as a line.
fn answer(line: &[u8], defaults: &Options) -> (Vec<u8>, Exit) {
    let object = read(line);
    let id = object.as_ref().ok().and_then(|object| object.get("id")).map_or("null", RawValue::get);
    // In JSON it is white space, but some readers would take it for the end of the line.
    let mut out = format!("{{\"id\":{},", id.replace('\r', " ")).into_bytes();
    let start = out.len();
    let answered = object.and_then(|object| defaults.with(&object)?.answer(&mut out));
    let exit = answered.unwrap_or_else(|failure| {
        out.truncate(start);
        let error = Value::from(failure.to_string());
        out.extend_from_slice(format!("{{\"error\":{error}}}").as_bytes());
        Exit::Unsatisfied
    });
    out.remove(start); // The object has begun with its id.
    out.push(b'\n');
    (out, exit)
}

/// Returns the object in a line.
fn read(line: &[u8]) -> Result<Object<'_>, Failure> {
    if line.len() > MAX_LINE_BYTES {
        return Err(format!("a line must have no more than {MAX_LINE_BYTES} bytes").into());
    }
    let object = match str::from_utf8(line) {
        Err(_) => Err("must be UTF-8 text".to_string()),
        Ok(text) => serde_json::from_str(text.trim_start_matches('\u{feff}')).map_err(json_error),
    };
    Ok(object.map_err(|reason| {
        let text = String::from_utf8_lossy(line);
        format!("invalid line '{}': {reason}; a line is a JSON object", shortened(text.trim()))
    })?)
}

/// Formats an error without the number of the line, which is 1.
fn json_error(error: serde_json::Error) -> String {
    let reason = error.to_string();
    match reason.strip_suffix(&format!(" at line {} column {}", error.line(), error.column())) {
        Some(reason) => format!("{reason} at column {}", error.column()),
        None => reason,
    }
}

/// Sets an option, or returns the values allowed.
type Set = fn(&mut Options, &str) -> Result<(), String>;

/// Keys in addition to `id`, named like the long options.
const KEYS: [(&str, Set); 12] = [
    ("stiffness", |to, text| put(&mut to.system.stiffness, parse_positive(text))),
    ("mass", |to, text| put(&mut to.system.mass, parse_positive(text))),
    ("gravity", |to, text| put(&mut to.system.gravity, parse_number(text))),
    ("free_length", |to, text| put(&mut to.system.free_length, parse_number(text))),
    ("height", |to, text| put(&mut to.system.height, parse_number(text))),
    ("method", |to, text| put(&mut to.method, MethodName::read(text))),
    ("penalty", |to, text| put(&mut to.penalty, parse_positive(text).map(Some))),
    ("tolerance", |to, text| put(&mut to.tolerance, parse_positive(text).map(Some))),
    ("max_augmentations", |to, text| put(&mut to.max_augmentations, parse_u64(text).map(Some))),
    ("initial_multiplier", |to, text| put(&mut to.initial_multiplier, parse_number(text).map(Some))),
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
    /// Returns these options with the values of a line.
    fn with(&self, line: &Object) -> Result<Options, Failure> {
        let mut options = self.clone();
        if let Some(method) = line.get("method") {
            options.set("method", method)?;
        }
        options.forget_unused();
        for (place, (key, value)) in line.0.iter().enumerate() {
            if key != "id" {
                options.set(key, value)?;
            }
            if line.0[..place].iter().any(|(other, _)| other == key) {
                return Err(format!("the key '{key}' cannot be used multiple times").into());
            }
        }
        Ok(options)
    }

    /// Sets an option by its key.
    fn set(&mut self, key: &str, value: &RawValue) -> Result<(), Failure> {
        let Some((_, set)) = KEYS.iter().find(|(other, _)| *other == key) else {
            let keys = KEYS.map(|(key, _)| key).join(", ");
            return Err(format!("unexpected key '{}' found; [keys: id, {keys}]", shortened(key)).into());
        };
        let text = json::text(value);
        set(self, &text).map_err(|reason| invalid(&text, key, reason))
    }

    /// Removes options of the command line that the method does not use.
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
        Self::from_str(text, false).map_err(|_| {
            let names: Vec<_> = Self::value_variants().iter().map(|method| method.name()).collect();
            format!("[possible values: {}]", names.join(", "))
        })
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
        let excluded = ["format", "trace", "batch"];
        let options: Vec<_> = options.filter(|option| !excluded.contains(option)).map(key).collect();
        assert_eq!(options, KEYS.map(|(key, _)| key));
    }
}

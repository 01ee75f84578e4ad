//! Answers in a table in place of a program: CSV, or JSON lines as a program prints them.

use super::reply::{self, words};
use crate::args::invalid;
use crate::output::{Failure, shortened};
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Problem, Reply};
use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{self, Read};

/// Largest number of bytes of a table.
const MAX_BYTES: u64 = 1 << 28;

/// The formats that are read, in a message.
const FORMATS: &str = "columns are named in the first line and separated by commas, numbers have a decimal point, and JSON has \
                   an object on each line";

/// Answers with their problems, and the systems without an answer.
type Table = (Vec<(Problem, Reply)>, Vec<Problem>);

/// Returns the answers in a file, or on stdin for `-`, to drawn systems or to those of its rows.
pub fn read(path: &str, drawn: Vec<Problem>) -> Result<Table, Failure> {
    let table = text(path, MAX_BYTES).and_then(|text| table(text.trim_start_matches('\u{feff}'), drawn));
    table.map_err(|reason| invalid(path, "--answers <FILE>", reason))
}

fn table(text: &str, drawn: Vec<Problem>) -> Result<Table, String> {
    let text = &text.replace("\r\n", "\n").replace('\r', "\n");
    let is_json = text.trim_start().starts_with('{');
    let lines = if is_json { (1..).zip(text.lines().map(String::from)).collect() } else { csv_lines(text)? };
    let known: HashMap<&str, &Problem> = drawn.iter().map(|problem| (&*problem.id, problem)).collect();
    let penalty = drawn.first().and_then(|problem| problem.penalty.clone());
    let (mut answers, mut missing, mut ids) = (Vec::new(), Vec::new(), HashSet::new());
    for (number, line) in lines.into_iter().filter(|(_, line)| !line.trim().is_empty()) {
        let at_line = |reason: String| format!("line {number}: {reason}");
        let (id, system, reply) = reply::row(&line).map_err(at_line)?;
        let (shown, known) = (shortened(&words(&id)), known.get(&*id));
        let problem = match (system, known) {
            (Some(system), known) if known.is_none_or(|known| known.system != system) => {
                Problem::own(&shown, system, penalty.clone()).map_err(|error| at_line(error.to_string()))?
            }
            (_, Some(known)) => (*known).clone(),
            _ => {
                let must =
                    "must be an id of contact cases with these options, or the row have all five parameters";
                return Err(at_line(format!("the id '{shown}' {must}")));
            }
        };
        if !ids.insert(id) {
            return Err(at_line(format!("the id '{shown}' is used multiple times")));
        }
        match reply {
            Some(reply) => answers.push((problem, reply)),
            None => missing.push(problem),
        }
    }
    if answers.is_empty() {
        return Err(format!("no row has an id, a deflection and a contact_force; {FORMATS}"));
    }
    // A table of other systems does not answer any of these.
    let mut problems = answers.iter().map(|(problem, _)| problem).chain(&missing);
    if problems.any(|problem| known.get(&*problem.id).is_some_and(|known| *known == problem)) {
        missing.extend(drawn.into_iter().filter(|problem| !ids.contains(&problem.id)));
    }
    Ok((answers, missing))
}

fn text(path: &str, max_bytes: u64) -> Result<String, String> {
    let (mut bytes, limit) = (Vec::new(), max_bytes + 1);
    let read = match path {
        "-" => io::stdin().take(limit).read_to_end(&mut bytes),
        path => File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes)),
    };
    let count = read.map_err(|error| format!("cannot be read: {error}; must be a file, or - for stdin"))?;
    if count as u64 > max_bytes {
        return Err(format!("must have no more than {max_bytes} bytes"));
    }
    // Other encodings have the same digits, and other columns may have any contents.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Returns the rows of CSV as lines of JSON with those columns that are read, without empty cells, and their numbers.
fn csv_lines(text: &str) -> Result<Vec<(usize, String)>, String> {
    let refused = |error: csv::Error| format!("{error}; {FORMATS}");
    let mut csv = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let names = csv.headers().map_err(refused)?.clone();
    let answer = ["id", "deflection", "contact_force", "penetration"];
    let read = [&answer[..], &SpringMass::KEYS.into_array()].concat();
    if !names.iter().any(|name| name == "id") {
        let first = shortened(text.lines().next().unwrap_or_default());
        return Err(format!("the first line '{first}' must name the column id; {FORMATS}"));
    }
    let (mut lines, mut line, mut before) = (Vec::new(), 1, text);
    for row in csv.records() {
        let row = row.map_err(refused)?;
        let cells = names.iter().zip(&row).filter(|(name, cell)| read.contains(name) && !cell.is_empty());
        let cells = cells.map(|(name, cell)| format!("\"{name}\":{}", serde_json::Value::from(cell)));
        let cells = cells.collect::<Vec<_>>().join(",");
        // Blank lines precede the row from its position on.
        let rest = row.position().and_then(|at| text.get(at.byte() as usize..)).unwrap_or_default();
        let rest = rest.trim_start_matches('\n');
        line += before[..before.len() - rest.len()].matches('\n').count();
        before = rest;
        lines.push((line, if cells.is_empty() { cells } else { format!("{{{cells}}}") }));
    }
    Ok(lines)
}

#[cfg(test)]
mod tests;

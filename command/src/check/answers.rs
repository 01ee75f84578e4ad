//! Answers in a table in place of a program: CSV, or JSON lines as a program prints them.

use super::reply::{self, Row, words};
use crate::args::invalid;
use crate::output::{Failure, shortened};
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Problem, Reply};
use spring_mass_contact::number::Exact;
use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{self, Read};

/// Largest number of bytes of a table.
const MAX_BYTES: u64 = 1 << 28;

/// The columns of CSV that are required.
const REQUIRED: [&str; 3] = ["id", "deflection", "contact_force"];

/// What is read as CSV.
const CSV: &str = "commas separate columns, and numbers have a decimal point";

/// Answers with their problems, and the systems without an answer.
pub struct Table {
    pub answers: Vec<(Problem, Reply)>,
    pub missing: Vec<Problem>,
}

/// Returns the answers in a file, or on stdin for `-`, to drawn systems or to those of its rows.
pub fn read(path: &str, drawn: Vec<Problem>) -> Result<Table, Failure> {
    let table = text(path).and_then(|text| table(text.trim_start_matches('\u{feff}'), drawn));
    table.map_err(|reason| invalid(path, "--answers <FILE>", reason))
}

fn table(text: &str, drawn: Vec<Problem>) -> Result<Table, String> {
    let lines = if text.trim_start().starts_with('{') { json_lines(text) } else { csv_lines(text)? };
    let known: HashMap<&str, &Problem> = drawn.iter().map(|problem| (&*problem.id, problem)).collect();
    let penalty = drawn.first().and_then(|problem| problem.penalty.as_ref());
    let (mut table, mut ids) = (Table { answers: Vec::new(), missing: Vec::new() }, HashSet::new());
    for (number, line) in lines {
        let at_line = |reason: String| format!("line {number}: {reason}");
        let Row { id, system, reply } = reply::row(&line).map_err(at_line)?;
        let problem = problem(&id, system, known.get(&*id).copied(), penalty).map_err(at_line)?;
        if !ids.insert(id) {
            return Err(at_line(format!("the id '{}' is used multiple times", problem.id)));
        }
        match reply {
            Some(reply) => table.answers.push((problem, reply)),
            None => table.missing.push(problem),
        }
    }
    if table.answers.is_empty() {
        return Err("no row has a deflection and a contact_force".to_string());
    }
    // A table of other systems does not answer any of these.
    if drawn.iter().any(|problem| ids.contains(&problem.id)) {
        table.missing.extend(drawn.into_iter().filter(|problem| !ids.contains(&problem.id)));
    }
    Ok(table)
}

/// Returns the problem of a row: with its own parameters, or the drawn one with its id.
fn problem(
    id: &str,
    system: Option<SpringMass<Exact>>,
    known: Option<&Problem>,
    penalty: Option<&Exact>,
) -> Result<Problem, String> {
    let id = shortened(&words(id));
    let Some(system) = system else {
        return known.cloned().ok_or_else(|| {
            format!(
                "'{id}' is not an id of contact cases with these --cases, --seed and --family, and the row does not \
                 have {}",
                SpringMass::KEYS.into_array().join(", ")
            )
        });
    };
    let own = Problem::own(&id, system, penalty.cloned()).map_err(|error| error.to_string())?;
    Ok(Problem { family: known.map_or(own.family, |known| known.family), ..own })
}

fn text(path: &str) -> Result<String, String> {
    let (mut bytes, limit) = (Vec::new(), MAX_BYTES + 1);
    let count = match path {
        "-" => io::stdin().take(limit).read_to_end(&mut bytes),
        path => File::open(path).and_then(|file| file.take(limit).read_to_end(&mut bytes)),
    };
    let count = count.map_err(|error| format!("cannot be read: {error}; must be a file, or - for stdin"))?;
    if count as u64 > MAX_BYTES {
        return Err(format!("must have no more than {MAX_BYTES} bytes"));
    }
    // Other encodings have the same digits, and other columns may have any contents.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Returns lines that are not blank, with their numbers.
fn json_lines(text: &str) -> Vec<(u64, String)> {
    let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    lines.map(|(number, line)| (number, line.to_string())).collect()
}

/// Returns the rows of CSV as lines of JSON with those columns that are read, without empty cells.
fn csv_lines(text: &str) -> Result<Vec<(u64, String)>, String> {
    let mut csv = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let names = csv.headers().map_err(|error| error.to_string())?.clone();
    if !REQUIRED.iter().all(|required| names.iter().any(|name| name == *required)) {
        let first = shortened(text.lines().next().unwrap_or_default());
        return Err(format!("the first line '{first}' must name the columns {}; {CSV}", REQUIRED.join(", ")));
    }
    let parameters = SpringMass::KEYS.into_array();
    let is_read =
        |name: &str| name == "penetration" || REQUIRED.contains(&name) || parameters.contains(&name);
    let mut lines = Vec::new();
    for row in csv.records() {
        let row = row.map_err(|error| match error.kind() {
            csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
                let line = pos.as_ref().map_or(0, csv::Position::line);
                format!("line {line}: has {len} columns instead of {expected_len}; {CSV}")
            }
            _ => error.to_string(),
        })?;
        let cells = names.iter().zip(&row).filter(|(name, cell)| is_read(name) && !cell.is_empty());
        let cells = cells.map(|(name, cell)| format!("\"{name}\":{}", serde_json::Value::from(cell)));
        let cells = Vec::from_iter(cells);
        if !cells.is_empty() {
            let number = row.position().map_or(0, csv::Position::line);
            lines.push((number, format!("{{{}}}", cells.join(","))));
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests;

//! The way out: stdout, a closed pipe, one-line errors, exit codes, tables.

use crate::text::shortened;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use comfy_table::{ColumnConstraint, ContentArrangement, Table, presets};
use serde::Serialize;
use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

/// Columns of a terminal that help and tables fit into.
pub const WIDTH: u8 = 80;

/// What a command has to say about its result, once it is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// All well.
    Fine,
    /// A solve did not converge, or a claim does not hold.
    Unmet,
}

/// Why there is no result.
pub enum Failure {
    /// Bad input: one line that names the argument, the value and what is allowed.
    Input(String),
    /// Nobody could be told.
    Output(io::Error),
}

impl From<String> for Failure {
    fn from(line: String) -> Self {
        Failure::Input(line)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::Output(error)
    }
}

/// 0, 1 or 2, with the line on stderr.
pub fn exit_code(answer: Result<Status, Failure>) -> ExitCode {
    let line = match answer {
        Ok(Status::Fine) => return ExitCode::SUCCESS,
        Ok(Status::Unmet) => return ExitCode::from(1),
        // Whoever closed the pipe (`| head`) has seen enough.
        Err(Failure::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => return ExitCode::SUCCESS,
        Err(Failure::Output(error)) => format!("stdout cannot be written: {error}"),
        Err(Failure::Input(line)) => line,
    };
    // If stderr is gone as well, the code alone has to do.
    let _ = writeln!(io::stderr(), "error: {line}");
    ExitCode::from(2)
}

/// Writes to stdout; nothing else does.
pub fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Status, Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    write(&mut out)?;
    out.flush()?;
    Ok(Status::Fine)
}

/// Indented JSON and a line break.
pub fn json(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    writeln!(out)
}

/// An empty table in the style all tables share, no wider than a terminal.
pub fn table() -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(WIDTH.into());
    table
}

/// Gives these columns all the width they need; the others share what is left.
pub fn unbroken(table: &mut Table, columns: &[usize]) {
    for column in table.column_iter_mut().filter(|column| columns.contains(&column.index)) {
        column.set_constraint(ColumnConstraint::ContentWidth);
    }
}

/// A table, line by line, without the blanks that would fill its last column.
pub fn lines(out: &mut dyn Write, table: &Table) -> io::Result<()> {
    table.lines().try_for_each(|line| writeln!(out, "{}", line.trim_end()))
}

/// What clap has to say: help and version go to stdout; an error is cut to one line.
pub fn clap_message(mut error: clap::Error, commands: &[&str]) -> Result<Status, Failure> {
    for kind in [ContextKind::InvalidValue, ContextKind::InvalidArg, ContextKind::InvalidSubcommand] {
        if let Some(ContextValue::String(value)) = error.get(kind)
            && shortened(value) != *value
        {
            let value = ContextValue::String(shortened(value));
            error.insert(kind, value);
            // They repeat the value.
            error.remove(ContextKind::Suggested);
        }
    }
    let allowed = match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            error.print()?;
            return Ok(Status::Fine);
        }
        ErrorKind::InvalidSubcommand => format!("; [commands: {}]", commands.join(", ")),
        ErrorKind::UnknownArgument => "; --help lists what is allowed".to_string(),
        _ => String::new(),
    };
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim);
    let said = lines.take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"));
    let line = said.filter(|line| !line.is_empty()).collect::<Vec<_>>().join("; ");
    let line = line.strip_prefix("error: ").unwrap_or(&line).replace(":; ", ": ");
    Err(Failure::Input(format!("{line}{allowed}")))
}

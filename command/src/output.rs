//! Output: stdout, closed pipes, one-line errors, exit codes and tables.

use crate::lines::NO_BREAK_SPACE;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use comfy_table::{ColumnConstraint, ContentArrangement, Row, Table, presets};
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::fmt::Display;
use std::io::{self, BufWriter, Write};
use std::ops::RangeBounds;
use std::process::ExitCode;

/// Columns of a page, for help and for output that is not a terminal.
pub const WIDTH: u8 = 80;

/// Columns for text on the narrowest terminal.
const MIN_WIDTH: u16 = 40;

/// Returns the number of columns of a line: that of the terminal, if stdout is one.
pub fn width() -> usize {
    // Tests print into memory, although they may run in a terminal.
    let terminal = if cfg!(test) { None } else { terminal_size::terminal_size_of(io::stdout()) };
    terminal.map_or(WIDTH.into(), |(width, _)| width.0.max(MIN_WIDTH)).into()
}

/// Returns `true` unless the character is a control character of any kind; some that reverse or end a line
/// are not `char::is_control`.
pub fn is_visible(c: char) -> bool {
    !c.is_control() && (c.is_ascii() || c.escape_debug().len() == 1)
}

/// Returns the beginning of a text without characters that end a line, reverse it or move the cursor.
pub fn shortened(text: &str) -> String {
    shortened_to(text, 40)
}

/// Like [`shortened`], with at most `most` characters.
pub fn shortened_to(text: &str, most: usize) -> String {
    let text = text.chars().map(|c| if is_visible(c) { c } else { char::REPLACEMENT_CHARACTER });
    if text.clone().nth(most).is_none() {
        text.collect()
    } else {
        text.take(most - 1).chain(['…']).collect()
    }
}

/// Outcome of a command that has printed its result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// The result is satisfactory.
    Success,
    /// A solve did not converge, or a claim does not hold.
    Unsatisfied,
}

impl Exit {
    /// Returns [`Exit::Success`] if `satisfied`.
    pub fn from_result(satisfied: bool) -> Self {
        if satisfied { Exit::Success } else { Exit::Unsatisfied }
    }
}

/// Reason why there is no result.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Bad input: one line that names the argument, the value and what is allowed.
    #[error("{0}")]
    Input(String),
    /// Writing to stdout failed.
    #[error("cannot write to stdout: {0}")]
    Output(#[from] io::Error),
}

impl From<String> for Failure {
    fn from(line: String) -> Self {
        Failure::Input(line)
    }
}

/// Returns 0, 1 or 2, and prints an error to stderr.
pub fn exit_code(answer: Result<Exit, Failure>) -> ExitCode {
    let failure = match answer {
        Ok(Exit::Success) => return ExitCode::SUCCESS,
        Ok(Exit::Unsatisfied) => return ExitCode::from(1),
        // The reader closed the pipe (`| head`), which is not an error.
        Err(Failure::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => return ExitCode::SUCCESS,
        Err(failure) => failure,
    };
    // If stderr is closed as well, only the code remains.
    let _ = writeln!(io::stderr(), "error: {failure}");
    ExitCode::from(2)
}

/// Writes to stdout, as the only function that does.
pub fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Exit, Failure> {
    print_answer(|out| Ok(write(out).map(|()| Exit::Success)?))
}

/// Writes a result that can also fail otherwise, or whose outcome is known only after writing.
pub fn print_answer(write: impl FnOnce(&mut dyn Write) -> Result<Exit, Failure>) -> Result<Exit, Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    let exit = write(&mut out)?;
    out.flush()?;
    Ok(exit)
}

/// Declares `Format`: the output formats of a subcommand, each with its help.
macro_rules! formats {
    ($($Name:ident: $help:literal),+) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
        enum Format { $(#[doc = $help] $Name),+ }
    };
}
pub(crate) use formats;

/// Returns a struct with these fields in this order, for JSON and CSV.
macro_rules! record {
    ($($name:ident: $value:expr),+ $(,)?) => {{
        #[allow(non_camel_case_types)]
        mod record {
            #[derive(serde::Serialize)]
            pub struct Record<$($name),+> { $(pub $name: $name),+ }
        }
        record::Record { $($name: $value),+ }
    }};
}
pub(crate) use record;

/// Prints indented JSON and a line break.
pub fn json(out: &mut dyn Write, value: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value)?;
    writeln!(out)
}

/// Prints a line of CSV for each row, after the names of the fields if the rows are structs.
pub fn csv(out: &mut dyn Write, rows: impl IntoIterator<Item: Serialize>) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    let written = rows.into_iter().try_for_each(|row| csv.serialize(row));
    written.map_err(|error| match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    })?;
    csv.flush()
}

/// Prints a table in Markdown.
pub fn markdown<const N: usize>(
    out: &mut dyn Write,
    names: [&str; N],
    rows: impl IntoIterator<Item = [String; N]>,
) -> io::Result<()> {
    writeln!(out, "| {} |\n|{}", names.join(" | "), "---|".repeat(N))?;
    rows.into_iter().try_for_each(|cells| {
        let cells = cells.map(|cell| cell.replace('|', "\\|"));
        writeln!(out, "| {} |", cells.join(" | "))
    })
}

/// Prints a table. The columns that may be broken share the width that the others leave.
pub fn table<R: Into<Row>>(
    out: &mut dyn Write,
    names: impl Into<Row>,
    rows: impl IntoIterator<Item = R>,
    broken: impl RangeBounds<usize>,
) -> io::Result<()> {
    let mut table = empty_table();
    table.set_header(names).add_rows(rows);
    for column in table.column_iter_mut().filter(|column| !broken.contains(&column.index)) {
        column.set_constraint(ColumnConstraint::ContentWidth);
    }
    writeln!(out, "{}", table.trim_fmt())
}

/// Prints names with texts in a second column; names without a text are omitted.
pub fn list(out: &mut dyn Write, rows: impl IntoIterator<Item = (&'static str, String)>) -> io::Result<()> {
    let rows = rows.into_iter().filter(|(_, text)| !text.is_empty());
    let rows = rows.map(|(name, text)| [name.to_string(), text]);
    writeln!(out, "{}", empty_table().add_rows(rows).trim_fmt())
}

/// Returns cells, each after a blank and padded to its width.
pub fn aligned(widths: &[usize], cells: impl IntoIterator<Item: Display>) -> String {
    let cells = cells.into_iter().zip(widths).map(|(cell, width)| format!(" {cell:<width$}"));
    cells.collect::<String>().trim_end().to_string()
}

/// Returns an empty table in the common style, as wide as a page, or as the terminal if that is wider.
fn empty_table() -> Table {
    let mut table = Table::new();
    table
        .load_style(presets::NOTHING)
        .set_content_arrangement(ContentArrangement::Dynamic)
        .set_width(width().max(WIDTH.into()) as u16);
    table
}

/// Formats a number with the noun that it counts.
pub fn counted(count: u64, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

/// Formats a point so that lines are broken only between its numbers.
pub fn join_coordinates(point: &impl ToString) -> String {
    point.to_string().replace(" = ", &format!("{NO_BREAK_SPACE}={NO_BREAK_SPACE}"))
}

/// Prints a text in several lines; the first begins with `first`, the others are indented by `rest` blanks.
pub fn wrapped(out: &mut dyn Write, first: &str, rest: usize, text: &str) -> io::Result<()> {
    let rest = " ".repeat(rest);
    let options = textwrap::Options::new(width())
        .initial_indent(first)
        .subsequent_indent(&rest)
        .word_splitter(textwrap::WordSplitter::NoHyphenation);
    let lines = textwrap::wrap(text, options);
    lines.iter().try_for_each(|line| writeln!(out, "{}", line.replace(NO_BREAK_SPACE, " ")))
}

/// Prints a shell command that can be copied, indented, with quoted words; long lines continue after a
/// backslash.
pub fn command<'a>(out: &mut dyn Write, words: impl IntoIterator<Item = &'a str>) -> io::Result<()> {
    let room = width() - " \\".len();
    let mut line = String::from(" ");
    for word in words {
        let word = shlex::try_quote(word).map_err(io::Error::other)?;
        let more = " ".len() + textwrap::core::display_width(&word);
        if textwrap::core::display_width(&line) + more > room && line.trim() != "" {
            writeln!(out, "{line} \\")?;
            line = "     ".to_string();
        }
        line.push(' ');
        line += &word;
    }
    writeln!(out, "{line}")
}

/// Shows a progress bar on stderr while the work lasts, from its second second on, if that is a terminal.
pub fn with_progress<T>(what: &str, work: impl FnOnce(&(dyn Fn(usize, usize) + Sync)) -> T) -> T {
    let style = ProgressStyle::with_template(&format!("{what} {{bar:40}} {{percent:>3}} %"));
    let bar = ProgressBar::no_length().with_style(style.unwrap_or(ProgressStyle::default_bar()));
    let result = work(&|now, of| {
        if bar.elapsed().as_secs() > 0 {
            bar.update(|state| {
                state.set_len(of as u64);
                state.set_pos(state.pos().max(now as u64));
            });
        }
    });
    bar.finish_and_clear();
    result
}

/// Prints a message of clap: help and version to stdout, an error as one line.
pub fn clap_message(mut error: clap::Error, commands: &[&str]) -> Result<Exit, Failure> {
    for kind in [ContextKind::InvalidValue, ContextKind::InvalidArg, ContextKind::InvalidSubcommand] {
        if let Some(ContextValue::String(value)) = error.get(kind)
            && shortened(value) != *value
        {
            let value = ContextValue::String(shortened(value));
            error.insert(kind, value);
            // Suggestions repeat the value.
            error.remove(ContextKind::Suggested);
        }
    }
    let allowed = match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            error.print()?;
            return Ok(Exit::Success);
        }
        ErrorKind::InvalidSubcommand => format!("; [commands: {}]", commands.join(", ")),
        ErrorKind::UnknownArgument => {
            let takes_program = matches!(
                error.get(ContextKind::Usage),
                Some(ContextValue::StyledStr(usage)) if usage.to_string().contains("-- ")
            );
            let program = if takes_program { "; a program and its arguments stand after --" } else { "" };
            format!("{program}; --help lists what is allowed")
        }
        _ => String::new(),
    };
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let message = lines.take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more"));
    let line = message.collect::<Vec<_>>().join("; ");
    let line = line.strip_prefix("error: ").unwrap_or(&line).replace(":; ", ": ");
    Err(Failure::Input(format!("{line}{allowed}")))
}

/// Returns the output, for tests.
#[cfg(test)]
pub fn capture(print: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> String {
    let mut bytes = Vec::new();
    print(&mut bytes).expect("memory can be written");
    String::from_utf8(bytes).expect("UTF-8")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_before_a_page_does_but_not_at_glue() {
        // An ε, a − and an ü each take one column, regardless of their bytes.
        let text = "ε − ü ".repeat(40) + &"no".repeat(3) + "\u{a0}end";
        let lines = capture(|out| wrapped(out, "  first ", 4, &text));
        let lines: Vec<&str> = lines.lines().collect();
        assert!(
            lines[0].starts_with("  first ε − ü")
                && lines[1..].iter().all(|l| l.starts_with("    ") && !l.starts_with("     "))
        );
        let widths: Vec<_> = lines.iter().map(|line| line.chars().count()).collect();
        assert!(widths.iter().all(|width| *width <= 80) && widths[0] >= 78, "{widths:?}");
        assert_eq!(
            lines.iter().map(|l| l.trim()).collect::<Vec<_>>().join(" "),
            format!("first {}", text.replace(NO_BREAK_SPACE, " "))
        );
        let glued = format!("{} a{NO_BREAK_SPACE}b", "x".repeat(77));
        assert_eq!(capture(|out| wrapped(out, "", 2, &glued)), format!("{}\n  a b\n", "x".repeat(77)));
        // Only a word that is longer than a line is broken.
        let nines = |n| "9".repeat(n);
        let broken = format!("a {}\n  {}\n  {}\n", nines(78), nines(78), nines(34));
        assert_eq!(capture(|out| wrapped(out, "", 2, &format!("a {}", nines(190)))), broken);
    }

    /// A line has room for the backslash.
    #[test]
    fn a_command_fills_its_lines() {
        let lines = |words: &[&str]| capture(|out| command(out, words.iter().copied()));
        let [a, b, c] = [40, 35, 36].map(|n| "9".repeat(n));
        assert_eq!(lines(&[&a, &b]), format!("  {a} {b}\n"));
        assert_eq!(lines(&[&a, &c]), format!("  {a} \\\n      {c}\n"));
    }
}

//! Parsing of a program's output, which is not trusted.

use crate::args::invalid;
use crate::json::{self, Object};
use crate::output::{shortened, shortened_to};
use serde_json::value::RawValue;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Answer, Reply, ReportedNumber, UsedParameters};
use spring_mass_contact::number::{Exact, ParseError};
use std::borrow::Cow;
use std::fmt::Display;

/// Largest number of bytes of a line.
pub const MAX_LINE_BYTES: usize = 1 << 24;

/// Largest number of digits of a number, including those of its power of ten: more than any solver prints,
/// and few enough for fast arithmetic in rationals.
const MAX_NUMBER_DIGITS: usize = 1 << 12;

/// Largest number of steps of an answer.
const MAX_STEPS: usize = 10_000;

/// Largest number of digits of all numbers of an answer: some megabytes as rationals, and well below a
/// second.
const MAX_ANSWER_DIGITS: usize = 1 << 22;

/// Largest number of characters of a text that is displayed.
const MAX_SHOWN_CHARS: usize = 200;

/// Returns a text for display: one line of limited length.
pub fn words(text: &str) -> String {
    let line = text.split_whitespace().flat_map(|word| [" ", word]).flat_map(str::chars).skip(1);
    // One more than displayed marks the text as shortened.
    shortened_to(&line.take(MAX_SHOWN_CHARS + 1).collect::<String>(), MAX_SHOWN_CHARS)
}

/// Returns the reply to the problem with this id, or the reason why the line is none; `None` if it is not an
/// object.
pub fn read(line: &[u8], id: &str) -> Option<Result<Reply, String>> {
    if line.len() > MAX_LINE_BYTES {
        return Some(Err(format!("a line must have no more than {MAX_LINE_BYTES} bytes")));
    }
    object(line, |object| match object_id(object) {
        Ok(Some(found)) if found == id => Ok(answer(object).unwrap_or_else(Reply::InvalidResponse)),
        found => Err(format!("{} instead of an answer to '{}'", answer_to(found), shortened(id))),
    })
}

/// A row of a table: its id, the system if the row has one, and the answer or refusal if it is filled in.
pub type Row = (String, Option<SpringMass<Exact>>, Option<Reply>);

/// Returns the row of a table in a line, or the reason why it is none.
pub fn row(line: &str) -> Result<Row, String> {
    object(line.as_bytes(), |object| {
        let id = object_id(object)?.ok_or("the key 'id' is missing")?.into_owned();
        let mut digits = MAX_ANSWER_DIGITS;
        let system = SpringMass::KEYS.try_map(|key| optional(object, "", key, &mut digits))?;
        let is_own = system.as_ref().into_array().iter().any(|parameter| parameter.is_some());
        let system = SpringMass::KEYS.zip(system).try_map(|(key, x)| {
            let must = "must be a number; a row has all five parameters or none";
            x.flatten().ok_or_else(|| format!("the key '{key}' {must}"))
        });
        let system = if is_own { Some(system?) } else { None };
        let keys = ["deflection", "contact_force", "error"].map(|key| non_null(object, "", key));
        let is_filled = keys.into_iter().collect::<Result<Vec<_>, _>>()?.iter().any(Option::is_some);
        Ok((id, system, is_filled.then(|| answer(object)).transpose()?))
    })
    .unwrap_or_else(|| Err("must be a JSON object".to_string()))
}

/// Describes a line that arrived before its request; `None` if it is not an object.
pub fn early(line: &[u8], id: &str) -> Option<String> {
    object(line, |object| format!("{} before the request '{}'", answer_to(object_id(object)), shortened(id)))
}

fn answer_to(id: Result<Option<Cow<str>>, String>) -> String {
    match id {
        Ok(Some(id)) => format!("answer to '{}'", shortened(&words(&id))),
        Ok(None) => "answer without id".to_string(),
        Err(twice) => format!("answer with {twice}"),
    }
}

/// Parses the object in a line.
fn object<T>(line: &[u8], read: impl FnOnce(&Object) -> T) -> Option<T> {
    // Invalid UTF-8 can only stand within a string, and is not a reason to wait for another line.
    let text = String::from_utf8_lossy(line);
    let text = text.trim_start_matches('\u{feff}').trim();
    if !text.starts_with('{') {
        return None;
    }
    if let Ok(object) = serde_json::from_str(text) {
        return Some(read(&object));
    }
    serde_json::from_str(&quoted(text)).ok().as_ref().map(read)
}

/// Quotes hexadecimal numbers and the words for numbers that are not finite, which JSON does not have but
/// solvers print.
fn quoted(mut text: &str) -> String {
    let mut quoted = String::with_capacity(text.len() + 64);
    while let Some(first) = text.chars().next() {
        let (word, rest) = text.split_at(match first {
            '"' => string(text),
            c if is_delimiter(c) => c.len_utf8(),
            _ => text.find(is_delimiter).unwrap_or(text.len()),
        });
        let quote = if is_not_a_number(word) || is_hexadecimal(word) { "\"" } else { "" };
        quoted.extend([quote, word, quote]);
        text = rest;
    }
    quoted
}

fn is_delimiter(c: char) -> bool {
    c.is_whitespace() || "{}[],:\"".contains(c)
}

/// Returns the number of bytes of the string at the beginning of a text.
fn string(text: &str) -> usize {
    let mut escaped = true; // As if the first quote were: it does not end the string.
    let end = text.bytes().position(|byte| {
        let ends = byte == b'"' && !escaped;
        escaped = !escaped && byte == b'\\';
        ends
    });
    end.map_or(text.len(), |end| end + 1)
}

fn is_hexadecimal(word: &str) -> bool {
    word.trim_start_matches(['-', '+']).get(..2).is_some_and(|prefix| prefix.eq_ignore_ascii_case("0x"))
}

/// Returns `true` for NaN or infinity as any language prints it: `NaN`, `-nan`, `nan(0x1)`, `inf`,
/// `-Infinity`.
fn is_not_a_number(word: &str) -> bool {
    let word = word.strip_prefix(['-', '+']).unwrap_or(word);
    ["nan", "inf", "infinity"].iter().any(|name| word.eq_ignore_ascii_case(name))
        || word.ends_with(')') && word.get(..4).is_some_and(|start| start.eq_ignore_ascii_case("nan("))
}

fn object_id<'a>(object: &Object<'a>) -> Result<Option<Cow<'a, str>>, String> {
    Ok(once(object, "", "id")?.map(json::text))
}

/// Returns the value of a key, or an error if there are two.
fn once<'a>(object: &Object<'a>, within: &str, key: &str) -> Result<Option<&'a RawValue>, String> {
    match object.0.iter().filter(|(other, _)| other == key).count() {
        0 | 1 => Ok(object.get(key)),
        _ => Err(format!("the key '{within}{key}' used multiple times")),
    }
}

/// Returns the value of an optional key; null counts as missing.
fn non_null<'a>(object: &Object<'a>, within: &str, key: &str) -> Result<Option<&'a RawValue>, String> {
    Ok(once(object, within, key)?.filter(|value| value.get() != "null"))
}

fn answer(object: &Object) -> Result<Reply, String> {
    if let Some(error) = error(object)? {
        return Ok(Reply::Refused(words(&json::text(error))));
    }
    let mut digits = MAX_ANSWER_DIGITS;
    let [deflection, contact_force] = required_pair(object, "", &mut digits)?;
    let penetration = optional(object, "", "penetration", &mut digits)?;
    let status = non_null(object, "", "status")?.map(|status| words(&json::text(status)));
    let used = used(object, &mut digits)?;
    let steps = steps(object, &mut digits)?;
    Ok(Reply::Answered(Box::new(Answer { deflection, contact_force, penetration, status, used, steps })))
}

/// Returns the error. Beside answers, `false`, `0` and an empty text mean that there is none.
fn error<'a>(object: &Object<'a>) -> Result<Option<&'a RawValue>, String> {
    let answers = object.get("deflection").is_some() && object.get("contact_force").is_some();
    let error = non_null(object, "", "error")?;
    Ok(error.filter(|error| !(answers && ["false", "0", "\"\""].contains(&error.get()))))
}

fn used(object: &Object, digits: &mut usize) -> Result<UsedParameters, String> {
    let Some(used) = non_null(object, "", "used")? else { return Ok(UsedParameters::default()) };
    let object: Object = serde_json::from_str(used.get())
        .map_err(|_| refused(&json::text(used), "used", "must be an object"))?;
    let system = SpringMass::KEYS.try_map(|key| optional(&object, "used.", key, digits))?;
    Ok(UsedParameters { system, penalty: optional(&object, "used.", "penalty", digits)? })
}

fn steps(object: &Object, digits: &mut usize) -> Result<Vec<[ReportedNumber; 2]>, String> {
    let Some(steps) = non_null(object, "", "steps")? else { return Ok(Vec::new()) };
    let steps: Vec<Object> = serde_json::from_str(steps.get())
        .map_err(|_| refused(&json::text(steps), "steps", "must be an array of objects"))?;
    if steps.len() > MAX_STEPS {
        return Err(format!("there must be no more than {MAX_STEPS} steps"));
    }
    let steps = steps.iter().enumerate();
    steps.map(|(k, step)| required_pair(step, &format!("steps[{k}]."), digits)).collect()
}

/// Returns the required numbers of an answer or a step.
fn required_pair(object: &Object, within: &str, digits: &mut usize) -> Result<[ReportedNumber; 2], String> {
    let deflection = required(object, within, "deflection", digits)?;
    Ok([deflection, required(object, within, "contact_force", digits)?])
}

fn required(object: &Object, within: &str, key: &str, digits: &mut usize) -> Result<ReportedNumber, String> {
    let value = once(object, within, key)?.ok_or_else(|| format!("the key '{within}{key}' is missing"))?;
    number(value, within, key, digits)
}

fn optional(
    object: &Object,
    within: &str,
    key: &str,
    digits: &mut usize,
) -> Result<Option<ReportedNumber>, String> {
    non_null(object, within, key)?.map(|value| number(value, within, key, digits)).transpose()
}

/// Parses a number, whose digits are subtracted from those allowed. null counts as NaN.
fn number(value: &RawValue, within: &str, key: &str, digits: &mut usize) -> Result<ReportedNumber, String> {
    let text = json::text(value);
    let text = text.trim();
    if value.get() == "null" || is_not_a_number(text) {
        return Ok(None);
    }
    let size = size(text);
    let value = if size > MAX_NUMBER_DIGITS {
        Err(format!("must have no more than {MAX_NUMBER_DIGITS} digits"))
    } else if size > *digits {
        Err(format!("the numbers of an answer must have no more than {MAX_ANSWER_DIGITS} digits together"))
    } else {
        *digits -= size;
        text.parse().map(Some).map_err(|error: ParseError| error.to_string())
    };
    value.map_err(|reason| refused(text, format!("{within}{key}"), reason))
}

/// Returns the approximate number of digits of a number written out.
fn size(text: &str) -> usize {
    // In hexadecimal notation `e` is a digit, and three powers of 2 make a digit at most.
    let (marks, powers) = if text.contains(['x', 'X']) { (['p', 'P'], 3) } else { (['e', 'E'], 1) };
    let power = text.split_once(marks).and_then(|(_, power)| power.parse::<i32>().ok());
    text.len() + power.map_or(0, |power| power.unsigned_abs() as usize / powers)
}

fn refused(text: &str, key: impl Display, reason: impl Display) -> String {
    invalid(&words(text), key, reason).to_string()
}

#[cfg(test)]
mod tests;

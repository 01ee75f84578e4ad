//! Parsing of a program's output, which is not trusted.

use crate::args::invalid;
use crate::json::{self, Object};
use crate::output::{shortened, shortened_to};
use serde_json::value::RawValue;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Answer, Reply, UsedParameters, Value};
use std::borrow::Cow;
use std::fmt::Display;

/// Largest number of bytes of a line.
pub const LONGEST: usize = 1 << 24;

/// Largest number of digits of a number, including those of its power of ten: more than any solver prints,
/// and few enough for fast arithmetic in rationals.
const LONGEST_NUMBER: usize = 1 << 12;

/// Largest number of steps of an answer.
const MOST_STEPS: usize = 10_000;

/// Largest number of digits of all numbers of an answer: some megabytes as rationals, and well below a
/// second.
const LONGEST_ANSWER: usize = 1 << 22;

/// Largest number of characters of a text that is displayed.
const WORDS: usize = 200;

/// Returns a text for display: one line of limited length.
pub fn words(text: &str) -> String {
    let line = text.split_whitespace().flat_map(|word| [" ", word]).flat_map(str::chars).skip(1);
    // One more than displayed marks the text as shortened.
    shortened_to(&line.take(WORDS + 1).collect::<String>(), WORDS)
}

/// Returns the reply to the problem with this id, or the reason why the line is none; `None` if it is not an
/// object.
pub fn read(line: &[u8], id: &str) -> Option<Result<Reply, String>> {
    if line.len() > LONGEST {
        return Some(Err(format!("a line must have no more than {LONGEST} bytes")));
    }
    object(line, |object| match own_id(object) {
        Ok(Some(own)) if own == id => Ok(answer(object).unwrap_or_else(Reply::InvalidResponse)),
        own => Err(format!("{} instead of an answer to '{}'", answer_to(own), shortened(id))),
    })
}

/// Describes a line that arrived before its request; `None` if it is not an object.
pub fn early(line: &[u8], id: &str) -> Option<String> {
    object(line, |object| format!("{} before the request '{}'", answer_to(own_id(object)), shortened(id)))
}

fn answer_to(id: Result<Option<Cow<str>>, String>) -> String {
    match id {
        Ok(Some(id)) => format!("answer to '{}'", shortened(&words(&id))),
        Ok(None) => "answer without id".to_string(),
        Err(twice) => format!("answer with {twice}"),
    }
}

/// Parses the object in a line.
fn object<T>(line: &[u8], look: impl FnOnce(&Object) -> T) -> Option<T> {
    // Invalid UTF-8 can only stand within a string, and is not a reason to wait for another line.
    let text = String::from_utf8_lossy(line);
    let text = text.trim_start_matches('\u{feff}').trim();
    if !text.starts_with('{') {
        return None;
    }
    if let Ok(object) = serde_json::from_str(text) {
        return Some(look(&object));
    }
    serde_json::from_str(&quoted(text)).ok().as_ref().map(look)
}

/// Quotes hexadecimal numbers and the words for numbers that are not finite, which JSON does not have but
/// solvers print.
fn quoted(mut text: &str) -> String {
    let ends = |c: char| c.is_whitespace() || "{}[],:\"".contains(c);
    let mut quoted = String::with_capacity(text.len() + 64);
    while let Some(first) = text.chars().next() {
        let (word, rest) = text.split_at(match first {
            '"' => string(text),
            c if ends(c) => c.len_utf8(),
            _ => text.find(ends).unwrap_or(text.len()),
        });
        let quote = if is_not_a_number(word) || is_hexadecimal(word) { "\"" } else { "" };
        quoted.extend([quote, word, quote]);
        text = rest;
    }
    quoted
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
    let is = |name: &str| word.eq_ignore_ascii_case(name);
    let has_payload = || word.ends_with(')') && word.get(..4).is_some_and(|s| s.eq_ignore_ascii_case("nan("));
    is("nan") || is("inf") || is("infinity") || has_payload()
}

fn own_id<'a>(object: &Object<'a>) -> Result<Option<Cow<'a, str>>, String> {
    Ok(once(object, "", "id")?.map(json::text))
}

/// Returns the value of a key, or an error if there are two.
fn once<'a>(object: &Object<'a>, within: &str, key: &str) -> Result<Option<&'a RawValue>, String> {
    match object.0.iter().filter(|(own, _)| own == key).count() {
        0 | 1 => Ok(object.get(key)),
        _ => Err(format!("the key '{within}{key}' used multiple times")),
    }
}

/// Returns the value of an optional key; null counts as missing.
fn said<'a>(object: &Object<'a>, within: &str, key: &str) -> Result<Option<&'a RawValue>, String> {
    Ok(once(object, within, key)?.filter(|value| value.get() != "null"))
}

fn answer(object: &Object) -> Result<Reply, String> {
    // Some programs report explicitly that there was no error.
    let is_none = |error: &RawValue| ["false", "0", "\"\""].contains(&error.get());
    let answers = object.get("deflection").is_some() && object.get("contact_force").is_some();
    if let Some(error) = said(object, "", "error")?.filter(|error| !(answers && is_none(error))) {
        return Ok(Reply::Refused(words(&json::text(error))));
    }
    let mut digits = LONGEST_ANSWER;
    let [deflection, contact_force] = needed(object, "", &mut digits)?;
    let penetration = optional(object, "", "penetration", &mut digits)?;
    let status = said(object, "", "status")?.map(|status| words(&json::text(status)));
    let used = match said(object, "", "used")? {
        None => UsedParameters::default(),
        Some(used) => {
            let object: Object = serde_json::from_str(used.get())
                .map_err(|_| refused(&json::text(used), "used", "must be an object"))?;
            let mut value = |key| optional(&object, "used.", key, &mut digits);
            UsedParameters { system: SpringMass::KEYS.try_map(|key| value(key))?, penalty: value("penalty")? }
        }
    };
    let steps = match said(object, "", "steps")? {
        None => Vec::new(),
        Some(steps) => {
            let objects: Vec<Object> = serde_json::from_str(steps.get())
                .map_err(|_| refused(&json::text(steps), "steps", "must be an array of objects"))?;
            if objects.len() > MOST_STEPS {
                return Err(format!("there must be no more than {MOST_STEPS} steps"));
            }
            let step = |(k, object)| needed(object, &format!("steps[{k}]."), &mut digits);
            objects.iter().enumerate().map(step).collect::<Result<_, _>>()?
        }
    };
    Ok(Reply::Answered(Box::new(Answer { deflection, contact_force, penetration, status, used, steps })))
}

/// Returns the required numbers of an answer or a step.
fn needed(object: &Object, within: &str, digits: &mut usize) -> Result<[Value; 2], String> {
    let mut value = |key| match once(object, within, key)? {
        Some(value) => number(value, within, key, digits),
        None => Err(format!("the key '{within}{key}' is missing")),
    };
    Ok([value("deflection")?, value("contact_force")?])
}

fn optional(object: &Object, within: &str, key: &str, digits: &mut usize) -> Result<Option<Value>, String> {
    said(object, within, key)?.map(|value| number(value, within, key, digits)).transpose()
}

/// Parses a number, whose digits are subtracted from those allowed. null counts as NaN.
fn number(value: &RawValue, within: &str, key: &str, digits: &mut usize) -> Result<Value, String> {
    let text = json::text(value);
    let text = text.trim();
    if value.get() == "null" || is_not_a_number(text) {
        return Ok(None);
    }
    let refused = |reason: &dyn Display| refused(text, format!("{within}{key}"), reason);
    let size = size(text);
    if size > LONGEST_NUMBER {
        return Err(refused(&format!("must have no more than {LONGEST_NUMBER} digits")));
    }
    *digits = digits.checked_sub(size).ok_or_else(|| {
        refused(&format!("the numbers of an answer must have no more than {LONGEST_ANSWER} digits together"))
    })?;
    text.parse().map(Some).map_err(|error| refused(&error))
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

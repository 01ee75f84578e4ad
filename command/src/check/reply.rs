//! What a line of a program's stdout comes to: nothing here trusts it.

use crate::args::invalid;
use crate::json::{self, Object};
use crate::output::{shortened, shortened_to};
use serde_json::value::RawValue;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Answer, Reply, Used, Value};
use std::borrow::Cow;
use std::fmt::Display;

/// Bytes that a line may have.
pub const LONGEST: usize = 1 << 24;

/// Digits that a number may have, those that its power of ten stands for included: more than any solver
/// prints, few enough that nothing takes long in rationals.
const LONGEST_NUMBER: usize = 1 << 12;

/// Steps that an answer may have.
const MOST_STEPS: usize = 10_000;

/// The same of all numbers of an answer: as rationals a few megabytes, and well below a second.
const LONGEST_ANSWER: usize = 1 << 22;

/// Characters of a text that is passed on.
const WORDS: usize = 200;

/// A text fit to be printed: one line, and not long.
pub fn words(text: &str) -> String {
    let line = text.split_whitespace().flat_map(|word| [" ", word]).flat_map(str::chars).skip(1);
    // More than are shown say that there are more.
    shortened_to(&line.take(WORDS + 1).collect::<String>(), WORDS)
}

/// The reply to the problem of this id that a line is, if it is an object at all; or why it is not.
pub fn read(line: &[u8], id: &str) -> Option<Result<Reply, String>> {
    if line.len() > LONGEST {
        return Some(Err(format!("a line must have no more than {LONGEST} bytes")));
    }
    object(line, |object| match own_id(object) {
        Ok(Some(own)) if own == id => Ok(answer(object).unwrap_or_else(Reply::Garbled)),
        own => Err(format!("{} where '{}' was asked", answer_to(own), shortened(id))),
    })
}

/// What is wrong with a line that has come before the problem of this id was put, if it is an object at all.
pub fn early(line: &[u8], id: &str) -> Option<String> {
    object(line, |object| format!("{} before '{}' was asked", answer_to(own_id(object)), shortened(id)))
}

fn answer_to(id: Result<Option<Cow<str>>, String>) -> String {
    match id {
        Ok(Some(id)) => format!("answer to '{}'", shortened(&words(&id))),
        Ok(None) => "answer without id".to_string(),
        Err(twice) => format!("answer with {twice}"),
    }
}

/// Looks at the object that a line is.
fn object<T>(line: &[u8], look: impl FnOnce(&Object) -> T) -> Option<T> {
    // What is no UTF-8 can only stand within a string, and is no reason to wait for another answer.
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

/// The same with the words for what is no number in quotes: JSON has none, those who print numbers have.
fn quoted(mut text: &str) -> String {
    let ends = |c: char| c.is_whitespace() || "{}[],:\"".contains(c);
    let mut quoted = String::with_capacity(text.len() + 64);
    while let Some(first) = text.chars().next() {
        let (word, rest) = text.split_at(match first {
            '"' => string(text),
            c if ends(c) => c.len_utf8(),
            _ => text.find(ends).unwrap_or(text.len()),
        });
        let quote = if is_not_a_number(word) { "\"" } else { "" };
        quoted.extend([quote, word, quote]);
        text = rest;
    }
    quoted
}

/// Bytes of the string that a text begins with.
fn string(text: &str) -> usize {
    let mut escaped = true; // As if the first quote were: it does not end the string.
    let end = text.bytes().position(|byte| {
        let ends = byte == b'"' && !escaped;
        escaped = !escaped && byte == b'\\';
        ends
    });
    end.map_or(text.len(), |end| end + 1)
}

/// As any language prints it: `NaN`, `-nan`, `nan(0x1)`, `inf`, `-Infinity`.
fn is_not_a_number(word: &str) -> bool {
    let word = word.strip_prefix(['-', '+']).unwrap_or(word);
    let is = |name: &str| word.eq_ignore_ascii_case(name);
    let has_payload = || word.ends_with(')') && word.get(..4).is_some_and(|s| s.eq_ignore_ascii_case("nan("));
    is("nan") || is("inf") || is("infinity") || has_payload()
}

fn own_id<'a>(object: &Object<'a>) -> Result<Option<Cow<'a, str>>, String> {
    Ok(once(object, "", "id")?.map(json::text))
}

/// The value of a key that says anything. Of two values nobody knows which is meant.
fn once<'a>(object: &Object<'a>, within: &str, key: &str) -> Result<Option<&'a RawValue>, String> {
    match object.0.iter().filter(|(own, _)| own == key).count() {
        0 | 1 => Ok(object.get(key)),
        _ => Err(format!("the key '{within}{key}' used multiple times")),
    }
}

/// The value of a key that may be left out; null leaves it out, too.
fn said<'a>(object: &Object<'a>, within: &str, key: &str) -> Result<Option<&'a RawValue>, String> {
    Ok(once(object, within, key)?.filter(|value| value.get() != "null"))
}

fn answer(object: &Object) -> Result<Reply, String> {
    // Some say beside the numbers that there was no error.
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
        None => Used::default(),
        Some(used) => {
            let object: Object = serde_json::from_str(used.get())
                .map_err(|_| refused(&json::text(used), "used", "must be an object"))?;
            let mut value = |key| optional(&object, "used.", key, &mut digits);
            Used { system: SpringMass::KEYS.try_map(|key| value(key))?, penalty: value("penalty")? }
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

/// What every answer and every step of one has.
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

/// A number by its digits, which are taken from those that are left. null is what some make of a NaN.
fn number(value: &RawValue, within: &str, key: &str, digits: &mut usize) -> Result<Value, String> {
    let text = json::text(value);
    let text = text.trim();
    if value.get() == "null" || is_not_a_number(text) {
        return Ok(None);
    }
    let refused = |why: &dyn Display| refused(text, format!("{within}{key}"), why);
    let size = size(text);
    if size > LONGEST_NUMBER {
        return Err(refused(&format!("must have no more than {LONGEST_NUMBER} digits")));
    }
    *digits = digits.checked_sub(size).ok_or_else(|| {
        refused(&format!("the numbers of an answer must have no more than {LONGEST_ANSWER} digits together"))
    })?;
    text.parse().map(Some).map_err(|error| refused(&error))
}

/// About as many digits as a number has that is written out.
fn size(text: &str) -> usize {
    let power = text.split_once(['e', 'E']).and_then(|(_, power)| power.parse::<i32>().ok());
    text.len() + power.map_or(0, |power| power.unsigned_abs() as usize)
}

fn refused(text: &str, key: impl Display, why: impl Display) -> String {
    invalid(&words(text), key, why).to_string()
}

#[cfg(test)]
mod tests;

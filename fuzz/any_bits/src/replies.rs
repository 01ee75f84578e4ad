//! Properties of `contact check` for arbitrary answers of a program.

use crate::bytes::Bytes;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{Answer, AnswerVerdict, Family, Problem, Reply, check, problems};
use spring_mass_contact_cli::reply;
use std::convert::Infallible;
use std::sync::LazyLock;

const KEYS: [&str; 6] = ["id", "penetration", "status", "error", "steps", "used"];

/// Values, or the contents of strings; some are not JSON.
const VALUES: [&str; 32] = [
    "1", "0", "-0", "-1", "0.05", "4.81", "1e-9", "-1E+3", "1e400", "1e-400", "1e4095", "1e5000", "1e100000",
    "1/3", "1/0", " 1 ", "nan", "", "null", "true", "false", "NaN", "-inf", "Infinity", "nan(0x1)", "[]",
    "{}", "[1]", r"\u0000", r"\ud800", "01", "--1",
];

/// Returns a line: arbitrary bytes, or an object with most of the required keys.
fn line(bytes: &mut Bytes) -> Vec<u8> {
    if bytes.one_in(8) {
        return bytes.rest().to_vec();
    }
    let mut line = object(bytes, 2).into_bytes();
    if bytes.one_in(4) {
        let place = (bytes.bits() % line.len() as u64) as usize;
        line[place] = bytes.byte();
    }
    if bytes.one_in(16) {
        line.truncate((bytes.bits() % line.len() as u64) as usize);
    }
    line
}

fn object(bytes: &mut Bytes, depth: usize) -> String {
    let mut pairs: Vec<(&str, String)> = Vec::new();
    if depth == 2 && !bytes.one_in(16) {
        pairs.push(("id", "\"a\"".to_string()));
    }
    for key in ["deflection", "contact_force"] {
        if !bytes.one_in(8) {
            pairs.push((key, number(bytes)));
        }
    }
    for _ in 0..bytes.below(6) {
        let parameters = SpringMass::KEYS.into_array();
        let key =
            *bytes.pick(&[&KEYS[..], &parameters, &["penalty", "deflection", "contact_force"]].concat());
        let value = match key {
            "used" if depth > 0 => object(bytes, depth - 1),
            "steps" if depth > 0 => {
                let steps: Vec<_> = (0..bytes.below(5)).map(|_| object(bytes, depth - 1)).collect();
                format!("[{}]", steps.join(","))
            }
            _ => number(bytes),
        };
        pairs.push((key, value));
    }
    let pairs: Vec<_> = pairs.iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
    format!("{{{}}}", pairs.join(", "))
}

fn number(bytes: &mut Bytes) -> String {
    match bytes.below(4) {
        0 => bytes.pick(&VALUES).to_string(),
        1 => format!("\"{}\"", bytes.pick(&VALUES)),
        2 => format!("{:?}", f64::from_bits(bytes.bits())),
        _ => format!("{:?}", f64::from(bytes.byte() as i8) / 100.0),
    }
}

/// Replies are parsed or rejected; parsed ones are assessed whatever method they report.
pub fn read(bytes: &[u8]) {
    static PROBLEMS: LazyLock<Vec<Problem>> = LazyLock::new(|| problems(1, 1, Family::ALL));
    let mut bytes = Bytes(bytes);
    let tolerance = if bytes.one_in(2) { "1e-6" } else { "1/3" }.parse().expect("a number");
    let (first, many) = (bytes.below(PROBLEMS.len() - 3), 1 + bytes.below(3));
    let line = line(&mut bytes);
    let read = reply::read(&line, "a");
    let early = reply::early(&line, "a");
    assert_eq!(read.is_none(), early.is_none());
    let one_line =
        |text: &str| assert!(text.len() < 2000 && !text.contains(['\n', '\r', '\u{1b}']), "{text:?}");
    early.iter().for_each(|text| one_line(text));
    let Some(read) = read else {
        let text = String::from_utf8_lossy(&line);
        assert!(serde_json::from_str::<serde_json::Map<_, _>>(text.trim()).is_err(), "{text}");
        return;
    };
    let reply = match read {
        Err(reason) => return one_line(&reason),
        Ok(reply) => reply,
    };
    if let Reply::Refused(text) | Reply::InvalidResponse(text) = &reply {
        one_line(text);
    }
    let asked = &PROBLEMS[first..first + many];
    let Ok(report) = check(asked, &tolerance, |_| Ok::<_, Infallible>(reply.clone()));
    assert_eq!(report.results.len(), many);
    let no_number = |answer: &Answer| answer.deflection.is_none() || answer.contact_force.is_none();
    for checked in &report.results {
        let verdict = checked.assessment.verdict;
        let fits = match &reply {
            Reply::Answered(answer) if no_number(answer) => verdict == AnswerVerdict::Wrong,
            Reply::Answered(_) => verdict <= AnswerVerdict::Wrong,
            Reply::Refused(_) => verdict == AnswerVerdict::Refused,
            _ => verdict >= AnswerVerdict::Wrong,
        };
        assert!(fits, "{reply:?} is {verdict:?}");
    }
    assert_eq!((report.cases(), report.families().iter().map(|row| row.cases).sum()), (many, many));
    report.identified_mistake();
    report.holds();
}

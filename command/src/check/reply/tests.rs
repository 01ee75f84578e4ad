//! Output lines of programs.

use super::*;
use proptest::prelude::*;
use spring_mass_contact::number::Exact;

fn exact(text: &str) -> ReportedNumber {
    Some(text.parse::<Exact>().unwrap())
}

/// Returns the reply of a line to the problem `a`.
fn said(line: impl AsRef<[u8]>) -> Result<Reply, String> {
    let line = line.as_ref();
    read(line, "a").unwrap_or_else(|| panic!("no object: {}", words(&String::from_utf8_lossy(line))))
}

/// Returns an answer with additional keys.
fn answered(rest: &str) -> Answer {
    match said(format!(r#"{{"id": "a", {rest}}}"#)) {
        Ok(Reply::Answered(answer)) => *answer,
        other => panic!("{rest}: {other:?}"),
    }
}

fn garbled(rest: &str) -> String {
    match said(format!(r#"{{"id": "a", {rest}}}"#)) {
        Ok(Reply::InvalidResponse(reason)) => reason,
        other => panic!("{rest}: {other:?}"),
    }
}

/// Returns u and N from texts.
fn numbers(u: &str, n: &str) -> [ReportedNumber; 2] {
    let Answer { deflection, contact_force, .. } =
        answered(&format!(r#""deflection": {u}, "contact_force": {n}"#));
    [deflection, contact_force]
}

const U: &str = r#""deflection": 1"#;
const N: &str = r#""contact_force": 2"#;

#[test]
fn numbers_are_read_by_their_digits() {
    assert_eq!(numbers("0.1", r#""1/3""#), [exact("1/10"), exact("1/3")]);
    assert_eq!(numbers(r#"" 7 ""#, r#""\u0037.5""#), [exact("7"), exact("7.5")]);
    let long = format!("0.{}1", "0".repeat(400));
    assert_eq!(numbers(&long, "1e4000"), [exact(&long), exact("1e4000")]);
    assert_eq!(numbers("0x1.8p-3", r#""-0X1E""#), [exact("3/16"), exact("-30")]);
    assert_eq!(numbers("1", "0x1p4000")[1], Some(Exact::power_of_two(4000)));
}

#[test]
fn non_numeric_values_are_accepted_as_answers() {
    for word in ["NaN", "-nan", "+NAN", "nan(ind)", "Inf", "-inf", "+inf", "Infinity", "INFINITY"] {
        let quoted = format!("\"{word}\"");
        assert_eq!(numbers(word, "2"), [None, exact("2")], "{word}");
        assert_eq!(numbers(&quoted, word), [None, None], "{word}");
        assert_eq!(answered(&format!("{U}, {N}, \"penetration\": {word}")).penetration, Some(None), "{word}");
    }
    assert_eq!(numbers("null", "null"), [None, None]);
    for word in ["none", "na", "infinite", "-", "nan0", "--nan", "nan("] {
        let line = format!(r#"{{"id": "a", {U}, "contact_force": {word}}}"#);
        assert_eq!(read(line.as_bytes(), "a"), None, "{word}");
    }
}

/// Only words in the position of a number are quoted.
#[test]
fn strings_are_left_as_they_are() {
    let status = r#""NaN, [inf] \" , nan \\""#;
    let answer = answered(&format!("{N},\t\"status\":{status},\"deflection\":NaN"));
    assert_eq!((answer.deflection, answer.status.as_deref()), (None, Some(r#"NaN, [inf] " , nan \"#)));
    for text in [r#"{"a": "NaN\"#, r#"{"#, r#"""#, r#""\"#, "", "ε{NaNε"] {
        assert_eq!(quoted(text), text);
    }
    assert_eq!(quoted("[NaN,{inf}:-nan]"), r#"["NaN",{"inf"}:"-nan"]"#);
}

/// Each is named with its place, and a key has one value.
#[test]
fn an_unreadable_field_is_named() {
    let [x, y] = ["x".repeat(20), "y".repeat(99)];
    let of = |rest: &str| rest.replace("UN", &format!("{U}, {N}")).replace('U', U).replace('N', N);
    for (rest, reason) in [
        (r#"U, "contact_force": "twelve""#, "invalid value 'twelve' for 'contact_force': "),
        (r#"U, "contact_force": [1]"#, "invalid value '[1]' for 'contact_force': "),
        (r#"U, "contact_force": true"#, "invalid value 'true' for 'contact_force': "),
        (r#"U, "contact_force": {"x": 1}"#, "invalid value '{\"x\": 1}' for 'contact_force': "),
        (r#"U, "contact_force": """#, "invalid value '' for 'contact_force': "),
        (
            &format!(r#"U, "contact_force": "{x}\n\u001b\u202e{y}""#),
            &format!("invalid value '{x} \u{fffd}\u{fffd}{}…' for 'contact_force': ", &y[..16]),
        ),
        (r#"N, "deflection": -1e-2147483648"#, "invalid value '-1e-2147483648' for 'deflection': "),
        (
            r#"N, "deflection": 1e99999999999999999999"#,
            "invalid value '1e99999999999999999999' for 'deflection': ",
        ),
        (r#"UN, "used": {"mass": "x"}"#, "invalid value 'x' for 'used.mass': "),
        (r#"UN, "used": 7"#, "invalid value '7' for 'used': must be an object"),
        (
            r#"UN, "steps": [{UN}, {U, "contact_force": "x"}]"#,
            "invalid value 'x' for 'steps[1].contact_force': ",
        ),
        (r#"UN, "steps": 7"#, "invalid value '7' for 'steps': must be an array of objects"),
        (r#"UN, "steps": [7]"#, "invalid value '[7]' for 'steps': must be an array of objects"),
        ("U", "the key 'contact_force' is missing"),
        ("N", "the key 'deflection' is missing"),
        (r#"UN, "steps": [{UN}, {N}]"#, "the key 'steps[1].deflection' is missing"),
        ("UN, U", "the key 'deflection' used multiple times"),
        (r#"UN, "used": {"mass": 1, "mass": 1}"#, "the key 'used.mass' used multiple times"),
    ] {
        let found = garbled(&of(rest));
        assert!(found.starts_with(reason), "{rest}: {found}");
    }
    let twice = said(format!(r#"{{"id": "a", "id": "b", {U}, {N}}}"#));
    let reason = "answer with the key 'id' used multiple times instead of an answer to 'a'";
    assert_eq!(twice, Err(reason.to_string()));
    answered(&format!("{U}, {N}, \"x\": 1, \"x\": 2"));
}

#[test]
fn all_that_an_answer_may_say_is_read() {
    let rest = r#""x": [], "deflection": 1, "contact_force": 2, "penetration": "1/7", "status": "ok  so\nfar",
        "used": {"stiffness": 1, "mass": 2, "gravity": "nan", "free_length": 4, "height": null,
        "penalty": 6, "x": 1}, "steps": [{"deflection": 1, "contact_force": 2},
        {"contact_force": NaN, "x": 1, "deflection": "3"}], "": 1"#;
    let used =
        SpringMass { c: Some(exact("1")), m: Some(exact("2")), g: Some(None), l: Some(exact("4")), h: None };
    let answer = Answer {
        deflection: exact("1"),
        contact_force: exact("2"),
        penetration: Some(exact("1/7")),
        status: Some("ok so far".to_string()),
        used: UsedParameters { system: used, penalty: Some(exact("6")) },
        steps: vec![[exact("1"), exact("2")], [exact("3"), None]],
    };
    assert_eq!(answered(rest), answer);
    let bare = Answer { deflection: exact("1"), contact_force: exact("2"), ..Answer::default() };
    assert_eq!(answered(&format!("{U}, {N}")), bare);
    let nulls = r#""penetration": null, "status": null, "used": null, "steps": null, "error": null"#;
    assert_eq!(answered(&format!("{U}, {N}, {nulls}")), bare);
    assert_eq!(answered(&format!("{U}, {N}, \"used\": {{}}, \"steps\": []")), bare);
    let status = |json: &str| answered(&format!("{U}, {N}, \"status\": {json}")).status;
    assert_eq!(status("[1, 2.50]").as_deref(), Some("[1, 2.50]"));
    assert_eq!(status("\"\\u001b[2J\"").as_deref(), Some("\u{fffd}[2J"));
}

#[test]
fn an_error_is_a_refusal() {
    let refused = |error: &str| said(format!(r#"{{"id": "a", "error": {error}, {U}}}"#));
    let of = |text: &str| Ok(Reply::Refused(text.to_string()));
    assert_eq!(refused(r#""no\nsuch problem""#), of("no such problem"));
    assert_eq!(refused(r#"{"code": 7}"#), of(r#"{"code": 7}"#));
    assert_eq!(refused("\"\""), of(""));
    for none in ["false", "0", "\"\"", "null"] {
        answered(&format!("{U}, {N}, \"error\": {none}"));
    }
    assert_eq!(refused(&format!("\"{}\"", "x".repeat(1 << 20))), of(&format!("{}…", "x".repeat(199))));
    assert_eq!(refused(&format!("\"{}\"", "ε ".repeat(1000))), of(&format!("{}ε…", "ε ".repeat(99))));
}

#[test]
fn an_answer_must_have_the_id_of_its_request() {
    let answer = |id: &str| said(format!(r#"{{"id": {id}, {U}, {N}}}"#));
    assert!(matches!(answer(r#""\u0061""#), Ok(Reply::Answered(_))));
    for (id, own) in [("\"b\"", "b"), ("7", "7"), ("null", "null"), ("[7]", "[7]"), ("\"a \"", "a")] {
        assert_eq!(answer(id), Err(format!("answer to '{own}' instead of an answer to 'a'")));
    }
    let long = format!("\"{}\"", "b".repeat(1000));
    assert_eq!(answer(&long), Err(format!("answer to '{}…' instead of an answer to 'a'", "b".repeat(39))));
    assert_eq!(said("{}"), Err("answer without id instead of an answer to 'a'".to_string()));
    let asked = "a".repeat(100);
    assert_eq!(
        read(b"{}", &asked),
        Some(Err(format!("answer without id instead of an answer to '{}…'", "a".repeat(39))))
    );
    assert_eq!(early(b"{\"id\": \"a\"}", "a").as_deref(), Some("answer to 'a' before the request 'a'"));
    assert_eq!(early(b"a", "a"), None);
}

#[test]
fn bytes_around_an_object_are_passed_over() {
    let line = format!(r#"{{"id":"a",{U},{N}}}"#);
    for (before, after) in [("", "\r"), ("\u{feff}", ""), (" \t", " \t\r"), ("\u{feff} ", "\r")] {
        assert!(matches!(said(format!("{before}{line}{after}")), Ok(Reply::Answered(_))));
    }
    for other in
        ["", "7", "\"id\"", "[{}]", "null", "NaN", "{", "{{}}", "{} {}", "x {}", "\u{feff}", "{\"id\": \"a\""]
    {
        assert_eq!(read(other.as_bytes(), "a"), None, "{other}");
    }
    // Latin-1 within a string.
    let latin = [line.trim_end_matches('}').as_bytes(), b", \"status\": \"gel\xf6st\"}"].concat();
    let Ok(Reply::Answered(answer)) = said(latin) else { panic!("no answer") };
    assert_eq!(answer.status.as_deref(), Some("gel\u{fffd}st"));
    assert_eq!(read(b"\xff{}", "a"), None);
}

/// A hundred thousand brackets, and numbers that would take gigabytes and minutes.
#[test]
fn nothing_that_is_read_takes_long() {
    use std::time::{Duration, Instant};
    let start = Instant::now();
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    answered(&format!("{U}, {N}, \"x\": {deep}"));
    let reason = garbled(&format!("{U}, \"contact_force\": {deep}"));
    assert!(
        reason.starts_with(&format!("invalid value '{}…'", "[".repeat(39))) && reason.len() < 300,
        "{reason}"
    );
    garbled(&format!("{U}, {N}, \"steps\": {deep}"));
    assert_eq!(read("{\"a\":".repeat(100_000).as_bytes(), "a"), None);

    let nines = "9".repeat(MAX_NUMBER_DIGITS + 1);
    assert_eq!(numbers(&nines[1..], "1")[0], exact(&nines[1..]));
    for number in [&nines, "1e9999", "1E-9999", "\"1E9999\"", "0x1p99999"] {
        let reason = garbled(&format!("{N}, \"deflection\": {number}"));
        assert!(reason.ends_with("must have no more than 4096 digits"), "{reason}");
    }
    // 1023 numbers of 4096 digits, 4094 in the last one, and those of U and N.
    let step = |n: &str| format!("{{\"deflection\": 1e4090, \"contact_force\": {n}}}");
    let steps =
        |last| format!("{U}, {N}, \"steps\": [{}{}]", (step("1e4090") + ", ").repeat(511), step(last));
    assert_eq!(answered(&steps("1e4088")).steps.len(), 512);
    assert!(garbled(&steps("1e4089")).contains("no more than 4194304 digits together"));
    let step = "{\"deflection\": 1, \"contact_force\": 1}";
    let steps = |count| format!("{U}, {N}, \"steps\": [{}]", vec![step; count].join(","));
    assert_eq!(answered(&steps(MAX_STEPS)).steps.len(), MAX_STEPS);
    assert_eq!(garbled(&steps(MAX_STEPS + 1)), "there must be no more than 10000 steps");
    let of_bytes = |bytes| {
        let line = format!(r#"{{"id": "a", {U}, {N}}}"#);
        format!("{line}{}", " ".repeat(bytes - line.len()))
    };
    assert!(matches!(said(of_bytes(MAX_LINE_BYTES)), Ok(Reply::Answered(_))));
    assert_eq!(
        said(of_bytes(MAX_LINE_BYTES + 1)),
        Err("a line must have no more than 16777216 bytes".to_string())
    );
    // A second or so.
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}

/// A line of the keys of an answer with values, of which some are not JSON; one byte may be any other.
fn any_line() -> impl Strategy<Value = Vec<u8>> {
    const KEYS: [&str; 9] =
        ["id", "deflection", "contact_force", "penetration", "status", "error", "steps", "used", "mass"];
    const VALUES: [&str; 16] = [
        "\"a\"",
        "1",
        "-1E+3",
        "1e5000",
        "\"1/3\"",
        "\"1/0\"",
        "nan(0x1)",
        "-inf",
        "null",
        "true",
        "[]",
        "{}",
        "[{\"deflection\": 1, \"contact_force\": 2}]",
        "\"b\\nc\\u001b\"",
        "\"\\ud800\"",
        "01",
    ];
    let pair = (prop::sample::select(&KEYS[..]), prop::sample::select(&VALUES[..]));
    let byte = prop::option::weighted(0.2, any::<(prop::sample::Index, u8)>());
    (prop::collection::vec(pair, 0..5), byte).prop_map(|(pairs, byte)| {
        let pairs: Vec<_> = pairs.iter().map(|(key, value)| format!("\"{key}\": {value}")).collect();
        let rest = if pairs.is_empty() { "" } else { ", " };
        let mut line = format!("{{\"id\": \"a\", {U}, {N}{rest}{}}}", pairs.join(", ")).into_bytes();
        if let Some((at, byte)) = byte {
            let at = at.index(line.len());
            line[at] = byte;
        }
        line
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Every line is a reply, an error of one line, or no object.
    #[test]
    fn any_line_is_a_reply_or_an_error(line in any_line()) {
        let reply = read(&line, "a");
        prop_assert_eq!(reply.is_none(), early(&line, "a").is_none());
        let text = match reply {
            Some(Err(text) | Ok(Reply::Refused(text) | Reply::InvalidResponse(text))) => text,
            _ => String::new(),
        };
        prop_assert!(text.len() < 2000 && !text.contains(['\n', '\r', '\u{1b}']), "{}", text);
    }
}

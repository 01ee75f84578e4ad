//! Evaluation that a wrong formula may abort: a division of rationals by zero panics, and so may code that
//! expects right formulas. Here a panic is a finding.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether a panic of this thread is caught and not printed.
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Returns the result of the work, or its panic message; nothing is printed.
///
/// The work must only compute, so that no state is left inconsistent.
pub(super) fn catch_panic<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |panic| {
            if !GUARDED.get() {
                before(panic);
            }
        }));
    });
    let outside = GUARDED.replace(true);
    let result = catch_unwind(AssertUnwindSafe(work));
    GUARDED.set(outside);
    result.map_err(|payload| message(&*payload))
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<&str>().copied();
    let text = text.or_else(|| payload.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("it panics").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Exact;

    #[test]
    fn a_panic_becomes_an_error_message() {
        let divided = |by: i32| catch_panic(|| Exact::from(1) / Exact::from(by));
        assert_eq!(divided(2), Ok("1/2".parse().unwrap()));
        assert_eq!(divided(0), Err("division by zero".to_string()));
        let formatted = catch_panic(|| -> () { panic!("{} is no number", "x") });
        assert_eq!(formatted, Err("x is no number".to_string()));
        let odd = catch_panic(|| -> () { std::panic::panic_any(7) });
        assert_eq!(odd, Err("it panics".to_string()));
    }

    #[test]
    #[should_panic(expected = "outside")]
    fn a_panic_outside_of_a_guard_is_not_caught() {
        let _ = catch_panic(|| -> () { panic!("inside") });
        panic!("outside");
    }

    /// Runs a test above as a program; returns what it prints.
    fn printed(test: &str) -> String {
        let own = std::env::current_exe().unwrap();
        let test = format!("verify::catch_panic::tests::{test}");
        let run = std::process::Command::new(own).args(["--exact", &test, "--nocapture"]).output().unwrap();
        let [report, printed] = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
        assert!(report.contains("1 passed"), "{report} {printed}");
        printed
    }

    #[test]
    fn a_guarded_panic_prints_nothing() {
        assert_eq!(printed("a_panic_becomes_an_error_message"), "");
    }

    #[test]
    fn a_panic_outside_of_a_guard_is_printed() {
        let printed = printed("a_panic_outside_of_a_guard_is_not_caught");
        assert!(printed.contains("outside") && !printed.contains("inside"), "{printed}");
    }

    #[test]
    fn nested_guards_are_independent() {
        let outer = catch_panic(|| {
            let inner = catch_panic(|| -> () { panic!("inner") });
            assert!(GUARDED.get());
            inner
        });
        assert_eq!(outer, Ok(Err("inner".to_string())));
        assert!(!GUARDED.get());
    }
}

//! Runner of laws over drawn values.

use proptest::prelude::*;
use proptest::test_runner::{Config, FileFailurePersistence, TestCaseResult, TestRunner};
use std::any::Any;
use std::cell::RefCell;
use std::fmt;
use std::panic::{self, AssertUnwindSafe, Location};
use std::rc::Rc;
use std::sync::Once;

/// Returns the number of cases of a law, which `PROPTEST_CASES` sets.
pub fn cases() -> u32 {
    Config::default().cases
}

/// A drawn value without its type, so that proptest's runner is compiled once.
#[derive(Clone)]
struct Drawn(Rc<dyn Value>);

trait Value: Any + fmt::Debug {}
impl<V: Any + fmt::Debug> Value for V {}

impl fmt::Debug for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

fn erased<V: fmt::Debug + 'static>(values: BoxedStrategy<V>) -> BoxedStrategy<Drawn> {
    values.prop_map(|value| Drawn(Rc::new(value))).boxed()
}

/// Asserts that a law panics for none of [`cases`] values. A value for which it does is shrunk and printed, and
/// its seed is kept in a file beside the source file of the caller, and tried first from then on.
#[track_caller]
pub fn holds<V: fmt::Debug + 'static>(values: impl Strategy<Value = V> + 'static, law: impl Fn(&V)) {
    holds_often(1, values, law);
}

/// Like [`holds`], with `times` as many values, for laws that a mistake violates rarely and that take little time.
#[track_caller]
pub fn holds_often<V: fmt::Debug + 'static>(
    times: u32,
    values: impl Strategy<Value = V> + 'static,
    law: impl Fn(&V),
) {
    let law = |Drawn(value): &Drawn| {
        let value: &dyn Any = &**value;
        law(value.downcast_ref().expect("of the type that is erased"));
    };
    run(times * cases(), &erased(values.boxed()), &law);
}

#[track_caller]
fn run(cases: u32, values: &BoxedStrategy<Drawn>, law: &dyn Fn(&Drawn)) {
    let source_file = Some(Location::caller().file());
    let mut config = Config { cases, source_file, ..Config::default() };
    // Unless the environment disables it.
    if config.failure_persistence.is_some() {
        config.failure_persistence =
            Some(Box::new(FileFailurePersistence::WithSource("proptest-regressions")));
    }
    let mut runner = TestRunner::new(config);
    if let Err(failure) = runner.run(values, |value| attempt(|| law(&value))) {
        panic!("{failure}\n{runner}");
    }
}

thread_local! {
    /// Message of the panic of an attempt; `None` outside of attempts.
    static MESSAGE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Returns the message of a panic, which is not printed: a value that is shrunk makes the law panic often.
fn attempt(law: impl FnOnce()) -> TestCaseResult {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            MESSAGE.with_borrow_mut(|message| match message {
                Some(message) => *message = panic.to_string(),
                None => print(panic),
            })
        }));
    });
    MESSAGE.set(Some(String::new()));
    let outcome = panic::catch_unwind(AssertUnwindSafe(law));
    let message = MESSAGE.take().unwrap_or_default();
    outcome.map_err(|_| TestCaseError::fail(message))
}

//! Systems without process groups: only the program itself is ended. No test runs this code.

use std::io;
use std::process::{Child, Command};

/// ERROR_BAD_EXE_FORMAT of Windows.
pub fn has_no_format(error: &io::Error) -> bool {
    error.raw_os_error() == Some(193)
}

pub fn start(command: &mut Command) -> io::Result<Child> {
    command.spawn()
}

pub fn has_ended(child: &mut Child) -> bool {
    !matches!(child.try_wait(), Ok(None))
}

pub fn kill(child: &mut Child) {
    // An error means that it has ended.
    let _ = child.kill();
}

//! Where there are no groups: the program alone. Nothing here is run by a test.

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
    // It fails where it has ended.
    let _ = child.kill();
}

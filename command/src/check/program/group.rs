//! A program with all its children, as a group of processes that is ended together.

#[cfg(not(unix))]
mod other;
#[cfg(unix)]
mod unix;

#[cfg(not(unix))]
pub use other::has_no_format;
#[cfg(not(unix))]
use other::{has_ended, kill, start};
use std::io;
use std::process::{Child, Command, ExitStatus};
#[cfg(unix)]
pub use unix::has_no_format;
#[cfg(unix)]
use unix::{has_ended, kill, start};

/// A child process that is ended when dropped.
///
/// On Unix it leads a process group. A signal from the terminal then only reaches this command, which passes
/// it on.
pub struct Group(Child);

impl Group {
    /// Starts a program.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        start(command).map(Group)
    }

    /// Returns the leader, for its pipes.
    pub fn child(&mut self) -> &mut Child {
        &mut self.0
    }

    /// Returns `true` if the leader has ended.
    pub fn has_ended(&mut self) -> bool {
        has_ended(&mut self.0)
    }

    /// Ends the whole group.
    pub fn end(&mut self) -> io::Result<ExitStatus> {
        kill(&mut self.0);
        self.0.wait()
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // A failure to wait for it cannot be handled here.
        let _ = self.end();
    }
}

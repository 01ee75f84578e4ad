//! A program with all its children, as a group of processes that is ended together.

#[cfg(not(unix))]
mod other;
#[cfg(unix)]
mod unix;

#[cfg(not(unix))]
use other as system;
use std::io;
use std::process::{Child, Command, ExitStatus};
pub use system::has_no_format;
#[cfg(unix)]
use unix as system;

/// A child process that is ended when dropped.
///
/// On Unix it leads a process group. A signal from the terminal then only reaches this command, which passes
/// it on.
pub struct Group(Child);

impl Group {
    /// Starts a program.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        system::start(command).map(Group)
    }

    /// Returns the leader, for its pipes.
    pub fn child(&mut self) -> &mut Child {
        &mut self.0
    }

    /// Returns `true` if the leader has ended.
    pub fn has_ended(&mut self) -> bool {
        system::has_ended(&mut self.0)
    }

    /// Ends the whole group.
    pub fn end(&mut self) -> io::Result<ExitStatus> {
        system::kill(&mut self.0);
        self.0.wait()
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // A failure to wait for it cannot be handled here.
        let _ = self.end();
    }
}

//! A program and all that it starts, as a group of processes that ends as one.

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

/// A child process; dropped, it ends.
///
/// On Unix it leads a process group. A signal from the terminal then reaches this command alone, which passes
/// it on.
pub struct Group(Child);

impl Group {
    /// Starts it.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        start(command).map(Group)
    }

    /// Its leader, for the pipes.
    pub fn child(&mut self) -> &mut Child {
        &mut self.0
    }

    /// Whether its leader has ended.
    pub fn has_ended(&mut self) -> bool {
        has_ended(&mut self.0)
    }

    /// Ends all of it.
    pub fn end(&mut self) -> io::Result<ExitStatus> {
        kill(&mut self.0);
        self.0.wait()
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // That it cannot be waited for leaves nothing to do.
        let _ = self.end();
    }
}

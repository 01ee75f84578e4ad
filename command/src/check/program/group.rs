//! A program with all its children, as a group of processes that is ended together.

use std::io;
use std::process::{Child, Command, ExitStatus};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A child process that is ended when dropped.
///
/// On Unix it leads a process group. A signal from the terminal then only reaches this command, which passes
/// it on. On other systems only the program itself is ended, and no test runs this code.
pub struct Group(Child);

/// Process numbers of leaders that have not been waited for, so that they are not reused.
static LEADERS: Mutex<Vec<u32>> = Mutex::new(Vec::new());

fn leaders() -> MutexGuard<'static, Vec<u32>> {
    LEADERS.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Group {
    /// Starts a program.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        let mut leaders = leaders();
        let child = command.spawn()?;
        leaders.push(child.id());
        Ok(Group(child))
    }

    /// Returns the leader, for its pipes.
    pub fn child(&mut self) -> &mut Child {
        &mut self.0
    }

    /// Returns `true` if the leader has ended.
    pub fn has_ended(&mut self) -> bool {
        #[cfg(unix)]
        return unix::has_ended(&self.0);
        #[cfg(not(unix))]
        return !matches!(self.0.try_wait(), Ok(None));
    }

    /// Ends the whole group.
    pub fn end(&mut self) -> io::Result<ExitStatus> {
        let mut leaders = leaders();
        if let Some(place) = leaders.iter().position(|leader| *leader == self.0.id()) {
            #[cfg(unix)]
            unix::end(leaders[place]);
            #[cfg(not(unix))]
            let _ = self.0.kill();
            leaders.swap_remove(place);
        }
        drop(leaders);
        self.0.wait()
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // A failure to wait for it cannot be handled here.
        let _ = self.end();
    }
}

#[cfg(unix)]
pub use unix::end_with_signals;

/// Does nothing: there are no signals.
#[cfg(not(unix))]
pub fn end_with_signals() -> io::Result<()> {
    Ok(())
}

#[cfg(unix)]
mod unix {
    use super::leaders;
    use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group, waitid};
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::iterator::Signals;
    use std::io;
    use std::process::{Child, exit};
    use std::thread;

    /// Ends a group, and its leader, which may have left it. An error means that all have ended.
    pub fn end(leader: u32) {
        if let Some(leader) = Pid::from_raw(leader as i32) {
            let _ = kill_process_group(leader, Signal::KILL);
            let _ = kill_process(leader, Signal::KILL);
        }
    }

    pub fn has_ended(leader: &Child) -> bool {
        // It is not waited for, so that its number remains that of the group, which may have other members.
        let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        matches!(waitid(WaitId::Pid(Pid::from_child(leader)), options), Ok(Some(_)) | Err(_))
    }

    /// Installs a handler that ends all groups before a signal ends the command. Otherwise a hanging program
    /// would remain. The exit status is the one that a shell reports for the signal.
    pub fn end_with_signals() -> io::Result<()> {
        let mut signals = Signals::new([SIGHUP, SIGINT, SIGQUIT, SIGTERM])?;
        thread::Builder::new().spawn(move || {
            if let Some(signal) = signals.forever().next() {
                // From here on no program is started.
                let leaders = leaders();
                leaders.iter().copied().for_each(end);
                exit(128 + signal);
            }
        })?;
        Ok(())
    }
}

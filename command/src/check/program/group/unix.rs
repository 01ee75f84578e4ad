//! Process groups with their leaders, which are also ended when a signal ends the command.

use rustix::io::Errno;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group, waitid};
use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
use signal_hook::iterator::Signals;
use std::io;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, exit};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// Leaders that have not been waited for, so that their process numbers are not reused.
static LEADERS: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

fn leaders() -> MutexGuard<'static, Vec<Pid>> {
    LEADERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends a group, and its leader, which may have left it. An error means that all have ended.
fn end(leader: Pid) {
    let _ = kill_process_group(leader, Signal::KILL);
    let _ = kill_process(leader, Signal::KILL);
}

/// Returns `true` if the system cannot execute the format of a file, for example a script without its first
/// line.
pub fn has_no_format(error: &io::Error) -> bool {
    Errno::from_io_error(error) == Some(Errno::NOEXEC)
}

/// Installs a handler that ends all groups before a signal ends the command. Otherwise a hanging program
/// would remain. The exit status is the one that a shell reports for the signal.
fn watch_signals() -> io::Result<()> {
    static WATCHED: Mutex<bool> = Mutex::new(false);
    let mut watched = WATCHED.lock().unwrap_or_else(PoisonError::into_inner);
    if !*watched {
        let mut signals = Signals::new([SIGHUP, SIGINT, SIGQUIT, SIGTERM])?;
        thread::Builder::new().spawn(move || {
            if let Some(signal) = signals.forever().next() {
                // From here on no program is started.
                let leaders = leaders();
                leaders.iter().copied().for_each(end);
                exit(128 + signal);
            }
        })?;
        *watched = true;
    }
    Ok(())
}

pub fn start(command: &mut Command) -> io::Result<Child> {
    watch_signals()?;
    let mut leaders = leaders();
    let child = command.process_group(0).spawn()?;
    leaders.push(Pid::from_child(&child));
    Ok(child)
}

pub fn has_ended(child: &mut Child) -> bool {
    // It is not waited for, so that its number remains that of the group, which may have other members.
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    matches!(waitid(WaitId::Pid(Pid::from_child(child)), options), Ok(Some(_)) | Err(_))
}

pub fn kill(child: &mut Child) {
    let mut leaders = leaders();
    if let Some(place) = leaders.iter().position(|leader| *leader == Pid::from_child(child)) {
        end(leaders.swap_remove(place));
    }
}

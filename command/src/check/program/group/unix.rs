//! A leader and its group, which end when the command is signalled, too.

use rustix::io::Errno;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group, waitid};
use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
use signal_hook::iterator::Signals;
use std::io;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, exit};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

/// Leaders that have not been waited for, so that no stranger has their number.
static LEADERS: Mutex<Vec<Pid>> = Mutex::new(Vec::new());

fn leaders() -> MutexGuard<'static, Vec<Pid>> {
    LEADERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends a group, and its leader, who may have left it. It fails where nobody is left.
fn end(leader: Pid) {
    let _ = kill_process_group(leader, Signal::KILL);
    let _ = kill_process(leader, Signal::KILL);
}

/// Returns `true` if a file is of no format that the system can execute, as a script without its first line.
pub fn has_no_format(error: &io::Error) -> bool {
    Errno::from_io_error(error) == Some(Errno::NOEXEC)
}

/// Has a signal that ends the command end all groups first, once. Without it a program that hangs would be
/// left behind: all that it notices is that its pipes are closed. The exit status is the one that a shell
/// reports for a command that such a signal ended.
fn watch_signals() -> io::Result<()> {
    static WATCHED: Mutex<bool> = Mutex::new(false);
    let mut watched = WATCHED.lock().unwrap_or_else(PoisonError::into_inner);
    if !*watched {
        let mut signals = Signals::new([SIGHUP, SIGINT, SIGQUIT, SIGTERM])?;
        thread::Builder::new().spawn(move || {
            if let Some(signal) = signals.forever().next() {
                // None is started any more.
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
    // It is not waited for: its number stays that of the group, which may still have others in it.
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    matches!(waitid(WaitId::Pid(Pid::from_child(child)), options), Ok(Some(_)) | Err(_))
}

pub fn kill(child: &mut Child) {
    let mut leaders = leaders();
    if let Some(place) = leaders.iter().position(|leader| *leader == Pid::from_child(child)) {
        end(leaders.swap_remove(place));
    }
}

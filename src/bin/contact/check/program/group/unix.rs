//! A leader and its group, which end when the command is signalled, too.

use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, kill_process_group, waitid};
use std::io;
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, exit};
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

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

pub fn start(command: &mut Command) -> io::Result<Child> {
    static ON_SIGNAL: Once = Once::new();
    ON_SIGNAL.call_once(|| {
        // Without it Ctrl-C leaves to a program that hangs what any other does: that its pipes are closed.
        let _ = ctrlc::set_handler(|| {
            // None is started any more.
            let leaders = leaders();
            leaders.iter().copied().for_each(end);
            exit(130);
        });
    });
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

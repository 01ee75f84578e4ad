//! All tests of the command, in one binary.

#[cfg(unix)]
mod any_arguments;
mod batch;
#[cfg(unix)]
mod check;
mod command;
#[cfg(unix)]
mod faults;
mod processes;
#[cfg(unix)]
mod programs;

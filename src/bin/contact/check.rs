//! `contact check`: holds a program against the exact answer.

mod program;
mod reply;

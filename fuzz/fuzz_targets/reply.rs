//! A line that a program answers with.

#![no_main]

#[allow(dead_code)]
#[path = "../../command/examples/any_bits/bytes.rs"]
mod bytes;
#[path = "../../command/examples/any_bits/of_reply.rs"]
mod of_reply;

#[allow(dead_code, unused_imports, unused_macros)]
#[path = "../../command/src"]
mod contact {
    pub mod args;
    pub mod json;
    pub mod lines;
    pub mod output;
    pub mod check {
        pub mod reply;
    }
}

use contact::{args, json, lines, output};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| of_reply::read(bytes));

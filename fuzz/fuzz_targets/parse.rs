//! Texts as numbers.

#![no_main]

#[allow(dead_code)]
#[path = "../../command/examples/any_bits/bytes.rs"]
mod bytes;
#[allow(dead_code)]
#[path = "../../command/examples/any_bits/holds.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::parse(bytes));

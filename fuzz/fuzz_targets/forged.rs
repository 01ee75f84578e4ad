//! A proof with random changes.

#![no_main]

#[allow(dead_code)]
#[path = "../../command/examples/any_bits/bytes.rs"]
mod bytes;
#[path = "../../command/examples/any_bits/forged.rs"]
mod forged;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| forged::prove_nothing(bytes));

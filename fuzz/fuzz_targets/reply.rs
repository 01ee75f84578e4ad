//! A line that a program answers with.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| any_bits::read(bytes));

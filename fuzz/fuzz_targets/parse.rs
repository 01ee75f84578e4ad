//! Texts as numbers.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| any_bits::parse(bytes));

//! A proof with random changes.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| any_bits::prove_nothing(bytes));

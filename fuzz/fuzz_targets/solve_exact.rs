//! A system and a method of rationals.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| any_bits::test("solve_exact", bytes));

//! A system and a method of f32s.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| any_bits::test("solve_f32", bytes));

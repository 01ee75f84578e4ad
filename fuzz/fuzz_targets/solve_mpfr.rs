//! A system and a method of floats of 2 to 64 bits.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| any_bits::test("solve_mpfr", bytes));

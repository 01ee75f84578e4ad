//! A system and a method of floats of 2 to 64 bits.

#![no_main]

#[allow(dead_code)]
#[path = "../../command/examples/any_bits/bytes.rs"]
mod bytes;
#[allow(dead_code)]
#[path = "../../command/examples/any_bits/holds.rs"]
mod holds;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| holds::solve_any::<spring_mass_contact::number::Mpfr>(bytes));

//! A mass hangs on a spring over a rigid plane.
//!
#![doc = include_str!("map.md")]

pub mod chapter;
pub mod number;

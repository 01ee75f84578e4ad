//! Rounding keeps order: one formula is no less than another, step by step.

use super::derivation::{Signed, Why};
use super::reader::Reader;
use super::sign::Sign;
use crate::number::Tree;
use crate::number::tree::Step::*;

/// The signs from which it follows that `a` ≥ `b`, where both are defined.
///
/// Their steps are compared as long as they are alike: rounding, +, ⟨·⟩ and min keep order, and so do
/// factors and divisors that are positive; a minus turns it round. Where they are no longer alike, the sign
/// of the difference decides.
pub(super) fn at_least(reader: &mut Reader, a: &Tree, b: &Tree) -> Result<Vec<Signed>, Why> {
    if a == b {
        return Ok(Vec::new());
    }
    match (a.step(), b.step()) {
        (Rounded(a), Rounded(b)) | (PositivePart(a), PositivePart(b)) => at_least(reader, a, b),
        (Neg(a), Neg(b)) => at_least(reader, b, a),
        (Add(a, c), Add(b, d)) | (Min(a, c), Min(b, d)) => both(reader, [(a, b), (c, d)]),
        (Sub(a, c), Sub(b, d)) => both(reader, [(a, b), (d, c)]),
        (Mul(factor, a), Mul(same, b)) if factor == same => multiples(reader, factor, a, b),
        (Mul(a, factor), Mul(b, same)) if factor == same => multiples(reader, factor, a, b),
        (Div(a, divisor), Div(b, same)) if divisor == same => multiples(reader, divisor, a, b),
        _ => {
            let difference = reader.read(a)? - reader.read(b)?;
            Ok(vec![reader.of_sign(difference, Sign::NonNegative)?])
        }
    }
}

fn both(reader: &mut Reader, pairs: [(&Tree, &Tree); 2]) -> Result<Vec<Signed>, Why> {
    let mut all = Vec::new();
    for (a, b) in pairs {
        all.extend(at_least(reader, a, b)?);
    }
    Ok(all)
}

/// Of the same factor or divisor.
fn multiples(reader: &mut Reader, factor: &Tree, a: &Tree, b: &Tree) -> Result<Vec<Signed>, Why> {
    let value = reader.read(factor)?;
    let signed = reader.sign(value)?;
    let keeps = signed.sign().implies(Sign::NonNegative);
    let mut all = vec![signed];
    all.extend(if keeps { at_least(reader, a, b)? } else { at_least(reader, b, a)? });
    Ok(all)
}

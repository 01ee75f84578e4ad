//! The monotonicity of rounding: comparisons of two formulas, operation by operation.

use super::derivation::{ProofError, SignedRatio};
use super::sign::Sign;
use super::translator::Translator;
use crate::number::Tree;
use crate::number::tree::Op::*;

/// Returns the signs that imply `a` ≥ `b` wherever both are defined.
///
/// Corresponding operations are compared while they agree: rounding, +, ⟨·⟩ and min preserve order, and so
/// do positive factors and divisors; a minus reverses it. Where the operations differ, the sign of the
/// difference of the formulas decides.
pub(super) fn at_least(reader: &mut Translator, a: &Tree, b: &Tree) -> Result<Vec<SignedRatio>, ProofError> {
    if a == b {
        return Ok(Vec::new());
    }
    match (a.op(), b.op()) {
        (Rounded(a), Rounded(b)) | (PositivePart(a), PositivePart(b)) => at_least(reader, a, b),
        (Neg(a), Neg(b)) => at_least(reader, b, a),
        (Add(a, c), Add(b, d)) | (Min(a, c), Min(b, d)) => both(reader, [(a, b), (c, d)]),
        (Sub(a, c), Sub(b, d)) => both(reader, [(a, b), (d, c)]),
        (Mul(factor, a), Mul(same, b)) if factor == same => multiples(reader, factor, a, b),
        (Mul(a, factor), Mul(b, same)) if factor == same => multiples(reader, factor, a, b),
        (Div(a, divisor), Div(b, same)) if divisor == same => multiples(reader, divisor, a, b),
        _ => {
            let difference = reader.translate(a)? - reader.translate(b)?;
            Ok(vec![reader.require_sign(difference, Sign::NonNegative)?])
        }
    }
}

fn both(reader: &mut Translator, pairs: [(&Tree, &Tree); 2]) -> Result<Vec<SignedRatio>, ProofError> {
    let mut all = Vec::new();
    for (a, b) in pairs {
        all.extend(at_least(reader, a, b)?);
    }
    Ok(all)
}

/// Compares the multiples of `a` and `b` by a common factor, or their quotients by a common divisor.
fn multiples(
    reader: &mut Translator,
    factor: &Tree,
    a: &Tree,
    b: &Tree,
) -> Result<Vec<SignedRatio>, ProofError> {
    let value = reader.translate(factor)?;
    let signed = reader.sign(value)?;
    let preserves_order = signed.sign().implies(Sign::NonNegative);
    let mut all = vec![signed];
    all.extend(if preserves_order { at_least(reader, a, b)? } else { at_least(reader, b, a)? });
    Ok(all)
}

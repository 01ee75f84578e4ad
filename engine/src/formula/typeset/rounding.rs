//! Notation of rounding: fl(a + b c) is a + b c with every operation rounded, nearest(a + b c) is rounded
//! once.
//!
//! In the brackets of fl the result of every + − × ÷ and eˣ is rounded, from the left. A change of sign and
//! scaling by a power of two are exact, and so is everything in ⟨ ⟩, in | | and after min or max. An
//! operation whose rounding would not follow from this has an fl of its own, as in `fl(a + fl(b + c))`. If an
//! operation in the brackets is not rounded, as in `a + b c` with only the sum rounded, the text contains
//! nearest instead.

use crate::formula::symbols::SCALES;
use crate::number::Tree;
use crate::number::tree::Op::{self, *};

/// Returns the name, `fl` or `nearest`, and the argument that denote the rounding of a formula.
pub(super) fn notation(of: &Tree) -> (&'static str, Tree) {
    if rounds_each_op(of) { ("fl", without_implied_roundings(of)) } else { ("nearest", of.clone()) }
}

/// Returns the name of the brackets, `fl` or `nearest`, in which the content of a rounding is written
/// unchanged.
pub(crate) fn name_of_rounding(of: &Tree) -> &'static str {
    notation(of).0
}

fn is_operation(tree: &Tree) -> bool {
    matches!(tree.op(), Add(..) | Sub(..) | Mul(..) | Div(..) | Exp(_))
}

/// Returns the quantity of which this is a multiple by a power of two.
fn scaled(tree: &Tree) -> Option<&Tree> {
    fn is_scale(tree: &Tree) -> bool {
        match unsigned(tree).op() {
            Symbol(name) => SCALES.contains(name),
            Mul(a, b) | Div(a, b) => is_scale(a) && is_scale(b),
            _ => false,
        }
    }
    match tree.op() {
        Mul(a, b) | Div(a, b) if is_scale(b) => Some(a),
        Mul(a, b) if is_scale(a) => Some(b),
        _ => None,
    }
}

/// Returns `true` if every operation of a rounded formula is rounded as well.
fn rounds_each_op(of: &Tree) -> bool {
    match of.op() {
        _ if scaled(of).is_some() => scaled(of).is_some_and(rounds_each_op),
        Neg(a) => rounds_each_op(a),
        op if is_operation(of) => op.operands().all(is_operand),
        _ => true,
    }
}

/// Returns `true` if no operation of an operand needs rounding.
fn is_operand(tree: &Tree) -> bool {
    match tree.op() {
        _ if scaled(tree).is_some() => scaled(tree).is_some_and(is_operand),
        Neg(a) => is_operand(a),
        _ => !is_operation(tree),
    }
}

/// Returns an operation without those roundings of its operands that their positions in fl( ) imply.
fn without_implied_roundings(of: &Tree) -> Tree {
    let first = std::cell::Cell::new(true);
    let op = of.op().map(|operand| {
        let is_left = first.replace(false);
        match operand.op() {
            Rounded(inner) if is_operation(of) && is_implied(of, is_left, inner) => {
                without_implied_roundings(inner)
            }
            _ => operand.clone(),
        }
    });
    of.with_op(op)
}

/// Returns `true` if the position of an operand in fl( ), left or right, implies its rounding.
fn is_implied(of: &Tree, is_left: bool, operand: &Tree) -> bool {
    is_operation(operand)
        && scaled(operand).is_none()
        && rounds_each_op(operand)
        && !is_simplified(operand)
        && match (of.op(), operand.op()) {
            (Mul(..), Div(..)) | (Div(..), Div(..)) => false,
            (Add(..) | Sub(..), Add(..) | Sub(..)) => is_left,
            (Mul(..), Mul(..)) => is_left && stays_in_order(of),
            (Div(a, b), Mul(..)) => {
                let numbers = [a, b].map(|side| factors(side).iter().filter(|f| is_number(f)).count());
                numbers != [1, 1] && stays_in_order(operand)
            }
            _ => true,
        }
}

/// Returns `true` if the text of an operation is simplified: 1 a to a, a + 0 to a, 2 · 3 to 6.
fn is_simplified(operation: &Tree) -> bool {
    let is =
        |tree: &Tree, numbers: &[i32]| matches!(unsigned(tree).op(), Int(n) if numbers.contains(&n.abs()));
    match operation.op() {
        Add(a, b) | Sub(a, b) => is(a, &[0]) || is(b, &[0]),
        Mul(a, b) => is(a, &[0, 1]) || is(b, &[0, 1]) || [a, b].into_iter().all(is_number),
        Div(a, b) => is(a, &[0]) || is(b, &[0, 1]) || [a, b].into_iter().all(is_number),
        _ => false,
    }
}

/// Returns `true` if the factors of a product keep their positions: numbers move to the front in a text, and
/// equal factors become a power.
fn stays_in_order(product: &Tree) -> bool {
    let factors = factors(product);
    let texts: Vec<_> = factors.iter().map(|factor| factor.to_string()).collect();
    let repeats = (1..texts.len()).any(|i| texts[..i].contains(&texts[i]));
    let numbers: Vec<_> = (0..factors.len()).filter(|i| is_number(factors[*i])).collect();
    !repeats && numbers.len() <= 1 && numbers.iter().all(|place| *place < 2)
}

/// Returns the factors of a product from the left, without signs and scales.
fn factors(tree: &Tree) -> Vec<&Tree> {
    let tree = unsigned(tree);
    match tree.op() {
        _ if scaled(tree).is_some() => scaled(tree).map(factors).unwrap_or_default(),
        Rounded(a) if matches!(a.op(), Mul(..)) && scaled(a).is_none() => factors(a),
        Mul(a, b) => [factors(a), vec![unsigned(b)]].concat(),
        _ => vec![tree],
    }
}

fn is_number(tree: &Tree) -> bool {
    matches!(unsigned(tree).op(), Op::Int(_))
}

fn unsigned(tree: &Tree) -> &Tree {
    if let Neg(a) = tree.op() { unsigned(a) } else { tree }
}

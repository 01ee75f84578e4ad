//! Rounding in a text: fl(a + b c) is a + b c with every step rounded, nearest(a + b c) is rounded once.
//!
//! In the brackets of fl the result of every + − × ÷ and eˣ is rounded, in the order in which they stand,
//! from the left. A change of sign and scaling by a power of two are exact; so is all that stands in ⟨ ⟩,
//! in | | and after min or max. A step whose rounding would not be read from that has an fl of its own, as
//! `fl(a + fl(b + c))`. Where a step in the brackets does not round, as in `a + b c` with only the sum
//! rounded, the text says nearest instead.

use super::size;
use crate::formula::claim::SCALES;
use crate::number::Tree;
use crate::number::tree::Step::{self, *};

/// Name and content of the brackets that stand for the rounding of a formula.
pub(super) fn brackets(of: &Tree) -> (&'static str, Tree) {
    if rounds_each_step(of) { ("fl", steps(of)) } else { ("nearest", of.clone()) }
}

/// Name of the brackets in which the content of a rounding stands as it is: `fl` or `nearest`.
pub(crate) fn name_of_rounding(of: &Tree) -> &'static str {
    brackets(of).0
}

fn is_operation(tree: &Tree) -> bool {
    matches!(tree.step(), Add(..) | Sub(..) | Mul(..) | Div(..) | Exp(_))
}

/// The quantity that this is a multiple of, by a power of two.
fn scaled(tree: &Tree) -> Option<&Tree> {
    fn is_scale(tree: &Tree) -> bool {
        match unsigned(tree).step() {
            Symbol(name) => SCALES.contains(name),
            Mul(a, b) | Div(a, b) => is_scale(a) && is_scale(b),
            _ => false,
        }
    }
    match tree.step() {
        Mul(a, b) | Div(a, b) if is_scale(b) => Some(a),
        Mul(a, b) if is_scale(a) => Some(b),
        _ => None,
    }
}

/// Returns `true` if each step in what is rounded is rounded as well.
fn rounds_each_step(of: &Tree) -> bool {
    match of.step() {
        _ if scaled(of).is_some() => scaled(of).is_some_and(rounds_each_step),
        Neg(a) if size(a).is_none() => rounds_each_step(a),
        step if is_operation(of) => step.operands().all(is_operand),
        _ => true,
    }
}

/// Returns `true` if no step of an operand needs rounding.
fn is_operand(tree: &Tree) -> bool {
    match tree.step() {
        _ if scaled(tree).is_some() => scaled(tree).is_some_and(is_operand),
        Neg(a) => is_operand(a),
        _ => !is_operation(tree),
    }
}

/// The formula without the roundings that its place in fl( ) implies.
fn steps(of: &Tree) -> Tree {
    let first = std::cell::Cell::new(true);
    let step = of.step().map(|operand| {
        let is_left = first.replace(false);
        match operand.step() {
            Rounded(inner) if is_operation(of) && is_implied(of, is_left, inner) => steps(inner),
            _ => operand.clone(),
        }
    });
    of.with_step(step)
}

/// Returns `true` if the rounding of an operand is read from its place in fl( ), on the left or on the right.
fn is_implied(of: &Tree, is_left: bool, operand: &Tree) -> bool {
    is_operation(operand)
        && scaled(operand).is_none()
        && rounds_each_step(operand)
        && !is_simplified(operand)
        && match (of.step(), operand.step()) {
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

/// Returns `true` if a text has simpler steps: 1 a is written as a, a + 0 as a, 2 · 3 as 6.
fn is_simplified(operation: &Tree) -> bool {
    let is =
        |tree: &Tree, numbers: &[i32]| matches!(unsigned(tree).step(), Int(n) if numbers.contains(&n.abs()));
    match operation.step() {
        Add(a, b) | Sub(a, b) => is(a, &[0]) || is(b, &[0]),
        Mul(a, b) => is(a, &[0, 1]) || is(b, &[0, 1]) || [a, b].into_iter().all(is_number),
        Div(a, b) => is(a, &[0]) || is(b, &[0, 1]) || [a, b].into_iter().all(is_number),
        _ => false,
    }
}

/// Returns `true` if the factors of a product stay in their places: numbers come first in a text, and equal
/// factors become a power.
fn stays_in_order(product: &Tree) -> bool {
    let factors = factors(product);
    let texts: Vec<_> = factors.iter().map(|factor| factor.to_string()).collect();
    let repeats = (1..texts.len()).any(|i| texts[..i].contains(&texts[i]));
    let numbers: Vec<_> = (0..factors.len()).filter(|i| is_number(factors[*i])).collect();
    !repeats && numbers.len() <= 1 && numbers.iter().all(|place| *place < 2)
}

/// The factors of a product from the left, without their signs and scales.
fn factors(tree: &Tree) -> Vec<&Tree> {
    let tree = unsigned(tree);
    match tree.step() {
        _ if scaled(tree).is_some() => scaled(tree).map(factors).unwrap_or_default(),
        Rounded(a) if matches!(a.step(), Mul(..)) && scaled(a).is_none() => factors(a),
        Mul(a, b) => [factors(a), vec![unsigned(b)]].concat(),
        _ => vec![tree],
    }
}

fn is_number(tree: &Tree) -> bool {
    matches!(unsigned(tree).step(), Step::Int(_))
}

fn unsigned(tree: &Tree) -> &Tree {
    match tree.step() {
        Neg(a) if size(a).is_none() => unsigned(a),
        _ => tree,
    }
}

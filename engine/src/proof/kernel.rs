//! The kernel: a [`Statement`] in, a [`Proof`] out, or [`Why`] there is none.
//!
//! A formula is read step by step into a quotient of polynomials ([`algebra`]); a division
//! needs a proof that its divisor is not 0, a bracket ⟨x⟩ or a minimum needs the sign of what it depends on.
//! Where the sign for a bracket is open, the kernel splits into two cases, positive or not, and proves
//! both; a divisor whose sign is open is the end of the attempt.
//!
//! A hypothesis v > 0 that does not follow from others, and is more than the sign of a symbol, becomes v =
//! s for a new symbol s > 0: one monomial of v, the *pivot*, is replaced wherever it occurs by what it
//! equals then. (For R = m g − c (H − l) > 0: m g by s + c (H − l); or H by (c l + m g − s)/c, where c ≠ 0
//! is known.) Equals are replaced by equals, so what is proved of all values of the symbols that are left,
//! s > 0 among them, holds in particular for those that satisfy the hypothesis. Which monomial is chosen
//! matters for success and not for soundness. Where no pivot is found, v may be divided by a symbol that is
//! positive: for k > 0, the hypothesis 1 − k > 0 is (1 − k)/k = s > 0, and k is 1/(1 + s).
//!
//! | to prove | the rule |
//! |---|---|
//! | a = b | a − b is the zero polynomial over some denominator |
//! | a > 0, a ≥ 0, a = 0 | the sign of its numerator and of its denominator ([`sign`]) |
//! | da/dx = b | dual numbers differentiate a by the sum, product and quotient rules; then as a = b |
//! | \|a\| ≤ b | the signs of b − a and b + a |
//! | lim a = b for x → ∞ | degrees in x; e^… with an exponent that tends to −∞ vanishes against any power |
//!
//! A quantity that is supposed to be in an interval is, for some −1 ≤ t ≤ 1, its middle and t times half of
//! its length; so it is replaced.
//!
//! A hypothesis h > 0 without a pivot is kept as it is, and so is a known sign of what is replaced by its
//! place in an interval. Where no rule finds the sign of v, one may find those of m and of v − m h, for a
//! quotient m that makes a symbol cancel: v = m h + (v − m h) has the sign that both parts have.
//!
//! **Rounding.** fl(x), the number of p bits nearest to x, is x (1 + γ e) for some −1 ≤ e ≤ 1, where γ =
//! 1/(2ᵖ + 1); nothing is said about over- and underflow. For let 2ᵏ ≤ |x| < 2ᵏ⁺¹. Then |fl(x) − x| is at
//! most 2ᵏ/2ᵖ, and since 2ᵏ itself has p bits, at most |x| − 2ᵏ. The first, 2ᵖ times, and the second add up
//! to (2ᵖ + 1) |fl(x) − x| ≤ 2ᵏ + |x| − 2ᵏ = |x|. So the kernel reads it, with an e of its own for each
//! formula that is rounded. Two of which it sees that they are equal, up to powers of two, have the same e:
//! of what is in other units the digits are the same. Rounding keeps order: fl(a) ≥ fl(b) if, step by step,
//! nothing in a is less than what stands in its place in b ([`order`]). It has jumps, so nothing is said of
//! limits and derivatives of what is rounded.
//!
//! New symbols are none of the statement's ([`Symbol`]). Those of an induction, its members and the power q,
//! must not occur in what is the same at each of its steps: `check_names` sees to it.
//!
//! What is assumed of the variable of a limit has to hold for all values that are large enough: that it is
//! positive, or that an increasing linear function of it is. That function is then the variable.

pub(super) mod algebra;
pub(super) mod context;
mod derivation;
pub(super) mod effort;
mod monomial;
mod number;
mod order;
mod reader;
pub(super) mod sign;

pub use derivation::{Because, Derivation, Direct, Multiple, Proof, Rounding, Signed, Supposed, Used, Why};

use self::algebra::{Monomial, Poly, Ratio, Symbol};
use self::context::{Context, sign};
pub use self::effort::MAX_EFFORT;
use self::reader::Reader;
use self::sign::Sign;
use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Goal, Proposition, Sequence, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{self, Step};
use crate::number::{Dual, Tree};
use std::cmp::Ordering;
use std::iter;

impl From<Relation> for Sign {
    fn from(relation: Relation) -> Self {
        match relation {
            Relation::Positive => Sign::Positive,
            Relation::NonNegative => Sign::NonNegative,
            Relation::Zero => Sign::Zero,
        }
    }
}

/// The number of operations, quantities and numbers in all formulas of a statement, at most.
pub const MAX_SIZE: u32 = 20_000;

/// The depth of a formula in a statement, at most.
pub const MAX_DEPTH: u32 = 500;

/// The number of formulas in a statement that are rounded, at most.
pub const MAX_ROUNDINGS: usize = 64;

/// Proves a statement.
///
/// # Errors
/// Returns the reason if it finds no proof, which does not refute the statement; [`Why::TooLarge`] if the
/// statement exceeds [`MAX_SIZE`] or [`MAX_DEPTH`], or the proof [`MAX_EFFORT`].
pub fn prove(statement: &Statement) -> Result<Proof, Why> {
    check_size(statement.trees())?;
    effort::bounded(|| search(statement)).unwrap_or(Err(Why::TooLarge("its proof", MAX_EFFORT)))
}

/// Derives a proposition from hypotheses, which is not a proof of any statement.
///
/// # Errors
/// Returns the reason if it finds no derivation, like [`prove`].
pub(super) fn derivation(hypotheses: &[&Hypothesis], proposition: &Proposition) -> Result<Derivation, Why> {
    let trees = || hypotheses.iter().map(|hypothesis| &hypothesis.value).chain(proposition.trees());
    check_size(trees())?;
    let roundings = roundings(trees());
    if roundings.len() > MAX_ROUNDINGS {
        return Err(Why::TooMany);
    }
    if !roundings.is_empty() && proposition.variable().is_some() {
        return Err(Why::Jump);
    }
    let search = || {
        let context = Context::of(roundings).with_variable(proposition);
        derive(&Goal::of_claim("", proposition.clone()), context, hypotheses, CASES)
    };
    effort::bounded(search).unwrap_or(Err(Why::TooLarge("its proof", MAX_EFFORT)))
}

/// # Errors
/// Returns [`Why::TooLarge`] if the formulas exceed [`MAX_SIZE`] or [`MAX_DEPTH`].
pub(super) fn check_size<'t>(trees: impl Iterator<Item = &'t Tree> + Clone) -> Result<(), Why> {
    let deepest = trees.clone().map(Tree::depth).max().unwrap_or(0);
    if deepest > MAX_DEPTH {
        return Err(Why::TooLarge("its depth", MAX_DEPTH as usize));
    }
    let size = trees.fold(0, |sum: u32, tree| sum.saturating_add(tree.size()));
    if size > MAX_SIZE {
        return Err(Why::TooLarge("its size", MAX_SIZE as usize));
    }
    Ok(())
}

fn search(statement: &Statement) -> Result<Proof, Why> {
    if statement.goals().is_empty() {
        return Err(Why::Nothing);
    }
    check_names(statement)?;
    let roundings = roundings(statement.trees());
    if roundings.len() > MAX_ROUNDINGS {
        return Err(Why::TooMany);
    }
    // What is computed varies with what it is computed from, and is a symbol all the same.
    if (!roundings.is_empty() || !statement.computed().is_empty()) && varies(statement) {
        return Err(Why::Jump);
    }
    let context = Context::of(roundings);
    let goals = statement.goals().iter().map(|goal| {
        let hypotheses = statement.hypotheses_for(goal.role);
        derive(goal, context.clone().with_variable(&goal.proposition), &hypotheses, CASES)
    });
    Ok(Proof { goals: goals.collect::<Result<_, _>>()?, statement: statement.clone() })
}

/// Refuses a statement that uses a name in a sense that is not its to choose.
///
/// - Names that a reader would take for symbols of a proof occur nowhere, and those of members of a sequence
///   only where a perturbed recursion speaks of its first.
/// - A computed symbol has no other meaning. It may be another number at each step: nothing is assumed of it
///   but its interval, and it is computed neither from itself nor from one that is computed after it.
/// - The start, ratio and limit of a sequence depend on no power, no member and nothing computed; its step
///   and the hypotheses of its limit on no power; its closed form and the bound of its distance from that on
///   no member and nothing computed; the bounds of other quantities on no member.
fn check_names<'t>(statement: &'t Statement) -> Result<(), Why> {
    fn refuse<'t>(
        trees: impl Iterator<Item = &'t Tree>,
        names: impl Fn(&'static str) -> bool,
    ) -> Result<(), Why> {
        let mut symbols = trees.flat_map(Tree::symbols);
        symbols.find(|name| names(name)).map_or(Ok(()), |name| Err(Why::Reserved(name)))
    }
    let is_member = |name| name == MEMBERS[0];
    let drifts = statement.conclusion().is_some_and(|sequence| sequence.is_perturbed());
    let own = |name| {
        let is_used = drifts && is_member(name);
        Symbol::is_reserved(name) || (MEMBERS.contains(&name) && !is_used)
    };
    refuse(statement.trees(), own)?;
    let mut variables = statement.goals().iter().filter_map(|goal| goal.proposition.variable());
    variables.find(|name| own(name)).map_or(Ok(()), |name| Err(Why::Reserved(name)))?;

    let computed = statement.computed();
    let is_computed_from = |i: usize, name| computed[i..].iter().any(|computed| computed.symbol == name);
    let is_computed = |name| is_computed_from(0, name);
    let mut meant = [POWER, PRECISION].into_iter().chain(MEMBERS).chain(SCALES);
    meant.find(|name| is_computed(*name)).map_or(Ok(()), |name| Err(Why::Reserved(name)))?;

    let values = |all: &'t [Hypothesis]| all.iter().map(|hypothesis| &hypothesis.value);
    let hypotheses = values(statement.hypotheses());
    if let Some(Sequence { start, step, ratio, limit, member, within }) = statement.conclusion() {
        refuse(start.iter().chain([ratio]).chain(limit), |name| {
            name == POWER || MEMBERS.contains(&name) || is_computed(name)
        })?;
        refuse(step.iter(), |name| name == POWER)?;
        // What is assumed of one power need not hold as it tends to 0.
        refuse(hypotheses.clone().filter(|_| limit.is_some()), |name| name == POWER)?;
        let bounds = || within.iter().map(|(_, bound)| bound);
        refuse(member.iter().chain(bounds().take(1)), |name| is_member(name) || is_computed(name))?;
        refuse(bounds(), is_member)?;
    }
    let rename = |why| if let Why::Reserved(name) = why { Why::AssumedOfComputed(name) } else { why };
    refuse(hypotheses.chain(values(statement.invariants())), is_computed).map_err(rename)?;
    let mut all = computed.iter().enumerate();
    all.try_for_each(|(i, own)| refuse(iter::once(&own.by), |name| is_computed_from(i, name)).map_err(rename))
}

/// Does something vary in a statement, and not from one whole number to the next?
fn varies(statement: &Statement) -> bool {
    let tends = statement.conclusion().is_some_and(|sequence| sequence.limit.is_some());
    tends || statement.goals().iter().any(|goal| goal.proposition.variable().is_some())
}

/// All that is rounded in a statement, each after what is rounded in it: the order in which errors have
/// names.
pub(super) fn roundings<'t>(trees: impl Iterator<Item = &'t Tree>) -> Vec<Tree> {
    fn collect(tree: &Tree, all: &mut Vec<Tree>) {
        tree.step().operands().for_each(|operand| collect(operand, all));
        // One too many is enough to know that there are too many.
        if let Step::Rounded(of) = tree.step()
            && all.len() <= MAX_ROUNDINGS
            && !all.contains(of)
        {
            all.push(of.clone());
        }
    }
    let mut all = Vec::new();
    trees.for_each(|tree| collect(tree, &mut all));
    all
}

/// How many splits may be nested.
const CASES: u32 = 4;

/// A goal, under what is supposed and under hypotheses that are still to be taken in. Where a bracket is
/// open, in both cases.
fn derive(
    goal: &Goal,
    mut context: Context,
    mut hypotheses: &[&Hypothesis],
    cases: u32,
) -> Result<Derivation, Why> {
    let taken = loop {
        let [next, rest @ ..] = hypotheses else { break Ok(()) };
        match context.take_in(next) {
            Ok(()) => hypotheses = rest,
            Err(why) => break Err(why),
        }
    };
    match taken.and_then(|()| context.direct(goal)) {
        Ok(direct) => Ok(Derivation::Direct(direct.into())),
        Err(Why::OpenBracket(value)) if cases > 0 => {
            let deciding = context.deciding(&value);
            let case = |sign| {
                let mut context = context.clone();
                context.suppose(None, deciding.clone().into(), sign);
                derive(goal, context, hypotheses, cases - 1)
            };
            let (positive, not) = (case(Sign::Positive)?, case(Sign::NonPositive)?);
            Ok(Derivation::Cases(deciding, positive.into(), not.into()))
        }
        Err(why) => Err(why),
    }
}

/// What a goal asks for.
impl Context {
    fn direct(&self, goal: &Goal) -> Result<Direct, Why> {
        let mut reader = Reader::new(self);
        let because = match &goal.proposition {
            Proposition::Equal(left, right) => {
                Because::Same(self.same(reader.read(left)?, reader.read(right)?)?)
            }
            Proposition::Sign(relation, of) => match (relation, rounded_difference(of)) {
                (Relation::NonNegative, Some((a, b))) => {
                    reader.defined(of)?;
                    Because::Order(order::at_least(&mut reader, a, b)?)
                }
                _ => {
                    let value = reader.read(of)?;
                    Because::Sign(reader.of_sign(value, (*relation).into())?)
                }
            },
            Proposition::Within(of, bound) => {
                let (of, bound) = (reader.read(of)?, reader.read(bound)?);
                let [above, below] = self.reduce(&bound).both_sides(&self.reduce(&of));
                let not_negative = |value| reader.of_sign(value, Sign::NonNegative);
                Because::Within([not_negative(above)?, not_negative(below)?].into())
            }
            Proposition::Derivative(of, by, is) => {
                let Dual { derivative, .. } =
                    of.derivative(by, &|name| Tree::symbol(name), &tree::smooth).ok_or(Why::Kink)?;
                reader.read(of)?;
                Because::Derivative(self.same(reader.read(&derivative)?, reader.read(is)?)?)
            }
            Proposition::Limit(of, by, to) => {
                let x = Symbol::Own(by);
                let (of, to) = (self.reduce(&reader.read(of)?), self.reduce(&reader.read(to)?));
                self.limit(of, x, to)?
            }
        };
        let Reader { divisors, brackets, errors, .. } = reader;
        Ok(Direct { supposed: self.supposed.clone(), errors, divisors, brackets, because })
    }

    /// Two quotients are equal: what they are.
    fn same(&self, left: Ratio, right: Ratio) -> Result<Ratio, Why> {
        let difference = self.reduce(&(left - &right));
        if difference.is_zero() { Ok(self.reduce(&right)) } else { Err(Why::Different(difference)) }
    }

    /// The terms without an e^… that falls as x grows. None if there is an e^… of which that is not seen.
    ///
    /// An exponent n/d of polynomials whose degree in x is higher above than below, and whose leading
    /// coefficients have opposite signs, tends to −∞ at least as fast as −x does, up to a factor; and e^{−a
    /// x} times any power of x vanishes for a > 0.
    fn without_falling_exponentials(&self, num: &Poly, x: Symbol) -> Option<Poly> {
        let moves = |e: &Ratio| e.symbols().contains(&x);
        for e in num.exponents().filter(|e| moves(e)) {
            let leading = |p: &Poly| Some(sign(&p.leading_coefficient(x), &self.known)?.sign());
            let falls = leading(e.num())?.times(leading(e.den())?) == Sign::Negative;
            if !e.is_of_polynomials() || !falls || e.num().degree(x) <= e.den().degree(x) {
                return None;
            }
        }
        let rest = num.terms().filter(|(m, _)| !m.exponent().is_some_and(moves));
        Some(rest.map(|(m, q)| (m.clone(), q.clone())).collect())
    }

    /// The symbol that tends to infinity with x, if what is assumed of x holds for every x that is large
    /// enough: that it is positive, or that an increasing linear function of it is. That is the slack which
    /// x is replaced by.
    fn tends_to_infinity(&self, x: Symbol) -> Option<Symbol> {
        let mut variables = vec![x];
        for supposed in &self.supposed {
            let last = *variables.last()?;
            let named = supposed.given.as_ref().is_some_and(|given| given.value.symbols().contains(x.name()));
            if !named && !supposed.value.symbols().iter().any(|symbol| variables.contains(symbol)) {
                continue;
            }
            match &supposed.used {
                _ if supposed.given.is_none() => return None,
                Used::Follows => {}
                Used::Kept | Used::Unused if self.increases_linearly(&supposed.value, last) => {}
                Used::Symbol(symbol) if *symbol == last => {}
                Used::Pivot(pivot, by, Some(slack)) if *pivot == Monomial::of(last) => {
                    variables.push(self.increases_linearly(by, *slack).then_some(*slack)?);
                }
                _ => return None,
            }
        }
        variables.pop()
    }

    /// Returns `true` if a quotient is a linear function of `x` whose slope is positive.
    fn increases_linearly(&self, of: &Ratio, x: Symbol) -> bool {
        let Some([constant, slope]) = of.num().coefficients(x) else { return false };
        let depends = [&constant, &slope, of.den()].into_iter().any(|part| part.symbols().contains(&x));
        let sign = |part: &Poly| sign(part, &self.known).map(|certificate| certificate.sign());
        !depends && sign(&slope).zip(sign(of.den())).is_some_and(|(a, b)| a.times(b) == Sign::Positive)
    }

    /// The limit for x → ∞ by the degrees in x: a quotient of polynomials tends to 0 if the degree is
    /// higher below, and to the quotient of the leading coefficients if the degrees are equal.
    fn limit(&self, of: Ratio, x: Symbol, to: Ratio) -> Result<Because, Why> {
        let none = || Why::NoLimit(of.clone());
        let x = self.tends_to_infinity(x).ok_or_else(none)?;
        let num = self.without_falling_exponentials(of.num(), x).ok_or_else(none)?;
        if of.den().has_exponentials() {
            return Err(none());
        }
        let degrees = (num.degree(x), of.den().degree(x));
        let [top, bottom] = [&num, of.den()].map(|part| part.leading_coefficient(x));
        let leading = sign(&bottom, &self.known).filter(|c| c.sign().is_strict()).ok_or_else(none)?;
        let found = match degrees.0.cmp(&degrees.1) {
            Ordering::Less => Ratio::zero(),
            Ordering::Equal => Ratio::from(top).over(&bottom.into()).ok_or_else(none)?,
            Ordering::Greater => return Err(none()),
        };
        let to = self.same(found, to)?;
        Ok(Because::Limit { of, by: x, degrees, leading, to })
    }
}

/// a and b, if this is a − b, and both are rounded.
fn rounded_difference(of: &Tree) -> Option<(&Tree, &Tree)> {
    let Step::Sub(a, b) = of.step() else { return None };
    [a, b].into_iter().all(|tree| matches!(tree.step(), Step::Rounded(_))).then_some((a, b))
}

#[cfg(test)]
mod tests;

//! The kernel: [`prove`] returns a [`Proof`] of a [`Statement`], or a [`ProofError`] if it finds none.
//!
//! A formula is translated, operation by operation, into a quotient of polynomials ([`algebra`]). A division
//! requires a proof that its divisor is not 0; a positive part ⟨x⟩ or a minimum requires the sign of the
//! quantity that decides between its two branches. If that sign is undecided, the kernel distinguishes two
//! cases, positive and not positive, and proves both; a divisor of undecided sign ends the attempt. For an
//! absolute value |x| = −min(−x, x) no cases are needed: with s = |x| there is a t between −1 and 1 such that
//! x = t s, and this equation is used like that of a hypothesis.
//!
//! A hypothesis v > 0 that does not follow from others, and is more than the sign of a symbol, becomes v =
//! s for a new symbol s > 0: one monomial of v, the *pivot*, is replaced wherever it occurs by the value
//! that this equation gives it. (For a b − c (x − y) > 0: a b by s + c (x − y); or x by
//! (a b + c y − s)/c, where c ≠ 0 is known.) Equals are replaced by equals, so a proposition proved for all
//! values of the remaining symbols, with s > 0, holds in particular for those that satisfy the hypothesis.
//! The choice of the monomial affects success, not soundness. Where no pivot is found, v may be divided by a
//! positive symbol: for k > 0, the hypothesis 1 − k > 0 is (1 − k)/k = s > 0, and k is 1/(1 + s).
//!
//! | goal | rule |
//! |---|---|
//! | a = b | a − b is the zero polynomial over some denominator |
//! | a > 0, a ≥ 0, a = 0 | the sign of its numerator and of its denominator ([`sign`]) |
//! | da/dx = b | dual numbers differentiate a by the sum, product and quotient rules; then as a = b |
//! | \|a\| ≤ b | the signs of b − a and b + a |
//! | lim a = b for x → ∞ | degrees in x; e^… with an exponent that tends to −∞ vanishes against any power |
//!
//! A quantity assumed to lie in an interval is replaced by the midpoint plus t times half the length, for
//! some −1 ≤ t ≤ 1.
//!
//! A hypothesis h > 0 without a pivot is retained unchanged, and so is the known sign of a symbol that is
//! replaced by its position in an interval. Where no rule finds the sign of v, the rules may find those of m
//! and of v − m h, for a quotient m that makes a symbol cancel: if both terms of v = m h + (v − m h) have a
//! sign, so does v.
//!
//! **Rounding.** fl(x), the nearest number of p bits, is x (1 + γ e) for some −1 ≤ e ≤ 1, where γ =
//! 1/(2ᵖ + 1), in the absence of overflow and underflow. *Proof.* Let 2ᵏ ≤ |x| < 2ᵏ⁺¹. Then |fl(x) − x| is
//! at most 2ᵏ/2ᵖ, and, since 2ᵏ itself has p bits, at most |x| − 2ᵏ. Adding the second bound to 2ᵖ times the
//! first gives (2ᵖ + 1) |fl(x) − x| ≤ 2ᵏ + |x| − 2ᵏ = |x|. □ The kernel translates fl(x) in this way, with a
//! separate e for each rounded formula. Two formulas that it recognises as equal up to a power of two share
//! their e, because a change of units leaves the digits as they are. Rounding is monotone: fl(a) ≥ fl(b) if,
//! operation by operation, no operand in a is less than its counterpart in b ([`order`]). Rounding is not
//! continuous, so limits and derivatives of rounded formulas are not proved.
//!
//! New symbols do not occur in the statement ([`Symbol`]). The symbols of an induction, its members and the
//! power q, must not occur in anything that is the same at each of its steps; `check_names` ensures this.
//!
//! An assumption about the variable of a limit must hold for all sufficiently large values: it states that
//! the variable, or an increasing linear function of it, is positive. That function then becomes the
//! variable.

pub(super) mod algebra;
pub(super) mod context;
pub(super) mod derivation;
pub(super) mod effort;
mod monomial;
mod number;
mod order;
pub(super) mod sign;
pub(super) mod translator;

pub use derivation::{
    Assumption, AssumptionUse, Derivation, Direct, Justification, Multiple, Proof, ProofError, Rounding,
    SignedRatio,
};

use self::algebra::{Monomial, Poly, Ratio, Symbol};
use self::context::{Context, sign};
pub use self::effort::MAX_EFFORT;
use self::sign::Sign;
use self::translator::Translator;
use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Goal, Proposition, Sequence, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{self, Op};
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

/// Maximum number of operations, quantities and numbers in all formulas of a statement.
pub const MAX_SIZE: u32 = 20_000;

/// Maximum depth of a formula in a statement.
pub const MAX_DEPTH: u32 = 500;

/// Maximum number of rounded formulas in a statement.
pub const MAX_ROUNDINGS: usize = 64;

/// Proves a statement.
///
/// # Errors
/// Returns the reason if no proof is found, which does not refute the statement; returns
/// [`ProofError::TooLarge`] if the statement exceeds [`MAX_SIZE`] or [`MAX_DEPTH`], or the proof exceeds
/// [`MAX_EFFORT`].
pub fn prove(statement: &Statement) -> Result<Proof, ProofError> {
    let roundings = check_premises(statement)?;
    let search = || search(statement, roundings);
    effort::bounded(search).unwrap_or(Err(ProofError::TooLarge("its proof", MAX_EFFORT)))
}

/// Checks the premises of a proof, and returns the rounded formulas: the statement has goals, is not too
/// large, and uses no reserved name, and no limit or derivative in it is one of a rounded or computed quantity.
///
/// # Errors
/// Returns the premise that does not hold.
pub(in crate::proof) fn check_premises(statement: &Statement) -> Result<Vec<Tree>, ProofError> {
    check_size(statement.trees())?;
    if statement.goals().is_empty() {
        return Err(ProofError::NoGoals);
    }
    check_names(statement)?;
    let roundings = roundings(statement.trees());
    if roundings.len() > MAX_ROUNDINGS {
        return Err(ProofError::TooManyRoundings);
    }
    // A computed quantity varies with its operands, which its symbol does not show.
    if (!roundings.is_empty() || !statement.computed().is_empty()) && has_continuous_variable(statement) {
        return Err(ProofError::Discontinuous);
    }
    Ok(roundings)
}

/// Derives a proposition from hypotheses in cases only, without making a [`Proof`].
///
/// # Errors
/// Returns the reason if no derivation is found; see [`prove`].
pub(super) fn derivation(
    hypotheses: &[&Hypothesis],
    proposition: &Proposition,
) -> Result<Derivation, ProofError> {
    let trees = || hypotheses.iter().map(|hypothesis| &hypothesis.value).chain(proposition.trees());
    check_size(trees())?;
    let roundings = roundings(trees());
    if roundings.len() > MAX_ROUNDINGS {
        return Err(ProofError::TooManyRoundings);
    }
    if !roundings.is_empty() && proposition.variable().is_some() {
        return Err(ProofError::Discontinuous);
    }
    let search = || {
        let context = Context::of(roundings).with_variable(proposition).with_cases_only();
        derive(&Goal::of_claim("", proposition.clone()), context, hypotheses, MAX_NESTED_CASES)
    };
    effort::bounded(search).unwrap_or(Err(ProofError::TooLarge("its proof", MAX_EFFORT)))
}

/// Checks the size and depth of formulas.
///
/// # Errors
/// Returns [`ProofError::TooLarge`] if the formulas exceed [`MAX_SIZE`] or [`MAX_DEPTH`].
pub(super) fn check_size<'t>(trees: impl Iterator<Item = &'t Tree> + Clone) -> Result<(), ProofError> {
    let deepest = trees.clone().map(Tree::depth).max().unwrap_or(0);
    if deepest > MAX_DEPTH {
        return Err(ProofError::TooLarge("its depth", MAX_DEPTH as usize));
    }
    let size = trees.fold(0, |sum: u32, tree| sum.saturating_add(tree.size()));
    if size > MAX_SIZE {
        return Err(ProofError::TooLarge("its size", MAX_SIZE as usize));
    }
    Ok(())
}

fn search(statement: &Statement, roundings: Vec<Tree>) -> Result<Proof, ProofError> {
    let context = Context::of(roundings);
    let goals = statement.goals().iter().map(|goal| {
        let hypotheses = statement.hypotheses_for(goal.role);
        derive(goal, context.clone().with_variable(&goal.proposition), &hypotheses, MAX_NESTED_CASES)
    });
    Ok(Proof { goals: goals.collect::<Result<_, _>>()?, statement: statement.clone() })
}

/// Rejects a statement that uses a reserved name.
///
/// - Names of symbols of a proof do not occur. A name of a member of a sequence occurs only for the first
///   member, and only in a perturbed recursion.
/// - A computed symbol has no other meaning. Its value may differ at each step, so its interval is the only
///   assumption about it, and it is computed neither from itself nor from a symbol that is computed later.
/// - The start, ratio and limit of a sequence do not depend on the power, on members or on computed symbols;
///   its step and the hypotheses of its limit do not depend on the power; its closed form and the bound of
///   its distance from that do not depend on members or computed symbols; the bounds of other quantities do
///   not depend on members.
fn check_names<'t>(statement: &'t Statement) -> Result<(), ProofError> {
    fn refuse<'t>(
        trees: impl Iterator<Item = &'t Tree>,
        is_refused: impl Fn(&'static str) -> bool,
    ) -> Result<(), ProofError> {
        let mut symbols = trees.flat_map(Tree::symbols);
        symbols.find(|name| is_refused(name)).map_or(Ok(()), |name| Err(ProofError::ReservedName(name)))
    }
    let is_member = |name| name == MEMBERS[0];
    let is_perturbed = statement.conclusion().is_some_and(|sequence| sequence.is_perturbed());
    let is_reserved = |name| {
        let is_allowed = is_perturbed && is_member(name);
        Symbol::is_reserved(name) || (MEMBERS.contains(&name) && !is_allowed)
    };
    refuse(statement.trees(), is_reserved)?;
    let mut variables = statement.goals().iter().filter_map(|goal| goal.proposition.variable());
    variables.find(|name| is_reserved(name)).map_or(Ok(()), |name| Err(ProofError::ReservedName(name)))?;

    let computed = statement.computed();
    let is_computed_from = |i: usize, name| computed[i..].iter().any(|computed| computed.symbol == name);
    let is_computed = |name| is_computed_from(0, name);
    let mut predefined = [POWER, PRECISION].into_iter().chain(MEMBERS).chain(SCALES);
    predefined.find(|name| is_computed(*name)).map_or(Ok(()), |name| Err(ProofError::ReservedName(name)))?;

    let values = |all: &'t [Hypothesis]| all.iter().map(|hypothesis| &hypothesis.value);
    let hypotheses = values(statement.hypotheses());
    if let Some(Sequence { start, step, ratio, limit, member, within }) = statement.conclusion() {
        refuse(start.iter().chain([ratio]).chain(limit), |name| {
            name == POWER || MEMBERS.contains(&name) || is_computed(name)
        })?;
        refuse(step.iter(), |name| name == POWER)?;
        // An assumption about one power need not hold as the power tends to 0.
        refuse(hypotheses.clone().filter(|_| limit.is_some()), |name| name == POWER)?;
        let bounds = || within.iter().map(|(_, bound)| bound);
        refuse(member.iter().chain(bounds().take(1)), |name| is_member(name) || is_computed(name))?;
        refuse(bounds(), is_member)?;
    }
    let rename = |error| match error {
        ProofError::ReservedName(name) => ProofError::HypothesisOnComputed(name),
        error => error,
    };
    refuse(hypotheses.chain(values(statement.invariants())), is_computed).map_err(rename)?;
    computed.iter().enumerate().try_for_each(|(i, computed)| {
        refuse(iter::once(&computed.formula), |name| is_computed_from(i, name)).map_err(rename)
    })
}

/// Returns `true` if a statement has a limit, or a derivative with respect to a symbol.
fn has_continuous_variable(statement: &Statement) -> bool {
    let has_limit = statement.conclusion().is_some_and(|sequence| sequence.limit.is_some());
    has_limit || statement.goals().iter().any(|goal| goal.proposition.variable().is_some())
}

/// Returns the rounded formulas, each after those inside it; their errors are numbered in this order.
pub(super) fn roundings<'t>(trees: impl Iterator<Item = &'t Tree>) -> Vec<Tree> {
    fn collect(tree: &Tree, all: &mut Vec<Tree>) {
        tree.op().operands().for_each(|operand| collect(operand, all));
        // One more than the maximum suffices to detect that there are too many.
        if let Op::Rounded(of) = tree.op()
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

/// Maximum number of nested case distinctions.
pub(in crate::proof) const MAX_NESTED_CASES: u32 = 4;

/// Derives a goal from the assumptions of a context and further hypotheses. Where the sign of x in |x| is
/// undecided, replaces x by t |x|; where this does not suffice or another branch is undecided, derives the goal
/// in both cases.
fn derive(
    goal: &Goal,
    mut context: Context,
    mut hypotheses: &[&Hypothesis],
    cases: u32,
) -> Result<Derivation, ProofError> {
    let undecided = match context.assume_and_derive(goal, &mut hypotheses) {
        Ok(direct) => return Ok(Derivation::Direct(direct.into())),
        Err(ProofError::UndecidedSize(of, twice)) => {
            let mut sized = context.clone();
            if sized.assume_size(&of, &twice)
                && let Ok(derivation) = derive(goal, sized, hypotheses, cases)
            {
                return Ok(derivation);
            }
            twice
        }
        Err(ProofError::UndecidedBranch(value)) => value,
        Err(reason) => return Err(reason),
    };
    if cases == 0 {
        return Err(ProofError::UndecidedBranch(undecided));
    }
    let deciding = context.sign_numerator(&undecided);
    let case = |sign| {
        let mut context = context.clone();
        context.assume_sign(None, deciding.clone().into(), sign);
        derive(goal, context, hypotheses, cases - 1)
    };
    let (positive, non_positive) = (case(Sign::Positive)?, case(Sign::NonPositive)?);
    Ok(Derivation::Cases(deciding, positive.into(), non_positive.into()))
}

/// Derivations without case distinctions.
impl Context {
    /// Uses hypotheses, and derives a goal without cases. Removes the hypotheses that are used, also if this fails.
    pub(in crate::proof) fn assume_and_derive(
        &mut self,
        goal: &Goal,
        hypotheses: &mut &[&Hypothesis],
    ) -> Result<Direct, ProofError> {
        while let [next, rest @ ..] = *hypotheses {
            self.assume(next)?;
            *hypotheses = rest;
        }
        self.derive_directly(goal)
    }

    fn derive_directly(&self, goal: &Goal) -> Result<Direct, ProofError> {
        let mut reader = Translator::new(self);
        let because = match &goal.proposition {
            Proposition::Equal(left, right) => {
                Justification::Equal(self.check_equal(reader.translate(left)?, reader.translate(right)?)?)
            }
            Proposition::Sign(relation, of) => match (relation, rounded_difference(of)) {
                (Relation::NonNegative, Some((a, b))) => {
                    reader.check_defined(of)?;
                    Justification::Order(order::at_least(&mut reader, a, b)?)
                }
                _ => {
                    let value = reader.translate(of)?;
                    Justification::Sign(reader.require_sign(value, (*relation).into())?)
                }
            },
            Proposition::Within(of, bound) => {
                // The bound comes first: it is shorter, and its branches may have to be distinguished.
                let (bound, of) = (reader.translate(bound)?, reader.translate(of)?);
                let [above, below] = self.reduce(&bound).difference_and_sum(&self.reduce(&of));
                let not_negative = |value| reader.require_sign(value, Sign::NonNegative);
                Justification::Within([not_negative(above)?, not_negative(below)?].into())
            }
            Proposition::Derivative(of, by, is) => {
                let Dual { derivative, .. } = of
                    .derivative(by, &|name| Tree::symbol(name), &tree::smooth_ops)
                    .ok_or(ProofError::NotDifferentiable)?;
                reader.translate(of)?;
                Justification::Derivative(
                    self.check_equal(reader.translate(&derivative)?, reader.translate(is)?)?,
                )
            }
            Proposition::Limit(of, by, to) => {
                let x = Symbol::Own(by);
                let (of, to) = (self.reduce(&reader.translate(of)?), self.reduce(&reader.translate(to)?));
                self.limit(of, x, to)?
            }
        };
        let Translator { divisors, branches: brackets, errors, .. } = reader;
        Ok(Direct {
            assumptions: self.assumptions.clone(),
            roundings: errors,
            divisors,
            branches: brackets,
            justification: because,
        })
    }

    /// Returns the common value of two quotients if they are equal.
    fn check_equal(&self, left: Ratio, right: Ratio) -> Result<Ratio, ProofError> {
        let difference = self.reduce(&(left - &right));
        if difference.is_zero() { Ok(self.reduce(&right)) } else { Err(ProofError::Unequal(difference)) }
    }

    /// Returns the polynomial without its terms in which an e^… tends to 0 as x grows; `None` if an e^… is
    /// not recognised to do so.
    ///
    /// An exponent n/d of polynomials tends to −∞ at least as fast as −a x for some a > 0 if the degree of n
    /// in x is the higher one and the leading coefficients have opposite signs; and e^{−a x} times any power
    /// of x vanishes.
    fn without_vanishing_exponentials(&self, num: &Poly, x: Symbol) -> Option<Poly> {
        let depends_on_x = |e: &Ratio| e.symbols().contains(&x);
        for e in num.exponents().filter(|e| depends_on_x(e)) {
            let leading = |p: &Poly| Some(sign(&p.leading_coefficient(x), &self.signs)?.sign());
            let is_decreasing = leading(e.num())?.times(leading(e.den())?) == Sign::Negative;
            if !e.is_rational_function() || !is_decreasing || e.num().degree(x) <= e.den().degree(x) {
                return None;
            }
        }
        let rest = num.terms().filter(|(m, _)| !m.exponent().is_some_and(depends_on_x));
        Some(rest.map(|(m, q)| (m.clone(), q.clone())).collect())
    }

    /// Returns the symbol that tends to infinity with x, if the assumptions about x hold for every
    /// sufficiently large x, that is, if each states that x, or an increasing linear function of x, is
    /// positive. The symbol is x or the slack variable that replaces it.
    fn limit_variable(&self, x: Symbol) -> Option<Symbol> {
        let mut variables = vec![x];
        for supposed in &self.assumptions {
            let last = *variables.last()?;
            let mentions_x =
                supposed.hypothesis.as_ref().is_some_and(|given| given.value.symbols().contains(x.name()));
            if !mentions_x && !supposed.value.symbols().iter().any(|symbol| variables.contains(symbol)) {
                continue;
            }
            match &supposed.usage {
                _ if supposed.hypothesis.is_none() => return None,
                AssumptionUse::Implied => {}
                AssumptionUse::Retained if self.increases_linearly(&supposed.value, last) => {}
                AssumptionUse::Symbol(symbol) if *symbol == last => {}
                AssumptionUse::Pivot(pivot, by, Some(slack)) if *pivot == Monomial::of(last) => {
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
        let sign = |part: &Poly| sign(part, &self.signs).map(|certificate| certificate.sign());
        !depends && sign(&slope).zip(sign(of.den())).is_some_and(|(a, b)| a.times(b) == Sign::Positive)
    }

    /// Derives the limit for x → ∞ from the degrees in x: a quotient of polynomials tends to 0 if the
    /// denominator has the higher degree, and to the quotient of the leading coefficients if the degrees are
    /// equal.
    fn limit(&self, of: Ratio, x: Symbol, to: Ratio) -> Result<Justification, ProofError> {
        let no_limit = || ProofError::UnknownLimit(of.clone());
        let x = self.limit_variable(x).ok_or_else(no_limit)?;
        let num = self.without_vanishing_exponentials(of.num(), x).ok_or_else(no_limit)?;
        if of.den().has_exponentials() {
            return Err(no_limit());
        }
        let degrees = (num.degree(x), of.den().degree(x));
        let [top, bottom] = [&num, of.den()].map(|part| part.leading_coefficient(x));
        let leading = sign(&bottom, &self.signs).filter(|c| c.sign().is_strict()).ok_or_else(no_limit)?;
        let found = match degrees.0.cmp(&degrees.1) {
            Ordering::Less => Ratio::zero(),
            Ordering::Equal => Ratio::from(top).over(&bottom.into()).ok_or_else(no_limit)?,
            Ordering::Greater => return Err(no_limit()),
        };
        let to = self.check_equal(found, to)?;
        Ok(Justification::Limit { of, by: x, degrees, leading, to })
    }
}

/// Returns the operands of a difference if both are rounded.
pub(in crate::proof) fn rounded_difference(of: &Tree) -> Option<(&Tree, &Tree)> {
    let Op::Sub(a, b) = of.op() else { return None };
    [a, b].into_iter().all(|tree| matches!(tree.op(), Op::Rounded(_))).then_some((a, b))
}

#[cfg(test)]
mod tests;

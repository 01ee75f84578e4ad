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
//! matters for success and not for soundness.
//!
//! | to prove | the rule |
//! |---|---|
//! | a = b | a − b is the zero polynomial over some denominator |
//! | a > 0, a ≥ 0, a = 0 | the sign of its numerator and of its denominator ([`sign`](mod@sign)) |
//! | da/dx = b | dual numbers differentiate a by the sum, product and quotient rules; then as a = b |
//! | \|a\| ≤ b | the signs of b − a and b + a |
//! | lim a = b for x → ∞ | degrees in x; e^… with an exponent that tends to −∞ vanishes against any power |
//!
//! A quantity that is supposed to be in an interval is, for some −1 ≤ t ≤ 1, its middle and t times half of its
//! length; so it is replaced.
//!
//! **Rounding.** fl(x), the number of p bits nearest to x, is x (N + e)/N for some −1 ≤ e ≤ 1, where N = 2ᵖ + 1;
//! nothing is said about over- and underflow. For let 2ᵏ ≤ |x| < 2ᵏ⁺¹. Then |fl(x) − x| is at most 2ᵏ/2ᵖ, and
//! since 2ᵏ itself has p bits, at most |x| − 2ᵏ: so N |fl(x) − x| ≤ 2ᵖ 2ᵏ/2ᵖ + |x| − 2ᵏ = |x|. So the kernel reads it, with an e of its own for each formula that is rounded. Two of
//! which it sees that they are equal, up to powers of two, have the same e. Rounding keeps order: a − b is not
//! negative if, step by step, nothing in a is less than what stands in its place in b ([`order`]).
//!
//! The names of the new symbols, and of the members of an induction, must not occur in a statement otherwise:
//! `kept` sees to it.
//!
//! No hypothesis of a limit may speak of x, but to say that it is positive: it has to stay true as x grows.

pub(super) mod algebra;
mod derivation;
mod order;
pub(super) mod sign;

pub use derivation::{Because, Derivation, Direct, Proof, Rounding, Signed, Supposed, Used, Why};

use self::algebra::{Monomial, Poly, Ratio, Symbol};
use self::sign::{ERRORS, Known, PLACES, Sign, is_small, sign};
use crate::formula::claim::{MEMBERS, POWER, PRECISION, SCALES};
use crate::formula::statement::{Goal, Role, Says, Sequence, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{self, Step};
use crate::number::{Dual, Tree};
use std::cmp::Ordering;

impl From<Relation> for Sign {
    fn from(relation: Relation) -> Self {
        match relation {
            Relation::Positive => Sign::Positive,
            Relation::NonNegative => Sign::NonNegative,
            Relation::Zero => Sign::Zero,
        }
    }
}

/// Proves a statement.
///
/// # Errors
/// Why it could not; that is no proof of the contrary.
pub fn prove(statement: &Statement) -> Result<Proof, Why> {
    if statement.goals.is_empty() {
        return Err(Why::Nothing);
    }
    if let Some(name) = kept(statement) {
        return Err(Why::Reserved(name));
    }
    let roundings = roundings(statement);
    if roundings.len() > ERRORS.len() {
        return Err(Why::TooMany);
    }
    let context = Context::of(roundings);
    let goals = statement.goals.iter().map(|goal| {
        let computed = statement.computed.iter().map(|computed| &computed.hypothesis);
        let (given, invariants) = (statement.hypotheses.iter(), &statement.invariants);
        let hypotheses: Vec<_> = match goal.role {
            Role::Claim => given.chain(computed).collect(),
            Role::Begins => given.collect(),
            Role::Computed => given.chain(invariants).collect(),
            Role::Step | Role::Continues => given.chain(invariants).chain(computed).collect(),
        };
        derive(goal, context.clone(), &hypotheses, CASES)
    });
    Ok(Proof { goals: goals.collect::<Result<_, _>>()?, statement: statement.clone() })
}

/// A name in a statement that is not its to use: one that the kernel has for the quantity of a hypothesis,
/// or an induction for its members; and what a sequence starts from, is multiplied by or tends to depends on
/// no power.
fn kept(statement: &Statement) -> Option<&'static str> {
    let variables = statement.goals.iter().filter_map(|goal| goal.says.variable());
    let symbols = statement.trees().flat_map(Tree::symbols).chain(variables);
    // Of a sequence that is only near a closed form, the member is spoken of.
    let drifts = statement.amounts_to.as_ref().is_some_and(|sequence| !sequence.within.is_empty());
    let member = |name: &&str| MEMBERS.contains(name) && !(drifts && *name == MEMBERS[0]);
    let own = |name: &&'static str| NAMES.contains(name) || is_small(Symbol(name)) || member(name);
    symbols.into_iter().find(own).or_else(|| {
        let Sequence { start, ratio, limit, member, within, .. } = statement.amounts_to.as_ref()?;
        let fixed = start.iter().chain([ratio]).chain(limit).flat_map(Tree::symbols);
        let bounds = within.iter().map(|(_, bound)| bound);
        let of_member =
            member.iter().chain(bounds).flat_map(Tree::symbols).filter(|name| *name == MEMBERS[0]);
        fixed.filter(|name| *name == POWER || MEMBERS.contains(name)).chain(of_member).next()
    })
}

/// All that is rounded in a statement, each after what is rounded in it.
fn roundings(statement: &Statement) -> Vec<Tree> {
    fn collect(tree: &Tree, all: &mut Vec<Tree>) {
        tree.step().operands().for_each(|operand| collect(operand, all));
        if let Step::Rounded(of) = tree.step()
            && !all.contains(of)
        {
            all.push(of.clone());
        }
    }
    let mut all = Vec::new();
    statement.trees().for_each(|tree| collect(tree, &mut all));
    all
}

/// How many splits may be nested.
const CASES: u32 = 4;

/// A goal, under what is supposed and under hypotheses that are still to be taken in. Where a bracket is open,
/// in both cases.
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

/// Names for the quantities of hypotheses, which no claim may use.
const NAMES: [&str; 12] = ["s₁", "s₂", "s₃", "s₄", "s₅", "s₆", "s₇", "s₈", "s₉", "s₁₀", "s₁₁", "s₁₂"];

/// What is supposed, ready for use.
#[derive(Clone, Debug)]
struct Context {
    supposed: Vec<Supposed>,
    known: Known,
    rules: Vec<(Monomial, Ratio)>,
    /// What is rounded: with the errors of the same place.
    roundings: Vec<Tree>,
    /// What has been rounded in hypotheses, with its error.
    errors: Vec<Rounding>,
}

impl Context {
    /// Nothing yet, but that powers of two are positive.
    fn of(roundings: Vec<Tree>) -> Self {
        let known = SCALES.into_iter().map(|name| (Symbol(name), Sign::Positive)).collect();
        let (supposed, rules, errors) = Default::default();
        Context { supposed, known, rules, roundings, errors }
    }

    /// Takes in a hypothesis.
    fn take_in(&mut self, hypothesis: &Hypothesis) -> Result<(), Why> {
        let mut reader = Reader::new(self);
        if let Some((x, lower, upper)) = hypothesis.interval() {
            let [lower, upper] = [reader.read(lower)?, reader.read(upper)?];
            self.errors = reader.errors;
            self.suppose_between(hypothesis, Symbol(x), &lower, &upper);
        } else {
            let value = reader.read(&hypothesis.value)?;
            self.errors = reader.errors;
            self.suppose(Some(hypothesis), value, hypothesis.relation.into());
        }
        Ok(())
    }

    /// What has the sign of a quotient whose denominator is positive: its numerator, without the factors N + e,
    /// which are positive too.
    fn deciding(&self, value: &Ratio) -> Poly {
        let errors = value.num().symbols().into_iter().filter(|x| ERRORS.contains(&x.0));
        let largest = self.largest();
        errors.fold(value.num().clone(), |rest, error| {
            let nearest = &largest + Ratio::from(Poly::symbol(error));
            rest.over(nearest.num()).filter(|_| *nearest.den() == *largest.den()).unwrap_or(rest)
        })
    }

    fn rounds(&self) -> bool {
        !self.roundings.is_empty()
    }

    /// N
    fn largest(&self) -> Ratio {
        self.reduce(&Ratio::from(Poly::symbol(Symbol(PRECISION)) + Poly::constant(1)))
    }

    /// With every pivot replaced, until there is none left; equal in value to what is given.
    fn reduce(&self, value: &Ratio) -> Ratio {
        let mut value = value.clone();
        // Pivots could bring each other back for ever; then the value just stays unreduced.
        for _ in 0..2 * self.rules.len() {
            let before = value.clone();
            for (pivot, by) in &self.rules {
                value = value.replace(pivot, by);
            }
            if value == before {
                break;
            }
        }
        value
    }

    /// The sign of a reduced quotient, if the rules find that of numerator and denominator.
    fn sign(&self, value: Ratio) -> Option<Signed> {
        let (num, den) = (sign(value.num(), &self.known)?, sign(value.den(), &self.known)?);
        den.sign().is_strict().then_some(Signed { value, num, den })
    }

    /// Takes in that a quantity has a sign.
    fn suppose(&mut self, given: Option<&Hypothesis>, value: Ratio, sign: Sign) {
        let value = self.reduce(&value);
        let used = match sign {
            _ if self.sign(value.clone()).is_some_and(|signed| signed.sign().implies(sign)) => Used::Follows,
            Sign::Negative | Sign::NonPositive => {
                return self.suppose(given, -value, sign.negated());
            }
            Sign::Positive | Sign::NonNegative => {
                if let Some(symbol) = as_symbol(&value) {
                    self.known.insert(symbol, sign);
                    Used::Symbol(symbol)
                } else {
                    let new = self.supposed.iter().filter(|s| matches!(s.used, Used::Pivot(..))).count();
                    let name = NAMES.get(new).copied().map(Symbol);
                    match name
                        .and_then(|name| Some((name, self.pivot(given, &value, &Poly::symbol(name), sign)?)))
                    {
                        None => Used::Unused,
                        Some((name, (pivot, by))) => {
                            self.known.insert(name, sign);
                            Used::Pivot(pivot, by, Some(name))
                        }
                    }
                }
            }
            Sign::Zero => self
                .pivot(given, &value, &Poly::zero(), sign)
                .map_or(Used::Unused, |(pivot, by)| Used::Pivot(pivot, by, None)),
        };
        if let Used::Pivot(pivot, by, _) = &used {
            self.replace(pivot.clone(), by.clone());
        }
        self.supposed.push(Supposed { given: given.cloned(), value, sign, used });
    }

    /// Takes in that a symbol is in an interval: for some t between −1 and 1 it is its middle and t times half
    /// of its length.
    fn suppose_between(&mut self, given: &Hypothesis, x: Symbol, lower: &Ratio, upper: &Ratio) {
        let half = Ratio::from(Poly::constant((1, 2)));
        let [middle, reach] = [upper + lower, upper - lower].map(|sum| self.reduce(&(sum * &half)));
        let own = Ratio::from(Poly::symbol(x));
        let open = self.reduce(&own) == own;
        let named = self.supposed.iter().filter(|s| matches!(s.used, Used::Between(..))).count();
        let used = match PLACES.get(named).copied().map(Symbol) {
            Some(place) if open && !middle.symbols().contains(&x) && !reach.symbols().contains(&x) => {
                let by = &middle + reach * Ratio::from(Poly::symbol(place));
                self.replace(Monomial::of(x), by.clone());
                Used::Between(x, by, place)
            }
            _ => Used::Unused,
        };
        let sign = Sign::NonNegative;
        self.supposed.push(Supposed { given: Some(given.clone()), value: own - middle, sign, used });
    }

    /// From now on a monomial is replaced.
    fn replace(&mut self, pivot: Monomial, by: Ratio) {
        for (_, older) in &mut self.rules {
            *older = older.replace(&pivot, &by);
        }
        self.rules.push((pivot, by));
    }

    /// A monomial of the quantity, and what it equals if the quantity is `slack`.
    ///
    /// Best a symbol of which nothing is known and that stands alone or times what is not 0, so that it
    /// disappears for good; else a product of symbols of which little is known, so that little is forgotten;
    /// else a symbol whose sign is then seen again: with b = a + s for b − a > 0 that of b is.
    ///
    /// Where there are errors in it, the symbol that the hypothesis is solved for comes first, and products
    /// last: they would be forgotten for something long.
    fn pivot(
        &self,
        given: Option<&Hypothesis>,
        value: &Ratio,
        slack: &Poly,
        sign_of_slack: Sign,
    ) -> Option<(Monomial, Ratio)> {
        // num − slack · den = 0, and den is not 0.
        let equation = value.num() - slack * value.den();
        let solved = |x: Symbol| {
            let [rest, coefficient] = <[Poly; 2]>::try_from(equation.coefficients(x)).ok()?;
            let (strict, length) =
                (sign(&coefficient, &self.known)?.sign().is_strict(), coefficient.terms().len());
            let by = Ratio::from(-rest).over(&coefficient.into())?;
            (strict && !by.symbols().contains(&x)).then_some((length, (Monomial::of(x), by)))
        };
        let symbols = value.num().symbols();
        let rounds = symbols.iter().any(|x| is_small(*x));
        let comes_later = |x: &Symbol| rounds && given.is_none_or(|given| given.solved_for != x.0);
        let free = |x: &&Symbol| !self.known.contains_key(x) && !is_small(**x);
        let free = symbols.iter().filter(free).filter_map(|x| Some((comes_later(x), solved(*x)?)));
        let product = || {
            let known = |m: &Monomial| m.powers().filter(|(x, _)| self.known.contains_key(x)).count();
            let large = |m: &&Monomial| m.powers().len() > 1 && !m.powers().any(|(x, _)| is_small(x));
            let own = value.num().terms().map(|(m, _)| m).filter(large);
            let pivot = own.min_by_key(|m| known(m))?.clone();
            let coefficient = equation.terms().find(|(m, _)| **m == pivot)?.1.clone();
            let rest = &equation - Poly::constant(coefficient.clone()) * Poly::from(pivot.clone());
            let by = -&rest * Poly::constant(coefficient.recip());
            (!rest.contains(&pivot)).then_some((pivot, by.into()))
        };
        let seen_again = || {
            let mut context = self.clone();
            context.known.extend(slack.symbols().into_iter().map(|s| (s, sign_of_slack)));
            symbols.iter().find_map(|x| {
                let (_, rule) = solved(*x)?;
                let signed = context.sign(self.reduce(&rule.1))?;
                signed.sign().implies(*self.known.get(x)?).then_some(rule)
            })
        };
        let free = free.min_by_key(|(later, (terms, _))| (*later, *terms)).map(|(_, (_, rule))| rule);
        free.or_else(|| if rounds { seen_again().or_else(product) } else { product().or_else(seen_again) })
    }

    fn direct(&self, goal: &Goal) -> Result<Direct, Why> {
        let mut reader = Reader::new(self);
        let because = match &goal.says {
            Says::Equal(left, right) => Because::Same(self.same(reader.read(left)?, reader.read(right)?)?),
            Says::Sign(Relation::NonNegative, of) if let Some((a, b)) = rounded_difference(of) => {
                reader.defined(of)?;
                Because::Order(order::at_least(&mut reader, a, b)?)
            }
            Says::Sign(relation, of) => {
                let value = self.reduce(&reader.read(of)?);
                let signed = self.sign(value.clone()).ok_or_else(|| Why::NoSign(value.clone()))?;
                if !signed.sign().implies((*relation).into()) {
                    return Err(Why::WrongSign(value, signed.sign()));
                }
                Because::Sign(signed)
            }
            Says::Within(of, bound) => {
                let (of, bound) = (reader.read(of)?, reader.read(bound)?);
                Because::Within(reader.not_negative(&bound - &of)?, reader.not_negative(bound + of)?)
            }
            Says::Derivative(of, by, is) => {
                let Dual { derivative, .. } =
                    of.derivative(by, &|name| Tree::symbol(name), &tree::smooth).ok_or(Why::Kink)?;
                reader.read(of)?;
                Because::Derivative(self.same(reader.read(&derivative)?, reader.read(is)?)?)
            }
            Says::Limit(of, by, to) => {
                let x = Symbol(by);
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
            let leading = |p: &Poly| Some(sign(&p.coefficients(x).pop()?, &self.known)?.sign());
            let falls = leading(e.num())?.times(leading(e.den())?) == Sign::Negative;
            if !e.is_of_polynomials() || !falls || e.num().degree(x) <= e.den().degree(x) {
                return None;
            }
        }
        let rest = num.terms().filter(|(m, _)| !m.exponent().is_some_and(moves));
        Some(rest.map(|(m, q)| (m.clone(), q.clone())).collect())
    }

    /// The limit for x → ∞ by the degrees in x: a quotient of polynomials tends to 0 if the degree is
    /// higher below, and to the quotient of the leading coefficients if the degrees are equal.
    ///
    /// Everything supposed has to stay true as x grows: of x itself nothing but that it is positive.
    fn limit(&self, of: Ratio, x: Symbol, to: Ratio) -> Result<Because, Why> {
        let none = || Why::NoLimit(of.clone());
        let touched =
            |s: &Supposed| s.value.symbols().contains(&x) && !matches!(&s.used, Used::Symbol(y) if *y == x);
        if self.supposed.iter().any(touched) || to.symbols().contains(&x) {
            return Err(none());
        }
        let num = self.without_falling_exponentials(of.num(), x).ok_or_else(none)?;
        if of.den().has_exponentials() {
            return Err(none());
        }
        let degrees = (num.degree(x), of.den().degree(x));
        let top = num.coefficients(x).pop().ok_or_else(none)?;
        let bottom = of.den().coefficients(x).pop().ok_or_else(none)?;
        let leading = sign(&bottom, &self.known).filter(|c| c.sign().is_strict()).ok_or_else(none)?;
        let found = match degrees.0.cmp(&degrees.1) {
            _ if num.is_zero() => Ratio::zero(),
            Ordering::Less => Ratio::zero(),
            Ordering::Equal => Ratio::from(top).over(&bottom.into()).ok_or_else(none)?,
            Ordering::Greater => return Err(none()),
        };
        let to = self.same(found, to)?;
        Ok(Because::Limit { of, by: x, degrees, leading, to })
    }
}

/// A quotient without factors that are powers of two, and these.
fn without_scales(value: &Ratio) -> (Ratio, Ratio) {
    let scales =
        |poly: &Poly| -> Poly { poly.common_monomial().without_those(|x| !SCALES.contains(&x.0)).into() };
    let scale = Ratio::from(scales(value.num())).over(&scales(value.den()).into());
    let scale = scale.unwrap_or_else(|| Poly::constant(1).into());
    (value.over(&scale).unwrap_or_else(|| value.clone()), scale)
}

/// a and b, if this is a − b, and both are rounded.
fn rounded_difference(of: &Tree) -> Option<(&Tree, &Tree)> {
    let Step::Sub(a, b) = of.step() else { return None };
    [a, b].into_iter().all(|tree| matches!(tree.step(), Step::Rounded(_))).then_some((a, b))
}

/// The symbol that a quantity is, if it is one.
fn as_symbol(value: &Ratio) -> Option<Symbol> {
    let x = value.num().symbols().into_iter().next()?;
    (*value == Ratio::from(Poly::symbol(x))).then_some(x)
}

/// Reads formulas as quotients, and notes what that takes.
struct Reader<'a> {
    context: &'a Context,
    divisors: Vec<(Tree, Signed)>,
    brackets: Vec<(Tree, Tree, Signed)>,
    /// What has been rounded, without factors that are powers of two, and with which error.
    rounded: Vec<(Ratio, algebra::Symbol)>,
    errors: Vec<Rounding>,
}

impl<'a> Reader<'a> {
    fn new(context: &'a Context) -> Self {
        let (divisors, brackets, rounded) = Default::default();
        Reader { context, divisors, brackets, rounded, errors: context.errors.clone() }
    }

    /// The sign of a quotient.
    fn sign(&self, value: Ratio) -> Result<Signed, Why> {
        let value = self.context.reduce(&value);
        self.context.sign(value.clone()).ok_or(Why::NoSign(value))
    }

    /// The same, if it is not negative.
    fn not_negative(&self, value: Ratio) -> Result<Signed, Why> {
        let signed = self.sign(value)?;
        let holds = signed.sign().implies(Sign::NonNegative);
        if holds { Ok(signed) } else { Err(Why::WrongSign(signed.value.clone(), signed.sign())) }
    }

    /// Nothing in it is divided by 0.
    fn defined(&mut self, tree: &Tree) -> Result<(), Why> {
        match tree.step() {
            Step::Div(a, b) => {
                self.defined(a)?;
                self.divisor(b)?;
            }
            step => step.operands().try_for_each(|operand| self.defined(operand))?,
        }
        Ok(())
    }

    /// What is divided by, which is not 0.
    fn divisor(&mut self, tree: &Tree) -> Result<Ratio, Why> {
        let divisor = self.read(tree)?;
        if !divisor.is_number() && self.divisors.iter().all(|(known, _)| known != tree) {
            let signed = self.context.sign(self.context.reduce(&divisor));
            let signed = signed.filter(|s| s.num.sign().is_strict());
            self.divisors.push((tree.clone(), signed.ok_or_else(|| Why::MightVanish(divisor.clone()))?));
        }
        Ok(divisor)
    }

    fn read(&mut self, tree: &Tree) -> Result<Ratio, Why> {
        use Step::*;
        Ok(match tree.step() {
            // What rounding makes of a formula is long: the sooner it is in the symbols that are left, the better.
            Symbol(name) if self.context.rounds() => {
                self.context.reduce(&Poly::symbol(algebra::Symbol(name)).into())
            }
            Symbol(name) => Poly::symbol(algebra::Symbol(name)).into(),
            Int(n) => Poly::constant(*n).into(),
            Neg(a) => -self.read(a)?,
            Add(a, b) => self.read(a)? + self.read(b)?,
            Sub(a, b) => self.read(a)? - self.read(b)?,
            Mul(a, b) => self.read(a)? * self.read(b)?,
            Div(a, b) => {
                let (value, divisor) = (self.read(a)?, self.divisor(b)?);
                value.over(&divisor).ok_or(Why::MightVanish(divisor))?
            }
            Exp(a) => {
                let exponent = self.context.reduce(&self.read(a)?);
                Poly::exponential(exponent).into()
            }
            PositivePart(a) => self.either(tree, a, &tree.with_step(Int(0)), |a, _| a)?,
            Min(a, b) => self.either(tree, a, b, |a, b| b - a)?,
            Rounded(a) => {
                let value = self.context.reduce(&self.read(a)?);
                let (error, largest) = self.rounding(a, &value)?;
                let nearest = &largest + Ratio::from(Poly::symbol(error));
                (value * nearest).over(&largest).ok_or(Why::MightVanish(largest))?
            }
        })
    }

    /// The error of what is rounded, and N.
    fn rounding(&mut self, of: &Tree, value: &Ratio) -> Result<(algebra::Symbol, Ratio), Why> {
        let largest = self.context.largest();
        // What differs by a power of two rounds alike.
        let (value, scale) = without_scales(value);
        let same = self.rounded.iter().find(|(known, _)| (known - &value).is_zero());
        let error = match same {
            Some((_, error)) => *error,
            None => {
                let place = self.context.roundings.iter().position(|known| known == of);
                let error = algebra::Symbol(ERRORS[place.ok_or(Why::TooMany)?]);
                self.rounded.push((value, error));
                error
            }
        };
        if self.errors.iter().all(|known| known.of != *of) {
            self.errors.push(Rounding { of: of.clone(), error, scale });
        }
        Ok((error, largest))
    }

    /// A bracket: the first where what decides is ≥ 0, the second where it is ≤ 0. It has to be one of them
    /// for all values.
    fn either(
        &mut self,
        bracket: &Tree,
        first: &Tree,
        second: &Tree,
        decides: fn(Ratio, Ratio) -> Ratio,
    ) -> Result<Ratio, Why> {
        let (a, b) = (self.read(first)?, self.read(second)?);
        let value = self.context.reduce(&decides(a.clone(), b.clone()));
        let signed = self.context.sign(value.clone()).ok_or(Why::OpenBracket(value))?;
        let is_first = signed.sign().implies(Sign::NonNegative);
        if self.brackets.iter().all(|(known, ..)| known != bracket) {
            self.brackets.push((bracket.clone(), if is_first { first } else { second }.clone(), signed));
        }
        Ok(if is_first { a } else { b })
    }
}

#[cfg(test)]
mod tests;

//! The kernel: a [`Statement`] in, a [`Proof`] out, or [`Why`] there is none.
//!
//! A formula is read step by step into a quotient of polynomials ([`algebra`](super::algebra)); a division
//! needs a proof that its divisor is not 0, a bracket ⟨x⟩ or a minimum needs the sign of what it depends on.
//! Where the sign for a bracket is open, the kernel splits into two cases, positive or not, and proves both; a
//! divisor whose sign is open is the end of the attempt.
//!
//! A hypothesis v > 0 that does not follow from others, and is more than the sign of a symbol, becomes v = s for a new
//! symbol s > 0: one monomial of v, the *pivot*, is replaced wherever it occurs by what it equals then. (For
//! R = m g − c (H − l) > 0: m g by s + c (H − l); or H by (c l + m g − s)/c, where c ≠ 0 is known.) Equals are replaced by
//! equals, so what is proved of all values of the symbols that are left, s > 0 among them, holds in particular
//! for those that satisfy the hypothesis. Which monomial is chosen matters for success and not for soundness.
//!
//! | to prove | the rule |
//! |---|---|
//! | a = b | a − b is the zero polynomial over some denominator |
//! | a > 0, a ≥ 0, a = 0 | the sign of its numerator and of its denominator ([`sign`](mod@super::sign)) |
//! | da/dx = b | dual numbers differentiate a by the sum, product and quotient rules; then as a = b |
//! | lim a = b for x → ∞ | degrees in x; e^… with an exponent that tends to −∞ vanishes against any power |
//!
//! No hypothesis of a limit may speak of x, but to say that it is positive: it has to stay true as x grows.

use super::algebra::{Monomial, Poly, Ratio, Symbol, is_bracket};
use super::sign::{Assumed, Assumptions, Certificate, Sign, sign};
use crate::formula::statement::{Goal, Role, Says, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::tree::{self, Step};
use crate::number::{Dual, Tree};
use std::fmt;

/// A proof of a statement: a derivation for each of its goals.
#[derive(Clone, Debug)]
pub struct Proof {
    /// In the order of the goals.
    pub goals: Vec<Derivation>,
}

/// How a goal is derived.
#[derive(Clone, Debug)]
pub enum Derivation {
    /// In two cases: a quantity is positive, or it is not.
    Cases(Poly, Box<Derivation>, Box<Derivation>),
    /// In one go.
    Direct(Box<Direct>),
}

/// A derivation without cases of its own.
#[derive(Clone, Debug)]
pub struct Direct {
    /// What is supposed, and how it is used.
    pub supposed: Vec<Supposed>,
    /// Each divisor, and why it is not 0.
    ///
    /// Its numerator has a strict sign; its own divisors are listed before it.
    pub divisors: Vec<(Tree, Signed)>,
    /// Each bracket, which of its values it has, and why: the sign of what decides it.
    pub brackets: Vec<(Tree, Tree, Signed)>,
    /// The rest.
    pub because: Because,
}

/// A supposition and what became of it.
#[derive(Clone, Debug)]
pub struct Supposed {
    /// The hypothesis, or `None` for the case of a split.
    pub given: Option<Hypothesis>,
    /// The quantity it speaks of, before this supposition is used.
    pub value: Ratio,
    /// What it says of its sign.
    pub sign: Sign,
    /// How it is used.
    pub used: Used,
}

/// How a supposition is used.
#[derive(Clone, Debug)]
pub enum Used {
    /// It follows from the others.
    Follows,
    /// The quantity is a symbol; its sign is known from now on.
    Symbol(Symbol),
    /// The pivot is replaced, with a new symbol for the quantity unless it is 0.
    Pivot(Monomial, Ratio, Option<Symbol>),
    /// Not at all: there is no pivot. What is proved holds without it, too.
    Unused,
}

/// The sign of a quotient.
#[derive(Clone, Debug)]
pub struct Signed {
    /// The quotient, reduced by the suppositions.
    pub value: Ratio,
    /// The sign of its numerator.
    pub num: Certificate,
    /// The strict sign of its denominator.
    pub den: Certificate,
}

impl Signed {
    /// The sign of the quotient.
    pub fn sign(&self) -> Sign {
        self.num.sign.times(self.den.sign)
    }
}

/// The last step of a derivation.
#[derive(Clone, Debug)]
pub enum Because {
    /// Both sides are this.
    Same(Ratio),
    /// A sign.
    Sign(Signed),
    /// The derivative, as dual numbers compute it, and the other side are this.
    Derivative(Ratio),
    /// By degrees in the symbol, and the sign of the denominator's leading coefficient.
    Limit {
        /// What has the limit.
        of: Ratio,
        /// In which symbol.
        by: Symbol,
        /// The degrees of numerator and denominator, without the e^… that vanish.
        degrees: (u32, u32),
        /// Why the denominator's leading coefficient is not 0.
        leading: Certificate,
        /// The limit.
        to: Ratio,
    },
}

/// Why there is no proof: where a search for a counterexample may start.
#[derive(Clone, Debug)]
pub enum Why {
    /// A divisor might be 0.
    MightVanish(Ratio),
    /// It is not known whether a bracket opens, and no case can be made of it.
    OpenBracket(Ratio),
    /// No rule finds the sign.
    NoSign(Ratio),
    /// The sign is another.
    WrongSign(Ratio, Sign),
    /// Two sides differ by this.
    Different(Ratio),
    /// No rule finds the limit.
    NoLimit(Ratio),
    /// A name that the kernel keeps for itself.
    Reserved(&'static str),
    /// There is no goal.
    Nothing,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Why::MightVanish(value) => write!(f, "{value} might be 0"),
            Why::OpenBracket(value) => write!(f, "the sign of {value} is open"),
            Why::NoSign(value) => write!(f, "no rule finds the sign of {value}"),
            Why::WrongSign(value, sign) => write!(f, "{value} is {}", sign.text()),
            Why::Different(value) => write!(f, "the sides differ by {value}"),
            Why::NoLimit(value) => write!(f, "no rule finds the limit of {value}"),
            Why::Reserved(name) => write!(f, "{name} is not a name for a quantity of a claim"),
            Why::Nothing => f.write_str("it says nothing"),
        }
    }
}

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
    let given = Context::default().with(&statement.hypotheses)?;
    let in_a_step = given.clone().with(&statement.invariants)?;
    let goals = statement.goals.iter().map(|goal| {
        let context = match goal.role {
            Role::Claim | Role::Begins => &given,
            Role::Step | Role::Continues => &in_a_step,
        };
        derive(goal, context, CASES)
    });
    Ok(Proof { goals: goals.collect::<Result<_, _>>()? })
}

/// How many splits may be nested.
const CASES: u32 = 4;

/// Where a bracket is open, both cases.
fn derive(goal: &Goal, context: &Context, cases: u32) -> Result<Derivation, Why> {
    match context.direct(goal) {
        Ok(direct) => Ok(Derivation::Direct(direct.into())),
        Err(Why::OpenBracket(value)) if cases > 0 => {
            let open = || Why::OpenBracket(value.clone());
            // The sign of the numerator is that of the quotient, or its opposite.
            let below = sign(value.den(), &context.known).ok_or_else(open)?.sign;
            let deciding = if below == Sign::Negative { value.num().negated() } else { value.num().clone() };
            let case = |sign| {
                let mut context = context.clone();
                context.suppose(None, deciding.clone().into(), sign);
                derive(goal, &context, cases - 1)
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
#[derive(Clone, Debug, Default)]
struct Context {
    supposed: Vec<Supposed>,
    known: Assumptions,
    rules: Vec<(Monomial, Ratio)>,
}

impl Context {
    /// With hypotheses more.
    fn with(mut self, hypotheses: &[Hypothesis]) -> Result<Self, Why> {
        for hypothesis in hypotheses {
            let value = Reader::new(&self).read(&hypothesis.value)?;
            self.suppose(Some(hypothesis), value, hypothesis.relation.into());
        }
        Ok(self)
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
        den.sign.is_strict().then_some(Signed { value, num, den })
    }

    /// Takes in that a quantity has a sign.
    fn suppose(&mut self, given: Option<&Hypothesis>, value: Ratio, sign: Sign) {
        let value = self.reduce(&value);
        let used = match sign {
            _ if self.sign(value.clone()).is_some_and(|signed| signed.sign().implies(sign)) => Used::Follows,
            Sign::Negative | Sign::NonPositive => {
                return self.suppose(given, value.negated(), sign.negated());
            }
            Sign::Positive | Sign::NonNegative => {
                let assumed = if sign == Sign::Positive { Assumed::Positive } else { Assumed::NonNegative };
                if let Some(symbol) = as_symbol(&value) {
                    self.known.insert(symbol, assumed);
                    Used::Symbol(symbol)
                } else {
                    let new = self.supposed.iter().filter(|s| matches!(s.used, Used::Pivot(..))).count();
                    let name = NAMES.get(new).copied().map(Symbol);
                    match name.and_then(|name| Some((name, self.pivot(&value, &Poly::symbol(name))?))) {
                        None => Used::Unused,
                        Some((name, (pivot, by))) => {
                            self.known.insert(name, assumed);
                            Used::Pivot(pivot, by, Some(name))
                        }
                    }
                }
            }
            Sign::Zero => self
                .pivot(&value, &Poly::zero())
                .map_or(Used::Unused, |(pivot, by)| Used::Pivot(pivot, by, None)),
        };
        if let Used::Pivot(pivot, by, _) = &used {
            for (_, older) in &mut self.rules {
                *older = older.replace(pivot, by);
            }
            self.rules.push((pivot.clone(), by.clone()));
        }
        self.supposed.push(Supposed { given: given.cloned(), value, sign, used });
    }

    /// A monomial of the quantity, and what it equals if the quantity is `slack`.
    ///
    /// Best a symbol of which nothing is known and that stands alone or times what is not 0, so that it disappears
    /// for good; else a product of symbols of which little is known, so that little is forgotten.
    fn pivot(&self, value: &Ratio, slack: &Poly) -> Option<(Monomial, Ratio)> {
        // num − slack · den = 0, and den is not 0.
        let equation = value.num().plus(&slack.times(value.den()).negated());
        let free = value.num().symbols().into_iter().filter(|x| !self.known.contains_key(x));
        let solved = free.filter_map(|x| {
            let [rest, coefficient] = <[Poly; 2]>::try_from(equation.coefficients(x)).ok()?;
            let strict = sign(&coefficient, &self.known)?.sign.is_strict();
            let by = Ratio::from(rest.negated()).over(&coefficient.clone().into())?;
            (strict && !by.symbols().contains(&x))
                .then_some((coefficient.terms().count(), (Monomial::of(x), by)))
        });
        let product = || {
            let known = |m: &Monomial| m.powers().iter().filter(|(x, _)| self.known.contains_key(x)).count();
            let own = value.num().terms().map(|(m, _)| m).filter(|m| m.powers().len() > 1);
            let pivot = own.min_by_key(|m| known(m))?.clone();
            let coefficient = equation.terms().find(|(m, _)| **m == pivot)?.1.clone();
            let rest = equation.plus(&Poly::term(pivot.clone(), -coefficient.clone()));
            let by = rest.scaled(&(-coefficient.recip()));
            (!rest.contains(&pivot)).then_some((pivot, by.into()))
        };
        solved.min_by_key(|(terms, _)| *terms).map(|(_, rule)| rule).or_else(product)
    }

    fn direct(&self, goal: &Goal) -> Result<Direct, Why> {
        let mut reader = Reader::new(self);
        let because = match &goal.says {
            Says::Equal(left, right) => Because::Same(self.same(reader.read(left)?, reader.read(right)?)?),
            Says::Sign(relation, of) => {
                let value = self.reduce(&reader.read(of)?);
                let signed = self.sign(value.clone()).ok_or_else(|| Why::NoSign(value.clone()))?;
                if !signed.sign().implies((*relation).into()) {
                    return Err(Why::WrongSign(value, signed.sign()));
                }
                Because::Sign(signed)
            }
            Says::Derivative(of, by, is) => {
                let Dual { derivative, .. } =
                    of.derivative(by, &|name| Tree::symbol(name), &tree::smooth).ok_or_else(|| {
                        // ⟨·⟩ and min have kinks.
                        Why::NoLimit(Ratio::from(Poly::symbol(Symbol(by))))
                    })?;
                reader.read(of)?;
                Because::Derivative(self.same(reader.read(&derivative)?, reader.read(is)?)?)
            }
            Says::Limit(of, by, to) => {
                let x = Symbol(by);
                let (of, to) = (self.reduce(&reader.read(of)?), self.reduce(&reader.read(to)?));
                self.limit(of, x, to)?
            }
        };
        let Reader { divisors, brackets, .. } = reader;
        Ok(Direct { supposed: self.supposed.clone(), divisors, brackets, because })
    }

    /// Two quotients are equal: what they are.
    fn same(&self, left: Ratio, right: Ratio) -> Result<Ratio, Why> {
        let difference = self.reduce(&left.minus(&right));
        if difference.is_zero() { Ok(self.reduce(&right)) } else { Err(Why::Different(difference)) }
    }

    /// The terms without an e^… that falls as x grows. None if there is an e^… of which that is not seen.
    ///
    /// An exponent n/d of polynomials whose degree in x is higher above than below, and whose leading coefficients
    /// have opposite signs, tends to −∞ at least as fast as −x does, up to a factor; and e^{−a x} times any
    /// power of x vanishes for a > 0.
    fn without_falling_exponentials(&self, num: &Poly, x: Symbol) -> Option<Poly> {
        let (moving, rest) = num.exponentials_in(x);
        for (e, _) in moving {
            let leading = |p: &Poly| Some(sign(&p.coefficients(x).pop()?, &self.known)?.sign);
            let falls = leading(e.num())?.times(leading(e.den())?) == Sign::Negative;
            if !e.is_of_polynomials() || !falls || e.num().degree(x) <= e.den().degree(x) {
                return None;
            }
        }
        Some(rest)
    }

    /// The limit for x → ∞ by the degrees in x: a quotient of polynomials tends to 0 if the degree is higher below,
    /// and to the quotient of the leading coefficients if the degrees are equal.
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
        let leading = sign(&bottom, &self.known).filter(|c| c.sign.is_strict()).ok_or_else(none)?;
        let found = match degrees.0.cmp(&degrees.1) {
            _ if num.is_zero() => Ratio::zero(),
            std::cmp::Ordering::Less => Ratio::zero(),
            std::cmp::Ordering::Equal => Ratio::from(top).over(&bottom.into()).ok_or_else(none)?,
            std::cmp::Ordering::Greater => return Err(none()),
        };
        let to = self.same(found, to)?;
        Ok(Because::Limit { of, by: x, degrees, leading, to })
    }
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
}

impl<'a> Reader<'a> {
    fn new(context: &'a Context) -> Self {
        Reader { context, divisors: Vec::new(), brackets: Vec::new() }
    }

    fn read(&mut self, tree: &Tree) -> Result<Ratio, Why> {
        use Step::*;
        if let Some(result) = self.result(tree) {
            return self.read(&result.clone());
        }
        Ok(match tree.step() {
            Symbol(name) if NAMES.contains(name) => return Err(Why::Reserved(name)),
            Symbol(name) => Poly::symbol(super::algebra::Symbol(name)).into(),
            Int(n) => Poly::constant(*n).into(),
            Neg(a) => self.read(a)?.negated(),
            Add(a, b) => self.read(a)?.plus(&self.read(b)?),
            Sub(a, b) => self.read(a)?.minus(&self.read(b)?),
            Mul(a, b) => self.read(a)?.times(&self.read(b)?),
            Div(a, b) => {
                let (value, divisor) = (self.read(a)?, self.read(b)?);
                let might_vanish = || Why::MightVanish(divisor.clone());
                if divisor.as_constant().is_none_or(|q| q == 0)
                    && self.divisors.iter().all(|(known, _)| known != b)
                {
                    let signed = self.context.sign(self.context.reduce(&divisor));
                    let signed = signed.filter(|s| s.num.sign.is_strict());
                    self.divisors.push((b.clone(), signed.ok_or_else(might_vanish)?));
                }
                value.over(&divisor).ok_or_else(might_vanish)?
            }
            Exp(a) => {
                let exponent = self.context.reduce(&self.read(a)?);
                Poly::exponential(exponent).into()
            }
            PositivePart(a) => {
                let value = self.read(a)?;
                let (open, signed) = self.decide(&value)?;
                let result = if open { a.clone() } else { tree.with_step(Int(0)) };
                self.brackets.push((tree.clone(), result, signed));
                if open { value } else { Ratio::zero() }
            }
            Min(a, b) => {
                let (left, right) = (self.read(a)?, self.read(b)?);
                let (first, signed) = self.decide(&right.minus(&left))?;
                self.brackets.push((tree.clone(), if first { a.clone() } else { b.clone() }, signed));
                if first { left } else { right }
            }
        })
    }

    /// The value of a bracket that was met before.
    fn result(&self, bracket: &Tree) -> Option<&Tree> {
        if !is_bracket(bracket) {
            return None;
        }
        self.brackets.iter().find(|(known, ..)| known == bracket).map(|(_, result, _)| result)
    }

    /// Is it ≥ 0 (true) or ≤ 0 (false)? It has to be one of them for all values.
    fn decide(&self, value: &Ratio) -> Result<(bool, Signed), Why> {
        let value = self.context.reduce(value);
        let open = || Why::OpenBracket(value.clone());
        let signed = self.context.sign(value.clone()).ok_or_else(open)?;
        Ok((signed.sign().implies(Sign::NonNegative), signed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Exponential, Field, PositivePart};
    use num_traits::{One, Zero};

    fn x(name: &'static str) -> Tree {
        Tree::symbol(name)
    }

    fn above_zero(value: Tree) -> Hypothesis {
        Hypothesis::new(Relation::Positive, value)
    }

    fn not_below_zero(value: Tree) -> Hypothesis {
        Hypothesis::new(Relation::NonNegative, value)
    }

    fn outcome(hypotheses: Vec<Hypothesis>, says: Says) -> Result<Proof, Why> {
        let goals = vec![Goal::of_claim("", says)];
        prove(&Statement { hypotheses, goals, ..Statement::default() })
    }

    fn proved(hypotheses: Vec<Hypothesis>, says: Says) -> bool {
        outcome(hypotheses, says).is_ok()
    }

    /// c > 0
    fn stiffness() -> Vec<Hypothesis> {
        vec![above_zero(x("c"))]
    }

    /// λ ≥ 0
    fn multiplier() -> Vec<Hypothesis> {
        vec![not_below_zero(x("λ"))]
    }

    #[test]
    fn a_divisor_has_to_be_seen_not_to_vanish() {
        let one = || Says::Equal(x("c") / x("c"), Tree::one());
        assert!(proved(stiffness(), one()));
        assert!(matches!(outcome(vec![], one()), Err(Why::MightVanish(..))));
        // Not even where the quotient is multiplied by 0.
        assert!(!proved(vec![], Says::Equal(Tree::zero() * (Tree::one() / x("u")), Tree::zero())));
        assert!(!proved(multiplier(), Says::Equal(x("λ") / x("λ"), Tree::one())));
        assert!(!proved(vec![], Says::Equal(Tree::one() / (x("u") - x("u")), Tree::zero())));
    }

    #[test]
    fn equal_is_equal_everywhere() {
        let square = (x("u") + x("v")) * (x("u") + x("v"));
        let two = Tree::int(2);
        let expanded = x("u") * x("u") + two * x("u") * x("v") + x("v") * x("v");
        assert!(proved(vec![], Says::Equal(square.clone(), expanded.clone())));
        assert!(!proved(vec![], Says::Equal(square, expanded + x("u"))));
    }

    #[test]
    fn strict_and_weak_signs_are_two_things() {
        assert!(proved(multiplier(), Says::Sign(Relation::NonNegative, x("λ"))));
        assert!(!proved(multiplier(), Says::Sign(Relation::Positive, x("λ"))));
        assert!(!proved(multiplier(), Says::Sign(Relation::Zero, x("λ"))));
        assert!(proved(stiffness(), Says::Sign(Relation::Positive, x("c"))));
        assert!(!proved(stiffness(), Says::Sign(Relation::NonNegative, -x("c"))));
    }

    #[test]
    fn a_hypothesis_says_what_it_says_and_no_more() {
        let reaction = || x("m") * x("g") - x("c") * x("H");
        let touching = || vec![not_below_zero(reaction())];
        assert!(proved(touching(), Says::Sign(Relation::NonNegative, reaction())));
        assert!(!proved(touching(), Says::Sign(Relation::Positive, reaction())));
        assert!(!proved(touching(), Says::Sign(Relation::Zero, reaction())));
        let grazing = vec![Hypothesis::new(Relation::Zero, reaction())];
        assert!(proved(grazing.clone(), Says::Equal(x("m") * x("g"), x("c") * x("H"))));
        assert!(!proved(grazing, Says::Equal(x("m"), x("c"))));
    }

    #[test]
    fn the_names_of_quantities_are_the_kernels_own() {
        let above = || vec![above_zero(x("u") - Tree::one())];
        assert!(!proved(above(), Says::Sign(Relation::Positive, x("s₁"))));
        assert!(!proved(vec![above_zero(x("u") - x("s₁"))], Says::Equal(x("u"), x("u"))));
        assert!(prove(&Statement::default()).is_err());
    }

    #[test]
    fn a_bracket_opens_where_its_sign_says_so() {
        let bracket = |t: &Tree| t.positive_part();
        assert!(proved(stiffness(), Says::Equal(bracket(&x("c")), x("c"))));
        assert!(proved(stiffness(), Says::Equal(bracket(&-x("c")), Tree::zero())));
        assert!(!proved(vec![], Says::Equal(bracket(&x("u")), x("u"))));
        assert!(!proved(vec![], Says::Equal(bracket(&x("u")), Tree::zero())));
        // By cases: ⟨u⟩ − ⟨−u⟩ = u, and min(u, v) = v − ⟨v − u⟩.
        assert!(proved(vec![], Says::Equal(bracket(&x("u")) - bracket(&-x("u")), x("u"))));
        let min = x("u").min(&x("v"));
        assert!(proved(vec![], Says::Equal(min.clone(), x("v") - bracket(&(x("v") - x("u"))))));
        assert!(!proved(vec![], Says::Equal(min, x("u"))));
    }

    #[test]
    fn limits_by_degrees() {
        let limit = |of: Tree, to: Tree| Says::Limit(of, "t", to);
        let t = || x("t");
        assert!(proved(stiffness(), limit(Tree::one() / (x("c") + t() * t()), Tree::zero())));
        let time = || above_zero(t());
        let both = || vec![above_zero(x("c")), time()];
        assert!(proved(both(), limit(t() / (Tree::one() + x("c") * t()), Tree::one() / x("c"))));
        assert!(!proved(both(), limit(t() / (Tree::one() + x("c") * t()), Tree::one())));
        assert!(!proved(both(), limit(t(), Tree::zero())));
        // What might be constant need not vanish.
        let weak = vec![not_below_zero(x("λ")), time()];
        assert!(!proved(weak, limit(Tree::one() / (Tree::one() + x("λ") * t()), Tree::zero())));
        // e^{−ct} falls faster than any power rises; e^{ct} and e^{ut} do not.
        let decay = |rate: Tree| t() * (rate * t()).exp();
        assert!(proved(both(), limit(decay(-x("c")), Tree::zero())));
        assert!(!proved(both(), limit(decay(x("c")), Tree::zero())));
        assert!(!proved(both(), limit(decay(-x("u")), Tree::zero())));
        // An exponential within an exponent has no degree: e^{eᵗ − t} grows, and e^{−t e^{−t}} tends to 1.
        let within = |exponent: Tree| limit(exponent.exp(), Tree::zero());
        assert!(!proved(vec![time()], within(t().exp() - t())));
        assert!(!proved(vec![time()], within(-t() * (-t()).exp())));
        // A hypothesis that ends as t grows says nothing of the limit.
        let before = vec![above_zero(x("c") - t())];
        assert!(!proved(before, limit(Tree::one() / (Tree::one() + t() * t()), Tree::zero())));
    }

    #[test]
    fn an_invariant_has_to_hold_at_the_start() {
        // x ← ⟨x⟩ from λ stays λ if λ ≥ 0; that it is so at every step is no reason for it to be so at the first.
        let (lambda, q) = (x("λ"), x("q"));
        let invariant = |q: &Tree| &lambda + (q - q);
        let goal = |part, role, says| Goal { part, role, says };
        let statement = |hypotheses| Statement {
            kind: "induction",
            hypotheses,
            invariants: vec![not_below_zero(invariant(&q))],
            goals: vec![
                goal("start", Role::Claim, Says::Equal(lambda.clone(), lambda.clone())),
                goal("step", Role::Step, Says::Equal(lambda.positive_part(), lambda.clone())),
                goal("", Role::Begins, Says::Sign(Relation::NonNegative, invariant(&Tree::one()))),
                goal("", Role::Continues, Says::Sign(Relation::NonNegative, invariant(&q))),
            ],
            ..Statement::default()
        };
        assert!(prove(&statement(multiplier())).is_ok());
        assert!(matches!(prove(&statement(vec![])), Err(Why::NoSign(_))));
    }

    #[test]
    fn derivatives_are_those_of_the_formula() {
        let square = || x("u") * x("u");
        let twice = || Tree::int(2) * x("u");
        assert!(proved(vec![], Says::Derivative(square(), "u", twice())));
        assert!(!proved(vec![], Says::Derivative(square(), "u", x("u"))));
        assert!(!proved(vec![], Says::Derivative(square(), "v", twice())));
        // ⟨u⟩ has none at 0.
        assert!(!proved(vec![], Says::Derivative(x("u").positive_part(), "u", Tree::one())));
    }
}

//! Statements about formulas, for provers, number systems and printers.

use super::hypothesis::{Hypothesis, Relation, name_of};
pub use super::proposition::{Goal, Proposition, Role};
pub use super::sequence::Sequence;
use super::symbols::PRECISION;
use crate::number::Tree;
use crate::number::tree::Op;

/// A statement about recorded formulas: hypotheses, and goals that follow from them.
///
/// The functions of [`claim`](super::claim) construct it. Its goals are derived from its contents and cannot
/// be set, so a proof of it proves the printed claim.
///
/// # Examples
///
/// ```
/// use provable::formula::{Hypothesis, Relation, claim::positive};
/// use provable::{number::Tree, proof::prove};
/// let [f, g] = ["f", "g"].map(|name| Tree::symbol(name));
/// let further = Hypothesis::new(Relation::Positive, &g - &f);
/// let claim = positive("distance", &g - &f).assuming([&further]);
/// assert!(prove(&claim).is_ok() && prove(&claim.without(&further)).is_err());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Statement {
    equation: &'static str,
    name: &'static str,
    stated: Vec<Hypothesis>,
    inherits: bool,
    computes: Vec<(&'static str, Tree)>,
    form: Form,
    contains_rounding: bool,
    hypotheses: Vec<Hypothesis>,
    invariants: Vec<Hypothesis>,
    computed: Vec<Computed>,
    goals: Vec<Goal>,
}

/// The contents of a statement, from which its goals are derived.
#[derive(Clone, Debug)]
pub(super) enum Form {
    /// Propositions, each with the name of its part.
    Propositions(Vec<(&'static str, Proposition)>),
    /// A statement about all members of a sequence.
    Sequence(Sequence),
}

/// A computed quantity.
#[derive(Clone, Debug)]
pub struct Computed {
    /// Its symbol.
    pub symbol: &'static str,
    /// The formula that computes it.
    pub formula: Tree,
    /// The interval that contains it.
    pub hypothesis: Hypothesis,
}

impl Default for Form {
    fn default() -> Self {
        Form::Propositions(Vec::new())
    }
}

impl Statement {
    /// Returns a proposition without an equation number and without hypotheses.
    pub(crate) fn new(name: &'static str, proposition: Proposition) -> Self {
        Statement::of_form(name, Form::Propositions(vec![("", proposition)]))
    }

    pub(super) fn of_form(name: &'static str, form: Form) -> Self {
        Statement { name, inherits: true, form, ..Statement::default() }.derived()
    }

    /// Derives the hypotheses for each role and the goals.
    fn derived(mut self) -> Self {
        let mut hypotheses = self.stated.clone();
        (self.goals, self.computed, self.invariants) = Default::default();
        for (symbol, by) in &self.computes {
            let is_interval = |h: &Hypothesis| h.interval().is_some_and(|(x, ..)| x == *symbol);
            let Some(index) = hypotheses.iter().position(is_interval) else { continue };
            let hypothesis = hypotheses.remove(index);
            let proposition = Proposition::of_hypothesis(&hypothesis, &[(symbol, by.clone())]);
            let role = Role::Computed(self.computed.len());
            self.goals.push(Goal { part: "computed", role, proposition });
            self.computed.push(Computed { symbol, formula: by.clone(), hypothesis });
        }
        match &self.form {
            Form::Propositions(all) => {
                self.goals.extend(all.iter().map(|(part, of)| Goal::of_claim(part, of.clone())));
            }
            Form::Sequence(sequence) => {
                if sequence.limit.is_none() {
                    self.invariants.extend(hypotheses.extract_if(.., |h| sequence.changes(h)));
                    self.invariants.extend(sequence.invariant());
                }
                self.goals.extend(sequence.goals(&self.invariants));
            }
        }
        let stated = self.stated.iter().map(|hypothesis| &hypothesis.value);
        let contains_rounding = self.formulas().chain(stated).any(Tree::contains_rounding);
        // A statement is still about any precision without the hypothesis that contains its roundings.
        self.contains_rounding |= contains_rounding;
        if self.contains_rounding {
            // The minimum precision comes last if other hypotheses on the precision, which are stronger,
            // exist.
            let is_bounded = hypotheses.iter().any(|h| h.value.symbols().contains(PRECISION));
            let index = if is_bounded { hypotheses.len() } else { 0 };
            hypotheses.insert(index, minimum_precision());
        }
        self.hypotheses = hypotheses;
        self
    }

    /// Adds hypotheses.
    pub fn assuming<'a>(mut self, hypotheses: impl IntoIterator<Item = &'a Hypothesis>) -> Self {
        self.stated.extend(hypotheses.into_iter().cloned());
        self.derived()
    }

    /// Replaces the hypotheses; those of an equation are not [inherited](Self::inheriting).
    pub fn only_assuming<'a>(mut self, hypotheses: impl IntoIterator<Item = &'a Hypothesis>) -> Self {
        (self.stated, self.inherits) = (hypotheses.into_iter().cloned().collect(), false);
        self.derived()
    }

    /// Makes the statement part of an equation, whose hypotheses are assumed first.
    pub fn inheriting(mut self, equation: &'static str, hypotheses: &[Hypothesis]) -> Self {
        self.equation = equation;
        if self.inherits {
            self.stated = [hypotheses, &self.stated].concat();
        }
        self.derived()
    }

    /// States that a quantity is computed by a formula: its interval is proved and not assumed.
    ///
    /// Each of several such quantities may be computed from those before it.
    ///
    /// # Panics
    /// Panics unless exactly one hypothesis concerns the quantity and is its interval, and if the quantity is
    /// computed already.
    pub fn computing(mut self, symbol: &Tree, by: impl Into<Tree>) -> Self {
        let name = name_of(symbol);
        let all: Vec<_> = self.stated.iter().filter(|h| h.value.symbols().contains(name)).collect();
        let [only] = all[..] else { panic!("{}: no interval of {name} is assumed", self.name) };
        let is_interval = only.interval().is_some_and(|(x, ..)| x == name);
        assert!(is_interval, "{}: {only} is not an interval of {name}", self.name);
        assert!(
            self.computes.iter().all(|(other, _)| *other != name),
            "{}: {name} is computed already",
            self.name
        );
        self.computes.push((name, by.into()));
        self.derived()
    }

    /// Returns the statement without one of its [hypotheses](Self::hypotheses).
    pub fn without(&self, hypothesis: &Hypothesis) -> Self {
        let mut less = self.clone();
        less.stated.retain(|stated| stated != hypothesis);
        less.derived()
    }

    /// Returns another proposition under the same hypotheses.
    pub fn with_proposition(&self, proposition: Proposition) -> Self {
        let form = Form::Propositions(vec![("", proposition)]);
        Statement { form, computes: Vec::new(), ..self.clone() }.derived()
    }

    /// Returns the statement with each formula mapped, also in its hypotheses.
    pub fn map(&self, f: &impl Fn(&Tree) -> Tree) -> Self {
        let stated =
            self.stated.iter().map(|stated| Hypothesis { value: f(&stated.value), ..stated.clone() });
        let form = match &self.form {
            Form::Propositions(all) => Form::Propositions(
                all.iter().map(|(part, proposition)| (*part, proposition.map(f))).collect(),
            ),
            Form::Sequence(sequence) => Form::Sequence(sequence.map(f)),
        };
        let computes = self.computes.iter().map(|(name, by)| (*name, f(by))).collect();
        Statement { stated: stated.collect(), form, computes, ..self.clone() }.derived()
    }

    /// Returns the equation number that the statement belongs to; empty if there is none.
    pub fn equation(&self) -> &'static str {
        self.equation
    }

    /// Returns its name, unique within the equation.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the kind of statement: `equal`, `sign`, `bound`, `derivative`, `limit`, `induction`, `drift`
    /// or `vanishing`.
    pub fn kind(&self) -> &'static str {
        match &self.form {
            Form::Propositions(all) => all[0].1.kind(),
            Form::Sequence(sequence) => sequence.kind(),
        }
    }

    /// Returns the hypotheses as they are stated, in their order.
    pub fn stated_hypotheses(&self) -> &[Hypothesis] {
        &self.stated
    }

    /// Returns the hypotheses that every goal may use: those stated, except for invariants and intervals of
    /// computed quantities, and the [minimum precision](minimum_precision) if formulas contain roundings.
    pub fn hypotheses(&self) -> &[Hypothesis] {
        &self.hypotheses
    }

    /// Returns the hypotheses on q or a member of the sequence, which are proved by induction and not
    /// assumed.
    pub fn invariants(&self) -> &[Hypothesis] {
        &self.invariants
    }

    /// Returns the computed quantities, each after those that it is computed from.
    pub fn computed(&self) -> &[Computed] {
        &self.computed
    }

    /// Returns the goals, which together are the statement.
    pub fn goals(&self) -> &[Goal] {
        &self.goals
    }

    /// Returns the sequence that the statement is about, if it is about one.
    pub fn conclusion(&self) -> Option<&Sequence> {
        match &self.form {
            Form::Propositions(_) => None,
            Form::Sequence(sequence) => Some(sequence),
        }
    }

    /// Returns `true` if it concerns rounding to any precision.
    pub fn contains_rounding(&self) -> bool {
        self.contains_rounding
    }

    /// Returns `true` if a formula contains eˣ, which rationals cannot compute.
    pub fn contains_exponential(&self) -> bool {
        self.formulas().any(|tree| tree.any(&|tree| matches!(tree.op(), Op::Exp(_))))
    }

    /// Returns all hypotheses, including the invariants and the intervals of computed quantities.
    pub fn all_hypotheses(&self) -> impl Iterator<Item = &Hypothesis> + Clone {
        let computed = self.computed.iter().map(|computed| &computed.hypothesis);
        self.hypotheses.iter().chain(&self.invariants).chain(computed)
    }

    /// Returns the hypotheses that a goal with this role may use.
    pub fn hypotheses_for(&self, role: Role) -> Vec<&Hypothesis> {
        let uses_invariants = matches!(role, Role::Computed(_) | Role::Step | Role::InvariantStep);
        let computed = match role {
            Role::Claim | Role::Step | Role::InvariantStep => &self.computed[..],
            Role::Computed(before) => &self.computed[..before],
            Role::InvariantBase => &[],
        };
        let invariants = self.invariants.iter().filter(|_| uses_invariants);
        let computed = computed.iter().map(|computed| &computed.hypothesis);
        self.hypotheses.iter().chain(invariants).chain(computed).collect()
    }

    /// Returns the formulas of all hypotheses and goals.
    pub fn trees(&self) -> impl Iterator<Item = &Tree> + Clone {
        let hypotheses = self.all_hypotheses().map(|h| &h.value);
        hypotheses.chain(self.goals.iter().flat_map(|goal| goal.proposition.trees()))
    }

    /// Returns the formulas of the statement without those of the hypotheses.
    pub(crate) fn formulas(&self) -> impl Iterator<Item = &Tree> {
        let (propositions, sequence) = match &self.form {
            Form::Propositions(all) => (&all[..], None),
            Form::Sequence(sequence) => (&[][..], Some(sequence)),
        };
        let of_propositions = propositions.iter().flat_map(|(_, proposition)| proposition.trees());
        let computed = self.computes.iter().map(|(_, by)| by);
        of_propositions.chain(sequence.into_iter().flat_map(Sequence::trees)).chain(computed)
    }
}

/// Returns the hypothesis that the precision is at least 2 bits, which holds wherever formulas contain
/// roundings.
pub fn minimum_precision() -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, Tree::symbol(PRECISION) - Tree::from(4))
}

//! Controls: what must not be provable, made from what is.
//!
//! A proof of every claim shows little if the claims say little, or if the kernel proves anything. So the
//! sources are changed in small ways, each [`Change`] at one place, and the claims that are touched have to notice:
//! one of them gets a counterexample in numbers. And each hypothesis of each claim is dropped in turn; if the
//! claim still holds, the hypothesis should go.
//!
//! No control is written by hand, and nothing is compiled anew: the formulas are recorded as trees, whose steps
//! know where they are written. A formula that the chapter itself differentiates in dual numbers is recorded as
//! the duals compute it, and a change does not reach into these steps. Where a claim speaks of such a
//! formula, other claims are asked first.

use super::kernel::prove;
use super::refute::{Counterexample, Points};
use crate::formula::statement::{Goal, Says, Statement};
use crate::formula::{Hypothesis, Registry};
use crate::number::Tree;
use crate::number::tree::{Site, Step};
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};
use std::fmt;

/// A small edit of the source: what is done to the step that is written at a site.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Change {
    /// Where.
    pub site: Site,
    /// What.
    pub what: What,
}

/// What is edited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum What {
    /// + becomes −, × becomes ÷, and the other way round.
    Opposite(Operator),
    /// Only the first operand is kept.
    First(Operator),
    /// Only the second operand is kept.
    Second(Operator),
    /// The operands of − or ÷ trade places.
    Swap(Operator),
    /// min becomes max.
    Maximum,
    /// The sign before an operand is dropped.
    DropSign,
    /// eᵃ becomes e⁻ᵃ.
    NegateExponent,
    /// ⟨a⟩ becomes a.
    DropBracket,
    /// n becomes n + 1.
    Next(i32),
    /// In this operand, the first being 0, a symbol becomes another of the same unit.
    Symbol(usize, &'static str, &'static str),
}

/// An operator of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operator {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a × b
    Mul,
    /// a ÷ b
    Div,
    /// min(a, b)
    Min,
}

impl Operator {
    fn of(step: &Step<Tree>) -> Option<(Self, &Tree, &Tree)> {
        match step {
            Step::Add(a, b) => Some((Operator::Add, a, b)),
            Step::Sub(a, b) => Some((Operator::Sub, a, b)),
            Step::Mul(a, b) => Some((Operator::Mul, a, b)),
            Step::Div(a, b) => Some((Operator::Div, a, b)),
            Step::Min(a, b) => Some((Operator::Min, a, b)),
            Step::Symbol(_) | Step::Int(_) | Step::Neg(_) | Step::Exp(_) | Step::PositivePart(_) => None,
        }
    }

    fn opposite(self) -> Option<Self> {
        match self {
            Operator::Add => Some(Operator::Sub),
            Operator::Sub => Some(Operator::Add),
            Operator::Mul => Some(Operator::Div),
            Operator::Div => Some(Operator::Mul),
            Operator::Min => None,
        }
    }

    fn commutes(self) -> bool {
        match self {
            Operator::Add | Operator::Mul | Operator::Min => true,
            Operator::Sub | Operator::Div => false,
        }
    }

    fn step(self, a: Tree, b: Tree) -> Step<Tree> {
        match self {
            Operator::Add => Step::Add(a, b),
            Operator::Sub => Step::Sub(a, b),
            Operator::Mul => Step::Mul(a, b),
            Operator::Div => Step::Div(a, b),
            Operator::Min => Step::Min(a, b),
        }
    }

    fn sign(self) -> &'static str {
        match self {
            Operator::Add => "+",
            Operator::Sub => "−",
            Operator::Mul => "×",
            Operator::Div => "÷",
            Operator::Min => "min",
        }
    }

    fn between(self, a: &str, b: &str) -> String {
        match self {
            Operator::Min => format!("min({a}, {b})"),
            Operator::Add | Operator::Sub | Operator::Mul | Operator::Div => {
                format!("{a} {} {b}", self.sign())
            }
        }
    }
}

impl What {
    /// All that can be done to a step.
    fn all(tree: &Tree, registry: &Registry) -> Vec<What> {
        let mut all = Vec::new();
        match tree.step() {
            Step::Symbol(_) => {}
            Step::Int(n) => all.push(What::Next(*n)),
            Step::Neg(_) => all.push(What::DropSign),
            Step::Exp(_) => all.push(What::NegateExponent),
            Step::PositivePart(_) => all.push(What::DropBracket),
            Step::Min(..) => all.push(What::Maximum),
            Step::Add(..) | Step::Sub(..) | Step::Mul(..) | Step::Div(..) => {}
        }
        if let Some((operator, ..)) = Operator::of(tree.step()) {
            all.extend(operator.opposite().map(|_| What::Opposite(operator)));
            all.extend([What::First(operator), What::Second(operator)]);
            all.extend((!operator.commutes()).then_some(What::Swap(operator)));
        }
        for (place, operand) in tree.step().operands().enumerate() {
            if let Step::Symbol(name) = operand.step() {
                all.extend(registry.mistaken_for(name).map(|other| What::Symbol(place, name, other)));
            }
        }
        all
    }

    /// The step after the edit; `None` if there is nothing to edit.
    fn edit(self, tree: &Tree) -> Option<Tree> {
        match self {
            What::Opposite(operator) => {
                let (own, a, b) = Operator::of(tree.step())?;
                (own == operator).then_some(())?;
                Some(tree.with_step(operator.opposite()?.step(a.clone(), b.clone())))
            }
            What::First(operator) | What::Second(operator) | What::Swap(operator) => {
                let (own, a, b) = Operator::of(tree.step())?;
                (own == operator).then_some(())?;
                Some(match self {
                    What::First(_) => a.clone(),
                    What::Second(_) => b.clone(),
                    _ => tree.with_step(operator.step(b.clone(), a.clone())),
                })
            }
            What::Maximum => {
                let Step::Min(a, b) = tree.step() else { return None };
                let negated = |a: &Tree| tree.with_step(Step::Neg(a.clone()));
                Some(negated(&tree.with_step(Step::Min(negated(a), negated(b)))))
            }
            What::DropSign => {
                let Step::Neg(a) = tree.step() else { return None };
                Some(a.clone())
            }
            What::NegateExponent => {
                let Step::Exp(a) = tree.step() else { return None };
                Some(tree.with_step(Step::Exp(tree.with_step(Step::Neg(a.clone())))))
            }
            What::DropBracket => {
                let Step::PositivePart(a) = tree.step() else { return None };
                Some(a.clone())
            }
            What::Next(n) => {
                let Step::Int(own) = tree.step() else { return None };
                (*own == n).then(|| tree.with_step(Step::Int(n + 1)))
            }
            What::Symbol(place, from, to) => {
                let mut index = 0..;
                let mut replaced = false;
                let step = tree.step().map(|operand| {
                    let here = index.next() == Some(place) && *operand.step() == Step::Symbol(from);
                    replaced |= here;
                    if here { operand.with_step(Step::Symbol(to)) } else { operand.clone() }
                });
                replaced.then(|| tree.with_step(step))
            }
        }
    }
}

impl fmt::Display for What {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            What::Opposite(operator) => {
                write!(f, "{} → {}", operator.sign(), operator.opposite().map_or("", Operator::sign))
            }
            What::First(operator) => write!(f, "{} → a", operator.between("a", "b")),
            What::Second(operator) => write!(f, "{} → b", operator.between("a", "b")),
            What::Swap(operator) => {
                write!(f, "{} → {}", operator.between("a", "b"), operator.between("b", "a"))
            }
            What::Maximum => f.write_str("min → max"),
            What::DropSign => f.write_str("−a → a"),
            What::NegateExponent => f.write_str("exp(a) → exp(−a)"),
            What::DropBracket => f.write_str("⟨a⟩ → a"),
            What::Next(n) => write!(f, "{n} → {}", n + 1),
            What::Symbol(place, from, to) => {
                write!(f, "{from} → {to} in operand {}", place + 1)
            }
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} {}", self.site, self.what)
    }
}

#[cfg(feature = "serde")]
crate::number::serialize_as_displayed!(Change);

impl Change {
    fn edit(&self, tree: &Tree) -> Option<Tree> {
        if tree.site() == self.site { self.what.edit(tree) } else { None }
    }

    /// The statement after the change, in its hypotheses and its goals; `None` if it does not touch it.
    pub fn apply(&self, statement: &Statement) -> Option<Statement> {
        statement.trees().any(|tree| self.touches(tree)).then(|| statement.map(&|tree| self.rewrite(tree)))
    }

    fn touches(&self, tree: &Tree) -> bool {
        tree.any(&|tree| self.edit(tree).is_some())
    }

    /// A formula after the change.
    pub fn rewrite(&self, tree: &Tree) -> Tree {
        tree.rewrite(&|tree| self.edit(tree))
    }

    /// Is every formula of the chapter that it changes in the statement equal to what it was, and provably so?
    ///
    /// Not the edited step itself has to be, but some formula of the chapter that it is a part of: in (a − b)² the
    /// operands of − may trade places. That the claim's own formulas stay the same would say too little: it could
    /// multiply by 0.
    fn changes_nothing(&self, statement: &Statement, registry: &Registry) -> bool {
        statement.trees().all(|tree| self.keeps(tree, statement, registry))
    }

    fn keeps(&self, tree: &Tree, statement: &Statement, registry: &Registry) -> bool {
        if !self.touches(tree) {
            return true;
        }
        let equal = |after| {
            let says = Says::Equal(tree.clone(), after);
            let goals = vec![Goal::of_claim("unchanged", says)];
            prove(&Statement { goals, ..statement.clone() }).is_ok()
        };
        registry.has_site(&tree.site()) && equal(self.rewrite(tree))
            || self.edit(tree).is_none()
                && tree.step().operands().all(|operand| self.keeps(operand, statement, registry))
    }
}

/// Every change of a function of the registry that one of the statements can see.
pub fn changes(statements: &[Statement], registry: &Registry) -> Vec<Change> {
    let mut all = BTreeSet::new();
    for tree in statements.iter().flat_map(Statement::trees) {
        tree.visit(&mut |tree| {
            let site = tree.site();
            if registry.has_site(&site) {
                all.extend(What::all(tree, registry).into_iter().map(|what| Change { site, what }));
            }
        });
    }
    all.into_iter().collect()
}

/// What became of a change.
#[derive(Clone, Debug)]
pub enum Effect {
    /// A claim no longer holds.
    Noticed {
        /// The claim's entry.
        equation: &'static str,
        /// Its name.
        name: &'static str,
        /// Where it does not hold.
        counterexample: Counterexample,
    },
    /// It is proved that every formula stays what it was.
    Unchanged,
    /// Neither.
    Unnoticed,
}

/// What became of a claim without one of its hypotheses.
#[derive(Clone, Debug)]
pub enum Without {
    /// It does not hold: the hypothesis is needed.
    Refuted(Counterexample),
    /// It is proved: the hypothesis is not needed.
    StillTrue,
    /// Neither.
    Unknown,
}

/// A hypothesis dropped.
#[derive(Clone, Debug)]
pub struct Dropped {
    /// The claim's entry.
    pub equation: &'static str,
    /// Its name.
    pub name: &'static str,
    /// The hypothesis.
    pub given: Hypothesis,
    /// What became of the claim.
    pub without: Without,
}

/// All controls and what became of them.
#[derive(Clone, Debug, Default)]
pub struct Controls {
    /// In the order of the source.
    pub changes: Vec<(Change, Effect)>,
    /// In the order of the statements.
    pub dropped: Vec<Dropped>,
}

/// What changes came to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Summary {
    /// Changes.
    pub changes: usize,
    /// Of these, noticed by a claim.
    pub noticed: usize,
    /// Proved to change nothing.
    pub unchanged: usize,
    /// Neither.
    pub unnoticed: usize,
}

impl Controls {
    /// How many changes came to what.
    pub fn summary(&self) -> Summary {
        let count = |of: fn(&Effect) -> bool| self.changes.iter().filter(|(_, effect)| of(effect)).count();
        Summary {
            changes: self.changes.len(),
            noticed: count(|effect| matches!(effect, Effect::Noticed { .. })),
            unchanged: count(|effect| matches!(effect, Effect::Unchanged)),
            unnoticed: count(|effect| matches!(effect, Effect::Unnoticed)),
        }
    }

    /// Hypotheses that are not seen to be needed: without them the claim is not refuted.
    pub fn needless(&self) -> impl Iterator<Item = &Dropped> {
        self.dropped.iter().filter(|dropped| !matches!(dropped.without, Without::Refuted(_)))
    }
}

/// Runs all controls, in parallel.
pub fn controls(statements: &[Statement], registry: &Registry) -> Controls {
    let bench = Bench::new(statements, registry);
    let changes = changes(statements, registry);
    let changes = changes.into_par_iter().map(|change| (change, bench.effect(&change))).collect();
    let all = |of: usize| (0..statements[of].hypotheses.len()).map(move |i| (of, i));
    let hypotheses: Vec<_> = (0..statements.len()).flat_map(all).collect();
    let dropped = hypotheses.into_par_iter().map(|(of, i)| Dropped {
        equation: statements[of].equation,
        name: statements[of].name,
        given: statements[of].hypotheses[i].clone(),
        without: bench.without(of, i),
    });
    Controls { changes, dropped: dropped.collect() }
}

/// The changes that would make all of these statements provable, if some of them are not: where a mistake in the
/// chapter may be.
pub fn repairs(statements: &[Statement], registry: &Registry) -> Vec<Change> {
    let (right, wrong): (Vec<_>, Vec<_>) = statements.par_iter().partition(|s| prove(s).is_ok());
    let repairs = |change: &Change| {
        wrong.iter().all(|s| change.apply(s).is_some_and(|s| prove(&s).is_ok()))
            && right.iter().all(|s| change.apply(s).is_none_or(|s| prove(&s).is_ok()))
    };
    if wrong.is_empty() {
        Vec::new()
    } else {
        changes(statements, registry).into_par_iter().filter(repairs).collect()
    }
}

/// What many controls share.
struct Bench<'a> {
    statements: &'a [Statement],
    registry: &'a Registry,
    symbols: Vec<&'static str>,
    /// The statements in which a site occurs, the cheapest first.
    by_site: HashMap<Site, Vec<usize>>,
    /// For all that is supposed somewhere, or is after one hypothesis is dropped.
    points: Vec<Points>,
    /// Where those of a statement are, and those without one of its hypotheses.
    own: Vec<usize>,
    less: Vec<Vec<usize>>,
}

impl<'a> Bench<'a> {
    fn new(statements: &'a [Statement], registry: &'a Registry) -> Self {
        let symbols = registry.symbols_of(statements.iter().flat_map(Statement::trees));
        let mut by_site: HashMap<Site, BTreeSet<(bool, usize, usize)>> = HashMap::new();
        for (index, statement) in statements.iter().enumerate() {
            let (mut steps, mut duals, mut sites) = (0, false, BTreeSet::new());
            for tree in statement.trees() {
                tree.visit(&mut |tree| {
                    let site = tree.site();
                    steps += 1;
                    duals |= site.is_of_duals();
                    if registry.has_site(&site) {
                        sites.insert(site);
                    }
                });
            }
            for site in sites {
                by_site.entry(site).or_default().insert((duals, steps, index));
            }
        }
        let indices = |of: BTreeSet<(bool, usize, usize)>| of.into_iter().map(|(.., i)| i).collect();
        let by_site = by_site.into_iter().map(|(site, of)| (site, indices(of))).collect();
        let mut combinations: Vec<Vec<Hypothesis>> = Vec::new();
        let mut place = |hypotheses: Vec<Hypothesis>| {
            let known = combinations.iter().position(|known| *known == hypotheses);
            known.unwrap_or_else(|| {
                combinations.push(hypotheses);
                combinations.len() - 1
            })
        };
        let own = statements.iter().map(|s| place(s.hypotheses.clone())).collect();
        let mut less = |s: &Statement| {
            (0..s.hypotheses.len()).map(|i| place(s.without(i).hypotheses)).collect::<Vec<_>>()
        };
        let less = statements.iter().map(&mut less).collect();
        let points = combinations.into_par_iter().map(|of| Points::of(of, symbols.clone())).collect();
        Bench { statements, registry, symbols, by_site, points, own, less }
    }

    fn effect(&self, change: &Change) -> Effect {
        let touched = || {
            let statements = self.by_site.get(&change.site).into_iter().flatten();
            statements.filter_map(|&i| Some((i, change.apply(&self.statements[i])?)))
        };
        let noticed = |(i, changed): (usize, Statement), thoroughly: bool| {
            let original = &self.statements[i];
            let own = (original.hypotheses != changed.hypotheses)
                .then(|| Points::of(changed.hypotheses.clone(), self.symbols.clone()));
            let points = own.as_ref().unwrap_or(&self.points[self.own[i]]);
            let counterexample =
                if thoroughly { points.thoroughly(&changed) } else { points.quickly(&changed) }?;
            Some(Effect::Noticed { equation: original.equation, name: original.name, counterexample })
        };
        let unchanged = || touched().all(|(i, _)| change.changes_nothing(&self.statements[i], self.registry));
        touched()
            .find_map(|pair| noticed(pair, false))
            .or_else(|| unchanged().then_some(Effect::Unchanged))
            .or_else(|| touched().find_map(|pair| noticed(pair, true)))
            .unwrap_or(Effect::Unnoticed)
    }

    fn without(&self, statement: usize, hypothesis: usize) -> Without {
        let less = self.statements[statement].without(hypothesis);
        let points = &self.points[self.less[statement][hypothesis]];
        match points.quickly(&less) {
            Some(counterexample) => Without::Refuted(counterexample),
            None if prove(&less).is_ok() => Without::StillTrue,
            None => points.thoroughly(&less).map_or(Without::Unknown, Without::Refuted),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::{Claim, Formula, Kind, Relation};
    use crate::number::{Exponential, Field, PositivePart};

    #[test]
    fn every_edit_is_as_it_is_displayed() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let registry = Registry::default().alike(&[["c", "ε"]]);
        let edited = |tree: &Tree, expected: &[(&str, Tree)]| {
            let edit = |what: What| (what.to_string(), what.edit(tree).unwrap());
            let edits: Vec<_> = What::all(tree, &registry).into_iter().map(edit).collect();
            let expected: Vec<_> =
                expected.iter().map(|(text, tree)| (text.to_string(), tree.clone())).collect();
            assert_eq!(edits, expected);
        };
        let [first, second] = [&a, &b].map(Tree::clone);
        let kept = |sign| [format!("a {sign} b → a"), format!("a {sign} b → b")];
        let [to_a, to_b] = kept("+");
        edited(&(&a + &b), &[("+ → −", &a - &b), (&to_a, first.clone()), (&to_b, second.clone())]);
        let [to_a, to_b] = kept("−");
        let swapped = ("a − b → b − a", &b - &a);
        edited(&(&a - &b), &[("− → +", &a + &b), (&to_a, first.clone()), (&to_b, second.clone()), swapped]);
        let [to_a, to_b] = kept("×");
        edited(&(&a * &b), &[("× → ÷", &a / &b), (&to_a, first.clone()), (&to_b, second.clone())]);
        edited(&-&a, &[("−a → a", first.clone())]);
        edited(&-&c, &[("−a → a", c.clone()), ("c → ε in operand 1", -Tree::symbol("ε"))]);
        edited(&Tree::int(2), &[("2 → 3", Tree::int(3))]);
        edited(&a.exp(), &[("exp(a) → exp(−a)", (-&a).exp())]);
        edited(&a.positive_part(), &[("⟨a⟩ → a", first.clone())]);
        let maximum = ("min → max", -(-&a).min(&-&b));
        edited(&a.min(&b), &[maximum, ("min(a, b) → a", first), ("min(a, b) → b", second)]);
    }

    /// k = (a − b)² + a
    fn squared(a: &Tree, b: &Tree) -> Tree {
        let difference = a - b;
        &difference * &difference + a
    }

    fn x(name: &'static str) -> Tree {
        Tree::symbol(name)
    }

    fn registry() -> Registry {
        Registry::new(&["a", "b"], vec![Formula::new("squared", "k", &["a", "b"], squared(&x("a"), &x("b")))])
    }

    fn expanded(name: &'static str, given: &[&Hypothesis]) -> Statement {
        let [a, b] = ["a", "b"].map(x);
        let sum = &a * &a - Tree::from(2) * &a * &b + &b * &b + &a;
        Statement::of(&Claim::new(name, given, Kind::Equal(squared(&a, &b), sum)))
    }

    #[test]
    fn what_does_not_matter_is_proved_not_to() {
        let statements = [expanded("expanded", &[])];
        let Controls { changes, .. } = controls(&statements, &registry());
        let kept = changes.iter().filter(|(_, outcome)| matches!(outcome, Effect::Unchanged));
        assert_eq!(kept.map(|(change, _)| change.what).collect::<Vec<_>>(), [What::Swap(Operator::Sub)]);
        assert_eq!(controls(&statements, &registry()).summary().unnoticed, 0);
    }

    /// A claim that supposes more than it needs, and more than it could need: dropped, the one is no loss, the other is.
    #[test]
    fn a_needless_hypothesis_is_told_from_a_needed_one() {
        let [above, below] = ["a", "b"].map(|name| Hypothesis::new(Relation::Positive, x(name)));
        // a/a = 1 needs a > 0, whatever b is.
        let claim = Claim::new("one", &[&above, &below], Kind::Equal(x("a") / x("a"), Tree::from(1)));
        let controls = controls(&[Statement::of(&claim)], &registry());
        let became =
            |given: &Hypothesis| controls.dropped.iter().find(|d| d.given == *given).map(|d| &d.without);
        assert!(matches!(became(&above), Some(Without::Refuted(_))), "{:?}", controls.dropped);
        assert!(matches!(became(&below), Some(Without::StillTrue)), "{:?}", controls.dropped);
        let needless: Vec<_> = controls.needless().map(|dropped| &dropped.given).collect();
        assert_eq!((controls.dropped.len(), needless), (2, vec![&below]));
    }

    #[test]
    fn a_repair_mends_what_is_wrong_and_breaks_nothing() {
        let (right, registry) = (expanded("expanded", &[]), registry());
        let twice = Statement::of(&Claim::new("same", &[], Kind::Equal(squared(&x("a"), &x("a")), x("a"))));
        // (a + b)² in all that is said: its + is the mistake.
        let change = |what: What| {
            let all = changes(std::slice::from_ref(&right), &registry);
            all.into_iter().find(|change| change.what == what).unwrap()
        };
        let mistake = change(What::Opposite(Operator::Sub));
        let wrong = [&right, &twice].map(|statement| mistake.apply(statement).unwrap());
        let undone = Change { what: What::Opposite(Operator::Add), ..mistake };
        assert!(repairs(&wrong, &registry).contains(&undone));
        assert!(repairs(&[right.clone(), twice.clone()], &registry).is_empty(), "nothing is wrong");
        // Whoever claims k = (a + b)² + a must not be obeyed against all that k = (a − b)² + a is claimed in.
        let [a, b] = ["a", "b"].map(x);
        let says = Kind::Equal(squared(&a, &b), (&a + &b) * (&a + &b) + &a);
        let mistaken = Statement::of(&Claim::new("mistaken", &[], says));
        assert!(repairs(std::slice::from_ref(&mistaken), &registry).contains(&mistake));
        assert!(!repairs(&[mistaken, right], &registry).contains(&mistake));
    }
}

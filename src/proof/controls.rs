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
use super::statement::{Goal, Hypothesis, Says, Statement};
use crate::claims::Given;
use crate::number::Tree;
use crate::number::tree::{Site, Step};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};
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

/// Symbols of one unit, which a writer may mistake for each other.
const ALIKE: [[&str; 2]; 2] = [["c", "ε"], ["l", "H"]];

impl What {
    /// All that can be done to a step.
    fn all(tree: &Tree) -> Vec<What> {
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
                let pairs = ALIKE.iter().flat_map(|&[a, b]| [(a, b), (b, a)]);
                all.extend(pairs.filter(|(a, _)| a == name).map(|(a, b)| What::Symbol(place, a, b)));
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
    fn changes_nothing(&self, statement: &Statement) -> bool {
        statement.trees().all(|tree| self.keeps(tree, statement))
    }

    fn keeps(&self, tree: &Tree, statement: &Statement) -> bool {
        if !self.touches(tree) {
            return true;
        }
        let equal = |after| {
            let says = Says::Equal(tree.clone(), after);
            let goals = vec![Goal::of_claim("unchanged", says)];
            prove(&Statement { goals, ..statement.clone() }).is_ok()
        };
        tree.site().is_of_the_chapter() && equal(self.rewrite(tree))
            || self.edit(tree).is_none()
                && tree.step().operands().all(|operand| self.keeps(operand, statement))
    }
}

/// Every change of a formula in `src/chapter` that one of the statements can see.
pub fn changes(statements: &[Statement]) -> Vec<Change> {
    let mut all = BTreeSet::new();
    for tree in statements.iter().flat_map(Statement::trees) {
        tree.visit(&mut |tree| {
            let site = tree.site();
            if site.is_of_the_chapter() {
                all.extend(What::all(tree).into_iter().map(|what| Change { site, what }));
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
    pub given: Given,
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
pub fn controls(statements: &[Statement]) -> Controls {
    let bench = Bench::new(statements);
    let changes = changes(statements);
    let changes = changes.into_par_iter().map(|change| (change, bench.effect(&change))).collect();
    let hypotheses: Vec<_> =
        statements.iter().flat_map(|s| (0..s.hypotheses.len()).map(move |i| (s, i))).collect();
    let dropped = hypotheses.into_par_iter().map(|(statement, i)| Dropped {
        equation: statement.equation,
        name: statement.name,
        given: statement.hypotheses[i].given,
        without: bench.without(statement, i),
    });
    Controls { changes, dropped: dropped.collect() }
}

/// The changes that would make all of these statements provable, if some of them are not: where a mistake in the
/// chapter may be.
pub fn repairs(statements: &[Statement]) -> Vec<Change> {
    let (right, wrong): (Vec<_>, Vec<_>) = statements.par_iter().partition(|s| prove(s).is_ok());
    let repairs = |change: &Change| {
        wrong.iter().all(|s| change.apply(s).is_some_and(|s| prove(&s).is_ok()))
            && right.iter().all(|s| change.apply(s).is_none_or(|s| prove(&s).is_ok()))
    };
    if wrong.is_empty() { Vec::new() } else { changes(statements).into_par_iter().filter(repairs).collect() }
}

/// What many controls share.
struct Bench<'a> {
    statements: &'a [Statement],
    /// The statements in which a site occurs, the cheapest first.
    by_site: HashMap<Site, Vec<usize>>,
    /// By the hypotheses as they are in the source.
    points: BTreeMap<String, Points>,
}

fn key(hypotheses: &[Hypothesis]) -> String {
    hypotheses.iter().map(|hypothesis| hypothesis.given.text()).collect::<Vec<_>>().join(", ")
}

impl<'a> Bench<'a> {
    fn new(statements: &'a [Statement]) -> Self {
        let mut by_site: HashMap<Site, BTreeSet<(bool, usize, usize)>> = HashMap::new();
        let mut combinations = BTreeMap::new();
        for (index, statement) in statements.iter().enumerate() {
            let (mut steps, mut duals, mut sites) = (0, false, BTreeSet::new());
            for tree in statement.trees() {
                tree.visit(&mut |tree| {
                    let site = tree.site();
                    steps += 1;
                    duals |= site.is_of_duals();
                    if site.is_of_the_chapter() {
                        sites.insert(site);
                    }
                });
            }
            for site in sites {
                by_site.entry(site).or_default().insert((duals, steps, index));
            }
            for i in 0..statement.hypotheses.len() {
                let less = statement.without(i).hypotheses;
                combinations.insert(key(&less), less);
            }
            combinations.insert(key(&statement.hypotheses), statement.hypotheses.clone());
        }
        let indices = |of: BTreeSet<(bool, usize, usize)>| of.into_iter().map(|(.., i)| i).collect();
        let by_site = by_site.into_iter().map(|(site, of)| (site, indices(of))).collect();
        let points = combinations.into_par_iter().map(|(key, of)| (key, Points::of(&of))).collect();
        Bench { statements, by_site, points }
    }

    fn effect(&self, change: &Change) -> Effect {
        let touched = || {
            let statements =
                self.by_site.get(&change.site).into_iter().flatten().map(|i| &self.statements[*i]);
            statements.filter_map(|statement| Some((statement, change.apply(statement)?)))
        };
        let noticed = |(original, changed): (&Statement, Statement), thoroughly: bool| {
            let same = original.hypotheses.iter().zip(&changed.hypotheses).all(|(a, b)| a.value == b.value);
            let cached = if same { self.points.get(&key(&original.hypotheses)) } else { None };
            let own = if cached.is_none() { Some(Points::of(&changed.hypotheses)) } else { None };
            let points = cached.or(own.as_ref())?;
            let counterexample =
                if thoroughly { points.thoroughly(&changed) } else { points.quickly(&changed) }?;
            Some(Effect::Noticed { equation: original.equation, name: original.name, counterexample })
        };
        let unchanged = || touched().all(|(original, _)| change.changes_nothing(original));
        touched()
            .find_map(|pair| noticed(pair, false))
            .or_else(|| unchanged().then_some(Effect::Unchanged))
            .or_else(|| touched().find_map(|pair| noticed(pair, true)))
            .unwrap_or(Effect::Unnoticed)
    }

    fn without(&self, statement: &Statement, hypothesis: usize) -> Without {
        let less = statement.without(hypothesis);
        let Some(points) = self.points.get(&key(&less.hypotheses)) else { return Without::Unknown };
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
    use crate::number::{Exponential, Field, PositivePart};

    #[test]
    fn the_chapter_is_found_by_either_separator() {
        let is_there = |file| Site { file, line: 1, column: 1, rank: 0 }.is_of_the_chapter();
        assert!(is_there("src/chapter/penalty.rs"));
        assert!(is_there("src\\chapter\\penalty.rs"));
        assert!(is_there("elsewhere/src/chapter/penalty.rs"));
        assert!(!is_there("src/claims/list.rs"));
        assert!(!is_there("chapter/penalty.rs"));
    }

    #[test]
    fn every_edit_is_as_it_is_displayed() {
        let [a, b, c] = ["a", "b", "c"].map(|name| Tree::symbol(name));
        let edited = |tree: &Tree, expected: &[(&str, Tree)]| {
            let edit = |what: What| (what.to_string(), what.edit(tree).unwrap());
            let edits: Vec<_> = What::all(tree).into_iter().map(edit).collect();
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

    #[test]
    fn what_does_not_matter_is_proved_not_to() {
        let all = crate::proof::statements();
        let statement = all.iter().find(|s| (s.equation, s.name) == ("1.14", "least")).unwrap();
        let kept: Vec<_> = changes(std::slice::from_ref(statement))
            .into_iter()
            .filter(|change| change.changes_nothing(statement))
            .map(|change| change.what)
            .collect();
        assert_eq!(kept, [What::Swap(Operator::Sub)]);
    }

    /// A claim that supposes more than it needs, and more than it could need: dropped, the one is no loss, the other is.
    #[test]
    fn a_needless_hypothesis_is_told_from_a_needed_one() {
        let all = crate::proof::statements();
        let find = |equation, name| all.iter().find(|s| (s.equation, s.name) == (equation, name)).unwrap();
        // u = m g/c needs c > 0, whatever ε is.
        let (root, other) = (find("1.1", "root"), find("1.13", "rate"));
        let penalty = other.hypotheses.iter().find(|h| h.given == Given::Penalty).unwrap();
        let mut hypotheses = root.hypotheses.clone();
        hypotheses.push(penalty.clone());
        let controls = controls(&[Statement { hypotheses, ..root.clone() }]);
        let became =
            |given| controls.dropped.iter().find(|dropped| dropped.given == given).map(|d| &d.without);
        assert!(matches!(became(Given::Stiffness), Some(Without::Refuted(_))), "{:?}", controls.dropped);
        assert!(matches!(became(Given::Penalty), Some(Without::StillTrue)), "{:?}", controls.dropped);
        let needless: Vec<_> = controls.needless().map(|dropped| dropped.given).collect();
        assert_eq!((controls.dropped.len(), needless), (2, vec![Given::Penalty]));
    }

    #[test]
    fn a_repair_mends_what_is_wrong_and_breaks_nothing() {
        let all = crate::proof::statements();
        let find = |equation, name| all.iter().find(|s| (s.equation, s.name) == (equation, name)).unwrap();
        let (force, gap) = (find("1.6", "force-from-deflection"), find("1.5", "at-the-gap"));
        // p = l − u − H in all that the chapter says: its − is the mistake.
        let plus = What::Opposite(Operator::Add);
        let changes = changes(std::slice::from_ref(gap));
        let of_penetration =
            |change: &&Change| change.site.file.ends_with("contact.rs") && change.what == plus;
        let change = changes.iter().find(of_penetration).unwrap();
        let wrong = [force, gap].map(|statement| change.apply(statement).unwrap());
        let undone = Change { what: What::Opposite(Operator::Sub), ..*change };
        assert!(repairs(&wrong).contains(&undone));
        assert!(repairs(&[force.clone(), gap.clone()]).is_empty(), "nothing is wrong");
        // Whoever claims p = l − u − H must not be obeyed against all that p = l + u − H is claimed in.
        let x = crate::claims::Case::of_symbols();
        let [l, u, h] = [&x.system.l, &x.u, &x.system.h];
        let says = Says::Equal(crate::chapter::contact::penetration(&x.system, u), l - u - h);
        let mistaken = Statement { goals: vec![Goal::of_claim("mistaken", says)], ..gap.clone() };
        assert!(repairs(std::slice::from_ref(&mistaken)).contains(change));
        assert!(!repairs(&[mistaken, gap.clone()]).contains(change));
    }
}

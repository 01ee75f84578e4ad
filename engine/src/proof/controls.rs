//! Controls: what must not be provable, made from what is.
//!
//! A proof of every claim shows little if the claims say little, or if the kernel proves anything. So the
//! sources are changed in small ways, each [`Change`] at one place, and the claims that are touched have to
//! notice: one of them gets a counterexample in numbers. And each hypothesis of each claim is dropped in
//! turn; if the claim still holds, the hypothesis should go.
//!
//! No control is written by hand, and nothing is compiled anew: the formulas are recorded as trees, whose
//! steps know where they are written. A formula that itself differentiates in dual numbers is
//! recorded as the duals compute it, and a change does not reach into these steps. Where a claim speaks of
//! such a formula, other claims are asked first.

mod change;

pub use change::{Change, Operator, What, changes, changes_in, possible_repairs};

use super::kernel::prove;
use super::refute::{Points, Refutation};
use crate::formula::claim::PRECISION;
use crate::formula::statement::minimum_precision;
use crate::formula::{Hypothesis, Registry, Statement};
use crate::number::tree::Site;
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};

/// What became of a change.
#[derive(Clone, Debug)]
pub enum Effect {
    /// A claim no longer holds.
    Noticed {
        /// The claim's entry.
        equation: &'static str,
        /// Its name.
        name: &'static str,
        /// Numbers at which it does not hold.
        refutation: Refutation,
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
    Refuted(Refutation),
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

impl Dropped {
    /// Is it one that says how fine numbers have to be, and without which the claim is neither proved nor
    /// refuted? A proof may ask for more than what is true does.
    pub fn is_of_precision(&self) -> bool {
        matches!(self.without, Without::Unknown) && self.given.value.symbols().contains(PRECISION)
    }
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

    /// Hypotheses that are not seen to be needed: without them the claim is not refuted, and they are not
    /// [of the precision](Dropped::is_of_precision) alone.
    pub fn needless(&self) -> impl Iterator<Item = &Dropped> {
        let needed =
            |dropped: &Dropped| matches!(dropped.without, Without::Refuted(_)) || dropped.is_of_precision();
        self.dropped.iter().filter(move |dropped| !needed(dropped))
    }
}

/// Runs all controls, in parallel.
pub fn controls(statements: &[Statement], registry: &Registry) -> Controls {
    let bench = Bench::new(statements, registry);
    let changes = changes(statements, registry);
    let changes = changes.into_par_iter().map(|change| (change, bench.effect(&change))).collect();
    // That a number has two bits goes without saying.
    let all = |of: usize| {
        let said = move |i: &usize| statements[of].hypotheses()[*i] != minimum_precision();
        (0..statements[of].hypotheses().len()).filter(said).map(move |i| (of, i))
    };
    let hypotheses: Vec<_> = (0..statements.len()).flat_map(all).collect();
    let dropped = hypotheses.into_par_iter().map(|(of, i)| Dropped {
        equation: statements[of].equation(),
        name: statements[of].name(),
        given: statements[of].hypotheses()[i].clone(),
        without: bench.without(of, i),
    });
    Controls { changes, dropped: dropped.collect() }
}

/// The changes of one place that would make all of these statements provable, if some of them are not: there
/// may be a mistake in the functions. They are looked for among the [`possible_repairs`].
pub fn repairs(statements: &[Statement], registry: &Registry) -> Vec<Change> {
    // What takes long is asked last.
    let mut by_cost: Vec<_> = statements.iter().collect();
    by_cost.sort_by_key(|s| (s.contains_rounding(), s.goals().len()));
    let (right, wrong): (Vec<_>, Vec<_>) = by_cost.into_par_iter().partition(|s| prove(s).is_ok());
    let repairs = |change: &Change| {
        wrong.iter().all(|s| change.apply(s).is_some_and(|s| prove(&s).is_ok()))
            && right.iter().all(|s| change.apply(s).is_none_or(|s| prove(&s).is_ok()))
    };
    if wrong.is_empty() {
        Vec::new()
    } else {
        possible_repairs(statements, registry).into_par_iter().filter(repairs).collect()
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
        let own = statements.iter().map(|s| place(s.hypotheses().to_vec())).collect();
        let mut less = |s: &Statement| {
            s.hypotheses().iter().map(|h| place(s.without(h).hypotheses().to_vec())).collect::<Vec<_>>()
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
            let own = (original.hypotheses() != changed.hypotheses())
                .then(|| Points::of(changed.hypotheses().to_vec(), self.symbols.clone()));
            let points = own.as_ref().unwrap_or(&self.points[self.own[i]]);
            let refutation = if thoroughly { points.thoroughly(&changed) } else { points.quickly(&changed) }?;
            Some(Effect::Noticed { equation: original.equation(), name: original.name(), refutation })
        };
        let unchanged = || touched().all(|(i, _)| change.changes_nothing(&self.statements[i], self.registry));
        touched()
            .find_map(|pair| noticed(pair, false))
            .or_else(|| unchanged().then_some(Effect::Unchanged))
            .or_else(|| touched().find_map(|pair| noticed(pair, true)))
            .unwrap_or(Effect::Unnoticed)
    }

    fn without(&self, statement: usize, hypothesis: usize) -> Without {
        let own = &self.statements[statement];
        let less = own.without(&own.hypotheses()[hypothesis]);
        let points = &self.points[self.less[statement][hypothesis]];
        match points.quickly(&less) {
            Some(refutation) => Without::Refuted(refutation),
            None if prove(&less).is_ok() => Without::StillTrue,
            None => points.thoroughly(&less).map_or(Without::Unknown, Without::Refuted),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{equal, non_negative};
    use crate::formula::{Formula, Relation};
    use crate::number::Tree;

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

    fn expanded(name: &'static str) -> Statement {
        let [a, b] = ["a", "b"].map(x);
        let sum = &a * &a - Tree::from(2) * &a * &b + &b * &b + &a;
        equal(name, squared(&a, &b), sum)
    }

    #[test]
    fn what_does_not_matter_is_proved_not_to() {
        let statements = [expanded("expanded")];
        let Controls { changes, .. } = controls(&statements, &registry());
        let kept = changes.iter().filter(|(_, outcome)| matches!(outcome, Effect::Unchanged));
        assert_eq!(kept.map(|(change, _)| change.what).collect::<Vec<_>>(), [What::Swap(Operator::Sub)]);
        assert_eq!(controls(&statements, &registry()).summary().unnoticed, 0);
    }

    /// A claim that supposes more than it needs, and more than it could need: dropped, the one is no loss,
    /// the other is.
    #[test]
    fn a_needless_hypothesis_is_told_from_a_needed_one() {
        let [above, below] = ["a", "b"].map(|name| Hypothesis::new(Relation::Positive, x(name)));
        // a/a = 1 needs a > 0, whatever b is.
        let claim = equal("one", x("a") / x("a"), 1).assuming([&above, &below]);
        let controls = controls(&[claim], &registry());
        let became =
            |given: &Hypothesis| controls.dropped.iter().find(|d| d.given == *given).map(|d| &d.without);
        assert!(matches!(became(&above), Some(Without::Refuted(_))), "{:?}", controls.dropped);
        assert!(matches!(became(&below), Some(Without::StillTrue)), "{:?}", controls.dropped);
        let needless: Vec<_> = controls.needless().map(|dropped| &dropped.given).collect();
        assert_eq!((controls.dropped.len(), needless), (2, vec![&below]));
    }

    /// Whatever k is, k ≥ 0 where k ≥ 0: a change of both is not noticed.
    #[test]
    fn a_change_is_tried_where_what_is_supposed_holds_after_it() {
        let k = squared(&x("a"), &x("b"));
        let given = Hypothesis::new(Relation::NonNegative, k.clone());
        let statements = [non_negative("k", k).assuming([&given])];
        let Controls { changes, .. } = controls(&statements, &registry());
        let noticed = changes.iter().find(|(_, outcome)| matches!(outcome, Effect::Noticed { .. }));
        assert!(noticed.is_none() && !changes.is_empty(), "{noticed:?}");
    }

    /// k = a²/4 in place of a²/2, and in place of a²/20, −a²/4 and a²/8.
    #[test]
    fn a_changed_constant_is_repaired() {
        let quarter = |a: &Tree| a * a / Tree::from(4);
        let formula = Formula::new("quarter", "k", &["a"], quarter(&x("a")));
        let registry = Registry::new(&["a"], vec![formula]);
        for right in [2, 20, -4, 8, 1] {
            let statement = equal("half", quarter(&x("a")) * Tree::from(right), x("a") * x("a"));
            let repairs = repairs(&[statement], &registry);
            let found: Vec<_> = repairs.iter().map(|change| change.what.to_string()).collect();
            assert!(found.contains(&format!("4 → {right}")), "{found:?}");
        }
    }

    #[test]
    fn a_repair_mends_what_is_wrong_and_breaks_nothing() {
        let (right, registry) = (expanded("expanded"), registry());
        let twice = equal("same", squared(&x("a"), &x("a")), x("a"));
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
        let mistaken = equal("mistaken", squared(&a, &b), (&a + &b) * (&a + &b) + &a);
        assert!(repairs(std::slice::from_ref(&mistaken), &registry).contains(&mistake));
        assert!(!repairs(&[mistaken, right], &registry).contains(&mistake));
    }
}

//! Mutation tests of claims: changes of formulas and omissions of hypotheses, which must refute a claim.
//!
//! Proofs of all claims show little if the claims are weak or the checker is unsound. So formulas are changed
//! at one place at a time; each [`Mutant`] must make one of the affected claims false, with a counterexample
//! in numbers. Likewise, each hypothesis of each claim is dropped in turn; if the claim still holds, the
//! hypothesis is redundant.
//!
//! All mutations are generated, and none requires compilation: formulas are recorded as trees, whose
//! operations contain their source location. A formula that differentiates by dual numbers is recorded as
//! these compute it, and mutations do not apply to the operations of the dual numbers. Claims without such
//! formulas are therefore evaluated first.

mod mutant;

pub use mutant::{Mutant, Mutation, Operator, mutants, mutants_in, mutated};

use super::prove;
use super::refute::{PointSet, Refutation};
use crate::formula::claim::PRECISION;
use crate::formula::statement::minimum_precision;
use crate::formula::{Hypothesis, Registry, Statement};
use crate::number::tree::Site;
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};

/// The outcome of a mutation.
#[derive(Clone, Debug)]
pub enum MutationOutcome {
    /// A claim no longer holds.
    Detected {
        /// The entry of the claim.
        equation: &'static str,
        /// The name of the claim.
        name: &'static str,
        /// The refutation of the claim.
        refutation: Refutation,
    },
    /// The mutation is proved not to change the value of any formula.
    Equivalent,
    /// No claim detects the mutation, and it is not proved to change nothing.
    Undetected,
}

/// The outcome of dropping a hypothesis of a claim.
#[derive(Clone, Debug)]
pub enum DropOutcome {
    /// The claim does not hold, so the hypothesis is needed.
    Refuted(Refutation),
    /// The claim is proved, so the hypothesis is redundant.
    StillProved,
    /// The claim is neither refuted nor proved.
    Undecided,
}

/// A claim with one hypothesis dropped.
#[derive(Clone, Debug)]
pub struct DroppedHypothesis {
    /// The entry of the claim.
    pub equation: &'static str,
    /// The name of the claim.
    pub name: &'static str,
    /// The dropped hypothesis.
    pub hypothesis: Hypothesis,
    /// The outcome for the claim without the hypothesis.
    pub outcome: DropOutcome,
}

impl DroppedHypothesis {
    /// Returns `true` if the hypothesis bounds the precision and the claim is neither proved nor refuted
    /// without it. A proof may require a higher precision than the claim.
    pub fn is_precision_only(&self) -> bool {
        matches!(self.outcome, DropOutcome::Undecided) && self.hypothesis.value.symbols().contains(PRECISION)
    }
}

/// The outcomes of all mutations and of dropping each hypothesis.
#[derive(Clone, Debug, Default)]
pub struct MutationReport {
    /// The mutants, in the order of the source.
    pub mutants: Vec<(Mutant, MutationOutcome)>,
    /// The dropped hypotheses, in the order of the statements.
    pub dropped: Vec<DroppedHypothesis>,
}

/// The number of mutants by outcome.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MutationSummary {
    /// The number of all mutants.
    pub mutations: usize,
    /// The number of mutants that a claim detects.
    pub detected: usize,
    /// The number of mutants that are proved equivalent to the original.
    pub equivalent: usize,
    /// The number of the other mutants.
    pub undetected: usize,
}

impl MutationReport {
    /// Counts the mutants by outcome.
    pub fn summary(&self) -> MutationSummary {
        let mut summary = MutationSummary { mutations: self.mutants.len(), ..MutationSummary::default() };
        for (_, outcome) in &self.mutants {
            match outcome {
                MutationOutcome::Detected { .. } => summary.detected += 1,
                MutationOutcome::Equivalent => summary.equivalent += 1,
                MutationOutcome::Undetected => summary.undetected += 1,
            }
        }
        summary
    }

    /// Returns the hypotheses whose omission does not make the claim false, except bounds of the
    /// [precision](DroppedHypothesis::is_precision_only).
    pub fn redundant_hypotheses(&self) -> impl Iterator<Item = &DroppedHypothesis> {
        self.dropped.iter().filter(|dropped| {
            !matches!(dropped.outcome, DropOutcome::Refuted(_)) && !dropped.is_precision_only()
        })
    }
}

/// Applies all mutations and drops each hypothesis, in parallel.
pub fn test_mutations(statements: &[Statement], registry: &Registry) -> MutationReport {
    let shared = SharedState::new(statements, registry);
    let mutants = mutants(statements, registry).into_par_iter();
    let mutants = mutants.map(|mutant| (mutant, shared.outcome(&mutant))).collect();
    MutationReport { mutants, dropped: shared.dropped() }
}

/// Like [`test_mutations`], but reports only the mutants that the first points detect. For statements that
/// do not have to detect every mutation of their formulas, this takes a fraction of the time.
pub fn find_detected_mutants(statements: &[Statement], registry: &Registry) -> MutationReport {
    let shared = SharedState::new(statements, registry);
    let mutants = mutants(statements, registry).into_par_iter();
    let mutants = mutants.filter_map(|mutant| Some((mutant, shared.detected(&mutant, false)?))).collect();
    MutationReport { mutants, dropped: shared.dropped() }
}

/// The data that all mutants share.
struct SharedState<'a> {
    statements: &'a [Statement],
    registry: &'a Registry,
    symbols: Vec<&'static str>,
    /// The statements in which a site occurs, the cheapest first.
    by_site: HashMap<Site, Vec<usize>>,
    /// The points for each combination of hypotheses, of a statement or after one is dropped.
    points: Vec<PointSet>,
    /// For each statement, the index of its points.
    all_hypotheses: Vec<usize>,
    /// For each statement and hypothesis, the index of the points without that hypothesis.
    without_one: Vec<Vec<usize>>,
}

impl<'a> SharedState<'a> {
    fn new(statements: &'a [Statement], registry: &'a Registry) -> Self {
        let symbols = registry.symbols_of(statements.iter().flat_map(Statement::trees));
        let by_site = statements_by_site(statements, registry);
        let mut combinations = Vec::new();
        let all_hypotheses = statements.iter().map(|s| index_of(s.hypotheses(), &mut combinations)).collect();
        let mut without_one = Vec::with_capacity(statements.len());
        for statement in statements {
            let hypotheses = statement.hypotheses().iter();
            let indices = hypotheses.map(|h| index_of(statement.without(h).hypotheses(), &mut combinations));
            without_one.push(indices.collect());
        }
        let points = combinations.into_par_iter().map(|of| PointSet::of(of, symbols.clone())).collect();
        SharedState { statements, registry, symbols, by_site, points, all_hypotheses, without_one }
    }

    /// Returns the statements that contain the mutated operation, with the mutation.
    fn affected(&self, mutant: &Mutant) -> impl Iterator<Item = (usize, Statement)> {
        let statements = self.by_site.get(&mutant.site).into_iter().flatten();
        statements.filter_map(|&i| Some((i, mutant.apply(&self.statements[i])?)))
    }

    /// Returns the first refutation of a mutated statement, at the first points or thoroughly at the others.
    fn detected(&self, mutant: &Mutant, thoroughly: bool) -> Option<MutationOutcome> {
        self.affected(mutant).find_map(|(i, mutated)| {
            let original = &self.statements[i];
            let mutated_points = (original.hypotheses() != mutated.hypotheses())
                .then(|| PointSet::of(mutated.hypotheses().to_vec(), self.symbols.clone()));
            let points = mutated_points.as_ref().unwrap_or(&self.points[self.all_hypotheses[i]]);
            let refutation = if thoroughly {
                points.refute_at_other_points(&mutated)
            } else {
                points.refute_at_first_points(&mutated)
            }?;
            Some(MutationOutcome::Detected {
                equation: original.equation(),
                name: original.name(),
                refutation,
            })
        })
    }

    fn outcome(&self, mutant: &Mutant) -> MutationOutcome {
        if let Some(detected) = self.detected(mutant, false) {
            return detected;
        }
        let mut affected = self.affected(mutant);
        if affected.all(|(i, _)| mutant.is_equivalent(&self.statements[i], self.registry)) {
            return MutationOutcome::Equivalent;
        }
        self.detected(mutant, true).unwrap_or(MutationOutcome::Undetected)
    }

    fn dropped(&self) -> Vec<DroppedHypothesis> {
        let mut hypotheses = Vec::new();
        for (of, statement) in self.statements.iter().enumerate() {
            let all = statement.hypotheses().iter().enumerate();
            // The minimum precision of two bits is part of the model of rounding.
            hypotheses.extend(all.filter(|(_, h)| **h != minimum_precision()).map(|(i, _)| (of, i)));
        }
        let dropped = hypotheses.into_par_iter().map(|(of, i)| DroppedHypothesis {
            equation: self.statements[of].equation(),
            name: self.statements[of].name(),
            hypothesis: self.statements[of].hypotheses()[i].clone(),
            outcome: self.without(of, i),
        });
        dropped.collect()
    }

    fn without(&self, statement: usize, hypothesis: usize) -> DropOutcome {
        let original = &self.statements[statement];
        let weakened = original.without(&original.hypotheses()[hypothesis]);
        let points = &self.points[self.without_one[statement][hypothesis]];
        match points.refute_at_first_points(&weakened) {
            Some(refutation) => DropOutcome::Refuted(refutation),
            None if prove(&weakened).is_ok() => DropOutcome::StillProved,
            None => {
                points.refute_at_other_points(&weakened).map_or(DropOutcome::Undecided, DropOutcome::Refuted)
            }
        }
    }
}

/// Returns the statements in which each site occurs, those without dual numbers and with few operations first.
fn statements_by_site(statements: &[Statement], registry: &Registry) -> HashMap<Site, Vec<usize>> {
    let mut by_site: HashMap<Site, BTreeSet<(bool, usize, usize)>> = HashMap::new();
    for (index, statement) in statements.iter().enumerate() {
        let (mut operations, mut has_duals, mut sites) = (0, false, BTreeSet::new());
        for tree in statement.trees() {
            tree.visit(&mut |tree| {
                let site = tree.site();
                operations += 1;
                has_duals |= site.is_in_dual_numbers();
                if registry.has_site(&site) {
                    sites.insert(site);
                }
            });
        }
        for site in sites {
            by_site.entry(site).or_default().insert((has_duals, operations, index));
        }
    }
    by_site.into_iter().map(|(site, of)| (site, of.into_iter().map(|(.., i)| i).collect())).collect()
}

/// Returns the index of a combination of hypotheses, which is added if it is new.
fn index_of(hypotheses: &[Hypothesis], combinations: &mut Vec<Vec<Hypothesis>>) -> usize {
    combinations.iter().position(|known| *known == hypotheses).unwrap_or_else(|| {
        combinations.push(hypotheses.to_vec());
        combinations.len() - 1
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{equal, non_negative};
    use crate::formula::{Formula, Relation};
    use crate::number::Tree;

    /// Computes k = (a − b)² + a.
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
    fn the_order_of_operands_in_a_square_is_proved_irrelevant() {
        let statements = [expanded("expanded")];
        let MutationReport { mutants, .. } = test_mutations(&statements, &registry());
        let unchanged = mutants.iter().filter(|(_, outcome)| matches!(outcome, MutationOutcome::Equivalent));
        assert_eq!(
            unchanged.map(|(mutant, _)| mutant.mutation).collect::<Vec<_>>(),
            [Mutation::Swap(Operator::Sub)]
        );
        // Four mutations of −, three each of × and +.
        let MutationSummary { mutations, detected, equivalent, .. } =
            test_mutations(&statements, &registry()).summary();
        assert_eq!([mutations, detected, equivalent], [10, 9, 1]);
        assert_eq!(find_detected_mutants(&statements, &registry()).summary().mutations, 9);
    }

    #[test]
    fn redundant_hypotheses_are_distinguished_from_needed_ones() {
        let [needed, redundant] = ["a", "b"].map(|name| Hypothesis::new(Relation::Positive, x(name)));
        // a/a = 1 requires a > 0 and does not depend on b.
        let claim = equal("one", x("a") / x("a"), 1).assuming([&needed, &redundant]);
        let report = test_mutations(&[claim], &registry());
        let outcome =
            |given: &Hypothesis| report.dropped.iter().find(|d| d.hypothesis == *given).map(|d| &d.outcome);
        assert!(matches!(outcome(&needed), Some(DropOutcome::Refuted(_))), "{:?}", report.dropped);
        assert!(matches!(outcome(&redundant), Some(DropOutcome::StillProved)), "{:?}", report.dropped);
        let reported: Vec<_> = report.redundant_hypotheses().map(|dropped| &dropped.hypothesis).collect();
        assert_eq!((report.dropped.len(), reported), (2, vec![&redundant]));
    }

    /// The claim that k ≥ 0 where k ≥ 0 is true for every k, so no mutation of k is detected.
    #[test]
    fn mutants_are_evaluated_where_the_mutated_hypotheses_hold() {
        let k = squared(&x("a"), &x("b"));
        let hypothesis = Hypothesis::new(Relation::NonNegative, k.clone());
        let statements = [non_negative("k", k).assuming([&hypothesis])];
        let MutationReport { mutants, .. } = test_mutations(&statements, &registry());
        let detected =
            mutants.iter().find(|(_, outcome)| matches!(outcome, MutationOutcome::Detected { .. }));
        assert!(detected.is_none() && !mutants.is_empty(), "{detected:?}");
    }
}

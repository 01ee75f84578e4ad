//! Mutation tests of the proofs: false statements are detected, and not proved.

use crate::strategies::is_deep;
use rayon::prelude::*;
use spring_mass_contact::claims::{hypotheses, registry, statements};
use spring_mass_contact::eval::{Point, Verdict, constructed_points, integer_points, verdict_at};
use spring_mass_contact::formula::claim::PRECISION;
use spring_mass_contact::formula::statement::minimum_precision;
use spring_mass_contact::formula::{Hypothesis, Relation, Statement};
use spring_mass_contact::number::Exact;
use spring_mass_contact::number::tree::{Op, piecewise_ops};
use spring_mass_contact::proof::mutation::{
    DropOutcome, MutationOutcome, MutationReport, mutants, test_mutations,
};
use spring_mass_contact::proof::prove;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::sync::LazyLock;

/// Mutations and dropped hypotheses of all statements, shared by the tests.
static REPORT: LazyLock<MutationReport> = LazyLock::new(|| test_mutations(&statements(), registry()));

fn symbols() -> Vec<&'static str> {
    registry().symbols_of(statements().iter().flat_map(Statement::trees))
}

fn value(hypothesis: &Hypothesis, point: &Point) -> Exact {
    let beyond = |step: Op<&Exact>| match step {
        Op::Rounded(x) => x.round_to_bits(point.at(PRECISION).as_rational().numer().significant_bits() - 1),
        step => piecewise_ops(step),
    };
    hypothesis.value.eval(&|symbol| point.at(symbol), &beyond).unwrap()
}

#[test]
fn every_mutant_is_detected() {
    let report = &*REPORT;
    let unnoticed = report.mutants.iter().filter(|(_, effect)| matches!(effect, MutationOutcome::Undetected));
    let unnoticed: Vec<_> = unnoticed.map(|(change, _)| change.to_string()).collect();
    assert!(unnoticed.is_empty(), "no claim in src/claims notices these, and one should: {unnoticed:#?}");
    assert!(report.summary().detected > 600, "{:?}", report.summary());
}

#[test]
fn the_only_equivalent_mutants_exchange_operands_in_a_square() {
    for (change, effect) in &REPORT.mutants {
        if matches!(effect, MutationOutcome::Equivalent) {
            assert!(change.to_string().ends_with("a − b → b − a"), "{change}");
        }
    }
}

#[test]
fn no_hypothesis_is_redundant() {
    for dropped in &REPORT.dropped {
        let what = format!(
            "{} {}: {}",
            dropped.equation,
            dropped.name,
            registry().format_hypothesis(&dropped.hypothesis)
        );
        let needed = matches!(dropped.outcome, DropOutcome::Refuted(_)) || dropped.is_precision_only();
        assert!(needed, "{what}: nothing refutes the claim without it, so take it out");
        // So it is with one hypothesis, and of no other kind.
        assert_eq!(dropped.is_precision_only(), dropped.hypothesis == hypotheses().fine_enough, "{what}");
    }
    let was_dropped = |s: &Statement, given: &Hypothesis| {
        REPORT.dropped.iter().any(|d| (d.equation, d.name, &d.hypothesis) == (s.equation(), s.name(), given))
    };
    for s in statements() {
        for given in s.hypotheses().iter().filter(|given| **given != minimum_precision()) {
            assert!(
                was_dropped(&s, given),
                "{} {}: it was not tested without {given}",
                s.equation(),
                s.name()
            );
        }
    }
}

/// Returns the statement with > 0 weakened to ≥ 0 in a hypothesis.
fn weakened(statement: &Statement, hypothesis: &Hypothesis) -> Option<Statement> {
    let mut hypotheses = statement.stated_hypotheses().to_vec();
    let own = hypotheses.iter_mut().find(|own| *own == hypothesis && own.relation == Relation::Positive)?;
    own.relation = Relation::NonNegative;
    Some(statement.clone().only_assuming(&hypotheses))
}

/// Returns the step between the audited variants of a statement; drifts take seven times as long as other claims.
fn sample_step(statement: &Statement) -> usize {
    match statement.kind() {
        _ if is_deep() => 1,
        "drift" => 280,
        _ => 40,
    }
}

/// Returns the statements near a claim: with a mutation of the source, or with a hypothesis dropped or weakened.
fn neighbours(statements: &[Statement]) -> Vec<(String, Statement)> {
    let mutants = mutants(statements, registry());
    let near = |s: &Statement| {
        let name = format!("{} {}", s.equation(), s.name());
        let mutants = mutants.iter().filter_map(|c| Some((format!("{name} after {c}"), c.apply(s)?)));
        let mut near: Vec<_> = mutants.collect();
        for given in s.hypotheses() {
            near.push((format!("{name} without {given}"), s.without(given)));
            near.extend(weakened(s, given).map(|weaker| (format!("{name} with {given} or = 0"), weaker)));
        }
        near.into_iter().step_by(sample_step(s)).collect::<Vec<_>>()
    };
    statements.par_iter().flat_map_iter(near).collect()
}

/// Returns a statement for each goal, so that the failure of one goal does not hide that of another. The
/// goals of an induction, or with computed quantities, are only meaningful together.
fn goal_by_goal((name, statement): (String, Statement)) -> Vec<(String, Statement)> {
    if matches!(statement.kind(), "induction" | "drift") || !statement.computed().is_empty() {
        return vec![(name, statement)];
    }
    let goals = statement.goals().iter();
    goals.map(|goal| (name.clone(), statement.with_proposition(goal.proposition.clone()))).collect()
}

#[test]
fn refuted_variants_are_not_proved() {
    let fails = |s: &Statement, point: &Point| matches!(verdict_at(s, point), Verdict::Fails(..));
    let symbols = symbols();
    let audited = neighbours(&statements()).into_par_iter().flat_map_iter(goal_by_goal);
    let audited = audited.map(|(name, s)| {
        // Where there is a proof, numbers search for long. Where there is none, a few tell whether that is
        // because the statement is false.
        let proved = prove(&s).is_ok();
        let (planted, raw) = if proved { (12, 60) } else { (4, 8) };
        let planted =
            constructed_points(s.hypotheses(), &symbols).take(planted).find(|point| fails(&s, point));
        let raw = integer_points(s.hypotheses(), &symbols).take(raw).find(|point| fails(&s, point));
        for point in planted.iter().chain(&raw) {
            assert!(!proved, "{name} is proved, and false at {point}");
        }
        [planted.is_some(), raw.is_some(), proved].map(usize::from)
    });
    let add = |a: [usize; 3], b: [usize; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
    let [planted, raw, proved] = audited.reduce(|| [0; 3], add);
    assert!(planted > 200 && raw > 200 && proved > 40, "{planted} planted, {raw} raw; {proved} proved");
}

#[test]
fn points_attain_the_equality_and_inequality_of_each_hypothesis() {
    let symbols = symbols();
    let mut combinations: BTreeMap<String, Statement> = BTreeMap::new();
    for s in statements() {
        combinations.insert(s.hypotheses().iter().map(|h| format!("{h}, ")).collect(), s);
    }
    for (name, s) in combinations {
        let planted: Vec<_> = constructed_points(s.hypotheses(), &symbols).collect();
        let raw: Vec<_> = integer_points(s.hypotheses(), &symbols).collect();
        assert!(
            planted.len() > 20 && !raw.is_empty(),
            "{name}: {} planted, {} raw",
            planted.len(),
            raw.len()
        );
        // What may be 0 is so at some, and is not at others.
        for hypothesis in s.hypotheses() {
            let sign = |point: &Point| value(hypothesis, point).cmp(&Exact::from(0));
            for points in [&planted, &raw] {
                let (zero, positive) = (
                    points.iter().any(|point| sign(point) == Ordering::Equal),
                    points.iter().any(|point| sign(point) == Ordering::Greater),
                );
                let expected = match hypothesis.relation {
                    Relation::Positive => (false, true),
                    Relation::NonNegative => (true, true),
                    Relation::Zero => (true, false),
                };
                // No small integers make 2ᵖ + 1 a multiple of 64, and two bits would be too few.
                let fine = &hypotheses().fine_enough;
                let never = hypothesis == fine && std::ptr::eq(points, &raw)
                    || *hypothesis == minimum_precision() && s.hypotheses().contains(fine);
                let zero = zero || never;
                assert_eq!((zero, positive), expected, "{name}: {hypothesis}");
            }
        }
    }
}

//! Every claim is proved for all values, from what the functions of the chapter do.
#![cfg(feature = "mpfr")]

use num_traits::Zero;
use spring_mass_contact::claims::{Case, Claim, Goal, claims, formulas, unilateral_claims};
use spring_mass_contact::number::{Exact, Field};
use spring_mass_contact::proof::refute::{How, Verdict, check, raw_points};
use spring_mass_contact::proof::statement::Says;
use spring_mass_contact::proof::{Statement, paper, prove, statements};
use std::collections::BTreeSet;

#[test]
fn every_claim_is_proved() {
    let open: Vec<_> = statements()
        .iter()
        .filter_map(|s| prove(s).err().map(|why| format!("{} {}: {why}", s.equation, s.name)))
        .collect();
    assert!(open.is_empty(), "{open:#?}");
}

#[test]
fn every_number_of_the_chapter_has_a_proof() {
    let proved: BTreeSet<_> = statements().iter().map(|s| s.equation).collect();
    for n in 1..=33 {
        assert!(proved.contains(format!("1.{n}").as_str()), "nothing is proved of (1.{n})");
    }
}

#[test]
fn every_formula_of_the_chapter_is_part_of_a_proof() {
    let mut sites = BTreeSet::new();
    for statement in statements() {
        statement.trees().for_each(|tree| {
            tree.visit(&mut |step| {
                sites.insert(step.site());
            })
        });
    }
    for formula in formulas() {
        // A formula made by differentiating has the places of the number system that does it.
        assert!(sites.contains(&formula.tree.site()), "{} is in no claim", formula.name());
    }
}

/// Does a claim hold for these numbers, by the functions themselves?
fn holds(claim: &Claim<Exact>, case: &Case<Exact>) -> bool {
    claim.goals(case).iter().all(|goal| match goal {
        Goal::Equal(left, right) => left == right,
        Goal::Sign(relation, x) => relation.admits(x.cmp(&Exact::zero())),
    })
}

#[test]
fn what_is_recorded_is_what_the_functions_do() {
    // The same claims, once run in rationals and once recorded and replayed in them; also where a hypothesis is
    // dropped, so that they fail here and there.
    let direct: Vec<Claim<Exact>> = claims().into_iter().chain(unilateral_claims()).collect();
    let (mut agreed, mut failed) = (0, 0);
    for statement in statements() {
        let name =
            |claim: &&Claim<Exact>| (claim.equation, claim.name) == (statement.equation, statement.name);
        let Some(claim) = direct.iter().find(name) else {
            continue; // with eˣ
        };
        // An induction is run for some steps, which is more than its goals say.
        if statement.kind == "induction" {
            continue;
        }
        // And of a limit the claim says in numbers how fast it is reached, and no more.
        let goals = statement.goals.iter().filter(|goal| !matches!(goal.says, Says::Limit(..)));
        let goals: Vec<_> = goals
            .map(|goal| Statement { hypotheses: vec![], goals: vec![goal.clone()], ..statement.clone() })
            .collect();
        for case in raw_points(&[]).take(40) {
            let replayed: Vec<_> = goals.iter().map(|goal| check(goal, case)).collect();
            if replayed.iter().any(|verdict| matches!(verdict, Verdict::Fails(_, How::Undefined(_)))) {
                continue; // rationals do not divide by 0 either
            }
            let replayed = replayed.iter().all(|verdict| matches!(verdict, Verdict::Holds));
            assert_eq!(replayed, holds(claim, case), "{} {} at {case:?}", statement.equation, statement.name);
            agreed += 1;
            failed += usize::from(!replayed);
        }
    }
    assert!(agreed > 3000 && failed > 100, "{agreed} compared, {failed} failed");
}

#[test]
fn a_proof_can_be_read() {
    let statements = statements();
    let statement = statements.iter().find(|s| (s.equation, s.name) == ("1.13", "rate")).unwrap();
    let proof = prove(statement).unwrap();
    assert_eq!(paper::claim(statement), "(c + ε) ((ε (H − l) + m g) / (c + ε) − Δ) = R");
    assert_eq!(paper::used(&proof), ["c > 0", "ε > 0"]);
    let lines = paper::proof(statement, &proof);
    assert_eq!(lines.first().map(String::as_str), Some("c + ε ≠ 0: c + ε > 0, term by term"));
}

#[test]
fn integers_of_any_size_are_written_as_what_they_are() {
    use spring_mass_contact::number::Tree;
    use spring_mass_contact::proof::algebra::Poly;
    let large = rug::Rational::from((rug::Integer::from(1) << 80, 3));
    let tree = Poly::constant(large.clone()).to_tree(&|x| Tree::symbol(x.0));
    assert_eq!(tree.replay(&|_| Exact::int(0), &|_| None), Some(Exact::from(large)));
}

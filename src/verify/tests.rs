//! Complete runs with wrong claims, to see that the checks fail.

use super::checker::NumberDomain;
use super::*;
use crate::formula::claim::{equal, induction};
use crate::formula::statement::Proposition;
use crate::formula::{Hypothesis, Relation};
use crate::number::{Exponential, Field, PositivePart, Tree};
use crate::proof::mutation::{Mutant, Mutation, Operator};
use num_traits::{One, Zero};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

const SEED: u64 = 3;

fn options(cases: u64) -> Options {
    Options { scalars: Vec::new(), cases, seed: SEED, equations: Vec::new() }
}

fn claim(name: &'static str, proposition: Proposition) -> Statement {
    equal(name, 0, 0).with_proposition(proposition).inheriting("1.1", &[])
}

fn experiment<T: 'static>(name: &'static str, check: fn(&Case<T>) -> Trial) -> Experiment<T> {
    Experiment { equation: "1.1", name, statement: None, hypotheses: vec![], check: Arc::new(check) }
}

fn x(name: &'static str) -> Tree {
    Tree::symbol(name)
}

/// Returns a claim that holds next to one that fails.
fn holding() -> Statement {
    claim("holds", Proposition::Equal(x("u") + x("v"), x("v") + x("u")))
}

/// 1/(u − u)
fn undefined() -> Tree {
    Tree::one() / (x("u") - x("u"))
}

/// Returns the claims and experiments of a number system.
fn boxed<D: NumberDomain + Clone + Send + 'static>(
    scalar: NumberSystem,
    domain: D,
    claims: &[Statement],
    experiments: Vec<Experiment<D::Number>>,
) -> Vec<Group> {
    let mut groups = Vec::new();
    add_checks(&mut groups, &options(0), (scalar, domain), claims, experiments);
    groups
}

fn exactly(claims: &[Statement], experiments: Vec<Experiment<Exact>>) -> Vec<Group> {
    boxed(NumberSystem::Exact, Rationals::unrounded(), claims, experiments)
}

fn report(systems: impl IntoIterator<Item = Vec<Group>>, cases: u64) -> VerificationReport {
    run(&systems.into_iter().flatten().collect::<Vec<_>>(), Vec::new(), &options(cases), &|_, _| ())
}

fn row<'a>(report: &'a VerificationReport, name: &str, scalar: NumberSystem) -> &'a ClaimResult {
    report.rows.iter().find(|row| row.claim == name && row.scalar == Some(scalar)).unwrap()
}

/// The first case, the last of a block, the first of another, and the last of all.
#[test]
fn a_claim_that_fails_in_one_of_many_cases_fails() {
    static WRONG: Mutex<Option<Case<Exact>>> = Mutex::new(None);
    let all = 3 * BLOCK + 1;
    for index in [0, BLOCK - 1, BLOCK, all - 1] {
        *WRONG.lock().unwrap() = cases::case(SEED, index, &[]);
        let wrong = experiment("wrong", |x| Trial::Decided(WRONG.lock().unwrap().as_ref() != Some(x)));
        let report = report([exactly(&[holding()], vec![wrong])], all);
        assert!(!report.holds());
        let row = |name| row(&report, name, NumberSystem::Exact);
        let ClaimResult { status, decided, undecided, counterexample, .. } = row("wrong");
        assert_eq!((*status, *decided, *undecided), (Status::Failed, all, 0), "{index}");
        assert_eq!(*counterexample, *WRONG.lock().unwrap(), "{index}");
        assert_eq!(row("holds").status, Status::Held);
    }
}

#[test]
fn the_first_of_many_counterexamples_is_reported() {
    let wrong = claim("wrong", Proposition::Sign(Relation::Positive, -(x("u") * x("u"))));
    let report = report([exactly(&[wrong], Vec::new())], 3 * BLOCK);
    let first = row(&report, "wrong", NumberSystem::Exact).counterexample.clone();
    assert_eq!(first, cases::case(SEED, 0, &[]));
}

/// A claim in three number systems that is wrong in one of them.
#[test]
fn a_claim_can_fail_in_one_number_system_alone() {
    let zero_is = |zero: bool| {
        let number = if zero { Tree::zero() } else { Tree::one() };
        [claim("zero", Proposition::Equal(x("u") - x("u"), number)), holding()]
    };
    let scalars = [NumberSystem::F32, NumberSystem::F64, NumberSystem::Mpfr(100), NumberSystem::Exact];
    for wrong in scalars {
        let [single, double, precise, exact] = scalars.map(|scalar| zero_is(scalar != wrong));
        let checkers = [
            boxed(scalars[0], Balls(0f32), &single, Vec::new()),
            boxed(scalars[1], Balls(0f64), &double, Vec::new()),
            boxed(scalars[2], Balls(Mpfr::rounded(100, 0)), &precise, Vec::new()),
            exactly(&exact, Vec::new()),
        ];
        let report = report(checkers, 20);
        let failed = report.rows.iter().filter(|row| row.status == Status::Failed);
        let failed: Vec<_> = failed.map(|row| (row.claim, row.scalar)).collect();
        assert_eq!(failed, [("zero", Some(wrong))]);
        let VerificationSummary { claims, proved, held, undecided, failed } = report.summary();
        assert_eq!([claims, proved, held, undecided, failed], [8, 0, 7, 0, 1]);
        assert!(!report.holds());
    }
}

/// Claims whose numbers are out of range, or whose precision is too low, are undecided.
#[cfg(feature = "half")]
#[test]
fn no_claim_fails_in_a_float_of_16_bits() {
    let asked = Options { scalars: vec![NumberSystem::F16, NumberSystem::BF16], ..options(60) };
    let report = run(&groups(&asked), Vec::new(), &asked, &|_, _| ());
    let failed = report.rows.iter().filter(|row| row.status == Status::Failed);
    assert_eq!(failed.collect::<Vec<_>>(), Vec::<&ClaimResult>::new());
    let VerificationSummary { claims, held, .. } = report.summary();
    assert!(2 * held > claims, "{held} of {claims} held");
}

/// u/3 · 3 − u, whose sign balls cannot decide.
#[test]
fn a_claim_that_no_case_decides_is_undecided() {
    let open = x("u") / Tree::int(3) * Tree::int(3) - x("u");
    let open = claim("open", Proposition::Sign(Relation::NonNegative, Tree::one() / (&open * &open)));
    let checkers = [
        boxed(
            NumberSystem::F64,
            Balls(0f64),
            &[open, holding()],
            vec![experiment("out of range", |_| Trial::Undecided)],
        ),
        exactly(&[holding()], vec![experiment("out of range", |_| Trial::Undecided)]),
    ];
    // It is undefined in a case with u = 0.
    let all = (0..).take_while(|i| !cases::case(SEED, *i, &[]).unwrap().u.is_zero()).count() as u64;
    let report = report(checkers, all);
    for (name, scalar) in [
        ("open", NumberSystem::F64),
        ("out of range", NumberSystem::F64),
        ("out of range", NumberSystem::Exact),
    ] {
        let row = row(&report, name, scalar);
        let found = (row.status, row.decided, row.undecided, &row.counterexample);
        assert_eq!(found, (Status::Undecided, 0, all, &None), "{name}");
    }
    assert!(all > 0 && report.holds());
}

/// Without cases, under hypotheses that no case satisfies, and without tests: of a derivative that does not
/// exist, and of a recursion without members.
#[test]
fn a_claim_that_was_never_tested_is_undecided() {
    let positive = |value: Tree| Hypothesis::new(Relation::Positive, value);
    let never = vec![positive(x("u")), positive(-x("u"))];
    let wrong = || Proposition::Sign(Relation::Positive, -Tree::one());
    let skipped = claim("skipped", wrong()).assuming(&never);
    let kink = claim("kink", Proposition::Derivative(x("u").positive_part(), "u", x("u")));
    let members = induction("members", x("q"), [], |[]| [], []).inheriting("1.1", &[]);
    let claims = [skipped, kink, members];
    let experiments = || {
        let skipped = experiment("skipped trial", |_| Trial::Decided(false));
        vec![Experiment { hypotheses: never.clone(), ..skipped }]
    };
    let of = |cases| report([exactly(&claims, experiments())], cases);
    let untried = |report: VerificationReport, cases| {
        assert_eq!(report.rows.len(), 4);
        for row in &report.rows {
            let found = (row.status, row.decided, row.undecided);
            assert_eq!(found, (Status::Undecided, 0, cases), "{}", row.claim);
        }
    };
    untried(of(2 * BLOCK), 2 * BLOCK);
    untried(of(0), 0);
    // A report without number systems or without claims does not hold.
    for nothing in [report([], 10), report([exactly(&[], Vec::new())], 10)] {
        assert_eq!(nothing.rows, []);
        assert!(!nothing.holds());
    }
    let unknown = Options { equations: vec!["1.99".to_string()], ..Options::default() };
    let unknown = verify(&unknown, &|_, _| ());
    assert!(unknown.rows.is_empty() && !unknown.holds());
    assert!(!proofs::Proofs::default().hold());
}

/// 1/(u − u) in rationals and in balls.
#[test]
fn an_undefined_claim_is_a_failure_with_its_case() {
    let claims = [
        claim("equal", Proposition::Equal(undefined(), Tree::one())),
        claim("sign", Proposition::Sign(Relation::Positive, undefined())),
        claim("factor", Proposition::Equal(Tree::zero() * undefined(), Tree::zero())),
        claim("min", Proposition::Sign(Relation::NonNegative, Tree::zero().min(&undefined()))),
        claim("derivative", Proposition::Derivative(undefined(), "u", Tree::zero())),
        holding(),
    ];
    let scalars = [NumberSystem::F32, NumberSystem::F64, NumberSystem::Mpfr(100), NumberSystem::Exact];
    let checkers = [
        boxed(scalars[0], Balls(0f32), &claims, Vec::new()),
        boxed(scalars[1], Balls(0f64), &claims, Vec::new()),
        boxed(scalars[2], Balls(Mpfr::rounded(100, 0)), &claims, Vec::new()),
        exactly(&claims, Vec::new()),
    ];
    let report = report(checkers, 10);
    for scalar in scalars {
        for name in ["equal", "sign", "factor", "min", "derivative"] {
            let row = row(&report, name, scalar);
            // In f32 some cases are out of range and undecided; the others decide.
            assert_eq!(
                (row.status, row.reason.as_deref()),
                (Status::Failed, Some("division by zero")),
                "{name} {scalar}"
            );
            assert_eq!(row.decided + row.undecided, 10);
            assert!(row.decided > 5 && row.counterexample.is_some(), "{name} {scalar}");
        }
        assert_eq!(row(&report, "holds", scalar).status, Status::Held, "{scalar}");
    }
}

#[test]
fn the_cases_of_a_run_are_distinct_and_each_is_checked_once() {
    static TRIED: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let record = |x: &Case<Exact>| {
        TRIED.lock().unwrap().push(format!("{x:?}"));
        Trial::Decided(true)
    };
    let all = 5 * BLOCK + 1;
    let report = report([exactly(&[], vec![experiment("recorded", record)])], all);
    assert_eq!(row(&report, "recorded", NumberSystem::Exact).decided, all);
    let tried = TRIED.lock().unwrap();
    let distinct: BTreeSet<_> = tried.iter().cloned().collect();
    let drawn: BTreeSet<_> = (0..all).map(|i| format!("{:?}", cases::case(SEED, i, &[]).unwrap())).collect();
    assert_eq!((tried.len() as u64, distinct.len() as u64), (all, all));
    assert_eq!(distinct, drawn);
}

/// The worst case is the first, one in the middle, or the last.
#[test]
fn the_worst_share_is_that_of_all_cases() {
    static WORST: Mutex<Option<Case<Exact>>> = Mutex::new(None);
    let check = |x: &Case<Exact>| {
        let worst = WORST.lock().unwrap().as_ref() == Some(x);
        Trial::Within { error: Exact::from(if worst { 3 } else { 1 }), bound: Exact::from(4) }
    };
    let all = 3 * BLOCK;
    for index in [0, BLOCK + 7, all - 1] {
        *WORST.lock().unwrap() = cases::case(SEED, index, &[]);
        let exceeded = |_: &Case<Exact>| Trial::Within { error: Exact::from(5), bound: Exact::from(4) };
        let experiments = vec![experiment("measured", check), experiment("exceeded", exceeded)];
        let report = report([exactly(&[], experiments)], all);
        assert_eq!(row(&report, "exceeded", NumberSystem::Exact).status, Status::Failed);
        let row = row(&report, "measured", NumberSystem::Exact);
        assert_eq!((row.status, &row.worst), (Status::Held, &Some((0.75, "4".to_string()))), "{index}");
    }
}

#[test]
fn a_wrong_statement_is_refuted_and_an_unprovable_one_is_not_proved() {
    let all = statements();
    let rate = all.iter().find(|s| (s.equation(), s.name()) == ("1.13", "rate")).unwrap();
    let Proposition::Equal(left, right) = &rate.goals()[0].proposition else { panic!("an equation") };
    let named =
        |name, proposition| equal(name, 0, 0).with_proposition(proposition).inheriting(rate.equation(), &[]);
    let wrong = Proposition::Equal(left.clone(), right + right);
    let wrong = named("wrong", wrong).assuming(rate.stated_hypotheses());
    // eˣ + e⁻ˣ ≥ 2 + x² for every x is true, but it does not follow from the laws of the checker.
    let q = Tree::symbol("q");
    let open = q.exp() + (-&q).exp() - Tree::int(2) - &q * &q;
    let open = named("open", Proposition::Sign(Relation::NonNegative, open));
    let undefined = named("undefined", Proposition::Equal(Tree::one() / (&q - &q), Tree::one()));
    let report = run(&[], vec![rate.clone(), wrong, open, undefined], &options(1), &|_, _| ());
    let found: Vec<_> = report
        .rows
        .iter()
        .map(|row| (row.claim, row.status, row.reason.is_some(), row.counterexample.is_some()))
        .collect();
    assert_eq!(
        found,
        [
            ("rate", Status::Proved, false, false),
            ("wrong", Status::Failed, true, true),
            ("open", Status::Failed, true, false),
            ("undefined", Status::Failed, true, true),
        ]
    );
    assert!(!report.holds() && report.rows.iter().all(|row| row.scalar.is_none()));
}

#[test]
fn only_selected_equations_are_checked_and_progress_is_reported() {
    let asked = Options { equations: vec!["1.13".to_string()], ..options(2 * BLOCK) };
    let other = claim("other", Proposition::Sign(Relation::Positive, Tree::one())).inheriting("1.13", &[]);
    let seen = Mutex::new(Vec::new());
    let progress = |done: usize, of: usize| seen.lock().unwrap().push((done, of));
    let mut groups = Vec::new();
    let exact = (NumberSystem::Exact, Rationals::unrounded());
    add_checks(&mut groups, &asked, exact, &[holding(), other], Vec::new());
    let report = run(&groups, statements(), &asked, &progress);
    assert!(report.rows.iter().all(|row| row.equation == "1.13"));
    assert_eq!(row(&report, "other", NumberSystem::Exact).decided, 2 * BLOCK);
    assert_eq!(report.rows.iter().filter(|row| row.scalar.is_some()).count(), 1);
    let mut seen = seen.into_inner().unwrap();
    seen.sort_unstable();
    assert_eq!(seen, [(1, 2), (2, 2)]);
}

#[test]
fn rows_are_grouped_by_claim_in_the_order_of_the_chapter() {
    let report = verify(&Options { cases: 1, ..Options::default() }, &|_, _| ());
    assert!(report.holds() && report.shared.is_empty());
    assert!(report.rows.is_sorted_by_key(|row| index_of(row.equation)));
    let claims = report.rows.chunk_by(|a, b| (a.equation, a.claim) == (b.equation, b.claim));
    let mut known = BTreeSet::new();
    for rows in claims {
        assert!(known.insert((rows[0].equation, rows[0].claim)), "{} {}", rows[0].equation, rows[0].claim);
        // The proof comes first, then the number systems in the requested order.
        let ways: Vec<_> = rows.iter().map(|row| row.scalar).collect();
        let order = |way: &Option<NumberSystem>| {
            way.map_or(0, |s| 1 + Options::default().scalars.iter().position(|t| *t == s).unwrap())
        };
        assert!(ways.is_sorted_by_key(order), "{ways:?}");
    }
}

/// Every key is present, quantities are texts, and a counterexample has all coordinates.
#[cfg(feature = "serde")]
#[test]
fn json_contains_the_details_of_a_failure() {
    let case = Case::of(|_| "7/3".parse().unwrap());
    let row = |status, counterexample: Option<Case<Exact>>| ClaimResult {
        equation: "1.13",
        claim: "rate",
        kind: "equal",
        status,
        scalar: Some(NumberSystem::Mpfr(2)),
        reason: counterexample.as_ref().map(|_| "division by zero".to_string()),
        decided: 4,
        undecided: 1,
        worst: counterexample.as_ref().map(|_| (2.5, "1/8".to_string())),
        counterexample,
    };
    let rows = vec![row(Status::Failed, Some(case)), row(Status::Undecided, None)];
    let report = VerificationReport { rows, shared: vec!["structure::deflection"] };
    let coordinates: std::collections::BTreeMap<_, _> =
        crate::claims::Var::ALL.iter().map(|var| (var.symbol(), "7/3")).collect();
    let expected = serde_json::json!({
        "summary": {"claims": 2, "proved": 0, "held": 0, "undecided": 1, "failed": 1},
        "shared": ["structure::deflection"],
        "equations": [{"equation": "1.13", "claims": [
            {
                "claim": "rate", "kind": "equal", "status": "failed", "scalar": "mpfr:2",
                "reason": "division by zero",
                "decided": 4, "undecided": 1, "worst": "2.5", "bound": "1/8", "counterexample": coordinates
            },
            {
                "claim": "rate", "kind": "equal", "status": "undecided", "scalar": "mpfr:2", "reason": null,
                "decided": 4, "undecided": 1, "worst": null, "bound": null, "counterexample": null
            }
        ]}]
    });
    assert_eq!(serde_json::to_value(&report).unwrap(), expected);
}

/// A law of rounding is tested in the precision of a number system, whatever the sampled one is.
#[test]
fn counterexamples_of_laws_have_the_precision_of_the_number_system() {
    let law = claims().find(|claim| claim.contains_rounding()).unwrap();
    let rounded = ClaimResult {
        equation: law.equation(),
        claim: law.name(),
        kind: "bound",
        scalar: Some(NumberSystem::F32),
        status: Status::Failed,
        reason: None,
        decided: 1,
        undecided: 0,
        worst: None,
        counterexample: Some(Case::of(|_| Exact::from(-3))),
    };
    let symbols = [Var::Bits.symbol(), registry().symbols_of(law.trees())[0]];
    let of = |row: &ClaimResult| symbols.map(|symbol| row.point().unwrap().at(symbol));
    assert_eq!(of(&rounded), [1 << 24, -3].map(Exact::from));
    assert_eq!(of(&ClaimResult { scalar: None, ..rounded }), [-3, -3].map(Exact::from));
}

fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The sample in the book of a report with a mistake: c − ε for c + ε in the stiffness by penalty.
#[test]
fn the_book_contains_the_report_of_a_mistake() {
    let site = registry().formula("penalty::total_stiffness").unwrap().tree.site();
    let mistake = Mutant { site, mutation: Mutation::Opposite(Operator::Add) };
    let mistaken = |s: Statement| mistake.apply(&s).unwrap_or(s);
    let statements = statements().into_iter().map(mistaken).collect();
    let options = Options { scalars: Vec::new(), cases: 1, seed: 1, equations: Vec::new() };
    let report = run(&[], statements, &options, &|_, _| ());
    assert_eq!(report.shared, ["penalty::total_stiffness"]);
    let row = report.rows.iter().find(|row| row.status == Status::Failed).unwrap();
    let ClaimResult { equation, claim, .. } = row;
    let VerificationSummary { claims, proved, .. } = report.summary();
    let parts = [
        format!("{equation} {claim} NOT PROVED {}", row.reason.as_ref().unwrap()),
        format!("{} {equation} {claim} FAILED", row.point().unwrap()),
        format!("{proved} of {claims} claims proved for all values."),
        format!("Every claim that is not proved uses {}.", report.shared[0]),
    ];
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("book/src/command.md");
    let page = in_one_line(&std::fs::read_to_string(page).unwrap());
    parts.iter().map(|part| in_one_line(part)).fold(&page[..], |rest, part| {
        let place = rest.find(&part);
        let place = place
            .unwrap_or_else(|| panic!("book/src/command.md: the report of `c - eps` needs {part:?} here"));
        &rest[place + part.len()..]
    });
}

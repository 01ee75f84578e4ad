//! Suggestions of hypotheses that make a claim provable.
//!
//! Nothing here is trusted: the claim is proved with each suggestion.

use super::check::Premise;
use super::effort;
use super::prove;
use super::render::formula;
use super::search::algebra::Monomial;
use super::search::assumption::AssumptionUse;
use super::search::{ProofError, Quantity};
use crate::eval::{Verdict, check, constructed_points, independent_symbols};
use crate::formula::claim::{POWER, PRECISION, SCALES, equal};
use crate::formula::statement::{Proposition, Statement};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;

/// Maximum number of symbols whose signs and differences are tried.
const MAX_SYMBOLS: usize = 6;

/// Maximum size of the formula at which a proof failed, if its sign is tried.
const MAX_OBSTACLE: u32 = 24;

/// Maximum number of suggestions.
const MAX_HINTS: usize = 3;

/// Number of points at which a claim is tested before a proof is attempted.
const POINTS: usize = 4;

/// Returns at most three simple hypotheses, each of which makes a statement provable that is not provable
/// without it for the reason `why`.
///
/// The candidates are, in this order, signs of symbols, comparisons of two symbols, and the sign of the
/// formula at which the proof failed. Points show that each is consistent with the hypotheses of the
/// statement, and not only where its quantity is 0. None of the results follows from another, and none is the
/// claim itself. An empty list does not refute the statement.
///
/// # Examples
/// ```
/// use provable::formula::{Hypothesis, Relation, claim::positive};
/// use provable::{number::Tree, proof::{prove, sufficient_hypotheses}};
/// let [f, g] = ["f", "g"].map(|name| Tree::symbol(name));
/// let converging = Hypothesis::new(Relation::Positive, f.clone());
/// let claim = positive("real image", &f * &g / (&g - &f)).assuming([&converging]);
/// let hypotheses = sufficient_hypotheses(&claim, &prove(&claim).unwrap_err());
/// assert_eq!(hypotheses[0].to_string(), "g > f");
/// assert!(prove(&claim.assuming([&hypotheses[0]])).is_ok());
/// ```
pub fn sufficient_hypotheses(statement: &Statement, reason: &ProofError) -> Vec<Hypothesis> {
    if let ProofError::TooLarge(_) | ProofError::Premise(Premise::TooLarge(..)) = reason {
        return Vec::new(); // So would be the proofs under more hypotheses.
    }
    let symbols = independent_symbols(statement);
    let mut found: Vec<Hypothesis> = Vec::new();
    for new in simple_quantities(&symbols).iter().filter_map(|of| weakest(statement, of, &symbols)) {
        if found.iter().all(|known| !follows(statement, known, &new)) {
            found.retain(|known| !follows(statement, &new, known));
            found.push(new);
        }
    }
    let obstacle = obstacle(reason).filter(|of| {
        let mut names = of.symbols().into_iter();
        of.size() <= MAX_OBSTACLE && of.first_symbol().is_some() && names.all(|x| symbols.contains(&x))
    });
    let signs = obstacle.into_iter().flat_map(|of| [of.clone(), -of]);
    for new in signs.filter_map(|of| weakest(statement, &of, &symbols)) {
        if found.iter().all(|known| !follows(statement, known, &new) && !follows(statement, &new, known)) {
            found.push(new);
        }
    }
    found.truncate(MAX_HINTS);
    found
}

/// Returns the first symbols, their differences and their opposites.
fn simple_quantities(symbols: &[&'static str]) -> Vec<Tree> {
    let names = symbols.iter().filter(|name| ![POWER, PRECISION].contains(name) && !SCALES.contains(name));
    let values: Vec<_> = names.take(MAX_SYMBOLS).map(|name| Tree::symbol(name)).collect();
    let differences = values.iter().flat_map(|x| values.iter().filter(move |y| x != *y).map(move |y| x - y));
    values.iter().cloned().chain(differences).chain(values.iter().map(|x| -x)).collect()
}

/// Returns the weaker of the hypotheses that a quantity is not negative, or is positive, that suffices.
fn weakest(statement: &Statement, value: &Tree, symbols: &[&'static str]) -> Option<Hypothesis> {
    let relations = [Relation::NonNegative, Relation::Positive].into_iter();
    let mut candidates = relations.map(|relation| Hypothesis::new(relation, value.clone()));
    candidates.find(|candidate| suffices(statement, candidate, symbols))
}

/// Returns `true` if, under the hypotheses of the statement, the second hypothesis implies the first.
fn follows(statement: &Statement, first: &Hypothesis, second: &Hypothesis) -> bool {
    let proposition = Proposition::Sign(first.relation, first.value.clone());
    prove(&statement.with_proposition(proposition).assuming([second])).is_ok()
}

/// Returns `true` if a hypothesis makes a statement provable, is not its claim, and is consistent with its
/// hypotheses where the quantity is not 0.
fn suffices(statement: &Statement, candidate: &Hypothesis, symbols: &[&'static str]) -> bool {
    let strict = Hypothesis { relation: Relation::Positive, ..candidate.clone() };
    let hypotheses = [statement.hypotheses(), &[strict]].concat();
    let claim = statement.clone().assuming([candidate]);
    let points: Vec<_> = constructed_points(&hypotheses, symbols).take(POINTS).collect();
    !points.is_empty()
        && points.iter().all(|point| !matches!(check(&claim, point), Verdict::Fails(..)))
        && prove(&claim).is_ok()
        && statement.goals().iter().all(|goal| match &goal.proposition {
            Proposition::Sign(_, of) => prove(&equal("", of, &candidate.value)).is_err(),
            _ => true,
        })
}

/// Returns the formula whose sign is missing, in the symbols of the statement and without common factors.
fn obstacle(reason: &ProofError) -> Option<Tree> {
    let Quantity { value, context } = match reason {
        ProofError::PossibleZeroDivisor(divisor, _) => return Some(divisor.clone()),
        ProofError::UnknownSign(value)
        | ProofError::WrongSign(value, _)
        | ProofError::UndecidedBranch(value) => value,
        _ => return None,
    };
    let assumptions = context.assumptions.iter().rev();
    let value = effort::bounded(|| {
        assumptions.fold(value.clone(), |value, assumption| match assumption.usage {
            AssumptionUse::Pivot(_, _, Some(slack)) => {
                value.replace(&Monomial::of(slack), &assumption.slack_value())
            }
            _ => value,
        })
    })?;
    let num = value.num();
    let rest = num.checked_div(&num.common_monomial().into())?;
    (rest.terms().len() <= MAX_OBSTACLE as usize).then(|| formula(&rest, context))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eval::integer_points;
    use crate::formula::Registry;
    use crate::formula::claim::{non_negative, positive};
    use crate::number::{Exponential, PositivePart, tree};
    use crate::proof::MAX_SIZE;
    use crate::proof::render::ProofPrinter;

    fn above_zero(value: impl Into<Tree>) -> Hypothesis {
        Hypothesis::new(Relation::Positive, value.into())
    }

    fn not_below_zero(value: impl Into<Tree>) -> Hypothesis {
        Hypothesis::new(Relation::NonNegative, value.into())
    }

    fn explained(claim: &Statement) -> String {
        ProofPrinter::new(&Registry::default()).explain(claim, &prove(claim).unwrap_err())
    }

    fn hints(claim: &Statement) -> Vec<String> {
        sufficient_hypotheses(claim, &prove(claim).unwrap_err()).iter().map(Hypothesis::to_string).collect()
    }

    /// Returns the image distance of a thin lens for the object distance `s`.
    fn image(f: &Tree, s: &Tree) -> Tree {
        f * s / (s - f)
    }

    /// Returns the voltage of a loaded divider.
    fn loaded(u: &Tree, a: &Tree, b: &Tree, load: &Tree) -> Tree {
        let parallel = b * load / (b + load);
        u * &parallel / (a + &parallel)
    }

    fn charged(u: &Tree, t: &Tree, r: &Tree, c: &Tree) -> Tree {
        u * (Tree::from(1) - (-t / (r * c)).exp())
    }

    #[test]
    fn the_missing_hypothesis_on_a_lens_is_suggested() {
        let [f, s] = tree::symbols(["f", "s"]);
        let [converging, real] = [&f, &s].map(above_zero);
        let is_real = positive("", image(&f, &s));
        assert_eq!(
            explained(&is_real.clone().assuming([&converging])),
            "the divisor s − f might be 0; it is proved if s > f or if s < 0"
        );
        let one = || Tree::from(1);
        let law = equal("", one() / image(&f, &s), one() / &f - one() / &s);
        assert_eq!(
            explained(&law.assuming([&converging, &real])),
            "the divisor s − f might be 0; it is proved if f > s or if s > f"
        );
        // A single hypothesis does not suffice.
        assert_eq!(explained(&is_real), "the divisor s − f might be 0");
    }

    #[test]
    fn the_missing_sign_of_a_load_is_suggested() {
        let [u, a, b, load] = tree::symbols(["U", "R₁", "R₂", "R"]);
        let claim = positive("", loaded(&u, &a, &b, &load)).assuming(&[&a, &b, &u].map(above_zero));
        assert_eq!(
            explained(&claim),
            "the divisor R₂ + R might be 0; it is proved if R > 0 or if R₂ + R < 0"
        );
        let lower = &u * &b / (&a + &b) - loaded(&u, &a, &b, &load);
        assert_eq!(hints(&positive("", lower).assuming(&[&a, &b, &load].map(above_zero))), ["U > 0"]);
    }

    #[test]
    fn the_weakest_hypothesis_on_a_charging_curve_is_suggested() {
        let [u, t, r, c] = tree::symbols(["U", "t", "R", "C"]);
        let voltage = charged(&u, &t, &r, &c);
        let parts = [&u, &r, &c].map(above_zero);
        let missing = "no rule finds the sign of U − U exp(−t / (C R)): the term −U exp(−t / (C R)) is < 0";
        let explained = |claim: Statement| explained(&claim.assuming(&parts));
        assert_eq!(explained(non_negative("", &voltage)), format!("{missing}; it is proved if t ≥ 0"));
        assert_eq!(explained(positive("", &voltage)), format!("{missing}; it is proved if t > 0"));
        let claim = positive("", voltage).assuming(&[&u, &t, &r].map(above_zero));
        assert_eq!(hints(&claim), ["C > 0"]);
    }

    #[test]
    fn hypotheses_that_contradict_the_statement_are_not_suggested() {
        let [f, s] = tree::symbols(["f", "s"]);
        let claim = positive("", image(&f, &s)).assuming([&above_zero(&f), &above_zero(&f - &s)]);
        assert_eq!(hints(&claim), ["s < 0"]);
        // a ≤ 0 would suffice, but holds only for a = 0.
        let [a, c] = tree::symbols(["a", "c"]);
        let claim = non_negative("", &c - &a).assuming(&[&a, &c].map(not_below_zero));
        assert!(prove(&claim.clone().assuming([&not_below_zero(-&a)])).is_ok());
        assert_eq!(hints(&claim), Vec::<String>::new());
    }

    #[test]
    fn neither_the_claim_nor_stronger_hypotheses_than_needed_are_suggested() {
        let [a, b, c, d] = tree::symbols(["a", "b", "c", "d"]);
        assert_eq!(hints(&positive("", &a - &b)), Vec::<String>::new());
        // Since a > d, b ≥ a would suffice as well.
        let claim = positive("", &b + &c - &d).assuming(&[b.clone(), c.clone(), &a - &d].map(above_zero));
        assert_eq!(hints(&claim), ["b ≥ d", "c ≥ d"]);
    }

    /// The claim also follows from 2ᵖ > b.
    #[test]
    fn no_hypothesis_on_the_precision_is_suggested() {
        let [a, b, n] = tree::symbols(["a", "b", PRECISION]);
        let claim = positive("", &a * (&n - &b)).assuming(&[a, n].map(above_zero));
        assert_eq!(hints(&claim), ["b ≤ 0"]);
    }

    #[test]
    fn an_obstacle_that_follows_from_a_hypothesis_is_not_suggested() {
        let [a, b, c] = tree::symbols(["a", "b", "c"]);
        let claim = positive("", &c * (a + &b)).assuming([&not_below_zero(b), &above_zero(c)]);
        assert_eq!(hints(&claim), ["a > 0"]);
    }

    #[test]
    fn an_obstacle_is_written_in_the_symbols_of_the_statement() {
        let [a, b, c, d] = tree::symbols(["a", "b", "c", "d"]);
        assert_eq!(hints(&positive("", &a * &b * &c - &a * &d).assuming([&above_zero(&a)])), ["b c > d"]);
        let long = [&a, &b, &c, &d].into_iter().fold(Tree::from(0), |sum, x| sum + x * x * x);
        assert_eq!(hints(&positive("", long)), Vec::<String>::new());
        // Hypotheses replace a and d.
        let claim =
            positive("", &a * &b * &c - &d * &b).assuming(&[b.clone(), &a - &c, &d - &a].map(above_zero));
        assert_eq!(hints(&claim), ["a c > d"]);
    }

    /// Each of four signs suffices, and none follows from another.
    #[test]
    fn at_most_three_hypotheses_are_suggested() {
        let any = tree::symbols(["a", "b", "c", "d"]).map(|x| x.positive_part());
        let claim = positive("", any.into_iter().reduce(|sum, x| sum + x).unwrap());
        assert_eq!(hints(&claim), ["a > 0", "b > 0", "c > 0"]);
    }

    #[test]
    fn nothing_is_suggested_if_no_hypothesis_can_help() {
        let none = Vec::<String>::new();
        let one = || Tree::from(1);
        assert_eq!(hints(&equal("", one() / (one() - one()), 0)), none);
        let [a, b] = tree::symbols(["a", "b"]);
        assert_eq!(hints(&equal("", &a / (&b - &b), 0)), none);
        let large = (0..MAX_SIZE).fold(a.clone(), |sum, _| sum + &b);
        assert_eq!(hints(&positive("", large).assuming([&above_zero(a)])), none);
    }

    /// Tests the suggestions for some hundreds of claims; integers satisfy all hypotheses.
    #[test]
    fn suggestions_suffice_and_are_consistent() {
        let [a, b, c] = tree::symbols(["a", "b", "c"]);
        let parts = [a.clone(), b.clone(), &a - &b, &b - &c, &a * &b - &c, Tree::from(1)];
        let mut suggested = 0;
        for (i, j, k) in (0..216).map(|n| (n / 36, n / 6 % 6, n % 6)) {
            let of = &parts[i] + &parts[j] * &parts[k] / &parts[(i + j) % 5];
            let given = above_zero(parts[(j + k) % 5].clone());
            for claim in [non_negative("", &of), positive("", &of)].map(|claim| claim.assuming([&given])) {
                let Err(reason) = prove(&claim) else { continue };
                let hypotheses = sufficient_hypotheses(&claim, &reason);
                assert!(hypotheses.len() <= MAX_HINTS);
                for hypothesis in &hypotheses {
                    let claim = claim.clone().assuming([hypothesis]);
                    assert!(prove(&claim).is_ok(), "{of} ≥ 0 if {hypothesis}");
                    let mut points = integer_points(claim.hypotheses(), &["a", "b", "c"]);
                    assert!(points.next().is_some(), "{given} and {hypothesis}");
                }
                suggested += hypotheses.len();
            }
        }
        assert!(suggested > 100, "{suggested}");
    }
}

//! Contact laws without a corner: N (N − R) is a positive constant.

use super::explanation::Explanation;
use super::observation::{INFORMATIVE, Observation};
use super::scales::format_short;
use crate::chapter::{SpringMass, contact, system};
use crate::number::{Exact, PositivePart};
use num_traits::{One, Zero};

/// Returns the law that explains all answers, with its constant.
pub(super) fn smoothed_law(answers: &[&Observation], fit: &Exact) -> Option<Explanation> {
    let (name, k, unit) = match constant(answers, fit, |_| Exact::one()) {
        Some(k) => ("a smoothed corner, N = (R + √(R² + 4 k))/2", k, "N²"),
        None => {
            let k = constant(answers, fit, |system| system.c.clone())?;
            ("a barrier, N = k/(H − l − u)", k, "J")
        }
    };
    Some(Explanation::new(name, vec![format!("k = {} {unit}", format_short(&k))]))
}

/// Returns N (N − R)/unit if it is the same positive number in all answers, and clear in several.
fn constant(answers: &[&Observation], fit: &Exact, unit: fn(&SpringMass<Exact>) -> Exact) -> Option<Exact> {
    let values = answers.iter().map(|answer| {
        let (product, error) = product(answer, fit)?;
        let unit = unit(&answer.problem.system);
        Some((product / &unit, error / unit))
    });
    let values: Vec<_> = values.collect::<Option<_>>()?;
    let positive = values.iter().filter(|(k, _)| *k > Exact::zero());
    // The most accurate one.
    let (k, _) = positive.min_by(|(a, e), (b, f)| (e * b).cmp(&(f * a)))?;
    let is_same = values.iter().all(|(other, error)| (other - k).abs() <= *error);
    let clear = values.iter().filter(|(_, error)| Exact::from(100) * error <= *k);
    (is_same && clear.take(INFORMATIVE).count() == INFORMATIVE).then(|| k.clone())
}

/// Returns N (N − R) with its error; `None` without equilibrium.
fn product(answer: &Observation, fit: &Exact) -> Option<(Exact, Exact)> {
    let system = &answer.problem.system;
    let [Some(u), Some(n)] = answer.numbers() else { return None };
    let off = fit * &answer.scales[1] + n.abs() * Exact::power_of_two(-50);
    let rest = n - system::reaction(system);
    let error = (n.abs() + rest.abs() + &off) * &off;
    (contact::equilibrium(system, u, n).abs() <= off).then(|| (n * rest, error))
}

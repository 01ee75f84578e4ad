//! Proofs of bounds, which contain long expressions.

use super::ProofPrinter;
use super::algebra::Order;
use crate::proof::kernel::sign::{Certificate, Rule};
use crate::proof::kernel::{Assumption, Derivation, Direct, Justification, SignedRatio};

impl ProofPrinter<'_> {
    /// Writes the proof of a rounding bound: the common part of its cases once, and the size of long
    /// expressions.
    pub(super) fn law(&self, derivation: &Derivation) -> Option<Vec<String>> {
        fn leaves<'d>(
            derivation: &'d Derivation,
            path: Vec<String>,
            order: Order,
            all: &mut Vec<(String, &'d Direct)>,
        ) {
            match derivation {
                Derivation::Direct(direct) => all.push((path.join(", "), direct)),
                Derivation::Cases(on, positive, not) => {
                    for (branch, sign) in [(positive, "> 0"), (not, "≤ 0")] {
                        let case = format!("{} {sign}", order.poly_or_size(on));
                        leaves(branch, [path.clone(), vec![case]].concat(), order, all);
                    }
                }
            }
        }
        let mut all = Vec::new();
        leaves(derivation, Vec::new(), self.order(), &mut all);
        let (_, first) = all.first().filter(|(_, direct)| !direct.roundings.is_empty())?;
        let mut lines: Vec<_> = self.errors(first).into_iter().collect();
        let (common, _) = split_at_case(first);
        lines.extend(common.iter().filter_map(|assumption| self.format_use(assumption)));
        for (case, direct) in all {
            let Justification::Within(sides) = &direct.justification else { return None };
            let within = self.within(sides);
            if case.is_empty() {
                lines.extend(within);
            } else {
                lines.push(format!("where {case}:"));
                let (_, later) = split_at_case(direct);
                let uses = later.into_iter().filter_map(|assumption| self.format_use(assumption));
                lines.extend(uses.chain(within).map(|line| format!("  {line}")));
            }
        }
        Some(lines)
    }

    /// Formats the two differences of a bound and ± a quantity.
    pub(super) fn within(&self, sides: &[SignedRatio; 2]) -> [String; 2] {
        std::array::from_fn(|i| {
            let (what, signed) = (SIDES[i], &sides[i]);
            let value = self.order().ratio_or_size(&signed.value);
            let how = match [&signed.num, &signed.den].map(ends).iter().max() {
                Some(0) | None => "term by term".to_string(),
                Some(1) => "by the triangle inequality for the errors".to_string(),
                Some(ends) => format!("by the triangle inequality for the errors, at {ends} endpoints"),
            };
            let kept = signed
                .subtracted
                .as_ref()
                .map(|less| self.order().subtracted_multiple(less) + " ")
                .unwrap_or_default();
            format!("the bound {what} is {value} ≥ 0, {kept}{how}")
        })
    }

    /// Formats the two differences of a bound and ± a quantity, with the certificates of their signs.
    pub(super) fn within_in_full(&self, sides: &[SignedRatio; 2]) -> Vec<String> {
        let mut lines = Vec::new();
        for (what, signed) in SIDES.into_iter().zip(sides) {
            lines.push(format!("the bound {what} is ≥ 0:"));
            lines.extend(self.explain_sign(signed).into_iter().map(|line| format!("  {line}")));
        }
        lines
    }
}

/// Returns the assumptions before the first case, and what follows from those after it except from the cases.
fn split_at_case(direct: &Direct) -> (&[Assumption], Vec<&Assumption>) {
    let first_case = direct.assumptions.iter().position(Assumption::is_case);
    let first_case = first_case.unwrap_or(direct.assumptions.len());
    let (common, others) = direct.assumptions.split_at(first_case);
    (common, others.iter().filter(|assumption| !assumption.is_case()).collect())
}

/// Texts for the two differences of a bound and ± a quantity.
const SIDES: [&str; 2] = ["less it", "and it"];

/// Returns the number of endpoints of errors at which a sign is proved; 0 without errors.
fn ends(certificate: &Certificate) -> usize {
    match certificate.rule() {
        Rule::Endpoints { at, .. } => at.iter().map(|end| ends(end).max(1)).sum(),
        Rule::TriangleInequality(_) => 1,
        _ => 0,
    }
}

//! Proofs of bounds, in which much is long.

use super::Paper;
use super::algebra::Order;
use crate::proof::kernel::sign::{Certificate, Rule};
use crate::proof::kernel::{Because, Derivation, Direct, Signed};

impl Paper<'_> {
    /// A bound of what is rounded: what all of its cases have in common is said once, and what is long by its
    /// length.
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
        let (_, first) = all.first().filter(|(_, direct)| !direct.errors.is_empty())?;
        let mut lines: Vec<_> = self.errors(first).into_iter().collect();
        let given = first.supposed.iter().filter(|supposed| supposed.given.is_some());
        lines.extend(given.filter_map(|supposed| self.supposed(supposed)));
        for (case, direct) in all {
            let Because::Within(sides) = &direct.because else { return None };
            let within = self.within(sides);
            if case.is_empty() {
                lines.extend(within);
            } else {
                lines.push(format!("where {case}:"));
                lines.extend(within.into_iter().map(|line| format!("  {line}")));
            }
        }
        Some(lines)
    }

    /// The two numbers by which a bound exceeds a size.
    pub(super) fn within(&self, sides: &[Signed; 2]) -> [String; 2] {
        std::array::from_fn(|i| {
            let (what, signed) = (SIDES[i], &sides[i]);
            let value = self.order().ratio_or_size(&signed.value);
            let how = match [&signed.num, &signed.den].map(ends).iter().max() {
                Some(0) | None => "term by term".to_string(),
                Some(1) => "with the sizes of errors".to_string(),
                Some(ends) => format!("with the sizes of errors, at {ends} ends"),
            };
            let kept = signed.less.as_ref().map(|less| self.order().kept(less) + " ").unwrap_or_default();
            format!("the bound {what} is {value} ≥ 0, {kept}{how}")
        })
    }

    /// The two numbers by which a bound exceeds a size, with the certificates of their signs.
    pub(super) fn within_in_full(&self, sides: &[Signed; 2]) -> Vec<String> {
        let mut lines = Vec::new();
        for (what, signed) in SIDES.into_iter().zip(sides) {
            let value = self.order().ratio_or_size(&signed.value);
            lines.push(format!("the bound {what} is {value} ≥ 0:"));
            lines.extend(self.signed(signed).into_iter().map(|line| format!("  {line}")));
        }
        lines
    }
}

/// The two numbers by which a bound exceeds a size: the bound …
const SIDES: [&str; 2] = ["less it", "and it"];

/// The number of ends of errors at which a sign is found; 0 if there are no errors in it.
fn ends(certificate: &Certificate) -> usize {
    match certificate.rule() {
        Rule::Ends { at, .. } => at.iter().map(|end| ends(end).max(1)).sum(),
        Rule::Sizes(_) => 1,
        _ => 0,
    }
}

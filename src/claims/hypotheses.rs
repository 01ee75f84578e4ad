//! Hypotheses of the chapter's claims.

use super::prelude::{eta, member, precision};
use super::{Case, symbols};
use crate::chapter::{SpringMass, augmented, contact, penalty, rounding, system};
use crate::formula::{Hypothesis, Relation};
use crate::number::{PositivePart, Tree};
use std::sync::LazyLock;

macro_rules! hypotheses {
    (let $symbols:pat = symbols();
     $($name:ident $text:literal = $hypothesis:expr $(, solved for $symbol:expr)?;)*) => {
        /// Named hypotheses.
        #[derive(Debug)]
        pub struct Hypotheses {
            $(#[doc = concat!("`", $text, "`")] pub $name: Hypothesis,)*
        }

        impl Hypotheses {
            /// Returns all hypotheses.
            pub fn all(&self) -> impl Iterator<Item = &Hypothesis> {
                [$(&self.$name),*].into_iter()
            }
        }

        /// The documented texts.
        #[cfg(test)]
        const TEXTS: &[&str] = &[$($text),*];

        /// Returns the hypotheses.
        pub fn hypotheses() -> &'static Hypotheses {
            static HYPOTHESES: LazyLock<Hypotheses> = LazyLock::new(|| {
                let $symbols = symbols();
                Hypotheses {
                    $($name: $hypothesis$(.solved_for($symbol))?,)*
                }
            });
            &HYPOTHESES
        }
    };
}

/// Returns a bound of the distance of a computed deflection from the root for the multiplier computed before
/// it.
fn iterate_error(s: &SpringMass<Tree>, eps: &Tree) -> Tree {
    eta() * (Tree::from(5) * system::gap(s).abs() + Tree::from(5) * penalty::penetration(s, eps))
        + rounding::floor_scale(s, eps, precision())
}

// When points are constructed, gravity determines the sign of the reaction, so that the other parameters keep
// their sampled values.
fn positive(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::Positive, value.into())
}

fn non_negative(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::NonNegative, value.into())
}

fn zero(value: impl Into<Tree>) -> Hypothesis {
    Hypothesis::new(Relation::Zero, value.into())
}

hypotheses! {
    let Case { system: s, u, v, alpha, eps, eps4, lambda, q, k, t, tol, .. } = symbols();

    stiffness "c > 0" = positive(&s.c);
    penalty "ε > 0" = positive(eps);
    quartic "ε₄ ≥ 0" = non_negative(eps4);
    softening "ε < 0" = positive(-eps);
    penalty_below_minus_two_c "ε < −2 c" = positive(-eps - Tree::from(2) * &s.c);
    penalty_above_minus_two_c "ε + 2 c > 0" = positive(eps + Tree::from(2) * &s.c), solved for &s.c;
    penalty_of_minus_two_c "ε + 2 c = 0" = zero(eps + Tree::from(2) * &s.c);
    contact "R > 0" = positive(system::reaction(s)), solved for &s.g;
    in_contact "R ≥ 0" = non_negative(system::reaction(s)), solved for &s.g;
    grazing "R = 0" = zero(system::reaction(s)), solved for &s.g;
    separated "R < 0" = positive(-system::reaction(s)), solved for &s.g;
    zero_total_stiffness "c + ε = 0" = zero(penalty::total_stiffness(s, eps)), solved for eps;
    penalty_below_minus_c "c + ε < 0" = positive(-penalty::total_stiffness(s, eps)), solved for eps;
    penetrating "p > 0" = positive(contact::penetration(s, u)), solved for u;
    gap_open "p < 0" = positive(-contact::penetration(s, u)), solved for u;
    tolerance "tol > 0" = positive(tol);
    sufficient_penalty "ε ≥ R / tol − c" = non_negative(eps - penalty::penalty_for(s, tol));
    within_tolerance "tol ≥ R / (c + ε)" = non_negative(tol - penalty::penetration(s, eps));
    // ε is in N, since it is the force of an exact penalty (beyond 6).
    strong_enough "ε ≥ R" = non_negative(eps - system::reaction(s));
    multiplier "λ ≥ 0" = non_negative(lambda);
    below_reaction "λ < R" = positive(system::reaction(s) - lambda), solved for lambda;
    above_reaction "λ > R" = positive(lambda - system::reaction(s));
    at_reaction "λ = R" = zero(lambda - system::reaction(s));
    next_multiplier_nonnegative "(λ − R) q + R ≥ 0" =
        non_negative(augmented::multiplier_after(s, lambda, q)), solved for q;
    active "c λ + ε R ≥ 0" = non_negative(&s.c * lambda + eps * system::reaction(s)), solved for lambda;
    releases "c λ + ε R ≤ 0" = non_negative(-(&s.c * lambda + eps * system::reaction(s))), solved for lambda;
    inactive "λ + ε (l + u − H) ≤ 0" =
        non_negative(-augmented::update(s, eps, lambda, u)), solved for lambda;
    in_equilibrium "c u − m g + λ + ε (l + u − H) = 0" =
        zero(augmented::equilibrium(s, eps, lambda, u)), solved for lambda;
    next_in_equilibrium "c v − m g + λ + ε (l + u − H) + ε (l + v − H) = 0" = zero({
        let next = augmented::update(s, eps, lambda, u);
        augmented::equilibrium(s, eps, &next, v)
    }), solved for v;
    step "α > 0" = positive(alpha);
    short_step "α < 2 (c + ε)" =
        positive(Tree::from(2) * penalty::total_stiffness(s, eps) - alpha), solved for alpha;
    long_step "α > 2 (c + ε)" = positive(alpha - Tree::from(2) * penalty::total_stiffness(s, eps));
    uzawa_step "α < 2 c" = positive(Tree::from(2) * &s.c - alpha), solved for alpha;
    power "q > 0" = positive(q);
    count "k ≥ 0" = non_negative(k);
    time "t > 0" = positive(t);
    later_multiplier "v ≥ λ" = non_negative(v - lambda);
    // Hypotheses on floats, for 2ᵖ.
    fine_enough "ε (2ᵖ + 1) ≥ 64 (c + ε)" = non_negative(
        eps * (precision() + Tree::from(1)) - Tree::from(64) * penalty::total_stiffness(s, eps)
    ), solved for &s.c;
    computed_inside "fl(p) ≥ 0" = non_negative(contact::penetration(s, u).with_rounding());
    computed_repeats "λ = fl(λ + ε (l + u − H))" =
        zero(augmented::update(s, eps, lambda, u).with_rounding() - lambda), solved for &s.l;
    some_bits "2ᵖ > 0" = positive(precision());
    one_bit "2ᵖ > 1" = positive(precision() - Tree::from(1));
    decay "0 ≤ q ≤ 1" = Hypothesis::between(q, 0, 1);
    near_penalty "|u − (ε (H − l) + m g) / (c + ε)| ≤ η (5 |Δ| + 4 R / (c + ε)) (1 + 2 η)" = Hypothesis::near(
        u, penalty::deflection(s, eps), rounding::deflection_error(s, eps, precision())
    );
    near_iterate "|u − (m g − x₁ + ε (H − l)) / (c + ε)| ≤ η (5 |Δ| + 5 R / (c + ε)) + F" = Hypothesis::near(
        u,
        augmented::deflection(s, eps, member()),
        iterate_error(s, eps)
    );
    near_bilateral_iterate "|v − (m g − x₁ + ε (H − l)) / (c + ε)| ≤ η (5 |Δ| + 5 R / (c + ε)) + F" = Hypothesis::near(
        v, augmented::deflection(s, eps, member()), iterate_error(s, eps)
    );
    pushes "x₁ ≥ 0" = non_negative(member());
    near_bilateral
        "|v − (m g + ε (H − l)) / (c + ε)| ≤ 5 η (1 + 2 η) (|Δ| + |R| / (c + ε))" = Hypothesis::near(
        v,
        augmented::deflection(s, eps, &Tree::from(0)),
        Tree::from(5) * eta() * (Tree::from(1) + Tree::from(2) * eta())
            * (system::gap(s).abs() + system::reaction(s).abs() / penalty::total_stiffness(s, eps)),
    );
    near_next "|λ + R ρ q − R| ≤ 11 (c + ε) F" = Hypothesis::near(
        lambda,
        augmented::multiplier_after(s, &Tree::from(0), &(augmented::contraction(s, eps) * q)),
        rounding::multiplier_drift(s, eps, precision()),
    );
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::registry;

    #[test]
    fn hypotheses_are_documented_by_their_formulas() {
        let texts: Vec<_> =
            hypotheses().all().map(|hypothesis| registry().format_hypothesis(hypothesis)).collect();
        assert_eq!(TEXTS, texts);
    }
}

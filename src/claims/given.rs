//! What claims of the chapter suppose.

use super::{Case, symbols};
use crate::chapter::{augmented, contact, penalty, system};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;
use std::sync::LazyLock;

macro_rules! hypotheses {
    (let $symbols:pat = symbols();
     $($name:ident $text:literal = $relation:ident($value:expr) $(, solved for $symbol:expr)?;)*) => {
        /// The hypotheses, by names of their own.
        #[derive(Debug)]
        pub struct Given {
            $(#[doc = concat!("`", $text, "`")] pub $name: Hypothesis,)*
        }

        impl Given {
            /// All of them.
            pub fn all(&self) -> impl Iterator<Item = &Hypothesis> {
                [$(&self.$name),*].into_iter()
            }
        }

        /// As they are documented.
        #[cfg(test)]
        const TEXTS: &[&str] = &[$($text),*];

        /// The hypotheses.
        pub fn given() -> &'static Given {
            static GIVEN: LazyLock<Given> = LazyLock::new(|| {
                let $symbols = symbols();
                Given {
                    $($name: Hypothesis::new(Relation::$relation, $value.into())$(.solved_for($symbol))?,)*
                }
            });
            &GIVEN
        }
    };
}

// Where numbers are looked for, the reaction gets its sign by gravity, so that the other parameters stay as
// drawn.
hypotheses! {
    let Case { system: s, u, v, alpha, eps, eps4, lambda, q, k, t, tol, .. } = symbols();

    stiffness "c > 0" = Positive(&s.c);
    penalty "ε > 0" = Positive(eps);
    quartic "ε₄ ≥ 0" = NonNegative(eps4);
    softening "ε < 0" = Positive(-eps);
    beyond_twice "ε < −2 c" = Positive(-eps - Tree::from(2) * &s.c);
    within_twice "ε + 2 c > 0" = Positive(eps + Tree::from(2) * &s.c), solved for &s.c;
    twice "ε + 2 c = 0" = Zero(eps + Tree::from(2) * &s.c);
    contact "R > 0" = Positive(system::reaction(s)), solved for &s.g;
    touching "R ≥ 0" = NonNegative(system::reaction(s)), solved for &s.g;
    grazing "R = 0" = Zero(system::reaction(s)), solved for &s.g;
    separated "R < 0" = Positive(-system::reaction(s)), solved for &s.g;
    opposite "c + ε = 0" = Zero(penalty::total_stiffness(s, eps)), solved for eps;
    beyond_once "c + ε < 0" = Positive(-penalty::total_stiffness(s, eps)), solved for eps;
    penetrating "p > 0" = Positive(contact::penetration(s, u)), solved for u;
    clear "p < 0" = Positive(-contact::penetration(s, u)), solved for u;
    tolerance "tol > 0" = Positive(tol);
    enough "ε ≥ R / tol − c" = NonNegative(eps - penalty::penalty_for(s, tol));
    within_tolerance "tol ≥ R / (c + ε)" = NonNegative(tol - penalty::penetration(s, eps));
    // As the force of an exact penalty (beyond 6), ε is in N.
    strong_enough "ε ≥ R" = NonNegative(eps - system::reaction(s));
    multiplier "λ ≥ 0" = NonNegative(lambda);
    below_reaction "λ < R" = Positive(system::reaction(s) - lambda), solved for lambda;
    above_reaction "λ > R" = Positive(lambda - system::reaction(s));
    at_reaction "λ = R" = Zero(lambda - system::reaction(s));
    carried "(λ − R) q + R ≥ 0" = NonNegative(augmented::multiplier_after(s, lambda, q)), solved for q;
    active "c λ + ε R ≥ 0" = NonNegative(&s.c * lambda + eps * system::reaction(s)), solved for lambda;
    idle "c λ + ε R ≤ 0" = NonNegative(-(&s.c * lambda + eps * system::reaction(s))), solved for lambda;
    inactive "λ + ε (l + u − H) ≤ 0" =
        NonNegative(-augmented::update(s, eps, lambda, u)), solved for lambda;
    in_equilibrium "c u − m g + λ + ε (l + u − H) = 0" =
        Zero(augmented::equilibrium(s, eps, lambda, u)), solved for lambda;
    next_in_equilibrium "c v − m g + λ + ε (l + u − H) + ε (l + v − H) = 0" = Zero({
        let next = augmented::update(s, eps, lambda, u);
        augmented::equilibrium(s, eps, &next, v)
    }), solved for v;
    step "α > 0" = Positive(alpha);
    short_step "α < 2 (c + ε)" =
        Positive(Tree::from(2) * penalty::total_stiffness(s, eps) - alpha), solved for alpha;
    long_step "α > 2 (c + ε)" = Positive(alpha - Tree::from(2) * penalty::total_stiffness(s, eps));
    uzawa_step "α < 2 c" = Positive(Tree::from(2) * &s.c - alpha), solved for alpha;
    power "q > 0" = Positive(q);
    count "k ≥ 0" = NonNegative(k);
    time "t > 0" = Positive(t);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::registry;

    #[test]
    fn hypotheses_are_documented_as_they_are() {
        let texts: Vec<_> = given().all().map(|hypothesis| registry().supposed(hypothesis)).collect();
        assert_eq!(TEXTS, texts);
    }
}

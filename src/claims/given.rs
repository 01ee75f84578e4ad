//! What claims of the chapter suppose.

use super::{Case, symbols};
use crate::chapter::{augmented, contact, penalty, system};
use crate::formula::{Hypothesis, Relation};
use crate::number::Tree;
use std::sync::LazyLock;

macro_rules! hypotheses {
    (let $symbols:pat = symbols();
     $($name:ident = $relation:ident($value:expr) $(, solved for $symbol:expr)?;)*) => {
        /// The hypotheses, by names of their own.
        #[derive(Debug)]
        #[allow(missing_docs)]
        pub struct Given {
            $(pub $name: Hypothesis,)*
        }

        impl Given {
            /// All of them.
            pub fn all(&self) -> impl Iterator<Item = &Hypothesis> {
                [$(&self.$name),*].into_iter()
            }
        }

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

    stiffness = Positive(&s.c);
    penalty = Positive(eps);
    quartic = NonNegative(eps4);
    softening = Positive(-eps);
    beyond_twice = Positive(-eps - Tree::from(2) * &s.c);
    within_twice = Positive(eps + Tree::from(2) * &s.c), solved for &s.c;
    twice = Zero(eps + Tree::from(2) * &s.c);
    contact = Positive(system::reaction(s)), solved for &s.g;
    touching = NonNegative(system::reaction(s)), solved for &s.g;
    grazing = Zero(system::reaction(s)), solved for &s.g;
    separated = Positive(-system::reaction(s)), solved for &s.g;
    opposite = Zero(penalty::total_stiffness(s, eps)), solved for eps;
    beyond_once = Positive(-penalty::total_stiffness(s, eps)), solved for eps;
    penetrating = Positive(contact::penetration(s, u)), solved for u;
    clear = Positive(-contact::penetration(s, u)), solved for u;
    tolerance = Positive(tol);
    enough = NonNegative(eps - penalty::penalty_for(s, tol));
    within_tolerance = NonNegative(tol - penalty::penetration(s, eps));
    strong_enough = NonNegative(eps - system::reaction(s));
    multiplier = NonNegative(lambda);
    below_reaction = Positive(system::reaction(s) - lambda), solved for lambda;
    above_reaction = Positive(lambda - system::reaction(s));
    at_reaction = Zero(lambda - system::reaction(s));
    carried = NonNegative(augmented::multiplier_after(s, lambda, q)), solved for q;
    active = NonNegative(&s.c * lambda + eps * system::reaction(s)), solved for lambda;
    idle = NonNegative(-(&s.c * lambda + eps * system::reaction(s))), solved for lambda;
    inactive = NonNegative(-augmented::update(s, eps, lambda, u)), solved for lambda;
    in_equilibrium = Zero(augmented::equilibrium(s, eps, lambda, u)), solved for lambda;
    next_in_equilibrium = Zero({
        let next = augmented::update(s, eps, lambda, u);
        augmented::equilibrium(s, eps, &next, v)
    }), solved for v;
    step = Positive(alpha);
    short_step = Positive(Tree::from(2) * penalty::total_stiffness(s, eps) - alpha), solved for alpha;
    long_step = Positive(alpha - Tree::from(2) * penalty::total_stiffness(s, eps));
    uzawa_step = Positive(Tree::from(2) * &s.c - alpha), solved for alpha;
    power = Positive(q);
    count = NonNegative(k);
    time = Positive(t);
}

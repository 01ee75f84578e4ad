//! Compiled claims for checks in number systems.

use crate::formula::claim::{MEMBERS, POWER};
use crate::formula::statement::Sequence;
use crate::formula::{Hypothesis, Proposition, Relation, Statement};
use crate::number::tree::smooth_ops;
use crate::number::{PositivePart, Program, Tree};
use num_traits::One;

/// Test of the values of a [`Program`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Test {
    /// Two values are equal.
    Equal(usize, usize),
    /// A value has a sign.
    Sign(Relation, usize),
}

/// Claims with the same hypotheses, which are checked on the same cases.
pub(super) struct Group {
    pub(super) given: Vec<Hypothesis>,
    pub(super) program: Program,
    /// Each claim with its index and its tests.
    pub(super) claims: Vec<(usize, Vec<Test>)>,
}

/// Groups claims by their hypotheses.
pub(super) fn groups(claims: &[Statement]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (place, claim) in claims.iter().enumerate() {
        let i =
            groups.iter().position(|group| group.given == claim.stated_hypotheses()).unwrap_or_else(|| {
                groups.push(Group {
                    given: claim.stated_hypotheses().to_vec(),
                    program: Program::default(),
                    claims: Vec::new(),
                });
                groups.len() - 1
            });
        let group = &mut groups[i];
        let asked = propositions(claim).iter().filter_map(|says| asked(says, &mut group.program)).collect();
        group.claims.push((place, asked));
    }
    groups
}

fn asked(says: &Proposition, program: &mut Program) -> Option<Test> {
    let mut equal = |left: &Tree, right: &Tree| Test::Equal(program.add(left), program.add(right));
    match says {
        Proposition::Equal(left, right) => Some(equal(left, right)),
        Proposition::Derivative(of, by, is) => {
            let dual = of.derivative(by, &|name| Tree::symbol(name), &smooth_ops);
            dual.map(|dual| equal(&dual.derivative, is))
        }
        Proposition::Sign(relation, of) => Some(Test::Sign(*relation, program.add(of))),
        Proposition::Within(of, bound) => {
            Some(Test::Sign(Relation::NonNegative, program.add(&(bound - of.abs()))))
        }
        // The rate of the limit is checked instead.
        Proposition::Limit(..) => None,
    }
}

/// Number of steps for which a recursion is followed; its closed form is also checked for arbitrary q.
const STEPS: usize = 3;

/// Returns all propositions of a claim: its goals, and for a recursion its first members.
fn propositions(claim: &Statement) -> Vec<Proposition> {
    let mut all: Vec<_> = claim.goals().iter().map(|goal| goal.proposition.clone()).collect();
    let closed_form = claim.conclusion().filter(|sequence| !sequence.is_perturbed());
    if let Some(Sequence { ratio, start, step, member, .. }) = closed_form {
        let (mut x, mut power) = (start.clone(), Tree::one());
        for _ in 0..STEPS {
            let members: Vec<_> = MEMBERS.into_iter().zip(x).collect();
            x = step.iter().map(|step| step.substitute(&members)).collect();
            power = power * ratio;
            let closed = member.iter().map(|closed| closed.substitute(&[(POWER, power.clone())]));
            all.extend(x.iter().cloned().zip(closed).map(|(x, closed)| Proposition::Equal(x, closed)));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claims::{Case, hypotheses};
    use crate::formula::Rate;
    use crate::formula::claim::{derivative, equal, geometric_limit, induction, limit, non_negative, within};
    use crate::number::{Exact, Field};
    use crate::verify::checker::{NumberDomain, RationalDomain};
    use num_traits::Zero;

    fn x(name: &'static str) -> Tree {
        Tree::symbol(name)
    }

    fn int(n: i32) -> Tree {
        Tree::int(n)
    }

    /// Returns `true` if such a claim holds where every coordinate except q is 2.
    fn holds_at(q: i32, claim: Statement) -> bool {
        let groups = groups(&[claim]);
        let [Group { program, claims, .. }] = groups.as_slice() else { panic!("one group") };
        let case = Case { q: Exact::int(q), ..Case::of(|_| Exact::int(2)) };
        let values = program.run(&|name| case.get_by_symbol(name), &RationalDomain::step);
        let value = |place: &usize| values[*place].clone().expect("defined");
        let [(0, asked)] = claims.as_slice() else { panic!("one claim") };
        asked.iter().all(|asked| match asked {
            Test::Equal(left, right) => value(left) == value(right),
            Test::Sign(relation, x) => relation.admits(value(x).cmp(&Exact::zero())),
        })
    }

    fn holds(claim: Statement) -> bool {
        holds_at(2, claim)
    }

    #[test]
    fn common_subexpressions_are_computed_once() {
        let square = || x("u") * x("u");
        let sum = equal("sum", square() + square(), int(2) * square());
        let sign = non_negative("sign", square());
        let other = sign.clone().assuming([&hypotheses().stiffness]);
        let groups = groups(&[sum, other, sign]);
        let of = |group: &Group| group.claims.iter().map(|(place, _)| *place).collect::<Vec<_>>();
        assert_eq!(groups.iter().map(of).collect::<Vec<_>>(), [vec![0, 2], vec![1]]);
        assert_eq!(groups[0].program.len(), 5, "u, u², the sum, 2, and the product");
    }

    #[test]
    fn a_wrong_derivative_is_detected() {
        let square = |is: Tree| derivative("square", x("u") * x("u"), &x("u"), is);
        assert!(holds(square(x("u") + x("u"))) && !holds(square(x("u"))));
    }

    #[test]
    fn a_bound_limits_the_absolute_value() {
        for of in [x("u"), -x("u")] {
            let is_met = |bound: i32| holds(within("bound", of.clone(), bound));
            assert!(is_met(3) && is_met(2) && !is_met(1) && !is_met(-3));
        }
    }

    #[test]
    fn the_rate_of_a_limit_is_checked_on_either_side() {
        let limit = |of: Tree, rate| holds(limit("limit", of, &x("t"), x("u"), rate));
        for of in [x("u") + int(3), x("u") - int(3)] {
            assert!(limit(of.clone(), Rate::Within(int(3))) && !limit(of.clone(), Rate::Within(int(2))));
            assert!(!limit(of, Rate::Within(int(-3))), "no bound is negative");
        }
        assert!(limit(x("u") + int(3), Rate::Equal(int(3))));
        assert!(!limit(x("u") - int(3), Rate::Equal(int(3))));
    }

    #[test]
    fn powers_vanish_only_if_the_ratio_is_less_than_1_in_absolute_value() {
        let vanishing =
            |ratio: Tree, to: Tree| holds(geometric_limit("limit", ratio, x("u") + x("v") * x("q"), to));
        for half in [int(1) / int(2), int(-1) / int(2)] {
            assert!(vanishing(half, x("u")));
        }
        for large in [1, -1, 2, -2] {
            assert!(!vanishing(int(large), x("u")));
        }
        assert!(!vanishing(int(0), x("u") + x("v")), "it is the limit, not the first value");
    }

    /// x₀ = 3, x ← 2 x − 1, so x_k − 1 = 2 · 2ᵏ.
    #[test]
    fn an_induction_checks_its_start_its_step_and_its_closed_form() {
        let induction = |start: i32, less: i32, closed: Tree| {
            let step = |[x]: [Tree; 1]| [int(2) * x - int(less)];
            induction("powers", 2, [int(start)], step, [closed])
        };
        let closed = || int(2) * x("q") + int(1);
        assert!(holds(induction(3, 1, closed())));
        assert!(!holds(induction(4, 1, closed())));
        assert!(!holds(induction(3, 0, closed())));
        assert!(!holds(induction(3, 1, int(2) * x("q") + int(2))));
        assert!(!holds(induction(3, 1, x("q") + int(2))), "right at the start, and then a step late");
        // The start and the step at q = 2 are right, but not the third member.
        let late = [1, 2, 4].into_iter().fold(int(1), |off, n| off * (x("q") - int(n)));
        assert!(!holds(induction(3, 1, closed() + late)));
        // Right from 3 for all steps followed, and wrong for a power that no step meets: 3, 5, 9, 17, and so
        // on.
        let off = [1, 2, 4, 8].into_iter().fold(int(1), |off, n| off * (x("q") - int(n)));
        let followed = || induction(3, 1, closed() + &off);
        assert!(holds_at(2, followed()) && !holds_at(3, followed()));
    }
}

//! What a claim comes to in numbers, compiled.

use crate::claims::{Claim, Given, Kind, MEMBERS, Relation, Var};
use crate::number::Tree;
use crate::number::tree::{Program, smooth};
use crate::proof::Statement;
use crate::proof::statement::Says;
use num_traits::One;

/// What is asked of the values of a [`Program`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Asked {
    /// Are these equal?
    Equal(usize, usize),
    /// Has this the sign?
    Sign(Relation, usize),
}

/// The claims with the same hypotheses, which are tried on the same cases.
pub(super) struct Group {
    pub(super) given: &'static [Given],
    pub(super) program: Program,
    /// Each with its place among all claims, and what is asked.
    pub(super) claims: Vec<(usize, Vec<Asked>)>,
}

/// All claims, by their hypotheses.
pub(super) fn groups(claims: &[Claim]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (place, claim) in claims.iter().enumerate() {
        let i = groups.iter().position(|group| group.given == claim.given).unwrap_or_else(|| {
            groups.push(Group { given: claim.given, program: Program::default(), claims: Vec::new() });
            groups.len() - 1
        });
        let group = &mut groups[i];
        let asked = says(claim).iter().filter_map(|says| asked(says, &mut group.program)).collect();
        group.claims.push((place, asked));
    }
    groups
}

fn asked(says: &Says, program: &mut Program) -> Option<Asked> {
    let mut equal = |left: &Tree, right: &Tree| Asked::Equal(program.add(left), program.add(right));
    match says {
        Says::Equal(left, right) => Some(equal(left, right)),
        Says::Derivative(of, by, is) => {
            let dual = of.derivative(by.symbol(), &|name| Tree::symbol(name), &smooth);
            dual.map(|dual| equal(&dual.derivative, is))
        }
        Says::Sign(relation, of) => Some(Asked::Sign(*relation, program.add(of))),
        // By how fast it is reached, which is said beside it.
        Says::Limit(..) => None,
    }
}

/// A recursion is followed for this many steps; its closed form is also tried at any q.
const STEPS: usize = 3;

/// All that a claim says: what is to be proved, and of a recursion its first members.
fn says(claim: &Claim) -> Vec<Says> {
    let mut all: Vec<Says> = Statement::of(claim).goals.into_iter().map(|goal| goal.says).collect();
    if let Kind::Induction { ratio, start, step, closed } = &claim.kind {
        let (mut x, mut power) = (start.clone(), Tree::one());
        for _ in 0..STEPS {
            let members: Vec<_> = MEMBERS.into_iter().zip(x).collect();
            x = step.iter().map(|step| step.with(&members)).collect();
            power = power * ratio;
            let closed = closed.iter().map(|closed| closed.with(&[(Var::Q.symbol(), power.clone())]));
            all.extend(x.iter().cloned().zip(closed).map(|(x, closed)| Says::Equal(x, closed)));
        }
    }
    all
}

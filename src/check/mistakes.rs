//! Wrong programs: every small change of the formulas that give u and N, and what people do.
//!
//! All of them are recorded from the chapter's functions, called otherwise than they should be, so that they
//! can be computed with and printed.

use super::{CASES, Family, Problem, problems};
use crate::chapter::{SpringMass, contact, lagrange, penalty, structure, system};
use crate::claims::{entry_of, registry, symbols};
use crate::number::tree::{Site, piecewise};
use crate::number::{Exact, PositivePart, Tree};
use crate::proof::controls::{Change, changes_in};
use num_traits::Zero;
use std::collections::HashMap;
use std::sync::LazyLock;

/// u in m and N in N, as formulas.
pub(super) type Formulas = [Tree; 2];

/// What a wrong program computes.
#[derive(Clone, Debug)]
pub(super) struct Mistake {
    /// What is wrong.
    pub name: String,
    /// Where R > 0.
    pub touching: Formulas,
    /// Everywhere else.
    pub apart: Formulas,
    /// Where in the chapter's source that is one edit.
    pub at: Vec<String>,
    /// Whose force by its penetration is ε, if the formulas have one that nobody has told.
    pub measured: Option<Measured>,
}

/// What shows the penalty of a program that does not tell it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measured {
    /// N/p
    ByForce,
    /// (m g − c u)/p where the plane should not act.
    ByEquilibrium,
}

impl Mistake {
    fn new(name: &str, formulas: Formulas) -> Self {
        Mistake {
            name: name.to_string(),
            touching: formulas.clone(),
            apart: formulas,
            at: Vec::new(),
            measured: None,
        }
    }

    /// Do its formulas have an ε?
    pub fn has_penalty(&self) -> bool {
        self.touching.iter().chain(&self.apart).any(|formula| formula.symbols().contains("ε"))
    }

    /// What it computes where R > 0, or elsewhere.
    pub fn formulas(&self, touching: bool) -> &Formulas {
        if touching { &self.touching } else { &self.apart }
    }

    /// u and N as an expression: `u = min(m g / c, H − l), N = 0`.
    pub fn formula(&self) -> String {
        let both = |[u, n]: &Formulas| {
            let is_u = |tree: &Tree| tree.site() == u.site() && tree == u;
            let short = n.rewrite(&|tree| is_u(tree).then(|| symbols().u.clone()));
            format!("u = {u}, N = {short}")
        };
        if self.touching == self.apart {
            both(&self.touching)
        } else {
            format!("{} if R > 0, else {}", both(&self.touching), both(&self.apart))
        }
    }
}

/// The value of a formula for a system and a penalty; `None` where it divides by zero.
pub(super) fn value<T: PositivePart>(tree: &Tree, system: &SpringMass<T>, penalty: Option<&T>) -> Option<T> {
    let SpringMass { c, m, g, l, h } = system;
    let known = [("c", c), ("m", m), ("g", g), ("l", l), ("H", h)].into_iter();
    let known: Vec<_> = known.chain(penalty.map(|eps| ("ε", eps))).collect();
    let symbol = |name: &str| known.iter().find(|(own, _)| *own == name).map(|(_, x)| (*x).clone());
    let all = tree.symbols().into_iter().all(|name| symbol(name).is_some());
    all.then(|| tree.replay(&|name| symbol(name).expect("known"), &piecewise)).flatten()
}

/// What is right: u in m and N in N of Lagrange, or by penalty.
pub(super) fn right<T: PositivePart>(system: &SpringMass<T>, penalty: Option<&T>) -> [T; 2] {
    match penalty {
        None => [contact::deflection(system), contact::contact_force(system)],
        Some(eps) => {
            let u = penalty::unilateral_deflection(system, eps);
            let n = penalty::contact_force(system, eps, &u).positive_part();
            [u, n]
        }
    }
}

/// The same of a plane that also pulls.
fn bilateral(system: &SpringMass<Tree>, penalty: Option<&Tree>) -> Formulas {
    match penalty {
        None => [lagrange::deflection(system), lagrange::multiplier(system)],
        Some(eps) => {
            let u = penalty::deflection(system, eps);
            let n = penalty::contact_force(system, eps, &u);
            [u, n]
        }
    }
}

/// Every mistake of solvers by Lagrange, or by penalty. No two of them are the same function, and none is
/// right: of those that are the same to all the systems of a run by default, the first is left, with the
/// places of all.
pub(super) fn mistakes(by_penalty: bool) -> &'static [Mistake] {
    static LAGRANGE: LazyLock<Vec<Mistake>> = LazyLock::new(|| different(false));
    static PENALTY: LazyLock<Vec<Mistake>> = LazyLock::new(|| different(true));
    if by_penalty { &PENALTY } else { &LAGRANGE }
}

fn different(by_penalty: bool) -> Vec<Mistake> {
    let none = values(&none(by_penalty));
    let mut places: HashMap<Vec<Option<Exact>>, usize> = HashMap::new();
    let mut different: Vec<Mistake> = Vec::new();
    for mistake in every(by_penalty) {
        let values = values(&mistake);
        if let Some(&place) = places.get(&values) {
            different[place].at.extend(mistake.at);
        } else if values != none {
            places.insert(values, different.len());
            different.push(mistake);
        }
    }
    different
}

/// What is right, for comparison.
pub(super) fn none(by_penalty: bool) -> Mistake {
    Mistake::new("none", right(&symbols().system, by_penalty.then_some(&symbols().eps)))
}

/// Every mistake, and some more than once.
pub(super) fn every(by_penalty: bool) -> Vec<Mistake> {
    let eps = &symbols().eps;
    let penalty = by_penalty.then_some(eps);
    let own = &symbols().system;
    let mut all = people(own, penalty);
    if !by_penalty {
        all.extend(unasked(own, eps));
    }
    for (formulas, besides) in
        [(right(own, penalty), ""), (bilateral(own, penalty), "the plane also pulls, and ")]
    {
        let edited = |change: Change| edited(change, &formulas, besides);
        // Who has no penalty takes nothing for it.
        let is_possible = |mistake: &Mistake| by_penalty || !mistake.has_penalty();
        let changes = changes_in(&formulas, registry()).into_iter();
        all.extend(changes.map(edited).filter(is_possible));
    }
    all
}

/// What a mistake computes on the systems of a run by default, each with a penalty of its own.
pub(super) fn values(mistake: &Mistake) -> Vec<Option<Exact>> {
    static SYSTEMS: LazyLock<Vec<Problem>> = LazyLock::new(|| problems(1, CASES, &Family::ALL));
    let numbered = SYSTEMS.iter().map(|problem| &problem.system).zip(2..);
    let values = numbered.flat_map(|(system, penalty)| {
        let penalty = Exact::from(penalty);
        let formulas = mistake.formulas(system::reaction(system) > Exact::zero());
        formulas.each_ref().map(|formula| value(formula, system, Some(&penalty)))
    });
    values.collect()
}

/// What people do.
fn people(own: &SpringMass<Tree>, penalty: Option<&Tree>) -> Vec<Mistake> {
    let of = |system: SpringMass<Tree>| right(&system, penalty);
    let [u, n] = right(own, penalty);
    let SpringMass { g, l, h, .. } = own;
    let (zero, one, gap) = (Tree::from(0), Tree::from(1), system::gap(own));
    let while_touching = |name: &str, force: Tree| Mistake {
        apart: [u.clone(), zero.clone()],
        ..Mistake::new(name, [u.clone(), force])
    };
    vec![
        Mistake::new("the plane also pulls", bilateral(own, penalty)),
        Mistake::new("there is no plane", [structure::deflection(own), zero.clone()]),
        Mistake::new("H and l are swapped", of(SpringMass { l: h.clone(), h: l.clone(), ..own.clone() })),
        Mistake::new("H is taken for the gap", of(SpringMass { l: zero.clone(), ..own.clone() })),
        Mistake::new("l is added to H", of(SpringMass { l: -l, ..own.clone() })),
        Mistake::new(
            "an overlap is taken for no gap",
            of(SpringMass { h: l + gap.positive_part(), ..own.clone() }),
        ),
        Mistake::new("the gap is taken without its sign", of(SpringMass { h: l + gap.abs(), ..own.clone() })),
        Mistake::new("gravity is reversed", of(SpringMass { g: -g, ..own.clone() })),
        Mistake::new(
            "gravity is 9.81 whatever it is",
            of(SpringMass { g: Tree::from(981) / Tree::from(100), ..own.clone() }),
        ),
        Mistake::new("m is taken for the weight", of(SpringMass { g: one.clone(), ..own.clone() })),
        Mistake::new("g is taken for the weight", of(SpringMass { m: one, ..own.clone() })),
        Mistake::new("N has the other sign", [u.clone(), -&n]),
        while_touching("N is the weight", system::weight(own)),
        while_touching("N is the force of the spring", structure::spring_force(own, &u)),
        Mistake::new("u is the length of the spring", [l + &u, n.clone()]),
        Mistake::new("u is counted from the plane", [contact::penetration(own, &u), n.clone()]),
        Mistake::new("u is counted from the plane upwards", [-contact::penetration(own, &u), n.clone()]),
        Mistake::new("u is counted upwards", [-&u, n.clone()]),
        Mistake::new("u and N are swapped", [n, u.clone()]),
    ]
}

/// Methods with a penalty that nobody asked for.
fn unasked(own: &SpringMass<Tree>, eps: &Tree) -> Vec<Mistake> {
    let measured = |measured, mistake: Mistake| Mistake { measured: Some(measured), ..mistake };
    let (exact, [pulled, pull]) = (right(own, None), bilateral(own, Some(eps)));
    let zero = Tree::from(0);
    let update = |name: &str, force: Tree| Mistake {
        touching: exact.clone(),
        ..Mistake::new(name, [pulled.clone(), force])
    };
    vec![
        measured(Measured::ByForce, Mistake::new("it is the penalty method", right(own, Some(eps)))),
        measured(
            Measured::ByForce,
            Mistake::new(
                "it is the penalty method, and the plane also pulls",
                [pulled.clone(), pull.clone()],
            ),
        ),
        measured(Measured::ByEquilibrium, update("only the update of the augmentation is bracketed", zero)),
        measured(
            Measured::ByEquilibrium,
            update("only the update of the augmentation is bracketed, and N is not", pull),
        ),
    ]
}

/// The formulas after a change of the source.
fn edited(change: Change, formulas: &Formulas, besides: &str) -> Mistake {
    let label = label(change.site);
    let name = format!("{besides}as {label} with {}", change.what);
    let changed = formulas.each_ref().map(|tree| change.rewrite(tree));
    Mistake { at: vec![change.to_string()], ..Mistake::new(&name, changed) }
}

/// The number of the equation that is written at a place of the source.
fn label(site: Site) -> String {
    let own = registry().formulas().iter().find(|formula| formula.tree.any(&|tree| tree.site() == site));
    own.and_then(|own| entry_of(own.path)).map_or(site.to_string(), |entry| entry.label())
}

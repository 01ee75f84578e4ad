//! Wrong programs: every small change of the formulas that give u and N, and what people do.
//!
//! All of them are recorded from the chapter's functions, called otherwise than they should be, so that they
//! can be computed with and printed.

mod fitted;

pub(super) use fitted::fitted;

use super::{CASES, Family, Problem, problems};
use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use crate::claims::{entry_of, registry, symbols};
use crate::number::tree::{Site, Step, piecewise};
use crate::number::{Exact, PositivePart, ToExact, Tree};
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
    /// Where R > 0, or what it takes for R.
    pub touching: Formulas,
    /// Everywhere else.
    pub apart: Formulas,
    /// What it takes for R, in N, if it is another.
    pub decision: Option<Tree>,
    /// Where in the chapter's source that is one edit.
    pub at: Vec<String>,
    /// Whose force by its penetration is ε, if the formulas have one that nobody has told.
    pub measured: Option<Measured>,
    /// From which an answer's k is found, if the formulas have one; `{k}` in the name stands for it.
    pub estimates: Vec<Estimate>,
    /// Whether k is a share of an iteration's way, between 0 and 2.
    pub is_share: bool,
}

/// From which the constant k of a program is found.
#[derive(Clone, Debug)]
pub(super) enum Estimate {
    /// A formula of k, u and N that is linear in k, and 0 for some answers.
    Equation(Tree),
    /// u (0) or N (1) of an answer, relative to what is right.
    Ratio(usize),
    /// u (0) or N (1) of an answer.
    Number(usize),
    /// The penalty by which so many augmentations leave the penetration of an answer.
    Augmentations(i32),
}

/// ε and k, where they are known.
#[derive(Debug)]
pub(super) struct Constants<'a, T> {
    pub penalty: Option<&'a T>,
    pub factor: Option<&'a T>,
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
    pub fn new(name: &str, formulas: Formulas) -> Self {
        Mistake {
            name: name.to_string(),
            touching: formulas.clone(),
            apart: formulas,
            decision: None,
            at: Vec::new(),
            measured: None,
            estimates: Vec::new(),
            is_share: false,
        }
    }

    /// Is it one edit of the chapter's source?
    pub fn is_edit(&self) -> bool {
        !self.at.is_empty()
    }

    /// Do its formulas have an ε?
    pub fn has_penalty(&self) -> bool {
        self.touching.iter().chain(&self.apart).any(|formula| formula.symbols().contains("ε"))
    }

    /// Do its formulas have a k?
    pub fn has_factor(&self) -> bool {
        self.touching.iter().chain(&self.apart).any(|formula| formula.symbols().contains("k"))
    }

    /// What it takes for R.
    pub fn reaction(&self, system: &SpringMass<Exact>, constants: &Constants<Exact>) -> Exact {
        let own = self.decision.as_ref().and_then(|decision| value(decision, system, constants));
        own.unwrap_or_else(|| system::reaction(system))
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
            let decision = self.decision.as_ref().map_or("R".to_string(), Tree::to_string);
            format!("{} if {decision} > 0, else {}", both(&self.touching), both(&self.apart))
        }
    }
}

/// The value of a formula for a system and constants; `None` where it divides by zero, or has a quantity that
/// is not known.
pub(super) fn value<T: PositivePart>(
    tree: &Tree,
    system: &SpringMass<T>,
    constants: &Constants<T>,
) -> Option<T> {
    value_with(tree, system, constants, &piecewise)
}

/// Like [`value`], where what is rounded is rounded to single precision.
pub(super) fn value_in_single(
    tree: &Tree,
    system: &SpringMass<Exact>,
    penalty: Option<&Exact>,
) -> Option<Exact> {
    let extra = |step: Step<&Exact>| match step {
        Step::Rounded(x) => x.to_f32().ok()?.to_exact().ok(),
        other => piecewise(other),
    };
    value_with(tree, system, &Constants { penalty, factor: None }, &extra)
}

fn value_with<T: PositivePart>(
    tree: &Tree,
    system: &SpringMass<T>,
    constants: &Constants<T>,
    extra: &impl Fn(Step<&T>) -> Option<T>,
) -> Option<T> {
    let SpringMass { c, m, g, l, h } = system;
    let known = [("c", c), ("m", m), ("g", g), ("l", l), ("H", h)].into_iter();
    let known = known.chain(constants.penalty.map(|eps| ("ε", eps)));
    let known: Vec<_> = known.chain(constants.factor.map(|k| ("k", k))).collect();
    let symbol = |name: &str| known.iter().find(|(own, _)| *own == name).map(|(_, x)| (*x).clone());
    let all = tree.symbols().into_iter().all(|name| symbol(name).is_some());
    all.then(|| tree.replay(&|name| symbol(name).expect("known"), extra)).flatten()
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

/// What a mistake computes on the systems of a run by default, each with a penalty of its own, and k = 7.
pub(super) fn values(mistake: &Mistake) -> Vec<Option<Exact>> {
    static SYSTEMS: LazyLock<Vec<Problem>> = LazyLock::new(|| problems(1, CASES, &Family::ALL));
    let numbered = SYSTEMS.iter().map(|problem| &problem.system).zip(2..);
    let values = numbered.flat_map(|(system, penalty)| {
        let constants = Constants { penalty: Some(&Exact::from(penalty)), factor: Some(&Exact::from(7)) };
        let formulas = mistake.formulas(system::reaction(system) > Exact::zero());
        formulas.each_ref().map(|formula| value(formula, system, &constants))
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
    let with_force = |name: &str, force: Tree| Mistake::new(name, [u.clone(), force]);
    let added = system::weight(own) + structure::spring_force(own, &u);
    // Of the right deflection, as of a plane that also pulls.
    let force = match penalty {
        None => system::reaction(own),
        Some(eps) => penalty::contact_force(own, eps, &u),
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
        with_force("N has the other sign", -&n),
        with_force("N has the other sign, and no bracket", -&force),
        with_force("N is taken without its sign", force.abs()),
        while_touching("the force of the spring is added to the weight in N", added.clone()),
        with_force("the force of the spring is added to the weight in N, also apart", added),
        with_force("N is always 0", zero.clone()),
        Mistake::new("u is always 0", [zero.clone(), n.clone()]),
        Mistake::new("u and N are always 0", [zero.clone(), zero.clone()]),
        while_touching("N is the weight", system::weight(own)),
        while_touching("N is the force of the spring", structure::spring_force(own, &u)),
        Mistake::new("u is the length of the spring", [l + &u, n.clone()]),
        Mistake::new("u is counted from the plane", [contact::penetration(own, &u), n.clone()]),
        Mistake::new("u is counted from the plane upwards", [-contact::penetration(own, &u), n.clone()]),
        Mistake::new("u is counted upwards", [-&u, n.clone()]),
        Mistake::new("u and N are swapped", [n, u.clone()]),
    ]
}

/// Programs that round to single precision in one place, and compute in double elsewhere.
pub(super) fn in_single(by_penalty: bool) -> &'static [Mistake] {
    static LAGRANGE: LazyLock<Vec<Mistake>> = LazyLock::new(|| with_one_rounding(false));
    static PENALTY: LazyLock<Vec<Mistake>> = LazyLock::new(|| with_one_rounding(true));
    if by_penalty { &PENALTY } else { &LAGRANGE }
}

fn with_one_rounding(by_penalty: bool) -> Vec<Mistake> {
    let own = &symbols().system;
    let penalty = by_penalty.then_some(&symbols().eps);
    let SpringMass { c, m, g, l, h } = own;
    let of = |system: SpringMass<Tree>| right(&system, penalty);
    let [u, n] = right(own, penalty);
    let single = |name: &str, formulas: Formulas| {
        Mistake::new(&format!("{name} is rounded to single precision"), formulas)
    };
    let computed = |name: &str, formulas: Formulas| {
        Mistake::new(&format!("{name} is computed in single precision"), formulas)
    };
    let with_gap = |gap: Tree| of(SpringMass { l: Tree::from(0), h: gap, ..own.clone() });
    let gap = (h.nearest() - l.nearest()).nearest();
    let spring_force = structure::spring_force(own, &system::gap(own));
    let reaction = (system::weight(own).nearest() - spring_force.nearest()).nearest();
    let mut all = vec![
        single("c", of(SpringMass { c: c.nearest(), ..own.clone() })),
        single("m", of(SpringMass { m: m.nearest(), ..own.clone() })),
        single("g", of(SpringMass { g: g.nearest(), ..own.clone() })),
        single("l", of(SpringMass { l: l.nearest(), ..own.clone() })),
        single("H", of(SpringMass { h: h.nearest(), ..own.clone() })),
        single("H − l", with_gap(system::gap(own).nearest())),
        computed("H − l", with_gap(gap)),
        single("u", [u.nearest(), n.clone()]),
        single("N", [u.clone(), n.nearest()]),
    ];
    if !by_penalty {
        all.push(computed("R = m g − c (H − l)", [u, reaction.positive_part()]));
    }
    all
}

/// What is right, each of its numbers rounded.
pub(super) fn rounded_once(by_penalty: bool) -> Mistake {
    let right = right(&symbols().system, by_penalty.then_some(&symbols().eps));
    Mistake::new("rounded", right.each_ref().map(Tree::nearest))
}

/// What is right of parameters that are rounded.
pub(super) fn with_rounded_parameters(by_penalty: bool) -> Mistake {
    let system = symbols().system.map(Tree::nearest);
    Mistake::new("rounded parameters", right(&system, by_penalty.then_some(&symbols().eps)))
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

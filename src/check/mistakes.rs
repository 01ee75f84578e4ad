//! Known mistakes: every small mutation of the formulas for u and N, and common mistakes.
//!
//! They are recorded from the chapter's functions, called wrongly, so that they can be computed and printed.

mod fitted;

pub(super) use fitted::fitted;

use super::{CASES, Family, Problem, problems};
use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use crate::claims::{entry_for_function, function_at, registry, symbols};
use crate::number::tree::{Op, Site, piecewise_ops};
use crate::number::{Exact, PositivePart, ToExact, Tree};
use crate::proof::mutation::{Mutant, mutants_in};
use num_traits::Zero;
use std::collections::HashMap;
use std::sync::LazyLock;

/// u in m and N in N, as formulas.
pub(super) type Formulas = [Tree; 2];

/// Formulas of a wrong program.
#[derive(Clone, Debug)]
pub(super) struct Mistake {
    /// Description of the mistake.
    pub name: String,
    /// Formulas for R > 0, or for its replacement `decision`.
    pub in_contact: Formulas,
    /// Formulas otherwise.
    pub separated: Formulas,
    /// Replacement of R, in N, if the decision is wrong.
    pub decision: Option<Tree>,
    /// Edits of the chapter's source that cause the mistake.
    pub at: Vec<String>,
    /// Force from which ε is determined, if the formulas contain an ε that is not reported.
    pub measured: Option<PenaltyEvidence>,
    /// Equations from which k is determined, if the formulas contain a k, which `{k}` in the name denotes.
    pub estimates: Vec<Estimate>,
    /// Whether k is a fraction of the full step of an iteration, between 0 and 2.
    pub is_share: bool,
}

/// Equation for the constant k of a program.
#[derive(Clone, Debug)]
pub(super) enum Estimate {
    /// A formula of k, u and N that is linear in k, and 0 for some answers.
    Equation(Tree),
    /// u (0) or N (1) of an answer, relative to the right value.
    Ratio(usize),
    /// u (0) or N (1) of an answer.
    Number(usize),
    /// Penalty for which this number of augmentations leaves the penetration of an answer.
    Augmentations(i32),
}

/// ε and k, if they are known.
#[derive(Debug)]
pub(super) struct Constants<'a, T> {
    pub penalty: Option<&'a T>,
    pub factor: Option<&'a T>,
}

/// Force from which an unreported penalty is determined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PenaltyEvidence {
    /// N/p
    ByForce,
    /// (m g − c u)/p for a separated system
    ByEquilibrium,
}

impl Mistake {
    pub fn new(name: &str, formulas: Formulas) -> Self {
        Mistake {
            name: name.to_string(),
            in_contact: formulas.clone(),
            separated: formulas,
            decision: None,
            at: Vec::new(),
            measured: None,
            estimates: Vec::new(),
            is_share: false,
        }
    }

    /// Returns `true` if a single edit of the chapter's source causes the mistake.
    pub fn is_edit(&self) -> bool {
        !self.at.is_empty()
    }

    /// Returns `true` if its formulas contain ε.
    pub fn has_penalty(&self) -> bool {
        self.in_contact.iter().chain(&self.separated).any(|formula| formula.symbols().contains("ε"))
    }

    /// Returns the value that decides the state in place of R.
    pub fn reaction(&self, system: &SpringMass<Exact>, constants: &Constants<Exact>) -> Exact {
        let own = self.decision.as_ref().and_then(|decision| value(decision, system, constants));
        own.unwrap_or_else(|| system::reaction(system))
    }

    /// Returns the formulas for R > 0, or otherwise.
    pub fn formulas(&self, touching: bool) -> &Formulas {
        if touching { &self.in_contact } else { &self.separated }
    }

    /// Formats u and N: `u = min(m g / c, H − l), N = 0`.
    pub fn formula(&self) -> String {
        let both = |[u, n]: &Formulas| {
            let is_u = |tree: &Tree| tree.site() == u.site() && tree == u;
            let short = n.rewrite(&|tree| is_u(tree).then(|| symbols().u.clone()));
            format!("u = {u}, N = {short}")
        };
        if self.in_contact == self.separated {
            both(&self.in_contact)
        } else {
            let decision = self.decision.as_ref().map_or("R".to_string(), Tree::to_string);
            format!("{} if {decision} > 0, else {}", both(&self.in_contact), both(&self.separated))
        }
    }
}

/// Returns the value of a formula for a system and constants; `None` if it divides by zero, or contains an
/// unknown quantity.
pub(super) fn value<T: PositivePart>(
    tree: &Tree,
    system: &SpringMass<T>,
    constants: &Constants<T>,
) -> Option<T> {
    value_with(tree, system, constants, &piecewise_ops)
}

/// Like [`value`], with roundings to single precision.
pub(super) fn value_in_single(
    tree: &Tree,
    system: &SpringMass<Exact>,
    penalty: Option<&Exact>,
) -> Option<Exact> {
    let extra = |step: Op<&Exact>| match step {
        Op::Rounded(x) => x.to_f32().ok()?.to_exact().ok(),
        other => piecewise_ops(other),
    };
    value_with(tree, system, &Constants { penalty, factor: None }, &extra)
}

fn value_with<T: PositivePart>(
    tree: &Tree,
    system: &SpringMass<T>,
    constants: &Constants<T>,
    extra: &impl Fn(Op<&T>) -> Option<T>,
) -> Option<T> {
    let symbol = |name: &str| match name {
        "ε" => constants.penalty.cloned(),
        "k" => constants.factor.cloned(),
        name => system.by_symbol(name).cloned(),
    };
    let all = tree.symbols().into_iter().all(|name| symbol(name).is_some());
    all.then(|| tree.eval(&|name| symbol(name).expect("known"), extra)).flatten()
}

/// Returns the right formulas of u in m and N in N, by Lagrange multiplier or by penalty.
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

/// Returns the formulas for bilateral contact.
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

/// Returns the mistakes of solvers by Lagrange multiplier, or by penalty. They are distinct functions, and
/// none is right: of those that agree for all default systems, only the first is kept, with the edits of all.
pub(super) fn mistakes(by_penalty: bool) -> &'static [Mistake] {
    static LAGRANGE: LazyLock<Vec<Mistake>> = LazyLock::new(|| distinct_mistakes(false));
    static PENALTY: LazyLock<Vec<Mistake>> = LazyLock::new(|| distinct_mistakes(true));
    if by_penalty { &PENALTY } else { &LAGRANGE }
}

fn distinct_mistakes(by_penalty: bool) -> Vec<Mistake> {
    let none = values(&reference(by_penalty));
    let mut places: HashMap<Vec<Option<Exact>>, usize> = HashMap::new();
    let mut different: Vec<Mistake> = Vec::new();
    for mistake in candidates(by_penalty) {
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

/// Returns the right formulas for comparison.
pub(super) fn reference(by_penalty: bool) -> Mistake {
    Mistake::new("none", right(&symbols().system, by_penalty.then_some(&symbols().eps)))
}

/// Returns all mistakes, some repeatedly.
pub(super) fn candidates(by_penalty: bool) -> Vec<Mistake> {
    let eps = &symbols().eps;
    let penalty = by_penalty.then_some(eps);
    let own = &symbols().system;
    let mut all = common_mistakes(own, penalty);
    if !by_penalty {
        all.extend(unrequested_methods(own, eps));
    }
    for (formulas, besides) in
        [(right(own, penalty), ""), (bilateral(own, penalty), "the plane also pulls, and ")]
    {
        let edited = |change: Mutant| edited(change, &formulas, besides);
        // A program without a penalty does not use ε by mistake.
        let is_possible = |mistake: &Mistake| by_penalty || !mistake.has_penalty();
        let changes = mutants_in(&formulas, registry()).into_iter();
        all.extend(changes.map(edited).filter(is_possible));
    }
    all
}

/// Returns the values of a mistake for the default systems, with a different penalty for each, and k = 7.
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

/// Returns common mistakes of programmers.
fn common_mistakes(own: &SpringMass<Tree>, penalty: Option<&Tree>) -> Vec<Mistake> {
    let of = |system: SpringMass<Tree>| right(&system, penalty);
    let [u, n] = right(own, penalty);
    let SpringMass { g, l, h, .. } = own;
    let (zero, one, gap) = (Tree::from(0), Tree::from(1), system::gap(own));
    let while_touching = |name: &str, force: Tree| Mistake {
        separated: [u.clone(), zero.clone()],
        ..Mistake::new(name, [u.clone(), force])
    };
    let with_force = |name: &str, force: Tree| Mistake::new(name, [u.clone(), force]);
    let added = system::weight(own) + structure::spring_force(own, &u);
    // The force of the right deflection with bilateral contact.
    let force = match penalty {
        None => system::reaction(own),
        Some(eps) => penalty::contact_force(own, eps, &u),
    };
    vec![
        Mistake::new("the plane also pulls", bilateral(own, penalty)),
        Mistake::new("there is no plane", [structure::deflection(own), zero.clone()]),
        Mistake::new("H and l are swapped", of(SpringMass { l: h.clone(), h: l.clone(), ..own.clone() })),
        Mistake::new("H is used as the gap", of(SpringMass { l: zero.clone(), ..own.clone() })),
        Mistake::new("l is added to H", of(SpringMass { l: -l, ..own.clone() })),
        Mistake::new(
            "an overlap is treated as a zero gap",
            of(SpringMass { h: l + gap.positive_part(), ..own.clone() }),
        ),
        Mistake::new(
            "the absolute value of the gap is used",
            of(SpringMass { h: l + gap.abs(), ..own.clone() }),
        ),
        Mistake::new("gravity is reversed", of(SpringMass { g: -g, ..own.clone() })),
        Mistake::new(
            "gravity is always 9.81",
            of(SpringMass { g: Tree::from(981) / Tree::from(100), ..own.clone() }),
        ),
        Mistake::new("m is used as the weight", of(SpringMass { g: one.clone(), ..own.clone() })),
        Mistake::new("g is used as the weight", of(SpringMass { m: one, ..own.clone() })),
        with_force("N has the wrong sign", -&n),
        with_force("N has the wrong sign, and no bracket", -&force),
        with_force("N is replaced by its absolute value", force.abs()),
        while_touching("the spring force is added to the weight in N", added.clone()),
        with_force("the spring force is added to the weight in N, also when separated", added),
        with_force("N is always 0", zero.clone()),
        Mistake::new("u is always 0", [zero.clone(), n.clone()]),
        Mistake::new("u and N are always 0", [zero.clone(), zero.clone()]),
        while_touching("N is the weight", system::weight(own)),
        while_touching("N is the spring force", structure::spring_force(own, &u)),
        Mistake::new("u is the length of the spring", [l + &u, n.clone()]),
        Mistake::new("u is measured from the plane", [contact::penetration(own, &u), n.clone()]),
        Mistake::new("u is measured upwards from the plane", [-contact::penetration(own, &u), n.clone()]),
        Mistake::new("u is measured upwards", [-&u, n.clone()]),
        Mistake::new("u and N are swapped", [n, u.clone()]),
    ]
}

/// Returns programs with one rounding to single precision, which otherwise compute in double precision.
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
    let gap = (h.round() - l.round()).round();
    let spring_force = structure::spring_force(own, &system::gap(own));
    let reaction = (system::weight(own).round() - spring_force.round()).round();
    let mut all = vec![
        single("c", of(SpringMass { c: c.round(), ..own.clone() })),
        single("m", of(SpringMass { m: m.round(), ..own.clone() })),
        single("g", of(SpringMass { g: g.round(), ..own.clone() })),
        single("l", of(SpringMass { l: l.round(), ..own.clone() })),
        single("H", of(SpringMass { h: h.round(), ..own.clone() })),
        single("H − l", with_gap(system::gap(own).round())),
        computed("H − l", with_gap(gap)),
        single("u", [u.round(), n.clone()]),
        single("N", [u.clone(), n.round()]),
    ];
    if !by_penalty {
        all.push(computed("R = m g − c (H − l)", [u, reaction.positive_part()]));
    }
    all
}

/// Returns the right formulas with rounded results.
pub(super) fn rounded_once(by_penalty: bool) -> Mistake {
    let right = right(&symbols().system, by_penalty.then_some(&symbols().eps));
    Mistake::new("rounded", right.each_ref().map(Tree::round))
}

/// Returns the right formulas with rounded parameters.
pub(super) fn with_rounded_parameters(by_penalty: bool) -> Mistake {
    let system = symbols().system.map(Tree::round);
    Mistake::new("rounded parameters", right(&system, by_penalty.then_some(&symbols().eps)))
}

/// Returns methods with a penalty that the problem does not contain.
fn unrequested_methods(own: &SpringMass<Tree>, eps: &Tree) -> Vec<Mistake> {
    let measured = |measured, mistake: Mistake| Mistake { measured: Some(measured), ..mistake };
    let (exact, [pulled, pull]) = (right(own, None), bilateral(own, Some(eps)));
    let zero = Tree::from(0);
    let update = |name: &str, force: Tree| Mistake {
        in_contact: exact.clone(),
        ..Mistake::new(name, [pulled.clone(), force])
    };
    vec![
        measured(PenaltyEvidence::ByForce, Mistake::new("it is the penalty method", right(own, Some(eps)))),
        measured(
            PenaltyEvidence::ByForce,
            Mistake::new(
                "it is the penalty method, and the plane also pulls",
                [pulled.clone(), pull.clone()],
            ),
        ),
        measured(
            PenaltyEvidence::ByEquilibrium,
            update("only the update of the augmentation is bracketed", zero),
        ),
        measured(
            PenaltyEvidence::ByEquilibrium,
            update("only the update of the augmentation is bracketed, and N is not", pull),
        ),
    ]
}

/// Returns the formulas after a mutation.
fn edited(change: Mutant, formulas: &Formulas, besides: &str) -> Mistake {
    let label = label(change.site);
    let name = format!("{besides}as {label} with {}", change.mutation);
    let changed = formulas.each_ref().map(|tree| change.rewrite(tree));
    Mistake { at: vec![change.to_string()], ..Mistake::new(&name, changed) }
}

/// Returns the label of the equation at a site of the source.
fn label(site: Site) -> String {
    function_at(site).and_then(entry_for_function).map_or(site.to_string(), |entry| entry.label())
}

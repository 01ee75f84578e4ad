//! Mistakes with an unknown constant, which is determined from the answers.

use super::*;

/// Largest number of augmentations for which a program counts as one with a fixed number of them. For more, n
/// with a penalty ε and n + 1 with n/(n + 1) ε are almost the same.
const STEPS: i32 = 8;

/// Returns mistakes with an unknown constant: a wrong unit, a bound, an incomplete iteration.
pub(in crate::check) fn fitted(by_penalty: bool) -> &'static [Mistake] {
    static LAGRANGE: LazyLock<Vec<Mistake>> = LazyLock::new(|| with_a_constant(false));
    static PENALTY: LazyLock<Vec<Mistake>> = LazyLock::new(|| with_a_constant(true));
    if by_penalty { &PENALTY } else { &LAGRANGE }
}

fn with_a_constant(by_penalty: bool) -> Vec<Mistake> {
    let (own, eps) = (&symbols().system, &symbols().eps);
    let penalty = by_penalty.then_some(eps);
    let [k, u, n] = ["k", "u", "N"].map(|name| Tree::symbol(name));
    let [exact_u, exact_n] = right(own, penalty);
    let SpringMass { c, m, l, h, .. } = own;
    // The program solves another system: equilibrium holds for it, and in contact the law of the plane.
    let input = |name: &str, system: SpringMass<Tree>, penalty: Option<Tree>| {
        let plane = match &penalty {
            None => contact::penetration(&system, &u),
            Some(eps) => penalty::contact_force(&system, eps, &u) - &n,
        };
        let estimates = [contact::equilibrium(&system, &u, &n), plane].map(Estimate::Equation);
        let name = format!("{name} is {{k}} times the right value");
        Mistake { estimates: estimates.into(), ..Mistake::new(&name, right(&system, penalty.as_ref())) }
    };
    let own_penalty = || penalty.cloned();
    let with = |name: &str, formulas: Formulas, estimate: Estimate| Mistake {
        estimates: vec![estimate],
        ..Mistake::new(name, formulas)
    };
    let mut all = vec![
        input("c", SpringMass { c: &k * c, ..own.clone() }, own_penalty()),
        input("m g", SpringMass { m: &k * m, ..own.clone() }, own_penalty()),
        input("l", SpringMass { l: &k * l, ..own.clone() }, own_penalty()),
        input("H", SpringMass { h: &k * h, ..own.clone() }, own_penalty()),
        input("H − l", SpringMass { l: &k * l, h: &k * h, ..own.clone() }, own_penalty()),
        with("u is at most {k} m", [exact_u.min(&k), exact_n.clone()], Estimate::Number(0)),
        with("N is at most {k} N", [exact_u.clone(), exact_n.min(&k)], Estimate::Number(1)),
    ];
    if by_penalty {
        all.push(input("ε", own.clone(), Some(&k * eps)));
    }
    // An iteration for u that ends at the fraction k, with N right or from equilibrium: from zero deflection;
    // likewise, with the plane as a bound; and from the free deflection. Equilibrium then gives the force of
    // a penalty that is a multiple of c, as it does for a start at the plane.
    let (free, gap) = (structure::deflection(own), system::gap(own));
    let from_zero = ("the iteration for u stops at {k} of the way from 0", &k * &exact_u, Estimate::Ratio(0));
    let mut lacking = vec![from_zero];
    if !by_penalty {
        let free_at_k = structure::deflection(&SpringMass { m: &k * m, ..own.clone() });
        let equation = |deflection: &Tree| Estimate::Equation(deflection - &u);
        let bounded = "the iteration for u, bounded by the plane, stops at {k} of the way from 0";
        lacking.push((bounded, free_at_k.min(&gap), equation(&free_at_k)));
        let name = format!("{bounded}, with N where it reaches the plane");
        let arriving = with(&name, [gap.clone(), system::reaction(own)], equation(&free_at_k));
        all.push(Mistake {
            separated: [free_at_k.clone(), Tree::from(0)],
            decision: Some(system::reaction(&SpringMass { m: &k * m, ..own.clone() })),
            is_share: true,
            ..arriving
        });
        let between = |end: &Tree| &free + &k * (end - &free);
        let from_free = "the iteration for u stops at {k} of the way from the free deflection";
        for (name, deflection, estimate) in [
            (bounded, free_at_k.min(&gap), equation(&free_at_k)),
            (from_free, between(&exact_u), equation(&between(&gap))),
        ] {
            let way = with(name, [deflection, exact_n.clone()], estimate);
            all.push(Mistake { is_share: true, ..way });
        }
    }
    // A fixed number of augmentations from λ = 0, with a penalty that is not a multiple of c.
    let augmentations = (2..STEPS + 1).filter(|_| !by_penalty);
    all.extend(augmentations.map(|steps| {
        let (zero, contraction) = (Tree::from(0), augmented::contraction(own, &k));
        let decay = |steps: i32| (1..steps).fold(contraction.clone(), |decay, _| decay * &contraction);
        let deflection = augmented::deflection_after(own, &k, &zero, &decay(steps - 1));
        // With the rounding of its last update.
        let before = augmented::multiplier_after(own, &zero, &decay(steps - 1));
        let force = augmented::update(own, &k, &before, &deflection);
        let touching = [deflection, force];
        let name = format!("the augmentation stops after {steps} steps, with ε = {{k}} N/m");
        let apart = [free.clone(), zero];
        Mistake { separated: apart, ..with(&name, touching, Estimate::Augmentations(steps)) }
    }));
    for (name, deflection, estimate) in lacking {
        let force = augmented::contact_force(own, &deflection);
        let bracket = force.positive_part();
        for (force, besides) in [
            (force, ", and N is the equilibrium residual"),
            (bracket, ", and N is the positive equilibrium residual"),
        ] {
            let way = with(&format!("{name}{besides}"), [deflection.clone(), force], estimate.clone());
            all.push(Mistake { is_share: true, ..way });
        }
    }
    all
}

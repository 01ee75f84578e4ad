//! Programs with a constant that nobody knows, which is found from their answers.

use super::*;

/// Augmentations after which a program is still taken for one that ends after a fixed number of them. Of
/// more, n with a penalty ε and n + 1 with n/(n + 1) of it hardly differ.
const STEPS: i32 = 8;

/// Programs with a constant that nobody knows: a unit, a bound, an iteration that ends early.
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
    // Of the system that the program takes its own for: equilibrium holds, and in contact the law of the
    // plane.
    let input = |name: &str, system: SpringMass<Tree>, penalty: Option<Tree>| {
        let plane = match &penalty {
            None => contact::penetration(&system, &u),
            Some(eps) => penalty::contact_force(&system, eps, &u) - &n,
        };
        let estimates = [contact::equilibrium(&system, &u, &n), plane].map(Estimate::Equation);
        let name = format!("{name} is {{k}} times what is right");
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
    // An iteration for u that ends at k of its way, and N that is right or what equilibrium lacks: from no
    // deflection; the same, while the plane is a bound; and from where the mass hangs free. What equilibrium
    // lacks on that last way is the force of a penalty, a multiple of c, as on one from the plane.
    let (free, gap) = (structure::deflection(own), system::gap(own));
    let from_zero = ("the iteration for u ends at {k} of its way from 0", &k * &exact_u, Estimate::Ratio(0));
    let mut lacking = vec![from_zero];
    if !by_penalty {
        let free_at_k = structure::deflection(&SpringMass { m: &k * m, ..own.clone() });
        let equation = |deflection: &Tree| Estimate::Equation(deflection - &u);
        let bounded = "the iteration for u, bounded by the plane, ends at {k} of its way from 0";
        lacking.push((bounded, free_at_k.min(&gap), equation(&free_at_k)));
        let name = format!("{bounded}, and there is N where it arrives at the plane");
        let arriving = with(&name, [gap.clone(), system::reaction(own)], equation(&free_at_k));
        all.push(Mistake {
            apart: [free_at_k.clone(), Tree::from(0)],
            decision: Some(system::reaction(&SpringMass { m: &k * m, ..own.clone() })),
            is_share: true,
            ..arriving
        });
        let between = |end: &Tree| &free + &k * (end - &free);
        let from_free = "the iteration for u ends at {k} of its way from the free deflection";
        for (name, deflection, estimate) in [
            (bounded, free_at_k.min(&gap), equation(&free_at_k)),
            (from_free, between(&exact_u), equation(&between(&gap))),
        ] {
            let way = with(name, [deflection, exact_n.clone()], estimate);
            all.push(Mistake { is_share: true, ..way });
        }
    }
    // As many augmentations for every system, from λ = 0, where the penalty is no multiple of c.
    let augmentations = (2..STEPS + 1).filter(|_| !by_penalty);
    all.extend(augmentations.map(|steps| {
        let (zero, contraction) = (Tree::from(0), augmented::contraction(own, &k));
        let decay = |steps: i32| (1..steps).fold(contraction.clone(), |decay, _| decay * &contraction);
        let deflection = augmented::deflection_after(own, &k, &zero, &decay(steps - 1));
        // With the rounding of its last update.
        let before = augmented::multiplier_after(own, &zero, &decay(steps - 1));
        let force = augmented::update(own, &k, &before, &deflection);
        let touching = [deflection, force];
        let name = format!("the augmentation ends after {steps} steps, with ε = {{k}} N/m");
        let apart = [free.clone(), zero];
        Mistake { apart, ..with(&name, touching, Estimate::Augmentations(steps)) }
    }));
    for (name, deflection, estimate) in lacking {
        let force = augmented::contact_force(own, &deflection);
        let bracket = force.positive_part();
        for (force, besides) in [
            (force, ", and N is what equilibrium lacks"),
            (bracket, ", and N is what equilibrium lacks if that pushes"),
        ] {
            let way = with(&format!("{name}{besides}"), [deflection.clone(), force], estimate.clone());
            all.push(Mistake { is_share: true, ..way });
        }
    }
    all
}

//! Comparison of the known mistakes with programs written from their names.

use super::*;

/// Returns u and N of a program with the mistake of this name and constant.
fn misled(name: &str, problem: &Problem, k: &Exact) -> [Exact; 2] {
    let Problem { system: own, penalty, .. } = problem;
    let (SpringMass { c, m, g, l, h }, zero, one) = (own, Exact::zero(), number("1"));
    let solved = |system: SpringMass<Exact>, penalty: Option<Exact>| {
        let answer = right(&Problem { system, penalty, ..problem.clone() });
        [answer.deflection, answer.contact_force].map(Option::unwrap)
    };
    let of = |system| solved(system, penalty.clone());
    let [u, n] = of(own.clone());
    let (weight, gap) = (m * g, h - l);
    let (free, spring, touching) = (&weight / c, c * &u, weight > c * &gap);
    let balance = |u: &Exact| &weight - c * u;
    let by_spring = |eps: &Exact| [(&weight + eps * &gap) / (c + eps), eps * balance(&gap) / (c + eps)];
    // The deflection and the force of a plane that also pulls; and those of a penalty that was not asked for.
    let pulled = penalty.as_ref().map_or_else(|| [gap.clone(), balance(&gap)], by_spring);
    let unbracketed = penalty.as_ref().map_or_else(|| balance(&gap), |eps| eps * (&u - &gap));
    let [soft, pull] = by_spring(&number("2"));
    let while_touching = |force: Exact| [u.clone(), if touching { force } else { zero.clone() }];
    let with_force = |force: Exact| [u.clone(), force];
    let with_deflection = |deflection: Exact| [deflection, n.clone()];
    let gap_of = |gap: Exact| of(SpringMass { l: zero.clone(), h: gap, ..own.clone() });
    if let Some(quantity) = name.strip_suffix(" is {k} times the right value") {
        return match quantity {
            "c" => of(SpringMass { c: k * c, ..own.clone() }),
            "m g" => of(SpringMass { g: k * g, ..own.clone() }),
            "l" => of(SpringMass { l: k * l, ..own.clone() }),
            "H" => of(SpringMass { h: k * h, ..own.clone() }),
            "H − l" => gap_of(k * gap),
            "ε" => solved(own.clone(), penalty.as_ref().map(|eps| k * eps)),
            _ => panic!("{name}"),
        };
    }
    if let Some(quantity) = name.strip_suffix(" is rounded to single precision") {
        return match quantity {
            "c" => of(SpringMass { c: single(c), ..own.clone() }),
            "m" => of(SpringMass { m: single(m), ..own.clone() }),
            "g" => of(SpringMass { g: single(g), ..own.clone() }),
            "l" => of(SpringMass { l: single(l), ..own.clone() }),
            "H" => of(SpringMass { h: single(h), ..own.clone() }),
            "H − l" => gap_of(single(&gap)),
            "u" => with_deflection(single(&u)),
            "N" => with_force(single(&n)),
            _ => panic!("{name}"),
        };
    }
    let stopped = "the iteration for u stops at {k} of the way from ";
    if let Some(way) = name.strip_prefix(stopped) {
        let part = k * &u;
        return match way {
            "the free deflection" => with_deflection(&free + k * (&u - &free)),
            "0, and N is the equilibrium residual" => [part.clone(), balance(&part)],
            "0, and N is the positive equilibrium residual" => [part.clone(), balance(&part).positive_part()],
            _ => panic!("{name}"),
        };
    }
    let bounded = "the iteration for u, bounded by the plane, stops at {k} of the way from 0";
    if let Some(force) = name.strip_prefix(bounded) {
        let end = PositivePart::min(&(k * &free), &gap);
        let arrives = end == gap;
        let force = match force {
            "" => n,
            ", with N where it reaches the plane" if arrives => balance(&gap),
            ", with N where it reaches the plane" => zero,
            ", and N is the equilibrium residual" => balance(&end),
            ", and N is the positive equilibrium residual" => balance(&end).positive_part(),
            _ => panic!("{name}"),
        };
        return [end, force];
    }
    match name {
        "u is at most {k} m" => with_deflection(PositivePart::min(&u, k)),
        "N is at most {k} N" => with_force(PositivePart::min(&n, k)),
        "the plane also pulls" => pulled,
        "there is no plane" => [free, zero],
        "H and l are swapped" => of(SpringMass { l: h.clone(), h: l.clone(), ..own.clone() }),
        "H is used as the gap" => gap_of(h.clone()),
        "l is added to H" => gap_of(h + l),
        "an overlap is treated as a zero gap" => gap_of(gap.positive_part()),
        "the absolute value of the gap is used" => gap_of(gap.abs()),
        "gravity is reversed" => of(SpringMass { g: -g, ..own.clone() }),
        "gravity is always 9.81" => of(SpringMass { g: number("9.81"), ..own.clone() }),
        "m is used as the weight" => of(SpringMass { g: one, ..own.clone() }),
        "g is used as the weight" => of(SpringMass { m: one, ..own.clone() }),
        "N has the wrong sign" => with_force(-n),
        "N has the wrong sign, and no bracket" => with_force(-unbracketed),
        "N is replaced by its absolute value" => with_force(unbracketed.abs()),
        "the spring force is added to the weight in N" => while_touching(weight + spring),
        "the spring force is added to the weight in N, also when separated" => with_force(weight + spring),
        "N is always 0" => with_force(zero),
        "u is always 0" => with_deflection(zero),
        "u and N are always 0" => [zero.clone(), zero],
        "N is the weight" => while_touching(weight),
        "N is the spring force" => while_touching(spring),
        "u is the length of the spring" => with_deflection(l + &u),
        "u is measured from the plane" => with_deflection(&u - gap),
        "u is measured upwards from the plane" => with_deflection(gap - &u),
        "u is measured upwards" => with_deflection(-u),
        "u and N are swapped" => [n, u],
        "it is the penalty method" if touching => [soft, pull],
        "it is the penalty method" => [free, zero],
        "it is the penalty method, and the plane also pulls" => [soft, pull],
        "only the update of the augmentation is bracketed" if !touching => [soft, zero],
        "only the update of the augmentation is bracketed, and N is not" if !touching => [soft, pull],
        _ if name.starts_with("only the update") => [u, n],
        "H − l is computed in single precision" => gap_of(single(&(single(h) - single(l)))),
        "R = m g − c (H − l) is computed in single precision" => {
            with_force(single(&(single(&weight) - single(&(c * &gap)))).positive_part())
        }
        _ => panic!("{name}"),
    }
}

/// Mutations of the source are named by their place; an augmentation with few steps has a test of its own.
#[test]
fn mistakes_compute_what_their_names_state() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        let by_penalty = problems[0].penalty.is_some();
        let all = [mistakes(by_penalty), fitted(by_penalty), in_single(by_penalty)].concat();
        let named = |name: &str| {
            !name.starts_with("as ") && !name.contains(", and as ") && !name.starts_with("the augmentation")
        };
        for mistake in all.iter().filter(|mistake| named(&mistake.name)) {
            for (problem, k) in problems.iter().flat_map(|problem| ["3/4", "7"].map(|k| (problem, number(k))))
            {
                let two = number("2");
                let penalty = problem.penalty.as_ref().or(mistake.measured.map(|_| &two));
                let constants = Constants { penalty, factor: Some(&k) };
                let touching = mistake.reaction(&problem.system, &constants) > Exact::zero();
                let value = |tree| {
                    value(tree, &problem.system, &constants)
                        .or_else(|| value_in_single(tree, &problem.system, penalty))
                };
                let found = mistake.formulas(touching).each_ref().map(value);
                assert_eq!(
                    found,
                    misled(&mistake.name, problem, &k).map(Some),
                    "{}: {}",
                    problem.id,
                    mistake.name
                );
            }
        }
    }
}

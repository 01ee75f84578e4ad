//! Tests of the right programs, and of wrong ones by their results.

use super::*;
use crate::check::program::{in_some_answers, references};

/// Formulas for u and N of a person who writes R = m g − c gap.
type Edit = fn(&SpringMass<Exact>) -> [Exact; 2];

fn if_positive(decides: Exact, [u, n]: [Exact; 2], system: &SpringMass<Exact>) -> [Exact; 2] {
    if decides > Exact::zero() { [u, n] } else { [structure::deflection(system), Exact::zero()] }
}

/// Returns edits of each kind with their names.
pub fn hand_written_edits() -> [(&'static str, Edit); 10] {
    [
        ("u = min(g / c, gap) instead of min(m g / c, gap)", |s| {
            let u = (&s.g / &s.c).min(system::gap(s));
            let force = system::weight(s) - structure::spring_force(s, &u);
            [u, force.positive_part()]
        }),
        ("R = m g + c gap instead of m g − c gap", |s| {
            let reaction = system::weight(s) + &s.c * system::gap(s);
            if_positive(reaction.clone(), [system::gap(s), reaction], s)
        }),
        ("in contact u = H + l instead of H − l", |s| {
            if_positive(system::reaction(s), [&s.h + &s.l, system::reaction(s)], s)
        }),
        ("N = ⟨m g − c (H + l)⟩ instead of ⟨m g − c (H − l)⟩", |s| {
            let reaction = system::weight(s) - &s.c * (&s.h + &s.l);
            [contact::deflection(s), reaction.positive_part()]
        }),
        ("the plane acts if −R > 0 instead of if R > 0", |s| {
            if_positive(-system::reaction(s), [system::gap(s), system::reaction(s)], s)
        }),
        ("in contact N = m − c u instead of m g − c u", |s| {
            if_positive(system::reaction(s), [system::gap(s), &s.m - &s.c * system::gap(s)], s)
        }),
        ("without contact u = m g instead of m g / c", |s| {
            let apart = [system::weight(s), Exact::zero()];
            if system::reaction(s) > Exact::zero() { [system::gap(s), system::reaction(s)] } else { apart }
        }),
        ("c and m are swapped", |s| {
            let swapped = SpringMass { c: s.m.clone(), m: s.c.clone(), ..s.clone() };
            [contact::deflection(&swapped), contact::contact_force(&swapped)]
        }),
        ("0 is used for l", |s| {
            let changed = SpringMass { l: Exact::zero(), ..s.clone() };
            [contact::deflection(&changed), contact::contact_force(&changed)]
        }),
        ("l + u − H is returned as u", |s| {
            let u = contact::deflection(s);
            [contact::penetration(s, &u), contact::contact_force(s)]
        }),
    ]
}

fn answer_of(edit: Edit, problem: &Problem) -> Answer {
    let [u, n] = edit(&problem.system);
    Answer::new(u, n)
}

#[test]
fn references_are_right() {
    for problems in [default_problems(), with_penalties(default_problems())] {
        for program in references(problems[0].penalty.is_some()) {
            for problem in &problems {
                let found = answer(&program.results(), problem, None);
                assert_eq!(found, right(problem), "{:?}", program.lines());
            }
        }
    }
}

#[test]
fn edits_change_what_they_say() {
    let others: [(&str, Edit); 4] = [
        ("gap = H − H instead of H − l", |s| {
            if_positive(system::weight(s), [Exact::zero(), system::weight(s)], s)
        }),
        ("in contact N = m g − c gap instead of m g − c u", |s| {
            [contact::deflection(s), contact::contact_force(s)]
        }),
        ("N = |R| instead of ⟨R⟩", |s| [contact::deflection(s), system::reaction(s).abs()]),
        ("m g + c u is returned as N", |s| {
            let u = contact::deflection(s);
            [u.clone(), system::weight(s) + structure::spring_force(s, &u)]
        }),
    ];
    let (all, problems) = (edits(false), default_problems());
    for (name, edit) in hand_written_edits().into_iter().chain(others) {
        let changes = |mistake: &Mistake| {
            problems.iter().all(|problem| answer(&mistake.results, problem, None) == answer_of(edit, problem))
        };
        // The right programs have results of the same name.
        assert!(all.iter().filter(|mistake| mistake.name == name).any(changes), "{name}");
    }
    // No number is edited, and nothing is divided by 0.
    let useless = |name: &str| name.ends_with(" instead of 0") || name.contains("/ 0");
    assert!(all.iter().chain(&edits(true)).all(|mistake| !useless(&mistake.name)));
}

/// A parameter for a number k.
type Change = fn(&Exact, &Exact) -> Exact;

#[test]
fn numbers_change_what_they_say() {
    let (k, all) = (number("1/3"), numbers(false));
    let assert_changes = |name: &str, symbols: &[&str], change: Change| {
        let mistake = all.iter().find(|mistake| mistake.name == name).expect(name);
        for problem in default_problems() {
            let parameters = SpringMass::SYMBOLS.zip(problem.system.as_ref());
            let system = parameters
                .map(|(symbol, x)| if symbols.contains(symbol) { change(x, &k) } else { (*x).clone() });
            let found = answer(&mistake.results, &problem, Some(&k));
            assert_eq!(found, right(&Problem { system, ..problem }), "{name}");
        }
    };
    for x in SpringMass::SYMBOLS.into_array() {
        assert_changes(&format!("{x} is {{k}} times the right value"), &[x], |x, k| k * x);
        assert_changes(&format!("{x} is always {{k}}"), &[x], |_, k| k.clone());
        assert_changes(&format!("{{k}} is added to {x}"), &[x], |x, k| x + k);
    }
    assert_changes("l and H are {k} times the right values", &["l", "H"], |x, k| k * x);
}

#[test]
fn decisions_change_the_state_only() {
    let all = in_some_answers(false);
    let states: [(&str, Edit); 3] = [
        ("the plane always acts", |s| [system::gap(s), system::reaction(s)]),
        ("the plane never acts", |s| [structure::deflection(s), Exact::zero()]),
        ("the mass is held at the plane, with N = 0", |s| [system::gap(s), Exact::zero()]),
    ];
    for (name, state) in states {
        let mistake = all.iter().find(|mistake| mistake.name == name).expect(name);
        for problem in default_problems() {
            assert_eq!(answer(&mistake.results, &problem, None), answer_of(state, &problem), "{name}");
        }
    }
}

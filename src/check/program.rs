//! Programs for u and N as a person writes them, with one edit, or with one unknown number.
//!
//! Their formulas are recorded from the chapter's functions, so they can be computed, changed and printed.

use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use crate::claims::symbols;
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Tree};

/// u in m and N in N, as formulas.
pub(super) type Formulas = [Tree; 2];

/// The quantities of a program that have the same unit, so that one may be taken for another.
const ALIKE: [&[&str]; 3] = [&["c", "ε"], &["l", "H", "gap", "u", "p"], &["R", "N"]];

/// A result of a program.
#[derive(Clone, Debug, PartialEq)]
struct Step {
    name: &'static str,
    /// Its formula, of the parameters and of earlier results.
    value: Tree,
}

/// A program: intermediate results, and u and N, or these for each of two states.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    steps: Vec<Step>,
    /// Whether the last steps are the quantity that is positive in contact, u and N in contact, and u and N
    /// otherwise. They are u and N if not.
    has_branches: bool,
    /// The returned u and N, as functions of the computed ones.
    returned: Formulas,
}

/// The results of a program as functions of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Results {
    /// The quantity that is positive in contact, if there are two states.
    pub condition: Option<Tree>,
    /// u and N in contact.
    pub contact: Formulas,
    /// u and N otherwise.
    pub separated: Formulas,
}

/// A wrong program.
#[derive(Clone, Debug)]
pub(super) struct Mistake {
    /// Description of the mistake, in which `{k}` denotes an unknown number.
    pub name: String,
    /// The program.
    pub program: Program,
    /// Its results.
    pub results: Results,
    /// Number of augmentations, if k is their penalty.
    pub augmentations: Option<i32>,
    /// Whether it concerns one use of a result.
    is_partial: bool,
    /// Whether it concerns the value of a parameter.
    pub is_parameter: bool,
    /// Whether it is right except for its decision between the two states.
    pub is_decision: bool,
}

impl Mistake {
    fn new(name: impl Into<String>, program: Program) -> Self {
        let results = program.results();
        Mistake {
            name: name.into(),
            program,
            results,
            augmentations: None,
            is_partial: false,
            is_parameter: false,
            is_decision: false,
        }
    }

    fn of_parameter(name: String, program: Program) -> Self {
        Mistake { is_parameter: true, ..Mistake::new(name, program) }
    }
}

impl Results {
    /// Returns the formulas for a state.
    pub fn of_state(&self, touches: bool) -> &Formulas {
        if touches { &self.contact } else { &self.separated }
    }

    /// Returns the value that decides the state: R if there is no condition.
    pub fn reaction(&self, system: &SpringMass<Exact>, constants: &Constants<Exact>) -> Exact {
        let own = self.condition.as_ref().and_then(|condition| value(condition, system, constants));
        own.unwrap_or_else(|| system::reaction(system))
    }
}

impl Program {
    fn with_branches(
        named: &[(&'static str, Tree)],
        condition: Tree,
        contact: Formulas,
        apart: Formulas,
    ) -> Self {
        let ([u, n], [free, zero]) = (contact, apart);
        let last = [("condition", condition), ("u", u), ("N", n), ("u", free), ("N", zero)];
        Program { steps: steps(named, &last), has_branches: true, returned: returned() }
    }

    fn without_branches(named: &[(&'static str, Tree)], [u, n]: Formulas) -> Self {
        Program { steps: steps(named, &[("u", u), ("N", n)]), has_branches: false, returned: returned() }
    }

    /// Returns the number of intermediate results.
    fn count(&self) -> usize {
        self.steps.len() - if self.has_branches { 5 } else { 2 }
    }

    /// Returns the results as functions of the parameters.
    pub fn results(&self) -> Results {
        let mut known: Vec<(&str, Tree)> = Vec::new();
        let (named, last) = self.steps.split_at(self.count());
        for Step { name, value } in named {
            known.push((name, value.substitute(&known)));
        }
        let both = |u: &Step, n: &Step| {
            let u = u.value.substitute(&known);
            let n = n.value.substitute(&[&known[..], &[("u", u.clone())]].concat());
            self.returned.each_ref().map(|of| of.substitute(&[("u", u.clone()), ("N", n.clone())]))
        };
        match last {
            [condition, u, n, free, zero] => Results {
                condition: Some(condition.value.substitute(&known)),
                contact: both(u, n),
                separated: both(free, zero),
            },
            _ => {
                let both = both(&last[0], &last[1]);
                Results { condition: None, contact: both.clone(), separated: both }
            }
        }
    }

    /// Returns the lines of the program.
    pub fn lines(&self) -> Vec<String> {
        let (named, last) = self.steps.split_at(self.count());
        let mut lines: Vec<_> = named.iter().map(|step| format!("{} = {}", step.name, step.value)).collect();
        let both = |u: &Step, n: &Step| format!("u = {}, N = {}", u.value, n.value);
        lines.push(match last {
            [condition, u, n, free, zero] => match condition.value.op() {
                Op::Int(0) => both(free, zero),
                Op::Int(_) => both(u, n),
                _ => format!("{} if {} > 0, else {}", both(u, n), condition.value, both(free, zero)),
            },
            _ => both(&last[0], &last[1]),
        });
        if self.returned != returned() {
            lines.push(format!("returned as u: {}, as N: {}", self.returned[0], self.returned[1]));
        }
        lines
    }

    fn with(&self, i: usize, value: Tree) -> Self {
        let mut changed = self.clone();
        changed.steps[i].value = value;
        changed
    }

    /// Returns the program that uses these formulas for parameters.
    fn using(&self, replaced: &[(&str, Tree)]) -> Self {
        let steps =
            self.steps.iter().map(|Step { name, value }| Step { name, value: value.substitute(replaced) });
        Program { steps: steps.collect(), ..self.clone() }
    }

    /// Returns the state to which a step belongs, as words before an edit.
    fn state_of_step(&self, i: usize) -> &'static str {
        match (self.has_branches, i.checked_sub(self.count())) {
            (true, Some(1 | 2)) => "in contact ",
            (true, Some(3 | 4)) => "without contact ",
            _ => "",
        }
    }

    /// Returns the programs with one operation changed: where it is, or only in one use of its result.
    fn with_one_operation(&self) -> Vec<Mistake> {
        let mut all = Vec::new();
        for (i, Step { name, value }) in self.steps.iter().enumerate() {
            let is_condition = self.has_branches && i == self.count();
            for new in
                changes(value, &self.steps[..i.min(self.count())]).into_iter().filter(|new| new != value)
            {
                let edit = if is_condition {
                    format!("the plane acts if {new} > 0 instead of if {value} > 0")
                } else {
                    format!("{}{name} = {new} instead of {value}", self.state_of_step(i))
                };
                let users: Vec<_> = (i + 1..self.steps.len())
                    .filter(|j| i < self.count() && self.steps[*j].value.symbols().contains(name))
                    .collect();
                all.push(Mistake::new(edit.clone(), self.with(i, new.clone())));
                for j in users.iter().copied().filter(|_| users.len() > 1) {
                    let user = &self.steps[j];
                    let used = user.value.substitute(&[(name, new.clone())]);
                    let place = if user.name == "condition" { "the condition" } else { user.name };
                    let name = format!("{edit}, in {}{place} alone", self.state_of_step(j));
                    all.push(Mistake { is_partial: true, ..Mistake::new(name, self.with(j, used)) });
                }
            }
        }
        all
    }

    /// Returns the programs that use another value for a parameter.
    fn with_one_parameter(&self, by_penalty: bool) -> Vec<Mistake> {
        let names = parameters(by_penalty);
        let mut all = Vec::new();
        for (i, x) in names.iter().enumerate() {
            let own = Tree::symbol(x);
            let used = [-&own, own.abs(), own.positive_part(), Tree::from(0), Tree::from(1)];
            for used in used {
                all.push(Mistake::of_parameter(
                    format!("{used} is used for {x}"),
                    self.using(&[(x, used.clone())]),
                ));
            }
            for y in &names[..i] {
                let other = Tree::symbol(y);
                let program = self.using(&[(x, other), (y, own.clone())]);
                all.push(Mistake::new(format!("{y} and {x} are swapped"), program));
            }
        }
        all
    }

    /// Returns the programs that return another quantity as u or N.
    fn with_one_output(&self) -> Vec<Mistake> {
        let [l, h, u, n] = ["l", "H", "u", "N"].map(|name| Tree::symbol(name));
        let own = &symbols().system;
        let (zero, p) = (Tree::from(0), contact::penetration(own, &u));
        let force = augmented::contact_force(own, &u);
        let sum = system::weight(own) + structure::spring_force(own, &u);
        // At least −|l|.
        let bounded = -(-&u).min(&l.abs());
        let deflections =
            [-&u, u.abs(), u.positive_part(), zero.clone(), &l + &u, p.clone(), -p, h - l, bounded];
        let reaction = system::reaction(own);
        let forces = [-&n, n.abs(), zero.clone(), system::weight(own), structure::spring_force(own, &u), sum]
            .into_iter()
            .chain([&force, &reaction].into_iter().flat_map(signs));
        let deflections =
            deflections.into_iter().map(|new| (format!("{new} is returned as u"), [new, n.clone()]));
        let forces = forces.map(|new| (format!("{new} is returned as N"), [u.clone(), new]));
        let both = [
            ("u and N are swapped".to_string(), [n.clone(), u.clone()]),
            ("0 is returned as u and N".to_string(), [zero.clone(), zero]),
        ];
        let all = deflections.chain(forces).chain(both);
        all.map(|(name, returned)| Mistake::new(name, Program { returned, ..self.clone() })).collect()
    }

    /// Returns the program with one edit, in all ways.
    fn edited(&self, by_penalty: bool) -> Vec<Mistake> {
        let parts = [self.with_one_parameter(by_penalty), self.with_one_operation(), self.with_one_output()];
        parts.concat()
    }
}

fn returned() -> Formulas {
    ["u", "N"].map(|name| Tree::symbol(name))
}

/// Returns the symbols of the parameters.
fn parameters(by_penalty: bool) -> Vec<&'static str> {
    let penalty = by_penalty.then_some("ε");
    SpringMass::SYMBOLS.into_array().into_iter().chain(penalty).collect()
}

/// Returns a quantity, its negative, its positive part, and its absolute value.
fn signs(of: &Tree) -> [Tree; 4] {
    [of.clone(), -of, of.positive_part(), of.abs()]
}

/// Returns the steps with these names and formulas. The intermediate results have their names in later ones.
fn steps(named: &[(&'static str, Tree)], last: &[(&'static str, Tree)]) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    for (i, (name, value)) in named.iter().chain(last).enumerate() {
        let earlier = &steps[..i.min(named.len())];
        let name_of = |part: &Tree| {
            let known = earlier.iter().find(|step| step.value == *part && part.size() > 1);
            known.map(|step| Tree::symbol(step.name))
        };
        let value = value.rewrite(&name_of);
        steps.push(Step { name, value });
    }
    steps
}

/// Returns the formulas with one operation changed.
fn changes(tree: &Tree, earlier: &[Step]) -> Vec<Tree> {
    let mut all = changes_of_last(tree, earlier);
    for (i, operand) in tree.op().operands().enumerate() {
        for new in changes(operand, earlier) {
            let mut places = 0..;
            let step = tree.op().map(|own| if places.next() == Some(i) { new.clone() } else { own.clone() });
            all.push(tree.with_op(step));
        }
    }
    all
}

/// Returns the formulas in place of one whose last operation is changed.
fn changes_of_last(tree: &Tree, earlier: &[Step]) -> Vec<Tree> {
    let of = |step| tree.with_op(step);
    let [_, negated, bracketed, size] = signs(tree);
    let mut all = match tree.op() {
        Op::Add(a, b) => vec![of(Op::Sub(a.clone(), b.clone())), a.clone(), b.clone()],
        Op::Sub(a, b) => {
            vec![of(Op::Add(a.clone(), b.clone())), a.clone(), b.clone(), of(Op::Sub(b.clone(), a.clone()))]
        }
        Op::Mul(a, b) => vec![of(Op::Div(a.clone(), b.clone())), a.clone(), b.clone()],
        Op::Div(a, b) => {
            vec![of(Op::Mul(a.clone(), b.clone())), a.clone(), b.clone(), of(Op::Div(b.clone(), a.clone()))]
        }
        Op::Min(a, b) => vec![-(-a).min(&-b), a.clone(), b.clone()],
        Op::Neg(a) | Op::PositivePart(a) => vec![a.clone(), a.abs()],
        Op::Symbol(name) => {
            let alike = ALIKE.iter().filter(|names| names.contains(name)).flat_map(|names| names.iter());
            let is_known = |other: &str| {
                SpringMass::SYMBOLS.into_array().contains(&other)
                    || earlier.iter().any(|step| step.name == other)
            };
            alike.filter(|other| *other != name && is_known(other)).map(|other| Tree::symbol(other)).collect()
        }
        Op::Int(_) | Op::Exp(_) | Op::Rounded(_) => Vec::new(),
    };
    if !matches!(tree.op(), Op::Int(_)) {
        all.extend([negated, bracketed, size, Tree::from(0)]);
    }
    all
}

/// Returns the right programs: each as it is written in the chapter, and as others write it.
fn references(by_penalty: bool) -> Vec<Program> {
    let (own, eps) = (&symbols().system, &symbols().eps);
    let (u, p) = (Tree::symbol("u"), Tree::symbol("p"));
    let (gap, reaction) = (("gap", system::gap(own)), ("R", system::reaction(own)));
    let condition = Tree::symbol("R");
    let apart = [structure::deflection(own), Tree::from(0)];
    let both = [gap.clone(), reaction.clone()];
    if by_penalty {
        let touching = [penalty::deflection(own, eps), penalty::contact_force(own, eps, &u)];
        let closed = ("p", penalty::penetration(own, eps));
        let force = eps * &p;
        let bracket = penalty::contact_force(own, eps, &u).positive_part();
        return vec![
            Program::with_branches(&both, condition.clone(), touching, apart.clone()),
            Program::without_branches(
                std::slice::from_ref(&gap),
                [penalty::unilateral_deflection(own, eps), bracket],
            ),
            Program::with_branches(
                &[gap, reaction, closed],
                condition,
                [system::gap(own) + &p, force],
                apart,
            ),
        ];
    }
    let trial = structure::deflection(own);
    let predicted = [("u₀", trial.clone()), ("p", contact::penetration(own, &trial))];
    vec![
        Program::with_branches(
            &both,
            condition.clone(),
            [lagrange::deflection(own), lagrange::multiplier(own)],
            apart.clone(),
        ),
        Program::without_branches(&both, [contact::deflection(own), contact::contact_force(own)]),
        Program::with_branches(
            &both,
            condition,
            [lagrange::deflection(own), augmented::contact_force(own, &u)],
            apart.clone(),
        ),
        Program::with_branches(
            &predicted,
            p.clone(),
            [lagrange::deflection(own), structure::spring_force(own, &p)],
            apart,
        ),
        Program::without_branches(&[gap], [contact::deflection(own), augmented::contact_force(own, &u)]),
    ]
}

/// Returns the right program as it is written in the chapter.
pub(super) fn reference(by_penalty: bool) -> Program {
    references(by_penalty).swap_remove(0)
}

/// Returns every program with one edit: first those without a decision, and last those that change one use of a
/// result.
pub(super) fn edits(by_penalty: bool) -> Vec<Mistake> {
    let programs = references(by_penalty);
    let mut edited: Vec<_> = programs.iter().flat_map(|program| program.edited(by_penalty)).collect();
    edited.sort_by_key(|mistake| mistake.is_partial);
    let rigid = by_penalty.then(|| Mistake::new("ε is not used: the plane is rigid", reference(false)));
    undecided(by_penalty).into_iter().chain(rigid).chain(edited).collect()
}

/// Returns the mistakes that a program may make in some answers only: in its decision or its output.
pub(super) fn in_some_answers(by_penalty: bool) -> Vec<Mistake> {
    [undecided(by_penalty), reference(by_penalty).with_one_output()].concat()
}

/// Returns the programs that always, or never, give the results in contact.
fn undecided(by_penalty: bool) -> Vec<Mistake> {
    let program = reference(by_penalty);
    let decided = |(name, value)| Mistake::new(name, program.with(program.count(), Tree::from(value)));
    let decision = |mistake| Mistake { is_decision: true, ..mistake };
    let held = program.with(program.count(), Tree::from(1)).with(program.count() + 2, Tree::from(0));
    let held = Mistake::new("the mass is held at the plane, with N = 0", held);
    [("the plane always acts", 1), ("the plane never acts", 0)]
        .map(decided)
        .into_iter()
        .chain([held])
        .map(decision)
        .collect()
}

/// Returns every program with one unknown number k.
pub(super) fn numbers(by_penalty: bool) -> Vec<Mistake> {
    let (own, k) = (&symbols().system, &Tree::symbol("k"));
    let first = reference(by_penalty);
    let mut all = Vec::new();
    for x in parameters(by_penalty) {
        let own = Tree::symbol(x);
        for (name, used) in [
            (format!("{x} is {{k}} times the right value"), k * &own),
            (format!("{x} is always {{k}}"), k.clone()),
            (format!("{{k}} is added to {x}"), &own + k),
        ] {
            all.push(Mistake::of_parameter(name, first.using(&[(x, used)])));
        }
    }
    let lengths = [("l", k * &own.l), ("H", k * &own.h)];
    all.push(Mistake::new("l and H are {k} times the right values", first.using(&lengths)));
    let [u, n] = returned();
    for (name, [u, n]) in [
        ("u is at most {k} m", [u.min(k), n.clone()]),
        ("u is at least {k} m", [-(-&u).min(&-k), n.clone()]),
        ("N is at most {k} N", [u, n.min(k)]),
    ] {
        all.push(Mistake::new(name, Program { returned: [u, n], ..first.clone() }));
    }
    if !by_penalty {
        all.extend(unrequested_penalties(own, k));
        all.extend(augmentations(own, k));
    }
    all
}

/// Returns methods with the penalty ε = k, k c or k m.
fn unrequested_penalties(own: &SpringMass<Tree>, k: &Tree) -> Vec<Mistake> {
    let reaction = system::reaction(own);
    let (free, zero) = (structure::deflection(own), Tree::from(0));
    let exact = [lagrange::deflection(own), lagrange::multiplier(own)];
    let mut all = Vec::new();
    for (value, eps) in [("{k} N/m", k.clone()), ("{k} c", k * &own.c), ("{k}/s² m", k * &own.m)] {
        let pulled = penalty::deflection(own, &eps);
        let pull = penalty::contact_force(own, &eps, &Tree::symbol("u"));
        let both = [pulled.clone(), pull.clone()];
        let updated = "only the update of the augmentation is bracketed";
        for (name, touching, apart) in [
            ("it is the penalty method", both.clone(), [free.clone(), zero.clone()]),
            ("it is the penalty method, and the plane also pulls", both.clone(), both.clone()),
            (updated, exact.clone(), [pulled.clone(), zero.clone()]),
            (&format!("{updated}, and N is not"), exact.clone(), both.clone()),
        ] {
            let program = Program::with_branches(&[], reaction.clone(), touching, apart);
            let name = format!("{name}, with ε = {value}");
            let iteration = ", or an iteration that always stops after the same number of steps";
            let name = if value == "{k} c" { name + iteration } else { name };
            all.push(Mistake::new(name, program));
        }
    }
    all
}

/// Largest number of augmentations that is recognised.
const MAX_AUGMENTATIONS: i32 = 32;

/// Returns augmentations from λ = 0 with ε = k N/m, which return N of the last step or of the one before.
fn augmentations(own: &SpringMass<Tree>, k: &Tree) -> Vec<Mistake> {
    let (zero, contraction) = (Tree::from(0), augmented::contraction(own, k));
    let (mut all, mut decay, mut force) = (Vec::new(), Tree::from(1), zero.clone());
    for steps in 1..=MAX_AUGMENTATIONS {
        // With ρᵏ⁻¹ of the steps before the last, and the rounding errors of an update.
        let deflection = augmented::deflection_after(own, k, &zero, &decay);
        let multiplier = augmented::multiplier_after(own, &zero, &decay);
        let before = std::mem::replace(&mut force, augmented::update(own, k, &multiplier, &deflection));
        for (what, force) in [("", &force), (", and N is one step behind", &before)] {
            if steps > 1 || !what.is_empty() {
                let apart = [structure::deflection(own), zero.clone()];
                let touching = [deflection.clone(), force.clone()];
                let program = Program::with_branches(&[], system::reaction(own), touching, apart);
                let name = format!("the augmentation stops after {steps} steps with ε = {{k}} N/m{what}");
                all.push(Mistake { augmentations: Some(steps), ..Mistake::new(name, program) });
            }
        }
        decay = decay * &contraction;
    }
    all
}

/// ε and k, if they are known.
#[derive(Debug)]
pub(super) struct Constants<'a, T> {
    pub penalty: Option<&'a T>,
    pub factor: Option<&'a T>,
}

/// Returns the value of a formula for a system and constants; `None` if it divides by zero, or contains an
/// unknown quantity.
pub(super) fn value<T: PositivePart>(
    tree: &Tree,
    system: &SpringMass<T>,
    constants: &Constants<T>,
) -> Option<T> {
    let symbol = |name: &str| match name {
        "ε" => constants.penalty.cloned(),
        "k" => constants.factor.cloned(),
        name => system.by_symbol(name).cloned(),
    };
    let all = tree.symbols().into_iter().all(|name| symbol(name).is_some());
    all.then(|| tree.eval(&|name| symbol(name).expect("known"), &piecewise_ops)).flatten()
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

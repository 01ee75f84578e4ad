//! Programs for u and N as a person writes them, with one edit, or with one unknown number.
//!
//! Their formulas are recorded from the chapter's functions, so they can be computed, changed and printed.

use super::problems::Problem;
use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use crate::claims::symbols;
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Tree};
use crate::proof::mutation::mutated;
use num_traits::Zero;
use std::cell::Cell;

/// u in m and N in N, as formulas.
pub(super) type Formulas = [Tree; 2];

/// Quantities with their names.
type Named = [(&'static str, Tree)];

/// The quantities of a program that have the same unit, so that one may be taken for another.
const ALIKE: [&[&str]; 3] = [&["c", "ε"], &["l", "H", "gap", "u", "p"], &["R", "N"]];

/// A result of a program.
#[derive(Clone, Debug, PartialEq)]
struct Step {
    name: &'static str,
    /// Its formula, of the parameters and of earlier results.
    value: Tree,
    role: Role,
}

impl Step {
    fn line(&self) -> String {
        format!("{} = {}", self.name, self.value)
    }

    /// Describes another formula for it.
    fn edit(&self, new: &Tree) -> String {
        let Step { name, value, role } = self;
        match role {
            Role::Condition => format!("the plane acts if {new} > 0 instead of if {value} > 0"),
            _ => format!("{}{name} = {new} instead of {value}", role.state()),
        }
    }
}

/// Role of a result in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Role {
    Intermediate,
    /// It is positive in contact.
    Condition,
    /// u or N in contact.
    InContact,
    /// u or N without contact.
    Apart,
    /// u or N in both states.
    Always,
}

impl Role {
    /// Returns the state to which a result belongs, as words before an edit.
    fn state(self) -> &'static str {
        match self {
            Role::InContact => "in contact ",
            Role::Apart => "without contact ",
            Role::Intermediate | Role::Condition | Role::Always => "",
        }
    }
}

/// A program: intermediate results, and u and N, or a condition, and u and N for each of two states.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    steps: Vec<Step>,
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

    /// Returns `true` if a formula divides by the number 0, so that the program has no answer.
    fn divide_by_zero(&self) -> bool {
        let mut formulas = self.condition.iter().chain(&self.contact).chain(&self.separated);
        formulas.any(|formula| formula.any(&divides_by_zero))
    }

    /// Returns u and N for a problem and an unknown number.
    pub fn values(&self, Problem { system, penalty, .. }: &Problem, k: Option<&Exact>) -> [Option<Exact>; 2] {
        let constants = Constants { penalty: penalty.as_ref(), factor: k };
        let touches = self.reaction(system, &constants) > Exact::zero();
        self.of_state(touches).each_ref().map(|formula| value(formula, system, &constants))
    }

    /// Returns the value that decides the state: R if there is no condition.
    pub fn reaction(&self, system: &SpringMass<Exact>, constants: &Constants<Exact>) -> Exact {
        let condition = self.condition.as_ref();
        let value = condition.and_then(|condition| value(condition, system, constants));
        value.unwrap_or_else(|| system::reaction(system))
    }
}

impl Program {
    fn with_branches(named: &Named, condition: Tree, contact: Formulas, apart: Formulas) -> Self {
        let ([u, n], [free, zero]) = (contact, apart);
        let last = [
            ("condition", condition, Role::Condition),
            ("u", u, Role::InContact),
            ("N", n, Role::InContact),
            ("u", free, Role::Apart),
            ("N", zero, Role::Apart),
        ];
        Program::new(named, last)
    }

    fn without_branches(named: &Named, [u, n]: Formulas) -> Self {
        Program::new(named, [("u", u, Role::Always), ("N", n, Role::Always)])
    }

    /// Returns a program whose steps use the names of intermediate results.
    fn new<const N: usize>(named: &Named, last: [(&'static str, Tree, Role); N]) -> Self {
        let intermediate = named.iter().map(|(name, value)| (*name, value.clone(), Role::Intermediate));
        let mut steps: Vec<Step> = Vec::new();
        for (name, value, role) in intermediate.chain(last) {
            let value = value.rewrite(&|part| {
                let mut earlier = steps.iter().filter(|step| step.role == Role::Intermediate);
                let step = earlier.find(|step| step.value == *part && part.size() > 1)?;
                Some(Tree::symbol(step.name))
            });
            steps.push(Step { name, value, role });
        }
        Program { steps, returned: returned() }
    }

    fn of(&self, role: Role) -> impl Iterator<Item = &Step> {
        self.steps.iter().filter(move |step| step.role == role)
    }

    /// Returns the index of the condition, after the intermediate results.
    fn condition(&self) -> Option<usize> {
        self.steps.iter().position(|step| step.role == Role::Condition)
    }

    /// Returns the program without intermediate results.
    fn inlined(&self) -> Self {
        let mut known: Vec<(&str, Tree)> = Vec::new();
        let mut steps = Vec::new();
        for step in &self.steps {
            let value = step.value.substitute(&known);
            match step.role {
                Role::Intermediate => known.push((step.name, value)),
                _ => steps.push(Step { value, ..step.clone() }),
            }
        }
        Program { steps, returned: self.returned.clone() }
    }

    /// Returns the results as functions of the parameters.
    pub fn results(&self) -> Results {
        let inlined = self.inlined();
        let condition = inlined.condition().map(|i| inlined.steps[i].value.clone());
        let [contact, apart] = match condition {
            None => [Role::Always, Role::Always],
            Some(_) => [Role::InContact, Role::Apart],
        };
        Results { condition, contact: inlined.results_of(contact), separated: inlined.results_of(apart) }
    }

    /// Returns the returned u and N of a program without intermediate results.
    fn results_of(&self, role: Role) -> Formulas {
        let mut known: Vec<(&str, Tree)> = Vec::new();
        for step in self.of(role) {
            known.push((step.name, step.value.substitute(&known)));
        }
        self.returned.each_ref().map(|formula| formula.substitute(&known))
    }

    /// Returns the lines of the program.
    pub fn lines(&self) -> Vec<String> {
        let mut lines: Vec<_> = self.of(Role::Intermediate).map(Step::line).collect();
        lines.push(match self.condition().map(|i| &self.steps[i].value) {
            None => self.line_of(Role::Always),
            Some(condition) => {
                match (condition.op(), [Role::InContact, Role::Apart].map(|role| self.line_of(role))) {
                    (Op::Int(0), [_, apart]) => apart,
                    (Op::Int(_), [contact, _]) => contact,
                    (_, [contact, apart]) => format!("{contact} if {condition} > 0, else {apart}"),
                }
            }
        });
        if self.returned != returned() {
            lines.push(format!("returned as u: {}, as N: {}", self.returned[0], self.returned[1]));
        }
        lines
    }

    fn line_of(&self, role: Role) -> String {
        self.of(role).map(Step::line).collect::<Vec<_>>().join(", ")
    }

    fn with(&self, i: usize, value: Tree) -> Self {
        let mut changed = self.clone();
        changed.steps[i].value = value;
        changed
    }

    /// Returns the program that uses these formulas for parameters.
    fn using(&self, replaced: &[(&str, Tree)]) -> Self {
        let mut changed = self.clone();
        for step in &mut changed.steps {
            step.value = step.value.substitute(replaced);
        }
        changed
    }

    /// Returns the programs with one operation changed.
    fn with_one_operation(&self) -> Vec<Mistake> {
        let mut all = Vec::new();
        let mut known = SpringMass::SYMBOLS.into_array().to_vec();
        for (i, step) in self.steps.iter().enumerate() {
            let new = changes(&step.value, &known).into_iter().filter(|new| *new != step.value);
            all.extend(new.map(|new| Mistake::new(step.edit(&new), self.with(i, new))));
            if step.role == Role::Intermediate {
                known.push(step.name);
            }
        }
        all
    }

    /// Returns the programs that use another value for a parameter.
    fn with_one_parameter(&self, by_penalty: bool) -> Vec<Mistake> {
        let names = parameters(by_penalty);
        let mut all = Vec::new();
        for (i, x) in names.iter().enumerate() {
            let parameter = Tree::symbol(x);
            let [_, negated, bracketed, size] = signs(&parameter);
            let used = [negated, size, bracketed, Tree::from(0), Tree::from(1)];
            for used in used {
                all.push(Mistake::of_parameter(
                    format!("{used} is used for {x}"),
                    self.using(&[(x, used.clone())]),
                ));
            }
            for y in &names[..i] {
                let other = Tree::symbol(y);
                let program = self.using(&[(x, other), (y, parameter.clone())]);
                all.push(Mistake::new(format!("{y} and {x} are swapped"), program));
            }
        }
        all
    }

    /// Returns the programs that return another quantity as u or N.
    fn with_one_output(&self) -> Vec<Mistake> {
        let [l, h, u, n] = ["l", "H", "u", "N"].map(|name| Tree::symbol(name));
        let system = &symbols().system;
        let (zero, p) = (Tree::from(0), contact::penetration(system, &u));
        let force = augmented::contact_force(system, &u);
        let sum = system::weight(system) + structure::spring_force(system, &u);
        // At least −|l|.
        let bounded = -(-&u).min(&l.abs());
        let deflections =
            [-&u, u.abs(), u.positive_part(), zero.clone(), &l + &u, p.clone(), -p, h - l, bounded];
        let weight = system::weight(system);
        let [by_gravity, by_weight] = [&n / &system.g, &n / &weight];
        let forces = [
            -&n,
            n.abs(),
            zero.clone(),
            weight,
            structure::spring_force(system, &u),
            sum,
            by_gravity,
            by_weight,
        ];
        let forces = forces.into_iter().chain(signs(&force)).chain(signs(&system::reaction(system)));
        let mut returned = Vec::new();
        for u in deflections {
            returned.push((format!("{u} is returned as u"), [u, n.clone()]));
        }
        for n in forces {
            returned.push((format!("{n} is returned as N"), [u.clone(), n]));
        }
        returned.push(("u and N are swapped".to_string(), [n, u]));
        returned.push(("0 is returned as u and N".to_string(), [zero.clone(), zero]));
        let returning = |(name, returned)| Mistake::new(name, Program { returned, ..self.clone() });
        returned.into_iter().map(returning).collect()
    }

    /// Returns the program with one edit, in all ways.
    fn edited(&self, by_penalty: bool) -> Vec<Mistake> {
        let parts = [self.with_one_parameter(by_penalty), self.with_one_operation(), self.with_one_output()];
        parts.concat()
    }
}

/// Returns `true` if the last operation divides by the number 0.
fn divides_by_zero(tree: &Tree) -> bool {
    matches!(tree.op(), Op::Div(_, divisor) if *divisor.op() == Op::Int(0))
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

/// Returns the formulas with one operation changed, by operations or the names of known quantities.
fn changes(tree: &Tree, known: &[&str]) -> Vec<Tree> {
    let mut all = changes_of_last(tree, known);
    for (i, operand) in tree.op().operands().enumerate() {
        for new in changes(operand, known) {
            let mut places = 0..;
            let op = tree.op().map(|old| if places.next() == Some(i) { new.clone() } else { old.clone() });
            all.push(tree.with_op(op));
        }
    }
    all
}

/// Returns the formulas in place of one whose last operation is changed.
fn changes_of_last(tree: &Tree, known: &[&str]) -> Vec<Tree> {
    let [_, negated, bracketed, size] = signs(tree);
    let mut all = mutated(tree);
    match tree.op() {
        Op::Int(_) => return Vec::new(),
        Op::Neg(a) | Op::PositivePart(a) => all.push(a.abs()),
        Op::Symbol(name) => {
            let alike = ALIKE.iter().filter(|names| names.contains(name)).flat_map(|names| names.iter());
            all.extend(alike.filter(|x| *x != name && known.contains(x)).map(|x| Tree::symbol(x)));
        }
        _ => {}
    }
    all.extend([negated, bracketed, size, Tree::from(0)]);
    all
}

/// Returns the right programs: each as it is written in the chapter, and as others write it.
pub(super) fn references(by_penalty: bool) -> Vec<Program> {
    let (system, eps) = (&symbols().system, &symbols().eps);
    let (u, p) = (Tree::symbol("u"), Tree::symbol("p"));
    let (gap, reaction) = (("gap", system::gap(system)), ("R", system::reaction(system)));
    let condition = Tree::symbol("R");
    let apart = [structure::deflection(system), Tree::from(0)];
    let both = [gap.clone(), reaction.clone()];
    if by_penalty {
        let touching = [penalty::deflection(system, eps), penalty::contact_force(system, eps, &u)];
        let closed = ("p", penalty::penetration(system, eps));
        let force = eps * &p;
        let bracket = penalty::contact_force(system, eps, &u).positive_part();
        return vec![
            Program::with_branches(&both, condition.clone(), touching, apart.clone()),
            Program::without_branches(
                std::slice::from_ref(&gap),
                [penalty::unilateral_deflection(system, eps), bracket],
            ),
            Program::with_branches(
                &[gap, reaction, closed],
                condition,
                [system::gap(system) + &p, force],
                apart,
            ),
        ];
    }
    let trial = structure::deflection(system);
    let predicted = [("u₀", trial.clone()), ("p", contact::penetration(system, &trial))];
    let (touching, admissible) = (lagrange::deflection(system), contact::deflection(system));
    let (multiplier, force) = (lagrange::multiplier(system), augmented::contact_force(system, &u));
    let at_plane = [touching.clone(), structure::spring_force(system, &p)];
    vec![
        Program::with_branches(&both, condition.clone(), [touching.clone(), multiplier], apart.clone()),
        Program::without_branches(&both, [admissible.clone(), contact::contact_force(system)]),
        Program::with_branches(&both, condition, [touching, force.clone()], apart.clone()),
        Program::with_branches(&predicted, p, at_plane, apart),
        Program::without_branches(&both[..1], [admissible.clone(), force.clone()]),
        Program::without_branches(&both[..1], [admissible, force.positive_part()]),
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
    let rigid = by_penalty.then(|| Mistake::new("ε is not used: the plane is rigid", reference(false)));
    let edited = programs.iter().flat_map(|program| program.edited(by_penalty));
    let of_one_use = programs.iter().flat_map(|program| program.inlined().with_one_operation());
    let edited = edited.chain(of_one_use).filter(|mistake| !mistake.results.divide_by_zero());
    undecided(by_penalty).into_iter().chain(decided_by_gap(by_penalty)).chain(rigid).chain(edited).collect()
}

/// Returns the programs whose lengths decide the state.
fn decided_by_gap(by_penalty: bool) -> [Mistake; 2] {
    let (program, gap) = (reference(by_penalty), Tree::symbol("gap"));
    let condition = program.condition().expect("a program with branches");
    let [below, above] = [program.with(condition, -&gap), program.with(condition, gap)];
    [Mistake::new("the plane acts if H > l", above), Mistake::new("the plane acts if H < l", below)]
}

/// Returns the mistakes that a program may make in some answers only: in its decision or its output.
pub(super) fn in_some_answers(by_penalty: bool) -> Vec<Mistake> {
    [undecided(by_penalty), reference(by_penalty).with_one_output()].concat()
}

/// Returns the programs that always, or never, give the results in contact.
fn undecided(by_penalty: bool) -> Vec<Mistake> {
    let program = reference(by_penalty);
    let condition = program.condition().expect("a program with branches");
    let [never, always] = [0, 1].map(|value| program.with(condition, Tree::from(value)));
    let without_force = always.with(condition + 2, Tree::from(0));
    [
        ("the plane always acts", always),
        ("the plane never acts", never),
        ("the mass is held at the plane, with N = 0", without_force),
    ]
    .map(|(name, program)| Mistake { is_decision: true, ..Mistake::new(name, program) })
    .to_vec()
}

/// Returns every program with one unknown number k.
pub(super) fn numbers(by_penalty: bool) -> Vec<Mistake> {
    let (system, k) = (&symbols().system, &Tree::symbol("k"));
    let first = reference(by_penalty);
    let mut all = Vec::new();
    for x in parameters(by_penalty) {
        let parameter = Tree::symbol(x);
        for (name, used) in [
            (format!("{x} is {{k}} times the right value"), k * &parameter),
            (format!("{x} is always {{k}}"), k.clone()),
            (format!("{{k}} is added to {x}"), &parameter + k),
        ] {
            all.push(Mistake::of_parameter(name, first.using(&[(x, used)])));
        }
    }
    let direction = [("g", k * &system.g / system.g.abs())];
    all.push(Mistake::of_parameter(
        "g is always {k} or the negative of it".to_string(),
        first.using(&direction),
    ));
    let lengths = [("l", k * &system.l), ("H", k * &system.h)];
    all.push(Mistake::new("l and H are {k} times the right values", first.using(&lengths)));
    let [u, n] = returned();
    for (name, [u, n]) in [
        ("u is at most {k} m", [u.min(k), n.clone()]),
        ("u is at least {k} m", [-(-&u).min(&-k), n.clone()]),
        ("N is at most {k} N", [u, n.min(k)]),
    ] {
        all.push(Mistake::new(name, Program { returned: [u, n], ..first.clone() }));
    }
    if by_penalty {
        let eps = &symbols().eps;
        let u = augmented::deflection(system, eps, k);
        let both = [u.clone(), augmented::update(system, eps, k, &u)];
        let apart = [structure::deflection(system), Tree::from(0)];
        let program = Program::with_branches(&[], system::reaction(system), both, apart);
        all.push(Mistake::new("it is one augmentation from the multiplier {k} N", program));
    } else {
        all.extend(unrequested_penalties(system, k));
        all.extend(augmentations(system, k));
    }
    all
}

/// Returns methods with the penalty ε = k, k c or k m.
fn unrequested_penalties(system: &SpringMass<Tree>, k: &Tree) -> Vec<Mistake> {
    let reaction = system::reaction(system);
    let (free, zero) = (structure::deflection(system), Tree::from(0));
    let exact = [lagrange::deflection(system), lagrange::multiplier(system)];
    let mut all = Vec::new();
    for (value, eps) in [("{k} N/m", k.clone()), ("{k} c", k * &system.c), ("{k}/s² m", k * &system.m)] {
        let pulled = penalty::deflection(system, &eps);
        let pull = penalty::contact_force(system, &eps, &Tree::symbol("u"));
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
fn augmentations(system: &SpringMass<Tree>, k: &Tree) -> Vec<Mistake> {
    let (zero, contraction) = (Tree::from(0), augmented::contraction(system, k));
    let (mut all, mut decay, mut force) = (Vec::new(), Tree::from(1), zero.clone());
    for steps in 1..=MAX_AUGMENTATIONS {
        // With ρᵏ⁻¹ of the steps before the last, and the rounding errors of an update.
        let deflection = augmented::deflection_after(system, k, &zero, &decay);
        let multiplier = augmented::multiplier_after(system, &zero, &decay);
        let before = std::mem::replace(&mut force, augmented::update(system, k, &multiplier, &deflection));
        for (what, force) in [("", &force), (", and N is one step behind", &before)] {
            if steps > 1 || !what.is_empty() {
                let apart = [structure::deflection(system), zero.clone()];
                let touching = [deflection.clone(), force.clone()];
                let program = Program::with_branches(&[], system::reaction(system), touching, apart);
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
    let is_known = Cell::new(true);
    let symbol = |name| match constants.symbol(name, system) {
        Some(value) => value.clone(),
        None => {
            is_known.set(false);
            T::zero()
        }
    };
    tree.eval(&symbol, &piecewise_ops).filter(|_| is_known.get())
}

impl<'a, T> Constants<'a, T> {
    /// Returns the quantity with a symbol, if it is known.
    fn symbol(&self, name: &str, system: &'a SpringMass<T>) -> Option<&'a T> {
        match name {
            "ε" => self.penalty,
            "k" => self.factor,
            name => system.by_symbol(name),
        }
    }
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

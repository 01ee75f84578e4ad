//! Programs for u and N as a person writes them, with one edit, or with one unknown number.
//!
//! Their formulas are recorded from the chapter's functions, so they can be computed, changed and printed.

use super::problems::Problem;
use crate::chapter::{SpringMass, augmented, contact, lagrange, penalty, structure, system};
use crate::claims::symbols;
use crate::number::tree::{Op, piecewise_ops};
use crate::number::{Exact, PositivePart, Tree};
use crate::proof::mutation::mutated;
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
        let state = match role {
            Role::Condition => return format!("the plane acts if {new} > 0 instead of if {value} > 0"),
            Role::InContact => "in contact ",
            Role::Apart => "without contact ",
            Role::Intermediate | Role::Always => "",
        };
        format!("{state}{name} = {new} instead of {value}")
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

/// A program: intermediate results, and u and N, or a condition, and u and N for each of two states.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Program {
    steps: Vec<Step>,
    /// The returned u and N, as functions of the computed ones.
    returned: Formulas,
}

/// A wrong program.
#[derive(Clone, Debug)]
pub(super) struct Mistake {
    /// Description of the mistake, in which `{k}` denotes an unknown number.
    pub name: String,
    /// The program.
    pub program: Program,
    pub kind: Kind,
}

/// Kind of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Any that is not one of the following.
    Formula,
    /// The value of a parameter is wrong.
    Parameter,
    /// Only the decision between the two states is wrong.
    Decision,
    /// k is the penalty of this number of augmentations.
    Augmentations(i32),
}

impl Mistake {
    pub fn new(name: impl Into<String>, program: Program) -> Self {
        Mistake { name: name.into(), program, kind: Kind::Formula }
    }

    fn of(kind: Kind, name: impl Into<String>, program: Program) -> Self {
        Mistake { kind, ..Mistake::new(name, program) }
    }
}

/// Known quantities: the parameters, ε and k, if they are known, and earlier results of a program.
#[derive(Clone)]
pub(super) struct Known<'a, T> {
    system: &'a SpringMass<T>,
    penalty: Option<&'a T>,
    k: Option<&'a T>,
    results: Vec<(&'static str, Option<T>)>,
}

impl<'a, T: PositivePart> Known<'a, T> {
    pub fn new(system: &'a SpringMass<T>, penalty: Option<&'a T>, k: Option<&'a T>) -> Self {
        Known { system, penalty, k, results: Vec::new() }
    }

    /// Returns the quantity with a symbol, if it is known.
    fn symbol(&self, name: &str) -> Option<&T> {
        let mut results = self.results.iter();
        if let Some((_, result)) = results.find(|(other, _)| *other == name) {
            return result.as_ref();
        }
        match name {
            "ε" => self.penalty,
            "k" => self.k,
            name => self.system.by_symbol(name),
        }
    }

    /// Returns the value of a formula; `None` if it divides by zero, or contains an unknown quantity.
    fn value(&self, tree: &Tree) -> Option<T> {
        let is_known = Cell::new(true);
        let symbol = |name| {
            let value = self.symbol(name).cloned();
            is_known.set(is_known.get() && value.is_some());
            value.unwrap_or_else(T::zero)
        };
        tree.eval(&symbol, &piecewise_ops).filter(|_| is_known.get())
    }

    /// Adds the results of the steps of a program with these roles.
    fn with(mut self, program: &Program, roles: [Role; 3]) -> Self {
        for step in program.steps.iter().filter(|step| roles.contains(&step.role)) {
            let value = self.value(&step.value);
            self.results.push((step.name, value));
        }
        self
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

    pub fn without_branches(named: &Named, [u, n]: Formulas) -> Self {
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

    /// Returns `true` if the program decides for contact: by R if it has no condition.
    pub fn touches<T: PositivePart + PartialOrd>(&self, known: &Known<T>) -> bool {
        let results = known.clone().with(self, [Role::Intermediate, Role::Condition, Role::Condition]);
        let condition = results.symbol("condition").cloned();
        condition.unwrap_or_else(|| system::reaction(known.system)) > T::zero()
    }

    /// Returns u and N in a state.
    pub fn values<T: PositivePart>(&self, known: &Known<T>, touches: bool) -> [Option<T>; 2] {
        let state = if touches { Role::InContact } else { Role::Apart };
        let results = known.clone().with(self, [Role::Intermediate, state, Role::Always]);
        self.returned.each_ref().map(|formula| results.value(formula))
    }

    /// Returns u and N for a problem and an unknown number.
    pub fn answer(&self, Problem { system, penalty, .. }: &Problem, k: Option<&Exact>) -> [Option<Exact>; 2] {
        let known = Known::new(system, penalty.as_ref(), k);
        self.values(&known, self.touches(&known))
    }

    /// Returns `true` if a formula divides by the number 0, so that the program has no answer.
    fn divides_by_zero(&self) -> bool {
        let is_division = |tree: &Tree| matches!(tree.op(), Op::Div(_, by) if *by.op() == Op::Int(0));
        self.steps.iter().any(|step| step.value.any(&is_division))
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

    /// Returns the program with another condition.
    fn deciding_by(&self, condition: Tree) -> Self {
        self.with(self.condition().expect("a program with branches"), condition)
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
    fn with_one_parameter(&self, parameters: &[&'static str]) -> Vec<Mistake> {
        let mut all = Vec::new();
        for (i, x) in parameters.iter().enumerate() {
            let parameter = Tree::symbol(x);
            let [_, negated, bracketed, size] = signs(&parameter);
            for used in [negated, size, bracketed, Tree::from(0), Tree::from(1)] {
                let name = format!("{used} is used for {x}");
                all.push(Mistake::of(Kind::Parameter, name, self.using(&[(x, used)])));
            }
            for y in &parameters[..i] {
                let program = self.using(&[(x, Tree::symbol(y)), (y, parameter.clone())]);
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
        let (weight, spring) = (system::weight(system), structure::spring_force(system, &u));
        // At least −|l|.
        let bounded = -(-&u).min(&l.abs());
        let as_u = [-&u, u.abs(), u.positive_part(), zero.clone(), &l + &u, p.clone(), -p, h - l, bounded];
        let both = &weight + &spring;
        let as_n = [-&n, n.abs(), zero.clone(), weight.clone(), spring, both, &n / &system.g, &n / &weight];
        let forces = [augmented::contact_force(system, &u), system::reaction(system)];
        let as_n = as_n.into_iter().chain(forces.iter().flat_map(signs));
        let as_u = as_u.into_iter().map(|x| (format!("{x} is returned as u"), [x, n.clone()]));
        let as_n = as_n.map(|x| (format!("{x} is returned as N"), [u.clone(), x]));
        let both = [
            ("u and N are swapped".to_string(), [n.clone(), u.clone()]),
            ("0 is returned as u and N".to_string(), [zero.clone(), zero]),
        ];
        as_u.chain(as_n).chain(both).map(|(name, returned)| self.returning(name, returned)).collect()
    }

    fn returning(&self, name: impl Into<String>, returned: Formulas) -> Mistake {
        Mistake::new(name, Program { returned, ..self.clone() })
    }
}

fn returned() -> Formulas {
    ["u", "N"].map(|name| Tree::symbol(name))
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

/// Returns u and N without the plane.
fn apart() -> Formulas {
    [structure::deflection(&symbols().system), Tree::from(0)]
}

/// The method whose solutions are the right ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reference {
    Multiplier,
    Penalty,
}

impl Reference {
    /// Returns the method that problems ask for.
    pub fn of<'a>(problems: impl IntoIterator<Item = &'a Problem>) -> Self {
        let by_penalty = problems.into_iter().any(|problem| problem.penalty.is_some());
        if by_penalty { Reference::Penalty } else { Reference::Multiplier }
    }

    /// Returns the symbols of the parameters.
    fn parameters(self) -> Vec<&'static str> {
        let penalty = (self == Reference::Penalty).then_some("ε");
        SpringMass::SYMBOLS.into_array().into_iter().chain(penalty).collect()
    }

    /// Returns the right program as it is written in the chapter.
    pub fn program(self) -> Program {
        self.programs().swap_remove(0)
    }

    /// Returns the right programs: each as it is written in the chapter, and as others write it.
    pub fn programs(self) -> Vec<Program> {
        let (system, eps) = (&symbols().system, &symbols().eps);
        let [u, p, condition] = ["u", "p", "R"].map(|name| Tree::symbol(name));
        let (gap, reaction) = (("gap", system::gap(system)), ("R", system::reaction(system)));
        if self == Reference::Penalty {
            let force = penalty::contact_force(system, eps, &u);
            let touching = [penalty::deflection(system, eps), force.clone()];
            let always = [penalty::unilateral_deflection(system, eps), force.positive_part()];
            let by_p = [system::gap(system) + &p, eps * &p];
            let closed = ("p", penalty::penetration(system, eps));
            return vec![
                Program::with_branches(
                    &[gap.clone(), reaction.clone()],
                    condition.clone(),
                    touching,
                    apart(),
                ),
                Program::without_branches(std::slice::from_ref(&gap), always),
                Program::with_branches(&[gap, reaction, closed], condition, by_p, apart()),
            ];
        }
        let trial = structure::deflection(system);
        let predicted = [("u₀", trial.clone()), ("p", contact::penetration(system, &trial))];
        let both = [gap, reaction];
        let (touching, admissible) = (lagrange::deflection(system), contact::deflection(system));
        let (multiplier, force) = (lagrange::multiplier(system), augmented::contact_force(system, &u));
        let at_plane = [touching.clone(), structure::spring_force(system, &p)];
        let bracket = force.positive_part();
        vec![
            Program::with_branches(&both, condition.clone(), [touching.clone(), multiplier], apart()),
            Program::without_branches(&both, [admissible.clone(), contact::contact_force(system)]),
            Program::with_branches(&both, condition, [touching, force.clone()], apart()),
            Program::with_branches(&predicted, p, at_plane, apart()),
            Program::without_branches(&both[..1], [admissible.clone(), force]),
            Program::without_branches(&both[..1], [admissible, bracket]),
        ]
    }

    /// Returns every program with one edit: first those without a decision, and last those that change one use of
    /// a result.
    pub fn edits(self) -> Vec<Mistake> {
        let mut all = self.decisions();
        let (program, gap) = (self.program(), Tree::symbol("gap"));
        all.push(Mistake::new("the plane acts if H > l", program.deciding_by(gap.clone())));
        all.push(Mistake::new("the plane acts if H < l", program.deciding_by(-gap)));
        if self == Reference::Penalty {
            let rigid = Reference::Multiplier.program();
            all.push(Mistake::new("ε is not used: the plane is rigid", rigid));
        }
        let programs = self.programs();
        for program in &programs {
            all.extend(program.with_one_parameter(&self.parameters()));
            all.extend(program.with_one_operation());
            all.extend(program.with_one_output());
        }
        all.extend(programs.iter().flat_map(|program| program.inlined().with_one_operation()));
        all.retain(|mistake| !mistake.program.divides_by_zero());
        all
    }

    /// Returns the mistakes that a program may make in some answers only: in its decision or its output.
    pub fn in_some_answers(self) -> Vec<Mistake> {
        [self.decisions(), self.program().with_one_output()].concat()
    }

    /// Returns the programs that always, or never, give the results in contact.
    fn decisions(self) -> Vec<Mistake> {
        let program = self.program();
        let [never, always] = [0, 1].map(|value| program.deciding_by(Tree::from(value)));
        let mut without_force = always.clone();
        let mut forces = without_force.steps.iter_mut().filter(|step| step.name == "N");
        forces.next().expect("a force in contact").value = Tree::from(0);
        vec![
            Mistake::of(Kind::Decision, "the plane always acts", always),
            Mistake::of(Kind::Decision, "the plane never acts", never),
            Mistake::of(Kind::Decision, "the mass is held at the plane, with N = 0", without_force),
        ]
    }

    /// Returns every program with one unknown number k.
    pub fn numbers(self) -> Vec<Mistake> {
        let (system, k) = (&symbols().system, &Tree::symbol("k"));
        let program = self.program();
        let mut all = Vec::new();
        for x in self.parameters() {
            let parameter = Tree::symbol(x);
            for (name, used) in [
                (format!("{x} is {{k}} times the right value"), k * &parameter),
                (format!("{x} is always {{k}}"), k.clone()),
                (format!("{{k}} is added to {x}"), &parameter + k),
            ] {
                all.push(Mistake::of(Kind::Parameter, name, program.using(&[(x, used)])));
            }
        }
        let direction = program.using(&[("g", k * &system.g / system.g.abs())]);
        all.push(Mistake::of(Kind::Parameter, "g is always {k} or the negative of it", direction));
        let lengths = program.using(&[("l", k * &system.l), ("H", k * &system.h)]);
        all.push(Mistake::new("l and H are {k} times the right values", lengths));
        let [u, n] = returned();
        all.push(program.returning("u is at most {k} m", [u.min(k), n.clone()]));
        all.push(program.returning("u is at least {k} m", [-(-&u).min(&-k), n.clone()]));
        all.push(program.returning("N is at most {k} N", [u, n.min(k)]));
        match self {
            Reference::Multiplier => {
                all.extend(unrequested_penalties(system, k));
                all.extend(augmentations(system, k));
            }
            Reference::Penalty => {
                let eps = &symbols().eps;
                let u = augmented::deflection(system, eps, k);
                let both = [u.clone(), augmented::update(system, eps, k, &u)];
                all.push(method("it is one augmentation from the multiplier {k} N", both, apart()));
            }
        }
        all
    }
}

/// Returns the method with these results, where R > 0, and otherwise.
fn method(name: impl Into<String>, touching: Formulas, apart: Formulas) -> Mistake {
    let condition = system::reaction(&symbols().system);
    Mistake::new(name, Program::with_branches(&[], condition, touching, apart))
}

/// Returns methods with the penalty ε = k, k c or k m.
fn unrequested_penalties(system: &SpringMass<Tree>, k: &Tree) -> Vec<Mistake> {
    let exact = [lagrange::deflection(system), lagrange::multiplier(system)];
    let updated = "only the update of the augmentation is bracketed";
    let mut all = Vec::new();
    for (value, eps, also) in [
        ("{k} N/m", k.clone(), ""),
        ("{k} c", k * &system.c, ", or an iteration that always stops after the same number of steps"),
        ("{k}/s² m", k * &system.m, ""),
    ] {
        let pulled = penalty::deflection(system, &eps);
        let both = [pulled.clone(), penalty::contact_force(system, &eps, &Tree::symbol("u"))];
        for (name, touching, apart) in [
            ("it is the penalty method", both.clone(), apart()),
            ("it is the penalty method, and the plane also pulls", both.clone(), both.clone()),
            (updated, exact.clone(), [pulled, Tree::from(0)]),
            (&format!("{updated}, and N is not"), exact.clone(), both.clone()),
        ] {
            all.push(method(format!("{name}, with ε = {value}{also}"), touching, apart));
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
            let name = format!("the augmentation stops after {steps} steps with ε = {{k}} N/m{what}");
            let mistake = method(name, [deflection.clone(), force.clone()], apart());
            all.push(Mistake { kind: Kind::Augmentations(steps), ..mistake });
        }
        decay = decay * &contraction;
    }
    all
}

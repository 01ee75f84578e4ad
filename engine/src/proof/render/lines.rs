//! The proof of a goal as lines of text.
//!
//! A certificate l f = r is one line, with f as a sum over quantities of known sign. A line that is the same
//! in both cases of a proof is printed before them.

mod identity;

use self::identity::{placeholder, size};
use super::ProofPrinter;
use super::text::{number, sign_text, sum};
use crate::formula::claim::PRECISION;
use crate::formula::name_of_rounding;
use crate::formula::statement::Proposition;
use crate::formula::symbols::subscripted;
use crate::number::tree::Op;
use crate::number::{Exponential, PositivePart, Tree};
use crate::proof::check::{
    AbsoluteValue, Atom, Leaf, List, Node, Polynomial, Problem, Quotient, Reason, Rise, Sign, State,
    Translator, parts_of_rise,
};
use crate::proof::trace::{Step, reread, trace};

/// Maximum number of terms of a sum that is written out.
const SHOWN: usize = 12;

/// Maximum number of terms of a quantity that distinguishes cases without a name, and of a left form.
const SHOWN_OF_CASE: usize = 3;

/// Maximum number of terms of a sum with rounding errors that is written out.
const SHOWN_OF_ROUNDING: usize = 6;

/// Number of characters from which a formula is not repeated.
const LONG: usize = 40;

/// A letter that occurs in no name.
const PLACE: char = '□';

/// The assumptions of cases.
type Cases = Vec<(Polynomial, Sign)>;

/// A writer of the proof of a goal.
pub(super) struct Lines<'a> {
    printer: &'a ProofPrinter<'a>,
    problem: &'a Problem<'a>,
    /// The atoms as formulas.
    atoms: Vec<Tree>,
    /// The polynomials that have a name.
    named: Vec<(Polynomial, Tree)>,
}

/// The knowledge at the end of a leaf.
struct End<'a> {
    goal: &'a Lines<'a>,
    state: State<'a>,
    /// Facts that are hypotheses as they are written.
    written: Vec<(usize, Tree)>,
    /// The quantities whose signs decide the value or the order of formulas, with what follows.
    decisions: Vec<(Quotient, String)>,
}

impl<'a> Lines<'a> {
    /// Returns a writer for a goal.
    pub(super) fn new(printer: &'a ProofPrinter<'a>, problem: &'a Problem<'a>) -> Self {
        let mut translator = reread(State::new(problem));
        let formulas = (0..).map_while(|i| Some((i, problem.table.formula(i).ok()?)));
        let named = formulas.filter(|(_, tree)| printer.registry.call_name(tree).is_some());
        let named = named.filter_map(|(i, tree)| {
            let value =
                translator.value(i).ok().filter(|of| of.den.is_empty() && of.num.terms().len() > 1)?;
            Some((value.num, tree.clone()))
        });
        Lines { printer, problem, atoms: formulas_of_atoms(problem), named: named.collect() }
    }

    /// Describes the atoms.
    #[cfg(feature = "serde")]
    pub(super) fn descriptions(&self) -> Vec<String> {
        let described = self.atoms.iter().zip(self.problem.table.atoms()).map(|(tree, atom)| match atom {
            Atom::Own(_) | Atom::Size(_) | Atom::Exponential(_) => self.text(tree),
            Atom::Error(of) => format!("{tree}: {}({})", self.rounding(*of), self.formula(*of)),
            Atom::Factor(of) => format!("{tree}: {0} = {tree} |{0}|", self.formula(*of)),
            Atom::IntervalParameter(i) => {
                let interval = self.printer.registry.format_hypothesis(self.problem.hypotheses[*i]);
                format!("{tree}: from −1 to 1 in {interval}")
            }
        });
        described.collect()
    }

    /// Returns the lines of a proof under the assumptions of cases.
    pub(super) fn node(&self, node: &Node, cases: &mut Cases) -> Vec<String> {
        let (on, both) = match node {
            Node::Leaf(leaf) => return self.leaf(leaf, cases),
            Node::Cases(on, both) => (on, both),
        };
        let [first, second] = [(0, Sign::Positive), (1, Sign::NonPositive)].map(|(i, sign)| {
            cases.push((on.clone(), sign));
            let lines = self.node(&both[i], cases);
            cases.pop();
            lines
        });
        let pairs = first.iter().zip(&second);
        let common = pairs.take_while(|(a, b)| a == b && !a.starts_with("case ")).count();
        let mut lines = first[..common].to_vec();
        let name = self.text(&self.case(on, cases));
        let defined = match on.terms().len() {
            _ if !self.is_long_case(on) => String::new(),
            n if n > SHOWN => format!(", with a sum {name} of {n} terms"),
            _ => format!(", with {name} = {}", self.text_or_size(on)),
        };
        lines.push(format!("case {name} > 0{defined}:"));
        lines.extend(indented(first.into_iter().skip(common)));
        lines.push(format!("case {name} ≤ 0:"));
        lines.extend(indented(second.into_iter().skip(common)));
        lines
    }

    /// Returns the quantity that distinguishes cases after others; a long one has a name.
    fn case(&self, on: &Polynomial, before: &[(Polynomial, Sign)]) -> Tree {
        self.short(on).filter(|_| !self.is_long_case(on)).unwrap_or_else(|| {
            let named = before.iter().filter(|(on, _)| self.is_long_case(on)).count();
            Tree::symbol(subscripted('s', u8::try_from(named).unwrap_or(u8::MAX)))
        })
    }

    fn is_long_case(&self, on: &Polynomial) -> bool {
        on.terms().len() > SHOWN_OF_CASE && self.name(on).is_none()
    }

    /// Returns the name of a polynomial, with its sign.
    fn name(&self, of: &Polynomial) -> Option<Tree> {
        let negated = of.negated().ok()?;
        self.named.iter().find_map(|(known, tree)| match known {
            known if known == of => Some(tree.clone()),
            known if *known == negated => Some(-tree),
            _ => None,
        })
    }

    /// Returns a polynomial of atoms as a formula, if it is short or has a name.
    fn short(&self, of: &Polynomial) -> Option<Tree> {
        self.name(of).or_else(|| self.form(of, &[]))
    }

    fn leaf(&self, leaf: &Leaf, cases: &Cases) -> Vec<String> {
        let Ok((state, steps)) = trace(self.problem, leaf, cases) else { return Vec::new() };
        let goal = self.problem.proposition;
        // Formulas that were translated are translated again without the help of a proof.
        let mut written = Vec::new();
        let mut translator = reread(state);
        for (i, fact) in translator.state.assumed.clone() {
            if let Some(hypothesis) = i.map(|i| self.problem.hypotheses[i])
                && let Ok(value) = translator.translate(&hypothesis.value)
                && translator.state.facts.get(fact).is_ok_and(|(of, _)| value == of.clone().into())
            {
                written.push((fact, hypothesis.value.clone()));
            }
        }
        let facts_of_cases = translator.state.assumed.iter().filter(|(hypothesis, _)| hypothesis.is_none());
        let names = cases.iter().enumerate().map(|(depth, (on, _))| self.case(on, &cases[..depth]));
        written.extend(facts_of_cases.map(|(_, fact)| *fact).zip(names));
        let decisions = self.decisions(leaf, &mut translator);
        let sides = match (goal, &self.problem.goal[..]) {
            (Proposition::Derivative(..), [_, is, derivative]) => [*derivative, *is],
            (_, sides) => [sides[0], sides[1]],
        };
        let values = sides.map(|of| translator.value(of).ok());
        let end = End { goal: self, state: translator.state, written, decisions };
        let last = steps.len().saturating_sub(if matches!(goal, Proposition::Within(..)) { 2 } else { 1 });
        let (before, of_goal) = steps.split_at(last);
        let mut lines: Vec<_> = end.errors().into_iter().collect();
        lines.extend(leaf.hypotheses.iter().filter_map(|i| self.interval(*i)));
        lines.extend(leaf.rises.iter().flat_map(|rise| end.rise(rise)));
        lines.extend(end.steps(before));
        lines.extend(end.goal(of_goal, &values, !leaf.orders.is_empty()));
        lines
    }

    /// Returns the quantities whose signs decide the value or the order of formulas, with what follows.
    fn decisions(&self, leaf: &Leaf, translator: &mut Translator<List>) -> Vec<(Quotient, String)> {
        let (table, mut all) = (&self.problem.table, Vec::new());
        for errors in &leaf.orders {
            let [Some(Atom::Error(a)), Some(Atom::Error(b))] = errors.map(|x| table.atoms().get(x)) else {
                continue;
            };
            let rounded = [*a, *b].map(|of| table.formula(of).map(|of| self.text(&of.round())));
            let order = rounded.map(Result::unwrap_or_default).join(" ≥ ");
            all.extend(difference(*a, *b, translator).map(|decides| (decides, order)));
        }
        for (i, op) in (0..).map_while(|i| Some((i, table.op(i).ok()?))) {
            let (decides, branches) = match op {
                Op::PositivePart(a) => (translator.value(a).ok(), [a, a]),
                Op::Min(a, b) => (difference(b, a, translator), [a, b]),
                _ => continue,
            };
            let (Some(decides), Ok(value)) = (decides, translator.value(i)) else { continue };
            let is_first = translator.value(branches[0]).is_ok_and(|of| of == value);
            let [first, second] = branches.map(|branch| self.formula(branch));
            let follows = match op {
                // The minimum of −x and x is −|x|.
                Op::Min(a, b) if table.op(a) == Ok(Op::Neg(b)) => {
                    format!("|{second}| = {}", if is_first { second.clone() } else { first })
                }
                _ if value.num.is_zero() => format!("{} = 0", self.formula(i)),
                Op::PositivePart(_) if first.chars().count() > LONG => format!("⟨…⟩ = … for {first}"),
                _ => format!("{} = {}", self.formula(i), if is_first { first } else { second }),
            };
            all.push((decides, follows));
        }
        all
    }

    /// Returns the use of an interval.
    fn interval(&self, i: usize) -> Option<String> {
        let hypothesis = *self.problem.hypotheses.get(i)?;
        let (x, lower, upper) = hypothesis.interval()?;
        let parameter = &self.atoms[self.problem.table.variable(Atom::IntervalParameter(i)).ok()?];
        let by = format!("by {}: ", self.printer.registry.format_hypothesis(hypothesis));
        let [lower, upper] = [lower, upper].map(|end| self.text(end));
        let distance = hypothesis.distance();
        Some(match distance.as_ref().map(|(distance, most)| (distance.op(), *most)) {
            Some((Op::Sub(_, middle), most)) => {
                let value = self.text(&(middle + parameter * most));
                format!("{by}{x} = {value} with |{parameter}| ≤ 1")
            }
            _ => format!("{by}{parameter} goes from −1 to 1 as {x} goes from {lower} to {upper}"),
        })
    }

    /// Returns `true` for an exponential that depends on the variable of a limit.
    fn is_decaying(&self, x: usize, by: &str) -> bool {
        let atom = self.problem.table.atoms().get(x);
        matches!(atom, Some(Atom::Exponential(_))) && self.problem.depends(x, by)
    }

    fn text(&self, tree: &Tree) -> String {
        self.printer.text(tree)
    }

    /// Returns the name of a rounding of the formula with a number.
    fn rounding(&self, of: usize) -> &'static str {
        self.problem.table.formula(of).map_or("", name_of_rounding)
    }

    fn formula(&self, i: usize) -> String {
        self.problem.table.formula(i).map(|tree| self.text(tree)).unwrap_or_default()
    }

    /// Returns a form as a formula, if it is short. `known` are the quantities that follow the atoms.
    fn form(&self, form: &Polynomial, known: &[Tree]) -> Option<Tree> {
        let has_units = !form.has_only(|x| !self.problem.table.is_unit(x));
        if form.terms().len() > if has_units { SHOWN_OF_ROUNDING } else { SHOWN } {
            return None;
        }
        let order = self.printer.registry.factors();
        let terms: Vec<_> = form.terms().collect();
        Some(sum(terms.into_iter().rev().map(|(powers, n)| {
            let factors = self.atoms.iter().chain(known).zip(powers);
            let mut factors: Vec<_> =
                factors.flat_map(|(factor, n)| std::iter::repeat_n(factor, usize::from(*n))).collect();
            factors.sort_by_key(|factor| match factor.op() {
                Op::Symbol(name) => (order.iter().position(|symbol| symbol == name), *name),
                _ => (Some(order.len()), ""),
            });
            let size = number(&n.unsigned_abs().into());
            let product = factors.into_iter().cloned().reduce(|a, b| a * b);
            (n.is_negative(), product.map_or(size.clone(), |product| size * product))
        })))
    }

    /// Returns a quantity as a factor; a reserved symbol stands for a sum, so that it is not merged with others.
    fn factor(&self, tree: &Tree, sums: &mut Vec<String>) -> Tree {
        match tree.op() {
            Op::Neg(negated) => -self.factor(negated, sums),
            Op::Add(..) | Op::Sub(..) if self.printer.registry.call_name(tree).is_none() => {
                placeholder(self.text(tree), sums)
            }
            _ => tree.clone(),
        }
    }

    /// Formats a formula with sums in place of reserved symbols.
    fn filled(&self, tree: &Tree, sums: &[String]) -> String {
        let all = (0..=u8::MAX).zip(sums).rev();
        all.fold(self.text(tree), |text, (i, sum)| text.replace(subscripted(PLACE, i), &format!("({sum})")))
    }

    /// Formats a polynomial of atoms, or its size if it is long.
    fn text_or_size(&self, of: &Polynomial) -> String {
        self.short(of).map_or_else(|| size(of, "term"), |tree| self.text(&tree))
    }
}

impl End<'_> {
    /// Returns the rounded formulas with the names of their errors.
    fn errors(&self) -> Option<String> {
        let mut all: Vec<(usize, Vec<String>)> = Vec::new();
        for rounded in &self.state.rounded {
            let text = format!("{}({})", self.goal.rounding(rounded.of), self.goal.formula(rounded.of));
            match all.iter_mut().find(|(error, _)| *error == rounded.error) {
                Some((_, same)) => same.push(text),
                None => all.push((rounded.error, vec![text])),
            }
        }
        if all.is_empty() {
            return None;
        }
        let errors = all.into_iter().map(|(x, of)| format!("{} of {}", self.goal.atoms[x], of.join(" and ")));
        let errors = errors.collect::<Vec<_>>().join(", ");
        Some(format!("fl(…) = … (1 + eᵢ / ({PRECISION} + 1)) with |eᵢ| ≤ 1: {errors}"))
    }

    /// Returns the lines about the steps before the goal.
    fn steps(&self, steps: &[Step]) -> Vec<String> {
        let (mut lines, mut divisors) = (Vec::new(), 0);
        for step in steps {
            match step {
                Step::Divisor(factors) => divisors = factors.len(),
                Step::Rounding(..) => {}
                Step::Size(of, _, AbsoluteValue::Atom) => {
                    let size = self.equation_of_size(*of);
                    lines.extend(size.map(|(equation, factor)| format!("{equation} with |{factor}| ≤ 1")));
                }
                Step::Size(..) => {}
                Step::Sign { of, den, reason, .. } => {
                    let value = Quotient { num: of.clone(), den: den.clone() };
                    lines.extend(self.sign_step(&value, reason, divisors > 0, &lines));
                    divisors = divisors.saturating_sub(1);
                }
            }
        }
        lines
    }

    /// Returns the line about the sign of a numerator, except an earlier one.
    fn sign_step(
        &self,
        of: &Quotient,
        reason: &Reason,
        is_divisor: bool,
        earlier: &[String],
    ) -> Option<String> {
        let sign = self.sign("", &of.num, &of.den, reason).filter(|_| !of.num.is_zero());
        let decision = self.decisions.iter().find(|(decides, _)| decides == of);
        let line = match (decision, sign) {
            (Some((_, follows)), _) if earlier.iter().any(|line| line.starts_with(follows)) => None,
            (Some((_, follows)), Some(sign)) => Some(format!("{follows}, since {sign}")),
            (Some((_, follows)), None) => Some(follows.clone()),
            (None, sign) => sign.filter(|_| !self.is_plain(&of.num)).map(|sign| match is_divisor {
                true => format!("divisor {sign}"),
                false => sign,
            }),
        };
        line.filter(|line| !earlier.contains(line))
    }

    /// Returns the lines about a function whose sign follows from its start and its slope.
    fn rise(&self, rise: &Rise) -> Vec<String> {
        let problem = self.goal.problem;
        let Some(Atom::Own(x)) = problem.table.atoms().get(rise.x) else { return Vec::new() };
        let Ok(parts) = parts_of_rise(problem, rise, x) else { return Vec::new() };
        let at_x = self.state.signs[rise.x].unwrap_or(Sign::NonNegative);
        let sign = Sign::from(rise.start).plus(at_x.times(rise.slope.into())).map_or("", sign_text);
        let of = self.goal.text_or_size(&rise.of);
        let mut lines = vec![format!("{of} {sign}, by its value at {x} = 0 and its slope for {x} > 0:")];
        let names = [format!("at {x} = 0"), "slope".to_string()];
        for (((proposition, assumed), node), name) in parts.iter().zip(&rise.parts).skip(1).zip(names) {
            let others = problem.hypotheses.iter().copied();
            let others = others.filter(|other| !other.value.symbols().contains(x)).chain(assumed);
            let Ok(part) = Problem::new(proposition, others.collect()) else { continue };
            let part_lines = Lines::new(self.goal.printer, &part).node(node, &mut Vec::new());
            match &part_lines[..] {
                [line] => lines.push(format!("  {name}: {line}")),
                _ => {
                    lines.push(format!("  {name}:"));
                    lines.extend(indented(indented(part_lines)));
                }
            }
        }
        lines
    }

    /// Returns `true` for a variable, for a number, and for 2ᵖ + 1.
    fn is_plain(&self, of: &Polynomial) -> bool {
        let atoms = self.goal.problem.table.atoms();
        let is_in_precision = of.has_only(|x| matches!(atoms.get(x), Some(Atom::Own(PRECISION))));
        of.terms().len() <= 1 || (is_in_precision && of.terms().all(|(_, n)| n.is_positive()))
    }

    /// Returns the lines about the goal.
    fn goal(&self, steps: &[Step], values: &[Option<Quotient>; 2], is_order: bool) -> Vec<String> {
        let names: &[&str] = match self.goal.problem.proposition {
            Proposition::Within(..) => &["the bound − it is ", "the bound + it is "],
            Proposition::Sign(..) => &["it is "],
            _ => &["the difference is "],
        };
        let mut lines = Vec::new();
        for (name, step) in names.iter().zip(steps) {
            let Step::Sign { of, den, reason, .. } = step else { continue };
            match (self.goal.problem.proposition, values) {
                (Proposition::Limit(_, by, _), [Some(of), Some(to)]) => {
                    let has_decay = !of.num.has_only(|x| !self.goal.is_decaying(x, by));
                    let decay = if has_decay { ", as its exponentials decay" } else { "" };
                    let (of, to) = (self.quotient(of), self.quotient(to));
                    lines.push(format!("it is {of}, which tends to {to} by its degrees in {by}{decay}"));
                }
                (Proposition::Equal(..), [Some(a), Some(b)]) if of.is_zero() => {
                    let shorter = [a, b].into_iter().min_by_key(|side| side.num.terms().len());
                    lines.push(format!("both sides are {}", self.quotient(shorter.unwrap_or(a))));
                }
                (Proposition::Derivative(..), [_, Some(is)]) => {
                    lines.push(format!("the derivative is {}", self.quotient(is)));
                }
                _ if of.is_zero() => lines.push(format!("{name}0")),
                // The last line about orders is the goal.
                (Proposition::Sign(..), _) if is_order && matches!(reason, Reason::Fact(_)) => {}
                _ => lines.extend(self.sign(name, of, den, reason)),
            }
        }
        if let [less, more] = &lines[..]
            && let Some(rest) = less.strip_prefix(names[0])
            && names.get(1).is_some_and(|name| more.strip_prefix(name) == Some(rest))
        {
            return vec![format!("each of the bound ± it is {rest}")];
        }
        lines
    }
}

/// Returns the atoms as formulas; e₁, e₂, … are errors, and t₁, t₂, … interval parameters and factors.
fn formulas_of_atoms(problem: &Problem) -> Vec<Tree> {
    let (mut errors, mut parameters) = (0.., 0..);
    let atoms = problem.table.atoms().iter().map(|atom| match atom {
        Atom::Own(name) => Tree::symbol(name),
        Atom::Error(_) => Tree::symbol(subscripted('e', errors.next().unwrap_or_default())),
        Atom::IntervalParameter(_) | Atom::Factor(_) => {
            Tree::symbol(subscripted('t', parameters.next().unwrap_or_default()))
        }
        Atom::Size(of) => problem.table.formula(*of).map_or_else(|_| Tree::from(0), Tree::abs),
        Atom::Exponential(of) => problem.table.formula(*of).map_or_else(|_| Tree::from(0), Tree::exp),
    });
    atoms.collect()
}

fn indented(lines: impl IntoIterator<Item = String>) -> impl Iterator<Item = String> {
    lines.into_iter().map(|line| format!("  {line}"))
}

/// Returns the difference of two formulas that have been read.
fn difference(a: usize, b: usize, translator: &mut Translator<List>) -> Option<Quotient> {
    let (a, b) = (translator.value(a).ok()?, translator.value(b).ok()?);
    translator.state.facts.sum(&a, -1, &b).ok()
}

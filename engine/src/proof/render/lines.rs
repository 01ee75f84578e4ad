//! The proof of a goal as lines of text: one for each certificate l f = r, in which s₁, s₂, … are facts.

use super::ProofPrinter;
use super::text::{LONG, sign_text};
use crate::formula::claim::PRECISION;
use crate::formula::statement::Proposition;
use crate::formula::symbols::subscripted;
use crate::number::tree::Op;
use crate::number::{Exponential, PositivePart, Tree};
use crate::proof::check::{
    Atom, Certificate, Knowledge, Law, Node, Polynomial, Quotient, Refusal, Sequent, Sign, Step,
};
use std::collections::{BTreeMap, BTreeSet};

/// Lines, or the reason for which the checker refuses the proof.
type Result<T> = std::result::Result<T, Refusal>;

/// A writer of the proof of a goal.
pub(super) struct Lines<'a> {
    printer: &'a ProofPrinter<'a>,
    sequent: &'a Sequent<'a>,
    /// The atoms as formulas; e₁, e₂, … are errors, and t₁, t₂, … interval parameters and factors.
    atoms: Vec<Tree>,
}

/// The facts that are named at a leaf.
type Names = BTreeMap<usize, Tree>;

/// A quantity that a goal is about, with the words before and after it.
type Phrase = (&'static str, Quotient, String);

impl<'a> Lines<'a> {
    /// Returns a writer for a goal.
    pub(super) fn new(printer: &'a ProofPrinter<'a>, sequent: &'a Sequent<'a>) -> Self {
        let (mut errors, mut parameters) = (0.., 0..);
        let atoms = sequent.table.atoms.iter().map(|atom| match atom {
            Atom::Own(name) => Tree::symbol(name),
            Atom::Error(_) => Tree::symbol(subscripted('e', errors.next().unwrap_or_default())),
            Atom::IntervalParameter(_) | Atom::Factor(_) => {
                Tree::symbol(subscripted('t', parameters.next().unwrap_or_default()))
            }
            Atom::Size(of) => formula(sequent, *of).abs(),
            Atom::Exponential(of) => formula(sequent, *of).exp(),
        });
        Lines { printer, sequent, atoms: atoms.collect() }
    }

    /// Describes the atoms.
    #[cfg(feature = "serde")]
    pub(super) fn descriptions(&self) -> Vec<String> {
        let atoms = self.atoms.iter().zip(&self.sequent.table.atoms);
        let described = atoms.map(|(tree, atom)| match atom {
            Atom::Own(_) | Atom::Size(_) | Atom::Exponential(_) => self.text(tree),
            Atom::Error(of) => format!("{tree}: {}", self.rounding(*of)),
            Atom::Factor(of) => format!("{tree}: {0} = {tree} |{0}|", self.formula(*of)),
            Atom::IntervalParameter(i) => format!("{tree}: from −1 to 1 in {}", self.hypothesis(*i)),
        });
        described.collect()
    }

    /// Returns the lines of a proof under the assumptions of cases.
    pub(super) fn node(&self, node: &Node, cases: &mut Vec<(Polynomial, Sign)>) -> Result<Vec<String>> {
        let (on, both) = match node {
            Node::Leaf(steps) => return self.leaf(steps, cases),
            Node::Cases(on, both) => (on, both),
        };
        let mut lines = Vec::new();
        for (node, sign) in both.iter().zip([Sign::POSITIVE, Sign::NON_POSITIVE]) {
            let name = subscripted('s', u8::try_from(cases.len()).unwrap_or(u8::MAX));
            lines.push(format!("case {name} = {} {}:", self.polynomial(on, &[]), sign_text(sign)));
            cases.push((on.clone(), sign));
            lines.extend(self.node(node, cases)?.into_iter().map(|line| format!("  {line}")));
            cases.pop();
        }
        Ok(lines)
    }

    fn leaf(&self, steps: &[Step], cases: &[(Polynomial, Sign)]) -> Result<Vec<String>> {
        let mut state = Knowledge::new(self.sequent, cases)?;
        let mut added = Vec::with_capacity(steps.len());
        for step in steps {
            added.push((step, state.facts.all.len()));
            state.apply(step)?;
        }
        let goal = self.goal(&mut state)?;
        let names = names(&state, steps, cases.len(), &goal);
        let mut lines = Vec::from_iter(self.errors());
        lines.extend(added.into_iter().filter_map(|(step, fact)| self.step(step, &state, fact, &names)));
        lines.extend(self.branches(&mut state)?);
        let goal =
            goal.iter().map(|(is, of, end)| format!("{is} {}{end}", self.quotient(of, &state, &names)));
        lines.extend(goal);
        Ok(lines)
    }

    /// Returns the quantities that the goal is about.
    fn goal(&self, state: &mut Knowledge) -> Result<Vec<Phrase>> {
        let values = self.sequent.goal.iter().map(|of| state.value(*of)).collect::<Result<Vec<_>>>()?;
        Ok(match (self.sequent.proposition, &values[..]) {
            // The line about a numerator of several terms is one about the goal.
            (Proposition::Sign(..), [of, ..]) if of.den.is_empty() && of.num.terms().len() > 1 => Vec::new(),
            (Proposition::Sign(relation, _), [of, ..]) => {
                vec![("it is", of.clone(), format!(" {relation} 0"))]
            }
            (Proposition::Within(..), _) => {
                let ends = ["the bound − it is", "the bound + it is"].into_iter().zip(state.goals()?);
                ends.map(|(is, (of, _))| (is, of, " ≥ 0".into())).collect()
            }
            (Proposition::Equal(..), [a, b]) => {
                let difference = state.goals()?.swap_remove(0).0;
                let shorter = if a.num.terms().len() <= b.num.terms().len() { a } else { b };
                vec![match difference.num.is_zero() {
                    true => ("both sides are", shorter.clone(), String::new()),
                    false => ("the difference is", difference, " = 0".into()),
                }]
            }
            (Proposition::Derivative(..), [_, is, _]) => {
                vec![("the derivative is", is.clone(), String::new())]
            }
            (Proposition::Limit(_, by, _), [of, to]) => {
                let mut atoms = self.sequent.table.atoms.iter().enumerate();
                let decays = atoms.any(|(x, atom)| {
                    matches!(atom, Atom::Exponential(_)) && of.num.degree(x) > 0 && self.sequent.varies(x)
                });
                let decay = if decays { ", as its exponentials decay" } else { "" };
                let reason = format!(" by its degrees in {by}{decay}");
                vec![("it is", of.clone(), String::new()), ("it tends to", to.clone(), reason)]
            }
            _ => Vec::new(),
        })
    }

    /// Returns the line about rounded formulas.
    fn errors(&self) -> Option<String> {
        let atoms = self.atoms.iter().zip(&self.sequent.table.atoms);
        let errors = atoms.filter_map(|(tree, atom)| match atom {
            Atom::Error(of) => Some(format!("{tree} of {}", self.rounding(*of))),
            _ => None,
        });
        let errors = errors.collect::<Vec<_>>().join(", ");
        (!errors.is_empty())
            .then(|| format!("fl(…) = … (1 + eᵢ / ({PRECISION} + 1)) with |eᵢ| ≤ 1: {errors}"))
    }

    /// Returns the values of short minima and positive parts.
    fn branches(&self, state: &mut Knowledge) -> Result<Vec<String>> {
        let mut lines = Vec::new();
        for (i, op) in (0..).map_while(|i| Some((i, self.sequent.table.op(i).ok()?))) {
            let (first, second) = match op {
                Op::PositivePart(of) => (of, "0".into()),
                Op::Min(a, b) if self.sequent.table.op(a) != Ok(Op::Neg(b)) => (a, self.formula(b)),
                _ => continue,
            };
            if state.values.contains_key(&i) {
                let is_first = state.value(i)? == state.value(first)?;
                let value = if is_first { self.formula(first) } else { second };
                lines.push(format!("{} = {value}", self.formula(i)));
            }
        }
        lines.retain(|line| line.chars().count() <= LONG);
        Ok(lines)
    }

    /// Returns the line about a step that adds the fact with this number.
    fn step(&self, step: &Step, state: &Knowledge, fact: usize, names: &Names) -> Option<String> {
        let reason = match step {
            Step::Divisor(_) => return None,
            Step::Assume(i) => match self.sequent.table.variable(Atom::IntervalParameter(*i)) {
                Ok(t) => {
                    let definition =
                        self.printer.parameter(&self.text(&self.atoms[t]), self.sequent.hypotheses[*i])?;
                    return Some(format!("by {}: {definition}", self.hypothesis(*i)));
                }
                Err(_) => format!(" by {}", self.hypothesis(*i)),
            },
            Step::Show(of, certificate) => self.shown(of, certificate, names),
            Step::Square(_) => String::new(),
            Step::Law(law) => format!(", as {}", self.law(law)?),
        };
        let (of, sign) = state.facts.get(fact).ok()?;
        let name = names.get(&fact).map(|name| format!("{name} = "));
        let is_printed = name.is_some() || of.terms().len() > 1;
        let name = name.unwrap_or_default();
        is_printed.then(|| format!("{name}{} {}{reason}", self.polynomial(of, &[]), sign_text(*sign)))
    }

    /// Returns the law that a fact is an instance of.
    fn law(&self, law: &Law) -> Option<String> {
        Some(match law {
            Law::Exponents { .. } => "the exponents have the same sum".into(),
            Law::AboveTangent(_) => "exp(x) > 1 + x for x ≠ 0".into(),
            Law::BelowPole(_) => "(2 − x) exp(x) < 2 + x for x > 0".into(),
            Law::AbsoluteValue(of) => {
                let t = self.sequent.table.variable(Atom::Factor(*of)).ok()?;
                self.printer.multiple_of_size(&self.formula(*of), &self.text(&self.atoms[t]))
            }
            Law::Signed(_) => "|x| is x or −x".into(),
            Law::Order([a, b]) => {
                format!("{} ≥ {}, since rounding is monotone", self.formula(*a), self.formula(*b))
            }
        })
    }

    /// Returns the identity of a certificate: `, as c times it is s₁ + e₁`.
    fn shown(&self, of: &Polynomial, certificate: &Certificate, names: &Names) -> String {
        let Certificate { known, left, right } = certificate;
        // Only the fact 2 > 0 has no name.
        let facts = known.iter().map(|i| names.get(i).cloned().unwrap_or_else(|| Tree::from(2)));
        let facts: Vec<_> = facts.collect();
        let [left_text, right_text] = [left, right].map(|form| self.polynomial(form, &facts));
        match () {
            () if *right == *of => String::new(),
            () if *left == Polynomial::constant(1) => format!(", as it is {right_text}"),
            () => format!(", as {left_text} times it is {right_text}"),
        }
    }

    /// Formats a quotient, or its shape if it is long.
    fn quotient(&self, of: &Quotient, state: &Knowledge, names: &Names) -> String {
        let num = self.part(&of.num, state, names);
        let den = of.den.iter().map(|i| self.part(&state.facts.get(*i).ok()?.0, state, names));
        let quotient = num.and_then(|num| den.into_iter().try_fold(num, |num, factor| Some(num / factor?)));
        quotient.map_or_else(
            || format!("{} over a product of {} factors", self.polynomial(&of.num, &[]), of.den.len()),
            |tree| self.text(&tree),
        )
    }

    /// Returns the name of a fact about a polynomial, otherwise the polynomial as a formula, if it is short.
    fn part(&self, of: &Polynomial, state: &Knowledge, names: &Names) -> Option<Tree> {
        let name = state.facts.all.iter().position(|(known, _)| known == of).and_then(|i| names.get(&i));
        name.cloned().or_else(|| self.form(of, &[]))
    }

    fn text(&self, tree: &Tree) -> String {
        self.printer.text(tree)
    }

    fn rounding(&self, of: usize) -> String {
        self.printer.rounding(&formula(self.sequent, of))
    }

    fn formula(&self, of: usize) -> String {
        self.text(&formula(self.sequent, of))
    }

    fn hypothesis(&self, i: usize) -> String {
        self.printer.registry.format_hypothesis(self.sequent.hypotheses[i])
    }

    /// Formats a polynomial of atoms and, after these, known quantities, or its shape if it is long.
    fn polynomial(&self, of: &Polynomial, known: &[Tree]) -> String {
        self.form(of, known)
            .map_or_else(|| format!("a sum of {} terms", of.terms().len()), |tree| self.text(&tree))
    }

    /// Returns a polynomial of atoms and, after these, known quantities, as a formula, if it is short.
    fn form(&self, of: &Polynomial, known: &[Tree]) -> Option<Tree> {
        let terms = of.terms().map(|(powers, n)| ((*n).into(), powers.iter().copied().enumerate()));
        self.printer.sum(terms, &|x| self.atoms.iter().chain(known).nth(x).cloned())
    }
}

/// Returns a formula of a sequent.
fn formula(sequent: &Sequent, of: usize) -> Tree {
    sequent.table.formula(of).map_or_else(|_| Tree::from(0), Tree::clone)
}

/// Returns the names of facts: those that certificates refer to, assumptions of cases, and the goal.
fn names(state: &Knowledge, steps: &[Step], cases: usize, goal: &[Phrase]) -> Names {
    let mut named = BTreeSet::from_iter(1..=cases);
    for step in steps {
        if let Step::Show(_, certificate) = step {
            named.extend(&certificate.known);
        }
    }
    let signed = goal.iter().filter(|(_, _, end)| !end.is_empty()).map(|(_, of, _)| &of.num);
    let signed: Vec<_> = signed.filter(|of| of.terms().len() > 1).collect();
    // The first fact is 2 > 0.
    let facts = state.facts.all.iter().enumerate().skip(1);
    let facts = facts.filter(|(i, (of, _))| named.contains(i) || signed.contains(&of));
    facts.zip(0..).map(|((i, _), number)| (i, Tree::symbol(subscripted('s', number)))).collect()
}

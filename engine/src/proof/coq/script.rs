//! Proofs of goals as inputs of the program in Coq: numbers, what is given of them, and the steps of the checker.

use super::lemma::{Lemma, Result};
use super::print::{ascii, simplified};
use crate::formula::claim::{PRECISION, SCALES};
use crate::formula::{Hypothesis, Proposition, Registry, Statement};
use crate::number::tree::Op;
use crate::proof::check::{Atom, Certificate, Law, Node, Polynomial, Sequent, Step};
use crate::proof::render::ProofPrinter;
use crate::proof::search::prove_proposition;

/// Returns the call of the program that proves a proposition from hypotheses. Those that a lemma about a limit does not
/// state hold for large values of its variable.
pub(super) fn program(
    lemma: &Lemma,
    hypotheses: &[&Hypothesis],
    proposition: &Proposition,
) -> Result<String> {
    // Formulas are simplified as they are printed.
    let proposition = proposition.map(&simplified);
    let sequent = Sequent::new(&proposition, hypotheses.to_vec())?;
    let node = prove_proposition(&proposition, hypotheses.to_vec()).map_err(|reason| {
        let statement = Statement::new("", proposition.clone()).assuming(hypotheses.iter().copied());
        let reason = ProofPrinter::new(&Registry::default()).describe(&statement, &reason);
        format!("no proof to follow: {reason}")
    })?;
    let mut writer = Writer { lemma, sequent: &sequent, given: Vec::new() };
    writer.give_hypotheses()?;
    writer.give_values()?;
    let proof = writer.node(&node)?;
    let atoms = sequent.table.atoms.iter().map(|atom| writer.atom(*atom));
    let atoms = atoms.collect::<Result<Vec<_>>>()?;
    let atoms = if atoms.is_empty() { "@nil R".into() } else { list(&atoms) };
    let variable = sequent.variable().map_or("_".into(), ascii);
    let given: String = writer.given.iter().map(|proof| format!(", {proof}")).collect();
    Ok(format!("(fun {variable} : R => {atoms}) (fun {variable} : R => (I{given}))\n    {proof}"))
}

/// The proof of a sequent in Coq.
struct Writer<'w> {
    lemma: &'w Lemma<'w>,
    sequent: &'w Sequent<'w>,
    /// Proofs of what steps use: the hypotheses, the values of roundings and absolute values, and instances of laws.
    given: Vec<String>,
}

impl Writer<'_> {
    /// Writes the formula with a number as an argument.
    fn formula(&self, number: usize) -> Result<String> {
        Ok(self.lemma.printer.expr(self.sequent.table.formula(number)?).argument())
    }

    /// Returns the number that an atom stands for.
    fn atom(&self, atom: Atom) -> Result<String> {
        Ok(match atom {
            Atom::Own(name) => ascii(name),
            Atom::Error(of) => {
                format!("clamp (error prec choice {} {})", ascii(PRECISION), self.formula(of)?)
            }
            Atom::Exponential(of) => format!("exp {}", self.formula(of)?),
            Atom::Size(of) => format!("Rabs {}", self.formula(of)?),
            Atom::Factor(of) => format!("clamp (factor {})", self.formula(of)?),
            Atom::IntervalParameter(i) => {
                let (x, lower, upper) = self.sequent.hypotheses[i].interval().ok_or("no interval")?;
                let [lower, upper] = [lower, upper].map(|end| self.lemma.printer.expr(end).argument());
                format!("clamp (parameter {lower} {upper} {})", ascii(x))
            }
        })
    }

    fn give_hypotheses(&mut self) -> Result<()> {
        for (i, hypothesis) in self.sequent.hypotheses.iter().enumerate() {
            let label = self.lemma.label(hypothesis);
            self.given.push(match label {
                _ if self.sequent.mentions_variable(i) => {
                    let value = self.lemma.printer.expr(&hypothesis.value);
                    format!("later ({})", value.relation(hypothesis.relation))
                }
                Some(label) if hypothesis.distance().is_some() => format!("near _ _ _ {label}"),
                Some(label) if hypothesis.interval().is_some() => format!("between _ _ _ {label}"),
                label => label.ok_or("a hypothesis without a label")?,
            });
        }
        Ok(())
    }

    /// Lists the values of absolute values and of rounded formulas, each after those in it.
    fn give_values(&mut self) -> Result<()> {
        let table = &self.sequent.table;
        for atom in &table.atoms {
            if let Atom::Size(of) = atom {
                self.given.push(format!("absolute {}", self.formula(*of)?));
            }
        }
        let two_p = ascii(PRECISION);
        for op in (0..).map_while(|i| table.op(i).ok()) {
            let Op::Rounded(of) = op else { continue };
            let (powers, unscaled) = table.rounding(of);
            if table.variable(Atom::Error(unscaled)).is_err() {
                continue;
            }
            let (own, error) = (self.formula(of)?, self.formula(unscaled)?);
            let [down, up] = [-1, 1].map(|sign| product_of_scales(powers.map(|n| sign * n)));
            self.given.push(format!("model prec choice {two_p} P E {error}"));
            if unscaled != of {
                let powers = "ltac:(power_of_two) ltac:(power_of_two)";
                self.given
                    .push(format!("same_error prec choice {two_p} {down} {up} {own} {error} P E {powers}"));
            }
        }
        Ok(())
    }

    fn node(&mut self, node: &Node) -> Result<String> {
        Ok(match node {
            Node::Leaf(steps) => {
                let steps = steps.iter().map(|step| self.step(step)).collect::<Result<Vec<_>>>()?;
                format!("(Steps {})", list(&steps))
            }
            Node::Cases(on, both) => {
                let [positive, not] = [&both[0], &both[1]].map(|node| self.node(node));
                format!("(Cases {}\n    {}\n    {})", text(on), positive?, not?)
            }
        })
    }

    fn step(&mut self, step: &Step) -> Result<String> {
        Ok(match step {
            Step::Assume(i) => format!("Given {i}"),
            Step::Show(of, Certificate { known, left, right }) => {
                format!("Shown {} {} {} {}", text(of), numbers(known), text(left), text(right))
            }
            Step::Square(of) => format!("Squared {}", text(of)),
            Step::Divisor(factors) => format!("Divisor {}", numbers(factors)),
            Step::Law(law) => {
                let law = self.law(law)?;
                self.given.push(law);
                format!("Given {}", self.given.len() - 1)
            }
        })
    }

    /// Returns the proof of an instance of a law.
    fn law(&self, law: &Law) -> Result<String> {
        Ok(match law {
            Law::Exponents { left, right } => {
                let [left, right] = [left, right]
                    .map(|all| all.iter().map(|x| self.exponent(*x)).collect::<Result<Vec<_>>>());
                format!("same_exponents {} {}", list(&left?), list(&right?))
            }
            Law::AboveTangent(x) => format!("above_tangent {}", self.exponent(*x)?),
            Law::BelowPole(x) => format!("below_pole {}", self.exponent(*x)?),
            Law::AbsoluteValue(of) => format!("own_factor {}", self.formula(*of)?),
            Law::Signed(of) => format!("own_size {}", self.formula(*of)?),
            Law::Order(rounded) => {
                let [a, b] = rounded.map(|rounded| match self.sequent.table.op(rounded)? {
                    Op::Rounded(of) => self.formula(of),
                    _ => Err("an order of other formulas than rounded ones".into()),
                });
                format!("ordered prec choice P {} {}", a?, b?)
            }
        })
    }

    /// Writes the exponent of an exponential as an argument.
    fn exponent(&self, x: usize) -> Result<String> {
        match self.sequent.table.atoms.get(x) {
            Some(Atom::Exponential(of)) => self.formula(*of),
            _ => Err("a law about another quantity than an exponential".into()),
        }
    }
}

/// Returns a product of scales to those powers that are positive, as an argument.
fn product_of_scales(powers: [i32; 3]) -> String {
    let factors = SCALES.iter().zip(powers).flat_map(|(scale, n)| (0..n).map(move |_| ascii(scale)));
    format!("({})", factors.fold("1".into(), |product: String, scale| format!("{product} * {scale}")))
}

/// Returns a list in Coq.
fn list(items: &[String]) -> String {
    format!("[{}]", items.join("; "))
}

fn numbers(all: &[usize]) -> String {
    format!("{}%nat", list(&all.iter().map(usize::to_string).collect::<Vec<_>>()))
}

/// Returns a polynomial as text: terms with signs, and a character for each variable.
fn text(of: &Polynomial) -> String {
    let mut terms = Vec::new();
    for (powers, coefficient) in of.terms() {
        let factors = powers.iter().zip(b'?'..).filter(|(n, _)| **n > 0);
        let factors = factors.map(|(n, x)| format!("{}{}", char::from(x), unless_one((*n).into())));
        let sign = if coefficient.is_negative() { '-' } else { '+' };
        let number = unless_one(coefficient.unsigned_abs());
        terms.push(format!("{sign}{number}{}", factors.collect::<String>()));
    }
    format!("\"{}\"", terms.join(" "))
}

fn unless_one(n: u128) -> String {
    if n == 1 { String::new() } else { n.to_string() }
}

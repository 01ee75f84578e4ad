//! Identities as text: each certificate is a line about the sign of a quotient.

use super::{End, PLACE, SHOWN_OF_CASE, sign_text};
use crate::formula::symbols::subscripted;
use crate::number::Tree;
use crate::proof::check::{Atom, Certificate, Known, Polynomial, Quotient, Reason, Sign};

/// The sides of a certificate as formulas, if they are short.
struct Forms {
    left: Option<Tree>,
    right: Option<Tree>,
    /// The sums for which reserved symbols stand.
    sums: Vec<String>,
}

impl End<'_> {
    /// Formats a quotient in lowest terms, or its size if it is long.
    pub(super) fn quotient(&self, of: &Quotient) -> String {
        let (mut num, mut den) = (of.num.clone(), of.den.clone());
        den.retain(|i| {
            let quotient = self.state.facts.get(*i).ok().and_then(|(by, _)| divided(&num, by));
            quotient.map(|quotient| num = quotient).is_none()
        });
        self.format_quotient(&num, &den)
    }

    /// Formats a polynomial over a product of facts, or its size if it is long.
    fn format_quotient(&self, num: &Polynomial, den: &[usize]) -> String {
        match self.goal.form(num, &[]) {
            Some(num) => self.formula_over(num, Vec::new(), den),
            None if den.is_empty() => size(num, "term"),
            None => {
                let mut sums = Vec::new();
                let den = self.product(den, &mut sums);
                format!("{} over {}", size(num, "term"), self.goal.filled(&den, &sums))
            }
        }
    }

    /// Formats a formula that contains sums over a product of facts.
    fn formula_over(&self, num: Tree, mut sums: Vec<String>, den: &[usize]) -> String {
        let value = if den.is_empty() { num } else { num / self.product(den, &mut sums) };
        self.goal.filled(&value, &sums)
    }

    /// Returns a product of facts.
    fn product(&self, facts: &[usize], sums: &mut Vec<String>) -> Tree {
        let factors = facts.iter().map(|i| match self.fact(*i) {
            Some(fact) => self.goal.factor(&fact, sums),
            None => placeholder("a long sum".to_string(), sums),
        });
        factors.reduce(|a, b| a * b).unwrap_or_else(|| Tree::from(1))
    }

    /// Returns a fact as a formula, if it is short.
    fn fact(&self, i: usize) -> Option<Tree> {
        match self.written.iter().find(|(fact, _)| *fact == i) {
            Some((_, tree)) => Some(tree.clone()),
            None => self.goal.short(&self.state.facts.get(i).ok()?.0),
        }
    }

    /// Returns the line about the sign of a quotient after a prefix; `None` if it is the assumption of a case.
    pub(super) fn sign(
        &self,
        prefix: &str,
        of: &Polynomial,
        den: &[usize],
        reason: &Reason,
    ) -> Option<String> {
        if prefix.is_empty()
            && let Reason::Fact(i) = reason
            && self.state.assumed.contains(&(None, *i))
        {
            return None;
        }
        let (certificate, first) = (self.certificate(reason), self.goal.atoms.len());
        let signs = (self.state.certify(of, &certificate), self.state.facts.sign_of_product(den));
        let (Ok(sign), Ok(den_sign)) = signs else { return None };
        let is_one = certificate.left == Polynomial::constant(1);
        let is_fact = is_one && is_variable(&certificate.right, first);
        let (sign, mut by) = (sign_text(sign.times(den_sign)), Vec::new());
        self.reasons(&certificate, &mut by);
        if is_fact && prefix.is_empty() && den.is_empty() && !by.is_empty() {
            return by.pop();
        }
        let written = self.goal.form(of, &[]);
        let mut forms = self.forms(&certificate);
        let line = match forms.right.take_if(|_| is_one) {
            Some(right) => {
                let written = match reason {
                    Reason::Fact(i) => self.fact(*i),
                    Reason::Certificate(_) if is_fact => self.goal.short(of),
                    Reason::Certificate(_) => written.filter(|written| *written != right),
                };
                let value = match written.filter(|_| den.is_empty()).map(|of| self.goal.text(&of)) {
                    Some(written) if is_fact => written,
                    Some(written) => format!("{written} = {}", self.goal.filled(&right, &forms.sums)),
                    None => self.formula_over(right, forms.sums, den),
                };
                format!("{value} {sign}")
            }
            None if is_fact => format!("{} {sign}", self.format_quotient(of, den)),
            None => {
                let multiple = self.multiple(&certificate, &forms, !den.is_empty());
                format!("{} {sign}: {multiple}", self.format_quotient(of, den))
            }
        };
        by.retain(|reason| *reason != line);
        let by = if by.is_empty() { String::new() } else { format!(", by {}", by.join(", ")) };
        Some(format!("{prefix}{line}{by}"))
    }

    /// Returns the certificate of a reason; that of a fact states that it is the fact.
    fn certificate(&self, reason: &Reason) -> Certificate {
        match reason {
            Reason::Certificate(certificate) => certificate.clone(),
            Reason::Fact(i) => {
                let right = Polynomial::variable(self.goal.atoms.len()).unwrap_or_default();
                Certificate { known: vec![Known::Fact(*i)], left: Polynomial::constant(1), right }
            }
        }
    }

    /// Returns the forms of a certificate.
    fn forms(&self, certificate: &Certificate) -> Forms {
        let Certificate { known, left, right } = certificate;
        let mut sums = Vec::new();
        let quantities: Option<Vec<_>> =
            known.iter().map(|known| Some(self.goal.factor(&self.known(known)?, &mut sums))).collect();
        let left = quantities.as_ref().and_then(|known| self.goal.form(left, known));
        let right = quantities.and_then(|known| self.goal.form(right, &known));
        Forms { left, right, sums }
    }

    /// Formats the identity of a certificate: `c times it is …`.
    fn multiple(&self, certificate: &Certificate, forms: &Forms, is_quotient: bool) -> String {
        let left = &certificate.left;
        let it = if is_quotient { "the numerator" } else { "it" };
        let factor = forms.left.as_ref().filter(|_| left.terms().len() <= SHOWN_OF_CASE);
        let times = match factor.map(|form| self.goal.filled(form, &forms.sums)) {
            _ if *left == Polynomial::constant(1) => String::new(),
            Some(sum) if left.terms().len() > 1 => format!("({sum}) times {it} is "),
            Some(left) => format!("{left} times {it} is "),
            None => format!("a multiple of {it} is "),
        };
        let right = forms.right.as_ref().map(|form| self.goal.filled(form, &forms.sums));
        times + &right.unwrap_or_else(|| size(&certificate.right, "product"))
    }

    /// Returns a quantity of a certificate as a formula, if it is short.
    fn known(&self, known: &Known) -> Option<Tree> {
        match known {
            Known::Fact(i) => self.fact(*i),
            Known::Value(of) => self.goal.short(of),
            Known::Lemma(lemma) => self.goal.short(&lemma.0),
            Known::Exponents { left, right } => Some(self.exponentials(left) - self.exponentials(right)),
        }
    }

    fn exponentials(&self, all: &[usize]) -> Tree {
        all.iter().fold(Tree::from(1), |product, x| product * &self.goal.atoms[*x])
    }

    /// Adds the facts and bounds on which a certificate rests, except the signs of symbols.
    fn reasons(&self, certificate: &Certificate, all: &mut Vec<String>) {
        let Certificate { known, left, right } = certificate;
        let table = &self.goal.problem.table;
        let facts = known.iter().filter_map(|known| match known {
            Known::Fact(i) => self.name_of_fact(*i),
            Known::Exponents { left, right } => {
                Some([left, right].map(|all| self.goal.text(&self.exponentials(all))).join(" = "))
            }
            Known::Value(_) | Known::Lemma(_) => None,
        });
        let units = table.atoms().iter().enumerate().filter(|(x, _)| table.is_unit(*x));
        let units = units.filter(|(x, _)| left.degree(*x).max(right.degree(*x)) > 0);
        let bounds = units
            .map(|(_, atom)| format!("|{}ᵢ| ≤ 1", if matches!(atom, Atom::Error(_)) { 'e' } else { 't' }));
        for reason in facts.chain(bounds) {
            if !all.contains(&reason) {
                all.push(reason);
            }
        }
        for known in known {
            if let Known::Lemma(lemma) = known {
                self.reasons(&lemma.1, all);
            }
        }
    }

    /// Returns the hypothesis that is a fact, or the equation of an absolute value; not the sign of a symbol.
    fn name_of_fact(&self, i: usize) -> Option<String> {
        let problem = self.goal.problem;
        if let Some(known) = self.state.sizes.iter().find(|known| known.fact == i)
            && let Some(Atom::Size(of)) = problem.table.atoms().get(known.size)
        {
            return self.equation_of_size(*of).map(|(equation, _)| equation);
        }
        let (hypothesis, _) = self.state.assumed.iter().find(|(_, fact)| *fact == i)?;
        let (of, sign) = self.state.facts.get(i).ok()?;
        let is_named = of.as_variable().is_none() || *sign == Sign::Zero;
        let hypothesis = problem.hypotheses[hypothesis.filter(|_| is_named)?];
        Some(self.goal.printer.registry.format_hypothesis(hypothesis))
    }

    /// Returns the equation x = t |x| of the formula with a number, and the factor t.
    pub(super) fn equation_of_size(&self, of: usize) -> Option<(String, &Tree)> {
        let factor = &self.goal.atoms[self.goal.problem.table.variable(Atom::Factor(of)).ok()?];
        let of = self.goal.formula(of);
        Some((format!("{of} = {factor} |{of}|"), factor))
    }
}

/// Formats the size of a polynomial.
pub(super) fn size(of: &Polynomial, what: &str) -> String {
    match of.terms().len() {
        1 => format!("a {what}"),
        n => format!("a sum of {n} {what}s"),
    }
}

/// Returns a symbol, which occurs in no statement, for a sum.
pub(super) fn placeholder(sum: String, sums: &mut Vec<String>) -> Tree {
    let i = sums.iter().position(|known| *known == sum).unwrap_or(sums.len());
    if i == sums.len() {
        sums.push(sum);
    }
    Tree::symbol(subscripted(PLACE, u8::try_from(i).unwrap_or(u8::MAX)))
}

/// Returns `true` for a variable from a number on, and for minus one.
fn is_variable(of: &Polynomial, first: usize) -> bool {
    let variable = of.as_variable();
    variable.or_else(|| of.negated().ok()?.as_variable()) >= Some(first)
}

/// Returns a polynomial divided by a number or a variable, if its terms are multiples of that.
fn divided(of: &Polynomial, by: &Polynomial) -> Option<Polynomial> {
    let [(divisor, n)] = by.terms().collect::<Vec<_>>()[..] else { return None };
    let quotient = of.terms().map(|(powers, number)| {
        let mut powers = *powers;
        for (power, less) in powers.iter_mut().zip(divisor) {
            *power = power.checked_sub(*less)?;
        }
        (number.checked_rem(*n)? == 0).then_some((powers, number / n))
    });
    Polynomial::new(quotient.collect::<Option<_>>()?).ok()
}

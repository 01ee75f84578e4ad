//! Proofs written out, for a reader with paper.

mod algebra;

use self::algebra::Order;
use super::kernel::sign::{Certificate, Rule, Sign};
use super::kernel::{Because, Derivation, Direct, Proof, Rounding, Signed, Supposed, Used, Why};
use crate::formula::claim::{MEMBERS, PRECISION};
use crate::formula::statement::{Goal, Says, Sequence, Statement};
use crate::formula::{Formula, Hypothesis, Notation, Registry};
use crate::number::tree::Step;
use crate::number::{PositivePart, Tree};

/// Writes claims and proofs in the names that a registry has for quantities.
#[derive(Clone, Copy, Debug)]
pub struct Paper<'a> {
    registry: &'a Registry,
}

impl<'a> Paper<'a> {
    /// With the names of this registry.
    pub fn new(registry: &'a Registry) -> Self {
        Paper { registry }
    }

    /// What a claim says, in one line.
    pub fn claim(&self, statement: &Statement) -> String {
        if let Some(Sequence { start, step, ratio, member, limit, within }) = &statement.amounts_to {
            let together =
                |trees: &[Tree]| trees.iter().map(|tree| self.text(tree)).collect::<Vec<_>>().join(", ");
            let (ratio, member) = (self.text(ratio), together(member));
            return match limit {
                None if !within.is_empty() => {
                    let bound =
                        |(of, bound): &(Tree, Tree)| self.says(&Says::Within(of.clone(), bound.clone()));
                    let bounds: Vec<_> = within.iter().map(bound).collect();
                    let (from, to) = (together(start), together(step));
                    let x = MEMBERS[0];
                    format!(
                        "k steps from {from}, each of {x} to {to}, lead to {x} with {}, where q = {ratio}ᵏ",
                        bounds.join(" and ")
                    )
                }
                Some(limit) => format!("{member} → {} for q = {ratio}ᵏ and k → ∞", self.text(limit)),
                None => {
                    let (from, to, members) = (together(start), together(step), &MEMBERS[..step.len()]);
                    let members = members.join(", ");
                    format!(
                        "k steps from {from}, each of {members} to {to}, lead to {member}, where q = {ratio}ᵏ"
                    )
                }
            };
        }
        let goals = statement.goals.iter().map(|goal| self.says(&goal.says));
        goals.collect::<Vec<_>>().join("; ")
    }

    /// What a goal says.
    fn says(&self, says: &Says) -> String {
        match says {
            Says::Equal(left, right) => format!("{} = {}", self.text(left), self.text(right)),
            Says::Sign(relation, of) => format!("{} {relation} 0", self.text(of)),
            Says::Within(of, bound) => format!("{} ≤ {}", self.text(&of.abs()), self.text(bound)),
            Says::Derivative(of, by, is) => format!("∂/∂{} [{}] = {}", by, self.text(of), self.text(is)),
            Says::Limit(of, by, to) => format!("lim [{}] = {} for {} → ∞", self.text(of), self.text(to), by),
        }
    }

    /// The hypotheses that some goal's proof uses, as a reader writes them.
    pub fn used(&self, proof: &Proof) -> Vec<String> {
        fn collect(derivation: &Derivation, all: &mut Vec<Hypothesis>) {
            match derivation {
                Derivation::Cases(_, positive, not) => {
                    collect(positive, all);
                    collect(not, all);
                }
                Derivation::Direct(direct) => {
                    for supposed in direct.supposed() {
                        if let Some(given) = supposed.given()
                            && !matches!(supposed.used(), Used::Unused | Used::Follows)
                            && !all.contains(given)
                        {
                            all.push(given.clone());
                        }
                    }
                }
            }
        }
        let mut all = Vec::new();
        proof.goals().iter().for_each(|derivation| collect(derivation, &mut all));
        self.registry.all_supposed(&all)
    }

    /// What the names in a claim stand for, those that occur: `R = m g − c (H − l)`.
    pub fn names(&self, statement: &Statement) -> Vec<String> {
        let mut called: Vec<&'a Formula> = Vec::new();
        fn collect<'a>(registry: &'a Registry, tree: &Tree, called: &mut Vec<&'a Formula>) {
            if let Some(call) = registry.call(tree).filter(|call| call.formula.folded) {
                if called.iter().all(|formula| formula.name() != call.formula.name()) {
                    called.push(call.formula);
                }
                call.arguments.iter().for_each(|argument| collect(registry, argument, called));
            } else {
                tree.step().operands().for_each(|operand| collect(registry, operand, called));
            }
        }
        statement.trees().for_each(|tree| collect(self.registry, tree, &mut called));
        // What a name stands for may be said by further names.
        let mut i = 0;
        while let Some(formula) = called.get(i).copied() {
            formula.tree.step().operands().for_each(|operand| collect(self.registry, operand, &mut called));
            i += 1;
        }
        called
            .iter()
            .map(|f| format!("{} = {}", f.symbol, self.registry.typeset(f, Notation::Text)))
            .collect()
    }

    /// Why there is no proof.
    pub fn why(&self, why: &Why) -> String {
        self.order().why(why)
    }

    /// The whole proof, line by line.
    pub fn proof(&self, proof: &Proof) -> Vec<String> {
        let statement = proof.statement();
        let mut lines = Vec::new();
        lines.extend(statement.amounts_to.as_ref().map(|sequence| {
            let by = match sequence.limit {
                None => "by induction on k, with q = ρᵏ: for q = 1, and from q to ρ q",
                Some(_) => {
                    "if |ρ| < 1 then ρᵏ → 0, and what is continuous in q at 0 tends to what it is there"
                }
            };
            by.to_string()
        }));
        let single = statement.goals.len() == 1;
        for (Goal { part, says: goal, .. }, derivation) in statement.goals.iter().zip(proof.goals()) {
            if single {
                self.derivation(derivation, 0, &mut lines);
            } else {
                lines.push(format!("{part}: {}", self.says(goal)));
                self.derivation(derivation, 1, &mut lines);
            }
        }
        lines
    }

    fn derivation(&self, derivation: &Derivation, depth: usize, lines: &mut Vec<String>) {
        if let Some(law) = self.law(derivation) {
            lines.extend(law.into_iter().map(|line| format!("{}{line}", "  ".repeat(depth))));
            return;
        }
        let say = |text: String, lines: &mut Vec<String>| lines.push(format!("{}{text}", "  ".repeat(depth)));
        match derivation {
            Derivation::Cases(on, positive, not) => {
                let on = self.order().poly_or_size(on);
                say(format!("case {on} > 0:"), lines);
                self.derivation(positive, depth + 1, lines);
                say(format!("case {on} ≤ 0:"), lines);
                self.derivation(not, depth + 1, lines);
            }
            Derivation::Direct(direct) => self.direct(direct).into_iter().for_each(|line| say(line, lines)),
        }
    }

    fn direct(&self, direct: &Direct) -> Vec<String> {
        let mut lines: Vec<String> = direct.supposed().iter().filter_map(|s| self.supposed(s)).collect();
        lines.extend(self.errors(direct));
        for (divisor, nonzero) in direct.divisors() {
            explain(format!("{} ≠ 0", self.text(divisor)), self.signed(nonzero), &mut lines);
        }
        for (bracket, value, decides) in direct.brackets() {
            let decisive = match bracket.step() {
                Step::Min(..) => "the second less the first",
                _ => "its argument",
            };
            explain(
                format!("{} = {} by the sign of {decisive}", self.text(bracket), self.text(value)),
                self.signed(decides),
                &mut lines,
            );
        }
        match direct.because() {
            Because::Same(value) => {
                lines.push(format!("both sides are {}", self.order().ratio_or_size(value)))
            }
            Because::Sign(sign) => lines.extend(self.signed(sign)),
            Because::Order(signs) => {
                lines.push("rounding keeps order, and so does each step, since".to_string());
                lines.extend(signs.iter().flat_map(|signed| self.signed(signed)));
            }
            Because::Within(sides) => lines.extend(self.within(sides)),
            Because::Derivative(value) => lines.push(format!(
                "dual numbers differentiate it to {}, which is the right side",
                self.order().ratio(value)
            )),
            Because::Limit { of, by, degrees: (n, d), leading, to } => {
                lines.push(format!("it is {}", self.order().ratio(of)));
                lines.push(format!(
                    "degrees {n} above and {d} below in {}, hence the limit is {}, since below",
                    by.0,
                    self.order().ratio(to)
                ));
                lines.extend(self.order().certificate(leading).into_iter().map(|line| format!("  {line}")));
            }
        }
        lines
    }

    /// What is rounded, with the names of its errors.
    fn errors(&self, direct: &Direct) -> Option<String> {
        let own = |own: &Rounding| format!("{} of fl({})", own.error().0, self.text(own.of()));
        let errors: Vec<_> = direct.errors().iter().map(own).collect();
        let model = format!("fl(x) = x (1 + γ e) with |e| ≤ 1, γ = 1 / ({PRECISION} + 1): ");
        (!errors.is_empty()).then(|| model + &errors.join(", "))
    }

    /// A bound of what is rounded: what all of its cases have in common is said once, and what is long by its
    /// length.
    fn law(&self, derivation: &Derivation) -> Option<Vec<String>> {
        fn leaves<'d>(
            derivation: &'d Derivation,
            path: Vec<String>,
            order: Order,
            all: &mut Vec<(String, &'d Direct)>,
        ) {
            match derivation {
                Derivation::Direct(direct) => all.push((path.join(", "), direct)),
                Derivation::Cases(on, positive, not) => {
                    for (branch, sign) in [(positive, "> 0"), (not, "≤ 0")] {
                        let case = format!("{} {sign}", order.poly_or_size(on));
                        leaves(branch, [path.clone(), vec![case]].concat(), order, all);
                    }
                }
            }
        }
        let mut all = Vec::new();
        leaves(derivation, Vec::new(), self.order(), &mut all);
        let (_, first) = all.first().filter(|(_, direct)| !direct.errors().is_empty())?;
        let mut lines: Vec<_> = self.errors(first).into_iter().collect();
        let given = first.supposed().iter().filter(|supposed| supposed.given().is_some());
        lines.extend(given.filter_map(|supposed| self.supposed(supposed)));
        for (case, direct) in all {
            let Because::Within(sides) = direct.because() else { return None };
            let within = self.within(sides);
            if case.is_empty() {
                lines.extend(within);
            } else {
                lines.push(format!("where {case}:"));
                lines.extend(within.into_iter().map(|line| format!("  {line}")));
            }
        }
        Some(lines)
    }

    /// What a bound exceeds a size by, on either side.
    fn within(&self, [above, below]: &[Signed; 2]) -> [String; 2] {
        [("less it", above), ("and it", below)].map(|(what, signed)| {
            let value = self.order().ratio_or_size(signed.value());
            let how = match [signed.num(), signed.den()].map(ends).iter().max() {
                Some(0) | None => "term by term".to_string(),
                Some(1) => "with the sizes of errors".to_string(),
                Some(ends) => format!("with the sizes of errors, at {ends} ends"),
            };
            format!("the bound {what} is {value} ≥ 0, {how}")
        })
    }

    /// How a supposition is used, if that has to be said.
    fn supposed(&self, supposed: &Supposed) -> Option<String> {
        let name = supposed.given().map_or("the case".to_string(), |given| self.registry.supposed(given));
        match supposed.used() {
            Used::Symbol(_) => None,
            Used::Follows => Some(format!("{name} follows")),
            Used::Unused => Some(format!("{name} is not used")),
            Used::Between(x, by, place) => Some(format!(
                "by {name}: {} = {}, where −1 ≤ {} ≤ 1",
                x.0,
                self.order().ratio_or_size(by),
                place.0
            )),
            Used::Pivot(pivot, by, slack) => {
                let solved = format!("{} = {}", self.order().monomial(pivot), self.order().ratio_or_size(by));
                Some(match slack {
                    None => format!("by {name}: {solved}"),
                    Some(slack) => {
                        let (value, slack) = (self.order().ratio_or_size(supposed.value()), slack.0);
                        let sign = if supposed.sign() == Sign::Positive { "> 0" } else { "≥ 0" };
                        format!("by {name}: {slack} = {value} {sign}, so {solved}")
                    }
                })
            }
        }
    }

    /// Why a quotient has its sign.
    fn signed(&self, signed: &Signed) -> Vec<String> {
        let mut lines = Vec::new();
        if !signed.value().den().is_one() {
            lines.push(format!("it is {}", self.order().ratio_or_size(signed.value())));
            lines.extend(self.order().certificate(signed.den()));
        }
        lines.extend(self.order().certificate(signed.num()));
        lines
    }

    fn order(&self) -> Order<'a> {
        Order(self.registry.factors())
    }

    fn text(&self, tree: &Tree) -> String {
        self.registry.text(tree)
    }
}

/// How a claim was proved, in a few words.
pub fn how(proof: &Proof) -> String {
    let cases = proof.goals().iter().map(cases).max().unwrap_or(1);
    let means = proof.goals().last().map_or("", |derivation| means(derivation));
    let kind = match proof.statement().kind {
        "equal" | "sign" => means,
        other => other,
    };
    let kind = if proof.statement().rounds() { format!("{kind}, any precision") } else { kind.to_string() };
    if cases > 1 { format!("{kind}, {cases} cases") } else { kind }
}

fn cases(derivation: &Derivation) -> usize {
    match derivation {
        Derivation::Cases(_, positive, not) => cases(positive) + cases(not),
        Derivation::Direct(_) => 1,
    }
}

fn means(derivation: &Derivation) -> &'static str {
    match derivation {
        Derivation::Cases(_, positive, _) => means(positive),
        Derivation::Direct(direct) => match direct.because() {
            Because::Same(_) => "identity",
            Because::Order(_) => "order",
            Because::Derivative(..) => "derivative",
            Because::Limit { .. } => "limit",
            Because::Within(_) => "bound",
            Because::Sign(signed) => match signed.num().rule() {
                Rule::Sizes(_) | Rule::Ends { .. } => "rounding",
                Rule::Terms => "sign by terms",
                Rule::Factor(_, rest) if matches!(rest.rule(), Rule::Slope { .. }) => "sign by slope",
                Rule::Factor(..) => "sign by factors",
                Rule::Square { .. } => "sign by square",
                Rule::Slope { .. } => "sign by slope",
            },
        },
    }
}

/// At how many ends of errors a sign is seen; 0 if there are no errors in it.
fn ends(certificate: &Certificate) -> usize {
    match certificate.rule() {
        Rule::Ends { at, .. } => at.iter().map(|end| ends(end).max(1)).sum(),
        Rule::Sizes(_) => 1,
        _ => 0,
    }
}

/// A fact and the reason for it, on one line if that is short.
fn explain(fact: String, reason: Vec<String>, lines: &mut Vec<String>) {
    if let [reason] = reason.as_slice() {
        lines.push(format!("{fact}: {reason}"));
    } else {
        lines.push(format!("{fact}:"));
        lines.extend(reason.into_iter().map(|line| format!("  {line}")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::claim::{equal, non_negative, positive};
    use crate::formula::{Claim, Relation};
    use crate::number::Exponential;
    use crate::proof::prove;

    #[test]
    fn in_a_few_words_it_is_said_how() {
        let [a, u] = ["a", "u"].map(|name| Tree::symbol(name));
        let given = Hypothesis::new(Relation::Positive, a.clone());
        let how = |claim: Claim| how(&prove(&Statement::of(&claim)).unwrap());
        let is_positive = |of: &Tree| how(positive("", [&given], of));
        assert_eq!(how(equal("", [], &u + &u, Tree::from(2) * &u)), "identity");
        assert_eq!(how(equal("", [], u.positive_part() - (-&u).positive_part(), &u)), "identity, 2 cases");
        let square = &u * &u - Tree::from(2) * &u + Tree::from(2);
        let tangent = a.exp() - &a - Tree::from(1);
        assert_eq!(is_positive(&(&a + &a)), "sign by terms");
        assert_eq!(is_positive(&square), "sign by square");
        let v = Tree::symbol("v");
        assert_eq!(how(non_negative("", [], &v * &v * square)), "sign by factors");
        assert_eq!(is_positive(&tangent), "sign by slope");
    }

    #[test]
    fn why_there_is_no_proof_is_said_in_the_names_of_the_registry() {
        let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
        let why = prove(&Statement::of(&equal("", [], &b + &a, &a))).unwrap_err();
        let registry = Registry::new(&["a", "b"], Vec::new());
        assert!(Paper::new(&registry).why(&why).contains("b"), "{}", Paper::new(&registry).why(&why));
        // It is an error like any other.
        let error: Box<dyn std::error::Error> = Box::new(why);
        assert!(error.to_string().contains("b"), "{error}");
    }
}

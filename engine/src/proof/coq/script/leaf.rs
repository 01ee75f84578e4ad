//! Leaves of proofs: what a leaf uses, in the order in which the checker reads it.

use super::super::lemma::{Result, spaced};
use super::super::print::simplified;
use super::solution::{Elimination, Solution};
use super::{End, Place, Script, refused};
use crate::formula::statement::Proposition;
use crate::number::tree::Op;
use crate::proof::check::Sign;
use crate::proof::check::{
    AbsoluteValue, Atom, Certificate, Known, Leaf, Polynomial, Powers, Problem, Reason, Rise, Same, State,
    parts_of_rise,
};
use crate::proof::trace::{Step, reread, trace};

/// The certificate that 0 is 0.
pub(super) const ZERO: &str = "(By (identity [] [[1]]%Z []))";

/// A leaf that is being written.
pub(super) struct Writer<'w, 'p> {
    place: &'w Place<'w>,
    state: &'w State<'p>,
    leaf: &'w Leaf,
    /// The names of the atoms in scope.
    names: Vec<String>,
    /// The facts in Coq.
    facts: Vec<(Polynomial, Option<Sign>)>,
    /// The number in Coq of each fact of the checker so far.
    numbers: Vec<Option<usize>>,
    /// The labels of assumptions, and the steps.
    given: Vec<String>,
    steps: Vec<String>,
    /// The atoms whose equations are used for rewriting, those of the innermost formulas first.
    equations: Vec<usize>,
    /// The symbols that were replaced by places in their intervals.
    replaced: Vec<usize>,
    /// The numbers of rises, orders and roundings so far.
    rises: usize,
    orders: usize,
    roundings: usize,
    /// The number of divisors of several factors whose signs are still to come, and the facts so far.
    factors: Option<(usize, Vec<usize>)>,
}

/// Returns a list in Coq.
fn list<W: AsRef<str>>(items: &[W], of: &str) -> String {
    let items: Vec<_> = items.iter().map(AsRef::as_ref).collect();
    if items.is_empty() { format!("(@nil {of})") } else { format!("[{}]", items.join("; ")) }
}

/// Returns labels as nested pairs.
fn pairs<W: AsRef<str>>(labels: &[W]) -> String {
    labels.iter().rev().fold("tt".to_string(), |rest, label| format!("({}, {rest})", label.as_ref()))
}

/// Returns a polynomial as a list of terms, with other numbers for its variables.
fn terms(of: &Polynomial, number: impl Fn(usize) -> usize) -> String {
    let term = |(powers, coefficient): &(Powers, i128)| {
        let mut variables: Vec<_> = powers.iter().enumerate().filter(|(_, n)| **n > 0).collect();
        variables.sort_by_key(|(x, _)| number(*x));
        let factors =
            variables.into_iter().flat_map(|(x, n)| vec![format!(";{}", number(x)); usize::from(*n)]);
        format!("[{coefficient}{}]", factors.collect::<String>())
    };
    let terms: Vec<_> = of.terms().map(term).collect();
    if terms.is_empty() { "[]".into() } else { format!("[{}]%Z", terms.join("; ")) }
}

impl<'w, 'p> Writer<'w, 'p> {
    pub(super) fn new(
        place: &'w Place<'w>,
        state: &'w State<'p>,
        leaf: &'w Leaf,
        is_known: impl Fn(usize) -> bool,
    ) -> Self {
        let atoms = 0..place.problem.table.atoms().len();
        // A number that does not occur stands for what is not in scope.
        let names = atoms.map(|x| if is_known(x) { place.name(x) } else { "PI".into() }).collect();
        let (given, steps, equations, replaced) = Default::default();
        let facts = vec![(Polynomial::constant(2), Some(Sign::Positive))];
        let (rises, orders, roundings, factors, numbers) = (0, 0, 0, None, vec![Some(0)]);
        let mut writer = Writer {
            place,
            state,
            leaf,
            names,
            facts,
            numbers,
            given,
            steps,
            equations,
            replaced,
            rises,
            orders,
            roundings,
            factors,
        };
        for (x, label, sign) in place.known_atoms().filter(|(x, ..)| is_known(*x)) {
            if let Ok(own) = Polynomial::variable(x) {
                writer.suppose(label, own, sign);
            }
        }
        writer
    }

    /// Adds a fact with a label.
    pub(super) fn suppose(&mut self, label: String, of: Polynomial, sign: Option<Sign>) {
        self.given.push(label);
        self.add("Next".into(), of, sign);
    }

    /// Adds a step with its fact.
    fn add(&mut self, step: String, of: Polynomial, sign: Option<Sign>) -> usize {
        self.steps.push(step);
        self.facts.push((of, sign));
        self.facts.len() - 1
    }

    /// Returns `rewrite` with the equations so far, of the outermost formulas first. They are used again for
    /// the bounds of intervals, which replace symbols.
    fn rewriting(&self) -> String {
        let (places, others) = self.equations.split_at(self.replaced.len());
        let again = if places.is_empty() { &[] } else { others };
        let all = others.iter().rev().chain(places.iter().rev()).chain(again.iter().rev());
        let all: Vec<_> = all.map(|x| format!("?F{x}")).collect();
        if all.is_empty() { String::new() } else { format!("rewrite {}", all.join(", ")) }
    }

    /// Returns the call of a tactic with what is known, after rewriting the goal.
    pub(super) fn call(&self, tactic: &str, reasons: &[&str]) -> String {
        let rewriting = self.rewriting();
        let end = if rewriting.is_empty() { "" } else { "; " };
        let (names, given) = (list(&self.names, "R"), pairs(&self.given));
        let steps = list(&self.steps, "A_Quotients.step");
        format!("{rewriting}{end}{tactic} {names} {given} {steps}{}", spaced(reasons))
    }

    fn atom(&self, atom: Atom) -> Result<usize> {
        self.place.variable(atom)
    }

    /// Adds the facts before that with a number.
    pub(super) fn catch_up(&mut self, script: &mut Script, facts: usize) -> Result<()> {
        while self.numbers.len() < facts {
            let i = self.numbers.len();
            let (of, sign) = self.state.facts.get(i).map_err(refused)?.clone();
            let label = self.label(script, i, &of)?;
            self.numbers.push(label.is_some().then_some(self.facts.len()));
            if let Some(label) = label {
                let rewriting = self.rewriting();
                if !rewriting.is_empty() && self.is_rewritten(i) {
                    script.line(&format!("{rewriting} in {label}."));
                }
                self.suppose(label, of, Some(sign));
            }
        }
        Ok(())
    }

    /// Returns `true` unless a fact is a case, or a hypothesis by the four operations on symbols.
    fn is_rewritten(&self, fact: usize) -> bool {
        let supposed = self.state.supposed.iter().find(|(_, own)| *own == fact);
        let Some((hypothesis, _)) = supposed else { return true };
        let hypothesis = hypothesis.and_then(|i| self.place.problem.hypotheses.get(i));
        hypothesis.is_some_and(|given| {
            given.value.any(&|part| match part.op() {
                Op::Exp(_) | Op::Min(..) | Op::Rounded(_) => true,
                Op::Symbol(name) => self.atom(Atom::Own(name)).is_ok_and(|x| self.replaced.contains(&x)),
                _ => false,
            })
        })
    }

    /// Returns the label of a fact that no certificate shows, if it is in scope.
    fn label(&mut self, script: &mut Script, i: usize, of: &Polynomial) -> Result<Option<String>> {
        let state = self.state;
        if let Some(place) = state.supposed.iter().position(|(_, fact)| *fact == i) {
            return Ok(match state.supposed[place].0 {
                // What is known of a symbol before it is replaced is not kept.
                Some(_) if !of.has_only(|x| !self.replaced.contains(&x)) => None,
                Some(hypothesis) => self.place.labels.get(hypothesis).cloned().flatten(),
                None => Some(format!("C{}", place + 1)),
            });
        }
        if let Some(known) = state.sizes.iter().find(|known| known.fact == i) {
            let factor = match self.place.problem.table.atoms().get(known.size) {
                Some(Atom::Size(of)) => self.atom(Atom::Factor(*of))?,
                _ => return Err("an absolute value of nothing".into()),
            };
            return Ok(Some(format!("F{factor}")));
        }
        let shown = self.call("shown", &["Known"]);
        let label = if self.rises < self.leaf.rises.len() {
            self.rises += 1;
            format!("X{}", self.rises)
        } else {
            let [a, b] = self.leaf.orders.get(self.orders).ok_or("a fact without a reason")?;
            self.orders += 1;
            let label = format!("Y{}", self.orders);
            script.line(&format!("pose proof (ordered _ _ _ _ _ _ P F{a} F{b}) as {label}."));
            label
        };
        script.line(&format!("lapply {label}; [clear {label}; intro {label} | {shown}]."));
        Ok(Some(label))
    }

    /// Leaves out a fact that a certificate shows.
    pub(super) fn skip(&mut self, script: &mut Script, fact: usize) -> Result<()> {
        self.catch_up(script, fact)?;
        self.numbers.push(None);
        Ok(())
    }

    /// Writes a step of the checker.
    pub(super) fn step(&mut self, script: &mut Script, step: &Step) -> Result<()> {
        match step {
            Step::Sign { of, reason, facts, .. } => {
                let fact = match reason {
                    Reason::Fact(i) => {
                        self.catch_up(script, i + 1)?;
                        *i
                    }
                    Reason::Certificate(certificate) => {
                        self.catch_up(script, *facts)?;
                        let sign = self.state.facts.get(*facts).map_err(refused)?.1;
                        let number = self.certified(script, of, certificate, sign)?;
                        self.numbers.push(Some(number));
                        *facts
                    }
                };
                self.factor(fact)?;
            }
            Step::Divisor(factors) => {
                self.factors = Some((factors.len(), Vec::new()));
                if factors.is_empty() {
                    self.factors = None;
                    self.divisor(&[])?;
                }
            }
            Step::Rounding(same) => {
                let of = self.state.rounded.get(self.roundings).ok_or("a rounding of nothing")?.of;
                self.roundings += 1;
                let x = self.atom(Atom::Error(of))?;
                if let Some(same) = same {
                    self.share(script, x, same)?;
                }
                self.equations.push(x);
            }
            Step::Size(of, value, size) => {
                let x = self.atom(Atom::Size(*of))?;
                match size {
                    AbsoluteValue::BySign => return Ok(()),
                    AbsoluteValue::Atom => {}
                    AbsoluteValue::Same(i) => {
                        let known = self.state.sizes.get(*i).ok_or("an absolute value of nothing")?;
                        let y = known.size;
                        if x != y {
                            let equal = self.state.facts.are_equal(value, &known.value).map_err(refused)?;
                            let side = if equal { "left" } else { "right" };
                            let shown = self.call("shown", &[ZERO]);
                            script.line(&format!(
                                "assert (G : s{x} = s{y}) by (apply (same_size _ _ _ _ F{x} F{y}); {side}; {shown})."
                            ));
                            script.line(&format!("rewrite G in F{x}. clear G."));
                        }
                    }
                }
                self.equations.push(x);
            }
        }
        Ok(())
    }

    /// Collects the factors of a divisor.
    fn factor(&mut self, fact: usize) -> Result<()> {
        let Some((count, mut factors)) = self.factors.take() else { return Ok(()) };
        factors.push(fact);
        if factors.len() < count {
            self.factors = Some((count, factors));
            return Ok(());
        }
        self.divisor(&factors)
    }

    /// Lists a divisor by its factors, and its square, which occurs in its derivative.
    pub(super) fn divisor(&mut self, factors: &[usize]) -> Result<()> {
        let mut all = Vec::new();
        for i in factors {
            let of = &self.state.facts.get(*i).map_err(refused)?.0;
            let is_of_it = |(known, sign): &(Polynomial, Option<Sign>)| {
                known == of && sign.is_some_and(|sign| sign.is_strict())
            };
            all.push(self.facts.iter().position(is_of_it).ok_or("a divisor without a sign")?.to_string());
        }
        let is_smooth = matches!(self.place.problem.proposition, Proposition::Derivative(..));
        let square = (is_smooth && !all.is_empty()).then(|| [&all[..], &all].concat());
        for factors in (all.len() != 1).then_some(all).into_iter().chain(square) {
            let step = format!("Divisor {}%nat", list(&factors, "nat"));
            if !self.steps.contains(&step) {
                self.steps.push(step);
            }
        }
        Ok(())
    }

    /// Gives a rounded formula the error of an earlier one.
    fn share(&mut self, script: &mut Script, x: usize, same: &Same) -> Result<()> {
        let earlier = self.state.rounded.get(same.rounding).ok_or("a rounding of nothing")?.of;
        let y = self.atom(Atom::Error(earlier))?;
        let [up, down] = [&same.up, &same.down].map(|of| self.place.polynomial(of).argument());
        let shown = self.call("shown", &[ZERO]);
        script.line(&format!("share F{x} F{y} {down} {up}; [{shown} | ]."));
        Ok(())
    }

    /// Adds what a certificate shows, and returns the number of the fact.
    fn certified(
        &mut self,
        script: &mut Script,
        of: &Polynomial,
        certificate: &Certificate,
        sign: Sign,
    ) -> Result<usize> {
        let certificate = self.certificate(script, of, certificate)?;
        let step = format!("Shown {} {certificate}", terms(of, |x| x));
        Ok(self.add(step, of.clone(), Some(sign)))
    }

    /// Returns a certificate for a polynomial as an argument, after adding the lemmas in it.
    fn certificate(
        &mut self,
        script: &mut Script,
        of: &Polynomial,
        certificate: &Certificate,
    ) -> Result<String> {
        let solution = Solution::find(of, certificate, self.state);
        let certificate = solution.as_ref().map_or(certificate, |solution| &solution.certificate);
        let Certificate { known, left, right } = certificate;
        let first = self.names.len();
        let occurs = |x: usize| left.degree(x) > 0 || right.degree(x) > 0;
        let (mut quantities, mut units) = (Vec::new(), Vec::new());
        for x in (0..first).filter(|x| occurs(*x)) {
            let own = Polynomial::variable(x).map_err(refused)?;
            if self.place.problem.table.is_unit(x) {
                let unit = self.facts.iter().position(|(of, sign)| sign.is_none() && *of == own);
                units.push((x, format!("Fact {}", unit.ok_or("an unknown error")?)));
                continue;
            }
            let sign = self.state.signs.get(x).copied().flatten();
            let fact = self.facts.iter().position(|(of, known)| {
                *of == own && known.is_some_and(|known| sign.is_none_or(|sign| known.implies(sign)))
            });
            let text = match (fact, sign) {
                (Some(fact), _) => format!("Fact {fact}"),
                _ => format!("Value {}", terms(&own, |x| x)),
            };
            quantities.push((x, text));
        }
        for (i, quantity) in known.iter().enumerate() {
            let text = match quantity {
                Known::Fact(i) => {
                    let number = self.numbers.get(*i).copied().flatten();
                    format!("Fact {}", number.ok_or("a fact that is not in scope")?)
                }
                Known::Value(of) => format!("Value {}", terms(of, |x| x)),
                Known::Lemma(lemma) => {
                    let sign = self.state.certify(&lemma.0, &lemma.1).map_err(refused)?;
                    format!("Fact {}", self.certified(script, &lemma.0, &lemma.1, sign)?)
                }
                Known::Exponents { left, right } => {
                    format!("Fact {}", self.exponents(script, left, right)?)
                }
            };
            quantities.push((first + i, text));
        }
        let is_zero = |text: &str| {
            let fact = text.strip_prefix("Fact ").and_then(|i| self.facts.get(i.parse::<usize>().ok()?));
            fact.is_some_and(|(_, sign)| *sign == Some(Sign::Zero))
        };
        quantities.sort_by_key(|(_, text)| !is_zero(text));
        quantities.extend(units);
        let place = |x: usize| quantities.iter().position(|(own, _)| *own == x).unwrap_or_default();
        let texts: Vec<_> = quantities.iter().map(|(_, text)| text.as_str()).collect();
        let [left, right] = [left, right].map(|form| terms(form, place));
        let texts = texts.join("; ");
        let Some(Solution { steps, .. }) = &solution else {
            return Ok(format!("(identity [{texts}] {left} {right})"));
        };
        let step = |step: &Elimination| match step {
            Elimination::Solve(x, i, n) => {
                let Some(Known::Fact(fact)) = known.get(*i) else { return String::new() };
                let fact = self.numbers.get(*fact).copied().flatten().unwrap_or_default();
                format!("Solve {x} {fact} {} {n}", first + i)
            }
            Elimination::Divide(x) => format!("Divide {x}"),
        };
        let steps: Vec<_> = steps.iter().map(step).collect();
        let places: Vec<_> = (0..first + known.len()).map(|x| place(x).to_string()).collect();
        let (steps, places) = (steps.join("; "), places.join(";"));
        Ok(format!("(solved [{texts}] {left} [{steps}] [{places}]%nat)"))
    }

    /// Adds that two products of exponentials are equal, and returns the number of the fact.
    fn exponents(&mut self, script: &mut Script, left: &[usize], right: &[usize]) -> Result<usize> {
        let product = |all: &[usize]| {
            all.iter()
                .try_fold(Polynomial::constant(1), |product, x| product.times(&Polynomial::variable(*x)?))
        };
        let (a, b) = (product(left).map_err(refused)?, product(right).map_err(refused)?);
        let of = a.plus_multiple(-1, &b).map_err(refused)?;
        let label = format!("Z{}", self.facts.len());
        let [left, right] =
            [left, right].map(|all| pairs(&all.iter().map(|x| format!("F{x}")).collect::<Vec<_>>()));
        let shown = self.call("shown", &[ZERO]);
        script.line(&format!("exponents {label} {left} {right}; [ | {shown}]."));
        self.suppose(label, of, Some(Sign::Zero));
        Ok(self.facts.len() - 1)
    }

    /// Returns the reason for the sign of a goal as an argument.
    pub(super) fn reason(&mut self, script: &mut Script, step: &Step) -> Result<String> {
        match step {
            Step::Sign { reason: Reason::Fact(_), .. } => Ok("Known".into()),
            Step::Sign { of, reason: Reason::Certificate(certificate), .. } => {
                Ok(format!("(By {})", self.certificate(script, of, certificate)?))
            }
            _ => Err("a goal without a sign".into()),
        }
    }

    /// Uses the equations for intervals and exponentials.
    pub(super) fn begin(&mut self) -> Result<()> {
        for i in &self.leaf.hypotheses {
            let interval = self.place.problem.hypotheses.get(*i).and_then(|given| given.interval());
            let Some((symbol, ..)) = interval else { continue };
            let symbol = self.atom(Atom::Own(symbol))?;
            if !self.replaced.contains(&symbol) {
                self.replaced.push(symbol);
                let place = self.atom(Atom::Place(*i))?;
                self.equations.push(place);
            }
        }
        for (x, atom) in self.place.problem.table.atoms().iter().enumerate() {
            let is_known = matches!(atom, Atom::Exponential(_)) && self.state.exponent(x).is_some();
            if is_known && self.names[x] != "PI" {
                self.equations.push(x);
            }
        }
        Ok(())
    }

    /// Replaces exponentials with the exponent 0, or that of another one.
    pub(super) fn share_exponentials(&mut self, script: &mut Script) -> Result<()> {
        let mut reader = reread(self.state.clone());
        for (x, atom) in self.place.problem.table.atoms().iter().enumerate() {
            let Atom::Exponential(of) = atom else { continue };
            if self.names[x] == "PI" || self.state.exponent(x).is_some() {
                continue;
            }
            let Ok(value) = reader.value(*of) else { continue };
            let mut known = self.state.exponents.iter();
            let same = known.find(|(_, own)| self.state.facts.are_equal(own, &value).unwrap_or(false));
            let rule = match same {
                _ if value.num.is_zero() => format!("no_exponent _ _ F{x}"),
                Some((y, _)) => format!("same_exponential _ _ _ _ F{x} F{y}"),
                None => continue,
            };
            let shown = self.call("shown", &[ZERO]);
            script.line(&format!("pose proof ({rule}) as G."));
            script.line(&format!("lapply G; [clear G F{x}; intro F{x} | {shown}]."));
            self.equations.insert(self.replaced.len(), x);
        }
        Ok(())
    }
}

impl Script {
    /// Proves the goal at a leaf.
    pub(super) fn leaf(&mut self, place: &Place, leaf: &Leaf, cases: &[(Polynomial, Sign)]) -> Result<()> {
        let (state, steps) = trace(place.problem, leaf, cases).map_err(refused)?;
        for (rise, i) in leaf.rises.iter().zip(1..) {
            self.rise(place, &state, rise, i)?;
        }
        if !leaf.rises.is_empty() {
            self.line("functions.");
        }
        let is_double = matches!(place.problem.proposition, Proposition::Within(..));
        let (steps, goals) = steps.split_at(steps.len().saturating_sub(1 + usize::from(is_double)));
        let mut writer = Writer::new(place, &state, leaf, |_| true);
        writer.begin()?;
        for step in steps {
            writer.step(self, step)?;
        }
        let Some(Step::Sign { facts, .. }) = goals.first() else { return Err("no goal".into()) };
        writer.catch_up(self, *facts)?;
        writer.share_exponentials(self)?;
        match (place.end, place.problem.proposition) {
            (End::Divisor, _) => self.line(&format!("{}.", writer.call("not_zero", &[]))),
            (End::Continuity, _) | (_, Proposition::Derivative(..)) => {
                let derived = writer.call("derived", &[]);
                self.line(&format!("auto_derive; cbv [Rdiv Rminus] in *; {derived}."));
            }
            (_, Proposition::Within(..)) => {
                let above = writer.reason(self, &goals[0])?;
                let below = match &goals[1] {
                    Step::Sign { reason: Reason::Fact(i), .. } if i == facts => above.clone(),
                    other => writer.reason(self, other)?,
                };
                self.line(&format!("{}.", writer.call("bounded", &[&above, &below])));
            }
            _ => {
                let reason = writer.reason(self, &goals[0])?;
                self.line(&format!("{}.", writer.call("shown", &[&reason])));
            }
        }
        Ok(())
    }

    /// Proves that a function has a sign if its argument has one: X1, X2, …
    fn rise(&mut self, place: &Place, state: &State, rise: &Rise, i: usize) -> Result<()> {
        let Some(Atom::Own(x)) = place.problem.table.atoms().get(rise.x) else {
            return Err("a function of no symbol".into());
        };
        let parts = parts_of_rise(place.problem, rise, x).map_err(refused)?;
        let Proposition::Derivative(of, _, slope) = &parts[0].0 else { return Err("no slope".into()) };
        let at_x = state.signs.get(rise.x).copied().flatten().ok_or("an argument without a sign")?;
        let (name, printer) = (place.name(rise.x), place.lemma.printer);
        let [of, slope] = [of, slope].map(|tree| format!("(fun {name} => {})", printer.expr(tree)));
        let signs: [Sign; 3] = [rise.start.into(), rise.slope.into(), at_x];
        let signs = spaced(signs.map(|sign| format!("A_Polynomials.{sign:?}")));
        self.line(&format!("unshelve epose proof (rise {of} {slope} {name}{signs} eq_refl _ _ _) as X{i};"));
        self.line("  cbn [A_Polynomials.of_kind A_Polynomials.plus A_Polynomials.product] in *.");
        for (proposition, assumed) in &parts {
            let all = place.problem.hypotheses.iter().copied().zip(&place.labels);
            let others = all.filter(|(given, _)| !given.value.symbols().contains(x));
            let (mut hypotheses, mut labels): (Vec<_>, Vec<_>) =
                others.map(|(given, label)| (given, label.clone())).unzip();
            let kept = labels.iter().flatten().filter(|label| *label != "M").cloned();
            let premises = if place.lemma.rounds { vec!["P".into(), "E".into()] } else { Vec::new() };
            let kept = spaced(kept.chain(premises));
            let minus = if kept.is_empty() { "" } else { " -" };
            hypotheses.extend(assumed);
            labels.extend(assumed.iter().map(|_| Some("K".to_string())));
            let proposition = proposition.map(&simplified);
            let part = Problem::new(&proposition, hypotheses).map_err(refused)?;
            self.block("{", |own| {
                own.line(&format!("clear{minus}{kept}."));
                if assumed.is_some() {
                    own.line(&format!("intros {name} K."));
                }
                own.problem(&Place::new(place.lemma, &part, labels))
            })?;
        }
        Ok(())
    }
}

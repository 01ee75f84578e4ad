//! The functions of the chapter as formulas: each one recorded once, with the names of its arguments, and
//! how a text writes them.
//!
//! A text for the eye has holes for formulas, to be [filled](fill): `«penalty::deflection»` becomes what the
//! function does, `«augmented::update: u=u_k, λ=λ_k»` the same with other names for its arguments, and
//! `«penalty::contact_force in full»` spells out also what has a name of its own, here p.

use crate::chapter::{
    SpringMass, augmented, beyond, contact, contact::Kkt, lagrange, ode, penalty, structure, system,
};
use crate::number::tree::{Name, Notation, Site, Step, latex};
use crate::number::{Exponential, PositivePart, Tree};
use std::collections::HashMap;
use std::sync::LazyLock;

/// A function of [`chapter`](crate::chapter), recorded.
#[derive(Clone, Debug)]
pub struct Formula {
    /// `module::name`.
    pub path: &'static str,
    /// Which of its values, if it has several.
    pub part: Option<&'static str>,
    /// What the chapter calls its value; a text may write this for a call of it if `folded`.
    pub symbol: &'static str,
    /// Is the symbol the quantity's own name, by which formulas speak of it?
    pub folded: bool,
    /// What its arguments are called, but for the system.
    pub arguments: &'static [&'static str],
    /// What it does.
    pub tree: Tree,
    /// How a text writes it, with `«»` for the tree; that is all of it unless it is formed by
    /// differentiating, or has any number of terms.
    pub written: &'static str,
}

/// A part of a formula that a function of the chapter computes.
#[derive(Clone, Debug)]
pub struct Call {
    /// The function.
    pub formula: &'static Formula,
    /// What its [arguments](Formula::depends_on) are.
    pub arguments: Vec<Tree>,
}

/// Every function of the chapter that has a formula; none comes before what it calls.
pub fn formulas() -> &'static [Formula] {
    &FORMULAS
}

/// The formula of a function, or of one of its values: `penalty::deflection`, `lagrange::residual.constraint`.
pub fn formula(path: &str) -> Option<&'static Formula> {
    formulas().iter().find(|formula| formula.name() == path)
}

impl Formula {
    /// Its path, with the part: `contact::kkt.primal`.
    pub fn name(&self) -> String {
        self.part.map_or(self.path.to_string(), |part| format!("{}.{part}", self.path))
    }

    /// Those of its arguments that its value depends on: a part of several may ignore some.
    pub fn depends_on(&self) -> impl Iterator<Item = &'static str> {
        let symbols = self.tree.symbols();
        self.arguments.iter().copied().filter(move |name| symbols.contains(name))
    }

    /// What it does, as a text writes it: by name what has one, and spelled out what has none.
    ///
    /// ```
    /// use spring_mass_contact::{claims::formula, number::tree::Notation};
    /// let energy = formula("augmented::functional").unwrap();
    /// assert_eq!(energy.typeset(Notation::Text), "Π + λ p + ε p² / 2");
    /// assert_eq!(energy.typeset(Notation::Latex), r"\Pi + \lambda\,p + \tfrac{1}{2}\,\varepsilon\,p^2");
    /// ```
    pub fn typeset(&self, notation: Notation) -> String {
        self.renamed(notation, &Names { own: Some(self), ..Names::default() })
    }

    fn renamed(&self, notation: Notation, names: &Names) -> String {
        let around = |text: &str| if notation == Notation::Latex { latex(text) } else { text.to_string() };
        let tree = self.tree.typeset(notation, &|tree| names.of(tree));
        self.written.split("«»").map(around).collect::<Vec<_>>().join(&tree)
    }

    /// The function that its last step calls, if it does nothing but call.
    pub fn delegates(&self) -> Option<Call> {
        call(&self.tree).filter(|call| call.formula.name() != self.name())
    }
}

/// The line that says what a function computes: `Π = c u² / 2 − m g u`.
///
/// Several values are two sides of an equation, or residuals: `c u − m g + λ = 0, p = 0`.
pub fn line(path: &str) -> Option<String> {
    let values: Vec<_> = formulas().iter().filter(|formula| formula.path == path).collect();
    let said = values.iter().map(|formula| {
        let text = formula.typeset(Notation::Text);
        match (formula.symbol, formula.part) {
            ("", None | Some("left" | "right")) => text,
            ("", Some(_)) => text + " = 0",
            (symbol, _) => format!("{symbol} = {text}"),
        }
    });
    let sides = values.iter().any(|formula| formula.part == Some("left"));
    let said: Vec<_> = said.collect();
    (!said.is_empty()).then(|| said.join(if sides { " = " } else { ", " }))
}

/// The text with its holes filled; one that names no formula stays a hole.
pub fn fill(template: &str, notation: Notation) -> String {
    let mut pieces = template.split('«');
    let mut text = pieces.next().unwrap_or_default().to_string();
    for piece in pieces {
        let filled = piece.split_once('»').and_then(|(hole, rest)| Some(formula_in(hole, notation)? + rest));
        text += &filled.unwrap_or_else(|| format!("«{piece}"));
    }
    text
}

/// What stands in a hole: `path`, `path in full`, `path: name=other, name=other`.
pub fn formula_in(hole: &str, notation: Notation) -> Option<String> {
    let (path, renamed) = hole.split_once(": ").unwrap_or((hole, ""));
    let (path, in_full) = path.strip_suffix(" in full").map_or((path, false), |path| (path, true));
    let own = formula(path)?;
    let renamed: Option<Vec<_>> =
        renamed.split(", ").filter(|pair| !pair.is_empty()).map(|pair| pair.split_once('=')).collect();
    let names = Names { own: Some(own), in_full, renamed: renamed? };
    let known = own.tree.symbols();
    names.renamed.iter().all(|(name, _)| known.contains(name)).then(|| own.renamed(notation, &names))
}

/// What a text calls a part of a formula: a call of a folded function by its symbol, with arguments where
/// they are not the usual ones. To be given to [`Tree::typeset`].
pub fn named(tree: &Tree) -> Option<Name> {
    Names::default().of(tree)
}

/// What the parts of a formula are called in it.
#[derive(Default)]
struct Names<'a> {
    /// The formula, which is not to be called by its own name.
    own: Option<&'a Formula>,
    in_full: bool,
    renamed: Vec<(&'a str, &'a str)>,
}

impl Names<'_> {
    fn of(&self, tree: &Tree) -> Option<Name> {
        if let Step::Symbol(name) = tree.step() {
            let (_, other) = self.renamed.iter().find(|(own, _)| own == name)?;
            return Some(Name { symbol: other.to_string(), arguments: Vec::new() });
        }
        let Call { formula, arguments } = call(tree).filter(|call| call.formula.folded && !self.in_full)?;
        if self.own.is_some_and(|own| own.name() == formula.name()) {
            return None;
        }
        let usual =
            |argument: &Tree, name: &str| argument.typeset(Notation::Text, &|tree| self.of(tree)) == name;
        let named: Vec<_> = arguments.into_iter().zip(formula.depends_on()).collect();
        let arguments = if named.iter().all(|(argument, name)| usual(argument, name)) {
            Vec::new()
        } else {
            // The penalty is a parameter, and not said as long as it is the usual one.
            let said = named.into_iter().filter(|(argument, name)| *name != "ε" || !usual(argument, name));
            said.map(|(argument, _)| argument).collect()
        };
        Some(Name { symbol: formula.symbol.to_string(), arguments })
    }
}

/// The function that computed this, if its last step is that of a function of the chapter.
///
/// It is known by its place in the source, so a formula that only looks the same is no call.
pub fn call(tree: &Tree) -> Option<Call> {
    calls(tree).next()
}

/// Every function that would have computed this: the one whose last step it is, and after it those that only
/// call it. A value that is handed on looks the same before and after, so which of them was called is not in
/// the record.
pub fn calls(tree: &Tree) -> impl Iterator<Item = Call> {
    let known = BY_SITE.get(&tree.site()).map_or(&[][..], Vec::as_slice);
    known.iter().filter_map(|&i| {
        let formula = &FORMULAS[i];
        let mut found = HashMap::new();
        matches(&formula.tree, tree, formula.arguments, &mut found).then_some(())?;
        let argument = |name: &'static str| found.get(name).map(|tree| (*tree).clone());
        let arguments = formula.depends_on().map(argument).collect::<Option<_>>()?;
        Some(Call { formula, arguments })
    })
}

/// Is the tree the pattern with its arguments replaced? Each occurrence by the same.
fn matches<'t>(
    pattern: &Tree,
    tree: &'t Tree,
    arguments: &[&'static str],
    found: &mut HashMap<&'static str, &'t Tree>,
) -> bool {
    if let Step::Symbol(name) = pattern.step()
        && arguments.contains(name)
    {
        return *found.entry(name).or_insert(tree) == tree;
    }
    let (own, other) = (pattern.step(), tree.step());
    let same = match (own, other) {
        (Step::Symbol(a), Step::Symbol(b)) => a == b,
        (Step::Int(a), Step::Int(b)) => a == b,
        _ => std::mem::discriminant(own) == std::mem::discriminant(other),
    };
    same && own.operands().zip(other.operands()).all(|(a, b)| matches(a, b, arguments, found))
}

static FORMULAS: LazyLock<Vec<Formula>> = LazyLock::new(record);

static BY_SITE: LazyLock<HashMap<Site, Vec<usize>>> = LazyLock::new(|| {
    let mut all: HashMap<Site, Vec<usize>> = HashMap::new();
    for (i, formula) in FORMULAS.iter().enumerate() {
        // A function that only hands on an argument, as a mistake may leave it, computes nothing to be known by.
        if !matches!(formula.tree.step(), Step::Symbol(_)) {
            all.entry(formula.tree.site()).or_default().push(i);
        }
    }
    all
});

macro_rules! argument {
    ($own:ident $symbol:ident system) => {
        &$own
    };
    ($own:ident $symbol:ident $name:literal) => {
        &$symbol($name)
    };
    ($own:ident $symbol:ident [$name:literal]) => {
        &[$symbol($name)]
    };
}

macro_rules! names {
    ([$($done:literal)*]) => { &[$($done),*] };
    ([$($done:literal)*] system $($rest:tt)*) => { names!([$($done)*] $($rest)*) };
    ([$($done:literal)*] [$name:literal] $($rest:tt)*) => { names!([$($done)* $name] $($rest)*) };
    ([$($done:literal)*] $name:literal $($rest:tt)*) => { names!([$($done)* $name] $($rest)*) };
}

macro_rules! list {
    ($($symbol:literal $(($folded:ident))? = $module:ident::$name:ident($($argument:tt),*)
       $(, $part:literal is |$pattern:pat_param| $value:expr)? $(, written $written:literal)?;)*) => {
        /// What each of the [`formulas`] computes in a number system, in their order: by the functions themselves, and
        /// not by their records.
        pub fn computed<T: PositivePart + Exponential>(symbol: &impl Fn(&'static str) -> T) -> Vec<T> {
            let own = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| symbol(name));
            vec![$({
                let value = $module::$name($(argument!(own symbol $argument)),*);
                $(let $pattern = value; let value = $value;)?
                value
            }),*]
        }

        fn record() -> Vec<Formula> {
            let mut trees = computed(&|name| Tree::symbol(name)).into_iter();
            let mut tree = || trees.next().expect("a value each");
            vec![$(Formula {
                path: concat!(stringify!($module), "::", stringify!($name)),
                part: None$(.or(Some($part)))?,
                symbol: $symbol,
                folded: !stringify!($($folded)?).is_empty(),
                arguments: names!([] $($argument)*),
                written: { let written = "«»"; $(let _ = written; let written = $written;)? written },
                tree: tree(),
            }),*]
        }
    };
}

// `(folded)` after a symbol: formulas may speak of the quantity by it. A value without a symbol is a
// residual, a side of an equation, or has no name in the chapter.
list! {
    "Δ" (folded) = system::gap(system);
    "W" = system::weight(system);
    "R" (folded) = system::reaction(system);

    "F" = structure::spring_force(system, "u");
    "r" = structure::residual(system, "u");
    "u" = structure::deflection(system);
    "δW" = structure::virtual_work(system, "u", "δu");
    "Π" (folded) = structure::potential_energy(system, "u");
    "δΠ" = structure::first_variation(system, "u", "δu"), written "δu ∂Π/∂u";
    "min Π" = structure::least_energy(system);

    "p" (folded) = contact::penetration(system, "u");
    "r" = contact::equilibrium(system, "u", "N");
    "" = contact::kkt(system, "u", "N"), "stationarity" is |Kkt { stationarity, .. }| stationarity;
    "" = contact::kkt(system, "u", "N"), "primal" is |Kkt { primal, .. }| primal;
    "" = contact::kkt(system, "u", "N"), "dual" is |Kkt { dual, .. }| dual;
    "" = contact::kkt(system, "u", "N"), "complementarity" is |Kkt { complementarity, .. }| complementarity;
    "N" = contact::contact_force(system);
    "u" = contact::deflection(system);

    "𝓛" (folded) = lagrange::functional(system, "u", "λ");
    "" = lagrange::residual(system, "u", "λ"), "equilibrium" is |[equilibrium, _]| equilibrium;
    "" = lagrange::residual(system, "u", "λ"), "constraint" is |[_, constraint]| constraint;
    "u" = lagrange::deflection(system);
    "λ" = lagrange::multiplier(system);

    "W" = penalty::functional("ε", "p");
    "Π_p" (folded) = penalty::energy(system, "ε", "u");
    "" = penalty::total_stiffness(system, "ε");
    "min Π_p" = penalty::least_energy(system, "ε");
    "W" = penalty::series("ε", ["ε₄"], "p"), written "«» + …";
    "W′" (folded) = penalty::series_force("ε", ["ε₄"], "p"), written "∂W/∂p";
    "r" = penalty::series_residual(system, "ε", ["ε₄"], "p");
    "r" = penalty::residual(system, "ε", "u");
    "N" = penalty::contact_force(system, "ε", "u");
    "u" = penalty::deflection(system, "ε");
    "u" = penalty::deflection_divided(system, "ε");
    "p" = penalty::penetration(system, "ε");
    "N" = penalty::force_at_root(system, "ε");
    "ε" = penalty::penalty_for(system, "tol");
    "u" = penalty::unilateral_deflection(system, "ε");

    "L" (folded) = augmented::functional(system, "ε", "λ", "u");
    "min L" = augmented::least_value(system, "ε", "λ");
    "∂L/∂u" = augmented::stationarity(system, "ε", "λ", "u");
    "λ′" = augmented::update(system, "ε", "λ", "u");
    "r" = augmented::equilibrium(system, "ε", "λ", "u");
    "u" = augmented::deflection(system, "ε", "λ");
    "N" = augmented::contact_force(system, "u");
    "ρ" (folded) = augmented::contraction(system, "ε");
    "λ_k" = augmented::multiplier_after(system, "λ₀", "ρᵏ");
    "p_k" = augmented::penetration_after(system, "ε", "λ₀", "ρᵏ");
    "u_k" = augmented::deflection_after(system, "ε", "λ₀", "ρᵏ");
    "" = augmented::harmonic_bound(system, "ε", "k");
    "" = augmented::recursion(system, "ε", "u_k", "u_{k+1}"), "left" is |(left, _)| left;
    "" = augmented::recursion(system, "ε", "u_k", "u_{k+1}"), "right" is |(_, right)| right;
    "L" = augmented::unilateral_functional(system, "ε", "λ", "u");
    "λ′" = augmented::unilateral_update(system, "ε", "λ", "u");
    "r" = augmented::unilateral_equilibrium(system, "ε", "λ", "u");
    "u" = augmented::unilateral_deflection(system, "ε", "λ");
    "r" = augmented::natural_residual(system, "ε", "λ", "u");

    "" = ode::difference_equation(system, "ε", "u_t", "u_{t+1}"), "left" is |(left, _)| left;
    "" = ode::difference_equation(system, "ε", "u_t", "u_{t+1}"), "right" is |(_, right)| right;
    "" = ode::operator(system, "ε", "u", "v");
    "" = ode::right_side(system, "ε");
    "u̇" = ode::velocity(system, "ε", "u");
    "u" = ode::superposition("u_h", "u_nh");
    "" = ode::characteristic(system, "ε", "rate");
    "rate" = ode::rate(system, "ε");
    "u_h" = ode::homogeneous(system, "ε", "A", "t");
    "u_nh" = ode::particular(system);
    "u" = ode::general(system, "ε", "A", "t");
    "A" = ode::constant(system, "u₀");
    "u" = ode::solution(system, "ε", "u₀", "t");

    "ε_eff" = beyond::effective_penalty(system, "growth");
    "λ′" = beyond::relaxed_update(system, "α", "λ", "u");
    "" = beyond::relaxed_contraction(system, "ε", "α");
    "d" = beyond::dual_functional(system, "λ");
    "" = beyond::aitken("λ₀", "λ₁", "λ₂");
    "W" = beyond::exact_penalty("ε", "p");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_call_is_known_by_its_place_and_not_by_its_looks() {
        let formula = |path: &str| formula(path).unwrap();
        // (1.11) writes l + u − H itself, (1.12) calls (1.5).
        let within = |path: &str, callee: &str| {
            formula(path).tree.any(&|t| call(t).is_some_and(|c| c.formula.path == callee))
        };
        assert!(within("penalty::contact_force", "contact::penetration"));
        assert!(!within("penalty::residual", "contact::penetration"));
        assert_eq!(formula("lagrange::multiplier").delegates().unwrap().formula.path, "system::reaction");
        assert!(formula("system::reaction").delegates().is_none());
    }

    #[test]
    fn arguments_are_found() {
        let own = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| Tree::symbol(name));
        let argument = system::gap(&own) * Tree::symbol("x");
        let call = call(&contact::penetration(&own, &argument)).unwrap();
        assert_eq!((call.formula.path, call.arguments), ("contact::penetration", vec![argument]));
    }

    #[test]
    fn arguments_that_a_value_ignores_are_none_of_a_call() {
        let own = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| Tree::symbol(name));
        let [u, n] = ["u", "n"].map(|name| Tree::symbol(name));
        let call = call(&contact::kkt(&own, &u, &n).dual).unwrap();
        assert_eq!((call.formula.name().as_str(), call.arguments), ("contact::kkt.dual", vec![n]));
    }

    #[test]
    fn a_value_that_is_handed_on_may_be_of_several_functions() {
        let own = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| Tree::symbol(name));
        let names = |tree: &Tree| calls(tree).map(|call| call.formula.name()).collect::<Vec<_>>();
        assert_eq!(names(&system::gap(&own)), ["system::gap", "lagrange::deflection"]);
        let [eps, u, t] = ["ε", "x", "t"].map(|name| Tree::symbol(name));
        // What begins with any constant A is no solution from an initial value.
        assert_eq!(names(&ode::general(&own, &eps, &u, &t)), ["ode::superposition", "ode::general"]);
        let all = ["ode::superposition", "ode::general", "ode::solution"];
        assert_eq!(names(&ode::solution(&own, &eps, &u, &t)), all);
    }

    #[test]
    fn what_has_a_name_goes_by_it_but_not_in_its_own_formula() {
        for (path, text, latex) in [
            ("system::gap", "H − l", "H - l"),
            ("lagrange::deflection", "Δ", r"\Delta"),
            (
                "penalty::least_energy",
                "Π(Δ) − R² / (2 (c + ε))",
                r"\Pi(\Delta) - \frac{R^2}{2 (c + \varepsilon)}",
            ),
            (
                "penalty::series",
                "ε p² / 2 + ε₄ p⁴ + …",
                r"\tfrac{1}{2}\,\varepsilon\,p^2 + \varepsilon_4\,p^4 + \cdots",
            ),
            ("penalty::series_residual", "c p + W′ − R", r"c\,p + W' - R"),
            ("structure::first_variation", "δu ∂Π/∂u", r"\delta u \partial\Pi/\partial u"),
            (
                "augmented::natural_residual",
                "max(p, −λ / ε)",
                r"\max\left(p, -\frac{\lambda}{\varepsilon}\right)",
            ),
        ] {
            let formula = formula(path).unwrap();
            assert_eq!([Notation::Text, Notation::Latex].map(|n| formula.typeset(n)), [text, latex]);
        }
    }

    #[test]
    fn arguments_are_said_where_they_are_not_the_usual_ones() {
        let own = SpringMass { c: "c", m: "m", g: "g", l: "l", h: "H" }.map(|name| Tree::symbol(name));
        let [u, eps, lambda] = ["u", "ε", "λ"].map(|name| Tree::symbol(name));
        let (gap, r) = (system::gap(&own), system::reaction(&own));
        for (tree, text) in [
            (contact::penetration(&own, &u), "p"),
            (contact::penetration(&own, &(&u + &gap)), "p(u + Δ)"),
            (lagrange::functional(&own, &u, &r), "𝓛(u, R)"),
            (augmented::functional(&own, &eps, &lambda, &u), "L"),
            (augmented::functional(&own, &eps, &r, &gap), "L(R, Δ)"),
            (augmented::contraction(&own, &(&eps + &r)), "ρ(ε + R)"),
        ] {
            assert_eq!(tree.typeset(Notation::Text, &named), text);
        }
    }

    #[test]
    fn lines_say_what_several_values_are() {
        assert_eq!(line("contact::kkt").unwrap(), "c u − m g + N = 0, ⟨p⟩ = 0, ⟨−N⟩ = 0, p N = 0");
        assert_eq!(line("augmented::recursion").unwrap(), "(c + ε) (u_{k+1} − u_k) = −ε (l − H) − ε u_k");
        assert_eq!(line("ode::operator").unwrap(), "(c + ε) v + ε u");
        assert_eq!(line("augmented::within_tolerance"), None);
    }

    #[test]
    fn holes_are_filled() {
        for (template, text, latex) in [
            ("no hole", "no hole", "no hole"),
            ("«system::gap» < 0", "H − l < 0", "H - l < 0"),
            (
                "«augmented::update: u=u_{k−1}, λ=λ₀»",
                "λ₀ + ε (l + u_{k−1} − H)",
                r"\lambda_0 + \varepsilon\,(l + u_{k-1} - H)",
            ),
            ("«penalty::contact_force: u=u_k»", "ε p(u_k)", r"\varepsilon\,p(u_k)"),
            ("«penalty::contact_force in full»", "ε (l + u − H)", r"\varepsilon\,(l + u - H)"),
            ("«lagrange::residual.constraint», «contact::kkt.dual»", "p, ⟨−N⟩", r"p, \langle -N \rangle"),
            // These name nothing.
            (
                "«system::gap: x=y» «system::gap",
                "«system::gap: x=y» «system::gap",
                "«system::gap: x=y» «system::gap",
            ),
            ("a » b «nothing» c", "a » b «nothing» c", "a » b «nothing» c"),
            ("«system::gap: H»", "«system::gap: H»", "«system::gap: H»"),
        ] {
            assert_eq!([Notation::Text, Notation::Latex].map(|n| fill(template, n)), [text, latex]);
        }
    }

    #[test]
    fn nothing_comes_before_what_it_calls() {
        for (i, formula) in formulas().iter().enumerate() {
            formula.tree.visit(&mut |tree| {
                if let Some(call) = call(tree) {
                    let place = formulas().iter().position(|f| f.name() == call.formula.name()).unwrap();
                    assert!(place <= i, "{} calls {}", formula.name(), call.formula.name());
                }
            });
        }
    }
}

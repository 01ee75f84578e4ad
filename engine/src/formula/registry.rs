//! Functions as formulas: each one recorded once, with the names of its arguments, and how a text writes
//! them.
//!
//! A text for the eye has holes for formulas, to be [filled](Registry::fill): `«lens::image»`
//! becomes what the function does, `«lens::focus: f=f₁, d=d₁»` the same with other names for its
//! arguments, and `«lens::power in full»` spells out also what has a name of its own.

use super::Hypothesis;
use super::claim::{POWER, PRECISION, SCALES};
use super::typeset::{Name, Notation, latex};
use crate::number::Tree;
use crate::number::tree::{Site, Step};
use std::collections::{BTreeSet, HashMap, HashSet};

/// A function, recorded.
#[derive(Clone, Debug)]
pub struct Formula {
    /// Its name in the source: `module::name`.
    pub path: &'static str,
    /// Which of its values, if it has several.
    pub part: Option<&'static str>,
    /// What its value is called; a text may write this for a call of it if `folded`.
    pub symbol: &'static str,
    /// Is the symbol the quantity's own name, by which formulas speak of it?
    pub folded: bool,
    /// What its arguments are called, but for what all functions of the registry have in common.
    pub arguments: Vec<&'static str>,
    /// What it does.
    pub tree: Tree,
    /// How a text writes it, with `«»` for the tree; that is all of it unless it is formed by
    /// differentiating, or has any number of terms.
    pub written: &'static str,
}

/// A part of a formula that a function of the registry computes.
#[derive(Clone, Debug)]
pub struct Call<'a> {
    /// The function.
    pub formula: &'a Formula,
    /// What its [arguments](Formula::depends_on) are.
    pub arguments: Vec<Tree>,
}

/// Functions that formulas are made of, by which they are known in each other.
///
/// ```
/// use provable::formula::{Formula, Notation, Registry};
/// use provable::number::{Field, Tree};
///
/// fn parallel<T: Field>(a: &T, b: &T) -> T {
///     a + b
/// }
///
/// let [a, b] = ["a", "b"].map(|name| Tree::symbol(name));
/// let whole = Formula::new("parallel", "k", &["a", "b"], parallel(&a, &b)).folded();
/// let registry = Registry::new(&["a", "b", "u"], vec![whole]);
/// let force = parallel(&a, &b) * Tree::symbol("u");
/// assert_eq!(force.typeset(Notation::Text, &|tree| registry.named(tree)), "k u");
/// assert_eq!(force.to_string(), "(a + b) u");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Registry {
    symbols: Vec<&'static str>,
    alike: Vec<[&'static str; 2]>,
    quiet: Vec<&'static str>,
    factors: Vec<&'static str>,
    formulas: Vec<Formula>,
    /// By the place of their last step.
    by_site: HashMap<Site, Vec<usize>>,
    /// All places where some function does something.
    sites: HashSet<Site>,
}

impl Registry {
    /// A registry of these functions, none of which comes before what it calls. The symbols are all
    /// quantities that are spoken of, in the order in which they are to be listed.
    ///
    /// # Panics
    /// Two functions have the same name; or what a text writes for a [folded](Formula::folded) one stands for
    /// something else as well: a quantity, another folded function, or what proofs and sequences call so.
    pub fn new(symbols: &[&'static str], formulas: Vec<Formula>) -> Self {
        let (mut names, mut taken) = (BTreeSet::new(), BTreeSet::new());
        for formula in &formulas {
            let (name, symbol) = (formula.name(), formula.symbol);
            assert!(names.insert(name.clone()), "two functions are called {name}");
            if formula.folded {
                assert!(!symbols.contains(&symbol), "{name} is written as {symbol}, which is a quantity");
                assert!(
                    !is_reserved(symbol),
                    "{name} is written as {symbol}, which is a name that proofs keep"
                );
                assert!(taken.insert(symbol), "{name} is written as {symbol}, and another function too");
            }
        }
        let mut by_site: HashMap<Site, Vec<usize>> = HashMap::new();
        let mut sites = HashSet::new();
        for (i, formula) in formulas.iter().enumerate() {
            // A function that only hands on an argument, as a mistake may leave it, computes nothing to be
            // known by.
            if !matches!(formula.tree.step(), Step::Symbol(_)) {
                by_site.entry(formula.tree.site()).or_default().push(i);
            }
            formula.tree.visit(&mut |tree| {
                sites.insert(tree.site());
            });
        }
        sites.retain(|site| !site.is_of_duals());
        Registry { symbols: symbols.to_vec(), formulas, by_site, sites, ..Registry::default() }
    }

    /// With pairs of symbols of the same unit, which a writer may mistake for each other.
    pub fn alike(self, alike: &[[&'static str; 2]]) -> Self {
        Registry { alike: alike.to_vec(), ..self }
    }

    /// With symbols that are parameters: where a name is said with its arguments, they are not said as long
    /// as all of them are themselves.
    pub fn quiet(self, quiet: &[&'static str]) -> Self {
        Registry { quiet: quiet.to_vec(), ..self }
    }

    /// With the order in which the factors of a product are written.
    pub fn with_factors(self, factors: &[&'static str]) -> Self {
        Registry { factors: factors.to_vec(), ..self }
    }

    /// The order in which the factors of a product are written; others come before them, by name.
    pub fn factors(&self) -> &[&'static str] {
        &self.factors
    }

    /// What else of the same unit could stand in place of a symbol by mistake.
    pub fn mistaken_for(&self, symbol: &str) -> impl Iterator<Item = &'static str> {
        let other = move |[a, b]: &[&'static str; 2]| match symbol {
            _ if *a == symbol => Some(*b),
            _ if *b == symbol => Some(*a),
            _ => None,
        };
        self.alike.iter().filter_map(other)
    }

    /// A registry that writes out the functions that are written like one of these quantities; `None` if
    /// there is none.
    pub(crate) fn without_names_of(&self, quantities: &BTreeSet<&str>) -> Option<Self> {
        let is_taken = |formula: &Formula| formula.folded && quantities.contains(formula.symbol);
        self.formulas.iter().any(is_taken).then(|| {
            let mut registry = self.clone();
            registry.formulas.iter_mut().for_each(|formula| formula.folded &= !is_taken(formula));
            registry
        })
    }

    /// Its functions.
    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// The formula of a function, or of one of its values: `lens::focus`, `lens::residual.image`.
    pub fn formula(&self, path: &str) -> Option<&Formula> {
        self.formulas.iter().find(|formula| formula.name() == path)
    }

    /// Does some function do something at this place of the source?
    pub fn has_site(&self, site: &Site) -> bool {
        self.sites.contains(site)
    }

    /// The symbols that formulas depend on, in the order of the registry; others follow.
    pub fn symbols_of<'t>(&self, trees: impl IntoIterator<Item = &'t Tree>) -> Vec<&'static str> {
        let mut found: BTreeSet<_> = trees.into_iter().flat_map(Tree::symbols).collect();
        let mut listed: Vec<_> = self.symbols.iter().copied().filter(|symbol| found.remove(symbol)).collect();
        listed.extend(found);
        listed
    }

    /// What a function depends on besides its own arguments: some of what all functions have in common.
    pub fn common<'a>(&'a self, formula: &'a Formula) -> impl Iterator<Item = &'static str> {
        let symbols = self.symbols_of([&formula.tree]).into_iter();
        symbols.filter(|symbol| !formula.arguments.contains(symbol))
    }

    /// What a function does, as a text writes it: by name what has one, and spelled out what has none.
    ///
    /// ```
    /// use provable::{formula::{Formula, Notation, Registry}, number::Tree};
    /// let [lambda, p] = ["λ", "p"].map(|name| Tree::symbol(name));
    /// let energy = &lambda * &p + &lambda * &p * &p / Tree::from(2);
    /// let registry = Registry::new(&["λ", "p"], vec![Formula::new("energy", "E", &["λ", "p"], energy)]);
    /// let energy = registry.formula("energy").unwrap();
    /// let [text, latex] = [Notation::Text, Notation::Latex].map(|n| registry.typeset(energy, n));
    /// assert_eq!(text, "λ p + λ p² / 2");
    /// assert_eq!(latex, r"\lambda\,p + \tfrac{1}{2}\,\lambda\,p^2");
    /// ```
    pub fn typeset(&self, formula: &Formula, notation: Notation) -> String {
        self.names(Some(formula)).typeset(formula, notation)
    }

    /// The function that the last step of another calls, if that does nothing but call.
    pub fn delegate(&self, formula: &Formula) -> Option<Call<'_>> {
        self.call(&formula.tree).filter(|call| call.formula.name() != formula.name())
    }

    /// The line that says what a function computes: `Π = c u² / 2 − m g u`.
    ///
    /// Several values are two sides of an equation, or residuals: `c u − m g + λ = 0, p = 0`.
    pub fn line(&self, path: &str) -> Option<String> {
        let values: Vec<_> = self.formulas.iter().filter(|formula| formula.path == path).collect();
        let said = values.iter().map(|formula| {
            let text = self.typeset(formula, Notation::Text);
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
    pub fn fill(&self, template: &str, notation: Notation) -> String {
        let mut pieces = template.split('«');
        let mut text = pieces.next().unwrap_or_default().to_string();
        for piece in pieces {
            let filled =
                piece.split_once('»').and_then(|(hole, rest)| Some(self.formula_in(hole, notation)? + rest));
            text += &filled.unwrap_or_else(|| format!("«{piece}"));
        }
        text
    }

    /// What stands in a hole: `path`, `path in full`, `path: name=other, name=other`.
    pub fn formula_in(&self, hole: &str, notation: Notation) -> Option<String> {
        let (path, renamed) = hole.split_once(": ").unwrap_or((hole, ""));
        let (path, in_full) = path.strip_suffix(" in full").map_or((path, false), |path| (path, true));
        let own = self.formula(path)?;
        let renamed: Option<Vec<_>> =
            renamed.split(", ").filter(|pair| !pair.is_empty()).map(|pair| pair.split_once('=')).collect();
        let names = Names { in_full, renamed: renamed?, ..self.names(Some(own)) };
        let known = own.tree.symbols();
        names.renamed.iter().all(|(name, _)| known.contains(name)).then(|| names.typeset(own, notation))
    }

    /// What a text calls a part of a formula: a call of a folded function by its symbol, with arguments where
    /// they are not the usual ones. To be given to [`Tree::typeset`].
    pub fn named(&self, tree: &Tree) -> Option<Name> {
        self.names(None).of(tree)
    }

    /// The names of the arguments that a text says with a function, if it says so many.
    pub(crate) fn said_of<'f>(
        &'f self,
        formula: &'f Formula,
        many: usize,
    ) -> impl Iterator<Item = &'static str> + 'f {
        let all = many == formula.depends_on().count();
        formula.depends_on().filter(move |name| many > 0 && (all || !self.quiet.contains(name)))
    }

    /// A formula as a text writes it.
    pub fn text(&self, tree: &Tree) -> String {
        tree.typeset(Notation::Text, &|tree| self.named(tree))
    }

    /// A hypothesis as a text writes it: `λ < R`.
    pub fn supposed(&self, hypothesis: &Hypothesis) -> String {
        hypothesis.typeset(&|tree| self.named(tree))
    }

    /// All of them.
    pub fn all_supposed(&self, hypotheses: &[Hypothesis]) -> Vec<String> {
        hypotheses.iter().map(|hypothesis| self.supposed(hypothesis)).collect()
    }

    fn names<'a>(&'a self, own: Option<&'a Formula>) -> Names<'a> {
        Names { registry: self, own, in_full: false, renamed: Vec::new() }
    }

    /// The function that computed this, if its last step is that of a function.
    ///
    /// It is known by its place in the source, so a formula that only looks the same is no call.
    pub fn call(&self, tree: &Tree) -> Option<Call<'_>> {
        self.calls(tree).next()
    }

    /// Every function that would have computed this: the one whose last step it is, and after it those that
    /// only call it. A value that is handed on looks the same before and after, so which of them was called
    /// is not in the record.
    pub fn calls(&self, tree: &Tree) -> impl Iterator<Item = Call<'_>> {
        let known = self.by_site.get(&tree.site()).map_or(&[][..], Vec::as_slice);
        known.iter().filter_map(|&i| {
            let formula = &self.formulas[i];
            let mut found = HashMap::new();
            matches(&formula.tree, tree, &formula.arguments, &mut found).then_some(())?;
            let argument = |name: &'static str| found.get(name).map(|tree| (*tree).clone());
            let arguments = formula.depends_on().map(argument).collect::<Option<_>>()?;
            Some(Call { formula, arguments })
        })
    }
}

/// A registry of formulas, whose quantities are their arguments.
impl FromIterator<Formula> for Registry {
    fn from_iter<I: IntoIterator<Item = Formula>>(formulas: I) -> Self {
        let formulas: Vec<_> = formulas.into_iter().collect();
        let mut quantities = Vec::new();
        for name in formulas.iter().flat_map(|formula| &formula.arguments) {
            if !quantities.contains(name) {
                quantities.push(*name);
            }
        }
        Registry::new(&quantities, formulas)
    }
}

impl Formula {
    /// A function of one value.
    pub fn new(path: &'static str, symbol: &'static str, arguments: &[&'static str], tree: Tree) -> Self {
        let arguments = arguments.to_vec();
        Formula { path, part: None, symbol, folded: false, arguments, tree, written: "«»" }
    }

    /// The same, and formulas speak of its value by its symbol.
    pub fn folded(self) -> Self {
        Formula { folded: true, ..self }
    }

    /// Its path, with the part: `lens::residual.image`.
    pub fn name(&self) -> String {
        self.part.map_or(self.path.to_string(), |part| format!("{}.{part}", self.path))
    }

    /// Those of its arguments that its value depends on: a part of several may ignore some.
    pub fn depends_on(&self) -> impl Iterator<Item = &'static str> {
        let symbols = self.tree.symbols();
        self.arguments.iter().copied().filter(move |name| symbols.contains(name))
    }
}

/// Is it what printed proofs call something: 2ᵖ, q, or e, s, t, x with a number?
fn is_reserved(symbol: &str) -> bool {
    let numbered = symbol
        .strip_prefix(['e', 's', 't', 'x'])
        .is_some_and(|number| !number.is_empty() && number.chars().all(|c| ('₀'..='₉').contains(&c)));
    numbered || [PRECISION, POWER, "fl", "nearest"].contains(&symbol) || SCALES.contains(&symbol)
}

/// What the parts of a formula are called in it.
struct Names<'a> {
    registry: &'a Registry,
    /// The formula, which is not to be called by its own name.
    own: Option<&'a Formula>,
    in_full: bool,
    renamed: Vec<(&'a str, &'a str)>,
}

impl Names<'_> {
    fn typeset(&self, formula: &Formula, notation: Notation) -> String {
        let around = |text: &str| if notation == Notation::Latex { latex(text) } else { text.to_string() };
        let tree = formula.tree.typeset(notation, &|tree| self.of(tree));
        formula.written.split("«»").map(around).collect::<Vec<_>>().join(&tree)
    }

    fn of(&self, tree: &Tree) -> Option<Name> {
        if let Step::Symbol(name) = tree.step() {
            let (_, other) = self.renamed.iter().find(|(own, _)| own == name)?;
            return Some(Name { symbol: other.to_string(), arguments: Vec::new() });
        }
        let call = self.registry.call(tree).filter(|call| call.formula.folded && !self.in_full);
        let Call { formula, arguments } = call?;
        if self.own.is_some_and(|own| own.name() == formula.name()) {
            return None;
        }
        let usual =
            |argument: &Tree, name: &str| argument.typeset(Notation::Text, &|tree| self.of(tree)) == name;
        let named: Vec<_> = arguments.into_iter().zip(formula.depends_on()).collect();
        let arguments = if named.iter().all(|(argument, name)| usual(argument, name)) {
            Vec::new()
        } else {
            // All of the parameters or none: whoever reads fewer arguments has to know which.
            let quiet = |name: &str| self.registry.quiet.contains(&name);
            let said = named.iter().any(|(argument, name)| quiet(name) && !usual(argument, name));
            named.into_iter().filter(|(_, name)| said || !quiet(name)).map(|(argument, _)| argument).collect()
        };
        Some(Name { symbol: formula.symbol.to_string(), arguments })
    }
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

#[cfg(test)]
mod tests;

//! Functions as formulas: each recorded once, with the names of its arguments and its template in texts.
//!
//! A text contains placeholders for formulas, which [`Registry::render_template`] replaces: `«lens::image»`
//! becomes the formula of the function, `«lens::focus: f=f₁, d=d₁»` the same with other names of arguments,
//! and `«lens::power in full»` also writes out abbreviated functions.

use super::Hypothesis;
use super::symbols::{POWER, PRECISION, SCALES};
use super::typeset::{Name, Notation, latex};
use crate::number::Tree;
use crate::number::tree::{Op, Site};
use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap, HashSet};

/// A recorded function.
#[derive(Clone, Debug)]
pub struct Formula {
    /// Path of the function: `module::name`.
    pub path: &'static str,
    /// Name of one of several values.
    pub part: Option<&'static str>,
    /// Symbol of the value, which replaces a call if `abbreviated` is set.
    pub symbol: &'static str,
    /// Whether formulas abbreviate calls by the symbol.
    pub abbreviated: bool,
    /// Names of the arguments, except for those common to all functions of the registry.
    pub arguments: Vec<&'static str>,
    /// The recorded formula.
    pub tree: Tree,
    /// Text around the formula, which is `«»` in it; it differs from `«»` if the formula is formed by
    /// differentiating, or has any number of terms.
    pub template: &'static str,
}

/// A subformula computed by a function of the registry.
#[derive(Clone, Debug)]
pub struct Call<'a> {
    /// The function.
    pub formula: &'a Formula,
    /// Formulas of its [arguments](Formula::depends_on).
    pub arguments: Vec<Tree>,
}

/// A set of recorded functions, which recognises calls of these in other formulas.
///
/// # Examples
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
/// let whole = Formula::new("parallel", "k", &["a", "b"], parallel(&a, &b)).abbreviated();
/// let registry = Registry::new(&["a", "b", "u"], vec![whole]);
/// let force = parallel(&a, &b) * Tree::symbol("u");
/// assert_eq!(force.typeset(Notation::Text, &|tree| registry.call_name(tree)), "k u");
/// assert_eq!(force.to_string(), "(a + b) u");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Registry {
    symbols: Vec<&'static str>,
    confusable: Vec<[&'static str; 2]>,
    factors: Vec<&'static str>,
    formulas: Vec<Formula>,
    /// Indices of the functions by the site of their last operation.
    by_site: HashMap<Site, Vec<usize>>,
    /// Sites of all operations.
    sites: HashSet<Site>,
}

impl Registry {
    /// Returns a registry of functions, each after those it calls. `symbols` are all quantities in the order
    /// in which they are listed.
    ///
    /// # Panics
    /// Panics if two functions have the same name, or if the symbol of an [abbreviated](Formula::abbreviated)
    /// function is also that of a quantity, of another abbreviated function, or reserved by proofs and
    /// sequences.
    pub fn new(symbols: &[&'static str], formulas: Vec<Formula>) -> Self {
        let (mut names, mut taken) = (BTreeSet::new(), BTreeSet::new());
        for formula in &formulas {
            let (name, symbol) = (formula.name(), formula.symbol);
            assert!(names.insert(name.clone()), "two functions are called {name}");
            if formula.abbreviated {
                assert!(!symbols.contains(&symbol), "{name} is written as {symbol}, which is a quantity");
                assert!(
                    !is_reserved(symbol),
                    "{name} is written as {symbol}, which is a reserved name of proofs"
                );
                assert!(taken.insert(symbol), "{name} is written as {symbol}, and another function too");
            }
        }
        let mut by_site: HashMap<Site, Vec<usize>> = HashMap::new();
        let mut sites = HashSet::new();
        for (i, formula) in formulas.iter().enumerate() {
            // A function that returns an argument unchanged, as a mutant may, has no operation by which to
            // recognise it.
            if !matches!(formula.tree.op(), Op::Symbol(_)) {
                by_site.entry(formula.tree.site()).or_default().push(i);
            }
            formula.tree.visit(&mut |tree| {
                sites.insert(tree.site());
            });
        }
        sites.retain(|site| !site.is_in_dual_numbers());
        Registry { symbols: symbols.to_vec(), formulas, by_site, sites, ..Registry::default() }
    }

    /// Sets pairs of symbols of the same unit that could be confused.
    pub fn with_confusable(self, pairs: &[[&'static str; 2]]) -> Self {
        Registry { confusable: pairs.to_vec(), ..self }
    }

    /// Sets the order of the factors in a product.
    pub fn with_factors(self, factors: &[&'static str]) -> Self {
        Registry { factors: factors.to_vec(), ..self }
    }

    /// Returns the order of the factors in a product; other factors precede them, sorted by name.
    pub fn factors(&self) -> &[&'static str] {
        &self.factors
    }

    /// Returns symbols of the same unit that could be confused with this one.
    pub fn confusable_with(&self, symbol: &str) -> impl Iterator<Item = &'static str> {
        self.confusable.iter().filter_map(move |[a, b]| match symbol {
            _ if *a == symbol => Some(*b),
            _ if *b == symbol => Some(*a),
            _ => None,
        })
    }

    /// Returns the registry, except that functions whose symbols are those of these quantities are written out.
    pub(crate) fn without_symbols(&self, quantities: &BTreeSet<&str>) -> Cow<'_, Self> {
        let mut registry = Cow::Borrowed(self);
        for (i, formula) in self.formulas.iter().enumerate() {
            if formula.abbreviated && quantities.contains(formula.symbol) {
                registry.to_mut().formulas[i].abbreviated = false;
            }
        }
        registry
    }

    /// Returns the functions.
    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// Returns the formula of a function, or of one of its values: `lens::focus`, `lens::residual.image`.
    pub fn formula(&self, path: &str) -> Option<&Formula> {
        self.formulas.iter().find(|formula| formula.name() == path)
    }

    /// Returns `true` if a function has an operation at this site.
    pub fn has_site(&self, site: &Site) -> bool {
        self.sites.contains(site)
    }

    /// Returns the symbols of formulas in the order of the registry, followed by others.
    pub fn symbols_of<'t>(&self, trees: impl IntoIterator<Item = &'t Tree>) -> Vec<&'static str> {
        let mut found: BTreeSet<_> = trees.into_iter().flat_map(Tree::symbols).collect();
        let mut listed: Vec<_> = self.symbols.iter().copied().filter(|symbol| found.remove(symbol)).collect();
        listed.extend(found);
        listed
    }

    /// Returns the symbols that a function depends on in addition to its own arguments.
    pub fn common_symbols<'a>(&'a self, formula: &'a Formula) -> impl Iterator<Item = &'static str> {
        let symbols = self.symbols_of([&formula.tree]).into_iter();
        symbols.filter(|symbol| !formula.arguments.contains(symbol))
    }

    /// Formats a function, with abbreviations for its calls.
    ///
    /// # Examples
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

    /// Returns the call if a function only calls another one.
    pub fn delegated_call(&self, formula: &Formula) -> Option<Call<'_>> {
        self.call(&formula.tree).filter(|call| call.formula.name() != formula.name())
    }

    /// Formats the equation that a function computes: `Π = c u² / 2 − m g u`.
    ///
    /// Several values are the two sides of an equation, or residuals: `c u − m g + λ = 0, p = 0`.
    pub fn format_equation(&self, path: &str) -> Option<String> {
        let values: Vec<_> = self.formulas.iter().filter(|formula| formula.path == path).collect();
        let sides = values.iter().map(|formula| {
            let text = self.typeset(formula, Notation::Text);
            match (formula.symbol, formula.part) {
                ("", None | Some("left" | "right")) => text,
                ("", Some(_)) => text + " = 0",
                (symbol, _) => format!("{symbol} = {text}"),
            }
        });
        let has_sides = values.iter().any(|formula| formula.part == Some("left"));
        let separator = if has_sides { " = " } else { ", " };
        (!values.is_empty()).then(|| sides.collect::<Vec<_>>().join(separator))
    }

    /// Replaces the placeholders of a text; those that name no formula stay.
    pub fn render_template(&self, template: &str, notation: Notation) -> String {
        let mut pieces = template.split('«');
        let mut text = pieces.next().unwrap_or_default().to_string();
        for piece in pieces {
            let filled = piece
                .split_once('»')
                .and_then(|(hole, rest)| Some(self.render_placeholder(hole, notation)? + rest));
            text += &filled.unwrap_or_else(|| format!("«{piece}"));
        }
        text
    }

    /// Formats the content of a placeholder: `path`, `path in full`, `path: name=other, name=other`.
    pub fn render_placeholder(&self, hole: &str, notation: Notation) -> Option<String> {
        let (path, renamed) = hole.split_once(": ").unwrap_or((hole, ""));
        let (path, in_full) = path.strip_suffix(" in full").map_or((path, false), |path| (path, true));
        let formula = self.formula(path)?;
        let renamed: Option<Vec<_>> =
            renamed.split(", ").filter(|pair| !pair.is_empty()).map(|pair| pair.split_once('=')).collect();
        let names = CallNames { in_full, renamed: renamed?, ..self.names(Some(formula)) };
        let known = formula.tree.symbols();
        names.renamed.iter().all(|(name, _)| known.contains(name)).then(|| names.typeset(formula, notation))
    }

    /// Returns the abbreviation of a subformula that is a call, with its arguments if they differ from the
    /// usual ones; an argument for [`Tree::typeset`].
    pub fn call_name(&self, tree: &Tree) -> Option<Name> {
        self.names(None).of(tree)
    }

    /// Formats a formula with abbreviations.
    pub fn format_tree(&self, tree: &Tree) -> String {
        tree.typeset(Notation::Text, &|tree| self.call_name(tree))
    }

    /// Formats a hypothesis with abbreviations: `λ < R`.
    pub fn format_hypothesis(&self, hypothesis: &Hypothesis) -> String {
        hypothesis.typeset(&|tree| self.call_name(tree))
    }

    /// Formats hypotheses with abbreviations.
    pub fn format_hypotheses(&self, hypotheses: &[Hypothesis]) -> Vec<String> {
        hypotheses.iter().map(|hypothesis| self.format_hypothesis(hypothesis)).collect()
    }

    fn names<'a>(&'a self, root: Option<&'a Formula>) -> CallNames<'a> {
        CallNames { registry: self, root, in_full: false, renamed: Vec::new() }
    }

    /// Returns the call of the function that computed this formula, if its last operation belongs to one.
    ///
    /// Functions are recognised by their sites in the source, so a formula with the same structure is not a
    /// call.
    pub fn call(&self, tree: &Tree) -> Option<Call<'_>> {
        self.calls(tree).next()
    }

    /// Returns all possible calls: first that of the function whose last operation it is, then those of
    /// functions that only call it. The record does not tell which of these was called.
    pub fn calls(&self, tree: &Tree) -> impl Iterator<Item = Call<'_>> {
        let known = self.by_site.get(&tree.site()).map_or(&[][..], Vec::as_slice);
        known.iter().filter_map(|&i| {
            let formula = &self.formulas[i];
            let mut found = HashMap::new();
            matches(&formula.tree, tree, &formula.arguments, &mut found).then_some(())?;
            let arguments = formula.depends_on().map(|name| found.get(name).map(|tree| (*tree).clone()));
            let arguments = arguments.collect::<Option<_>>()?;
            Some(Call { formula, arguments })
        })
    }
}

/// Collects formulas into a registry whose quantities are their arguments.
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
    /// Returns a function of one value.
    pub fn new(path: &'static str, symbol: &'static str, arguments: &[&'static str], tree: Tree) -> Self {
        let arguments = arguments.to_vec();
        Formula { path, part: None, symbol, abbreviated: false, arguments, tree, template: "«»" }
    }

    /// Lets formulas abbreviate calls by the symbol.
    pub fn abbreviated(self) -> Self {
        Formula { abbreviated: true, ..self }
    }

    /// Makes it one of several values, with this name.
    pub fn part(self, part: &'static str) -> Self {
        Formula { part: Some(part), ..self }
    }

    /// Sets the text around the formula, see [`template`](Formula::template).
    pub fn written(self, template: &'static str) -> Self {
        Formula { template, ..self }
    }

    /// Returns the path with the part: `lens::residual.image`.
    pub fn name(&self) -> String {
        self.part.map_or(self.path.to_string(), |part| format!("{}.{part}", self.path))
    }

    /// Returns the arguments that the value depends on; one of several values may ignore some.
    pub fn depends_on(&self) -> impl Iterator<Item = &'static str> {
        let symbols = self.tree.symbols();
        self.arguments.iter().copied().filter(move |name| symbols.contains(name))
    }
}

/// Returns `true` if printed proofs use the symbol: 2ᵖ, q, or e, s, t, x with a subscript.
fn is_reserved(symbol: &str) -> bool {
    let numbered = symbol
        .strip_prefix(['e', 's', 't', 'x'])
        .is_some_and(|number| !number.is_empty() && number.chars().all(|c| ('₀'..='₉').contains(&c)));
    numbered || [PRECISION, POWER, "fl", "nearest"].contains(&symbol) || SCALES.contains(&symbol)
}

/// Abbreviations of subformulas.
struct CallNames<'a> {
    registry: &'a Registry,
    /// The formula itself, which is never abbreviated.
    root: Option<&'a Formula>,
    in_full: bool,
    renamed: Vec<(&'a str, &'a str)>,
}

impl CallNames<'_> {
    fn typeset(&self, formula: &Formula, notation: Notation) -> String {
        let tree = formula.tree.typeset(notation, &|tree| self.of(tree));
        match notation {
            Notation::Latex => formula.template.split("«»").map(latex).collect::<Vec<_>>().join(&tree),
            Notation::Text => formula.template.replace("«»", &tree),
        }
    }

    fn of(&self, tree: &Tree) -> Option<Name> {
        if let Op::Symbol(name) = tree.op() {
            let (_, other) = self.renamed.iter().find(|(symbol, _)| symbol == name)?;
            return Some(Name { symbol: other.to_string(), arguments: Vec::new() });
        }
        let call = self.registry.call(tree).filter(|call| call.formula.abbreviated && !self.in_full);
        let Call { formula, arguments } = call?;
        if self.root.is_some_and(|root| root.name() == formula.name()) {
            return None;
        }
        // Either all arguments or none are displayed, so that they are identified by their position.
        let name = |tree: &Tree| tree.typeset(Notation::Text, &|tree| self.of(tree));
        let is_usual = arguments.iter().zip(formula.depends_on()).all(|(of, usual)| name(of) == usual);
        let arguments = if is_usual { Vec::new() } else { arguments };
        Some(Name { symbol: formula.symbol.to_string(), arguments })
    }
}

/// Returns `true` if the tree is the pattern with its arguments replaced consistently.
fn matches<'t>(
    pattern: &Tree,
    tree: &'t Tree,
    arguments: &[&'static str],
    found: &mut HashMap<&'static str, &'t Tree>,
) -> bool {
    if let Op::Symbol(name) = pattern.op()
        && arguments.contains(name)
    {
        return *found.entry(name).or_insert(tree) == tree;
    }
    let same = match (pattern.op(), tree.op()) {
        (Op::Symbol(a), Op::Symbol(b)) => a == b,
        (Op::Int(a), Op::Int(b)) => a == b,
        (a, b) => std::mem::discriminant(a) == std::mem::discriminant(b),
    };
    let mut operands = pattern.op().operands().zip(tree.op().operands());
    same && operands.all(|(a, b)| matches(a, b, arguments, found))
}

#[cfg(test)]
mod tests;

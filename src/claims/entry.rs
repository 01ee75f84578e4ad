//! Entries of the chapter.

use super::{SourceLine, registry};
use crate::formula::{Hypothesis, Notation, Statement};

/// An entry of the chapter: an equation, the theorem, a remark, a figure, a note on a loose spot, or a result
/// beyond the chapter.
///
/// Its statement and its LaTeX contain placeholders for formulas, see
/// [`Registry::render_template`](crate::formula::Registry::render_template). The remaining text consists of
/// words, relations, names of quantities, and expressions that no function computes.
#[derive(Clone, Debug, Default)]
pub struct Entry {
    /// Equation number or name: "1.13", "Theorem 1.3.3", "Remark 1.3.2", "Fig. 1.1", "note 4" or "beyond 2".
    pub equation: &'static str,
    /// Title.
    pub title: &'static str,
    /// Section.
    pub section: &'static str,
    /// Line of the source on which it begins.
    pub source: SourceLine,
    statement: &'static str,
    latex: Option<&'static str>,
    /// Hypotheses that its claims inherit.
    pub hypotheses: Vec<Hypothesis>,
    /// Functions in [`chapter`](crate::chapter) with its formulas, as `module::name`; that of its equation
    /// first.
    pub functions: Vec<&'static str>,
    /// Entries from which it is derived.
    pub follows_from: Vec<&'static str>,
    /// Claims about it.
    pub claims: Vec<Statement>,
}

impl Entry {
    /// Returns its statement with all formulas.
    ///
    /// # Examples
    ///
    /// ```
    /// use spring_mass_contact::claims::entry;
    /// assert_eq!(entry("1.12").unwrap().statement(), "N = ε p, which is ε R / (c + ε) at (1.13)");
    /// ```
    pub fn statement(&self) -> String {
        registry().render_template(self.statement, Notation::Text)
    }

    /// Returns the equation in LaTeX if it is a numbered equation of the chapter.
    ///
    /// # Examples
    ///
    /// ```
    /// use spring_mass_contact::claims::entry;
    /// assert_eq!(entry("1.24").unwrap().latex().unwrap(), r"u = u_h + u_{\mathrm{nh}}");
    /// ```
    pub fn latex(&self) -> Option<String> {
        self.latex_template().map(|template| registry().render_template(template, Notation::Latex))
    }

    fn latex_template(&self) -> Option<&'static str> {
        self.latex.or(self.is_numbered().then_some(self.statement))
    }

    fn is_numbered(&self) -> bool {
        self.equation.starts_with(|c: char| c.is_ascii_digit())
    }

    /// Returns its label in a text: `(1.13)` for an equation number, otherwise its name.
    pub fn label(&self) -> String {
        if self.is_numbered() { format!("({})", self.equation) } else { self.equation.to_string() }
    }

    /// Returns its hypotheses as text.
    pub fn format_hypotheses(&self) -> Vec<String> {
        registry().format_hypotheses(&self.hypotheses)
    }

    #[track_caller]
    pub(super) fn new(equation: &'static str, title: &'static str) -> Self {
        Entry { equation, title, source: SourceLine::of_caller(), ..Entry::default() }
    }

    pub(super) fn within(self, section: &'static str) -> Self {
        Entry { section, ..self }
    }

    pub(super) fn states(self, statement: &'static str) -> Self {
        Entry { statement, ..self }
    }

    pub(super) fn in_latex(self, latex: &'static str) -> Self {
        Entry { latex: Some(latex), ..self }
    }

    pub(super) fn assuming<const N: usize>(self, hypotheses: [&Hypothesis; N]) -> Self {
        Entry { hypotheses: hypotheses.map(Hypothesis::clone).into(), ..self }
    }

    pub(super) fn functions<const N: usize>(self, functions: [&'static str; N]) -> Self {
        Entry { functions: functions.into(), ..self }
    }

    pub(super) fn follows_from<const N: usize>(self, entries: [&'static str; N]) -> Self {
        Entry { follows_from: entries.into(), ..self }
    }

    /// Adds claims, which inherit the hypotheses unless they [replace](Statement::only_assuming) them.
    pub(super) fn claims(mut self, claims: impl IntoIterator<Item = Statement>) -> Self {
        let inheriting = claims.into_iter().map(|claim| claim.inheriting(self.equation, &self.hypotheses));
        self.claims.extend(inheriting);
        self
    }
}

#[cfg(test)]
mod tests {
    use crate::claims::{entries, entry_for_function};

    #[test]
    fn an_entry_that_lists_the_function_first_is_preferred() {
        for function in entries().iter().flat_map(|entry| &entry.functions) {
            let own = entries().iter().any(|entry| entry.functions.starts_with(&[*function]));
            let found = entry_for_function(function).unwrap();
            assert_eq!(found.functions[0] == *function, own, "{function}: {}", found.label());
            assert!(found.functions.contains(function));
        }
        assert!(entry_for_function("penalty::nothing").is_none());
    }

    #[test]
    fn an_equation_has_no_formula_outside_its_placeholders() {
        for entry in entries() {
            let pieces = entry.latex_template().unwrap_or_default().split('«');
            let outside = pieces.map(|piece| piece.split_once('»').map_or(piece, |(_, outside)| outside));
            for outside in outside {
                // A subscript k + 1 belongs to a name.
                let names = outside.split("_{").enumerate();
                let after = |(i, piece): (usize, &'static str)| match piece.split_once('}') {
                    Some((_, after)) if i > 0 => after,
                    _ => piece,
                };
                let bare: String = names.map(after).collect();
                assert!(!bare.contains(['+', '-']), "{}: {bare}", entry.equation);
            }
        }
    }
}

//! Locations of equations, functions and entries in the book.

use crate::{claims::slug, equations};
use anyhow::{Result, bail};
use mdbook_preprocessor::book::Book;
use regex::Regex;
use spring_mass_contact::claims::{Entry, entries};
use std::{collections::HashMap, fmt, path::PathBuf};

/// Page and anchor; `Display` writes a link relative to the root of the book.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    pub page: PathBuf,
    pub anchor: String,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}#{}", self.page.display(), self.anchor)
    }
}

/// Locations of all equations, functions and entries.
pub struct Places {
    equations: HashMap<String, Place>,
    functions: HashMap<String, Place>,
    entries: HashMap<&'static str, Place>,
}

impl Places {
    /// Collects the locations from the tags of the pages.
    ///
    /// # Errors
    /// Returns an error if an equation is not displayed, or if an equation or a function is displayed twice.
    pub fn of(book: &Book, tags: &Regex) -> Result<Self> {
        let (mut equations, mut functions) = (HashMap::new(), HashMap::new());
        for chapter in book.chapters() {
            let Some(page) = &chapter.path else { bail!("{} is a draft", chapter.name) };
            for tag in tags.captures_iter(&chapter.content) {
                let name = tag.get(2).map_or("", |name| name.as_str());
                let (list, anchor, label) = match &tag[1] {
                    "eq" => (&mut equations, anchor(name), format!("({name})")),
                    "source" => (&mut functions, anchor_of(name), name.into()),
                    _ => continue,
                };
                if let Some(first) = list.insert(name.to_string(), Place { page: page.clone(), anchor }) {
                    bail!("{label} is displayed twice, first in {}", first.page.display());
                }
            }
        }
        for (entry, _) in crate::equations() {
            if !equations.contains_key(entry.equation) {
                bail!("{} is not displayed on any page", entry.label());
            }
        }
        let entries = entries().iter().filter_map(|entry| {
            let displayed = equations.get(entry.equation).cloned();
            Some((entry.equation, displayed.or_else(|| find_anchor(entry, book))?))
        });
        Ok(Self { entries: entries.collect(), equations, functions })
    }

    /// Returns the location of an equation's box.
    pub fn equation(&self, number: &str) -> Option<&Place> {
        self.equations.get(number)
    }

    /// Returns `true` if a page shows the function, and no box does: then it has an anchor of its own.
    pub fn has_own_anchor(&self, function: &str) -> bool {
        self.functions.contains_key(function) && first_with(function).is_none()
    }

    /// Returns the location of an entry: its box, or the heading or figure with its name as anchor.
    pub fn entry(&self, entry: &Entry) -> Option<&Place> {
        self.entries.get(entry.equation)
    }
}

/// Finds the heading or figure with the name of an entry as anchor.
fn find_anchor(entry: &Entry, book: &Book) -> Option<Place> {
    let anchor = slug(entry);
    let figure = anchor.strip_prefix("fig-").unwrap_or_default();
    let marks = [format!("{{#{anchor}}}"), format!("id=\"{anchor}\""), format!("{{{{#figure {figure}}}}}")];
    let chapter = book.chapters().find(|chapter| marks.iter().any(|mark| chapter.content.contains(mark)))?;
    Some(Place { page: chapter.path.clone()?, anchor })
}

/// Returns the anchor of an equation's box.
pub fn anchor(number: &str) -> String {
    format!("eq-{}", number.replace('.', "-"))
}

/// Returns the anchor of a function that a page shows outside of a box.
pub fn anchor_of(function: &str) -> String {
    format!("fn-{}", function.replace("::", "-"))
}

/// Returns the number of the first equation that lists the function.
pub fn first_with(function: &str) -> Option<&'static str> {
    equations()
        .map(|(entry, _)| entry)
        .find(|entry| entry.functions.contains(&function))
        .map(|entry| entry.equation)
}

//! Where the book shows what.

use crate::{claims::slug, equations};
use anyhow::{Context, Result, bail};
use mdbook_preprocessor::book::Book;
use regex::Regex;
use spring_mass_contact::claims::{Entry, entries};
use std::{collections::HashMap, fmt, path::PathBuf};

/// A page and an address on it; displayed as a link from the root of the book.
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

/// Where each equation is displayed, each function, and each entry.
pub struct Places {
    equations: HashMap<String, Place>,
    functions: HashMap<String, Place>,
    entries: HashMap<&'static str, Place>,
}

impl Places {
    /// Each equation has to be displayed, once; and of a function no more than its equation displays.
    pub fn of(book: &Book, tags: &Regex) -> Result<Self> {
        let (mut equations, mut functions) = (HashMap::new(), HashMap::new());
        for chapter in book.chapters() {
            let Some(page) = &chapter.path else { bail!("{} is a draft", chapter.name) };
            for tag in tags.captures_iter(&chapter.content) {
                let what = tag.get(2).map_or("", |what| what.as_str());
                let (list, anchor, label) = match &tag[1] {
                    "eq" => (&mut equations, anchor(what), format!("({what})")),
                    "source" => (&mut functions, anchor_of(what), what.into()),
                    _ => continue,
                };
                if let Some(first) = list.insert(what.to_string(), Place { page: page.clone(), anchor }) {
                    bail!("{label} is displayed twice, first in {}", first.page.display());
                }
            }
        }
        for (entry, _) in crate::equations() {
            let place = equations.get(entry.equation);
            let place = place.with_context(|| format!("{} is not displayed on any page", entry.label()))?;
            for function in &entry.functions {
                // What stands in a box is found there, even if a page shows it once more.
                if first_with(function) == Some(entry.equation) {
                    functions.insert(function.to_string(), place.clone());
                }
            }
        }
        let entries = entries().iter().filter_map(|entry| {
            let displayed = equations.get(entry.equation).cloned();
            Some((entry.equation, displayed.or_else(|| named(entry, book))?))
        });
        Ok(Self { entries: entries.collect(), equations, functions })
    }

    pub fn equation(&self, number: &str) -> Option<&Place> {
        self.equations.get(number)
    }

    /// Where a function's source is.
    pub fn function(&self, path: &str) -> Option<&Place> {
        self.functions.get(path)
    }

    /// Where an entry is: its box, or the heading or figure that has its name for an address.
    pub fn entry(&self, entry: &Entry) -> Option<&Place> {
        self.entries.get(entry.equation)
    }
}

/// The heading or figure that has an entry's name for an address.
fn named(entry: &Entry, book: &Book) -> Option<Place> {
    let anchor = slug(entry);
    let figure = anchor.strip_prefix("fig-").unwrap_or_default();
    let marks = [format!("{{#{anchor}}}"), format!("id=\"{anchor}\""), format!("{{{{#figure {figure}}}}}")];
    let chapter = book.chapters().find(|chapter| marks.iter().any(|mark| chapter.content.contains(mark)))?;
    Some(Place { page: chapter.path.clone()?, anchor })
}

/// The address of an equation's box.
pub fn anchor(number: &str) -> String {
    format!("eq-{}", number.replace('.', "-"))
}

/// The address of a function that a page shows by itself.
pub fn anchor_of(function: &str) -> String {
    format!("fn-{}", function.replace("::", "-"))
}

/// The number of the first equation that lists the function.
pub fn first_with(function: &str) -> Option<&'static str> {
    equations()
        .map(|(entry, _)| entry)
        .find(|entry| entry.functions.contains(&function))
        .map(|entry| entry.equation)
}

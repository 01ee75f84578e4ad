//! Locations of entries in the book.

use crate::{claims::slug, equations};
use anyhow::{Context, Result, bail};
use mdbook_preprocessor::book::{Book, Chapter};
use regex::Regex;
use spring_mass_contact::claims::entries;
use std::collections::HashMap;

/// Links to the entries that the book shows, relative to its root.
pub struct Places(HashMap<&'static str, String>);

impl Places {
    /// Collects the locations from the tags of the pages, and from headings and figures with the name of an entry as
    /// anchor.
    ///
    /// # Errors
    /// Returns an error if an equation is not displayed, or if an equation or a function is displayed twice.
    pub fn of(book: &Book, tags: &Regex) -> Result<Self> {
        let mut displayed = HashMap::new();
        for chapter in book.chapters() {
            for tag in tags.captures_iter(&chapter.content).filter(|tag| ["eq", "source"].contains(&&tag[1]))
            {
                let key = (tag[1].to_string(), tag.get(2).map_or("", |name| name.as_str()));
                if let Some(first) = displayed.insert(key, chapter) {
                    bail!("{} is displayed twice, first in {}", &tag[0], first.name);
                }
            }
        }
        let mut places = HashMap::new();
        for entry in entries() {
            let equation = displayed.get(&("eq".to_string(), entry.equation)).copied();
            if equation.is_none() && entry.latex().is_some() {
                bail!("{} is not displayed on any page", entry.label());
            }
            let slug = slug(entry);
            let figure = slug.strip_prefix("fig-").unwrap_or_default();
            let marks =
                [format!("{{#{slug}}}"), format!("id=\"{slug}\""), format!("{{{{#figure {figure}}}}}")];
            let is_marked = |page: &&Chapter| marks.iter().any(|mark| page.content.contains(mark));
            if let Some(chapter) = equation.or_else(|| book.chapters().find(is_marked)) {
                let page = chapter.path.as_deref().with_context(|| format!("{} is a draft", chapter.name))?;
                let anchor = equation.map_or(slug, |_| anchor(entry.equation));
                places.insert(entry.equation, format!("{}#{anchor}", page.display()));
            }
        }
        Ok(Self(places))
    }

    /// Returns the link to the box of an equation, or to the heading or figure of another entry.
    pub fn get(&self, equation: &str) -> Result<&str> {
        self.0.get(equation).map(String::as_str).with_context(|| format!("no equation ({equation})"))
    }
}

/// Returns the anchor of an equation's box.
pub fn anchor(number: &str) -> String {
    format!("eq-{}", number.replace('.', "-"))
}

/// Returns the number of the first equation that lists the function.
pub fn first_with(function: &str) -> Option<&'static str> {
    let mut equations = equations().map(|(entry, _)| entry);
    equations.find(|entry| entry.functions.contains(&function)).map(|entry| entry.equation)
}

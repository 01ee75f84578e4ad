//! The book's preprocessor: formulas typeset, equations with their numbers and their source.
//!
//! | in a page | becomes |
//! |---|---|
//! | `$…$`, `$$…$$` | the formula as HTML |
//! | `{{#eq 1.13}}` | the equation, numbered, to be linked to, and the Rust source of its functions |
//! | `{{#ref 1.13}}` | its number as a link, from any page |
//! | `{{#source system::gap}}` | the Rust source of a function without a number |
//! | `{{#formula system::gap}}` | the formula that a function computes, within `$…$` or by itself |
//!
//! A formula stands in `src/chapter` and nowhere else: its source is shown, and typeset. The last tag takes
//! what a hole in an [`Entry`] takes, such as `{{#formula contact::penetration: u=u_k}}`.

mod math;
mod source;

use anyhow::{Context, Result, bail};
use math::Typesetter;
use mdbook_preprocessor::{
    Preprocessor, PreprocessorContext,
    book::{Book, Chapter},
};
use regex::{Captures, Regex};
use source::Sources;
use spring_mass_contact::claims::{Entry, entries, entry};
use std::{collections::HashMap, path::PathBuf};

/// The numbered equations of the chapter, in order, with their LaTeX.
pub fn equations() -> impl Iterator<Item = (&'static Entry, String)> {
    entries().iter().filter_map(|entry| Some((entry, entry.latex()?)))
}

/// The preprocessor.
pub struct Equations;

impl Preprocessor for Equations {
    fn name(&self) -> &str {
        "equations"
    }

    fn run(&self, context: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let tags = tag("eq|ref|source|formula")?;
        let tools = Tools {
            typesetter: Typesetter::new()?,
            sources: Sources::in_folder(&context.root.join("../src/chapter")),
            pages: pages(&book, &tags)?,
        };
        let mut result = Ok(());
        book.for_each_chapter_mut(|chapter| {
            if result.is_ok() {
                result = tools.process(chapter, &tags).with_context(|| {
                    format!("in {}", chapter.path.as_deref().unwrap_or("".as_ref()).display())
                });
            }
        });
        result.map(|()| book)
    }
}

/// Where each equation is displayed. Each has to be, once.
fn pages(book: &Book, tags: &Regex) -> Result<HashMap<String, PathBuf>> {
    let mut pages = HashMap::new();
    for chapter in book.chapters() {
        for tag in tags.captures_iter(&chapter.content).filter(|tag| &tag[1] == "eq") {
            let path = chapter.path.clone().context("an equation in a draft")?;
            if let Some(first) = pages.insert(tag[2].to_string(), path) {
                bail!("({}) is displayed twice, first in {}", &tag[2], first.display());
            }
        }
    }
    match equations().find(|(entry, _)| !pages.contains_key(entry.equation)) {
        Some((missing, _)) => bail!("{} is not displayed on any page", missing.label()),
        None => Ok(pages),
    }
}

/// What it takes to process a page.
struct Tools {
    typesetter: Typesetter,
    sources: Sources,
    pages: HashMap<String, PathBuf>,
}

impl Tools {
    fn process(&self, chapter: &mut Chapter, tags: &Regex) -> Result<()> {
        let text = self.typesetter.page(&chapter.content)?;
        chapter.content = replaced(&text, tags, |tag| self.tag(tag))?;
        Ok(())
    }

    fn tag(&self, tag: &Captures) -> Result<String> {
        match (&tag[1], &tag[2]) {
            ("eq", number) => {
                self.equation(entry(number).with_context(|| format!("no equation ({number})"))?)
            }
            ("ref", number) => {
                let page = self.pages.get(number).with_context(|| format!("no equation ({number})"))?;
                Ok(format!("[({number})]({}#{})", page.display(), anchor(number)))
            }
            ("source", function) => self.source(&[function]),
            (_, _) => self.typesetter.inline(&tag[0]),
        }
    }

    fn equation(&self, entry: &Entry) -> Result<String> {
        let (number, label) = (entry.equation, entry.label());
        let latex = entry.latex().with_context(|| format!("{label} has no formula"))?;
        let (id, html) = (anchor(number), self.typesetter.display(&latex)?);
        let formula = format!(
            "<div class=\"equation\" id=\"{id}\"><div class=\"formula\">{html}</div>\
             <a class=\"number\" href=\"#{id}\">{label}</a></div>"
        );
        // A function that serves several equations is printed with the first and named with the others.
        let (new, known): (Vec<_>, Vec<_>) =
            entry.functions.iter().copied().partition(|&function| first_with(function) == Some(number));
        let mut result = format!("\n\n{formula}\n\n");
        if !new.is_empty() {
            result += &self.source(&new)?;
        }
        for function in known {
            let first = first_with(function).context("listed")?;
            let page = &self.pages[first];
            let link = format!("[({first})]({}#{})", page.display(), anchor(first));
            result += &format!("<div class=\"caption\">\n\n`{function}`, printed at {link}\n\n</div>\n\n");
        }
        Ok(result)
    }

    fn source(&self, functions: &[&str]) -> Result<String> {
        let names =
            functions.iter().map(|name| format!("<code>{name}</code>")).collect::<Vec<_>>().join(", ");
        let code = functions.iter().map(|name| self.sources.function(name)).collect::<Result<Vec<_>>>()?;
        let code = code.join("\n\n");
        Ok(format!(
            "\n\n<div class=\"source\"><p class=\"caption\">{names}</p>\n\n```rust,ignore\n{code}\n```\n\n</div>\n\n"
        ))
    }
}

/// The number of the first equation that lists the function.
fn first_with(function: &str) -> Option<&'static str> {
    equations()
        .map(|(entry, _)| entry)
        .find(|entry| entry.functions.contains(&function))
        .map(|entry| entry.equation)
}

/// The text with each tag replaced, or the first error.
fn replaced(text: &str, tags: &Regex, by: impl Fn(&Captures) -> Result<String>) -> Result<String> {
    let mut result = String::with_capacity(text.len());
    let mut end = 0;
    for tag in tags.captures_iter(text) {
        let range = tag.get_match().range();
        result += &text[end..range.start];
        result += &by(&tag)?;
        end = range.end;
    }
    Ok(result + &text[end..])
}

/// A tag of one of these kinds; what it names may have braces of its own.
fn tag(kinds: &str) -> Result<Regex> {
    Ok(Regex::new(&format!(r"\{{\{{#({kinds})\s+((?:[^{{}}]|\{{[^{{}}]*\}})+?)\s*\}}\}}"))?)
}

fn anchor(number: &str) -> String {
    format!("eq-{}", number.replace('.', "-"))
}

/// The pages of the book; the Rust in them is compiled and run as documentation tests.
macro_rules! pages {
    ($($page:ident)*) => {
        /// The names of the pages' files, without `.md`.
        pub const PAGES: &[&str] = &[$(stringify!($page)),*];
        $(
            #[cfg(doctest)]
            #[doc = include_str!(concat!("../../src/", stringify!($page), ".md"))]
            mod $page {}
        )*
    };
}
pages! {
    introduction notation system structure contact formulations lagrange penalty augmented
    convergence stalls elements command check solvers speed beyond loose floats claims proofs
    sources teaching
}

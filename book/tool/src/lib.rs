//! The book's preprocessor: formulas typeset, equations with their numbers and their source.
//!
//! | in a page | becomes |
//! |---|---|
//! | `$…$`, `$$…$$` | the formula as HTML |
//! | `{{#eq 1.13}}` | the equation's box: its number, what came of its claims, and the Rust source of its functions |
//! | `{{#ref 1.13}}` | its number as a link, from any page |
//! | `{{#source system::gap}}` | the Rust source of a function without a number |
//! | `{{#formula system::gap}}` | the formula that a function computes, within `$…$` or by itself |
//! | `{{#claims}}` | all claims and what came of each |
//! | `{{#figure plane}}` | a picture or a plot, drawn from what the functions compute |
//! | `{{#bench}}` | the [bench](mod@bench) |
//!
//! A formula stands in `src/chapter` and nowhere else: its source is shown, and typeset. The last tag takes
//! what a hole in an [`Entry`] takes, such as `{{#formula contact::penetration: u=u_k}}`.

pub mod bench;
mod claims;
pub mod figure;
mod math;
mod places;
pub mod proofs;
mod source;

use anyhow::{Context, Result};
use claims::Claims;
use math::Typesetter;
use mdbook_preprocessor::{
    Preprocessor, PreprocessorContext,
    book::{Book, Chapter},
};
use places::Places;
use proofs::heading;
use pulldown_cmark::{Event, Parser, Tag};
use regex::{Captures, Regex};
use source::{Item, Sources};
use spring_mass_contact::claims::{Entry, entries, entry};

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
        let tags = tag("eq|ref|source|formula|figure|claims|bench")?;
        let tools = Tools {
            typesetter: Typesetter::new()?,
            sources: Sources::in_folder(&context.root.join("../src/chapter")),
            places: Places::of(&book, &tags)?,
            claims: Claims::run(),
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

/// What it takes to process a page.
struct Tools {
    typesetter: Typesetter,
    sources: Sources,
    places: Places,
    claims: &'static Claims,
}

/// Where on a page a tag stands.
struct Spot {
    /// From the page to the root of the book.
    up: String,
    /// The level of the heading that it stands under; 0 before the first.
    level: usize,
}

impl Tools {
    fn process(&self, chapter: &mut Chapter, tags: &Regex) -> Result<()> {
        let text = self.typesetter.page(&self.led_back(chapter))?;
        let headings: Vec<_> = Parser::new(&text)
            .into_offset_iter()
            .filter_map(|(event, range)| match event {
                Event::Start(Tag::Heading { level, .. }) => Some((range.start, level as usize)),
                _ => None,
            })
            .collect();
        let depth = chapter.path.as_deref().map_or(0, |path| path.components().count().saturating_sub(1));
        chapter.content = replaced(&text, tags, |tag| {
            let before = headings.iter().rfind(|(start, _)| *start < tag.get_match().start());
            let spot = Spot { up: "../".repeat(depth), level: before.map_or(0, |(_, level)| *level) };
            self.tag(tag, &spot)
        })?;
        Ok(())
    }

    /// A page; one of proofs with links from each equation to where the book has it, and with small indices. The page
    /// as it is stored has neither, since it is read outside of the book, too.
    fn led_back(&self, chapter: &Chapter) -> String {
        let mut text = chapter.content.clone();
        if chapter.path.as_deref().is_some_and(|path| path.starts_with("proofs")) {
            for entry in entries() {
                let heading = format!("\n## {}\n", heading(entry));
                let place = self.places.entry(entry).map(|place| format!("[In the book](../{place}) · "));
                let claims = format!("[what is claimed](../claims.md#{})", claims::anchor(entry));
                let links = format!(
                    "\n{}{claims} · [what to trust](../proofs.md#trust)\n",
                    place.unwrap_or_default()
                );
                text = text.replace(&heading, &(heading.clone() + &links));
                let statement = format!("\n\n{}.\n", entry.statement());
                text = text.replace(&statement, &claims::with_indices(&statement));
            }
        }
        text
    }

    fn tag(&self, tag: &Captures, spot: &Spot) -> Result<String> {
        let what = tag.get(2).map_or("", |what| what.as_str());
        match &tag[1] {
            "eq" => self.equation(entry(what).with_context(|| format!("no equation ({what})"))?, spot),
            "ref" => {
                let place = self.places.equation(what).with_context(|| format!("no equation ({what})"))?;
                Ok(format!("[({what})]({}{place})", spot.up))
            }
            "source" => self.source(what, spot),
            "figure" => self.figure(what),
            "bench" => bench::html(),
            "claims" => Ok(self.claims.page(&self.places)),
            _ => self.typesetter.inline(&tag[0]),
        }
    }

    /// The box of an equation.
    fn equation(&self, entry: &Entry, spot: &Spot) -> Result<String> {
        let (number, label) = (entry.equation, entry.label());
        let latex = entry.latex().with_context(|| format!("{label} has no formula"))?;
        let mut result = format!(
            "\n\n<div class=\"equation\">\n\n{} Equation {number} · {} {{#{}}}\n\n\
             <div class=\"formula\">{}</div>\n\n{}\n\n",
            "#".repeat(spot.level + 1),
            entry.title,
            places::anchor(number),
            self.typesetter.display(&latex)?,
            self.claims.status(entry, &spot.up),
        );
        // A function that serves several equations is printed with the first and named with the others.
        for function in &entry.functions {
            let first = places::first_with(function).context("listed")?;
            result += &if first == number {
                self.source(function, spot)?
            } else {
                let place = self.places.equation(first).context("displayed")?;
                let links = links(function, &self.sources.item(function)?, &spot.up)?;
                format!(
                    "<div class=\"caption\">\n\n{links}, printed at [({first})]({}{place})\n\n</div>\n\n",
                    spot.up
                )
            };
        }
        Ok(result + "</div>\n\n")
    }

    fn figure(&self, name: &str) -> Result<String> {
        let figure = figure::figure(name).with_context(|| format!("no figure {name}"))?;
        let caption = self.typesetter.page(figure.caption)?;
        let svg = figure.inline();
        Ok(format!(
            "\n\n<figure class=\"drawing\" id=\"fig-{name}\">\n{svg}\n<figcaption>{caption}</figcaption>\n</figure>\n\n"
        ))
    }

    /// What a function computes, and folded away the whole of it.
    fn source(&self, function: &str, spot: &Spot) -> Result<String> {
        let item = self.sources.item(function)?;
        let id = match self.places.function(function) {
            Some(place) if place.anchor == places::anchor_of(function) => format!(" id=\"{}\"", place.anchor),
            _ => String::new(),
        };
        let code = |code: &str| format!("```rust,ignore\n{code}\n```\n\n");
        let shown = match item.body() {
            Some(body) => {
                let whole = code(&item.code);
                code(&body)
                    + &format!("<details><summary>the whole function</summary>\n\n{whole}</details>\n\n")
            }
            None => code(&item.code),
        };
        let links = links(function, &item, &spot.up)?;
        Ok(format!(
            "\n\n<div class=\"source\"{id}>\n<div class=\"caption\">\n\n{links}\n\n</div>\n\n{shown}</div>\n\n"
        ))
    }
}

/// A function's name, with links to its documentation and to its file.
fn links(function: &str, item: &Item, up: &str) -> Result<String> {
    let (module, name) = function.split_once("::").context("a path")?;
    let (first, last) = (item.lines.start(), item.lines.end());
    Ok(format!(
        "`{function}` · [documentation]({up}{DOCS}/{CRATE}/chapter/{module}/{}.{name}.html) · \
         [source]({up}{DOCS}/src/{CRATE}/chapter/{module}.rs.html#{first}-{last})",
        item.kind
    ))
}

/// From the root of the book to the documentation that `cargo doc` makes.
const DOCS: &str = "../doc";

/// What the crate is called there.
const CRATE: &str = "spring_mass_contact";

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
    Ok(Regex::new(&format!(r"\{{\{{#({kinds})(?:\s+((?:[^{{}}]|\{{[^{{}}]*\}})+?))?\s*\}}\}}"))?)
}

/// The pages of the book; the Rust in them is compiled and run as documentation tests.
macro_rules! pages {
    ($($page:ident)*) => {
        /// The names of the pages' files, without `.md`.
        pub const PAGES: &[&str] = &[$(stringify!($page)),*];
        #[cfg(doctest)]
        mod snippets {
            $(
                #[doc = include_str!(concat!("../../src/", stringify!($page), ".md"))]
                mod $page {}
            )*
        }
    };
}
pages! {
    introduction notation system structure contact formulations lagrange penalty augmented
    convergence stalls elements command check solvers speed beyond loose floats claims proofs
    sources teaching
}

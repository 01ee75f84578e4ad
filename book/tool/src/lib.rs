//! The book's preprocessor, which typesets formulas and inserts equations with their numbers and source.
//!
//! | tag in a page | replacement |
//! |---|---|
//! | `$…$`, `$$…$$` | the formula as HTML |
//! | `{{#eq 1.13}}` | the equation's box: its number, the status of its claims, and the Rust source of its functions |
//! | `{{#ref 1.13}}` | the equation number as a link, from any page |
//! | `{{#source system::gap}}` | the Rust source of a function without a number |
//! | `{{#formula system::gap}}` | the formula that a function computes, within `$…$` or outside |
//! | `{{#figure plane}}` | a figure drawn from the results of the functions |
//! | `{{#bench}}` | the [bench](mod@bench) |
//! | `{{#live H g}}`, `{{#live eps, k=0}}`, `{{#live x}}` | a [small figure](bench::live) with sliders of these quantities |
//!
//! Formulas are defined only in `src/chapter`; the book shows their source and typesets the recorded formula.
//! `{{#formula}}` accepts the same arguments as a placeholder in an [`Entry`], such as
//! `{{#formula contact::penetration: u=u_k}}`.

pub mod bench;
mod claims;
pub mod figure;
mod math;
mod places;
pub mod proofs;
mod source;

use anyhow::{Context, Result};
use math::Typesetter;
use mdbook_preprocessor::{
    Preprocessor, PreprocessorContext,
    book::{Book, Chapter},
};
use places::Places;
use proofs::heading;
use pulldown_cmark::{Event, Parser, Tag};
use regex::{Captures, Regex};
use source::Item;
use spring_mass_contact::claims::{Entry, entries, entry};
use std::path::PathBuf;

/// Returns the numbered equations of the chapter in order, with their LaTeX.
pub fn equations() -> impl Iterator<Item = (&'static Entry, String)> {
    entries().iter().filter_map(|entry| Some((entry, entry.latex()?)))
}

/// Preprocessor that expands the tags of the book.
pub struct Equations;

impl Preprocessor for Equations {
    fn name(&self) -> &str {
        "equations"
    }

    fn run(&self, context: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let tags = tag("eq|ref|source|formula|figure|bench|live")?;
        claims::verify_all()?;
        let expander = TagExpander {
            typesetter: Typesetter::new()?,
            folder: context.root.join("../src/chapter"),
            places: Places::of(&book, &tags)?,
            links_documentation: links_documentation(context)?,
        };
        let mut result = Ok(());
        book.for_each_chapter_mut(|chapter| {
            if result.is_ok() {
                result = expander.process(chapter, &tags).with_context(|| format!("in {}", chapter.name));
            }
        });
        result.map(|()| book)
    }
}

/// Expands the tags of a page.
struct TagExpander {
    typesetter: Typesetter,
    /// Folder with the sources of the chapter, one module per section.
    folder: PathBuf,
    places: Places,
    links_documentation: bool,
}

/// Returns `true` if links to the output of `cargo doc` work: it exists beside the book, and the book is not served,
/// since a server shows nothing outside of it.
fn links_documentation(context: &PreprocessorContext) -> Result<bool> {
    let config = &context.config;
    let served = config.get::<String>("output.html.live-reload-endpoint")?.is_some();
    let book = context.root.join(&config.build.build_dir);
    Ok(!served && book.parent().is_some_and(|target| target.join("doc").join(CRATE).exists()))
}

impl TagExpander {
    fn process(&self, chapter: &mut Chapter, tags: &Regex) -> Result<()> {
        let text = self.typesetter.page(&self.with_back_links(chapter))?;
        let headings: Vec<_> = Parser::new(&text)
            .into_offset_iter()
            .filter_map(|(event, range)| match event {
                Event::Start(Tag::Heading { level, .. }) => Some((range.start, level as usize)),
                _ => None,
            })
            .collect();
        let depth = chapter.path.as_deref().map_or(0, |path| path.components().count().saturating_sub(1));
        let up = "../".repeat(depth);
        chapter.content = replaced(&text, tags, |tag| {
            let before = headings.iter().rfind(|(start, _)| *start < tag.get_match().start());
            self.tag(tag, &up, before.map_or(0, |(_, level)| *level))
        })?;
        Ok(())
    }

    /// Returns the text of a page. On a page of claims it inserts links from each equation to the book, which the stored
    /// page does not have, since it is also read outside of the book.
    fn with_back_links(&self, chapter: &Chapter) -> String {
        let mut text = chapter.content.clone();
        if chapter.path.as_deref().is_some_and(|path| path.starts_with("proofs")) {
            for entry in entries() {
                let Ok(place) = self.places.get(entry.equation) else { continue };
                let heading = format!("\n## {}\n\n", heading(entry));
                text = text.replace(&heading, &format!("{heading}[In the book](../{place}) · "));
            }
        }
        text
    }

    /// Returns the replacement of a tag. `up` is the relative path from the page to the root of the book, and `level` that
    /// of the preceding heading, 0 before the first.
    fn tag(&self, tag: &Captures, up: &str, level: usize) -> Result<String> {
        let name = tag.get(2).map_or("", |name| name.as_str());
        match &tag[1] {
            "eq" => self.equation(entry(name).with_context(|| format!("no equation ({name})"))?, up, level),
            "ref" => Ok(format!("[({name})]({}{})", up, self.places.get(name)?)),
            "source" => self.source(name, up),
            "figure" => self.figure(name),
            "bench" => bench::html(),
            "live" => {
                let (fields, k) =
                    name.split_once(", k=").map_or((name, None), |(fields, k)| (fields, Some(k)));
                bench::live(fields, k.map(str::parse).transpose()?)
            }
            _ => self.typesetter.inline(&tag[0]),
        }
    }

    /// Renders the box of an equation.
    fn equation(&self, entry: &Entry, up: &str, level: usize) -> Result<String> {
        let (number, label) = (entry.equation, entry.label());
        let latex = entry.latex().with_context(|| format!("{label} has no formula"))?;
        let (mut shown, mut folded) = (String::new(), claims::status(entry, up) + "\n\n");
        // A function of several equations is printed with the first and linked from the others.
        for (i, function) in entry.functions.iter().enumerate() {
            let first = places::first_with(function).context("listed")?;
            let item = Item::read(&self.folder, function)?;
            if first != number {
                let printed = format!(", printed at [({first})]({}{})", up, self.places.get(first)?);
                folded += &(self.caption(function, &item, &printed, up)? + "\n");
            } else if let (0, Some(body)) = (i, item.body()) {
                // The line that computes the equation is printed, the rest is folded.
                shown = format!("<div class=\"source\">\n\n{}</div>\n\n", listing(&body));
                folded += &(self.caption(function, &item, "", up)? + "\n" + &listing(&item.code));
            } else {
                folded += &self.source(function, up)?;
            }
        }
        let (level, title, anchor) = ("#".repeat(level + 1), entry.title, places::anchor(number));
        let (formula, count) = (self.typesetter.display(&latex)?, claims::claim_count(entry));
        Ok(format!(
            "\n\n<div class=\"equation\">\n\n{level} Equation {number} · {title} {{#{anchor}}}\n\n\
             <div class=\"formula\">{formula}</div>\n\n{shown}\
             <details class=\"more\"><summary>{count} proved · source</summary>\n\n{folded}</details>\n\n</div>\n\n"
        ))
    }

    fn figure(&self, name: &str) -> Result<String> {
        let figure = figure::figure(name).with_context(|| format!("no figure {name}"))?;
        let (svg, caption) = (figure.inline(), self.typesetter.page(figure.caption)?);
        Ok(format!(
            "\n\n<figure class=\"drawing\" id=\"fig-{name}\">\n{svg}\n<figcaption>{caption}</figcaption>\n</figure>\n\n"
        ))
    }

    /// Renders the body of a function, followed by a folded block with the whole function. A function that no box shows
    /// has an anchor.
    fn source(&self, function: &str, up: &str) -> Result<String> {
        let item = Item::read(&self.folder, function)?;
        let id = match places::first_with(function) {
            None => format!(" id=\"fn-{}\"", function.replace("::", "-")),
            Some(_) => String::new(),
        };
        let whole = listing(&item.code);
        let shown = item.body().map_or(whole.clone(), |body| {
            let body = listing(&body);
            format!("{body}<details><summary>the whole function</summary>\n\n{whole}</details>\n\n")
        });
        let caption = self.caption(function, &item, "", up)?;
        Ok(format!("\n\n<div class=\"source\"{id}>\n{caption}\n{shown}</div>\n\n"))
    }

    /// Returns the caption of a listing: the name of the function, with links to its documentation and source if these
    /// work, and `rest`.
    fn caption(&self, function: &str, item: &Item, rest: &str, up: &str) -> Result<String> {
        let mut links = String::new();
        if self.links_documentation {
            let (module, name) = function.split_once("::").context("a path")?;
            let (docs, kind, (first, last)) = (format!("{}../doc", up), item.kind, item.lines);
            links = format!(
                " · [documentation]({docs}/{CRATE}/chapter/{module}/{kind}.{name}.html) · \
                 [source]({docs}/src/{CRATE}/chapter/{module}.rs.html#{first}-{last})"
            );
        }
        Ok(format!("<div class=\"caption\">\n\n`{function}`{links}{rest}\n\n</div>\n"))
    }
}

/// Name of the crate's folder in the output of `cargo doc`.
const CRATE: &str = "spring_mass_contact";

/// Returns a block of source code, which is not tested here.
fn listing(code: &str) -> String {
    format!("```rust,ignore\n{code}\n```\n\n")
}

/// Replaces each tag by the result of `by`, or returns the first error.
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

/// Returns a pattern for tags of these kinds; their argument may contain braces.
fn tag(kinds: &str) -> Result<Regex> {
    Ok(Regex::new(&format!(r"\{{\{{#({kinds})(?:\s+((?:[^{{}}]|\{{[^{{}}]*\}})+?))?\s*\}}\}}"))?)
}

// The Rust snippets of the pages are compiled and run as documentation tests.
macro_rules! pages {
    ($($page:ident)*) => {
        /// File names of the pages, without `.md`.
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
    introduction notation system structure contact formulations lagrange penalty augmented unilateral
    convergence comparison choice stalls elements command check solvers beyond loose floats proofs
    sources teaching
}

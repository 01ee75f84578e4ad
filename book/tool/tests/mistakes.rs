//! The preprocessor on a single page, and mistakes of an author that stop the build with an error message.

use crate::files::{root, text};
use book_tool::{Equations, equations};
use mdbook_preprocessor::{
    Preprocessor, PreprocessorContext,
    book::{Book, BookItem, Chapter},
    config::Config,
};
use std::{fs, path::Path};

/// Processes a book of one page with these settings.
fn process(text: &str, settings: &[(&str, &str)]) -> Result<String, String> {
    let mut config = Config::default();
    settings.iter().for_each(|(key, value)| config.set(key, value).unwrap());
    let chapter = Chapter::new("Page", text.into(), "page.md", Vec::new());
    let context = PreprocessorContext::new(root().join("book"), config, "html".into());
    let book = Equations
        .run(&context, Book::new_with_items(vec![BookItem::Chapter(chapter)]))
        .map_err(|error| format!("{error:#}"))?;
    Ok(book.chapters().next().unwrap().content.clone())
}

/// Returns the tags of every equation.
fn boxes() -> String {
    equations().map(|(entry, _)| format!("{{{{#eq {}}}}}\n\n", entry.equation)).collect()
}

#[test]
fn valid_page_is_processed() {
    let (_, latex) = equations().find(|(entry, _)| entry.equation == "1.13").unwrap();
    let added = format!("see {{{{#ref 1.13}}}}, {{{{#formula system::gap}}}} and $H - l$ or $${latex}$$");
    let page = process(&(boxes() + &added), &[]).unwrap();
    let (_, added) = page.rsplit_once("see ").unwrap();
    let (reference, rest) = added.split_once(", ").unwrap();
    assert_eq!(reference, "[(1.13)](page.md#eq-1-13)");
    let (formula, rest) = rest.split_once(" and ").unwrap();
    let (written, display) = rest.split_once(" or <span class=\"formula\">").unwrap();
    assert_eq!(formula, written);
    assert!(
        page.contains(&format!("<div class=\"formula\">{}</div>", display.strip_suffix("</span>").unwrap()))
    );
    let source = text("src/chapter/penalty.rs");
    let (_, code) = source.split_once("\npub fn deflection<").unwrap();
    let (code, _) = code.split_once("\n}\n").unwrap();
    assert!(page.contains(&format!("```rust,ignore\npub fn deflection<{code}\n}}\n```\n")));
    assert!(page.contains("```rust,ignore\n(eps * (h - l) + m * g) / (c + eps)\n```\n"));
}

/// A link to documentation that does not exist, or that a server does not show, is not printed.
#[test]
fn links_to_missing_documentation_are_omitted() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("documented");
    let book = folder.join("book");
    let build = ("build.build-dir", book.to_str().unwrap());
    let has_links =
        |settings: &[(&str, &str)]| process(&boxes(), settings).unwrap().contains("[documentation](");
    let _ = fs::remove_dir_all(&folder);
    assert!(!has_links(&[build]), "there is no documentation");
    fs::create_dir_all(folder.join("doc/spring_mass_contact")).unwrap();
    assert!(has_links(&[build]), "documentation beside the book");
    assert!(!has_links(&[build, ("output.html.live-reload-endpoint", "__livereload")]), "a server");
}

#[test]
fn mistakes_are_refused() {
    let refused = [
        ("{{#ref 1.34}}", "no equation (1.34)"),
        ("{{#eq 1.34}}", "no equation (1.34)"),
        ("{{#eq note}}", "no equation (note)"),
        ("{{#eq note 1}}", "note 1 has no formula"),
        ("{{#eq 1.13}}", "{{#eq 1.13}} is displayed twice"),
        ("{{#formula system::nothing}}", "no formula system::nothing"),
        ("{{#formula system::gap: u=v}}", "no formula system::gap: u=v"),
        ("{{#source penalty::nothing}}", "no public function `nothing`"),
        ("{{#source nothing::gap}}", "the module of nothing::gap"),
        ("{{#figure nothing}}", "no figure nothing"),
        (r"$\frac{1}$", r"\frac{1}"),
    ];
    for (text, message) in refused {
        let error = process(&(boxes() + text), &[]).unwrap_err();
        assert!(error.contains(message), "{text}: {error}");
    }
    assert!(process("nothing", &[]).unwrap_err().contains("(1.1) is not displayed"));
}

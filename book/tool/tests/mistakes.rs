//! Mistakes of an author that stop the build with an error message.

use book_tool::{Equations, equations};
use mdbook_preprocessor::{
    Preprocessor, PreprocessorContext,
    book::{Book, BookItem, Chapter},
    config::Config,
};
use regex::Regex;
use std::{fs, path::Path};

/// Returns the tags of every equation.
fn boxes() -> String {
    equations().map(|(entry, _)| format!("{{{{#eq {}}}}}\n\n", entry.equation)).collect()
}

/// Processes a book of one page that displays every equation, followed by `text`.
fn process(text: &str) -> Result<String, String> {
    process_page(&(boxes() + text))
}

fn process_page(text: &str) -> Result<String, String> {
    process_with(text, &[("preprocessor.equations.links-documentation", true.into())])
}

fn process_with(text: &str, settings: &[(&str, serde_json::Value)]) -> Result<String, String> {
    let mut config = Config::default();
    for (key, value) in settings {
        config.set(key, value).unwrap();
    }
    let chapter = Chapter::new("Page", text.into(), "page.md", Vec::new());
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let context = PreprocessorContext::new(root.into(), config, "html".into());
    let book = Equations
        .run(&context, Book::new_with_items(vec![BookItem::Chapter(chapter)]))
        .map_err(|error| format!("{error:#}"))?;
    Ok(book.chapters().next().unwrap().content.clone())
}

fn assert_refused(text: &str, message: &str) {
    let error = process(text).unwrap_err();
    assert!(error.contains(message), "{error}");
}

#[test]
fn valid_page_is_processed() {
    let page = process("see {{#ref 1.13}}").unwrap();
    assert!(page.ends_with("see [(1.13)](page.md#eq-1-13)"), "{page}");
    assert!(page.contains("(eps * (h - l) + m * g) / (c + eps)"));
}

#[test]
fn box_shows_formula_and_source_lines() {
    let page = process("").unwrap();
    let lines = Regex::new(r"/chapter/(\w+)\.rs\.html#(\d+)-(\d+)\)\n").unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../src/chapter");
    let boxes: Vec<_> = page.split("<div class=\"equation\">").skip(1).collect();
    let mut seen = 0;
    for ((entry, latex), html) in equations().zip(boxes) {
        // The box typesets the formula like a display formula of a page.
        let alone = process(&format!("$${latex}$$")).unwrap();
        let formula =
            alone.rsplit_once("<span class=\"formula\">").unwrap().1.strip_suffix("</span>").unwrap();
        assert!(html.contains(&format!("<div class=\"formula\">{formula}</div>")), "{}", entry.label());
        for function in &entry.functions {
            assert!(
                html.contains(&format!("`{function}` · [documentation](")),
                "{}: {function}",
                entry.label()
            );
        }
        for shown in html.split("<div class=\"source\"").skip(1) {
            let found = lines.captures(shown).expect("lines");
            let file = fs::read_to_string(root.join(format!("{}.rs", &found[1]))).unwrap();
            let [first, last] = [2, 3].map(|i| found[i].parse::<usize>().unwrap());
            let code: Vec<_> = file.lines().skip(first - 1).take(last + 1 - first).collect();
            let code = format!("```rust,ignore\n{}\n```", code.join("\n"));
            assert!(shown.contains(&code), "{}: {}", entry.label(), &found[0]);
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen}");
}

/// A link to documentation that does not exist, or that a server does not show, is not printed.
#[test]
fn links_to_missing_documentation_are_omitted() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("documented");
    let has_links = |settings: &[(&str, &str)]| {
        let settings: Vec<_> = settings.iter().map(|(key, value)| (*key, (*value).into())).collect();
        process_with(&boxes(), &settings).unwrap().contains("[documentation](")
    };
    let book = folder.join("book");
    let build = ("build.build-dir", book.to_str().unwrap());
    let _ = fs::remove_dir_all(&folder);
    assert!(!has_links(&[build]), "there is no documentation");
    fs::create_dir_all(folder.join("doc/spring_mass_contact")).unwrap();
    assert!(has_links(&[build]), "documentation beside the book");
    assert!(!has_links(&[build, ("output.html.live-reload-endpoint", "__livereload")]), "a server");
}

#[test]
fn unknown_reference_is_refused() {
    assert_refused("{{#ref 1.34}}", "no equation (1.34)");
}

#[test]
fn unknown_equation_is_refused() {
    assert_refused("{{#eq 1.34}}", "no equation (1.34)");
}

#[test]
fn entry_without_formula_is_refused() {
    assert_refused("{{#eq note}}", "no equation (note)");
    assert_refused("{{#eq note 1}}", "note 1 has no formula");
}

#[test]
fn formula_tag_works_outside_of_math() {
    let page = process("the gap {{#formula system::gap}} is").unwrap();
    assert_eq!(
        page.rsplit_once("the gap ").unwrap().1,
        process("$H - l$ is").unwrap().rsplit_once("\n\n").unwrap().1
    );
    assert_refused("{{#formula system::nothing}}", "no formula system::nothing");
    assert_refused("{{#formula system::gap: u=v}}", "no formula system::gap: u=v");
}

#[test]
fn duplicate_equation_is_refused() {
    assert_refused("{{#eq 1.13}}", "(1.13) is displayed twice");
}

#[test]
fn missing_equation_is_refused() {
    assert!(process_page("nothing").unwrap_err().contains("(1.1) is not displayed"));
}

#[test]
fn unknown_function_is_refused() {
    assert_refused("{{#source penalty::nothing}}", "no public function `nothing`");
    assert_refused("{{#source nothing::gap}}", "the module of nothing::gap");
}

#[test]
fn unknown_figure_is_refused() {
    assert_refused("{{#figure nothing}}", "no figure nothing");
}

#[test]
fn invalid_formula_is_refused() {
    assert_refused(r"$\frac{1}$", r"\frac{1}");
}

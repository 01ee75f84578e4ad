//! Links between the book and the crate's documentation, in both directions for each function.
//!
//! Both are in `target`, as `book` and `doc`.

use super::{values, with_extension};
use crate::files::{files, root, text};
use book_tool::equations;
use regex::Regex;
use std::{collections::BTreeMap, fs, path::Path};

const CRATE: &str = "spring_mass_contact";

/// Returns `true` if the sources contain the target of a link to `../doc/…`.
///
/// The target is a function's page, or the lines of a function on the page of a file.
pub fn is_documented(link: &str) -> bool {
    shows_page(link).or_else(|| shows_lines(link)).unwrap_or(false)
}

fn shows_page(link: &str) -> Option<bool> {
    let path = link.strip_prefix("../doc/")?.strip_prefix(CRATE)?.strip_prefix("/chapter/")?;
    let (module, page) = path.strip_suffix(".html")?.split_once('/')?;
    let (kind, name) = page.split_once('.')?;
    let begins = |line: &str| {
        let rest = line.strip_prefix("pub ")?.strip_prefix(kind)?.strip_prefix(' ')?.strip_prefix(name)?;
        Some(rest.starts_with(['<', '(', ' ']))
    };
    Some(text(format!("src/chapter/{module}.rs")).lines().any(|line| begins(line) == Some(true)))
}

fn shows_lines(link: &str) -> Option<bool> {
    let path = link.strip_prefix("../doc/src/")?.strip_prefix(CRATE)?;
    let (file, lines) = path.strip_prefix('/')?.split_once(".html#")?;
    let (first, last) = lines.split_once('-')?;
    let [first, last] = [first, last].map(|line| line.parse::<usize>().unwrap() - 1);
    let file = text(root().join("src").join(file));
    let lines: Vec<_> = file.lines().skip(first).take(last + 1 - first).collect();
    // No other item begins or ends in between.
    let end = lines.iter().position(|line| *line == "}");
    Some(lines[0].starts_with("pub ") && end == Some(last - first))
}

/// Returns the links of a box in order: documentation and source lines of each function.
fn links(html: &str) -> Vec<(&str, &str)> {
    let documented: Vec<_> =
        values(html, "href").into_iter().filter(|link| link.starts_with("../doc/")).collect();
    documented.chunks(2).map(|pair| (pair[0], pair[1])).collect()
}

#[test]
fn source_links_lead_to_the_named_function() {
    let mut seen = 0;
    for (_, html) in with_extension("html").filter(|(path, _)| !path.ends_with("print.html")) {
        for (page, lines) in links(html) {
            let name = page.rsplit('.').nth(1).unwrap();
            let (file, first) = lines.split_once(".html#").unwrap();
            let first: usize = first.split('-').next().unwrap().parse().unwrap();
            let file =
                text(root().join("src").join(file.split_once(CRATE).unwrap().1.trim_start_matches('/')));
            let line = file.lines().nth(first - 1).unwrap();
            let named = line
                .split_once(&format!(" {name}"))
                .is_some_and(|(_, rest)| rest.starts_with(['<', '(', ' ']));
            assert!(named, "{page}, {lines}: {line}");
            seen += 1;
        }
    }
    assert!(seen > 50, "{seen}");
}

/// Returns the page and anchor at which the book prints each function of the chapter, such as `penalty::deflection`.
fn printed() -> BTreeMap<String, String> {
    let mark = Regex::new(&format!(
        r#"id="((?:eq|fn)-[\w-]+)"|href="\.\./doc/{CRATE}/chapter/(\w+)/\w+\.(\w+)\.html"[^\n]*(, printed at)?"#
    ))
    .unwrap();
    let mut printed = BTreeMap::new();
    for (path, html) in with_extension("html").filter(|(path, _)| !path.ends_with("print.html")) {
        let mut address = "";
        for found in mark.captures_iter(html) {
            if let Some(id) = found.get(1) {
                address = id.as_str();
            } else if !found[0].contains(", printed at") {
                let function = format!("{}::{}", &found[2], &found[3]);
                let place = format!("{}#{address}", path.display());
                // A page may show a function of a box again; the box takes precedence.
                let old = printed.insert(function.clone(), place.clone());
                if let Some(old) = old.filter(|old| old.contains("#eq-")) {
                    printed.insert(function, old);
                }
            }
        }
    }
    assert!(printed.len() > 50, "{}", printed.len());
    printed
}

/// With `UPDATE=1` the links are written.
#[test]
fn documentation_of_each_function_links_to_its_box() {
    let update = std::env::var_os("UPDATE").is_some();
    let printed = printed();
    for entry in fs::read_dir(root().join("src/chapter")).unwrap() {
        let path = entry.unwrap().path();
        let module = path.file_stem().unwrap().to_str().unwrap();
        let (mut found, mut expected) = (text(&path), String::new());
        let link = |line: &str| line.starts_with("/// [In the book](");
        for line in found.lines().filter(|line| !link(line)) {
            let item = line.strip_prefix("pub fn ").or(line.strip_prefix("pub struct "));
            let name = item.and_then(|rest| rest.split(['<', '(', ' ']).next());
            if let Some(place) = name.and_then(|name| printed.get(&format!("{module}::{name}"))) {
                let back = format!("/// [In the book](../../../../book/{place})\n");
                // The link is the last line of the comment, before attributes.
                let attributes = expected
                    .lines()
                    .rev()
                    .take_while(|line| !line.starts_with("///"))
                    .map(|line| line.len() + 1);
                let at = expected.len() - attributes.sum::<usize>();
                expected.insert_str(at, &back);
            }
            expected += line;
            expected.push('\n');
        }
        if update {
            fs::write(&path, &expected).unwrap();
            found.clone_from(&expected);
        }
        let line = 1 + found.lines().zip(expected.lines()).take_while(|(a, b)| a == b).count();
        assert!(
            found == expected,
            "src/chapter/{module}.rs:{line}: the documentation of each function has to end with a link to the book; \
             UPDATE=1 cargo test -p book-tool book:: writes it"
        );
    }
}

/// Checks the output of `cargo doc` and `mdbook build`, which have to run first.
#[test]
#[ignore = "needs target/doc and target/book"]
fn built_book_and_documentation_link_to_each_other() {
    let target = root().join("target");
    let (mut forward, mut back) = (0, 0);
    let check = |page: &Path, link: &str, count: &mut usize| {
        let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
        let html = text(page.parent().unwrap().join(file));
        let has = |id: &str| html.contains(&format!("id=\"{id}\"")) || html.contains(&format!("id={id}"));
        // A range of lines is identified by its ends.
        let ids = if link.contains("/src/") { anchor.split('-').collect() } else { vec![anchor] };
        assert!(ids.iter().all(|id| id.is_empty() || has(id)), "{}: no {link}", page.display());
        *count += 1;
    };
    for page in files(&target.join("book"), ".html") {
        let html = text(&page);
        values(&html, "href")
            .into_iter()
            .filter(|link| link.contains("../doc/"))
            .for_each(|link| check(&page, link, &mut forward));
    }
    for page in files(&target.join(format!("doc/{CRATE}/chapter")), ".html") {
        let html = text(&page);
        values(&html, "href")
            .into_iter()
            .filter(|link| link.contains("/book/"))
            .for_each(|link| check(&page, link, &mut back));
    }
    assert!(forward > 100 && back > 50, "{forward} links to the documentation, {back} back");
}

/// A search for 1.13 finds its box first, since matches in titles are ranked first.
#[test]
#[ignore = "needs target/book"]
fn search_index_has_each_equation_number() {
    let index = files(&root().join("target/book"), ".js");
    let index = index.iter().find(|path| path.to_str().unwrap().contains("searchindex")).expect("an index");
    let index = text(index);
    let json = index.split_once("JSON.parse('").unwrap().1.rsplit_once("')").unwrap().0;
    let json = json.replace("\\'", "'").replace("\\\\", "\\");
    let search: serde_json::Value = serde_json::from_str(&json).unwrap();
    let documents = search["index"]["documentStore"]["docs"].as_object().unwrap();
    for (entry, _) in equations() {
        let number = entry.equation;
        let word = |title: &str| {
            title.split_whitespace().any(|word| word.trim_matches(['(', ')', ',', ':']) == number)
        };
        let found = documents.iter().filter(|(_, document)| word(document["title"].as_str().unwrap()));
        let found: Vec<_> =
            found.map(|(id, _)| search["doc_urls"][id.parse::<usize>().unwrap()].as_str()).collect();
        let id = format!("#eq-{}", number.replace('.', "-"));
        assert!(matches!(found[..], [Some(url)] if url.ends_with(&id)), "{number}: {found:?}");
    }
}

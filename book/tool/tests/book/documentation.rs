//! Links between the book and the crate's documentation, in both directions for each function.
//!
//! Both are in `target`, as `book` and `doc`.

use super::{pages, values};
use crate::files::{files, root, text};
use book_tool::equations;
use regex::Regex;
use std::{collections::BTreeMap, fs};

const CRATE: &str = "spring_mass_contact";

/// The links of a caption lead to the page of the function and to its lines in the source.
#[test]
fn captions_link_to_the_named_function() {
    let caption = r#"<code>(\w+)::(\w+)</code> · <a href="../doc/CRATE/chapter/(\w+)/(fn|struct).(\w+).html">documentation</a> · <a href="../doc/src/CRATE/chapter/(\w+).rs.html#(\d+)-(\d+)">source</a>"#;
    let caption = Regex::new(&caption.replace("CRATE", CRATE)).unwrap();
    for (path, html) in pages() {
        let captions: Vec<_> = caption.captures_iter(html).collect();
        assert_eq!(2 * captions.len(), html.matches("\"../doc/").count(), "{}", path.display());
        for found in captions {
            let [module, name, kind, first, last] = [1, 2, 4, 7, 8].map(|i| &found[i]);
            assert_eq!([module, module, name], [3, 6, 5].map(|i| &found[i]));
            let file = text(format!("src/chapter/{module}.rs"));
            let [first, last] = [first, last].map(|line| line.parse::<usize>().unwrap());
            let lines: Vec<_> = file.lines().skip(first - 1).take(last - first + 1).collect();
            let rest = lines[0].strip_prefix(&format!("pub {kind} {name}"));
            // No other item begins or ends in between.
            let is_whole = lines.iter().position(|line| *line == "}") == Some(last - first);
            assert!(is_whole && rest.is_some_and(|rest| rest.starts_with(['<', '(', ' '])), "{}", &found[0]);
        }
    }
}

/// Returns the page and anchor at which the book prints each function of the chapter, such as `penalty::deflection`.
fn printed() -> BTreeMap<String, String> {
    let mark = r#"id="((?:eq|fn)-[\w-]+)"|<code>(\w+::\w+)</code> · <a href="../doc/[^\n]*source</a>(, printed at)?"#;
    let mark = Regex::new(mark).unwrap();
    let mut printed: BTreeMap<String, String> = BTreeMap::new();
    for (path, html) in pages() {
        let mut address = "";
        for found in mark.captures_iter(html) {
            if let Some(id) = found.get(1) {
                address = id.as_str();
            } else if found.get(3).is_none() && printed.get(&found[2]).is_none_or(|old| !old.contains("#eq-"))
            {
                // A page may show a function of a box again; the box takes precedence.
                printed.insert(found[2].into(), format!("{}#{address}", path.display()));
            }
        }
    }
    assert!(printed.len() > 50, "{}", printed.len());
    printed
}

/// With `UPDATE=1` the links are written.
#[test]
fn documentation_of_each_function_links_to_its_box() {
    let printed = printed();
    for path in files(&root().join("src/chapter"), ".rs") {
        let module = path.file_stem().unwrap().to_str().unwrap();
        let found = text(&path);
        let is_link = |line: &&str| line.starts_with("/// [In the book](");
        let mut lines: Vec<_> = found.lines().filter(|line| !is_link(line)).map(String::from).collect();
        for i in (0..lines.len()).rev() {
            let item = lines[i].strip_prefix("pub fn ").or(lines[i].strip_prefix("pub struct "));
            let name = item.and_then(|rest| rest.split(['<', '(', ' ']).next());
            if let Some(place) = name.and_then(|name| printed.get(&format!("{module}::{name}"))) {
                // The link is the last line of the comment, before attributes.
                let last = lines[..i].iter().rposition(|line| line.starts_with("///")).expect("a comment");
                lines.insert(last + 1, format!("/// [In the book](../../../../book/{place})"));
            }
        }
        let expected = lines.join("\n") + "\n";
        let line = 1 + found.lines().zip(expected.lines()).take_while(|(a, b)| a == b).count();
        if std::env::var_os("UPDATE").is_some() {
            fs::write(&path, &expected).unwrap();
            continue;
        }
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
    for (folder, other, least) in
        [("book".to_string(), "../doc/", 100), (format!("doc/{CRATE}/chapter"), "/book/", 50)]
    {
        let mut count = 0;
        for page in files(&target.join(folder), ".html") {
            for link in values(&text(&page), "href").into_iter().filter(|link| link.contains(other)) {
                let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
                let html = text(page.parent().unwrap().join(file));
                let has =
                    |id: &str| html.contains(&format!("id=\"{id}\"")) || html.contains(&format!("id={id}"));
                // A range of lines is identified by its ends.
                let ids = if link.contains("/src/") { anchor.split('-').collect() } else { vec![anchor] };
                assert!(ids.iter().all(|id| id.is_empty() || has(id)), "{}: no {link}", page.display());
                count += 1;
            }
        }
        assert!(count > least, "{count} links to {other}");
    }
}

/// A search for 1.13 finds its box first, since matches in titles are ranked first.
#[test]
#[ignore = "needs target/book"]
fn search_index_has_each_equation_number() {
    let scripts = files(&root().join("target/book"), ".js");
    let index = scripts.iter().find(|path| path.to_str().unwrap().contains("searchindex")).expect("an index");
    let json = text(index).replace("\\'", "'").replace("\\\\", "\\");
    let json = json.split_once("JSON.parse('").unwrap().1.rsplit_once("')").unwrap().0;
    let search: serde_json::Value = serde_json::from_str(json).unwrap();
    let documents = search["index"]["documentStore"]["docs"].as_object().unwrap();
    for (entry, _) in equations() {
        let is_word = |title: &str| title.split([' ', '(', ')', ',', ':']).any(|word| word == entry.equation);
        let found = documents.iter().filter(|(_, document)| is_word(document["title"].as_str().unwrap()));
        let found: Vec<_> = found.map(|(id, _)| &search["doc_urls"][id.parse::<usize>().unwrap()]).collect();
        let id = format!("#eq-{}", entry.equation.replace('.', "-"));
        let is_box = |url: &serde_json::Value| url.as_str().unwrap().ends_with(&id);
        assert!(found.len() == 1 && is_box(found[0]), "{}: {found:?}", entry.equation);
    }
}

//! Tests of the whole book, which is built in process.

mod contrast;
mod documentation;

use crate::files::{files, root};
use book_tool::{Equations, PAGES, bench, equations, figure};
use mdbook_driver::MDBook;
use regex::Regex;
use spring_mass_contact::claims::{Entry, entries};
use spring_mass_contact::verify::claim_names;
use std::{
    collections::{BTreeMap, BTreeSet, HashSet},
    fs,
    path::{Path, PathBuf},
    sync::LazyLock,
};

/// Generated files with their text, which is empty for binary files.
static FILES: LazyLock<BTreeMap<PathBuf, String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    let _ = fs::remove_dir_all(&folder);
    let mut book = MDBook::load(root().join("book")).expect("the book loads");
    book.config.build.build_dir = folder.clone();
    // Links to the documentation are printed if it is beside the book.
    fs::create_dir_all(folder.with_file_name("doc/spring_mass_contact")).unwrap();
    book.with_preprocessor(Equations).build().expect("the book builds");
    let named = |path: PathBuf| {
        let name = path.strip_prefix(&folder).unwrap().into();
        (name, fs::read_to_string(&path).unwrap_or_default())
    };
    files(&folder, "").into_iter().map(named).collect()
});

fn with_extension(extension: &str) -> impl Iterator<Item = (&'static PathBuf, &'static String)> {
    FILES.iter().filter(move |(path, _)| path.extension().is_some_and(|e| e == extension))
}

/// Returns the pages, without that for printing, which repeats them.
fn pages() -> impl Iterator<Item = (&'static PathBuf, &'static String)> {
    with_extension("html").filter(|(path, _)| !path.ends_with("print.html"))
}

/// Returns the values of an attribute in a page.
fn values<'a>(html: &'a str, attribute: &str) -> Vec<&'a str> {
    let pattern = Regex::new(&format!(r#"[\s"]{attribute}="([^"]*)""#)).unwrap();
    pattern.captures_iter(html).map(|found| found.get(1).unwrap().as_str()).collect()
}

/// Resolves a relative link in `file`.
fn resolve(file: &Path, link: &str) -> PathBuf {
    let mut target = file.parent().unwrap().to_path_buf();
    for part in link.split('/') {
        match part {
            "." => {}
            ".." => assert!(target.pop(), "{}: {link} leaves the book", file.display()),
            name => target.push(name),
        }
    }
    target
}

#[test]
fn every_page_is_in_the_summary_and_in_pages() {
    let source = root().join("book/src");
    let mut written: BTreeSet<_> =
        files(&source, ".md").iter().map(|path| path.strip_prefix(&source).unwrap().to_path_buf()).collect();
    assert!(written.remove(Path::new("SUMMARY.md")));
    let loaded = MDBook::load(root().join("book")).unwrap();
    let summary: BTreeSet<_> = loaded.book.chapters().map(|chapter| chapter.path.clone().unwrap()).collect();
    assert_eq!(written, summary, "files, summary");
    // The pages of proofs are generated, and have no snippets.
    written.retain(|path| !path.starts_with("proofs"));
    let listed: BTreeSet<_> = PAGES.iter().map(|page| PathBuf::from(format!("{page}.md"))).collect();
    assert_eq!(written, listed, "files, PAGES");
}

/// Returns the entries with the items of their sections on the pages of claims.
fn claim_sections() -> impl Iterator<Item = (&'static Entry, Vec<&'static str>)> {
    let pages = pages().filter(|(path, _)| path.starts_with("proofs"));
    pages.flat_map(|(_, html)| html.split("<h2 id=").skip(1)).map(|section| {
        let (heading, section) = section.split_once("</h2>").unwrap();
        let entry = entries().iter().find(|entry| heading.contains(&format!(">{} ", entry.label())));
        (
            entry.unwrap_or_else(|| panic!("no entry has the heading {heading}")),
            section.split("<li>").skip(1).collect(),
        )
    })
}

/// Returns the heading with this id and the text after it.
fn find_heading<'a>(html: &'a str, id: &str) -> (&'a str, &'a str) {
    let (_, rest) = html.split_once(&format!(" id=\"{id}\"><a class=\"header\"")).expect("a heading");
    let (heading, rest) = rest.split_once("</a>").unwrap();
    (heading.split_once('>').unwrap().1, rest)
}

fn is_tested(item: &&str) -> bool {
    item.contains("</em>, tested: ")
}

/// The pages of claims have every claim, proved or tested, with its statement.
#[test]
fn pages_of_claims_are_complete() {
    let item =
        Regex::new(r"(?s)^<em>([^<]*)</em>(, tested: \w|: <code>|: two functions compute <code>|: the)")
            .unwrap();
    for (entry, items) in claim_sections() {
        let name = |text: &&str| {
            let found = item.captures(text).unwrap_or_else(|| panic!("{}: {text}", entry.label()));
            found.get(1).unwrap().as_str().to_string()
        };
        let proved = items.iter().filter(|item| !is_tested(item)).count();
        let mut names: Vec<_> = items.iter().map(name).collect();
        let mut expected = claim_names(entry.equation);
        names.sort_unstable();
        expected.sort_unstable();
        assert_eq!(proved, entry.claims.len(), "{}", entry.label());
        assert_eq!(names, expected, "{}", entry.label());
    }
    let sections = claim_sections().map(|(entry, _)| entry.equation);
    let with_claims = entries().iter().map(|entry| entry.equation).filter(|it| !claim_names(it).is_empty());
    assert_eq!(sections.collect::<BTreeSet<_>>(), with_claims.collect());
}

/// The heading of a box is one level below that of its section, and its status agrees with the claims to which it links.
#[test]
fn boxes_agree_with_the_pages_of_claims() {
    let heading = Regex::new(r#"<h([1-6])[^>]* id="([^"]*)""#).unwrap();
    let status =
        r#"(?s)<div class="status">\s*<p><a href="([^#"]*)#([^"]*)">(\d+) claims?</a> proved(.*?)</p>"#;
    let status = Regex::new(status).unwrap();
    let mut boxes = BTreeSet::new();
    for (path, html) in pages().filter(|(path, _)| !path.ends_with("index.html")) {
        let headings = heading.captures_iter(html).map(|found| (found[1].parse::<u32>().unwrap(), found));
        let (shown, sections): (Vec<_>, Vec<_>) =
            headings.partition(|(_, found)| found[2].starts_with("eq-"));
        for (level, found) in shown {
            let number = found[2].replace("eq-", "").replace('-', ".");
            let section =
                sections.iter().rfind(|(_, section)| section.get_match().start() < found.get_match().start());
            assert_eq!(section.unwrap().0 + 1, level, "{}: ({number})", path.display());
            let (entry, items) = claim_sections().find(|(entry, _)| entry.equation == number).unwrap();
            let (title, rest) = find_heading(html, &found[2]);
            assert_eq!(title, format!("Equation {number} · {}", entry.title));
            let found = status.captures(rest).unwrap();
            let claims = find_heading(&FILES[Path::new(&found[1])], &found[2]).0;
            assert_eq!(claims, format!("{} {}", entry.label(), entry.title));
            let (tested, proved): (Vec<_>, Vec<_>) = items.into_iter().partition(is_tested);
            assert_eq!(found[3].parse(), Ok(proved.len()), "({number})");
            let tested_too = format!(", {} only tested", tested.len());
            assert_eq!(found[4], if tested.is_empty() { String::new() } else { tested_too }, "({number})");
            boxes.insert(number);
        }
    }
    assert_eq!(boxes.len(), equations().count());
}

/// The claims of each entry link back to the book.
#[test]
fn claims_link_back_to_the_book() {
    let pages: String =
        pages().filter(|(path, _)| path.starts_with("proofs")).map(|(_, html)| html.as_str()).collect();
    for (entry, _) in equations() {
        let (number, id) = (entry.equation, entry.equation.replace('.', "-"));
        let back = format!("#eq-{id}\">In the book</a> · <code>contact prove {number}</code>");
        assert_eq!(pages.matches(&back).count(), 1, "{}", entry.label());
    }
}

#[test]
fn all_tags_and_formulas_are_replaced() {
    let code = Regex::new(r"(?s)<(code|script)[ >].*?</(code|script)>").unwrap();
    for (path, html) in pages() {
        assert!(!html.contains("{{#"), "{}: a tag is left", path.display());
        // A search would find the words of LaTeX.
        let is_left = html.contains("<annotation") || code.replace_all(html, "").contains('$');
        assert!(!is_left, "{}: LaTeX is left", path.display());
    }
}

#[test]
fn every_link_has_a_target() {
    let ids: BTreeMap<_, HashSet<_>> = with_extension("html")
        .map(|(path, html)| (path.as_path(), values(html, "id").into_iter().collect()))
        .collect();
    for (page, html) in with_extension("html") {
        assert!(
            page.ends_with("print.html") || ids[page.as_path()].len() == values(html, "id").len(),
            "{}: an id is repeated",
            page.display()
        );
        for id in values(html, "aria-labelledby").into_iter().flat_map(|ids| ids.split(' ')) {
            assert!(ids[page.as_path()].contains(id), "{}: no element {id}", page.display());
        }
        for link in values(html, "href").into_iter().chain(values(html, "src")) {
            // `documentation` checks the links to the documentation.
            if link.starts_with("https://") || link.starts_with("../doc/") {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let file = file.split_once('?').map_or(file, |(file, _)| file);
            let target = if file.is_empty() { page.clone() } else { resolve(page, file) };
            assert!(FILES.contains_key(&target), "{}: no file {link}", page.display());
            let known = anchor.is_empty() || ids[target.as_path()].contains(anchor);
            assert!(known, "{}: no anchor {link}", page.display());
        }
    }
    let shown: Vec<_> = pages()
        .filter(|(path, _)| !path.ends_with("index.html"))
        .flat_map(|(_, html)| values(html, "id"))
        .collect();
    for name in figure::names() {
        let id = format!("fig-{name}");
        assert_eq!(
            shown.iter().filter(|shown| **shown == id).count(),
            1,
            "a page has to show the figure {name}"
        );
    }
}

#[test]
fn bench_is_on_its_page_unchanged() {
    let script = format!("<script>\n{}</script>\n", bench::script().unwrap());
    for page in ["augmented", "contact", "convergence", "introduction", "penalty"] {
        assert!(
            FILES[Path::new(&format!("{page}.html"))].contains(&script),
            "{page}: the script has changed"
        );
    }
}

/// A text that refers to a live figure is hidden until the script, which follows it, shows both; and the figure that
/// the live one replaces is directly before it.
#[test]
fn texts_on_live_figures_are_hidden_without_scripts() {
    let live = Regex::new(r#"<div class="bench(?: bench-small[^"]*)?"[^>]*></div>"#).unwrap();
    let mut count = 0;
    for (path, html) in pages() {
        let Some(found) = live.find(html) else { continue };
        let (before, _) = html.split_at(found.start());
        let (_, text) = before.rsplit_once("<div class=\"bench-text\" hidden").expect("a text");
        let (_, between) = text.split_once("</div>").unwrap();
        let is_replaced =
            between.trim_start().starts_with("<figure") && between.trim_end().ends_with("</figure>");
        assert!(is_replaced || path.ends_with("convergence.html"), "{}: {between}", path.display());
        count += 1;
    }
    // The introduction is also the first page.
    assert_eq!(count, 6);
}

#[test]
fn no_external_resources_are_loaded() {
    let fetching =
        Regex::new(r#"<(script|link|img|iframe|source|object)\b[^>]*(src|href|data)="(https?:)?//"#).unwrap();
    for (path, html) in with_extension("html") {
        assert!(!fetching.is_match(html), "{}: {:?}", path.display(), fetching.find(html));
    }
    let url = Regex::new(r#"url\(['"]?([^'")]+)"#).unwrap();
    let mut files = BTreeSet::new();
    for (path, css) in with_extension("css") {
        for target in url.captures_iter(css).map(|found| found.get(1).unwrap().as_str()) {
            if target.starts_with("data:") {
                continue;
            }
            let file = resolve(path, target);
            assert!(FILES.contains_key(&file), "{}: no file {target}", path.display());
            files.insert(file);
        }
    }
    for font in ["STIXTwoMath.woff2", "STIXTwoMath-Italic.woff2"] {
        assert!(files.contains(&Path::new("math").join(font)), "{font} is missing");
    }
}

/// A character outside of the font would be taken from another one: `book/math_fonts.py` adds it.
#[test]
fn font_of_formulas_contains_their_characters() {
    let contained: BTreeSet<_> = FILES[Path::new("math/characters.txt")].chars().collect();
    let formula = Regex::new(r"(?s)<math.*?</math>").unwrap();
    let tag = Regex::new(r"<[^>]*>|&\w+;").unwrap();
    for (path, html) in with_extension("html") {
        for found in formula.find_iter(html) {
            let text = tag.replace_all(found.as_str(), "");
            for c in text.chars() {
                assert!(contained.contains(&c), "{}: {c:?} in {text}", path.display());
            }
        }
    }
}

/// The pages on finite elements and on their penalty explain their own letters, those of matrices.
#[test]
fn every_letter_of_a_formula_is_on_the_page_of_notation() {
    // Upright Latin letters are units, except for Euler's number.
    let letter = Regex::new(r#"<mi>\w</mi>|<mi mathvariant="normal">(?:e|[^[:ascii:]])</mi>"#).unwrap();
    let letters = |html| -> BTreeSet<_> { letter.find_iter(html).map(|found| found.as_str()).collect() };
    // The symbol at the start of a row, up to an equals sign.
    let rows = FILES[Path::new("notation.html")].split("<tr><td>").skip(1);
    let symbols = rows.map(|row| row.split("</td>").next().unwrap().split("<mo>=</mo>").next().unwrap());
    let explained: BTreeSet<_> = symbols.flat_map(letters).collect();
    for page in PAGES.iter().filter(|page| !["notation", "elements", "choice"].contains(page)) {
        let used = letters(&FILES[Path::new(&format!("{page}.html"))]);
        let missing: Vec<_> = used.difference(&explained).collect();
        assert!(missing.is_empty(), "{page}: not on the page of notation: {missing:?}");
    }
}

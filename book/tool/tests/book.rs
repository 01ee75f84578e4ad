//! Tests of the whole book, which is built in process.

mod contrast;
mod documentation;

use book_tool::{Equations, PAGES, bench, equations};
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

fn book() -> PathBuf {
    crate::files::root().join("book")
}

/// Generated files with their text, which is empty for binary files.
static FILES: LazyLock<BTreeMap<PathBuf, String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    let _ = fs::remove_dir_all(&folder);
    let mut book = MDBook::load(book()).expect("the book loads");
    book.config.build.build_dir = folder.clone();
    fs::create_dir_all(folder.with_file_name("doc/spring_mass_contact")).expect("a folder for links");
    book.with_preprocessor(Equations).build().expect("the book builds");
    let mut files = BTreeMap::new();
    read(&folder, &folder, &mut files);
    files
});

fn read(root: &Path, folder: &Path, files: &mut BTreeMap<PathBuf, String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            read(root, &path, files);
        } else {
            let name = path.strip_prefix(root).unwrap().into();
            files.insert(name, fs::read_to_string(&path).unwrap_or_default());
        }
    }
}

fn with_extension(extension: &str) -> impl Iterator<Item = (&'static PathBuf, &'static String)> {
    FILES.iter().filter(move |(path, _)| path.extension().is_some_and(|e| e == extension))
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
fn every_equation_is_displayed_once() {
    let expected: Vec<_> = (1..=33).map(|n| format!("1.{n}")).collect();
    assert_eq!(equations().map(|(entry, _)| entry.equation).collect::<Vec<_>>(), expected);
    for number in expected {
        let id = format!("eq-{}", number.replace('.', "-"));
        let pages: Vec<_> = PAGES
            .iter()
            .flat_map(|page| {
                let html = &FILES[Path::new(&format!("{page}.html"))];
                values(html, "id").into_iter().filter(|found| *found == id).map(move |_| page)
            })
            .collect();
        assert_eq!(pages.len(), 1, "({number}) is displayed on {pages:?}");
    }
}

#[test]
fn every_page_is_in_the_summary_and_in_pages() {
    let listed: BTreeSet<_> = PAGES.iter().map(|page| format!("{page}.md")).collect();
    let pages = |folder: &str| -> BTreeSet<String> {
        let entries = fs::read_dir(book().join("src").join(folder)).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let names = names.filter(|name| name.ends_with(".md") && name != "SUMMARY.md");
        names.map(|name| format!("{folder}{name}")).collect()
    };
    // The pages of proofs are generated, and have no snippets.
    let (written, generated) = (pages(""), pages("proofs/"));
    let loaded = MDBook::load(book()).unwrap();
    let summary: BTreeSet<_> =
        loaded.book.chapters().map(|c| c.path.as_ref().unwrap().display().to_string()).collect();
    assert_eq!(&written | &generated, summary, "files, summary");
    assert_eq!(written, listed, "files, PAGES");
}

#[test]
fn no_claim_is_open() {
    let mut boxes = 0;
    for (path, html) in with_extension("html") {
        assert!(!html.contains("class=\"open\""), "{}: a claim is open", path.display());
        boxes += html.matches("class=\"equation\"").count();
    }
    assert_eq!(boxes, 2 * equations().count(), "each box is on its page and on the page for printing");
}

/// Returns the entries with their sections on the page of claims.
fn claim_sections() -> impl Iterator<Item = (&'static Entry, &'static str)> {
    FILES[Path::new("claims.html")].split("<h3").skip(1).map(|section| {
        let heading = section.split("</h3>").next().unwrap();
        let entry = entries().iter().find(|entry| heading.contains(&format!(">{} ", entry.label())));
        (entry.unwrap_or_else(|| panic!("no entry has the heading {heading}")), section)
    })
}

#[test]
fn every_claim_is_on_the_page_of_claims_with_its_proof() {
    let item = Regex::new(r"<li><strong>([^<]*)</strong>").unwrap();
    let mut seen = 0;
    for (entry, section) in claim_sections() {
        let mut found: Vec<_> =
            item.captures_iter(section).map(|found| found.get(1).unwrap().as_str()).collect();
        let mut expected = claim_names(entry.equation);
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected, "{}", entry.label());
        let proofs = entry.claims.len();
        assert_eq!(section.matches(">proved</a>").count(), proofs, "{}", entry.label());
        assert_eq!(
            section.matches("tested, not proved").count(),
            expected.len() - proofs,
            "{}",
            entry.label()
        );
        seen += expected.len();
    }
    assert_eq!(seen, entries().iter().map(|entry| claim_names(entry.equation).len()).sum::<usize>());
}

/// Returns the statement of a claim and its hypotheses, the code before the next block. Invariants are part of the
/// proof.
fn claim_text(html: &str) -> Vec<&str> {
    let end =
        ["<pre", "<details", "<h2", "<h3", "<p>always "].iter().filter_map(|next| html.find(next)).min();
    let code = html[..end.unwrap_or(html.len())].split("<code>").skip(1);
    code.map(|code| code.split("</code>").next().unwrap()).collect()
}

/// Returns the heading with this id and the text after it.
fn find_heading<'a>(html: &'a str, id: &str) -> (&'a str, &'a str) {
    let (_, rest) = html.split_once(&format!(" id=\"{id}\"><a class=\"header\"")).expect("a heading");
    let (heading, rest) = rest.split_once("</a>").unwrap();
    (heading.split_once('>').unwrap().1, rest)
}

/// The page of claims states each claim as in the proof to which it links.
#[test]
fn claims_agree_with_their_proofs() {
    let item =
        Regex::new(r#"(?s)<li><strong>([^<]*)</strong>(.*?)<a href="([^#"]*)#([^"]*)">proved</a>(.*?)</li>"#);
    let (item, mut seen) = (item.unwrap(), 0);
    for (entry, section) in claim_sections() {
        for found in section.split("<li>").skip(1) {
            let found = format!("<li>{found}");
            let Some(found) = item.captures(&found) else { continue };
            let (name, proof) = (&found[1], find_heading(&FILES[Path::new(&found[3])], &found[4]));
            assert_eq!(proof.0, format!("{name}, {}", entry.label()));
            assert_eq!(claim_text(&found[2]), claim_text(proof.1), "{}", proof.0);
            assert!(!claim_text(proof.1).is_empty(), "{} has no statement", proof.0);
            // Rationals have no exponentials and do not round.
            let inexact = ["exp(", "fl(", "nearest("];
            let exact =
                !claim_text(proof.1).iter().any(|code| inexact.iter().any(|name| code.contains(name)));
            let systems = ["f32", "f64", "256 bits", "rationals"];
            let expected = &systems[..if exact { 4 } else { 3 }];
            let held = found[5]
                .split_once("held in ")
                .expect("a list of number systems")
                .1
                .split('<')
                .next()
                .unwrap();
            let held: Vec<_> = held.split(", ").map(|held| held.split(" (").next().unwrap()).collect();
            assert_eq!(held, expected, "{}", proof.0);
            seen += 1;
        }
    }
    assert_eq!(seen, entries().iter().map(|entry| entry.claims.len()).sum::<usize>());
}

/// The status in a box agrees with the page of claims.
#[test]
fn boxes_agree_with_the_page_of_claims() {
    let claims = &FILES[Path::new("claims.html")];
    let status_line = Regex::new(r#"(?s)id="eq-([\d-]+)".*?<div class="status">\s*<p>(.*?)</p>"#).unwrap();
    let proved = Regex::new(r#"^proved: <a href="([^#"]*)#([^"]*)">(\d+) claims?</a>"#).unwrap();
    let mut seen = 0;
    for (_, html) in with_extension("html").filter(|(path, _)| !path.ends_with("print.html")) {
        for found in status_line.captures_iter(html) {
            let number = found[1].replace('-', ".");
            let (entry, _) = equations().find(|(entry, _)| entry.equation == number).unwrap();
            let status = &found[2];
            let page = claims.split_once(&format!("id=\"claims-{}\"", &found[1])).unwrap().1;
            let page = page.split("<h3").next().unwrap();
            let link = proved.captures(status).unwrap_or_else(|| panic!("({number}): {status}"));
            assert_eq!(link[3].parse(), Ok(entry.claims.len()), "({number})");
            let proof = find_heading(&FILES[Path::new(&link[1])], &link[2]).0;
            assert_eq!(proof, format!("{} {}", entry.label(), entry.title));
            assert_eq!(
                find_heading(html, &format!("eq-{}", &found[1])).0,
                format!("Equation {number} · {}", entry.title)
            );
            let tested = page.matches("tested, not proved").count();
            assert_eq!(status.contains(&format!(", and {tested} only tested")), tested > 0, "({number})");
            for system in ["f32", "f64", "256 bits", "rationals"] {
                let items = page.split("<li>").filter(|item| item.contains(">proved</a>"));
                let held = items.filter(|item| {
                    item.split_once("held in ").is_some_and(|(_, held)| held.contains(system))
                });
                let (held, all) = (held.count(), entry.claims.len());
                let is_all =
                    status.contains(&format!("{system}, ")) || status.contains(&format!("{system} · "));
                assert_eq!(is_all, held == all, "({number}) {system}: {status}");
                assert_eq!(
                    status.contains(&format!("{system} ({held} of ")),
                    0 < held && held < all,
                    "({number}) {system}: {status}"
                );
            }
            seen += 1;
        }
    }
    assert_eq!(seen, equations().count());
}

#[test]
fn heading_of_a_box_is_one_level_below_its_section() {
    let heading = Regex::new(r#"<h([1-6])[^>]* id="([^"]*)""#).unwrap();
    let mut boxes = 0;
    for (path, html) in with_extension("html").filter(|(path, _)| !path.ends_with("print.html")) {
        let mut section = 0;
        for found in heading.captures_iter(html) {
            let (level, id): (u32, _) = (found[1].parse().unwrap(), &found[2]);
            if id.starts_with("eq-") {
                assert_eq!(level, section + 1, "{}: #{id}", path.display());
                boxes += 1;
            } else if id != "mdbook-help-title" {
                section = level;
            }
        }
    }
    assert_eq!(boxes, equations().count());
}

/// The proofs of each entry link back to the book, and to what has to be trusted.
#[test]
fn proofs_link_back_to_the_book() {
    let pages: String = with_extension("html")
        .filter(|(path, _)| path.starts_with("proofs"))
        .map(|(_, html)| html.as_str())
        .collect();
    let proved = entries().iter().filter(|entry| !entry.claims.is_empty()).count();
    assert_eq!(pages.matches("\"../proofs.html#trust\">what to trust</a>").count(), proved);
    for (entry, _) in equations() {
        let back = format!("#eq-{}\">In the book</a>", entry.equation.replace('.', "-"));
        assert_eq!(pages.matches(&back).count(), 1, "{}", entry.label());
    }
}

#[test]
fn all_tags_and_formulas_are_replaced() {
    let code = Regex::new(r"(?s)<(code|script)[ >].*?</(code|script)>").unwrap();
    for (path, html) in with_extension("html") {
        assert!(!html.contains("{{#"), "{}: a tag is left", path.display());
        assert!(
            !html.contains("<annotation"),
            "{}: LaTeX is left, and would be found by words",
            path.display()
        );
        assert!(!code.replace_all(html, "").contains('$'), "{}: a $ is left", path.display());
    }
}

#[test]
fn every_link_has_a_target() {
    let ids: BTreeMap<_, HashSet<_>> = with_extension("html")
        .map(|(path, html)| (path.as_path(), values(html, "id").into_iter().collect()))
        .collect();
    let mut checked = 0;
    for (page, html) in with_extension("html") {
        for link in values(html, "href").into_iter().chain(values(html, "src")) {
            if link.starts_with("https://") {
                continue;
            }
            if link.starts_with("../doc/") {
                assert!(documentation::is_documented(link), "{}: nothing for {link}", page.display());
                checked += 1;
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let file = file.split_once('?').map_or(file, |(file, _)| file);
            let target = if file.is_empty() { page.clone() } else { resolve(page, file) };
            assert!(FILES.contains_key(&target), "{}: no file {link}", page.display());
            let known = anchor.is_empty() || ids[target.as_path()].contains(anchor);
            assert!(known, "{}: no anchor {link}", page.display());
            checked += 1;
        }
    }
    assert!(checked > equations().count(), "only {checked} links were checked");
}

#[test]
fn equation_numbers_link_to_their_box() {
    let link = Regex::new(r#"href="[^"]*eq-([\d-]+)">\(([\d.]+)\)</a>"#).unwrap();
    let mut seen = 0;
    for (page, html) in with_extension("html") {
        for found in link.captures_iter(html) {
            assert_eq!(found[1].replace('-', "."), found[2], "{}", page.display());
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen}");
}

#[test]
fn bench_is_on_its_page_unchanged() {
    let pages: Vec<_> = with_extension("html").filter(|(_, html)| html.contains(bench::MODEL)).collect();
    let names: Vec<_> = pages.iter().map(|(path, _)| path.display().to_string()).collect();
    // index.html is a copy of the introduction.
    let pages_with_it = ["augmented", "contact", "convergence", "index", "introduction", "penalty", "print"];
    assert_eq!(names, pages_with_it.map(|page| format!("{page}.html")));
    let script = format!("<script>\n{}</script>\n", bench::script().unwrap());
    assert!(pages.iter().all(|(_, html)| html.contains(&script)), "the script has changed");
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

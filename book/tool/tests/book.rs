//! The whole book, built in process and looked through.

#[path = "book/contrast.rs"]
mod contrast;
#[path = "book/documentation.rs"]
mod documentation;
#[path = "pages/files.rs"]
mod files;

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
    files::root().join("book")
}

/// The produced files with their text, which is empty for fonts and the like.
static FILES: LazyLock<BTreeMap<PathBuf, String>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    let _ = fs::remove_dir_all(&folder);
    let mut book = MDBook::load(book()).expect("the book loads");
    book.config.build.build_dir = folder.clone();
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

/// The values of an attribute in a page.
fn values<'a>(html: &'a str, attribute: &str) -> Vec<&'a str> {
    let pattern = Regex::new(&format!(r#"[\s"]{attribute}="([^"]*)""#)).unwrap();
    pattern.captures_iter(html).map(|found| found.get(1).unwrap().as_str()).collect()
}

/// The file that a relative link in `file` means.
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
fn every_equation_of_the_chapter_is_displayed_once() {
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
fn every_page_is_in_the_summary_and_has_its_snippets_run() {
    let listed: BTreeSet<_> = PAGES.iter().map(|page| format!("{page}.md")).collect();
    let pages = |folder: &str| -> BTreeSet<String> {
        let entries = fs::read_dir(book().join("src").join(folder)).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let names = names.filter(|name| name.ends_with(".md") && name != "SUMMARY.md");
        names.map(|name| format!("{folder}{name}")).collect()
    };
    // The pages of proofs are printed, and have no snippets.
    let (written, printed) = (pages(""), pages("proofs/"));
    let loaded = MDBook::load(book()).unwrap();
    let summary: BTreeSet<_> =
        loaded.book.chapters().map(|c| c.path.as_ref().unwrap().display().to_string()).collect();
    assert_eq!(&written | &printed, summary, "files, summary");
    assert_eq!(written, listed, "files, PAGES");
}

#[test]
fn everything_that_a_box_says_holds() {
    let mut boxes = 0;
    for (path, html) in with_extension("html") {
        assert!(!html.contains("class=\"open\""), "{}: a claim is open", path.display());
        boxes += html.matches("class=\"equation\"").count();
    }
    assert_eq!(boxes, 2 * equations().count(), "each once on its page, and once in the page to print");
}

/// What the page of claims has of each entry.
fn claimed() -> impl Iterator<Item = (&'static Entry, &'static str)> {
    FILES[Path::new("claims.html")].split("<h3").skip(1).map(|section| {
        let heading = section.split("</h3>").next().unwrap();
        let entry = entries().iter().find(|entry| heading.contains(&format!(">{} ", entry.label())));
        (entry.unwrap_or_else(|| panic!("whose heading is {heading}")), section)
    })
}

#[test]
fn every_claim_is_on_the_page_of_claims_with_its_proof() {
    let item = Regex::new(r"<li><strong>([^<]*)</strong>").unwrap();
    let mut seen = 0;
    for (entry, section) in claimed() {
        let mut found: Vec<_> =
            item.captures_iter(section).map(|found| found.get(1).unwrap().as_str()).collect();
        let mut expected = claim_names(entry.equation);
        found.sort_unstable();
        expected.sort_unstable();
        assert_eq!(found, expected, "{}", entry.label());
        let proofs = entry.claims.len();
        assert_eq!(section.matches(">proved</a>").count(), proofs, "{}", entry.label());
        assert_eq!(
            section.matches("tried, not proved").count(),
            expected.len() - proofs,
            "{}",
            entry.label()
        );
        seen += expected.len();
    }
    assert_eq!(seen, entries().iter().map(|entry| claim_names(entry.equation).len()).sum::<usize>());
}

/// What stands in code before the next block: what a claim says, and what it supposes. What always holds is part of
/// the proof.
fn said(html: &str) -> Vec<&str> {
    let end =
        ["<pre", "<details", "<h2", "<h3", "<p>always "].iter().filter_map(|next| html.find(next)).min();
    let code = html[..end.unwrap_or(html.len())].split("<code>").skip(1);
    code.map(|code| code.split("</code>").next().unwrap()).collect()
}

/// The heading of this address, and what follows it.
fn headed<'a>(html: &'a str, id: &str) -> (&'a str, &'a str) {
    let (_, rest) = html.split_once(&format!(" id=\"{id}\"><a class=\"header\"")).expect("a heading");
    let (heading, rest) = rest.split_once("</a>").unwrap();
    (heading.split_once('>').unwrap().1, rest)
}

/// What the page of claims says of a claim is what its proof is of, to which it leads.
#[test]
fn claims_are_those_of_their_proofs() {
    let item =
        Regex::new(r#"(?s)<li><strong>([^<]*)</strong>(.*?)<a href="([^#"]*)#([^"]*)">proved</a>(.*?)</li>"#);
    let (item, mut seen) = (item.unwrap(), 0);
    for (entry, section) in claimed() {
        for found in section.split("<li>").skip(1) {
            let found = format!("<li>{found}");
            let Some(found) = item.captures(&found) else { continue };
            let (name, proof) = (&found[1], headed(&FILES[Path::new(&found[3])], &found[4]));
            assert_eq!(proof.0, format!("{name}, {}", entry.label()));
            assert_eq!(said(&found[2]), said(proof.1), "{}", proof.0);
            assert!(!said(proof.1).is_empty(), "{} says nothing", proof.0);
            // Rationals have no exponentials, and round nothing.
            let inexact = ["exp(", "fl(", "nearest("];
            let exact = !said(proof.1).iter().any(|code| inexact.iter().any(|name| code.contains(name)));
            let systems = ["f32", "f64", "256 bits", "rationals"];
            let expected = &systems[..if exact { 4 } else { 3 }];
            let held = found[5].split_once("held in ").expect("where it held").1.split('<').next().unwrap();
            let held: Vec<_> = held.split(", ").map(|held| held.split(" (").next().unwrap()).collect();
            assert_eq!(held, expected, "{}", proof.0);
            seen += 1;
        }
    }
    assert_eq!(seen, entries().iter().map(|entry| entry.claims.len()).sum::<usize>());
}

/// A box says no more than the page of claims: how many claims are proved, and how many held where.
#[test]
fn boxes_say_what_the_page_of_claims_says() {
    let claims = &FILES[Path::new("claims.html")];
    let status = Regex::new(r#"(?s)id="eq-([\d-]+)".*?<div class="status">\s*<p>(.*?)</p>"#).unwrap();
    let proved = Regex::new(r#"^proved: <a href="([^#"]*)#([^"]*)">(\d+) claims?</a>"#).unwrap();
    let mut seen = 0;
    for (_, html) in with_extension("html").filter(|(path, _)| !path.ends_with("print.html")) {
        for found in status.captures_iter(html) {
            let number = found[1].replace('-', ".");
            let (entry, _) = equations().find(|(entry, _)| entry.equation == number).unwrap();
            let said = &found[2];
            let page = claims.split_once(&format!("id=\"claims-{}\"", &found[1])).unwrap().1;
            let page = page.split("<h3").next().unwrap();
            let link = proved.captures(said).unwrap_or_else(|| panic!("({number}): {said}"));
            assert_eq!(link[3].parse(), Ok(entry.claims.len()), "({number})");
            let proof = headed(&FILES[Path::new(&link[1])], &link[2]).0;
            assert_eq!(proof, format!("{} {}", entry.label(), entry.title));
            assert_eq!(
                headed(html, &format!("eq-{}", &found[1])).0,
                format!("Equation {number} · {}", entry.title)
            );
            let tried = page.matches("tried, not proved").count();
            assert_eq!(said.contains(&format!(", and {tried} only tried")), tried > 0, "({number})");
            for system in ["f32", "f64", "256 bits", "rationals"] {
                let items = page.split("<li>").filter(|item| item.contains(">proved</a>"));
                let held = items.filter(|item| {
                    item.split_once("held in ").is_some_and(|(_, held)| held.contains(system))
                });
                let (held, all) = (held.count(), entry.claims.len());
                let is_all = said.contains(&format!("{system}, ")) || said.contains(&format!("{system} · "));
                assert_eq!(is_all, held == all, "({number}) {system}: {said}");
                assert_eq!(
                    said.contains(&format!("{system} ({held} of ")),
                    0 < held && held < all,
                    "({number}) {system}: {said}"
                );
            }
            seen += 1;
        }
    }
    assert_eq!(seen, equations().count());
}

/// A box has a heading one level below that of the section in which it stands.
#[test]
fn the_heading_of_a_box_is_one_level_below_its_section() {
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

/// From the proofs of each entry one link leads back to the book, and one to what a proof rests on.
#[test]
fn proofs_lead_back() {
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
fn no_tag_and_no_dollar_formula_is_left() {
    let code = Regex::new(r"(?s)<(code|script)[ >].*?</(code|script)>").unwrap();
    for (path, html) in with_extension("html") {
        assert!(!html.contains("{{#"), "{}: a tag is left", path.display());
        assert!(
            !html.contains("<annotation"),
            "{}: LaTeX is left, and would be found by words",
            path.display()
        );
        assert!(!code.replace_all(html, "").contains('$'), "{}: a $ is left", path.display());
        assert!(!html.contains("katex-error"), "{}: a formula is in error", path.display());
    }
}

#[test]
fn every_link_leads_somewhere() {
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
    assert!(checked > equations().count(), "only {checked} links were seen");
}

#[test]
fn a_number_leads_to_its_own_box() {
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
fn the_bench_is_on_its_page_as_it_was_written() {
    let pages: Vec<_> = with_extension("html").filter(|(_, html)| html.contains(bench::MODEL)).collect();
    let names: Vec<_> = pages.iter().map(|(path, _)| path.display().to_string()).collect();
    assert_eq!(names, ["augmented.html", "print.html"]);
    let written = bench::html().unwrap();
    let script = &written[written.find("<script>").unwrap()..];
    assert!(pages.iter().all(|(_, html)| html.contains(script)), "the script is changed");
}

#[test]
fn nothing_is_fetched_from_outside() {
    let fetching =
        Regex::new(r#"<(script|link|img|iframe|source|object)\b[^>]*(src|href|data)="(https?:)?//"#).unwrap();
    for (path, html) in with_extension("html") {
        assert!(!fetching.is_match(html), "{}: {:?}", path.display(), fetching.find(html));
    }
    let url = Regex::new(r#"url\(['"]?([^'")]+)"#).unwrap();
    let mut fonts = 0;
    for (path, css) in with_extension("css") {
        for target in url.captures_iter(css).map(|found| found.get(1).unwrap().as_str()) {
            if target.starts_with("data:") {
                continue;
            }
            assert!(FILES.contains_key(&resolve(path, target)), "{}: no file {target}", path.display());
            fonts += 1;
        }
    }
    assert!(fonts >= 20, "KaTeX's fonts are missing");
}

//! Consistency of the metadata that registries show: Cargo.toml, pyproject.toml and the README.

use crate::files::{files, root, text};
use pulldown_cmark::{Event, Parser, Tag};
use regex::Regex;

/// Returns a field of the workspace or of the main crate.
fn field(key: &str) -> String {
    let line = Regex::new(&format!("(?m)^{key} = \"(.*)\"$")).unwrap();
    line.captures(&text("Cargo.toml")).unwrap_or_else(|| panic!("Cargo.toml has no {key}"))[1].into()
}

/// Returns the anchor that GitHub generates for a heading.
fn anchor(heading: &str) -> String {
    let dashed = heading.trim().to_lowercase().replace(' ', "-");
    dashed.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
}

/// Returns the targets of links (`false`) and images (`true`).
fn targets(markdown: &str) -> Vec<(bool, String)> {
    let target = |event| match event {
        Event::Start(Tag::Link { dest_url, .. }) => Some((false, dest_url.to_string())),
        Event::Start(Tag::Image { dest_url, .. }) => Some((true, dest_url.to_string())),
        _ => None,
    };
    Parser::new(markdown).filter_map(target).collect()
}

/// The crate registry resolves relative links against the repository on three hosts, and treats some extensions as
/// images and all others as pages.
#[test]
fn readme_links_work_on_the_registry() {
    let host = Regex::new(r"^https://(github\.com|gitlab\.com|bitbucket\.org)/[\w.-]+/[\w.-]+$").unwrap();
    assert!(host.is_match(&field("repository")), "relative links are not resolved for this host");
    let relative =
        targets(&text("README.md")).into_iter().filter(|(_, target)| !target.starts_with("https://"));
    let (pictures, links): (Vec<_>, Vec<_>) = relative.partition(|(is_picture, _)| *is_picture);
    assert!(links.len() > 20 && pictures.len() == 1, "{links:?}, {pictures:?}");
    for (is_picture, target) in links.into_iter().chain(pictures) {
        let (file, heading) = target.split_once('#').unwrap_or((&target, ""));
        assert!(
            !file.starts_with(['/', '.']) && !file.contains("..") && root().join(file).is_file(),
            "{target}"
        );
        assert_eq!(file.ends_with(".svg") || file.ends_with(".png"), is_picture, "{target}");
        let page = if heading.is_empty() { "#".into() } else { text(file) };
        let mut headings = page.lines().filter(|line| line.starts_with('#'));
        assert!(headings.any(|line| anchor(line.trim_start_matches('#')) == heading), "{target}: no heading");
    }
}

/// The Python package index does not resolve relative links.
#[test]
fn wheel_readme_has_absolute_links_only() {
    let project = text("pyproject.toml");
    let (_, readme) = project.split_once("\ntext = \"\"\"\n").expect("a readme text");
    let (readme, _) = readme.split_once("\n\"\"\"").unwrap();
    assert!(targets(readme).iter().all(|(_, target)| target.starts_with("https://")));
}

#[test]
fn texts_agree_with_cargo_toml() {
    let [name, version, rust, license] = ["name", "version", "rust-version", "license"].map(field);
    let (minor, _) = version.rsplit_once('.').unwrap();
    let (licences, badge) = (license.replace(" OR ", " or "), "https://img.shields.io/badge");
    let escaped = licences.replace('-', "--").replace(' ', "_");
    for (file, words) in [
        ("README.md", format!("\nRust {rust} or newer")),
        ("README.md", format!("![Rust {rust} or newer]({badge}/rust-{rust}+-blue)")),
        ("README.md", format!("![Licence: {licences}]({badge}/licence-{escaped}-blue)")),
        ("README.md", format!("\n{name} = {{ version = \"{minor}\",")),
        ("Cargo.toml", format!("\ndocumentation = \"https://docs.rs/{name}\"\n")),
        ("pyproject.toml", format!("\nname = \"{name}\"\n")),
        ("pyproject.toml", format!("\nlicense = \"({license}) AND LGPL-3.0-or-later\"\n")),
        ("pyproject.toml", "\ndynamic = [\"version\", \"description\", \"keywords\", \"urls\"]\n".into()),
    ] {
        assert!(text(file).contains(&words), "{file}: {words}");
    }
    let changes = text("CHANGELOG.md");
    let announced = [format!("\n## [{version}]"), format!("\nWill be {version},")];
    assert!(announced.iter().any(|line| changes.contains(line)), "CHANGELOG.md: {version}");
}

/// If the project moves, this test lists the files that contain its address.
#[test]
fn repository_address_agrees_with_cargo_toml() {
    let place = format!(r"https://[\w.-]+/[\w.-]+/{}\b|https://[\w.-]+\.github\.io\b[\w/.-]*", field("name"));
    let place = Regex::new(&place).unwrap();
    let fixed =
        ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "pyproject.toml", ".ci/wheel", "book/book.toml"];
    let fixed = fixed.map(|file| root().join(file)).into_iter();
    for file in fixed.chain(files(&root().join(".github/workflows"), "")) {
        for found in place.find_iter(&text(&file)) {
            assert_eq!(found.as_str(), field("repository"), "{}", file.display());
        }
    }
    assert!(place.is_match(&text("Cargo.toml")));
}

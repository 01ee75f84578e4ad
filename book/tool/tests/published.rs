//! Consistency of the metadata that registries show: Cargo.toml, pyproject.toml and the README.

use crate::files::{root, text};
use pulldown_cmark::{Event, Parser, Tag};
use regex::Regex;
use serde_json::Value;
use std::{env, fs, process::Command, sync::LazyLock};

/// Packages of the workspace as read by cargo, with the main crate first.
static PACKAGES: LazyLock<Vec<Value>> = LazyLock::new(|| {
    let mut cargo = Command::new(env::var_os("CARGO").unwrap());
    let output =
        cargo.args(["metadata", "--no-deps", "--format-version=1"]).current_dir(root()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut packages = metadata["packages"].as_array().unwrap().clone();
    packages.sort_by_key(|package| package["name"] != "spring-mass-contact");
    packages
});

/// Returns a field of the main crate's Cargo.toml.
fn package_field(key: &str) -> &'static str {
    PACKAGES[0][key].as_str().unwrap_or_else(|| panic!("Cargo.toml has no {key}"))
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
    let address = Regex::new(r"^https://(github\.com|gitlab\.com|bitbucket\.org)/[\w.-]+/[\w.-]+$").unwrap();
    assert!(
        address.is_match(package_field("repository")),
        "relative links are not resolved for this host: {}",
        package_field("repository")
    );
    let (mut links, mut pictures) = (0, 0);
    for (is_picture, target) in targets(&text("README.md")) {
        if target.starts_with("https://") {
            continue;
        }
        let (file, heading) = target.split_once('#').unwrap_or((&target, ""));
        assert!(!file.starts_with(['/', '.']) && !file.contains("..") && !file.is_empty(), "{target}");
        assert!(root().join(file).is_file(), "{target}: the file does not exist");
        assert_eq!(file.ends_with(".svg") || file.ends_with(".png"), is_picture, "{target}");
        let headings = if heading.is_empty() { String::new() } else { text(file) };
        let known = headings.lines().filter(|line| line.starts_with('#'));
        let known: Vec<_> = known.map(|line| anchor(line.trim_start_matches('#'))).collect();
        assert!(heading.is_empty() || known.contains(&heading.to_string()), "{target}: only {known:?}");
        *(if is_picture { &mut pictures } else { &mut links }) += 1;
    }
    assert!(links > 20 && pictures == 1, "{links} links, {pictures} pictures");
}

/// The Python package index does not resolve relative links.
#[test]
fn wheel_readme_has_absolute_links_only() {
    let project = text("pyproject.toml");
    let (_, readme) = project.split_once("\ntext = \"\"\"\n").expect("a readme text");
    let (readme, _) = readme.split_once("\n\"\"\"").unwrap();
    assert!(readme.len() > 200, "{readme}");
    for (_, target) in targets(readme) {
        assert!(target.starts_with("https://"), "{target}");
    }
}

#[test]
fn wheel_metadata_comes_from_cargo_toml() {
    let project = text("pyproject.toml");
    let keys: Vec<_> =
        project.lines().filter_map(|line| line.split_once(" = ")).map(|(key, _)| key).collect();
    let dynamic =
        project.lines().find_map(|line| line.strip_prefix("dynamic = ")).expect("the dynamic fields");
    for key in ["version", "description", "keywords", "urls"] {
        assert!(dynamic.contains(&format!("\"{key}\"")) && !keys.contains(&key), "{key}");
    }
    assert!(project.contains(&format!("\nname = \"{}\"\n", package_field("name"))));
    let license = format!("\nlicense = \"({}) AND LGPL-3.0-or-later\"\n", package_field("license"));
    assert!(project.contains(&license), "{license}");
}

#[test]
fn readme_agrees_with_cargo_toml() {
    let (readme, rust) = (text("README.md"), package_field("rust_version"));
    for package in PACKAGES.iter() {
        assert_eq!(package["rust_version"], rust, "{}", package["name"]);
    }
    assert!(readme.contains(&format!("\nRust {rust} or newer")), "{rust}");
    assert!(
        readme.contains(&format!("![Rust {rust} or newer](https://img.shields.io/badge/rust-{rust}+-blue)"))
    );
    let license = package_field("license").replace(" OR ", " or ");
    let badge = license.replace('-', "--").replace(' ', "_");
    assert!(
        readme.contains(&format!("![Licence: {license}](https://img.shields.io/badge/licence-{badge}-blue)"))
    );
    let badges = targets(&readme).into_iter().filter(|(_, target)| target.contains("img.shields.io"));
    assert_eq!(badges.count(), 2, "a badge without a test");
    let version = format!("version = \"{}\"", package_field("version").rsplit_once('.').unwrap().0);
    assert!(readme.contains(&format!("\n{} = {{ {version},", package_field("name"))), "{version}");
    let changes = text("CHANGELOG.md");
    let version = package_field("version");
    let released = changes.contains(&format!("\n## [{version}]"));
    assert!(released || changes.contains(&format!("\nWill be {version},")), "CHANGELOG.md: {version}");
}

/// If the project moves, this test lists the files that contain its address.
#[test]
fn repository_address_agrees_with_cargo_toml() {
    let name = package_field("name");
    let place =
        Regex::new(&format!(r"https://[\w.-]+/[\w.-]+/{name}\b|https://[\w.-]+\.github\.io\b[\w/.-]*"))
            .unwrap();
    let workflows = fs::read_dir(root().join(".github/workflows")).unwrap();
    let workflows =
        workflows.map(|entry| format!(".github/workflows/{}", entry.unwrap().file_name().display()));
    let fixed =
        ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "pyproject.toml", ".ci/wheel", "book/book.toml"];
    for file in fixed.map(String::from).into_iter().chain(workflows) {
        for found in place.find_iter(&text(&file)) {
            assert_eq!(found.as_str(), package_field("repository"), "{file}");
        }
    }
    assert!(place.is_match(&text("Cargo.toml")));
    assert_eq!(package_field("documentation"), format!("https://docs.rs/{name}"));
}

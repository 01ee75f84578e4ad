//! What is said where the crate is published: by Cargo.toml, by pyproject.toml, and by the README, which others show than
//! those who have the repository.

use pulldown_cmark::{Event, Parser, Tag};
use regex::Regex;
use serde_json::Value;
use std::{env, fs, path::Path, process::Command, sync::LazyLock};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The packages of the workspace as cargo reads them, this crate's first.
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

fn said(key: &str) -> &'static str {
    PACKAGES[0][key].as_str().unwrap_or_else(|| panic!("Cargo.toml has no {key}"))
}

/// The name by which GitHub knows a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().to_lowercase().replace(' ', "-");
    kept.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
}

/// Links and pictures, the latter marked.
fn targets(markdown: &str) -> Vec<(bool, String)> {
    let target = |event| match event {
        Event::Start(Tag::Link { dest_url, .. }) => Some((false, dest_url.to_string())),
        Event::Start(Tag::Image { dest_url, .. }) => Some((true, dest_url.to_string())),
        _ => None,
    };
    Parser::new(markdown).filter_map(target).collect()
}

/// The registry of crates completes what is relative by the address of the repository, at three hosts, and takes files of
/// some names from there as pictures and all others as pages.
#[test]
fn the_readme_leads_somewhere_where_a_registry_shows_it() {
    let address = Regex::new(r"^https://(github\.com|gitlab\.com|bitbucket\.org)/[\w.-]+/[\w.-]+$").unwrap();
    assert!(address.is_match(said("repository")), "no host that is completed: {}", said("repository"));
    let (mut links, mut pictures) = (0, 0);
    for (is_picture, target) in targets(&text("README.md")) {
        if target.starts_with("https://") {
            continue;
        }
        let (file, heading) = target.split_once('#').unwrap_or((&target, ""));
        assert!(!file.starts_with(['/', '.']) && !file.contains("..") && !file.is_empty(), "{target}");
        assert!(root().join(file).is_file(), "{target}: no such file");
        assert_eq!(file.ends_with(".svg") || file.ends_with(".png"), is_picture, "{target}");
        let headings = if heading.is_empty() { String::new() } else { text(file) };
        let known = headings.lines().filter(|line| line.starts_with('#'));
        let known: Vec<_> = known.map(|line| anchor(line.trim_start_matches('#'))).collect();
        assert!(heading.is_empty() || known.contains(&heading.to_string()), "{target}: only {known:?}");
        *(if is_picture { &mut pictures } else { &mut links }) += 1;
    }
    assert!(links > 20 && pictures == 1, "{links} links, {pictures} pictures");
}

/// An index of wheels completes nothing.
#[test]
fn what_is_said_of_the_wheel_has_no_link_that_needs_the_repository() {
    let project = text("pyproject.toml");
    let (_, said) = project.split_once("\ntext = \"\"\"\n").expect("a text of its own");
    let (said, _) = said.split_once("\n\"\"\"").unwrap();
    assert!(said.len() > 200, "{said}");
    for (_, target) in targets(said) {
        assert!(target.starts_with("https://"), "{target}");
    }
}

#[test]
fn what_cargo_knows_is_said_of_the_wheel_by_nobody_else() {
    let project = text("pyproject.toml");
    let keys: Vec<_> =
        project.lines().filter_map(|line| line.split_once(" = ")).map(|(key, _)| key).collect();
    let dynamic =
        project.lines().find_map(|line| line.strip_prefix("dynamic = ")).expect("what Cargo.toml says");
    for key in ["version", "description", "keywords", "urls"] {
        assert!(dynamic.contains(&format!("\"{key}\"")) && !keys.contains(&key), "{key}");
    }
    assert!(project.contains(&format!("\nname = \"{}\"\n", said("name"))));
    let license = format!("\nlicense = \"({}) AND LGPL-3.0-or-later\"\n", said("license"));
    assert!(project.contains(&license), "{license}");
}

#[test]
fn the_readme_says_what_cargo_says() {
    let (readme, rust) = (text("README.md"), said("rust_version"));
    for package in PACKAGES.iter() {
        assert_eq!(package["rust_version"], rust, "{}", package["name"]);
    }
    assert!(readme.contains(&format!("\nRust {rust} or newer")), "{rust}");
    assert!(
        readme.contains(&format!("![Rust {rust} or newer](https://img.shields.io/badge/rust-{rust}+-blue)"))
    );
    let license = said("license").replace(" OR ", " or ");
    let badge = license.replace('-', "--").replace(' ', "_");
    assert!(
        readme.contains(&format!("![Licence: {license}](https://img.shields.io/badge/licence-{badge}-blue)"))
    );
    let badges = targets(&readme).into_iter().filter(|(_, target)| target.contains("img.shields.io"));
    assert_eq!(badges.count(), 2, "a badge says what nothing holds it to");
    let version = format!("version = \"{}\"", said("version").rsplit_once('.').unwrap().0);
    assert!(readme.contains(&format!("\n{} = {{ {version},", said("name"))), "{version}");
    let changes = text("CHANGELOG.md");
    let version = said("version");
    let released = changes.contains(&format!("\n## [{version}]"));
    assert!(released || changes.contains(&format!("\nWill be {version},")), "CHANGELOG.md: {version}");
}

/// An owner who moves the project changes Cargo.toml, and is told what else has its address.
#[test]
fn the_address_is_in_one_place() {
    let name = said("name");
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
            assert_eq!(found.as_str(), said("repository"), "{file}");
        }
    }
    assert!(place.is_match(&text("Cargo.toml")));
    assert_eq!(said("documentation"), format!("https://docs.rs/{name}"));
}

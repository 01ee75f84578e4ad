//! Test of the dependencies between modules: the mechanics (chapter, solver) do not depend on proofs; claims
//! and verify connect the two. Cargo separates the engine (number, formula, proof), which is independent of
//! mechanics, and the command, on which nothing depends; these are crates of their own. Within the engine the
//! checker has a stricter limit.
//!
//! Sources are read as tokens: names in comments, strings and docs do not count, names within macros do.

mod files;

use files::{files, source};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};

/// Modules that each module may depend on.
const KNOWS: [(&str, &[&str]); 9] = [
    ("number", &[]),
    ("formula", &["number"]),
    ("eval", &["number", "formula"]),
    ("proof", &["number", "formula", "eval"]),
    ("chapter", &["number"]),
    ("solver", &["number", "chapter"]),
    ("claims", &["number", "formula", "chapter"]),
    ("verify", &["number", "formula", "eval", "proof", "chapter", "solver", "claims"]),
    ("check", &["number", "formula", "proof", "chapter", "solver", "claims"]),
];

/// Folders of the modules of the engine and of the chapter's crate.
const SOURCES: [&str; 2] = ["engine/src", "src"];

/// Returns the folders of the map under one of these, in its order.
fn rooms(sources: &str) -> Vec<String> {
    let map = source("README.md");
    let lines = map.lines().filter_map(|line| line.strip_prefix(sources)?.strip_prefix('/'));
    lines.map(|line| line.split_whitespace().next().unwrap().to_string()).collect()
}

/// Returns the module of a file.
fn module(path: &str) -> Vec<String> {
    let path = SOURCES.iter().find_map(|sources| path.strip_prefix(sources)?.strip_prefix('/')).unwrap();
    let path = path.trim_end_matches(".rs").trim_end_matches("/mod");
    path.split('/').map(String::from).collect()
}

/// Returns the tokens after two colons, if the tokens begin with these.
fn after_colons(tokens: &[TokenTree]) -> Option<&[TokenTree]> {
    let colon = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == ':');
    match tokens {
        [a, b, rest @ ..] if colon(a) && colon(b) => Some(rest),
        _ => None,
    }
}

/// Returns the modules below the crate's root to which a path that begins within `start` leads, with all that
/// a list in braces names.
fn ends(start: &[String], path: &[TokenTree]) -> Vec<Vec<String>> {
    match path {
        [TokenTree::Ident(name), rest @ ..] if *name == "super" => {
            let up = &start[..start.len().saturating_sub(1)];
            after_colons(rest).map_or(vec![up.to_vec()], |rest| ends(up, rest))
        }
        [TokenTree::Ident(name), rest @ ..] => {
            let below = [start, &[name.to_string()]].concat();
            after_colons(rest).map_or_else(|| vec![below.clone()], |rest| ends(&below, rest))
        }
        [TokenTree::Group(list), ..] if list.delimiter() == Delimiter::Brace => {
            let tokens: Vec<_> = list.stream().into_iter().collect();
            let comma =
                |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == ',');
            tokens.split(comma).flat_map(|path| ends(start, path)).collect()
        }
        _ => vec![start.to_vec()],
    }
}

/// Returns the targets of the paths in these tokens that begin with a name of the crate or the engine,
/// `super` or `self`.
fn paths(tokens: TokenStream, own: &[String]) -> Vec<Vec<String>> {
    let tokens: Vec<_> = tokens.into_iter().collect();
    let mut found = Vec::new();
    for (i, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(name) => {
                // Only the beginning of a::super::b counts, and not a `super` after another.
                if i > 1 && after_colons(&tokens[i - 2..]).is_some() {
                    continue;
                }
                let rest = after_colons(&tokens[i + 1..]);
                match (name.to_string().as_str(), rest) {
                    (start, Some(rest)) if ["crate", "provable"].contains(&start) => {
                        found.extend(ends(&[], rest))
                    }
                    ("self", Some(rest)) => found.extend(ends(own, rest)),
                    ("super", Some(_)) => found.extend(ends(own, &tokens[i..])),
                    _ => {}
                }
            }
            TokenTree::Group(group) => {
                let inner = match &tokens[..i] {
                    [.., TokenTree::Ident(keyword), TokenTree::Ident(name)] if *keyword == "mod" => {
                        [own, &[name.to_string()]].concat()
                    }
                    _ => own.to_vec(),
                };
                found.extend(paths(group.stream(), &inner));
            }
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    found
}

/// Returns the module of a name at the crate's root that is not a module: macros of `number`, and a
/// re-exported crate.
fn room_of(name: &str) -> Option<&str> {
    match name {
        "operators" | "serialize_as_displayed" => Some("number"),
        "rug" => None,
        other => Some(other),
    }
}

/// Returns the forbidden dependencies of one file.
fn wrong_arrows(path: &str, text: &str) -> Vec<String> {
    let known = |name: &str| KNOWS.iter().find(|(room, _)| *room == name).map(|(_, known)| *known);
    let own = module(path);
    let knows = known(&own[0]).unwrap_or_else(|| {
        panic!("{path} is in no room: add its own to KNOWS in tests/layering.rs and to README.md")
    });
    let tokens = text.parse().unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut wrong: Vec<_> = paths(tokens, &own)
        .into_iter()
        .filter(|target| {
            target.first().and_then(|name| room_of(name)).is_some_and(|name| {
                assert!(known(name).is_some(), "{path} names {name}, which is in no room");
                name != own[0] && !knows.contains(&name)
            })
        })
        .map(|target| format!("{path} knows {}", target[0]))
        .collect();
    wrong.dedup();
    wrong
}

/// Returns the files of the engine and of the chapter's crate, as paths in the project.
fn sources() -> Vec<String> {
    SOURCES.iter().flat_map(|sources| files(sources)).collect()
}

#[test]
fn each_module_uses_only_those_that_it_may() {
    let (mut wrong, mut seen) = (Vec::new(), BTreeSet::new());
    for path in sources() {
        if path.ends_with(".rs") && !path.ends_with("src/lib.rs") {
            wrong.extend(wrong_arrows(&path, &source(&path)));
            seen.insert(module(&path)[0].clone());
        }
    }
    assert!(
        wrong.is_empty(),
        "{wrong:#?}: by the list KNOWS of this test these rooms may not know each other; move what is shared to one \
         that both may know"
    );
    assert_eq!(seen.len(), KNOWS.len(), "rooms of which a file was read: {seen:?}");
}

#[test]
fn the_map_lists_every_module() {
    let mut all = Vec::new();
    for sources in SOURCES {
        let root = source(&format!("{sources}/lib.rs"));
        let declared = root.lines().filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'));
        let declared: BTreeSet<_> = declared.map(String::from).collect();
        let rooms = rooms(sources);
        // The table in the docs of the crate's root has the same order.
        let places: Vec<_> = rooms.iter().filter_map(|room| root.find(&format!("| [`{room}`]"))).collect();
        assert!(
            places.is_sorted() && places.len() >= 2,
            "the table in {sources}/lib.rs has its rows in another order than the map in README.md"
        );
        assert_eq!(
            rooms.iter().cloned().collect::<BTreeSet<_>>(),
            declared,
            "each side has to have all: the rooms on the map in README.md, and the modules that {sources}/lib.rs declares"
        );
        all.extend(rooms);
    }
    let known: BTreeSet<_> = KNOWS.iter().map(|(room, _)| room.to_string()).collect();
    assert_eq!(
        all.into_iter().collect::<BTreeSet<_>>(),
        known,
        "each side has to have all: the rooms on the map in README.md, and those of the list KNOWS in this test"
    );
}

/// Returns the files of the checker.
fn checker() -> Vec<String> {
    let checker = |path: &String| path.starts_with("engine/src/proof/check") && !path.contains("/tests");
    sources().into_iter().filter(checker).collect()
}

#[test]
fn the_checker_uses_only_numbers_and_statements() {
    // A reader of the trusted part needs to read nothing else of `proof`, except for what limits its time.
    let mut known = BTreeSet::new();
    for path in checker() {
        known.extend(paths(source(&path).parse().unwrap(), &module(&path)));
    }
    // `proof` alone is the visibility of a function.
    let allowed = ["formula", "number", "operators", "proof", "proof::check", "proof::effort"];
    let room = |target: &Vec<String>| {
        target[..target.len().min(if target[0] == "proof" { 2 } else { 1 })].join("::")
    };
    let others: Vec<_> = known.iter().map(room).filter(|room| !allowed.contains(&room.as_str())).collect();
    assert!(
        others.is_empty() && !known.is_empty(),
        "the checker knows {others:?}, of {known:?}: who reads what has to be trusted would have to read that, too"
    );
}

/// Files of statements, each after all that it uses.
const ORDER: [&str; 8] =
    ["symbols", "typeset", "hypothesis", "proposition", "sequence", "statement", "claim", "registry"];

/// The typesetting of hypotheses stands above them.
#[test]
fn files_of_statements_use_only_those_before_them() {
    let place = |name: &String| ORDER.iter().position(|file| file == name);
    let (mut wrong, mut uses) = (Vec::new(), 0);
    for path in sources().into_iter().filter(|path| path.starts_with("engine/src/formula/")) {
        let own = module(&path);
        let first =
            if path.ends_with("typeset/hypothesis.rs") { ORDER.len() } else { place(&own[1]).expect(&path) };
        for target in paths(source(&path).parse().unwrap(), &own) {
            let used = target.get(1).filter(|_| target[0] == "formula").and_then(place);
            uses += usize::from(used.is_some_and(|used| used < first));
            if used.is_some_and(|used| used > first) {
                wrong.push(format!("{path} uses {}", target[1]));
            }
        }
    }
    assert!(wrong.is_empty() && uses > 10, "{uses} uses; {wrong:?}");
}

/// Types of the checker that nothing else constructs: proofs, and polynomials, whose terms are in order.
const SEALED: [&str; 2] = ["Proof", "Polynomial"];

#[test]
fn the_fields_of_proofs_are_private_to_the_checker() {
    let mut structures = Vec::new();
    for path in checker() {
        for item in syn::parse_file(&source(&path)).unwrap().items {
            let syn::Item::Struct(item) = item else { continue };
            let is_part = SEALED.iter().all(|name| item.ident != name);
            let is_sealed = item.fields.iter().all(|field| matches!(field.vis, syn::Visibility::Inherited));
            assert!(is_sealed || is_part, "{path}: a field of {} can be seen", item.ident);
            structures.push(item.ident.to_string());
        }
    }
    for name in SEALED {
        assert!(structures.iter().any(|known| *known == name), "{name} is not among {structures:?}");
    }
}

/// No two public types have the same name.
#[test]
fn every_public_type_has_a_name_of_its_own() {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for path in SOURCES.into_iter().flat_map(files) {
        for line in source(&path).lines() {
            let keywords = ["pub struct ", "pub enum ", "pub trait ", "pub type "];
            let Some(rest) = keywords.iter().find_map(|keyword| line.strip_prefix(keyword)) else { continue };
            let name: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
            places.entry(name).or_default().push(path.clone());
        }
    }
    assert!(places.len() > 100, "{} types", places.len());
    places.retain(|_, places| places.len() > 1);
    assert!(places.is_empty(), "{places:#?}");
}

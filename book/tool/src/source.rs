//! The functions of `src/chapter`, as they stand there.

use anyhow::{Context, Result};
use std::{
    fs,
    ops::RangeInclusive,
    path::{Path, PathBuf},
};

/// The folder with a module a section.
pub struct Sources {
    folder: PathBuf,
}

/// A public function or type, as it stands in its file.
#[derive(Debug, PartialEq, Eq)]
pub struct Item {
    /// `fn` or `struct`, as its page of documentation is called.
    pub kind: &'static str,
    /// Its lines, without its documentation.
    pub code: String,
    /// Their numbers in the file, from 1.
    pub lines: RangeInclusive<usize>,
}

impl Sources {
    pub fn in_folder(folder: &Path) -> Self {
        Self { folder: folder.into() }
    }

    /// `module::name`.
    pub fn item(&self, path: &str) -> Result<Item> {
        let (module, name) = path.split_once("::").with_context(|| format!("{path} is no module::name"))?;
        let file = self.folder.join(module).with_extension("rs");
        let text = fs::read_to_string(&file).with_context(|| format!("the module of {path}"))?;
        find(&text, name).with_context(|| format!("{module}.rs has no public function `{name}`"))
    }
}

impl Item {
    /// What a function does, without its signature and without the line that names the parameters; nothing for
    /// what is no function.
    pub fn body(&self) -> Option<String> {
        let mut lines = self.code.lines().skip_while(|line| !line.ends_with('{')).skip(1).collect::<Vec<_>>();
        if self.kind != "fn" || lines.pop() != Some("}") {
            return None;
        }
        let said = lines.iter().filter(|line| !line.starts_with("    let SpringMass {"));
        Some(said.map(|line| line.strip_prefix("    ").unwrap_or(line)).collect::<Vec<_>>().join("\n"))
    }
}

/// From the line that begins with `pub fn name` or `pub struct name` to the brace that closes it: the
/// first one at the beginning of a line, since the sources are formatted.
fn find(text: &str, name: &str) -> Option<Item> {
    let kind = |line: &str| {
        ["fn", "struct"].into_iter().find(|kind| {
            line.strip_prefix(&format!("pub {kind} "))
                .and_then(|rest| rest.strip_prefix(name))
                .is_some_and(|rest| rest.starts_with(['<', '(', ' ']))
        })
    };
    let lines: Vec<_> = text.lines().collect();
    let (first, kind) = lines.iter().enumerate().find_map(|(i, line)| Some((i, kind(line)?)))?;
    let last = first + lines[first..].iter().position(|line| *line == "}")?;
    Some(Item { kind, code: lines[first..=last].join("\n"), lines: first + 1..=last + 1 })
}

#[cfg(test)]
mod tests {
    use super::find;

    const TEXT: &str = "/// Doc.\npub fn gap_two() {\n    2\n}\n\n/// Doc.\npub fn gap<T>(\n    x: T,\n) -> T {\n    let SpringMass { c, .. } = x;\n    let d = c;\n    if d {\n    }\n}\n\nfn private() {\n}\n\npub struct Gap {\n}\n";

    #[test]
    fn a_function_is_found_by_its_whole_name() {
        let gap = find(TEXT, "gap").unwrap();
        assert!(gap.code.starts_with("pub fn gap<T>(\n    x: T,\n) -> T {\n") && gap.code.ends_with("\n}"));
        assert_eq!((gap.kind, gap.lines), ("fn", 7..=14));
    }

    #[test]
    fn what_is_not_public_is_not_found() {
        assert_eq!(find(TEXT, "private"), None);
        assert_eq!(find(TEXT, "ga"), None);
    }

    #[test]
    fn a_body_is_what_is_computed() {
        assert_eq!(find(TEXT, "gap").unwrap().body().unwrap(), "let d = c;\nif d {\n}");
        assert_eq!(find(TEXT, "Gap").unwrap().body(), None);
    }
}

//! Source text of the functions in `src/chapter`.

use anyhow::{Context, Result};
use spring_mass_contact::claims::find_definition;
use std::{fs, path::Path};

/// Source text of a public function or type.
#[derive(Debug, PartialEq, Eq)]
pub struct Item {
    /// `fn` or `struct`, as in the file name of its documentation.
    pub kind: &'static str,
    /// Source lines without documentation.
    pub code: String,
    /// Numbers of its first and last line in the file, counted from 1.
    pub lines: (usize, usize),
}

impl Item {
    /// Reads the item with the path `module::name` from the folder of the modules.
    pub fn read(folder: &Path, path: &str) -> Result<Self> {
        let (module, name) =
            path.split_once("::").with_context(|| format!("{path} is not of the form module::name"))?;
        let file = folder.join(module).with_extension("rs");
        let text = fs::read_to_string(&file).with_context(|| format!("the module of {path}"))?;
        find(&text, name).with_context(|| format!("{module}.rs has no public function `{name}`"))
    }

    /// Returns the body of a function, without the line that destructures the parameters. Returns `None` for a type.
    pub fn body(&self) -> Option<String> {
        let (_, body) = self.code.split_once("{\n").filter(|_| self.kind == "fn")?;
        let lines = body.trim_end_matches('}').lines();
        let lines = lines.filter(|line| !line.starts_with("    let SpringMass {"));
        Some(lines.map(|line| line.strip_prefix("    ").unwrap_or(line)).collect::<Vec<_>>().join("\n"))
    }
}

/// Finds the lines from `pub fn name` or `pub struct name` to the closing brace: the first one at the beginning of a
/// line, since the sources are formatted.
fn find(text: &str, name: &str) -> Option<Item> {
    let (first, kind) = find_definition(text, name)?;
    let lines: Vec<_> = text.lines().collect();
    let last = first + lines[first..].iter().position(|line| *line == "}")?;
    Some(Item { kind, code: lines[first..=last].join("\n"), lines: (first + 1, last + 1) })
}

#[cfg(test)]
mod tests {
    use super::find;

    const TEXT: &str = "/// Doc.\npub fn gap_two() {\n    2\n}\n\n/// Doc.\npub fn gap<T>(\n    x: T,\n) -> T {\n    let SpringMass { c, .. } = x;\n    let d = c;\n    if d {\n    }\n}\n\nfn private() {\n}\n\npub struct Gap {\n}\n";

    #[test]
    fn function_is_found_by_full_name() {
        let gap = find(TEXT, "gap").unwrap();
        assert!(gap.code.starts_with("pub fn gap<T>(\n    x: T,\n) -> T {\n") && gap.code.ends_with("\n}"));
        assert_eq!((gap.kind, gap.lines), ("fn", (7, 14)));
    }

    #[test]
    fn private_items_and_prefixes_are_not_found() {
        assert_eq!(find(TEXT, "private"), None);
        assert_eq!(find(TEXT, "ga"), None);
    }

    #[test]
    fn body_excludes_signature_and_destructuring() {
        assert_eq!(find(TEXT, "gap").unwrap().body().unwrap(), "let d = c;\nif d {\n}");
        assert_eq!(find(TEXT, "Gap").unwrap().body(), None);
    }
}

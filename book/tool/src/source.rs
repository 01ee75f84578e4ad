//! The functions of `src/chapter`, as they stand there.

use anyhow::{Context, Result};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// The folder with a module a section.
pub struct Sources {
    folder: PathBuf,
}

impl Sources {
    pub fn in_folder(folder: &Path) -> Self {
        Self { folder: folder.into() }
    }

    /// The source of `module::name` without its documentation.
    pub fn function(&self, path: &str) -> Result<String> {
        let (module, name) = path.split_once("::").with_context(|| format!("{path} is no module::name"))?;
        let file = self.folder.join(module).with_extension("rs");
        let text = fs::read_to_string(&file).with_context(|| format!("the module of {path}"))?;
        find(&text, name).with_context(|| format!("{module}.rs has no public function `{name}`"))
    }
}

/// From the line that begins with `pub fn name` or `pub struct name` to the brace that closes it: the
/// first one at the beginning of a line, since the sources are formatted.
fn find(text: &str, name: &str) -> Option<String> {
    let begins = |line: &str| {
        ["pub fn ", "pub struct "].iter().any(|keyword| {
            line.strip_prefix(keyword)
                .and_then(|rest| rest.strip_prefix(name))
                .is_some_and(|rest| rest.starts_with(['<', '(', ' ']))
        })
    };
    let mut lines: Vec<_> = text.lines().skip_while(|line| !begins(line)).collect();
    let end = lines.iter().position(|line| *line == "}")?;
    lines.truncate(end + 1);
    Some(lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::find;

    const TEXT: &str = "/// Doc.\npub fn gap_two() {\n    2\n}\n\n/// Doc.\npub fn gap<T>(\n    x: T,\n) -> T {\n    if x {\n    }\n}\n\nfn private() {\n}\n";

    #[test]
    fn a_function_is_found_by_its_whole_name() {
        assert_eq!(find(TEXT, "gap").unwrap(), "pub fn gap<T>(\n    x: T,\n) -> T {\n    if x {\n    }\n}");
    }

    #[test]
    fn what_is_not_public_is_not_found() {
        assert_eq!(find(TEXT, "private"), None);
        assert_eq!(find(TEXT, "ga"), None);
    }
}

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
        let (first, kind) = find_definition(&text, name)
            .with_context(|| format!("{module}.rs has no public function `{name}`"))?;
        // The sources are formatted: the first brace at the beginning of a line closes the item.
        let lines = text.lines().skip(first);
        let code: Vec<_> = lines.take_while(|line| *line != "}").chain(["}"]).collect();
        Ok(Item { kind, lines: (first + 1, first + code.len()), code: code.join("\n") })
    }

    /// Returns the body of a function, without the line that destructures the parameters. Returns `None` for a type.
    pub fn body(&self) -> Option<String> {
        let (_, body) = self.code.split_once("{\n").filter(|_| self.kind == "fn")?;
        let lines = body.trim_end_matches('}').lines();
        let lines = lines.filter(|line| !line.starts_with("    let SpringMass {"));
        Some(lines.map(|line| line.strip_prefix("    ").unwrap_or(line)).collect::<Vec<_>>().join("\n"))
    }
}

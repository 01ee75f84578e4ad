//! The output of the examples is that in their first comments.
#![cfg(feature = "prover")]

use std::fs;
use std::path::Path;
use std::process::Command;

/// Returns the block of text in the first comment of an example.
fn promised(source: &str) -> Option<String> {
    let comment = source.lines().map_while(|line| line.strip_prefix("//!"));
    let lines: Vec<_> = comment.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
    let start = lines.iter().position(|line| *line == "```text")? + 1;
    let end = start + lines[start..].iter().position(|line| *line == "```")?;
    Some(lines[start..end].iter().map(|line| format!("{line}\n")).collect())
}

#[test]
fn examples_print_their_documented_output() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut seen = 0;
    for entry in fs::read_dir(root.join("examples")).unwrap() {
        let path = entry.unwrap().path();
        let Some(name) = path.file_name().unwrap().to_str().unwrap().strip_suffix(".rs") else { continue };
        let Some(promised) = promised(&fs::read_to_string(&path).unwrap()) else { continue };
        // Built already, if all tests are run.
        let run = Command::new(env!("CARGO"))
            .args(["run", "--quiet", "--example", name])
            .current_dir(root)
            .output();
        let output = run.unwrap();
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(String::from_utf8_lossy(&output.stdout), promised, "{name}");
        seen += 1;
    }
    assert_eq!(seen, 5);
}

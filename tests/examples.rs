//! The output of the examples is that in their first comments.

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

/// Returns k, |r_k| and its bound from each line of a log, and the contact force.
fn augmentations(log: &str) -> (Vec<[f64; 3]>, f64) {
    let rows = log.lines().filter_map(|line| {
        let numbers: Vec<f64> = line.split_whitespace().map_while(|word| word.parse().ok()).collect();
        numbers.get(..3).and_then(|row| row.try_into().ok())
    });
    let force = log.split("contact force ").nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
    (rows.collect(), force.parse().unwrap())
}

/// Returns the recorded log of the block. Its numbers have four digits.
fn recorded() -> (Vec<[f64; 3]>, f64) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    augmentations(&fs::read_to_string(root.join("examples/block.log")).unwrap())
}

#[test]
fn the_residual_of_the_block_decreases_by_the_proved_factor() {
    let (recorded, _) = recorded();
    assert!(recorded.len() > 5, "{recorded:?}");
    assert!(recorded.iter().all(|[_, residual, bound]| *residual <= bound * 1.001), "{recorded:?}");
}

/// The variable `PYTHON` selects the Python.
#[test]
#[ignore = "requires NumPy"]
fn numpy_reproduces_the_log_of_the_block() {
    let (recorded, force) = recorded();
    let python = std::env::var("PYTHON").unwrap_or("python3".into());
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new(&python).arg(root.join("examples/block.py")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let (rows, found) = augmentations(&String::from_utf8(output.stdout).unwrap());
    assert!((found / force - 1.0).abs() < 1e-5, "{found} instead of {force}");
    assert_eq!(rows.len(), recorded.len(), "{rows:?}");
    // Displacements of 0.02 mm and a condition number of 10⁴ leave 10⁻¹³ mm, a part of the last residuals.
    for ([_, found, _], [k, expected, _]) in rows.iter().zip(&recorded) {
        assert!((found - expected).abs() < 1e-3 * expected + 1e-13, "k = {k}: {found} instead of {expected}");
    }
}

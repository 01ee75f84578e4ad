//! What follows from what, as a picture.

use crate::claims::{Entry, claim_names};
use crate::formula::Statement;
use crate::proof::prove;
use std::fmt::Write;

/// A graph for Graphviz: an arrow from each of these entries to what follows from it, and how much of what is
/// claimed of each is proved.
///
/// ```
/// use spring_mass_contact::{claims::entry, verify::graph};
/// let text = graph(&["1.5", "1.6"].map(|number| entry(number).unwrap()));
/// assert!(text.contains(r#""1.5" -> "1.6";"#) && !text.contains("NOT PROVED"));
/// ```
pub fn graph(entries: &[&Entry]) -> String {
    let mut text = "digraph chapter {\n  rankdir = LR;\n  node [shape = box, style = rounded];\n".to_string();
    for Entry { equation, title, claims, .. } in entries {
        let proved = claims.iter().filter(|claim| prove(&Statement::of(claim)).is_ok()).count();
        let (status, colour) = match (claims.len(), proved) {
            (0, _) if claim_names(equation).is_empty() => ("given".to_string(), "gray"),
            (0, _) => ("checked in numbers".to_string(), "gray"),
            (all, proved) if proved < all => (format!("{} NOT PROVED", all - proved), "red"),
            (_, proved) => (format!("{proved} proved"), "darkgreen"),
        };
        let label = format!("{equation}\\n{title}\\n{status}");
        let _ = writeln!(text, "  \"{equation}\" [label = \"{label}\", color = {colour}];");
    }
    for Entry { equation, follows_from, .. } in entries {
        for premise in follows_from.iter().filter(|premise| entries.iter().any(|e| e.equation == **premise)) {
            let _ = writeln!(text, "  \"{premise}\" -> \"{equation}\";");
        }
    }
    text + "}\n"
}

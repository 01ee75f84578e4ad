//! Graph of the dependencies of equations.

use spring_mass_contact::claims::Entry;
use spring_mass_contact::proof::prove;
use spring_mass_contact::verify::claim_names;
use std::fmt::Write;

/// Returns a graph for Graphviz: an arrow from each entry to those derived from it, and the number of its
/// proved claims.
pub fn graph(entries: &[&Entry]) -> String {
    let mut text = "digraph chapter {\n  rankdir = LR;\n  node [shape = box, style = rounded];\n".to_string();
    for Entry { equation, title, claims, .. } in entries {
        let proved = claims.iter().filter(|claim| prove(claim).is_ok()).count();
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

#[cfg(test)]
mod tests {
    use super::*;
    use spring_mass_contact::claims::entry;
    use spring_mass_contact::formula::claim::equal;
    use spring_mass_contact::number::Tree;

    #[test]
    fn a_graph_distinguishes_proved_and_unproved_claims() {
        let mut changed = entry("1.13").unwrap().clone();
        let claim = |name, right: i32| equal(name, Tree::from(1) + Tree::from(1), right);
        let mut with = |claims: &[(&'static str, i32)]| {
            changed.claims = claims.iter().map(|(name, right)| claim(name, *right)).collect();
            graph(&[&changed])
        };
        assert!(with(&[("right", 2)]).contains("\\n1 proved\", color = darkgreen"));
        assert!(with(&[("right", 2), ("wrong", 3), ("worse", 4)]).contains("\\n2 NOT PROVED\", color = red"));
        assert!(with(&[]).contains("\\nchecked in numbers\", color = gray"), "there are experiments");
        assert!(graph(&[entry("Fig. 1.1").unwrap()]).contains("\\ngiven\", color = gray"));
    }

    #[test]
    fn edges_connect_displayed_nodes_only() {
        let derived = entry("1.6").unwrap();
        assert!(derived.follows_from.contains(&"1.5"));
        assert!(!graph(&[derived]).contains("->"));
        assert_eq!(graph(&[derived, entry("1.5").unwrap()]).matches("->").count(), 1);
    }
}

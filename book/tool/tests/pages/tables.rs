//! Checks of text written by hand: the numbers in tables, the names of code items, and the labels of sources.

use super::page;
use crate::files::{files, root, text};
use book_tool::PAGES;
use regex::Regex;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, penalty, system};
use spring_mass_contact::number::Exact;
use std::path::PathBuf;

fn exact(text: &str) -> Exact {
    text.replace('−', "-").parse().unwrap_or_else(|_| panic!("{text} is not a number"))
}

fn example(g: &str) -> SpringMass<Exact> {
    SpringMass { c: "4", m: "1", g, l: "1", h: "3" }.map(exact)
}

/// Returns the rows of the table with this head, of which there have to be `count`.
fn rows(name: &str, head: &str, count: usize) -> Vec<Vec<String>> {
    let page = page(name);
    let (_, table) = page.split_once(&format!("\n{head}\n")).unwrap_or_else(|| panic!("no table {head}"));
    let cells = |row: &str| row.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect();
    let rows: Vec<_> = table.lines().skip(1).take_while(|line| line.starts_with('|')).map(cells).collect();
    assert_eq!(rows.len(), count, "{name}: {head}");
    rows
}

fn assert_row(row: &[String], expected: &[Exact]) {
    let found: Vec<_> = row.iter().map(|cell| exact(cell)).collect();
    assert_eq!(found, expected, "{row:?}");
}

#[test]
fn tables_agree_with_the_functions() {
    let default = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.map(exact);
    let head = r"| system | $c$ | $m$ | $g$ | $l$ | $H$ | $\Delta$ | $m\,g$ | $R$ |";
    for (row, s) in rows("introduction", head, 2).iter().zip([example("10"), default]) {
        let derived = [system::gap(&s), system::weight(&s), system::reaction(&s)];
        let parameters = [&s.c, &s.m, &s.g, &s.l, &s.h].map(Exact::clone);
        assert_row(&row[1..], &[&parameters[..], &derived].concat());
    }

    let head = r"| $g$ | $R = g - 8$ | state | $u^* = \min(g/4, 2)$ | $p^*$ | $N^*$ |";
    for row in rows("contact", head, 3) {
        let s = example(&row[0]);
        let (u, r) = (contact::deflection(&s), system::reaction(&s));
        let state = ["separated", "grazing", "contact"][(r.cmp(&exact("0")) as i8 + 1) as usize];
        assert_eq!(row[2], state);
        assert_row(&row[1..2], &[r]);
        let p = contact::penetration(&s, &u);
        assert_row(&row[3..], &[u, p, contact::contact_force(&s)]);
    }

    let s = example("10");
    let head = r"| $\varepsilon$ | $c + \varepsilon$ | $p = 2/(c + \varepsilon)$ | $u = 2 + p$ | $N = \varepsilon\,p$ | $R - N = 4p$ |";
    for row in rows("penalty", head, 4) {
        let eps = exact(&row[0]);
        let u = penalty::deflection(&s, &eps);
        let force = penalty::contact_force(&s, &eps, &u);
        let missing = system::reaction(&s) - &force;
        let total = penalty::total_stiffness(&s, &eps);
        let p = contact::penetration(&s, &u);
        assert_row(&row[1..], &[total, p, u, force, missing]);
    }

    let head = r"| $k$ | $\lambda_k$ | $u_k$ | $p_k = u_k - 2$ | $\lambda_k + 4p_k$ |";
    let (eps, mut lambda) = (exact("4"), exact("0"));
    for (k, row) in rows("augmented", head, 4).iter().enumerate() {
        let u = augmented::deflection(&s, &eps, &lambda);
        let next = augmented::update(&s, &eps, &lambda, &u);
        let p = contact::penetration(&s, &u);
        assert_row(row, &[exact(&k.to_string()), lambda, u, p, next.clone()]);
        lambda = next;
    }

    // Three decimals, so the error is at most half of the third.
    let head = r"| $k$ | $\mathrm e^{-k}$ | $\rho^k = 2^{-k}$ | $\mathrm e^{-k/2}$ |";
    for row in rows("convergence", head, 3) {
        let [k, below, iterate, above] = [0, 1, 2, 3].map(|i| row[i].parse::<f64>().unwrap());
        for (found, exact) in [(below, (-k).exp()), (iterate, 0.5_f64.powf(k)), (above, (-k / 2.0).exp())] {
            assert!((found - exact).abs() <= 0.5e-3, "{row:?}: {found} for {exact}");
        }
    }
}

/// Code such as `penalty::force` in the text names an existing item of that module.
#[test]
fn named_items_exist() {
    let name = Regex::new(r"`(\w+)::(\w+)`").unwrap();
    let sources = files(&root().join("src"), ".rs");
    let mut seen = 0;
    for page_name in PAGES {
        for found in name.captures_iter(&page(page_name)) {
            let (module, item) = (&found[1], &found[2]);
            // A module has a file, here or in `chapter`, and may have a folder.
            let places = ["src/chapter", "src"].map(|folder| root().join(folder).join(module));
            let is_part = |path: &&PathBuf| {
                places.iter().any(|place| path.starts_with(place) || **path == place.with_extension("rs"))
            };
            let text: String = sources.iter().filter(is_part).map(text).collect();
            let declared = format!(r"\bpub (?:const )?(?:fn|struct|enum|trait|const|type|mod) {item}\b");
            // Without sources it is an associated item, or one of another crate.
            let exists = text.is_empty() || Regex::new(&declared).unwrap().is_match(&text);
            assert!(exists, "{page_name}.md names {module}::{item}, which does not exist");
            seen += usize::from(!text.is_empty());
        }
    }
    assert!(seen > 20, "{seen}");
}

/// The words of the id of a source are in its label, such as `courant-1943` and **Courant 1943**.
#[test]
fn ids_of_sources_agree_with_their_labels() {
    let entry = Regex::new(r#"(?m)^- <span id="([\w-]+)">\*\*([^*]+)\.\*\*</span>"#).unwrap();
    let page = page("sources");
    let found: Vec<_> = entry.captures_iter(&page).collect();
    assert_eq!(found.len(), page.matches("\n- ").count(), "a source has no id and label");
    for found in found {
        let label = found[2].to_lowercase().replace('é', "e");
        assert!(found[1].split('-').all(|word| label.contains(word)), "{} is not {label}", &found[1]);
    }
}

//! What pages write by hand and no snippet holds: the numbers in their tables, the code's names, the labels of sources.

use super::files::root;
use super::page;
use book_tool::PAGES;
use regex::Regex;
use spring_mass_contact::chapter::{SpringMass, augmented, contact, penalty, system};
use spring_mass_contact::number::Exact;
use std::fs;

fn exact(text: &str) -> Exact {
    text.replace('−', "-").parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

fn example(g: &str) -> SpringMass<Exact> {
    SpringMass { c: "4", m: "1", g, l: "1", h: "3" }.map(|text| exact(text))
}

/// The rows of the table with this head.
fn rows(page: &str, head: &str) -> Vec<Vec<String>> {
    let (_, table) = page.split_once(&format!("\n{head}\n")).unwrap_or_else(|| panic!("no table {head}"));
    let cells = |row: &str| row.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect();
    table.lines().skip(1).take_while(|line| line.starts_with('|')).map(cells).collect()
}

fn assert_row(row: &[String], expected: &[Exact]) {
    let found: Vec<_> = row.iter().map(|cell| exact(cell)).collect();
    assert_eq!(found, expected, "{row:?}");
}

#[test]
fn tables_by_hand_are_what_the_functions_compute() {
    let default = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.map(|text| exact(text));
    let head = r"| system | $c$ | $m$ | $g$ | $l$ | $H$ | $\Delta$ | $m\,g$ | $R$ |";
    let systems = rows(&page("introduction"), head);
    assert_eq!(systems.len(), 2);
    for (row, s) in systems.iter().zip([example("10"), default]) {
        let made = [system::gap(&s), system::weight(&s), system::reaction(&s)];
        let given = [&s.c, &s.m, &s.g, &s.l, &s.h].map(Exact::clone);
        assert_row(&row[1..], &[&given[..], &made].concat());
    }

    let head = r"| $g$ | $R = g - 8$ | state | $u^* = \min(g/4, 2)$ | $p^*$ | $N^*$ |";
    let states = rows(&page("contact"), head);
    assert_eq!(states.len(), 3);
    for row in states {
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
    let penalties = rows(&page("penalty"), head);
    assert_eq!(penalties.len(), 4);
    for row in penalties {
        let eps = exact(&row[0]);
        let u = penalty::deflection(&s, &eps);
        let force = penalty::contact_force(&s, &eps, &u);
        let missing = system::reaction(&s) - &force;
        let total = penalty::total_stiffness(&s, &eps);
        let p = contact::penetration(&s, &u);
        assert_row(&row[1..], &[total, p, u, force, missing]);
    }

    let head = r"| $k$ | $\lambda_k$ | $u_k$ | $p_k = u_k - 2$ | $\lambda_k + 4p_k$ |";
    let (steps, eps, mut lambda) = (rows(&page("augmented"), head), exact("4"), exact("0"));
    assert_eq!(steps.len(), 4);
    for (k, row) in steps.iter().enumerate() {
        let u = augmented::deflection(&s, &eps, &lambda);
        let next = augmented::update(&s, &eps, &lambda, &u);
        let p = contact::penetration(&s, &u);
        assert_row(row, &[exact(&k.to_string()), lambda, u, p, next.clone()]);
        lambda = next;
    }

    // Three digits after the point, so within half of the third.
    let head = r"| $k$ | $\mathrm e^{-k}$ | $\rho^k = 2^{-k}$ | $\mathrm e^{-k/2}$ |";
    for row in rows(&page("convergence"), head) {
        let [k, below, iterate, above] = [0, 1, 2, 3].map(|i| row[i].parse::<f64>().unwrap());
        for (found, meant) in [(below, (-k).exp()), (iterate, 0.5_f64.powf(k)), (above, (-k / 2.0).exp())] {
            assert!((found - meant).abs() <= 0.5e-3, "{row:?}: {found} for {meant}");
        }
        assert!(below < iterate && iterate < above);
    }
}

/// `penalty::force` in a line of text is a function, a type or a constant of that module.
#[test]
fn what_is_named_in_code_exists() {
    let name = Regex::new(r"`(\w+)::(\w+)`").unwrap();
    let mut seen = 0;
    for page_name in PAGES {
        for found in name.captures_iter(&page(page_name)) {
            let (module, item) = (&found[1], &found[2]);
            let own = ["chapter/", ""].map(|folder| format!("src/{folder}{module}.rs"));
            let sources: String = own
                .into_iter()
                .chain(folder(module))
                .filter_map(|file| fs::read_to_string(root().join(file)).ok())
                .collect();
            if sources.is_empty() {
                continue; // a type's own, or another crate's
            }
            let declared = format!(r"\bpub (?:const )?(?:fn|struct|enum|trait|const|type|mod) {item}\b");
            assert!(
                Regex::new(&declared).unwrap().is_match(&sources),
                "{page_name}.md names {module}::{item}, which is nowhere"
            );
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen}");
}

/// Returns the files of a module that has a folder, and of the folders in it.
fn folder(module: &str) -> Vec<String> {
    let entries = fs::read_dir(root().join("src").join(module)).into_iter().flatten();
    let paths = entries.map(|entry| format!("{module}/{}", entry.unwrap().file_name().to_str().unwrap()));
    paths.flat_map(|path| [vec![format!("src/{path}")], folder(&path)].concat()).collect()
}

/// `courant-1943` is **Courant 1943**, a work of that year.
#[test]
fn sources_are_what_their_addresses_say() {
    let entry = Regex::new(r#"^<span id="([\w-]+)">\*\*([^*]+)\.\*\*</span>"#).unwrap();
    let other = Regex::new(r"[^a-z0-9]+").unwrap();
    let mut seen = 0;
    for text in page("sources").split("\n- ").skip(1) {
        let found = entry.captures(text).unwrap_or_else(|| panic!("no address and label: {text}"));
        // Later years, and what connects the names, are not in the address.
        let label = found[2].to_lowercase().replace('é', "e");
        let label = label.split(", 20").next().unwrap().replace(" and others", "").replace(" and ", " ");
        assert_eq!(other.replace_all(&label, "-"), found[1]);
        seen += 1;
    }
    assert!(seen > 25, "{seen}");
}

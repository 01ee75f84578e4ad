//! Contrast of links, code and drawings in each of mdBook's themes, computed by the formula of WCAG 2 from the colours in
//! the style sheets.

use super::with_extension;
use csscolorparser::Color;
use regex::Regex;
use std::collections::BTreeMap;

/// Minimum contrast of text and of graphics according to WCAG.
const TEXT: f64 = 4.5;
const DRAWN: f64 = 3.0;

/// Returns the text of a style sheet, without comments.
fn css(part: &str) -> String {
    let named = |name: &str| name.starts_with(&format!("{part}-")) || name == format!("{part}.css");
    let mut sheets = with_extension("css");
    let (_, css) = sheets.find(|(path, _)| named(path.file_name().unwrap().to_str().unwrap())).expect(part);
    Regex::new(r"(?s)/\*.*?\*/").unwrap().replace_all(css, "").into()
}

/// Returns the variables of a theme: those of mdBook, followed by ours.
fn variables(theme: &str) -> BTreeMap<String, String> {
    let rule = Regex::new(r"(?s)([^{}]*)\{([^{}]*)\}").unwrap();
    let variable = Regex::new(r"(--[\w-]+):\s*([^;]+);").unwrap();
    let mut variables = BTreeMap::new();
    for part in ["variables", "book", "figures"] {
        // Media queries on the system's theme only apply without scripts.
        for found in rule.captures_iter(css(part).split("@media").next().unwrap()) {
            let selects = |selector: &str| [":root", &format!(".{theme}")].contains(&selector.trim());
            if found[1].split(',').any(selects) {
                let set = variable.captures_iter(&found[2]);
                variables.extend(set.map(|set| (set[1].to_string(), set[2].trim().to_string())));
            }
        }
    }
    variables
}

/// Returns the luminance of a colour, of the second of a pair if the theme is dark.
fn luminance(text: &str, dark: bool) -> f64 {
    let pair = text.strip_prefix("light-dark(").and_then(|pair| pair.strip_suffix(')')?.split_once(", "));
    let text = pair.map_or(text, |(light, other)| if dark { other } else { light });
    let [r, g, b, _] = text.parse::<Color>().unwrap_or_else(|_| panic!("{text}")).to_linear_rgba();
    f64::from(0.2126 * r + 0.7152 * g + 0.0722 * b)
}

#[test]
fn links_code_and_drawings_have_sufficient_contrast() {
    // The themes with their style of code, and the rules of book.css for code.
    let themes = [
        ("light", "highlight"),
        ("rust", "highlight"),
        ("coal", "tomorrow-night"),
        ("navy", "tomorrow-night"),
        ("ayu", "ayu-highlight"),
    ];
    let rule = Regex::new(r"(?m)^([^{}\n]*\.hljs-[^{}]*)\{\s*color: ([^;]+);").unwrap();
    let ground = Regex::new(r"(?s)\.hljs \{[^}]*background: ([^;]+);").unwrap();
    let mut rules = 0;
    for (theme, code) in themes {
        let variables = variables(theme);
        let dark = variables.get("--color-scheme").is_some_and(|scheme| scheme == "dark");
        let check = |text: &str, ground: &str, least: f64| {
            let value =
                |name: &str| if name.starts_with("--") { variables[name].clone() } else { name.into() };
            let [a, b] = [text, ground].map(|name| luminance(&value(name), dark));
            let contrast = (a.max(b) + 0.05) / (a.min(b) + 0.05);
            assert!(contrast >= least, "{theme}: {text} on {ground} has {contrast:.2}");
        };
        for ground in ["--bg", "--quote-bg", "--table-alternate-bg"] {
            check("--links", ground, TEXT);
        }
        check("--sidebar-active", "--sidebar-bg", TEXT);
        check("--fg", "--table-header-bg", TEXT);
        let drawn: Vec<_> = variables.keys().filter(|name| name.starts_with("--figure-")).collect();
        assert_eq!(drawn.len(), 4);
        drawn.iter().for_each(|name| check(name, "--bg", DRAWN));
        for found in rule.captures_iter(&css("book")).filter(|found| found[1].contains(&format!(".{theme}")))
        {
            check(&found[2], &ground.captures(&css(code)).expect("a ground")[1], TEXT);
            rules += 1;
        }
    }
    assert_eq!(rules, 3);
}

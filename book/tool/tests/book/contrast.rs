//! Contrast of links and drawings in each of mdBook's themes, computed by the formula of WCAG 2 from the colours in the
//! style sheets.

use super::with_extension;
use regex::Regex;
use std::collections::BTreeMap;

const THEMES: [&str; 5] = ["light", "rust", "coal", "navy", "ayu"];

/// Minimum contrast of text and of graphics according to WCAG.
const TEXT: f64 = 4.5;
const DRAWN: f64 = 3.0;

/// Returns the variables of a theme: those of mdBook, followed by ours.
fn variables(theme: &str) -> BTreeMap<String, String> {
    let rule = Regex::new(r"(?s)([^{}]*)\{([^{}]*)\}").unwrap();
    let variable = Regex::new(r"(--[\w-]+):\s*([^;]+);").unwrap();
    let comment = Regex::new(r"(?s)/\*.*?\*/").unwrap();
    let mut variables = BTreeMap::new();
    for part in ["variables", "book", "figures"] {
        let named = |name: &str| name.starts_with(&format!("{part}-")) || name == format!("{part}.css");
        let (_, css) = with_extension("css")
            .find(|(path, _)| named(path.file_name().unwrap().to_str().unwrap()))
            .unwrap_or_else(|| panic!("no style sheet {part}"));
        let css = comment.replace_all(css, "");
        // Media queries on the system's theme only apply without scripts.
        let css = css.split("@media").next().unwrap();
        for found in rule.captures_iter(css) {
            let selects = |selector: &str| [":root", &format!(".{theme}")].contains(&selector.trim());
            if found[1].split(',').any(selects) {
                for found in variable.captures_iter(&found[2]) {
                    variables.insert(found[1].to_string(), found[2].trim().to_string());
                }
            }
        }
    }
    variables
}

/// Returns red, green and blue from 0 to 1.
fn colour(text: &str, dark: bool) -> [f64; 3] {
    let text = text.trim();
    if let Some(two) = text.strip_prefix("light-dark(") {
        let (light, other) = two.strip_suffix(')').unwrap().split_once(", ").unwrap();
        return colour(if dark { other } else { light }, dark);
    }
    if let Some(hex) = text.strip_prefix('#') {
        let digits: Vec<_> = hex.chars().map(|c| f64::from(c.to_digit(16).unwrap())).collect();
        return match digits[..] {
            [r, g, b] => [r, g, b].map(|x| x / 15.0),
            [a, b, c, d, e, f] => [16.0 * a + b, 16.0 * c + d, 16.0 * e + f].map(|x| x / 255.0),
            _ => panic!("{text}"),
        };
    }
    let hsl =
        text.strip_prefix("hsl(").and_then(|hsl| hsl.strip_suffix(')')).unwrap_or_else(|| panic!("{text}"));
    let parts: Vec<f64> =
        hsl.split(',').map(|part| part.trim().trim_end_matches('%').parse().unwrap()).collect();
    let [hue, saturation, lightness] = [parts[0], parts[1] / 100.0, parts[2] / 100.0];
    let amount = saturation * lightness.min(1.0 - lightness);
    [0.0, 8.0, 4.0].map(|n: f64| {
        let k = (n + hue / 30.0) % 12.0;
        lightness - amount * (k - 3.0).min(9.0 - k).clamp(-1.0, 1.0)
    })
}

fn contrast(a: [f64; 3], b: [f64; 3]) -> f64 {
    let linear = |x: f64| if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
    let luminance = |[r, g, b]: [f64; 3]| 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    let [a, b] = [a, b].map(luminance);
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

#[test]
fn black_on_white_has_contrast_21() {
    assert!((contrast(colour("#000", false), colour("hsl(0, 0%, 100%)", false)) - 21.0).abs() < 1e-9);
    // From the definition of hsl: pure red, green and blue.
    for (hue, hex) in [(0, "#f00"), (120, "#0f0"), (240, "#00f")] {
        let [a, b] = [format!("hsl({hue}, 100%, 50%)"), hex.into()].map(|text| colour(&text, false));
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{hex}: {a:?}");
    }
}

/// The code colours of book.css have sufficient contrast with the background of each theme's code style.
#[test]
fn redefined_code_colours_have_sufficient_contrast() {
    let css = |part: &str| {
        let named = |path: &std::path::Path| path.file_name().unwrap().to_str().unwrap().starts_with(part);
        with_extension("css").find(|(path, _)| named(path)).unwrap_or_else(|| panic!("no {part}")).1
    };
    let rule = Regex::new(r"(?m)^([^{}\n]*\.hljs-[^{}]*)\{\s*color: ([^;]+);").unwrap();
    let ground = Regex::new(r"(?s)\.hljs \{[^}]*background: ([^;]+);").unwrap();
    let mut seen = 0;
    for found in rule.captures_iter(css("book")) {
        for theme in THEMES.into_iter().filter(|theme| found[1].contains(&format!(".{theme}"))) {
            let code = css(match theme {
                "ayu" => "ayu-highlight",
                "coal" | "navy" => "tomorrow-night",
                _ => "highlight",
            });
            let ground = colour(&ground.captures(code).expect("a ground")[1], theme != "light");
            let found = contrast(colour(&found[2], theme != "light"), ground);
            assert!(found >= TEXT, "{theme}: {found:.2}");
            seen += 1;
        }
    }
    assert_eq!(seen, 3);
}

#[test]
fn links_and_drawings_have_sufficient_contrast() {
    for theme in THEMES {
        let variables = variables(theme);
        let dark = variables.get("--color-scheme").is_some_and(|scheme| scheme == "dark");
        let value =
            |name: &str| colour(variables.get(name).unwrap_or_else(|| panic!("{theme}: no {name}")), dark);
        let texts = [("--links", "--bg"), ("--links", "--quote-bg"), ("--links", "--table-alternate-bg")];
        let others = [("--sidebar-active", "--sidebar-bg"), ("--fg", "--table-header-bg")];
        for (text, ground) in texts.into_iter().chain(others) {
            let found = contrast(value(text), value(ground));
            assert!(found >= TEXT, "{theme}: {text} on {ground} has {found:.2}");
        }
        let drawn: Vec<_> = variables.keys().filter(|name| name.starts_with("--figure-")).collect();
        assert!(drawn.len() >= 4);
        for name in drawn {
            let found = contrast(value(name), value("--bg"));
            assert!(found >= DRAWN, "{theme}: {name} has {found:.2}");
        }
    }
}

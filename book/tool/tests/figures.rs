//! Tests of the figures: numbers are read off the axes and compared with numbers computed by hand.

use book_tool::figure::{figure, names};
use regex::{Captures, Regex};
use std::{
    collections::BTreeMap,
    fs,
    ops::RangeInclusive,
    path::{Path, PathBuf},
    sync::LazyLock,
};

type Point = (f64, f64);

fn source(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("src").join(path)
}

/// Returns all matches of a pattern.
fn found<'a>(pattern: &str, text: &'a str) -> Vec<Captures<'a>> {
    Regex::new(pattern).unwrap().captures_iter(text).collect()
}

fn float(text: &str) -> f64 {
    text.replace('−', "-").parse().unwrap_or_else(|_| panic!("{text} is not a number"))
}

/// Text element of a figure.
struct Text {
    class: String,
    at: Point,
    anchor: String,
    /// Whether the text has an exponent.
    raised: bool,
    label: String,
}

/// Parsed figure.
struct Picture {
    name: &'static str,
    svg: String,
    size: Point,
    paths: Vec<(String, Vec<Point>)>,
    marks: Vec<(String, Point, f64, String)>,
    texts: Vec<Text>,
}

fn picture(name: &str) -> &'static Picture {
    PICTURES.iter().find(|picture| picture.name == name).unwrap_or_else(|| panic!("no figure {name}"))
}

static PICTURES: LazyLock<Vec<Picture>> = LazyLock::new(|| names().map(read).collect());

fn read(name: &'static str) -> Picture {
    let svg = figure(name).unwrap_or_else(|| panic!("no figure {name}")).inline();
    let view = &found(r#"viewBox="0 0 (\S+) (\S+)""#, &svg)[0];
    let points = |d: &str| {
        let numbers: Vec<f64> =
            d.split(|c: char| "MLZ ".contains(c)).filter(|n| !n.is_empty()).map(float).collect();
        numbers.chunks(2).map(|pair| (pair[0], pair[1])).collect()
    };
    let marks =
        r#"<circle class="([^"]*)" cx="([^"]*)" cy="([^"]*)" r="([^"]*)"(?:/>|><title>(.*?)</title>)"#;
    let texts = r#"<text class="([^"]*)" x="([^"]*)" y="([^"]*)" text-anchor="([^"]*)">(.*?)</text>"#;
    Picture {
        name,
        size: (float(&view[1]), float(&view[2])),
        paths: found(r#"<path class="([^"]*)" d="([^"]*)"/>"#, &svg)
            .iter()
            .map(|path| (path[1].to_string(), points(&path[2])))
            .collect(),
        marks: found(marks, &svg)
            .iter()
            .map(|mark| {
                let label = mark.get(5).map_or("", |label| label.as_str());
                (mark[1].to_string(), (float(&mark[2]), float(&mark[3])), float(&mark[4]), label.to_string())
            })
            .collect(),
        texts: found(texts, &svg)
            .iter()
            .map(|text| Text {
                class: text[1].to_string(),
                at: (float(&text[2]), float(&text[3])),
                anchor: text[4].to_string(),
                raised: text[5].contains("dy=\"-"),
                label: Regex::new("<[^>]*>").unwrap().replace_all(&text[5], "").into_owned(),
            })
            .collect(),
        svg,
    }
}

/// Scale of an axis, determined from its tick labels.
struct Scale {
    ticks: Vec<(f64, f64)>,
    logarithmic: bool,
}

impl Scale {
    /// Returns the scale for tick positions and labels, which are numbers or powers of ten.
    fn of(places: Vec<f64>, texts: &[&Text]) -> Self {
        let powers: Option<Vec<_>> = texts.iter().map(|text| text.label.strip_prefix("10")).collect();
        let powers = powers.filter(|powers| !powers.contains(&""));
        let logarithmic = powers.is_some();
        let values = powers.unwrap_or_else(|| texts.iter().map(|text| text.label.as_str()).collect());
        assert!(texts.len() >= 2, "an axis needs two labels");
        Scale { ticks: places.into_iter().zip(values.into_iter().map(float)).collect(), logarithmic }
    }

    fn position(&self, number: f64) -> f64 {
        let number = if self.logarithmic { number.log10() } else { number };
        let [(a, x), .., (b, y)] = self.ticks[..] else { unreachable!("two at least") };
        a + (number - x) / (y - x) * (b - a)
    }
}

/// Tolerance in pixels. Coordinates are written in hundredths of a pixel; two coordinates and two ticks contribute half
/// a hundredth each, and extrapolation beyond the ticks at most half of that again.
const TOLERANCE: f64 = 0.03;

/// Maximum distance in pixels between a curve and its chords.
const CHORD: f64 = 0.1;

impl Picture {
    /// Returns the position of a point according to the tick labels.
    fn at(&self, (x, y): Point) -> Point {
        let ticks = self.texts.iter().filter(|text| text.class == "tick");
        let (below, beside): (Vec<_>, Vec<_>) = ticks.partition(|text| text.anchor == "middle");
        let lines = |horizontal: bool| -> Vec<f64> {
            let ticks = self.paths.iter().filter(|(class, _)| class == "tick").map(|(_, points)| points);
            let along = ticks.filter(|points| (points[0].1 == points[1].1) == horizontal);
            along.map(|points| if horizontal { points[0].1 } else { points[0].0 }).collect()
        };
        let (columns, rows) = (lines(false), lines(true));
        assert_eq!((columns.len(), rows.len()), (below.len(), beside.len()), "{}: ticks", self.name);
        for (text, x) in below.iter().zip(&columns) {
            assert_eq!(text.at.0, *x, "{}: {} is not at its tick", self.name, text.label);
        }
        for (text, y) in beside.iter().zip(&rows) {
            assert!((text.at.1 - y - 4.5).abs() < 0.011, "{}: {} is not at its tick", self.name, text.label);
        }
        (Scale::of(columns, &below).position(x), Scale::of(rows, &beside).position(y))
    }

    /// Asserts that there is a mark with this label at this point.
    fn marks(&self, label: &str, point: Point) {
        let expected = self.at(point);
        let mark = self.marks.iter().find(|(.., text)| text == label);
        let (_, at, ..) = mark
            .unwrap_or_else(|| panic!("{}: no mark has the label {label:?}: {:?}", self.name, self.marks));
        let close = (at.0 - expected.0).hypot(at.1 - expected.1) <= TOLERANCE;
        assert!(close, "{}: {label} is at {at:?} and not at {expected:?}", self.name);
    }

    /// Asserts that a line of this class passes through these points.
    fn passes(&self, class: &str, points: &[Point]) {
        let reaches = |line: &[Point], (x, y): Point| {
            line.windows(2).any(|pair| {
                let [(a, b), (c, d)] = [pair[0], pair[1]];
                let length = (c - a).powi(2) + (d - b).powi(2);
                let share = (((x - a) * (c - a) + (y - b) * (d - b)) / length).clamp(0.0, 1.0);
                (a + share * (c - a) - x).hypot(b + share * (d - b) - y) <= TOLERANCE.max(CHORD)
            })
        };
        let positions: Vec<_> = points.iter().map(|point| self.at(*point)).collect();
        let mut lines = self.paths.iter().filter(|(found, _)| found == class).map(|(_, line)| line);
        let passes = lines.any(|line| positions.iter().all(|position| reaches(line, *position)));
        assert!(passes, "{}: no line of class {class:?} passes through {points:?}", self.name);
    }
}

/// Points on the line c p + N = R of the example.
const EQUILIBRIUM: [Point; 3] = [(0.0, 2.0), (0.25, 1.0), (0.5, 0.0)];

#[test]
fn solution_is_intersection_of_equilibrium_and_corner() {
    let plane = picture("plane");
    plane.marks("The answer: p = 0, N = 2", (0.0, 2.0));
    plane.passes("spring", &EQUILIBRIUM);
    plane.passes("plane thick", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.4)]);
}

#[test]
fn figures_of_the_example_have_the_same_ranges() {
    let corners = |name| [(-0.2, -0.4), (0.6, 2.4)].map(|corner| picture(name).at(corner));
    for name in ["equilibrium", "free", "methods", "multiplier", "penalty", "augmented", "relaxed", "step"] {
        assert_eq!(corners(name), corners("plane"), "{name}");
        assert_eq!(picture(name).size, picture("plane").size, "{name}");
        picture(name).passes("spring", &EQUILIBRIUM);
    }
}

#[test]
fn axes_increase_to_the_right_and_upwards() {
    let plots = PICTURES.iter().filter(|picture| picture.texts.iter().any(|text| text.class == "tick"));
    let ends = plots.map(|picture| (picture.at((0.1, 0.1)), picture.at((0.2, 0.2))));
    let increasing: Vec<_> = ends.map(|(low, high)| low.0 < high.0 && low.1 > high.1).collect();
    assert!(increasing.len() > 10 && increasing.iter().all(|it| *it), "{increasing:?}");
}

#[test]
fn equilibrium_has_the_right_intercepts() {
    let held = picture("equilibrium");
    held.marks("Held at the plane: p = 0, N = 2", (0.0, 2.0));
    held.marks("Without the plane: p = 0.5, N = 0", (0.5, 0.0));
    let free = picture("free");
    free.marks("The free mass: p = 0.5, N = 0", (0.5, 0.0));
    free.passes("thick", &[(-0.2, 0.0), (0.5, 0.0)]);
}

/// Expected values: the table in contact.md.
#[test]
fn states_agree_with_the_table() {
    let states = picture("states");
    states.marks("g = 10, contact: p = 0, N = 2", (0.0, 2.0));
    states.marks("g = 8, grazing: p = 0, N = 0", (0.0, 0.0));
    states.marks("g = 4, separated: p = −1, N = 0", (-1.0, 0.0));
    states.passes("spring", &EQUILIBRIUM);
    states.passes("spring dashed", &[(-0.5, 2.0), (0.0, 0.0)]);
    states.passes("spring dotted", &[(-1.5, 2.0), (-1.0, 0.0)]);
}

#[test]
fn multiplier_line_extends_to_negative_forces() {
    let multiplier = picture("multiplier");
    multiplier.marks("The multiplier method: p = 0, N = 2", (0.0, 2.0));
    multiplier.passes("plane thick", &[(0.0, 0.0), (0.0, 2.4)]);
    multiplier.passes("plane thick dashed", &[(0.0, 0.0), (0.0, -0.4)]);
}

/// Expected values: the table in formulations.md with ε = 4.
#[test]
fn methods_agree_with_the_table() {
    let methods = picture("methods");
    methods.marks("Lagrange multiplier: p = 0, N = 2", (0.0, 2.0));
    methods.marks("Penalty: p = 0.25, N = 1", (0.25, 1.0));
    methods.marks("Augmented, k = 3: p = 0.03125, N = 1.875", (0.03125, 1.875));
    methods.passes("plane thick", &[(0.0, -0.4), (0.0, 2.4)]);
    methods.passes("penalty dashed", &[(0.0, 0.0), (0.25, 1.0), (0.5, 2.0)]);
    methods.passes("iterate dotted", &[(0.0, 1.75), (0.03125, 1.875)]);
}

/// Expected values: the table in penalty.md.
#[test]
fn penalties_agree_with_the_table() {
    let penalty = picture("penalty");
    for (eps, p, n) in [("4", 0.25, 1.0), ("16", 0.1, 1.6), ("36", 0.05, 1.8)] {
        penalty.marks(&format!("ε = {eps}: p = {p}, N = {n}"), (p, n));
        penalty.passes("penalty", &[(0.0, 0.0), (p, n), (p * 1.2, n * 1.2)]);
    }
    // The dimension R − N at ε = 4 has arrowheads of 9 pixels.
    let (low, high) = (penalty.at((0.25, 1.0)), penalty.at((0.25, 2.0)));
    let tips: Vec<_> =
        penalty.paths.iter().filter(|(class, _)| class == "fine head").map(|(_, head)| head[1]).collect();
    for (tip, end) in tips.iter().zip([low, high]) {
        assert!((tip.0 - end.0).hypot(tip.1 - end.1) <= TOLERANCE, "{tips:?}");
    }
    assert_eq!(tips.len(), 2);
}

/// Expected values: the table in augmented.md.
#[test]
fn iterates_agree_with_the_table() {
    let augmented = picture("augmented");
    let rows = [(0.0, 0.25, 1.0), (1.0, 0.125, 1.5), (1.5, 0.0625, 1.75), (1.75, 0.03125, 1.875)];
    for (k, (lambda, p, next)) in rows.into_iter().enumerate() {
        augmented.marks(&format!("k = {k}: p = {p}, N = {next}"), (p, next));
        augmented.passes("iterate", &[(0.0, lambda), (p, next)]);
        augmented.passes("iterate fine dotted", &[(0.0, lambda), (p, next), (0.15, lambda + 0.6)]);
        augmented.passes("iterate fine dashed", &[(p, next), (0.0, next)]);
    }
    augmented.marks("Exact: p = 0, N = 2", (0.0, 2.0));
}

/// Expected values: p₀ = 0.25, 4·0.25 = 1, and (4 + 4)·0.25 = 2.
#[test]
fn newton_step_reaches_the_contact_force() {
    let relaxed = picture("relaxed");
    relaxed.marks("α = 4: p = 0.25, N = 1", (0.25, 1.0));
    relaxed.marks("α = 8: p = 0.25, N = 2", (0.25, 2.0));
    relaxed.passes("iterate", &[(0.0, 0.0), (0.25, 1.0), (0.5, 2.0)]);
    relaxed.passes("iterate dashed", &[(0.0, 0.0), (0.25, 2.0)]);
}

/// With c = 4, R = −4 and ε = 4, the multipliers from λ = 10 are 3 and 0.
#[test]
fn unilateral_iterates_reach_the_separated_state() {
    let bent = picture("bent");
    bent.passes("spring", &[(-2.0, 4.0), (-1.0, 0.0), (-0.5, -2.0)]);
    bent.marks("k = 0: p = −1.75, N = 3", (-1.75, 3.0));
    bent.marks("k = 1 and after: p = −1, N = 0", (-1.0, 0.0));
    bent.marks("No positive part in equilibrium: p = −0.5, N = −2", (-0.5, -2.0));
    bent.passes("iterate", &[(-2.0, 2.0), (-1.75, 3.0)]);
    bent.passes("iterate", &[(-1.0, 0.0), (-0.75, 0.0), (0.0, 3.0)]);
    bent.passes("iterate", &[(-1.0, 0.0), (0.0, 0.0), (0.5, 2.0)]);
    bent.passes("penalty dashed", &[(-0.5, -2.0), (0.0, 0.0), (0.5, 2.0)]);
}

#[test]
fn exact_penalty_force_is_a_step() {
    let step = picture("step");
    step.marks("ε = 2.2: p = 0, N = 2", (0.0, 2.0));
    step.marks("ε = 1: p = 0.25, N = 1", (0.25, 1.0));
    step.passes("penalty", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.2), (0.6, 2.2)]);
    step.passes("penalty dashed", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 1.0), (0.6, 1.0)]);
}

impl Picture {
    /// Returns the depths in pixels of the mass and of the plane, or of its level, below the support.
    fn depths(&self) -> (f64, f64) {
        let line = |class: &str| self.paths.iter().find(|(found, _)| found == class).unwrap().1[0].1;
        let disc = self.marks.iter().find(|(class, ..)| class == "disc").unwrap().1.1;
        (disc - line(""), line(if self.name == "1-1" { "plane" } else { "plane dashed" }) - line(""))
    }

    /// Returns the length of the arrow of this class in pixels, positive upwards.
    fn arrow(&self, class: &str) -> f64 {
        let path = |class: &str| &self.paths.iter().find(|(found, _)| found == class).unwrap().1;
        path(class)[0].1 - path(&format!("{class} head"))[1].1
    }
}

/// With c = 4, m = 1, l = 1 and H = 3, u = 1 for g = 4, and u = 2.25 for g = 10 and ε = 4.
#[test]
fn system_is_drawn_to_scale() {
    let near = |a: f64, b: f64| assert!((a - b).abs() <= TOLERANCE, "{a} and {b}");
    let separated = picture("1-1");
    let (mass, plane) = separated.depths();
    near(mass, plane * 2.0 / 3.0);
    assert!(separated.arrow("spring force") > 20.0);
    near(separated.arrow("spring force"), -separated.arrow("force")); // 4 N both
    let pushed = picture("1-2");
    let (mass, plane) = pushed.depths();
    near(mass, plane * 3.25 / 3.0);
    let newton = -pushed.arrow("force") / 10.0;
    near(pushed.arrow("spring force"), 9.0 * newton);
    near(pushed.arrow("penalty force"), newton);
}

/// Expected values: −12 J plus −2p + 2p², −2p + 4p², 2p² and −p + 4p².
#[test]
fn energies_have_the_right_minima() {
    let energies = picture("energies");
    let curves = [
        ("spring", "Π", 0.5, [2.0, 2.0], -12.5),
        ("penalty dashed", "Π_p", 0.25, [2.0, 4.0], -12.25),
        ("plane", "ℒ", 0.0, [0.0, 2.0], -12.0),
        ("iterate dotted", "L", 0.125, [1.0, 4.0], -12.0625),
    ];
    for (class, name, p, [slope, square], least) in curves {
        let label = format!("{}: p = {p}, −{} J", name.replace('_', ""), -least);
        energies.marks(&label, (p, least));
        let at = |p: f64| (p, -12.0 - slope * p + square * p * p);
        energies.passes(class, &[at(-0.1), at(0.0), at(p), at(0.4)]);
    }
}

/// Expected values: the table in convergence.md.
#[test]
fn iterates_lie_between_two_bounds() {
    let rates = picture("rates");
    for (k, p) in [(0, 0.25), (1, 0.125), (2, 0.0625), (3, 0.03125), (6, 0.00390625)] {
        rates.marks(&format!("k = {k}: p = {p}"), (f64::from(k), p));
    }
    for k in [0.0, 1.0, 2.5, 6.0] {
        rates.passes("", &[(k, 0.25 * (-k / 2.0).exp())]);
        rates.passes("dashed", &[(k, 0.25 * (-k).exp())]);
    }
}

/// Expected values: the formulas and numbers in floats.md.
#[test]
fn rounding_errors_dominate_beyond_the_best_penalty() {
    let rounding = picture("rounding");
    // c/(c + ε) with c = 100, where rounding is negligible.
    for class in ["spring", "penalty"] {
        rounding.passes(class, &[(1.0, 100.0 / 101.0), (100.0, 0.5), (1e4, 1.0 / 101.0)]);
    }
    // In 113 bits m g − c u follows this line at least to 10³⁰, ε p at most to 10¹⁸.
    rounding.passes("spring", &[(1e4, 1.0 / 101.0), (1e30, 1e-28)]);
    rounding.passes("penalty", &[(1e38, 1.0)]);
    // (c + ε*)² = c R / (η (|H| + 5 |Δ|) (1 + 8 η)) with |H| + 5 |Δ| = 1.3, and the bound there is nearly 2 c/(c + ε*).
    let marks: Vec<_> = rounding.marks.iter().map(|(_, at, ..)| *at).collect();
    assert_eq!(marks.len(), 3);
    for (at, bits) in marks.iter().zip([24, 53, 113]) {
        let total = (481.0 / 1.3 * 2_f64.powi(bits)).sqrt();
        let place = rounding.at((total - 100.0, 200.0 / total));
        // The neglected terms are less than a thousandth, and a decade is narrower than 10 pixels.
        assert!((at.0 - place.0).hypot(at.1 - place.1) < 0.05, "{bits} bits: {at:?}, {place:?}");
    }
}

#[test]
fn every_figure_has_texts_and_is_shown_once() {
    let mut shown: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for page in fs::read_dir(source("")).unwrap().map(|entry| entry.unwrap().path()) {
        if page.extension().is_some_and(|e| e == "md") {
            for tag in found(r"\{\{#figure ([^}]*)\}\}", &fs::read_to_string(&page).unwrap()) {
                let page = page.file_name().unwrap().to_str().unwrap().to_string();
                shown.entry(tag[1].trim().to_string()).or_default().push(page);
            }
        }
    }
    for name in names() {
        let picture = picture(name);
        let words = |element: &str| {
            let found =
                found(&format!("<{element} id=\"fig-{name}-{element}\">([^<]*)</{element}>"), &picture.svg);
            assert_eq!(found.len(), 1, "{name}: {element}");
            found[0][1].trim().chars().count()
        };
        assert!(
            words("title") > 5 && words("desc") > 80,
            "{name}: the title or the description is too short"
        );
        let labels = format!(r#"role="img" aria-labelledby="fig-{name}-title fig-{name}-desc""#);
        assert!(picture.svg.contains(&labels), "{name}");
        assert_eq!(
            shown.remove(name).map(|pages| pages.len()),
            Some(1),
            "{name} has to be shown exactly once"
        );
    }
    assert!(shown.is_empty(), "unknown figures: {shown:?}");
}

#[test]
fn ids_are_unique() {
    let svgs: String = names().map(|name| picture(name).svg.as_str()).collect();
    let mut ids: Vec<_> = found(r#"\bid="([^"]*)""#, &svgs).iter().map(|id| id[1].to_string()).collect();
    let all = ids.len();
    ids.sort();
    ids.dedup();
    assert!(all >= 2 * names().count() && ids.len() == all, "{all} ids, {} of them different", ids.len());
}

/// Returns the approximate extent of a text, with letters half as wide as high.
fn extent(text: &Text) -> (RangeInclusive<f64>, RangeInclusive<f64>) {
    let size = if text.class == "tick" { 13.0 } else { 15.0 };
    let width = 0.5 * size * text.label.chars().count() as f64;
    let left = match text.anchor.as_str() {
        "start" => text.at.0,
        "middle" => text.at.0 - width / 2.0,
        _ => text.at.0 - width,
    };
    let top = 0.7 * size + if text.raised { 5.0 } else { 0.0 };
    (left..=left + width, text.at.1 - top..=text.at.1 + 0.2 * size)
}

fn disjoint(a: &RangeInclusive<f64>, b: &RangeInclusive<f64>) -> bool {
    a.end() < b.start() || b.end() < a.start()
}

#[test]
fn elements_are_inside_their_figure() {
    for name in names() {
        let Picture { size: (width, height), paths, marks, texts, .. } = picture(name);
        let (width, height) = (*width, *height);
        assert!(!paths.is_empty() && !texts.is_empty(), "{name} is empty");
        let inside = |x: f64, y: f64| (0.0..=width).contains(&x) && (0.0..=height).contains(&y);
        for (class, points) in paths {
            assert!(points.iter().all(|&(x, y)| inside(x, y)), "{name}: {class} {points:?}");
        }
        for (class, (x, y), radius, _) in marks {
            assert!(inside(x - radius, y - radius) && inside(x + radius, y + radius), "{name}: {class}");
        }
        for text in texts {
            let (x, y) = extent(text);
            let all = inside(*x.start(), *y.start()) && inside(*x.end(), *y.end());
            assert!(all, "{name}: {:?} is partly outside", text.label);
        }
    }
}

#[test]
fn texts_do_not_overlap_anything() {
    for name in names() {
        let Picture { paths, texts, marks, .. } = picture(name);
        for (i, text) in texts.iter().enumerate() {
            let (x, y) = extent(text);
            for other in &texts[..i] {
                let (a, b) = extent(other);
                let clear = disjoint(&x, &a) || disjoint(&y, &b);
                assert!(clear, "{name}: {:?} lies on {:?}", text.label, other.label);
            }
            for (class, points) in paths {
                for pair in points.windows(2) {
                    // The points are dense enough to detect every crossing of a text.
                    let steps = ((pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1) / 2.0).ceil();
                    let crossed = (0..=steps as u32).map(|i| f64::from(i) / steps.max(1.0)).any(|share| {
                        let part = |a: f64, b: f64| a + share * (b - a);
                        x.contains(&part(pair[0].0, pair[1].0)) && y.contains(&part(pair[0].1, pair[1].1))
                    });
                    assert!(!crossed, "{name}: {:?} lies on a line of {class:?}", text.label);
                }
            }
            for (class, (a, b), radius, _) in marks {
                let clear =
                    disjoint(&x, &(a - radius..=a + radius)) || disjoint(&y, &(b - radius..=b + radius));
                assert!(clear, "{name}: {:?} lies on a mark {class:?}", text.label);
            }
        }
    }
}

#[test]
fn text_is_large_enough_on_a_phone() {
    let css = fs::read_to_string(source("../theme/figures.css")).unwrap();
    let sizes = found(r"(?:font-size: |font: )([\d.]+)px", &css);
    assert!(sizes.len() >= 3);
    for name in names() {
        let shown = 340.0 / picture(name).size.0;
        for size in &sizes {
            assert!(float(&size[1]) * shown >= 12.0, "{name}: {} px", &size[1]);
        }
    }
}

/// With `UPDATE=1` the file is written.
#[test]
fn readme_shows_the_plane_first() {
    let (file, made) = (source("figures/plane.svg"), figure("plane").unwrap().standalone());
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&file, &made).unwrap();
    }
    assert_eq!(fs::read_to_string(&file).unwrap_or_default(), made, "UPDATE=1 writes the file");
    assert!(
        !made.contains("\n.drawing {"),
        "the root element has this class, and a margin would move the figure out of its frame"
    );
    let readme = fs::read_to_string(source("../../README.md")).unwrap();
    let image = found(r"!\[([^\]]+)\]\(book/src/figures/plane\.svg\)", &readme);
    assert!(
        image.len() == 1 && image[0][1].len() > 80,
        "README.md has to show the figure with an alternative text"
    );
    assert!(
        image[0].get(0).unwrap().start() < readme.find("\n## ").unwrap(),
        "the figure has to precede the first section"
    );
    for colour in found(r"var\((--[\w-]+)\)", &made) {
        let set = |colours: &str| colours.contains(&format!("{}: #", &colour[1]));
        let (light, dark) = made.split_once("@media").unwrap();
        assert!(set(light) && set(dark), "{} in light and in dark", &colour[1]);
    }
}

//! The figures as their readers have them: numbers are read off the axes, and held against numbers got by hand.

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

/// All that matches.
fn found<'a>(pattern: &str, text: &'a str) -> Vec<Captures<'a>> {
    Regex::new(pattern).unwrap().captures_iter(text).collect()
}

fn float(text: &str) -> f64 {
    text.replace('−', "-").parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

/// A text of a picture: its class, its place and its anchor, how large it is, what it says.
struct Text {
    class: String,
    at: Point,
    anchor: String,
    /// Something in it stands above the line.
    raised: bool,
    says: String,
}

/// A picture, read.
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
                let says = mark.get(5).map_or("", |says| says.as_str());
                (mark[1].to_string(), (float(&mark[2]), float(&mark[3])), float(&mark[4]), says.to_string())
            })
            .collect(),
        texts: found(texts, &svg)
            .iter()
            .map(|text| Text {
                class: text[1].to_string(),
                at: (float(&text[2]), float(&text[3])),
                anchor: text[4].to_string(),
                raised: text[5].contains("dy=\"-"),
                says: Regex::new("<[^>]*>").unwrap().replace_all(&text[5], "").into_owned(),
            })
            .collect(),
        svg,
    }
}

/// How a reader finds the place of a number: by the numbers at the axis.
struct Scale {
    ticks: Vec<(f64, f64)>,
    logarithmic: bool,
}

impl Scale {
    /// From places and what stands there: numbers, or powers of ten with their exponents.
    fn of(places: Vec<f64>, texts: &[&Text]) -> Self {
        let powers: Option<Vec<_>> = texts.iter().map(|text| text.says.strip_prefix("10")).collect();
        let powers = powers.filter(|powers| !powers.contains(&""));
        let logarithmic = powers.is_some();
        let values = powers.unwrap_or_else(|| texts.iter().map(|text| text.says.as_str()).collect());
        assert!(texts.len() >= 2, "one number says nothing");
        Scale { ticks: places.into_iter().zip(values.into_iter().map(float)).collect(), logarithmic }
    }

    fn place(&self, number: f64) -> f64 {
        let number = if self.logarithmic { number.log10() } else { number };
        let [(a, x), .., (b, y)] = self.ticks[..] else { unreachable!("two at least") };
        a + (number - x) / (y - x) * (b - a)
    }
}

/// Places are written in hundredths of a pixel: two of them and two ticks, none further off than half of one, and what
/// lies beyond the ticks by less than a half of what is between them.
const TOLERANCE: f64 = 0.03;

/// Between points of a curve its chord is no further from it.
const CHORD: f64 = 0.1;

impl Picture {
    /// Where a reader looks for two numbers.
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
            assert_eq!(text.at.0, *x, "{}: {} is not at its tick", self.name, text.says);
        }
        for (text, y) in beside.iter().zip(&rows) {
            assert!((text.at.1 - y - 4.5).abs() < 0.011, "{}: {} is not at its tick", self.name, text.says);
        }
        (Scale::of(columns, &below).place(x), Scale::of(rows, &beside).place(y))
    }

    /// There is a mark that says this, and it is at these numbers.
    fn marks(&self, says: &str, point: Point) {
        let place = self.at(point);
        let mark = self.marks.iter().find(|(.., said)| said == says);
        let (_, at, ..) =
            mark.unwrap_or_else(|| panic!("{}: no mark says {says:?}: {:?}", self.name, self.marks));
        let near = (at.0 - place.0).hypot(at.1 - place.1) <= TOLERANCE;
        assert!(near, "{}: {says} is at {at:?} and not at {place:?}", self.name);
    }

    /// A line of this class goes through these points.
    fn passes(&self, class: &str, points: &[Point]) {
        let reaches = |line: &[Point], (x, y): Point| {
            line.windows(2).any(|pair| {
                let [(a, b), (c, d)] = [pair[0], pair[1]];
                let length = (c - a).powi(2) + (d - b).powi(2);
                let share = (((x - a) * (c - a) + (y - b) * (d - b)) / length).clamp(0.0, 1.0);
                (a + share * (c - a) - x).hypot(b + share * (d - b) - y) <= TOLERANCE.max(CHORD)
            })
        };
        let places: Vec<_> = points.iter().map(|point| self.at(*point)).collect();
        let mut lines = self.paths.iter().filter(|(found, _)| found == class).map(|(_, line)| line);
        let through = lines.any(|line| places.iter().all(|place| reaches(line, *place)));
        assert!(through, "{}: no line of class {class:?} goes through {points:?}", self.name);
    }
}

/// c p + N = R of the example.
const EQUILIBRIUM: [Point; 3] = [(0.0, 2.0), (0.25, 1.0), (0.5, 0.0)];

#[test]
fn the_answer_is_where_equilibrium_meets_the_corner() {
    let plane = picture("plane");
    plane.marks("The answer: p = 0, N = 2", (0.0, 2.0));
    plane.passes("spring", &EQUILIBRIUM);
    plane.passes("plane thick", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.4)]);
}

#[test]
fn the_example_is_seen_through_one_window() {
    let corners = |name| [(-0.2, -0.4), (0.6, 2.4)].map(|corner| picture(name).at(corner));
    for name in ["equilibrium", "free", "methods", "multiplier", "penalty", "augmented", "relaxed", "step"] {
        assert_eq!(corners(name), corners("plane"), "{name}");
        assert_eq!(picture(name).size, picture("plane").size, "{name}");
        picture(name).passes("spring", &EQUILIBRIUM);
    }
}

#[test]
fn numbers_grow_to_the_right_and_upwards() {
    let plots = PICTURES.iter().filter(|picture| picture.texts.iter().any(|text| text.class == "tick"));
    let grown = plots.map(|picture| (picture.at((0.1, 0.1)), picture.at((0.2, 0.2))));
    let grown: Vec<_> = grown.map(|(low, high)| low.0 < high.0 && low.1 > high.1).collect();
    assert!(grown.len() > 10 && grown.iter().all(|grown| *grown), "{grown:?}");
}

#[test]
fn the_spring_alone() {
    let held = picture("equilibrium");
    held.marks("Held at the plane: p = 0, N = 2", (0.0, 2.0));
    held.marks("Without the plane: p = 0.5, N = 0", (0.5, 0.0));
    let free = picture("free");
    free.marks("The free mass: p = 0.5, N = 0", (0.5, 0.0));
    free.passes("thick", &[(-0.2, 0.0), (0.5, 0.0)]);
}

/// By the table in contact.md.
#[test]
fn three_states() {
    let states = picture("states");
    states.marks("g = 10, contact: p = 0, N = 2", (0.0, 2.0));
    states.marks("g = 8, grazing: p = 0, N = 0", (0.0, 0.0));
    states.marks("g = 4, separated: p = −1, N = 0", (-1.0, 0.0));
    states.passes("spring", &EQUILIBRIUM);
    states.passes("spring dashed", &[(-0.5, 2.0), (0.0, 0.0)]);
    states.passes("spring dotted", &[(-1.5, 2.0), (-1.0, 0.0)]);
}

#[test]
fn the_multiplier_may_pull() {
    let multiplier = picture("multiplier");
    multiplier.marks("The multiplier method: p = 0, N = 2", (0.0, 2.0));
    multiplier.passes("plane thick", &[(0.0, 0.0), (0.0, 2.4)]);
    multiplier.passes("plane thick dashed", &[(0.0, 0.0), (0.0, -0.4)]);
}

/// By the table in formulations.md, with ε = 4.
#[test]
fn three_methods() {
    let methods = picture("methods");
    methods.marks("Lagrange multiplier: p = 0, N = 2", (0.0, 2.0));
    methods.marks("Penalty: p = 0.25, N = 1", (0.25, 1.0));
    methods.marks("Augmented, k = 3: p = 0.03125, N = 1.875", (0.03125, 1.875));
    methods.passes("plane thick", &[(0.0, -0.4), (0.0, 2.4)]);
    methods.passes("penalty dashed", &[(0.0, 0.0), (0.25, 1.0), (0.5, 2.0)]);
    methods.passes("iterate dotted", &[(0.0, 1.75), (0.03125, 1.875)]);
}

/// By the table in penalty.md.
#[test]
fn three_penalties() {
    let penalty = picture("penalty");
    for (eps, p, n) in [("4", 0.25, 1.0), ("16", 0.1, 1.6), ("36", 0.05, 1.8)] {
        penalty.marks(&format!("ε = {eps}: p = {p}, N = {n}"), (p, n));
        penalty.passes("penalty", &[(0.0, 0.0), (p, n), (p * 1.2, n * 1.2)]);
    }
    // The gap R − N at ε = 4, from the middle to both heads, which are 9 long.
    let (low, high) = (penalty.at((0.25, 1.0)), penalty.at((0.25, 2.0)));
    let tips: Vec<_> =
        penalty.paths.iter().filter(|(class, _)| class == "fine head").map(|(_, head)| head[1]).collect();
    for (tip, end) in tips.iter().zip([low, high]) {
        assert!((tip.0 - end.0).hypot(tip.1 - end.1) <= TOLERANCE, "{tips:?}");
    }
    assert_eq!(tips.len(), 2);
}

/// By the table in augmented.md.
#[test]
fn the_iterates_walk_to_the_corner() {
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

/// p₀ = 0.25, as in the table; 4·0.25 = 1, and (4 + 4)·0.25 = 2.
#[test]
fn the_step_of_newton_is_at_the_height_of_the_answer() {
    let relaxed = picture("relaxed");
    relaxed.marks("α = 4: p = 0.25, N = 1", (0.25, 1.0));
    relaxed.marks("α = 8: p = 0.25, N = 2", (0.25, 2.0));
    relaxed.passes("iterate", &[(0.0, 0.0), (0.25, 1.0), (0.5, 2.0)]);
    relaxed.passes("iterate dashed", &[(0.0, 0.0), (0.25, 2.0)]);
}

/// c = 4, R = −4 and ε = 4, from λ = 10: then 3 and 0.
#[test]
fn the_bent_line_meets_the_other_arm() {
    let bent = picture("bent");
    bent.passes("spring", &[(-2.0, 4.0), (-1.0, 0.0), (-0.5, -2.0)]);
    bent.marks("k = 0: p = −1.75, N = 3", (-1.75, 3.0));
    bent.marks("k = 1 and after: p = −1, N = 0", (-1.0, 0.0));
    bent.marks("No bracket in equilibrium: p = −0.5, N = −2", (-0.5, -2.0));
    bent.passes("iterate", &[(-2.0, 2.0), (-1.75, 3.0)]);
    bent.passes("iterate", &[(-1.0, 0.0), (-0.75, 0.0), (0.0, 3.0)]);
    bent.passes("iterate", &[(-1.0, 0.0), (0.0, 0.0), (0.5, 2.0)]);
    bent.passes("penalty dashed", &[(-0.5, -2.0), (0.0, 0.0), (0.5, 2.0)]);
}

#[test]
fn the_exact_penalty_is_a_step() {
    let step = picture("step");
    step.marks("ε = 2.2: p = 0, N = 2", (0.0, 2.0));
    step.marks("ε = 1: p = 0.25, N = 1", (0.25, 1.0));
    step.passes("penalty", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.2), (0.6, 2.2)]);
    step.passes("penalty dashed", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 1.0), (0.6, 1.0)]);
}

impl Picture {
    /// How high, from the support and in parts of H: the mass and the plane or where it was.
    fn depths(&self) -> (f64, f64) {
        let line = |class: &str| self.paths.iter().find(|(found, _)| found == class).unwrap().1[0].1;
        let disc = self.marks.iter().find(|(class, ..)| class == "disc").unwrap().1.1;
        (disc - line(""), line(if self.name == "1-1" { "plane" } else { "plane dashed" }) - line(""))
    }

    /// How long the arrow of this class is, upwards.
    fn arrow(&self, class: &str) -> f64 {
        let path = |class: &str| &self.paths.iter().find(|(found, _)| found == class).unwrap().1;
        path(class)[0].1 - path(&format!("{class} head"))[1].1
    }
}

/// c = 4, m = 1, l = 1, H = 3: with g = 4 u = 1, and with g = 10 and ε = 4 u = 2.25.
#[test]
fn the_system_is_drawn_to_scale() {
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

/// Each is −12 J at p = 0; by hand −2p + 2p², −2p + 4p², 2p² and −p + 4p² more.
#[test]
fn the_energies_are_least_where_they_say() {
    let energies = picture("energies");
    let curves = [
        ("spring", "Π", 0.5, [2.0, 2.0], -12.5),
        ("penalty dashed", "Π_p", 0.25, [2.0, 4.0], -12.25),
        ("plane", "𝓛", 0.0, [0.0, 2.0], -12.0),
        ("iterate dotted", "L", 0.125, [1.0, 4.0], -12.0625),
    ];
    for (class, name, p, [slope, square], least) in curves {
        let says = format!("{}: p = {p}, −{} J", name.replace('_', ""), -least);
        energies.marks(&says, (p, least));
        let at = |p: f64| (p, -12.0 - slope * p + square * p * p);
        energies.passes(class, &[at(-0.1), at(0.0), at(p), at(0.4)]);
    }
}

/// By the table in convergence.md, whose numbers have three digits after the point.
#[test]
fn the_iterates_lie_between_two_bounds() {
    let rates = picture("rates");
    for (k, p) in [(0, 0.25), (1, 0.125), (2, 0.0625), (3, 0.03125), (6, 0.00390625)] {
        rates.marks(&format!("k = {k}: p = {p}"), (f64::from(k), p));
    }
    for k in [0.0, 1.0, 2.5, 6.0] {
        rates.passes("", &[(k, 0.25 * (-k / 2.0).exp())]);
        rates.passes("dashed", &[(k, 0.25 * (-k).exp())]);
    }
}

/// By the formulas and numbers in floats.md.
#[test]
fn rounding_leaves_the_line_near_the_best_penalty() {
    let rounding = picture("rounding");
    // c/(c + ε) with c = 100, long before anything is rounded.
    for class in ["spring", "penalty"] {
        rounding.passes(class, &[(1.0, 100.0 / 101.0), (100.0, 0.5), (1e4, 1.0 / 101.0)]);
    }
    // Of this m g − c u keeps more than ε p does: in 113 bits to 10³⁰ at least, ε p to no more than 10¹⁸.
    rounding.passes("spring", &[(1e4, 1.0 / 101.0), (1e30, 1e-28)]);
    rounding.passes("penalty", &[(1e38, 1.0)]);
    // (c + ε*)² = c R / (η (|H| + 5 |Δ|) (1 + 8 η)) with |H| + 5 |Δ| = 1.3, and the bound there is nearly 2 c/(c + ε*).
    let marks: Vec<_> = rounding.marks.iter().map(|(_, at, ..)| *at).collect();
    assert_eq!(marks.len(), 3);
    for (at, bits) in marks.iter().zip([24, 53, 113]) {
        let total = (481.0 / 1.3 * 2_f64.powi(bits)).sqrt();
        let place = rounding.at((total - 100.0, 200.0 / total));
        // What is left out is less than a thousandth, and a decade is narrower than 10 pixels.
        assert!((at.0 - place.0).hypot(at.1 - place.1) < 0.05, "{bits} bits: {at:?}, {place:?}");
    }
}

#[test]
fn every_figure_has_a_name_and_words_and_is_shown_once() {
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
        assert!(words("title") > 5 && words("desc") > 80, "{name}: a description says what is seen");
        let labels = format!(r#"role="img" aria-labelledby="fig-{name}-title fig-{name}-desc""#);
        assert!(picture.svg.contains(&labels), "{name}");
        assert_eq!(shown.remove(name).map(|pages| pages.len()), Some(1), "{name} is shown once");
    }
    assert!(shown.is_empty(), "no such figures: {shown:?}");
}

#[test]
fn no_two_elements_have_one_id() {
    let svgs: String = names().map(|name| picture(name).svg.as_str()).collect();
    let mut ids: Vec<_> = found(r#"\bid="([^"]*)""#, &svgs).iter().map(|id| id[1].to_string()).collect();
    let all = ids.len();
    ids.sort();
    ids.dedup();
    assert!(all >= 2 * names().count() && ids.len() == all, "{all} ids, {} of them different", ids.len());
}

/// Where a text is, more or less: a letter is half as wide as it is high, and none is wider than a capital.
fn extent(text: &Text) -> (RangeInclusive<f64>, RangeInclusive<f64>) {
    let size = if text.class == "tick" { 13.0 } else { 15.0 };
    let width = 0.5 * size * text.says.chars().count() as f64;
    let left = match text.anchor.as_str() {
        "start" => text.at.0,
        "middle" => text.at.0 - width / 2.0,
        _ => text.at.0 - width,
    };
    let top = 0.7 * size + if text.raised { 5.0 } else { 0.0 };
    (left..=left + width, text.at.1 - top..=text.at.1 + 0.2 * size)
}

fn apart(a: &RangeInclusive<f64>, b: &RangeInclusive<f64>) -> bool {
    a.end() < b.start() || b.end() < a.start()
}

#[test]
fn nothing_is_outside_its_picture() {
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
            assert!(all, "{name}: {:?} sticks out", text.says);
        }
    }
}

#[test]
fn no_text_lies_on_a_line_or_on_another_text() {
    for name in names() {
        let Picture { paths, texts, marks, .. } = picture(name);
        for (i, text) in texts.iter().enumerate() {
            let (x, y) = extent(text);
            for other in &texts[..i] {
                let (a, b) = extent(other);
                let clear = apart(&x, &a) || apart(&y, &b);
                assert!(clear, "{name}: {:?} lies on {:?}", text.says, other.says);
            }
            for (class, points) in paths {
                for pair in points.windows(2) {
                    // Enough points of the segment that none of this text's size is missed.
                    let steps = ((pair[1].0 - pair[0].0).hypot(pair[1].1 - pair[0].1) / 2.0).ceil();
                    let crossed = (0..=steps as u32).map(|i| f64::from(i) / steps.max(1.0)).any(|share| {
                        let part = |a: f64, b: f64| a + share * (b - a);
                        x.contains(&part(pair[0].0, pair[1].0)) && y.contains(&part(pair[0].1, pair[1].1))
                    });
                    assert!(!crossed, "{name}: {:?} lies on a line of {class:?}", text.says);
                }
            }
            for (class, (a, b), radius, _) in marks {
                let clear = apart(&x, &(a - radius..=a + radius)) || apart(&y, &(b - radius..=b + radius));
                assert!(clear, "{name}: {:?} lies on a mark {class:?}", text.says);
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

/// `UPDATE=1` writes it.
#[test]
fn the_readme_opens_with_the_plane() {
    let (file, made) = (source("figures/plane.svg"), figure("plane").unwrap().standalone());
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&file, &made).unwrap();
    }
    assert_eq!(fs::read_to_string(&file).unwrap_or_default(), made, "UPDATE=1 writes it");
    assert!(
        !made.contains("\n.drawing {"),
        "the class is on the root, and a margin would push the picture out of its frame"
    );
    let readme = fs::read_to_string(source("../../README.md")).unwrap();
    let image = found(r"!\[([^\]]+)\]\(book/src/figures/plane\.svg\)", &readme);
    assert!(
        image.len() == 1 && image[0][1].len() > 80,
        "README.md shows it, with words for who does not see it"
    );
    assert!(image[0].get(0).unwrap().start() < readme.find("\n## ").unwrap(), "before all else");
    for colour in found(r"var\((--[\w-]+)\)", &made) {
        let set = |colours: &str| colours.contains(&format!("{}: #", &colour[1]));
        let (light, dark) = made.split_once("@media").unwrap();
        assert!(set(light) && set(dark), "{} in light and in dark", &colour[1]);
    }
}

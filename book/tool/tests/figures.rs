//! Tests of the figures: numbers are read off the axes and compared with numbers computed by hand.

use crate::files::{root, text};
use book_tool::figure::{figure, names};
use regex::{Captures, Regex};
use std::{fs, sync::LazyLock};

type Point = (f64, f64);

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

/// Rectangle from the upper left to the lower right corner.
#[derive(Clone, Copy)]
struct Area(Point, Point);

impl Area {
    fn around((x, y): Point, radius: f64) -> Self {
        Area((x - radius, y - radius), (x + radius, y + radius))
    }

    /// Returns the approximate extent of a text, with letters half as wide as high.
    fn of_text(text: &Text) -> Self {
        let size = if text.class == "tick" { 13.0 } else { 15.0 };
        let width = 0.5 * size * text.label.chars().count() as f64;
        let before =
            width * ["start", "middle", "end"].iter().position(|it| *it == text.anchor).unwrap() as f64;
        let (left, top) = (text.at.0 - before / 2.0, 0.7 * size + if text.raised { 5.0 } else { 0.0 });
        Area((left, text.at.1 - top), (left + width, text.at.1 + 0.2 * size))
    }

    fn contains(&self, other: &Area) -> bool {
        let Area(low, high) = other;
        self.0.0 <= low.0 && self.0.1 <= low.1 && high.0 <= self.1.0 && high.1 <= self.1.1
    }

    fn overlaps(&self, other: &Area) -> bool {
        let (a, b) = (self, other);
        a.0.0 <= b.1.0 && b.0.0 <= a.1.0 && a.0.1 <= b.1.1 && b.0.1 <= a.1.1
    }
}

/// Parsed figure.
struct Picture {
    name: &'static str,
    area: Area,
    /// Area between the axes, to which lines are clipped.
    inside: Option<Area>,
    paths: Vec<(String, Vec<Point>)>,
    marks: Vec<(String, Point, f64, String)>,
    texts: Vec<Text>,
}

static PICTURES: LazyLock<Vec<Picture>> = LazyLock::new(|| names().map(read).collect());

fn picture(name: &str) -> &'static Picture {
    PICTURES.iter().find(|picture| picture.name == name).unwrap_or_else(|| panic!("no figure {name}"))
}

fn read(name: &'static str) -> Picture {
    let svg = figure(name).unwrap_or_else(|| panic!("no figure {name}")).inline();
    let views = found(r#"viewBox="(\S+) (\S+) (\S+) (\S+)""#, &svg);
    let mut areas = views.iter().map(|view| {
        let [x, y, width, height] = [1, 2, 3, 4].map(|i| float(&view[i]));
        Area((x, y), (x + width, y + height))
    });
    let points = |d: &str| {
        let numbers: Vec<f64> = d[1..].split(['L', ' ']).map(float).collect();
        numbers.chunks(2).map(|pair| (pair[0], pair[1])).collect()
    };
    let marks = r#"<circle class="([^"]*)" cx="([^"]*)" cy="([^"]*)" r="([^"]*)"><title>(.*?)</title>"#;
    let texts = r#"<text class="([^"]*)" x="([^"]*)" y="([^"]*)" text-anchor="([^"]*)">(.*?)</text>"#;
    let at = |found: &Captures| (float(&found[2]), float(&found[3]));
    let paths = found(r#"<path class="([^"]*)" d="([^"]*)"/>"#, &svg);
    let tag = Regex::new("<[^>]*>|\u{200b}").unwrap();
    Picture {
        name,
        area: areas.next().unwrap(),
        inside: areas.next(),
        paths: paths.iter().map(|path| (path[1].into(), points(&path[2]))).collect(),
        marks: found(marks, &svg)
            .iter()
            .map(|mark| (mark[1].into(), at(mark), float(&mark[4]), mark[5].into()))
            .collect(),
        texts: found(texts, &svg)
            .iter()
            .map(|text| Text {
                class: text[1].into(),
                at: at(text),
                anchor: text[4].into(),
                raised: text[5].contains("dy=\"-6"),
                label: tag.replace_all(&text[5], "").into(),
            })
            .collect(),
    }
}

/// Tolerance in pixels. Coordinates are written in hundredths of a pixel; two coordinates and two ticks contribute half
/// a hundredth each, and extrapolation beyond the ticks at most half of that again.
const TOLERANCE: f64 = 0.03;

/// Maximum distance in pixels between a curve and its chords.
const CHORD: f64 = 0.1;

impl Picture {
    /// Returns the position of a point according to the tick labels, which are numbers or powers of ten.
    fn at(&self, (x, y): Point) -> Point {
        let axis = |anchor: &str, number: f64, position: fn(Point) -> f64| {
            let ticks = self.texts.iter().filter(|text| text.class == "tick" && text.anchor == anchor);
            let ticks: Vec<_> = ticks
                .map(|text| {
                    (position(text.at), float(&text.label[if text.raised { 2 } else { 0 }..]), text.raised)
                })
                .collect();
            let [(a, low, logarithmic), .., (b, high, _)] = ticks[..] else { panic!("{}: ticks", self.name) };
            let number = if logarithmic { number.log10() } else { number };
            a + (number - low) / (high - low) * (b - a)
        };
        (axis("middle", x, |at| at.0), axis("end", y, |at| at.1 - 4.5))
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

    /// Returns the areas of the marks, and of points on the visible lines that are dense enough to detect every crossing
    /// of a text.
    fn drawn(&self) -> Vec<Area> {
        let mut areas: Vec<_> =
            self.marks.iter().map(|(_, at, radius, _)| Area::around(*at, *radius)).collect();
        for pair in self.paths.iter().flat_map(|(_, points)| points.windows(2)) {
            let [a, b] = [pair[0], pair[1]];
            let steps = ((b.0 - a.0).hypot(b.1 - a.1) / 2.0).ceil().max(1.0);
            let points = (0..=steps as u32).map(|i| f64::from(i) / steps);
            let points = points.map(|share| (a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1)));
            areas.extend(points.map(|point| Area::around(point, 0.0)));
        }
        areas
    }
}

/// Points on the line c p + N = R of the example.
const EQUILIBRIUM: &[Point] = &[(0.0, 2.0), (0.25, 1.0), (0.5, 0.0)];

/// Labels of the marks of each figure, which end its description.
///
/// Expected values: the tables in contact.md (`states`), comparison.md with ε = 4 (`methods`), penalty.md, augmented.md
/// and convergence.md (`rates`). The update with α = c + ε has N = (4 + 4)·0.25. In `bent`, c = 4, R = −4 and ε = 4, and
/// the multipliers from λ = 10 are 3 and 0. The energies are −12 J plus −2p + 2p², −2p + 4p², 2p² and −p + 4p².
const MARKS: &[(&str, &str)] = &[
    ("plane", "The answer: p = 0, N = 2"),
    ("equilibrium", "Held at the plane: p = 0, N = 2; Without the plane: p = 0.5, N = 0"),
    ("free", "The free mass: p = 0.5, N = 0"),
    (
        "states",
        "g = 10, contact: p = 0, N = 2; g = 8, grazing: p = 0, N = 0; g = 4, separated: p = −1, N = 0",
    ),
    (
        "methods",
        "Lagrange multiplier: p = 0, N = 2; Penalty: p = 0.25, N = 1; Augmented, k = 3: p = 0.03125, N = 1.875",
    ),
    ("multiplier", "The multiplier method: p = 0, N = 2"),
    (
        "penalty",
        "ε = 4: p = 0.25, N = 1; ε = 16: p = 0.1, N = 1.6; ε = 36: p = 0.05, N = 1.8; Exact: p = 0, N = 2",
    ),
    (
        "augmented",
        "k = 0: p = 0.25, N = 1; k = 1: p = 0.125, N = 1.5; k = 2: p = 0.0625, N = 1.75; k = 3: p = 0.03125, N = 1.875; Exact: p = 0, N = 2",
    ),
    ("relaxed", "α = 8: p = 0.25, N = 2; α = 4: p = 0.25, N = 1; Exact: p = 0, N = 2"),
    (
        "bent",
        "No positive part in equilibrium: p = −0.5, N = −2; k = 0: p = −1.75, N = 3; k = 1 and after: p = −1, N = 0",
    ),
    ("step", "ε = 2.2: p = 0, N = 2; ε = 1: p = 0.25, N = 1"),
    ("energies", "Π: p = 0.5, −12.5 J; Πp: p = 0.25, −12.25 J; ℒ: p = 0, −12 J; L: p = 0.125, −12.0625 J"),
    (
        "rates",
        "k = 0: p = 0.25; k = 1: p = 0.125; k = 2: p = 0.0625; k = 3: p = 0.03125; k = 4: p = 0.015625; k = 5: p = 0.0078125; k = 6: p = 0.00390625",
    ),
    ("1-1", "l = 1 m; u = 1 m; H = 3 m; −p = 1 m; c u = 4 N; m g = 4 N"),
    ("1-2", "p = 0.25 m; c u = 9 N; ε p = 1 N; m g = 10 N"),
];

/// Lines of figures by their class, and points on them.
const LINES: &[(&str, &str, &[Point])] = &[
    ("plane", "plane thick", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.4)]),
    ("free", "thick", &[(-0.2, 0.0), (0.5, 0.0)]),
    ("states", "spring dashed", &[(-0.5, 2.0), (0.0, 0.0)]),
    ("states", "spring dotted", &[(-1.5, 2.0), (-1.0, 0.0)]),
    ("methods", "plane thick", &[(0.0, -0.4), (0.0, 2.4)]),
    ("methods", "penalty dashed", &[(0.0, 0.0), (0.25, 1.0), (0.5, 2.0)]),
    ("methods", "iterate dotted", &[(0.0, 1.75), (0.03125, 1.875)]),
    ("multiplier", "plane thick", &[(0.0, 0.0), (0.0, 2.4)]),
    ("multiplier", "plane thick dashed", &[(0.0, 0.0), (0.0, -0.4)]),
    ("penalty", "penalty", &[(0.0, 0.0), (0.25, 1.0), (0.3, 1.2)]),
    ("penalty", "penalty", &[(0.0, 0.0), (0.1, 1.6), (0.12, 1.92)]),
    ("penalty", "penalty", &[(0.0, 0.0), (0.05, 1.8), (0.06, 2.16)]),
    ("penalty", "fine head", &[(0.25, 1.0)]),
    ("penalty", "fine head", &[(0.25, 2.0)]),
    ("augmented", "iterate", &[(0.0, 0.0), (0.25, 1.0)]),
    ("augmented", "iterate", &[(0.0, 1.75), (0.03125, 1.875)]),
    ("augmented", "iterate fine dotted", &[(0.0, 1.5), (0.0625, 1.75), (0.15, 2.1)]),
    ("augmented", "iterate fine dashed", &[(0.25, 1.0), (0.0, 1.0)]),
    ("relaxed", "iterate", &[(0.0, 0.0), (0.25, 1.0), (0.5, 2.0)]),
    ("relaxed", "iterate dashed", &[(0.0, 0.0), (0.25, 2.0)]),
    ("bent", "spring", &[(-2.0, 4.0), (-1.0, 0.0), (-0.5, -2.0)]),
    ("bent", "iterate", &[(-2.0, 2.0), (-1.75, 3.0)]),
    ("bent", "iterate", &[(-1.0, 0.0), (-0.75, 0.0), (0.0, 3.0)]),
    ("bent", "iterate", &[(-1.0, 0.0), (0.0, 0.0), (0.5, 2.0)]),
    ("bent", "penalty dashed", &[(-0.5, -2.0), (0.0, 0.0), (0.5, 2.0)]),
    ("step", "penalty", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.2), (0.6, 2.2)]),
    ("step", "penalty dashed", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 1.0), (0.6, 1.0)]),
    ("energies", "spring", &[(-0.1, -11.78), (0.0, -12.0), (0.5, -12.5)]),
    ("energies", "penalty dashed", &[(-0.1, -11.76), (0.25, -12.25), (0.4, -12.16)]),
    ("energies", "plane", &[(-0.1, -11.98), (0.0, -12.0), (0.4, -11.68)]),
    ("energies", "iterate dotted", &[(-0.1, -11.86), (0.125, -12.0625), (0.4, -11.76)]),
    // With e⁻¹ = 0.36788, and e⁻³ and e⁻⁶ to five digits.
    ("rates", "", &[(0.0, 0.25), (2.0, 0.25 * 0.36788), (6.0, 0.25 * 0.049787)]),
    ("rates", "dashed", &[(0.0, 0.25), (1.0, 0.25 * 0.36788), (6.0, 0.25 * 0.0024788)]),
    // c/(c + ε) with c = 100, where rounding is negligible: in 113 bits m g − c u follows this line at least to 10³⁰, ε p
    // at most to 10¹⁸.
    ("rounding", "spring", &[(1.0, 100.0 / 101.0), (100.0, 0.5), (1e4, 1.0 / 101.0), (1e30, 1e-28)]),
    ("rounding", "penalty", &[(1.0, 100.0 / 101.0), (100.0, 0.5), (1e4, 1.0 / 101.0), (1e38, 1.0)]),
];

#[test]
fn marks_and_lines_are_those_computed_by_hand() {
    for (name, labels) in MARKS {
        let description = figure(name).unwrap().description;
        assert!(description.ends_with(&format!(" {labels}.")), "{name}: {description}");
    }
    LINES.iter().for_each(|(name, class, points)| picture(name).passes(class, points));
}

#[test]
fn figures_of_the_example_have_the_same_ranges() {
    let corners = |name| [(-0.2, -0.4), (0.6, 2.4)].map(|corner| picture(name).at(corner));
    for name in
        ["plane", "equilibrium", "free", "methods", "multiplier", "penalty", "augmented", "relaxed", "step"]
    {
        assert_eq!(corners(name), corners("plane"), "{name}");
        picture(name).passes("spring", EQUILIBRIUM);
    }
}

/// The coordinates of a mark are the last two numbers of its label.
#[test]
fn marks_are_where_their_labels_say() {
    let number = Regex::new(r"[-−]?\d[\d.]*(?:e-?\d+)?").unwrap();
    for picture in PICTURES.iter().filter(|picture| picture.inside.is_some()) {
        // The errors with rounding are given to two digits, and a decade is narrower than 10 pixels.
        let tolerance = if picture.name == "rounding" { 0.4 } else { TOLERANCE };
        assert!(!picture.marks.is_empty(), "{}", picture.name);
        for (_, at, _, label) in &picture.marks {
            let numbers: Vec<_> = number.find_iter(label).map(|number| float(number.as_str())).collect();
            let [.., x, y] = numbers[..] else { panic!("{label} is without coordinates") };
            let expected = picture.at((x, y));
            let distance = (at.0 - expected.0).hypot(at.1 - expected.1);
            assert!(distance <= tolerance, "{}: {label} is at {at:?} and not at {expected:?}", picture.name);
        }
    }
}

/// With c = 4, m = 1, l = 1 and H = 3, u = 1 for g = 4, and u = 2.25 for g = 10 and ε = 4.
#[test]
fn system_is_drawn_to_scale() {
    let cases = [
        ("1-1", "plane", 2.0, [("spring force", 4.0), ("weight force", -4.0)].as_slice()),
        (
            "1-2",
            "plane dashed",
            3.25,
            &[("spring force", 9.0), ("penalty force", 1.0), ("weight force", -10.0)],
        ),
    ];
    for (name, plane, depth, forces) in cases {
        let picture = picture(name);
        let path = |class: &str| &picture.paths.iter().find(|(found, _)| found == class).unwrap().1;
        let level = |y: f64| (y - path("")[0].1) / (path(plane)[0].1 - path("")[0].1) * 3.0;
        // A hundredth of a pixel is less than 0.001 m and 0.01 N.
        assert!((level(picture.marks[0].1.1) - depth).abs() <= 0.001, "{name}");
        let length = |class: &str| path(class)[0].1 - path(&format!("{class} head"))[1].1;
        let newton = length(forces[0].0) / forces[0].1;
        assert!(newton > 5.0, "{name}");
        for (class, force) in forces {
            assert!((length(class) / newton - force).abs() <= 0.01, "{name}: {class}");
        }
    }
}

/// (c + ε*)² = c R / (η (|H| + 5 |Δ|) (1 + 8 η)) with |H| + 5 |Δ| = 1.3, and the bound there is nearly 2 c/(c + ε*).
#[test]
fn best_penalties_agree_with_their_formula() {
    let rounding = picture("rounding");
    assert_eq!(rounding.marks.len(), 3);
    for ((_, at, ..), bits) in rounding.marks.iter().zip([24, 53, 113]) {
        let total = (481.0 / 1.3 * 2_f64.powi(bits)).sqrt();
        let place = rounding.at((total - 100.0, 200.0 / total));
        // The neglected terms are less than a thousandth, and a decade is narrower than 10 pixels.
        assert!((at.0 - place.0).hypot(at.1 - place.1) < 0.05, "{bits} bits: {at:?}, {place:?}");
    }
}

#[test]
fn texts_are_inside_their_figure_and_overlap_nothing() {
    for Picture { name, area, inside, texts, paths, .. } in PICTURES.iter() {
        let mut drawn = picture(name).drawn();
        let visible = inside.unwrap_or(*area);
        let is_tick = |text: &&Text| text.class == "tick";
        let ticks = paths.iter().filter(|(class, _)| class == "tick").count();
        assert_eq!(texts.iter().filter(is_tick).count(), ticks, "{name}");
        drawn.retain(|drawn| visible.contains(drawn) || inside.is_none());
        let extents: Vec<_> = texts.iter().map(Area::of_text).collect();
        for (i, (text, extent)) in texts.iter().zip(&extents).enumerate() {
            assert!(area.contains(extent), "{name}: {:?} is partly outside", text.label);
            let over = extents[..i].iter().chain(&drawn).any(|other| extent.overlaps(other));
            assert!(!over, "{name}: {:?} lies on another element", text.label);
        }
        assert!(drawn.iter().all(|drawn| area.contains(drawn)), "{name} has elements outside");
    }
}

/// With `UPDATE=1` the file is written.
#[test]
fn readme_shows_the_plane() {
    let (file, made) = (root().join("book/src/figures/plane.svg"), figure("plane").unwrap().standalone());
    if std::env::var_os("UPDATE").is_some() {
        fs::write(&file, &made).unwrap();
    }
    assert_eq!(text(file), made, "UPDATE=1 writes the file");
}

//! The figures as their readers have them: numbers are read off the axes, and held against numbers got by hand.

use book_tool::figure::{figure, names};
use regex::{Captures, Regex};
use std::{
    collections::BTreeMap,
    fs,
    ops::RangeInclusive,
    path::{Path, PathBuf},
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

fn picture(name: &'static str) -> Picture {
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
                says: Regex::new("<[^>]*>").unwrap().replace_all(&text[5], "").into_owned(),
            })
            .collect(),
        svg,
    }
}

/// How a reader finds the number at a place: by the numbers at the axis.
struct Scale {
    ticks: Vec<(f64, f64)>,
    logarithmic: bool,
}

impl Scale {
    /// From places and what stands there; a power of ten is `10` and its exponent.
    fn of(ticks: Vec<(f64, &str)>, logarithmic: bool) -> Self {
        let value =
            |text: &str| if logarithmic { float(text.strip_prefix("10").unwrap()) } else { float(text) };
        Scale { ticks: ticks.into_iter().map(|(place, text)| (place, value(text))).collect(), logarithmic }
    }

    fn number(&self, place: f64) -> f64 {
        let [(a, x), .., (b, y)] = self.ticks[..] else { panic!("one tick says nothing") };
        let number = x + (place - a) / (b - a) * (y - x);
        if self.logarithmic { 10_f64.powf(number) } else { number }
    }

    /// How far off a place is that is written in hundredths, as the ticks are.
    fn tolerance(&self) -> f64 {
        let [(a, x), .., (b, y)] = self.ticks[..] else { panic!("one tick says nothing") };
        0.015 * ((y - x) / (b - a)).abs()
    }
}

impl Picture {
    fn scales(&self) -> (Scale, Scale) {
        let ticks = || self.texts.iter().filter(|text| text.class == "tick");
        let (below, beside): (Vec<_>, Vec<_>) = ticks().partition(|text| text.anchor == "middle");
        let powers =
            |texts: &[&Text]| texts.iter().all(|text| text.says.starts_with("10") && text.says != "10");
        // A text hangs so far below the tick that it belongs to.
        let lines = |horizontal: bool| -> Vec<f64> {
            let ticks = self.paths.iter().filter(|(class, _)| class == "tick").map(|(_, points)| points);
            let along = ticks.filter(|points| (points[0].1 == points[1].1) == horizontal);
            along.map(|points| if horizontal { points[0].1 } else { points[0].0 }).collect()
        };
        let (columns, rows) = (lines(false), lines(true));
        assert_eq!((columns.len(), rows.len()), (below.len(), beside.len()), "{}: ticks", self.name);
        let says = |texts: &'_ [&'_ Text]| texts.iter().map(|text| text.says.clone()).collect::<Vec<_>>();
        let scale = |places: Vec<f64>, texts: &[&Text]| {
            let says = says(texts);
            Scale::of(places.into_iter().zip(says.iter().map(String::as_str)).collect(), powers(texts))
        };
        for (text, x) in below.iter().zip(&columns) {
            assert_eq!(text.at.0, *x, "{}: {} is not at its tick", self.name, text.says);
        }
        for (text, y) in beside.iter().zip(&rows) {
            assert!((text.at.1 - y - 4.5).abs() < 0.011, "{}: {} is not at its tick", self.name, text.says);
        }
        (scale(columns, &below), scale(rows, &beside))
    }

    /// The marks of a class, as what they say and the numbers at their place.
    fn marked(&self) -> Vec<(String, Point)> {
        let (x, y) = self.scales();
        let marks = self.marks.iter().filter(|(class, ..)| class.starts_with("mark"));
        marks.map(|(_, at, _, says)| (says.clone(), (x.number(at.0), y.number(at.1)))).collect()
    }

    /// A mark that says this is at these numbers, and says them.
    fn holds(&self, says: &str, (p, n): Point) {
        let (x, y) = self.scales();
        let marked = self.marked();
        let (_, found) = marked
            .iter()
            .find(|(said, _)| said == says)
            .unwrap_or_else(|| panic!("{}: no mark says {says:?}: {marked:?}", self.name));
        let near = (found.0 - p).abs() <= x.tolerance() && (found.1 - n).abs() <= y.tolerance();
        assert!(near, "{}: {says} is at {found:?}", self.name);
    }

    /// A line of this class goes through these points, to within a hundredth of a pixel.
    fn passes(&self, class: &str, points: &[Point]) {
        let (x, y) = self.scales();
        let reaches = |line: &[Point], (p, n): Point| {
            line.windows(2).any(|pair| {
                let [(a, b), (c, d)] = [pair[0], pair[1]].map(|at| (x.number(at.0), y.number(at.1)));
                // The nearest place of the segment, where both tolerances are 1.
                let (a, c, p) = (a / x.tolerance(), c / x.tolerance(), p / x.tolerance());
                let (b, d, n) = (b / y.tolerance(), d / y.tolerance(), n / y.tolerance());
                let length = (c - a).powi(2) + (d - b).powi(2);
                let share = (((p - a) * (c - a) + (n - b) * (d - b)) / length).clamp(0.0, 1.0);
                (a + share * (c - a) - p).hypot(b + share * (d - b) - n) <= 2.0
            })
        };
        let lines: Vec<_> = self.paths.iter().filter(|(found, _)| found == class).collect();
        let through = lines.iter().any(|(_, line)| points.iter().all(|point| reaches(line, *point)));
        assert!(through, "{}: of {} lines {class:?} none goes through {points:?}", self.name, lines.len());
    }
}

#[test]
fn the_answer_is_where_equilibrium_meets_the_corner() {
    let plane = picture("plane");
    plane.holds("The answer: p = 0, N = 2", (0.0, 2.0));
    plane.passes("spring", &[(0.0, 2.0), (0.25, 1.0), (0.5, 0.0)]);
    plane.passes("plane thick", &[(-0.2, 0.0), (0.0, 0.0), (0.0, 2.4)]);
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
    let svgs: String = names().map(|name| picture(name).svg).collect();
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
    (left..=left + width, text.at.1 - 0.7 * size..=text.at.1 + 0.2 * size)
}

fn apart(a: &RangeInclusive<f64>, b: &RangeInclusive<f64>) -> bool {
    a.end() < b.start() || b.end() < a.start()
}

#[test]
fn nothing_is_outside_its_picture() {
    for name in names() {
        let Picture { size: (width, height), paths, marks, texts, .. } = picture(name);
        assert!(!paths.is_empty() && !texts.is_empty(), "{name} is empty");
        let inside = |x: f64, y: f64| (0.0..=width).contains(&x) && (0.0..=height).contains(&y);
        for (class, points) in &paths {
            assert!(points.iter().all(|&(x, y)| inside(x, y)), "{name}: {class} {points:?}");
        }
        for (class, (x, y), radius, _) in &marks {
            assert!(inside(x - radius, y - radius) && inside(x + radius, y + radius), "{name}: {class}");
        }
        for text in &texts {
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
            for (class, points) in &paths {
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
            for (class, (a, b), radius, _) in &marks {
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

//! Plots with two axes.

use super::Figure;
use super::svg::{Point, Svg, number};

/// Width of every figure in pixels, about that of a phone.
pub const WIDTH: f64 = 360.0;

const LEFT: f64 = 48.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 44.0;

/// Axis between two values.
pub struct Axis {
    title: &'static str,
    from: f64,
    to: f64,
    ticks: Vec<(f64, String)>,
    scale: fn(f64) -> f64,
}

impl Axis {
    /// Returns a linear axis with a tick at each multiple of `step`.
    pub fn linear(title: &'static str, from: f64, to: f64, step: f64) -> Self {
        // Ends that are multiples are included in spite of rounding.
        let (first, last) = ((from / step - 1e-9).ceil() as i32, (to / step + 1e-9).floor() as i32);
        let ticks = (first..=last).map(|n| f64::from(n) * step).map(|x| (x, number(x))).collect();
        Axis { title, from, to, ticks, scale: |x| x }
    }

    /// Returns a logarithmic axis with a tick at `10^from` and at each `every`th power of ten after it.
    pub fn powers(title: &'static str, from: i32, to: i32, every: usize) -> Self {
        let ticks = (from..=to).step_by(every);
        let ticks = ticks.map(|n| (10_f64.powi(n), format!("10^{{{}}}", number(f64::from(n))))).collect();
        Axis { title, from: 10_f64.powi(from), to: 10_f64.powi(to), ticks, scale: f64::ln }
    }

    /// Returns the relative position of a value, from 0 to 1 within the axis.
    fn fraction(&self, x: f64) -> f64 {
        let [x, from, to] = [x, self.from, self.to].map(self.scale);
        (x - from) / (to - from)
    }
}

/// Plot with two axes.
pub struct Plot {
    /// Axes, marks and texts.
    svg: Svg,
    /// Lines, which are clipped to the area between the axes and lie below the marks.
    lines: Svg,
    x: Axis,
    y: Axis,
}

impl Plot {
    /// Returns a plot with axes only.
    pub fn new(x: Axis, y: Axis, height: f64) -> Self {
        let mut plot = Plot { svg: Svg { height, ..Svg::default() }, lines: Svg::default(), x, y };
        let corners = [(plot.x.from, plot.y.to), (plot.x.from, plot.y.from), (plot.x.to, plot.y.from)];
        plot.svg.path("axis", &corners.map(|corner| plot.at(corner)));
        for (value, text) in plot.x.ticks.clone() {
            let (x, y) = plot.at((value, plot.y.from));
            plot.svg.path("tick", &[(x, y), (x, y + 5.0)]);
            plot.svg.text("tick", (x, y), (0.0, 21.5), &text);
        }
        for (value, text) in plot.y.ticks.clone() {
            let (x, y) = plot.at((plot.x.from, value));
            plot.svg.path("tick", &[(x, y), (x - 5.0, y)]);
            plot.svg.text("tick", (x, y), (-9.0, 4.5), &text);
        }
        plot.svg.text("title", (WIDTH, height), (-RIGHT, -6.0), plot.x.title);
        plot.svg.text("title", (0.0, 0.0), (4.0, 14.0), plot.y.title);
        plot
    }

    /// Returns the position of a point in pixels.
    pub fn at(&self, (x, y): (f64, f64)) -> Point {
        let (width, height) = (WIDTH - LEFT - RIGHT, self.svg.height - TOP - BOTTOM);
        (LEFT + width * self.x.fraction(x), self.svg.height - BOTTOM - height * self.y.fraction(y))
    }

    /// Draws a line through points.
    pub fn line(&mut self, class: &str, points: impl IntoIterator<Item = (f64, f64)>) {
        let points: Vec<_> = points.into_iter().map(|point| self.at(point)).collect();
        self.lines.path(class, &points);
    }

    /// Draws the graph of a function as this number of straight parts.
    pub fn graph(&mut self, class: &str, parts: u32, f: impl Fn(f64) -> f64) {
        let (from, to) = (self.x.from, self.x.to);
        let values = (0..=parts).map(|i| from + (to - from) * f64::from(i) / f64::from(parts));
        self.line(class, values.map(|x| (x, f(x))));
    }

    /// Marks a point with a label, which is its tooltip and part of the description.
    pub fn mark(&mut self, class: &str, point: (f64, f64), label: &str) {
        self.svg.disc(&format!("mark {class}"), self.at(point), 4.5, label);
        self.svg.labels.push(label.into());
    }

    /// Writes a text at an offset in pixels to the right of a point and below it.
    pub fn text(&mut self, class: &str, point: (f64, f64), offset: Point, text: &str) {
        self.svg.text(class, self.at(point), offset, text);
    }

    /// Draws a line with arrowheads at both ends.
    pub fn dimension(&mut self, class: &str, from: (f64, f64), to: (f64, f64)) {
        self.svg.dimension(class, self.at(from), self.at(to));
    }

    /// Returns the figure.
    pub fn figure(mut self, title: &'static str, caption: &'static str, description: &str) -> Figure {
        // A line along an edge is shown with its whole width.
        let (x, y, width, height) =
            (LEFT - 1.0, TOP - 1.0, WIDTH - LEFT - RIGHT + 2.0, self.svg.height - TOP - BOTTOM + 2.0);
        let area = format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"");
        let view = format!("viewBox=\"{x} {y} {width} {height}\"");
        let lines = format!("<svg {area} {view}>\n{}</svg>\n", self.lines.body);
        self.svg.body.insert_str(0, &lines);
        Figure::new(title, caption, description, self.svg)
    }
}

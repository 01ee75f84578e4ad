//! Plots with two axes.

use super::svg::{Anchor, Point, Svg, number};

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
    logarithmic: bool,
}

impl Axis {
    /// Returns a linear axis with a tick at each multiple of `step`.
    pub fn linear(title: &'static str, from: f64, to: f64, step: f64) -> Self {
        // Ends that are multiples are included in spite of rounding.
        let (first, last) = ((from / step - 1e-9).ceil() as i32, (to / step + 1e-9).floor() as i32);
        let ticks = (first..=last).map(|n| f64::from(n) * step).map(|x| (x, number(x))).collect();
        Axis { title, from, to, ticks, logarithmic: false }
    }

    /// Returns a logarithmic axis with a tick at each power of ten whose exponent is a multiple of `every`.
    pub fn powers(title: &'static str, from: i32, to: i32, every: i32) -> Self {
        let exponents = (from..=to).filter(|n| n % every == 0);
        let ticks = exponents.map(|n| (10_f64.powi(n), format!("10^{{{}}}", number(f64::from(n))))).collect();
        Axis { title, from: 10_f64.powi(from), to: 10_f64.powi(to), ticks, logarithmic: true }
    }

    /// Returns the relative position of a value, from 0 to 1 within the axis.
    fn fraction(&self, x: f64) -> f64 {
        let scale = |x: f64| if self.logarithmic { x.ln() } else { x };
        (scale(x) - scale(self.from)) / (scale(self.to) - scale(self.from))
    }

    /// Returns `parts + 1` equally spaced values.
    fn samples(&self, parts: u32) -> impl Iterator<Item = f64> {
        let (from, to, logarithmic) = (self.from, self.to, self.logarithmic);
        (0..=parts).map(move |i| {
            let share = f64::from(i) / f64::from(parts);
            if logarithmic { from * (to / from).powf(share) } else { from + (to - from) * share }
        })
    }
}

/// Plot with two axes.
pub struct Plot {
    svg: Svg,
    x: Axis,
    y: Axis,
    height: f64,
}

impl Plot {
    /// Returns a plot with axes only.
    pub fn new(x: Axis, y: Axis, height: f64) -> Self {
        let mut plot = Plot { svg: Svg::default(), x, y, height };
        let (left, right, top, bottom) = (LEFT, WIDTH - RIGHT, TOP, height - BOTTOM);
        plot.svg.path("axis", &[(left, top), (left, bottom), (right, bottom)]);
        let ticks = |axis: &Axis| axis.ticks.clone();
        for (value, text) in ticks(&plot.x) {
            let x = plot.at((value, plot.y.from)).0;
            plot.svg.path("tick", &[(x, bottom), (x, bottom + 5.0)]);
            plot.svg.text("tick", (x, bottom + 21.5), Anchor::Middle, &text);
        }
        for (value, text) in ticks(&plot.y) {
            let y = plot.at((plot.x.from, value)).1;
            plot.svg.path("tick", &[(left, y), (left - 5.0, y)]);
            plot.svg.text("tick", (left - 9.0, y + 4.5), Anchor::End, &text);
        }
        plot.svg.text("title", (right, height - 6.0), Anchor::End, plot.x.title);
        plot.svg.text("title", (4.0, 14.0), Anchor::Start, plot.y.title);
        plot
    }

    /// Draws the two lines through zero.
    pub fn zeros(&mut self) {
        self.line("axis", [(self.x.from, 0.0), (self.x.to, 0.0)]);
        self.line("axis", [(0.0, self.y.from), (0.0, self.y.to)]);
    }

    /// Returns the position of a point in pixels.
    pub fn at(&self, (x, y): (f64, f64)) -> Point {
        let (width, height) = (WIDTH - LEFT - RIGHT, self.height - TOP - BOTTOM);
        (LEFT + width * self.x.fraction(x), self.height - BOTTOM - height * self.y.fraction(y))
    }

    /// Draws a line through points, clipped to the area between the axes.
    pub fn line(&mut self, class: &str, points: impl IntoIterator<Item = (f64, f64)>) {
        let places: Vec<_> = points.into_iter().map(|point| self.at(point)).collect();
        let mut piece: Vec<Point> = Vec::new();
        for pair in places.windows(2) {
            let inside = self.clip(pair[0], pair[1]);
            if piece.last().is_some_and(|last| inside.is_none_or(|(from, _)| from != *last)) {
                self.svg.path(class, &simplify(std::mem::take(&mut piece)));
            }
            if let Some((from, to)) = inside {
                if piece.is_empty() {
                    piece.push(from);
                }
                piece.push(to);
            }
        }
        if !piece.is_empty() {
            self.svg.path(class, &simplify(piece));
        }
    }

    /// Draws the graph of a function.
    pub fn graph(&mut self, class: &str, f: impl Fn(f64) -> f64) {
        let points: Vec<_> = self.x.samples(400).map(|x| (x, f(x))).collect();
        self.line(class, points);
    }

    /// Marks a point; `label` is the tooltip.
    pub fn mark(&mut self, class: &str, point: (f64, f64), label: &str) {
        self.svg.mark(class, self.at(point), label);
    }

    /// Writes a text at an offset in pixels to the right of a point and below it.
    pub fn text(&mut self, class: &str, point: (f64, f64), (right, down): Point, anchor: Anchor, text: &str) {
        let (x, y) = self.at(point);
        self.svg.text(class, (x + right, y + down), anchor, text);
    }

    /// Draws a line with arrowheads at both ends.
    pub fn dimension(&mut self, class: &str, from: (f64, f64), to: (f64, f64)) {
        self.svg.dimension(class, self.at(from), self.at(to));
    }

    /// Returns the SVG elements and the size.
    pub fn done(self) -> (String, (f64, f64)) {
        (self.svg.body, (WIDTH, self.height))
    }

    /// Returns the part of a segment that lies between the axes.
    fn clip(&self, from: Point, to: Point) -> Option<(Point, Point)> {
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        let sides = [(from.0, to.0, LEFT, WIDTH - RIGHT), (from.1, to.1, TOP, self.height - BOTTOM)];
        for (a, b, low, high) in sides {
            if a == b {
                if !(low..=high).contains(&a) {
                    return None;
                }
                continue;
            }
            let (enter, leave) = ((low - a) / (b - a), (high - a) / (b - a));
            first = first.max(enter.min(leave));
            last = last.min(enter.max(leave));
        }
        let part = |share: f64| {
            // Unclipped ends are simplified exactly, so that the pieces of a line connect.
            if share == 0.0 {
                from
            } else if share == 1.0 {
                to
            } else {
                (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1))
            }
        };
        (first < last).then(|| (part(first), part(last)))
    }
}

/// Removes the points on a straight line between their neighbours.
fn simplify(points: Vec<Point>) -> Vec<Point> {
    let mut simplified: Vec<Point> = Vec::new();
    for point in points {
        if let [.., a, b] = simplified[..] {
            let bend = (b.0 - a.0) * (point.1 - b.1) - (b.1 - a.1) * (point.0 - b.0);
            if bend.abs() < 1e-6 {
                simplified.pop();
            }
        }
        simplified.push(point);
    }
    simplified
}

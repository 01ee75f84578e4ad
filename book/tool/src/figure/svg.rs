//! The few elements of SVG that the figures are made of.

use std::fmt::Write;

/// A place in a picture: to the right and down from its upper left corner.
pub type Point = (f64, f64);

/// On which side of its place a text stands.
#[derive(Clone, Copy)]
pub enum Anchor {
    /// It begins there.
    Start,
    /// It is centred there.
    Middle,
    /// It ends there.
    End,
}

/// A picture so far.
#[derive(Default)]
pub struct Svg {
    pub body: String,
}

impl Svg {
    /// A line through points.
    pub fn path(&mut self, class: &str, points: &[Point]) {
        let places: Vec<_> = points.iter().map(|&at| place(at)).collect();
        self.element(&format!("<path class=\"{class}\" d=\"M{}\"/>", places.join("L")));
    }

    /// A line with a head at its end.
    pub fn arrow(&mut self, class: &str, from: Point, to: Point) {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let share = (9.0 / x.hypot(y)).min(1.0);
        let (x, y) = (x * share, y * share);
        let foot = (to.0 - x, to.1 - y);
        self.path(class, &[from, foot]);
        let side = |sign: f64| place((foot.0 - sign * 0.4 * y, foot.1 + sign * 0.4 * x));
        let head = [side(1.0), place(to), side(-1.0)].join("L");
        self.element(&format!("<path class=\"{class} head\" d=\"M{head}Z\"/>"));
    }

    /// A line with a head at both ends.
    pub fn dimension(&mut self, class: &str, from: Point, to: Point) {
        let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
        self.arrow(class, middle, from);
        self.arrow(class, middle, to);
    }

    /// A dot, and what it says when it is pointed at.
    pub fn mark(&mut self, class: &str, (x, y): Point, says: &str) {
        let (x, y, says) = (short(x), short(y), escaped(says));
        let title = format!("<title>{says}</title>");
        self.element(&format!(
            "<circle class=\"mark {class}\" cx=\"{x}\" cy=\"{y}\" r=\"4.5\">{title}</circle>"
        ));
    }

    /// A disc.
    pub fn disc(&mut self, (x, y): Point, radius: f64) {
        let (x, y) = (short(x), short(y));
        self.element(&format!("<circle class=\"disc\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>"));
    }

    /// A text: words as they are, single letters as symbols, `_` and `^` for what is below and above.
    pub fn text(&mut self, class: &str, (x, y): Point, anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y, text) = (short(x), short(y), typeset(text));
        self.element(&format!(
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>"
        ));
    }

    fn element(&mut self, element: &str) {
        writeln!(self.body, "{element}").expect("a string takes what is written");
    }
}

/// Hundredths of a pixel.
fn short(x: f64) -> String {
    let rounded = (x * 100.0).round() / 100.0;
    format!("{}", rounded + 0.0) // no minus before zero
}

fn place((x, y): Point) -> String {
    format!("{} {}", short(x), short(y))
}

/// A text in XML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A number as one reads it.
pub fn number(x: f64) -> String {
    short(x * 1000.0)
        .parse::<f64>()
        .map_or_else(|_| String::new(), |x| format!("{}", x / 1000.0))
        .replace('-', "−")
}

/// How a piece of text stands in its line.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Line,
    Below,
    Above,
}

/// Text as spans: symbols slanted, indices and powers small and moved.
fn typeset(text: &str) -> String {
    let mut pieces: Vec<(Level, String)> = vec![(Level::Line, String::new())];
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        let level = match c {
            '_' => Level::Below,
            '^' => Level::Above,
            _ => {
                pieces.last_mut().expect("one at least").1.push(c);
                continue;
            }
        };
        let braced = chars.next_if_eq(&'{').is_some();
        let small = if braced {
            chars.by_ref().take_while(|c| *c != '}').collect()
        } else {
            chars.next().into_iter().collect()
        };
        pieces.push((level, small));
        pieces.push((Level::Line, String::new()));
    }
    let (mut result, mut now) = (String::new(), 0);
    for (level, piece) in pieces.into_iter().filter(|(_, piece)| !piece.is_empty()) {
        let wanted = match level {
            Level::Line => 0,
            Level::Below => 4,
            Level::Above => -6,
        };
        let class = if level == Level::Line { "" } else { " class=\"small\"" };
        let moved = if wanted == now { String::new() } else { format!(" dy=\"{}\"", wanted - now) };
        let slanted = symbols(&piece);
        let plain = class.is_empty() && moved.is_empty();
        result += &if plain { slanted } else { format!("<tspan{class}{moved}>{slanted}</tspan>") };
        now = wanted;
    }
    result
}

/// Single letters as symbols.
fn symbols(text: &str) -> String {
    let mut result = String::new();
    for word in text.split_inclusive(|c: char| !c.is_alphabetic()) {
        let letters = word.trim_end_matches(|c: char| !c.is_alphabetic());
        let rest = escaped(&word[letters.len()..]);
        match letters {
            // A symbol that looks the same in every font.
            "𝓛" => result += "<tspan class=\"script\">L</tspan>",
            "Π" | "Δ" | "Λ" => result += letters,
            // A letter before a digit is part of a name: f32.
            _ if letters.chars().count() == 1 && !rest.starts_with(|c: char| c.is_ascii_digit()) => {
                result += &format!("<tspan class=\"letter\">{letters}</tspan>")
            }
            _ => result += letters,
        }
        result += &rest;
    }
    result
}

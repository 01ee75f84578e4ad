//! The elements of SVG that the figures use.

use std::fmt::Write;

/// Position in pixels, to the right and down from the upper left corner.
pub type Point = (f64, f64);

/// Alignment of a text relative to its position.
#[derive(Clone, Copy)]
pub enum Anchor {
    /// The text begins at the position.
    Start,
    /// The text is centred at the position.
    Middle,
    /// The text ends at the position.
    End,
}

/// SVG elements of a figure.
#[derive(Default)]
pub struct Svg {
    pub body: String,
}

impl Svg {
    /// Draws a line through points.
    pub fn path(&mut self, class: &str, points: &[Point]) {
        let texts: Vec<_> = points.iter().map(|&point| format_point(point)).collect();
        self.element(&format!("<path class=\"{class}\" d=\"M{}\"/>", texts.join("L")));
    }

    /// Draws a line with an arrowhead at its end.
    pub fn arrow(&mut self, class: &str, from: Point, to: Point) {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let share = (9.0 / x.hypot(y)).min(0.6);
        let (x, y) = (x * share, y * share);
        let foot = (to.0 - x, to.1 - y);
        self.path(class, &[from, foot]);
        let side = |sign: f64| format_point((foot.0 - sign * 0.4 * y, foot.1 + sign * 0.4 * x));
        let head = [side(1.0), format_point(to), side(-1.0)].join("L");
        self.element(&format!("<path class=\"{class} head\" d=\"M{head}Z\"/>"));
    }

    /// Draws a line with arrowheads at both ends.
    pub fn dimension(&mut self, class: &str, from: Point, to: Point) {
        let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
        self.arrow(class, middle, from);
        self.arrow(class, middle, to);
    }

    /// Draws a dot with a tooltip.
    pub fn mark(&mut self, class: &str, (x, y): Point, label: &str) {
        let (x, y, label) = (format_coordinate(x), format_coordinate(y), escaped(label));
        let title = format!("<title>{label}</title>");
        self.element(&format!(
            "<circle class=\"mark {class}\" cx=\"{x}\" cy=\"{y}\" r=\"4.5\">{title}</circle>"
        ));
    }

    /// Draws a disc.
    pub fn disc(&mut self, (x, y): Point, radius: f64) {
        let (x, y) = (format_coordinate(x), format_coordinate(y));
        self.element(&format!("<circle class=\"disc\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>"));
    }

    /// Writes a text; single letters are set as symbols, `_` and `^` begin an index or an exponent.
    pub fn text(&mut self, class: &str, (x, y): Point, anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y, text) = (format_coordinate(x), format_coordinate(y), typeset(text));
        self.element(&format!(
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>"
        ));
    }

    fn element(&mut self, element: &str) {
        writeln!(self.body, "{element}").expect("writing to a string succeeds");
    }
}

/// Formats a coordinate to hundredths of a pixel.
fn format_coordinate(x: f64) -> String {
    let rounded = (x * 100.0).round() / 100.0;
    format!("{}", rounded + 0.0) // avoids −0
}

fn format_point((x, y): Point) -> String {
    format!("{} {}", format_coordinate(x), format_coordinate(y))
}

/// Escapes a text for XML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Formats a number with at most five decimals and a minus sign.
pub fn number(x: f64) -> String {
    format_coordinate(x * 1000.0)
        .parse::<f64>()
        .map_or_else(|_| String::new(), |x| format!("{}", x / 1000.0))
        .replace('-', "−")
}

/// Vertical position of a piece of text.
#[derive(Clone, Copy, PartialEq)]
enum Level {
    Line,
    Below,
    Above,
}

/// Formats a text as spans, with slanted symbols and small, shifted indices and exponents.
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
    let (mut result, mut current) = (String::new(), 0);
    for (level, piece) in pieces.into_iter().filter(|(_, piece)| !piece.is_empty()) {
        let offset = match level {
            Level::Line => 0,
            Level::Below => 4,
            Level::Above => -6,
        };
        let class = if level == Level::Line { "" } else { " class=\"small\"" };
        let shift = if offset == current { String::new() } else { format!(" dy=\"{}\"", offset - current) };
        let slanted = symbols(&piece);
        let plain = class.is_empty() && shift.is_empty();
        result += &if plain { slanted } else { format!("<tspan{class}{shift}>{slanted}</tspan>") };
        current = offset;
    }
    result
}

/// Formats single letters as symbols.
fn symbols(text: &str) -> String {
    let mut result = String::new();
    for word in text.split_inclusive(|c: char| !c.is_alphabetic()) {
        let letters = word.trim_end_matches(|c: char| !c.is_alphabetic());
        let rest = escaped(&word[letters.len()..]);
        match letters {
            "Π" | "Δ" | "Λ" | "ℒ" => result += letters,
            // A letter before a digit is part of a name such as f32.
            _ if letters.chars().count() == 1 && !rest.starts_with(|c: char| c.is_ascii_digit()) => {
                result += &format!("<tspan class=\"letter\">{letters}</tspan>")
            }
            _ => result += letters,
        }
        result += &rest;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_escaped_for_xml() {
        assert_eq!(escaped("u < H & λ > 0"), "u &lt; H &amp; λ &gt; 0");
    }
}

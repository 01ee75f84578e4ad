//! The elements of SVG that the figures use.

use regex::{Captures, Regex};
use std::sync::LazyLock;

/// Position in pixels, to the right and down from the upper left corner.
pub type Point = (f64, f64);

/// SVG elements of a figure.
#[derive(Default)]
pub struct Svg {
    /// Height in pixels.
    pub height: f64,
    pub body: String,
    /// Descriptions of the elements, such as `p = 0, N = 2`.
    pub labels: Vec<String>,
}

impl Svg {
    /// Draws a line through points.
    pub fn path(&mut self, class: &str, points: &[Point]) {
        let texts: Vec<_> =
            points.iter().map(|&(x, y)| format!("{} {}", rounded(x, 2), rounded(y, 2))).collect();
        self.body += &format!("<path class=\"{class}\" d=\"M{}\"/>\n", texts.join("L"));
    }

    /// Draws a line with an arrowhead at its end.
    pub fn arrow(&mut self, class: &str, from: Point, to: Point) {
        let (x, y) = (to.0 - from.0, to.1 - from.1);
        let share = (9.0 / x.hypot(y)).min(0.6);
        let (x, y) = (x * share, y * share);
        let foot = (to.0 - x, to.1 - y);
        self.path(class, &[from, foot]);
        let side = |sign: f64| (foot.0 - sign * 0.4 * y, foot.1 + sign * 0.4 * x);
        self.path(&format!("{class} head"), &[side(1.0), to, side(-1.0)]);
    }

    /// Draws a line with arrowheads at both ends.
    pub fn dimension(&mut self, class: &str, from: Point, to: Point) {
        let middle = ((from.0 + to.0) / 2.0, (from.1 + to.1) / 2.0);
        self.arrow(class, middle, from);
        self.arrow(class, middle, to);
    }

    /// Draws a disc with a tooltip.
    pub fn disc(&mut self, class: &str, (x, y): Point, radius: f64, tooltip: &str) {
        let (x, y, title) = (rounded(x, 2), rounded(y, 2), escaped(tooltip));
        self.body += &format!(
            "<circle class=\"{class}\" cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"><title>{title}</title></circle>\n"
        );
    }

    /// Writes a text beside a point, on the side of its offset, or centred if it is not offset to a side.
    pub fn text(&mut self, class: &str, at: Point, (right, down): Point, text: &str) {
        let anchor = match right {
            right if right < 0.0 => "end",
            0.0 => "middle",
            _ => "start",
        };
        let (x, y, text) = (rounded(at.0 + right, 2), rounded(at.1 + down, 2), typeset(text));
        self.body +=
            &format!("<text class=\"{class}\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{text}</text>\n");
    }
}

/// Rounds to a number of decimals.
fn rounded(x: f64, decimals: i32) -> f64 {
    let unit = 10_f64.powi(decimals);
    (x * unit).round() / unit + 0.0 // avoids −0
}

/// Formats a number with at most five decimals and a minus sign.
pub fn number(x: f64) -> String {
    rounded(x, 5).to_string().replace('-', "−")
}

/// Escapes a text for XML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Sets `_` and `^` as small, shifted indices and exponents, and single letters as slanted symbols.
fn typeset(text: &str) -> String {
    static PIECE: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"[_^](?:\{([^}]*)\}|(.))|\p{L}[\p{L}\d]*|[&<>]").expect("a pattern"));
    let set = |piece: &Captures| match (&piece[0], piece.get(1).or(piece.get(2))) {
        (all, Some(small)) => {
            let shift = if all.starts_with('_') { 4 } else { -6 };
            let (small, back) = (typeset(small.as_str()), -shift);
            // A character without width returns to the line.
            format!(
                "<tspan class=\"small\" dy=\"{shift}\">{small}</tspan><tspan dy=\"{back}\">\u{200b}</tspan>"
            )
        }
        ("Π" | "ℒ" | "Δ", _) => piece[0].into(),
        (letter, _) if letter.chars().count() == 1 && !"&<>".contains(letter) => {
            format!("<tspan class=\"letter\">{letter}</tspan>")
        }
        (other, _) => escaped(other),
    };
    PIECE.replace_all(text, set).into_owned()
}

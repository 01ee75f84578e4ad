//! The figures of the book as SVG; all positions are computed by functions of the crate.
//!
//! Most figures show the plane of p and N: equilibrium is a line, contact a corner, each method another line, and the
//! result of a method is an intersection.

mod axes;
mod drawing;
mod plane;
mod plots;
mod svg;

use axes::WIDTH;
use svg::{Svg, escaped};

/// Figure with its texts.
pub struct Figure {
    /// Name in the tag of a page.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// Description with the numbers of the figure, for screen readers.
    pub description: String,
    /// Caption in the book; may contain `$…$`.
    pub caption: &'static str,
    svg: Svg,
}

/// Function that draws a figure.
type Draw = fn() -> Figure;

/// All figures by name.
const FIGURES: &[(&str, Draw)] = &[
    ("plane", plane::answer),
    ("equilibrium", plane::intercepts),
    ("free", plane::hanging),
    ("states", plane::states),
    ("methods", plane::methods),
    ("multiplier", plane::multiplier),
    ("penalty", plane::penalties),
    ("augmented", plane::iterates),
    ("relaxed", plane::relaxed),
    ("bent", plane::bent),
    ("step", plane::step),
    ("energies", plots::energies),
    ("rates", plots::rates),
    ("rounding", plots::rounding),
    ("block", plots::block),
    ("1-1", drawing::system),
    ("1-2", drawing::second_spring),
];

/// Returns the names of all figures.
pub fn names() -> impl Iterator<Item = &'static str> {
    FIGURES.iter().map(|(name, _)| *name)
}

/// Draws the figure of that name. Returns `None` if there is none.
pub fn figure(name: &str) -> Option<Figure> {
    let (name, draw) = FIGURES.iter().find(|(known, _)| *known == name)?;
    Some(Figure { name, ..draw() })
}

impl Figure {
    /// Returns a figure whose description ends with the labels of its elements.
    fn new(title: &'static str, caption: &'static str, description: &str, svg: Svg) -> Self {
        let description = format!("{description} {}.", svg.labels.join("; "));
        Figure { name: "", title, description, caption, svg }
    }

    /// Returns the figure as an SVG element for a page, which provides the style.
    pub fn inline(&self) -> String {
        let Figure { name, svg: Svg { height, body, .. }, .. } = self;
        let (title, description) = (escaped(self.title), escaped(&self.description));
        format!(
            "<svg viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" \
             aria-labelledby=\"fig-{name}-title fig-{name}-desc\">\n\
             <title id=\"fig-{name}-title\">{title}</title>\n\
             <desc id=\"fig-{name}-desc\">{description}</desc>\n{body}</svg>"
        )
    }

    /// Returns the figure as an SVG file with embedded style, in light or dark colours as the reader prefers.
    pub fn standalone(&self) -> String {
        let (svg, size) = (self.inline(), format!("width=\"{WIDTH}\" height=\"{}\"", self.svg.height));
        let head = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"drawing\" {size}");
        svg.replacen("<svg", &head, 1).replacen("</desc>\n", &format!("</desc>\n{STYLE}"), 1) + "\n"
    }
}

/// Style of the book's figures for a file of its own.
const STYLE: &str = concat!(
    "<style>\n:root { color-scheme: light dark; color: light-dark(#1f2328, #d1d7e0); }\n",
    include_str!("../../theme/figures.css"),
    "</style>\n"
);

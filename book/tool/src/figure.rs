//! The book's pictures and plots, as SVG. Where anything is drawn, a function of the crate has computed it.
//!
//! Most of them are one picture, the plane of p and N: equilibrium is a line in it, contact a corner, each method
//! a line of its own, and what a method finds is where two of them meet.

mod axes;
mod drawing;
mod plane;
mod plots;
mod svg;

use regex::Regex;
use svg::escaped;

/// A picture, before it is put into a page.
pub struct Figure {
    /// What it is called in a page's tag.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// The same for somebody who does not see it, with its numbers.
    pub description: String,
    /// What stands below it in the book; may hold `$…$`.
    pub caption: &'static str,
    size: (f64, f64),
    body: String,
}

/// A function that draws.
type Draw = fn() -> Figure;

/// All of them, by name.
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
    ("1-1", drawing::system),
    ("1-2", drawing::second_spring),
];

/// The names of all figures.
pub fn names() -> impl Iterator<Item = &'static str> {
    FIGURES.iter().map(|(name, _)| *name)
}

/// The figure of that name.
pub fn figure(name: &str) -> Option<Figure> {
    let (name, draw) = FIGURES.iter().find(|(known, _)| *known == name)?;
    Some(Figure { name, ..draw() })
}

impl Figure {
    /// As an element of a page, which brings the style.
    pub fn inline(&self) -> String {
        self.element("", "")
    }

    /// As a file of its own, shown as an image: the style is inside, and the colours are the reader's light or dark.
    pub fn standalone(&self) -> String {
        let (width, height) = self.size;
        let attributes = format!(
            " xmlns=\"http://www.w3.org/2000/svg\" class=\"drawing\" width=\"{width}\" height=\"{height}\""
        );
        self.element(&attributes, &format!("<style>\n{}</style>\n", style())) + "\n"
    }

    fn element(&self, attributes: &str, style: &str) -> String {
        let (name, (width, height), body) = (self.name, self.size, &self.body);
        let (title, description) = (escaped(self.title), escaped(&self.description));
        format!(
            "<svg{attributes} viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"fig-{name}-title fig-{name}-desc\">\n\
             <title id=\"fig-{name}-title\">{title}</title>\n\
             <desc id=\"fig-{name}-desc\">{description}</desc>\n{style}{body}</svg>"
        )
    }
}

/// The style of the book's figures, with the two sets of colours apart.
fn style() -> String {
    let css = include_str!("../../theme/figures.css");
    let (colours, rules) = css.split_once("}\n").expect("the colours come first");
    let pair = Regex::new(r"(--[\w-]+): light-dark\((#\w+), (#\w+)\)").expect("a pattern");
    let set = |index: usize| -> String {
        pair.captures_iter(colours).map(|pair| format!(" {}: {};", &pair[1], &pair[index])).collect()
    };
    let (light, dark) = (set(2), set(3));
    format!(
        ":root {{ color: #1f2328;{light} }}\n\
         @media (prefers-color-scheme: dark) {{ :root {{ color: #d1d7e0;{dark} }} }}\n{rules}"
    )
}

//! A small log-log plot in braille characters, each with two by four dots.

/// A curve in powers of ten.
pub struct Curve {
    /// Name.
    pub name: &'static str,
    /// `true` if lines join the points.
    pub joined: bool,
    /// log₁₀ of both coordinates, from left to right.
    pub points: Vec<(f64, f64)>,
}

/// Largest number of characters of a line.
const WIDTH: usize = 80;
/// Characters of the plot area, across and down.
const COLUMNS: usize = 68;
const ROWS: usize = 16;
/// Characters to the left of the plot area, for labels.
const MARGIN: usize = 10;

/// U+2800 has no dots; these bits add them, by row and column within a character.
const DOTS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

impl Curve {
    /// Returns the curves of the errors of the two forces, without points.
    pub fn pair() -> [Curve; 2] {
        [("m g − c u", false), ("ε p", true)].map(|(name, joined)| Curve { name, joined, points: Vec::new() })
    }

    fn legend(&self) -> String {
        format!("{} {}", if self.joined { "⠒⠒⠒" } else { "⠂⠐⠂" }, self.name)
    }
}

/// An axis labelled with integer powers of ten.
struct Axis {
    from: f64,
    to: f64,
    dots: usize,
}

impl Axis {
    /// Returns an axis that contains all values, if there are any.
    fn around(values: impl Iterator<Item = f64> + Clone, dots: usize) -> Option<Self> {
        let from = values.clone().min_by(f64::total_cmp)?.floor();
        let to = values.max_by(f64::total_cmp)?.ceil().max(from + 1.0);
        Some(Axis { from, to, dots })
    }

    fn dot(&self, x: f64) -> usize {
        let share = (x - self.from) / (self.to - self.from);
        (share * (self.dots - 1) as f64).round() as usize
    }

    /// Returns the labelled powers, at most `most`, with their positions.
    fn ticks(&self, most: usize) -> Vec<(i64, usize)> {
        let (from, to) = (self.from as i64, self.to as i64);
        let mut steps = (0..).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_i64.pow(power)));
        let step = steps.find(|step| (to - from) / step < most as i64).expect("steps without end");
        let first = from + (-from).rem_euclid(step);
        let powers = (first..=to).step_by(step as usize);
        powers.map(|power| (power, self.dot(power as f64))).collect()
    }
}

/// The plot area.
struct Canvas([[u32; COLUMNS]; ROWS]);

impl Canvas {
    fn dot(&mut self, [across, up]: [usize; 2]) {
        let down = 4 * ROWS - 1 - up;
        self.0[down / 4][across / 2] |= DOTS[down % 4][across % 2];
    }

    fn line(&mut self, [a, b]: [usize; 2], [c, d]: [usize; 2]) {
        let steps = a.abs_diff(c).max(b.abs_diff(d)).max(1);
        for i in 0..=steps {
            self.dot([(a, c), (b, d)].map(|(from, to)| (from * (steps - i) + to * i + steps / 2) / steps));
        }
    }

    /// Returns the rows, each after the label of its tick.
    fn rows(&self, ticks: &[(i64, usize)]) -> String {
        let mut text = String::new();
        for (i, row) in self.0.iter().enumerate() {
            let tick = ticks.iter().find(|(_, up)| ROWS - 1 - up / 4 == i);
            let (label, edge) =
                tick.map_or((String::new(), '│'), |(power, _)| (format!("1e{power} "), '┤'));
            text += &format!("{label:>MARGIN$}{edge}");
            text.extend(row.iter().filter_map(|dots| char::from_u32(0x2800 + dots)));
            text.push('\n');
        }
        text
    }
}

/// Returns the horizontal axis and its labels.
fn horizontal(ticks: &[(i64, usize)]) -> (String, String) {
    let (mut axis, mut labels) = (['─'; COLUMNS], String::new());
    for (power, across) in ticks {
        axis[across / 2] = '┬';
        let label = format!("1e{power}");
        let column = (MARGIN + 1 + across / 2).saturating_sub(label.len() / 2).min(WIDTH - label.len());
        labels += &" ".repeat(column.saturating_sub(labels.len()));
        labels += &label;
    }
    (axis.iter().collect(), labels)
}

/// Returns the curves with axes and a legend, in at most 80 columns; `None` if there is nothing to draw.
pub fn log_log(curves: &[Curve]) -> Option<String> {
    let points: Vec<_> = curves.iter().flat_map(|curve| &curve.points).collect();
    let x = Axis::around(points.iter().map(|(x, _)| *x), 2 * COLUMNS)?;
    let y = Axis::around(points.iter().map(|(_, y)| *y), 4 * ROWS)?;
    let mut canvas = Canvas([[0; COLUMNS]; ROWS]);
    for curve in curves {
        let dots: Vec<_> = curve.points.iter().map(|(a, b)| [x.dot(*a), y.dot(*b)]).collect();
        dots.iter().for_each(|dot| canvas.dot(*dot));
        dots.windows(2).filter(|_| curve.joined).for_each(|pair| canvas.line(pair[0], pair[1]));
    }
    let legend = curves.iter().map(Curve::legend).collect::<Vec<_>>().join("   ");
    let rows = canvas.rows(&y.ticks(ROWS / 2));
    let (axis, labels) = horizontal(&x.ticks(6));
    let left = " ".repeat(MARGIN);
    let unit = format!("{:>WIDTH$}", "ε in N/m");
    Some(format!("{left}relative error of {legend}\n{rows}{left}└{axis}\n{labels}\n{unit}\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the rows of dots right of the axis.
    fn drawn(plot: &str) -> Vec<Vec<char>> {
        let rows = plot.lines().filter_map(|line| line.split_once(['│', '┤']));
        rows.map(|(_, dots)| dots.chars().collect()).collect()
    }

    fn pair(dotted: Vec<(f64, f64)>, joined: Vec<(f64, f64)>) -> String {
        let [mut a, mut b] = Curve::pair();
        (a.points, b.points) = (dotted, joined);
        log_log(&[a, b]).expect("points")
    }

    fn has_dots(c: &char) -> bool {
        *c != '\u{2800}'
    }

    /// Two points in opposite corners of the plot area.
    #[test]
    fn corners_of_a_plot_have_the_right_position() {
        let plot = pair(vec![(0.0, 0.0), (3.0, -6.0)], vec![]);
        let rows = drawn(&plot);
        assert_eq!((rows.len(), rows[0].len()), (ROWS, COLUMNS));
        let dots: Vec<_> = rows.concat().into_iter().enumerate().filter(|(_, c)| has_dots(c)).collect();
        // Dot 1 is the upper left dot of a character, dot 8 the lower right one.
        assert_eq!(dots, [(0, '\u{2801}'), (ROWS * COLUMNS - 1, '\u{2880}')]);
        let labels: Vec<_> = plot.lines().filter_map(|line| line.split_once(" ┤")).collect();
        assert_eq!((labels[0].0.trim(), labels.last().unwrap().0.trim()), ("1e0", "1e-6"));
    }

    /// A joined curve covers every column, and a V has its minimum in the middle.
    #[test]
    fn lines_are_drawn_between_points() {
        let rows = drawn(&pair(vec![], vec![(0.0, 0.0), (5.0, -10.0), (10.0, 0.0)]));
        assert!((0..COLUMNS).all(|column| rows.iter().any(|row| has_dots(&row[column]))));
        let places = |row: &[char]| (0..COLUMNS).filter(|i| has_dots(&row[*i])).collect::<Vec<_>>();
        let (top, bottom) = (places(&rows[0]), places(&rows[ROWS - 1]));
        assert!(top.first() == Some(&0) && top.last() == Some(&(COLUMNS - 1)), "{top:?}");
        // A row is a sixteenth of the height, and half the width spans the whole height.
        let near = |i: &usize| i.abs_diff(COLUMNS / 2) <= COLUMNS / 2 / ROWS + 1;
        assert!(!bottom.is_empty() && bottom.iter().all(near), "{bottom:?}");
    }

    /// For any range the labels have equal steps, and no line is wider than a page.
    #[test]
    fn labels_are_powers_of_ten_and_fit() {
        for (from, to) in
            [(0.0, 1.0), (0.3, 0.4), (-7.5, 12.0), (2.0, 2.0), (-99_999.0, 100_000.0), (0.0, 18.0)]
        {
            let plot = pair(vec![(from, to), (to, from)], vec![(from, -to), (to, -300_000.0)]);
            assert!(plot.lines().all(|line| line.chars().count() <= WIDTH), "{plot}");
            let labels = plot.lines().rev().nth(1).unwrap().split_whitespace();
            let powers: Vec<i64> = labels.map(|label| label[2..].parse().unwrap()).collect();
            assert!(powers.len() >= 2 && powers[0] < powers[1], "{plot}");
            let step = powers[1] - powers[0];
            assert!(powers.windows(2).all(|pair| pair[1] - pair[0] == step), "{plot}");
            assert!(powers[0] % step == 0 && powers[0] as f64 >= from.floor(), "{plot}");
        }
        assert_eq!(log_log(&Curve::pair()), None);
    }
}

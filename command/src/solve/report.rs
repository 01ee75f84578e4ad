//! Output of a solution as JSON, CSV and a table.

use super::{Options, Problem, quantities};
use crate::args::{Number, System, exact};
use crate::output::{self, record, shortened};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::Value;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::chapter::contact::Kkt;
use spring_mass_contact::number::{Exact, ExactText, NumberSystem};
use spring_mass_contact::rug::float::Round;
use spring_mass_contact::solver::{
    Bounds, Interval, Iterate, Method, Outcome, Plane, Scalar, Solution, State, format_equation,
    format_short_bound, is_convergence_guaranteed, required_precision, rounding_floor,
};
use std::io::{self, Write};
use std::iter;

/// Contents of the report on a solve.
pub struct Report<'a, T> {
    pub options: &'a Options,
    pub problem: &'a Problem<T>,
    pub solution: &'a Solution<T>,
    pub kkt: Kkt<Exact>,
    pub steps_needed: Option<String>,
}

/// Rows of a trace, computed while they are written, since there can be many.
struct Trace<'a, T>(&'a Problem<T>, &'a Solution<T>);

/// Returns an iterate with its quantities as texts.
fn row<T: ExactText>(iterate: Iterate<T>) -> impl Serialize {
    let [multiplier, deflection, penetration, contact_force] = quantities(&iterate).map(ExactText::text);
    record! {
        k: iterate.k,
        multiplier: multiplier,
        deflection: deflection,
        penetration: penetration,
        contact_force: contact_force,
    }
}

impl<T: Scalar + ExactText> Serialize for Trace<'_, T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.0.trace(self.1).map(row))
    }
}

impl<T: Scalar + ExactText> Serialize for Report<'_, T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut object = to.serialize_map(None)?;
        for (name, value) in self.fields() {
            object.serialize_entry(name, &value)?;
        }
        let [deflection, penetration, contact_force] = self.bounds();
        object.serialize_entry(
            "bounds",
            &record! {
                deflection: deflection,
                penetration: penetration,
                contact_force: contact_force,
            },
        )?;
        object.serialize_entry("kkt", &self.kkt)?;
        if self.options.trace {
            object.serialize_entry("trace", &Trace(self.problem, self.solution))?;
        }
        object.end()
    }
}

impl<T: Scalar + ExactText> Report<'_, T> {
    /// Names and values shared by JSON and CSV; quantities are texts, so that no reader rounds them.
    fn fields(&self) -> [(&'static str, Value); 11] {
        let s = self.solution;
        let [multiplier, floor] = [&s.multiplier, &s.floor].map(|x| x.as_ref().map(ExactText::text));
        [
            ("method", self.options.method.name().into()),
            ("scalar", self.options.scalar.to_string().into()),
            ("state", s.state.to_string().into()),
            ("outcome", s.outcome.to_string().into()),
            ("deflection", s.deflection.text().into()),
            ("penetration", s.penetration.text().into()),
            ("contact_force", s.contact_force.text().into()),
            ("multiplier", multiplier.into()),
            ("augmentations", s.augmentations.into()),
            ("floor", floor.into()),
            ("steps_needed", self.steps_needed.clone().into()),
        ]
    }

    /// Returns the bounds of u, p and N as texts that still enclose.
    fn bounds(&self) -> [[String; 2]; 3] {
        let Bounds { deflection, penetration, contact_force, .. } = &self.solution.bounds;
        [deflection, penetration, contact_force].map(Interval::texts)
    }

    /// Prints one row, or the rows of a trace.
    pub fn csv(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.options.trace {
            return output::csv(out, self.problem.trace(self.solution).map(row));
        }
        let (mut names, mut values): (Vec<_>, Vec<_>) =
            self.fields().map(|(name, value)| (name.to_string(), value)).into_iter().unzip();
        for (name, bounds) in ["deflection", "penetration", "contact_force"].iter().zip(self.bounds()) {
            names.extend(["lo", "hi"].map(|end| format!("{name}_{end}")));
            values.extend(bounds.map(Value::from));
        }
        let Kkt { stationarity, primal, dual, complementarity } = &self.kkt;
        names.extend(["stationarity", "primal", "dual", "complementarity"].map(|name| format!("kkt_{name}")));
        values.extend([stationarity, primal, dual, complementarity].map(|x| x.to_string().into()));
        output::csv(out, [names.into_iter().map(Value::from).collect(), values])
    }

    /// Prints the problem, the solution and its guarantees.
    pub fn table(&self, out: &mut dyn Write) -> io::Result<()> {
        let s = self.solution;
        let mut rows = vec![
            ("system", self.options.system.shown()),
            ("method", self.method_in_words()),
            ("state", self.state_in_words()),
            ("as typed", self.state_as_typed()),
            ("outcome", self.outcome_in_words()),
        ];
        let bounds = &s.bounds;
        let answer = match self.problem.method {
            Method::Lagrange | Method::Penalty { .. } => "exact:",
            Method::Augmented { .. } => "limit:",
        };
        for (name, symbol, unit, value, interval) in [
            ("deflection", "u", "m", &s.deflection, &bounds.deflection),
            ("penetration", "p", "m", &s.penetration, &bounds.penetration),
            ("contact force", "N", "N", &s.contact_force, &bounds.contact_force),
        ] {
            rows.push((name, format!("{} {unit}", format_equation(symbol, value))));
            rows.push(("", format!("{answer} {interval} {unit}")));
        }
        if let Some(multiplier) = &s.multiplier {
            rows.push(("multiplier", format!("{} N", format_equation("λ", multiplier))));
        }
        let names = ["KKT residuals"].into_iter().chain(iter::repeat(""));
        rows.extend(names.zip(self.kkt.to_string().split(", ").map(String::from)));
        let shortened = rows.iter().any(|(_, text)| text.contains('≈'));
        rows.insert(1, ("as rounded", self.visibly_rounded()));
        output::list(out, rows)?;
        if shortened {
            writeln!(out, "\n ≈ marks a shortened number; --format json has all digits.")?;
        }
        if self.options.trace { self.trace_table(out) } else { Ok(()) }
    }

    /// Prints the trace with fixed widths. Rows are computed while they are written, since there can be many.
    fn trace_table(&self, out: &mut dyn Write) -> io::Result<()> {
        const DIGITS: usize = 10;
        // Ten digits, a sign, a point, and three leading zeros or an exponent.
        const WIDE: usize = 16;
        let first = self.solution.augmentations.unwrap_or_default().to_string().len();
        let widths = [WIDE + 1; 4];
        let names = ["λ in N", "u in m", "p in m", "m g − c u in N"];
        writeln!(out, "\n {:<first$} {}", "k", output::aligned(&widths, names))?;
        for iterate in self.problem.trace(self.solution) {
            let cells = quantities(&iterate).map(|x| exact(x).decimal_within(DIGITS, WIDE));
            writeln!(out, " {:<first$} {}", iterate.k, output::aligned(&widths, cells))?;
        }
        writeln!(out, "\n At most ten digits each; --format csv has all.")
    }

    /// Describes the state, which is exact, and whether the bounds include touching without force.
    fn state_in_words(&self) -> String {
        let Solution { state, bounds, .. } = self.solution;
        let touches = [&bounds.penetration, &bounds.contact_force].iter().all(|x| x.contains(&T::zero()));
        let within = if touches && *state != State::Grazing {
            "; within the bounds it touches without force"
        } else {
            ""
        };
        format!("{}{within}", state_in_words(*state, self.problem.plane))
    }

    /// Describes the state for the numbers as typed if rounding changes it.
    fn state_as_typed(&self) -> String {
        // A solved system is valid.
        let typed =
            State::of(&self.options.system.values()).ok().filter(|typed| *typed != self.solution.state);
        typed.map_or(String::new(), |typed| {
            let state = state_in_words(typed, self.problem.plane);
            format!("{state}; --scalar exact solves for the numbers as typed")
        })
    }

    /// Describes the parameters that differ from those typed because of rounding.
    fn visibly_rounded(&self) -> String {
        let tolerance_typed = self.options.tolerance();
        let mut numbers = Vec::new();
        if let Method::Penalty { penalty } | Method::Augmented { penalty, .. } = &self.problem.method {
            numbers.push(("ε", self.options.penalty.as_ref(), penalty, "N/m"));
        }
        if let Method::Augmented { tolerance, start, .. } = &self.problem.method {
            numbers.push(("tolerance", Some(&tolerance_typed), tolerance, "m"));
            numbers.push(("λ₀", self.options.initial_multiplier.as_ref(), start, "N"));
        }
        rounded_in_words(&self.options.system, &self.problem.system, numbers)
    }

    fn method_in_words(&self) -> String {
        let name = match &self.problem.method {
            Method::Lagrange => "Lagrange multiplier".to_string(),
            Method::Penalty { penalty } => format!("penalty, {} N/m", format_equation("ε", penalty)),
            Method::Augmented { penalty, .. } => {
                format!("augmented Lagrangian, {} N/m", format_equation("ε", penalty))
            }
        };
        let plane = if self.problem.plane == Plane::Bilateral { ", bilateral" } else { "" };
        format!("{name}{plane} ({})", self.options.scalar)
    }

    /// Returns `true` if the method is guaranteed to meet its tolerance in spite of rounding.
    fn is_within_reach(&self) -> bool {
        let Method::Augmented { penalty, tolerance, .. } = &self.problem.method else { return true };
        let eta = self.options.scalar.unit_roundoff();
        is_convergence_guaranteed(&self.problem.system, penalty, tolerance, &eta).is_ok_and(|certain| certain)
    }

    /// Describes the remedy against rounding.
    fn remedy(&self) -> String {
        let Options { scalar, system, .. } = self.options;
        let plane = self.problem.plane;
        let Number { text: tolerance, value } = self.options.tolerance();
        let tolerance = shortened(&tolerance);
        // A solved system is valid.
        let floor = rounding_floor(&self.problem.system, plane, &scalar.unit_roundoff()).ok().flatten();
        if floor.as_ref().is_some_and(|floor| value > *floor) {
            return "a larger --penalty meets it, see contact advise".to_string();
        }
        let sure = floor.map_or(String::new(), |floor| {
            format!("{scalar} is guaranteed to meet a tolerance above {} m; ", floor.decimal(3, Round::Up))
        });
        match required_precision(&system.values(), plane, &value).ok().flatten() {
            Some(bits) => {
                format!("{sure}--scalar mpfr:{bits} meets {tolerance} m with the --penalty of contact advise")
            }
            None => format!("{sure}no available precision meets {tolerance} m"),
        }
    }

    fn outcome_in_words(&self) -> String {
        let k = self.solution.augmentations.unwrap_or_default();
        let tolerance = shortened(&self.options.tolerance().text);
        match self.solution.outcome {
            Outcome::Direct => "direct: nothing to iterate".to_string(),
            Outcome::Converged => {
                format!("converged at k = {k}: |u − u*| < {tolerance} m, proved by the bound")
            }
            Outcome::Stagnated => {
                let floor = self.solution.floor.as_ref().expect("a stagnated iteration has a floor");
                let stopped = match &self.problem.method {
                    Method::Augmented { tolerance, .. } if floor < tolerance => "natural residual",
                    _ => "iteration",
                };
                let floor = format_short_bound(floor, Round::Up);
                format!(
                    "stagnated at k = {k}: rounding stops the {stopped} before {tolerance} m; \
                     |u − u*| is at most {floor} m; {}",
                    self.remedy()
                )
            }
            Outcome::IterationLimit => {
                let needed = self.steps_needed.as_deref();
                let needed = needed.map_or("a number of very many digits".to_string(), shortened);
                let needs =
                    format!("iteration_limit at k = {k}: |u − u*| < {tolerance} m needs k = {needed}");
                let more = "try a larger --max-augmentations or --penalty";
                match (self.options.scalar, self.is_within_reach()) {
                    (NumberSystem::Exact, _) => format!("{needs}; {more}"),
                    (_, true) => format!("{needs} in exact arithmetic, and rounding may add a few; {more}"),
                    (_, false) => {
                        let remedy = self.remedy();
                        format!("{needs} in exact arithmetic, which rounding may prevent; {remedy}")
                    }
                }
            }
        }
    }
}

/// Describes a state for a plane.
pub fn state_in_words(state: State, plane: Plane) -> &'static str {
    match (state, plane) {
        (State::Contact, _) => "contact: the plane pushes",
        (State::Grazing, _) => "grazing: mass and plane touch without force",
        (State::Separated, Plane::Unilateral) => "separated: the mass does not touch the plane",
        (State::Separated, Plane::Bilateral) => "separated: the mass is held by a pulling plane only",
    }
}

/// A number with its symbol and unit: as typed, if it was, and as rounded.
type Quantity<'a, T> = (&'static str, Option<&'a Number>, &'a T, &'static str);

/// Describes the parameters and other numbers that visibly differ from those typed.
pub fn rounded_in_words<T: ExactText>(
    typed: &System,
    system: &SpringMass<T>,
    others: Vec<Quantity<T>>,
) -> String {
    let parameters = SpringMass::SYMBOLS.zip(SpringMass::UNITS).zip(typed.typed().zip(system.as_ref()));
    let parameters =
        parameters.into_array().map(|((symbol, unit), (typed, x))| (symbol, Some(typed), x, unit));
    let rounded = parameters.into_iter().chain(others).filter_map(|(symbol, typed, x, unit)| {
        Some(format!("{} {unit}", visibly_rounded(symbol, &typed?.text, &typed?.value, x)?))
    });
    rounded.collect::<Vec<_>>().join(", ")
}

/// Smallest number of digits compared, regardless of those typed; floats of 32 bits have as many.
const MIN_DIGITS: usize = 6;

/// Largest number of digits written.
const MAX_DIGITS: usize = 17;

/// Returns the rounded value, `g = 8`, if it visibly differs from the number typed, when written with as many
/// digits. It does not if few digits are typed, up to 6 for f32 and 15 for f64.
fn visibly_rounded<T: ExactText>(symbol: &str, typed: &str, value: &Exact, x: &T) -> Option<String> {
    let mantissa = match typed.split_once(['x', 'X']) {
        Some((_, hexadecimal)) => hexadecimal.split(['p', 'P']).next(),
        None => typed.split(['e', 'E']).next(),
    };
    let digits = mantissa.unwrap_or_default().chars().filter(char::is_ascii_hexdigit);
    let digits = digits.skip_while(|digit| *digit == '0').count();
    // A fraction has no decimal digits.
    let digits = if typed.contains('/') { MIN_DIGITS } else { digits.max(MIN_DIGITS) };
    let x = exact(x);
    (value.decimal(digits, Round::Nearest) != x.decimal(digits, Round::Nearest)).then(|| {
        let text = x.decimal(digits.min(MAX_DIGITS), Round::Nearest);
        let sign = if text.parse() == Ok(x) { '=' } else { '≈' };
        format!("{symbol} {sign} {text}")
    })
}

//! A solution as JSON, as CSV and as a table.

use super::{Options, Problem};
use crate::args::Number as Typed;
use crate::output::{self, WIDTH};
use crate::text::{
    Number, brief, brief_bounds, decimal, enclosing, fitting, relation, shortened, visibly_rounded,
};
use serde::ser::{Serialize, SerializeStruct, Serializer};
use spring_mass_contact::chapter::contact::Kkt;
use spring_mass_contact::number::{Exact, NumberSystem};
use spring_mass_contact::rug::{Integer, float::Round};
use spring_mass_contact::solver::{Interval, Iterate, Method, Outcome, Plane, Solution, State, within_reach};
use std::io::{self, Write};

/// What helps against rounding.
const LARGER: &str = "try a larger --tolerance or more bits (--scalar mpfr:BITS)";

/// All there is to say about a solve.
pub struct Report<'a, T> {
    options: &'a Options,
    problem: &'a Problem<T>,
    solution: &'a Solution<T>,
    kkt: Kkt<Exact>,
    steps_needed: Option<String>,
}

impl<'a, T: Number> Report<'a, T> {
    pub fn new(
        options: &'a Options,
        problem: &'a Problem<T>,
        solution: &'a Solution<T>,
        steps_needed: Option<Integer>,
    ) -> Self {
        let steps_needed = steps_needed.map(|n| n.to_string());
        Report { options, problem, solution, kkt: solution.certificate(&problem.system), steps_needed }
    }

    fn state(&self) -> &'static str {
        match self.solution.state {
            State::Contact => "contact",
            State::Grazing => "grazing",
            State::Separated => "separated",
            _ => unreachable!("states have three signs"),
        }
    }

    fn outcome(&self) -> &'static str {
        match self.solution.outcome {
            Outcome::Direct => "direct",
            Outcome::Converged => "converged",
            Outcome::Stagnated => "stagnated",
            Outcome::OutOfSteps => "out_of_steps",
            _ => unreachable!("no other outcome is known here"),
        }
    }

    fn bounds(&self) -> [(&'static str, &Interval<T>); 3] {
        let bounds = &self.solution.bounds;
        [
            ("deflection", &bounds.deflection),
            ("penetration", &bounds.penetration),
            ("contact_force", &bounds.contact_force),
        ]
    }

    fn kkt(&self) -> [(&'static str, &Exact); 4] {
        let Kkt { stationarity, primal, dual, complementarity } = &self.kkt;
        [
            ("stationarity", stationarity),
            ("primal", primal),
            ("dual", dual),
            ("complementarity", complementarity),
        ]
    }

    /// The names and values that JSON and CSV share.
    fn fields(&self) -> [(&'static str, Field); 11] {
        let text = |x: &T| Field::Text(x.text());
        let maybe = |x: &Option<T>| x.as_ref().map_or(Field::Null, text);
        let s = self.solution;
        [
            ("method", Field::Text(self.options.method.name().to_string())),
            ("scalar", Field::Text(self.options.scalar.to_string())),
            ("state", Field::Text(self.state().to_string())),
            ("outcome", Field::Text(self.outcome().to_string())),
            ("deflection", text(&s.deflection)),
            ("penetration", text(&s.penetration)),
            ("contact_force", text(&s.contact_force)),
            ("multiplier", maybe(&s.multiplier)),
            ("augmentations", s.augmentations.map_or(Field::Null, Field::Count)),
            ("floor", maybe(&s.floor)),
            ("steps_needed", self.steps_needed.clone().map_or(Field::Null, Field::Text)),
        ]
    }
}

/// A value: quantities are texts, so that no reader rounds them.
enum Field {
    Null,
    Count(u64),
    Text(String),
}

impl Serialize for Field {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Field::Null => to.serialize_none(),
            Field::Count(n) => to.serialize_u64(*n),
            Field::Text(text) => to.serialize_str(text),
        }
    }
}

/// Named values in their order.
struct Object<'a, V>(Vec<(&'a str, V)>);

impl<V: Serialize> Serialize for Object<'_, V> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// The rows, made while they are written: there can be very many.
struct Trace<'a, T>(&'a Problem<T>, &'a Solution<T>);

impl<T: Number> Serialize for Trace<'_, T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let row = |step: Iterate<T>| {
            let values = step_texts(&step).map(Field::Text);
            Object(std::iter::once(("k", Field::Count(step.k))).chain(STEP.into_iter().zip(values)).collect())
        };
        to.collect_seq(self.0.trace(self.1).map(row))
    }
}

/// What a row of the trace has after k.
const STEP: [&str; 4] = ["multiplier", "deflection", "penetration", "contact_force"];

fn step_values<T>(step: &Iterate<T>) -> [&T; 4] {
    [&step.multiplier, &step.deflection, &step.penetration, &step.contact_force]
}

fn step_texts<T: Number>(step: &Iterate<T>) -> [String; 4] {
    step_values(step).map(Number::text)
}

impl<T: Number> Serialize for Report<'_, T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut object = to.serialize_struct("solve", 14)?;
        for (name, value) in self.fields() {
            object.serialize_field(name, &value)?;
        }
        let bounds = self.bounds().map(|(name, interval)| (name, enclosing(interval)));
        object.serialize_field("bounds", &Object(bounds.into()))?;
        let kkt = self.kkt().map(|(name, residual)| (name, residual.to_string()));
        object.serialize_field("kkt", &Object(kkt.into()))?;
        if self.options.trace {
            object.serialize_field("trace", &Trace(self.problem, self.solution))?;
        }
        object.end()
    }
}

impl<T: Number> Report<'_, T> {
    /// One row, or with a trace its rows. No value has a comma or a quote in it.
    pub fn csv(&self, out: &mut dyn Write) -> io::Result<()> {
        if self.options.trace {
            writeln!(out, "k,{}", STEP.join(","))?;
            return self
                .problem
                .trace(self.solution)
                .try_for_each(|step| writeln!(out, "{},{}", step.k, step_texts(&step).join(",")));
        }
        let mut names = Vec::new();
        let mut values = Vec::new();
        for (name, value) in self.fields() {
            names.push(name.to_string());
            values.push(match value {
                Field::Null => String::new(),
                Field::Count(n) => n.to_string(),
                Field::Text(text) => text,
            });
        }
        for (name, interval) in self.bounds() {
            names.extend([format!("{name}_lo"), format!("{name}_hi")]);
            values.extend(enclosing(interval));
        }
        for (name, residual) in self.kkt() {
            names.push(format!("kkt_{name}"));
            values.push(residual.to_string());
        }
        writeln!(out, "{}\n{}", names.join(","), values.join(","))
    }

    /// For people: what was solved, what came out, and what that promises.
    pub fn table(&self, out: &mut dyn Write) -> io::Result<()> {
        let s = self.solution;
        let mut rows = vec![
            ("system", self.system_in_words()),
            ("method", self.method_in_words()),
            ("state", self.state_in_words().to_string()),
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
            let [lower, upper] = brief_bounds(interval);
            rows.push((name, format!("{} {unit}", relation(symbol, value))));
            let enclosure = if lower == upper { lower } else { format!("{lower} to {upper}") };
            rows.push(("", format!("{answer} {enclosure} {unit}")));
        }
        if let Some(multiplier) = &s.multiplier {
            rows.push(("multiplier", format!("{} N", relation("λ", multiplier))));
        }
        for (i, ((name, residual), unit)) in self.kkt().into_iter().zip(["N", "m", "N", "J"]).enumerate() {
            let residual = format!("{name} {} {unit}", decimal(residual, 3, Round::Nearest));
            rows.push((if i == 0 { "KKT residuals" } else { "" }, residual));
        }
        let shortened = rows.iter().any(|(_, text)| text.contains('≈'));
        let rounded = self.visibly_rounded();
        if !rounded.is_empty() {
            rows.insert(1, ("as rounded", rounded));
        }
        let mut table = output::table();
        table.add_rows(rows.iter().map(|(name, text)| [name, text.as_str()]));
        writeln!(out, "{}", table.trim_fmt())?;
        if shortened {
            writeln!(out, "\n ≈ is shortened; --format json has all digits.")?;
        }
        if self.options.trace { self.trace_table(out) } else { Ok(()) }
    }

    /// Widths are fixed, and each row is made while it is written: there can be very many.
    fn trace_table(&self, out: &mut dyn Write) -> io::Result<()> {
        const DIGITS: usize = 10;
        let first = self.solution.augmentations.unwrap_or_default().to_string().len();
        // Ten digits, a sign, a point, and three zeros before them or an exponent behind; less beside a long k.
        let width = ((usize::from(WIDTH) - " ".len() - first) / STEP.len() - "  ".len()).min(DIGITS + 6);
        let line = |k: String, cells: [String; 4]| {
            let cells = cells.map(|cell| format!("  {cell:<width$}")).concat();
            format!(" {k:<first$}{cells}").trim_end().to_string()
        };
        let names = ["λ in N", "u in m", "p in m", "m g − c u in N"].map(String::from);
        writeln!(out, "\n{}", line("k".to_string(), names))?;
        for step in self.problem.trace(self.solution) {
            let cells = step_values(&step).map(|x| fitting(x, DIGITS, width));
            writeln!(out, "{}", line(step.k.to_string(), cells))?;
        }
        writeln!(out, "\n At most ten digits each; --format csv has all.")
    }

    fn system_in_words(&self) -> String {
        let text = |number: &Typed| shortened(&number.text);
        let system = &self.options.system;
        format!(
            "c = {} N/m, m = {} kg, g = {} m/s², l = {} m, H = {} m",
            text(&system.stiffness),
            text(&system.mass),
            text(&system.gravity),
            text(&system.free_length),
            text(&system.height)
        )
    }

    /// The numbers that are not what was typed: the answer is for these.
    fn visibly_rounded(&self) -> String {
        let (typed, system) = (&self.options.system, &self.problem.system);
        let tolerance_typed = self.options.tolerance();
        let mut numbers = vec![
            ("c", Some(&typed.stiffness), &system.c, "N/m"),
            ("m", Some(&typed.mass), &system.m, "kg"),
            ("g", Some(&typed.gravity), &system.g, "m/s²"),
            ("l", Some(&typed.free_length), &system.l, "m"),
            ("H", Some(&typed.height), &system.h, "m"),
        ];
        match &self.problem.method {
            Method::Lagrange => {}
            Method::Penalty { penalty } => {
                numbers.push(("ε", self.options.penalty.as_ref(), penalty, "N/m"));
            }
            Method::Augmented { penalty, tolerance, start, .. } => {
                numbers.push(("ε", self.options.penalty.as_ref(), penalty, "N/m"));
                numbers.push(("tolerance", Some(&tolerance_typed), tolerance, "m"));
                numbers.push(("λ₀", self.options.initial_multiplier.as_ref(), start, "N"));
            }
        }
        let rounded = numbers.into_iter().filter_map(|(symbol, typed, x, unit)| {
            let typed = typed?;
            let text = visibly_rounded(symbol, &typed.text, &typed.value, x)?;
            Some(format!("{text} {unit}"))
        });
        rounded.collect::<Vec<_>>().join(", ")
    }

    fn method_in_words(&self) -> String {
        let name = match &self.problem.method {
            Method::Lagrange => "Lagrange multiplier".to_string(),
            Method::Penalty { penalty } => format!("penalty, {} N/m", relation("ε", penalty)),
            Method::Augmented { penalty, .. } => {
                format!("augmented Lagrangian, {} N/m", relation("ε", penalty))
            }
        };
        let plane = if self.problem.plane == Plane::Bilateral { ", bilateral" } else { "" };
        format!("{name}{plane} ({})", self.options.scalar)
    }

    fn state_in_words(&self) -> &'static str {
        match (self.solution.state, self.problem.plane) {
            (State::Contact, _) => "contact: the plane pushes",
            (State::Grazing, _) => "grazing: mass and plane touch without force",
            (_, Plane::Unilateral) => "separated: the mass hangs free",
            (_, Plane::Bilateral) => "separated: only a plane that pulls holds the mass",
        }
    }

    /// Is it certain that rounding lets the method meet its tolerance?
    fn is_within_reach(&self) -> bool {
        let Method::Augmented { penalty, tolerance, .. } = &self.problem.method else { return true };
        within_reach(&self.problem.system, penalty, tolerance, &self.options.scalar.unit_roundoff())
    }

    fn outcome_in_words(&self) -> String {
        let Method::Augmented { .. } = self.problem.method else {
            return "direct: nothing to iterate".to_string();
        };
        let k = self.solution.augmentations.unwrap_or_default();
        let tolerance = shortened(&self.options.tolerance().text);
        match (self.solution.outcome, &self.solution.floor, &self.steps_needed) {
            (Outcome::Converged, ..) => {
                format!("converged at k = {k}: |u − u*| < {tolerance} m, proved by the bound")
            }
            (Outcome::Stagnated, Some(floor), _) => format!(
                "stagnated at k = {k}: rounding stops the iteration short of {tolerance} m; its floor, the \
                 least bound of |u − u*| met, is {} m; {LARGER}",
                brief(floor)
            ),
            (_, _, needed) => {
                let needed = needed.as_deref().map_or(String::new(), shortened);
                let needs = format!("out_of_steps at k = {k}: |u − u*| < {tolerance} m needs k = {needed}");
                let more = "try a larger --max-augmentations or --penalty";
                match (self.options.scalar, self.is_within_reach()) {
                    (NumberSystem::Exact, _) => format!("{needs}; {more}"),
                    (_, true) => format!("{needs} in exact arithmetic, and rounding may add a few; {more}"),
                    (_, false) => {
                        format!("{needs} in exact arithmetic, which rounding may not allow; {LARGER}")
                    }
                }
            }
        }
    }
}

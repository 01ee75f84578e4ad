//! `contact cases`: systems with exact solutions.

use crate::args::{format_exact, parse_u64, parse_u64_in};
use crate::output::{self, Exit, Failure, formats, record};
use serde::Serialize;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{self, Family, Problem, problems};

const EXAMPLES: &str = "\
Examples:
  contact cases
  contact cases --family near --family far --cases 100 --seed 7 --format json
  contact cases --blank > sheet.csv

Parameters are decimals with at most 12 significant digits, to be read exactly;
solutions are exact fractions for unilateral contact: the plane never pulls.
`contact check` uses the same systems.";

/// Print systems with exact solutions: test vectors for any language
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    drawn: Selection,
    /// Leave the solutions empty: a sheet to fill in for `contact check --answers`
    #[arg(long)]
    blank: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Csv)]
    format: Format,
}

/// Selection of systems.
#[derive(clap::Args)]
pub struct Selection {
    /// Systems of each family and each decade of graded, from 1 to 10000
    #[arg(long, value_name = "N", default_value_t = check::CASES)]
    #[arg(value_parser = |text: &str| parse_u64_in(1..=10_000, text))]
    cases: u64,
    /// Seed of the systems, which are the same on every machine
    #[arg(long, value_name = "N", default_value = "1", value_parser = parse_u64)]
    pub seed: u64,
    /// Only this family, repeatable: contact, separated, grazing, near, overlap, lifted, stiff, soft,
    /// far, huge, tiny, graded, signed or neighbour
    #[arg(long = "family", value_name = "F")]
    families: Vec<Family>,
}

formats!(Csv: "In rows", Json: "Numbers as strings");

impl Selection {
    /// Returns the systems by families.
    pub fn problems(&self) -> Vec<Problem> {
        let mut families = Family::ALL.to_vec();
        families.retain(|family| self.families.is_empty() || self.families.contains(family));
        problems(self.seed, self.cases, &families)
    }
}

/// Prints the systems.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let cases: Vec<_> =
        options.drawn.problems().into_iter().map(|problem| case(problem, options.blank)).collect();
    output::print(|out| match options.format {
        Format::Csv => output::csv(out, &cases),
        Format::Json => output::json(out, &cases),
    })
}

/// Returns a system with its exact solution, which may be left empty.
fn case(problem: Problem, is_blank: bool) -> impl Serialize {
    let SpringMass { c, m, g, l, h } = problem.system.as_ref().map(format_exact);
    let exact = problem.solution();
    let cell = |x| (!is_blank).then_some(x);
    record! {
        id: problem.id,
        family: problem.family,
        stiffness: c,
        mass: m,
        gravity: g,
        free_length: l,
        height: h,
        deflection: cell(exact.deflection),
        penetration: cell(exact.penetration),
        contact_force: cell(exact.contact_force),
    }
}

//! `contact cases`: systems with their exact answers.

use crate::args::{parse_u64, parse_u64_in, spelled};
use crate::output::{self, Exit, Failure, formats, record};
use serde::Serialize;
use spring_mass_contact::chapter::SpringMass;
use spring_mass_contact::check::{self, Family, Problem, problems};

const EXAMPLES: &str = "\
Examples:
  contact cases
  contact cases --family near --family far --cases 100 --seed 7 --format json

Parameters are decimals of at most 12 significant digits, and meant exactly;
answers are fractions, and exact, for a plane that pushes and never pulls.
`contact check` puts the same systems to a program.";

/// Print systems with their exact answers: test vectors for any language
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Options {
    #[command(flatten)]
    drawn: Drawn,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Csv)]
    format: Format,
}

/// Which systems.
#[derive(clap::Args)]
pub struct Drawn {
    /// Systems of each family and each decade of graded, from 1 to 10000
    #[arg(long, value_name = "N", default_value_t = check::CASES)]
    #[arg(value_parser = |text: &str| parse_u64_in(1..=10_000, text))]
    cases: u64,
    /// Where they are drawn from; the same seed, the same systems, on every machine
    #[arg(long, value_name = "N", default_value = "1", value_parser = parse_u64)]
    pub seed: u64,
    /// Only this family, repeatable: contact, separated, grazing, near, overlap, lifted, stiff, soft,
    /// far, huge, tiny or graded
    #[arg(long = "family", value_name = "F")]
    families: Vec<Family>,
}

formats!(Csv: "In rows", Json: "Numbers as strings");

impl Drawn {
    /// The systems, by families.
    pub fn problems(&self) -> Vec<Problem> {
        let wanted = |family: &Family| self.families.is_empty() || self.families.contains(family);
        let families: Vec<_> = Family::ALL.into_iter().filter(wanted).collect();
        problems(self.seed, self.cases, &families)
    }
}

/// Draws the systems and prints them.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let cases: Vec<_> = options.drawn.problems().into_iter().map(case).collect();
    output::print(|out| match options.format {
        Format::Csv => output::csv(out, &cases),
        Format::Json => output::json(out, &cases),
    })
}

/// Returns a system with its exact answer.
fn case(problem: Problem) -> impl Serialize {
    let SpringMass { c, m, g, l, h } = problem.system.map(spelled);
    let exact = problem.solution();
    record! {
        id: problem.id,
        family: problem.family,
        stiffness: c,
        mass: m,
        gravity: g,
        free_length: l,
        height: h,
        deflection: exact.deflection,
        penetration: exact.penetration,
        contact_force: exact.contact_force,
    }
}

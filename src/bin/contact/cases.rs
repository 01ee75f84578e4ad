//! `contact cases`: systems with their exact answers.

use crate::args::{spelled, whole, whole_in};
use crate::output::{self, Exit, Failure, Row};
use clap::ValueEnum;
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
    #[arg(value_parser = |text: &str| whole_in(1..=10_000, text))]
    cases: u64,
    /// Where they are drawn from; the same seed, the same systems, on every machine
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole)]
    pub seed: u64,
    /// Only this family, repeatable: contact, separated, grazing, near, overlap, lifted, stiff, soft,
    /// far, huge, tiny or graded
    #[arg(long = "family", value_name = "F")]
    families: Vec<Family>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// In rows
    Csv,
    /// Numbers as strings
    Json,
}

impl Drawn {
    /// The systems, by families.
    pub fn problems(&self) -> Vec<Problem> {
        let wanted = |family: &Family| self.families.is_empty() || self.families.contains(family);
        let families: Vec<_> = Family::ALL.into_iter().filter(wanted).collect();
        problems(self.seed, self.cases, &families)
    }
}

/// Draws and prints.
pub fn run(options: &Options) -> Result<Exit, Failure> {
    let rows: Vec<_> = options.drawn.problems().iter().map(row).collect();
    output::print(|out| match options.format {
        Format::Csv => output::csv(out, &NAMES, &rows),
        Format::Json => output::json(out, &rows),
    })
}

/// The columns.
const NAMES: [&str; 10] = [
    "id",
    "family",
    "stiffness",
    "mass",
    "gravity",
    "free_length",
    "height",
    "deflection",
    "penetration",
    "contact_force",
];

fn row(problem: &Problem) -> Row<10> {
    let SpringMass { c, m, g, l, h } = problem.system.map(spelled);
    let exact = problem.solution();
    let [u, p, n] = [exact.deflection, exact.penetration, exact.contact_force].map(|x| x.to_string());
    Row(&NAMES, [problem.id.clone(), problem.family.to_string(), c, m, g, l, h, u, p, n].map(Some))
}

//! The command `contact`, for its binary alone: nothing here is stable.
//!
//! The module `args` contains arguments shared by subcommands, `json` the input of objects, `output` one
//! function for each output format, and `lines` the line breaks of formulas; each subcommand is a module.

mod advise;
mod args;
mod cases;
mod check;
mod equations;
mod json;
mod lines;
mod output;
mod prove;
mod solve;
mod sweep;
mod verify;

use clap::{CommandFactory, Parser, Subcommand};
use output::{Exit, Failure};
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  contact                         prove and check the whole chapter
  contact solve                   solve the default system by Lagrange multiplier
  contact solve --method penalty --penalty 1000 --scalar exact
  contact solve --height 2 --format json
  contact advise --tolerance 1e-12
  contact sweep --penalty 1..1e18
  contact check -- python3 my_adapter.py
  contact equations 1.13
  contact prove 1.17
  contact verify --scalar mpfr:1000 --cases 50

Exit status: 0 success; 1 a claim does not hold, a solve did not converge, a
tolerance is not attainable or a checked program is wrong; 2 bad input.";

/// A mass on a spring over a rigid plane: contact by Lagrange multiplier, penalty and augmented Lagrangian
///
/// Without a command, runs verify.
#[derive(Parser)]
#[command(name = "contact", version, after_help = EXAMPLES, max_term_width = output::WIDTH.into())]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    Verify(verify::Options),
    Prove(prove::Options),
    Solve(Box<solve::Options>),
    Advise(Box<advise::Options>),
    Sweep(Box<sweep::Options>),
    Cases(cases::Options),
    Check(Box<check::Options>),
    Equations(equations::Options),
    Completions(Completions),
}

/// Print the completions for a shell
#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  contact completions bash > ~/.local/share/bash-completion/completions/contact"
)]
struct Completions {
    /// Shell
    shell: clap_complete::Shell,
}

/// Returns the subcommands and options, for tests.
#[doc(hidden)]
pub fn definition() -> clap::Command {
    Cli::command()
}

/// Runs the command with the arguments of the process.
pub fn main() -> ExitCode {
    let answer = args::checked_arguments().and_then(|arguments| match Cli::try_parse_from(arguments) {
        Ok(cli) => run(cli),
        Err(error) => {
            let command = Cli::command();
            let names: Vec<_> = command.get_subcommands().map(clap::Command::get_name).collect();
            output::clap_message(error, &names)
        }
    });
    output::exit_code(answer)
}

fn run(cli: Cli) -> Result<Exit, Failure> {
    match cli.command {
        None => run(Cli::parse_from(["contact", "verify"])),
        Some(Command::Verify(options)) => verify::run(&options),
        Some(Command::Prove(options)) => prove::run(&options),
        Some(Command::Equations(options)) => equations::run(&options),
        Some(Command::Solve(options)) => solve::run(&options),
        Some(Command::Advise(options)) => advise::run(&options),
        Some(Command::Sweep(options)) => sweep::run(&options),
        Some(Command::Cases(options)) => cases::run(&options),
        Some(Command::Check(options)) => check::run(&options),
        Some(Command::Completions(Completions { shell })) => {
            // The generator panics on write errors, which do not occur in memory.
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "contact", &mut script);
            output::print(|out| out.write_all(&script))
        }
    }
}

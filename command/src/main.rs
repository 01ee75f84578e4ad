//! The command `contact`.

use std::process::ExitCode;

fn main() -> ExitCode {
    spring_mass_contact_cli::main()
}

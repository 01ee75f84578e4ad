//! Lines of the source of functions and entries, compiled in.

use std::fmt;
use std::panic::Location;
use std::path::Path;

/// A line of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SourceLine {
    /// Path in the repository.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
}

impl fmt::Display for SourceLine {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

impl SourceLine {
    /// Returns the line of the caller, which is in a file of this folder.
    #[track_caller]
    pub(super) fn of_caller() -> Self {
        let caller = Location::caller();
        // The compiler may have been given another path to the folder.
        let file = Path::new(caller.file()).file_name().unwrap_or_default();
        SourceLine { file: format!("src/claims/{}", file.display()), line: caller.line() }
    }
}

macro_rules! sources {
    ($($module:ident)*) => {
        [$((stringify!($module), include_str!(concat!("../chapter/", stringify!($module), ".rs")))),*]
    };
}

/// Names and texts of the modules of the chapter.
const MODULES: [(&str, &str); 9] =
    sources!(augmented beyond contact lagrange ode penalty rounding structure system);

/// Returns the line on which the definition of a function or a type of the chapter begins.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::claims::function_line;
/// let line = function_line("augmented::update").unwrap();
/// assert_eq!(line.file, "src/chapter/augmented.rs");
/// assert_eq!(function_line("augmented::nothing"), None);
/// ```
pub fn function_line(path: &str) -> Option<SourceLine> {
    let (module, name) = path.split_once("::")?;
    let (_, text) = MODULES.iter().find(|(other, _)| *other == module)?;
    let heads = ["fn", "struct"].map(|kind| format!("pub {kind} {name}"));
    let line = text.lines().position(|line| {
        heads.iter().filter_map(|head| line.strip_prefix(head)).any(|rest| rest.starts_with(['<', '(', ' ']))
    })?;
    Some(SourceLine { file: format!("src/chapter/{module}.rs"), line: line as u32 + 1 })
}

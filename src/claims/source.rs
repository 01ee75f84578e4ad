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
    let (index, _) = find_definition(text, name)?;
    Some(SourceLine { file: format!("src/chapter/{module}.rs"), line: index as u32 + 1 })
}

/// Returns the index of the line on which the definition of a public function or type begins in the text of a module,
/// and its kind, `fn` or `struct`.
///
/// # Examples
///
/// ```
/// use spring_mass_contact::claims::find_definition;
/// assert_eq!(find_definition("/// Doc.\npub fn gap<T>() {}", "gap"), Some((1, "fn")));
/// ```
pub fn find_definition(text: &str, name: &str) -> Option<(usize, &'static str)> {
    let heads = ["fn", "struct"].map(|kind| (kind, format!("pub {kind} {name}")));
    text.lines().enumerate().find_map(|(index, line)| {
        let mut kinds = heads.iter().filter_map(|(kind, head)| Some((*kind, line.strip_prefix(head)?)));
        let (kind, _) = kinds.find(|(_, rest)| rest.starts_with(['<', '(', ' ']))?;
        Some((index, kind))
    })
}

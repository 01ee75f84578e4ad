//! A system from texts.

use super::check::{self, SolveError};
use crate::chapter::SpringMass;
use crate::number::{Exact, ParseError};

/// Why texts spell no system.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// A parameter that does not spell a number.
    #[error("{argument} '{value}': {reason}")]
    NotANumber {
        /// The parameter's name.
        argument: &'static str,
        /// What it was.
        value: String,
        /// What is wrong with it.
        #[source]
        reason: ParseError,
    },
    /// A parameter outside its range.
    #[error(transparent)]
    Invalid(#[from] SolveError),
}

impl<S: AsRef<str>> SpringMass<S> {
    /// Reads a system from texts, exactly, and checks it.
    ///
    /// # Errors
    /// A text that is not a number, or a parameter outside its range.
    ///
    /// ```
    /// use spring_mass_contact::{chapter::SpringMass, number::Exact};
    /// let system = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse()?;
    /// assert_eq!(system.try_map(Exact::to_f64).unwrap().g, 9.81);
    /// let error = SpringMass { c: "-1", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap_err();
    /// assert_eq!(error.to_string(), "stiffness -1: must be greater than 0 and finite");
    /// # Ok::<(), spring_mass_contact::solver::ReadError>(())
    /// ```
    pub fn parse(&self) -> Result<SpringMass<Exact>, ReadError> {
        let number = |argument, text: &S| {
            let text = text.as_ref();
            let refused = |reason| ReadError::NotANumber { argument, value: text.to_string(), reason };
            text.parse::<Exact>().map_err(refused)
        };
        let parsed = SpringMass::NAMES.zip(self.as_ref()).try_map(|(name, text)| number(name, text))?;
        check::system(&parsed)?;
        Ok(parsed)
    }
}

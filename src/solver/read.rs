//! Parsing of a system.

use super::{SolveError, validate};
use crate::chapter::SpringMass;
use crate::number::{Exact, ParseError};

/// Error of parsing a system.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The text of a parameter is not a number.
    #[error("{argument} '{value}': {reason}")]
    NotANumber {
        /// Name of the parameter.
        argument: &'static str,
        /// Its text.
        value: String,
        /// The error in the text.
        #[source]
        reason: ParseError,
    },
    /// A parameter is outside its range.
    #[error(transparent)]
    Invalid(#[from] SolveError),
}

impl<S: AsRef<str>> SpringMass<S> {
    /// Parses a system exactly and checks it.
    ///
    /// # Errors
    /// Returns an error if a text is not a number or a parameter is outside its range.
    ///
    /// # Examples
    ///
    /// ```
    /// use spring_mass_contact::{chapter::SpringMass, number::Exact};
    /// let system = SpringMass { c: "100", m: "1", g: "9.81", l: "1", h: "1.05" }.parse()?;
    /// assert_eq!(system.as_ref().try_map(Exact::to_f64).unwrap().g, 9.81);
    /// let error = SpringMass { c: "-1", m: "1", g: "9.81", l: "1", h: "1.05" }.parse().unwrap_err();
    /// assert_eq!(error.to_string(), "stiffness -1: must be greater than 0 and finite");
    /// # Ok::<(), spring_mass_contact::solver::ReadError>(())
    /// ```
    pub fn parse(&self) -> Result<SpringMass<Exact>, ReadError> {
        let parsed = SpringMass::NAMES.zip(self.as_ref()).try_map(|(argument, text)| {
            let value = text.as_ref();
            let number = value.parse::<Exact>();
            number.map_err(|reason| ReadError::NotANumber { argument, value: value.to_string(), reason })
        })?;
        validate::system(&parsed)?;
        Ok(parsed)
    }
}

//! Variables in messages.

use crate::formula::symbols::subscripted;

/// A variable in a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// A symbol of the statement.
    Own(&'static str),
    /// A relative rounding error divided by its maximum: e₁, e₂, …, with −1 ≤ e ≤ 1.
    Error(u8),
    /// The value of a hypothesis, or an absolute value: s₁, s₂, ….
    Slack(u8),
    /// The parameter of a quantity in an interval: t₁, t₂, …, with −1 ≤ t ≤ 1.
    IntervalParameter(u8),
}

impl Symbol {
    /// Returns the printed name.
    pub fn name(self) -> &'static str {
        match self {
            Symbol::Own(name) => name,
            Symbol::Error(index) => subscripted('e', index),
            Symbol::Slack(index) => subscripted('s', index),
            Symbol::IntervalParameter(index) => subscripted('t', index),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_have_names() {
        let all = [Symbol::Error(0), Symbol::Slack(11), Symbol::IntervalParameter(u8::MAX), Symbol::Own("e")];
        assert_eq!(all.map(Symbol::name), ["e₁", "s₁₂", "t₂₅₆", "e"]);
    }
}

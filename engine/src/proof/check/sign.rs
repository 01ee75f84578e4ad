//! Signs of numbers.

use crate::formula::Relation;

/// The sign of a value x that may depend on symbols.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// x < 0
    Negative,
    /// x ≤ 0
    NonPositive,
    /// x = 0
    Zero,
    /// x ≥ 0
    NonNegative,
    /// x > 0
    Positive,
    /// x may be any number.
    Any,
}

use Sign::{Any, Negative, NonNegative, NonPositive, Positive, Zero};

impl From<Relation> for Sign {
    fn from(relation: Relation) -> Self {
        match relation {
            Relation::Positive => Positive,
            Relation::NonNegative => NonNegative,
            Relation::Zero => Zero,
        }
    }
}

impl Sign {
    /// Returns `true` if the sign excludes zero.
    pub fn is_strict(self) -> bool {
        matches!(self, Positive | Negative)
    }

    /// Returns the sign of −x.
    pub fn negated(self) -> Self {
        match self {
            Negative => Positive,
            NonPositive => NonNegative,
            NonNegative => NonPositive,
            Positive => Negative,
            Zero | Any => self,
        }
    }

    /// Returns the sign of x y.
    pub fn times(self, other: Self) -> Self {
        match (self, other) {
            (Zero, _) | (_, Zero) => Zero,
            (Any, _) | (_, Any) => Any,
            (Positive, sign) | (sign, Positive) => sign,
            (Negative, sign) | (sign, Negative) => sign.negated(),
            (sign, _) if sign == other => NonNegative,
            _ => NonPositive,
        }
    }

    /// Returns the sign of x + y.
    pub fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Zero, sign) | (sign, Zero) => sign,
            (Any, _) | (_, Any) => Any,
            _ if self.implies(other) => self,
            _ if other.implies(self) => other,
            _ => Any,
        }
    }

    /// Returns `true` if every number with the sign `self` also has the sign `other`.
    pub fn implies(self, other: Self) -> bool {
        self == other
            || matches!(
                (self, other),
                (Positive | Zero, NonNegative) | (Negative | Zero, NonPositive) | (_, Any)
            )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_of_sums_and_products_are_those_of_numbers() {
        // The first ones imply the others.
        const SIGNS: [Sign; 6] = [Negative, Zero, Positive, NonPositive, NonNegative, Any];
        // −1, 0 and 1 represent all numbers; the sums include multiples, so that either sign can prevail.
        let has = |sign: Sign, x: i32| match sign {
            Negative => x < 0,
            NonPositive => x <= 0,
            Zero => x == 0,
            NonNegative => x >= 0,
            Positive => x > 0,
            Any => true,
        };
        let strongest =
            |values: Vec<i32>| SIGNS.into_iter().find(|sign| values.iter().all(|x| has(*sign, *x))).unwrap();
        for (s, t) in SIGNS.iter().flat_map(|s| SIGNS.map(|t| (*s, t))) {
            let of = |sign| (-1..=1).filter(move |x| has(sign, *x));
            let pairs: Vec<_> = of(s).flat_map(|x| of(t).map(move |y| (x, y))).collect();
            assert_eq!(s.times(t), strongest(pairs.iter().map(|(x, y)| x * y).collect()), "{s:?} {t:?}");
            let sums = pairs.iter().flat_map(|(x, y)| [x + y, 2 * x + y, x + 2 * y]);
            assert_eq!(s.plus(t), strongest(sums.collect()), "{s:?} {t:?}");
            assert_eq!(s.implies(t), of(s).all(|x| has(t, x)), "{s:?} {t:?}");
        }
        assert!(SIGNS.iter().all(|s| s.is_strict() != has(*s, 0) && s.negated() == s.times(Negative)));
    }
}

//! Signs of numbers.

use crate::formula::Relation;

/// The sign of a value x that may depend on symbols: an interval of −1, 0 and 1 that contains the sign of x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    low: i8,
    high: i8,
}

impl From<Relation> for Sign {
    fn from(relation: Relation) -> Self {
        match relation {
            Relation::Positive => Sign::POSITIVE,
            Relation::NonNegative => Sign::NON_NEGATIVE,
            Relation::Zero => Sign::ZERO,
        }
    }
}

impl Sign {
    /// x < 0
    pub const NEGATIVE: Self = Sign { low: -1, high: -1 };
    /// x ≤ 0
    pub const NON_POSITIVE: Self = Sign { low: -1, high: 0 };
    /// x = 0
    pub const ZERO: Self = Sign { low: 0, high: 0 };
    /// x ≥ 0
    pub const NON_NEGATIVE: Self = Sign { low: 0, high: 1 };
    /// x > 0
    pub const POSITIVE: Self = Sign { low: 1, high: 1 };
    /// x may be any number.
    pub const ANY: Self = Sign { low: -1, high: 1 };

    /// Returns `true` if the sign excludes zero.
    pub fn is_strict(self) -> bool {
        self.low * self.high > 0
    }

    /// Returns the sign of −x.
    pub fn negated(self) -> Self {
        Sign { low: -self.high, high: -self.low }
    }

    /// Returns the sign of x y.
    pub fn times(self, Sign { low, high }: Self) -> Self {
        let products = [self.low * low, self.low * high, self.high * low, self.high * high];
        Sign { low: products.into_iter().fold(1, i8::min), high: products.into_iter().fold(-1, i8::max) }
    }

    /// Returns the sign of xⁿ for n > 0.
    pub fn power(self, n: u8) -> Self {
        match self {
            _ if n % 2 == 1 => self,
            Sign::ANY => Sign::NON_NEGATIVE,
            _ => self.times(self),
        }
    }

    /// Returns the sign of x + y. Terms of both signs may have a sum of any sign; otherwise the stricter bound holds.
    pub fn plus(self, Sign { low, high }: Self) -> Self {
        let low = if self.low.min(low) < 0 { -1 } else { self.low.max(low) };
        let high = if self.high.max(high) > 0 { 1 } else { self.high.min(high) };
        Sign { low, high }
    }

    /// Returns `true` if every number with the sign `self` also has the sign `other`.
    pub fn implies(self, other: Self) -> bool {
        other.low <= self.low && self.high <= other.high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_of_sums_and_products_are_those_of_numbers() {
        // Each sign with the numbers −1, 0 and 1 that have it, which represent all numbers. The first ones imply the others.
        let signs: [(Sign, &[i32]); 6] = [
            (Sign::NEGATIVE, &[-1]),
            (Sign::ZERO, &[0]),
            (Sign::POSITIVE, &[1]),
            (Sign::NON_POSITIVE, &[-1, 0]),
            (Sign::NON_NEGATIVE, &[0, 1]),
            (Sign::ANY, &[-1, 0, 1]),
        ];
        let strongest = |values: Vec<i32>| {
            let mut all = signs.iter().filter(|(_, of)| values.iter().all(|x| of.contains(&x.signum())));
            all.next().unwrap().0
        };
        for ((s, of), (t, other)) in signs.iter().flat_map(|s| signs.iter().map(move |t| (s, t))) {
            let pairs: Vec<_> = of.iter().flat_map(|x| other.iter().map(move |y| (x, y))).collect();
            assert_eq!(s.times(*t), strongest(pairs.iter().map(|(x, y)| *x * *y).collect()), "{s:?} {t:?}");
            // Multiples, so that either sign can prevail.
            let sums = pairs.iter().flat_map(|(x, y)| [*x + *y, 2 * *x + *y, *x + 2 * *y]);
            assert_eq!(s.plus(*t), strongest(sums.collect()), "{s:?} {t:?}");
            assert_eq!(s.implies(*t), of.iter().all(|x| other.contains(x)), "{s:?} {t:?}");
        }
        assert!(signs.iter().all(|(s, of)| s.is_strict() != of.contains(&0)));
        for (n, (s, of)) in (1..=4).flat_map(|n| signs.iter().map(move |s| (n, s))) {
            assert_eq!(s.power(n), strongest(of.iter().map(|x| x.pow(n.into())).collect()), "{s:?} {n}");
        }
        assert!(signs.iter().all(|(s, _)| s.negated() == s.times(Sign::NEGATIVE)));
    }
}

//! Proofs as data, for programs that check them again.
//!
//! A polynomial is a list of terms, each of which is its coefficient as a text and the list of its variables
//! with their powers: 2 x₀ x₃² − 1 is `[["2", [[0, 1], [3, 2]]], ["-1", []]]`. Variables are the numbers of the
//! [atoms](GoalProof::atoms), and after these in a certificate those of its quantities. All else has the names of
//! the [checker](super::check).

use super::check::{MAX_VARIABLES, Node, Polynomial, Powers};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The proof of a goal, with what its numbers refer to.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GoalProof {
    /// The goal.
    pub goal: String,
    /// The hypotheses that may be used.
    pub hypotheses: Vec<String>,
    /// The variables of polynomials.
    pub atoms: Vec<String>,
    /// The proof.
    pub proof: Node,
}

/// A term as data.
type Term = (String, Vec<(usize, u8)>);

impl Serialize for Polynomial {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.terms().map(|(powers, number)| {
            let powers = powers.iter().copied().enumerate().filter(|(_, n)| *n > 0);
            (number.to_string(), powers.collect::<Vec<_>>())
        }))
    }
}

impl<'de> Deserialize<'de> for Polynomial {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        polynomial(&Vec::deserialize(from)?).map_err(D::Error::custom)
    }
}

/// Returns the polynomial with these terms, in any order.
///
/// # Errors
/// Returns what is wrong with a term: it must be an integer other than 0 of at most 127 bits, with powers of different
/// variables, and no other term may have the same powers.
fn polynomial(terms: &[Term]) -> Result<Polynomial, String> {
    let sum = Polynomial::new(terms.iter().map(parse_term).collect::<Result<_, _>>()?);
    let sum = sum.ok().filter(|sum| sum.terms().len() == terms.len());
    sum.ok_or_else(|| "two terms have the same powers".to_string())
}

fn parse_term((number, powers): &Term) -> Result<(Powers, i128), String> {
    let n = number.parse::<i128>().ok().filter(|n| *n != 0);
    let n =
        n.ok_or_else(|| format!("the coefficient {number} is not an integer between 1 and 2¹²⁷ in size"))?;
    let mut all = [0; MAX_VARIABLES];
    for (x, power) in powers {
        match all.get_mut(*x) {
            Some(known) if *known == 0 && *power > 0 => *known = *power,
            _ => return Err(format!("{power} is not the only power of one of {MAX_VARIABLES} variables")),
        }
    }
    Ok((all, n))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_read_in_any_order() {
        let mut powers = [0; MAX_VARIABLES];
        (powers[0], powers[3]) = (1, 2);
        let expected = Polynomial::new(vec![(powers, 2), ([0; MAX_VARIABLES], -1)]).unwrap();
        let powers = vec![(3, 2), (0, 1)];
        assert_eq!(polynomial(&[("2".into(), powers), ("-1".into(), vec![])]), Ok(expected));
        assert_eq!(polynomial(&[]), Ok(Polynomial::constant(0)));
    }

    #[test]
    fn wrong_terms_are_refused() {
        let one = |number: &str, powers: &[(usize, u8)]| vec![(number.to_string(), powers.to_vec())];
        for terms in [
            one("0", &[]),
            one("1.5", &[]),
            one(&"9".repeat(40), &[]),
            one("1", &[(MAX_VARIABLES, 1)]),
            one("1", &[(0, 0)]),
            one("1", &[(0, 1), (0, 1)]),
            [one("1", &[(0, 1)]), one("1", &[(0, 1)])].concat(),
            [one("1", &[(0, 1)]), one("-1", &[(0, 1)])].concat(),
        ] {
            assert!(polynomial(&terms).is_err(), "{terms:?}");
        }
    }
}

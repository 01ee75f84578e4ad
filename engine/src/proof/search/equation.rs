//! Equations in certificates: assumptions v = 0.

use super::algebra::{Monomial, Poly, Ratio};
use super::assumption::{AssumedFact, Assumption, AssumptionUse};
use super::context::solved;
use super::dictionary::{integral, poly};
use super::finder::{Finder, Result};
use crate::proof::check::{Atom, Certificate, Polynomial};

/// An equation v = 0, as a combination of quantities that are 0.
struct Equation {
    /// The monomial for which a derivation solves it.
    pivot: Monomial,
    /// v
    value: Poly,
    /// The combination.
    sum: Poly,
    /// The number of symbols, which are the first variables.
    symbols: usize,
}

/// The result of an elimination of a pivot: power · of = rest + multiple · v.
struct Eliminated {
    rest: Poly,
    power: Poly,
    multiple: Poly,
}

impl Equation {
    /// Returns the monomial for which it is solved: another symbol if the value contains it in place of the
    /// pivot.
    fn pivot(&self) -> &Monomial {
        if self.value.contains(&self.pivot) {
            return &self.pivot;
        }
        let mut monomials = self.value.terms().map(|(m, _)| m);
        monomials.find(|m| m.as_variable().is_some_and(|x| x < self.symbols)).unwrap_or(&self.pivot)
    }

    fn eliminate(&self, of: &Poly) -> Option<Eliminated> {
        let (coefficient, by) = solved(self.pivot(), &self.value)?;
        let replaced = Ratio::from(of.clone()).replace(self.pivot(), &by);
        self.eliminated(of, replaced.den().clone(), replaced.num().clone()).or_else(|| {
            // A factor of the coefficient was cancelled in the value of the pivot.
            let degree = of.degree(self.pivot().as_variable()?);
            let power = (0..degree).fold(Poly::constant(1), |power, _| power * &coefficient);
            let rest = replaced * Ratio::from(power.clone());
            rest.den().is_one().then(|| self.eliminated(of, power, rest.num().clone()))?
        })
    }

    /// Returns the result with this power and rest, if the multiple is a polynomial.
    fn eliminated(&self, of: &Poly, power: Poly, rest: Poly) -> Option<Eliminated> {
        let multiple = (of * &power - &rest).checked_div(&self.value)?;
        Some(Eliminated { rest, power, multiple })
    }
}

impl Finder<'_, '_> {
    /// Returns a certificate with l f = r, for forms l and r whose difference vanishes, maybe by equations.
    pub fn equated(&mut self, of: &Polynomial, form: Ratio) -> Result<Certificate> {
        let state = &self.proof.state;
        let factor = Poly::from(form.den().common_monomial().common(&form.num().common_monomial()));
        let [left, right] = [form.den(), form.num()].map(|of| of.checked_div(&factor).unwrap_or(of.clone()));
        let [mut left, mut right] = integral([&left, &right]);
        let found = self.finished(&left, &right)?;
        let [one, other] = state.sides(of, &found)?;
        let difference = one.plus_multiple(-1, &other, &state.facts.effort)?;
        if difference.is_zero() {
            return Ok(found);
        }
        let sum = self.vanishing(poly(&difference), &mut left, &mut right)?;
        let [left, right] = integral([&left, &(right + sum)]);
        self.finished(&left, &right)
    }

    /// Returns the equations among the assumptions.
    fn equations(&mut self) -> Result<Vec<Equation>> {
        let guide = self.guide;
        let atoms = self.proof.state.sequent.table.atoms.iter();
        let symbols = atoms.filter(|atom| matches!(atom, Atom::Own(_))).count();
        let mut equations = Vec::new();
        for Assumption { usage, fact, .. } in &guide.assumptions {
            if let AssumptionUse::Equation(pivot) | AssumptionUse::Size { pivot, .. } = usage
                && let Some(AssumedFact { fact, .. }) = fact
            {
                let value = poly(&self.proof.state.facts.get(*fact)?.0);
                let (pivot, sum) = (pivot.clone(), self.variable(*fact));
                equations.push(Equation { pivot, value, sum, symbols });
            }
        }
        Ok(equations)
    }

    /// Returns a combination of quantities that are 0 which is `difference`. Multiplies the forms by what the
    /// difference has to be multiplied by.
    fn vanishing(&mut self, mut difference: Poly, left: &mut Poly, right: &mut Poly) -> Result<Poly> {
        let mut equations = self.equations()?;
        let mut found = Poly::zero();
        while !equations.is_empty() {
            let equation = equations.remove(0);
            let Some(Eliminated { rest, power, multiple }) = equation.eliminate(&difference) else {
                continue;
            };
            let form = self.form_of_power(&power)?;
            let (by, scale) = (form.num(), form.den());
            *left = &*left * by;
            *right = &*right * by;
            difference = rest * scale;
            found = found * by + &equation.sum * multiple * scale;
            for other in equations.iter_mut().filter(|other| other.value.contains(equation.pivot())) {
                let Some(Eliminated { rest, power, multiple }) = equation.eliminate(&other.value) else {
                    continue;
                };
                other.value = rest;
                other.sum = &other.sum * power - &equation.sum * multiple;
            }
        }
        if difference.is_zero() { Ok(found) } else { Err("an identity".into()) }
    }

    /// Returns a power of a coefficient as a quotient of forms.
    fn form_of_power(&mut self, power: &Poly) -> Result<Ratio> {
        let signed =
            self.guide.sign(self.guide.reduce(&power.clone().into())).ok_or("the sign of a power")?;
        let form = self.form(&signed, &[])?;
        self.without_slacks(form)
    }
}

//! Equations in certificates: hypotheses v = 0, and products of exponentials.

use super::dictionary::{opaque_exponential, power_of, quantity};
use super::finder::{Finder, Found, Quantity};
use crate::proof::check::{Certificate, Known, Polynomial};
use crate::proof::kernel::algebra::{Monomial, Poly, Ratio};
use crate::proof::kernel::derivation::AssumptionUse;

/// An equation v = 0, as a combination of quantities that are 0.
struct Equation {
    /// The monomial for which it is solved.
    pivot: Monomial,
    /// v
    value: Poly,
    /// The quantities, each with its coefficient.
    sum: Vec<(Poly, Poly)>,
}

/// The result of an elimination of a pivot: power · of = rest + multiple · v.
struct Eliminated {
    rest: Poly,
    power: Poly,
    multiple: Poly,
}

impl Equation {
    /// Returns the coefficient of the pivot, and the rest of the equation.
    fn solved(&self) -> Option<(Poly, Poly)> {
        if let Some(x) = self.pivot.as_symbol() {
            let [rest, coefficient] = self.value.coefficients(x)?;
            return Some((coefficient, rest));
        }
        let (_, number) = self.value.terms().find(|(monomial, _)| **monomial == self.pivot)?;
        let leading = Poly::from_iter([(self.pivot.clone(), number.clone())]);
        Some((Poly::constant(number.clone()), &self.value - leading))
    }

    fn eliminate(&self, of: &Poly) -> Option<Eliminated> {
        let (coefficient, rest) = self.solved()?;
        let by = Ratio::from(-rest).over(&coefficient.clone().into())?;
        let replaced = Ratio::from(of.clone()).replace(&self.pivot, &by);
        let by_power = |power: Poly, rest: Poly| {
            let multiple = (of * &power - &rest).over(&self.value)?;
            Some(Eliminated { rest, power, multiple })
        };
        by_power(replaced.den().clone(), replaced.num().clone()).or_else(|| {
            // A factor of the coefficient was cancelled in the value of the pivot.
            let degree = of.degree(self.pivot.as_symbol()?);
            let power = (0..degree).fold(Poly::constant(1), |power, _| power * &coefficient);
            let rest = replaced * Ratio::from(power.clone());
            rest.den().is_one().then(|| by_power(power, rest.num().clone()))?
        })
    }
}

impl Finder<'_, '_> {
    /// Returns a certificate with l f = r, for forms l and r whose difference vanishes by equations.
    pub fn equated(
        &mut self,
        of: &Polynomial,
        value: &Poly,
        mut left: Poly,
        mut right: Poly,
    ) -> Found<Certificate> {
        let is_opaque = !self.state.exponents.is_empty();
        let mut value = value.clone();
        if is_opaque {
            value = self.guide.dictionary.opaque_poly(of);
            left = self.opaque(&left).ok_or("an exponential")?;
            right = self.opaque(&right).ok_or("an exponential")?;
            self.hide_facts();
        }
        let difference = self.expanded(&left) * Ratio::from(value) - self.expanded(&right);
        if !difference.is_zero() {
            let sum = self.vanishing(difference.num().clone(), &mut left, &mut right)?;
            right = sum.into_iter().fold(right, |right, (symbol, factor)| right + factor * symbol);
        }
        self.finished(&left, &right)
    }

    /// Replaces quantities by their values.
    fn expanded(&self, form: &Poly) -> Ratio {
        let quantities = self.quantities.iter().enumerate();
        quantities.fold(form.clone().into(), |form: Ratio, (i, Quantity { value, .. })| {
            form.replace(&Monomial::of(quantity(i)), &value.clone().into())
        })
    }

    /// Replaces each exponential by a symbol.
    fn opaque(&self, form: &Poly) -> Option<Poly> {
        form.terms().try_fold(Poly::zero(), |sum, (monomial, number)| {
            let term = Poly::from_iter([(monomial.without_exponential(), number.clone())]);
            let Some(exponent) = monomial.exponent() else { return Some(sum + term) };
            let (x, n) = self.exponential(exponent)?;
            let power = Poly::symbol(opaque_exponential(x));
            Some(sum + (0..n).fold(term, |term, _| term * &power))
        })
    }

    /// Returns the variable of an exponential, and its power.
    fn exponential(&self, exponent: &Ratio) -> Option<(usize, u8)> {
        let Finder { guide, state, .. } = self;
        let reduced =
            |(x, known): &(usize, _)| (*x, guide.context.reduce(&guide.dictionary.ratio(known, state)));
        guide
            .dictionary
            .exponential(exponent, state)
            .or_else(|| power_of(exponent, &state.exponents.iter().map(reduced).collect::<Vec<_>>()))
    }

    fn hide_facts(&mut self) {
        for quantity in &mut self.quantities {
            if let Known::Fact(i) = quantity.known
                && let Ok((of, _)) = self.state.facts.get(i)
            {
                quantity.value = self.guide.dictionary.opaque_poly(of);
            }
        }
    }

    /// Returns the equations among the hypotheses and exponentials.
    fn equations(&mut self) -> Found<Vec<Equation>> {
        let (guide, is_opaque) = (self.guide, !self.state.exponents.is_empty());
        let mut equations = Vec::new();
        for (i, assumption) in guide.context.assumptions().iter().enumerate() {
            let (pivot, fact) = match &assumption.usage {
                AssumptionUse::Pivot(pivot, _, None) => {
                    (pivot, guide.fact(i, self.state).ok_or("an equation")?)
                }
                AssumptionUse::Size { pivot, size, .. } => match guide.size_atom(*size, self.state) {
                    Some(known) => (pivot, known.fact),
                    None => continue,
                },
                _ => continue,
            };
            let (of, _) = self.state.facts.get(fact).map_err(|_| "an equation")?;
            let value = if is_opaque {
                guide.dictionary.opaque_poly(of)
            } else {
                guide.dictionary.poly(of, self.state)
            };
            let symbol = self.quantity(Known::Fact(fact), &value);
            equations.push(Equation { pivot: pivot.clone(), value, sum: vec![(symbol, Poly::constant(1))] });
        }
        if is_opaque {
            self.add_products_of_exponentials(&mut equations);
        }
        Ok(equations)
    }

    /// Adds eᵃ eᵇ = eᶜ for a + b = c, where eᶜ may be 1.
    fn add_products_of_exponentials(&mut self, equations: &mut Vec<Equation>) {
        let state = self.state;
        let ratio = |(x, exponent): &(usize, _)| (*x, self.guide.dictionary.ratio(exponent, state));
        let exponents: Vec<(usize, Ratio)> = state.exponents.iter().map(ratio).collect();
        for (i, (x, a)) in exponents.iter().enumerate() {
            for (y, b) in &exponents[i..] {
                let sum = a + b;
                let whole = exponents.iter().find(|(_, c)| (c - &sum).is_zero()).map(|(z, _)| *z);
                if whole.is_none() && !sum.is_zero() {
                    continue;
                }
                let known = Known::Exponents { left: vec![*x, *y], right: whole.into_iter().collect() };
                let power = |x: usize| Poly::symbol(opaque_exponential(x));
                let product = power(*x) * power(*y);
                let Some((pivot, _)) = product.terms().next() else { continue };
                let pivot = pivot.clone();
                let value = product - whole.map_or(Poly::constant(1), power);
                let symbol = self.quantity(known, &value);
                equations.push(Equation { pivot, value, sum: vec![(symbol, Poly::constant(1))] });
            }
        }
    }

    /// Returns a combination of quantities that are 0 which is `difference`. Multiplies the forms by what the
    /// difference has to be multiplied by.
    fn vanishing(
        &mut self,
        mut difference: Poly,
        left: &mut Poly,
        right: &mut Poly,
    ) -> Found<Vec<(Poly, Poly)>> {
        let mut equations = self.equations()?;
        let mut found: Vec<(Poly, Poly)> = Vec::new();
        while !equations.is_empty() && !difference.is_zero() {
            let equation = equations.remove(0);
            let Some(Eliminated { rest, power, multiple }) = equation.eliminate(&difference) else {
                continue;
            };
            let (mut scale, mut by) = (Poly::constant(1), Poly::constant(1));
            if !power.is_one() {
                let form = self.form_of_power(&power)?;
                (scale, by) = (form.den().clone(), form.num().clone());
            }
            // power = by/scale.
            *left = &*left * &by;
            *right = &*right * &by;
            difference = rest * &scale;
            for (_, factor) in &mut found {
                *factor = &*factor * &by;
            }
            found.extend(equation.sum.iter().map(|(symbol, c)| (symbol.clone(), c * &multiple * &scale)));
            for other in equations.iter_mut().filter(|other| other.value.contains(&equation.pivot)) {
                let Some(Eliminated { rest, power, multiple }) = equation.eliminate(&other.value) else {
                    continue;
                };
                other.value = rest;
                for (_, factor) in &mut other.sum {
                    *factor = &*factor * &power;
                }
                other.sum.extend(equation.sum.iter().map(|(symbol, c)| (symbol.clone(), -(c * &multiple))));
            }
        }
        if difference.is_zero() { Ok(found) } else { Err("an identity".into()) }
    }

    /// Returns a power of a coefficient as a quotient of forms.
    fn form_of_power(&mut self, power: &Poly) -> Found<Ratio> {
        let (rest, product) = self.without_largest_errors(power)?;
        let (context, reduced) = (self.guide.context, self.guide.reduced(&rest));
        let signed = context.sign_by_retained(reduced, &[]).ok_or("the sign of a power")?;
        let form = self.form(&signed)?;
        Ok(self.without_slacks(form)? * Ratio::from(product))
    }
}

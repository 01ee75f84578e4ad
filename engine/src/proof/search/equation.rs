//! Equations in certificates: hypotheses v = 0, and products of exponentials.

use super::algebra::{Monomial, Poly, Ratio, Symbol};
use super::assumption::AssumptionUse;
use super::dictionary::{integral, opaque_exponential, power_of};
use super::finder::{Finder, Found};
use crate::proof::check::{Certificate, Known, Polynomial};

/// An equation v = 0, as a combination of quantities that are 0.
struct Equation {
    /// The monomial for which a derivation solves it.
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
    /// Returns the monomial for which it is solved: another symbol if the value contains it in place of the
    /// pivot.
    fn pivot(&self) -> &Monomial {
        let is_simple = |m: &&Monomial| m.as_symbol().is_some_and(|x| matches!(x, Symbol::Own(_)));
        let other = || self.value.terms().map(|(m, _)| m).find(is_simple);
        if self.value.contains(&self.pivot) { &self.pivot } else { other().unwrap_or(&self.pivot) }
    }

    /// Returns the coefficient of the pivot, and the rest of the equation.
    fn solved(&self) -> Option<(Poly, Poly)> {
        let pivot = self.pivot();
        if let Some(x) = pivot.as_symbol() {
            let [rest, coefficient] = self.value.coefficients(x)?;
            return Some((coefficient, rest));
        }
        let (_, number) = self.value.terms().find(|(monomial, _)| *monomial == pivot)?;
        let leading = Poly::from_iter([(pivot.clone(), number.clone())]);
        Some((Poly::constant(number.clone()), &self.value - leading))
    }

    fn eliminate(&self, of: &Poly) -> Option<Eliminated> {
        let (coefficient, rest) = self.solved()?;
        if let Some(x) = self.pivot().as_symbol()
            && let Some((_, number)) = coefficient.terms().next()
            && Ratio::from(coefficient.clone()).is_number()
            && !of.has_exponentials()
        {
            return Some(divided(of, x, &Poly::constant(number.recip()), &rest));
        }
        let by = Ratio::from(-rest).over(&coefficient.clone().into())?;
        let replaced = Ratio::from(of.clone()).replace(self.pivot(), &by);
        let by_power = |power: Poly, rest: Poly| {
            let multiple = (of * &power - &rest).over(&self.value)?;
            Some(Eliminated { rest, power, multiple })
        };
        by_power(replaced.den().clone(), replaced.num().clone()).or_else(|| {
            // A factor of the coefficient was cancelled in the value of the pivot.
            let degree = of.degree(self.pivot().as_symbol()?);
            let power = (0..degree).fold(Poly::constant(1), |power, _| power * &coefficient);
            let rest = replaced * Ratio::from(power.clone());
            rest.den().is_one().then(|| by_power(power, rest.num().clone()))?
        })
    }
}

/// Divides two forms by the product of powers that divides both.
fn without_common_factor(left: Poly, right: Poly) -> (Poly, Poly) {
    let (common, other) = (left.common_monomial(), right.common_monomial());
    let powers = common.powers().map(|(x, n)| (x, n.min(other.degree(x))));
    let factors = powers.flat_map(|(x, n)| std::iter::repeat_n(Poly::symbol(x), n as usize));
    let factor = factors.fold(Poly::constant(1), |product, x| product * x);
    match (left.over(&factor), right.over(&factor)) {
        (Some(left), Some(right)) if !right.is_zero() => (left, right),
        _ => (left, right),
    }
}

/// Divides a polynomial by a x + b for a number a, by the powers of x as in Horner's scheme.
fn divided(of: &Poly, x: Symbol, inverse: &Poly, rest: &Poly) -> Eliminated {
    let root = -(rest * inverse);
    let (mut sum, mut multiple) = (Poly::zero(), Poly::zero());
    for n in (0..=of.degree(x)).rev() {
        multiple = multiple * Poly::symbol(x) + &sum;
        sum = sum * &root + of.coefficient(x, n);
    }
    Eliminated { rest: sum, power: Poly::constant(1), multiple: multiple * inverse }
}

impl Finder<'_, '_> {
    /// Returns a certificate with l f = r, for forms l and r whose difference vanishes, maybe by equations.
    pub fn equated(&mut self, of: &Polynomial, form: Ratio) -> Found<Certificate> {
        let left = self.opaque(form.den()).ok_or("an exponential")?;
        let right = self.opaque(form.num()).ok_or("an exponential")?;
        let (left, right) = without_common_factor(left, right);
        let (mut left, mut right) = integral(&left, &right);
        let found = self.finished(&left, &right);
        if !self.guide.has_equations() && self.state.exponents.is_empty() {
            return found;
        }
        let found = found?;
        let difference = self.state.difference(of, &found)?;
        if difference.is_zero() {
            return Ok(found);
        }
        let difference = self.guide.dictionary.opaque_poly(&difference);
        let sum = self.vanishing(difference, &mut left, &mut right)?;
        right = sum.into_iter().fold(right, |right, (symbol, factor)| right + factor * symbol);
        let (left, right) = integral(&left, &right);
        self.finished(&left, &right)
    }

    /// Replaces each exponential by a symbol.
    pub fn opaque(&self, form: &Poly) -> Option<Poly> {
        if !form.has_exponentials() {
            return Some(form.clone());
        }
        let mut terms = Vec::with_capacity(form.terms().len());
        for (monomial, number) in form.terms() {
            let mut rest = monomial.without_exponential();
            if let Some(exponent) = monomial.exponent() {
                let (x, n) = self.exponential(exponent)?;
                rest = (0..n).fold(rest, |rest, _| rest.times(&Monomial::of(opaque_exponential(x))));
            }
            terms.push((rest, number.clone()));
        }
        Some(terms.into_iter().collect())
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

    /// Returns the equations among the hypotheses and exponentials.
    fn equations(&mut self) -> Found<Vec<Equation>> {
        let guide = self.guide;
        let mut equations = Vec::new();
        for (i, assumption) in guide.context.assumptions().iter().enumerate() {
            let (pivot, fact) = match &assumption.usage {
                AssumptionUse::Pivot(pivot, _, None) => {
                    let supposed = guide.supposed.get(i).and_then(Option::as_ref);
                    (pivot, supposed.ok_or("an equation")?.fact)
                }
                AssumptionUse::Size { pivot, size, .. } => match guide.size_atom(*size, self.state) {
                    Some(known) => (pivot, known.fact),
                    None => continue,
                },
                _ => continue,
            };
            let (of, _) = self.state.facts.get(fact).map_err(|_| "an equation")?;
            let value = guide.dictionary.opaque_poly(of);
            let symbol = self.quantity(Known::Fact(fact));
            equations.push(Equation { pivot: pivot.clone(), value, sum: vec![(symbol, Poly::constant(1))] });
        }
        self.add_products_of_exponentials(&mut equations);
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
                let symbol = self.quantity(known);
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
            for other in equations.iter_mut().filter(|other| other.value.contains(equation.pivot())) {
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
        let guide = self.guide;
        let reduced = guide.context.reduce(&guide.dictionary.with_places(&rest.into()));
        let signed = guide.context.sign_by_retained(reduced, &[]).ok_or("the sign of a power")?;
        let form = self.form(&signed, &[])?;
        Ok(self.without_slacks(form)? * Ratio::from(product))
    }
}

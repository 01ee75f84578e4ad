//! The chapter as data: what every number states, where its function is and what it follows from.

use super::formulas::fill;
use crate::number::tree::Notation;

/// One number of the chapter: an equation, the theorem, a remark, a figure, a loose spot (note), or
/// something beyond it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// "1.13", "Theorem 1.3.3", "Remark 1.3.2", "Fig. 1.1", "note 4" or "beyond 2".
    pub equation: &'static str,
    /// Its name.
    pub title: &'static str,
    /// The section it stands in.
    pub section: &'static str,
    statement: &'static str,
    latex: &'static str,
    /// Under which conditions.
    pub hypotheses: &'static [&'static str],
    /// The functions in [`chapter`](crate::chapter) that are its formulas, as `module::name`; its own first.
    pub functions: &'static [&'static str],
    /// The entries it is derived from.
    pub follows_from: &'static [&'static str],
}

impl Entry {
    /// What it states.
    ///
    /// ```
    /// use spring_mass_contact::claims::entry;
    /// assert_eq!(entry("1.12").unwrap().statement(), "N = ε p, which is ε R / (c + ε) at (1.13)");
    /// ```
    pub fn statement(&self) -> String {
        fill(self.statement, Notation::Text)
    }

    /// The equation in LaTeX, if it is one of the chapter's numbered ones.
    ///
    /// ```
    /// use spring_mass_contact::claims::entry;
    /// assert_eq!(entry("1.24").unwrap().latex().unwrap(), r"u = u_h + u_{\mathrm{nh}}");
    /// ```
    pub fn latex(&self) -> Option<String> {
        (!self.latex.is_empty()).then(|| fill(self.latex, Notation::Latex))
    }

    /// As it is written in a text: `(1.13)`, and what has a name by its name.
    pub fn label(&self) -> String {
        let numbered = self.equation.starts_with(|c: char| c.is_ascii_digit());
        if numbered { format!("({})", self.equation) } else { self.equation.to_string() }
    }
}

/// The entry of a number.
pub fn entry(equation: &str) -> Option<&'static Entry> {
    place(equation).map(|place| &entries()[place])
}

/// Where a number stands among the entries: what is sorted by it is in the chapter's order.
pub fn place(equation: &str) -> Option<usize> {
    entries().iter().position(|entry| entry.equation == equation)
}

/// All entries, in the chapter's order.
pub fn entries() -> &'static [Entry] {
    ENTRIES
}

macro_rules! entries {
    ($($equation:literal, $title:literal, $section:literal, $statement:literal, [$($hypothesis:literal),*],
       [$($function:literal),*], [$($from:literal),*] $(, $latex:literal)?;)*) => {
        &[$(Entry {
            equation: $equation, title: $title, section: $section, statement: $statement,
            latex: concat!($($latex)?), hypotheses: &[$($hypothesis),*],
            functions: &[$($function),*], follows_from: &[$($from),*],
        }),*]
    };
}

/// Statements, and the LaTeX on the lines below them, have holes for formulas, as [`fill`] describes them.
/// Outside the holes stand words, relations and the names of quantities, and what no function computes.
#[rustfmt::skip]
const ENTRIES: &[Entry] = entries! {
    "Fig. 1.1", "The system", "1", "A mass hangs on a spring over a rigid plane.", [], ["system::SpringMass"], [];
    "1.1", "Equilibrium of forces", "1.1", "«structure::residual» = 0", ["c > 0"], ["structure::residual", "structure::deflection"], ["Fig. 1.1"],
        r"«structure::residual» = 0";
    "1.2", "Virtual work", "1.1", "«structure::virtual_work» = 0 for every δu", [], ["structure::virtual_work"], ["1.1"],
        r"«structure::virtual_work» = 0 \quad\text{for every } \delta u";
    "1.3", "Variation of the energy", "1.1", "δΠ = «structure::virtual_work» = 0", [], ["structure::first_variation"], ["1.2", "1.4"],
        r"\delta\Pi = \delta\left(«structure::potential_energy»\right) = 0";
    "1.4", "Potential energy", "1.1", "Π(u) = «structure::potential_energy» is least at u = «structure::deflection» and only there", ["c > 0"], ["structure::potential_energy"], ["1.1"],
        r"\Pi(u) = «structure::potential_energy» \;\to\; \min";
    "1.5", "Penetration", "1.2", "p(u) = «contact::penetration» ≤ 0", [], ["contact::penetration"], ["Fig. 1.1"],
        r"p(u) = «contact::penetration» \le 0";
    "1.6", "Karush-Kuhn-Tucker conditions", "1.2", "p ≤ 0, N ≥ 0, «contact::kkt.complementarity» = 0 and «contact::equilibrium» = 0 have exactly one solution", ["c > 0"], ["contact::kkt", "contact::equilibrium"], ["1.4", "1.5"],
        r"\begin{array}{lll} \text{contact:} & p = 0 & N > 0 \\ \text{no contact:} & p < 0 & N = 0 \\ \text{always:} & «contact::kkt.complementarity» = 0 & \end{array}";
    "1.7", "Lagrange functional", "1.3.1", "𝓛(u, λ) = «lagrange::functional» is stationary at its only saddle point", [], ["lagrange::functional"], ["1.4", "1.5"],
        r"\mathcal{L}(u, \lambda) = «lagrange::functional»";
    "1.8", "Lagrange system", "1.3.1", "«lagrange::residual.equilibrium» = 0 and «contact::penetration» = 0 have the only solution u = «lagrange::deflection», λ = «lagrange::multiplier»", [], ["lagrange::residual", "lagrange::deflection", "lagrange::multiplier"], ["1.7"],
        r"\left\{\begin{aligned} «lagrange::residual.equilibrium» &= 0 \\ «contact::penetration» &= 0 \end{aligned}\right.";
    "Remark 1.3.1", "Exact at the price of an unknown", "1.3.1", "p = 0 exactly", [], ["lagrange::deflection"], ["1.8"];
    "1.9", "Penalised energy", "1.3.2", "Π_p(u) = «penalty::energy»", ["c > 0", "ε > 0"], ["penalty::energy", "penalty::functional"], ["1.4", "1.5"],
        r"\Pi_p(u) = «penalty::energy»";
    "1.10", "Penalty functional with many terms", "1.3.2", "W = «penalty::series» fulfils the conditions on a penalty functional", ["ε > 0", "ε₄ ≥ 0"], ["penalty::series", "penalty::series_force"], ["1.9"],
        r"W_\varepsilon(p) = «penalty::series»";
    "1.11", "Equilibrium by penalty", "1.3.2", "«penalty::residual» = 0", [], ["penalty::residual"], ["1.9"],
        r"\frac{\partial\Pi_p}{\partial u} = «penalty::residual» = 0";
    "1.12", "Contact force by penalty", "1.3.2", "N = «penalty::contact_force», which is «penalty::force_at_root» at (1.13)", ["c > 0", "ε > 0"], ["penalty::contact_force"], ["1.11"],
        r"N = «penalty::contact_force» = «penalty::contact_force in full»";
    "Fig. 1.2", "The penalty as a second spring", "1.3.2", "Two springs of stiffness c and ε act side by side.", [], ["penalty::total_stiffness"], ["1.12"];
    "1.13", "Deflection by penalty and its limit", "1.3.2", "u = «penalty::deflection» tends to «system::gap» as ε → ∞, with p = «penalty::penetration»", ["c > 0", "ε > 0"], ["penalty::deflection", "penalty::deflection_divided"], ["1.11"],
        r"\lim_{\varepsilon\to\infty} u = \lim_{\varepsilon\to\infty} «penalty::deflection» = \lim_{\varepsilon\to\infty} «penalty::deflection_divided» = «system::gap»";
    "Remark 1.3.2", "Which penalty is enough", "1.3.2", "p ≤ tol if and only if ε ≥ «penalty::penalty_for»", ["c > 0", "ε > 0", "R > 0", "tol > 0"], ["penalty::penalty_for"], ["1.13"];
    "1.14", "Augmented functional", "1.3.3", "L(u) = «augmented::functional»", ["c > 0", "ε > 0"], ["augmented::functional"], ["1.7", "1.9"],
        r"L(u) = «augmented::functional»";
    "1.15", "Stationarity", "1.3.3", "∂L/∂u = «augmented::stationarity» = 0", [], ["augmented::stationarity"], ["1.14"],
        r"\frac{\partial L}{\partial u} = «augmented::stationarity» = 0";
    "1.16", "Augmentation", "1.3.3", "λ_k = «augmented::update: λ=λ_{k−1}, u=u_{k−1}» and «augmented::equilibrium: λ=λ_k, u=u_k» = 0; in closed form λ_k = «augmented::multiplier_after»", ["c > 0", "ε > 0"], ["augmented::update", "augmented::equilibrium", "augmented::deflection"], ["1.15"],
        r"\left\{\begin{aligned} &\lambda_k = «augmented::update: u=u_{k-1}, λ=λ_{k-1}» \\ &«augmented::equilibrium: u=u_k, λ=λ_k» = 0 \end{aligned}\right. \qquad k = 1, 2, 3, \dots";
    "Theorem 1.3.3", "Convergence of the augmentation", "1.3.3", "p(u_k) shrinks by the factor ρ = «augmented::contraction» in each step for every ε > 0: |p(u_k)| falls strictly unless λ₀ = R", ["c > 0", "ε > 0"], ["augmented::contraction"], ["1.16"];
    "1.17", "The limit of the theorem", "1.3.3", "lim p(u_k) = 0, and |p_k| ≤ r |p₀| with r = «augmented::harmonic_bound»", ["c > 0", "ε > 0"], ["augmented::harmonic_bound", "augmented::contraction", "augmented::penetration_after"], ["Theorem 1.3.3"],
        r"\lim_{k\to\infty} p(u_k) = 0";
    "1.18", "Update of the multiplier", "1.3.3", "λ_{k+1} = «augmented::update: λ=λ_k, u=u_k» = «augmented::contact_force: u=u_k»", ["(1.19)"], ["augmented::update"], ["1.16"],
        r"\lambda_{k+1} = «augmented::update: u=u_k, λ=λ_k»";
    "1.19", "Equilibrium at step k", "1.3.3", "«augmented::equilibrium: λ=λ_k, u=u_k» = 0", ["c > 0", "ε > 0"], ["augmented::equilibrium"], ["1.16"],
        r"«augmented::equilibrium: u=u_k, λ=λ_k» = 0";
    "1.20", "Equilibrium at step k + 1", "1.3.3", "«augmented::equilibrium: λ=λ_{k+1}, u=u_{k+1}» = 0", ["c > 0", "ε > 0"], ["augmented::equilibrium"], ["1.16", "1.18"],
        r"«augmented::equilibrium: u=u_{k+1}, λ=λ_{k+1}» = 0";
    "1.21", "Recursion in the deflection", "1.3.3", "«augmented::recursion.left» = «augmented::recursion.right»", ["(1.19)", "(1.20)"], ["augmented::recursion"], ["1.18", "1.19", "1.20"],
        r"«augmented::recursion.left» = «augmented::recursion.right»";
    "1.22", "Recursion in time", "1.3.3", "«ode::difference_equation.left» = «ode::difference_equation.right»", ["c > 0", "ε > 0"], ["ode::difference_equation"], ["1.21"],
        r"«ode::difference_equation.left» = «ode::difference_equation.right»";
    "1.23", "Differential equation", "1.3.3", "«ode::operator: v=u̇» = «ode::right_side», of which one explicit Euler step of size 1 is (1.21)", ["c > 0", "ε > 0"], ["ode::velocity", "ode::right_side"], ["1.22"],
        r"«ode::operator: v=u̇» = «ode::right_side», \quad u(0) = u_0";
    "1.24", "Superposition", "1.3.3", "u = «ode::superposition»", [], ["ode::superposition"], ["1.23"],
        r"u = «ode::superposition»";
    "1.25", "Homogeneous equation", "1.3.3", "«ode::operator: v=u̇» = 0", ["c > 0", "ε > 0"], ["ode::operator"], ["1.23"],
        r"«ode::operator: v=u̇» = 0";
    "1.26", "Characteristic rate", "1.3.3", "«ode::characteristic» = 0 at rate = «ode::rate»", ["c > 0", "ε > 0"], ["ode::characteristic", "ode::rate"], ["1.25"],
        r"«ode::characteristic: rate=s» = 0 \quad\Rightarrow\quad s = «ode::rate»";
    "1.27", "Homogeneous solution", "1.3.3", "u_h = «ode::homogeneous»", ["c > 0", "ε > 0"], ["ode::homogeneous"], ["1.26"],
        r"u_h = «ode::homogeneous»";
    "1.28", "Particular solution", "1.3.3", "u_nh = «ode::particular»", [], ["ode::particular"], ["1.23"],
        r"u_{\mathrm{nh}} = «ode::particular»";
    "1.29", "General solution", "1.3.3", "u = «ode::general»", ["c > 0", "ε > 0"], ["ode::general"], ["1.24", "1.27", "1.28"],
        r"u = «ode::general»";
    "1.30", "Solution of the initial-value problem", "1.3.3", "u = «ode::solution»", ["c > 0", "ε > 0"], ["ode::solution", "ode::constant"], ["1.29"],
        r"u = «ode::solution»";
    "1.31", "Limit of the deflection", "1.3.3", "lim u = «ode::particular» as t → ∞", ["c > 0", "ε > 0"], ["ode::solution"], ["1.30"],
        r"\lim_{t\to\infty} u = «ode::particular» \qquad\text{for } c, \varepsilon > 0";
    "1.32", "Limit of the penetration", "1.3.3", "lim p(u) = 0 as t → ∞", ["c > 0", "ε > 0"], ["contact::penetration"], ["1.31"],
        r"\lim_{t\to\infty} p(u(t)) = 0";
    "1.33", "When to stop", "1.3.3", "|p_k| < tol, first at k = 0 if |p₀| < tol, else at k = ⌊ln(|p₀|/tol)/ln(1 + ε/c)⌋ + 1", ["c > 0", "ε > 0", "tol > 0"], ["augmented::within_tolerance"], ["1.16"],
        r"\lvert p_k \rvert = \lvert «contact::penetration: u=u_k» \rvert < \mathrm{tol}";
    "Remark 1.3.6", "The force at step k", "1.3.3", "λ_{k+1} − λ_k = «penalty::contact_force: u=u_k»: the force named in the remark lags one step behind", [], ["augmented::contact_force"], ["1.18"];
    "note 1", "Grazing", "notes", "p = 0 with N = 0 is a third state", ["c > 0", "R = 0"], ["contact::deflection"], ["1.6"];
    "note 2", "A saddle point", "notes", "(1.7) is least in u and constant in λ at (Δ, R)", ["c > 0"], ["lagrange::functional"], ["1.7", "1.8"];
    "note 3", "What a penalty functional needs", "notes", "W_ε(p_ε) ≤ R²/(2c)", ["c > 0", "ε > 0"], ["penalty::functional"], ["1.10"];
    "note 4", "A plane that never pulls", "notes", "λ_k = «augmented::unilateral_update: λ=λ_{k−1}, u=u_{k−1}» and «augmented::unilateral_equilibrium: λ=λ_k, u=u_k» = 0", ["c > 0", "ε > 0"], ["augmented::unilateral_deflection", "augmented::unilateral_update", "augmented::unilateral_equilibrium", "augmented::unilateral_functional", "augmented::natural_residual"], ["1.6", "1.16"];
    "note 5", "An analogy and no proof", "notes", "e^{−ε/c} < ρ < e^{−ε/(c+ε)} for ε > 0, and p_k → 0 also for ε < −2c", ["c > 0"], ["augmented::contraction"], ["1.16", "1.30"];
    "note 6", "Which force", "notes", "«augmented::contact_force: u=u_k» = «augmented::update: λ=λ_k, u=u_k»", ["(1.19)"], ["augmented::contact_force"], ["1.18", "1.19"];
    "note 8", "Not in every precision", "notes", "Rounding stops the augmentation at a floor of about η (|H| + R/ε)", ["c > 0", "ε > 0", "R > 0"], [], ["1.16"];
    "note 9", "The effort depends on ε", "notes", "(c/ε) Λ < Λ/ln(1 + ε/c) < (c/ε + ½) Λ for Λ = ln(|p₀|/tol) > 0", ["c > 0", "ε > 0"], [], ["1.33"];
    "beyond 1", "Moreau's decomposition", "beyond", "c p + N = R splits R into its positive part N and its negative part −c p", ["c > 0"], ["contact::contact_force"], ["1.6"];
    "beyond 2", "Augmentations as one penalty", "beyond", "k augmentations from λ₀ = 0 equal one penalty solve with ε_eff = «beyond::effective_penalty: growth=(1 + ε/c)^{k+1}»", ["c > 0", "ε > 0"], ["beyond::effective_penalty"], ["1.13", "1.16"];
    "beyond 3", "A step of its own", "beyond", "λ′ = «beyond::relaxed_update» multiplies the error by «beyond::relaxed_contraction»; α = «penalty::total_stiffness» is exact", ["c > 0", "ε > 0"], ["beyond::relaxed_update", "beyond::relaxed_contraction"], ["1.16"];
    "beyond 4", "A proximal step", "beyond", "(1.16) is implicit Euler of step ε on λ̇ = (R − λ)/c", ["c > 0", "ε > 0"], ["beyond::dual_functional"], ["1.16"];
    "beyond 5", "Extrapolation", "beyond", "Aitken's formula gives R exactly from λ₀, λ₁, λ₂", ["c > 0", "ε > 0", "λ₀ ≠ R"], ["beyond::aitken"], ["1.16"];
    "beyond 6", "An exact penalty", "beyond", "Π + «beyond::exact_penalty» is least at u = «lagrange::deflection» for every ε ≥ R", ["c > 0", "R ≥ 0"], ["beyond::exact_penalty"], ["1.4", "Remark 1.3.2"];
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outside_its_holes_an_equation_has_no_formula() {
        for entry in entries() {
            let pieces = entry.latex.split('«');
            let outside = pieces.map(|piece| piece.split_once('»').map_or(piece, |(_, outside)| outside));
            for outside in outside {
                // An index k + 1 belongs to a name.
                let names = outside.split("_{").enumerate();
                let after = |(i, piece): (usize, &'static str)| match piece.split_once('}') {
                    Some((_, after)) if i > 0 => after,
                    _ => piece,
                };
                let bare: String = names.map(after).collect();
                assert!(!bare.contains(['+', '-']), "{}: {bare}", entry.equation);
            }
        }
    }
}

//! The chapter as data: what every number states, where its function is and what it follows from.

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
    /// What it states.
    pub statement: &'static str,
    /// Under which conditions.
    pub hypotheses: &'static [&'static str],
    /// The function in [`chapter`](crate::chapter) that is its formula, as `module::name`.
    pub function: Option<&'static str>,
    /// The entries it is derived from.
    pub follows_from: &'static [&'static str],
}

impl Entry {
    /// As it is written in a text: `(1.13)`, and what has a name by its name.
    pub fn label(&self) -> String {
        let numbered = self.equation.starts_with(|c: char| c.is_ascii_digit());
        if numbered { format!("({})", self.equation) } else { self.equation.to_string() }
    }
}

/// The entry of a number.
pub fn entry(equation: &str) -> Option<&'static Entry> {
    entries().iter().find(|entry| entry.equation == equation)
}

/// All entries, in the chapter's order.
pub fn entries() -> &'static [Entry] {
    ENTRIES
}

macro_rules! entries {
    ($($equation:literal, $title:literal, $section:literal, $statement:literal, [$($hypothesis:literal),*], $function:expr, [$($from:literal),*];)*) => {
        &[$(Entry {
            equation: $equation, title: $title, section: $section, statement: $statement,
            hypotheses: &[$($hypothesis),*], function: $function, follows_from: &[$($from),*],
        }),*]
    };
}

#[rustfmt::skip]
const ENTRIES: &[Entry] = entries! {
    "Fig. 1.1", "The system", "1", "A mass hangs on a spring over a rigid plane.", [], Some("system::SpringMass"), [];
    "1.1", "Equilibrium of forces", "1.1", "c u − m g = 0", ["c > 0"], Some("structure::residual"), ["Fig. 1.1"];
    "1.2", "Virtual work", "1.1", "δu (c u − m g) = 0 for every δu", [], Some("structure::virtual_work"), ["1.1"];
    "1.3", "Variation of the energy", "1.1", "δΠ = δu (c u − m g) = 0", [], Some("structure::first_variation"), ["1.2", "1.4"];
    "1.4", "Potential energy", "1.1", "Π(u) = ½ c u² − m g u is least at u = m g/c and only there", ["c > 0"], Some("structure::potential_energy"), ["1.1"];
    "1.5", "Penetration", "1.2", "p(u) = l + u − H ≤ 0", [], Some("contact::penetration"), ["Fig. 1.1"];
    "1.6", "Karush-Kuhn-Tucker conditions", "1.2", "p ≤ 0, N ≥ 0, p N = 0 and c u − m g + N = 0 have exactly one solution", ["c > 0"], Some("contact::kkt"), ["1.4", "1.5"];
    "1.7", "Lagrange functional", "1.3.1", "𝓛(u, λ) = Π + λ p is stationary at its only saddle point", [], Some("lagrange::functional"), ["1.4", "1.5"];
    "1.8", "Lagrange system", "1.3.1", "c u − m g + λ = 0 and l + u − H = 0 have the only solution u = Δ, λ = R", [], Some("lagrange::residual"), ["1.7"];
    "Remark 1.3.1", "Exact at the price of an unknown", "1.3.1", "p = 0 exactly", [], Some("lagrange::deflection"), ["1.8"];
    "1.9", "Penalised energy", "1.3.2", "Π_p(u) = Π + ½ ε p²", ["c > 0", "ε > 0"], Some("penalty::energy"), ["1.4", "1.5"];
    "1.10", "Penalty functional with many terms", "1.3.2", "W = ½ ε p² + ε₄ p⁴ + … fulfils the conditions on a penalty functional", ["ε > 0", "ε₄ ≥ 0"], Some("penalty::series"), ["1.9"];
    "1.11", "Equilibrium by penalty", "1.3.2", "c u − m g + ε (l + u − H) = 0", [], Some("penalty::residual"), ["1.9"];
    "1.12", "Contact force by penalty", "1.3.2", "N = ε p(u), which is ε R/(c + ε)", ["c > 0", "ε > 0"], Some("penalty::contact_force"), ["1.11"];
    "Fig. 1.2", "The penalty as a second spring", "1.3.2", "Two springs of stiffness c and ε act side by side.", [], Some("penalty::total_stiffness"), ["1.12"];
    "1.13", "Deflection by penalty and its limit", "1.3.2", "u = (ε (H − l) + m g)/(c + ε) tends to H − l as ε → ∞, with p = R/(c + ε)", ["c > 0", "ε > 0"], Some("penalty::deflection"), ["1.11"];
    "Remark 1.3.2", "Which penalty is enough", "1.3.2", "p ≤ tol if and only if ε ≥ R/tol − c", ["c > 0", "R > 0", "tol > 0"], Some("penalty::penalty_for"), ["1.13"];
    "1.14", "Augmented functional", "1.3.3", "L(u) = Π + λ p + ½ ε p²", ["c > 0", "ε > 0"], Some("augmented::functional"), ["1.7", "1.9"];
    "1.15", "Stationarity", "1.3.3", "∂L/∂u = ∂Π/∂u + λ + ε p = 0", [], Some("augmented::stationarity"), ["1.14"];
    "1.16", "Augmentation", "1.3.3", "λ_k = λ_{k−1} + ε p(u_{k−1}) and c u_k − m g + λ_k + ε p(u_k) = 0; in closed form λ_k = R + (λ₀ − R) ρᵏ", ["c > 0", "ε > 0"], Some("augmented::deflection"), ["1.15"];
    "Theorem 1.3.3", "Convergence of the augmentation", "1.3.3", "|p(u_k)| falls strictly and geometrically by ρ = c/(c + ε) for every ε > 0", ["c > 0", "ε > 0"], Some("augmented::contraction"), ["1.16"];
    "1.17", "The limit of the theorem", "1.3.3", "lim p(u_k) = 0, and |p_k| ≤ |p₀| c/(c + k ε)", ["c > 0", "ε > 0"], Some("augmented::harmonic_bound"), ["Theorem 1.3.3"];
    "1.18", "Update of the multiplier", "1.3.3", "λ_{k+1} = λ_k + ε p_k = m g − c u_k", ["(1.19)"], Some("augmented::update"), ["1.16"];
    "1.19", "Equilibrium at step k", "1.3.3", "c u_k − m g + λ_k + ε (l + u_k − H) = 0", ["c > 0", "ε > 0"], Some("augmented::equilibrium"), ["1.16"];
    "1.20", "Equilibrium at step k + 1", "1.3.3", "c u_{k+1} − m g + λ_{k+1} + ε (l + u_{k+1} − H) = 0", ["c > 0", "ε > 0"], Some("augmented::equilibrium"), ["1.16", "1.18"];
    "1.21", "Recursion in the deflection", "1.3.3", "(c + ε)(u_{k+1} − u_k) = −ε (l − H) − ε u_k", [], Some("augmented::recursion"), ["1.18", "1.19", "1.20"];
    "1.22", "Recursion in time", "1.3.3", "(c + ε)(u_{t+1} − u_t) = −ε (l − H) − ε u_t", ["c > 0", "ε > 0"], Some("ode::difference_equation"), ["1.21"];
    "1.23", "Differential equation", "1.3.3", "(c + ε) u̇ + ε u = −ε (l − H), of which one explicit Euler step of size 1 is (1.21)", ["c > 0", "ε > 0"], Some("ode::velocity"), ["1.22"];
    "1.24", "Superposition", "1.3.3", "u = u_h + u_nh", [], Some("ode::superposition"), ["1.23"];
    "1.25", "Homogeneous equation", "1.3.3", "(c + ε) u̇ + ε u = 0", ["c > 0", "ε > 0"], Some("ode::operator"), ["1.23"];
    "1.26", "Characteristic rate", "1.3.3", "rate (c + ε) + ε = 0 at rate = −ε/(c + ε)", ["c > 0", "ε > 0"], Some("ode::characteristic"), ["1.25"];
    "1.27", "Homogeneous solution", "1.3.3", "u_h = A exp(−ε t/(c + ε))", ["c > 0", "ε > 0"], Some("ode::homogeneous"), ["1.26"];
    "1.28", "Particular solution", "1.3.3", "u_nh = H − l", [], Some("ode::particular"), ["1.23"];
    "1.29", "General solution", "1.3.3", "u = A exp(−ε t/(c + ε)) + H − l", ["c > 0", "ε > 0"], Some("ode::general"), ["1.24", "1.27", "1.28"];
    "1.30", "Solution of the initial-value problem", "1.3.3", "u = (u₀ − H + l) exp(−ε t/(c + ε)) + H − l", ["c > 0", "ε > 0"], Some("ode::solution"), ["1.29"];
    "1.31", "Limit of the deflection", "1.3.3", "lim u = H − l as t → ∞", ["c > 0", "ε > 0"], Some("ode::solution"), ["1.30"];
    "1.32", "Limit of the penetration", "1.3.3", "lim p(u) = 0 as t → ∞", ["c > 0", "ε > 0"], Some("contact::penetration"), ["1.31"];
    "1.33", "When to stop", "1.3.3", "|p_k| < tol, after ⌊ln(|p₀|/tol)/ln(1 + ε/c)⌋ + 1 steps", ["c > 0", "ε > 0", "tol > 0"], Some("augmented::within_tolerance"), ["1.16"];
    "Remark 1.3.6", "The force at step k", "1.3.3", "λ_{k+1} − λ_k = ε p_k: the force named in the remark lags one step behind", [], Some("augmented::contact_force"), ["1.18"];
    "note 1", "Grazing", "notes", "p = 0 with N = 0 is a third state", ["c > 0", "R = 0"], Some("contact::deflection"), ["1.6"];
    "note 2", "A saddle point", "notes", "(1.7) is least in u and constant in λ at (Δ, R)", [], Some("lagrange::functional"), ["1.7", "1.8"];
    "note 3", "What a penalty functional needs", "notes", "W_ε(p_ε) ≤ R²/(2c)", ["c > 0", "ε > 0"], Some("penalty::functional"), ["1.10"];
    "note 4", "A plane that never pulls", "notes", "λ_k = ⟨λ_{k−1} + ε p_{k−1}⟩ and c u_k − m g + ⟨λ_k + ε p_k⟩ = 0", ["c > 0", "ε > 0"], Some("augmented::unilateral_deflection"), ["1.6", "1.16"];
    "note 5", "An analogy and no proof", "notes", "e^{−ε/c} < ρ < e^{−ε/(c+ε)}, and p_k → 0 also for ε < −2c", ["c > 0"], Some("augmented::contraction"), ["1.16", "1.30"];
    "note 6", "Which force", "notes", "m g − c u_k = λ_k + ε p_k", ["(1.19)"], Some("augmented::contact_force"), ["1.18", "1.19"];
    "note 8", "Not in every precision", "notes", "Rounding stops the augmentation at a floor of about η (|H| + R/ε)", ["c > 0", "ε > 0"], None, ["1.16"];
    "note 9", "The effort depends on ε", "notes", "(c/ε) Λ < Λ/ln(1 + ε/c) < (c/ε + ½) Λ for Λ = ln(|p₀|/tol) > 0", ["c > 0", "ε > 0"], None, ["1.33"];
    "beyond 1", "Moreau's decomposition", "beyond", "c p + N = R splits R into its positive part N and its negative part −c p", ["c > 0"], Some("contact::contact_force"), ["1.6"];
    "beyond 2", "Augmentations as one penalty", "beyond", "k augmentations equal one penalty solve with ε_eff = c ((1 + ε/c)^{k+1} − 1)", ["c > 0", "ε > 0"], Some("beyond::effective_penalty"), ["1.13", "1.16"];
    "beyond 3", "A step of its own", "beyond", "λ′ = λ + α p multiplies the error by 1 − α/(c + ε); α = c + ε is exact", ["c > 0", "ε > 0"], Some("beyond::relaxed_update"), ["1.16"];
    "beyond 4", "A proximal step", "beyond", "(1.16) is implicit Euler of step ε on λ̇ = (R − λ)/c", ["c > 0", "ε > 0"], Some("beyond::dual_functional"), ["1.16"];
    "beyond 5", "Extrapolation", "beyond", "Aitken's formula gives R exactly from λ₀, λ₁, λ₂", ["c > 0", "ε > 0", "λ₀ ≠ R"], Some("beyond::aitken"), ["1.16"];
    "beyond 6", "An exact penalty", "beyond", "Π + ε ⟨p⟩ is least at u = Δ for every ε ≥ R", ["c > 0", "R ≥ 0"], Some("beyond::exact_penalty"), ["1.4", "Remark 1.3.2"];
};

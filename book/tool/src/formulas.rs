//! The numbered equations of the chapter, typeset, and the functions that compute them.

/// One equation.
pub struct Formula {
    /// Its number in the chapter.
    pub number: &'static str,
    /// The formula in LaTeX.
    pub latex: &'static str,
    /// The functions of `src/chapter`, as `module::name`; a limit has those whose limit it is.
    pub functions: &'static [&'static str],
}

const fn formula(number: &'static str, latex: &'static str, functions: &'static [&'static str]) -> Formula {
    Formula { number, latex, functions }
}

/// All of them, in order.
pub const FORMULAS: &[Formula] = &[
    formula("1.1", r"c\,u - m\,g = 0", &["structure::residual", "structure::deflection"]),
    formula(
        "1.2",
        r"\delta u\,(c\,u - m\,g) = 0 \quad\text{for every } \delta u",
        &["structure::virtual_work"],
    ),
    formula(
        "1.3",
        r"\delta\Pi = \delta\left(\tfrac12\,c\,u^2 - m\,g\,u\right) = 0",
        &["structure::first_variation"],
    ),
    formula("1.4", r"\Pi(u) = \tfrac12\,c\,u^2 - m\,g\,u \;\to\; \min", &["structure::potential_energy"]),
    formula("1.5", r"p(u) = l + u - H \le 0", &["contact::penetration"]),
    formula(
        "1.6",
        r"\begin{array}{lll}
            \text{contact:} & p = 0 & N > 0 \\
            \text{no contact:} & p < 0 & N = 0 \\
            \text{always:} & p\,N = 0 &
          \end{array}",
        &["contact::kkt", "contact::equilibrium"],
    ),
    formula("1.7", r"\mathcal{L}(u, \lambda) = \Pi(u) + \lambda\,p(u)", &["lagrange::functional"]),
    formula(
        "1.8",
        r"\left\{\begin{aligned} c\,u - m\,g + \lambda &= 0 \\ l + u - H &= 0 \end{aligned}\right.",
        &["lagrange::residual", "lagrange::deflection", "lagrange::multiplier"],
    ),
    formula(
        "1.9",
        r"\Pi_p(u) = \Pi(u) + \tfrac12\,\varepsilon\,p(u)^2",
        &["penalty::energy", "penalty::functional"],
    ),
    formula(
        "1.10",
        r"W_\varepsilon(p) = \tfrac12\,\varepsilon\,p^2 + \varepsilon_4\,p^4 + \varepsilon_6\,p^6 + \cdots",
        &["penalty::series", "penalty::series_force"],
    ),
    formula(
        "1.11",
        r"\frac{\partial\Pi_p}{\partial u} = c\,u - m\,g + \varepsilon\,(l + u - H) = 0",
        &["penalty::residual"],
    ),
    formula("1.12", r"N = \varepsilon\,p(u) = \varepsilon\,(l + u - H)", &["penalty::contact_force"]),
    formula(
        "1.13",
        r"\lim_{\varepsilon\to\infty} u
          = \lim_{\varepsilon\to\infty} \frac{\varepsilon\,(H - l) + m\,g}{c + \varepsilon}
          = \lim_{\varepsilon\to\infty} \frac{H - l + m\,g/\varepsilon}{c/\varepsilon + 1}
          = H - l",
        &["penalty::deflection", "penalty::deflection_divided"],
    ),
    formula(
        "1.14",
        r"L(u) = \Pi(u) + \lambda\,p(u) + \tfrac12\,\varepsilon\,p(u)^2",
        &["augmented::functional"],
    ),
    formula(
        "1.15",
        r"\frac{\partial L}{\partial u} = \frac{\partial\Pi}{\partial u} + \lambda + \varepsilon\,p = 0",
        &["augmented::stationarity"],
    ),
    formula(
        "1.16",
        r"\left\{\begin{aligned}
            &\lambda_k = \lambda_{k-1} + \varepsilon\,(l + u_{k-1} - H) \\
            &c\,u_k - m\,g + \lambda_k + \varepsilon\,(l + u_k - H) = 0
          \end{aligned}\right. \qquad k = 1, 2, 3, \dots",
        &["augmented::update", "augmented::equilibrium", "augmented::deflection"],
    ),
    formula(
        "1.17",
        r"\lim_{k\to\infty} p(u_k) = 0",
        &["augmented::contraction", "augmented::penetration_after", "augmented::harmonic_bound"],
    ),
    formula("1.18", r"\lambda_{k+1} = \lambda_k + \varepsilon\,(l + u_k - H)", &["augmented::update"]),
    formula(
        "1.19",
        r"c\,u_k - m\,g + \lambda_k + \varepsilon\,(l + u_k - H) = 0",
        &["augmented::equilibrium"],
    ),
    formula(
        "1.20",
        r"c\,u_{k+1} - m\,g + \lambda_{k+1} + \varepsilon\,(l + u_{k+1} - H) = 0",
        &["augmented::equilibrium"],
    ),
    formula(
        "1.21",
        r"(c + \varepsilon)\,(u_{k+1} - u_k) = -\varepsilon\,(l - H) - \varepsilon\,u_k",
        &["augmented::recursion"],
    ),
    formula(
        "1.22",
        r"(c + \varepsilon)\,(u_{t+1} - u_t) = -\varepsilon\,(l - H) - \varepsilon\,u_t",
        &["ode::difference_equation"],
    ),
    formula(
        "1.23",
        r"(c + \varepsilon)\,\dot u + \varepsilon\,u = -\varepsilon\,(l - H), \qquad u(0) = u_0",
        &["ode::right_side", "ode::velocity"],
    ),
    formula("1.24", r"u = u_h + u_{nh}", &["ode::superposition"]),
    formula("1.25", r"(c + \varepsilon)\,\dot u + \varepsilon\,u = 0", &["ode::operator"]),
    formula(
        "1.26",
        r"s\,(c + \varepsilon) + \varepsilon = 0 \quad\Rightarrow\quad s = -\frac{\varepsilon}{c + \varepsilon}",
        &["ode::characteristic", "ode::rate"],
    ),
    formula("1.27", r"u_h = A\,e^{s t} = A\,e^{-\varepsilon t/(c + \varepsilon)}", &["ode::homogeneous"]),
    formula(
        "1.28",
        r"\varepsilon\,u_{nh} = -\varepsilon\,(l - H) \quad\Rightarrow\quad u_{nh} = H - l",
        &["ode::particular"],
    ),
    formula("1.29", r"u = A\,e^{-\varepsilon t/(c + \varepsilon)} + H - l", &["ode::general"]),
    formula(
        "1.30",
        r"u = (u_0 - H + l)\,e^{-\varepsilon t/(c + \varepsilon)} + H - l",
        &["ode::constant", "ode::solution"],
    ),
    formula("1.31", r"\lim_{t\to\infty} u = H - l \qquad\text{for } c, \varepsilon > 0", &["ode::solution"]),
    formula("1.32", r"\lim_{t\to\infty} p(u(t)) = 0", &["contact::penetration"]),
    formula(
        "1.33",
        r"\lvert p_k\rvert = \lvert l + u_k - H\rvert < \mathrm{tol}",
        &["augmented::within_tolerance"],
    ),
];

"""SciPy: the methods of scipy.optimize that take a bound or a linear constraint.

`nnls` and `lsq-linear` get the problem as least squares. Only of `trust-constr` is a multiplier taken; of the
others the contact force is the reaction m g - c u.
"""

import math

import numpy as np
from scipy import optimize

from adapter import Answer, Refused, options, reaction, serve

METHODS = {"slsqp": "SLSQP", "trust-constr": "trust-constr", "l-bfgs-b": "L-BFGS-B", "tnc": "TNC"}

parser = options(__doc__)
parser.add_argument("--method", choices=[*METHODS, "lsq-linear", "nnls"], default="slsqp")
parser.add_argument("--tol", type=float, help="every tolerance that the method has")
parser.add_argument("--gtol", type=float, help="trust-constr: 0 leaves the end to xtol and barrier_tol")
parser.add_argument("--maxiter", type=int, help="iterations")
arguments = parser.parse_args()

TOLERANCES = {
    "slsqp": ("ftol",), "trust-constr": ("gtol", "xtol", "barrier_tol"), "l-bfgs-b": ("ftol", "gtol"),
    "tnc": ("ftol", "gtol", "xtol"),
}


def nnls(problem, _):
    """The slack gap - u is not negative, and makes c (gap - u)² / 2 with its linear term a square."""
    root = math.sqrt(problem.stiffness)
    slack, _ = optimize.nnls(np.array([[root]]), np.array([-reaction(problem, problem.gap) / root]))
    return problem.gap - slack[0], "solved"


def lsq_linear(problem, arguments):
    """sqrt(c) u as near to m g / sqrt(c) as the bound lets it."""
    root = math.sqrt(problem.stiffness)
    extra = {} if arguments.tol is None else {"tol": arguments.tol}
    result = optimize.lsq_linear(
        np.array([[root]]), np.array([problem.load / root]), bounds=(-np.inf, problem.gap), **extra
    )
    if not result.success:
        raise Refused(result.message)
    return result.x[0], result.message


def minimize(problem, arguments):
    """The energy and its gradient, from u = 0 as most would start; the plane as a bound or a constraint."""
    constrained = arguments.method == "trust-constr"
    settings = {} if arguments.tol is None else dict.fromkeys(TOLERANCES[arguments.method], arguments.tol)
    if arguments.gtol is not None:
        settings["gtol"] = arguments.gtol
    if arguments.maxiter is not None:
        settings["maxfun" if arguments.method == "tnc" else "maxiter"] = arguments.maxiter
    return optimize.minimize(
        lambda u: problem.stiffness * u[0] ** 2 / 2 - problem.load * u[0],
        [0.0],
        jac=lambda u: np.array([problem.stiffness * u[0] - problem.load]),
        hess=(lambda u: np.array([[problem.stiffness]])) if constrained else None,
        method=METHODS[arguments.method],
        bounds=None if constrained else [(None, problem.gap)],
        constraints=optimize.LinearConstraint([[1.0]], -np.inf, problem.gap) if constrained else (),
        options=settings,
    )


def solve(problem, arguments):
    if arguments.method in ("nnls", "lsq-linear"):
        u, status = (nnls if arguments.method == "nnls" else lsq_linear)(problem, arguments)
        return Answer(u, reaction(problem, u), status)
    result = minimize(problem, arguments)
    if not result.success:
        raise Refused(result.message)
    force = result.v[0][0] if arguments.method == "trust-constr" else reaction(problem, result.x[0])
    return Answer(result.x[0], force, result.message)


serve(solve, arguments)

"""DAQP: a dual active-set method. What it takes for zero are tolerances of its own."""

import daqp
import numpy as np

from adapter import Answer, Refused, given, options, serve

STATUS = {
    2: "soft optimal", 1: "optimal", -1: "infeasible", -2: "cycling", -3: "unbounded",
    -4: "iteration limit", -5: "not convex", -6: "overdetermined",
}

parser = options(__doc__)
parser.add_argument("--primal-tol", type=float, help="a constraint may be violated by so much (DAQP: 1e-6)")
parser.add_argument("--dual-tol", type=float, help="a multiplier may be negative by so much (DAQP: 1e-12)")
parser.add_argument("--fval-bound", type=float, help="energies above mean infeasible (DAQP: 1e30)")
parser.add_argument("--general", action="store_true", help="the plane as a constraint, not as a bound")
arguments = parser.parse_args()


def solve(problem, arguments):
    rows = np.array([[1.0]]) if arguments.general else np.zeros((0, 1))  # without a row: a bound
    u, _, flag, info = daqp.solve(
        np.array([[problem.stiffness]]), np.array([-problem.load]), rows,
        np.array([problem.gap]), np.array([-1e30]), np.zeros(1, dtype=np.intc),
        **given(arguments, "primal_tol", "dual_tol", "fval_bound"),
    )
    if flag < 1:
        raise Refused(STATUS.get(flag, f"exit flag {flag}"))
    return Answer(u[0], info["lam"][0], STATUS[flag])


serve(solve, arguments)

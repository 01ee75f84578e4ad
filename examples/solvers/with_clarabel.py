"""Clarabel: an interior-point method for conic programs, with tolerances of 1e-8 unless told otherwise."""

import clarabel
import numpy as np
from scipy import sparse

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--tol", type=float, help="tol_feas, tol_gap_abs and tol_gap_rel (Clarabel: 1e-8)")
parser.add_argument("--no-presolve", action="store_true", help="keep constraints that look infinite (1e20)")
arguments = parser.parse_args()


def solve(problem, arguments):
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.presolve_enable = not arguments.no_presolve
    if arguments.tol is not None:
        settings.tol_feas = settings.tol_gap_abs = settings.tol_gap_rel = arguments.tol
    result = clarabel.DefaultSolver(
        sparse.csc_matrix([[problem.stiffness]]), np.array([-problem.load]),
        sparse.csc_matrix([[1.0]]), np.array([problem.gap]), [clarabel.NonnegativeConeT(1)], settings,
    ).solve()
    if str(result.status) not in ("Solved", "AlmostSolved"):
        raise Refused(str(result.status))
    return Answer(result.x[0], result.z[0], str(result.status))


serve(solve, arguments)

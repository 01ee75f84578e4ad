"""OSQP: ADMM on quadratic programs, with tolerances of 1e-3 unless told otherwise."""

import numpy as np
import osqp
from scipy import sparse

from adapter import Answer, Refused, given, options, serve

parser = options(__doc__)
parser.add_argument("--eps", type=float, help="both eps_abs and eps_rel (OSQP: 1e-3)")
parser.add_argument("--max-iter", type=int, help="iterations (OSQP: 4000)")
parser.add_argument("--scaling", type=int, help="steps of Ruiz scaling (OSQP: 10)")
parser.add_argument("--polishing", action="store_true", default=None, help="solve again on the active set")
arguments = parser.parse_args()


def solve(problem, arguments):
    settings = given(arguments, "max_iter", "scaling", "polishing")
    if arguments.eps is not None:
        settings.update(eps_abs=arguments.eps, eps_rel=arguments.eps)
    solver = osqp.OSQP()
    solver.setup(
        P=sparse.csc_matrix([[problem.stiffness]]), q=np.array([-problem.load]),
        A=sparse.csc_matrix([[1.0]]), l=np.array([-np.inf]), u=np.array([problem.gap]),
        verbose=False, **settings,
    )
    result = solver.solve(raise_error=False)
    if result.info.status not in ("solved", "solved inaccurate"):
        raise Refused(result.info.status)
    return Answer(result.x[0], result.y[0], result.info.status)


serve(solve, arguments)

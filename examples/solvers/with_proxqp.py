"""ProxQP of ProxSuite: a proximal augmented Lagrangian method, with a tolerance of 1e-5 as it comes."""

import numpy as np
from proxsuite import proxqp

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--eps-abs", type=float, help="absolute tolerance (ProxQP: 1e-5)")
parser.add_argument("--eps-rel", type=float, help="relative tolerance (ProxQP: 0)")
arguments = parser.parse_args()


def solve(problem, arguments):
    solver = proxqp.dense.QP(1, 0, 1)
    if arguments.eps_abs is not None:
        solver.settings.eps_abs = arguments.eps_abs
    if arguments.eps_rel is not None:
        solver.settings.eps_rel = arguments.eps_rel
    solver.init(
        np.array([[problem.stiffness]]), np.array([-problem.load]), None, None,
        np.array([[1.0]]), np.array([-np.inf]), np.array([problem.gap]),
    )
    solver.solve()
    status = solver.results.info.status
    if status != proxqp.PROXQP_SOLVED:
        raise Refused(status.name)
    return Answer(solver.results.x[0], solver.results.z[0], status.name)


serve(solve, arguments)

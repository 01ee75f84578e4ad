"""QPALM: a proximal augmented Lagrangian method, with tolerances of 1e-4 unless told otherwise."""

import numpy as np
import qpalm
from scipy import sparse

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--eps", type=float, help="both eps_abs and eps_rel (QPALM: 1e-4)")
parser.add_argument("--scaling", type=int, help="steps of Ruiz scaling (QPALM: 10)")
arguments = parser.parse_args()


def solve(problem, arguments):
    data = qpalm.Data(1, 1)
    data.Q = sparse.csc_matrix([[problem.stiffness]])
    data.A = sparse.csc_matrix([[1.0]])
    data.q, data.bmin, data.bmax = np.array([-problem.load]), np.array([-np.inf]), np.array([problem.gap])
    settings = qpalm.Settings()
    settings.verbose = 0
    if arguments.eps is not None:
        settings.eps_abs = settings.eps_rel = arguments.eps
    if arguments.scaling is not None:
        settings.scaling = arguments.scaling
    solver = qpalm.Solver(data, settings)
    solver.solve()
    if solver.info.status != "solved":
        raise Refused(solver.info.status)
    return Answer(solver.solution.x[0], solver.solution.y[0], solver.info.status)


serve(solve, arguments)

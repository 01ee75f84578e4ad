"""PIQP: an interior-point method with proximal terms, with tolerances of 1e-8 and 1e-9 as it comes."""

import numpy as np
import piqp

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--eps-abs", type=float, help="eps_abs and eps_duality_gap_abs (PIQP: 1e-8)")
parser.add_argument("--eps-rel", type=float, help="eps_rel and eps_duality_gap_rel (PIQP: 1e-9)")
arguments = parser.parse_args()


def solve(problem, arguments):
    solver = piqp.DenseSolver()
    if arguments.eps_abs is not None:
        solver.settings.eps_abs = solver.settings.eps_duality_gap_abs = arguments.eps_abs
    if arguments.eps_rel is not None:
        solver.settings.eps_rel = solver.settings.eps_duality_gap_rel = arguments.eps_rel
    solver.setup(
        P=np.array([[problem.stiffness]]), c=np.array([-problem.load]), x_u=np.array([problem.gap])
    )
    status = solver.solve()
    if status != piqp.PIQP_SOLVED:
        raise Refused(str(status))
    return Answer(solver.result.x[0], solver.result.z_bu[0], str(status))


serve(solve, arguments)

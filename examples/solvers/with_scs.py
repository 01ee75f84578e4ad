"""SCS: operator splitting on conic programs, with tolerances of 1e-4 unless told otherwise."""

import numpy as np
import scs
from scipy import sparse

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--eps", type=float, help="both eps_abs and eps_rel (SCS: 1e-4)")
parser.add_argument("--max-iters", type=int, help="iterations (SCS: 100000)")
arguments = parser.parse_args()


def solve(problem, arguments):
    settings = {"verbose": False}
    if arguments.eps is not None:
        settings.update(eps_abs=arguments.eps, eps_rel=arguments.eps)
    if arguments.max_iters is not None:
        settings.update(max_iters=arguments.max_iters)
    data = {
        "P": sparse.csc_matrix([[problem.stiffness]]), "c": np.array([-problem.load]),
        "A": sparse.csc_matrix([[1.0]]), "b": np.array([problem.gap]),
    }
    result = scs.SCS(data, {"l": 1}, **settings).solve()
    status = result["info"]["status"]
    if not status.startswith("solved"):
        raise Refused(status)
    return Answer(result["x"][0], result["y"][0], status)


serve(solve, arguments)

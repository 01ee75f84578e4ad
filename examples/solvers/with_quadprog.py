"""quadprog: the dual active-set method of Goldfarb and Idnani. There is nothing to set."""

import numpy as np
import quadprog

from adapter import Answer, options, serve

arguments = options(__doc__).parse_args()


def solve(problem, _):
    u, _, _, _, multipliers, _ = quadprog.solve_qp(
        np.array([[problem.stiffness]]), np.array([problem.load]),
        np.array([[-1.0]]), np.array([-problem.gap]),
    )
    return Answer(u[0], multipliers[0], "solved")


serve(solve, arguments)

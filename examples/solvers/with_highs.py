"""HiGHS: its active-set method for quadratic programs. Small numbers in a matrix are taken for nothing."""

import highspy
import numpy as np

from adapter import Answer, Refused, given, options, serve

parser = options(__doc__)
parser.add_argument("--primal-feasibility-tolerance", type=float, help="HiGHS: 1e-7")
parser.add_argument("--dual-feasibility-tolerance", type=float, help="HiGHS: 1e-7")
parser.add_argument("--qp-regularization-value", type=float, help="added to the stiffness (HiGHS: 1e-7)")
parser.add_argument("--small-matrix-value", type=float, help="smaller entries are dropped (HiGHS: 1e-9)")
parser.add_argument("--infinite-cost", type=float, help="a load beyond is dropped (HiGHS: 1e20)")
arguments = parser.parse_args()
NAMES = (
    "primal_feasibility_tolerance", "dual_feasibility_tolerance",
    "qp_regularization_value", "small_matrix_value", "infinite_cost",
)


def accept(status, what):
    """HiGHS says so of every step, and goes on without what it does not take."""
    if status == highspy.HighsStatus.kError:
        raise Refused(f"HiGHS does not take {what}")


def solve(problem, arguments):
    solver = highspy.Highs()
    solver.silent()
    for name, value in given(arguments, *NAMES).items():
        accept(solver.setOptionValue(name, value), f"{name} = {value}")
    accept(solver.addVar(-highspy.kHighsInf, problem.gap), "the bound")
    accept(solver.changeColCost(0, -problem.load), "the linear term")
    zero = np.array([0], dtype=np.int32)
    triangular = int(highspy.HessianFormat.kTriangular)
    hessian = solver.passHessian(1, 1, triangular, zero, zero, np.array([problem.stiffness]))
    accept(hessian, "the Hessian")
    accept(solver.run(), "the problem")
    status = solver.getModelStatus()
    if status != highspy.HighsModelStatus.kOptimal:
        raise Refused(solver.modelStatusToString(status))
    solution = solver.getSolution()
    return Answer(solution.col_value[0], -solution.col_dual[0], solver.modelStatusToString(status))


serve(solve, arguments)

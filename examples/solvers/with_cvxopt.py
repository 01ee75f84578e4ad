"""CVXOPT: an interior-point method for cone programs, with tolerances of 1e-7 and 1e-6 as it comes."""

from cvxopt import matrix, solvers

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--tol", type=float, help="feastol, abstol and reltol (CVXOPT: 1e-7, 1e-7, 1e-6)")
arguments = parser.parse_args()


def solve(problem, arguments):
    settings = {"show_progress": False}
    if arguments.tol is not None:
        settings.update(feastol=arguments.tol, abstol=arguments.tol, reltol=arguments.tol)
    result = solvers.qp(
        matrix(problem.stiffness), matrix(-problem.load), matrix(1.0), matrix(problem.gap), options=settings
    )
    if result["status"] != "optimal":
        raise Refused(result["status"])
    return Answer(result["x"][0], result["z"][0], result["status"])


serve(solve, arguments)

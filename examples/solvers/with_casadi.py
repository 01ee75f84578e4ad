"""CasADi with IPOPT or qpOASES: an interior-point and an active-set method, as the package brings them."""

import casadi

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--solver", choices=["ipopt", "qpoases"], default="ipopt")
parser.add_argument("--tol", type=float, help="IPOPT: tol (1e-8); qpOASES: terminationTolerance")
parser.add_argument("--general", action="store_true", help="the plane as a constraint, not as a bound")
parser.add_argument("--no-ramping", action="store_true", help="qpOASES: enableRamping off")
parser.add_argument("--bound-relax-factor", type=float, help="IPOPT widens bounds by this (1e-8)")
parser.add_argument("--compl-inf-tol", type=float, help="IPOPT: complementarity, absolute (1e-4)")
parser.add_argument("--constr-viol-tol", type=float, help="IPOPT: violation, absolute (1e-4)")
parser.add_argument("--dual-inf-tol", type=float, help="IPOPT: gradient of the Lagrangian, absolute (1)")
parser.add_argument("--no-scaling", action="store_true", help="IPOPT: nlp_scaling_method none")
arguments = parser.parse_args()


def settings(arguments):
    """What was set, by the names of the solver; and quiet."""
    if arguments.solver == "qpoases":
        ramping = {"enableRamping": False} if arguments.no_ramping else {}
        return ramping if arguments.tol is None else {"terminationTolerance": arguments.tol, **ramping}
    names = ("tol", "bound_relax_factor", "compl_inf_tol", "constr_viol_tol", "dual_inf_tol")
    chosen = {name: getattr(arguments, name) for name in names if getattr(arguments, name) is not None}
    if arguments.no_scaling:
        chosen["nlp_scaling_method"] = "none"
    return {"ipopt": {"print_level": 0, "sb": "yes", **chosen}, "print_time": False}


def solve(problem, arguments):
    u = casadi.SX.sym("u")
    energy = {"x": u, "f": problem.stiffness * u**2 / 2 - problem.load * u}
    if arguments.general:
        energy["g"] = u
    if arguments.solver == "ipopt":
        solver = casadi.nlpsol("solver", "ipopt", energy, settings(arguments))
    else:
        quiet = {"printLevel": "none", "error_on_fail": False}
        solver = casadi.qpsol("solver", "qpoases", energy, {**quiet, **settings(arguments)})
    bounds = ("lbg", "ubg", "lam_g") if arguments.general else ("lbx", "ubx", "lam_x")
    result = solver(**{"x0": 0, bounds[0]: -casadi.inf, bounds[1]: problem.gap})
    stats = solver.stats()
    if not stats["success"]:
        raise Refused(stats["return_status"])
    return Answer(float(result["x"]), float(result[bounds[2]]), stats["return_status"])


serve(solve, arguments)

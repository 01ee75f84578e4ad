"""The protocol of `contact check`, once for all solvers: a line of JSON in, a line of JSON out.

An adapter is a function that takes a `Problem` and the options of the command line, and returns an `Answer`
or raises. Files are named with_*.py, because a file osqp.py would hide the package of that name from itself.
"""

import argparse
import json
import os
import sys
from dataclasses import dataclass
from fractions import Fraction
from typing import Optional


@dataclass
class Problem:
    """Minimise 1/2 c u² - load u subject to u <= gap; in SI units, each number rounded once.

    `load` is m g and `gap` is H - l. They are formed of the decimals exactly, so that what is judged is the
    solver, and not a subtraction in front of it. `length` and `force` are the sizes of the problem,
    |gap| + |load / c| and |load| + |c gap|: what the judgement measures errors by, and `--scaled` divides by.
    """

    stiffness: float
    mass: float
    gravity: float
    free_length: float
    height: float
    load: float
    gap: float
    length: float
    force: float
    penalty: Optional[float] = None


@dataclass
class Answer:
    """What the solver says. Only the first two are needed; `penalty` is the one of a solver that has one."""

    deflection: float
    contact_force: float
    status: Optional[str] = None
    penalty: Optional[float] = None


class Refused(Exception):
    """The solver itself says that it has no answer. The words are its own."""


def options(doc):
    """A parser with the one option that all adapters have; the adapter adds those of its solver."""
    parser = argparse.ArgumentParser(
        description=doc, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--scaled", nargs="?", type=float, const=1.0, metavar="SIZE",
        help="hand over the problem in units in which its length and its force are SIZE (1), its stiffness 1",
    )
    return parser


def given(arguments, *names):
    """Those options that were set, as keywords: what is not set stays at the solver's own default."""
    return {name: getattr(arguments, name) for name in names if getattr(arguments, name) is not None}


def reaction(problem, deflection):
    """The contact force that balance asks for, where a solver has no multiplier: a reaction, m g - c u."""
    return problem.load - problem.stiffness * deflection


def sizes(stiffness, load, gap):
    """The length and the force of the problem; 1 where nothing has a size."""
    length, force = abs(gap) + abs(load / stiffness), abs(load) + abs(stiffness * gap)
    return length or Fraction(1), force or Fraction(1)


def read(request, scaled):
    """The problem of a request, and the units it is in. Scaled, its stiffness and its mass are 1."""
    names = ("stiffness", "mass", "gravity", "free_length", "height")
    c, m, g, l, h = (Fraction(request[name]) for name in names)
    load, gap = m * g, h - l
    penalty = Fraction(request["penalty"]) if "penalty" in request else None
    length, force = sizes(c, load, gap)
    meter, newton = Fraction(1), Fraction(1)
    if scaled:
        meter, newton = length / Fraction(scaled), force / Fraction(scaled)
        c, m, g, load = 1, 1, load / newton, load / newton  # newton / meter is c
        l, h, gap, length, force = l / meter, h / meter, gap / meter, length / meter, force / newton
        penalty = penalty and penalty * meter / newton
    numbers = [float(x) for x in (c, m, g, l, h, load, gap, length, force)]
    return Problem(*numbers, penalty and float(penalty)), (float(meter), float(newton))


def write(answer, meter, newton):
    """The fields of an answer, back in the units of the request."""
    fields = {
        "deflection": float(answer.deflection) * meter,
        "contact_force": float(answer.contact_force) * newton,
        "status": answer.status,
        "used": None if answer.penalty is None else {"penalty": float(answer.penalty) * newton / meter},
    }
    return {name: value for name, value in fields.items() if value is not None}


def serve(solve, arguments):
    """Answers every line of standard input.

    What the solver itself prints goes to standard error: a line it began would swallow the answer.
    """
    replies = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    for line in sys.stdin:
        request = json.loads(line, parse_float=Fraction)
        reply = {"id": request["id"]}
        try:
            problem, units = read(request, arguments.scaled)
            reply.update(write(solve(problem, arguments), *units))
        except Refused as refusal:
            reply["error"] = str(refusal)
        except Exception as error:  # a solver's exception is its way to refuse
            reply["error"] = f"{type(error).__name__}: {error}"
        print(json.dumps(reply), file=replies, flush=True)

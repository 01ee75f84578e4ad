"""CalculiX: a SPRINGA element over a GAPUNI element, a static step of `ccx`.

A gap element of CalculiX is a penalty that has been smoothed: it has a stiffness, 1e12 unless told otherwise,
and a small force that pulls when it is open, 1e-3 unless told otherwise. A penalty in the request is taken
for its stiffness.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from adapter import Answer, Refused, options, serve

DECK = """*NODE, NSET=ALL
1, 0., 0., 0.
2, 0., 0., {mass}
3, 0., 0., {plane}
*ELEMENT, TYPE=SPRINGA, ELSET=SPRING
1, 1, 2
*SPRING, ELSET=SPRING

{stiffness}
*ELEMENT, TYPE=GAPUNI, ELSET=GAP
2, 2, 3
*GAP, ELSET=GAP
{gap}, 0., 0., -1., , {gap_stiffness}, {gap_tension}
*BOUNDARY
1, 1, 3
3, 1, 3
2, 1, 2
*STEP{nlgeom}
*STATIC
1., 1.
*CLOAD
2, 3, {load}
*NODE PRINT, NSET=ALL
U, RF
*END STEP
"""

parser = options(__doc__)
parser.add_argument("--gap-stiffness", type=float, default=1e12, help="in N/m; with --scaled relative")
parser.add_argument("--gap-tension", type=float, default=1e-3, help="in N; with --scaled relative")
parser.add_argument("--linear", action="store_true", help="without NLGEOM")
arguments = parser.parse_args()


def deck(problem, arguments, stiffness):
    """All numbers in the 20 columns that ccx reads. Node 1 holds the spring, 2 is the mass, 3 the plane."""
    numbers = {
        "mass": -(problem.free_length or problem.length), "plane": -(problem.height or problem.length),
        "stiffness": problem.stiffness, "gap": problem.gap, "gap_stiffness": stiffness,
        "gap_tension": arguments.gap_tension, "load": -problem.load,
    }
    texts = {name: f"{value:.12E}" for name, value in numbers.items()}
    return DECK.format(nlgeom="" if arguments.linear else ", NLGEOM", **texts)


def third(table, node):
    """The third component of a node in a table of ccx."""
    for row in table.splitlines():
        columns = row.split()
        if len(columns) == 4 and columns[0] == str(node):
            return float(columns[3])
    raise Refused("ccx wrote no results")


def solve(problem, arguments):
    stiffness = arguments.gap_stiffness if problem.penalty is None else problem.penalty
    with tempfile.TemporaryDirectory() as directory:
        folder = pathlib.Path(directory)
        (folder / "job.inp").write_text(deck(problem, arguments, stiffness))
        one = {**os.environ, "OMP_NUM_THREADS": "1"}
        done = subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, text=True, env=one)
        results = folder / "job.dat"
        tables = results.read_text() if results.exists() else ""
    errors = re.findall(r"\*ERROR[^\n]*", done.stdout)
    if errors or done.returncode:
        raise Refused("; ".join(errors) or f"ccx ended with status {done.returncode}")
    parts = re.split(r"^ (?:displacements|forces)[^\n]*$", tables, flags=re.M)
    displacements, forces = parts[1:3] if len(parts) > 2 else ("", "")
    own = None if problem.penalty is not None else stiffness
    return Answer(-third(displacements, 2), third(forces, 3), penalty=own)


if not shutil.which("ccx"):
    raise SystemExit("with_ccx.py: ccx is missing; it is Debian's package calculix-ccx")
serve(solve, arguments)

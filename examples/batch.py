#!/usr/bin/env python3
"""A study from Python: penalties times heights at once, and a search that depends on each answer.

    python3 examples/batch.py [COMMAND]        COMMAND is `contact`, or a path to it

Other languages do what the module does: write lines of JSON to `contact solve --batch`, and read lines.
"""

import pathlib
import sys

# Not needed where the wheel is installed.
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "python"))

from spring_mass_contact import Solver, solve_all  # noqa: E402


def main():
    command = sys.argv[1] if len(sys.argv) > 1 else None

    # Decimals as texts are read exactly; a float of Python is written as the shortest one that is the same float.
    heights, penalties = ["1.05", "1.09", "1.2"], ["1e2", "1e4", "1e6"]
    systems = [{"height": h, "method": "penalty", "penalty": e} for h in heights for e in penalties]
    print("height  penalty  state      penetration in m")
    for system, answer in zip(systems, solve_all(systems, command)):
        print(f"{system['height']:6}  {system['penalty']:7}  {answer['state']:9}  {answer['penetration']}")

    # How large a penalty keeps the penetration of the default system below a micrometre?
    with Solver(command, method="penalty") as solver:
        penalty = 1
        while float(solver.solve(penalty=penalty)["penetration"]) > 1e-6:
            penalty *= 10
    print(f"below 1e-6 m with a penalty of {penalty} N/m")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""A study by `contact solve --batch` from another language: penalties times heights, the standard library alone.

    python3 examples/batch.py [COMMAND]        COMMAND is `contact`, or a path to it
"""

import json
import subprocess
import sys


def solve_all(command, systems):
    """All at once: `run` writes and reads at the same time, so that neither side waits for the other."""
    lines = "".join(json.dumps({"id": n, **system}) + "\n" for n, system in enumerate(systems))
    # The status is 1 if a line is an error or did not converge: each answer says so itself.
    done = subprocess.run([command, "solve", "--batch"], input=lines, capture_output=True, encoding="utf-8")
    if done.returncode not in (0, 1):
        sys.exit(done.stderr.strip())
    return [json.loads(line) for line in done.stdout.splitlines()]


class Solver:
    """One by one: a line is answered before the next one is asked for, which may depend on the answer."""

    def __init__(self, command):
        self.process = subprocess.Popen(
            [command, "solve", "--batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8"
        )

    def solve(self, **system):
        self.process.stdin.write(json.dumps(system) + "\n")
        self.process.stdin.flush()
        answer = json.loads(self.process.stdout.readline())
        if "error" in answer:
            raise ValueError(answer["error"])
        return answer

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.stdin.close()
        self.process.wait()


def main():
    command = sys.argv[1] if len(sys.argv) > 1 else "contact"

    # Decimals as texts are read exactly; a float of Python is written as the shortest one that is the same float.
    heights, penalties = ["1.05", "1.09", "1.2"], ["1e2", "1e4", "1e6"]
    systems = [{"height": h, "method": "penalty", "penalty": e} for h in heights for e in penalties]
    print("height  penalty  state      penetration in m")
    for system, answer in zip(systems, solve_all(command, systems)):
        print(f"{system['height']:6}  {system['penalty']:7}  {answer['state']:9}  {answer['penetration']}")

    # How large a penalty keeps the penetration of the default system below a micrometre?
    with Solver(command) as solver:
        penalty = 1
        while float(solver.solve(method="penalty", penalty=penalty)["penetration"]) > 1e-6:
            penalty *= 10
    print(f"below 1e-6 m with a penalty of {penalty} N/m")


if __name__ == "__main__":
    main()

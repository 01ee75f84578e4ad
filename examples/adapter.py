#!/usr/bin/env python3
"""What `contact check` talks to: put a solver of your own in place of this one."""

import json
import sys


def solve(stiffness, mass, gravity, free_length, height, penalty=None):
    """Deflection in m, downwards, and contact force in N, not negative; by penalty if one is asked for."""
    gap, weight = height - free_length, mass * gravity
    if weight <= stiffness * gap:
        return weight / stiffness, 0.0
    force = weight - stiffness * gap
    if penalty is None:
        return gap, force
    return gap + force / (stiffness + penalty), penalty * force / (stiffness + penalty)


for line in sys.stdin:
    request = json.loads(line)
    name = request.pop("id")
    deflection, contact_force = solve(**request)
    print(json.dumps({"id": name, "deflection": deflection, "contact_force": contact_force}), flush=True)

#!/usr/bin/env python3
"""What `contact check` talks to: put a solver of your own in place of this one."""

import json
import sys


def solve(stiffness, mass, gravity, free_length, height):
    """Deflection in m, downwards, and contact force in N, not negative."""
    gap, weight = height - free_length, mass * gravity
    touches = weight > stiffness * gap
    return (gap, weight - stiffness * gap) if touches else (weight / stiffness, 0.0)


for line in sys.stdin:
    request = json.loads(line)
    name = request.pop("id")
    deflection, contact_force = solve(**request)
    print(json.dumps({"id": name, "deflection": deflection, "contact_force": contact_force}), flush=True)

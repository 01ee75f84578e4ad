"""Wrong: the plane also pulls."""

import json
import sys

for line in sys.stdin:
    q = json.loads(line)
    gap = q["height"] - q["free_length"]
    force = q["mass"] * q["gravity"] - q["stiffness"] * gap
    print(json.dumps({"id": q["id"], "deflection": gap, "contact_force": force, "status": "converged"}), flush=True)

"""MuJoCo: the mass is simulated until it rests. Contacts are soft; solref and solimp say how soft.

The damping is critical, which changes the way to rest and not the place of it. If the mass does not come to
rest, or if MuJoCo warns (bad numbers make it start over), there is no answer.
"""

import math
import os
import tempfile

import mujoco
import numpy as np

from adapter import Answer, Refused, options, serve

parser = options(__doc__)
parser.add_argument("--steps", type=int, default=30_000, help="give up after so many steps")
parser.add_argument("--rest", type=float, default=1e-8, help="relative speed and acceleration taken for none")
parser.add_argument("--timestep-ratio", type=float, help="time step by sqrt(m / c) (MuJoCo: 0.002 s)")
parser.add_argument("--contact-stiffness", type=float, help="solref = -stiffness -damping, in units of c / m")
parser.add_argument("--impedance", type=float, help="dmin and dmax of solimp (MuJoCo: 0.9, 0.95)")
parser.add_argument("--local-origin", action="store_true", help="depths from the mass, not from the support")
arguments = parser.parse_args()

MODEL = """<mujoco>
  <option gravity="0 0 {down!r}" timestep="{timestep!r}"/>
  <worldbody>
    <geom type="plane" size="1 1 1" pos="0 0 {plane!r}" {contact}/>
    <body pos="0 0 {start!r}">
      <inertial pos="0 0 0" mass="{mass!r}" diaginertia="{mass!r} {mass!r} {mass!r}"/>
      <joint type="slide" axis="0 0 -1" stiffness="{stiffness!r}" damping="{damping!r}"/>
      <geom type="sphere" size="0.01" pos="0 0 0.01" condim="1" {contact}/>
    </body>
  </worldbody>
</mujoco>"""


def model(problem, arguments):
    """A sphere whose lowest point is the mass; the spring is undeformed at depth l, the plane is at H."""
    rate = math.sqrt(problem.stiffness / problem.mass)
    contact = ""
    if arguments.contact_stiffness is not None:
        k = arguments.contact_stiffness * rate**2
        contact += f'solref="{-k!r} {-2 * math.sqrt(k)!r}" '
    if arguments.impedance is not None:
        contact += f'solimp="{arguments.impedance!r} {arguments.impedance!r} 1 0.5 1"'
    timestep = 0.002 if arguments.timestep_ratio is None else arguments.timestep_ratio / rate
    start, plane = (0.0, problem.gap) if arguments.local_origin else (problem.free_length, problem.height)
    return mujoco.MjModel.from_xml_string(MODEL.format(
        down=-problem.gravity, timestep=timestep, start=-start, plane=-plane,
        stiffness=problem.stiffness, damping=2 * rate * problem.mass, mass=problem.mass, contact=contact,
    ))


def push(model, data):
    """The normal forces of all contacts together."""
    force, total = np.zeros(6), 0.0
    for contact in range(data.ncon):
        mujoco.mj_contactForce(model, data, contact, force)
        total += force[0]
    return total


def solve(problem, arguments):
    system = model(problem, arguments)
    data = mujoco.MjData(system)
    rate = math.sqrt(problem.stiffness / problem.mass)
    slow, weak = (arguments.rest * problem.length * rate**n for n in (1, 2))
    for _ in range(arguments.steps):
        mujoco.mj_step(system, data)
        for warning in data.warning:
            if warning.number:
                raise Refused(f"MuJoCo warns at t = {data.time:.3g} s")
        if abs(data.qvel[0]) < slow and abs(data.qacc[0]) < weak:
            mujoco.mj_forward(system, data)
            return Answer(data.qpos[0], push(system, data), f"at rest after {data.time:.3g} s")
    raise Refused(f"not at rest after {arguments.steps} steps, {data.time:.3g} s")


with tempfile.TemporaryDirectory() as directory:
    os.chdir(directory)  # MuJoCo writes its log where it is
    serve(solve, arguments)

"""MuJoCo: relaxes an exported pile on regularised contacts, and writes the contact forces.

    mujoco_pile.py FOLDER [IMPEDANCE TIME]

writes FOLDER/mujoco.csv for `cannonpile verify`. The defaults are those of MuJoCo: an impedance d of 0.9 to 0.95 and a time
constant t of 0.02 s.

MuJoCo regularises contacts. It adds A (1 - d)/d to the inverse mass A of a contact, so that the problem always has one
solution, and separates overlapping spheres with the time constant t. At rest a contact is a spring of the stiffness
1/(A t² (1 - d)). A is 2/m between free spheres and 1/m on a fixed sphere. So the pile is compressed, and its forces have a
relative error of about (1 - d) t² g L/R. The tolerance of the solver does not change this error. The error decreases with d
closer to 1 and with a smaller t. The time step is t/2, because MuJoCo requires t to be at least two steps. The stiffness is
proportional to the mass, not to the weight: with the default parameters a pile of 1 mm spheres under 9.81 m/s² collapses.
"""

import sys
from pathlib import Path

import mujoco
import numpy

import exported

STEPS = 1500

folder = Path(sys.argv[1])
piled = exported.spheres(folder)
contact = {"condim": 1}  # No friction.
spec = mujoco.MjSpec()
if len(sys.argv) > 2:
    impedance, time = float(sys.argv[2]), float(sys.argv[3])
    # The impedance is the same at any overlap, with critical damping.
    contact |= {"solimp": [impedance, impedance, 0.001, 0.5, 2], "solref": [time, 1]}
    spec.option.timestep = time / 2
spec.option.gravity = [0, 0, 0]
spec.option.tolerance = 0
for number, sphere in enumerate(piled):
    body, place = spec.worldbody, sphere.place
    if not sphere.fixed:
        body, place = spec.worldbody.add_body(name=f"{number}", pos=sphere.place), [0, 0, 0]
        for axis in numpy.eye(3):
            body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    size = [sphere.radius, 0, 0]
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, name=f"{number}", pos=place, size=size, mass=sphere.mass, **contact)
model = spec.compile()
state = mujoco.MjData(model)
for number, sphere in enumerate(piled):
    if not sphere.fixed:
        # Gravity is off, so this force is the weight plus the load.
        state.body(f"{number}").xfrc_applied[2] = -sphere.down
mujoco.mj_step(model, state, STEPS)
mujoco.mj_forward(model, state)

rows = []
for number, touch in enumerate(state.contact):
    force = numpy.zeros(6)
    mujoco.mj_contactForce(model, state, number, force)
    pair = [int(model.geom(geom).name) for geom in touch.geom]
    # The first axis of the contact frame points from the first sphere to the second.
    rows.append((pair, -force[0] * touch.frame[:3]))
exported.write(folder / "mujoco.csv", rows)
print(f"MuJoCo {mujoco.__version__}: {len(rows)} contacts, fastest sphere {abs(state.qvel).max():.0e} m/s")

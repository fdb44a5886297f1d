"""MuJoCo: a pile built from arrays settles on its soft contacts, and its contact forces are verified.

    pip install ./python mujoco
    python mujoco_pile.py

MuJoCo does not solve for rigid contacts. Overlapping spheres repel each other, and the contacts become softer for an
impedance d further from 1 and for a longer time constant t. With default parameters the errors in this pile are 3·10⁻⁴,
with the parameters chosen here 10⁻⁸.
"""

import mujoco
import numpy as np

from cannonpile import Pile


def relax(pile, *, impedance=None, time=None, steps=1500):
    """Return the contacts of a pile at rest: ids, and forces on the first sphere of each."""
    radius, weight = float(pile.radius), float(pile.mass * pile.gravity)
    # Contacts without friction.
    contact = {"condim": 1}
    spec = mujoco.MjSpec()
    spec.option.gravity = [0, 0, 0]
    spec.option.tolerance = 0
    if impedance is not None:
        contact |= {"solimp": [impedance, impedance, 0.001, 0.5, 2], "solref": [time, 1]}
        spec.option.timestep = time / 2
    free = pile.sphere_count - pile.base_count
    for index, place in enumerate(pile.positions()):
        body, at = spec.worldbody, place
        if index < free:
            body, at = spec.worldbody.add_body(name=str(index + 1), pos=place), np.zeros(3)
            for axis in np.eye(3):
                body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
        sphere = mujoco.mjtGeom.mjGEOM_SPHERE
        body.add_geom(type=sphere, name=str(index + 1), pos=at, size=[radius, 0, 0], mass=float(pile.mass), **contact)
    model = spec.compile()
    state = mujoco.MjData(model)
    for index in range(free):
        state.body(str(index + 1)).xfrc_applied[2] = -weight
    mujoco.mj_step(model, state, steps)
    mujoco.mj_forward(model, state)
    ids, vectors = [], []
    for number, touch in enumerate(state.contact):
        force = np.zeros(6)
        mujoco.mj_contactForce(model, state, number, force)
        ids.append([int(model.geom(geom).name) for geom in touch.geom])
        # The first axis of the contact frame points from the first sphere to the second.
        vectors.append(-force[0] * touch.frame[:3])
    return np.array(ids), np.array(vectors)


pile = Pile(10, spacing="6/5")
ids, vectors = relax(pile)
pile.assert_close(ids, vectors=vectors, rtol=1e-3)
print(f"default parameters: {pile.compare(ids, vectors=vectors)}")

ids, vectors = relax(pile, impedance=0.9999, time=0.004)
pile.assert_close(ids, vectors=vectors, rtol=1e-6)
print(f"harder contacts: {pile.compare(ids, vectors=vectors)}")

# An error of 10⁻³ in one force is detected.
vectors[7] *= 1.001
try:
    pile.assert_close(ids, vectors=vectors, rtol=1e-6)
except AssertionError as error:
    print(f"detected as intended: {error}")
else:
    raise SystemExit("the wrong force was not detected")

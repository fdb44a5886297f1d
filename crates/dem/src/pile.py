# cannonpile: relaxes spheres.txt and writes the forces of its contacts to forces.csv.
# Run: yade -n -x pile.py
# Frictionless spheres on springs. The exact pile is rigid, so forces differ by about 1e-6 of the greatest.
import csv
import os
import sys

from yade import ymport

FIRST_ON_FLOOR = {first}  # ids of cannonpile start from 1; those of YADE from 0
STIFFNESS = {stiffness}  # N/m; a contact of two spheres has E*R
RADIUS = {radius}
REST = {rest}  # N, on a sphere: the effect of the rounding of coordinates
MAX_STEPS = {most_steps}
# Forces in addition to the weight, in N, by id: x, y and z (up).
LOADS = {loads}
# Masses other than that of an ordinary sphere, by id.
MASSES = {masses}


def folder_of_spheres():
    # YADE executes this script by exec, so __file__ is the path of YADE. The arguments contain the path of the script.
    for argument in sys.argv:
        folder = os.path.dirname(os.path.abspath(argument))
        if argument.endswith('.py') and os.path.exists(os.path.join(folder, 'spheres.txt')):
            return folder
    return os.getcwd()


here = folder_of_spheres()
material = FrictMat(young=STIFFNESS / RADIUS, poisson=0.3, frictionAngle=0.0, density={density})
O.materials.append(material)
ids = O.bodies.append(ymport.text(os.path.join(here, 'spheres.txt'), material=material))

for body_id in ids:
    body = O.bodies[body_id]
    number = body_id - ids[0] + 1
    if number >= FIRST_ON_FLOOR:
        body.state.blockedDOFs = 'xyzXYZ'
    else:
        body.state.blockedDOFs = '{blocked}'
        if number in LOADS:
            O.forces.setPermF(body_id, LOADS[number])
    if number in MASSES:
        body.state.mass = MASSES[number]

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys()],
        [Law2_ScGeom_FrictPhys_CundallStrack()],
    ),
    NewtonIntegrator(gravity={gravity}, damping=0.3),
]
O.dt = {timestep}


def at_rest():
    # unbalancedForce(True) is the greatest force on a sphere, divided by the mean contact force.
    forces = [contact.phys.normalForce.norm() for contact in O.interactions if contact.isReal]
    return not forces or unbalancedForce(True) * sum(forces) / len(forces) < REST


while O.iter < MAX_STEPS:
    O.run(1000, True)
    if at_rest():
        break
print('cannonpile: the pile is ' + ('at rest' if at_rest() else 'NOT at rest; run it longer, or the pile is unstable'))

with open(os.path.join(here, 'forces.csv'), 'w', newline='') as file:
    rows = csv.writer(file)
    rows.writerow(['id1', 'id2', 'force', 'fx', 'fy', 'fz'])
    for contact in O.interactions:
        if contact.isReal:
            numbers = [contact.id1 - ids[0] + 1, contact.id2 - ids[0] + 1]
            on_second = contact.phys.normalForce
            rows.writerow([*numbers, on_second.norm(), *-on_second])

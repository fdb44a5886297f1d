# cannonpile: two layers with friction on a rough floor. Relaxes spheres.txt, and writes the forces of its contacts to forces.csv
# and those of the floor on the spheres to floor.csv.
# Run: yade -n -x pile.py
# No degree of freedom is blocked in three dimensions. Any positive SHARE gives the same forces.
import csv
import math
import os
import sys

from yade import ymport

STIFFNESS = {stiffness}  # N/m; a contact of two spheres has E*R
SHARE = 0.3  # tangential over normal stiffness
RADIUS = {radius}
FRICTION, FLOOR_FRICTION = {friction}, {floor_friction}
REST = {rest}  # N, on a sphere: the effect of the rounding of coordinates
STEPS = {most_steps}  # that raise gravity; then at most as many until rest
GRAVITY = {gravity}
# Vertical forces in addition to the weight, in N, by id: x, y and z (up).
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
angles = [math.atan(FRICTION), math.atan(FLOOR_FRICTION)]
materials = [
    FrictMat(young=STIFFNESS / RADIUS, poisson=SHARE, frictionAngle=angle, density={density}) for angle in angles
]
for material in materials:
    O.materials.append(material)
ids = O.bodies.append(ymport.text(os.path.join(here, 'spheres.txt'), material=materials[0]))
floor = O.bodies.append(utils.wall(-RADIUS, axis=2, sense=1, material=materials[1]))
for body_id in ids:
    body = O.bodies[body_id]
    body.state.blockedDOFs = '{blocked}'
    if body_id - ids[0] + 1 in MASSES:
        body.state.mass = MASSES[body_id - ids[0] + 1]

newton = NewtonIntegrator(gravity=(0, 0, 0), damping=0.3)
# YADE would otherwise take the smaller of the two angles at the floor.
angle = MatchMaker(matches=[(0, 0, angles[0]), (0, 1, angles[1])])
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_FrictPhys(frictAngle=angle)],
        [Law2_ScGeom_FrictPhys_CundallStrack()],
    ),
    newton,
]
O.dt = {timestep}

# Gravity and loads are raised from 0, because a sudden start makes contacts slide.
for step in range(1, STEPS // 100 + 1):
    part = step / (STEPS // 100)
    newton.gravity = [part * component for component in GRAVITY]
    for number, load in LOADS.items():
        O.forces.setPermF(ids[0] + number - 1, Vector3(*load) * part)
    O.run(100, True)


def at_rest():
    # unbalancedForce(True) is the greatest force on a sphere, divided by the mean contact force.
    contacts = [contact.phys for contact in O.interactions if contact.isReal]
    forces = [(contact.normalForce + contact.shearForce).norm() for contact in contacts]
    return not forces or unbalancedForce(True) * sum(forces) / len(forces) < REST


while O.iter < 2 * STEPS:
    O.run(1000, True)
    if at_rest():
        break
print('cannonpile: the pile is ' + ('at rest' if at_rest() else 'NOT at rest; run it longer, or it has too little friction'))

with open(os.path.join(here, 'forces.csv'), 'w', newline='') as contacts, open(
    os.path.join(here, 'floor.csv'), 'w', newline=''
) as table:
    contacts, table = csv.writer(contacts), csv.writer(table)
    contacts.writerow(['id1', 'id2', 'force', 'fx', 'fy', 'fz', 'tx', 'ty', 'tz'])
    table.writerow(['id', 'fx', 'fy', 'fz'])
    for contact in O.interactions:
        if not contact.isReal:
            continue
        # YADE gives forces on the second body.
        normal, tangential = contact.phys.normalForce, contact.phys.shearForce
        numbers = [contact.id1 - ids[0] + 1, contact.id2 - ids[0] + 1]
        if floor not in (contact.id1, contact.id2):
            contacts.writerow([*numbers, normal.norm(), *-normal, *-tangential])
        elif contact.id1 == floor:
            table.writerow([numbers[1], *(normal + tangential)])
        else:
            table.writerow([numbers[0], *-(normal + tangential)])

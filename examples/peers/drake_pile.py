"""Drake: an exported pile of rigid spheres comes to rest on the springs of point contacts; forces.

    drake_pile.py FOLDER [STIFFNESS [SOLVER]]

writes FOLDER/drake.csv for `cannonpile verify`; the stiffness of a contact of two spheres is in mg/R, 1e7 where none is given;
the solver is kTamsi, kLagged, kSimilar or kSap.

What is left is the compliance of the springs: ten times as stiff, a tenth of the error. So says TAMSI, which is taken where none
is named; over some hundred spheres it does not converge, or takes long. kLagged, which Drake takes by itself, and its kin do
hundreds of spheres in seconds, and leave a noise of up to some 1e-6 that does not go with the stiffness. Contacts that are
stiff for the time step are softened by kSap, unless its threshold is set to 0.

The script is not called drake.py: Drake imports a module of that name.
"""

import math
import sys
from pathlib import Path

from pydrake.geometry import AddContactMaterial, ProximityProperties, Sphere
from pydrake.math import RigidTransform
from pydrake.multibody import plant as multibody
from pydrake.multibody.tree import SpatialInertia, UnitInertia
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder

import exported

# In sqrt(R/g).
STEP, UNTIL = 0.01, 3

folder = Path(sys.argv[1])
stiffness = float(sys.argv[2]) if len(sys.argv) > 2 else 1e7
solver = sys.argv[3] if len(sys.argv) > 3 else "kTamsi"
piled = exported.spheres(folder)
gravity = exported.gravity(folder)
unit = math.sqrt(piled[0].radius / gravity)

builder = DiagramBuilder()
plant, scene = multibody.AddMultibodyPlantSceneGraph(builder, STEP * unit)
plant.set_contact_model(multibody.ContactModel.kPoint)
plant.set_discrete_contact_approximation(getattr(multibody.DiscreteContactApproximation, solver))
plant.set_sap_near_rigid_threshold(0)
plant.mutable_gravity_field().set_gravity_vector([0, 0, -gravity])
properties = ProximityProperties()
# Of one sphere: those of two are put in series.
spring = 2 * stiffness * piled[0].mass * gravity / piled[0].radius
AddContactMaterial(0.0, spring, multibody.CoulombFriction(0.0, 0.0), properties)
numbers, bodies = {}, {}
for number, sphere in enumerate(piled):
    body, place = plant.world_body(), RigidTransform(sphere.place)
    if not sphere.fixed:
        # A load is heavy as what it weighs.
        inertia = SpatialInertia(sphere.down / gravity, [0, 0, 0], UnitInertia.SolidSphere(sphere.radius))
        body, place = plant.AddRigidBody(f"{number}", inertia), RigidTransform()
        bodies[number] = body
    shape = Sphere(sphere.radius)
    numbers[plant.RegisterCollisionGeometry(body, place, shape, f"{number}", properties)] = number
plant.Finalize()
simulator = Simulator(builder.Build())
state = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
for number, body in bodies.items():
    plant.SetFreeBodyPose(state, body, RigidTransform(piled[number].place))
simulator.AdvanceTo(UNTIL * unit)

results = plant.get_contact_results_output_port().Eval(state)
rows = []
for index in range(results.num_point_pair_contacts()):
    contact = results.point_pair_contact_info(index)
    touch = contact.point_pair()
    # Drake gives the force on the second.
    rows.append(((numbers[touch.id_A], numbers[touch.id_B]), -contact.contact_force()))
exported.write(folder / "drake.csv", rows)
print(f"Drake: {len(rows)} contacts, fastest sphere {abs(plant.GetVelocities(state)).max():.0e} m/s")

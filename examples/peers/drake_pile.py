"""Drake: relaxes an exported pile of spheres on point contacts with springs, and writes the contact forces.

    drake_pile.py FOLDER [STIFFNESS [SOLVER]]

writes FOLDER/drake.csv for `cannonpile verify`. STIFFNESS is the stiffness of a contact of two spheres, in mg/R (by default
1e7). SOLVER is kTamsi (the default), kLagged, kSimilar or kSap.

The error comes from the compliance of the springs, and is inversely proportional to the stiffness. TAMSI shows this, but it is
slow or does not converge for more than some hundred spheres. kLagged, the default of Drake, and related solvers relax hundreds
of spheres in seconds, with a noise of up to about 1e-6 that does not depend on the stiffness. kSap softens contacts that are
stiff for the time step, unless its threshold is 0.

The script is not called drake.py, because Drake imports a module of this name.
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

# The time step and the duration, in sqrt(R/g).
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
# The stiffness of one sphere. A contact has two such springs in series.
spring = 2 * stiffness * piled[0].mass * gravity / piled[0].radius
AddContactMaterial(0.0, spring, multibody.CoulombFriction(0.0, 0.0), properties)
numbers, bodies = {}, {}
for number, sphere in enumerate(piled):
    body, place = plant.world_body(), RigidTransform(sphere.place)
    if not sphere.fixed:
        # The mass of the body is (weight + load)/g, so that gravity exerts the load too.
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
    # Drake reports the force on the second sphere.
    rows.append(((numbers[touch.id_A], numbers[touch.id_B]), -contact.contact_force()))
exported.write(folder / "drake.csv", rows)
print(f"Drake: {len(rows)} contacts, fastest sphere {abs(plant.GetVelocities(state)).max():.0e} m/s")

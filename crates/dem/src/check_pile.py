# encoding: utf-8
# cannonpile {version}: a check against exact contact forces, in the style of scripts/checks-and-tests/checks of YADE.
# {title}
#
# Frictionless spheres relax from their exact positions on stiff springs, and the force of each contact is compared with the
# exact one. An unstable pile must lose contacts instead. Put this file beside the others for 'yade --check', or
# run it alone: yade -n -x checkPile.py
import sys

try:
	YadeCheckError
except NameError:
	# Outside of 'yade --check'.
	class YadeCheckError(Exception):
		pass


MUST_FALL = {falls}
TOLERANCE = {tolerance}  # relative to the greatest force; the springs cause less
FIRST_ON_FLOOR = {first}  # ids count from 1, layer after layer from the top
STIFFNESS = {stiffness}  # N/m; a contact of two spheres has E*R
RADIUS = {radius}  # m
REST = {rest}  # N, on a sphere: the effect of the rounding of coordinates
MAX_STEPS = {most_steps}
# Forces in addition to the weight, in N, by id: x, y and z (up).
LOADS = {loads}
# Masses other than that of an ordinary sphere, by id.
MASSES = {masses}
# Centres of the spheres 1, 2, ..., in m.
SPHERES = [
{spheres}]
# id1, id2, and the force between them in N, correctly rounded; a positive force is a push.
CONTACTS = [
{contacts}]


def buildPile():
	material = FrictMat(young=STIFFNESS / RADIUS, poisson=0.3, frictionAngle=0.0, density={density})
	O.materials.append(material)
	ids = O.bodies.append([sphere(centre, RADIUS, material=material) for centre in SPHERES])
	for number, bodyId in enumerate(ids, 1):
		body = O.bodies[bodyId]
		if number >= FIRST_ON_FLOOR:
			body.state.blockedDOFs = 'xyzXYZ'
		else:
			body.state.blockedDOFs = '{blocked}'
			if number in LOADS:
				O.forces.setPermF(bodyId, LOADS[number])
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
	return ids[0]


def measuredForces(firstBody):
	forces = {}
	for contact in O.interactions:
		pair = tuple(sorted((contact.id1 - firstBody + 1, contact.id2 - firstBody + 1)))
		# Contacts between two fixed bottom spheres are ignored.
		if contact.isReal and pair[0] < FIRST_ON_FLOOR:
			forces[pair] = contact.phys.normalForce.norm()
	return forces


def atRest():
	# unbalancedForce(True) is the greatest force on a sphere, divided by the mean contact force.
	forces = [contact.phys.normalForce.norm() for contact in O.interactions if contact.isReal]
	return not forces or unbalancedForce(True) * sum(forces) / len(forces) < REST


def checkPile():
	firstBody = buildPile()
	exact = {tuple(sorted(contact[:2])): contact[2] for contact in CONTACTS}
	greatest = max([abs(force) for force in exact.values()] + [sys.float_info.min])
	bearing = set(pair for pair, force in exact.items() if abs(force) > TOLERANCE * greatest)
	rest = False
	while O.iter < MAX_STEPS and not rest:
		O.run(1000, True)
		forces = measuredForces(firstBody)
		lost = bearing.difference(forces)
		if MUST_FALL and lost:
			print('checkPile: %d of %d contacts were lost, as expected' % (len(lost), len(bearing)))
			return
		rest = atRest()
	if MUST_FALL:
		raise YadeCheckError('checkPile: no contact was lost in %d steps, but some contacts need a tensile force' % O.iter)
	if not rest:
		raise YadeCheckError('checkPile: the pile is not at rest after %d steps' % O.iter)

	def error(pair):
		return abs(forces.get(pair, 0.0) - exact.get(pair, 0.0)) / greatest

	worst = max(set(forces) | set(exact), key=error, default=None)
	if worst is not None and error(worst) > TOLERANCE:
		raise YadeCheckError(
		        'checkPile: the force between spheres %d and %d is %.17g N, not %.17g N: the error is %.3g of the greatest force, more than %.3g' %
		        (worst + (forces.get(worst, 0.0), exact.get(worst, 0.0), error(worst), TOLERANCE))
		)
	print('checkPile: %d contacts agree, to %.3g of the greatest force' % (len(exact), error(worst) if worst else 0.0))


checkPile()

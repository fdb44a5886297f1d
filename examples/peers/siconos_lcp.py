"""Siconos: solves the contact problem of frictionless rigid spheres as a linear complementarity problem, with Lemke's method.

    siconos_lcp.py FOLDER

writes FOLDER/siconos.csv for `cannonpile verify`.

Spheres of mass m with weights w and contact forces f along the normals N have the accelerations (N^T f - w)/m. Contact forces
are compressive, contacts do not penetrate, and an opening contact has no force: 0 <= f, 0 <= N (N^T f - w)/m, and one of the two
is 0 in each contact. There is no stiffness and no time step, so the only error is rounding.
"""

import sys
from pathlib import Path

import numpy
import siconos.numerics as siconos

import exported

folder = Path(sys.argv[1])
piled = exported.spheres(folder)
pairs = exported.touching(piled)

normals = numpy.zeros((len(pairs), len(piled), 3))
for row, pair in enumerate(pairs):
    normals[row, pair[0]] = exported.normal(piled, pair)
    normals[row, pair[1]] = -normals[row, pair[0]]
normals[:, [sphere.fixed for sphere in piled]] = 0
normals = normals.reshape(len(pairs), -1)
masses = numpy.repeat([sphere.mass for sphere in piled], 3)
down = numpy.zeros((len(piled), 3))
down[:, 2] = [sphere.down for sphere in piled]

matrix = (normals / masses) @ normals.T
offset = -(normals / masses) @ down.ravel()
forces, opening = numpy.zeros(len(pairs)), numpy.zeros(len(pairs))
options = siconos.SolverOptions(siconos.SICONOS_LCP_LEMKE)
options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = 100 * len(pairs)
failed = siconos.linearComplementarity_driver(siconos.LCP(matrix, offset), forces, opening, options)
if failed:
    sys.exit(f"the solver of Siconos failed with status {failed}")
exported.write(folder / "siconos.csv", [(p, f * numpy.array(exported.normal(piled, p))) for p, f in zip(pairs, forces)])
print(f"Siconos: {len(pairs)} contacts, fastest opening {opening.max():.1e} m/s2")

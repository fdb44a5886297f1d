"""fclib: writes an exported pile as a contact problem with its exact forces as the solution, in one HDF5 file.

    fclib_pile.py FOLDER [FORCES]

writes FOLDER/pile.hdf5. FORCES is a table of forces, by default FOLDER/contacts.csv. The program fclib_merit.c reads the file
and computes the merit of the solution.

Each contact has a frame of its normal and two tangents. The accelerations of the contacts in their frames are u = W r + q, with
the forces r, W = H^T H/m and q = H^T (weights and loads)/m. Without friction, mu = 0, the tangential forces are 0. Solvers read
the problem from fclib_local. The group `solution` contains the forces for comparison.
"""

import csv
import sys
from pathlib import Path

import h5py
import numpy

import exported

folder = Path(sys.argv[1])
table = Path(sys.argv[2]) if len(sys.argv) > 2 else folder / "contacts.csv"
piled = exported.spheres(folder)
pairs = exported.touching(piled)

frames = []
for pair in pairs:
    normal = numpy.array(exported.normal(piled, pair))
    # A tangent perpendicular to the normal and to the coordinate axis with the largest angle to it.
    tangent = numpy.cross(normal, numpy.eye(3)[abs(normal).argmin()])
    tangent /= numpy.linalg.norm(tangent)
    frames.append([normal, tangent, numpy.cross(normal, tangent)])
frames = numpy.array(frames)

# H has a row for each contact and direction, and a column for each sphere and axis.
motion = numpy.zeros((len(pairs), 3, len(piled), 3))
for row, (one, other) in enumerate(pairs):
    motion[row, :, one] = frames[row]
    motion[row, :, other] = -frames[row]
motion[:, :, [sphere.fixed for sphere in piled]] = 0
motion = motion.reshape(3 * len(pairs), 3 * len(piled))
down = numpy.zeros((len(piled), 3))
down[:, 2] = [sphere.down for sphere in piled]
per_mass = motion / numpy.repeat([sphere.mass for sphere in piled], 3)
matrix, offset = per_mass @ motion.T, -per_mass @ down.ravel()

forces = numpy.zeros((len(pairs), 3))
rows = {pair: row for row, pair in enumerate(pairs)}
with open(table, newline="") as file:
    for line in csv.DictReader(file):
        one, other = int(line["id1"]) - 1, int(line["id2"]) - 1
        sign = 1 if one < other else -1
        row = rows[min(one, other), max(one, other)]
        forces[row] = frames[row] @ [sign * float(line[axis]) for axis in ("fx", "fy", "fz")]
forces = forces.ravel()

with h5py.File(folder / "pile.hdf5", "w") as file:
    local = file.create_group("fclib_local")
    # fclib reads each number as an array of length one.
    local["spacedim"] = numpy.array([3], "i4")
    # The matrix is in compressed columns, because fclib computes wrong merits for triplets.
    column, row = matrix.T.nonzero()
    starts = numpy.searchsorted(column, numpy.arange(len(matrix) + 1))
    numbers = {"nzmax": len(row), "m": len(matrix), "n": len(matrix), "nz": -1}
    for name, number in numbers.items():
        local[f"W/{name}"] = numpy.array([number], "i4")
    local["W/p"], local["W/i"], local["W/x"] = starts.astype("i4"), row.astype("i4"), matrix[row, column]
    local["vectors/q"], local["vectors/mu"] = offset, numpy.zeros(len(pairs))
    local["info/title"] = numpy.bytes_(f"{len(piled)} frictionless spheres, {len(pairs)} contacts")
    local["info/description"] = numpy.bytes_("a regular pile in equilibrium on a fixed bottom layer, exported by cannonpile")
    local["info/math_info"] = numpy.bytes_("the solution, if there is one, is unique: the pile is isostatic")
    file["solution/r"], file["solution/u"] = forces, matrix @ forces + offset
print(f"pile.hdf5: {len(pairs)} contacts, {len(row)} entries of W")

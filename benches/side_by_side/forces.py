"""All contact forces of a pile, in f0: exact ones, those of the sparse LU decomposition, and those of LAMMPS."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from fractions import Fraction
from pathlib import Path

import numpy as np
from equations import equations, sloping

# The numbers of the script for LAMMPS that depend on the stiffness: the stiffness itself, both dampings, the time step, and the
# net force at rest. Each is proportional to a power of the stiffness.
SCALED = [
    (r"(gran/hooke )(\S+)", 1.0),
    (r"(gran/hooke \S+ NULL )(\S+)", 0.5),
    (r"( viscous )(\S+)", 0.5),
    (r"(timestep +)(\S+)", -0.5),
    (r"(c_net<)([^)]+)", 1.0),
]


# No other program solves a pile with more contacts in a minute, and rational errors take time and memory.
MOST_CONTACTS = 500_000


def error(pile, forces):
    """Returns the largest error of a force, relative to the largest exact force: 0 if and only if all are exact.

    Returns `None` for the results of `Pile.multiples`, which are the reference, and for large piles."""
    if isinstance(forces, tuple) or pile.contact_count > MOST_CONTACTS:
        return None
    exact, denominator = pile.multiples()
    exact = [int(numerator) for numerator in exact]
    if len(forces) != len(exact):
        raise ValueError(f"{len(forces)} forces for {len(exact)} contacts")
    forces = forces if isinstance(forces[0], Fraction) else [Fraction(force) for force in forces.tolist()]
    most = max(abs(force * denominator - numerator) for force, numerator in zip(forces, exact))
    return float(most / max(map(abs, exact)))


def multiples(pile):
    return pile.multiples()


def floats(pile):
    return pile.forces("pile")


def flint(pile):
    """Solves the equations with python-flint, in a dense matrix of fractions."""
    import flint

    rows, columns, entries, totals = equations(pile, sloping(pile))
    matrix = flint.fmpq_mat(len(totals), len(totals))
    for row, column, entry in zip(rows.tolist(), columns.tolist(), entries.tolist()):
        matrix[row, column] = entry
    solved = matrix.solve(flint.fmpq_mat(len(totals), 1, totals.tolist()))
    return [Fraction(int(solved[n, 0].p), int(solved[n, 0].q)) for n in range(len(totals))]


def scipy_lu(pile):
    """Solves the equations with the sparse LU decomposition of SciPy (SuperLU)."""
    import scipy.sparse.linalg

    rows, columns, entries, totals = equations(pile, sloping(pile))
    matrix = scipy.sparse.csc_matrix((entries.astype(float), (rows, columns)))
    return scipy.sparse.linalg.splu(matrix).solve(totals.astype(float))


def lmp():
    """Returns the path of LAMMPS: that of the environment of this Python, or that of the system."""
    places = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
    found = shutil.which("lmp", path=places)
    if not found:
        raise ImportError("there is no lmp")
    return found


def lammps(pile, stiffness=1.0):
    """Relaxes the exported pile in LAMMPS on one thread. `stiffness` is a factor of the exported stiffness."""
    libraries = os.pathsep.join([f"{sys.prefix}/lib", os.environ.get("LD_LIBRARY_PATH", "")])
    with tempfile.TemporaryDirectory() as folder:
        pile.export(folder, "lammps")
        script = Path(folder) / "pile.in"
        text = script.read_text()
        for number, power in SCALED:
            text, count = re.subn(number, lambda found: f"{found[1]}{float(found[2]) * stiffness**power!r}", text)  # noqa: B023
            if count != 1:
                raise ValueError(f"pile.in has {count} places for {number}")
        script.write_text(text)
        environment = os.environ | {"LD_LIBRARY_PATH": libraries, "OMP_NUM_THREADS": "1"}
        command = [lmp(), "-in", "pile.in", "-screen", "none"]
        subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True)
        if "\ncannonpile: the pile is at rest" not in (Path(folder) / "log.lammps").read_text():
            raise ValueError("LAMMPS does not come to rest")
        table = np.loadtxt(Path(folder) / "forces.dump", skiprows=9, usecols=(0, 1, 2))
    return in_order(pile, table) / pile.unit_force


def in_order(pile, table):
    """Returns the forces of rows of two ids and a force, in the order of the contacts of the pile."""
    spheres = pile.sphere_count + 1

    def keys(pairs):
        pairs = np.sort(pairs.astype(np.int64), axis=1)
        return pairs[:, 0] * spheres + pairs[:, 1]

    measured = keys(table[:, :2])
    order = np.argsort(measured)
    found = order[np.searchsorted(measured, keys(pile.contact_ids()), sorter=order).clip(max=len(order) - 1)]
    if not np.array_equal(measured[found], keys(pile.contact_ids())):
        raise ValueError("a contact is missing")
    return table[found, 2]

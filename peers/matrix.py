#!/usr/bin/env python3
"""Solves exported linear systems with SciPy and python-flint, from their files alone: matrix.py FOLDER…

Each folder was written by `cannonpile export --to mtx`. The exact forces must solve a system of integers without any remainder, the
floats must be correctly rounded, and the singular values must be those of LAPACK within a relative error of 10⁻¹². A system in newtons
must have the solution of a sparse solver, and a condition number below its bound. Then one number of each file is changed, and the
script must notice it. The last line has the figures; the exit status is 1 if a check fails.
"""

import copy
import json
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import scipy
from flint import fmpq, fmpz_mat

TOLERANCE = 1e-12


def array(path):
    """Returns the numbers of a file of Matrix Market, and its comment. SciPy reads no integers beyond 64 bits."""
    header, comment, size, *lines = path.read_text().splitlines()
    assert header.startswith("%%MatrixMarket matrix array ") and size == f"{len(lines)} 1", path
    return [Fraction(line) for line in lines], comment


def read(folder):
    system = json.loads((folder / "properties.json").read_text())
    system["matrix"] = scipy.io.mmread(folder / "equilibrium.mtx").tocoo()
    system["loads"], comment = array(folder / "loads.mtx")
    assert comment.startswith(f"% b times {system['denominator']};"), comment
    system["floats"] = scipy.io.mmread(folder / "forces.mtx").ravel()
    system["exact"] = (folder / "forces_exact.txt").read_text().split("\n")[:-1]
    return system


def failures(system):
    """Returns the checks that fail, and the largest relative error of a singular value."""
    matrix, n, failed, error = system["matrix"], system["unknowns"], [], 0.0

    def check(holds, name):
        if not holds:
            failed.append(name)

    check(matrix.shape == (n, n) and matrix.nnz == system["entries"] and np.all(matrix.data != 0), "size")
    check(len(system["loads"]) == len(system["exact"]) == len(system["floats"]) == n, "rows")
    dense = matrix.toarray()
    if system["unit"] == "f0":
        exact = [Fraction(force) for force in system["exact"]]
        sides = [-load / int(system["denominator"]) for load in system["loads"]]
        for i, j, entry in zip(matrix.row, matrix.col, matrix.data):
            sides[i] += int(entry) * exact[j]
        check(matrix.data.dtype.kind == "i" and not any(sides), "exact forces")
        check([float(force) for force in exact] == list(system["floats"]), "rounded floats")
        whole = fmpz_mat([[int(entry) for entry in row] for row in dense])
        loads = fmpz_mat([[load.numerator] for load in system["loads"]])
        solved = whole.solve(loads) / fmpq(int(system["denominator"]))
        check(solved.entries() == [fmpq(force.numerator, force.denominator) for force in exact], "python-flint")
        base, power = map(int, system["determinant"].split("^"))
        check(whole.det() == base**power, "determinant")
    else:
        loads = np.array([float(load) for load in system["loads"]])
        solved = scipy.sparse.linalg.spsolve(matrix.tocsc(), loads)
        check(np.abs(solved - system["floats"]).max() < TOLERANCE * np.abs(solved).max(), "sparse solver")
    measured = scipy.linalg.svd(dense, compute_uv=False)
    condition = measured[0] / measured[-1]
    check(condition < system["condition_number_at_most"] * (1 + TOLERANCE), "bound of the condition number")
    if system["condition_number"]:
        listed = system["singular_values"]["list"]
        stated = np.repeat([value["float"] for value in listed], [value["multiplicity"] for value in listed])
        stated = np.sort(stated)[::-1]
        formulas = [eval(value["formula"], {"cos": np.cos, "pi": np.pi}) for value in listed]
        check(np.allclose(formulas, [value["float"] for value in listed], rtol=TOLERANCE, atol=0), "formulas")
        if len(stated) == n:
            error = np.abs(stated / measured - 1).max()
        check(len(stated) == n and error < TOLERANCE, "singular values")
        check(abs(condition / system["condition_number"]["float"] - 1) < TOLERANCE, "condition number")
    return failed, error


def planted(system):
    """Returns systems with one wrong number each, and the check that must fail."""
    cases = {
        "exact forces" if system["unit"] == "f0" else "sparse solver": lambda wrong: wrong["loads"].__setitem__(3, wrong["loads"][3] + 1),
        "size": lambda wrong: wrong.update(entries=wrong["entries"] + 1),
        "bound of the condition number": lambda wrong: wrong.update(condition_number_at_most=1.1),
    }
    if system["unit"] == "f0":
        cases["rounded floats"] = lambda wrong: wrong["floats"].__setitem__(2, np.nextafter(wrong["floats"][2], 9e9))
        cases["python-flint"] = lambda wrong: wrong["exact"].__setitem__(5, "1/17")
        cases["determinant"] = lambda wrong: wrong.update(determinant="2^1")
    if system["condition_number"]:
        cases["singular values"] = lambda wrong: wrong["singular_values"]["list"][-1].update(float=0.3)
    for name, change in cases.items():
        wrong = copy.deepcopy(system)
        change(wrong)
        yield name, wrong


def main():
    unknowns, largest, faults, good = 0, 0.0, 0, True
    for folder in map(Path, sys.argv[1:]):
        system = read(folder)
        failed, error = failures(system)
        unnoticed = [name for name, wrong in planted(system) if name not in failures(wrong)[0]]
        faults += sum(1 for _ in planted(system))
        unknowns, largest = unknowns + system["unknowns"], max(largest, error)
        digits = max(map(len, system["exact"]))
        print(f"{folder.name}: {system['unknowns']} unknowns, numbers of up to {digits} characters, singular values {error:.1e}")
        for name in failed:
            print(f"{folder.name}: {name}: wrong")
        for name in unnoticed:
            print(f"{folder.name}: {name}: a planted fault is not noticed")
        good &= not failed and not unnoticed
    print(f"{len(sys.argv) - 1} systems, {unknowns} unknowns, singular values within {largest:.1e}; {faults} planted faults noticed")
    sys.exit(not good)


main()

#!/usr/bin/env python3
"""Compares run times with those of programs that a user could take instead, for growing piles.

    pip install cannonpile python-flint scipy
    python3 benches/side_by_side.py [SECONDS]

Each method solves larger and larger piles, until one takes more than SECONDS (default: 60). A line gives the question, the method,
the layers and the seconds; the times include the assembly of the equations, but not the start of the interpreter. The results
of all methods are compared: exact ones must be equal, and floats agree within 1e-9 of the largest force.

* Exact contact forces of HCP piles: `Pile.multiples` and the exact solver of python-flint (dense matrices of fractions).
* The same in floats: `Pile.forces` and the sparse LU decomposition of SciPy.
* Both bounds of the normal force of a central bottom sphere of FCC piles at a = R: `Pile.bounds`, QSopt_ex (exact) and HiGHS in
  SciPy (floats). Without the program `esolver`, from the Debian package qsopt-ex, QSopt_ex is left out. """

import re
import shutil
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
from pathlib import Path

import flint
import numpy as np
import scipy.optimize
import scipy.sparse
import scipy.sparse.linalg
from cannonpile import Pile

# Offsets of horizontal neighbours, along i and j.
STEPS = [(1, 0), (0, 1), (1, -1)]


def places(pile):
    """Returns the integer coordinates of all spheres: thirds of both lattice vectors, and layers."""
    signs = [1 if k % 2 == 0 or pile.stacking == "fcc" else -1 for k in range(pile.layers)]
    back = np.concatenate([[0], np.cumsum(signs)])
    k, i, j = pile.sites().T
    return np.stack([3 * i - back[k], 3 * j - back[k], k], axis=1), k


def equations(pile, contacts):
    """Returns the equations of equilibrium: rows, columns, entries and right-hand sides. Forces are in mg/3 vertically."""
    at, k = places(pile)
    upper, lower = contacts
    free = np.cumsum(k < pile.layers - 1) - 1
    number = np.arange(len(upper))
    rows, columns, entries = [], [], []
    for end, by, moving in ((upper, lower, None), (lower, upper, k[lower] < pile.layers - 1)):
        kept = slice(None) if moving is None else moving
        apart = at[by[kept]] - at[end[kept]]
        for axis in range(3):
            rows.append(3 * free[end[kept]] + axis)
            columns.append(number[kept])
            entries.append(apart[:, axis])
    totals = np.zeros(3 * (free[-1] + 1), dtype=np.int64)
    totals[2::3] = 3
    return np.concatenate(rows), np.concatenate(columns), np.concatenate(entries), totals


def sloping(pile):
    return (pile.contact_ids() - 1).T


def by_flint(pile):
    rows, columns, entries, totals = equations(pile, sloping(pile))
    matrix = flint.fmpq_mat(len(totals), len(totals))
    for row, column, entry in zip(rows.tolist(), columns.tolist(), entries.tolist()):
        matrix[row, column] = entry
    solved = matrix.solve(flint.fmpq_mat(len(totals), 1, totals.tolist()))
    return [Fraction(int(solved[n, 0].p), int(solved[n, 0].q)) for n in range(len(totals))]


def by_scipy(pile):
    rows, columns, entries, totals = equations(pile, sloping(pile))
    matrix = scipy.sparse.csc_matrix((entries.astype(float), (rows, columns)))
    return scipy.sparse.linalg.splu(matrix).solve(totals.astype(float))


def touching(pile):
    """Returns all contacts at a = R: the sloping ones, and those of neighbours above the floor."""
    upper, lower = sloping(pile)
    sites = {tuple(site): number for number, site in enumerate(pile.sites().tolist())}
    beside = [
        (number, sites.get((k, i + di, j + dj)))
        for (k, i, j), number in sites.items()
        for di, dj in STEPS
        if k < pile.layers - 1
    ]
    one, other = np.array([pair for pair in beside if pair[1] is not None]).reshape(-1, 2).T
    return np.concatenate([upper, one]), np.concatenate([lower, other])


def centre(layers):
    return (layers - 1) // 3, (layers - 1) // 3


def program(layers):
    """Returns the equations over all contacts, and the contacts of the central bottom sphere."""
    pile = Pile(layers, spacing=1)
    contacts = touching(pile)
    sites = {tuple(site): number for number, site in enumerate(pile.sites().tolist())}
    bottom = sites[(layers - 1, *centre(layers))]
    return equations(pile, contacts), np.flatnonzero(contacts[1] == bottom)


def by_highs(layers):
    (rows, columns, entries, totals), borne = program(layers)
    matrix = scipy.sparse.csr_matrix((entries.astype(float), (rows, columns)))
    cost = np.zeros(matrix.shape[1])
    cost[borne] = 1 / 3
    found = [scipy.optimize.linprog(sign * cost, A_eq=matrix, b_eq=totals, method="highs") for sign in (1, -1)]
    return 1 + found[0].fun, 1 - found[1].fun


def by_qsopt(layers):
    (rows, columns, entries, totals), borne = program(layers)
    terms = [[] for _ in totals]
    for row, column, entry in zip(rows.tolist(), columns.tolist(), entries.tolist()):
        terms[row].append(f"{entry:+d} m{column}" if entry else "")
    balance = [f" r{n}: {' '.join(filter(None, row))} = {total}" for n, (row, total) in enumerate(zip(terms, totals.tolist()))]
    values = []
    with tempfile.TemporaryDirectory() as folder:
        file, answer = Path(folder) / "pile.lp", Path(folder) / "pile.sol"
        for sense in ("Minimize", "Maximize"):
            goal = " + ".join(f"m{n}" for n in borne)
            file.write_text("\n".join([f"{sense}\n goal: {goal}", "Subject To", *balance, "End"]) + "\n")
            subprocess.run(["esolver", "-L", "-O", answer, file], check=True, capture_output=True)
            values.append(1 + Fraction(re.search(r"Value = (\S+)", answer.read_text())[1]) / 3)
    return tuple(values)


def by_bounds(layers):
    bounds = Pile(layers, spacing=1).bounds(*centre(layers))
    return bounds.least, bounds.greatest


def same_multiples(one, other):
    (numerators, denominator), fractions = one, other
    return [Fraction(int(n), denominator) for n in numerators] == fractions


def same_floats(one, other):
    return bool(np.max(np.abs(np.array(one, float) - other)) <= 1e-9 * np.max(np.abs(other)))


def hcp(layers):
    return Pile(layers, "hcp")


QUESTIONS = [
    # The name, the argument, the sizes, the methods, and the comparison with the first method.
    ("exact_forces", hcp, [4, 6, 8, 10, 12, 14, 16, 20, 30, 60, 100, 150], [("cannonpile", Pile.multiples), ("python-flint", by_flint)], same_multiples),
    ("float_forces", hcp, [10, 20, 30, 40, 60, 80, 100, 200, 300], [("cannonpile", lambda pile: pile.forces("pile")), ("SciPy LU", by_scipy)], same_floats),
    ("bounds", int, [4, 7, 10, 13, 16, 19, 22, 25, 31], [("cannonpile", by_bounds), ("QSopt_ex", by_qsopt), ("SciPy HiGHS", by_highs)], same_floats),
]


def main():
    limit = float(sys.argv[1]) if len(sys.argv) > 1 else 60.0
    for question, argument, sizes, methods, same in QUESTIONS:
        ours = {}
        for method, solve in methods:
            if method == "QSopt_ex" and not shutil.which("esolver"):
                print(f"{question} {method}: left out, there is no esolver", file=sys.stderr)
                continue
            for layers in sizes:
                asked = argument(layers)
                began = time.perf_counter()
                answer = solve(asked)
                seconds = time.perf_counter() - began
                if layers in ours and not same(ours[layers], answer):
                    sys.exit(f"{question} {method} {layers}: the results differ")
                if method == "cannonpile":
                    ours[layers] = answer
                print(f"{question:13} {method:13} {layers:4} layers {seconds:10.4f} s", flush=True)
                if seconds > limit:
                    break


if __name__ == "__main__":
    main()

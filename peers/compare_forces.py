"""Compares measured forces of a code with springs with the exact ones, relative to the largest force.

Usage: compare_forces.py MEASURED CONTACTS [ACCEPTED], a LAMMPS dump or a csv with id1, id2 and force, and contacts.csv of the
export with its spheres.csv beside it. All forces must agree to 1e-5 of the largest force, or to ACCEPTED. Open contacts must
have no force.

compare_forces.py MEASURED SPHERES ACCEPTED compares a LAMMPS dump of `compute stress/atom` with the csv of `cannonpile spheres
--stress` in the same way. LAMMPS counts tension as positive.
"""

import csv
import sys
from pathlib import Path

ACCEPTED = 1e-5


COMPONENTS = ["xx", "yy", "zz", "xy", "xz", "yz"]


def last_rows(path):
    """Returns the rows of the last snapshot of a dump, or of a csv."""
    lines = Path(path).read_text().splitlines()
    heads = [n for n, line in enumerate(lines) if line.startswith(("ITEM: ENTRIES", "ITEM: ATOMS"))]
    if heads:
        names, rows = lines[heads[-1]].split()[2:], [line.split() for line in lines[heads[-1] + 1 :]]
    else:
        names, *rows = csv.reader(lines)
    return [dict(zip(names, row)) for row in rows]


def measured(path):
    """Returns the forces of a dump or csv, by pair of numbers."""
    rows = last_rows(path)
    return {frozenset((int(float(row["id1"])), int(float(row["id2"])))): float(row["force"]) for row in rows}


def compare_stresses(dump, spheres, accepted):
    """Compares the six components of each sphere, relative to the largest one."""
    found = {row["id"]: [-float(row[f"c_stress[{n}]"]) for n in range(1, 7)] for row in last_rows(dump)}
    exact = {row["id"]: [float(row.get(f"stress_{part}", 0)) for part in COMPONENTS] for row in spheres}
    greatest = max(abs(part) for parts in exact.values() for part in parts)
    errors = {n: max(abs(a - b) for a, b in zip(exact[n], found[n], strict=True)) / greatest for n in exact | found}
    worst = max(errors, key=errors.get)
    print(f"stresses of {len(exact)} spheres: largest error {errors[worst]:.1e} relative to the largest, at sphere {worst}")
    return 0 if errors[worst] <= float(accepted) else 1


def main(forces, contacts, accepted=ACCEPTED):
    contacts = Path(contacts)
    rows = last_rows(contacts)
    if "stress_xx" in rows[0]:
        return compare_stresses(forces, rows, accepted)
    with open(contacts.with_name("spheres.csv")) as file:
        fixed = {int(row["id"]) for row in csv.DictReader(file) if row["fixed"] == "1"}
    exact = {frozenset((int(row["id1"]), int(row["id2"]))): float(row["force"]) for row in rows}
    horizontal = sum("-" in row["direction"] for row in rows)
    found = {pair: force for pair, force in measured(forces).items() if not pair <= fixed}
    greatest = max(exact.values())
    errors = {pair: abs(found.get(pair, 0.0) - exact.get(pair, 0.0)) / greatest for pair in exact.keys() | found.keys()}
    worst = max(errors, key=errors.get)
    print(f"{len(exact)} contacts, {horizontal} of them horizontal, and {len(found.keys() - exact.keys())} open ones:")
    print(f"largest error {errors[worst]:.1e} relative to the largest force, at spheres {sorted(worst)}")
    return 0 if errors[worst] <= float(accepted) else 1


sys.exit(main(*sys.argv[1:]))

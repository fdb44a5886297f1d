"""Compares measured forces of a code with springs with the exact ones, relative to the largest force.

Usage: compare_forces.py MEASURED CONTACTS [ACCEPTED], a LAMMPS dump or a csv with id1, id2 and force, and contacts.csv of the
export with its spheres.csv beside it. All forces must agree to 1e-5 of the largest force, or to ACCEPTED. Open contacts must
have no force.
"""

import csv
import sys
from pathlib import Path

ACCEPTED = 1e-5


def measured(path):
    """Returns the forces of the last snapshot of a dump, by pair of numbers."""
    lines = path.read_text().splitlines()
    heads = [n for n, line in enumerate(lines) if line.startswith("ITEM: ENTRIES")]
    if heads:
        names, rows = lines[heads[-1]].split()[2:], [line.split() for line in lines[heads[-1] + 1 :]]
    else:
        names, *rows = csv.reader(lines)
    rows = [dict(zip(names, row)) for row in rows]
    return {frozenset((int(float(row["id1"])), int(float(row["id2"])))): float(row["force"]) for row in rows}


def main(forces, contacts, accepted=ACCEPTED):
    contacts = Path(contacts)
    with open(contacts) as file:
        rows = list(csv.DictReader(file))
    with open(contacts.with_name("spheres.csv")) as file:
        fixed = {int(row["id"]) for row in csv.DictReader(file) if row["fixed"] == "1"}
    exact = {frozenset((int(row["id1"]), int(row["id2"]))): float(row["force"]) for row in rows}
    horizontal = sum("-" in row["direction"] for row in rows)
    found = {pair: force for pair, force in measured(Path(forces)).items() if not pair <= fixed}
    greatest = max(exact.values())
    errors = {pair: abs(found.get(pair, 0.0) - exact.get(pair, 0.0)) / greatest for pair in exact.keys() | found.keys()}
    worst = max(errors, key=errors.get)
    print(f"{len(exact)} contacts, {horizontal} of them horizontal, and {len(found.keys() - exact.keys())} open ones:")
    print(f"largest error {errors[worst]:.1e} relative to the largest force, at spheres {sorted(worst)}")
    return 0 if errors[worst] <= float(accepted) else 1


sys.exit(main(*sys.argv[1:]))

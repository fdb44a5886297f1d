"""Compares simulated forces of two layers with friction with the exact ones.

usage: python .ci/friction.py CANNONPILE FOLDER CONTACTS FLOOR SCENE...

CONTACTS and FLOOR are the tables that the exported script wrote into FOLDER: csv, or dumps of LAMMPS. SCENE are the options of
the export. Contacts are found by their points. The script prints the largest error over the largest force, and fails if it
exceeds 1e-5, or if a contact or a sphere is missing.
"""

import csv
import json
import subprocess
import sys

binary, folder, contacts, floor, *scene = sys.argv[1:]


def exact(command, *options):
    output = subprocess.run([binary, command, *scene, *options, "--number", "f64", "--format", "json"], capture_output=True, check=True)
    return json.loads(output.stdout)


def measured(name):
    """Returns the rows of a table."""
    with open(f"{folder}/{name}", newline="") as file:
        if name.endswith(".csv"):
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
        lines = file.read().splitlines()
    heads = [n for n, line in enumerate(lines) if line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES"))]
    keys = lines[heads[-1]].split()[2:]
    return [dict(zip(keys, map(float, line.split()))) for line in lines[heads[-1] + 1 :]]


def centres():
    """Returns the exact centres by id, from the exported positions."""
    try:
        with open(f"{folder}/spheres.txt") as file:
            return {number: tuple(map(float, line.split()[:3])) for number, line in enumerate(file, 1)}
    except FileNotFoundError:
        with open(f"{folder}/pile.data") as file:
            rows = file.read().split("Atoms # sphere")[1].split("\n")
        rows = [line.split() for line in rows if line]
        return {int(row[0]): tuple(map(float, row[4:7])) for row in rows}


place = centres()
radius = min(sum((a - b) ** 2 for a, b in zip(place[1], place[n])) for n in place if n != 1) ** 0.5 / 2
by_point = {}
for contact in exact("contacts", "--units", "si"):
    by_point[tuple(round(contact[axis] / radius, 6) + 0.0 for axis in "xyz")] = contact
spheres = {}
forces, errors, met = [], [], set()
for row in measured(contacts):
    ids = [int(row["id1"]), int(row["id2"])]
    first, second = (place[number] for number in ids)
    point = tuple(round((a + b) / 2 / radius, 6) + 0.0 for a, b in zip(first, second))
    if point not in by_point:
        sys.exit(f"the spheres {ids} touch, but have no contact in the exact pile")
    met.add(point)
    contact = by_point[point]
    # The exact vectors are forces on the upper sphere.
    sign = 1 if first[2] > second[2] else -1
    for kind, names in (("n", ("fx", "fy", "fz")), ("t", ("tx", "ty", "tz"))):
        for axis, name in zip("xyz", names):
            forces.append(abs(contact[kind + axis]))
            errors.append(abs(sign * row[name] - contact[kind + axis]))
if len(met) != len(by_point):
    sys.exit(f"{len(by_point) - len(met)} contacts are missing")
on_floor = {int(row["id"]): [row["fx"], row["fy"], row["fz"]] for row in measured(floor)}
lowest = min(z for _, _, z in place.values())
bottom = sorted(number for number, (_, _, z) in place.items() if z - lowest < radius / 10)
rows = exact("base", "--units", "si")
if len(rows) != len(bottom):
    sys.exit(f"{len(bottom)} spheres on the floor, not {len(rows)}")
# Ids are in the order of rows.
for number, row in zip(bottom, rows):
    expected = [-row["friction_x"], -row.get("friction_y", 0.0), row["normal"]]
    forces += map(abs, expected)
    errors += [abs(a - b) for a, b in zip(on_floor[number], expected)]
error = max(errors) / max(forces)
print(f"{len(met)} contacts and {len(bottom)} spheres on the floor: largest error {error:.1e} of the largest force")
if not all(error <= 1e-5 * max(forces) for error in errors):
    sys.exit("the forces are wrong")

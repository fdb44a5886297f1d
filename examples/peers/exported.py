"""Reads the spheres of an exported pile, finds the pairs that touch from the positions, and writes a table for `verify`.

The solvers that import this module use nothing else of cannonpile: no list of contacts, no force, no equation. Only
fclib_pile.py also reads the exact forces, for comparison.
"""

import csv
import math
import tomllib
from collections import namedtuple
from fractions import Fraction
from pathlib import Path

# `place` is the centre in m. `down` is the weight plus the load, in N.
Sphere = namedtuple("Sphere", "place radius mass down fixed")


def gravity(folder):
    """Returns g of scene.toml, in m/s²."""
    with open(Path(folder) / "scene.toml", "rb") as file:
        return float(Fraction(tomllib.load(file)["gravity"]))


def spheres(folder):
    """Returns the spheres of spheres.csv, numbered from 0."""
    with open(Path(folder) / "spheres.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    pull, read = gravity(folder), []
    for row in rows:
        mass = float(row["mass"])
        if mass == 0:
            raise SystemExit("spheres without mass cannot move: export the pile without --weightless")
        place = [float(row[axis]) for axis in "xyz"]
        read.append(Sphere(place, float(row["radius"]), mass, mass * pull + float(row["load"]), row["fixed"] == "1"))
    return read


def touching(piled):
    """Returns the pairs that touch, except pairs of fixed spheres, by a search in cells of 1.1 diameters."""
    diameter = 2 * piled[0].radius
    cells = {}
    for number, sphere in enumerate(piled):
        cells.setdefault(tuple(math.floor(c / (1.1 * diameter)) for c in sphere.place), []).append(number)
    near = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    found = []
    for cell, members in cells.items():
        others = [other for step in near for other in cells.get(tuple(map(sum, zip(cell, step))), [])]
        for one in members:
            for other in others:
                apart = math.dist(piled[one].place, piled[other].place)
                if one < other and apart < diameter * (1 + 1e-9) and not (piled[one].fixed and piled[other].fixed):
                    found.append((one, other))
    return sorted(found)


def normal(piled, pair):
    """Returns the unit vector of the contact force on the first sphere of a pair."""
    one, other = (piled[number].place for number in pair)
    apart = math.dist(one, other)
    return [(a - b) / apart for a, b in zip(one, other)]


def write(path, rows):
    """Writes the table for `verify` from rows (pair, force on the first sphere)."""
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["id1", "id2", "fx", "fy", "fz"])
        for (one, other), force in rows:
            table.writerow([one + 1, other + 1, *(repr(float(f)) for f in force)])

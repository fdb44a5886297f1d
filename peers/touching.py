"""The spheres of an exported pile at a = R and the pairs that touch, computed from their positions.

Programs that use this module take nothing else from the library: no direction, no sign, no equation.
"""

import csv
import math
from collections import namedtuple
from fractions import Fraction
from pathlib import Path

# `place` are x, y, z in radii; `weight` is in mg, with the load; `site` is (i, j).
Sphere = namedtuple("Sphere", "place weight fixed site")


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def spheres(folder):
    """Returns the spheres of spheres.csv, indexed by id - 1."""
    read = []
    for row in table(Path(folder) / "spheres.csv"):
        radius, mass = float(row["radius"]), float(row["mass"])
        place = [float(row[axis]) / radius for axis in "xyz"]
        # The load is a force in N, which equals mg for the default g = 1 m/s².
        weight = 1 + Fraction(row["load"]) / Fraction(mass)
        read.append(Sphere(place, weight, row["fixed"] == "1", (int(row["i"]), int(row["j"]))))
    return read


def pairs(all_spheres):
    """Returns the pairs (upper, lower) that touch, without pairs of fixed spheres; cells are a little wider than a diameter."""
    cells = {}
    for number, sphere in enumerate(all_spheres):
        cells.setdefault(tuple(math.floor(c / 2.1) for c in sphere.place), []).append(number)
    found = []
    for number, sphere in enumerate(all_spheres):
        x, y, z = (math.floor(c / 2.1) for c in sphere.place)
        near = [(x + a, y + b, z + c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1)]
        for other in (other for cell in near for other in cells.get(cell, []) if other > number):
            distance = math.dist(sphere.place, all_spheres[other].place)
            if distance < 2 - 1e-9:
                raise SystemExit(f"FAILED: spheres {number + 1} and {other + 1} overlap")
            if distance < 2 + 1e-9 and not (sphere.fixed and all_spheres[other].fixed):
                found.append((number, other))
    return found


def bounds(path):
    """Returns the smallest and largest normal force by site, and whether both are attained."""
    return {
        (int(row["i"]), int(row["j"])): (Fraction(row["normal_min"]), Fraction(row["normal_max"]), row["proved"] == "yes")
        for row in table(path)
    }

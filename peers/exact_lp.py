"""Checks the bounds of base normal forces with an exact linear program, which QSopt_ex solves in rationals.

Usage: exact_lp.py FOLDER BOUNDS, with the folder of `cannonpile export --to csv --spacing 1` and the csv file of
`cannonpile bounds`; exact_lp.py FOLDER, for an unstable pile.

At a = R all positions have integer coordinates (a, b, k) in thirds of the two lattice vectors and in layers, and all contacts
have the same length. A contact force has components mu da, mu db and mu dk, with the integer differences of the coordinates
of its spheres. So the equations of equilibrium have integer coefficients: sum mu da = sum mu db = 0 and sum mu dk = w.
"""

import math
import re
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

from touching import bounds, pairs, spheres


def integers(place):
    """Returns the position in thirds of (0, 2) and (sqrt(3), 1), and in layers of height sqrt(8/3), all in radii."""
    x, y, z = place
    b = x / math.sqrt(3)
    numbers = (3 * (y - b) / 2, 3 * b, z / math.sqrt(8 / 3))
    whole = [round(number) for number in numbers]
    if any(abs(number - one) > 1e-6 for number, one in zip(numbers, whole)):
        raise SystemExit(f"FAILED: {place} is not a lattice position")
    return whole


class Program:
    """The linear program over all contact forces mu >= 0 that balance the free spheres."""

    def __init__(self, all_spheres, folder):
        self.all_spheres, self.touching, self.folder = all_spheres, pairs(all_spheres), folder
        places = [integers(sphere.place) for sphere in all_spheres]
        balance = {number: [{}, {}, {}] for number, sphere in enumerate(all_spheres) if not sphere.fixed}
        self.bearing = {number: [] for number, sphere in enumerate(all_spheres) if sphere.fixed}
        for name, (one, other) in enumerate(self.touching):
            for end, by in ((one, other), (other, one)):
                if end in balance:
                    for equation, here, there in zip(balance[end], places[end], places[by]):
                        equation[name] = here - there
                else:
                    self.bearing[end].append(name)
        self.rows = []
        for number, equations in balance.items():
            weight = all_spheres[number].weight
            for equation, total in zip(equations, (0, 0, weight)):
                terms = "".join(f" {c * weight.denominator:+d} m{name}" for name, c in equation.items() if c)
                self.rows.append(f" r{len(self.rows)}:{terms} = {total * weight.denominator}")

    def extreme(self, sense, number):
        """Returns the smallest or largest sum of mu on a bottom sphere, or None if there is no equilibrium."""
        goal = " + ".join(f"m{name}" for name in self.bearing[number]) or "0 m0"
        file, answer = (Path(self.folder) / name for name in ("pile.lp", "pile.sol"))
        lines = [f"{sense}\n goal: {goal}", "Subject To", *self.rows, "End"]
        file.write_text("\n".join(lines) + "\n")
        answer.unlink(missing_ok=True)
        run = subprocess.run(["esolver", "-L", "-O", answer, file], capture_output=True, text=True, timeout=300)
        solution = answer.read_text() if answer.exists() else ""
        status = re.search(r"status\s*=?\s*(\w+)", solution, re.IGNORECASE)
        if status and status[1].upper() == "INFEASIBLE":
            return None
        value = re.search(r"Value = (\S+)", solution)
        if not (status and status[1].upper() == "OPTIMAL" and value):
            raise SystemExit(f"FAILED: esolver finds neither an optimum nor infeasibility: {solution[:200]}{run.stderr[-500:]}")
        return Fraction(value[1])


def main(folder, file=None):
    all_spheres = spheres(folder)
    with tempfile.TemporaryDirectory() as scratch:
        program = Program(all_spheres, scratch)
        if file is None:
            if program.extreme("Minimize", next(iter(program.bearing))) is not None:
                raise SystemExit("FAILED: an unstable pile has an equilibrium")
            print(f"{len(all_spheres)} spheres have no equilibrium")
            return
        claimed = bounds(file)
        if len(claimed) != len(program.bearing):
            raise SystemExit(f"FAILED: {len(claimed)} bounds for {len(program.bearing)} bottom spheres")
        for number in program.bearing:
            least, greatest, attained = claimed[all_spheres[number].site]
            weight = all_spheres[number].weight
            exact = [weight + program.extreme(sense, number) for sense in ("Minimize", "Maximize")]
            if exact != [least, greatest] and (attained or not least <= exact[0] <= exact[1] <= greatest):
                raise SystemExit(f"FAILED: {all_spheres[number].site} has bounds {exact[0]} to {exact[1]}, not {least} to {greatest}")
    print(f"{2 * len(claimed)} bounds agree with QSopt_ex: {len(all_spheres)} spheres, {len(program.touching)} contacts")


main(*sys.argv[1:])

#!/usr/bin/env python3
"""Has Coq check that the engines put every force in its place: placement.py CANNONPILE FOLDER few|all JOBS.

FOLDER has the compiled files of `cannonpile prove --to coq`, up to Placement. For each pile, CANNONPILE computes all forces once,
under loads 1, B, B², …: a power of B = 2^20 for gravity, for each component of its tilt, and for each component of the load
on each sphere. So one force is a number with one digit for each load, the coefficient of this load. The script reads the
digits and writes them as a table. Coq must accept the table (`places`), by `vm_compute`. Then its digits are the linear form of the
force, for all loads (`placed`). Coq must refuse changed tables.

`all` takes every stacking of up to six layers under small tops, and of small bases; `few` takes a part of them. The exit status is 1
if Coq rejects a table, or accepts a changed one. JOBS is the number of files that Coq
checks in parallel.
"""

import csv
import itertools
import math
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from pathlib import Path

BITS = 20
DIGITS = BITS // 4
STEPS = {"+": ((0, 0), (1, 0), (0, 1)), "-": ((0, 0), (-1, 0), (0, -1))}
LINES = ("alpha", "beta", "gamma")


class Pile:
    """A pile under a top or on a base, with the signs of its steps from the top."""

    def __init__(self, shape, signs):
        self.shape, self.signs = shape, signs
        side, kind = int(shape.split(":")[1]) - 1, shape.split(":")[0].split()[-1]
        self.bounds = (-side, side) if kind == "hexagon" else (0, side)
        within = range(self.bounds[0], self.bounds[1] + 1)
        layer = {(i, j) for i in within for j in within if i + j in within}
        self.layers = [layer]
        self.grows_down = shape.startswith("top")
        for sign in signs if self.grows_down else reversed(signs):
            layer = self.layers[-1]
            steps = STEPS[sign]
            if self.grows_down:
                layer = {(i + a, j + b) for i, j in layer for a, b in steps}
            else:
                layer = {(i, j) for i, j in layer if all((i + a, j + b) in layer for a, b in steps)}
            self.layers.append(layer)
        if not self.grows_down:
            self.layers.reverse()

    def spheres(self):
        """Returns the spheres above the floor, and those on it, in the order of Coq."""
        sites = [(k, i, j) for k, layer in enumerate(self.layers) for i, j in sorted(layer)]
        floor = len(self.layers) - 1
        return [p for p in sites if p[0] < floor], [p for p in sites if p[0] == floor]


def computed(binary, pile, work):
    """Returns the coefficients of all forces: {load: {(sphere, part): coefficient}}. A load is a sphere and an axis."""
    above, floor = pile.spheres()
    loads = [(at, axis) for at in (None, *above, *floor) for axis in range(3)]
    power = {load: 1 << BITS * n for n, load in enumerate(loads)}
    # Gravity is the first digit, because mg is the unit of forces.
    scene = work / "scene.toml"
    tilt = ",".join(str(power[None, 1 + n]) for n in range(2))
    load = ", ".join(
        f'"{k},{i},{j}={power[at, 0]},{power[at, 1]},{power[at, 2]}"' for at in (*above, *floor) for k, i, j in (at,)
    )
    stacking = pile.signs if pile.grows_down else pile.signs[::-1]
    where = pile.shape.split()
    lines = [f'{where[0]} = "{where[1]}"', f"layers = {len(pile.layers)}", f'tilt = "{tilt}"', f"load = [{load}]"]
    if stacking:
        lines.append(f'stacking = "{stacking}"')
    scene.write_text("\n".join(lines) + "\n")
    run = lambda command: csv.DictReader(
        subprocess.run(
            [binary, command, "--scene", str(scene), "--format", "csv"], check=True, capture_output=True, text=True
        ).stdout.splitlines()
    )
    forces = {}
    if above:
        for row in run("contacts"):
            forces[(int(row["k"]), int(row["i"]), int(row["j"])), LINES.index(row["direction"])] = Fraction(row["force"])
    for row in run("base"):
        at = len(pile.layers) - 1, int(row["i"]), int(row["j"])
        for part, name in enumerate(("shear_x", "shear_y", "normal")):
            forces[at, part] = Fraction(row[name])
    assert set(forces) == {(at, part) for at in (*above, *floor) for part in range(3)}, "other spheres"
    found = {load: {} for load in loads}
    # Each sign change divides by 3, and so do the forces on the floor. Their shears are halves.
    scale = 2 * 3 ** len(pile.layers)
    # With this sum every digit is positive.
    half = sum(1 << BITS * n + BITS - 1 for n in range(len(loads)))
    for place, force in forces.items():
        assert scale % force.denominator == 0, "another denominator"
        digits = f"{int(force * scale) + half:0{DIGITS * len(loads)}x}"
        assert len(digits) == DIGITS * len(loads), "a force is not a sum of digits"
        for n, load in enumerate(loads, 1):
            end = len(digits) - DIGITS * (n - 1)
            digit = int(digits[end - DIGITS : end], 16) - (1 << BITS - 1)
            if digit:
                found[load][place] = Fraction(digit, scale)
    # A load on a bottom sphere acts on the floor below it only. The theorem `placed` adds it, so no table has it.
    for at in floor:
        for axis, part in enumerate((2, 0, 1)):
            assert found[at, axis] == {(at, part): 1}, "a load on a bottom sphere acts elsewhere"
    return found


def effect(column, floor):
    """Returns the forces under one unit load, for Coq."""
    scale = math.lcm(1, *(value.denominator for value in column.values()))
    parts = {}
    for (at, part), value in column.items():
        parts.setdefault(at, [0, 0, 0])[part] = int(value * scale)
    below, on_floor = [], []
    for at, numbers in parts.items():
        (on_floor if at[0] == floor else below).append("At " + " ".join(f"({n})" if n < 0 else str(n) for n in (*at, *numbers)))
    return f"(effect_of {scale} [{';'.join(below)}] [{';'.join(on_floor)}])"


def columns(pile, found):
    """Returns the table of a pile, for Coq."""
    above, _ = pile.spheres()
    floor = len(pile.layers) - 1
    # The axis of gravity, the first one here, is z.
    effects = lambda at: " ".join(effect(found[at, axis], floor) for axis in (1, 2, 0))
    return "[" + ";\n".join(f"Column ({k}, ({i}, {j})) {effects((k, i, j))}" for k, i, j in above) + "]"


def statements(pile, found, name):
    """Returns the statements that the table of a pile is right, and the forces under gravity and its tilts."""
    signs = "; ".join("Plus" if sign == "+" else "Minus" for sign in pile.signs)
    bounds = " ".join(f"(Three ({bound}) ({bound}) ({bound}))" for bound in pile.bounds)
    floor = len(pile.layers) - 1
    answers = (
        f"answers pile{name} (fun _ => {unit}) {effect(found[None, axis], floor)} = true"
        for unit, axis in (("unit_x", 1), ("unit_y", 2), ("unit_z", 0))
    )
    return f"""Definition pile{name} := bare [{signs}] {str(pile.grows_down).lower()} {bounds}.
Definition table{name} : list column := {columns(pile, found)}.
Lemma loads{name} : places pile{name} table{name} = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
""" + "".join(
        f"Lemma gravity{name}_{n} : {answer}.\nProof. vm_cast_no_check (eq_refl true). Qed.\n" for n, answer in enumerate(answers)
    )


def refusals(pile, found):
    """Returns the statements that wrong tables of `pile` are refused: one number, contact, sphere or load is wrong."""
    above, _ = pile.spheres()
    one, other = (above[0], 0), (above[1], 0)
    column = found[one]
    (at, part), value = next((place, value) for place, value in column.items() if place[0] != above[0])
    contact = (at, next(n for n in range(3) if column.get((at, n), 0) != value))
    next_to = next(p for p in above if p[0] == at[0] and p != at)
    turn = {at: next_to, next_to: at}
    wrong = {
        "one coefficient": {one: {**column, (at, part): value + Fraction(1, 3**9)}},
        "a missing coefficient": {one: {place: value for place, value in column.items() if place != (at, part)}},
        "two exchanged contacts": {one: {**column, (at, part): column.get(contact, Fraction(0)), contact: value}},
        "two exchanged spheres": {one: {(turn.get(p, p), n): value for (p, n), value in column.items()}},
        "two exchanged loads": {one: found[other], other: column},
        "two exchanged axes": {one: found[above[0], 1], (above[0], 1): column},
        "a shear on the floor": {one: {**column, (pile.spheres()[1][0], 0): Fraction(1, 3**9)}},
    }
    return "".join(
        f"(* {name} *)\nLemma refused{n} : places pile0 {columns(pile, {**found, **changed})} = false.\n"
        "Proof. vm_cast_no_check (eq_refl false). Qed.\n"
        for n, (name, changed) in enumerate(wrong.items())
    )


# Tops and bases, with the greatest number of layers.
SHAPES = {"top hexagon:1": 6, "top triangle:2": 6, "top hexagon:2": 6, "base triangle:6": 6, "base hexagon:3": 4}


def piles(shape, selection):
    """Yields every stacking. `few` takes those of up to five layers under one sphere, and two of each other shape."""
    for signs in itertools.chain.from_iterable(itertools.product("+-", repeat=steps) for steps in range(SHAPES[shape])):
        pile = Pile(shape, "".join(signs))
        if selection == "few" and (len(signs) > 4 if shape == "top hexagon:1" else pile.signs not in ("+-", "-++")):
            continue
        # A base may be too small for a stacking.
        if all(pile.layers):
            yield pile


HEADER = """From Coq Require Import ZArith QArith List.
From Cannonpile Require Import Directions Checker Placement.
Import ListNotations.
Open Scope Z_scope.
"""


def main():
    binary, folder, selection, jobs = sys.argv[1:]
    folder = Path(folder).resolve()
    with tempfile.TemporaryDirectory() as work, ThreadPoolExecutor(int(jobs)) as pool:
        work = Path(work)

        def accept(text):
            """Has Coq check statements, in a file of its own."""
            with tempfile.TemporaryDirectory() as own:
                (Path(own) / "placed.v").write_text(HEADER + text)
                command = ["coqc", "-noglob", "-Q", str(folder), "Cannonpile", "placed.v"]
                run = subprocess.run(command, cwd=own, capture_output=True, text=True)
            if run.returncode:
                raise RuntimeError(f"{run.stderr}\n{text[:200]}")

        for shape in SHAPES:
            texts, count, coefficients = [""], 0, 0
            for count, pile in enumerate(piles(shape, selection), 1):
                found = computed(binary, pile, work)
                coefficients += sum(map(len, found.values()))
                texts[-1] += statements(pile, found, count)
                # Coq starts slowly, so a file has several piles.
                if len(texts[-1]) > 200_000:
                    texts.append("")
            list(pool.map(accept, texts))
            print(f"{shape}: {count} piles, {coefficients} coefficients", flush=True)
        pile = Pile("top triangle:2", "+-")
        found = computed(binary, pile, work)
        wrong = refusals(pile, found)
        accept(statements(pile, found, 0) + wrong)
        print(f"changed tables: {wrong.count('Lemma')} refused")


main()

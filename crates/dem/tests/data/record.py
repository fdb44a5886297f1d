#!/usr/bin/env python3
"""Runs LAMMPS and YADE on exported piles with one fault each, and keeps the tables here: `record.py [NAME…]`.

It needs `cannonpile`, `lmp` and `yade` in the search path; peers/run shows how to install them.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
SCENE = "--layers 4 --spacing 1.2"
# Far more steps than the exported script takes, for spheres that first fall into their places.
LONGER = (r"(?m)^(run +)([1-9]\d+)$", lambda run: run[1] + str(60 * int(run[2])))


def columns(**factors):
    """Returns a change of the data file: diameter and density of some atoms, or of all, times a factor."""

    def change(atom):
        for name, (ids, factor) in factors.items():
            if int(atom[0]) in ids:
                place = {"diameter": 2, "density": 3}[name]
                atom[place] = repr(float(atom[place]) * factor)

    return change


def friction(coefficient):
    return (r"gran/hooke (\S+) NULL (\S+) NULL 0.0 0", rf"gran/hooke/history \1 NULL \2 NULL {coefficient} 0")


ALL = range(1, 100)
# The scene, changes of the script, and a change of each atom.
LAMMPS = {
    "right": (SCENE, [], None),
    "gravity": (SCENE, [("gravity 1.0 vector", "gravity 9.81 vector")], None),
    "springs": (SCENE, [(r"(gran/hooke )(\S+)", lambda k: k[1] + repr(float(k[2]) / 100)), LONGER], None),
    "digits": ("--layers 4 --spacing 1.3", [("%.17g", "%.6g")], None),
    "diameter": (SCENE, [LONGER], columns(diameter=([6], 1.0001))),
    "diameters": (SCENE, [LONGER], columns(diameter=(ALL, 1.0001))),
    "spacing": ("--layers 4 --spacing 1.25", [], None),
    "mass": (SCENE, [], columns(density=(ALL, 0.5))),
    "stopped": (SCENE, [(r"(?m)^run +[1-9]\d+$", "run 100")], None),
    "unstable": ("--layers 6 --stacking hcp --spacing 1.2", [], None),
    "friction": (SCENE, [friction(0.5)], None),
    "axes": (SCENE, [(r"c_forces\[3\] c_forces\[4\]", "c_forces[4] c_forces[3]")], None),
    "second": (SCENE, [(r"c_pairs\[1\] c_pairs\[2\]", "c_pairs[2] c_pairs[1]")], None),
    "layer": (SCENE, [(r"(compute +(pairs|forces) )all", r"\1mobile")], None),
    "floor": ("--layers 2 --floor rough", [("write_dump +all custom", "group some id 1 2 3\nwrite_dump some custom")], None),
    "rotation": ("--layers 2 --floor rough", [("nve/sphere", "nve")], None),
    "leaning": (SCENE, [("gravity 1.0 vector 0 0 -1", "gravity 1.0 vector 0.05 0 -1")], None),
    "double": (SCENE, [], columns(density=([6], 2.0))),
}
# Friction, in YADE, whose table has the whole forces.
YADE = {
    "whole": (
        SCENE,
        [
            ("frictionAngle=0.0", "frictionAngle=0.4636"),
            ("body.state.blockedDOFs = 'XYZ'", "body.state.blockedDOFs = ''"),
            ("on_second = contact.phys.normalForce", r"\g<0> + contact.phys.shearForce"),
            (r"on_second.norm\(\)", "contact.phys.normalForce.norm()"),
        ],
    ),
}


def changed(text, changes):
    for pattern, by in changes:
        text, count = re.subn(pattern, by, text)
        assert count, pattern
    return text


def run(name, folder, program, scene, changes, change=None):
    subprocess.run(["cannonpile", "export", folder, "--to", program, *scene.split()], check=True, stdout=subprocess.DEVNULL)
    script = folder / {"lammps": "pile.in", "yade": "pile.py"}[program]
    script.write_text(changed(script.read_text(), changes))
    if change:
        head, atoms = (folder / "pile.data").read_text().split("Atoms # sphere\n\n")
        atoms = [atom.split() for atom in atoms.splitlines()]
        for atom in atoms:
            change(atom)
        (folder / "pile.data").write_text(f"{head}Atoms # sphere\n\n" + "".join(" ".join(atom) + "\n" for atom in atoms))
    command = {"lammps": ["lmp", "-in", "pile.in", "-screen", "none"], "yade": ["yade", "-n", "-x", "pile.py"]}[program]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    for table, end in (("forces", ""), ("floor", "-floor")):
        for file in folder.glob(f"{table}.*"):
            shutil.copy(file, HERE / f"{name}{end}{file.suffix}")


for program, runs in (("lammps", LAMMPS), ("yade", YADE)):
    for name, arguments in runs.items():
        if name in sys.argv[1:] or not sys.argv[1:]:
            with tempfile.TemporaryDirectory() as folder:
                run(name, Path(folder) / "pile", program, *arguments)

"""Runs pile.py of a folder on a stand-in for YADE, which is not on PyPI: it keeps what it is told and computes nothing.

What it says: the script runs to its end, blocks the floor, puts loads where they belong and writes the ids that
contacts.csv has. What it does not say: that YADE agrees. Usage: stand_in_for_yade.py FOLDER
"""

import csv
import sys
import types
from pathlib import Path

folder = Path(sys.argv[1])


class Thing(types.SimpleNamespace):
    """Anything that takes any arguments."""

    def __init__(self, *_, **options):
        super().__init__(**options)


class Bodies(list):
    def append(self, bodies):
        first = len(self)
        self.extend(bodies)
        return list(range(first, len(self)))


class Scene:
    def __init__(self):
        self.bodies, self.materials, self.iter, self.loads = Bodies(), [], 0, {}
        self.forces = Thing(setPermF=self.loads.__setitem__)

    def run(self, steps, wait):
        assert wait
        self.iter += steps

    @property
    def interactions(self):
        with open(folder / "contacts.csv", newline="") as file:
            for row in csv.DictReader(file):
                force = float(row["force"])
                normal = Thing(norm=lambda force=force: force)
                ids = [int(row[column]) - 1 for column in ("id1", "id2")]
                yield Thing(id1=ids[0], id2=ids[1], isReal=True, phys=Thing(normalForce=normal))
        yield Thing(id1=0, id2=0, isReal=False)


def spheres(path, material):
    rows = [list(map(float, line.split())) for line in open(path)]
    assert all(len(row) == 4 for row in rows)
    return [Thing(state=Thing(blockedDOFs="", mass=None), place=row, material=material) for row in rows]


yade = types.ModuleType("yade")
yade.ymport = Thing(text=spheres)
sys.modules["yade"] = yade
engines = """FrictMat ForceResetter InsertionSortCollider Bo1_Sphere_Aabb InteractionLoop Ig2_Sphere_Sphere_ScGeom
Ip2_FrictMat_FrictMat_FrictPhys Law2_ScGeom_FrictPhys_CundallStrack NewtonIntegrator"""
scene = Scene()
names = dict.fromkeys(engines.split(), Thing) | {"O": scene, "unbalancedForce": lambda: 0.0}
script = folder / "pile.py"
exec(compile(script.read_text(), str(script), "exec"), names | {"__file__": str(script)})

with open(folder / "spheres.csv", newline="") as file:
    rows = list(csv.DictReader(file))
assert len(rows) == len(scene.bodies)
for row, body in zip(rows, scene.bodies):
    assert ("xyz" in body.state.blockedDOFs) == (row["fixed"] == "1"), row
with open(folder / "contacts.csv", newline="") as file:
    wanted = [[row["id1"], row["id2"], float(row["force"])] for row in csv.DictReader(file)]
with open(folder / "forces.csv", newline="") as file:
    found = [[row["id1"], row["id2"], float(row["force"])] for row in csv.DictReader(file)]
assert found == wanted
print(f"pile.py runs on a stand-in for YADE: {len(rows)} spheres, {len(scene.loads)} loads, {len(found)} contacts")

"""Reads spheres.vtp and contacts.vtp of a folder with VTK and with an XML parser, and compares them with the csv files.

The numbers of points, vertices and lines must agree, and all arrays with a csv column must agree to the last digit. Weights and
loads must sum to the reaction of the floor. Usage: read_vtp.py FOLDER
"""

import csv
import math
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkCommand
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def require(condition, message):
    if not condition:
        sys.exit(f"FAILED: {message}")


def read(path, points, vertices, lines):
    require(ElementTree.parse(path).getroot().tag == "VTKFile", f"{path} is not XML with the root VTKFile")
    reader = vtkXMLPolyDataReader()
    errors = []
    reader.AddObserver(vtkCommand.ErrorEvent, lambda *_: errors.append("VTK reports an error"))
    reader.SetFileName(str(path))
    reader.Update()
    require(not errors, f"{path}: {errors}")
    data = reader.GetOutput()
    counts = data.GetNumberOfPoints(), data.GetNumberOfVerts(), data.GetNumberOfLines()
    require(counts == (points, vertices, lines), f"{path} has {counts} points, vertices and lines, not {points, vertices, lines}")
    return data


def arrays(attributes):
    return {attributes.GetArrayName(n): vtk_to_numpy(attributes.GetArray(n)) for n in range(attributes.GetNumberOfArrays())}


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def same(name, found, wanted):
    found, wanted = list(map(float, found)), list(map(float, wanted))
    require(found == wanted, f"{name}: {[pair for pair in zip(found, wanted) if pair[0] != pair[1]][:1] or (len(found), len(wanted))}")


def check_spheres(folder, spheres):
    data = read(folder / "spheres.vtp", len(spheres), len(spheres), 0)
    centres, found = vtk_to_numpy(data.GetPoints().GetData()), arrays(data.GetPointData())
    for axis, name in enumerate("xyz"):
        same(name, centres[:, axis], [row[name] for row in spheres])
    for name, column in (("id", "id"), ("layer", "k"), ("radius", "radius")):
        same(name, found[name], [row[column] for row in spheres])
    # base.csv has the forces on the floor, with normal forces positive downwards. The reactions are opposite to them.
    # Spheres above the floor have the reaction zero.
    base, reactions = iter(table(folder / "base.csv")), []
    for row in spheres:
        felt = next(base) if row["fixed"] == "1" else {"shear_x": 0, "normal": 0}
        reactions += [-float(felt["shear_x"]), -float(felt.get("shear_y", 0)), float(felt["normal"])]
    same("reaction", found["reaction"].ravel(), reactions)
    if "stress" in found:
        for name, columns in {"xx": [0], "yy": [4], "zz": [8], "xy": [1, 3], "xz": [2, 6], "yz": [5, 7]}.items():
            for column in columns:
                same(f"stress_{name}", found["stress"][:, column], [row.get(f"stress_{name}", 0) for row in spheres])
    carried = math.fsum(found["weight"]) + math.fsum(found["load"])
    pushed = math.fsum(found["reaction"][:, 2])
    require(math.isclose(carried, pushed, rel_tol=1e-12), f"weights and loads of {carried} N, reactions of {pushed} N")


def check_contacts(folder, spheres, contacts):
    n = len(contacts)
    data = read(folder / "contacts.vtp", 2 * n, 0, n)
    cells, points = arrays(data.GetCellData()), arrays(data.GetPointData())
    for name in ["id1", "id2", "force"]:
        same(name, cells[name], [row[name] for row in contacts])
    for axis, name in enumerate(["fx", "fy", "fz"]):
        same(name, cells["force_vector"][:, axis], [row[name] for row in contacts])
    require(set(cells["direction"]) <= {0, 1, 2}, "directions")
    same("force at the ends", points["force"], [row["force"] for row in contacts for _ in range(2)])
    # Each line connects the centres of its spheres, from the upper to the lower one.
    lines = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(n, 2)
    ends = vtk_to_numpy(data.GetPoints().GetData())[lines]
    for end, column in enumerate(["id1", "id2"]):
        for axis, name in enumerate("xyz"):
            same(f"{name} of {column}", ends[:, end, axis], [spheres[int(row[column]) - 1][name] for row in contacts])


def main(folder):
    spheres, contacts = table(folder / "spheres.csv"), table(folder / "contacts.csv")
    check_spheres(folder, spheres)
    check_contacts(folder, spheres, contacts)
    print(f"{len(spheres)} spheres and {len(contacts)} contacts read by VTK, the same to the last digit")


main(Path(sys.argv[1]))

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


def read(path):
    require(ElementTree.parse(path).getroot().tag == "VTKFile", f"{path} is not XML with the root VTKFile")
    reader = vtkXMLPolyDataReader()
    errors = []
    reader.AddObserver(vtkCommand.ErrorEvent, lambda *_: errors.append("VTK reports an error"))
    reader.SetFileName(str(path))
    reader.Update()
    require(not errors, f"{path}: {errors}")
    return reader.GetOutput()


def require(condition, message):
    if not condition:
        sys.exit(f"FAILED: {message}")


def arrays(attributes):
    names = [attributes.GetArrayName(place) for place in range(attributes.GetNumberOfArrays())]
    return {name: vtk_to_numpy(attributes.GetArray(name)) for name in names}


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def same(name, found, wanted):
    found, wanted = list(map(float, found)), list(map(float, wanted))
    require(len(found) == len(wanted), f"{name}: {len(found)} numbers, not {len(wanted)}")
    for place, (number, exact) in enumerate(zip(found, wanted)):
        require(number == exact, f"{name}: number {place} is {number!r}, not {exact!r}")


def check_spheres(folder, spheres):
    data = read(folder / "spheres.vtp")
    n = len(spheres)
    require(data.GetNumberOfPoints() == n, f"{data.GetNumberOfPoints()} points, not {n}")
    require(data.GetNumberOfVerts() == n, f"{data.GetNumberOfVerts()} vertices, not {n}")
    require(data.GetNumberOfLines() == 0, "lines among the spheres")
    centres = vtk_to_numpy(data.GetPoints().GetData())
    for axis, name in enumerate("xyz"):
        same(name, centres[:, axis], [row[name] for row in spheres])
    found = arrays(data.GetPointData())
    same("id", found["id"], [row["id"] for row in spheres])
    same("layer", found["layer"], [row["k"] for row in spheres])
    same("radius", found["radius"], [row["radius"] for row in spheres])
    require(len(found["weight"]) == n and len(found["load"]) == n, "weights and loads")
    # base.csv has the forces on the floor, with normal forces positive downwards. The reactions are opposite to them.
    # Spheres above the floor have the reaction zero.
    base = iter(table(folder / "base.csv"))
    reactions = []
    for row in spheres:
        force = [0.0, 0.0, 0.0]
        if row["fixed"] == "1":
            felt = next(base)
            shear_y = float(felt.get("shear_y", 0))
            force = [-float(felt["shear_x"]), -shear_y, float(felt["normal"])]
        reactions.extend(force)
    same("reaction", found["reaction"].ravel(), reactions)
    if "stress" in found:
        for name, columns in {"xx": [0], "yy": [4], "zz": [8], "xy": [1, 3], "xz": [2, 6], "yz": [5, 7]}.items():
            for column in columns:
                same(f"stress_{name}", found["stress"][:, column], [row.get(f"stress_{name}", 0) for row in spheres])
    carried = math.fsum(found["weight"]) + math.fsum(found["load"])
    pushed = math.fsum(found["reaction"][:, 2])
    require(math.isclose(carried, pushed, rel_tol=1e-12), f"weights and loads of {carried} N, reactions of {pushed} N")
    return n


def check_contacts(folder, spheres):
    data = read(folder / "contacts.vtp")
    contacts = table(folder / "contacts.csv")
    n = len(contacts)
    require(data.GetNumberOfPoints() == 2 * n, f"{data.GetNumberOfPoints()} points, not {2 * n}")
    require(data.GetNumberOfLines() == n, f"{data.GetNumberOfLines()} lines, not {n}")
    require(data.GetNumberOfVerts() == 0, "vertices among the contacts")
    cells, points = arrays(data.GetCellData()), arrays(data.GetPointData())
    for column, name in [("id1", "id1"), ("id2", "id2"), ("force", "force")]:
        same(name, cells[name], [row[column] for row in contacts])
    for axis, name in enumerate(["fx", "fy", "fz"]):
        same(name, cells["force_vector"][:, axis], [row[name] for row in contacts])
    require(set(cells["direction"]) <= {0, 1, 2}, "directions")
    same("force at the ends", points["force"], [row["force"] for row in contacts for _ in range(2)])
    # Each line connects the centres of its spheres, from the upper to the lower one.
    if n:
        lines = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(n, 2)
        ends = vtk_to_numpy(data.GetPoints().GetData())[lines]
        for end, column in enumerate(["id1", "id2"]):
            joined = [spheres[int(row[column]) - 1] for row in contacts]
            for axis, name in enumerate("xyz"):
                same(f"{name} of {column}", ends[:, end, axis], [row[name] for row in joined])
    return n


def main():
    folder = Path(sys.argv[1])
    spheres = table(folder / "spheres.csv")
    points, lines = check_spheres(folder, spheres), check_contacts(folder, spheres)
    print(f"{points} spheres and {lines} contacts read by VTK, the same to the last digit")


main()

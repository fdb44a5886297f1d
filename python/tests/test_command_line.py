"""Comparison with the command line, number by number: tables, files and verdicts."""

from fractions import Fraction

import numpy as np
import pytest

import cannonpile
from cannonpile import Pile

from piles import ALL

EXACT = ["--number=exact"]
NEAREST = ["--number=f64", "--units=si"]


def site(row):
    return int(row["k"]), int(row["i"]), int(row.get("j", 0))


def contacts(table, options, *words):
    """Return the rows of the table of contacts in the order of contacts.csv: sloping contacts first."""
    return sorted(table("contacts", options, *words), key=lambda row: "-" in row["direction"])


def test_contacts(table, options, pile):
    rows = contacts(table, options, *EXACT)
    multiples = pile.multiples()
    forces = [Fraction(int(numerator), multiples.denominator) for numerator in multiples.numerators]
    assert [Fraction(row["force"]) for row in rows] == forces
    for row, force in zip(rows, forces, strict=True):
        assert pile.force(*site(row), row["direction"]) == force


def test_contacts_in_newtons(table, options, pile):
    rows = contacts(table, options, *NEAREST)
    assert [float(row["force"]) for row in rows] == pile.forces().tolist()
    if pile.dimension == 3:
        columns = {name: np.array([float(row[name]) for row in rows]) for name in ("fx", "fy", "fz", "x", "y", "z") if rows}
        for array, names in ((pile.vectors(), ("fx", "fy", "fz")), (pile.contact_points(), ("x", "y", "z"))):
            for axis, name in enumerate(names if rows else ()):
                assert array[:, axis].tolist() == columns[name].tolist(), name


def test_spheres(table, options, pile):
    rows = table("spheres", options, "--number=f64")
    axes = [axis for axis in "xyz" if axis in rows[0]]
    places = np.array([[float(row[axis]) for axis in axes] for row in rows])
    assert pile.positions()[:, ["xyz".index(axis) for axis in axes]].tolist() == places.tolist()
    assert [tuple(at) for at in pile.sites().tolist()] == [site(row) for row in rows]
    assert [pile.sphere_id(*site(row)) for row in rows] == [int(row["id"]) for row in rows]


def test_stresses(table, options, pile):
    rows = table("spheres", options, "--stress", *NEAREST)
    names = [f"stress_{axes}" for axes in ("xx", "yy", "zz", "xy", "xz", "yz")]
    assert pile.stresses().tolist() == [[float(row.get(name, 0)) for name in names] for row in rows]


def test_base(table, options, pile):
    rows = table("base", options, *EXACT)
    for row in rows:
        force = pile.on_floor(int(row["i"]), int(row.get("j", 0)))
        assert force.normal == Fraction(row["normal"])
        assert force.shear_x == Fraction(row["shear_x"])
        assert force.shear_y == Fraction(row.get("shear_y", 0))
    rows = table("base", options, *NEAREST)
    names = ["normal", "shear_x", "shear_y"]
    assert pile.base().tolist() == [[float(row.get(name, 0)) for name in names] for row in rows]


def test_summary(table, options, pile):
    # The summary does not depend on the state.
    [row] = table("summary", {name: value for name, value in options.items() if name not in ("state", "stiffness_ratio")})
    assert (pile.layers, pile.sphere_count, pile.base_count) == tuple(
        int(row[name]) for name in ("layers", "spheres", "base_spheres")
    )
    assert pile.weight == Fraction(row["weight"])
    if "state" not in options:
        assert pile.contact_count == int(row["contacts"])
        assert {True: "yes", False: "no", None: ""}[pile.stands] == row["stands"]
    if pile.weakest() and "state" not in options:
        assert pile.weakest().force == Fraction(row["min_contact"])


@pytest.mark.parametrize("name", ["straight", "hexagon", "loads on hcp"])
def test_bounds(table, name):
    options = {name: value for name, value in ALL[name].items() if name not in ("top", "loads")}
    pile = Pile(**options)
    for row in table("bounds", options):
        bounds = pile.bounds(int(row["i"]), int(row["j"]))
        assert bounds.least == Fraction(row["normal_min"])
        assert bounds.greatest == Fraction(row["normal_max"])
        assert bounds.proved is (row["proved"] == "yes")


def test_exported_files(table, tmp_path, options, pile):
    # The ids of contacts match those in the files for simulations.
    names = pile.export(tmp_path, "csv", "lammps")
    assert {"spheres.csv", "contacts.csv", "pile.in", "scene.toml"} <= set(names) == {path.name for path in tmp_path.iterdir()}
    ids = np.genfromtxt(tmp_path / "contacts.csv", delimiter=",", names=True, dtype=None, encoding="utf-8", ndmin=1)
    if pile.contact_count:
        assert np.column_stack([ids["id1"], ids["id2"]]).tolist() == pile.contact_ids().tolist()
        assert ids["force"].tolist() == pile.forces().tolist()
    assert Pile.from_toml((tmp_path / "scene.toml").read_text()) == pile


def test_means(table):
    rows = table("mean", {"layers": 5}, "--fault-probability=1/3")
    means = cannonpile.mean(5, fault_probability="1/3")
    names = ["a", "b", "probability", "normal", "shear_x", "shear_y"]
    assert [tuple(mean) for mean in means] == [tuple(Fraction(row[name]) for name in names) for row in rows]


def test_census(table):
    for words, options in (([], {}), (["--standing"], {"standing": True})):
        rows = table("census", {"layers": 6}, *words)
        entries = list(cannonpile.census(6, **options))
        assert [entry.stacking for entry in entries] == [row["stacking"] for row in rows]
        assert [entry.stands for entry in entries] == [row["stands"] == "yes" for row in rows]


@pytest.mark.parametrize(
    "options",
    [
        {"layers": 2},
        {"layers": 2, "dimension": 2, "spacing": "4/3"},
        {"layers": 2, "top": "hexagon:2", "loads": {(0, 0, 0): "5/2"}, "mass": "1e-3", "gravity": "9.81"},
    ],
    ids=str,
)
def test_rough_floor(table, options):
    rough = Pile(**options).on_rough_floor("1/2")
    [row] = table("summary", options, "--floor=rough", "--friction=1/2", "--units=si")
    assert (row["friction_needed"], row["floor_friction_needed"]) == (
        rough.exact_friction_needed,
        rough.exact_floor_friction_needed,
    )
    assert row["stands"] == ("yes" if rough.stands else "no")
    rows = table("contacts", options, "--floor=rough", *EXACT)
    assert [(Fraction(row["normal"]), Fraction(row["tangential"])) for row in rows] == [
        (contact.normal, contact.tangential) for contact in rough.contacts()
    ]
    rows = table("contacts", options, "--floor=rough", *NEAREST)
    for vectors, names in ((rough.normal_vectors(), "nx ny nz"), (rough.tangential_vectors(), "tx ty tz")):
        assert vectors.tolist() == [[float(row[name]) for name in names.split()] for row in rows]
    rows = table("base", options, "--floor=rough", *NEAREST)
    names = ["normal", "friction_x", "friction_y"][: options.get("dimension", 3)]
    assert rough.base()[:, : len(names)].tolist() == [[float(row[name]) for name in names] for row in rows]


def test_theorems(table):
    rows = table("prove", {})
    theorems = cannonpile.prove()
    assert [(theorem.name, theorem.statement) for theorem in theorems] == [(row["name"], row["statement"]) for row in rows]


def test_cases(table):
    rows = table("cases", {})
    cases = [(case, case.pile) for case in cannonpile.cases()] + [(case, case.rough_floor.pile) for case in cannonpile.friction_cases()]
    cases.sort(key=lambda pair: int(pair[0].name[1:]))
    assert [case.name for case, _ in cases] == [row["name"] for row in rows]
    assert [case.known.title for case, _ in cases] == [row["title"] for row in rows]
    assert [str(pile.sphere_count) for _, pile in cases] == [row["spheres"] for row in rows]


def test_differences_are_detected(table):
    # Wrong gravity, a wrong row, a wrong pile.
    rows = table("contacts", {"layers": 4, "gravity": "9.81"}, *NEAREST)
    assert [float(row["force"]) for row in rows] != Pile(4).forces().tolist()
    rows = table("spheres", {"layers": 4}, "--number=f64")
    assert [float(row["z"]) for row in rows[::-1]] != Pile(4).positions()[:, 2].tolist()

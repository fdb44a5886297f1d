"""Piles are values: they survive a round trip through text, bytes and repr, and equal piles are equal keys."""

import copy
import pickle
from decimal import Decimal
from fractions import Fraction

import pytest

import cannonpile
from cannonpile import Pile

from piles import ALL

WAYS = {
    "toml": lambda pile: Pile.from_toml(pile.to_toml()),
    "repr": lambda pile: eval(repr(pile), {"Pile": Pile}),
    "pickle": lambda pile: pickle.loads(pickle.dumps(pile)),
    "oldest pickle": lambda pile: pickle.loads(pickle.dumps(pile, protocol=2)),
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
}


@pytest.mark.parametrize("way", WAYS)
def test_round_trip_is_equal(pile, way):
    back = WAYS[way](pile)
    assert type(back) is Pile
    assert back == pile and not back != pile
    assert hash(back) == hash(pile)
    assert repr(back) == repr(pile)
    assert (back.forces() == pile.forces()).all()
    assert (back.positions() == pile.positions()).all()


def test_all_differ():
    piles = [Pile(**options) for options in ALL.values()]
    assert len(set(piles)) == len(piles)
    assert len({repr(pile) for pile in piles}) == len(piles)
    for one in range(len(piles)):
        for other in range(one):
            assert piles[one] != piles[other]


def test_repr():
    assert repr(Pile(10, "hcp", top="hexagon:3")) == "Pile(layers=10, stacking='hcp', top='hexagon:3')"
    assert repr(Pile(10, spacing=Decimal("1.20"))) == "Pile(layers=10, spacing='6/5')"


# Equality does not depend on the spelling of the arguments.
def test_equality_ignores_spelling():
    for one, other in [
        (Pile(), Pile(10)),
        (Pile(4), Pile(4, "fcc")),
        (Pile(4, "hcp"), Pile(4, "+-+")),
        (Pile(4, "hcp"), Pile(stacking="ABAB")),
        (Pile(4, top="hexagon:2"), Pile(4, top="hexagon:2,2")),
        (Pile(4, top="triangle:2"), Pile(4, top="hexagon:2,1")),
        (Pile(4, mass="1/2"), Pile(4, mass=Decimal("0.5"))),
        (Pile(4, loads={(3, 1, 1): 2}), Pile(4, loads={(1, 1): Fraction(2)})),
        (Pile(4, loads={(0, 0, 0): 1, (1, 0, 0): 2}), Pile(4, loads={(1, 0, 0): 2, (0, 0, 0): 1})),
        (Pile(4, sin_phi="1/2"), Pile(4)),
    ]:
        assert one == other and hash(one) == hash(other), (one, other)


def test_different_piles_differ():
    pile = Pile(4)
    for other in (
        Pile(5),
        Pile(4, "-++"),
        Pile(4, mass=2),
        Pile(4, radius=2),
        Pile(4, gravity=2),
        Pile(4, spacing="5/4"),
        Pile(4, loads={(0, 0, 0): 1}),
        Pile(4, spacing=1).elastic(),
        "Pile(layers=4)",
        None,
        4,
    ):
        assert pile != other and not pile == other
    with pytest.raises(TypeError):
        pile < Pile(5)


def test_piles_are_keys():
    known = {Pile(4): "straight", Pile(4, "hcp"): "alternating"}
    assert known[Pile(4, "+++")] == "straight"
    assert known[Pile(4, "+-+")] == "alternating"


def test_toml_is_the_scene_file():
    pile = Pile.from_toml('layers = 4\nstacking = "hcp"\nspacing = "6/5"\n[[load]]\nat = [0, 0, 0]\nweight = "5/2"\n')
    assert pile == Pile(4, "hcp", spacing="6/5", loads={(0, 0, 0): "5/2"})


def test_results_outlive_pile():
    # Results do not refer to a deleted pile.
    forces, comparison = Pile(4).forces(), Pile(3).compare([[1, 2]], [1.0])
    assert forces.sum() > 0 and comparison.missing == 11


def test_cases_survive_round_trip():
    for _, pile, _ in cannonpile.cases():
        assert pickle.loads(pickle.dumps(pile)) == pile

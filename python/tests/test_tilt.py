"""Gravity and loads with a direction."""

from fractions import Fraction

import numpy as np
import pytest

from cannonpile import Pile, census

TILT = ("1/20", "-1/30")
LOADS = {(1, 0, 0): ("1/2", "-1/10", "1/5")}


def directed(force):
    """Return a force (W, X, Y) in units of mg, as a vector at a = 1.2 R, where mg = 1."""
    tan = np.sqrt(0.48 / 0.52)
    down, x, y = (float(Fraction(part)) for part in force)
    return np.array([x * tan, y * np.sqrt(3) * tan, -down])


def test_every_sphere_is_balanced():
    pile = Pile(5, "+-+-", spacing="6/5", tilt=TILT, loads=LOADS)
    net = np.zeros((pile.sphere_count, 3))
    ids = pile.contact_ids()
    np.add.at(net, ids[:, 0] - 1, pile.vectors())
    np.add.at(net, ids[:, 1] - 1, -pile.vectors())
    net += directed((1, *TILT))
    net[pile.sphere_id(1, 0, 0) - 1] += directed(LOADS[1, 0, 0])
    free = pile.sphere_count - pile.base_count
    assert np.abs(net[:free]).max() < 1e-14
    total = pile.sphere_count * directed((1, *TILT)) + directed(LOADS[1, 0, 0])
    assert np.abs(pile.base().sum(axis=0) - [-total[2], total[0], total[1]]).max() < 1e-12


def test_the_pile_is_made_again_from_its_text_and_its_scene():
    pile = Pile(5, "+-+-", tilt=TILT, loads=LOADS)
    assert eval(repr(pile)) == pile
    assert Pile.from_toml(pile.to_toml()) == pile
    assert pile != Pile(5, "+-+-", loads=LOADS)
    discs = Pile(4, dimension=2, tilt="1/3", loads={(0, 0): (1, "1/7")})
    assert eval(repr(discs)) == discs


def test_stability():
    assert Pile(10).stability().margin_squared == Fraction(1, 4)
    assert Pile(6, "+++-+").stability().margin_squared == 0
    stability = Pile(6, "+-+++").stability()
    assert stability.margin_squared == Fraction(1, 43)
    assert Pile(6, "+-+++").force(*stability.opens[:4]) == stability.opens.force
    for x, y in stability.corners:
        assert Pile(6, "+-+++", tilt=(x, y)).weakest().force == 0
    assert Pile(6, "hcp").stability().margin_squared is None


def test_margins_of_the_census():
    margins = [entry.margin_squared for entry in census(6, standing=True)]
    known = ["1/4", "1/16", "1/43", "4/469", "1/1036", "1/2224", "1/100", "1/208", "1/559", "0", "0"]
    assert margins == list(map(Fraction, known))
    assert [entry.margin_squared for entry in census(1)] == [None]


def test_horizontal_contacts_enlarge_the_polygon():
    stability = Pile(6, "hcp", spacing=1).stability()
    assert stability.margin_squared == Fraction(25, 181804)
    assert stability.opens is None
    assert len(stability.corners) == 6
    assert all(Pile(6, "hcp", spacing=1, tilt=(x, y)).stands for x, y in stability.corners)
    x, y = stability.corners[0]
    assert not Pile(6, "hcp", spacing=1, tilt=(x * Fraction(101, 100), y * Fraction(101, 100))).stands


def test_the_response_is_the_difference_that_a_load_makes():
    site = (1, 0, 0)
    pile = Pile(4, "+-+", tilt=TILT)
    response = pile.response(*site)
    load = tuple(map(Fraction, ("1/2", "-1/10", "1/5")))
    loaded = Pile(4, "+-+", tilt=TILT, loads={site: load})
    contacts = [force @ np.array(load) for force in np.array(response.contacts)]
    before, after = pile.multiples(), loaded.multiples()
    for n, change in enumerate(contacts):
        difference = Fraction(after.numerators[n].item(), after.denominator)
        assert difference - Fraction(before.numerators[n].item(), before.denominator) == change
    sites = [(i, j) for k, i, j in pile.sites().tolist() if k == 3]
    for (i, j), forces in zip(sites, response.base, strict=True):
        before, after = pile.on_floor(i, j), loaded.on_floor(i, j)
        for n in range(3):
            change = sum(part * force[n] for part, force in zip(load, forces, strict=True))
            assert after[n] - before[n] == change
    discs = Pile(2, dimension=2).response(0, 0)
    assert discs.contacts == [(1, -1), (1, 1)]
    assert [len(forces) for forces in discs.base] == [2, 2]


def test_sensitivity_and_spread():
    pile = Pile(3)
    changes = [pile.sensitivity(*map(int, pile.site(n + 1))) for n in range(pile.sphere_count)]
    variances = [sum(change[n] ** 2 for change in changes) for n in range(pile.contact_count)]
    least, variance, bearable_squared = pile.spread()
    assert bearable_squared == least.force**2 / (9 * variance)
    assert bearable_squared == min(
        Fraction(numerator.item()) ** 2 / (9 * variances[n])
        for n, numerator in enumerate(pile.multiples().numerators)
    )
    for none in (Pile(2, weightless=True), Pile(1), Pile(6, "hcp")):
        assert none.spread() is None


def test_a_sphere_that_does_not_exist_has_no_response():
    for question in (Pile(4).response, Pile(4).sensitivity):
        with pytest.raises(ValueError, match="no sphere"):
            question(7, 0, 0)


@pytest.mark.parametrize(
    ("error", "options"),
    [
        (ValueError, {"tilt": "1/2"}),
        (ValueError, {"tilt": ("1/2", "1/3"), "dimension": 2}),
        (ValueError, {"tilt": ("1/2", 0, 0)}),
        (TypeError, {"tilt": (0.5, 0)}),
        (ValueError, {"loads": {(0, 0, 0): (1, 2)}}),
    ],
)
def test_bad_input_is_one_error_that_names_the_argument(error, options):
    with pytest.raises(error, match="tilt" if "tilt" in options else "loads"):
        Pile(4, **options)


def test_weightless_piles_have_no_stability():
    with pytest.raises(ValueError, match="weight"):
        Pile(4, weightless=True).stability()

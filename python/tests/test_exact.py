"""Exact results: fractions equal to those of an independent recursion (recursion.py), and correctly rounded floats."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import cannonpile
from cannonpile import Pile

from piles import ALL, OTHERS, STACKED, recursion
from recursion import discs, isosceles


def fractions(multiples):
    """Return all forces from the numerators and the denominator."""
    return [Fraction(int(numerator), multiples.denominator) for numerator in multiples.numerators]


def test_forces_match_recursion(stacked):
    pile, expected = Pile(**stacked), recursion(stacked)
    assert fractions(pile.multiples()) == list(expected.forces.values())
    assert {at: pile.force(*at) for at in expected.forces} == expected.forces
    assert all(type(pile.force(*at)) is Fraction for at in list(expected.forces)[:1])


def test_base_forces_match_recursion(stacked):
    pile, expected = Pile(**stacked), recursion(stacked)
    assert {at: tuple(pile.on_floor(*at)) for at in expected.floor} == expected.floor
    assert pile.base("pile").tolist() == [[float(x) for x in force] for force in expected.floor.values()]
    assert pile.weight == expected.weight


def test_spheres_and_contacts_match_recursion(stacked):
    pile, expected = Pile(**stacked), recursion(stacked)
    assert [tuple(site) for site in pile.sites().tolist()] == expected.sites()
    assert [tuple(pair) for pair in pile.contact_ids().tolist()] == expected.contact_ids()
    places = expected.positions(pile.spacing, pile.radius)
    assert np.abs(pile.positions() - places).max() <= 1e-13 * len(places) * float(pile.radius)
    for number, site in enumerate(expected.sites(), start=1):
        assert pile.site(number) == site
        assert pile.sphere_id(*site) == number


def test_stability_matches_recursion(stacked):
    if stacked.get("weightless"):
        assert Pile(**stacked).stands is None
    else:
        assert Pile(**stacked).stands is recursion(stacked).stands()


def test_weakest_contact(stacked):
    weakest, forces = Pile(**stacked).weakest(), recursion(stacked).forces
    if not forces:
        assert weakest is None
        return
    assert weakest.force == min(forces.values()) == forces[tuple(weakest[:4])]
    assert type(weakest.force) is Fraction


def test_isosceles_bases_and_discs():
    options = OTHERS["isosceles"]
    closed = isosceles(options["layers"], options["sin_phi"])
    assert fractions(Pile(**options).multiples()) == list(closed.values())
    options = OTHERS["discs"]
    closed = discs(options["layers"])
    pile = Pile(**options)
    assert fractions(pile.multiples()) == list(closed.values())
    assert all(pile.force(k, i, direction=direction) == force for (k, i, _, direction), force in closed.items())


# The recursion agrees with the closed form of the paper, and disagrees for another stacking.
def test_recursion_matches_closed_form():
    straight = recursion({"layers": 6})
    assert straight.forces == isosceles(6, Fraction(1, 2))
    assert set(straight.floor.values()) >= {(Fraction(8, 3), Fraction(-5, 6), Fraction(-5, 6))}
    wrong = recursion({"layers": 6, "stacking": "hcp"})
    assert fractions(Pile(6).multiples()) != list(wrong.forces.values())


def test_floats_are_correctly_rounded(pile):
    exact = fractions(pile.multiples())
    assert pile.forces("pile").tolist() == [float(force) for force in exact]


def test_si_forces_are_correctly_rounded():
    # f0 = mg/(3 cos theta) with cos^2 theta = 1 - (a/R)^2/3. The squares are rational, so the test of the rounding is exact.
    pile = Pile(5, "hcp", spacing="6/5", gravity="9.81", mass="0.013")
    unit_squared = (Fraction("9.81") * Fraction("0.013") / 3) ** 2 / (1 - Fraction(36, 25) / 3)
    for force, exact in zip(pile.forces().tolist(), fractions(pile.multiples()), strict=True):
        if not exact:
            assert force == 0
            continue
        square = exact**2 * unit_squared
        below, above = (Fraction(np.nextafter(force, end)) for end in (-np.inf, np.inf))
        assert ((below + Fraction(force)) / 2) ** 2 <= square <= ((Fraction(force) + above) / 2) ** 2


SAME = ["6/5", "1.2", "12e-1", "0012/10", Fraction(6, 5), Decimal("1.2")]


@pytest.mark.parametrize("spacing", SAME, ids=repr)
def test_exact_inputs(spacing):
    pile = Pile(4, spacing=spacing)
    assert pile.spacing == Fraction(6, 5) and type(pile.spacing) is Fraction
    assert pile == Pile(4, spacing="6/5")


@pytest.mark.parametrize("number", ["3", 3, np.int64(3), np.uint8(3), Fraction(3), Decimal(3)], ids=repr)
def test_exact_integers(number):
    for name in ("mass", "radius", "gravity"):
        pile = Pile(4, **{name: number})
        assert getattr(pile, name) == 3
        assert type(getattr(pile, name)) is Fraction
    assert Pile(4, loads={(0, 0, 0): number}).weight == 23


@pytest.mark.parametrize("layers", [4, np.int64(4), np.uint8(4)], ids=repr)
def test_layers_of_numpy(layers):
    assert Pile(layers).layers == 4
    assert Pile(5).force(np.int64(3), np.int8(1), layers - 3) == Pile(5).force(3, 1, 1)


def test_decimals_are_exact():
    # None of these values is exactly representable as a float.
    assert Pile(4, mass=Decimal("0.1")).mass == Fraction(1, 10)
    assert Pile(4, mass="0.1").mass == Fraction(1, 10)
    long = "1." + "0" * 60 + "1"
    assert Pile(4, spacing=long).spacing == Fraction(long)
    assert Pile(4, spacing=Decimal(long)).spacing == Fraction(long)


FLOATS = [1.5, np.float64(1.5), np.float32(1.5), float("nan")]
WANTED = ["spacing", "radius", "mass", "gravity", "sin_phi", "stiffness_ratio"]


@pytest.mark.parametrize("name", WANTED)
@pytest.mark.parametrize("number", FLOATS, ids=repr)
def test_floats_are_rejected(name, number):
    with pytest.raises(TypeError, match=name) as refused:
        Pile(4, **{name: number})
    # The message states the reason and the remedy.
    assert "float" in str(refused.value) and "Fraction" in str(refused.value)
    if number == 1.5:
        assert "'1.5'" in str(refused.value)


def test_floats_are_rejected_as_loads_and_elsewhere():
    for loads in ({(0, 0, 0): 0.5}, {(0.0, 0, 0): 1}):
        with pytest.raises(TypeError, match="loads"):
            Pile(4, loads=loads)
    with pytest.raises(TypeError, match="layers"):
        Pile(4.0)
    with pytest.raises(TypeError, match="stiffness_ratio"):
        Pile(4).elastic(0.5)
    with pytest.raises(TypeError, match="fault_probability"):
        cannonpile.mean(4, fault_probability=0.5)


# Booleans are rejected, too, although `bool` is a subclass of `int`.
@pytest.mark.parametrize("number", [None, True, [], "seven", "", "1/0", 1j, Decimal("nan"), Decimal("inf")], ids=repr)
def test_invalid_numbers_are_rejected(number):
    with pytest.raises((TypeError, ValueError), match="mass"):
        Pile(4, mass=number)


def test_multiples_never_overflow():
    # The denominator is 3^d for d sign changes. In HCP the numerators exceed int64 from d = 37 on.
    narrow = Pile(12, "hcp").multiples()
    assert narrow.numerators.dtype == np.int64
    assert 3**10 % narrow.denominator == 0
    options = {"layers": 48, "stacking": "hcp"}
    wide, expected = Pile(**options).multiples(), recursion(options)
    assert isinstance(wide.numerators, list)
    assert max(map(abs, wide.numerators)) > 2**63
    assert all(type(numerator) is int for numerator in wide.numerators)
    assert fractions(wide) == list(expected.forces.values())


def test_multiples_near_int64_limit():
    # The heights lie on both sides of the limit.
    kinds = set()
    for changes in range(30, 44):
        multiples = Pile(changes + 2, "hcp").multiples()
        kinds.add(type(multiples.numerators))
        weakest = Pile(changes + 2, "hcp").weakest()
        assert min(map(int, multiples.numerators)) == weakest.force * multiples.denominator
    assert kinds == {np.ndarray, list}


def test_loads_with_large_numbers():
    huge = Fraction(10**40, 7)
    multiples = Pile(3, loads={(0, 0, 0): huge}).multiples()
    assert fractions(multiples)[:3] == [1 + huge] * 3
    assert Pile(3, loads={(0, 0, 0): huge}).force(0, 0, 0) == 1 + huge


def test_a_pile_of_any_height():
    # Single forces have closed forms, so they need no memory and are exact in a pile of 10^36 layers.
    pile = Pile(10**36)
    k = 10**35
    assert pile.force(k, 3, 4, "gamma") == 5
    assert pile.on_floor(10**30, 7).normal == Fraction(10**36 + 2, 3)
    assert pile.sphere_count == 10**36 * (10**36 + 1) * (10**36 + 2) // 6
    assert pile.layers == 10**36


def test_bounds_enclose_the_elastic_state():
    for options in ({"layers": 5}, {"layers": 5, "stacking": "+-+-"}):
        pile = Pile(**options, spacing=1)
        elastic = pile.elastic("3/2")
        assert elastic.state == "elastic"
        for i, j in pile.sites()[-pile.base_count :, 1:].tolist():
            bounds = pile.bounds(i, j)
            assert type(bounds.least) is Fraction and type(bounds.proved) is bool
            assert bounds.least <= elastic.on_floor(i, j).normal <= bounds.greatest
            assert bounds.least < bounds.greatest


def test_elastic_state_of_straight_piles_is_the_isostatic_one():
    # By a theorem, the horizontal contacts of straight piles carry no force in the elastic state.
    pile = Pile(6, spacing=1)
    assert (pile.elastic().multiples().numerators == pile.multiples().numerators).all()
    assert pile.elastic() != pile


def test_elastic_state_has_horizontal_contacts():
    pile = Pile(**ALL["elastic"])
    sites = pile.sites()
    layers = sites[pile.contact_ids() - 1, 0]
    horizontal = layers[:, 0] == layers[:, 1]
    assert horizontal.any() and not horizontal.all()
    assert (pile.forces()[horizontal] > 0).all()


def test_means_match_enumeration():
    layers, probability = 5, Fraction(1, 3)
    sums = {}
    for number in range(2 ** (layers - 2)):
        word = [1] + [1 if number >> bit & 1 else -1 for bit in range(layers - 2)]
        changes = sum(one != other for one, other in zip(word, word[1:], strict=False))
        weight = probability**changes * (1 - probability) ** (layers - 2 - changes)
        stacking = "".join("+" if sign > 0 else "-" for sign in word)
        net = sum(word)
        for (i, j), force in recursion({"layers": layers, "stacking": stacking}).floor.items():
            held = sums.setdefault((2 * i + j - net, i + 2 * j - net), [Fraction(0)] * 4)
            for index, term in enumerate((1, *force)):
                held[index] += weight * term
    means = cannonpile.mean(layers, fault_probability="1/3")
    assert {(mean.a, mean.b): [mean.probability, *mean[3:]] for mean in means} == sums


def test_census_matches_recursion():
    entries = {entry.stacking: entry for entry in cannonpile.census(5)}
    assert entries
    for stacking, entry in entries.items():
        known = recursion({"layers": len(stacking) + 1, "stacking": stacking})
        assert entry.layers == len(stacking) + 1
        assert entry.stands is known.stands()
        assert entry.least_force == min(known.forces.values())
    standing = [entry.stacking for entry in cannonpile.census(7, standing=True)]
    # Every stacking that begins with +: one of each mirror pair.
    words = ["+" + "".join("+-"[number >> bit & 1] for bit in range(5)) for number in range(32)]
    assert sorted(standing) == sorted(word for word in words if recursion({"layers": 7, "stacking": word}).stands())


def test_proofs():
    theorems = cannonpile.prove()
    assert len(theorems) >= 50
    assert all(theorem.holds for theorem in theorems)
    names = [theorem.name for theorem in theorems]
    assert len(set(names)) == len(names)
    [one] = cannonpile.prove(names[3])
    assert one == theorems[3]


def test_cases():
    cases = cannonpile.cases()
    assert [name for name, _, _ in cases][:2] == ["C1", "C2"]
    for name, pile, known in cases:
        assert isinstance(pile, Pile)
        assert known.title and known.purpose
        assert pile.stands is known.stands, name
    assert {known.stands for _, _, known in cases} == {True, False, None}
    assert Pile(**STACKED["straight"]).stands is True

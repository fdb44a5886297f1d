"""Properties of random small piles."""

import pickle
from fractions import Fraction

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from cannonpile import Pile

from piles import down
from recursion import Recursion

fractions_of_load = st.fractions(min_value=0, max_value=5, max_denominator=9)
exact = st.fractions(min_value=Fraction(1, 997), max_value=1000, max_denominator=997)


@st.composite
def tops(draw):
    """Draw the text of a top layer, or None for one sphere."""
    kind = draw(st.sampled_from(["one", "hexagon", "triangle", "region"]))
    if kind == "one":
        return None
    size = st.integers(1, 3)
    if kind == "hexagon":
        return f"hexagon:{draw(size)},{draw(size)}"
    if kind == "triangle":
        return f"triangle:{draw(size)}"
    x0, y0 = draw(st.integers(-3, 3)), draw(st.integers(-3, 3))
    x, y = draw(st.integers(0, 2)), draw(st.integers(0, 2))
    # Cut between the corners of the parallelogram, so that sites remain.
    cut = draw(st.integers(0, x + y))
    more = draw(st.integers(0, x + y - cut))
    return f"region:{x0}..{x0 + x},{y0}..{y0 + y},{x0 + y0 + cut}..{x0 + y0 + cut + more}"


@st.composite
def scenes(draw):
    """Draw the arguments of a pile with any stacking, any top and some loads."""
    layers = draw(st.integers(1, 6))
    options = {"layers": layers}
    if layers > 1:
        options["stacking"] = draw(st.text("+-", min_size=layers - 1, max_size=layers - 1))
    if top := draw(tops()):
        options["top"] = top
    spheres = Recursion(**options).sites()
    loads = draw(st.dictionaries(st.sampled_from(spheres), fractions_of_load, max_size=3))
    if loads:
        options["loads"] = loads
        options["weightless"] = draw(st.booleans())
    return options


@given(scenes())
def test_forces_match_recursion(options):
    pile, expected = Pile(**options), Recursion(**options)
    multiples = pile.multiples()
    assert [Fraction(int(n), multiples.denominator) for n in multiples.numerators] == list(expected.forces.values())
    assert [tuple(pair) for pair in pile.contact_ids().tolist()] == expected.contact_ids()
    assert {at: tuple(pile.on_floor(*at)) for at in expected.floor} == expected.floor
    assert pile.weight == expected.weight
    if not options.get("weightless"):
        assert pile.stands is expected.stands()


@given(scenes(), st.fractions(min_value=1, max_value=Fraction(3, 2), max_denominator=50), exact, exact, exact)
def test_equilibrium(options, spacing, radius, mass, gravity):
    sizes = {"spacing": spacing, "radius": radius, "mass": mass, "gravity": gravity}
    pile = Pile(**options, **sizes)
    pulls = down(pile, options)
    net = np.zeros((pile.sphere_count, 3))
    ids, vectors = pile.contact_ids(), pile.vectors()
    np.add.at(net, ids[:, 0] - 1, vectors)
    np.add.at(net, ids[:, 1] - 1, -vectors)
    net[:, 2] -= pulls
    net[-pile.base_count :] += pile.base()[:, [1, 2, 0]] * [-1, -1, 1]
    assert np.abs(net).max() <= 1e-12 * max(pulls.sum(), float(mass * gravity))
    positions = pile.positions()
    upper, lower = positions[ids[:, 0] - 1], positions[ids[:, 1] - 1]
    assert np.abs(np.linalg.norm(upper - lower, axis=1) - 2 * float(radius)).max(initial=0) <= 1e-11 * float(radius)


@given(scenes(), exact)
def test_round_trip(options, mass):
    pile = Pile(**options, mass=mass)
    assert Pile.from_toml(pile.to_toml()) == pile
    assert eval(repr(pile), {"Pile": Pile}) == pile
    assert pickle.loads(pickle.dumps(pile)) == pile
    assert pile != Pile(**options, mass=mass + 1)


@given(scenes(), st.randoms(use_true_random=False), st.floats(1e-7, 1e-2))
def test_only_exact_forces_are_accepted(options, random, error):
    pile = Pile(**options, spacing="6/5")
    ids, forces = pile.contact_ids(), pile.forces()
    if not (forces != 0).any():
        return
    order = random.sample(range(len(forces)), len(forces))
    pile.assert_close(ids[order], forces[order], rtol=1e-14)
    pile.assert_close(points=pile.contact_points()[order], forces=forces[order], rtol=1e-12)
    if (forces >= 0).all():
        # A point alone does not identify the first sphere, so the force is read as compression.
        pile.assert_close(points=pile.contact_points()[order], vectors=pile.vectors()[order], rtol=1e-12)
    at = random.choice(np.flatnonzero(forces).tolist())
    forces[at] *= 1 + error
    found = pile.compare(ids, forces)
    assert found.beyond(error / 2) == 1 and found.worst.ids == tuple(ids[at].tolist())


@given(scenes(), scenes())
def test_equal_piles_have_equal_forces(one, other):
    a, b = Pile(**one), Pile(**other)
    if a == b:
        assert hash(a) == hash(b)
        assert a.forces().tolist() == b.forces().tolist()
        assert a.sites().tolist() == b.sites().tolist()
    else:
        assert repr(a) != repr(b)


numbers = st.one_of(
    st.integers(),
    st.floats(),
    st.text(),
    st.none(),
    st.booleans(),
    st.fractions(),
    st.decimals(),
    st.binary(),
    st.complex_numbers(),
)


# Every input is accepted, or rejected by one of three exceptions that names the argument.
@given(st.sampled_from(["spacing", "radius", "mass", "gravity", "sin_phi", "stiffness_ratio"]), numbers)
@settings(max_examples=300)
def test_anything_for_a_number(name, number):
    try:
        pile = Pile(3, **{name: number})
    except (TypeError, ValueError) as error:
        assert name in str(error)
        assert not (isinstance(number, float) and isinstance(error, ValueError))
        return
    assert not isinstance(number, (float, bool, complex, bytes))
    if number is not None:
        assert getattr(pile, name, Fraction(number)) == Fraction(number)


@given(st.one_of(st.text("+-ABChc(),0123456789 ", max_size=8), st.text(max_size=8)), st.text(max_size=12))
def test_anything_for_a_text(stacking, top):
    for options, name in (({"stacking": stacking}, "stacking"), ({"layers": 3, "top": top}, "top")):
        try:
            Pile(**options)
        except (ValueError, MemoryError) as error:
            assert name in str(error) or "layers" in str(error)

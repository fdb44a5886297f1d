"""Comparison of measured forces: by ids and by position, as magnitudes and as vectors, correct and wrong."""

import numpy as np
import pytest

import cannonpile
from cannonpile import Pile

TIGHT = 1e-12


@pytest.fixture(params=[{"layers": 6, "spacing": "6/5"}, {"layers": 4, "stacking": "hcp", "top": "hexagon:3"}], ids=str)
def pile(request):
    return Pile(**request.param)


def centres(pile):
    """Return the centres of both spheres of each contact."""
    return pile.positions()[pile.contact_ids() - 1]


def ways(pile):
    """Yield the exact forces in all accepted forms."""
    ids, forces, vectors = pile.contact_ids(), pile.forces(), pile.vectors()
    for place in ({"ids": ids}, {"points": pile.contact_points()}, {"centres": centres(pile)}):
        yield place | {"forces": forces}
        yield place | {"vectors": vectors}
        yield place | {"forces": forces, "vectors": vectors}


def test_exact_forces_are_accepted(pile):
    for measured in ways(pile):
        pile.assert_close(**measured, rtol=TIGHT)
        found = pile.compare(**measured)
        bearing = np.count_nonzero(pile.forces())
        assert (found.missing, found.extra(TIGHT), found.beyond(TIGHT)) == (0, 0, 0)
        assert bearing <= found.matched <= found.contacts == pile.contact_count
        assert found.largest_error <= TIGHT and found.rms_error <= found.largest_error
        assert found.accepted(TIGHT) is True
        assert found.largest_force == pile.forces().max()
        assert found.findings(TIGHT) == []
        assert found.missing_contacts() == []


def test_ids_may_be_the_first_argument(pile):
    pile.assert_close(pile.contact_ids(), pile.forces())
    pile.assert_close(pile.contact_ids().tolist(), pile.forces().tolist())
    pile.assert_close(pile.contact_ids().astype(np.int32), pile.forces().astype(np.float64))
    # The form of LAMMPS.
    pile.assert_close(np.asfortranarray(pile.contact_ids()), vectors=np.asfortranarray(pile.vectors()))
    pile.assert_close(pile.contact_ids()[::-1], pile.forces()[::-1])
    pile.assert_close(pile.contact_ids(), pile.forces().astype(np.float32), rtol=1e-6)


def test_arrays_of_any_kind(pile):
    ids, forces, vectors = pile.contact_ids(), pile.forces(), pile.vectors()
    for kind in ("<i4", ">i8", "u8", "f8"):
        pile.assert_close(ids.astype(kind), forces, rtol=TIGHT)
    pile.assert_close(ids, forces.astype(">f8"), vectors=vectors.astype(">f8"), rtol=TIGHT)
    pile.assert_close(ids, forces.astype(np.longdouble), rtol=TIGHT)
    # Columns of a wider table, every other row, and read-only memory.
    table = np.zeros((2 * len(ids), 8))
    table[::2, 1:3], table[::2, 4], table[::2, 5:] = ids, forces, vectors
    table.setflags(write=False)
    rows = table[::2]
    pile.assert_close(rows[:, 1:3], rows[:, 4], vectors=rows[:, 5:], rtol=TIGHT)
    assert not rows.flags.c_contiguous


def test_any_order_and_either_sphere_first(pile):
    order = np.random.default_rng(7).permutation(pile.contact_count)
    swapped = order % 2 == 0
    ids = pile.contact_ids()[order]
    ids[swapped] = ids[swapped][:, ::-1]
    vectors = pile.vectors()[order] * np.where(swapped, -1, 1)[:, None]
    pile.assert_close(ids, pile.forces()[order], vectors=vectors, rtol=TIGHT)
    pairs = centres(pile)[order]
    pairs[swapped] = pairs[swapped][:, ::-1]
    pile.assert_close(centres=pairs, vectors=vectors, rtol=TIGHT)


@pytest.mark.parametrize("error", [1e-4, -1e-4, 1e-8])
def test_the_worst_contact_is_named(pile, error):
    at = 11
    for measured in ways(pile):
        for name in ("forces", "vectors"):
            if name in measured:
                measured[name] = measured[name].copy()
                measured[name][at] *= 1 + error
        found = pile.compare(**measured)
        assert found.largest_error == pytest.approx(abs(error), rel=1e-6)
        assert found.beyond(abs(error) / 2) == 1 and found.beyond(abs(error) * 2) == 0
        worst = found.worst
        first, second = pile.contact_ids()[at].tolist()
        assert (worst.ids, (worst.k, worst.i, worst.j)) == ((first, second), pile.site(first))
        assert worst.exact == pile.forces()[at]
        assert worst.measured == pytest.approx(pile.forces()[at] * (1 + error), rel=1e-14)
        assert worst.error == pytest.approx(abs(error), rel=1e-6)
        pile.assert_close(**measured, rtol=abs(error) * 2)
        with pytest.raises(AssertionError) as failed:
            pile.assert_close(**measured, rtol=abs(error) / 2)
        said = str(failed.value)
        # Both spheres, the site and the direction, both values and the tolerance.
        for word in (str(first), str(second), f"k={worst.k}", f"i={worst.i}", f"j={worst.j}", worst.direction):
            assert word in said, (word, said)
        values = [(worst.exact, worst.measured)]
        if "vectors" in measured:
            values.append((pile.vectors()[at, 2], measured["vectors"][at, 2]))
        assert any(all(repr(float(value)) in said for value in both) for both in values), said
        assert f"{abs(error) / 2:g}" in said


def without(at):
    """Return a function that removes a contact."""
    return lambda array: np.delete(array, at, axis=0)


def test_missing_contact_is_detected(pile):
    at = int(np.argmax(pile.forces()))
    for measured in ways(pile):
        measured = {name: without(at)(array) for name, array in measured.items()}
        found = pile.compare(**measured)
        assert found.missing == 1 and not found.accepted(1)
        [missing] = found.missing_contacts()
        assert missing.ids == tuple(pile.contact_ids()[at].tolist())
        assert missing.measured is None and missing.exact == pile.forces()[at]
        with pytest.raises(AssertionError, match="missing") as failed:
            pile.assert_close(**measured)
        assert str(missing.ids[0]) in str(failed.value)


def test_extra_contact_is_detected():
    pile = Pile(5, spacing="6/5")
    ids, forces = pile.contact_ids(), pile.forces()
    # The neighbours of a layer do not touch.
    ids, forces = np.vstack([ids, [[2, 3]]]), np.append(forces, 0.5)
    found = pile.compare(ids, forces)
    assert found.extra() == 1 and found.extra(10) == 0
    with pytest.raises(AssertionError, match="extra|not touch"):
        pile.assert_close(ids, forces)


def test_wrong_pile_is_rejected(pile):
    other = Pile(4, spacing="6/5")
    with pytest.raises((AssertionError, ValueError)):
        other.assert_close(pile.contact_ids(), pile.forces())


def test_vectors_of_the_other_sphere_are_detected(pile):
    vectors = -pile.vectors()
    with pytest.raises(AssertionError) as failed:
        pile.assert_close(pile.contact_ids(), vectors=vectors)
    found = pile.compare(pile.contact_ids(), vectors=vectors)
    assert found.findings() and all(finding in str(failed.value) for finding in found.findings()[:1])


def test_constant_factor_is_detected(pile):
    found = pile.compare(pile.contact_ids(), pile.forces() * 9.81)
    assert any("9.81" in finding for finding in found.findings())


def test_other_frames_are_accepted(pile):
    # A rotation about the vertical and a translation give no finding if both centres are known.
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    shift = [3.0, -2.0, 10.0]
    pairs = centres(pile) @ turn.T + shift
    pile.assert_close(centres=pairs, vectors=pile.vectors() @ turn.T, rtol=1e-9)
    pile.assert_close(points=pile.contact_points() @ turn.T + shift, forces=pile.forces(), rtol=1e-9)


def test_position_tolerance(pile):
    pairs = centres(pile)
    pairs[5] += [0.05, 0, 0]
    assert pile.compare(centres=pairs, forces=pile.forces(), within=0.1).missing == 0
    # The position is rejected, or one contact is missing and another is extra.
    with pytest.raises((AssertionError, ValueError)):
        pile.assert_close(centres=pairs, forces=pile.forces(), within=0.01)


def test_text_is_one_line_with_the_worst_contact(pile):
    forces = pile.forces()
    forces[7] *= 1.5
    found = pile.compare(pile.contact_ids(), forces)
    assert "\n" not in str(found)
    assert all(str(number) in str(found) for number in pile.contact_ids()[7])
    assert found.worst.text in str(found) or str(found.worst.ids[0]) in str(found)


def test_unstable_pile_has_tension():
    pile = Pile(8, "hcp")
    assert pile.stands is False and pile.forces().min() < 0
    pile.assert_close(pile.contact_ids(), pile.forces(), rtol=TIGHT)
    # A code without cohesion loses these contacts.
    kept = pile.forces() > 0
    found = pile.compare(pile.contact_ids()[kept], pile.forces()[kept])
    assert found.missing == np.count_nonzero(pile.forces() < 0)


def test_elastic_state():
    pile = Pile(6, "+-+-+", state="elastic")
    pile.assert_close(pile.contact_ids(), pile.forces(), rtol=TIGHT)
    isostatic = Pile(6, "+-+-+", spacing=1)
    with pytest.raises(AssertionError):
        isostatic.assert_close(pile.contact_ids(), pile.forces())


def test_nothing_measured():
    pile = Pile(3)
    with pytest.raises((AssertionError, ValueError)):
        pile.assert_close(np.empty((0, 2), dtype=np.int64), np.empty(0))
    one = Pile(1)
    one.assert_close(one.contact_ids(), one.forces())
    for empty in (pile.compare(np.empty((0, 2), dtype=np.int64), np.empty(0)), one.compare(one.contact_ids(), one.forces())):
        assert (empty.largest_error, empty.rms_error, empty.floor_error) == (None, None, None)


def test_zeros_are_measured(pile):
    forces = pile.forces()
    at = int(np.argmax(forces))
    forces[at] = 0
    found = pile.compare(pile.contact_ids(), forces)
    assert (found.missing, found.beyond(0.5), found.largest_error) == (0, 1, 1.0)


def test_pairs_may_be_given_in_both_orders(pile):
    ids, forces, vectors = pile.contact_ids(), pile.forces(), pile.vectors()
    both, twice = np.vstack([ids, ids[:, ::-1]]), np.append(forces, forces)
    pile.assert_close(both, twice, vectors=np.vstack([vectors, -vectors]), rtol=TIGHT)
    assert pile.compare(both, twice).repeated == len(ids)
    twice[-1] *= 1.5
    assert pile.compare(both, twice).contradictory() == 1
    with pytest.raises(AssertionError):
        pile.assert_close(both, twice)


def test_floor_is_judged(pile):
    bottom = [[pile.sphere_count, 0]]
    normal = pile.base()[-1, 0]
    ids = np.vstack([pile.contact_ids(), bottom])
    found = pile.compare(ids, np.append(pile.forces(), normal))
    assert (found.floor, found.floor_error) == (1, 0)
    with pytest.raises(AssertionError):
        pile.assert_close(ids, np.append(pile.forces(), 2 * normal))


@pytest.mark.parametrize(("name", "pile", "known"), cannonpile.cases())
def test_cases_parametrize_tests(name, pile, known):
    assert known.title, name
    pile.assert_close(pile.contact_ids(), pile.forces(), rtol=TIGHT)

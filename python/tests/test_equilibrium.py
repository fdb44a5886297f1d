"""Equilibrium, from the arrays positions(), contact_ids(), vectors() and base() alone."""

import numpy as np
import pytest

import cannonpile

from piles import ALL, down

ACCURACY = 1e-13


class Measured:
    """The arrays of a pile, whose copies can be altered."""

    def __init__(self, options):
        pile = cannonpile.Pile(**options)
        self.down = down(pile, options)
        self.free = pile.sphere_count - pile.base_count
        self.radius = float(pile.radius)
        self.unit = max(self.down.sum(), float(pile.mass * pile.gravity))
        self.positions = pile.positions()
        self.ids = pile.contact_ids()
        self.points = pile.contact_points()
        self.forces = pile.forces()
        self.vectors = pile.vectors()
        self.base = pile.base()

    def net(self):
        """Return the residual force on each sphere, relative to the total weight and load."""
        total = np.zeros_like(self.positions)
        np.add.at(total, self.ids[:, 0] - 1, self.vectors)
        np.add.at(total, self.ids[:, 1] - 1, -self.vectors)
        total[:, 2] -= self.down
        return total / self.unit

    def imbalance(self):
        """Return the largest residual force on a sphere above the floor."""
        return np.abs(self.net()[: self.free]).max(initial=0)

    def torque(self):
        """Return the largest moment of a contact force about the centres of its spheres. It is zero without friction."""
        arms = self.positions[self.ids[:, 0] - 1] - self.positions[self.ids[:, 1] - 1]
        return np.abs(np.cross(arms, self.vectors)).max(initial=0) / (self.unit * self.radius)

    def floor(self):
        """Return the error of the base forces: normal downwards, shear along x and y."""
        arrives = self.net()[self.free :] * [1, 1, -1]
        return np.abs(arrives[:, [2, 0, 1]] - self.base / self.unit).max()


@pytest.fixture
def measured(options):
    return Measured(options)


def test_shapes_and_types(pile):
    spheres, contacts, base = pile.sphere_count, pile.contact_count, pile.base_count
    for array, shape, kind in [
        (pile.positions(), (spheres, 3), np.float64),
        (pile.sites(), (spheres, 3), np.int64),
        (pile.contact_ids(), (contacts, 2), np.int64),
        (pile.contact_points(), (contacts, 3), np.float64),
        (pile.forces(), (contacts,), np.float64),
        (pile.vectors(), (contacts, 3), np.float64),
        (pile.base(), (base, 3), np.float64),
    ]:
        assert isinstance(array, np.ndarray)
        assert (array.shape, array.dtype) == (shape, kind)
        assert array.flags.c_contiguous and array.flags.writeable and array.flags.owndata


def test_arrays_are_independent_copies(pile):
    first = pile.positions()
    first[:] = np.nan
    assert np.isfinite(pile.positions()).all()


def test_no_net_force_above_the_floor(measured):
    assert measured.imbalance() <= ACCURACY


def test_forces_are_central(measured):
    assert measured.torque() <= ACCURACY


def test_base_carries_whole_weight(measured, pile):
    assert measured.floor() <= ACCURACY
    assert measured.base[:, 0].sum() == pytest.approx(float(pile.weight * pile.mass * pile.gravity), rel=ACCURACY)
    assert np.abs(measured.base[:, 1:].sum(axis=0)).max() <= ACCURACY * measured.unit


def test_contacts_are_where_spheres_touch(measured):
    upper, lower = (measured.positions[measured.ids[:, end] - 1] for end in (0, 1))
    apart = np.linalg.norm(upper - lower, axis=1)
    assert np.abs(apart - 2 * measured.radius).max(initial=0) <= ACCURACY * measured.radius * 100
    assert np.abs(measured.points - (upper + lower) / 2).max(initial=0) <= ACCURACY * measured.radius * 100


def test_vectors_push_the_first_sphere_away(measured):
    upper, lower = (measured.positions[measured.ids[:, end] - 1] for end in (0, 1))
    along = (upper - lower) / (2 * measured.radius)
    assert np.abs(measured.vectors - measured.forces[:, None] * along).max(initial=0) <= ACCURACY * measured.unit


def test_no_spheres_overlap(pile):
    positions = pile.positions() / float(pile.radius)
    apart = np.linalg.norm(positions[:, None] - positions[None], axis=2)
    np.fill_diagonal(apart, np.inf)
    assert apart.min(initial=np.inf) >= 2 - 1e-12


def test_units_of_force(pile):
    assert pile.forces() == pytest.approx(pile.forces("pile") * pile.unit_force, rel=1e-15)
    normal = pile.base("pile")[:, 0]
    assert pile.base()[:, 0] == pytest.approx(normal * float(pile.mass * pile.gravity), rel=1e-15)


def test_the_floor_is_at_the_centres_of_the_bottom_layer(pile):
    heights = pile.positions()[:, 2]
    assert (heights[-pile.base_count :] == 0).all()
    assert (heights[: -pile.base_count] > 0).all()


# Errors in a copy of the arrays: each of the laws above can fail.
@pytest.mark.parametrize("name", ["straight", "unstable hcp", "hexagon", "loads", "elastic"])
def test_errors_are_detected(name):
    def planted(fault):
        measured = Measured(ALL[name])
        assert max(measured.imbalance(), measured.floor(), measured.torque()) <= ACCURACY
        fault(measured)
        return measured

    def one_force(measured):
        measured.vectors[3] *= 1 + 1e-9

    def one_pair(measured):
        measured.ids[[1, 2]] = measured.ids[[2, 1]]

    def one_turned(measured):
        measured.vectors[2] = measured.vectors[2, [1, 2, 0]]

    def one_load(measured):
        measured.down[0] += 1e-9 * measured.unit

    for fault in (one_force, one_pair, one_turned, one_load):
        assert planted(fault).imbalance() > ACCURACY, fault.__name__
    assert planted(one_turned).torque() > ACCURACY

    def one_base(measured):
        measured.base[0, 1] += 1e-9 * measured.unit

    def no_weight(measured):
        measured.down[-1] = 0

    for fault in (one_base, no_weight):
        assert planted(fault).floor() > ACCURACY, fault.__name__

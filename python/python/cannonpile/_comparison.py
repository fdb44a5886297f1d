"""Comparison of measured forces with the exact ones."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ._records import Difference

if TYPE_CHECKING:
    from . import _cannonpile


class Comparison:
    """The result of `Pile.compare` and `RoughFloor.compare`: measured contact forces compared with the exact ones.

    Exact forces are correctly rounded to float64. The error of a contact is |f - f0| / |f0|. For vectors it is the larger one
    of this and |F - F0| / |f0|. A contact with exact force 0 may be absent; its error is relative to the largest exact force.
    Contacts between two bottom spheres, which are fixed, are ignored. A pair may be given twice: in both orders, or with the
    same force. The worse of two different forces is judged. A number outside the pile is that of the floor or of a wall, if the
    other sphere is at the bottom.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> pile = Pile(2)
    >>> comparison = pile.compare([[1, 2], [3, 1]], [0.46225016352102427, 0.5])
    >>> print(str(comparison).split(";")[0])
    2 of 3 contacts measured, 1 missing, 0 pairs besides them
    """

    __slots__ = ("_native",)

    def __init__(self, native: _cannonpile.Comparison) -> None:
        self._native = native

    @property
    def contacts(self) -> int:
        """The number of contacts of the pile.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2]], [0.5]).contacts
        3
        """
        return self._native.contacts

    @property
    def matched(self) -> int:
        """The number of contacts of the pile that were measured.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2]], [0.5]).matched
        1
        """
        return self._native.matched

    @property
    def missing(self) -> int:
        """The number of contacts with a force that were not measured.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2]], [0.5]).missing
        2
        """
        return self._native.missing

    @property
    def repeated(self) -> int:
        """The number of entries that give a pair a second time.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2], [2, 1]], [0.5, 0.5]).repeated
        1
        """
        return self._native.repeated

    @property
    def floor(self) -> int:
        """The number of contacts with the floor whose normal forces were judged.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[2, 0], [3, 0], [4, 0]], [4 / 3, 4 / 3, 4 / 3]).floor
        3
        """
        return self._native.floor

    @property
    def floor_error(self) -> float | None:
        """The largest relative error of the normal force of the floor on a bottom sphere. None if no such force was judged.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[2, 0], [3, 0]], [4 / 3, 8 / 3]).floor_error
        1.0
        """
        return self._native.floor_error

    @property
    def tangential(self) -> int:
        """The number of contacts whose tangential forces were measured. It is 0 on a floor with glue.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).on_rough_floor().compare([[1, 2]], vectors=[[0.1, 0.2, 0.3]]).tangential
        1
        """
        return self._native.tangential

    @property
    def tangential_error(self) -> float | None:
        """The largest error of a tangential force, as a vector, relative to the exact one. None if none was measured.

        Where the exact force is 0, the error is relative to the largest exact tangential force.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> discs = Pile(2, dimension=2).on_rough_floor()
        >>> discs.compare([[1, 2]], vectors=[[0.3, 0, 0.4]], tangential=[[0, 0, 0]]).tangential_error
        1.0
        """
        return self._native.tangential_error

    @property
    def floor_friction_error(self) -> float | None:
        """The largest error of the friction of a rough floor, like `tangential_error`. None if no such vector was measured.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).on_rough_floor().compare([[2, 0]], vectors=[[0, 0, 4 / 3]]).floor_friction_error
        1.0
        """
        return self._native.floor_friction_error

    @property
    def net_moment(self) -> tuple[int, float] | None:
        """The id of the sphere with the greatest net moment, and this moment over R times the largest exact tangential force.

        Only spheres count whose forces were all measured. None if there is none, or the floor has glue.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> discs = Pile(2, dimension=2).on_rough_floor()
        >>> turning = [[-2 / 15, 0, 0.1], [-2 / 15, 0, -0.1]]
        >>> sphere, moment = discs.compare([[1, 2], [1, 3]], vectors=discs.normal_vectors(), tangential=turning).net_moment
        >>> sphere, round(moment, 9)
        (1, 2.0)
        """
        return self._native.net_moment

    @property
    def fixed(self) -> int:
        """The number of measured pairs of bottom spheres. These spheres are fixed, so the pairs are ignored.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2], [2, 3]], [0.5, 0.1]).fixed
        1
        """
        return self._native.fixed

    @property
    def largest_force(self) -> float:
        """The largest exact force by magnitude, in N.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2]], [0.5]).largest_force
        0.46225016352102427
        """
        return self._native.largest_force

    @property
    def largest_error(self) -> float | None:
        """The largest relative error of a measured contact. Infinite if a force is measured but all exact forces are zero.
        None without measured contacts.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> round(Pile(2).compare([[1, 2]], [0.5]).largest_error, 4)
        0.0817
        """
        return self._native.largest_error

    @property
    def rms_error(self) -> float | None:
        """The root mean square of the relative errors of the measured contacts, None if there are none.

        It is accurate to about 1e-8.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> exact = 0.46225016352102427
        >>> round(Pile(2).compare([[1, 2], [1, 3]], [exact, 2 * exact]).rms_error, 6)
        0.707107
        """
        return self._native.rms_error

    @property
    def worst(self) -> Difference | None:
        """The contact with the largest relative error, the first one if there are several. None without measured contacts.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> print(Pile(2).compare([[1, 2], [1, 3]], [0.4623, 0.5]).worst.text)
        contact of sphere 1 (k=0, i=0, j=0) with sphere 3 along beta: measured 0.5 N, exact 0.46225016352102427 N
        """
        worst = self._native.worst
        return None if worst is None else Difference(*worst)

    def missing_contacts(self) -> list[Difference]:
        """Return the first thousand of the missing contacts, from the top.

        Returns
        -------
        list of Difference
            Each with ``measured`` None.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> [contact.ids for contact in Pile(2).compare([[1, 3]], [0.46]).missing_contacts()]
        [(1, 2), (1, 4)]
        """
        return [Difference(*contact) for contact in self._native.missing_contacts()]

    def extra(self, rtol: float = 1e-6) -> int:
        """Return the number of measured pairs without a contact whose force exceeds `rtol` times the largest exact force.

        Parameters
        ----------
        rtol : float, default 1e-6
            Forces below this fraction of the largest exact force are noise.

        Returns
        -------
        int
            The number, without pairs of bottom spheres.

        Raises
        ------
        ValueError
            If the tolerance is negative or not a number.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(3).compare([[2, 3]], [0.1]).extra()
        1
        """
        return self._native.extra(_tolerance(rtol))

    def beyond(self, rtol: float = 1e-6) -> int:
        """Return the number of measured contacts with a relative error above `rtol`.

        Parameters
        ----------
        rtol : float, default 1e-6
            The relative error.

        Returns
        -------
        int
            At most `matched`.

        Raises
        ------
        ValueError
            If the tolerance is negative or not a number.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> comparison = Pile(2).compare([[1, 2], [1, 3], [1, 4]], [0.46225, 0.462, 0.5])
        >>> [comparison.beyond(rtol) for rtol in (1e-2, 1e-4, 0)]
        [1, 2, 3]
        """
        return self._native.beyond(_tolerance(rtol))

    def contradictory(self, rtol: float = 1e-6) -> int:
        """Return the number of pairs that are given twice, with forces that differ by more than `rtol` times the exact force.

        Parameters
        ----------
        rtol : float, default 1e-6
            The relative difference.

        Returns
        -------
        int
            At most `repeated`.

        Raises
        ------
        ValueError
            If the tolerance is negative or not a number.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).compare([[1, 2], [2, 1]], [0.46, 0.47]).contradictory()
        1
        """
        return self._native.contradictory(_tolerance(rtol))

    def accepted(self, rtol: float = 1e-6) -> bool:
        """Return whether no contact is missing, no pair is extra or contradictory, and no relative error exceeds `rtol`.

        Parameters
        ----------
        rtol : float, default 1e-6
            The maximum relative error.

        Returns
        -------
        bool
            The verdict of `Pile.assert_close`.

        Raises
        ------
        ValueError
            If the tolerance is negative or not a number.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> comparison = Pile(2).compare([[1, 2], [1, 3], [1, 4]], [0.462, 0.462, 0.462])
        >>> comparison.accepted(1e-3), comparison.accepted(1e-4)
        (True, False)
        """
        return self._native.accepted(_tolerance(rtol))

    def findings(self, rtol: float = 1e-6) -> list[str]:
        """Return explanations of the differences, as far as the data show them. The list is empty if all is accepted.

        Parameters
        ----------
        rtol : float, default 1e-6
            The maximum relative error.

        Returns
        -------
        list of str
            One line for each finding: a constant factor, vectors on the other sphere, exchanged axes, a missing layer, ….

        Raises
        ------
        ValueError
            If the tolerance is negative or not a number.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> pile = Pile(10)
        >>> pile.compare(pile.contact_ids(), 9.81 * pile.forces()).findings()[0][:23]
        'all forces are 9.81 tim'
        """
        return self._native.findings(_tolerance(rtol))

    def __str__(self) -> str:
        return str(self._native)

    def __repr__(self) -> str:
        return f"<Comparison: {self}>"

    def _assert_accepted(self, rtol: float) -> None:
        """Raise an AssertionError with the worst contact unless the comparison is accepted."""
        if self.accepted(rtol):
            return
        lines = [
            f"{self.matched} of {self.contacts} contacts measured, {self.missing} missing, {self.extra(rtol)} pairs besides "
            f"them, {self.beyond(rtol)} with an error over {rtol!r}"
        ]
        worst = self.worst
        if worst is not None and worst.error > rtol:
            lines.append(f"worst: {worst.text}; relative error {worst.error:.3e}")
        if self.missing:
            lines.append(f"missing: {self.missing_contacts()[0].text}")
        extra = self._native.worst_extra()
        if extra is not None and self.extra(rtol):
            lines.append(f"extra: {extra}")
        lines.extend(self.findings(rtol))
        raise AssertionError("\n".join(lines))


def _tolerance(rtol: float) -> float:
    if not 0 <= rtol < math.inf:
        raise ValueError(f"rtol: {rtol} is not a finite number of at least 0: use 1e-6")
    return rtol

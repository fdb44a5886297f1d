"""A pile, and all that can be asked of it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

from . import _cannonpile as native
from . import _exact, _measured
from ._comparison import Comparison, _tolerance
from ._figure import Figure
from ._page import Page
from ._records import Bounds, Contact, FloorForce, Multiples

if TYPE_CHECKING:
    from fractions import Fraction

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._exact import Exact


class Pile:
    """A pile of equal spheres.

    A pile does not change, is equal to another with the same spheres, sizes and state, and can be hashed, copied and pickled.

    Parameters
    ----------
    layers : int, optional
        The number of layers, up to 10**36: by default 10, those of a stacking that is spelled out, or as many as a base carries.
    stacking : str, optional
        ``"fcc"``, ``"hcp"``, ``"dhcp"``, or spelled out: as signs ``"++-+"``, as letters ``"ABAC"``, ``"hhc"`` or ``"(2,1,3)"``;
        from the top, with `base` from the base up. Straight (fcc) by default.
    top : str, optional
        The layer from which the pile grows down: ``"hexagon:3"``, ``"hexagon:3,2"``, ``"triangle:4"`` or
        ``"region:x0..x1,y0..y1,s0..s1"``, the bounds of i, j and i + j. One sphere by default.
    base : str, optional
        Instead, the layer from which it grows up.
    dimension : {3, 2}
        Spheres, or discs in a plane.
    sin_phi : exact number, optional
        The sine of the azimuth phi of an isosceles base; 1/2 by default.
    loads : dict, optional
        Vertical loads in mg by the place of a sphere: ``{(k, i, j): W}``, or ``(i, j)`` on the base; discs ``(k, i)``, ``(i,)``.
    weightless : bool, default False
        Whether the spheres weigh nothing, so that only the loads act.
    spacing : exact number, optional
        a/R, half the distance of neighbours of a layer over the radius: 6/5 by default, and 1 in the elastic state.
    radius, mass, gravity : exact number, default 1
        R in m, m in kg and g in m/s².
    state : {"isostatic", "elastic"}
        Which forces are meant where neighbours of a layer touch, a = R: those without horizontal contacts, the paper's, or those
        of springs that only push.
    stiffness_ratio : exact number, default 1
        The stiffness of horizontal contacts over that of sloping ones, of the elastic state.

    Raises
    ------
    ValueError
        For values that are none, and for options that exclude each other. The message names the argument and what is accepted.
    TypeError
        For floats: see `cannonpile`.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(layers=10, stacking="hcp", top="hexagon:3", spacing="6/5", loads={(0, 0, 0): "5/2"}).weight
    Fraction(1485, 2)
    >>> Pile(spacing="1.64", stacking="hcp")
    Traceback (most recent call last):
        ...
    ValueError: spacing 41/25 lets spheres 2 layers apart overlap: a/R must be at least 1 and at most 3/2 = 1.500000
    """

    __slots__ = ("_native",)

    _native: native.Pile

    def __init__(
        self,
        layers: int | None = None,
        stacking: str | None = None,
        *,
        top: str | None = None,
        base: str | None = None,
        dimension: Literal[2, 3] = 3,
        sin_phi: Exact | None = None,
        loads: Mapping[tuple[int, ...], Exact] | None = None,
        weightless: bool = False,
        spacing: Exact | None = None,
        radius: Exact = 1,
        mass: Exact = 1,
        gravity: Exact = 1,
        state: Literal["isostatic", "elastic"] = "isostatic",
        stiffness_ratio: Exact = 1,
    ) -> None:
        if top is not None and base is not None:
            raise ValueError("top has no meaning with base: leave one of the two out")
        options: list[tuple[str, str]] = []
        if layers is not None:
            options.append(("layers", str(_exact.integer("layers", layers))))
        texts = {"stacking": stacking, "top": top, "base": base}
        options.extend((name, _exact.text(name, value)) for name, value in texts.items() if value is not None)
        options.append(("state", _exact.text("state", state)))
        options.append(("dimension", str(_exact.integer("dimension", dimension))))
        ratios = {"sin_phi": sin_phi, "spacing": spacing}
        options.extend((name, _exact.number(name, value)) for name, value in ratios.items() if value is not None)
        sizes = {"radius": radius, "mass": mass, "gravity": gravity, "stiffness_ratio": stiffness_ratio}
        options.extend((name, _exact.number(name, value)) for name, value in sizes.items())
        if weightless:
            options.append(("weightless", "true"))
        try:
            pile = native.Pile(options, _exact.loads(loads))
        except ValueError as error:
            # The only spheres that are named here are loaded ones.
            if str(error).startswith("no sphere at "):
                raise ValueError(f"loads: {error}") from None
            raise
        object.__setattr__(self, "_native", pile)

    @classmethod
    def _of(cls, pile: native.Pile) -> Pile:
        made = object.__new__(cls)
        object.__setattr__(made, "_native", pile)
        return made

    @classmethod
    def from_toml(cls, text: str) -> Pile:
        """Return the pile that a scene file describes: the options of the command line as keys of the same names.

        Parameters
        ----------
        text : str
            The text of the file, as ``cannonpile export`` and `to_toml` write it.

        Returns
        -------
        Pile
            Equal to the one that the file was written of.

        Raises
        ------
        ValueError
            With the line of the file.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile.from_toml('layers = 4\\nspacing = 1.25')
        Pile(layers=4, spacing='5/4')
        >>> Pile.from_toml("spcaing = 1.25")
        Traceback (most recent call last):
            ...
        ValueError: line 1: there is no key 'spcaing'; did you mean 'spacing'?
        """
        return cls._of(native.Pile.from_toml(_exact.text("text", text)))

    def to_toml(self) -> str:
        """Return the scene file of the pile, from which the command line and `from_toml` make the same one.

        Returns
        -------
        str
            The text of the file.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> pile = Pile(4, "hcp", spacing="6/5")
        >>> Pile.from_toml(pile.to_toml()) == pile
        True
        """
        return self._native.to_toml()

    @property
    def layers(self) -> int:
        """The number of layers.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(base="hexagon:3", stacking="hcp").layers
        5
        """
        return self._native.layers

    @property
    def stacking(self) -> str:
        """The name of the stacking, or its steps as signs; ``"discs"`` in two dimensions.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).stacking, Pile(stacking="ABACA").stacking
        ('fcc', '+--+')
        """
        return self._native.stacking

    @property
    def dimension(self) -> int:
        """2 for discs, 3 for spheres.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).dimension
        3
        """
        return self._native.dimension

    @property
    def state(self) -> str:
        """Which forces are meant: ``"isostatic"``, or ``"elastic"``.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(6, "hcp").elastic().state
        'elastic'
        """
        return self._native.state

    @property
    def radius(self) -> Fraction:
        """The radius R of a sphere, in m.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10, radius="0.001").radius
        Fraction(1, 1000)
        """
        return self._native.radius

    @property
    def mass(self) -> Fraction:
        """The mass m of a sphere, in kg.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10, mass="1e-5").mass
        Fraction(1, 100000)
        """
        return self._native.mass

    @property
    def gravity(self) -> Fraction:
        """The gravity g, in m/s².

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10, gravity="9.81").gravity
        Fraction(981, 100)
        """
        return self._native.gravity

    @property
    def spacing(self) -> Fraction:
        """a/R, half the distance of neighbours of a layer over the radius.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).spacing, Pile(10).elastic().spacing
        (Fraction(6, 5), Fraction(1, 1))
        """
        return self._native.spacing

    @property
    def sphere_count(self) -> int:
        """The number N of spheres.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).sphere_count
        220
        """
        return self._native.sphere_count

    @property
    def contact_count(self) -> int:
        """The number M of contacts: all sloping ones, and horizontal ones with a force. The floor is none.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(6, "hcp").contact_count, Pile(6, "hcp").elastic().contact_count
        (126, 129)
        """
        return self._native.contact_count

    @property
    def base_count(self) -> int:
        """The number B of spheres on the floor; they are the last B.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).base_count
        55
        """
        return self._native.base_count

    @property
    def weight(self) -> Fraction:
        """The weight of all spheres and the loads on them, in mg: what the floor carries.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10, loads={(0, 0, 0): "1/2"}).weight
        Fraction(441, 2)
        """
        return self._native.weight

    @property
    def stands(self) -> bool | None:
        """Whether all contacts only push.

        None where spheres touch besides, which may hold the pile, and where the spheres weigh nothing and it is not asked. At
        a = R, ``spacing=1``, it is whether the pile is held with its horizontal contacts.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(7, "hcp").stands, Pile(6, "hcp", spacing=1).stands, Pile(10, weightless=True).stands
        (False, True, None)
        """
        return self._native.stands

    @property
    def unit_force(self) -> float:
        """f0 in N, the unit in which all contact forces are rational: the nearest float.

        Raises
        ------
        ValueError
            For a spacing that the pile cannot have.
        OverflowError
            If no float is near to it.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).unit_force
        0.46225016352102427
        """
        return self._native.unit_force

    def positions(self) -> NDArray[np.float64]:
        """Return the centres of all spheres, each coordinate the nearest float.

        z points up, and is 0 at the centres of the bottom layer; x = y = 0 at the site (0, 0) of the top layer, or of the base
        where the pile was grown from it.

        Returns
        -------
        numpy.ndarray
            float64 of shape (N, 3), in m.

        Raises
        ------
        ValueError
            For a spacing that the pile cannot have.
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).positions()
        array([[ 0. ,  0. ,  1.6],
               [-1.2,  0. ,  0. ],
               [ 1.2,  0. ,  0. ]])
        """
        return native.positions(self._native)

    def sites(self) -> NDArray[np.int64]:
        """Return the sites of all spheres: the layer k, counted from 0 at the top, and the place (i, j) in it.

        Returns
        -------
        numpy.ndarray
            int64 of shape (N, 3): k, i, j.

        Raises
        ------
        OverflowError
            For a coordinate beyond int64.
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).sites().tolist()
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 0, 1]]
        """
        return native.sites(self._native)

    def contact_ids(self) -> NDArray[np.int64]:
        """Return the numbers of the two spheres of all contacts, in the order of ``contacts.csv``.

        Returns
        -------
        numpy.ndarray
            int64 of shape (M, 2), from 1; that of the upper sphere first.

        Raises
        ------
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).contact_ids().tolist()
        [[1, 2], [1, 3], [1, 4]]
        """
        return native.contact_ids(self._native)

    def contact_points(self) -> NDArray[np.float64]:
        """Return where the spheres touch, each coordinate the nearest float.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M, 3), in m.

        Raises
        ------
        ValueError
            For a spacing that the pile cannot have.
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).contact_points()
        array([[-0.6,  0. ,  0.8],
               [ 0.6,  0. ,  0.8]])
        """
        return native.contact_points(self._native)

    def forces(self, units: Literal["si", "pile"] = "si") -> NDArray[np.float64]:
        """Return the forces of all contacts, each the nearest float to the exact one. Positive is push.

        Parameters
        ----------
        units : {"si", "pile"}
            In N, or in f0.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M,), in the order of `contact_ids`.

        Raises
        ------
        ValueError
            For other units; in N, for a spacing that the pile cannot have.
        OverflowError
            For a force beyond float64.
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(3).forces("pile")
        array([1., 1., 1., 2., 1., 1., 1., 2., 1., 1., 1., 2.])
        >>> Pile(2, gravity="9.81").forces()
        array([4.5346741, 4.5346741, 4.5346741])
        """
        return native.forces(self._native, _is_si(units))

    def vectors(self) -> NDArray[np.float64]:
        """Return the force on the first sphere of all contacts, each component the nearest float.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M, 3), in N, z up, in the order of `contact_ids`.

        Raises
        ------
        ValueError
            For a spacing that the pile cannot have.
        OverflowError
            For a force beyond float64.
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).vectors()
        array([[ 0.375,  0.   ,  0.5  ],
               [-0.375,  0.   ,  0.5  ]])
        """
        return native.vectors(self._native)

    def multiples(self) -> Multiples:
        """Return the forces of all contacts as exact multiples of f0.

        Returns
        -------
        Multiples
            ``numerators``, an int64 array of shape (M,) where all fit, else a list of M ints; and their ``denominator``, an int.

        Raises
        ------
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(3, "hcp").multiples().numerators.tolist()
        [3, 3, 3, 2, 5, 5, 5, 2, 5, 5, 5, 2]
        >>> type(Pile(60, "hcp").multiples().numerators)
        <class 'list'>
        """
        return Multiples(*native.multiples(self._native))

    def base(self, units: Literal["si", "pile"] = "si") -> NDArray[np.float64]:
        """Return the forces of all bottom spheres on the floor, each number the nearest float.

        Parameters
        ----------
        units : {"si", "pile"}
            In N; or in mg, mg tan theta and 2 cos phi mg tan theta.

        Returns
        -------
        numpy.ndarray
            float64 of shape (B, 3): normal, shear along x, shear along y; of the last B spheres, in their order.

        Raises
        ------
        ValueError
            For other units; in N, for a spacing that the pile cannot have.
        OverflowError
            For a force beyond float64.
        MemoryError
            If there is no room for them.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(4).base("pile")[0]
        array([ 2. , -0.5, -0.5])
        """
        return native.base(self._native, _is_si(units))

    def force(
        self,
        k: int,
        i: int,
        j: int = 0,
        direction: Literal["alpha", "beta", "gamma", "alpha-beta", "alpha-gamma", "gamma-beta"] = "alpha",
    ) -> Fraction:
        """Return the exact force of one contact, in f0; of piles of up to 10**36 layers.

        Parameters
        ----------
        k, i, j : int
            The upper sphere: its layer, counted from 0 at the top, and its place there. Discs have no j.
        direction : {"alpha", "beta", "gamma", "alpha-beta", "alpha-gamma", "gamma-beta"}
            Where the other sphere lies: below, or beside, at (i+1, j), (i, j+1) or (i+1, j-1).

        Returns
        -------
        fractions.Fraction
            In f0; positive is push.

        Raises
        ------
        ValueError
            If there is no such sphere or direction, or it stands on the floor.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(6, "hcp").force(2, 0, 1, "beta")
        Fraction(19, 9)
        >>> Pile(10**30).force(10**29, 5, 7, "alpha")
        Fraction(99999999999999999999999999989, 1)
        >>> Pile(4).force(7, 0, 0, "alpha")
        Traceback (most recent call last):
            ...
        ValueError: no sphere at k=7, i=0, j=0: the pile has the sites 0 <= k <= 3, 0 <= j <= k, 0 <= i <= k-j
        """
        return native.force(self._native, k, i, j, _exact.text("direction", direction))

    def on_floor(self, i: int, j: int = 0) -> FloorForce:
        """Return the exact force of one bottom sphere on the floor.

        Parameters
        ----------
        i, j : int
            Its place in the bottom layer. Discs have no j.

        Returns
        -------
        FloorForce
            Fractions: ``normal`` in mg, ``shear_x`` in mg tan theta, ``shear_y`` in 2 cos phi mg tan theta.

        Raises
        ------
        ValueError
            If there is no such sphere.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10**30).on_floor(5, 7).normal
        Fraction(333333333333333333333333333334, 1)
        """
        return FloorForce(*native.on_floor(self._native, i, j))

    def sphere_id(self, k: int, i: int, j: int = 0) -> int:
        """Return the number of a sphere, from 1.

        Parameters
        ----------
        k, i, j : int
            Its layer, counted from 0 at the top, and its place there. Discs have no j.

        Returns
        -------
        int
            Its number.

        Raises
        ------
        ValueError
            If there is no such sphere.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(4).sphere_id(1, 0, 1)
        4
        """
        return native.sphere_id(self._native, k, i, j)

    def site(self, sphere_id: int) -> tuple[int, int, int]:
        """Return the sphere of a number: its layer k, and its place (i, j) there.

        Parameters
        ----------
        sphere_id : int
            Its number, from 1.

        Returns
        -------
        tuple of int
            (k, i, j); of discs j is 0.

        Raises
        ------
        ValueError
            If there is no such sphere.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(4).site(4)
        (1, 0, 1)
        """
        site = native.site(self._native, sphere_id)
        if site is None:
            raise ValueError(
                f"sphere_id: no sphere {sphere_id}: the spheres of this pile are numbered 1 to {self.sphere_count}, from the top"
            )
        k, i, j = site
        return k, i, j

    def weakest(self) -> Contact | None:
        """Return the sloping contact with the least force, the first of several.

        Returns
        -------
        Contact or None
            None of a single layer, and where a pile fails near the top and too many contacts would have to be looked at below.

        Raises
        ------
        MemoryError
            For a pile that is too large to be looked through.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(7, "hcp").weakest()
        Contact(k=5, i=-1, j=-1, direction='alpha', force=Fraction(-98, 243))
        """
        contact = native.weakest(self._native)
        return None if contact is None else Contact(*contact)

    def bounds(self, i: int, j: int = 0) -> Bounds:
        """Return what a bottom sphere bears at least and at most at a = R, whatever forces its horizontal contacts have.

        Parameters
        ----------
        i, j : int
            Its place in the bottom layer.

        Returns
        -------
        Bounds
            Fractions ``least`` and ``greatest``, in mg, certified; and ``proved``, whether both are attained.

        Raises
        ------
        ValueError
            If there is no such sphere; if neighbours of a layer do not touch; if no forces balance the pile that only push.
        MemoryError
            For a pile that is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(4).bounds(1, 1).least
        Fraction(1, 1)
        """
        return Bounds(*native.bounds(self._native, i, j))

    def elastic(self, stiffness_ratio: Exact = 1) -> Pile:
        """Return the same pile in its elastic state, at a = R: the forces of springs that only push, exact.

        Parameters
        ----------
        stiffness_ratio : exact number, default 1
            The stiffness of horizontal contacts over that of sloping ones.

        Returns
        -------
        Pile
            Of which all can be asked; its horizontal contacts with a force come last in arrays.

        Raises
        ------
        ValueError
            If neighbours of a layer do not touch; if the pile cannot stand.
        MemoryError
            For a pile that is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> pile = Pile(6, "hcp").elastic()
        >>> pile.contact_ids()[-3:].tolist(), pile.forces("pile")[-3:].round(3).tolist()
        ([[5, 6], [7, 10], [11, 9]], [0.611, 0.611, 0.611])
        """
        return self._of(self._native.elastic(_exact.number("stiffness_ratio", stiffness_ratio)))

    def compare(
        self,
        ids: ArrayLike | None = None,
        forces: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
        centres: ArrayLike | None = None,
        vectors: ArrayLike | None = None,
        within: float = 0.1,
    ) -> Comparison:
        """Hold measured contact forces against the exact ones, contact by contact.

        Contacts are known by the numbers of their spheres, or by where they are, in whatever frame: then axes that are
        exchanged, a turn about the vertical and a shift are found. Their order does not matter, nor which sphere is named first.

        Parameters
        ----------
        ids : array_like of int, shape (M, 2)
            The numbers of the two spheres, from 1.
        forces : array_like of float, shape (M,)
            The magnitudes, in N; positive is push.
        points : array_like of float, shape (M, 3)
            Instead of `ids`: where the spheres touch, in m.
        centres : array_like of float, shape (M, 2, 3)
            Instead of `ids`: the centres of the two spheres, in m.
        vectors : array_like of float, shape (M, 3)
            The forces on the first of the two spheres, in N; with `forces` or in place of them. A point does not tell which
            sphere is the first: with `points` alone a vector is taken for a push.
        within : float, default 0.1
            How far a sphere may be from its place, in radii, where contacts are known by it.

        Returns
        -------
        Comparison
            How many were matched, are missing, are extra; the errors, and the worst of them.

        Raises
        ------
        ValueError
            For arrays that do not fit each other, spheres that are not there, pairs that are there twice, and numbers that are
            not finite. The message names the entry, counted from 1.
        OverflowError
            For exact forces beyond float64.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> pile = Pile(10)
        >>> comparison = pile.compare(pile.contact_ids(), 1.001 * pile.forces())
        >>> comparison.matched, round(comparison.largest_error, 6)
        (495, 0.001)
        >>> pile.compare(points=pile.contact_points() + [0, 0, 8], forces=pile.forces()).largest_error
        0.0
        """
        if not 0 < within < 0.5:
            raise ValueError(f"within: {within} radii are no distance below half of one: 0.1 is usual")
        given: Any = _measured.arrays(ids, forces, points, centres, vectors)
        return Comparison(native.compare(self._native, **given, within=within))

    def assert_close(
        self,
        ids: ArrayLike | None = None,
        forces: ArrayLike | None = None,
        *,
        points: ArrayLike | None = None,
        centres: ArrayLike | None = None,
        vectors: ArrayLike | None = None,
        within: float = 0.1,
        rtol: float = 1e-6,
    ) -> None:
        """Raise an AssertionError unless measured contact forces are the exact ones.

        Nothing may be missing, no pair that is no contact may carry a force, and no relative error may be over `rtol`.

        Parameters
        ----------
        ids, forces, points, centres, vectors, within
            What was measured: see `compare`.
        rtol : float, default 1e-6
            The relative error that is accepted.

        Raises
        ------
        AssertionError
            With the worst contact, its two values, and what the differences have in common.
        ValueError, OverflowError
            As for `compare`.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> pile = Pile(2)
        >>> pile.assert_close(pile.contact_ids(), pile.forces())
        >>> pile.assert_close(pile.contact_ids(), [0.5, 0.46225, 0.46225], rtol=1e-3)
        Traceback (most recent call last):
            ...
        AssertionError: 3 of 3 contacts measured, 0 missing, 0 pairs besides them, 1 with an error over 0.001
        worst: contact of sphere 1 (k=0, i=0, j=0) with sphere 2 along alpha: measured 0.5 N, exact 0.46225016352102427 N; \
relative error 8.167e-02
        """
        _tolerance(rtol)
        comparison = self.compare(ids, forces, points=points, centres=centres, vectors=vectors, within=within)
        comparison._assert_accepted(rtol)

    def plot(
        self,
        kind: Literal["pile", "indexing", "sphere", "shear", "base", "bounds", "network", "response"] = "network",
        *,
        layer: int | None = None,
        at: tuple[int, ...] | None = None,
        units: Literal["si", "pile"] = "pile",
        width: int = 800,
        title: bool = True,
    ) -> Figure:
        """Return a figure.

        Parameters
        ----------
        kind : str, default "network"
            ``"network"``: the contact forces as lines, in a section through the middle, or of a `layer`; ``"base"`` and
            ``"shear"``: the forces on the floor; ``"sphere"``: the forces on one; ``"response"``: what a `layer` feels of the
            loads alone, or of 1 mg on the middle of the top; ``"bounds"``: what bottom spheres can bear at a = R; ``"pile"``: the
            pile in perspective; ``"indexing"``: the indices of a `layer`.
        layer : int, optional
            Counted from 0 at the top.
        at : tuple of int, optional
            The sphere of ``"sphere"``: (k, i, j), or (i, j) on the base.
        units : {"pile", "si"}
            The units of forces and lengths.
        width : int, default 800
            In pixels.
        title : bool, default True
            Whether there is one.

        Returns
        -------
        Figure
            With the SVG, which Jupyter shows.

        Raises
        ------
        ValueError
            For a kind that is none, and for more spheres than can be told apart.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(12, "hcp").plot("network").note[:30]
        'this pile does not stand witho'
        """
        where = None if at is None else _exact.place("at", at)
        return Figure(
            *native.plot(self._native, _exact.text("kind", kind), layer, where, _is_si(units), _width(width), bool(title))
        )

    def show(self) -> Page:
        """Return a page to look into the pile: turned by hand, cut at a layer, each sphere and contact with its exact force.

        Returns
        -------
        Page
            With the HTML, which Jupyter shows.

        Raises
        ------
        ValueError
            For more than 100000 spheres, and for a spacing that the pile cannot have.
        OverflowError
            For a force beyond float64.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> page = Pile(4, "hcp", top="hexagon:3").show()
        >>> page._repr_html_()[:7]
        '<iframe'
        """
        return Page(native.page(self._native))

    def export(self, folder: str | os.PathLike[str], *formats: str) -> list[str]:
        """Write the pile as files, as ``cannonpile export`` does, and return their names.

        Parameters
        ----------
        folder : str or path
            Where to; it is made if it is not there. Older files of these names are replaced.
        *formats : str
            Of ``"csv"``, ``"lammps"``, ``"vtp"``, ``"yade"``, ``"card"``, ``"html"``, ``"lammps-test"``, ``"yade-check"``; csv if there is none.

        Returns
        -------
        list of str
            The names of the files in the folder.

        Raises
        ------
        ValueError
            For a format that is none, and for a spacing that the pile cannot have.
        OSError
            If a file cannot be written.

        Examples
        --------
        >>> import tempfile
        >>> from cannonpile import Pile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     Pile(4).export(folder, "csv")
        ['spheres.csv', 'contacts.csv', 'base.csv', 'columns.csv', 'scene.toml']
        """
        return native.export(self._native, os.fspath(folder), list(formats) or ["csv"])

    def __repr__(self) -> str:
        return repr(self._native)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pile):
            return NotImplemented
        return self._native.equals(other._native)

    def __hash__(self) -> int:
        return hash((Pile, self.layers, self.dimension, self.radius, self.mass, self.gravity, self.state))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_toml, (self.to_toml(),)

    def __copy__(self) -> Pile:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Pile:
        return self


def _is_si(units: str) -> bool:
    if units not in ("si", "pile"):
        raise ValueError(f"units: {units!r} is not one of 'si', 'pile'")
    return units == "si"


def _width(width: int) -> int:
    width = _exact.integer("width", width)
    if not 0 < width <= 100_000:
        raise ValueError(f"width: {width} pixels are no width: 800 is usual, 1 to 100000 are accepted")
    return width

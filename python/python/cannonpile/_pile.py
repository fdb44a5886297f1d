"""The class of a pile."""

from __future__ import annotations

import os
import struct
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

from . import _cannonpile as native
from . import _exact, _measured
from ._comparison import Comparison, _tolerance
from ._figure import Figure
from ._page import Page
from ._records import Bounds, Contact, FloorForce, Multiples, Response, Spread, Stability

if TYPE_CHECKING:
    from fractions import Fraction

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._exact import Exact
    from ._rough import RoughFloor


class Pile:
    """A pile of equal spheres.

    A pile is immutable. Two piles are equal if they have the same spheres, sizes and state. Piles can be hashed, copied and
    pickled.

    Parameters
    ----------
    layers : int, optional
        The number of layers, up to 10**36. The default is 10, or the number that an explicit stacking or a base determines.
    stacking : str, optional
        ``"fcc"`` (default), ``"hcp"``, ``"dhcp"``, or an explicit stacking: signs ``"++-+"``, letters ``"ABAC"``, ``"hhc"`` or
        ``"(2,1,3)"``. It is read from the top, or from the base upwards if `base` is given.
    top : str, optional
        The top layer, from which the pile is built downwards: ``"hexagon:3"``, ``"hexagon:3,2"``, ``"triangle:4"`` or
        ``"region:x0..x1,y0..y1,s0..s1"``, with bounds of i, j and i + j. The default is one sphere.
    base : str, optional
        Instead of `top`: the bottom layer, from which the pile is built upwards.
    dimension : {3, 2}
        3 for spheres, 2 for discs in a plane.
    sin_phi : exact number, optional
        The sine of the azimuth phi of an isosceles base. The default is 1/2.
    loads : dict, optional
        Loads by sphere: ``{(k, i, j): W}`` for W mg downwards, or ``(i, j)`` on the base. For discs ``(k, i)`` or ``(i,)``.
        A load with a direction is ``(W, X, Y)``: X mg tan(theta) along x and Y sqrt(3) mg tan(theta) along y. For discs
        ``(W, X)``.
    tilt : (exact, exact), optional
        Gravity leans by ``(x, y)``: a sphere of weight mg has the load ``(1, x, y)``. One number for discs.
    weightless : bool, default False
        If true, the spheres have no weight and only the loads act.
    spacing : exact number, optional
        a/R, half the distance of neighbours in a layer divided by the radius. The default is 6/5, and 1 in the elastic state.
    radius, mass, gravity : exact number, default 1
        The radius R in m, the mass m in kg and the gravity g in m/s².
    state : {"isostatic", "elastic"}
        The equilibrium state at a = R, where the neighbours of a layer touch: isostatic (no horizontal contacts, as in the
        paper) or elastic (unilateral springs).
    stiffness_ratio : exact number, default 1
        The stiffness of horizontal contacts divided by that of sloping contacts, in the elastic state.

    Raises
    ------
    ValueError
        If a value is invalid, or options exclude each other. The message names the argument and the remedy.
    TypeError
        If an exact number is a float: see `cannonpile`.

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
        loads: Mapping[tuple[int, ...], Exact | tuple[Exact, ...]] | None = None,
        tilt: Exact | tuple[Exact, Exact] | None = None,
        weightless: bool = False,
        spacing: Exact | None = None,
        radius: Exact = 1,
        mass: Exact = 1,
        gravity: Exact = 1,
        state: Literal["isostatic", "elastic"] = "isostatic",
        stiffness_ratio: Exact = 1,
    ) -> None:
        if top is not None and base is not None:
            raise ValueError("top and base exclude each other: remove one of the two")
        options: list[tuple[str, str]] = []
        if layers is not None:
            options.append(("layers", _exact.digits(_exact.integer("layers", layers))))
        texts = {"stacking": stacking, "top": top, "base": base}
        options.extend((name, _exact.text(name, value)) for name, value in texts.items() if value is not None)
        options.append(("state", _exact.text("state", state)))
        options.append(("dimension", _exact.digits(_exact.integer("dimension", dimension))))
        ratios = {"sin_phi": sin_phi, "spacing": spacing}
        options.extend((name, _exact.number(name, value)) for name, value in ratios.items() if value is not None)
        sizes = {"radius": radius, "mass": mass, "gravity": gravity, "stiffness_ratio": stiffness_ratio}
        options.extend((name, _exact.number(name, value)) for name, value in sizes.items())
        if tilt is not None:
            options.append(("tilt", _exact.numbers("tilt", tilt)))
        if weightless:
            options.append(("weightless", "true"))
        try:
            pile = native.Pile(options, _exact.loads(loads))
        except ValueError as error:
            # Only loads name spheres, so the error is about `loads`.
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
        """Return the pile of a scene file, whose keys are the options of the command line.

        Parameters
        ----------
        text : str
            The text of the file, in the format of ``cannonpile export`` and `to_toml`.

        Returns
        -------
        Pile
            The pile. It equals the one that `to_toml` wrote.

        Raises
        ------
        ValueError
            If the text is invalid, with the line, or if the floor is rough: see `RoughFloor.from_toml`.

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
        """Return the scene file of the pile. The command line and `from_toml` build the same pile from it.

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
        """The equilibrium state: ``"isostatic"`` or ``"elastic"``.

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
    def spacing(self) -> Fraction | str:
        """a/R, half the distance of neighbours in a layer divided by the radius; a str if it is irrational.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).spacing, Pile(10).elastic().spacing, Pile(10, spacing="sqrt(2)").spacing
        (Fraction(6, 5), Fraction(1, 1), 'sqrt(2)')
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
        """The number M of contacts: all sloping ones, and horizontal ones with a force. Contacts with the floor do not count.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(6, "hcp").contact_count, Pile(6, "hcp").elastic().contact_count
        (126, 129)
        """
        return self._native.contact_count

    @property
    def base_count(self) -> int:
        """The number B of bottom spheres. They have the last B ids.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).base_count
        55
        """
        return self._native.base_count

    @property
    def weight(self) -> Fraction:
        """The weight of all spheres and loads, in mg. It equals the total reaction at the base.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10, loads={(0, 0, 0): "1/2"}).weight
        Fraction(441, 2)
        """
        return self._native.weight

    @property
    def stands(self) -> bool | None:
        """Whether the pile is stable: no contact force is tensile.

        None if stability is undecided, because further contacts may stabilise the pile, or if the spheres are
        weightless. At a = R (``spacing=1``) horizontal contacts are included.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(7, "hcp").stands, Pile(6, "hcp", spacing=1).stands, Pile(10, weightless=True).stands
        (False, True, None)
        """
        return self._native.stands

    @property
    def unit_force(self) -> float:
        """The unit f0 of contact forces in N, correctly rounded. All contact forces are rational multiples of f0.

        Raises
        ------
        ValueError
            If the spacing is impossible for this stacking.
        OverflowError
            If the unit exceeds float64.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10).unit_force
        0.46225016352102427
        """
        return self._native.unit_force

    def positions(self) -> NDArray[np.float64]:
        """Return the centres of all spheres, correctly rounded.

        z points up and is 0 at the centres of the bottom layer. x = y = 0 at site (0, 0) of the top layer, or of the base if
        the pile was built from a base.

        Returns
        -------
        numpy.ndarray
            float64 of shape (N, 3), in m.

        Raises
        ------
        ValueError
            If the spacing is impossible for this stacking.
        MemoryError
            If the array does not fit into memory.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).positions()
        array([[ 0. ,  0. ,  1.6],
               [-1.2,  0. ,  0. ],
               [ 1.2,  0. ,  0. ]])
        """
        return native.positions(self._native)

    def stresses(self) -> NDArray[np.float64]:
        """Return the stress of all spheres times the volume of a sphere, correctly rounded.

        The product is R Σ f e⊗e over the contacts of a sphere, with normal forces f, positive in compression, and unit
        vectors e. Divide by 4/3 pi R**3 for the stress in Pa. LAMMPS' ``compute stress/atom`` has the opposite sign. The
        floor, weights and loads are not included.

        Returns
        -------
        numpy.ndarray
            float64 of shape (N, 6), in N·m: xx, yy, zz, xy, xz, yz.

        Raises
        ------
        ValueError
            If the spacing is impossible for this stacking.
        OverflowError
            If a component exceeds float64.
        MemoryError
            If the array does not fit into memory.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).stresses()[0]
        array([0.45, 0.  , 0.8 , 0.  , 0.  , 0.  ])
        """
        return native.stresses(self._native)

    def sites(self) -> NDArray[np.int64]:
        """Return the sites of all spheres: layer k, counted from 0 at the top, and position (i, j) in it.

        Returns
        -------
        numpy.ndarray
            int64 of shape (N, 3): k, i, j.

        Raises
        ------
        OverflowError
            If a coordinate exceeds int64.
        MemoryError
            If the array does not fit into memory.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).sites().tolist()
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 0, 1]]
        """
        return native.sites(self._native)

    def contact_ids(self) -> NDArray[np.int64]:
        """Return the ids of the two spheres of each contact, in the order of ``contacts.csv``.

        Returns
        -------
        numpy.ndarray
            int64 of shape (M, 2), counted from 1, with the upper sphere first.

        Raises
        ------
        MemoryError
            If the array does not fit into memory.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).contact_ids().tolist()
        [[1, 2], [1, 3], [1, 4]]
        """
        return native.contact_ids(self._native)

    def contact_points(self) -> NDArray[np.float64]:
        """Return the contact points, correctly rounded.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M, 3), in m.

        Raises
        ------
        ValueError
            If the spacing is impossible for this stacking.
        MemoryError
            If the array does not fit into memory.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).contact_points()
        array([[-0.6,  0. ,  0.8],
               [ 0.6,  0. ,  0.8]])
        """
        return native.contact_points(self._native)

    def forces(self, units: Literal["si", "pile"] = "si") -> NDArray[np.float64]:
        """Return the forces of all contacts, correctly rounded. Compression is positive.

        Parameters
        ----------
        units : {"si", "pile"}
            ``"si"`` for N, ``"pile"`` for f0.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M,), in the order of `contact_ids`.

        Raises
        ------
        ValueError
            If the units are unknown, or in N if the spacing is impossible for this stacking.
        OverflowError
            If a force exceeds float64.
        MemoryError
            If the array does not fit into memory.

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
        """Return the force vector on the first sphere of each contact, correctly rounded.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M, 3), in N, z up, in the order of `contact_ids`.

        Raises
        ------
        ValueError
            If the spacing is impossible for this stacking.
        OverflowError
            If a force exceeds float64.
        MemoryError
            If the array does not fit into memory.

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
            ``numerators``, an int64 array of shape (M,), or a list of M ints if some exceed int64; and their ``denominator``, an
            int.

        Raises
        ------
        MemoryError
            If the array does not fit into memory.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(3, "hcp").multiples().numerators.tolist()
        [3, 3, 3, 2, 5, 5, 5, 2, 5, 5, 5, 2]
        >>> type(Pile(60, "hcp").multiples().numerators)
        <class 'list'>
        """
        try:
            return Multiples(*native.multiples(self._native))
        except OverflowError:
            data, width, denominator = native.long_multiples(self._native)
        read = int.from_bytes
        numerators = [read(number, "little", signed=True) for (number,) in struct.iter_unpack(f"{width}s", data)]
        return Multiples(numerators, denominator)

    def base(self, units: Literal["si", "pile"] = "si") -> NDArray[np.float64]:
        """Return the forces of all bottom spheres on the floor, correctly rounded.

        Parameters
        ----------
        units : {"si", "pile"}
            ``"si"`` for N, ``"pile"`` for mg, mg tan theta and 2 cos phi mg tan theta.

        Returns
        -------
        numpy.ndarray
            float64 of shape (B, 3): normal, shear along x, shear along y, for the last B spheres in their order.

        Raises
        ------
        ValueError
            If the units are unknown, or in N if the spacing is impossible for this stacking.
        OverflowError
            If a force exceeds float64.
        MemoryError
            If the array does not fit into memory.

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
        """Return the exact force of one contact, in f0, for piles of up to 10**36 layers.

        Parameters
        ----------
        k, i, j : int
            The upper sphere: its layer, counted from 0 at the top, and its position there. Discs have no j.
        direction : {"alpha", "beta", "gamma", "alpha-beta", "alpha-gamma", "gamma-beta"}
            The direction of the other sphere: below, or in the same layer at (i+1, j), (i, j+1) or (i+1, j-1).

        Returns
        -------
        fractions.Fraction
            The force in f0. Compression is positive.

        Raises
        ------
        ValueError
            If the sphere or direction does not exist, or the sphere is on the floor.

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
            The position in the bottom layer. Discs have no j.

        Returns
        -------
        FloorForce
            Fractions: ``normal`` in mg, ``shear_x`` in mg tan theta, ``shear_y`` in 2 cos phi mg tan theta.

        Raises
        ------
        ValueError
            If the sphere does not exist.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(10**30).on_floor(5, 7).normal
        Fraction(333333333333333333333333333334, 1)
        """
        return FloorForce(*native.on_floor(self._native, i, j))

    def sphere_id(self, k: int, i: int, j: int = 0) -> int:
        """Return the id of a sphere, counted from 1.

        Parameters
        ----------
        k, i, j : int
            The layer, counted from 0 at the top, and the position in it. Discs have no j.

        Returns
        -------
        int
            The id.

        Raises
        ------
        ValueError
            If the sphere does not exist.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(4).sphere_id(1, 0, 1)
        4
        """
        return native.sphere_id(self._native, k, i, j)

    def site(self, sphere_id: int) -> tuple[int, int, int]:
        """Return the site of the sphere with a given id: layer k and position (i, j) in it.

        Parameters
        ----------
        sphere_id : int
            The id, counted from 1.

        Returns
        -------
        tuple of int
            (k, i, j). For discs j is 0.

        Raises
        ------
        ValueError
            If the sphere does not exist.

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
        """Return the sloping contact with the smallest force, the first one if there are several.

        Returns
        -------
        Contact or None
            None for a single layer, and for an unstable pile with too many contacts to search below its first failure.

        Raises
        ------
        MemoryError
            If the pile is too large for a search.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(7, "hcp").weakest()
        Contact(k=5, i=-1, j=-1, direction='alpha', force=Fraction(-98, 243))
        """
        contact = native.weakest(self._native)
        return None if contact is None else Contact(*contact)

    def stability(self) -> Stability:
        """Return the tilts of gravity that the pile bears, at a = R (``spacing=1``) with horizontal contacts.

        Returns
        -------
        Stability
            ``margin_squared``, the exact square of the least tan(tilt)/tan(theta) beyond which the pile is unstable, or None if
            it is unstable upright; ``opens``, the contact that opens there and its force, None at a = R, where forces are not
            unique; ``corners``, the corners (x, y) of the polygon of tilts.

        Raises
        ------
        ValueError
            If the spheres have no weight, or the linear program at a = R was not solved.
        MemoryError
            If the pile is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(6, "+-+++").stability().margin_squared
        Fraction(1, 43)
        """
        squared, opens, corners = native.stability(self._native)
        return Stability(squared, None if opens is None else Contact(*opens), [(x, y) for x, y in corners])

    def response(self, k: int, i: int, j: int = 0) -> Response:
        """Return all forces per unit of a load on one sphere, for a load downwards, along x and along y.

        The weight of the spheres, and the loads and the tilt of this pile, have no effect.

        Parameters
        ----------
        k, i, j : int
            The loaded sphere.

        Returns
        -------
        Response
            ``contacts``, for each sloping contact the forces (down, x, y) in f0, in the order of ``contact_ids``; ``base``, for
            each bottom sphere the forces on the floor (down, x, y). Discs have (down, x).

        Raises
        ------
        ValueError
            If the sphere does not exist.
        MemoryError
            If the pile is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> [tuple(map(str, forces)) for forces in Pile(2).response(0, 0, 0).contacts]
        [('1', '-1', '-3'), ('1', '-1', '3'), ('1', '2', '0')]
        >>> Pile(2).response(0, 0, 0).base[0][0].normal
        Fraction(1, 3)
        """
        units = native.response(self._native, k, i, j)
        contacts = list(zip(*(contacts for contacts, _ in units), strict=True))
        floor = ([FloorForce(*force) for force in base] for _, base in units)
        return Response(contacts, list(zip(*floor, strict=True)))

    def sensitivity(self, k: int, i: int, j: int = 0) -> list[Fraction]:
        """Return the change of each contact force if one sphere is larger, per relative growth of its radius.

        Weights, loads and the centres of the bottom spheres stay as they are.

        Parameters
        ----------
        k, i, j : int
            The larger sphere.

        Returns
        -------
        list of Fraction
            For each sloping contact the change in f0, exact to first order, in the order of ``contact_ids``.

        Raises
        ------
        ValueError
            If the sphere does not exist, or the spacing is impossible for this stacking.
        MemoryError
            If the pile is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, spacing="6/5").sensitivity(1, 0, 0)
        [Fraction(-283, 234), Fraction(175, 468), Fraction(175, 468)]
        """
        return native.sensitivity(self._native, k, i, j)

    def spread(self) -> Spread | None:
        """Return the contact that opens first if all radii deviate independently, and the deviation at which it does.

        Returns
        -------
        Spread or None
            ``contact``, with its force; ``variance`` of this force, divided by the square of the relative standard deviation r
            of the radii; ``bearable_squared``, r squared where the force is three standard deviations above zero. None if some
            contact needs tension, or no radius changes a force.

        Raises
        ------
        ValueError
            If the spacing is impossible for this stacking.
        MemoryError
            If the pile is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> spread = Pile(4, spacing="6/5").spread()
        >>> spread.contact, f"{float(spread.bearable_squared) ** 0.5:.3f}"
        (Contact(k=1, i=0, j=0, direction='beta', force=Fraction(1, 1)), '0.052')
        """
        spread = native.spread(self._native)
        return None if spread is None else Spread(Contact(*spread[0]), *spread[1:])

    def bounds(self, i: int, j: int = 0) -> Bounds:
        """Return bounds of the normal force of a bottom sphere at a = R, over all admissible horizontal forces.

        Parameters
        ----------
        i, j : int
            The position in the bottom layer.

        Returns
        -------
        Bounds
            Certified fractions ``least`` and ``greatest`` in mg, and ``proved``, true if both are attained.

        Raises
        ------
        ValueError
            If the sphere does not exist, the neighbours of a layer do not touch, or no compressive forces balance the pile.
        MemoryError
            If the pile is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(4).bounds(1, 1).least
        Fraction(1, 1)
        """
        return Bounds(*native.bounds(self._native, i, j))

    def elastic(self, stiffness_ratio: Exact = 1) -> Pile:
        """Return the same pile in its elastic state at a = R: the exact forces of unilateral springs.

        Parameters
        ----------
        stiffness_ratio : exact number, default 1
            The stiffness of horizontal contacts divided by that of sloping contacts.

        Returns
        -------
        Pile
            The pile with its horizontal forces. Horizontal contacts with a force are the last ones in arrays.

        Raises
        ------
        ValueError
            If the neighbours of a layer do not touch, or the pile is unstable.
        MemoryError
            If the pile is too large.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> pile = Pile(6, "hcp").elastic()
        >>> pile.contact_ids()[-3:].tolist(), pile.forces("pile")[-3:].round(3).tolist()
        ([[5, 6], [7, 10], [11, 9]], [0.611, 0.611, 0.611])
        """
        return self._of(self._native.elastic(_exact.number("stiffness_ratio", stiffness_ratio)))

    def on_rough_floor(self, friction: Exact | None = None, floor_friction: Exact | None = None) -> RoughFloor:
        """Return two layers on a rough floor, without glue, with friction at all contacts.

        Parameters
        ----------
        friction : exact number, optional
            The coefficient of friction between spheres. By default it is large enough.
        floor_friction : exact number, optional
            The coefficient of friction between spheres and floor. By default it is large enough.

        Returns
        -------
        RoughFloor
            The pile with its exact normal and tangential forces.

        Raises
        ------
        ValueError
            If the forces are not unique: unless there are two layers, neighbours of a layer do not touch (a > R), and gravity and
            all loads are vertical. Also if a coefficient is not positive.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> rough = Pile(2, top="hexagon:3").on_rough_floor(friction="1/2", floor_friction="1/4")
        >>> rough.stands, rough.floor_friction_needed
        (True, 0.1006356683102495)
        >>> Pile(3).on_rough_floor()
        Traceback (most recent call last):
            ...
        ValueError: a rough floor needs two layers (with three, the forces are not unique), but this pile has 3 layers: \
change that, or use a floor with glue
        """
        from ._rough import RoughFloor

        given = {"friction": friction, "floor_friction": floor_friction}
        texts = {name: None if value is None else _exact.number(name, value) for name, value in given.items()}
        return RoughFloor(native.RoughFloor(self._native, **texts), self)

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
        """Compare measured contact forces with the exact ones, contact by contact.

        Contacts are identified by the ids of their spheres or by position. Positions may be shifted, turned about the
        vertical, mirrored, and have any axis as their vertical: this is detected. The order of the contacts, and of the
        two spheres of each, does not matter.

        Parameters
        ----------
        ids : array_like of int, shape (M, 2)
            The ids of the two spheres, counted from 1.
        forces : array_like of float, shape (M,)
            The magnitudes in N. Compression is positive.
        points : array_like of float, shape (M, 3)
            Instead of `ids`: the contact points, in m.
        centres : array_like of float, shape (M, 2, 3)
            Instead of `ids`: the centres of the two spheres, in m.
        vectors : array_like of float, shape (M, 3)
            The forces on the first of the two spheres, in N, in addition to `forces` or instead. A contact point does not
            identify the first sphere: with `points` alone a vector is interpreted as compression.
        within : float, default 0.1
            The position tolerance in radii, if contacts are identified by position.

        Returns
        -------
        Comparison
            The numbers of matched, missing and extra contacts, and the errors.

        Raises
        ------
        ValueError
            If array shapes do not match, a sphere does not exist, a pair occurs three times, or a number is not finite. The
            message names the entry, counted from 1.
        OverflowError
            If an exact force exceeds float64.

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
            raise ValueError(f"within: {within} is not between 0 and 0.5 radii: use 0.1")
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
        """Raise an AssertionError unless measured contact forces agree with the exact ones.

        No contact may be missing, no other pair may carry a force, and no relative error may exceed `rtol`.

        Parameters
        ----------
        ids, forces, points, centres, vectors, within
            The measurement: see `compare`.
        rtol : float, default 1e-6
            The maximum relative error.

        Raises
        ------
        AssertionError
            With the worst contact, its two values, and an explanation of the differences.
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
            ``"network"``: the contact forces as lines, in a section through the middle or in a `layer`. ``"base"`` and
            ``"shear"``: the forces on the floor. ``"sphere"``: the forces on one sphere. ``"response"``: the forces in a
            `layer` caused by the loads alone, or by 1 mg at the centre of the top. ``"bounds"``: bounds of the base forces at
            a = R. ``"pile"``: the pile in perspective. ``"indexing"``: the indices of a `layer`.
        layer : int, optional
            The layer, counted from 0 at the top.
        at : tuple of int, optional
            The sphere for ``"sphere"``: (k, i, j), or (i, j) on the base.
        units : {"pile", "si"}
            The units of forces and lengths.
        width : int, default 800
            The width in pixels.
        title : bool, default True
            If true, the figure has a title.

        Returns
        -------
        Figure
            The figure as SVG, which Jupyter displays.

        Raises
        ------
        ValueError
            If the kind is unknown, or the spheres would be too small to distinguish.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(12, "hcp").plot("network").note[:30]
        'this pile is unstable without '
        """
        where = None if at is None else _exact.place("at", at)
        return Figure(
            *native.plot(self._native, _exact.text("kind", kind), layer, where, _is_si(units), _width(width), bool(title))
        )

    def show(self) -> Page:
        """Return an interactive page: rotate the pile, cut it at a layer, select spheres and contacts to see their exact forces.

        Returns
        -------
        Page
            The page as HTML, which Jupyter displays.

        Raises
        ------
        ValueError
            If the pile has more than 100000 spheres, or the spacing is impossible for this stacking.
        OverflowError
            If a force exceeds float64.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> page = Pile(4, "hcp", top="hexagon:3").show()
        >>> page._repr_html_()[:7]
        '<iframe'
        """
        return Page(native.page(self._native))

    def export(self, folder: str | os.PathLike[str], *formats: str) -> list[str]:
        """Write the files of ``cannonpile export`` and return their names.

        Parameters
        ----------
        folder : str or path
            The folder. It is created if necessary. Existing files of these names are replaced.
        *formats : str
            ``"csv"`` (default), ``"lammps"``, ``"vtp"``, ``"yade"``, ``"card"``, ``"mtx"`` (in pile units) or ``"html"``.

        Returns
        -------
        list of str
            The names of the files in the folder.

        Raises
        ------
        ValueError
            If a format is unknown, or the spacing is impossible for this stacking.
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
        raise ValueError(f"width: {width} is not between 1 and 100000 pixels: use 800")
    return width

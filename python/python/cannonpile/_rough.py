"""The class of two layers on a rough floor."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _cannonpile as native
from . import _exact, _measured
from ._comparison import Comparison, _tolerance
from ._pile import Pile, _is_si
from ._records import FloorForce, RoughContact

if TYPE_CHECKING:
    from fractions import Fraction

    from numpy.typing import ArrayLike, NDArray


class RoughFloor:
    """Two layers on a rough floor, without glue: the result of `Pile.on_rough_floor`.

    The bottom spheres lie on a plane and may slide and roll. A contact transmits a normal force N, and a tangential force
    T = N tan(theta/2) across it. The forces are unique: they depend neither on the springs nor on the history.

    It is immutable. It can be compared, hashed, copied and pickled, like its `pile`. The order of spheres and contacts is that of
    the pile.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> four = Pile(2, spacing="6/5").on_rough_floor(friction="0.41")
    >>> four.contacts()[0].normal, four.friction_needed, four.stands
    (Fraction(1, 3), 0.402542673240998, True)
    """

    __slots__ = ("_native", "_pile")

    def __init__(self, rough: native.RoughFloor, pile: Pile) -> None:
        self._native = rough
        self._pile = pile

    @classmethod
    def from_toml(cls, text: str) -> RoughFloor:
        """Return the rough floor of a scene file with ``floor = "rough"``.

        Parameters
        ----------
        text : str
            The text of the file, in the format of ``cannonpile export`` and `to_toml`.

        Returns
        -------
        RoughFloor
            The pile on its floor, with the coefficients of friction of the scene.

        Raises
        ------
        ValueError
            If the text is invalid, or the floor has glue.

        Examples
        --------
        >>> from cannonpile import RoughFloor
        >>> RoughFloor.from_toml('layers = 2\\nfloor = "rough"\\nfriction = 0.41')
        Pile(layers=2).on_rough_floor(friction='41/100')
        """
        rough = native.RoughFloor.from_toml(_exact.text("text", text))
        return cls(rough, Pile._of(rough.pile()))

    def to_toml(self) -> str:
        """Return the scene file. The command line and `from_toml` read it.

        Returns
        -------
        str
            The text of the file.

        Examples
        --------
        >>> from cannonpile import Pile, RoughFloor
        >>> four = Pile(2).on_rough_floor(floor_friction="1/4")
        >>> RoughFloor.from_toml(four.to_toml()) == four
        True
        """
        return self._native.to_toml()

    @property
    def pile(self) -> Pile:
        """The same pile on a floor with glue. It has the positions, ids and sizes of the spheres.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).on_rough_floor().pile.contact_ids().tolist()
        [[1, 2], [1, 3], [1, 4]]
        """
        return self._pile

    @property
    def friction(self) -> Fraction | None:
        """The given coefficient of friction between spheres, or None.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).on_rough_floor("0.41").friction
        Fraction(41, 100)
        """
        return self._native.friction

    @property
    def floor_friction(self) -> Fraction | None:
        """The given coefficient of friction between spheres and floor, or None.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).on_rough_floor(floor_friction="1/4").floor_friction
        Fraction(1, 4)
        """
        return self._native.floor_friction

    @property
    def friction_needed(self) -> float:
        """The least coefficient of friction between spheres, tan(theta/2), correctly rounded.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, spacing="6/5").on_rough_floor().friction_needed
        0.402542673240998
        """
        return self._native.needed[0][0]

    @property
    def floor_friction_needed(self) -> float:
        """The least coefficient of friction of the floor, correctly rounded: the largest ratio of friction to normal force.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, spacing="6/5").on_rough_floor().floor_friction_needed
        0.1006356683102495
        """
        return self._native.needed[1][0]

    @property
    def exact_friction_needed(self) -> str:
        """The exact `friction_needed`, as a sum of roots.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, spacing="6/5").on_rough_floor().exact_friction_needed
        '5/6*sqrt(3)-1/6*sqrt(39)'
        """
        return self._native.needed[0][1]

    @property
    def exact_floor_friction_needed(self) -> str:
        """The exact `floor_friction_needed`, as a sum of roots.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, spacing="6/5").on_rough_floor().exact_floor_friction_needed
        '5/24*sqrt(3)-1/24*sqrt(39)'
        """
        return self._native.needed[1][1]

    @property
    def stands(self) -> bool | None:
        """Whether the pile stands with the given coefficients of friction. None if neither is given.

        The comparison is exact. A coefficient that is not given is large enough.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> [Pile(2, spacing="6/5").on_rough_floor(friction).stands for friction in ("0.402", "0.403", None)]
        [False, True, None]
        """
        return self._native.stands

    def contacts(self) -> list[RoughContact]:
        """Return the contacts between spheres, in the order of ``pile.contact_ids()``.

        Returns
        -------
        list of RoughContact
            ``normal`` in mg and ``tangential`` in mg tan(theta/2), exact; and the two forces on the upper sphere in N.

        Raises
        ------
        OverflowError
            If a force exceeds float64.
        MemoryError
            If there are too many contacts.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> for contact in Pile(2).on_rough_floor().contacts():
        ...     print(contact.ids, contact.direction, contact.normal, contact.tangential)
        (1, 2) alpha 1/3 1/3
        (1, 3) beta 1/3 1/3
        (1, 4) gamma 1/3 1/3
        """
        return [
            RoughContact(ids, k, i, j, direction, force, force, normal, tangential)
            for ids, k, i, j, direction, force, normal, tangential in native.rough_contacts(self._native)
        ]

    def normal_vectors(self) -> NDArray[np.float64]:
        """Return the normal force on the upper sphere of each contact, correctly rounded.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M, 3), in N, z up, in the order of ``pile.contact_ids()``.

        Raises
        ------
        OverflowError, MemoryError
            As for `contacts`.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).on_rough_floor().normal_vectors()
        array([[ 0.3,  0. ,  0.4],
               [-0.3,  0. ,  0.4]])
        """
        return np.array([contact.normal_vector for contact in self.contacts()]).reshape(-1, 3)

    def tangential_vectors(self) -> NDArray[np.float64]:
        """Return the tangential force on the upper sphere of each contact, correctly rounded.

        Returns
        -------
        numpy.ndarray
            float64 of shape (M, 3), in N, z up, in the order of ``pile.contact_ids()``.

        Raises
        ------
        OverflowError, MemoryError
            As for `contacts`.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).on_rough_floor().tangential_vectors().round(4)
        array([[-0.1333,  0.    ,  0.1   ],
               [ 0.1333,  0.    ,  0.1   ]])
        """
        return np.array([contact.tangential_vector for contact in self.contacts()]).reshape(-1, 3)

    def base(self, units: Literal["si", "pile"] = "si") -> NDArray[np.float64]:
        """Return the forces of all bottom spheres on the floor, correctly rounded.

        Parameters
        ----------
        units : {"si", "pile"}
            ``"si"`` for N, ``"pile"`` for mg, mg tan(theta/2) and 2 cos phi mg tan(theta/2).

        Returns
        -------
        numpy.ndarray
            float64 of shape (B, 3): normal, friction along x, friction along y, for the last B spheres in their order.

        Raises
        ------
        ValueError
            If the units are unknown.
        OverflowError
            If a force exceeds float64.
        MemoryError
            If there are too many bottom spheres.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).on_rough_floor().base("pile")
        array([[ 1.5, -0.5,  0. ],
               [ 1.5,  0.5,  0. ]])
        """
        if not _is_si(units):
            # The numbers are the same. Only the unit of horizontal forces is another one.
            return self.pile.base("pile")
        return np.array(native.rough_base(self._native))

    def floor_vectors(self) -> NDArray[np.float64]:
        """Return the force of the floor on each bottom sphere, correctly rounded: the opposite of `base`, as vectors.

        Returns
        -------
        numpy.ndarray
            float64 of shape (B, 3), in N, z up, for the last B spheres in their order.

        Raises
        ------
        OverflowError, MemoryError
            As for `base`.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2, dimension=2).on_rough_floor().floor_vectors().round(4)
        array([[ 0.1667,  0.    ,  1.5   ],
               [-0.1667,  0.    ,  1.5   ]])
        """
        normal, x, y = self.base().T
        return np.column_stack([0 - x, 0 - y, normal])

    def on_floor(self, i: int, j: int = 0) -> FloorForce:
        """Return the exact force of one bottom sphere on the floor.

        Parameters
        ----------
        i, j : int
            The position in the bottom layer. Discs have no j.

        Returns
        -------
        FloorForce
            Fractions: ``normal`` in mg, ``shear_x`` in mg tan(theta/2), ``shear_y`` in 2 cos phi mg tan(theta/2).

        Raises
        ------
        ValueError
            If the sphere does not exist.

        Examples
        --------
        >>> from cannonpile import Pile
        >>> Pile(2).on_rough_floor().on_floor(0, 1)
        FloorForce(normal=Fraction(4, 3), shear_x=Fraction(1, 3), shear_y=Fraction(0, 1))
        """
        return self.pile.on_floor(i, j)

    def compare(
        self,
        ids: ArrayLike,
        forces: ArrayLike | None = None,
        *,
        vectors: ArrayLike | None = None,
        tangential: ArrayLike | None = None,
        floor: ArrayLike | None = None,
    ) -> Comparison:
        """Compare measured forces with the exact ones: normal and tangential forces, the forces of the floor, and moments.

        The order of the contacts, and of the two spheres of each, does not matter. `Pile.compare` describes the errors.

        Parameters
        ----------
        ids : array_like of int, shape (M, 2)
            The ids of the two spheres, counted from 1. The id 0 is the floor.
        forces : array_like of float, shape (M,)
            The magnitudes of the normal forces in N. Compression is positive.
        vectors : array_like of float, shape (M, 3)
            The normal forces on the first of the two spheres, in N. Without `tangential`, they are the whole forces. Nothing is
            accepted without vectors, because friction is then unknown.
        tangential : array_like of float, shape (M, 3)
            The tangential forces on the first of the two spheres, in N.
        floor : array_like of float, shape (B, 3)
            The forces of the floor on the bottom spheres, which have the last B ids, in N.

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
        A wrong sign of the tangential forces:

        >>> from cannonpile import Pile
        >>> four = Pile(2).on_rough_floor()
        >>> ids, normal, tangential = four.pile.contact_ids(), four.normal_vectors(), four.tangential_vectors()
        >>> four.compare(ids, vectors=normal, tangential=-tangential).findings()[0][:73]
        'normal forces are right, but all tangential forces have the wrong sign, a'
        >>> four.compare(ids, vectors=normal + tangential, floor=four.floor_vectors()).accepted(1e-12)
        True
        """
        given: Any = _measured.with_friction(ids, forces, vectors, tangential, floor, self.pile)
        return Comparison(native.compare_rough(self._native, **given))

    def compare_files(
        self,
        contacts: str | os.PathLike[str],
        floor: str | os.PathLike[str] | None = None,
        *,
        preset: str = "lammps",
    ) -> Comparison:
        """Compare the tables of a simulation with the exact forces, as ``cannonpile verify`` does.

        Parameters
        ----------
        contacts : str or path
            The file with the contacts: a text table, a dump of LAMMPS or a VTK file, of the last step.
        floor : str or path, optional
            The file with the force of the floor on each sphere, in the columns id, fx, fy and fz.
        preset : str, default "lammps"
            The code that wrote the contacts: ``"lammps"`` (and tables with the column names of this package), ``"yade"``,
            ``"exadem"``, ``"exadem-vtp"``, ``"dem-engine"``, ``"kratos"``, ``"mddem"``, ``"lethe"`` or ``"mercurydpm"``.

        Returns
        -------
        Comparison
            The numbers of matched, missing and extra contacts, and the errors.

        Raises
        ------
        ValueError
            If the preset is unknown, or a file cannot be read as such a table. The message gives the line.
        OSError
            If a file cannot be opened.

        Examples
        --------
        >>> from pathlib import Path
        >>> from cannonpile import Pile
        >>> discs = Pile(2, dimension=2).on_rough_floor()
        >>> Path("forces.csv").write_text("id1,id2,fx,fy,fz,tx,ty,tz\\n1,2,.3,0,.4,0,0,0\\n1,3,-.3,0,.4,0,0,0\\n") > 0
        True
        >>> comparison = discs.compare_files("forces.csv")
        >>> comparison.largest_error, comparison.tangential_error
        (0.0, 1.0)
        """
        table, on_floor = Path(contacts), None if floor is None else Path(floor).read_bytes()
        preset = _exact.text("preset", preset)
        return Comparison(
            native.compare_rough_tables(self._native, table.read_bytes(), on_floor, preset, os.fspath(table.parent))
        )

    def assert_close(
        self,
        ids: ArrayLike,
        forces: ArrayLike | None = None,
        *,
        vectors: ArrayLike | None = None,
        tangential: ArrayLike | None = None,
        floor: ArrayLike | None = None,
        rtol: float = 1e-6,
    ) -> None:
        """Raise an AssertionError unless measured forces agree with the exact ones.

        Parameters
        ----------
        ids, forces, vectors, tangential, floor
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
        >>> four = Pile(2).on_rough_floor()
        >>> forces = {"vectors": four.normal_vectors(), "tangential": four.tangential_vectors()}
        >>> four.assert_close(four.pile.contact_ids(), **forces, floor=four.floor_vectors())
        """
        _tolerance(rtol)
        self.compare(ids, forces, vectors=vectors, tangential=tangential, floor=floor)._assert_accepted(rtol)

    def export(self, folder: str | os.PathLike[str], *formats: str) -> list[str]:
        """Write scripts for a simulation, or a benchmark card, and return the names of the files.

        A coefficient of friction that is not given is twice the needed one.

        Parameters
        ----------
        folder : str or path
            The folder. It is created if necessary. Existing files of these names are replaced.
        *formats : str
            ``"lammps"`` (default), ``"yade"`` or ``"card"``.

        Returns
        -------
        list of str
            The names of the files in the folder.

        Raises
        ------
        ValueError
            If a format is unknown or needs a floor with glue.
        OSError
            If a file cannot be written.

        Examples
        --------
        >>> import tempfile
        >>> from cannonpile import Pile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     Pile(2).on_rough_floor().export(folder, "lammps", "yade")
        ['pile.data', 'pile.in', 'spheres.txt', 'pile.py', 'scene.toml']
        """
        return native.export_rough(self._native, os.fspath(folder), list(formats) or ["lammps"])

    def __repr__(self) -> str:
        given = {"friction": self.friction, "floor_friction": self.floor_friction}
        options = ", ".join(f"{name}='{value}'" for name, value in given.items() if value is not None)
        return f"{self.pile!r}.on_rough_floor({options})"

    def _key(self) -> tuple[Any, ...]:
        return self.pile, self.friction, self.floor_friction

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, RoughFloor):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash((RoughFloor, *self._key()))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self).from_toml, (self.to_toml(),)

    def __copy__(self) -> RoughFloor:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> RoughFloor:
        return self

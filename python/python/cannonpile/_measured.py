"""Conversion of measured data to the arrays that the library compares."""

from __future__ import annotations

from decimal import Decimal
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._pile import Pile


def arrays(
    ids: ArrayLike | None,
    forces: ArrayLike | None,
    points: ArrayLike | None,
    centres: ArrayLike | None,
    vectors: ArrayLike | None,
) -> dict[str, NDArray[Any] | None]:
    """Return flat, contiguous arrays of int64 and float64, after a check that all have the same number of contacts.

    Raises
    ------
    ValueError
        If an array has the wrong shape, or the lengths differ.
    TypeError
        If ids are not integers.

    Examples
    --------
    >>> arrays([[1, 2], [1, 3]], [0.5, 0.5], None, None, None)["ids"]
    array([1, 2, 1, 3])
    """
    return _flat(
        {
            "ids": _ids(ids),
            "points": _floats("points", points, (3,)),
            "centres": _floats("centres", centres, (2, 3)),
            "forces": _floats("forces", forces, ()),
            "vectors": _floats("vectors", vectors, (3,)),
        }
    )


def with_friction(
    ids: ArrayLike,
    forces: ArrayLike | None,
    vectors: ArrayLike | None,
    tangential: ArrayLike | None,
    floor: ArrayLike | None,
    pile: Pile,
) -> dict[str, NDArray[Any] | None]:
    """Return flat, contiguous arrays of a measurement on a rough floor, after a check of their lengths.

    Raises
    ------
    ValueError
        If an array has the wrong shape, the lengths differ, or two arguments give the forces of the floor.
    TypeError
        If ids are not integers.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> with_friction([[1, 2]], [0.5], None, [[0.1, 0, 0]], None, Pile(2))["tangential"]
    array([0.1, 0. , 0. ])
    """
    pairs, on_base = _ids(ids), _floats("floor", floor, (3,))
    given = _flat(
        {
            "ids": pairs,
            "forces": _floats("forces", forces, ()),
            "vectors": _floats("vectors", vectors, (3,)),
            "tangential": _floats("tangential", tangential, (3,)),
        }
    )
    if on_base is not None:
        if len(on_base) != pile.base_count:
            raise ValueError(f"floor: {len(on_base)} forces: give one for each of the {pile.base_count} bottom spheres")
        if not np.isfinite(on_base).all():
            raise ValueError("floor: a force is not a finite number")
        if pairs is not None and ((pairs == 0) | (pairs > pile.sphere_count)).any():
            raise ValueError("floor: ids contain contacts with the floor too; remove these or floor")
    return given | {"on_base": None if on_base is None else on_base.ravel()}


def _flat(given: dict[str, NDArray[Any] | None]) -> dict[str, NDArray[Any] | None]:
    lengths = {name: len(array) for name, array in given.items() if array is not None}
    if len(set(lengths.values())) > 1:
        found = ", ".join(f"{length} {name}" for name, length in lengths.items())
        raise ValueError(f"{found}: the lengths must be equal, one entry for each contact")
    return {name: None if array is None else array.ravel() for name, array in given.items()}


def _ids(ids: ArrayLike | None) -> NDArray[np.int64] | None:
    if ids is None:
        return None
    _check_masks("ids", ids)
    array = np.asarray(ids)
    if array.size == 0:
        array = array.reshape(-1, 2)
    _check_shape("ids", array, (2,))
    if array.dtype.kind == "f" and not np.array_equal(array, np.floor(array)):
        raise TypeError("ids: the ids of spheres are integers, but some of these have fractions")
    if array.dtype.kind not in "iuf" and array.size > 0:
        raise TypeError(f"ids: the ids of spheres are integers, not {array.dtype}")
    # 0 is a floor or a wall.
    if array.size > 0 and not (0 <= array.min() and array.max() <= 2**53):
        raise ValueError(
            f"ids: spheres are numbered from 1 at the top to at most 2**53, but the ids go from {array.min()} to {array.max()}"
        )
    return np.ascontiguousarray(array, dtype=np.int64)


def _floats(name: str, values: ArrayLike | None, row: tuple[int, ...]) -> NDArray[np.float64] | None:
    if values is None:
        return None
    _check_masks(name, values)
    try:
        given = np.asarray(values)
        _check_kind(name, given)
        array = np.ascontiguousarray(given, dtype=np.float64)
    except (OverflowError, TypeError, ValueError) as error:
        prefix = f"{name}: "
        raise type(error)(prefix + str(error).removeprefix(prefix)) from None
    if np.ndim(values) == 0:
        array = array.reshape(())
    if array.size == 0:
        array = array.reshape(-1, *row)
    _check_shape(name, array, row)
    return array


def _check_masks(name: str, values: Any) -> None:
    if np.ma.is_masked(values):
        raise ValueError(f"{name}: some entries are masked: leave out their contacts, or fill them")


def _check_kind(name: str, array: NDArray[Any]) -> None:
    """Check that the entries are real numbers. NumPy would read None as nan, and 1 + 2j as 1."""
    # Fractions, decimals and long integers are objects.
    real = (Real, Decimal, np.integer, np.floating)
    if array.dtype.kind == "O":
        wrong = [type(entry).__name__ for entry in array.flat if isinstance(entry, bool) or not isinstance(entry, real)]
    else:
        wrong = [] if array.dtype.kind in "iuf" or array.size == 0 else [str(array.dtype)]
    if wrong:
        raise TypeError(f"{name}: the entries must be real numbers, not {wrong[0]}")


def _check_shape(name: str, array: NDArray[Any], row: tuple[int, ...]) -> None:
    if array.ndim == 1 + len(row) and array.shape[1:] == row:
        return
    expected = ", ".join(["M", *map(str, row)]) + ("," if not row else "")
    raise ValueError(f"{name}: the array must have the shape ({expected}), not {array.shape}")

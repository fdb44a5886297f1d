"""Functions that do not belong to a single pile: cases, theorems, census, means."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Literal

from . import _cannonpile as native
from . import _exact
from ._pile import Pile
from ._records import Case, CensusEntry, FrictionCase, Known, MeanForce, Theorem
from ._rough import RoughFloor

if TYPE_CHECKING:
    from ._exact import Exact


def cases() -> list[Case]:
    """Return the benchmark cases without friction, with citable names.

    Published cases are frozen: none is altered or removed.

    Returns
    -------
    list of Case
        Tuples ``(name, pile, known)``, suitable for ``pytest.mark.parametrize``.

    Examples
    --------
    >>> from cannonpile import cases
    >>> [name for name, pile, known in cases() if known.stands is False]
    ['C8', 'C16']

    To test a code on all of them::

        @pytest.mark.parametrize("name, pile, known", cannonpile.cases())
        def test_forces(name, pile, known):
            ids, forces = my_code(pile.positions(), pile.radius)
            pile.assert_close(ids, forces)
    """
    return [
        Case(name, Pile._of(pile), Known(title, purpose, stands))
        for name, pile, title, purpose, stands in native.cases()
    ]


def friction_cases() -> list[FrictionCase]:
    """Return the benchmark cases with friction: two layers on a rough floor.

    Published cases are frozen: none is altered or removed.

    Returns
    -------
    list of FrictionCase
        Tuples ``(name, rough_floor, known)``, suitable for ``pytest.mark.parametrize``.

    Examples
    --------
    >>> from cannonpile import friction_cases
    >>> [(name, known.stands) for name, rough_floor, known in friction_cases()]
    [('C17', True), ('C18', True), ('C19', False), ('C20', False)]
    """
    return [
        FrictionCase(name, RoughFloor(rough, Pile._of(rough.pile())), Known(title, purpose, stands))
        for name, rough, title, purpose, stands in native.friction_cases()
    ]


def prove(name: str | None = None) -> list[Theorem]:
    """Run the proofs of the theorems about all piles, on the formulas of the library, and return the results.

    Parameters
    ----------
    name : str, optional
        The name of one theorem. By default all are proved.

    Returns
    -------
    list of Theorem
        The theorems, each with its statement and the result of its proof.

    Raises
    ------
    ValueError
        If no theorem has this name. The message lists the names.

    Examples
    --------
    >>> from cannonpile import prove
    >>> all(theorem.holds for theorem in prove())
    True
    """
    return [Theorem(*row) for row in native.prove(name)]


def census(
    layers: int | None = None,
    *,
    base: str | None = None,
    standing: bool = False,
    horizontal: bool = False,
) -> Iterator[CensusEntry]:
    """Return an iterator over stackings and their stability, with one stacking of each mirror pair.

    Parameters
    ----------
    layers : int, optional
        The number of layers, for stackings under one sphere. The default is 10.
    base : str, optional
        Instead of `layers`: every stacking on this base, extended upwards as far as it goes.
    standing : bool, default False
        If true, only stable stackings are returned. Otherwise the shortest unstable prefixes are returned too.
    horizontal : bool, default False
        If true, horizontal contacts are included, as at a = R.

    Returns
    -------
    iterator of CensusEntry
        The entries, computed on demand.

    Raises
    ------
    ValueError
        If layers or base are invalid, or both are given.
    MemoryError
        If there are too many entries.

    Examples
    --------
    >>> from cannonpile import census
    >>> sum(entry.stands for entry in census(10))
    11
    """
    if layers is not None and base is not None:
        raise ValueError("layers and base exclude each other: remove one of the two")
    height = _exact.digits(_exact.integer("layers", 10 if layers is None else layers))
    shape = None if base is None else _exact.text("base", base)
    entries = native.census(height, shape, bool(standing), bool(horizontal))
    return (CensusEntry(*entry) for entry in entries)


def mean(
    layers: int = 10,
    *,
    top: str | None = None,
    base: str | None = None,
    loads: Mapping[tuple[int, ...], Exact] | None = None,
    weightless: bool = False,
    fault_probability: Exact = "1/2",
    first: Literal["+", "-", "random"] = "+",
    given_sphere: bool = False,
) -> list[MeanForce]:
    """Return the exact mean base force at each position, over random stackings.

    Each step after the first has the opposite sign of the previous step with the fault probability, independently. 0 is fcc,
    1 is hcp, and at 1/2 all stackings are equally likely. The mean includes unstable stackings.

    Parameters
    ----------
    layers : int, default 10
        The number of layers.
    top : str, optional
        The top layer of the piles, or ``"plane"`` for infinite layers, which need `weightless` and `loads`.
    base : str, optional
        Instead of `top`: the bottom layer of the piles. A stacking that does not reach the height counts as one without spheres.
    loads : dict, optional
        Vertical loads in mg on spheres of the top layer: ``{(0, i, j): W}``.
    weightless : bool, default False
        If true, the spheres have no weight and only the loads act.
    fault_probability : exact number, default 1/2
        The probability of a sign change, from 0 to 1.
    first : {"+", "-", "random"}
        The sign of the first step.
    given_sphere : bool, default False
        If true, the means are over the stackings that have a sphere at the position.

    Returns
    -------
    list of MeanForce
        A row for each position where some stacking has a sphere.

    Raises
    ------
    ValueError
        If an option is invalid, or options exclude each other.
    MemoryError
        If the piles are too large.

    Examples
    --------
    >>> from cannonpile import mean
    >>> rows = mean(5, top="plane", weightless=True, loads={(0, 0, 0): 1})
    >>> sum(row.normal for row in rows)
    Fraction(1, 1)
    """
    if top is not None and base is not None:
        raise ValueError("top and base exclude each other: remove one of the two")
    rows = native.mean(
        _exact.digits(_exact.integer("layers", layers)),
        None if top is None else _exact.text("top", top),
        None if base is None else _exact.text("base", base),
        _exact.loads(loads),
        bool(weightless),
        _exact.number("fault_probability", fault_probability),
        _exact.text("first", first),
        bool(given_sphere),
    )
    return [MeanForce(a, b, *numbers) for a, b, numbers in rows]

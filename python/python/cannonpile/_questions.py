"""What is asked of no single pile."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Literal

from . import _cannonpile as native
from . import _exact
from ._pile import Pile
from ._records import Case, CensusEntry, Known, MeanForce, Theorem

if TYPE_CHECKING:
    from ._exact import Exact


def cases() -> list[Case]:
    """Return the benchmark cases, with names that others can quote.

    A case that was published is never altered, and none is taken away.

    Returns
    -------
    list of Case
        Tuples ``(name, pile, known)``, as ``pytest.mark.parametrize`` takes them.

    Examples
    --------
    >>> from cannonpile import cases
    >>> [name for name, pile, known in cases() if known.stands is False]
    ['C8']

    A code tests itself on all of them::

        @pytest.mark.parametrize("name, pile, known", cannonpile.cases())
        def test_forces(name, pile, known):
            ids, forces = my_code(pile.positions(), pile.radius)
            pile.assert_close(ids, forces)
    """
    return [
        Case(name, Pile._of(pile), Known(title, purpose, stands))
        for name, pile, title, purpose, stands in native.cases()
    ]


def prove(name: str | None = None) -> list[Theorem]:
    """Run the proofs of what holds for every pile, on the formulas that answer here, and return whether they hold.

    Parameters
    ----------
    name : str, optional
        Of one theorem; by default all are proved.

    Returns
    -------
    list of Theorem
        Each with its statement, and whether its proof holds.

    Raises
    ------
    ValueError
        For a name that no theorem has; the message lists them.

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
    """Return which stackings stand, one of each mirror pair, one after the other.

    Parameters
    ----------
    layers : int, optional
        The stackings of so many layers under one sphere; 10 by default.
    base : str, optional
        Instead, every stacking of this base, carried as high as it goes.
    standing : bool, default False
        Whether only those that stand are wanted; else the shortest beginnings that fail come too.
    horizontal : bool, default False
        Whether horizontal contacts are counted in, as at a = R.

    Returns
    -------
    iterator of CensusEntry
        Each found when it is asked for.

    Raises
    ------
    ValueError
        For layers or a base that are none, or both given.
    MemoryError
        For more entries than can be listed.

    Examples
    --------
    >>> from cannonpile import census
    >>> sum(entry.stands for entry in census(10))
    11
    """
    if layers is not None and base is not None:
        raise ValueError("layers has no meaning with base: leave one of the two out")
    height = str(_exact.integer("layers", 10 if layers is None else layers))
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
    """Return what each place of the floor bears in the mean over random stackings, exact.

    Each step from layer to layer but the first differs in sign from the one before with the fault probability, independently: 0 is
    fcc, 1 is hcp, and at 1/2 all stackings are equally likely. The mean is over all of them, also those that cannot stand.

    Parameters
    ----------
    layers : int, default 10
        The number of layers.
    top : str, optional
        The layer from which the piles grow down, or ``"plane"`` for layers without end, with `weightless` and `loads`.
    base : str, optional
        Instead, the layer from which they grow up; a stacking that it does not carry so high counts as one without spheres.
    loads : dict, optional
        Vertical loads in mg on spheres of the top layer: ``{(0, i, j): W}``.
    weightless : bool, default False
        Whether only the loads act.
    fault_probability : exact number, default 1/2
        From 0 to 1.
    first : {"+", "-", "random"}
        The sign of the first step.
    given_sphere : bool, default False
        Whether the means are over those stackings alone that have a sphere at the place.

    Returns
    -------
    list of MeanForce
        A row for each place where some stacking has a sphere.

    Raises
    ------
    ValueError
        For options that are none, or exclude each other.
    MemoryError
        For piles that are too large.

    Examples
    --------
    >>> from cannonpile import mean
    >>> rows = mean(5, top="plane", weightless=True, loads={(0, 0, 0): 1})
    >>> sum(row.normal for row in rows)
    Fraction(1, 1)
    """
    if top is not None and base is not None:
        raise ValueError("top has no meaning with base: leave one of the two out")
    rows = native.mean(
        str(_exact.integer("layers", layers)),
        None if top is None else _exact.text("top", top),
        None if base is None else _exact.text("base", base),
        _exact.loads(loads),
        bool(weightless),
        _exact.number("fault_probability", fault_probability),
        _exact.text("first", first),
        bool(given_sphere),
    )
    return [MeanForce(a, b, *numbers) for a, b, numbers in rows]

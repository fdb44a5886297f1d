"""Exact contact forces in regular piles of spheres, and whether a simulation got them right.

G. Oron and H. J. Herrmann ("Contact forces in regular 3D granular pile", 1998) solved the stack of cannonballs: identical,
stiff, frictionless spheres piled on a triangle. This package gives their forces, and those of any stacking, on any six-sided
layer, under loads: as arrays of the nearest floats, and as exact fractions.

>>> import cannonpile
>>> pile = cannonpile.Pile(layers=4, stacking="hcp", top="hexagon:3", gravity="9.81")
>>> pile.stands
True
>>> pile.forces().shape, pile.contact_ids().shape, pile.positions().shape
((249,), (249, 2), (131, 3))
>>> pile.force(2, 1, -3, "gamma")
Fraction(2, 9)

A simulation is tested in one line: ``pile.assert_close(ids, forces, rtol=1e-6)``.

Exact inputs
    Lengths, masses, loads and ratios are exact: a str such as ``"6/5"``, ``"1.2"`` or ``"1e-3"``, an int, a ``Fraction`` or
    a ``Decimal``. A float is refused: 1.2 is not 6/5, but 5404319552844595/4503599627370496.

Order
    Spheres are numbered from 1, in row order from the top. Contacts come by their upper sphere, along alpha, beta and gamma,
    and after them the horizontal ones with a force. So it is in all files that ``cannonpile export`` writes.

Units
    SI: m, kg, N; or pile units: contact forces in f0 = mg/(3 cos theta), the unit in which all are rational, and forces on
    the floor in mg, mg tan theta and sqrt(3) mg tan theta. (f0 is mg/(2 (1 + sin phi) cos theta) on an isosceles base.)

Errors
    ``ValueError`` says what is wrong with an argument and what would be accepted, ``TypeError`` that it is a float,
    ``OverflowError`` that a float64 cannot hold an answer, ``MemoryError`` that there is no room for it.

Threads
    What takes long runs on all cores and leaves the interpreter to other threads; Ctrl-C ends it.
"""

from ._cannonpile import __version__
from ._comparison import Comparison
from ._exact import Exact
from ._figure import Figure
from ._page import Page
from ._pile import Pile
from ._questions import cases, census, mean, prove
from ._records import (
    Bounds,
    Case,
    CensusEntry,
    Contact,
    Difference,
    FloorForce,
    Known,
    MeanForce,
    Multiples,
    Theorem,
)

__all__ = [
    "Bounds",
    "Case",
    "CensusEntry",
    "Comparison",
    "Contact",
    "Difference",
    "Exact",
    "Figure",
    "FloorForce",
    "Known",
    "MeanForce",
    "Multiples",
    "Page",
    "Pile",
    "Theorem",
    "__version__",
    "cases",
    "census",
    "mean",
    "prove",
]

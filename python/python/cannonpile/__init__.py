"""Exact contact forces in regular sphere piles, and verification of simulations against them.

G. Oron and H. J. Herrmann ("Contact forces in regular 3D granular pile", 1998) solved the stack of cannonballs: identical,
rigid, frictionless spheres piled on a triangle. This package computes the forces of this pile, and of any stacking on any
six-sided layer under loads. It returns them as arrays of correctly rounded floats and as exact fractions.

>>> import cannonpile
>>> pile = cannonpile.Pile(layers=4, stacking="hcp", top="hexagon:3", gravity="9.81")
>>> pile.stands
True
>>> pile.forces().shape, pile.contact_ids().shape, pile.positions().shape
((249,), (249, 2), (131, 3))
>>> pile.force(2, 1, -3, "gamma")
Fraction(2, 9)

One line tests a simulation: ``pile.assert_close(ids, forces, rtol=1e-6)``.

Exact inputs
    Lengths, masses, loads and ratios are exact: a str such as ``"6/5"``, ``"1.2"`` or ``"1e-3"``, an int, a ``Fraction`` or
    a ``Decimal``. A float is an error: the float 1.2 is not 6/5, but 5404319552844595/4503599627370496.

Order
    Spheres are numbered from 1, in row order from the top. Contacts are sorted by their upper sphere and then by direction:
    alpha, beta, gamma. Horizontal contacts with a force follow at the end. The files of ``cannonpile export`` have the same
    order.

Units
    SI units are m, kg and N. In pile units all forces are rational: contact forces in f0 = mg/(3 cos theta), base forces in
    mg, mg tan theta and sqrt(3) mg tan theta. (On an isosceles base f0 is mg/(2 (1 + sin phi) cos theta).)

Friction
    The spheres have no friction, and the bottom layer is fixed. `Pile.on_rough_floor` returns the exact forces of two layers with
    friction on a floor without glue.

Errors
    ``ValueError``: an argument is invalid; the message states the value and the remedy. ``TypeError``: an argument has the
    wrong type, for instance float. ``OverflowError``: a result exceeds float64. ``MemoryError``: a result exceeds the memory.

Threads
    Long computations use all cores and release the interpreter lock. Ctrl-C cancels them.
"""

from ._cannonpile import __version__
from ._comparison import Comparison
from ._exact import Exact
from ._figure import Figure
from ._page import Page
from ._pile import Pile
from ._questions import cases, census, friction_cases, mean, prove
from ._records import (
    Bounds,
    Case,
    CensusEntry,
    Contact,
    Difference,
    FloorForce,
    FrictionCase,
    Known,
    MeanForce,
    Multiples,
    Response,
    RoughContact,
    Spread,
    Stability,
    Theorem,
)
from ._rough import RoughFloor

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
    "FrictionCase",
    "Known",
    "MeanForce",
    "Multiples",
    "Page",
    "Pile",
    "Response",
    "RoughContact",
    "RoughFloor",
    "Spread",
    "Stability",
    "Theorem",
    "__version__",
    "cases",
    "census",
    "friction_cases",
    "mean",
    "prove",
]

from fractions import Fraction
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._pile import Pile
from ._rough import RoughFloor

class Multiples(NamedTuple):
    numerators: NDArray[np.int64] | list[int]
    denominator: int

class Contact(NamedTuple):
    k: int
    i: int
    j: int
    direction: str
    force: Fraction

class FloorForce(NamedTuple):
    normal: Fraction
    shear_x: Fraction
    shear_y: Fraction

class RoughContact(NamedTuple):
    ids: tuple[int, int]
    k: int
    i: int
    j: int
    direction: str
    normal: Fraction
    tangential: Fraction
    normal_vector: tuple[float, float, float]
    tangential_vector: tuple[float, float, float]

class Stability(NamedTuple):
    margin_squared: Fraction | None
    opens: Contact | None
    corners: list[tuple[Fraction, Fraction]]

class Response(NamedTuple):
    contacts: list[tuple[Fraction, ...]]
    base: list[tuple[FloorForce, ...]]

class Spread(NamedTuple):
    contact: Contact
    variance: Fraction
    bearable_squared: Fraction

class Bounds(NamedTuple):
    least: Fraction
    greatest: Fraction
    proved: bool

class Theorem(NamedTuple):
    name: str
    statement: str
    hypotheses: str
    symbols: str
    method: str
    holds: bool

class CensusEntry(NamedTuple):
    stacking: str
    layers: int
    stands: bool
    least_force: Fraction | None
    normal_min: Fraction | None
    normal_max: Fraction | None
    margin_squared: Fraction | None

class MeanForce(NamedTuple):
    a: int
    b: int
    probability: Fraction
    normal: Fraction
    shear_x: Fraction
    shear_y: Fraction

class Known(NamedTuple):
    title: str
    purpose: str
    stands: bool | None

class Case(NamedTuple):
    name: str
    pile: Pile
    known: Known

class FrictionCase(NamedTuple):
    name: str
    rough_floor: RoughFloor
    known: Known

class Difference(NamedTuple):
    ids: tuple[int, int]
    k: int
    i: int
    j: int
    direction: str
    exact: float
    measured: float | None
    error: float
    text: str

"""Exact inputs, as the texts that the library reads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias, Union

import numpy as np

if TYPE_CHECKING:
    from decimal import Decimal
    from fractions import Fraction

#: A number that is meant exactly.
Exact: TypeAlias = Union[str, int, "Fraction", "Decimal"]


def number(name: str, value: Exact) -> str:
    """Return a number as the text ``6/5`` that the library reads.

    Raises
    ------
    TypeError
        For a float, and for what is no number.

    Examples
    --------
    >>> from fractions import Fraction
    >>> number("spacing", "1.2"), number("spacing", Fraction(6, 5)), number("spacing", 2)
    ('1.2', '6/5', '2')
    >>> number("spacing", 1.2)
    Traceback (most recent call last):
        ...
    TypeError: spacing: 1.2 is a float, and no float is 1.2 exactly: this one is 5404319552844595/4503599627370496; write \
'1.2', or a Fraction or a Decimal
    """
    if isinstance(value, str):
        return value
    if isinstance(value, (float, np.floating)):
        raise TypeError(_why_no_float(name, value))
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: {value} is no number: write an int, a str such as '6/5', a Fraction or a Decimal")
    try:
        # An int, a Fraction, an integer of NumPy.
        numerator, denominator = value.numerator, value.denominator  # type: ignore[union-attr]
    except AttributeError:
        try:
            # A Decimal.
            numerator, denominator = value.as_integer_ratio()
        except (AttributeError, OverflowError, ValueError):
            raise TypeError(
                f"{name}: {value!r} is no exact number: write an int, a str such as '6/5', a Fraction or a Decimal"
            ) from None
    return f"{int(numerator)}" if denominator == 1 else f"{int(numerator)}/{int(denominator)}"


def _why_no_float(name: str, value: Any) -> str:
    value = float(value)
    try:
        numerator, denominator = value.as_integer_ratio()
    except (OverflowError, ValueError):
        return f"{name}: {value} is a float and no number: write an int, a str such as '6/5', a Fraction or a Decimal"
    if denominator == 1:
        return f"{name}: {value} is a float, and exact numbers are asked for: write {numerator}"
    return (
        f"{name}: {value} is a float, and no float is {value} exactly: this one is {numerator}/{denominator}; "
        f"write '{value}', or a Fraction or a Decimal"
    )


def integer(name: str, value: Any) -> int:
    """Return an integer.

    Raises
    ------
    TypeError
        For what is none, a float such as 2.0 included.

    Examples
    --------
    >>> integer("layers", 10)
    10
    >>> integer("layers", 10.0)
    Traceback (most recent call last):
        ...
    TypeError: layers: 10.0 is a float; write an int
    """
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{name}: {value!r} is a {type(value).__name__}; write an int")
    return int(value.__index__())


def text(name: str, value: Any) -> str:
    """Return a text.

    Raises
    ------
    TypeError
        For what is none.

    Examples
    --------
    >>> text("stacking", "hcp")
    'hcp'
    """
    if not isinstance(value, str):
        raise TypeError(f"{name}: {value!r} is a {type(value).__name__}; write a str")
    return value


def place(name: str, value: Any) -> str:
    """Return the place of a sphere as the text ``K,I,J``.

    Raises
    ------
    TypeError
        For what is no tuple of integers.

    Examples
    --------
    >>> place("at", (0, 0, 0))
    '0,0,0'
    """
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise TypeError(f"{name}: {value!r} is no place; write (k, i, j), or (i, j) on the base")
    return ",".join(str(integer(name, n)) for n in value)


def loads(value: Mapping[tuple[int, ...], Exact] | None) -> list[tuple[str, str]]:
    """Return loads as pairs of texts, the place and the weight.

    Raises
    ------
    TypeError
        For what is no mapping from places to exact numbers.

    Examples
    --------
    >>> loads({(0, 0, 0): "5/2"})
    [('0,0,0', '5/2')]
    """
    if value is None:
        return []
    if not isinstance(value, Mapping):
        raise TypeError("loads: write a dict such as {(0, 0, 0): '5/2'}")
    return [(place("loads", at), number("loads", weight)) for at, weight in value.items()]

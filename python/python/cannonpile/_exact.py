"""Conversion of exact inputs to the texts that the library parses."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeAlias, Union

import numpy as np

if TYPE_CHECKING:
    from fractions import Fraction

#: An exact number.
Exact: TypeAlias = Union[str, int, "Fraction", "Decimal"]


def number(name: str, value: Exact) -> str:
    """Return an exact number as text, for example ``6/5``.

    Raises
    ------
    TypeError
        If the value is a float or not a number.

    Examples
    --------
    >>> from fractions import Fraction
    >>> number("spacing", "1.2"), number("spacing", Fraction(6, 5)), number("spacing", 2)
    ('1.2', '6/5', '2')
    >>> number("spacing", 1.2)
    Traceback (most recent call last):
        ...
    TypeError: spacing: 1.2 is a float, which is not exact (its value is 5404319552844595/4503599627370496): write '1.2', a \
Fraction or a Decimal
    """
    if isinstance(value, str):
        return value
    if isinstance(value, (float, np.floating)):
        raise TypeError(_float_message(name, value))
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: {value} is a bool: write an int, a str such as '6/5', a Fraction or a Decimal")
    try:
        # An int, a Fraction or a NumPy integer.
        numerator, denominator = value.numerator, value.denominator  # type: ignore[union-attr]
    except AttributeError:
        try:
            # A Decimal.
            numerator, denominator = value.as_integer_ratio()
        except (AttributeError, OverflowError, ValueError):
            raise TypeError(
                f"{name}: {value!r} is not an exact number: write an int, a str such as '6/5', a Fraction or a Decimal"
            ) from None
    return digits(numerator) if denominator == 1 else f"{digits(numerator)}/{digits(denominator)}"


def digits(value: Any) -> str:
    """Return an integer of any length as text. `str` refuses integers of more than 4300 digits.

    Examples
    --------
    >>> len(digits(10**5000))
    5001
    """
    return f"{Decimal(int(value)):f}"


def _float_message(name: str, value: Any) -> str:
    value = float(value)
    try:
        numerator, denominator = value.as_integer_ratio()
    except (OverflowError, ValueError):
        return f"{name}: {value} is a float and not a number: write an int, a str such as '6/5', a Fraction or a Decimal"
    if denominator == 1:
        return f"{name}: {value} is a float, but the number must be exact: write {numerator}"
    return (
        f"{name}: {value} is a float, which is not exact (its value is {numerator}/{denominator}): write '{value}', a "
        "Fraction or a Decimal"
    )


def integer(name: str, value: Any) -> int:
    """Return an integer.

    Raises
    ------
    TypeError
        If the value is not an integer. A float such as 2.0 is an error too.

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
        If the value is not a str.

    Examples
    --------
    >>> text("stacking", "hcp")
    'hcp'
    """
    if not isinstance(value, str):
        raise TypeError(f"{name}: {value!r} is a {type(value).__name__}; write a str")
    return value


def place(name: str, value: Any) -> str:
    """Return a site as the text ``K,I,J``.

    Raises
    ------
    TypeError
        If the value is not a tuple of integers.

    Examples
    --------
    >>> place("at", (0, 0, 0))
    '0,0,0'
    """
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        raise TypeError(f"{name}: {value!r} is not a site; write (k, i, j), or (i, j) on the base")
    return ",".join(digits(integer(name, n)) for n in value)


def numbers(name: str, value: Exact | tuple[Exact, ...]) -> str:
    """Return one exact number, or a tuple of them, as a text with commas.

    Raises
    ------
    TypeError
        If the value is neither an exact number nor a tuple of them.

    Examples
    --------
    >>> numbers("tilt", ("1/10", 0))
    '1/10,0'
    """
    if isinstance(value, tuple):
        return ",".join(number(name, part) for part in value)
    return number(name, value)


def loads(value: Mapping[tuple[int, ...], Exact | tuple[Exact, ...]] | None) -> list[tuple[str, str]]:
    """Return loads as pairs of texts: site and weight, or site and the components of a load with a direction.

    Raises
    ------
    TypeError
        If the value is not a mapping from sites to exact numbers or tuples of them.

    Examples
    --------
    >>> loads({(0, 0, 0): "5/2"})
    [('0,0,0', '5/2')]
    """
    if value is None:
        return []
    if not isinstance(value, Mapping):
        raise TypeError(f"loads: {value!r} is not a dict; write one such as {{(0, 0, 0): '5/2'}}")
    return [(place("loads", at), numbers("loads", load)) for at, load in value.items()]

#!/usr/bin/env python3
"""Writes the hard cases of rounding in crates/surd/tests/hard_cases.txt, with floats by python-flint.

    surd_cases.py           compares the file with the present cases
    surd_cases.py --write   replaces it

Needs python-flint 0.9. The search takes some seconds. The exit status is 1 if the file differs.
"""

import sys
from fractions import Fraction
from math import isqrt
from pathlib import Path

from flint import fmpq

from surd_reference import F32, F64, nearest, normal, printed, printed_sum

FILE = Path(__file__).resolve().parent.parent / "crates/surd/tests/hard_cases.txt"
HEAD = """\
# Numbers that are hard to round, with their correctly rounded floats: to nearest, ties to even. An overflow is an infinity.
#
# Columns: the number as printed, the bits of its f64, the bits of its f32. A number is c*sqrt(r), or a sum of two such terms.
# The floats are those of python-flint. To check the file, or to write it again: .ci/surd_cases.py.
"""
ONE = fmpq(1)


def power(e):
    return fmpq(2) ** e


def midpoint(significand, exponent):
    """Returns the midpoint above significand·2^exponent."""
    return fmpq(2 * significand + 1) * power(exponent - 1)


def places(form):
    """Yields floats as significand and exponent: powers of two, their neighbours, subnormals and the largest floats."""
    precision, smallest, largest, _ = form
    most, top = 2**precision - 1, largest - precision
    hidden = 2 ** (precision - 1)
    yield from [(0, smallest), (1, smallest), (2, smallest), (hidden - 1, smallest), (hidden, smallest)]
    yield from [(most, 1 - precision), (hidden, 1 - precision), (hidden + 1, 1 - precision), (most - 1, top), (most, top)]


def ties(form):
    for significand, exponent in places(form):
        m = midpoint(significand, exponent)
        yield (m, ONE)
        yield (-m, ONE)
        # Far less than a double-double resolves, above and below.
        for digits in (110, 300):
            for off in (power(-digits), -power(-digits)):
                yield (ONE, m**2 * (1 + off))
        yield (m * (1 + power(-200)), ONE)
        yield (-m * (1 - power(-200)), ONE)


def roots_of_floats(form):
    """Yields √n for floats n such that M² − n·2^j is small, for a midpoint M: the square roots that are hardest to round."""
    bits = form[0] + 1
    j = bits + 1
    for small in (1, -7, 9, -15, 17, -23, 25, 33):
        # The odd square roots of a number that is 1 modulo 8, modulo 2^j, bit by bit.
        root = 1
        for k in range(3, j + 1):
            if (root * root - small) % 2**k:
                root += 2 ** (k - 2)
        for m in {r % 2**bits for s in (root, -root) for r in (s, s + 2 ** (j - 1))}:
            if m >= 2 ** (bits - 1):
                n = (m * m - small) >> j
                assert m * m - small == n << j and n < 2**bits
                yield (ONE, fmpq(n * 2 ** (j % 2)))


def distance(value, form):
    """Returns the distance of a long integer to the next midpoint of floats, in units of 2^−100 of the last place."""
    ulp = value.bit_length() - form[0]
    return abs((value & (1 << ulp) - 1) - (1 << ulp - 1)) >> ulp - 100


def nearest_misses(form):
    """Yields the roots of integers below 2^18, and the sums and differences of two roots of integers up to 300, that come
    closest to a midpoint."""
    roots = {n: isqrt(n << 400) for n in range(2, 2**18) if isqrt(n) ** 2 != n}
    for n in sorted(roots, key=lambda n: distance(roots[n], form))[:8]:
        yield (ONE, fmpq(n))
    few = [n for n in roots if n <= 300 and all(n % (p * p) for p in (2, 3, 5, 7, 11, 13, 17))]
    pairs = [(a, b, s) for a in few for b in few if b < a for s in (1, -1)]
    for a, b, s in sorted(pairs, key=lambda pair: distance(roots[pair[0]] + pair[2] * roots[pair[1]], form))[:8]:
        yield (ONE, fmpq(a)), (fmpq(s), fmpq(b))


def convergents(x):
    """Yields the convergents of a fraction, which come closest to it among all fractions of their size."""
    (p, q), (a, b) = (1, 0), (0, 1)
    while True:
        whole = x.numerator // x.denominator
        (p, q), (a, b) = (whole * p + a, whole * q + b), (p, q)
        yield p, q
        if x == whole:
            return
        x = 1 / (x - whole)


def fractions_near_midpoints(form):
    """Yields fractions n/d, and multiples of √2, √3 and √39, near a midpoint; n and d have about 20, 64 and 128 bits."""
    hidden = 2 ** (form[0] - 1)
    for significand in (hidden + 1, hidden + hidden // 3, 2 * hidden - 2):
        m = Fraction(2 * significand + 1, 2 * hidden)
        for r in (1, 2, 3, 39):
            # m/√r, to 600 bits.
            x = Fraction(isqrt((m.numerator**2 << 1200) // (m.denominator**2 * r)), 1 << 600)
            for bits in (64, 128):
                near = [(p, q) for p, q in convergents(x) if q.bit_length() <= bits and p * p * r != m * m * q * q]
                yield (fmpq(*near[-1]), fmpq(r))


def limits():
    """Yields irrational numbers around the smallest and the largest floats of both formats."""
    for form in (F64, F32):
        precision, smallest, largest, _ = form
        for e in (smallest - 60, smallest - 2, smallest - 1, smallest, smallest + 1, smallest + precision - 2, smallest + precision):
            # √2 is a little more than 7/5: above and below a half, one, and the least normal float.
            yield (power(e), fmpq(2))
            yield (-power(e) * fmpq(5, 7), fmpq(2))
        for e in (largest - 2, largest - 1, largest):
            yield (power(e), fmpq(2))
            yield (power(e) * fmpq(5, 7), fmpq(2))
            yield (-power(e) * fmpq(985, 1393), fmpq(2))


def cancellations():
    """Yields sums of terms that nearly cancel."""
    for n in (2, 10, 10**8, 10**16 + 1, 10**30, 10**154, 10**161, 10**308, 10**323, 10**324):
        yield (ONE, fmpq(n) ** 2 + 1), (fmpq(-n), ONE)
        yield (fmpq(n), ONE), (fmpq(-1), fmpq(n) ** 2 - 1)
        yield (ONE, fmpq(n) + 1), (fmpq(-1), fmpq(n))
    for r in (2, 3, 39):
        # √r to 1000 bits: its last convergents are wrong.
        near = list(convergents(Fraction(isqrt(r << 2000), 1 << 1000)))
        for index in (5, 20, 40, 100, 300):
            p, q = near[index]
            yield (fmpq(q), fmpq(r)), (fmpq(-p), ONE)
    # Two roots that are equal to twenty, forty and a hundred digits.
    for digits in (20, 40, 100):
        c = fmpq(isqrt(2 * 10 ** (2 * digits) // 3), 10**digits)
        yield (ONE, fmpq(2)), (-c, fmpq(3))


def sums_near_ties():
    """Yields sums of an irrational number and a rational near midpoints."""
    for form in (F64, F32):
        hidden = 2 ** (form[0] - 1)
        for significand, exponent in [(hidden, 1 - form[0]), (hidden + 1, 1 - form[0]), (1, form[1]), (2 * hidden - 1, form[2] - form[0])]:
            m = midpoint(significand, exponent)
            for digits in (100, 400):
                for off in (0, 1):
                    # √3·2^e rounded down or up, at a distance of about 2^−digits of the midpoint.
                    root = fmpq(isqrt(3 << 2 * digits) + off, 1) * power(exponent - digits)
                    yield (power(exponent), fmpq(3)), (m - root, ONE)


def long_numbers():
    for bits in (500, 2000):
        n, d = 3**bits // 2 ** (bits // 2) | 1, 5 ** (bits // 2) | 1
        yield (fmpq(n, d), ONE)
        yield (fmpq(-n, d), fmpq(39))
        yield (fmpq(d, n), fmpq(2))
        yield (fmpq(1), fmpq(n))
        # n/d near 1 + 2^−53, the midpoint above 1: only the last bits tell the side.
        yield (fmpq(d * (2**53 + 1) + 1, d * 2**53), ONE)
        yield (fmpq(d * (2**53 + 1) - 1, d * 2**53), ONE)


def hidden_squares():
    """Yields roots with squares of primes above 1000, which are not extracted."""
    yield (ONE, fmpq(1009**2 * 1013))
    yield (fmpq(1, 1013), fmpq(1013**2 * 2 * 1019))
    yield (fmpq(1, 2**40), fmpq(1_000_003**2 * 1_000_033))
    # One root in two forms: the sum is one surd.
    yield (ONE, fmpq(1009**2 * 1013)), (fmpq(-1008), fmpq(1013))


def sections():
    for name, form in (("f64", F64), ("f32", F32)):
        yield f"ties of {name}, and numbers closer to them than a double-double resolves", ties(form)
        yield f"roots of floats that come closest to ties of {name}", roots_of_floats(form)
        yield f"roots of small integers, and their sums, that come closest to ties of {name}", nearest_misses(form)
        yield f"continued fractions of ties of {name}", fractions_near_midpoints(form)
    yield "subnormals, underflow and overflow", limits()
    yield "sums that cancel", cancellations()
    yield "sums near ties", sums_near_ties()
    yield "long numbers", long_numbers()
    yield "squares that are not extracted", hidden_squares()


def main():
    lines, seen = [HEAD], set()
    for title, cases in sections():
        lines.append(f"\n# {title}\n")
        for case in cases:
            terms = case if isinstance(case[0], tuple) else (case,)
            value = normal(terms)
            if len(terms) == 2 and len(value) == 2:
                number = printed_sum(*terms)
            else:
                (c, r) = value[0] if len(value) == 1 else terms[0]
                number = printed(c, r)
            if number not in seen:
                seen.add(number)
                lines.append(f"{number} {nearest(terms, F64)} {nearest(terms, F32)}\n")
    text = "".join(lines)
    print(f"{len(seen)} numbers, {len(text)} bytes")
    if "--write" in sys.argv[1:]:
        FILE.write_text(text)
    elif FILE.read_text() != text:
        sys.exit(f"{FILE} differs: run .ci/surd_cases.py --write")


if __name__ == "__main__":
    main()

"""Exact numbers c·√r by python-flint, independently of the crate: the reference of `surd.py` and `surd_cases.py`.

A number is a list of terms (c, r), rationals with r ≥ 0, and stands for the sum of all c·√r. Whether it is rational is decided in
integers. The rounding of a rational is decided in integers too. The rounding of an irrational number follows from balls of
increasing precision, because it is no tie.
"""

from flint import arb, ctx, fmpq, fmpz

# Precision, the exponent of the smallest subnormal, the exponent of the overflow threshold, digits of the bits in base 16.
F64 = (53, -1074, 1024, 16)
F32 = (24, -149, 128, 8)


def root(r):
    """Returns the rational root of a rational r ≥ 0, or None."""
    if r.p.is_square() and r.q.is_square():
        return fmpq(r.p.isqrt(), r.q.isqrt())
    return None


def normal(terms):
    """Returns terms of the same value: no two with one root, no zero, and rationals with r = 1."""
    result = []
    for c, r in terms:
        if c == 0 or r == 0:
            continue
        rational = root(r)
        if rational is not None:
            c, r = c * rational, fmpq(1)
        for index, (d, s) in enumerate(result):
            # c√r = c·√(r/s)·√s
            factor = root(r / s)
            if factor is not None:
                result[index] = (d + c * factor, s)
                break
        else:
            result.append((c, r))
    return [(c, r) for c, r in result if c != 0]


def enclosure(terms, bits):
    """Returns m, n, e with m·2^e ≤ value ≤ n·2^e, at about this precision."""
    before, ctx.prec = ctx.prec, bits
    ball = arb(0)
    for c, r in terms:
        ball += arb(c) * arb(r).sqrt()
    (m, e), (n, f) = ball.lower().man_exp(), ball.upper().man_exp()
    ctx.prec = before
    least = min(int(e), int(f))
    return int(m) << (int(e) - least), int(n) << (int(f) - least), least


def is_rational(terms):
    """Tells whether the terms, in normal form, are one rational."""
    return not terms or (len(terms) == 1 and terms[0][1] == 1)


def enclosures(terms):
    """Yields narrower and narrower enclosures of an irrational number."""
    bits = 128
    while True:
        yield enclosure(terms, bits)
        bits *= 2
        assert bits < 1 << 20, terms


def sign(terms):
    terms = normal(terms)
    if is_rational(terms):
        value = terms[0][0] if terms else fmpq(0)
        return (value > 0) - (value < 0)
    for low, high, _ in enclosures(terms):
        if low > 0:
            return 1
        if high < 0:
            return -1


def rounded(n, d, form):
    """Returns the bits of the float nearest to n/d, ties to even. A negative number that rounds to zero gives −0."""
    precision, smallest, largest, digits = form
    negative, n = n < 0, abs(n)
    if n == 0:
        return 0
    # The exponent of the last bit. The quotient has `precision` bits, or one more, which the loop removes. Subnormals have fewer.
    last = max(n.bit_length() - d.bit_length() - precision, smallest)
    while True:
        numer, denom = (n << -last, d) if last < 0 else (n, d << last)
        kept, rest = divmod(numer, denom)
        if kept < 1 << precision:
            break
        last += 1
    up = 2 * rest > denom or (2 * rest == denom and kept % 2 == 1)
    kept += up
    # The significand and the exponent field overlap in the leading bit, so a carry is correct. Subnormals have no leading bit.
    bits = kept + ((last - smallest) << (precision - 1))
    infinity = ((1 << (digits * 4 - precision)) - 1) << (precision - 1)
    assert kept <= 1 << precision and (last == smallest or kept >= 1 << (precision - 1))
    bits = min(bits, infinity)
    return bits | (negative << (digits * 4 - 1))


def nearest(terms, form):
    """Returns the bits of the correctly rounded value, in base 16."""
    terms = normal(terms)
    if is_rational(terms):
        value = terms[0][0] if terms else fmpq(0)
        return f"{rounded(int(value.p), int(value.q), form):0{form[3]}x}"
    for low, high, e in enclosures(terms):
        if (low < 0) != (high < 0) or low == 0 or high == 0:
            continue
        scale = (1 << e, 1) if e > 0 else (1, 1 << -e)
        ends = [rounded(m * scale[0], scale[1], form) for m in (low, high)]
        if ends[0] == ends[1]:
            return f"{ends[0]:0{form[3]}x}"


# The product of all primes below 1000.
SMALL = fmpz.primorial_ui(1000)


def extracted(n):
    """Returns (root, rest) with n = root²·rest by the rule that the crate documents: the squares of all primes below 1000, and the
    cofactor if it is a perfect square."""
    # Powers of two are long, and leave quickly.
    twos = (int(n) & -int(n)).bit_length() - 1
    front, rest, n = fmpz(1) << twos // 2, fmpz(1) << twos % 2, fmpz(n) >> twos
    for p, _ in n.gcd(SMALL).factor():
        exponent = 0
        while n % p == 0:
            n //= p
            exponent += 1
        front *= p ** (exponent // 2)
        rest *= p ** (exponent % 2)
    if n.is_square():
        return front * n.isqrt(), rest
    return front, rest * n


def printed(c, r):
    """Returns c·√r in the printed form of the crate."""
    if c == 0 or r == 0:
        return "0"
    (p, a), (q, b) = extracted(r.p), extracted(r.q)
    c, n = c * fmpq(p, q * b), a * b
    if n == 1:
        return str(c)
    return {1: "", -1: "-"}.get(c, f"{c}*") + f"sqrt({n})"


def printed_sum(one, other):
    """Returns the sum of two surds in the printed form of the crate, the larger term first. It must not be one surd."""
    if one[0] ** 2 * one[1] < other[0] ** 2 * other[1]:
        one, other = other, one
    second = printed(*other)
    return printed(*one) + ("" if second.startswith("-") else "+") + second

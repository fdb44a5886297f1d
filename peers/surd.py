#!/usr/bin/env python3
"""Asks the crate `exact-surd` random and adversarial questions, and compares its answers with python-flint: surd.py EVALUATE [COUNT].

EVALUATE is the binary of crates/surd/examples/evaluate.rs. The floats in crates/surd/tests/hard_cases.txt must be those of
python-flint, too. The script changes every answer, and must notice it. The exit status is 1 if an answer is wrong.

A number is a list of terms (c, r), rationals with r ≥ 0, and stands for the sum of all c·√r. Whether it is rational is decided in
integers. The rounding of a rational is decided in integers too. The rounding of an irrational number follows from balls of
increasing precision, because it is no tie.
"""

import math
import random
import re
import struct
import subprocess
import sys
from collections import Counter
from fractions import Fraction
from pathlib import Path

from flint import arb, ctx, fmpq, fmpz

CASES = Path(__file__).resolve().parent.parent / "crates/surd/tests/hard_cases.txt"
# Precision, the exponent of the smallest subnormal, digits of the bits in base 16.
F64, F32 = (53, -1074, 16), (24, -149, 8)
ONE, U = fmpq(1), Fraction(1, 2**53)
# The bounds of Joldes, Muller and Popescu (2017), which double_double.rs states.
BOUNDS = {"add": 3 * U**2 + 13 * U**3, "subtract": 3 * U**2 + 13 * U**3, "multiply": 7 * U**2, "divide": 15 * U**2 + 56 * U**3}


def root(r):
    """Returns the rational root of a rational r ≥ 0, or None."""
    return fmpq(r.p.isqrt(), r.q.isqrt()) if r.p.is_square() and r.q.is_square() else None


def normal(terms):
    """Returns terms of the same value: no two with one root, no zero, and rationals with r = 1."""
    result = []
    for c, r in terms:
        if c == 0 or r == 0:
            continue
        if (rational := root(r)) is not None:
            c, r = c * rational, ONE
        for index, (d, s) in enumerate(result):
            # c√r = c·√(r/s)·√s
            if (factor := root(r / s)) is not None:
                result[index] = (d + c * factor, s)
                break
        else:
            result.append((c, r))
    return [(c, r) for c, r in result if c != 0]


def enclosures(terms):
    """Yields fractions below and above the value, closer and closer, or the value itself twice."""
    terms, bits = normal(terms), 128
    if all(r == 1 for _, r in terms):
        value = sum((Fraction(int(c.p), int(c.q)) for c, _ in terms), Fraction(0))
        yield value, value
    while True:
        ctx.prec = bits
        ball = sum((arb(c) * arb(r).sqrt() for c, r in terms), arb(0))
        yield tuple(Fraction(int(m)) * Fraction(2) ** int(e) for m, e in (ball.lower().man_exp(), ball.upper().man_exp()))
        bits *= 2


def sign(terms):
    return next((low > 0) - (low < 0) for low, high in enclosures(terms) if low == high or low > 0 or high < 0)


def rounded(x, form):
    """Returns the bits of the float nearest to a fraction, ties to even."""
    (precision, smallest, digits), n, d = form, abs(x.numerator), x.denominator
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
    kept += 2 * rest > denom or (2 * rest == denom and kept % 2 == 1)
    # The significand and the exponent field overlap in the leading bit, so a carry is correct. Subnormals have no leading bit.
    infinity = ((1 << (digits * 4 - precision)) - 1) << (precision - 1)
    return min(kept + ((last - smallest) << (precision - 1)), infinity) | ((x < 0) << (digits * 4 - 1))


def nearest(terms, form):
    """Returns the bits of the correctly rounded value, in base 16."""
    ends = ([rounded(x, form) for x in pair] for pair in enclosures(terms))
    return next(f"{low:0{form[2]}x}" for low, high in ends if low == high)


# Numbers in the printed form.
SMALL = fmpz.primorial_ui(1000)
FORM = re.compile(r"(?:([+-]?\d+(?:/\d+)?)\*|([+-]?))sqrt\((\d+)\)|([+-]?\d+(?:/\d+)?)")


def terms_of(printed):
    """Returns the terms of a printed number, or None if one is not in lowest terms, has a root that is rational, or has the square
    of a prime below 1000 below the root."""
    terms = []
    for term in re.findall(r"[+-]?[^+-]+", printed):
        found = FORM.fullmatch(term)
        if not found:
            return None
        c, bare, r, alone = found.groups()
        front = alone or c or f"{bare}1"
        numer, _, denom = front.partition("/")
        r, denom = fmpz(int(r or 1)), int(denom or 1)
        small = r.gcd(SMALL)
        lowest = denom > 0 and math.gcd(int(numer), denom) == 1 and not front.endswith("/1")
        if not lowest or (r // small).gcd(small) != 1 or (alone is None and (r.is_square() or int(numer) == 0)) or c in ("1", "-1"):
            return None
        terms.append((fmpq(int(numer), denom), fmpq(r)))
    return terms


def is_form(terms, answer):
    """Tells whether the answer is the printed form of a number, with as few terms as possible and the larger one first."""
    found, wanted = terms_of(answer), normal(terms)
    if found is None or len(found) != max(len(wanted), 1) or normal(found + [(-c, r) for c, r in terms]):
        return False
    sizes = [c**2 * r for c, r in found]
    return sizes == sorted(sizes, reverse=True)


# Random numbers.
choice = random.choice


def float_of(bits):
    return struct.unpack(">d", bytes.fromhex(bits))[0]


def rational(x):
    return fmpq(*x.as_integer_ratio())


def any_float():
    """A float of any size. Often its exponent or its significand is extreme."""
    exponent = choice([0, 1, 2, 2046, 2045, random.randrange(2047), random.randrange(960, 1090)])
    fraction = choice([0, 1, 2**52 - 1, random.getrandbits(52), random.getrandbits(52)])
    return float_of(f"{exponent << 52 | fraction | random.getrandbits(1) << 63:016x}")


def midpoint():
    """A midpoint of two neighbouring floats, f64 or f32, up to the overflow threshold."""
    bits, smallest, largest = choice([(53, -1074, 971), (24, -149, 104)])
    significand = choice([0, 1, 2 ** (bits - 1), 2**bits - 1, random.getrandbits(bits), random.getrandbits(bits)])
    exponent = choice([smallest, smallest + 1, largest, random.randrange(smallest, largest + 1), -bits, 0])
    return choice([1, -1]) * fmpq(2 * significand + 1, 2) * fmpq(2) ** exponent


def integer():
    return random.getrandbits(choice([3, 8, 20, 53, 64, 110, 300])) + 1


def any_rational():
    value = choice([1, -1]) * fmpq(integer(), integer())
    return choice([rational(any_float()), midpoint(), value, value * fmpq(3) ** random.randrange(-60, 60),
                   value * fmpq(2) ** choice([-1074, -1022, -150, 127, 1023, random.randrange(-1100, 1100)])])  # fmt: skip


# Primes around the limit of the extraction of squares, and one that is far beyond it.
PRIMES = [2, 3, 5, 31, 991, 997, 1009, 1013, 1019, 1_000_003]


def surd():
    product = lambda: fmpq(math.prod(random.choices(PRIMES, k=random.randrange(1, 6))))
    radicand = choice([fmpq(random.randrange(1, 60)), fmpq(integer(), integer()), fmpq(integer()) ** 2 + choice([-1, 0, 1, 2]),
                       product(), product() / product(), ONE])  # fmt: skip
    return any_rational(), abs(radicand)


def close(x, digits):
    """Returns a rational about 2^−`digits` of |x| away from the surd x, or less."""
    c, r = x
    square = c**2 * r
    scale = digits + (square.q.bit_length() - square.p.bit_length()) // 2 if square else 0
    near = (fmpq(2) ** (2 * scale) * square).floor().isqrt() + choice([0, 0, 1])
    return (-1 if c < 0 else 1) * fmpq(near) / fmpq(2) ** scale


def hard_surd():
    """A number near a midpoint of floats: the midpoint, a root of almost its square, or a multiple of a given root."""
    m, r = midpoint(), fmpq(choice([2, 3, 5, 6, 7, 8, 12, 39]))
    off = 1 + choice([1, -1]) * fmpq(1, 2 ** choice([60, 80, 100, 120, 200, 300]))
    return choice([(m, fmpq(integer()) ** 2), (fmpq(-1 if m < 0 else 1), m**2 * off), (m * off, ONE), (close((m / r, r), 120), r)])


def pair():
    """Two surds: unrelated, of one root, equal or opposite, nearly so, or with a sum near a midpoint."""
    x, factor, s = choice([surd, hard_surd])(), any_rational(), choice([1, -1])
    p, r, digits = fmpq(choice(PRIMES)), fmpq(choice([2, 3, 5, 7, 11])), choice([5, 50, 60, 110, 130, 250, 600])
    return x, choice([surd(), (x[0] * any_rational(), x[1] * factor**2), (s * x[0] / p, x[1] * p**2), (s * close(x, digits), ONE),
                      (midpoint() - close(x, digits), ONE), (s * close((x[0] / r, x[1] * r), digits), r)])  # fmt: skip


def double_double():
    while True:
        high = choice([any_float(), math.ldexp(choice([1, -1]) * (2**52 + random.getrandbits(52)), choice([-52, -49, -60]))])
        half = math.ulp(high) / 2
        low = choice([1, -1]) * choice([0.0, half, half * random.random(), half * random.random() ** 9])
        if high + low == high and math.isfinite(high):
            return high, low


# Questions. Each function returns a line for the program, and a function that tells whether an answer is right.
def text(*numbers):
    return " ".join(f"{c}" if r == 1 and random.getrandbits(1) else f"{c}*sqrt({r})" for c, r in numbers)


def order_of(value):
    return ["equal", "greater", "less"][value]


def some():
    return pair() if random.getrandbits(1) else (choice([surd, hard_surd])(),)


def ask_round():
    x = some()
    want = [nearest(x, F64), nearest(x, F32)]
    return f"round {text(*x)}", lambda answer: answer.split(" ")[1:] == want and is_form(x, answer.split(" ")[0])


def ask_order():
    x, y = pair()
    if random.getrandbits(1):
        return f"sign {text(x, y)}", "0+-"[sign([x, y])].__eq__
    return f"order {text(x, y)}", order_of(sign([x, (-y[0], y[1])])).__eq__


def ask_float():
    x = some()
    bits = f"{(int(nearest(x, F64), 16) + choice([0, 1, -1])) % 2**64:016x}"
    given = float_of(bits)
    if math.isfinite(given):
        return f"float {text(*x)} {bits}", order_of(sign([*x, (-rational(given), ONE)])).__eq__
    return f"float {text(*x)} {bits}", ("none" if math.isnan(given) else "less" if given > 0 else "greater").__eq__


def ask_times():
    x, (z, w) = some(), surd()
    product = [(c * z, r * w) for c, r in x]
    return f"times {text(*x)} {text((z, w))}", lambda answer: is_form(product, answer)


def ask_sum():
    x = pair()
    return f"sum {text(*x)}", (lambda answer: is_form(x, answer)) if len(normal(x)) < 2 else "none".__eq__


def ask_inverse():
    c, r = surd()
    if random.getrandbits(1):
        return f"square {text((c, r))}", str(c**2 * r).__eq__
    return f"inverse {text((c, r))}", (lambda answer: is_form([(1 / c, 1 / r)], answer)) if c * r else "none".__eq__


def exactly(x):
    return Fraction(x[0]) + Fraction(x[1])


worst = dict.fromkeys(BOUNDS, Fraction(0))


def ask_double_doubles():
    operation, x, y = choice([*BOUNDS, "compare"]), double_double(), double_double()
    question = f"{operation} {' '.join(struct.pack('>d', part).hex() for part in x + y)}"
    a, b = exactly(x), exactly(y)
    if operation == "compare":
        return question, order_of((a > b) - (a < b)).__eq__
    if operation == "divide" and b == 0:
        return question, "none".__eq__
    exact = {"add": a + b, "subtract": a - b, "multiply": a * b, "divide": a / (b or 1)}[operation]

    def judge(answer):
        high, low = map(float_of, answer.split(" "))
        if not 2**-900 <= abs(exact) <= 2**1023:
            # Outside this range only the form is promised.
            return not math.isfinite(high) or high + low == high
        error = abs(exactly((high, low)) - exact) / abs(exact)
        ordinary = all(2**-400 <= abs(part[0]) < 2**400 for part in (x, y))
        if ordinary and error <= BOUNDS[operation]:
            worst[operation] = max(worst[operation], error)
        return high + low == high and error <= (BOUNDS[operation] if ordinary else Fraction(1, 2**100))

    return question, judge


def ask_double():
    x = any_rational()
    exact = Fraction(int(x.p), int(x.q))

    def judge(answer):
        high, low = map(float_of, answer.split(" "))
        in_range = 2**-900 <= abs(exact) <= sys.float_info.max
        return not in_range or (high + low == high and abs(exactly((high, low)) - exact) <= abs(exact) / 2**106)

    return f"double {x}", judge


FAULTS = {"less": "equal", "equal": "greater", "greater": "less", "none": "1", "+": "-", "-": "0", "0": "1"}
KINDS = [*[ask_round] * 8, *[ask_order] * 3, *[ask_float] * 2, ask_times, ask_sum, ask_inverse, *[ask_double_doubles] * 4, ask_double]


def with_fault(answer):
    """Returns another answer: another word, a changed bit of a float, or another last digit."""
    if answer in FAULTS:
        return FAULTS[answer]
    if re.fullmatch(r"[0-9a-f]{16} [0-9a-f]{16}", answer):
        return answer[:12] + f"{int(answer[12], 16) ^ 8:x}" + answer[13:]
    return re.sub(r"[0-9a-f](?=\)?$)", lambda digit: f"{int(digit[0], 16) ^ 1:x}", answer)


def main(program, count=40_000):
    random.seed(1611)
    cases = [line.split(" ") for line in CASES.read_text().splitlines() if line and not line.startswith("#")]
    for number, double, single in cases:
        terms = terms_of(number)
        if not terms or not is_form(terms, number) or (nearest(terms, F64), nearest(terms, F32)) != (double, single):
            sys.exit(f"{CASES.name}: {number} is not {double} {single}")
    questions = [(kind.__name__, *kind()) for kind in random.choices(KINDS, k=int(count))]
    lines = "".join(f"{question}\n" for _, question, _ in questions)
    run = subprocess.run([program], input=lines, capture_output=True, text=True, check=False)
    if run.returncode:
        sys.exit(run.stderr)
    asked, noticed, wrong = Counter(), Counter(), []
    for (kind, question, judge), answer in zip(questions, run.stdout.splitlines(), strict=True):
        asked[kind] += 1
        noticed[kind] += not judge(with_fault(answer))
        if not judge(answer):
            wrong.append(f"{question}\n    {answer}")
    for kind, number in asked.items():
        print(f"{number:8} {kind}: {noticed[kind]} faults noticed")
        # Double-doubles may have small errors, and any value outside the promised range.
        if noticed[kind] < (number / 4 if "double" in kind else number):
            sys.exit(f"{kind}: only {noticed[kind]} of {number} planted faults are noticed")
    print("worst errors:", ", ".join(f"{name} {float(e / U**2):.2f} u² of {float(BOUNDS[name] / U**2):.2f}" for name, e in worst.items()))
    if wrong:
        sys.exit("\n".join([f"{len(wrong)} wrong:", *wrong[:10]]))
    print(f"{len(questions)} questions and {len(cases)} hard cases, 0 wrong; {sum(noticed.values())} planted faults noticed")


main(*sys.argv[1:])

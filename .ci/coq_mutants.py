#!/usr/bin/env python3
"""Changes recorded definitions of Formulas.v, one at a time, and checks that Coq rejects a proof: coq_mutants.py FOLDER few|one|all.

FOLDER has the compiled files of `cannonpile prove --to coq`. A change replaces an operator, a number or a name. `all`
makes every change, `one` the middle one of each definition, and `few` the middle one of every 54th definition. The exit
status is 1 if a change survives, which is printed, or if Coq rejects the unchanged files. COQ_JOBS is the number of
changes tested in parallel.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# The patterns of operators and numbers, with their replacements.
CHANGES = [
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
# Equivalent mutants: the compression of a direction against itself is zero, whatever its factor.
NOTHING = re.compile(r"\|\s+(\w+),\s+\1,\s+\w+\s+=>\s+(?=\(- )")
NEXT = dict(alpha="beta", beta="gamma", gamma="alpha", along_x="along_y", along_y="along_z", along_z="along_x")


def definitions(text):
    """Returns the start, the start of the body, and the end of each definition."""
    for found in re.finditer(r"^Definition (\w+).*? :=\n(.*?\.)\n(?=\n|\Z)", text, re.M | re.S):
        yield found[1], found.start(2), found.end(2)


def variants(body):
    """Returns the body with one change, for each possible change, in order."""
    nothing = {found.end() for found in NOTHING.finditer(body)}
    places = sorted(
        (found.start(), found.end(), becomes(found))
        for what, becomes in CHANGES
        for found in what.finditer(body)
        if found.start() not in nothing
    )
    # The definition is only a parameter.
    if not places:
        places = [(len(body) - 1, len(body) - 1, " + 1")]
    return [body[:start] + new + body[end:] for start, end, new in places]


def refused_by(folder, order, name):
    """Returns the first file that Coq rejects, if any. Files that use the definition are checked first."""

    def coqc(file, *options):
        run = ["coqc", "-q", *options, "-Q", ".", "Cannonpile", f"{file}.v"]
        # A check that takes too long is not a rejection, so this fails.
        done = subprocess.run(run, cwd=folder, capture_output=True, text=True, timeout=1200)
        # A killed check, for example out of memory, is not a rejection either.
        assert done.returncode in (0, 1) and "Out of memory" not in done.stderr, (file, done.returncode, done.stderr[-500:])
        return done.returncode == 0

    for file in order:
        if not coqc(file, "-vos"):
            return file
    names = re.compile(rf"\b{name}\b")
    near = [file for file in order if names.search((folder / f"{file}.v").read_text())]
    for file in near + [file for file in order if file not in near]:
        if not coqc(file, "-vok"):
            return file
    return None


def main():
    source, amount = Path(sys.argv[1]), sys.argv[2]
    order = [line[:-2] for line in (source / "_CoqProject").read_text().split("\n") if line.endswith(".v")]
    text = (source / "Formulas.v").read_text()
    first = order.index("Formulas")
    tasks = []
    found = list(definitions(text))
    for name, start, end in found[4::54] if amount == "few" else found:
        body = text[start:end]
        all_of_it = variants(body)
        chosen = all_of_it if amount == "all" else [all_of_it[len(all_of_it) // 2]]
        tasks += [(name, text[:start] + new + text[end:], new) for new in chosen]

    def attempt(task):
        name, mutant, new = task
        with tempfile.TemporaryDirectory() as folder:
            for path in source.glob("*"):
                if path.suffix == ".v" or path.stem in order[:first]:
                    shutil.copy(path, folder)
            (Path(folder) / "Formulas.v").write_text(mutant)
            return name, new, refused_by(Path(folder), order[first:], name)

    # Without a change the same check must pass.
    name, start, end = found[0]
    unchanged = attempt((name, text, text[start:end]))[2]
    if unchanged is not None:
        sys.exit(f"{unchanged}.v is refused though nothing was changed")

    survived, by_file = [], {}
    with ThreadPoolExecutor(max_workers=int(os.environ.get("COQ_JOBS", "1"))) as pool:
        for name, new, refused in pool.map(attempt, tasks):
            by_file[refused] = by_file.get(refused, 0) + 1
            if refused is None:
                survived.append((name, new))
                print(f"SURVIVES: {name} := {' '.join(new.split())}", flush=True)
    print(f"{len(tasks)} changes: rejected in", ", ".join(f"{file} {n}" for file, n in by_file.items() if file))
    sys.exit(1 if survived else 0)


main()

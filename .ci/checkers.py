#!/usr/bin/env python3
"""Compares the three checkers of certificates: checkers.py CANNONPILE CHECK [TIMES].

CHECK is the program extracted from Checker.v. Certificates of random piles, of each kind, must be accepted by all three.
Then one number, sign, claim or entry is changed at random, TIMES times (2000), and all three must give the same verdict.
One changed force of a certificate of exact forces must be refused.
"""

import copy
import io
import json
import random
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "crates/horizontal"))
sys.dont_write_bytecode = True
import check_certificate  # noqa: E402

binary, proved = sys.argv[1:3]
times = int(sys.argv[3]) if len(sys.argv) > 3 else 2000
chance = random.Random(1998)


def scenes():
    """Yields options of random piles."""
    for _ in range(12):
        steps = chance.randint(1, 5)
        stacking = "".join(chance.choice("+-") for _ in range(steps))
        shape = chance.choice([f"--top hexagon:{chance.randint(1, 2)}", "--top triangle:2", f"--base hexagon:{steps + 2}"])
        load = f"{chance.randint(0, 9)}/{chance.randint(1, 7)}"
        yield f"{shape} --stacking={stacking} --layers {steps + 1}", load
    yield "--dimension 2 --layers 5", "3/2"
    yield "--sin-phi 2/7 --layers 4 --tilt 1/9,1/7", "5"


def made(folder):
    """Returns certificates of each kind, as JSON."""
    file = folder / "made.json"
    found = []
    for scene, load in scenes():
        commands = [f"contacts {scene}", f"base {scene} --number f64", f"contacts {scene} --weightless --tilt 0,0"]
        if "sin-phi" not in scene:
            commands += [f"summary {scene} --spacing 1", f"contacts {scene} --spacing 1 --state elastic"]
        if "dimension" not in scene and "base" not in scene and "sin-phi" not in scene:
            commands.append(f"contacts {scene} --load 0,0,0={load},1/3,1/5")
            commands.append(f"bounds {scene} --spacing 1 --at 0,0")
        for command in commands:
            file.unlink(missing_ok=True)
            subprocess.run([binary, *command.split(), "--certificate", str(file)], capture_output=True)
            # Some piles have no such certificate: an unstable one has no elastic state.
            if file.exists():
                given = json.loads(file.read_text())
                found += given if isinstance(given, list) else [given]
    return found


def leaves(value, path=()):
    """Yields the path of each number and each truth value."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, (*path, key))
    elif isinstance(value, list):
        for place, inner in enumerate(value):
            yield from leaves(inner, (*path, place))
    elif not isinstance(value, str) or value.lstrip("-").replace("/", "").isdigit():
        yield path


def at(value, path):
    for key in path:
        value = value[key]
    return value


def changed(certificate):
    """Returns a copy with one change, and the path of the change."""
    other = copy.deepcopy(certificate)
    path = chance.choice([path for path in leaves(other) if path[:2] not in (("pile", "dimension"), ("pile", "sin_phi"))])
    if chance.random() < 0.1:
        path = ("claim",)
        other["claim"] = chance.choice(["stands", "cannot-stand", {"elastic": {"stiffness_ratio": "1"}}])
    elif chance.random() < 0.1 and len(path) > 1 and any(isinstance(key, int) for key in path):
        entry = next(place for place, key in enumerate(path) if isinstance(key, int))
        path = path[: entry + 1]
        del at(other, path[:-1])[path[-1]]
    else:
        holder, value = at(other, path[:-1]), at(other, path)
        if isinstance(value, bool):
            holder[path[-1]] = not value
        elif isinstance(value, int):
            holder[path[-1]] = value + chance.choice([-1, 1])
        else:
            holder[path[-1]] = str(Fraction(value) + Fraction(chance.choice([-1, 1]), chance.choice([1, 2, 3, 7, 10**9])))
    return other, path


def verdicts(certificate, file):
    """Returns the exit status of each checker."""
    text = json.dumps(certificate)
    file.write_text(text)
    run = lambda *command: subprocess.run([*command, str(file)], capture_output=True).returncode
    return run(binary, "check"), check_certificate.verdict(io.StringIO(text))[0], run(proved)


with tempfile.TemporaryDirectory() as work:
    file = Path(work) / "certificate.json"
    certificates = made(Path(work))
    kinds = {}
    for certificate in certificates:
        assert verdicts(certificate, file) == (0, 0, 0), (verdicts(certificate, file), certificate)
        claim = certificate["claim"]
        kind = claim if isinstance(claim, str) else next(iter(claim))
        kinds[kind] = kinds.get(kind, 0) + 1
    print("accepted by all three:", ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())))
    assert len(kinds) == 6, kinds
    counts = {}
    for _ in range(times):
        certificate = chance.choice(certificates)
        other, path = changed(certificate)
        status = verdicts(other, file)
        assert len(set(status)) == 1, (status, path, other)
        claim = certificate["claim"]
        if "forces" in claim and claim["forces"]["within"] == "0" and path[:2] == ("claim", "forces") and path[-1] != "within":
            assert status[0] != 0, (path, other)
        counts[status[0]] = counts.get(status[0], 0) + 1
    print(f"{times} changed: {counts.get(0, 0)} accepted, {counts.get(1, 0)} refused, {counts.get(2, 0)} not certificates")
    assert counts.get(1, 0) > times / 2, counts

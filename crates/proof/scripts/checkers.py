#!/usr/bin/env python3
"""Compares the three checkers of certificates: checkers.py CANNONPILE CHECK [TIMES [PILES]].

CHECK is the program extracted from Checker.v. Certificates of PILES random piles (20), of each kind, must be accepted by
all three. Then one number, sign, claim or entry is changed at random, TIMES times (2000), and after that one byte of the
file as often. All three must give the same verdict, and refuse one changed force of a certificate of exact forces.
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

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "horizontal"))
sys.dont_write_bytecode = True
import check_certificate  # noqa: E402

binary, proved = sys.argv[1:3]
times = int(sys.argv[3]) if len(sys.argv) > 3 else 2000
piles = int(sys.argv[4]) if len(sys.argv) > 4 else 20
chance = random.Random(1998)


def scenes():
    """Yields options of random piles."""
    for _ in range(piles - 2):
        steps = chance.randint(1, 5)
        stacking = "".join(chance.choice("+-") for _ in range(steps))
        shape = chance.choice([f"--top hexagon:{chance.randint(1, 2)}", "--top triangle:2", f"--base hexagon:{steps + 2}"])
        load = f"{chance.randint(0, 9)}/{chance.randint(1, 7)}"
        tilt = f" --tilt 1/{chance.randint(2, 9)},-1/{chance.randint(2, 9)}" if chance.random() < 0.3 else ""
        yield f"{shape} --stacking={stacking} --layers {steps + 1}{tilt}", load
    yield "--dimension 2 --layers 5", "3/2"
    yield "--sin-phi 2/7 --layers 4 --tilt 1/9,1/7", "5"


def made(folder):
    """Returns certificates of each kind, as JSON."""
    file = folder / "made.json"
    found = []
    for scene, load in scenes():
        commands = [f"contacts {scene}", f"base {scene} --number f64", f"contacts {scene} --weightless --tilt 0,0"]
        if "sin-phi" not in scene:
            commands.append(f"summary {scene} --spacing 1")
            # On these bases the elastic state takes minutes.
            if "hexagon:6" not in scene and "hexagon:7" not in scene:
                commands.append(f"contacts {scene} --spacing 1 --state elastic")
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


BYTES = b"0123456789+-/.,:()[]{}\"ABCabcehinstu_ \n\\\0\x7f\xff"


def with_other_byte(text):
    """Returns the text with one byte replaced, inserted or left out."""
    place, other = chance.randrange(len(text)), bytes([chance.choice(BYTES)])
    return text[:place] + chance.choice([other, other, b""]) + text[place + chance.choice([0, 1]) :]


# Each pair changes this certificate to another notation. Some parsers of JSON or of the library read those of the second
# list, too.
SMALL = (
    '{"pile":{"dimension":3,"sin_phi":"1/2","stacking":"++","anchor":{"top":"hexagon:1"},"weightless":false,"weights":[],'
    '"loads":[{"site":{"i":0,"j":0,"k":0},"weight":"1"}]},"claim":"stands","horizontal":[],"field":[]}'
)
ALLOWED_NOTATIONS = [
    ('"1/2"', '"2/4"'), ('"++"', '"(2)"'), ('"++"', '"-(1,1)"'), ('"hexagon:1"', '"hexagon:1,1"'), ('"hexagon:1"', '"triangle:1"'),
    ('"hexagon:1"', '"region:0..0,0..0,0..0"'), ('{"i":0,"j":0,"k":0}', '{ "k" : "0",\n"j":"0","i":0 }'),
    ('"weight":"1"', '"weight":"1/3","x":"0/5"'), ('"loads":[', '"tilt":{"y":"0","x":"0"},"horizontal":[],"loads":['),
    ('"weight":"1"}', '"weight":"1"},{"site":{"i":0,"j":0,"k":0},"weight":"0","y":"0"}'), (SMALL, f" [{SMALL} ,\t{SMALL}]\r\n"),
    ('"weights":[]', '"weights":[{"site":{"i":0,"j":0,"k":2},"weight":"0"}]'),
]
OTHER_NOTATIONS = [
    ('"stacking":"++","anchor":{"top"', '"stacking":"A","anchor":{"side"'),
    ('"weightless":false,"weights":[]', '"weightless":true,"weights":[{"site":{"i":0,"j":0,"k":0},"weight":"-1"}]'),
] + [
    ('"1/2"', other) for other in ('"+1/2"', '"0.5"', '"5e-1"', '".5"', '" 1/2"', '"1/+2"', '"1/2\\u0030"', '"\\u0031/2"', "0.5", "null")
] + [
    ('"++"', other) for other in ('"ABC"', '"cc"', '"c"', '"(2,0)"', '"(0,2)"', '"(02)"', '"()"', '"+(2)"', '"fcc"', '"\uff0b+"', '""')
] + [
    ('"hexagon:1"', other)
    for other in ('"hexagon:1,1,1"', '"hexagon:1.0"', '"hexagon:1e0"', '"hexagon:+1"', '"triangle:1,1"', '"0..0,0..0,0..0"',
                  '"region:0...0,0..0,0..0"', '"region:0..0,0..0"', '"region:+0..0,0..0,0..0"', '"Hexagon:1"', '"site"')
] + [
    ('"stands"', other) for other in ('{"stands":null}', '["stands"]', '"Stands"', "null", '{"elastic":["1"]}', '{"elastic":{"stiffness_ratio":1}}')
] + [
    ('"dimension":3', f'"dimension":{other}') for other in ("3.0", "3e0", '"3"', "03", "+3", "true")
] + [
    ('"i":0', f'"i":{other}') for other in ("-0", "0.0", '"+0"', '"0e1"', "1e400", "99999999999999999999", "NaN", "[0]", '"' + 39 * "0" + '"')
] + [
    ('{"i":0,"j":0,"k":0}', "[0,0,0]"), ('"weightless":false', '"weightless":0'), ('"weights":[]', '"weights":{}'),
    ('"weights":[]', '"weights":null'), ('"field":[]', '"field":[],"field":[]'), ('"field":[]', '"field":[],"more":0'),
    ('"field":[]}', '"field":[]},'), ('"field":[]', '"field":[,]'), ('{"pile"', '\ufeff{"pile"'), ('{"pile"', "[[]]"),
    (SMALL, "[]"), (SMALL, ""), (SMALL, f"[{SMALL},{{}}]"), (SMALL, SMALL + SMALL), (SMALL, "[" * 200 + "]" * 200),
    (SMALL, f"[{SMALL.replace('stands', 'cannot-stand')},{SMALL.replace('stands', 'fall')}]"),
]


def verdicts(text, file):
    """Returns the exit status of each checker."""
    file.write_bytes(text)
    run = lambda *command: subprocess.run([*command, str(file)], capture_output=True).returncode
    return run(binary, "check"), check_certificate.verdict(io.StringIO(text.decode("latin-1")))[0], run(proved)


def encoded(certificate):
    return json.dumps(certificate).encode()


with tempfile.TemporaryDirectory() as work:
    file = Path(work) / "certificate.json"
    assert verdicts(SMALL.encode(), file) == (0, 0, 0)
    for notations, status in ((ALLOWED_NOTATIONS, 0), (OTHER_NOTATIONS, 2)):
        for given, other in notations:
            assert given in SMALL
            text = SMALL.replace(given, other, 1).encode()
            assert verdicts(text, file) == (status,) * 3, (verdicts(text, file), text)
    print(f"{len(ALLOWED_NOTATIONS)} allowed notations: accepted; {len(OTHER_NOTATIONS)} others: not certificates")

    certificates = made(Path(work))
    kinds = {}
    for certificate in certificates:
        status = verdicts(encoded(certificate), file)
        assert status == (0, 0, 0), (status, certificate)
        claim = certificate["claim"]
        kind = claim if isinstance(claim, str) else next(iter(claim))
        kinds[kind] = kinds.get(kind, 0) + 1
    print("accepted by all three:", ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())))
    assert len(kinds) == 6, kinds

    def compare(change, what):
        """Returns how often each verdict was given."""
        counts = [0, 0, 0]
        for _ in range(times):
            certificate = chance.choice(certificates)
            text, breaks = change(certificate)
            status = verdicts(text, file)
            assert len(set(status)) == 1, (status, text)
            assert not breaks or status[0] != 0, text
            counts[status[0]] += 1
        print(f"{times} {what}: {counts[0]} accepted, {counts[1]} refused, {counts[2]} not certificates")
        return counts

    def number(certificate):
        other, path = changed(certificate)
        claim = certificate["claim"]
        is_exact = "forces" in claim and claim["forces"]["within"] == "0"
        return encoded(other), is_exact and path[:2] == ("claim", "forces") and path[-1] != "within"

    assert compare(number, "changed")[1] > times / 2
    assert compare(lambda certificate: (with_other_byte(encoded(certificate)), False), "with another byte")[2] > times / 2

#!/usr/bin/env python3
"""Compares the models of crates/proof/floats with the Rust source, and checks that Coq rejects changed models and bounds.

    floats.py link                   compares each quoted function, token by token
    floats.py mutants DIR all|few    changes the models and bounds one at a time; DIR has the compiled files

`few` makes every ninth change.

The exit status is 1 if a function differs, a change survives, or Coq rejects the unchanged files.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
MODELS = HERE / "crates/proof/floats"
ORDER = [line[:-2] for line in (MODELS / "_CoqProject").read_text().split("\n") if line.endswith(".v")]
MODEL = re.compile(r"\(\* begin (\S+) (\w+) \*\)\n(.*?)\(\* end \*\)", re.S)
QUOTE = re.compile(r"\(\* quote (\S+) (\w+): (.*?) \*\)", re.S)

# Bounds and conditions. Each change makes a statement stronger, so that it is no longer proved.
STRONGER = [
    ("Model", "FLT_exp (-1074) 53", "FLT_exp (-1074) 52"),
    ("Model", "FLT_exp (-1074) 53", "FLT_exp (-1073) 53"),
    ("ErrorFree", "Rabs b <= Rabs a \\/ a = 0 ->", "Rabs b <= 2 * Rabs a \\/ a = 0 ->"),
    ("ErrorFree", "(Z.abs j < 2 ^ 53)%Z -> format", "(Z.abs j < 2 ^ 54)%Z -> format"),
    ("ErrorFree", "a * b = 0 \\/ bpow (-969) <=", "a * b = 0 \\/ bpow (-970) <="),
    ("ErrorFree", "<= 7 / 2 * bpow (-1074)", "<= 6 / 2 * bpow (-1074)"),
    ("ErrorFree", "bpow (-400) <= Rabs a < bpow 400", "bpow (-500) <= Rabs a < bpow 400"),
    ("DoubleDouble", "<= 6 * u * u * Rabs (value x + value y).", "<= 5 * u * u * Rabs (value x + value y)."),
    ("DoubleDouble", "Definition u : R := / 9007199254740992.", "Definition u : R := / 9007199254740993."),
    ("DoubleDouble", "bpow (-100) * Rabs (value x + value y)", "bpow (-104) * Rabs (value x + value y)"),
    ("DoubleDouble", "match Rcompare (high x) (high y) with", "match Rcompare (high y) (high x) with"),
    ("DoubleDouble", "| Eq => Rcompare (low x) (low y)", "| Eq => Rcompare (low y) (low x)"),
    ("Product", "<= 9 * u * u * Rabs (value x * value y).", "<= 8 * u * u * Rabs (value x * value y)."),
    ("Product", "<= 31 / 10 * u * u * Rabs (high y * t).", "<= 29 / 10 * u * u * Rabs (high y * t)."),
    ("Product", "<= 25 * u * u * Rabs (value x / value y).", "<= 24 * u * u * Rabs (value x / value y)."),
    ("Sweep", "INR steps * 13 * u", "INR steps * 12 * u"),
    ("Sweep", "unit steps * greatest * (65 / 64)", "unit steps * greatest * (64 / 64)"),
    ("Sweep", "error_bound steps (bound_of_sweep / 3)", "error_bound steps (bound_of_sweep / 4)"),
    ("Sweep", "2 * sqrt 3 * B <= bound_of_sweep", "1 * sqrt 3 * B <= bound_of_sweep"),
    ("Sweep", "unit steps < 1 / 100 ->", "unit steps < 10 / 100 ->"),
    ("Sweep", "lost <= / 4 * (u * B)", "lost <= / 3 * (u * B)"),
    ("Sweep", "(n <= steps)%nat", "(n <= S steps)%nat"),
    ("Sweep", "0 <= u <= 1 / 1300.", "0 <= u <= 1 / 130."),
    ("Sweep", "2 / 3 * (a + b + c) - x.", "2 / 4 * (a + b + c) - x."),
    ("Nearest", "Definition guard_bits : Z := precision + 3.", "Definition guard_bits : Z := precision + 1."),
    ("Nearest", "Z.max (bits m + exponent - precision) min", "Z.max (bits m - exponent - precision) min"),
    ("Nearest", "Z.max (bits m + exponent - precision) min", "Z.max (bits m + exponent + precision) min"),
    ("Nearest", "Z.max (bits m + exponent - precision) min", "Z.min (bits m + exponent - precision) min"),
    ("Nearest", ":= last_bit m exponent - exponent.", ":= last_bit m exponent + exponent."),
    ("Nearest", "if (1 <=? d)%Z then", "if (2 <=? d)%Z then"),
    ("Nearest", "let kept := Z.shiftr m d in", "let kept := Z.shiftr m (d + 1) in"),
    ("Nearest", "let half := Z.testbit m (d - 1) in", "let half := Z.testbit m (d - 2) in"),
    ("Nearest", "let half := Z.testbit m (d - 1) in", "let half := Z.testbit m (d + 1) in"),
    ("Nearest", "sticky || negb", "sticky && negb"),
    ("Nearest", "sticky || negb", "sticky ||"),
    ("Nearest", "(m mod 2 ^ (d - 1) =? 0)", "(m mod 2 ^ (d - 2) =? 0)"),
    ("Nearest", "(m mod 2 ^ (d - 1) =? 0)", "(m mod 2 ^ (d - 1) =? 1)"),
    ("Nearest", "half && (below_half || Z.odd kept)", "half || (below_half || Z.odd kept)"),
    ("Nearest", "half && (below_half || Z.odd kept)", "half && (below_half && Z.odd kept)"),
    ("Nearest", "half && (below_half || Z.odd kept)", "half && (below_half || Z.even kept)"),
    ("Nearest", "kept + Z.b2z up", "kept - Z.b2z up"),
    ("Nearest", "else Z.shiftl m (- d).", "else Z.shiftl m (1 - d)."),
    ("Nearest", "(precision + 2 <= bits m)%Z) ->", "(precision <= bits m)%Z) ->"),
    ("Nearest", "(Z.shiftl n shift, d) else", "(Z.shiftr n shift, d) else"),
    ("Nearest", "else (n, Z.shiftl d (- shift)).", "else (n, Z.shiftl d shift)."),
    ("Nearest", "guard_bits - (bits n - bits d).", "guard_bits + (bits n - bits d)."),
    ("Nearest", "guard_bits - (bits n - bits d).", "guard_bits - (bits n + bits d)."),
    ("Nearest", "guard_bits - (bits n - bits d) / 2.", "guard_bits + (bits n - bits d) / 2."),
    ("Nearest", "guard_bits - (bits n - bits d) / 2.", "guard_bits - (bits n - bits d) / 3."),
    ("Nearest", "shifted n d (2 * scale) in", "shifted n d (3 * scale) in"),
    ("Nearest", "hidden : Z := 2 ^ (precision - 1).", "hidden : Z := 2 ^ (precision - 2)."),
    ("Nearest", "if (given =? 2 * hidden)%Z", "if (given =? 3 * hidden)%Z"),
    ("Nearest", "(hidden, exponent_of_given + 1)", "(hidden, exponent_of_given + 2)"),
    ("Nearest", "if (significand <? hidden)%Z then 0%Z", "if (significand <? 2 * hidden)%Z then 0%Z"),
    ("Nearest", "(exponent - min_exponent + 1)%Z in", "(exponent - min_exponent + 2)%Z in"),
    ("Nearest", "if (largest <? biased)%Z then None else", "if (largest <=? biased)%Z then None else"),
    ("Nearest", "biased * 2 ^ (precision - 1) +", "biased * 2 ^ (precision - 2) +"),
    ("Nearest", "+ significand mod hidden)%Z.", "+ significand mod (2 * hidden))%Z."),
    ("Overflow", "Rabs b <= greatest - bpow 971 ->", "Rabs b <= greatest ->"),
    ("Overflow", "Rabs (B2R b) <= greatest - bpow 971 ->", "Rabs (B2R b) <= greatest ->"),
    ("Overflow", "Definition greatest : R := bpow 1024 - bpow 971.", "Definition greatest : R := bpow 1024 - bpow 970."),
]
# The operators and numbers of the models.
CHANGES = [
    (re.compile(r" \+ "), lambda m: " - "),
    (re.compile(r" - "), lambda m: " + "),
    (re.compile(r" \* "), lambda m: " + "),
    (re.compile(r" / "), lambda m: " * "),
    (re.compile(r"(?<![\w.])\d+(?!\w)"), lambda m: str(int(m[0]) + 1)),
]
# The second argument is used only if the sum is not finite, so a change of it is no mutant.
UNUSED = re.compile(r", self\.\(high\) \+ rhs\.\(high\)\)")


def tokens(text):
    return re.findall(r"\w+|[^\w\s]", text)


def rust_function(path, name):
    """Returns the names of the parameters and the body of the first function of this name that has a body."""
    text = re.sub(r"//[^\n]*", "", (HERE / path).read_text())

    def bracket(at, open_, close):
        depth = 0
        for end in range(at, len(text)):
            if text[end] == close and text[end - 1] != "-":
                depth -= 1
            depth += text[end] == open_
            if depth == 0:
                return end + 1
        sys.exit(f"{path}: the brackets of {name} are not closed")

    for found in re.finditer(rf"\bfn {name}\b", text):
        at = found.end()
        if text[at] == "<":
            at = bracket(at, "<", ">")
        end = bracket(at, "(", ")")
        start = text.index("{", end)
        # A declaration in a trait ends with a semicolon.
        if ";" in re.sub(r"\[[^\]]*\]", "", text[end:start]):
            continue
        # Types come after a colon.
        parameters = re.sub(r":\s*[^,\[\]]*(\[[^\]]*\])?", "", text[at:end])
        return re.findall(r"\w+", parameters), text[start + 1 : bracket(start, "{", "}") - 1]
    sys.exit(f"{path} has no function {name}")


def plain(text):
    """Returns Rust without references, copies and paths of the type."""
    text = text.replace(".clone()", "").replace("&", "").replace("Self { high, low }", "parts high low")
    text = re.sub(r"\b(\d[\d_]*)\.0\b", lambda m: m[1].replace("_", ""), text.replace("Self::", ""))
    return re.sub(r"\b(\w+)\.(times_float)\(", r"\2(\1, ", text)


def coq_definition(text):
    """Returns the names of the parameters and the body of a definition, in the notation of Rust."""
    found = re.match(r"Definition \w+ (.*?) :=\n(.*)\.\n$", text, re.S)
    if not found:
        sys.exit(f"this is no definition: {text}")
    parameters, body = found.groups()
    parameters = re.match(r"'\((.*?) : ", parameters)[1]
    body = re.sub(r"\blet '?", "let ", body).replace(":=", "=").replace(".(high)", ".high").replace(".(low)", ".low")
    return re.findall(r"\w+", parameters), re.sub(r"\bin\b", ";", body)


def link():
    differs = 0
    for file in ORDER:
        text = (MODELS / f"{file}.v").read_text()
        for path, name, definition in MODEL.findall(text):
            rust, coq = rust_function(path, name), coq_definition(definition)
            same = rust[0] == coq[0] and tokens(plain(rust[1])) == tokens(coq[1])
            print(f"{file}.v  {path}  {name}: {'equal' if same else 'DIFFERENT'}")
            differs += not same
        for path, name, quoted in QUOTE.findall(text):
            body = "".join(tokens(plain(rust_function(path, name)[1])))
            same = "".join(tokens(plain(quoted))) in body
            print(f"{file}.v  {path}  {name}, quoted: {'equal' if same else 'DIFFERENT: ' + quoted}")
            differs += not same
    return differs


def mutants(compiled, amount):
    tasks = []
    for file in ORDER:
        text = (MODELS / f"{file}.v").read_text()
        for found in MODEL.finditer(text):
            start = text.index(":=\n", found.start(3)) + 3
            unused = [range(*m.span()) for m in UNUSED.finditer(text)]
            for what, becomes in CHANGES:
                for m in what.finditer(text, start, found.end(3)):
                    if not any(m.start() in part for part in unused):
                        new = text[: m.start()] + becomes(m) + text[m.end() :]
                        line = text[text.rindex("\n", 0, m.start()) + 1 : text.index("\n", m.end())]
                        shown = f"{line.strip()}   [{m[0].strip()} at {m.start() - text.rindex(chr(10), 0, m.start())}"
                        tasks.append((file, found[2], f"{shown} -> {becomes(m).strip()}]", new))
        for of, old, new in STRONGER:
            if of == file:
                if old not in text:
                    sys.exit(f"{file}.v does not contain: {old}")
                tasks.append((file, "a bound", f"{old} -> {new}", text.replace(old, new)))

    def refused_by(file, text):
        with tempfile.TemporaryDirectory() as folder:
            for path in Path(compiled).glob("*"):
                if path.suffix in (".v", ".vo"):
                    shutil.copy(path, folder)
            (Path(folder) / f"{file}.v").write_text(text)
            for each in ORDER[ORDER.index(file) :]:
                run = ["coqc", "-q", "-Q", ".", "CannonpileFloats", f"{each}.v"]
                # A check that takes too long, or runs out of memory, is not a rejection.
                done = subprocess.run(run, cwd=folder, capture_output=True, text=True, timeout=600)
                assert done.returncode in (0, 1) and "Out of memory" not in done.stderr, (each, done.stderr[-500:])
                if done.returncode:
                    return each
        return None

    if amount == "few":
        tasks = tasks[::9]
    first = ORDER[0]
    if refused_by(first, (MODELS / f"{first}.v").read_text()):
        sys.exit("a file is refused though nothing was changed")
    survived = 0
    print(f"{'changed':<14} {'rejected in':<14} change")
    for file, name, shown, text in tasks:
        by = refused_by(file, text)
        survived += by is None
        print(f"{name:<18} {by or 'SURVIVES':<14} {shown}", flush=True)
    print(f"{len(tasks)} changes, {survived} survive")
    return survived


if sys.argv[1:2] == ["link"]:
    sys.exit(1 if link() else 0)
sys.exit(1 if mutants(*sys.argv[2:4]) else 0)

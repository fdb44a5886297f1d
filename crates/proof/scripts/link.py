#!/usr/bin/env python3
"""Compares the models of crates/proof/floats with the Rust source, token by token: link.py. The exit status is 1 if one differs."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
MODELS = ROOT / "crates/proof/floats"
MODEL = re.compile(r"\(\* begin (\S+) (\w+) \*\)\n(.*?)\(\* end \*\)", re.S)
QUOTE = re.compile(r"\(\* quote (\S+) (\w+):\s+(.*?) \*\)", re.S)


def tokens(text):
    return re.findall(r"\w+|[^\w\s]", text)


def rust_function(path, name):
    """Returns the names of the parameters and the body of the first function of this name that has a body, if there is one."""
    text = re.sub(r"//[^\n]*", "", (ROOT / path).read_text())

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
    return None, ""


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


def main():
    same = []
    for file in sorted(MODELS.glob("*.v")):
        text = file.read_text()
        if len(re.findall(r"\(\* (?:begin|quote)\b", text)) != len(MODEL.findall(text)) + len(QUOTE.findall(text)):
            sys.exit(f"{file.name}: a model or a quote has another form")
        for path, name, definition in MODEL.findall(text):
            rust, coq = rust_function(path, name), coq_definition(definition)
            same.append(rust[0] == coq[0] and tokens(plain(rust[1])) == tokens(coq[1]))
            print(f"{file.name}  {path}  {name}: {'equal' if same[-1] else 'DIFFERENT'}")
        for path, name, quoted in QUOTE.findall(text):
            same.append("".join(tokens(plain(quoted))) in "".join(tokens(plain(rust_function(path, name)[1]))))
            print(f"{file.name}  {path}  {name}, quoted: {'equal' if same[-1] else 'DIFFERENT: ' + quoted}")
    print(f"{len(same)} models and quotes, {same.count(False)} differ")
    sys.exit(0 if same and all(same) else 1)


main()

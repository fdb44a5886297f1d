"""Public names are documented, and the documentation is correct: examples, stubs, README."""

import doctest
import importlib
import importlib.metadata
import inspect
import os
import pkgutil
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import cannonpile

PACKAGE = Path(cannonpile.__file__).parent


def sections(text):
    """Return the sections of a NumPy docstring by name. The text before them has the name ''."""
    parts = re.split(r"^ *([A-Z][A-Za-z ]+)\n *-{3,} *$", inspect.cleandoc(text or ""), flags=re.MULTILINE)
    return {"": parts[0]} | dict(zip(parts[1::2], parts[2::2], strict=True))


def lacks(name, item):
    """Return the deficiencies in the documentation of a function, a class or a property."""
    text = item.__doc__
    if not text or not text.strip():
        return [f"{name}: no docstring"]
    found, missing = sections(text), []
    summary = found[""].strip().split("\n")[0]
    if not summary.endswith(".") or len(summary) > 120:
        missing.append(f"{name}: no sentence to begin with: {summary}")

    def need(section, *words):
        if section not in found:
            missing.append(f"{name}: no section {section}")
        else:
            missing.extend(
                f"{name}: {word} is not in {section}"
                for word in words
                if not re.search(rf"^\*{{0,2}}({word}|.*\b{word}\b.*) *(:|$)", found[section], re.MULTILINE)
            )

    if inspect.isclass(item) and issubclass(item, tuple):
        need("Attributes", *item._fields)
        return missing
    if isinstance(item, property) or (inspect.isclass(item) and name not in MADE):
        # Users do not call these.
        return missing
    described = inspect.signature(item)
    parameters = [
        parameter.name for parameter in described.parameters.values() if parameter.name not in ("self", "cls", "args", "kwargs")
    ]
    if parameters:
        need("Parameters", *parameters)
        need("Raises")
    if not (inspect.isclass(item) or name in NOTHING or "Yields" in found):
        need("Returns")
    need("Examples")
    return missing


# Functions without a result, and classes that users construct.
NOTHING = {"Pile.assert_close", "RoughFloor.assert_close", "Figure.save", "Page.save"}
MADE = {"Pile"}


def public(module):
    """Yield all public names: functions, classes, and their members without an underscore."""
    for name, item in inspect.getmembers(module):
        if name.startswith("_") or inspect.ismodule(item) or not (callable(item) or inspect.isclass(item)):
            continue
        if getattr(item, "__module__", "").split(".")[0] != module.__name__:
            continue
        yield name, item
        if not inspect.isclass(item):
            continue
        fields = getattr(item, "_fields", ())
        for member, value in inspect.getmembers(item):
            inherited = any(member in base.__dict__ for base in item.__mro__[1:])
            spoken_of = callable(value) or isinstance(value, property)
            if spoken_of and not (member.startswith("_") or member in fields or inherited):
                yield f"{name}.{member}", inspect.getattr_static(item, member) if isinstance(value, property) else value


def test_public_names_are_documented():
    items = dict(public(cannonpile))
    assert {"Pile", "Pile.forces", "Pile.stands", "Comparison.worst", "Figure.save", "Multiples", "census"} <= items.keys()
    missing = [what for name, item in items.items() for what in lacks(name, item)]
    assert missing == [], "\n".join(missing)


def test_missing_documentation_is_detected():
    def bare(spacing): ...

    def half(spacing):
        """Return half.

        Parameters
        ----------
        distance : str
            Something else.
        """

    assert lacks("bare", bare) == ["bare: no docstring"]
    assert lacks("half", half) == [
        "half: spacing is not in Parameters",
        "half: no section Raises",
        "half: no section Returns",
        "half: no section Examples",
    ]


def test_arrays_document_shape_and_type():
    of_pile = ("positions", "stresses", "sites", "contact_ids", "contact_points", "forces", "vectors", "base")
    of_rough_floor = ("normal_vectors", "tangential_vectors", "base", "floor_vectors")
    methods = [getattr(cannonpile.Pile, name) for name in of_pile]
    methods += [getattr(cannonpile.RoughFloor, name) for name in of_rough_floor]
    for method in methods:
        name, returned = method.__qualname__, sections(method.__doc__)["Returns"]
        assert re.search(r"\([NMB],( \d)?\)", returned), name
        assert re.search(r"float64|int64", returned), name


def test_names():
    assert sorted(cannonpile.__all__) == cannonpile.__all__ or len(set(cannonpile.__all__)) == len(cannonpile.__all__)
    for name in cannonpile.__all__:
        assert hasattr(cannonpile, name)
    assert {name for name, _ in public(cannonpile) if "." not in name} <= set(cannonpile.__all__)
    assert cannonpile.__version__ == importlib.metadata.version("cannonpile")
    assert cannonpile.__doc__


def modules():
    """Return the package and its modules."""
    yield cannonpile
    for found in pkgutil.walk_packages(cannonpile.__path__, "cannonpile."):
        yield importlib.import_module(found.name)


def examples():
    """Return the doctests, each once."""
    finder, seen = doctest.DocTestFinder(exclude_empty=True), set()
    for module in modules():
        for test in finder.find(module, module.__name__, extraglobs={"np": np}):
            key = (test.name.rsplit(".", 1)[-1], test.docstring)
            if test.examples and key not in seen:
                seen.add(key)
                yield test


@pytest.mark.parametrize("example", list(examples()), ids=lambda test: test.name)
def test_examples_of_the_documentation(example, tmp_path, monkeypatch):
    # Examples write their files into a temporary folder.
    monkeypatch.chdir(tmp_path)
    said = []
    result = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(example, out=said.append)
    assert result.attempted > 0
    assert result.failed == 0, "".join(said)


def test_examples_exist_and_can_fail():
    found = list(examples())
    assert len(found) >= 20
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    assert doctest.DocTestRunner().run(wrong, out=lambda _: None).failed == 1


def stubtest(folder, **environment):
    """Run mypy on the stubs, in a folder for its cache."""
    call = [sys.executable, "-m", "mypy.stubtest", "cannonpile"]
    return subprocess.run(call, capture_output=True, text=True, check=False, env=os.environ | environment, cwd=folder)


def test_stubs(tmp_path):
    pytest.importorskip("mypy", reason="mypy is not installed: the stubs are not checked")
    run = stubtest(tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr
    # An error in a copy is detected.
    copy = tmp_path / "copy"
    shutil.copytree(PACKAGE, copy / "cannonpile", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    stub = copy / "cannonpile" / "_cannonpile.pyi"
    stub.write_text(stub.read_text(encoding="utf-8") + "\ndef not_at_runtime() -> None: ...\n", encoding="utf-8")
    run = stubtest(tmp_path, MYPYPATH=str(copy))
    assert run.returncode == 1
    assert "not_at_runtime is not present at runtime" in run.stdout, run.stdout + run.stderr


def test_types_are_shipped():
    assert (PACKAGE / "py.typed").exists()

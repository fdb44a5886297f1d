"""All code of README runs."""

import doctest
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

README = Path(__file__).parent.parent / "README.md"
EXAMPLES = README.parent / "examples"


def blocks(language):
    """Return the code blocks in a language, in order."""
    text = README.read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def test_all_blocks_have_known_languages():
    languages = re.findall(r"^```(\w*)$", README.read_text(encoding="utf-8"), re.MULTILINE)
    assert set(languages[::2]) == {"sh", "python", "pycon"} and set(languages[1::2]) == {""}


def test_the_first_simulation(tmp_path):
    # .ci/python runs the commands before this program in a clean copy.
    pytest.importorskip(
        "lammps", reason="LAMMPS is not installed: the first simulation of README is skipped", exc_type=ImportError
    )
    program = blocks("python")[0]
    assert sum(bool(line) and not line.startswith(("import", "from")) for line in program.splitlines()) <= 10
    environment = os.environ | {"LD_LIBRARY_PATH": f"{sys.prefix}/lib"}
    run = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout.splitlines()[-1].startswith("495 of 495 contacts measured, 0 missing")
    # README states 2.3e-7.
    error = float(re.search(r"largest error (\S+),", run.stdout)[1])
    assert 2.25e-7 <= error < 2.35e-7
    # With another pile it fails.
    program = program.replace(
        'code.file("pile.in")', 'code.file("pile.in")\npile = cannonpile.Pile(10, spacing="6/5", gravity=2)'
    )
    run = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert run.returncode == 1 and "AssertionError" in run.stderr


@pytest.mark.parametrize("program", blocks("python")[1:], ids=["own simulation", "pytest"])
def test_programs(program, tmp_path):
    (tmp_path / "test_program.py").write_text(program, encoding="utf-8")
    words = ["-m", "pytest", "-q", "-p", "no:cacheprovider"] if "def test_" in program else []
    call = [sys.executable, *words, "test_program.py"]
    # The options of this pytest do not apply to the inner one.
    environment = {name: value for name, value in os.environ.items() if name != "PYTEST_ADDOPTS"}
    run = subprocess.run(call, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    # With wrong forces the program fails.
    wrong = program.replace("pile.forces()", "pile.forces()[::-1]")
    assert wrong != program
    (tmp_path / "test_program.py").write_text(wrong, encoding="utf-8")
    run = subprocess.run(call, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 1 and "AssertionError" in run.stdout + run.stderr


def test_console(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = "\n".join(blocks("pycon"))
    example = doctest.DocTestParser().get_doctest(text, {"np": np}, "README.md", str(README), 0)
    said = []
    result = doctest.DocTestRunner().run(example, out=said.append)
    assert result.attempted >= 10
    assert result.failed == 0, "".join(said)


def test_all_examples_are_listed():
    named = set(re.findall(r"\(examples/([^)]*)\)", README.read_text(encoding="utf-8")))
    assert named == {path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".ipynb")}

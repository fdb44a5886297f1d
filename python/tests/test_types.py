"""A type checker accepts correct use of the package and reports each mistake."""

import subprocess
import sys

import pytest

pytest.importorskip("mypy", reason="mypy is not installed: the types are not checked")

RIGHT = """\
from decimal import Decimal
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

import cannonpile
from cannonpile import Pile

pile = Pile(4, "hcp", spacing=Fraction(6, 5), mass=Decimal("0.1"), loads={(0, 0, 0): "5/2"})
forces: NDArray[np.float64] = pile.forces("si")
ids: NDArray[np.int64] = pile.contact_ids()
one: Fraction = pile.force(1, 0, 0, "beta")
normal: Fraction = pile.on_floor(0, 0).normal
for name, case, known in cannonpile.cases():
    stands: bool | None = case.stands
    title: str = known.title
pile.assert_close(ids, forces, rtol=1e-9)
pile.assert_close(ids.tolist(), vectors=pile.vectors())
standing: list[str] = [entry.stacking for entry in cannonpile.census(4)]
weakest = pile.weakest()
if weakest is not None:
    least: Fraction = weakest.force
svg: str = pile.plot("base", width=400).svg
rough = Pile(2).on_rough_floor(friction="1/2")
holds: bool | None = rough.stands
tangential: Fraction = rough.contacts()[0].tangential
rough.assert_close(rough.pile.contact_ids(), vectors=rough.normal_vectors(), floor=rough.floor_vectors())
for name, rough_floor, known in cannonpile.friction_cases():
    needed: float = rough_floor.friction_needed
"""
WRONG = """\
from cannonpile import Pile

Pile(4, spacing=1.2)
Pile(4, "fcc", "hexagon:3")
Pile(4).forces("imperial")
Pile(4).force(0, 0, 0, "delta")
number: int = Pile(4).force(0, 0)
Pile(4).layers = 3
Pile(4).weakest().force
Pile(2).on_rough_floor(friction=0.5)
Pile(2).on_rough_floor().compare()
"""


def test_types(tmp_path):
    for name, text in (("right.py", RIGHT), ("wrong.py", WRONG)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    call = [sys.executable, "-m", "mypy", "--strict", "--python-version=3.10", "right.py", "wrong.py"]
    run = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=False)
    lines = {line.split(":")[1] for line in run.stdout.splitlines() if ": error:" in line}
    assert "right.py" not in run.stdout, run.stdout
    # Each line except the import and the empty line.
    assert lines == {str(number) for number in range(3, len(WRONG.splitlines()) + 1)}, run.stdout

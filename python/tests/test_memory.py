"""Large arrays are built without a second copy in memory."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the memory peak is read from /proc")

# The peak of this process, without that of its parent.
PROGRAM = """
from pathlib import Path
from cannonpile import Pile

def peak():
    [line] = [line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith("VmHWM:")]
    return int(line.split()[1]) * 1024

for warm in (Pile(5), Pile(5, "hcp")):
    warm.forces(), warm.vectors(), warm.positions(), warm.contact_ids()
before = peak()
array = {}
print((peak() - before) / array.nbytes)
"""


def share(expression):
    """Return the memory that a process needs for an array, divided by the size of the array."""
    program = PROGRAM.replace("array = {}", f"array = {expression}")
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    return float(run.stdout)


@pytest.mark.parametrize(
    "expression",
    [
        "Pile(200).forces()",
        "Pile(200).vectors()",
        "Pile(200).contact_ids()",
        "Pile(300).positions()",
        "Pile(130, 'hcp').forces()",
    ],
)
def test_arrays_are_built_without_copies(expression):
    assert 0.9 < share(expression) < 1.3


def test_copy_is_detected():
    assert share("Pile(200).vectors().copy()") > 1.8

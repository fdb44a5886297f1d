"""Large arrays take the memory that they are, and no copy of it."""

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="the peak of memory is read from /proc")

# The peak of the process since it began, not that of the one that started it.
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
    """The memory that a process takes for an array, over the array's own."""
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
def test_memory_is_that_of_the_array(expression):
    assert 0.9 < share(expression) < 1.3


def test_a_copy_is_seen():
    assert share("Pile(200).vectors().copy()") > 1.8

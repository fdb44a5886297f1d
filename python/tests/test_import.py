"""The import time of the package without that of NumPy, which is printed but not asserted."""

import re
import subprocess
import sys

CALL = [sys.executable, "-X", "importtime", "-c", "import numpy, cannonpile"]


def imported():
    """Return each imported module with its cumulative import time in milliseconds."""
    run = subprocess.run(CALL, capture_output=True, text=True, check=True)
    return {name: int(total) / 1000 for total, name in re.findall(r"\| +(\d+) \| +(\S+)$", run.stderr, re.MULTILINE)}


def test_import_time_is_printed(capsys):
    runs = [imported() for _ in range(5)]
    with capsys.disabled():
        print(f"\nimport cannonpile, after NumPy: {min(run['cannonpile'] for run in runs):.1f} ms, the least of 5")
    # Modules for figures, tests and notebooks are not imported.
    assert not {name.split(".")[0] for name in runs[0]} & {"IPython", "matplotlib", "mypy", "pytest", "hypothesis", "scipy"}
    assert "cannonpile._cannonpile" in runs[0]

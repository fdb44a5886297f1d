"""Fixtures: piles and the command line."""

import csv
import io
import os
import subprocess

import pytest
from hypothesis import settings

import cannonpile

from piles import ALL, STACKED, command_line

# No deadline, no example database, and deterministic examples in CI.
settings.register_profile("here", deadline=None, database=None, print_blob=True, derandomize="CI" in os.environ)
settings.load_profile("here")


@pytest.fixture(params=ALL, ids=str)
def options(request):
    """The arguments of a pile."""
    return ALL[request.param]


@pytest.fixture
def pile(options):
    """A pile of every kind."""
    return cannonpile.Pile(**options)


@pytest.fixture(params=STACKED, ids=str)
def stacked(request):
    """The arguments of a pile that the recursion supports."""
    return STACKED[request.param]


@pytest.fixture(scope="session")
def table():
    """Return a function that runs a command of the binary CANNONPILE on a pile and returns the rows of its table."""
    binary = os.environ.get("CANNONPILE")
    if not binary:
        pytest.skip("CANNONPILE is not set to a binary: the command line is not compared")

    def rows(command, options, *words):
        call = [binary, command, *command_line(options), *words, "--format=csv"]
        run = subprocess.run(call, capture_output=True, text=True, check=False)
        # Exit status 1 means a negative answer.
        assert run.returncode in (0, 1), run.stderr
        return list(csv.DictReader(io.StringIO(run.stdout)))

    return rows


def pytest_terminal_summary(terminalreporter):
    """List the skipped tests at the end of the output."""
    for skipped in terminalreporter.stats.get("skipped", []):
        terminalreporter.write_line(f"*** NOT CHECKED: {skipped.nodeid}: {skipped.longrepr[2]}")

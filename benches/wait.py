#!/usr/bin/env python3
"""Measures how long a user waits for the first force: builds from nothing, and the first answer of the binary.

    python3 benches/wait.py

It prints lines `seconds NAME VALUE`, and the three largest parts of each. At the end there are lines `ratio NAME VALUE`: the time
of the other builds over that of the core, and of the answers over that of a process that does nothing. The builds are those of
the core as a dependency, of the binary, and of the extension module in the wheel, with all dependencies and without a cache. The
sources of the dependencies must be there, as after `cargo fetch`. The time of a build depends on the number of cores, and the
time of a part is that of its own compiler. The times of answers are medians, with the start of the process. The whole takes some
ten minutes.

Needs Rust and Python 3.10. """

import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent.parent
BUILDS = {
    "build_core": ["--package", "cannonpile", "--lib"],
    "build_binary": ["--package", "cannonpile-cli"],
    "build_wheel": ["--manifest-path", "python/Cargo.toml"],
}
ANSWERS = {
    "first_answer": ["base", "--layers", "2"],
    "first_answer_of_hcp": ["base", "--layers", "30", "--stacking", "hcp"],
}
TIMES = 40


def build(arguments, folder):
    """Builds in an empty folder. Returns the time, and the time of each compiled unit."""
    environment = os.environ | {"CARGO_TARGET_DIR": str(folder)}
    command = ["cargo", "build", "--release", "--locked", "--timings", *arguments]
    began = time.monotonic()
    subprocess.run(command, cwd=HERE, env=environment, check=True, stderr=subprocess.DEVNULL)
    seconds = time.monotonic() - began
    report = (folder / "cargo-timings" / "cargo-timing.html").read_text()
    data = re.search(r"^const UNIT_DATA = (\[.*?^\]);", report, re.MULTILINE | re.DOTALL)
    if not data:
        sys.exit("cargo-timing.html: no UNIT_DATA")
    units = [(unit["duration"], f"{unit['name']}{unit['target']}".strip()) for unit in json.loads(data[1])]
    return seconds, sorted(units, reverse=True)


def answers(commands):
    """Returns the median time of each command. The commands run in turn."""
    times = [[] for _ in commands]
    for _ in range(TIMES):
        for command, own in zip(commands, times):
            began = time.perf_counter()
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            own.append(time.perf_counter() - began)
    return [statistics.median(own) for own in times]


def main():
    ratios = {}
    with tempfile.TemporaryDirectory() as temporary:
        for name, arguments in BUILDS.items():
            seconds, units = build(arguments, Path(temporary) / name)
            if name == "build_core":
                core = seconds
            else:
                ratios[f"{name}_over_core"] = seconds / core
            print(f"seconds {name} {seconds:.1f}")
            for duration, unit in units[:3]:
                print(f"  {duration:7.1f} {unit}")
        binary = str(Path(temporary) / "build_binary" / "release" / "cannonpile")
        commands = [["true"], [binary, "--version"], *([binary, *arguments] for arguments in ANSWERS.values())]
        process, start, *asked = answers(commands)
        for name, seconds in zip(ANSWERS, asked):
            ratios[f"{name}_over_process"] = seconds / process
            print(f"seconds {name} {seconds:.4f}")
            parts = [(process, "any process"), (start - process, "start of the binary"), (seconds - start, "the answer")]
            for duration, part in sorted(parts, reverse=True):
                print(f"  {duration:7.4f} {part}")
    for name, ratio in ratios.items():
        print(f"ratio {name} {ratio:.2f}")


if __name__ == "__main__":
    main()

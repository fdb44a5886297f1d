#!/usr/bin/env python3
"""Runs the benches and scripts that compare times, and prints all their lines `ratio NAME VALUE`.

    python3 benches/ratios.py [BENCH...] [--before FILE] [--after FILE] > after

BENCH is one of the names below; without one, all run, in half an hour or more. With `--before` the script also prints a table of
the ratios in an earlier output and those of this run. With `--after` it runs nothing, and takes another output instead. The whole
output of the benches goes to stderr. If a bench fails, the others still run, and the exit status is 1.

The benches of Rust need Rust only. `side_by_side` and `wait` say what they need. """

import argparse
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
CARGO = ["cargo", "bench", "--manifest-path", str(HERE / "Cargo.toml"), "--features", "all", "--bench"]
BENCHES = {name: [*CARGO, name] for name in ("throughput", "horizontal", "one_contact", "disorder", "prove", "scalars", "surd")}
BENCHES["side_by_side"] = [sys.executable, str(HERE / "side_by_side")]
BENCHES["wait"] = [sys.executable, str(HERE / "wait.py")]


def ratios(lines):
    """Returns the values of all lines `ratio NAME VALUE`, as they are written."""
    found = [line.split() for line in lines if line.startswith("ratio ")]
    return {name: value for _, name, value in found}


def run(names):
    """Runs benches and prints their ratios. Returns these, and the benches that failed."""
    results, failed = {}, []
    for name in names:
        print(f"{name} …", file=sys.stderr, flush=True)
        lines = []
        with subprocess.Popen(BENCHES[name], stdout=subprocess.PIPE, text=True) as bench:
            for line in bench.stdout:
                lines.append(line)
                print(line, end="", file=sys.stderr, flush=True)
        found = ratios(lines)
        if bench.returncode or not found:
            print(f"*** FAILED: {name}: exit status {bench.returncode}, {len(found)} ratios", file=sys.stderr)
            failed.append(name)
        if twice := results.keys() & found.keys():
            sys.exit(f"{name}: another bench has the ratios {', '.join(sorted(twice))}")
        for ratio, value in found.items():
            print(f"ratio {ratio} {value}", flush=True)
        results |= found
    return results, failed


def table(before, after):
    """Returns the table of all ratios before and after."""
    rows = ["| ratio | before | after | after / before |", "|---|--:|--:|--:|"]
    for name in after | before:
        values = before.get(name, ""), after.get(name, "")
        change = f"{float(values[1]) / float(values[0]):.2f}" if all(values) and float(values[0]) else ""
        rows.append(f"| `{name}` | {values[0]} | {values[1]} | {change} |")
    return "\n".join(rows)


def main():
    parser = argparse.ArgumentParser(description="Prints the ratios of all benches.")
    parser.add_argument("bench", nargs="*", metavar="BENCH", help=", ".join(BENCHES))
    parser.add_argument("--before", type=Path, metavar="FILE", help="an earlier output, for a table")
    parser.add_argument("--after", type=Path, metavar="FILE", help="another output, instead of a run")
    options = parser.parse_args()
    if unknown := set(options.bench) - BENCHES.keys():
        parser.error(f"there is no bench {', '.join(sorted(unknown))}: the benches are {', '.join(BENCHES)}")
    earlier = ratios(options.before.read_text().splitlines()) if options.before else None
    if options.after:
        results, failed = ratios(options.after.read_text().splitlines()), []
    else:
        results, failed = run(options.bench or BENCHES)
    if earlier is not None:
        print(f"\n{table(earlier, results)}")
    if failed:
        sys.exit(1)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Compares the rounding errors of a sweep with what other programs say: rounding.py gappa|pychop TABLE FOLDER…

TABLE has lines of `cargo run -p cannonpile-accuracy --example sweep_errors`, and each folder was written by `cannonpile export --to mtx` for
the same HCP piles. All errors are in u F, with the unit roundoff u and the largest force F above the floor.

Gappa bounds the error of one contact in f32, for all weights from 1 to 1 + 2^-10: the contact above the floor with the most spheres above it
and, among these, the largest force. It has the operations of the library, once alone and once with a hint for each contact.
No error of the 8193 weights of f32 may exceed its bound, and it must refuse half of the largest error.

pychop rounds stochastically to 11 bits. The mean square of the errors of all contacts must be that of the library within 2 %.
Errors must have the mean zero. With 12 bits, and with both neighbours equally likely (as in CADNA), the script must notice it.
"""

import re
import resource
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np

SAMPLES = 2000


class Pile:
    def __init__(self, folder):
        self.exact = [Fraction(force) for force in (folder / "forces_exact.txt").read_text().split()]
        self.size = len(self.exact)
        # The contacts from above on a sphere, by line. `size` is a missing one.
        self.above = np.full((self.size // 3, 3), self.size)
        entries = [line.split() for line in (folder / "equilibrium.mtx").read_text().splitlines() if not line.startswith("%")]
        for row, column, _ in entries[1:]:
            if row != column:
                upper = int(column) - 1
                self.above[(int(row) - 1) // 3, upper % 3] = upper
        self.cones = []
        depth = []
        for spheres in ([contact // 3 for contact in contacts if contact < self.size] for contacts in self.above):
            depth.append(1 + max((depth[upper] for upper in spheres), default=-1))
            self.cones.append({len(self.cones)}.union(*(self.cones[upper] for upper in spheres)))
        self.depth = np.array(depth)
        self.last = [3 * sphere + line for sphere in np.flatnonzero(self.depth == max(depth)) for line in range(3)]
        self.layers = max(depth) + 2
        self.greatest = float(max(self.exact[contact] for contact in self.last))

    def sweep(self, weight, rounded):
        """Returns the forces of all contacts, in the order of operations of the library, for an array of weights."""
        forces = np.zeros((self.size + 1, len(weight)), weight.dtype)
        for layer in range(self.layers - 1):
            spheres = np.flatnonzero(self.depth == layer)
            g = forces[self.above[spheres]]
            mean = rounded(2 * rounded(rounded(g[:, 0] + g[:, 1]) + g[:, 2]) / 3)
            for line in range(3):
                turned = rounded(mean - g[:, line]) if layer else 0 * mean
                forces[3 * spheres + line] = rounded(turned + weight)
        return forces[:-1]

    def program(self, contact, has_hints, claim):
        """Returns the sweep down to a contact, and the exact forces, in the language of Gappa."""
        lines, hints = ["@rnd = float<ieee_32, ne>;", "w = rnd(W);"], []
        for sphere in sorted(self.cones[contact // 3]):
            g = [upper for upper in self.above[sphere] if upper < self.size]
            if g:
                computed = exact = f"f{g[0]}"
                for upper in g[1:]:
                    computed, exact = f"rnd({computed} + f{upper})", f"({exact} + f{upper})"
                # x is the computed mean, s the exact mean of computed forces, and S that of exact ones.
                lines.append(f"x{sphere} = rnd(2 * {computed} / 3); s{sphere} = 2 * {exact} / 3; S{sphere} = 2 * {exact.replace('f', 'F')} / 3;")
            for line, upper in enumerate(self.above[sphere]):
                below = 3 * sphere + line
                if not g:
                    lines.append(f"f{below} = w; F{below} = w;")
                elif upper == self.size:
                    lines.append(f"f{below} = rnd(x{sphere} + w); F{below} = S{sphere} + w;")
                else:
                    lines.append(f"D{below} = S{sphere} - F{upper}; F{below} = D{below} + w;")
                    lines.append(f"f{below} = rnd(rnd(x{sphere} - f{upper}) + w);")
                    others = "".join(f"2 * (f{other} - F{other}) / 3 + " for other in g if other != upper)[:-2]
                    hints.append(f"(x{sphere} - f{upper}) - D{below} -> (x{sphere} - s{sphere}) + ({others}- (f{upper} - F{upper}) / 3);")
        return "\n".join([*lines, f"{{ W in [1, 1025b-10] -> f{contact} - F{contact} in {claim} }}", *(hints if has_hints else [])])


def run_gappa(program):
    """Returns the bound in f0, or None if the claim is not proved, and the seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    run = subprocess.run(["gappa", "-Wno-hint-difference"], input=program, capture_output=True, text=True)
    ends = re.findall(r"\{([-+.e\d]+), -?2\^", run.stderr)
    bound = max(abs(float(end)) for end in ends) if run.returncode == 0 else None
    return bound, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def gappa(pile, proved, probable, *_):
    unit = 2.0**-24 * pile.greatest
    contact = max(pile.last, key=lambda contact: (len(pile.cones[contact // 3]), pile.exact[contact]))
    weights = (1 + np.arange(8193) * 2.0**-23).astype(np.float32)
    errors = pile.sweep(weights, lambda x: x)[contact] - weights.astype(float) * float(pile.exact[contact])
    error = np.abs(errors).max()
    assert error > 0
    text = f"{pile.layers} layers, {len(pile.cones[contact // 3])} spheres: error {error / unit:.1f}, probable {probable:.0f}"
    for has_hints in (True, False):
        bound, seconds = run_gappa(pile.program(contact, has_hints, "?"))
        assert error <= bound
        text += f", Gappa {'with' if has_hints else 'without'} hints {bound / unit:.1f} ({seconds:.1f} s)"
    assert pile.layers > 6 or run_gappa(pile.program(contact, True, f"[{-error / 2:.20f}, {error / 2:.20f}]"))[0] is None
    return f"{text}, proved {proved:.0f}"


def pychop(pile, _, __, squares, means):
    from pychop import Customs
    from pychop.np.float_point import Chop_

    exact = np.array([[float(pile.exact[contact])] for contact in pile.last])
    ratios = []
    for mode, bits in ((5, 11), (5, 12), (6, 11)):
        rounded = Chop_(rmode=mode, customs=Customs(t=bits, emax=127), random_state=pile.layers)
        errors = (pile.sweep(np.ones(SAMPLES), rounded)[pile.last] - exact) * 2**11 / pile.greatest
        ratios.append((errors**2).mean(axis=1).sum() / squares)
        if (mode, bits) == (5, 11):
            means = [means / squares * SAMPLES, (errors.mean(axis=1) ** 2).sum() / (errors**2).mean(axis=1).sum() * SAMPLES]
    assert abs(ratios[0] - 1) < 0.02 and all(abs(ratio - 1) > 0.1 for ratio in ratios[1:]), ratios
    assert all(0.5 < mean < 2 for mean in means), means
    return f"{pile.layers} layers: mean squares {ratios[0]:.4f} times those of the library, in 12 bits {ratios[1]:.2f}, in the mode of CADNA {ratios[2]:.2f}"


def main(compare, table, *folders):
    rows = [[float(number) for number in line.split()] for line in Path(table).read_text().splitlines()]
    for (layers, greatest, *figures), folder in zip(rows, map(Path, folders), strict=True):
        pile = Pile(folder)
        assert pile.layers == layers and abs(pile.greatest / greatest - 1) < 1e-15
        print({"gappa": gappa, "pychop": pychop}[compare](pile, *figures), flush=True)


main(*sys.argv[1:])

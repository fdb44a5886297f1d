"""A matplotlib figure from arrays: base normal forces of three stackings, and the contacts of a slice through each.

    pip install ./python matplotlib
    python forces_figure.py [FILE]

The figure is written to FILE, by default forces.png.
"""

import sys

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.collections import LineCollection, PatchCollection
from matplotlib.colors import Normalize
from matplotlib.patches import Circle

from cannonpile import Pile

LAYERS, TOP, SPACING = 7, "hexagon:4", "11/10"
STACKINGS = ["fcc", "dhcp", "hcp"]
COMPRESSIVE, TENSILE = "tab:blue", "tab:red"


def floor(axes, pile, scale):
    """Draw each bottom sphere as a disc coloured by its normal force."""
    places = pile.positions()[-pile.base_count :, :2]
    normal = pile.base("pile")[:, 0]
    axes.set_aspect("equal")
    axes.set_xlim(places[:, 0].min() - 2, places[:, 0].max() + 2)
    axes.set_ylim(places[:, 1].min() - 2, places[:, 1].max() + 2)
    discs = axes.add_collection(PatchCollection([Circle(place, 1) for place in places]))
    discs.set(array=normal, norm=scale, cmap="viridis")
    axes.set(title=f"{pile.stacking}: {normal.min():.3g} to {normal.max():.3g} mg", xlabel="x / R", ylabel="y / R")
    return discs


def slice_of(axes, pile):
    """Draw the contacts near the plane y = 0. The line width shows the force; red contacts are tensile."""
    places, pairs, forces = pile.positions(), pile.contact_ids() - 1, pile.forces("pile")
    near = np.abs(places[pairs][:, :, 1]).max(axis=1) < 1.2
    lines = places[pairs[near]][:, :, [0, 2]]
    # A minimum width keeps all lines visible.
    widths = 0.5 + 4 * np.abs(forces[near]) / np.abs(forces).max()
    colours = np.where(forces[near] < 0, TENSILE, COMPRESSIVE)
    axes.add_collection(LineCollection(lines, linewidths=widths, colors=colours, capstyle="round"))
    axes.set_aspect("equal")
    axes.autoscale()
    stands = "is stable" if pile.stands else "is unstable: red contacts are tensile"
    axes.set(title=f"{pile.stacking} {stands}", xlabel="x / R", ylabel="z / R")


piles = [Pile(LAYERS, stacking, top=TOP, spacing=SPACING) for stacking in STACKINGS]
normals = np.concatenate([pile.base("pile")[:, 0] for pile in piles])
scale = Normalize(normals.min(), normals.max())
figure, (above, below) = plt.subplots(2, len(piles), figsize=(12, 7), height_ratios=[1.4, 1], layout="constrained")
for top, bottom, pile in zip(above, below, piles, strict=True):
    shown = floor(top, pile, scale)
    slice_of(bottom, pile)
    # The base carries the whole weight.
    assert np.isclose(pile.base("pile")[:, 0].sum(), float(pile.weight), rtol=1e-12)
figure.colorbar(shown, ax=above, label="normal force on the floor / mg")
path = sys.argv[1] if len(sys.argv) > 1 else "forces.png"
figure.savefig(path, dpi=150)
print(path)

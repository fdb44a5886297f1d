"""Piles for many tests: the arguments of `cannonpile.Pile`, and the same for the command line."""

from fractions import Fraction

import numpy as np

from recursion import Recursion

# One of each kind: straight, alternating and mixed; built from wide tops and from bases; loads, sizes, weightless.
STACKED = {
    "one sphere": {"layers": 1},
    "straight": {"layers": 6},
    "sizes": {"layers": 5, "radius": "1e-3", "mass": "1e-5", "gravity": "9.81", "spacing": "1.3"},
    "hcp": {"layers": 5, "stacking": "hcp"},
    "unstable hcp": {"layers": 8, "stacking": "hcp"},
    "dhcp": {"layers": 7, "stacking": "dhcp"},
    "spelled out": {"layers": 6, "stacking": "++-+-"},
    "hexagon": {"layers": 4, "stacking": "hcp", "top": "hexagon:3,2"},
    "triangle": {"layers": 3, "top": "triangle:4"},
    "region": {"layers": 4, "stacking": "-++", "top": "region:0..3,-1..2,0..3"},
    "base": {"layers": 3, "stacking": "+-", "base": "hexagon:4,3"},
    "mirrored base": {"layers": 3, "stacking": "-+", "base": "hexagon:4,3"},
    "loads": {"layers": 5, "loads": {(0, 0, 0): "5/2", (2, 1, 0): 3, (1, 2): "1/7"}},
    "loads on hcp": {"layers": 5, "stacking": "hcp", "top": "hexagon:2", "loads": {(1, 0, 0): "0.75"}},
    "response": {"layers": 6, "stacking": "+-+-+", "weightless": True, "loads": {(0, 0, 0): 1}},
}
# The recursion does not support these.
OTHERS = {
    "isosceles": {"layers": 5, "sin_phi": "2/5"},
    "discs": {"layers": 6, "dimension": 2},
    "loads on discs": {"layers": 4, "dimension": 2, "loads": {(1, 0): 2, (1,): "1/3"}},
    "elastic": {"layers": 6, "stacking": "+-+-+", "state": "elastic"},
    "elastic with loads": {
        "layers": 5,
        "stacking": "hcp",
        "state": "elastic",
        "stiffness_ratio": "3/2",
        "loads": {(0, 0, 0): "1/30"},
    },
}
ALL = STACKED | OTHERS


def recursion(options):
    """Return the recursion for a pile of STACKED."""
    known = ("layers", "stacking", "top", "base", "loads", "weightless")
    return Recursion(**{name: value for name, value in options.items() if name in known})


def command_line(options):
    """Return the options of the command line for the same pile."""
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if name == "loads":
            words += [f"--load={','.join(map(str, place))}={weight}" for place, weight in value.items()]
        elif value is True:
            words.append(option)
        else:
            words.append(f"{option}={value}")
    return words


def down(pile, options):
    """Return weight plus load of each sphere, in N."""
    pulls = np.zeros(pile.sphere_count) if options.get("weightless") else np.ones(pile.sphere_count)
    for place, weight in options.get("loads", {}).items():
        on_base = len(place) < pile.dimension
        pulls[pile.sphere_id(*((pile.layers - 1, *place) if on_base else place)) - 1] += float(Fraction(weight))
    return pulls * float(pile.mass * pile.gravity)

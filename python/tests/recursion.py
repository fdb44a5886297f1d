"""An oracle: the forces of a pile from the balance of each sphere, from the top, in fractions.

It follows from the equilibrium equations alone, is slow, and does not import cannonpile.

A layer is a set of sites (i, j) of the triangular lattice. Below a step of sign s sphere (i, j) is supported by
(i, j), (i + s, j), (i, j + s): its supports alpha, beta, gamma. From the upper sphere the horizontal parts of the three
contacts are s u_alpha, s u_beta, s u_gamma, with u_alpha + u_beta + u_gamma = 0.
"""

from fractions import Fraction
from math import sqrt

DIRECTIONS = ("alpha", "beta", "gamma")
OFFSETS = ((0, 0), (1, 0), (0, 1))
NAMED = {"fcc": "+", "hcp": "+-", "dhcp": "++--"}
ONE_SPHERE = ((0, 0), (0, 0), (0, 0))


def signs(stacking, steps):
    """Return the signs of the steps, +1 or -1, from a name or from Hägg signs."""
    text = stacking
    if stacking in NAMED:
        text = (NAMED[stacking] * (steps + 1))[:steps]
    assert len(text) == steps and set(text) <= set("+-"), (stacking, steps)
    return [1 if sign == "+" else -1 for sign in text]


def region(text):
    """Return the bounds of i, j and i + j: "hexagon:3,2", "triangle:4", "region:x0..x1,y0..y1,s0..s1"."""
    if text is None:
        return ONE_SPHERE
    shape, sizes = text.split(":")
    if shape == "region":
        return tuple(tuple(int(bound) for bound in pair.split("..")) for pair in sizes.split(","))
    p, *rest = (int(size) for size in sizes.split(","))
    q = 1 if shape == "triangle" else (rest or [p])[0]
    return ((1 - q, p - 1),) * 3


def sites_within(bounds):
    """Return the sites within these bounds."""
    (x0, x1), (y0, y1), (s0, s1) = bounds
    return {(i, j) for i in range(x0, x1 + 1) for j in range(y0, y1 + 1) if s0 <= i + j <= s1}


def supports(site, sign):
    """Return the three supports of a sphere in the layer below."""
    return [(site[0] + sign * i, site[1] + sign * j) for i, j in OFFSETS]


def sum_and_differences(forces):
    """Return the vertical part of three contact forces, and the horizontal parts along u_beta and u_gamma."""
    alpha, beta, gamma = forces
    return alpha + beta + gamma, beta - alpha, gamma - alpha


class Recursion:
    """The forces of a pile of spheres without contacts within layers.

    `forces` maps (k, i, j, direction) to fractions, in the order of the table of contacts; the unit is mg/(3 cos theta).
    `floor` maps (i, j) to normal force, shear along x and shear along y, in mg, mg tan theta and sqrt(3) mg tan theta.
    """

    def __init__(self, layers, stacking="fcc", *, top=None, base=None, loads=None, weightless=False):
        # With a base the signs are read from the base upwards.
        steps = signs(stacking, layers - 1)
        self.signs = steps[::-1] if base else steps
        self.layers = self._grown_up(base) if base else self._grown_down(top)
        self.anchor = layers - 1 if base else 0
        weights = {(k, *site): Fraction(0 if weightless else 1) for k, layer in enumerate(self.layers) for site in layer}
        for place, weight in (loads or {}).items():
            where = (layers - 1, *place) if len(place) == 2 else place
            weights[where] += Fraction(weight)
        self.weight = sum(weights.values())
        self._count(weights)

    def _grown_down(self, top):
        layers = [sites_within(region(top))]
        for sign in self.signs:
            layers.append({support for site in layers[-1] for support in supports(site, sign)})
        return layers

    def _grown_up(self, base):
        layers = [sites_within(region(base))]
        for sign in reversed(self.signs):
            below = layers[0]
            near = {(i - sign * a, j - sign * b) for i, j in below for a, b in OFFSETS}
            layers.insert(0, {site for site in near if below.issuperset(supports(site, sign))})
        return layers

    def _count(self, weights):
        self.forces, self.floor = {}, {}
        above = {site: [Fraction(0)] * 3 for site in self.layers[0]}
        sign = 1
        for k, layer in enumerate(self.layers):
            last = k == len(self.layers) - 1
            next_sign = sign if last else self.signs[k]
            below = {} if last else {site: [Fraction(0)] * 3 for site in self.layers[k + 1]}
            for site in in_order(layer):
                weight = weights[(k, *site)]
                vertical, along_beta, along_gamma = sum_and_differences(above[site])
                if last:
                    gamma = along_gamma - along_beta / 2
                    self.floor[site] = (vertical / 3 + weight, sign * gamma / 3, sign * along_beta / 6)
                    continue
                # Forces are in f0, with a vertical part of mg/3. So the lower contacts carry the vertical force plus
                # three times the weight, and balance the horizontal force.
                carried, beta, gamma = vertical + 3 * weight, *(x * sign * next_sign for x in (along_beta, along_gamma))
                alpha = (carried - beta - gamma) / 3
                for index, force in enumerate((alpha, alpha + beta, alpha + gamma)):
                    self.forces[(k, *site, DIRECTIONS[index])] = force
                    below[supports(site, next_sign)[index]][index] = force
            above, sign = below, next_sign

    def sites(self):
        """Return (k, i, j) of all spheres, in the order of their ids."""
        return [(k, *site) for k, layer in enumerate(self.layers) for site in in_order(layer)]

    def contact_ids(self):
        """Return the ids of both spheres of every contact, the upper one first."""
        number = {site: 1 + index for index, site in enumerate(self.sites())}
        pairs = []
        for k, i, j, direction in self.forces:
            support = supports((i, j), self.signs[k])[DIRECTIONS.index(direction)]
            pairs.append((number[(k, i, j)], number[(k + 1, *support)]))
        return pairs

    def positions(self, spacing, radius=1):
        """Return the centres as floats: z up from the bottom layer, site (0, 0) of the top (or of the base) at x = y = 0."""
        ratio, radius = float(Fraction(spacing)), float(Fraction(radius))
        # sin(theta) = a/(sqrt(3) R) for contacts of length 2R.
        across = 2 * radius * ratio / sqrt(3)
        up = 2 * radius * sqrt(1 - ratio**2 / 3)
        alpha, beta, gamma = [(-across / 2, -across * sqrt(3) / 2), (-across / 2, across * sqrt(3) / 2), (across, 0.0)]
        shifts = [0]
        for sign in self.signs:
            shifts.append(shifts[-1] + sign)
        shifts = [shift - shifts[self.anchor] for shift in shifts]
        return [
            (
                *(shifts[k] * alpha[x] + i * (beta[x] - alpha[x]) + j * (gamma[x] - alpha[x]) for x in (0, 1)),
                (len(self.layers) - 1 - k) * up,
            )
            for k, i, j in self.sites()
        ]

    def stands(self):
        """Return whether no contact force is tensile."""
        return all(force >= 0 for force in self.forces.values())


def in_order(layer):
    """Return the sites of a layer in row order."""
    return sorted(layer, key=lambda site: (site[1], site[0]))


def isosceles(layers, sin_phi):
    """Return the contact forces of the straight pile for any azimuth, in mg/(2 (1 + sin phi) cos theta), as in the paper."""
    grow = (Fraction(1), Fraction(1), 2 * Fraction(sin_phi))
    return {
        (k, i, j, direction): (count + 1) * step
        for k in range(layers - 1)
        for j in range(k + 1)
        for i in range(k + 1 - j)
        for direction, count, step in zip(DIRECTIONS, (k - i - j, i, j), grow, strict=True)
    }


def discs(layers):
    """Return the contact forces of a pile of discs under one disc, in mg/(2 cos theta)."""
    return {
        (k, i, 0, direction): Fraction(count + 1)
        for k in range(layers - 1)
        for i in range(k + 1)
        for direction, count in (("alpha", k - i), ("beta", i))
    }

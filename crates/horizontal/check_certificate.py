#!/usr/bin/env python3
"""Checks a certificate about the contact forces of a sphere pile at a = R: check_certificate.py FILE (- for stdin).

The guide has the grammar of these files: docs/certificates.md.

Prints `accepted` (exit status 0), or `refused: ` and the first condition that is violated (1). If the input is not a
certificate, it prints one line on stderr (2). It needs Python 3.9 or later and the standard library only.

The trusted base is this file, Python's integers and fractions, and two pages of mathematics: `src/paper.md` of the
crate cannonpile ("Stackings", "Regions", "Horizontal contacts") and `src/certificate.rs` in this crate. No code is
shared with the library, and the methods differ: this script builds layers as sets of sites and transfers forces to the
layer below, where the library uses counting formulas and visits the spheres one by one.

Forces are in f0 = mg/(n cos theta), with n = 3 directions for spheres and 2 for discs. A sphere is (k, i, j), with layer
k counted from the top. Below a step of sign s it is supported by (k+1, i + s x, j + s y), where (x, y) = (0, 0), (1, 0),
(0, 1) for alpha, beta, gamma.
"""

import json
import re
import sys
from fractions import Fraction

OFFSETS = {"alpha": (0, 0), "beta": (1, 0), "gamma": (0, 1)}
AXES = {"alpha-beta": ("alpha", "beta"), "alpha-gamma": ("alpha", "gamma"), "gamma-beta": ("gamma", "beta")}
MAX_SPHERES = 1_000_000
MAX_DIGITS = 5_000


class Unreadable(Exception):
    """The input is not a valid certificate."""


class Refused(Exception):
    """A condition of the certificate is violated."""


def need(holds, condition):
    if not holds:
        raise Refused(condition)


# Reading


def record(given, keys):
    """Return the values of a JSON object with exactly these keys."""
    if not isinstance(given, dict) or sorted(given) != sorted(keys.split()):
        raise Unreadable(f"expected an object with the keys {keys}")
    return [given[key] for key in keys.split()]


def matched(pattern, given, what):
    found = re.fullmatch(pattern, given, re.ASCII) if isinstance(given, str) else None
    if not found:
        raise Unreadable(f"{str(given)[:60]!r} is not {what}")
    return found


def number(given):
    digits = r"[1-9]\d{0,%d}" % (MAX_DIGITS - 1)
    matched(rf"(0|-?{digits})(/{digits})?", given, "a number such as -7/3")
    return Fraction(given)


INTEGER = r"(?:0|-?[1-9]\d{0,38})"


def whole(digits, bits=128):
    """Return an integer that fits a number of bits, with a sign. A JSON number has 64 bits, and may be without a sign."""
    found = int(matched(INTEGER, digits, "an integer")[0])
    if not -(2 ** (bits - 1)) <= found < 2 ** (bits if bits == 64 else bits - 1):
        raise Unreadable(f"{digits} is not an integer of {bits} bits")
    return found


def literal(digits):
    """Return the value of a JSON number, which must be an integer."""
    return whole(digits, 64)


def integer(given):
    return given if type(given) is int else whole(given)


def sphere(given):
    i, j, k = map(integer, record(given, "i j k"))
    return k, i, j


def listed(given, keys, entry):
    """Return a list of records as a dictionary. Duplicate keys are an error."""
    held = {}
    if not isinstance(given, list):
        raise Unreadable("expected a list")
    for one in given:
        key, value = entry(*record(one, keys))
        if key in held:
            raise Unreadable(f"{key} occurs twice")
        held[key] = value
    return held


def signs_of(given):
    """Return the signs of the steps from the top.

    The input is a sequence of Hagg signs, or the lengths of the runs in parentheses. The first run has sign +, or - after
    a leading minus sign. The text A is a single layer.
    """
    if given == "A":
        return []
    run = r"[1-9]\d{0,8}"
    found = matched(rf"([+-]+)|(-?)\(({run}(?:,{run})*)\)", given, "a stacking such as +-+ or (100,3,100)")
    if found[1]:
        return [1 if sign == "+" else -1 for sign in found[1]]
    runs = [int(run) for run in found[3].split(",")]
    if sum(runs) > MAX_SPHERES:
        raise Unreadable("the pile is too large for this checker")
    first = -1 if found[2] else 1
    return [first * (-1) ** n for n, run in enumerate(runs) for _ in range(run)]


def region_of(given):
    """Return the sites of a region, which is given by bounds of i, j and i + j."""
    between, size = rf"{INTEGER}\.\.{INTEGER}", r"(?:0|[1-9]\d{0,38})"
    sides = rf"hexagon:{size}(,{size})?|(triangle):{size}"
    found = matched(rf"{sides}|region:{between},{between},{between}", given, "a region")
    bounds = [whole(bound) for bound in re.findall(r"-?\d+", given)]
    if found[2]:
        bounds = [bounds[0], 1]
    if len(bounds) < 6:
        bounds = [1 - bounds[-1], bounds[0] - 1] * 3
    x0, x1, y0, y1, s0, s1 = bounds
    if (x1 - x0 + 1) * (y1 - y0 + 1) > 4 * MAX_SPHERES:
        raise Unreadable("the pile is too large for this checker")
    return {(i, j) for i in range(x0, x1 + 1) for j in range(y0, y1 + 1) if s0 <= i + j <= s1}


# The pile


class Pile:
    """A pile: layers as sets of sites, signs of the steps between them, weights and loads."""

    def __init__(self, given):
        # The pile of a certificate has no horizontal forces; an empty list of them is allowed.
        if isinstance(given, dict):
            given = {"tilt": {"x": "0", "y": "0"}} | given
            if given.get("horizontal") == []:
                del given["horizontal"]
        dimension, sine, stacking, anchor, weightless, tilt, weights, loads = record(
            given, "dimension sin_phi stacking anchor weightless tilt weights loads"
        )
        if dimension not in (2, 3) or not isinstance(weightless, bool):
            raise Unreadable("dimension must be 2 or 3, and weightless true or false")
        self.signs = signs_of(stacking)
        self.directions = ["alpha", "beta", "gamma"][:dimension]
        sine = number(sine)
        if not isinstance(anchor, dict) or list(anchor) not in (["top"], ["base"]):
            raise Unreadable("the anchor must be a top or a base")
        ((side, region),) = anchor.items()
        straight = side == "top" and region_of(region) == {(0, 0)} and -1 not in self.signs
        if dimension == 2 and not (straight and sine == 0):
            raise Unreadable("discs need a straight pile under one disc, with sin_phi 0")
        if dimension == 3 and not (sine == Fraction(1, 2) or straight and 0 < sine < 1):
            raise Unreadable("sin_phi must be 1/2, or between 0 and 1 in a straight pile under one sphere")
        self.sine = sine
        self.layers = self.grown(side, region_of(region))
        self.floor = len(self.layers) - 1
        weight_at = lambda site, weight: (sphere(site), number(weight))
        self.own = listed(weights, "site weight", weight_at)
        if any(weight < 0 for weight in self.own.values()):
            raise Unreadable("a weight is negative")
        self.ordinary = 0 if weightless else 1
        if weightless:
            self.own = dict.fromkeys(self.own, 0)
        self.tilt = [number(part) for part in record(tilt, "x y")]
        self.loads = {}
        for one in loads if isinstance(loads, list) else [None]:
            one = {"x": "0", "y": "0"} | one if isinstance(one, dict) else one
            site, *load = record(one, "site weight x y")
            site, load = sphere(site), [number(part) for part in load]
            if load[0] < 0:
                raise Unreadable("a load is negative")
            self.loads[site] = [a + b for a, b in zip(self.loads.get(site, [0, 0, 0]), load)]
        if any(site not in self for site in [*self.own, *self.loads]):
            raise Unreadable("the site of a weight or load is not in the pile")
        if dimension == 2 and (self.tilt[1] or any(load[2] for load in self.loads.values())):
            raise Unreadable("a force on discs has a component along y")

    def grown(self, side, sites):
        """Return the layers: every support below a top, or all sites above a base whose supports exist."""
        layers, count = [sites], len(sites)
        for sign in self.signs if side == "top" else reversed(self.signs):
            steps = [(sign * x, sign * y) for x, y in (OFFSETS[l] for l in self.directions)]
            if side == "top":
                sites = {(i + x, j + y) for i, j in sites for x, y in steps}
            else:
                candidates = {(i - x, j - y) for i, j in sites for x, y in steps}
                sites = {(i, j) for i, j in candidates if all((i + x, j + y) in sites for x, y in steps)}
            layers.append(sites)
            count += len(sites)
            if count > MAX_SPHERES:
                raise Unreadable("the pile is too large for this checker")
        if not all(layers):
            raise Unreadable("a layer has no spheres")
        return layers if side == "top" else layers[::-1]

    def __contains__(self, site):
        k, i, j = site
        return 0 <= k <= self.floor and (i, j) in self.layers[k]

    def above_floor(self):
        """Yield the spheres above the floor, layer by layer from the top."""
        row_order = lambda site: site[::-1]
        return ((k, i, j) for k in range(self.floor) for i, j in sorted(self.layers[k], key=row_order))

    def force(self, site):
        """Return gravity and load on a sphere: downwards in mg, along x in mg tan(theta), along y in 2 cos(phi) mg tan(theta)."""
        weight = self.own.get(site, self.ordinary)
        gravity = [weight, weight * self.tilt[0], weight * self.tilt[1]]
        return [a + b for a, b in zip(gravity, self.loads.get(site, [0, 0, 0]))]

    def shares(self, site):
        """Return what gravity and load on a sphere add to its lines: they balance this force."""
        down, x, y = self.force(site)
        x, y = self.signs[site[0]] * x, self.signs[site[0]] * y
        if self.directions == ["alpha", "beta"]:
            return {"alpha": down - x, "beta": down + x}
        y *= 2 * (1 + self.sine)
        return {"alpha": down - x - y, "beta": down - x + y, "gamma": 2 * (self.sine * down + x)}

    def support(self, site, direction):
        (k, i, j), (x, y) = site, OFFSETS[direction]
        return k + 1, i + self.signs[k] * x, j + self.signs[k] * y

    def crossed(self, k, values):
        """Apply T of layer k: the half-turn 2/3 J - 1 if the sign changes there, otherwise the identity."""
        if 0 < k < self.floor and self.signs[k - 1] != self.signs[k]:
            twice = Fraction(2, 3) * sum(values.values())
            return {direction: twice - value for direction, value in values.items()}
        return values

    def neighbour(self, site, axis):
        """Return the other sphere of a horizontal contact: p + d_b - d_a."""
        (k, i, j), (a, b) = site, (OFFSETS[end] for end in AXES[axis])
        return k, i + b[0] - a[0], j + b[1] - a[1]

    def contacts(self, site):
        """Return the horizontal contacts that lead away from a sphere."""
        return [(site, axis) for axis in AXES if self.neighbour(site, axis) in self]


# The equations


class Certificate:
    def __init__(self, given):
        pile, claim, horizontal, field = record(given, "pile claim horizontal field")
        self.pile = Pile(pile)
        axis = lambda given: matched("|".join(AXES), given, "an axis")[0]
        push = lambda site, along, force: ((sphere(site), axis(along)), number(force))
        values = lambda site, *three: (sphere(site), dict(zip(OFFSETS, map(number, three))))
        self.horizontal = listed(horizontal, "site axis force", push)
        self.phi = listed(field, "site alpha beta gamma", values)
        self.kind, self.proved = self.read_claim(claim)

    def read_claim(self, given):
        """Return the kind of the claim, and a function that checks it."""
        kind, claimed = given, None
        if isinstance(given, dict) and len(given) == 1:
            ((kind, claimed),) = given.items()
        if kind in ("least", "greatest"):
            site, normal, attained = record(claimed, "site normal attained")
            if not isinstance(attained, bool):
                raise Unreadable("attained must be true or false")
            site, normal = sphere(site), number(normal)
            proved = lambda: self.extreme(kind, site, normal, attained)
        elif kind == "elastic":
            ratio = number(*record(claimed, "stiffness_ratio"))
            proved = lambda: self.elastic(ratio)
        elif kind == "forces":
            within, compressive, contacts, floor = record(claimed, "within compressive contacts floor")
            if not isinstance(compressive, bool):
                raise Unreadable("compressive must be true or false")
            numbers = lambda site, *values: (sphere(site), list(map(number, values)))
            contacts = listed(contacts, "site alpha beta gamma", numbers)
            floor = listed(floor, "site normal shear_x shear_y", numbers)
            within = number(within)
            proved = lambda: self.all_forces(within, compressive, contacts, floor)
        elif given in ("stands", "cannot-stand"):
            proved = self.forces if kind == "stands" else self.cannot_stand
        else:
            raise Unreadable("the claim is unknown")
        return kind, proved

    def check(self):
        self.well_posed(self.kind == "forces" and not self.horizontal)
        self.proved()

    def well_posed(self, has_only_forces):
        pile = self.pile
        regular = len(pile.directions) == 2 or pile.sine == Fraction(1, 2)
        need(regular or has_only_forces, f"sin phi = 1/2, not {pile.sine}")
        for (site, axis), force in self.horizontal.items():
            there = site in pile and site[0] < pile.floor and pile.neighbour(site, axis) in pile
            need(there, f"no horizontal contact {axis} at (k,i,j) = {site} above the floor")
            need(force >= 0, f"X = {force} >= 0 at (k,i,j) = {site}, {axis}")
        for site in self.phi:
            need(site in pile and site[0] < pile.floor, f"no sphere at (k,i,j) = {site} above the floor")

    def field(self, site):
        zero = dict.fromkeys(OFFSETS, 0)
        return {direction: self.phi.get(site, zero)[direction] for direction in self.pile.directions}

    def forces(self, may_pull=False):
        """Return the forces on each sphere from above. A sphere transmits T g + w - sign H, which must not be negative."""
        pile = self.pile
        received, pushed = {}, {}
        for (site, axis), force in self.horizontal.items():
            a, b = AXES[axis]
            for end, sign in ((site, 1), (pile.neighbour(site, axis), -1)):
                at = pushed.setdefault(end, dict.fromkeys(OFFSETS, 0))
                at[a] -= sign * force
                at[b] += sign * force
        self.transmitted = {}
        for site in pile.above_floor():
            g = received.setdefault(site, dict.fromkeys(pile.directions, 0))
            own = pile.shares(site)
            for direction, force in pile.crossed(site[0], g).items():
                force += own[direction]
                if site in pushed:
                    force -= pile.signs[site[0]] * pushed[site][direction]
                need(may_pull or force >= 0, f"f = {force} >= 0 at (k,i,j) = {site}, {direction}")
                self.transmitted[site, direction] = force
                support = received.setdefault(pile.support(site, direction), dict.fromkeys(pile.directions, 0))
                support[direction] = force
        return received

    def on_floor(self, site, received):
        """Return the force of a bottom sphere on the floor: down in mg, along x and y in the units of a load."""
        pile, sine = self.pile, self.pile.sine
        g = [received.get(direction, 0) for direction in OFFSETS]
        step = pile.signs[-1] if pile.signs else 1
        if len(pile.directions) == 2:
            along_x, along_y, weight = g[1] - g[0], 0, 2
        else:
            along_x, along_y, weight = g[2] - sine * (g[0] + g[1]), Fraction(g[1] - g[0]) / 2, 2 * (1 + sine)
        pushed = [sum(g) / weight, step * along_x / weight, step * along_y / weight]
        return [Fraction(a) + b for a, b in zip(pushed, pile.force(site))]

    def all_forces(self, within, compressive, contacts, floor):
        """Check that all given forces are close to the exact ones, and that none is missing."""
        pile = self.pile
        received = self.forces(may_pull=True)
        pushes_only = all(force >= 0 for force in self.transmitted.values())
        need(pushes_only == compressive, "compressive is right")
        need(set(contacts) == set(pile.above_floor()), "the spheres of the contacts are those above the floor")
        need({(i, j) for _, i, j in floor} == pile.layers[-1] and all(k == pile.floor for k, _, _ in floor),
             "the spheres of the forces on the floor are the bottom ones")
        for site, given in contacts.items():
            for direction, force in zip(OFFSETS, given):
                exact = self.transmitted.get((site, direction), 0)
                need(abs(force - exact) <= within, f"f = {exact}, not {force}, at (k,i,j) = {site}, {direction}")
        for site, given in floor.items():
            exact = self.on_floor(site, received.get(site, {}))
            need(all(abs(a - b) <= within for a, b in zip(given, exact)), f"{exact}, not {given}, on the floor at {site}")

    def drops(self):
        """Yield D of every sloping contact: phi of the upper sphere minus (T phi) of the lower one."""
        for site in self.pile.above_floor():
            for direction, value in self.field(site).items():
                support = self.pile.support(site, direction)
                below = self.pile.crossed(support[0], self.field(support))[direction]
                yield site, direction, support, value - below

    def compressions(self):
        """Yield c of every horizontal contact above the floor."""
        for site in self.pile.above_floor():
            for contact in self.pile.contacts(site):
                a, b = AXES[contact[1]]
                here, there = self.field(site), self.field(self.pile.neighbour(*contact))
                yield contact, self.pile.signs[site[0]] * (here[b] - here[a] - there[b] + there[a])

    def work(self):
        """Return the virtual work: the sum of w phi over spheres and directions."""
        pairs = ((self.pile.shares(site), self.field(site)) for site in self.phi)
        return sum(own[direction] * phi for own, field in pairs for direction, phi in field.items())

    def one_sided(self, side, needed):
        """Check the sign conditions: D at most (side 1) or at least (side -1) `needed`, and c likewise with zero."""
        relation = "<=" if side > 0 else ">="
        for site, direction, support, drop in self.drops():
            bound = needed(support)
            need(side * (bound - drop) >= 0, f"D = {drop} {relation} {bound} at (k,i,j) = {site}, {direction}")
        for (site, axis), compression in self.compressions():
            need(side * compression <= 0, f"c = {compression} {relation} 0 at (k,i,j) = {site}, {axis}")

    def cannot_stand(self):
        """Check a Farkas certificate: compressive f and X would contradict 0 >= sum f D + sum X c = sum w phi > 0."""
        self.one_sided(1, lambda support: 0)
        need(self.work() > 0, f"sum of w phi = {self.work()} > 0")

    def extreme(self, kind, site, claimed, attained):
        """Check a bound: by virtual work the load on the sphere is at least (at most) the sum of w phi."""
        pile = self.pile
        need(site in pile and site[0] == pile.floor, f"no sphere at (k,i,j) = {site} on the floor")
        self.one_sided(1 if kind == "least" else -1, lambda support: int(support == site))
        normal = lambda total: pile.force(site)[0] + Fraction(total) / len(pile.directions)
        proved = normal(self.work())
        need(proved == claimed, f"N = w + (sum of w phi)/{len(pile.directions)} = {proved}, not {claimed}")
        if attained:
            reached = normal(sum(self.forces().get(site, {}).values()))
            need(reached == claimed, f"N = {reached}, not {claimed}, is attained")

    def elastic(self, ratio):
        """Check the optimality conditions of least energy: D <= f and ratio c <= X, with equality where positive.

        The energy is convex, so these conditions suffice.
        """
        need(ratio > 0, f"stiffness ratio {ratio} > 0")
        self.forces()
        for site, direction, _, drop in self.drops():
            force = self.transmitted[site, direction]
            holds = drop == force if force > 0 else drop <= 0
            need(holds, f"D = {drop} to f = {force} at (k,i,j) = {site}, {direction}")
        for (site, axis), compression in self.compressions():
            force = self.horizontal.get((site, axis), 0)
            holds = ratio * compression == force if force > 0 else compression <= 0
            need(holds, f"stiffness ratio c = {ratio * compression} to X = {force} at (k,i,j) = {site}, {axis}")


def unique_keys(pairs):
    """Return a JSON object as a dictionary. Duplicate keys are an error."""
    if len(dict(pairs)) < len(pairs):
        raise Unreadable("a key occurs twice")
    return dict(pairs)


def verdict(file, name="-"):
    """Check a file with one certificate or an array of them. Return the exit status and the line to print."""
    try:
        text = file.read()
        if not text.isascii() or "\\" in text:
            raise Unreadable("a certificate is ASCII, without backslashes")
        given = json.loads(text, object_pairs_hook=unique_keys, parse_int=literal, parse_float=literal, parse_constant=literal)
        if given == []:
            raise Unreadable("the array of certificates is empty")
        for certificate in [Certificate(one) for one in (given if isinstance(given, list) else [given])]:
            certificate.check()
    except Refused as refusal:
        return 1, f"refused: {refusal}"
    except (Unreadable, OSError, ValueError, RecursionError) as error:
        return 2, f"error: {name}: {error}"
    return 0, "accepted"


def main(arguments):
    # Newer Python versions limit integers to 4300 digits; certificates can have 5000.
    getattr(sys, "set_int_max_str_digits", lambda _: None)(0)
    if len(arguments) != 1:
        print("usage: check_certificate.py FILE, or - for stdin", file=sys.stderr)
        return 2
    (name,) = arguments
    try:
        with sys.stdin if name == "-" else open(name, encoding="utf-8") as file:
            status, message = verdict(file, name)
    except OSError as error:
        status, message = 2, f"error: {name}: {error}"
    print(message, file=sys.stderr if status == 2 else sys.stdout)
    return status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""A rigid code against the bounds of bottom spheres: Siconos solves the contact problem of nonsmooth dynamics.

Usage: rigid.py FOLDER BOUNDS, the folder that `cannonpile export --to csv --spacing 1` has written and the csv file of
`cannonpile bounds`; rigid.py FOLDER, for a pile that cannot stand.

Rigid spheres without friction that touch accelerate by a, with a = H^T f + g for unit masses, 0 <= f, 0 <= H a,
f (H a) = 0: a linear complementarity problem w = H H^T f + H g. It always has a solution, and a is unique: zero just if
the pile stands. Where horizontal contacts are, f is not: which forces are found depends on where the solver begins. Each
must lie within the bounds. H H^T is singular, and pivots of Lemke's method fail on it; projected Gauss-Seidel, the
method of contact dynamics, and a Newton method do not.
"""

import math
import sys

import numpy
import siconos.numerics as siconos

from touching import bounds, pairs, spheres

# Of forces and accelerations, in mg.
TOLERANCE = 1e-9
STARTS = 30


def problem(piled):
    """H by contact and free sphere, in three columns each, the weights, and the contacts."""
    touching = pairs(piled)
    free = [number for number, sphere in enumerate(piled) if not sphere.fixed]
    column = {number: 3 * place for place, number in enumerate(free)}
    normals = numpy.zeros((len(touching), 3 * len(free)))
    for row, (one, other) in enumerate(touching):
        normal = (numpy.array(piled[one].place) - numpy.array(piled[other].place)) / 2
        for end, sign in ((one, 1), (other, -1)):
            if end in column:
                normals[row, column[end] : column[end] + 3] = sign * normal
    gravity = numpy.zeros(3 * len(free))
    gravity[2::3] = [-float(piled[number].weight) for number in free]
    return normals, gravity, touching


def solved(name, matrix, offset, start, order, scale):
    """Forces by a solver of Siconos, of contacts in another order and in other units; None if it finds none."""
    solver, number, turns = {
        "Gauss-Seidel": (siconos.lcp_pgs, siconos.SICONOS_LCP_PGS, 200_000),
        "Newton": (siconos.lcp_newton_FB, siconos.SICONOS_LCP_NEWTON_FB_FBLSA, 1_000),
    }[name]
    options = siconos.SolverOptions(number)
    options.iparam[siconos.SICONOS_IPARAM_MAX_ITER] = turns
    options.dparam[siconos.SICONOS_DPARAM_TOL] = 1e-13
    in_order = numpy.ix_(order, order)
    lcp = siconos.LCP((scale[:, None] * matrix * scale)[in_order], (scale * offset)[order])
    unknown, gaps = (start / scale)[order], numpy.zeros(len(order))
    solver(lcp, unknown, gaps, options)
    forces = numpy.zeros(len(order))
    forces[order] = unknown
    forces *= scale
    gaps = matrix @ forces + offset
    allowed = TOLERANCE * max(1, abs(forces).max())
    holds = min(forces.min(), gaps.min()) > -allowed and abs(forces * gaps).max() < allowed
    return forces if holds else None


def solutions(matrix, offset):
    """Forces from many starts: at rest, and pushed at random, a few contacts much harder than others."""
    size = len(offset)
    chance = numpy.random.default_rng(1998)
    yield solved("Newton", matrix, offset, numpy.zeros(size), numpy.arange(size), numpy.ones(size))
    for start in range(STARTS):
        pushed = chance.uniform(0, 3, size) * (chance.uniform(0, 1, size) < start / STARTS)
        order, scale = chance.permutation(size), chance.uniform(0.3, 1.7, size)
        name = "Newton" if start % 10 == 5 else "Gauss-Seidel"
        yield solved(name, matrix, offset, pushed, order, scale)


def require(condition, message):
    if not condition:
        sys.exit(f"FAILED: {message}")


def main(folder, file=None):
    piled = spheres(folder)
    normals, gravity, touching = problem(piled)
    found = [forces for forces in solutions(normals @ normals.T, normals @ gravity) if forces is not None]
    require(len(found) > STARTS / 2, f"Siconos finds forces from {len(found)} of {STARTS + 1} starts only")
    left = [abs(normals.T @ forces + gravity) for forces in found]
    fastest = [accelerations.max() for accelerations in left]
    if file is None:
        require(min(fastest) > 1e-3, f"nothing moves: the greatest acceleration is {min(fastest)} g")
        print(f"{len(piled)} spheres move, by {min(fastest):.6f} to {max(fastest):.6f} g at most, from {len(found)} starts")
        return
    require(max(fastest) < 100 * TOLERANCE, f"something moves, by {max(fastest)} g")
    claimed = bounds(file)
    # What is left of accelerations is weight that the forces do not bear, or bear beside the spheres': by virtual work it moves
    # a normal force by as much, times displacements of a few diameters at most.
    moved = [10 * accelerations.sum() for accelerations in left]
    require(max(moved) < 10_000 * TOLERANCE, f"accelerations may move a normal force by {max(moved)} mg")
    used = []
    for number, sphere in enumerate(piled):
        if not sphere.fixed:
            continue
        bearing = [(row, one) for row, pair in enumerate(touching) if number in pair for one in pair if one != number]
        rise = [(row, (piled[one].place[2] - sphere.place[2]) / 2) for row, one in bearing]
        normal = [float(sphere.weight) + sum(forces[row] * up for row, up in rise) for forces in found]
        least, greatest, _ = claimed[sphere.site]
        for one, by in zip(normal, moved):
            slack = TOLERANCE * float(greatest) + by
            inside = least - slack <= one <= greatest + slack
            require(inside, f"{sphere.site} bears {one}, not within {least} to {greatest}, to within {slack}")
        if least < greatest:
            used.append((max(normal) - min(normal)) / float(greatest - least))
    mean = math.fsum(used) / max(1, len(used))
    # What always bears the same proves little.
    require(not used or mean > 0.1, "the states are hardly different")
    print(
        f"{len(claimed)} normal forces lie within their bounds, in {len(found)} states of {len(piled)} spheres that take up "
        f"{mean:.0%} of what the bounds leave; what is left of accelerations moves a force by {max(moved):.0e} mg at most"
    )


main(*sys.argv[1:])

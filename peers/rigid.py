"""Compares forces of rigid spheres, computed by Siconos (nonsmooth contact dynamics), with the bounds of base normal forces.

Usage: rigid.py FOLDER BOUNDS, with the folder of `cannonpile export --to csv --spacing 1` and the csv file of
`cannonpile bounds`; rigid.py FOLDER, for an unstable pile.

The accelerations a of frictionless rigid spheres with unit masses satisfy a = H^T f + g, 0 <= f, 0 <= H a, f (H a) = 0. This is
the linear complementarity problem w = H H^T f + H g. It always has a solution, and a is unique. It is zero if and only if the
pile is stable. With horizontal contacts f is not unique, and depends on the start of the solver. Every f must be within the
bounds. H H^T is singular, so Lemke's pivoting method fails. Projected Gauss-Seidel, the method of contact dynamics, and a
Newton method succeed.
"""

import math
import sys

import numpy
import siconos.numerics as siconos

from touching import bounds, pairs, spheres

# The tolerance of forces and accelerations, in mg.
TOLERANCE = 1e-9
STARTS = 30


def problem(all_spheres):
    """Returns H, with a row for each contact and three columns for each free sphere, the weights, and the contacts."""
    touching = pairs(all_spheres)
    free = [number for number, sphere in enumerate(all_spheres) if not sphere.fixed]
    column = {number: 3 * place for place, number in enumerate(free)}
    normals = numpy.zeros((len(touching), 3 * len(free)))
    for row, (one, other) in enumerate(touching):
        normal = (numpy.array(all_spheres[one].place) - numpy.array(all_spheres[other].place)) / 2
        for end, sign in ((one, 1), (other, -1)):
            if end in column:
                normals[row, column[end] : column[end] + 3] = sign * normal
    gravity = numpy.zeros(3 * len(free))
    gravity[2::3] = [-float(all_spheres[number].weight) for number in free]
    return normals, gravity, touching


def solved(name, matrix, offset, start, order, scale):
    """Returns the forces of a solver of Siconos, with contacts in another order and other units, or None if it fails."""
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
    """Returns the forces from many starts: zero, and random ones with a few much larger forces."""
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
    all_spheres = spheres(folder)
    normals, gravity, touching = problem(all_spheres)
    found = [forces for forces in solutions(normals @ normals.T, normals @ gravity) if forces is not None]
    require(len(found) > STARTS / 2, f"Siconos finds forces from {len(found)} of {STARTS + 1} starts only")
    left = [abs(normals.T @ forces + gravity) for forces in found]
    fastest = [accelerations.max() for accelerations in left]
    if file is None:
        require(min(fastest) > 1e-3, f"nothing moves: the greatest acceleration is {min(fastest)} g")
        print(f"{len(all_spheres)} spheres move, by {min(fastest):.6f} to {max(fastest):.6f} g at most, from {len(found)} starts")
        return
    require(max(fastest) < 100 * TOLERANCE, f"something moves, by {max(fastest)} g")
    claimed = bounds(file)
    # Residual accelerations are an error of the loads. By virtual work they change a normal force by at most their size times a
    # displacement of a few diameters.
    moved = [10 * accelerations.sum() for accelerations in left]
    require(max(moved) < 10_000 * TOLERANCE, f"accelerations may move a normal force by {max(moved)} mg")
    used = []
    for number, sphere in enumerate(all_spheres):
        if not sphere.fixed:
            continue
        bearing = [(row, one) for row, pair in enumerate(touching) if number in pair for one in pair if one != number]
        rise = [(row, (all_spheres[one].place[2] - sphere.place[2]) / 2) for row, one in bearing]
        normal = [float(sphere.weight) + sum(forces[row] * up for row, up in rise) for forces in found]
        least, greatest, _ = claimed[sphere.site]
        for one, by in zip(normal, moved):
            slack = TOLERANCE * float(greatest) + by
            inside = least - slack <= one <= greatest + slack
            require(inside, f"the normal force {one} of {sphere.site} is not within {least} to {greatest}, with tolerance {slack}")
        if least < greatest:
            used.append((max(normal) - min(normal)) / float(greatest - least))
    mean = math.fsum(used) / max(1, len(used))
    # If all starts give nearly the same forces, the comparison tests little.
    require(not used or mean > 0.1, "the states are nearly equal")
    print(
        f"{len(claimed)} normal forces lie within their bounds, in {len(found)} states of {len(all_spheres)} spheres; on average they use "
        f"{mean:.0%} of the range; residual accelerations change a force by at most {max(moved):.0e} mg"
    )


main(*sys.argv[1:])

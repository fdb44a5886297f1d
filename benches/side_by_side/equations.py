"""The equations of equilibrium of a pile, in integers."""

import numpy as np

# Offsets of horizontal neighbours, along i and j.
STEPS = [(1, 0), (0, 1), (1, -1)]


def places(pile):
    """Returns the integer coordinates of all spheres, in thirds of both lattice vectors and in layers, and their layers."""
    signs = [1 if k % 2 == 0 or pile.stacking == "fcc" else -1 for k in range(pile.layers)]
    back = np.concatenate([[0], np.cumsum(signs)])
    k, i, j = pile.sites().T
    return np.stack([3 * i - back[k], 3 * j - back[k], k], axis=1), k


def equations(pile, contacts):
    """Returns the equations of equilibrium: rows, columns, entries and right-hand sides. Forces are in mg/3 vertically."""
    at, k = places(pile)
    upper, lower = contacts
    free = np.cumsum(k < pile.layers - 1) - 1
    number = np.arange(len(upper))
    rows, columns, entries = [], [], []
    for end, by, moving in ((upper, lower, None), (lower, upper, k[lower] < pile.layers - 1)):
        kept = slice(None) if moving is None else moving
        apart = at[by[kept]] - at[end[kept]]
        for axis in range(3):
            rows.append(3 * free[end[kept]] + axis)
            columns.append(number[kept])
            entries.append(apart[:, axis])
    totals = np.zeros(3 * (free[-1] + 1), dtype=np.int64)
    totals[2::3] = 3
    return np.concatenate(rows), np.concatenate(columns), np.concatenate(entries), totals


def sloping(pile):
    """Returns the numbers of the upper and the lower spheres of all contacts between layers."""
    return (pile.contact_ids() - 1).T


def touching(pile):
    """Returns all contacts at a = R: the sloping ones, and those of neighbours above the floor."""
    upper, lower = sloping(pile)
    sites = {tuple(site): number for number, site in enumerate(pile.sites().tolist())}
    beside = [
        (number, sites.get((k, i + di, j + dj)))
        for (k, i, j), number in sites.items()
        for di, dj in STEPS
        if k < pile.layers - 1
    ]
    one, other = np.array([pair for pair in beside if pair[1] is not None]).reshape(-1, 2).T
    return np.concatenate([upper, one]), np.concatenate([lower, other])

"""All immersed disks that a curve bounds: the triangulations whose diagonals are all locally Delaunay, one for each.

Legend: a *pair* and its *splits* as in `.splits`.
"""

import numpy as np
from numba import njit

from tween.geometry.predicates import in_circumcircle, turn


@njit(cache=True)
def _delaunay_sign(points, a, b, c, d):
    """`incircle` of a, b, c, d with ties broken as if vertices of small number lay a little higher on the paraboloid.

    The determinant is a sum of lifted heights, each times the orientation of the three other points
    with alternating signs; where it vanishes the highest vertex decides.
    """
    sign = in_circumcircle(points, a, b, c, d)
    if sign != 0:
        return sign
    first = min(a, b, c, d)  # its lift is infinitely much larger than the next one's, so its sign alone counts
    if first == a:
        return turn(points, b, c, d)
    if first == b:
        return -turn(points, a, c, d)
    if first == c:
        return turn(points, a, b, d)
    return -turn(points, a, b, c)


@njit(cache=True)
def delaunay_splits(points, ends, first, apex, left, right):
    """For every split, how many all-Delaunay triangulations of its pair begin with it."""
    counts = np.zeros(apex.size, np.int64)
    for pair in range(first.size - 1):
        i, j = ends[pair]
        for s in range(first[pair], first[pair + 1]):
            counts[s] = _beyond(points, ends, first, apex, counts, left[s], j)
            # what is left of the apex and what is right of it can be chosen independently
            if counts[s] > 0:
                counts[s] *= _beyond(points, ends, first, apex, counts, right[s], i)
    return counts


@njit(cache=True)
def _beyond(points, ends, first, apex, counts, pair, opposite):
    """How many all-Delaunay triangulations of a pair agree with the vertex opposite across it."""
    if first[pair] == first[pair + 1]:  # an edge of the curve has nothing beyond it
        return 1
    i, j = ends[pair]
    total = 0
    for s in range(first[pair], first[pair + 1]):
        # i, apex, j is counter-clockwise: positive would be inside its circle
        if counts[s] > 0 and _delaunay_sign(points, i, apex[s], j, opposite) <= 0:
            total += counts[s]
    return total


@njit(cache=True)
def delaunay_triangles(points, ends, first, apex, left, right, counts, whole, number):
    """The all-Delaunay triangulation of a given number, from 0."""
    n = points.shape[0]
    triangles = np.empty((n - 2, 3), np.int64)
    pairs, opposites, ranks = np.empty(2 * n, np.int64), np.empty(2 * n, np.int64), np.empty(2 * n, np.int64)
    pairs[0], opposites[0], ranks[0] = whole, -1, number  # nothing lies beyond the whole curve
    size, t = 1, 0
    while size > 0:
        size -= 1
        pair, opposite, rank = pairs[size], opposites[size], ranks[size]
        if first[pair] == first[pair + 1]:
            continue
        i, j = ends[pair]
        s = first[pair]
        while True:  # a rank is below the number of choices, so one of the splits takes it
            if counts[s] > 0 and (opposite < 0 or _delaunay_sign(points, i, apex[s], j, opposite) <= 0):
                if rank < counts[s]:
                    break
                rank -= counts[s]
            s += 1
        triangles[t, 0], triangles[t, 1], triangles[t, 2] = i, apex[s], j
        t += 1
        ways = _beyond(points, ends, first, apex, counts, left[s], j)
        # a number of two digits: the remainder chooses on the left, the quotient on the right
        pairs[size], opposites[size], ranks[size] = right[s], i, rank // ways
        pairs[size + 1], opposites[size + 1], ranks[size + 1] = left[s], j, rank % ways
        size += 2
    return triangles

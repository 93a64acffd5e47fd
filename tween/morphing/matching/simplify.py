r"""Simplifying an immersed disk vertex by vertex: the coarse levels on which two curves are matched first.

A vertex v with neighbours a and b may go where the curve without it still bounds an immersed disk:

    left turn    the chord from a to b lies straight in the disk: the ear a v b is cut off
    right turn   the triangle a b v, outside, is glued on, and v would become a point inside the disk; the
                 angles at a and b must stay below 2 pi
    straight on  always

Either way the triangles around v make place for new ones in the polygon of its neighbours, which is star-shaped as
seen from v.  So the triangulation always tells which immersed disk is meant, and no table is needed.

                 x1
               /    \          a b x1 x2: the link of v, counter-clockwise from b, its successor on the
      a = x2 -- v -- b         curve, to a, its predecessor

Legend: ``v a b x`` vertices; ``h g`` half-edges ``3 t + s``, twin -1 on the curve; ``out[v]`` the half-edge from v to
its successor.

References
----------
M. Visvalingam and J. D. Whyatt, *Line generalisation by repeated elimination of points*, The Cartographic Journal 30
(1993) 46-51: the vertex of the smallest triangle goes first.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.predicates import turn
from tween.geometry.triangulation import Triangulation
from tween.morphing.matching.chords import boundary
from tween.morphing.matching.flatness import least_flat, side_of

MANY = 400  # vertices from which on a curve counts as finely sampled
_SPACING = 1e-3  # what squares of distances to neighbours count beside areas, on finely sampled curves
_TURNS = 2.0**30  # parts of a turn, more or less, to which nearly straight vertices are compared
_Floats = NDArray[np.float64]


class Level(NamedTuple):
    """A disk with some of its vertices left out.

    Attributes
    ----------
    kept : ndarray of int, shape (m,)
        The vertices that are left, ascending.
    triangles : ndarray of int, shape (m-2, 3)
        In the numbers of `kept`, counter-clockwise.
    """

    kept: NDArray[np.int64]
    triangles: NDArray[np.int64]


def simplify(T: Triangulation, sizes: list[int], fixed: NDArray[np.bool_], sharpness: float = 0.0) -> list[Level]:
    """Leave out vertices, those of smallest triangle first, and return the disk at some sizes on the way.

    Parameters
    ----------
    T : Triangulation
    sizes : list of int
        Numbers of vertices, descending.
    fixed : ndarray of bool, shape (n,)
        Vertices that must stay.
    sharpness : float
        What a turn by 180 degrees adds to the area of a vertex's triangle, as a share of the disk's area: keeps the
        small sharp corners around which much of a disk turns.

    Returns
    -------
    list of Level
        One for each size; where no vertex can go any more, what is left.

    Notes
    -----
    Areas that agree to about seven digits count as equal, and then the vertex of smallest number goes first.  Of more
    than 400 vertices, those near to their neighbours go first where areas are nearly the same, so that straight parts
    are thinned out evenly.  O(n**2), of which each step is one comparison: a tenth of a second for 10,000 vertices.

    Examples
    --------
    >>> square = Triangulation([[0, 0], [1, 0], [2, 0], [2, 2], [0, 2]], [[0, 1, 4], [1, 2, 3], [1, 3, 4]])
    >>> [level.kept.tolist() for level in simplify(square, [5, 4], np.zeros(5, dtype=bool))]
    [[0, 1, 2, 3, 4], [0, 2, 3, 4]]
    """
    triangles, twin = T.triangles.copy(), T.twin.ravel().copy()
    wanted = np.array(sizes, dtype=np.int64)
    unit = 2.0 ** -np.frexp(np.ptp(T.points, axis=0).max())[1]  # single precision has no room for areas of any size
    weights = (2.0 * sharpness * float(T.areas.sum()) * unit * unit, _SPACING if len(T) > MANY else 0.0)
    kept, lists, counts = _simplify(T.points * unit, triangles, twin, fixed, wanted, (*weights, least_flat(T)))
    levels = []
    for vertices, rows, count in zip(kept, lists, counts, strict=True):
        levels.append(Level(np.flatnonzero(vertices), np.cumsum(vertices)[rows[: count - 2]] - 1))
    return levels


@njit(cache=True)
def _simplify(points, triangles, twin, fixed, sizes, weights):
    n = len(points)
    out = boundary(triangles, twin)
    before, after = (np.arange(n) - 1) % n, (np.arange(n) + 1) % n
    alive, gone = np.ones(n, np.bool_), np.zeros(len(triangles), np.bool_)
    kept, lists = np.zeros((len(sizes), n), np.bool_), np.zeros((len(sizes), n, 3), np.int64)
    counts, left = np.zeros(len(sizes), np.int64), n
    importance = np.empty(n)  # infinite where a vertex stays, or cannot go as long as nothing changes around it
    for v in range(n):
        importance[v] = np.inf if fixed[v] else _importance(points, before[v], v, after[v], weights)
    link, around, past = np.empty(n + 2, np.int64), np.empty(n, np.int64), np.empty(n, np.int64)
    for row in range(len(sizes)):
        while left > max(3, sizes[row]):
            v = _least(importance)
            if importance[v] == np.inf:
                break
            importance[v] = np.inf
            size = _star(triangles, twin, out[v], link, around, past)
            if not _may_go(points, before, after, v, link, size, weights[2]):
                continue
            gone[around[size - 2]] = True
            a, b = before[v], after[v]
            alive[v], before[b], after[a], left = False, a, b, left - 1
            _fill(points, triangles, twin, out, size, link, around, past)
            link[size], link[size + 1] = before[a], after[b]
            for i in range(size + 2):
                x = link[i]
                if not fixed[x]:
                    importance[x] = _importance(points, before[x], x, after[x], weights)
        _record(triangles, gone, alive, kept[row], lists[row])
        counts[row] = left
    return kept, lists, counts


@njit(cache=True, inline="always")
def _least(values):
    """Where the first of the smallest values is."""
    best = 0
    for v in range(1, len(values)):
        if values[v] < values[best]:
            best = v
    return best


@njit(cache=True, inline="always")
def _record(triangles, gone, alive, kept, rows):
    """Write down what is left."""
    kept[:], size = alive, 0
    for t in range(len(gone)):
        if not gone[t]:
            rows[size, 0], rows[size, 1], rows[size, 2] = triangles[t, 0], triangles[t, 1], triangles[t, 2]
            size += 1


@njit(cache=True, inline="always")
def _importance(points, a, v, b, weights):
    """Twice the area of a, v, b, and something for the turn at v; in single precision, so that equal triangles tie."""
    sharpness, spacing, _ = weights
    ux, uy = points[v, 0] - points[a, 0], points[v, 1] - points[a, 1]
    wx, wy = points[b, 0] - points[v, 0], points[b, 1] - points[v, 1]
    cross, size = ux * wy - uy * wx, (ux + wx) ** 2 + (uy + wy) ** 2
    apart = spacing * (ux * ux + uy * uy + wx * wx + wy * wy) if spacing > 0.0 else 0.0
    if abs(cross) <= 1e-12 * size:
        return np.float64(np.float32(apart))
    turned = np.arctan2(cross, ux * wx + uy * wy) / np.pi
    cross = np.round(cross / size * _TURNS) / _TURNS * size
    return np.float64(np.float32(abs(cross) + sharpness * turned * turned + apart))


@njit(cache=True, inline="always")
def _star(triangles, twin, h, link, around, past):
    """Walk around a vertex: its link from b to a, its triangles, and what lies across the link's edges."""
    size = 0
    while True:
        t, s = h // 3, h % 3
        link[size], around[size], past[size] = triangles[t, (s + 1) % 3], t, twin[3 * t + (s + 1) % 3]
        size += 1
        h = twin[3 * t + (s + 2) % 3]
        if h < 0:
            link[size] = triangles[t, (s + 2) % 3]
            return size + 1


@njit(cache=True)
def _may_go(points, before, after, v, link, size, flat):
    """Whether the curve without v still bounds an immersed disk, see the module."""
    a, b = link[size - 1], link[0]
    side = turn(points, a, v, b)
    if side > 0:
        for i in range(1, size - 1):
            if side_of(points[a], points[b], points[link[i]], flat) <= 0:
                return False
        return True
    if side == 0:
        return size > 2
    p, q = before[a], after[b]
    return not (_in_corner(points, a, b, p, v, flat) or _in_corner(points, b, v, q, a, flat))


@njit(cache=True)
def _in_corner(points, o, x, p, y, flat):
    """Whether p, seen from o, lies between x and y, or so near that a turn decides; y is left of x."""
    apex, place = points[o], points[p]
    if side_of(apex, points[x], place, flat) < 0 or side_of(apex, place, points[y], flat) < 0:
        return False
    # what lies between is at most a right angle from one of them; behind o it is nearly half a turn from both
    px, py = place[0] - apex[0], place[1] - apex[1]
    for z in (x, y):
        zx, zy = points[z, 0] - apex[0], points[z, 1] - apex[1]
        ahead = px * zx + py * zy
        if ahead > 0.0 or ahead * ahead < 0.25 * (px * px + py * py) * (zx * zx + zy * zy):
            return True
    return False


@njit(cache=True)
def _fill(points, triangles, twin, out, size, link, around, past):
    """Triangulate the polygon of a link, whose edge from a to b is now on the curve."""
    polygon, beyond, used = np.empty(size, np.int64), np.empty(size, np.int64), 0
    for i in range(size):
        polygon[i], beyond[i] = link[i], past[min(i, size - 2)]
    while size > 2:
        i = _ear(points, polygon, size)
        t = around[used]
        used += 1
        triangles[t, 0], triangles[t, 1], triangles[t, 2] = polygon[i - 1], polygon[i], polygon[i + 1]
        _join(triangles, twin, out, 3 * t, beyond[i - 1])
        _join(triangles, twin, out, 3 * t + 1, beyond[i])
        beyond[i - 1] = 3 * t + 2
        for m in range(i, size - 1):
            polygon[m], beyond[m] = polygon[m + 1], beyond[min(m + 1, size - 2)]
        size -= 1
    _join(triangles, twin, out, beyond[0], -1)


@njit(cache=True, inline="always")
def _join(triangles, twin, out, h, g):
    """Make half-edges twins; one of them is -1 where the other lies on the curve."""
    if h >= 0:
        twin[h] = g
    if g >= 0:
        twin[g] = h
    if h < 0 or g < 0:
        edge = max(h, g)
        out[triangles[edge // 3, edge % 3]] = edge


@njit(cache=True, inline="always")
def _ear(points, polygon, size):
    """A tip whose triangle holds no other vertex; of those, the one with the shortest side across."""
    best, shortest = -1, np.inf
    for i in range(1, size - 1):
        x, z = points[polygon[i - 1]], points[polygon[i + 1]]
        across = (x[0] - z[0]) ** 2 + (x[1] - z[1]) ** 2
        if across < shortest and _is_ear(points, polygon, size, i):
            best, shortest = i, across
    return best


@njit(cache=True, inline="always")
def _is_ear(points, polygon, size, i):
    x, y, z = polygon[i - 1], polygon[i], polygon[i + 1]
    if turn(points, x, y, z) <= 0:
        return False
    for m in range(size):
        w = polygon[m]
        if abs(m - i) > 1 and turn(points, x, y, w) >= 0 and turn(points, y, z, w) >= 0 and turn(points, z, x, w) >= 0:
            return False
    return True

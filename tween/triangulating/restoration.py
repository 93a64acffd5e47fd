"""Putting the vertices that a reduction removed back into triangulations.

In reverse order an ear is glued on again; a dent is cut out of the triangulation: the triangles that meet a b v form a
chain from the edge ab to v, and the two polygons beside the dent are triangulated anew, by Delaunay triangles.

Legend: ``a v b`` neighbours on the curve; ``t s`` triangle and slot, ``h = 3 t + s`` half-edge; ``p q z`` left and
right end of the edge by which the chain enters a triangle, and the triangle's third vertex.

References
----------
Anglada, *An improved incremental algorithm for constructing restricted Delaunay triangulations* (1997): the
polygons beside an edge.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.predicates import in_circumcircle, turn
from tween.triangulating.flips import flip_in_place, not_delaunay
from tween.triangulating.reduction import Reduction


def restore(points: NDArray[np.float64], reduction: Reduction, triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """Put the removed vertices back into a triangulation of the reduced curve.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
        All vertices.
    reduction : Reduction
    triangles : ndarray of int, shape (m-2, 3)
        Counter-clockwise; vertices are numbered along the reduced curve.

    Returns
    -------
    ndarray of int, shape (n-2, 3)
        A triangulation of the corresponding immersed disk of the whole curve, rows i < k < j in the order of the
        table: a triangle before those beyond its edges (i, k) and (k, j), so that neighbours are near each other.

    Notes
    -----
    O(1) a vertex as a rule, in proportion to the triangles that a dent meets.
    """
    kept, removed, dents = reduction
    whole = np.empty((len(points) - 2, 3), dtype=np.int64)
    whole[: len(triangles)] = kept[triangles]
    restored = np.sort(_restore(points, whole, len(triangles), kept, removed, dents), axis=1)
    return restored[np.lexsort((-restored[:, 2], restored[:, 0]))]


@njit(cache=True)
def _restore(points, triangles, size, kept, removed, dents):
    n = len(points)
    twin = np.full(3 * len(triangles), -1, np.int64)
    edge = np.full(n, -1, np.int64)  # the half-edge from each vertex along the curve
    _link(triangles, twin, edge, size, kept)
    work = np.empty((8, 3 * n), np.int64)
    sides = twin.reshape(-1, 3)
    for h in range(3 * size):
        _legalise(points, triangles, sides, edge, h)
    for i in range(len(removed) - 1, -1, -1):
        a, v, b = removed[i]
        if dents[i]:
            changed = _cut_dent(points, triangles, twin, edge, size, a, v, b, work)
            for t in work[0, :changed].copy():
                for s in range(3):
                    _legalise(points, triangles, sides, edge, 3 * t + s)
        else:
            _glue_ear(triangles, twin, edge, size, a, v, b)
            _legalise(points, triangles, sides, edge, 3 * size + 2)
        size += 1
    return triangles


@njit(cache=True)
def _legalise(points, triangles, twin, edge, h):
    """Flip the diagonal h if it is not locally Delaunay, and then those around it."""
    stack = [h]
    while len(stack) > 0:
        h = stack.pop()
        g = twin[h // 3, h % 3]
        if g < 0 or not not_delaunay(points, triangles, twin, h):
            continue
        flip_in_place(triangles, twin, h)
        for t in (h // 3, g // 3):
            for s in range(3):
                if twin[t, s] < 0:
                    edge[triangles[t, s]] = 3 * t + s
                else:
                    stack.append(3 * t + s)


@njit(cache=True)
def _link(triangles, twin, edge, size, kept):
    """Find the twins of the first triangles: at every vertex by the triangles around it."""
    follow = np.full(len(edge), -1, np.int64)
    for i in range(len(kept)):
        follow[kept[i]] = kept[(i + 1) % len(kept)]
    degree = np.zeros(len(edge) + 1, np.int64)
    for t in range(size):
        for s in range(3):
            degree[triangles[t, s] + 1] += 1
    start = np.cumsum(degree)
    fill, out = start[:-1].copy(), np.empty(3 * size, np.int64)
    for h in range(3 * size):
        v = triangles[h // 3, h % 3]
        out[fill[v]] = h
        fill[v] += 1
    for h in range(3 * size):
        v, w = triangles[h // 3, h % 3], triangles[h // 3, (h + 1) % 3]
        if follow[v] == w:
            edge[v] = h
            continue
        for g in out[start[w] : start[w + 1]]:
            if triangles[g // 3, (g + 1) % 3] == v:
                twin[h] = g


@njit(cache=True)
def _join(twin, edge, triangles, h, g):
    """Make half-edges twins; g is -1 where h lies on the curve."""
    twin[h] = g
    if g >= 0:
        twin[g] = h
    else:
        edge[triangles[h // 3, h % 3]] = h


@njit(cache=True)
def _glue_ear(triangles, twin, edge, size, a, v, b):
    old, h = edge[a], 3 * size
    triangles[size, 0], triangles[size, 1], triangles[size, 2] = a, v, b
    _join(twin, edge, triangles, h, -1)
    _join(twin, edge, triangles, h + 1, -1)
    _join(twin, edge, triangles, h + 2, old)


@njit(cache=True)
def _write(triangles, t, a, b, c):
    triangles[t, 0], triangles[t, 1], triangles[t, 2] = a, b, c


@njit(cache=True)
def _cut_dent(points, triangles, twin, edge, size, a, v, b, work):
    """Cut the triangle a b v out: walk from ab to v, and fill what remains of the triangles met.

    Returns the number of triangles written, which are the first ones in ``chain``.  In ``left`` and ``right`` are
    the vertices beside the chain, from a and from b on; in ``past_left`` and ``past_right`` the half-edges outside,
    across the edges between them.
    """
    chain, left, past_left, right, past_right, polygon, past = work[:7]
    h, met, lefts, rights = edge[a], 0, 1, 1
    left[0], right[0] = a, b
    while True:
        t, s = h // 3, h % 3
        chain[met] = t
        met += 1
        p, q, z = triangles[t, s], triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3]
        across_right, across_left = twin[3 * t + (s + 1) % 3], twin[3 * t + (s + 2) % 3]
        if turn(points, q, z, v) > 0 and turn(points, z, p, v) > 0:
            break
        if turn(points, a, v, z) > 0:
            past_left[lefts - 1], left[lefts], lefts, h = across_left, z, lefts + 1, across_right
        else:
            past_right[rights - 1], right[rights], rights, h = across_right, z, rights + 1, across_left
    chain[met] = size
    t0, t1 = chain[0], chain[1]
    _write(triangles, t0, v, q, z)
    _write(triangles, t1, v, z, p)
    _join(twin, edge, triangles, 3 * t0 + 1, across_right)
    _join(twin, edge, triangles, 3 * t1 + 1, across_left)
    _join(twin, edge, triangles, 3 * t0 + 2, 3 * t1)
    polygon[:rights], polygon[rights] = right[:rights], v
    past[: rights - 1], past[rights - 1] = past_right[: rights - 1], 3 * t0
    used = _fill(points, triangles, twin, edge, rights + 1, work, 2)
    polygon[0], past[0] = v, 3 * t1 + 2
    for i in range(lefts):
        polygon[i + 1] = left[lefts - 1 - i]
    for i in range(1, lefts):
        past[i] = past_left[lefts - 1 - i]
    return _fill(points, triangles, twin, edge, lefts + 1, work, used)


@njit(cache=True)
def _fill(points, triangles, twin, edge, m, work, used):
    """Triangulate the polygon beside a side of the dent, whose base from its last to its first vertex is on the curve.

    The rows of the triangles that were met are used again.
    """
    chain, polygon, past, stack = work[0], work[5], work[6], work[7]
    if m == 2:
        _join(twin, edge, triangles, past[0], -1)
        return used
    stack[0], stack[1], stack[2], height = 0, m - 1, -1, 3
    while height > 0:
        height -= 3
        i, j, parent = stack[height], stack[height + 1], stack[height + 2]
        c = _apex(points, polygon, i, j)
        t = chain[used]
        used += 1
        _write(triangles, t, polygon[j], polygon[i], polygon[c])
        _join(twin, edge, triangles, 3 * t, parent)
        if c == i + 1:
            _join(twin, edge, triangles, 3 * t + 1, past[i])
        else:
            stack[height], stack[height + 1], stack[height + 2] = i, c, 3 * t + 1
            height += 3
        if c + 1 == j:
            _join(twin, edge, triangles, 3 * t + 2, past[c])
        else:
            stack[height], stack[height + 1], stack[height + 2] = c, j, 3 * t + 2
            height += 3
    return used


@njit(cache=True)
def _apex(points, polygon, i, j):
    """The third vertex over the base from polygon[j] to polygon[i]: no other one is inside the circle."""
    best = i + 1
    for c in range(i + 2, j):
        if in_circumcircle(points, polygon[j], polygon[i], polygon[best], polygon[c]) > 0:
            best = c
    return best

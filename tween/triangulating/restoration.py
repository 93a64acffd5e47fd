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

from typing import NamedTuple

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


class _Scratch(NamedTuple):
    """Arrays that every dent uses anew.

    Attributes
    ----------
    chain : ndarray of int, shape (n,)
        The triangles that meet a b v, from ab to v, and the row of the one that comes in addition.
    left, right : ndarray of int, shape (n,)
        The vertices beside the chain, from a and from b on.
    past_left, past_right : ndarray of int, shape (n,)
        The half-edges outside, across the edges between these.
    polygon, past : ndarray of int, shape (n,)
        One side of the dent, ready to be triangulated, and the half-edges outside of it.
    stack : ndarray of int, shape (3 n,)
        Parts of the polygon that are still to be triangulated: first and last vertex, half-edge across the base.
    """

    chain: NDArray[np.int64]
    left: NDArray[np.int64]
    right: NDArray[np.int64]
    past_left: NDArray[np.int64]
    past_right: NDArray[np.int64]
    polygon: NDArray[np.int64]
    past: NDArray[np.int64]
    stack: NDArray[np.int64]


@njit(cache=True, inline="always")
def _scratch(n):
    """Room for the dents of a curve of n vertices: what a dent meets never has more than n vertices."""
    return _Scratch(
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(n, np.int64),
        np.empty(3 * n, np.int64),
    )


@njit(cache=True)
def _restore(points, triangles, size, kept, removed, dents):
    n = len(points)
    twin = np.full(3 * len(triangles), -1, np.int64)
    edge = np.full(n, -1, np.int64)  # the half-edge from each vertex along the curve
    _link(triangles, twin, edge, size, kept)
    work = _scratch(n)
    sides = twin.reshape(-1, 3)  # the same memory, as the flips expect it
    # locally Delaunay from here on: every step below mends around what it changes
    for h in range(3 * size):
        _legalise(points, triangles, sides, edge, h)
    for i in range(len(removed) - 1, -1, -1):
        a, v, b = removed[i]
        if dents[i]:
            changed = _cut_dent(points, triangles, twin, edge, size, a, v, b, work)
            for t in work.chain[:changed]:
                for s in range(3):
                    _legalise(points, triangles, sides, edge, 3 * t + s)
        else:
            _glue_ear(triangles, twin, edge, size, a, v, b)
            _legalise(points, triangles, sides, edge, 3 * size + 2)  # ab, no longer on the curve
        size += 1
    return triangles


@njit(cache=True)
def _legalise(points, triangles, twin, edge, h):
    """Flip the diagonal h if it is not locally Delaunay, and then those around it."""
    stack = [h]  # may hold an edge twice, which costs one more test; ends as Algorithm 1 does
    while len(stack) > 0:
        h = stack.pop()
        g = twin[h // 3, h % 3]
        if g < 0 or not not_delaunay(points, triangles, twin, h):
            continue
        flip_in_place(triangles, twin, h)
        for t in (h // 3, g // 3):
            for s in range(3):
                if twin[t, s] < 0:  # a flip gives half-edges of the curve other slots, too
                    edge[triangles[t, s]] = 3 * t + s
                else:
                    stack.append(3 * t + s)


@njit(cache=True, inline="always")
def _link(triangles, twin, edge, size, kept):
    """Find the twins of the first triangles: at every vertex by the triangles around it."""
    # an edge is on the curve where it leads to the next vertex that was kept
    follow = np.full(len(edge), -1, np.int64)
    for i in range(len(kept)):
        follow[kept[i]] = kept[(i + 1) % len(kept)]
    # half-edges sorted by the vertex where they start, by counting: no search, and no dictionary
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
        # one at most: vertices are positions along the curve, and a diagonal joins two of them once
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


@njit(cache=True, inline="always")
def _glue_ear(triangles, twin, edge, size, a, v, b):
    """Put the triangle a v b on the edge ab of the curve, in the first free row."""
    old, h = edge[a], 3 * size  # read before edge[a] becomes the new half-edge from a to v
    triangles[size, 0], triangles[size, 1], triangles[size, 2] = a, v, b
    _join(twin, edge, triangles, h, -1)
    _join(twin, edge, triangles, h + 1, -1)
    _join(twin, edge, triangles, h + 2, old)


@njit(cache=True)
def _write(triangles, t, a, b, c):
    triangles[t, 0], triangles[t, 1], triangles[t, 2] = a, b, c


@njit(cache=True, inline="always")
def _cut_dent(points, triangles, twin, edge, size, a, v, b, work):
    """Cut the triangle a b v out: walk from ab to v, and fill what remains of the triangles met.

    Returns the number of triangles written, which are the first ones in ``work.chain``.
    """
    chain, left, right, past_left, past_right, polygon, past, _ = work
    h, met, lefts, rights = edge[a], 0, 1, 1
    left[0], right[0] = a, b
    while True:  # v is inside the disk: the chain reaches it before it could leave, so h is never -1
        t, s = h // 3, h % 3
        chain[met] = t
        met += 1
        p, q, z = triangles[t, s], triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3]
        across_right, across_left = twin[3 * t + (s + 1) % 3], twin[3 * t + (s + 2) % 3]
        # strict: v may lie on the edge by which the chain came in; where it is on another one, the walk goes on
        if turn(points, q, z, v) > 0 and turn(points, z, p, v) > 0:
            break
        # no vertex is in a b v, so it leaves by one edge only: by that at the right of z where z is at the left of av
        if turn(points, a, v, z) > 0:
            past_left[lefts - 1], left[lefts], lefts, h = across_left, z, lefts + 1, across_right
        else:
            past_right[rights - 1], right[rights], rights, h = across_right, z, rights + 1, across_left
    chain[met] = size  # one vertex more, one triangle more: the rows met and this one are what is needed
    t0, t1 = chain[0], chain[1]
    _write(triangles, t0, v, q, z)
    _write(triangles, t1, v, z, p)
    _join(twin, edge, triangles, 3 * t0 + 1, across_right)
    _join(twin, edge, triangles, 3 * t1 + 1, across_left)
    _join(twin, edge, triangles, 3 * t0 + 2, 3 * t1)
    # at the right from b up to v, at the left from v down to a: the base, last to first, is the new edge of the curve
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

    The rows of the triangles that were met are used again, from number ``used`` of the chain on.
    """
    chain, polygon, past, stack = work.chain, work.polygon, work.past, work.stack
    if m == 2:  # the last triangle met has this side of the dent as an edge: nothing to fill
        _join(twin, edge, triangles, past[0], -1)
        return used
    stack[0], stack[1], stack[2], height = 0, m - 1, -1, 3  # nothing is across the first base: the curve
    while height > 0:
        height -= 3
        i, j, parent = stack[height], stack[height + 1], stack[height + 2]
        c = _apex(points, polygon, i, j)
        t = chain[used]  # m - 2 rows for this side; both sides and the two triangles at v need all that there are
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


@njit(cache=True, inline="always")
def _apex(points, polygon, i, j):
    """The third vertex over the base from polygon[j] to polygon[i]: no other one is inside the circle."""
    # circles through the ends of the base are nested on each side of it, so one pass finds the one that is empty
    best = i + 1
    for c in range(i + 2, j):
        if in_circumcircle(points, polygon[j], polygon[i], polygon[best], polygon[c]) > 0:
            best = c
    return best

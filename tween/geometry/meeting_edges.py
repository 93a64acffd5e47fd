"""Which edges of a closed polygon meet, in O((n + k) log**2 n) for k meetings, however the edges lie.

The plane is cut into vertical slabs, from each abscissa of a vertex to the next, and the slabs are the leaves of a
binary tree.  A node holds the edges that cross some of its slabs, but not all of its parent's.  Those that reach from
its left to its right border are *spanning*; a *ladder* is made of them, rungs that lie above each other at both borders
and hence do not meet.  Every other edge of the node is compared with the rungs that binary search does not show to lie
above or below it, and handed down.  A spanning edge that is no rung meets one, or passes it within rounding, so that
what handing it down costs is paid for by that meeting.

Doubles only rule pairs out, and by more than their rounding errors; exact predicates decide the others.

Legend: ``xs`` distinct abscissas; ``starts ends`` of each edge, as numbers of abscissas; slab k reaches from ``xs[k]``,
included, to ``xs[k + 1]``, excluded; a node is the slabs ``low <= k <= high``.

References
----------
I. J. Balaban, *An optimal algorithm for finding segments intersections*, Symposium on Computational Geometry (1995)
211-219: ladders, there called staircases, and who pays for what is not in one.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.growing import longer
from tween.geometry.predicates import turn

_SMALL = 200  # edges up to which comparing all pairs is as quick as the tree, and much less to compile
_FEW = 12  # edges of a node that are compared pair by pair
_ROUNDING = 2.0**-48  # of an ordinate found along an edge, as a share of the edge's largest ordinate
_CODE = 2  # a pair is kept as a number: twice its place among all pairs, and whether it crosses


def meeting_edges(points: NDArray[np.float64]) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Find the pairs of edges that meet, neighbours along the polygon left out.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
        Without edges of zero length; edge i runs from point i to the next.

    Returns
    -------
    pairs : ndarray of int, shape (k, 2)
        Edge numbers i < j, sorted.
    proper : ndarray of bool, shape (k,)
        Whether the two cross in their interiors.
    """
    n = len(points)
    if n <= _SMALL:
        lowest_first = np.argsort(np.minimum(points[:, 1], np.roll(points[:, 1], -1)), kind="stable")
        found, size = _compare_all(points, np.empty(n, dtype=np.int64), 0, lowest_first)
        codes = np.unique(found[:size])
    else:
        codes = np.unique(_by_slabs(points))
    pair = codes // _CODE
    return np.stack([pair // n, pair % n], axis=1).astype(np.intp), codes % _CODE == 1


def _by_slabs(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """Number the abscissas and walk down the tree; pairs may be found more than once."""
    xs, place = np.unique(points[:, 0], return_inverse=True)
    following = np.roll(place, -1)
    codes: NDArray[np.int64] = _meetings(points, xs, np.minimum(place, following), np.maximum(place, following))
    return codes


@njit(cache=True)
def _meetings(points, xs, starts, ends):
    """Walk down the tree, the left child of each node first; ``held`` is a stack of the edges of waiting nodes."""
    n = len(starts)
    lines = _lines(points)
    found, size = np.empty(n, np.int64), 0
    held, top = np.arange(n), n
    nodes = [(0, len(xs) - 1, n)]
    while len(nodes) > 0:
        low, high, count = nodes.pop()
        edges = held[top - count : top].copy()
        top -= count
        if count > _FEW:
            edges, rungs = _split(lines, xs, starts, ends, edges, low, high)
            if len(rungs) > 0:
                for e in edges:
                    found, size = _climb(points, lines, found, size, rungs, e, xs[low], xs[high + 1])
                if low == high:  # the edges that span a leaf are told apart here or nowhere
                    held, top = _hold(held, top, edges)
                    nodes.append((low, high, len(edges)))
                    continue
        if count <= _FEW or low == high:
            found, size = _compare_all(points, found, size, _lowest_first(points, edges))
            continue
        middle = (low + high) // 2
        right, left = edges[ends[edges] > middle], edges[starts[edges] <= middle]
        held, top = _hold(held, top, right)
        held, top = _hold(held, top, left)
        nodes.append((middle + 1, high, len(right)))
        nodes.append((low, middle, len(left)))
    return found[:size].copy()


@njit(cache=True)
def _lines(points):
    """Left end, right end, slope, and rounding error of the ordinates of every edge: (x, y, x, y, slope, error)."""
    n = len(points)
    lines = np.empty((n, 6))
    for e in range(n):
        f = (e + 1) % n
        ax, ay, bx, by = points[e, 0], points[e, 1], points[f, 0], points[f, 1]
        if ax > bx:
            ax, ay, bx, by = bx, by, ax, ay
        slope = (by - ay) / (bx - ax) if ax < bx else 0.0
        lines[e, 0], lines[e, 1], lines[e, 2], lines[e, 3] = ax, ay, bx, by
        lines[e, 4], lines[e, 5] = slope, _ROUNDING * max(abs(ay), abs(by))
    return lines


@njit(cache=True)
def _ordinate(lines, e, x):
    return lines[e, 1] + (x - lines[e, 0]) * lines[e, 4]


@njit(cache=True)
def _hold(held, top, edges):
    """Put edges on the stack."""
    while top + len(edges) > len(held):
        held = longer(held)
    for i in range(len(edges)):
        held[top + i] = edges[i]
    return held, top + len(edges)


@njit(cache=True)
def _split(lines, xs, starts, ends, edges, low, high):
    """The edges that are no rungs, and the rungs from the lowest to the highest."""
    spans = (starts[edges] <= low) & (ends[edges] > high)
    spanning, others = edges[spans], edges[~spans]
    if len(spanning) == 0:
        return others, spanning
    left = np.empty(len(spanning))
    for i in range(len(spanning)):
        left[i] = _ordinate(lines, spanning[i], xs[low])
    order = np.argsort(left, kind="mergesort")
    rung, rejected = np.empty_like(spanning), np.empty_like(spanning)
    rungs, rest, left_top, right_top = 0, 0, -np.inf, -np.inf
    for i in order:
        e = spanning[i]
        right, error = _ordinate(lines, e, xs[high + 1]), lines[e, 5]
        if left[i] - error > left_top and right - error > right_top:
            rung[rungs], rungs, left_top, right_top = e, rungs + 1, left[i] + error, right + error
        else:
            rejected[rest], rest = e, rest + 1
    return np.concatenate((others, rejected[:rest])), rung[:rungs]


@njit(cache=True)
def _climb(points, lines, found, size, rungs, e, x0, x1):
    """Compare edge e with the rungs between x0 and x1 that are neither certainly below nor certainly above it."""
    ax, ay, bx, by = lines[e, 0], lines[e, 1], lines[e, 2], lines[e, 3]
    if ax < x0:
        ax, ay = x0, _ordinate(lines, e, x0)
    if bx > x1:
        bx, by = x1, _ordinate(lines, e, x1)
    first, last = 0, len(rungs)
    while first < last:
        middle = (first + last) // 2
        if _side(lines, rungs[middle], ax, ay, bx, by, lines[e, 5]) > 0:
            first = middle + 1
        else:
            last = middle
    for r in rungs[first:]:
        if _side(lines, r, ax, ay, bx, by, lines[e, 5]) < 0:
            break
        found, size = _compare(points, found, size, r, e)
    return found, size


@njit(cache=True)
def _side(lines, r, ax, ay, bx, by, error):
    """+1 where the segment ab is certainly above rung r, -1 where it is below it, 0 where the two may meet."""
    error += lines[r, 5]
    at_a, at_b = ay - _ordinate(lines, r, ax), by - _ordinate(lines, r, bx)
    return int(at_a > error and at_b > error) - int(at_a < -error and at_b < -error)


@njit(cache=True, inline="always")
def _lowest_first(points, edges):
    """The edges by their lowest ordinate; apart from what compares them, as small curves need no compiled sort."""
    low = np.empty(len(edges))
    for i in range(len(edges)):
        low[i] = min(points[edges[i], 1], points[(edges[i] + 1) % len(points), 1])
    return edges[np.argsort(low, kind="mergesort")]


@njit(cache=True)
def _compare_all(points, found, size, lowest_first):
    """Compare every pair whose ranges of ordinates overlap."""
    n = len(points)
    for i in range(len(lowest_first)):
        e = lowest_first[i]
        high = max(points[e, 1], points[(e + 1) % n, 1])
        for j in range(i + 1, len(lowest_first)):
            f = lowest_first[j]
            if min(points[f, 1], points[(f + 1) % n, 1]) > high:
                break
            found, size = _compare(points, found, size, e, f)
    return found, size


@njit(cache=True)
def _compare(points, found, size, e, f):
    """Append the pair to the list if the two edges meet and are no neighbours."""
    n = len(points)
    i, j = min(e, f), max(e, f)
    if j - i == 1 or j - i == n - 1:
        return found, size
    how = _how_they_meet(points, i, (i + 1) % n, j, (j + 1) % n)
    if how >= 0:
        if size == len(found):
            found = longer(found)
        found[size] = (i * n + j) * _CODE + how
        size += 1
    return found, size


@njit(cache=True, inline="always")
def _how_they_meet(points, a, b, c, d):
    """1 where the segments ab and cd cross inside both, 0 where they touch, -1 where they do not meet."""
    for axis in range(2):
        if max(points[a, axis], points[b, axis]) < min(points[c, axis], points[d, axis]):
            return -1
        if max(points[c, axis], points[d, axis]) < min(points[a, axis], points[b, axis]):
            return -1
    abc, abd = turn(points, a, b, c), turn(points, a, b, d)
    if abc * abd > 0:
        return -1
    cda, cdb = turn(points, c, d, a), turn(points, c, d, b)
    if abc * abd < 0 and cda * cdb < 0:
        return 1
    if cda * cdb > 0:
        return -1
    for side, p, q, r in ((abc, a, b, c), (abd, a, b, d), (cda, c, d, a), (cdb, c, d, b)):
        if side == 0 and _in_box(points, p, q, r):
            return 0
    return -1


@njit(cache=True, inline="always")
def _in_box(points, a, b, c):
    """Whether point c lies in the box of the segment ab."""
    for axis in range(2):
        if not min(points[a, axis], points[b, axis]) <= points[c, axis] <= max(points[a, axis], points[b, axis]):
            return False
    return True

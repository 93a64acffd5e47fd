r"""Reducing a curve to a smaller one that bounds the same disks.

Let v have the neighbours a and b on the curve.  v may be removed when the closed triangle of a, v, b holds no other
vertex, and the turn at v is

    left   an ear: the triangle a v b belongs to every disk that the curve bounds; cut it off
    right  a dent, and no other edge meets av or vb: the triangle a b v lies outside, at the left of the new edge;
           glue it on, and v becomes a point inside the disk
                                v
              a ---- b         / \          The immersed disks of the curve before and after
               \    /         /   \         correspond one to one.
                `v'          a --- b
               ear (inside above)  dent (inside above)

An ear may well be crossed by edges in other sheets.  For sweep it, inside a disk, by a segment parallel to ab, from v
on: its ends slide along the two edges, so only a vertex could stop it.  Where the curve goes on from a or b into the
triangle there is no disk, then, and none after the cut, which leaves a turning number below 1, or a spike; and n-2
triangles have too small a sum of angles for that.  Of a dent, swept by a growing triangle a b x inside a disk of the
reduced curve, the corner x could be stopped by an edge that crosses both sides; hence the stricter condition.  What
meets ab meets av or vb, so an edge once met by none is never met later.

What is left has at most about as many vertices as there are edges that meet others; where a curve crosses itself a few
times, however finely it is drawn, that is next to nothing.  How the vertices come back: `.restoration`.

Legend: ``a v b`` neighbours on the curve; ``w`` any other vertex.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.curve import Curve
from tween.geometry.predicates import turn

_FAN = 8  # children of a node of the tree of boxes
_BLOCK = 256  # vertices whose waiting is counted together
_ROUNDING = 2.0**-49  # of a determinant of two products, as a share of their sizes


class Reduction(NamedTuple):
    """A curve without the vertices that do not matter.

    Attributes
    ----------
    kept : ndarray of int, shape (m,)
        The vertices that are left, ascending.
    removed : ndarray of int, shape (n-m, 3)
        Rows a, v, b in the order of removal.
    dents : ndarray of bool, shape (n-m,)
        Whether v was a dent, or lies on the edge ab, and not an ear.
    """

    kept: NDArray[np.int64]
    removed: NDArray[np.int64]
    dents: NDArray[np.bool_]


def reduce_curve(curve: Curve) -> Reduction:
    """Remove vertices as long as one may be removed.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    Reduction
        Of at least three vertices.

    Notes
    -----
    In rounds along the curve, neighbours of what was removed are left for the next round.  A vertex that may not be
    removed waits for what could change that: a new neighbour, or the removal of a vertex that was found in its
    triangle; whoever does not wait is passed over, with the same outcome.  A tree of boxes finds vertices in triangles.
    Exact; near-linear as a rule.

    Examples
    --------
    >>> import numpy as np
    >>> angle = 2 * np.pi * np.arange(1000) / 1000
    >>> len(reduce_curve(Curve(np.stack([np.cos(angle), np.sin(angle)], axis=1))).kept)
    3
    """
    crossed = np.zeros(len(curve), dtype=np.bool_)
    crossed[curve.crossings.pairs.ravel()] = True
    return Reduction(*_reduce(curve.points, crossed))


# Reducing


@njit(cache=True)
def _reduce(points, crossed):
    n = len(points)
    after, before = (np.arange(n) + 1) % n, (np.arange(n) - 1) % n
    order = _in_blocks_of_space(points)
    leaf, tree = np.argsort(order), _tree(points, order)
    waits, waiting = np.ones(n, np.bool_), np.bincount(np.arange(n) // _BLOCK)
    following, preceding = np.full(2 * n, -1), np.full(2 * n, -1)
    removed, dents = np.empty((n, 3), np.int64), np.empty(n, np.bool_)
    first, count, found = 0, 0, True
    while found:
        found, position, end = False, first, first + n
        while count < n - 3:
            position = _next_waiting(waits, waiting, position, end)
            if position >= end:
                break
            v = position % n
            a, b = before[v], after[v]
            side = turn(points, a, v, b)
            _set_waiting(waits, waiting, v, False)
            position += 1
            if not _may_go(points, crossed, a, v, b, side):
                continue
            obstacle = _vertex_inside(points, order, tree, a, v, b, side)
            if obstacle >= 0:
                _keep(following, preceding, v, obstacle)
                continue
            removed[count], dents[count] = (a, v, b), side <= 0
            crossed[a] |= crossed[v]
            after[a], before[b] = b, a
            _remove(tree[1], tree[2], leaf[v])
            _wake(waits, waiting, following, preceding, a, v, b)
            found, count, first, position = True, count + 1, b, position + (b - v) % n
    return np.flatnonzero(tree[1][leaf] > 0), removed[:count].copy(), dents[:count].copy()


@njit(cache=True)
def _may_go(points, crossed, a, v, b, side):
    """Whether v is the tip of an ear or of a dent that nothing meets, or lies on ab; not the tip of a spike."""
    if side != 0:
        return side > 0 or not (crossed[a] or crossed[v])
    # on the line ab, so comparing coordinates tells exactly whether v lies between: else it is a spike
    (ax, ay), (vx, vy), (bx, by) = points[a], points[v], points[b]
    return min(ax, bx) <= vx <= max(ax, bx) and min(ay, by) <= vy <= max(ay, by)


# Vertices that wait to be tested


@njit(cache=True)
def _set_waiting(waits, waiting, v, value):
    """Let v wait or not; ``waiting`` counts by blocks."""
    waiting[v // _BLOCK] += int(value) - int(waits[v])
    waits[v] = value


@njit(cache=True, inline="always")
def _next_waiting(waits, waiting, position, end):
    """The first position from the given one on whose vertex waits; at least ``end`` where none does before."""
    n = len(waits)
    while position < end:
        v = position % n
        if waits[v]:
            break
        position += min(_BLOCK - v % _BLOCK, n - v) if waiting[v // _BLOCK] == 0 else 1
    return position


@njit(cache=True, inline="always")
def _wake(waits, waiting, following, preceding, a, v, b):
    """Once v is gone, let its neighbours and those that it kept wait to be tested."""
    for freed in (a, b):
        _release(following, preceding, freed)
        _set_waiting(waits, waiting, freed, True)
    begin = len(waits) + v
    while following[begin] >= 0:
        freed = following[begin]
        _release(following, preceding, freed)
        _set_waiting(waits, waiting, freed, True)


@njit(cache=True)
def _keep(following, preceding, v, obstacle):
    """Put v first in the doubly linked list of those that the obstacle keeps, which begins at n + obstacle."""
    begin = len(following) // 2 + obstacle
    following[v], preceding[v] = following[begin], begin
    if following[begin] >= 0:
        preceding[following[begin]] = v
    following[begin] = v


@njit(cache=True)
def _release(following, preceding, v):
    """Take v out of the list that it is in, if any."""
    if preceding[v] >= 0:
        following[preceding[v]] = following[v]
        if following[v] >= 0:
            preceding[following[v]] = preceding[v]
        preceding[v] = -1


# Vertices in triangles


@njit(cache=True, inline="always")
def _in_blocks_of_space(points):
    """Vertices in Morton order of their ranks by abscissa and ordinate: neighbours are near, at whatever scale."""
    n = len(points)
    key = np.zeros(n, np.int64)
    for axis in range(2):
        sorted_vertices = np.argsort(points[:, axis], kind="mergesort")
        for rank in range(n):
            for bit in range(31):
                key[sorted_vertices[rank]] |= (rank >> bit & 1) << (2 * bit + axis)
    return np.argsort(key, kind="mergesort")


@njit(cache=True)
def _tree(points, order):
    """Boxes (x0, y0, x1, y1) of all nodes, numbers of vertices in them, and where each level starts.

    The leaves, single vertices in the given order, come first; node i of a level is the parent of the nodes
    `_FAN` i, `_FAN` i + 1, ... of the level below, and the root is alone.
    """
    n = len(order)
    starts = [0, n]
    while starts[-1] - starts[-2] > 1:
        starts.append(starts[-1] + (starts[-1] - starts[-2] + _FAN - 1) // _FAN)
    boxes, alive = np.empty((starts[-1], 4)), np.zeros(starts[-1], np.int64)
    boxes[:, :2], boxes[:, 2:] = np.inf, -np.inf
    boxes[:n, :2], boxes[:n, 2:], alive[:n] = points[order], points[order], 1
    for level in range(len(starts) - 2):
        for node in range(starts[level], starts[level + 1]):
            parent = starts[level + 1] + (node - starts[level]) // _FAN
            alive[parent] += alive[node]
            for axis in range(2):
                boxes[parent, axis] = min(boxes[parent, axis], boxes[node, axis])
                boxes[parent, axis + 2] = max(boxes[parent, axis + 2], boxes[node, axis + 2])
    return boxes, alive, np.array(starts)


@njit(cache=True, inline="always")
def _remove(alive, starts, leaf):
    """Count one vertex less, from its leaf to the root."""
    node = leaf
    for level in range(len(starts) - 1):
        alive[starts[level] + node] -= 1
        node //= _FAN


@njit(cache=True, inline="always")
def _vertex_inside(points, order, tree, a, v, b, side):
    """Some other vertex in the closed triangle of a, v, b; -1 where there is none."""
    boxes, alive, starts = tree
    q, r = (v, b) if side > 0 else (b, v)
    (ax, ay), (qx, qy), (rx, ry) = points[a], points[q], points[r]
    x0, x1, y0, y1 = min(ax, qx, rx), max(ax, qx, rx), min(ay, qy, ry), max(ay, qy, ry)
    root = len(starts) - 2
    level, node = root, 0
    while True:
        i = starts[level] + node
        if (
            i < starts[level + 1]
            and alive[i] > 0
            and boxes[i, 0] <= x1
            and boxes[i, 1] <= y1
            and boxes[i, 2] >= x0
            and boxes[i, 3] >= y0
            and not _is_right_of(boxes, i, ax, ay, qx, qy)
            and not _is_right_of(boxes, i, qx, qy, rx, ry)
            and not _is_right_of(boxes, i, rx, ry, ax, ay)
        ):
            if level > 0:
                level, node = level - 1, _FAN * node
                continue
            w = order[node]
            if w != a and w != v and w != b:
                if turn(points, a, q, w) >= 0 and turn(points, q, r, w) >= 0 and turn(points, r, a, w) >= 0:
                    return w
        node += 1
        while node % _FAN == 0 and level < root:  # the next sibling of the parent
            level, node = level + 1, node // _FAN
        if level == root:
            return -1


@njit(cache=True)
def _is_right_of(boxes, i, ax, ay, bx, by):
    """Whether box i certainly lies to the right of the line from a to b: its leftmost corner does."""
    x, y = boxes[i, 0 if by > ay else 2], boxes[i, 3 if bx > ax else 1]
    up, along = (bx - ax) * (y - ay), (by - ay) * (x - ax)
    return up - along < -_ROUNDING * (abs(up) + abs(along))

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

_PER_CELL = 2  # vertices, on average


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
    In rounds along the curve, neighbours of what was removed are left for the next round, so there are
    O(log n) rounds as a rule.  A grid of cells holds the vertices; each test looks at the cells that the box of its
    triangle meets.  Exact; near-linear where edges are short.

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
    alive = np.ones(n, np.bool_)
    removed, dents = np.empty((n, 3), np.int64), np.empty(n, np.bool_)
    left, first, count = n, 0, 0
    while left > 3:
        grid = _grid(points, alive, left)  # keeps what this round removes: _is_empty asks who is alive
        found, v, steps = 0, first, left  # steps: vertices of this round from v on
        while steps > 0 and left > 3:
            a, b = before[v], after[v]
            side = turn(points, a, v, b)
            if _may_go(points, crossed, a, v, b, side) and _is_empty(points, alive, grid, a, v, b, side):
                crossed[a] |= crossed[v]  # what meets the new edge met one of the two old ones
                removed[count], dents[count] = (a, v, b), side <= 0
                alive[v] = False
                after[a], before[b] = b, a
                left, count, found = left - 1, count + 1, found + 1
                # not b at once, or a convex curve would shrink from one side, by ever longer ears
                first, v, steps = b, after[b], steps - 2
            else:
                v, steps = b, steps - 1
        if found == 0:  # nothing has changed, so nothing would in another round
            break
    return np.flatnonzero(alive), removed[:count].copy(), dents[:count].copy()


@njit(cache=True)
def _may_go(points, crossed, a, v, b, side):
    """Whether v is the tip of an ear or of a dent that nothing meets, or lies on ab; not the tip of a spike."""
    if side != 0:
        return side > 0 or not (crossed[a] or crossed[v])
    # on the line ab, so comparing coordinates tells exactly whether v lies between: else it is a spike
    (ax, ay), (vx, vy), (bx, by) = points[a], points[v], points[b]
    return min(ax, bx) <= vx <= max(ax, bx) and min(ay, by) <= vy <= max(ay, by)


@njit(cache=True)
def _grid(points, alive, left):
    """Vertices sorted into square cells: (x0, y0, size, columns, rows, start, items)."""
    x0, y0, x1, y1 = np.inf, np.inf, -np.inf, -np.inf
    for v in range(len(points)):
        if alive[v]:
            x0, x1 = min(x0, points[v, 0]), max(x1, points[v, 0])
            y0, y1 = min(y0, points[v, 1]), max(y1, points[v, 1])
    wide, high = x1 - x0, y1 - y0
    # the second term keeps the cells of a thin box few, and those of a flat one from having no size
    size = max(np.sqrt(wide * high * _PER_CELL / left), max(wide, high) * _PER_CELL / left)
    columns, rows = int(wide / size) + 1, int(high / size) + 1
    # sorted by counting: how many a cell has, where each begins, who is in it
    start = np.zeros(columns * rows + 1, np.int64)
    for v in range(len(points)):
        if alive[v]:
            start[_cell(points[v, 0], x0, size, columns) + columns * _cell(points[v, 1], y0, size, rows) + 1] += 1
    start = np.cumsum(start)
    items, fill = np.empty(left, np.int64), start[:-1].copy()
    for v in range(len(points)):
        if alive[v]:
            cell = _cell(points[v, 0], x0, size, columns) + columns * _cell(points[v, 1], y0, size, rows)
            items[fill[cell]] = v
            fill[cell] += 1
    return x0, y0, size, columns, rows, start, items


@njit(cache=True)
def _cell(x, x0, size, count):
    """The cell of a coordinate; monotone in x, so a box of cells holds all points of a box."""
    return min(count - 1, max(0, int((x - x0) / size)))


@njit(cache=True)
def _is_empty(points, alive, grid, a, v, b, side):
    """Whether the closed triangle of a, v, b holds no other vertex."""
    x0, y0, size, columns, rows, start, items = grid
    low_x, high_x = min(points[a, 0], points[v, 0], points[b, 0]), max(points[a, 0], points[v, 0], points[b, 0])
    low_y, high_y = min(points[a, 1], points[v, 1], points[b, 1]), max(points[a, 1], points[v, 1], points[b, 1])
    q, r = (v, b) if side > 0 else (b, v)  # a, q, r is counter-clockwise
    for row in range(_cell(low_y, y0, size, rows), _cell(high_y, y0, size, rows) + 1):
        first = _cell(low_x, x0, size, columns) + columns * row
        last = _cell(high_x, x0, size, columns) + columns * row  # cells of a row follow each other in items
        for w in items[start[first] : start[last + 1]]:
            if not alive[w] or w == a or w == v or w == b:
                continue
            if not (low_x <= points[w, 0] <= high_x and low_y <= points[w, 1] <= high_y):
                continue
            # where a, v, b are collinear, a w beside their line has turns of both signs, and on it the box decides
            if turn(points, a, q, w) >= 0 and turn(points, q, r, w) >= 0 and turn(points, r, a, w) >= 0:
                return False
    return True

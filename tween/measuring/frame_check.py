r"""Single frames: whether each bounds an immersed disk that its triangles cover, decided exactly.

Counter-clockwise triangles are not enough.  The angles of the triangles around a vertex may add up to
2 pi or more; then the curve turns more than once, and bounds no immersed disk, although no triangle folds.
So every vertex is walked around, through its *fan* of triangles:

      p2 ---- p1            fan of v: p0, p1, ..., pd, from v's successor p0 on the curve to its
     /  \    /  \           predecessor pd; the triangles v, p(i), p(i+1) are the fan's
    p3    v ---- p0

If each fan leads along the triangles from p0 to pd and no triangle is left over, the triangles are glued
to one disk.  The step from one p(i) to the next turns left by less than pi, so the direction comes back
to that of p0 exactly where it leaves the open half plane to the right of v p0: counting these returns
with `turn` gives floor(angle sum / 2 pi), exactly.  The angles of n-2 triangles sum to
(n-2) pi, and a curve turns at v by pi - angle sum, up to the multiple of 2 pi that brings it between -pi and pi:

    turning number  =  1 + sum over the vertices of floor(angle sum / 2 pi).

Legend: ``v p`` vertices; ``m`` number of triangles; ``f`` frame; ``stage`` number of the list of triangles in force;
``fault`` a rule's code and two numbers, (OK, 0, 0) for none.
"""

from math import atan2, inf, nan
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.predicates import EXACT_RANGE, turn

_LOW, _HIGH = EXACT_RANGE
_OK, _COUNT, _INDEX, _TWICE, _MISSING, _RIGHT, _OPEN, _APART, _RANGE, _FLIPPED, _SPIKE, _TURNS = range(12)
_RULES = {
    _COUNT: "there are {a} triangles, expected {b} for {n} vertices",
    _INDEX: "triangle {a} is {corners}, expected three different vertices from 0 to {last}",
    _TWICE: "edge {a}-{b} occurs twice in the same direction",
    _MISSING: "boundary edge {a}-{b} belongs to no triangle",
    _RIGHT: "boundary edge {a}-{b} has a triangle on its right, expected on its left only",
    _OPEN: "diagonal {a}-{b} has no triangle on its other side",
    _APART: "triangle {a} is not joined to the others around vertex {b}: the dual graph is no tree",
    _RANGE: "vertex {a} is {place}, expected coordinates that are 0 or between {low:.0e} and {high:.0e} in magnitude",
    _FLIPPED: "triangle {a} {corners} is not counter-clockwise",
    _SPIKE: "vertex {a} is a spike: the angles there add up to exactly {b} pi",
    _TURNS: "the angles at vertex {a} add up to {sum:.4f}, more than 2 pi: the turning number is {b}, not 1",
}


class Checked(NamedTuple):
    """Frames, and what was found; made by `check`.

    Attributes
    ----------
    t : ndarray of float64, shape (k,)
    stage : ndarray of int64, shape (k,)
        Number of the list of triangles of each frame.
    shapes : ndarray of float64, shape (k, n, 2)
    faults : ndarray of int64, shape (k, 3)
        A rule's code, 0 for none, and the two numbers that go with it; `fault_words` puts them into words.
    sums : ndarray of float64, shape (k, n)
        Sums of angles, in radians, rounded; nan where a frame could not be measured, as in the next two.
    heights : ndarray of float64, shape (k, m)
        Of triangles over their longest edges.
    areas : ndarray of float64, shape (k,)
        Of the smallest triangle of each frame.
    """

    t: NDArray[np.float64]
    stage: NDArray[np.int64]
    shapes: NDArray[np.float64]
    faults: NDArray[np.int64]
    sums: NDArray[np.float64]
    heights: NDArray[np.float64]
    areas: NDArray[np.float64]

    def merged(self, other: "Checked") -> "Checked":
        """Return both together, in order of stage and time.

        Parameters
        ----------
        other : Checked

        Returns
        -------
        Checked
        """
        joined = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.lexsort((joined[0], joined[1]))
        return Checked(*(values[order] for values in joined))


def check(
    t: NDArray[np.float64], stage: NDArray[np.int64], shapes: NDArray[np.float64], lists: NDArray[np.int64]
) -> Checked:
    """Check frames one by one.

    Parameters
    ----------
    t : ndarray of float64, shape (k,)
    stage : ndarray of int64, shape (k,)
        Number of the list of triangles of each frame.
    shapes : ndarray of float64, shape (k, n, 2)
    lists : ndarray of int64, shape (stages, m, 3)

    Returns
    -------
    Checked
        O(n) a frame; frames of one stage had better follow each other.
    """
    (k, n, _), m = shapes.shape, lists.shape[1]
    found = np.zeros((k, 3), np.int64), np.full((k, n), nan), np.full((k, m), nan), np.full(k, nan)
    if m == n - 2:
        _check(np.ascontiguousarray(shapes), stage, lists, *found)
    else:
        found[0][:] = _COUNT, m, n - 2
    return Checked(t, stage, shapes, *found)


def fault_words(checked: Checked, lists: NDArray[np.int64], f: int) -> tuple[str, int | tuple[int, int] | None]:
    """Say what is wrong with a frame that has a fault.

    Parameters
    ----------
    checked : Checked
    lists : ndarray of int64, shape (stages, m, 3)
    f : int
        The frame.

    Returns
    -------
    rule : str
    element : int or (int, int) or None
        The vertex or triangle, or the ends of the edge; None for a wrong number of triangles.
    """
    code, a, b = checked.faults[f].tolist()
    n, triangles = checked.sums.shape[1], lists[checked.stage[f]]
    rule = _RULES[code].format(
        a=a,
        b=b,
        n=n,
        last=n - 1,
        low=_LOW,
        high=_HIGH,
        corners=triangles[a].tolist() if code in (_INDEX, _FLIPPED) else "",
        place=tuple(checked.shapes[f, a].tolist()) if code == _RANGE else "",
        sum=checked.sums[f, a] if code == _TURNS else nan,
    )
    edge = code in (_TWICE, _MISSING, _RIGHT, _OPEN)
    return rule, None if code == _COUNT else (a, b) if edge else a


# One frame


@njit(cache=True)
def _check(shapes, stage, lists, faults, sums, heights, areas):
    """Fill in faults and measures of all frames; frames of one stage follow each other."""
    n = shapes.shape[1]
    # fans depend on the triangles alone, so each list is walked once and not in every frame
    fault, start, fans = _fans(lists[stage[0]], n)
    for f in range(len(shapes)):
        if f > 0 and stage[f] != stage[f - 1]:
            fault, start, fans = _fans(lists[stage[f]], n)
        outside = _outside(shapes[f])
        if fault[0] == _OK and outside < 0:
            areas[f] = _measure(shapes[f], lists[stage[f]], sums[f], heights[f])
            found = _shape_fault(shapes[f], lists[stage[f]], start, fans)
        else:  # what cannot be measured keeps its nan
            found = fault if fault[0] != _OK else (_RANGE, outside, 0)
        faults[f, 0], faults[f, 1], faults[f, 2] = found


@njit(cache=True, inline="always")
def _outside(points):
    """The first vertex whose coordinates the predicate cannot treat exactly; -1 for none."""
    for v in range(len(points)):
        for x in points[v]:
            # so written that nan, for which every comparison is false, is outside
            if not (x == 0.0 or _LOW <= abs(x) <= _HIGH):
                return v
    return -1


@njit(cache=True)
def _measure(points, triangles, sums, heights):
    """Fill in the angle sums and the heights over the longest edge; returns the smallest area."""
    # measured in floats, for the report and for where to look closer; no frame passes or fails by these
    sums[:] = 0.0
    least = inf
    for i in range(len(triangles)):
        longest = 0.0
        for s in range(3):
            v, p, q = triangles[i, s], triangles[i, (s + 1) % 3], triangles[i, (s + 2) % 3]
            ax, ay = points[p, 0] - points[v, 0], points[p, 1] - points[v, 1]
            bx, by = points[q, 0] - points[v, 0], points[q, 1] - points[v, 1]
            cross = ax * by - ay * bx
            # atan2 has all its digits near 0 and pi, where an arc cosine has half of them
            sums[v] += atan2(cross, ax * bx + ay * by)
            longest = max(longest, ax * ax + ay * ay)
        # cross is twice the area at every corner: that of the last will do
        heights[i] = cross / longest if longest > 0.0 else 0.0
        least = min(least, 0.5 * cross)
    return least


@njit(cache=True, inline="always")
def _shape_fault(points, triangles, start, fans):
    """The first rule that the points break, under triangles that keep the rules of edges."""
    for i in range(len(triangles)):
        if turn(points, triangles[i, 0], triangles[i, 1], triangles[i, 2]) <= 0:
            return _FLIPPED, i, 0
    # all triangles are positive from here on, which is what counting turns by half planes needs
    turning, worst, back, most = 1, 0, False, 0
    for v in range(len(points)):
        full, closed = _full_turns(points, v, fans[start[v] : start[v + 1]])
        turning += full
        if full > most:
            worst, back, most = v, closed, full
    if most == 0:
        return _OK, 0, 0
    # back in its first direction after full turns: both edges of the curve leave the vertex the same way
    return (_SPIKE, worst, 2 * most) if back else (_TURNS, worst, turning)


@njit(cache=True, inline="always")
def _full_turns(points, v, fan):
    """floor(angle sum / 2 pi) of a fan of positive triangles, and whether it ends in its first direction."""
    full, right, ahead = 0, False, True
    for p in fan[1:]:
        side = turn(points, v, fan[0], p)
        ahead = side == 0 and _same_direction(points, v, fan[0], p)
        # a step is less than pi, so none jumps over the open half plane on the right
        was_right, right = right, side < 0
        full += int(was_right and not right)
    return full, ahead


@njit(cache=True, inline="always")
def _same_direction(points, v, p, q):
    """Whether q lies on the same side of v as p, all three being on one line."""
    # comparing coordinates is exact where a difference would be rounded; p differs from v, as its triangle is positive
    axis = 0 if points[p, 0] != points[v, 0] else 1
    return (points[p, axis] > points[v, axis]) == (points[q, axis] > points[v, axis])


# Fans


@njit(cache=True)
def _fans(triangles, n):
    """A fault of the triangles, and the fan of v in fans[start[v] : start[v + 1]]."""
    start, fans = np.zeros(n + 1, np.int64), np.empty(3 * len(triangles) + n, np.int64)
    for i in range(len(triangles)):
        a, b, c = triangles[i, 0], triangles[i, 1], triangles[i, 2]
        if min(a, b, c) < 0 or max(a, b, c) >= n or a == b or b == c or c == a:
            return (_INDEX, i, 0), start, fans
        for s in range(3):
            start[triangles[i, s] + 1] += 1
    # corners sorted by their vertex, by counting
    first, place = np.zeros(n + 1, np.int64), np.zeros(n, np.int64)
    for v in range(n):
        first[v + 1], place[v] = first[v] + start[v + 1], first[v]
    corners = np.empty(3 * len(triangles), np.int64)
    for h in range(corners.size):
        v = triangles[h // 3, h % 3]
        corners[place[v]] = h
        place[v] += 1
    for v in range(n + 1):
        start[v] = first[v] + v  # a fan has one vertex more than triangles
    # every walk leaves these at -1 again, so one pair serves all vertices
    after, before = np.full(n, -1), np.full(n, -1)
    for v in range(n):
        own, fan = corners[first[v] : first[v + 1]], fans[start[v] : start[v + 1]]
        fault = _walk(triangles, own, v, n, after, before, fan)
        if fault[0] != _OK:
            return fault, start, fans
    return (_OK, 0, 0), start, fans


@njit(cache=True)
def _walk(triangles, corners, v, n, after, before, fan):
    """Walk from the successor of v to its predecessor, over all triangles v, p, after[p]; or tell why that fails."""
    successor, predecessor = (v + 1) % n, (v - 1) % n
    for h in corners:
        p, q = triangles[h // 3, (h + 1) % 3], triangles[h // 3, (h + 2) % 3]
        if after[p] >= 0:
            return _TWICE, v, p
        if before[q] >= 0:  # so after is one to one
            return _TWICE, q, v
        after[p], before[q] = q, p
    if after[successor] < 0:
        return _MISSING, v, successor
    if before[successor] >= 0:
        return _RIGHT, v, successor
    if after[predecessor] >= 0:
        return _RIGHT, predecessor, v
    p, size = successor, 0
    # nothing comes before the successor and after is one to one: the walk never meets itself, and ends
    while after[p] >= 0:
        fan[size], size, q = p, size + 1, after[p]
        after[p], before[q], p = -1, -1, q
    fan[size] = p
    if p != predecessor:
        return _OPEN, v, p
    for h in corners:  # what is left forms a ring, or a second fan, that touches the first at v only
        if after[triangles[h // 3, (h + 1) % 3]] >= 0:
            return _APART, h // 3, v
    return _OK, 0, 0

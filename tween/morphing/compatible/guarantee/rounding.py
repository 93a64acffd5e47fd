r"""What rounding can do to a motion between two times: bounds that hold in doubles.

A proof about angles is a proof about real numbers; people get arrays.  A motion is laid out from the root along the
tree, and each step rounds.  Call *ideal* the shape that exact arithmetic would lay out from the third vertices z as
they were computed.  Then, with u = 2^-53 and for a triangle at depth d over a base of length L,

    the base     e = z e', or (1-z) e'     is off by at most 8 (d + 1) u, relatively
    the vertex   c = a + z e               by the error of a, that of z e, and 2 u times its distance from the start

so no vertex is off by more than ``errors``: O(d u) times the length of the way to it, of which placing the shape makes
a little more (`Placing`).  Where every triangle's least height exceeds twice the errors of its corners, no triangle
turns over on the straight way from the ideal shape to the array; and then the sum of angles at a vertex changes by the
turns of the two *boundary* edges there only, since what one triangle loses at an inner edge its neighbour gains.  An
edge of length l turns by less than 1.6 times the errors of its ends over l.  The angles of the ideal triangles differ
from those that were proved for the path by the rounding of z: by 2^-48, and at both ends of the edge bc by that much
times abs(z) / abs(1-z), since z is rounded relative to its distance from 0.

So a shape is valid, in doubles, where no triangle is lower than twice its errors, and no vertex spends more on turns
and roundings than it has left below 2 pi.  `first_doubt` looks at intervals of time: few long ones first; those in
doubt are cut in four, until they are proved or too short.  What is known in an interval are bounds of angles; the law
of sines carries lengths down the tree.

The interval at an end may stay in doubt however short it is: the end may be a shape that is only just valid.  Then
the end itself, which is given exactly, serves for it, up to 2^-24 from there as long as the shape has moved by less
than 1e-7 of its width.

Legend: ``f`` number of an interval; ``low high`` ends of intervals; ``near far`` least and greatest length.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.predicates import EXACT_RANGE
from tween.morphing.compatible.guarantee.quick_trigonometry import sine_up_to_pi

_UNIT = 2.0**-53
_ANGLE_ERROR = 2.0**-48
_FEW = 16  # intervals to begin with
_PARTS = 4  # into which one in doubt is cut
_SHORTEST = 2.0**-10  # of intervals that touch no end, as a share of their distance from it
_MOST = 4096  # intervals in one round
_SNAP, _LEAST_SNAP = 2.0**-24, 2.0**-50  # lengths of intervals for which an end may serve
_JUMP = 1e-7  # widths by which a shape may move while an end serves
_FINE, _TRIANGLE, _VERTEX, _RANGE = range(4)


class Doubt(NamedTuple):
    """What could not be proved, and from when on.

    Attributes
    ----------
    start, stop : float
        Times of the motion.
    rule : str
        "triangle", "vertex", "range" or "jump".
    vertices : tuple of int
        The corners of the triangle, or the vertex.
    left : float
        Radians that the vertex has left below 2 pi; or the triangle's least height.
    needed : float
        What rounding can take of that.
    """

    start: float
    stop: float
    rule: str
    vertices: tuple[int, ...]
    left: float
    needed: float


class Placing(NamedTuple):
    """What placing a shape after it is laid out adds to its errors.

    Attributes
    ----------
    offset : float
        Greatest coordinate of the centre.
    least_area, greatest_area : float
        Of the shape after it was scaled; 0 where shapes may be left as they are laid out.
    """

    offset: float
    least_area: float
    greatest_area: float


class Layout(NamedTuple):
    """What is known of a motion between neighbouring times, k of them.

    Attributes
    ----------
    low, high : ndarray of float64, shape (m, 3, k-1)
        Bounds of the angles at a, b, c, in tree order.
    near, far : ndarray of float64, shape (m, k-1)
        Bounds of the lengths of bases; nan where they follow from those of the parent.
    slack : ndarray of float64, shape (n, k-1)
        What vertices have left below 2 pi.
    """

    low: NDArray[np.float64]
    high: NDArray[np.float64]
    near: NDArray[np.float64]
    far: NDArray[np.float64]
    slack: NDArray[np.float64]


def first_doubt(
    layout: Callable[[NDArray[np.float64]], Layout],
    corners: NDArray[np.int64],
    children: NDArray[np.int64],
    placing: Placing,
    moves: Callable[[float, float], float],
    stop: float = 1.0,
    ends: tuple[bool, bool] = (True, True),
) -> Doubt | tuple[float, float]:
    """Prove that a motion is valid in doubles, or tell where that fails.

    Parameters
    ----------
    layout : callable
        From times, shape (k,), to what is known between them.
    corners : ndarray of int, shape (m, 3)
        Corners a, b, c of each triangle in tree order.
    children : ndarray of int, shape (m, 3)
        Triangles that hang on bc, on ca and, for the root, on ab; -1 for none.
    placing : Placing
    moves : callable
        From two times to how far a vertex moves between them, as a share of the width.
    stop : float
        The motion is looked at from 0 to there.
    ends : (bool, bool)
        Whether the shape at 0, and that at 1, may serve for times close to them.

    Returns
    -------
    Doubt, or (float, float)
        The first one; or the times up to which the shape at 0, and from which on that at 1, serves.
    """
    times = np.linspace(0.0, stop, _FEW + 1)
    intervals = np.stack([times[:-1], times[1:]], axis=1)
    snaps = [0.0, 1.0]
    while len(intervals):
        knots, which = np.unique(intervals, return_inverse=True)
        found = check_intervals(corners, children, *layout(knots), np.array(placing))[which.reshape(-1, 2)[:, 0]]
        bad = np.flatnonzero(found[:, 0] != _FINE)
        again = []
        for (start, end), row in zip(intervals[bad].tolist(), found[bad].tolist(), strict=True):
            if ends[0] and end <= _SNAP and moves(0.0, end) < _JUMP:
                snaps[0] = max(snaps[0], end)
            elif ends[1] and 1.0 - start <= _SNAP and moves(start, 1.0) < _JUMP:
                snaps[1] = min(snaps[1], start)
            elif end - start <= _shortest(start, end) or len(bad) > _MOST:
                return _doubt(corners, start, end, row)
            else:
                again.append(cut(start, end))
        intervals = np.concatenate(again) if again else np.empty((0, 2))
    return snaps[0], snaps[1]


def _shortest(start: float, end: float) -> float:
    """The length at which an interval is cut no more."""
    return _LEAST_SNAP if start == 0.0 or end == 1.0 else _SHORTEST * min(start, 1.0 - end)


def _doubt(corners: NDArray[np.int64], start: float, end: float, row: list[float]) -> Doubt:
    rule, element = ("", "triangle", "vertex", "range")[int(row[0])], int(row[1])
    vertices = tuple(corners[element].tolist()) if rule == "triangle" else (element,)
    return Doubt(start, end, rule, vertices, *row[2:])


def cut(start: float, end: float) -> NDArray[np.float64]:
    """Cut an interval of time in four; one at an end of the motion in a geometric progression towards it.

    Parameters
    ----------
    start, end : float

    Returns
    -------
    ndarray of float64, shape (p, 2)
        Four, or fewer where there are not enough doubles between start and end.
    """
    share = np.linspace(0.0, 1.0, _PARTS + 1)
    if start == 0.0:
        share = np.array([0.0, 2.0**-6, 2.0**-4, 2.0**-2, 1.0])
    elif end == 1.0:
        share = 1.0 - np.array([1.0, 2.0**-2, 2.0**-4, 2.0**-6, 0.0])
    knots = start + share * (end - start)
    knots[-1] = end
    parts = np.stack([knots[:-1], knots[1:]], axis=1)
    return parts[parts[:, 0] < parts[:, 1]]


@njit(cache=True, error_model="numpy")
def _sines(low, high, f, least, greatest):
    """The least and the greatest sine of each angle, (m, 3), within bounds, (m, 3, k), in interval f."""
    first, last = least.ravel(), greatest.ravel()
    for i in range(len(low)):
        for s in range(3):
            least[i, s], greatest[i, s] = low[i, s, f], high[i, s, f]
    for j in range(first.size):  # without branches, for several at a time
        p, q = max(first[j] - _ANGLE_ERROR, 0.0), min(last[j] + _ANGLE_ERROR, math.pi)
        sine, other = sine_up_to_pi(p), max(sine_up_to_pi(q), 0.0)
        first[j], last[j] = min(sine, other), 1.0 if p < 0.5 * math.pi < q else max(sine, other)


@njit(cache=True)
def check_intervals(corners, children, low, high, near, far, slack, placing):
    """For each interval what is in doubt there: code, element, what there is and what is needed; shape (k, 4)."""
    m, intervals = near.shape
    found = np.zeros((intervals, 4))
    way, errors, spent = np.empty(m + 2), np.empty(m + 2), np.empty(m + 2)
    depth, edges, heights, least, greatest = (
        np.zeros(m),
        np.empty((m, 2)),
        np.empty(m),
        np.empty((m, 3)),
        np.empty((m, 3)),
    )
    for f in range(intervals):
        _sines(low, high, f, least, greatest)
        areas = _carry(corners, children, least, greatest, near, far, f, depth, way, errors, edges, heights)
        extent = way.max()
        shrunk, grown = 1.0, 1.0
        if placing[1] > 0.0:
            shrunk = min(1.0, math.sqrt(placing[1] / areas[1]))
            grown = max(1.0, math.sqrt(placing[2] / areas[0])) if areas[0] > 0.0 else math.inf
        if not (extent * grown + placing[0] < EXACT_RANGE[1]) or not extent * shrunk > 0.0:
            found[f, 0], found[f, 1], found[f, 2] = _RANGE, np.argmax(way), extent * grown + placing[0]
            continue
        errors += _UNIT * (24.0 * extent + 4.0 * placing[0] / shrunk) + 2.0 * EXACT_RANGE[0] / shrunk
        spent[:] = 0.0
        _spend(corners, children, f, near, errors, edges, least, greatest, spent)
        _judge(corners, heights, errors, spent, slack, f, found)
    return found


@njit(cache=True, inline="always")
def _carry(corners, children, least, greatest, near, far, f, depth, way, errors, edges, heights):
    """Carry lengths and errors down the tree, and least heights; returns bounds of the total area."""
    smallest, largest = 0.0, 0.0
    way[corners[0, 0]], way[corners[0, 1]] = 0.0, far[0, f]
    errors[corners[0, 0]], errors[corners[0, 1]] = 0.0, 0.0
    for i in range(len(corners)):
        a, c = corners[i, 0], corners[i, 2]
        a0, b0, c0 = least[i, 0], least[i, 1], least[i, 2]
        a1, b1, c1 = greatest[i, 0], greatest[i, 1], greatest[i, 2]
        shorter, longer = near[i, f] / c1, (far[i, f] / c0 if c0 > 0.0 else math.inf)
        bc, ca = (a0 * shorter, a1 * longer), (b0 * shorter, b1 * longer)
        edges[i, 0], edges[i, 1] = bc[0], ca[0]
        heights[i] = min(max(ca[0] * a0, bc[0] * b0), near[i, f] * min(a0, b0))
        smallest += 0.5 * near[i, f] * max(ca[0] * a0, bc[0] * b0)
        largest += 0.5 * far[i, f] * min(ca[1] * a1, bc[1] * b1)
        way[c] = way[a] + ca[1]
        errors[c] = errors[a] + _UNIT * (8.0 * (depth[i] + 1.0) * ca[1] + 2.0 * way[c])
        for s in range(3 if i == 0 else 2):
            child = children[i, s]
            if child >= 0:
                depth[child] = depth[i] + 1.0
                if not near[child, f] >= 0.0:
                    ends = bc if s == 0 else (ca if s == 1 else (near[0, f], far[0, f]))
                    near[child, f], far[child, f] = ends
    return smallest, largest


@njit(cache=True, inline="always")
def _spend(corners, children, f, near, errors, edges, least, greatest, spent):
    """Add up what each vertex needs: the turns of its boundary edges, and the roundings of its angles."""
    for i in range(len(corners)):
        a, b, c = corners[i, 0], corners[i, 1], corners[i, 2]
        a0, b1 = least[i, 0], greatest[i, 1]  # sines
        of_z = _ANGLE_ERROR * (2.0 + (b1 / a0 if a0 > 0.0 else math.inf))
        spent[a] += 2.0 * _ANGLE_ERROR
        spent[b] += of_z
        spent[c] += of_z
        for s in range(3 if i == 0 else 2):
            if children[i, s] < 0:
                p, q, length = (
                    (b, c, edges[i, 0]) if s == 0 else ((c, a, edges[i, 1]) if s == 1 else (a, b, near[0, f]))
                )
                turn = 1.6 * (errors[p] + errors[q]) / length if length > 0.0 else math.inf
                spent[p] += turn
                spent[q] += turn


@njit(cache=True, inline="always")
def _judge(corners, heights, errors, spent, slack, f, found):
    """Write down the triangle that is too low, or else the vertex that has too little left."""
    for i in range(len(corners)):
        needed = 2.1 * max(errors[corners[i, 0]], errors[corners[i, 1]], errors[corners[i, 2]])
        if not heights[i] > needed:
            found[f, 0], found[f, 1], found[f, 2], found[f, 3] = _TRIANGLE, i, heights[i], needed
            return
    for v in range(len(spent)):
        if not spent[v] < slack[v, f]:
            found[f, 0], found[f, 1], found[f, 2], found[f, 3] = _VERTEX, v, slack[v, f], spent[v]
            return

"""Midpoints on the edges of a curve, so placed that no rounding of theirs decides anything.

A midpoint that is rounded lies beside its edge by a last bit.  If it lay outside, the flat triangle of the edge and
the midpoint would be a triangle like any other: all of its angles come from rounding, and what hangs on it leaps.  So
on an edge where rounding is needed at all, the midpoints are moved inwards by a few last bits, onto a parabola: the
curve has a dent there, which turns right at every midpoint, and no three points of it make a counter-clockwise
triangle.
"""

import heapq
import math

import numpy as np
from numpy.typing import NDArray

from tween.errors import CurveError
from tween.geometry.predicates import orient2d

_BITS = 16.0 * 2.0**-52  # by which neighbours on a dent turn, of the largest coordinate
_DEEPEST = 2.0**-20  # of the edge


def halve_longest_edges(
    points: NDArray[np.float64], origin: NDArray[np.intp], count: int
) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Halve the longest edge until there are enough vertices.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
    origin : ndarray of int, shape (n,)
    count : int

    Returns
    -------
    points : ndarray of float64, shape (count, 2)
    origin : ndarray of int, shape (count,)
        -1 for midpoints.

    Raises
    ------
    CurveError
        Where an edge is too short to be halved.
    """
    n = len(points)
    heap = []
    for i in range(n):
        a, b = points[i], points[(i + 1) % n]
        # math.hypot is Python's own; the last bit of numpy's is the platform's, and would decide between equal edges.
        heap.append((-math.hypot(*(b - a)), float(i), tuple(a), tuple(b), 1.0))
    heapq.heapify(heap)
    inserted = []
    for _ in range(count - n):
        length, position, a, b, span = heapq.heappop(heap)
        middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
        if middle in (a, b):
            raise CurveError(f"edge at ({a[0]:g}, {a[1]:g}) is too short to be halved further")
        inserted.append((position + span / 2, middle))
        heapq.heappush(heap, (length / 2, position, a, middle, span / 2))
        heapq.heappush(heap, (length / 2, position + span / 2, middle, b, span / 2))
    positions = np.array([*range(n), *(position for position, _ in inserted)])
    rows = np.concatenate([points, np.reshape([m for _, m in inserted], (-1, 2))])
    order = np.argsort(positions)
    return rows[order], np.concatenate([origin, np.full(count - n, -1)])[order]


def dented(points: NDArray[np.float64], origin: NDArray[np.intp]) -> NDArray[np.float64]:
    """Move the midpoints on edges that are no exact lines inwards, by a few last bits.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
        Counter-clockwise.
    origin : ndarray of int, shape (n,)
        -1 for midpoints.

    Returns
    -------
    ndarray of float64, shape (n, 2)
        The same points where all midpoints of an edge lie on it exactly.

    Notes
    -----
    The depth is the least at which every three points turn right by more than their rounding, but no more than a
    millionth of the edge.  O(n).
    """
    moved = points.copy()
    given = np.flatnonzero(origin >= 0)
    for start, stop in zip(given, [*given[1:], given[0] + len(points)], strict=True):
        inner = np.arange(start + 1, stop) % len(points)
        a, b = points[start], points[stop % len(points)]
        first, last = (np.broadcast_to(end, (len(inner), 2)) for end in (a, b))
        if not len(inner) or not orient2d(first, last, points[inner]).any():
            continue
        edge = b - a
        length = math.hypot(*edge)
        share = np.hypot(*(points[inner] - a).T) / length
        gap = np.diff([0.0, *share, 1.0]).min()
        depth = min(_BITS * np.abs([a, b]).max() / (4.0 * gap * gap), _DEEPEST * length)
        inwards = np.array([-edge[1], edge[0]]) / length
        moved[inner] = points[inner] + (4.0 * depth * share * (1.0 - share))[:, None] * inwards
    return moved

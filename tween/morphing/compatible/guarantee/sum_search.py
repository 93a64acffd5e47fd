"""Whose angles may add up to 2 pi: sums of bounds, in few long intervals of time, and in their parts where in doubt.

Most vertices are far below 2 pi.  So time is cut into 16 long intervals; each of these into 8 parts for the vertices
that are in doubt in some long interval, and only where they have little left.  A *cell* is a triangle in a long
interval; the angles of those at such vertices are bounded anew, in all parts.

Legend: ``m`` triangles; ``n`` vertices; ``l`` long intervals; ``f`` number of one; ``g`` number of a part.
"""

import math
from collections.abc import Callable

import numpy as np
from numba import njit
from numpy.typing import NDArray

ROUNDING = 1e-9
"""Of a sum of angles, in radians."""

_FEW_TIMES, _TIMES = 17, 129  # at which angles are looked at
_PARTS = (_TIMES - 1) // (_FEW_TIMES - 1)  # of a long interval
_AT_ONCE = 2**12  # cells that are looked at together, needed or not, as that is quicker than one interval after another
_ENOUGH = 2.0**-7  # radians left in a long interval, which then need not be divided


class SumSearch:
    """Bounds of all angles in long intervals of time, and where these do not do, in their parts.

    Parameters
    ----------
    corners : ndarray of int, shape (m, 3)
    first, last : ndarray of float64, shape (m, 3)
        Angles at these corners at times 0 and 1.
    bounds : callable
        As for `.angle_budgets.proved_budgets`.
    """

    def __init__(
        self,
        corners: NDArray[np.int64],
        first: NDArray[np.float64],
        last: NDArray[np.float64],
        bounds: Callable[[NDArray[np.float64], NDArray[np.int64]], NDArray[np.float64]],
    ) -> None:
        self._corners, self._first, self._last, self._bounds = corners, first, last, bounds
        self._few, self._many = np.linspace(0.0, 1.0, _FEW_TIMES), np.linspace(0.0, 1.0, _TIMES)
        self._rough = bounds(self._few, np.arange(len(corners)))
        self._plain: NDArray[np.bool_] = np.zeros(len(corners), dtype=np.bool_)
        self._slack, self._asked = np.zeros(corners.max() + 1), np.ones(corners.max() + 1, dtype=np.bool_)
        # cells are numbered as they come: they are few, and so lie close together
        most = len(corners) * (_FEW_TIMES - 1)
        self._cells, self._count = np.full((len(corners), _FEW_TIMES - 1), -1), 0
        self._fine = np.empty((most, 3, _PARTS))
        self._rows, self._starts = np.empty(most, np.int64), np.empty(most, np.int64)

    def slack(self, settled: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Tell what vertices have left below 2 pi at all times.

        Parameters
        ----------
        settled : ndarray of bool, shape (n,)
            Vertices for which this is not asked.

        Returns
        -------
        ndarray of float64, shape (n,)
            Radians, less 1e-9 for roundings.
        """
        asked = self._asked & ~settled  # the bounds at others are what they were
        slack, doubtful, fresh = _in_long_intervals(self._corners, self._rough, asked, self._cells)
        if doubtful.any():
            self._refine(fresh)
            _in_their_parts(doubtful, self._corners, self._fine, self._cells, slack)
        self._slack[asked] = slack[asked].min(axis=1)
        return self._slack.copy()

    def reach_plain(self, vertices: NDArray[np.bool_]) -> None:
        """Let the bounds of triangles with a budgeted corner reach the path "angle".

        Parameters
        ----------
        vertices : ndarray of bool, shape (n,)
            Which have a budget: those of the last time, and more.
        """
        a, b, c = self._corners.T
        before, self._plain = self._plain, vertices[a] | vertices[b] | vertices[c]
        rows = self._plain & ~before
        every, start = np.arange(len(rows)), np.zeros(len(rows), np.int64)
        _reach_plain(self._rough, rows, every, start, self._first, self._last, self._few)
        self._reach_plain(rows, 0)
        self._asked[:] = False
        self._asked[self._corners[rows]] = True

    def _refine(self, fresh: NDArray[np.bool_]) -> None:
        """Bound the angles of cells, (m, l), in their parts, and those of others in intervals beside."""
        rows, known = np.flatnonzero(fresh.any(axis=1)), self._count
        width = min(fresh.shape[1], max(1, _AT_ONCE // max(1, len(rows))))
        for f in range(0, fresh.shape[1], width):
            rows = np.flatnonzero(fresh[:, f : f + width].any(axis=1))
            if len(rows):
                self._bound(rows, f, min(f + width, fresh.shape[1]))
        self._reach_plain(self._plain, known)

    def _bound(self, rows: NDArray[np.int64], start: int, stop: int) -> None:
        """Bound the angles of some triangles in the parts of some long intervals."""
        angles = self._bounds(self._many[start * _PARTS : stop * _PARTS + 1], rows)
        self._count = _keep(angles, rows, start, self._cells, self._count, self._fine, self._rows, self._starts)

    def _reach_plain(self, triangles: NDArray[np.bool_], first: int) -> None:
        """Let the bounds in the parts of cells from a first one on, where of some triangles, reach the path "angle"."""
        cells = slice(first, self._count)
        rows, starts = self._rows[cells], self._starts[cells]
        _reach_plain(self._fine[cells], triangles[rows], rows, starts, self._first, self._last, self._many)


@njit(cache=True)
def _left(total):
    """What a sum of angles leaves below 2 pi; nothing where it is not known."""
    return (2.0 * math.pi - total if total == total else -1.0) - ROUNDING


@njit(cache=True)
def _in_long_intervals(corners, angles, asked, cells):
    """What vertices asked for have left in long intervals, (n, l), which are in doubt, and cells that are missing."""
    slack = np.zeros((len(asked), cells.shape[1]))
    doubtful, fresh = np.zeros(slack.shape, np.bool_), np.zeros(cells.shape, np.bool_)
    for i in range(len(corners)):
        for s in range(3):
            for f in range(slack.shape[1] if asked[corners[i, s]] else 0):
                slack[corners[i, s], f] += angles[i, s, f]
    for v in np.flatnonzero(asked):
        for f in range(slack.shape[1]):
            slack[v, f] = _left(slack[v, f])
        if slack[v].min() <= 0.0:
            for f in range(slack.shape[1]):
                doubtful[v, f] = slack[v, f] <= _ENOUGH
    for i in range(len(corners)):
        for v in corners[i]:
            for f in range(slack.shape[1] if asked[v] else 0):
                fresh[i, f] |= doubtful[v, f] and cells[i, f] < 0
    return slack, doubtful, fresh


@njit(cache=True)
def _keep(angles, rows, start, cells, count, fine, rows_of_cells, starts):
    """Write bounds of angles, (r, 3, k), in parts of long intervals from a first one on to new cells; their number."""
    parts = fine.shape[2]
    for j in range(len(rows)):
        for f in range(angles.shape[2] // parts):
            if cells[rows[j], start + f] < 0:
                cells[rows[j], start + f], rows_of_cells[count], starts[count] = count, rows[j], (start + f) * parts
                for s in range(3):
                    for g in range(parts):
                        fine[count, s, g] = angles[j, s, f * parts + g]
                count += 1
    return count


@njit(cache=True)
def _reach_plain(angles, which, rows, starts, first, last, times):
    """Raise some bounds of angles, (j, 3, k), of triangles from certain times on to the path "angle"; nan stays nan."""
    for j in np.flatnonzero(which):
        i, start = rows[j], starts[j]
        for s in range(3):
            before = (1 - times[start]) * first[i, s] + times[start] * last[i, s]
            for f in range(angles.shape[2]):
                t = times[start + f + 1]
                after = (1 - t) * first[i, s] + t * last[i, s]
                angles[j, s, f] = max(angles[j, s, f], max(before, after)) if angles[j, s, f] >= 0.0 else math.nan
                before = after


@njit(cache=True)
def _in_their_parts(doubtful, corners, fine, cells, slack):
    """Write what vertices have left in long intervals, (n, l), where in doubt, from bounds in the parts of cells."""
    places, some, count = np.empty(slack.shape, np.int64), np.zeros(len(slack), np.bool_), 0
    for v in range(len(slack)):
        for f in range(slack.shape[1]):
            if doubtful[v, f]:
                places[v, f], some[v], count = count, True, count + 1
    sums = np.zeros((count, fine.shape[2]))
    for i in range(len(corners)):
        for s in range(3):
            v = corners[i, s]
            for f in range(slack.shape[1] if some[v] else 0):
                if doubtful[v, f]:
                    for g in range(fine.shape[2]):
                        sums[places[v, f], g] += fine[cells[i, f], s, g]
    for v in range(len(slack)):
        for f in range(slack.shape[1] if some[v] else 0):
            if doubtful[v, f]:
                slack[v, f] = math.inf
                for total in sums[places[v, f]]:
                    slack[v, f] = min(slack[v, f], _left(total))


@njit(cache=True)
def vertex_sums(corners, angles, n):
    """Sums of angles, (m, 3, k), at each of n vertices, (n, k)."""
    sums = np.zeros((n, angles.shape[2]))
    for i in range(len(corners)):
        for s in range(3):
            for f in range(angles.shape[2]):
                sums[corners[i, s], f] += angles[i, s, f]
    return sums

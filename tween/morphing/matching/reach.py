r"""Which pairs of positions a finer level looks at: those with few diagonals of the coarser triangulation between them.

The nodes of the coarser level divide both curves into gaps, gap r from node r to the next; each gap lies before one
triangle.  From a position the dual tree is walked over so many diagonals, and the positions in the gaps that are met
are its partners; so are the nodes on the way from there to ever larger triangles.  So a level costs in proportion to
its positions, whatever the shape.

Legend: ``r`` gap or node; ``p q`` positions.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.growing import longer
from tween.morphing.matching.chords import boundary

ON_NODE = 1e-12
"""Of the curve's length: places nearer to each other are one."""

_FARTHER = 40  # triangles on the way to larger ones


@njit(cache=True)
def gap_ranges(arc, nodes):
    """The positions within each closed gap: the first one and how many; both arrays of shares start at the same place.

    `nodes` ascends from ``nodes[0]`` on, counted around; so do the positions from the first one of gap 0.
    """
    count, m = len(arc), len(nodes)
    shift = 0
    ahead = np.empty(count)
    for p in range(count):
        ahead[p] = _ahead(arc[p], nodes[0])
        if ahead[p] < ahead[shift]:
            shift = p
    low, size = np.empty(m, np.int64), np.empty(m, np.int64)
    begin, end = 0, 0
    for r in range(m):
        start = _ahead(nodes[r], nodes[0]) if r > 0 else 0.0
        stop = _ahead(nodes[r + 1], nodes[0]) if r + 1 < m else 1.0
        while begin < count and ahead[(shift + begin) % count] < start - ON_NODE:
            begin += 1
        end = max(end, begin)
        while end < count and ahead[(shift + end) % count] <= stop + ON_NODE:
            end += 1
        low[r], size[r] = (shift + begin) % count, end - begin + (1 if r + 1 == m else 0)
    return low, size


@njit(cache=True)
def _ahead(x, start):
    """How far x lies ahead of a place on a ring of length 1; next to nothing behind it counts as there."""
    d = (x - start) % 1.0
    return 0.0 if d > 1.0 - ON_NODE else d


def near_pairs(
    arc: NDArray[np.float64],
    nodes: NDArray[np.float64],
    points: NDArray[np.float64],
    triangles: NDArray[np.int64],
    twin: NDArray[np.int64],
    steps: int,
    enough: int,
) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Find the partners of each position.

    Parameters
    ----------
    arc : ndarray of float64, shape (p,)
        Places of the positions, ascending around the curve.
    nodes : ndarray of float64, shape (m,)
        Places of the coarser level's nodes.
    points : ndarray of float64, shape (m, 2)
        The nodes themselves.
    triangles : ndarray of int, shape (m-2, 3)
    twin : ndarray of int, shape (3 * (m-2),)
    steps : int
        Diagonals that may lie between two positions.
    enough : int
        Where a position has so many partners, none are looked for beyond the next two diagonals.

    Returns
    -------
    first : ndarray of int, shape (p + 1,)
    end : ndarray of int32
        Rows as in `.chords.Chords`: the partners of p are ``end[first[p] : first[p + 1]]``.
    """
    count, (low, size) = len(arc), gap_ranges(arc, nodes)
    across = _longest_sides(points, triangles)
    first, end = _near(count, low, size, triangles, twin, across, steps, enough)
    start = np.repeat(np.arange(count), np.diff(first))
    both = np.concatenate([start * count + (end - start) % count, end * count + (start - end) % count])
    start, ahead = np.divmod(np.unique(both), count)
    return np.searchsorted(start, np.arange(count + 1)), ((start + ahead) % count).astype(np.int32)


def _longest_sides(points: NDArray[np.float64], triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    """The longest side of each triangle: slot s is the side from corner s to the next."""
    corners = points[triangles]
    sides = np.roll(corners, -1, axis=1) - corners
    sides /= np.abs(sides).max()
    # in single precision, so that equal sides tie and the first is taken
    longest: NDArray[np.int64] = np.argmax(np.hypot(sides[..., 0], sides[..., 1]).astype(np.float32), axis=1)
    return longest


@njit(cache=True)
def _near(count, low, size, triangles, twin, across, steps, enough):
    """The partners of each position, in the order in which they are met."""
    out = boundary(triangles, twin)
    first, end, filled = np.zeros(count + 1, np.int64), np.empty(16 * count, np.int32), 0
    gap_start, gap_list = _gaps_of_positions(count, low, size)
    seen, met = np.full(len(triangles), -1, np.int64), np.full(count, -1, np.int64)
    queue, depth = np.empty(len(triangles), np.int64), np.empty(len(triangles), np.int64)
    for p in range(count):
        tail = 0
        for r in gap_list[gap_start[p] : gap_start[p + 1]]:
            if seen[out[r] // 3] != p:
                seen[out[r] // 3], queue[tail], depth[tail], tail = p, out[r] // 3, 0, tail + 1
        begin, head = filled, 0
        while head < tail:
            t = queue[head]
            for s in range(3):
                g = twin[3 * t + s]
                if g < 0:
                    r = triangles[t, s]
                    for step in range(size[r]):
                        q = (low[r] + step) % count
                        if met[q] != p and q != p:
                            met[q] = p
                            if filled == len(end):
                                end = longer(end)
                            end[filled], filled = q, filled + 1
                elif seen[g // 3] != p and (depth[head] < steps if filled - begin < enough else depth[head] < 2):
                    seen[g // 3], queue[tail], depth[tail], tail = p, g // 3, depth[head] + 1, tail + 1
            head += 1
        # beyond, only the nodes met on the way to ever larger triangles: they see what small ones beside p do not
        t, h = queue[0], np.int64(-1)
        for _ in range(_FARTHER):
            if filled + 3 > len(end):
                end = longer(end)
            for s in range(3):
                q = low[triangles[t, s]] if size[triangles[t, s]] > 0 else p
                if met[q] != p and q != p:
                    met[q] = p
                    end[filled], filled = q, filled + 1
            g = twin[3 * t + across[t]]
            if g < 0 or 3 * t + across[t] == h:
                break
            t, h = g // 3, g
        first[p + 1] = filled
    return first, end[:filled].copy()


@njit(cache=True, inline="always")
def _gaps_of_positions(count, low, size):
    """For every position the gaps that it lies in: two where it is a node."""
    start = np.zeros(count + 1, np.int64)
    for r in range(len(low)):
        for step in range(size[r]):
            start[(low[r] + step) % count + 1] += 1
    start = np.cumsum(start)
    fill, gaps = start[:-1].copy(), np.empty(start[-1], np.int64)
    for r in range(len(low)):
        for step in range(size[r]):
            p = (low[r] + step) % count
            gaps[fill[p]] = r
            fill[p] += 1
    return start, gaps

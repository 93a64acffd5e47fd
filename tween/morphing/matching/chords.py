r"""What one curve alone contributes to the matching: positions, the chords between them, and the splits of chords.

A *position* is a vertex of the curve or a candidate on one of its edges.  The *chord* (i, j) stands for the part of the
curve from position i on to position j, cut off by the segment between them.  It is

    PIECE     i and j lie on one closed edge, j after i: the part is a piece of that edge
    STRAIGHT  the segment runs inside the immersed disk and meets its curve at the two ends only
    ROUND     i and j lie on one closed edge, i after j: the part is all the rest of the curve

and a *split* of (i, j) is a position k between such that (i, k) and (k, j) are chords and i, k, j is a
counter-clockwise triangle.  Three positions on one line of edges never make a triangle, whatever the signs of their
rounded coordinates.

Whether a chord is straight is decided by a walk from i to j through the triangles of the immersed disk that is meant.

Legend: ``p q`` positions; ``v y z w`` vertices; ``h g`` half-edges ``3 t + s``; ``i k j`` as above.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.growing import more_rows
from tween.geometry.predicates import turn
from tween.morphing.matching.flatness import side_of

PIECE, STRAIGHT, ROUND = 1, 2, 3
_NONE = 0


class Positions(NamedTuple):
    """Vertices of a curve and candidates on its edges, in order; position 0 is vertex 0.

    Attributes
    ----------
    points : ndarray of float64, shape (p, 2)
        As they will be returned.
    scaled : ndarray of float64, shape (p, 2)
        The same, about the centre of the curve and with the disk scaled to area 1.
    vertex : ndarray of int, shape (p,)
        Number of the vertex; -1 for candidates.
    edge : ndarray of int, shape (p,)
        The edge from vertex i to the next is number i; the one that follows where the position is a vertex.
    lines : ndarray of int, shape (p, 2)
        The straight lines of edges that end and that begin there; twice the same for candidates.
    arc : ndarray of float64, shape (p,)
        Where they lie along the whole curve, as a share of its length.
    """

    points: NDArray[np.float64]
    scaled: NDArray[np.float64]
    vertex: NDArray[np.int64]
    edge: NDArray[np.int64]
    lines: NDArray[np.int64]
    arc: NDArray[np.float64]


class Disk(NamedTuple):
    """The triangles of the immersed disk, for walks through it.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 2)
    triangles : ndarray of int, shape (n-2, 3)
    twin : ndarray of int, shape (3 * (n-2),)
        Half-edge across each half-edge; -1 on the curve.
    out : ndarray of int, shape (n,)
        Half-edge from each vertex to its successor on the curve.
    flat : float
        See `.flatness.side_of`.
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    twin: NDArray[np.int64]
    out: NDArray[np.int64]
    flat: float


class Chords(NamedTuple):
    """Chords in rows by their first position, within a row by their second, counted on along the curve.

    Attributes
    ----------
    first : ndarray of int, shape (p + 1,)
        The chords from position i are ``first[i] : first[i + 1]``.
    start, end : ndarray of int32, shape (c,)
    kind : ndarray of int8, shape (c,)
        PIECE, STRAIGHT or ROUND.
    """

    first: NDArray[np.int64]
    start: NDArray[np.int32]
    end: NDArray[np.int32]
    kind: NDArray[np.int8]


class Splits(NamedTuple):
    """Triangles i, k, j: chords left (i, k), right (k, j), whole (i, j), and what the energy needs of them.

    Attributes
    ----------
    left, right, whole : ndarray of int32, shape (s,)
    end : ndarray of int32, shape (s,)
        The position j.
    first_length, second_length : ndarray of float64, shape (s,)
        Squared lengths of ik and kj, scaled.
    product : ndarray of float64, shape (s,)
        Scalar product of ik and kj.
    cross : ndarray of float64, shape (s,)
        Twice the area; positive.
    inverse : ndarray of float64, shape (s,)
        Half of one over `cross`.
    """

    left: NDArray[np.int32]
    right: NDArray[np.int32]
    whole: NDArray[np.int32]
    end: NDArray[np.int32]
    first_length: NDArray[np.float64]
    second_length: NDArray[np.float64]
    product: NDArray[np.float64]
    cross: NDArray[np.float64]
    inverse: NDArray[np.float64]


@njit(cache=True)
def boundary(triangles, twin):
    """The half-edge that leaves each vertex along the curve."""
    out = np.empty(len(triangles) + 2, np.int64)
    for h in range(len(twin)):
        if twin[h] < 0:
            out[triangles[h // 3, h % 3]] = h
    return out


@njit(cache=True)
def straight_lines(points):
    """Number the edges of a curve by straight line, edges that continue one another straight on alike."""
    n = len(points)
    line, corners = np.empty(n, np.int64), 0
    for v in range(n):
        corners += turn(points, v - 1, v, (v + 1) % n) != 0
        line[v] = corners - 1  # -1 before the first corner: those edges continue the last ones
    for v in range(n):
        if line[v] < 0:
            line[v] = corners - 1
    return line


def all_pairs(count: int) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """All positions as partners of each, rows as in `Chords`.

    Parameters
    ----------
    count : int
        Number of positions.

    Returns
    -------
    start : ndarray of int64, shape (count + 1,)
        Where the row of each position begins.
    partners : ndarray of int32
        The rows, one after the other.
    """
    end = (np.arange(count)[:, None] + np.arange(1, count)) % count
    return np.arange(count + 1) * (count - 1), end.ravel().astype(np.int32)


@njit(cache=True)
def find_chords(positions, disk, first, end, forward):
    """Keep the proposed pairs that are chords; where `forward`, only those from a smaller to a larger number."""
    count = len(positions.points)
    rows, size = np.zeros(count + 1, np.int64), 0
    starts, ends, kinds = np.empty(len(end), np.int32), np.empty(len(end), np.int32), np.empty(len(end), np.int8)
    for p in range(count):
        for q in end[first[p] : first[p + 1]]:
            if forward and q < p:
                continue
            kind = _kind(positions, disk, p, q)
            if kind != _NONE:
                starts[size], ends[size], kinds[size] = p, q, kind
                size += 1
        rows[p + 1] = size
    return Chords(rows, starts[:size].copy(), ends[:size].copy(), kinds[:size].copy())


@njit(cache=True, inline="always")
def _kind(positions, disk, p, q):
    n = len(disk.points)
    if _on_edge(positions, p, q, n):
        return PIECE
    if _on_edge(positions, q, p, n):
        return ROUND
    if shares_line(positions.lines, p, q):
        return _NONE
    return STRAIGHT if _sees(positions, disk, p, q) else _NONE


@njit(cache=True, inline="always")
def _on_edge(positions, p, q, n):
    """Whether q lies on the edge that follows p, or on which p lies, at or after p."""
    e = positions.edge[p]
    if positions.edge[q] == e:
        return positions.vertex[q] < 0 and (positions.vertex[p] >= 0 or p < q)
    return positions.vertex[q] == (e + 1) % n


@njit(cache=True, inline="always")
def shares_line(lines, p, q):
    """Whether two positions lie on one line of edges."""
    a, b, c, d = lines[p, 0], lines[p, 1], lines[q, 0], lines[q, 1]
    return a == c or a == d or b == c or b == d


@njit(cache=True, inline="always")
def _on_one_line(lines, i, k, j):
    """Whether three positions lie on one line of edges."""
    for s in range(2):
        line = lines[i, s]
        if (line == lines[k, 0] or line == lines[k, 1]) and (line == lines[j, 0] or line == lines[j, 1]):
            return True
    return False


@njit(cache=True, inline="always")
def _sees(positions, disk, p, q):
    """Whether the segment from p to q runs inside the disk, its ends excepted: walk along it from p."""
    points, triangles, twin = disk.points, disk.triangles, disk.twin
    start, goal, goal_vertex = positions.points[p], positions.points[q], positions.vertex[q]
    g = disk.out[positions.edge[p]]
    if positions.vertex[p] >= 0:
        g = _sector(disk, g, goal, goal_vertex)
        if g < 0:
            return g == -2
        if positions.vertex[q] < 0 and g == disk.out[positions.edge[q]]:
            return True
        g = twin[g]
    while g >= 0:
        # invariant: the segment enters the triangle of g through g, with its start at the left
        t, s = g // 3, g % 3
        left, right, w = triangles[t, s], triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3]
        if w == goal_vertex:
            return True
        if side_of(points[left], points[right], goal, disk.flat) <= 0:
            return False
        side = side_of(start, goal, points[w], disk.flat)
        if side == 0:
            return False
        h = 3 * t + (s + 1) % 3 if side > 0 else 3 * t + (s + 2) % 3
        if goal_vertex < 0 and h == disk.out[positions.edge[q]]:
            return True
        g = twin[h]
    return False


@njit(cache=True, inline="always")
def _sector(disk, h, goal, goal_vertex):
    """At a vertex, the half-edge opposite in the triangle that a segment enters; -2 where it ends there, -1 if none."""
    triangles, twin = disk.triangles, disk.twin
    v = disk.points[triangles[h // 3, h % 3]]
    while h >= 0:
        t, s = h // 3, h % 3
        y, z = triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3]
        if y == goal_vertex or z == goal_vertex:
            return -2
        if side_of(v, disk.points[y], goal, disk.flat) > 0 and side_of(v, goal, disk.points[z], disk.flat) > 0:
            return 3 * t + (s + 1) % 3
        h = twin[3 * t + (s + 2) % 3]
    return -1


def find_splits(
    positions: Positions, chords: Chords, flat: float, by_whole: bool
) -> tuple[Splits, NDArray[np.int64], NDArray[np.int64]]:
    """List the splits, in order of their whole chords or, for the target, of their left ones.

    Parameters
    ----------
    positions : Positions
    chords : Chords
    flat : float
        See `.flatness.side_of`.
    by_whole : bool

    Returns
    -------
    splits : Splits
    first : ndarray of int, shape (c + 1,)
        The splits of chord e are ``first[e] : first[e + 1]``.
    middle : ndarray of int, shape (c,)
        Among those of one left chord the splits of STRAIGHT chords come before those of ROUND ones, which begin here.
    """
    left, right, whole = _triangles(positions, chords, flat)
    count = len(chords.start)
    key = 2 * whole.astype(np.int64) if by_whole else 2 * left.astype(np.int64) + (chords.kind[whole] == ROUND)
    order = np.argsort(key, kind="stable")
    bounds = np.searchsorted(key[order], np.arange(2 * count + 1))
    splits = _measured(positions.scaled, chords, left[order], right[order], whole[order])
    return splits, bounds[::2].copy(), bounds[1::2].copy()


@njit(cache=True)
def _triangles(positions, chords, flat):
    """The chords (i, k), (k, j), (i, j) of every split, in order of i, then k."""
    count, size = len(positions.points), 0
    found = np.empty((4 * len(chords.start) + 16, 3), np.int32)
    chord_to, from_row = np.empty(count, np.int64), np.full(count, -1, np.int64)
    for i in range(count):
        for whole in range(chords.first[i], chords.first[i + 1]):
            chord_to[chords.end[whole]], from_row[chords.end[whole]] = whole, i
        for left in range(chords.first[i], chords.first[i + 1]):
            k = chords.end[left]
            if chords.kind[left] == ROUND:
                continue
            for right in range(chords.first[k], chords.first[k + 1]):
                j = chords.end[right]
                if from_row[j] != i or chords.kind[right] == ROUND:
                    continue
                whole = chord_to[j]
                if whole <= left or chords.kind[whole] == PIECE or not _is_triangle(positions, i, k, j, flat):
                    continue
                if size == len(found):
                    found = more_rows(found)
                found[size, 0], found[size, 1], found[size, 2] = left, right, whole
                size += 1
    return found[:size, 0].copy(), found[:size, 1].copy(), found[:size, 2].copy()


@njit(cache=True, inline="always")
def _is_triangle(positions, i, k, j, flat):
    points = positions.points
    return not _on_one_line(positions.lines, i, k, j) and side_of(points[i], points[k], points[j], flat) > 0


@njit(cache=True)
def _measured(scaled, chords, left, right, whole):
    size = len(left)
    first_length, second_length = np.empty(size), np.empty(size)
    product, cross = np.empty(size), np.empty(size)
    for s in range(size):
        i, k, j = chords.start[left[s]], chords.end[left[s]], chords.end[right[s]]
        ux, uy = scaled[k, 0] - scaled[i, 0], scaled[k, 1] - scaled[i, 1]
        wx, wy = scaled[j, 0] - scaled[k, 0], scaled[j, 1] - scaled[k, 1]
        first_length[s], second_length[s] = ux * ux + uy * uy, wx * wx + wy * wy
        product[s] = ux * wx + uy * wy
        cross[s] = max(ux * wy - uy * wx, 1e-300)  # the sign is exact, the rounded area may vanish
    return Splits(left, right, whole, chords.end[right], first_length, second_length, product, cross, 0.5 / cross)

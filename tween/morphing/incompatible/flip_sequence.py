"""Crossings of two triangulations of one polygon, and flips that turn one into the other (Section 6.2).

Here a triangulation is its triangles alone: on a disk in convex position nothing depends on points.
Two diagonals cross where the ends of one lie on both sides of the other along the boundary.

References
----------
S. Hanke, T. Ottmann, S. Schuierer, *The edge-flipping distance of triangulations*, Journal of Universal
Computer Science 2 (1996) 570-579 (the paper's reference [11]): while two triangulations differ, the
diagonal of one with the most crossings can be flipped, and that reduces the crossings.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.growing import more_rows
from tween.geometry.triangulation import Triangulation
from tween.morphing.incompatible.chord_crossings import chord_crossings, crossings_of_chord, crossings_of_chords
from tween.triangulating.flips import flip_in_place

_NONE = -(2**62)  # crossings removed by the flip of what is no diagonal


class FlipSequence(NamedTuple):
    """Flips that turn one triangulation into another, in order.

    Attributes
    ----------
    rows : ndarray of int, shape (m, 2)
        The two triangles, by row, whose common edge each flip replaces; they keep their rows.
    out, into : ndarray of int, shape (m, 2)
        Ends of the diagonal that gives way, and of the one that comes.
    """

    rows: NDArray[np.int64]
    out: NDArray[np.int64]
    into: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.rows)


def crossing_counts(T: Triangulation) -> NDArray[np.int64]:
    """Count, for every pair of vertices, the diagonals that cross the chord between them.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of int, shape (n, n)
        Symmetric; O(n**2).

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> crossing_counts(T)[1, 3], crossing_counts(T)[0, 2]
    (np.int64(1), np.int64(0))
    """
    n = len(T)
    ends = np.zeros((n + 1, n + 1), np.int64)  # ends[i, j]: directed diagonals from below i to below j
    np.add.at(ends, (T.diagonals[:, 0] + 1, T.diagonals[:, 1] + 1), 1)
    np.add.at(ends, (T.diagonals[:, 1] + 1, T.diagonals[:, 0] + 1), 1)
    ends = ends.cumsum(axis=0).cumsum(axis=1)
    i, j = np.triu_indices(n, 2)
    between_and_before = ends[j, i] - ends[i + 1, i]
    between_and_after = ends[j, n] - ends[i + 1, n] - ends[j, j + 1] + ends[i + 1, j + 1]
    counts = np.zeros((n, n), np.int64)
    counts[i, j] = counts[j, i] = between_and_before + between_and_after
    return counts


def count_crossings(first: Triangulation, second: Triangulation, shift: int = 0) -> int:
    """Count the crossings between the diagonals of two triangulations.

    Parameters
    ----------
    first, second : Triangulation
        With equally many vertices.
    shift : int
        Vertex i of `first` is vertex ``(i + shift) mod n`` of `second`.

    Returns
    -------
    int

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> T = Triangulation(square, [[0, 1, 2], [0, 2, 3]])
    >>> count_crossings(T, T), count_crossings(T, T, shift=1)
    (0, 1)
    """
    return int(crossings_by_shift(first, second, np.array([shift]))[0])


def crossings_by_shift(first: Triangulation, second: Triangulation, shifts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Count the crossings under each of several renumberings.

    Parameters
    ----------
    first, second : Triangulation
    shifts : ndarray of int, shape (k,)

    Returns
    -------
    ndarray of int, shape (k,)
        O(n k log n).
    """
    if len(first) != len(second):
        raise ValueError(f"triangulations have {len(first)} and {len(second)} vertices, expected equal numbers")
    prepared = chord_crossings(second)
    totals = [crossings_of_chords(prepared, (first.diagonals + shift) % len(first)).sum() for shift in shifts]
    return np.array(totals, dtype=np.int64)


def flip_sequence(source: Triangulation, target: Triangulation) -> FlipSequence:
    """Find flips that turn one triangulation of a polygon into another.

    Parameters
    ----------
    source, target : Triangulation
        With equally many vertices; only their triangles matter.

    Returns
    -------
    FlipSequence
        No longer than the number of crossings between the two.

    Notes
    -----
    As in the paper, the target's diagonals are sorted by their crossings with the source, fewest first
    (ties by their ends), and each is inserted by flipping what crosses it.  The paper does not say in
    which order; we take, among the flips that reduce the crossings of that diagonal, the one that
    reduces the crossings with the whole target most, and where none reduces these (rare) the best flip
    elsewhere.  So every flip removes a crossing: the sequence ends, and its length never exceeds their
    number.  O(log n) for each diagonal that crosses, or meets in its ends, the one that is being inserted.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> T = Triangulation(square, [[0, 1, 2], [0, 2, 3]])
    >>> flips = flip_sequence(T, T.rolled(1))
    >>> flips.out.tolist(), flips.into.tolist()
    ([[0, 2]], [[1, 3]])

    References
    ----------
    Mukherjee and Gopi, Section 6.2; Hanke, Ottmann and Schuierer (1996).
    """
    if len(source) != len(target):
        raise ValueError(f"triangulations have {len(source)} and {len(target)} vertices, expected equal numbers")
    wanted = np.sort(target.diagonals, axis=1)
    crossed = crossings_of_chords(chord_crossings(source), wanted)
    wanted = wanted[np.lexsort((wanted[:, 1], wanted[:, 0], crossed))]
    records = _insert_all(source.triangles.copy(), source.twin.copy(), wanted, chord_crossings(target))
    return FlipSequence(records[:, :2], np.sort(records[:, 2:4], axis=1), np.sort(records[:, 4:], axis=1))


@njit(cache=True)
def _cross(a, b, c, d):
    """Whether chord ab crosses chord cd."""
    low, high = min(a, b), max(a, b)  # strictly on both sides: chords that share an end do not cross
    return (low < c < high) != (low < d < high) and c != low and c != high and d != low and d != high


@njit(cache=True)
def _removed(triangles, twin, target, h):
    """How many crossings with the target the flip of half-edge h removes."""
    t, s = h // 3, h % 3
    a, b, c = triangles[t, s], triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3]
    g = twin[t, s]
    d = triangles[g // 3, (g + 2) % 3]
    return crossings_of_chord(target, a, b) - crossings_of_chord(target, c, d)


@njit(cache=True, inline="always")
def _tournament(triangles, twin, target):
    """Binary tree over all half-edges, whose inner nodes hold the larger of their children: crossings removed by flips.

    A diagonal is entered at the smaller of its half-edges.
    """
    size = 1
    while size < twin.size:
        size *= 2
    best = np.full(2 * size, _NONE)
    for h in range(twin.size):
        if twin[h // 3, h % 3] > h:
            best[size + h] = _removed(triangles, twin, target, h)
    for node in range(size - 1, 0, -1):
        best[node] = max(best[2 * node], best[2 * node + 1])
    return best


@njit(cache=True, inline="always")
def _enter(triangles, twin, target, best, t):
    """Enter anew what the flips of the sides of triangle t remove."""
    for s in range(3):
        for h in (3 * t + s, twin[t, s]):
            if h < 0:
                h = 3 * t + s
            node = len(best) // 2 + h
            best[node] = _removed(triangles, twin, target, h) if twin[h // 3, h % 3] > h else _NONE
            while node > 1:
                node //= 2
                best[node] = max(best[2 * node], best[2 * node + 1])


@njit(cache=True, inline="always")
def _winner(best):
    """The first of the half-edges whose flips remove most crossings."""
    node = 1
    while node < len(best) // 2:
        node = 2 * node if best[2 * node] == best[node] else 2 * node + 1
    return node - len(best) // 2


@njit(cache=True, inline="always")
def _best_across(triangles, twin, side, target, p, q):
    """The same among the diagonals that cross the chord pq and whose flip does not: (half-edge, crossings removed).

    Walks from p to q through the triangles; z is the vertex beyond the diagonal just crossed.
    """
    n = len(side)
    best, most = -1, -n * n
    h = _opposite(triangles, twin, side, p, q)
    while h >= 0:
        t, s = h // 3, h % 3
        g = twin[t, s]
        before = triangles[t, (s + 2) % 3]
        z = triangles[g // 3, (g + 2) % 3]
        if not _cross(p, q, before, z):
            removed = _removed(triangles, twin, target, min(h, g))
            if removed > most or (removed == most and min(h, g) < best):
                best, most = min(h, g), removed
        if z == q:
            break
        beyond = (z - p) % n > (q - p) % n
        h = 3 * (g // 3) + (g + (1 if beyond else 2)) % 3
    return best, most


@njit(cache=True, inline="always")
def _opposite(triangles, twin, side, p, q):
    """The half-edge opposite p that the chord pq crosses; -1 where pq is a diagonal or a side itself."""
    n = len(side)
    h = side[p]
    while True:
        t, s = h // 3, h % 3
        x = triangles[t, (s + 2) % 3]
        if (x - p) % n > (q - p) % n:
            return 3 * t + (s + 1) % 3 if triangles[t, (s + 1) % 3] != q else -1
        h = twin[t, (s + 2) % 3]
        if h < 0:
            return -1


@njit(cache=True)
def _find_sides(triangles, twin, side, t):
    """Note which half-edges of triangle t are sides of the polygon, by the vertex where they start."""
    for s in range(3):
        if twin[t, s] < 0:
            side[triangles[t, s]] = 3 * t + s


@njit(cache=True)
def _insert_all(triangles, twin, wanted, target):
    """Insert the wanted diagonals one after the other; a row a flip: two rows, out, into."""
    side = np.empty(len(triangles) + 2, np.int64)
    for t in range(len(triangles)):
        _find_sides(triangles, twin, side, t)
    best = _tournament(triangles, twin, target)
    records, size = np.empty((len(triangles), 6), np.int64), 0
    for i in range(len(wanted)):
        while True:
            h, removed = _best_across(triangles, twin, side, target, wanted[i, 0], wanted[i, 1])
            if h < 0:
                break
            if removed <= 0:
                h = _winner(best)
            if size == len(records):
                records = more_rows(records)
            t, s = h // 3, h % 3
            g = twin[t, s]
            records[size, 0], records[size, 1] = t, g // 3
            records[size, 2], records[size, 3] = triangles[t, s], triangles[t, (s + 1) % 3]
            records[size, 4], records[size, 5] = triangles[t, (s + 2) % 3], triangles[g // 3, (g + 2) % 3]
            flip_in_place(triangles, twin, h)
            for changed in (t, g // 3):
                _find_sides(triangles, twin, side, changed)
                _enter(triangles, twin, target, best, changed)
            size += 1
    return records[:size].copy()

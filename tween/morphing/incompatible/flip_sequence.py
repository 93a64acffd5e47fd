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

from tween.geometry.triangulation import Triangulation
from tween.triangulating.flips import flip_in_place


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
        O(n**2 + n k).
    """
    if len(first) != len(second):
        raise ValueError(f"triangulations have {len(first)} and {len(second)} vertices, expected equal numbers")
    counts = crossing_counts(second)
    i, j = ((first.diagonals[:, e, None] + shifts) % len(first) for e in (0, 1))
    return counts[i, j].sum(axis=0)


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
    number.  O(n) a flip.

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
    crossed = crossing_counts(source)[wanted[:, 0], wanted[:, 1]]
    wanted = wanted[np.lexsort((wanted[:, 1], wanted[:, 0], crossed))]
    counts = crossing_counts(target)
    records = _insert_all(source.triangles.copy(), source.twin.copy(), wanted, counts)
    return FlipSequence(records[:, :2], np.sort(records[:, 2:4], axis=1), np.sort(records[:, 4:], axis=1))


@njit(cache=True)
def _cross(a, b, c, d):
    """Whether chord ab crosses chord cd."""
    low, high = min(a, b), max(a, b)  # strictly on both sides: chords that share an end do not cross
    return (low < c < high) != (low < d < high) and c != low and c != high and d != low and d != high


@njit(cache=True)
def _best_flip(triangles, twin, counts, p, q):
    """The half-edge whose flip removes most crossings, (half-edge, crossings removed).

    Only those count that cross the chord pq and whose flip does not; where p < 0, all count.
    """
    best, most = -1, -counts.size  # fewer than any flip removes
    for h in range(twin.size):
        t, s = h // 3, h % 3
        g = twin[t, s]
        if g < h:  # on the curve, or seen from its other half-edge
            continue
        a, b, c = triangles[t, s], triangles[t, (s + 1) % 3], triangles[t, (s + 2) % 3]
        d = triangles[g // 3, (g + 2) % 3]
        if p >= 0 and (not _cross(p, q, a, b) or _cross(p, q, c, d)):
            continue
        # counts are crossings with the target, which stays: a flip changes no other term of their sum
        removed = counts[a, b] - counts[c, d]
        if removed > most:
            best, most = h, removed
    return best, most


@njit(cache=True)
def _insert_all(triangles, twin, wanted, counts):
    """Insert the wanted diagonals one after the other; a row a flip: two rows, out, into."""
    # each flip removes a crossing or more, so a row for each crossing is enough
    total = 0
    for h in range(twin.size):
        if twin[h // 3, h % 3] > h:
            total += counts[triangles[h // 3, h % 3], triangles[h // 3, (h + 1) % 3]]
    records = np.empty((total, 6), np.int64)
    size = 0
    for i in range(len(wanted)):
        while True:
            h, removed = _best_flip(triangles, twin, counts, wanted[i, 0], wanted[i, 1])
            # what crosses pq next to p has a flip that puts an end at p: so none means that pq is in
            if h < 0:
                break
            if removed <= 0:  # then some flip elsewhere does remove a crossing (Hanke, Ottmann and Schuierer)
                h, removed = _best_flip(triangles, twin, counts, -1, -1)
            t, s = h // 3, h % 3
            g = twin[t, s]
            records[size, 0], records[size, 1] = t, g // 3
            records[size, 2], records[size, 3] = triangles[t, s], triangles[t, (s + 1) % 3]
            records[size, 4], records[size, 5] = triangles[t, (s + 2) % 3], triangles[g // 3, (g + 2) % 3]
            flip_in_place(triangles, twin, h)
            size += 1
    return records[:size]

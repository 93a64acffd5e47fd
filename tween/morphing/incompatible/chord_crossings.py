"""How many diagonals of a triangulation cross a chord: O(log n) each, in O(n log n) memory.

On vertices lo, ..., hi alone, let the *top edges* be those sides and diagonals that no other covers: a path from lo to
hi.  Below a top edge from i to j lies a triangulated polygon of j - i + 1 vertices, so that with its own the top edges
have j - i - 1 diagonals each, and

    diagonals with both ends in lo, ..., hi   =   (hi - lo) - (number of top edges).

A diagonal crosses the chord cd, c < d, where just one of its ends lies strictly between and the other is neither c nor
d.  Of the ends strictly between, take those of diagonals that stay within c, ..., d: they stay within c, ..., d - 1 or
within c + 1, ..., d, or within both where both ends are strictly between.

As diagonals do not cross, the path of top edges goes from lo to the farthest vertex to the right that is not beyond hi,
again and again, as long as the farthest of all is not; the rest of it goes back from hi to the farthest to the left.
So two forests of such farthest vertices, and jumps by powers of two in one of them, tell how many edges it has.

Legend: ``lo hi`` as above; ``c d`` ends of a chord; ``steps`` to the last or first vertex, by farthest neighbours.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation


class ChordCrossings(NamedTuple):
    """What `crossings_of_chord` reads.

    Attributes
    ----------
    ends_before : ndarray of int, shape (n + 1,)
        Ends of diagonals at vertices of smaller number.
    farthest : ndarray of int32, shape (levels, n)
        The vertex that 2**level steps to the right lead to.
    right_steps, left_steps : ndarray of int, shape (n,)
        Steps from each vertex to the last, and to the first.
    """

    ends_before: NDArray[np.int64]
    farthest: NDArray[np.int32]
    right_steps: NDArray[np.int64]
    left_steps: NDArray[np.int64]


def chord_crossings(T: Triangulation) -> ChordCrossings:
    """Prepare a triangulation for counting the diagonals that cross chords.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ChordCrossings

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> crossings_of_chord(chord_crossings(T), 1, 3), crossings_of_chord(chord_crossings(T), 0, 2)
    (1, 0)
    """
    n = len(T)
    low, high = np.sort(T.diagonals, axis=1).T
    right, left = np.minimum(np.arange(n) + 1, n - 1), np.maximum(np.arange(n) - 1, 0)
    np.maximum.at(right, low, high)
    np.minimum.at(left, high, low)
    ends_before = np.concatenate([[0], np.cumsum(T.degrees - 2)])
    farthest = [right.astype(np.int32)]
    for _ in range(n.bit_length() - 1):
        farthest.append(farthest[-1][farthest[-1]])
    return ChordCrossings(ends_before, np.stack(farthest), *_steps(right, left))


@njit(cache=True)
def _steps(right, left):
    n = len(right)
    to_last, to_first = np.zeros(n, np.int64), np.zeros(n, np.int64)
    for i in range(n - 2, -1, -1):
        to_last[i] = to_last[right[i]] + 1
    for i in range(1, n):
        to_first[i] = to_first[left[i]] + 1
    return to_last, to_first


@njit(cache=True)
def crossings_of_chord(T, a, b):
    """Number of diagonals that cross the chord ab, for compiled kernels."""
    c, d = min(a, b), max(a, b)
    if d - c < 2:
        return 0
    ends = T.ends_before[d] - T.ends_before[c + 1]
    return ends - _diagonals_within(T, c, d - 1) - _diagonals_within(T, c + 1, d)


@njit(cache=True)
def _diagonals_within(T, lo, hi):
    """Number of diagonals with both ends in lo, ..., hi."""
    i = lo
    for level in range(len(T.farthest) - 1, -1, -1):
        if T.farthest[level, i] <= hi:
            i = T.farthest[level, i]
    top_edges = T.right_steps[lo] - T.right_steps[i] + T.left_steps[hi] - T.left_steps[i]
    return hi - lo - top_edges


@njit(cache=True)
def crossings_of_chords(T, chords):
    """Number of diagonals that cross each of the chords, (k, 2), for compiled kernels."""
    counts = np.empty(len(chords), np.int64)
    for i in range(len(chords)):
        counts[i] = crossings_of_chord(T, chords[i, 0], chords[i, 1])
    return counts

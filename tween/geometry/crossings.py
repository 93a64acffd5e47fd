"""The crossings of a closed polygon: which edges meet, and whether they cross or touch."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tween.geometry.meeting_edges import meeting_edges


@dataclass(frozen=True)
class Crossings:
    """The pairs of edges of a curve that meet, neighbours along the curve left out.

    Attributes
    ----------
    pairs : ndarray of int, shape (k, 2)
        Edge numbers i < j, sorted.
    proper : ndarray of bool, shape (k,)
        True where the two edges cross in their interiors; False where they touch: an end of one lies
        on the other, or they overlap along a line.

    Examples
    --------
    >>> from tween import Curve
    >>> bow = Curve([[0, 0], [2, 2], [2, 0], [0, 2]])
    >>> list(bow.crossings), len(bow.crossings.touches)
    ([(0, 2)], 0)
    """

    pairs: NDArray[np.intp]
    proper: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.pairs)

    def __iter__(self) -> Iterator[tuple[int, int]]:
        return ((int(i), int(j)) for i, j in self.pairs)

    @property
    def crossing(self) -> NDArray[np.intp]:
        """The pairs that cross properly, shape (k, 2)."""
        return self.pairs[self.proper]

    @property
    def touches(self) -> NDArray[np.intp]:
        """The pairs that only touch, shape (k, 2)."""
        return self.pairs[~self.proper]


def find_crossings(points: NDArray[np.float64]) -> Crossings:
    """Find the pairs of edges of a closed polygon that meet, neighbours left out; it may have spikes, unlike a curve.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    Crossings
    """
    pairs, proper = meeting_edges(points)
    for array in (pairs, proper):
        array.setflags(write=False)
    return Crossings(pairs, proper)

"""The table of Shor and Van Wyk, and the splits of its pairs as a graph.

Legend: ``i < k < j`` vertices; a *pair* (i, j) holds where the polygon i, i+1, ..., j bounds a disk, to which the
rest of the curve may be glued, and is named by its place in the table; a *split* of it is an apex k such that (i, k)
and (k, j) hold and i, k, j is a left turn: one triangle, two smaller pairs.  Pairs and splits form an acyclic graph,
and a triangulation of the curve is a choice of one split at (0, n-1) and at every pair that this needs.

References
----------
Shor and Van Wyk (1992), Section 4.
"""

from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.errors import TweenError
from tween.triangulating.table.counting import count_exactly
from tween.triangulating.table.immersions import delaunay_splits, delaunay_triangles
from tween.triangulating.table.optimum import best_splits, follow
from tween.triangulating.table.pairs import find_pair, find_pairs, list_splits, needed_pairs, walk
from tween.triangulating.table.sampling import count_in_floats, draw

_MOST_PAIRS = 2**28
_MOST_SPLITS = 2**29
_AT_ONCE = 2**20  # triangles whose costs are asked for


class Graph(NamedTuple):
    """Splits of the pairs that the whole curve needs; children have smaller numbers than parents.

    Attributes
    ----------
    ends : ndarray of int32, shape (pairs, 2)
        The vertices i and j of every pair.
    first : ndarray of int, shape (pairs + 1,)
        The splits of pair p are ``first[p] : first[p + 1]``; an edge of the curve has none.
    apex, left, right : ndarray of int32, shape (splits,)
        The vertex k of every split, and the pairs (i, k) and (k, j).
    whole : int
        The pair (0, n-1).
    """

    ends: NDArray[np.int32]
    first: NDArray[np.int64]
    apex: NDArray[np.int32]
    left: NDArray[np.int32]
    right: NDArray[np.int32]
    whole: int

    @property
    def pairs(self) -> int:
        """Number of pairs, needed or not."""
        return len(self.ends)

    def triangles(self, low: int, high: int) -> NDArray[np.int64]:
        """The triangles i, k, j of splits low to high - 1, (high - low, 3)."""
        p, q = np.searchsorted(self.first, [low, high - 1], side="right") - 1
        bounds = np.clip(self.first[p : q + 2], low, high)
        of_pair = np.repeat(self.ends[p : q + 1], bounds[1:] - bounds[:-1], axis=0)
        return np.stack([of_pair[:, 0], self.apex[low:high], of_pair[:, 1]], axis=1).astype(np.int64)


class Table:
    """The pairs that hold, and what is read from them.

    Parameters
    ----------
    points : ndarray of float64, shape (c, n, 2)
        Curves of turning number 1, to be triangulated alike.

    Raises
    ------
    TweenError
        Where more than 2**28 pairs hold, a gibibyte.
    """

    def __init__(self, points: NDArray[np.float64]) -> None:
        self._points, self._n = points, points.shape[1]
        self._first, self._last, self._ends = find_pairs(points, _MOST_PAIRS)
        if len(self._ends) > _MOST_PAIRS:
            raise TweenError(
                f"the table of {self._n} vertices would take more than {_MOST_PAIRS * 4 / 2**30:.0f} GiB; recognising, "
                "triangulating and morphing curves with few crossings needs no table, but count, sample and optimal do"
            )

    @property
    def decomposes(self) -> bool:
        """Whether the whole curves have a triangulation."""
        return bool(find_pair(self._first, self._last, self._ends, 0, self._n - 1) >= 0)

    @property
    def count(self) -> int:
        """The exact number of triangulations of the whole curves."""
        return count_exactly(self._points, self._first, self._last, self._ends)

    def walk(self, take_last: bool = False) -> NDArray[np.int64]:
        """Find the triangulation, (n-2, 3), of the first or the last splits."""
        triangles: NDArray[np.int64] = walk(self._points, self._first, self._last, self._ends, self._n, take_last)
        return triangles

    def delaunay(self) -> list[NDArray[np.int64]]:
        """List the triangulations, (n-2, 3), of the first curve whose diagonals are all locally Delaunay."""
        points, graph = self._points[0], self.graph
        counts = delaunay_splits(points, graph.ends, graph.first, graph.apex, graph.left, graph.right)
        total = int(counts[graph.first[graph.whole] : graph.first[graph.whole + 1]].sum())
        parts = graph.ends, graph.first, graph.apex, graph.left, graph.right, counts, graph.whole
        return [delaunay_triangles(points, *parts, number) for number in range(total)]

    def draw(self, uniforms: NDArray[np.float64]) -> NDArray[np.int64]:
        """Draw triangulations, (k, n-2, 3), uniformly: one for each row of uniform numbers, (k, n-2)."""
        graph = self.graph
        parts = graph.whole, graph.first, graph.apex, graph.left, graph.right, graph.ends
        triangles: NDArray[np.int64] = draw(*parts, *self.weights, uniforms)
        return triangles

    def cheapest(
        self, cost: Callable[[NDArray[np.int64]], NDArray[np.float64]], largest_counts: bool
    ) -> NDArray[np.int64]:
        """Find the triangulation, (n-2, 3), whose costs have the least sum, or the least maximum."""
        graph = self.graph
        costs = np.empty(len(graph.apex))
        for low in range(0, len(costs), _AT_ONCE):
            block = graph.triangles(low, min(low + _AT_ONCE, len(costs)))
            given = np.asarray(cost(block), dtype=np.float64)
            if given.shape != (len(block),) or np.isnan(given).any():
                raise ValueError(f"cost gave shape {given.shape}, expected {len(block)} numbers, none of them NaN")
            costs[low : low + _AT_ONCE] = given
        best = best_splits(graph.first, graph.left, graph.right, costs, largest_counts)
        parts = graph.whole, graph.ends, graph.apex, graph.left, graph.right
        triangles: NDArray[np.int64] = follow(*parts, best, self._n - 2)
        return triangles

    @cached_property
    def graph(self) -> Graph:
        """The splits that triangulations of the whole curves can use; `.TweenError` where they would not fit."""
        start = np.repeat(np.arange(self._n), self._last - self._first)
        start = start[np.argsort(np.repeat(self._first, self._last - self._first), kind="stable")]
        ends = np.stack([start, self._ends], axis=1).astype(np.int32)
        needed, total = needed_pairs(self._points, self._first, self._last, self._ends, ends)
        if total > _MOST_SPLITS:
            raise TweenError(f"{total} splits would take {total * 12 / 2**30:.0f} GiB: too many to count or sample")
        first, apex, left, right = list_splits(self._points, self._first, self._last, self._ends, ends, needed, total)
        return Graph(ends, first, apex, left, right, find_pair(self._first, self._last, self._ends, 0, self._n - 1))

    @cached_property
    def weights(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Numbers of triangulations of every pair: mantissas in [0.5, 1) and exponents, each (pairs,)."""
        graph = self.graph
        return count_in_floats(graph.first, graph.left, graph.right)


def is_small(points: NDArray[np.float64], most: int) -> bool:
    """Tell whether at most so many pairs hold for curves, without looking at many more.

    Parameters
    ----------
    points : ndarray of float64, shape (c, n, 2)
    most : int

    Returns
    -------
    bool
    """
    n = points.shape[1]
    return n * (n - 1) // 2 <= most or len(find_pairs(points, most)[2]) <= most

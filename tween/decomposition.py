"""Which triangulations a curve has: the table of Shor and Van Wyk, counted, sampled, decomposed.

Legend: ``i < k < j`` vertices; a *pair* (i, j) holds where the polygon i, i+1, ..., j bounds a disk, and
is named by its place in the table; a *split* of it is an apex k such that (i, k) and (k, j) hold and
i, k, j is a left turn: one triangle, two smaller pairs.  Pairs and splits form an acyclic graph, and a
triangulation of the curve is a choice of one split at (0, n-1) and at every pair that this needs.

References
----------
P. W. Shor and C. J. Van Wyk, *Detecting and decomposing self-overlapping curves*, Computational
Geometry 2 (1992) 31-50.
"""

import math
from collections.abc import Sequence
from functools import cached_property
from operator import mul
from typing import Literal, NamedTuple, overload

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from tween.curve import Curve, as_curve
from tween.errors import CurveError, NotSelfOverlappingError, TweenError
from tween.predicates import turn
from tween.triangulation import Triangulation

_MOST_SPLITS = 2**29


class Decomposition:
    """The answer whether curves bound a disk, and all triangulations of it.

    Made by `decompose`.  True where there is a triangulation; otherwise `reason` says why not.
    Triangulations carry the points of the first curve.
    """

    def __init__(self, curves: Sequence[Curve]) -> None:
        self._curves = tuple(curves)
        self._n = len(curves[0])
        self._points = np.stack([c.points for c in curves])
        self._reason = _turning_reason(self._curves)
        if not self._reason:
            self._first, self._last, self._ends = _table(self._points)
            if not _holds(self._first, self._last, self._ends, 0, self._n - 1):
                every = f" is valid in all {len(curves)} curves" if len(curves) > 1 else " exists"
                self._reason = "no decomposition" + every

    @property
    def curves(self) -> tuple[Curve, ...]:
        """The curves that were decomposed together."""
        return self._curves

    @property
    def reason(self) -> str:
        """Why there is no triangulation; empty where there is one."""
        return self._reason

    def __bool__(self) -> bool:
        return not self._reason

    def __repr__(self) -> str:
        return f"Decomposition({self._reason or f'{self._n} vertices'})"

    @cached_property
    def count(self) -> int:
        """Exact number of triangulations, a Python int: Catalan(n-2) for a convex polygon.

        One product of long integers a split, of which there are up to n**3/6; 0 where there is none.
        """
        if not self:
            return 0
        graph = self._graph
        left, right, first = graph.left.tolist(), graph.right.tolist(), graph.first.tolist()
        counts = [0] * graph.pairs
        for pair in range(graph.pairs):
            low, high = first[pair], first[pair + 1]
            terms = map(mul, map(counts.__getitem__, left[low:high]), map(counts.__getitem__, right[low:high]))
            counts[pair] = 1 if low == high else sum(terms)
        return counts[graph.whole]

    def arbitrary(self, split: Literal["first", "last"] = "first") -> Triangulation:
        """Return the first triangulation that the table yields.

        Parameters
        ----------
        split : {"first", "last"}
            Which split to take at every pair: the one of smallest or of largest apex.

        Returns
        -------
        Triangulation

        Raises
        ------
        NotSelfOverlappingError
            Where there is no triangulation; the message is `reason`.

        Notes
        -----
        The paper starts from "an arbitrary triangulation" and does not say which; these two are what a
        program would return that reads the table from either end.

        Examples
        --------
        >>> decompose([[0, 0], [2, 0], [3, 1], [1, 3]]).arbitrary().triangles.tolist()
        [[0, 1, 3], [1, 2, 3]]
        """
        self._require()
        return self._triangulation(_walk(self._points, self._first, self._last, self._ends, self._n, split == "last"))

    @overload
    def sample(self, rng: np.random.Generator) -> Triangulation: ...
    @overload
    def sample(self, rng: np.random.Generator, size: int) -> list[Triangulation]: ...
    def sample(self, rng: np.random.Generator, size: int | None = None) -> Triangulation | list[Triangulation]:
        """Draw triangulations uniformly, each independent of the others.

        Parameters
        ----------
        rng : numpy.random.Generator
        size : int, optional
            How many; without it, one.

        Returns
        -------
        Triangulation or list of Triangulation

        Raises
        ------
        NotSelfOverlappingError
            Where there is no triangulation; the message is `reason`.

        Notes
        -----
        Walks down from (0, n-1) and takes each split with probability in proportion to the number of
        triangulations through it.  Those numbers are doubles with exponents of their own, so they never
        overflow; every triangulation has probability 1/count within a factor 1 +- n**2 * 2**-52.
        After the first call O(n) per sample and apex looked at.

        Examples
        --------
        >>> d = decompose([[0, 0], [2, 0], [3, 1], [1, 3]])
        >>> {str(T.canonical.tolist()) for T in d.sample(np.random.default_rng(0), 20)} == {
        ...     "[[0, 1, 2], [0, 2, 3]]", "[[0, 1, 3], [1, 2, 3]]"}
        True
        """
        self._require()
        uniforms = rng.random((1 if size is None else size, self._n - 2))
        mantissas, exponents = self._weights
        graph = self._graph
        drawn = _sample(
            graph.whole, graph.first, graph.apex, graph.left, graph.right, graph.ends, mantissas, exponents, uniforms
        )
        triangulations = [self._triangulation(triangles) for triangles in drawn]
        return triangulations[0] if size is None else triangulations

    def _require(self) -> None:
        if not self:
            raise NotSelfOverlappingError(self._reason)

    def _triangulation(self, triangles: NDArray[np.int64]) -> Triangulation:
        triangles.setflags(write=False)
        return Triangulation(self._curves[0].points, triangles)

    @cached_property
    def _graph(self) -> "_Graph":
        start = np.repeat(np.arange(self._n), self._last - self._first)
        start = start[np.argsort(np.repeat(self._first, self._last - self._first), kind="stable")]
        ends = np.stack([start, self._ends], axis=1).astype(np.int32)
        needed, total = _needed(self._points, self._first, self._last, self._ends, ends)
        if total > _MOST_SPLITS:
            raise TweenError(f"{total} splits would take {total * 12 / 2**30:.0f} GiB: too many to count or sample")
        first, apex, left, right = _splits(self._points, self._first, self._last, self._ends, ends, needed, total)
        return _Graph(ends, first, apex, left, right, _find(self._first, self._last, self._ends, 0, self._n - 1))

    @cached_property
    def _weights(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        graph = self._graph
        return _count_in_floats(graph.first, graph.left, graph.right)


class _Graph(NamedTuple):
    """Splits of the pairs that the whole curve needs; children have smaller numbers than parents."""

    ends: NDArray[np.int32]  # (pairs, 2): i, j
    first: NDArray[np.int64]  # (pairs + 1,): splits of pair p are first[p] : first[p + 1]
    apex: NDArray[np.int32]  # (splits,): k
    left: NDArray[np.int32]  # (splits,): the pair (i, k)
    right: NDArray[np.int32]  # (splits,): the pair (k, j)
    whole: int  # the pair (0, n-1)

    @property
    def pairs(self) -> int:
        return len(self.ends)


def decompose(*curves: Curve | ArrayLike) -> Decomposition:
    """Decide whether a curve bounds an immersed disk, and find the disk's triangulations.

    Parameters
    ----------
    *curves : Curve, Triangulation or array_like of shape (n, 2)
        One curve; or several with equally many vertices, vertex i of one matching vertex i of the
        others, for the triangulations that are valid in all of them.

    Returns
    -------
    Decomposition
        True where there is a triangulation; otherwise its `reason` says why not.  "No" is an answer,
        not an error.

    Raises
    ------
    CurveError
        Where a curve is no polygon that can be treated, or the numbers of vertices differ.

    Notes
    -----
    The table needs exact orientation tests only, once the turning number is known to be 1: n-2
    counter-clockwise triangles have angles (n-2) pi in all, as many as the interior angles of a curve
    of turning number 1, so no vertex can hide a further 2 pi.  Kept as sparse lists it costs, in time,
    the number of triples (i, k, j) with both pairs holding: O(n**3) at worst, and near-linear on strips.

    Examples
    --------
    >>> d = decompose([[0, 0], [2, 0], [3, 1], [1, 3], [0, 2]])
    >>> bool(d), d.count
    (True, 5)
    >>> eight = decompose([[0, 0], [2, 2], [2, 0], [0, 2]])
    >>> bool(eight), eight.reason
    (False, 'turning number is 0, not 1')

    References
    ----------
    Shor and Van Wyk (1992), Section 4; Mukherjee and Gopi, Section 2, their reference [24].
    """
    if not curves:
        raise CurveError("decompose needs at least one curve")
    checked = [as_curve(c) for c in curves]
    if len({len(c) for c in checked}) > 1:
        sizes = " and ".join(str(len(c)) for c in checked)
        raise CurveError(f"curves have {sizes} vertices, expected equal numbers; see Curve.insert_vertices")
    return Decomposition(checked)


def _turning_reason(curves: Sequence[Curve]) -> str:
    for number, curve in enumerate(curves, start=1):
        if curve.turning_number != 1:
            which = f" of curve {number}" if len(curves) > 1 else ""
            return f"turning number{which} is {curve.turning_number}, not 1"
    return ""


@njit(cache=True)
def _left_turn(points, i, k, j):
    """Whether i, k, j is a left turn in every curve."""
    for c in range(points.shape[0]):
        if turn(points[c], i, k, j) <= 0:
            return False
    return True


@njit(cache=True)
def _table(points):
    """Find the pairs that hold: row i is ``ends[first[i]:last[i]]``, ascending; row n-2 comes first."""
    n = points.shape[1]
    first, last = np.zeros(n, np.int64), np.zeros(n, np.int64)
    ends = np.empty(8 * n, np.int32)
    size = 0
    holds_for = np.full(n, -1, np.int64)
    for i in range(n - 2, -1, -1):
        first[i] = size
        holds_for[i + 1] = i
        farthest = i + 1
        for k in range(i + 1, n):
            if k > farthest:
                break
            if holds_for[k] != i:
                continue
            if size == ends.size:
                ends = np.concatenate((ends, np.empty_like(ends)))
            ends[size] = k
            size += 1
            for place in range(first[k], last[k]):
                j = ends[place]
                if holds_for[j] != i and _left_turn(points, i, k, j):
                    holds_for[j] = i
                    farthest = max(farthest, j)
        last[i] = size
    return first, last, ends[:size].copy()


@njit(cache=True)
def _find(first, last, ends, i, j):
    """The place of pair (i, j) in the table, -1 where it does not hold."""
    low, high = first[i], last[i]
    while low < high:
        middle = (low + high) // 2
        if ends[middle] < j:
            low = middle + 1
        else:
            high = middle
    return low if low < last[i] and ends[low] == j else -1


def _holds(first, last, ends, i, j):
    return _find(first, last, ends, i, j) >= 0


@njit(cache=True)
def _walk(points, first, last, ends, n, take_last):
    """The triangulation that takes the first (or last) split everywhere."""
    triangles = np.empty((n - 2, 3), np.int64)
    stack = [(np.int64(0), np.int64(n - 1))]
    for t in range(n - 2):
        i, j = stack.pop()
        while j == i + 1:
            i, j = stack.pop()
        low, high = first[i], last[i]
        for step in range(high - low):
            k = np.int64(ends[high - 1 - step] if take_last else ends[low + step])
            if k < j and _find(first, last, ends, k, j) >= 0 and _left_turn(points, i, k, j):
                break
        triangles[t] = i, k, j
        stack.append((k, j))
        stack.append((i, k))
    return triangles


@njit(cache=True)
def _needed(points, first, last, ends, pairs):
    """Mark the pairs that a triangulation of the whole curve can need, parents before children."""
    n = points.shape[1]
    needed = np.zeros(len(pairs), np.bool_)
    needed[_find(first, last, ends, 0, n - 1)] = True
    total = 0
    for pair in range(len(pairs) - 1, -1, -1):
        i, j = pairs[pair]
        if not needed[pair]:
            continue
        for left in range(first[i], pair):
            k = ends[left]
            right = _find(first, last, ends, k, j)
            if right >= 0 and _left_turn(points, i, k, j):
                needed[left] = needed[right] = True
                total += 1
    return needed, total


@njit(cache=True)
def _splits(points, first, last, ends, pairs, needed, total):
    """List the splits of every needed pair, by ascending apex."""
    splits = np.zeros(len(pairs) + 1, np.int64)
    apex, lefts, rights = np.empty(total, np.int32), np.empty(total, np.int32), np.empty(total, np.int32)
    size = 0
    for pair in range(len(pairs)):
        i, j = pairs[pair]
        if needed[pair]:
            for left in range(first[i], pair):
                k = ends[left]
                right = _find(first, last, ends, k, j)
                if right >= 0 and _left_turn(points, i, k, j):
                    apex[size], lefts[size], rights[size] = k, left, right
                    size += 1
        splits[pair + 1] = size
    return splits, apex, lefts, rights


@njit(cache=True)
def _count_in_floats(first, left, right):
    """Count the triangulations of every pair as mantissa * 2**exponent."""
    pairs = first.size - 1
    mantissas, exponents = np.full(pairs, 0.5), np.ones(pairs, np.int64)
    for pair in range(pairs):
        low, high = first[pair], first[pair + 1]
        if low == high:
            continue
        top = exponents[left[low]] + exponents[right[low]]
        for s in range(low + 1, high):
            top = max(top, exponents[left[s]] + exponents[right[s]])
        total = 0.0
        for s in range(low, high):
            shift = exponents[left[s]] + exponents[right[s]] - top
            total += math.ldexp(mantissas[left[s]] * mantissas[right[s]], shift)
        mantissas[pair], shift = math.frexp(total)
        exponents[pair] = top + shift
    return mantissas, exponents


@njit(cache=True)
def _sample(whole, first, apex, left, right, ends, mantissas, exponents, uniforms):
    """Walk down from the whole curve once for every row of uniform numbers, one number a triangle."""
    samples, triangles_each = uniforms.shape
    triangles = np.empty((samples, triangles_each, 3), np.int64)
    stack = np.empty(2 * triangles_each + 2, np.int64)
    for row in range(samples):
        stack[0], size, t = whole, 1, 0
        while size > 0:
            size -= 1
            pair = stack[size]
            if first[pair] == first[pair + 1]:
                continue
            rest = uniforms[row, t] * mantissas[pair]
            s = first[pair]
            for s in range(first[pair], first[pair + 1]):
                shift = exponents[left[s]] + exponents[right[s]] - exponents[pair]
                rest -= math.ldexp(mantissas[left[s]] * mantissas[right[s]], shift)
                if rest < 0.0:
                    break
            triangles[row, t] = ends[pair, 0], apex[s], ends[pair, 1]
            t += 1
            stack[size], stack[size + 1] = right[s], left[s]
            size += 2
    return triangles

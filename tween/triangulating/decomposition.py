"""Which triangulations a curve has: decided, counted, sampled, the best one, one for each immersed disk.

By the table of Shor and Van Wyk, see `.table.splits`.

References
----------
P. W. Shor and C. J. Van Wyk, *Detecting and decomposing self-overlapping curves*, Computational
Geometry 2 (1992) 31-50.
"""

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError, NotSelfOverlappingError, TweenError
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.triangulating.flips import remesh
from tween.triangulating.reduction import Reduction, reduce_curve
from tween.triangulating.restoration import restore
from tween.triangulating.table.splits import Table

if TYPE_CHECKING:
    from tween.triangulating.repair.explanation import Explanation

_SMALL = 200  # vertices; up to here the table is as quick as anything


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
        if not self._reason and not (self._reduced or self._full).decomposes:
            every = f" is valid in all {len(curves)} curves" if len(curves) > 1 else " exists"
            self._reason = "no decomposition" + every

    @cached_property
    def _reduction(self) -> Reduction:
        """The first curve without the vertices that do not matter."""
        return reduce_curve(self._curves[0])

    @cached_property
    def _reduced(self) -> Table | None:
        """The table of the reduced curve, where that pays."""
        if len(self._curves) > 1 or self._n <= _SMALL:
            return None
        return Table(self._points[:, self._reduction.kept])

    @cached_property
    def _full(self) -> Table:
        return Table(self._points)

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

        0 where there is none.  Up to n**3/6 products, modulo each of as many primes as its size needs.
        """
        return self._full.count if self else 0

    def arbitrary(self, split: Literal["first", "last"] | None = None) -> Triangulation:
        """Return the first triangulation that the table yields.

        Parameters
        ----------
        split : {"first", "last"}, optional
            Which split to take at every pair: the one of smallest or of largest apex.  Without it, whatever is
            quickest: the first, but on a curve of many vertices and few crossings the constrained Delaunay
            triangulation, from a reduced curve.

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
        if split not in ("first", "last", None):
            raise ValueError(f"split is {split!r}, expected 'first' or 'last'")
        if split is None and self._reduced is not None:
            return self._restored(self._reduced.walk())
        return self._triangulation(self._full.walk(split == "last"))

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
        triangulations = [self._triangulation(triangles) for triangles in self._full.draw(uniforms)]
        return triangulations[0] if size is None else triangulations

    def optimal(
        self, cost: Callable[[NDArray[np.int64]], NDArray[np.float64]], combine: Literal["sum", "max"] = "sum"
    ) -> Triangulation:
        """Find the triangulation of least cost among all.

        Parameters
        ----------
        cost : callable
            From triangles, an (m, 3) array of vertices i < k < j, to their costs, shape (m,).  It is called
            with every triangle that some triangulation contains, a million at once at most.
        combine : {"sum", "max"}
            Whether the costs of the triangles add up, or the largest counts.

        Returns
        -------
        Triangulation
            Of equally good splits of a pair the one of smallest apex is taken.

        Raises
        ------
        NotSelfOverlappingError
            Where there is no triangulation; the message is `reason`.
        ValueError
            Where the costs are not m numbers, or `combine` is unknown.

        Notes
        -----
        Exact: the same table with costs in the place of counts.  The paper holds choosing the best
        triangulation to be "of exponential complexity and hence prohibitively expensive"; for a cost that
        is a sum or a maximum over triangles it is O(n**3) at worst.

        Examples
        --------
        >>> import numpy as np
        >>> points = np.array([[0, 0], [2, -1], [4, 0], [2, 1]])
        >>> d = decompose(points)
        >>> def diameter(triangles):
        ...     corners = points[triangles]
        ...     return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        >>> d.optimal(diameter, "max").diagonals.tolist()
        [[1, 3]]

        References
        ----------
        Mukherjee and Gopi, Section 3: the claim.
        """
        self._require()
        if combine not in ("sum", "max"):
            raise ValueError(f"combine is {combine!r}, expected 'sum' or 'max'")
        return self._triangulation(self._full.cheapest(cost, combine == "max"))

    def immersions(self) -> list[Triangulation]:
        """List the immersed disks that the curve bounds, each by its constrained Delaunay triangulation.

        Returns
        -------
        list of Triangulation
            One for each equivalence class of immersions, in the order of the table.

        Raises
        ------
        NotSelfOverlappingError
            Where there is no triangulation; the message is `reason`.
        TweenError
            For a joint decomposition: immersions belong to one curve.

        Notes
        -----
        Flips never leave an immersed disk, and every one has just one triangulation whose diagonals are
        all locally Delaunay.  So it is enough to list those: the same table, where a split counts
        only under a triangle whose third vertex is not in its circumcircle.  Of four cocircular vertices
        the one of smallest number counts as slightly lifted, exactly, so ties do not multiply the
        answer.  A curve of more than 200 vertices is reduced first, see `.reduction`; the rest costs O(splits * n).
        Exact.

        Examples
        --------
        >>> from tween import gallery
        >>> len(decompose(gallery.curve("two_disks")).immersions())
        2

        References
        ----------
        Shor and Van Wyk (1992), Section 1, on Milnor's curve, which bounds two disks.
        """
        self._require()
        if len(self._curves) > 1:
            raise TweenError(f"immersions belong to one curve, but {len(self._curves)} were decomposed together")
        if self._reduced is not None:
            return [self._restored(triangles) for triangles in self._reduced.delaunay()]
        if len(self._curves[0].crossings) == 0:  # a simple polygon; ties alone could take long
            return [remesh(self.arbitrary())]
        return [self._triangulation(triangles) for triangles in self._full.delaunay()]

    def explain(self) -> "Explanation":
        """Say why there is no triangulation, where, and what would mend the curve.

        Returns
        -------
        Explanation
            Its text is a summary and a few lines: tiny loops; the turning number and the loops that make it; regions
            about which the curve winds clockwise; and what would mend it.  Each suggestion carries a curve that was
            checked to bound a disk.  Of several curves, that of the first which bounds none.

        Raises
        ------
        TweenError
            For a joint decomposition of curves each of which bounds a disk: none of them is to be mended.

        Notes
        -----
        What is suggested first is to `.clean` the curve, if 1/25 of its size is smoothing enough; then to cut off
        loops, the least area first.  The work is bounded, and what was not looked at is said.

        Examples
        --------
        >>> print(decompose([[0, 0], [4, 4], [4, 0], [0, 3]]).explain())
        The curve bounds no immersed disk: turning number is 0, not 1; to mend it, cut off the loop at (1.714, 1.714).
        It meets itself 1 time, with no tiny loops.
        Its turning number is 0: 1 loop counter-clockwise less 1 clockwise; the smallest of them at (1.714, 1.714).
        It winds against its main sense about 1 region: at (0.429, 0.857) (1).
        1. cut off the loop at (1.714, 1.714): 36 % of the area is lost.
        2. keep only the loop at (1.714, 1.714): 64 % of the area is lost.
        """
        from tween.triangulating.repair.explanation import explain  # here, as it decomposes the curves that it suggests

        alone = [self] if len(self._curves) == 1 else [decompose(c) for c in self._curves]
        for decomposition in alone:
            if not decomposition or len(alone) == 1:
                return explain(decomposition.curves[0], decomposition.reason)
        raise TweenError("an explanation belongs to one curve, and each of these bounds a disk")

    def _require(self) -> None:
        if not self:
            raise NotSelfOverlappingError(self._reason)

    def _triangulation(self, triangles: NDArray[np.int64]) -> Triangulation:
        triangles.setflags(write=False)
        return Triangulation(self._curves[0].points, triangles)

    def _restored(self, triangles: NDArray[np.int64]) -> Triangulation:
        """Put the vertices back that the reduction left out."""
        return self._triangulation(restore(self._points[0], self._reduction, triangles))


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
    the number of triples (i, k, j) with both pairs holding: O(n**3) at worst.  A single curve of more
    than 200 vertices is reduced first, see `.reduction`: with few crossings that is near-linear.

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


def triangulate(shape: Triangulation | Curve | ArrayLike) -> Triangulation:
    """Return the constrained Delaunay triangulation of an immersed disk that a curve bounds.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
        A triangulation is returned as it is.

    Returns
    -------
    Triangulation
        Where the curve bounds several disks, one of them: that of ``decompose(curve).arbitrary()``.

    Raises
    ------
    NotSelfOverlappingError
        Where the curve bounds no immersed disk; the message says why not.

    Examples
    --------
    >>> triangulate([[0, 0], [2, -1], [4, 0], [2, 1]]).diagonals.tolist()
    [[1, 3]]
    """
    if isinstance(shape, Triangulation):
        return shape
    decomposition = decompose(shape)
    if not decomposition:
        raise NotSelfOverlappingError(f"the curve bounds no immersed disk: {decomposition.reason}")
    return remesh(decomposition.arbitrary())


def _turning_reason(curves: Sequence[Curve]) -> str:
    for number, curve in enumerate(curves, start=1):
        if curve.turning_number != 1:
            which = f" of curve {number}" if len(curves) > 1 else ""
            return f"turning number{which} is {curve.turning_number}, not 1"
    return ""

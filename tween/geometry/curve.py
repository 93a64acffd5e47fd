"""Closed polygons that may cross themselves: validation, turning number, crossings.

A vertex is a position along the curve, never a coordinate: a curve may visit one place many times.
Edge i runs from vertex i to vertex i+1 (mod n).
"""

from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError
from tween.geometry.crossings import Crossings, find_crossings
from tween.geometry.halving import dented, halve_longest_edges
from tween.geometry.predicates import EXACT_RANGE, orient2d
from tween.geometry.rings import ring_points

_Scalar = TypeVar("_Scalar", bound=np.generic)


class Curve:
    """A closed polygon, counter-clockwise, that may cross itself.

    Parameters
    ----------
    points : array_like, shape (n, 2), n >= 3, or a polygon or ring of shapely
        Vertices in order along the curve; the last one is joined to the first, and dropped where it repeats
        it, as closed rings have it; `origin` tells the rows that are left.  A curve of negative
        turning number is traversed the other way round, vertex 0 staying first, and says so in
        `reversed_input`.

    Raises
    ------
    CurveError
        Where `points` has another shape, fewer than 3 rows, an entry that is not finite or lies outside
        the range in which the predicates are exact, an edge of zero length, or a spike (a turn by
        180 degrees).  The message names the vertex.

    Notes
    -----
    A curve never changes; its arrays are read-only.  Making one costs O(n).

    Examples
    --------
    >>> square = Curve([[0, 0], [0, 1], [1, 1], [1, 0]])
    >>> square.reversed_input, square.turning_number, square.area
    (True, 1, 1.0)
    >>> Curve([[0, 0], [1, 0], [1, 0], [0, 1]])
    Traceback (most recent call last):
    ...
    tween.errors.CurveError: edge 1-2 has zero length: vertices 1 and 2 are both at (1, 0)
    """

    def __init__(self, points: ArrayLike) -> None:
        p = _validated(points)
        turning = turning_number(p)
        origin = np.arange(len(p)) if turning >= 0 else -np.arange(len(p)) % len(p)
        self._hold(p[origin], abs(turning), turning < 0, origin)

    def _hold(self, points: NDArray[np.float64], turning: int, was_reversed: bool, origin: NDArray[np.intp]) -> None:
        """What a curve is, once and for all."""
        self._points, self._origin = _frozen(points), _frozen(origin)
        self._turning_number, self._reversed = turning, was_reversed

    @property
    def points(self) -> NDArray[np.float64]:
        """Vertices, shape (n, 2), read-only."""
        return self._points

    @property
    def turning_number(self) -> int:
        """Full turns that the direction of travel makes, exact; 1 for every boundary of a disk."""
        return self._turning_number

    @property
    def reversed_input(self) -> bool:
        """Whether the input was clockwise, so that it is traversed the other way round here."""
        return self._reversed

    @property
    def origin(self) -> NDArray[np.intp]:
        """Row of the input that each vertex was, shape (n,); -1 where `insert_vertices` put it."""
        return self._origin

    @cached_property
    def area(self) -> float:
        """Signed area, regions counted as often as the curve winds about them."""
        x, y = (self._points - self._points[0]).T
        return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))

    @cached_property
    def crossings(self) -> Crossings:
        """The pairs of edges that meet, as `.Crossings`; exact."""
        return find_crossings(self._points)

    def insert_vertices(self, count: int) -> "Curve":
        """Reach a number of vertices by halving the longest edges; the shape stays.

        Parameters
        ----------
        count : int
            Vertices wanted, at least as many as there are.

        Returns
        -------
        Curve
            With the same vertices in the same order and midpoints between them; `origin` tells which.

        Raises
        ------
        CurveError
            Where `count` is below the number of vertices, an edge is too short to be halved, or the curve so
        thin that rounding the midpoints changes its turning number.

        Notes
        -----
        The longest edge is halved first, the one of smallest number where several are equally long.
        Midpoints, unlike other fractions, are doubles that lie exactly on the edge whenever the
        coordinates have a bit to spare.  Otherwise they are off by some roundings, and always to the left: three
        points on one edge never make a triangle, so that no rounding decides anything (`dented`).
        O((n + count) log n).

        Examples
        --------
        >>> Curve([[0, 0], [4, 0], [0, 2]]).insert_vertices(5).points.tolist()
        [[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [2.0, 1.0], [0.0, 2.0]]
        """
        if count < len(self):
            raise CurveError(f"{count} vertices wanted, but the curve has {len(self)} already")
        halved, origin = halve_longest_edges(self._points, self._origin, count)
        try:
            curve = self._refined(dented(halved, origin))
        except CurveError:  # too thin for dents
            curve = self._refined(halved)
        grown = Curve.__new__(Curve)
        grown._hold(curve.points, curve.turning_number, self._reversed, origin)
        return grown

    def _refined(self, points: NDArray[np.float64]) -> "Curve":
        """The curve through more points, or the `CurveError` where it is another one."""
        try:
            curve = Curve(points)
        except CurveError as error:
            raise CurveError(f"the curve is too thin to take up {len(points) - len(self)} vertices: {error}") from None
        if curve._reversed or curve.turning_number != self.turning_number:
            raise CurveError(
                "the curve is so thin that rounding the midpoints of its edges turns it over: its turning number "
                f"{self.turning_number} became {-curve.turning_number if curve._reversed else curve.turning_number}"
            )
        return curve

    def __len__(self) -> int:
        return len(self._points)

    def __repr__(self) -> str:
        return f"Curve({len(self)} vertices, turning number {self.turning_number})"


def as_curve(curve: Any) -> Curve:
    """Return the curve itself, or the `Curve` with the given points.

    Parameters
    ----------
    curve : Curve, or anything with a `curve`, or array_like of shape (n, 2)
        A triangulation stands for its boundary.

    Returns
    -------
    Curve
    """
    if isinstance(curve, Curve):
        return curve
    boundary = getattr(curve, "curve", None)
    return boundary if isinstance(boundary, Curve) else Curve(curve)


def _frozen(array: NDArray[_Scalar]) -> NDArray[_Scalar]:
    array.setflags(write=False)
    return array


def without_repetitions(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Drop points that equal the one before.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    ndarray of float64, shape (m, 2)
    """
    fresh = np.ones(len(points), dtype=np.bool_)
    fresh[1:] = (points[1:] != points[:-1]).any(axis=1)
    return points[fresh]


def _validated(points: ArrayLike) -> NDArray[np.float64]:
    """Copy the points to doubles, or raise the `CurveError` that names the first vertex at fault."""
    p = _as_doubles(points)
    if p.ndim != 2 or p.shape[1] != 2:
        raise CurveError(f"points have shape {p.shape}, expected (n, 2)")
    n = len(p)
    if n < 3:
        raise CurveError(f"a curve needs at least 3 vertices, found {n}")
    p += 0.0  # turns -0.0 into 0.0, so that equal points are equal bytes
    fault = coordinate_fault(p)
    if fault:
        raise CurveError(fault)
    if n > 3 and (p[0] == p[-1]).all():
        p, n = p[:-1].copy(), n - 1
    following = np.roll(p, -1, axis=0)
    for i in np.flatnonzero((p == following).all(axis=1)):
        j = (i + 1) % n
        raise CurveError(f"edge {i}-{j} has zero length: vertices {i} and {j} are both at {_at(p[i])}")
    for i in np.flatnonzero(spikes(p)):
        raise CurveError(f"vertex {i} at {_at(p[i])} is a spike: the curve turns back by 180 degrees")
    return p


def _as_doubles(points: ArrayLike) -> NDArray[np.float64]:
    """Copy numbers to doubles, or raise the `CurveError` that says what would be lost."""
    points = ring_points(points)
    if np.ma.is_masked(points):
        hidden = np.atleast_1d(np.ma.getmaskarray(np.ma.asarray(points)))
        raise CurveError(f"vertex {int(np.argwhere(hidden)[0, 0])} is masked, expected coordinates of every vertex")
    try:
        given = np.asarray(points)
        if np.iscomplexobj(given):
            raise TypeError(
                f"they are complex, of shape {given.shape}; give real parts and imaginary parts as two columns: "
                "np.stack([z.real, z.imag], axis=1)"
            )
        return np.array(given, dtype=np.float64)
    except OverflowError:
        raise CurveError(_overflow(points)) from None
    except (TypeError, ValueError) as error:
        raise CurveError(f"points are no array of numbers of shape (n, 2): {error}") from None


def _overflow(points: Any) -> str:
    """Name the first vertex of which no double can hold a coordinate."""
    for i, vertex in enumerate(np.atleast_1d(np.asarray(points, dtype=object))):
        try:
            np.array(vertex, dtype=np.float64)
        except OverflowError:
            return f"vertex {i} has a coordinate beyond the largest double; scale the curve"
    raise AssertionError("some vertex has overflowed")


def coordinate_fault(points: NDArray[np.float64]) -> str:
    """Find the first vertex whose coordinates the predicates cannot treat exactly.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    str
        What is wrong with which vertex; empty where nothing is.
    """
    for i in np.flatnonzero(~np.isfinite(points).all(axis=1)):
        return f"vertex {i} is {_at(points[i])}, expected finite coordinates"
    low, high = EXACT_RANGE
    size = np.abs(points)
    for i in np.flatnonzero(((size != 0) & ((size < low) | (size > high))).any(axis=1)):
        return (
            f"vertex {i} is {_at(points[i])}: coordinates must be 0 or between {low:.0e} and {high:.0e} "
            "in magnitude for the predicates to be exact; scale the curve"
        )
    return ""


def _at(point: NDArray[np.float64]) -> str:
    return f"({point[0]:g}, {point[1]:g})"


def spikes(points: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Tell at which vertices the curve turns back by exactly 180 degrees.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    ndarray of bool, shape (n,)
    """
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    same_direction = (np.sign(before - points) == np.sign(after - points)).all(axis=1)
    return same_direction & (orient2d(before, points, after) == 0)


def turning_number(points: NDArray[np.float64]) -> int:
    """Count the full turns that the direction of travel makes along a closed polygon, exactly.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
        A polygon without edges of zero length and without spikes.

    Returns
    -------
    int
        The signed crossings of the edge directions with the ray to the right.  From one edge to the
        next the direction turns by less than 180 degrees, so it passes that ray exactly where it turns
        left from the lower into the upper half plane (+1), or right from the upper into the lower (-1).
    """
    following = np.roll(points, -1, axis=0)
    up, right = following[:, 1] > points[:, 1], following[:, 0] > points[:, 0]
    upper = up | ((following[:, 1] == points[:, 1]) & right)
    before = np.roll(upper, 1)
    turns = orient2d(np.roll(points, 1, axis=0), points, following)
    return int(np.sum((turns > 0) & ~before & upper)) - int(np.sum((turns < 0) & before & ~upper))

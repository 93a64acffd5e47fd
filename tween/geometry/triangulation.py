r"""Triangulations of an immersed disk without interior vertices.

A triangulation is two arrays: the points along the curve, and n-2 counter-clockwise triples of them.
All else is derived.  Half-edge ``3*t + s`` of triangle t runs from its corner s to its corner s+1:

            c                 half-edge  3t    a -> b
          /   \                         3t+1  b -> c
      3t+2     3t+1                      3t+2  c -> a
      /           \
     a --- 3t ---- b          twin[t, s] is the half-edge b -> a of the triangle across, -1 on the curve
"""

from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError, TriangulationError
from tween.geometry.curve import Curve, coordinate_fault, spikes, turning_number
from tween.geometry.half_edges import reached, twins
from tween.geometry.predicates import orient2d

_SMALLEST_GAP = 1e-3


class Triangulation:
    """Triangles that glue together to a disk immersed in the plane, all vertices on its boundary.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        Vertices in order along the boundary, counter-clockwise.
    triangles : array_like of int, shape (n-2, 3)
        Corners of each triangle, counter-clockwise.

    Raises
    ------
    TriangulationError
        Where an array has another shape, or an index is out of range.  The constructor looks no
        further; `validate` does.

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> T.twin.tolist(), T.degrees.tolist(), T.dual.tolist()
    ([[-1, -1, 3], [2, -1, -1]], [3, 2, 3, 2], [[0, 1]])
    >>> T.validate() is T
    True
    """

    def __init__(self, points: ArrayLike, triangles: ArrayLike) -> None:
        self._points = _read_only(points, np.float64, "points")
        self._triangles = _read_only(triangles, np.int64, "triangles")
        n = len(self._points)
        if self._points.shape != (n, 2) or n < 3:
            raise TriangulationError(f"points have shape {self._points.shape}, expected (n, 2) with n >= 3")
        if self._triangles.shape != (n - 2, 3):
            found = self._triangles.shape
            raise TriangulationError(f"triangles have shape {found}, expected ({n - 2}, 3) for {n} points")
        if self._triangles.min() < 0 or self._triangles.max() >= n:
            t = np.flatnonzero(((self._triangles < 0) | (self._triangles >= n)).any(axis=1))[0]
            found = self._triangles[t].tolist()
            raise TriangulationError(f"triangle {t} is {found}, expected vertices from 0 to {n - 1}")

    @property
    def points(self) -> NDArray[np.float64]:
        """Vertices along the curve, shape (n, 2), read-only."""
        return self._points

    @property
    def triangles(self) -> NDArray[np.int64]:
        """Corners of the triangles, shape (n-2, 3), counter-clockwise, read-only, in the order given."""
        return self._triangles

    @cached_property
    def curve(self) -> Curve:
        """The boundary."""
        curve = Curve(self._points)
        if len(curve) < len(self):
            raise CurveError(f"edge {len(curve)}-0 has zero length: the last vertex repeats the first")
        return curve

    @cached_property
    def twin(self) -> NDArray[np.int64]:
        """Half-edge across each half-edge, shape (n-2, 3); -1 on the boundary."""
        twin = twins(self._triangles, len(self._points))
        twin.setflags(write=False)
        return twin

    @cached_property
    def degrees(self) -> NDArray[np.int64]:
        """Edges at each vertex, the two of the boundary included, shape (n,)."""
        return np.bincount(self._triangles.ravel(), minlength=len(self._points)) + 1

    @cached_property
    def dual(self) -> NDArray[np.int64]:
        """Edges of the dual tree, shape (n-3, 2): pairs of triangles that share a diagonal."""
        h = self._inner_half_edges()
        return np.stack([h // 3, self.twin.ravel()[h] // 3], axis=1)

    @cached_property
    def diagonals(self) -> NDArray[np.int64]:
        """Ends of the diagonals, shape (n-3, 2), row for row those that `dual` crosses."""
        h = self._inner_half_edges()
        t, s = h // 3, h % 3
        return np.stack([self._triangles[t, s], self._triangles[t, (s + 1) % 3]], axis=1)

    def _inner_half_edges(self) -> NDArray[np.int64]:
        twin = self.twin.ravel()
        return np.flatnonzero(twin > np.arange(len(twin)))

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """Area of each triangle, shape (n-2,)."""
        a, b, c = np.moveaxis(self._points[self._triangles], 1, 0)
        u, v = b - a, c - a
        return 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])

    @cached_property
    def canonical(self) -> NDArray[np.int64]:
        """The triangles with the smallest corner first, sorted: equal for equal triangulations."""
        return canonical(self._triangles)

    def validate(self) -> "Triangulation":
        """Check every rule by which the triangles cover an immersed disk, with exact predicates.

        Returns
        -------
        Triangulation
            Itself, so that calls can be chained.

        Raises
        ------
        TriangulationError
            Naming the first broken rule and the element: coordinates within the exact range; each
            boundary edge in one triangle; each diagonal in two, in opposite directions; dual graph
            connected; every triangle counter-clockwise; no spike; turning number 1.

        Notes
        -----
        The last rule is no luxury.  The boundary turns 1 + sum of floor(angle sum / 2 pi) times, over
        its vertices: where angles around a vertex add up to more than 2 pi all the other rules may
        hold, and still no disk is immersed there.  O(n log n).
        """
        fault = coordinate_fault(self._points)
        if fault:
            raise TriangulationError(fault)
        for t in np.flatnonzero(~reached(self.twin)):
            raise TriangulationError(f"triangle {t} is not connected to triangle 0: the dual graph is no tree")
        for t in np.flatnonzero(orient2d(*np.moveaxis(self._points[self._triangles], 1, 0)) <= 0):
            found = self._triangles[t].tolist()
            raise TriangulationError(f"triangle {t} {found} is not counter-clockwise")
        for v in np.flatnonzero(spikes(self._points)):
            raise TriangulationError(f"vertex {v} is a spike: the curve turns back by 180 degrees")
        turning = turning_number(self._points)
        if turning != 1:
            raise TriangulationError(f"turning number of the boundary is {turning}, not 1")
        return self

    def moved(self, points: ArrayLike) -> "Triangulation":
        """Put the same triangles on other points.

        Parameters
        ----------
        points : array_like, shape (n, 2)

        Returns
        -------
        Triangulation
            With the same triangles in the same order.

        Examples
        --------
        >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
        >>> T.moved(2 * T.points).areas
        array([2., 2.])
        """
        other = Triangulation(points, self._triangles)
        return other._knowing(self.__dict__["twin"]) if "twin" in self.__dict__ else other

    def _knowing(self, twin: NDArray[np.int64]) -> "Triangulation":
        """Take the twins as known, so that they are not sought again."""
        twin.setflags(write=False)
        self.__dict__["twin"] = twin
        return self

    def rolled(self, shift: int) -> "Triangulation":
        """Number the vertices from another start.

        Parameters
        ----------
        shift : int
            Vertex ``(i + shift) mod n`` becomes vertex i.

        Returns
        -------
        Triangulation
            The same triangles in the same order, in the new numbers.

        Examples
        --------
        >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
        >>> T.rolled(1).triangles.tolist()
        [[3, 0, 1], [3, 1, 2]]
        """
        n = len(self._points)
        if shift % n == 0:
            return self
        other = Triangulation(np.roll(self._points, -shift, axis=0), (self._triangles - shift) % n)
        return other._knowing(self.twin)

    def on_disk(self, spacing: Literal["arc", "uniform"] = "arc") -> "Triangulation":
        """Impose the triangles on a disk: the same vertices on a circle around the same area.

        Parameters
        ----------
        spacing : {"arc", "uniform"}
            Gaps between neighbours in proportion to the lengths of the curve's edges, or all equal.

        Returns
        -------
        Triangulation
            The circle's centre is the immersed disk's centre of mass, and it is turned so that its
            vertices lie as close to the curve's as a rotation can bring them.

        Notes
        -----
        The paper fixes only that the disk is a disk; area, centre, spacing and turn are our choices.
        "arc" keeps every gap above a thousandth of the mean, lest neighbours coincide.  O(n).

        References
        ----------
        Mukherjee and Gopi, Section 3, "Morphing compatible triangulations".
        """
        if spacing not in ("arc", "uniform"):
            raise ValueError(f"spacing is {spacing!r}, expected 'arc' or 'uniform'")
        z = self._points @ np.array([1.0, 1.0j])
        gaps = arc_gaps(self._points) if spacing == "arc" else np.full(len(z), 1 / len(z))
        angles = 2 * np.pi * (np.cumsum(gaps) - gaps)
        corners, areas = z[self._triangles].mean(axis=1), self.areas
        centre = np.sum(corners * areas) / areas.sum()
        direction = np.sum((z - centre) * np.exp(-1j * angles))
        turn = np.angle(direction) if abs(direction) > 1e-9 * np.abs(z - centre).sum() else 0.0
        disk = centre + np.sqrt(areas.sum() / np.pi) * np.exp(1j * (angles + turn))
        return self.moved(np.stack([disk.real, disk.imag], axis=1))

    def __len__(self) -> int:
        return len(self._points)

    def __repr__(self) -> str:
        return f"Triangulation({len(self)} vertices, {len(self._triangles)} triangles)"


def arc_gaps(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Length of each edge as a share of the whole, never below a thousandth of the mean.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    ndarray of float64, shape (n,)
        Positive, of sum 1; the floor keeps neighbours on a circle apart.
    """
    edges = np.concatenate([points[1:], points[:1]]) - points
    lengths = np.hypot(edges[:, 0], edges[:, 1])
    lengths = np.maximum(lengths, _SMALLEST_GAP * lengths.mean())
    return lengths / lengths.sum()


def canonical(triangles: ArrayLike) -> NDArray[np.int64]:
    """Sort triangles, the smallest corner of each first.

    Parameters
    ----------
    triangles : array_like of int, shape (m, 3)

    Returns
    -------
    ndarray of int, shape (m, 3)
        Equal for equal sets of equally oriented triangles.

    Examples
    --------
    >>> canonical([[2, 3, 0], [1, 2, 0]]).tolist()
    [[0, 1, 2], [0, 2, 3]]
    """
    triangles = np.asarray(triangles, dtype=np.int64)
    turned = _smallest_first(triangles)
    return turned[canonical_order(triangles)]


def _smallest_first(triangles: NDArray[np.int64]) -> NDArray[np.int64]:
    slots = (triangles.argmin(axis=1)[:, None] + np.arange(3)) % 3
    return np.take_along_axis(triangles, slots, axis=1)


def canonical_order(triangles: NDArray[np.int64]) -> NDArray[np.intp]:
    """Find the order of rows in `canonical`.

    Parameters
    ----------
    triangles : ndarray of int, shape (m, 3)

    Returns
    -------
    ndarray of int, shape (m,)
        Row numbers, those with smaller corners first.
    """
    return np.lexsort(_smallest_first(triangles).T[::-1])


def _read_only(values: ArrayLike, dtype: type, name: str) -> NDArray[Any]:
    """Return the array itself where it is read-only already, a read-only copy where not."""
    if isinstance(values, np.ndarray) and values.dtype == dtype and values.flags.owndata and not values.flags.writeable:
        return values
    try:
        if dtype is np.int64 and not np.issubdtype(np.asarray(values).dtype, np.integer):
            raise TriangulationError(f"{name} have dtype {np.asarray(values).dtype}, expected integers")
        array: NDArray[Any] = np.array(values, dtype=dtype)
    except (TypeError, ValueError) as error:
        if isinstance(error, TriangulationError):
            raise
        raise TriangulationError(f"{name} are no array of numbers: {error}") from None
    array.setflags(write=False)
    return array

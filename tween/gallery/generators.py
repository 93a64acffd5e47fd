"""Two ways to make immersed disks: strips along a path, and triangles glued at random.

Legend: ``n`` vertices of a curve, ``m`` of a spine.
"""

from typing import NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError, TriangulationError
from tween.geometry.curve import Curve
from tween.geometry.predicates import orient2d
from tween.geometry.triangulation import Triangulation

GRID = 2.0**-20
"""Coordinates of random disks and of the gallery are multiples of this."""

_Floats = NDArray[np.float64]

_FLAT = 2.0**-50  # 1 - cosine and 1 + cosine below this are rounding errors
_THINNEST = 2.0**-40  # width of a ribbon, as a fraction of the largest coordinate

_SMALLEST_ANGLE = np.radians(15)
_LARGEST_SUM = 2 * np.pi - 0.05
_SHORTEST, _LONGEST = 0.5, 2.0  # edges of a random disk


def ribbon(spine: ArrayLike, width: float, cap: int = 0) -> Curve:
    """Widen an open path to a strip, which overlaps itself where the path crosses itself.

    Parameters
    ----------
    spine : array_like, shape (m, 2), m >= 2
        Points along the path.
    width : float
        Distance between the two sides, in the units of the spine.
    cap : int
        Points by which each end is rounded to a half circle; 0 leaves it flat.

    Returns
    -------
    Curve
        2m + 2 cap vertices: along the right side, around the end, back along the left side, around the
        start.  The sides are mitred: parallel to the spine, at half the width from it.

    Raises
    ------
    CurveError
        Where a bend is too tight for the width, naming the vertex of the spine and its radius of
        curvature; where the spine repeats a point, or one of the arguments is out of range.

    Notes
    -----
    A bend is too tight where one of the 2(m-1) triangles of the strip is not counter-clockwise, exactly.
    At a turn by the angle a the miter takes half the width times tan(a/2) off the inner side of both
    edges.  The radius of curvature of a polygon is therefore understood as the shorter edge over
    2 tan(a/2): on a regular polygon, the radius of the inscribed circle.  Every ribbon exists whose
    half width stays below all radii.

    Examples
    --------
    >>> ribbon([[0, 0], [2, 0], [4, 0]], 1).points.tolist()
    [[0.0, -0.5], [2.0, -0.5], [4.0, -0.5], [4.0, 0.5], [2.0, 0.5], [0.0, 0.5]]
    >>> ribbon([[0, 0], [1, 0], [1, 1]], 3)
    Traceback (most recent call last):
    ...
    tween.errors.CurveError: spine vertex 1: radius of curvature 0.5 is not above half the width, 1.5; take a ...
    """
    path, half = _checked_spine(spine, width), 0.5 * width
    miters, radius = _bends(path)
    right, left = path - half * miters, path + half * miters
    _check_strip(right, left, radius, half)
    end, start = _half_circle(right[-1], left[-1], cap), _half_circle(left[0], right[0], cap)
    strip = Curve(np.concatenate([right, end, left[::-1], start]))
    assert strip.turning_number == 1  # at most two trapezoids, or one and a cap, meet at a vertex: below 2 pi
    return strip


def zigzag(path: ArrayLike, width: float) -> Curve:
    """Widen an open path to a strip whose vertices lie in turn on its right and on its left side.

    Parameters
    ----------
    path : array_like, shape (n, 2), n >= 3
        Points along the path, a vertex each.
    width : float
        Distance between the two sides.

    Returns
    -------
    Curve
        n vertices: along the right side, and back along the left.  Where the path bends gently, the
        zigzag between the sides is its constrained Delaunay triangulation, so that strips with equally
        many vertices have compatible ones.

    Raises
    ------
    CurveError
        As `ribbon`.

    Examples
    --------
    >>> zigzag([[0, 0], [1, 0], [2, 0], [3, 0]], 2).points.tolist()
    [[0.0, -1.0], [2.0, -1.0], [3.0, 1.0], [1.0, 1.0]]
    """
    spine, half = _checked_spine(path, width), 0.5 * width
    miters, radius = _bends(spine)
    side = np.where(np.arange(len(spine)) % 2, 1.0, -1.0)
    p = spine + half * side[:, None] * miters
    for i in np.flatnonzero(orient2d(p[:-2], p[1:-1], p[2:]) * side[1:-1] > 0):
        _too_tight(int(i) + 1, radius, half)
    return Curve(np.concatenate([p[::2], p[1::2][::-1]]))


def fan(rho: float = 2.0) -> tuple[Triangulation, Triangulation]:
    """Make two simple fans between which triangles that stay positive do not keep a disk.

    Parameters
    ----------
    rho : float
        By how much the spokes grow across wide triangles, and shrink across narrow ones.

    Returns
    -------
    source, target : Triangulation
        Ten triangles (0, i, i+1) around a hub, vertex 0 at the origin.  In the source they are 60 and 8 degrees
        wide in turn, 340 in all; across a wide one the spoke grows by the factor `rho`, across a narrow one it
        shrinks by it.  In the target wide and narrow are swapped.

    Notes
    -----
    Along the paper's paths a triangle goes through wider shapes on its way from narrow to wide, and the ten
    angles at the hub add up to more than 2 pi: the boundary then has turning number 2 and bounds no immersed
    disk, against what the paper says of all its intermediate shapes.  How many frames fail depends on the root.

    Examples
    --------
    >>> source, target = fan()
    >>> source.validate().triangles.tolist() == target.validate().triangles.tolist()
    True
    """
    shapes = []
    for wide_first in (True, False):
        wide = np.resize([wide_first, not wide_first], 10)
        angles = np.append(0.0, np.cumsum(np.radians(np.where(wide, 60, 8))))
        radii = np.append(1.0, np.cumprod(np.where(wide, rho, 1 / rho)))
        spokes = xy(radii * np.exp(1j * angles))
        shapes.append(Triangulation(np.concatenate([[[0.0, 0.0]], spokes]), [(0, i, i + 1) for i in range(1, 11)]))
    return shapes[0], shapes[1]


def random_disk(n: int, rng: np.random.Generator) -> Triangulation:
    """Grow a random immersed disk by gluing triangles to its boundary.

    Parameters
    ----------
    n : int
        Number of vertices, at least 3.
    rng : numpy.random.Generator

    Returns
    -------
    Triangulation
        Triangles in the order in which they were glued; vertex 0 belongs to the first.  Angles are 15
        degrees at least and edges 0.5 to 2 long, up to the rounding to `GRID`.

    Raises
    ------
    TriangulationError
        Where n is below 3.

    Notes
    -----
    A triangle of random angles is held to a boundary edge chosen uniformly, and dropped where angles
    at a vertex would add up to within 0.05 of 2 pi or an edge would be too short or too long.  O(n)
    expected.  Nearly all of these disks overlap themselves from 50 vertices on.

    Examples
    --------
    >>> T = random_disk(100, np.random.default_rng(0))
    >>> T.validate() is T, len(T)
    (True, 100)
    """
    if n < 3:
        raise TriangulationError(f"a disk with {n} vertices was asked for, expected at least 3")
    places, following, triangles = _grow(n, rng)
    along = [0]
    while following[along[-1]]:
        along.append(following[along[-1]])
    return Triangulation(xy(np.array(places)[along]), np.argsort(along)[triangles])


def length(path: NDArray[np.float64]) -> float:
    """Measure an open path.

    Parameters
    ----------
    path : ndarray of float64, shape (m, 2)

    Returns
    -------
    float
    """
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def evenly(path: NDArray[np.float64], m: int) -> NDArray[np.float64]:
    """Take points of a path, evenly by arc length, both ends included.

    Parameters
    ----------
    path : ndarray of float64, shape (k, 2)
    m : int
        How many.

    Returns
    -------
    ndarray of float64, shape (m, 2)
    """
    s = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    at = np.linspace(0, s[-1], m)
    return np.stack([np.interp(at, s, path[:, 0]), np.interp(at, s, path[:, 1])], axis=1)


def xy(z: ArrayLike) -> NDArray[np.float64]:
    """Turn complex numbers into points.

    Parameters
    ----------
    z : array_like of complex, shape (...)

    Returns
    -------
    ndarray of float64, shape (..., 2)
    """
    return np.stack([np.real(z), np.imag(z)], axis=-1)


def on_grid(values: ArrayLike) -> NDArray[np.float64]:
    """Round to multiples of `GRID`.

    Parameters
    ----------
    values : array_like

    Returns
    -------
    ndarray of float64
        Such coordinates do not depend on the last bit of a platform's sine, midpoints between them are
        exact, and so are mirror images.
    """
    return np.round(np.asarray(values, dtype=np.float64) / GRID) * GRID


def _checked_spine(spine: ArrayLike, width: float) -> _Floats:
    path = np.asarray(spine, dtype=np.float64)
    if path.ndim != 2 or path.shape[1] != 2 or len(path) < 2:
        raise CurveError(f"the spine has shape {path.shape}, expected (m, 2) with m >= 2")
    for i in np.flatnonzero(~np.isfinite(path).all(axis=1)):
        raise CurveError(f"spine vertex {i} is {path[i].tolist()}, expected finite coordinates")
    for i in np.flatnonzero((path[1:] == path[:-1]).all(axis=1)):
        raise CurveError(f"spine vertices {i} and {i + 1} are the same point")
    thinnest = _THINNEST * np.abs(path).max()
    if not thinnest < width < np.inf:
        raise CurveError(f"the ribbon is {width:g} wide, expected more than {thinnest:.1e} for this spine")
    return path


def _bends(path: _Floats) -> tuple[_Floats, _Floats]:
    """Offset of the left side at unit distance, shape (m, 2), and radius of curvature, shape (m,)."""
    edges = np.diff(path, axis=0)
    lengths = np.pad(np.hypot(*edges.T), 1, mode="edge")
    normals = np.pad(np.stack([-edges[:, 1], edges[:, 0]], axis=1), [(1, 1), (0, 0)], mode="edge") / lengths[:, None]
    before, after = normals[:-1], normals[1:]
    cosine = np.sum(before * after, axis=1)
    toward, against = np.maximum(1 + cosine, _FLAT), np.maximum(1 - cosine, _FLAT)
    radius = np.minimum(lengths[:-1], lengths[1:]) / (2 * np.sqrt(against / toward))
    return (before + after) / toward[:, None], radius


def _check_strip(right: _Floats, left: _Floats, radius: _Floats, half: float) -> None:
    """Raise the `CurveError` that names the vertex at the first triangle that is not counter-clockwise."""
    lower, upper = orient2d(right[:-1], right[1:], left[:-1]), orient2d(right[1:], left[1:], left[:-1])
    for q in np.flatnonzero((lower <= 0) | (upper <= 0)):
        i = q + int(radius[q + 1] < radius[q])
        _too_tight(int(i), radius, half)


def _too_tight(i: int, radius: _Floats, half: float) -> NoReturn:
    found = f"radius of curvature {radius[i]:.3g} is not above half the width, {half:.3g}"
    raise CurveError(f"spine vertex {i}: {found}; take a narrower ribbon")


def _half_circle(start: _Floats, end: _Floats, count: int) -> _Floats:
    """Points between start and end, to the right of the way from one to the other."""
    a, b = start @ np.array([1, 1j]), end @ np.array([1, 1j])
    return xy((a + b) / 2 + (a - b) / 2 * np.exp(1j * np.pi * np.arange(1, count + 1) / (count + 1)))


def _grow(n: int, rng: np.random.Generator) -> tuple[list[complex], list[int], list[tuple[int, int, int]]]:
    """Start from one edge with two sides: places, next vertex along the boundary, triangles."""
    places, following, sums = [0j, 1 + 0j], [1, 0], [0.0, 0.0]
    triangles: list[tuple[int, int, int]] = []
    while len(places) < n:
        a = int(rng.integers(len(places)))
        b, c = following[a], len(places)
        at_a, at_b, at_c = _SMALLEST_ANGLE + (np.pi - 3 * _SMALLEST_ANGLE) * rng.dirichlet((2, 2, 2))
        base = places[b] - places[a]
        sides = abs(base) * np.sin([at_a, at_b]) / np.sin(at_c)
        fits = _SHORTEST <= sides.min() and sides.max() <= _LONGEST
        if not fits or sums[a] + at_a > _LARGEST_SUM or sums[b] + at_b > _LARGEST_SUM:
            continue
        place = places[a] + base * np.sin(at_b) / np.sin(at_c) * np.exp(-1j * at_a)
        places.append(complex(*on_grid(xy(place))))
        following[a] = c
        following.append(b)
        sums[a], sums[b] = sums[a] + at_a, sums[b] + at_b
        sums.append(at_c)
        triangles.append((a, c, b))
    return places, following, triangles

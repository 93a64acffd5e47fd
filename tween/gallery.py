"""Curves to try things on: named ones, strips along a path, random disks, handwriting.

All but `ribbon` put their points on a grid, so that coordinates do not depend on the last bit of a
platform's sine, midpoints of edges are exact, and a mirror image is one exactly.

Legend: ``n`` vertices of a curve, ``m`` of a spine; ``t`` a parameter along a path; ``z = x + iy``.
"""

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import BSpline

from tween.curve import Curve
from tween.errors import CurveError, TriangulationError
from tween.predicates import orient2d
from tween.triangulation import Triangulation

GRID = 2.0**-20
"""Every coordinate made here is a multiple of this; `ribbon` alone keeps to the scale of its spine."""

PEN = 1.1
"""Width of the pen for letters, in units of the Hershey fonts, whose capitals are 21 units high."""

_Floats = NDArray[np.float64]
_Complexes = NDArray[np.complex128]

_CAP = 3  # points of a rounded end
_FINE = 2400  # points of a path before it is resampled
_FLAT = 2.0**-50  # 1 - cosine and 1 + cosine below this are rounding errors
_THINNEST = 2.0**-40  # width of a ribbon, as a fraction of the largest coordinate

_SMALLEST_ANGLE = np.radians(15)
_LARGEST_SUM = 2 * np.pi - 0.05
_SHORTEST, _LONGEST = 0.5, 2.0  # edges of a random disk

_LETTERS = "CDIJLOPQRSUVZcdeloz"
_BASE_LINE = 9  # of the font, whose y runs down
_STEP = 1.3  # between points along a letter
_NARROWING = 0.75 ** np.arange(20)  # of the pen, down to 0.005


def names() -> tuple[str, ...]:
    """List the named curves, simple ones first.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> names()[:3]
    ('convex', 'arrow', 'ell')
    """
    return tuple(_CURVES)


@cache
def curve(name: str) -> Curve:
    """Make a named curve; each bounds an immersed disk.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    Curve
        40 to 130 vertices, 1 to 10 units across.

    Raises
    ------
    CurveError
        Where there is no such name; the message lists those there are.

    Examples
    --------
    >>> curve("horseshoe")
    Curve(90 vertices, turning number 1)
    """
    return Curve(_on_grid(_entry(name)[1]()))


def describe(name: str) -> str:
    """Say what a named curve is.

    Parameters
    ----------
    name : str
        One of `names`.

    Returns
    -------
    str
        One sentence.

    Raises
    ------
    CurveError
        Where there is no such name; the message lists those there are.

    Examples
    --------
    >>> describe("ell")
    'A tapering letter L: a single reflex corner.'
    """
    return _entry(name)[0]


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
    return Triangulation(_xy(np.array(places)[along]), np.argsort(along)[triangles])


def letters() -> tuple[str, ...]:
    """List the letters that one stroke draws and that `letter` writes with the full `PEN`.

    Returns
    -------
    tuple of str
        All but C, U and c cross themselves.

    Examples
    --------
    >>> "".join(letters())
    'CDIJLOPQRSUVZcdeloz'
    """
    return tuple(_LETTERS)


@cache
def letter(char: str, width: float | None = None) -> Curve:
    """Write a character with a pen: a `ribbon` along its longest stroke in the Hershey script font.

    Parameters
    ----------
    char : str
        A printable ASCII character; further strokes of it are left out.
    width : float, optional
        Width of the pen in font units (capitals are 21 high), at least 0.01.  Without it, `PEN`,
        narrowed by a quarter as often as the tightest bend asks for.

    Returns
    -------
    Curve
        60 to 120 vertices; y up, letters stand on y = 0.

    Raises
    ------
    CurveError
        Where the font has no stroke for the character, listing those it has; or where the given width
        is too large, naming the character and the vertex of the spine.

    Notes
    -----
    The drawn points control a cubic B-spline, which rounds corners and never overshoots; the spine is
    taken from it evenly by arc length.

    Examples
    --------
    >>> letter("e")
    Curve(62 vertices, turning number 1)

    References
    ----------
    A. V. Hershey, *Calligraphy for computers*, U.S. Naval Weapons Laboratory, report 2101 (1967).
    """
    if width is not None and not width >= 0.01:
        raise CurveError(f"letter {char!r}: the pen is {width:g} wide, expected at least 0.01")
    spine = _handwriting(char)
    for pen in PEN * _NARROWING if width is None else [width]:
        try:
            return Curve(_on_grid(ribbon(spine, pen, _CAP).points))
        except CurveError as error:
            fault = error
    raise CurveError(f"letter {char!r}: {fault}")


# Named curves


def _strip(spine: Callable[[_Floats], _Complexes], start: float, stop: float, m: int, width: float) -> _Floats:
    return ribbon(_even(_xy(spine(np.linspace(start, stop, _FINE))), m), width, _CAP).points


def _spiral(turns: float, m: int) -> _Floats:
    return _strip(lambda t: (0.9 + t) * _unit(t), 0, turns, m, 0.66)


def _trochoid(stop: float, m: int) -> _Floats:
    """The way of a point far outside the rim of a rolling wheel: one loop a turn."""
    return _strip(lambda t: 3.2 * t - 1.6j * _unit(-t), -0.5, stop, m, 0.8)


def _egg() -> _Floats:
    """Tangent points, from the distance of the tangent in each direction: its second derivative stays above -2."""
    t = 2 * np.pi * np.arange(_FINE) / _FINE
    distance = 2 + 0.3 * np.cos(2 * t + 0.4) + 0.09 * np.cos(3 * t + 1)
    slope = -0.6 * np.sin(2 * t + 0.4) - 0.27 * np.sin(3 * t + 1)
    return _closed((distance + 1j * slope) * np.exp(1j * t), 48)


def _clover() -> _Floats:
    """Leaves so wide that the angle has to run back between them; then all are swept around."""
    t = 2 * np.pi * np.arange(_FINE) / _FINE
    radius = 0.6 + 1.2 * np.cos(1.5 * t) ** 8
    angle = t + 0.4 * np.sin(6 * t) + 0.8 * np.sin(3 * t) + 0.6 * radius
    return _closed(radius * np.exp(1j * angle), 96)


def _comb() -> _Floats:
    t = np.linspace(0.11, 0.41, 22)
    outer = np.where(np.arange(22) // 2 % 2, 3.2, np.linspace(4.4, 5.3, 22)) * _unit(t)
    return _outline(np.append(outer, 2.3 * _unit(t[::-3])), 0.5)


def _fourier(coefficients: dict[int, float]) -> _Floats:
    t = np.arange(96) / 96
    return _xy(np.sum([c * _unit(k * t) for k, c in coefficients.items()], axis=0))


_ARROW = [-0.4j, 3 - 0.6j, 2.7 - 1.5j, 6 + 0.2j, 2.9 + 1.7j, 3.1 + 0.7j, 0.1 + 0.6j, 0.7 + 0.1j]
_ELL = [0, 4.1 + 0.2j, 4 + 1.2j, 1.5 + 1.4j, 1.2 + 5j, 0.1 + 4.9j]
_TWO_DISKS = {-1: 0.15013, 1: -0.000635, -3: 0.22576, 3: 0.632474, -5: 0.093462, 5: -0.34906}
_FIVE_DISKS = {1: -0.107563, -2: -0.126553, 4: 0.585798, -5: 0.11994, 7: -0.299042, -8: 0.115374}

_CURVES: dict[str, tuple[str, Callable[[], _Floats]]] = {
    "convex": ("An irregular convex curve, a little like an egg.", _egg),
    "arrow": ("An arrow: simple, not convex.", lambda: _outline(_ARROW, 0.4)),
    "ell": ("A tapering letter L: a single reflex corner.", lambda: _outline(_ELL, 0.37)),
    "comb": ("A bent comb of six teeth.", _comb),
    "ess": (
        "A strip in the shape of an S.",
        lambda: _strip(lambda t: -2.4 * np.sin(2 * t) + 4.2j * np.sin(t), -2.2, 2.2, 44, 1.1),
    ),
    "spiral_1": ("A strip that winds around 1.4 times, clear of itself.", lambda: _spiral(1.4, 44)),
    "spiral_2": ("A strip that winds around 2.2 times, clear of itself.", lambda: _spiral(2.2, 60)),
    "horseshoe": (
        "A horseshoe bent until its two ends lie over each other.",
        lambda: _strip(lambda t: (2 - 0.75 * t) * (1.06j * _unit(t) + 0.12j * _unit(-t)), -0.64, 0.64, 42, 1.2),
    ),
    "loop": ("A ribbon that makes a loop and crosses itself.", lambda: _trochoid(0.45, 40)),
    "two_loops": ("A ribbon that makes two loops, one after the other.", lambda: _trochoid(1.45, 58)),
    "pretzel": (
        "A ribbon tied like a pretzel: it crosses itself in the middle, and its ends reach over its bows.",
        lambda: _strip(lambda t: 4 * np.sin(1.6 * t) * np.cos(0.2 * t) + 3j * np.cos(2 * t), -2.6, 2.55, 60, 0.8),
    ),
    "three_lobes": ("A clover of three lobes, each reaching over the next.", _clover),
    "winding_3": (
        "A ramp that winds so far around that it covers a part of the plane three times.",
        lambda: _strip(lambda t: (1.2 + 0.35 * t) * _unit(t), 0, 2.6, 56, 1.3),
    ),
    "two_disks": ("A curve that, like Milnor's, bounds two different immersed disks.", lambda: _fourier(_TWO_DISKS)),
    "five_disks": ("A curve that, like Bennequin's, bounds five different ones.", lambda: _fourier(_FIVE_DISKS)),
}


def _entry(name: str) -> tuple[str, Callable[[], _Floats]]:
    if name not in _CURVES:
        raise CurveError(f"there is no curve {name!r}; expected one of {', '.join(_CURVES)}")
    return _CURVES[name]


# Paths


def _unit(turns: _Floats) -> _Complexes:
    return np.exp(2j * np.pi * turns)


def _xy(z: ArrayLike) -> _Floats:
    return np.stack([np.real(z), np.imag(z)], axis=-1)


def _on_grid(values: ArrayLike) -> _Floats:
    return np.round(np.asarray(values, dtype=np.float64) / GRID) * GRID


def _length(path: _Floats) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def _even(path: _Floats, m: int) -> _Floats:
    """Take m points of a path, evenly by arc length."""
    s = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    at = np.linspace(0, s[-1], m)
    return np.stack([np.interp(at, s, path[:, 0]), np.interp(at, s, path[:, 1])], axis=1)


def _closed(z: _Complexes, n: int) -> _Floats:
    return _even(_xy(np.append(z, z[0])), n + 1)[:-1]


def _outline(corners: ArrayLike, step: float) -> _Floats:
    """Divide the sides of a polygon evenly, into pieces of about the given length."""
    start = np.asarray(corners)
    side = np.roll(start, -1) - start
    pieces = np.maximum(1, np.round(np.abs(side) / step)).astype(int)
    return _xy(np.concatenate([a + d * np.arange(k) / k for a, d, k in zip(start, side, pieces, strict=True)]))


# Ribbons


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
        found = f"radius of curvature {radius[i]:.3g} is not above half the width, {half:.3g}"
        raise CurveError(f"spine vertex {i}: {found}; take a narrower ribbon")


def _half_circle(start: _Floats, end: _Floats, count: int) -> _Floats:
    """Points between start and end, to the right of the way from one to the other."""
    a, b = start @ np.array([1, 1j]), end @ np.array([1, 1j])
    return _xy((a + b) / 2 + (a - b) / 2 * _unit(np.arange(1, count + 1) / (2 * count + 2)))


# Random disks


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
        places.append(complex(*_on_grid(_xy(place))))
        following[a] = c
        following.append(b)
        sums[a], sums[b] = sums[a] + at_a, sums[b] + at_b
        sums.append(at_c)
        triangles.append((a, c, b))
    return places, following, triangles


# Handwriting


@cache
def _strokes() -> dict[str, _Floats]:
    """Longest stroke of every character that has one, shape (k, 2), y up."""
    from HersheyFonts import HersheyFonts  # here, as only letters need it

    font = HersheyFonts()
    font.load_default_font("scripts")
    longest = {}
    for char in map(chr, range(32, 127)):
        strokes = [np.array(stroke, dtype=np.float64) for stroke in font.strokes_for_text(char)]
        if strokes:
            longest[char] = np.array([0, _BASE_LINE]) + [1, -1] * max(strokes, key=_length)
    return longest


def _handwriting(char: str) -> _Floats:
    """Spine of a character: a clamped B-spline with the points of the stroke as control points."""
    if char not in _strokes():
        raise CurveError(f"the font has no stroke for {char!r}; expected one of {' '.join(_strokes())}")
    stroke = _strokes()[char]
    stroke = stroke[np.append(True, (stroke[1:] != stroke[:-1]).any(axis=1))]
    degree = min(3, len(stroke) - 1)
    knots = np.pad(np.linspace(0, 1, len(stroke) - degree + 1), degree, mode="edge")
    m = int(np.clip(_length(stroke) / _STEP, 28, 56))
    return _even(BSpline(knots, stroke, degree)(np.linspace(0, 1, _FINE)), m)

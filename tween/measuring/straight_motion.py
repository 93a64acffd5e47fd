r"""Straight motion between frames: whether every instant of it bounds an immersed disk, decided exactly.

What people play is frames, and straight motion between them: vertex v goes from one place a to the next, b, as
(1-s) a + s b, for all real s from 0 to 1.  Let the triangles be those of a disk and let both frames keep every rule
of `tween.measuring.frame_check` under them.  Then two things alone can go wrong on the way:

1.  *A triangle loses its area.*  Twice its area is a quadratic with Bernstein coefficients c0, c1, c2,

        c0 (1-s)^2 + 2 c1 s (1-s) + c2 s^2,        c0, c2 > 0 by the frames.

    Divided by (1-s)^2 it is c0 + 2 c1 x + c2 x^2 in x = s / (1-s) > 0, which stays positive if and only if
    c1 >= 0 or c1^2 < c0 c2.  At a double root the triangle only touches zero; that is refused too.

2.  *The angles at a vertex v reach 2 pi.*  Let u lead from v to its successor on the curve, and w to its
    predecessor.  While all areas are positive, u and w are never zero, each angle at v lies strictly between 0 and
    pi and depends continuously on s, and so does their sum A > 0, the angle from u on to w: A is the angle of w / u up
    to a multiple of 2 pi.  By the frames A < 2 pi at both ends.

    *A reaches 2 pi at some s if and only if at some s in (0, 1) u x w = 0 and u . w > 0.*  If A gets to 2 pi or
    beyond, then by continuity it is exactly 2 pi somewhere between, and there u and w point the same way.  If they do
    at some s, then A is there a multiple of 2 pi, and positive, hence 2 pi at least.

    So it need not be counted how often A comes and goes.  The roots of the quadratic u x w in (0, 1) are looked
    at one by one: two of them, or a double one, where A may touch 2 pi (a spike) and go back.  Roots at 0 and 1 are
    the frames' and settled.  Where u x w vanishes identically, A is a multiple of pi throughout and pi at the
    ends, so it is pi throughout: no failure.  A vertex of fewer than three triangles cannot reach 2 pi.

Diagonals need nothing more: edges between positive triangles glued to a disk.  The first instant at which either
happens is the first failure, since up to there all areas are positive, as the second argument supposes.

Where the triangles change between two frames, one of the two lists must hold for the whole interval, at both frames
and between.  Either will do: to bound an immersed disk is a property of the curve, not of the triangles that show it.

*How it is decided.*  In doubles with bounds on all rounding errors; a vertex that is in doubt, once more in sixteen
pieces.  The few elements still in doubt are decided in whole numbers: doubles of the range that frames may have
are multiples of 2**-252, and a root of a quadratic is a + b sqrt(d), whose sign needs no root.  No code is shared with
the rest of tween.

Legend: ``a b`` a place at s = 0 and at s = 1; ``u w`` edges at a vertex; ``c0 c1 c2`` Bernstein coefficients, ``e0 e1
e2`` bounds of their errors; ``f`` frame; ``m`` number of triangles; ``x`` = s / (1-s).

References
----------
V. Surazhsky, C. Gotsman, *Controllable morphing of compatible planar triangulations*, ACM Transactions on Graphics 20
(2001) 203-231: when linear trajectories keep the triangles of a triangulation positive.
P. W. Shor, C. J. Van Wyk, *Detecting and decomposing self-overlapping curves*, Computational Geometry 2 (1992) 31-50.
"""

from collections.abc import Sequence
from math import isqrt, ldexp
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

_ROUNDING = 2.0**-50  # relative, eight times that of one operation: a coefficient takes five, one after the other
_SLACK = 1.0 - 2.0**-48  # for the handful of operations that compare what is known with its bounds
_UNDERFLOW = 2.0**-1060  # above what products of four coordinates lose where they leave the normal doubles
_PIECES = 16  # in which a vertex in doubt is looked at again
_FINEST = 252  # coordinates of frames that were checked are multiples of 2**-252

_Quadratic = tuple[int, int, int]  # whole c0, 2 c1, c2: coefficients of 1, x and x^2


class Breach(NamedTuple):
    """Where straight motion first breaks a rule.

    Attributes
    ----------
    s : float
        From 0, the frame before, to 1, the frame after; correct to double precision.
    kind : {"triangle", "vertex"}
        Whether a triangle loses its area, or the angles at a vertex reach 2 pi.
    element : int
        Which triangle, or which vertex.
    """

    s: float
    kind: str
    element: int


def breaches(start: NDArray[np.float64], end: NDArray[np.float64], triangles: NDArray[np.int64]) -> list[Breach | None]:
    """Find where straight motion from shapes to shapes first breaks a rule, under triangles valid at both.

    Parameters
    ----------
    start, end : ndarray of float64, shape (k, n, 2)
        Shapes that, each under the same triangles, keep every rule of `tween.verify`.
    triangles : ndarray of int64, shape (k, n-2, 3)

    Returns
    -------
    list of Breach or None, length k
        None where no rule is broken at any instant.

    Notes
    -----
    O(n k): about 30 nanoseconds a triangle and vertex; some tens of microseconds for each of those
    in doubt or at fault.

    Examples
    --------
    >>> a = np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]])
    >>> breaches(a, -a, np.array([[[0, 1, 2]]]))
    [Breach(s=0.5, kind='triangle', element=0)]
    """
    (k, n, _), m = start.shape, triangles.shape[1]
    triangle_doubts, vertex_doubts = np.empty((k, m), np.bool_), np.empty((k, n), np.bool_)
    _sift(start, end, np.ascontiguousarray(triangles), triangle_doubts, vertex_doubts)
    found: list[Breach | None] = [None] * k
    for f in np.flatnonzero(triangle_doubts.any(axis=1) | vertex_doubts.any(axis=1)).tolist():
        corners = {("triangle", i): triangles[f, i].tolist() for i in np.flatnonzero(triangle_doubts[f]).tolist()}
        corners |= {("vertex", v): [v, (v + 1) % n, v - 1] for v in np.flatnonzero(vertex_doubts[f]).tolist()}
        broken = [
            Breach(s, *element)
            for element, rows in corners.items()
            if (s := _first_instant(element[0], start[f, rows], end[f, rows])) is not None
        ]
        found[f] = min(broken, default=None)
    return found


# The filter


@njit(cache=True)
def _sift(start, end, triangles, triangle_doubts, vertex_doubts):
    """Mark the triangles, (k, m), and the vertices, (k, n), that doubles cannot clear."""
    n = start.shape[1]
    size = np.empty(n, np.int64)
    for f in range(len(start)):
        a, b = start[f], end[f]
        size[:] = 0
        for i in range(triangles.shape[1]):
            p, q, r = triangles[f, i]
            c0, c1, c2, e0, e1, e2 = _product(a, b, p, q, p, r, False)
            triangle_doubts[f, i] = not _stays_positive(c0, c1, c2, e0, e1, e2)
            size[p] += 1
            size[q] += 1
            size[r] += 1
        for v in range(n):
            vertex_doubts[f, v] = size[v] >= 3 and not _never_alike(a, b, v, (v + 1) % n, (v - 1) % n)


@njit(cache=True)
def _product(a, b, p, q, r, s, inner):
    """Coefficients, and bounds of their errors, of (q - p) x (s - r), or of the inner product of the two."""
    ux, uy, wx, wy = a[q, 0] - a[p, 0], a[q, 1] - a[p, 1], a[s, 0] - a[r, 0], a[s, 1] - a[r, 1]
    vx, vy, zx, zy = b[q, 0] - b[p, 0], b[q, 1] - b[p, 1], b[s, 0] - b[r, 0], b[s, 1] - b[r, 1]
    if inner:  # u . w is u x w with w turned left by a quarter
        wx, wy, zx, zy = -wy, wx, -zy, zx
    c0, c1, c2 = ux * wy - uy * wx, 0.5 * ((ux * zy - uy * zx) + (vx * wy - vy * wx)), vx * zy - vy * zx
    e0, e2 = abs(ux * wy) + abs(uy * wx), abs(vx * zy) + abs(vy * zx)
    e1 = 0.5 * ((abs(ux * zy) + abs(uy * zx)) + (abs(vx * wy) + abs(vy * wx)))
    return c0, c1, c2, _ROUNDING * e0, _ROUNDING * e1, _ROUNDING * e2


@njit(cache=True, inline="always")
def _stays_positive(c0, c1, c2, e0, e1, e2):
    """Whether a quadratic that is positive at both ends surely is so between them."""
    if c1 >= e1:
        return True
    low, high, deep = c0 - e0, c2 - e2, e1 - c1
    return low > 0.0 and high > 0.0 and deep * deep + _UNDERFLOW < low * high * _SLACK


@njit(cache=True, inline="always")
def _never_alike(a, b, v, successor, predecessor):
    """Whether the edges at v surely never point the same way, looking at one piece and then at many."""
    c0, c1, c2, e0, e1, e2 = _product(a, b, v, successor, v, predecessor, False)
    d0, d1, d2, g0, g1, g2 = _product(a, b, v, successor, v, predecessor, True)
    if min(c0 - e0, c1 - e1, c2 - e2) > 0.0 or max(c0 + e0, c1 + e1, c2 + e2) < 0.0:
        return True
    if max(d0 + g0, d1 + g1, d2 + g2) < 0.0:
        return True
    # A piece's coefficients are means of the whole's, so errors do not grow but for the rounding of the means.
    e = max(e0, e1, e2) + _ROUNDING * max(abs(c0), abs(c1), abs(c2))
    g = max(g0, g1, g2) + _ROUNDING * max(abs(d0), abs(d1), abs(d2))
    for piece in range(_PIECES):
        x, y = piece / _PIECES, (piece + 1) / _PIECES
        low, high = _range(c0, c1, c2, x, y)
        if low <= e and high >= -e and _range(d0, d1, d2, x, y)[1] >= -g:
            return False
    return True


@njit(cache=True)
def _range(c0, c1, c2, x, y):
    """The least and the largest Bernstein coefficient of a quadratic between x and y."""
    first = _blossom(c0, c1, c2, x, x)
    middle = _blossom(c0, c1, c2, x, y)
    last = _blossom(c0, c1, c2, y, y)
    return min(first, middle, last), max(first, middle, last)


@njit(cache=True)
def _blossom(c0, c1, c2, x, y):
    return (1.0 - x) * ((1.0 - y) * c0 + y * c1) + x * ((1.0 - y) * c1 + y * c2)


# Whole numbers


def _first_instant(kind: str, start: NDArray[np.float64], end: NDArray[np.float64]) -> float | None:
    """When a triangle loses its area, or a vertex, given before its successor and predecessor, reaches 2 pi."""
    a, b = ([[int(ldexp(c, _FINEST)) for c in place] for place in shape.tolist()] for shape in (start, end))
    (u, w), (v, z) = ([(q[0] - p[0][0], q[1] - p[0][1]) for q in p[1:]] for p in (a, b))
    cross = _cross(u, w), _cross(u, z) + _cross(v, w), _cross(v, z)
    if kind == "triangle":
        return _first_root(cross) if cross[1] < 0 else None
    w, z = (-w[1], w[0]), (-z[1], z[0])
    return _first_root(cross, (_cross(u, w), _cross(u, z) + _cross(v, w), _cross(v, z)))


def _cross(u: tuple[int, int], w: tuple[int, int]) -> int:
    return u[0] * w[1] - u[1] * w[0]


def _first_root(c: _Quadratic, d: _Quadratic = (1, 0, 0)) -> float | None:
    """The first s in (0, 1), as a double, at which the quadratic c is 0 and the quadratic d positive."""
    if c[2] == 0:
        hit = c[0] * c[1] < 0 and d[0] * c[1] ** 2 - d[1] * c[0] * c[1] + d[2] * c[0] ** 2 > 0
        return c[0] / (c[0] - c[1]) if hit else None
    discriminant = c[1] ** 2 - 4 * c[0] * c[2]
    if discriminant < 0:
        return None
    side = 1 if c[2] > 0 else -1
    slope, height = c[2] * d[1] - d[2] * c[1], c[2] * d[0] - d[2] * c[0]  # c2 d = slope x + height where c = 0
    level = 2 * c[2] * height - slope * c[1]
    return min(
        (
            _place(c, discriminant, root)
            for root in (1, -1)
            if side * _sign(-c[1], root, discriminant) > 0 and _sign(level, root * slope, discriminant) > 0
        ),
        default=None,
    )


def _sign(a: int, b: int, d: int) -> int:
    """The sign of a + b sqrt(d), d not negative."""
    first, second = _compare(a, 0), _compare(b * d, 0)
    return first * _compare(a * a, b * b * d) if first * second < 0 else _compare(first + second, 0)


def _compare(a: int, b: int) -> int:
    return (a > b) - (a < b)


def _place(c: Sequence[int], discriminant: int, root: int) -> float:
    """S = x / (1+x) at the positive root x = (-c1 +- sqrt(discriminant)) / (2 c2), without cancellation."""
    r = root * isqrt(discriminant << 128)  # 64 bits after the point
    middle = -c[1] << 64
    above, below = (middle + r, c[2] << 65) if middle * root >= 0 else (c[0] << 65, middle - r)
    return above / (above + below)

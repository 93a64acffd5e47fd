r"""Exact signs of the two determinants on which every decision of tween rests.

``orient2d`` and ``incircle`` first evaluate their determinant in doubles.  Where the result is
smaller than its rounding error could be, they evaluate it again without any rounding, see `.expansions`.

The answer is exact for coordinates that are 0 or lie in magnitude within `.EXACT_RANGE`.  Every term
of the expansions is a multiple of the fourth power of the smallest last bit, (2**-200 * 2**-52)**4
= 2**-1008, and stays below 2**820, so that nothing underflows or overflows on the way.
`tween.Curve` refuses other coordinates.

Legend: ``a b c d`` points.

References
----------
J. R. Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*,
Discrete & Computational Geometry 18 (1997) 305-363: error bounds in Section 4, expansions in Section 2.
"""

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from tween.geometry.expansions import incircle_exact, orient2d_exact, sign

EXACT_RANGE = (2.0**-200, 2.0**200)
"""Magnitudes (smallest, largest) of nonzero coordinates for which the predicates are exact."""

_EPSILON = 2.0**-53
_ORIENT_BOUND = (3.0 + 16.0 * _EPSILON) * _EPSILON
_INCIRCLE_BOUND = (10.0 + 96.0 * _EPSILON) * _EPSILON


@njit(cache=True)
def orient2d_sign(ax, ay, bx, by, cx, cy):
    """`orient2d` of three points given by coordinates, for compiled kernels."""
    left = (ax - cx) * (by - cy)
    right = (ay - cy) * (bx - cx)
    det = left - right
    # beyond this bound rounding cannot have turned the sign; strict, so that 0 is never taken on trust
    if abs(det) > _ORIENT_BOUND * (abs(left) + abs(right)):
        return sign(det)
    return orient2d_exact(ax, ay, bx, by, cx, cy)


@njit(cache=True)
def incircle_sign(ax, ay, bx, by, cx, cy, dx, dy):
    """`incircle` of four points given by coordinates, for compiled kernels."""
    a1, a2, b1, b2, c1, c2 = ax - dx, ay - dy, bx - dx, by - dy, cx - dx, cy - dy
    b1c2, c1b2, c1a2, a1c2, a1b2, b1a2 = b1 * c2, c1 * b2, c1 * a2, a1 * c2, a1 * b2, b1 * a2
    # heights over d on the paraboloid: d is inside where the plane through a, b and c passes above it
    a_lift, b_lift, c_lift = a1 * a1 + a2 * a2, b1 * b1 + b2 * b2, c1 * c1 + c2 * c2
    det = a_lift * (b1c2 - c1b2) + b_lift * (c1a2 - a1c2) + c_lift * (a1b2 - b1a2)
    # the same sum with all terms positive: what the rounding error is in proportion to
    size = a_lift * (abs(b1c2) + abs(c1b2)) + b_lift * (abs(c1a2) + abs(a1c2)) + c_lift * (abs(a1b2) + abs(b1a2))
    if abs(det) > _INCIRCLE_BOUND * size:
        return sign(det)
    return incircle_exact(ax, ay, bx, by, cx, cy, dx, dy)


@njit(cache=True, inline="always")
def turn(points, i, j, k):
    """`orient2d` of rows i, j, k of an (n,2) array, for compiled kernels."""
    return orient2d_sign(points[i, 0], points[i, 1], points[j, 0], points[j, 1], points[k, 0], points[k, 1])


@njit(cache=True, inline="always")
def in_circumcircle(points, i, j, k, m):
    """`incircle` of rows i, j, k, m of an (n,2) array, for compiled kernels."""
    return incircle_sign(
        points[i, 0],
        points[i, 1],
        points[j, 0],
        points[j, 1],
        points[k, 0],
        points[k, 1],
        points[m, 0],
        points[m, 1],
    )


@njit(cache=True)
def _orient2d_rows(a, b, c, signs):
    for m in range(signs.size):
        signs[m] = orient2d_sign(a[m, 0], a[m, 1], b[m, 0], b[m, 1], c[m, 0], c[m, 1])


@njit(cache=True)
def _incircle_rows(a, b, c, d, signs):
    for m in range(signs.size):
        signs[m] = incircle_sign(a[m, 0], a[m, 1], b[m, 0], b[m, 1], c[m, 0], c[m, 1], d[m, 0], d[m, 1])


def _apply(rows, *points):
    """Broadcast points of shape (..., 2), run a row kernel over them, give the signs their shape back."""
    given = [np.asarray(p, dtype=np.float64) for p in points]
    for p in given:
        if p.shape[-1:] != (2,):
            raise ValueError(f"points have shape {p.shape}, expected (..., 2)")
    arrays = np.broadcast_arrays(*given)
    shape = arrays[0].shape
    signs = np.empty(int(np.prod(shape[:-1])), dtype=np.int8)
    rows(*(np.ascontiguousarray(p).reshape(-1, 2) for p in arrays), signs)
    return signs.reshape(shape[:-1])[()]


def orient2d(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> NDArray[np.int8]:
    """Tell on which side of the line from a to b the point c lies, exactly.

    Parameters
    ----------
    a, b, c : array_like, shape (..., 2)
        Points; the leading shapes are broadcast against each other.

    Returns
    -------
    sign : int8 or ndarray of int8, shape (...)
        +1 where a, b, c is a left turn (counter-clockwise), -1 where it is a right turn, 0 where the
        three are collinear.

    Notes
    -----
    Exact for coordinates within `.EXACT_RANGE`, see the module.  Some nanoseconds a triple; about a
    microsecond for triples that are collinear to within rounding.

    Examples
    --------
    >>> orient2d([0, 0], [1, 0], [0.5, 2**-200])
    np.int8(1)
    >>> orient2d([0, 0], [1, 1], [[2, 2], [2, 3], [3, 2]])
    array([ 0,  1, -1], dtype=int8)

    References
    ----------
    Shewchuk (1997), Section 4.1.
    """
    return _apply(_orient2d_rows, a, b, c)


def incircle(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike) -> NDArray[np.int8]:
    """Tell whether d lies inside the circle through a, b, c, exactly.

    Parameters
    ----------
    a, b, c, d : array_like, shape (..., 2)
        Points, a, b, c counter-clockwise (clockwise triples give the opposite sign); the leading
        shapes are broadcast against each other.

    Returns
    -------
    sign : int8 or ndarray of int8, shape (...)
        +1 where d is inside, -1 where it is outside, 0 where the four are cocircular (or a, b, c and
        d all lie on one line).

    Notes
    -----
    Exact for coordinates within `.EXACT_RANGE`, see the module.  Some nanoseconds a quadruple; up to
    some tens of microseconds for those that are cocircular to within rounding.

    Examples
    --------
    >>> incircle([1, 0], [0, 1], [-1, 0], [[0, -1], [0, 0], [0, -2]])
    array([ 0,  1, -1], dtype=int8)

    References
    ----------
    Shewchuk (1997), Section 4.3.
    """
    return _apply(_incircle_rows, a, b, c, d)

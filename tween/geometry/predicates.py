r"""Exact signs of the two determinants on which every decision of tween rests.

``orient2d`` and ``incircle`` first evaluate their determinant in doubles.  Where the result is
smaller than its rounding error could be, they evaluate it again without any rounding, as a
*floating-point expansion*: a sum of doubles that do not overlap, smallest first, whose sign is the
sign of its last term.

The answer is exact for coordinates that are 0 or lie in magnitude within `.EXACT_RANGE`.  Every term
of the expansions is a multiple of the fourth power of the smallest last bit, (2**-200 * 2**-52)**4
= 2**-1008, and stays below 2**820, so that nothing underflows or overflows on the way.
`tween.Curve` refuses other coordinates.

Legend: ``a b c d`` points; ``e f g h`` expansions; ``hi lo`` a rounded value and its rounding error.

References
----------
J. R. Shewchuk, *Adaptive precision floating-point arithmetic and fast robust geometric predicates*,
Discrete & Computational Geometry 18 (1997) 305-363: error bounds in Section 4, expansions in Section 2.
"""

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

EXACT_RANGE = (2.0**-200, 2.0**200)
"""Magnitudes (smallest, largest) of nonzero coordinates for which the predicates are exact."""

_EPSILON = 2.0**-53
_SPLITTER = 2.0**27 + 1.0
_ORIENT_BOUND = (3.0 + 16.0 * _EPSILON) * _EPSILON
_INCIRCLE_BOUND = (10.0 + 96.0 * _EPSILON) * _EPSILON


@njit(cache=True)
def _two_sum(a, b):
    """a + b as (hi, lo) without error."""
    # exact in whatever order of magnitude a and b are, but under IEEE rounding only: never compile this with fastmath
    hi = a + b
    virtual = hi - a  # the part of b that arrived in hi
    return hi, (a - (hi - virtual)) + (b - virtual)


@njit(cache=True)
def _split(a):
    """The number a as two halves of at most 26 bits each."""
    c = _SPLITTER * a  # overflows beyond 2**996 only, far above any term
    hi = c - (c - a)
    return hi, a - hi


@njit(cache=True)
def _two_product(a, b):
    """The product a * b as (hi, lo) without error."""
    hi = a * b
    a1, a0 = _split(a)
    b1, b0 = _split(b)
    # products of halves have 52 bits at most, so none is rounded, and in this order no difference is
    return hi, a0 * b0 - (((hi - a1 * b1) - a0 * b1) - a1 * b0)


@njit(cache=True)
def _difference(a, b):
    """The expansion of a - b."""
    hi, lo = _two_sum(a, -b)
    if lo == 0.0:  # a zero term would lengthen every product
        return np.array([hi])
    return np.array([lo, hi])


@njit(cache=True)
def _add(e, f):
    """The expansion of e + f: merge by magnitude, then carry upwards."""
    # terms must be strongly nonoverlapping; rounding to even keeps them so, here and in _scale (Shewchuk, Section 2)
    g = np.empty(e.size + f.size)
    i = j = 0
    for m in range(g.size):
        if j == f.size or (i < e.size and abs(e[i]) < abs(f[j])):
            g[m] = e[i]
            i += 1
        else:
            g[m] = f[j]
            j += 1
    size = 0  # g is written over from below: size stays behind m
    carry = g[0]
    for m in range(1, g.size):
        carry, lo = _two_sum(carry, g[m])
        if lo != 0.0:
            g[size] = lo
            size += 1
    if carry != 0.0 or size == 0:  # zero keeps one term, so that a last one always has the sign
        g[size] = carry
        size += 1
    return g[:size]


@njit(cache=True)
def _scale(e, b):
    """The expansion of e * b."""
    # long enough: the first sum, with 0, leaves no error, and the last carry takes that place
    h = np.empty(2 * e.size)
    size = 0
    carry = 0.0
    for x in e:
        hi, lo = _two_product(x, b)
        carry, low = _two_sum(carry, lo)
        if low != 0.0:
            h[size] = low
            size += 1
        carry, low = _two_sum(hi, carry)
        if low != 0.0:
            h[size] = low
            size += 1
    if carry != 0.0 or size == 0:
        h[size] = carry
        size += 1
    return h[:size]


@njit(cache=True)
def _times(e, f):
    """The expansion of e * f."""
    h = _scale(e, f[0])
    for m in range(1, f.size):
        h = _add(h, _scale(e, f[m]))
    return h


@njit(cache=True)
def _determinant(e1, e2, f1, f2):
    """The expansion of e1 * f2 - e2 * f1."""
    return _add(_times(e1, f2), -_times(e2, f1))  # a change of sign is exact, term by term


@njit(cache=True)
def _sign(x):
    return int(x > 0.0) - int(x < 0.0)


@njit(cache=True)
def _orient2d_exact(ax, ay, bx, by, cx, cy):
    det = _determinant(_difference(ax, cx), _difference(ay, cy), _difference(bx, cx), _difference(by, cy))
    return _sign(det[-1])  # the last term outweighs all others together


@njit(cache=True)
def orient2d_sign(ax, ay, bx, by, cx, cy):
    """`orient2d` of three points given by coordinates, for compiled kernels."""
    left = (ax - cx) * (by - cy)
    right = (ay - cy) * (bx - cx)
    det = left - right
    # beyond this bound rounding cannot have turned the sign; strict, so that 0 is never taken on trust
    if abs(det) > _ORIENT_BOUND * (abs(left) + abs(right)):
        return _sign(det)
    return _orient2d_exact(ax, ay, bx, by, cx, cy)


@njit(cache=True)
def _incircle_exact(ax, ay, bx, by, cx, cy, dx, dy):
    a1, a2 = _difference(ax, dx), _difference(ay, dy)
    b1, b2 = _difference(bx, dx), _difference(by, dy)
    c1, c2 = _difference(cx, dx), _difference(cy, dy)
    det = _times(_add(_times(a1, a1), _times(a2, a2)), _determinant(b1, b2, c1, c2))
    det = _add(det, _times(_add(_times(b1, b1), _times(b2, b2)), _determinant(c1, c2, a1, a2)))
    det = _add(det, _times(_add(_times(c1, c1), _times(c2, c2)), _determinant(a1, a2, b1, b2)))
    return _sign(det[-1])


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
        return _sign(det)
    return _incircle_exact(ax, ay, bx, by, cx, cy, dx, dy)


@njit(cache=True)
def turn(points, i, j, k):
    """`orient2d` of rows i, j, k of an (n,2) array, for compiled kernels."""
    return orient2d_sign(points[i, 0], points[i, 1], points[j, 0], points[j, 1], points[k, 0], points[k, 1])


@njit(cache=True)
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

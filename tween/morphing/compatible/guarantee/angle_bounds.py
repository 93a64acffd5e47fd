r"""How large and how small the angles of a moving triangle can get between two times: proved bounds, not samples.

Between two times the third vertex z stays in a box, known from its places at both times and its path.
Over the base from 0 to 1, the angle at 0 grows with the height of z where z is right of 0 and falls with it
where z is left of 0, and falls with x; the angle at 1 likewise, mirrored; the angle at z falls with the distance of x
from 1/2, and is largest at the height sqrt(x (x-1)) where x is beyond 0 and 1, and as low as can be
where it is between.  So each angle is largest, and smallest, at a place of the box that can be named.

    linear   the box of two points of a segment
    slide    the same where the path is straight; with an arc, a path of length l between points at distance d
             leaves their box by sqrt(l^2 - d^2) / 2 at most (it stays in an ellipse about them), and is never
             lower than the lower one of its ends: an arc in the upper half plane lies above its chord

Boxes are widened by more than the rounding of z, so that they hold the doubles, too.

Two paths need no box.  Along "angle" each angle is linear in time.  Along "metric" the cotangent of an angle is
g / sqrt(D), where g, the inner product of the two edges at the corner, is linear in time and D, the squared double
area, quadratic.  In Bernstein form, with s = 1 - t,

    g = s g0 + t g1        D = s^2 p + s t M + t^2 q        p, M, q > 0

the derivative of the cotangent vanishes where 2 g' D = g D', and that is s E0 + t E1 = 0 with

    E0 = g1 p - g0 M / 2   E1 = g1 M / 2 - g0 q

since the coefficient of s t is E0 + E1 and s + t = 1 divides.  So there is one such time at most, at weights
s : t = abs(E1) : abs(E0).  D is a sum of positive terms there, so nothing cancels in it however much a base
shrinks.  In g two terms cancel only where x changes sign; then M >= (abs(x0) + abs(x1))^2 makes the square root of D
twice as large as either term, and the angle is right to some roundings.

Legend: ``z`` third vertices; ``x y`` their coordinates; ``low high`` ends of intervals.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.choices import Path
from tween.morphing.compatible.paths import (
    base_angles,
    corner_angles,
    path_lengths,
    slides,
    third_angle,
    third_vertices,
)

_ROUNDING = 2.0**-47  # relative, added to the boxes: more than the rounding of z
_ROUNDING_OF_LENGTHS = 1e-7  # relative: the square root of what rounding makes of a difference of squares

Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]


def angle_bounds(
    path: Path,
    source: NDArray[np.complex128],
    target: NDArray[np.complex128],
    propagates: NDArray[np.bool_],
    stretch: NDArray[np.float64],
    times: NDArray[np.float64],
) -> Bounds:
    """Bound the angles of every triangle from below and above between neighbouring times.

    Parameters
    ----------
    path : {"linear", "slide", "angle", "metric"}
        "area" depends on the parents of a triangle, see `area_bounds`.
    source, target, propagates, stretch
        As for `third_vertices`, m of each.
    times : ndarray of float64, shape (k,)
        Increasing.

    Returns
    -------
    low, high : ndarray of float64, shape (m, 3, k-1)
        Radians, for the angles at 0, at 1 and at the third vertex.

    Notes
    -----
    The bounds exceed the angles by O(1 / k).  O(m k).

    Examples
    --------
    >>> z1, z2, times = np.array([1j]), np.array([1 + 1j]), np.linspace(0, 1, 65)
    >>> low, high = angle_bounds("linear", z1, z2, np.zeros((1, 2), bool), np.ones(1), times)
    >>> bool(0 < high[0, 0, 0] - np.pi / 2 < 0.01)  # a right angle at 0 to begin with
    True
    """
    if path == "angle":
        first, last = base_angles(source)[..., None], base_angles(target)[..., None]
        return _between_ends((1 - times) * first + times * last)
    z = third_vertices(path, source, target, propagates, stretch, times)
    if path == "metric":
        low, high = _between_ends(corner_angles(z))
        _add_peaks(low, high, source, target, stretch, times)
        return low, high
    bends = np.asarray(slides(source, target, propagates & (path == "slide")).any(axis=1))
    lengths = path_lengths(source, target, propagates & bends[:, None])
    low, high = np.empty((len(source), 3, len(times) - 1)), np.empty((len(source), 3, len(times) - 1))
    _from_boxes(z, bends, lengths, np.minimum(source.imag, target.imag), times, low, high)
    return low, high


def _between_ends(angles: NDArray[np.float64]) -> Bounds:
    """The smaller and the larger of the angles, (m, 3, k), at neighbouring times."""
    before, after = angles[..., :-1], angles[..., 1:]
    return np.minimum(before, after), np.maximum(before, after)


@njit(cache=True)
def _from_boxes(z, bends, lengths, floors, times, low, high):
    """Bounds of angles from the boxes of third vertices z, (m, k); floors and lengths are those of whole paths."""
    for i in range(z.shape[0]):
        for f in range(z.shape[1] - 1):
            p, q = z[i, f], z[i, f + 1]
            wide = _ROUNDING * max(abs(p), abs(q))
            low_y, high_y = min(p.imag, q.imag) * (1.0 - _ROUNDING), max(p.imag, q.imag) * (1.0 + _ROUNDING)
            if bends[i]:
                length = lengths[i] * (times[f + 1] - times[f])
                floor = floors[i] - wide
                wide += 0.5 * math.sqrt(max(length * length - abs(q - p) ** 2, 0.0)) + _ROUNDING_OF_LENGTHS * length
                low_y, high_y = max(low_y - wide, floor, 0.0), high_y + wide
            box_angles(min(p.real, q.real) - wide, max(p.real, q.real) + wide, low_y, high_y, low, high, i, f)


@njit(cache=True, inline="always")
def box_angles(low_x, high_x, low_y, high_y, low, high, i, f):
    """Write the bounds of the three angles of a third vertex in a box."""
    high[i, 0, f] = math.atan2(high_y if low_x > 0.0 else low_y, low_x)
    low[i, 0, f] = math.atan2(low_y if high_x > 0.0 else high_y, high_x)
    high[i, 1, f] = math.atan2(high_y if high_x < 1.0 else low_y, 1.0 - high_x)
    low[i, 1, f] = math.atan2(low_y if low_x < 1.0 else high_y, 1.0 - low_x)
    x = min(max(0.5, low_x), high_x)
    y = min(max(math.sqrt(max(x * (x - 1.0), 0.0)), low_y), high_y)
    high[i, 2, f] = third_angle(x, y)
    far = low_x if abs(low_x - 0.5) > abs(high_x - 0.5) else high_x
    low[i, 2, f] = min(third_angle(far, low_y), third_angle(far, high_y))


@njit(cache=True)
def _add_peaks(low, high, source, target, stretch, times):
    """Put each angle of the path "metric" at its stationary time, where it has one, into the interval of that."""
    for i in range(source.size):
        x0, y0, x1, y1, square = source[i].real, source[i].imag, target[i].real, target[i].imag, stretch[i] ** 2
        p, q = y0 * y0 / square, square * y1 * y1  # D divided by the square of the stretch
        mixed = (x0 - x1) ** 2 + y0 * y0 + y1 * y1
        for corner in range(3):
            if corner == 0:
                g0, g1 = x0, square * x1
            elif corner == 1:
                g0, g1 = 1.0 - x0, square * (1.0 - x1)
            else:
                g0, g1 = x0 * (x0 - 1.0) + y0 * y0, square * (x1 * (x1 - 1.0) + y1 * y1)
            e0, e1 = g1 * p - 0.5 * g0 * mixed, 0.5 * g1 * mixed - g0 * q
            if not (e0 < 0.0 < e1 or e1 < 0.0 < e0):
                continue
            largest = max(abs(e0), abs(e1))
            s, t = abs(e1) / largest, abs(e0) / largest
            double_area = math.sqrt(s * s * p + s * t * mixed + t * t * q) * stretch[i]
            there = math.atan2(double_area, s * g0 + t * g1)
            f = min(max(np.searchsorted(times, t / (s + t), side="right") - 1, 0), times.size - 2)
            low[i, corner, f] = min(low[i, corner, f], there)
            high[i, corner, f] = max(high[i, corner, f], there)


@njit(cache=True)
def within_budgets(low, high, rows, first, last, least, most, times):
    """Narrow bounds of wanted angles, (m, 3, k-1), in place to those of angles kept to budgets, in some rows.

    The limits of the angles at times 0 and 1 are ``least`` and ``most``.  Kept to its budgets, a triangle has a share
    of what is wanted beyond the path "angle": the least share that a corner allows.  Its range follows from those of
    what is allowed and of what is wanted.
    """
    for i in rows:
        for f in range(times.size - 1):
            t0, t1 = times[f], times[f + 1]
            little, much = 1.0, 1.0
            for s in range(3):
                if least[i, s] < math.inf:
                    p0, p1 = (1 - t0) * first[i, s] + t0 * last[i, s], (1 - t1) * first[i, s] + t1 * last[i, s]
                    g0 = max((1 - t0) * least[i, s] + t0 * most[i, s] - p0, 0.0)
                    g1 = max((1 - t1) * least[i, s] + t1 * most[i, s] - p1, 0.0)
                    excess, surely = high[i, s, f] - min(p0, p1), low[i, s, f] - max(p0, p1)
                    if excess > min(g0, g1):
                        little = min(little, min(g0, g1) / excess)
                    if surely > max(g0, g1):
                        much = min(much, max(g0, g1) / surely)
            for s in range(3):
                p0, p1 = (1 - t0) * first[i, s] + t0 * last[i, s], (1 - t1) * first[i, s] + t1 * last[i, s]
                p, q = min(p0, p1), max(p0, p1)
                under, over = low[i, s, f] - p, high[i, s, f] - q
                low[i, s, f], high[i, s, f] = p + min(little * under, much * under), q + max(little * over, much * over)
                if least[i, s] < math.inf:
                    limit = max((1 - t0) * least[i, s] + t0 * most[i, s], (1 - t1) * least[i, s] + t1 * most[i, s])
                    high[i, s, f] = min(high[i, s, f], limit)
                low[i, s, f] = min(low[i, s, f], high[i, s, f])

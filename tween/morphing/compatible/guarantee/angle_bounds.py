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
from tween.morphing.compatible.guarantee.quick_trigonometry import arc_tangent
from tween.morphing.compatible.paths import base_angles, metric_third, path_lengths, slides, third_vertices

_ROUNDING = 2.0**-47  # relative, added to the boxes: more than the rounding of z
_ROUNDING_OF_LENGTHS = 1e-7  # relative: the square root of what rounding makes of a difference of squares
_CELLS = 2**11  # numbers that are looked at together

Bounds = tuple[NDArray[np.float64], NDArray[np.float64]]


def angle_bounds(
    path: Path,
    source: NDArray[np.complex128],
    target: NDArray[np.complex128],
    propagates: NDArray[np.bool_],
    stretch: NDArray[np.float64],
    times: NDArray[np.float64],
    both: bool = True,
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
    both : bool
        Whether bounds from below are wanted, too.

    Returns
    -------
    low, high : ndarray of float64, shape (m, 3, k-1)
        Radians, for the angles at 0, at 1 and at the third vertex; low may be left out, and is then empty.

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
    high = np.empty((len(source), 3, len(times) - 1))
    low = np.empty_like(high) if both else high[:0]
    if path == "metric":
        _from_ends(source, target, stretch, times, low, high)
        _add_peaks(low, high, source, target, stretch, times)
        return low, high
    z = third_vertices(path, source, target, propagates, stretch, times)
    bends = np.asarray(slides(source, target, propagates & (path == "slide")).any(axis=1))
    lengths = path_lengths(source, target, propagates & bends[:, None])
    _from_boxes(z, bends, lengths, np.minimum(source.imag, target.imag), times, low, high)
    return low, high


def _between_ends(angles: NDArray[np.float64]) -> Bounds:
    """The smaller and the larger of the angles, (m, 3, k), at neighbouring times."""
    before, after = angles[..., :-1], angles[..., 1:]
    return np.minimum(before, after), np.maximum(before, after)


@njit(cache=True, error_model="numpy")
def _from_ends(source, target, stretch, times, low, high):
    """The smaller and the larger of the angles along the path "metric" at neighbouring times; nan stays nan."""
    m, k = len(source), len(times)
    rows = _rows(k)
    x, y, angles = np.empty(rows * k), np.empty(rows * k), np.empty((3, rows * k))
    of_a, of_b, of_c = angles[0], angles[1], angles[2]
    for first in range(0, m, rows):
        last = min(first + rows, m)
        for i in range(first, last):
            row, square = (i - first) * k, stretch[i] * stretch[i]
            for f in range(k):
                x[row + f], y[row + f] = metric_third(source[i], target[i], square, times[f])
        for j in range((last - first) * k):  # loops without branches, for several at a time
            of_a[j], of_b[j] = arc_tangent(y[j], x[j]), arc_tangent(y[j], 1.0 - x[j])
        for j in range((last - first) * k):
            of_c[j] = arc_tangent(y[j], x[j] * (x[j] - 1.0) + y[j] * y[j])
        for i in range(first, last):
            for s in range(3):
                before, after = angles[s, (i - first) * k :], angles[s, (i - first) * k + 1 :]
                for f in range(k - 1):
                    high[i, s, f] = (
                        after[f] if before[f] < after[f] else (before[f] if after[f] <= before[f] else math.nan)
                    )
                for f in range(k - 1 if len(low) else 0):
                    low[i, s, f] = (
                        before[f] if before[f] < after[f] else (after[f] if after[f] <= before[f] else math.nan)
                    )


@njit(cache=True)
def _rows(k):
    """How many rows of k numbers are looked at together: enough for loops over them all, few enough for the cache."""
    return max(1, _CELLS // k)


@njit(cache=True, error_model="numpy")
def _from_boxes(z, bends, lengths, floors, times, low, high):
    """Bounds of angles from the boxes of third vertices z, (m, k); floors and lengths are those of whole paths."""
    m, intervals = len(z), z.shape[1] - 1
    rows = _rows(intervals)
    boxes, angles = np.empty((4, min(m, rows), intervals)), np.empty((3, min(m, rows), intervals))
    for first in range(0, m, rows):
        last = min(first + rows, m)
        for i in range(first, last):
            for f in range(intervals):
                p, q = z[i, f], z[i, f + 1]
                wide = _ROUNDING * max(abs(p.real) + p.imag, abs(q.real) + q.imag)
                low_y, high_y = min(p.imag, q.imag) * (1.0 - _ROUNDING), max(p.imag, q.imag) * (1.0 + _ROUNDING)
                if bends[i]:
                    length, step = lengths[i] * (times[f + 1] - times[f]), q - p
                    floor = floors[i] - wide
                    square = step.real * step.real + step.imag * step.imag
                    wide += 0.5 * math.sqrt(max(length * length - square, 0.0)) + _ROUNDING_OF_LENGTHS * length
                    low_y, high_y = max(low_y - wide, floor, 0.0), high_y + wide
                boxes[0, i - first, f], boxes[1, i - first, f] = min(p.real, q.real) - wide, max(p.real, q.real) + wide
                boxes[2, i - first, f], boxes[3, i - first, f] = low_y, high_y
        _largest_in_boxes(boxes.reshape((4, -1)), angles.reshape((3, -1)))
        for i in range(first, last):
            high[i] = angles[:, i - first]
        if len(low):
            _least_in_boxes(boxes.reshape((4, -1)), angles.reshape((3, -1)))
            for i in range(first, last):
                low[i] = angles[:, i - first]


@njit(cache=True, error_model="numpy")
def _largest_in_boxes(boxes, angles):
    """Bounds from above of the three angles, (3, j), of third vertices in boxes, (4, j); a loop for each is quicker."""
    low_x, high_x, low_y, high_y = boxes[0], boxes[1], boxes[2], boxes[3]
    of_a, of_b, of_c = angles[0], angles[1], angles[2]
    for j in range(low_x.size):
        of_a[j] = arc_tangent(high_y[j] if low_x[j] > 0.0 else low_y[j], low_x[j])
    for j in range(low_x.size):
        of_b[j] = arc_tangent(high_y[j] if high_x[j] < 1.0 else low_y[j], 1.0 - high_x[j])
    for j in range(low_x.size):
        x = min(max(0.5, low_x[j]), high_x[j])
        y = min(max(math.sqrt(max(x * (x - 1.0), 0.0)), low_y[j]), high_y[j])
        of_c[j] = arc_tangent(y, x * (x - 1.0) + y * y)


@njit(cache=True, error_model="numpy")
def _least_in_boxes(boxes, angles):
    """Bounds from below of the three angles, (3, j), of third vertices in boxes, (4, j)."""
    low_x, high_x, low_y, high_y = boxes[0], boxes[1], boxes[2], boxes[3]
    of_a, of_b, of_c = angles[0], angles[1], angles[2]
    for j in range(low_x.size):
        of_a[j] = arc_tangent(low_y[j] if high_x[j] > 0.0 else high_y[j], high_x[j])
    for j in range(low_x.size):
        of_b[j] = arc_tangent(low_y[j] if low_x[j] < 1.0 else high_y[j], 1.0 - low_x[j])
    for j in range(low_x.size):
        x = low_x[j] if abs(low_x[j] - 0.5) > abs(high_x[j] - 0.5) else high_x[j]
        # the smaller angle is that of the vector to the right: one arc tangent does
        low_d, high_d = x * (x - 1.0) + low_y[j] * low_y[j], x * (x - 1.0) + high_y[j] * high_y[j]
        lower = low_d * high_y[j] > high_d * low_y[j]
        of_c[j] = arc_tangent(low_y[j] if lower else high_y[j], low_d if lower else high_d)


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
            when = t / (s + t)
            if when < times[0] - _ROUNDING or when > times[-1] + _ROUNDING:
                continue
            double_area = math.sqrt(s * s * p + s * t * mixed + t * t * q) * stretch[i]
            there = math.atan2(double_area, s * g0 + t * g1)
            f = min(max(np.searchsorted(times, when, side="right") - 1, 0), times.size - 2)
            if len(low):
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

r"""How large the angles of a moving triangle can get between two times: proved bounds, not samples.

Between two times the third vertex z stays in a box, known from its places at both times and its path.
Over the base from 0 to 1, the angle at 0 grows with the height of z where z is right of 0 and falls with it
where z is left of 0, and falls with x; the angle at 1 likewise, mirrored; the angle at z falls with the distance of x
from 1/2, and is largest at the height sqrt(x (x-1)) where x is beyond 0 and 1, and as low as can be
where it is between.  So each angle is largest at a place of the box that can be named.

    linear   the box of two points of a segment
    slide    the same where the path is straight; with an arc, a path of length l between points at distance d
             leaves their box by sqrt(l^2 - d^2) / 2 at most (it stays in an ellipse about them)

Two paths need no box.  Along "angle" each angle is linear in time.  Along "metric" the cotangent of an angle is
g / sqrt(D), where g, the inner product of the two edges at the corner, is linear in time and D, the squared double
area, quadratic: its derivative vanishes at one time at most, that of g' D = g D' / 2, in which the squares cancel.
So an angle is largest at an end of the interval, or at that time.

Legend: ``z`` third vertices; ``x y`` their coordinates; ``low high`` ends of intervals.
"""

import numpy as np
from numpy.typing import NDArray

from tween.choices import Path
from tween.morphing.compatible.paths import base_angles, corner_angles, path_lengths, third_vertices

_ROUNDING = 1e-12  # relative, added to the boxes
_ROUNDING_OF_LENGTHS = 1e-7  # relative: the square root of what rounding makes of a difference of squares


def largest_angles(
    path: Path,
    source: NDArray[np.complex128],
    target: NDArray[np.complex128],
    propagates: NDArray[np.bool_],
    stretch: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Bound the angles of every triangle from above between neighbouring times.

    Parameters
    ----------
    path : {"linear", "slide", "angle", "metric"}
        "area" depends on the parents of a triangle and has no bound of its own.
    source, target, propagates, stretch
        As for `third_vertices`, m of each.
    times : ndarray of float64, shape (k,)
        Increasing.

    Returns
    -------
    ndarray of float64, shape (m, 3, k-1)
        Radians, for the angles at 0, at 1 and at the third vertex.

    Notes
    -----
    The bounds exceed the angles by O(1 / k).  O(m k).

    Examples
    --------
    >>> z1, z2, times = np.array([1j]), np.array([1 + 1j]), np.linspace(0, 1, 65)
    >>> bounds = largest_angles("linear", z1, z2, np.zeros((1, 2), bool), np.ones(1), times)
    >>> bool(0 < bounds[0, 0, 0] - np.pi / 2 < 0.01)  # a right angle at 0 to begin with
    True
    """
    if path == "angle":
        first, last = base_angles(source)[..., None], base_angles(target)[..., None]
        return _larger(first + times * (last - first))
    z = third_vertices(path, source, target, propagates, stretch, times)
    if path == "metric":
        return _with_peaks(_larger(corner_angles(z)), source, target, stretch, times)
    beyond = _bulge(z, path_lengths(source, target, propagates), times) if path == "slide" else 0.0
    low_x, high_x = _ends(z.real, beyond)
    low_y, high_y = _ends(z.imag, beyond)
    low_y = np.maximum(low_y, 0.0)
    nearest = np.clip(0.5, low_x, high_x)
    at_0 = np.arctan2(np.where(low_x > 0, high_y, low_y), low_x)
    at_1 = np.arctan2(np.where(high_x < 1, high_y, low_y), 1.0 - high_x)
    height = np.clip(np.sqrt(np.maximum(nearest * (nearest - 1.0), 0.0)), low_y, high_y)
    at_third = np.arctan2(nearest, height) + np.arctan2(1.0 - nearest, height)
    return np.stack([at_0, at_1, at_third], axis=1)


def _larger(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """The larger of the angles, (m, 3, k), at neighbouring times."""
    return np.maximum(angles[..., :-1], angles[..., 1:])


def _ends(
    values: NDArray[np.float64], beyond: NDArray[np.float64] | float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The least and the largest value between neighbouring times, which may leave the range of both by some way."""
    before, after = values[:, :-1], values[:, 1:]
    low, high = np.minimum(before, after), np.maximum(before, after)
    margin = beyond + _ROUNDING * (1.0 + np.maximum(np.abs(low), np.abs(high)))
    return low - margin, high + margin


def _bulge(z: NDArray[np.complex128], lengths: NDArray[np.float64], times: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far a path of known length may leave the box of its ends, between neighbouring times."""
    length = lengths[:, None] * np.diff(times)
    bulge = 0.5 * np.sqrt(np.maximum(length**2 - np.abs(np.diff(z, axis=1)) ** 2, 0.0))
    return bulge + _ROUNDING_OF_LENGTHS * length


def _with_peaks(
    angles: NDArray[np.float64],
    source: NDArray[np.complex128],
    target: NDArray[np.complex128],
    stretch: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Put each angle of the path "metric" at its stationary time, where it has one, into the interval of that."""
    square = stretch**2
    x, y = (np.stack([source.real, target.real]), np.stack([source.imag, target.imag]))
    first = np.stack([x[0], 1.0 - x[0], x[0] ** 2 - x[0] + y[0] ** 2], axis=1)
    last = np.stack([x[1], 1.0 - x[1], x[1] ** 2 - x[1] + y[1] ** 2], axis=1) * square[:, None]
    p, q = y[0] ** 2, square**2 * y[1] ** 2
    mixed = square * ((x[0] - x[1]) ** 2 + y[0] ** 2 + y[1] ** 2)
    d0, d1, d2 = (part[:, None] for part in (p, mixed - 2 * p, p + q - mixed))
    growth = last - first
    below = first * d2 - 0.5 * growth * d1
    peak = np.divide(growth * d0 - 0.5 * first * d1, below, out=np.full_like(below, -1.0), where=below != 0)
    row, corner = np.nonzero((times[0] < peak) & (peak < times[-1]))
    t = peak[row, corner]
    double_area = np.sqrt(d0[row, 0] + t * (d1[row, 0] + t * d2[row, 0]))
    there = np.arctan2(double_area, first[row, corner] + t * growth[row, corner])
    interval = np.searchsorted(times, t, side="right") - 1
    np.maximum.at(angles, (row, corner, interval), there)
    return angles

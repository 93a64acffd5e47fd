r"""Paths of the third vertex, in the frame where the base of its triangle is the segment from 0 to 1.

A triangle with base AB and third vertex C is the complex number z = (C - A) / (B - A), Im z > 0.  A path
leads from the z of the source to that of the target:

    linear   the segment between them
    slide    the same, but where the distance to an end of the base, 0 or 1, would first fall and then
             rise along it and the edge to that end is a propagation edge, the part of the segment inside
             the circle of radius min(l1, l2) about that end is replaced by the arc (Figure 7):

                    , - ~ - ,  z2'
               z1 .'         `.  . . . . z2        from z1 along the arc about 0 to the chord's exit,
                  |     0     |                    then along the segment
    angle    the three angles of the triangle change linearly
    metric   the squares of the three edge lengths change linearly
    area     the area of the triangle changes linearly, and so does the difference of the two angles
             at the base; where it ends up depends on the length of the base at every moment

Legend: ``p q`` ends of a piece of a path; ``end`` an end of the base, 0 or 1; ``l1 l2`` distances of z1
and z2 to it; ``s`` position along the segment, 0 to 1; ``t`` time.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.choices import PATHS, Path

_LINE = -1.0  # the `end` of a straight piece; arcs have the end of the base about which they turn
_MOST_PIECES = 5


def third_vertices(
    path: Path,
    source: NDArray[np.complex128],
    target: NDArray[np.complex128],
    propagates: NDArray[np.bool_],
    stretch: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.complex128]:
    """Move the third vertex of every triangle along its path.

    Parameters
    ----------
    path : {"linear", "slide", "angle", "metric"}
        "area" depends on the parents, see `.area_thirds`.
    source, target : ndarray of complex, shape (m,)
        Third vertices over the base from 0 to 1, in the upper half plane.
    propagates : ndarray of bool, shape (m, 2)
        Whether the edge to 0, and that to 1, is the base of a child.
    stretch : ndarray of float, shape (m,)
        Length of the base in the target over that in the source.
    times : ndarray of float, shape (k,)
        From 0 (source) to 1 (target).

    Returns
    -------
    ndarray of complex, shape (m, k)

    Raises
    ------
    ValueError
        For an unknown path.

    Notes
    -----
    "linear" and "slide" are the paper's, the others ours.  Along "angle" the sum of the angles at a vertex
    stays between those of source and target; "metric" is that of Chen, Weber, Keren and Ben-Chen
    (2013), which needs no correction here since triangles that form a tree fit together whatever their
    shapes.

    The paper fixes the shape of the slide path; these are our choices.  Every path is traversed at
    constant speed.  Lengths are compared relative to the base, since the base is what D aligns.  The
    paper says that of two propagation edges at most one is non-monotone.  That is not so: both are for
    z1 = -1+i, z2 = 2+i.  The path then runs along the outside of the two disks together, first one arc
    and then the other, which keeps both edges monotone.  O(m k).

    Examples
    --------
    >>> z = third_vertices("slide", np.array([-1 + 1j]), np.array([1 + 1j]), np.array([[True, False]]),
    ...                    np.ones(1), np.array([0.0, 0.5, 1.0]))
    >>> np.abs(z).round(12)  # the distance to 0 stays, where a straight line would come as close as 1
    array([[1.41421356, 1.41421356, 1.41421356]])

    References
    ----------
    Mukherjee and Gopi, Section 5 and Figure 7.
    """
    if path == "linear":
        return (1 - times) * source[:, None] + times * target[:, None]
    if path == "slide":
        return _slide(source, target, propagates, times)
    if path == "angle":
        return np.asarray(_apexes(base_angles(source), base_angles(target), times))
    if path == "metric":
        return np.asarray(_by_metric(source, target, stretch, times))
    raise ValueError(f"path is {path!r}, expected one of {', '.join(PATHS)}")


def base_angles(z: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Angles of triangles at 0, at 1 and at their third vertex.

    Parameters
    ----------
    z : ndarray of complex, shape (m,)
        Third vertices, in the upper half plane.

    Returns
    -------
    ndarray of float64, shape (m, 3)
        Radians.
    """
    return np.asarray(corner_angles(z[:, None]))[..., 0]


@njit(cache=True)
def corner_angles(z):
    """Angles, (m, 3, k), at 0, at 1 and at the third vertices z, (m, k), in the upper half plane."""
    angles = np.empty((z.shape[0], 3, z.shape[1]))
    for i in range(z.shape[0]):
        for f in range(z.shape[1]):
            x, y = z[i, f].real, z[i, f].imag
            angles[i, 0, f], angles[i, 1, f] = math.atan2(y, x), math.atan2(y, 1.0 - x)
            angles[i, 2, f] = third_angle(x, y)
    return angles


@njit(cache=True, inline="always")
def third_angle(x, y):
    """The angle at the third vertex x + iy over the base from 0 to 1, precise however small it is."""
    return math.atan2(y, x * (x - 1.0) + y * y)


@njit(cache=True)
def apex(a, b, c):
    """The third vertex from the angles at 0, at 1 and at itself.

    They add up to pi but for rounding; the sine of an angle near pi is taken from the other two, which are precise.
    """
    radius = math.sin(b if b < 1.5 else a + c) / math.sin(c if c < 1.5 else a + b)
    return complex(radius * math.cos(a), radius * math.sin(a if a < 1.5 else b + c))


@njit(cache=True)
def _apexes(first, last, times):
    """Third vertices, (m, k), of triangles whose angles, (m, 3), change linearly."""
    z = np.empty((len(first), times.size), np.complex128)
    for i in range(len(first)):
        for f in range(times.size):
            s, t = 1.0 - times[f], times[f]
            z[i, f] = apex(
                s * first[i, 0] + t * last[i, 0], s * first[i, 1] + t * last[i, 1], s * first[i, 2] + t * last[i, 2]
            )
    return z


@njit(cache=True)
def _by_metric(source, target, stretch, times):
    """Average the Gram matrices of base and edge to 0.

    With weights p, q of sum 1, in proportion to the squared bases, the real part of z is the mean of the two, and
    the square of the imaginary part the mean of the squares plus p q times the squared difference of the
    real parts: positive, and free of cancellation.
    """
    z = np.empty((source.size, times.size), np.complex128)
    for i in range(source.size):
        square = stretch[i] * stretch[i]
        for f in range(times.size):
            z[i, f] = complex(*metric_third(source[i], target[i], square, times[f]))
    return z


@njit(cache=True, inline="always")
def metric_third(source, target, square, t):
    """Coordinates of a third vertex along the path "metric", see `_by_metric`."""
    x1, x2, s, weight = source.real, target.real, 1.0 - t, t * square
    p, q = s / (s + weight), weight / (s + weight)
    return p * x1 + q * x2, math.sqrt(p * source.imag**2 + q * target.imag**2 + p * q * (x1 - x2) ** 2)


def slides(
    source: NDArray[np.complex128], target: NDArray[np.complex128], propagates: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """Tell where a straight path would shorten a propagation edge and lengthen it again.

    Parameters
    ----------
    source, target : ndarray of complex, shape (m,)
        As for `third_vertices`.
    propagates : ndarray of bool, shape (m, 2)

    Returns
    -------
    ndarray of bool, shape (m, 2)
        For the edge to 0 and that to 1: whether "slide" replaces part of the segment by an arc.
    """
    step = target - source
    length = np.abs(step) ** 2
    foot = np.stack([((end - source) * step.conj()).real for end in (0.0, 1.0)], axis=1)
    return propagates & (foot > 0) & (foot < length[:, None])


@njit(cache=True)
def path_lengths(source, target, propagates):
    """Lengths, (m,), of the paths of "slide" over the base from 0 to 1; along each the speed is constant."""
    lengths = np.empty(source.size)
    # one path at a time, so this scratch serves all
    p, q, ends = np.empty(_MOST_PIECES, np.complex128), np.empty(_MOST_PIECES, np.complex128), np.empty(_MOST_PIECES)
    for m in range(source.size):
        pieces = _outline(source[m], target[m], propagates[m, 0], propagates[m, 1], p, q, ends)
        lengths[m] = 0.0
        for i in range(pieces):
            lengths[m] += _piece_length(p[i], q[i], ends[i])
    return lengths


@njit(cache=True)
def _inside_circle(z1, z2, end):
    """The part (s0, s1) of the segment within min(l1, l2) of an end; s0 >= s1 where that is monotone."""
    step = z2 - z1
    foot = ((end - z1) * step.conjugate()).real
    length = step.real * step.real + step.imag * step.imag
    if foot <= 0.0 or foot >= length:  # the nearest point of the line is not between z1 and z2
        return 1.0, 0.0
    foot /= length  # the middle of the chord, of which the nearer one of z1 and z2 is an end
    if abs(z1 - end) <= abs(z2 - end):
        return 0.0, min(1.0, 2.0 * foot)
    return max(0.0, 2.0 * foot - 1.0), 1.0


@njit(cache=True)
def _outline(z1, z2, to_zero, to_one, p, q, ends):
    """Write the pieces of the slide path from z1 to z2 and count them."""
    step = z2 - z1
    a0, a1 = _inside_circle(z1, z2, 0.0) if to_zero else (1.0, 0.0)
    b0, b1 = _inside_circle(z1, z2, 1.0) if to_one else (1.0, 0.0)
    if a1 > a0 and b1 > b0:  # of nested chords only the outer one is on the outside
        if a0 <= b0 and b1 <= a1:
            b0, b1 = 1.0, 0.0
        elif b0 <= a0 and a1 <= b1:
            a0, a1 = 1.0, 0.0
    # s and end: the first arc; r and other: the second one, s0 >= s1 or r0 >= r1 where there is none
    zero_first = b1 <= b0 or (a1 > a0 and a0 < b0)
    s0, s1, end = (a0, a1, 0.0) if zero_first else (b0, b1, 1.0)
    r0, r1, other = (b0, b1, 1.0) if zero_first else (a0, a1, 0.0)
    if s1 <= s0:
        p[0], q[0], ends[0] = z1, z2, _LINE
        return 1
    p[0], q[0], ends[0] = z1, z1 + s0 * step, _LINE
    p[1], q[1], ends[1] = q[0], z1 + s1 * step, end
    if r1 <= r0:
        p[2], q[2], ends[2] = q[1], z2, _LINE
        return 3
    p[2], q[2], ends[2] = q[1], z1 + r0 * step, _LINE
    p[3], q[3], ends[3] = q[2], z1 + r1 * step, other
    if r0 < s1:  # the chords overlap: from one circle to the other where they meet, and piece 2 has no length
        q[1] = p[2] = q[2] = p[3] = (
            _circles_meet(abs(p[1] - 0.0), abs(q[3] - 1.0))
            if zero_first
            else _circles_meet(abs(q[3] - 0.0), abs(p[1] - 1.0))
        )
    p[4], q[4], ends[4] = q[3], z2, _LINE
    return 5


@njit(cache=True)
def _circles_meet(about_zero, about_one):
    """The point of the upper half plane at given distances from 0 and 1."""
    # the difference of the two equations is linear; circles that touch may miss each other by rounding
    x = 0.5 * (about_zero**2 - about_one**2 + 1.0)
    return complex(x, math.sqrt(max(0.0, about_zero**2 - x * x)))


@njit(cache=True)
def _angle(z):
    return math.atan2(z.imag, z.real)


@njit(cache=True)
def _piece_length(p, q, end):
    if end == _LINE:
        return abs(q - p)
    # both in the upper half plane, and so is the arc: the difference is its angle, never 2 pi minus it
    return abs(p - end) * abs(_angle(q - end) - _angle(p - end))


@njit(cache=True, inline="always")
def _along_piece(p, q, end, share):
    if end == _LINE:
        return (1.0 - share) * p + share * q
    start = _angle(p - end)
    angle = start + share * (_angle(q - end) - start)
    radius = abs(p - end)
    return complex(end + radius * math.cos(angle), radius * math.sin(angle))


@njit(cache=True)
def _slide(source, target, propagates, times):
    z = np.empty((source.size, times.size), np.complex128)
    p, q = np.empty(_MOST_PIECES, np.complex128), np.empty(_MOST_PIECES, np.complex128)
    ends, lengths = np.empty(_MOST_PIECES), np.empty(_MOST_PIECES)
    for m in range(source.size):
        pieces = _outline(source[m], target[m], propagates[m, 0], propagates[m, 1], p, q, ends)
        if pieces == 1:
            for f in range(times.size):
                z[m, f] = (1.0 - times[f]) * source[m] + times[f] * target[m]
            continue
        for i in range(pieces):
            lengths[i] = _piece_length(p[i], q[i], ends[i])
        total = lengths[:pieces].sum()
        for f in range(times.size):
            rest = times[f] * total
            i = 0
            while i < pieces - 1 and rest > lengths[i]:
                rest -= lengths[i]
                i += 1
            # rounding may leave a rest beyond the last piece, or a piece have no length
            share = rest / lengths[i] if lengths[i] > 0.0 else 0.0
            z[m, f] = _along_piece(p[i], q[i], ends[i], min(1.0, share))
    return z

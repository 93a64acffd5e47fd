"""Angle budgets: why, with a guarantee, the shapes of a motion bound immersed disks.

**Why angles decide.**  Glue counter-clockwise triangles along a tree: the result is a disk, mapped to the plane
so that it is immersed everywhere but perhaps at its boundary vertices.  There the triangles around the vertex
make a fan, and the map is one to one on it as long as its angles add up to less than 2 pi.  (Counting
turns says the same: the n-2 triangles have angles (n-2) pi in all, the interior angles of a curve of turning
number k, taken below 2 pi, (n-2k) pi; so k = 1 + the sum over vertices of the full turns in their sums.)

**Why budgets keep them.**  Both ends of a motion have sums below 2 pi at every vertex, and along the path
"angle", where every angle changes linearly, so has every shape between.  The budget of a corner is its
angle on that path plus an equal share of what its vertex then has left below 2 pi.  A triangle whose wanted
shape breaks a budget is moved, in the space of its three angles, from its shape on the path "angle" towards the
wanted one as far as its budgets allow.  So no corner exceeds its budget, and no sum reaches 2 pi: at every
time, not only at the frames.  What was moved is a convex combination with continuous weights: no jump.

**Only where needed.**  Budgets are given to the vertices that may reach 2 pi without them.  Time is cut into 128
intervals (16 where those suffice); in each, every angle has a proved bound (`angle_bounds`), and where a triangle has a
budgeted corner the larger one of this bound and of that of the path "angle", as its shape is between the two.  A
vertex whose bounds add up to 2 pi in some interval gets a budget.  That changes the bounds of the triangles that it
touches, so this goes on until no vertex is added: the set only grows, so it ends.  Vertices with a budget stay
below 2 pi by the argument above, the others by their bounds: at every time, by proof.

**The path "area"** is different: where a third vertex goes depends on the length of its base, and with it on the
budgets of all its ancestors, and there is no bound between times.  There the sums are looked at at 129 times,
and vertices that overflow, or would within their largest change from one time to the next, get a budget.  With budgets
at all vertices that is the proof above; with fewer it is measured, and `tween.certify` looks again.

Legend: ``a b c`` corners of a triangle over its base ab; ``L`` limits of their angles.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.morphing.compatible.paths import apex, third_angle

_FEW_TIMES, _TIMES = 17, 129  # at which angles are looked at
_FEW_AREA, _TIMES_AREA = 16, 256  # intervals along the path "area", to begin with and at most
RESERVE = 2.0**-6  # of what a vertex has left below 2 pi; budgets never touch it
_ROUNDING = 1e-9  # of a sum of angles


class Budgets(NamedTuple):
    """Angles on the path "angle", and limits, all linear in time; in tree order.

    Attributes
    ----------
    first, last : ndarray of float64, shape (m, 3)
        Angles at a, b, c at times 0 and 1.
    low, high : ndarray of float64, shape (m, 3)
        Limits of these angles at times 0 and 1; infinite where the vertex has no budget.
    sides : ndarray of float64, shape (m, 2)
        For the path "area": on which side of 1/2, -1 or +1, the foot passes where the angle at c is at its limit
        (0 where it cannot pass), and how fast it gets out of the way.
    """

    first: NDArray[np.float64]
    last: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]
    sides: NDArray[np.float64]


def no_budgets(m: int) -> Budgets:
    """Make budgets that bind nowhere.

    Parameters
    ----------
    m : int
        Number of triangles.

    Returns
    -------
    Budgets
    """
    none = np.full((m, 3), np.inf)
    return Budgets(none, none, none, none, np.zeros((m, 2)))


def left_over(corners: NDArray[np.int64], angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """What every vertex has left below 2 pi.

    Parameters
    ----------
    corners : ndarray of int, shape (m, 3)
    angles : ndarray of float64, shape (m, 3)
        Angles at these corners.

    Returns
    -------
    ndarray of float64, shape (n,)
        Radians.
    """
    return np.asarray(2 * np.pi - np.bincount(corners.ravel(), angles.ravel()))


def default_reserve(
    corners: NDArray[np.int64], first: NDArray[np.float64], last: NDArray[np.float64]
) -> NDArray[np.float64]:
    """What budgets leave untouched at every vertex, at times 0 and 1.

    Parameters
    ----------
    corners : ndarray of int, shape (m, 3)
    first, last : ndarray of float64, shape (m, 3)
        Angles at these corners at times 0 and 1.

    Returns
    -------
    ndarray of float64, shape (2, n)
        A sixty-fourth of what is left below 2 pi.
    """
    return np.stack([RESERVE * left_over(corners, angles) for angles in (first, last)])


def budgets_at(
    vertices: NDArray[np.bool_],
    corners: NDArray[np.int64],
    first: NDArray[np.float64],
    last: NDArray[np.float64],
    reserve: NDArray[np.float64] | None = None,
) -> Budgets:
    """Give budgets to some vertices.

    Parameters
    ----------
    vertices : ndarray of bool, shape (n,)
        Which vertices get a budget.
    corners : ndarray of int, shape (m, 3)
    first, last : ndarray of float64, shape (m, 3)
        Angles at these corners at times 0 and 1.
    reserve : ndarray of float64, shape (2, n), optional
        See `default_reserve`.

    Returns
    -------
    Budgets
    """
    count = np.bincount(corners.ravel(), minlength=len(vertices))
    limits = []
    kept = default_reserve(corners, first, last) if reserve is None else reserve
    for angles, untouched in zip((first, last), kept, strict=True):
        spare = np.maximum(left_over(corners, angles) - untouched, 0.0)
        limits.append(np.where(vertices[corners], angles + (spare / count)[corners], np.inf))
    low, high = limits
    return Budgets(first, last, low, high, _sides(first, last, low, high))


def _sides(
    first: NDArray[np.float64], last: NDArray[np.float64], low: NDArray[np.float64], high: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Choose the side on which both ends of the motion lie already, or else the one that is nearer to them."""
    best = np.zeros((len(first), 2))
    slowest = np.full(len(first), np.inf)
    for side in (-1.0, 1.0):
        speed = np.ones(len(first))
        for angles, limit in ((first, low[:, 2]), (last, high[:, 2])):
            radius = np.sin(angles[:, 1]) / np.sin(angles[:, 2])
            beyond = side * (radius * np.cos(angles[:, 0]) - 0.5)
            room = _room(radius * np.sin(angles[:, 0]), np.where(limit < np.pi, limit, 0.5 * np.pi))
            reached = np.where(room >= 0, np.where(beyond >= room, 1.0, np.inf), beyond / np.minimum(room, -1e-300))
            speed = np.maximum(speed, reached)
        better = speed < slowest
        slowest[better] = speed[better]
        best[better] = np.stack([np.full(better.sum(), side), speed[better]], axis=1)
    return best


@njit(cache=True)
def _room(height, limit):
    """How far from 1/2 the foot must be for the angle at c to keep to its limit; below 0 where it need not."""
    square = 1.0 - 4.0 * height * (height - 1.0 / np.tan(limit))
    return 0.5 * np.sign(square) * np.sqrt(np.abs(square))


def proved_budgets(
    corners: NDArray[np.int64],
    first: NDArray[np.float64],
    last: NDArray[np.float64],
    bounds: Callable[[NDArray[np.float64], NDArray[np.int64]], NDArray[np.float64]],
    reserve: NDArray[np.float64] | None = None,
) -> tuple[Budgets, NDArray[np.float64]]:
    """Give budgets to the vertices that are not proved to stay below 2 pi without one.

    Parameters
    ----------
    corners : ndarray of int, shape (m, 3)
    first, last : ndarray of float64, shape (m, 3)
        Angles at these corners at times 0 and 1.
    bounds : callable
        From times, shape (k,), and rows of `corners`, shape (r,), to bounds of their angles, in the motion without
        budgets, between neighbouring times, shape (r, 3, k-1).
    reserve : ndarray of float64, shape (2, n), optional
        See `default_reserve`.

    Returns
    -------
    Budgets
    slack : ndarray of float64, shape (n,)
        What vertices without a budget are proved to have left below 2 pi at all times; negative for others.

    Notes
    -----
    Most vertices are proved by bounds in a few long intervals; short ones, which are tighter, are looked at around the
    others only.  Seldom more costly than 129 frames.
    """
    few, many = np.linspace(0.0, 1.0, _FEW_TIMES), np.linspace(0.0, 1.0, _TIMES)
    vertices, known = np.zeros(corners.max() + 1, dtype=np.bool_), np.zeros(len(corners), dtype=np.bool_)
    rough, fine = bounds(few, np.arange(len(corners))), np.zeros((len(corners), 3, _TIMES - 1))

    def touches(some: NDArray[np.bool_]) -> NDArray[np.bool_]:
        return np.asarray(some[corners].any(axis=1))

    def proved(rows: NDArray[np.bool_], angles: NDArray[np.float64]) -> NDArray[np.float64]:
        sums = vertex_sums(corners[rows], angles[rows], len(vertices)).max(axis=1)
        return np.nan_to_num(2 * np.pi - sums, nan=-1.0) - _ROUNDING

    def reach_plain(angles: NDArray[np.float64], times: NDArray[np.float64], rows: NDArray[np.bool_]) -> None:
        plain = (1 - times) * first[rows, :, None] + times * last[rows, :, None]
        angles[rows] = np.maximum(angles[rows], np.maximum(plain[..., :-1], plain[..., 1:]))

    while True:
        slack = proved(np.ones_like(known), rough)
        near = touches(slack <= 0) & ~known
        known |= near
        fine[near] = bounds(many, np.flatnonzero(near))
        slack = np.where(slack <= 0, proved(known, fine), slack)
        over = (slack <= 0) & ~vertices
        if not over.any():
            none = no_budgets(len(corners))
            return budgets_at(vertices, corners, first, last, reserve) if vertices.any() else none, slack
        vertices |= over
        for angles, times in ((rough, few), (fine, many)):
            reach_plain(angles, times, touches(over))


def budgets_by_area(
    corners: NDArray[np.int64],
    first: NDArray[np.float64],
    last: NDArray[np.float64],
    bounds: Callable[[NDArray[np.float64], Budgets], NDArray[np.float64]],
    reserve: NDArray[np.float64],
) -> tuple[Budgets, NDArray[np.float64]]:
    """Give budgets to the vertices that are not proved to stay below 2 pi without one, along the path "area".

    Parameters
    ----------
    corners : ndarray of int, shape (m, 3)
    first, last : ndarray of float64, shape (m, 3)
        Angles at these corners at times 0 and 1.
    bounds : callable
        From times, shape (k,), and budgets to bounds of the angles between neighbouring times, shape (m, 3, k-1).
    reserve : ndarray of float64, shape (2, n)
        See `default_reserve`.

    Returns
    -------
    Budgets
    slack : ndarray of float64, shape (n,)
        What vertices without a budget are proved to have left below 2 pi at all times; negative for others.

    Notes
    -----
    Intervals are cut in four until they are proved or a 256th; then the vertices in doubt get budgets, and all begins
    again.  With budgets at all vertices there is nothing to prove, so this ends.
    """
    vertices = np.zeros(corners.max() + 1, dtype=np.bool_)
    while True:
        budgets = budgets_at(vertices, corners, first, last, reserve) if vertices.any() else no_budgets(len(corners))
        slack = np.full(len(vertices), np.inf)
        starts, stops = np.linspace(0.0, 1.0, _FEW_AREA + 1)[:-1], np.linspace(0.0, 1.0, _FEW_AREA + 1)[1:]
        while len(starts):
            knots = np.unique([starts, stops])
            sums = vertex_sums(corners, bounds(knots, budgets), len(vertices))[:, np.searchsorted(knots, starts)]
            left = np.nan_to_num(2 * np.pi - sums, nan=-1.0) - _ROUNDING
            left[vertices] = np.inf
            bad = (left <= 0).any(axis=0)
            fine = stops - starts < 1.5 / _TIMES_AREA
            slack = np.minimum(slack, left[:, ~bad | fine].min(axis=1, initial=np.inf))
            again = bad & ~fine
            cuts = np.linspace(starts[again], stops[again], 5)
            starts, stops = cuts[:-1].T.ravel(), cuts[1:].T.ravel()
            if (slack <= 0).any() and len(starts) == 0:
                break
        over = slack <= 0
        if not over.any():
            return budgets, np.where(vertices, -1.0, slack)
        vertices |= over


@njit(cache=True)
def vertex_sums(corners, angles, n):
    """Sums of angles, (m, 3, k), at each vertex, (n, k)."""
    sums = np.zeros((n, angles.shape[2]))
    for i in range(len(corners)):
        for s in range(3):
            sums[corners[i, s]] += angles[i, s]
    return sums


@njit(cache=True)
def keep_to_budget(z, t, first, last, low, high, sides, by_area):
    """The third vertex, moved as little as the budgets of its triangle ask for.

    Along the path "area" it first moves parallel to the base, which keeps the area.
    """
    if by_area:
        z = _slide_foot(z, _limit(t, low[0], high[0]), _limit(t, low[1], high[1]), _limit(t, low[2], high[2]), sides)
    wanted = (math.atan2(z.imag, z.real), math.atan2(z.imag, 1.0 - z.real), third_angle(z.real, z.imag))
    share = 1.0
    for s in range(3):
        if low[s] == math.inf:
            continue
        plain, limit = (1 - t) * first[s] + t * last[s], (1 - t) * low[s] + t * high[s]
        if wanted[s] > limit:
            share = min(share, max(0.0, limit - plain) / max(wanted[s] - plain, 1e-300))
    if share == 1.0:
        return z
    back, on = (1 - share) * (1 - t), (1 - share) * t
    return apex(
        back * first[0] + on * last[0] + share * wanted[0],
        back * first[1] + on * last[1] + share * wanted[1],
        back * first[2] + on * last[2] + share * wanted[2],
    )


@njit(cache=True)
def _limit(t, low, high):
    return math.inf if low == math.inf else (1 - t) * low + t * high


@njit(cache=True)
def _slide_foot(z, limit_a, limit_b, limit_c, sides):
    """Move z at its height so that its triangle keeps to its limits; as far as can be where it cannot."""
    low, high = foot_bounds(z.imag, limit_a, limit_b, limit_c, sides)
    return complex(clamp(z.real, low, high), z.imag)


@njit(cache=True)
def foot_bounds(y, limit_a, limit_b, limit_c, sides):
    """Bounds of the foot x that limits give to a third vertex at height y.

    That of the angle c at z, largest for x = 1/2, asks for a distance from 1/2, on
    one side at all times; the bound comes up from beyond the foot before it is needed, so there is no jump.
    """
    low = y / math.tan(limit_a) if limit_a < math.pi else -math.inf
    high = 1.0 - y / math.tan(limit_b) if limit_b < math.pi else math.inf
    if limit_c < math.pi and sides[0] != 0.0:
        room = _room(y, limit_c)
        if room < 0.0:
            room *= sides[1]
        if sides[0] > 0.0:
            low = max(low, 0.5 + room)
        else:
            high = min(high, 0.5 - room)
    return low, high


@njit(cache=True)
def clamp(x, low, high):
    """The nearest number to x between bounds, or half way between them where they contradict each other."""
    if low > high:
        return 0.5 * (low + high)
    return min(max(x, low), high)

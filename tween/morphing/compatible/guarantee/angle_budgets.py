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
intervals (16 where those suffice); in each, every angle has a proved bound (`.angle_bounds`), and where a triangle has
a budgeted corner the larger one of this bound and of that of the path "angle", as its shape is between the two.  A
vertex whose bounds add up to 2 pi in some interval gets a budget.  That changes the bounds of the triangles that it
touches, so this goes on until no vertex is added: the set only grows, so it ends.  Vertices with a budget stay
below 2 pi by the argument above, the others by their bounds: at every time, by proof.

**The path "area"** is different: where a third vertex goes depends on the length of its base, and so on all its
ancestors.  It is not held back by budgets, but led another way that keeps the areas, see `area_twists`.

Legend: ``a b c`` corners of a triangle over its base ab; ``L`` limits of their angles.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.morphing.compatible.guarantee.sum_search import ROUNDING, SumSearch
from tween.morphing.compatible.paths import apex, third_angle

RESERVE = 2.0**-6  # of what a vertex has left below 2 pi; budgets never touch it


class Budgets(NamedTuple):
    """Angles on the path "angle", and limits, all linear in time; in tree order.

    Attributes
    ----------
    first, last : ndarray of float64, shape (m, 3)
        Angles at a, b, c at times 0 and 1.
    low, high : ndarray of float64, shape (m, 3)
        Limits of these angles at times 0 and 1; infinite where the vertex has no budget.
    """

    first: NDArray[np.float64]
    last: NDArray[np.float64]
    low: NDArray[np.float64]
    high: NDArray[np.float64]


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
    return Budgets(none, none, none, none)


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
    return Budgets(first, last, low, high)


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
        What vertices without a budget are proved to have left below 2 pi at all times, at least 1e-9; nan for others.

    Notes
    -----
    Most vertices are proved by bounds in a few long intervals; those are divided, which makes bounds tighter, only
    around the others, and for them only where little is left.  Seldom more costly than 129 frames.
    """
    search = SumSearch(corners, first, last, bounds)
    vertices = np.zeros(corners.max() + 1, dtype=np.bool_)
    while True:
        slack = search.slack(vertices)
        over = (slack <= 0) & ~vertices
        if not over.any():
            budgets = (
                budgets_at(vertices, corners, first, last, reserve) if vertices.any() else no_budgets(len(corners))
            )
            return budgets, np.where(vertices, np.nan, slack + ROUNDING)
        vertices |= over
        search.reach_plain(vertices)


@njit(cache=True)
def keep_to_budget(z, times, first, last, low, high):
    """Move the third vertices of a triangle, (k,), in place, as little as its budgets ask for."""
    for f in range(times.size):
        s, t = 1 - times[f], times[f]
        x, y = z[f].real, z[f].imag
        share, a, b, c = 1.0, -1.0, -1.0, -1.0
        if low[0] < math.inf:
            a = math.atan2(y, x)
            share = _allowed(share, a, s * first[0] + t * last[0], s * low[0] + t * high[0])
        if low[1] < math.inf:
            b = math.atan2(y, 1.0 - x)
            share = _allowed(share, b, s * first[1] + t * last[1], s * low[1] + t * high[1])
        if low[2] < math.inf:
            c = third_angle(x, y)
            share = _allowed(share, c, s * first[2] + t * last[2], s * low[2] + t * high[2])
        if share == 1.0:
            continue
        a, b = a if a >= 0.0 else math.atan2(y, x), b if b >= 0.0 else math.atan2(y, 1.0 - x)
        c = c if c >= 0.0 else third_angle(x, y)
        back, on = (1 - share) * s, (1 - share) * t
        z[f] = apex(
            back * first[0] + on * last[0] + share * a,
            back * first[1] + on * last[1] + share * b,
            back * first[2] + on * last[2] + share * c,
        )


@njit(cache=True)
def _allowed(share, wanted, plain, limit):
    """The share of what is wanted beyond the path "angle" that one more corner allows."""
    if wanted > limit:
        return min(share, max(0.0, limit - plain) / max(wanted - plain, 1e-300))
    return share

"""Laying triangles out, for all times at once: compiled kernels.

Legend: as in `leg`; k times; arrays of triangles are in tree order.
"""

import cmath
import math

import numpy as np
from numba import njit

from tween.morphing.compatible.area_thirds import area_third
from tween.morphing.compatible.guarantee.angle_budgets import keep_to_budget

_HALF_TURN = 1e-9  # radians; a root that turns by 180 degrees within this turns the same way in reverse


@njit(cache=True)
def placed(laid, root, first_centre, last_centre, t, source, target):
    """Shapes, (k, n, 2), from those laid out, (n, k), so moved that the centre of the root is where it should be."""
    n, k = laid.shape
    shapes = np.empty((k, n, 2))
    for f in range(k):
        if t[f] == 0.0:  # the ends are the input to the last bit, free of what the layout rounds
            _copy(source, shapes[f])
        elif t[f] == 1.0:
            _copy(target, shapes[f])
        else:
            root_centre = (laid[root[0], f] + laid[root[1], f] + laid[root[2], f]) * (1.0 / 3.0)
            step = (1.0 - t[f]) * first_centre + t[f] * last_centre - root_centre
            for i in range(n):
                place = laid[i, f] + step
                shapes[f, i, 0], shapes[f, i, 1] = place.real, place.imag
    return shapes


@njit(cache=True, inline="always")
def _copy(points, place):
    """Write points, (n, 2), to a place."""
    for i in range(len(points)):
        place[i, 0], place[i, 1] = points[i, 0], points[i, 1]


@njit(cache=True)
def root_base(source, target, by_squares, t):
    """The base of the root, b - a, at every time."""
    e1, e2 = source[1] - source[0], target[1] - target[0]
    turn = cmath.phase(e2 / e1)
    # near half a turn rounding would choose the direction, and perhaps the same one for the reversed morph
    if abs(abs(turn) - math.pi) < _HALF_TURN:
        apart = e1 / abs(e1) - e2 / abs(e2)  # changes sign, exactly, when source and target are exchanged
        way = math.copysign(1.0, apart.imag if apart.imag != 0.0 else apart.real)
        if turn * way < 0.0:
            turn += 2.0 * math.pi * way
    e = np.empty(t.size, np.complex128)
    for f in range(t.size):
        if by_squares:  # along "metric" the root is no exception: all its edges have linear squares
            length = math.sqrt((1 - t[f]) * abs(e1) ** 2 + t[f] * abs(e2) ** 2)
        else:
            length = (1 - t[f]) * abs(e1) + t[f] * abs(e2)
        e[f] = cmath.rect(length, cmath.phase(e1) + t[f] * turn)
    return e


@njit(cache=True, inline="always")
def _any_finite(values):
    for value in values:
        if math.isfinite(value):
            return True
    return False


@njit(cache=True)
def hang(corners, children, z, root_base, t, path, budgets):
    """Shapes, (n, k), up to a translation each; z, (m, k) in tree order, is set by area or kept to the budgets.

    What moves along other paths than "area" has None for it, and what needs no budgets None for these: numba then
    compiles nothing for them.
    """
    m, k = z.shape
    shapes, bases = np.empty((m + 2, k), np.complex128), np.empty((m, k), np.complex128)
    for f in range(k):  # array expressions would make an array each, and are long to compile
        bases[0, f] = root_base[f]
        shapes[corners[0, 0], f] = 0.0
        shapes[corners[0, 1], f] = root_base[f]
    for i in range(m):  # parents come first: the base of i, and its ends, are known by now
        if path is not None:
            areas, above, below, blend, plain_first, plain_last = path
            for f in range(k):
                square = bases[i, f].real ** 2 + bases[i, f].imag ** 2
                z[i, f] = area_third(i, square, t[f], areas, above, below, blend, plain_first, plain_last)
        if budgets is not None:
            first, last, low, high = budgets
            if _any_finite(low[i]):  # the others keep their bits
                keep_to_budget(z[i], t, first[i], last[i], low[i], high[i])
        a, c = corners[i, 0], corners[i, 2]
        for f in range(k):
            shapes[c, f] = shapes[a, f] + z[i, f] * bases[i, f]
        across_bc, across_ca, across_ab = children[i, 0], children[i, 1], children[i, 2]
        if across_bc >= 0:
            for f in range(k):
                bases[across_bc, f] = (1.0 - z[i, f]) * bases[i, f]
        if across_ca >= 0:
            for f in range(k):
                bases[across_ca, f] = z[i, f] * bases[i, f]
        if across_ab >= 0:
            for f in range(k):
                bases[across_ab, f] = -bases[0, f]
    return shapes

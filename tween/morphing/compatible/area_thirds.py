"""Third vertices along the path "area": where they go depends on the length of the base at every moment.

A triangle is given by its area and by d, the difference of its angles at the base; it may be *blended* with its shape
along the path "angle", see `.guarantee.area_twists`.

Legend: as in `.paths`; ``above`` pi + d and ``below`` pi - d, cubics of time in Bernstein form.
"""

import math

import numpy as np
from numba import njit

from tween.morphing.compatible.paths import apex, third_angle

_FLATTEST = 1e-17  # sine of the angle difference of a triangle that rounding has made flat


@njit(cache=True)
def area_apex(height, above, below):
    """The third vertex at a height h over the base, with a difference d of the angles at 0 and at 1.

    Given are ``above`` = pi + d and ``below`` = pi - d, of which the smaller one is precise even where the
    triangle is flat.  The foot is 1/2 + w with tan d = -2 h w / (1/4 - w**2 + h**2); of the two solutions that for
    which d has the sign of the larger angle, written so that nothing cancels.
    """
    s, c = turned(above, below)
    return complex(0.5 + foot(height, s, c), height)


@njit(cache=True)
def turned(above, below):
    """Sine and cosine of d, see `area_apex`."""
    # by way of the smaller angle: where d is near pi or -pi, d itself has lost its digits
    s, c = (math.sin(below), -math.cos(below)) if below < above else (-math.sin(above), -math.cos(above))
    if abs(s) < _FLATTEST:
        s = math.copysign(_FLATTEST, above - below)  # the sign of d: on which side the foot is far out
    return s, c


@njit(cache=True)
def foot(height, s, c):
    """Where the foot of the height is, from the middle of the base, for sine and cosine of d; see `area_apex`."""
    root = math.sqrt(height * height + 0.25 * s * s)
    # the same root in two forms; each is used where it adds numbers of one sign
    return -s * (height * height + 0.25) / (height * c + root) if c > 0.0 else (height * c - root) / s


@njit(cache=True)
def bernstein(c, t):
    """The cubic with four coefficients in Bernstein form; of positive ones it is precise, however small."""
    s = 1.0 - t
    return s * s * (s * c[0] + 3.0 * t * c[1]) + t * t * (3.0 * s * c[2] + t * c[3])


@njit(cache=True)
def area_third(i, square, t, areas, above, below, blend, first, last):
    """The third vertex of triangle i along the path "area", over a base of given squared length."""
    p, q, r = (1.0 - blend[i]), blend[i] * (1 - t), blend[i] * t
    if p == 0.0:
        return apex(
            q * first[i, 0] + r * last[i, 0], q * first[i, 1] + r * last[i, 1], q * first[i, 2] + r * last[i, 2]
        )
    height = ((1 - t) * areas[i, 0] + t * areas[i, 1]) / square
    z = area_apex(height, bernstein(above[i], t), bernstein(below[i], t))
    if blend[i] == 0.0:
        return z
    return apex(
        p * math.atan2(z.imag, z.real) + q * first[i, 0] + r * last[i, 0],
        p * math.atan2(z.imag, 1.0 - z.real) + q * first[i, 1] + r * last[i, 1],
        p * third_angle(z.real, z.imag) + q * first[i, 2] + r * last[i, 2],
    )


@njit(cache=True)
def area_thirds(children, root, times, areas, above, below, blend, first, last, cells):
    """Third vertices, (m, k), along the path "area" at both ends of the cells wanted, (m, k-1); 0 elsewhere.

    Parameters: as for laying out, in tree order; the root's base (k) at the times.
    """
    m, k = len(children), len(times)
    z, bases = np.zeros((m, k), np.complex128), np.empty((m, k), np.complex128)
    bases[0] = root
    for i in range(m):
        for f in range(k):
            if not ((f > 0 and cells[i, f - 1]) or (f < k - 1 and cells[i, f])):
                continue
            e = bases[i, f]
            z[i, f] = area_third(i, e.real**2 + e.imag**2, times[f], areas, above, below, blend, first, last)
            if children[i, 0] >= 0:
                bases[children[i, 0], f] = (1.0 - z[i, f]) * e
            if children[i, 1] >= 0:
                bases[children[i, 1], f] = z[i, f] * e
            if children[i, 2] >= 0:
                bases[children[i, 2], f] = -e
    return z

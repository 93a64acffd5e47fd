"""Arc tangents and sines for bounds, several at a time.

Those of the C library, one after the other, would take half of the time of a proof.  Bounds have room for an error of
some last bits, and for that polynomials do.  Loops over these have no branches, so compilers turn them into
instructions for several numbers at once, as long as such a loop reads and writes few arrays.  What people get is laid
out with the functions of the C library.

References
----------
Moshier, Methods and Programs for Mathematical Functions (1989), and his library Cephes: the coefficients of the arc
tangent.
"""

import math

from numba import njit

ERROR = 2.0**-51
"""Relative, of both."""

_NUMERATOR = (
    -6.485021904942025e1,
    -1.228866684490136e2,
    -7.500855792314705e1,
    -1.615753718733365e1,
    -8.750608600031904e-1,
)
_DENOMINATOR = (
    1.945506571482614e2,
    4.853903996359137e2,
    4.328810604912903e2,
    1.6502700983169885e2,
    2.485846490142306e1,
)
_S = tuple((-1.0) ** i / math.factorial(2 * i + 1) for i in range(1, 11))
_PI_BEYOND_DOUBLE = 1.2246467991473532e-16


@njit(cache=True, error_model="numpy")
def arc_tangent(y, x):
    """The angle of the point (x, y), y >= 0, as seen from the origin; nan at the origin itself.

    Parameters
    ----------
    y, x : float

    Returns
    -------
    float
        Radians, from 0 to pi.

    Examples
    --------
    >>> abs(arc_tangent(1.0, -1.0) - 0.75 * math.pi) <= ERROR * math.pi
    True
    """
    steep = y > abs(x)
    small, large = (abs(x), y) if steep else (y, abs(x))
    turned = small > 0.66 * large  # by 45 degrees, towards 0
    below = small + large if turned else large
    u = (small - large if turned else small) / below if below > 0.0 else math.nan
    w = u * u
    p = _NUMERATOR[0] + w * (_NUMERATOR[1] + w * (_NUMERATOR[2] + w * (_NUMERATOR[3] + w * _NUMERATOR[4])))
    q = _DENOMINATOR[0] + w * (
        _DENOMINATOR[1] + w * (_DENOMINATOR[2] + w * (_DENOMINATOR[3] + w * (_DENOMINATOR[4] + w)))
    )
    angle = u + u * (w * p / q)
    angle = angle + 0.25 * math.pi if turned else angle
    angle = 0.5 * math.pi - angle if steep else angle
    return math.pi - angle if x < 0.0 else angle


@njit(cache=True, error_model="numpy")
def sine_up_to_pi(angle):
    """The sine of an angle from 0 to pi.

    Parameters
    ----------
    angle : float
        Radians.

    Returns
    -------
    float

    Notes
    -----
    Taylor's series up to the term that doubles do not see.

    Examples
    --------
    >>> abs(sine_up_to_pi(math.pi / 6) - 0.5) <= ERROR
    True
    """
    x = (math.pi - angle) + _PI_BEYOND_DOUBLE if angle > 0.5 * math.pi else angle
    w = x * x
    p = _S[0] + w * (
        _S[1]
        + w * (_S[2] + w * (_S[3] + w * (_S[4] + w * (_S[5] + w * (_S[6] + w * (_S[7] + w * (_S[8] + w * _S[9])))))))
    )
    return x + x * w * p

r"""Easing: how a motion spends its time, as in CSS.

An `Ease` takes shares of time to shares of the way.  It is a cubic Bezier curve from (0, 0) to (1, 1) with two control
points, the x of which is time:

    linear       0    0    1    1         ease-in      0.42 0    1    1
    ease         0.25 0.1  0.25 1         ease-out     0    0    0.58 1
    smooth       1/3  0    2/3  1         ease-in-out  0.42 0    0.58 1

"smooth" is s s (3 - 2 s), of which CSS has no name.
"""

import math
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_HALVINGS = 60  # of the parameter of a Bezier curve: beyond the last bit
_FUNCTION = re.compile(r"cubic-bezier\(([^()]*)\)")

_Floats = NDArray[np.float64]


class Ease(NamedTuple):
    """A cubic Bezier curve of time; made by `as_ease`.

    Attributes
    ----------
    x1, y1, x2, y2 : float
        The two control points, from 0 to 1.
    """

    x1: float
    y1: float
    x2: float
    y2: float

    def at(self, s: _Floats) -> _Floats:
        """Return which share of the way is done at shares of the time.

        Parameters
        ----------
        s : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k,)
            From 0 to 1; exactly 0 at 0 and 1 at 1.

        Examples
        --------
        >>> as_ease("ease-in-out").at(np.array([0.0, 0.25, 0.5, 1.0])).round(3).tolist()
        [0.0, 0.129, 0.5, 1.0]
        """
        if self == LINEAR:
            return s
        if self == SMOOTH:
            return np.asarray(s * s * (3 - 2 * s))
        return _bezier(self.y1, self.y2, _parameter(self.x1, self.x2, s))

    def when(self, way: _Floats) -> _Floats:
        """Return at which shares of the time shares of the way are done: the inverse of `at`.

        Parameters
        ----------
        way : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k,)

        Examples
        --------
        >>> ease = as_ease("ease")
        >>> ease.when(ease.at(np.array([0.0, 0.3, 1.0]))).round(9).tolist()
        [0.0, 0.3, 1.0]
        """
        if self == LINEAR:
            return way
        if self == SMOOTH:
            return np.asarray(0.5 - np.sin(np.arcsin(1 - 2 * way) / 3))
        return _bezier(self.x1, self.x2, _parameter(self.y1, self.y2, way))


LINEAR = Ease(0.0, 0.0, 1.0, 1.0)
SMOOTH = Ease(1 / 3, 0.0, 2 / 3, 1.0)
EASES = {
    "linear": LINEAR,
    "smooth": SMOOTH,
    "ease": Ease(0.25, 0.1, 0.25, 1.0),
    "ease-in": Ease(0.42, 0.0, 1.0, 1.0),
    "ease-out": Ease(0.0, 0.0, 0.58, 1.0),
    "ease-in-out": Ease(0.42, 0.0, 0.58, 1.0),
}
"""By name; all but "smooth" are those of CSS."""

AnyEase = Ease | str | Sequence[float] | bool


def as_ease(value: AnyEase) -> Ease:
    """Return the easing that is meant.

    Parameters
    ----------
    value : str, sequence of four float, Ease or bool
        A name of `EASES`, "cubic-bezier(x1, y1, x2, y2)", or the four numbers, all from 0 to 1; true for "smooth",
        false for "linear".

    Returns
    -------
    Ease

    Raises
    ------
    ValueError
        Where it is none.  CSS allows any y1 and y2; beyond 0 and 1 there would be no shape to show.

    Examples
    --------
    >>> as_ease("cubic-bezier(0.42, 0, 0.58, 1)") == as_ease("ease-in-out")
    True
    >>> as_ease("bounce")
    Traceback (most recent call last):
    ...
    ValueError: ease is 'bounce', expected linear, smooth, ease, ease-in, ease-out, ease-in-out or cubic-bezier(...)
    """
    if isinstance(value, bool | np.bool_):
        return SMOOTH if value else LINEAR
    if isinstance(value, str) and value in EASES:
        return EASES[value]
    expected = f"expected {', '.join(EASES)} or cubic-bezier(...)"
    found = _FUNCTION.fullmatch(value.strip()) if isinstance(value, str) else None
    try:
        numbers = [float(part) for part in (found[1].split(",") if found else value)]
    except (TypeError, ValueError):
        raise ValueError(f"ease is {value!r}, {expected}") from None
    if len(numbers) != 4:
        raise ValueError(f"ease is {value!r}, {expected}")
    if not all(math.isfinite(x) and 0 <= x <= 1 for x in numbers):
        raise ValueError(
            f"ease is {value!r}, expected numbers from 0 to 1: beyond the two shapes there is none to show"
        )
    return Ease(*numbers)


def _bezier(first: float, second: float, u: _Floats) -> _Floats:
    """One coordinate of the curve at parameters; exactly 0 at 0 and 1 at 1, and never beyond."""
    v = 1 - u
    return np.asarray(np.clip(u * (3 * v * (v * first + u * second) + u * u), 0.0, 1.0))


def _parameter(first: float, second: float, wanted: _Floats) -> _Floats:
    """The parameters at which a coordinate, which never falls, has some values."""
    low, high = np.zeros_like(wanted), np.ones_like(wanted)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        below = _bezier(first, second, middle) < wanted
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.where(wanted <= 0, 0.0, np.where(wanted >= 1, 1.0, high))

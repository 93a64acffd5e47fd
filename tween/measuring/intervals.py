r"""Interval arithmetic on arrays, rounded outwards: whatever the roundings, the true value lies between the bounds.

Sums, products, quotients and roots of doubles are rounded to the nearest, so the next double outwards is a bound.  The
arc tangent is not rounded to the nearest; its bounds go four doubles outwards, more than any library is off.

Legend: ``low high`` bounds; ``t`` a time, a double and exact; ``p q`` where an interval of time begins and ends.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]


class Interval(NamedTuple):
    """Bounds of numbers, in arrays of one shape.

    Attributes
    ----------
    low, high : ndarray of float64

    Examples
    --------
    >>> third = Interval.exact(np.array([1.0])) / Interval.exact(np.array([3.0]))
    >>> from fractions import Fraction
    >>> Fraction(third.low[0]) < Fraction(1, 3) < Fraction(third.high[0])
    True
    """

    low: _Floats
    high: _Floats

    @classmethod
    def exact(cls, values: _Floats) -> "Interval":
        """Bounds of doubles: these themselves."""
        return cls(values, values)

    def __neg__(self) -> "Interval":
        return Interval(-self.high, -self.low)

    def __add__(self, other: "Interval") -> "Interval":  # type: ignore[override]
        return _outwards(self.low + other.low, self.high + other.high)

    def __sub__(self, other: "Interval") -> "Interval":
        return self + (-other)

    def __mul__(self, other: "Interval") -> "Interval":  # type: ignore[override]
        ends = [a * b for a in self for b in other]
        return _outwards(np.minimum.reduce(ends), np.maximum.reduce(ends))

    def __truediv__(self, other: "Interval") -> "Interval":
        """Divide by what is positive; without bounds where that is not known."""
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            ends = [a / b for a in self for b in other]
        positive = other.low > 0
        low = np.where(positive, np.minimum.reduce(ends), -np.inf)
        return _outwards(low, np.where(positive, np.maximum.reduce(ends), np.inf))

    def square(self) -> "Interval":
        """Bounds of the square."""
        least = np.where((self.low <= 0) & (self.high >= 0), 0.0, np.minimum(self.low**2, self.high**2))
        wide = _outwards(least, np.maximum(self.low**2, self.high**2))
        return Interval(np.maximum(wide.low, 0.0), wide.high)

    def root(self) -> "Interval":
        """Bounds of the square root; what is below 0 counts as 0."""
        wide = _outwards(np.sqrt(np.maximum(self.low, 0.0)), np.sqrt(np.maximum(self.high, 0.0)))
        return Interval(np.maximum(wide.low, 0.0), wide.high)

    def hull(self, other: "Interval") -> "Interval":
        """Bounds of both."""
        return Interval(np.minimum(self.low, other.low), np.maximum(self.high, other.high))

    def rows(self, which: NDArray[np.bool_] | NDArray[np.int64]) -> "Interval":
        """Those of some rows."""
        return Interval(self.low[which], self.high[which])

    def over(self, count: int) -> "Interval":
        """The same for each of so many intervals of time, as a new last axis."""
        shape = (*self.low.shape, count)
        return Interval(*(np.broadcast_to(side[..., None], shape) for side in self))


def between(first: Interval, last: Interval, t: _Floats) -> Interval:
    """Enclose (1-t) first + t last.

    Parameters
    ----------
    first, last : Interval
    t : ndarray of float64
        From 0 to 1, broadcast against the bounds.

    Returns
    -------
    Interval
    """
    time = Interval.exact(t)
    return (Interval.exact(np.ones_like(t)) - time) * first + time * last


def angle(y: Interval, x: Interval) -> Interval:
    """Enclose the argument of x + iy.

    Parameters
    ----------
    y : Interval
        Not negative; what is below 0 counts as 0.
    x : Interval

    Returns
    -------
    Interval
        From 0 to pi.
    """
    bottom, top = np.maximum(y.low, 0.0), np.maximum(y.high, 0.0)
    # over a box the argument is least at a corner on the right, largest at one on the left
    least = np.arctan2(np.where(x.high > 0, bottom, top), x.high)
    largest = np.arctan2(np.where(x.low > 0, top, bottom), x.low)
    wide = _outwards(_outwards(least, largest).low, _outwards(least, largest).high)
    wide = _outwards(*_outwards(*wide))
    return Interval(np.maximum(wide.low, 0.0), wide.high)


def _outwards(low: _Floats, high: _Floats) -> Interval:
    return Interval(np.nextafter(low, -np.inf), np.nextafter(high, np.inf))

"""A stroke made smooth inside a tube around it, and its places told apart from its points.

Legend: ``t`` places along the stroke, in rows: 2.5 is halfway from row 2 to row 3; ``a b`` the ends of a piece of it;
``x`` points made smooth.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import gaussian_filter1d

_FINENESS = 4  # samples of a radius' length
_FEWEST, _MOST = 64, 2**15  # samples of a stroke
_WIDTHS = 4  # rounds in which the filter's width is fitted to the length of what it leaves
_RELAXED = 6  # rounds in which what was held back at the tube's wall is smoothed again

_Floats = NDArray[np.float64]


class Path(NamedTuple):
    """A polygonal path, and where its points lie along the stroke that it stands for.

    Attributes
    ----------
    points : ndarray of float64, shape (k, 2)
    places : ndarray of float64, shape (k,)
        Ascending, in rows of the stroke; less than a period from first to last.
    period : float
        Rows of the stroke, by which places grow on the way around; 0 where the path is open.
    """

    points: _Floats
    places: _Floats
    period: float = 0.0

    @property
    def ring(self) -> _Floats:
        """The points; of a closed path, the first once more at the end."""
        return np.concatenate([self.points, self.points[:1]]) if self.period else self.points

    @property
    def ring_places(self) -> _Floats:
        """The places of the points of the ring."""
        return np.append(self.places, self.places[0] + self.period) if self.period else self.places

    @property
    def steps(self) -> _Floats:
        """Lengths of the edges."""
        return np.hypot(*np.diff(self.ring, axis=0).T)

    @property
    def length(self) -> float:
        """Length of the path."""
        return float(self.steps.sum())

    def lifted(self, places: ArrayLike) -> _Floats:
        """Add periods to places until they lie within one period from the first.

        Parameters
        ----------
        places : array_like of float

        Returns
        -------
        ndarray of float64
        """
        t = np.asarray(places, dtype=np.float64)
        return self.places[0] + (t - self.places[0]) % self.period if self.period else t

    def at(self, places: ArrayLike) -> _Floats:
        """Return the points at some places.

        Parameters
        ----------
        places : array_like of float, shape (m,)

        Returns
        -------
        ndarray of float64, shape (m, 2)
        """
        t, ring = self.lifted(places), self.ring
        return np.stack([np.interp(t, self.ring_places, ring[:, c]) for c in (0, 1)], axis=-1)

    def evenly(self, m: int) -> "Path":
        """Take points, evenly by arc length.

        Parameters
        ----------
        m : int
            How many; the first is the path's first, and the last that of an open path its last.

        Returns
        -------
        Path
        """
        along = np.append(0.0, np.cumsum(self.steps))
        wanted = np.linspace(0, along[-1], m, endpoint=not self.period)
        ring = self.ring
        points = np.stack([np.interp(wanted, along, ring[:, c]) for c in (0, 1)], axis=-1)
        return Path(points, np.interp(wanted, along, self.ring_places), self.period)

    def between(self, first: float, last: float) -> NDArray[np.bool_]:
        """Tell which points lie from one place on to another, both included.

        Parameters
        ----------
        first, last : float

        Returns
        -------
        ndarray of bool
        """
        a, b = self.lifted([first, last])
        if a > b:
            return (self.places >= a) | (self.places <= b)
        return (self.places >= a) & (self.places <= b)

    def without(self, first: float, last: float) -> "Path":
        """Leave out what lies between two places, and join them by an edge.

        Parameters
        ----------
        first, last : float
            Places; what lies from the first on to the last goes.

        Returns
        -------
        Path
        """
        (a, b), (start, end) = self.lifted([first, last]), self.at([first, last])
        if a > b:  # the piece contains the first point
            kept = (self.places > b) & (self.places < a)
            pieces = [[b], self.places[kept], [a]], [[end], self.points[kept], [start]]
        else:
            before, after = self.places < a, self.places > b
            joint = [[a, b], [start, end]]
            pieces = (
                [self.places[before], joint[0], self.places[after]],
                [self.points[before], joint[1], self.points[after]],
            )
        return Path(np.concatenate(pieces[1]), np.concatenate(pieces[0]), self.period)


def smoothed(path: Path, radius: float) -> Path:
    """Make a path smooth without moving any point of it by more than a radius.

    Parameters
    ----------
    path : Path
    radius : float
        More than 0.

    Returns
    -------
    Path
        Its points lie evenly along the given one, each within the radius of the given one's point at its place.

    Notes
    -----
    A Gaussian filter along the path, about as wide as the radius.  A trembling stroke is longer than it looks, so the
    width is measured along what the filter leaves.  What left the tube is put back to its wall, and smoothed again.
    """
    wanted = math.ceil(min(_FINENESS * path.length / radius, _MOST))
    m = max(wanted, _FEWEST, min(len(path.points), _MOST))
    base = path.evenly(m)
    mode, x, width = "wrap" if path.period else "nearest", base.points, 0.0
    for _ in range(_WIDTHS):
        width = min(radius * m / max(base._replace(points=x).length, radius), m / 16)
        x = gaussian_filter1d(base.points, width, axis=0, mode=mode)
    for _ in range(_RELAXED):
        x = gaussian_filter1d(_held(x, base.points, radius), width / 2, axis=0, mode=mode)
    return base._replace(points=_held(x, base.points, radius))


def _held(x: _Floats, base: _Floats, radius: float) -> _Floats:
    """Put points outside the tube back to its wall."""
    shift = x - base
    far = np.hypot(*shift.T)
    return base + shift * (radius / np.maximum(far, radius))[:, None]

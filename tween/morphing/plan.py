"""What a morph is made of, in plain arrays: all that a stranger needs to make one anew, or to check its bounds."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Plan(NamedTuple):
    """One leg of a morph: a stretch of time in which its triangles stay the same.

    Attributes
    ----------
    start, stop : float
        Times of the morph.
    first, last : float
        The leg's own time at both; backwards where first > last.
    leg_time : callable
        From times of the morph, shape (k,), to the leg's own.
    source, target : ndarray of float64, shape (n, 2)
        The shapes at the leg's times 0 and 1.
    corners : ndarray of int64, shape (n-2, 3)
        Triangles a, b, c over their bases ab, each after the one that it hangs on.
    path : str
        How the third vertices move, see `tween.morph`.
    low, high : ndarray of float64, shape (n-2, 3)
        Limits of the angles at a, b and c at the leg's times 0 and 1, linear between them; infinite for none.
    """

    start: float
    stop: float
    first: float
    last: float
    leg_time: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    source: NDArray[np.float64]
    target: NDArray[np.float64]
    corners: NDArray[np.int64]
    path: str
    low: NDArray[np.float64]
    high: NDArray[np.float64]

    def timed(
        self,
        start: float,
        stop: float,
        inner: Callable[[NDArray[np.float64]], NDArray[np.float64]],
        part: tuple[float, float] | None = None,
    ) -> "Plan":
        """The same leg in the time of what plays it.

        Parameters
        ----------
        start, stop : float
        inner : callable
            From the new times, shape (k,), to the times that the plan has now.
        part : (float, float), optional
            The leg's own time at start and stop, where that changes.

        Returns
        -------
        Plan
        """
        own = self.leg_time
        first, last = part or (self.first, self.last)
        return self._replace(start=start, stop=stop, first=first, last=last, leg_time=lambda t: own(inner(t)))

    def backwards(self) -> "Plan":
        """The same for the morph run from its target to its source.

        Returns
        -------
        Plan
        """
        return self.timed(1.0 - self.stop, 1.0 - self.start, lambda t: 1.0 - t, (self.last, self.first))

    def renumbered(self, shift: int) -> "Plan":
        """The same with vertex i called i + shift.

        Parameters
        ----------
        shift : int

        Returns
        -------
        Plan
        """
        source, target = (np.roll(points, shift, axis=0) for points in (self.source, self.target))
        return self._replace(source=source, target=target, corners=(self.corners + shift) % len(source))

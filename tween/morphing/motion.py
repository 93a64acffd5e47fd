"""What every motion can do, straight or through flips, placed or not: the protocol that a morph runs."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.incompatible.flow import Event
from tween.morphing.plan import Plan


class Motion(Protocol):
    """What a `.Morph` runs.

    Attributes
    ----------
    stages : list of (float, ndarray)
        The triangles in force, and from when on.
    events : list of Event
        The flips, in order of time.
    """

    stages: list[tuple[float, NDArray[np.int64]]]
    events: list[Event]

    def first_doubt(self, placing: Placing) -> Doubt | tuple[float, float]:
        """Prove that all shapes are valid in doubles, or tell where that fails; called for a guarantee only.

        Parameters
        ----------
        placing : Placing
            What may be done to the shapes afterwards.

        Returns
        -------
        Doubt, or (float, float)
            The first one; or the times up to which the first shape, and from which on the last, is to be shown.
        """

    def plans(self) -> list[Plan]:
        """Tell what the motion is made of, in order of time.

        Returns
        -------
        list of Plan
        """

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shapes at many times.

        Parameters
        ----------
        t : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
        """

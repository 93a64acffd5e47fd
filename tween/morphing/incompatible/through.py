"""Motion between two shapes by way of the flow of one of them (Section 6.2, Figure 10).

`Through` joins a leg from one shape and the flow of the other to a motion between the two:

    S1 ---- leg under T1 ----> S2(v) <---- flow of S2 towards its disk, T2 to T1 ---- S2

Where two pieces meet, the shape is one array, at which both lists of triangles are valid; times within 1e-12 of a flip
get that very array.
"""

from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from tween.choices import Pace, Path
from tween.geometry.triangulation import Triangulation
from tween.morphing.compatible.guarantee.angle_budgets import RESERVE
from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.compatible.leg import Leg, left_below_full_turn, root_triangle
from tween.morphing.incompatible.clock import Clock
from tween.morphing.incompatible.flow import Event, Flow, Piece
from tween.morphing.plan import Plan
from tween.triangulating.compatibility import match_rows


class Through:
    """The motion from one shape to another by way of the other's flow (Figure 10).

    It leads straight to the end of the flow, under the first shape's triangles, and back along the
    flow to the other shape.

    Parameters
    ----------
    T : Triangulation
        The first shape; the flow ends with its triangles.
    flow : Flow
        Of the other shape.
    path : str
    root : "disk-center", "tree-center" or int
        Of the way to the end of the flow.
    guarantee : bool
        Whether angle budgets keep every shape on that way the boundary of an immersed disk.
    pace : {"auto", "speed", "time"}
        "time": half of the time for the leg, half for the flow, each by its own clock.  Otherwise at every moment the
        vertices move equally fast, see `clock`.

    Attributes
    ----------
    stages : list of (float, ndarray)
        The triangles in force and from when on; a flip hands two rows on to two rows.
    events : list of Event
    """

    def __init__(
        self,
        T: Triangulation,
        flow: Flow,
        path: Path,
        root: str | int,
        guarantee: bool = False,
        pace: Pace = "auto",
    ) -> None:
        end = T.moved(flow.final.points)
        spare = np.minimum(0.5 * left_below_full_turn(end), flow.reserve(flow.end))
        reserve = np.stack([RESERVE * left_below_full_turn(T), spare])
        straight = Leg(T, end.points, path, root_triangle(root, T, end), guarantee, reserve)
        self._pieces = [Piece(straight, 0.0, 1.0), *(piece.reversed() for piece in reversed(flow.pieces))]
        own = np.concatenate([[0.5], 0.5 * np.diff(flow.times())[::-1] / flow.end]) if flow.pieces else np.ones(1)
        self._clock = Clock([piece.at for piece in self._pieces], own if pace == "time" else None)
        starts = self._clock.starts
        rows = match_rows(flow.final.triangles, T.triangles)
        self.stages = [(0.0, T.triangles)]
        for start, piece in zip(starts[1:], self._pieces[1:], strict=False):
            self.stages.append((start, piece.leg.source.triangles[rows]))
        self.stages.append((1.0, flow.start.triangles[rows]))
        self.events = [Event(starts[-1 - stage], e.into, e.out) for e, stage in reversed(flow.events_by_stage())]

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the shapes at many times.

        Parameters
        ----------
        t : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
            Within 1e-12 of a flip the shape of the flip, which both lists of triangles cover.
        """
        number, share = self._clock.places(t)
        shapes = np.empty((len(t), *self._pieces[0].leg.target.shape))
        for i in np.unique(number):
            here = number == i
            shapes[here] = self._pieces[i].at(share[here])
        return shapes

    def first_doubt(self, placing: Placing) -> Doubt | tuple[float, float]:
        """Prove that all shapes are valid in doubles, or tell where that fails.

        Parameters
        ----------
        placing : Placing

        Returns
        -------
        Doubt, or (float, float)
            In this motion's time.
        """
        last, snaps = len(self._pieces) - 1, [0.0, 1.0]
        for i, (leg, start, stop) in enumerate(self._pieces):
            found = leg.first_doubt(placing, max(start, stop), (i in (0, last), i == last == 0))
            when = [self._clock.time(i, (x - start) / (stop - start)) for x in found[:2]]
            if isinstance(found, Doubt):
                return found._replace(start=min(when), stop=max(when))
            if i == 0:
                snaps[0] = when[0]
            elif i == last:
                snaps[1] = when[0]
            if i == last == 0:
                snaps[1] = when[1]
        return snaps[0], snaps[1]

    def plans(self) -> list[Plan]:
        """Tell what the motion is made of, piece by piece.

        Returns
        -------
        list of Plan
        """
        spans = enumerate(pairwise(self._clock.starts))
        return [
            piece.leg.plan().timed(start, stop, partial(self._leg_time, i), (piece.start, piece.stop))
            for (i, (start, stop)), piece in zip(spans, self._pieces, strict=True)
        ]

    def _leg_time(self, i: int, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """The time of a piece's leg at times at which that piece runs."""
        number, share = self._clock.places(t)
        _, start, stop = self._pieces[i]
        return np.asarray(start + np.where(number == i, share, np.where(number < i, 0.0, 1.0)) * (stop - start))

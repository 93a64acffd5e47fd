"""The motion that a morph's choices ask for: straight where the triangles are the same, through flips where not."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.choices import Order, Pace, Path, Placement, Root
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import Alignment
from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.incompatible.clock import LEAP, Clock, largest_leap
from tween.morphing.incompatible.flip_sequence import FlipSequence, flip_sequence
from tween.morphing.incompatible.flow import Event, Flow, shared_edge
from tween.morphing.incompatible.through import Through
from tween.morphing.morph import Morph
from tween.morphing.motion import Motion
from tween.morphing.placement import Steady
from tween.morphing.plan import Plan
from tween.triangulating.compatibility import match_rows
from tween.triangulating.flips import flip_in_place

_ROUNDS = 3  # of distributing time anew, where a motion would leap
_BY_ANGLES = "every angle changes linearly, so the sum at a vertex stays between those of the two ends"
_BY_BUDGETS = "proved in doubles: no triangle turns over, and the angles at every vertex add up to less than 2 pi"


class Choices(NamedTuple):
    """How a morph moves.

    Attributes
    ----------
    path, guarantee, placement, root, order, pace
        As for `morph` and `paper_morph`.
    exchanged : bool
        Whether the caller wants it from the target to the source.
    """

    path: Path
    guarantee: bool
    placement: Placement
    root: Root
    order: Order = "sequential"
    pace: Pace = "auto"
    exchanged: bool = False

    @property
    def proof(self) -> str:
        """Why every shape bounds an immersed disk, see `.compatible.guarantee`; a flip changes no sum of angles."""
        if self.path == "angle" and not self.guarantee:
            return _BY_ANGLES
        return _BY_BUDGETS if self.guarantee else ""


class _Compatible:
    """One leg, no flips, as a `Motion`."""

    def __init__(self, leg: Leg) -> None:
        self._leg = leg
        self.stages = [(0.0, leg.source.triangles)]
        self.events: list[Event] = []

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._leg.at(t)

    def first_doubt(self, placing: Placing) -> Doubt | tuple[float, float]:
        return self._leg.first_doubt(placing)

    def plans(self) -> list[Plan]:
        return [self._leg.plan()]


class _Paced:
    """A `Motion` without flips, run by a clock."""

    def __init__(self, motion: Motion, clock: Clock) -> None:
        self._motion, self._clock = motion, clock
        self.stages, self.events = motion.stages, motion.events

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._motion.at(self._clock.places(t)[1])

    def first_doubt(self, placing: Placing) -> Doubt | tuple[float, float]:
        found = self._motion.first_doubt(placing)
        first, last = self._clock.time(0, found[0]), self._clock.time(0, found[1])
        return found._replace(start=first, stop=last) if isinstance(found, Doubt) else (first, last)

    def plans(self) -> list[Plan]:
        return [plan.timed(0.0, 1.0, lambda t: self._clock.places(t)[1]) for plan in self._motion.plans()]


def between(alignment: Alignment, choices: Choices) -> Morph:
    """Move between two shapes whose correspondence is known.

    Parameters
    ----------
    alignment : Alignment
        From the shape that comes first to the other.
    choices : Choices

    Returns
    -------
    Morph
        In the caller's numbers.

    Raises
    ------
    GuaranteeError
        Where a guarantee was asked for and cannot be given; in the caller's numbers, too.
    """
    m = _moved(alignment, choices)
    m = m.reversed() if choices.exchanged else m
    return m.guaranteed() if choices.guarantee else m


def _moved(alignment: Alignment, choices: Choices) -> Morph:
    """Move straight where the triangles are the same, and through flips where they are not."""
    if alignment.crossings > 0:
        return _gradual(alignment, choices)
    motion: Motion = _Compatible(_straight(alignment, choices))
    if choices.pace == "speed":
        motion = _Paced(motion, Clock([motion.at]))
    placed = _placed(motion, choices)
    rounds = _ROUNDS if choices.guarantee and choices.pace == "auto" else 0
    while rounds and largest_leap(placed.at, (0.0, 1.0))[1] > 0.5 * LEAP:
        motion, rounds = _Paced(motion, Clock([placed.at], close=True)), rounds - 1
        placed = _placed(motion, choices)  # anew, as the turns of what leapt are known only now
    return Morph(placed, alignment, proof=choices.proof)


def _placed(motion: Motion, choices: Choices) -> Motion:
    return motion if choices.placement == "root" else Steady(motion, keeps_size=choices.path == "area")


def _straight(alignment: Alignment, choices: Choices) -> Leg:
    first = alignment.source
    second = first.moved(alignment.target.points)
    root = choices.root
    if not isinstance(root, str) and choices.exchanged:
        root = _row(root_triangle(root, alignment.target), alignment.target.triangles, first.triangles)
    return Leg(first, second.points, choices.path, root_triangle(root, first, second), choices.guarantee)


def _gradual(alignment: Alignment, choices: Choices) -> Morph:
    """Run both flows, and pass through the end of the one that is done with its flips first."""
    path, order, guarantee = choices.path, choices.order, choices.guarantee
    shapes = alignment.source, alignment.target
    sequences = flip_sequence(*shapes), flip_sequence(*shapes[::-1])
    roots = _flow_roots(shapes, sequences, choices)
    flows = [Flow(shapes[i], sequences[i], path, roots[i], order, guarantee) for i in (0, 1)]
    through = 1 if flows[1].end <= flows[0].end else 0
    motion = Through(shapes[1 - through], flows[through], path, roots[1 - through], guarantee, choices.pace)
    return Morph(
        _placed(motion, choices), alignment, (flows[0].end, flows[1].end), choices.proof, backwards=through == 0
    )


def _flow_roots(
    shapes: tuple[Triangulation, Triangulation], sequences: tuple[FlipSequence, FlipSequence], choices: Choices
) -> list[Root]:
    """The root of each flow; a triangle given by number is followed through the flips to the other shape."""
    if isinstance(choices.root, str):
        return [choices.root, choices.root]
    here = int(choices.exchanged)
    row = root_triangle(choices.root, shapes[here])
    there = _row(row, _after(shapes[here], sequences[here]), shapes[1 - here].triangles)
    return [there, row] if choices.exchanged else [row, there]


def _row(row: int, triangles: NDArray[np.int64], others: NDArray[np.int64]) -> int:
    """Where a row of triangles stands among the same triangles in another order."""
    if triangles is others:
        return row
    return int(np.flatnonzero(match_rows(triangles, others) == row)[0])


def _after(T: Triangulation, flips: FlipSequence) -> NDArray[np.int64]:
    """The triangles after the flips, the pairs in their rows."""
    triangles, twin = T.triangles.copy(), T.twin.copy()
    for t, u in flips.rows.tolist():
        flip_in_place(triangles, twin, shared_edge(twin, t, u))
    return triangles

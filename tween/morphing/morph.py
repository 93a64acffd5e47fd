"""What a morph is, once it is found: shapes at times, the triangles in force, the flips on the way."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from tween.errors import GuaranteeError, MotionError
from tween.geometry.predicates import EXACT_RANGE
from tween.morphing.alignment import Alignment
from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.incompatible.clock import CLOSE, LEAP, largest_leap
from tween.morphing.incompatible.flow import Event
from tween.morphing.motion import Motion
from tween.morphing.plan import Plan
from tween.triangulating.compatibility import match_rows

if TYPE_CHECKING:
    from tween.measuring.playback import Playback

_AT_ONCE = 2**21  # vertices times frames that are laid out at once


class Morph:
    """A morph between two shapes; made by `tween.morph`.

    Calling it with a time, 0 to 1, gives the shape at that time.

    Attributes
    ----------
    source, target : Triangulation
        What it leads from and to; vertex i of one moves to vertex i of the other.
    source_vertices, target_vertices : ndarray of int, shape (n,)
        Which vertex of the input each vertex is; -1 where it was inserted.
    alignment : Alignment
        How the two were matched.
    events : list of Event
        The flips on the way, in order of time; none between compatible triangulations.
    proof : str
        Why every shape bounds an immersed disk, where that is so by construction; otherwise empty.
    u, v : float or None
        When the flow of the source, and that of the target, has done its last flip; None without flips.
    """

    def __init__(
        self,
        motion: Motion,
        alignment: Alignment,
        flows: tuple[float, float] | None = None,
        proof: str = "",
        backwards: bool = False,
        shift: int = 0,
    ) -> None:
        self.proof = proof
        self.alignment = alignment
        self.source, self.target = alignment.source, alignment.target
        self.source_vertices, self.target_vertices = alignment.source_vertices, alignment.target_vertices
        self.u: float | None = flows[0] if flows else None
        self.v: float | None = flows[1] if flows else None
        self._motion, self._backwards, self._shift = motion, backwards, shift
        self._snaps = 0.0, 1.0
        self._stages = self._own_stages()
        self.events = [self._own_event(e) for e in (reversed(motion.events) if backwards else motion.events)]

    def __call__(self, t: float) -> NDArray[np.float64]:
        """Return the shape at one time.

        Parameters
        ----------
        t : float
            From 0, the source, to 1, the target.

        Returns
        -------
        ndarray of float64, shape (n, 2)
        """
        return self.at([t])[0]

    def at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the shapes at many times at once.

        Parameters
        ----------
        times : array_like of float, shape (k,)
            From 0 to 1, in any order.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
            At times 0 and 1 exactly the source and the target.

        Raises
        ------
        ValueError
            Where a time is not between 0 and 1.
        MotionError
            Where a shape leaves the range in which signs are exact, see `EXACT_RANGE` of the predicates.

        Notes
        -----
        O(n k).
        """
        t = np.asarray(times, dtype=np.float64)
        if t.ndim != 1 or not ((t >= 0) & (t <= 1)).all():
            raise ValueError(f"times are {times!r}, expected a list of numbers from 0 to 1")
        t = np.where(t <= self._snaps[0], 0.0, np.where(t >= self._snaps[1], 1.0, t))
        shapes = self._motion.at(1 - t if self._backwards else t)
        if self._shift:
            shapes = np.roll(shapes, self._shift, axis=1)
        shapes[t == 0] = self.source.points  # whatever rounding the motion, or a baseline, leaves there
        shapes[t == 1] = self.target.points
        for f, v in _out_of_range(shapes):
            raise MotionError(
                f"the shape at t = {t[f]:.6g} cannot be written down: vertex {v} would be at "
                f"{tuple(shapes[f, v].tolist())}, expected coordinates of at most {EXACT_RANGE[1]:.0e} in magnitude"
            )
        return shapes

    def frames(self, k: int, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
        """Return k shapes, evenly spaced in time, both ends included.

        Parameters
        ----------
        k : int
            At least 2.
        out : ndarray of float64, shape (k, n, 2), optional
            Where to write to, such as a memory map for what does not fit into memory.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)

        Notes
        -----
        O(n k), by blocks of frames, so that beside the result little memory is needed.
        """
        shapes = np.empty((self._count(k), len(self.source), 2)) if out is None else out
        first = 0
        for block in self._blocks(k):
            shapes[first : first + len(block)] = block
            first += len(block)
        return shapes

    def each_frame(self, k: int) -> Iterator[NDArray[np.float64]]:
        """Yield the shapes of `frames` one after the other.

        Parameters
        ----------
        k : int
            At least 2.

        Yields
        ------
        ndarray of float64, shape (n, 2)
        """
        for block in self._blocks(k):
            yield from block

    def _count(self, k: int) -> int:
        if k < 2:
            raise ValueError(f"{k} frames were asked for, expected at least 2: the source and the target")
        return k

    def _blocks(self, k: int) -> Iterator[NDArray[np.float64]]:
        times = np.linspace(0.0, 1.0, self._count(k))
        block = max(1, _AT_ONCE // len(self.source))
        for first in range(0, k, block):
            yield self.at(times[first : first + block])

    def reversed(self) -> "Morph":
        """Run the same morph from its target to its source.

        Returns
        -------
        Morph
            In the numbers that the target had before the two were matched.
        """
        turned = Morph(
            self._motion,
            self.alignment.exchanged(),
            None if self.u is None or self.v is None else (self.v, self.u),
            self.proof,
            not self._backwards,
            (self._shift + self.alignment.shift) % len(self.source),
        )
        turned._snaps = 1.0 - self._snaps[1], 1.0 - self._snaps[0]
        return turned

    def guaranteed(self) -> "Morph":
        """Prove that every array that `at` returns bounds an immersed disk, see `.guarantee`, and that none leaps.

        Returns
        -------
        Morph
            Itself.  Very close to ends that are only just valid it shows the ends themselves from now on.

        Raises
        ------
        GuaranteeError
            Where that cannot be proved: when, at which vertex or triangle, and why; and where a vertex moves by more
            than 0.001 of the width within 1e-7 of an end or a flip.
        """
        ends = self.source, self.target
        for T in ends:  # shapes between are proved, those at 0 and 1 are as they were given
            T.validate()
        areas = [float(T.areas.sum()) for T in ends]
        offset = max(float(np.abs(T.points).max()) for T in ends)
        found = self._motion.first_doubt(Placing(offset, min(areas), max(areas)))
        if isinstance(found, Doubt):
            raise GuaranteeError(self._in_words(found))
        self._snaps = (1.0 - found[1], 1.0 - found[0]) if self._backwards else found
        mark, leap = largest_leap(self.at, (0.0, *(event.time for event in self.events), 1.0))
        if leap > LEAP:
            raise GuaranteeError(
                f"no guarantee close to t = {_moment(mark)}: within {CLOSE:.0e} a vertex moves by {leap:.1g} of the "
                "width, which people would see as a jump; another path or strategy may do without"
            )
        return self

    def plans(self) -> list[Plan]:
        """Tell what the morph is made of: all that a stranger needs to check its promise anew, see `tween.certify`.

        Returns
        -------
        list of Plan
            In order of time, in this morph's times and vertices.
        """
        plans = self._motion.plans()
        if self._backwards:
            plans = [plan.backwards() for plan in reversed(plans)]
        low, high = self._snaps
        return [
            plan.renumbered(self._shift).timed(
                plan.start, plan.stop, lambda t: np.where(t <= low, 0.0, np.where(t >= high, 1.0, t))
            )
            for plan in plans
        ]

    def _in_words(self, doubt: Doubt) -> str:
        """Say what is in doubt in this morph's times and vertices."""
        start, stop = (1.0 - doubt.stop, 1.0 - doubt.start) if self._backwards else (doubt.start, doubt.stop)
        own = tuple((v + self._shift) % len(self.source) for v in doubt.vertices)
        when = f"no guarantee from t = {_moment(start)} to {_moment(stop)}"
        left, needed = max(doubt.left, 0.0), doubt.needed
        if doubt.rule == "vertex":
            return f"{when}: vertex {own[0]} has {left:.1g} left below 2 pi, of which rounding may need {needed:.1g}"
        if doubt.rule == "triangle":
            return f"{when}: triangle {own} is {left:.1g} high, of which rounding may need {needed:.1g}"
        return f"{when}: vertex {own[0]} may leave the range of coordinates in which signs are exact"

    def playback(self, tolerance: float = 1e-3, most: int = 1000) -> "Playback":
        """Return frames, straight motion between which stays close to this morph and is verified at every instant.

        Parameters
        ----------
        tolerance : float
            As a fraction of the width of the shape.
        most : int
            Frames.

        Returns
        -------
        Playback

        Raises
        ------
        TweenError
            Where there are none, see `tween.playback`.
        """
        from tween.measuring.playback import playback  # here, as what measures morphs stands above them

        return playback(self, tolerance, most)

    def triangles_at(self, t: float) -> NDArray[np.int64]:
        """Return the triangles in force at a time.

        Parameters
        ----------
        t : float

        Returns
        -------
        ndarray of int, shape (n-2, 3)
            The two triangles of a flip keep their rows.  From the time of a flip on these are the new
            ones, but at 0 always the source's.
        """
        return self._stages[self.stage_at(np.array([t]))[0]][1]

    def stage_at(self, times: NDArray[np.float64]) -> NDArray[np.intp]:
        """Tell between which flips times lie: equal numbers, equal triangles.

        Parameters
        ----------
        times : ndarray of float64, shape (k,)

        Returns
        -------
        ndarray of int, shape (k,)
        """
        starts = np.array([start for start, _ in self._stages])
        stages = np.searchsorted(starts, times, side="right") - 1
        return np.where(times == 0, 0, stages)

    def _own_stages(self) -> list[tuple[float, NDArray[np.int64]]]:
        """The motion's stages in this morph's time, vertices and rows."""
        stages = [(s, (triangles + self._shift) % len(self.source)) for s, triangles in self._motion.stages]
        if self._backwards:
            starts = [0.0, *(1 - s for s, _ in reversed(stages[1:]))]
            stages = [(s, triangles) for s, (_, triangles) in zip(starts, reversed(stages), strict=True)]
        if len(stages) == 1 and np.array_equal(stages[0][1], self.source.triangles):
            return stages
        rows = match_rows(stages[0][1], self.source.triangles)
        return [(s, triangles[rows]) for s, triangles in stages]

    def _own_event(self, event: Event) -> Event:
        time, out, into = event
        if self._backwards:
            time, out, into = 1 - time, into, out
        n, shift = len(self.source), self._shift
        own = [((a + shift) % n, (b + shift) % n) for a, b in (out, into)]
        return Event(time, (min(own[0]), max(own[0])), (min(own[1]), max(own[1])))

    def __repr__(self) -> str:
        return f"Morph({len(self.source)} vertices, {len(self.events)} flips)"


def _moment(t: float) -> str:
    """Write a time so that one very close to 1 can be told from 1."""
    return f"{t:.6g}" if t in (0.0, 1.0) or t < 0.999 else f"1 - {1.0 - t:.4g}"


@njit(cache=True)
def _out_of_range(shapes):
    """Round what is too small for exact signs to 0, and list (shape, vertex) of the first one that is too large."""
    k, n, _ = shapes.shape
    for f in range(k):
        for v in range(n):
            for s in range(2):
                size = abs(shapes[f, v, s])
                if size < EXACT_RANGE[0]:
                    shapes[f, v, s] = 0.0
                elif not size <= EXACT_RANGE[1]:
                    return [(f, v)]
    return [(f, f) for f in range(0)]

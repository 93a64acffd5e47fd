"""Morphs between any two immersed disks: one call, from curves or triangulations to moving shapes.

Everything is computed from the one of the two shapes whose points come first in the order of bytes to
the other, and turned around where the caller wants it the other way: so a morph is symmetric, however
ties are broken on the way.
"""

from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.align import Alignment, common, equal_counts, least_distorted, match, pivot_shift
from tween.compatible import Leg, root_triangle
from tween.curve import Curve, as_curve
from tween.decomposition import decompose
from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.flips import flip_in_place
from tween.gradual import Event, Flow, Order, Through
from tween.paths import PATHS, Path
from tween.sequence import FlipSequence, flip_sequence
from tween.triangulation import Triangulation, compatible_shift, match_rows

Root = Literal["disk-center", "tree-center"] | int
Strategy = Literal["auto", "paper", "common"]


class Motion(Protocol):
    """What a `Morph` runs.

    Attributes
    ----------
    stages : list of (float, ndarray)
        The triangles in force, and from when on.
    events : list of Event
        The flips, in order of time.
    """

    stages: list[tuple[float, NDArray[np.int64]]]
    events: list[Event]

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


class Morph:
    """A morph between two shapes; made by `morph`.

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
    u, v : float or None
        When the flow of the source, and that of the target, has done its last flip; None without flips.
    """

    def __init__(
        self,
        motion: Motion,
        alignment: Alignment,
        backwards: bool,
        shift: int,
        flows: tuple[float, float] | None = None,
    ) -> None:
        self.alignment = alignment
        self.source, self.target = alignment.source, alignment.target
        self.source_vertices, self.target_vertices = alignment.source_vertices, alignment.target_vertices
        self.u: float | None = flows[0] if flows else None
        self.v: float | None = flows[1] if flows else None
        self._motion, self._backwards, self._shift = motion, backwards, shift
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

        Notes
        -----
        O(n k).
        """
        t = np.asarray(times, dtype=np.float64)
        if t.ndim != 1 or not ((t >= 0) & (t <= 1)).all():
            raise ValueError(f"times are {times!r}, expected a list of numbers from 0 to 1")
        shapes = np.roll(self._motion.at(1 - t if self._backwards else t), self._shift, axis=1)
        shapes[t == 0] = self.source.points
        shapes[t == 1] = self.target.points
        return shapes

    def frames(self, k: int) -> NDArray[np.float64]:
        """Return k shapes, evenly spaced in time, both ends included.

        Parameters
        ----------
        k : int
            At least 2.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
        """
        return self.at(np.linspace(0.0, 1.0, k))

    def triangles_at(self, t: float) -> NDArray[np.int64]:
        """Return the triangles in force at a time.

        Parameters
        ----------
        t : float

        Returns
        -------
        ndarray of int, shape (n-2, 3)
            The two triangles of a flip keep their rows.
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
        return np.searchsorted(starts, times, side="right") - 1

    def _own_stages(self) -> list[tuple[float, NDArray[np.int64]]]:
        """The motion's stages in this morph's time, vertices and rows."""
        stages = [(s, (triangles + self._shift) % len(self.source)) for s, triangles in self._motion.stages]
        if self._backwards:
            starts = [0.0, *(1 - s for s, _ in reversed(stages[1:]))]
            stages = [(s, triangles) for s, (_, triangles) in zip(starts, reversed(stages), strict=True)]
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


class _Compatible:
    """One leg, no flips, as a `Motion`."""

    def __init__(self, leg: Leg) -> None:
        self._leg = leg
        self.stages = [(0.0, leg.source.triangles)]
        self.events: list[Event] = []

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._leg.at(t)


def morph(
    source: Triangulation | Curve | ArrayLike,
    target: Triangulation | Curve | ArrayLike,
    path: Path = "slide",
    root: Root = "disk-center",
    strategy: Strategy = "auto",
    order: Order = "partial",
) -> Morph:
    """Morph one immersed disk into another.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        Where they have different numbers of vertices, vertices are inserted on the one with fewer, see
        `align`.  A curve stands for its constrained Delaunay triangulation.
    path : {"slide", "linear"}
        How third vertices move, see `tween.paths`.
    root : {"disk-center", "tree-center"} or int
        Where the motion spreads from: the triangle closest to the centre of the disk (the paper's
        choice), the centre of the dual tree, or a triangle of the source by number.
    strategy : {"auto", "paper", "common"}
        "paper": if no renumbering makes the two triangulations compatible, match pivots and flip
        gradually (Section 6).  "common": retriangulate both curves with a triangulation that is valid in
        both, the least distorting one, under the pivots' correspondence or, if there is none, under
        any; no flips.  "auto": for curves "common" where that is possible, otherwise "paper";
        triangulations that were given are kept ("paper").
    order : {"partial", "sequential"}
        Whether flips that do not depend on each other wait for each other, see `tween.gradual`.

    Returns
    -------
    Morph

    Raises
    ------
    CurveError
        Where the input is no curve.
    NotSelfOverlappingError
        Where a curve bounds no immersed disk; the message says which of the two, and why.
    IncompatibleError
        Where `strategy` is "common" and there is no common triangulation.

    Notes
    -----
    Every triangle in force stays counter-clockwise at all times.  That alone does not make every shape
    the boundary of an immersed disk: angles around a vertex may add up to more than 2 pi on the way.

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> m = morph(T, T.on_disk())
    >>> m.frames(5).shape, bool((m(0) == T.points).all())
    ((5, 4, 2), True)

    References
    ----------
    Mukherjee and Gopi, Sections 5 and 6.
    """
    _check_options(path, strategy, order)
    _check_disks(source, target)
    swapped = _key(source) > _key(target)
    first, second = (target, source) if swapped else (source, target)
    alignment = _align_for(strategy, first, second)
    own = alignment.exchanged() if swapped else alignment
    shift = alignment.shift if swapped else 0
    if alignment.crossings == 0:
        leg = _straight(alignment, own, shift, path, root)
        return Morph(_Compatible(leg), own, swapped, shift)
    return _gradual_morph(alignment, own, swapped, shift, path, root, order)


def _check_options(path: str, strategy: str, order: str) -> None:
    for name, value, allowed in (
        ("path", path, PATHS),
        ("strategy", strategy, ("auto", "paper", "common")),
        ("order", order, ("partial", "sequential")),
    ):
        if value not in allowed:
            raise ValueError(f"{name} is {value!r}, expected one of {', '.join(allowed)}")


def _check_disks(source: Any, target: Any) -> None:
    """Name the one of the two that bounds no disk, and why."""
    for name, shape in (("source", source), ("target", target)):
        if not isinstance(shape, Triangulation):
            answer = decompose(shape)
            if not answer:
                raise NotSelfOverlappingError(f"the {name} bounds no immersed disk: {answer.reason}")


def _key(shape: Any) -> tuple[int, bytes]:
    points = as_curve(shape).points
    return len(points), points.astype(">f8").tobytes()


def _align_for(strategy: Strategy, source: Any, target: Any) -> Alignment:
    keep = isinstance(source, Triangulation) or isinstance(target, Triangulation)
    first, second, *origins = equal_counts(source, target)
    if strategy == "common" or (strategy == "auto" and not keep):
        found = _align_commonly(first, second, origins)
        if found is not None:
            return found
        if strategy == "common":
            raise IncompatibleError(
                "strategy 'common' is impossible: the curves have no common triangulation under any of the "
                f"{len(first)} renumberings; strategy='paper' flips on the way"
            )
    shift = compatible_shift(first, second)
    if shift is not None:
        return match(first, second, shift, None, *origins)
    return match(first, second, *pivot_shift(first, second), *origins)


def _align_commonly(first: Triangulation, second: Triangulation, origins: list[NDArray[np.int64]]) -> Alignment | None:
    """With a common triangulation, under the pivots' correspondence or else the least distorting one."""
    n = len(first)
    shift, at_pivots = pivot_shift(first, second)
    shared, pivot = common(first, second.rolled(shift)), None
    if shared is not None:
        pivot = at_pivots
    else:
        found = least_distorted(first, second)
        if found is None:
            return None
        shift, shared = found
    return match(shared, Triangulation(second.points, (shared.triangles + shift) % n), shift, pivot, *origins)


def _straight(alignment: Alignment, own: Alignment, shift: int, path: Path, root: Root) -> Leg:
    first = alignment.source
    second = Triangulation(alignment.target.points, first.triangles)
    row = _row(root, own.source, shift, first.triangles)
    return Leg(first, second.points, path, root_triangle(row, first, second))


def _row(root: Root, source: Triangulation, shift: int, triangles: NDArray[np.int64]) -> Root:
    """A root given by its number in the source, by its row in the same triangles numbered otherwise."""
    if isinstance(root, str):
        return root
    row = root_triangle(root, source)
    wanted = (source.triangles - shift) % len(source)
    return int(np.flatnonzero(match_rows(wanted, triangles) == row)[0])


def _gradual_morph(
    alignment: Alignment, own: Alignment, swapped: bool, shift: int, path: Path, root: Root, order: Order
) -> Morph:
    """Run both flows, and take the way through the one that is done with its flips first."""
    shapes = alignment.source, alignment.target
    sequences = flip_sequence(*shapes), flip_sequence(*shapes[::-1])
    roots = [root, root]
    if not isinstance(root, str):
        mine, other = (1, 0) if swapped else (0, 1)
        roots[mine] = root_triangle(root, own.source)
        flipped = _after(shapes[mine], sequences[mine])
        roots[other] = int(np.flatnonzero(match_rows(flipped, shapes[other].triangles) == roots[mine])[0])
    flows = [Flow(shapes[i], sequences[i], path, roots[i], order) for i in (0, 1)]
    by = 1 if flows[1].end <= flows[0].end else 0
    motion = Through(shapes[1 - by], flows[by], path, roots[1 - by])
    u, v = (flow.end for flow in (reversed(flows) if swapped else flows))
    return Morph(motion, own, swapped != (by == 0), shift, (u, v))


def _after(T: Triangulation, flips: FlipSequence) -> NDArray[np.int64]:
    """The triangles after the flips, the pairs in their rows."""
    triangles, twin = T.triangles.copy(), T.twin.copy()
    for t, u in flips.rows.tolist():
        flip_in_place(triangles, twin, 3 * t + int(np.flatnonzero(twin[t] // 3 == u)[0]))
    return triangles

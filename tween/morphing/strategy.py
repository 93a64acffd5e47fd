"""Morphs between any two immersed disks: one call, from curves or triangulations to moving shapes.

`morph` is the best morph there is; `paper_morph` is the paper's, as printed.  A shape is validated and triangulated
once, at the door.

`morph` computes everything from the one of the two that comes first (`.shape_order`) to the other, and reverses that
where the caller wants it the other way: so it is symmetric to the last bit, however ties are broken inside.
`paper_morph` does not.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.choices import (
    ORDERS,
    PACES,
    PATHS,
    PLACEMENTS,
    STRATEGIES,
    Order,
    Pace,
    Path,
    Placement,
    Root,
    Shifts,
    Strategy,
)
from tween.errors import GuaranteeError, IncompatibleError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import (
    Alignment,
    check_shifts,
    common,
    equal_counts,
    least_distorted,
    renumbered,
)
from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.incompatible.clock import LEAP, Clock, largest_leap
from tween.morphing.incompatible.flip_sequence import FlipSequence, count_crossings, crossings_by_shift, flip_sequence
from tween.morphing.incompatible.flow import Event, Flow, shared_edge
from tween.morphing.incompatible.pivots import pivot_shift
from tween.morphing.incompatible.through import Through
from tween.morphing.matching.match import Match, match
from tween.morphing.morph import Morph, Motion
from tween.morphing.placement import Steady
from tween.morphing.shape_order import comes_later
from tween.triangulating.compatibility import compatible_shift, match_rows
from tween.triangulating.flips import flip_in_place

Shape = Triangulation | Curve | ArrayLike

# Where no match is complete, what "auto" takes upon itself in search of a common triangulation, some seconds each.
_MOST_RENUMBERED = 200  # vertices, for a joint table of every renumbering
_MOST_PAIRS = 2**17  # in one joint table

_ROUNDS = 3  # of distributing time anew, where a motion would leap

_BY_ANGLES = "every angle changes linearly, so the sum at a vertex stays between those of the two ends"
_BY_BUDGETS = "proved in doubles: no triangle turns over, and the angles at every vertex add up to less than 2 pi"


class _Choices(NamedTuple):
    """How a morph moves; `exchanged` says that the caller wants it from the target to the source."""

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


def morph(
    source: Shape,
    target: Shape,
    path: Path = "metric",
    guarantee: bool = True,
    strategy: Strategy = "auto",
    placement: Placement = "steady",
    root: Root = "disk-center",
    landmarks: Sequence[tuple[int, int]] | None = None,
    pace: Pace = "auto",
) -> Morph:
    """Morph one immersed disk into another.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        Vertices are inserted on edges where the match asks for it.  A triangulation says which immersed disk is meant,
        where its curve bounds several; a curve leaves that open.
    path : {"metric", "slide", "linear", "angle", "area"}
        How third vertices move, see `.paths`; slide and linear are the paper's.
    guarantee : bool
        Whether every shape on the way is to bound an immersed disk, see `.compatible.guarantee`.  Without it only the
        path "angle" sees to that, where there are no flips.
    strategy : {"auto", "matched", "common", "paper"}
        "matched": the best correspondence and the best common triangulation together, see `match`; in the rare case
        that there is none of all vertices, flips do the rest.  "common": pivots matched, or else any renumbering, and
        the least distorting triangulation that is then valid in both.  "paper": pivots matched, remeshed
        triangulations, flips (Section 6).  "auto": two triangulations that are compatible keep their triangles;
        otherwise "matched" where that needs no flips, or else "common" where that is possible, or else "paper"; with
        `guarantee` the first of these for which it can be given.
    placement : {"steady", "root"}
        How large and where each shape is: by `.placement`, so that area and centre change linearly and nothing
        turns without need; or by the root triangle, as in the paper.
    root : {"disk-center", "tree-center"} or int
        Where the motion spreads from: the triangle closest to the centre of the disk (the paper's choice), the centre
        of the dual tree, or a triangle of the morph's source by number.
    landmarks : sequence of (int, int), optional
        Vertices of the source and of the target that have to correspond; for "matched".
    pace : {"auto", "time", "speed"}
        "time" is the motion's own clock, in which third vertices run along their paths and a flow approaches its disk;
        through flips half of it is for the way to the end of a flow, and half for that flow.  At "speed" the root mean
        square of the vertices' speeds is constant, before `placement`, which has the last word.  "auto": time where
        there are no flips, speed where there are, since after a flip a triangle may open in no time.

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
        Where `strategy` is "common" and there is no common triangulation; where landmarks allow no match.
    GuaranteeError
        Where the guarantee cannot be given: when, at which vertex or triangle, and why.

    Notes
    -----
    A morph without flips runs in the time of its path; but with `guarantee`, where a triangle that is nearly flat at an
    end would open in no time, at an even pace instead, as one with flips always does.

    Every triangle in force stays counter-clockwise at all times.  That alone does not make every shape
    the boundary of an immersed disk, as the paper has it: angles around a vertex may add up to more than
    2 pi on the way.  With `guarantee` they do not.

    Examples
    --------
    >>> m = morph([[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]], [[0, 0], [3, 0], [3, 2], [0, 2]])
    >>> len(m.source), m.source_vertices.tolist(), m.events
    (6, [0, 1, 2, 3, 4, 5], [])

    References
    ----------
    Mukherjee and Gopi, Sections 5 and 6; Section 8 leaves the matching open.
    """
    _check_words(
        path=(path, PATHS), strategy=(strategy, STRATEGIES), placement=(placement, PLACEMENTS), pace=(pace, PACES)
    )
    if landmarks is not None and strategy not in ("auto", "matched"):
        raise ValueError(f"landmarks are for the strategy 'matched', but strategy is {strategy!r}")
    choices = _Choices(path, guarantee, placement, root, pace=pace)
    if landmarks is None and strategy == "auto" and _are_compatible(source, target):
        strategy = "paper"
    if strategy in ("auto", "matched"):
        found = match(source, target, landmarks)
        if strategy == "matched" or landmarks is not None:
            return _in_order(_from_match(found), choices)
    if strategy == "auto":
        return _first_guaranteed(source, target, found, choices)
    return _unmatched(strategy, source, target, choices)


def paper_morph(
    source: Shape,
    target: Shape,
    path: Path = "slide",
    root: Root = "disk-center",
    *,
    order: Order = "sequential",
    shifts: Shifts = "pivots",
    pace: Pace = "auto",
) -> Morph:
    """Morph one immersed disk into another as the paper does: Sections 5 and 6 as printed.

    Curves are triangulated by Algorithm 1.  Where the two triangulations are compatible under some renumbering, that is
    the correspondence; otherwise pivots are matched and edges flipped in sequence, as soon as the moving shape allows.
    The root triangle places the shapes, and nothing keeps angle sums below 2 pi.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        Vertices are inserted on the one with fewer, see `align`.
    path : {"slide", "linear", ...}
        The first two are the paper's.
    root : {"disk-center", "tree-center"} or int
        The first is the paper's.
    order : {"sequential", "partial"}
        Whether each flip waits for the one before it, as in the paper, or only for those that touch its triangles.
    shifts : {"pivots", "all"} or int
        Which vertices correspond where the triangulations are incompatible: by pivots, as in the paper; of all
        renumberings the one with fewest crossings; or vertex i of the source and vertex (i + shifts) mod n of the
        target, inserted vertices counted.
    pace : {"auto", "time", "speed"}
        As for `morph`; the paper does not say.

    Returns
    -------
    Morph

    Raises
    ------
    CurveError
        Where the input is no curve.
    NotSelfOverlappingError
        Where a curve bounds no immersed disk; the message says which of the two, and why.

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> m = paper_morph(T, T.on_disk())
    >>> m.frames(5).shape, bool((m(0) == T.points).all())
    ((5, 4, 2), True)

    References
    ----------
    Mukherjee and Gopi, Sections 5 and 6.
    """
    _check_words(path=(path, PATHS), order=(order, ORDERS), pace=(pace, PACES))
    check_shifts(shifts)
    first, second, *origins = equal_counts(source, target)
    alignment = renumbered(first, second, *_flipping_shift(first, second, shifts), *origins)
    return _between(alignment, _Choices(path, False, "root", root, order, pace))


def morph_compatible(
    source: Triangulation,
    target: Triangulation,
    path: Path = "metric",
    guarantee: bool = True,
    placement: Placement = "steady",
    root: Root = "disk-center",
    pace: Pace = "auto",
) -> Morph:
    """Morph between two triangulations with the same triangles, vertex i to vertex i.

    Parameters
    ----------
    source, target : Triangulation
        With the same triangles, in any order.
    path, guarantee, placement, root, pace
        As for `morph`.

    Returns
    -------
    Morph

    Raises
    ------
    IncompatibleError
        Where some triangle of one is no triangle of the other.

    Notes
    -----
    What `morph` gives for these triangulations, without the search for a correspondence.  O(n log n).

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> morph_compatible(T, T.moved(2 * T.points)).frames(3)[1].round(3).tolist()
    [[-0.041, -0.041], [1.541, -0.041], [1.541, 1.541], [-0.041, 1.541]]

    References
    ----------
    Mukherjee and Gopi, Section 5.
    """
    _check_words(path=(path, PATHS), placement=(placement, PLACEMENTS), pace=(pace, PACES))
    if source.triangles is not target.triangles and not np.array_equal(source.canonical, target.canonical):
        raise IncompatibleError("the two triangulations have different triangles; tween.morph takes any two shapes")
    every = np.arange(len(source))
    choices = _Choices(path, guarantee, placement, root, pace=pace)
    return _in_order(Alignment(source, target, 0, every, every, None, 0), choices)


def morph_as_numbered(
    source: Triangulation,
    target: Triangulation,
    path: Path = "metric",
    guarantee: bool = True,
    placement: Placement = "steady",
    root: Root = "disk-center",
    pace: Pace = "auto",
) -> Morph:
    """Morph between two triangulations vertex i to vertex i, by flips where their triangles differ.

    Parameters
    ----------
    source, target : Triangulation
        With equally many vertices.
    path, guarantee, placement, root, pace
        As for `morph`.

    Returns
    -------
    Morph

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> len(morph_as_numbered(T, Triangulation(T.points, [[0, 1, 3], [1, 2, 3]])).events)
    1
    """
    if source.triangles is target.triangles or np.array_equal(source.canonical, target.canonical):
        return morph_compatible(source, target, path, guarantee, placement, root, pace)
    _check_words(path=(path, PATHS), placement=(placement, PLACEMENTS), pace=(pace, PACES))
    every, crossings = np.arange(len(source)), count_crossings(source, target)
    alignment = Alignment(source, target, 0, every, every, None, crossings)
    return _in_order(alignment, _Choices(path, guarantee, placement, root, pace=pace))


def _check_words(**given: tuple[str, Sequence[str]]) -> None:
    for name, (value, allowed) in given.items():
        if value not in allowed:
            raise ValueError(f"{name} is {value!r}, expected one of {', '.join(allowed)}")


def _in_order(alignment: Alignment, choices: _Choices) -> Morph:
    """Compute a morph from the one of the two shapes that comes first."""
    source, target, *origins = alignment.source, alignment.target, alignment.source_vertices, alignment.target_vertices
    if comes_later(source, origins[0], target, origins[1]):
        return _between(alignment.exchanged(), choices._replace(exchanged=True))
    return _between(alignment, choices)


# Correspondence


def _first_guaranteed(source: Shape, target: Shape, found: Match, choices: _Choices) -> Morph:
    """What "auto" gives: the first strategy that is possible, and whose guarantee can be given.

    Where none can, the first refusal is told: that of the morph which people would want most.
    """
    attempts: list[Callable[[], Morph]] = [lambda: _in_order(_from_match(found), choices)] if found.complete else []
    attempts += [partial(_unmatched, strategy, source, target, choices) for strategy in ("auto", "paper")]
    refusals = []
    for attempt in attempts:
        try:
            return attempt()
        except GuaranteeError as error:
            refusals.append(error)
    raise refusals[0]


def _unmatched(strategy: Strategy, source: Shape, target: Shape, choices: _Choices) -> Morph:
    """Morph without a match, from the one of the two shapes that comes first."""
    first, second, *origins = equal_counts(source, target)
    if comes_later(first, origins[0], second, origins[1]):
        return _between(_aligned(strategy, second, first, origins[::-1]), choices._replace(exchanged=True))
    return _between(_aligned(strategy, first, second, origins), choices)


def _aligned(
    strategy: Strategy, first: Triangulation, second: Triangulation, origins: list[NDArray[np.int64]]
) -> Alignment:
    """Bring two triangulations together without a match: by a common triangulation, or as the paper does."""
    if strategy != "paper":
        found = _common_shift(first, second, everywhere=strategy == "common")
        if found is not None:
            shift, shared, pivot = found
            same = Triangulation(second.points, (shared.triangles + shift) % len(first))
            return renumbered(shared, same, shift, pivot, *origins)
        if strategy == "common":
            raise IncompatibleError(
                "strategy 'common' is impossible: the curves have no common triangulation under any of the "
                f"{len(first)} renumberings; strategy='matched' inserts vertices, and strategy='paper' flips on the way"
            )
    return renumbered(first, second, *_flipping_shift(first, second, "pivots"), *origins)


def _common_shift(
    first: Triangulation, second: Triangulation, everywhere: bool
) -> tuple[int, Triangulation, int | None] | None:
    """The (shift, triangulation, pivot) of a common triangulation, None where none was found.

    Unless it is to be looked for everywhere, where that takes long it is not.
    """
    shift, pivot = pivot_shift(first, second)
    shared = common(first, second.rolled(shift), None if everywhere else _MOST_PAIRS)
    if shared is not None:
        return shift, shared, pivot
    found = least_distorted(first, second) if everywhere or len(first) <= _MOST_RENUMBERED else None
    return (*found, None) if found is not None else None


def _are_compatible(source: Shape, target: Shape) -> bool:
    """Whether both are triangulations, and the same but for a renumbering."""
    if not (isinstance(source, Triangulation) and isinstance(target, Triangulation) and len(source) == len(target)):
        return False
    return compatible_shift(source, target) is not None


def _from_match(found: Match) -> Alignment:
    crossings = 0 if found.complete else count_crossings(found.source, found.target)
    return Alignment(found.source, found.target, 0, found.source_vertices, found.target_vertices, None, crossings)


def _flipping_shift(first: Triangulation, second: Triangulation, shifts: Shifts) -> tuple[int, int | None]:
    """The (shift, pivot) under which two triangulations are to be flipped into each other."""
    if isinstance(shifts, int):
        return shifts % len(first), None
    compatible = compatible_shift(first, second)
    if compatible is not None:
        return compatible, None
    if shifts == "pivots":
        return pivot_shift(first, second)
    return int(np.argmin(crossings_by_shift(first, second, np.arange(len(first))))), None


# Motion


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


def _between(alignment: Alignment, choices: _Choices) -> Morph:
    """The morph; in the caller's numbers already where a guarantee cannot be given, and that is said."""
    m = _moved(alignment, choices)
    m = m.reversed() if choices.exchanged else m
    return m.guaranteed() if choices.guarantee else m


def _moved(alignment: Alignment, choices: _Choices) -> Morph:
    """Move straight where the triangles are the same, and through flips where they are not."""
    if alignment.crossings > 0:
        return _gradual(alignment, choices)
    motion: Motion = _Compatible(_straight(alignment, choices))
    if choices.pace == "speed":
        motion = _Paced(motion, Clock([motion.at]))
    placed = _placed(motion, choices)
    rounds = _ROUNDS if choices.guarantee else 0
    while rounds and largest_leap(placed.at, (0.0, 1.0))[1] > 0.5 * LEAP:
        motion, rounds = _Paced(motion, Clock([placed.at], close=True)), rounds - 1
        placed = _placed(motion, choices)  # anew, as the turns of what leapt are known only now
    return Morph(placed, alignment, proof=choices.proof)


def _placed(motion: Motion, choices: _Choices) -> Motion:
    return motion if choices.placement == "root" else Steady(motion, keeps_size=choices.path == "area")


def _straight(alignment: Alignment, choices: _Choices) -> Leg:
    first = alignment.source
    second = first.moved(alignment.target.points)
    root = choices.root
    if not isinstance(root, str) and choices.exchanged:
        root = _row(root_triangle(root, alignment.target), alignment.target.triangles, first.triangles)
    return Leg(first, second.points, choices.path, root_triangle(root, first, second), choices.guarantee)


def _gradual(alignment: Alignment, choices: _Choices) -> Morph:
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
    shapes: tuple[Triangulation, Triangulation], sequences: tuple[FlipSequence, FlipSequence], choices: _Choices
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
    return int(np.flatnonzero(match_rows(triangles, others) == row)[0])


def _after(T: Triangulation, flips: FlipSequence) -> NDArray[np.int64]:
    """The triangles after the flips, the pairs in their rows."""
    triangles, twin = T.triangles.copy(), T.twin.copy()
    for t, u in flips.rows.tolist():
        flip_in_place(triangles, twin, shared_edge(twin, t, u))
    return triangles

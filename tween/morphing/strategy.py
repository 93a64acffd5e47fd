"""Morphs between any two immersed disks: one call, from curves or triangulations to moving shapes.

Both shapes are validated and triangulated once, at the door.  Then everything is computed from the one that comes
first (`shape_order`) to the other, and reversed where the caller wants it the other way: so a morph is symmetric, however
ties are broken inside.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.choices import ORDERS, PATHS, STRATEGIES, Order, Path, Root, Shifts, Strategy
from tween.errors import IncompatibleError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import (
    Alignment,
    check_shifts,
    common,
    equal_counts,
    least_distorted,
    match,
)
from tween.morphing.compatible.layout_errors import Doubt, Placing
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.incompatible.flip_sequence import FlipSequence, crossings_by_shift, flip_sequence
from tween.morphing.incompatible.flow import Event, Flow, Through, shared_edge
from tween.morphing.incompatible.pivots import pivot_shift
from tween.morphing.morph import Morph
from tween.morphing.shape_order import comes_later
from tween.triangulating.compatibility import compatible_shift, match_rows
from tween.triangulating.flips import flip_in_place

# What "auto" takes upon itself in search of a common triangulation, some seconds each.
_MOST_RENUMBERED = 200  # vertices, for a joint table of every renumbering
_MOST_PAIRS = 2**17  # in one joint table

_BY_ANGLES = "every angle changes linearly, so the sum at a vertex stays between those of the two ends"
_BY_BUDGETS = "proved in doubles: no triangle turns over, and the angles at every vertex add up to less than 2 pi"


class _Choices(NamedTuple):
    """How a morph moves; `exchanged` says that the caller wants it from the target to the source."""

    path: Path
    root: Root
    guarantee: bool
    order: Order = "partial"
    exchanged: bool = False

    @property
    def proof(self) -> str:
        """Why every shape bounds an immersed disk, see `.angle_budgets`; a flip changes no sum of angles."""
        if self.path == "angle" and not self.guarantee:
            return _BY_ANGLES
        return _BY_BUDGETS if self.guarantee else ""


def morph(
    source: Triangulation | Curve | ArrayLike,
    target: Triangulation | Curve | ArrayLike,
    path: Path = "slide",
    root: Root = "disk-center",
    guarantee: bool = False,
    strategy: Strategy = "auto",
    order: Order = "partial",
    shifts: Shifts = "pivots",
) -> Morph:
    """Morph one immersed disk into another.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        Where they have different numbers of vertices, vertices are inserted on the one with fewer, see
        `align`.  A curve stands for its constrained Delaunay triangulation.
    path : {"slide", "linear", "angle", "area", "metric"}
        How third vertices move, see `.paths`; the first two are the paper's.
    root : {"disk-center", "tree-center"} or int
        Where the motion spreads from: the triangle closest to the centre of the disk (the paper's
        choice), the centre of the dual tree, or a triangle of the source by number.
    guarantee : bool
        Whether angle budgets keep the shapes on the way boundaries of immersed disks, see `.angle_budgets`.
        Without it only the path "angle" does, where there are no flips.
    strategy : {"auto", "paper", "common"}
        "paper": if no renumbering makes the two triangulations compatible, match pivots and flip
        gradually (Section 6).  "common": retriangulate both curves with a triangulation that is valid in
        both, the least distorting one, under the pivots' correspondence or, if there is none, under
        any; no flips.  "auto": for curves "common" where that is possible, otherwise "paper"; above 200
        vertices only the pivots' correspondence is tried, above 500 only where the joint table stays small.
        Triangulations that were given are kept ("paper").
    order : {"partial", "sequential"}
        Whether flips that do not depend on each other wait for each other, see `.flow`.
    shifts : {"pivots", "all"} or int
        Which vertices correspond.  "pivots": as above.  "all": of all renumberings the one whose common
        triangulation distorts least, or, where triangulations are flipped, that with fewest crossings.
        A number k: vertex i of the source and vertex (i + k) mod n of the target, inserted vertices counted.

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
    the boundary of an immersed disk, as the paper has it: angles around a vertex may add up to more than
    2 pi on the way.  With `guarantee` they do not; it costs a few times the plain path.

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
    _check_options(path, strategy, order, shifts)
    first, second, *origins = equal_counts(source, target)
    given = isinstance(source, Triangulation) or isinstance(target, Triangulation)
    choices = _Choices(path, root, guarantee, order)
    if comes_later(first, origins[0], second, origins[1]):
        turned = shifts if isinstance(shifts, str) else -int(shifts)
        alignment = _aligned(strategy, second, first, origins[::-1], turned, given)
        return _between(alignment, choices._replace(exchanged=True))
    return _between(_aligned(strategy, first, second, origins, shifts, given), choices)


def morph_compatible(
    source: Triangulation,
    target: Triangulation,
    path: Path = "slide",
    root: Root = "disk-center",
    guarantee: bool = False,
) -> Morph:
    """Morph between two triangulations with the same triangles, vertex i to vertex i.

    Parameters
    ----------
    source, target : Triangulation
        With the same triangles, in any order.
    path, root, guarantee
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
    >>> morph_compatible(T, T.moved(2 * T.points))(0.5)[2].tolist()
    [1.5, 1.5]

    References
    ----------
    Mukherjee and Gopi, Section 5.
    """
    _check_options(path)
    if source.triangles is not target.triangles and not np.array_equal(source.canonical, target.canonical):
        raise IncompatibleError("the two triangulations have different triangles; tween.morph finds a way between them")
    every = np.arange(len(source))
    choices = _Choices(path, root, guarantee)
    if comes_later(source, every, target, every):
        return _between(Alignment(target, source, 0, every, every, None, 0), choices._replace(exchanged=True))
    return _between(Alignment(source, target, 0, every, every, None, 0), choices)


def _check_options(path: str, strategy: str = "auto", order: str = "partial", shifts: Shifts = "pivots") -> None:
    check_shifts(shifts)
    for name, value, allowed in (
        ("path", path, PATHS),
        ("strategy", strategy, STRATEGIES),
        ("order", order, ORDERS),
    ):
        if value not in allowed:
            raise ValueError(f"{name} is {value!r}, expected one of {', '.join(allowed)}")


# Correspondence


def _aligned(
    strategy: Strategy,
    first: Triangulation,
    second: Triangulation,
    origins: list[NDArray[np.int64]],
    shifts: Shifts,
    given: bool,
) -> Alignment:
    """Match two triangulations; where they were given, not made from curves, "auto" keeps them."""
    if strategy == "common" or (strategy == "auto" and not given):
        found = _common_shift(first, second, shifts, everywhere=strategy == "common")
        if found is not None:
            shift, shared, pivot = found
            same = Triangulation(second.points, (shared.triangles + shift) % len(first))
            return match(shared, same, shift, pivot, *origins)
        if strategy == "common":
            tried = "the renumbering asked for" if isinstance(shifts, int) else f"any of the {len(first)} renumberings"
            raise IncompatibleError(
                f"strategy 'common' is impossible: the curves have no common triangulation under {tried}; "
                "strategy='paper' flips on the way"
            )
    return match(first, second, *_flipping_shift(first, second, shifts), *origins)


def _common_shift(
    first: Triangulation, second: Triangulation, shifts: Shifts, everywhere: bool
) -> tuple[int, Triangulation, int | None] | None:
    """The (shift, triangulation, pivot) of a common triangulation, None where none was found.

    Unless it is to be looked for everywhere, where that takes long it is not.
    """
    if shifts != "all":
        shift, pivot = pivot_shift(first, second) if shifts == "pivots" else (shifts % len(first), None)
        shared = common(first, second.rolled(shift), None if everywhere else _MOST_PAIRS)
        if shared is not None:
            return shift, shared, pivot
        if shifts != "pivots" or not (everywhere or len(first) <= _MOST_RENUMBERED):
            return None
    found = least_distorted(first, second)
    return (*found, None) if found is not None else None


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


def _between(alignment: Alignment, choices: _Choices) -> Morph:
    """The morph; in the caller's numbers already where a guarantee cannot be given, and that is said."""
    m = _moved(alignment, choices)
    m = m.reversed() if choices.exchanged else m
    return m.guaranteed() if choices.guarantee else m


def _moved(alignment: Alignment, choices: _Choices) -> Morph:
    """Move straight where the triangles are the same, and through flips where they are not."""
    if alignment.crossings == 0:
        return Morph(_Compatible(_straight(alignment, choices)), alignment, proof=choices.proof)
    return _gradual(alignment, choices)


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
    motion = Through(shapes[1 - through], flows[through], path, roots[1 - through], guarantee)
    return Morph(motion, alignment, (flows[0].end, flows[1].end), choices.proof, backwards=through == 0)


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

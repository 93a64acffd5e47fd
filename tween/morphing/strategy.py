"""Morphs between any two immersed disks: one call, from curves or triangulations to moving shapes.

Everything is computed from the one of the two shapes whose points come first in the order of bytes to
the other, and turned around where the caller wants it the other way: so a morph is symmetric, however
ties are broken on the way.
"""

from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import Alignment, Shifts, check_shifts, common, equal_counts, least_distorted, match
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.compatible.paths import PATHS, Path
from tween.morphing.incompatible.flip_sequence import FlipSequence, crossings_by_shift, flip_sequence
from tween.morphing.incompatible.flow import Event, Flow, Order, Through, shared_edge
from tween.morphing.incompatible.pivots import pivot_shift
from tween.morphing.morph import Morph
from tween.triangulating.compatibility import compatible_shift, match_rows
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import flip_in_place

Root = Literal["disk-center", "tree-center"] | int
Strategy = Literal["auto", "paper", "common"]

# What "auto" takes upon itself in search of a common triangulation, some seconds each.
_MOST_RENUMBERED = 200  # vertices, for a joint table of every renumbering
_MOST_PAIRS = 2**17  # in one joint table

_BY_ANGLES = "every angle changes linearly, so the sum at a vertex stays between those of the two ends"
_BY_BUDGETS = "by their budgets or by proved bounds, the angles at every vertex add up to less than 2 pi"


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
        How third vertices move, see `paths`; the first two are the paper's.
    root : {"disk-center", "tree-center"} or int
        Where the motion spreads from: the triangle closest to the centre of the disk (the paper's
        choice), the centre of the dual tree, or a triangle of the source by number.
    guarantee : bool
        Whether angle budgets keep the shapes on the way boundaries of immersed disks, see `angle_budgets`.
        Without it only the path "angle" does, where there are no flips.
    strategy : {"auto", "paper", "common"}
        "paper": if no renumbering makes the two triangulations compatible, match pivots and flip
        gradually (Section 6).  "common": retriangulate both curves with a triangulation that is valid in
        both, the least distorting one, under the pivots' correspondence or, if there is none, under
        any; no flips.  "auto": for curves "common" where that is possible, otherwise "paper"; above 200
        vertices only the pivots' correspondence is tried, above 500 only where the joint table stays small.
        Triangulations that were given are kept ("paper").
    order : {"partial", "sequential"}
        Whether flips that do not depend on each other wait for each other, see `flow`.
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
    _check_disks(source, target)
    swapped = _key(source) > _key(target)
    first, second = (target, source) if swapped else (source, target)
    turned = shifts if isinstance(shifts, str) else int(-shifts if swapped else shifts)
    alignment = _align_for(strategy, first, second, turned)
    own = alignment.exchanged() if swapped else alignment
    shift = alignment.shift if swapped else 0
    if alignment.crossings == 0:
        leg = _straight(alignment, own, shift, path, root, guarantee)
        return Morph(_Compatible(leg), own, swapped, shift, proof=_proof(path, guarantee))
    return _gradual_morph(alignment, own, swapped, shift, path, root, order, guarantee)


def _check_options(path: str, strategy: str, order: str, shifts: Shifts) -> None:
    check_shifts(shifts)
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


def _key(shape: Any) -> tuple[int, bytes, bytes]:
    points = as_curve(shape).points
    triangles = shape.canonical.tobytes() if isinstance(shape, Triangulation) else b""
    return len(points), points.astype("<f8").tobytes(), triangles


def _align_for(strategy: Strategy, source: Any, target: Any, shifts: Shifts) -> Alignment:
    keep = isinstance(source, Triangulation) or isinstance(target, Triangulation)
    first, second, *origins = equal_counts(source, target)
    if strategy == "common" or (strategy == "auto" and not keep):
        found = _align_commonly(first, second, shifts, everywhere=strategy == "common")
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


def _align_commonly(
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


def _straight(alignment: Alignment, own: Alignment, shift: int, path: Path, root: Root, guarantee: bool) -> Leg:
    first = alignment.source
    second = first.moved(alignment.target.points)
    row = _row(root, own.source, shift, first.triangles)
    return Leg(first, second.points, path, root_triangle(row, first, second), guarantee)


def _row(root: Root, source: Triangulation, shift: int, triangles: NDArray[np.int64]) -> Root:
    """A root given by its number in the source, by its row in the same triangles numbered otherwise."""
    if isinstance(root, str):
        return root
    row = root_triangle(root, source)
    wanted = (source.triangles - shift) % len(source)
    return int(np.flatnonzero(match_rows(wanted, triangles) == row)[0])


def _gradual_morph(
    alignment: Alignment,
    own: Alignment,
    swapped: bool,
    shift: int,
    path: Path,
    root: Root,
    order: Order,
    guarantee: bool,
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
    flows = [Flow(shapes[i], sequences[i], path, roots[i], order, guarantee) for i in (0, 1)]
    by = 1 if flows[1].end <= flows[0].end else 0
    motion = Through(shapes[1 - by], flows[by], path, roots[1 - by], guarantee)
    u, v = (flow.end for flow in (reversed(flows) if swapped else flows))
    return Morph(motion, own, swapped != (by == 0), shift, (u, v), _proof(path, guarantee))


def _proof(path: Path, guarantee: bool) -> str:
    """Why every shape bounds an immersed disk, see `angle_budgets`; a flip changes no sum of angles."""
    if path == "angle":
        return _BY_ANGLES
    return _BY_BUDGETS if guarantee and path != "area" else ""


def _after(T: Triangulation, flips: FlipSequence) -> NDArray[np.int64]:
    """The triangles after the flips, the pairs in their rows."""
    triangles, twin = T.triangles.copy(), T.twin.copy()
    for t, u in flips.rows.tolist():
        flip_in_place(triangles, twin, shared_edge(twin, t, u))
    return triangles

"""Morphs between any two immersed disks: one call, from curves or triangulations to moving shapes.

`morph` is the best morph there is; `paper_morph` is the paper's, as printed.  A shape is validated and triangulated
once, at the door.

`morph` computes everything from the one of the two that comes first (`.shape_order`) to the other, and reverses that
where the caller wants it the other way: so it is symmetric to the last bit, however ties are broken inside.
`paper_morph` does not.
"""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

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
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import Alignment, equal_counts
from tween.morphing.correspondence import Shape, aligned, are_compatible, from_match, paper_alignment
from tween.morphing.incompatible.flip_sequence import count_crossings
from tween.morphing.matching.match import Match, match
from tween.morphing.morph import Morph
from tween.morphing.motions import Choices, between
from tween.morphing.shape_order import comes_later


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
    choices = Choices(path, guarantee, placement, root, pace=pace)
    if landmarks is None and strategy == "auto" and are_compatible(source, target):
        strategy = "paper"
    if strategy in ("auto", "matched"):
        found = match(source, target, landmarks)
        if strategy == "matched" or landmarks is not None:
            return _in_order(from_match(found), choices)
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
    return between(paper_alignment(source, target, shifts), Choices(path, False, "root", root, order, pace))


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
    choices = Choices(path, guarantee, placement, root, pace=pace)
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
    return _in_order(alignment, Choices(path, guarantee, placement, root, pace=pace))


def _check_words(**given: tuple[str, Sequence[str]]) -> None:
    for name, (value, allowed) in given.items():
        if value not in allowed:
            raise ValueError(f"{name} is {value!r}, expected one of {', '.join(allowed)}")


def _in_order(alignment: Alignment, choices: Choices) -> Morph:
    """Compute a morph from the one of the two shapes that comes first."""
    source, target, *origins = alignment.source, alignment.target, alignment.source_vertices, alignment.target_vertices
    if comes_later(source, origins[0], target, origins[1]):
        return between(alignment.exchanged(), choices._replace(exchanged=True))
    return between(alignment, choices)


def _first_guaranteed(source: Shape, target: Shape, found: Match, choices: Choices) -> Morph:
    """What "auto" gives: the first strategy that is possible, and whose guarantee can be given.

    Where none can, the first refusal is told: that of the morph which people would want most.
    """
    attempts: list[Callable[[], Morph]] = [lambda: _in_order(from_match(found), choices)] if found.complete else []
    attempts += [partial(_unmatched, strategy, source, target, choices) for strategy in ("auto", "paper")]
    refusals = []
    for attempt in attempts:
        try:
            return attempt()
        except GuaranteeError as error:
            refusals.append(error)
    raise refusals[0]


def _unmatched(strategy: Strategy, source: Shape, target: Shape, choices: Choices) -> Morph:
    """Morph without a match, from the one of the two shapes that comes first."""
    alignment, exchanged = without_match(strategy, source, target)
    return between(alignment, choices._replace(exchanged=exchanged))


def without_match(strategy: Strategy, source: Shape, target: Shape) -> tuple[Alignment, bool]:
    """Align two shapes without a match, as `morph` does for the strategies "common" and "paper".

    Parameters
    ----------
    strategy : {"auto", "common", "paper"}
    source, target : Triangulation, Curve or array_like of shape (n, 2)

    Returns
    -------
    alignment : Alignment
        From the one of the two that comes first: `between` may be asked for many morphs along it.
    exchanged : bool
        Whether that is the target.
    """
    first, second, *origins = equal_counts(source, target)
    if comes_later(first, origins[0], second, origins[1]):
        return aligned(strategy, second, first, origins[::-1]), True
    return aligned(strategy, first, second, origins), False

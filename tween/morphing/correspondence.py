"""Which vertex corresponds to which, and the triangulations of both, before anything moves."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.choices import Shifts, Strategy
from tween.errors import IncompatibleError
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
from tween.morphing.incompatible.flip_sequence import count_crossings, crossings_by_shift
from tween.morphing.incompatible.pivots import pivot_shift
from tween.morphing.matching.match import Match
from tween.triangulating.compatibility import compatible_shift

Shape = Triangulation | Curve | ArrayLike

# Where no match is complete, what "auto" takes upon itself in search of a common triangulation, some seconds each.
_MOST_RENUMBERED = 200  # vertices, for a joint table of every renumbering
_MOST_PAIRS = 2**17  # in one joint table


def aligned(
    strategy: Strategy, first: Triangulation, second: Triangulation, origins: list[NDArray[np.int64]]
) -> Alignment:
    """Bring two triangulations together without a match: by a common triangulation, or as the paper does.

    Parameters
    ----------
    strategy : {"auto", "common", "paper"}
        "auto" takes a common triangulation where finding it does not take long.
    first, second : Triangulation
        With equally many vertices.
    origins : list of ndarray of int, shape (n,)
        Which vertex of the input each vertex is; -1 where it was inserted.

    Returns
    -------
    Alignment

    Raises
    ------
    IncompatibleError
        Where the strategy is "common" and there is no common triangulation.
    """
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
    return renumbered(first, second, *flipping_shift(first, second, "pivots"), *origins)


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


def paper_alignment(source: Shape, target: Shape, shifts: Shifts = "pivots") -> Alignment:
    """Bring two shapes together as `paper_morph` does.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
    shifts : {"pivots", "all"} or int
        See `paper_morph`.

    Returns
    -------
    Alignment
        From source to target: `between` may be asked for many morphs along it.
    """
    check_shifts(shifts)
    first, second, *origins = equal_counts(source, target)
    return renumbered(first, second, *flipping_shift(first, second, shifts), *origins)


def are_compatible(source: Shape, target: Shape) -> bool:
    """Whether both are triangulations, and the same but for a renumbering.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)

    Returns
    -------
    bool
    """
    if not (isinstance(source, Triangulation) and isinstance(target, Triangulation) and len(source) == len(target)):
        return False
    return compatible_shift(source, target) is not None


def from_match(found: Match) -> Alignment:
    """Take the vertices and triangles of a match.

    Parameters
    ----------
    found : Match

    Returns
    -------
    Alignment
        With crossings where the match is not complete.  The target's own numbers begin at its vertex 0: ties are broken
        in those of the shape that comes first, whichever is the source.
    """
    crossings = 0 if found.complete else count_crossings(found.source, found.target)
    shift = -int(np.flatnonzero(found.target_vertices == 0)[0]) % len(found.target)
    return Alignment(found.source, found.target, shift, found.source_vertices, found.target_vertices, None, crossings)


def flipping_shift(first: Triangulation, second: Triangulation, shifts: Shifts) -> tuple[int, int | None]:
    """Choose the renumbering under which two triangulations are to be flipped into each other.

    Parameters
    ----------
    first, second : Triangulation
        With equally many vertices.
    shifts : {"pivots", "all"} or int
        See `paper_morph`.

    Returns
    -------
    shift : int
    pivot : int or None
        The vertex of the first that pivots matched; None where they did not decide.
    """
    if isinstance(shifts, int):
        return shifts % len(first), None
    compatible = compatible_shift(first, second)
    if compatible is not None:
        return compatible, None
    if shifts == "pivots":
        return pivot_shift(first, second)
    return int(np.argmin(crossings_by_shift(first, second, np.arange(len(first))))), None

"""What would make a curve bound a disk: cleaning it, or cutting off loops; checked before it is suggested.

Legend: ``p`` points of what is left of a curve after some cuts; a *cut* keeps one loop of the two at a place where the
curve meets itself, see ``loops``.
"""

import heapq
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import count
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError
from tween.geometry.curve import Curve
from tween.geometry.faces import covered_area
from tween.triangulating.decomposition import decompose
from tween.triangulating.repair.cleaning import clean
from tween.triangulating.repair.loops import meetings, split

_SMOOTH = 0.04  # smoothing that is tried, as a share of the size
_NOISY = 200  # crossings beyond which no loops are cut off where cleaning does
_MOST_CUTS = 4
_MOST_CROSSINGS = 2000  # places at which a curve is cut, those of the smallest loops
_TRIES, _WORK = 200, 1_000_000  # curves that are decided at most, and their vertices in all
_SUGGESTED = 3  # ways to cut
_TOO_MUCH = 0.9  # share of the area beyond which a suggestion is worth nothing, unless there is no other

_Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Suggestion:
    """A change after which a curve bounds a disk.

    Attributes
    ----------
    what : {"clean", "cut"}
    text : str
        What to do, as a clause of a sentence.
    where : tuple of tuple of float
        The places (x, y) at which loops are cut off; none for cleaning.
    lost : float
        Area that the change removes, covered areas counted as often as the curve winds about them.
    share : float
        The same as a share of what the curve covers.
    curve : Curve
        The mended curve; it bounds an immersed disk.
    smooth : float
        The smoothing to clean with; 0 for cuts.
    loops : tuple of ndarray of float64, shape (m, 2)
        The loops that are cut off.
    """

    what: str
    text: str
    where: tuple[tuple[float, float], ...]
    lost: float
    share: float
    curve: Curve
    smooth: float = 0.0
    loops: tuple[_Floats, ...] = field(default=(), repr=False)

    def to_dict(self) -> dict[str, Any]:
        """Return the same as numbers, lists and text, for JSON.

        Returns
        -------
        dict
        """
        names = ("what", "text", "lost", "share", "smooth")
        plain = {name: getattr(self, name) for name in names}
        return {**plain, "where": [list(place) for place in self.where], "curve": self.curve.points.tolist()}


class Mending(NamedTuple):
    """Suggestions, and what was looked at for them.

    Attributes
    ----------
    suggestions : tuple of Suggestion
        Cleaning first, then cuts, the least area first.
    tried, possible : int
        Single cuts that were tried, and that there are.
    """

    suggestions: tuple[Suggestion, ...]
    tried: int
    possible: int


def in_words(place: ArrayLike, size: float) -> str:
    """Write a point as far as it matters in a picture.

    Parameters
    ----------
    place : array_like of float, shape (2,)
    size : float
        Of the curve that it belongs to; three more digits are written.

    Returns
    -------
    str

    Examples
    --------
    >>> in_words((1e-17, 0.123456), 2.0)
    '(0, 0.123)'
    """
    digits = 3 - math.floor(math.log10(size)) if size > 0 else 0
    x, y = (round(float(x), digits) + 0.0 for x in np.asarray(place))
    return f"({x:.6g}, {y:.6g})"


def mend(curve: Curve, covered: float) -> Mending:
    """Look for changes after which a curve bounds a disk.

    Parameters
    ----------
    curve : Curve
        One that bounds none.
    covered : float
        Its ``covered_area``.

    Returns
    -------
    Mending

    Notes
    -----
    All single cuts are tried, of either loop at each place where the curve meets itself.  Then up to four cuts are
    combined as long as they lose less than the best single one, the least area first.  At most 200 cuts each,
    and a million vertices in all, are tried.  A curve of more than 200 crossings that cleaning mends is not cut.

    Examples
    --------
    >>> eight = Curve([[0, 0], [2, 2], [2, 0], [0, 1.5]])
    >>> [s.text for s in mend(eight, covered_area(eight.points)).suggestions][0]
    'cut off the loop at (0.857, 0.857)'
    """
    cleaned = _cleaned(curve, covered)
    if cleaned and len(curve.crossings) > _NOISY:
        return Mending((cleaned,), 0, 2 * len(curve.crossings))
    tries = int(np.clip(_WORK // len(curve), 4, _TRIES))
    singles, tried, possible = _singles(curve, covered, tries)
    least = min((found.lost for found in singles), default=math.inf)
    found = [*([cleaned] if cleaned else []), *sorted([*_several(curve, covered, least, tries), *singles], key=_rank)]
    worth = [s for s in found if s.share <= _TOO_MUCH] or found[:1]
    return Mending(tuple(worth[: _SUGGESTED + bool(cleaned)]), tried, possible)


def _rank(suggestion: Suggestion) -> tuple[float, bool]:
    """The least area first; of equals, what need not be turned around."""
    return float(f"{suggestion.lost:.9g}"), suggestion.curve.reversed_input


def _cleaned(curve: Curve, covered: float) -> Suggestion | None:
    """Clean a curve, if that gives a disk."""
    size = 2 * float(shapely.minimum_bounding_radius(shapely.multipoints(curve.points)))
    smooth = float(f"{_SMOOTH * size:.2g}")
    try:
        cleaned = clean(curve, smooth)
    except CurveError:
        return None
    if not cleaned.changes.bounds_disk:
        return None
    lost = abs(covered - covered_area(cleaned.points))
    text = f"smooth it with tween.clean(curve, smooth={smooth:g})"
    return Suggestion("clean", text, (), lost, lost / covered, cleaned, smooth=smooth)


# Cuts


class _Cut(NamedTuple):
    """What is left of a curve after some cuts, and what they took."""

    points: _Floats
    lost: float
    where: tuple[tuple[float, float], ...] = ()
    loops: tuple[_Floats, ...] = ()


class _Next(NamedTuple):
    """A cut that has not been made: at which place, of which loop, at least what it takes in all."""

    least: float
    number: int
    before: _Cut
    pair: tuple[int, int]
    place: _Floats
    inner: bool


def _possible(before: _Cut, numbers: Iterator[int]) -> list[_Next]:
    """List the cuts that may be made, those that take least first; a loop covers at least its signed area."""
    curve = Curve(before.points)
    at = meetings(curve)
    areas = np.abs(at.areas)
    order = np.argsort(areas.min(axis=1), kind="stable")[:_MOST_CROSSINGS]
    cut = before._replace(points=curve.points)
    cuts = [
        _Next(before.lost + areas[m, side], next(numbers), cut, (int(i), int(j)), at.places[m], side == 0)
        for m in order
        for i, j in [at.pairs[m]]
        for side in (0, 1)
    ]
    return sorted(cuts)


def _made(cut: _Next) -> _Cut | None:
    """Make a cut; None where nothing is left."""
    inner, outer = split(cut.before.points, cut.pair, cut.place)
    kept, gone = (outer, inner) if cut.inner else (inner, outer)
    if len(kept) < 3:
        return None
    x, y = cut.place.tolist()
    lost = covered_area(gone) if len(gone) > 2 else 0.0
    return _Cut(kept, cut.before.lost + lost, (*cut.before.where, (x, y)), (*cut.before.loops, gone))


def _bounds(points: _Floats) -> Curve | None:
    """The curve, if it bounds a disk."""
    curve = Curve(points)
    return curve if curve.turning_number == 1 and decompose(curve) else None


def _singles(curve: Curve, covered: float, tries: int) -> tuple[list[Suggestion], int, int]:
    """Try single cuts: half of them those that take least, half those that leave least, which are simple sooner."""
    cuts = _possible(_Cut(curve.points, 0.0), count())
    tried = cuts if len(cuts) <= tries else cuts[: tries // 2] + cuts[: -tries // 2 - 1 : -1]
    made = [made for made in map(_made, tried) if made]
    found = [_suggestion(cut, mended, covered) for cut in made if (mended := _bounds(cut.points))]
    return found, len(tried), len(cuts)


def _several(curve: Curve, covered: float, most: float, tries: int) -> list[Suggestion]:
    """Combine cuts that take less than a given area, the least first, until one combination bounds a disk."""
    numbers = count()
    heap = [cut for cut in _possible(_Cut(curve.points, 0.0), numbers) if cut.least < most]
    seen: set[tuple[int, float]] = set()
    for _ in range(tries):
        if not heap:
            break
        made = _made(heapq.heappop(heap))
        if made is None or made.lost >= most:
            continue
        key = (len(made.points), float(f"{np.abs(made.points).sum():.9g}"))
        if key in seen:
            continue
        seen.add(key)
        mended = _bounds(made.points) if len(made.where) > 1 else None
        if mended:
            return [_suggestion(made, mended, covered)]
        if len(made.where) < _MOST_CUTS:
            for after in _possible(made, numbers):
                if after.least < most:
                    heapq.heappush(heap, after)
    return []


def _suggestion(made: _Cut, mended: Curve, covered: float) -> Suggestion:
    places = [in_words(place, float(np.ptp(mended.points, axis=0).max())) for place in made.where]
    loops = (
        f"the loop at {places[0]}" if len(places) == 1 else f"the loops at {', '.join(places[:-1])} and {places[-1]}"
    )
    keep = len(places) == 1 and 2 * made.lost > covered
    return Suggestion(
        "cut",
        f"{'keep only' if keep else 'cut off'} {loops}",
        made.where,
        made.lost,
        made.lost / covered,
        mended,
        loops=made.loops,
    )

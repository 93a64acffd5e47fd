"""Why a curve bounds no disk, in the order in which a person would mend it, and what would mend it."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from tween.geometry.curve import Curve
from tween.geometry.faces import Face, faces
from tween.plural import counted
from tween.triangulating.repair.loops import Meetings, meetings, signed_area, simple_loops, split
from tween.triangulating.repair.mending import Mending, Suggestion, in_words, mend

_TINY = 0.02  # reach of a tiny loop from where it closes, as a share of the size
_TINY_AREA = 4 * _TINY**2  # no loop of larger signed area, as a share of the size squared, reaches so little
_MOST_CROSSINGS = 20_000  # up to which regions and loops are looked for
_NAMED = 3  # regions and loops that the text names

_Floats = NDArray[np.float64]


class Loop(NamedTuple):
    """A loop of a curve.

    Attributes
    ----------
    place : tuple of float
        A point on it: where it closes, or a crossing that it passes.
    area : float
        Signed: less than 0 where it runs clockwise.
    points : ndarray of float64, shape (m, 2)
    """

    place: tuple[float, float]
    area: float
    points: _Floats


@dataclass(frozen=True)
class Explanation:
    """Why a curve bounds no disk, and what would mend it; its text is a few lines of English, a summary first.

    Attributes
    ----------
    curve : Curve
    reason : str
        `.Decomposition.reason`; empty where the curve bounds a disk.
    places : ndarray of float64, shape (k, 2)
        Where the curve meets itself; none where that was not looked at.
    crossings : int
        How often it does.
    tiny : tuple of Loop
        Loops that stay within 1/50 of the curve's size from where they close, the smallest first.
    loops : tuple of Loop
        What the curve falls apart into when it turns off at every crossing, the smallest first: loops that do not
        cross, and of which those that run counter-clockwise less those that run clockwise are the turning number.
        None where the curve touches itself.
    negative : tuple of Face
        Regions about which the curve winds clockwise, which no boundary of an immersed disk does; the largest first.
        Where the turning number is not 1 and the signed area negative, those about which it winds the other way.
    suggestions : tuple of Suggestion
        What would mend it, best first; each was checked, and carries the mended curve.
    unseen : tuple of str
        What was not looked at, as it would have taken too long.
    """

    curve: Curve
    reason: str
    places: _Floats = field(default_factory=lambda: np.empty((0, 2)), repr=False)
    crossings: int = 0
    tiny: tuple[Loop, ...] = field(default=(), repr=False)
    loops: tuple[Loop, ...] = field(default=(), repr=False)
    negative: tuple[Face, ...] = field(default=(), repr=False)
    suggestions: tuple[Suggestion, ...] = ()
    unseen: tuple[str, ...] = ()

    def __bool__(self) -> bool:
        return not self.reason

    @property
    def summary(self) -> str:
        """The first line of the text."""
        if not self.reason:
            return "The curve bounds an immersed disk."
        best = self.suggestions[0].text if self.suggestions else ""
        return f"The curve bounds no immersed disk: {self.reason}{f'; to mend it, {best}' if best else ''}."

    def __str__(self) -> str:
        return "\n".join([self.summary, *self._lines()] if self.reason else [self.summary])

    def _lines(self) -> Iterator[str]:
        yield self._crossings_line()
        if self.loops and self.curve.turning_number != 1:
            yield self._turning_line()
        if self.negative:
            where = _listed([f"{self._at(face.place)} ({face.winding})" for face in self.negative])
            sense = "clockwise" if self.negative[0].winding < 0 else "against its main sense"
            yield f"It winds {sense} about {counted(len(self.negative), 'region')}: at {where}."
        for number, suggestion in enumerate(self.suggestions, 1):
            yield f"{number}. {suggestion.text}: {_percent(suggestion.share)} of the area is lost."
        if not self.suggestions:
            yield "No way to mend it was found."
        yield from (f"Not looked at: {words}." for words in self.unseen)

    def _crossings_line(self) -> str:
        line = f"It meets itself {counted(self.crossings, 'time')}"
        if not self.tiny:
            return line + ", with no tiny loops."
        places = _listed([self._at(loop.place) for loop in self.tiny])
        return (
            f"{line}, and {counted(len(self.tiny), 'loop')} {'are' if len(self.tiny) > 1 else 'is'} tiny: at {places}."
        )

    def _at(self, place: tuple[float, float] | _Floats) -> str:
        return in_words(place, float(np.ptp(self.curve.points, axis=0).max()))

    def _turning_line(self) -> str:
        left = sum(loop.area > 0 for loop in self.loops)
        right = len(self.loops) - left
        turns = f"Its turning number is {self.curve.turning_number}: {counted(left, 'loop')} counter-clockwise"
        turns += f" less {right} clockwise" if right else ""
        surplus = [loop for loop in self.loops if (loop.area > 0) == (self.curve.turning_number > 1)]
        return f"{turns}; the smallest of them at {self._at(surplus[0].place)}." if surplus else turns + "."

    def to_dict(self) -> dict[str, Any]:
        """Return the same as numbers, lists and text, for JSON.

        Returns
        -------
        dict
        """
        return {
            "bounds_disk": bool(self),
            "summary": self.summary,
            "reason": self.reason,
            "turning_number": self.curve.turning_number,
            "crossings": self.crossings,
            "tiny": [_plain(loop) for loop in self.tiny],
            "loops": [_plain(loop) for loop in self.loops],
            "negative": [
                {"place": face.place.tolist(), "winding": face.winding, "area": face.polygon.area}
                for face in self.negative
            ],
            "suggestions": [suggestion.to_dict() for suggestion in self.suggestions],
            "unseen": list(self.unseen),
        }


def explain(curve: Curve, reason: str) -> Explanation:
    """Say why a curve bounds no disk; see `.Decomposition.explain`.

    Parameters
    ----------
    curve : Curve
    reason : str
        Empty where it bounds one.

    Returns
    -------
    Explanation
    """
    crossings = len(curve.crossings)
    if not reason:
        return Explanation(curve, reason, meetings(curve).places, crossings)
    if crossings > _MOST_CROSSINGS:
        unseen = (f"loops and regions, as there are more than {_MOST_CROSSINGS} crossings; clean the curve first",)
        return Explanation(curve, reason, crossings=crossings, unseen=unseen)
    at, found = meetings(curve), faces(curve.points)
    # A stroke that trembles may turn clockwise once too often, and is then traversed the wrong way.
    backwards = curve.turning_number != 1 and curve.area < 0
    wrong = [face for face in found if (face.winding > 0 if backwards else face.winding < 0)]
    negative = sorted(wrong, key=lambda face: -face.polygon.area)
    mending = mend(curve, sum(abs(face.winding) * face.polygon.area for face in found))
    return Explanation(
        curve,
        reason,
        at.places,
        crossings,
        tiny=tuple(_tiny(curve, at)),
        loops=tuple(_loops(curve, at)),
        negative=tuple(negative),
        suggestions=mending.suggestions,
        unseen=tuple(_unseen(mending)),
    )


def _tiny(curve: Curve, at: Meetings) -> list[Loop]:
    """The loops that stay near the place where they close."""
    size = 2 * float(shapely.minimum_bounding_radius(shapely.multipoints(curve.points)))
    found = []
    for m, side in np.argwhere(np.abs(at.areas) <= _TINY_AREA * size**2).tolist():
        i, j = at.pairs[m].tolist()
        loop = split(curve.points, (i, j), at.places[m])[side]
        if len(loop) and np.hypot(*(loop - at.places[m]).T).max() <= _TINY * size:
            found.append(Loop(_place(at.places[m]), float(at.areas[m, side]), loop))
    return sorted(found, key=lambda loop: abs(loop.area))


def _loops(curve: Curve, at: Meetings) -> list[Loop]:
    if not curve.crossings.proper.all():
        return []
    loops = [Loop(_place(points[0]), signed_area(points), points) for points in simple_loops(curve, at)]
    return sorted(loops, key=lambda loop: abs(loop.area))


def _unseen(mending: Mending) -> Iterator[str]:
    if mending.tried < mending.possible:
        yield f"{mending.possible - mending.tried} of the {mending.possible} loops that might be cut off"


def _place(point: _Floats) -> tuple[float, float]:
    x, y = point.tolist()
    return x, y


def _plain(loop: Loop) -> dict[str, Any]:
    return {"place": list(loop.place), "area": loop.area, "points": loop.points.tolist()}


def _listed(words: list[str]) -> str:
    more = len(words) - _NAMED
    return ", ".join(words[:_NAMED]) + (f" and {more} more" if more > 0 else "")


def _percent(share: float) -> str:
    return f"{round(100 * share)} %" if share >= 0.01 else "less than 1 %"

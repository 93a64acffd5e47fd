"""What cleaning a stroke changed, and by how much."""

from dataclasses import dataclass
from typing import Any

_ROUNDING = 1e-9  # by which a bound may be exceeded, as a share of it

_NAMES = {"repetition": "repeated point", "retraced": "retraced piece"}


@dataclass(frozen=True)
class Dropped:
    """A piece of a stroke that `.clean` left out.

    Attributes
    ----------
    kind : str
        "repetition" (points that equal a neighbour), "spike", "loop", "retraced", or "end": what was drawn before or
        beyond the place where the ends of the stroke meet.
    first, last : float
        Rows of the input between which it lies, 2.5 being halfway from row 2 to row 3; first > last where row 0 is
        among them.
    place : tuple of float
        Where it begins.
    reach : float
        Largest distance of a row in it from the curve.
    """

    kind: str
    first: float
    last: float
    place: tuple[float, float]
    reach: float


@dataclass(frozen=True)
class Changes:
    """What `.clean` did to a stroke; its text is a line for each kind of change.

    Attributes
    ----------
    asked : float
        How far anything was allowed to move, in the unit of the input.
    smoothing : float
        The smoothing that was used, at most that; 0 where nothing was smoothed.
    tremor : float
        Estimated from the stroke: the median distance between it and its smoothing by 1/100 of its size.
    moved : float
        Largest distance between the kept part of the stroke and the curve, both ways, at corresponding places.
    gap : float
        Length of the edge that joins the ends of the stroke.
    close : float
        Up to which gap ends were sought.
    dropped : tuple of Dropped
        What was left out, in order.
    rows : int
        Number of points of the input.
    reason : str
        Why the curve bounds no disk; empty where it bounds one.
    """

    asked: float
    smoothing: float
    tremor: float
    moved: float
    gap: float
    close: float
    dropped: tuple[Dropped, ...]
    rows: int
    reason: str

    @property
    def bounds_disk(self) -> bool:
        """Whether the curve bounds an immersed disk."""
        return not self.reason

    @property
    def within(self) -> bool:
        """Whether nothing was moved by more than was asked, and nothing dropped is farther than that from the curve.

        Ends that were joined may be as far as `close`; exact spikes, which no curve can have, may reach farther still.
        """
        return not self.beyond

    @property
    def beyond(self) -> tuple[str, ...]:
        """What could not be kept within the smoothing asked for, in words."""
        slack = _ROUNDING * max(self.asked, self.moved)
        words = []
        if self.moved > self.asked + slack:
            words.append(f"the curve is up to {self.moved:.3g} from the stroke")
        for piece in self.dropped:
            if piece.reach > max(self.asked, self.close if piece.kind == "end" else 0.0) + slack:
                words.append(f"the {piece.kind} at {_at(piece.place)} reached out by {piece.reach:.3g}")
        return tuple(words)

    def count(self, kind: str) -> int:
        """Count what was dropped.

        Parameters
        ----------
        kind : str
            As in `.Dropped`.

        Returns
        -------
        int
        """
        return sum(piece.kind == kind for piece in self.dropped)

    def to_dict(self) -> dict[str, Any]:
        """Return the same as numbers, lists and text, for JSON.

        Returns
        -------
        dict
        """
        plain = {name: getattr(self, name) for name in self.__dataclass_fields__}
        pieces = [{**vars(piece), "place": list(piece.place)} for piece in self.dropped]
        return {**plain, "dropped": pieces, "bounds_disk": self.bounds_disk, "beyond": list(self.beyond)}

    def __str__(self) -> str:
        lines = [self._smoothing_line()]
        lines += [self._dropped_line(kind) for kind in ("repetition", "spike", "loop", "retraced", "end")]
        if self.gap > 0:
            far = f", more than the {self.close:.3g} up to which ends are sought" if self.gap > self.close else ""
            lines.append(f"ends joined across a gap of {self.gap:.3g}{far}")
        lines += [f"more than was asked: {words}" for words in self.beyond]
        lines.append(f"bounds no disk: {self.reason}" if self.reason else "bounds a disk")
        return "\n".join(line for line in lines if line)

    def _smoothing_line(self) -> str:
        if not self.smoothing:
            return "not smoothed" + (f"; moved by {self.moved:.3g} at most" if self.moved else "")
        return f"smoothed by {self.smoothing:.3g} of {self.asked:.3g} allowed: moved by {self.moved:.3g} at most"

    def _dropped_line(self, kind: str) -> str:
        found = [piece for piece in self.dropped if piece.kind == kind]
        if not found:
            return ""
        name = _NAMES.get(kind, kind)
        where = ", ".join(f"{piece.first:.4g}" for piece in found[:3]) + (", ..." if len(found) > 3 else "")
        return f"dropped {len(found)} {name}{'s' * (len(found) > 1)} at row{'s' * (len(found) > 1)} {where}"


def _at(place: tuple[float, float]) -> str:
    return f"({place[0]:.4g}, {place[1]:.4g})"

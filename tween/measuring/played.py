"""Straight motion from frame to frame, checked for every instant, also where the triangles change between two.

Legend: as in `tween.measuring.certificate`.
"""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.measuring.frame_check import Checked, check, fault_words
from tween.measuring.straight_motion import Breach, breaches


class Failure(NamedTuple):
    """Where a rule is broken.

    Attributes
    ----------
    t : float
        Time of the frame, or of the instant between two.
    rule : str
        What was found, in a short sentence; between frames also which these are, and how much of the way from one to
        the other was done.
    element : int or (int, int) or None
        The vertex or triangle that `rule` names, or the ends of the edge; None for a wrong number of triangles.
    """

    t: float
    rule: str
    element: int | tuple[int, int] | None


class Played(NamedTuple):
    """What straight motion between frames was found to do.

    Attributes
    ----------
    intervals : int
        From a valid frame to the next, if that is valid, too.
    failures : list of Failure
        At most one for each.
    confirmed : bool
        Whether what the morph promises was checked anew, too.
    """

    intervals: int
    failures: list[Failure]
    confirmed: bool = False

    @property
    def holds(self) -> bool:
        """Whether there is no failure."""
        return not self.failures

    @property
    def scope(self) -> Literal["playback", "morph"]:
        """What was checked, in the word of a certificate."""
        return "morph" if self.confirmed else "playback"


def play(checked: Checked, lists: NDArray[np.int64]) -> Played:
    """Check straight motion from each valid frame to the next, if that is valid, too.

    Parameters
    ----------
    checked : Checked
        In the order in which they are played.
    lists : ndarray of int64, shape (stages, m, 3)

    Returns
    -------
    Played
    """
    valid = checked.faults[:, 0] == 0
    moved = np.flatnonzero(valid[:-1] & valid[1:])
    same = checked.stage[moved] == checked.stage[moved + 1]
    failures = [_straight_failure(checked, lists, f, f, breach) for f, breach in broken(checked, lists, moved[same])]
    found = [_failure_at_flip(checked, lists, f) for f in moved[~same].tolist()]
    return Played(len(moved), [*failures, *(failure for failure in found if failure)])


def broken(checked: Checked, lists: NDArray[np.int64], moved: NDArray[np.intp]) -> list[tuple[int, Breach]]:
    """Find those of some intervals that are broken under the triangles of their first frame.

    Parameters
    ----------
    checked : Checked
    lists : ndarray of int64, shape (stages, m, 3)
    moved : ndarray of int, shape (i,)
        First frames of the intervals; these and the next ones are valid.

    Returns
    -------
    list of (int, Breach)
        First frames of those that are broken.
    """
    found = breaches(checked.shapes[moved], checked.shapes[moved + 1], lists[checked.stage[moved]])
    return [(f, breach) for f, breach in zip(moved.tolist(), found, strict=True) if breach]


def _straight_failure(checked: Checked, lists: NDArray[np.int64], f: int, own: int, breach: Breach) -> Failure:
    """What breaks between frames f and f + 1 under the triangles of one of them."""
    s, kind, element = breach
    what = f"the angles at vertex {element} reach 2 pi"
    if kind == "triangle":
        what = f"triangle {element} {lists[checked.stage[own], element].tolist()} loses its area"
    t = checked.t[f] + s * (checked.t[f + 1] - checked.t[f])
    return Failure(float(t), f"{what} between frames {f} and {f + 1}, at {s:.17g} of the way", element)


def _failure_at_flip(checked: Checked, lists: NDArray[np.int64], f: int) -> Failure | None:
    """Why neither the triangles of frame f hold until the next, nor its own from frame f on; None where some do."""
    reasons = []
    for own, other in ((f, f + 1), (f + 1, f)):
        there = slice(other, other + 1)
        again = check(checked.t[there], checked.stage[own : own + 1], checked.shapes[there], lists)
        if again.faults[0, 0]:
            rule, element = fault_words(again, lists, 0)
            reasons.append(Failure(float(checked.t[other]), f"{rule} at frame {other}", element))
            continue
        (breach,) = breaches(
            checked.shapes[f : f + 1], checked.shapes[f + 1 : f + 2], lists[checked.stage[own : own + 1]]
        )
        if breach is None:
            return None
        reasons.append(_straight_failure(checked, lists, f, own, breach))
        if breach.kind == "vertex" and own == f:
            return reasons[0]  # up to there the triangles show a disk, so at that instant no others can
    first, second = reasons
    neither = f"the triangles change between frames {f} and {f + 1}, and neither list holds all the way"
    return first._replace(rule=f"{neither}: under the earlier one {first.rule}; under the later one {second.rule}")

r"""Certificates: whether frames, and what is played between them, bound immersed disks, decided exactly.

What was checked, and nothing else, a certificate says in one of these ways:

    checked at frames                         each frame by itself, see `tween.measuring.frame_check`
    checked for every instant of playback     and straight motion from each to the next, see
                                              `tween.measuring.straight_motion`

What a morph promises about itself is no check and is not repeated here.  Nothing but the predicates is shared with
`tween.geometry` or the morphs.

Legend: ``v p`` vertices; ``m`` number of triangles; ``f`` frame; ``t`` time; ``stage`` number of the list of
triangles in force.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import nan, pi
from typing import Any, Literal, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from tween.measuring.frame_check import Checked, check, fault_words
from tween.measuring.straight_motion import Breach, breaches

_SMALLEST_STEP = 2.0**-20  # of time; refinement goes no further
_MOST_ANGLES = 2_000_000  # vertices times frames; refinement stops there


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


@dataclass(frozen=True)
class Certificate:
    """What a check found; true where no rule is broken at what was checked.

    Attributes
    ----------
    first_failure : Failure or None
        The earliest frame or instant checked that breaks a rule, and the first rule that it breaks.
    scope : {"frames", "playback"}
        What was checked: the frames alone, or every instant of straight motion between them, too.
    frames_checked, frames_failed : int
    intervals_checked, intervals_failed : int
        From a frame that is valid to the next, if it is, too; none where `scope` is "frames".
    min_area, min_area_time : float
        The smallest triangle of all frames, signed, in the square of the input's unit, and when; rounded.
        nan, as the next two, where no frame could be measured.
    max_angle, max_angle_time : float
        The largest sum of angles at a vertex, in radians, and when; rounded.
    max_angle_vertex : int
        Where; -1 where no frame could be measured.
    proof : str
        What was checked, and how, in words.
    """

    first_failure: Failure | None
    scope: Literal["frames", "playback"]
    frames_checked: int
    frames_failed: int
    intervals_checked: int
    intervals_failed: int
    min_area: float
    min_area_time: float
    max_angle: float
    max_angle_time: float
    max_angle_vertex: int
    proof: str

    @property
    def valid(self) -> bool:
        """Whether nothing that was checked breaks a rule."""
        return self.first_failure is None

    def __bool__(self) -> bool:
        return self.valid

    def __str__(self) -> str:
        failure, lines = self.first_failure, []
        if failure:
            lines.append(f"not valid at t = {failure.t:.6g}: {failure.rule}")
        elif self.frames_checked == 1:
            lines.append("valid")
        else:
            lines.append("valid at every instant of playback" if self.scope == "playback" else "valid at these frames")
        lines.append(f"  frames: {self.frames_checked} checked, {self.frames_failed} failed")
        if self.scope == "playback":
            lines.append(f"  between frames: {self.intervals_checked} checked, {self.intervals_failed} failed")
        if self.max_angle_vertex >= 0:
            where = f"at vertex {self.max_angle_vertex}, t = {self.max_angle_time:.6g}"
            lines.append(f"  largest angle sum: {self.max_angle:.4f} ({self.max_angle / pi:.4f} pi) {where}")
            lines.append(f"  smallest triangle: area {self.min_area:.4g}, t = {self.min_area_time:.6g}")
        return "\n".join([*lines, f"  {self.proof}"])


def verify(
    frames: ArrayLike,
    triangles: ArrayLike,
    times: ArrayLike | None = None,
    between: Literal["linear"] | None = None,
) -> Certificate:
    """Check whether frames, whoever made them, bound immersed disks that the triangles cover.

    Parameters
    ----------
    frames : array_like, shape (k, n, 2) or (n, 2)
        Vertices in order along the curve, counter-clockwise.
    triangles : array_like of int, shape (n-2, 3) or (k, n-2, 3)
        Corners of the triangles, counter-clockwise; one list for all frames, or one for each.
    times : array_like of float, shape (k,), optional
        When each frame is shown; evenly spaced from 0 to 1 unless given.
    between : {"linear"}, optional
        To check, besides the frames, every instant of straight motion from each to the next: what animations play.
        Then the times must not fall.

    Returns
    -------
    Certificate

    Raises
    ------
    ValueError
        Where an array has another shape or type, or times fall.  All else is answered, not raised.

    Notes
    -----
    The rules, all exact: n-2 triangles of three different vertices; each boundary edge in one triangle, in
    the direction of the curve; each diagonal in two, in opposite directions; dual graph connected; coordinates
    finite and within `.EXACT_RANGE`; every triangle counter-clockwise; no angle sum of 2 pi or more.  The last
    one says that the curve has no spike and turning number 1, see `tween.measuring.frame_check`.  O(n k).

    Between frames the last two rules are decided for all real numbers between, see `tween.measuring.straight_motion`:
    about the frames as they are given, not about what a player makes of them.  Where the triangles of two
    neighbouring frames differ, one of the two lists has to hold all the way.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> cert = verify(square, [[0, 1, 2], [0, 2, 3]])
    >>> cert.valid, cert.min_area, cert.max_angle_vertex
    (True, 0.5, 0)
    >>> verify(square, [[0, 1, 3], [0, 2, 3]]).first_failure
    Failure(t=0.0, rule='edge 3-0 occurs twice in the same direction', element=(3, 0))
    >>> half_a_turn = [square, [[1, 1], [0, 1], [0, 0], [1, 0]]]
    >>> bool(verify(half_a_turn, [[0, 1, 2], [0, 2, 3]]))
    True
    >>> verify(half_a_turn, [[0, 1, 2], [0, 2, 3]], between="linear").first_failure.rule
    'triangle 0 [0, 1, 2] loses its area between frames 0 and 1, at 0.5 of the way'
    """
    shapes, lists = _arrays(frames, triangles)
    k = len(shapes)
    t = np.linspace(0.0, 1.0, k) if times is None else np.asarray(times, dtype=np.float64)
    if t.shape != (k,) or not np.isfinite(t).all():
        raise ValueError(f"times have shape {t.shape}, expected ({k},), one finite number for each frame")
    changes = (lists[1:] != lists[:-1]).any(axis=(1, 2))
    stage = np.concatenate([[0], np.cumsum(changes)]) if len(lists) == k else np.zeros(k, dtype=np.int64)
    lists = lists[np.concatenate([[True], changes])]
    checked = check(t, stage, shapes, lists)
    if between is None:
        return _certificate(checked, lists, "; nothing is said about the times between them" if k > 1 else "")
    if between != "linear":
        raise ValueError(f"between is {between!r}, expected 'linear' or None")
    if (np.diff(t) < 0).any():
        raise ValueError("times fall, expected frames in the order in which they are played")
    return _certificate(checked, lists, _STRAIGHT, _played(checked, lists))


def certify(shape: Any, frames: int = 100) -> Certificate:
    """Check a morph at evenly spaced times, at its flips, wherever it comes close to breaking a rule, and between.

    Parameters
    ----------
    shape : Morph or Triangulation
        Or what has the same attributes; the triangles in force may change at the `events` only.
    frames : int
        Evenly spaced in time, both ends included, at least 2.

    Returns
    -------
    Certificate
        Of a morph its `scope` is "playback": every instant of straight motion from each time that was looked at to
        the next is checked.

    Raises
    ------
    ValueError
        For fewer frames, and for anything else than a morph or a triangulation.

    Notes
    -----
    What the morph promises about itself, its `proof`, is neither used nor repeated.  At a flip the triangles before
    and after it are both checked.  Unless a frame failed already, time is bisected until straight motion between
    neighbouring frames keeps every rule, and until between them no angle sum can reach 2 pi, and no triangle lose its
    height over its longest edge, at the largest rates of change seen there and in the two intervals beside.  The
    first is exact, about what is played; the second is an estimate about the morph itself, as those rates are
    measured.  It ends at steps of 2**-20, or at two million angle sums.  At the first failure it ends too, so
    `frames_failed` is a share of the evenly spaced frames and those at flips only where these fail themselves.  O(n)
    a frame.

    Examples
    --------
    >>> from tween import morph, triangulate
    >>> T = triangulate([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> print(certify(morph(T, T.on_disk()), frames=10))
    valid at every instant of playback
      frames: 10 checked, 0 failed
      between frames: 9 checked, 0 failed
      largest angle sum: 4.7124 (1.5000 pi) at vertex 3, t = 0
      smallest triangle: area 0.2913, t = 1
      checked for every instant of playback: exact at 10 frames and at every instant of straight motion ...
    """
    if not hasattr(shape, "at"):
        if not hasattr(shape, "triangles"):
            raise ValueError(f"shape is a {type(shape).__name__}, expected a Morph or a Triangulation")
        return verify(shape.points, shape.triangles)
    if frames < 2:
        raise ValueError(f"{frames} frames were asked for, expected at least 2: the source and the target")
    bounds = np.concatenate([[0.0], np.unique([event.time for event in shape.events]), [1.0]])
    lists = np.stack([shape.triangles_at(max(a, np.nextafter(b, 0.0))) for a, b in pairwise(bounds)])
    t, stage = _samples(bounds, frames)
    checked, doubt = _refine(shape, lists, check(t, stage, shape.at(t), lists))
    return _certificate(checked, lists, f"{_STRAIGHT}; {doubt}", _played(checked, lists))


def _arrays(frames: ArrayLike, triangles: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Frames (k, n, 2) and lists of triangles (1, m, 3) or (k, m, 3), or the ValueError that tells what was found."""
    shapes, lists = np.asarray(frames, dtype=np.float64), np.asarray(triangles)
    if shapes.ndim not in (2, 3) or shapes.shape[-1] != 2 or shapes.shape[-2] < 3 or not len(shapes):
        raise ValueError(f"frames have shape {shapes.shape}, expected (k, n, 2) or (n, 2) with n >= 3")
    shapes = np.ascontiguousarray(shapes.reshape(-1, *shapes.shape[-2:]))
    k, n, _ = shapes.shape
    if lists.ndim not in (2, 3) or lists.shape[-1] != 3 or (lists.ndim == 3 and len(lists) != k):
        raise ValueError(f"triangles have shape {lists.shape}, expected ({n - 2}, 3) or ({k}, {n - 2}, 3)")
    if not np.issubdtype(lists.dtype, np.integer):
        raise ValueError(f"triangles have dtype {lists.dtype}, expected integers")
    return shapes, np.ascontiguousarray(lists.reshape(-1, *lists.shape[-2:]).astype(np.int64))


class _Played(NamedTuple):
    """How many intervals there are between valid frames, and the failures of straight motion, at most one each."""

    intervals: int
    failures: list[Failure]


def _certificate(
    checked: Checked, lists: NDArray[np.int64], between: str, played: _Played | None = None
) -> Certificate:
    t, failed = checked.t, np.flatnonzero(checked.faults[:, 0])
    area, area_time, angle, angle_time, vertex = nan, nan, nan, nan, -1
    if not np.isnan(checked.areas).all():
        least = np.nanargmin(checked.areas)
        f, v = np.unravel_index(np.nanargmax(checked.sums), checked.sums.shape)
        area, area_time = float(checked.areas[least]), float(t[least])
        angle, angle_time, vertex = float(checked.sums[f, v]), float(t[f]), int(v)
    failures = [] if played is None else list(played.failures)
    intervals = 0 if played is None else played.intervals, len(failures)
    if len(failed):
        f = failed[np.argmin(t[failed])]
        failures.append(Failure(float(t[f]), *fault_words(checked, lists, f)))
    failure = min(failures, key=lambda failure: failure.t, default=None)
    return Certificate(
        failure,
        "frames" if played is None else "playback",
        len(t),
        len(failed),
        *intervals,
        area,
        area_time,
        angle,
        angle_time,
        vertex,
        _words(len(t), len(failed), intervals[1], between, played is not None),
    )


def _words(frames: int, failed: int, broken: int, between: str, played: bool) -> str:
    """What was checked, and how it came out."""
    what = "checked for every instant of playback" if played else "checked at frames"
    at_frames = "exact at 1 frame" if frames == 1 else f"exact at {frames} frames"
    if failed:
        return f"{what}: {at_frames}, {failed} of them broken"
    if broken:
        return f"{what}: {at_frames}, and between them; {broken} of the intervals broken"
    return f"{what}: {at_frames}{between}"


# Between the frames

_STRAIGHT = " and at every instant of straight motion between them"


def _played(checked: Checked, lists: NDArray[np.int64]) -> _Played:
    """Straight motion from each valid frame to the next, if that is valid, too."""
    valid = checked.faults[:, 0] == 0
    moved = np.flatnonzero(valid[:-1] & valid[1:])
    same = checked.stage[moved] == checked.stage[moved + 1]
    failures = [_straight_failure(checked, lists, f, f, breach) for f, breach in _broken(checked, lists, moved[same])]
    found = [_failure_at_flip(checked, lists, f) for f in moved[~same].tolist()]
    return _Played(len(moved), [*failures, *(failure for failure in found if failure)])


def _broken(checked: Checked, lists: NDArray[np.int64], moved: NDArray[np.intp]) -> list[tuple[int, Breach]]:
    """Those of some intervals that are broken under the triangles of their first frame."""
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


def _samples(bounds: NDArray[np.float64], frames: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Times and stages of the first frames: evenly spaced ones, both ends of each stage, and one between."""
    even = np.linspace(0.0, 1.0, frames)
    stages = []
    for a, b in pairwise(bounds):
        inner = even[(a < even) & (even < b)]
        stages.append(np.unique([a, b, *(inner if len(inner) else [0.5 * (a + b)])]))
    return np.concatenate(stages), np.repeat(np.arange(len(stages)), [len(times) for times in stages])


def _refine(shape: Any, lists: NDArray[np.int64], checked: Checked) -> tuple[Checked, str]:
    """Bisect the intervals in doubt; also says what is known of the morph itself."""
    most = _MOST_ANGLES // checked.sums.shape[1]
    while not checked.faults[:, 0].any():
        doubtful = _doubtful(checked.t, checked.stage, checked.sums, checked.heights)
        steady = np.flatnonzero(checked.stage[:-1] == checked.stage[1:])
        bent = [f for f, _ in _broken(checked, lists, steady)]
        doubt = np.union1d(np.flatnonzero(doubtful), bent).astype(np.intp)
        wide = doubt[checked.t[doubt + 1] - checked.t[doubt] >= 2 * _SMALLEST_STEP]
        if not len(doubt):
            return checked, "the morph itself breaks no rule between them at the rates of change measured (an estimate)"
        left = f"{len(doubt)} of the intervals stay in doubt as to the morph itself"
        if not len(wide):
            return checked, f"down to the smallest step {left}"
        if len(checked.t) + len(wide) > most:
            return checked, f"at the limit of {most} frames {left}"
        t = 0.5 * (checked.t[wide] + checked.t[wide + 1])
        checked = checked.merged(check(t, checked.stage[wide], shape.at(t), lists))
    return checked, ""


@njit(cache=True)
def _doubtful(t, stage, sums, heights):
    """Whether, between each frame and the next, an angle sum may reach 2 pi or a height 0."""
    doubt = np.zeros(t.size - 1, np.bool_)
    for f in range(t.size - 1):
        if stage[f] == stage[f + 1]:  # else a flip: one instant, looked at before and after
            doubt[f] = _may_rise(t, stage, sums, 1.0, f, 2.0 * pi) or _may_rise(t, stage, heights, -1.0, f, 0.0)
    return doubt


@njit(cache=True)
def _may_rise(t, stage, values, sign, f, limit):
    """Whether sign times a value may reach the limit at the rates seen between frames f - 1 to f + 2."""
    # the fastest of three intervals, as a single one may straddle a peak and seem slow
    first, last = max(f - 1, 0), min(f + 1, t.size - 2)
    for v in range(values.shape[1]):
        rate = 0.0
        for g in range(first, last + 1):
            if stage[g] == stage[f] and stage[g + 1] == stage[f]:
                rate = max(rate, abs(values[g + 1, v] - values[g, v]) / (t[g + 1] - t[g]))
        # lines of this slope, up from both ends, meet at half this sum: no peak is higher
        if 0.5 * (sign * (values[f, v] + values[f + 1, v]) + rate * (t[f + 1] - t[f])) >= limit:
            return True
    return False

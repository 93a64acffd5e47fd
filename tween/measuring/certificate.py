r"""Certificates: whether frames, and what is played between them, bound immersed disks, decided exactly.

What was checked, and nothing else, a certificate says in one of these ways:

    checked at frames                         each frame by itself, see `tween.measuring.frame_check`
    checked for every instant of playback     and straight motion from each to the next, see
                                              `tween.measuring.straight_motion`
    proved by the morph, and its bounds       and what the morph promises for every time, by what it says that it is
    checked anew                              made of, see `tween.measuring.promise`

What a morph promises about itself is no check and is not repeated here.  Nothing but the predicates is shared with
`tween.geometry` or the morphs.

Legend: ``v p`` vertices; ``m`` number of triangles; ``f`` frame; ``t`` time; ``stage`` number of the list of
triangles in force.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import nan, pi
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tween.measuring.frame_check import Checked, check, fault_words
from tween.measuring.played import Failure, Played, play
from tween.measuring.promise import confirm
from tween.measuring.refinement import refine, samples

_STRAIGHT = " and at every instant of straight motion between them"
_WHERE = {"frames": "these frames", "playback": "every instant of playback", "morph": "every time"}
_CHECKED = {
    "frames": "checked at frames",
    "playback": "checked for every instant of playback",
    "morph": "proved by the morph, and its bounds checked anew",
}


@dataclass(frozen=True)
class Certificate:
    """What a check found; true where no rule is broken at what was checked.

    Attributes
    ----------
    first_failure : Failure or None
        The earliest frame or instant checked that breaks a rule, and the first rule that it breaks.
    scope : {"frames", "playback", "morph"}
        What was checked: the frames alone; every instant of straight motion between them, too; and the morph's own
        promise about every time as well.
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
    scope: Literal["frames", "playback", "morph"]
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
            lines.append(f"not valid at t = {moment(failure.t)}: {failure.rule}")
        elif self.frames_checked == 1:
            lines.append("valid")
        else:
            lines.append(f"valid at {_WHERE[self.scope]}")
        lines.append(f"  frames: {self.frames_checked} checked, {self.frames_failed} failed")
        if self.scope != "frames":
            lines.append(f"  between frames: {self.intervals_checked} checked, {self.intervals_failed} failed")
        if self.max_angle_vertex >= 0:
            where = f"at vertex {self.max_angle_vertex}, t = {moment(self.max_angle_time)}"
            lines.append(f"  largest angle sum: {self.max_angle:.4f} ({self.max_angle / pi:.4f} pi) {where}")
            lines.append(f"  smallest triangle: area {self.min_area:.4g}, t = {moment(self.min_area_time)}")
        return "\n".join([*lines, f"  {self.proof}"])


def moment(t: float) -> str:
    """Write a time so that one close to 1 can be told from 1.

    Parameters
    ----------
    t : float

    Returns
    -------
    str

    Examples
    --------
    >>> moment(0.25), moment(1.0), moment(1 - 2.0**-30)
    ('0.25', '1', '1 - 9.31323e-10')
    """
    return f"1 - {1.0 - t:.6g}" if 0.9999 < t < 1 else f"{t:.6g}"


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
    return _certificate(checked, lists, _STRAIGHT, play(checked, lists))


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
        the next is checked.  It is "morph" where what the morph promises for all times was checked anew, too.

    Raises
    ------
    ValueError
        For fewer frames, and for anything else than a morph or a triangulation.

    Notes
    -----
    What the morph promises about itself, its `proof`, is neither believed nor repeated.  Where it promises something,
    its angles are enclosed anew for every time, from what it says that it is made of, its `plans`, see
    `tween.measuring.promise`; where that does not decide, the certificate says no more than of a morph that promises
    nothing.  At a flip the triangles before
    and after it are both checked.  Unless a frame failed already, time is bisected until straight motion between
    neighbouring frames keeps every rule, and until between them no angle sum can reach 2 pi, and no triangle lose its
    height over its longest edge, at the largest rates of change seen there and in the two intervals beside.  The
    first is exact, about what is played; the second is an estimate about the morph itself, as those rates are
    measured.  The first ends where doubles have no time between two others, the second at steps of 2**-20, and both at
    two million angle sums.  At the first failure it ends too, so `frames_failed` is a share of the evenly spaced
    frames and those at flips only where these fail themselves.  O(n) a frame.

    Examples
    --------
    >>> from tween import morph, triangulate
    >>> T = triangulate([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> print(certify(morph(T, T.on_disk()), frames=10))
    valid at every time
      frames: 10 checked, 0 failed
      between frames: 9 checked, 0 failed
      largest angle sum: 4.7124 (1.5000 pi) at vertex 3, t = 0
      smallest triangle: area 0.2913, t = 1
      proved by the morph, and its bounds checked anew: exact at 10 frames and at every instant of straight motion ...
    """
    if not hasattr(shape, "at"):
        if not hasattr(shape, "triangles"):
            raise ValueError(f"shape is a {type(shape).__name__}, expected a Morph or a Triangulation")
        return verify(shape.points, shape.triangles)
    if frames < 2:
        raise ValueError(f"{frames} frames were asked for, expected at least 2: the source and the target")
    bounds = np.concatenate([[0.0], np.unique([event.time for event in shape.events]), [1.0]])
    lists = np.stack([shape.triangles_at(max(a, np.nextafter(b, 0.0))) for a, b in pairwise(bounds)])
    t, stage = samples(bounds, frames)
    checked, doubt = refine(shape, lists, check(t, stage, shape.at(t), lists))
    played = play(checked, lists)
    if not getattr(shape, "proof", "") or not hasattr(shape, "plans") or not played.holds or checked.faults.any():
        return _certificate(checked, lists, f"{_STRAIGHT}; {doubt}", played)
    found = confirm(shape.plans(), lists, checked)
    if found.doubt:
        doubt = f"what the morph promises for all other times was not confirmed: {found.doubt}"
        return _certificate(checked, lists, f"{_STRAIGHT}; {doubt}", played)
    anew = (
        f"; for every time its triangles were enclosed anew, in {found.intervals} intervals, and the angles at every "
        f"vertex stay below 2 pi by {found.room:.2g} at least"
    )
    return _certificate(checked, lists, _STRAIGHT + anew, played._replace(confirmed=True))


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


def _certificate(checked: Checked, lists: NDArray[np.int64], between: str, played: Played | None = None) -> Certificate:
    t, failed = checked.t, np.flatnonzero(checked.faults[:, 0])
    area, area_time, angle, angle_time, vertex = nan, nan, nan, nan, -1
    if not np.isnan(checked.areas).all():
        least = np.nanargmin(checked.areas)
        f, v = np.unravel_index(np.nanargmax(checked.sums), checked.sums.shape)
        area, area_time = float(checked.areas[least]), float(t[least])
        angle, angle_time, vertex = float(checked.sums[f, v]), float(t[f]), int(v)
    failures = [] if played is None else list(played.failures)
    intervals = 0 if played is None else played.intervals, len(failures)
    scope: Literal["frames", "playback", "morph"] = "frames" if played is None else played.scope
    if len(failed):
        f = failed[np.argmin(t[failed])]
        failures.append(Failure(float(t[f]), *fault_words(checked, lists, f)))
    failure = min(failures, key=lambda failure: failure.t, default=None)
    return Certificate(
        failure,
        scope,
        len(t),
        len(failed),
        *intervals,
        area,
        area_time,
        angle,
        angle_time,
        vertex,
        _words(len(t), len(failed), intervals[1], between, _CHECKED[scope]),
    )


def _words(frames: int, failed: int, broken: int, between: str, what: str) -> str:
    """What was checked, and how it came out."""
    at_frames = "exact at 1 frame" if frames == 1 else f"exact at {frames} frames"
    if failed:
        return f"{what}: {at_frames}, {failed} of them broken"
    if broken:
        return f"{what}: {at_frames}, and between them; {broken} of the intervals broken"
    return f"{what}: {at_frames}{between}"

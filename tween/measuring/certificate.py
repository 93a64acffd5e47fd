r"""Certificates: whether every frame of a morph bounds an immersed disk, decided exactly.

Counter-clockwise triangles are not enough.  The angles of the triangles around a vertex may add up to
2 pi or more; then the curve turns more than once, and bounds no immersed disk, although no triangle folds.
So every vertex is walked around, through its *fan* of triangles:

      p2 ---- p1            fan of v: p0, p1, ..., pd, from v's successor p0 on the curve to its
     /  \    /  \           predecessor pd; the triangles v, p(i), p(i+1) are the fan's
    p3    v ---- p0

If each fan leads along the triangles from p0 to pd and no triangle is left over, the triangles are glued
to one disk.  The step from one p(i) to the next turns left by less than pi, so the direction comes back
to that of p0 exactly where it leaves the open half plane to the right of v p0: counting these returns
with `turn` gives floor(angle sum / 2 pi), exactly.  The angles of n-2 triangles sum to
(n-2) pi, and a curve turns at v by pi - angle sum, up to the multiple of 2 pi that brings it between -pi and pi:

    turning number  =  1 + sum over the vertices of floor(angle sum / 2 pi).

Here is no code of `tween.geometry` but the exact predicate, and none of the morphs.

Legend: ``v p`` vertices; ``m`` number of triangles; ``f`` frame; ``t`` time; ``stage`` number of the list of
triangles in force; ``fault`` a rule's code and two numbers, (OK, 0, 0) for none.
"""

from dataclasses import dataclass
from itertools import pairwise
from math import atan2, inf, nan, pi
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from tween.geometry.predicates import EXACT_RANGE, turn

_SMALLEST_STEP = 2.0**-20  # of time; refinement goes no further
_MOST_ANGLES = 2_000_000  # vertices times frames; refinement stops there

_LOW, _HIGH = EXACT_RANGE
_OK, _COUNT, _INDEX, _TWICE, _MISSING, _RIGHT, _OPEN, _APART, _RANGE, _FLIPPED, _SPIKE, _TURNS = range(12)
_RULES = {
    _COUNT: "there are {a} triangles, expected {b} for {n} vertices",
    _INDEX: "triangle {a} is {corners}, expected three different vertices from 0 to {last}",
    _TWICE: "edge {a}-{b} occurs twice in the same direction",
    _MISSING: "boundary edge {a}-{b} belongs to no triangle",
    _RIGHT: "boundary edge {a}-{b} has a triangle on its right, expected on its left only",
    _OPEN: "diagonal {a}-{b} has no triangle on its other side",
    _APART: "triangle {a} is not joined to the others around vertex {b}: the dual graph is no tree",
    _RANGE: "vertex {a} is {place}, expected coordinates that are 0 or between {low:.0e} and {high:.0e} in magnitude",
    _FLIPPED: "triangle {a} {corners} is not counter-clockwise",
    _SPIKE: "vertex {a} is a spike: the angles there add up to exactly {b} pi",
    _TURNS: "the angles at vertex {a} add up to {sum:.4f}, more than 2 pi: the turning number is {b}, not 1",
}


class Failure(NamedTuple):
    """Where a rule is broken.

    Attributes
    ----------
    t : float
        Time of the frame.
    rule : str
        What was found, in a short sentence.
    element : int or (int, int) or None
        The vertex or triangle that `rule` names, or the ends of the edge; None for a wrong number of triangles.
    """

    t: float
    rule: str
    element: int | tuple[int, int] | None


@dataclass(frozen=True)
class Certificate:
    """What a check of frames found; true where they all bound immersed disks.

    Attributes
    ----------
    first_failure : Failure or None
        The earliest frame checked that breaks a rule, and the first rule that it breaks.
    frames_checked, frames_failed : int
    min_area, min_area_time : float
        The smallest triangle of all frames, signed, in the square of the input's unit, and when; rounded.
        nan, as the next two, where no frame could be measured.
    max_angle, max_angle_time : float
        The largest sum of angles at a vertex, in radians, and when; rounded.
    max_angle_vertex : int
        Where; -1 where no frame could be measured.
    proof : str
        What is known at the frames, and between them.
    """

    first_failure: Failure | None
    frames_checked: int
    frames_failed: int
    min_area: float
    min_area_time: float
    max_angle: float
    max_angle_time: float
    max_angle_vertex: int
    proof: str

    @property
    def valid(self) -> bool:
        """Whether no frame breaks a rule."""
        return self.first_failure is None

    def __bool__(self) -> bool:
        return self.valid

    def __str__(self) -> str:
        failure = self.first_failure
        lines = [f"not valid at t = {failure.t:.6g}: {failure.rule}" if failure else "valid"]
        lines.append(f"  frames: {self.frames_checked} checked, {self.frames_failed} failed")
        if self.max_angle_vertex >= 0:
            where = f"at vertex {self.max_angle_vertex}, t = {self.max_angle_time:.6g}"
            lines.append(f"  largest angle sum: {self.max_angle:.4f} ({self.max_angle / pi:.4f} pi) {where}")
            lines.append(f"  smallest triangle: area {self.min_area:.4g}, t = {self.min_area_time:.6g}")
        return "\n".join([*lines, f"  {self.proof}"])


def verify(frames: ArrayLike, triangles: ArrayLike, times: ArrayLike | None = None) -> Certificate:
    """Check whether frames, whoever made them, bound immersed disks that the triangles cover.

    Parameters
    ----------
    frames : array_like, shape (k, n, 2) or (n, 2)
        Vertices in order along the curve, counter-clockwise.
    triangles : array_like of int, shape (n-2, 3) or (k, n-2, 3)
        Corners of the triangles, counter-clockwise; one list for all frames, or one for each.
    times : array_like of float, shape (k,), optional
        When each frame is shown; evenly spaced from 0 to 1 unless given.

    Returns
    -------
    Certificate

    Raises
    ------
    ValueError
        Where an array has another shape or type.  All else is answered, not raised.

    Notes
    -----
    The rules, all exact: n-2 triangles of three different vertices; each boundary edge in one triangle, in
    the direction of the curve; each diagonal in two, in opposite directions; dual graph connected; coordinates
    finite and within `.EXACT_RANGE`; every triangle counter-clockwise; no angle sum of 2 pi or more.  The last
    one says that the curve has no spike and turning number 1, see the module.  O(n k).

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> cert = verify(square, [[0, 1, 2], [0, 2, 3]])
    >>> cert.valid, cert.min_area, cert.max_angle_vertex
    (True, 0.5, 0)
    >>> verify(square, [[0, 1, 3], [0, 2, 3]]).first_failure
    Failure(t=0.0, rule='edge 3-0 occurs twice in the same direction', element=(3, 0))
    """
    shapes, lists = _arrays(frames, triangles)
    k = len(shapes)
    t = np.linspace(0.0, 1.0, k) if times is None else np.asarray(times, dtype=np.float64)
    if t.shape != (k,) or not np.isfinite(t).all():
        raise ValueError(f"times have shape {t.shape}, expected ({k},), one finite number for each frame")
    changes = (lists[1:] != lists[:-1]).any(axis=(1, 2))
    stage = np.concatenate([[0], np.cumsum(changes)]) if len(lists) == k else np.zeros(k, dtype=np.int64)
    lists = lists[np.concatenate([[True], changes])]
    checked = _run(t, stage, shapes, lists)
    return _certificate(checked, lists, "; nothing is said about the times between them" if k > 1 else "")


def certify(shape: Any, frames: int = 100) -> Certificate:
    """Check a morph, at evenly spaced times, at its flips, and wherever it comes close to breaking a rule.

    Parameters
    ----------
    shape : Morph or Triangulation
        Or what has the same attributes; the triangles in force may change at the `events` only.  A morph
        that is right by construction says why in a `proof`, a str.
    frames : int
        Evenly spaced in time, both ends included, at least 2.

    Returns
    -------
    Certificate
        `proof` says what is known between the frames.

    Raises
    ------
    ValueError
        For fewer frames, and for anything else than a morph or a triangulation.

    Notes
    -----
    At a flip the triangles before and after it are both checked.  Without a `proof`, and unless a frame failed
    already, time is bisected until between neighbouring frames no angle sum can reach 2 pi, and no
    triangle lose its height over its longest edge, at the largest rates of change seen there and in the
    two intervals beside.  Those rates are measured: this is an estimate, not a proof.  It ends at steps of
    2**-20, or at two million angle sums.  At the first failure it ends too, so `frames_failed` is a share of
    the evenly spaced frames and those at flips only where these fail themselves.  O(n) a frame.

    Examples
    --------
    >>> from tween import morph, triangulate
    >>> T = triangulate([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> print(certify(morph(T, T.on_disk()), frames=10))
    valid
      frames: 10 checked, 0 failed
      largest angle sum: 4.7124 (1.5000 pi) at vertex 3, t = 0
      smallest triangle: area 0.2913, t = 1
      exact at 10 frames; no rule can break between them at the rates of change measured (no proof)
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
    checked = _run(t, stage, shape.at(t), lists)
    promise = getattr(shape, "proof", "")
    if promise:
        return _certificate(checked, lists, f"; between them by construction: {promise}")
    return _certificate(*_refine(shape, lists, checked))


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


class _Checked(NamedTuple):
    """Frames and what was found: angle `sums` (k, n), `heights` over longest edges (k, m), smallest `areas` (k,)."""

    t: NDArray[np.float64]
    stage: NDArray[np.int64]
    shapes: NDArray[np.float64]
    faults: NDArray[np.int64]
    sums: NDArray[np.float64]
    heights: NDArray[np.float64]
    areas: NDArray[np.float64]

    def merged(self, other: "_Checked") -> "_Checked":
        """Both together, in order of stage and time."""
        joined = [np.concatenate(pair) for pair in zip(self, other, strict=True)]
        order = np.lexsort((joined[0], joined[1]))
        return _Checked(*(values[order] for values in joined))


def _run(
    t: NDArray[np.float64], stage: NDArray[np.int64], shapes: NDArray[np.float64], lists: NDArray[np.int64]
) -> _Checked:
    (k, n, _), m = shapes.shape, lists.shape[1]
    found = np.zeros((k, 3), np.int64), np.full((k, n), nan), np.full((k, m), nan), np.full(k, nan)
    if m == n - 2:
        _check(np.ascontiguousarray(shapes), stage, lists, *found)
    else:
        found[0][:] = _COUNT, m, n - 2
    return _Checked(t, stage, shapes, *found)


def _certificate(checked: _Checked, lists: NDArray[np.int64], between: str) -> Certificate:
    t, failed = checked.t, np.flatnonzero(checked.faults[:, 0])
    area, area_time, angle, angle_time, vertex = nan, nan, nan, nan, -1
    if not np.isnan(checked.areas).all():
        least = np.nanargmin(checked.areas)
        f, v = np.unravel_index(np.nanargmax(checked.sums), checked.sums.shape)
        area, area_time = float(checked.areas[least]), float(t[least])
        angle, angle_time, vertex = float(checked.sums[f, v]), float(t[f]), int(v)
    failure = _failure(checked, lists, failed[np.argmin(t[failed])]) if len(failed) else None
    at_frames = "exact at 1 frame" if len(t) == 1 else f"exact at {len(t)} frames"
    proof = f"{at_frames}, {len(failed)} of them broken" if failure else f"{at_frames}{between}"
    return Certificate(failure, len(t), len(failed), area, area_time, angle, angle_time, vertex, proof)


def _failure(checked: _Checked, lists: NDArray[np.int64], f: np.intp) -> Failure:
    code, a, b = checked.faults[f].tolist()
    n, triangles = checked.sums.shape[1], lists[checked.stage[f]]
    rule = _RULES[code].format(
        a=a,
        b=b,
        n=n,
        last=n - 1,
        low=_LOW,
        high=_HIGH,
        corners=triangles[a].tolist() if code in (_INDEX, _FLIPPED) else "",
        place=tuple(checked.shapes[f, a].tolist()) if code == _RANGE else "",
        sum=checked.sums[f, a] if code == _TURNS else nan,
    )
    edge = code in (_TWICE, _MISSING, _RIGHT, _OPEN)
    return Failure(float(checked.t[f]), rule, None if code == _COUNT else (a, b) if edge else a)


# Between the frames


def _samples(bounds: NDArray[np.float64], frames: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Times and stages of the first frames: evenly spaced ones, both ends of each stage, and one between."""
    even = np.linspace(0.0, 1.0, frames)
    stages = []
    for a, b in pairwise(bounds):
        inner = even[(a < even) & (even < b)]
        stages.append(np.unique([a, b, *(inner if len(inner) else [0.5 * (a + b)])]))
    return np.concatenate(stages), np.repeat(np.arange(len(stages)), [len(times) for times in stages])


def _refine(shape: Any, lists: NDArray[np.int64], checked: _Checked) -> tuple[_Checked, NDArray[np.int64], str]:
    """Bisect the intervals in doubt; also says how that ended."""
    most = _MOST_ANGLES // checked.sums.shape[1]
    while not checked.faults[:, 0].any():
        doubt = np.flatnonzero(_doubtful(checked.t, checked.stage, checked.sums, checked.heights))
        wide = doubt[checked.t[doubt + 1] - checked.t[doubt] >= 2 * _SMALLEST_STEP]
        if not len(doubt):
            return checked, lists, "; no rule can break between them at the rates of change measured (no proof)"
        if not len(wide):
            return checked, lists, f"; down to the smallest step {len(doubt)} of the intervals stay in doubt"
        if len(checked.t) + len(wide) > most:
            return checked, lists, f"; at the limit of {most} frames {len(doubt)} of the intervals stay in doubt"
        t = 0.5 * (checked.t[wide] + checked.t[wide + 1])
        checked = checked.merged(_run(t, checked.stage[wide], shape.at(t), lists))
    return checked, lists, ""


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


# One frame


@njit(cache=True)
def _check(shapes, stage, lists, faults, sums, heights, areas):
    """Fill in faults and measures of all frames; frames of one stage follow each other."""
    n = shapes.shape[1]
    # fans depend on the triangles alone, so each list is walked once and not in every frame
    fault, start, fans = _fans(lists[stage[0]], n)
    for f in range(len(shapes)):
        if f > 0 and stage[f] != stage[f - 1]:
            fault, start, fans = _fans(lists[stage[f]], n)
        outside = _outside(shapes[f])
        if fault[0] == _OK and outside < 0:
            areas[f] = _measure(shapes[f], lists[stage[f]], sums[f], heights[f])
            found = _shape_fault(shapes[f], lists[stage[f]], start, fans)
        else:  # what cannot be measured keeps its nan
            found = fault if fault[0] != _OK else (_RANGE, outside, 0)
        faults[f, 0], faults[f, 1], faults[f, 2] = found


@njit(cache=True)
def _outside(points):
    """The first vertex whose coordinates the predicate cannot treat exactly; -1 for none."""
    for v in range(len(points)):
        for x in points[v]:
            # so written that nan, for which every comparison is false, is outside
            if not (x == 0.0 or _LOW <= abs(x) <= _HIGH):
                return v
    return -1


@njit(cache=True)
def _measure(points, triangles, sums, heights):
    """Fill in the angle sums and the heights over the longest edge; returns the smallest area."""
    # measured in floats, for the report and for where to look closer; no frame passes or fails by these
    sums[:] = 0.0
    least = inf
    for i in range(len(triangles)):
        longest = 0.0
        for s in range(3):
            v, p, q = triangles[i, s], triangles[i, (s + 1) % 3], triangles[i, (s + 2) % 3]
            ax, ay = points[p, 0] - points[v, 0], points[p, 1] - points[v, 1]
            bx, by = points[q, 0] - points[v, 0], points[q, 1] - points[v, 1]
            cross = ax * by - ay * bx
            # atan2 has all its digits near 0 and pi, where an arc cosine has half of them
            sums[v] += atan2(cross, ax * bx + ay * by)
            longest = max(longest, ax * ax + ay * ay)
        # cross is twice the area at every corner: that of the last will do
        heights[i] = cross / longest if longest > 0.0 else 0.0
        least = min(least, 0.5 * cross)
    return least


@njit(cache=True)
def _shape_fault(points, triangles, start, fans):
    """The first rule that the points break, under triangles that keep the rules of edges."""
    for i in range(len(triangles)):
        if turn(points, triangles[i, 0], triangles[i, 1], triangles[i, 2]) <= 0:
            return _FLIPPED, i, 0
    # all triangles are positive from here on, which is what counting turns by half planes needs
    turning, worst, back, most = 1, 0, False, 0
    for v in range(len(points)):
        full, closed = _full_turns(points, v, fans[start[v] : start[v + 1]])
        turning += full
        if full > most:
            worst, back, most = v, closed, full
    if most == 0:
        return _OK, 0, 0
    # back in its first direction after full turns: both edges of the curve leave the vertex the same way
    return (_SPIKE, worst, 2 * most) if back else (_TURNS, worst, turning)


@njit(cache=True)
def _full_turns(points, v, fan):
    """floor(angle sum / 2 pi) of a fan of positive triangles, and whether it ends in its first direction."""
    full, right, ahead = 0, False, True
    for p in fan[1:]:
        side = turn(points, v, fan[0], p)
        ahead = side == 0 and _same_direction(points, v, fan[0], p)
        # a step is less than pi, so none jumps over the open half plane on the right
        was_right, right = right, side < 0
        full += int(was_right and not right)
    return full, ahead


@njit(cache=True)
def _same_direction(points, v, p, q):
    """Whether q lies on the same side of v as p, all three being on one line."""
    # comparing coordinates is exact where a difference would be rounded; p differs from v, as its triangle is positive
    axis = 0 if points[p, 0] != points[v, 0] else 1
    return (points[p, axis] > points[v, axis]) == (points[q, axis] > points[v, axis])


# Fans


@njit(cache=True)
def _fans(triangles, n):
    """A fault of the triangles, and the fan of v in fans[start[v] : start[v + 1]]."""
    start, fans = np.zeros(n + 1, np.int64), np.empty(3 * len(triangles) + n, np.int64)
    for i in range(len(triangles)):
        a, b, c = triangles[i]
        if min(a, b, c) < 0 or max(a, b, c) >= n or a == b or b == c or c == a:
            return (_INDEX, i, 0), start, fans
        for v in triangles[i]:
            start[v + 1] += 1
    # corners sorted by their vertex, by counting
    first = np.cumsum(start)
    corners, place = np.empty(3 * len(triangles), np.int64), first[:-1].copy()
    for h in range(corners.size):
        v = triangles[h // 3, h % 3]
        corners[place[v]] = h
        place[v] += 1
    start = first + np.arange(n + 1)  # a fan has one vertex more than triangles
    # every walk leaves these at -1 again, so one pair serves all vertices
    after, before = np.full(n, -1), np.full(n, -1)
    for v in range(n):
        own, fan = corners[first[v] : first[v + 1]], fans[start[v] : start[v + 1]]
        fault = _walk(triangles, own, v, n, after, before, fan)
        if fault[0] != _OK:
            return fault, start, fans
    return (_OK, 0, 0), start, fans


@njit(cache=True)
def _walk(triangles, corners, v, n, after, before, fan):
    """Walk from the successor of v to its predecessor, over all triangles v, p, after[p]; or tell why that fails."""
    successor, predecessor = (v + 1) % n, (v - 1) % n
    for h in corners:
        p, q = triangles[h // 3, (h + 1) % 3], triangles[h // 3, (h + 2) % 3]
        if after[p] >= 0:
            return _TWICE, v, p
        if before[q] >= 0:  # so after is one to one
            return _TWICE, q, v
        after[p], before[q] = q, p
    if after[successor] < 0:
        return _MISSING, v, successor
    if before[successor] >= 0:
        return _RIGHT, v, successor
    if after[predecessor] >= 0:
        return _RIGHT, predecessor, v
    p, size = successor, 0
    # nothing comes before the successor and after is one to one: the walk never meets itself, and ends
    while after[p] >= 0:
        fan[size], size, q = p, size + 1, after[p]
        after[p], before[q], p = -1, -1, q
    fan[size] = p
    if p != predecessor:
        return _OPEN, v, p
    for h in corners:  # what is left forms a ring, or a second fan, that touches the first at v only
        if after[triangles[h // 3, (h + 1) % 3]] >= 0:
            return _APART, h // 3, v
    return _OK, 0, 0

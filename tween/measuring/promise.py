r"""The promise of a morph checked anew: its angles enclosed over intervals of time, by arithmetic rounded outwards.

A morph says what it is made of: for every stretch of time the shapes at both ends of a leg, the triangles in the order
in which they hang on each other, the path of their third vertices, and the limits of their angles, see
`tween.morphing.plan`.  From that alone, and with no code of the morphs, their bounds or their budgets, two things are
decided for *every* time:

1.  *No triangle turns over.*  Over its base from 0 to 1 a triangle is its third vertex z, and Im z is enclosed in an
    interval above 0.
2.  *No angles reach 2 pi.*  Every angle is enclosed from above by a linear function of time; they are summed at every
    vertex, and a linear function that is below 2 pi at both ends of an interval is so between them.

    linear   z runs along a segment, along which the angles at 0 and 1 rise or fall all the way: both ends tell
    angle    the three angles are linear themselves
    metric   with w the weight of the target, Re z is linear in w, and the square of Im z concave: its ends tell the
             least, and the largest is at most (Re z2 - Re z1)^2 (w2 - w1)^2 / 4 above them
    slide    z runs at constant speed, so it stays in a disk about where it is halfway; see `slide_path`

Where angles have limits, a triangle that would break one is led, in the space of its three angles, towards its shape
on the path "angle" until it keeps them.  So an angle with a limit stays below the limit, and each lies between what
it would be on the two paths.  Placing the shapes is a similarity, which changes nothing of this.

An interval that cannot be decided is halved, until it can be or is too short; then the answer is "not confirmed", as it
is for the path "area", for which there are no enclosures here.  What is confirmed holds in real numbers; that the
arrays keep to it is looked at where frames were checked: their angles have to lie in the enclosures of their times.

Legend: ``p q`` where intervals of a leg's time begin and end, (k,); ``x y`` parts of z, (m, k); ``tops`` what angles
are at most at p and at q, linear between, (2, m, 3, k).
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.measuring.frame_check import Checked
from tween.measuring.intervals import Interval, angle, between
from tween.measuring.slide_path import enclosed_slide

_FIRST = 32  # intervals of a whole leg
_SHORTEST = 2.0**-44  # of the leg's time
_MOST = 2**22  # angles that are enclosed for one leg; then it counts as not confirmed
_AT_ONCE = 2**18  # angles
_SUMMED = 1.0 + 2.0**-40  # more than the sum of thousands of angles is off
_PI = Interval(np.array(np.pi), np.array(np.nextafter(np.pi, 4.0)))  # the double is below pi
_ALIKE = 1e-6  # radians; by how much an angle of an array may lie outside its enclosure
_NEAR = 1e-9  # of the leg's time, around that of a frame

_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]


class Confirmation(NamedTuple):
    """Whether a promise was confirmed.

    Attributes
    ----------
    doubt : str
        Why it was not; empty where it was.
    intervals : int
        Of time, in which all angles were enclosed.
    room : float
        Radians that every sum of angles stays below 2 pi, at least.
    """

    doubt: str
    intervals: int
    room: float


class _Triangles(NamedTuple):
    """The triangles of a plan at the leg's times 0 and 1."""

    first: tuple[Interval, Interval]  # x and y of the third vertices, (m,) each
    last: tuple[Interval, Interval]
    first_angles: list[Interval]  # at a, b and c, (m,) each
    last_angles: list[Interval]


def confirm(plans: list[Any], lists: _Ints, checked: Checked) -> Confirmation:
    """Check anew what a morph promises, and that frames keep to it.

    Parameters
    ----------
    plans : list of Plan
        In order of time, see `tween.morphing.plan.Plan`.
    lists : ndarray of int64, shape (stages, m, 3)
        The triangles that are said to be in force.
    checked : Checked
        Frames, and which list is in force for each.

    Returns
    -------
    Confirmation
    """
    ends = [0.0, *(plan.stop for plan in plans)]
    if not plans or ends[-1] != 1.0 or any(plan.start != end for plan, end in zip(plans, ends, strict=False)):
        return Confirmation("what it is made of does not cover the time from 0 to 1", 0, 0.0)
    t, shapes, intervals, room = checked.t, checked.shapes, 0, np.inf
    for plan in plans:
        here = np.flatnonzero((plan.start <= t) & (t <= plan.stop))
        doubt = _structure(plan, lists[np.unique(checked.stage[here])], shapes.shape[1])
        if not doubt:
            doubt, count, left = _enclosed(plan)
            intervals, room = intervals + count, min(room, left)
        doubt = doubt or _other_frames(plan, t[here], shapes[here])
        if doubt:
            return Confirmation(doubt, intervals, 0.0)
    return Confirmation("", intervals, float(room))


def _structure(plan: Any, lists: _Ints, n: int) -> str:
    """What is wrong with the triangles of a plan, as triangles that hang on each other; empty where nothing is."""
    corners = np.asarray(plan.corners)
    if plan.path not in ("linear", "slide", "metric", "angle"):
        return f"along {plan.path!r} angles are not enclosed here"
    if corners.shape != (n - 2, 3) or plan.source.shape != (n, 2) or plan.target.shape != (n, 2):
        return "what it is made of has another number of vertices"
    if not any(np.array_equal(_sorted(corners), _sorted(triangles)) for triangles in lists):
        return "the triangles that it is made of are not those in force"
    free = {*_outer(corners[0]), (int(corners[0, 1]), int(corners[0, 0]))}
    for row in corners[1:]:
        base = int(row[0]), int(row[1])
        if base not in free:
            return f"triangle {row.tolist()} hangs on no triangle before it"
        free.remove(base)
        free.update(_outer(row))
    return ""


def _outer(row: _Ints) -> list[tuple[int, int]]:
    """The bases of children across the edges to the third vertex."""
    a, b, c = row.tolist()
    return [(a, c), (c, b)]


def _sorted(triangles: _Ints) -> _Ints:
    rows = np.sort(triangles, axis=1)
    return np.asarray(rows[np.lexsort(rows.T)])


# All times


def _enclosed(plan: Any) -> tuple[str, int, float]:
    """Enclose all angles of a leg for all of its times: a doubt, the number of intervals, and the room left."""
    ends = _at_ends(plan)
    m, n = len(plan.corners), len(plan.source)
    start, stop = sorted((plan.first, plan.last))
    knots = np.linspace(start, stop, 2 + int(_FIRST * (stop - start)))
    p, q = knots[:-1], knots[1:]
    done, room, used = 0, np.inf, 0
    while len(p):
        tried = slice(0, max(1, _AT_ONCE // (3 * m)))
        a, b, p, q = p[tried], q[tried], p[tried.stop :], q[tried.stop :]
        tops, sound = _tops(plan, ends, a, b)
        left = np.nextafter(2 * np.pi, 0.0) - _sums(plan.corners, tops, n).max(axis=0) * _SUMMED
        good = sound & (left > 0).all(axis=0)
        done, used = done + int(good.sum()), used + 3 * m * len(a)
        room = min(room, float(left[:, good].min(initial=np.inf)))
        middle = 0.5 * (a + b)
        again = ~good
        if (again & (b - a < 2 * _SHORTEST)).any() or (again.any() and used > _MOST):
            f = int(np.flatnonzero(again)[0])
            return _doubt(plan, middle[f], int(left[:, f].argmin()), bool(sound[f])), done, 0.0
        p = np.concatenate([a[again], middle[again], p])
        q = np.concatenate([middle[again], b[again], q])
    return "", done, room


def _doubt(plan: Any, leg_time: float, vertex: int, sound: bool) -> str:
    what = f"the angles at vertex {vertex} may reach 2 pi" if sound else "a triangle may turn over"
    t = np.linspace(plan.start, plan.stop, 1001)
    when = t[np.abs(np.asarray(plan.leg_time(t)) - leg_time).argmin()]
    return f"close to t = {when:.4g} {what}"


def _sums(corners: _Ints, tops: _Floats, n: int) -> _Floats:
    """Sums of angles at both ends of intervals, (2, n, k)."""
    sums = np.zeros((2, n, tops.shape[-1]))
    for end in (0, 1):
        np.add.at(sums[end], corners.ravel(), tops[end].reshape(-1, tops.shape[-1]))
    return sums


def _at_ends(plan: Any) -> _Triangles:
    first, last = (_thirds(points, plan.corners) for points in (plan.source, plan.target))
    return _Triangles(first, last, _angles(*first), _angles(*last))


def _thirds(points: _Floats, corners: _Ints) -> tuple[Interval, Interval]:
    """The third vertices over bases from 0 to 1."""
    a, b, c = (np.ascontiguousarray(points[corners[:, s]].T) for s in range(3))
    (ux, uy), (vx, vy) = ([Interval.exact(e) - Interval.exact(s) for s, e in zip(a, to, strict=True)] for to in (b, c))
    square = ux.square() + uy.square()
    return (vx * ux + vy * uy) / square, (vy * ux - vx * uy) / square


def _angles(x: Interval, y: Interval) -> list[Interval]:
    a, b = angle(y, x), angle(y, Interval.exact(np.ones_like(x.low)) - x)
    return [a, b, _PI - a - b]


def _tops(plan: Any, ends: _Triangles, p: _Floats, q: _Floats) -> tuple[_Floats, NDArray[np.bool_]]:
    """What angles are at most at p and at q, and between them in proportion; and where no triangle turns over."""
    plain = [[between(a.over(1), b.over(1), t) for a, b in zip(*ends[2:], strict=True)] for t in (p, q)]
    tops = np.stack([np.stack([side.high for side in sides], axis=1) for sides in plain])
    sound = np.logical_and.reduce([(side.low > 0).all(axis=0) for sides in plain for side in sides])
    if plan.path == "angle":
        return tops, sound
    wanted, above = _wanted(plan, ends, p, q)
    sound &= above
    most = np.stack([side.high for side in wanted], axis=1)
    limited = np.isfinite(plan.low).any(axis=1)
    level = np.where(limited[:, None, None], np.maximum(most, tops.max(axis=0)), most)
    low, high = (Interval.exact(np.where(np.isfinite(side), side, 0.0)[..., None]) for side in (plan.low, plan.high))
    limits = [between(low, high, t).high for t in (p, q)]
    kept = np.maximum(tops, np.stack(limits))
    # a level is as good as a slope; of both the one that is lower halfway
    lower = np.isfinite(plan.low)[..., None] & (kept.sum(axis=0) < 2 * level)
    return np.where(lower, kept, level), sound


def _wanted(plan: Any, ends: _Triangles, p: _Floats, q: _Floats) -> tuple[list[Interval], NDArray[np.bool_]]:
    """The angles along the path before limits are kept, and where all third vertices stay above their bases."""
    if plan.path == "metric":
        x, y = _by_metric(plan, ends, p, q)
        return _angles(x, y), np.asarray((y.low > 0).all(axis=0))
    places = [[between(a.over(1), b.over(1), t) for a, b in zip(*ends[:2], strict=True)] for t in (p, q)]
    a, b = (s.hull(e) for s, e in zip(*(_angles(x, y)[:2] for x, y in places), strict=True))
    above = np.minimum(places[0][1].low, places[1][1].low)
    if plan.path == "slide":
        rows, x, y = enclosed_slide(plan, p, q)
        if len(rows):
            for side, bent in zip((a, b), _angles(x, y)[:2], strict=True):
                side.low[rows], side.high[rows] = bent
            above[rows] = y.low
    return [a, b, _PI - a - b], np.asarray((above > 0).all(axis=0))


def _by_metric(plan: Any, ends: _Triangles, p: _Floats, q: _Floats) -> tuple[Interval, Interval]:
    (x1, y1), (x2, y2) = (tuple(part.over(1) for part in end) for end in ends[:2])
    squares = [_base_squares(points, plan.corners).over(1) for points in (plan.source, plan.target)]
    nothing = Interval.exact(np.zeros(1))
    weights = []
    for t in (p, q):
        of_target, of_source = between(nothing, squares[1], t), between(squares[0], nothing, t)
        share = of_target / (of_source + of_target)
        weights.append(Interval(np.clip(share.low, 0.0, 1.0), np.clip(share.high, 0.0, 1.0)))
    w = Interval(weights[0].low, weights[1].high)
    one, apart = Interval.exact(np.ones(1)), (x2 - x1).square()
    edges = []
    for side in w:
        s = Interval.exact(side)
        edges.append((one - s) * y1.square() + s * y2.square() + s * (one - s) * apart)
    low, high = np.minimum(edges[0].low, edges[1].low), np.maximum(edges[0].high, edges[1].high)
    bulge = apart * (Interval.exact(w.high) - Interval.exact(w.low)).square() * Interval.exact(np.full(1, 0.25))
    x = ((one - Interval.exact(w.low)) * x1 + Interval.exact(w.low) * x2).hull(
        (one - Interval.exact(w.high)) * x1 + Interval.exact(w.high) * x2
    )
    return x, (Interval(low, high) + Interval(np.zeros_like(low), bulge.high)).root()


def _base_squares(points: _Floats, corners: _Ints) -> Interval:
    a, b = (np.ascontiguousarray(points[corners[:, s]].T) for s in (0, 1))
    x, y = (Interval.exact(e) - Interval.exact(s) for s, e in zip(a, b, strict=True))
    return x.square() + y.square()


# Frames


def _other_frames(plan: Any, t: _Floats, shapes: _Floats) -> str:
    """Which frame has angles that its plan does not allow; empty where none has."""
    ends, some = _at_ends(plan), max(1, _AT_ONCE // (3 * len(plan.corners)))
    for i in range(0, len(t), some):
        own = np.asarray(plan.leg_time(t[i : i + some]))
        p, q = np.clip(own - _NEAR, 0.0, 1.0), np.clip(own + _NEAR, 0.0, 1.0)
        tops, _ = _tops(plan, ends, p, q)
        seen = _measured(shapes[i : i + some], plan.corners)
        off = ((seen > tops.max(axis=0) + _ALIKE) | (seen < _bottoms(plan, ends, p, q) - _ALIKE)).any(axis=(0, 1))
        if off.any():
            return f"the frame at t = {t[i : i + some][off][0]:.6g} is not what it is made of"
    return ""


def _bottoms(plan: Any, ends: _Triangles, p: _Floats, q: _Floats) -> _Floats:
    """What angles are at least, (m, 3, k)."""
    plain = [[between(a.over(1), b.over(1), t).low for a, b in zip(*ends[2:], strict=True)] for t in (p, q)]
    lows = np.minimum(*(np.stack(sides, axis=1) for sides in plain))
    if plan.path == "angle":
        return np.asarray(lows)
    wanted = np.stack([side.low for side in _wanted(plan, ends, p, q)[0]], axis=1)
    limited = np.isfinite(plan.low).any(axis=1)[:, None, None]
    return np.where(limited, np.minimum(wanted, lows), wanted)


def _measured(shapes: _Floats, corners: _Ints) -> _Floats:
    """Angles of frames, (m, 3, k), rounded."""
    z = (shapes @ np.array([1.0, 1.0j]))[:, corners]
    turned = [np.angle((z[..., (s + 2) % 3] - z[..., s]) / (z[..., (s + 1) % 3] - z[..., s])) for s in range(3)]
    return np.asarray(np.moveaxis(np.stack(turned, axis=2), 0, -1))

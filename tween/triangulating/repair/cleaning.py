"""From a noisy stroke to a curve that can be used, and an account of what that changed.

    rows -> without repetitions -> ends joined -> smooth, pieces dropped -> vertices -> does it bound a disk?

for a few smoothings, the least first, see ``smoothing`` and ``pieces``.

Legend: ``p`` rows of the stroke; ``t`` places along it, in rows; ``s`` a smoothing: how far anything may be moved.
"""

import math
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from tween.errors import CurveError
from tween.geometry.curve import Curve, coordinate_fault
from tween.geometry.halving import halve_longest_edges
from tween.geometry.rings import ring_points
from tween.triangulating.decomposition import decompose
from tween.triangulating.repair.changes import Changes, Dropped
from tween.triangulating.repair.pieces import Piece, droppable, tidied
from tween.triangulating.repair.smoothing import Path, smoothed

_SHARES = (1 / 16, 1 / 8, 1 / 4, 1 / 2, 1.0)  # of the smoothing asked for, that are tried
_CLOSE = 0.05  # how near ends have to come, as a share of the size
_ENDS, _ENDS_SHARE = 480, 0.125  # samples of an open stroke, and which share of them may be cut off at either end
_LOSS = 0.5  # of gap that cutting off a unit of length has to save
_TREMBLE = 0.01  # smoothing, as a share of the size, whose effect is taken for the tremor
_STEADY = 0.0005  # tremor, as a share of the size, below which none is seen
_TIMES = 2.5  # tremors that a smoothing has to exceed: about so much is needed to tell tremor from shape
_MOST = 0.05  # smoothing allowed without being asked, as a share of the size
_TUBE = 0.6  # of the smoothing for the tube; the rest is for vertices, which cut corners
_NEAR, _REACH = 0.5, 0.75  # of the smoothing for the ends of a piece that is dropped, and for what it may reach
_ROUNDS = 8  # of smoothing and dropping
_PER_RADIUS = 4  # samples of a radius' length among which pieces are sought
_TINY = np.finfo(np.float64).tiny
_FEWEST_VERTICES, _ENOUGH_VERTICES, _MOST_VERTICES = 60, 500, 1000
_LONGEST_EDGE = 1.5  # smoothings, where the number of vertices is not given

_Floats = NDArray[np.float64]


class CleanedCurve(Curve):
    """A curve that `.clean` made of a stroke: a `.Curve` that knows what was changed.

    Made by `.clean`.
    """

    _changes: Changes

    def __repr__(self) -> str:
        return f"Cleaned{super().__repr__()}"

    @property
    def changes(self) -> Changes:
        """What was changed, and by how much."""
        return self._changes


def clean(
    points: Curve | ArrayLike, smooth: float | None = None, close: float | None = None, vertices: int | None = None
) -> CleanedCurve:
    """Make a curve that can be used of a noisy stroke, and say what that changed.

    Parameters
    ----------
    points : Curve or array_like of shape (k, 2)
        Points along the stroke; the last is joined to the first.
    smooth : float, optional
        How far anything may be moved, in the unit of the points; 0 moves nothing.  Without it, 1/20 of the size, which
        is the diameter of the smallest circle around all points.
    close : float, optional
        How near to each other the ends have to come for what was drawn before or beyond to be cut off.  Without it,
        1/20 of the size.
    vertices : int, optional
        Number of vertices, at least 3.  Without it, as many as the smoothing needs, from 60 to 500 and seldom more; or
        those of the stroke where it is not smoothed.

    Returns
    -------
    CleanedCurve
        A `.Curve`; its `changes` tell what was done.  Repeated points, spikes, loops smaller than the smoothing and
        what is drawn twice are dropped.  Of 1/16, 1/8, 1/4, 1/2 and all of `smooth` the least is taken that gives a
        curve which bounds a disk, of those above 2.5 times the tremor of the stroke, see `.Changes`.  Where `smooth`
        is not given and the tremor is below 1/2000 of the size, no smoothing at all is tried first.  Where none gives
        a disk, the curve is that of the largest, and ``changes.reason`` says why.

    Raises
    ------
    CurveError
        Where the points are no stroke, an option is out of range, or nothing is left that has an inside.

    Notes
    -----
    Each vertex lies within `smooth` of the place of the stroke that it stands for, and each kept row of the stroke
    within `smooth` of the edge that stands for it; each dropped row within `smooth` of the curve.  This is measured,
    not assumed: see `.Changes.beyond`.  A similarity of the stroke, and of `smooth` and `close` with it, gives a
    similar curve up to rounding.

    Examples
    --------
    >>> t = np.linspace(0, 6.3, 500)
    >>> stroke = np.stack([np.cos(t), np.sin(t)], axis=1) + np.random.default_rng(0).normal(0, 0.02, (500, 2))
    >>> Curve(stroke).turning_number
    6
    >>> curve = clean(stroke, smooth=0.1, vertices=100)
    >>> curve
    CleanedCurve(100 vertices, turning number 1)
    >>> curve.changes.bounds_disk, curve.changes.moved <= 0.1
    (True, True)
    """
    p = _checked(points)
    size = 2 * float(shapely.minimum_bounding_radius(shapely.multipoints(p)))
    tremor = _tremor(p, _TREMBLE * size)
    asked = _option("smooth", smooth, _MOST * size)
    near = _option("close", close, _CLOSE * size)
    if vertices is not None and vertices < 3:
        raise CurveError(f"{vertices} vertices wanted, but a curve needs at least 3")
    request = _Request(p, asked, near, tremor, vertices)
    attempts: list[CleanedCurve] = []
    for s in _smoothings(asked, tremor, smooth is None and tremor <= _STEADY * size):
        attempts.append(_cleaned(request, s))
        if attempts[-1].changes.bounds_disk and attempts[-1].changes.within:
            return attempts[-1]
    return next((curve for curve in attempts if curve.changes.bounds_disk), attempts[-1])


def _smoothings(asked: float, tremor: float, none_first: bool) -> list[float]:
    """Those to try: parts of the one asked for that exceed the tremor, the least first, and all of it."""
    tried = [share * asked for share in _SHARES if share == 1 or share * asked > _TIMES * tremor]
    return [0.0] * (none_first and asked > 0) + tried


class _Request(NamedTuple):
    """A stroke, and what is to become of it."""

    p: _Floats
    asked: float
    close: float
    tremor: float
    vertices: int | None


def _checked(points: Curve | ArrayLike) -> _Floats:
    try:
        p = np.array(points.points if isinstance(points, Curve) else ring_points(points), dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise CurveError(f"points are no array of numbers of shape (k, 2): {error}") from None
    if p.ndim != 2 or p.shape[1] != 2:
        raise CurveError(f"points have shape {p.shape}, expected (k, 2)")
    fault = coordinate_fault(p)
    if fault:
        raise CurveError(fault)
    if len(np.unique(p, axis=0)) < 3:
        raise CurveError(f"a curve needs at least 3 different points, found {len(np.unique(p, axis=0))}")
    return p


def _option(name: str, given: float | None, otherwise: float) -> float:
    if given is None:
        return otherwise
    if not 0 <= given < math.inf:
        raise CurveError(f"{name} is {given}, expected a distance, 0 or more")
    return float(given)


def _tremor(p: _Floats, radius: float) -> float:
    """Median distance between a stroke and its smoothing."""
    path = Path(p, np.arange(len(p), dtype=np.float64), len(p))
    x = smoothed(path, radius)
    return float(np.median(np.hypot(*(x.points - path.evenly(len(x.points)).points).T)))


def _cleaned(request: _Request, s: float) -> CleanedCurve:
    """Clean a stroke with one smoothing."""
    path, pieces = _closed(request, s)
    if s:
        x, path, more = _settled(path, s)
        found = _resampled(x, path, s, request)
    else:
        path, found, more = _as_it_is(path, request.vertices)
    curve, moved = _curve(found, request.p), _moved(path, found)
    dropped = tuple(_dropped(piece, request.p, curve) for piece in sorted([*pieces, *more], key=lambda c: c.first))
    changes = Changes(
        asked=request.asked,
        smoothing=s,
        tremor=request.tremor,
        moved=moved,
        gap=_gap(path, request.p),
        close=request.close,
        dropped=dropped,
        rows=len(request.p),
        reason=decompose(curve).reason,
    )
    curve._changes = changes
    return curve


# Closing


def _closed(request: _Request, s: float) -> tuple[Path, list[Piece]]:
    """Drop repeated points, and what was drawn before or beyond the place where the ends meet."""
    p = request.p
    fresh = np.append(True, (p[1:] != p[:-1]).any(axis=1))
    met = bool((p[-1] == p[0]).all())
    joined = met or _gap(Path(p, np.arange(len(p), dtype=np.float64), len(p)), p) == 0
    fresh[np.flatnonzero(fresh)[-1]] &= not met
    pieces = [Piece("repetition", float(row), float(row)) for row in np.flatnonzero(~fresh)]
    rows = np.flatnonzero(fresh).astype(np.float64)
    path = Path(p[fresh], rows)
    first, last = (rows[0], rows[-1]) if joined else _ends(path, s, request.close)
    if first > rows[0]:
        pieces.append(Piece("end", 0.0, first))
    if last < rows[-1]:
        pieces.append(Piece("end", last, len(p) - 1.0))
    inside = (rows > first) & (rows < last)
    places = np.concatenate([[first], rows[inside], [last]])
    return Path(path.at(places), places, len(p)), pieces


def _ends(path: Path, s: float, close: float) -> tuple[float, float]:
    """Find the places to join: near to each other, with little lost and all of that near to the rest."""
    x = (smoothed(path, _TUBE * s) if s else path).evenly(_ENDS)
    m = int(_ENDS_SHARE * _ENDS)
    head, tail = x.points[:m], x.points[: -m - 1 : -1]
    gaps = np.hypot(*(head[:, None] - tail[None]).transpose(2, 0, 1))
    lost = x.length / _ENDS * (np.arange(m)[:, None] + np.arange(m))
    cost = np.where(gaps <= close, gaps + _LOSS * lost, math.inf)
    cost[0, 0] = gaps[0, 0]
    i, j = map(int, np.unravel_index(np.argmin(cost), cost.shape))
    kept = shapely.linestrings(x.points[i : _ENDS - j])
    cut = shapely.points(np.concatenate([head[:i], tail[:j]]))
    if shapely.distance(cut, kept).max(initial=0.0) > max(close, s):
        return float(path.places[0]), float(path.places[-1])
    return float(x.places[i]), float(x.places[_ENDS - 1 - j])


def _gap(path: Path, p: _Floats) -> float:
    """Length of the edge that joins the ends; 0 where that is an edge like others of the stroke."""
    joint = float(path.steps[-1])
    return joint if joint > Path(p, np.arange(len(p), dtype=np.float64)).steps.max() else 0.0


# Smoothing


def _settled(path: Path, s: float) -> tuple[Path, Path, list[Piece]]:
    """Smooth and drop until nothing is left to drop: the smooth path, what it stands for, and the pieces."""
    radius, near = _TUBE * s, _NEAR * s
    dropped: list[Piece] = []
    for _ in range(_ROUNDS):
        x = smoothed(path, radius)
        pieces = droppable(x.evenly(max(16, math.ceil(_PER_RADIUS * x.length / near))), path, near, _REACH * s)
        for piece in pieces:
            path = path.without(piece.first, piece.last)
        dropped += pieces
        if not pieces:
            break
    return x, path, dropped


def _resampled(x: Path, path: Path, s: float, request: _Request) -> Path:
    """Take evenly spaced points: as many as asked, or as keep the path within the smoothing, or the one allowed."""
    vertices = request.vertices
    needed = math.ceil(x.length / (_LONGEST_EDGE * s))
    n = vertices or min(max(needed, _FEWEST_VERTICES), _ENOUGH_VERTICES)
    found = x.evenly(n)
    while not vertices and n < _MOST_VERTICES and _moved(path, found) > (s if n < _ENOUGH_VERTICES else request.asked):
        n = min(n + n // 4, _MOST_VERTICES)
        found = x.evenly(n)
    return found


def _as_it_is(path: Path, vertices: int | None) -> tuple[Path, Path, list[Piece]]:
    """Drop exact spikes only: what is left, the same with as many points as wanted, and the pieces."""
    kept = tidied(path.points)
    if len(kept) < 3:
        raise CurveError("the stroke only leads out and back: nothing is left that has an inside")
    gone = np.setdiff1d(np.arange(len(path.points)), kept)
    pieces = [Piece("spike", float(path.places[i]), float(path.places[i])) for i in gone]
    left = found = Path(path.points[kept], path.places[kept], path.period)
    if vertices is not None and vertices < len(kept):
        found = found.evenly(vertices)
    elif vertices is not None:
        points, _ = halve_longest_edges(found.points, kept, vertices)
        along = np.append(0.0, np.cumsum(Path(points, np.zeros(vertices)).steps))
        found = Path(points, np.interp(along, np.append(0.0, np.cumsum(found.steps)), found.ring_places), path.period)
    return left, found, pieces


def _curve(found: Path, p: _Floats) -> CleanedCurve:
    kept = tidied(found.points)
    if len(kept) < 3:
        raise CurveError("nothing is left that has an inside; take a smaller smoothing")
    points, rows = found.points[kept], np.rint(found.places[kept]).astype(np.intp) % len(p)
    origin = np.where((p[rows] == points).all(axis=1), rows, -1)
    plain = Curve(points)
    curve = CleanedCurve.__new__(CleanedCurve)
    curve._hold(plain.points, plain.turning_number, plain.reversed_input, origin[plain.origin])
    return curve


# Measuring


def _moved(path: Path, found: Path) -> float:
    """Largest distance of points from the place they stand for, and of places from the edge that stands for them."""
    off = np.hypot(*(found.points - path.at(found.places)).T)
    ring, t = found.ring, found.lifted(path.places)
    edge = np.clip(np.searchsorted(found.ring_places, t, side="right") - 1, 0, len(found.points) - 1)
    a, along = ring[edge], ring[edge + 1] - ring[edge]
    share = np.clip(((path.points - a) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), _TINY), 0, 1)
    strayed = np.hypot(*(a + share[:, None] * along - path.points).T)
    return float(max(off.max(), strayed.max()))


def _dropped(piece: Piece, p: _Floats, curve: Curve) -> Dropped:
    first, last = math.ceil(piece.first), math.floor(piece.last)
    rows = np.arange(first, last + 1 + (len(p) if piece.first > piece.last else 0)) % len(p)
    rows = rows if len(rows) else np.array([first % len(p)])
    reach = shapely.distance(shapely.points(p[rows]), shapely.linearrings(curve.points)).max()
    x, y = p[rows[0]].tolist()
    return Dropped(piece.kind, piece.first, piece.last, (x, y), float(reach))

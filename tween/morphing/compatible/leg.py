"""Motion between compatible triangulations (Section 5), all times at once.

The root triangle moves as a whole; every other triangle hangs on its base, the edge it shares with
its parent, and moves its third vertex along a path (`.paths`).  Points are complex numbers here.

Legend: ``a b c`` the corners of a triangle, ab its base; ``z = (c-a)/(b-a)``; ``e = b-a``; ``t`` time.
"""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tween.choices import Path
from tween.geometry.dual_tree import RootedTree, disk_center, rooted, tree_center
from tween.geometry.triangulation import Triangulation
from tween.morphing.compatible.area_thirds import area_thirds
from tween.morphing.compatible.guarantee.angle_bounds import Bounds, angle_bounds, within_budgets
from tween.morphing.compatible.guarantee.angle_budgets import (
    default_reserve,
    left_over,
    no_budgets,
    proved_budgets,
)
from tween.morphing.compatible.guarantee.area_bounds import area_bounds, largest_sums, with_ancestors
from tween.morphing.compatible.guarantee.area_twists import AreaPath, kept_below_full_turn, straight_area_path
from tween.morphing.compatible.guarantee.rounding import Doubt, Layout, Placing, cut, first_doubt
from tween.morphing.compatible.layout import hang, placed, root_base
from tween.morphing.compatible.paths import base_angles, corner_angles, third_vertices
from tween.morphing.plan import Plan

_THINNEST = 2.0**-60
_ROUNDING = 2.0**-48  # relative, of lengths
_MARGIN = 1e-9  # radians below 2 pi that a proof leaves where the ends allow it
_SHORTEST = 1.0 / 512.0  # of the intervals in which sums along "area" are looked at
_LEAST = 2.0**-16  # of those at an end


class Leg:
    """The motion from one shape to another with the same triangles.

    Parameters
    ----------
    source : Triangulation
    target : ndarray of float64, shape (n, 2)
        Points of the target; its triangles are the source's.
    path : str
        See `.paths`.
    root : int
        Number of the root triangle.
    guarantee : bool
        Whether angle budgets keep the sum of the angles at every vertex below 2 pi, see `.guarantee`.
    reserve : ndarray of float64, shape (2, n), optional
        What budgets leave untouched at both ends, see `default_reserve`.

    Notes
    -----
    The root's base changes its length (along "metric" its square) and direction linearly, and its centre
    of mass moves linearly; the paper says only that the root is "smoothly interpolated".

    References
    ----------
    Mukherjee and Gopi, Section 5.
    """

    def __init__(
        self,
        source: Triangulation,
        target: NDArray[np.float64],
        path: Path,
        root: int,
        guarantee: bool = False,
        reserve: NDArray[np.float64] | None = None,
    ) -> None:
        self.source, self.target = source, target
        self._path, self._tree = path, rooted(source, root)
        self._corners = _corners_from_base(source.triangles, self._tree)
        self._start, self._end = _complex(source.points)[self._corners], _complex(target)[self._corners]
        self._thirds = _third(self._start), _third(self._end)
        self._propagates = _propagates(source.twin, self._tree)
        self._stretch = np.abs((self._end[:, 1] - self._end[:, 0]) / (self._start[:, 1] - self._start[:, 0]))
        self._angles = base_angles(self._thirds[0]), base_angles(self._thirds[1])
        self._children = self._places_of_children()
        self._centres = self._start[0].mean(), self._end[0].mean()
        self.budgets, self._budgeted = no_budgets(len(self._corners)), np.empty(0, np.int64)  # triangles that have some
        self._alone = reserve is None  # not one of very many legs of a flow, each of which would hold its bounds
        self._first_bounds: tuple[NDArray[np.float64], Bounds] | None = None
        if guarantee:
            self._give_budgets(reserve)

    @cached_property
    def area_path(self) -> AreaPath:
        """What the path "area" is, kept below full turns where that is guaranteed."""
        return straight_area_path(_areas(self._start, self._end), *self._angles)

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """Lay out the triangles of all times, the root first and each child on its base.

        Parameters
        ----------
        t : ndarray of float64, shape (k,)
            From 0 to 1.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
            At times 0 and 1 exactly the source and the target.
        """
        laid, _ = self._lay_out(t, self.area_path if self._path == "area" else None)
        shapes: NDArray[np.float64] = placed(laid, self._corners[0], *self._centres, t, self.source.points, self.target)
        return shapes

    def plan(self) -> Plan:
        """Tell what the motion is made of.

        Returns
        -------
        Plan
            In the leg's own time.
        """
        limits = self.budgets.low, self.budgets.high
        return Plan(0.0, 1.0, 0.0, 1.0, np.copy, self.source.points, self.target, self._corners, self._path, *limits)

    def first_doubt(
        self, placing: Placing, stop: float = 1.0, ends: tuple[bool, bool] = (True, True)
    ) -> Doubt | tuple[float, float]:
        """Prove that the shapes are valid in doubles, or tell where that fails; see `.guarantee`.

        Parameters
        ----------
        placing : Placing
        stop : float
            Shapes are looked at from time 0 to there.
        ends : (bool, bool)
            Whether the source, and the target, may serve for times close to them.

        Returns
        -------
        Doubt, or (float, float)
            The first one; or the times up to which the source, and from which on the target, is to be shown instead.
        """
        width = min(np.ptp(points, axis=0).max() for points in (self.source.points, self.target))
        offset = max(np.abs(points).max() for points in (self.source.points, self.target))

        def moves(start: float, end: float) -> float:
            before, after = self.at(np.array([start, end]))
            return float(np.abs(after - before).max() / width)

        placing = placing._replace(offset=max(placing.offset, offset))
        return first_doubt(self._layout, self._corners, self._children, placing, moves, stop, ends)

    def _places_of_children(self) -> NDArray[np.int64]:
        """Places in tree order of the triangles across bc, ca and ab (of the root only); -1 for none."""
        place = np.empty(len(self._corners), np.int64)
        place[self._tree.order] = np.arange(len(place))
        slots = (self._tree.base[self._tree.order, None] + np.array([1, 2, 0])) % 3
        across = self.source.twin[self._tree.order[:, None], slots]
        children = np.where(across >= 0, place[across // 3], -1)
        children[1:, 2] = -1
        return children

    def _give_budgets(self, reserve: NDArray[np.float64] | None) -> None:
        """Find who needs a budget, and what every vertex is then proved to have left, at both ends, shape (2, n)."""
        left = np.stack([left_over(self._corners, a) for a in self._angles])
        self._slack = left
        if self._path == "area":
            self.area_path = kept_below_full_turn(
                self.area_path,
                self._corners,
                left,
                self._angles_at,
                lambda path: self._doubtful(path, left.min(axis=0)),
            )
        elif self._path != "angle":
            kept = np.minimum(left, default_reserve(self._corners, *self._angles) if reserve is None else reserve)
            self.budgets, proved = proved_budgets(self._corners, *self._angles, self._largest_angles, kept)
            self._budgeted = np.flatnonzero(np.isfinite(self.budgets.low).any(axis=1))
            self._slack = np.where(np.isnan(proved), kept, proved)

    def _doubtful(self, path: AreaPath, left: NDArray[np.float64]) -> NDArray[np.bool_]:
        """The vertices whose angles along the path "area" are not proved to stay below 2 pi.

        Intervals of time are divided for the vertices that are in doubt there.
        """
        intervals = np.stack([np.linspace(0.0, 1.0, 17)[:-1], np.linspace(0.0, 1.0, 17)[1:]], axis=1)
        margin = np.minimum(_MARGIN, 0.5 * left)[:, None]
        bad, lost = np.ones((len(left), len(intervals)), dtype=np.bool_), np.zeros(len(left), dtype=np.bool_)
        while len(intervals):
            knots = np.unique(intervals)
            places = np.searchsorted(knots, intervals[:, 0])
            asked = np.zeros((len(left), len(knots) - 1), dtype=np.bool_)
            asked[:, places] = bad
            bad &= ~(self._layout_by_area(knots, path, asked).slack[:, places] > margin)
            lost |= bad[:, _too_short(intervals)].any(axis=1)
            bad &= ~lost[:, None]
            again = bad.any(axis=0)
            parts = [_parts(*interval) for interval in intervals[again].tolist()]
            intervals = np.concatenate(parts) if parts else np.empty((0, 2))
            bad = np.repeat(bad[:, again], 4, axis=1)
        return lost

    def _layout_by_area(self, t: NDArray[np.float64], path: AreaPath, asked: NDArray[np.bool_]) -> Layout:
        """What is known of the motion along "area" between neighbouring times, at the vertices asked for, (n, k-1)."""
        cells = with_ancestors(self._corners, self._children, asked)
        e = root_base(self._start[0], self._end[0], False, t)
        z = area_thirds(self._children, e, t, *path, cells)
        low, high, slow, fast, near, far = area_bounds(self._children, z, np.abs(e), t, *path, cells)
        sums = largest_sums(self._corners, z, high, slow, fast, t, cells)
        return Layout(low, high, near, far, 2 * np.pi - sums)

    def _layout(self, t: NDArray[np.float64]) -> Layout:
        """What is known of the motion between neighbouring times."""
        if self._path == "area":
            return self._layout_by_area(t, self.area_path, np.ones((len(self.source), len(t) - 1), dtype=np.bool_))
        slack = (1 - t)[:, None] * self._slack[0] + t[:, None] * self._slack[1]
        slack = np.minimum(slack[:-1], slack[1:]).T.copy()
        low, high = self._all_bounds(t)
        if len(self._budgeted):
            within_budgets(low, high, self._budgeted, *self.budgets, t)
        return Layout(low, high, *self._base_lengths(t, None if len(self._budgeted) else self._path), slack)

    def _base_lengths(self, t: NDArray[np.float64], path: Path | None) -> Bounds:
        """Bounds of the lengths of bases between neighbouring times, nan where they are to be carried down the tree."""
        lengths = np.full((len(self._corners), len(t)), np.nan)
        rows = slice(None) if path == "metric" else slice(0, 1)
        ends = [np.abs(corners[rows, 1] - corners[rows, 0])[:, None] for corners in (self._start, self._end)]
        if self._path == "metric":
            lengths[rows] = np.hypot(np.sqrt(1 - t) * ends[0], np.sqrt(t) * ends[1])
        else:
            lengths[rows] = (1 - t) * ends[0] + t * ends[1]
        least, greatest = np.minimum(lengths[:, :-1], lengths[:, 1:]), np.maximum(lengths[:, :-1], lengths[:, 1:])
        return least * (1 - _ROUNDING), greatest * (1 + _ROUNDING)

    def _largest_angles(self, t: NDArray[np.float64], rows: NDArray[np.int64]) -> NDArray[np.float64]:
        """Bounds of the angles at a, b, c of triangles, in tree order, between neighbouring times, (r, 3, k-1)."""
        if len(rows) == len(self._corners):
            first = self._all_bounds(t)
            if self._alone:
                self._first_bounds = t, first
            return first[1].copy()
        source, target = (z[rows] for z in self._thirds)
        return angle_bounds(self._path, source, target, self._propagates[rows], self._stretch[rows], t, False)[1]

    def _all_bounds(self, t: NDArray[np.float64]) -> Bounds:
        """Bounds of all angles between neighbouring times; both proofs begin with the same times."""
        if self._first_bounds is not None and np.array_equal(t, self._first_bounds[0]):
            low, high = self._first_bounds[1]
            self._first_bounds = None
            return low, high
        return angle_bounds(self._path, *self._thirds, self._propagates, self._stretch, t)

    def _angles_at(self, t: NDArray[np.float64], path: AreaPath) -> NDArray[np.float64]:
        """Angles at a, b, c of every triangle in tree order along the path "area", (m, 3, k)."""
        return np.asarray(corner_angles(self._lay_out(t, path)[1]))

    def _lay_out(
        self, t: NDArray[np.float64], path: AreaPath | None
    ) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        if path is not None:
            z = np.empty((len(self._corners), len(t)), np.complex128)
        else:
            z = third_vertices(self._path, *self._thirds, self._propagates, self._stretch, t)
        e = root_base(self._start[0], self._end[0], self._path == "metric", t)
        budgets = self.budgets if len(self._budgeted) else None
        shapes = hang(self._corners, self._children, z, e, t, path, budgets)
        return shapes, z


def _too_short(intervals: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which intervals are divided no more; close to an end, where areas may change quickly, they are for longer."""
    start, stop = intervals.T
    away = np.minimum(start, 1.0 - stop)
    return np.asarray(stop - start < np.where(away == 0.0, _LEAST, np.minimum(_SHORTEST, away / 16.0)))


def _parts(start: float, stop: float) -> NDArray[np.float64]:
    """An interval in four; a short one at an end in a geometric progression towards that."""
    if stop - start < _SHORTEST:
        return cut(start, stop)
    knots = np.linspace(start, stop, 5)
    return np.stack([knots[:-1], knots[1:]], axis=1)


def left_below_full_turn(T: Triangulation) -> NDArray[np.float64]:
    """What every vertex has left below 2 pi.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of float64, shape (n,)
        Radians.
    """
    return left_over(T.triangles, base_angles(_third(_complex(T.points)[T.triangles])))


def root_triangle(root: str | int, *shapes: Triangulation) -> int:
    """Choose the root triangle.

    Parameters
    ----------
    root : {"disk-center", "tree-center"} or int
    *shapes : Triangulation
        With the same triangles.

    Returns
    -------
    int

    Raises
    ------
    ValueError
        For any other root.

    References
    ----------
    Mukherjee and Gopi, Section 7, "Discussion".
    """
    if root == "disk-center":
        return disk_center(*shapes)
    if root == "tree-center":
        return tree_center(shapes[0])
    last = len(shapes[0].triangles) - 1
    if isinstance(root, (bool, np.bool_)) or root not in range(last + 1):
        raise ValueError(f"root is {root!r}, expected 'disk-center', 'tree-center' or a triangle from 0 to {last}")
    return int(root)


def _complex(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return np.ascontiguousarray(points).view(np.complex128)[:, 0]


def _corners_from_base(triangles: NDArray[np.int64], tree: RootedTree) -> NDArray[np.int64]:
    """Corners a, b, c of each triangle in tree order, ab being its base; shape (m, 3)."""
    slots = (tree.base[tree.order, None] + np.arange(3)) % 3
    return triangles[tree.order[:, None], slots]


def _propagates(twin: NDArray[np.int64], tree: RootedTree) -> NDArray[np.bool_]:
    """Whether edge ca, and edge bc, of each triangle in tree order has a child; shape (m, 2)."""
    slots = (tree.base[tree.order, None] + np.array([2, 1])) % 3
    return twin[tree.order[:, None], slots] >= 0


def _third(corners: NDArray[np.complex128]) -> NDArray[np.complex128]:
    a, b, c = corners.T
    z: NDArray[np.complex128] = (c - a) / (b - a)
    z.imag = np.maximum(z.imag, _THINNEST * np.abs(z))  # positive triangles, whatever rounding made of the thinnest
    return z


def _areas(start: NDArray[np.complex128], end: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Twice the area at both ends, shape (m, 2)."""
    return np.stack([np.abs(c[:, 1] - c[:, 0]) ** 2 * _third(c).imag for c in (start, end)], axis=1)

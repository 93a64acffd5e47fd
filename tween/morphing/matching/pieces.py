r"""One level of large curves piece by piece: cut along diagonals of the coarser triangulation, each piece on its own.

A diagonal of the coarser triangulation whose ends are still positions, and which is still straight in both finer disks,
is *pinned*: both curves are cut open along it, and it is matched with itself.  What lies between pinned diagonals is a
*piece*, a disk in itself, with a table of its own.  So a level takes time in proportion to its vertices, a piece that
cannot be matched asks for more effort only there, and where that does not help it grows by its neighbours.  Pinned
diagonals are others at every level, so that none stays for good.

          u ------- v        the part from u to v is one piece, with the chord (v, u) for an edge,
         /  piece    \       the rest is in others, with the chord (u, v) for an edge
        ...         ...

Legend: ``u v`` nodes of the coarser level, numbered along the source; ``t`` its triangles; ``h`` half-edges
``3 t + s``.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.morphing.matching.chords import (
    PIECE,
    ROUND,
    STRAIGHT,
    Chords,
    Disk,
    Positions,
    boundary,
    find_chords,
    find_splits,
)
from tween.morphing.matching.given import Landmarks
from tween.morphing.matching.kernels import Side, Windows, fill, follow, wholes
from tween.morphing.matching.levels import SAME, Correspondence, Effort, band_around, positions_at
from tween.morphing.matching.reach import near_pairs
from tween.morphing.matching.shape import Shape

_WEIGHT = 160  # positions of both curves, from which on a piece is cut off
_ROUNDS = 2  # of growth
_SAME = 5e-10  # of the curve's length: a position so near to a node is that node; positions are farther apart
_Ints = NDArray[np.int64]
_Floats = NDArray[np.float64]


class Part(NamedTuple):
    """What the table of one piece found.

    Attributes
    ----------
    arcs : ndarray of float64, shape (k, 2)
        Where its nodes are on the source, and on the target.
    vertices : ndarray of int, shape (k, 2)
        -1 where a candidate was used.
    points : ndarray of float64, shape (k, 2, 2)
    triangles : ndarray of int, shape (k-2, 3)
    cost : float
    """

    arcs: _Floats
    vertices: _Ints
    points: _Floats
    triangles: _Ints
    cost: float


def next_level_in_pieces(
    S: Shape,
    T: Shape,
    sizes: tuple[int, int],
    last: Correspondence,
    nodes: Landmarks,
    efforts: tuple[Effort, ...],
) -> Correspondence | None:
    """Solve a level near a coarser correspondence, piece by piece.

    Parameters
    ----------
    S, T : Shape
    sizes : (int, int)
        Numbers of vertices to which the two are simplified.
    last : Correspondence
        Of the coarser level.
    nodes : Landmarks
        What has to be matched.
    efforts : tuple of Effort
        For each piece one after the other, until it can be matched.

    Returns
    -------
    Correspondence or None
        None where a piece cannot be matched, even when it has grown.

    Notes
    -----
    O(n) for n vertices, in memory too.
    """
    finer = _Finer(S, T, sizes, last, nodes)
    piece = finer.cut(efforts[0])
    found: dict[int, Part | None] = {}
    for _ in range(_ROUNDS + 1):
        for label in np.unique(piece).tolist():
            if label not in found:
                found[label] = finer.solve(np.flatnonzero(piece == label), efforts)
        failed = [label for label, part in found.items() if part is None]
        if not failed:
            return _joined([part for part in found.values() if part is not None], S.arc[finer.levels[0].kept[0]])
        grown = _grown(piece, last.twin, failed)
        if grown is None:
            break
        piece, efforts = grown, efforts[-2:]
        found = {label: part for label, part in found.items() if part is not None and (piece == label).any()}
    return None


def _grown(piece: _Ints, twin: _Ints, failed: list[int]) -> _Ints | None:
    """Unite pieces that failed with their neighbours, under new labels; None where one has none."""
    grown, new = piece.copy(), int(piece.max()) + 1
    inner = np.flatnonzero(twin >= 0)
    here, there = inner // 3, twin[inner] // 3
    for label in failed:
        own = np.flatnonzero(piece == label)
        now = np.isin(grown, np.unique(grown[own]))
        now[there[now[here]]] = True
        united = np.isin(grown, np.unique(grown[now]))
        if united.sum() == len(own):
            return None
        grown[united], new = new, new + 1
    return grown


def _joined(parts: list[Part], start: float) -> Correspondence:
    """Number the nodes of all pieces along the source; those of pinned diagonals occur in several."""
    arcs, vertices, points = (np.concatenate(rows) for rows in zip(*(part[:3] for part in parts), strict=True))
    first = np.cumsum([0, *(len(part.arcs) for part in parts)])
    triangles = np.concatenate([part.triangles + k for part, k in zip(parts, first, strict=False)])
    _, place, number = np.unique((arcs[:, 0] - start) % 1.0, return_index=True, return_inverse=True)
    (s, t), (v, w) = arcs[place].T, vertices[place].T
    cost = float(sum(part.cost for part in parts))
    return Correspondence(s, t, v, w, points[place, 0], points[place, 1], number.ravel()[triangles], cost)


class _Finer:
    """Both curves at the finer level, beside the coarser correspondence."""

    def __init__(self, S: Shape, T: Shape, sizes: tuple[int, int], last: Correspondence, nodes: Landmarks) -> None:
        self.shapes, self.last = (S, T), last
        self.levels = S.level(sizes[0]), T.level(sizes[1])
        self.disks: list[Disk] = [shape.disk(level) for shape, level in zip((S, T), self.levels, strict=True)]
        self.landmark = np.isin(last.source_vertices, nodes.source)
        self._known: dict[tuple[float, int], tuple[tuple[Positions, Positions], _Ints]] = {}

    def positions(self, effort: Effort) -> tuple[tuple[Positions, Positions], _Ints]:
        """Positions of both curves, and which of them each node is, -1 where it gave way to a vertex."""
        key = effort.merge, effort.even
        if key not in self._known:
            positions = positions_at(self.shapes, self.levels, self.last, effort)
            arcs = self.last.source_arc, self.last.target_arc
            rows = [_rows(place.arc, arc) for place, arc in zip(positions, arcs, strict=True)]
            self._known[key] = positions, np.array(rows)
        return self._known[key]

    def cut(self, effort: Effort) -> _Ints:
        """Label each triangle of the coarser level by its piece."""
        positions, rows = self.positions(effort)
        triangles, twin = self.last.triangles, self.last.twin
        h = np.flatnonzero(twin >= 0)
        start, end = triangles.ravel()[h], np.roll(triangles, -1, axis=1).ravel()[h]
        known = (rows[:, start] >= 0).all(axis=0) & (rows[:, end] >= 0).all(axis=0)
        h, start, end = h[known], start[known], end[known]
        fit = np.zeros(len(twin), dtype=np.bool_)
        straight = [_straight(*side) for side in zip(positions, self.disks, rows[:, start], rows[:, end], strict=True)]
        fit[h[straight[0] & straight[1]]] = True
        places = self.last.source_arc, self.last.target_arc
        weight = np.sum([_counts(p.arc, arc) for p, arc in zip(positions, places, strict=True)], axis=0)
        return _labels(triangles, twin, fit, weight)

    def solve(self, triangles: _Ints, efforts: tuple[Effort, ...]) -> Part | None:
        """Match one piece, with more and more effort until it can be matched."""
        for effort in efforts:
            part = self._solve(triangles, effort, efforts[0])
            if part is not None:
                return part
        return None

    def _solve(self, triangles: _Ints, effort: Effort, pins: Effort) -> Part | None:
        corners = self.last.triangles[triangles]
        nodes = np.unique(corners)
        after = np.roll(nodes, -1)
        pinned = after != (nodes + 1) % len(self.last.source_arc)
        ends = np.stack([nodes[pinned], after[pinned]])
        if (self.positions(effort)[1][:, ends] < 0).any():
            return None
        mesh = np.searchsorted(nodes, corners), _local_twin(self.last.twin, triangles)
        places, sides, known = [], [], []
        for k, (arc, points) in enumerate(self.last.places):
            place, local = self._local(k, ends, effort, pins)
            row = self.positions(effort)[1][k]
            pairs = near_pairs(place.arc, arc[nodes], points[nodes], *mesh, effort.steps, effort.most)
            chords = find_chords(place, self.disks[k], *pairs, k == 0)
            chords = _with_edges(chords, np.searchsorted(local, row[ends]), len(local))
            splits, first, middle = find_splits(place, chords, self.disks[k].flat, k == 0)
            sides.append(Side(chords, splits, first, middle, place.arc))
            places.append(place)
            known.append(np.searchsorted(local, row[np.append(ends, nodes[self.landmark[nodes]])]))
        windows = _restricted(band_around(places[0], places[1], self.last, effort.band), places, known)
        return self._filled(places, sides[0], sides[1], windows)

    def _local(self, k: int, ends: _Ints, effort: Effort, pins: Effort) -> tuple[Positions, _Ints]:
        """The positions of a piece, and their numbers in the whole; pins stay to the last bit, whatever the effort."""
        positions, rows = (found[k] for found in self.positions(effort))
        exact, exact_rows = (found[k] for found in self.positions(pins))
        start, end = rows[ends]
        local = _between(len(positions.arc), np.roll(end, 1), start)
        part = _taken(positions, local)
        for column, right in zip(part, exact, strict=True):
            column[np.searchsorted(local, rows[ends])] = right[exact_rows[ends]]
        return part, local

    def _filled(self, places: list[Positions], source: Side, target: Side, windows: Windows) -> Part | None:
        table = fill(source, target, windows, 0.0)
        cost, whole = wholes(source, target, windows, table, 0.0)
        best = int(np.argmin(np.round(cost / SAME)))
        if not np.isfinite(cost[best]):
            return None
        return self._part(places, follow(source, target, windows, table, *whole[best]), float(cost[best]))

    def _part(self, places: list[Positions], rows: _Ints, cost: float) -> Part:
        used, first = np.unique(rows[:, :3], return_index=True)
        both = used, rows[:, 3:].ravel()[first]
        arcs = np.stack([p.arc[at] for p, at in zip(places, both, strict=True)], axis=1)
        points = np.stack([p.points[at] for p, at in zip(places, both, strict=True)], axis=1)
        vertices = [
            np.where(p.vertex[at] < 0, -1, level.kept[p.vertex[at]])
            for p, level, at in zip(places, self.levels, both, strict=True)
        ]
        return Part(arcs, np.stack(vertices, axis=1), points, np.searchsorted(used, rows[:, :3]), cost)


def _rows(arc: _Floats, wanted: _Floats) -> _Ints:
    """The positions at given places, -1 where there is none."""
    ahead, places = (arc - arc[0]) % 1.0, (wanted - arc[0]) % 1.0
    right = np.searchsorted(ahead, places)
    near = np.stack([right - 1, right]) % len(arc)
    away = np.abs((arc[near] - wanted + 0.5) % 1.0 - 0.5)
    return np.where(away.min(axis=0) < _SAME, np.where(away[0] < away[1], near[0], near[1]), -1)


def _counts(arc: _Floats, nodes: _Floats) -> _Ints:
    """How many positions lie between each node and the next."""
    ahead = np.sort((arc - nodes[0]) % 1.0)
    first = np.searchsorted(ahead, (nodes - nodes[0]) % 1.0)
    return np.diff(np.append(first, len(arc)))


def _straight(positions: Positions, disk: Disk, start: _Ints, end: _Ints) -> NDArray[np.bool_]:
    """Whether pairs of positions are joined by straight chords."""
    count, order = len(positions.arc), np.argsort(start, kind="stable")
    first = np.searchsorted(start[order], np.arange(count + 1))
    chords = find_chords(positions, disk, first, end[order].astype(np.int32), False)
    seen = chords.kind == STRAIGHT
    return np.isin(start * count + end, chords.start[seen].astype(np.int64) * count + chords.end[seen])


def _labels(triangles: _Ints, twin: _Ints, fit: NDArray[np.bool_], weight: _Ints) -> _Ints:
    """Cut the dual tree from its leaves up as soon as what hangs below a fitting diagonal weighs enough."""
    root = int(boundary(triangles, twin)[-1]) // 3  # before the gap in which the source is cut open
    order, up = [root], np.full(len(triangles), -1, dtype=np.int64)
    for t in order:
        for h in range(3 * t, 3 * t + 3):
            if twin[h] >= 0 and h != up[t]:
                up[twin[h] // 3] = twin[h]
                order.append(int(twin[h]) // 3)
    below, cut = np.zeros(len(triangles), dtype=np.int64), np.zeros(len(triangles), dtype=np.bool_)
    for t in reversed(order):
        below[t] += sum(weight[triangles[t, s]] for s in range(3) if twin[3 * t + s] < 0)
        cut[t] = t == root or (below[t] >= _WEIGHT and fit[up[t]])
        if not cut[t]:
            below[twin[up[t]] // 3] += below[t]
    label = np.arange(len(triangles))
    for t in order:
        if not cut[t]:
            label[t] = label[twin[up[t]] // 3]
    return label


def _taken(p: Positions, rows: _Ints) -> Positions:
    return Positions(p.points[rows], p.scaled[rows], p.vertex[rows], p.edge[rows], p.lines[rows], p.arc[rows])


def _between(count: int, start: _Ints, end: _Ints) -> _Ints:
    """The positions from each start to its end, both included, in order; all where there are none."""
    if len(start) == 0:
        return np.arange(count)
    runs = [np.arange(a, a + (b - a) % count + 1) % count for a, b in zip(start.tolist(), end.tolist(), strict=True)]
    return np.unique(np.concatenate(runs))


def _local_twin(twin: _Ints, triangles: _Ints) -> _Ints:
    """Half-edges across, in the numbers of a piece; -1 on its border."""
    across = twin.reshape(-1, 3)[triangles]
    place = np.searchsorted(triangles, across // 3) % len(triangles)
    inside = (across >= 0) & (triangles[place] == across // 3)
    local = np.where(inside, 3 * place + across % 3, -1).ravel()
    local.setflags(write=False)  # as those of triangulations are: one compilation of the walks serves both
    return local


def _with_edges(chords: Chords, ends: _Ints, count: int) -> Chords:
    """Make pinned diagonals edges: nothing remains to be done from start to end, and all from end to start."""
    after = np.full(count, -1, dtype=np.int64)
    after[ends[0]] = ends[1]
    kind = chords.kind.copy()
    kind[after[chords.start] == chords.end] = PIECE
    kind[after[chords.end] == chords.start] = ROUND
    return chords._replace(kind=kind)


def _restricted(windows: Windows, places: list[Positions], fixed: list[_Ints]) -> Windows:
    """Say which nodes there are: one of the two a vertex, and of fixed ones only their own pair."""
    source, target = places
    wide = int(windows.width.max())
    partner = (windows.low[:, None] + np.arange(wide)) % len(target.arc)
    allowed = (source.vertex[:, None] >= 0) | (target.vertex[partner] >= 0)
    allowed &= np.arange(wide) < windows.width[:, None]
    taken = np.zeros(len(target.arc), dtype=np.bool_)
    taken[fixed[1]] = True
    own = allowed[fixed[0]] & (partner[fixed[0]] == fixed[1][:, None])
    allowed &= ~taken[partner]
    allowed[fixed[0]] = own
    return Windows(windows.low, windows.width, allowed)

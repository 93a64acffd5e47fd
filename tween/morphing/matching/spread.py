r"""Where the last levels cannot be matched: all vertices by a coarser correspondence, each curve with own triangles.

The nodes of the coarser level are kept; every other vertex gets its image on the other curve as a partner.
"""

import numpy as np
from numpy.typing import NDArray

from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.morphing.matching.levels import Correspondence
from tween.morphing.matching.shape import Shape
from tween.triangulating.decomposition import triangulate
from tween.triangulating.flips import remesh

_SAME = 1e-9  # of the curve's length: an image this near to a vertex is that vertex
_Floats = NDArray[np.float64]
_Ints = NDArray[np.int64]


def spread(S: Shape, T: Shape, coarse: Correspondence | None) -> tuple[Correspondence, Triangulation, Triangulation]:
    """Give every vertex of either shape a partner on the other.

    Parameters
    ----------
    S, T : Shape
    coarse : Correspondence or None
        Without one, places of equal arc correspond.

    Returns
    -------
    Correspondence
        Whose triangles are the source's.
    source, target : Triangulation
        With equally many vertices, their triangles as a rule not the same.
    """
    coarse = coarse or _by_arc(S, T)
    pairs = _partners(S, T, coarse)
    start = pairs[0, 0]
    order = np.argsort((pairs[:, 0] - start) % 1.0, kind="stable")
    s, t = pairs[order, 0], pairs[order, 1]
    v, w = pairs[order, 2].astype(np.int64), pairs[order, 3].astype(np.int64)
    p, q = _places(S, s, v), _places(T, t, w)
    source, target = _mesh(S, p, v), _mesh(T, q, w)
    return Correspondence(s, t, v, w, p, q, source.triangles, coarse.cost), source, target


def _by_arc(S: Shape, T: Shape) -> Correspondence:
    zero, none = np.zeros(1), np.empty((0, 3), dtype=np.int64)
    first = np.zeros(1, dtype=np.int64)
    return Correspondence(
        zero, zero, first, first, S.triangulation.points[:1], T.triangulation.points[:1], none, np.inf
    )


def _partners(S: Shape, T: Shape, coarse: Correspondence) -> _Floats:
    """Rows of source arc, target arc, source vertex, target vertex; vertex 0 of the first node first."""
    both = (coarse.source_vertices >= 0) & (coarse.target_vertices >= 0)
    x, a = coarse.source_vertices[both], coarse.target_vertices[both]
    rows = [np.stack([S.arc[x], T.arc[a], x, a], axis=1).astype(np.float64)]
    free = np.setdiff1d(np.arange(len(S)), x)
    images = coarse.to_target(S.arc[free])
    rows.append(np.stack([S.arc[free], images, free, np.full(len(free), -1)], axis=1))
    free = np.setdiff1d(np.arange(len(T)), a)
    images = coarse.to_source(T.arc[free])
    rows.append(np.stack([images, T.arc[free], np.full(len(free), -1), free], axis=1))
    return _merged(np.concatenate(rows), coarse)


def _merged(rows: _Floats, coarse: Correspondence) -> _Floats:
    """Make one of two rows that mean the same place."""
    start = coarse.source_arc[0]
    rows = rows[np.argsort((rows[:, 0] - start + _SAME) % 1.0, kind="stable")]
    merged: list[_Floats] = []
    for row in rows:
        if merged and abs(row[0] - merged[-1][0]) < _SAME and ((row[2:] < 0) != (merged[-1][2:] < 0)).all():
            last = merged[-1]
            own = row if row[2] >= 0 else last
            other = last if row[2] >= 0 else row
            merged[-1] = np.array([own[0], other[1], own[2], other[3]])
        else:
            merged.append(row)
    return np.array(merged)


def _places(shape: Shape, arc: _Floats, vertex: _Ints) -> _Floats:
    """The points of vertices and of places on the edges between them, these evenly spaced where they would coincide."""
    points, n, count = shape.triangulation.points, len(shape), len(arc)
    result = np.where(vertex[:, None] >= 0, points[np.maximum(vertex, 0)], 0.0)
    corners = np.flatnonzero(vertex >= 0)
    for here, there in zip(corners, np.roll(corners, -1), strict=True):
        inner = (there - here) % count - 1 if len(corners) > 1 else count - 1
        if inner == 0:
            continue
        rows = (here + 1 + np.arange(inner)) % count
        a, b = points[vertex[here]], points[(vertex[here] + 1) % n]
        length = (shape.arc[(vertex[here] + 1) % n] - shape.arc[vertex[here]]) % 1.0
        share = ((arc[rows] - shape.arc[vertex[here]]) % 1.0) / length
        if np.diff(np.concatenate([[0.0], share, [1.0]])).min() < _SAME:
            share = np.arange(1, inner + 1) / (inner + 1)
        result[rows] = a + share[:, None] * (b - a)
    return result


def _mesh(shape: Shape, points: _Floats, vertex: _Ints) -> Triangulation:
    """The shape's own triangles, fans where points were inserted on their edges."""
    n, count = len(shape), len(points)
    row = np.empty(n, dtype=np.int64)
    row[vertex[vertex >= 0]] = np.flatnonzero(vertex >= 0)
    rows = []
    for t in shape.triangulation.triangles.tolist():
        corners = []
        for v, w in zip(t, t[1:] + t[:1], strict=True):
            corners.append(int(row[v]))
            if w == (v + 1) % n:
                corners += [int(row[v] + k) % count for k in range(1, int(row[w] - row[v]) % count)]
        rows += _fans(corners, points)
    try:
        return remesh(Triangulation(points, np.array(rows)).validate())
    except ValueError:
        return triangulate(Curve(points))


def _fans(corners: list[int], points: _Floats) -> list[tuple[int, int, int]]:
    """Cut ears off a triangle with points on its sides, largest first."""
    rows = []
    while len(corners) > 3:
        k = len(corners)
        triples = [(corners[i - 1], corners[i], corners[(i + 1) % k]) for i in range(k)]
        areas = []
        for a, b, c in triples:
            u, w = points[b] - points[a], points[c] - points[a]
            areas.append(u[0] * w[1] - u[1] * w[0])
        best = int(np.argmax(areas))
        rows.append(triples[best])
        del corners[best]
    return [*rows, (corners[0], corners[1], corners[2])]

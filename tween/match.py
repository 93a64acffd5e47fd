r"""Matching two shapes: the best correspondence and the best common triangulation together.

A *match* gives both curves the same vertices and the same triangles: every vertex of either curve, and points inserted
on the edges of one opposite vertices of the other.  Of all correspondences, insertions among candidates and
triangulations it takes those of least energy: exactly, by one table, on curves of few vertices (`tween.match_kernels`);
level by level from simplified curves on others (`tween.match_levels`).

The energy of the map between the shapes is the symmetric Dirichlet energy, both scaled to area 1.  Of a triangle of area
A mapped affinely to one of area B, with singular values in the ratio k, it is (A + B) (k + 1/k).  So 4 is the least in
all, reached where every triangle keeps its shape.

References
----------
Mukherjee and Gopi, Section 8, leave open how "to align multiple features, and retriangulate the curve based on this alignment".
J. Smith and S. Schaefer, *Bijective parameterization with free boundaries*, ACM Transactions on Graphics 34 (2015): the energy.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.curve import Curve, as_curve, turning_number
from tween.decomposition import decompose
from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.flips import remesh
from tween.match_levels import Landmarks, Shape
from tween.match_search import Found, search
from tween.match_spread import spread
from tween.predicates import orient2d
from tween.triangulation import Triangulation

_MOST_DISKS = 6  # of one curve that are tried


@dataclass(frozen=True)
class Match:
    """Two shapes with the same vertices and the same triangles.

    Attributes
    ----------
    source, target : Triangulation
        Vertex i of one is vertex i of the other.  Where `complete`, the triangles are the same.
    energy : float
        Symmetric Dirichlet energy of the map between them, both scaled to area 1; 4 at least.  Where not `complete`,
        that of the last level that could be matched.
    exact : bool
        Whether the energy is the least of all correspondences, insertions among the candidates and triangulations, or
        that of a refinement.
    complete : bool
        Whether all vertices have a common triangulation.  If not, the correspondence still holds, but the triangles of
        the two shapes differ.
    source_vertices, target_vertices : ndarray of int, shape (n,)
        Which vertex of the input each vertex is; -1 where it was inserted.
    source_arc, target_arc : ndarray of float64, shape (n,)
        Where each vertex lies along the input, as a share of the curve's length from its vertex 0.
    levels : tuple of (int, int, float)
        Vertices of the source, vertices of the target and energy at every level, the coarsest first.
    source_disk, target_disk : int
        Which of the disks that the curve bounds it is, in the order of `Decomposition.immersions`; 0 where a
        triangulation was given.
    """

    source: Triangulation
    target: Triangulation
    energy: float
    exact: bool
    complete: bool
    source_vertices: NDArray[np.int64]
    target_vertices: NDArray[np.int64]
    source_arc: NDArray[np.float64]
    target_arc: NDArray[np.float64]
    levels: tuple[tuple[int, int, float], ...]
    source_disk: int
    target_disk: int

    def __repr__(self) -> str:
        how = "exact" if self.exact else "refined" if self.complete else "incomplete"
        return f"Match({len(self.source)} vertices, energy {self.energy:.6g}, {how})"


def match(source: Any, target: Any, landmarks: Sequence[tuple[int, int]] | None = None) -> Match:
    """Find the best correspondence and the best common triangulation of two shapes.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        A triangulation says which immersed disk is meant.  Of a curve that bounds several, the one that matches best.
    landmarks : sequence of (int, int), optional
        Pairs of vertices, one of the source and one of the target, that must be matched.

    Returns
    -------
    Match

    Raises
    ------
    NotSelfOverlappingError
        Where a curve bounds no immersed disk; the message says which one, and why.
    IncompatibleError
        Where landmarks are no pairs of vertices, occur twice, or are not in the same order around both curves.

    Notes
    -----
    Up to 24 vertices each, one table decides, with evenly spaced candidates on every edge, and the answer is `exact`.
    Larger curves are simplified first.

    Examples
    --------
    >>> a = match([[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 0], [0, -2], [1, -2], [1, 0]])
    >>> a.exact, round(a.energy, 9), a.target_vertices[a.source_vertices >= 0].tolist()
    (True, 4.0, [2, 3, 0, 1])
    """
    first, second = _Given(source, "source"), _Given(target, "target")
    pairs = _checked(landmarks, first, second)
    shapes = [[Shape(T, g.fixed(rows)) for T in g.disks] for g, rows in ((first, pairs[:, 0]), (second, pairs[:, 1]))]
    found = search(shapes[0], shapes[1], Landmarks(pairs[:, 0], pairs[:, 1]))
    return _as_match(first, second, shapes, found)


class _Given:
    """An input: the disks that it bounds, and which row of it each vertex is."""

    def __init__(self, shape: Any, name: str) -> None:
        self.name = name
        if isinstance(shape, Triangulation):
            shape.validate()
            self.rows, self.disks = np.arange(len(shape)), [remesh(shape)]
            return
        curve = as_curve(shape)
        self.rows = np.arange(len(curve)) if isinstance(shape, Curve) else curve.origin.astype(np.int64)
        answer = decompose(curve)
        if not answer:
            raise NotSelfOverlappingError(f"the {name} bounds no immersed disk: {answer.reason}")
        self.disks = [remesh(T) for T in answer.immersions()[:_MOST_DISKS]]

    def fixed(self, vertices: NDArray[np.int64]) -> NDArray[np.bool_]:
        mask = np.zeros(len(self.rows), dtype=np.bool_)
        mask[vertices] = True
        return mask


def _checked(landmarks: Sequence[tuple[int, int]] | None, source: _Given, target: _Given) -> NDArray[np.int64]:
    return np.empty((0, 2), dtype=np.int64)


def _as_match(first: _Given, second: _Given, shapes: list[list[Shape]], found: Found) -> Match:
    S, T = shapes[0][found.disks[0]], shapes[1][found.disks[1]]
    c = found.correspondence
    source, target, complete = None, None, found.complete
    if complete:
        assert c is not None
        source, target = Triangulation(c.source_points, c.triangles), Triangulation(c.target_points, c.triangles)
        complete = is_valid(source, target)
    if not complete:
        c, source, target = spread(S, T, c)
    assert c is not None and source is not None and target is not None
    return Match(
        source,
        target,
        energy(source, target) if complete else found.levels[-1][2] if found.levels else np.inf,
        complete and len(found.levels) == 1,
        complete,
        np.where(c.source_vertices < 0, -1, first.rows[c.source_vertices]),
        np.where(c.target_vertices < 0, -1, second.rows[c.target_vertices]),
        c.source_arc,
        c.target_arc,
        found.levels,
        *found.disks,
    )


def energy(source: Triangulation, target: Triangulation) -> float:
    """Symmetric Dirichlet energy of the map between two shapes with the same triangles, both scaled to area 1.

    Parameters
    ----------
    source, target : Triangulation

    Returns
    -------
    float
        4 at least.

    Notes
    -----
    With edges e1, e2 and images f1, f2 as complex numbers and twice the areas p, q of a triangle, p + q +
    abs(f1 e2 - f2 e1)**2 (1/p + 1/q) / 2: no term is negative, and the last one vanishes for similar triangles.
    """
    excess = 0.0
    edges, crosses = [], []
    for T in (source, target):
        z = (T.points - T.points[0]) @ np.array([1.0, 1.0j])
        z = z / np.abs(z).max()
        corners = z[T.triangles]
        e1, e2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1]
        cross = (e1.conj() * e2).imag
        edges.append((e1, e2, 0.5 * cross.sum()))
        crosses.append(cross)
    (e1, e2, a), (f1, f2, b) = edges
    away = np.abs(f1 * e2 - f2 * e1) ** 2 / (a * b)
    excess = float(np.sum(away * 0.5 * (a / crosses[0] + b / crosses[1])))
    return 4.0 + excess


def is_valid(source: Triangulation, target: Triangulation) -> bool:
    """Whether the same triangles are counter-clockwise in both shapes and both curves turn once, exactly."""
    for T in (source, target):
        if (orient2d(*np.moveaxis(T.points[T.triangles], 1, 0)) <= 0).any() or turning_number(T.points) != 1:
            return False
    return True

r"""Matching two shapes: the best correspondence and the best common triangulation together.

A *match* gives both curves the same vertices and the same triangles: every vertex of either curve, and points inserted
on the edges of one opposite vertices of the other.  Of all correspondences, insertions among candidates and
triangulations it takes those of least energy: exactly, by one table, on curves of few vertices (`.kernels`);
level by level from simplified curves on others (`.levels`), large ones piece by piece
(`tween.morphing.matching.pieces`).

The energy of the map between the shapes is the symmetric Dirichlet energy, both scaled to area 1.  Of a triangle of
area A mapped affinely to one of area B, with singular values in the ratio k, it is (A + B) (k + 1/k).  So 4 is the
least in all, reached where every triangle keeps its shape.

References
----------
Mukherjee and Gopi, Section 8, leave open how "to align multiple features, and retriangulate the curve based on this
alignment". J. Smith and S. Schaefer, *Bijective parameterization with free boundaries*, ACM Transactions on Graphics
34 (2015): the energy.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tween.errors import IncompatibleError
from tween.geometry.curve import turning_number
from tween.geometry.predicates import orient2d
from tween.geometry.triangulation import Triangulation, canonical
from tween.morphing.matching.given import Given, Landmarks, checked_landmarks
from tween.morphing.matching.levels import Correspondence
from tween.morphing.matching.search import Found, search
from tween.morphing.matching.shape import Shape
from tween.morphing.matching.spread import spread


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


def match(
    source: Any, target: Any, landmarks: Sequence[tuple[int, int]] | None = None, *, candidates: int | None = None
) -> Match:
    """Find the best correspondence and the best common triangulation of two shapes.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        A triangulation says which immersed disk is meant.  Of a curve that bounds several (of the first six), the one
        that matches best.
    landmarks : sequence of (int, int), optional
        Pairs of vertices, one of the source and one of the target, that must be matched.
    candidates : int, optional
        Evenly spaced candidates on every edge of both curves where all vertices fit into one table.  Without it, one;
        and more on the curve of fewer vertices, so that both have equally many positions or nearly so.

    Returns
    -------
    Match
        Starting at vertex 0 of the source.

    Raises
    ------
    NotSelfOverlappingError
        Where a curve bounds no immersed disk; the message says which one, and why.
    IncompatibleError
        Where landmarks are no pairs of vertices, occur twice, are not in the same order around both curves, or where no
        common triangulation that uses them is found, but one without them.

    Notes
    -----
    Up to 24 vertices each, one table decides and the answer is `exact`; where it finds nothing, more candidates are
    tried.  Larger curves are simplified first and refined level by level, in proportion to their vertices.  The energy
    does not depend on where the curves start, on their places, sizes and directions, or on which is the source.
    Energies that differ by less than 1e-9 are equal; of equally good correspondences the one that turns least is taken.
    Triangles flatter than rounding can tell take no part, unless a disk has thin ones itself (`.flatness`).
    Two curves of 100 vertices take less than a second.  Those of more than 400 are refined piece by piece
    (`tween.morphing.matching.pieces`), so that time and memory are proportional to their vertices: 4 to 25 s and
    300 MB for two smooth ones of 10,000.

    Examples
    --------
    >>> a = match([[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 0], [0, -2], [1, -2], [1, 0]])
    >>> a
    Match(4 vertices, energy 4, exact)
    >>> a.source_vertices.tolist(), a.target_vertices.tolist()
    ([0, 1, 2, 3], [0, 1, 2, 3])
    >>> match([[0, 0], [2, 0], [2, 1], [0, 1]], [[0, 0], [2, 0], [1, 2]], landmarks=[(0, 1)]).source_vertices.tolist()
    [0, 1, 2, 3]
    """
    first, second = Given(source, "source"), Given(target, "target")
    pairs = checked_landmarks(landmarks, first, second)
    if (len(second), second.key) < (len(first), first.key):
        answer = _answered(second, first, pairs[np.argsort(pairs[:, 1]), ::-1], candidates)
        answer = answer._replace(sides=answer.sides[::-1])
    else:
        answer = _answered(first, second, pairs, candidates)
    return _as_match(answer, first)


class _Part(NamedTuple):
    """One shape's part of the answer; its vertices and arcs are those of the input."""

    triangulation: Triangulation
    vertices: NDArray[np.int64]
    arc: NDArray[np.float64]
    disk: int
    counts: tuple[int, ...]


class _Answer(NamedTuple):
    sides: tuple[_Part, ...]
    energy: float
    complete: bool
    energies: tuple[float, ...]


def _answered(first: Given, second: Given, pairs: NDArray[np.int64], candidates: int | None) -> _Answer:
    """Search, and put the result into the numbers of the input."""
    given = (first, second)
    shapes = [[Shape(T, _mask(rows, len(g))) for T in g.disks] for g, rows in zip(given, pairs.T, strict=True)]
    found = search(shapes[0], shapes[1], Landmarks(*pairs.T), candidates)
    if len(pairs) and not found.complete:
        found = _without_landmarks(given, pairs, candidates) or found
    chosen = [options[disk] for options, disk in zip(shapes, found.disks, strict=True)]
    c, meshes, complete = _meshes(chosen, found)
    parts, arcs = [], (c.source_arc, c.target_arc)
    for k, vertices in enumerate((c.source_vertices, c.target_vertices)):
        rows = np.where(vertices < 0, -1, given[k].rows[vertices])
        arc = given[k].arc_from_input(arcs[k], chosen[k].arc)
        parts.append(_Part(meshes[k], rows, arc, found.disks[k], tuple(int(level[k]) for level in found.levels)))
    energies = tuple(level[2] for level in found.levels)
    least = energy(*meshes) if complete else energies[-1] if energies else np.inf
    return _Answer(tuple(parts), least, complete, energies)


def _mask(rows: NDArray[np.int64], n: int) -> NDArray[np.bool_]:
    mask = np.zeros(n, dtype=np.bool_)
    mask[rows] = True
    return mask


def _meshes(shapes: list[Shape], found: Found) -> tuple[Correspondence, list[Triangulation], bool]:
    """The two triangulations of the answer, and whether they have the same triangles, checked exactly."""
    c = found.correspondence
    if c is not None and found.complete:
        triangles = canonical(c.triangles)
        meshes = [Triangulation(points, triangles) for points in (c.source_points, c.target_points)]
        if is_valid(*meshes):
            return c, meshes, True
    c, source, target = spread(shapes[0], shapes[1], c)
    return c, [source, target], False


def _as_match(answer: _Answer, source: Given) -> Match:
    """Begin at row 0 of the source."""
    start = int(np.flatnonzero(answer.sides[0].vertices == 0)[0])
    rolled = [part.triangulation.rolled(start) for part in answer.sides]
    meshes = [Triangulation(T.points, canonical(T.triangles)) for T in rolled]
    first, second = answer.sides
    levels = tuple(zip(first.counts, second.counts, answer.energies, strict=True))
    return Match(
        meshes[0],
        meshes[1],
        answer.energy,
        exact=answer.complete and len(levels) == 1,
        complete=answer.complete,
        source_vertices=np.roll(first.vertices, -start),
        target_vertices=np.roll(second.vertices, -start),
        source_arc=np.roll(first.arc, -start),
        target_arc=np.roll(second.arc, -start),
        levels=levels,
        source_disk=first.disk,
        target_disk=second.disk,
    )


def _without_landmarks(given: tuple[Given, Given], pairs: NDArray[np.int64], candidates: int | None) -> Found | None:
    """What is found without the landmarks, if it has them all the same; where it has not, raise with what would work.

    Landmarks stay at every level, which may leave the coarse ones poor.
    """
    none = pairs[:0]
    shapes = [[Shape(T, _mask(none[:, 0], len(g))) for T in g.disks] for g in given]
    free = search(shapes[0], shapes[1], Landmarks(*none.T), candidates)
    if not free.complete or free.correspondence is None:
        return None
    c = free.correspondence
    if set(map(tuple, pairs.tolist())) <= set(zip(c.source_vertices.tolist(), c.target_vertices.tolist(), strict=True)):
        return free
    raise IncompatibleError(_what_would_work(given, pairs, c))


def _what_would_work(given: tuple[Given, Given], pairs: NDArray[np.int64], c: Correspondence) -> str:
    """Where the landmarks' vertices go without landmarks."""
    told = []
    # the shapes may stand exchanged here; messages speak of the source first
    exchanged = given[0].name == "target"
    for pair in pairs:
        rows = [int(g.rows[v]) for g, v in zip(given, pair, strict=True)]
        near = _partner(c, given[1], pair[0])
        told.append(((rows[1], rows[0]) if exchanged else (rows[0], rows[1]), rows[0], near))
    names = ", ".join(str(pair) for pair, _, _ in told)
    works = ", ".join(f"vertex {row} of the {given[0].name} with {near}" for _, row, near in told)
    return (
        f"no common triangulation was found that uses the landmarks {names}; without them there is one, which matches "
        f"{works} of the {given[1].name}"
    )


def _partner(c: Correspondence, other: Given, v: int) -> str:
    """Where a vertex of the first shape goes, in words."""
    place = int(np.flatnonzero(c.source_vertices == v)[0])
    if c.target_vertices[place] >= 0:
        return f"vertex {other.rows[c.target_vertices[place]]}"
    known = np.flatnonzero(c.target_vertices >= 0)
    before = int(known[known < place][-1]) if (known < place).any() else int(known[-1])
    after = int(known[known > place][0]) if (known > place).any() else int(known[0])
    ends = [int(other.rows[c.target_vertices[k]]) for k in (before, after)]
    return f"a point between vertices {ends[0]} and {ends[1]}"


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
    """Whether the same triangles are counter-clockwise in both shapes and both curves turn once, exactly.

    Parameters
    ----------
    source, target : Triangulation

    Returns
    -------
    bool
    """
    for T in (source, target):
        if (orient2d(*np.moveaxis(T.points[T.triangles], 1, 0)) <= 0).any() or turning_number(T.points) != 1:
            return False
    return True

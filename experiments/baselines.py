"""What others use to morph polygons, on the correspondence of vertices that our morphs use.

    straight              every vertex along a straight line
    edge_angle            lengths of edges and turning angles, then closed (Sederberg, Gao, Wang and Mu)
    as_rigid_as_possible  rotation and stretch of every triangle, then glued (Alexa, Cohen-Or and Levin)

None of them promises that the shapes on the way bound immersed disks.  Points are complex numbers here.

Legend: ``n`` vertices, ``m`` triangles, ``k`` times; ``t`` time; ``z`` a point; an affine map of the plane
is ``z -> a z + b conj(z) + c``, and its polar decomposition turns by the angle of a and then stretches.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, csr_array, diags_array
from scipy.sparse.linalg import splu

from tween.errors import IncompatibleError, TriangulationError
from tween.geometry.dual_tree import rooted
from tween.geometry.triangulation import Triangulation
from tween.morphing.alignment import renumbered
from tween.morphing.compatible.guarantee.rounding import Doubt, Placing
from tween.morphing.incompatible.flow import Event
from tween.morphing.morph import Morph
from tween.morphing.plan import Plan

_Floats = NDArray[np.float64]
_Complexes = NDArray[np.complex128]

_LEAST_WEIGHT = 1e-4  # of an edge that keeps its length, as a fraction of the largest weight
_NO_CHANGE = 1e-9  # changes of length below this fraction of the mean length are rounding errors


class Baseline(Morph):
    """A morph by one of the methods to compare with; made by the functions of this module.

    It is used as any `tween.Morph`; it has no flips, and its triangles are always the source's.

    Attributes
    ----------
    name : str
        Of the function that made it.
    """

    def __init__(self, name: str, source: Triangulation, target: Triangulation, at: Callable[[_Floats], _Complexes]):
        rows = np.arange(len(source))
        stages = [(0.0, source.triangles)]
        super().__init__(_Still(at, stages), renumbered(source, target, 0, None, rows, rows), backwards=False, shift=0)
        self.name = name

    def __repr__(self) -> str:
        return f"Baseline({self.name}, {len(self.source)} vertices)"


@dataclass
class _Still:
    """A `Motion` that keeps its triangles."""

    points: Callable[[_Floats], _Complexes]
    stages: list[tuple[float, NDArray[np.int64]]]
    events: list[Event] = field(default_factory=list)

    def first_doubt(self, placing: Placing) -> Doubt:
        """Nothing is proved of a baseline."""
        return Doubt(0.0, 1.0, "triangle", (), 0.0, 0.0)

    def plans(self) -> list[Plan]:
        """It is made of no legs."""
        return []

    def at(self, t: _Floats) -> _Floats:
        z = self.points(t)
        return np.stack([z.real, z.imag], axis=2)


def straight(source: Triangulation, target: Triangulation) -> Baseline:
    """Move every vertex along a straight line, at constant speed.

    Parameters
    ----------
    source, target : Triangulation
        With equally many vertices; vertex i of one moves to vertex i of the other.

    Returns
    -------
    Baseline

    Raises
    ------
    IncompatibleError
        Where the numbers of vertices differ.

    Examples
    --------
    >>> T = Triangulation([[0, 0], [2, 0], [0, 2]], [[0, 1, 2]])
    >>> straight(T, T.moved([[0, 0], [2, 2], [0, 4]]))(0.5).tolist()
    [[0.0, 0.0], [2.0, 1.0], [0.0, 3.0]]
    """
    p, q = _matched(source, target)
    return Baseline("straight", source, target, lambda t: _between(p, q, t))


def edge_angle(source: Triangulation, target: Triangulation) -> Baseline:
    """Interpolate lengths of edges and turning angles, and adjust the lengths so that the polygon closes.

    Parameters
    ----------
    source, target : Triangulation
        With equally many vertices; vertex i of one moves to vertex i of the other.

    Returns
    -------
    Baseline

    Raises
    ------
    IncompatibleError
        Where the numbers of vertices differ.

    Notes
    -----
    As published: the angles are kept and the length of edge i changes by s_i, so that the sum of
    (s_i / w_i)**2 is least among all changes that close the polygon; w_i is the difference of the edge's
    two lengths, and at least 1e-4 of the largest difference.  An adjusted length may be negative.
    Vertex 0 moves along a straight line, and edge 0 turns at constant speed; therefore all edges do.

    Where the paper is silent, our choices: as many full turns of the whole polygon as make its edges turn
    by at most half a turn on average, and equal weights where no length changes by more than a rounding error.
    The changes are the least-norm solution of two equations, by numpy's pseudo-inverse.  O(n k).

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> edge_angle(T, T.moved(T.points * [3, 1]))(0.5).round(12).tolist()
    [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]

    References
    ----------
    Sederberg, Gao, Wang and Mu, "2-D shape blending: an intrinsic solution to the vertex path problem",
    SIGGRAPH 1993, pages 15 to 18; the closing of the polygon by Lagrange multipliers.
    """
    p, q = _matched(source, target)
    (l0, d0), (l1, d1) = _lengths_and_directions(p), _lengths_and_directions(q)
    d1 = d0 + _least_turn(d1 - d0)
    w = np.abs(l1 - l0)
    w = np.maximum(w, max(_LEAST_WEIGHT * w.max(), _NO_CHANGE * np.mean(l0 + l1)))

    def at(t: _Floats) -> _Complexes:
        units: _Complexes = np.exp(1j * _between(d0, d1, t))
        edges = units * _closing_lengths(units, _between(l0, l1, t), w)
        return _between(p[:1], q[:1], t) + np.cumsum(edges, axis=1) - edges

    return Baseline("edge_angle", source, target, at)


def as_rigid_as_possible(source: Triangulation, target: Triangulation, unwrap: bool = True) -> Baseline:
    """Turn and stretch every triangle by itself, and glue the triangles as well as they fit.

    Parameters
    ----------
    source, target : Triangulation
        With equally many vertices; vertex i of one moves to vertex i of the other.  The source's triangles
        are used; they need not be counter-clockwise in the target.
    unwrap : bool
        Whether neighbours turn coherently, their angles differing by at most half a turn.  In the paper
        every triangle turns by its own shorter way, which folds a spiral where the angle passes half a turn.

    Returns
    -------
    Baseline

    Raises
    ------
    IncompatibleError
        Where the numbers of vertices differ.
    TriangulationError
        Where a triangle of the source is not counter-clockwise.

    Notes
    -----
    As published: the affine map of each triangle from source to target is a turn after a symmetric stretch,
    A = R S; at time t it should be A(t) = R(t) ((1-t) I + t S), R(t) turning by t times the angle of R.  The
    shape is the one whose affine maps are nearest to these, in the sum of squared Frobenius distances over
    the triangles, not weighted by area; vertex 0 moves along a straight line.  The maps lead from the source,
    so the way back is another one; the paper's symmetric variant is not implemented.  A triangle that is
    clockwise in the target is stretched by a negative factor.

    Our choices: angles are unwrapped along the dual tree, with as many full turns of the whole as make the
    triangles turn by at most half a turn on average; and SuperLU factorises, once for all times, not the
    normal equations, which lose all digits on very thin triangles, but the augmented system.  About O(n k).

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    >>> z = as_rigid_as_possible(T, T.moved([[0, 0], [0, 3], [-1, 0]]))(0.5)[1]
    >>> np.hypot(*z).round(12).item(), np.degrees(np.arctan2(z[1], z[0])).round(12).item()
    (2.0, 45.0)

    References
    ----------
    Alexa, Cohen-Or and Levin, "As-rigid-as-possible shape interpolation", SIGGRAPH 2000, on least-distorting
    triangle-to-triangle morphing and closed-form vertex paths for a triangulation.
    Choi and Szymczak, "On coherent rotation angles for as-rigid-as-possible shape interpolation", CCCG 2003.
    """
    p, q = _matched(source, target)
    for i in np.flatnonzero(~(source.areas > 0)):
        raise TriangulationError(f"triangle {i} of the source has area {source.areas[i]:g}, expected a positive one")
    gradient = _gradient(source)
    along_x, along_y = (gradient @ q).reshape(2, -1)
    a, b = (along_x - 1j * along_y) / 2, (along_x + 1j * along_y) / 2
    angles = _unwrapped(np.angle(a), source) if unwrap else np.angle(a)
    solve = _least_squares(gradient[:, 1:], np.ptp(source.points).item())
    size, shear = np.abs(a), b * np.exp(-1j * np.angle(a))

    def at(t: _Floats) -> _Complexes:
        turn = np.exp(1j * np.multiply.outer(t, angles))
        c, d = turn * _between(np.ones_like(size), size, t), turn * _between(0 * shear, shear, t)
        z = solve(np.concatenate([c + d, 1j * (c - d)], axis=1))
        return _between(p[:1], q[:1], t) + np.pad(z, ((0, 0), (1, 0)))

    return Baseline("as_rigid_as_possible", source, target, at)


BASELINES: dict[str, Callable[[Triangulation, Triangulation], Baseline]] = {
    "straight": straight,
    "edge_angle": edge_angle,
    "as_rigid_as_possible": as_rigid_as_possible,
}
"""The methods by name."""


def _matched(source: Triangulation, target: Triangulation) -> tuple[_Complexes, _Complexes]:
    """Return the points of both where there are equally many."""
    if len(source) != len(target):
        raise IncompatibleError(
            f"the target has {len(target)} vertices, expected {len(source)} as the source has; tween.match inserts some"
        )
    p, q = (np.ascontiguousarray(shape.points).view(np.complex128)[:, 0] for shape in (source, target))
    return p, q


def _between(start: NDArray[Any], end: NDArray[Any], t: _Floats) -> NDArray[Any]:
    """Interpolate (n,) arrays linearly, all times at once; (k, n)."""
    return np.multiply.outer(1 - t, start) + np.multiply.outer(t, end)


def _least_turn(angles: _Floats) -> _Floats:
    """Turn everything by the same number of full turns, so that the mean is at most half a turn."""
    return angles - 2 * np.pi * np.round(angles.mean() / (2 * np.pi))


# Edges and angles


def _lengths_and_directions(z: _Complexes) -> tuple[_Floats, _Floats]:
    """Length of each edge, and its direction as the sum of the turning angles before it."""
    edges = np.roll(z, -1) - z
    turns = np.angle(edges[1:] / edges[:-1])
    return np.abs(edges), np.angle(edges[0]) + np.concatenate([[0.0], np.cumsum(turns)])


def _closing_lengths(units: _Complexes, lengths: _Floats, weights: _Floats) -> _Floats:
    """Change lengths, (k, n), by the least sum of (change / weight)**2, so that edges of these directions close."""
    weighted = np.stack([units.real, units.imag], axis=1) * weights
    gap = (units * lengths).sum(axis=1)
    least = np.linalg.pinv(weighted) @ np.stack([gap.real, gap.imag], axis=1)[..., None]
    return lengths - weights * least[..., 0]


# Triangles


def _gradient(T: Triangulation) -> csr_array:
    """The matrix, (2m, n), from values at the vertices to their slopes along x, then y, in each triangle."""
    opposite = np.roll(T.points[T.triangles], 1, axis=1) - np.roll(T.points[T.triangles], -1, axis=1)
    slopes = np.stack([-opposite[..., 1], opposite[..., 0]]) / (2 * T.areas[:, None])
    rows = np.repeat(np.arange(2 * len(T.triangles)), 3)
    columns = np.tile(T.triangles.ravel(), 2)
    return csr_array((slopes.ravel(), (rows, columns)), shape=(2 * len(T.triangles), len(T)))


def _unwrapped(angles: _Floats, T: Triangulation) -> _Floats:
    """Add full turns, so that neighbours differ by at most half a turn."""
    result, tree = angles.copy(), rooted(T, 0)
    for t in tree.order[1:]:
        parent = T.twin.ravel()[tree.base[t]] // 3
        result[t] -= 2 * np.pi * np.round((angles[t] - result[parent]) / (2 * np.pi))
    return _least_turn(result)


def _least_squares(matrix: csr_array, size: float) -> Callable[[_Complexes], _Complexes]:
    """Factorise the augmented system of a full-rank problem in units of 1/size; its solver, (k, 2m) to (k, n-1)."""
    rows, columns = matrix.shape
    residuals = diags_array(np.full(rows, 1 / size))
    factors = splu(block_array([[residuals, matrix], [matrix.T, None]], format="csc"))

    def solve(sides: _Complexes) -> _Complexes:
        z = np.pad(sides, ((0, 0), (0, columns)))
        # One by one: for many at once SuperLU calls BLAS, whose threads wait for each other over tiny blocks.
        for i in range(len(z)):
            z[i] = factors.solve(z[i].real) + 1j * factors.solve(z[i].imag)
        return z[:, rows:]

    return solve

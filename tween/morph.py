"""Morphs of compatible triangulations (Section 5), all frames at once.

The root triangle moves as a whole; every other triangle hangs on its base, the edge it shares with
its parent, and moves its third vertex along a path (`tween.paths`).  Points are complex numbers here.

Legend: ``a b c`` the corners of a triangle, ab its base; ``z = (c-a)/(b-a)``; ``e = b-a``; ``t`` time.
"""

from typing import Literal, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import ArrayLike, NDArray

from tween.curve import Curve
from tween.decomposition import decompose
from tween.dual import RootedTree, disk_center, rooted, tree_center
from tween.errors import IncompatibleError, NotSelfOverlappingError
from tween.flips import remesh
from tween.paths import PATHS, Path, third_vertices
from tween.triangulation import Triangulation, compatible_shift

Root = Literal["disk-center", "tree-center"] | int

_HALF_TURN = 1e-9  # radians; a root that turns by 180 degrees within this turns the same way in reverse


class Event(NamedTuple):
    """A flip during a morph: when, and which diagonal gave way to which."""

    time: float
    out: tuple[int, int]
    into: tuple[int, int]


class Morph:
    """A morph between two shapes with the same triangles; made by `morph`.

    Calling it with a time, 0 to 1, gives the shape at that time.

    Attributes
    ----------
    source, target : Triangulation
        What it leads from and to; vertex i of one moves to vertex i of the other.
    source_vertices, target_vertices : ndarray of int, shape (n,)
        Which vertex of the input each vertex is; -1 where it was inserted.
    path : str
    root : int
        Number of the root triangle.
    """

    def __init__(self, source: Triangulation, target: Triangulation, path: Path, root: int) -> None:
        if path not in PATHS:
            raise ValueError(f"path is {path!r}, expected one of {', '.join(PATHS)}")
        self.source, self.target, self.path, self.root = source, target, path, root
        self.source_vertices = self.target_vertices = np.arange(len(source))
        self._tree = rooted(source, root)

    def __call__(self, t: float) -> NDArray[np.float64]:
        """Return the shape at one time.

        Parameters
        ----------
        t : float
            From 0, the source, to 1, the target.

        Returns
        -------
        ndarray of float64, shape (n, 2)
        """
        return self.at([t])[0]

    def at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the shapes at many times at once.

        Parameters
        ----------
        times : array_like of float, shape (k,)
            From 0 to 1, in any order.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
            At times 0 and 1 exactly the source and the target.

        Raises
        ------
        ValueError
            Where a time is not between 0 and 1.

        Notes
        -----
        O(n k).
        """
        t = np.asarray(times, dtype=np.float64)
        if t.ndim != 1 or not ((t >= 0) & (t <= 1)).all():
            raise ValueError(f"times are {times!r}, expected a list of numbers from 0 to 1")
        shapes = self._shapes(t)
        shapes[t == 0] = self.source.points
        shapes[t == 1] = self.target.points
        return shapes

    def frames(self, k: int) -> NDArray[np.float64]:
        """Return k shapes, evenly spaced in time, both ends included.

        Parameters
        ----------
        k : int
            At least 2.

        Returns
        -------
        ndarray of float64, shape (k, n, 2)
        """
        return self.at(np.linspace(0.0, 1.0, k))

    def triangles_at(self, t: float) -> NDArray[np.int64]:
        """Return the triangles in force at a time.

        Parameters
        ----------
        t : float

        Returns
        -------
        ndarray of int, shape (n-2, 3)
        """
        return self.source.triangles

    @property
    def events(self) -> list[Event]:
        """The flips on the way, in order of time; none between compatible triangulations."""
        return []

    def _shapes(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return hang(self.source, self.target.points, self._tree, self.path, t)

    def __repr__(self) -> str:
        return f"Morph({len(self.source)} vertices, path {self.path!r}, root {self.root})"


def morph(
    source: Triangulation | Curve | ArrayLike,
    target: Triangulation | Curve | ArrayLike,
    path: Path = "slide",
    root: Root = "disk-center",
) -> Morph:
    """Morph one immersed disk into another with a compatible triangulation.

    Parameters
    ----------
    source, target : Triangulation, Curve or array_like of shape (n, 2)
        A curve stands for its constrained Delaunay triangulation.  The target's vertices are renumbered
        by `compatible_shift`, unless the triangles agree as they are.
    path : {"slide", "linear"}
        How third vertices move, see `tween.paths`.
    root : {"disk-center", "tree-center"} or int
        Where the motion spreads from: the triangle closest to the centre of the disk (the paper's
        choice), the centre of the dual tree, or a triangle of the source by number.

    Returns
    -------
    Morph

    Raises
    ------
    CurveError, NotSelfOverlappingError, IncompatibleError

    Notes
    -----
    The root's base changes its length and direction linearly, and its centre of mass moves linearly;
    the paper says only that the root is "smoothly interpolated".  Every triangle stays counter-clockwise
    at all times.  That alone does not make every shape the boundary of an immersed disk: angles around
    a vertex may add up to more than 2 pi on the way.

    Examples
    --------
    >>> T = triangulate([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> m = morph(T, T.on_disk())
    >>> m.frames(5).shape, bool((m(0) == T.points).all())
    ((5, 6, 2), True)

    References
    ----------
    Mukherjee and Gopi, Section 5.
    """
    first, second = triangulate(source), triangulate(target)
    second, shift = _matched(first, second)
    result = Morph(first, second, path, _root(first, second, root))
    result.target_vertices = (np.arange(len(first)) + shift) % len(first)
    return result


def triangulate(shape: Triangulation | Curve | ArrayLike) -> Triangulation:
    """Return the constrained Delaunay triangulation of an immersed disk that a curve bounds.

    Parameters
    ----------
    shape : Triangulation, Curve or array_like of shape (n, 2)
        A triangulation is returned as it is.

    Returns
    -------
    Triangulation
        Where the curve bounds several disks, one of them: that of ``decompose(curve).arbitrary()``.

    Raises
    ------
    NotSelfOverlappingError
        Where the curve bounds no immersed disk; the message says why not.

    Examples
    --------
    >>> triangulate([[0, 0], [2, -1], [4, 0], [2, 1]]).diagonals.tolist()
    [[1, 3]]
    """
    if isinstance(shape, Triangulation):
        return shape
    decomposition = decompose(shape)
    if not decomposition:
        raise NotSelfOverlappingError(f"the curve bounds no immersed disk: {decomposition.reason}")
    return remesh(decomposition.arbitrary())


def _matched(first: Triangulation, second: Triangulation) -> tuple[Triangulation, int]:
    """Renumber `second` so that it has the triangles of `first`, in their order."""
    if len(first) != len(second):
        raise IncompatibleError(f"shapes have {len(first)} and {len(second)} vertices, expected equal numbers")
    same = np.array_equal(first.canonical, second.canonical)
    shift = 0 if same else compatible_shift(first, second)
    if shift is None:
        raise IncompatibleError("the triangulations are incompatible: no renumbering makes their degrees agree")
    return Triangulation(np.roll(second.points, -shift, axis=0), first.triangles), shift


def _root(first: Triangulation, second: Triangulation, root: Root) -> int:
    if root == "disk-center":
        return disk_center(first, second)
    if root == "tree-center":
        return tree_center(first)
    if isinstance(root, str) or int(root) != root or not 0 <= root < len(first.triangles):
        last = len(first.triangles) - 1
        raise ValueError(f"root is {root!r}, expected 'disk-center', 'tree-center' or a triangle from 0 to {last}")
    return int(root)


def hang(
    source: Triangulation, target_points: NDArray[np.float64], tree: RootedTree, path: Path, t: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Lay out the triangles of all times, the root first and each child on its base.

    Parameters
    ----------
    source : Triangulation
    target_points : ndarray of float64, shape (n, 2)
        Target with the same triangles.
    tree : RootedTree
        Of the source.
    path : str
    t : ndarray of float64, shape (k,)

    Returns
    -------
    ndarray of float64, shape (k, n, 2)

    References
    ----------
    Mukherjee and Gopi, Section 5.
    """
    corners = _corners_from_base(source.triangles, tree)
    start, end = _complex(source.points)[corners], _complex(target_points)[corners]
    z = third_vertices(path, _third(start), _third(end), _propagates(source.twin, tree), t)
    a, e = _root_base(start[0], end[0], z[0], t)
    shapes = _lay_out(corners, tree.base, tree.order, source.twin, z, a, e, len(source))
    return np.ascontiguousarray(shapes.T).view(np.float64).reshape(len(t), len(source), 2)


def _complex(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return np.ascontiguousarray(points).view(np.complex128)[:, 0]


def _corners_from_base(triangles: NDArray[np.int64], tree: RootedTree) -> NDArray[np.int64]:
    """Corners a, b, c of each triangle in tree order, ab being its base; shape (m, 3)."""
    slots = (tree.base[tree.order, None] + np.arange(3)) % 3
    return np.take_along_axis(triangles[tree.order], slots, axis=1)


def _propagates(twin: NDArray[np.int64], tree: RootedTree) -> NDArray[np.bool_]:
    """Whether edge ca, and edge bc, of each triangle in tree order has a child; shape (m, 2)."""
    slots = (tree.base[tree.order, None] + np.array([2, 1])) % 3
    return np.take_along_axis(twin[tree.order], slots, axis=1) >= 0


def _third(corners: NDArray[np.complex128]) -> NDArray[np.complex128]:
    a, b, c = corners.T
    return (c - a) / (b - a)


def _root_base(
    source: NDArray[np.complex128], target: NDArray[np.complex128], z: NDArray[np.complex128], t: NDArray[np.float64]
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Move the root: (a, e) at every time, from its corners at both ends and its z on the way."""
    e1, e2 = source[1] - source[0], target[1] - target[0]
    turn = float(np.angle(e2 / e1))
    if abs(abs(turn) - np.pi) < _HALF_TURN:
        turn = np.copysign(turn, e1.imag if e1.imag != 0 else e1.real)
    length = (1 - t) * abs(e1) + t * abs(e2)
    e = length * np.exp(1j * (np.angle(e1) + t * turn))
    centre = (1 - t) * source.mean() + t * target.mean()
    return centre - e * (1 + z) / 3, e


@njit(cache=True)
def _lay_out(corners, base, order, twin, z, root_a, root_e, n):
    """Shapes, (n, k), from the third vertices z, (m, k), in tree order."""
    m, k = z.shape
    place = np.empty(m, np.int64)
    for i in range(m):
        place[order[i]] = i
    shapes, bases = np.empty((n, k), np.complex128), np.empty((m, k), np.complex128)
    bases[0] = root_e
    shapes[corners[0, 0]] = root_a
    shapes[corners[0, 1]] = root_a + root_e
    for i in range(m):
        t = order[i]
        across_bc, across_ca = twin[t, (base[t] + 1) % 3], twin[t, (base[t] + 2) % 3]
        shapes[corners[i, 2]] = shapes[corners[i, 0]] + z[i] * bases[i]
        if across_ca >= 0:
            bases[place[across_ca // 3]] = z[i] * bases[i]
        if across_bc >= 0:
            bases[place[across_bc // 3]] = (1.0 - z[i]) * bases[i]
        if i == 0 and twin[t, base[t] % 3] >= 0:
            bases[place[twin[t, base[t] % 3] // 3]] = -bases[0]
    return shapes

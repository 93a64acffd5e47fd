"""Motion between compatible triangulations (Section 5), all times at once.

The root triangle moves as a whole; every other triangle hangs on its base, the edge it shares with
its parent, and moves its third vertex along a path (`tween.paths`).  Points are complex numbers here.

Legend: ``a b c`` the corners of a triangle, ab its base; ``z = (c-a)/(b-a)``; ``e = b-a``; ``t`` time.
"""

import cmath
import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.dual import RootedTree, disk_center, rooted, tree_center
from tween.paths import Path, third_vertices
from tween.triangulation import Triangulation

_HALF_TURN = 1e-9  # radians; a root that turns by 180 degrees within this turns the same way in reverse


class Leg:
    """The motion from one shape to another with the same triangles.

    Parameters
    ----------
    source : Triangulation
    target : ndarray of float64, shape (n, 2)
        Points of the target; its triangles are the source's.
    path : str
        See `tween.paths`.
    root : int
        Number of the root triangle.

    Notes
    -----
    The root's base changes its length and direction linearly, and its centre of mass moves linearly;
    the paper says only that the root is "smoothly interpolated".

    References
    ----------
    Mukherjee and Gopi, Section 5.
    """

    def __init__(self, source: Triangulation, target: NDArray[np.float64], path: Path, root: int) -> None:
        self.source, self.target = source, target
        self._path, self._tree = path, rooted(source, root)
        self._corners = _corners_from_base(source.triangles, self._tree)
        self._start, self._end = _complex(source.points)[self._corners], _complex(target)[self._corners]
        self._thirds = _third(self._start), _third(self._end)
        self._propagates = _propagates(source.twin, self._tree)

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
        z = third_vertices(self._path, *self._thirds, self._propagates, t)
        a, e = _move_root(self._start[0], self._end[0], z[0], t)
        n = len(self.source)
        laid = _lay_out(self._corners, self._tree.base, self._tree.order, self.source.twin, z, a, e, n)
        shapes = np.ascontiguousarray(laid.T).view(np.float64).reshape(len(t), n, 2)
        shapes[t == 0] = self.source.points
        shapes[t == 1] = self.target
        return shapes


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
    if isinstance(root, str) or int(root) != root or not 0 <= root <= last:
        raise ValueError(f"root is {root!r}, expected 'disk-center', 'tree-center' or a triangle from 0 to {last}")
    return int(root)


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


@njit(cache=True)
def _move_root(source, target, z, t):
    """Move the root: (a, e) at every time, from its corners at both ends and its z on the way."""
    e1, e2 = source[1] - source[0], target[1] - target[0]
    turn = cmath.phase(e2 / e1)
    if abs(abs(turn) - math.pi) < _HALF_TURN:
        apart = e1 / abs(e1) - e2 / abs(e2)  # changes sign, exactly, when source and target are exchanged
        way = math.copysign(1.0, apart.imag if apart.imag != 0.0 else apart.real)
        if turn * way < 0.0:
            turn += 2.0 * math.pi * way
    a, e = np.empty_like(z), np.empty_like(z)
    for f in range(t.size):
        e[f] = cmath.rect((1 - t[f]) * abs(e1) + t[f] * abs(e2), cmath.phase(e1) + t[f] * turn)
        centre = ((1 - t[f]) * (source[0] + source[1] + source[2]) + t[f] * (target[0] + target[1] + target[2])) / 3
        a[f] = centre - e[f] * (1 + z[f]) / 3
    return a, e


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

"""The dual tree of a triangulation: a node for each triangle, an edge for each diagonal.

Legend: ``s t`` nodes (triangle numbers); ``h`` half-edges as in `.triangulation`.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation, arc_gaps

_TIE = 1e-9  # distances on the unit disk that differ by less count as equal


class RootedTree(NamedTuple):
    """The dual tree hung from a root, as the morph walks it.

    Attributes
    ----------
    order : ndarray of int, shape (n-2,)
        Triangles, parents before children, the root first.
    base : ndarray of int, shape (n-2,)
        Half-edge of each triangle, within it, that it shares with its parent; for the root its base.
    depth : ndarray of int, shape (n-2,)
        Hops from the root.
    """

    order: NDArray[np.int64]
    base: NDArray[np.int64]
    depth: NDArray[np.int64]


def rooted(T: Triangulation, root: int) -> RootedTree:
    """Hang the dual tree from one triangle.

    Parameters
    ----------
    T : Triangulation
    root : int
        Triangle number.

    Returns
    -------
    RootedTree
        The root's base is its edge of smallest start among those on the boundary, or among all three
        where none is, so that it does not depend on how the triangles are listed.

    Raises
    ------
    ValueError
        Where there is no such triangle.

    Examples
    --------
    >>> T = Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    >>> tree = rooted(T, 1)
    >>> tree.order.tolist(), tree.base.tolist(), tree.depth.tolist()
    ([1, 0], [2, 4], [1, 0])

    References
    ----------
    Mukherjee and Gopi, Section 5: base, third vertex, propagation edges.
    """
    if not 0 <= root < len(T.triangles):
        raise ValueError(f"root is triangle {root}, expected 0 to {len(T.triangles) - 1}")
    boundary = T.twin[root] < 0
    candidates = np.flatnonzero(boundary if boundary.any() else ~boundary)
    slot = candidates[np.argmin(T.triangles[root, candidates])]
    return RootedTree(*_walk(T.twin, 3 * root + slot))


def hops(T: Triangulation, start: int) -> NDArray[np.int64]:
    """Count the dual edges from one triangle to every other.

    Parameters
    ----------
    T : Triangulation
    start : int
        Triangle number.

    Returns
    -------
    ndarray of int, shape (n-2,)
    """
    if not 0 <= start < len(T.triangles):
        raise ValueError(f"start is triangle {start}, expected 0 to {len(T.triangles) - 1}")
    return _walk(T.twin, 3 * start)[2]


def along_longest_path(T: Triangulation) -> NDArray[np.int64]:
    """Count the hops of every triangle from an end of a longest path of the dual tree.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of int, shape (n-2,)
        From the one of the two ends whose sorted corners are smaller.

    Examples
    --------
    >>> hexagon = [[2, 0], [1, 2], [-1, 2], [-2, 0], [-1, -2], [1, -2]]
    >>> along_longest_path(Triangulation(hexagon, [[0, 1, 2], [0, 2, 4], [2, 3, 4], [0, 4, 5]])).tolist()
    [0, 1, 2, 2]
    """
    one_end = int(np.argmax(hops(T, 0)))
    other_end = int(np.argmax(hops(T, one_end)))
    return hops(T, smallest_triangle(T, np.array([one_end, other_end])))


def tree_center(T: Triangulation) -> int:
    """Find the triangle from which the farthest triangle is fewest hops away.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    int
        Triangle number; of two centres the one whose sorted corners are smaller.

    Notes
    -----
    The middle of a longest path, found by two walks; O(n).

    Examples
    --------
    >>> hexagon = [[2, 0], [1, 2], [-1, 2], [-2, 0], [-1, -2], [1, -2]]
    >>> tree_center(Triangulation(hexagon, [[0, 1, 2], [0, 2, 4], [2, 3, 4], [0, 4, 5]]))
    1
    """
    from_first_end = hops(T, int(np.argmax(hops(T, 0))))
    from_other_end = hops(T, int(np.argmax(from_first_end)))
    height = np.maximum(from_first_end, from_other_end)
    return smallest_triangle(T, np.flatnonzero(height == height.min()))


def disk_center(*shapes: Triangulation) -> int:
    """Find the triangle that lies closest to the centre when the triangles are imposed on a disk.

    Parameters
    ----------
    *shapes : Triangulation
        One or more with the same triangles.  Neighbours on the circle are as far apart as their mean
        share of the shapes' boundaries, so that the order of the shapes does not matter.

    Returns
    -------
    int
        Number of the triangle that holds the centre, or else of the one nearest to it; ties go to the
        one whose sorted corners are smaller.

    Examples
    --------
    >>> hexagon = [[2, 0], [1, 2], [-1, 2], [-2, 0], [-1, -2], [1, -2]]
    >>> disk_center(Triangulation(hexagon, [[0, 1, 2], [0, 2, 4], [2, 3, 4], [0, 4, 5]]))
    1

    References
    ----------
    Mukherjee and Gopi, Section 7, "Discussion".
    """
    gaps = sum(arc_gaps(shape.points) for shape in shapes) / len(shapes)
    angles = 2 * np.pi * (np.cumsum(gaps) - gaps)
    triangles = shapes[0].triangles
    distance = _distance_to_triangles(np.cos(angles)[triangles], np.sin(angles)[triangles])
    return smallest_triangle(shapes[0], np.flatnonzero(distance <= distance.min() + _TIE))


def smallest_triangle(T: Triangulation, numbers: NDArray[np.intp]) -> int:
    """Pick the triangle whose sorted corners come first, whatever the order of the list.

    Parameters
    ----------
    T : Triangulation
    numbers : ndarray of int
        Triangle numbers.

    Returns
    -------
    int
    """
    return int(min(numbers, key=lambda t: sorted(T.triangles[t].tolist())))


@njit(cache=True)
def _walk(twin, base_of_root):
    """Walk the tree breadth first: (order, base, depth)."""
    m = len(twin)
    order, base, depth = np.empty(m, np.int64), np.full(m, -1, np.int64), np.zeros(m, np.int64)
    order[0] = base_of_root // 3
    base[order[0]] = base_of_root  # -1 marks what was not reached, so that nothing walks back to its parent
    size = 1  # order is its own queue; the tree is connected, so size stays ahead of i
    for i in range(m):
        t = order[i]
        for s in range(3):
            g = twin[t, s]
            if g >= 0 and base[g // 3] < 0:
                base[g // 3] = g
                depth[g // 3] = depth[t] + 1
                order[size] = g // 3
                size += 1
    return order, base, depth


def _distance_to_triangles(x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distance from the origin to each triangle, its corners' coordinates being rows of (m, 3) arrays; 0 inside."""
    u, v = x[:, [1, 2, 0]] - x, y[:, [1, 2, 0]] - y
    along = np.minimum(np.maximum(-(x * u + y * v) / (u * u + v * v), 0.0), 1.0)
    to_edges = np.hypot(x + along * u, y + along * v).min(axis=1)
    inside = (v * x - u * y >= 0).all(axis=1)
    return np.where(inside, 0.0, to_edges)

r"""Triangles with more vertices on the edges of their boundary.

A boundary edge with points on it belongs to one triangle.  Fans split it:

          c                        whatever lies on ab is joined to c; then bc is split from
        / | \                      the last point of ab, and ca from its first one, so that
       / | | \                     no triangle has all its corners on one edge
      a--p--q--b

A triangle is convex with points on its sides.  So any triangles are right, whatever the shares of the edges are at
which the points lie, as long as no three corners lie on one side.
"""

import numpy as np
from numpy.typing import NDArray

_Corner = tuple[int, int, int]


def subdivided(triangles: NDArray[np.int64], vertices: NDArray[np.int64], n: int) -> NDArray[np.int64]:
    """Insert vertices on the boundary edges of a triangulated disk.

    Parameters
    ----------
    triangles : ndarray of int, shape (m-2, 3)
        Counter-clockwise.
    vertices : ndarray of int, shape (m,)
        The new number of each vertex; they go around once.
    n : int
        Vertices in all; those not named are inserted between their neighbours.

    Returns
    -------
    ndarray of int, shape (n-2, 3)
        Where nothing is inserted, the triangles in their rows.

    Examples
    --------
    >>> subdivided(np.array([[0, 1, 2]]), np.array([0, 2, 3]), 4).tolist()
    [[0, 1, 3], [1, 2, 3]]
    """
    m = len(vertices)
    inserted = (np.roll(vertices, -1) - vertices - 1) % n if m > 1 else np.array([n - 1])
    named = vertices[triangles]
    onward = (np.roll(triangles, -1, axis=1) - triangles) % m == 1
    counts = np.where(onward, inserted[triangles], 0)
    rows: list[_Corner] = []
    for corners, count in zip(named.tolist(), counts.tolist(), strict=True):
        _split(corners, count, n, rows)
    return np.array(rows, dtype=np.int64)


def _split(corners: list[int], count: list[int], n: int, rows: list[_Corner]) -> None:
    """Split one triangle; so many vertices follow each corner before the next one."""
    if not any(count):
        rows.append((corners[0], corners[1], corners[2]))
        return
    side = count.index(max(count))
    (a, b, c), (on_ab, on_bc, on_ca) = corners[side:] + corners[:side], count[side:] + count[:side]
    chain = [*((a + k) % n for k in range(on_ab + 1)), b]
    for k in range(on_ab + 1):
        first, last = k == 0, k == on_ab
        _split([chain[k], chain[k + 1], c], [0, on_bc if last else 0, on_ca if first else 0], n, rows)

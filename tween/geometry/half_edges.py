"""Half-edges of triangles: their twins, and which triangles hang together by them.

Legend: half-edge ``3*t + s`` of triangle t runs from its corner s to its corner s+1, see `.triangulation`.
"""

from typing import NoReturn

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.errors import TriangulationError


def twins(triangles: NDArray[np.int64], n: int) -> NDArray[np.int64]:
    """Pair every half-edge with its reverse.

    Parameters
    ----------
    triangles : ndarray of int, shape (n-2, 3)
    n : int
        Vertices along the curve.

    Returns
    -------
    ndarray of int, shape (n-2, 3)
        The half-edge across each half-edge; -1 on the curve.

    Raises
    ------
    TriangulationError
        Naming the first edge that is not in as many triangles as it should be: one on the curve, otherwise two, in
        opposite directions.

    Examples
    --------
    >>> import numpy as np
    >>> twins(np.array([[0, 1, 2], [0, 2, 3]]), 4).tolist()
    [[-1, -1, 3], [2, -1, -1]]
    """
    twin, fine = _paired(triangles, n)
    if not fine:
        _refuse(triangles, n)
    return np.asarray(twin, np.int64)


def _refuse(triangles: NDArray[np.int64], n: int) -> NoReturn:
    """Name the first edge that is not in as many triangles as it should be."""
    start, end = triangles.ravel(), triangles[:, [1, 2, 0]].ravel()
    key, reverse = start * n + end, end * n + start
    order = np.argsort(key, kind="stable")
    for h in order[1:][key[order][1:] == key[order][:-1]]:
        raise TriangulationError(f"edge {start[h]}-{end[h]} occurs twice in the same direction")
    two_sided, on_curve = np.isin(reverse, key), end == (start + 1) % n
    for h in np.flatnonzero(on_curve & two_sided):
        raise TriangulationError(f"boundary edge {start[h]}-{end[h]} has triangles on both sides")
    for h in np.flatnonzero(~on_curve & ~two_sided):
        raise TriangulationError(f"diagonal {start[h]}-{end[h]} has no triangle on its other side")
    i = np.flatnonzero(np.bincount(start[on_curve], minlength=n) == 0)[0]
    raise TriangulationError(f"boundary edge {i}-{(i + 1) % n} belongs to no triangle")


@njit(cache=True)
def _paired(triangles, n):
    """The half-edge across each half-edge, (n-2, 3), and whether every edge is in as many triangles as it should be."""
    m = len(triangles)
    twin, used = np.full((m, 3), -1, np.int64), np.zeros(n, np.bool_)
    # the half-edges that start at a vertex are a chain, and how many they are says which of two chains is shorter
    last, before, size = np.full(n, -1, np.int64), np.empty(3 * m, np.int64), np.zeros(n, np.int64)
    for h in range(3 * m):
        i = triangles[h // 3, h % 3]
        before[h], last[i] = last[i], h
        size[i] += 1
    for h in range(3 * m):
        i, j = triangles[h // 3, h % 3], triangles[h // 3, (h + 1) % 3]
        if size[j] > size[i]:
            continue  # the reverse of h, if there is one, looks for h in the shorter chain
        g = last[j]
        while g >= 0 and triangles[g // 3, (g + 1) % 3] != i:
            g = before[g]
        if g >= 0:
            twin[h // 3, h % 3], twin[g // 3, g % 3] = g, h
    fine = True
    for h in range(3 * m):
        i, j, g = triangles[h // 3, h % 3], triangles[h // 3, (h + 1) % 3], twin[h // 3, h % 3]
        if j == (i + 1) % n:
            fine = fine and g < 0 and not used[i]
            used[i] = True
        else:
            fine = fine and g >= 0 and twin[g // 3, g % 3] == h  # two in one direction cannot both be the twin of g
    return twin, fine and used.all()


@njit(cache=True)
def reached(twin):
    """Which triangles can be reached from triangle 0, by their twins, (n-2, 3)."""
    found, front, waiting = np.zeros(len(twin), np.bool_), np.zeros(len(twin), np.int64), 1
    found[0] = True
    while waiting:
        waiting -= 1
        for h in twin[front[waiting]]:
            if h >= 0 and not found[h // 3]:
                found[h // 3] = True
                front[waiting] = h // 3
                waiting += 1
    return found

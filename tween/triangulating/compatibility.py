"""Compatible triangulations: the renumbering under which two are the same (Section 4.1)."""

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation, canonical_order


def match_rows(triangles: NDArray[np.int64], wanted: NDArray[np.int64]) -> NDArray[np.int64]:
    """Find the rows of one list of triangles in another list of the same triangles.

    Parameters
    ----------
    triangles, wanted : ndarray of int, shape (m, 3)
        Equal as sets, corners in any cyclic order.

    Returns
    -------
    ndarray of int, shape (m,)
        ``triangles[result]`` are the triangles of `wanted`, row for row.
    """
    rows = np.empty(len(wanted), dtype=np.int64)
    rows[canonical_order(wanted)] = canonical_order(triangles)
    return rows


def compatible_shift(first: Triangulation, second: Triangulation) -> int | None:
    """Find the renumbering that makes two triangulations compatible.

    Parameters
    ----------
    first, second : Triangulation

    Returns
    -------
    int or None
        The smallest k, 0 <= k < n, such that vertex i of `first` corresponds to vertex (i + k) mod n of
        `second`; None where no k does, or the numbers of vertices differ.

    Notes
    -----
    Triangulations without interior vertices are determined by their degrees, so it is enough to find
    one cyclic degree sequence in the other.  The paper compares in O(n^2); this is a string search in
    a doubled string, O(n).

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> T = Triangulation(square, [[0, 1, 2], [0, 2, 3]])
    >>> compatible_shift(T, T), compatible_shift(T, Triangulation(square, [[1, 2, 3], [3, 0, 1]]))
    (0, 1)

    References
    ----------
    Mukherjee and Gopi, Section 4.1.
    """
    if len(first) != len(second):
        return None
    pattern, text = ("".join(map(chr, t.degrees)) for t in (first, second))
    shift = (text + text).find(pattern)
    return None if shift < 0 else shift

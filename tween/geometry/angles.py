"""Angles of triangles, measured in floating point: for tables and pictures, where decisions take exact signs.

Legend: ``h`` half-edges as in `.triangulation`.
"""

import numpy as np
from numpy.typing import NDArray

from tween.geometry.triangulation import Triangulation


def corner_angles(T: Triangulation) -> NDArray[np.float64]:
    """Measure the three angles of each triangle.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of float64, shape (n-2, 3)
        Radians, corner for corner with `.Triangulation.triangles`; each row adds up to pi.

    Examples
    --------
    >>> np.degrees(corner_angles(Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]]))).round(6)
    array([[90., 45., 45.]])
    """
    z = (T.points @ np.array([1, 1j]))[T.triangles]
    return np.abs(np.angle((np.roll(z, 1, axis=1) - z) / (np.roll(z, -1, axis=1) - z)))


def facing_angles(T: Triangulation) -> NDArray[np.float64]:
    """Add the two angles that face each diagonal, one in each of its triangles.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    ndarray of float64, shape (n-3,)
        Radians, row for row with `.Triangulation.diagonals`.  A diagonal is locally Delaunay where they add up to
        pi or less.

    Examples
    --------
    >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    >>> np.degrees(facing_angles(Triangulation(square, [[0, 1, 2], [0, 2, 3]]))).round(6)
    array([180.])

    References
    ----------
    Mukherjee and Gopi, Section 4 and Figure 5.
    """
    h = np.flatnonzero(T.twin.ravel() > np.arange(T.twin.size))
    opposite = np.roll(corner_angles(T), 1, axis=1).ravel()  # half-edge 3t+s runs from corner s and faces corner s+2
    return np.asarray(opposite[h] + opposite[T.twin.ravel()[h]])

"""The regions into which a curve divides the plane, and how often it winds about them."""

from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from tween.geometry.predicates import orient2d

_AT_ONCE = 2**22  # pairs of a place and an edge

_Floats = NDArray[np.float64]


class Face(NamedTuple):
    """A bounded region of the plane that a curve does not cross.

    Attributes
    ----------
    polygon : shapely.Polygon
        Its outline and holes, up to rounding.
    place : ndarray of float64, shape (2,)
        A point in it.
    winding : int
        How often the curve winds about that point, exact.
    """

    polygon: shapely.Polygon
    place: _Floats
    winding: int


def winding_numbers(points: ArrayLike, places: ArrayLike) -> NDArray[np.int64]:
    """Count how often a closed polygon winds about places that are not on it, exactly.

    Parameters
    ----------
    points : array_like, shape (n, 2)
    places : array_like, shape (m, 2)

    Returns
    -------
    ndarray of int, shape (m,)
        Edges that cross the ray to the right of a place, upwards less downwards.

    Examples
    --------
    >>> winding_numbers([[0, 0], [1, 0], [1, 1], [0, 1]], [[0.5, 0.5], [2, 2]])
    array([1, 0])
    """
    a = np.asarray(points, dtype=np.float64)
    b, q = np.roll(a, -1, axis=0), np.asarray(places, dtype=np.float64).reshape(-1, 2)
    winding = np.zeros(len(q), dtype=np.int64)
    step = max(1, _AT_ONCE // len(a))
    for low in range(0, len(q), step):
        y = q[low : low + step, 1:]
        above = a[:, 1] > y  # (places, edges)
        row, edge = np.nonzero(above != np.roll(above, -1, axis=1))
        side = orient2d(a[edge], b[edge], q[low + row])
        upwards = ~above[row, edge]
        turns = np.where(upwards, side > 0, 0) - np.where(upwards, 0, side < 0)
        winding[low : low + step] = np.bincount(row, weights=turns, minlength=len(y)).astype(np.int64)
    return winding


def faces(points: _Floats) -> list[Face]:
    """Find the bounded regions into which a closed polygon divides the plane.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    list of Face
        Outlines are rounded; winding numbers are exact for the point that each face names.

    Examples
    --------
    >>> sorted(face.winding for face in faces(np.array([[0.0, 0], [2, 2], [2, 0], [0, 2]])))
    [-1, 1]
    """
    found = shapely.get_parts(shapely.polygonize([shapely.unary_union(shapely.linearrings(points))]))
    places = shapely.get_coordinates(shapely.point_on_surface(found))
    windings = winding_numbers(points, places).tolist()
    return [Face(*face) for face in zip(found, places, windings, strict=True)]


def covered_area(points: _Floats) -> float:
    """Add up the areas of all regions, each as often as a closed polygon winds about it, either way.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    float
        Unlike the signed area, 0 only where the polygon has no inside.

    Examples
    --------
    >>> covered_area(np.array([[0.0, 0], [2, 2], [2, 0], [0, 2]]))
    2.0
    """
    ring = shapely.linearrings(points)
    if shapely.is_simple(ring):
        return float(shapely.area(shapely.polygons(ring)))
    return float(sum(abs(face.winding) * face.polygon.area for face in faces(points)))

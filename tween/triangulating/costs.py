"""Costs of triangles, for `.Decomposition.optimal`: each makes a function from triangles to numbers.

d.optimal(edge_length(points))                      least total length of the diagonals
d.optimal(smallest_angle(points), "max")            largest smallest angle
d.optimal(distortion(points, target))               least distortion towards a target
d.optimal(conformal_distortion(points, target), "max")
"""

from collections.abc import Callable

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.geometry.curve import Curve

Cost = Callable[[NDArray[np.int64]], NDArray[np.float64]]


def edge_length(points: NDArray[np.float64]) -> Cost:
    """Make the cost by which the total length of all edges is least.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    callable
        From triangles, shape (m, 3), to half their perimeters: summed over a triangulation, the length of its
        diagonals plus half that of the boundary.

    Examples
    --------
    >>> edge_length(np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]))(np.array([[0, 1, 2]]))
    array([6.])
    """

    def cost(triangles: NDArray[np.int64]) -> NDArray[np.float64]:
        edges = _edges(points[triangles])
        return np.asarray(0.5 * np.hypot(edges[..., 0], edges[..., 1]).sum(axis=1))

    return cost


def smallest_angle(points: NDArray[np.float64]) -> Cost:
    """Make the cost whose least maximum is the largest smallest angle.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    callable
        From triangles, shape (m, 3), to their smallest angles, in radians, times -1.

    Examples
    --------
    >>> smallest_angle(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))(np.array([[0, 1, 2]])).round(4)
    array([-0.7854])
    """

    def cost(triangles: NDArray[np.int64]) -> NDArray[np.float64]:
        u, v = (np.roll(_edges(points[triangles]), shift, axis=1) for shift in (1, -1))
        cross = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
        return np.asarray(-np.arctan2(np.abs(cross), -(u * v).sum(axis=2)).min(axis=1))

    return cost


def distortion(source: NDArray[np.float64], target: NDArray[np.float64]) -> Cost:
    """Make the cost of mapping triangles of one shape to those of another, for `.Decomposition.optimal`.

    Parameters
    ----------
    source, target : ndarray of float64, shape (n, 2)

    Returns
    -------
    callable
        From triangles, shape (m, 3), to the symmetric Dirichlet energy of the affine maps between them,
        shape (m,): the energy of the map integrated over the source plus that of its inverse over the target,
        both shapes scaled to area 1.  Never below twice the sum of the two areas; exchanging source and
        target changes nothing.
    """
    first, second = (p / np.sqrt(Curve(p).area) for p in (source, target))

    def cost(triangles: NDArray[np.int64]) -> NDArray[np.float64]:
        return np.asarray(_dirichlet(first, second, np.asarray(triangles, dtype=np.int64)))

    return cost


def conformal_distortion(source: NDArray[np.float64], target: NDArray[np.float64]) -> Cost:
    """Make the cost of how far the maps of triangles of one shape to those of another are from similarities.

    Parameters
    ----------
    source, target : ndarray of float64, shape (n, 2)

    Returns
    -------
    callable
        From triangles, shape (m, 3), to the ratio of the larger to the smaller singular value of the affine maps
        between them, 1 for a similarity; exchanging source and target changes nothing.

    Examples
    --------
    >>> a = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    >>> conformal_distortion(a, a * [3.0, 1.0])(np.array([[0, 1, 2]]))
    array([3.])
    """

    def cost(triangles: NDArray[np.int64]) -> NDArray[np.float64]:
        (e, g), (f, h) = (_complex_edges(points, triangles) for points in (source, target))
        turned = f * g - h * e
        straight = f * g.conj() - h * e.conj()
        larger, smaller = np.abs(straight) + np.abs(turned), np.abs(straight) - np.abs(turned)
        with np.errstate(divide="ignore"):
            return np.asarray(larger / smaller)

    return cost


def _edges(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Edge opposite each corner, (m, 3, 2)."""
    return np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1)


def _complex_edges(
    points: NDArray[np.float64], triangles: NDArray[np.int64]
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Edges opposite the first and the second corner, as complex numbers."""
    a, b, c = np.ascontiguousarray(points, dtype=np.float64).view(np.complex128)[:, 0][triangles].T
    return c - b, a - c


@njit(cache=True, error_model="numpy")
def _dirichlet(first, second, triangles):
    """Energies of the affine maps from one shape to another and back, in all, for every triangle."""
    energies = np.empty(len(triangles))
    there, back = np.empty((3, 2)), np.empty((3, 2))
    for t in range(len(triangles)):
        for s in range(3):  # edge s lies opposite to corner s
            i, j = triangles[t, (s + 2) % 3], triangles[t, (s + 1) % 3]
            for k in range(2):
                there[s, k], back[s, k] = first[i, k] - first[j, k], second[i, k] - second[j, k]
        energies[t] = _energy(there, back) + _energy(back, there)
    return energies


@njit(cache=True, error_model="numpy")
def _energy(edges, images):
    """Energy of the affine map that sends edges to images: half the sum of cot(angle) * |opposite image|**2.

    A triangle that is flat in floating point costs infinitely much.
    """
    total = 0.0
    for s in range(3):
        # edges run around, so of the two at corner s one arrives: the minus makes both leave it
        u, v = edges[(s + 1) % 3], edges[(s + 2) % 3]
        total += -(u[0] * v[0] + u[1] * v[1]) * (images[s, 0] * images[s, 0] + images[s, 1] * images[s, 1])
    # cot = that product over this one, which is the same at every corner: one division does
    twice_area = edges[1, 0] * edges[2, 1] - edges[1, 1] * edges[2, 0]
    return 0.5 * total / twice_area if twice_area > 0.0 else np.inf

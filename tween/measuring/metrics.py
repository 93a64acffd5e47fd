"""How even a morph is: the area matrix, its rank, and the variance of the frame differences."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tween.morphing.morph import Morph

HEADLINE_RTOL = 1e-6
"""Relative tolerance at which `area_rank` is reported where one number must do."""


_AT_ONCE = 2**22  # numbers: vertices times frames, or entries of an area matrix


def area_matrix(m: Morph, frames: int = 100, out: NDArray[np.float64] | None = None) -> NDArray[np.float64]:
    """Compute the area of every triangle in every frame.

    Parameters
    ----------
    m : Morph
    frames : int
        Evenly spaced in time, both ends included.  The paper does not give its number.
    out : ndarray of float64, shape (n-2, frames), optional
        Where to write to, such as a memory map for what does not fit into memory.

    Returns
    -------
    ndarray of float64, shape (n-2, frames)
        Fractions of the source's total area; a row a triangle.  A flip replaces two triangles by two, which
        keep the two rows.

    Notes
    -----
    O(n frames).  Shapes are made by blocks of frames, so that beside the result little memory is needed.

    Examples
    --------
    >>> from tween import morph, triangulate
    >>> T = triangulate([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]])
    >>> A = area_matrix(morph(T, T.on_disk()), frames=10)
    >>> A.shape, round(float(A[:, 0].sum()), 12)
    ((4, 10), 1.0)

    References
    ----------
    Mukherjee and Gopi, Section 7, "Evaluation".
    """
    times = np.linspace(0.0, 1.0, frames)
    areas = np.empty((len(m.source.triangles), frames)) if out is None else out
    block = max(1, _AT_ONCE // len(m.source))
    for first in range(0, frames, block):
        areas[:, first : first + block] = _areas(m, times[first : first + block])
    areas /= m.source.areas.sum()
    return areas


def _areas(m: Morph, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Areas, (n-2, k), at some times."""
    shapes, stages = m.at(times), m.stage_at(times)
    areas = np.empty((len(m.source.triangles), len(times)))
    for stage in np.unique(stages) if stages.any() else [0]:
        now = np.flatnonzero(stages == stage)
        _measure(shapes, m.triangles_at(times[now[0]]), now, areas)
    return areas


@njit(cache=True)
def _measure(shapes, triangles, now, areas):
    """Write the areas, (n-2, k), of triangles in some of the shapes, (k, n, 2)."""
    for f in now:
        for i in range(len(triangles)):
            a, b, c = triangles[i, 0], triangles[i, 1], triangles[i, 2]
            x, y = shapes[f, a, 0], shapes[f, a, 1]
            ux, uy, vx, vy = shapes[f, b, 0] - x, shapes[f, b, 1] - y, shapes[f, c, 0] - x, shapes[f, c, 1] - y
            areas[i, f] = 0.5 * (ux * vy - uy * vx)


def area_rank(A: NDArray[np.float64], rtol: float = HEADLINE_RTOL) -> int:
    """Count the singular values of an area matrix that are not negligible (AR of the paper).

    Parameters
    ----------
    A : ndarray of float64, shape (n-2, frames)
    rtol : float
        Singular values up to `rtol` times the largest count as zero.

    Returns
    -------
    int

    Notes
    -----
    The paper gives no tolerance.  At machine precision the rank is noise that differs between
    processors; at the default, perturbing the areas by 1e-12 of their size does not move it, unless a
    singular value lies just there.

    A matrix of more than four million entries is first reduced by QR decompositions of blocks of rows, which keep
    the singular values to the same accuracy, where the Gram matrix would square the tolerance.  O(n frames**2).

    Examples
    --------
    >>> area_rank(np.outer([1.0, 2.0, 3.0], [1.0, 1.0, 2.0]))
    1

    References
    ----------
    Mukherjee and Gopi, Section 7 and Table 1, row AR.
    """
    return rank_of(singular_values(A), rtol)


def singular_values(A: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the singular values of an area matrix.

    Parameters
    ----------
    A : ndarray of float64, shape (n-2, frames)
        It may be a memory map.

    Returns
    -------
    ndarray of float64, shape (min(n-2, frames),)
        In descending order.

    Examples
    --------
    >>> singular_values(np.diag([1.0, 3.0])).tolist()
    [3.0, 1.0]
    """
    rows = max(_AT_ONCE // A.shape[1], 2 * A.shape[1])
    if A.size > _AT_ONCE and len(A) > rows:
        top = np.empty((0, A.shape[1]))
        for first in range(0, len(A), rows):
            top = np.asarray(np.linalg.qr(np.concatenate([top, A[first : first + rows]]), mode="r"), np.float64)
        A = top
    return np.asarray(np.linalg.svd(A, compute_uv=False), np.float64)


def rank_of(singular_values: NDArray[np.floating], rtol: float) -> int:
    """Count the singular values above `rtol` times the largest.

    Parameters
    ----------
    singular_values : ndarray of float, shape (r,)
        In descending order.
    rtol : float

    Returns
    -------
    int
    """
    return int(np.sum(singular_values > rtol * singular_values[0]))


def frame_variance(A: NDArray[np.float64]) -> float:
    """Compute the variance of the lengths of the steps from frame to frame (Var of the paper).

    Parameters
    ----------
    A : ndarray of float64, shape (n-2, frames)
        Areas as fractions of the source's.

    Returns
    -------
    float
        Of the frames - 1 Euclidean lengths of the differences of adjacent columns, in squared
        fractions of the source's area.

    Examples
    --------
    >>> even = np.array([[0.5, 0.6, 0.7], [0.5, 0.4, 0.3]])
    >>> round(frame_variance(even), 15)
    0.0

    References
    ----------
    Mukherjee and Gopi, Section 7 and Table 1, row Var.
    """
    return float(np.var(np.linalg.norm(np.diff(A, axis=1), axis=0)))


def angle_sums(m: Morph, times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the sum of the angles of the triangles at each vertex.

    Parameters
    ----------
    m : Morph
    times : ndarray of float64, shape (k,)

    Returns
    -------
    ndarray of float64, shape (n, k)
        Radians.

    Notes
    -----
    Shapes bound immersed disks while all triangles are positive and no sum reaches 2 pi, which `tween.certify`
    decides exactly.  O(n k).

    Examples
    --------
    >>> from tween import morph, triangulate
    >>> T = triangulate([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> (angle_sums(morph(T, T.on_disk()), np.array([0.0, 1.0])) / np.pi).round(12).tolist()
    [[0.5, 0.5], [0.5, 0.5], [0.5, 0.5], [0.5, 0.5]]
    """
    shapes, stages = m.at(times), m.stage_at(times)
    sums = np.zeros((len(m.source), len(times)))
    for stage in np.unique(stages):
        now = np.flatnonzero(stages == stage)
        triangles = m.triangles_at(float(times[now[0]]))
        corners = shapes[now][:, triangles]
        for i in range(3):
            u, v = (corners[:, :, (i + k) % 3] - corners[:, :, i] for k in (1, 2))
            cross, dot = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0], (u * v).sum(axis=2)
            np.add.at(sums, (triangles[:, i][:, None], now), np.arctan2(cross, dot).T)
    return sums

"""How even a morph is: the area matrix, its rank, and the variance of the frame differences."""

import numpy as np
from numpy.typing import NDArray

from tween.motion import Morph

HEADLINE_RTOL = 1e-6
"""Relative tolerance at which `area_rank` is reported where one number must do."""


def area_matrix(m: Morph, frames: int = 100) -> NDArray[np.float64]:
    """Compute the area of every triangle in every frame.

    Parameters
    ----------
    m : Morph
    frames : int
        Evenly spaced in time, both ends included.  The paper does not give its number.

    Returns
    -------
    ndarray of float64, shape (n-2, frames)
        Fractions of the source's total area; a row a triangle.  A flip replaces two triangles by two, which
        keep the two rows.

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
    shapes, stages = m.at(times), m.stage_at(times)
    areas = np.empty((len(m.source.triangles), frames))
    for stage in np.unique(stages):
        now = stages == stage
        a, b, c = np.moveaxis(shapes[now][:, m.triangles_at(times[now][0])], 2, 0)
        u, v = b - a, c - a
        areas[:, now] = 0.5 * (u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]).T
    return areas / m.source.areas.sum()


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

    Examples
    --------
    >>> area_rank(np.outer([1.0, 2.0, 3.0], [1.0, 1.0, 2.0]))
    1

    References
    ----------
    Mukherjee and Gopi, Section 7 and Table 1, row AR.
    """
    return rank_of(np.linalg.svd(A, compute_uv=False), rtol)


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

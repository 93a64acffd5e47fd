"""Triangles that only rounding makes: which count as none, so that a match is the same wherever the curves lie."""

import numpy as np
from numba import njit

from tween.geometry.predicates import orient2d_sign
from tween.geometry.triangulation import Triangulation

FLAT = 1e-10
"""Of the sum of the squares of two sides: a triangle of less than half this area counts as flat, where none must be."""

_SURE = 1e-14  # likewise: a larger cross product has the sign of the exact one, whatever rounding did
_THIN = 1e-6  # of the squares of two sides: a disk that has so thin triangles may need flat ones, too


@njit(cache=True)
def side_of(a, b, c, flat):
    """Whether c lies to the left of ab, 1.0, or to the right, -1.0; 0.0 on the line, or so near that a turn decides.

    Where three points are collinear, rounding makes them a triangle as soon as the curve is turned.  So with `flat`
    above zero such triangles count as none, and the same shape has the same chords wherever it lies.  With zero the
    sign is the exact one.
    """
    ux, uy, wx, wy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    cross, size = ux * wy - uy * wx, ux * ux + uy * uy + wx * wx + wy * wy
    if abs(cross) > max(flat, _SURE) * size:
        return 1.0 if cross > 0.0 else -1.0
    return 0.0 if flat > 0.0 else orient2d_sign(a[0], a[1], b[0], b[1], c[0], c[1])


def least_flat(T: Triangulation) -> float:
    """How flat a triangle must be to count as none, see `side_of`: zero where T itself has nearly as flat ones.

    Parameters
    ----------
    T : Triangulation

    Returns
    -------
    float
    """
    corners = T.points[T.triangles]
    u, w = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    size = np.abs(np.concatenate([u, w])).max()
    u, w = u / size, w / size
    cross = u[:, 0] * w[:, 1] - u[:, 1] * w[:, 0]
    return FLAT if (cross > _THIN * (u * u + w * w).sum(axis=1)).all() else 0.0

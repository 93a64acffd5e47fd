"""One drawing fitted to another: files come in units and places of their own."""

from typing import Any, Literal, get_args

import numpy as np

from tween.geometry.curve import Curve, as_curve

FitBy = Literal["area", "box", "none"]


def fit(curve: Any, to: Any, by: FitBy = "area") -> Curve:
    """Scale a curve to the size of another and move it to its place.

    Parameters
    ----------
    curve : Curve, Triangulation or array_like of shape (n, 2)
        What is scaled and moved; it is not turned.
    to : Curve, Triangulation or array_like of shape (m, 2)
        What it is fitted to.
    by : {"area", "box", "none"}
        "area": equal areas and centres of mass of the vertices, as morphs are placed.  "box": bounding boxes with one
        middle, one as large as fits into the other.  "none": as it is.

    Returns
    -------
    Curve
        Vertex i is vertex i of the curve; a clockwise array is reversed first.

    Raises
    ------
    CurveError
        Where one is no curve.
    ValueError
        For another `by`, and where areas cannot be compared: that of a curve that winds as much one way as the other
        is 0.

    Examples
    --------
    >>> square, far = [[0, 0], [1, 0], [1, 1], [0, 1]], [[100, 0], [300, 0], [300, 200], [100, 200]]
    >>> fit(far, square).points.tolist()
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
    """
    if by not in get_args(FitBy):
        raise ValueError(f"by is {by!r}, expected one of {', '.join(get_args(FitBy))}")
    moved, still = as_curve(curve), as_curve(to)
    if by == "none":
        return moved
    p, q = moved.points, still.points
    if by == "area":
        if not (moved.area > 0 and still.area > 0):
            found = f"{moved.area:g} and {still.area:g}"
            raise ValueError(f"the areas are {found}, expected positive ones; by='box' does not need them")
        scale, here, there = np.sqrt(still.area / moved.area), p.mean(axis=0), q.mean(axis=0)
    else:
        scale = float((np.ptp(q, axis=0) / np.maximum(np.ptp(p, axis=0), 1e-300)).min())
        here, there = (0.5 * (points.min(axis=0) + points.max(axis=0)) for points in (p, q))
    return Curve(there + scale * (p - here))

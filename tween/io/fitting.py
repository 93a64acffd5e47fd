"""One curve brought to the place and the size of another: a letter and a stroke in pixels have no unit in common."""

import numpy as np
from numpy.typing import ArrayLike

from tween.choices import FITS, Fit
from tween.errors import CurveError
from tween.geometry.curve import Curve, as_curve


def fit(curve: Curve | ArrayLike, onto: Curve | ArrayLike, by: Fit = "area") -> Curve:
    """Scale and move a curve so that it stands where another one stands; nothing is turned or distorted.

    Parameters
    ----------
    curve : Curve or array_like of shape (n, 2)
    onto : Curve or array_like of shape (m, 2)
    by : {"area", "box", "none"}
        "area": to the same area, and the same centre of the vertices' box.  "box": to the same longer side of that
        box, and the same centre.  "none": not at all.

    Returns
    -------
    Curve
        With the same vertices in the same order.

    Raises
    ------
    CurveError
        Where an area is not positive, or the scaled curve is none.
    ValueError
        Where `by` is none of those.

    Examples
    --------
    >>> square = Curve([[0, 0], [10, 0], [10, 10], [0, 10]])
    >>> fit([[0, 0], [1, 0], [1, 4], [0, 4]], square, "box").points.tolist()
    [[3.75, 0.0], [6.25, 0.0], [6.25, 10.0], [3.75, 10.0]]
    >>> fit([[0, 0], [1, 0], [1, 4], [0, 4]], square, "area").area
    100.0
    """
    if by not in FITS:
        raise ValueError(f"by is {by!r}, expected one of {', '.join(FITS)}")
    moved, fixed = as_curve(curve), as_curve(onto)
    if by == "none":
        return moved
    (low, high), (goal_low, goal_high) = ((c.points.min(axis=0), c.points.max(axis=0)) for c in (moved, fixed))
    if by == "box":
        scale = float((goal_high - goal_low).max() / (high - low).max())
    else:
        if min(moved.area, fixed.area) <= 0:
            raise CurveError(f"areas are {moved.area:g} and {fixed.area:g}, expected positive ones; fit by 'box'")
        scale = float(np.sqrt(fixed.area / moved.area))
    return Curve((moved.points - (low + high) / 2) * scale + (goal_low + goal_high) / 2)

"""Rings of other libraries taken for points, known by what they offer: nothing is imported for them."""

from typing import Any

from numpy.typing import ArrayLike

from tween.errors import CurveError


def ring_points(shape: Any) -> ArrayLike:
    """Return the points of what a geometry library calls a polygon, a ring or a line; anything else as it is.

    Parameters
    ----------
    shape : object
        With ``geom_type``, and ``coords`` or ``exterior``, as in shapely; or array_like.

    Returns
    -------
    array_like
        Positions of two numbers; of a ring the last equals the first.

    Raises
    ------
    CurveError
        Where the shape is more than one ring: a polygon with holes, or of several parts; or empty.

    Examples
    --------
    >>> import shapely
    >>> ring_points(shapely.box(0, 0, 2, 1))
    [(2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (0.0, 0.0), (2.0, 0.0)]
    >>> ring_points(shapely.box(0, 0, 9, 9) - shapely.box(1, 1, 2, 2))
    Traceback (most recent call last):
    ...
    tween.errors.CurveError: the Polygon has 1 hole, expected none; take its exterior, or one of its interiors
    """
    kind = getattr(shape, "geom_type", None)
    if not isinstance(kind, str):
        points: ArrayLike = shape
        return points
    if getattr(shape, "is_empty", False):
        raise CurveError(f"the {kind} is empty, expected a ring")
    holes = len(getattr(shape, "interiors", ()))
    if holes:
        found = f"{holes} hole{'s' * (holes > 1)}"
        raise CurveError(f"the {kind} has {found}, expected none; take its exterior, or one of its interiors")
    parts = list(getattr(shape, "geoms", [shape]))
    if len(parts) != 1:
        raise CurveError(f"the {kind} has {len(parts)} parts, expected one; take one of its geoms")
    if parts[0] is not shape:
        return ring_points(parts[0])
    coordinates = getattr(getattr(shape, "exterior", shape), "coords", None)
    if coordinates is None or kind == "Point":
        raise CurveError(f"a {kind} is no curve, expected a polygon, a ring or a line")
    return [(x, y) for x, y, *_ in coordinates]

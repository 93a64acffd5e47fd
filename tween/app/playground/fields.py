"""Fields to draw in: where a curve is placed in one, and what one shows of it.

A field is `BOX` units wide and high, y up; a curve fills it up to a margin, or stays where it was drawn.
"""

from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray

from tween.triangulating.repair.explanation import Explanation, Loop

BOX = 1000
"""Width and height of a field."""

_MARGIN = 0.06 * BOX
_MOST_MARKS = 400  # of one kind

_Floats = NDArray[np.float64]


class Placement(NamedTuple):
    """Where the plane of a curve is in a field.

    Attributes
    ----------
    scale : float
        Units of the field for a unit of the curve.
    x, y : float
        Where the origin of the curve is.
    """

    scale: float = 1.0
    x: float = 0.0
    y: float = 0.0

    def forth(self, points: ArrayLike) -> list[int]:
        """Place points in the field.

        Parameters
        ----------
        points : array_like, shape (n, 2)

        Returns
        -------
        list of int
            x, y, x, y, ..., in units of the field.

        Examples
        --------
        >>> Placement(2.0, 10.0, 0.0).forth([[1, 2], [3, 4]])
        [12, 4, 16, 8]
        """
        flat: list[int] = np.rint(np.asarray(points) * self.scale + [self.x, self.y]).astype(int).ravel().tolist()
        return flat

    def back(self, places: ArrayLike) -> _Floats:
        """Say where in the plane of the curve places of the field are.

        Parameters
        ----------
        places : array_like, shape (n, 2)

        Returns
        -------
        ndarray of float64, shape (n, 2)

        Examples
        --------
        >>> Placement(2.0, 10.0, 0.0).back([[12, 4]]).tolist()
        [[1.0, 2.0]]
        """
        return (np.asarray(places, dtype=np.float64) - [self.x, self.y]) / self.scale


def fitting(points: _Floats) -> Placement:
    """Place points as large as a field allows.

    Parameters
    ----------
    points : ndarray of float64, shape (..., 2)
        Of one shape, or of several that are to have one scale.

    Returns
    -------
    Placement

    Examples
    --------
    >>> square = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    >>> fitting(square).forth(square)
    [60, 280, 940, 280, 60, 720]
    """
    axes = tuple(range(points.ndim - 1))
    low, high = points.min(axis=axes), points.max(axis=axes)
    scale = float((BOX - 2 * _MARGIN) / (high - low).max())
    x, y = (0.5 * BOX - 0.5 * scale * (low + high)).tolist()
    return Placement(scale, x, y)


def explained(explanation: Explanation, placement: Placement) -> dict[str, Any]:
    """Say what a field draws of why a curve bounds no disk.

    Parameters
    ----------
    explanation : Explanation
    placement : Placement

    Returns
    -------
    dict
        places, tiny : where the curve meets itself, and where its tiny loops are; negative : rings of the regions about
        which it winds clockwise; surplus : loops that are too many for a turning number of 1; mended : the curve of the
        best suggestion, or nothing; lost : the loops that it cuts off; advice : the suggestion in words.  Everything as
        lists x, y, x, y, ...

    Examples
    --------
    >>> import numpy as np
    >>> from tween import decompose
    >>> points = np.array([[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 3.0]])
    >>> seen = explained(decompose(points).explain(), fitting(points))
    >>> len(seen["lost"]), seen["advice"]
    (1, 'Without the dashed loop it bounds one; 36 % of the area is lost.')
    """
    turning = explanation.curve.turning_number
    surplus = [loop.points for loop in explanation.loops if (loop.area > 0) == (turning > 1)] if turning != 1 else []
    best = explanation.suggestions[0] if explanation.suggestions else None
    lost = [loop for loop in best.loops if len(loop)] if best else []
    return {
        "places": placement.forth(explanation.places[:_MOST_MARKS]),
        "tiny": placement.forth(_places(explanation.tiny[:_MOST_MARKS])),
        "negative": [_rings(face.polygon, placement) for face in explanation.negative[:_MOST_MARKS]],
        "surplus": [placement.forth(points) for points in surplus[:_MOST_MARKS]],
        "mended": placement.forth(best.curve.points) if best else [],
        "lost": [placement.forth(loop) for loop in lost],
        "advice": _advice(explanation),
    }


def _places(loops: tuple[Loop, ...]) -> _Floats:
    return np.reshape([loop.place for loop in loops], (-1, 2))


def _rings(polygon: shapely.Polygon, placement: Placement) -> list[list[int]]:
    return [placement.forth(np.array(ring.coords)) for ring in (polygon.exterior, *polygon.interiors)]


def _advice(explanation: Explanation) -> str:
    """The best suggestion; the field draws what it speaks of."""
    if not explanation.suggestions:
        return "No way to mend it was found."
    best = explanation.suggestions[0]
    percent = f"{round(100 * best.share)} %" if best.share >= 0.01 else "less than 1 %"
    if best.what == "clean":
        return f"Smoothed, it bounds one; {percent} of the area is lost."
    many = f"{len(best.loops)} dashed loops" if len(best.loops) > 1 else "dashed loop"
    return f"Without the {many} it bounds one; {percent} of the area is lost."

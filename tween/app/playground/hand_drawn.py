"""Curves drawn by hand: from a stroke to a polygon, and a verdict in plain words.

    stroke -> points -> Curve -> verdict

A field to draw in is `.fields.BOX` units wide and high, y up.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import gaussian_filter1d

from tween.app.playground.fields import BOX, Placement, fitting
from tween.errors import CurveError
from tween.gallery.generators import evenly, on_grid
from tween.geometry.curve import Curve, as_curve
from tween.plural import counted
from tween.triangulating.decomposition import Decomposition, decompose
from tween.triangulating.repair.explanation import Explanation

MOST_COUNTED = 200
"""Vertices up to which triangulations are counted unasked: beyond, it may take a while."""

_FEWEST, _MOST, _STEP = 60, 120, 25.0  # vertices of a curve drawn by hand, and the length of an edge in between
_FINE, _ENDS = 400, 40  # points of a stroke, and how many of them may be cut off at each end
_CLOSE = 0.05 * BOX  # how close to each other the cut ends have to be
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")

_Floats = NDArray[np.float64]


def from_stroke(stroke: ArrayLike) -> _Floats:
    """Make a closed curve of what a hand has drawn.

    Parameters
    ----------
    stroke : array_like, shape (k, 2)
        Places of the pointer, in units of which a field is `.fields.BOX` wide.

    Returns
    -------
    ndarray of float64, shape (n, 2)
        60 to 120 points, evenly by arc length and lightly smoothed.  Where the hand went past its beginning, the
        ends are cut off where they come close; the last point is joined to the first.

    Raises
    ------
    CurveError
        Where the stroke is no array of finite points, or too short.

    Examples
    --------
    >>> t = np.linspace(0, 6.5, 40)  # around a circle, and a little further
    >>> points = from_stroke(np.stack([500 + 300 * np.cos(t), 500 + 300 * np.sin(t)], axis=1))
    >>> points.shape, Curve(points).turning_number
    ((75, 2), 1)
    """
    path = _checked(stroke)
    length = _length(path)
    if length < 0.15 * BOX:
        raise CurveError("That is too short for a curve: press, go around, let go.")
    closed = _closed(_without_overshoot(evenly(path, _FINE), length / _FINE))
    n = min(max(round(_length(closed) / _STEP), _FEWEST), _MOST)
    smooth = gaussian_filter1d(evenly(closed, 4 * n + 1)[:-1], 3.0, axis=0, mode="wrap")
    return on_grid(evenly(_closed(smooth), n + 1)[:-1])


def _checked(stroke: ArrayLike) -> _Floats:
    try:
        path = np.array(stroke, dtype=np.float64)
    except (TypeError, ValueError):
        raise CurveError("the stroke is no list of places (x, y)") from None
    if path.ndim != 2 or path.shape[1] != 2 or not np.isfinite(path).all():
        raise CurveError(f"the stroke has shape {path.shape}, expected finite places, (k, 2)")
    return path


def _length(path: _Floats) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())


def _closed(path: _Floats) -> _Floats:
    return np.concatenate([path, path[:1]])


def _without_overshoot(path: _Floats, step: float) -> _Floats:
    """Cut both ends where they come close: a hand that goes past its beginning would add a turn."""
    head, tail = path[:_ENDS], path[: -_ENDS - 1 : -1]
    gaps = np.hypot(*(head[:, None] - tail[None]).transpose(2, 0, 1))
    lost = step * (np.arange(_ENDS)[:, None] + np.arange(_ENDS))
    cost = np.where(gaps < _CLOSE, gaps + 0.5 * lost, np.inf)
    i, j = np.unravel_index(np.argmin(cost), cost.shape)
    return path[i : len(path) - j]


class Shape(NamedTuple):
    """A curve that was drawn or chosen, and what is known about it.

    Attributes
    ----------
    curve : Curve or None
        None where there is none yet.
    answer : Decomposition or None
        Whether it bounds an immersed disk.
    words : str
        The same in plain words.
    drawn : bool
        Whether its coordinates are those of the field.
    disk : bool
        Whether it is the disk that the other one becomes.
    placement : Placement
        Where it is in the field.
    explanation : Explanation or None
        Why it bounds no disk.
    broken : ndarray of float64, shape (n, 2), or None
        Points that make no curve, where there is none.
    moved : bool
        Whether vertices of another shape were moved to make it, whose numbers are the rows of `Curve.origin`.
    """

    curve: Curve | None
    answer: Decomposition | None
    words: str
    drawn: bool = False
    disk: bool = False
    placement: Placement = Placement()
    explanation: Explanation | None = None
    broken: _Floats | None = None
    moved: bool = False


def judge(
    points: Curve | ArrayLike, drawn: bool = False, placement: Placement | None = None, brief: bool = False
) -> Shape:
    """Say in plain words whether a curve bounds an immersed disk, or why not.

    Parameters
    ----------
    points : Curve or array_like of shape (n, 2)
    drawn : bool
        Whether its coordinates are those of the field.
    placement : Placement, optional
        Where it is in the field; by default as large as that allows, or where it was drawn.
    brief : bool
        Whether to leave out what takes longer: how many triangulations there are, or what would mend it.

    Returns
    -------
    Shape

    Examples
    --------
    >>> judge([[0, 0], [2, 0], [0, 2], [2, 2]]).words
    'Bounds no disk: it turns as much to the right as to the left, and the boundary of a disk turns once.'
    """
    curve = as_curve(points)
    answer = decompose(curve)
    words = _bounds(curve, answer, brief) if answer else _bounds_none(curve.turning_number)
    if curve.reversed_input and not brief:
        words += " Drawn clockwise, so it is traversed the other way."
    if placement is None:
        placement = Placement() if drawn else fitting(curve.points)
    explanation = None if answer or brief else answer.explain()
    return Shape(curve, answer, words, drawn, placement=placement, explanation=explanation)


def _bounds(curve: Curve, answer: Decomposition, brief: bool) -> str:
    facts = [f"{len(curve)} vertices", counted(len(curve.crossings), "crossing")]
    if len(curve) <= MOST_COUNTED and not brief:
        facts.append(f"{_roughly(answer.count)} triangulations")
    return f"Bounds an immersed disk. {', '.join(facts)}."


def _bounds_none(turning_number: int) -> str:
    if turning_number == 0:
        return "Bounds no disk: it turns as much to the right as to the left, and the boundary of a disk turns once."
    if turning_number > 1:
        return f"Bounds no disk: it turns {turning_number} times, and the boundary of a disk turns once."
    return "Bounds no disk: it turns once, but no triangles with the same side up fill it; it would have to fold."


def _roughly(count: int) -> str:
    """A large number in two digits and a power of ten."""
    if count < 1000:
        return str(count)
    digits, power = f"{count:.1e}".split("e+")
    return f"{digits} × 10{str(int(power)).translate(_RAISED)}"

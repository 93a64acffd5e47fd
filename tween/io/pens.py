"""Lines as a pen draws them: strips with the ends and the corners that a drawing program gives them.

Legend: ``p`` points of the line; ``h`` half the width; ``k`` a corner.
"""

import numpy as np
from numpy.typing import NDArray

from tween.errors import CurveError
from tween.gallery.generators import ribbon
from tween.geometry.curve import Curve, without_repetitions
from tween.io.formats.content import Pen
from tween.triangulating.decomposition import decompose

_HALF_CIRCLE = 12  # points of a round end
_SMOOTH = 0.01  # a tip that stands out by less than this share of half the width is left, whatever the corners are

_Floats = NDArray[np.float64]
_PLAIN = Pen()


def drawn(line: _Floats, width: float, pen: Pen = _PLAIN) -> Curve:
    """Draw a line with a pen.

    Parameters
    ----------
    line : ndarray of float64, shape (m, 2)
        Where the last point equals the first, it is walked once around, the ends of the strip meet, and have no caps.
    width : float
        In the units of the line.
    pen : Pen
        Its caps and its corners; the width is the one given.

    Returns
    -------
    Curve
        Along the right side, around the end, back along the left side, around the start, as `.ribbon` makes it.

    Raises
    ------
    CurveError
        Where a bend is too tight for the width.

    Examples
    --------
    >>> corner = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0]])
    >>> drawn(corner, 2).points.tolist()
    [[0.0, -1.0], [5.0, -1.0], [5.0, 4.0], [3.0, 4.0], [3.0, 1.0], [0.0, 1.0]]
    >>> drawn(corner, 2, Pen(join="bevel", cap="square")).points[:4].round(6).tolist()
    [[-1.0, -1.0], [4.0, -1.0], [5.0, -0.0], [5.0, 5.0]]
    """
    p = without_repetitions(line)
    closed = bool(len(p) > 1 and (p[0] == p[-1]).all())
    if pen.cap == "square" and not closed and 0 < width < np.inf and len(p) > 1:
        p = _lengthened(p, 0.5 * width)
    cap = _HALF_CIRCLE if pen.cap == "round" and not closed else 0
    strip = ribbon(p, width, cap)  # refuses bends that are too tight
    corners = _corners(p, pen)
    if not corners:
        return strip
    m = len(p)
    right, end, left, start = np.split(strip.points, [m, m + cap, 2 * m + cap])
    sides = [_cornered(right, p, corners, 0.5 * width, -1.0), end, _cornered(left[::-1], p, corners, 0.5 * width, 1.0)]
    curve = Curve(np.concatenate([*sides[:2], sides[2][::-1], start]))
    if not decompose(curve):
        raise CurveError(f"corners drawn as {pen.join} do not fit the width {width:g}; take a narrower pen")
    return curve


def _lengthened(p: _Floats, by: float) -> _Floats:
    """Move both ends outwards."""
    first, last = p[0] - p[1], p[-1] - p[-2]
    return np.concatenate([[p[0] + by * first / np.hypot(*first)], p[1:-1], [p[-1] + by * last / np.hypot(*last)]])


def _corners(p: _Floats, pen: Pen) -> dict[int, _Floats]:
    """The directions, as angles, of the pen's rim around each corner that is not mitred, from edge to edge."""
    angles = np.arctan2(*np.diff(p, axis=0).T[::-1])
    turns = (np.diff(angles) + np.pi) % (2 * np.pi) - np.pi
    found = {}
    for k, turn in enumerate(turns.tolist(), 1):
        tip = 1 / max(np.cos(turn / 2), 1e-12)
        if tip < 1 + _SMOOTH or (pen.join not in ("round", "bevel") and tip <= pen.limit):
            continue
        steps = int(np.ceil(abs(turn) / np.pi * (_HALF_CIRCLE + 1))) if pen.join == "round" else 1
        found[k] = angles[k - 1] + turn * np.arange(steps + 1) / steps
    return found


def _cornered(side: _Floats, p: _Floats, corners: dict[int, _Floats], h: float, sense: float) -> _Floats:
    """One side of the strip, with points around the corners that it passes on the outside; left is 1, right -1."""
    pieces = [side[:0]]
    for k in range(len(p)):
        rim = corners.get(k)
        if rim is None or (rim[-1] - rim[0]) * sense > 0:
            pieces.append(side[k : k + 1])
        else:
            pieces.append(p[k] + sense * h * np.stack([-np.sin(rim), np.cos(rim)], axis=1))
    return np.concatenate(pieces)

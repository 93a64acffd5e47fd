"""Path data of SVG: its grammar, and its curves as polylines.

Coordinates are SVG's, y downwards, until `flattened` turns y upwards.

Legend: ``d`` path data; ``x y`` coordinates of the drawing.
"""

import math
import re

import numpy as np
from numpy.typing import NDArray
from svg.path import Arc, Close, CubicBezier, Move, Path, QuadraticBezier, parse_path
from svg.path.path import NonLinear, PathSegment

from tween.errors import FileError

RELATIVE_TOLERANCE = 1e-3
"""How far a flattened curve may lie from the true one, as a fraction of its path's larger side."""

MOST_POINTS = 500_000
"""Points that one file may hold."""

_Floats = NDArray[np.float64]

# Atomic groups (?>...) keep a number from being split to make up for a missing one: "12" is not "1 2".
_SPACE = r"[ \t\r\n,]*"
_UNSIGNED = r"(?>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)"
_SIGNED = rf"(?>[+-]?{_UNSIGNED})"
_PAIR = _SPACE.join([_SIGNED] * 2)
_ARC = _SPACE.join([_UNSIGNED, _UNSIGNED, _SIGNED, "[01]", "[01]", _PAIR])
_ARGUMENTS = dict.fromkeys("MLT", _PAIR) | dict.fromkeys("HV", _SIGNED) | {"A": _ARC}
_ARGUMENTS |= dict.fromkeys("SQ", _SPACE.join([_PAIR] * 2)) | {"C": _SPACE.join([_PAIR] * 3)}
_GRAMMAR = {command: re.compile(_SPACE + arguments) for command, arguments in _ARGUMENTS.items()}
_COMMAND = re.compile(r"[ \t\r\n]*([MmZzLlHhVvCcSsQqTtAa])")
_NUMBER = re.compile(_SIGNED)


def numbers(text: str) -> list[float]:
    """Read a list of numbers as SVG writes them.

    Parameters
    ----------
    text : str
        Numbers between commas and white space, which may be left out before a sign or a point.

    Returns
    -------
    list of float

    Raises
    ------
    FileError
        Where there is anything else, or a number is too large for a double.

    Examples
    --------
    >>> numbers("1,-2-.5.25")
    [1.0, -2.0, -0.5, 0.25]
    """
    values = [float(number) for number in _NUMBER.findall(text)]
    if _NUMBER.sub("", text).strip(" \t\r\n,") or not all(map(math.isfinite, values)):
        raise FileError(f"has {text[:40]!r}, expected numbers")
    return values


def polygon(values: list[float], closed: bool) -> str:
    """Write a polygon as path data.

    Parameters
    ----------
    values : list of float
        x and y in turn.
    closed : bool
        False for a polyline.

    Returns
    -------
    str
        Empty where there are no points.

    Raises
    ------
    FileError
        Where the number of coordinates is odd.

    Examples
    --------
    >>> polygon([0, 0, 1, 0, 1, 1], closed=True)
    'M0 0 1 0 1 1Z'
    """
    if len(values) % 2:
        raise FileError(f"has {len(values)} coordinates, expected an even number")
    return f"M{' '.join(map(repr, values))}{'Z' * closed}" if values else ""


def rectangle(x: float, y: float, width: float, height: float, rx: float, ry: float) -> str:
    """Write a rectangle with round corners, or an ellipse, which is all corners, as path data.

    Parameters
    ----------
    x, y : float
        The corner of the smallest coordinates.
    width, height : float
    rx, ry : float
        Radii of the corners; at most half the width and half the height count.

    Returns
    -------
    str
        Empty where the rectangle has no extent.

    Raises
    ------
    FileError
        Where a length is negative.

    Examples
    --------
    >>> rectangle(0.0, 0.0, 2.0, 1.0, 0.0, 0.0)
    'M0.0 0.0 2.0 0.0 2.0 1.0 0.0 1.0Z'
    """
    if min(width, height, rx, ry) < 0:
        raise FileError("has a negative width, height or radius")
    if not width or not height:
        return ""
    if not rx or not ry:
        return polygon([x, y, x + width, y, x + width, y + height, x, y + height], closed=True)
    # Where nothing is left of a side its two ends are the same number, lest rounding makes a tiny edge of it.
    left, right = (x + rx, x + width - rx) if 2 * rx < width else (x + width / 2,) * 2
    top, bottom = (y + ry, y + height - ry) if 2 * ry < height else (y + height / 2,) * 2
    sides = [(right, y), (x + width, bottom), (left, y + height), (x, top)]
    corners = [(x + width, top), (right, y + height), (x, bottom), (left, y)]
    arc = f"A{min(rx, width / 2)!r} {min(ry, height / 2)!r} 0 0 1"
    parts = (f"L{p!r} {q!r}{arc} {s!r} {t!r}" for (p, q), (s, t) in zip(sides, corners, strict=True))
    return f"M{left!r} {y!r}{''.join(parts)}Z"


def checked(d: str) -> str:
    """Return path data whose grammar is right.

    Parameters
    ----------
    d : str

    Returns
    -------
    str
        The same; where the parser behind `flattened` would silently leave something out, it is refused.

    Raises
    ------
    FileError
        Saying where the grammar is broken, or that there are more than `MOST_POINTS` segments.

    Examples
    --------
    >>> checked("M0 0 1 1 1")
    Traceback (most recent call last):
    ...
    tween.errors.FileError: has '1' at position 8 of its path data, expected a command such as M
    """
    at, room, d = 0, MOST_POINTS, d.strip()
    while at < len(d):
        command = _COMMAND.match(d, at)
        if not command or (at == 0 and command[1] not in "Mm"):
            found = d[at : at + 20].strip()
            raise FileError(f"has {found!r} at position {at} of its path data, expected a command such as M")
        begin = at = command.end()
        arguments = _GRAMMAR.get(command[1].upper())
        while arguments and (group := arguments.match(d, at)):
            at, room = group.end(), room - 1
        if arguments and at == begin:
            raise FileError(f"has {d[at : at + 20]!r} after {command[1]} in its path data, expected numbers")
        if room < 0:
            raise _too_many()
    return d


def flattened(d: str, matrix: _Floats, tolerance: float | None = None, most: int = MOST_POINTS) -> list[_Floats]:
    """Turn path data into polylines, one for each subpath.

    Parameters
    ----------
    d : str
        Of a grammar that `checked` accepts.
    matrix : ndarray of float64, shape (3, 3)
        Of the transform to apply.
    tolerance : float, optional
        How far the polylines may lie from the curves, after the transform; by default
        `RELATIVE_TOLERANCE` of the larger side of the path.
    most : int
        Points that may be made.

    Returns
    -------
    list of ndarray of float64, shape (m, 2)
        With y upwards; of a closed subpath the last point is the first.

    Raises
    ------
    FileError
        Where there would be more points, or some are not finite.

    Notes
    -----
    A Bezier curve of degree k in n equal pieces lies within k (k-1) / (8 n^2) times its largest second
    difference of control points from the chords, and an arc of radius r that turns by a within
    r (1 - cos(a / 2n)); a linear map lengthens both by its norm at most.

    Examples
    --------
    >>> flattened("M0 0A1 1 0 0 0 2 0", np.eye(3), tolerance=0.5)[0].round(3).tolist()
    [[0.0, 0.0], [1.0, -1.0], [2.0, 0.0]]
    """
    try:
        with np.errstate(all="ignore"):  # what is too large becomes inf or nan
            path = parse_path(d)
            size = _size(path, matrix)
            wanted = RELATIVE_TOLERANCE * size if tolerance is None else tolerance
            if math.isfinite(size):
                return [_placed(line, matrix) for line in _polylines(path, (wanted or 1.0) / _norm(matrix), most)]
    except (ArithmeticError, ValueError) as error:
        if isinstance(error, FileError):
            raise
    raise FileError("has numbers too large or too small to compute with")


def _norm(matrix: _Floats) -> np.float64:
    """By how much the linear part lengthens at most; it maps z to a z + b conj(z)."""
    (p, q), (r, s) = matrix[:2, :2]
    return 0.5 * (np.hypot(p + s, r - q) + np.hypot(p - s, r + q))


def _placed(points: list[complex], matrix: _Floats) -> _Floats:
    z = np.array(points)
    x, y, _ = matrix @ np.stack([z.real, z.imag, np.ones(len(z))])
    return np.stack([x, 0.0 - y], axis=1)


def _size(path: Path, matrix: _Floats) -> float:
    """The larger side of the box around the ends of all segments and three more points of the curves."""
    points = [
        segment.point(k / 4) for segment in path for k in range(4, 0, -1 if isinstance(segment, NonLinear) else -4)
    ]
    return float(np.ptp(_placed(points, matrix), axis=0).max()) if points else 0.0


def _polylines(path: Path, tolerance: float, most: int) -> list[list[complex]]:
    lines: list[list[complex]] = []
    closed = True
    for segment in path:
        most -= (count := _pieces(segment, tolerance, most))
        if most < 0:
            raise _too_many()
        if closed or isinstance(segment, Move):
            lines.append([segment.end if isinstance(segment, Move) else segment.start])
        if not isinstance(segment, Move):
            lines[-1] += [*(segment.point(k / count) for k in range(1, count)), segment.end]
        closed = isinstance(segment, Close)
    return lines


def _pieces(segment: PathSegment, tolerance: float, most: int) -> int:
    """Into how many equal parts to cut a segment, so that each is a chord within the tolerance."""
    count = 1.0
    if isinstance(segment, QuadraticBezier):
        count = np.sqrt(abs(segment.start - 2 * segment.control + segment.end) / 4 / tolerance)
    elif isinstance(segment, CubicBezier):
        first = abs(segment.start - 2 * segment.control1 + segment.control2)
        second = abs(segment.control1 - 2 * segment.control2 + segment.end)
        count = np.sqrt(0.75 * max(first, second) / tolerance)
    elif isinstance(segment, Arc) and segment.start != segment.end and segment.radius.real * segment.radius.imag:
        radius = max(segment.radius.real, segment.radius.imag) * segment.radius_scale
        step = 4 * np.arcsin(np.sqrt(min(0.5 * tolerance / radius, 1.0)))
        count = abs(math.radians(segment.delta)) / min(step, 1.6)  # about a right angle at most
    if not count <= most:
        raise _too_many()
    return max(1, math.ceil(count))


def _too_many() -> FileError:
    return FileError(f"has more than {MOST_POINTS} points, expected fewer; a larger tolerance makes fewer of curves")

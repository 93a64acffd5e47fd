"""Outlines found in files, in standard input, or in the data of an SVG path, and what else is there.

    .svg .csv .json .geojson .npz .npy

The suffix decides on the format, or the first bytes of standard input, which goes by the name "-".
"""

import re
import sys
import warnings
from collections.abc import Callable
from math import inf
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tween.errors import FileError, NotUsedWarning
from tween.geometry.curve import Curve, without_repetitions
from tween.io.formats.content import Content, Outline
from tween.io.formats.readers import points_of, read_arrays, read_json
from tween.io.formats.svg import read_svg
from tween.io.formats.svg_path import MOST_POINTS, checked, flattened
from tween.io.formats.tables import read_csv
from tween.io.formats.whole_files import LARGEST_FILE, AnyPath, check_size, content_of, naming, suffix_of

_Floats = NDArray[np.float64]

_LISTED = 10  # names that an error lists

_READERS: dict[str, Callable[[bytes, float | None], Content]] = {
    ".svg": read_svg,
    ".csv": lambda data, _: read_csv(data),
    ".json": lambda data, _: read_json(data),
    ".geojson": lambda data, _: read_json(data),
    ".npz": lambda data, _: points_of(read_arrays(data, ".npz")),
    ".npy": lambda data, _: points_of(read_arrays(data, ".npy")),
}
_BEGINNINGS = {b"<": ".svg", b"{": ".json", b"[": ".json", b"PK": ".npz", b"\x93NUMPY": ".npy"}
_PATH_DATA = re.compile(r"\s*[Mm][\s,]*[-+.0-9][MmZzLlHhVvCcSsQqTtAaEe0-9+\-.,\s]*")


def read_outline(
    path: AnyPath,
    select: str | int | None = None,
    tolerance: float | None = None,
    width: float | None = None,
    marked: bool = False,
) -> Outline:
    """Read one line from a file, and say what else is there.

    Parameters
    ----------
    path, select, tolerance
        As in `.read_curve`.
    width : float, optional
        That of the pen with which the line is to be drawn; None where the line is the curve.
    marked : bool
        Whether circles that have an id only mark places, see `.read_marks`.

    Returns
    -------
    Outline

    Raises
    ------
    FileError
        As `.read_curve`.

    Warns
    -----
    NotUsedWarning
        As `.read_curve`.
    """
    with naming(label(path)):
        content = contents(path, tolerance)
        lines = [outline for outline in content.outlines if not (marked and outline.name in content.marks)]
        outline = _chosen(lines, select)
        notes = list(content.unused)
        if (
            width is None
            and outline.pen.alone
            and outline.pen.width
            and (outline.points[0] != outline.points[-1]).any()
        ):
            notes.append(f"{pen_hint(outline)}, as the line is open and has no fill")
        warn_of(path, notes)
        return outline


def pen_hint(outline: Outline) -> str:
    """Say with which pen a line is drawn.

    Parameters
    ----------
    outline : Outline

    Returns
    -------
    str

    Examples
    --------
    >>> from tween.io.formats.content import Pen
    >>> pen_hint(Outline("tail", np.zeros((2, 2)), Pen(8.0, alone=True)))
    "the pen of 'tail', 8 wide (--pen 8, or width=8 of tween.io.read_stroke, draws it)"
    """
    name = f"the pen of {outline.name[:40]!r}" if outline.name else "the pen"
    width = f"{outline.pen.width:.6g}"
    return f"{name}, {width} wide (--pen {width}, or width={width} of tween.io.read_stroke, draws it)"


def label(path: AnyPath) -> str:
    """Name a file, standard input or the data of a path.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    str

    Examples
    --------
    >>> label("a.svg"), label("-"), label("M0 0H1V1H0Z")
    ('a.svg', 'standard input', 'path data M0 0H1V1H0Z')
    """
    if path == "-":
        return "standard input"
    if isinstance(path, str) and _is_path_data(path):
        return f"path data {path[:30]}{'...' if len(path) > 30 else ''}"
    return str(path)


def _is_path_data(path: str) -> bool:
    return bool(_PATH_DATA.fullmatch(path)) and Path(path[:200]).suffix.lower() not in _READERS


def _read(path: AnyPath, tolerance: float | None) -> Content:
    if path == "-":
        data = sys.stdin.buffer.read(LARGEST_FILE + 1)
        check_size(len(data))
        start = data.removeprefix(b"\xef\xbb\xbf").lstrip()
        suffix = next((suffix for begin, suffix in _BEGINNINGS.items() if start.startswith(begin)), ".csv")
        return _READERS[suffix](data, tolerance)
    if isinstance(path, str) and _is_path_data(path):
        return Content([Outline("", line) for line in flattened(checked(path), np.eye(3), tolerance)], [], {})
    return _READERS[suffix_of(path, _READERS)](content_of(path), tolerance)


def contents(path: AnyPath, tolerance: float | None = None) -> Content:
    """Find what a file holds; errors do not name it.

    Parameters
    ----------
    path : path-like
    tolerance : float, optional
        As in `.read_curve`.

    Returns
    -------
    Content
        Its outlines by names of which no two are equal.

    Raises
    ------
    FileError
    """
    if tolerance is not None and not 0 < tolerance < inf:
        raise FileError(f"cannot be read with the tolerance {tolerance!r}, expected a positive length")
    content = _read(path, tolerance)
    taken: set[str] = set()
    outlines = []
    for i, outline in enumerate(content.outlines):
        name = outline.name if outline.name and outline.name not in taken else str(i)
        while name in taken:
            name += "'"
        taken.add(name)
        outlines.append(outline._replace(name=name))
    count = sum(len(outline.points) for outline in outlines)
    if count == 0:
        raise FileError("has no points, expected those of a curve")
    if count > MOST_POINTS:
        raise FileError(f"has {count} points, expected at most {MOST_POINTS}")
    return content._replace(outlines=outlines)


def _chosen(outlines: list[Outline], select: str | int | None) -> Outline:
    if select is None and len(outlines) == 1:
        return outlines[0]
    named = next((outline for outline in outlines if outline.name == select), None)
    if named is not None:
        return named
    place = int(select) if select is not None and re.fullmatch("[0-9]{1,9}", str(select)) else -1
    if 0 <= place < len(outlines):
        return outlines[place]
    listed = ", ".join(repr(o.name[:40]) + (f" ({o.part})" if o.part else "") for o in outlines[:_LISTED])
    more = f", and {len(outlines) - _LISTED} more" if len(outlines) > _LISTED else ""
    what = f"holds {len(outlines)} curves" if select is None else f"holds no curve {select!r}"
    raise FileError(f"{what}, expected the choice of one by id or place (--select, or select=): {listed}{more}")


def warn_of(path: AnyPath, notes: list[str]) -> None:
    """Say what of a file is not used.

    Parameters
    ----------
    path : path-like
    notes : list of str

    Warns
    -----
    NotUsedWarning
        Where there are any.
    """
    if notes:
        warnings.warn(f"{label(path)}: not used: {', '.join(notes)}", NotUsedWarning, stacklevel=3)


def curve_of(points: _Floats) -> Curve:
    """Make a curve of points that may be repeated, and of which the last may equal the first.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    Curve
    """
    points = without_repetitions(points)
    return Curve(points[:-1] if len(points) > 1 and (points[0] == points[-1]).all() else points)

"""Curves and strokes, read from files, from standard input, or from the data of an SVG path.

Every error is one line that begins with the name of the file.  What a file holds and nobody uses is said by a
`.NotUsedWarning`.
"""

import numpy as np

from tween.errors import CurveError, FileError
from tween.gallery.generators import ribbon
from tween.geometry.curve import Curve, without_repetitions
from tween.io.formats.svg_path import checked, flattened
from tween.io.formats.whole_files import AnyPath, naming
from tween.io.outlines import contents, curve_of, label, read_outline, warn_of
from tween.io.pens import drawn


def read_curve(path: AnyPath, select: str | int | None = None, tolerance: float | None = None) -> Curve:
    """Read one curve from a file.

    Parameters
    ----------
    path : path-like
        SVG, CSV (x and y, with or without a header), JSON (a list of points, ``{"points": ...}`` or
        ``{"curves": {id: points}}``), GeoJSON (lines and rings), npz or npy; "-" for standard input; or a str, the
        data of an SVG path.
    select : str or int, optional
        Id of the curve, or its place in the file, counted from 0; needed where there are several.
    tolerance : float, optional
        How far the polygon may lie from the curves of an SVG, in its user units; by default a
        thousandth of the larger side of each path.

    Returns
    -------
    Curve
        An open outline is closed by an edge.  A last point that equals the first is dropped, and so are
        points that equal the one before; `Curve.origin` counts those that are left.

    Raises
    ------
    FileError
        Where the file cannot be read, is none of these formats, or does not hold the one curve asked for.  A hole of
        a polygon, and each part of a polygon of several, is a curve of its own.
    CurveError
        Where the points that are left are no `Curve`.

    Warns
    -----
    NotUsedWarning
        Where the file holds something else that is not used, or the curve is the middle of a line that is drawn with
        a pen, see `.read_stroke`.

    Examples
    --------
    >>> import tempfile
    >>> from tween import write_curve
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = write_curve(f"{folder}/square.csv", Curve([[0, 0], [1, 0], [1, 1], [0, 1]]))
    ...     read_curve(path)
    Curve(4 vertices, turning number 1)
    >>> read_curve("M0 0H1V1H0Z")
    Curve(4 vertices, turning number 1)
    """
    outline = read_outline(path, select, tolerance)
    with naming(label(path)):
        return curve_of(outline.points)


def read_curves(path: AnyPath, tolerance: float | None = None) -> dict[str, Curve]:
    """Read all curves of a file.

    Parameters
    ----------
    path : path-like
    tolerance : float, optional
        As in `.read_curve`.

    Returns
    -------
    dict of str to Curve
        In the order of the file.  A curve without an id, or with one that was there before, goes by its
        place: "0", "1", ...

    Raises
    ------
    FileError, CurveError
        As `.read_curve`; the message says which curve is at fault.

    Warns
    -----
    NotUsedWarning
        Where the file holds something else that is not used.
    """
    with naming(label(path)):
        content = contents(path, tolerance)
        curves = {}
        for outline in content.outlines:
            try:
                curves[outline.name] = curve_of(outline.points)
            except CurveError as error:
                raise CurveError(f"curve {outline.name[:40]!r}: {error}") from None
        warn_of(path, content.unused)
        return curves


def read_stroke(path: AnyPath, width: float, select: str | int | None = None, tolerance: float | None = None) -> Curve:
    """Read a path, of an SVG for example, and draw it with a pen.

    Parameters
    ----------
    path : path-like
    width : float
        Distance between the two sides, in the units of the file.
    select, tolerance
        As in `.read_curve`.

    Returns
    -------
    Curve
        As `.ribbon` makes it, with the ends and corners that an SVG declares: its stroke-linecap, stroke-linejoin and
        stroke-miterlimit.  A closed path is walked once around, so that the ends of the ribbon meet.  For path data
        without a file see `stroke`.

    Raises
    ------
    FileError
        As `.read_curve`.
    CurveError
        Where a bend is too tight for the width.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "loop.svg")
    ...     _ = path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C9 0 9 9 5 9S1 0 9 0"/></svg>')
    ...     read_stroke(path, 0.5)
    Curve(132 vertices, turning number 1)
    """
    outline = read_outline(path, select, tolerance, width)
    with naming(label(path)):
        return drawn(outline.points, width, outline.pen)


def stroke(path: str, width: float, tolerance: float | None = None, cap: int = 0) -> Curve:
    """Widen an SVG path to a ribbon: the commonest way to get a curve that overlaps itself.

    Parameters
    ----------
    path : str
        Path data of one line, as in the attribute d of an SVG path; y is turned upwards.
    width : float
        Distance between the two sides, in the units of the path.
    tolerance : float, optional
        How far the middle line may lie from the path; by default a thousandth of its larger side.
    cap : int
        Points by which each end is rounded to a half circle; 0 leaves it flat.

    Returns
    -------
    Curve
        As `.ribbon` makes it.  A closed path is walked once around, so that the ends of the ribbon meet.

    Raises
    ------
    CurveError
        Where the data are no path, or draw more or less than one line; where a bend is too tight for the width.

    Examples
    --------
    >>> stroke("M0 0C9 0 9 9 5 9S1 0 9 0", width=0.5)
    Curve(132 vertices, turning number 1)
    >>> stroke("M0 0L2 0M5 5L6 6", 1)
    Traceback (most recent call last):
    ...
    tween.errors.CurveError: path data draw 2 lines, expected one

    See Also
    --------
    tween.io.read_stroke : for a path in a file.
    """
    try:
        lines = flattened(checked(path), np.eye(3), tolerance)
    except FileError as error:
        raise CurveError(f"path data {error}") from None
    if len(lines) != 1:
        raise CurveError(f"path data draw {len(lines)} lines, expected one")
    return ribbon(without_repetitions(lines[0]), width, cap)

"""Files: curves read and written, triangulations and the frames of morphs written.

    read_curve, read_curves, read_stroke    .svg .csv .json .geojson .npz .npy
    write_curve                             .svg .csv .json .geojson .npz .npy
    write_triangulation                     .svg .obj .json .npz
    write_frames                            .svg .csv .json .npz
    read_frames                             .svg .csv .json .npz, and the .svg and .html that tween plays

The suffix decides on the format.  A file is written whole or not at all: where writing fails, what stood
there before stands there still.  Every error is one line that begins with the name of the file.
"""

import re
from collections.abc import Callable
from math import inf
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tween.errors import CurveError, FileError
from tween.gallery.generators import ribbon
from tween.geometry.curve import Curve, as_curve, without_repetitions
from tween.geometry.triangulation import Triangulation
from tween.io.played import csv_frames, html_frames, svg_frames
from tween.io.readers import frames_of, parse_json, points_of, read_arrays, read_csv, read_json
from tween.io.svg import read_svg
from tween.io.svg_path import MOST_POINTS, checked, flattened
from tween.io.whole_files import AnyPath, content_of, naming, suffix_of, write
from tween.io.writers import csv_text, drawing, geojson_text, json_text, npy_bytes, npz_bytes, obj_text
from tween.measuring.playback import Playback
from tween.morphing.morph import Morph

_Floats = NDArray[np.float64]

_LISTED = 10  # names that an error lists

_READERS: dict[str, Callable[[bytes, float | None], list[tuple[str, _Floats]]]] = {
    ".svg": read_svg,
    ".csv": lambda data, _: read_csv(data),
    ".json": lambda data, _: read_json(data),
    ".geojson": lambda data, _: read_json(data),
    ".npz": lambda data, _: points_of(read_arrays(data, ".npz")),
    ".npy": lambda data, _: points_of(read_arrays(data, ".npy")),
}
_FRAME_READERS: dict[str, Callable[[bytes], object]] = {
    ".json": parse_json,
    ".npz": lambda data: read_arrays(data, ".npz"),
    ".svg": svg_frames,
    ".html": html_frames,
    ".csv": csv_frames,
}


def read_curve(path: AnyPath, select: str | int | None = None, tolerance: float | None = None) -> Curve:
    """Read one curve from a file.

    Parameters
    ----------
    path : path-like
        SVG, CSV (x and y, with or without a header), JSON (a list of points, ``{"points": ...}`` or
        ``{"curves": {id: points}}``), GeoJSON (line strings and first rings of polygons), npz or npy.
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
        Where the file cannot be read, is none of these formats, or does not hold the one curve asked for.
    CurveError
        Where the points that are left are no `Curve`.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = write_curve(f"{folder}/square.csv", Curve([[0, 0], [1, 0], [1, 1], [0, 1]]))
    ...     read_curve(path)
    Curve(4 vertices, turning number 1)
    """
    with naming(path):
        return _curve(_chosen(_outlines(path, tolerance), select))


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
    """
    with naming(path):
        curves = {}
        for name, points in _outlines(path, tolerance).items():
            try:
                curves[name] = _curve(points)
            except CurveError as error:
                raise CurveError(f"curve {name[:40]!r}: {error}") from None
        return curves


def read_stroke(path: AnyPath, width: float, select: str | int | None = None, tolerance: float | None = None) -> Curve:
    """Read a path, of an SVG for example, and widen it to a ribbon.

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
        As `.ribbon` makes it, with flat ends.  A closed path is walked once around, so that the ends
        of the ribbon meet.  For path data without a file see `stroke`.

    Raises
    ------
    FileError
        As `.read_curve`.
    CurveError
        Where a bend is too tight for the width.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "loop.svg")
    ...     _ = path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C9 0 9 9 5 9S1 0 9 0"/></svg>')
    ...     read_stroke(path, 0.5)
    Curve(132 vertices, turning number 1)
    """
    with naming(path):
        return ribbon(without_repetitions(_chosen(_outlines(path, tolerance), select)), width)


def read_frames(path: AnyPath) -> tuple[_Floats, NDArray[np.int64] | None, _Floats | None]:
    """Read the frames of a morph that `write_frames` or `tween.save_animation` has written.

    Parameters
    ----------
    path : path-like
        JSON or npz, with frames, perhaps triangles and perhaps times by these names; the CSV and SVG of
        `write_frames`; or the animated SVG and the HTML of `save_animation`, whose frames are those that are drawn,
        with their rounding and, in SVG, the way back.

    Returns
    -------
    frames : ndarray of float64, shape (k, n, 2)
        With y upwards.
    triangles : ndarray of int64, shape (n-2, 3), or (k, n-2, 3) where there are flips on the way; or None
        None where the file holds none, such as a CSV; `tween.find_triangles` finds some.
    times : ndarray of float64, shape (k,), or None where the file holds none

    Raises
    ------
    FileError
        Where the file cannot be read or holds something else.  Pictures, such as a GIF, hold no frames that could be
        read back.
    """
    with naming(path):
        return frames_of(_FRAME_READERS[suffix_of(path, _FRAME_READERS)](content_of(path)))


def write_curve(path: AnyPath, curve: Curve) -> Path:
    """Write a curve to a file.

    Parameters
    ----------
    path : path-like
        SVG, CSV, JSON, GeoJSON, npz or npy; `.read_curve` reads each of them back exactly.
    curve : Curve, or what stands for one
        As in `tween.morph`.

    Returns
    -------
    Path
        That of the file.

    Raises
    ------
    FileError
        Where it cannot be written; what stood there before stands there still.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(write_curve(f"{folder}/triangle.csv", Curve([[0, 0], [1, 0], [0.5, 1]])).read_text())
    x,y
    0.0,0.0
    1.0,0.0
    0.5,1.0
    <BLANKLINE>
    """
    points = as_curve(curve).points
    formats: dict[str, Callable[[], str | bytes]] = {
        ".svg": lambda: drawing(points[None]),
        ".csv": lambda: csv_text("x,y", *points.T),
        ".json": lambda: json_text(points=points),
        ".geojson": lambda: geojson_text(points),
        ".npz": lambda: npz_bytes(points=points),
        ".npy": lambda: npy_bytes(points),
    }
    return write(path, formats)


def write_triangulation(path: AnyPath, T: Triangulation) -> Path:
    """Write a triangulation to a file.

    Parameters
    ----------
    path : path-like
        SVG, OBJ (with z = 0), or JSON and npz with points and triangles by these names.
    T : Triangulation

    Returns
    -------
    Path
        That of the file.

    Raises
    ------
    FileError
        As `.write_curve`.
    """
    formats: dict[str, Callable[[], str | bytes]] = {
        ".svg": lambda: drawing(T.points[None], T.triangles[None]),
        ".obj": lambda: obj_text(T.points, T.triangles),
        ".json": lambda: json_text(points=T.points, triangles=T.triangles),
        ".npz": lambda: npz_bytes(points=T.points, triangles=T.triangles),
    }
    return write(path, formats)


def write_frames(path: AnyPath, m: Morph, frames: int | Playback = 60) -> Path:
    """Write shapes of a morph, evenly spaced in time or chosen for playback, to a file.

    Parameters
    ----------
    path : path-like
        JSON or npz, with frames, triangles and times by these names; CSV, a row for each vertex of each
        frame; or SVG, all frames side by side.
    m : Morph
    frames : int or Playback
        How many, at least 2; or those of ``m.playback()``, straight motion between which is verified.

    Returns
    -------
    Path
        That of the file.

    Raises
    ------
    FileError
        As `.write_curve`.

    Examples
    --------
    >>> import tempfile, tween
    >>> from tween import gallery
    >>> T = tween.triangulate(gallery.curve("ell"))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     shapes, triangles, times = read_frames(write_frames(f"{folder}/ell.npz", tween.morph(T, T.on_disk()), 5))
    >>> shapes.shape, triangles.shape, times
    ((5, 47, 2), (45, 3), array([0.  , 0.25, 0.5 , 0.75, 1.  ]))
    """
    if isinstance(frames, Playback):
        times, shapes, each = frames.times, frames.frames, frames.triangles
    else:
        shapes, times = m.frames(frames), np.linspace(0.0, 1.0, frames)
        each = np.array([m.triangles_at(float(t)) for t in times])
    triangles = each if (each != each[0]).any() else each[0]
    k, n = shapes.shape[:2]
    columns = [np.repeat(np.arange(k), n), np.repeat(times, n), np.tile(np.arange(n), k), *shapes.reshape(-1, 2).T]
    formats: dict[str, Callable[[], str | bytes]] = {
        ".svg": lambda: drawing(shapes, each),
        ".csv": lambda: csv_text("frame,time,vertex,x,y", *columns),
        ".json": lambda: json_text(frames=shapes, triangles=triangles, times=times),
        ".npz": lambda: npz_bytes(frames=shapes, triangles=triangles, times=times),
    }
    return write(path, formats)


def _outlines(path: AnyPath, tolerance: float | None) -> dict[str, _Floats]:
    """The points of all curves, by names of which no two are equal."""
    if tolerance is not None and not 0 < tolerance < inf:
        raise FileError(f"cannot be read with the tolerance {tolerance!r}, expected a positive length")
    outlines: dict[str, _Floats] = {}
    for i, (name, points) in enumerate(_READERS[suffix_of(path, _READERS)](content_of(path), tolerance)):
        label = name if name and name not in outlines else str(i)
        while label in outlines:
            label += "'"
        outlines[label] = points
    count = sum(map(len, outlines.values()))
    if count == 0:
        raise FileError("has no points, expected those of a curve")
    if count > MOST_POINTS:
        raise FileError(f"has {count} points, expected at most {MOST_POINTS}")
    return outlines


def _chosen(outlines: dict[str, _Floats], select: str | int | None) -> _Floats:
    names = list(outlines)
    if select is None and len(names) == 1:
        return outlines[names[0]]
    if isinstance(select, str) and select in outlines:
        return outlines[select]
    place = int(select) if select is not None and re.fullmatch("[0-9]{1,9}", str(select)) else -1
    if 0 <= place < len(names):
        return outlines[names[place]]
    listed = ", ".join(repr(name[:40]) for name in names[:_LISTED])
    more = f", and {len(names) - _LISTED} more" if len(names) > _LISTED else ""
    what = f"holds {len(names)} curves" if select is None else f"holds no curve {select!r}"
    raise FileError(f"{what}, expected the choice of one by id or place: {listed}{more}")


def _curve(points: _Floats) -> Curve:
    points = without_repetitions(points)
    return Curve(points[:-1] if len(points) > 1 and (points[0] == points[-1]).all() else points)


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

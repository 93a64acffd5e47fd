"""Curves and triangulations written to files.

    write_curve            .svg .csv .json .geojson .npz .npy
    write_triangulation    .svg .obj .json .npz

The suffix decides on the format.  A file is written whole or not at all: where writing fails, what stood
there before stands there still.  Every error is one line that begins with the name of the file.
"""

from collections.abc import Callable
from pathlib import Path

from tween.geometry.curve import Curve, as_curve
from tween.geometry.triangulation import Triangulation
from tween.io.formats.whole_files import AnyPath, write
from tween.io.formats.writers import csv_text, drawing, geojson_text, json_text, npy_bytes, npz_bytes, obj_text


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

"""Arrays as text or bytes: CSV, JSON, GeoJSON, NumPy, Wavefront OBJ and SVG.

Doubles are written with as many digits as it takes to read them back exactly.
"""

import io
import json
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.colors import EDGE, INK, SOURCE, as_hex
from tween.io.formats.svg_path import polygon

_Floats = NDArray[np.float64]

_PIXELS = 640, 200  # the longer side of one shape, and of each of several
_FILL, _INK, _EDGE = as_hex(SOURCE), as_hex(INK), as_hex(EDGE)


def npz_bytes(**arrays: NDArray[Any]) -> bytes:
    """Write arrays as an npz file, equal arrays as equal bytes.

    Parameters
    ----------
    **arrays : ndarray

    Returns
    -------
    bytes
    """
    stream = io.BytesIO()
    np.savez(stream, **arrays)  # type: ignore[arg-type]
    return stream.getvalue()


def npy_bytes(array: NDArray[Any]) -> bytes:
    """Write an array as an npy file.

    Parameters
    ----------
    array : ndarray

    Returns
    -------
    bytes
    """
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def json_text(**arrays: NDArray[Any] | None) -> str:
    """Write arrays as one JSON object, a line for each row, so that doubles are read back exactly.

    Parameters
    ----------
    **arrays : ndarray or None

    Returns
    -------
    str

    Examples
    --------
    >>> print(json_text(points=np.eye(2)))
    {"points": [
    [1.0, 0.0],
    [0.0, 1.0]
    ]}
    """
    return "{" + ",\n".join(f'"{name}": {_rows(array)}' for name, array in arrays.items()) + "}"


def _rows(array: NDArray[Any] | None) -> str:
    return "null" if array is None else "[\n" + ",\n".join(map(json.dumps, array.tolist())) + "\n]"


def csv_text(header: str, *columns: NDArray[Any]) -> str:
    r"""Write columns as CSV, so that doubles are read back exactly.

    Parameters
    ----------
    header : str
        Names of the columns, between commas.
    *columns : ndarray, shape (n,)

    Returns
    -------
    str

    Examples
    --------
    >>> csv_text("vertex,x", np.arange(2), np.array([0.1, 1e-9]))
    'vertex,x\n0,0.1\n1,1e-09\n'
    """
    rows = zip(*(map(repr, column.tolist()) for column in columns), strict=True)
    return "\n".join([header, *map(",".join, rows), ""])


def geojson_text(points: _Floats) -> str:
    """Write a curve as a closed GeoJSON line string.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)

    Returns
    -------
    str
    """
    return f'{{"type": "LineString", "coordinates": {_rows(np.concatenate([points, points[:1]]))}}}\n'


def obj_text(points: _Floats, triangles: NDArray[np.int64]) -> str:
    """Write a triangulation as Wavefront OBJ, in the plane z = 0.

    Parameters
    ----------
    points : ndarray of float64, shape (n, 2)
    triangles : ndarray of int, shape (m, 3)

    Returns
    -------
    str
        Vertices are counted from 1 there.

    Examples
    --------
    >>> print(obj_text(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), np.array([[0, 1, 2]])))
    v 0.0 0.0 0
    v 1.0 0.0 0
    v 0.0 1.0 0
    f 1 2 3
    <BLANKLINE>
    """
    vertices = [f"v {x!r} {y!r} 0" for x, y in points.tolist()]
    faces = [f"f {i} {j} {k}" for i, j, k in (triangles + 1).tolist()]
    return "\n".join([*vertices, *faces, ""])


def drawing(shapes: _Floats, triangles: NDArray[np.int64] | None = None) -> str:
    """Draw shapes side by side, in rows.

    Parameters
    ----------
    shapes : ndarray of float64, shape (k, n, 2)
        The boundaries; all are drawn to one scale.
    triangles : ndarray of int, shape (k, m, 3), optional
        To fill the shapes with, the darker the more of them cover a place.

    Returns
    -------
    str
        An SVG file.  The outline has the id "curve", or "frame_0", "frame_1", ... where there are
        several, and its coordinates are exact; frames are moved to their places by a transform.

    Examples
    --------
    >>> print(drawing(np.array([[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]])))
    <svg xmlns="http://www.w3.org/2000/svg" width="640" height="640" viewBox="-0.05 -1.05 1.1 1.1">
    <path id="curve" d="M0.0 0.0 1.0 0.0 0.0 -1.0Z" fill="#0072B2" fill-opacity="0.35" stroke="#262626" .../>
    </svg>
    """
    low, high = shapes.min(axis=(0, 1)), shapes.max(axis=(0, 1))
    side = float((high - low).max())
    columns = math.ceil(math.sqrt(len(shapes)))
    cell = high - low + 0.1 * side
    width, height = cell * [columns, -(-len(shapes) // columns)]
    longer = _PIXELS[0] if len(shapes) == 1 else _PIXELS[1] * columns
    pixels = np.maximum(1, np.round(longer * np.array([width, height]) / max(width, height)))
    box = (low[0] - 0.05 * side, -high[1] - 0.05 * side, width, height)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{pixels[0]:.0f}" height="{pixels[1]:.0f}" '
        f'viewBox="{" ".join(f"{value:.12g}" for value in box)}">'
    ]
    if triangles is not None and len(shapes) > 1:
        note = json.dumps({"triangles": changed_triangles(triangles)}, separators=(",", ":"))
        lines.append(f"<metadata>{note}</metadata>")
    for i, shape in enumerate(shapes):
        drawn = _drawn(
            shape, None if triangles is None else triangles[i], f"frame_{i}" if i or len(shapes) > 1 else "curve", side
        )
        x, y = i % columns * cell[0], i // columns * cell[1]
        lines += [f'<g transform="translate({x:.12g} {y:.12g})">', *drawn, "</g>"] if i else drawn
    return "\n".join([*lines, "</svg>", ""])


def changed_triangles(lists: NDArray[np.int64]) -> list[list[int]]:
    """List, for each frame, the triangles that are not as in the frame before.

    Parameters
    ----------
    lists : ndarray of int, shape (k, m, 3)

    Returns
    -------
    list of list of int
        Row, corner, corner, corner, row, ...; for the first frame all.

    Examples
    --------
    >>> changed_triangles(np.array([[[0, 1, 2], [0, 2, 3]], [[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [0, 2, 3]]]))
    [[0, 0, 1, 2, 1, 0, 2, 3], [], [0, 1, 2, 3]]
    """
    new = np.ones(lists.shape[:2], bool)
    new[1:] = (lists[1:] != lists[:-1]).any(axis=2)
    rows = np.broadcast_to(np.arange(lists.shape[1])[None, :, None], (*lists.shape[:2], 1))
    entries = np.concatenate([rows, lists], axis=2)
    return [entry[now].ravel().tolist() for entry, now in zip(entries, new, strict=True)]


def _drawn(points: _Floats, triangles: NDArray[np.int64] | None, name: str, side: float) -> list[str]:
    xy = (points * [1, -1] + 0.0).tolist()
    fill, lines = f'fill="{_FILL}" fill-opacity="0.35"', []
    if triangles is not None:
        rounded = np.round(points * [1, -1], 4 - math.floor(math.log10(side))).tolist()  # a fraction of a pixel
        data = (polygon([c for v in t for c in rounded[v]], closed=True) for t in triangles.tolist())
        style = f'{fill} stroke="{_EDGE}" stroke-width="{0.0015 * side:.3g}" stroke-linejoin="round"'
        lines, fill = [f"<g {style}>", *(f'<path d="{d}"/>' for d in data), "</g>"], 'fill="none"'
    style = f'{fill} stroke="{_INK}" stroke-width="{0.004 * side:.3g}" stroke-linejoin="round"'
    return [*lines, f'<path id="{name}" d="{polygon([c for p in xy for c in p], closed=True)}" {style}/>']

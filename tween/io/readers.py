"""CSV, JSON, GeoJSON and NumPy files, from bytes to arrays.

A curve is read as its name, empty where there is none, and its points.  Errors do not know the name of the
file; `tween.io` puts it in front.
"""

import io
import json
import math
import re
import reprlib
import zipfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.errors import FileError
from tween.io.whole_files import LARGEST_FILE

_Floats = NDArray[np.float64]
_Named = list[tuple[str, _Floats]]


def read_csv(data: bytes) -> _Named:
    r"""Read points, one a line: x and y between a comma, a semicolon or white space.

    Parameters
    ----------
    data : bytes
        UTF-8.  Empty lines and lines that begin with "#" do not count, and the first one may be a header.

    Returns
    -------
    list of one (str, ndarray of float64, shape (n, 2))

    Raises
    ------
    FileError
        Naming the line.

    Examples
    --------
    >>> read_csv(b"x,y\n0,0\n1.5,2")[0][1].tolist()
    [[0.0, 0.0], [1.5, 2.0]]
    """
    lines = [(i, line.strip()) for i, line in enumerate(_text(data).splitlines(), 1)]
    lines = [(i, line) for i, line in lines if line and line[0] != "#"]
    first = lines[0][1] if lines else ""
    separator = next((mark for mark in ";," if mark in first), None)
    fields = first.split(separator)
    if len(fields) == 2 and all(not _is_number(field) and re.match(r"\W*[^\W\d]", field) for field in fields):
        del lines[0]
    return [("", np.array([_row(i, line, separator) for i, line in lines]).reshape(-1, 2))]


def _row(i: int, line: str, separator: str | None) -> list[float]:
    fields = line.split(separator)
    if len(fields) != 2 or not all(map(_is_number, fields)):
        raise FileError(f"line {i} is {reprlib.repr(line)}, expected two numbers, x and y")
    return [float(field) for field in fields]


def _is_number(field: str) -> bool:
    try:
        return "_" not in field and float(field) is not None
    except ValueError:
        return False


def read_json(data: bytes) -> _Named:
    """Read a list of points, {"points": ...}, {"curves": {id: points}}, or GeoJSON.

    Parameters
    ----------
    data : bytes
        UTF-8.  Of GeoJSON, line strings and the first rings of polygons count, by themselves, as features
        or in a collection, where other geometries are passed over.

    Returns
    -------
    list of (str, ndarray of float64, shape (n, 2))

    Raises
    ------
    FileError
        Saying what was found instead.

    Examples
    --------
    >>> read_json(b'{"curves": {"a": [[0, 0], [1, 0], [0, 1]]}}')
    [('a', array([[0., 0.],
           [1., 0.],
           [0., 1.]]))]
    """
    content = parse_json(data)
    if isinstance(content, list):
        return [("", _points(content, "the list"))]
    if isinstance(content, dict) and "type" in content:
        return _geometries(content)
    if isinstance(content, dict) and isinstance(content.get("curves"), dict):
        return [(name, _points(points, f"curve {reprlib.repr(name)}")) for name, points in content["curves"].items()]
    if isinstance(content, dict) and "points" in content:
        return [("", _points(content["points"], "points"))]
    raise FileError(
        f"holds {reprlib.repr(content)}, expected a list of points [x, y], "
        '{"points": ...}, {"curves": {id: points}} or GeoJSON'
    )


def parse_json(data: bytes) -> Any:
    """Parse JSON.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    object

    Raises
    ------
    FileError
        Where it is none, or nested too deeply.
    """
    try:
        return json.loads(_text(data))
    except RecursionError:
        raise FileError("is nested too deeply, expected lists of points") from None
    except ValueError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"is no JSON: {error}") from None


def _text(data: bytes) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(f"has the byte {data[error.start]:#04x} at position {error.start}, expected UTF-8") from None


def _points(value: Any, where: str, most: int = 2) -> _Floats:
    """A list of positions of two, or up to `most`, numbers; the first two count."""
    if not isinstance(value, list):
        raise FileError(f"{where} is {reprlib.repr(value)}, expected a list of points [x, y]")
    for i, row in enumerate(value):
        if not (isinstance(row, list) and 2 <= len(row) <= most and all(type(c) in (int, float) for c in row)):
            raise FileError(f"{where} has {reprlib.repr(row)} as point {i}, expected [x, y]")
    try:
        return np.array([row[:2] for row in value], dtype=np.float64).reshape(-1, 2)
    except OverflowError:
        raise FileError(f"{where} has an integer that is too large for a double") from None


def _geometries(content: dict[str, Any]) -> _Named:
    features = content.get("features") if content["type"] == "FeatureCollection" else [content]
    if not isinstance(features, list) or not all(isinstance(feature, dict) for feature in features):
        raise FileError(f"has {reprlib.repr(features)} as features, expected a list of GeoJSON features")
    named: _Named = []
    for feature in features:
        geometry = feature.get("geometry") if feature.get("type") == "Feature" else feature
        kind = geometry.get("type") if isinstance(geometry, dict) else None
        if kind in ("LineString", "Polygon"):
            rings = geometry.get("coordinates")
            line = rings[0] if kind == "Polygon" and isinstance(rings, list) and rings else rings
            named.append((str(feature.get("id", "")), _points(line, f"the {kind}", most=4)))
    if not named:
        raise FileError(f"is GeoJSON of type {reprlib.repr(content['type'])}, expected a LineString or Polygon in it")
    return named


def read_arrays(data: bytes, suffix: str) -> dict[str, NDArray[Any]]:
    """Read the arrays of an npz file, or the one of an npy file, without unpickling anything.

    Parameters
    ----------
    data : bytes
    suffix : {".npz", ".npy"}

    Returns
    -------
    dict of str to ndarray
        The one of an npy file is called "points".

    Raises
    ------
    FileError
        Where the file is damaged, holds objects, or unpacks to more than `LARGEST_FILE`.

    Examples
    --------
    >>> file = io.BytesIO()
    >>> np.savez(file, points=np.zeros((3, 2)))
    >>> read_arrays(file.getvalue(), ".npz")["points"].shape
    (3, 2)
    """
    if suffix == ".npy":
        return {"points": _array(data, "the array")}
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            size = sum(member.file_size for member in archive.infolist())
            members = {} if size > LARGEST_FILE else {name: archive.read(name) for name in archive.namelist()}
    except Exception as error:  # zipfile and the decompressors raise a dozen kinds on damaged files
        raise FileError(f"is no archive of arrays: {error}") from None
    if size > LARGEST_FILE:
        raise FileError(f"unpacks to {size} bytes, expected at most {LARGEST_FILE}")
    return {name.removesuffix(".npy"): _array(member, reprlib.repr(name)) for name, member in members.items()}


def _array(data: bytes, name: str) -> NDArray[Any]:
    """An array of numbers, whose header may not ask for more memory than there are data."""
    stream = io.BytesIO(data)
    try:
        version = np.lib.format.read_magic(stream)
        header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
        shape, _, dtype = header(stream)
        fits = dtype.kind in "iuf" and math.prod(shape) * dtype.itemsize == len(data) - stream.tell()
        array = np.load(io.BytesIO(data), allow_pickle=False) if fits else None
    except Exception as error:  # as in read_arrays
        raise FileError(f"{name} is no array: {error}") from None
    if array is None:
        raise FileError(f"{name} has dtype {dtype} and shape {shape}, expected that many numbers")
    return np.asarray(array)


def points_of(arrays: dict[str, NDArray[Any]]) -> _Named:
    """Take the curves from arrays: the one called "points", or else all of them.

    Parameters
    ----------
    arrays : dict of str to ndarray

    Returns
    -------
    list of (str, ndarray of float64, shape (n, 2))

    Raises
    ------
    FileError
        Where an array has another shape.
    """
    if "points" in arrays:
        arrays = {"": arrays["points"]}
    for name, array in arrays.items():
        if array.ndim != 2 or array.shape[1] != 2:
            raise FileError(f"array {reprlib.repr(name or 'points')} has shape {array.shape}, expected (n, 2)")
    return [(name, array.astype(np.float64)) for name, array in arrays.items()]


def frames_of(content: Any) -> tuple[_Floats, NDArray[np.int64] | None, _Floats | None]:
    """Take the frames of a morph from what a file holds under their names.

    Parameters
    ----------
    content : dict of str to array_like
        "frames" of shape (k, n, 2), and perhaps "triangles" of shape (n-2, 3) or (k, n-2, 3) and "times"
        of shape (k,).

    Returns
    -------
    frames : ndarray of float64, shape (k, n, 2)
    triangles : ndarray of int64, shape (n-2, 3) or (k, n-2, 3), or None
    times : ndarray of float64, shape (k,), or None

    Raises
    ------
    FileError
        Where one of them is missing or has another shape.
    """
    if not isinstance(content, dict) or "frames" not in content:
        raise FileError(f"holds {reprlib.repr(content)}, expected frames, and perhaps triangles")
    frames = _numeric("frames", content["frames"], "iuf")
    k, n = frames.shape[:2] if frames.ndim == 3 and frames.shape[2] == 2 else (0, 0)
    if k < 1 or n < 3:
        raise FileError(f"frames have shape {frames.shape}, expected (k, n, 2)")
    triangles = None if content.get("triangles") is None else _numeric("triangles", content["triangles"], "iu")
    if triangles is not None and not _are_triangles(triangles, k, n):
        raise FileError(f"triangles have shape {triangles.shape}, expected ({n - 2}, 3) with vertices below {n}")
    times = None if content.get("times") is None else _numeric("times", content["times"], "iuf").astype(np.float64)
    if times is not None and times.shape != (k,):
        raise FileError(f"times have shape {times.shape}, expected ({k},)")
    return frames.astype(np.float64), None if triangles is None else triangles.astype(np.int64), times


def _are_triangles(triangles: NDArray[Any], k: int, n: int) -> bool:
    return triangles.shape in ((n - 2, 3), (k, n - 2, 3)) and triangles.min() >= 0 and triangles.max() < n


def _numeric(name: str, values: Any, kinds: str) -> NDArray[Any]:
    try:
        array = np.asarray(values)
    except ValueError:
        raise FileError(f"{name} are lists of unequal lengths, expected an array") from None
    if array.dtype.kind not in kinds or not np.isfinite(array).all():
        raise FileError(f"{name} hold something else than finite numbers, expected those")
    return array

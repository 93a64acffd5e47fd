"""JSON and NumPy files, from bytes to arrays.

Errors do not know the name of the file; `tween.io` puts it in front.
"""

import io
import json
import math
import reprlib
import zipfile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.errors import FileError
from tween.io.formats.content import Content, Outline
from tween.io.formats.geojson import positions, read_geojson
from tween.io.formats.tables import text_of
from tween.io.formats.whole_files import LARGEST_FILE

_Floats = NDArray[np.float64]


def read_json(data: bytes) -> Content:
    """Read a list of points, {"points": ...}, {"curves": {id: points}}, or GeoJSON.

    Parameters
    ----------
    data : bytes
        UTF-8.  For GeoJSON see `.read_geojson`.

    Returns
    -------
    Content

    Raises
    ------
    FileError
        Saying what was found instead.

    Examples
    --------
    >>> read_json(b'{"curves": {"a": [[0, 0], [1, 0], [0, 1]]}}').outlines[0].points.tolist()
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
    """
    content = parse_json(data)
    if isinstance(content, list):
        return Content([Outline("", positions(content, "the list"))], [], {})
    if isinstance(content, dict) and "type" in content:
        return read_geojson(content)
    if isinstance(content, dict) and isinstance(content.get("curves"), dict):
        named = content["curves"].items()
        outlines = [Outline(name, positions(points, f"curve {reprlib.repr(name)}")) for name, points in named]
        return Content(outlines, _others(content, "curves"), {})
    if isinstance(content, dict) and "points" in content:
        return Content([Outline("", positions(content["points"], "points"))], _others(content, "points"), {})
    raise FileError(
        f"holds {reprlib.repr(content)}, expected a list of points [x, y], "
        '{"points": ...}, {"curves": {id: points}} or GeoJSON'
    )


def _others(content: dict[str, Any], used: str) -> list[str]:
    return [reprlib.repr(key) for key in content if key != used]


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
        return json.loads(text_of(data))
    except RecursionError:
        raise FileError("is nested too deeply, expected lists of points") from None
    except ValueError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"is no JSON: {error}") from None


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


def points_of(arrays: dict[str, NDArray[Any]]) -> Content:
    """Take the curves from arrays: the one called "points", or else all of them.

    Parameters
    ----------
    arrays : dict of str to ndarray

    Returns
    -------
    Content

    Raises
    ------
    FileError
        Where an array has another shape.
    """
    unused = _others(arrays, "points") if "points" in arrays else []
    if "points" in arrays:
        arrays = {"": arrays["points"]}
    for name, array in arrays.items():
        if array.ndim != 2 or array.shape[1] != 2:
            raise FileError(f"array {reprlib.repr(name or 'points')} has shape {array.shape}, expected (n, 2)")
    return Content([Outline(name, array.astype(np.float64)) for name, array in arrays.items()], unused, {})


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

"""Frames read back from what plays them: an animated SVG, a page with a player, a table of vertices.

Coordinates are those that are drawn, with all their rounding, and y turned upwards; a way back is read, too.  Errors
do not know the name of the file; `tween.read_frames` puts it in front.
"""

import json
import re
import reprlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tween.errors import FileError
from tween.io.formats.svg import elements
from tween.io.formats.svg_path import numbers

_HEADER = "frame,time,vertex,x,y"
_POLYGON = re.compile(r"M([^A-Za-z]*)(?:l([^A-Za-z]*))?[zZ]")  # from a place by steps, or places
_DATA = re.compile(r"const film = (\{.*\});\n")


def svg_frames(data: bytes) -> dict[str, Any]:
    """Read the frames of an animated SVG that `tween.save_animation` has written, or of a sheet of frames.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    dict
        "frames", "times" and, where they are written down, "triangles", as `.frames_of` takes them.

    Raises
    ------
    FileError
        Where the drawing holds no frames.
    """
    every = elements(data)
    notes = [element.text for element in every if _tag(element) == "metadata"]
    for element in every:
        if _tag(element) == "g" and element.get("class") == "outline":
            moves = [e for path in element for e in path if _tag(e) == "animate" and e.get("attributeName") == "d"]
            if len(moves) == 1:
                times = [numbers(word)[0] for word in moves[0].get("keyTimes", "").split(";")]
                return _content([_points(d) for d in moves[0].get("values", "").split(";")], times, notes)
    sheet = {e.get("id"): e for e in every if re.fullmatch(r"frame_\d+", e.get("id", ""))}
    if not sheet or set(sheet) != {f"frame_{i}" for i in range(len(sheet))}:
        raise FileError("holds no frames, expected an animated outline, or paths frame_0, frame_1, ...")
    return _content([_points(sheet[f"frame_{i}"].get("d", "")) for i in range(len(sheet))], None, notes)


def html_frames(data: bytes) -> dict[str, Any]:
    """Read the frames of a page that `tween.save_animation` has written.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    dict
        As `svg_frames`.

    Raises
    ------
    FileError
        Where the page holds no frames.
    """
    found = _DATA.search(data.decode("utf-8", errors="replace"))
    try:
        film = json.loads(found[1] if found else "{}")
        shapes = [np.array(shape, dtype=np.float64).reshape(-1, 2) * [1, -1] for shape in film["shapes"]]
        return _content(shapes, film["clock"], [json.dumps({"triangles": film["rows"]})])
    except (KeyError, TypeError, ValueError) as error:
        if isinstance(error, FileError):
            raise
        raise FileError("holds no frames, expected a page that tween has written") from None


def csv_frames(data: bytes) -> dict[str, Any]:
    r"""Read the frames of a table of frame, time, vertex, x and y.

    Parameters
    ----------
    data : bytes

    Returns
    -------
    dict
        "frames" and "times".

    Raises
    ------
    FileError
        Where the table is another, or does not hold each vertex of each frame, in order.

    Examples
    --------
    >>> table = b"frame,time,vertex,x,y\n0,0,0,0,0\n0,0,1,1,0\n0,0,2,0,1\n"
    >>> csv_frames(table)["frames"].shape
    (1, 3, 2)
    """
    header, *lines = data.decode("utf-8", errors="replace").split() or [""]
    if header != _HEADER:
        raise FileError(f"begins with {reprlib.repr(header)}, expected {_HEADER}")
    try:
        rows = np.array([line.split(",") for line in lines], dtype=np.float64).reshape(-1, 5)
    except ValueError:
        raise FileError("has a row that is not five numbers") from None
    n = len(rows) and int((rows[:, 0] == rows[0, 0]).sum())
    k, left = divmod(len(rows), n or 1)
    order = np.stack([np.repeat(np.arange(k), n), np.tile(np.arange(n), k)], axis=1)
    if left or not k or (rows[:, [0, 2]] != order).any():
        raise FileError("does not hold each vertex of each frame, in order")
    return {"frames": rows[:, 3:].reshape(k, n, 2), "times": rows[::n, 1]}


def _tag(element: Any) -> str:
    return str(element.tag).rpartition("}")[2]


def _points(d: str) -> NDArray[np.float64]:
    found = _POLYGON.fullmatch(d)
    places = [] if found is None else numbers(found[1]) + numbers(found[2] or "")
    if found is None or len(places) < 6 or len(places) % 2:
        raise FileError(f"has the outline {reprlib.repr(d)}, expected one closed polygon")
    points = np.reshape(places, (-1, 2))
    return (np.cumsum(points, axis=0) if found[2] else points) * [1, -1]


def _content(frames: list[NDArray[np.float64]], times: Any, notes: list[str | None]) -> dict[str, Any]:
    """The frames, and the triangles that a note tells: a list for each shape, and which shape each frame is."""
    if len({len(frame) for frame in frames}) != 1:
        raise FileError("has frames of different numbers of vertices")
    content: dict[str, Any] = {"frames": np.stack(frames), "times": times}
    for note in notes:
        try:
            told = json.loads(note or "")
            lists = _lists(told["triangles"])
            content["triangles"] = lists[told.get("frames", list(range(len(lists))))]
        except (KeyError, TypeError, ValueError, IndexError):
            raise FileError(f"has the note {reprlib.repr(note)}, expected triangles") from None
    return content


def _lists(changes: list[list[int]]) -> NDArray[np.int64]:
    """The triangles of each shape, from those that changed: row, corner, corner, corner."""
    now = np.reshape(changes[0], (-1, 4))[:, 1:].astype(np.int64)
    lists = []
    for changed in changes:
        now = now.copy()
        for row, *corners in np.reshape(changed, (-1, 4)).tolist():
            now[row] = corners
        lists.append(now)
    return np.stack(lists)

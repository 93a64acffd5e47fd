"""Frames of morphs, written and read back.

write_frames    .svg .csv .json .npz
read_frames     .svg .csv .json .npz, and the .svg and .html that tween plays
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tween.io.formats.played import csv_frames, html_frames, svg_frames
from tween.io.formats.readers import frames_of, parse_json, read_arrays
from tween.io.formats.whole_files import AnyPath, content_of, naming, suffix_of, write
from tween.io.formats.writers import csv_text, drawing, json_text, npz_bytes
from tween.measuring.playback import Playback
from tween.morphing.morph import Morph

_Floats = NDArray[np.float64]

_FRAME_READERS: dict[str, Callable[[bytes], object]] = {
    ".json": parse_json,
    ".npz": lambda data: read_arrays(data, ".npz"),
    ".svg": svg_frames,
    ".html": html_frames,
    ".csv": csv_frames,
}


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

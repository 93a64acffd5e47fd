"""Files: curves and strokes read, fitted to each other and written, triangulations and the frames of morphs written."""

from tween.io.fitting import fit
from tween.io.read_write import (
    read_curve,
    read_curves,
    read_frames,
    read_stroke,
    stroke,
    write_curve,
    write_frames,
    write_triangulation,
)

__all__ = [
    "fit",
    "read_curve",
    "read_curves",
    "read_frames",
    "read_stroke",
    "stroke",
    "write_curve",
    "write_frames",
    "write_triangulation",
]

"""Files: curves and strokes read and written, triangulations and the frames of morphs written."""

from tween.io.fitting import fit
from tween.io.frames import read_frames, write_frames
from tween.io.marks import landmarks, read_marks
from tween.io.reading import read_curve, read_curves, read_stroke, stroke
from tween.io.writing import write_curve, write_triangulation

__all__ = [
    "fit",
    "landmarks",
    "read_curve",
    "read_curves",
    "read_frames",
    "read_marks",
    "read_stroke",
    "stroke",
    "write_curve",
    "write_frames",
    "write_triangulation",
]

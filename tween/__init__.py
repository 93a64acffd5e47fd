"""Morphing the boundaries of immersed disks.

    points -> Curve -> decompose -> Triangulation -> remesh -> morph -> frames -> metrics

After Mukherjee and Gopi, *Tweening Boundary Curves of Non-simple Immersions of a Disk*.
"""

from tween.align import Alignment, align, pivot_vertex, spine
from tween.certificate import Certificate, Failure, certify, verify
from tween.curve import Crossings, Curve
from tween.decomposition import Decomposition, decompose, triangulate
from tween.errors import (
    CurveError,
    FileError,
    IncompatibleError,
    NotSelfOverlappingError,
    TriangulationError,
    TweenError,
)
from tween.flips import flip, flippable, locally_delaunay, remesh
from tween.gradual import Event
from tween.metrics import area_matrix, area_rank, frame_variance
from tween.morph import morph
from tween.motion import Morph
from tween.predicates import incircle, orient2d
from tween.triangulation import Triangulation, compatible_shift

__all__ = [
    "Alignment",
    "Certificate",
    "Crossings",
    "Curve",
    "CurveError",
    "Decomposition",
    "Event",
    "Failure",
    "FileError",
    "IncompatibleError",
    "Morph",
    "NotSelfOverlappingError",
    "Triangulation",
    "TriangulationError",
    "TweenError",
    "align",
    "area_matrix",
    "area_rank",
    "certify",
    "compatible_shift",
    "decompose",
    "flip",
    "flippable",
    "frame_variance",
    "incircle",
    "locally_delaunay",
    "morph",
    "orient2d",
    "pivot_vertex",
    "remesh",
    "spine",
    "triangulate",
    "verify",
]

"""Morphing the boundaries of immersed disks."""

from tween.curve import Curve
from tween.errors import CurveError, IncompatibleError, NotSelfOverlappingError, TriangulationError, TweenError

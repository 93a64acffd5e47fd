"""Morphing the boundaries of immersed disks.

    points -> Curve -> decompose -> Triangulation -> remesh -> morph -> frames -> metrics

After Mukherjee and Gopi, *Tweening Boundary Curves of Non-simple Immersions of a Disk*.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tween.align import Alignment, align, pivot_vertex, spine
    from tween.animate import save_animation
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
    from tween.io import (
        read_curve,
        read_curves,
        read_frames,
        read_stroke,
        write_curve,
        write_frames,
        write_triangulation,
    )
    from tween.metrics import area_matrix, area_rank, frame_variance, vertex_sums
    from tween.morph import morph
    from tween.motion import Morph
    from tween.predicates import incircle, orient2d
    from tween.triangulation import Triangulation, compatible_shift

# Where each public name is defined; it is imported on first use, so that `tween --help` does not wait for numba.
_HOME = {
    "align": ("Alignment", "align", "pivot_vertex", "spine"),
    "animate": ("save_animation",),
    "certificate": ("Certificate", "Failure", "certify", "verify"),
    "curve": ("Crossings", "Curve"),
    "decomposition": ("Decomposition", "decompose", "triangulate"),
    "errors": (
        "CurveError",
        "FileError",
        "IncompatibleError",
        "NotSelfOverlappingError",
        "TriangulationError",
        "TweenError",
    ),
    "flips": ("flip", "flippable", "locally_delaunay", "remesh"),
    "gradual": ("Event",),
    "io": (
        "read_curve",
        "read_curves",
        "read_frames",
        "read_stroke",
        "write_curve",
        "write_frames",
        "write_triangulation",
    ),
    "metrics": ("area_matrix", "area_rank", "frame_variance", "vertex_sums"),
    "morph": ("morph",),
    "motion": ("Morph",),
    "predicates": ("incircle", "orient2d"),
    "triangulation": ("Triangulation", "compatible_shift"),
}
_MODULE = {name: module for module, names in _HOME.items() for name in names}


class _Package(ModuleType):
    """The package; the import of the module `tween.morph` does not hide the function `tween.morph`."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in _MODULE and isinstance(value, ModuleType)):
            super().__setattr__(name, value)

    def __reduce__(self) -> tuple[Any, ...]:  # workers get the module by its name, as any other
        return import_module, (self.__name__,)


sys.modules[__name__].__class__ = _Package


if not TYPE_CHECKING:  # a type checker would take every name for one that there is

    def __getattr__(name: str) -> Any:
        if name not in _MODULE:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})


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
    "read_curve",
    "read_curves",
    "read_frames",
    "read_stroke",
    "remesh",
    "save_animation",
    "spine",
    "triangulate",
    "verify",
    "vertex_sums",
    "write_curve",
    "write_frames",
    "write_triangulation",
]

"""What the commands of `tween` do: each takes the parsed options, prints, and returns the exit status."""

import json
import math
import sys
from collections.abc import Iterator
from types import SimpleNamespace as Options
from typing import Any

import numpy as np

from tween import io
from tween.app.command_line import curve_names
from tween.app.command_line.morphing import morph
from tween.app.command_line.playing import play
from tween.app.command_line.shapes import Reading, read_points, read_shape
from tween.app.command_line.stages import check_output, stage
from tween.app.command_line.warming import warmup
from tween.app.playground.hand_drawn import MOST_COUNTED
from tween.errors import FileError, NotSelfOverlappingError, TweenError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.io.formats.whole_files import naming
from tween.io.outlines import label
from tween.measuring.certificate import Certificate, verify
from tween.measuring.find_triangles import find_triangles
from tween.triangulating.costs import smallest_angle
from tween.triangulating.decomposition import Decomposition, decompose
from tween.triangulating.decomposition import triangulate as delaunay
from tween.triangulating.repair.cleaning import clean as cleaned

__all__ = ["certify", "clean", "gallery", "info", "morph", "play", "triangulate", "warmup"]

_CURVES = (".svg", ".csv", ".json", ".geojson", ".npz", ".npy")
_TRIANGULATIONS = (".obj", ".json", ".npz", ".svg")
_PICTURES = (".svg", ".png", ".pdf")


def info(options: Options) -> int:
    """Say whether a curve bounds an immersed disk, what else is known of it, and what would mend it.

    Parameters
    ----------
    options : SimpleNamespace
        file, select, tolerance, pen, smooth, output, json, count, verbose.

    Returns
    -------
    int
        0 where it does, 1 where not.
    """
    check_output(options.output, _PICTURES, [options.file])
    shape = read_shape(options.file, options.select, Reading(options.tolerance, options.pen, options.smooth))
    with stage(options.verbose, f"looking at {len(shape.curve)} vertices"):
        answer = decompose(shape.curve)
        facts = _facts(shape.curve, answer, options.count)
        explanation = answer.explain() if options.output or not answer else None
    name = options.file if options.select is None else f"{options.file} ({options.select})"
    if options.output:
        from tween.plot.explanation import save_explanation  # here, as it imports matplotlib

        save_explanation(options.output, explanation or answer.explain())
    if options.json:
        why = None if answer or explanation is None else explanation.to_dict()
        print(json.dumps({"curve": name, **facts, "explanation": why}))
        return 0 if answer else 1
    print(f"{name} bounds an immersed disk" if answer else f"{name} bounds no disk: {facts['reason']}")
    for key, value in _told(facts):
        print(f"  {key:<15} {value}")
    for line in str(explanation).splitlines()[1:] if explanation is not None and not answer else []:
        print(line)
    if not answer and shape.hint:
        print(shape.hint)
    if options.output:
        print(f"wrote {options.output}")
    return 0 if answer else 1


def _facts(curve: Curve, answer: Decomposition, count: bool) -> dict[str, Any]:
    """What `info` knows; None for what was left out."""
    meetings = curve.crossings
    sys.set_int_max_str_digits(0)  # a count may have more digits than Python prints unasked
    return {
        "bounds_disk": bool(answer),
        "reason": answer.reason,
        "vertices": len(curve),
        "clockwise": curve.reversed_input,
        "turning_number": curve.turning_number,
        "crossings": len(meetings.crossing),
        "touches": len(meetings.touches),
        "area": curve.area,
        "triangulations": answer.count if count or not answer or len(curve) <= MOST_COUNTED else None,
        "immersions": _immersions(answer),
    }


def _immersions(answer: Decomposition) -> int | None:
    if not answer:
        return 0
    try:
        return len(answer.immersions())
    except TweenError:  # the table would be too large
        return None


def _told(facts: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    yield "vertices", facts["vertices"]
    backwards = " (clockwise, so taken the other way round)" if facts["clockwise"] else ""
    yield "turning number", f"{facts['turning_number']}{backwards}"
    yield "crossings", f"{facts['crossings']} ({facts['touches']} touches)"
    yield "area", f"{facts['area']:.6g}"
    unasked = f"left out above {MOST_COUNTED} vertices; --count counts them"
    yield "triangulations", unasked if facts["triangulations"] is None else facts["triangulations"]
    yield "immersed disks", "too many splits to tell" if facts["immersions"] is None else facts["immersions"]


def clean(options: Options) -> int:
    """Make a curve that can be used of a noisy stroke, write it, and say what that changed.

    Parameters
    ----------
    options : SimpleNamespace
        file, select, tolerance, pen, output, smooth, close, vertices, json, verbose.

    Returns
    -------
    int
        0 where the curve bounds a disk, 1 where not.
    """
    check_output(options.output, _CURVES, [options.file])
    points = read_points(options.file, options.select, Reading(options.tolerance, options.pen))
    with stage(options.verbose, f"cleaning {len(points)} points"), naming(label(options.file)):
        curve = cleaned(points, options.smooth, options.close, options.vertices)
    io.write_curve(options.output, curve)
    if options.json:
        facts = {"curve": options.file, "vertices": len(curve), **curve.changes.to_dict()}
        print(json.dumps({**facts, "written": options.output}))
    else:
        print(f"{options.file}: {len(points)} points became {len(curve)} vertices")
        print(curve.changes)
        print(f"wrote {options.output}")
    return 0 if curve.changes.bounds_disk else 1


def triangulate(options: Options) -> int:
    """Triangulate the immersed disk that a curve bounds.

    Parameters
    ----------
    options : SimpleNamespace
        file, select, tolerance, pen, smooth, output, random, arbitrary, verbose.

    Returns
    -------
    int
        0.
    """
    check_output(options.output, _TRIANGULATIONS, [options.file])
    shape = read_shape(options.file, options.select, Reading(options.tolerance, options.pen, options.smooth))
    with stage(options.verbose, f"triangulating {len(shape.curve)} vertices"):
        try:
            T, kind = _triangulation(shape.curve, options)
        except NotSelfOverlappingError:
            raise shape.fault() from None
    angle = math.degrees(-smallest_angle(T.points)(T.triangles).max())
    size = f"{len(T)} vertices, {len(T.triangles)} triangles ({kind})"
    print(f"{options.file}: {size}, smallest angle {angle:.2g} degrees")
    if options.output:
        io.write_triangulation(options.output, T)
        print(f"wrote {options.output}")
    return 0


def _triangulation(curve: Curve, options: Options) -> tuple[Triangulation, str]:
    if options.random is None and not options.arbitrary:
        return delaunay(curve), "constrained Delaunay"
    answer = decompose(curve)
    if not answer:
        raise NotSelfOverlappingError(answer.reason)
    if options.arbitrary:
        return answer.arbitrary("first"), "the first of the table"
    return answer.sample(np.random.default_rng(options.random)), f"drawn at random, seed {options.random}"


def certify(options: Options) -> int:
    """Check whether every frame of a file bounds an immersed disk, and every instant of straight motion between them.

    Parameters
    ----------
    options : SimpleNamespace
        file, frames_only, json.

    Returns
    -------
    int
        0 where they all do, 1 where not.
    """
    frames, triangles, times = io.read_frames(options.file)
    if triangles is None:
        try:
            triangles = find_triangles(frames)
        except NotSelfOverlappingError as error:
            facts = {"frames": options.file, "valid": False, "first_failure": str(error)}
            print(json.dumps(facts) if options.json else f"{options.file}: not valid: {error}")
            return 1
    certificate = verify(frames, triangles, times, between=None if options.frames_only else "linear")
    if options.json:
        print(json.dumps({"frames": options.file, **_certificate_facts(certificate)}))
    else:
        print(f"{options.file}: {certificate}")
    return 0 if certificate.valid else 1


def _certificate_facts(certificate: Certificate) -> dict[str, Any]:
    facts = {"valid": certificate.valid, **vars(certificate)}
    failure = certificate.first_failure
    facts["first_failure"] = None if failure is None else failure._asdict()
    # JSON has no nan, which stands for a number that could not be measured.
    return {key: None if isinstance(value, float) and math.isnan(value) else value for key, value in facts.items()}


def gallery(options: Options) -> int:
    """List the curves that come with tween, or write one.

    Parameters
    ----------
    options : SimpleNamespace
        name, output, json.

    Returns
    -------
    int
        0.
    """
    if options.name is None:
        if options.output:
            raise FileError("say which curve is to be written: tween gallery NAME -o OUT")
        print(json.dumps(curve_names.everything()) if options.json else curve_names.listing())
        return 0
    word = curve_names.full_name(options.name)
    entry = curve_names.describe(word)
    if options.output:
        io.write_curve(options.output, curve_names.named(word))
        entry["written"] = options.output
    print(json.dumps(entry) if options.json else curve_names.line(entry))
    if options.output and not options.json:
        print(f"wrote {options.output}")
    return 0

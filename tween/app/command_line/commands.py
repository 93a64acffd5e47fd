"""What the commands of `tween` do: each takes the parsed options, prints, and returns the exit status."""

import argparse
import json
import math
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from tween import io
from tween.app.command_line import curve_names
from tween.app.playground.hand_drawn import MOST_COUNTED
from tween.errors import FileError, NotSelfOverlappingError, TweenError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.measuring.certificate import Certificate, verify
from tween.measuring.certificate import certify as certificate_of
from tween.measuring.find_triangles import find_triangles
from tween.morphing.morph import Morph
from tween.morphing.strategy import morph as morph_between
from tween.triangulating.costs import smallest_angle
from tween.triangulating.decomposition import Decomposition, decompose
from tween.triangulating.decomposition import triangulate as delaunay

_TRIANGULATIONS = (".obj", ".json", ".npz", ".svg")
_FRAMES = (".npz", ".json", ".csv")
_PATIENCE = 3.0  # seconds
_WHY_LONG = "still at it; on its first runs tween compiles its kernels, which takes up to a minute, once"


def info(options: argparse.Namespace) -> int:
    """Say whether a curve bounds an immersed disk, and what else is known of it.

    Parameters
    ----------
    options : Namespace
        file, select, tolerance, pen, json, count, verbose.

    Returns
    -------
    int
        0 where it does, 1 where not.
    """
    curve = curve_names.read_shape(options.file, options.select, options.tolerance, options.pen)
    with _stage(options, f"looking at {len(curve)} vertices"):
        facts = _facts(curve, options.count)
    name = options.file if options.select is None else f"{options.file} ({options.select})"
    if options.json:
        print(json.dumps({"curve": name, **facts}))
    else:
        print(f"{name} bounds an immersed disk" if not facts["reason"] else f"{name} bounds no disk: {facts['reason']}")
        for key, value in _told(facts):
            print(f"  {key:<15} {value}")
    return 0 if facts["bounds_disk"] else 1


def _facts(curve: Curve, count: bool) -> dict[str, Any]:
    """What `info` knows; None for what was left out."""
    answer, meetings = decompose(curve), curve.crossings
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


def triangulate(options: argparse.Namespace) -> int:
    """Triangulate the immersed disk that a curve bounds.

    Parameters
    ----------
    options : Namespace
        file, select, tolerance, pen, output, random, arbitrary, verbose.

    Returns
    -------
    int
        0.
    """
    _check_output(options.output, _TRIANGULATIONS, [options.file])
    curve = curve_names.read_shape(options.file, options.select, options.tolerance, options.pen)
    with _stage(options, f"triangulating {len(curve)} vertices"):
        T, kind = _triangulation(curve, options)
    angle = math.degrees(-smallest_angle(T.points)(T.triangles).max())
    size = f"{len(T)} vertices, {len(T.triangles)} triangles ({kind})"
    print(f"{options.file}: {size}, smallest angle {angle:.2g} degrees")
    if options.output:
        io.write_triangulation(options.output, T)
        print(f"wrote {options.output}")
    return 0


def _triangulation(curve: Curve, options: argparse.Namespace) -> tuple[Triangulation, str]:
    if options.random is None and not options.arbitrary:
        return delaunay(curve), "constrained Delaunay"
    answer = decompose(curve)
    if not answer:
        raise NotSelfOverlappingError(f"the curve bounds no immersed disk: {answer.reason}")
    if options.arbitrary:
        return answer.arbitrary("first"), "the first of the table"
    return answer.sample(np.random.default_rng(options.random)), f"drawn at random, seed {options.random}"


def morph(options: argparse.Namespace) -> int:
    """Morph one curve into another, or into a disk, and write the frames.

    Parameters
    ----------
    options : Namespace
        As `build_parser` reads them.

    Returns
    -------
    int
        0; 1 where the morph was to be certified and is refuted.
    """
    write = _writer(options)
    source, target = _ends(options)
    with _stage(options, "matching and morphing"):
        words = ("path", "guarantee", "strategy", "placement", "root", "landmarks", "pace")
        m = morph_between(source, target, **{name: getattr(options, name) for name in words})
    certificate = None
    if options.certify:
        with _stage(options, "certifying"):
            certificate = certificate_of(m, options.frames)
    with _stage(options, f"writing {options.frames} frames"):
        write(m)
    if certificate is not None:
        print(certificate)
    flips = f"{len(m.events) or 'no'} flip{'' if len(m.events) == 1 else 's'}"
    summary = f"{options.frames} frames of {len(m.source)} vertices, {flips}, {_trust(m, certificate)}"
    print(f"wrote {options.output}: {summary}")
    return 0 if certificate is None or certificate.valid else 1


def _writer(options: argparse.Namespace) -> Callable[[Morph], object]:
    """How the morph is to be written, or why it cannot be."""
    inputs = [options.source, options.target]
    if Path(options.output).suffix.lower() in _FRAMES:
        _check_output(options.output, _FRAMES, inputs)
        return lambda m: io.write_frames(options.output, m, options.frames)
    from tween.plot import animation  # here, as it imports matplotlib

    _check_output(options.output, (*animation.formats(), *_FRAMES), inputs)
    animation.check_format(options.output, options.fps)
    chosen = {name: getattr(options, name) for name in ("frames", "fps", "size", "style", "ease")}
    return lambda m: animation.save_animation(options.output, m, **chosen, there_and_back=not options.once)


def _ends(options: argparse.Namespace) -> tuple[Curve | Triangulation, Curve | Triangulation]:
    """Source and target; the word disk stands for the disk of the other one."""
    words = (options.source, options.select_source), (options.target, options.select_target)
    with _stage(options, f"reading {options.source} and {options.target}"):
        shapes = [curve_names.read_shape(*word, options.tolerance, options.pen) for word in words if word[0] != "disk"]
    if len(shapes) == 2:
        return shapes[0], shapes[1]
    if not shapes:
        raise FileError("one of A and B has to be a curve: a disk is that of the other one")
    T = delaunay(shapes[0])
    return (T.on_disk(), T) if options.source == "disk" else (T, T.on_disk())


def _trust(m: Morph, certificate: Certificate | None) -> str:
    if certificate is not None:
        checked = f"checked for every instant of playback at {certificate.frames_checked} frames"
        return checked if certificate.valid else "refuted: not every shape bounds an immersed disk"
    return "promised to be valid, not checked (--certify checks it)" if m.proof else "not checked (--certify checks it)"


def certify(options: argparse.Namespace) -> int:
    """Check whether every frame of a file bounds an immersed disk, and every instant of straight motion between them.

    Parameters
    ----------
    options : Namespace
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


def gallery(options: argparse.Namespace) -> int:
    """List the curves that come with tween, or write one.

    Parameters
    ----------
    options : Namespace
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
        io.write_curve(options.output, curve_names.read_shape(word))
        entry["written"] = options.output
    print(json.dumps(entry) if options.json else curve_names.line(entry))
    if options.output and not options.json:
        print(f"wrote {options.output}")
    return 0


# What all commands share


def _check_output(output: str | None, suffixes: Sequence[str], inputs: Sequence[str]) -> None:
    """Refuse before the work what could not be written after it."""
    if output is None:
        return
    path = Path(output)
    if path.suffix.lower() not in suffixes:
        raise FileError(f"cannot write {output}: expected a name that ends in one of {', '.join(suffixes)}")
    if not path.parent.is_dir():
        raise FileError(f"cannot write {output}: there is no folder {str(path.parent)!r}")
    if path.is_dir():
        raise FileError(f"cannot write {output}: it is a folder")
    for word in inputs:
        if path.exists() and Path(word).exists() and path.samefile(word):
            raise FileError(f"cannot write {output}: it is the input, which would be lost")


@contextmanager
def _stage(options: argparse.Namespace, doing: str) -> Iterator[None]:
    """Say on stderr what is being done, and why that takes long where it does."""
    if not (options.verbose or sys.stderr.isatty()):
        yield
        return
    print(f"{doing} ...", file=sys.stderr)
    patience = threading.Timer(_PATIENCE, print, [_WHY_LONG], {"file": sys.stderr})
    patience.daemon = True
    patience.start()
    try:
        yield
    finally:
        patience.cancel()

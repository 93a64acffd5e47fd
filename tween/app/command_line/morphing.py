"""What `tween morph` does: curves read and brought together, the morph, its certificate, and the file."""

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace as Options

from tween import io
from tween.app.command_line.curve_names import is_full
from tween.app.command_line.shapes import Reading, Shape, read_shape
from tween.app.command_line.stages import check_output, stage
from tween.errors import FileError, NotSelfOverlappingError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.measuring.certificate import Certificate
from tween.measuring.certificate import certify as certificate_of
from tween.morphing.morph import Morph
from tween.morphing.strategy import morph as morph_between
from tween.triangulating.decomposition import decompose
from tween.triangulating.decomposition import triangulate as delaunay

_FRAMES = (".npz", ".json", ".csv")


def morph(options: Options) -> int:
    """Morph one curve into another, or into a disk, and write the frames.

    Parameters
    ----------
    options : SimpleNamespace
        As `.interface` reads them.

    Returns
    -------
    int
        0; 1 where the morph was to be certified and is refuted.
    """
    write = _writer(options)
    shapes = _shapes(options)
    ends = _ends(options, shapes)
    landmarks = _landmarks(options, shapes)
    with stage(options.verbose, "matching and morphing"):
        m = _morph(options, shapes, ends, landmarks)
    certificate = None
    if options.certify:
        with stage(options.verbose, "certifying"):
            certificate = certificate_of(m, options.frames)
    with stage(options.verbose, f"writing {options.frames} frames"):
        write(m)
    if certificate is not None:
        print(certificate)
    flips = f"{len(m.events) or 'no'} flip{'' if len(m.events) == 1 else 's'}"
    summary = f"{options.frames} frames of {len(m.source)} vertices, {flips}, {_trust(m, certificate)}"
    print(f"wrote {options.output}: {summary}")
    return 0 if certificate is None or certificate.valid else 1


def _morph(
    options: Options,
    shapes: list[Shape | None],
    ends: list[Curve | Triangulation],
    landmarks: list[tuple[int, int]] | None,
) -> Morph:
    words = ("path", "guarantee", "strategy", "placement", "root", "pace")
    source, target = ends
    try:
        return morph_between(source, target, **{name: getattr(options, name) for name in words}, landmarks=landmarks)
    except NotSelfOverlappingError:
        raise _fault(shapes) from None


def _fault(shapes: list[Shape | None]) -> NotSelfOverlappingError:
    """The error of the first shape that bounds no disk."""
    return next(shape.fault() for shape in shapes if shape is not None and not decompose(shape.curve))


def _writer(options: Options) -> Callable[[Morph], object]:
    """How the morph is to be written, or why it cannot be."""
    inputs = list(options.shapes)
    if Path(options.output).suffix.lower() in _FRAMES:
        check_output(options.output, _FRAMES, inputs)
        return lambda m: io.write_frames(options.output, m, options.frames)
    from tween.plot import animation  # here, as it imports matplotlib

    check_output(options.output, (*animation.formats(), *_FRAMES), inputs)
    animation.check_format(options.output, options.fps)
    chosen = {name: getattr(options, name) for name in ("frames", "fps", "size", "style", "ease")}
    return lambda m: animation.save_animation(options.output, m, **chosen, there_and_back=not options.once)


def _shapes(options: Options) -> list[Shape | None]:
    """The curves in order, None for a disk."""
    words = list(options.shapes)
    if all(word == "disk" for word in words):
        raise FileError("one of the shapes has to be a curve: a disk is that of the other one")
    if words.count("-") > 1:
        raise FileError("standard input can be read once only, but '-' stands for two of the curves")
    how = Reading(options.tolerance, options.pen, options.smooth, options.landmarks_from_files)
    selects = [options.select_source, *[None] * (len(words) - 2), options.select_target]
    with stage(options.verbose, f"reading {' and '.join(words)}"):
        return [
            None if word == "disk" else read_shape(word, select, how)
            for word, select in zip(words, selects, strict=True)
        ]


def _ends(options: Options, shapes: list[Shape | None]) -> list[Curve | Triangulation]:
    """The shapes to morph, brought together; the word disk stands for the disk of the other one."""
    given = [shape for shape in shapes if shape is not None]
    if len(given) == len(shapes):
        return [given[0].curve, *(io.fit(shape.curve, given[0].curve, options.fit) for shape in given[1:])]
    try:
        T = delaunay(given[0].curve)
    except NotSelfOverlappingError:
        raise given[0].fault() from None
    return [T.on_disk() if shape is None else T for shape in shapes]


def _landmarks(options: Options, shapes: list[Shape | None]) -> list[tuple[int, int]] | None:
    """Pairs of vertices: those given, and those that bear the same id in both files."""
    pairs = list(options.landmarks)
    if options.landmarks_from_files:
        pairs += _landmarks_from_files(options, shapes)
    return pairs or None


def _landmarks_from_files(options: Options, shapes: list[Shape | None]) -> list[tuple[int, int]]:
    files = [shape for shape in shapes if shape is not None and not is_full(shape.word) and shape.word != "-"]
    if len(files) != 2:
        raise FileError("--landmarks-from-files needs two files that mark places by the same ids")
    source, target = files
    marks = [io.read_marks(shape.word) for shape in files]
    found = io.landmarks(source.curve, marks[0], target.curve, marks[1])
    if not found:
        ids = [", ".join(sorted(names)[:10]) or "none" for names in marks]
        raise FileError(
            f"{source.word} and {target.word} mark no place by the same id, expected circles of an SVG or points of a "
            f"GeoJSON; their ids are {ids[0]} and {ids[1]}"
        )
    print(f"landmarks: {', '.join(f'{name} {i}:{j}' for name, (i, j) in found.items())}")
    return list(found.values())


def _trust(m: Morph, certificate: Certificate | None) -> str:
    if certificate is not None:
        checked = f"checked for every instant of playback at {certificate.frames_checked} frames"
        return checked if certificate.valid else "refuted: not every shape bounds an immersed disk"
    return "promised to be valid, not checked (--certify checks it)" if m.proof else "not checked (--certify checks it)"

"""What `tween morph` does: curves read and brought together, the morph, its certificate, and the file."""

from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import SimpleNamespace as Options

from tween import io
from tween.app.command_line.curve_names import is_full
from tween.app.command_line.shapes import Reading, Shape, read_shape
from tween.app.command_line.stages import check_output, stage
from tween.easing import as_ease
from tween.errors import FileError, IncompatibleError, NotSelfOverlappingError
from tween.geometry.curve import Curve
from tween.geometry.triangulation import Triangulation
from tween.io.outlines import label
from tween.measuring.certificate import Certificate
from tween.measuring.certificate import certify as certificate_of
from tween.morphing.morph import Morph
from tween.morphing.sequence import Sequence
from tween.morphing.sequence import sequence as sequence_of
from tween.morphing.strategy import morph as morph_between
from tween.plural import counted
from tween.triangulating.decomposition import decompose
from tween.triangulating.decomposition import triangulate as delaunay

_FRAMES = (".npz", ".json", ".csv")
_THERE, _OF_A_LEG = 60, 30  # frames of a morph, and steps on each leg of a sequence, where their number is not given
_FILM = ("frames", "fps", "size", "style", "fill", "stroke", "width", "background")


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
    certificate, frames = None, options.frames or _usual_frames(m)
    if options.certify:
        with stage(options.verbose, "certifying"):
            certificate = certificate_of(m, frames)
    with stage(options.verbose, f"writing {options.output}"):
        write(m)
    if certificate is not None:
        print(certificate)
    words = f"{_count(options, m)} of {len(m.source)} vertices, {_flips(m)}, {_trust(m, certificate)}"
    print(f"wrote {options.output}: {words}")
    return 0 if certificate is None or certificate.valid else 1


def _flips(m: Morph) -> str:
    """How many flips there are on the way; the diagonals that change at a keyframe, where nothing moves, are none."""
    flips = sum(len(leg.events) for leg in m.legs) if isinstance(m, Sequence) else len(m.events)
    return counted(flips, "flip")


def _usual_frames(m: Morph) -> int:
    return _OF_A_LEG * len(m.legs) + 1 if isinstance(m, Sequence) else _THERE


def _count(options: Options, m: Morph) -> str:
    """How many frames are written; of a film, whether some of them lead back."""
    there = options.frames or _usual_frames(m)
    if Path(options.output).suffix.lower() in _FRAMES or options.once or isinstance(m, Sequence):
        return f"{there} frames"
    return f"{options.frames or 2 * there - 1} frames, there and back,"


def _morph(
    options: Options,
    shapes: list[Shape | None],
    ends: list[Curve | Triangulation],
    landmarks: list[tuple[int, ...]] | None,
) -> Morph:
    try:
        if len(ends) > 2:
            return _sequence(options, ends, landmarks)
        words = ("path", "guarantee", "strategy", "placement", "root", "pace")
        chosen = {name: getattr(options, name) for name in words}
        pairs = None if landmarks is None else [(pair[0], pair[1]) for pair in landmarks]
        return morph_between(ends[0], ends[1], **chosen, landmarks=pairs)
    except NotSelfOverlappingError:
        raise _fault(shapes) from None


def _sequence(options: Options, ends: list[Curve | Triangulation], landmarks: list[tuple[int, ...]] | None) -> Sequence:
    """The morph through several keyframes; one that begins and ends with the same word is a loop."""
    if options.strategy not in ("auto", "matched"):
        raise IncompatibleError(f"strategy is {options.strategy!r}, but keyframes are always matched")
    if options.pace == "speed":
        raise IncompatibleError("pace is 'speed', but between keyframes the clock is the motion's own; --ease bends it")
    words = ("path", "guarantee", "placement", "root")
    return sequence_of(
        ends,
        loop=_is_loop(options),
        **{name: getattr(options, name) for name in words},
        landmarks=landmarks,
        names=list(map(label, options.shapes)),
    )


def _is_loop(options: Options) -> bool:
    same_place = options.select_source == (options.select_target or options.select_source)
    return len(options.shapes) > 2 and options.shapes[0] == options.shapes[-1] and same_place


def _fault(shapes: list[Shape | None]) -> NotSelfOverlappingError:
    """The error of the first shape that bounds no disk; of keyframes, with its number."""
    faults = [i for i, shape in enumerate(shapes) if shape is not None and not decompose(shape.curve)]
    shape = shapes[faults[0]]
    assert shape is not None
    return shape.fault(f"keyframe {faults[0]}" if len(shapes) > 2 else "")


def _writer(options: Options) -> Callable[[Morph], object]:
    """How the morph is to be written, or why it cannot be."""
    inputs = list(options.shapes)
    if Path(options.output).suffix.lower() in _FRAMES:
        check_output(options.output, _FRAMES, inputs)
        return lambda m: io.write_frames(options.output, m, options.frames or _usual_frames(m))
    from tween.plot import animation, look  # here, as they import matplotlib

    check_output(options.output, (*animation.formats(), *_FRAMES), inputs)
    animation.check_format(options.output, options.fps)
    triangle = Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    look.look(triangle, "fill", options.background, options.fill, options.stroke, options.width)  # or the ValueError
    chosen = {name: getattr(options, name) for name in _FILM}
    if options.ease is not None or options.no_ease:
        chosen["ease"] = as_ease("linear" if options.no_ease else options.ease)
    return lambda m: animation.save_animation(
        options.output, m, **chosen, there_and_back=False if options.once else None
    )


def _shapes(options: Options) -> list[Shape | None]:
    """The curves in order, None for a disk."""
    words = list(options.shapes)
    if all(word == "disk" for word in words):
        raise FileError("one of the shapes has to be a curve: a disk is that of the other one")
    if len(words) > 2 and "disk" in words:
        raise FileError("of more than two shapes each has to be a curve: the word disk is the disk of the other one")
    if words.count("-") > 1:
        raise FileError("standard input can be read once only, but '-' stands for two of the curves")
    several = sum(not _comes_with_tween(word) for word in words) > 1
    how = Reading(options.tolerance, options.pen, options.smooth, options.landmarks_from_files, lines=several)
    selects = [options.select_source, *[None] * (len(words) - 2), options.select_target]
    if _is_loop(options):
        selects[-1] = selects[0]
    # A smoothing is in the unit of the files; a curve that comes with tween has another, and does not tremble.
    plain = how._replace(smooth=how.smooth if all(map(_comes_with_tween, words)) else None)

    @cache  # the first curve of a loop is named twice, and what is said of it need not be
    def shape(word: str, select: str | None) -> Shape:
        return read_shape(word, select, plain if is_full(word) else how)

    with stage(options.verbose, f"reading {' and '.join(words)}"):
        return [None if word == "disk" else shape(word, select) for word, select in zip(words, selects, strict=True)]


def _comes_with_tween(word: str) -> bool:
    return word == "disk" or is_full(word)


def _ends(options: Options, shapes: list[Shape | None]) -> list[Curve | Triangulation]:
    """The shapes to morph, brought together; the word disk stands for the disk of the other one."""
    given = [shape for shape in shapes if shape is not None]
    first = given[0].curve
    if len(given) == len(shapes):
        rest = given[1:-1] if _is_loop(options) else given[1:]
        return [first, *(io.fit(shape.curve, first, options.fit) for shape in rest), *[first] * _is_loop(options)]
    try:
        T = delaunay(first)
    except NotSelfOverlappingError:
        raise given[0].fault() from None
    return [T.on_disk() if shape is None else T for shape in shapes]


def _landmarks(options: Options, shapes: list[Shape | None]) -> list[tuple[int, ...]] | None:
    """Vertices that have to correspond: those given, and those that bear the same id in all files."""
    shapes = shapes[:-1] if _is_loop(options) else shapes
    for landmark in options.landmarks:
        if len(landmark) != len(shapes):
            given = ":".join(map(str, landmark))
            raise FileError(
                f"landmark {given} has {len(landmark)} vertices, expected one of each of {len(shapes)} curves"
            )
    rows = [*options.landmarks, *(_landmarks_from_files(shapes) if options.landmarks_from_files else [])]
    return rows or None


def _landmarks_from_files(shapes: list[Shape | None]) -> list[tuple[int, ...]]:
    files = [shape for shape in shapes if shape is not None and not is_full(shape.word) and shape.word != "-"]
    if len(files) < len(shapes):
        raise FileError("--landmarks-from-files needs files that mark places by the same ids, and no other shapes")
    marks = [io.read_marks(shape.word) for shape in files]
    found = io.landmarks([shape.curve for shape in files], marks)
    if not found:
        told = "; ".join(
            f"{s.word}: {', '.join(sorted(ids)[:10]) or 'none'}" for s, ids in zip(files, marks, strict=True)
        )
        raise FileError(f"no id of an SVG's circle or of a GeoJSON's point occurs in all files ({told})")
    print("landmarks:", ", ".join(f"{name} {':'.join(map(str, row))}" for name, row in found.items()))
    return list(found.values())


def _trust(m: Morph, certificate: Certificate | None) -> str:
    if certificate is not None:
        checked = certificate.proof.split(": ")[0]
        valid = f"{checked} at {certificate.frames_checked} frames"
        return valid if certificate.valid else "refuted: not every shape bounds an immersed disk"
    return "promised to be valid, not checked (--certify checks it)" if m.proof else "not checked (--certify checks it)"

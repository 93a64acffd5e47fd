"""Animations of morphs in files.

The suffix decides which kind of file:

    .gif         plays everywhere; at most 256 colours, and 50 frames a second
    .png .apng   an animated PNG: all colours, sharp, large; with a place for a number in the name, such as
                 frame_%04d.png, many files, one for each picture
    .webp        a WebP: all colours, smaller
    .mp4         a video, small; needs the program ffmpeg, which the package imageio-ffmpeg brings along
    .svg         an SVG that plays by itself, sharp at every size, see `moving_svg`
    .html        a page with a player: pause, and look at any time
"""

import io
import os
import re
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Literal

import numpy as np
from PIL import Image

from tween.choices import Style
from tween.easing import AnyEase
from tween.errors import FileError
from tween.io.formats import whole_files
from tween.morphing.morph import Morph
from tween.morphing.sequence import Sequence
from tween.plot import moving_svg, video
from tween.plot.film import Film, record
from tween.plot.pixels import picture

_GIF_FASTEST = 50  # frames a second; browsers slow down a GIF that asks for more
_MOVING = (".svg", ".html")
_PALETTE_FROM = 12  # frames
_FRAMES, _FRAMES_OF_A_LEG = 60, 30  # shapes on the way of a morph, steps on every leg of a sequence
_SMALL, _SMALL_SIDES = 500_000, (420, 360, 300, 250, 210, 175, 145, 120, 100, 80)  # bytes; pixels that are tried
_NUMBER = re.compile(r"%(?:0\d)?d")


def save_animation(
    path: str | os.PathLike[str],
    m: Morph,
    frames: int | None = None,
    fps: float = 25,
    size: int | tuple[int, int] | Literal["small"] = 480,
    style: Style | None = None,
    ease: AnyEase | None = None,
    hold: float | None = None,
    there_and_back: bool | None = None,
    background: str = "white",
    fill: str | None = None,
    stroke: str | None = None,
    width: float | None = None,
) -> Path:
    """Save a morph as an animation that goes round endlessly, all shapes at one scale.

    Parameters
    ----------
    path : path-like
        Its suffix is one of `formats`.  The file is written whole or not at all.  "frames_%04d.png" makes as many PNG
        files as there are frames, numbered from 0, which rest no longer than others.
    m : Morph or Sequence
    frames : int, optional
        Pictures in the file, all in all: on the way there and, where there is one, on the way back.  By default 60 on
        the way there, and for a sequence 30 a leg and one more.  In SVG and HTML they only say how long it takes: the
        shapes are those of `tween.playback`.
    fps : float
        Frames a second, from 0.1 to 100; in a GIF up to 50.
    size : int, (int, int) or "small"
        Pixels: of the longer side, the other being as long as the shapes need; or width and height.  "small": as large
        as fits into 500 kB, of 64 colours in a GIF.
    style : {"triangles", "outline", "fill"}, optional
        Triangles coloured by identity; the curve alone; or the disk, the darker the more layers it has.  By default
        triangles, but the disk where `fill` is given.
    ease : str, four float or bool, optional
        How the motion spends its time: a name of CSS, "cubic-bezier(x1, y1, x2, y2)" or its numbers, see
        `tween.easing.as_ease`.  By default a morph starts and ends slowly, and a sequence keeps its own time.
    hold : float, optional
        Seconds for which the source and the target rest, up to 30.  By default 0.4, and 0 for a sequence.
    there_and_back : bool, optional
        Whether the frames run back to the source.  By default so for a morph, not for a sequence.
    background : colour
        Or "transparent"; a GIF has no half-transparent pixels, and a video none at all.
    fill : colour, optional
        Of the disk.
    stroke : colour, optional
        Of its outline; "none" for no outline.
    width : float, optional
        Of the outline, in pixels.

    Returns
    -------
    Path
        Of the file; of numbered ones as given.

    Raises
    ------
    FileError
        Where the suffix is unknown, the file cannot be written, or a program that makes such files is missing.
    ValueError
        Where an option is none; the message names it and what was expected.

    Notes
    -----
    The same call writes the same bytes, as long as the libraries that encode are the same.  Frames of a GIF, PNG or
    WebP that look exactly alike become one that lasts as long.

    SVG and HTML move straight from shape to shape, and every instant of that is verified, after rounding, where the
    morph allows it.  They hold the triangles, too, so that `tween.read_frames` and the command ``tween certify`` can
    check what is played.

    Examples
    --------
    >>> import tempfile
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> m = morph(T, T.on_disk())
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = save_animation(Path(folder) / "ess.gif", m, frames=6, size=90)
    ...     with Image.open(file) as image:
    ...         print(file.name, image.n_frames)
    ess.gif 6
    """
    check_format(path, fps)
    suffix, loose = Path(path).suffix.lower(), isinstance(m, Sequence)
    if suffix == ".mp4" and background == "transparent":
        raise FileError(f"{os.fspath(path)}: an .mp4 has no transparent background; .webp, .png and .gif do")
    back = not loose if there_and_back is None else there_and_back
    pictures = _count(m, frames, back)
    made: Callable[[int | tuple[int, int]], Film] = partial(
        _recorded,
        m=m,
        frames=pictures // 2 + 1 if back else pictures,
        fps=fps,
        style=style or ("triangles" if fill is None else "fill"),
        ease=(not loose) if ease is None else ease,
        hold=(0.0 if loose else 0.4) if hold is None else hold,
        there_and_back=back,
        background=background,
        verified=suffix in _MOVING,
        fill=fill,
        stroke=stroke,
        width=width,
        pictures=pictures,
    )
    if isinstance(size, str):
        return _write_small(path, made, size)
    if _NUMBER.search(Path(path).name):
        return _write_numbered(path, made(size))
    return whole_files.write(path, {known: partial(encode, made(size)) for known, encode in _encoders().items()})


def _recorded(size: int | tuple[int, int], **options: Any) -> Film:
    return record(size=size, **options)


def _count(m: Morph, frames: int | None, back: bool) -> int:
    """How many pictures there are all in all."""
    if frames is None:
        there = _FRAMES_OF_A_LEG * len(m.legs) + 1 if isinstance(m, Sequence) else _FRAMES
        return 2 * there - 1 if back else there
    if isinstance(frames, bool) or not isinstance(frames, int | np.integer) or frames < 2:
        raise ValueError(f"frames is {frames!r}, expected a whole number, at least 2: the source and the target")
    return int(frames)


def _write_small(path: str | os.PathLike[str], made: Callable[[int], Film], size: str) -> Path:
    """Write the largest of several sizes that is small enough."""
    if size != "small":
        raise ValueError(f"size is {size!r}, expected a number of pixels, two of them, or 'small'")
    suffix = Path(path).suffix.lower()
    encode = _encoders(colors=64)[suffix]
    for side in _SMALL_SIDES:
        content = encode(made(side))
        if len(content) < _SMALL:
            return _write(path, suffix, content)
    found = f"{len(content)} bytes at {side} pixels, expected less than {_SMALL}"
    help = "style 'fill' or 'outline'" if suffix in _MOVING else "fewer frames, or the style 'outline',"
    raise FileError(f"{os.fspath(path)}: would have {found}; {help} makes it smaller")


def _write_numbered(path: str | os.PathLike[str], shown: Film) -> Path:
    """Write every picture to a file of its own; none before all are made."""
    files = [_png_bytes(picture(shown, k)) for k in shown.numbers]
    for number, content in enumerate(files):
        _write(Path(path).with_name(Path(path).name % number), ".png", content)
    return Path(path)


def _write(path: str | os.PathLike[str], suffix: str, content: str | bytes) -> Path:
    return whole_files.write(path, {suffix: lambda: content})


def _png_bytes(image: Image.Image) -> bytes:
    stream = io.BytesIO()
    image.save(stream, format="PNG")
    return stream.getvalue()


def check_format(path: str | os.PathLike[str], fps: float) -> None:
    """Refuse, before there is a morph, a file that `save_animation` could not write.

    Parameters
    ----------
    path : path-like
    fps : float

    Raises
    ------
    FileError
        Where the suffix is unknown, there is no such folder, the format cannot be so fast, or the program that makes
        it is missing.

    Examples
    --------
    >>> check_format("film.gif", fps=60)
    Traceback (most recent call last):
    ...
    tween.errors.FileError: film.gif: fps is 60, expected at most 50 in a GIF
    """
    with whole_files.naming(path):
        suffix, folder = whole_files.suffix_of(path, _ENCODERS), Path(path).resolve().parent
        if not folder.is_dir():
            raise FileError(f"there is no folder {str(folder)!r}")
        if suffix == ".gif" and fps > _GIF_FASTEST:
            raise FileError(f"fps is {fps:g}, expected at most {_GIF_FASTEST} in a GIF")
        if suffix == ".mp4":
            video.ffmpeg()
        places = _NUMBER.findall(Path(path).name)
        if places and (suffix != ".png" or len(places) > 1 or Path(path).name.count("%") > 1):
            raise FileError("expected one place for a number, such as %04d, and that in the name of a .png")


def formats() -> tuple[str, ...]:
    """List the suffixes of the files that `save_animation` writes.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> formats()
    ('.gif', '.png', '.apng', '.webp', '.mp4', '.svg', '.html')
    """
    return tuple(_ENCODERS)


# Pictures, by Pillow


def _pictures(shown: Film) -> list[Image.Image]:
    return [picture(shown, k) for k in range(len(shown.times))]


def _durations(shown: Film, unit: int) -> list[int]:
    """How long each frame is shown, in milliseconds, whole multiples of a unit; they add up as they should."""
    ends = np.rint(1000 / unit * np.cumsum(shown.seconds)).astype(int) * unit
    return np.diff(ends, prepend=0).tolist()


def _encoded(shown: Film, images: list[Image.Image], unit: int, **options: object) -> bytes:
    first, *rest = (images[k] for k in shown.numbers)
    stream = io.BytesIO()
    first.save(stream, save_all=True, append_images=rest, duration=_durations(shown, unit), loop=0, **options)
    return stream.getvalue()


def _gif(shown: Film, colors: int = 256) -> bytes:
    images = _pictures(shown)
    plain = [image.convert("RGB") for image in images]
    palette = _palette(plain, (colors - shown.transparent) // 2)
    few = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in plain]
    if not shown.transparent:
        return _encoded(shown, few, 10, format="GIF", optimize=False)
    for image, there in zip(few, images, strict=True):
        image.paste(colors - 1, mask=there.getchannel("A").point([255 * (share < 128) for share in range(256)]))
    return _encoded(shown, few, 10, format="GIF", optimize=False, transparency=colors - 1, disposal=2)


def _palette(images: list[Image.Image], half: int) -> Image.Image:
    """Colours for all frames, so that no place changes its shade without reason."""
    chosen = np.linspace(0, len(images) - 1, min(_PALETTE_FROM, len(images))).astype(int)
    everything = Image.fromarray(np.concatenate([np.asarray(images[k])[::2, ::2] for k in chosen]))
    colors: list[int] = []
    # Half of them are those that most pixels have, half are spread: a small blue part of a green shape stays blue.
    for method in (Image.Quantize.MEDIANCUT, Image.Quantize.MAXCOVERAGE):
        found = (everything.quantize(half, method=method).getpalette() or [])[: 3 * half]
        colors += found + [0] * (3 * half - len(found))
    palette = Image.new("P", (1, 1))
    palette.putpalette(colors)
    return palette


def _png(shown: Film) -> bytes:
    return _encoded(shown, _pictures(shown), 1, format="PNG")


def _webp(shown: Film) -> bytes:
    return _encoded(shown, _pictures(shown), 1, format="WEBP", quality=80, method=2)


def _mp4(shown: Film) -> bytes:
    return video.mp4(shown, _pictures(shown))


def _encoders(colors: int = 256) -> dict[str, Callable[[Film], str | bytes]]:
    return _ENCODERS | {".gif": partial(_gif, colors=colors)}


_ENCODERS: dict[str, Callable[[Film], str | bytes]] = {
    ".gif": _gif,
    ".png": _png,
    ".apng": _png,
    ".webp": _webp,
    ".mp4": _mp4,
    ".svg": moving_svg.svg,
    ".html": moving_svg.player,
}

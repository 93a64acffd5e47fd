"""Animations of morphs in files.

The suffix decides which kind of file:

    .gif         plays everywhere; at most 256 colours, and 50 frames a second
    .png .apng   an animated PNG: all colours, sharp, large
    .webp        a WebP: all colours, smaller
    .mp4         a video, small; needs the program ffmpeg
    .svg         an SVG that plays by itself, sharp at every size, see `moving_svg`
    .html        a page with a player: pause, and look at any time
"""

import importlib
import io
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from pathlib import Path

import numpy as np
from PIL import Image

from tween.choices import Style
from tween.errors import FileError
from tween.io import whole_files
from tween.morphing.morph import Morph
from tween.plot import moving_svg
from tween.plot.film import Film, record
from tween.plot.pixels import picture

_GIF_FASTEST = 50  # frames a second; browsers slow down a GIF that asks for more
_PALETTE_FROM = 12  # frames


def save_animation(
    path: str | os.PathLike[str],
    m: Morph,
    frames: int = 60,
    fps: float = 25,
    size: int | tuple[int, int] = 480,
    style: Style = "triangles",
    ease: bool = True,
    hold: float = 0.4,
    there_and_back: bool = True,
    background: str = "white",
) -> Path:
    """Save a morph as an animation that goes round endlessly, all shapes at one scale.

    Parameters
    ----------
    path : path-like
        Its suffix is one of `formats`.  The file is written whole or not at all.
    m : Morph
    frames : int
        Shapes from the source to the target, both included, at least 2; a way back shows the same ones.
    fps : float
        Frames a second, from 0.1 to 100; in a GIF up to 50.
    size : int or (int, int)
        Pixels: of the longer side, the other being as long as the shapes need; or width and height.
    style : {"triangles", "outline", "fill"}
        Triangles coloured by identity; the curve alone; or the disk, the darker the more layers it has.
    ease : bool
        Whether the motion starts and ends slowly; otherwise the shapes are evenly spaced in time.
    hold : float
        Seconds for which the source and the target rest, up to 30.
    there_and_back : bool
        Whether the frames run back to the source.
    background : colour

    Returns
    -------
    Path
        Of the file.

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

    Examples
    --------
    >>> from tween import gallery, morph, triangulate
    >>> T = triangulate(gallery.curve("ess"))
    >>> m = morph(T, T.on_disk())
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = save_animation(Path(folder) / "ess.gif", m, frames=5, size=90)
    ...     with Image.open(file) as image:
    ...         print(file.name, image.n_frames)
    ess.gif 9
    """
    shown = record(m, frames, fps, size, style, ease, hold, there_and_back, background)
    check_format(path, fps)
    return whole_files.write(path, {suffix: partial(encode, shown) for suffix, encode in _ENCODERS.items()})


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
            _ffmpeg()


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


def _gif(shown: Film) -> bytes:
    images = _pictures(shown)
    palette = _palette(images)
    few = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    return _encoded(shown, few, 10, format="GIF", optimize=False)


def _palette(images: list[Image.Image]) -> Image.Image:
    """Colours for all frames, so that no place changes its shade without reason."""
    chosen = np.linspace(0, len(images) - 1, min(_PALETTE_FROM, len(images))).astype(int)
    everything = Image.fromarray(np.concatenate([np.asarray(images[k])[::2, ::2] for k in chosen]))
    colors: list[int] = []
    # Half of them are those that most pixels have, half are spread: a small blue part of a green shape stays blue.
    for method in (Image.Quantize.MEDIANCUT, Image.Quantize.MAXCOVERAGE):
        colors += (everything.quantize(128, method=method).getpalette() or [])[: 3 * 128]
    palette = Image.new("P", (1, 1))
    palette.putpalette(colors)
    return palette


def _png(shown: Film) -> bytes:
    return _encoded(shown, _pictures(shown), 1, format="PNG")


def _webp(shown: Film) -> bytes:
    return _encoded(shown, _pictures(shown), 1, format="WEBP", quality=80, method=2)


# Video, by ffmpeg


def _mp4(shown: Film) -> bytes:
    program = _ffmpeg()
    with tempfile.TemporaryDirectory() as folder:
        video = Path(folder) / "video.mp4"
        command = [program, *_ffmpeg_options(shown), str(video)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as run:
            assert run.stdin
            with suppress(BrokenPipeError):  # ffmpeg gave up; it says why
                for frame in _raw_frames(shown):
                    run.stdin.write(frame)
            _, complaint = run.communicate()
        if run.returncode or not video.exists():
            raise FileError(f"ffmpeg could not make the video: {complaint.decode(errors='replace').strip()}")
        return video.read_bytes()


def _ffmpeg_options(shown: Film) -> list[str]:
    """A side of odd length is padded; what would make the bytes differ from run to run is left out."""
    background = "0x" + bytes(shown.background).hex()
    return (
        f"-loglevel error -f rawvideo -pixel_format rgb24 -video_size {shown.width}x{shown.height}"
        f" -framerate {shown.fps:g} -i - -vf pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:{background} -pix_fmt yuv420p"
        " -threads 1 -fflags +bitexact -flags:v +bitexact -map_metadata -1 -movflags +faststart -f mp4"
    ).split()


def _raw_frames(shown: Film) -> Iterator[bytes]:
    """The frames one after the other, those that rest again and again."""
    raw = [image.tobytes() for image in _pictures(shown)]
    counts = np.diff(np.rint(np.cumsum(shown.seconds) * shown.fps).astype(int), prepend=0)
    for k, count in zip(shown.numbers, counts.tolist(), strict=True):
        for _ in range(count):
            yield raw[k]


def _ffmpeg() -> str:
    """The program, on the path or from the package imageio-ffmpeg."""
    found = shutil.which("ffmpeg")
    if found:
        return found
    with suppress(ImportError, RuntimeError):
        return str(importlib.import_module("imageio_ffmpeg").get_ffmpeg_exe())
    raise FileError(
        "an .mp4 needs the program ffmpeg, and there is none: install it, or the package imageio-ffmpeg, "
        "or choose .webp or .gif"
    )


_ENCODERS: dict[str, Callable[[Film], str | bytes]] = {
    ".gif": _gif,
    ".png": _png,
    ".apng": _png,
    ".webp": _webp,
    ".mp4": _mp4,
    ".svg": moving_svg.svg,
    ".html": moving_svg.player,
}

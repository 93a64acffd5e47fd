"""Videos of films, by the program ffmpeg."""

import importlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
from PIL import Image

from tween.errors import FileError
from tween.plot.film import Film


def mp4(shown: Film, images: list[Image.Image]) -> bytes:
    """Encode a film as a video.

    Parameters
    ----------
    shown : Film
    images : list of Image
        Of its shapes.

    Returns
    -------
    bytes

    Raises
    ------
    FileError
        Where there is no ffmpeg, or where it fails; the message says what it complains of.
    """
    program = ffmpeg()
    with tempfile.TemporaryDirectory() as folder:
        video = Path(folder) / "video.mp4"
        command = [program, *_options(shown), str(video)]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as run:
            assert run.stdin
            with suppress(BrokenPipeError):  # ffmpeg gave up; it says why
                for frame in _raw_frames(shown, images):
                    run.stdin.write(frame)
            _, complaint = run.communicate()
        if run.returncode or not video.exists():
            raise FileError(f"ffmpeg could not make the video: {complaint.decode(errors='replace').strip()}")
        return video.read_bytes()


def ffmpeg() -> str:
    """Find the program, on the path or in the package imageio-ffmpeg.

    Returns
    -------
    str

    Raises
    ------
    FileError
        Where there is none; the message says what would help.
    """
    found = shutil.which("ffmpeg")
    if found:
        return found
    with suppress(ImportError, RuntimeError):
        return str(importlib.import_module("imageio_ffmpeg").get_ffmpeg_exe())
    raise FileError(
        "an .mp4 needs the program ffmpeg, and there is none: install it, or the package imageio-ffmpeg, "
        "or choose .webp or .gif"
    )


def _options(shown: Film) -> list[str]:
    """A side of odd length is padded; what would make the bytes differ from run to run is left out."""
    background = "0x" + bytes(shown.background).hex()
    return (
        f"-loglevel error -f rawvideo -pixel_format rgb24 -video_size {shown.width}x{shown.height}"
        f" -framerate {shown.fps:g} -i - -vf pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:{background} -pix_fmt yuv420p"
        " -threads 1 -fflags +bitexact -flags:v +bitexact -map_metadata -1 -movflags +faststart -f mp4"
    ).split()


def _raw_frames(shown: Film, images: list[Image.Image]) -> Iterator[bytes]:
    """The frames one after the other, those that rest again and again."""
    raw = [image.tobytes() for image in images]
    counts = np.diff(np.rint(np.cumsum(shown.seconds) * shown.fps).astype(int), prepend=0)
    for k, count in zip(shown.numbers, counts.tolist(), strict=True):
        for _ in range(count):
            yield raw[k]

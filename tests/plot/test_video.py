"""Videos: every frame as often as it shows, the program's complaints, the same bytes."""

import shutil
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from tween import Morph, paper_morph
from tween.errors import FileError
from tween.gallery import pair
from tween.plot.animation import save_animation
from tween.plot.film import record
from tween.plot.pixels import picture

SMALL: dict[str, Any] = {"frames": 11, "size": 64}
FILM: dict[str, Any] = {"frames": 6, "size": 64}  # there, of which the way back has five more


@pytest.fixture(scope="module")
def m() -> Morph:
    return paper_morph(*pair("comb_to_winding"))


@pytest.fixture
def ffmpeg(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Put a program named ffmpeg in the place of all programs; without code, none."""
    programs = tmp_path / "programs"
    programs.mkdir()
    monkeypatch.setenv("PATH", str(programs))
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)

    def install(code: str) -> None:
        program = programs / "ffmpeg"
        program.write_text(f"#!{sys.executable}\nimport sys\n{code}\n")
        program.chmod(0o755)

    return install


def test_without_ffmpeg_a_video_is_refused_with_what_would_work(tmp_path: Path, m: Morph, ffmpeg) -> None:
    with pytest.raises(FileError, match=r"needs the program ffmpeg.*or choose \.webp or \.gif"):
        save_animation(tmp_path / "a.mp4", m, **SMALL)
    assert not (tmp_path / "a.mp4").exists()


def test_ffmpeg_gets_every_frame_as_often_as_it_shows(tmp_path: Path, m: Morph, ffmpeg) -> None:
    ffmpeg("open(sys.argv[-1], 'wb').write(' '.join(sys.argv).encode() + b'\\n' + sys.stdin.buffer.read())")
    path = save_animation(tmp_path / "a.mp4", m, fps=10, hold=0.3, **SMALL)
    command, content = path.read_bytes().split(b"\n", 1)
    shown = record(m, **FILM)
    counts = [4, 1, 1, 1, 1, 4, 1, 1, 1, 1, 1]
    expected = b"".join(picture(shown, k).tobytes() * c for k, c in zip(shown.numbers, counts, strict=True))
    assert content == expected
    assert f"-video_size {shown.width}x{shown.height} -framerate 10 ".encode() in command


@pytest.mark.parametrize("code", ["sys.exit('no such codec')", "sys.stdin.read()\nsys.exit('no such codec')"])
def test_what_ffmpeg_complains_of_is_passed_on(tmp_path: Path, m: Morph, ffmpeg, code: str) -> None:
    ffmpeg(code.replace("sys.stdin.read", "sys.stdin.buffer.read"))
    with pytest.raises(FileError, match="ffmpeg could not make the video: no such codec"):
        save_animation(tmp_path / "a.mp4", m, frames=20, size=200)
    assert not (tmp_path / "a.mp4").exists()


@pytest.mark.skipif(
    shutil.which("ffmpeg") is None and find_spec("imageio_ffmpeg") is None, reason="no ffmpeg is installed"
)
def test_a_video_of_odd_size_is_made_twice_the_same(tmp_path: Path, m: Morph) -> None:
    one, other = (save_animation(tmp_path / f"{i}.mp4", m, frames=6, size=(65, 63)).read_bytes() for i in range(2))
    assert one == other and b"ftyp" in one[:16]

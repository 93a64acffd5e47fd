"""Animations in files: frames, durations, sizes; whole or not at all; the same bytes every time."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from tween import Morph, Sequence, TweenError, paper_morph, sequence
from tween.errors import FileError
from tween.gallery import pair
from tween.plot import animation
from tween.plot.animation import formats, save_animation
from tween.plot.film import record
from tween.plot.pixels import picture

PICTURES = (".gif", ".png", ".apng", ".webp")
SMALL: dict[str, Any] = {"frames": 11, "size": 64}
FILM: dict[str, Any] = {"frames": 6, "size": 64}  # there, of which the way back has five more


@pytest.fixture(scope="module")
def m() -> Morph:
    return paper_morph(*pair("comb_to_winding"))


def frames_of(path: Path) -> tuple[list[np.ndarray], list[float]]:
    """The frames of a file, and their durations in milliseconds."""
    frames, durations = [], []
    with Image.open(path) as image:
        for k in range(image.n_frames):
            image.seek(k)
            image.load()
            frames.append(np.asarray(image.convert("RGB"), dtype=float))
            durations.append(image.info["duration"])
    return frames, durations


@pytest.mark.parametrize("suffix", PICTURES)
def test_every_frame_is_there_for_its_time_and_the_last_is_the_first(tmp_path: Path, m: Morph, suffix: str) -> None:
    path = save_animation(tmp_path / f"a{suffix}", m, fps=20, hold=0.3, **SMALL)
    frames, durations = frames_of(path)
    assert path == tmp_path / f"a{suffix}"
    assert len(frames) == 11
    assert durations == [350, *[50] * 4, 350, *[50] * 5]
    assert max(frames[0].shape) == 64
    assert np.abs(frames[0] - frames[-1]).max() <= (40 if suffix == ".webp" else 0)
    assert np.abs(frames[0] - frames[5]).max() > 100


@pytest.mark.parametrize("suffix", PICTURES)
def test_one_way_ends_at_the_target(tmp_path: Path, m: Morph, suffix: str) -> None:
    path = save_animation(tmp_path / f"a{suffix}", m, there_and_back=False, size=(80, 64), frames=6)
    frames, _ = frames_of(path)
    assert len(frames) == 6
    expected = np.asarray(picture(record(m, frames=6, size=(80, 64)), 5), dtype=float)
    assert frames[-1].shape == expected.shape == (64, 80, 3)
    assert np.abs(frames[-1] - expected).mean() < 5


def test_a_png_holds_the_pictures_exactly(tmp_path: Path, m: Morph) -> None:
    frames, _ = frames_of(save_animation(tmp_path / "a.png", m, **SMALL))
    shown = record(m, **FILM)
    for k, frame in zip(shown.numbers, frames, strict=True):
        np.testing.assert_array_equal(frame, np.asarray(picture(shown, k)))


@pytest.mark.parametrize("background", ["#fff7e0", "#a8e6c9"])
def test_a_gif_keeps_background_and_ink_and_comes_close_to_every_colour(
    tmp_path: Path, m: Morph, background: str
) -> None:
    options = SMALL | {"background": background, "size": 160}
    frames, _ = frames_of(save_animation(tmp_path / "a.gif", m, **options))
    shown = record(m, **options | {"frames": 6})
    for k, frame in zip(shown.numbers, frames, strict=True):
        exact = np.asarray(picture(shown, k), dtype=float)
        for color in (shown.background, shown.ink):
            assert (frame[(exact == color).all(axis=2)] == color).all()
        assert np.sqrt(np.mean((frame - exact) ** 2)) < 6


@pytest.mark.parametrize(("fps", "total"), [(24, 460), (30, 370), (50, 220)])
def test_durations_of_a_gif_add_up_though_each_is_rounded(tmp_path: Path, m: Morph, fps: float, total: float) -> None:
    _, durations = frames_of(save_animation(tmp_path / "a.gif", m, fps=fps, hold=0, **SMALL))
    assert all(duration % 10 == 0 and duration >= 20 for duration in durations)
    assert sum(durations) == total


@pytest.mark.parametrize("suffix", [suffix for suffix in formats() if suffix != ".mp4"])
@pytest.mark.parametrize("style", ["triangles", "outline", "fill"])
def test_the_same_call_writes_the_same_bytes(tmp_path: Path, m: Morph, suffix: str, style: Any) -> None:
    one, other = (save_animation(tmp_path / f"{i}{suffix}", m, style=style, **SMALL) for i in range(2))
    assert one.read_bytes() == other.read_bytes()


def test_a_text_or_a_capital_suffix_will_do(tmp_path: Path, m: Morph) -> None:
    assert save_animation(str(tmp_path / "A.GIF"), m, **SMALL).read_bytes()[:4] == b"GIF8"


# How many frames, and how large


@pytest.mark.parametrize("frames", [2, 3, 6, 7, 60])
def test_so_many_frames_are_so_many_there_and_back_and_one_way(tmp_path: Path, m: Morph, frames: int) -> None:
    for name, back in (("back", True), ("there", False)):
        path = save_animation(tmp_path / f"{name}.png", m, frames=frames, size=32, there_and_back=back, hold=0)
        assert len(frames_of(path)[0]) == frames


def test_an_even_number_of_frames_goes_round_without_a_double(tmp_path: Path, m: Morph) -> None:
    frames, _ = frames_of(save_animation(tmp_path / "a.png", m, frames=6, size=64))
    np.testing.assert_array_equal(frames[1], frames[5])
    assert np.abs(frames[0] - frames[5]).max() > 0


@pytest.fixture(scope="module")
def loop() -> Sequence:
    triangle, square, bar = [[0, 0], [3, 0], [0, 3]], [[0, 0], [2, 0], [2, 2], [0, 2]], [[0, 0], [4, 0], [4, 1], [0, 1]]
    return sequence([triangle, square, bar], loop=True)


@pytest.mark.parametrize("style", ["triangles", "outline", "fill"])
def test_a_loop_goes_round_once_and_ends_as_it_began(tmp_path: Path, loop: Sequence, style: Any) -> None:
    frames, durations = frames_of(save_animation(tmp_path / "a.png", loop, frames=13, size=64, style=style))
    assert (len(frames), set(durations)) == (13, {40})
    np.testing.assert_array_equal(frames[0], frames[-1])
    assert np.abs(frames[0] - frames[4]).max() > 100
    shown = frames_of(save_animation(tmp_path / "b.png", loop, size=64))[1]
    assert sum(shown) == 91 * 40, "30 steps a leg; pictures that look alike are one"


def test_a_small_gif_is_below_half_a_megabyte_and_as_large_as_that_allows(tmp_path: Path, m: Morph) -> None:
    path = save_animation(tmp_path / "a.gif", m, frames=80, size="small")
    assert path.stat().st_size < 500_000
    with Image.open(path) as image:
        small = max(image.size)
    larger = min((side for side in animation._SMALL_SIDES if side > small), default=None)
    assert small >= 100
    if larger is not None:
        assert save_animation(tmp_path / "b.gif", m, frames=80, size=larger).stat().st_size > 450_000


@pytest.mark.parametrize(
    ("name", "help"), [("a.svg", "style 'fill' or 'outline' makes"), ("a.gif", "fewer frames, or")]
)
def test_what_would_be_too_large_at_the_smallest_size_is_refused_with_what_would_help(
    name: str, help: str, tmp_path: Path, m: Morph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(animation, "_SMALL", 1000)
    monkeypatch.setattr(animation, "_SMALL_SIDES", (100, 80))
    with pytest.raises(FileError, match=rf"{name}: would have \d+ bytes at 80 pixels, expected less than 1000; {help}"):
        save_animation(tmp_path / name, m, size="small")
    assert list(tmp_path.iterdir()) == []


def test_a_size_in_other_words_is_refused(tmp_path: Path, m: Morph) -> None:
    with pytest.raises(ValueError, match="size is 'tiny', expected a number of pixels, two of them, or 'small'"):
        save_animation(tmp_path / "a.gif", m, size="tiny")  # type: ignore[arg-type]


def test_numbered_pictures_are_the_frames_one_by_one(tmp_path: Path, m: Morph) -> None:
    path = save_animation(tmp_path / "frame_%03d.png", m, **SMALL)
    shown = record(m, **FILM)
    assert path.name == "frame_%03d.png"
    assert sorted(file.name for file in tmp_path.iterdir()) == [f"frame_{i:03}.png" for i in range(11)]
    for i, k in enumerate(shown.numbers):
        with Image.open(tmp_path / f"frame_{i:03}.png") as image:
            np.testing.assert_array_equal(np.asarray(image), np.asarray(picture(shown, k)))


@pytest.mark.parametrize("name", ["a_%d.gif", "a_%d_%d.png", "100%_%d.png"])
def test_a_name_with_a_number_that_cannot_be_is_refused(tmp_path: Path, m: Morph, name: str) -> None:
    with pytest.raises(FileError, match="expected one place for a number, such as %04d"):
        save_animation(tmp_path / name, m, **SMALL)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", PICTURES)
def test_a_transparent_background_is(tmp_path: Path, m: Morph, suffix: str) -> None:
    path = save_animation(tmp_path / f"a{suffix}", m, background="transparent", fill="black", **SMALL)
    with Image.open(path) as image:
        image.seek(3)
        alpha = np.asarray(image.convert("RGBA"))[..., 3]
    assert alpha[0, 0] == 0 and alpha.max() == 255
    opaque = np.asarray(picture(record(m, style="fill", fill="black", **FILM), 3).convert("L")) < 20
    assert (alpha[opaque] > 200).mean() > 0.95


def test_a_video_has_no_transparent_background(tmp_path: Path, m: Morph) -> None:
    with pytest.raises(FileError, match=r"an \.mp4 has no transparent background; \.webp, \.png and \.gif do"):
        save_animation(tmp_path / "a.mp4", m, background="transparent")


# Refusals


@pytest.mark.parametrize("name", ["a.bmp", "a", ".gif", "a.gif.txt"])
def test_an_unknown_suffix_is_refused_with_those_that_are_known(tmp_path: Path, m: Morph, name: str) -> None:
    with pytest.raises(FileError, match=r"suffix .*, expected one of .*\.gif.*\.svg"):
        save_animation(tmp_path / name, m, **SMALL)


def test_a_missing_folder_is_named_before_anything_is_drawn(tmp_path: Path, m: Morph) -> None:
    with pytest.raises(FileError, match=r"there is no folder '.*nowhere'"):
        save_animation(tmp_path / "nowhere" / "a.gif", m, **SMALL)


def test_a_gif_of_more_frames_a_second_than_browsers_show_is_refused(tmp_path: Path, m: Morph) -> None:
    with pytest.raises(FileError, match="fps is 60, expected at most 50 in a GIF"):
        save_animation(tmp_path / "a.gif", m, fps=60, **SMALL)
    assert len(frames_of(save_animation(tmp_path / "a.png", m, fps=60, **SMALL))[0]) == 11


def fail(*_: object) -> None:
    raise FileError("no")


@pytest.mark.parametrize("suffix", [".gif", ".png", ".webp", ".mp4"])
@pytest.mark.parametrize("failure", ["option", "on the way"])
def test_a_failure_leaves_an_existing_file_untouched(
    tmp_path: Path, m: Morph, monkeypatch: pytest.MonkeyPatch, suffix: str, failure: str
) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_text("precious")
    monkeypatch.setattr(animation, "picture", fail)
    with pytest.raises((TweenError, ValueError)):
        save_animation(path, m, **SMALL | ({"fps": 0} if failure == "option" else {}))
    assert path.read_text() == "precious"
    assert list(tmp_path.iterdir()) == [path]

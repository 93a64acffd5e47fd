"""What is played is read back as it is drawn, and verified at every instant."""

import json
import re
from itertools import permutations
from pathlib import Path

import numpy as np
import pytest

from tween import Morph, find_triangles, gallery, morph, paper_morph, read_frames, save_animation, verify, write_frames
from tween.app.command_line import main as command_line
from tween.errors import FileError
from tween.plot.film import record
from tween.plot.moving_svg import svg


@pytest.fixture(scope="module")
def m() -> Morph:
    return morph(*gallery.pair("arrow_to_horseshoe"), strategy="paper")


@pytest.mark.parametrize("style", ["triangles", "outline", "fill"])
@pytest.mark.parametrize("suffix", ["svg", "html"])
@pytest.mark.parametrize("there_and_back", [True, False])
def test_an_animation_is_read_back_and_valid_at_every_instant(m, tmp_path: Path, style, suffix, there_and_back) -> None:
    path = save_animation(tmp_path / f"film.{suffix}", m, style=style, there_and_back=there_and_back)
    frames, triangles, times = read_frames(path)
    cert = verify(frames, triangles, times, between="linear")
    assert cert.valid and cert.scope == "playback"
    assert frames.shape[1:] == m.source.points.shape
    assert (frames == np.rint(frames)).all()
    assert (np.diff(times) >= 0).all() and (times[0], times[-1]) == (0, 1)
    scale = np.ptp(frames[0], axis=0).max() / np.ptp(m.source.points, axis=0).max()
    assert np.ptp(frames[0] - scale * m.source.points, axis=0).max() <= 2.1
    if suffix == "svg" and there_and_back:
        np.testing.assert_array_equal(frames, frames[::-1])


def test_evenly_spaced_shapes_are_read_back_as_they_are_drawn(m, tmp_path: Path) -> None:
    shown = record(m, frames=7, hold=0, there_and_back=False)
    path = tmp_path / "film.svg"
    path.write_text(svg(shown), encoding="utf-8")
    frames, triangles, _ = read_frames(path)
    finer = re.search(r'"outline" transform="scale\((.*?)\)"', path.read_text())
    unit = 5000 / 480 * (round(1 / float(finer[1])) if finer else 1)
    np.testing.assert_array_equal(frames[:7], np.rint(shown.shapes * unit) * [1, -1])
    np.testing.assert_array_equal(triangles[:7], shown.triangles)


@pytest.mark.parametrize("suffix", ["json", "npz", "svg", "csv"])
def test_frames_for_playback_are_written_and_valid_at_every_instant(m, tmp_path: Path, suffix: str) -> None:
    played = m.playback(1e-2)
    frames, triangles, times = read_frames(write_frames(tmp_path / f"frames.{suffix}", m, played))
    np.testing.assert_array_equal(frames, played.frames)
    assert (triangles is None) == (suffix == "csv")
    assert verify(frames, find_triangles(frames) if triangles is None else triangles, times, between="linear").valid


def read_back(m: Morph, folder: Path) -> dict[str, tuple]:
    """A morph exported in every way that holds shapes, and read back: frames, triangles and times.

    The pictures of a GIF hold no shapes; instead there are those of the film that is drawn in it.
    """
    drawn = record(m, frames=60, there_and_back=False)
    return {
        "svg": read_frames(save_animation(folder / "film.svg", m, style="outline")),
        "html": read_frames(save_animation(folder / "film.html", m)),
        "npz": read_frames(write_frames(folder / "frames.npz", m, m.playback())),
        "gif": (drawn.shapes * [1, -1], drawn.triangles, drawn.clock),
    }


def letter_pairs(count: int) -> list[tuple[str, str]]:
    """Different pairs of different letters, drawn at random."""
    every = list(permutations(gallery.letters(), 2))
    return [every[i] for i in np.random.default_rng(0).choice(len(every), count, replace=False)]


@pytest.mark.slow
@pytest.mark.parametrize("name", gallery.pairs())
def test_every_pair_of_the_gallery_is_exported_and_verified(name: str, tmp_path: Path) -> None:
    for shown in read_back(morph(*gallery.pair(name)), tmp_path).values():
        assert verify(*shown, between="linear").valid


@pytest.mark.slow
@pytest.mark.parametrize("pair", letter_pairs(25)[:5], ids="".join)
def test_letters_are_exported_and_verified(pair: tuple[str, str], tmp_path: Path) -> None:
    for shown in read_back(morph(*map(gallery.letter, pair)), tmp_path).values():
        assert verify(*shown, between="linear").valid


def test_a_morph_that_is_not_valid_is_drawn_all_the_same_and_refuted_when_read_back(tmp_path: Path) -> None:
    broken = paper_morph(*gallery.fan())
    frames, triangles, times = read_frames(save_animation(tmp_path / "film.svg", broken))
    assert "vertex 0" in verify(frames, triangles, times, between="linear").first_failure.rule


# Files that were tampered with


def test_moving_one_vertex_of_one_frame_in_a_file_is_seen(tmp_path: Path) -> None:
    T = gallery.curve("ell")
    path = save_animation(tmp_path / "film.svg", morph(T, gallery.curve("arrow"), strategy="common"), style="outline")
    text = path.read_text()
    values = re.search(r'attributeName="d" [^>]* values="([^"]*)"', text)[1].split(";")
    steps = values[3].split("l")
    forged = f"{steps[0]}l9000 0 {steps[1]}"  # one more vertex
    path.write_text(text.replace(values[3], forged, 1))
    with pytest.raises(FileError, match="different numbers of vertices"):
        read_frames(path)
    path.write_text(text.replace(values[3], "M0 0l" + re.sub("^-?[0-9]+", "30000", steps[1]), 1))
    assert not verify(*read_frames(path), between="linear")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 1 0 0 1z"/></svg>', "holds no frames"),
        ("a.svg", "<html/>", "root element"),
        ("a.html", "<html></html>", "holds no frames, expected a page that tween has written"),
        ("a.html", 'const film = {"shapes": 3};\n', "holds no frames"),
        ("a.csv", "x,y\n0,0\n", "expected frame,time,vertex,x,y"),
        ("a.csv", "frame,time,vertex,x,y\n0,0,0,0,0\n0,0,2,0,0\n0,0,1,0,0\n", "each vertex of each frame"),
        ("a.csv", "frame,time,vertex,x,y\n0,0,0,0,a\n", "not five numbers"),
        ("a.csv", " \n", "begins with"),
    ],
)
def test_files_without_frames_are_refused_in_words(tmp_path: Path, name: str, content: str, message: str) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(FileError, match=f"{name}.*{message}"):
        read_frames(tmp_path / name)


@pytest.mark.parametrize(
    "note", ["{}", "[]", "no JSON", '{"triangles": [[0, 0, 1]]}', '{"triangles": [], "frames": [7]}']
)
def test_notes_that_tell_no_triangles_are_refused(tmp_path: Path, note: str) -> None:
    path = save_animation(tmp_path / "film.svg", morph(gallery.curve("ell"), gallery.curve("arrow")), frames=3)
    path.write_text(re.sub("<metadata>.*</metadata>", f"<metadata>{note}</metadata>", path.read_text()))
    with pytest.raises(FileError, match="has the note"):
        read_frames(path)


# On the command line


@pytest.mark.parametrize("name", ["film.svg", "film.html", "frames.npz", "frames.json", "frames.csv"])
def test_the_command_certifies_what_it_has_written(name: str, tmp_path: Path, capsys) -> None:
    path = str(tmp_path / name)
    assert command_line.main(["morph", "letter:e", "letter:l", "-o", path]) == 0
    assert command_line.main(["certify", path]) == 0
    assert "valid at every instant of playback" in capsys.readouterr().out
    assert command_line.main(["certify", path, "--frames-only", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (facts["valid"], facts["scope"], facts["intervals_checked"]) == (True, "frames", 0)


def test_frames_without_triangles_that_bound_no_disk_are_answered_with_no(tmp_path: Path, capsys) -> None:
    path = tmp_path / "eight.csv"
    path.write_text("frame,time,vertex,x,y\n0,0,0,0,0\n0,0,1,2,2\n0,0,2,2,0\n0,0,3,0,2\n")
    assert command_line.main(["certify", str(path)]) == 1
    assert "not valid: frame 0 bounds no immersed disk: turning number is 0" in capsys.readouterr().out

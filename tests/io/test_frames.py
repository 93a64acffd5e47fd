"""Frames are written as numbers, rows and pictures, and read back exactly."""

import numpy as np
import pytest

from tween import gallery, paper_morph
from tween.io.frames import read_frames, write_frames
from tween.io.reading import read_curves
from tween.morphing.strategy import morph
from tween.triangulating.decomposition import triangulate
from tween.triangulating.flips import remesh


@pytest.mark.parametrize("suffix", [".json", ".npz"])
@pytest.mark.parametrize("flips", [False, True])
def test_frames_are_read_back_exactly(tmp_path, suffix, flips):
    m = flipping() if flips else to_disk()
    frames, triangles, times = read_frames(write_frames(tmp_path / f"frames{suffix}", m, 7))
    assert np.array_equal(frames, m.frames(7))
    assert np.array_equal(times, np.linspace(0, 1, 7))
    assert triangles.shape == ((7,) if flips else ()) + m.source.triangles.shape
    for t, shown in zip(times, np.broadcast_to(triangles, (7, *m.source.triangles.shape)), strict=True):
        assert np.array_equal(shown, m.triangles_at(t))


def to_disk():
    T = triangulate(gallery.curve("ell"))
    return morph(T, T.on_disk())


def flipping():
    m = paper_morph(*(remesh(triangulate(gallery.curve(name))) for name in ("ell", "two_loops")))
    assert m.events
    return m


def test_frames_are_written_as_rows_and_as_a_picture(tmp_path):
    m = to_disk()
    header, *rows = write_frames(tmp_path / "frames.csv", m, 3).read_text().splitlines()
    table = np.array([row.split(",") for row in rows], dtype=float)
    assert header == "frame,time,vertex,x,y"
    assert np.array_equal(table[:, 3:].reshape(3, -1, 2), m.frames(3))
    n = len(m.source)
    assert table[[0, n, -1], :3].tolist() == [[0, 0, 0], [1, 0.5, 0], [2, 1, n - 1]]
    outlines = read_curves(write_frames(tmp_path / "frames.svg", m, 3))
    assert np.array_equal(outlines["frame_0"].points, m.source.points)


@pytest.mark.parametrize("suffix", [".svg", ".csv", ".json", ".npz"])
def test_equal_content_makes_equal_bytes(tmp_path, suffix):
    m = to_disk()
    written = [write_frames(tmp_path / f"{i}{suffix}", m, 4).read_bytes() for i in range(2)]
    assert written[0] == written[1]

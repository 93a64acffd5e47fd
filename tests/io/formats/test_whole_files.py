"""Files are written whole or not at all, and every error is one line that begins with their name."""

import io
import os
from pathlib import Path

import numpy as np
import pytest
from files import complaint, saved
from hypothesis import given
from hypothesis import strategies as st
from malformed import SQUARE

from tween import gallery
from tween.errors import CurveError, FileError
from tween.geometry.curve import Curve
from tween.io.formats.whole_files import LARGEST_FILE, content_of, naming, write
from tween.io.frames import write_frames
from tween.io.reading import read_curve, read_curves, read_stroke
from tween.io.writing import write_curve, write_triangulation
from tween.morphing.strategy import morph
from tween.triangulating.decomposition import triangulate


@pytest.mark.parametrize(
    "kind", ["folder.svg", "missing.svg", "missing/missing.csv", "pipe.csv", "large.npz", "nul\0.csv"]
)
def test_what_is_no_readable_file_is_answered_by_one_line(tmp_path, kind):
    path = tmp_path / kind
    if kind.startswith("folder"):
        path.mkdir()
    elif kind.startswith("pipe"):
        os.mkfifo(path)
    elif kind.startswith("large"):
        with open(path, "wb") as file:
            file.truncate(LARGEST_FILE + 1)
    for read in (read_curve, read_curves, lambda p: read_stroke(p, 1)):
        if "\0" in kind:
            with pytest.raises(FileError, match=r"nul\\x00\.csv: embedded null"):
                read(path)
        else:
            assert complaint(path, read)


@pytest.mark.skipif(os.geteuid() == 0, reason="the administrator may read everything")
def test_a_file_one_may_not_read_is_answered_by_one_line(tmp_path):
    path = saved(tmp_path, "secret.csv", "0,0\n1,0\n1,1\n")
    path.chmod(0)
    assert complaint(path, read_curve) == "Permission denied"


def writers():
    T = triangulate(gallery.curve("ell"))
    m = morph(T, T.on_disk())
    return {
        "curve": lambda path: write_curve(path, T.curve),
        "triangulation": lambda path: write_triangulation(path, T),
        "frames": lambda path: write_frames(path, m, 3),
    }


def fail(*_, **__):
    raise OSError(28, "No space left on device")


class _FullDisk(io.FileIO):
    def write(self, data):
        super().write(bytes(data)[:10])
        fail()


@pytest.mark.parametrize("what", ["curve", "triangulation", "frames"])
@pytest.mark.parametrize("failing", ["rename", "write", "make"])
def test_a_failure_leaves_what_was_there(tmp_path, monkeypatch, what, failing):
    path = saved(tmp_path, "shape.npz", b"what was there")
    write = writers()[what]
    if failing == "rename":
        monkeypatch.setattr("tween.io.formats.whole_files.os.replace", fail)
    elif failing == "write":
        monkeypatch.setattr(
            "tween.io.formats.whole_files.open", lambda name, mode: _FullDisk(name, "xb"), raising=False
        )
    else:
        for module in ("writing", "frames"):
            monkeypatch.setattr(f"tween.io.{module}.npz_bytes", fail)
    assert complaint(path, write) == "No space left on device"
    assert path.read_bytes() == b"what was there"
    assert os.listdir(tmp_path) == ["shape.npz"]


@pytest.mark.parametrize("what", ["curve", "triangulation", "frames"])
@pytest.mark.parametrize("name", ["a.docx", "a", "missing/a.json", "folder.json", "file.csv/a.json"])
def test_what_cannot_be_written_is_answered_by_one_line(tmp_path, what, name):
    (tmp_path / "folder.json").mkdir()
    saved(tmp_path, "file.csv", b"what was there")
    assert complaint(tmp_path / name, writers()[what])
    assert sorted(os.listdir(tmp_path)) == ["file.csv", "folder.json"]
    assert (tmp_path / "file.csv").read_bytes() == b"what was there"


def test_an_unknown_suffix_is_answered_with_the_known_ones(tmp_path):
    message = complaint(tmp_path / "a.docx", writers()["curve"])
    assert message == "has the suffix '.docx', expected one of .csv, .geojson, .json, .npy, .npz, .svg"


def test_writing_replaces_a_file_and_follows_a_link(tmp_path):
    target = saved(tmp_path, "target.csv", b"what was there")
    (tmp_path / "link.csv").symlink_to(target)
    path = write_curve(tmp_path / "link.csv", Curve(SQUARE))
    assert path == tmp_path / "link.csv"
    assert path.is_symlink()
    assert np.array_equal(read_curve(target).points, SQUARE)


def test_a_lack_of_memory_is_answered_by_one_line(tmp_path, monkeypatch):
    def lack(_):
        raise MemoryError

    monkeypatch.setattr("tween.io.outlines.content_of", lack)
    assert complaint(saved(tmp_path, "a.csv", "0,0"), read_curve) == "needs more memory than there is"


def test_a_name_of_several_lines_makes_a_message_of_one(tmp_path):
    with pytest.raises(FileError, match=r"two\\nlines\.csv: No such file"):
        read_curve(tmp_path / "two\nlines.csv")


# By themselves


@given(st.text(), st.sampled_from([FileError, CurveError, ValueError, OSError, MemoryError]))
def test_every_error_is_one_printable_line_that_begins_with_the_name(words, error):
    with pytest.raises((FileError, CurveError)) as caught, naming("a.csv"):
        raise error(words)
    assert str(caught.value).startswith("a.csv: ")
    assert str(caught.value).isprintable()
    assert isinstance(caught.value, CurveError) == (error is CurveError)


@pytest.mark.parametrize("error", [KeyError, IndexError, AssertionError, KeyboardInterrupt])
def test_a_bug_is_not_dressed_up_as_a_fault_of_the_file(error):
    with pytest.raises(error), naming("a.csv"):
        raise error


@given(st.binary(min_size=1, max_size=99))
def test_bytes_are_read_back_as_they_were_written(tmp_path_factory, data):
    path = tmp_path_factory.getbasetemp() / "whole.bin"
    assert write(path, {".bin": lambda: data}) == path
    assert content_of(path) == data


def test_text_becomes_utf_8_and_only_the_format_of_the_suffix_is_made(tmp_path):
    path = write(tmp_path / "a.TXT", {".txt": lambda: "πα", ".bin": fail})
    assert path.read_bytes() == "πα".encode()


@pytest.mark.parametrize(("size", "fine"), [(0, False), (1, True), (LARGEST_FILE, True), (LARGEST_FILE + 1, False)])
def test_a_file_is_read_within_its_limits_only(tmp_path, monkeypatch, size, fine):
    path = tmp_path / "sparse.bin"
    with open(path, "wb") as file:
        file.truncate(size)
    monkeypatch.setattr(Path, "read_bytes", lambda _: b"read")
    if fine:
        assert content_of(path) == b"read"
    else:
        with pytest.raises(
            FileError, match=f"has {size} bytes, expected at most {LARGEST_FILE}" if size else "^is empty"
        ):
            content_of(path)

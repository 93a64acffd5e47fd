"""The command `tween`: its examples run, its answers are the library's, and it complains in one line."""

import io
import json
import os
import re
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from malformed import MALFORMED
from terminal import COMMANDS, EIGHT, KEPT, Run, write_points

import tween
from tween.app.command_line import commands, morphing
from tween.app.command_line import main as command_line

# Help


def test_tween_alone_shows_the_help_and_counts_as_misuse(run: Run) -> None:
    status, out, err = run("")
    assert (status, out) == (2, "")
    assert err.startswith("Usage: tween")


# What goes wrong

FAULTS = [
    ("frob", "morph"),
    ("info", "FILE"),
    ("info gallery:ell again", "again"),
    ("info gallery:ell --jso", "--jso"),
    ("info none.csv", "none.csv"),
    ("info horseshoe", "gallery:horseshoe"),
    ("info gallery:none", "horseshoe"),
    ("info letter:", "S T U"),
    ("info letter:ab", "a b c"),
    ("info pair:e_to_l", "/source or /target"),
    ("info pair:none/source", "e_to_l"),
    ("info gallery:ell --select 1", "nothing to select"),
    ("info nan.csv", "nan.csv"),
    ("info few.csv", "at least 3 vertices"),
    ("info junk.csv", "junk.csv"),
    ("info junk.npz", "junk.npz"),
    ("info .", "expected"),
    ("info gallery:ell --pen 0", "positive"),
    ("triangulate eight.csv", "turning number is 0, not 1"),
    ("triangulate eight.csv --random 1", "turning number is 0, not 1"),
    ("triangulate gallery:ell -o kept.gif", ".obj"),
    ("triangulate gallery:ell --random one", "integer"),
    ("triangulate gallery:ell --random 1 --arbitrary", "not allowed"),
    ("triangulate square.json -o square.json", "input"),
    ("morph gallery:ell disk", "--output"),
    ("morph gallery:ell disk -o kept.doc", ".gif"),
    ("morph gallery:ell disk -o none/m.gif", "no folder"),
    ("morph gallery:ell disk -o folder.gif", "it is a folder"),
    ("morph disk disk -o kept.gif", "curve"),
    ("morph eight.csv disk -o kept.gif", "turning number is 0, not 1"),
    (
        "morph gallery:ell eight.csv -o kept.gif",
        "eight.csv: the curve bounds no immersed disk: turning number is 0, not 1; to",
    ),
    ("morph square.json disk -o square.json", "input"),
    ("morph gallery:ell disk -o kept.gif --path straight", "slide"),
    ("morph gallery:ell disk -o kept.gif --strategy none", "common"),
    ("morph gallery:ell disk -o kept.gif --style none", "outline"),
    ("morph gallery:ell disk -o kept.gif --root none", "disk-center, tree-center or a whole number"),
    ("morph gallery:ell disk -o kept.gif --root 45", "from 0 to 44"),
    ("morph gallery:ell disk -o kept.gif --landmark 3", "such as 12:40"),
    ("morph gallery:ell disk -o kept.gif --frames 1", "range"),
    ("morph gallery:ell disk -o kept.gif --frames ²", "range"),
    ("morph gallery:ell disk -o kept.gif --fps 101", "1<=x<=100"),
    ("morph gallery:ell disk -o kept.gif --fps 100", "50 in a GIF"),
    ("morph gallery:ell disk -o kept.gif --size 5", "480 or 640x480"),
    ("morph gallery:ell disk -o kept.gif --size 2049", "from 16 to 2048"),
    ("morph gallery:ell disk -o kept.gif --size 64x", "480 or 640x480"),
    ("morph gallery:comb gallery:winding_3 -o kept.gif --strategy common", "no common triangulation"),
    ("certify none.npz", "none.npz"),
    ("certify kept.gif", ".npz"),
    ("certify square.json", "square.json"),
    ("gallery -o kept.gif", "NAME"),
    ("gallery none", "horseshoe"),
    ("gallery file:ell", "gallery:NAME"),
    ("gallery ell -o kept.gif", ".csv"),
    ("clean eight.csv -o kept.gif", ".csv"),
    ("clean eight.csv", "--output"),
    ("clean none.csv -o kept.csv", "none.csv"),
    ("clean few.csv -o kept.csv", "few.csv: a curve needs at least 3 different points"),
    ("clean nan.csv -o kept.csv", "nan.csv: vertex 1"),
    ("clean square.json -o square.json", "input"),
    ("clean eight.csv -o kept.csv --smooth -1", "0 or more"),
    ("clean eight.csv -o kept.csv --vertices 2", "3<=x"),
    ("clean eight.csv -o kept.csv --close wide", "0 or more"),
    ("clean eight.csv -o none/out.csv", "no folder"),
    ("info eight.csv -o kept.gif", ".svg, .png, .pdf"),
    ("info eight.csv -o none/why.svg", "no folder"),
    ("info square.json --smooth nan", "0 or more"),
    ("info -", "standard input: is empty"),
    ("info 'M0 0L1 0 1'", "path data M0 0L1 0 1"),
    ("morph - - -o kept.gif", "once only"),
    ("morph square.json gallery:ell -o kept.gif --fit size", "area"),
    ("morph square.json gallery:ell -o kept.gif --landmarks-from-files", "needs files"),
    (
        "morph square.json pentagon.json -o kept.gif --landmarks-from-files",
        "(square.json: none; pentagon.json: none)",
    ),
    ("info holes.geojson", "'outer' (outer ring of a Polygon with 1 hole), 'hole1' (hole of a Polygon)"),
    ("warmup --jobs 0", "1<=x"),
    ("morph gallery:ell -o kept.gif", "two at least"),
    ("morph gallery:ell gallery:arrow disk -o kept.gif", "the word disk"),
    ("morph gallery:ell gallery:arrow gallery:ell -o kept.gif --strategy paper", "always matched"),
    ("morph gallery:ell gallery:arrow gallery:ell -o kept.gif --root 3", "root"),
    ("morph gallery:ell gallery:arrow gallery:ell -o kept.gif --pace speed", "--ease"),
    ("morph gallery:ell gallery:arrow gallery:ell -o kept.gif --landmark 0:1:2", "expected one of each of 2"),
    ("morph gallery:ell disk -o kept.gif --fill nocolor", "a colour such as"),
    ("morph gallery:ell disk -o kept.gif --stroke 12", "or 'none'"),
    ("morph gallery:ell disk -o kept.gif --ease bounce", "ease-in-out"),
    ("morph gallery:ell disk -o kept.gif --ease linear --no-ease", "not allowed"),
    ("morph gallery:ell disk -o kept_%d.gif", "%04d"),
    ("morph gallery:ell disk -o kept.gif --background fog", "fog"),
    ("gallery e_to_l -o kept.csv", "/source or /target"),
]


@pytest.mark.parametrize(("line", "words"), FAULTS, ids=[line for line, _ in FAULTS])
def test_what_is_wrong_is_said_in_one_line_and_no_file_is_touched(
    line: str, words: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_points("eight.csv", EIGHT)
    write_points("few.csv", EIGHT[:2])
    write_points("nan.csv", [[0, 0], [np.nan, 1], [1, 1]])
    Path("square.json").write_text("[[0, 0], [1, 0], [1, 1], [0, 1]]")
    Path("pentagon.json").write_text("[[0, 0], [1, 0], [2, 1], [1, 2], [0, 1]]")
    rings = [[[0, 0], [9, 0], [9, 9]], [[5, 1], [6, 1], [6, 2]]]
    Path("holes.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": rings}))
    Path("folder.gif").mkdir()
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO()))
    for name in ("junk.csv", "junk.npz", "kept.gif", "kept.csv", "kept.doc"):
        Path(name).write_bytes(KEPT)
    before = {path: path.is_file() and path.read_bytes() for path in Path().iterdir()}
    status, out, err = run(line)
    assert (status, out) == (2, "")
    assert err.startswith("tween: ")
    assert err.count("\n") == 1
    assert words in err
    assert {path: path.is_file() and path.read_bytes() for path in Path().iterdir()} == before


@pytest.mark.parametrize(("name", "fps"), [("film.gif", 60), ("film.mp4", 25)])
def test_a_film_that_cannot_be_made_is_refused_before_the_morph(
    name: str, fps: int, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(morphing, "morph_between", None)
    monkeypatch.setattr("tween.plot.video.ffmpeg", Mock(side_effect=tween.errors.FileError("there is no ffmpeg")))
    status, out, err = run(f"morph gallery:ell disk -o {name} --fps {fps}")
    assert (status, out) == (2, "")
    assert re.fullmatch(rf"tween: {name}: (fps is 60, .+|there is no ffmpeg)\n", err)


@pytest.mark.parametrize("kind", MALFORMED)
def test_a_malformed_file_is_answered_by_one_line_and_no_file_is_touched(kind: str, run: Run) -> None:
    suffix, content = MALFORMED[kind]
    name = f"malformed{suffix}"
    Path(name).write_bytes(content.encode() if isinstance(content, str) else content)
    Path("kept.gif").write_bytes(KEPT)
    lines = [f"morph {name} disk -o kept.gif"]
    if len(content) < 10_000:  # the others take a second each
        lines += [f"info {name}", f"info {name} --json", f"morph gallery:ell {name} -o kept.gif", f"triangulate {name}"]
    for line in lines:
        status, out, err = run(line)
        assert (line, status, out) == (line, 2, "")
        assert re.fullmatch(rf"tween: {re.escape(name)}: .+\n", err)
        assert Path("kept.gif").read_bytes() == KEPT
        assert len(list(Path().iterdir())) == 2


@pytest.mark.parametrize(
    "line",
    [
        "triangulate gallery:ell -o out.svg",
        "morph gallery:ell disk --frames 3 --size 32 -o out.gif",
        "morph gallery:ell disk --frames 3 -o out.npz",
        "gallery ell -o out.csv",
        "clean gallery:ell --smooth 0.05 -o out.csv",
        "info gallery:ell -o out.svg",
    ],
)
def test_a_write_that_fails_leaves_what_was_there(line: str, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    path = Path(line.split()[-1])
    path.write_bytes(KEPT)

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    status, _, err = run(line)
    assert (status, err.count("\n")) == (2, 1)
    assert "No space left on device" in err
    assert path.read_bytes() == KEPT
    assert list(Path().iterdir()) == [path]


@pytest.mark.parametrize(
    ("error", "status", "words"),
    [
        (KeyboardInterrupt(), 130, "interrupted"),
        (MemoryError(), 2, "not enough memory"),
        (PermissionError(13, "Permission denied", "secret.csv"), 2, "secret.csv: Permission denied"),
        (tween.TweenError("two\nlines"), 2, "two lines"),
    ],
)
def test_an_error_becomes_a_line_and_a_status(
    error: BaseException, status: int, words: str, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(_: object) -> None:
        raise error

    monkeypatch.setattr(commands, "info", fail)
    assert run("info gallery:ell") == (status, "", f"tween: {words}\n")


def test_a_bug_is_not_hidden(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(commands, "info", lambda _: [][0])
    with pytest.raises(IndexError):
        run("info gallery:ell")


WORDS = st.sampled_from(
    "info clean triangulate morph certify gallery "
    "gallery:ell letter:S disk pair:e_to_l/source square.csv junk.svg m.npz -o "
    "out.npz out.svg --json --select 0 --random --arbitrary --path slide area --root --strategy paper --landmark 0:1 "
    "--frames 2 --size 16 --once --certify --help -1 -- --smooth --fit area - M0 0H1V1Z ''".split()
)


@settings(max_examples=150)
@given(st.sampled_from([name for name in COMMANDS if name not in ("warmup", "play")]), st.lists(WORDS, max_size=7))
def test_no_line_of_words_leads_to_a_traceback(
    tmp_path_factory: pytest.TempPathFactory, command: str, words: list[str]
) -> None:
    folder = tmp_path_factory.getbasetemp() / "words"
    folder.mkdir(exist_ok=True)
    (folder / "square.csv").write_text("0,0\n1,0\n1,1\n0,1\n")
    (folder / "junk.svg").write_bytes(KEPT)
    before = Path.cwd()
    os.chdir(folder)
    try:
        assert command_line.main([command, *words] if command else words) in (0, 1, 2)
    finally:
        os.chdir(before)


@settings(max_examples=100)
@given(st.sampled_from([".svg", ".csv", ".json", ".npz", ".npy"]), st.binary(max_size=60))
def test_no_file_leads_to_a_traceback(tmp_path_factory: pytest.TempPathFactory, suffix: str, content: bytes) -> None:
    path = tmp_path_factory.getbasetemp() / f"bytes{suffix}"
    path.write_bytes(content)
    assert command_line.main(["info", str(path)]) in (0, 1, 2)
    assert command_line.main(["certify", str(path)]) in (0, 1, 2)

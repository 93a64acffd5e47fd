"""The command `tween`: its examples run, its answers are the library's, and it complains in one line."""

import argparse
import json
import os
import re
import shlex
import subprocess
import sys
import tomllib
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from itertools import chain
from pathlib import Path
from typing import Any, get_args
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from malformed import MALFORMED
from PIL import Image

import tween
from tween import gallery, io
from tween.app.command_line import commands, curve_names
from tween.app.command_line import main as command_line
from tween.app.command_line.options import PATHS, SIZES, STYLES, build_parser
from tween.app.playground.hand_drawn import MOST_COUNTED
from tween.morphing.compatible.paths import PATHS as LIBRARY_PATHS
from tween.morphing.strategy import Strategy
from tween.plot import animation, film

ROOT = Path(__file__).resolve().parent.parent
EIGHT = [[0, 0], [2, 2], [2, 0], [0, 2]]
KEPT = b"what stood there before"

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run a command line in a folder of its own; returns the exit status and what was printed on both streams."""
    monkeypatch.chdir(tmp_path)

    def runs(line: str, *words: str) -> tuple[int, str, str]:
        status = command_line.main([*shlex.split(line), *words])
        return (status, *capsys.readouterr())

    return runs


def write_points(name: str, points: Any) -> None:
    np.savetxt(name, points, delimiter=",")


def parsers() -> dict[str, argparse.ArgumentParser]:
    """Every command's parser by its name, and that of all under the empty name."""
    whole = build_parser()
    subparsers = next(a for a in whole._actions if isinstance(a, argparse._SubParsersAction))
    return {"": whole, **subparsers.choices}


def examples(parser: argparse.ArgumentParser) -> list[str]:
    return re.findall(r"^  tween (.+)$", parser.epilog or "", re.MULTILINE)


# Help


@pytest.mark.parametrize("name", parsers())
def test_every_example_of_the_help_runs(name: str, run: Run) -> None:
    lines = examples(parsers()[name])
    assert lines
    for line in lines:
        status, out, err = run(line)
        assert (line, status, err) == (line, 0, "")
        assert out


@pytest.mark.parametrize("name", parsers())
def test_help_says_what_a_command_is_for_and_fits_the_page(name: str, run: Run, monkeypatch: Any) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    status, out, err = run(f"{name} --help")
    assert (status, err) == (0, "")
    assert out.startswith("usage: tween")
    options = out.partition("examples:")[0].splitlines()
    assert max(map(len, options)) <= 90


def test_tween_alone_shows_the_help_and_counts_as_misuse(run: Run) -> None:
    status, out, err = run("")
    assert (status, out) == (2, "")
    assert err.startswith("usage: tween")


def test_the_choices_are_those_of_the_library() -> None:
    assert sorted(PATHS) == sorted(LIBRARY_PATHS)
    assert film.STYLES == STYLES
    assert film.SIZES == SIZES
    way = parsers()["morph"]
    strategies = next(a.choices for a in way._actions if a.dest == "strategy")
    assert strategies == get_args(Strategy)


@pytest.mark.parametrize(
    ("command", "line"),
    [
        ("triangulate", "triangulate gallery:ell -o"),
        ("morph", "morph gallery:ell disk --frames 3 --size 32 -o"),
        ("gallery", "gallery ell -o"),
    ],
)
def test_every_suffix_that_the_help_names_is_written(command: str, line: str, run: Run) -> None:
    words = next(a.help for a in parsers()[command]._actions if a.dest == "output")
    suffixes = re.findall(r"\.[a-z0-9]+\b", words or "")
    assert len(suffixes) >= 4
    for suffix in suffixes:
        status, _, err = run(f"{line} out{suffix}")
        if suffix == ".mp4" and "ffmpeg" in err:
            continue
        assert (suffix, status, err) == (suffix, 0, "")
        assert Path(f"out{suffix}").stat().st_size > 100


def test_every_suffix_that_the_help_names_is_read(run: Run) -> None:
    words = next(a.help for a in parsers()["info"]._actions if a.dest == "file")
    for suffix in re.findall(r"\.[a-z]+\b", words or ""):
        assert run(f"gallery ell -o ell{suffix}")[0] == 0
        assert (suffix, run(f"info ell{suffix}")[0]) == (suffix, 0)


# Info


def test_info_says_what_the_library_says(run: Run) -> None:
    curve = gallery.curve("two_disks")
    status, out, err = run("info gallery:two_disks --json")
    answer = tween.decompose(curve)
    assert (status, err) == (0, "")
    assert json.loads(out) == {
        "curve": "gallery:two_disks",
        "bounds_disk": True,
        "reason": "",
        "vertices": len(curve),
        "clockwise": False,
        "turning_number": 1,
        "crossings": len(curve.crossings.crossing),
        "touches": len(curve.crossings.touches),
        "area": curve.area,
        "triangulations": answer.count,
        "immersions": 2,
    }


def test_info_for_people_has_the_same_numbers(run: Run) -> None:
    facts = json.loads(run("info letter:S --json")[1])
    status, out, _ = run("info letter:S")
    assert status == 0
    assert out.startswith("letter:S bounds an immersed disk\n")
    for key in ("vertices", "turning_number", "crossings", "triangulations", "immersions"):
        assert re.search(rf" {facts[key]}\b", out)


def test_a_curve_that_bounds_no_disk_has_status_1_and_the_reason(run: Run) -> None:
    write_points("eight.csv", EIGHT)
    status, out, err = run("info eight.csv")
    assert (status, err) == (1, "")
    assert out.startswith("eight.csv bounds no disk: turning number is 0, not 1\n")
    status, out, _ = run("info eight.csv --json")
    facts = json.loads(out)
    assert status == 1
    assert (facts["bounds_disk"], facts["triangulations"], facts["immersions"]) == (False, 0, 0)


def test_a_clockwise_curve_is_taken_the_other_way_round_and_info_says_so(run: Run) -> None:
    write_points("back.csv", gallery.curve("ell").points[::-1])
    status, out, _ = run("info back.csv")
    assert status == 0
    assert "1 (clockwise, so taken the other way round)" in out


def test_above_200_vertices_triangulations_are_counted_when_asked_only(run: Run) -> None:
    curve = gallery.curve("ell").insert_vertices(MOST_COUNTED + 1)
    io.write_curve("long.csv", curve)
    assert "--count counts them" in run("info long.csv")[1]
    assert json.loads(run("info long.csv --json")[1])["triangulations"] is None
    assert json.loads(run("info long.csv --json --count")[1])["triangulations"] == tween.decompose(curve).count


def test_one_of_several_curves_is_selected(run: Run) -> None:
    curves = {name: gallery.curve(name).points.tolist() for name in ("ell", "arrow")}
    Path("two.json").write_text(json.dumps({"curves": curves}))
    status, _, err = run("info two.json")
    assert status == 2
    assert "'ell', 'arrow'" in err
    for name in curves:
        assert json.loads(run(f"info two.json --select {name} --json")[1])["vertices"] == len(curves[name])
    line = "morph two.json two.json --select-source ell --select-target arrow -o m.npz --frames 2"
    assert run(line)[0] == 0
    assert len(io.read_frames("m.npz")[0][0]) == len(curves["ell"])


def test_a_line_is_drawn_with_a_pen_and_curves_as_finely_as_asked(run: Run) -> None:
    Path("loop.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C9 0 9 9 5 9S1 0 9 0"/></svg>')
    facts = json.loads(run("info loop.svg --pen 0.5 --json")[1])
    assert facts["bounds_disk"]
    assert facts["vertices"] == len(io.read_stroke("loop.svg", 0.5))
    assert json.loads(run("info loop.svg --pen 0.5 --tolerance 0.1 --json")[1])["vertices"] < facts["vertices"]


# Triangulate


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ("", lambda d: tween.remesh(d.arbitrary())),
        ("--arbitrary", lambda d: d.arbitrary("first")),
        ("--random 7", lambda d: d.sample(np.random.default_rng(7))),
    ],
)
def test_triangulate_writes_the_triangulation_asked_for(options: str, expected: Any, run: Run) -> None:
    status, out, err = run(f"triangulate gallery:horseshoe -o out.npz {options}")
    assert (status, err) == (0, "")
    assert out.splitlines()[1:] == ["wrote out.npz"]
    wanted = expected(tween.decompose(gallery.curve("horseshoe")))
    with np.load("out.npz") as file:
        assert np.array_equal(file["points"], wanted.points)
        assert np.array_equal(file["triangles"], wanted.triangles)


# Morph


@pytest.mark.parametrize(
    ("line", "options"),
    [
        ("", {"path": "metric", "guarantee": True}),
        ("--path slide --no-guarantee", {}),
        ("--path area --root tree-center", {"path": "area", "root": "tree-center", "guarantee": True}),
        ("--root 3 --strategy paper", {"path": "metric", "root": 3, "strategy": "paper", "guarantee": True}),
        ("--shifts 5 --strategy paper", {"path": "metric", "shifts": 5, "strategy": "paper", "guarantee": True}),
    ],
)
def test_morph_writes_the_morph_of_the_library(line: str, options: Any, run: Run) -> None:
    status, out, err = run(f"morph gallery:arrow gallery:ell -o m.npz --frames 7 {line}")
    assert (status, err) == (0, "")
    m = tween.morph(gallery.curve("arrow"), gallery.curve("ell"), **options)
    assert f"wrote m.npz: 7 frames of 47 vertices, {len(m.events) or 'no'} flips" in out
    assert np.array_equal(io.read_frames("m.npz")[0], m.frames(7))


def test_the_word_disk_is_the_disk_of_the_other_curve(run: Run) -> None:
    for ends in ("gallery:ell disk", "disk gallery:ell"):
        assert run(f"morph {ends} -o {ends[:4]}.npz --frames 5")[0] == 0
    there, back = (io.read_frames(f"{name}.npz")[0] for name in ("gall", "disk"))
    assert np.array_equal(there[0], gallery.curve("ell").points)
    assert np.allclose(np.ptp(np.linalg.norm(there[-1] - there[-1].mean(axis=0), axis=1)), 0, atol=0.2)
    assert np.allclose(there, back[::-1])


def test_certify_says_whether_every_shape_bounds_a_disk(run: Run) -> None:
    line = "morph gallery:three_lobes disk --path area -o m.npz"
    status, out, _ = run(f"{line} --certify --no-guarantee")
    assert status == 1
    assert "add up to" in out
    assert "refuted" in out.splitlines()[-1]
    assert run("certify m.npz")[0] == 1
    status, out, _ = run(f"{line} --certify")
    assert status == 0
    assert out.splitlines()[-1].endswith("certified")
    assert run("certify m.npz")[0] == 0


def test_without_certify_the_last_line_says_what_is_known(run: Run) -> None:
    line = "morph gallery:ell disk --frames 2 -o m.npz"
    assert run(line)[1].endswith("safe by construction\n")
    assert run(f"{line} --no-guarantee")[1].endswith("not certified (--certify checks it)\n")


def test_the_options_of_the_film_reach_it(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:

    seen: dict[str, Any] = {}
    monkeypatch.setattr(animation, "save_animation", lambda path, m, **options: seen.update(options))
    line = "--frames 9 --fps 12 --size 64x48 --style outline --no-ease --once"
    assert run(f"morph gallery:ell disk -o m.gif {line}")[0] == 0
    assert seen == {
        "frames": 9,
        "fps": 12,
        "size": (64, 48),
        "style": "outline",
        "ease": False,
        "there_and_back": False,
    }
    assert run("morph gallery:ell disk -o m.gif --size 64")[0] == 0
    assert (seen["size"], seen["ease"], seen["there_and_back"]) == (64, True, True)


def test_what_is_being_done_is_said_on_stderr_when_asked(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    line = "morph gallery:ell disk -o m.npz --certify"
    status, quiet, err = run(line)
    assert (status, err) == (0, "")
    status, out, err = run(f"{line} --verbose")
    assert (status, out) == (0, quiet)
    assert [words.split()[0] for words in err.splitlines()] == ["reading", "matching", "certifying", "writing"]
    monkeypatch.setattr(commands, "_PATIENCE", 0.0)
    assert "compiles its kernels" in run(f"{line} -v")[2]


# Certify


def test_frames_that_were_tampered_with_are_refuted(run: Run) -> None:
    assert run("morph gallery:ell disk -o m.json --frames 5")[0] == 0
    status, out, _ = run("certify m.json")
    assert status == 0
    assert out.startswith("m.json: valid\n")
    facts = json.loads(run("certify m.json --json")[1])
    assert facts["valid"]
    assert (facts["first_failure"], facts["frames_checked"]) == (None, 5)

    content = json.loads(Path("m.json").read_text())
    content["frames"][2] = content["frames"][2][::-1]
    Path("m.json").write_text(json.dumps(content))
    status, out, err = run("certify m.json --json")
    assert (status, err) == (1, "")
    failure = json.loads(out)["first_failure"]
    assert failure["t"] == 0.5
    assert "not counter-clockwise" in failure["rule"]


def test_a_number_that_could_not_be_measured_is_null(run: Run) -> None:
    points = [[0, 0], [1, 0], [1, 1], [0, 1]]
    Path("m.json").write_text(json.dumps({"frames": [points], "triangles": [[0, 1, 3], [0, 2, 3]]}))
    status, out, _ = run("certify m.json --json")
    assert status == 1
    assert json.loads(out, parse_constant=pytest.fail)["min_area"] is None


# Gallery


def test_the_gallery_lists_everything_by_names_that_are_understood(run: Run) -> None:
    status, out, _ = run("gallery")
    assert status == 0
    listed = json.loads(run("gallery --json")[1])
    assert {part: len(entries) for part, entries in listed.items()} == {
        "curves": len(gallery.names()),
        "letters": len(gallery.letters()),
        "pairs": len(gallery.pairs()),
    }
    for entry in chain.from_iterable(listed.values()):
        assert re.search(rf"^  {re.escape(entry['name'])} .*{re.escape(entry['about'])}$", out, re.MULTILINE)
        ends = ("/source", "/target") if isinstance(entry["vertices"], list) else ("",)
        found = [len(curve_names.read_shape(entry["name"] + end)) for end in ends]
        assert found == np.atleast_1d(entry["vertices"]).tolist()


@pytest.mark.parametrize("word", ["gallery:ell", "ell", "letter:S", "S", "pair:e_to_l/target", "e_to_l/target", ":"])
def test_a_curve_of_the_gallery_is_written(word: str, run: Run) -> None:
    entry = json.loads(run(f"gallery {word} -o out.json --json")[1])
    assert entry["written"] == "out.json"
    curve = io.read_curve("out.json")
    assert len(curve) == entry["vertices"]
    assert np.array_equal(curve.points, curve_names.read_shape(entry["name"]).points)


def test_a_drawing_from_an_editor_goes_all_the_way(run: Run) -> None:
    drawing = shlex.quote(str(ROOT / "tests" / "fixtures" / "drawing.svg"))
    status, out, err = run(f"info {drawing} --select path1 --pen 8 --json")
    answer = json.loads(out)
    assert (status, err) == (0, "")
    assert (answer["bounds_disk"], answer["crossings"], answer["immersions"]) == (True, 4, 1)
    select = "--select-source path1 --select-target path2 --pen 8"
    way = f"morph {drawing} {drawing} {select} --frames 5 --size 80 --certify"
    for name in ("loop.gif", "loop.svg"):
        status, out, err = run(f"{way} -o {name}")
        assert (status, err) == (0, "")
        assert out.startswith("valid\n")
    with Image.open("loop.gif") as film:
        assert film.n_frames == 5 + 4  # there, and back
    assert ElementTree.parse("loop.svg").getroot().tag == "{http://www.w3.org/2000/svg}svg"


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
    ("triangulate gallery:ell --random one", "whole number"),
    ("triangulate gallery:ell --random 1 --arbitrary", "not allowed"),
    ("triangulate square.json -o square.json", "input"),
    ("morph gallery:ell disk", "--output"),
    ("morph gallery:ell disk -o kept.doc", ".gif"),
    ("morph gallery:ell disk -o none/m.gif", "no folder"),
    ("morph gallery:ell disk -o folder.gif", "it is a folder"),
    ("morph disk disk -o kept.gif", "curve"),
    ("morph eight.csv disk -o kept.gif", "turning number is 0, not 1"),
    ("morph gallery:ell eight.csv -o kept.gif", "the target bounds no immersed disk"),
    ("morph square.json disk -o square.json", "input"),
    ("morph gallery:ell disk -o kept.gif --path straight", "slide"),
    ("morph gallery:ell disk -o kept.gif --strategy none", "common"),
    ("morph gallery:ell disk -o kept.gif --style none", "outline"),
    ("morph gallery:ell disk -o kept.gif --root none", "disk-center, tree-center or a whole number"),
    ("morph gallery:ell disk -o kept.gif --root 45", "from 0 to 44"),
    ("morph gallery:ell disk -o kept.gif --shifts none", "pivots, all or a whole number"),
    ("morph gallery:ell disk -o kept.gif --frames 1", "from 2 on"),
    ("morph gallery:ell disk -o kept.gif --frames ²", "from 2 on"),
    ("morph gallery:ell disk -o kept.gif --fps 101", "from 1 to 100"),
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
    ("gallery e_to_l -o kept.csv", "/source or /target"),
]


@pytest.mark.parametrize(("line", "words"), FAULTS, ids=[line for line, _ in FAULTS])
def test_what_is_wrong_is_said_in_one_line_and_no_file_is_touched(line: str, words: str, run: Run) -> None:
    write_points("eight.csv", EIGHT)
    write_points("few.csv", EIGHT[:2])
    write_points("nan.csv", [[0, 0], [np.nan, 1], [1, 1]])
    Path("square.json").write_text("[[0, 0], [1, 0], [1, 1], [0, 1]]")
    Path("folder.gif").mkdir()
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
    monkeypatch.setattr(commands, "morph_between", None)
    monkeypatch.setattr("tween.plot.animation._ffmpeg", Mock(side_effect=tween.errors.FileError("there is no ffmpeg")))
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
    "info triangulate morph certify gallery gallery:ell letter:S disk pair:e_to_l/source square.csv junk.svg m.npz -o "
    "out.npz out.svg --json --select 0 --random --arbitrary --path slide area --root --strategy paper --shifts all "
    "--frames 2 --size 16 --once --certify --help -1 -- ''".split()
)


@settings(max_examples=150)
@given(st.sampled_from(list(parsers())), st.lists(WORDS, max_size=7))
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


# As a program of its own

# With its output buffered, as it is for people: what could not be written is written once more at the end.
BUFFERED = {key: value for key, value in os.environ.items() if key != "PYTHONUNBUFFERED"}


def program(*words: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, "-m", "tween", *words], capture_output=True, text=True)


def test_python_runs_the_package() -> None:
    done = program("info", "gallery:ell", "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["bounds_disk"]
    done = program("info", "none.csv")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("tween: none.csv")


def test_the_version_is_that_of_the_project() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert program("--version").stdout == f"tween {project['version']}\n"
    assert project["scripts"] == {"tween": "tween.cli:main"}


@pytest.mark.parametrize("words", [["--version"], ["--help"], ["morph", "--help"], ["frob"], []])
def test_help_and_complaints_wait_for_no_import(words: list[str]) -> None:
    code = f"import sys; from tween.cli import main; main({words}); print(*sys.modules, file=sys.stderr)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name.partition(".")[0] for name in done.stderr.splitlines()[-1].split()}
    assert "tween" in loaded
    assert not loaded & {"numpy", "numba", "scipy", "shapely", "matplotlib", "PIL"}


def test_a_reader_that_goes_away_is_no_error() -> None:
    command = [sys.executable, "-m", "tween", "gallery"]
    with subprocess.Popen(command, env=BUFFERED, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert (process.stderr.read(), process.wait()) == (b"", 141)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only some systems have a device that is always full")
def test_an_output_that_cannot_be_written_is_said_in_one_line() -> None:
    with open("/dev/full", "w") as full:
        command = [sys.executable, "-m", "tween", "gallery"]
        done = subprocess.run(command, env=BUFFERED, stdout=full, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (2, "tween: output: No space left on device\n")


def test_modules_imported_first_hide_no_function_of_the_package() -> None:
    code = (
        "import tween.morph, tween.align, tween.plot; from tween.morph import morph; import tween\n"
        "assert tween.morph is morph and callable(tween.align)\n"
        "assert not [name for name in tween.__all__ if not hasattr(tween, name) or name not in dir(tween)]\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)

"""What each command answers is what the library answers."""

import json
import re
import shlex
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from files import FIXTURES
from PIL import Image
from terminal import EIGHT, Run, write_points

import tween
from tween import gallery, io
from tween.app.command_line import commands
from tween.app.playground.hand_drawn import MOST_COUNTED
from tween.plot import animation


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
    line = "morph two.json two.json --select-source ell --select-target arrow -o m.npz --frames 2 --strategy common"
    assert run(line)[0] == 0
    assert len(io.read_frames("m.npz")[0][0]) == len(curves["ell"])


def test_a_line_is_drawn_with_a_pen_and_curves_as_finely_as_asked(run: Run) -> None:
    Path("loop.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C9 0 9 9 5 9S1 0 9 0"/></svg>')
    facts = json.loads(run("info loop.svg --pen 0.5 --json")[1])
    assert facts["bounds_disk"]
    assert facts["vertices"] == len(io.read_stroke("loop.svg", 0.5))
    assert json.loads(run("info loop.svg --pen 0.5 --tolerance 0.1 --json")[1])["vertices"] < facts["vertices"]


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


@pytest.mark.parametrize(
    ("line", "options"),
    [
        ("", {"path": "metric", "guarantee": True}),
        ("--path slide --no-guarantee --strategy paper", {"path": "slide", "guarantee": False, "strategy": "paper"}),
        ("--path area --root tree-center", {"path": "area", "root": "tree-center", "guarantee": True}),
        ("--root 3 --strategy paper", {"path": "metric", "root": 3, "strategy": "paper", "guarantee": True}),
        ("--strategy common --placement root", {"strategy": "common", "placement": "root"}),
        ("--landmark 0:0", {"landmarks": [(0, 0)]}),
    ],
)
def test_morph_writes_the_morph_of_the_library(line: str, options: Any, run: Run) -> None:
    status, out, err = run(f"morph gallery:arrow gallery:ell -o m.npz --frames 7 {line}")
    assert (status, err) == (0, "")
    m = tween.morph(gallery.curve("arrow"), gallery.curve("ell"), **options)
    assert f"wrote m.npz: 7 frames of {len(m.source)} vertices, {len(m.events) or 'no'} flips" in out
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
    assert out.splitlines()[-1].endswith("checked for every instant of playback at 61 frames")
    assert run("certify m.npz")[0] == 0


def test_without_certify_the_last_line_says_what_is_known(run: Run) -> None:
    line = "morph gallery:ell disk --frames 2 -o m.npz"
    assert run(line)[1].endswith("promised to be valid, not checked (--certify checks it)\n")
    assert run(f"{line} --no-guarantee")[1].endswith("no flips, not checked (--certify checks it)\n")


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


def test_frames_that_were_tampered_with_are_refuted(run: Run) -> None:
    assert run("morph gallery:ell disk -o m.json --frames 5")[0] == 0
    status, out, _ = run("certify m.json")
    assert status == 0
    assert out.startswith("m.json: valid at every instant of playback\n")
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


def test_a_drawing_from_an_editor_goes_all_the_way(run: Run) -> None:
    drawing = shlex.quote(str(FIXTURES / "drawing.svg"))
    status, out, err = run(f"info {drawing} --select path1 --pen 8 --json")
    answer = json.loads(out)
    assert (status, err) == (0, "")
    assert (answer["bounds_disk"], answer["crossings"], answer["immersions"]) == (True, 4, 1)
    select = "--select-source path1 --select-target path2 --pen 8"
    way = f"morph {drawing} {drawing} {select} --frames 5 --size 80 --certify"
    for name in ("loop.gif", "loop.svg"):
        status, out, err = run(f"{way} -o {name}")
        assert (status, err) == (0, "")
        assert out.startswith("valid at every instant of playback\n")
    with Image.open("loop.gif") as film:
        assert film.n_frames == 5  # there, and back
    assert ElementTree.parse("loop.svg").getroot().tag == "{http://www.w3.org/2000/svg}svg"

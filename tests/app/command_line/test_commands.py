"""What each command answers is what the library answers."""

import json
import re
import xml.etree.ElementTree as ElementTree
from io import BytesIO, TextIOWrapper
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from terminal import EIGHT, Run, write_points

import tween
from tween import gallery, io
from tween.app.playground.hand_drawn import MOST_COUNTED


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
        "explanation": None,
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


# Repair


def test_info_says_what_would_mend_a_curve_and_draws_it(run: Run) -> None:
    write_points("eight.csv", EIGHT)
    explanation = tween.decompose(EIGHT).explain()
    status, out, err = run("info eight.csv -o why.svg")
    assert (status, err) == (1, "")
    assert str(explanation).splitlines()[1:] == out.splitlines()[-len(str(explanation).splitlines()) : -1]
    assert out.endswith("wrote why.svg\n")
    assert json.loads(run("info eight.csv --json")[1])["explanation"] == explanation.to_dict()
    picture = Path("why.svg").read_bytes()
    assert ElementTree.fromstring(picture).tag == "{http://www.w3.org/2000/svg}svg"
    run("info eight.csv -o why.svg")
    assert Path("why.svg").read_bytes() == picture
    for name, start in (("why.png", b"\x89PNG"), ("why.pdf", b"%PDF")):
        assert run(f"info eight.csv -o {name}")[0] == 1
        assert Path(name).read_bytes().startswith(start)


def noisy(name: str, points: int = 900) -> np.ndarray:
    outline = gallery.curve(name).insert_vertices(points).points
    return outline + np.random.default_rng(0).normal(0, 0.03, outline.shape)


def test_clean_writes_a_curve_that_bounds_a_disk_and_says_what_it_changed(run: Run) -> None:
    write_points("noisy.csv", noisy("arrow"))
    assert run("info noisy.csv")[0] == 1
    status, out, err = run("clean noisy.csv --smooth 0.2 -o clean.csv")
    assert (status, err) == (0, "")
    expected = tween.clean(np.loadtxt("noisy.csv", delimiter=","), smooth=0.2)
    assert out.splitlines()[1:] == [*str(expected.changes).splitlines(), "wrote clean.csv"]
    assert np.array_equal(io.read_curve("clean.csv").points, expected.points)
    assert run("info clean.csv")[0] == 0
    facts = json.loads(run("clean noisy.csv --smooth 0.2 --vertices 90 -o clean.csv --json")[1])
    assert (facts["bounds_disk"], facts["vertices"], facts["written"]) == (True, 90, "clean.csv")


def test_clean_says_where_no_disk_comes_of_it(run: Run) -> None:
    write_points("eight.csv", EIGHT)
    status, out, _ = run("clean eight.csv --smooth 0.01 -o clean.csv")
    assert status == 1
    assert "bounds no disk: turning number is 0, not 1" in out
    assert Path("clean.csv").exists()


@pytest.mark.parametrize(
    "line", ["info noisy.csv", "triangulate noisy.csv", "morph noisy.csv gallery:ell -o m.npz --frames 3"]
)
def test_every_command_that_reads_a_curve_cleans_it_when_asked(line: str, run: Run) -> None:
    write_points("noisy.csv", noisy("arrow"))
    assert run(line)[0] in (1, 2)
    status, out, err = run(f"{line} --smooth 0.2")
    assert status == 0
    assert out
    assert re.fullmatch(r"tween: note: noisy.csv: smoothed by 0.1 of 0.2 allowed: moved by .*\n", err)


# No silent loss


def test_what_is_not_used_of_a_file_is_said_in_one_line(run: Run) -> None:
    Path("a.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H9V9Z"/><text>a</text></svg>')
    status, out, err = run("info a.svg --json")
    assert (status, err) == (0, "tween: note: a.svg: not used: 1 text\n")
    assert json.loads(out)["bounds_disk"]


def test_a_line_that_bounds_no_disk_suggests_its_pen(run: Run) -> None:
    """Without the suggestion, a drawn figure of eight is only told that it bounds no disk."""
    line = '<path id="a" d="M0 0L20 20L20 0L0 20Z" fill="none" stroke="#000" stroke-width="2"/>'
    Path("a.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{line}</svg>')
    status, out, err = run("info a.svg")
    assert (status, err) == (1, "")
    assert "perhaps the line is meant: the pen of 'a', 2 wide (--pen 2," in out
    status, out, err = run("triangulate a.svg")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "--pen 2" in err
    assert run("info a.svg --pen 2")[0] == 0


def test_standard_input_and_path_data_are_read(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", TextIOWrapper(BytesIO(b"0,0\n9,0\n9,9\n")))
    assert run("info -")[1].startswith("- bounds an immersed disk\n")
    assert json.loads(run("info --json", "M0 0H9V9H0Z")[1])["area"] == 81

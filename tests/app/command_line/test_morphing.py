"""`tween morph` writes the morph of the library, between what it was given, and says what is known of it."""

import json
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
from tween.app.command_line import morphing
from tween.app.command_line.shapes import Reading, Shape, read_shape
from tween.easing import as_ease
from tween.plot import animation


@pytest.mark.parametrize(
    ("line", "options"),
    [
        ("", {"path": "metric", "guarantee": True}),
        ("--path slide --no-guarantee --strategy paper", {"path": "slide", "guarantee": False, "strategy": "paper"}),
        ("--path area --root tree-center", {"path": "area", "root": "tree-center", "guarantee": True}),
        ("--root 3 --strategy paper", {"path": "metric", "root": 3, "strategy": "paper", "guarantee": True}),
        ("--strategy common --placement root", {"strategy": "common", "placement": "root"}),
        ("--pace speed", {"pace": "speed"}),
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
    line = "--frames 9 --fps 12 --size 64x48 --style outline --no-ease --once --stroke red --width 3 --background black"
    assert run(f"morph gallery:ell disk -o m.gif {line}")[0] == 0
    chosen = {"frames": 9, "fps": 12, "size": (64, 48), "style": "outline", "ease": as_ease("linear")}
    colors = {"fill": None, "stroke": "red", "width": 3.0, "background": "black"}
    assert seen == {**chosen, **colors, "there_and_back": False}
    seen.clear()
    assert run("morph gallery:ell disk -o m.gif --size small --fill '#00000080'")[0] == 0
    assert (seen["size"], seen["fill"], seen["there_and_back"]) == ("small", "#00000080", None)
    assert "ease" not in seen
    assert run("morph gallery:ell disk -o m.gif --ease 'cubic-bezier(.4, 0, .6, 1)'")[0] == 0
    assert seen["ease"] == as_ease((0.4, 0, 0.6, 1))


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
        assert out.startswith("valid at every time\n")
    with Image.open("loop.gif") as film:
        assert film.n_frames == 5  # there, and back
    assert ElementTree.parse("loop.svg").getroot().tag == "{http://www.w3.org/2000/svg}svg"


# Brought together


def test_a_curve_that_bounds_no_disk_is_named_with_its_file_and_what_would_mend_it(run: Run) -> None:
    write_points("eight.csv", EIGHT)
    summary = tween.decompose(EIGHT).explain().summary
    for ends in ("gallery:ell eight.csv", "eight.csv gallery:ell", "eight.csv disk"):
        status, out, err = run(f"morph {ends} -o m.gif")
        assert (status, out) == (2, "")
        assert err == f"tween: eight.csv: t{summary[1:]}\n"
        assert not Path("m.gif").exists()


@pytest.mark.parametrize("fit", ["none", "area", "box"])
def test_the_second_curve_is_brought_to_the_place_of_the_first(fit: str, run: Run) -> None:
    write_points("pixels.csv", 700 * gallery.curve("arrow").points + [3000, 500])
    assert run(f"morph gallery:ell pixels.csv -o m.npz --frames 2 --fit {fit}")[0] == 0
    first, last = (tween.Curve(frame) for frame in io.read_frames("m.npz")[0])
    expected = {"none": 700**2 * gallery.curve("arrow").area, "area": first.area}.get(fit)
    if expected:
        assert last.area == pytest.approx(expected)
    else:
        assert np.ptp(last.points, axis=0).max() == pytest.approx(np.ptp(first.points, axis=0).max())


def drawing(name: str, marks: dict[str, int]) -> None:
    points = gallery.curve(name).points * [1, -1]
    path = f'<path d="M{" ".join(f"{x!r} {y!r}" for x, y in points.tolist())}Z"/>'
    circles = (f'<circle id="{key}" cx="{points[v, 0]}" cy="{points[v, 1]}" r="0.1"/>' for key, v in marks.items())
    Path(f"{name}.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{path}{"".join(circles)}</svg>')


def test_circles_of_the_same_id_in_both_files_are_landmarks(run: Run) -> None:
    drawing("arrow", {"tip": 0, "tail": 20, "other": 5})
    drawing("ell", {"tail": 30, "tip": 12})
    line = "morph arrow.svg ell.svg --frames 3 --strategy matched"
    status, _, err = run(f"{line} -o m.npz")
    assert status == 2
    assert "arrow.svg: holds 4 curves" in err
    status, out, err = run(f"{line} -o m.npz --landmarks-from-files")
    assert (status, err) == (0, "")
    assert out.startswith("landmarks: tip 0:12, tail 20:30\n")
    assert run(f"{line} -o n.npz --select-source 0 --select-target 0 --landmark 0:12 --landmark 20:30")[0] == 0
    assert np.array_equal(io.read_frames("m.npz")[0], io.read_frames("n.npz")[0])


def test_points_of_the_same_name_in_two_geojson_files_are_landmarks(run: Run) -> None:
    for name, vertex in (("arrow", 0), ("ell", 12)):
        points = gallery.curve(name).points.tolist()
        geometries = {"LineString": points, "Point": points[vertex]}
        features = [
            {"type": "Feature", "id": kind, "properties": {}, "geometry": {"type": kind, "coordinates": place}}
            for kind, place in geometries.items()
        ]
        content = {"type": "FeatureCollection", "features": features}
        Path(f"{name}.geojson").write_text(json.dumps(content))
    status, out, err = run("morph arrow.geojson ell.geojson -o m.npz --frames 2 --landmarks-from-files")
    assert (status, err) == (0, "")
    assert out.startswith("landmarks: Point 0:12\n")


# Keyframes


@pytest.mark.parametrize("name", ["loop.gif", "loop.svg", "loop.npz"])
def test_a_loop_of_several_curves_is_one_command(name: str, run: Run) -> None:
    status, out, err = run(f"morph letter:a letter:e letter:l letter:a -o {name} --certify --size 90 --frames 31")
    assert (status, err) == (0, "")
    assert out.startswith("valid at every time\n")
    assert "31 frames of" in out.splitlines()[-1]
    assert "no flips" in out  # diagonals change at the keyframes, where nothing moves
    if name == "loop.gif":
        with Image.open(name) as film:
            assert film.n_frames <= 31
    else:
        frames = io.read_frames(name)[0]
        assert np.array_equal(frames[0], frames[-1])
    if name == "loop.npz":
        curves = [gallery.letter(c) for c in "ael"]
        assert np.array_equal(frames, tween.sequence(curves, loop=True).frames(31))


def test_curves_that_do_not_come_back_make_no_loop(run: Run) -> None:
    status, out, _ = run("morph gallery:ell gallery:arrow gallery:convex -o m.npz")
    assert status == 0
    assert "wrote m.npz: 61 frames of" in out
    frames = io.read_frames("m.npz")[0]
    assert len(frames) == 61
    curves = [gallery.curve(name) for name in ("ell", "arrow", "convex")]
    assert np.array_equal(frames, tween.sequence(curves).frames(61))


def test_landmarks_of_keyframes_are_one_vertex_of_each(run: Run) -> None:
    for name, vertex in (("arrow", 0), ("ell", 12), ("convex", 5)):
        drawing(name, {"tip": vertex})
    line = "morph arrow.svg ell.svg convex.svg arrow.svg --frames 4 -o m.npz"
    status, out, err = run(f"{line} --landmarks-from-files")
    assert (status, err) == (0, "")
    assert out.startswith("landmarks: tip 0:12:5\n")
    status, _, err = run("morph gallery:arrow gallery:ell gallery:convex -o m.npz --landmark 0:12")
    assert (status, err) == (2, "tween: landmark 0:12 has 2 vertices, expected one of each of 3 curves\n")


def test_a_keyframe_that_bounds_no_disk_is_named_with_its_number_and_file(run: Run) -> None:
    write_points("eight.csv", EIGHT)
    good = " ".join(["gallery:ell"] * 7)
    status, out, err = run(f"morph {good} eight.csv gallery:arrow -o m.gif")
    assert (status, out) == (2, "")
    assert err.startswith(
        "tween: eight.csv (keyframe 7): the curve bounds no immersed disk: turning number is 0, not 1"
    )
    assert not Path("m.gif").exists()


def test_all_keyframes_are_brought_to_the_place_of_the_first(run: Run) -> None:
    for k, name in ((1, "arrow"), (2, "convex")):
        write_points(f"{k}.csv", 10.0**k * gallery.curve(name).points)
    assert run("morph gallery:ell 1.csv 2.csv gallery:ell -o m.npz --frames 4 --fit area")[0] == 0
    areas = [tween.Curve(frame).area for frame in io.read_frames("m.npz")[0]]
    assert areas == pytest.approx([gallery.curve("ell").area] * 4)


def test_beside_a_file_only_the_file_is_smoothed_as_its_unit_is_another(run: Run, monkeypatch: Any) -> None:
    asked: dict[str, float | None] = {}

    def read(word: str, select: str | None, how: Reading) -> Shape:
        asked[word] = how.smooth
        return read_shape(word, select)

    monkeypatch.setattr(morphing, "read_shape", read)
    assert run("gallery ell -o ell.csv")[0] == 0
    for line, smoothed in (
        ("ell.csv letter:e", {"ell.csv": 0.1, "letter:e": None}),
        ("letter:e disk", {"letter:e": 0.1}),
        ("gallery:ell letter:e", {"gallery:ell": 0.1, "letter:e": 0.1}),
    ):
        asked.clear()
        assert run(f"morph {line} -o out.npz --smooth 0.1 --frames 3")[0] == 0
        assert asked == smoothed


def test_of_several_drawings_the_pen_draws_the_lines_and_leaves_what_is_filled(run: Run) -> None:
    svg = '<svg xmlns="http://www.w3.org/2000/svg"><path d="{}" {}/></svg>'
    Path("filled.svg").write_text(svg.format("M0 0H90V90H0Z", 'fill="#2a7"'))
    Path("line.svg").write_text(svg.format("M0 0H90V90H180", 'fill="none" stroke="black" stroke-width="9"'))
    status, _, err = run("morph filled.svg line.svg filled.svg -o loop.npz --pen 9 --frames 3")
    assert (status, err) == (0, "tween: note: filled.svg: not drawn with the pen, as it is filled\n")
    frames = io.read_frames("loop.npz")[0]
    assert tween.Curve(frames[0]).area == 8100
    assert abs(tween.Curve(frames[1]).area - 270 * 9) < 1
    assert run("morph filled.svg disk -o ring.npz --pen 9 --frames 3")[0] == 0  # the only one is drawn as asked
    assert abs(tween.Curve(io.read_frames("ring.npz")[0][0]).area - 360 * 9) < 100

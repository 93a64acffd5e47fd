"""The playground without a browser: strokes, verdicts, morphs in numbers, files, and what stands in for it."""

import importlib.util
import io
import json
import re
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from tween import certify, gallery, verify
from tween.errors import CurveError, FileError
from tween.footage import FRAMES, angle_sums, fit, footage
from tween.io import read_curve, read_frames
from tween.morph import morph
from tween.paths import PATHS
from tween.sketch import KINDS, OPTIONS, TRIANGULATIONS, Sketch
from tween.stroke import BOX, from_stroke, judge
from tween.widget import Picture, playground

STATIC = Path(__file__).resolve().parent.parent / "tween" / "static"
LOOP, DISK = {"name": "loop"}, {"name": "disk"}
LIVE = importlib.util.find_spec("anywidget") is not None


def circle(turns: float = 1.0, k: int = 90) -> np.ndarray:
    """Places of a hand that goes around once, or a little more or less."""
    t = 2 * np.pi * np.linspace(0, turns, k)
    return 500 + 300 * np.stack([np.cos(t), np.sin(t)], axis=1)


def eight() -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, 90)
    return 500 + 300 * np.stack([np.sin(2 * t), np.sin(t)], axis=1)


def twice() -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, 90)
    return 500 + 150 * np.stack([np.cos(t) + 1.2 * np.cos(2 * t), np.sin(t) + 1.2 * np.sin(2 * t)], axis=1)


def bows() -> np.ndarray:
    """Three bows in a row, the middle one traversed the other way."""
    t = np.linspace(0, 2 * np.pi, 120)
    x, y = 1.6 * np.cos(t) + 0.4 * np.cos(3 * t), 0.4 * np.sin(t) - 0.4 * np.sin(3 * t)
    return 500 + 220 * np.stack([x, y], axis=1)


def traced(name: str) -> np.ndarray:
    """Places of a hand that traces a curve of the gallery."""
    points = np.reshape(fit(gallery.curve(name).points), (-1, 2))
    return np.concatenate([points, points[:1]])


# Strokes


def test_a_stroke_becomes_evenly_spaced_vertices() -> None:
    points = from_stroke(circle())
    edges = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    assert 60 <= len(points) <= 120
    assert np.ptp(edges) < 0.02 * edges.mean()
    assert abs(np.hypot(*(points - 500).T) - 300).max() < 5


@pytest.mark.parametrize("turns", [0.8, 0.97, 1.0, 1.02, 1.07, 1.1])
@pytest.mark.parametrize("name", ["circle", "loop", "pretzel"])
def test_a_hand_that_stops_early_or_goes_too_far_adds_no_turn(turns: float, name: str) -> None:
    stroke = circle(turns)
    if name != "circle":
        outline = traced(name)
        k = round(turns * len(outline))
        stroke = np.concatenate([outline, outline[1:]])[:k] if turns > 0.9 else outline
        stroke = stroke + np.linspace(0, 12, len(stroke))[:, None]  # beside the beginning, as hands do
    assert judge(from_stroke(stroke)).curve.turning_number == 1


def test_a_trembling_hand_is_smoothed() -> None:
    stroke = circle(k=200) + np.random.default_rng(3).normal(0, 4, (200, 2))
    points = from_stroke(stroke)
    assert not judge(stroke).answer
    assert judge(points).answer
    assert np.hypot(*(points - 500).T).std() < 2


def test_ends_that_are_far_apart_are_kept() -> None:
    stroke = np.array([[200, 800], [300, 300], [700, 300], [800, 800]])
    assert (np.ptp(from_stroke(stroke), axis=0) > [560, 470]).all()


def test_a_long_stroke_has_at_most_120_vertices_and_a_small_one_60() -> None:
    assert len(from_stroke(traced("five_disks"))) == 120
    assert len(from_stroke(0.2 * circle())) == 60


@pytest.mark.parametrize(
    ("stroke", "words"),
    [
        ([], "shape"),
        ([[1, 2, 3]], "shape"),
        ("scribble", "no list of places"),
        ([[0, 0], [float("nan"), 1]], "finite"),
        ([[5, 5]], "too short"),
        ([[5, 5], [6, 6], [5, 5]], "too short"),
    ],
)
def test_what_is_no_stroke_is_refused(stroke: Any, words: str) -> None:
    with pytest.raises(CurveError, match=words):
        from_stroke(stroke)


# Verdicts


@pytest.mark.parametrize(
    ("stroke", "words"),
    [
        (circle(), "Bounds an immersed disk. 75 vertices, no crossings, "),
        (traced("loop"), "Bounds an immersed disk. "),
        (eight(), "Bounds no disk: it turns as much to the right as to the left"),
        (twice(), "Bounds no disk: it turns 2 times"),
        (bows(), "Bounds no disk: it turns once, but"),
    ],
)
@pytest.mark.parametrize("direction", [1, -1])
def test_the_verdict_is_the_same_in_both_directions(stroke: np.ndarray, words: str, direction: int) -> None:
    shape = judge(from_stroke(stroke[::direction]))
    assert shape.words.startswith(words)
    assert bool(shape.answer) == ("immersed" in words)


def test_a_clockwise_curve_is_traversed_the_other_way_and_says_so() -> None:
    assert "clockwise" not in judge(from_stroke(circle())).words
    assert "clockwise" in judge(from_stroke(circle()[::-1])).words


# Morphs in numbers


def test_the_sums_of_angles_are_those_of_the_certificate() -> None:
    m = morph(gallery.curve("three_lobes"), gallery.curve("spiral_2"), strategy="paper")
    assert m.events
    sums = angle_sums(m, np.linspace(0, 1, 100))
    assert sums.max() <= certify(m).max_angle + 1e-9
    assert abs(sums.sum(axis=1) - np.pi * (len(m.source) - 2)).max() < 1e-6
    assert abs(sums[0] - angle_sums(m, np.array([0.0]))[0]).max() == 0


def test_footage_is_json_and_fits_into_the_field() -> None:
    m = morph(gallery.curve("loop"), gallery.letter("S"), strategy="paper")
    seen = json.loads(json.dumps(footage(m)))
    assert len(seen["frames"]) == len(seen["stage"]) == len(seen["areas"]) == len(seen["sums"]) == FRAMES
    assert len(seen["stages"]) == max(seen["stage"]) + 1 > 1
    assert sorted(seen["order"]) == list(range(len(m.source) - 2))
    assert all(0 <= x <= BOX for frame in seen["frames"] for x in frame)
    assert seen["root"] == -1
    assert len(json.dumps(seen)) < 600_000


def test_footage_shows_the_triangles_that_are_in_force() -> None:
    m = morph(gallery.curve("loop"), gallery.letter("S"), strategy="paper")
    seen = footage(m)
    for f, t in enumerate(np.linspace(0, 1, FRAMES)):
        assert seen["stages"][seen["stage"][f]] == m.triangles_at(t).ravel().tolist()


def test_a_refuted_morph_says_when_and_where_and_what_helps() -> None:
    seen = footage(morph(*gallery.fan()))
    assert not seen["valid"]
    assert re.match(r"Bounds no disk at t = 0\.\d+: the angles at vertex 0 add up to", seen["words"])
    assert seen["words"].endswith("With the guarantee it would not.")
    assert max(seen["sums"]) > 2 * np.pi


def test_the_guarantee_is_not_recommended_to_those_who_have_it() -> None:
    refuted = footage(morph(*gallery.fan()), guarantee=True)
    assert "guarantee" not in refuted["words"]
    mended = footage(morph(*gallery.fan(), guarantee=True), guarantee=True)
    assert mended["valid"] and max(mended["sums"]) < 2 * np.pi


# A sketch


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("triangulation", TRIANGULATIONS)
@pytest.mark.parametrize("target", [{"name": "disk"}, {"name": "e"}])
def test_every_choice_gives_a_morph(path: str, triangulation: str, target: dict[str, Any]) -> None:
    sketch = Sketch()
    verdicts = sketch.choose({"stroke": traced("horseshoe").tolist()}, target)
    assert verdicts["source"]["ok"] and verdicts["target"]["ok"]
    film = sketch.move({"path": path, "triangulation": triangulation, "guarantee": True})
    assert film["valid"], film["words"]
    assert len(film["frames"]) == FRAMES


def test_a_field_shows_a_drawn_curve_where_it_was_drawn() -> None:
    seen = Sketch().choose({"stroke": (0.5 * circle()).tolist()}, LOOP)["source"]
    points = np.reshape(seen["points"], (-1, 2))
    assert abs(points.mean(axis=0) - 250).max() < 5
    assert np.reshape(seen["triangles"], (-1, 3)).shape == (len(points) - 2, 3)


def test_drawn_curves_keep_their_sizes_and_others_are_made_comparable() -> None:
    small, large = {"stroke": (0.4 * circle()).tolist()}, {"stroke": circle().tolist()}
    for target, low, high in ((large, 6, 6.5), (LOOP, 0.4, 2.1)):
        sketch = Sketch()
        sketch.choose(small, target)
        sketch.move({})
        assert sketch.morph is not None
        assert low < sketch.morph.target.areas.sum() / sketch.morph.source.areas.sum() < high


def test_the_disk_waits_for_a_curve_that_bounds_one() -> None:
    sketch = Sketch()
    seen = sketch.choose({"stroke": eight().tolist()}, DISK)
    assert not seen["source"]["ok"] and seen["source"]["points"] and not seen["source"]["triangles"]
    assert seen["target"] == {
        "ok": False,
        "words": "A disk, once the first curve bounds one.",
        "points": [],
        "triangles": [],
    }
    film = sketch.move(OPTIONS)
    assert film == {"frames": [], "words": "No morph: both curves have to bound a disk.", "valid": False}
    assert sketch.morph is None


def test_nothing_drawn_yet_asks_for_a_curve() -> None:
    sketch = Sketch()
    assert sketch.choose(LOOP, {"name": "draw"})["target"]["words"].startswith("Draw a closed curve")
    assert sketch.move(OPTIONS)["words"].startswith("Draw a closed curve")


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ({"name": "no such curve"}, "there is no curve 'no such curve'"),
        ({"name": "given"}, "there is no curve 'given'"),
        ({"stroke": "scribble"}, "no list of places"),
        ({"stroke": [[1, 1]]}, "too short"),
        ({"stroke": None}, "stroke"),
    ],
)
def test_what_is_wrong_with_a_shape_is_said_in_words(source: dict[str, Any], words: str) -> None:
    sketch = Sketch()
    seen = sketch.choose(source, DISK)
    assert words in seen["source"]["words"]
    assert not seen["source"]["ok"]
    assert sketch.move(OPTIONS)["frames"] == []


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"path": "straight"}, "path is 'straight'"),
        ({"root": 10_000}, "root is 10000"),
        ({"triangulation": "best"}, "triangulation is 'best'"),
        ({"color": "red"}, "color"),
    ],
)
def test_what_is_wrong_with_an_option_is_said_in_words(options: dict[str, Any], words: str) -> None:
    sketch = Sketch()
    sketch.choose(LOOP, DISK)
    film = sketch.move(options)
    assert words in film["words"]
    assert film["frames"] == [] and sketch.morph is None


def test_another_seed_draws_other_triangles_and_the_same_seed_the_same() -> None:
    sketch = Sketch()
    sketch.choose(LOOP, DISK)
    first, second, again = (sketch.move({"triangulation": "random", "seed": seed})["stages"] for seed in (1, 2, 1))
    assert first == again != second


def test_a_triangle_that_was_clicked_is_the_root() -> None:
    sketch = Sketch()
    sketch.choose(LOOP, DISK)
    assert sketch.move({"root": 5})["root"] == 5


def test_a_curve_of_ones_own_can_be_given() -> None:
    sketch = Sketch(gallery.letter("e"))
    assert sketch.choose({"name": "given"}, DISK)["source"]["ok"]
    assert sketch.source.curve is sketch.given


# Files


@pytest.fixture(scope="module")
def played() -> Sketch:
    sketch = Sketch()
    sketch.choose({"stroke": circle().tolist()}, {"name": "C"})
    sketch.move({"guarantee": True})
    return sketch


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_file_is_written(played: Sketch, tmp_path: Path, kind: str) -> None:
    path = played.save(kind, tmp_path)
    assert path.parent == tmp_path and path.name == KINDS[kind][1]
    assert path.stat().st_size > 1000


def test_frames_read_back_are_certified_and_the_curve_is_the_one_drawn(played: Sketch, tmp_path: Path) -> None:
    frames, triangles, times = read_frames(played.save("npz", tmp_path))
    assert verify(frames, triangles, times).valid
    assert (read_curve(played.save("csv", tmp_path)).points == played.source.curve.points).all()


def test_no_file_is_overwritten(played: Sketch, tmp_path: Path) -> None:
    names = [played.save("csv", tmp_path).name for _ in range(3)]
    assert names == ["tween_curve.csv", "tween_curve_2.csv", "tween_curve_3.csv"]


def test_what_cannot_be_saved_is_said(played: Sketch, tmp_path: Path) -> None:
    with pytest.raises(FileError, match="there is no kind of file 'exe'; expected one of gif, "):
        played.save("exe", tmp_path)
    with pytest.raises(FileError, match="there is no morph to save yet"):
        Sketch().save("gif", tmp_path)
    with pytest.raises(FileError, match="there is no curve to save yet"):
        Sketch().save("csv", tmp_path)
    with pytest.raises(FileError):
        played.save("npz", tmp_path / "no such folder")
    assert not list(tmp_path.iterdir())


# What is shown


def test_without_a_front_end_there_is_a_picture_with_instructions() -> None:
    shown = playground()
    assert isinstance(shown, Picture)
    text = str(shown)
    assert "JupyterLab" in text and "Bounds an immersed disk." in text and "Every shape bounds a disk" in text
    assert max(map(len, text.splitlines())) < 240
    picture = Image.open(io.BytesIO(shown._repr_png_()))
    assert picture.size == (1000, 200)
    assert np.asarray(picture).std() > 10


def test_without_its_packages_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    found = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "anywidget" else found(name))
    shown = playground(live=True)
    assert isinstance(shown, Picture)
    assert "it needs anywidget: pip install 'tween[playground]'" in str(shown)


def test_a_curve_that_bounds_no_disk_has_words_but_no_picture() -> None:
    shown = playground(from_stroke(eight()), live=False)
    assert "Bounds no disk" in str(shown)
    assert shown._repr_png_() is None


@pytest.mark.parametrize(("asks", "live"), [(True, True), (False, False), (None, False)])
def test_a_front_end_is_where_somebody_could_be_asked(monkeypatch: pytest.MonkeyPatch, asks: Any, live: bool) -> None:
    message = {"content": {"allow_stdin": asks}} if asks is not None else None
    shell = SimpleNamespace(get_parent=lambda: message)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    monkeypatch.setattr("tween.widget._widget", lambda: lambda sketch: "alive")
    assert (playground() == "alive") == (live and LIVE)


def test_the_face_asks_nothing_of_the_network() -> None:
    for path in sorted(STATIC.iterdir()):
        assert not re.search(r"https?:|//[a-z]|\bimport\b|url\(|fetch\(", path.read_text()), path.name


# The widget, without a browser


@pytest.fixture
def alive() -> Any:
    pytest.importorskip("anywidget", reason="the widget needs the extra playground")
    return playground(live=True)


def test_the_widget_starts_with_a_morph(alive: Any) -> None:
    assert alive.shapes["source"]["ok"] and alive.film["valid"]
    assert json.loads(json.dumps(alive.setup))["curves"][0][0] == "convex"
    assert alive.sketch.morph is not None


def test_a_stroke_is_answered(alive: Any) -> None:
    alive.source = {"stroke": eight().tolist()}
    assert alive.shapes["source"]["words"].startswith("Bounds no disk")
    assert alive.film["frames"] == []
    alive.set_trait("source", {"stroke": circle().tolist()})
    assert alive.shapes["source"]["ok"] and alive.film["valid"]


def test_an_answer_is_sent_even_if_it_is_the_same(alive: Any) -> None:
    seen = []
    alive.observe(lambda change: seen.append(change.new), names=["film", "file"])
    alive.options = {"path": "nonsense", "asked": 1}
    alive.options = {"path": "nonsense", "asked": 2}
    alive.wish = {"kind": "exe", "asked": 1}
    alive.wish = {"kind": "exe", "asked": 2}
    assert len(seen) == 4
    assert seen[0]["words"] == seen[1]["words"] and seen[2]["words"] == seen[3]["words"]


def test_verdicts_come_before_the_morph_and_nothing_is_computed_twice(
    alive: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Any] = []
    move = alive.sketch.move
    monkeypatch.setattr(alive.sketch, "move", lambda options: (seen.append("move"), move(options))[1])
    alive.observe(lambda change: seen.append(change.name), names=["shapes", "film"])
    alive.source = {"name": "ess"}
    alive.options = {"path": "linear"}
    with alive.hold_trait_notifications():  # as one message from the browser does
        alive.source = {"name": "ell"}
        alive.options = {"path": "slide"}
    assert seen == ["shapes", "move", "film", "move", "film", "shapes", "move", "film"]


def test_a_file_goes_to_the_current_folder(alive: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    alive.wish = {"kind": "csv", "where": "folder", "asked": 1}
    assert re.fullmatch(r"Saved tween_curve\.csv, \d kB, in the current folder\.", alive.file["words"])
    assert "data" not in alive.file
    assert (tmp_path / "tween_curve.csv").exists()


def test_a_file_goes_to_the_browser(alive: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    alive.wish = {"kind": "npz", "where": "browser", "asked": 1}
    assert np.load(io.BytesIO(alive.file["data"]))["frames"].shape[1:] == (86, 2)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("wish", [{"kind": "exe"}, {}, {"kind": "exe", "where": "browser"}])
def test_a_wish_that_cannot_be_granted_is_answered_in_words(alive: Any, wish: dict[str, Any]) -> None:
    alive.wish = wish | {"asked": 1}
    assert alive.file["words"].startswith("Not saved: ")


def test_a_notebook_that_holds_the_widget_holds_text_too(alive: Any) -> None:
    data, _ = alive._repr_mimebundle_()
    assert "draw a closed curve" in data["text/plain"]

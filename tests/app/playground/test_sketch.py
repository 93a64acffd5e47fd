"""What a person does at the playground, without the browser: shapes, morphs, files, and errors in words."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from strokes import DISK, LOOP, circle, eight, traced

from tween import gallery, verify
from tween.app.playground.footage import FRAMES
from tween.app.playground.sketch import KINDS, OPTIONS, TRIANGULATIONS, Sketch
from tween.choices import PATHS
from tween.errors import FileError
from tween.io.frames import read_frames
from tween.io.reading import read_curve


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
        "rows": None,
        "why": None,
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


def matched(landmarks: Any, target: dict[str, Any] | None = None, **options: Any) -> tuple[Sketch, dict[str, Any]]:
    sketch = Sketch()
    sketch.choose({"name": "arrow"}, target or {"name": "ell"})
    return sketch, sketch.move({"landmarks": landmarks, **options})


@pytest.mark.parametrize("target", [{"name": "ell"}, DISK])
def test_landmarks_correspond_and_are_marked_on_the_way(target: dict[str, Any]) -> None:
    sketch, film = matched([[0, 12], [20, 30]], target)
    m = sketch.morph
    assert m is not None and film["valid"]
    assert [m.source_vertices[v] for v in film["marks"]] == [0, 20]
    assert [m.target_vertices[v] for v in film["marks"]] == [12, 30]
    plain, other = matched([], target)
    assert plain.morph is not None and other["marks"] == []
    assert dict(zip(plain.morph.source_vertices, plain.morph.target_vertices, strict=True))[0] != 12


@pytest.mark.parametrize(
    ("landmarks", "options", "words"),
    [
        ([[0, 12], [20, 30], [30, 20]], {}, "not in the same order around both curves"),
        ([[0, 12], [0, 13]], {}, "both use vertex 0 of the source"),
        ([[43, 12]], {}, "43"),
        ([[0, 12, 3]], {}, "too many values"),
        (7, {}, "not iterable"),
        ([[0, 12]], {"triangulation": "random"}, "landmarks are for triangles that are matched, but those are random"),
    ],
)
def test_what_is_wrong_with_landmarks_is_said_in_words(landmarks: Any, options: dict[str, Any], words: str) -> None:
    sketch, film = matched(landmarks, **options)
    assert words in film["words"]
    assert film["frames"] == [] and sketch.morph is None


def test_a_change_that_leaves_no_curve_is_shown_all_the_same() -> None:
    wish = {"of": {"stroke": circle().tolist()}, "moved": [[5, 0, 0], [6, 0, 0]]}
    seen = Sketch().choose(wish, DISK)["source"]
    assert not seen["ok"] and len(seen["points"]) == 150 and "zero length" in seen["words"]


def test_rows_tell_a_moved_curve_that_turned_clockwise_from_what_it_was() -> None:
    triangle = Sketch([[0, 0], [2, 0], [0, 2]])
    place = {"of": {"name": "given"}, "moved": [[1, 0, 0]]}
    assert triangle.choose(place, DISK)["source"]["rows"] in ([0, 1, 2], [0, 2, 1])
    mirrored = {"of": {"name": "given"}, "moved": [[2, 900, 0], [1, 60, 900]]}
    assert triangle.choose(mirrored, DISK)["source"]["rows"] == [0, 2, 1]
    assert triangle.choose({"name": "given"}, DISK)["source"]["rows"] is None


def test_landmarks_keep_their_vertices_where_a_moved_curve_turns_clockwise() -> None:
    sketch = Sketch([[0, 0], [4, 0], [4, 4], [0, 4]])
    mirrored = {"of": {"name": "given"}, "moved": [[0, 900, 100], [1, 100, 100], [2, 100, 900], [3, 900, 900]]}
    sketch.choose(mirrored, {"name": "given"})
    film = sketch.move({"landmarks": [[1, 0]]})
    m = sketch.morph
    assert film["valid"] and m is not None
    source, target = m.source.points[film["marks"][0]], m.target.points[film["marks"][0]]
    np.testing.assert_allclose(sketch.source.placement.forth([source]), [100, 100])
    np.testing.assert_allclose(target - m.target.points.min(axis=0), 0, atol=1e-9)


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

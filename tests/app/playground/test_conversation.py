"""What the browser says is answered in plain dictionaries, and bad input in words."""

import json
from pathlib import Path
from typing import Any

import pytest
from strokes import DISK, LOOP, eight

from tween.app.playground.conversation import LANDMARKS, Conversation, setup
from tween.app.playground.sketch import KINDS, Sketch

CSV = b"0,0\n2,0\n0,2\n"
TWO = b'{"curves": {"a": [[0, 0], [1, 0], [0, 1]], "b": [[0, 0], [2, 0], [2, 2], [0, 2]]}}'


@pytest.fixture
def talk() -> Conversation:
    return Conversation(Sketch())


def said(talk: Conversation, source: Any, target: Any, **options: Any) -> dict[str, Any]:
    return dict(talk.answer(source, target, options))


def test_a_vertex_on_its_way_gets_a_verdict_and_no_morph_until_it_is_let_go(talk: Conversation) -> None:
    moved = {"of": LOOP, "moved": [[0, 500, 500]]}
    assert list(said(talk, LOOP, DISK, asked=1)) == ["shapes", "footage"]
    dragged = said(talk, moved, DISK, asked=2, dragging=True)
    assert list(dragged) == ["shapes"] and dragged["shapes"]["asked"] == 2
    assert "triangulations" not in dragged["shapes"]["source"]["words"]
    let_go = said(talk, moved, DISK, asked=3, dragging=False)
    assert list(let_go) == ["shapes", "footage"]
    assert "triangulations" in let_go["shapes"]["source"]["words"] or not let_go["shapes"]["source"]["ok"]


def test_what_was_answered_is_not_answered_again(talk: Conversation) -> None:
    assert said(talk, LOOP, DISK, asked=1)
    assert said(talk, LOOP, DISK, asked=1) == {}
    assert list(said(talk, LOOP, DISK, asked=2, path="slide")) == ["footage"]


def test_why_a_curve_bounds_no_disk_goes_to_the_browser(talk: Conversation) -> None:
    shapes = json.loads(json.dumps(said(talk, {"stroke": eight().tolist()}, DISK)["shapes"]))
    why = shapes["source"]["why"]
    assert why["advice"].startswith("Without the dashed loop it bounds one; ")
    assert why["mended"] and why["lost"] and why["places"][:2] == [500, 500]
    assert shapes["target"]["why"] is None


def test_a_curve_that_was_handed_in_can_be_chosen(talk: Conversation) -> None:
    taken = talk.take({"name": "a.csv", "data": memoryview(CSV), "asked": 4})
    assert taken == {"curves": ["a.csv"], "chosen": "a.csv", "words": "", "asked": 4}
    assert said(talk, {"name": "a.csv"}, DISK)["shapes"]["source"]["ok"]


def test_of_several_curves_the_first_is_chosen_and_all_are_offered(talk: Conversation) -> None:
    taken = talk.take({"name": "two.json", "data": TWO})
    assert (taken["chosen"], taken["curves"]) == ("two.json: a", ["two.json: a", "two.json: b"])
    assert taken["words"] == "The file holds 2 curves; this is the first, and the menus have all."


def test_a_file_of_the_same_name_replaces_nothing(talk: Conversation) -> None:
    talk.take({"name": "a.csv", "data": CSV})
    before = talk.sketch.curves["a.csv"]
    assert talk.take({"name": "a.csv", "data": b"0,0\n2,0\n2,2\n0,2\n"})["chosen"] == "a.csv (2)"
    assert talk.sketch.curves["a.csv"] is before
    assert len(talk.sketch.curves["a.csv (2)"]) == 4


@pytest.mark.parametrize(
    ("upload", "words"),
    [
        ({}, "no file came"),
        ({"name": "a.csv", "data": "text"}, "no file came"),
        ({"name": "a.csv", "data": b"foo"}, "a.csv: "),
        ({"name": "a.exe", "data": b"MZ"}, "a.exe: has the suffix"),
    ],
)
def test_a_bad_file_is_answered_in_one_line_and_what_there_is_stays(
    talk: Conversation, upload: dict[str, Any], words: str
) -> None:
    talk.take({"name": "good.csv", "data": CSV})
    taken = talk.take(upload)
    assert words in taken["words"] and "\n" not in taken["words"]
    assert (taken["curves"], taken["chosen"]) == (["good.csv"], "")


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_file_is_downloaded_or_saved_in_the_folder(kind: str, tmp_path: Path) -> None:
    talk = Conversation(Sketch(), tmp_path)
    said(talk, LOOP, DISK)
    got = talk.keep({"kind": kind, "where": "browser", "asked": 1})
    assert got["name"] == KINDS[kind][1] and len(got["data"]) > 1000 and not list(tmp_path.iterdir())
    assert talk.keep({"kind": kind, "where": "folder"})["words"].startswith(f"Saved {KINDS[kind][1]}")
    assert [path.name for path in tmp_path.iterdir()] == [KINDS[kind][1]]


def test_white_numbers_can_be_read_on_every_colour_of_a_landmark() -> None:
    for color in LANDMARKS:
        channels = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in channels]
        luminance = 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        assert 1.05 / (luminance + 0.05) > 4.5, color


def test_what_the_browser_has_to_know_is_json() -> None:
    known = json.loads(json.dumps(setup(Sketch())))
    assert known["curves"][0][0] == "convex" and not known["given"]
    assert ".svg" in known["suffixes"] and known["landmarks"] == list(LANDMARKS)

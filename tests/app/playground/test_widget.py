"""The widget without a browser, and what stands in for it where nobody could use it."""

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
from strokes import circle, eight

from tween import gallery
from tween.app.playground import widget
from tween.app.playground.hand_drawn import from_stroke
from tween.app.playground.widget import Picture, playground
from tween.io.writing import write_curve

STATIC = Path(widget.__file__).with_name("static")
LIVE = importlib.util.find_spec("anywidget") is not None


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
    assert "it needs anywidget: pip install '.[playground]'" in str(shown)


def test_a_curve_that_bounds_no_disk_has_words_but_no_picture() -> None:
    shown = playground(from_stroke(eight()), live=False)
    assert "Bounds no disk" in str(shown)
    assert shown._repr_png_() is None


@pytest.mark.parametrize(("asks", "live"), [(True, True), (False, False), (None, False)])
def test_a_front_end_is_where_somebody_could_be_asked(monkeypatch: pytest.MonkeyPatch, asks: Any, live: bool) -> None:
    message = {"content": {"allow_stdin": asks}} if asks is not None else None
    shell = SimpleNamespace(get_parent=lambda: message)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    monkeypatch.setattr("tween.app.playground.widget._widget", lambda: lambda sketch: "alive")
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
    assert alive.shapes["source"]["ok"] and alive.footage["valid"]
    assert json.loads(json.dumps(alive.setup))["curves"][0][0] == "convex"
    assert alive.sketch.morph is not None


def test_a_stroke_is_answered(alive: Any) -> None:
    alive.source = {"stroke": eight().tolist()}
    assert alive.shapes["source"]["words"].startswith("Bounds no disk")
    assert alive.footage["frames"] == []
    alive.set_trait("source", {"stroke": circle().tolist()})
    assert alive.shapes["source"]["ok"] and alive.footage["valid"]


def test_an_answer_is_sent_even_if_it_is_the_same(alive: Any) -> None:
    seen = []
    alive.observe(lambda change: seen.append(change.new), names=["footage", "file"])
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
    alive.observe(lambda change: seen.append(change.name), names=["shapes", "footage"])
    alive.source = {"name": "ess"}
    alive.options = {"path": "linear"}
    with alive.hold_trait_notifications():  # as one message from the browser does
        alive.source = {"name": "ell"}
        alive.options = {"path": "slide"}
    assert seen == ["shapes", "move", "footage", "move", "footage", "shapes", "move", "footage"]


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


def test_a_file_that_is_handed_in_is_offered(alive: Any) -> None:
    alive.upload = {"which": "target", "name": "a.csv", "data": b"0,0\n2,0\n0,2\n", "asked": 1}
    assert (alive.uploads["chosen"], alive.uploads["asked"]) == ("a.csv", 1)
    alive.target = {"name": "a.csv"}
    assert alive.shapes["target"]["ok"] and alive.footage["valid"]


def test_on_a_page_it_is_there_before_its_first_morph(tmp_path: Path) -> None:
    pytest.importorskip("anywidget", reason="the widget needs the extra play")
    write_curve(tmp_path / "curve.npz", gallery.letter("e"))
    shown = widget.on_page(str(tmp_path / "curve.npz"), tmp_path)
    assert shown.shapes == shown.footage == {} and shown.source == {"name": "given"}
    shown.options = shown.options | {"asked": 1}
    assert shown.footage["valid"] and len(shown.sketch.source.curve) == 62
    shown.wish = {"kind": "csv", "where": "folder", "asked": 1}
    assert (tmp_path / "tween_curve.csv").exists()


def test_a_notebook_that_holds_the_widget_holds_text_too(alive: Any) -> None:
    data, _ = alive._repr_mimebundle_()
    assert "draw a closed curve" in data["text/plain"]

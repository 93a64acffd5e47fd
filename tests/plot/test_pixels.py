"""Frames in pixels, against winding numbers counted pixel by pixel."""

from dataclasses import replace

import numpy as np
import pytest

from tween import Morph, morph, paper_morph, triangulate
from tween.gallery import curve, pair
from tween.plot import pixels
from tween.plot.film import Film, record
from tween.plot.look import OPACITY
from tween.plot.pixels import picture
from tween.plot.shapes import winding_number


def film_of(name: str, **options) -> Film:
    T = triangulate(curve(name))
    return record(morph(T, T.on_disk()), frames=3, **options)


@pytest.fixture
def areas_only(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw no lines."""
    monkeypatch.setattr(pixels, "_EDGE_OPACITY", 0.0)
    blank = pixels._lines
    monkeypatch.setattr(pixels, "_lines", lambda *args: blank(args[0], [], 1.0))


@pytest.mark.parametrize("name", ["horseshoe", "winding_3", "five_disks"])
def test_a_filled_disk_is_as_dark_as_the_curve_winds_often(name: str, areas_only: None) -> None:
    shown = film_of(name, size=30, style="fill")
    for k in (0, 1):
        drawn = np.asarray(picture(shown, k), dtype=float)
        expected = np.zeros_like(drawn)
        for y, x in np.ndindex(shown.height, shown.width):
            for dy, dx in ((0.25, 0.25), (0.25, 0.75), (0.75, 0.25), (0.75, 0.75)):
                layers = abs(winding_number(shown.shapes[k], np.array([x + dx, y + dy])))
                bare = (1 - OPACITY) ** layers
                expected[y, x] += (bare * 255 + (1 - bare) * shown.tints[k]) / 4
        assert np.abs(drawn - expected).max() <= 0.5 + 1e-9


def test_triangles_tile_the_disk_without_seams(areas_only: None) -> None:
    shown = film_of("five_disks", size=120)
    one_color = replace(shown, colors=np.broadcast_to(shown.tints[0], shown.colors.shape))
    assert picture(one_color, 0).tobytes() == picture(replace(shown, style="fill"), 0).tobytes()


def test_the_order_of_the_triangles_does_not_matter() -> None:
    shown = film_of("winding_3", size=80)
    backwards = replace(shown, triangles=shown.triangles[:, ::-1], colors=shown.colors[::-1])
    assert picture(shown, 0).tobytes() == picture(backwards, 0).tobytes()


@pytest.mark.parametrize("style", ["triangles", "outline", "fill"])
def test_the_corners_of_the_canvas_keep_the_background_and_the_outline_is_there(style) -> None:
    shown = film_of("ess", size=(90, 70), style=style, background="#fff7e0")
    drawn = np.asarray(picture(shown, 2))
    assert drawn.shape == (70, 90, 3)
    assert (drawn[[0, 0, -1, -1], [0, -1, 0, -1]] == shown.background).all()
    line = shown.tints[2] if style == "outline" else shown.ink
    assert (np.abs(drawn - np.array(line)).max(axis=2) < 8).any()


def test_flips_on_the_way_are_drawn() -> None:
    m: Morph = paper_morph(*pair("comb_to_winding"))
    shown = record(m, frames=8, size=100)
    kept = replace(shown, triangles=np.broadcast_to(shown.triangles[0], shown.triangles.shape))
    assert picture(shown, 0).tobytes() == picture(kept, 0).tobytes()
    assert picture(shown, 7).tobytes() != picture(kept, 7).tobytes()


def test_what_lies_beyond_the_canvas_is_cut_off() -> None:
    shown = film_of("ess", size=60)
    picture(replace(shown, shapes=3 * shown.shapes - 60), 0)

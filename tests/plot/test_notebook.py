"""The slider of notebooks: a film strip for every reader, and every shape for whoever pulls it."""

import base64
import io
from typing import Any

import numpy as np
import pytest
from PIL import Image

from tween import Morph, morph, paper_morph, triangulate
from tween.gallery import curve, pair
from tween.plot import pixels
from tween.plot.film import record
from tween.plot.notebook import slider

WIDGET = "application/vnd.jupyter.widget-view+json"


@pytest.fixture(scope="module")
def plain() -> Morph:
    T = triangulate(curve("ess"))
    return morph(T, T.on_disk())


@pytest.fixture(scope="module")
def flipping() -> Morph:
    return paper_morph(*pair("arrow_to_horseshoe"))


def opened(png: bytes) -> np.ndarray[Any, Any]:
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"))


def test_where_nobody_can_pull_it_there_is_the_strip_alone(plain: Morph) -> None:
    shown = slider(plain)._repr_mimebundle_()
    assert set(shown) == {"text/plain", "image/png"}
    height, width = opened(base64.b64decode(shown["image/png"])).shape[:2]
    assert width > 2 * height


def test_what_is_stored_is_the_same_each_time(plain: Morph) -> None:
    assert slider(plain)._repr_mimebundle_() == slider(plain)._repr_mimebundle_()


def test_a_strip_of_more_shapes_shows_more(plain: Morph) -> None:
    few, many = (opened(slider(plain, strip=count).strip()) for count in (2, 9))
    assert (many < 128).sum() / many.size != (few < 128).sum() / few.size
    assert "in 9 shapes" in repr(slider(plain, strip=9))


def test_a_live_one_adds_a_widget_to_the_strip(plain: Morph) -> None:
    pytest.importorskip("ipywidgets")
    shown = slider(plain, live=True)._repr_mimebundle_()
    assert set(shown) == {"text/plain", "image/png", WIDGET}


def test_pulling_shows_the_shape_of_that_time(flipping: Morph) -> None:
    pytest.importorskip("ipywidgets")
    shown = slider(flipping, shapes=5, size=120, live=True)
    picture, controls = shown.widget.children
    moment, caption = controls.children[1:]
    film = record(flipping, frames=5, size=120, ease=False, there_and_back=False)
    for k in (4, 2, 0):
        moment.value = k
        assert np.array_equal(opened(picture.value), np.asarray(pixels.picture(film, k)))
        done = sum(event.time <= k / 4 for event in flipping.events) if k else 0
        assert caption.value == f"{k / 4:.2f}, {done} of {len(flipping.events)} flips done"


def test_a_caption_without_flips_is_the_time(plain: Morph) -> None:
    assert [slider(plain, shapes=3).caption(k) for k in range(3)] == ["0.00", "0.50", "1.00"]


def test_a_strip_of_one_shape_is_refused(plain: Morph) -> None:
    with pytest.raises(ValueError, match="strip is 1, expected 2 shapes at least"):
        slider(plain, strip=1)

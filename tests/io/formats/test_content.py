"""Things are counted in words."""

import numpy as np
import pytest

from tween.io.formats.content import Outline, Pen, counted


@pytest.mark.parametrize(
    ("number", "words"), [(0, "0 empty shapes"), (1, "1 empty shape"), (2, "2 empty shapes"), (21, "21 empty shapes")]
)
def test_one_thing_is_singular(number: int, words: str) -> None:
    assert counted(number, "empty shape") == words


def test_an_outline_is_the_whole_and_has_the_pen_that_svg_starts_from() -> None:
    outline = Outline("a", np.zeros((2, 2)))
    assert (outline.part, outline.pen) == ("", Pen(0.0, "butt", "miter", 4.0, False))

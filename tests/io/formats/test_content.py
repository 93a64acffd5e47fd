"""An outline by itself is the whole, drawn with the pen of the SVG standard."""

import numpy as np

from tween.io.formats.content import Outline, Pen


def test_an_outline_is_the_whole_and_has_the_pen_that_svg_starts_from() -> None:
    outline = Outline("a", np.zeros((2, 2)))
    assert (outline.part, outline.pen) == ("", Pen(0.0, "butt", "miter", 4.0, False))

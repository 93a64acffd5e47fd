"""How films look: colours that were chosen, and the others; options that are none."""

from typing import Any

import pytest

from tween import Morph, morph, triangulate
from tween.gallery import curve
from tween.plot.film import record


@pytest.fixture(scope="module")
def plain() -> Morph:
    T = triangulate(curve("ess"))
    return morph(T, T.on_disk())


def test_colours_that_are_chosen_are_those_of_the_disk_and_its_outline(plain: Morph) -> None:
    shown = record(plain, frames=3, style="fill", fill="#10203080", stroke="red", width=7)
    assert (shown.tints == [0x10, 0x20, 0x30]).all() and (shown.colors == [0x10, 0x20, 0x30]).all()
    assert (shown.ink, shown.line, shown.opacity) == ((255, 0, 0), 7, 128 / 255)
    assert record(plain, frames=3, fill="black").opacity == 1
    assert record(plain, frames=3, stroke="none").line == 0
    assert (record(plain, frames=3, style="outline", stroke="red").tints == [255, 0, 0]).all()


def test_outlines_are_light_on_dark_backgrounds(plain: Morph) -> None:
    for background, light in (("white", False), ("#fff7e0", False), ("black", True), ("#102040", True)):
        assert (record(plain, frames=2, background=background).ink[0] > 128) is light


@pytest.mark.parametrize(
    ("option", "value", "expected"),
    [
        ("frames", 1, "at least 2"),
        ("frames", 2.0, "a whole number"),
        ("frames", True, "a whole number"),
        ("fps", 0, "from 0.1 to 100"),
        ("fps", 101, "from 0.1 to 100"),
        ("fps", float("nan"), "from 0.1 to 100"),
        ("fps", "fast", "from 0.1 to 100"),
        ("size", 15, "from 16 to 2048"),
        ("size", 5000, "from 16 to 2048"),
        ("size", (100, 0), "from 16 to 2048"),
        ("size", (100, 100, 100), "or two of them"),
        ("size", 99.5, "a whole number"),
        ("style", "sketch", "one of triangles, outline, fill"),
        ("hold", -0.1, "from 0 to 30"),
        ("hold", float("inf"), "from 0 to 30"),
        ("background", "whitish", "a colour such as"),
        ("background", "none", "a colour such as"),
        ("background", "#ff000080", "a colour such as"),
        ("fill", "reddish", "a colour such as"),
        ("fill", "none", "a colour such as"),
        ("stroke", 3, "a colour such as"),
        ("width", 0, "pixels, up to 100"),
        ("width", "thick", "pixels, up to 100"),
        ("ease", "bounce", "linear, smooth"),
    ],
)
def test_an_option_that_is_none_is_named_with_what_was_expected(
    plain: Morph, option: str, value: Any, expected: str
) -> None:
    with pytest.raises(ValueError, match=rf"^{option} is .*, expected .*{expected}"):
        record(plain, **{option: value})

"""Colours are those of matplotlib, of each other distinct, also in print without colour."""

from itertools import combinations

import pytest
from matplotlib.colors import to_hex, to_rgb

from tween import colors

EVERY = {name: value for name, value in vars(colors).items() if name.isupper()}


@pytest.mark.parametrize("name", EVERY)
def test_files_show_the_colour_that_figures_show(name: str) -> None:
    assert colors.as_hex(EVERY[name]).lower() == to_hex(EVERY[name])


@pytest.mark.parametrize("level", [i / 20 for i in range(21)])
def test_a_grey_level_is_that_of_matplotlib(level: float) -> None:
    found, wanted = (to_rgb(c) for c in (colors.as_hex(str(level)), str(level)))
    assert found == pytest.approx(wanted, abs=0.5001 / 255)


def test_no_two_ideas_share_a_colour() -> None:
    assert len(EVERY) >= 8
    assert len(set(EVERY.values())) == len(EVERY)


def test_source_and_target_and_ink_are_told_apart_in_grey() -> None:
    greys = [
        0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in map(to_rgb, (colors.SOURCE, colors.TARGET, colors.INK))
    ]
    assert min(abs(a - b) for a, b in combinations(greys, 2)) > 0.15

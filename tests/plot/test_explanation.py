"""Pictures of explanations show what the explanation names."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

from tween import decompose, gallery, plot

EIGHT = [(0, 0), (4, 4), (4, 0), (0, 3)]
BAND = [(0, -1), (3, 1), (6, -1), (6, 1), (3, -1), (0, 1)]


@pytest.mark.parametrize(("points", "regions", "crossings"), [(EIGHT, 1, 1), (BAND, 1, 2)])
def test_every_crossing_and_every_negative_region_is_drawn(
    points: list[tuple[int, int]], regions: int, crossings: int
) -> None:
    explanation = decompose(points).explain()
    ax = plot.draw_explanation(explanation, Figure().add_subplot())
    dots, rings = (collection.get_offsets() for collection in ax.collections[-2:])
    np.testing.assert_array_equal(dots, explanation.places)
    assert (len(dots), len(rings)) == (crossings, len(explanation.tiny))
    assert len(ax.patches) == regions + 1  # and the mended curve
    assert explanation.suggestions[0].text in ax.get_title()


def test_a_curve_that_bounds_a_disk_is_drawn_without_faults() -> None:
    ax = plot.draw_explanation(decompose(gallery.curve("loop")).explain(), Figure().add_subplot())
    assert ax.get_title() == "bounds an immersed disk"
    assert not ax.patches


def test_the_current_axes_are_the_default() -> None:
    figure, ax = plt.subplots()
    assert plot.draw_explanation(decompose(EIGHT).explain()) is ax
    plt.close(figure)

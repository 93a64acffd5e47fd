"""Pictures of explanations show what the explanation names."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.figure import Figure

from tween import decompose, gallery, plot
from tween.errors import FileError

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


@pytest.mark.parametrize(("suffix", "start"), [(".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF")])
def test_a_picture_in_a_file_is_the_same_each_time(tmp_path: Path, suffix: str, start: bytes) -> None:
    explanation = decompose(BAND).explain()
    paths = [plot.save_explanation(tmp_path / f"{i}{suffix}", explanation) for i in range(2)]
    assert paths[0].read_bytes().startswith(start)
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_a_file_of_another_kind_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"expected one of .pdf, .png, .svg"):
        plot.save_explanation(tmp_path / "why.gif", decompose(BAND).explain())

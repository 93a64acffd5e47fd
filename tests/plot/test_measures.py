"""Pictures of measures say what was measured."""

from itertools import pairwise

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from tween import Morph, area_matrix, area_rank, gallery, paper_morph, triangulate
from tween.colors import FAILURE, INK
from tween.plot.measures import draw_angle_sums, draw_area_matrix, draw_singular_values, draw_winding


@pytest.fixture
def ax() -> Axes:
    return Figure().add_subplot()


def to_disk(name: str, **options) -> Morph:
    T = triangulate(gallery.curve(name))
    return paper_morph(T, T.on_disk(), **options)


def labels(ax: Axes) -> list[str]:
    return sorted(text.get_text() for text in ax.texts)


@pytest.mark.parametrize("draw", [draw_winding, draw_area_matrix, draw_singular_values, draw_angle_sums])
def test_a_picture_goes_into_the_axes_given_or_the_current_ones(draw, ax: Axes) -> None:
    m = to_disk("ell")
    shape = m.source if draw is draw_winding else m
    assert draw(shape, ax) is ax
    current = plt.figure().add_subplot()
    try:
        assert draw(shape) is current
        current.figure.draw_without_rendering()
    finally:
        plt.close()


# Winding numbers


@pytest.mark.parametrize(
    ("name", "numbers"),
    [("convex", {"1"}), ("horseshoe", {"0", "1", "2"}), ("winding_3", {"0", "1", "2", "3"})],
)
def test_every_winding_number_is_written(name: str, numbers: set[str], ax: Axes) -> None:
    draw_winding(gallery.curve(name), ax)
    assert set(labels(ax)) == numbers


def test_one_winding_number_has_one_shade_and_more_is_darker(ax: Axes) -> None:
    draw_winding(gallery.curve("five_disks"), ax)
    shades: dict[str, set[str]] = {}
    for text in ax.texts:
        around = (p for p in ax.patches if p.get_path().contains_point(text.xy))
        patch = min(around, key=lambda p: np.ptp(p.get_path().vertices, axis=0).prod())
        shades.setdefault(text.get_text(), set()).add(to_hex(patch.get_facecolor()))
    assert {number: len(found) for number, found in shades.items()} == {"1": 1, "2": 1, "3": 1, "4": 1}
    brightness = [sum(bytes.fromhex(shades[number].pop()[1:])) for number in "1234"]
    assert all(a > b for a, b in pairwise(brightness))


def test_what_is_wound_about_clockwise_has_the_colour_of_failure(ax: Axes) -> None:
    draw_winding([[0, 0], [2, 2], [2, 0], [0, 2]], ax)
    assert labels(ax) == ["-1", "1"]
    red = [p for p in ax.patches if p.get_facecolor()[0] > p.get_facecolor()[2]]
    assert len(red) == 1


def test_winding_numbers_can_be_left_out(ax: Axes) -> None:
    assert not draw_winding(gallery.curve("loop"), ax, labels=False).texts


# Areas


def test_the_heat_map_shows_the_area_matrix(ax: Axes) -> None:
    m = to_disk("ess")
    draw_area_matrix(m, ax, frames=12)
    np.testing.assert_array_equal(ax.images[0].get_array(), area_matrix(m, frames=12))
    other = draw_area_matrix(area_matrix(m, frames=12), Figure().add_subplot())
    np.testing.assert_array_equal(other.images[0].get_array(), ax.images[0].get_array())
    assert len(ax.figure.axes) == 2, "a colour bar"


@pytest.mark.parametrize("draw", [draw_area_matrix, draw_singular_values])
@pytest.mark.parametrize("bad", [np.ones(3), np.zeros((2, 3)), np.full((2, 3), np.nan)])
def test_what_is_no_matrix_of_areas_is_refused(draw, bad: np.ndarray, ax: Axes) -> None:
    with pytest.raises(ValueError, match="expected a Morph or a matrix of areas"):
        draw(bad, ax)


def test_the_singular_values_come_with_the_ranks(ax: Axes) -> None:
    m = to_disk("ess")
    draw_singular_values(m, ax)
    A = area_matrix(m)
    assert labels(ax) == sorted(f"rank {area_rank(A, r)} at {r:.0e}" for r in (1e-4, 1e-6, 1e-9))
    k, shares = ax.lines[0].get_data()
    assert k[0] == 1 and shares[0] == 1
    assert (shares > 1e-6).sum() == area_rank(A, 1e-6)


# Sums of angles


def test_the_largest_sum_is_named_and_red_where_it_is_too_large(ax: Axes) -> None:
    draw_angle_sums(paper_morph(*gallery.fan(), path="linear"), ax)
    (text,) = ax.texts
    assert text.get_text().startswith("vertex 0: 2.") and text.get_color() == FAILURE
    safe = draw_angle_sums(to_disk("ess"), Figure().add_subplot())
    assert safe.texts[0].get_color() == INK


def test_red_shows_only_beyond_the_line_of_two_pi(ax: Axes) -> None:
    draw_angle_sums(paper_morph(*gallery.fan(), path="linear"), ax)
    canvas = FigureCanvasAgg(ax.figure)
    canvas.draw()
    drawn = np.asarray(canvas.buffer_rgba())[..., :3].astype(int)
    red = (drawn[..., 0] > 150) & (drawn[..., 1] < 90) & (drawn[..., 2] < 90)
    line = drawn.shape[0] - ax.transData.transform((0.0, 2 * np.pi))[1]
    assert red[: int(line) - 3].any()
    assert not red[int(line) + 4 :].any()

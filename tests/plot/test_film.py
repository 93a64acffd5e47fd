"""Films: timing, framing, colours, triangles that keep their rows."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb

from tween import Morph, morph, paper_morph, triangulate
from tween.colors import SOURCE, TARGET
from tween.easing import as_ease
from tween.gallery import curve, pair
from tween.plot.film import Film, record
from tween.plot.shapes import identity_colors


@pytest.fixture(scope="module")
def flipping() -> Morph:
    return paper_morph(*pair("comb_to_winding"), order="partial")


@pytest.fixture(scope="module")
def plain() -> Morph:
    T = triangulate(curve("ess"))
    return morph(T, T.on_disk())


def test_shapes_go_from_the_source_to_the_target_and_back(plain: Morph) -> None:
    shown = record(plain, frames=5)
    assert shown.times[0] == 0 and shown.times[-1] == 1
    assert shown.numbers.tolist() == [0, 1, 2, 3, 4, 3, 2, 1, 0]
    assert record(plain, frames=5, there_and_back=False).numbers.tolist() == [0, 1, 2, 3, 4]


def test_source_and_target_rest_once_each(plain: Morph) -> None:
    shown = record(plain, frames=4, fps=20, hold=0.5)
    np.testing.assert_allclose(shown.seconds, [0.55, 0.05, 0.05, 0.55, 0.05, 0.05, 0.05])
    once = record(plain, frames=4, fps=20, hold=0.5, there_and_back=False)
    np.testing.assert_allclose(once.seconds, [0.55, 0.05, 0.05, 0.55])


def test_with_ease_the_motion_starts_and_ends_slowly(plain: Morph) -> None:
    even, eased = (np.diff(record(plain, frames=21, ease=ease).times) for ease in (False, True))
    np.testing.assert_allclose(even, 0.05)
    assert eased[0] < 0.01 and eased[-1] < 0.01 and eased[10] > 0.07
    assert (eased > 0).all()


@pytest.mark.parametrize("size", [100, 333, (120, 80), (80, 120)])
def test_all_shapes_are_on_the_canvas_and_fill_it(flipping: Morph, size: Any) -> None:
    shown = record(flipping, frames=12, size=size)
    low, high = shown.shapes.min(axis=(0, 1)), shown.shapes.max(axis=(0, 1))
    sides = np.array([shown.width, shown.height])
    margin = 0.04 * sides.max()
    assert (low >= margin - 1e-9).all() and (high <= sides - margin + 1e-9).all()
    assert np.min(sides - 2 * margin - (high - low)) < 1e-9
    assert (shown.width, shown.height) == size if isinstance(size, tuple) else sides.max() == size


def test_all_shapes_have_one_scale(flipping: Morph) -> None:
    shown = record(flipping, frames=9)
    real, seen = (np.ptp(shapes, axis=1) for shapes in (flipping.at(shown.times), shown.shapes))
    np.testing.assert_allclose(seen / real, seen[0, 0] / real[0, 0])


def test_up_in_the_plane_is_up_on_the_canvas(plain: Morph) -> None:
    shown = record(plain, frames=2)
    highest = plain.source.points[:, 1].argmax()
    assert shown.shapes[0, highest, 1] == shown.shapes[0, :, 1].min()


def test_triangles_keep_their_rows_and_a_flip_changes_one_corner_in_each_of_two(flipping: Morph) -> None:
    times = [event.time for event in flipping.events]
    assert len(times) > 100
    shown = record(flipping, frames=4000, ease=False)
    one_flip = 0
    for (before, after), flips in zip(pairwise(shown.triangles), np.diff(shown.flips), strict=True):
        changes = (before != after).sum(axis=1)
        assert (changes > 0).sum() <= 2 * flips
        if flips == 1:
            one_flip += 1
            assert sorted(changes[changes > 0]) == [1, 1]
    assert one_flip, "most happen in groups"
    assert shown.flips[0] == 0 and shown.flips[-1] == len(times)


def test_triangles_are_those_in_force(flipping: Morph) -> None:
    shown = record(flipping, frames=30)
    for t, triangles in zip(shown.times, shown.triangles, strict=True):
        expected = flipping.triangles_at(float(t))
        assert (np.sort(triangles, axis=1) == np.sort(expected, axis=1)).all()


def test_triangles_have_the_colours_of_their_identity_and_shapes_go_from_the_sources_to_the_targets(
    plain: Morph,
) -> None:
    shown = record(plain, frames=3)
    np.testing.assert_array_equal(shown.colors, np.rint(255 * identity_colors(plain.source)[:, :3]))
    ends = [np.rint(255 * np.array(to_rgb(color))).tolist() for color in (SOURCE, TARGET)]
    assert [shown.tints[0].tolist(), shown.tints[-1].tolist()] == ends


def test_only_a_morph_has_a_film(plain: Morph) -> None:
    with pytest.raises(ValueError, match=r"m is <class .*ndarray.*>, expected a Morph"):
        record(plain.frames(3))  # type: ignore[arg-type]


def test_one_triangle_is_enough() -> None:
    shown: Film = record(morph([[0, 0], [4, 0], [0, 3]], [[0, 0], [1, 0], [1, 1]]), frames=3, size=64)
    assert shown.shapes.shape == (3, 3, 2) and shown.triangles.shape == (3, 1, 3)


def test_an_ease_of_css_says_when_shapes_are_shown(plain: Morph) -> None:
    shown = record(plain, frames=11, ease="cubic-bezier(0.42, 0, 1, 1)")
    np.testing.assert_allclose(shown.times, as_ease("ease-in").at(np.linspace(0, 1, 11)))


def test_flips_come_when_they_do_by_any_clock(flipping: Morph) -> None:
    shown = record(flipping, frames=30, ease="ease")
    for t, triangles in zip(shown.times, shown.triangles, strict=True):
        assert (np.sort(triangles, axis=1) == np.sort(flipping.triangles_at(float(t)), axis=1)).all()

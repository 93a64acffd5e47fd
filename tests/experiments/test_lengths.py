"""Lengths along a morph: taken apart and put together again, and what slide keeps and linear does not."""

import numpy as np
import pytest

from experiments.lengths import beyond, of_diagonals, over_base, shrinkage, shrinkage_by_depth, take_apart
from tween import Morph, paper_morph, triangulate
from tween.gallery import curve, pair
from tween.geometry.dual_tree import disk_center, rooted

TIMES = np.linspace(0, 1, 11)


@pytest.fixture(scope="module")
def slides() -> Morph:
    return paper_morph(*pair("e_to_l"), path="slide")


@pytest.fixture(scope="module")
def straight() -> Morph:
    return paper_morph(*pair("e_to_l"), path="linear")


def test_what_is_taken_apart_can_be_put_together_again(slides: Morph) -> None:
    z, propagates = take_apart(slides, TIMES)
    T, tree = slides.source, rooted(slides.source, disk_center(slides.source, slides.target))
    given = slides.at(TIMES) @ np.array([1, 1j])
    slots = (tree.base[tree.order, None] + np.arange(3)) % 3
    corners = np.take_along_axis(T.triangles[tree.order], slots, axis=1)
    built = np.full_like(given, np.nan)
    built[:, corners[0, :2]] = given[:, corners[0, :2]]
    for (a, b, c), third in zip(corners, z.T, strict=True):
        built[:, c] = built[:, a] + third * (built[:, b] - built[:, a])
    assert np.abs(built - given).max() < 1e-9
    assert propagates.sum() == len(T.triangles) - 1 - (T.twin.ravel()[tree.base[tree.order[0]]] >= 0)


def test_linear_moves_third_vertices_along_straight_lines(straight: Morph) -> None:
    z, _ = take_apart(straight, TIMES)
    assert np.abs(z - (z[0] + TIMES[:, None] * (z[-1] - z[0]))).max() < 1e-9


def test_slide_keeps_lengths_over_their_base_between_their_ends_and_linear_does_not(
    slides: Morph, straight: Morph
) -> None:
    for m, kept in ((slides, True), (straight, False)):
        above, below = beyond(over_base(m, TIMES))
        assert above.max() < 1 + 1e-9
        assert (below.max() < 1 + 1e-9) == kept


def test_factors_are_taken_from_the_larger_and_the_smaller_end() -> None:
    above, below = beyond(np.array([[1.0, 4.0], [4.0, 1.0], [2.0, 2.0]]))
    assert above.tolist() == [2, 1]
    assert below.tolist() == [1, 2]


def test_lengths_of_diagonals_are_distances(slides: Morph) -> None:
    a, b = slides.at([0.3])[0][slides.source.diagonals[5]]
    assert of_diagonals(slides, [0.3])[0, 5] == pytest.approx(np.linalg.norm(b - a))


def test_shrinkage_is_that_of_the_ends_at_least(straight: Morph) -> None:
    found = shrinkage(straight, TIMES)
    assert found.shape == (11, len(straight.source) - 3)
    assert found.min() == 1
    assert found.max(axis=0) == pytest.approx(beyond(of_diagonals(straight, TIMES))[1])


def test_dips_multiply_along_the_tree() -> None:
    T = triangulate(curve("winding_3"))
    by_depth = shrinkage_by_depth(paper_morph(T, T.on_disk(), path="linear"), TIMES)
    assert list(by_depth.index) == [0, 1, 2, 3]
    assert by_depth[3] > by_depth[0]

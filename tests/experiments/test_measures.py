"""What the studies measure: ranks by name, places, slides, and the shortcut by which they morph to the disk."""

import numpy as np
import pytest

from experiments.measures import (
    PARAMETERS,
    RANKS,
    areas_to_disk,
    edge_factors,
    hung,
    percentile,
    slid,
    steady_sizes,
    swelling,
    usual_root,
)
from experiments.subjects import shape
from tween import area_matrix, decompose, gallery, morph, remesh, triangulate
from tween.choices import Path


def test_ranks_are_named_by_their_tolerances() -> None:
    assert [float(name.removeprefix("AR_")) for name in RANKS] == PARAMETERS["tolerances"]


def test_a_percentile_counts_ties_half() -> None:
    assert percentile(2.0, np.array([1.0, 2.0, 2.0, 3.0])) == 0.5
    assert percentile(0.0, np.array([1.0, 2.0])) == 0.0
    assert percentile(9.0, np.array([1.0, 2.0])) == 1.0


def test_swelling_is_one_where_the_larger_end_is_the_largest() -> None:
    A = np.array([[1.0, 2.0, 3.0], [1.0, 1.0, 1.0]])
    assert swelling(A) == pytest.approx(1)
    assert swelling(A[:, [0, 2, 1]]) == pytest.approx(4 / 3)


def test_steady_sizes_make_the_whole_area_change_linearly() -> None:
    A = np.array([[1.0, 9.0, 3.0], [1.0, 2.0, 1.0]])
    np.testing.assert_allclose((A * steady_sizes(A) ** 2).sum(axis=0), [2.0, 3.0, 4.0])
    assert swelling(A * steady_sizes(A) ** 2) == pytest.approx(1)


def test_edges_leave_their_range_by_a_factor_up_and_a_factor_down() -> None:
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float64)
    assert edge_factors(np.stack([square, 1.5 * square, 2 * square])) == (1.0, 1.0)
    assert edge_factors(np.stack([square, 3 * square, 2 * square])) == (1.5, 1.0)
    assert edge_factors(np.stack([square, square / 4, square])) == (1.0, 0.25)
    assert edge_factors(np.stack([square, 3 * square, square]), np.array([1, 1 / 3, 1])) == pytest.approx((1.0, 1.0))


@pytest.mark.parametrize("path", ["linear", "slide", "angle"])
@pytest.mark.parametrize("name", ["ell", "pretzel", "letter R"])
def test_the_known_correspondence_gives_what_the_search_for_it_gives(name: str, path: Path) -> None:
    d = decompose(shape(name))
    T = [remesh(d.arbitrary()), *d.sample(np.random.default_rng(1), 4)]
    disk = T[0].on_disk().points
    for t in T:
        expected = area_matrix(morph(t, t.moved(disk), path, guarantee=False, placement="root"), 40)
        assert np.array_equal(areas_to_disk(t, disk, path, 40), expected)
        assert np.array_equal(areas_to_disk(t, disk, path, 40, usual_root(t, disk)), expected)


def test_slides_are_counted_as_the_path_makes_them() -> None:
    T = remesh(decompose(gallery.curve("horseshoe")).arbitrary())
    assert 0 < slid(T, T.on_disk().points).any(axis=1).sum() < len(T.triangles)
    assert not slid(T, T.points).any()


def test_every_diagonal_is_a_propagation_edge_once() -> None:
    T = triangulate(gallery.curve("horseshoe"))
    corners, propagates = hung(T, T.on_disk().points)
    np.testing.assert_array_equal(np.sort(corners, axis=1), np.sort(T.triangles, axis=1))
    across_the_base_of_the_root = 1
    assert propagates.sum() in (len(T.diagonals) - across_the_base_of_the_root, len(T.diagonals))

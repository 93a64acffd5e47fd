"""Area matrix, its rank, and the variance of frame differences."""

from fractions import Fraction
from itertools import pairwise
from math import sqrt

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tween import area_matrix, area_rank, certify, frame_variance, paper_morph, triangulate
from tween.choices import PATHS
from tween.gallery import curve, pair
from tween.measuring.metrics import angle_sums, rank_of

CURVES = ("arrow", "horseshoe", "two_loops", "five_disks", "spiral_1")


def to_disk(name: str, path="slide"):
    T = triangulate(curve(name))
    return paper_morph(T, T.on_disk(), path=path)


@pytest.mark.parametrize("name", CURVES)
def test_the_area_matrix_has_a_row_for_each_triangle_and_a_column_for_each_frame(name: str) -> None:
    m = to_disk(name)
    A, frames = area_matrix(m, frames=9), m.frames(9)
    assert A.shape == (len(m.source) - 2, 9)
    whole = oracle.area(m.source.points)
    for column in (0, 4, 8):
        exact = [float(oracle.area(frames[column][t]) / whole) for t in m.source.triangles]
        np.testing.assert_allclose(A[:, column], exact, rtol=1e-9)
    sums = [float(oracle.area(frame) / whole) for frame in frames]
    np.testing.assert_allclose(A.sum(axis=0), sums, rtol=1e-12)
    assert A[:, 0].sum() == pytest.approx(1, abs=1e-12)
    assert (A > 0).all()


def test_there_are_a_hundred_frames_unless_asked_otherwise() -> None:
    assert area_matrix(to_disk("arrow")).shape[1] == 100


@pytest.mark.parametrize("rank", [1, 2, 5])
def test_the_rank_of_a_constructed_matrix_is_found(rank: int) -> None:
    rng = np.random.default_rng(rank)
    A = rng.random((30, rank)) @ rng.random((rank, 100))
    assert area_rank(A) == area_rank(A.T) == area_rank(1e9 * A) == rank
    assert area_rank(A + 1e-9 * rng.random(A.shape)) == rank


def test_the_tolerance_is_relative_to_the_largest_singular_value() -> None:
    values = np.array([1e3, 1.0, 1e-3, 1e-6])
    A = np.diag(values)
    assert [area_rank(A, rtol) for rtol in (0.5, 2e-3, 0.9e-3, 2e-6, 0.9e-6, 1e-12)] == [1, 1, 2, 2, 3, 4]
    assert [rank_of(values, rtol) for rtol in (0.5, 0.9e-3)] == [1, 2]


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("name", CURVES)
def test_the_headline_rank_does_not_move_with_the_last_digits_of_the_areas(name: str, path) -> None:
    A = area_matrix(to_disk(name, path))
    rng = np.random.default_rng(9)
    perturbed = [A * (1 + 1e-12 * rng.uniform(-1, 1, A.shape)) for _ in range(5)]
    assert {area_rank(P) for P in perturbed} == {area_rank(A)}
    assert 2 <= area_rank(A) < min(A.shape)


def test_at_machine_precision_the_rank_does_move() -> None:
    A = area_matrix(to_disk("horseshoe", "linear"))
    noise = 1e-12 * np.random.default_rng(9).uniform(-1, 1, A.shape)
    assert area_rank(A * (1 + noise), rtol=1e-15) > area_rank(A, rtol=1e-15)


columns = st.lists(st.lists(st.floats(0, 1), min_size=4, max_size=4), min_size=2, max_size=9)


@given(columns)
def test_the_variance_is_that_of_the_lengths_of_the_steps(frames: list[list[float]]) -> None:
    lengths = [
        Fraction(sqrt(sum((Fraction(y) - Fraction(x)) ** 2 for x, y in zip(a, b, strict=True))))
        for a, b in pairwise(frames)
    ]
    mean = sum(lengths) / len(lengths)
    expected = sum((length - mean) ** 2 for length in lengths) / len(lengths)
    assert frame_variance(np.array(frames).T) == pytest.approx(float(expected), rel=1e-9, abs=1e-15)


def test_steps_of_0_and_1_have_variance_a_quarter() -> None:
    assert frame_variance(np.array([[0.0, 0.0, 1.0], [2.0, 2.0, 2.0]])) == 0.25


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("name", CURVES)
def test_standing_still_has_rank_one_and_no_variance(name: str, path) -> None:
    T = triangulate(curve(name))
    A = area_matrix(paper_morph(T, T, path=path))
    assert area_rank(A) == 1
    assert frame_variance(A) < 1e-24
    np.testing.assert_allclose(A, np.tile(A[:, :1], 100), rtol=1e-9)


def test_sums_of_angles_are_those_that_a_certificate_finds() -> None:
    for m in (to_disk("horseshoe"), paper_morph(*pair("comb_to_winding"))):
        times = np.unique([*np.linspace(0, 1, 100), *(event.time for event in m.events)])
        sums, found = angle_sums(m, times), certify(m)
        np.testing.assert_allclose(sums.sum(axis=0), (len(m.source) - 2) * np.pi)
        assert sums.max() <= found.max_angle + 1e-9
        at = angle_sums(m, np.array([found.max_angle_time]))
        assert at[found.max_angle_vertex, 0] == pytest.approx(found.max_angle)


def test_a_flip_changes_no_sum_of_angles() -> None:
    m = paper_morph(*pair("comb_to_winding"))
    t = m.events[5].time
    np.testing.assert_allclose(*angle_sums(m, np.array([np.nextafter(t, 0), t])).T, atol=1e-9)

"""Paths of the third vertex over a base from 0 to 1."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from tween.morphing.compatible.paths import base_angles, slides, third_vertices

PAPER = ("linear", "slide")
PATHS = (*PAPER, "angle", "metric")  # "area" takes the lengths of bases, so it is laid out: see test_morph

TIMES = np.linspace(0, 1, 201)
BOTH_ARCS = (-1 + 1j, 2 + 1j)  # the distances to 0 and to 1 both fall and rise along the segment

apexes = st.builds(complex, st.floats(-4, 5), st.floats(2.0**-6, 4))
edges = st.tuples(st.booleans(), st.booleans())


def along(path: str, z1: complex, z2: complex, propagates=(True, True), times=TIMES) -> NDArray[np.complex128]:
    return third_vertices(path, np.array([z1]), np.array([z2]), np.array([propagates]), np.ones(1), times)[0]


def is_monotone(x: NDArray[np.float64], slack: float = 1e-9) -> bool:
    steps = np.diff(x)
    return bool((steps >= -slack).all() or (steps <= slack).all())


@given(apexes, apexes, edges, st.sampled_from(PATHS))
def test_a_path_leads_from_one_end_to_the_other_above_the_base(z1, z2, propagates, path) -> None:
    z = along(path, z1, z2, propagates)
    np.testing.assert_allclose(z[[0, -1]], [z1, z2], rtol=1e-11)
    assert z.imag.min() > 0
    if path != "angle":
        assert z.imag.min() >= min(z1.imag, z2.imag) * (1 - 1e-9)


@given(apexes, apexes)
def test_along_the_path_of_angles_every_angle_changes_linearly(z1, z2) -> None:
    first, second = (base_angles(np.array([z]))[0] for z in (z1, z2))
    found = base_angles(along("angle", z1, z2))
    np.testing.assert_allclose(found, first + np.outer(TIMES, second - first), atol=1e-9)
    np.testing.assert_allclose(found.sum(axis=1), np.pi)


@given(apexes, apexes, st.floats(0.1, 10))
def test_along_the_path_of_metrics_every_squared_length_changes_linearly(z1, z2, stretch) -> None:
    z = third_vertices("metric", np.array([z1]), np.array([z2]), np.zeros((1, 2), bool), np.array([stretch]), TIMES)[0]
    base = 1 + TIMES * (stretch**2 - 1)
    for squares in (abs(z) ** 2 * base, abs(z - 1) ** 2 * base):
        np.testing.assert_allclose(squares, squares[0] + TIMES * (squares[-1] - squares[0]), rtol=1e-9, atol=1e-9)


@given(apexes, apexes, edges)
def test_slide_keeps_the_lengths_of_propagation_edges_monotone(z1, z2, propagates) -> None:
    z = along("slide", z1, z2, propagates)
    for end, slide in enumerate(propagates):
        if slide:
            assert is_monotone(abs(z - end))


def test_slide_keeps_many_random_lengths_monotone() -> None:
    rng = np.random.default_rng(8)
    z1, z2 = (rng.uniform(-3, 4, 20_000) + 1j * rng.exponential(1, 20_000) for _ in range(2))
    propagates = rng.random((20_000, 2)) < 0.7
    z = third_vertices("slide", z1, z2, propagates, np.ones(len(z1)), np.linspace(0, 1, 41))
    for end in (0, 1):
        steps = np.diff(abs(z - end), axis=1)
        monotone = (steps >= -1e-9).all(axis=1) | (steps <= 1e-9).all(axis=1)
        assert monotone[propagates[:, end]].all()
        assert not monotone[~propagates[:, end]].all()
    assert (z.imag > 0).all()
    assert slides(z1, z2, propagates).all(axis=1).sum() > 100  # both arcs at once are no rarity


@given(apexes, apexes, edges, st.sampled_from(PATHS))
def test_the_way_back_is_the_way_there(z1, z2, propagates, path) -> None:
    np.testing.assert_allclose(along(path, z2, z1, propagates)[::-1], along(path, z1, z2, propagates), atol=1e-9)


@given(apexes, apexes, edges, st.sampled_from(PATHS))
def test_mirror_images_of_a_path_are_paths(z1, z2, propagates, path) -> None:
    mirrored = along(path, 1 - z1.conjugate(), 1 - z2.conjugate(), propagates[::-1])
    np.testing.assert_allclose(1 - mirrored.conj(), along(path, z1, z2, propagates), atol=1e-9)


@given(apexes, apexes, edges, st.sampled_from(PAPER))
def test_a_path_of_the_paper_is_travelled_at_constant_speed(z1, z2, propagates, path) -> None:
    steps = abs(np.diff(along(path, z1, z2, propagates, np.linspace(0, 1, 2001))))
    # A chord is shorter than its arc in second order, and where two pieces meet at an angle once.
    assert np.sort(steps)[10:].min() >= steps.max() * (1 - 1e-3) or steps.max() < 1e-12
    assert steps.sum() >= abs(z2 - z1) * (1 - 1e-9)


@given(apexes, apexes, edges)
def test_slide_is_linear_exactly_where_no_propagation_edge_would_shorten_and_lengthen(z1, z2, propagates) -> None:
    straight = along("linear", z1, z2)
    foot = [((end - z1) * (z2 - z1).conjugate()).real for end in (0, 1)]
    sliding = [p and 0 < f < abs(z2 - z1) ** 2 for p, f in zip(propagates, foot, strict=True)]
    assert slides(np.array([z1]), np.array([z2]), np.array([propagates])).tolist() == [sliding]
    z = along("slide", z1, z2, propagates)
    if not any(sliding):
        np.testing.assert_array_equal(z, straight)
    for end, slide in enumerate(sliding):
        if slide:
            assert abs(z - end).min() >= min(abs(z1 - end), abs(z2 - end)) * (1 - 1e-9)
    np.testing.assert_array_equal(along("slide", z1, z2, (False, False)), straight)


def test_one_arc_runs_at_the_distance_of_the_nearer_end_to_the_exit_of_the_chord() -> None:
    z1, z2 = -1 + 1j, 3 + 1j
    z = along("slide", z1, z2, (True, False), np.linspace(0, 1, 4001))
    on_arc = np.isclose(abs(z), abs(z1), rtol=1e-9)
    exit_of_chord = 1 + 1j
    assert on_arc[0] and not on_arc[-1]
    last = np.flatnonzero(on_arc).max()
    assert abs(z[last] - exit_of_chord) < 2e-3
    np.testing.assert_allclose(z[last + 1 :].imag, 1, atol=1e-9)
    # An arc of a quarter turn about 0, then a straight piece of length 2.
    assert abs(np.diff(z)).sum() == pytest.approx(np.sqrt(2) * np.pi / 2 + 2, rel=1e-5)


def test_both_edges_can_be_non_monotone_and_both_are_kept() -> None:
    z1, z2 = BOTH_ARCS
    assert slides(np.array([z1]), np.array([z2]), np.array([(True, True)])).all()
    straight, z = along("linear", z1, z2), along("slide", z1, z2)
    for end in (0, 1):
        assert not is_monotone(abs(straight - end))
        assert is_monotone(abs(z - end))
    assert z[100] == pytest.approx(0.5 + 1j * np.sqrt(1.75), abs=1e-9)  # where the circles meet
    np.testing.assert_allclose(abs(z[:100]), np.sqrt(2), rtol=1e-9)
    np.testing.assert_allclose(abs(z[101:] - 1), np.sqrt(2), rtol=1e-9)


def test_two_arcs_apart_are_joined_by_a_straight_piece() -> None:
    z = along("slide", -0.2 + 0.3j, 1.2 + 0.3j, times=np.linspace(0, 1, 1001))
    level = np.isclose(z.imag, 0.3, atol=1e-9)
    assert level[500] and not level[250] and not level[750]
    np.testing.assert_allclose([abs(z[250]), abs(z[750] - 1)], abs(z[0]))
    assert is_monotone(abs(z)) and is_monotone(abs(z - 1))


@given(apexes, edges, st.sampled_from(PATHS))
def test_nothing_moves_between_equal_ends(z, propagates, path) -> None:
    np.testing.assert_allclose(along(path, z, z, propagates), np.full(len(TIMES), z), rtol=1e-11)


@given(apexes, apexes, edges)
def test_a_path_does_not_depend_on_which_times_are_asked_for(z1, z2, propagates) -> None:
    few = along("slide", z1, z2, propagates, TIMES[[150, 20]])
    np.testing.assert_array_equal(few, along("slide", z1, z2, propagates)[[150, 20]])


def test_an_unknown_path_is_refused() -> None:
    with pytest.raises(ValueError, match="path is 'spline', expected one of linear, slide, angle, area, metric"):
        along("spline", 1j, 2j)

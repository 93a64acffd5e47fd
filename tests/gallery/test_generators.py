"""Ribbons bound disks or say why not; random disks are triangulated, and their triangles are neither thin nor small."""

import re

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tween import gallery
from tween.errors import CurveError, TriangulationError
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh


def on_grid(points):
    return bool((points / gallery.GRID == np.rint(points / gallery.GRID)).all())


@st.composite
def spines(draw):
    """Paths with edges of length 1 to 2 and turns of up to the drawn angle."""
    sharpest = draw(st.sampled_from([0.3, 1.0, 3.0]))
    turns = draw(st.lists(st.floats(-sharpest, sharpest), max_size=20))
    lengths = draw(st.lists(st.floats(1, 2), min_size=len(turns) + 1, max_size=len(turns) + 1))
    directions = draw(st.floats(0, 6.28)) + np.cumsum([0.0, *turns])
    z = np.append(0, np.cumsum(lengths * np.exp(1j * directions)))
    return np.round(np.stack([z.real, z.imag], axis=1), 9)


def radii(spine):
    """Radius of curvature of every inner vertex, by angles."""
    z = np.diff(spine @ np.array([1, 1j]))
    turn = np.abs(np.angle(z[1:] / z[:-1]))
    return np.minimum(np.abs(z[1:]), np.abs(z[:-1])) / (2 * np.tan(np.maximum(turn, 1e-9) / 2))


@given(spines(), st.floats(0.01, 4), st.integers(0, 4))
def test_a_ribbon_bounds_a_disk_or_names_a_vertex_whose_radius_is_too_small(spine, width, cap):
    try:
        c = gallery.ribbon(spine, width, cap)
    except CurveError as error:
        found = re.match(
            r"spine vertex (\d+): radius of curvature (\S+) is not above half the width, (\S+);", str(error)
        )
        assert found, error
        radius = radii(spine)[int(found[1]) - 1]
        assert radius <= width / 2 * (1 + 1e-9)
        assert float(found[2]) == pytest.approx(radius, rel=1e-2)
        assert float(found[3]) == pytest.approx(width / 2, rel=1e-2)
    else:
        assert len(c) == 2 * len(spine) + 2 * cap
        assert not c.reversed_input
        assert decompose(c)


@given(spines(), st.floats(0.01, 4))
@example(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]), 0.5)
def test_a_ribbon_with_half_its_width_below_all_half_radii_exists(spine, width):
    if width < radii(spine).min(initial=np.inf):
        gallery.ribbon(spine, width)


@given(spines())
def test_a_ribbon_walked_the_other_way_is_the_same_curve(spine):
    width = min(1.0, 0.5 * radii(spine).min(initial=np.inf))
    there, back = gallery.ribbon(spine, width).points, gallery.ribbon(spine[::-1], width).points
    np.testing.assert_allclose(np.roll(back, len(spine), axis=0), there, rtol=0, atol=1e-9)


def test_a_ribbon_scales_with_its_spine():
    spine = np.array([[0, 0], [1, 0], [2, 0.5], [2.5, 1.5]])
    assert np.array_equal(gallery.ribbon(spine / 1024, 0.2 / 1024).points, gallery.ribbon(spine, 0.2).points / 1024)


def test_the_sides_of_a_ribbon_keep_their_distance_around_a_corner():
    c = gallery.ribbon([[0, 0], [4, 0], [4, 4]], 1)
    np.testing.assert_allclose(c.points, [[0, -0.5], [4.5, -0.5], [4.5, 4], [3.5, 4], [3.5, 0.5], [0, 0.5]], atol=1e-12)


def test_a_cap_is_a_half_circle_beyond_the_end():
    c = gallery.ribbon([[0, 0], [4, 0]], 2, cap=3)
    end, start = c.points[2:5], c.points[7:10]
    np.testing.assert_allclose(np.hypot(*(end - [4, 0]).T), 1)
    np.testing.assert_allclose(np.hypot(*start.T), 1)
    assert end[1] == pytest.approx([5, 0])
    assert start[1] == pytest.approx([-1, 0])


def test_a_ribbon_along_a_path_that_crosses_itself_crosses_itself_four_times():
    assert len(gallery.ribbon([[-3, 0], [3, 0], [4, 3], [2, 4], [0, 3], [0, -3]], 0.5).crossings) == 4


@pytest.mark.parametrize(
    ("spine", "width", "message"),
    [
        (
            [[0, 0], [1, 0], [2, 0], [2, 1]],
            2.5,
            "spine vertex 2: radius of curvature 0.5 is not above half the width, 1.25; take a narrower ribbon",
        ),
        ([[0, 0], [1, 0], [0, 0]], 0.1, "spine vertex 1: radius of curvature .*e-.* is not above half the width"),
        ([[0, 0], [1, 0], [1, 0]], 0.1, "spine vertices 1 and 2 are the same point"),
        ([[0, 0], [1, np.nan]], 0.1, "spine vertex 1 is .*expected finite"),
        ([[0, 0]], 0.1, "expected .m, 2. with m >= 2"),
        ([0, 1, 2], 0.1, "expected .m, 2. with m >= 2"),
        ([[0, 0], [1, 0]], 0, "0 wide, expected more than"),
        ([[0, 0], [1, 0]], -1, "-1 wide, expected more than"),
        ([[0, 0], [1, 0]], np.nan, "nan wide, expected more than"),
        ([[0, 0], [1, 0]], 1e-30, "1e-30 wide, expected more than"),
    ],
)
def test_a_ribbon_that_cannot_be_says_why(spine, width, message):
    with pytest.raises(CurveError, match=message):
        gallery.ribbon(spine, width)


@given(st.integers(3, 120), st.integers(0, 2**32 - 1))
def test_a_random_disk_is_a_triangulation_of_a_curve_that_is_recognised(n, seed):
    T = gallery.random_disk(n, np.random.default_rng(seed)).validate()
    assert len(T) == n
    assert on_grid(T.points)
    assert decompose(T)
    remesh(T).validate()


@pytest.mark.parametrize("seed", range(5))
def test_the_triangles_of_a_random_disk_are_neither_thin_nor_small_nor_large(seed):
    T = gallery.random_disk(1000, np.random.default_rng(seed)).validate()
    z = T.points[T.triangles] @ np.array([1, 1j])
    edges = np.roll(z, -1, axis=1) - z
    angles = np.angle(-np.roll(edges, 1, axis=1) / edges)
    assert np.abs(angles).min() > np.radians(14.99)
    assert 0.499 < np.abs(edges).min() <= np.abs(edges).max() < 2.001
    sums = np.zeros(len(T))
    np.add.at(sums, T.triangles, np.abs(angles))
    assert sums.max() < 2 * np.pi - 0.049


def test_random_disks_of_fifty_vertices_nearly_always_overlap_themselves():
    disks = [gallery.random_disk(50, np.random.default_rng(seed)) for seed in range(40)]
    assert sum(len(T.curve.crossings) > 0 for T in disks) >= 36


def test_the_same_seed_grows_the_same_disk_and_another_seed_another():
    first, again, other = (gallery.random_disk(40, np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert np.array_equal(first.points, again.points)
    assert np.array_equal(first.triangles, again.triangles)
    assert not np.array_equal(first.points, other.points)


def test_a_disk_of_two_vertices_is_refused():
    with pytest.raises(TriangulationError, match="2 vertices was asked for, expected at least 3"):
        gallery.random_disk(2, np.random.default_rng(0))

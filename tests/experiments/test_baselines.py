"""The methods to compare with, checked against their definitions by other means."""

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.linalg import polar
from scipy.optimize import minimize
from strategies import disks

from experiments.baselines import BASELINES, as_rigid_as_possible, edge_angle, straight
from tween import Morph, Triangulation, area_matrix, morph, triangulate
from tween.errors import IncompatibleError, TriangulationError
from tween.gallery import curve, pair, random_disk
from tween.gallery.generators import evenly, zigzag

METHODS = list(BASELINES.values())
TIMES = np.array([0.0, 0.1, 0.35, 0.5, 0.8, 1.0])
Points = NDArray[np.float64]

each_method = pytest.mark.parametrize("method", METHODS, ids=list(BASELINES))


def regular(n: int, radius: float = 1.0) -> Points:
    angles = 2 * np.pi * np.arange(n) / n
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def rotation(angle: float) -> Points:
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def lengths(shapes: Points) -> Points:
    edges = np.roll(shapes, -1, axis=-2) - shapes
    return np.hypot(edges[..., 0], edges[..., 1])


def turning_angles(shape: Points) -> Points:
    """Turn at each vertex by the two-argument arc tangent of cross and dot product."""
    before, after = shape - np.roll(shape, 1, axis=0), np.roll(shape, -1, axis=0) - shape
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    return np.arctan2(cross, (before * after).sum(axis=1))


def two_disks(n: int, seed: int) -> tuple[Triangulation, Triangulation]:
    rng = np.random.default_rng(seed)
    return random_disk(n, rng), random_disk(n, rng)


def gallery_pair(name: str) -> tuple[Triangulation, Triangulation]:
    m = morph(*pair(name), strategy="common")
    return m.source, m.target


two_random_disks = st.builds(two_disks, st.integers(3, 24), st.integers(0, 2**32 - 1))
half_turns = st.floats(-3.1, 3.1)  # radians; short of a half turn, which may go either way


# All three


@each_method
@given(two_random_disks)
def test_a_baseline_starts_at_the_source_and_ends_at_the_target(method, shapes) -> None:
    source, target = shapes
    m = method(source, target)
    assert (m(0) == source.points).all() and (m(1) == target.points).all()
    size = np.ptp(source.points) + np.ptp(target.points)
    # The ends are put there exactly; what is computed just beside them shows that the method leads there.
    assert np.abs(m(1e-9) - source.points).max() < 1e-6 * size
    assert np.abs(m(1 - 1e-9) - target.points).max() < 1e-6 * size


@each_method
def test_a_baseline_is_used_as_a_morph(method) -> None:
    source, target = gallery_pair("horseshoe_to_loop")
    m = method(source, target)
    assert isinstance(m, Morph)
    assert m.source is source and (m.target.points == target.points).all()
    assert m.events == []
    assert (m.triangles_at(0.3) == source.triangles).all() and (m.triangles_at(1) == source.triangles).all()
    assert m.stage_at(TIMES).tolist() == [0] * len(TIMES)
    frames = m.frames(7)
    assert frames.shape == (7, len(source), 2)
    assert (frames[2] == m(2 / 6)).all() and (frames == m.at(np.linspace(0, 1, 7))).all()
    assert m.at([]).shape == (0, len(source), 2)
    assert method.__name__ in repr(m) and BASELINES[m.name] is method


@each_method
@pytest.mark.parametrize("times", [[-0.1], [1.1], [np.nan], 0.5])
def test_times_outside_0_to_1_are_refused(method, times) -> None:
    with pytest.raises(ValueError, match="expected a list of numbers from 0 to 1"):
        method(*two_disks(5, 1)).at(times)


@each_method
def test_different_numbers_of_vertices_are_refused(method) -> None:
    rng = np.random.default_rng(2)
    with pytest.raises(IncompatibleError, match="has 8 vertices, expected 7"):
        method(random_disk(7, rng), random_disk(8, rng))


@each_method
@given(disks(3, 20))
def test_the_way_from_a_shape_to_itself_stays_there(method, T) -> None:
    np.testing.assert_allclose(method(T, T).at(TIMES) - T.points, 0, atol=1e-9 * np.ptp(T.points))


@pytest.mark.parametrize("method", [edge_angle, as_rigid_as_possible])
@given(disks(3, 20), half_turns, st.floats(-5, 5))
def test_a_rotated_and_moved_copy_is_reached_by_a_rigid_motion(method, T, angle, shift) -> None:
    target = T.moved(T.points @ rotation(angle).T + [shift, 1.0])
    size = np.ptp(T.points) + abs(shift)
    for t, shape in zip(TIMES, method(T, target).at(TIMES), strict=True):
        first = (1 - t) * T.points[0] + t * target.points[0]
        expected = first + (T.points - T.points[0]) @ rotation(t * angle).T
        np.testing.assert_allclose(shape, expected, atol=1e-8 * size)


@each_method
@given(two_random_disks, half_turns, st.floats(0.1, 10), st.floats(-5, 5))
def test_a_similarity_of_both_shapes_is_one_of_the_shapes_on_the_way(method, shapes, angle, scale, shift) -> None:
    source, target = shapes
    before = method(source, target).at(TIMES)
    similar = [T.moved(scale * T.points @ rotation(angle).T + shift) for T in shapes]
    size = np.ptp(before) * scale + abs(shift)
    np.testing.assert_allclose(
        method(*similar).at(TIMES), scale * before @ rotation(angle).T + shift, rtol=0, atol=1e-6 * size
    )


@each_method
def test_mirrored_shapes_have_mirrored_ways(method) -> None:
    source, target = gallery_pair("e_to_l")
    n = len(source)
    # Mirrored and traversed the other way round from vertex 0, both are counter-clockwise again.
    back = -np.arange(n) % n
    mirrored = [
        Triangulation(T.points[back] * [-1, 1], (-T.triangles[:, ::-1]) % n).validate() for T in (source, target)
    ]
    expected = method(source, target).at(TIMES)[:, back] * [-1, 1]
    np.testing.assert_allclose(method(*mirrored).at(TIMES), expected, atol=1e-9)


@each_method
def test_the_number_of_the_first_vertex_only_moves_the_whole(method) -> None:
    source, target = gallery_pair("spiral_to_ess")
    own = method(source, target).at(TIMES)
    other = np.roll(method(source.rolled(40), target.rolled(40)).at(TIMES), 40, axis=1)
    apart = other - own
    np.testing.assert_allclose(apart, np.broadcast_to(apart[:, :1], apart.shape), atol=1e-9)


@each_method
def test_areas_and_flips_of_a_baseline_can_be_measured(method) -> None:
    source, target = gallery_pair("e_to_l")
    A = area_matrix(method(source, target), frames=9)
    assert A.shape == (len(source) - 2, 9)
    np.testing.assert_allclose(A[:, 0], source.areas / source.areas.sum(), rtol=1e-12)
    moved = source.moved(target.points)
    np.testing.assert_allclose(A[:, -1], moved.areas / source.areas.sum(), rtol=1e-12)


@each_method
@pytest.mark.slow
def test_a_hundred_shapes_of_a_thousand_vertices_take_no_time(method) -> None:
    source, target = two_disks(1000, 3)
    method(*two_disks(10, 3))  # compiles
    start = time.process_time()
    method(source, target).frames(100)
    assert time.process_time() - start < 10


# Straight lines


@given(two_random_disks)
def test_straight_is_linear(shapes) -> None:
    source, target = shapes
    for t, shape in zip(TIMES, straight(*shapes).at(TIMES), strict=True):
        np.testing.assert_allclose(shape, source.points + t * (target.points - source.points), rtol=0, atol=1e-12)


@given(two_random_disks)
def test_straight_backwards_is_the_way_back(shapes) -> None:
    there, back = straight(*shapes).frames(9), straight(*shapes[::-1]).frames(9)
    np.testing.assert_allclose(back[::-1], there, rtol=0, atol=1e-12)


# Edge lengths and turning angles


def along_directions(shape: Points, source: Triangulation, target: Triangulation, t: float) -> NDArray[np.complex128]:
    """Edges divided by directions that follow interpolated turning angles, in the rotation that fits best.

    Real where the turning angles are right, negative where an edge points backwards.
    """
    start, end = (np.cumsum(turning_angles(T.points)) for T in (source, target))
    edges = (np.roll(shape, -1, axis=0) - shape) @ np.array([1, 1j])
    along = edges * np.exp(-1j * ((1 - t) * start + t * end))
    along *= np.exp(-0.5j * np.angle(np.sum(along**2)))
    return along if along.real.sum() > 0 else -along


@given(two_random_disks)
def test_edge_angle_keeps_the_interpolated_turning_angles(shapes) -> None:
    np.testing.assert_allclose([turning_angles(T.points).sum() for T in shapes], 2 * np.pi, rtol=1e-12)
    for t in (0.2, 0.5, 0.9):
        along = along_directions(edge_angle(*shapes)(t), *shapes, t)
        np.testing.assert_allclose(along.imag, 0, atol=1e-9)


REGULAR = regular(5, 0.5 / np.sin(np.pi / 5))  # of side 1, as the house
HOUSE = [(0, 0), (1, 0), (1, 1), (0.5, 1 + 0.75**0.5), (0, 1)]
# Of the two houses the floor keeps its length, the walls nearly do.
SMALL_HOUSE, LARGE_HOUSE = [(0, 0), (2, 0), (2, 2), (1, 3), (0, 2)], [(0, 0), (2, 0), (2.5, 2), (0.7, 4), (-0.5, 2)]


def closing_cases() -> list[tuple[Triangulation, Triangulation, Points]]:
    """Pairs with the weights of their edges, by hand where differences vanish."""
    cases = [two_disks(n, n) for n in (5, 6, 7, 8)] + [(triangulate(SMALL_HOUSE), triangulate(LARGE_HOUSE))]
    weights = [abs(lengths(b.points) - lengths(a.points)) for a, b in cases]
    weights[-1][0] = 1e-4 * weights[-1].max()
    return [(*case, w) for case, w in zip(cases, weights, strict=True)] + [
        (triangulate(REGULAR), triangulate(HOUSE), np.ones(5)),
        (triangulate(REGULAR), triangulate(np.array(HOUSE) * (1 + 1e-14)), np.ones(5)),
    ]


@pytest.mark.parametrize("case", range(len(closing_cases())))
def test_edge_angle_changes_lengths_as_little_as_closing_allows(case: int) -> None:
    source, target, weights = closing_cases()[case]
    start, end = (np.cumsum(turning_angles(T.points)) for T in (source, target))
    for t in (0.3, 0.5, 0.8):
        wanted = (1 - t) * lengths(source.points) + t * lengths(target.points)
        angles = (1 - t) * start + t * end
        units = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        # In units of the weights the problem is round, and easy for a general optimiser.
        best = minimize(
            lambda x: (x**2).sum(),
            np.zeros(len(source)),
            jac=lambda x: 2 * x,
            constraints={"type": "eq", "fun": lambda x, w=wanted, u=units: (w + weights * x) @ u},
            options={"ftol": 1e-15, "maxiter": 500},
        )
        assert abs(best.x).max() > 1e-3  # it does not close by itself
        found = along_directions(edge_angle(source, target)(t), source, target, t).real
        np.testing.assert_allclose(found, wanted + weights * best.x, atol=1e-6)


def test_an_edge_that_keeps_its_length_hardly_gives_way() -> None:
    source, target, _ = closing_cases()[4]
    before, shape = lengths(source.points), edge_angle(source, target)(0.5)
    changes = abs(lengths(shape) - (before + lengths(target.points)) / 2)
    assert 0 < changes[0] < 1e-6 * changes.max()


@pytest.mark.parametrize("n", [3, 4, 7, 30])
def test_edge_angle_is_plain_interpolation_where_that_closes_by_itself(n: int) -> None:
    T = triangulate(regular(n))
    turned = T.moved(3 * T.points @ rotation(2.0).T)
    for t, shape in zip(TIMES, edge_angle(T, turned).at(TIMES), strict=True):
        np.testing.assert_allclose(lengths(shape), (1 + 2 * t) * lengths(T.points), rtol=1e-9)
        np.testing.assert_allclose(turning_angles(shape), 2 * np.pi / n, rtol=1e-9)


# Rotation and stretch of triangles


def linear_parts(T: Triangulation, shape: Points) -> Points:
    """The linear parts, (m, 2, 2), of the affine maps of the triangles of T to the same ones of a shape."""
    before, after = (np.diff(points[T.triangles], axis=1) for points in (T.points, shape))
    return np.linalg.solve(before, after).swapaxes(1, 2)


def wanted_maps(source: Triangulation, target: Points, t: float) -> Points:
    """A(t) by scipy's polar decomposition, each triangle turning its own shorter way."""
    pairs = [polar(A) for A in linear_parts(source, target)]
    angles = [np.arctan2(R[1, 0], R[0, 0]) for R, _ in pairs]
    blends = [(1 - t) * np.eye(2) + t * S for _, S in pairs]
    return np.array([rotation(t * angle) @ blend for angle, blend in zip(angles, blends, strict=True)])


triangles = disks(3, 3)


@given(triangles, triangles, st.floats(0, 1))
def test_a_single_triangle_is_turned_and_stretched_as_its_affine_map_says(source, target, t) -> None:
    found = linear_parts(source, as_rigid_as_possible(source, target)(t))
    np.testing.assert_allclose(found, wanted_maps(source, target.points, t), atol=1e-9)


def test_a_triangle_that_turns_over_is_stretched_by_a_negative_factor() -> None:
    T = Triangulation([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    m = as_rigid_as_possible(T, T.moved(T.points * [2, -1]))
    np.testing.assert_allclose(m.at(TIMES)[:, 1], np.stack([1 + TIMES, 0 * TIMES], axis=1), atol=1e-12)
    np.testing.assert_allclose(m.at(TIMES)[:, 2], np.stack([0 * TIMES, 1 - 2 * TIMES], axis=1), atol=1e-12)


@given(disks(3, 20), st.floats(0.3, 3), st.floats(-0.5, 0.5))
def test_one_affine_map_of_all_triangles_fits_exactly(T, stretch, shear) -> None:
    A = rotation(2.0) @ np.array([[stretch, shear], [shear, 1.0]])
    target = T.points @ A.T
    for t, shape in zip(TIMES, as_rigid_as_possible(T, T.moved(target)).at(TIMES), strict=True):
        np.testing.assert_allclose(linear_parts(T, shape), wanted_maps(T, target, t), atol=1e-9)


@pytest.mark.parametrize("name", ["ell", "horseshoe", "two_loops"])
def test_no_other_shape_is_more_rigid(name: str) -> None:
    source = triangulate(curve(name))
    target, rng = source.on_disk(), np.random.default_rng(4)
    m = as_rigid_as_possible(source, target, unwrap=False)
    for t in (0.25, 0.5, 0.9):
        wanted, shape = wanted_maps(source, target.points, t), m(t)
        least = ((linear_parts(source, shape) - wanted) ** 2).sum()
        for _ in range(10):
            step = 1e-3 * rng.normal(size=shape.shape)
            more, less = (((linear_parts(source, shape + s * step) - wanted) ** 2).sum() for s in (1, -1))
            assert min(more, less) > least > 1e-3
            assert abs(more - less) < 1e-6 * (more + less - 2 * least)  # the gradient is zero


def test_thin_triangles_do_not_spoil_the_solution() -> None:
    T = random_disk(30, np.random.default_rng(5))
    # Three vertices nearly on a line: the normal equations would square a condition of 1e10.
    a, b = T.points[0], T.points[1]
    flat = (a + b) / 2 + 1e-9 * np.array([b[1] - a[1], a[0] - b[0]])
    points = np.concatenate([[a, flat], T.points[1:]])
    thin = Triangulation(points, [*np.where(T.triangles > 0, T.triangles + 1, 0).tolist(), [0, 1, 2]]).validate()
    target = np.random.default_rng(6).normal(size=points.shape)
    m = as_rigid_as_possible(thin, thin.moved(target))
    np.testing.assert_allclose(m(1 - 1e-12), target, atol=1e-5)


def stretches(m: Morph, frames: int = 41) -> tuple[float, float]:
    """Smallest and largest stretch of a triangle in any frame; negative where one is turned over."""
    maps = np.array([linear_parts(m.source, shape) for shape in m.frames(frames)])
    singular = np.linalg.svd(maps, compute_uv=False)
    return float((singular[..., 1] * np.sign(np.linalg.det(maps))).min()), float(singular[..., 0].max())


def spiral_and_straightened() -> tuple[Triangulation, Triangulation]:
    angle = np.linspace(0, 2.8 * np.pi, 2000)
    spiral = (1.6 + 0.22 * angle[:, None]) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    path = evenly(spiral, 90)
    steps = np.hypot(*np.diff(path, axis=0).T)
    line = np.stack([np.append(0, np.cumsum(steps)), np.zeros(90)], axis=1)
    source = triangulate(zigzag(path, 0.8))
    return source, source.moved(zigzag(line, 0.8).points).validate()


@pytest.mark.parametrize("shapes", [spiral_and_straightened, lambda: gallery_pair("spiral_to_ess")])
def test_a_spiral_unrolls_whole_where_angles_are_unwrapped_and_folds_over_where_not(shapes) -> None:
    source, target = shapes()
    at_ends = stretches(straight(source, target), frames=2)
    unwrapped = stretches(as_rigid_as_possible(source, target))
    plain = stretches(as_rigid_as_possible(source, target, unwrap=False))
    assert unwrapped[0] > 0.9 * at_ends[0] and unwrapped[1] < 1.1 * at_ends[1]
    assert plain[0] < 0 < unwrapped[0]


def test_the_order_of_the_triangles_does_not_matter() -> None:
    source, target = spiral_and_straightened()
    last_first = Triangulation(source.points, source.triangles[::-1])  # angles are unwrapped from the other end
    expected = as_rigid_as_possible(source, target).at(TIMES)
    np.testing.assert_allclose(as_rigid_as_possible(last_first, target).at(TIMES), expected, atol=1e-9)


def test_unwrapping_changes_nothing_where_triangles_turn_little() -> None:
    shapes = gallery_pair("e_to_l")
    coherent, plain = (as_rigid_as_possible(*shapes, unwrap=u).at(TIMES) for u in (True, False))
    np.testing.assert_allclose(coherent, plain, atol=1e-9)


def test_a_triangle_without_area_is_refused() -> None:
    T = Triangulation([[0, 0], [1, 0], [2, 0], [1, 1]], [[0, 1, 2], [0, 2, 3]])
    with pytest.raises(TriangulationError, match="triangle 0 of the source has area 0"):
        as_rigid_as_possible(T, T)

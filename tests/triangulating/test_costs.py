"""Costs of triangles: each against its definition, and the optimum against all triangulations."""

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import disks

from tween import (
    Triangulation,
    decompose,
    gallery,
)
from tween.triangulating import costs
from tween.triangulating.costs import Cost, distortion

SHAPES = [gallery.random_disk(9, np.random.default_rng(seed)).curve for seed in range(6)]
MAKERS = {
    "edge_length": (costs.edge_length, "sum"),
    "smallest_angle": (costs.smallest_angle, "max"),
    "distortion": (lambda p: costs.distortion(p, circle(len(p))), "sum"),
    "conformal_distortion": (lambda p: costs.conformal_distortion(p, circle(len(p))), "max"),
}


def circle(n: int) -> np.ndarray:
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def every_triangulation(points: np.ndarray) -> list[np.ndarray]:
    """All triangulations, by drawing until the exact number of different ones is found."""
    d = decompose(points)
    found: dict[bytes, np.ndarray] = {}
    rng = np.random.default_rng(0)
    while len(found) < d.count:
        for T in d.sample(rng, 200):
            found[T.canonical.tobytes()] = T.canonical
    return list(found.values())


@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.parametrize("shape", range(len(SHAPES)))
def test_the_optimum_is_that_of_all_triangulations(name: str, shape: int) -> None:
    make, combine = MAKERS[name]
    points = SHAPES[shape].points
    cost: Cost = make(points)
    total = np.sum if combine == "sum" else np.max
    best = min(float(total(cost(triangles))) for triangles in every_triangulation(points))
    found = decompose(points).optimal(cost, combine).validate()
    assert float(total(cost(found.triangles))) == pytest.approx(best, rel=1e-12)


@pytest.mark.parametrize("shape", range(len(SHAPES)))
def test_lengths_add_up_to_those_of_the_diagonals_and_half_the_boundary(shape: int) -> None:
    points = SHAPES[shape].points
    T = decompose(points).arbitrary()
    diagonals = np.linalg.norm(np.diff(points[T.diagonals], axis=1), axis=2).sum()
    boundary = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum()
    assert costs.edge_length(points)(T.triangles).sum() == pytest.approx(diagonals + boundary / 2)


def test_conformal_distortion_is_the_ratio_of_singular_values() -> None:
    rng = np.random.default_rng(1)
    points, linear = rng.random((3, 2)) + np.array([[0, 0], [2, 0], [0, 2]]), rng.random((2, 2)) + np.eye(2)
    larger, smaller = np.linalg.svd(linear, compute_uv=False)
    triangle = np.array([[0, 1, 2]])
    there = costs.conformal_distortion(points, points @ linear.T)(triangle)
    back = costs.conformal_distortion(points @ linear.T, points)(triangle)
    np.testing.assert_allclose([there, back], [[larger / smaller]] * 2)


def test_the_smallest_angle_of_an_equilateral_triangle_is_sixty_degrees() -> None:
    assert -costs.smallest_angle(circle(3))(np.array([[0, 1, 2]]))[0] == pytest.approx(np.pi / 3)


def test_a_triangle_that_is_flat_in_floating_point_costs_infinitely_much_and_warns_nobody() -> None:
    tiny = 2.0**-30
    # The first three have the area 2**-61, and all the area 4, so that scaling to area 1 rounds nothing.
    shape = np.array([[0.0, 0.0], [1.0, 1.0 - tiny], [1.0 + tiny, 1.0], [-8.0, 0.0]])
    cost = costs.distortion(shape, circle(4))
    assert cost(np.array([[0, 1, 2]]))[0] == np.inf


# Distortion


def sheared(points: NDArray[np.float64]) -> NDArray[np.float64]:
    return points @ np.array([[1.3, 0.4], [-0.7, 0.8]])


@given(disks(3, 20))
def test_distortion_is_the_energy_of_the_singular_values_and_symmetric(T: Triangulation) -> None:
    for image in (T.on_disk("uniform").points, sheared(T.points), 7 * T.points[:, ::-1] * [1, -1]):
        cost = distortion(T.points, image)(T.triangles)
        np.testing.assert_allclose(cost, oracle.symmetric_dirichlet(T.points, image, T.triangles), rtol=1e-6)
        np.testing.assert_allclose(cost, distortion(image, T.points)(T.triangles), rtol=1e-9)
        areas = Triangulation(T.points, T.triangles).areas / float(oracle.area(T.points))
        images = Triangulation(image, T.triangles).areas / float(oracle.area(image))
        assert (cost >= 2 * (areas + images) * (1 - 1e-9)).all()


@given(disks(3, 20), st.floats(0.01, 100), st.floats(-3, 3))
def test_similar_shapes_are_not_distorted(T: Triangulation, scale: float, angle: float) -> None:
    turn = scale * np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    cost = distortion(T.points, T.points @ turn + [3, -1])(T.triangles)
    np.testing.assert_allclose(cost, 4 * T.areas / T.areas.sum(), rtol=1e-6)
    assert cost.sum() == pytest.approx(4, rel=1e-6)


@pytest.mark.parametrize("flat", [[0, 1, 2], [1, 0, 3]])
def test_a_triangle_that_is_flat_or_turned_in_floating_point_costs_infinitely_much(flat: list[int]) -> None:
    shape = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]])
    for source, target in ((shape, circle(5)), (circle(5), shape), (shape, shape)):
        assert distortion(source, target)(np.array([flat])).tolist() == [np.inf]

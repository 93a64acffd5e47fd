"""The signs of the two determinants are exact."""

import json
import os
import subprocess
import sys
from itertools import permutations
from pathlib import Path

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import njit
from numpy.typing import NDArray
from strategies import Points, exact_doubles, nudged_grids

from tween.geometry.predicates import (
    EXACT_RANGE,
    in_circumcircle,
    incircle,
    incircle_sign,
    orient2d,
    orient2d_sign,
    turn,
)

ROOT = Path(__file__).resolve().parents[2]

# Data sets of Kettner, Mehlhorn, Pion, Schirra and Yap, Classroom examples of robustness problems in
# geometric computations (2008), Figure 2: a grid of last bits at the first point, against the other two.
KETTNER = [
    ((0.5, 0.5), (12.0, 12.0), (24.0, 24.0)),
    (
        (0.50000000000002531, 0.5000000000000171),
        (17.300000000000001, 17.300000000000001),
        (24.00000000000005, 24.0000000000000517765),
    ),
    ((0.5, 0.5), (8.8000000000000007, 8.8000000000000007), (12.1, 12.1)),
]


def last_bits(point: tuple[float, float], low: int, high: int) -> NDArray[np.float64]:
    """Return the grid of points that are low, ..., high - 1 last bits away, shape ((high - low)**2, 2)."""
    x, y = (c + np.arange(low, high) * np.spacing(c) for c in point)
    return np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)


def expected(predicate: str, *points: Points) -> int:
    return int(getattr(oracle, predicate)(*oracle.integers(points)))


def parity(order: tuple[int, ...]) -> int:
    return (-1) ** sum(a > b for i, a in enumerate(order) for b in order[i + 1 :])


@pytest.mark.parametrize(("p", "q", "r"), KETTNER)
def test_orient2d_is_exact_on_the_classroom_examples(p, q, r) -> None:
    grid = last_bits(p, 0, 256)
    *exact, q0, r0 = oracle.integers([*grid, q, r])
    truth = [oracle.orient2d(x, q0, r0) for x in exact]
    assert set(truth) >= {-1, 1}
    np.testing.assert_array_equal(orient2d(grid, q, r), truth)
    np.testing.assert_array_equal(orient2d(q, r, grid), truth)


@pytest.mark.parametrize("corner", [(0.5, 12.0), (0.5, 12.3), (0.1, 12.1)])
def test_incircle_is_exact_where_the_fourth_corner_of_a_rectangle_is_moved_by_last_bits(corner) -> None:
    x, y = corner
    grid = last_bits(corner, -60, 60)
    rectangle = (x, 0.5), (12.7, 0.5), (12.7, y)
    *exact, a, b, c = oracle.integers([*grid, *rectangle])
    truth = [oracle.incircle(a, b, c, d) for d in exact]
    assert set(truth) == {-1, 0, 1}
    np.testing.assert_array_equal(incircle(*rectangle, grid), truth)


def test_incircle_is_exact_beside_far_mirror_images() -> None:
    rng = np.random.default_rng(10)
    # a, b, and their images in the line x = y, one of them a few last bits away.
    a, b = rng.uniform(1, 1.001, (2, 3000, 2)) * [8, 9] + rng.uniform(0, 1e-3, (2, 3000, 2))
    c = b[:, ::-1] + rng.integers(-2, 3, (3000, 2)) * np.spacing(b[:, ::-1])
    quadruples = np.stack([a, b, c, a[:, ::-1]])
    truth = [expected("incircle", *points) for points in quadruples.swapaxes(0, 1)]
    assert set(truth) == {-1, 0, 1}
    np.testing.assert_array_equal(incircle(*quadruples), truth)


@given(st.lists(st.tuples(exact_doubles, exact_doubles), min_size=4, max_size=4) | nudged_grids(4))
def test_both_predicates_are_exact_and_permute_with_their_sign(points: Points) -> None:
    side, inside = expected("orient2d", *points[:3]), expected("incircle", *points)
    for order in permutations(range(3)):
        assert orient2d(*(points[i] for i in order)) == parity(order) * side
    for order in permutations(range(4)):
        assert incircle(*(points[i] for i in order)) == parity(order) * inside


@given(st.lists(st.tuples(exact_doubles, exact_doubles), min_size=4, max_size=4))
def test_mirror_images_are_cocircular_and_points_on_an_axis_collinear(points: Points) -> None:
    a, b, (x, y), (z, _) = points
    c, d = (-b[0], b[1]), (-a[0], a[1])
    assert incircle(a, b, c, d) == 0
    assert orient2d((x, y), (0, y), (z, y)) == 0
    assert orient2d((0, 0), (x, y), (-x, -y)) == 0


@pytest.mark.parametrize("size", EXACT_RANGE)
@pytest.mark.parametrize("step", [1.0, 1.0 + 2.0**-52, 1.0 - 2.0**-53])
def test_one_last_bit_decides_at_both_ends_of_the_exact_range(size: float, step: float) -> None:
    far = size * step if EXACT_RANGE[0] <= size * step <= EXACT_RANGE[1] else size / step
    square = [(0.0, 0.0), (size, 0.0), (size, size), (0.0, far)]
    assert incircle(*square) == expected("incircle", *square) == np.sign(size - far)
    line = [(-size, -size), (size, size), (size, far)]
    assert orient2d(*line) == expected("orient2d", *line) == np.sign(far - size)


def test_coordinates_of_both_ends_of_the_exact_range_go_together() -> None:
    low, high = EXACT_RANGE
    for x in (low, -low):
        assert orient2d((x, 0), (high, high), (-high, -high)) == np.sign(x)
        assert incircle((high, 0), (0, high), (-high, 0), (x, -high)) == -1


def test_leading_shapes_are_broadcast() -> None:
    a, b, c = np.zeros(2), np.ones((5, 2)), np.arange(6.0).reshape(3, 1, 2)
    assert orient2d(a, b, c).shape == (3, 5)
    assert incircle(a, b, c, a).shape == (3, 5)
    assert orient2d(np.zeros((0, 2)), a, a).shape == (0,)
    assert orient2d([0, 0], [1, 0], [0, 1]).shape == ()
    assert orient2d(a, b, c).dtype == incircle(a, b, c, a).dtype == np.int8
    for i, j in np.ndindex(3, 5):
        assert orient2d(a, b, c)[i, j] == orient2d(a, b[j], c[i, 0])


@pytest.mark.parametrize("wrong", [1.0, [1.0, 2.0, 3.0], np.zeros((2, 3)), np.zeros((4, 0))])
def test_points_of_another_shape_are_refused(wrong) -> None:
    for predicate, count in ((orient2d, 3), (incircle, 4)):
        with pytest.raises(ValueError, match=r"shape"):
            predicate(*[wrong] * count)


@pytest.mark.parametrize("wrong", [1.0, [1.0], [[1.0], [2.0]]])
def test_one_point_with_a_single_coordinate_is_refused(wrong) -> None:
    with pytest.raises(ValueError, match="shape"):
        orient2d(wrong, [0, 0], [1, 0])


@njit
def _in_a_kernel(p):
    by_rows = turn(p, 0, 1, 2), in_circumcircle(p, 0, 1, 2, 3)
    by_coordinates = (
        orient2d_sign(p[0, 0], p[0, 1], p[1, 0], p[1, 1], p[2, 0], p[2, 1]),
        incircle_sign(p[0, 0], p[0, 1], p[1, 0], p[1, 1], p[2, 0], p[2, 1], p[3, 0], p[3, 1]),
    )
    return by_rows, by_coordinates


@pytest.mark.parametrize("scale", [1.0, 1e-40])
def test_other_kernels_can_call_the_predicates(scale: float) -> None:
    points = scale * np.array([[0.1, 0.1], [0.7, 0.7], [0.3, 0.3], [0.3, 0.7]])
    expected_signs = (int(orient2d(*points[:3])), int(incircle(*points)))
    assert _in_a_kernel(points) == (expected_signs, expected_signs)


SIGNS = """
import json, numpy as np
from tween.geometry.predicates import incircle, orient2d
p = np.random.default_rng(7).integers(0, 4, (4, 300, 2)) * 0.1
print(json.dumps([orient2d(*p[:3]).tolist(), incircle(*p).tolist()]))
"""


@pytest.mark.slow
def test_the_answers_are_the_same_without_compilation(capsys) -> None:
    env = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    run = subprocess.run([sys.executable, "-c", SIGNS], cwd=ROOT, env=env, capture_output=True, text=True, check=True)
    exec(SIGNS, {})
    uncompiled, here = json.loads(run.stdout), json.loads(capsys.readouterr().out)
    assert uncompiled == here
    assert set(here[0]) == set(here[1]) == {-1, 0, 1}

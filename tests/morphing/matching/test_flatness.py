"""Flat triangles count as none, beside exact signs."""

import numpy as np
import oracle
import pytest

from tween import triangulate
from tween.morphing.matching.flatness import FLAT, least_flat, side_of


@pytest.mark.parametrize("seed", range(5))
def test_sides_are_exact_where_none_is_flat(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(2, 2))
    for height in (0.0, 1e-3, 1e-9, 1e-13, 1e-16):
        c = a + rng.uniform(-1, 2) * (b - a) + rng.choice([-1, 1]) * height * np.array([a[1] - b[1], b[0] - a[0]])
        exact = oracle.orient2d(*oracle.fractions(np.array([a, b, c])))
        assert side_of(a, b, c, 0.0) == exact
        assert side_of(a, b, c, FLAT) in ([exact] if height > 1e-8 else [exact, 0.0])


def test_points_collinear_but_for_rounding_are_on_one_line() -> None:
    z = np.exp(0.7j) * np.array([0, 1, 3])
    a, b, c = np.stack([z.real, z.imag], axis=1)
    assert side_of(a, b, c, FLAT) == 0.0


def test_only_disks_without_thin_triangles_leave_out_flat_ones() -> None:
    square, needle = ([[0, 0], [1, 0], [1, h], [0, h]] for h in (1.0, 1e-7))
    assert least_flat(triangulate(square)) == FLAT
    assert least_flat(triangulate(needle)) == 0.0

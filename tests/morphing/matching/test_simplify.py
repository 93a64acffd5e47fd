"""Simplified disks: nested, valid at every size, and the same wherever the curve starts."""

import numpy as np
import pytest

from tween import Curve, Triangulation, remesh, triangulate
from tween.gallery import curve, random_disk
from tween.morphing.matching.simplify import simplify

SHAPES = [
    *(pytest.param(triangulate(curve(name)), id=name) for name in ("arrow", "pretzel", "two_disks")),
    *(pytest.param(random_disk(40, np.random.default_rng(seed)), id=f"disk-{seed}") for seed in range(3)),
]
every_shape = pytest.mark.parametrize("T", SHAPES)


def sizes(T: Triangulation) -> list[int]:
    return sorted({len(T), *(k for k in (60, 40, 24, 12) if k < len(T))}, reverse=True)


@every_shape
def test_every_level_bounds_an_immersed_disk_and_is_part_of_the_one_before(T: Triangulation) -> None:
    levels = simplify(T, sizes(T), np.zeros(len(T), dtype=bool))
    before = set(range(len(T)))
    for size, level in zip(sizes(T), levels, strict=True):
        assert len(level.kept) >= size
        assert set(level.kept.tolist()) <= before
        Triangulation(T.points[level.kept], level.triangles).validate()
        before = set(level.kept.tolist())


@every_shape
def test_fixed_vertices_stay(T: Triangulation) -> None:
    fixed = np.zeros(len(T), dtype=bool)
    fixed[[3, 17, 29]] = True
    assert {3, 17, 29} <= set(simplify(T, [8], fixed)[0].kept.tolist())


@pytest.mark.parametrize("shift", [1, 13])
def test_another_start_leaves_the_same_vertices(shift: int) -> None:
    T = random_disk(40, np.random.default_rng(7))
    nothing = np.zeros(len(T), dtype=bool)
    plain, rolled = (simplify(U, [12], nothing)[0].kept for U in (T, T.rolled(shift)))
    assert sorted((rolled + shift) % len(T)) == plain.tolist()


def test_straight_sides_of_a_finely_sampled_curve_are_thinned_out_evenly() -> None:
    square = Curve([[0, 0], [150, 0], [150, 150], [0, 150]]).insert_vertices(600)
    kept = simplify(remesh(triangulate(square)), [310], np.zeros(600, dtype=bool))[0].kept
    assert len(kept) == 310
    assert np.diff(np.append(kept, 600)).max() <= 4  # 2 where each second one may go


@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_collinear_neighbours_do_not_keep_a_vertex(turn: float) -> None:
    straight = np.array([[0, 0], [1, 0], [2, 0], [3, 0], [4, 0], [4, 1], [0, 1]]) @ [1, 1j] * np.exp(1j * turn)
    T = triangulate(np.stack([straight.real, straight.imag], axis=1))
    assert simplify(T, [4], np.zeros(7, dtype=bool))[0].kept.tolist() == [0, 4, 5, 6]

"""Angle budgets: with a guarantee every shape bounds an immersed disk, at little cost to the path."""

import numpy as np
import pytest

from tween import (
    Triangulation,
    area_matrix,
    area_rank,
    certify,
    frame_variance,
    gallery,
    morph,
    paper_morph,
    remesh,
    triangulate,
)
from tween.choices import PATHS
from tween.errors import TriangulationError
from tween.morphing.compatible.guarantee.angle_budgets import proved_budgets
from tween.morphing.compatible.leg import Leg, root_triangle

every_path = pytest.mark.parametrize("path", PATHS)
TIMES = np.linspace(0, 1, 61)


def disk_leg(seed: int, path: str, guarantee: bool, n: int = 40) -> Leg:
    T = remesh(gallery.random_disk(n, np.random.default_rng(seed)))
    D = T.on_disk()
    return Leg(T, D.points, path, root_triangle("disk-center", T, D), guarantee)


def broken(leg: Leg, times=TIMES) -> int:
    """Count the shapes that bound no immersed disk."""
    return sum(is_broken(leg.source.moved(shape)) for shape in leg.at(times))


def is_broken(T: Triangulation) -> bool:
    try:
        T.validate()
    except TriangulationError:
        return True
    return False


@every_path
def test_with_a_guarantee_every_shape_of_a_random_disk_bounds_a_disk(path: str) -> None:
    assert [broken(disk_leg(seed, path, True)) for seed in range(8)] == [0] * 8


@pytest.mark.parametrize("path", ["area", "metric"])
def test_without_a_guarantee_some_shapes_do_not(path: str) -> None:
    assert sum(broken(disk_leg(seed, path, False)) for seed in range(8)) > 0


def test_along_the_path_of_angles_no_budget_is_needed() -> None:
    for seed in range(8):
        leg = disk_leg(seed, "angle", True)
        assert not np.isfinite(leg.budgets.low).any()
        assert broken(leg) == 0


@every_path
def test_where_no_budget_is_given_the_guarantee_changes_nothing(path: str) -> None:
    T = triangulate(gallery.curve("spiral_1"))
    D = T.on_disk()
    plain, kept = (Leg(T, D.points, path, root_triangle("disk-center", T, D), g) for g in (False, True))
    if not np.isfinite(kept.budgets.low).any():
        np.testing.assert_array_equal(plain.at(TIMES), kept.at(TIMES))


@every_path
@pytest.mark.parametrize("k", [2, 3, 11, 41, 100, 1001])
def test_the_fan_is_kept_at_every_number_of_frames(path: str, k: int) -> None:
    source, target = gallery.fan()
    m = morph(source, target, path=path, guarantee=True)
    assert not any(is_broken(source.moved(shape)) for shape in m.frames(k))
    assert certify(m).valid


@pytest.mark.parametrize("path", ["linear", "slide"])
def test_the_paths_of_the_paper_break_the_fan(path: str) -> None:
    source, target = gallery.fan()
    source.validate()
    target.validate()
    m = paper_morph(source, target, path=path)
    assert sum(is_broken(source.moved(shape)) for shape in m.frames(41)) > 15
    assert m.proof == ""


@every_path
def test_the_guaranteed_way_back_is_the_way_there(path: str) -> None:
    for seed in range(4):
        T = remesh(gallery.random_disk(40, np.random.default_rng(seed)))
        there, back = morph(T, T.on_disk(), path=path, guarantee=True), morph(T.on_disk(), T, path=path, guarantee=True)
        np.testing.assert_allclose(there.at(TIMES), back.at(1 - TIMES), atol=1e-9 * np.ptp(T.points))


@every_path
def test_budgets_bring_no_jump(path: str) -> None:
    for seed in range(4):
        leg = disk_leg(seed, path, True)
        coarse, fine = (np.abs(np.diff(leg.at(np.linspace(0, 1, k)), axis=0)).max() for k in (2001, 4001))
        assert fine < 0.8 * coarse  # 1/2 where it is smooth; 1/sqrt(2) where a foot makes way for a budget


def test_without_budgets_the_path_of_areas_reaches_the_floor_of_both_measures() -> None:
    for name in gallery.names():
        T = triangulate(gallery.curve(name))
        A = area_matrix(paper_morph(T, T.on_disk(), path="area"))
        assert area_rank(A, 1e-9) == 2 or name == "convex"
        assert frame_variance(A) < 1e-20


@pytest.mark.parametrize("pair", gallery.pairs())
@pytest.mark.parametrize("path", ["slide", "angle", "metric"])
def test_with_a_guarantee_flips_keep_the_disk_too(pair: str, path: str) -> None:
    m = morph(*gallery.pair(pair), path=path, guarantee=True, strategy="paper")
    times = np.linspace(0, 1, 41)
    assert not any(is_broken(Triangulation(s, m.triangles_at(t))) for t, s in zip(times, m.at(times), strict=True))


# Who gets a budget


def spread(corners, first, last, wanted) -> list[set[int]]:
    """Grow the set of vertices as `angle_budgets` explains it, without any shortcut; returns all its stages."""
    stages: list[set[int]] = [set()]
    times = np.linspace(0, 1, 129)
    while True:
        sums = np.zeros((corners.max() + 1, 128))
        for triangle, a, b, (low, high) in zip(corners.tolist(), first, last, wanted, strict=True):
            for s, v in enumerate(triangle):
                reached = low[s] + times * (high[s] - low[s])
                if stages[-1] & set(triangle):
                    reached = np.maximum(reached, a[s] + times * (b[s] - a[s]))
                sums[v] += np.maximum(reached[:-1], reached[1:])
        over = set(np.flatnonzero(sums.max(axis=1) >= 2 * np.pi).tolist()) - stages[-1]
        if not over:
            return stages
        stages.append(stages[-1] | over)


def test_the_vertices_with_budgets_are_those_that_the_rule_spreads_to() -> None:
    rng, rounds = np.random.default_rng(0), []
    for _ in range(40):
        corners = remesh(gallery.random_disk(40, rng)).triangles
        count = np.bincount(corners.ravel())
        first, last = ((rng.uniform(1.9, 1.99, len(count)) * np.pi / count)[corners] for _ in range(2))
        wanted = np.stack([first, last], axis=1) * rng.uniform(0.82, 1.1, (len(corners), 2, 3))

        def bounds(times, rows, wanted=wanted):
            low, high = wanted[rows].transpose(1, 0, 2)[..., None]
            angles = low + times * (high - low)
            return np.maximum(angles[..., :-1], angles[..., 1:])

        budgets, slack = proved_budgets(corners, first, last, bounds)
        stages = spread(corners, first, last, wanted)
        assert set(corners[np.isfinite(budgets.low)].tolist()) == stages[-1] == set(np.flatnonzero(np.isnan(slack)))
        rounds.append(len(stages) if len(stages[-1]) < 40 else 0)
    assert sum(r >= 4 for r in rounds) >= 10  # it spread, and not to all

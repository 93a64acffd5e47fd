"""Sums of bounds: as tight as if all angles were bounded in all parts, where little is left."""

from collections.abc import Callable

import numpy as np
import pytest

from tween import gallery, remesh
from tween.morphing.compatible.guarantee.sum_search import ROUNDING, SumSearch, vertex_sums

TIMES = np.linspace(0, 1, 129)


def waves(corners: np.ndarray, rng: np.random.Generator, height: float) -> Callable[..., np.ndarray]:
    """Angles that swing about an equal share of 2 pi, and bounds of them."""
    count = np.bincount(corners.ravel())
    middle = (2 * np.pi / count)[corners]
    phase, speed = rng.uniform(0, 6, middle.shape), rng.uniform(0, 9, middle.shape)

    def bounds(times: np.ndarray, rows: np.ndarray) -> np.ndarray:
        swing = np.sin(phase[rows, :, None] + speed[rows, :, None] * times)
        rise = 0.5 * speed[rows, :, None] * np.diff(times)  # it swings no farther from both ends of an interval
        highest = np.minimum(np.maximum(swing[..., :-1], swing[..., 1:]) + rise, 1)
        return middle[rows, :, None] * (0.97 + height * highest)

    return bounds


@pytest.mark.parametrize("n", [12, 60, 300])
@pytest.mark.parametrize("height", [0.01, 0.03, 0.06])
def test_what_is_left_is_what_all_parts_together_tell(n: int, height: float) -> None:
    rng = np.random.default_rng(n)
    corners = remesh(gallery.random_disk(n, rng)).triangles
    bounds = waves(corners, rng, height)
    start = np.full(corners.shape, 1e-3)
    slack = SumSearch(corners, start, start, bounds).slack(np.zeros(n, dtype=np.bool_))
    left = 2 * np.pi - vertex_sums(corners, bounds(TIMES, np.arange(n - 2)), n).max(axis=1) - ROUNDING
    assert ((slack > 0) == (left > 0)).all()
    assert (slack <= left + 1e-12).all()  # of long intervals that suffice the parts are not looked at
    np.testing.assert_allclose(slack[left <= 0], left[left <= 0])


def test_bounds_of_triangles_with_a_budget_reach_the_path_of_angles_before_and_after_they_are_divided() -> None:
    rng, n = np.random.default_rng(4), 200
    corners = remesh(gallery.random_disk(n, rng)).triangles
    bounds = waves(corners, rng, 0.03)
    share = (2 * np.pi / np.bincount(corners.ravel()))[corners]
    first, last = (share * rng.uniform(0.9, 1.05, share.shape) for _ in range(2))
    search = SumSearch(corners, first, last, bounds)
    settled = np.zeros(n, dtype=np.bool_)
    some = search.slack(settled) <= 0
    assert some.any() and not some.all()
    spread = 0
    for extra in (some, rng.random(n) < 0.2):
        settled |= extra
        search.reach_plain(settled)
        plain = settled[corners].any(axis=1)
        angles = bounds(TIMES, np.arange(n - 2))
        ends = first[..., None] + TIMES * (last - first)[..., None]
        angles[plain] = np.maximum(angles, np.maximum(ends[..., :-1], ends[..., 1:]))[plain]
        left = 2 * np.pi - vertex_sums(corners, angles, n).max(axis=1) - ROUNDING
        asked = ~settled
        spread += (left[asked] <= 0).sum()
        slack = search.slack(settled)
        assert ((slack > 0) == (left > 0))[asked].all()
        np.testing.assert_allclose(slack[asked & (left <= 0)], left[asked & (left <= 0)])
    assert spread > 0


def test_what_is_not_known_leaves_nothing() -> None:
    corners = np.array([[0, 1, 2], [0, 2, 3]])
    ends = np.full((2, 3), 0.5)

    def bounds(times: np.ndarray, rows: np.ndarray) -> np.ndarray:
        angles = np.full((2, 3, len(times) - 1), 0.5)
        angles[1, 2] = np.nan  # at vertex 3
        return angles[rows]

    search = SumSearch(corners, ends, ends, bounds)
    assert (search.slack(np.zeros(4, dtype=np.bool_)) > 0).tolist() == [True, True, True, False]
    search.reach_plain(np.array([False, False, False, True]))
    assert (search.slack(np.zeros(4, dtype=np.bool_)) > 0).tolist() == [True, True, True, False]

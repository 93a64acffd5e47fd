"""Keyframes joined: disks chosen, loops closed, triangles right on both sides of every leg."""

import itertools

import numpy as np
import pytest

from tween import gallery
from tween.morphing.keyframes import closing, joining
from tween.morphing.keyframes.joining import join
from tween.morphing.keyframes.keyframe import Keyframe, choose_disks


@pytest.mark.parametrize("loop", [False, True])
def test_the_choice_of_disks_is_the_cheapest_of_all(loop: bool) -> None:
    rng = np.random.default_rng(0)
    for _ in range(30):
        counts = rng.integers(1, 4, 5).tolist()
        energies = rng.uniform(4, 9, (5, 3, 3))

        def cost(choice: tuple[int, ...] | list[int], energies: np.ndarray = energies) -> float:
            around = [*choice, choice[0]] if loop else choice
            return sum(energies[i, a, b] for i, (a, b) in enumerate(itertools.pairwise(around)))

        found = choose_disks(counts, lambda leg, disks, energies=energies: energies[leg][disks], loop)
        best = min(itertools.product(*map(range, counts)), key=cost)
        assert cost(found) == pytest.approx(cost(best))


def test_where_there_is_no_choice_nothing_is_matched_for_it() -> None:
    assert choose_disks([1, 1, 1], lambda *_: pytest.fail("asked"), loop=True) == [0, 0, 0]


def frames_of(*names: str) -> list[Keyframe]:
    return [Keyframe(gallery.curve(name), name) for name in names]


@pytest.mark.slow
@pytest.mark.parametrize("loop", [False, True])
def test_all_legs_have_the_same_triangles_at_both_ends_and_keyframes_the_same_points(loop: bool) -> None:
    joined = join(frames_of("ell", "arrow", "horseshoe"), loop)
    assert joined.holds() and joined.energy < 100
    ends = joined.ends()
    assert len(ends) == 2 + loop
    for (source, target), (after, _) in zip(ends, [*ends[1:], ends[0]], strict=True):
        np.testing.assert_array_equal(source.triangles, target.triangles)
        if after is not ends[0][0] or loop:
            np.testing.assert_array_equal(target.points, after.points)


@pytest.mark.slow
def test_a_loop_without_a_common_triangulation_is_closed_by_flips(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(closing, "_shared", lambda *_: None)
    joined = join(frames_of("ell", "arrow", "horseshoe"), True)
    assert [bridge.complete for bridge in joined.bridges].count(False) == 1
    assert joined.holds()


@pytest.mark.slow
def test_the_leg_that_closes_a_loop_is_the_one_where_it_costs_least() -> None:
    keyframes = frames_of("ell", "arrow", "horseshoe")
    matcher = joining.Matcher(keyframes, ())
    every = [joining._closed_on(matcher, [0, 0, 0], leg, joining.MERGE, {}).energy for leg in range(3)]
    assert join(keyframes, True).energy == min(every) < max(every)

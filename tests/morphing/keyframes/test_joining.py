"""Keyframes joined: disks chosen, loops closed, triangles right on both sides of every leg."""

import numpy as np
import pytest

from tween import gallery
from tween.morphing.keyframes import joining
from tween.morphing.keyframes.joining import join
from tween.morphing.keyframes.keyframe import Keyframe


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
def test_the_leg_that_closes_a_loop_is_the_one_where_it_costs_least() -> None:
    keyframes = frames_of("ell", "arrow", "horseshoe")
    matcher = joining.Matcher(keyframes, ())
    every = [joining._closed_on(matcher, [0, 0, 0], leg, joining.MERGE, {}).energy for leg in range(3)]
    assert join(keyframes, True).energy == min(every) < max(every)


@pytest.mark.slow
def test_a_loop_that_no_leg_closes_is_closed_after_another_leg_was_matched_anew(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    keyframes = [Keyframe(gallery.letter(char), char) for char in "IRcV"]
    keyframes.insert(3, Keyframe(gallery.curve("ell"), "ell"))
    joined = join(keyframes, True)
    assert np.isfinite(joined.energy) and joined.holds()
    monkeypatch.setattr(joining, "_PAIRS", ())
    assert not np.isfinite(join(keyframes, True).energy)

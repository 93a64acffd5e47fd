"""Threads: every node of every bridge is on one, in one order on all keyframes."""

from itertools import pairwise

import numpy as np
import pytest

from tween import match
from tween.morphing.keyframes.keyframe import Keyframe, bridged
from tween.morphing.keyframes.threads import Threads, thread


def polygons(count: int, seed: int) -> list[Keyframe]:
    """Star-shaped polygons of 4 to 11 vertices."""
    rng = np.random.default_rng(seed)
    frames = []
    for i in range(count):
        n = int(rng.integers(4, 12))
        angle = 2 * np.pi * (np.arange(n) + rng.uniform(-0.3, 0.3, n)) / n
        radius = rng.uniform(0.5, 1.5, n)
        frames.append(Keyframe(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1), f"keyframe {i}"))
    return frames


def threaded(frames: list[Keyframe], merge: float) -> tuple[Threads, list]:
    bridges = [bridged(match(a.disks[0], b.disks[0]), a, b) for a, b in pairwise(frames)]
    return thread(frames, bridges, merge), bridges


def check_order(threads: Threads) -> None:
    """Once around every keyframe, without a return; all vertices are there."""
    for i, keyframe in enumerate(threads.keyframes):
        place = threads.places[:, i]
        assert (np.diff(place) > 0).all() and place[-1] < place[0] + len(keyframe)
        rows = threads.vertices[i]
        assert sorted(rows[rows >= 0].tolist()) == list(range(len(keyframe)))
        np.testing.assert_allclose(threads.points[:, i], keyframe.at(place), atol=0.05)


@pytest.mark.parametrize("merge", [0.0, 0.02, 0.4])
@pytest.mark.parametrize("seed", range(6))
def test_threads_have_one_order_on_all_keyframes_and_hold_all_nodes(seed: int, merge: float) -> None:
    threads, bridges = threaded(polygons(5, seed), merge)
    check_order(threads)
    assert len(threads.places) <= sum(map(len, threads.keyframes))
    for i, (bridge, nodes) in enumerate(zip(bridges, threads.nodes, strict=True)):
        assert len(set(nodes.tolist())) == len(nodes) == len(bridge.source)
        assert (np.diff(np.roll(nodes, -int(nodes.argmin()))) > 0).all()
        if merge == 0.0:
            for points, k in ((bridge.source_points, i), (bridge.target_points, i + 1)):
                np.testing.assert_allclose(threads.points[nodes, k], points, atol=1e-9)


def test_merging_makes_fewer_threads() -> None:
    few, many = (len(threaded(polygons(6, 1), merge)[0].places) for merge in (0.3, 0.0))
    assert few < many


@pytest.mark.parametrize("start", [0, 2, 4])
def test_one_may_begin_with_any_keyframe(start: int) -> None:
    threads, _ = threaded(polygons(5, 3), 0.02)
    threads.nodes.append(threads.nodes[-1])  # of a bridge that closes the round
    rolled = threads.rolled(start)
    check_order(rolled)
    assert rolled.keyframes[0] is threads.keyframes[start]
    assert rolled.vertices[0].max() == len(threads.keyframes[start]) - 1
    number = int(np.flatnonzero(rolled.vertices[0] == 0)[0])
    assert number == 0
    same = {tuple(column) for column in rolled.vertices.T.tolist()}
    assert same == {tuple(np.roll(column, -start).tolist()) for column in threads.vertices.T}


def test_threads_that_would_come_too_close_are_given_room() -> None:
    threads, _ = threaded(polygons(40, 5), 0.0)
    check_order(threads)
    for i in range(40):
        gaps = np.diff(threads.places[~threads.fixed[:, i], i])
        assert gaps.min() > 1e-7

"""Keyframes: places on their curves, matches as places, and the choice of disks."""

import itertools

import numpy as np
import pytest

from tween import match
from tween.morphing.keyframes.keyframe import Keyframe, Matcher, bridged, choose_disks

SQUARE = [[0, 0], [2, 0], [2, 2], [0, 2]]
ELL = [[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]]
TRIANGLE = [[0, 0], [3, 0], [0, 3]]


def test_places_are_vertices_and_shares_of_edges() -> None:
    keyframe = Keyframe(SQUARE, "square")
    np.testing.assert_array_equal(keyframe.at(np.array([0.0, 0.5, 3.25, 6.0])), [[0, 0], [1, 0], [0, 1.5], [2, 2]])
    assert (keyframe.vertex(3), keyframe.vertex(4)) == (3, -1)
    assert [Keyframe(SQUARE[::-1], "clockwise").vertex(row) for row in range(4)] == [0, 3, 2, 1]


@pytest.mark.parametrize("start", [0, 1, 3])
def test_the_places_of_a_match_are_where_its_points_are(start: int) -> None:
    a, b = Keyframe(ELL, "ell"), Keyframe(np.roll(SQUARE, start, axis=0), "square")
    bridge = bridged(match(a.disks[0], b.disks[0]), a, b)
    for places, points, keyframe in (
        (bridge.source, bridge.source_points, a),
        (bridge.target, bridge.target_points, b),
    ):
        assert (np.diff(places) > 0).all() and places[-1] < places[0] + len(keyframe)
        np.testing.assert_allclose(keyframe.at(places), points, atol=1e-12)
    assert bridge.complete and bridge.reversed().complete


def test_a_match_anew_has_the_given_places_correspond() -> None:
    matcher = Matcher([Keyframe(ELL, "ell"), Keyframe(SQUARE, "square")], ())
    source, target = np.array([0.25, 3.0]), np.array([1.5, 3.75])
    bridge = matcher.anew(0, [0, 0], source, target)
    assert bridge is not None
    for place, image in zip(source, target, strict=True):
        (node,) = np.flatnonzero(np.abs(bridge.source % 6 - place) < 1e-9)
        assert bridge.target[node] % 4 == pytest.approx(image)


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

"""Sequences: keyframes exact, one numbering, one disk on both sides, valid all the way, loops without a seam."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from tween import (
    Curve,
    CurveError,
    Morph,
    NotSelfOverlappingError,
    Sequence,
    Triangulation,
    area_matrix,
    area_rank,
    certify,
    decompose,
    frame_variance,
    gallery,
    io,
    remesh,
    sequence,
    verify,
)
from tween.choices import PATHS
from tween.errors import IncompatibleError
from tween.measuring.metrics import angle_sums

SQUARE = [[0, 0], [2, 0], [2, 2], [0, 2]]
BAR = [[0, 0], [4, 0], [4, 1], [0, 1]]
TRIANGLE = [[0, 0], [3, 0], [0, 3]]
ELL = [[0, 0], [4, 0], [4, 1], [1, 1], [1, 3], [0, 3]]
SMALL = [SQUARE, ELL, TRIANGLE, BAR]
EIGHT = [[0, 0], [4, 4], [4, 0], [0, 3]]  # bounds no disk


@pytest.fixture(scope="module")
def loop() -> Sequence:
    return sequence([gallery.letter(char) for char in "LOVe"], loop=True, hold=0.25)


@pytest.fixture(scope="module")
def line() -> Sequence:
    return sequence([gallery.curve(name) for name in ("ell", "arrow", "horseshoe")])


# What it is


@pytest.mark.slow
def test_every_keyframe_is_there_exactly_with_all_its_vertices_in_order(loop: Sequence) -> None:
    curves = [gallery.letter(char) for char in "LOVe"]
    for time, rows, keyframe, curve in zip(loop.times, loop.vertices, loop.keyframes, curves, strict=False):
        np.testing.assert_array_equal(loop(time), keyframe.points)
        given = rows[rows >= 0]
        np.testing.assert_array_equal(np.roll(given, -int(given.argmin())), np.arange(len(curve)))
        np.testing.assert_array_equal(keyframe.points[rows >= 0], curve.points[given])


@pytest.mark.slow
def test_vertices_that_were_inserted_lie_on_the_edges_of_a_keyframe(loop: Sequence) -> None:
    for rows, keyframe in zip(loop.vertices, loop.keyframes, strict=True):
        corners = np.flatnonzero(rows >= 0)
        for a, b in zip(corners, np.append(corners[1:], corners[0] + len(rows)), strict=True):
            inner = np.arange(a + 1, b) % len(rows)
            start, end = keyframe.points[a], keyframe.points[b % len(rows)]
            along = (keyframe.points[inner] - start) @ (end - start) / ((end - start) ** 2).sum()
            assert (np.diff(np.concatenate([[0.0], along, [1.0]])) > 1e-9).all()
            np.testing.assert_allclose(keyframe.points[inner], start + along[:, None] * (end - start), atol=1e-9)


@pytest.mark.slow
def test_a_loop_ends_as_it_began_to_the_last_bit_and_no_vertex_jumps(loop: Sequence) -> None:
    frames = loop.frames(241)
    assert frames[0].tobytes() == frames[-1].tobytes()
    np.testing.assert_array_equal(loop.source_vertices, loop.target_vertices)
    np.testing.assert_array_equal(loop.triangles_at(0.0), loop.triangles_at(1.0))
    steps = np.hypot(*np.diff(frames, axis=0).T).max(axis=0)
    assert steps.max() < 0.2 * np.ptp(frames, axis=(0, 1)).max()
    assert not [event for leg in loop.legs for event in leg.events], "no leg needs a flip"


@pytest.mark.slow
@pytest.mark.parametrize("which", ["loop", "line"])
def test_all_instants_bound_a_disk(which: str, request: pytest.FixtureRequest) -> None:
    s: Sequence = request.getfixturevalue(which)
    certificate = certify(s)
    assert certificate, certificate
    assert certificate.scope == "morph"
    played = s.playback(tolerance=5e-3)
    assert played.certificate
    assert "proved in doubles" in s.proof


@pytest.mark.slow
def test_both_triangulations_of_a_keyframe_show_the_same_disk(loop: Sequence) -> None:
    for before, after in pairwise([*loop.legs, loop.legs[0]]):
        np.testing.assert_array_equal(before.target.points, after.source.points)
        for T in (before.target, after.source):
            T.validate()
        np.testing.assert_array_equal(remesh(before.target).canonical, remesh(after.source).canonical)


@pytest.mark.slow
def test_what_takes_a_morph_takes_a_sequence(loop: Sequence) -> None:
    assert isinstance(loop, Morph)
    A = area_matrix(loop, frames=41)
    np.testing.assert_allclose(A[:, 0], A[:, -1])
    areas = [T.areas.sum() / loop.source.areas.sum() for T in loop.keyframes]
    np.testing.assert_allclose(area_matrix(loop, frames=5).sum(axis=0), [*areas, areas[0]], rtol=1e-9)
    assert area_rank(A, rtol=1e-4) > 2 and frame_variance(A) > 0
    assert angle_sums(loop, np.linspace(0, 1, 9)).max() < 2 * np.pi
    np.testing.assert_array_equal(list(loop.each_frame(11)), loop.frames(11))
    back = loop.reversed()
    np.testing.assert_array_equal(back.at([0.3]), loop.at([0.7]))
    assert certify(back)


def test_the_triangles_in_force_change_at_keyframes_by_the_events_only() -> None:
    s = sequence(SMALL, loop=True)
    assert {event.time for event in s.events} <= set(s.times.tolist())

    def diagonals(t: float) -> set[tuple[int, int]]:
        T = Triangulation(s(t), s.triangles_at(t))
        return {(min(a, b), max(a, b)) for a, b in T.diagonals.tolist()}

    for time in s.times[1:-1].tolist():
        before, after = diagonals(np.nextafter(time, 0.0)), diagonals(time)
        now = [event for event in s.events if event.time == time]
        assert {event.out for event in now} == before - after
        assert {event.into for event in now} == after - before
        for triangles in (s.triangles_at(np.nextafter(time, 0.0)), s.triangles_at(time)):
            assert verify(s(time), triangles)


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("loop", [False, True])
def test_all_paths_are_proved(path: Any, loop: bool) -> None:
    s = sequence(SMALL, loop=loop, path=path)
    assert certify(s, frames=25)
    assert len(s.legs) == 3 + loop


def test_two_shapes_make_a_loop_and_two_equal_ones_do_too() -> None:
    s = sequence([SQUARE, ELL], loop=True)
    assert s.frames(9)[0].tobytes() == s.frames(9)[-1].tobytes()
    same = sequence([ELL, ELL], loop=True)
    np.testing.assert_allclose(same.frames(5), np.broadcast_to(same.source.points, (5, 6, 2)), atol=1e-12)


@pytest.mark.parametrize("by", ["area", "box", "none"])
@pytest.mark.parametrize("scale", [0.1, 0.5, 7.3])
@pytest.mark.parametrize("place", range(4))
def test_neighbours_that_are_scaled_copies_make_a_loop_however_they_are_fitted(
    by: Any, scale: float, place: int
) -> None:
    shapes = [np.array(ELL, dtype=float), scale * np.array(ELL) + [10.3, -2.7], np.array(BAR), np.array(TRIANGLE)]
    shapes = shapes[place:] + shapes[:place]
    fitted = [Curve(shapes[0]), *(io.fit(shape, shapes[0], by) for shape in shapes[1:])]
    # to rounding, fitted neighbours are the same shape; where they are the first and the last they may be equal
    s = sequence(fitted, loop=True)
    assert len(s.keyframes) in ((3, 4) if place == 1 else (4,))
    assert certify(s, frames=25)
    assert s.frames(9)[0].tobytes() == s.frames(9)[-1].tobytes()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ell", "arrow", "horseshoe"])
def test_copies_of_gallery_curves_are_neighbours_too(name: str) -> None:
    first, others = gallery.curve(name), [gallery.curve(other) for other in ("ess", "three_lobes")]
    fitted = [io.fit(shape, first, "area") for shape in (Curve(0.1 * first.points), *others)]
    s = sequence([first, *fitted], loop=True)
    assert len(s.keyframes) == 4
    assert certify(s)


def test_the_first_keyframe_may_stand_at_the_end_of_a_loop_again() -> None:
    s, again = sequence([SQUARE, ELL, BAR], loop=True), sequence([SQUARE, ELL, BAR, SQUARE], loop=True)
    np.testing.assert_array_equal(s.frames(20), again.frames(20))
    assert len(sequence([SQUARE, ELL, BAR, SQUARE]).keyframes) == 4


def test_a_last_keyframe_that_has_come_to_equal_the_first_is_one_of_its_own_where_it_is_counted() -> None:
    shapes = [SQUARE, ELL, BAR, io.fit(np.array(SQUARE) / 2, SQUARE, "area").points]
    np.testing.assert_array_equal(shapes[0], shapes[-1])
    assert len(sequence(shapes, loop=True).keyframes) == 3
    for counted in ({"times": [0, 1, 2, 3, 4]}, {"landmarks": [(0, 0, 0, 0)]}):
        s = sequence(shapes, loop=True, **counted)
        assert len(s.keyframes) == 4
        assert certify(s, frames=25)


def test_two_keyframes_are_a_morph_with_an_ease_of_its_own() -> None:
    s, leg = sequence([SQUARE, ELL], ease="linear"), sequence([SQUARE, ELL]).legs[0]
    np.testing.assert_array_equal(s.frames(9), leg.frames(9))


def test_the_pace_is_that_of_every_leg() -> None:
    own, even = (sequence([SQUARE, ELL], ease="linear", placement="root", pace=pace) for pace in ("time", "speed"))
    ways = [np.sqrt((np.diff(s.frames(200), axis=0) ** 2).sum(axis=2).mean(axis=1)) for s in (own, even)]
    assert ways[1].std() < 0.02 * ways[1].mean() < ways[0].std()


@pytest.mark.slow
def test_the_disk_of_a_keyframe_with_several_is_chosen_for_the_whole() -> None:
    several = gallery.curve("two_disks")
    disks = decompose(several).immersions()
    assert len(disks) == 2
    for meant in disks:
        s = sequence([meant, several, meant])
        found = [s.keyframes[1], s.legs[0].target]
        same = [sequence([meant, meant, meant]).keyframes[1]]
        assert s.legs[0].source.areas.sum() == pytest.approx(same[0].areas.sum())
        assert [remesh(T).canonical.tolist() for T in found] == [remesh(same[0]).canonical.tolist()] * 2


def test_a_clockwise_array_keeps_its_own_numbers() -> None:
    s = sequence([SQUARE, ELL[::-1], TRIANGLE])
    given = s.vertices[1] >= 0
    np.testing.assert_array_equal(s.keyframes[1].points[given], np.array(ELL[::-1])[s.vertices[1][given]])


def test_landmarks_are_one_vertex_of_every_keyframe() -> None:
    s = sequence([SQUARE, ELL, BAR], loop=True, landmarks=[(0, 3, 2), (2, 0, 0)])
    for row in ((0, 3, 2), (2, 0, 0)):
        assert (s.vertices.T == row).all(axis=1).sum() == 1


# Time


def test_times_are_those_given_and_rests_are_rests() -> None:
    s = sequence([SQUARE, ELL, BAR], times=[10, 11, 14], hold=0.5)
    np.testing.assert_allclose(s.times, [0, 1 / 4.5, 4 / 4.5])
    for time in s.times:
        np.testing.assert_array_equal(s(time), s(min(1.0, time + 0.49 / 4.5)))
    assert (s(0.51 / 4.5) != s(0)).any()
    round_ = sequence([SQUARE, ELL, BAR], loop=True, hold=1)
    np.testing.assert_allclose(round_.times, [0, 1 / 3, 2 / 3, 1])
    np.testing.assert_array_equal(round_(1 / 6 - 1e-9), round_(0))
    assert (round_(1 - 1e-3) != round_(1)).any()


def test_every_leg_has_its_ease() -> None:
    s = sequence([SQUARE, ELL, BAR], ease=["linear", "cubic-bezier(0.42, 0, 1, 1)"])
    np.testing.assert_allclose(s(0.25), s.legs[0](0.5))
    slow = sequence([SQUARE, ELL, BAR], ease=(0.42, 0, 1, 1))
    np.testing.assert_allclose(s(0.75), slow(0.75))
    assert np.abs(s(0.25) - slow(0.25)).max() > 1e-3


# Refusals


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"keyframes": [SQUARE]}, "there is 1 keyframe, expected at least 2"),
        ({"keyframes": []}, "there are 0 keyframes, expected at least 2"),
        ({"times": [0, 1]}, "times are .*, expected 3 rising numbers"),
        ({"times": [0, 2, 1]}, "times are .*, expected 3 rising numbers"),
        ({"times": [0, 1, 2], "loop": True}, "expected 4 rising numbers, the last one for the first keyframe again"),
        ({"hold": -1}, "hold is -1, expected a number from 0"),
        ({"hold": 1, "times": [0, 1, 2]}, "hold is 1, expected a number from 0 to less than the time"),
        ({"ease": "bounce"}, "ease is 'bounce', expected"),
        ({"ease": ["linear"]}, "there are 1 eases, expected one, or 2"),
        ({"path": "straight"}, "path is 'straight', expected one of"),
        ({"placement": "best"}, "placement is 'best', expected one of"),
        ({"pace": "even"}, "pace is 'even', expected one of"),
        ({"root": 3}, "root is 3, expected one of"),
        ({"names": ["a"]}, "there are 1 names for 3 keyframes"),
    ],
)
def test_an_option_that_is_none_is_named(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sequence(**{"keyframes": [SQUARE, ELL, BAR]} | options)


@pytest.mark.parametrize(
    ("landmarks", "message"),
    [
        ([(0, 1)], r"landmark \(0, 1\) is none, expected 3 whole numbers"),
        ([(0, 6, 0)], r"landmark \(0, 6, 0\) is out of range: keyframe 1 has vertices 0 to 5"),
        ([(0, -1, 0)], "is out of range"),
    ],
)
def test_landmarks_that_are_none_are_refused(landmarks: Any, message: str) -> None:
    with pytest.raises(IncompatibleError, match=message):
        sequence([SQUARE, ELL, BAR], landmarks=landmarks)


def test_a_keyframe_that_bounds_no_disk_is_named_with_the_reason_and_its_file() -> None:
    shapes = [*SMALL, *SMALL]
    shapes[7] = EIGHT
    with pytest.raises(NotSelfOverlappingError, match=r"^keyframe 7 bounds no immersed disk: turning number is 0"):
        sequence(shapes)
    with pytest.raises(NotSelfOverlappingError, match=r"^keyframe 7 \(7\.svg\) bounds no immersed disk: "):
        sequence(shapes, names=[f"{i}.svg" for i in range(8)])
    shapes[7] = [[0, 0], [1, 0], [1, 0], [0, 1]]
    with pytest.raises(CurveError, match=r"^keyframe 7: edge 1-2 has zero length"):
        sequence(shapes)


@pytest.mark.slow
def test_two_hundred_keyframes_are_done_in_bounded_time_and_all_valid() -> None:
    rng = np.random.default_rng(3)
    shapes = []
    for _ in range(200):
        angle = np.linspace(0, 2 * np.pi, 7, endpoint=False)
        radius = rng.uniform(0.7, 1.3, 7)
        shapes.append(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1))
    s = sequence(shapes)
    assert len(s.keyframes) == 200 and len(s.source) <= 200 * 7
    for i in (0, 77, 199):
        np.testing.assert_array_equal(s(s.times[i]), s.keyframes[i].points)
    assert certify(s, frames=400)

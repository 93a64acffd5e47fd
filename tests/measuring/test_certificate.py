"""What a certificate refuses and why, that it agrees with two other routes, and what it says between the frames."""

import time
from dataclasses import FrozenInstanceError
from itertools import product
from pathlib import Path

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from strategies import disks, random_polygons

from tween import Triangulation, paper_morph, remesh, triangulate
from tween.errors import TriangulationError
from tween.gallery import curve, names, pair, random_disk
from tween.measuring import (
    certificate,
    frame_check,
    intervals,
    played,
    promise,
    refinement,
    slide_path,
    straight_motion,
)
from tween.measuring.certificate import certify, verify

TAU = 2 * np.pi
SQUARE = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
HALVES = [(0, 1, 2), (0, 2, 3)]
HEXAGON = [(2.0, 0.0), (1.0, 2.0), (-1.0, 2.0), (-2.0, 0.0), (-1.0, -2.0), (1.0, -2.0)]
HEPTAGON = [(x, x * x) for x in range(7)]
ELL = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]

# Every edge in two triangles, in opposite directions, and none of them on the curve.
OCTAHEDRON = [(a, b, c) if (a + b + c) % 2 else (a, c, b) for a, b, c in product((0, 1), (3, 4), (6, 7))]


def around_hub(degrees, radii=1.0):
    """Return points and triangles (0, i, i+1) around a hub in the origin, with the given angles there."""
    angles = np.radians(np.cumsum([0.0, *degrees]))
    rim = np.stack([np.cos(angles), np.sin(angles)], axis=1) * np.reshape(radii * np.ones(len(angles)), (-1, 1))
    return np.concatenate([[(0.0, 0.0)], rim]), [(0, i, i + 1) for i in range(1, len(angles))]


def fan(rho: float) -> tuple[Triangulation, Triangulation]:
    """Return two simple polygons between which the paper's paths leave the immersions, if rho is large."""

    def polygon(*steps: tuple[float, float]) -> Triangulation:
        degrees, factors = zip(*steps * 5, strict=True)
        return Triangulation(*around_hub(degrees, np.cumprod([1.0, *factors])))

    wide, narrow = (60.0, rho), (8.0, 1 / rho)
    return polygon(wide, narrow), polygon(narrow, wide)


class Scripted:
    """A morph made by hand: shapes as a function of time, lists of triangles, and the times between them."""

    def __init__(self, shape, *lists, changes=()) -> None:
        self._shape, self._lists, self._changes = shape, np.array(lists), np.array(changes)
        self.events = [type("Event", (), {"time": change}) for change in changes]

    def at(self, times) -> NDArray[np.float64]:
        return np.array([self._shape(t) for t in times], dtype=np.float64)

    def triangles_at(self, t: float) -> NDArray[np.int64]:
        return self._lists[np.searchsorted(self._changes, t, side="right")]


def opening(total) -> Scripted:
    """A fan of eight triangles whose angles at the hub, vertex 0, add up to total(t) radians."""
    return Scripted(lambda t: around_hub([np.degrees(total(t)) / 8] * 8)[0], around_hub([1.0] * 8)[1])


def is_valid(points, triangles) -> bool:
    try:
        return bool(Triangulation(points, triangles).validate())
    except TriangulationError:
        return False


# What is refused


LIMACON = around_hub([50.0] * 9)
TIGHT = around_hub([50.0] * 7)


@pytest.mark.parametrize(
    ("points", "triangles", "rule", "element"),
    [
        (*LIMACON, "at vertex 0 add up to 7.8540, more than 2 pi: the turning number is 2, not 1", 0),
        (SQUARE[::-1], HALVES, "triangle 0 [0, 1, 2] is not counter-clockwise", 0),
        ([(0, 0), (2, 0), (0.5, 0.5), (0, 2)], [(0, 1, 3), (1, 2, 3)], "triangle 1 [1, 2, 3] is not counter", 1),
        ([(0, 0), (1, 0), (2, 0), (0, 1)], HALVES, "triangle 0 [0, 1, 2] is not counter-clockwise", 0),
        (SQUARE, [(0, 1, 3), (0, 1, 2)], "edge 0-1 occurs twice in the same direction", (0, 1)),
        (SQUARE, [(0, 1, 2), (0, 3, 2)], "edge 2-0 occurs twice in the same direction", (2, 0)),
        (HEXAGON, [(0, 2, 3), (0, 3, 4), (0, 4, 5), (1, 3, 5)], "boundary edge 0-1 belongs to no triangle", (0, 1)),
        ([(x, x * x) for x in range(10)], OCTAHEDRON, "boundary edge 0-1 belongs to no triangle", (0, 1)),
        (SQUARE, [(0, 1, 2), (0, 2, 1)], "boundary edge 0-1 has a triangle on its right", (0, 1)),
        (SQUARE, [(0, 1, 2), (0, 3, 2)][::-1], "edge 2-0 occurs twice", (2, 0)),
        (SQUARE, [(0, 1, 2), (0, 3, 1)], "boundary edge 0-1 has a triangle on its right", (0, 1)),
        (
            HEXAGON,
            [(0, 1, 2), (0, 5, 4), (2, 3, 4), (1, 3, 5)],
            "boundary edge 5-0 has a triangle on its right",
            (5, 0),
        ),
        (HEXAGON, [(0, 1, 2), (2, 3, 4), (4, 5, 0), (1, 3, 5)], "diagonal 0-2 has no triangle on its other", (0, 2)),
        (
            HEPTAGON,
            [(0, 1, 6), (0, 2, 3), (0, 3, 4), (0, 4, 2), (4, 5, 6)],
            "triangle 1 is not joined to the others around vertex 0: the dual graph is no tree",
            1,
        ),
        (SQUARE, [(0, 1, 2), (0, 2, 4)], "triangle 1 is [0, 2, 4], expected three different vertices from 0 to 3", 1),
        (SQUARE, [(0, 1, -2), (0, 2, 3)], "triangle 0 is [0, 1, -2]", 0),
        (SQUARE, [(0, 1, 2), (0, 2, 2)], "triangle 1 is [0, 2, 2]", 1),
        (SQUARE, [(0, 1, 2)], "there are 1 triangles, expected 2 for 4 vertices", None),
        ([*SQUARE[:3], (np.nan, 1)], HALVES, "vertex 3 is (nan, 1.0), expected coordinates", 3),
        ([*SQUARE[:2], (1, np.inf), SQUARE[3]], HALVES, "vertex 2 is (1.0, inf)", 2),
        ([SQUARE[0], (1e-70, 0), *SQUARE[2:]], HALVES, "vertex 1 is (1e-70, 0.0)", 1),
        (1e61 * np.array(SQUARE), HALVES, "between 6e-61 and 2e+60 in magnitude", 1),
    ],
)
def test_the_broken_rule_is_named_with_its_time_and_its_element(points, triangles, rule: str, element) -> None:
    cert = verify(points, triangles)
    assert not cert
    assert cert.first_failure is not None
    assert rule in cert.first_failure.rule
    assert (cert.first_failure.t, cert.first_failure.element) == (0.0, element)
    assert (cert.frames_checked, cert.frames_failed) == (1, 1)


def test_triangles_that_overlap_around_a_vertex_are_no_disk_though_none_of_them_is_flipped() -> None:
    points, triangles = LIMACON
    assert all(oracle.orient2d(*oracle.fractions(points[list(t)])) > 0 for t in triangles)
    assert oracle.turning_number(points) == 2
    assert verify(*TIGHT).valid


def test_the_earliest_of_several_failures_is_named_in_whatever_order_the_frames_come() -> None:
    folded = np.array(SQUARE) * [1, -1]
    cert = verify([SQUARE, folded, folded, SQUARE], HALVES, times=[0.0, 9.0, 4.5, 2.0])
    assert cert.first_failure == (4.5, "triangle 0 [0, 1, 2] is not counter-clockwise", 0)
    assert (cert.frames_checked, cert.frames_failed) == (4, 2)
    assert "2 of them broken" in cert.proof


def test_each_frame_may_have_its_own_triangles() -> None:
    other, broken = [(0, 1, 3), (1, 2, 3)], [(0, 1, 3), (0, 2, 3)]
    assert verify([SQUARE] * 3, [HALVES, other, HALVES]).valid
    cert = verify([SQUARE] * 4, [HALVES, HALVES, broken, other])
    assert cert.first_failure is not None
    assert (cert.first_failure.t, cert.first_failure.element, cert.frames_failed) == (2 / 3, (3, 0), 1)


@pytest.mark.parametrize(
    ("last", "rule"),
    [
        ((2.0, -(2.0**-60)), None),
        ((2.0, 0.0), "vertex 0 is a spike: the angles there add up to exactly 2 pi"),
        ((2.0, 2.0**-60), "at vertex 0 add up to 6.2832, more than 2 pi: the turning number is 2, not 1"),
    ],
)
def test_an_angle_sum_of_exactly_two_pi_fails_and_one_just_below_does_not(last, rule) -> None:
    points = [(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), last]
    cert = verify(points, [(0, i, i + 1) for i in range(1, 5)])
    assert (cert.first_failure is None) if rule is None else (rule in cert.first_failure.rule)
    assert cert.valid == is_valid(points, [(0, i, i + 1) for i in range(1, 5)])


def test_a_spike_after_two_full_turns_is_one_too() -> None:
    compass = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    cert = verify([(0, 0), *compass, *compass, (2, 0)], [(0, i, i + 1) for i in range(1, 9)])
    assert cert.first_failure is not None
    assert cert.first_failure.rule == "vertex 0 is a spike: the angles there add up to exactly 4 pi"


@pytest.mark.parametrize(
    ("frames", "triangles", "times", "message"),
    [
        (np.zeros((4, 3)), HALVES, None, r"frames have shape \(4, 3\), expected \(k, n, 2\) or \(n, 2\)"),
        (SQUARE[:2], np.zeros((0, 3), int), None, r"frames have shape \(2, 2\)"),
        (np.zeros((0, 4, 2)), HALVES, None, r"frames have shape \(0, 4, 2\)"),
        (SQUARE, [(0, 1), (2, 3)], None, r"triangles have shape \(2, 2\), expected \(2, 3\) or \(1, 2, 3\)"),
        ([SQUARE] * 3, [HALVES] * 2, None, r"triangles have shape \(2, 2, 3\), expected \(2, 3\) or \(3, 2, 3\)"),
        (SQUARE, np.array(HALVES, dtype=float), None, "dtype float64, expected integers"),
        ([SQUARE] * 3, HALVES, [0.0, 1.0], r"times have shape \(2,\), expected \(3,\)"),
        (SQUARE, HALVES, [np.nan], "one finite number for each frame"),
    ],
)
def test_arrays_of_another_shape_are_misuse(frames, triangles, times, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        verify(frames, triangles, times)


def test_only_morphs_and_triangulations_are_certified_and_at_two_frames_or_more() -> None:
    with pytest.raises(ValueError, match="shape is a Curve, expected a Morph or a Triangulation"):
        certify(curve("ell"))
    with pytest.raises(ValueError, match="1 frames were asked for, expected at least 2"):
        certify(paper_morph(*fan(1.1)), frames=1)


# Other routes


@pytest.mark.parametrize("kind", ["scatter", "winding", "grid", "disk", "strip"])
def test_of_all_triangulations_of_a_polygon_those_valid_in_fractions_are_accepted(kind: str) -> None:
    found = set()
    for points in random_polygons(kind, 25, seed=3):
        every = [sorted(triangles) for triangles in oracle.triangulations(len(points))]
        valid = len(oracle.valid_triangulations(points))
        assert verify([points] * len(every), every).frames_failed == len(every) - valid
        found.add(valid > 0)
    assert True in found or kind in ("scatter", "winding")


@given(st.lists(st.integers(1, 170), min_size=1, max_size=24), st.integers(0, 2**32 - 1))
def test_the_turning_number_is_that_of_the_fractions(degrees: list[int], seed: int) -> None:
    points, triangles = around_hub(degrees, np.random.default_rng(seed).uniform(0.5, 2, len(degrees) + 1))
    cert = verify(points, triangles)
    if not oracle.is_polygon(points):
        assert "spike" in cert.first_failure.rule
    elif oracle.turning_number(points) == 1:
        assert cert.valid
    else:
        assert f"turning number is {oracle.turning_number(points)}, not 1" in cert.first_failure.rule


@given(disks(low=3, high=30), st.integers(0, 2**32 - 1), st.sampled_from([0, 0, 1, 2]))
def test_verify_agrees_with_validate_on_disks_whole_moved_or_broken(T: Triangulation, seed: int, breaks: int) -> None:
    rng = np.random.default_rng(seed)
    noise = rng.normal(size=(6, *T.points.shape)) * np.geomspace(1e-3, 1, 6).reshape(-1, 1, 1)
    triangles = T.triangles.copy()
    for _ in range(breaks):
        t, u = rng.integers(len(triangles), size=2)
        how = rng.integers(4)
        if how == 0:
            triangles[t] = triangles[u]
        elif how == 1:
            triangles[t] = triangles[t, ::-1]
        elif how == 2:
            triangles[t, rng.integers(3)] = rng.integers(len(T))
        else:
            triangles[t, :2], triangles[u, :2] = triangles[u, :2].copy(), triangles[t, :2].copy()
    for points in [T.points, *(T.points + noise)]:
        assert verify(points, triangles).valid == is_valid(points, triangles)


@given(disks(low=3), st.integers(0, 40), st.integers(-60, 60))
def test_neither_the_first_vertex_nor_the_scale_matters(T: Triangulation, shift: int, exponent: int) -> None:
    other = T.rolled(shift)
    cert, again = certify(T), verify(other.points * 2.0**exponent, other.triangles)
    assert cert.valid and again.valid
    assert again.max_angle == pytest.approx(cert.max_angle, rel=1e-12)
    assert again.min_area == pytest.approx(cert.min_area * 4.0**exponent, rel=1e-9)
    assert not verify(T.points * [-1, 1], T.triangles)


def test_only_the_predicates_are_shared_with_the_rest() -> None:
    modules = certificate, frame_check, straight_motion, played, refinement, promise, slide_path, intervals
    lines = [line for module in modules for line in Path(module.__file__).read_text().splitlines()]
    imports = {line.strip() for line in lines if line.strip().startswith(("from tween", "import tween"))}
    assert {line for line in imports if not line.startswith("from tween.measuring.")} == {
        "from tween.geometry.predicates import EXACT_RANGE, turn"
    }
    own = {f"tween.measuring.{module.__name__.split('.')[-1]}" for module in modules}
    assert {line.split()[1] for line in imports if line.startswith("from tween.measuring.")} <= own


@pytest.mark.parametrize("path", ["linear", "slide"])
def test_certify_agrees_with_validate_frame_by_frame_on_the_gallery(path) -> None:
    for name in names():
        T = triangulate(curve(name))
        m = paper_morph(T, T.on_disk(), path=path)
        cert = certify(m, frames=20)
        assert cert.valid
        assert all(is_valid(frame, T.triangles) for frame in m.frames(20))


def test_certify_agrees_with_validate_frame_by_frame_where_a_disk_is_left() -> None:
    refuted = 0
    for seed in range(8):
        T = remesh(random_disk(300, np.random.default_rng(seed)))
        m = paper_morph(T, T.on_disk())
        failed = [not is_valid(frame, T.triangles) for frame in m.frames(20)]
        cert = certify(m, frames=20)
        if any(failed):
            refuted += 1
            assert (cert.frames_checked, cert.frames_failed) == (20, sum(failed))
            assert cert.first_failure is not None
            assert cert.first_failure.t == np.linspace(0, 1, 20)[np.argmax(failed)]
        else:
            assert cert.frames_failed == 0 or cert.frames_checked > 20
    assert 0 < refuted < 8


# The paper's claim


@pytest.mark.parametrize("frames", [2, 3, 11, 41, 100])
def test_the_slide_between_two_fans_is_refuted(frames: int) -> None:
    source, target = fan(2.0)
    assert certify(source) and certify(target)
    m = paper_morph(source, target)
    failure = certify(m, frames).first_failure
    assert failure is not None
    assert failure.element == 0
    assert 0 < failure.t < 1
    places = oracle.fractions(m(failure.t))
    assert all(oracle.orient2d(*(places[v] for v in t)) > 0 for t in m.triangles_at(failure.t))
    assert oracle.turning_number(m(failure.t)) == 2
    hub = np.unwrap(np.arctan2(*(m(failure.t)[1:] - m(failure.t)[0]).T[::-1]))
    assert hub[-1] - hub[0] > TAU
    assert f"add up to {hub[-1] - hub[0]:.4f}, more than 2 pi" in failure.rule


def test_the_gentler_fan_is_fine() -> None:
    cert = certify(paper_morph(*fan(1.2)))
    assert cert.valid
    assert cert.frames_checked == 100


# Flips


@pytest.mark.parametrize("turned", [False, True])
def test_a_morph_with_flips_is_checked_under_both_triangulations_at_each_flip(turned: bool) -> None:
    m = paper_morph(*pair("arrow_to_horseshoe")[:: -1 if turned else 1])
    cert = certify(m, frames=30)
    assert cert.valid
    inner = {event.time for event in m.events} - {0.0, 1.0}
    assert inner
    assert cert.frames_checked >= 30 + 2 * len(inner)
    assert all(is_valid(m(t), m.triangles_at(t)) for t in [*np.linspace(0, 1, 30), *inner])


def dented(t: float) -> list[tuple[float, float]]:
    """A square whose corner 2 is pushed in past the diagonal 1-3 for t > 1/2."""
    return [(0.0, 0.0), (1.0, 0.0), (0.8 - 0.6 * t, 0.8 - 0.6 * t), (0.0, 1.0)]


@pytest.mark.parametrize(("change", "t", "element"), [(0.25, None, None), (0.75, 0.75, 1)])
def test_a_flip_that_comes_too_late_is_seen(change: float, t, element) -> None:
    across, along = [(0, 1, 3), (1, 2, 3)], [(0, 1, 2), (0, 2, 3)]
    cert = certify(Scripted(dented, across, along, changes=[change]), frames=2)
    if t is None:
        assert cert.valid
    else:
        failure = cert.first_failure
        assert (failure.t, failure.element, failure.rule[:10]) == (t, element, "triangle 1")


@pytest.mark.parametrize("change", [0.0, 0.25, 1.0])
def test_triangles_that_change_before_they_may_are_seen_at_the_flip(change: float) -> None:
    across, along = [(0, 1, 3), (1, 2, 3)], [(0, 1, 2), (0, 2, 3)]

    def pushed_out(t: float) -> list[tuple[float, float]]:
        return dented(1 - t) if change < 1 else dented(1.0)

    cert = certify(Scripted(pushed_out, along, across, changes=[change]), frames=2)
    assert cert.first_failure is not None
    assert (cert.first_failure.t, cert.first_failure.element) == (change, 1)


# Between the frames


def test_a_failure_that_five_frames_miss_is_found_by_refinement() -> None:
    m = paper_morph(*fan(1.86))
    assert verify(m.frames(5), m.source.triangles).valid
    cert = certify(m, frames=5)
    assert not cert.valid
    assert cert.frames_checked > 5
    assert oracle.turning_number(m(cert.first_failure.t)) == 2


def test_time_is_refined_where_an_angle_sum_comes_near_two_pi() -> None:
    cert = certify(opening(lambda t: TAU - 1e-3 - (t - 1 / 3) ** 2), frames=10)
    assert cert.valid
    assert 10 < cert.frames_checked < 100
    assert cert.proof.endswith("breaks no rule between them at the rates of change measured (an estimate)")
    assert certify(opening(lambda t: TAU - 1 - t), frames=10).frames_checked == 10
    assert not certify(opening(lambda t: TAU + 1e-4 - (t - 1 / 3) ** 2), frames=10)


@pytest.mark.parametrize("gap", [1e-2, 1e-3, 1e-4])
def test_refinement_does_not_depend_on_the_direction_of_time(gap: float) -> None:
    def total(t: float) -> float:
        return TAU - gap - max(0.3 - t, 4 * (t - 0.3))

    ahead, back = certify(opening(total), frames=9), certify(opening(lambda t: total(1 - t)), frames=9)
    assert ahead.valid and back.valid
    assert ahead.frames_checked == back.frames_checked > 9


def test_time_is_refined_where_a_triangle_gets_thin() -> None:
    def thin(height: float) -> Scripted:
        return Scripted(lambda t: [(0, 0), (1, 0), (0.5, height + (t - 0.3) ** 2), (0, 1)], HALVES[::-1])

    def sinking(height: float) -> Scripted:
        return Scripted(lambda t: [(0, 0), (1, 0), (2, height + (t - 0.3) ** 2), (0, 1)], HALVES)

    assert certify(thin(1.0), frames=6).frames_checked == 6
    assert certify(sinking(1e-3), frames=6).valid
    assert certify(sinking(1e-3), frames=6).frames_checked > 6
    failure = certify(sinking(-1e-4), frames=6).first_failure
    assert failure is not None
    assert (failure.rule, failure.element) == ("triangle 0 [0, 1, 2] is not counter-clockwise", 0)


def test_what_stays_in_doubt_at_the_smallest_step_is_said() -> None:
    cert = certify(opening(lambda t: TAU - 1e-9 - max(0.3 - t, 2 * (t - 0.3))), frames=10)
    assert cert.valid
    assert "down to the smallest step" in cert.proof
    assert "stay in doubt" in cert.proof


def test_refinement_stops_at_a_limit_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(refinement, "_MOST_ANGLES", 130)
    cert = certify(opening(lambda t: TAU - 1e-9 - max(0.3 - t, 2 * (t - 0.3))), frames=10)
    assert cert.valid
    assert cert.frames_checked <= 13
    assert "at the limit of 13 frames" in cert.proof


def test_a_promise_is_neither_believed_nor_repeated() -> None:
    m = paper_morph(*fan(1.86))
    m.proof = "every angle is interpolated"
    cert = certify(m, frames=5)
    assert not cert.valid
    assert "interpolated" not in cert.proof


def test_straight_motion_between_the_times_looked_at_is_checked_at_every_instant() -> None:
    def turning(t: float) -> NDArray[np.float64]:
        c, s = np.round([np.cos(np.pi * t), np.sin(np.pi * t)], 14)
        return np.array(SQUARE) @ np.array([[c, s], [-s, c]])

    assert verify([turning(0), turning(1)], HALVES).valid
    assert not verify([turning(0), turning(1)], HALVES, between="linear").valid
    cert = certify(Scripted(turning, HALVES), frames=2)
    assert cert.valid
    assert (cert.scope, cert.frames_checked, cert.intervals_checked, cert.intervals_failed) == ("playback", 3, 2, 0)
    assert cert.proof.startswith("checked for every instant of playback: exact at 3 frames and at every instant of")


def test_a_morph_that_jumps_where_straight_motion_breaks_is_refuted_though_each_frame_is_valid() -> None:
    cert = certify(Scripted(lambda t: np.array(SQUARE) * (1 if t < 0.3 else -1), HALVES), frames=5)
    assert not cert.valid
    assert (cert.frames_failed, cert.intervals_failed) == (0, 1)
    assert cert.first_failure.t == pytest.approx(0.3, abs=1e-5)
    assert "triangle 0 [0, 1, 2] loses its area between frames" in cert.first_failure.rule


def test_frames_alone_prove_nothing_about_the_times_between_them() -> None:
    cert = verify([SQUARE] * 2, HALVES)
    assert cert.proof == "checked at frames: exact at 2 frames; nothing is said about the times between them"
    assert (cert.scope, cert.intervals_checked, str(cert).splitlines()[0]) == ("frames", 0, "valid at these frames")
    assert verify(SQUARE, HALVES).proof == "checked at frames: exact at 1 frame"


# What it says


def test_the_smallest_triangle_and_the_largest_angle_are_reported_with_their_times() -> None:
    T = triangulate(ELL)
    cert = verify([2 * T.points, T.points, 3 * T.points], T.triangles, times=[0.0, 0.25, 1.0])
    assert (cert.min_area, cert.min_area_time) == (T.areas.min(), 0.25)
    assert cert.max_angle == pytest.approx(1.5 * np.pi)
    assert cert.max_angle_vertex == 3
    assert cert.max_angle_time in (0.0, 0.25, 1.0)


def test_frames_that_cannot_be_measured_leave_the_measures_to_the_others() -> None:
    nothing = np.full((4, 2), np.nan)
    assert verify([nothing, SQUARE], HALVES).min_area == 0.5
    cert = verify(nothing, HALVES)
    assert np.isnan([cert.min_area, cert.min_area_time, cert.max_angle, cert.max_angle_time]).all()
    assert cert.max_angle_vertex == -1
    assert "angle" not in str(cert)


@pytest.mark.parametrize("name", ["arrow", "pretzel"])
def test_a_triangulation_is_certified_by_itself(name: str) -> None:
    T = triangulate(curve(name))
    cert = certify(T)
    assert cert.valid and bool(cert)
    assert (cert.frames_checked, cert.min_area) == (1, pytest.approx(T.areas.min()))
    folded = certify(T.moved(T.points * [1, -1]))
    assert folded.first_failure is not None
    assert "not counter-clockwise" in folded.first_failure.rule


def test_a_certificate_is_read_by_people_and_not_changed() -> None:
    good, bad = certify(triangulate(ELL)), verify(*LIMACON)
    assert str(good).splitlines()[0] == "valid"
    assert str(bad).splitlines()[0].startswith("not valid at t = 0: the angles at vertex 0 add up to 7.8540")
    assert "largest angle sum: 7.8540 (2.5000 pi) at vertex 0, t = 0" in str(bad)
    assert len(str(good).splitlines()) <= 5
    with pytest.raises(FrozenInstanceError):
        good.proof = "none"


@pytest.mark.slow
def test_a_hundred_frames_of_a_thousand_vertices_take_less_than_two_seconds() -> None:
    T = random_disk(1000, np.random.default_rng(0))
    m = paper_morph(T, T.on_disk())
    certify(m, frames=2)
    start = time.perf_counter()
    certify(m, frames=100)
    assert time.perf_counter() - start < 2

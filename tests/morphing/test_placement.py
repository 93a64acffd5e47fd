"""The steady placement: area and centre change evenly, nothing turns but what is left over, shapes stay similar."""

from itertools import pairwise

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.integrate import cumulative_simpson

from tween import Morph, Triangulation, certify, morph, triangulate
from tween.choices import PATHS, Path
from tween.gallery import curve, fan, random_disk
from tween.morphing.compatible.leg import Leg
from tween.morphing.placement import Steady
from tween.morphing.strategy import morph_compatible

TIMES = np.linspace(0, 1, 9)


class Moving:
    """A leg as a motion, each shape turned and moved once more as told."""

    def __init__(self, T: Triangulation, path="angle", root: int = 0, spin=lambda t: 0 * t, drift=lambda t: 0 * t):
        self._leg, self._spin, self._drift = Leg(T, T.on_disk().points, path, root), spin, drift
        self.stages, self.events = [(0.0, T.triangles)], []

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        z = complex_of(self._leg.at(t)) * np.exp(1j * self._spin(t))[:, None] + self._drift(t)[:, None]
        return np.stack([z.real, z.imag], axis=-1)


def complex_of(points: NDArray[np.float64]) -> NDArray[np.complex128]:
    return points @ np.array([1, 1j])


def areas(shapes: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array([float(oracle.area(shape)) for shape in shapes])


def linear(values: NDArray) -> NDArray:
    return values[0] + TIMES * (values[-1] - values[0])


disks = st.tuples(st.integers(4, 30), st.integers(0, 10**6)).map(
    lambda given_: random_disk(given_[0], np.random.default_rng(given_[1]))
)


@given(disks, st.sampled_from(PATHS), st.booleans())
def test_the_ends_stay_to_the_last_bit(T: Triangulation, path, keeps_size: bool) -> None:
    ends = Steady(Moving(T, path), keeps_size).at(np.array([0.0, 1.0]))
    np.testing.assert_array_equal(ends, [T.points, T.on_disk().points])


@given(disks, st.sampled_from(PATHS))
def test_area_and_centre_change_evenly(T: Triangulation, path) -> None:
    shapes = Steady(Moving(T, path, drift=lambda t: (3 - 2j) * t * (1 - t)), False).at(TIMES)
    np.testing.assert_allclose(areas(shapes), linear(areas(shapes)), rtol=1e-9)
    centres = complex_of(shapes).mean(axis=1)
    np.testing.assert_allclose(centres, linear(centres), atol=1e-9 * np.ptp(shapes))


@given(disks, st.sampled_from(PATHS), st.booleans())
def test_every_shape_is_similar_to_that_of_the_motion(T: Triangulation, path, keeps_size: bool) -> None:
    motion = Moving(T, path)
    before, after = (complex_of(x.at(TIMES)) for x in (motion, Steady(motion, keeps_size)))
    ratio = (after - after[:, :1])[:, 1:] / (before - before[:, :1])[:, 1:]
    np.testing.assert_allclose(ratio, np.broadcast_to(ratio[:, :1], ratio.shape), rtol=1e-6)
    if keeps_size:
        np.testing.assert_allclose(abs(ratio), 1, rtol=1e-6)


def turning(motion, count: int = 2001) -> NDArray[np.float64]:
    """Return the angles by which consecutive shapes fit each other best, about their centres."""
    y = complex_of(motion.at(np.linspace(0, 1, count)))
    y -= y.mean(axis=1, keepdims=True)
    return np.angle((y[:-1].conj() * y[1:]).sum(axis=1))


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize("name", ["arrow", "horseshoe", "spiral_2"])
def test_it_turns_evenly_and_by_no_more_than_half_a_turn(name: str, path) -> None:
    turns = turning(Steady(Moving(triangulate(curve(name)), path), False))
    assert abs(turns.sum()) <= np.pi + 1e-6
    even = turns.sum() * np.arange(1, len(turns) + 1) / len(turns)
    # The rotation is known at 513 times: near a sudden turn of "metric" it is off by hundredths of a radian.
    np.testing.assert_allclose(np.cumsum(turns), even, atol=1e-5 if path in ("linear", "angle") else 1e-2)


@pytest.mark.parametrize("path", PATHS)
def test_without_it_these_motions_turn_unevenly(path) -> None:
    turns = turning(Moving(triangulate(curve("horseshoe")), path))
    even = turns.sum() * np.arange(1, len(turns) + 1) / len(turns)
    assert abs(np.cumsum(turns) - even).max() > 0.05


@pytest.mark.parametrize("name", ["arrow", "horseshoe", "spiral_2"])
def test_it_depends_on_no_root_where_shapes_do_not(name: str) -> None:
    T = triangulate(curve(name))
    first, other = (Steady(Moving(T, "angle", root), False).at(TIMES) for root in (0, 17))
    np.testing.assert_allclose(first, other, atol=1e-5 * np.ptp(first))


@pytest.mark.parametrize("spins", [0.7, -3.0, 9.0])
def test_what_a_motion_turns_and_drifts_beside_is_taken_away(spins: float) -> None:
    T = triangulate(curve("horseshoe"))
    plain = Steady(Moving(T), False).at(TIMES)
    spun = Moving(T, spin=lambda t: spins * np.sin(np.pi * t) ** 2, drift=lambda t: 5j * np.sin(np.pi * t))
    np.testing.assert_allclose(Steady(spun, False).at(TIMES), plain, atol=1e-5 * np.ptp(plain))


# Whole morphs

SMOOTH = ("linear", "angle")
NAMES = ("arrow", "horseshoe", "spiral_2")
every_name = pytest.mark.parametrize("name", NAMES)


def ends(name: str) -> tuple[Triangulation, Triangulation]:
    """A curve, and a disk that is larger and lies elsewhere."""
    T = triangulate(curve(name))
    return T, T.moved(1.7 * T.on_disk().points + [9.0, -4.0])


def size(m: Morph) -> float:
    return float(max(np.ptp(m.source.points), np.ptp(m.target.points)))


@pytest.mark.parametrize("guarantee", [False, True])
@pytest.mark.parametrize("path", [path for path in PATHS if path != "area"])
@every_name
def test_of_a_morph_the_area_and_the_centre_change_evenly(name: str, path: Path, guarantee: bool) -> None:
    shapes = morph_compatible(*ends(name), path, guarantee).at(TIMES)
    np.testing.assert_allclose(areas(shapes), linear(areas(shapes)), rtol=1e-12)
    centres = complex_of(shapes).mean(axis=1)
    np.testing.assert_allclose(centres, linear(centres), atol=1e-12 * np.ptp(shapes))


def rates(m: Morph, times: NDArray[np.float64], h: float = 1e-5) -> NDArray[np.float64]:
    """The net rotation about the centre of the vertices at some times, by central differences."""
    before, here, after = (complex_of(m.at(times + step)) for step in (-h, 0.0, h))
    y, dy = (z - z.mean(axis=1, keepdims=True) for z in (here, (after - before) / (2 * h)))
    return (y.conj() * dy).imag.sum(axis=1) / (abs(y) ** 2).sum(axis=1)


@pytest.mark.parametrize("path", SMOOTH)
@every_name
def test_a_morph_turns_by_nothing_but_the_even_rest(name: str, path: Path) -> None:
    times = np.linspace(1e-4, 1 - 1e-4, 2001)
    rate = rates(morph_compatible(*ends(name), path, guarantee=False), times)
    turned = cumulative_simpson(rate, x=times, initial=0.0)
    assert abs(turned[-1]) <= np.pi
    np.testing.assert_allclose(turned, turned[-1] * (times - times[0]) / (times[-1] - times[0]), atol=1e-6)


@pytest.mark.parametrize("path", PATHS)
@every_name
def test_a_morph_meets_both_ends_to_the_last_bit_and_does_not_jump_there(name: str, path: Path) -> None:
    m = morph_compatible(*ends(name), path)
    np.testing.assert_array_equal(m.at([0.0, 1.0]), [m.source.points, m.target.points])
    near = m.at([1e-9, 1 - 1e-9])
    np.testing.assert_allclose(near, [m.source.points, m.target.points], atol=1e-6 * size(m))


class Backwards:
    """A motion in reverse."""

    def __init__(self, motion: Moving):
        self._motion, self.stages, self.events = motion, motion.stages, motion.events

    def at(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        return self._motion.at(1 - t)


@given(disks, st.sampled_from(PATHS), st.booleans())
def test_a_motion_in_reverse_is_placed_as_before(T: Triangulation, path: Path, keeps_size: bool) -> None:
    motion = Moving(T, path)
    there, back = Steady(motion, keeps_size), Steady(Backwards(motion), keeps_size)
    np.testing.assert_allclose(there.at(TIMES), back.at(1 - TIMES), atol=1e-9 * np.ptp(T.points))


@pytest.mark.parametrize("factor", [0.01, 1j, 3 - 4j])
@pytest.mark.parametrize("path", PATHS)
def test_a_morph_follows_a_similarity_of_both_ends(path: Path, factor: complex) -> None:
    shapes = ends("arrow")
    moved = [factor * complex_of(T.points) + 5j for T in shapes]
    others = [T.moved(np.stack([z.real, z.imag], axis=-1)) for T, z in zip(shapes, moved, strict=True)]
    plain, other = (complex_of(morph_compatible(*both, path).at(TIMES)) for both in (shapes, others))
    np.testing.assert_allclose(other, factor * plain + 5j, atol=1e-8 * abs(factor) * np.ptp(shapes[1].points))


@pytest.mark.parametrize("guarantee", [False, True])
@pytest.mark.parametrize("path", PATHS)
def test_the_certificate_is_the_same_as_that_of_the_paper_s_placement(path: Path, guarantee: bool) -> None:
    for shapes in (fan(), ends("arrow")):
        rooted, steady = (certify(morph_compatible(*shapes, path, guarantee, p), 31) for p in ("root", "steady"))
        assert (rooted.valid, rooted.frames_failed) == (steady.valid, steady.frames_failed)
        assert rooted.max_angle == pytest.approx(steady.max_angle)
        if rooted.first_failure is not None:
            assert rooted.first_failure.t == steady.first_failure.t
            assert rooted.first_failure.element == steady.first_failure.element


def largest_steps(m: Morph) -> list[float]:
    return [float(np.abs(np.diff(m.frames(k + 1), axis=0)).max()) for k in (200, 400, 800)]


@pytest.mark.parametrize("path", PATHS)
@every_name
def test_the_largest_step_halves_where_the_frames_double(name: str, path: Path) -> None:
    steps = largest_steps(morph_compatible(*ends(name), path))
    assert all(1.7 < coarse / fine < 2.3 for coarse, fine in pairwise(steps))


@pytest.mark.parametrize("names", [("arrow", "ell"), ("ess", "horseshoe")], ids="-".join)
def test_flips_bring_no_jump(names: tuple[str, str]) -> None:
    m = morph(*map(curve, names), path="slide", guarantee=False, strategy="paper")
    assert m.events
    times = np.array([event.time for event in m.events])
    before, after = m.at(np.maximum(0, times - 1e-9)), m.at(np.minimum(1, times + 1e-9))
    assert np.abs(after - before).max() < 1e-5 * size(m)
    assert all(1.7 < coarse / fine < 2.3 for coarse, fine in pairwise(largest_steps(m)))
    shapes = m.at(TIMES)
    np.testing.assert_allclose(areas(shapes), linear(areas(shapes)), rtol=1e-12)

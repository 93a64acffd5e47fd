"""The steady placement: area and centre change evenly, nothing turns but what is left over, shapes stay similar."""

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from tween import Triangulation, triangulate
from tween.choices import PATHS
from tween.gallery import curve, random_disk
from tween.morphing.compatible.leg import Leg
from tween.morphing.placement import Steady

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
    # The rotation is known at 257 times: near a sudden turn of "metric" it is off by hundredths of a radian.
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

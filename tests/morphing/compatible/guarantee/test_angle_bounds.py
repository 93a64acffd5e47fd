"""Bounds of angles between two times: never below an angle that occurs, and close to it in short intervals."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tween import Triangulation, certify, gallery, morph, paper_morph, remesh, triangulate
from tween.choices import PATHS, Path
from tween.morphing.compatible.guarantee.angle_bounds import angle_bounds
from tween.morphing.compatible.guarantee.sum_search import vertex_sums
from tween.morphing.compatible.leg import Leg, root_triangle
from tween.morphing.compatible.paths import corner_angles, third_vertices

BOUNDED = [path for path in PATHS if path != "area"]
every_path = pytest.mark.parametrize("path", BOUNDED)
coordinates = st.floats(-3, 3).map(lambda x: round(x, 3))
heights = st.floats(0.001, 3).map(lambda y: round(y, 3) + 1e-3)
thirds = st.builds(complex, coordinates, heights)


def excess(path: Path, z1: complex, z2: complex, both: tuple[bool, bool], stretch: float, k: int) -> np.ndarray:
    """By how much bounds exceed the largest of 40 angles in each of k intervals; (3, k)."""
    about = np.array([z1]), np.array([z2]), np.array([both]), np.array([stretch])
    _, (bounds,) = angle_bounds(path, *about, np.linspace(0, 1, k + 1))
    angles = corner_angles(third_vertices(path, *about, np.linspace(0, 1, 40 * k + 1)))[0]
    inside = np.stack([angles[:, i : i + 40 * k : 40] for i in range(40)])
    return bounds - np.maximum(inside.max(axis=0), angles[:, 40::40])


@settings(max_examples=300)
@every_path
@given(z1=thirds, z2=thirds, both=st.tuples(st.booleans(), st.booleans()), stretch=st.floats(0.01, 100))
def test_no_angle_exceeds_its_bound(path: Path, z1: complex, z2: complex, both: tuple[bool, bool], stretch: float):
    assert excess(path, z1, z2, both, stretch, 7).min() > -1e-9


@every_path
def test_bounds_close_in_as_intervals_get_shorter(path: Path) -> None:
    z1, z2 = 0.2 + 0.5j, 1.3 + 0.4j
    gaps = [excess(path, z1, z2, (True, True), 1.7, k).max() for k in (16, 256)]
    assert gaps[1] < gaps[0] / 8 or gaps[1] < 1e-12


@every_path
def test_a_guaranteed_motion_is_below_two_pi_between_the_times_that_were_looked_at(path: Path) -> None:
    budgeted = 0
    for seed in range(6):
        T = remesh(gallery.random_disk(40, np.random.default_rng(seed)))
        D = T.on_disk()
        leg = Leg(T, D.points, path, root_triangle("disk-center", T, D), guarantee=True)
        budgeted += int(np.isfinite(leg.budgets.low).any())
        times = np.linspace(0, 1, 3001)
        sums = sum_of_angles(leg.source.triangles, leg.at(times))
        np.testing.assert_allclose(sums.sum(axis=0), 38 * np.pi)
        assert sums.max() < 2 * np.pi
    assert budgeted > 0 or path != "metric"


def sum_of_angles(triangles: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """The sums of angles at all vertices, from the shapes alone; (n, k)."""
    a, b, c = (shapes[:, triangles[:, s]] @ np.array([1, 1j]) for s in range(3))
    angles = np.stack([np.angle((q - p) / (r - p)) for p, q, r in ((a, c, b), (b, a, c), (c, b, a))])
    return vertex_sums(triangles, angles.transpose(2, 0, 1), shapes.shape[1])


def test_where_bounds_prove_it_no_budget_is_given_and_the_morph_says_so() -> None:
    T = triangulate(gallery.curve("horseshoe"))
    m = morph(T, T.on_disk(), path="slide", guarantee=True, placement="root")
    np.testing.assert_array_equal(m.frames(20), morph(T, T.on_disk(), "slide", False, placement="root").frames(20))
    assert "proved in doubles" in m.proof
    assert certify(m).valid


@pytest.mark.parametrize("path", PATHS)
def test_what_is_proved_is_said_and_nothing_else(path: Path) -> None:
    T = Triangulation([[0, 0], [3, 0], [3, 1], [1, 1]], [[0, 1, 2], [0, 2, 3]])
    assert bool(paper_morph(T, T.on_disk(), path=path).proof) == (path == "angle")
    assert morph(T, T.on_disk(), path=path, guarantee=True).proof


def test_the_fan_gets_budgets_along_the_paths_of_the_paper() -> None:
    source, target = gallery.fan()
    for path in ("linear", "slide"):
        leg = Leg(source, target.points, path, 0, guarantee=True)
        assert np.isfinite(leg.budgets.low).any()

"""Edges that meet, and curves as they arrive: closed rings, masks, complex numbers, numbers beyond doubles."""

import numpy as np
import oracle
import pytest

from tween import Curve, CurveError, Triangulation
from tween.errors import TriangulationError
from tween.geometry import meeting_edges as module
from tween.geometry.meeting_edges import meeting_edges

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.fixture(params=[0, 200], ids=["tree", "all pairs"])
def way(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both ways of finding them: few edges are compared pair by pair, many by the tree of slabs."""
    monkeypatch.setattr(module, "_SMALL", request.param)


def turned(points: np.ndarray, degrees: float) -> np.ndarray:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return points @ np.array([[c, s], [-s, c]])


def comb(teeth: int) -> np.ndarray:
    """A comb whose teeth are as high as they are many."""
    x, high = np.arange(2.0 * teeth), np.resize([0, teeth, teeth, 0], 4 * teeth)
    top = np.stack([np.repeat(x, 2), high], axis=1)
    return np.concatenate([[[0, -1]], top, [[2 * teeth - 1, -1]]])[::-1]


def gear(teeth: int) -> np.ndarray:
    """Teeth in all directions."""
    angle = 2 * np.pi * np.arange(2 * teeth) / (2 * teeth)
    radius = np.resize([1, 50, 50, 1], 4 * teeth)
    return radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1).repeat(2, axis=0)


def polygons_of(kind: str, rng: np.random.Generator) -> np.ndarray:
    n = int(rng.integers(13, 70))
    if kind == "lattice":
        return rng.integers(-4, 5, (n, 2)).astype(float)
    if kind == "few abscissas":
        return rng.integers(0, 30, (n, 2)) * [10.0, 1.0] // [100.0, 1.0]
    if kind == "long and slanting":
        return turned(np.cumsum(rng.integers(-3, 4, (n, 2)), axis=0) * [1.0, 200.0], 40)
    return np.float64(2.0) ** rng.integers(-30, 30, (n, 1)) * rng.normal(size=(n, 2))


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("kind", ["lattice", "few abscissas", "long and slanting", "of all sizes"])
def test_edges_that_meet_are_those_of_all_pairs(kind: str) -> None:
    rng, tried = np.random.default_rng(len(kind)), 0
    while tried < 60:
        points = polygons_of(kind, rng)
        if oracle.is_polygon(points):
            tried += 1
            pairs, proper = meeting_edges(points)
            assert dict(zip(map(tuple, pairs.tolist()), proper.tolist(), strict=True)) == oracle.crossings(points)
            assert pairs.tolist() == sorted(pairs.tolist())


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("degrees", [0, 40, 45, 89.9])
@pytest.mark.parametrize("make", [comb, gear])
def test_teeth_side_by_side_meet_only_where_they_do(make, degrees: float) -> None:
    points = turned(make(20), degrees)
    pairs, proper = meeting_edges(points)
    assert dict(zip(map(tuple, pairs.tolist()), proper.tolist(), strict=True)) == oracle.crossings(points)


@pytest.mark.usefixtures("way")
@pytest.mark.parametrize("n", [13, 40])
def test_where_the_list_starts_changes_numbers_alone(n: int) -> None:
    points = np.random.default_rng(n).integers(-5, 6, (n, 2)).astype(float)
    expected = {tuple(sorted((i, j))) for i, j in meeting_edges(points)[0].tolist()}
    rolled = meeting_edges(np.roll(points, -3, axis=0))[0]
    assert {tuple(sorted(((i + 3) % n, (j + 3) % n))) for i, j in rolled.tolist()} == expected


@pytest.mark.parametrize("kind", ["lattice", "few abscissas", "long and slanting", "of all sizes"])
def test_both_ways_agree_on_many_edges(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(7)
    points = np.concatenate([polygons_of(kind, rng) for _ in range(12)])
    points = points[(points != np.roll(points, -1, axis=0)).any(axis=1)]
    tree = meeting_edges(points)
    monkeypatch.setattr(module, "_SMALL", len(points))
    plain = meeting_edges(points)
    assert len(points) > 200
    assert np.array_equal(tree[0], plain[0]) and np.array_equal(tree[1], plain[1])


# Input


@pytest.mark.parametrize(
    "ring", [[*SQUARE, SQUARE[0]], [*SQUARE[::-1], SQUARE[-1]], [(0, 0), (1, 0), (0, 1), (0, -0.0)]]
)
def test_a_closed_ring_loses_the_point_that_repeats_the_first(ring: list) -> None:
    closed, open_ = Curve(ring), Curve(ring[:-1])
    np.testing.assert_array_equal(closed.points, open_.points)
    np.testing.assert_array_equal(closed.origin, open_.origin)


def test_of_a_ring_that_is_closed_twice_only_one_point_is_dropped() -> None:
    with pytest.raises(CurveError, match="edge 4-0 has zero length"):
        Curve([*SQUARE, SQUARE[0], SQUARE[0]])
    with pytest.raises(CurveError, match="zero length"):
        Curve([(0, 0), (1, 0), (0, 0)])


def test_a_triangulation_whose_last_vertex_repeats_the_first_has_no_curve() -> None:
    T = Triangulation([*SQUARE, SQUARE[0]], [(0, 1, 2), (0, 2, 3), (0, 3, 4)])
    with pytest.raises((CurveError, TriangulationError), match="zero length"):
        _ = T.curve


def test_a_mask_that_hides_something_is_refused_and_one_that_hides_nothing_is_not() -> None:
    points = np.ma.masked_array(SQUARE, mask=[[0, 0], [0, 0], [0, 1], [0, 0]])
    with pytest.raises(CurveError, match="vertex 2 is masked"):
        Curve(points)
    assert len(Curve(np.ma.masked_array(SQUARE))) == 4


@pytest.mark.parametrize("points", [np.array(SQUARE) * (1 + 1j), np.array([0, 1, 1 + 1j, 1j])])
def test_complex_numbers_are_refused_and_what_is_expected_is_said(points: np.ndarray) -> None:
    with pytest.raises(CurveError, match=r"complex, of shape .*z\.real, z\.imag"):
        Curve(points)


def test_a_number_beyond_all_doubles_is_named() -> None:
    with pytest.raises(CurveError, match="vertex 1 has a coordinate beyond the largest double"):
        Curve([(0, 0), (10**400, 0), (0, 1)])

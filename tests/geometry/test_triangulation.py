"""The rules of a triangulation, its parts, the disk, and compatibility."""

from itertools import combinations, permutations, product

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import disks

from tween import Triangulation, TweenError, decompose
from tween.errors import TriangulationError
from tween.gallery import curve, names, random_disk
from tween.geometry.triangulation import canonical

SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
HALVES = [(0, 1, 2), (0, 2, 3)]
HEXAGON = [(2, 0), (1, 2), (-1, 2), (-2, 0), (-1, -2), (1, -2)]


# Every edge in two triangles, in opposite directions, and none of them on the curve.
OCTAHEDRON = [(a, b, c) if (a + b + c) % 2 else (a, c, b) for a, b, c in product((0, 1), (3, 4), (6, 7))]


def fan(degrees: list[float], radii: list[float] | None = None) -> Triangulation:
    """Return the triangles (0, i, i+1) around a hub in the origin, with the given angles there."""
    angles = np.radians(np.cumsum([0.0, *degrees]))
    rim = np.stack([np.cos(angles), np.sin(angles)], axis=1) * np.reshape(radii or np.ones(len(angles)), (-1, 1))
    return Triangulation(np.concatenate([[(0.0, 0.0)], rim]), [(0, i, i + 1) for i in range(1, len(angles))])


# What is refused


@pytest.mark.parametrize(
    ("points", "triangles", "message"),
    [
        (SQUARE, [(0, 1, 2), (0, 3, 2)], "edge 2-0 occurs twice in the same direction"),
        (SQUARE, [(0, 1, 2), (0, 1, 2)], "edge 0-1 occurs twice in the same direction"),
        (SQUARE, [(0, 1, 2), (0, 2, 1)], "boundary edge 0-1 has triangles on both sides"),
        (SQUARE, [(0, 2, 1), (0, 3, 2)], "diagonal 2-1 has no triangle on its other side"),
        (HEXAGON, [(0, 1, 2), (2, 3, 4), (4, 5, 0), (1, 3, 5)], "diagonal 2-0 has no triangle on its other side"),
        ([(x, x * x) for x in range(10)], OCTAHEDRON, "boundary edge 0-1 belongs to no triangle"),
        ([(0, 0), (2, 0), (0.5, 0.5), (0, 2)], [(0, 1, 3), (1, 2, 3)], r"triangle 1 \[1, 2, 3\] is not counter-clock"),
        ([(0, 0), (1, 0), (2, 0), (0, 1)], [(0, 1, 2), (0, 2, 3)], r"triangle 0 \[0, 1, 2\] is not counter-clockwise"),
        (SQUARE[::-1], HALVES, "triangle 0 .* is not counter-clockwise"),
        (
            [(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), (2, 0)],
            [(0, i, i + 1) for i in range(1, 5)],
            "vertex 0 is a spike",
        ),
    ],
)
def test_validate_names_the_broken_rule(points, triangles, message: str) -> None:
    T = Triangulation(points, triangles)
    with pytest.raises(TriangulationError, match=message):
        T.validate()


def test_a_limacon_breaks_no_rule_but_the_turning_number() -> None:
    limacon = fan([50.0] * 9)  # 450 degrees around the hub
    assert all(oracle.orient2d(*oracle.fractions(limacon.points[t])) > 0 for t in limacon.triangles)
    assert oracle.turning_number(limacon.points) == 2
    with pytest.raises(TriangulationError, match="turning number of the boundary is 2, not 1"):
        limacon.validate()
    fan([50.0] * 7).validate()


def test_a_lost_edge_of_the_dual_is_noticed() -> None:
    # By Euler's formula n - 2 triangles that keep the rules for edges are connected: with wrong twins they are not.
    T = Triangulation(HEXAGON, [(0, 1, 2), (0, 2, 4), (2, 3, 4), (0, 4, 5)])
    lost = T.twin.copy()
    lost[2, lost[2] >= 0], lost[1, lost[1] // 3 == 2] = -1, -1
    vars(T)["twin"] = lost
    with pytest.raises(TriangulationError, match=r"triangle 2 is not connected to triangle 0"):
        T.validate()


@pytest.mark.parametrize("n", [3, 4, 5])
def test_of_all_sets_of_triples_exactly_the_triangulations_are_accepted(n: int) -> None:
    points = [(x, x * x) for x in range(n)]
    triples = [t for t in permutations(range(n), 3) if t[0] == min(t)]
    accepted = []
    for triangles in combinations(triples, n - 2):
        try:
            accepted.append(oracle.as_set(Triangulation(points, triangles).validate().triangles))
        except TriangulationError:
            continue
    assert sorted(map(sorted, accepted)) == sorted(map(sorted, oracle.triangulations(n)))


@pytest.mark.parametrize(
    ("points", "triangles", "message"),
    [
        (np.zeros((4, 3)), HALVES, r"points have shape \(4, 3\)"),
        (SQUARE[:2], np.zeros((0, 3), int), r"points have shape \(2, 2\)"),
        (SQUARE, HALVES[:1], r"triangles have shape \(1, 3\), expected \(2, 3\) for 4 points"),
        (SQUARE, [(0, 1), (2, 3)], r"triangles have shape \(2, 2\)"),
        (SQUARE, [(0.0, 1.0, 2.0), (0.0, 2.0, 3.0)], "dtype float64, expected integers"),
        (SQUARE, [("a", "b", "c")] * 2, "expected integers"),
        (SQUARE, [(0, 1, 2), (0, 2, 4)], r"triangle 1 is \[0, 2, 4\], expected vertices from 0 to 3"),
        (SQUARE, [(0, 1, -2), (0, 2, 3)], r"triangle 0 is \[0, 1, -2\]"),
    ],
)
def test_arrays_that_cannot_be_a_triangulation_are_refused(points, triangles, message: str) -> None:
    with pytest.raises(TriangulationError, match=message) as caught:
        Triangulation(points, triangles)
    assert isinstance(caught.value, ValueError)
    assert isinstance(caught.value, TweenError)


@pytest.mark.parametrize("scale", [1e-200, 1e200])
def test_points_outside_the_exact_range_are_refused_by_their_range(scale: float) -> None:
    with pytest.raises(TriangulationError, match="magnitude"):
        Triangulation(np.array(SQUARE) * scale, HALVES).validate()


def test_an_unknown_spacing_is_refused() -> None:
    with pytest.raises(ValueError, match="even"):
        Triangulation(SQUARE, HALVES).on_disk("even")


# Parts


@given(disks())
def test_the_dual_is_a_tree_and_its_edges_are_the_diagonals(T: Triangulation) -> None:
    n = len(T)
    assert T.dual.shape == T.diagonals.shape == (n - 3, 2)
    assert max(oracle.distances(T.triangles, 0)) < n  # all were reached
    for (s, t), diagonal in zip(T.dual, T.diagonals, strict=True):
        assert set(T.triangles[s]) & set(T.triangles[t]) == set(diagonal)
    assert {tuple(sorted(d)) for d in T.diagonals.tolist()} == set(oracle.quadrilaterals(T.triangles))


@given(disks())
def test_degrees_count_the_edges_at_each_vertex(T: Triangulation) -> None:
    edges = {tuple(sorted(e)) for t in T.triangles.tolist() for e in combinations(t, 2)}
    assert T.degrees.tolist() == [sum(v in e for e in edges) for v in range(len(T))]
    assert T.degrees.sum() == 2 * (2 * len(T) - 3)


@given(disks())
def test_areas_add_up_to_that_of_the_curve(T: Triangulation) -> None:
    exact = [oracle.area(T.points[t]) for t in T.triangles]
    assert sum(exact) == oracle.area(T.points)
    np.testing.assert_allclose(T.areas, [float(a) for a in exact], rtol=1e-11)


def test_a_triangulation_cannot_be_changed_and_copies_its_input() -> None:
    points, triangles = np.array(SQUARE, float), np.array(HALVES)
    T = Triangulation(points, triangles)
    points[:], triangles[:] = 7, 0
    assert (T.points.tolist(), T.triangles.tolist()) == (np.array(SQUARE).tolist(), np.array(HALVES).tolist())
    for array in (T.points, T.triangles, T.twin):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@given(st.lists(st.floats(5, 170), min_size=1, max_size=12))
def test_a_fan_turns_once_more_for_each_full_turn_at_its_hub(degrees: list[float]) -> None:
    full, rest = divmod(sum(degrees), 360)
    if not 1e-6 < rest < 360 - 1e-6:
        return
    T = fan(degrees)
    assert oracle.turning_number(T.points) == 1 + full
    if full:
        with pytest.raises(TriangulationError, match=f"turning number of the boundary is {1 + int(full)}, not 1"):
            T.validate()
    else:
        T.validate()


@given(disks(), st.integers(-100, 100))
def test_rolling_there_and_back_is_nothing(T: Triangulation, shift: int) -> None:
    R = T.rolled(shift).validate()
    np.testing.assert_array_equal(R.points[0], T.points[shift % len(T)])
    np.testing.assert_array_equal(R.points[R.triangles], T.points[T.triangles])
    back = R.rolled(-shift)
    np.testing.assert_array_equal(back.points, T.points)
    np.testing.assert_array_equal(back.triangles, T.triangles)


@given(disks(), st.randoms(use_true_random=False))
def test_the_canonical_form_forgets_order_and_first_corner_alone(T: Triangulation, random) -> None:
    rows = [tuple(np.roll(t, random.randrange(3))) for t in T.triangles.tolist()]
    random.shuffle(rows)
    S = Triangulation(T.points, rows)
    np.testing.assert_array_equal(S.canonical, T.canonical)
    assert oracle.as_set(T.canonical) == oracle.as_set(T.triangles)
    assert (T.canonical.min(axis=1) == T.canonical[:, 0]).all()
    assert (canonical(T.triangles[:, ::-1]) != T.canonical).any()


# The disk


def assert_on_circle(D: Triangulation, area: float) -> np.ndarray:
    """Check that the vertices lie in order on one circle of a given area; return the angles between them."""
    D.validate()
    ring = D.points
    turns = [oracle.orient2d(*oracle.fractions(ring[[i - 1, i, (i + 1) % len(ring)]])) for i in range(len(ring))]
    assert set(turns) == {1}
    z = ring @ np.array([1, 1j])
    radius = np.sqrt(area / np.pi)
    # The centre, by least squares of |z|^2 = 2 Re(centre * conj(z)) + constant.
    local = z - z.mean()
    rows = np.stack([2 * local.real, 2 * local.imag, np.ones(len(z))], axis=1)
    x, y, _ = np.linalg.lstsq(rows, np.abs(local) ** 2, rcond=None)[0]
    np.testing.assert_allclose(np.abs(local - (x + 1j * y)), radius, rtol=1e-9)
    return np.angle(np.roll(local - (x + 1j * y), -1) / (local - (x + 1j * y)))


@given(disks(4), st.sampled_from(["arc", "uniform"]))
def test_the_disk_has_the_same_triangles_and_area(T: Triangulation, spacing) -> None:
    D = T.on_disk(spacing)
    np.testing.assert_array_equal(D.triangles, T.triangles)
    gaps = assert_on_circle(D, float(oracle.area(T.points)))
    lengths = np.hypot(*(np.roll(T.points, -1, axis=0) - T.points).T)
    share = lengths / lengths.sum() if spacing == "arc" else 1 / len(T)
    np.testing.assert_allclose(gaps, 2 * np.pi * share * np.ones(len(T)), rtol=1e-6)


def test_the_circle_has_the_area_to_twelve_digits() -> None:
    T = random_disk(50, np.random.default_rng(0))
    D = T.on_disk("uniform")
    z = D.points @ np.array([1, 1j])
    assert np.pi * np.abs(z - z.mean()).mean() ** 2 == pytest.approx(float(oracle.area(T.points)), rel=1e-12)


@pytest.mark.parametrize("name", names())
@pytest.mark.parametrize("spacing", ["arc", "uniform"])
def test_gallery_curves_go_to_the_disk(name: str, spacing) -> None:
    T = decompose(curve(name)).arbitrary()
    assert_on_circle(T.on_disk(spacing), float(oracle.area(T.points)))


@pytest.mark.parametrize("n", [10, 1000])
def test_extremely_uneven_edges_leave_the_disk_strictly_convex(n: int) -> None:
    x = np.concatenate([np.linspace(0, 1e-9 * n, n), [1.0]])
    T = Triangulation(np.stack([x, x * x], axis=1), [(0, i, i + 1) for i in range(1, n)])
    for spacing in ("arc", "uniform"):
        T.on_disk(spacing).validate()


@pytest.mark.parametrize("scale", [2.0**-90, 1.0, 2.0**90])
def test_the_disk_follows_a_similarity(scale: float) -> None:
    T = random_disk(30, np.random.default_rng(1))
    turn, shift = np.array([[0.6, 0.8], [-0.8, 0.6]]), np.array([3.0, -2.0])
    S = Triangulation((T.points @ turn + shift) * scale, T.triangles)
    np.testing.assert_allclose(S.on_disk().points / scale, T.on_disk().points @ turn + shift, atol=1e-9)


# Compatibility


def test_a_triangulation_says_its_size() -> None:
    T = Triangulation(SQUARE, HALVES)
    assert (len(T), repr(T)) == (4, "Triangulation(4 vertices, 2 triangles)")

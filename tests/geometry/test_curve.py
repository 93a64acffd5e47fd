"""Curves: what is refused, turning number, area, inserted vertices."""

from itertools import pairwise

import numpy as np
import oracle
import pytest
from hypothesis import given
from hypothesis import strategies as st
from strategies import Points, grid_polygons, polygons, random_polygons, short_polygons

from tween import Curve, CurveError, TweenError
from tween.geometry.curve import as_curve, turning_number
from tween.geometry.predicates import EXACT_RANGE

NAN, INF = float("nan"), float("inf")
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]
EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]


def star(points: int, step: int) -> np.ndarray:
    """Return the star polygon {points/step}, which turns `step` times."""
    angles = 2 * np.pi * step * np.arange(points) / points
    return np.stack([np.cos(angles), np.sin(angles)], axis=1)


# What is refused


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(0, 0), (1, NAN), (1, 1)], r"vertex 1 is \(1, nan\), expected finite"),
        ([(0, 0), (1, 0), (INF, 1)], r"vertex 2 is \(inf, 1\), expected finite"),
        ([(-INF, 0), (NAN, 0), (1, 1)], r"vertex 0 is \(-inf, 0\)"),
        ([(0, 0), (1, 0)], "at least 3 vertices, found 2"),
        (np.zeros((0, 2)), "at least 3 vertices, found 0"),
        ([], r"shape \(0,\), expected \(n, 2\)"),
        (1.0, r"shape \(\), expected \(n, 2\)"),
        (np.zeros((4, 3)), r"shape \(4, 3\), expected \(n, 2\)"),
        (np.zeros((2, 2, 2)), r"shape \(2, 2, 2\), expected \(n, 2\)"),
        ([(0, 0), (1,), (1, 1)], "no array of numbers"),
        ([("a", "b")] * 3, "no array of numbers"),
        ("curve", "no array of numbers"),
        (None, r"expected \(n, 2\)"),
        ([(0, 0), (1j, 0), (1, 1)], "no array of numbers"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], r"edge 1-2 has zero length: vertices 1 and 2 are both at \(1, 0\)"),
        ([(0, 0), (3, 0), (1, 0), (1, 1)], r"vertex 1 at \(3, 0\) is a spike"),
        ([(0, 0), (2, 2), (3, 0), (1, 1)], r"vertex 0 at \(0, 0\) is a spike"),
        ([(1, 1), (3, 0), (2, 2), (0, 0)], r"vertex 3 at \(0, 0\) is a spike"),
        ([(0, 0), (1, 1), (2, 2)], "spike"),
        ([(0, 0), (2 * EXACT_RANGE[1], 0), (0, 1)], r"vertex 1 .* scale the curve"),
        ([(0, 0), (1, 0), (0, EXACT_RANGE[0] / 2)], "vertex 2 .* scale the curve"),
        ([(5e-324, 0), (1, 0), (0, 1)], "vertex 0 .* scale the curve"),
        ([(0, 0), (1, -2.2e-308), (0, 1)], "vertex 1 .* scale the curve"),
    ],
)
def test_a_bad_curve_is_refused_by_a_message_that_names_the_vertex(points, message: str) -> None:
    with pytest.raises(CurveError, match=message) as caught:
        Curve(points)
    assert isinstance(caught.value, ValueError)
    assert isinstance(caught.value, TweenError)


@given(polygons, st.data())
def test_a_way_out_and_back_is_a_spike_wherever_it_stands(points: Points, data: st.DataObject) -> None:
    at = data.draw(st.integers(0, len(points) - 1))
    here, after = points[at], points[(at + 1) % len(points)]
    with pytest.raises(CurveError, match=f"vertex {at + 1} at .* is a spike"):
        Curve([*points[: at + 1], after, here, *points[at + 1 :]])


@pytest.mark.parametrize("extra", [0.25, 0.5, 0.75])
def test_straight_angles_are_no_spikes(extra: float) -> None:
    assert len(Curve([(0, 0), (extra, 0), (1, 0), (1, extra), (1, 1), (extra, extra)])) == 6


@pytest.mark.parametrize("size", EXACT_RANGE)
def test_both_ends_of_the_exact_range_are_accepted(size: float) -> None:
    assert Curve(np.array(SQUARE) * size).turning_number == 1


def test_the_input_is_neither_changed_nor_kept() -> None:
    points = np.array([(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, -0.0)])
    before = points.tobytes()
    c = Curve(points)
    kept = c.points.copy()
    assert points.tobytes() == before
    points[:] = 7
    np.testing.assert_array_equal(c.points, kept)


def test_a_curve_cannot_be_changed() -> None:
    c = Curve(EIGHT)
    for array in (c.points, c.origin, c.crossings.pairs, c.crossings.proper, c.insert_vertices(7).origin):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    for name in ("points", "turning_number", "reversed_input", "origin"):
        with pytest.raises(AttributeError):
            setattr(c, name, None)


# Turning number, area, orientation


@pytest.mark.parametrize("kind", ["scatter", "winding", "disk"])
def test_the_turning_number_is_the_sum_of_the_turns(kind: str) -> None:
    for points in random_polygons(kind, 200, seed=1):
        edges = np.roll(points, -1, axis=0) - points
        z = edges @ np.array([1, 1j])
        assert turning_number(points) == round(float(np.angle(z / np.roll(z, 1)).sum()) / (2 * np.pi))


@given(polygons)
def test_the_turning_number_is_exact(points: Points) -> None:
    assert turning_number(np.array(points)) == oracle.turning_number(points)


@pytest.mark.parametrize(("n", "step"), [(3, 1), (5, 2), (7, 3), (9, 4), (50, 1), (50, 7), (101, 50)])
def test_star_polygons_turn_as_often_as_they_wind(n: int, step: int) -> None:
    assert Curve(star(n, step)).turning_number == step
    clockwise = Curve(star(n, step)[::-1])
    assert (clockwise.turning_number, clockwise.reversed_input) == (step, True)


def test_a_figure_eight_does_not_turn() -> None:
    assert [Curve(p).turning_number for p in (EIGHT, EIGHT[::-1])] == [0, 0]
    assert not Curve(EIGHT).reversed_input


@given(polygons)
def test_a_clockwise_curve_is_traversed_the_other_way_round(points: Points) -> None:
    c, turns = Curve(points), oracle.turning_number(points)
    assert c.reversed_input == (turns < 0)
    assert c.turning_number == abs(turns)
    np.testing.assert_array_equal(c.points, np.array(points)[c.origin])
    assert c.origin[0] == 0
    assert set(np.diff(c.origin) % len(c)) == {(-1 if turns < 0 else 1) % len(c)}


@given(polygons, st.integers(0, 20))
def test_numbering_from_another_vertex_changes_nothing(points: Points, shift: int) -> None:
    n, c = len(points), Curve(points)
    rolled = Curve(np.roll(points, -shift, axis=0))
    assert (rolled.turning_number, rolled.reversed_input) == (c.turning_number, c.reversed_input)
    assert rolled.area == pytest.approx(c.area, abs=1e-12 * np.abs(points).max() ** 2)
    sign = -1 if c.reversed_input else 1  # vertex 0 stays first, so the edges of reversed curves shift the other way
    moved = {tuple(sorted(((i - sign * shift) % n, (j - sign * shift) % n))) for i, j in c.crossings}
    assert set(rolled.crossings) == moved


@given(
    polygons,
    st.integers(-100, 100),
    st.sampled_from([(1, 1, 0), (-1, 1, 0), (1, -1, 0), (-1, -1, 0), (1, 1, 1), (-1, 1, 1)]),
)
def test_exact_similarities_and_reflections_change_scale_alone(
    points: Points, power: int, kind: tuple[int, int, int]
) -> None:
    sx, sy, swap = kind
    c = Curve(points)
    image = np.array(points) * np.array([sx, sy]) * 2.0**power
    d = Curve(image[:, ::-1] if swap else image)
    assert d.turning_number == c.turning_number
    mirrored = sx * sy * (-1) ** swap < 0
    if c.turning_number:
        assert d.reversed_input == (c.reversed_input != mirrored)
        assert d.area == pytest.approx(
            4.0**power * c.area, rel=1e-12, abs=4.0**power * 1e-12 * np.abs(points).max() ** 2
        )
    assert len(d.crossings) == len(c.crossings)
    assert d.crossings.proper.sum() == c.crossings.proper.sum()


@given(polygons)
def test_the_area_is_that_of_the_shoelace(points: Points) -> None:
    assert Curve(points).area == pytest.approx(
        float(oracle.area(Curve(points).points)), abs=1e-14 * len(points) * np.abs(points).max() ** 2
    )


def test_regions_count_as_often_as_the_curve_winds_about_them() -> None:
    inner, outer = [(1, 1), (3, 1), (3, 3), (1, 3)], [(1, 0), (4, 0), (4, 4), (1, 4)]
    assert Curve([*inner, *outer]).area == float(oracle.area([*inner, *outer]))
    assert Curve(EIGHT).area == 0
    assert Curve(np.array(SQUARE) + 2.0**30).area == 1


# Inserted vertices


def assert_refines(d: Curve, c: Curve) -> None:
    """Check that d has the vertices of c, and others between them."""
    kept = d.origin >= 0
    np.testing.assert_array_equal(d.origin[kept], c.origin)
    np.testing.assert_array_equal(d.points[kept], c.points)
    assert kept[0]
    assert (d.turning_number, d.reversed_input) == (c.turning_number, c.reversed_input)


@pytest.mark.parametrize("kind", ["scatter", "winding"])
def test_inserted_vertices_leave_the_shape_as_it_is(kind: str) -> None:
    for points in random_polygons(kind, 50, seed=2):
        c = Curve(points)
        for count in (len(c), len(c) + 1, 3 * len(c) + 1):
            d = c.insert_vertices(count)
            assert len(d) == count
            assert_refines(d, c)
            assert d.area == pytest.approx(c.area, abs=1e-12 * np.abs(points).max() ** 2)


@given(st.one_of(grid_polygons(), short_polygons()), st.integers(0, 40))
def test_midpoints_of_dyadic_edges_lie_exactly_on_them(points: Points, more: int) -> None:
    c = Curve(points)
    d = c.insert_vertices(len(c) + more)
    assert_refines(d, c)
    exact = oracle.integers(d.points)
    starts = [*np.flatnonzero(d.origin >= 0), len(d)]
    for low, high in pairwise(starts):
        a, b = exact[low], exact[high % len(d)]
        along = [(x - a[0]) * (b[0] - a[0]) + (y - a[1]) * (b[1] - a[1]) for x, y in exact[low:high]]
        assert all(oracle.orient2d(a, b, x) == 0 for x in exact[low:high])
        assert along == sorted(set(along))
    assert oracle.area(d.points) == oracle.area(c.points)


def test_the_longest_edge_is_halved_first_and_of_equals_the_first() -> None:
    assert Curve(SQUARE).insert_vertices(6).origin.tolist() == [0, -1, 1, -1, 2, 3]
    long = Curve([(0, 0), (8, 0), (8, 1), (0, 1)]).insert_vertices(8)
    assert long.points[:, 0].tolist() == [0, 2, 4, 6, 8, 8, 4, 0]
    assert long.origin.tolist() == [0, -1, -1, -1, 1, 2, -1, 3]


@pytest.mark.parametrize(
    "sliver",
    [
        [(3, 1), (1 / 3, 1 / 3), (1.6666666666666665, 0.6666666666666664)],  # turning number becomes 0
        [(1, 3), (2 / 3, 2 / 3), (0.8333333333333333, 1.833333333333333)],  # is reversed, origin is not
    ],
)
def test_insertion_keeps_a_sliver_as_it_is_or_refuses(sliver: Points) -> None:
    c = Curve(sliver)
    try:
        d = c.insert_vertices(5)
    except CurveError:
        return
    assert_refines(d, c)


def test_insertion_remembers_a_reversed_input() -> None:
    c = Curve(SQUARE[::-1]).insert_vertices(6).insert_vertices(8)
    assert c.reversed_input
    assert c.origin.tolist() == [0, -1, 3, -1, 2, -1, 1, -1]
    np.testing.assert_array_equal(c.points[::2], np.array(SQUARE[::-1])[[0, 3, 2, 1]])


def test_vertices_cannot_be_taken_away_or_halved_below_the_last_bit() -> None:
    with pytest.raises(CurveError, match="3 vertices wanted, but the curve has 4"):
        Curve(SQUARE).insert_vertices(3)
    tiny = Curve([(1, 1), (1 + 2.0**-52, 1), (1, 1 + 2.0**-52)])
    with pytest.raises(CurveError, match="too short to be halved"):
        tiny.insert_vertices(5)


def test_a_curve_stands_for_itself() -> None:
    c = Curve(SQUARE)
    assert as_curve(c) is c
    assert as_curve(SQUARE).points.tolist() == c.points.tolist()
    assert repr(c) == "Curve(4 vertices, turning number 1)"

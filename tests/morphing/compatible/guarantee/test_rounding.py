"""What rounding can do: bounds hold on computed shapes, and doubt is named where there is too little room."""

from fractions import Fraction

import numpy as np
import oracle
import pytest

from tween import gallery
from tween.geometry.triangulation import Triangulation
from tween.morphing.compatible.guarantee.rounding import Doubt, Layout, Placing, cut, first_doubt
from tween.morphing.compatible.leg import Leg
from tween.triangulating.decomposition import triangulate

PLACING = Placing(0.0, 0.0, 0.0)
CORNERS, CHILDREN = np.array([[0, 1, 2]]), np.array([[-1, -1, -1]])


def constant(low, high, slack):
    """A triangle over a base of length 1 whose angles stay within bounds."""

    def layout(t):
        k = len(t) - 1
        angles = [np.broadcast_to(np.reshape(x, (1, 3, 1)), (1, 3, k)).copy() for x in (low, high)]
        return Layout(*angles, np.ones((1, k)), np.ones((1, k)), np.full((3, k), slack))

    return layout


def doubt(layout, moves=lambda start, end: end - start):
    return first_doubt(layout, CORNERS, CHILDREN, PLACING, moves)


def test_a_fat_triangle_with_room_is_proved_at_once():
    assert doubt(constant([1.0] * 3, [1.1] * 3, 1.0)) == (0.0, 1.0)


@pytest.mark.parametrize(
    ("low", "high", "slack", "rule"),
    [
        ([1.0] * 3, [1.1] * 3, -1e-3, "vertex"),
        ([1.0] * 3, [1.1] * 3, 1e-15, "vertex"),
        ([0.0, 1.0, 1.0], [1.1] * 3, 1.0, "triangle"),
        ([1e-17, 1.0, 1.0], [1e-16, 1.1, 2.1], 1.0, "triangle"),
    ],
)
def test_too_little_room_is_named_with_its_time(low, high, slack, rule):
    found = doubt(constant(low, high, slack), moves=lambda start, end: 1.0)
    assert isinstance(found, Doubt) and found.rule == rule
    assert 0 <= found.start < found.stop <= 1
    assert found.left <= found.needed


def test_bounds_that_are_no_numbers_prove_nothing():
    for k in range(3):
        low = [1.0] * 3
        low[k] = np.nan
        assert isinstance(doubt(constant(low, [1.1] * 3, 1.0), moves=lambda start, end: 1.0), Doubt)
    assert isinstance(doubt(constant([1.0] * 3, [1.1] * 3, np.nan), moves=lambda start, end: 1.0), Doubt)


def test_an_end_serves_for_times_so_close_that_nothing_moves():
    def layout(t):
        plain = constant([1.0] * 3, [1.1] * 3, 1.0)(t)
        return plain._replace(slack=np.where(t[:-1] == 0.0, -1.0, 1.0) * np.ones((3, 1)))

    start, stop = doubt(layout)
    assert 0 < start <= 2.0**-24 and stop == 1.0
    assert isinstance(doubt(layout, moves=lambda start, end: 1.0), Doubt)


@pytest.mark.parametrize(
    ("start", "end"),
    [(0.0, 1.0), (0.25, 0.5), (0.0, 2.0**-20), (1 - 2.0**-20, 1.0), (1 - 9 * 2.0**-53, 1.0), (1 - 2.0**-52, 1.0)],
)
def test_parts_of_an_interval_cover_it(start, end):
    parts = cut(start, end)
    assert parts[0, 0] == start and parts[-1, 1] == end
    assert (parts[1:, 0] == parts[:-1, 1]).all() and (parts[:, 0] < parts[:, 1]).all()


@pytest.mark.parametrize("path", ["linear", "slide", "angle", "metric", "area"])
@pytest.mark.parametrize("name", ["arrow", "ess", "three_lobes"])
def test_what_is_proved_is_so_in_exact_arithmetic_where_times_cluster(name, path):
    T = triangulate(gallery.curve(name))
    leg = Leg(T, T.on_disk().points, path, 0, guarantee=True)
    start, stop = leg.first_doubt(PLACING)
    times = np.concatenate([start + 2.0 ** -np.arange(1, 50, 7), stop - 2.0 ** -np.arange(1, 50, 7)])
    for points in leg.at(times[(times > start) & (times < stop)]):
        p = [tuple(map(Fraction, q)) for q in points.tolist()]
        assert all(oracle.orient2d(*(p[v] for v in corners)) > 0 for corners in T.triangles.tolist())
        assert oracle.turning_number(points) == 1


def test_a_triangulation_far_from_the_origin_is_doubted_sooner():
    T = Triangulation([[0, 0], [1, 0], [1, 1e-9], [0, 1]], [[0, 1, 2], [0, 2, 3]])
    leg = Leg(T, T.points[:, ::-1][[0, 3, 2, 1]] + [0.5, 0.0], "linear", 0, guarantee=True)
    near = leg.first_doubt(Placing(0.0, 0.0, 0.0))
    far = leg.first_doubt(Placing(1e9, 0.0, 0.0))
    assert isinstance(far, Doubt) and not (isinstance(near, Doubt) and near.needed >= far.needed)

"""The gallery keeps its promises: immersed disks with the features their names announce."""

import hashlib
import re

import numpy as np
import pytest

from tween import gallery
from tween.errors import CurveError
from tween.geometry.predicates import incircle, orient2d
from tween.geometry.triangulation import Triangulation
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh

SIMPLE = ("convex", "arrow", "ell", "comb", "ess", "spiral_1", "spiral_2")
CAP = 3


def winding_number(points, place):
    """Count the signed crossings of the curve with the ray from the place to the right."""
    following = np.roll(points, -1, axis=0)
    above, above_next = points[:, 1] > place[1], following[:, 1] > place[1]
    side = orient2d(points, following, place)
    return int(np.sum(~above & above_next & (side > 0))) - int(np.sum(above & ~above_next & (side < 0)))


def most_covered(T):
    """Return how often the curve winds about the triangle that it winds about most often."""
    return max(winding_number(T.points, centre) for centre in T.points[T.triangles].mean(axis=1))


def cocircular(T):
    """Count the diagonals whose quadrilateral is cocircular, so that remeshing may leave either diagonal."""
    opposite = T.triangles[T.dual[:, 1]].sum(axis=1) - T.diagonals.sum(axis=1)
    return int(np.sum(incircle(*np.moveaxis(T.points[T.triangles[T.dual[:, 0]]], 1, 0), T.points[opposite]) == 0))


def on_grid(points):
    return bool((points / gallery.GRID == np.rint(points / gallery.GRID)).all())


# Named curves


def test_there_are_at_least_fourteen_curves_and_simple_ones_come_first():
    assert len(gallery.names()) >= 14
    assert gallery.names()[: len(SIMPLE)] == SIMPLE


@pytest.mark.parametrize("name", gallery.names())
def test_a_named_curve_bounds_an_immersed_disk_and_is_small_and_of_unit_size(name):
    c = gallery.curve(name)
    d = decompose(c)
    assert d, d.reason
    d.arbitrary().validate()
    assert c.turning_number == 1
    assert 40 <= len(c) <= 130
    assert 1 <= np.ptp(c.points, axis=0).max() <= 10


@pytest.mark.parametrize("name", gallery.names())
def test_a_named_curve_crosses_itself_exactly_where_it_is_not_called_simple(name):
    crossings = gallery.curve(name).crossings
    assert (len(crossings) == 0) == (name in SIMPLE)
    assert len(crossings.touches) == 0


@pytest.mark.parametrize("name", gallery.names())
def test_a_named_curve_lies_on_the_grid_so_that_midpoints_lie_exactly_on_its_edges(name):
    c = gallery.curve(name)
    assert on_grid(c.points)
    finer = c.insert_vertices(2 * len(c))
    middle = np.flatnonzero(finer.origin < 0)
    before, after = finer.points[middle - 1], finer.points[(middle + 1) % len(finer)]
    assert (orient2d(before, finer.points[middle], after) == 0).all()


@pytest.mark.parametrize("name", gallery.names())
def test_remeshing_a_named_curve_meets_no_cocircular_tie(name):
    assert cocircular(remesh(decompose(gallery.curve(name)).arbitrary())) == 0


def test_a_tie_would_be_seen():
    assert cocircular(Triangulation([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]])) == 1


@pytest.mark.parametrize(("name", "count"), [("two_disks", 2), ("five_disks", 5), ("pretzel", 1), ("winding_3", 1)])
def test_all_triangulations_remesh_to_one_for_each_immersed_disk(name, count):
    drawn = decompose(gallery.curve(name)).sample(np.random.default_rng(0), 200)
    remeshed = [remesh(T) for T in drawn]
    assert len({T.canonical.tobytes() for T in remeshed}) == count
    assert {cocircular(T) for T in remeshed} == {0}


def test_convex_is_strictly_convex():
    p = gallery.curve("convex").points
    assert (orient2d(np.roll(p, 1, axis=0), p, np.roll(p, -1, axis=0)) > 0).all()


@pytest.mark.parametrize("name", gallery.names()[1:])
def test_no_other_curve_is_convex(name):
    p = gallery.curve(name).points
    assert (orient2d(np.roll(p, 1, axis=0), p, np.roll(p, -1, axis=0)) < 0).any()


@pytest.mark.parametrize(("name", "turns"), [("spiral_1", 1.4), ("spiral_2", 2.2), ("winding_3", 2.6)])
def test_a_spiral_winds_around_as_often_as_it_says(name, turns):
    z = gallery.curve(name).points @ np.array([1, 1j])
    m = len(z) // 2 - CAP
    spine = (z[:m] + z[m + CAP : 2 * m + CAP][::-1]) / 2
    assert np.angle(spine[1:] / spine[:-1]).sum() == pytest.approx(2 * np.pi * turns, abs=1e-2)


def test_ell_has_one_reflex_corner():
    p = gallery.curve("ell").points
    a, b, c = np.roll(p, 1, axis=0), p, np.roll(p, -1, axis=0)
    u, v = b - a, c - b
    sine = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) / (np.hypot(*u.T) * np.hypot(*v.T))
    assert np.sum(sine < -1e-3) == 1


@pytest.mark.parametrize(
    ("name", "times"), [("convex", 1), ("spiral_2", 1), ("horseshoe", 2), ("three_lobes", 2), ("winding_3", 3)]
)
def test_a_curve_covers_the_plane_as_often_as_it_says(name, times):
    assert most_covered(remesh(decompose(gallery.curve(name)).arbitrary())) == times


@pytest.mark.parametrize(("name", "count"), [("loop", 4), ("two_loops", 8), ("pretzel", 8), ("three_lobes", 6)])
def test_strips_make_four_crossings_a_time_and_lobes_two(name, count):
    assert len(gallery.curve(name).crossings.crossing) == count


def test_two_disks_is_its_own_mirror_image_exactly():
    p = gallery.curve("two_disks").points
    assert np.array_equal(np.roll(p[::-1], 1, axis=0) * [1, -1], p)


@pytest.mark.parametrize("name", ["three_lobes", "five_disks"])
def test_threefold_curves_turn_into_themselves(name):
    z = gallery.curve(name).points @ np.array([1, 1j])
    assert np.abs(np.roll(z, -len(z) // 3) - z * np.exp(2j * np.pi / 3)).max() < 1e-5


@pytest.mark.parametrize("name", gallery.names())
def test_a_description_is_one_sentence(name):
    assert re.fullmatch(r"[A-Z][^.]*(\d\.\d[^.]*)?\.", gallery.describe(name))


@pytest.mark.parametrize("ask", [gallery.curve, gallery.describe])
def test_an_unknown_name_is_answered_with_the_known_ones(ask):
    with pytest.raises(CurveError, match=r"no curve 'square'.*convex, arrow, .*, five_disks"):
        ask("square")


def test_a_curve_is_made_once():
    assert gallery.curve("ess") is gallery.curve("ess")


def test_coordinates_are_the_same_on_every_platform_and_change_only_on_purpose():
    curves = [gallery.curve(name) for name in gallery.names()] + [gallery.letter(c) for c in gallery.letters()]
    disk = gallery.random_disk(100, np.random.default_rng(0))
    units = [np.rint(shape.points / gallery.GRID).astype("<i8") for shape in [*curves, disk]]
    assert hashlib.sha256(b"".join(u.tobytes() for u in units)).hexdigest()[:16] == "a30ea99f4473e58a"

"""The gallery keeps its promises: immersed disks with the features their names announce."""

import hashlib
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tween import gallery
from tween.errors import CurveError, TriangulationError
from tween.geometry.curve import Curve
from tween.geometry.predicates import incircle, orient2d
from tween.geometry.triangulation import Triangulation
from tween.io.read_write import read_stroke
from tween.triangulating.decomposition import decompose
from tween.triangulating.flips import remesh

SIMPLE = ("convex", "arrow", "ell", "comb", "ess", "spiral_1", "spiral_2")
ONE_STROKE_APART = ("C", "U", "c")
CAP = 3
HAVE_STROKES = tuple(chr(i) for i in range(33, 127))


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


def pen_width(letter):
    """Return the distance of the two corners at the start of a letter."""
    return float(np.hypot(*(letter.points[0] - letter.points[-1 - CAP])))


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


# Ribbons


@st.composite
def spines(draw):
    """Paths with edges of length 1 to 2 and turns of up to the drawn angle."""
    sharpest = draw(st.sampled_from([0.3, 1.0, 3.0]))
    turns = draw(st.lists(st.floats(-sharpest, sharpest), max_size=20))
    lengths = draw(st.lists(st.floats(1, 2), min_size=len(turns) + 1, max_size=len(turns) + 1))
    directions = draw(st.floats(0, 6.28)) + np.cumsum([0.0, *turns])
    z = np.append(0, np.cumsum(lengths * np.exp(1j * directions)))
    return np.round(np.stack([z.real, z.imag], axis=1), 9)


def radii(spine):
    """Radius of curvature of every inner vertex, by angles."""
    z = np.diff(spine @ np.array([1, 1j]))
    turn = np.abs(np.angle(z[1:] / z[:-1]))
    return np.minimum(np.abs(z[1:]), np.abs(z[:-1])) / (2 * np.tan(np.maximum(turn, 1e-9) / 2))


@given(spines(), st.floats(0.01, 4), st.integers(0, 4))
def test_a_ribbon_bounds_a_disk_or_names_a_vertex_whose_radius_is_too_small(spine, width, cap):
    try:
        c = gallery.ribbon(spine, width, cap)
    except CurveError as error:
        found = re.match(
            r"spine vertex (\d+): radius of curvature (\S+) is not above half the width, (\S+);", str(error)
        )
        assert found, error
        radius = radii(spine)[int(found[1]) - 1]
        assert radius <= width / 2 * (1 + 1e-9)
        assert float(found[2]) == pytest.approx(radius, rel=1e-2)
        assert float(found[3]) == pytest.approx(width / 2, rel=1e-2)
    else:
        assert len(c) == 2 * len(spine) + 2 * cap
        assert not c.reversed_input
        assert decompose(c)


@given(spines(), st.floats(0.01, 4))
@example(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]), 0.5)
def test_a_ribbon_with_half_its_width_below_all_half_radii_exists(spine, width):
    if width < radii(spine).min(initial=np.inf):
        gallery.ribbon(spine, width)


@given(spines())
def test_a_ribbon_walked_the_other_way_is_the_same_curve(spine):
    width = min(1.0, 0.5 * radii(spine).min(initial=np.inf))
    there, back = gallery.ribbon(spine, width).points, gallery.ribbon(spine[::-1], width).points
    np.testing.assert_allclose(np.roll(back, len(spine), axis=0), there, rtol=0, atol=1e-9)


def test_a_ribbon_scales_with_its_spine():
    spine = np.array([[0, 0], [1, 0], [2, 0.5], [2.5, 1.5]])
    assert np.array_equal(gallery.ribbon(spine / 1024, 0.2 / 1024).points, gallery.ribbon(spine, 0.2).points / 1024)


def test_the_sides_of_a_ribbon_keep_their_distance_around_a_corner():
    c = gallery.ribbon([[0, 0], [4, 0], [4, 4]], 1)
    np.testing.assert_allclose(c.points, [[0, -0.5], [4.5, -0.5], [4.5, 4], [3.5, 4], [3.5, 0.5], [0, 0.5]], atol=1e-12)


def test_a_cap_is_a_half_circle_beyond_the_end():
    c = gallery.ribbon([[0, 0], [4, 0]], 2, cap=3)
    end, start = c.points[2:5], c.points[7:10]
    np.testing.assert_allclose(np.hypot(*(end - [4, 0]).T), 1)
    np.testing.assert_allclose(np.hypot(*start.T), 1)
    assert end[1] == pytest.approx([5, 0])
    assert start[1] == pytest.approx([-1, 0])


def test_a_ribbon_along_a_path_that_crosses_itself_crosses_itself_four_times():
    assert len(gallery.ribbon([[-3, 0], [3, 0], [4, 3], [2, 4], [0, 3], [0, -3]], 0.5).crossings) == 4


@pytest.mark.parametrize(
    ("spine", "width", "message"),
    [
        (
            [[0, 0], [1, 0], [2, 0], [2, 1]],
            2.5,
            "spine vertex 2: radius of curvature 0.5 is not above half the width, 1.25; take a narrower ribbon",
        ),
        ([[0, 0], [1, 0], [0, 0]], 0.1, "spine vertex 1: radius of curvature .*e-.* is not above half the width"),
        ([[0, 0], [1, 0], [1, 0]], 0.1, "spine vertices 1 and 2 are the same point"),
        ([[0, 0], [1, np.nan]], 0.1, "spine vertex 1 is .*expected finite"),
        ([[0, 0]], 0.1, "expected .m, 2. with m >= 2"),
        ([0, 1, 2], 0.1, "expected .m, 2. with m >= 2"),
        ([[0, 0], [1, 0]], 0, "0 wide, expected more than"),
        ([[0, 0], [1, 0]], -1, "-1 wide, expected more than"),
        ([[0, 0], [1, 0]], np.nan, "nan wide, expected more than"),
        ([[0, 0], [1, 0]], 1e-30, "1e-30 wide, expected more than"),
    ],
)
def test_a_ribbon_that_cannot_be_says_why(spine, width, message):
    with pytest.raises(CurveError, match=message):
        gallery.ribbon(spine, width)


# Random disks


@given(st.integers(3, 120), st.integers(0, 2**32 - 1))
def test_a_random_disk_is_a_triangulation_of_a_curve_that_is_recognised(n, seed):
    T = gallery.random_disk(n, np.random.default_rng(seed)).validate()
    assert len(T) == n
    assert on_grid(T.points)
    assert decompose(T)
    remesh(T).validate()


@pytest.mark.parametrize("seed", range(5))
def test_the_triangles_of_a_random_disk_are_neither_thin_nor_small_nor_large(seed):
    T = gallery.random_disk(1000, np.random.default_rng(seed)).validate()
    z = T.points[T.triangles] @ np.array([1, 1j])
    edges = np.roll(z, -1, axis=1) - z
    angles = np.angle(-np.roll(edges, 1, axis=1) / edges)
    assert np.abs(angles).min() > np.radians(14.99)
    assert 0.499 < np.abs(edges).min() <= np.abs(edges).max() < 2.001
    sums = np.zeros(len(T))
    np.add.at(sums, T.triangles, np.abs(angles))
    assert sums.max() < 2 * np.pi - 0.049


def test_random_disks_of_fifty_vertices_nearly_always_overlap_themselves():
    disks = [gallery.random_disk(50, np.random.default_rng(seed)) for seed in range(40)]
    assert sum(len(T.curve.crossings) > 0 for T in disks) >= 36


def test_the_same_seed_grows_the_same_disk_and_another_seed_another():
    first, again, other = (gallery.random_disk(40, np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert np.array_equal(first.points, again.points)
    assert np.array_equal(first.triangles, again.triangles)
    assert not np.array_equal(first.points, other.points)


def test_a_disk_of_two_vertices_is_refused():
    with pytest.raises(TriangulationError, match="2 vertices was asked for, expected at least 3"):
        gallery.random_disk(2, np.random.default_rng(0))


# Letters


@pytest.mark.parametrize("char", HAVE_STROKES)
def test_every_printable_character_is_written_as_an_immersed_disk(char):
    c = gallery.letter(char)
    d = decompose(c)
    assert d, d.reason
    d.arbitrary().validate()
    assert 60 <= len(c) <= 120
    assert on_grid(c.points)


def test_at_least_twelve_letters_take_the_full_pen():
    assert len(gallery.letters()) >= 12
    for char in gallery.letters():
        assert np.array_equal(gallery.letter(char).points, gallery.letter(char, gallery.PEN).points)
        assert pen_width(gallery.letter(char)) == pytest.approx(gallery.PEN, abs=1e-5)


@pytest.mark.parametrize("char", gallery.letters())
def test_letters_cross_themselves_unless_it_is_said_that_they_do_not(char):
    assert (len(gallery.letter(char).crossings) == 0) == (char in ONE_STROKE_APART)


@pytest.mark.parametrize("char", ["A", "E", "G", "a", "b"])
def test_a_tight_bend_takes_the_widest_of_the_narrower_pens_that_fits(char):
    with pytest.raises(CurveError, match=rf"letter '{char}': spine vertex \d+: radius of curvature"):
        gallery.letter(char, gallery.PEN)
    width = pen_width(gallery.letter(char))
    narrowings = np.log(width / gallery.PEN) / np.log(0.75)
    assert narrowings == pytest.approx(round(narrowings), abs=1e-3)
    with pytest.raises(CurveError, match="take a narrower ribbon"):
        gallery.letter(char, width / 0.75)


def test_letters_are_upright():
    low, high = gallery.letter("d").points[:, 1].min(), gallery.letter("d").points[:, 1].max()
    assert -1 < low < 0
    assert high > 20  # the ascender
    assert gallery.letter("z").points[:, 1].min() < -10  # the tail
    assert gallery.letter("L").points[0] @ [0, 1] > 5  # the stroke starts at its top


@pytest.mark.parametrize(("char", "height"), [("i", 6), ("j", 18), ("t", 21)])
def test_a_letter_is_its_longest_stroke_not_its_dot_or_bar(char, height):
    assert np.ptp(gallery.letter(char).points[:, 1]) > height


@pytest.mark.parametrize("char", [" ", "", "ab", "ß"])
def test_a_character_without_a_stroke_is_answered_with_those_that_have_one(char):
    with pytest.raises(CurveError, match=r"no stroke for '.*'; expected one of ! .* A B C .* z"):
        gallery.letter(char)


@pytest.mark.parametrize("width", [0, -1, 1e-9, np.nan])
def test_a_pen_without_width_is_refused(width):
    with pytest.raises(CurveError, match=r"expected at least 0\.01"):
        gallery.letter("c", width)


def test_the_finest_pen_writes_every_character():
    for char in HAVE_STROKES:
        assert isinstance(gallery.letter(char, 0.01), Curve)


# Strokes


def test_a_stroke_of_path_data_is_that_of_a_file(tmp_path: Path) -> None:
    data = "M10 80C40 80 90 70 90 40S70 5 55 20s0 50 35 50a20 20 0 0 0 20-20v-20"
    path = tmp_path / "loop.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{data}"/></svg>')
    for tolerance in (None, 0.5):
        drawn = gallery.stroke(data, 6, tolerance)
        np.testing.assert_array_equal(drawn.points, read_stroke(path, 6, tolerance=tolerance).points)
    assert len(drawn.crossings) > 0
    assert len(gallery.stroke(data, 6, cap=4)) == len(gallery.stroke(data, 6)) + 8


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ("", "0 lines"),
        ("M0 0L1 1M2 2L3 3", "2 lines"),
        ("M0 0L1 frog", "path data"),
        ("M0 0L1e400 1", "path data"),
        ("M0 0L1 0L1 1", "too|width|radius"),
    ],
)
def test_what_is_no_single_line_is_refused(data: str, words: str) -> None:
    with pytest.raises(CurveError, match=words):
        gallery.stroke(data, 3)

"""Morphs by gradual flips: the flow of each shape, and the way through the end of one of them."""

from collections.abc import Iterator
from functools import cache
from itertools import pairwise, product
from typing import Any

import numpy as np
import oracle
import pytest
from numpy.typing import NDArray

from tween import (
    Curve,
    Morph,
    NotSelfOverlappingError,
    Triangulation,
    area_matrix,
    decompose,
    morph,
    paper_morph,
    triangulate,
)
from tween.choices import PATHS
from tween.errors import IncompatibleError
from tween.gallery import curve, letter
from tween.geometry.predicates import orient2d
from tween.morphing.alignment import align
from tween.morphing.incompatible.flip_sequence import FlipSequence, flip_sequence
from tween.morphing.incompatible.flow import Event, Flow

# Different sizes but for two; all but "convex" with reflex vertices; vertices inserted on either.
PAIRS = [
    ("arrow", "ell"),
    ("three_lobes", "spiral_2"),
    ("two_loops", "loop"),
    ("winding_3", "comb"),
    ("two_disks", "five_disks"),
    ("ess", "horseshoe"),
    ("ess", "spiral_1"),
    ("convex", "pretzel"),
    ("e", "l"),
    ("D", "d"),
    ("J", "arrow"),
    ("S", "Z"),
]
ORDERS = ("partial", "sequential")
PAPER = ("slide", "linear")
OTHERS = [path for path in PATHS if path not in PAPER]
WAYS = list(product(PAPER, ORDERS))
every_pair = pytest.mark.parametrize("pair", PAIRS, ids="-".join)
every_way = pytest.mark.parametrize("way", WAYS, ids="-".join)

EIGHT = [(0, 0), (2, 2), (2, 0), (0, 2)]
FOLD = [(0, 0), (3, 3), (6, 0), (6, 6), (3, 1), (0, 6)]

Pair = tuple[str, str]
Way = tuple[Any, Any]


@cache
def shape(name: str) -> Curve:
    return letter(name) if len(name) == 1 else curve(name)


@cache
def made(pair: Pair, way: Way = ("slide", "partial"), root: Any = "disk-center") -> Morph:
    return paper_morph(*map(shape, pair), path=way[0], root=root, order=way[1])


@cache
def in_order(pair: Pair, path: Any = "slide", root: Any = "disk-center") -> Morph:
    """Return the same, computed from the one of the two that comes first: ties are then broken alike both ways."""
    return morph(*map(shape, pair), path, guarantee=False, strategy="paper", placement="root", root=root)


def size(m: Morph) -> float:
    return float(np.ptp(m.source.points, axis=0).max())


def key(triangles: Any) -> oracle.Triangles:
    return oracle.as_set(triangles)


def after(m: Morph, time: float) -> NDArray[np.int64]:
    """Return the triangles in force just after a time."""
    return m.triangles_at(min(1.0, float(np.nextafter(time, 2))))


def flip_times(m: Morph) -> list[float]:
    return sorted({e.time for e in m.events})


def all_positive(frame: NDArray[np.float64], triangles: NDArray[np.int64]) -> bool:
    p = oracle.fractions(frame)
    return all(oracle.orient2d(*(p[v] for v in t)) > 0 for t in triangles.tolist())


# Shapes


@every_way
@every_pair
def test_the_ends_are_exactly_the_shapes_that_were_given(pair: Pair, way: Way) -> None:
    m = made(pair, way)
    assert len(m.events) > 0
    for given, vertices, t in zip(map(shape, pair), (m.source_vertices, m.target_vertices), (0, 1), strict=True):
        kept = vertices >= 0
        np.testing.assert_array_equal(m(t)[kept], given.points[vertices[kept]])
        assert sorted(vertices[kept]) == list(range(len(given)))
    np.testing.assert_array_equal(m(0), m.source.points)
    np.testing.assert_array_equal(m(1), m.target.points)


@every_way
@every_pair
def test_every_triangle_of_every_frame_is_counter_clockwise(pair: Pair, way: Way) -> None:
    m = made(pair, way)
    times = np.linspace(0, 1, 100)
    for i, (t, frame) in enumerate(zip(times, m.at(times), strict=True)):
        triangles = m.triangles_at(t)
        assert (orient2d(*np.moveaxis(frame[triangles], 1, 0)) > 0).all()
        assert i % 33 or all_positive(frame, triangles)


@every_way
@every_pair
def test_the_triangles_of_both_sides_of_a_flip_are_counter_clockwise_where_it_happens(pair: Pair, way: Way) -> None:
    m, before = made(pair, way), made(pair, way).source.triangles
    for time in flip_times(m):
        here, now = m(time), after(m, time)
        assert all((Triangulation(here, x).areas > -1e-9 * size(m) ** 2).all() for x in (before, now))
        before = now


@pytest.mark.parametrize("path", PAPER)
@every_pair
def test_the_way_back_is_the_way_there_reversed(pair: Pair, path: str) -> None:
    there, back = in_order(pair, path), in_order(pair[::-1], path)
    frames = np.roll(back.frames(41)[::-1], -there.alignment.shift, axis=1)
    np.testing.assert_allclose(there.frames(41), frames, rtol=0, atol=1e-9 * size(there))
    np.testing.assert_array_equal(np.roll(back.target_vertices, -there.alignment.shift), there.source_vertices)
    assert (there.u, there.v) == (back.v, back.u)


@pytest.mark.parametrize("name", ["two_disks", "horseshoe"])
def test_the_way_back_between_two_triangulations_of_one_curve_is_the_way_there_reversed(name: str) -> None:
    S, T, *_ = decompose(curve(name)).sample(np.random.default_rng(1), 6)
    there, back = (morph(*shapes, strategy="paper", placement="root") for shapes in ((S, T), (T, S)))
    frames = np.roll(back.frames(11)[::-1], -there.alignment.shift, axis=1)
    np.testing.assert_allclose(there.frames(11), frames, atol=1e-9 * size(there))


@every_way
@every_pair
def test_the_largest_step_halves_where_the_frames_double(pair: Pair, way: Way) -> None:
    steps = [np.abs(np.diff(made(pair, way).frames(k + 1), axis=0)).max() for k in (200, 400, 800)]
    assert all(1.7 < coarse / fine < 2.3 for coarse, fine in pairwise(steps))


@every_way
@every_pair
def test_there_is_no_jump_where_a_flip_happens(pair: Pair, way: Way) -> None:
    m = made(pair, way)
    times = np.array(flip_times(m))
    before, after = m.at(np.maximum(0, times - 1e-9)), m.at(np.minimum(1, times + 1e-9))
    assert np.abs(after - before).max() < 1e-6 * size(m)


def speeds(m: Morph) -> NDArray[np.float64]:
    """Return the root mean square velocity of the vertices at many times that are no event, over its mean."""
    times, h = np.linspace(0.0005, 0.9995, 1500), 1e-7
    flips = np.array([e.time for e in m.events])
    times = times[np.abs(times[:, None] - flips).min(axis=1) > h]
    moved = m.at(times + h) - m.at(times - h)
    speed = np.sqrt((moved**2).sum(axis=2).mean(axis=1))
    return speed / speed.mean()


@every_way
@every_pair
def test_the_pace_does_not_change_much(pair: Pair, way: Way) -> None:
    assert np.ptp(np.percentile(speeds(made(pair, way)), [1, 99])) < 0.28


@every_pair
def test_in_its_own_time_a_morph_has_half_for_the_way_and_half_for_the_flow(pair: Pair) -> None:
    m = paper_morph(*map(shape, pair), pace="time")
    assert m.u is not None and m.v is not None
    times = np.array(flip_times(m) if m.v <= m.u else [1 - t for t in flip_times(m)])
    assert times.min() == pytest.approx(0.5 if min(m.u, m.v) > 0 else 1.0) and times.max() <= 1
    even = paper_morph(*map(shape, pair), pace="speed")
    assert [event[1:] for event in even.events] == [event[1:] for event in m.events]
    assert [event.time for event in even.events] == [event.time for event in paper_morph(*map(shape, pair)).events]


@every_pair
def test_the_pace_changes_times_and_not_shapes(pair: Pair) -> None:
    own, even = (paper_morph(*map(shape, pair), pace=pace) for pace in ("time", "speed"))
    for a, b in zip(
        own.events[:: max(1, len(own.events) // 7)], even.events[:: max(1, len(own.events) // 7)], strict=True
    ):
        assert own(a.time) == pytest.approx(even(b.time), abs=1e-6 * size(own))


def test_the_pace_is_even() -> None:
    spreads = [np.ptp(np.percentile(speeds(made(*x)), [1, 99])) for x in product(PAIRS, WAYS)]
    assert max(spreads) < 0.1


# Paths that the paper does not have


@pytest.mark.parametrize("path", OTHERS)
def test_on_other_paths_triangles_stay_counter_clockwise_and_the_way_back_is_the_way_there(path: str) -> None:
    for pair in PAIRS[:3]:
        there, back = in_order(pair, path), in_order(pair[::-1], path)
        times = np.linspace(0, 1, 41)
        frames = there.at(times)
        for t, frame in zip(times, frames, strict=True):
            assert (orient2d(*np.moveaxis(frame[there.triangles_at(t)], 1, 0)) > 0).all()
        reverse = np.roll(back.frames(41)[::-1], -there.alignment.shift, axis=1)
        np.testing.assert_allclose(frames, reverse, rtol=0, atol=1e-9 * size(there))


@pytest.mark.parametrize("path", OTHERS)
def test_on_other_paths_the_largest_step_shrinks_with_the_number_of_frames(path: str) -> None:
    for pair in PAIRS[:2]:
        coarse, fine = (np.abs(np.diff(made(pair, (path, "partial")).frames(k), axis=0)).max() for k in (201, 801))
        assert fine < coarse / 2


# Triangles and events


@every_pair
def test_the_triangles_at_the_start_are_those_of_the_source_row_for_row(pair: Pair) -> None:
    for way in WAYS:
        m = made(pair, way)
        assert m.triangles_at(0).tolist() == m.source.triangles.tolist()


def replay(triangles: Any, events: list[Event]) -> oracle.Triangles:
    """Flip, checking that each diagonal that gives way is there, and what comes is the other one."""
    now = set(key(triangles))
    for _, out, into in events:
        pair = {t for t in now if set(out) <= set(t)}
        assert len(pair) == 2
        assert set().union(*pair) - set(out) == set(into)
        assert out == tuple(sorted(out)) and into == tuple(sorted(into))
        now = (now - pair) | {tuple(sorted((*into, end))) for end in out}
    return frozenset(now)


@every_way
@every_pair
def test_the_events_lead_from_the_triangles_of_the_source_to_those_of_the_target(pair: Pair, way: Way) -> None:
    m = made(pair, way)
    assert replay(m.source.triangles, m.events) == key(m.target.triangles) == key(m.triangles_at(1))
    times = [e.time for e in m.events]
    assert times == sorted(times) and 0 <= times[0] and times[-1] <= 1
    for t in flip_times(m):
        assert replay(m.source.triangles, [e for e in m.events if e.time <= t]) == key(after(m, t))


def linked(links: list[set[int]]) -> list[set[int]]:
    """Unite the sets that have elements in common."""
    united: list[set[int]] = []
    for link in links:
        link = link.union(*(x for x in united if x & link))
        united = [x for x in united if not x & link] + [link]
    return united


def flipped_rows(m: Morph) -> Iterator[tuple[float, list[set[int]]]]:
    """Yield, for each time of events, the rows of the pairs that are flipped then; of chains, all rows together."""
    rows = [frozenset(t) for t in m.source.triangles.tolist()]
    for time in flip_times(m):
        links = []
        for _, out, into in (e for e in m.events if e.time == time):
            r, s = (i for i, t in enumerate(rows) if set(out) <= t)
            rows[r], rows[s] = (frozenset((*into, end)) for end in out)
            links.append({r, s})
        yield time, linked(links)
        rows = [frozenset(t) for t in after(m, time).tolist()]


@every_way
@every_pair
def test_a_flip_changes_no_rows_but_those_of_its_pair_and_their_area_is_continuous(pair: Pair, way: Way) -> None:
    m, before = made(pair, way), made(pair, way).source.triangles
    for time, chains in flipped_rows(m):
        now = after(m, time)
        areas = [Triangulation(m(time), x).areas for x in (before, now)]
        others = sorted(set(range(len(now))) - set().union(*chains))
        assert list(map(set, now[others].tolist())) == list(map(set, before[others].tolist()))
        for chain in map(sorted, chains):
            assert set(now[chain].ravel()) == set(before[chain].ravel())
            assert areas[0][chain].sum() == pytest.approx(areas[1][chain].sum(), abs=1e-9 * areas[0].sum())
        before = now


@every_pair
def test_the_area_matrix_of_a_morph_with_flips_adds_up_to_the_areas_of_the_frames(pair: Pair) -> None:
    m = made(pair)
    A, frames = area_matrix(m, 16), m.frames(16)
    assert (A > 0).all()
    whole = float(oracle.area(m.source.points))
    np.testing.assert_allclose(A.sum(axis=0), [float(oracle.area(f)) / whole for f in frames], rtol=1e-9)


# Flows


@cache
def flow(pair: Pair, way: Way, by: int) -> tuple[Flow, FlipSequence, Triangulation]:
    """Return the flow of the first shape of a pair (by 0) or of the second, its flips, and where they lead."""
    a = align(*map(shape, pair))
    T, U = (a.source, a.target) if by == 0 else (a.target, a.source)
    flips = flip_sequence(T, U)
    return Flow(T, flips, way[0], "disk-center", way[1]), flips, U


def numbered(flips: FlipSequence) -> dict[tuple[tuple[int, ...], tuple[int, ...]], int]:
    """Return the place of each flip in the sequence, by what it replaces with what; none occurs twice."""
    replaced = zip(map(tuple, flips.out.tolist()), map(tuple, flips.into.tolist()), strict=True)
    numbers = {flip: k for k, flip in enumerate(replaced)}
    assert len(numbers) == len(flips)
    return numbers


def quads(flips: FlipSequence, numbers: list[int]) -> NDArray[np.int64]:
    """Return the corners around the diagonals that give way, counter-clockwise, shape (k, 4)."""
    (a, b), (c, d) = flips.out[numbers].T, flips.into[numbers].T
    between = (a < c) & (c < b)
    return np.stack([a, np.where(between, c, d), b, np.where(between, d, c)], axis=1)


def corner_turns(quads: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the four triples of consecutive corners of each, shape (k, 4, 3)."""
    return np.stack([np.roll(quads, -i, axis=1)[:, :3] for i in range(4)], axis=1)


def turns(points: NDArray[np.float64], quads: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return by how much quads turn left where diagonals give way, shape (..., k, 2)."""
    corners = points[..., quads, :] @ np.array([1, 1j])
    steps = np.roll(corners, -1, axis=-1) - corners
    return np.angle(steps / np.roll(steps, 1, axis=-1))[..., ::2]


def some_have_room(f: Flow, shapes: NDArray[np.float64], quads: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Tell in which shapes the corners of some quad turn by 0.02, or by half of what they do on the disk."""
    least = np.minimum(0.02, 0.5 * turns(f.start.on_disk().points, quads))
    return (turns(shapes, quads) >= (1 - 1e-9) * least).all(axis=2).any(axis=1)


def some_convex(shapes: NDArray[np.float64], quads: NDArray[np.int64]) -> NDArray[np.bool_]:
    turns = orient2d(*np.moveaxis(shapes[:, corner_turns(quads)], 3, 0))
    return (turns > 0).all(axis=2).any(axis=1)


def ready(flips: FlipSequence, undone: list[int], order: str) -> list[int]:
    """Return the flips that wait for none: of no earlier one that is not done they touch a row."""
    if order == "sequential":
        return undone[:1]
    rows = [set(pair) for pair in flips.rows.tolist()]
    return [f for i, f in enumerate(undone) if not any(rows[f] & rows[e] for e in undone[:i])]


def legs_between_flips(f: Flow, flips: FlipSequence, order: str) -> Iterator[tuple[float, Any, NDArray[np.int64]]]:
    """Yield each piece of the flow, the time when it starts, and the quads that wait meanwhile."""
    undone, start, events = list(range(len(flips))), 0.0, f.events_by_stage()
    numbers = numbered(flips)
    for stage, piece in enumerate(f.pieces):
        for event, _ in (x for x in events if x[1] == stage):
            undone.remove(numbers[event.out, event.into])
            start = event.time
        yield start, piece, quads(flips, ready(flips, undone, order))


@every_way
@every_pair
@pytest.mark.parametrize("by", [0, 1])
def test_a_flip_happens_as_soon_as_one_that_waits_is_possible_with_room_to_spare(pair: Pair, way: Way, by: int) -> None:
    f, flips, _ = flow(pair, way, by)
    for start, piece, waiting in legs_between_flips(f, flips, way[1]):
        assert piece.start == 0
        (stop,) = piece.at(np.array([1.0]))
        assert some_have_room(f, stop[None], waiting).all() and some_convex(stop[None], waiting).all()
        just_before = piece.stop - 1e-6 / (1 - start)
        if just_before > 0:
            assert not some_have_room(f, piece.leg.at(np.linspace(0, just_before, 1000)), waiting).any()


@every_way
@every_pair
@pytest.mark.parametrize("by", [0, 1])
def test_every_flip_of_a_flow_is_strictly_convex_exactly(pair: Pair, way: Way, by: int) -> None:
    f, flips, U = flow(pair, way, by)
    shapes = [f.start.points, *(piece.at(np.array([1.0]))[0] for piece in f.pieces)]
    numbers = numbered(flips)
    for event, stage in f.events_by_stage():
        p = oracle.fractions(shapes[stage][quads(flips, [numbers[event.out, event.into]])[0]])
        assert all(oracle.orient2d(p[i - 2], p[i - 1], p[i]) > 0 for i in range(4))
    np.testing.assert_array_equal(f.final.points, shapes[-1])
    assert replay(f.start.triangles, f.events) == key(f.final.triangles) == key(U.triangles)
    assert all_positive(f.final.points, f.final.triangles)
    assert 0 <= f.end <= 1 and f.events[-1].time == f.end


@every_pair
def test_in_sequence_every_flip_waits_for_the_one_before(pair: Pair) -> None:
    f, flips, _ = flow(pair, ("slide", "sequential"), 0)
    assert [[*e.out] for e in f.events] == flips.out.tolist()
    assert [[*e.into] for e in f.events] == flips.into.tolist()


@every_way
@every_pair
def test_a_flow_goes_on_from_where_it_is_to_the_same_disk(pair: Pair, way: Way) -> None:
    f, *_ = flow(pair, way, 0)
    here, share = f.start.points, np.array([0.0, 1.0])
    for start, piece in zip([0.0, *sorted({e.time for e in f.events if e.time > 0})], f.pieces, strict=False):
        first, last = piece.at(share)
        np.testing.assert_array_equal(first, here)
        np.testing.assert_array_equal(piece.leg.at(share)[1], f.start.on_disk().points)
        assert any(e.time == pytest.approx(start + piece.stop * (1 - start), abs=1e-12) for e in f.events)
        here = last


@every_way
@every_pair
def test_the_way_leads_through_the_flow_that_is_done_first(pair: Pair, way: Way) -> None:
    m = made(pair, way)
    own, other = (flow(pair, way, by)[0] for by in (0, 1))
    assert m.u == pytest.approx(own.end, abs=1e-6) and m.v == pytest.approx(other.end, abs=1e-6)
    assert 0 <= m.u <= 1 and 0 <= m.v <= 1
    by, time = (other, m.events[0].time) if m.v <= m.u else (own, m.events[-1].time)
    np.testing.assert_allclose(m(time), by.final.points, atol=1e-6 * size(m))


# Choices


def test_a_common_triangulation_needs_no_flips_where_the_paper_s_morph_has_some() -> None:
    for pair in (("arrow", "ell"), ("ess", "horseshoe"), ("Q", "c")):
        m = morph(*map(shape, pair), strategy="common")
        assert m.events == []
        assert (m.u, m.v) == (None, None)
        np.testing.assert_array_equal(m.source.canonical, m.target.canonical)
        assert made(pair).events != []


@pytest.mark.slow
def test_without_a_common_triangulation_common_says_what_would_work() -> None:
    with pytest.raises(IncompatibleError, match=r"'common' is impossible: .* strategy='paper' flips on the way"):
        morph(shape("three_lobes"), shape("spiral_2"), strategy="common")


@pytest.mark.parametrize("strategy", ["paper", None])
def test_triangulations_that_were_given_are_kept_where_flips_lead_from_one_to_the_other(strategy: Any) -> None:
    S, T = (triangulate(shape(name)) for name in ("ess", "horseshoe"))
    m = paper_morph(S, T) if strategy is None else morph(S, T, strategy=strategy)
    assert m.events != []
    assert m.source.triangles.tolist() == S.triangles.tolist()


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ({"shifts": "some"}, "shifts is 'some', expected 'pivots', 'all' or a whole number"),
        ({"shifts": 0.5}, "shifts is 0.5, expected 'pivots', 'all' or a whole number"),
        ({"order": "random"}, "order is 'random', expected one of partial, sequential"),
        ({"path": "spline"}, "path is 'spline', expected one of linear, slide"),
    ],
)
def test_an_unknown_choice_is_refused_and_the_known_ones_are_named(option: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        paper_morph(shape("arrow"), shape("ell"), **option)


@pytest.mark.parametrize("strategy", ["auto", "matched", "common", "paper"])
@pytest.mark.parametrize(
    ("points", "reason"), [(EIGHT, "turning number is 0, not 1"), (FOLD, "no decomposition exists")]
)
def test_a_curve_that_bounds_no_disk_is_named_with_the_reason(points: Any, reason: str, strategy: Any) -> None:
    for curves, name in (((points, shape("ell")), "source"), ((shape("ell"), points), "target")):
        with pytest.raises(NotSelfOverlappingError, match=f"the {name} bounds no immersed disk: {reason}"):
            morph(*curves, strategy=strategy)


@pytest.mark.parametrize("shift", [0, 7, -3])
def test_a_number_is_taken_for_the_correspondence_and_its_negative_for_the_way_back(shift: int) -> None:
    for pair in (("arrow", "ell"), ("ess", "spiral_1"), ("spiral_1", "ess")):
        there = paper_morph(*map(shape, pair), shifts=shift)
        back = paper_morph(*map(shape, pair[::-1]), shifts=-shift)
        n = len(there.source)
        assert (there.alignment.shift, back.alignment.shift) == (shift % n, -shift % n)
        np.testing.assert_array_equal(there.target.points, np.roll(back.source.points, -shift, axis=0))


@pytest.mark.parametrize("pair", [("arrow", "ell"), ("horseshoe", "loop")], ids="-".join)
def test_of_all_correspondences_the_one_with_fewest_crossings_is_flipped(pair: Pair) -> None:
    m = paper_morph(*map(shape, pair), shifts="all")
    counts = [align(*map(shape, pair), k).crossings for k in range(len(m.source))]
    assert m.alignment.crossings == counts[m.alignment.shift] == min(counts) > 0


# Roots


@every_pair
def test_another_root_gives_other_shapes_on_the_way(pair: Pair) -> None:
    first, second = (made(pair, root=root) for root in (0, 20))
    assert np.abs(first.frames(21) - second.frames(21)).max() > 1e-3 * size(first)
    for m in (first, second):
        for t in np.linspace(0, 1, 21):
            assert (orient2d(*np.moveaxis(m(t)[m.triangles_at(t)], 1, 0)) > 0).all()
    with pytest.raises(ValueError, match="root is 1000, expected"):
        made(pair, root=1000)


@pytest.mark.parametrize("pair", [("ess", "horseshoe"), ("S", "Z"), ("arrow", "ell"), ("J", "arrow")], ids="-".join)
def test_a_root_that_both_triangulations_have_is_the_same_the_other_way(pair: Pair) -> None:
    plain, n = in_order(pair), len(in_order(pair).source)
    shared = min(key(plain.source.triangles) & key(plain.target.triangles))
    back = in_order(pair[::-1])
    moved = min(oracle.shifted(frozenset([shared]), plain.alignment.shift, n))
    own, other = (
        [sorted(t) for t in m.source.triangles.tolist()].index([*t])
        for m, t in ((plain, sorted(shared)), (back, sorted(moved)))
    )
    there, back = in_order(pair, root=own), in_order(pair[::-1], root=other)
    frames = np.roll(back.frames(21)[::-1], -there.alignment.shift, axis=1)
    np.testing.assert_allclose(there.frames(21), frames, rtol=0, atol=1e-9 * size(there))

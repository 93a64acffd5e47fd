"""Straight motion between frames: that every instant of it is decided exactly, and what a broken one is called."""

import json
import os
import subprocess
import sys
import time
from fractions import Fraction
from itertools import islice
from pathlib import Path

import numpy as np
import oracle
import pytest
import sturm
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from tween import certify, gallery, morph, paper_morph, verify
from tween.measuring import straight_motion
from tween.measuring.straight_motion import Breach, breaches

ROOT = Path(__file__).resolve().parents[2]
SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
HALVES, OTHER_HALVES = [(0, 1, 2), (0, 2, 3)], [(0, 1, 3), (1, 2, 3)]
PAIRS = int(os.environ.get("STRAIGHT_PAIRS", "2000"))  # against Sturm's theorem; 100,000 were run once


# Pairs of frames, exactly or nearly at fault


def fan(count: int) -> list[tuple[int, int, int]]:
    """Return triangles around a hub, vertex 0."""
    return [(0, i, i + 1) for i in range(1, count + 1)]


def coefficients(grid: NDArray[np.int64]):
    """Return the coefficients, 1, x, x**2, of cross and inner product of the outer edges (N, frame, edge, xy)."""
    u, w, v, z = grid.reshape(-1, 4, 2).transpose(1, 2, 0)
    pairs = (u, w), (u, z), (v, w), (v, z)
    cross = [a[0] * b[1] - a[1] * b[0] for a, b in pairs]
    inner = [a[0] * b[0] + a[1] * b[1] for a, b in pairs]
    return [(p[0], p[1] + p[2], p[3]) for p in (cross, inner)]


def kinds_of_edges(grid: NDArray[np.int64]):
    """Return masks of the edges that make a quadratic special."""
    (c0, m, c2), (d0, k, d2) = coefficients(grid)
    root = m**2 - 4 * c0 * c2
    return {
        "a double root inside": (root == 0) & (c0 * m < 0),
        "a double root inside, a triangle": (root == 0) & (c0 > 0) & (m < 0),
        "a root at the start and one inside": (c0 == 0) & (c2 * m < 0),
        "a root at the end and one inside": (c2 == 0) & (c0 * m < 0),
        "roots at both ends": (c0 == 0) & (m != 0) & (c2 == 0),
        "identically zero": (c0 == 0) & (m == 0) & (c2 == 0),
        "two roots inside": (c0 < 0) & (c2 < 0) & (root > 0) & (m > 0),
        "two roots inside, a triangle": (c0 > 0) & (c2 > 0) & (root > 0) & (m < 0),
        "no root, though not of one sign": (c0 < 0) & (c2 < 0) & (root < 0) & (m > 0),
        "no root, though not of one sign, a triangle": (c0 > 0) & (c2 > 0) & (root < 0) & (m < 0),
        "one root, an edge alike": (c0 * c2 < 0) & (np.minimum(d0, d2) > 0),
        "one root, an inner product of both signs": (c0 * c2 < 0) & (d0 * d2 < 0),
        "one sign": (c0 <= 0) & (m <= 0) & (c2 <= 0) & (d0 + k + d2 > 0),
    }


def around(hub, first, last, count: int, size: float) -> NDArray[np.float64]:
    """Return a hub and the ends of its spokes, spread evenly from the first counter-clockwise to the last."""
    start, end = (np.arctan2(y, x) for x, y in (first, last))
    angles = start + (end - start) % (2 * np.pi) * np.arange(1, count) / count
    rim = size * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return hub + np.array([(0.0, 0.0), first, *np.round(rim * 64) / 64, last])


def is_disk(points: NDArray[np.float64], count: int) -> bool:
    p = oracle.integers(points)
    positive = all(oracle.orient2d(*(p[v] for v in t)) > 0 for t in fan(count))
    return positive and oracle.is_polygon(points) and oracle.turning_number(points) == 1


def pairs(seed: int):
    """Yield the kind of a pair of frames around a hub, the two frames, and the number of triangles."""
    rng = np.random.default_rng(seed)
    while True:
        grid = rng.integers(-4, 5, (2000, 2, 2, 2))
        for kind, mask in kinds_of_edges(grid).items():
            count = 1 if "triangle" in kind else int(rng.integers(3, 9))
            for edges in grid[mask][:6].astype(float):
                hubs, sizes = rng.integers(-1, 2, (2, 2)) * rng.choice([0, 0, 1, 1000]), rng.choice([1.0, 4.0, 5.0], 2)
                pair = [around(hub, *uw, count, r) for hub, uw, r in zip(hubs, edges, sizes, strict=True)]
                frames = nudged(np.stack(pair), rng) * 2.0 ** rng.integers(-190, 185)
                if all(is_disk(frame, count) for frame in frames):
                    yield kind, *frames, count


def nudged(frames: NDArray[np.float64], rng) -> NDArray[np.float64]:
    """Move some coordinates, or none, by a few last bits."""
    ulps = rng.integers(-2, 3, frames.shape) * (rng.random(frames.shape) < rng.choice([0.0, 0.1, 0.5]))
    return np.where(frames == 0, 0.0, frames + ulps * np.spacing(np.abs(frames)))


def agrees(found: Breach | None, truth: sturm.Found | None) -> bool:
    if found is None or truth is None:
        return found is truth is None
    s, *element = found
    near = Fraction(1, 2**51)
    return tuple(element) in truth.elements and truth.low * (1 - near) <= Fraction(s) <= truth.high * (1 + near)


@pytest.mark.slow
def test_random_pairs_near_every_degeneracy_are_decided_as_by_sturms_theorem() -> None:
    tally = {}
    for kind, start, end, count in islice(pairs(seed=13), PAIRS):
        truth = sturm.first_breach(start, end, fan(count))
        (found,) = breaches(start[None], end[None], np.array([fan(count)]))
        assert agrees(found, truth), (kind, start.tolist(), end.tolist())
        answer = found.kind if found else "valid"
        tally[kind, answer] = tally.get((kind, answer), 0) + 1
    if os.environ.get("STRAIGHT_PAIRS"):
        print(*sorted(tally.items()), sep="\n")
    assert {answer for _, answer in tally} == {"triangle", "vertex", "valid"}
    assert all((kind, "vertex") in tally for kind in ("a double root inside", "two roots inside"))
    assert ("a double root inside, a triangle", "triangle") in tally
    assert ("no root, though not of one sign, a triangle", "valid") in tally


def in_powers(c) -> sturm.Polynomial:
    """Return c0 (1-s)^2 + c1 s (1-s) + c2 s^2 in powers of s."""
    return sturm.trimmed([c[0], c[1] - 2 * c[0], c[0] - c[1] + c[2]])


def test_the_first_root_at_which_another_quadratic_is_positive_is_that_of_sturms_theorem() -> None:
    rng = np.random.default_rng(8)
    hits = 0
    for *c, d0, d1, d2 in rng.integers(-5, 6, (4000, 6)).tolist():
        d = in_powers((d0, d1, d2))
        roots = [(("root", 0), root) for root in sturm.roots(in_powers(c)) if d and sturm.sign_at(d, root) > 0]
        truth, found = sturm.earliest(roots), straight_motion._first_root(tuple(c), (d0, d1, d2))
        assert agrees(None if found is None else Breach(found, "root", 0), truth), (c, d0, d1, d2)
        hits += found is not None
    assert 500 < hits < 3000


def test_a_root_far_smaller_than_the_other_keeps_its_digits() -> None:
    tiny = straight_motion._first_root((1, -(10**40), 1))
    assert tiny == pytest.approx(1e-40, rel=1e-15, abs=0)
    assert straight_motion._first_root((1, -(10**40), 10**40)) == pytest.approx(1e-40, rel=1e-15, abs=0)


def test_thin_triangles_whose_areas_are_all_rounding_are_decided_exactly() -> None:
    rng = np.random.default_rng(21)
    answers = []
    while len(answers) < 300:
        u = rng.uniform(1, 2, 2)
        w, v, z = (factor * u + rng.integers(-3, 4, 2) * 2.0**-52 for factor in (rng.uniform(1, 1.5), -1, -1.25))
        start, end = (np.array([(0.0, 0.0), *edges]) for edges in ((u, w), (v, z)))
        if is_disk(start, 1) and is_disk(end, 1):
            (found,) = breaches(start[None], end[None], np.array([fan(1)]))
            answers.append(found is None)
            assert agrees(found, sturm.first_breach(start, end, fan(1)))
    assert 20 < sum(answers) < 280


@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_no_instant_of_what_is_accepted_is_refuted_by_turning_number_and_areas(seed: int, parts: int) -> None:
    _, start, end, count = next(pairs(seed))
    (found,) = breaches(start[None], end[None], np.array([fan(count)]))
    places = [[Fraction(x) for x in frame.ravel()] for frame in (start, end)]
    for k in range(1, parts):
        s = Fraction(k, parts)
        points = np.reshape([a + s * (b - a) for a, b in zip(*places, strict=True)], (-1, 2)).tolist()
        valid = all(oracle.orient2d(*(points[v] for v in t)) > 0 for t in fan(count)) and turns_once(points)
        if found is None or s < Fraction(found.s):
            assert valid


def turns_once(points) -> bool:
    return 2 not in oracle.turns(points) and sum(oracle.turns(points)) == 4


# Forged morphs: valid at the frames, broken between them


def moved(points, motion) -> NDArray[np.float64]:
    return np.asarray(points) @ np.array(motion, dtype=np.float64).T


def hub(edges, count: int = 5) -> NDArray[np.float64]:
    """Return two frames around a hub, whose outer edges are given."""
    return np.stack([around(np.zeros(2), *np.array(uw, dtype=np.float64), count, 4.0) for uw in edges])


OVER = hub([[(-1, 2), (0, 3)], [(4, -1), (-1, 0)]])  # more than 2 pi for a while
SPIKE = hub([[(-4, -1), (-3, 0)], [(3, 0), (2, -1)]])  # exactly 2 pi, once
HALF_TURN = [[-1, 0], [0, -1]]


def shear_to_and_fro() -> NDArray[np.float64]:
    """Return two frames of a triangle whose area is (1-2s)^2 times a constant."""
    return np.array([[(0, 0), (1, 0), (0, 1)], [(0, 0), (-1, 0), (0, -1)]], dtype=np.float64)


def dented(depth: float) -> NDArray[np.float64]:
    """A square whose corner 2 lies on the diagonal 1-3 at depth 1/2."""
    return np.array([(0, 0), (1, 0), (1 - depth, 1 - depth), (0, 1)])


FORGED = {
    "a square shrinks to a point on its way to half a turn": (
        [SQUARE, moved(SQUARE, HALF_TURN)],
        HALVES,
        0.5,
        "triangle 0",
    ),
    "a triangle touches zero and comes back": (shear_to_and_fro(), [(0, 1, 2)], 0.5, "triangle 0"),
    "the angles at a vertex exceed 2 pi for a while": (OVER, fan(5), 0.17875944538192956, "the angles at vertex 0"),
    "the angles at a vertex touch 2 pi at one instant": (SPIKE, fan(5), 0.5, "the angles at vertex 0"),
    "a spike at the smallest scale": (SPIKE * 2.0**-190, fan(5), 0.5, "the angles at vertex 0"),
    "a spike at the largest scale": (SPIKE * 2.0**190, fan(5), 0.5, "the angles at vertex 0"),
    "the vertices are numbered anew half way around": (
        [SQUARE, SQUARE, np.roll(SQUARE, 2, axis=0)],
        HALVES,
        0.75,
        "triangle 0",
    ),
    "a valid interval before a broken one": ([SPIKE[0], SPIKE[0], SPIKE[1]], fan(5), 0.75, "the angles at vertex 0"),
    "a broken interval before valid ones": ([*SPIKE, SPIKE[1], SPIKE[1]], fan(5), 0.5 / 3, "the angles at vertex 0"),
    "the way back, too, is broken": ([SPIKE[1], SPIKE[0]], fan(5), 0.5, "the angles at vertex 0"),
    "a flip that neither list survives": (
        [dented(0.25), moved(dented(0.75), HALF_TURN)],
        [HALVES, HALVES[::-1]],
        None,
        "the triangles change between frames 0 and 1, and neither list holds all the way",
    ),
    "a flip at which a vertex reaches 2 pi whatever the triangles": (
        OVER,
        [fan(5), fan(5)[::-1]],
        0.17875944538192956,
        "the angles at vertex 0",
    ),
}


@pytest.mark.parametrize("name", FORGED)
def test_what_is_valid_at_its_frames_and_broken_between_is_refused(name: str) -> None:
    frames, triangles, t, rule = FORGED[name]
    assert verify(frames, triangles).valid
    cert = verify(frames, triangles, between="linear")
    assert not cert
    assert (cert.scope, cert.frames_failed, cert.intervals_failed) == ("playback", 0, 1)
    assert cert.first_failure.rule.startswith(rule)
    assert t is None or cert.first_failure.t == pytest.approx(t, abs=1e-15)
    assert "intervals broken" in cert.proof


def test_the_last_bit_of_one_coordinate_decides() -> None:
    answers = []
    for place in (-np.inf, SPIKE[0, -1, 0], np.inf):
        frames = SPIKE.copy()
        frames[0, -1, 0] = np.nextafter(frames[0, -1, 0], place)
        answers.append(bool(verify(frames, fan(5), between="linear")))
        assert answers[-1] == (sturm.first_breach(*frames, fan(5)) is None)
    assert answers[1] is False and sorted(answers) == [False, False, True]


def test_the_instant_the_frames_and_the_element_are_named() -> None:
    cert = verify([SQUARE, SQUARE, moved(SQUARE, HALF_TURN)], HALVES, times=[3.0, 5.0, 9.0], between="linear")
    rule = "triangle 0 [0, 1, 2] loses its area between frames 1 and 2, at 0.5 of the way"
    assert cert.first_failure == (7.0, rule, 0)
    cert = verify(SPIKE, fan(5), between="linear")
    assert cert.first_failure.rule == "the angles at vertex 0 reach 2 pi between frames 0 and 1, at 0.5 of the way"
    assert cert.first_failure.element == 0


def test_the_earliest_of_frames_and_instants_is_named() -> None:
    broken_frame = SPIKE[0] * [1, -1]
    cert = verify([*SPIKE, broken_frame], fan(5), between="linear")
    assert (cert.first_failure.t, cert.frames_failed, cert.intervals_checked, cert.intervals_failed) == (0.25, 1, 1, 1)
    assert verify([broken_frame, *SPIKE], fan(5), between="linear").first_failure.t == 0


@pytest.mark.parametrize("rows", [HALVES, OTHER_HALVES])
@pytest.mark.parametrize("backwards", [False, True])
def test_at_a_flip_either_list_will_do(rows, backwards: bool) -> None:
    # Up to the dent both lists hold, beyond it only the halves through the dent.
    frames, lists = [dented(0.25), dented(0.75)], [rows, HALVES]
    if backwards:
        frames, lists = frames[::-1], lists[::-1]
    assert verify(frames, lists, between="linear").valid


def test_a_flip_that_one_list_would_survive_alone_is_refused_under_the_other() -> None:
    frames = [dented(0.25), dented(0.75)]
    assert verify(frames, HALVES, between="linear")
    assert not verify(frames, OTHER_HALVES)


def test_a_jump_in_no_time_is_checked_as_motion_is() -> None:
    frames = [SQUARE, moved(SQUARE, HALF_TURN)]
    assert verify(frames, HALVES, times=[0.0, 0.0], between="linear").first_failure.t == 0


def test_times_that_fall_and_unknown_motion_are_misuse() -> None:
    with pytest.raises(ValueError, match="times fall"):
        verify([SQUARE] * 2, HALVES, times=[1.0, 0.0], between="linear")
    with pytest.raises(ValueError, match="between is 'cubic', expected 'linear' or None"):
        verify([SQUARE] * 2, HALVES, between="cubic")


def test_what_only_moves_turns_or_grows_is_valid_throughout() -> None:
    third = [[-0.5, -(0.75**0.5)], [0.75**0.5, -0.5]]
    turned = [moved(SQUARE, third), moved(moved(SQUARE, third), third)]
    cert = verify([SQUARE, np.add(SQUARE, (7, -3)), 1e9 * SQUARE, *turned, SQUARE], HALVES, between="linear")
    assert cert.valid
    assert (cert.intervals_checked, cert.intervals_failed) == (5, 0)
    assert str(cert).splitlines()[0] == "valid at every instant of playback"


def test_collinear_edges_at_a_vertex_are_no_failure() -> None:
    flat = np.array([(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)], dtype=np.float64)
    assert verify([flat, 3 * flat, np.add(flat, (1, 1))], [(0, 1, 4), (1, 2, 3), (1, 3, 4)], between="linear").valid


@pytest.mark.parametrize("frames", [1, 2])
def test_one_frame_or_two_alike_are_as_good_as_the_frame(frames: int) -> None:
    assert verify([SQUARE] * frames, HALVES, between="linear").valid


@pytest.mark.parametrize("size", [2.0**-200, 2.0**200])
def test_both_ends_of_the_range_of_coordinates_are_exact(size: float) -> None:
    frames = np.stack([SQUARE, moved(SQUARE, HALF_TURN)]) * size
    assert verify(frames, HALVES, between="linear").first_failure.t == 0.5
    assert verify(np.stack([SQUARE * 2.0**-200, SQUARE * 2.0**200]), HALVES, between="linear").valid


# The promise of a morph is none of its checks


def test_a_forged_proof_is_neither_believed_nor_repeated() -> None:
    m = paper_morph(*gallery.fan())
    m.proof = "every angle is interpolated, trust me"
    cert = certify(m, frames=2)
    assert not cert.valid
    assert "trust me" not in str(cert)


def test_no_code_is_shared_with_the_rest() -> None:
    lines = Path(straight_motion.__file__).read_text().splitlines()
    assert not [line for line in lines if line.startswith(("from tween", "import tween"))]


# Cost


@pytest.mark.slow
def test_a_hundred_frames_of_a_thousand_vertices_take_tens_of_milliseconds() -> None:
    T = gallery.random_disk(1000, np.random.default_rng(0))
    frames = morph(T, T.on_disk(), path="angle").frames(100)
    lists = np.broadcast_to(T.triangles, (99, *T.triangles.shape))
    breaches(frames[:2], frames[1:3], lists[:2])
    start = time.process_time()
    found = breaches(frames[:-1], frames[1:], lists)
    assert time.process_time() - start < 0.2
    assert len(found) == 99


SAME = """
import json, sys
sys.path[:0] = ["tests", "tests/measuring"]
import numpy as np
from itertools import islice
from test_straight_motion import breaches, fan, pairs
cases = list(islice(pairs(3), 40))
print(json.dumps([breaches(a[None], b[None], np.array([fan(c)]))[0] for _, a, b, c in cases]))
"""


@pytest.mark.slow
def test_the_answers_are_the_same_without_compilation(capsys) -> None:
    env = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    run = subprocess.run([sys.executable, "-c", SAME], cwd=ROOT, env=env, capture_output=True, text=True, check=True)
    exec(SAME, {})
    assert json.loads(run.stdout) == json.loads(capsys.readouterr().out)

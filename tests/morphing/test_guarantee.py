"""With a guarantee every array that a morph gives is valid, or the morph is refused; and nothing jumps.

Most inputs here broke an earlier version: see the names.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import tween
from tween import Morph, Triangulation, area_matrix, area_rank, frame_variance, gallery, morph, remesh, verify
from tween.choices import PATHS
from tween.errors import GuaranteeError, MotionError, TriangulationError, TweenError

FIXTURES = Path(__file__).parent.parent / "fixtures"
CLOSE = 10.0 ** -np.arange(3.0, 18.0)
every_path = pytest.mark.parametrize("path", PATHS)

# A flip was made when its quadrilateral was hardly convex; the tip of the new flat triangle leapt.
LEAPING = (
    [(0, 0), (0.21, -1.06), (0.66, -1.41), (1, 0), (1.18, 0.41), (0.5, 0.8), (-0.36, 0.44), (-0.2, -0.01)],
    [(0, 0), (0.31, -0.55), (1, 0), (1.04, -0.37), (1.95, -0.12), (1.9, 0.55), (1.54, 0.47), (0.5, 0.8)],
)
# Midpoints of edges made triangles one rounding high.
SLIVERS = (
    [(1, 0.5), (-0.2, 0.9), (-0.6, -1)],
    [(2, 0), (0.62, 0.95), (-1.62, 0.59), (-1.62, -0.59), (0.62, -0.95)],
)


def beside_marks(m: Morph) -> NDArray[np.float64]:
    """Times at, and at 15 distances from, every flip and end."""
    marks = np.array([0.0, 1.0, *(e.time for e in m.events)])
    return np.unique(np.clip((marks[:, None] + np.concatenate([-CLOSE, [0.0], CLOSE])).ravel(), 0.0, 1.0))


def first_failure(m: Morph, t: NDArray[np.float64]) -> Any:
    checked = verify(m.at(t), np.stack([m.triangles_at(x) for x in t]), t)
    return checked.first_failure


def largest_jump(m: Morph) -> float:
    """The largest move within 1e-7 of a flip or an end, as a share of the width."""
    marks = np.array([0.0, 1.0, *(e.time for e in m.events)])
    times = np.clip(marks[:, None] + 1e-7 * np.array([-1.0, -1e-2, -1e-5, 0.0, 1e-5, 1e-2, 1.0]), 0.0, 1.0)
    shapes = m.at(times.ravel()).reshape(*times.shape, -1, 2)
    return float((shapes.max(axis=1) - shapes.min(axis=1)).max() / np.ptp(m.source.points, axis=0).max())


def disk(n: int, rng: np.random.Generator) -> NDArray[np.float64]:
    return gallery.random_disk(n, rng).points


# Validity


def test_area_fan_26_stays_valid_between_edges_within_a_factor_of_170() -> None:
    with np.load(FIXTURES / "area_fan_26.npz") as ends:
        S, T = Triangulation(ends["A"], ends["T"]), Triangulation(ends["B"], ends["T"])
    m = morph(S, T, path="area", root="tree-center", guarantee=True)
    assert (
        first_failure(m, np.unique([*np.linspace(0, 1, 1001), *np.linspace(0.973, 0.999, 200), *beside_marks(m)]))
        is None
    )


@pytest.mark.parametrize("guarantee", [False, True])
def test_area_flow_crash_is_answered_in_words(guarantee: bool) -> None:
    with np.load(FIXTURES / "area_flow_crash.npz") as ends:
        S, T = Triangulation(ends["A"], ends["T1"]), Triangulation(ends["B"], ends["T2"])
    try:
        m = morph(S, T, path="area", strategy="paper", guarantee=guarantee)
        shapes = m.frames(101)
    except TweenError as error:
        assert str(error)
    else:
        assert np.isfinite(shapes).all()
        assert not guarantee or first_failure(m, np.linspace(0, 1, 101)) is None


def shrinking_fan(by: float) -> tuple[Triangulation, Triangulation]:
    """Six triangles about a hub, which shrink, every second spoke a thousand times as much."""
    spokes = np.exp(0.05j * np.arange(7))
    shapes = []
    for lengths in (np.ones(7), by * np.where(np.arange(7) % 2, 1e-3, 1.0)):
        z = np.concatenate([[0.0], lengths * spokes])
        shapes.append(Triangulation(np.stack([z.real, z.imag], axis=1), [[0, i, i + 1] for i in range(1, 7)]))
    return shapes[0], shapes[1]


@pytest.mark.parametrize("by", [1e-2, 1e-4])
def test_the_metric_fan_keeps_its_budget_where_a_base_shrinks_a_millionfold(by: float) -> None:
    m = morph(*shrinking_fan(by), path="metric", guarantee=True, placement="root")
    assert first_failure(m, np.unique([*np.linspace(0, 1, 501), *(1 - 10.0 ** -np.linspace(0, 12, 500))])) is None


@every_path
def test_inserted_ends_are_valid_as_close_as_one_can_come(path: str) -> None:
    rng = np.random.default_rng(5)
    for n in (5, 9, 13):
        m = morph(disk(n, rng), disk(14, rng), path=path, guarantee=True)
        assert first_failure(m, beside_marks(m)) is None


@every_path
def test_translated_by_a_million_flips_are_valid_as_close_as_one_can_come(path: str) -> None:
    rng = np.random.default_rng(6)
    for n, m in ((8, 8), (7, 11)):
        far = morph(disk(n, rng) + 1e6, disk(m, rng) - 1e6, path=path, guarantee=True, strategy="paper")
        assert len(far.events) > 0
        assert first_failure(far, beside_marks(far)) is None


def tight_fan(left: float) -> Triangulation:
    """Four triangles about a hub that has so much left below 2 pi."""
    z = np.concatenate([[0.0], np.exp(1j * np.linspace(0.0, 2 * np.pi - left, 5))])
    return Triangulation(np.stack([z.real, z.imag], axis=1), [[0, i, i + 1] for i in range(1, 5)])


@every_path
def test_an_end_with_almost_nothing_left_below_two_pi_is_left_at_once(path: str) -> None:
    T = tight_fan(1e-9).validate()
    m = morph(T, T.on_disk(), path=path, guarantee=True)
    assert first_failure(m, beside_marks(m)) is None


def test_where_nothing_is_left_on_all_the_way_the_vertex_is_named() -> None:
    S, T = tight_fan(3e-15).validate(), tight_fan(2e-15).validate()
    with pytest.raises(GuaranteeError, match=r"no guarantee .* vertex 0 has \de-15 left below 2 pi"):
        morph(S, T, path="angle", guarantee=True)


def test_shapes_that_leave_the_exact_range_are_refused_with_the_time() -> None:
    S = Triangulation([[0, 0], [1, 0], [1, 1e50], [0, 1e50]], [[0, 1, 2], [0, 2, 3]]).validate()
    T = Triangulation(1e50 * np.array([[0, 0], [1, 0], [1, 1e-50], [0, 1e-50]]), [[0, 1, 2], [0, 2, 3]]).validate()
    for guarantee in (False, True):
        with pytest.raises((MotionError, GuaranteeError), match=r"t = "):
            for path in PATHS:
                morph(S, T, path=path, guarantee=guarantee).frames(11)
            raise GuaranteeError("t = none: every path stays within range")


@pytest.mark.slow
@every_path
def test_nothing_ordinary_is_refused(path: str) -> None:
    for name in gallery.names():
        T = tween.triangulate(gallery.curve(name))
        assert morph(T, T.on_disk(), path=path, guarantee=True).proof
    for pair in gallery.pairs():
        assert morph(*gallery.pair(pair), path=path, guarantee=True).proof
    for seed in range(5):
        T = remesh(gallery.random_disk(40, np.random.default_rng(seed)))
        assert morph(T, T.on_disk(), path=path, guarantee=True).proof


def test_with_a_guarantee_areas_stay_linear_on_almost_every_random_disk() -> None:
    linear = 0
    for seed in range(12):
        T = remesh(gallery.random_disk(40, np.random.default_rng(seed)))
        A = area_matrix(morph(T, T.on_disk(), path="area", guarantee=True))
        linear += area_rank(A, 1e-9) == 2 and frame_variance(A) < 1e-20
    assert linear == 12


# Jumps


@every_path
@pytest.mark.parametrize("ends", [LEAPING, SLIVERS], ids=["flips", "inserted"])
def test_nothing_leaps_at_a_flip_or_an_end(path: str, ends: Any) -> None:
    assert largest_jump(morph(*ends, path=path, strategy="paper" if ends is LEAPING else "auto")) < 1e-4


@every_path
def test_nothing_leaps_in_random_morphs_with_flips_and_inserted_vertices(path: str) -> None:
    for seed in range(6):
        rng = np.random.default_rng(seed)
        n = int(rng.integers(6, 14))
        assert largest_jump(morph(disk(n, rng), disk(n, rng), path=path, strategy="paper")) < 1e-3
        assert largest_jump(morph(disk(n, rng), disk(n - 1, rng), path=path)) < 1e-3


# Equivariance


@every_path
@pytest.mark.parametrize("strategy", ["auto", "paper"])
def test_a_similarity_of_both_shapes_moves_the_morph_and_changes_nothing(path: str, strategy: Any) -> None:
    times = np.linspace(0, 1, 11)
    for seed in range(3):
        rng = np.random.default_rng(seed)
        S, T = disk(9, rng), disk(9 + seed, rng)
        angle, scale, step = rng.uniform(0, 7), 10.0 ** rng.uniform(-2, 2), rng.normal(size=2)
        turn = scale * np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        here = morph(S, T, path=path, strategy=strategy).at(times)
        there = morph(S @ turn + step, T @ turn + step, path=path, strategy=strategy).at(times)
        np.testing.assert_allclose(there, here @ turn + step, rtol=0, atol=1e-9 * np.ptp(there))


def test_what_moves_too_far_within_a_moment_is_refused_rather_than_shown() -> None:
    with pytest.raises(GuaranteeError, match=r"close to t = 1: within 1e-07 a vertex moves by 0\.002 of the width"):
        morph(*shrinking_fan(1e-2), path="metric")


def test_ends_that_are_given_as_triangles_are_validated() -> None:
    points = np.array([[0, 0], [1, 0], [1, 1], [0.2, 0.1]])
    folded = Triangulation(points, [[0, 1, 2], [0, 2, 3]])
    turned_over = folded.moved(np.array([[0, 0], [1, 0], [1, 1], [0.8, 0.2]]))
    with pytest.raises(TriangulationError, match="triangle"):
        morph(folded, turned_over)

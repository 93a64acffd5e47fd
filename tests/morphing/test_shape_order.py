"""Which of two shapes comes first: decided by what similarities of both leave, and not by how they are given."""

import numpy as np
import pytest

from tween import gallery
from tween.geometry.triangulation import Triangulation
from tween.morphing.shape_order import comes_later, shape_key
from tween.triangulating.decomposition import triangulate

NAMES = ("arrow", "horseshoe", "ess", "three_lobes")


def every(T):
    return np.arange(len(T))


def similar(T, angle, size, away):
    z = T.points @ [1, 1j] * size * np.exp(1j * angle) + away
    return T.moved(np.stack([z.real, z.imag], axis=1))


@pytest.mark.parametrize("first", NAMES)
@pytest.mark.parametrize("second", NAMES)
@pytest.mark.parametrize("seed", range(3))
def test_a_similarity_of_both_and_another_start_change_nothing(first, second, seed):
    S, T = (triangulate(gallery.curve(name)) for name in (first, second))
    if first == second:
        T = T.moved(1.5 * T.points)
    rng = np.random.default_rng(seed)
    how = rng.uniform(0, 7), rng.uniform(0.01, 100), complex(*rng.normal(size=2)) * 10
    moved = [similar(T, *how).rolled(int(rng.integers(len(T)))) for T in (S, T)]
    answer = comes_later(S, every(S), T, every(T))
    assert comes_later(moved[0], every(S), moved[1], every(T)) == answer
    assert comes_later(moved[1], every(T), moved[0], every(S)) != answer


def test_inserted_vertices_do_not_count():
    curve = gallery.curve("ess")
    more = curve.insert_vertices(2 * len(curve))
    T, finer = triangulate(curve), triangulate(more)
    assert np.allclose(shape_key(finer, more.origin), shape_key(T, every(T)), rtol=1e-12)


def test_a_difference_of_a_few_roundings_is_none():
    T = triangulate(gallery.curve("ess"))
    nudged = T.moved(T.points * (1 + 1e-12))
    small, large = T.moved(0.5 * T.points), T
    assert comes_later(large, every(T), small, every(T)) and comes_later(nudged, every(T), small, every(T))


def congruent():
    """Pairs of the same shape: turned; moved only; mirrored at a diagonal, which exchanges edges."""
    T = triangulate(gallery.curve("ess"))
    parallelogram = Triangulation([[0, 0], [3, 0], [4, 2], [1, 2]], [[0, 1, 2], [0, 2, 3]])
    other = Triangulation([[0, 0], [3, 0], [2, 2], [-1, 2]], [[0, 1, 2], [0, 2, 3]])
    return [
        (T, similar(T, 2.0, 1.0, 3.0)),
        (T, T.moved(T.points + np.array([1.0, 0.0]))),
        (T, T.moved(T.points + np.array([0.0, -1.0]))),
        (parallelogram, other),
    ]


@pytest.mark.parametrize(("first", "second"), congruent())
@pytest.mark.parametrize("seed", range(4))
def test_of_congruent_shapes_a_similarity_changes_nothing_and_exchange_exchanges(first, second, seed):
    rng = np.random.default_rng(seed)
    how = rng.uniform(0, 7), rng.uniform(0.01, 100), complex(*rng.normal(size=2)) * 10
    start = int(rng.integers(len(first)))
    S, T = (similar(shape, *how).rolled(start) for shape in (first, second))
    answer = comes_later(first, every(first), second, every(second))
    assert comes_later(S, every(S), T, every(T)) == answer
    assert comes_later(T, every(T), S, every(S)) != answer


def test_of_shapes_turned_by_half_a_turn_bytes_decide_so_that_exchange_still_exchanges():
    T = triangulate(gallery.curve("ess"))
    U = similar(T, np.pi, 1.0, 3.0)
    assert comes_later(T, every(T), U, every(U)) != comes_later(U, every(U), T, every(T))


def test_a_triangle_has_seven_numbers():
    T = Triangulation([[0, 0], [3, 0], [0, 4]], [[0, 1, 2]])
    key = shape_key(T, every(T))
    assert key[:4] == pytest.approx([3, 12, np.sqrt(6), 5]) and key[5] == 3
